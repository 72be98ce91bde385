"""pairs_draw.py - the scenes of pairs.py: a function draws one of each pair, PAIRS has their names.
SPDX-License-Identifier: BSD-3-Clause"""
import math
import random

from pairs_scene import G, Scene

LEAST_GAP = 1.0  # dx

# ------------------------------------------------------------------ pairs: water at rest, sph

def gap_of(rng):
    return rng.uniform(LEAST_GAP, 5.0)


def tank2(rng, sides="sides", wide=(24, 40), deep=(14, 26)):
    s = Scene(rng, 2)
    s.dx = 1.0 / rng.choice([16, 20, 25, 32])
    if sides == "period":
        s.periodic[0] = True
        sides = "sides"
    size = [rng.randint(*wide), 0]
    depth = rng.randint(*deep)
    size[1] = depth + rng.randint(6, 10)
    s.tank(size, depth, sides)
    s.n, s.d = size, depth
    return s


def block_at(s, rng, near, name="b", more=""):
    """Block of random size whose face stands a random gap from the floor, a side, the period or both."""
    w, h = rng.uniform(4, 9) * s.dx, rng.uniform(4, min(9, s.d - 7)) * s.dx
    x = 0.5 * (s.hi[0] - w) + rng.uniform(-2, 2) * s.dx
    y = 0.5 * (s.depth - h)
    if "floor" in near:
        y = gap_of(rng) * s.dx
    if "side" in near:
        x = gap_of(rng) * s.dx if rng.random() < 0.5 else s.hi[0] - w - gap_of(rng) * s.dx
    if "across" in near:  # of a period
        x = rng.uniform(-0.4, 2.5) * s.dx
    s.block(name, [x, y], [x + w, y + h], more)
    s.gauges([(x + w + 0.5 * (s.hi[0] - x - w)) % s.hi[0]])


def body_floor(rng):
    s = tank2(rng, rng.choice(["sides", "line"]))
    block_at(s, rng, ["floor"])
    return s


def body_side(rng):
    s = tank2(rng, rng.choice(["sides", "line"]))
    block_at(s, rng, ["side"])
    return s


def body_corner(rng):
    s = tank2(rng, rng.choice(["sides", "line"]))
    block_at(s, rng, ["side", "floor"])
    return s


def body_period(rng):
    s = tank2(rng, "period")
    block_at(s, rng, rng.choice([["across"], ["side"], ["across", "floor"]]))
    return s


def line_period(rng):
    """A bed that goes on beyond the period or ends on it, with a step within the support of it; an obstacle across it."""
    s = tank2(rng, "period", wide=(30, 40))
    over, h, w, x = rng.uniform(0, 3) * s.dx, rng.uniform(3, 6) * s.dx, rng.uniform(4, 8) * s.dx, rng.uniform(0.5, 4) * s.dx
    if rng.random() < 0.5:
        s.sides = {}
        s.lines.append({"points": [(-over, 0), (x, 0), (x, h), (x + w, h), (x + w, 0), (s.hi[0] + over, 0)]})
    else:
        x, y = rng.uniform(-0.8, -0.2) * w, rng.choice([0.0, gap_of(rng) * s.dx])
        s.lines.append({"points": [(x, y), (x, y + h), (x + w, y + h), (x + w, y)], "closed": True})
    s.gauges([0.6 * s.hi[0]])
    return s


def body_body(rng):
    s = tank2(rng, wide=(34, 44))
    y, w, h = 4 * s.dx, rng.uniform(4, 8) * s.dx, rng.uniform(4, s.d - 9) * s.dx
    x = 6 * s.dx
    s.block("b", [x, y], [x + w, y + h])
    w2, h2 = rng.uniform(4, 8) * s.dx, rng.uniform(4, s.d - 9) * s.dx
    x2 = x + w + gap_of(rng) * s.dx
    s.block("c", [x2, y], [x2 + w2, y + h2])
    s.gauges([0.5 * (x2 + w2 + s.hi[0])])
    return s


def polygon_floor(rng):
    s = tank2(rng, rng.choice(["sides", "line"]), deep=(18, 26))
    r, n = rng.uniform(3.5, 5.5) * s.dx, rng.choice([3, 4, 5, 6, 12, 40])
    low = gap_of(rng) * s.dx
    angle = rng.uniform(0, 6.28)
    lowest = min(math.sin(angle - 2 * math.pi * k / n) for k in range(n))
    s.polygon("b", (0.5 * s.hi[0], low - r * lowest), r, n, angle)
    s.gauges([0.25 * (s.hi[0] - 2 * r)])
    return s


def leant(rng, n, r, walls):
    """Corners of a regular polygon about its middle, turned so that it stands on a corner: no face makes less than
    4.4 degrees with any of these directions (1: a floor, 2: a side, too)."""
    least = math.radians(4.4)
    for _ in range(1000):
        turn = rng.uniform(0, 2 * math.pi / n)
        faces = [(turn + 2 * math.pi * (k + 0.5) / n + 0.5 * math.pi) % (math.pi / walls) for k in range(n)]
        if all(least <= f <= math.pi / walls - least for f in faces):
            break
    else:
        turn = 0.5 * math.pi
    return [(r * math.cos(turn - 2 * math.pi * k / n), r * math.sin(turn - 2 * math.pi * k / n)) for k in range(n)]


def stand(s, name, points, x, y):
    """A polygon whose middle (None: whose lowest, leftmost corner) comes to x and y."""
    dx = -min(p[0] for p in points) if x is None else x
    dy = -min(p[1] for p in points) if y is None else y
    points = [(a + dx, b + dy) for a, b in points]
    n = len(points)
    area = abs(0.5 * sum(points[i][0] * points[(i + 1) % n][1] - points[(i + 1) % n][0] * points[i][1] for i in range(n)))
    s.bodies.append({"name": name, "points": points, "more": ""})
    p = 1000 * G * (s.level - dy) * (max(q[1] for q in points) - min(q[1] for q in points))
    s.laws.setdefault("solids", []).append((name, area, [p, p]))
    return points


def wedge_floor(rng):
    """A corner of a body stands on the floor, the side, or in the corner of both, with wedges of 4 to 70 degrees."""
    s = tank2(rng, "sides", wide=(32, 40), deep=(20, 26))
    n, r, where = rng.choice([3, 4, 5, 6, 40]), rng.uniform(4.5, 6) * s.dx, rng.choice(["floor", "floor", "side", "corner"])
    if n in (4, 40) and where == "corner":  # stands on a face, or on both
        where = "side"
    points = leant(rng, n, r, 2 if where == "corner" else 1)
    if where == "side":
        points = [(y, -x) for x, y in points]
    stand(s, "b", points, 0.5 * s.hi[0] if where == "floor" else None, 0.5 * s.depth if where == "side" else None)
    s.gauges([s.hi[0] - 5 * s.dx])
    return s


def flap_floor(rng):
    """A flap that stands on a point on the floor or a side, its end in the water: it has its lift, or nothing turns it."""
    s = tank2(rng, "sides", wide=(34, 40), deep=(22, 26))
    w, h, tip = rng.uniform(4.5, 7) * s.dx, rng.uniform(8, 14) * s.dx, rng.uniform(2, 4) * s.dx
    points = [(0.0, 0.0), (-0.5 * w, tip), (-0.5 * w, h), (0.5 * w, h), (0.5 * w, tip)]
    where = (0.5 * s.hi[0], 0.0)
    if rng.random() < 0.5:
        points, where = [(y, -x) for x, y in points], (0.0, 0.5 * s.depth)
    stand(s, "b", points, where[0], where[1])
    if rng.random() < 0.5:
        s.laws.pop("solids")
        s.bodies[0]["more"] = "free = true; density = 1000.0; hinge = { at = %s; };" % s.written(s.point(where))
        s.laws["turns"] = [("b", h)]
    s.gauges([s.hi[0] - 5 * s.dx])
    return s


def wedge_body(rng):
    """A corner of a body stands on the face of another that stands free in the water."""
    s = tank2(rng, "sides", wide=(32, 40), deep=(24, 28))
    n, r = rng.choice([3, 4, 5, 6, 40]), rng.uniform(4.5, 5) * s.dx
    w, y = rng.uniform(8, 12) * s.dx, 5 * s.dx
    x = 0.5 * (s.hi[0] - w)
    s.block("c", [x, y], [x + w, y + 5 * s.dx])
    points = leant(rng, n, r, 1)
    low = min(points, key=lambda p: p[1])
    stand(s, "b", points, x + 0.5 * w - low[0], y + 5 * s.dx - low[1])
    s.gauges([s.hi[0] - 5 * s.dx])
    return s


def body_stack(rng):
    """A block that stands on another one, free in the water, off it to either side by up to all but three spacings: no water
    between, so each has its buoyancy less, or more, p on what they share."""
    s = tank2(rng, "sides", wide=(32, 40), deep=(22, 28))
    w, v, low, h = rng.uniform(4, 9) * s.dx, rng.uniform(4, 9) * s.dx, 5 * s.dx, rng.uniform(4, 6) * s.dx
    x = 0.5 * (s.hi[0] - w)
    y = x + rng.uniform(3 * s.dx - v, w - 3 * s.dx)
    s.block("c", [x, low], [x + w, low + h])
    s.block("b", [y, low + h], [y + v, low + 2 * h])
    shared = min(x + w, y + v) - max(x, y)
    p = 1000 * G * (s.depth - low - h)
    volumes = [1000 * G * volume for _, volume, _ in s.laws.pop("solids")]
    s.laws["pushed"] = [(name, [0.0, lift + sign * p * shared], max(p * shared, lift))
                        for name, lift, sign in (("c", volumes[0], 1), ("b", volumes[1], -1))]
    s.gauges([s.hi[0] - 5 * s.dx])
    return s


def kept(points, before):
    """The part of a polygon where a linear function of the place is not negative."""
    out = []
    for (p, q) in zip(points, points[1:] + points[:1]):
        a, b = before(p), before(q)
        if a >= 0:
            out.append(p)
        if a * b < 0:
            out.append(tuple(x + a / (a - b) * (y - x) for x, y in zip(p, q)))
    return out


def body_sunk(rng):
    """A body that stands in the floor, a side or a sloping bed: its wet faces have the buoyancy of what is inside the tank,
    less what water would push on the cut."""
    s = tank2(rng, "sides", wide=(30, 40), deep=(18, 26))
    n, r, where = rng.choice([4, 40]), rng.uniform(4.5, 6) * s.dx, rng.choice(["floor", "side", "bed"])
    deep, angle = rng.uniform(-0.4, 0.4) * r, rng.uniform(0, 6.28)
    slope = rng.uniform(0.2, 0.6) if where == "bed" else 0.0
    x, y = (deep, 0.45 * s.depth) if where == "side" else (0.5 * s.hi[0], deep)
    if where == "bed":
        s.lines.append({"points": [(0.35 * s.hi[0], 0.0), (s.hi[0], 0.65 * slope * s.hi[0])]})
        y += slope * (x - 0.35 * s.hi[0])
    points = s.polygon("b", (x, y), r, n, angle)
    s.laws.pop("solids")
    before = (lambda p: p[0]) if where == "side" else (lambda p: p[1] - slope * (p[0] - 0.35 * s.hi[0]))
    inside = kept(points, before)
    cut = sorted(p for p in inside if abs(before(p)) < 1e-12 * s.hi[0])
    area = abs(0.5 * sum(p[0] * q[1] - q[0] * p[1] for p, q in zip(inside, inside[1:] + inside[:1])))
    (x0, y0), (x1, y1) = cut[0], cut[-1]
    p = 1000 * G * (s.depth - 0.5 * (y0 + y1))  # of water on the cut, pushed into the tank
    push = (p * abs(y1 - y0), 0.0) if where == "side" else (-p * (y1 - y0), p * (x1 - x0))
    force = [-push[0], 1000 * G * area - push[1]]
    s.laws["pushed"] = [("b", force, max(math.hypot(*push), 1000 * G * area))]
    s.gauges([s.hi[0] - 5 * s.dx if where != "bed" else 3 * s.dx])
    return s


def body_surface(rng):
    s = tank2(rng, wide=(30, 40), deep=(16, 24))
    w = rng.uniform(6, 10) * s.dx
    x, y = 0.5 * (s.hi[0] - w), s.depth - rng.uniform(4, 9) * s.dx
    s.block("b", [x, y], [x + w, s.depth + rng.uniform(1.5, 4) * s.dx])
    s.gauges([0.25 * (s.hi[0] - w)])
    return s


def body_lid(rng):  # a top under or at the surface
    s = tank2(rng, wide=(30, 40), deep=(16, 24))
    w, h = rng.uniform(6, 10) * s.dx, rng.uniform(4, 7) * s.dx
    x, y = 0.5 * (s.hi[0] - w), s.depth - h - rng.uniform(2, 5) * s.dx
    s.block("b", [x, y], [x + w, y + h])
    s.gauges([0.25 * (s.hi[0] - w)])
    return s


def body_roof(rng):
    """A tank that shapes fill up to its roof, no air in it, with a block near the roof, the floor or a side."""
    s = tank2(rng)
    block_at(s, rng, rng.choice([["floor"], ["side"], []]))
    if rng.random() < 0.5:
        low, high = s.bodies[0]["points"][0][1], s.bodies[0]["points"][1][1]
        up = s.depth - gap_of(rng) * s.dx - high
        s.bodies[0]["points"] = [(x, y + up) for x, y in s.bodies[0]["points"]]
        name, volume, pa = s.laws["solids"][0]
        s.laws["solids"] = [(name, volume, [p - 1000 * G * up * (high - low) for p in pa])]
    s.hi[1] = s.depth
    s.sides[1, 1] = {}
    s.probes.pop()  # there is no level
    return s


def shut_slab(rng):
    """A slab on two blocks, free or fixed, and the water below it, where what seeps in has the pressure outside."""
    s = tank2(rng, wide=(36, 42), deep=(20, 26))
    foot, wide, low, thick = (rng.randint(*n) * s.dx for n in ((4, 6), (8, 12), (6, 9), (4, 6)))
    x, free = 7 * s.dx, rng.random() < 0.5
    over = rng.choice([0, 3]) * s.dx if free else 0.0  # one that stays and reaches beyond its blocks: 6 % off
    s.block("c", [x, 0.0], [x + foot, low])
    s.block("d", [x + foot + wide, 0.0], [x + 2 * foot + wide, low])
    s.block("b", [x - over, low], [x + 2 * foot + wide + over, low + thick], "free = true; density = 2500.0;" if free else "")
    (_, volume, _) = s.laws.pop("solids")[2]
    s.laws["pushed"] = [] if free else [("b", [0.0, 1000 * G * (volume - 2 * foot * (s.depth - low))], 1000 * G * volume)]
    s.laws["rests"] = [("b", 1500 * G * volume)] if free else []
    s.probes.append(("p0", "pressure", [x + foot + 0.5 * wide, 0.5 * low]))
    s.laws["gauges"] = [s.depth - 0.5 * low]
    s.probes.append(("level", "level", [s.hi[0] - 4 * s.dx, 0.5 * s.dx]))
    return s


def body_level_edge(rng):
    s = tank2(rng, wide=(34, 44), deep=(18, 26))
    block_at(s, rng, rng.choice([[], ["floor"]]))
    x = [p[0] / s.dx for p in s.bodies[0]["points"]]
    a, b = min(x) - rng.uniform(4.6, 8), max(x) + rng.uniform(4.6, 8)  # guards are R = 4 dx deep
    s.regions.append(([max(0, math.floor(a)) * s.dx, -s.dx], [min(s.n[0], math.ceil(b)) * s.dx, s.hi[1]]))
    return s


def side_level_edge(rng):
    s = tank2(rng, rng.choice(["sides", "line"]))
    s.regions.append(([-s.dx, -s.dx], [s.dx * rng.randint(5, s.n[0] - 5), s.hi[1]]))
    s.gauges([s.dx * rng.uniform(2, s.n[0] - 2)])
    return s


def period_level_edge(rng):
    s = tank2(rng, "period")
    a = rng.randint(5, s.n[0] - 18)
    s.regions.append(([a * s.dx, -s.dx], [(a + 13) * s.dx, s.hi[1]]))
    s.gauges([s.dx * rng.uniform(2, s.n[0] - 2)])
    return s


def period_across_edge(rng):
    """A region that lies across the period, on the floor or not."""
    s = tank2(rng, "period")
    a, low = s.n[0] - rng.randint(5, 9), rng.choice([-1, -1, rng.randint(1, 4)])
    top = rng.choice([s.hi[1], (max(low, 0) + rng.randint(10, 12)) * s.dx])
    s.regions.append(([a * s.dx, low * s.dx], [(a + 14) * s.dx, top]))
    s.gauges([s.dx * rng.uniform(2, s.n[0] - 2)])
    return s


def nested_side(rng):
    """Two nested regions in a corner or on the floor, cut by the walls there."""
    s = tank2(rng, rng.choice(["sides", "line"]), wide=(26, 34), deep=(15, 18))
    a = rng.choice([-1, rng.randint(2, 5)])  # from the side or off it
    b, c, low = rng.randint(14, 16), rng.randint(4, 6), max(a, -1)
    s.regions.append(([a * s.dx, -s.dx], [(low + b) * s.dx, rng.randint(9, 12) * s.dx]))
    inner = a if a < 0 else a + 4
    s.regions.append(([inner * s.dx, -s.dx], [(max(inner, 0) + c + 2) * s.dx, c * s.dx], " level = 2; "))
    s.gauges([s.dx * rng.uniform(2, s.n[0] - 2)])
    return s


def around(s, body, rng, more=""):
    """A region whose edges are 4.6 dx and more from a body, so that guards, which are R deep, stay away from it."""
    (x0, x1), (y0, y1) = ((min(p[a] for p in body["points"]), max(p[a] for p in body["points"])) for a in range(2))
    x, y = [v / s.dx for v in (x0, x1)], [v / s.dx for v in (y0, y1)]
    lo = [math.floor(x[0] - rng.uniform(4.6, 7)), math.floor(y[0] - rng.uniform(4.6, 7))]
    hi = [math.ceil(x[1] + rng.uniform(4.6, 7)), rng.choice([s.n[1], math.ceil(y[1] + rng.uniform(4.6, 7))])]
    s.regions.append(([a * s.dx for a in lo], [a * s.dx for a in hi], more))


def free_edge(rng):
    """A free body as heavy as water in a refined region, which may follow it."""
    s = tank2(rng, wide=(34, 44), deep=(18, 26))
    block_at(s, rng, rng.choice([["floor"], []]), more="free = true; density = 1000.0;")
    s.laws["stays"] = s.laws.pop("solids")
    around(s, s.bodies[0], rng, rng.choice(["", ' follow = "b"; ']))
    return s


def afloat_edge(rng):
    """A free body half as heavy as water, wider than high, afloat over a refined region and in it: the level it lies at is kept."""
    s = tank2(rng, wide=(34, 44), deep=(16, 24))
    w, h = rng.uniform(10, 14) * s.dx, rng.uniform(5, 7) * s.dx
    lo, hi = [0.5 * (s.hi[0] - w), s.depth - 0.5 * h], [0.5 * (s.hi[0] + w), s.depth + 0.5 * h]
    s.block("b", lo, hi, "free = true; density = 500.0;")
    s.laws["stays"] = s.laws.pop("solids")
    around(s, s.bodies[0], rng)
    s.gauges([0.25 * (s.hi[0] - w)])
    return s


def driven_edge(rng):
    """A body that is driven slowly by up to two spacings in a refined region, which may follow it."""
    s = tank2(rng, wide=(36, 46), deep=(18, 26))
    block_at(s, rng, rng.choice([["floor"], []]))
    around(s, s.bodies[0], rng, rng.choice(["", ' follow = "b"; ']))
    s.end *= 2.0
    for k, (lo, hi, *more) in enumerate(s.regions):
        s.regions[k] = ([lo[0] - 2 * s.dx, lo[1]], [hi[0] + 2 * s.dx, hi[1]], *more)
    return driven(s, rng.choice([[1.0, 0.0], [-1.0, 0.0]]), rng.uniform(0.5, 2) * s.dx)


def flap_edge(rng):
    """A flap that stands on a point on the floor or a side, in a refined region."""
    s = flap_floor(rng)
    around(s, s.bodies[0], rng)
    return s


def side_surface(rng):
    s = tank2(rng, rng.choice(["sides", "line", "period"]))
    s.gauges([s.dx * rng.uniform(1, s.n[0] - 1)])
    return s


def ghost_surface(rng):
    s = tank2(rng, rng.choice(["sides", "period"]))
    s.sph = ' walls = "ghosts";'
    s.gauges([s.dx * rng.uniform(3, s.n[0] - 3)])
    return s


def line_line(rng):  # a step or a wedge that stands on the floor
    s = tank2(rng, "sides", wide=(30, 40))
    w, h = rng.uniform(4, 9) * s.dx, rng.uniform(3, s.d - 6) * s.dx
    x = 0.5 * s.hi[0]
    top = rng.choice([[(x - w, 0), (x, h), (x + w, 0)], [(x - w, 0), (x - w, h), (x + w, h), (x + w, 0)]])
    s.lines.append({"points": [(0, s.hi[1]), (0, 0)] + top + [(s.hi[0], 0), (s.hi[0], s.hi[1])]})
    s.sides = {}
    s.gauges([s.dx * 4])
    return s


def free_floor(rng):
    """A free body as heavy as the water it displaces stays where it is."""
    s = tank2(rng)
    block_at(s, rng, rng.choice([["floor"], ["side"], []]), more="free = true; density = 1000.0;")
    s.laws["stays"] = s.laws.pop("solids")
    return s


def tank3(rng, deep=(8, 12)):
    s = Scene(rng, 3)
    s.dx = 1.0 / rng.choice([10, 16, 20])
    s.d = rng.randint(*deep)
    s.n = [rng.randint(10, 13), rng.randint(10, 13), s.d + 5]
    if rng.random() < 0.3:
        s.periodic[rng.randrange(2)] = True
    s.tank(s.n, s.d)
    s.end *= 0.6
    return s


def mesh_side(rng):
    s = tank3(rng, (11, 14))
    size = [rng.uniform(4, 5.5) * s.dx for _ in range(3)]
    lo = [0.5 * (s.hi[0] - size[0]), 0.5 * (s.hi[1] - size[1]), 0.5 * (s.depth - size[2])]
    for a in rng.choice([[2], [0], [1], [0, 2], [1, 2]]):
        lo[a] = gap_of(rng) * s.dx
    s.block("b", lo, [a + b for a, b in zip(lo, size)])
    s.gauges([s.hi[0] - 2 * s.dx, s.hi[1] - 2 * s.dx])
    return s


def mesh_period(rng):
    """A bed of triangles that goes on beyond its period by less than the support, or ends on it."""
    s = tank3(rng)
    s.periodic, s.sides, over = [True, True, False], {}, rng.choice([0.0, rng.uniform(0, 6)]) * s.dx
    lo, hi = [-over, -over], [s.hi[0] + over, s.hi[1] + over]
    s.sheet("bed.stl", [(lo[0], lo[1], 0.0), (hi[0], lo[1], 0.0), (hi[0], hi[1], 0.0), (lo[0], hi[1], 0.0)], "")
    s.gauges([s.dx * rng.uniform(2, s.n[0] - 2), s.dx * rng.uniform(2, s.n[1] - 2)])
    return s


def mesh_across(rng):
    """An obstacle of triangles on the floor that goes on beyond a period."""
    s = tank3(rng, (10, 12))
    s.periodic, s.sides = [True, False, False], {(1, -1): {}, (1, 1): {}, (2, -1): {}}
    wide, deep = rng.uniform(3, 4.5) * s.dx, rng.uniform(3, 4.5) * s.dx
    x, y = rng.uniform(-0.8, -0.2) * wide, rng.uniform(3, 4) * s.dx
    s.stl("rock.stl", [x, y, 0.0], [x + wide, y + deep, rng.uniform(4, s.d - 4) * s.dx])
    s.meshes["rock.stl"]["of"] = "wall"
    s.gauges([0.5 * s.hi[0], 0.5 * s.hi[1]])
    return s


def side_surface3(rng):
    s = tank3(rng)
    s.gauges([s.dx * rng.uniform(2, s.n[0] - 2), s.dx * rng.uniform(2, s.n[1] - 2)])
    return s


def thin_mesh(s, rng, low, top):
    """A sheet on a row of the lattice, across the tank from side to side or over the period, in which it
    ends or goes on beyond it, between two heights; water 3 dx wide at least on either side."""
    s.periodic = [False, s.periodic[1], False]
    s.sides[0, -1] = s.sides[0, 1] = {}
    if not s.periodic[1]:
        s.sides[1, -1] = s.sides[1, 1] = {}
    x, more = rng.randint(3, s.n[0] - 3) * s.dx, rng.choice([0.0, 1.0]) * s.dx
    if s.periodic[1]:
        more = 0.0
    if low == 0.0:
        low -= more
    corners = [(x, -more, low), (x, s.hi[1] + more, low), (x, s.hi[1] + more, top), (x, -more, top)]
    s.sheet("sheet.stl", corners, "thin = true; ")
    s.gauges([rng.choice([0.5 * x, 0.5 * (x + s.hi[0])]), 0.5 * s.hi[1]])
    return s


def thin_side(rng):
    """From the floor to above the surface."""
    s = tank3(rng, (9, 12))
    return thin_mesh(s, rng, 0.0, s.depth + rng.uniform(1, 4) * s.dx)


def thin_thin(rng):
    """Two of them, with three rows or more of water between."""
    s = tank3(rng, (9, 12))
    s.n[0] += 4
    s.hi[0] = s.n[0] * s.dx
    s.periodic = [False] * 3
    s.sides[0, -1] = s.sides[0, 1] = s.sides[1, -1] = s.sides[1, 1] = {}
    a = rng.randint(3, 6)
    for name, k in (("one", a), ("other", a + rng.randint(3, 5))):
        more, x, top = rng.choice([0.0, s.dx]), k * s.dx, s.depth + rng.uniform(1, 4) * s.dx
        y = s.hi[1] + more
        s.sheet(name + ".stl", [(x, -more, -more), (x, y, -more), (x, y, top), (x, -more, top)], "thin = true; ")
    s.gauges([(a + 1.5) * s.dx, 0.5 * s.hi[1]])
    return s


def thin_rim(rng):
    """A skirt that pierces the surface, a baffle on the floor: one rim in the water."""
    s = tank3(rng, (11, 13))
    if rng.random() < 0.5:
        return thin_mesh(s, rng, rng.uniform(2, 6) * s.dx, s.depth + rng.uniform(1, 4) * s.dx)
    return thin_mesh(s, rng, 0.0, rng.uniform(4, s.d - 4) * s.dx)


# ------------------------------------------------------------------ pairs: bodies that turn about a hinge or are driven

def hinged(s, rng, near):
    """A body as heavy as water, hinged at its middle: nothing turns it."""
    block_at(s, rng, near)
    (name, volume, pa), = s.laws.pop("solids")
    points = s.bodies[0]["points"]
    middle = [0.5 * (points[0][a] + points[2][a]) for a in range(2)]
    s.bodies[0]["more"] = "free = true; density = 1000.0; hinge = { at = %s; };" % s.written(s.point(middle))
    s.laws["turns"] = [(name, math.dist(points[0], middle))]
    return s


def hinged_side(rng):
    return hinged(tank2(rng, rng.choice(["sides", "line"])), rng, rng.choice([["floor"], ["side"], ["side", "floor"]]))


def hinged_surface(rng):
    """Half as heavy as water, twice as wide as deep in it: it floats upright."""
    s = tank2(rng, wide=(34, 44), deep=(16, 24))
    w, h = rng.uniform(12, 16) * s.dx, rng.uniform(5, 7) * s.dx
    lo, hi = [0.5 * (s.hi[0] - w), s.depth - 0.5 * h], [0.5 * (s.hi[0] + w), s.depth + 0.5 * h]
    s.block("b", lo, hi, "free = true; density = 500.0; hinge = { at = %s; };" % s.written(
        s.point([0.5 * s.hi[0], s.depth])))
    s.laws["turns"] = [("b", math.hypot(w, h) / 2)]
    s.gauges([0.25 * (s.hi[0] - w)])
    return s


def driven(s, way, far):
    """Moves the first body slowly by far: the pressure of its speed is below a thousandth of its lift's."""
    s.laws["driven"] = speed = far / (0.6 * s.end)
    axis = max(range(s.dim), key=lambda a: abs(s.vector(way)[a]))
    back = s.vector(way)[axis] * speed * s.speed_unit()
    until = 0.6 * s.end * math.sqrt(s.unit)
    s.bodies[0]["more"] += (" motion = ( { kind = \"polynomial\"; axis = \"%s\"; coefficients = (0.0, %.15g); until = %.15g; "
                            "ramp = %.15g; } );" % ("xyz"[axis], back, until, 0.2 * until))
    return s


def driven_side(rng):
    """Along a floor or side, or away from it, by up to two spacings."""
    s = tank2(rng, rng.choice(["sides", "line"]))
    block_at(s, rng, rng.choice([["floor"], []]))
    s.end *= 2.0
    return driven(s, rng.choice([[1.0, 0.0], [-1.0, 0.0]]), rng.uniform(0.5, 2) * s.dx)


def driven_surface(rng):
    """Out of the water or into it: the level follows what it displaces."""
    s = tank2(rng, wide=(34, 44), deep=(18, 24))
    w, h, far = rng.uniform(6, 9) * s.dx, rng.uniform(7, 9) * s.dx, rng.uniform(-2, 2) * s.dx
    x, y = 0.5 * (s.hi[0] - w), s.depth - rng.uniform(4, 5.5) * s.dx
    s.block("b", [x, y], [x + w, y + h])
    name, volume, pa = s.laws["solids"][0]
    s.end *= 2.0
    driven(s, [0.0, 1.0 if far > 0 else -1.0], abs(far))
    s.level -= w * far / (s.hi[0] - w)  # what it leaves, the water around fills
    s.laws["solids"] = [(name, w * (s.level - y - far), pa)]
    s.gauges([0.25 * (s.hi[0] - w)])
    s.laws["gauges"] = [d + s.level - s.depth for d in s.laws["gauges"]]
    return s


def fall_floor(rng):
    """Water from wall to wall falls on the floor: when it is at rest again, p does not know of it."""
    s = tank2(rng, "sides", deep=(12, 20))
    far = rng.uniform(6, 30) * s.dx
    s.hi[1] += far
    s.shapes = [("box", [0.0, far], [s.hi[0], s.depth + far])]
    s.probes.append(("p", "pressure", [s.dx * rng.randint(6, s.n[0] - 6), 0.0]))
    s.laws["falls"] = (far, math.sqrt(s.depth / G))
    s.laws["series"] = 2
    s.end = math.sqrt(2 * far / G) + 5 * math.sqrt(s.depth / G)
    return s


# ------------------------------------------------------------------ fv and coupled at rest

def fv_tank(rng, dim=2):
    s = Scene(rng, dim)
    s.program = "fv"
    s.dx = 1.0 / rng.choice([16, 20, 32])
    s.n = [2 * rng.randint(8, 16), 2 * rng.randint(8, 14)] if dim == 2 else [2 * rng.randint(4, 7) for _ in range(3)]
    s.d = rng.uniform(0.4, 0.8) * s.n[-1]
    s.tank(s.n, s.d)
    s.sides[s.up, 1] = {}
    s.fv = s.n
    s.laws["rest"] = 1e-6
    return s


def fv_side_surface(rng):
    s = fv_tank(rng, rng.choice([2, 2, 3]))
    s.gauges([rng.uniform(1, n - 1) * s.dx for n in s.n[:-1]])
    return s


def fv_blocked(rng):
    s = fv_tank(rng)
    lo = [rng.randint(4, s.n[0] - 9), rng.choice([0, 0, 4])]
    hi = [lo[0] + 4, min(lo[1] + rng.randint(4, 8), s.n[1] - 4)]
    s.blocked.append(("b", [x * s.dx for x in lo], [x * s.dx for x in hi]))
    s.gauges([2 * s.dx])
    return s


def coupled_tank(rng):
    s = tank2(rng, rng.choice(["sides", "period"]), wide=(64, 76), deep=(18, 26))
    s.program = "coupled"
    s.n[0] += -s.n[0] % 4
    s.hi = [s.n[0] * s.dx, s.n[1] * s.dx]
    s.n[1] += -s.n[1] % 4
    s.hi[1] = s.n[1] * s.dx
    s.fv = [s.n[0] // 2, s.n[1] // 2]
    s.sides[1, 1] = {}
    w = rng.randint(42, 48)
    a = rng.choice([0, rng.randint(6, s.n[0] - w - 6)]) if not s.periodic[0] else rng.randint(6, s.n[0] - w - 6)
    s.sph_box = ([a * s.dx, 0.0], [(a + w) * s.dx, s.hi[1]])
    s.laws["series"] = 20
    return s


def box_surface(rng):
    s = coupled_tank(rng)
    s.gauges([0.5 * (s.sph_box[0][0] + s.sph_box[1][0])])
    return s


def box_body(rng):
    s = coupled_tank(rng)
    mid = 0.5 * (s.sph_box[0][0] + s.sph_box[1][0])
    w, h = 4 * s.dx, rng.uniform(4, 8) * s.dx
    y = rng.choice([gap_of(rng), 0.5 * (s.d - h / s.dx)]) * s.dx
    s.block("b", [mid - 0.5 * w, y], [mid + 0.5 * w, y + h])
    s.gauges([mid + 4.5 * s.dx])
    return s


# ------------------------------------------------------------------ uniform streams

def stream(rng, program):
    s = Scene(rng, 2)
    s.program = program
    s.gravity = False
    s.dx = 1.0 / rng.choice([16, 20, 32])
    s.n = [2 * rng.randint(14, 22), 2 * rng.randint(6, 11)]
    s.hi = [n * s.dx for n in s.n]
    s.velocity = [rng.uniform(0.2, 1.0), 0.0]
    s.sides[0, -1] = {"kind": "inflow", "velocity": s.velocity}
    s.sides[0, 1] = {"kind": "outflow"}
    if rng.random() < 0.5:
        s.periodic[1] = True
    else:
        s.sides[1, -1] = s.sides[1, 1] = {}
    s.end = 1.5 * s.hi[0] / s.velocity[0]
    s.laws["stream"] = 0.02
    return s


def opening_side(rng):
    s = stream(rng, "sph")
    if rng.random() < 0.5:
        s.sides[0, 1]["pressure"] = s.unit * rng.choice([1e3, -1e3, 1e5])
    return s


def stream_surface_edge(rng):
    """A level stream under a surface, carried over a period through a region from floor to surface, in full gravity."""
    s = tank2(rng, "period", wide=(44, 52), deep=(12, 16))
    s.velocity = [rng.choice([-1, 1]) * rng.uniform(0.1, 0.3) * math.sqrt(G * s.depth), 0.0]
    a = rng.randint(0, 6) - 3
    s.regions.append(([(a + 12) * s.dx, -s.dx], [(a + rng.randint(28, 34)) * s.dx, s.hi[1] + s.dx]))
    s.gauges([0.5 * s.dx])
    s.end = 16.0 * math.sqrt(s.depth / G)
    s.laws["stream"] = 0.02
    return s


def opening_level_edge(rng):
    s = stream(rng, "sph")
    s.n[0] += 2 * 28  # transition, buffer and R at each end
    s.hi[0] = s.n[0] * s.dx
    s.end = 0.8 * s.hi[0] / s.velocity[0]
    a = rng.randint(16, s.n[0] - 32)
    s.regions.append(([a * s.dx, -s.dx], [(a + 14) * s.dx, s.hi[1] + s.dx]))
    return s


def opening_corner_edge(rng):
    """A region in the stream, on a side, off it or across the period."""
    s = stream(rng, "sph")
    s.n = [2 * 16 + 14 + rng.randint(2, 8), rng.randint(20, 24)]  # transition, buffer and R at each end
    s.hi = [n * s.dx for n in s.n]
    s.end = 0.8 * s.hi[0] / s.velocity[0]
    a, b = rng.randint(16, s.n[0] - 30), rng.randint(-6, s.n[1] - 7)
    s.regions.append(([a * s.dx, b * s.dx], [(a + 14) * s.dx, (b + 13) * s.dx]))
    return s


def absorbing_side(rng):
    s = stream(rng, "sph")
    s.sides[0, 1] = {"kind": "absorbing", "velocity": s.velocity}
    return s


def drifting(s, x, y, size):
    """A block that goes with the stream: no force on it, within 3 % of rho U^2 times its side."""
    s.bodies.append({"name": "b", "more": "velocity = %s;" % s.written(s.speed_unit() * v for v in s.vector(s.velocity)),
                     "points": [(x, y), (x, y + size[1]), (x + size[0], y + size[1]), (x + size[0], y)]})
    s.laws["pushed"] = [("b", [0.0, 0.0], 1000 * s.velocity[0] ** 2 * size[1])]


def opening_body(rng):
    """A body that goes with the stream, near an inlet at the start or near an outlet at the end."""
    s = stream(rng, "sph")
    s.n[0] += 20
    s.n[1] += 4
    s.hi = [n * s.dx for n in s.n]
    size, gap = [rng.uniform(4, 5) * s.dx for _ in range(2)], rng.uniform(10.1, 13) * s.dx  # 2.5 R of zones
    far = rng.uniform(4, 8) * s.dx
    s.end = far / s.velocity[0]
    x = gap if rng.random() < 0.5 else s.hi[0] - gap - size[0] - far
    y = 0.5 * (s.hi[1] - size[1])
    drifting(s, x, y, size)
    return s


def body_moving_edge(rng):
    """A body that goes with the stream, R or more inside a region that follows it and may lie across a period."""
    s = stream(rng, "sph")
    size, far = [rng.uniform(4, 5) * s.dx for _ in range(2)], rng.randint(6, 10)
    s.n = [2 * 16 + 15 + far + rng.randint(2, 8), rng.randint(22, 26)]  # transition, buffer and R at each end
    s.hi = [n * s.dx for n in s.n]
    s.end = far * s.dx / s.velocity[0]
    a, b = rng.randint(16, s.n[0] - 31 - far), rng.randint(-4, s.n[1] - 11) if s.periodic[1] else rng.randint(-5, s.n[1] - 10)
    x, y = (a + 5) * s.dx, min(max((b + 5) * s.dx, 0.1 * s.dx), s.hi[1] - size[1] - 0.1 * s.dx)
    drifting(s, x, y, size)
    s.regions.append(([a * s.dx, y - 5 * s.dx], [(a + 15) * s.dx, y + size[1] + 5 * s.dx], ' follow = "b"; '))
    return s


def fv_opening_side(rng):
    s = stream(rng, "fv")
    s.fv = s.n
    if rng.random() < 0.5:
        s.sides[0, 1]["carried"] = True
    s.laws["stream"] = 1e-6
    return s


PAIRS = [
    # name, treatments, weight (0: by name alone), scene
    ("body-floor", "body x side or line (floor)", 2, body_floor),
    ("body-side", "body x side or line (upright)", 2, body_side),
    ("body-corner", "body x two sides", 1, body_corner),
    ("body-period", "body x period", 2, body_period),
    ("line-period", "bed or obstacle of lines x period", 1, line_period),
    ("body-body", "body x body", 2, body_body),
    ("polygon-floor", "body with edges at any angle x floor", 2, polygon_floor),
    ("wedge-floor", "corner of a body on the floor, a side or both, with wedges of water beside it", 0, wedge_floor),
    ("flap-floor", "flap that stands on a point, fixed or hinged there", 1, flap_floor),
    ("wedge-body", "corner of a body on another", 0, wedge_body),
    ("body-stack", "body on a body, off it to a side", 1, body_stack),
    ("body-sunk", "body that stands in a side", 0, body_sunk),
    ("body-surface", "body x free surface", 1, body_surface),
    ("body-lid", "top of a body x free surface", 1, body_lid),
    ("body-roof", "body x roof of a tank that shapes fill", 1, body_roof),
    ("shut-slab", "water that a slab on two blocks shuts in", 1, shut_slab),
    ("body-edge", "body x level edge", 1, body_level_edge),
    ("side-edge", "side or line x level edge", 1, side_level_edge),
    ("period-edge", "period x level edge", 1, period_level_edge),
    ("period-across-edge", "region across a period", 1, period_across_edge),
    ("nested-side", "two nested regions x sides or lines", 0, nested_side),
    ("free-edge", "free body as heavy as water x level edge, which may follow it", 1, free_edge),
    ("afloat-edge", "body afloat x level edge", 1, afloat_edge),
    ("driven-edge", "body that is driven slowly x level edge, which may follow it", 0, driven_edge),
    ("side-surface", "side, line or period x free surface", 1, side_surface),
    ("ghost-surface", "ghost side x free surface", 1, ghost_surface),
    ("line-line", "line x line", 1, line_line),
    ("free-side", "free body as heavy as water x side", 2, free_floor),
    ("mesh-side", "mesh of a body x sides and periods, 3D", 2, mesh_side),
    ("mesh-period", "bed of triangles x period, 3D", 1, mesh_period),
    ("mesh-across", "obstacle of triangles across a period, 3D", 0, mesh_across),
    ("side-surface3", "side or period x free surface, 3D", 1, side_surface3),
    ("thin-side", "thin mesh from the floor to above the surface x sides and periods, 3D", 0, thin_side),
    ("thin-thin", "thin mesh x thin mesh, 3D", 0, thin_thin),
    ("thin-rim", "rim of a thin mesh in water: a skirt, a baffle, 3D", 0, thin_rim),
    ("hinged-side", "hinged body x side or line", 1, hinged_side),
    ("hinged-surface", "hinged body x free surface", 1, hinged_surface),
    ("flap-edge", "flap that stands on a point x level edge", 0, flap_edge),
    ("driven-side", "driven body x side or line", 1, driven_side),
    ("driven-surface", "driven body x free surface", 1, driven_surface),
    ("fall-floor", "free surface x floor: water that lands on it from wall to wall", 1, fall_floor),
    ("fv-side-surface", "fv: side x free surface", 1, fv_side_surface),
    ("fv-blocked-surface", "fv: blocked box x free surface", 1, fv_blocked),
    ("box-surface", "SPH box side x FV, free surface, side or period", 1, box_surface),
    ("box-body", "SPH box side x body", 1, box_body),
    ("opening-side", "inlet, outlet x side or period", 1, opening_side),
    ("opening-edge", "inlet, outlet x level edge", 1, opening_level_edge),
    ("stream-surface-edge", "level stream under a surface x level edge", 0, stream_surface_edge),
    ("opening-corner-edge", "inlet, outlet x corners of a region, on a side or across a period", 1, opening_corner_edge),
    ("opening-body", "inlet, outlet x body that goes with the stream", 1, opening_body),
    ("body-moving-edge", "inlet, outlet, side or period x body x level edge that follows it", 1, body_moving_edge),
    ("absorbing-side", "absorbing side x inlet, side or period", 1, absorbing_side),
    ("fv-opening-side", "fv: inlet, outlet x side or period", 1, fv_opening_side),
]


def draw(seed, only=None):
    rng = random.Random(seed)
    pairs = [p for p in PAIRS if not only or p[0] == only]
    name, _, _, make = rng.choices(pairs, [1 if only else p[2] for p in pairs])[0]
    s = make(rng)
    s.name = name
    return s
