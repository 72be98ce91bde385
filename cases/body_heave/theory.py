#!/usr/bin/python3
"""Linear heave of a half-immersed cylinder or sphere let go in a tank -> heave.csv of its case: t sqrt(g/a), z/z0.
usage: theory.py cylinder|sphere [HALF_WIDTH DEPTH]   default: the tank of the case   SPDX-License-Identifier: BSD-3-Clause

Lengths over a, g = rho = 1. Potential flow by boundary elements of constant strength over one half of the tank (of the
square one of the sphere a quarter) and its images: hull and surface at rest, surface conditions eta_t = phi_n, phi_t = -eta,
the hull moved by its buoyancy and phi_t, which is a potential, too, with the hull's acceleration on the hull; so its added
mass without waves is known at once. RK4 in time."""
import os
import sys

import numpy as np

HULL, SURFACE = 0, 1


def closed(G, H, kind):
    """The matrix from what is given (phi on the surface, phi_n elsewhere) to the other of the two."""
    np.fill_diagonal(H, 0)
    np.fill_diagonal(H, -H.sum(1))  # a constant potential has no flux
    given = (kind == SURFACE)[None]
    return np.linalg.solve(np.where(given, -G, H), np.where(given, -H, G))


def lines(half, depth):
    """Middles, sides, lengths, normals out of the fluid and kinds of the elements around a half of the tank."""
    turn = np.linspace(-np.pi / 2, 0, 61)
    grow = np.expm1(1.5 * np.linspace(0, 1, 201)) / np.expm1(1.5)
    parts = [np.c_[np.cos(turn), np.sin(turn)], np.c_[1 + (half - 1) * grow, 0 * grow],
             np.c_[np.full(31, half), np.linspace(0, -depth, 31)],
             np.c_[np.linspace(half, 0, 61), np.full(61, -depth)]]
    ends = np.concatenate([np.stack([x[:-1], x[1:]], 1) for x in parts])
    kind = np.repeat(np.arange(4), [len(x) - 1 for x in parts])
    along = ends[:, 1] - ends[:, 0]
    length = np.hypot(*along.T)
    return ends.mean(1), along, length, np.c_[-along[:, 1], along[:, 0]] / length[:, None], kind


def cylinder(half, depth):
    """Matrix; areas of the whole tank, heights of the normals, kinds of the elements; waterplane and mass of the hull."""
    middle, along, length, normal, kind = lines(half, depth)
    n = len(length)
    G, H = np.zeros((n, n)), np.zeros((n, n))
    for mirror in ([1, 1], [-1, 1]):
        for at, weight in zip(*np.polynomial.legendre.leggauss(6)):
            d = (middle + 0.5 * at * along) * mirror - middle[:, None]
            r2 = (d**2).sum(2)
            part = 0.5 * weight * length / (2 * np.pi)
            g, h = -0.5 * np.log(r2) * part, -(d * (normal * mirror)).sum(2) / r2 * part
            if mirror[0] > 0:  # of an element on itself: in closed form below
                np.fill_diagonal(g, 0), np.fill_diagonal(h, 0)
            G += g
            H += h
    G[np.diag_indices(n)] -= length * (np.log(length / 2) - 1) / (2 * np.pi)
    return closed(G, H, kind), 2 * length, normal[:, 1], kind, 2, np.pi / 2


def patch(place, n, m):
    """Corners [n m][4][3] of the quadrilaterals between the places of a grid, place(i/n, j/m)."""
    grid = np.array([[place(i / n, j / m) for j in range(m + 1)] for i in range(n + 1)], float)
    return np.stack([grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]], 2).reshape(-1, 4, 3)


def quadrilaterals(half, depth, turns=12, rings=18, rows=9):
    """Corners of the elements and their kind: hull, surface, two walls, floor."""
    def sphere(i, j):
        down, round_ = i * np.pi / 2, j * np.pi / 2
        return np.sin(down) * np.cos(round_), np.sin(down) * np.sin(round_), -np.cos(down)

    def surface(i, j):
        way = np.array([np.cos(j * np.pi / 2), np.sin(j * np.pi / 2)])
        r = 1 + (half / way.max() - 1) * np.expm1(1.2 * i) / np.expm1(1.2)
        return r * way[0], r * way[1], 0
    parts = [patch(sphere, turns, turns), patch(surface, rings, turns),
             patch(lambda i, j: (half, i * half, -j * depth), rows, rows),
             patch(lambda i, j: (i * half, half, -j * depth), rows, rows),
             patch(lambda i, j: (i * half, j * half, -depth), rows, rows)]
    return np.concatenate(parts), np.repeat(np.arange(5), [len(p) for p in parts])


def on_itself(corners):
    """The integral of 1/r over a quadrilateral from its middle: four triangles."""
    total = 0
    for a, b in zip(corners - corners.mean(0), np.roll(corners, -1, 0) - corners.mean(0)):
        side = np.linalg.norm(b - a)
        if side > 1e-9:
            along = (b - a) / side
            height = np.sqrt(max(a @ a - (a @ along)**2, 1e-30))
            total += height * (np.arcsinh(b @ along / height) - np.arcsinh(a @ along / height))
    return total


def sphere(half, depth):
    """The same around a quarter of the tank."""
    corners, kind = quadrilaterals(half, depth)
    middle = corners.mean(1)
    across = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]) / 2
    outward = np.array([[0, 0, 0], [0, 0, 1], [1, 0, 0], [0, 1, 0], [0, 0, -1]])[kind] - (kind == HULL)[:, None] * middle
    across *= np.sign((across * outward).sum(1))[:, None]
    area = np.linalg.norm(across, axis=1)
    normal = across / area[:, None]
    n = len(kind)
    G, H = np.zeros((n, n)), np.zeros((n, n))
    points, weights = np.polynomial.legendre.leggauss(4)
    for mirror in ([1, 1, 1], [-1, 1, 1], [1, -1, 1], [-1, -1, 1]):
        for u, wu in zip(points, weights):
            for v, wv in zip(points, weights):
                shape = np.array([(1 - u) * (1 - v), (1 + u) * (1 - v), (1 + u) * (1 + v), (1 - u) * (1 + v)]) / 4
                by_u = np.array([v - 1, 1 - v, 1 + v, -1 - v]) @ corners / 4
                by_v = np.array([u - 1, -1 - u, 1 + u, 1 - u]) @ corners / 4
                part = wu * wv * np.linalg.norm(np.cross(by_u, by_v), axis=1) / (4 * np.pi)
                d = (shape @ corners) * mirror - middle[:, None]
                r = np.sqrt((d**2).sum(2))
                g, h = part / r, -(d * (normal * mirror)).sum(2) / r**3 * part
                if min(mirror) > 0:
                    np.fill_diagonal(g, 0), np.fill_diagonal(h, 0)
                G += g
                H += h
    G[np.diag_indices(n)] += [on_itself(c) / (4 * np.pi) for c in corners]
    return closed(G, H, kind), 4 * area, normal[:, 2], kind, np.pi, 2 * np.pi / 3


def heave(form, half, depth, end, dt=0.02):
    """t and z/z0 of the hull let go at rest, and its added mass without waves over its mass."""
    other, area, up, kind, waterplane, mass = form(half, depth)
    surface, hull = kind == SURFACE, kind == HULL
    n = surface.sum()
    unit = np.where(hull, up, 0)  # phi_n of the hull that moves at 1
    lift = unit * area
    added = lift @ (other @ unit)
    rise, by_hull, pull = other[np.ix_(surface, surface)], (other @ unit)[surface], (lift @ other)[surface]

    def rates(y):
        eta, phi, z, v = y[:n], y[n:2 * n], y[-2], y[-1]
        return np.r_[rise @ phi + by_hull * v, -eta, v, (pull @ eta - waterplane * z) / (mass + added)]
    y = np.zeros(2 * n + 2)
    y[-2] = 1
    z = [1.0]
    for _ in range(round(end / dt)):
        k1 = rates(y)
        k2 = rates(y + dt / 2 * k1)
        k3 = rates(y + dt / 2 * k2)
        y = y + dt / 6 * (k1 + 2 * k2 + 2 * k3 + rates(y + dt * k3))
        z.append(y[-2])
    return dt * np.arange(len(z)), np.array(z), added / mass


FORMS = {'cylinder': (cylinder, 12, 5, 9, 'body_heave'), 'sphere': (sphere, 4, 3, 8, 'body_sphere')}

if __name__ == '__main__':
    if len(sys.argv) not in (2, 4) or sys.argv[1] not in FORMS:
        sys.exit(__doc__.split('\n')[1])
    form, half, depth, end, case = FORMS[sys.argv[1]]
    t, z, added = heave(form, *(map(float, sys.argv[2:]) if len(sys.argv) > 2 else (half, depth)), end)
    low = np.argmin(z[t < 5])
    high = low + np.argmax(z[low:])
    zero = np.argmax(z < 0)
    print('added mass without waves %.3f of the mass; first zero at %.3f, least %.3f at %.2f, next %.3f at %.2f' % (
        added, t[zero] - z[zero] * (t[1] - t[0]) / (z[zero] - z[zero - 1]), z[low], t[low], z[high], t[high]))
    if len(sys.argv) == 2:
        with open(os.path.join(os.path.dirname(os.path.realpath(__file__)), '..', case, 'heave.csv'), 'w') as to:
            to.write('# linear theory in the tank of case.cfg (body_heave/theory.py): t sqrt(g/a), z/z0\nt, z\n')
            to.writelines('%.2f, %.4f\n' % row for row in list(zip(t, z))[::10])
