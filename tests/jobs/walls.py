"""Walls and bodies as a case has them: a wedge that enters water, schemes and the walls they can take, drops that fall, walls that are too thin.
SPDX-License-Identifier: BSD-3-Clause"""
import math

import lib
from lib import TANK, changed, check, close, column, held, last, number, run_case, sides

lib.scratch()
FLOOR = 'x_min x_max y_min'

# 30 degrees at constant speed, no gravity: F = 14.02 rho V^3 t of both sides (similarity solution; Zhao & Faltinsen,
# J. Fluid Mech. 246, 1993: 14.14). The root of the impulse, (7.01 rho V^3)^0.5 (t - t0), has the same slope wherever in its
# first dx the entry begins, and sums sound up that the force rings with.
run_case('wedge', changed(TANK, time='end = 0.1;', fluid='', domain='min = (-0.7, -0.5); max = (0.7, 0.3);',
                          initial='field = "rest"; U = 1.0;', shapes='{ form = "box"; box = ((-0.7, -0.5), (0.7, 0)); }',
                          sph='dx = 0.01; c0 = 30.0;',
                          bodies='{ name = "wedge"; velocity = (0, -1); points = ((0, 0), (-0.4, 0.23094), (0.4, 0.23094)); }',
                          output='series = 1; snapshots = false;'))
t, force = column('wedge', 't ['), column('wedge', 'wedge force y')
roots, impulse = [], 0
for k in range(1, len(t)):
    impulse += (t[k] - t[k - 1]) * (force[k] + force[k - 1]) / 2
    if t[k] > 0.025:
        roots.append((t[k], math.sqrt(max(impulse, 0) / 7010)))
middle, height = (sum(values) / len(roots) for values in zip(*roots))
slope = (sum((x - middle) * (y - height) for x, y in roots) / sum((x - middle) ** 2 for x, _ in roots)) ** 2
check(0.85 < slope < 1.15, 'wedge: dF/dt is %g of the similarity solution, wanted within 15 %%' % slope)
held('wedge', 1e-10)

# A jet of ten rows onto a plate, once its film leaves over both edges: rho h (U - V)^2, whether the plate moves or not (a
# film that clung to the edges of one that moves was drawn round them, and 9 % of the force were missing).
for case, moves in ('a plate at rest', 0), ('a plate that moves', 0.5):
    run_case('jet', changed(TANK, time='end = 0.85;', fluid='', domain='min = (-2.2, -1.5); max = (1.8, 1.5);', walls='',
                            initial='field = "rest";', sph='dx = 0.02; c0 = 20.0;',
                            shapes='{ box = ((-1.62, -0.1), (-0.02, 0.1)); velocity = (%g, 0); }' % (1.5 + moves),
                            bodies='{ name = "plate"; box = ((0, -1.2), (0.2, 1.2)); velocity = (%g, 0); }' % moves,
                            output='snapshots = false;'))
    force = lib.mean('jet', 'plate force x', 0.3)
    check(0.95 * 450 < force < 1.05 * 450, 'a jet onto %s: %g N/m, 450 wanted within 5 %%' % (case, force))


# a block at rest near a floor, beside a side and between both: Archimedes on each of its faces, 392.4 N/m, and the
# balance of fluid, block and walls
def resting(points, low=0, end=0.4):
    """A body at rest in water of 0.5 m: the force on it."""
    run_case('block', changed(TANK, time='end = %g;' % end, domain='min = (%g, 0); max = (1, 0.8);' % low,
                              bodies='{ name = "b"; points = (%s); }' % points))
    check(number('block', 'momentum.defect') < 1e-10, '(%s): momentum off by %g' % (points, number('block', 'momentum.defect')))
    return number('block', 'force.x'), number('block', 'force.y')


for name, x, y in ('1.6 dx over the floor', 0.4, 0.04), ('2 dx over the floor', 0.4, 0.05), ('1.5 dx from a side', 0.0375, 0.15), \
        ('2.5 dx from floor and side', 0.0625, 0.0625):
    across, up = resting('(%g, %g), (%g, %g), (%g, %g), (%g, %g)' % (x, y, x, y + 0.2, x + 0.2, y + 0.2, x + 0.2, y))
    check(380.6 < up < 404.2, 'gap, %s: lift %g, Archimedes 392.4 N/m within 3 %%' % (name, up))
    check(abs(across) < 20, 'gap, %s: pushed sideways by %g N/m' % (name, across))

# faces that stand on the floor at an angle, and a block in a corner: p A on each, 3 % of the whole (the start takes half of 0.4 s)
for name, wanted, points in ('block on the floor', (0, -588.6), '(0.4, 0), (0.4, 0.2), (0.6, 0.2), (0.6, 0)'), \
        ('block in the corner', (784.8, -588.6), '(0.8, 0), (0.8, 0.2), (1, 0.2), (1, 0)'), \
        ('45 degrees', (1226.25, 784.8), '(0.8, 0), (0.6, 0.2), (0.6, 0.8), (1, 0.8), (1, 0)'), \
        ('120 degrees', (1226.25, -453.1), '(0.6, 0), (0.71547, 0.2), (0.71547, 0.8), (1, 0.8), (1, 0)'):
    force = resting(points, low=0.2, end=0.8)
    check(math.dist(force, wanted) < 0.03 * math.hypot(*wanted),
          'corner, %s: (%g, %g) N/m instead of (%g, %g), wanted 3 %%' % (name, *force, *wanted))

# on a point, where no particle comes near it, the average of the pressure, too, is Archimedes' (5 %, as the watch has it)
for name, wanted, form in ('disc', 308.2, 'radius = 0.1; centre = (0.6, 0.1);'), \
        ('triangle', 679.6, 'points = ((0.6, 0), (0.8, 0.34641), (0.4, 0.34641));'):
    run_case('tip', changed(TANK, time='end = 0.8;', domain='min = (0.2, 0); max = (1, 0.8);', bodies='{ name = "b"; %s }' % form,
                            output='series = 5; snapshots = false;'))
    for rule in 'y', 'average_y':
        close('%s on the floor, force.%s' % (name, rule), number('tip', 'force.' + rule), wanted, 0.05)


# walls that stand on a point between waters of different depth let nothing pass: once the first particles have found
# their places, the levels stay within dx/10
def stands(name, walls, bodies):
    run_case(name, changed(TANK, time='end = 1;', domain='min = (0.2, 0); max = (1, 1);', walls=sides(FLOOR) + walls, bodies=bodies,
                           shapes='{ form = "box"; box = ((0.2, 0), (0.6, 0.6)); }, { form = "box"; box = ((0.6, 0), (1, 0.3)); }',
                           probes='{ name = "deep"; kind = "level"; at = (0.3, 0.2); }, { name = "low"; kind = "level"; at = (0.9, 0.2); }',
                           output='series = 5; snapshots = false;'))
    held(name)
    for probe in 'deep', 'low':
        level = [z for t, z in zip(column(name, 't ['), column(name, probe)) if t > 0.4]
        check(abs(level[-1] - level[0]) <= 0.0025, '%s: the %s water moved by %g m, wanted dx/10' % (name, probe, level[-1] - level[0]))


FLAP = '{ name = "f"; points = ((0.6, %g), (0.55, %g), (0.55, 0.9), (0.65, 0.9), (0.65, %g)); }'
stands('flap on a point', '', FLAP % (0, 0.15, 0.15))
stands('blunt wall on a point', ', { closed = true; points = ((0.6, 0), (0.5, 0.1), (0.5, 0.9), (0.7, 0.9), (0.7, 0.1)); }', '')
stands('body on the tip of another', '', '{ name = "a"; points = ((0.4, 0), (0.4, 0.1), (0.6, 0.2), (0.8, 0.1), (0.8, 0)); }, '
       + FLAP % (0.2, 0.35, 0.35))
stands('flap on the ridge of a floor', ', { points = ((0.2, 0), (0.6, 0.15), (1, 0)); }', FLAP % (0.15, 0.3, 0.3))

# a closed tank full of water at rest: the background pressure is uniform and moves nothing, so p = -rho g (y - 0.5)
for scheme in 'riemann', 'delta':
    run_case('closed', changed(TANK, time='end = 0.6;', initial='level = 0.5;', walls=sides(FLOOR + ' y_max'), shapes='',
                               probes='{ name = "floor"; at = (0.5, 0.0); }, { name = "top"; at = (0.5, 1.0); }',
                               sph='dx = 0.05; c0 = 40.0; walls = "nfm"; background = true; scheme = "%s";' % scheme))
    for probe, wanted in ('floor', 4905), ('top', -4905):
        ratio = last('closed', probe) / wanted
        check(0.95 < ratio < 1.05, 'closed, %s: the pressure at the %s is %g of rho g h' % (scheme, probe, ratio))
    check(number('closed', 'particles_returned') == 0, 'closed, %s: particles put back' % scheme)

# 2D dam break, 15 particles deep: what the shift gives back to gravity presses nobody through the floor
run_case('dam', changed(TANK, time='end = 1.2;', fluid='rho = 997.0; gravity = (0, -9.81);', domain='max = (1.6, 1.2);',
                        initial='field = "rest"; U = 1.72;', shapes='{ form = "box"; box = ((0, 0), (0.6, 0.3)); }',
                        sph='dx = 0.02; c0 = 30.0;'))
check(number('dam', 'particles_returned') <= 20, 'dam: %g of 450 particles put back' % number('dam', 'particles_returned'))

# a particle and a layer of them under a roof, in air: walls hold nothing up, all falls with g
ROOF = '{ form = "box"; box = ((%g, 0.98), (0.02, 1.0)); %s }'
roof = changed(TANK, time='end = 0.3;', domain='min = (-0.5, 0); max = (0.5, 1.0);', walls=sides(FLOOR + ' y_max'), sph='dx = 0.02;')
for left in 0, -0.2:
    run_case('roof', changed(roof, shapes=ROOF % (left, '')))
    fall = -last('roof', 'momentum y') / (last('roof', 'mass') * 9.81 * last('roof', 't ['))
    check(0.999 < fall < 1.001, 'under a roof water falls with %g g' % fall)
# mirrored and fixed ghosts of three rows do not hold them either (0.3 to 0.5 g before), where gravity goes along x, too
for model, box, g, axes in ('ghosts', '((-0.2, 0.94), (0, 1))', '(0, -9.81)', 'y'), ('fixed', '((-0.2, 0.94), (0, 1))', '(0, -9.81)', 'y'), \
        ('ghosts', '((-0.5, 0.4), (-0.44, 0.6))', '(9.81, 0)', 'x'):
    run_case('hung', changed(roof, time='end = 0.1;', fluid='gravity = %s;' % g, walls=sides('x_min x_max y_min y_max'),
                             shapes='{ box = %s; }' % box, sph='dx = 0.02; walls = "%s";' % model))
    fall = abs(last('hung', 'momentum ' + axes)) / (last('hung', 'mass') * 9.81 * last('hung', 't ['))
    check(0.97 < fall < 1.03, 'under a roof of %s water falls with %g g' % (model, fall))
# one that runs there at 30 m/s is held: let go at 0.2 m/s, a plate that follows would hit it again and again
run_case('film', changed(roof, time='end = 0.01;', shapes=ROOF % (-0.2, 'velocity = (30, -0.2);'), output='series = 1; snapshots = false;'))
momentum = column('film', 'momentum y')
left = momentum[-1] / next(value for value in momentum if value)
check(abs(left) < 0.2, 'a film leaves the roof that it runs along with %g of its speed' % left)

# a tank with an oblique floor and a wall between two levels, 3 dx thick; delta takes normal flux walls, standard none
tank = changed(TANK, time='end = 0.5;', initial='field = "rest"; U = 2.21;', sph='dx = 0.05; c0 = 30.0;',
               walls='{ points = ((0, 1), (0, 0), (0.4, 0), (0.4, 0.9), (0.55, 0.9), (0.55, 0), (1, 0), (1, 1)); }',
               shapes='{ form = "box"; box = ((0, 0), (0.4, 0.6)); }, { form = "box"; box = ((0.55, 0), (1, 0.3)); }')
for scheme in 'delta', 'riemann':
    run_case('tank', tank, '-p', 'sph.scheme=' + scheme)
    held('tank')
run_case('fixed', tank, '-p', 'sph.scheme=standard', '-p', 'sph.walls=fixed', '-p', 'time.end=0.2')

# plane Poiseuille flow, Re 10; delta and standard [4.22-4.25] beside no-slip walls on their default step
channel = changed(TANK, time='end = 2;', fluid='nu = 0.1; gravity = (0.8, 0);', initial='field = "poiseuille"; U = 1.0; L = 1.0;',
                  walls=sides('y_min y_max', 'no_slip'), shapes='', output='series = 20; snapshots = false;')
for scheme, dx in ('delta', 0.05), ('delta', 0.025), ('standard', 0.05):
    channel = changed(channel, domain='max = (%g, 1); periodic = (true, false);' % (10 * dx),
                      sph='dx = %g; c0 = 10.0; walls = "nfm"; scheme = "%s";' % (dx, scheme))
    run_case('channel', channel)
    error = number('channel', 'error.velocity_l2')
    check(error < 0.01, 'channel, %s, dx %g: velocity off by %g' % (scheme, dx, error))


# A disc of water falls on a slab between two sides: its films fill the corners at 3 m/s without tension of more than their
# own dynamic pressure, rho 9 m^2/s^2, by much (-200 kPa before, and the run ended)
run_case('splash', changed(TANK, time='end = 0.6;', domain='max = (2, 1.2);', bodies='{ name = "slab"; box = ((0, 0), (2, 0.1)); }',
                           shapes='{ form = "disc"; centre = (0.6, 0.7); radius = 0.15; }', sph='dx = 0.0125;'))
check(min(column('splash', 'min density')) > 940 and number('splash', 'watch.energy_gain') < 0.02,
      'splash on a slab: density down to %g kg/m^3, energy gain %g' % (min(column('splash', 'min density')),
                                                                        number('splash', 'watch.energy_gain')))

# Drops, sheets and blocks fall with g until they are a spacing from the floor, whatever is beside them: a wall, a corner
G, DX, LOW = 9.81, 0.05, 0.25
AIR = changed(TANK, time='end = 1;', output='series = 1; snapshots = false;', sph='dx = %g;' % DX)
THICK = changed(AIR, domain='dim = 3; max = (0.5, 0.5, 0.6);', fluid='rho = 1000.0; gravity = (0, 0, -%g);' % G, walls=sides(FLOOR + ' y_max z_min'))
for name, case, size in ('one', AIR, (1, 1)), ('two', AIR, (2, 1)), ('sheet', AIR, (20, 1)), ('block', AIR, (4, 4)), \
        ('one3', THICK, (1, 1, 1)), ('sheet3', THICK, (10, 10, 1)):
    up = len(size) - 1
    far = [LOW if k == up else 0 for k in range(len(size))], [n * DX + (LOW if k == up else 0) for k, n in enumerate(size)]
    run_case('fall', changed(case, shapes='{ form = "box"; box = ((%s), (%s)); }' % tuple(', '.join(map(str, x)) for x in far)))
    lands = math.sqrt(2 * (LOW - DX / 2) / G)
    fallen = [(t, -p / m) for t, p, m in zip(column('fall', 't ['), column('fall', 'momentum ' + 'xyz'[up]), column('fall', 'mass')) if t < lands]
    check(len(fallen) > 10 and max(abs(u - G * t) for t, u in fallen) <= 0.01 * G * lands,
          '%s: falls at %s m/s after %s s' % (name, fallen[-1][1], fallen[-1][0]), 'fall.txt')
    check(last('fall', 'put back') == 0 and abs(last('fall', 'momentum ' + 'xyz'[up])) < 0.1 * G * lands * last('fall', 'mass'),
          name + ' does not stay on the floor')


def refuses(words, case, *args):
    run_case('refused', case, *args, code=2, words=words)


refuses('sph.scheme: standard .* take riemann', tank, '-p', 'sph.scheme=standard')
refuses('sph.scheme: standard .* corners', changed(channel, domain='max = (0.5, 1);',
                                                   walls=sides('x_min x_max y_max') + ', ' + sides('y_min', 'no_slip')))
refuses('sph.scheme: standard .* weighs', changed(channel, initial='field = "rest"; U = 1.0;', fluid='nu = 0.1; gravity = (0.8, -1);'))
refuses('sph.walls: .*fixed_ghosts', tank, '-p', 'sph.walls=fixed_ghosts')
refuses(r'faces of wall 1 are 0.1 m apart at \(0.45, ', tank.replace('0.55', '0.5'))
refuses(r'a gap of 0.02 m between body 1 \(block\) and wall 1',
        changed(tank, bodies='{ name = "block"; points = ((0.1, 0.02), (0.1, 0.2), (0.35, 0.2), (0.35, 0.02)); }'))
refuses(r'wall 1 and body 1 \(block\) are 0.02 m apart',  # it touches elsewhere
        changed(tank, bodies='{ name = "block"; points = ((0.06, 0), (0.06, 0.2), (0.35, 0.2), (0.35, 0.02), (0.12, 0.02), (0.12, 0)); }'))
lib.end('wedge %.3f, %d faults' % (slope, lib.failed))
