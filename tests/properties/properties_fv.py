"""properties_fv.py - random scenes of cells, of blocks and of coupled jobs. SPDX-License-Identifier: BSD-3-Clause"""
import math


def settle(s, r, cost):
    """cost: of a cell and step, in us. Fluid that sticks to a wall wants viscosity."""
    s.program = 'fv'
    sticks = any(side['kind'] == 'no_slip' for side in s.sides) or any('wall' in block.values() for block in s.blocks)
    if s.nu == 0.0 and sticks:
        s.nu = 1e-6 * s.speed * s.length
    h = min(s.size(a) / s.cells[a] for a in s.axes)
    V = max([s.speed] + [abs(s.V[a]) for a in s.axes])
    s.draw_end(0.5 * h / V, 1e-6 * cost * math.prod(s.cells[:s.dim]) + 1e-4)
    s.mass = s.rho
    for a in s.axes:
        s.mass *= s.size(a)


def draw_cells(s, r, *n):
    """Cells of one shape, or of any up to 8:1, a few up to 1000:1."""
    s.draw_spacing()
    h = [s.dx] * 3
    if r.chance(0.3):
        times = math.ldexp(1.0, r.whole(0, 10 if r.chance(0.2) else 3))
        h[r.whole(0, s.dim - 1)] *= times
    s.draw_box(n, h)
    s.cells = [*n, 1][:3]


def integrator(s, r):
    """One of them; the cost of a cell and step, us."""
    at = r.uniform(0.0, 1.0)
    if at < 0.2 and s.nu > 0.0:
        s.fv.update(integrator='bdf2', cfl=0.5)
    elif at < 0.35:
        s.fv.update([{}, {'cfl': 5}, {'cfl': 100}, {'flux': 'upwind'}][r.whole(0, 3)], integrator='newton')
        return 60.0
    elif at < 0.45:
        s.fv['cfl'] = 0.5
    return 1.0


def fields(s, r):
    s.dim = 3 if r.chance(0.2) else 2
    n = r.even(6, 14) if s.dim > 2 else r.even(4, 48)
    wide = 2 if r.chance(0.3) else 1
    s.draw_periods(n)
    s.cells[0] *= wide
    s.hi[0] *= wide
    s.speed = r.decades(0.02, 30.0)
    waves = s.draw_waves(n)
    if r.chance(0.2):  # cells of another shape
        s.cells[1] = r.even(4, 2 * n)
    s.draw_fluid()
    settle(s, r, integrator(s, r))
    if waves < 6.0 and s.field not in ('rest', 'uniform'):
        s.standard = s.unforced = False  # means of four cells a wave hold 2/3 of its energy
    if waves > 12.0 and s.cells[1] >= n and s.fv.get('integrator') != 'newton' and s.lasts():
        s.error = 0.1


def closed(s, r):
    s.dim = 3 if r.chance(0.2) else 2
    most = 12 if s.dim > 2 else 32
    draw_cells(s, r, *[r.whole(4, most) for _ in range(3)][::-1])
    s.speed = r.decades(0.02, 30.0)
    s.length = s.dx * s.cells[0]
    s.draw_fluid()
    s.draw_sides()
    if r.chance(0.5):
        s.draw_gravity(r.decades(0.1, 100.0), 1)
    s.closed = s.unforced = s.still = True
    if r.chance(0.7):
        s.sides[2]['kind'] = 'no_slip'
        s.sides[2]['velocity'][0] = s.speed
        s.unforced = s.still = False
    s.U = s.speed
    s.say_U = r.chance(0.6)
    s.mirrors = s.turns = s.shifts = True
    s.cycles = s.dim == 3
    if s.dim == 2 and r.chance(0.25) and s.cells[1] > 16:  # rows that grow downwards
        s.fv['graded'] = [s.lo[1] + r.uniform(0.5, 0.7) * s.size(1), s.cells[1] // 2]
        s.turns = False
        settle(s, r, 1.0)
    else:
        settle(s, r, integrator(s, r))


def channel(s, r):
    ny = r.whole(4, 40)
    draw_cells(s, r, r.even(4, 16), ny)
    s.draw_channel(s.size(1))
    settle(s, r, integrator(s, r))


def openings(s, r):
    """Streams through a box: along a channel, or oblique with two inlets."""
    ny = r.whole(6, 32)
    draw_cells(s, r, r.whole(6, 40), ny)
    s.speed = s.U = r.decades(0.02, 30.0)
    s.say_U = True
    s.length = s.size(1)
    s.draw_fluid()
    s.draw_sides('slip')
    left, right, below, above = s.sides[:4]
    left['kind'], right['kind'] = 'inflow', 'outflow'
    left['velocity'][0] = s.speed
    right['carried'] = r.chance(0.4)
    if r.chance(0.5):
        s.field = 'uniform'
        s.V[0] = s.speed
    if r.chance(0.4):
        s.V[1] = left['velocity'][1] = below['velocity'][1] = s.speed * r.uniform(0.1, 2.0)
        below['velocity'][0] = s.V[0] = s.speed
        s.field = 'uniform'
        below['kind'], above['kind'], above['carried'] = 'inflow', 'outflow', right['carried']
    elif r.chance(0.5):
        left['profile'] = 'parabolic'
        below['kind'] = above['kind'] = 'no_slip'
    s.stream = s.field == 'uniform' and 'profile' not in left
    s.mirrors = s.turns = s.shifts = True
    settle(s, r, integrator(s, r))


def add_box(s, *high):
    """On beyond the walls, but not above."""
    low = [s.lo[a] - (0.0 if s.g[a] > 0.0 else 8.0 * s.dx) for a in range(3)]
    high = [min(high[a], s.hi[a]) if a < s.dim and s.g[a] < 0.0 else high[a] for a in range(3)]
    s.shapes.append({'form': 'box', 'box': [low, high]})


def surface(s, r):
    """Water under a level set: columns, beds, discs."""
    s.dim = 3 if r.chance(0.15) else 2
    most = 12 if s.dim > 2 else 32
    draw_cells(s, r, *[r.whole(6, most) for _ in range(3)][::-1])
    size = [s.size(a) for a in range(3)]
    s.length = size[1]
    s.speed = math.sqrt(9.81 * size[1])
    s.draw_fluid()
    s.draw_gravity(9.81, 1)
    s.draw_sides()
    beyond = 8.0 * s.dx
    w, d = s.lo[0] + size[0] * r.uniform(0.1, 0.9), s.lo[1] + size[1] * r.uniform(0.05, 0.8)
    kind = r.whole(0, 3)
    if kind == 0:  # at rest, or almost
        add_box(s, s.hi[0] + beyond, d, s.hi[2] + beyond)
    else:
        add_box(s, w, d, s.lo[2] + 0.5 * size[2] if kind == 2 and s.dim > 2 else s.hi[2] + beyond)
    if kind == 3:
        add_box(s, s.hi[0] + beyond, s.lo[1] + r.uniform(0.2, 1.0) * (d - s.lo[1]), s.hi[2] + beyond)
    s.U = s.speed
    s.say_U = r.chance(0.5)
    s.closed = s.mirrors = s.turns = s.shifts = True
    s.cycles = s.dim == 3
    settle(s, r, 20.0 if s.dim > 2 else 10.0)


def wave(s, r):
    nx, ny, air = r.even(8, 48), r.whole(5, 24), r.whole(3, 8)
    draw_cells(s, r, nx, ny + air)
    s.draw_wave(s.size(1) * ny / (ny + air), s.size(0))
    s.sides[3]['kind'] = 'slip'
    settle(s, r, 10.0)


# ---------------------------------------------------------------- blocks
def add_block(s, mapping, nx, ny, sides, **more):
    """sides: their kinds at the ends of i and j."""
    s.blocks.append({'name': 'block %d' % (len(s.blocks) + 1), 'mapping': mapping, 'cells': [nx, ny, 1], **more,
                     **dict(zip(('i_min', 'i_max', 'j_min', 'j_max'), sides))})


def between(p, q):
    return {'min': list(p), 'max': list(q)}


def middle(s):
    return [0.5 * (lo + hi) for lo, hi in zip(s.lo, s.hi)]


def block_fields(s, r):
    """Waves on 2 x 2 joined blocks, or on one with another over it, turned."""
    n = r.even(16, 32)
    s.draw_periods(n)
    s.speed = r.decades(0.02, 30.0)
    waves = s.draw_waves(n)
    s.draw_fluid()
    half = 0.5 * s.hi[0]
    if r.chance(0.5):
        ends = [('periodic', 'joined'), ('joined', 'periodic')]
        for k in range(4):
            at = [k % 2 * half, k // 2 * half, 0.0]
            add_block(s, 'box', n // 2, n // 2, ends[k % 2] + ends[k // 2], **between(at, [at[0] + half, at[1] + half, 0.0]))
    elif r.chance(0.3):
        add_block(s, 'sheared', n, n, ['periodic'] * 4, **between(s.lo, s.hi), wave=r.uniform(-0.04, 0.04))
    else:
        add_block(s, 'box', n, n, ['periodic'] * 4, **between(s.lo, s.hi))
        reach = half * r.uniform(0.4, 0.6)
        fine = int(2.0 * reach / s.dx * r.uniform(0.8, 1.6)) + 6
        add_block(s, 'box', fine, fine, [], **between([half - reach] * 3, [half + reach] * 3), centre=middle(s), angle=r.uniform(-90.0, 90.0))
    settle(s, r, 6.0)
    s.mirrors = s.turns = s.turns_half = s.shifts = s.shifts_by_L = False
    if waves > 12.0 and s.lasts():
        s.error = 0.1


def block_walls(s, r):
    """A ring between turning walls, a cavity with finer cells at its walls, a duct."""
    ny = r.whole(8, 24)
    draw_cells(s, r, r.whole(8, 24), ny)
    s.speed = s.U = r.decades(0.02, 30.0)
    s.say_U = True
    s.length = s.size(0)
    s.draw_fluid()
    kind = r.whole(0, 2)
    s.closed, s.shifts = kind < 2, True
    nx, ny, box = *s.cells[:2], between(s.lo, s.hi)
    mapping = 'annulus' if kind == 0 else 'stretched' if r.chance(0.6) else 'box'
    if mapping == 'stretched':
        stretch = r.uniform(-1.5, 3.0)
        box.update(stretch=[stretch] * 2, focus=middle(s) if stretch > 0.0 else None)
    if kind == 0:
        outer = 0.5 * min(s.size(0), s.size(1))
        inner = outer * r.uniform(0.2, 0.9)
        ny, spin = r.whole(24, 48), s.speed / inner
        add_block(s, mapping, nx, ny, ['wall', 'wall', 'joined', 'joined'], radius=[inner, outer], centre=middle(s),
                  spin=[spin, -spin if r.chance(0.5) else 0.0])
    elif kind == 1:
        if r.chance(0.6):
            box.update(velocity=[s.speed, 0.0, 0.0], lid='j_max')
        else:
            s.still = s.unforced = True
        add_block(s, mapping, nx, ny, ['wall'] * 4, **box)
        if r.chance(0.5):
            s.draw_gravity(9.81, 1)
    else:
        add_block(s, mapping, nx, ny, ['inflow', 'outflow', 'slip', 'slip'], **box, velocity=[s.speed, 0.0, 0.0])
    settle(s, r, 6.0)


# ---------------------------------------------------------------- coupled
def coupled(s, r):
    n, margin = r.even(40, 56), r.whole(2, 6)
    s.draw_periods(n)
    s.cells[:2] = [r.even(n // 4, n // 2) for _ in range(2)]
    s.sph['box'] = [[margin * s.dx] * 3, [(n - margin) * s.dx] * 3]
    s.speed = r.decades(0.02, 30.0)
    s.draw_waves(n)
    s.draw_fluid()
    s.nu = max(s.nu, 1e-4 * s.speed * s.length)
    s.steps = r.whole(4, 24)
    dt = 0.15 * s.dx / (s.speed + math.hypot(*s.V[:2]))
    s.draw_end(min(dt, 0.03 * 16.0 * s.dx * s.dx / s.nu), 3e-6 * n * n * 2.0)
    s.program = 'coupled'
    s.mass = s.rho * n * n * s.dx * s.dx
    s.closed = s.free_of_walls = s.still = False
    s.mirrors = s.turns = s.turns_half = s.shifts = s.shifts_by_L = False
    s.error = 0.25 if s.field != 'rest' and s.lasts() else 0.0


families = [('fv fields', 4, fields), ('fv closed', 3, closed), ('fv channel', 1.5, channel), ('fv openings', 3, openings),
            ('fv surface', 4, surface), ('fv wave', 1, wave), ('fv block fields', 2, block_fields), ('fv block walls', 2, block_walls),
            ('coupled', 1, coupled)]
