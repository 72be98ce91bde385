"""properties_sph.py - random scenes of particles, of bodies that float or sink, and of meshes in space.
SPDX-License-Identifier: BSD-3-Clause"""
import math


def settle(s, r, particles):
    """Half of the scenes have a scale of velocity, as their writer knows one; c0 is the default."""
    if s.nu == 0.0:  # without viscosity walls are slip walls
        for each in s.sides + s.walls + s.bodies:
            each['kind'] = 'slip' if each['kind'] == 'no_slip' else each['kind']
    if r.chance(0.25):
        s.sph['scheme'] = r.one_of('riemann', 'riemann_ale', 'delta', 'standard')
        s.standard = False
    carried = sum(s.V[a] * s.V[a] for a in s.axes)
    gH = sum(0.0 if s.periodic[a] else abs(s.g[a]) * s.size(a) for a in s.axes)
    U = s.U if s.say_U else max(1.0, s.speed)
    c0, R = 10.0 * max(U + math.sqrt(carried), math.sqrt(gH)), 4.0 * s.dx
    dt = 0.375 * R / c0
    if s.nu > 0.0:
        dt = min(dt, 0.03 * R * R / s.nu)
    s.draw_end(dt, particles * (1.2e-5 if s.dim > 2 else 5e-6 if s.walls or s.bodies else 3e-6))
    s.mass = s.rho * particles * s.dx ** s.dim


def draw_particles(s, *n):
    s.draw_spacing()
    s.draw_box(n, [s.dx] * 3)


def fields(s, r):
    s.dim = 3 if r.chance(0.2) else 2
    n = r.whole(10, 11) if s.dim > 2 else r.whole(10, 32)
    wide = 2 if s.dim == 2 and r.chance(0.3) else 1
    draw_particles(s, n * wide, n, n)
    s.speed = r.decades(0.02, 30.0)
    for a in s.axes:
        s.hi[a] -= s.lo[a]
        s.lo[a], s.periodic[a] = 0.0, True
    waves = s.draw_waves(n)
    s.draw_fluid()
    settle(s, r, n * n * wide * (n if s.dim > 2 else 1))
    if waves > 12.0 and s.standard and s.field != 'rest' and s.lasts():
        s.error = 0.25
    if s.field not in ('rest', 'uniform'):  # vortices start from noise, which neither mirrors nor turns; half of them go without
        if r.chance(0.5):
            s.sph['noise'] = 0.0
        else:
            s.mirrors = s.turns = s.turns_half = s.cycles = False


def closed(s, r):
    """Full of water, walls all around, some with a lid."""
    s.dim = 3 if r.chance(0.2) else 2
    most = 8 if s.dim > 2 else 30
    nx, ny, nz = r.whole(1, most), r.whole(1, most), r.whole(1, most) if s.dim > 2 else 1
    draw_particles(s, nx, ny, nz)
    s.length = s.dx * min(nx, ny)
    s.speed = r.decades(0.02, 30.0)
    s.draw_fluid()
    s.draw_sides()
    if r.chance(0.6):
        s.draw_gravity(r.decades(0.1, 100.0), s.dim - 1)
    s.closed = s.unforced = s.still = True
    if r.chance(0.4):
        s.sides[2]['kind'] = 'no_slip'
        s.nu = max(s.nu, 1e-6 * s.speed * s.length)
        s.sides[2]['velocity'][0] = s.speed * (1.0 if r.chance(0.5) else -1.0)
        s.unforced = s.still = False
    s.U = s.speed
    s.say_U = r.chance(0.6) or not s.still
    s.mirrors = s.turns = s.shifts = True
    s.cycles = s.dim == 3
    settle(s, r, nx * ny * nz)


def channel(s, r):
    nx, ny = r.whole(10, 24), r.whole(2, 24)
    draw_particles(s, nx, ny)
    s.draw_channel(ny * s.dx)
    settle(s, r, nx * ny)


def add_box(s, x0, y0, x1, y1):
    s.shapes.append({'form': 'box', 'box': [[x0, y0, s.lo[2]], [x1, y1, s.hi[2]]], 'velocity': [0.0] * 3})


def fill(s, deep):
    add_box(s, s.lo[0], s.lo[1], s.hi[0], s.lo[1] + deep * s.dx)


def put_water(s, r, nx, ny):
    """Columns, beds and discs of water; about how many cells of dx they fill."""
    h, lo = s.dx, s.lo
    kind, w, d = r.whole(0, 4), r.whole(1, nx), r.whole(1, ny)
    if kind == 0:  # a level bed
        fill(s, d)
        return nx * d
    add_box(s, lo[0], lo[1], lo[0] + w * h, lo[1] + d * h)
    if kind == 1 and w < nx:  # over a wet bed
        bed = r.whole(1, d)
        add_box(s, lo[0] + w * h, lo[1], s.hi[0], lo[1] + bed * h)
        return w * d + (nx - w) * bed
    if kind == 2 and nx - w > 4:  # two columns
        first, high = r.whole(w + 2, nx - 1), r.whole(1, ny)
        add_box(s, lo[0] + first * h, lo[1], s.hi[0], lo[1] + high * h)
        return w * d + (nx - first) * high
    if kind == 3 and ny - d > 6 and s.dim == 2:  # a disc above
        radius = h * r.uniform(1.0, 0.4 * (ny - d))
        s.shapes[0]['box'][1][0] = s.hi[0]
        s.shapes.append({'form': 'disc', 'centre': [0.5 * (lo[0] + s.hi[0]), s.hi[1] - radius - h, 0.0], 'radius': radius})
        return nx * d
    return w * d


def tank_walls(s, r):
    """A tank as a polyline, open above, with a step, a triangle or a slope."""
    lo, hi, X, Y = s.lo, s.hi, s.size(0), s.size(1)
    at, high = lo[0] + X * r.uniform(0.5, 0.7), Y * r.uniform(0.1, 0.5)
    kind = r.one_of('slip', 'no_slip')
    after = at + 0.2 * X
    bed = [[(at, lo[1]), (at, lo[1] + high), (after, lo[1] + high), (after, lo[1]), (hi[0], lo[1])],
           [(at, lo[1]), (at + 0.1 * X, lo[1] + high), (after, lo[1]), (hi[0], lo[1])], [(at, lo[1])]][r.whole(0, 2)]
    points = [(lo[0], hi[1]), (lo[0], lo[1]), *bed, (hi[0], hi[1])]
    s.walls.append({'kind': kind, 'points': [[x, y, 0.0] for x, y in points]})


def draw_tank(s, r):
    s.length = s.size(1)
    s.speed = math.sqrt(9.81 * s.length)
    s.draw_fluid()
    s.draw_gravity(9.81, 1)
    s.U = s.speed
    s.say_U = r.chance(0.5)
    s.closed = s.mirrors = s.turns = s.shifts = True
    s.cycles = s.dim == 3


def tank(s, r):
    s.dim = 3 if r.chance(0.15) else 2
    nx, ny, nz = r.whole(4, 16 if s.dim > 2 else 60), r.whole(4, 12 if s.dim > 2 else 40), r.whole(3, 8) if s.dim > 2 else 1
    draw_particles(s, nx, ny, nz)
    draw_tank(s, r)
    n = put_water(s, r, nx, ny)
    if s.dim == 2 and s.g[1] < 0.0 and r.chance(0.35):
        tank_walls(s, r)
    else:
        s.draw_sides()
    for a in s.axes:
        if not r.chance(0.5):
            break
        if not s.walls and s.g[a] < 0.0:  # open above
            s.sides[2 * a + 1]['kind'] = None
            s.closed = abs(s.g[a]) > 9.8
    s.open_above = bool(s.walls) or any(not s.sides[2 * a + 1]['kind'] for a in s.axes)
    upright = s.dim == 2 and s.g[0] == 0.0  # a gauge of levels wants that
    pressure = not upright or r.chance(0.6)
    s.turns = s.turns and pressure
    at = [s.lo[0] + s.dx * r.whole(0, nx), s.lo[1] + (s.dx * r.uniform(0.0, 3.0) if pressure else 0.0),
          s.lo[2] + s.dx * r.whole(0, nz) if s.dim > 2 else 0.0]
    s.probes.append({'name': 'P0', 'kind': 'pressure' if pressure else 'level', 'at': at})
    settle(s, r, n * nz + 10)


def tilted(s, r):
    """A closed tank that leans, full or half full."""
    n = r.whole(12, 40)
    draw_particles(s, n, n)
    c = [0.5 * (s.lo[a] + s.hi[a]) for a in s.axes]
    v = 0.33 * n * s.dx
    a, w = r.uniform(-0.8, 0.8), v * r.uniform(0.3, 1.0)
    full = 1.0 if r.chance(0.5) else r.uniform(-0.5, 0.8)

    def leant(x, y):
        return [c[0] + math.cos(a) * x - math.sin(a) * y, c[1] + math.sin(a) * x + math.cos(a) * y, 0.0]
    draw_tank(s, r)
    s.walls.append({'kind': r.one_of('slip', 'no_slip'), 'closed': True, 'points': [leant(-w, v), leant(-w, -v), leant(w, -v), leant(w, v)]})
    s.shapes.append({'form': 'polygon', 'points': [leant(-w, full * v), leant(-w, -v), leant(w, -v), leant(w, full * v)]})
    s.still = s.unforced = full == 1.0
    settle(s, r, int(2.0 * w * v * (1.0 + full) / (s.dx * s.dx)) + 1)


def add_body(s, r, centre, **shape):
    """Its centre is written if it does not move by itself."""
    s.bodies.append({'name': 'b%d' % len(s.bodies), 'kind': None, 'centre': centre, 'velocity': [0.0] * 3, 'spin': None, **shape})
    return s.bodies[-1]


def set_free(s, r, b, radius):
    """Density of anything from a float to a stone; with a push at times."""
    b.update(free=True, density=s.rho * r.decades(0.2, 5.0), centre=None)
    for a in s.axes:
        if not r.chance(0.5):
            break
        b['velocity'][a] = 0.3 * s.speed * r.uniform(-1.0, 1.0)
    spin = [0.0] * 3
    for a in range(3):
        if not r.chance(0.3):
            break
        spin[a] = 0.3 * s.speed / radius * r.uniform(-1.0, 1.0) if s.dim > 2 else 0.0
    b['spin'] = spin if s.dim > 2 else 0.3 * s.speed / radius * r.uniform(-1.0, 1.0) if r.chance(0.3) else 0.0


def driven(s, r):
    """Bodies in a full or half full tank, at rest or driven, or in a periodic box."""
    nx, ny = r.whole(16, 44), r.whole(16, 36)
    draw_particles(s, nx, ny)
    draw_tank(s, r)
    full = r.chance(0.5)
    opened = full and r.chance(0.4)
    deep = ny if full else r.whole(8, ny)
    if opened:
        s.periodic[:2], s.g[:2] = [True, True], [0.0, 0.0]
    if not full:
        fill(s, deep)
    s.draw_sides()
    s.unforced = True
    count = 2 if r.chance(0.2) else 1
    for k in range(count):
        reach = s.dx * min(nx // count, ny)
        radius = reach * r.uniform(0.1, 0.3)
        x = s.lo[0] + (k + 0.5) * nx * s.dx / count + reach * r.uniform(-0.1, 0.1)
        b = add_body(s, r, [x, 0.5 * (s.lo[1] + s.hi[1]) + reach * r.uniform(-0.1, 0.1), 0.0])
        b['kind'] = r.one_of('slip', 'no_slip')
        b['points'] = s.draw_obstacle(b['centre'], radius)
        motion = r.whole(0, 2)
        if motion == 1:
            b['velocity'] = [0.3 * s.speed * r.uniform(-1.0, 1.0), 0.3 * s.speed * r.uniform(-1.0, 1.0), 0.0]
        b['spin'] = 0.3 * s.speed / radius * r.uniform(-1.0, 1.0) if motion == 2 else 0.0
        s.unforced = s.unforced and motion == 0
    s.still = s.unforced and full
    s.say_U = s.say_U or opened
    settle(s, r, nx * deep)


def floating(s, r):
    """Free polygons in a tank, at its surface, above or below."""
    nx, ny = r.whole(20, 44), r.whole(20, 36)
    draw_particles(s, nx, ny)
    draw_tank(s, r)
    full = r.chance(0.2)
    deep = ny if full else r.whole(8, ny - 4)
    count = 2 if r.chance(0.2) else 1
    if not full:
        fill(s, deep)
    s.draw_sides()
    for k in range(count):
        reach = s.dx * min(nx // count, ny)
        radius = reach * r.uniform(0.12, 0.3)
        least, most = s.lo[1] + radius + 2.0 * s.dx, s.hi[1] - radius - 2.0 * s.dx
        x = s.lo[0] + (k + 0.5) * nx * s.dx / count + reach * r.uniform(-0.1, 0.1)
        centre = [x, max(least, min(s.lo[1] + deep * s.dx + radius * r.uniform(-2.0, 1.5), most)), 0.0]
        b = add_body(s, r, centre)
        b['kind'] = r.one_of('slip', 'no_slip')
        b['points'] = s.draw_obstacle(centre, radius)
        set_free(s, r, b, radius)
    settle(s, r, nx * deep)


def draw_mesh(r, centre, radius):
    """A box, its sides two triangles each, or a tetrahedron; turned about a random axis."""
    is_box = r.chance(0.6)
    size = [r.uniform(0.8, 1.0) for _ in range(3)]
    q = [r.uniform(-1.0, 1.0) if r.chance(0.8) else float(a == 0) for a in range(4)]
    w, x, y, z = (part / math.sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]) for part in q)
    Q = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
         [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
         [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
    if is_box:
        corners = [[(0.577 if k >> a & 1 else -0.577) * size[a] * radius for a in range(3)] for k in range(8)]
        triangles = [(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4),
                     (2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2), (1, 3, 7), (1, 7, 5)]
    else:
        corners = [[radius * ((k == a + 1) - 0.25) for a in range(3)] for k in range(4)]
        triangles = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    return {'vertices': [[centre[a] + Q[a][0] * v[0] + Q[a][1] * v[1] + Q[a][2] * v[2] for a in range(3)] for v in corners],
            'triangles': triangles, 'mesh': 'stl' if r.chance(0.5) else 'obj', 'thin': not is_box and r.chance(0.8)}  # its edges are


def solid(s, r):
    """A mesh in a small tank: at rest, driven or free."""
    s.dim = 3
    nx, ny, nz = r.whole(10, 13), r.whole(10, 13), r.whole(10, 11)
    draw_particles(s, nx, ny, nz)
    draw_tank(s, r)
    full = r.chance(0.4)
    deep, motion = ny if full else r.whole(4, ny), r.whole(0, 3)
    if not full:
        fill(s, deep)
    s.draw_sides()
    radius = s.dx * r.uniform(3.2, 3.7)
    b = add_body(s, r, [0.5 * (s.lo[a] + s.hi[a]) + s.dx * r.uniform(-0.5, 0.5) for a in range(3)])
    b['kind'] = r.one_of('slip', 'no_slip')
    b.update(draw_mesh(r, b['centre'], radius))
    if motion == 1:
        b['velocity'] = [0.2 * s.speed * r.uniform(-1.0, 1.0) for _ in range(3)]
    elif motion == 2:
        b['spin'] = [0.2 * s.speed / radius * r.uniform(-1.0, 1.0) for _ in range(3)]
    elif motion == 3:
        set_free(s, r, b, radius)
    s.unforced = s.still = motion == 0 and full
    settle(s, r, nx * deep * nz)


def bodies(s, r):
    draw = [driven, floating, solid][r.whole(0, 2)]
    s.family = {driven: 'sph bodies', floating: 'sph floating', solid: 'sph solid'}[draw]
    draw(s, r)


def openings(s, r):
    """A channel with inlet and outlet, or an oblique stream through an open box."""
    nx, ny = r.whole(20, 44), r.whole(12, 24)
    draw_particles(s, nx, ny)
    s.speed = s.U = r.decades(0.02, 30.0)
    s.say_U = True
    s.length = ny * s.dx
    s.draw_fluid()
    s.draw_sides('slip')
    s.field = 'uniform'
    left, right, below, above = s.sides[:4]
    s.V[0] = left['velocity'][0] = s.speed
    left['kind'], right['kind'] = 'inflow', 'outflow' if r.chance(0.7) else 'absorbing'
    absorbs = right['kind'] == 'absorbing'  # a far state that streams, too
    right['velocity'][0] = s.speed if absorbs else 0.0
    if r.chance(0.3):
        s.V[1] = left['velocity'][1] = below['velocity'][1] = s.speed * r.uniform(0.1, 1.0)
        below['velocity'][0] = s.speed
        below['kind'], above['kind'] = 'inflow', 'outflow'
        right['velocity'][1] = s.V[1] if absorbs else 0.0
    elif r.chance(0.5):
        left['profile'] = 'parabolic'
        below['kind'] = above['kind'] = 'no_slip'
    s.stream = 'profile' not in left
    s.mirrors = s.turns = s.shifts = True
    settle(s, r, nx * ny * 2)


def patch_or_drop(s, r):
    drop, n = r.chance(0.5), r.whole(6, 24)
    s.draw_spacing()
    s.length = s.L = n * s.dx
    s.hi[:2] = [3 * n * s.dx] * 2
    s.lo[:2] = [-s.hi[0]] * 2
    s.speed = s.U = r.decades(0.02, 30.0)
    s.say_U = True
    s.draw_fluid()
    s.field, s.central = ('drop', s.U / s.L) if drop else ('patch', 0.0)
    s.closed, s.mirrors = True, drop
    s.unforced = s.turns = s.free_of_walls = not drop
    settle(s, r, n * n * (4 if drop else 1))


def jets(s, r):
    """Lumps of water meet in the void."""
    s.dim = 3 if r.chance(0.15) else 2
    most = 5 if s.dim > 2 else 14
    draw_particles(s, 60, 60, 60)
    s.speed = s.U = r.decades(0.02, 30.0)
    s.say_U = True
    s.length = most * s.dx
    s.draw_fluid()
    count, gap = 0, r.whole(0, 4)
    for k in range(2):
        size = [r.whole(1, most), r.whole(1, most), r.whole(1, most) if s.dim > 2 else 1]
        first = [30 + gap if k else 30 - size[0], r.whole(28 - size[1], 32), r.whole(28, 32)]
        s.shapes.append({'form': 'box', 'box': [[s.lo[a] + first[a] * s.dx for a in range(3)],
                                                [s.lo[a] + (first[a] + size[a]) * s.dx for a in range(3)]],
                         'velocity': [s.speed * (-1.0 if k else 1.0) * r.uniform(0.0, 1.0), s.speed * r.uniform(-0.5, 0.5), 0.0]})
        count += math.prod(size)
    s.closed = s.unforced = s.free_of_walls = s.carried = s.mirrors = s.turns = s.shifts = True
    s.cycles = s.dim == 3
    settle(s, r, count)
    s.end = min(s.end, 15.0 * s.dx / s.speed)  # nothing reaches the sides


def wave(s, r):
    nx, ny, air = r.whole(20, 48), r.whole(5, 16), r.whole(3, 8)
    draw_particles(s, nx, ny + air)
    s.draw_wave(ny * s.dx, nx * s.dx)
    settle(s, r, nx * ny)


def flows_in(s):
    return s.sides[0]['kind'] == 'inflow'


def add_region(s, r, level):
    """A box or a sphere in a scene that has room for it: at least R and two spacings of the coarser level behind each edge. Its
    faces lie between the places of the lattice and not on them, where rounding would decide."""
    least, off = 12.5 * math.ldexp(s.dx, 1 - level), 0.45 if flows_in(s) else 0.05  # away from open sides
    radius = least * r.uniform(0.55, 0.8) if r.chance(0.3) else 0.0
    lo, hi, centre = list(s.lo), list(s.hi), [0.0] * 3
    for a in s.axes:
        length = min(least * r.uniform(1.0, 1.2 if flows_in(s) else 2.0), 0.9 * s.size(a))
        lo[a] = s.lo[a] + r.uniform(off, 1.0 - off) * (s.size(a) - length)
        hi[a] = lo[a] + length
        centre[a] = s.lo[a] + r.uniform(0.45, 0.55) * s.size(a) if radius > 0.0 else 0.0
    s.regions.append({'level': level, **({'shape': 'sphere', 'centre': centre, 'radius': radius} if radius > 0.0 else
                                         {'min': lo, 'max': hi}), 'velocity': [0.0] * 3})


def add_slab(s, r):
    """In space a slab of level 1 across the longest axis, from a wall on if there is one: at least R and two spacings at each edge."""
    along = max(range(3), key=s.size)
    length = (12.3 if s.periodic[along] else 6.2) * s.dx
    if s.size(along) < length + 0.3 * s.dx:
        return False
    lo, hi = list(s.lo), list(s.hi)
    if s.periodic[along]:
        lo[along] += r.uniform(0.05, 0.95) * (s.size(along) - length)
    hi[along] = lo[along] + length
    s.regions.append({'level': 1, 'min': lo, 'max': hi, 'velocity': [0.0] * 3})
    return True


def add_regions(s, r):
    level = 1 if 'profile' in s.sides[0] or s.stream else r.whole(1, 2)
    if s.dim == 3 and not add_slab(s, r):
        return False
    if s.dim == 2 and any(s.size(a) <= 14.0 * s.dx for a in s.axes):
        return False
    if s.bodies and r.chance(0.6):  # R and two spacings, and some that flow
        s.regions.append({'level': 1, 'shape': 'body', 'body': 'b0', 'offset': s.dx * r.uniform(6.5, 9.0)})
    elif s.dim == 2:
        add_region(s, r, level)
    if s.dim == 2 and level == 1 and r.chance(0.2):
        add_region(s, r, 1)
    return True


def set_in_motion(s, r):
    """Regions that move go at most three spacings, and stay in the domain; slowly enough for births."""
    for region in s.regions:
        for a in s.axes if 'velocity' in region else ():
            region['velocity'][a] = min(3.0 * s.dx / s.end, 0.5 * s.speed) * r.uniform(-1.0, 1.0)


def ask(s, r):
    """What the flow asks for, of a kind that the scene has."""
    if s.shapes and r.chance(0.5):
        s.criterion = {'level': 1, 'kind': 'surface', 'distance': r.whole(0, 1)}
    else:
        kind = 'pressure' if s.still or r.chance(0.3) else 'vorticity'
        s.criterion = {'level': 1, 'kind': kind, 'above': r.decades(0.02, 0.5)}


def refined(s, r):
    [fields, closed, channel, tank, driven, tilted, openings, jets][r.whole(0, 7)](s, r)
    if flows_in(s):
        s.hi[:2] = [x + 32.0 * s.dx for x in s.hi[:2]]  # room between the zones
    if s.dim == 2 and r.chance(0.25):
        ask(s, r)
    elif not add_regions(s, r):
        return
    finest = max([1] + [region['level'] for region in s.regions])
    s.end *= 0.08 if s.dim == 3 else 0.2 if finest == 1 else 0.05
    if r.chance(0.35):
        set_in_motion(s, r)
    s.local_steps = r.chance(0.25)
    s.carried = False  # the regions stay
    s.error = 0.0  # of waves that have gone through edges there is no table


families = [('sph fields', 3, fields), ('sph closed', 3, closed), ('sph channel', 1.5, channel), ('sph tank', 5, tank),
            ('sph tilted', 2, tilted), ('sph bodies', 4, bodies), ('sph openings', 2, openings), ('sph patch or drop', 1, patch_or_drop),
            ('sph jets', 2, jets), ('sph wave', 1, wave), ('sph refined', 4, refined)]
