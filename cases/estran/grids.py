"""Arithmetic of cells and meshes for pictures: values at points, the water cut at its surface, cuts by a plane.
SPDX-License-Identifier: BSD-3-Clause"""
import numpy as np


def _part(v, a, first, end):
    return v[(slice(None),) * a + (slice(first, end),)]


def _shifted(v, a, k):
    """Those k cells on, NaN beyond the rim."""
    q = np.full(v.shape, np.nan)
    if k > 0:
        _part(q, a, 0, -k)[...] = _part(v, a, k, None)
    else:
        _part(q, a, -k, None)[...] = _part(v, a, 0, k)
    return q


def _mean(guesses):
    total, count = np.zeros(guesses[0].shape), np.zeros(guesses[0].shape)
    for g in guesses:
        total += np.where(np.isfinite(g), g, 0)
        count += np.isfinite(g)
    return total / np.where(count > 0, count, np.nan)


def filled(v):
    """Cells without numbers next to known ones: on along lines of cells, then round corners."""
    lines, corners = [], [v]
    for a in range(v.ndim):
        for k in (-1, 1):
            one, two = _shifted(v, a, k), _shifted(v, a, 2 * k)
            lines.append(np.where(np.isfinite(two), 2 * one - two, one))
        corners = [q for r in corners for q in (r, _shifted(r, a, 1), _shifted(r, a, -1))]
    for guess in (_mean(lines), _mean(corners)):
        v = np.where(np.isfinite(v), v, guess)
    return v


def with_rim(v, line=True):
    """Values of cells at their centres and at the rim of the block: on a line with the next two, or equal."""
    for a in range(v.ndim):
        ends = []
        for i, j in ((0, 1), (-1, -2)):
            one, two = v.take([i], a), v.take([j if v.shape[a] > 1 else i], a)
            ends.append(np.where(np.isfinite(two), 1.5 * one - 0.5 * two, one) if line else one)
        v = np.concatenate([ends[0], v, ends[1]], a)
    return v


def points(x):
    """Places of those values, from the vertices (..., dim)."""
    for a in range(x.ndim - 1):
        middle = (_part(x, a, 1, None) + _part(x, a, 0, -1)) / 2
        x = np.concatenate([x.take([0], a), middle, x.take([-1], a)], a)
    return x


def refined(v, n):
    """Linear between points, n - 1 new ones between two, over the first two axes; n: of both, or one of each."""
    for a, n in enumerate(n if np.iterable(n) else (n, n)):
        s = np.arange((v.shape[a] - 1) * n + 1) / n
        i = np.minimum(s.astype(int), v.shape[a] - 2)
        w = (s - i).reshape((-1,) + (1,) * (v.ndim - 1 - a))
        v = v.take(i, a) * (1 - w) + v.take(i + 1, a) * w
    return v


def middles(v):
    """Of the four corners of each face."""
    return (v[1:, 1:] + v[:-1, 1:] + v[1:, :-1] + v[:-1, :-1]) / 4


def shown(value, forced=None):
    """1 in cells that the program computes itself and one layer beyond them (air, what lies between two blocks)."""
    to = np.isfinite(filled(value)).astype(float)
    return to if forced is None else to * (forced < 0.5)


def water(value, level_set, forced):
    """Values at points, the share shown there, and level_set or None."""
    show = with_rim(shown(value, forced), False)
    if level_set is not None and forced is not None:  # there it says nothing of the water
        level_set = np.where(forced < 0.5, level_set, np.nan)
    phi = None if level_set is None else with_rim(filled(filled(level_set)))
    return with_rim(filled(filled(value))), show, phi


def nets(x, phi, v):
    """The surface phi = 0 as quadrilaterals (n, 4, 3) with their values: a vertex in each cube of eight points that it
    crosses, a face for each edge (surface nets)."""
    inside = phi < 0
    n = np.array(phi.shape) - 1
    total, value, count = np.zeros(tuple(n) + (3,)), np.zeros(n), np.zeros(n)
    for a in range(3):
        lo, hi = _part(phi, a, 0, -1), _part(phi, a, 1, None)
        crosses = _part(inside, a, 0, -1) != _part(inside, a, 1, None)
        w = np.where(crosses, lo / np.where(crosses, lo - hi, 1), 0)
        at = _part(x, a, 0, -1) * (1 - w)[..., None] + _part(x, a, 1, None) * w[..., None]
        of = _part(v, a, 0, -1) * (1 - w) + _part(v, a, 1, None) * w
        good = crosses & np.isfinite(of)
        b, c = [k for k in range(3) if k != a]
        for i in (0, 1):
            for j in (0, 1):
                cut = [slice(None)] * 3
                cut[b], cut[c] = slice(i, i + n[b]), slice(j, j + n[c])
                cut = tuple(cut)
                total += np.where(good[cut][..., None], at[cut], 0)
                value += np.where(good[cut], of[cut], 0)
                count += good[cut]
    total /= np.maximum(count, 1)[..., None]
    value /= np.maximum(count, 1)
    faces, values = [], []
    for a in range(3):
        crosses = _part(inside, a, 0, -1) != _part(inside, a, 1, None)
        b, c = [k for k in range(3) if k != a]
        index = np.argwhere(crosses)
        index = index[(index[:, b] > 0) & (index[:, c] > 0) & (index[:, b] < n[b]) & (index[:, c] < n[c])]
        corners = []
        for i, j in ((1, 1), (1, 0), (0, 0), (0, 1)):
            k = index.copy()
            k[:, b] -= i
            k[:, c] -= j
            corners.append(tuple(k.T))
        if len(index) and min(count[k].min() for k in corners) >= 0:
            good = np.all([count[k] > 0 for k in corners], 0)
            faces.append(np.stack([total[k] for k in corners], 1)[good])
            values.append(np.mean([value[k] for k in corners], 0)[good])
    if not faces:
        return np.zeros((0, 4, 3)), np.zeros(0)
    return np.concatenate(faces), np.concatenate(values)


def cut(x, corners, axis, where):
    """Segments (n, 2, 3) where a plane cuts triangles."""
    d = x[corners][:, :, axis] - where
    d[d == 0] = 1e-300
    found = []
    for i, j in ((0, 1), (1, 2), (2, 0)):
        w = d[:, i] / np.where(d[:, i] == d[:, j], 1, d[:, i] - d[:, j])
        at = x[corners[:, i]] * (1 - w)[:, None] + x[corners[:, j]] * w[:, None]
        found.append(np.where((d[:, i] * d[:, j] < 0)[:, None], at, np.nan))
    ends = np.stack(found, 1)
    two = np.isfinite(ends[:, :, 0]).sum(1) == 2
    order = np.argsort(~np.isfinite(ends[two][:, :, 0]), 1, kind='stable')[:, :2]
    return np.take_along_axis(ends[two], order[:, :, None], 1)


def loops(segments, scale):
    """Segments chained to lines of points."""
    ends = np.round(segments / (1e-6 * scale)).astype(np.int64)
    beside = {}
    for k, (a, b) in enumerate(ends):
        beside.setdefault(tuple(a), []).append((k, 0))
        beside.setdefault(tuple(b), []).append((k, 1))
    used, found = np.zeros(len(segments), bool), []
    for first in range(len(segments)):
        line, k, side = [], first, 0
        while k is not None and not used[k]:
            used[k] = True
            line += [segments[k][side]] if not line else []
            line.append(segments[k][1 - side])
            k, side = next(((m, s) for m, s in beside[tuple(ends[k][1 - side])] if not used[m]), (None, 0))
        if len(line) > 1:
            found.append(np.array(line))
    return found
