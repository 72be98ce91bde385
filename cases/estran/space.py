"""A 3D snapshot seen from outside: the water's surface, particles, bodies, tanks; drawn from the back to the front.
SPDX-License-Identifier: BSD-3-Clause"""
import matplotlib
import matplotlib.collections as mcollections
import numpy as np

from . import drawing, grids

light = np.array([0.35, -0.5, 0.8]) / np.linalg.norm([0.35, -0.5, 0.8])
hexagon = np.array([(np.cos(a), np.sin(a)) for a in np.arange(6) * np.pi / 3])


class Eye:
    """Parallel projection from the front, to the right and above."""

    def __init__(self, up, turn=-25, height=22):
        a, e = np.radians(turn), np.radians(height)
        self.up = up
        self.right = np.array([np.cos(a), np.sin(a), 0])
        self.back = np.array([-np.sin(a) * np.cos(e), np.cos(a) * np.cos(e), -np.sin(e)])
        self.over = np.cross(self.right, self.back)

    def turned(self, x):  # x to the right, y to the back, z up
        return np.stack([x[..., 0], -x[..., 2], x[..., 1]], -1) if self.up == 1 else x

    def __call__(self, x):
        """Places in the picture and depths."""
        x = self.turned(x)
        return np.stack([x @ self.right, x @ self.over], -1), x @ self.back

    def shade(self, faces):
        """Brightness of faces (n, m, 3)."""
        f = self.turned(faces)
        normal = np.cross(f[:, 1] - f[:, 0], f[:, 2] - f[:, 0])
        normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
        return 0.62 + 0.38 * abs(normal @ light)


class Scene:
    def __init__(self, eye):
        self.eye, self.faces, self.depths, self.colours = eye, [], [], []

    def add(self, faces, colours, depth):
        self.faces += list(faces)
        self.depths.append(depth)
        self.colours.append(colours)

    def add_faces(self, faces, colours):
        flat, depth = self.eye(faces)
        shaded = np.array(colours, float)
        shaded[:, :3] *= self.eye.shade(faces)[:, None]
        self.add(flat, shaded, depth.mean(1))

    def add_balls(self, x, colours, radius):
        flat, depth = self.eye(x)
        keep = nearest(flat, depth, np.median(radius))
        flat, depth, radius, shaded = flat[keep], depth[keep], radius[keep], np.array(colours[keep], float)
        self.add(flat[:, None] + radius[:, None, None] * hexagon, shaded, depth)

    def collection(self):
        order = np.argsort(-np.concatenate(self.depths), kind='stable') if self.depths else []
        colours = np.concatenate(self.colours)[order] if self.colours else []
        return mcollections.PolyCollection([self.faces[k] for k in order], facecolors=colours, edgecolors=colours,
                                           linewidths=0.2, antialiaseds=False, rasterized=True)


def nearest(flat, depth, size):
    """Of the particles behind each other the first three."""
    cell = np.round(flat / size).astype(np.int64)
    order = np.lexsort((depth, cell[:, 1], cell[:, 0]))
    c = cell[order]
    first = np.concatenate([[True], (c[1:] != c[:-1]).any(1)])
    place = np.arange(len(c)) - np.maximum.accumulate(np.where(first, np.arange(len(c)), 0))
    return order[place < 3]


def add_cells(scene, part, field, mappable, dim=3):
    at = part[field]
    for k, x in enumerate(part.x):
        v = drawing.scalar(at[k], field, 3)
        phi = np.asarray(part['level_set'][k], float) if 'level_set' in part else -np.ones(v.shape)
        forced = part['forced'][k] if 'forced' in part else np.zeros(v.shape)
        value, show, phi = grids.water(v, phi, forced)
        phi = np.where(show < 0.5, abs(phi).max(), phi)
        x, span = grids.points(np.asarray(x, float)), abs(phi[np.isfinite(phi)]).max()
        pad = lambda q, **how: np.pad(q, [(1, 1)] * 3 + [(0, 0)] * (q.ndim - 3), **how)
        phi = pad(np.nan_to_num(phi, nan=span), mode='constant', constant_values=span)
        faces, values = grids.nets(pad(x, mode='edge'), phi, pad(value, mode='edge'))
        scene.add_faces(faces, mappable.to_rgba(values))


def add_particles(scene, part, field, mappable):
    x, v = np.asarray(part.x, float), drawing.scalar(part[field], field, 1)
    radius = 0.7 * float(part.attributes.get('dx', 0.01)) * np.ones(len(x))
    if 'level' in part:
        radius *= 0.5 ** np.asarray(part['level'])
    scene.add_balls(x, mappable.to_rgba(v), radius)


def add_solids(scene, program, part):
    names = [b.get('name') for b in program.case.get('bodies', [])]
    grey = matplotlib.colors.to_rgba(drawing.grey)
    for name, (x, corners) in program.triangles().items():
        x = part.meshes.get(name, x)
        if x is not None and name in names and not drawing.holds_water(x, corners):  # a tank would hide what is in it
            scene.add_faces(x[corners], np.tile(grey, (len(corners), 1)))
    for box in program.boxes():
        faces = sides(*box)
        scene.add_faces(faces, np.tile(grey, (6, 1)))


def sides(a, b):
    corner = np.array([[(a, b)[i >> k & 1][k] for k in range(3)] for i in range(8)])
    return corner[[(0, 2, 6, 4), (1, 3, 7, 5), (0, 1, 5, 4), (2, 3, 7, 6), (0, 1, 3, 2), (4, 5, 7, 6)]]


def extent(run, snapshot):
    """Corners of what there is to see: the domain, or the water where that is far smaller."""
    d = run.case['domain']
    return np.array(d['min'], float), np.array(d['max'], float)


def figure_of(run, field, snapshot, scale, title, width):
    eye = Eye(drawing.up_of(run))
    low, high = extent(run, snapshot)
    corners = sides(low, high).reshape(-1, 3)
    flat = eye(corners)[0]
    margin = 0.02 * np.ptp(flat[:, 0])
    window = [flat[:, 0].min() - margin, flat[:, 0].max() + margin, flat[:, 1].min() - margin, flat[:, 1].max() + margin]
    figure, axes, mappable = drawing.frame(run, drawing.View(run, None), window, title, field, scale, width)
    scene = Scene(eye)
    for name, part in snapshot.items():
        if field in part:
            (add_particles if part.particles else add_cells)(scene, part, field, mappable)
        add_solids(scene, run[name], part)
    edges = [eye(f[[0, 1, 2, 3, 0]])[0] for f in sides(low, high)]
    axes.add_collection(mcollections.LineCollection(edges, colors='#808080', linewidths=1, zorder=0.5))
    axes.add_collection(scene.collection())
    label(axes, eye, low, high)
    return figure


def label(axes, eye, low, high):
    """Lengths of the domain on three of its edges instead of axes."""
    axes.set_axis_off()
    axes.title.set_visible(True)
    corners = np.array([[(low, high)[i >> k & 1][k] for k in range(3)] for i in range(8)])
    flat = eye(corners)[0]
    for a, side in ((0, 1), (eye.up, 0)):  # the lowest edge along x, the leftmost upright one
        i = min((i for i in range(8) if not i >> a & 1), key=lambda i: flat[[i, i | 1 << a], side].sum())
        middle = flat[[i, i | 1 << a]].mean(0)
        axes.annotate('%s: %.3g m' % ('xyz'[a], high[a] - low[a]), middle, (0, -8) if a == 0 else (-8, 0),
                      textcoords='offset points', ha='center' if a == 0 else 'right', va='top' if a == 0 else 'center',
                      rotation=0 if a == 0 else 90)
