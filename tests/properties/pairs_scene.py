"""pairs_scene.py - a scene of pairs.py: its parts, where they lie turned, shifted and in other units, and its case file.
SPDX-License-Identifier: BSD-3-Clause"""
import math

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

    def text(self):
        t = lambda v: "(" + ", ".join("%.15g" % (x + 0.0) for x in v) + ")"
        down = [0.0] * self.dim
        if self.gravity:
            down[self.up] = -G
        lo, hi = self.box(self.lo, self.hi)
        axes = [max(range(self.dim), key=lambda k: abs(self.vector([float(a == b) for b in range(self.dim)])[k]))
                for a in range(self.dim)]
        periodic = [False] * self.dim
        for a in range(self.dim):
            periodic[axes[a]] = self.periodic[a]
        out = ["# %s" % self.name, "format = 1;",
               "time:   { end = %.15g; };" % (self.end * math.sqrt(self.unit)),
               "fluid:  { rho = 1000.0; nu = %.15g; gravity = %s; };"
               % (self.nu * self.unit * self.speed_unit(), t(self.vector(down))),
               "domain: { dim = %d; min = %s; max = %s; periodic = (%s); };"
               % (self.dim, t(lo), t(hi), ", ".join("true" if p else "false" for p in periodic))]
        if any(self.velocity):
            out.append('initial: { field = "uniform"; U = %.15g; velocity = %s; };'
                       % (self.speed_unit() * max(map(abs, self.velocity)),
                          t([self.speed_unit() * x for x in self.vector(self.velocity)])))
        walls = []
        for (axis, way), more in sorted(self.sides.items()):
            words = ""
            for key, value in more.items():
                if key == "velocity":
                    value = t([self.speed_unit() * x for x in self.vector(value)])
                elif isinstance(value, str):
                    value = '"%s"' % value
                elif key == "level":
                    value = "%.15g" % self.height(value)
                words += " %s = %s;" % (key, value)
            walls.append('{ side = "%s";%s }' % (self.side(axis, way), words))
        for line in self.lines:
            walls.append("{ points = (%s);%s }" % (", ".join(t(self.point(p)) for p in line["points"]),
                                                   " closed = true;" if line.get("closed") else ""))
        for name, mesh in self.meshes.items():
            if mesh["of"] == "wall":
                walls.append('{ mesh = "%s"; %s}' % (name, mesh.get("more", "")))
        if walls:
            out.append("walls:  ( %s );" % ",\n          ".join(walls))
        shapes = []
        for s in self.shapes:
            if s[0] == "below":
                shapes.append('{ form = "below"; level = %.15g; }' % self.height(s[1]))
            else:
                shapes.append('{ form = "box"; box = (%s, %s); }' % tuple(map(t, self.box(*s[1:]))))
        if shapes:
            out.append("shapes: ( %s );" % ", ".join(shapes))
        bodies = []
        for b in self.bodies:
            where = ('mesh = "%s";' % b["mesh"] if "mesh" in b
                     else "points = (%s);" % ", ".join(t(self.point(p)) for p in b["points"]))
            bodies.append('{ name = "%s"; %s %s }' % (b["name"], where, b.get("more", "")))
        if bodies:
            out.append("bodies: ( %s );" % ",\n          ".join(bodies))
        if self.blocked:
            out.append("blocked: ( %s );" % ", ".join('{ name = "%s"; min = %s; max = %s; }' % ((n,) + tuple(
                map(t, self.box(p, q)))) for n, p, q in self.blocked))
        if self.probes:
            out.append("probes: ( %s );" % ",\n          ".join(
                '{ name = "%s"; kind = "%s"; at = %s; }' % (n, k, t(self.point(p))) for n, k, p in self.probes))
        if self.regions:
            out.append("apr:    { regions = ( %s ); };" % ", ".join(
                "{ min = %s; max = %s; %s}" % (*map(t, self.box(*r[:2])), "".join(r[2:])) for r in self.regions))
        if self.program != "fv":
            box = ""
            if self.program == "coupled":
                box = " box = (%s, %s);" % tuple(map(t, self.box(*self.sph_box)))
            out.append("sph:    { dx = %.15g;%s%s };" % (self.dx * self.unit, box, self.sph))
        if self.fv:
            cells = [1] * self.dim
            for a in range(self.dim):
                cells[axes[a]] = self.fv[a]
            out.append("fv:     { cells = (%s); };" % ", ".join(map(str, cells)))
        out.append("output: { snapshots = false; series = %d; };" % self.laws.get("series", 5))
        return "\n".join(out) + "\n"

    def height(self, h):
        """Against gravity, as the keys `level' have it."""
        v = [0.0] * self.dim
        v[self.up] = h
        up = [0.0] * self.dim
        up[self.up] = 1.0
        w, u = self.point(v), self.vector(up)
        return sum(a * b for a, b in zip(w, u))

    def stl(self, name, lo, hi, leave=()):
        """A box of triangles, normals out of it."""
        corners = [[(lo, hi)[i >> a & 1][a] for a in range(3)] for i in range(8)]
        quads = {"x-": (0, 4, 6, 2), "x+": (1, 3, 7, 5), "y-": (0, 1, 5, 4), "y+": (2, 6, 7, 3),
                 "z-": (0, 2, 3, 1), "z+": (4, 5, 7, 6)}
        text = "solid s\n"
        for key, q in quads.items():
            if key in leave:
                continue
            for tri in ((q[0], q[1], q[2]), (q[0], q[2], q[3])):
                text += "facet normal 0 0 0\nouter loop\n"
                for i in tri:
                    text += "vertex %.15g %.15g %.15g\n" % self.point(corners[i])
                text += "endloop\nendfacet\n"
        self.meshes[name] = {"text": text + "endsolid s\n", "of": "body"}

    def sheet(self, name, corners, more):
        """An open wall of two triangles."""
        text = "solid s\n"
        for tri in ((0, 1, 2), (0, 2, 3)):
            text += "facet normal 0 0 0\nouter loop\n"
            text += "".join("vertex %.15g %.15g %.15g\n" % self.point(corners[i]) for i in tri)
            text += "endloop\nendfacet\n"
        self.meshes[name] = {"text": text + "endsolid s\n", "of": "wall", "more": more}

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
