"""Bodies as a case has them: forces where a body meets a wall, contact, free bodies over a restart and on two ranks.
SPDX-License-Identifier: BSD-3-Clause"""
import math
import re

import lib
from lib import TANK, box_stl, changed, check, close, column, last, mean, near, number, run_case, sides, write

lib.scratch()


def points(left, low, right, high):
    """A rectangle, its corners from the lower left one clockwise."""
    return 'points = ((%g, %g), (%g, %g), (%g, %g), (%g, %g));' % (left, low, left, high, right, high, right, low)


# A block that stands on the floor, no water under it: submerged it bears what is above it, 882.9 N/m; piercing the
# surface nothing, where shares by gamma alone gave it 207 N/m.
block = changed(TANK, time='end = 0.6;', initial='field = "rest"; U = 2.21;', sph='dx = 0.025; c0 = 25.0;',
                bodies='{ name = "b"; %s }' % points(0.3, 0, 0.6, 0.2))
run_case('low', block)
close('submerged block', number('low', 'force.y'), -882.9, 0.03)
run_case('high', block.replace('0.2)', '0.9)'))
check(abs(number('high', 'force.y')) < 30, 'block through the surface: %g N/m instead of 0' % number('high', 'force.y'))

# A full can without weight, swung by 0.05 m within 1 s: it pushes its water as a rigid body, m A w^2, and the default
# speed of sound bears that pressure, rho A w^2 times its length.
can, swung = '{ name = "can"; box = ((0.5, 0.3), (-0.5, -0.3)); motion = ( { kind = "harmonic"; axis = "x"; amplitude = 0.05; period = 1.0; ramp = 1.0; } ); }', {}
run_case('can', changed(TANK, time='end = 2.0;', fluid='', domain='min = (-1, -1); max = (1, 1);', walls='', bodies=can,
                        shapes='{ box = ((-0.5, -0.3), (0.5, 0.3)); }', output='snapshots = false; series = 1;'))
for what in 't', 'can force x', 'max density':
    swung[what] = column('can/series.csv', what)
close('densest water of a can that is swung', max(swung['max density']), 1000.0, 0.01)
late = [(f, math.sin(2 * math.pi * t)) for t, f in zip(swung['t'], swung['can force x']) if t > 1]
close('force that swings a full can', sum(f * wave for f, wave in late) / sum(wave ** 2 for _, wave in late),
       600 * 0.05 * (2 * math.pi) ** 2, 0.03)

# What a disc that swings in a full box feels is its added mass, whatever the speed of sound: the default one lets sound cross the
# box in a sixth of a swing (by ten times the fastest water alone, a third of that, the water rings with it: -63 %, and late).
disc = changed(TANK, time='end = 2.0;', fluid='', domain='max = (1, 1);', walls=sides('x_min x_max y_min y_max'), shapes='',
               bodies='{ name = "disc"; radius = 0.15; centre = (0.5, 0.5); motion = ( { kind = "harmonic"; axis = "x"; amplitude = 0.01; period = 1.0; ramp = 1.0; } ); }',
               output='snapshots = false; series = 2;', sph='dx = 0.05;')
pushes = []
for c0 in '', ' c0 = 12.0;':
    run_case('disc', changed(disc, sph='dx = 0.05;' + c0))
    late = [(f, 2 * math.pi * t) for t, f in zip(column('disc', 't'), column('disc', 'disc force x')) if t > 1]
    pushes.append([2 * sum(f * part(wt) for f, wt in late) / len(late) for part in (math.sin, math.cos)])
close('added mass by the speed of sound', pushes[0][0], pushes[1][0], 0.06)
check(abs(pushes[0][1]) < 0.25 * pushes[1][0], 'a disc that swings is late by a part of %g' % (pushes[0][1] / pushes[1][0]))

write('swing.csv', ''.join('%g, %.9g, 0, 0\n' % (0.02 * k, 0.01 * math.sin(0.04 * math.pi * k)) for k in range(151)))
run_case('disc', re.sub(r'motion = \(.*?\);', 'motion = "swing.csv";', disc), '--check', words='c0 6 m/s')  # the same told by a file

# Pressure turns neither a disc nor a lying cylinder about its axis, however the water beside it lies; what pushes the end of one
# still turns it about the others. An eccentric disc turns by its weight.
run_case('disc', changed(TANK, time='end = 0.5;', sph='dx = 0.05;', bodies='{ name = "d"; radius = 0.2; centre = (0.47, 0.6); free = true; density = 500; lock = "x"; }'))
check(max(map(abs, column('disc', 'd spin'))) < 1e-12, 'a disc afloat spins: %g rad/s' % column('disc', 'd spin')[-1])
run_case('log', changed(TANK, time='end = 0.1;', domain='dim = 3; max = (0.8, 0.6, 0.6);', fluid='gravity = (0, 0, -9.81);', shapes='{ box = ((0, 0, 0), (0.8, 0.6, 0.3)); }',
                        walls=sides('x_min x_max y_min y_max z_min'), sph='dx = 0.05;',
                        bodies='{ name = "d"; radius = 0.12; length = 0.4; rotate = (0, 90, 0); translate = (0.43, 0.28, 0.32); free = true; density = 400; }'))
check(abs(column('log', 'd ox')[-1]) < 1e-3 * abs(column('log', 'd oy')[-1]) > 1e-6,
      'a log turns at %g, %g rad/s' % (column('log', 'd ox')[-1], column('log', 'd oy')[-1]))
run_case('eccentric', changed(TANK, time='end = 0.1;', sph='dx = 0.05;', bodies='{ name = "d"; radius = 0.2; translate = (0.5, 0.4); centre = (0.55, 0.4); free = true; mass = 125.7; inertia = 3; }'))
close('an eccentric disc', column('eccentric', 'd moment')[-1], -0.05 * column('eccentric', 'd force y')[-1], 0.02)

# Rows end on a surface between two of the lattice beside a box of a shallow draught, too, on either side of it.
run_case('draught', changed(TANK, time='end = 0.01;', sph='dx = 0.04;', bodies='{ name = "b"; box = ((0.36, 0.4), (0.64, 0.6)); }'))
close('lift of a shallow box at the start', column('draught', 'b force y')[0], 274.7, 0.01)
check(abs(column('draught', 'b force x')[0]) < 1e-6, 'a shallow box is pushed aside at the start: %g N/m' % column('draught', 'b force x')[0])

# What stands on the floor at the start and slides into a side is held before it, as what flies is: the floor's spring, which is
# that of the distance at the start, is not the side's.
for dim, case in (2, TANK), (3, changed(TANK, domain='dim = 3; max = (1, 0.4, 0.6);', fluid='gravity = (0, 0, -9.81);', walls=sides('x_min x_max y_min y_max z_min'))):
    low, high = ('0', '0.2') if dim == 2 else ('0.1, 0', '0.3, 0.2')
    run_case('slides', changed(case, time='end = 0.25;', sph='dx = 0.05;', shapes='{ box = ((0, 0%s), (0.4, %s)); }' % (('', '0.1') if dim == 2 else (', 0', '0.4, 0.1')),
                               output='snapshots = false; series = 1;',
                               bodies='{ name = "b"; box = ((0.6, %s), (0.8, %s)); free = true; density = 500; velocity = (1.7, 0); }' % (low, high)))
    x, u = column('slides', 'b x'), column('slides', 'b u')
    check(0.8 < max(x) < 0.89 and -1.0 < min(u) < -0.03, '%dD: a box slides into a side to x = %g m, back at %g m/s' % (dim, max(x), min(u)))

# A tank stands anywhere in its domain: rows begin on its floor and its sides, whether it is a body or a closed line.
for what, tank in (('bodies', '{ name = "t"; box = ((0, 0), (1, 0.6)); }'), ('walls', '{ points = ((0, 0), (1, 0), (1, 0.6), (0, 0.6)); closed = true; }')):
    run_case('anywhere', changed(changed(TANK, walls=''), time='end = 0.001;', domain='min = (-0.1, -0.14); max = (1.2, 1);', shapes='{ box = ((0, 0), (1, 0.4)); }', sph='dx = 0.04;', **{what: tank}))
    close('water in a tank half a spacing off the rows of its domain (%s)' % what, column('anywhere', 'mass')[0], 400, 0.01)

# The same on another body that has a side.
run_case('slides', changed(TANK, time='end = 0.2;', sph='dx = 0.05;', domain='max = (1.2, 0.6);', shapes='{ box = ((0, 0), (0.1, 0.05)); }', output='snapshots = false; series = 1;',
                           bodies='{ name = "ell"; points = ((0.2, 0), (0.2, 0.15), (0.85, 0.15), (0.85, 0.4), (1, 0.4), (1, 0)); }, '
                                  '{ name = "b"; box = ((0.5, 0.15), (0.7, 0.35)); free = true; density = 500; velocity = (1.7, 0); }'))
x, u = column('slides', 'b x'), column('slides', 'b u')
check(0.65 < max(x) < 0.74 and min(u) < -0.2, 'a box slides into the side of an angle to x = %g m, back at %g m/s' % (max(x), min(u)))

# A motion that begins elsewhere than the case draws the body: the water makes room there alone, and comes along in a tank.
run_case('begins', changed(TANK, bodies='{ name = "b"; box = ((0.1, 0.15), (0.3, 0.35)); motion = ( { kind = "polynomial"; axis = "x"; coefficients = (0.5); } ); }'))
close('water around a block that begins elsewhere', column('begins', 'mass')[0], 460, 0.01)
close('lift of a block that begins elsewhere', number('begins', 'force.y'), 392.4, 0.03)
run_case('begins_tank', changed(TANK, time='end = 0.02;', domain='min = (-1, -1); max = (2, 1);', walls='', shapes='{ box = ((0, 0), (1, 0.4)); }',
                                bodies='{ name = "t"; box = ((0, 0), (1, 0.8)); motion = ( { kind = "polynomial"; axis = "x"; coefficients = (0.2); } ); }'))
close('water in a tank that begins elsewhere', column('begins_tank', 'mass')[0], 400, 0.01)

# Contact knows no period: a block that is pushed against another one, both free, one above the other's middle, in the middle of the
# domain and across its end.
far = []
for low in -0.5, 0:
    blocks = ', '.join('{ name = "%s"; box = ((%g, %g), (%g, %g)); density = 500; free = true; %s }' % (name, x, y, x + 0.2, y + 0.2, more)
                       for name, x, y, more in (('a', 0.1, 0.3, 'velocity = (-0.5, 0);'), ('b', 0.75 if low == 0 else -0.25, 0.38, '')))
    run_case('across', changed(TANK, time='end = 0.22;', fluid='', domain='min = (%g, 0); max = (%g, 0.8); periodic = (true, false);' % (low, low + 1),
                               walls=sides('y_min'), shapes='{ box = ((%g, 0), (%g, 0.1)); }' % (low, low + 1), bodies=blocks,
                               initial='field = "rest"; U = 1.0;', sph='dx = 0.05; c0 = 10.0;', output='series = 1; snapshots = false;'))
    far.append([last('across', name) for name in ('a x', 'a u', 'a spin', 'b u', 'b spin')])
check(far[0][1] > -0.4 and max(abs(x - y) for x, y in zip(*far)) < 1e-9,
      'two blocks meet in the domain and across its end: %s, %s' % (far[0], far[1]))
# A flap that a driven block comes to later does not start in contact with it.
run_case('lifted', changed(TANK, bodies='''{ name = "flap"; box = ((0.2, 0.45), (0.9, 0.6)); free = true; density = 2500; hinge = { at = (0.25, 0.525); }; },
    { name = "lift"; box = ((0.7, 0.15), (0.85, 0.35)); motion = ( { kind = "polynomial"; axis = "y"; coefficients = (0.0, 0.2); } ); }'''), '--check')

# A drum that turns at 1 rad/s ends with its fluid as one body, of the energy rho pi/4, whichever form the viscous term has.
drum = changed(TANK, time='end = 4.0;', fluid='rho = 1.0; nu = 0.1;', domain='min = (-1.2, -1.2); max = (1.2, 1.2);', walls='',
               bodies='{ name = "drum"; radius = 1.0; spin = 1.0; kind = "no_slip"; }', shapes='{ form = "disc"; radius = 1.0; }')
for form in 'monaghan', 'morris':
    run_case('drum', changed(drum, sph='dx = 0.1; viscosity = "%s";' % form))
    close('energy of a drum, ' + form, last('drum', 'kinetic energy'), math.pi / 4, 0.02)
    # by then nothing rubs: 2 mu V w = 0.63 N
    check(abs(last('drum', 'drum moment')) < 0.06, 'moment of a drum, ' + form)

# A disc of water fills its drum on every level: slivers between it and the polygon of the drum are no air.
run_case('refined_drum', changed(drum, time='end = 0.01;', sph='dx = 0.1;', apr='levels = 1; regions = ( { level = 1; min = (-2, -2); max = (0, 2); } );'))
close('water of a drum, half of it refined', column('refined_drum', 'mass')[0], math.pi, 0.01)

# A solitary wave is its own exact solution until it meets something: with a slope or a body in its way, or an end that it
# reaches, no error is reported, and the energy is that of the fluid.
wave = changed(TANK, time='end = 0.05;', domain='max = (6, 1);', walls=sides('x_min x_max y_min'), sph='dx = 0.1;',
               initial='field = "solitary"; amplitude = 0.1; crest = 3.0; level = 0.5;').replace('shapes:', '# shapes:')
for name, known, case in (('plain', True, wave), ('reached', False, wave.replace('crest = 3.0', 'crest = 5.95')),
                          ('round', False, changed(wave, domain='max = (6, 1); periodic = (true, false);', walls=sides('y_min')).replace('crest = 3.0', 'crest = 5.95')),
                          ('slope', False, wave.replace('walls: (', 'walls: ( { points = ((6, 0.9), (4, 0), (0, 0)); }, ').replace(', { side = "y_min"; kind = "slip"; }', '')),
                          ('hull', False, changed(wave, bodies='{ box = ((5, 0.3), (5.5, 0.7)); }'))):
    run_case(name, case)
    check(math.isnan(number(name, 'error.velocity_l2')) != known, '%s: error of a solitary wave' % name)
    check(abs(number(name, 'drift.energy')) < 0.05, '%s: energy off by %g' % (name, number(name, 'drift.energy')))

# Archimedes in gaps of 1.5 dx: a square of 0.2 m over the floor, lift 392.4 N/m; and beside a second one, no force to
# the side beyond 2 % of p A on the near face (491 N/m). Three owners in one corner are an open case.
run_case('gap', changed(TANK, bodies='{ name = "b"; %s }' % points(0.4, 0.0375, 0.6, 0.2375)))
run_case('two', changed(TANK, bodies='{ name = "b"; %s }, { name = "c"; %s }'
                        % (points(0.4, 0.15, 0.6, 0.35), points(0.6375, 0.15, 0.8375, 0.35))))
close('square over the floor: lift', number('gap', 'force.y'), 392.4, 0.03)
check(abs(number('two', 'force.x')) < 0.02 * 491, 'square beside another: %g N/m to the side' % number('two', 'force.x'))
check(number('two', 'momentum.defect') < 1e-12, 'momentum of fluid, two bodies and walls: %g' % number('two', 'momentum.defect'))


# A barge of 0.8 m x 0.4 m, half immersed, held inclined by 0.08 rad: the restoring moment rho g A (BM - OB) sin, with that of
# wedges. 3 % is wanted; with half as many particles over its breadth it is 5 % too much.
angle, corners = 0.08, ((-0.4, -0.2), (-0.4, 0.2), (0.4, 0.2), (0.4, -0.2))
turned = ', '.join('(%.9g, %.9g)' % (1.2 + math.cos(angle) * x - math.sin(angle) * y, 0.5 + math.sin(angle) * x + math.cos(angle) * y)
                   for x, y in corners)
run_case('heel', changed(TANK, time='end = 0.6;', domain='max = (2.4, 0.8);',
                         bodies='{ name = "b"; centre = (1.2, 0.5); points = (%s); }' % turned))
metacentre = 0.8 ** 2 / 12 / 0.2
close('moment of an inclined barge', mean('heel/series.csv', 'b moment', 0.3),
       -9810 * 0.16 * math.sin(angle) * (metacentre - 0.1 + metacentre / 2 * math.tan(angle) ** 2), 0.03)

# A square wherever it stands along a period, at any fraction of dx and 0.1 dx from the periodic side: Archimedes and
# no force to the side by both rules, nothing put back; and a cube in the corner of two periods, 78.5 N.
def stands(name, upwards, lift, allowed_across):
    close(name + ': lift', number(name, 'force.' + upwards), lift, 0.03)
    for rule in 'x', 'average_x':
        across = number(name, 'force.' + rule)
        check(abs(across) < allowed_across, '%s: %s of %g N to the side' % (name, rule, across))
    check(number(name, 'particles_returned') == 0, name + ': particles put back')
    check(number(name, 'momentum.defect') < 1e-12, '%s: momentum off by %g' % (name, number(name, 'momentum.defect')))


period = changed(TANK, time='end = 0.3;', domain='max = (1, 0.6); periodic = (true, false);', walls=sides('y_min'))
for left in 0.0025, 0.0125, 0.79:
    name = 'period_%g' % left
    run_case(name, changed(period, bodies='{ name = "b"; %s }' % points(left, 0.15, left + 0.2, 0.35)))
    stands(name, 'y', 392.4, 9.8)
    # the force acts at the middle of the square, not at that of its image
    arm = last(name, 'b moment') / last(name, 'b force y') - left - 0.1
    check(abs(arm) < 0.005, '%s: the force acts %g m beside the middle of the square' % (name, arm))
box_stl('corner.stl', (0.025, 0.025, 0.15), (0.225, 0.225, 0.35))
run_case('corner', changed(TANK, time='end = 0.12;', fluid='gravity = (0, 0, -9.81);', walls=sides('z_min'), sph='dx = 0.05;',
                           domain='dim = 3; max = (0.7, 0.7, 0.6); periodic = (true, true, false);',
                           bodies='{ name = "b"; mesh = "corner.stl"; }'))
stands('corner', 'z', 78.48, 1.6)


def rebound(name, height, speed, rest, fall):
    """What a fall of so many m onto a place at rest brings back, of e^2 of it."""
    after = [(y, v) for y, v in zip(column(name, height), column(name, speed))]
    first = next(k for k, (_, v) in enumerate(after) if v > 0)
    up = (max(y for y, _ in after[first:]) - rest) / fall / 0.36
    check(0.88 < up < 1.08, '%s: rebound of %g times the wanted height' % (name, up))


# Dropped by 0.75 m on a dry floor (a spacing and a half above it): up again to e^2 of that.
EACH_STEP = 'series = 1; snapshots = false;'
drop = changed(TANK, time='end = 0.8;', domain='max = (3, 2);', initial='field = "rest"; U = 1.0;', output=EACH_STEP,
               walls=sides('x_min x_max y_min') + ', { points = ((0.8, 0), (0.8, 0.4), (0.5, 0.4), (0.5, 0)); }',
               shapes='{ form = "box"; box = ((0, 0), (0.5, 0.2)); }',
               bodies='''{ name = "ball"; free = true; density = 2000.0; contact = { restitution = 0.6; };
    points = ((1.5, 0.825), (1.3, 1.025), (1.5, 1.225), (1.7, 1.025)); }''')
for c0 in 40, 47:
    run_case('drop%d' % c0, changed(drop, sph='dx = 0.05; c0 = %d.0;' % c0))
    rebound('drop%d' % c0, 'ball y ', 'ball v ', 0.275, 0.75)


def restarted(name, case, until):
    """A run in two parts, in NAME_parts, ends as in one."""
    run_case(name, case)
    run_case(name + '_parts', case, '-p', 'time.end=%g' % until)
    run_case(name + '_parts', None, '--restart')
    ends = [open(folder + '/series.csv').readlines()[-1] for folder in (name, name + '_parts')]
    check(ends[0] == ends[1], '%s: the run after a restart is another one:\n%s%s' % (name, *ends))


# A square afloat on two lines, beside a piston: in two parts, and on two ranks.
afloat = changed(TANK, time='end = 0.3;', domain='min = (-0.3, 0); max = (1.5, 1);', initial='field = "rest"; U = 1.0;',
                 walls=sides('x_max y_min'), shapes='{ form = "box"; box = ((0, 0), (1.5, 0.5)); }', sph='dx = 0.04;',
                 output=EACH_STEP + ' checkpoint = 0.15;',
                 bodies='''{ name = "box"; free = true; density = 600.0; velocity = (0.3, 0.0); spin = 1.0;
    points = ((0.6, 0.4), (0.65, 0.65), (0.9, 0.6), (0.85, 0.35));
    lines = ( { from = (0.6, 0.4); to = (0.3, 0.0); stiffness = 500.0; pull_only = true; },
              { from = (0.85, 0.35); to = (1.2, 0.0); stiffness = 500.0; damping = 5.0; } ); },
    { name = "piston"; points = ((-0.2, 0), (-0.2, 0.9), (0, 0.9), (0, 0));
      motion = ( { kind = "harmonic"; axis = "x"; amplitude = -0.02; period = 0.5; ramp = 0.2; } ); }''')
restarted('float', afloat, 0.15)
run_case('shown', afloat, '-p', 'time.end=0.02', '-p', 'output.snapshots=true')
check(open('shown/sph_walls.xdmf').read().count('outline_1') == 2, 'snapshots show no bodies')
run_case('ranks', afloat, ranks=2)
for key in 'x', 'y', 'angle':
    one, two = (number(name, 'body.box.' + key) for name in ('float', 'ranks'))
    check(abs(one - two) < 1e-6, '%s of the box: %g on one rank, %g on two' % (key, one, two))
check(number('float', 'momentum.defect') < 1e-10, 'momentum off by %g' % number('float', 'momentum.defect'))

# 2 % of the water's density, under water: the step is the body's, and the run is sound.
light = afloat
for old, new in ('density = 600.0; velocity = (0.3, 0.0); spin = 1.0;', 'density = 20.0;'), ('damping = 5.0', 'damping = 1.0'), \
        ('from = (0.6, 0.4)', 'from = (0.6, 0.15)'), ('from = (0.85, 0.35)', 'from = (0.9, 0.15)'), \
        ('stiffness = 500.0', 'stiffness = 50.0'), \
        ('points = ((0.6, 0.4), (0.65, 0.65), (0.9, 0.6), (0.85, 0.35));', points(0.6, 0.15, 0.9, 0.35)):
    light = light.replace(old, new)
run_case('light', changed(light, time='end = 0.08;', output=EACH_STEP))
gain, step = number('light', 'watch.energy_gain'), max(column('light', 'dt')) * number('light', 'body.box.stopping_rate')
check(gain < 0.01 and 1.5 < step <= 2.0001, 'light body: gain %g, dt %g of its stopping time' % (gain, step))

# A body held, then let go, that particles hit, in a scheme that shares mass out over those near walls: the first list after
# a restart reaches as far as it would have, and the watch goes on counting who was put back.
restarted('held', changed(TANK, time='end = 0.2;', domain='min = (-1, -0.5); max = (1, 0.5);', shapes='{ form = "below"; level = 0; }',
                          sph='dx = 0.025; scheme = "riemann_ale";', output=EACH_STEP + ' checkpoint = 0.12;',
                          bodies='''{ name = "box"; free = true; density = 1500; release = 0.02;
    points = ((-0.3, -0.25), (-0.4, 0.1), (0.2, 0.25), (0.3, -0.1)); }'''), 0.12)
check(number('held', 'particles_returned') == number('held_parts', 'particles_returned'), 'particles put back are forgotten over a restart')

# An octahedron of triangles: dropped on a dry floor, and afloat over a restart.
write('octa.obj', ''.join('v %g %g %g\n' % tuple(0.2 * sign * (axis == k) for k in range(3)) for axis in range(3) for sign in (1, -1)) +
      ''.join('f %s\n' % face for face in ('1 3 5', '3 2 5', '2 4 5', '4 1 5', '3 1 6', '2 3 6', '4 2 6', '1 4 6')))
octa = changed(TANK, time='end = 0.06;', fluid='gravity = (0, 0, -9.81);',
               domain='dim = 3; min = (-0.4, -0.4, -0.4); max = (0.4, 0.4, 0.4);', initial='field = "rest"; U = 1.0;',
               walls=sides('x_min x_max y_min y_max z_min'), shapes='{ form = "below"; level = 0.0; }',
               bodies='{ name = "octa"; free = true; density = 600.0; mesh = "octa.obj"; rotate = (20, 0, 0); spin = (0, 2, 0); }',
               sph='dx = 0.05; R_dx = 2.5; walls = "nfm";', output=EACH_STEP + ' checkpoint = 0.03;')
restarted('octa', octa, 0.03)
check(number('octa', 'momentum.defect') < 1e-10, 'momentum in 3D off by %g' % number('octa', 'momentum.defect'))
mass = number('octa', 'body.octa.mass')
check(abs(mass - 600 * 4 / 3 * 0.008) < 1e-5, 'mass of the octahedron: %g kg' % mass)
run_case('fall', changed(octa, time='end = 0.5;', shapes='{ form = "box"; box = ((-0.4, -0.4, -0.4), (-0.25, 0.4, -0.2)); }',
                         output=EACH_STEP, sph='dx = 0.05; R_dx = 2.5; c0 = 30.0; walls = "nfm";',
                         bodies='''{ name = "octa"; free = true; density = 2000.0; translate = (0.1, 0, 0.15);
    contact = { restitution = 0.6; }; mesh = "octa.obj"; }'''))
rebound('fall', 'octa z ', 'octa w ', -0.125, 0.275)

# A gate that stands on a point, hinged there on the floor, between two levels: a spring bears
# rho g (h1^3 - h2^3)/6 = 99.7 N and what acts on the slopes of its foot, rho g (h1 - h2) 0.15^2/18 = 1.2 N
GATE = '''{ name = "gate"; %s free = true; density = 500;
    hinge = { at = (0.6, 0); stiffness = 5e4; damping = 2000; }; }'''
gate = changed(TANK, domain='max = (1.2, 0.8);',
               shapes='{ form = "box"; box = ((0, 0), (0.6, 0.5)); }, { form = "box"; box = ((0.6, 0), (1.2, 0.4)); }',
               bodies=GATE % 'points = ((0.6, 0), (0.55, 0.15), (0.55, 0.7), (0.65, 0.7), (0.65, 0.15));')
run_case('gate', gate)
spring = -5e4 * mean('gate', 'gate angle', 0.2)
check(95 < spring < 107, 'the spring of a gate bears %g instead of 101 N' % spring)
run_case('foot', changed(gate, bodies=GATE % points(0.55, 0, 0.65, 0.7)), '--check', code=2,
         words='starts in contact with wall 3.*let it stand on a point there')

# What stands on the floor, on the lid of a tank where gravity points up, or lies beside a wall from the start bears its weight
# less its buoyancy (3 %), where no particle fits below it; a light one comes up (water has to seep
# below it first) and floats by its density within dx
BLOCK = '{ name = "block"; free = true; density = %g; %s }'
under = changed(TANK, time='end = 1;', bodies=BLOCK % (2000, points(0.4, 0, 0.6, 0.2)))
shallow = changed(under, shapes='{ form = "below"; level = 0.1; }')
hangs = changed(under, fluid='gravity = (0, 1.62);', domain='min = (0, -0.8); max = (1, 0);', walls=sides('x_min x_max y_max'),
                bodies=BLOCK % (2000, points(0.4, -0.2, 0.6, 0)))
for name, wanted, case in ('under', 392.4, under), ('shallow', 588.6, shallow), ('hangs', 64.8, hangs):
    run_case(name, case)
    close('what bears a block, ' + name, mean(name, 'block contact', 0.7), wanted, 0.03)
run_case('rises', changed(TANK, time='end = 2.6;', domain='min = (0.1, 0); max = (0.9, 0.6);',
                          shapes='{ form = "below"; level = 0.3; }',
                          bodies=BLOCK % (500, points(0.35, 0, 0.65, 0.1))))
draught = 0.3 - mean('rises', 'block y ', 1.7)
check(abs(draught - 0.01875) < 0.02, 'the middle of a light block lies %g m under the first level instead of 0.01875' % draught)

# Blocks of one size on each other, whose faces are flush, stand as they are drawn (by their corners they fell into each other)
PILE = '{ name = "b%d"; free = true; density = 3000; %s }'
run_case('pile', changed(TANK, time='end = 0.25;', shapes='{ form = "box"; box = ((0, 0), (0.1, 0.1)); }',
                         bodies=', '.join(PILE % (k, points(0.4 + k // 3 * 0.2, k % 3 * 0.2, 0.6 + k // 3 * 0.2, k % 3 * 0.2 + 0.2)) for k in range(6)),
                         sph='dx = 0.05;', domain='max = (1, 0.8);'))
run_case('cubes', changed(TANK, time='end = 0.2;', domain='dim = 3; max = (0.8, 0.5, 0.8);', fluid='gravity = (0, 0, -9.81);',
                          shapes='{ form = "box"; box = ((0, 0, 0), (0.3, 0.5, 0.1)); }', walls=sides('x_min x_max y_min y_max z_min'),
                          bodies=', '.join(PILE % (k, 'box = ((0.4, 0.15, %g), (0.6, 0.35, %g));' % (0.2 * k, 0.2 * k + 0.2)) for k in range(2)),
                          sph='dx = 0.1;'))
for name, up, n in ('pile', 'y', 6), ('cubes', 'z', 2):
    for k in range(n):
        found = last(name + '/series.csv', 'b%d %s ' % (k, up))
        check(abs(found - 0.1 - k % 3 * 0.2) < 0.01, '%s: block %d stands at %g m' % (name, k, found))

# Blocks on or beside each other under water bear their weight less their buoyancy each, and nothing pushes them aside: as wide
# and no higher than R, slabs of a spacing, two in a row, a pile of three.
for name, boxes in (('stack', ((0.5, 0, 0.75, 0.1), (0.5, 0.1, 0.75, 0.2))), ('slab', ((0.5, 0, 0.75, 0.0375), (0.5, 0.0375, 0.75, 0.1875))),
                    ('between', ((0.5, 0, 0.75, 0.15), (0.5, 0.15, 0.75, 0.175), (0.5, 0.175, 0.75, 0.325))),
                    ('row', ((0.4, 0, 0.6, 0.3), (0.6, 0, 0.8, 0.2))), ('heap', ((0.4, 0, 0.6, 0.15), (0.6, 0, 0.8, 0.15), (0.5, 0.15, 0.7, 0.3)))):
    run_case(name, changed(TANK, time='end = 0.4;', domain='max = (1.2, 0.8);', shapes='{ box = ((0, 0), (1.2, 0.6)); }', sph='dx = 0.025;',
                           bodies=', '.join('{ name = "b%d"; free = true; density = 2000; %s }' % (k, points(*box)) for k, box in enumerate(boxes))))
    for k, (left, low, right, top) in enumerate(boxes):
        bears = 9810 * (right - left) * (top - low)
        close('%s, block %d: contact' % (name, k), mean(name + '/series.csv', 'b%d contact' % k, 0.2), bears, 0.06)
        near('%s, block %d: force aside' % (name, k), mean(name + '/series.csv', 'b%d force x' % k, 0.2), 0, 0.03 * bears)

# One that rocks on its edges comes to stand again: what has come in below it is not pressed flat (6 rad/s ended the run).
run_case('rocks', changed(TANK, time='end = 0.8;', domain='max = (1.2, 0.8);', shapes='{ box = ((0, 0), (1.2, 0.6)); }', sph='dx = 0.025;',
                          bodies='{ name = "b"; free = true; density = 2500; spin = 6; box = ((0.5, 0), (0.7, 0.3)); }'))
close('what has rocked: lift', mean('rocks/series.csv', 'b force y', 0.65), 588.6, 0.06)
check(0.02 < max(column('rocks', 'b angle')) and abs(column('rocks', 'b angle')[-1]) < 2e-3, 'a block that rocks stands at %g rad' % column('rocks', 'b angle')[-1])

# Two with a slit of 0.3 dx between them have their lift, whichever is listed first: the rim of the slit is where no other solid is in reach.
SLIT = ('{ name = "low"; free = true; density = 2000; %s }' % points(0.4, 0, 0.6, 0.3),
        '{ name = "held"; free = true; release = 10; density = 600; %s }' % points(0.6075, 0, 0.8075, 0.2))
for name, bodies in ('slit', SLIT), ('slit2', SLIT[::-1]):
    run_case(name, changed(TANK, domain='max = (1.2, 0.8);', shapes='{ box = ((0, 0), (1.2, 0.6)); }', sph='dx = 0.025;', bodies=', '.join(bodies)))
    for which, size in ('low', 0.06), ('held', 0.04):
        close('%s, lift of %s' % (name, which), mean(name + '/series.csv', which + ' force y', 0.2), 9810 * size, 0.06)
# What the room of a slit lacks is pressed once, not by the floor as well: two blocks 0.2 dx apart (67 N/m of the 990 on a side) and
# one apart rest, within 5 % of what presses on a side.
for name, gap in ('near', 0.005), ('apart', 0.025):
    run_case(name, changed(TANK, domain='max = (1.2, 0.8);', shapes='{ box = ((0, 0), (1.2, 0.6)); }', sph='dx = 0.025;',
                           bodies=', '.join('{ name = "%s"; free = true; density = 2000; %s }' % (b, points(x, 0, x + 0.2, 0.2)) for b, x in (('b', 0.4), ('c', 0.6 + gap)))))
    for b in 'b', 'c':
        forces = column(name, b + ' force x')[-40:]
        near('%s: force aside of %s' % (name, b), sum(forces) / len(forces), 0, 15)
        check(max(max(forces), -min(forces)) < 50, '%s: force aside of %s from %g to %g N/m' % (name, b, min(forces), max(forces)))

# Water seeps in from its own side of where solids touch. A disc on a floor of two bodies with air below has its lift, 308 N/m (half of
# it was missing). On the edges of a hole of 0.1 m over air it lacks what would press on its cap below them, p 0.1 m + rho g 0.0009 m^2 =
# 401 N/m for p at their height, 0.3996 m below the level (twice the force was told); within 8 % of that, for a disc of five spacings.
for name, hole, y, lift in ('joint', 0.0, 0.4005, 308.2), ('hole', 0.05, 0.387, -92.7):
    run_case(name, changed(TANK, time='end = 0.4;', domain='max = (0.7, 1);', shapes='{ box = ((0, 0.3), (0.7, 0.7)); }', sph='dx = 0.02;',
                           bodies='{ box = ((0, 0.22), (%g, 0.3)); }, { box = ((%g, 0.22), (0.7, 0.3)); }, { name = "disc"; free = true; radius = 0.1; '
                                  'translate = (0.35, %g); density = 1200; }' % (0.35 - hole, 0.35 + hole, y)))
    near('%s: lift of a disc' % name, mean(name + '/series.csv', 'disc force y', 0.15), lift, 0.08 * 401)

# A block that slides down a dry slope of 30 degrees, friction 0.2: g (sin - 0.2 cos) = 3.206 m/s^2 (1 %). Drawn the other way
# round the slope lets it fall through, and a contact nearer than it falls within a step is none: both are refused.
FREE = 'free = true; density = 1000; contact = { restitution = %g; friction = 0.2; gap = %g; };'
ON_SLOPE = 'points = ((1.4355127, 1.25433013), (1.5355127, 1.42753521), (1.88192286, 1.22753521), (1.78192286, 1.05433013));'


def sliding(line='(1, 1.5), (4.46410162, -0.5)', body=FREE % (0.01, 0.5) + ON_SLOPE):
    return changed(TANK, time='end = 0.6;', domain='min = (0, -1); max = (5, 2.5);', shapes='{ form = "box"; box = ((0, -1), (5, -0.8)); }',
                   walls=sides('x_min x_max y_min') + ', { points = (%s); }' % line, bodies='{ name = "block"; %s }' % body,
                   sph='dx = 0.05;', output=EACH_STEP)


run_case('slope', sliding())
t, u = column('slope', 't ['), column('slope', 'block u ')
first, then = (next(k for k, s in enumerate(t) if s > after) for after in (0.2, 0.5))
close('a block slides (m/s^2)', (u[then] - u[first]) / math.cos(math.radians(30)) / (t[then] - t[first]), 3.2059, 0.01)
# With friction that holds it (0.7 for tan 30 = 0.577), it does not creep: within dx/10 from when it has settled on.
run_case('holds', sliding(body=FREE.replace('0.2', '0.7') % (0.01, 0.5) + ON_SLOPE).replace('end = 0.6', 'end = 0.9'))
x = column('holds', 'block x ')
check(abs(x[-1] - x[len(x) // 2]) < 0.005, 'a block that friction holds has crept by %g m' % (x[-1] - x[len(x) // 2]))
behind = r'bodies.\[0\]: body 1 \(block\) stands behind wall 4, an open line'
low = points(0.4, -0.9, 0.6, -0.7)  # its corners are nearer to the floor than to the line
run_case('back', sliding('(4.46410162, -0.5), (1, 1.5)'), '--check', code=2, words=behind)
run_case('shut', sliding('(0, 2.2), (4.4, -1)', FREE % (0.01, 0.5) + low), '--check', code=2, words=behind)
run_case('still', sliding('(0, 2.2), (4.4, -1)', low), '--check', code=2, words=behind)
run_case('through', sliding(body=FREE % (0.5, 0.1) + points(1.5, 1.6, 1.7, 1.8)), '--check', code=2,
         words=r'bodies.\[0\].contact: contact.gap of 0.1 sph.dx is 0.005 m, and a body that falls')

# A body around all water is a tank. Full to its roof and shaken up and down, by 0.05 sin(2 pi t) m, its floor bears rho (g + a) h
# more than its roof (2 %); part full and rolling, its level at the wall is that of fv's block (3 % of its range); at rest a float
# in it stands by its density within dx, its weight on the tank's floor (1 %). Its points say nothing of its mass.
VESSEL = 'name = "tank"; points = ((-0.5, 0), (0.5, 0), (0.5, 0.6), (-0.5, 0.6)); centre = (0, 0); %s'
MOVES = 'motion = ( { kind = "harmonic"; axis = "%s"; amplitude = %g; period = %g; ramp = %g; } );'
vessel = changed(TANK, time='end = 1.2;', domain='min = (-0.7, -0.3); max = (0.7, 0.8);', sph='dx = 0.025;', walls='', output='series = 2; snapshots = false;',
                 shapes='{ form = "box"; box = ((-0.5, 0), (0.5, 0.6)); }', bodies='{ %s }' % VESSEL % MOVES % ('y', 0.05, 1.0, 0.5),
                 probes='{ name = "low"; at = (0, 0.001); body = "tank"; }, { name = "top"; at = (0, 0.599); body = "tank"; }')
run_case('shaken', changed(vessel, sph='dx = 0.04;'), words='body 1 .tank. is a tank')
off = [low - top - 1000 * (9.81 - 0.05 * (2 * math.pi) ** 2 * math.sin(2 * math.pi * t)) * 0.598
       for t, low, top in zip(*(column('shaken', of) for of in ('t [', 'low', 'top'))) if t > 0.6]
check(len(off) > 100 and max(map(abs, off)) < 0.02 * 9810 * 0.598, 'a shaken tank: %g Pa off' % max(map(abs, off)))
gauge = '{ name = "H"; kind = "level"; at = (-0.4, 0.05); body = "tank"; }'
rolls = changed(vessel, time='end = 2.4;', shapes='{ form = "box"; box = ((-0.5, 0), (0.5, 0.2)); }', probes=gauge,
                bodies='{ %s }' % VESSEL % MOVES % ('rz', 0.07, 1.6, 1.6))
run_case('rolls', rolls)
block = 'name = "tank"; min = (-0.5, 0); max = (0.5, 0.6); cells = (50, 30); centre = (0, 0); %s'
block %= 'i_min = "slip"; i_max = "slip"; j_min = "slip"; j_max = "slip"; ' + MOVES % ('rz', 0.07, 1.6, 1.6)
run_case('rolls_fv', re.sub('^(bodies|walls|sph).*?\n', '', changed(rolls, blocks='') .replace('blocks: {  }', 'blocks: ( { %s } )' % block), flags=re.M) +
         'fv: {};', program='fv')
t, level = column('rolls', 't ['), column('rolls', 'H')
fv_t, fv_level = column('rolls_fv', 't ['), column('rolls_fv', 'H')
off = [next(h for s, h in zip(fv_t, fv_level) if s >= at) - h for at, h in zip(t, level) if at < 2.39]
rms = math.sqrt(sum(o * o for o in off) / len(off))
check(rms < 0.03 * (max(fv_level) - min(fv_level)), 'a rolling tank: its level is %g m off that of fv' % rms)
run_case('holds_float', changed(vessel, shapes='{ form = "box"; box = ((-0.5, 0), (0.5, 0.3)); }', probes='{ name = "H"; kind = "level"; at = (0.3, 0); }',
                                bodies='{ %s }, { name = "float"; free = true; density = 500; box = ((-0.1, 0.2), (0.1, 0.4)); }' % VESSEL % ''))
check(abs(last('holds_float', 'float y ') - 0.3) < 0.02, 'a float in a tank stands at %g m' % last('holds_float', 'float y '))
run_case('weighs', changed(vessel, bodies='{ %s }' % VESSEL % 'free = true; density = 2000;'), '--check', code=2, words='say nothing of its own mass')
# In 3D, too: at rest its floor bears the weight of the water (2 %).
run_case('vessel3', changed(vessel, time='end = 0.3;', fluid='rho = 1000.0; gravity = (0, 0, -9.81);', domain='dim = 3; min = (0, 0, 0); max = (0.5, 0.4, 0.4);',
                            shapes='{ form = "box"; box = ((0.1, 0.1, 0.1), (0.4, 0.3, 0.25)); }', probes='', sph='dx = 0.025;',
                            bodies='{ name = "tank"; box = ((0.1, 0.1, 0.1), (0.4, 0.3, 0.35)); }'), words='fluid inside')
close('weight of the water in a tank at rest', mean('vessel3', 'tank force z', 0.1), -9810 * 0.3 * 0.2 * 0.15, 0.02)
lib.end('%d faults' % lib.failed)
