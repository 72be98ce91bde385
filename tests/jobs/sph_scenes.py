"""Scenes as a newcomer writes them, on defaults: c0, limits and steps follow from the scene. They run through without a warning,
in any units; where the case sets what cannot work, the diagnosis names the remedy, alike on any number of ranks.
SPDX-License-Identifier: BSD-3-Clause"""
import math

import lib
from lib import TANK, changed, check, close, column, number, run_case, says, sides, summary

lib.scratch()
SIDES, DOWN = sides('x_min y_min x_max'), '(0, -9.81)'


def scene(end, dx, domain, gravity, walls, shapes, **groups):
    return changed(TANK, time='end = %.17g;' % end, sph='dx = %.17g;' % dx, domain=domain, fluid='gravity = %s;' % gravity, walls=walls,
                   shapes=shapes, **groups)


def box(left, low, right, high, more=''):
    return '{ form = "box"; box = ((%.17g, %.17g), (%.17g, %.17g)); %s }' % (left, low, right, high, more)


def warns(name):
    """Of anything but particles that leave, discs of few particles and the sound of a start at once."""
    return says('^warning(?!.*(left the region|first particles hold|bodies: star changes its velocity))', name + '.txt')


def runs(name, case, *args):
    """To its end, every value finite, without a warning."""
    run_case(name, case, *args)
    check(not warns(name), '%s %s: warns' % (name, args), name + '.txt')
    check(math.isfinite(number(name, 'watch.energy_gain')), '%s %s: its energy is not watched' % (name, args), name + '.txt')


def told(name, case, words, *args, code=0):
    """--check says so."""
    run_case(name, case, '--check', *args, code=code, words=words)


# a square of water into a corner, a column over an obstacle, jets, a drop into a pool, a film, a moving body
corner = scene(1, 0.04, 'min = (-2, 0); max = (0, 2);', '(0, 0)', sides('x_max y_min'), box(-0.9, 0.3, -0.3, 0.9, 'velocity = (1, -1);'))
jets = scene(0.6, 0.05, 'min = (-2, -2); max = (2, 2);', '(0, 0)', '',
             box(-1.2, -0.2, -0.2, 0.2, 'velocity = (2, 0);') + ', ' + box(0.2, -0.2, 1.2, 0.2, 'velocity = (-2, 0);'))
obstacle = scene(1, 0.04, 'max = (2, 1.2);', DOWN, '{ points = ((0, 1.2), (0, 0), (1.2, 0), (1.35, 0.2), (1.5, 0), (2, 0), (2, 1.2)); }',
                 box(0, 0, 0.5, 0.6))
runs('corner', corner)
runs('corner_ale', changed(corner, sph='dx = 0.04; scheme = "riemann_ale";'))
runs('oblique', scene(0.7, 0.042, 'max = (2, 2);', '(0, 0)', sides('x_min y_min'), box(0.3, 0.8, 1.3, 1.2, 'velocity = (-1.8, -0.8);')))
runs('jets', jets)
runs('jets_delta', changed(jets, sph='dx = 0.05; scheme = "delta";'))
runs('pool', scene(0.7, 0.05, 'max = (2, 1.4);', DOWN, SIDES,
                   '{ form = "below"; level = 0.4; }, { form = "disc"; centre = (1, 1.1); radius = 0.16; }'))
runs('film', scene(0.6, 0.04, 'max = (0.8, 0.6); periodic = (true, false);', '(1, -9)', sides('y_min'), box(0, 0, 0.8, 0.31)))
runs('column', obstacle)
runs('paddle', scene(0.6, 0.04, 'max = (1, 1.04);', '(0, 0)', sides('x_min x_max y_min y_max'), '',
                     bodies='{ spin = 1.5; centre = (0.5, 0.5); points = ((0.3, 0.44), (0.3, 0.56), (0.7, 0.56), (0.7, 0.44)); }'))
# jets onto a plate, in 2D until most has left; in 3D their rows converge on it, as those of a channel round a corner on its far
# side do: none goes through (446 of 425 and 409 of 474 particles were put back)
runs('jet2', scene(1, 0.02, 'min = (-0.5, -0.5); max = (0.3, 0.5);', '(0, 0)', sides('x_max'),
                    box(-0.5, -0.1, 0.2, 0.1, 'velocity = (1, 0);')))
runs('jet3', scene(1, 0.04, 'dim = 3; min = (-0.5, -0.5, -0.5); max = (0.3, 0.5, 0.5);', '(0, 0)', sides('x_max'),
                     '{ box = ((-0.5, -0.1, -0.1), (0.2, 0.1, 0.1)); velocity = (1, 0, 0); }'))
run_case('bend', scene(4, 0.03, 'max = (0.6, 0.6);', '(0, 0)', '{ side = "x_min"; kind = "inflow"; velocity = (0.5, 0); }, '
                   '{ side = "y_max"; kind = "outflow"; }, ' + sides('x_max y_min'), ''))
for name in 'jet3', 'bend':
    check(number(name, 'particles_returned') <= 0.01 * number(name, 'particles'), name + ': particles pass walls', name + '.txt')
# a dam that breaks onto a beach, drawn into the tank as one line more; water at rest before it
BEACH = SIDES + ', { points = (%s); }'
runs('beach', scene(0.6, 0.025, 'max = (2, 1.2);', DOWN, BEACH % '(1.2, 0), (2, 0.4)', box(0, 0, 0.5, 0.5)))
shore = scene(0.4, 0.025, 'max = (2, 1.2);', DOWN, BEACH % '(1.1, -0.05), (2.2, 0.5)', '{ form = "below"; level = 0.3; }')
runs('shore', shore)
check(0 < number('shore', 'max_mach') < 0.003, 'water before a beach does not rest', 'shore.txt')
told('plate', changed(shore, walls=BEACH % '(1.1, 0), (1.7, 0.25)'),
     r'walls.\[3\].points: the line stands on another wall .*both of its faces', code=2)

# what a coarse lattice cannot fill of a tank that is one open line is told beside what was asked; a fine one can
asked = scene(0.01, 0.05, 'min = (-0.12, -0.12); max = (1.12, 1);', DOWN, '{ points = ((0, 0.8), (0, 0), (1, 0), (1, 0.8)); }',
              '{ form = "below"; level = 0.28; }')
runs('asked', asked)
check(says('more than the shapes: 0.2[0-9]* of 0.2[78][0-9]* m.2', 'asked.txt'), 'the water asked for between open lines is not told',
      'asked.txt')
runs('asked', asked, '-p', 'sph.dx=0.02')
check(not says('^warning', 'asked.txt'), 'a lattice that fits is warned of', 'asked.txt')

# the same column 1024 times smaller and larger. Lengths by a power of four scale times by a power of two:
# nothing is rounded otherwise, so every figure without a unit is the same to its last digit
found = []
for k in 1 / 1024, 1, 1024:
    runs('units', scene(math.sqrt(k), 0.1 * k, 'max = (%.17g, %.17g);' % (4 * k, 3 * k), DOWN, SIDES, box(0, 0, k, 2 * k)))
    line = open('units/series.csv').readlines()[-1].split(',')
    found.append([number('units', 'steps'), number('units', 'max_mach'), *line[7:15]])
check(found[0] == found[1] == found[2], 'a column in other units is another flow: %s' % found)

# water that runs out where no wall is: the place, the same on two ranks
spill = scene(0.4, 0.05, 'max = (1, 0.8);', DOWN, sides('x_min y_min'), box(0, 0, 0.5, 0.4))
for n in 1, 2:
    run_case('spill', spill, ranks=n, words=r'left the region since the start, the first across x_max at \(1')

# c0 too low: the remedy is c0, the place is the same on any number of ranks
places = []
for n in 1, 2, 4:
    run_case('low', obstacle, '-p', 'sph.c0=3.0', ranks=n, code=3, words='likely .*raise it to 34.3 m/s')
    lines = open('low.txt').readlines()
    places += [lines[k:k + 3] for k, line in enumerate(lines) if 'diverged at' in line]
check(len(places) == 3 and places[0] == places[1] == places[2], 'c0 too low: ranks differ: %s' % places)
check('mach' in summary('low')['watch'], 'a run that failed does not tell its watches', 'low.txt')

# a star that starts at once in a full tank: its work against the weight of the water is known
runs('star', scene(0.16, 0.1, 'max = (4, 3);', DOWN, SIDES + ', ' + sides('y_max'), '', bodies='''{ name = "star"; velocity = (-0.3, -1.1);
    points = ((2.42, 2.24), (2.71, 1.85), (3.2, 1.86), (3, 1.42), (3.26, 1), (2.77, 0.95),
              (2.55, 0.52), (2.26, 0.91), (1.77, 0.9), (1.97, 1.34), (1.71, 1.76), (2.19, 1.81)); }'''), '-p', 'fluid.nu=0.001')

# creeping water that leans into a corner of slip walls
runs('creep', scene(2, 0.90625, 'max = (29, 9.0625);', '(-4.5427783941475974, -8.6947837501381109)', sides('x_min y_min y_max'),
                    box(0, 0, 29, 2.71875) + ', { form = "disc"; centre = (14.5, 5.96894454); radius = 2.1873; }'), '-p', 'fluid.nu=100')

# a lid at Re 0.1: friction's pressure sets c0, so that density stays within some percent; a given c0 that is too low is told
lid = changed(TANK, time='end = 0.005;', fluid='nu = 10.0;', initial='field = "rest";', shapes='', sph='dx = 0.1;',
              output='series = 1; snapshots = false;',
              walls=sides('x_min x_max y_min', 'no_slip') + ', { side = "y_max"; kind = "no_slip"; velocity = (1, 0); }')
runs('lid', lid)
check(1000 < max(column('lid', 'max density')) < 1030, 'creeping lid: density off by more than 3 %', 'lid.txt')
told('lid', lid, '^warning: sph.c0 = 10 m/s: friction alone .* raise it to 100 m/s', '-p', 'sph.c0=10')
told('lid', lid, '^warning: 2 particles between the walls along x', '-p', 'sph.dx=0.5')
told('lid', lid, 'sph.dx: 1 m: one particle has no room between the walls along x', '-p', 'sph.dx=1', code=2)

# what a body drives past itself sets c0: through a tenth of the section at nine times its speed, along the other axis of a
# full room, and not where water may rise over it or no gap is open
for axis, body, velocity, roof, words in (('y', '((0.05, 0.7), (0.95, 0.85))', '(0, -0.5)', '', '4.5 m/s: the moving bodies'),
                                          ('x', '((0.4, 0.2), (0.6, 1))', '(0.5, 0)', ' y_max', '1 m/s: the moving bodies'),
                                          ('x', '((0.4, 0.2), (0.6, 1))', '(0.5, 0)', '', '0.5 m/s: the moving bodies'),
                                          ('y', '((0, 0.7), (1, 0.85))', '(0, 0.5)', '', '0.5 m/s: the moving bodies')):
    water = '' if roof else box(0, 0, 1, 0.65)
    told('slab', scene(0.1, 0.025, 'max = (1, 1.2);', DOWN, sides('x_min x_max y_min' + roof), water, bodies='{ box = %s; velocity = %s; }' % (body, velocity)),
         'expected speed ' + words)

# water that nothing catches is told before it falls, and not where it is caught: by a tank of lines, of which "below"
# is meant to fill the inside alone, by a bowl under a drop, by a side that gravity at a slant leads to
# a box that fills a closed room leaves no air, and what jumps there makes sound that stays
told('filled', scene(1, 0.04, 'max = (1, 1.04);', '(0, 0)', sides('x_min x_max y_min y_max'), box(0, 0, 1, 1.04),
                     bodies='{ name = "disc"; radius = 0.15; centre = (0.5, 0.5); motion = ( { kind = "polynomial"; axis = "x"; '
                            'coefficients = (0.0, 0.0, 0.25); } ); }'), '^warning: bodies: disc changes its acceleration by 0.5 m/s')
FALLS = '^warning: nothing catches .* % of the water'
told('falls', scene(1, 0.04, 'max = (2, 1.2);', DOWN, sides('x_min y_max'), box(0, 0.2, 0.5, 0.6)), FALLS)
told('upward', scene(1, 0.04, 'max = (1, 1.2);', '(0, 9.81)', SIDES, box(0, 0, 1, 0.6)), FALLS)
told('spout', scene(1, 0.04, 'max = (2, 1.2);', DOWN, '{ points = ((0, 1.2), (0, 0.4), (0.6, 0.4)); }',
                    box(0.2, 0.4, 0.6, 0.8, 'velocity = (3, 0);')), FALLS)
runs('vat', scene(0.1, 0.05, 'min = (-2, -2); max = (3, 2);', DOWN, '{ points = ((0, 1), (0, 0), (1, 0), (1, 1)); }',
                  '{ form = "below"; level = 0.6; }'))
runs('bowl', scene(0.1, 0.04, 'max = (2, 1.2);', DOWN, '{ points = ((0.4, 0.5), (0.6, 0.2), (1, 0.2), (1.2, 0.5)); }',
                   '{ form = "disc"; centre = (0.8, 0.8); radius = 0.2; }'))
runs('slant', scene(0.1, 0.04, 'max = (1, 1.2);', '(-5, -7)', sides('x_min y_min'), box(0, 0, 0.4, 0.4)))

# a region that a body fills but for the guards at its edges refines nothing, and says so; a larger one does
REGION = 'regions = ( { min = (%g, %g); max = (%g, %g); } );'
idle = scene(0.005, 0.04, 'max = (2, 1.2);', DOWN, SIDES, box(0, 0, 2, 1), apr=REGION % (0.68, 0.24, 1.32, 0.88),
             bodies='{ points = ((0.84, 0.4), (0.84, 0.72), (1.16, 0.72), (1.16, 0.4)); }')
IDLE = '^warning: level 1 refines nothing'
run_case('idle', idle, words=IDLE)
run_case('busy', changed(idle, apr=REGION % (0.52, 0.08, 1.48, 1.04)))
check(not says('refines nothing', 'busy.txt'), 'a level with particles that flow is called idle', 'busy.txt')

# steps beyond the bound
for args in ('-p', 'sph.cfl=0.7'), ('-p', 'sph.cfl=1.3', '-p', 'sph.scheme="delta"'), ('-p', 'sph.cfl_viscous=0.2', '-p', 'fluid.nu=10'):
    run_case('never', jets, *args, code=2, words='is unstable with this')

# the added mass of a disc that oscillates in a full box, by any scheme: 49.01 kg/m by boundary elements (0.12 m; 45.2 without the
# box), of the force's part in phase with the acceleration over the last two of five periods
disc = scene(2, 0.02, 'max = (1.2, 0.9);', '(0, 0)', sides('x_min x_max y_min y_max'), '',
             bodies='{ name = "disc"; centre = (0.6, 0.45); radius = 0.12; '
                    'motion = ( { kind = "harmonic"; amplitude = 0.01; period = 0.4; ramp = 0.6; } ); }')
omega = 2 * math.pi / 0.4
for scheme in ('riemann', 'delta') if lib.long else ('riemann',):
    run_case(scheme, changed(disc, sph='dx = 0.02; c0 = 20; scheme = "%s";' % scheme))
    t, force = column(scheme + '/series.csv', 't [s]'), column(scheme + '/series.csv', 'disc force y [N/m]')
    waves = [(f, math.sin(omega * s)) for s, f in zip(t, force) if s > 1.2]
    mass = sum(f * w for f, w in waves) / sum(w * w for _, w in waves) / (0.01 * omega ** 2)
    close('%s: added mass of a disc of twelve particles' % scheme, mass, 49.01, 0.1)

# the jet under a gate as thick as its opening parts from it, for air comes below: free streamlines contract to 0.61 of the opening,
# and eight particles hold back up to 16 % (it filled the room below the gate: 0.84, and 8 % too much came through).
gate = scene(0.36, 0.01, 'max = (0.9, 0.32);', DOWN, sides('x_min y_min'), box(0, 0, 0.4, 0.24), bodies='{ name = "gate"; box = ((0.4, 0.08), (0.48, 0.32)); }',
             probes='{ name = "up"; kind = "level"; at = (0.15, 0); }, { name = "behind"; kind = "level"; at = (0.56, 0); }, '
                    '{ name = "through"; kind = "discharge"; at = (0.4, 0); to = (0.4, 0.08); }')
run_case('gate', gate)
t, up, behind, through = (column('gate/series.csv', title) for title in ('t [s]', 'up [m]', 'behind [m]', 'through [m^2/s]'))
rows = [(b / 0.08, q / 0.08 / math.sqrt(2 * 9.81 * h) * math.sqrt(1 + 0.61 * 0.08 / h)) for s, h, b, q in zip(t, up, behind, through) if s > 0.28]
close('contraction behind a gate', sum(row[0] for row in rows) / len(rows), 0.61, 0.16)
close('discharge of a gate', sum(row[1] for row in rows) / len(rows), 0.61, 0.16)
lib.end('%d faults' % lib.failed)
