"""properties_scene.py - a random scene of properties_draw.py: its draws, the parts that families share, its case, moved and in other
units. SPDX-License-Identifier: BSD-3-Clause"""
import math
import os
import sys

sys.path.append(os.path.join(os.path.dirname(os.path.realpath(__file__)), '..', 'jobs'))
import stl  # for those who write meshes

SIDES = ['x_min', 'x_max', 'y_min', 'y_max', 'z_min', 'z_max']
BUDGET = 0.35  # s of processor time of one run, roughly


class Random:
    """splitmix64 (Steele, Lea & Flood 2014): the same on every machine."""

    def __init__(self, state):
        self.state = state % 2 ** 64

    def uniform(self, lo, hi):
        self.state = z = (self.state + 0x9e3779b97f4a7c15) % 2 ** 64
        z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9 % 2 ** 64
        z = (z ^ z >> 27) * 0x94d049bb133111eb % 2 ** 64
        return lo + (hi - lo) * math.ldexp((z ^ z >> 31) >> 11, -53)

    def decades(self, lo, hi):
        return math.exp(self.uniform(math.log(lo), math.log(hi)))

    def whole(self, lo, hi):
        """lo .. hi, both in."""
        return lo + int(self.uniform(0.0, hi - lo + 1.0))

    def even(self, lo, hi):
        return 2 * self.whole(lo // 2, hi // 2)

    def chance(self, p):
        return self.uniform(0.0, 1.0) < p

    def one_of(self, *words):
        return words[self.whole(0, len(words) - 1)]


class Scene:
    """What a family draws: vectors have three components, elements of lists the keys of the case, and what the laws need to know."""

    def __init__(self, r, family):
        self.r, self.family, self.program, self.dim, self.dx = r, family, 'sph', 2, 0.0
        self.lo, self.hi, self.periodic, self.cells = [0.0] * 3, [0.0] * 3, [False] * 3, [1] * 3
        self.rho, self.nu, self.g, self.central = 0.0, 0.0, [0.0] * 3, 0.0
        self.field, self.U, self.L, self.V, self.amplitude, self.level = 'rest', 1.0, 1.0, [0.0] * 3, 0.0, None
        self.say_U = False  # or leave the default
        self.sides = [{'kind': None, 'velocity': [0.0] * 3} for _ in SIDES]
        self.walls, self.bodies, self.shapes, self.probes, self.blocks, self.regions = [], [], [], [], [], []
        self.criterion, self.local_steps = None, False  # of refinement
        self.sph, self.fv, self.steps = {}, {}, None  # more keys; steps of a coupled job
        self.speed = self.length = self.mass = 0.0  # scales; kg, for kinetic energies
        self.standard = True  # all settings that could make it unstable are the defaults
        self.closed = self.open_above = False  # nothing flows in or out; but what splashes over the sides
        self.unforced = self.free_of_walls = False  # no work is done on the fluid; momentum changes by gravity alone
        self.still = self.stream = False  # must stay at rest; a uniform stream, which stays
        self.error = 0.0  # most that error.velocity_l2 may be; 0: no law
        self.mirrors = self.turns = self.turns_half = self.cycles = self.shifts = self.shifts_by_L = self.carried = False
        self.ranks = r.whole(1, 4)  # of a solver alone
        if r.chance(0.6):
            self.ranks = 1

    @property
    def axes(self):
        return range(self.dim)

    def size(self, a):
        return self.hi[a] - self.lo[a]

    # ---------------------------------------------------------------- parts that families share
    def draw_spacing(self):
        """Of few binary digits: multiples of it are exact."""
        digits = self.r.whole(-11, -2)
        self.dx = math.ldexp(self.r.whole(16, 31), digits)

    def draw_box(self, n, h):
        """n cells or particles of h, the corner a whole number of h from the origin."""
        away = 0 if self.r.chance(0.5) else 40
        for a in self.axes:
            first = self.r.whole(-away, away)
            self.lo[a], self.hi[a] = first * h[a], (first + n[a]) * h[a]

    def draw_periods(self, n):
        """A periodic box of n cells from the origin on."""
        self.draw_spacing()
        for a in self.axes:
            self.cells[a], self.hi[a], self.periodic[a] = n, n * self.dx, True

    def draw_fluid(self):
        """rho, and nu from speed and length."""
        r = self.r
        self.rho = 1000.0 if r.chance(0.3) else r.decades(0.01, 5000.0)
        self.nu = 0.0 if r.chance(0.25) else self.speed * self.length / r.decades(0.1, 1e6)

    def draw_sides(self, kind=None):
        """All that do not repeat."""
        for k in range(2 * self.dim):
            if not self.periodic[k // 2]:
                self.sides[k]['kind'] = kind or self.r.one_of('slip', 'no_slip')

    def draw_channel(self, length):
        """Flow along x between the sides of a box that repeats itself along it, `length' apart."""
        r = self.r
        self.periodic[0] = True
        self.length = self.L = length
        self.speed = self.U = r.decades(0.02, 30.0)
        self.rho = r.decades(0.01, 5000.0)
        self.nu = self.speed * self.length / r.decades(0.1, 1e4)
        self.draw_sides('no_slip')
        self.say_U = self.closed = self.shifts = True
        if r.chance(0.5):
            self.field = 'poiseuille'
            self.g[0] = 8.0 * self.nu * self.U / (self.L * self.L)
        else:
            self.field = 'couette'
            self.sides[3]['velocity'][0] = self.U

    def draw_wave(self, depth, L):
        """A standing wave of length L on water that is `depth' deep."""
        self.hi[0] -= self.lo[0]
        self.lo[0] = 0.0
        self.periodic[0] = self.closed = True
        self.length = depth
        self.speed = math.sqrt(9.81 * self.length)
        self.draw_fluid()
        self.g[1], self.field = -9.81, 'standing_wave'
        self.amplitude = self.length * self.r.uniform(0.01, 0.15)
        self.L = L
        self.U = 6.283 * self.amplitude * math.sqrt(9.81 / self.L)
        self.level = self.lo[1] + self.length
        self.sides[2]['kind'] = self.r.one_of('slip', 'no_slip')

    def draw_gravity(self, g, axis):
        """Of magnitude g, in most scenes along -axis, else askew."""
        d = [0.0] * 3
        if self.r.chance(0.7):
            d[axis] = -1.0
        else:
            for a in self.axes:
                d[a] = self.r.uniform(-1.0, 1.0)
        size = math.sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2])
        self.g = [0.0 if self.periodic[a] or d[a] == 0.0 else g * d[a] / size for a in range(3)]

    def draw_obstacle(self, centre, radius):
        """Corners of a polygon: regular, a star, rugged; clockwise, or the other way round."""
        r = self.r
        kind, start = r.whole(0, 2), r.uniform(0.0, 6.28318)
        n = 2 * r.whole(3, 6) if kind == 1 else r.whole(3, 60 if r.chance(0.3) else 8)
        points = []
        for k in range(n):
            angle = start - 6.283185307179586 * k / n
            far = 1.0 if kind == 0 else (0.6 if k % 2 else 1.0) if kind == 1 else r.uniform(0.7, 1.0)
            points.append([centre[0] + radius * far * math.cos(angle), centre[1] + radius * far * math.sin(angle), 0.0])
        if r.chance(0.3):
            points.reverse()
            if n > 3:
                r.chance(0.3)  # so seeds keep their scenes
        return points

    def draw_end(self, dt, seconds):
        """Time for some steps of dt, of which the run costs seconds (s) each."""
        self.end = dt * max(8.0, min(self.r.decades(20.0, 1000.0), BUDGET / seconds))

    def draw_waves(self, n):
        """A field of waves, of n cells each, in a periodic box; cells to the shortest wave."""
        r = self.r
        self.field = 'beltrami' if self.dim > 2 and r.chance(0.6) else r.one_of('taylor_green', 'two_modes', 'uniform', 'rest')
        self.length = self.L = n * self.dx
        self.U = self.speed
        if self.field != 'rest' and r.chance(0.5):
            for a in self.axes:
                self.V[a] = self.speed * r.uniform(-2.0, 2.0)
        self.say_U = self.closed = self.unforced = self.free_of_walls = self.carried = self.shifts_by_L = True
        self.still = self.field == 'rest'
        self.shifts = self.field in ('rest', 'uniform')
        self.mirrors = self.shifts or self.field == 'taylor_green'
        self.turns = self.mirrors and self.dim == 2
        self.turns_half = self.field == 'two_modes'
        self.cycles = self.dim == 3 and (self.shifts or self.field == 'beltrami')
        return n / 2.236 if self.field == 'two_modes' else n

    def lasts(self):
        """Whether the waves are still there at the end, to measure an error by."""
        k = 6.283 / self.L  # the shortest waves of two_modes: 5 k^2
        return self.field == 'uniform' or (self.nu * 5.0 * k * k * self.end < 1.0 and self.end * self.speed < self.L)

    # ---------------------------------------------------------------- its case
    def case(self):
        """Groups by name. A key that a run does not use is a fault of its case."""
        none, fv = self.field in ('rest', 'uniform'), self.program == 'fv'
        has_U = not none and self.field != 'standing_wave' if fv else not none or self.say_U
        has_L = not none and not (fv and self.field in ('poiseuille', 'couette'))
        case = {'time': {'end': self.end},
                'fluid': {'rho': self.rho, 'nu': self.nu, 'gravity': self.g, 'central': self.central},
                'domain': {'dim': self.dim, 'min': self.lo, 'max': self.hi, 'periodic': self.periodic},
                'initial': {'field': self.field, 'U': self.U if has_U else None, 'L': self.L if has_L else None, 'velocity': self.V,
                            'amplitude': self.amplitude, 'level': self.level},
                'walls': [dict(side=name, **side) for name, side in zip(SIDES, self.sides) if side['kind']] + self.walls,
                'bodies': self.bodies, 'shapes': self.shapes, 'probes': self.probes, 'blocks': self.blocks}
        if self.program != 'fv':
            case['sph'] = dict(dx=self.dx, **self.sph)
        if self.program != 'sph':
            case['fv'] = dict(cells=None if self.blocks else self.cells, **self.fv)
        if self.program == 'coupled':
            case['coupling'] = {'steps': self.steps}
        if self.regions or self.criterion:
            case['apr'] = {'local_steps': self.local_steps, 'regions': self.regions, 'criteria': self.criterion and [self.criterion]}
        return dict(case, output={'more': 'snapshots = false;', 'series': 1})


def everywhere(case, act):
    """Each value that is no group or list of them becomes act(key, value)."""
    def inside(key, value):
        if isinstance(value, dict):
            return {k: inside(k, v) for k, v in value.items()}
        if isinstance(value, list) and value and isinstance(value[0], dict):
            return [inside(key, v) for v in value]
        return value if value is None else act(key, value)
    return inside('', case)


# Powers of length, speed and density of keys; whole numbers, texts and flags have none
UNITS = dict(end=(1, -1, 0), rho=(0, 0, 1), density=(0, 0, 1), nu=(1, 1, 0), gravity=(-1, 2, 0), central=(-1, 1, 0),
             spin=(-1, 1, 0), U=(0, 1, 0), velocity=(0, 1, 0),
             **{key: (1, 0, 0) for key in 'L min max at centre focus points box vertices radius offset amplitude level dx graded'.split()})


def scaled(case, *by):
    """The case in other units of length, speed and density."""
    def act(key, value):
        if isinstance(value, list):
            return [act(key, v) for v in value]
        if key not in UNITS or not isinstance(value, float):
            return value
        for factor, power in zip(by, UNITS[key]):
            value *= factor ** power
        return value
    return everywhere(case, act)


class Motion:
    """x' = M x + t, M a signed permutation: axis a goes to axis[a], times sign[a]."""

    def __init__(self, axis=(0, 1, 2), sign=(1, 1, 1), t=(0.0, 0.0, 0.0)):
        self.axis, self.sign, self.t = list(axis), list(sign), list(t)
        even = tuple(axis) in ((0, 1, 2), (1, 2, 0), (2, 0, 1))
        self.handed = (1 if even else -1) * math.prod(sign)  # det M

    def permuted(self, v):
        return [v[self.axis.index(a)] for a in range(3)]

    def turned(self, v):
        return self.permuted([sign * x + 0.0 for sign, x in zip(self.sign, v)])  # no -0

    def placed(self, v):
        return [x + t for x, t in zip(self.turned(v), self.t)]

    def side(self, name):
        k = SIDES.index(name)
        return SIDES[2 * self.axis[k // 2] + (k % 2 if self.sign[k // 2] > 0 else 1 - k % 2)]

    def box(self, lo, hi):
        pairs = list(zip(self.placed(lo), self.placed(hi)))
        return [min(pair) for pair in pairs], [max(pair) for pair in pairs]


def moved(case, m):
    """The case elsewhere; outlines and triangles keep their inside."""
    g = m.turned(case['fluid']['gravity'])
    size = math.sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2])
    up = sum(-t * c / size for t, c in zip(m.t, g)) if size > 0.0 else 0.0  # by which levels rise

    def act(key, value):
        if key in ('at', 'centre', 'focus'):
            return m.placed(value)
        if key in ('points', 'vertices'):
            points = [m.placed(x) for x in value]
            return points[::-1] if key == 'points' and m.handed < 0 else points
        if key == 'triangles' and m.handed < 0:
            return [(i, k, j) for i, j, k in value]
        if key in ('gravity', 'velocity'):
            return m.turned(value)
        if key == 'spin' and isinstance(value, float):
            return value * m.handed
        if key == 'spin' and len(value) == 3:
            return [m.handed * x + 0.0 for x in m.turned(value)]
        if key in ('periodic', 'cells'):
            return m.permuted((value + [1])[:3])
        if key == 'side':
            return m.side(value)
        if key == 'level' and isinstance(value, float):
            return value + up
        return [value[0] + m.t[1], value[1]] if key == 'graded' else value

    def boxes(group):
        if isinstance(group, list):
            return [boxes(each) for each in group]
        if not isinstance(group, dict):
            return group
        group = {key: boxes(value) for key, value in group.items()}
        if 'min' in group:
            group['min'], group['max'] = m.box(group['min'], group['max'])
        if 'box' in group:
            group['box'] = list(m.box(*group['box']))
        return group
    case = boxes(everywhere(case, act))
    case['walls'].sort(key=lambda wall: SIDES.index(wall['side']) if 'side' in wall else len(SIDES))
    return case


# Keys that a zero leaves out
OPTIONAL = 'nu gravity central velocity amplitude spin'.split()


def written(key, value, dim, number):
    """A value as a case has it; vectors have as many components as the scene."""
    if isinstance(value, dict):
        return '{%s }' % ''.join(' ' + v if k == 'more' else ' %s = %s;' % (k, written(k, v, dim, number)) for k, v in value.items() if said(k, v))
    if isinstance(value, (list, tuple)):
        numbers = not isinstance(value[0], (list, tuple, dict))
        return '(%s)' % ', '.join(written(key, v, dim, number) for v in (value[:dim] if numbers else value))
    return {bool: str(value).lower(), str: '"%s"' % value}.get(type(value)) or number % value


def said(key, value):
    zero = key in OPTIONAL and not (any(value) if isinstance(value, list) else value)
    return value is not None and value is not False and value != [] and key not in ('vertices', 'triangles') and not zero


def text(case, number='%.17g'):
    """The file: groups by name, lists and groups in them by key; `more' is text that stands there as it is."""
    dim = case['domain']['dim']
    return 'format = 1;\n' + ''.join('%s: %s;\n' % (key, written(key, group, dim, number).replace('}, {', '},\n  {'))
                                     for key, group in case.items() if group)
