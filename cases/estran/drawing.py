"""Pictures of a snapshot over all programs of a run: cells cut at the water's surface, particles in their size, walls,
bodies. SPDX-License-Identifier: BSD-3-Clause"""
import os

import matplotlib

matplotlib.use('Agg')
import matplotlib.collections as mcollections
import matplotlib.figure as mfigure
import numpy as np

from . import grids, reading

style = {'font.size': 15, 'axes.titlesize': 16, 'axes.linewidth': 0.8, 'xtick.direction': 'out',
         'axes.formatter.useoffset': False, 'axes.formatter.limits': (-4, 5)}
grey, dark = '#a6a6a6', '#303030'
units = {'velocity': 'm/s', 'vorticity': '1/s', 'pressure': 'Pa', 'density': 'kg/m$^3$', 'age': 's', 'level_set': 'm'}
signed = ('vorticity', 'vorticity_exact')


def default_field(run):
    """Velocity under gravity, else vorticity; what there is."""
    heavy = any(run.case.get('fluid', {}).get('gravity', [0]))
    for field in ('velocity', 'vorticity', 'pressure') if heavy else ('vorticity', 'velocity', 'pressure'):
        if field in run.fields:
            return field
    raise LookupError('%s: no field to draw; fields = "..." in group output' % run.dir)


def up_of(run):
    """The axis of the height: 1, or 2 where gravity is along z."""
    g = list(run.case.get('fluid', {}).get('gravity', [])) + [0, 0, 0]
    return 2 if run.dim == 3 and g[2] != 0 and g[1] == 0 else 1


class View:
    """Which points a picture shows: in 3D a plane of constant y or z."""

    def __init__(self, run, plane):
        self.dim, d = run.dim, run.case['domain']
        self.low, self.high = (np.array((list(d[k]) + [0, 0])[:3], float) for k in ('min', 'max'))
        name, _, where = (plane or 'y' if up_of(run) == 2 else plane or 'z').partition('=')
        if name not in ('y', 'z'):
            raise ValueError('plane: y or z, not %s' % name)
        self.across = 'xyz'.index(name) if run.dim == 3 else 2
        self.axes = [0, 3 - self.across]
        self.where = float(where) if where else (self.low[self.across] + self.high[self.across]) / 2
        self.box = [self.low[self.axes[0]], self.high[self.axes[0]], self.low[self.axes[1]], self.high[self.axes[1]]]


def scalar(v, field, parts, across=2):
    """Of a vector its length, of the vorticity its component across the plane."""
    if v.ndim == parts:
        return np.asarray(v, float)
    if field in signed:
        return np.asarray(v[..., across], float)
    return np.sqrt((np.asarray(v, float) ** 2).sum(-1))


def cells(part, field, view):
    """Of each block: places (m, n, 2), values, the share shown, the level set, at points."""
    at = part[field]
    more = {k: part[k] if k in part else [None] * len(at) for k in ('level_set', 'forced')}
    for k, x in enumerate(part.x):
        v = scalar(at[k], field, view.dim, view.across)
        phi, forced, x = more['level_set'][k], more['forced'][k], np.asarray(x, float)
        if view.dim == 3:
            centre = reading.centres(x)[..., view.across]
            a = int(np.argmax([np.ptp(centre, axis=b).max() for b in range(3)]))
            mean = centre.mean(tuple(b for b in range(3) if b != a))
            half = abs(np.diff(mean)).max() / 2 if len(mean) > 1 else np.inf
            if abs(mean - view.where).min() > 1.01 * half:
                continue
            i = int(np.argmin(abs(mean - view.where)))
            v, phi, forced = (None if q is None else q.take(i, a) for q in (v, phi, forced))
            x = x.take([i, i + 1], a).mean(a)
        value, show, phi = grids.water(v, None if phi is None else np.asarray(phi, float), forced)
        yield grids.points(x[..., view.axes]), value, show, phi


def particles(part, field, view):
    """Places (n, 2), values and sizes in m of the particles at the plane."""
    x, v = np.asarray(part.x, float), scalar(part[field], field, 1, view.across)
    size = float(part.attributes.get('dx', 0.01)) * np.ones(len(x))
    if 'level' in part:
        size *= 0.5 ** np.asarray(part['level'])
    keep = np.asarray(part['guard']) < 0.5 if 'guard' in part else np.ones(len(x), bool)
    if view.dim == 3:
        off = abs(x[:, view.across] - view.where)
        keep &= off < 0.6 * size
        order = np.argsort(-off[keep], kind='stable')  # the nearest last
        return x[keep][order][:, view.axes], v[keep][order], size[keep][order]
    return x[keep][:, view.axes], v[keep], size[keep]


def limits(run, field, parts):
    """The range of colours over snapshots: without the outer half per cent of the values."""
    ends, across = [], View(run, None).across
    for snapshot in parts:
        for part in snapshot.values():
            if field in part:
                for v in [part[field]] if part.particles else part[field]:
                    v = scalar(v, field, 1 if part.particles else run.dim, across)
                    if np.isfinite(v).any():
                        ends.append(np.nanpercentile(v, [0.5, 99.5]))
    if not ends:
        raise LookupError('%s: no snapshot with a field %s, only: %s' % (run.dir, field, ', '.join(run.fields)))
    least, most = float(np.min(ends)), float(np.max(ends))
    if field in signed:
        most = max(abs(least), abs(most))
        least = -most
    elif field == 'velocity':
        least = 0.0
    return (least, most) if most > least else (least, least + (abs(least) or 1.0))


def colours(field):
    return 'RdBu_r' if field in signed else 'viridis'


def frame(run, view, window, title, field, scale, width):
    """A figure of that many pixels with axes for the window and a bar of colours."""
    a, b, c, d = window
    left, right, low, top, dpi = 106, 128, 62, 46, 100
    width = int(width * min(1.6, max(1, (b - a) / (d - c) / 5)))  # of a long channel a wide one
    wide = width - left - right
    high = wide * (d - c) / (b - a)
    if high > 560:
        wide, high = 560 * (b - a) / (d - c), 560
    if high < 60:  # of a long channel more than its height, so that there is room for ticks
        c, d = (c + d) / 2 - 30 * (b - a) / wide, (c + d) / 2 + 30 * (b - a) / wide
        high = 60
    full, tall = max(wide + left + right, 560), high + low + top
    figure = mfigure.Figure((full / dpi, tall / dpi), dpi)
    axes = figure.add_axes([(left + (full - left - right - wide) / 2) / full, low / tall, wide / full, high / tall])
    axes.set_aspect('equal')
    axes.set_xlim(a, b)
    axes.set_ylim(c, d)
    axes.set_xlabel('x (m)', labelpad=1)
    axes.set_ylabel('%s (m)' % 'xyz'[view.axes[1]], labelpad=5)
    axes.locator_params(axis='x', nbins=max(2, min(7, int(wide / 80))))
    axes.locator_params(axis='y', nbins=max(2, min(6, int(high / 55))))
    axes.set_title(title, pad=10)
    place = axes.get_position()
    bar = figure.add_axes([place.x1 + 16 / full, low / tall, 20 / full, high / tall])
    mappable = matplotlib.cm.ScalarMappable(matplotlib.colors.Normalize(*scale), colours(field))
    ticks = figure.colorbar(mappable, bar, format=matplotlib.ticker.FuncFormatter(lambda v, _: '%.6g' % v))
    ticks.locator = matplotlib.ticker.MaxNLocator(max(3, min(6, int(high / 60))))
    ticks.update_ticks()
    return figure, axes, mappable


def draw_cells(axes, part, field, view, mappable):
    for k, (x, value, show, phi) in enumerate(cells(part, field, view)):
        fine = [max(1, min(16, int(420 / n) + 1)) for n in value.shape]
        x, value, dry = grids.refined(x, fine), grids.middles(grids.refined(value, fine)), grids.middles(grids.refined(show, fine)) < 0.5
        if phi is not None:
            dry |= ~(grids.middles(grids.refined(phi, fine)) < 0)
        v = np.where(dry, np.nan, value)
        axes.pcolormesh(x[..., 0], x[..., 1], np.ma.masked_invalid(v), norm=mappable.norm, cmap=mappable.cmap,
                        shading='flat', zorder=1 + 0.01 * k, rasterized=True, linewidth=0)


def draw_particles(axes, part, field, view, mappable):
    x, v, size = particles(part, field, view)
    a, b, c, d = axes.get_xlim() + axes.get_ylim()
    margin = size.max() if len(size) else 0
    here = (x[:, 0] > a - margin) & (x[:, 0] < b + margin) & (x[:, 1] > c - margin) & (x[:, 1] < d + margin)
    x, v, size = x[here], v[here], size[here]
    place = axes.get_window_extent()
    point = 72 / axes.figure.dpi * min(place.width / (b - a), place.height / (d - c))  # points a metre
    def scatter(of, factor, zorder):  # discs of a pixel or two would let the ground through: squares
        across = factor * size[of] * point
        small = across.max() < 3 * 72 / axes.figure.dpi
        axes.scatter(x[of, 0], x[of, 1], np.maximum(across, 1.5 * 72 / axes.figure.dpi) ** 2, v[of], 's' if small else 'o', norm=mappable.norm,
                     cmap=mappable.cmap, linewidths=0, zorder=zorder, rasterized=True, antialiased=not small)
    if len(x):
        coarse = size > 1.01 * size.min()
        if coarse.any():  # beneath the finer ones they fill the half spacing that is left at the edge between two levels
            scatter(coarse, 2.0, 1.9)
        scatter(slice(None), 1.42, 2)


def walled_sides(program, view):
    """Lines of the sides of the domain that are walls."""
    (x0, x1, y0, y1), name = view.box, 'xyz'[view.axes[1]]
    lines = {'x_min': [(x0, y0), (x0, y1)], 'x_max': [(x1, y0), (x1, y1)],
             name + '_min': [(x0, y0), (x1, y0)], name + '_max': [(x0, y1), (x1, y1)]}
    for wall in program.case.get('walls', []):
        if wall.get('side') in lines and wall.get('kind', 'slip') in ('slip', 'no_slip'):
            yield lines[wall['side']]


def holds_water(x, corners=None):
    """Whether a body is a tank: its corners run counter-clockwise, its triangles (rows of corners) show out of what is inside."""
    if corners is None:
        return np.sum(x[:, 0] * np.roll(x[:, 1], -1) - np.roll(x[:, 0], -1) * x[:, 1]) > 0
    a, b, c = (x[corners[:, k]] - x.mean(0) for k in range(3))
    return np.sum(a * np.cross(b, c)) > 0


def outlines(program, part, view):
    """Lines of walls and tanks and closed lines of bodies, in the plane."""
    lines, bodies = list(block_walls(program, part, view)), []
    names = [b.get('name') for b in program.case.get('bodies', [])]
    if view.dim == 2:
        for body in (b for b in part.bodies if len(b) > 1):
            tank = holds_water(body)
            (lines if tank else bodies).append(np.concatenate([body, body[:1]]) if tank else body)
        for wall in program.case.get('walls', []):
            if len(wall.get('points', [])) > 1:
                p = np.array([q[:2] for q in wall['points']], float)
                lines.append(np.concatenate([p, p[:1]]) if wall.get('closed') else p)
    for name, (x, corners) in program.triangles().items() if view.dim == 3 else ():
        x = part.meshes.get(name, x)
        if x is not None:
            segments = grids.cut(x, corners, view.across, view.where)
            chains = grids.loops(segments[:, :, view.axes], float(np.max(view.high - view.low)))
            (bodies if name in names and not holds_water(x, corners) else lines).extend(chains)
    for a, b in program.boxes():
        if view.dim == 2 or a[view.across] <= view.where <= b[view.across]:
            i, j = view.axes
            bodies.append(np.array([(a[i], a[j]), (b[i], a[j]), (b[i], b[j]), (a[i], b[j])]))
    return lines, bodies + list(rings(program, part, view))


def block_walls(program, part, view):
    """Sides of blocks of cells that are walls, where they have moved to."""
    if part.blocks and view.dim == 2:
        for block, x in zip(program.case.get('blocks', []), part.x):
            x = np.asarray(x, float)
            for name, side in (('i_min', x[:, 0]), ('i_max', x[:, -1]), ('j_min', x[0]), ('j_max', x[-1])):
                if block.get(name) in ('slip', 'wall'):
                    yield side


def rings(program, part, view):
    """Bodies within rings of cells: closed sides i_min that are walls."""
    if part.blocks and view.dim == 2:
        for block, x in zip(program.case.get('blocks', []), part.x):
            side = np.asarray(x[:, 0], float)
            if block.get('i_min') in ('slip', 'wall') and np.allclose(side[0], side[-1]):
                yield side


def draw_solids(axes, program, part, view):
    lines, bodies = outlines(program, part, view)
    axes.add_collection(mcollections.PolyCollection(bodies, facecolors=grey, edgecolors=dark, linewidths=1.2, zorder=4))
    axes.add_collection(mcollections.LineCollection(lines, colors=dark, linewidths=2.2, zorder=5, capstyle='round'))
    a, b, c, d = axes.get_xlim() + axes.get_ylim()
    for line in walled_sides(program, view):  # in its full width at the frame, not beyond it
        within = all(a - 1e-9 <= x <= b + 1e-9 and c - 1e-9 <= y <= d + 1e-9 for x, y in line)
        axes.add_collection(mcollections.LineCollection([line], colors=dark, linewidths=3, zorder=5, clip_on=not within))


def window_of(run, view, parts):
    """The domain, or the water's part of it if that is small."""
    a, b, c, d = view.box
    if any(not p.particles for s in parts for p in s.values()):
        return view.box
    x = np.concatenate([np.asarray(p.x, float)[:, view.axes] for s in parts for p in s.values()])
    lo, hi = np.percentile(x, 0.2, 0), np.percentile(x, 99.8, 0)
    if (hi[0] - lo[0] > 0.7 * (b - a)) or (hi[1] - lo[1] > 0.7 * (d - c)):
        return view.box
    margin = 0.06 * float((hi - lo).sum())
    lo, hi = lo - margin, hi + margin
    return [max(lo[0], a), min(hi[0], b), max(lo[1], c), min(hi[1], d)]


def title_of(field, time):
    unit = units.get(field)
    return '%s%s,  t = %.4g s' % (field.replace('_', ' '), ' (%s)' % unit if unit else '', time)


def figure_of(run, field, snapshot, scale, window=None, plane=None, width=800):
    """The figure of one snapshot; plane "space": a view of a 3D run from outside."""
    title = title_of(field, snapshot.time)
    with matplotlib.rc_context(style):
        if plane == 'space':
            from . import space
            return space.figure_of(run, field, snapshot, scale, title, width)
        if run.dim == 3:
            view = View(run, plane)
            title += ',  %s = %.3g m' % ('xyz'[view.across], view.where)
        view = View(run, plane)
        window = window or window_of(run, view, [snapshot])
        figure, axes, mappable = frame(run, view, window, title, field, scale, width)
        for name, part in snapshot.items():
            if field in part:
                (draw_particles if part.particles else draw_cells)(axes, part, field, view, mappable)
            draw_solids(axes, run[name], part, view)
        axes.autoscale(False)
    return figure


def plot(run, field=None, n=-1, time=None, window=None, scale=None, plane=None, width=800, to=None):
    """Draws a field of the last snapshot (n: another, time: the nearest) and returns the file's name.
    window: (x0, x1, y0, y1) in m; scale: (least, most) of the colours; plane: "y=0.1" or "z" of a 3D run, or "space"."""
    run = reading.read(run) if isinstance(run, (str, os.PathLike)) else run
    field = field or default_field(run)
    snapshot = run.at(n, time)
    figure = figure_of(run, field, snapshot, scale or limits(run, field, [snapshot]), window, plane, width)
    to = to or os.path.join(run.dir, field + '.png')
    figure.savefig(to)
    return to
