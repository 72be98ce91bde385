"""pairs_scene.py - a scene of pairs.py: its parts, where they lie turned, shifted and in other units, and its case file.
SPDX-License-Identifier: BSD-3-Clause"""
import math

from properties_scene import stl, text

G = 9.81


class Scene:
    """A scene drawn with gravity along the last axis, and the turn, shift and unit in which it is written."""

    def __init__(self, rng, dim):
        self.rng, self.dim = rng, dim
        self.lo, self.hi = [0.0] * dim, [1.0] * dim
        self.periodic = [False] * dim
        self.gravity = True
        self.velocity = [0.0] * dim
        self.nu = 0.0
        self.sides, self.lines, self.bodies, self.shapes, self.probes, self.regions = {}, [], [], [], [], []
        self.dx, self.end, self.sph, self.fv, self.meshes = 0.1, 1.0, "", None, {}
        self.program = "sph"
        self.level = None
        self.blocked = []
        self.laws = {}
        self.unit = 2.0 ** rng.randint(-3, 3)
        self.turn = rng.randrange(4) if dim == 2 else rng.randrange(3)
        self.offset = [rng.choice([0, 0, -3, 5]) for _ in range(dim)]  # in units

    # where the scene really lies: turned by quarters in 2D, by a cycle of axes in 3D
    def vector(self, v):
        if self.dim == 2:
            x, y = v
            return [(x, y), (-y, x), (-x, -y), (y, -x)][self.turn]
        return tuple(v[(a + self.turn) % 3] for a in range(3))

    def point(self, v):
        w = self.vector(v)
        return tuple(self.unit * (w[a] + self.offset[a]) for a in range(self.dim))

    def side(self, axis, way):
        v = [0.0] * self.dim
        v[axis] = way
        w = self.vector(v)
        a = max(range(self.dim), key=lambda k: abs(w[k]))
        return "xyz"[a] + ("_max" if w[a] > 0 else "_min")

    def box(self, lo, hi):
        p, q = self.point(lo), self.point(hi)
        return [min(a, b) for a, b in zip(p, q)], [max(a, b) for a, b in zip(p, q)]

    @property
    def up(self):
        return self.dim - 1

    def speed_unit(self):
        return math.sqrt(self.unit)  # g keeps its value

    def case(self):
        """Its groups, as properties_scene.text has them."""
        points = lambda all_of: [list(self.point(p)) for p in all_of]
        speeds = lambda v: [self.speed_unit() * x + 0.0 for x in self.vector(v)]
        box = lambda p, q: dict(zip(("min", "max"), self.box(p, q)))
        changes = {"velocity": speeds, "level": self.height}
        axes = [self.side(a, 1)[0] for a in range(self.dim)]  # where each axis goes
        turned = lambda values: [values[axes.index(x)] for x in "xyz"[:self.dim]]
        walls = [dict(side=self.side(*at), **{key: changes.get(key, lambda v: v)(value) for key, value in more.items()})
                 for at, more in sorted(self.sides.items())]
        walls += [dict(line, points=points(line["points"])) for line in self.lines]
        walls += [{"mesh": name, "more": mesh.get("more")} for name, mesh in self.meshes.items() if mesh["of"] == "wall"]
        shapes = [{"form": "below", "level": self.height(s[1])} if s[0] == "below" else {"form": "box", "box": self.box(*s[1:])}
                  for s in self.shapes]
        case = {"time": {"end": self.end * math.sqrt(self.unit)},
                "fluid": {"rho": 1000.0, "nu": self.nu * self.unit * self.speed_unit(),
                          "gravity": [-G * self.gravity * x + 0.0 for x in self.vector([float(a == self.up) for a in range(self.dim)])]},
                "domain": {"dim": self.dim, **box(self.lo, self.hi), "periodic": turned(self.periodic)},
                "initial": any(self.velocity) and {"field": "uniform", "U": self.speed_unit() * max(map(abs, self.velocity)),
                                                   "velocity": speeds(self.velocity)},
                "walls": walls, "shapes": shapes,
                "bodies": [dict(b, points=points(b["points"])) if "points" in b else b for b in self.bodies],
                "blocked": [dict(name=name, **box(p, q)) for name, p, q in self.blocked],
                "probes": [{"name": name, "kind": kind, "at": list(self.point(p))} for name, kind, p in self.probes],
                "apr": self.regions and {"regions": [dict(box(*r[:2]), more="".join(r[2:])) for r in self.regions]}}
        if self.program != "fv":
            case["sph"] = {"dx": self.dx * self.unit, "box": self.box(*self.sph_box) if self.program == "coupled" else None, "more": self.sph}
        if self.fv:
            case["fv"] = {"cells": turned(self.fv)}
        return dict(case, output={"more": "snapshots = false;", "series": self.laws.get("series", 5)})

    def text(self):
        return "# %s\n%s" % (self.name, text(self.case(), "%.15g"))

    def height(self, h):
        """Against gravity, as the keys `level' have it."""
        v = [0.0] * self.dim
        v[self.up] = h
        up = [0.0] * self.dim
        up[self.up] = 1.0
        w, u = self.point(v), self.vector(up)
        return sum(a * b for a, b in zip(w, u))

    def solid(self, corners, triangles):
        return stl.solid([["%.15g" % x for x in self.point(c)] for c in corners], triangles)

    def stl(self, name, lo, hi):
        """A box of triangles, normals out of it."""
        corners = [[(lo, hi)[i >> a & 1][a] for a in range(3)] for i in range(8)]
        quads = (0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)
        triangles = [three for a, b, c, d in quads for three in ((a, b, c), (a, c, d))]
        self.meshes[name] = {"text": self.solid(corners, triangles), "of": "body"}

    def sheet(self, name, corners, more):
        """An open wall of two triangles."""
        self.meshes[name] = {"text": self.solid(corners, [(0, 1, 2), (0, 2, 3)]), "of": "wall", "more": more}

    def written(self, v):
        return "(" + ", ".join("%.15g" % x for x in v) + ")"

    # ---------------------------------------------------------------- parts that scenes share
    def tank(self, size, depth, sides="sides"):
        """Cells of dx; open above the water. sides: which of the upright ones are walls."""
        self.hi = [n * self.dx for n in size]
        self.depth = depth * self.dx
        self.level = self.depth
        self.shapes.append(("below", self.depth))
        if sides == "line":
            x, h = self.hi[0], self.hi[1]
            self.lines.append({"points": [(0.0, h), (0.0, 0.0), (x, 0.0), (x, h)]})
        elif sides == "sides":
            for a in range(self.up):
                if not self.periodic[a]:
                    self.sides[a, -1] = self.sides[a, 1] = {}
            self.sides[self.up, -1] = {}
        self.end = 4.0 * math.sqrt(self.depth / G)

    def gauges(self, at):
        for k, share in enumerate((0.3, 0.6)):
            self.probes.append(("p%d" % k, "pressure", list(at) + [share * self.depth]))
        self.probes.append(("level", "level", list(at) + [0.5 * self.dx]))
        self.laws["gauges"] = [0.7 * self.depth, 0.4 * self.depth]

    def block(self, name, lo, hi, more=""):
        """A box-shaped body; remembers what Archimedes wants."""
        if self.dim == 2:
            self.bodies.append({"name": name, "more": more,
                                "points": [(lo[0], lo[1]), (lo[0], hi[1]), (hi[0], hi[1]), (hi[0], lo[1])]})
        else:
            self.stl(name + ".stl", lo, hi)
            self.bodies.append({"name": name, "mesh": name + ".stl", "more": more})
        wet = [h for h in hi]
        if self.level is not None:
            wet[self.up] = min(hi[self.up], self.level)
        volume = math.prod(w - l for w, l in zip(wet, lo))
        sides = [math.prod(wet[b] - lo[b] for b in range(self.dim) if b != a) for a in range(self.dim)]
        middle = self.level - 0.5 * (lo[self.up] + wet[self.up])
        self.laws.setdefault("solids", []).append((name, volume, [1000 * G * middle * s for s in sides]))

    def polygon(self, name, centre, radius, n, angle, more=""):
        points = [(centre[0] + radius * math.cos(angle - 2 * math.pi * k / n),
                   centre[1] + radius * math.sin(angle - 2 * math.pi * k / n)) for k in range(n)]
        area = 0.5 * n * radius * radius * math.sin(2 * math.pi / n)
        self.bodies.append({"name": name, "points": points, "more": more})
        p = 1000 * G * (self.level - centre[1]) * 2 * radius
        self.laws.setdefault("solids", []).append((name, area, [p, p]))
        return points
