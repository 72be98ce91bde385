"""Scenes of particles alone, on defaults, against exact solutions. SPDX-License-Identifier: BSD-3-Clause"""
import math
import shutil

import lib
from lib import bad, below, column, last, mean as mean_of, near, run_case, says, summary, varied, write

lib.scratch()


def scene(end, dx, text):
    return 'format = 1; time: { end = %g; }; sph: { dx = %g; }; output: { snapshots = false; };\n' % (end, dx) + text


def ends_at(what, case, title, wanted, most):
    """The last value of a column."""
    near(what, last(case + '/series.csv', title), wanted, most, case + '.txt')


def ring(points, radius, way):
    """Of a circle about the origin, 1: counter-clockwise."""
    turn = 2 * math.pi / points
    return ', '.join('(%.6f, %.6f)' % (radius * math.cos(k * turn), way * radius * math.sin(k * turn)) for k in range(points))


# Couette flow between cylinders of 0.5 m, which turns at 1 rad/s, and 1 m: the torque is
# 4 pi mu w r1^2 r2^2/(r2^2 - r1^2) = 209.4 N. Friction by nu Lap u alone has 130.9.
couette = scene(2.5, 0.05, '''fluid: { nu = 0.05; }; domain: { min = (-1.1, -1.1); max = (1.1, 1.1); };
walls: ( { closed = true; kind = "no_slip"; points = (%s); } );
bodies: ( { name = "inner"; kind = "no_slip"; spin = 1; points = (%s); } );
''' % (ring(64, 1, 1), ring(32, 0.5, -1)))
run_case('couette', couette)
ends_at('torque of Couette flow, N', 'couette', 'inner moment', -209.4, 4)
# and of one that is free: it runs down by the torque over its inertia; from 2 s on all layers go with it, whose inertia is a
# tenth of its own
run_case('runs_down', varied(couette, 'spin = 1;', 'spin = 1; free = true; mass = 1000; inertia = 2000; lock = "x y";',
                         'end = 2.5', 'end = 5', 'dx = 0.05', 'dx = 0.0625'))
turns = list(zip(column('runs_down/series.csv', 't '), column('runs_down/series.csv', 'inner spin')))
(t0, spin0), (t1, spin1) = next(row for row in turns if row[0] >= 2), turns[-1]
rate = math.log(spin0 / spin1) / (t1 - t0)
near('a free cylinder runs down, 1/s', rate, 0.1047, 0.0105, 'runs_down.txt')

# Slow flow through a square array of cylinders, a = L/5: the mean velocity is g L^2/(nu F), F = 30.3 (Sangani & Acrivos, Int. J.
# Multiphase Flow 8, 1982). Four particles across a, the velocity of which is right within the square of (dx/a): 3 % (8 % with
# friction by the heights over the polygon's faces).
run_case('array', scene(0.5, 0.05, '''fluid: { nu = 1; gravity = (3.79, 0); }; domain: { max = (1, 1); periodic = (true, true); };
bodies: ( { name = "rod"; radius = 0.2; centre = (0.5, 0.5); kind = "no_slip"; } );
'''))
near('flow through an array of cylinders, m/s', mean_of('array', 'momentum x', 0.3) / 1000, 3.79 / 30.3, 0.05 * 3.79 / 30.3, 'array.txt')

# Vortices of Re 50 (L = 50 dx) die as the exact ones do: divided by a lattice's second moment friction of a disordered set
# was 0.2 % short, and 0.2 % of the energy was left over
run_case('vortices', scene(0.5, 0.02, '''fluid: { rho = 1; nu = 0.02; }; domain: { max = (1, 1); periodic = (true, true); };
initial: { field = "taylor_green"; U = 1; L = 1; };
'''))
near('energy of vortices over the exact one', summary('vortices')['drift']['energy'], 0, 0.001, 'vortices.txt')

# Water at rest at 1.2 m over a floor with a step, a slope and a shelf, above the bottom of the domain, with a block in it
gauges = '0.15, 0', '0.02, 0.5', '0.5, 0.2', '0.5, 0.7', '0.5, 0.5', '0.5, -0.5', '1.5, 0', '1.02, 0.5', '2.5, 0', '3.45, 0.9'
levels = scene(0.01, 0.05, '''fluid: { gravity = (0, -9.81); }; domain: { min = (-0.5, -0.5); max = (4, 2); };
walls: ( { points = ((0, 1.8), (0, 0), (1, 0), (1, 0.3), (2, 0.3), (3, 0.8), (3.5, 0.8), (3.5, 1.8)); } );
bodies: ( { name = "sill"; points = ((0.3, 0.4), (0.3, 0.6), (0.7, 0.6), (0.7, 0.4)); } );
shapes: ( { box = ((0, 0), (3.5, 1.2)); } ); probes: ( %s );
''' % ', '.join('{ name = "L%d"; kind = "level"; at = (%s); }' % place for place in enumerate(gauges, 1)))
run_case('levels', levels)
for k in range(1, 11):
    ends_at('level gauge %d, m' % k, 'levels', 'L%d ' % k, 1.2, 0.05)
# a dry block does not count, and what stands on it does: 0.3 m of water below it, 0.2 m on a table beside
run_case('dry', varied(levels, 'box = ((0, 0), (3.5, 1.2))', 'box = ((0, 0), (0.95, 0.35)); }, { box = ((1, 0.3), (2, 0.5))'))
for gauge, level in ('L3 ', 0.35), ('L7 ', 0.5):
    near('level of two waters, m', column('dry/series.csv', gauge)[0], level, 0.05, 'dry.txt')

# Water that runs off both ends of a table: it falls, hardly any comes behind the table (less than a twentieth), and what does
# is said. Drawn as a floor with water over its end a line is refused; drawn with both faces it runs.
table = scene(0.9, 0.025, '''fluid: { gravity = (0, -9.81); }; domain: { min = (-1.5, -1); max = (2, 1.5); };
walls: ( { points = ((-0.5, 0), (1, 0)); } ); shapes: ( { box = ((0, 0), (0.4, 0.5)); } );
''')
run_case('table', table)
for line in open('table.txt'):
    if ' of them behind walls' in line and int(line.split(' of them behind')[0].split()[-1]) > 16:
        bad('a twentieth of the water and more comes behind the table', 'table.txt')
if says('^warning(?!.*left the region)', 'table.txt'):
    bad('the table warns', 'table.txt')
run_case('slot', varied(table, '(1, 0)', '(0.3, 0)'), code=2)
if not says(r'slot.cfg:3: walls.\[0\].points: the line has water at its end', 'slot.txt'):
    bad('a line that ends in water is not refused', 'slot.txt')
run_case('faces', varied(table, 'end = 0.9', 'end = 0.1', '(-0.5, 0), (1, 0));',
                     '(-0.5, 0), (-0.5, -0.1), (0.3, -0.1), (0.3, 0)); closed = true;'))

# A channel that a line narrows to a half from the inlet to the outlet: p falls by 3/2 rho U^2 = 1500 Pa (Bernoulli; walls
# that slip lose nothing), within a twentieth of the head of the throat, 2000 Pa. The line goes on beyond both as a side does:
# nobody comes round its ends.
run_case('narrows', scene(3, 0.05, '''domain: { max = (2.5, 1); }; initial: { field = "uniform"; velocity = (1, 0); };
walls: ( { side = "x_min"; kind = "inflow"; velocity = (1, 0); }, { side = "x_max"; kind = "outflow"; }, { side = "y_min"; },
           { points = ((2.5, 0.5), (1.6, 0.5), (0.8, 1), (0, 1)); } );
probes: ( { name = "wide"; at = (0.4, 0.5); }, { name = "narrow"; at = (1.9, 0.25); } );
'''))
late = [row for row in zip(*(column('narrows/series.csv', title) for title in ('t ', 'dt ', 'wide', 'narrow'))) if row[0] > 2]
fall = sum(dt * (wide - narrow) for _, dt, wide, narrow in late) / sum(row[1] for row in late)
near('fall of the pressure, Pa', fall, 1500, 100, 'narrows.txt')
# the inlet lets the blow of the start out: what still goes to and fro is less than the head of the inflow, 500 Pa, over ten
wide = [row[2] for row in late]
near('sound that stays in the channel, Pa', max(wide) - min(wide), 0, 100, 'narrows.txt')
for what in 'particles_returned', 'particles_lost':
    near(what + ' at the ends of a line on an open side', summary('narrows')[what], 0, 0, 'narrows.txt')

# A square duct, its profile made by no-slip walls from a uniform inflow, Re 25: of 600 particles that pass, the
# outlet pressed 20 % into the walls, for the flow beyond it had the means of three rows
duct = scene(0.6, 0.0625, '''fluid: { nu = 0.02; }; domain: { dim = 3; max = (1.25, 0.5, 0.5); };
initial: { field = "uniform"; velocity = (1, 0, 0); };
walls: ( { side = "x_min"; kind = "inflow"; velocity = (1, 0, 0); }, { side = "x_max"; kind = "outflow"; },
           { side = "y_min"; kind = "no_slip"; }, { side = "y_max"; kind = "no_slip"; },
           { side = "z_min"; kind = "no_slip"; }, { side = "z_max"; kind = "no_slip"; } );
''')
run_case('duct', duct)
near('particles of a duct that come through its walls', summary('duct')['particles_returned'], 0, 5, 'duct.txt')

# A round pipe of triangles through both open sides: the inlet bears nobody beside it, where 125 were lost at once
n, m = 24, 12
angles = [2 * math.pi * k / n for k in range(n)]
corners = ['v %g %g %g\n' % (-0.5 + 2.5 * i / m, 0.25 + 0.25 * math.cos(a), 0.25 + 0.25 * math.sin(a))
           for i in range(m + 1) for a in angles]
quads = [(i * n + k + 1, i * n + (k + 1) % n + 1) for i in range(m) for k in range(n)]
write('pipe.obj', ''.join(corners + ['f %d %d %d\nf %d %d %d\n' % (a, b, b + n, a, b + n, a + n) for a, b in quads]))
run_case('pipe', varied(duct[:duct.index('           { side = "y_min"')], 'end = 0.6', 'end = 0.15', 'max = (1.25, 0.5, 0.5)',
                    'min = (0, -0.0625, -0.0625); max = (1.5, 0.5625, 0.5625)') + '{ mesh = "pipe.obj"; kind = "no_slip"; } );\n')
near('particles lost from a pipe', summary('pipe')['particles_lost'], 0, 0, 'pipe.txt')
near('particles that a pipe returned', summary('pipe')['particles_returned'], 0, 9, 'pipe.txt')
ends_at('water in a pipe, kg', 'pipe', 'mass', 1000 * 1.5 * 12 * 0.0625 * math.sin(math.pi / 12), 9)

# A tank that the domain cuts off is refused at each of the sides that cut it
run_case('cut', scene(0.1, 0.05, '''domain: { min = (-1.2, -1.2); max = (1.2, 1.4); };
walls: ( { closed = true; points = ((-0.366, -1.366), (1.366, -0.366), (0.366, 1.366), (-1.366, 0.366)); } );
'''), code=2)
# So is a channel of open lines that run the wrong way, between an inlet and an outlet: fluid at bare sides (it diverged)
line = '(0, 0.2), (0.4, 0.2), (0.4, 0.6), (1.2, 0.6)', '(1.2, 0.3), (0.7, 0.3), (0.7, 0), (0, 0)'
back = '(1.2, 0.6), (0.4, 0.6), (0.4, 0.2), (0, 0.2)', '(0, 0), (0.7, 0), (0.7, 0.3), (1.2, 0.3)'
bare = scene(0.05, 0.025, '''domain: { max = (1.2, 0.7); };
walls: ( { side = "x_min"; kind = "inflow"; velocity = (0.5, 0); }, { side = "x_max"; kind = "outflow"; },
          { points = (%s); }, { points = (%s); } );
''')
run_case('bare', bare % line, code=2)
run_case('right', bare % back)
for case, words, sides in ('cut', 'which is open, cuts the tank at', 3), ('bare', 'which is open, has fluid at', 2):
    if sum(words in line for line in open(case + '.txt')) != sides:
        bad('%s: not told at %d sides: %s' % (case, sides, words), case + '.txt')

# A line that hangs from the lid, drawn the wrong way round, is a baffle, not the only tank; a channel between walls that
# leaves out two thirds of what a level draws is warned of (1 %: the weight compresses the water by gH/c0^2)
baffle = scene(0.01, 0.02, '''fluid: { gravity = (0, -9.81); }; domain: { max = (1, 0.6); };
walls: ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; },
          { points = ((0.3, 0.6), (0.3, 0.2), (0.46, 0.2), (0.46, 0.6)); } );
shapes: ( { form = "below"; level = 0.4; } );
''')
run_case('baffle', baffle)
run_case('channel', varied(baffle, '(0.3, 0.2), (0.46, 0.2), (0.46, 0.6)', '(0.3, 0.05), (0.6, 0.05), (0.62, 0.6)', '(0.3, 0.6)', '(0.1, 0.6)'))
ends_at('water around a baffle, kg', 'baffle', 'mass', 368, 4)

# Water at rest, a box through its surface: what the law of shifting carried across the switch turned the water
# about it, 1.8e-3 c0 after 1500 steps and 5e-3 after 2e4. Wanted: below 1e-3.
rest = scene(1.5, 0.025, '''fluid: { gravity = (0, -9.81); }; domain: { max = (0.5, 0.4); };
walls: ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } ); shapes: ( { form = "below"; level = 0.25; } );
apr: { regions = ( { min = (0.25, 0); max = (0.6, 0.4); } ); };
''')
run_case('rest', rest)
if says('^warning', 'rest.txt'):
    bad('water at rest warns', 'rest.txt')
if not 0 < summary('rest')['max_mach'] < 1e-3:
    bad('water at rest: %g c0' % summary('rest')['max_mach'], 'rest.txt')

# The same along a beach, where the region's edge leans: volumes beside the bed are filled on all levels and of guards, too.
# Without that 2e-3 c0, and growing.
beach = varied(rest, 'end = 1.5', 'end = 1.2', 'dx = 0.025', 'dx = 0.04', 'max = (0.5, 0.4)', 'max = (1.2, 0.7)', 'level = 0.25', 'level = 0.5',
               '{ side = "y_min"; }', '{ side = "y_min"; }, { points = ((0.6, 0), (1.2, 0.3)); }',
               'min = (0.25, 0); max = (0.6, 0.4);', 'shape = "wall"; wall = 4; offset = 0.35;')
run_case('beach', beach)
below('water at rest along a beach, its second half, c0', max(m for t, m in zip(column('beach/series.csv', 't '), column('beach/series.csv', 'max Mach')) if t > 0.6),
      1e-3, 'beach.txt')

# A region that swings up and down in water at rest: children leave it with their parent, and come anew with it. Each by its own
# depth, some were missing where the edge turned back and others there twice: 0.026 c0, and growing.
swings = scene(0.4, 0.04, '''fluid: { gravity = (0, -9.81); }; domain: { max = (0.4, 1); };
walls: ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } ); shapes: ( { box = ((0, 0), (0.4, 0.8)); } );
apr: { regions = ( { min = (-0.1, 0.15); max = (0.5, 0.65); motion = ( { kind = "harmonic"; axis = "y"; amplitude = 0.08; period = 0.5; } ); } ); };
''')
run_case('swings', swings, '-p', 'sph.R_dx=3', '-p', 'sph.c0=30')
below('water at rest in a region that swings, c0', summary('swings')['max_mach'], 0.004, 'swings.txt')

# A block that goes through water at 0.25 m/s, before a region it has not reached: Archimedes' 392.4 N/m within 3 %. Levels
# whose volumes follow div u alone lose 9 % of it, for what it stirs sinks.
stirred = scene(1.2, 0.05, '''fluid: { gravity = (0, -9.81); }; domain: { max = (1.4, 1.2); };
walls: ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } ); shapes: ( { box = ((0, 0), (1.4, 0.8)); } );
bodies: ( { name = "block"; points = ((0.3, 0.3), (0.3, 0.5), (0.5, 0.5), (0.5, 0.3)); velocity = (0.25, 0); } );
apr: { regions = ( { min = (0.9, -0.1); max = (1.5, 1.3); } ); };
''')
run_case('stirred', stirred)
near('lift of a block that moves beside a region, N/m', mean_of('stirred', 'block force y', 0.9), 392.4, 11.8, 'stirred.txt')

# What is asked for and cannot be has a warning: a ball that touches the water within R of its edge alone; criteria
# whose least region is too much for the budget.
def with_levels(how):
    return varied(rest[:rest.index('regions')], 'end = 1.5', 'end = 0.02') + how + '; };'


run_case('thin', with_levels('regions = ( { shape = "sphere"; centre = (-0.3, -0.3); radius = 0.5; } )'))
run_case('poor', with_levels('levels = 1; particles = 300; criteria = ( { kind = "surface"; distance = 0; } )'))
for case, words in (('baffle', 'wall 4: its points had the fluid on their right: turned'),
                    ('channel', 'warning: lines among the walls leave out 6[0-9] % of the water'),
                    ('thin', '^warning: level 1: all fluid in its regions lies within R'),
                    ('poor', '^warning: .*too much for apr.particles = 300')):
    if not says(words, case + '.txt'):
        bad('%s: not told "%s"' % (case, words), case + '.txt')


def mean(case, until=math.inf):
    """Mean velocity along x at that time, or at the end, m/s."""
    t, momentum, mass = (column(case + '/series.csv', title) for title in ('t ', 'momentum x', 'mass'))
    row = max(k for k in range(len(t)) if t[k] <= until)
    return momentum[row] / mass[row]


# Bed friction tau = rho c_f u^2. A sheet 0.1 m deep slows down, u = u0/(1 + c_f u0 t/d); on an incline it keeps
# u^2 = g sin(a) d/c_f. Viscosity enough that it moves as one (nu/(c_f u d) = 10). The layers beside the wall count by
# their Shepard factors, which makes the sheet 0.4 dx thinner: 3 % in u, half of it at half the spacing. 3D as 2D.
sheet = scene(2, 0.0125, '''fluid: { nu = 0.05; gravity = (0, -9.81); }; domain: { max = (0.2, 0.2); periodic = (true, false); };
shapes: ( { box = ((0, 0), (0.2, 0.1)); velocity = (1, 0); } ); walls: ( { side = "y_min"; friction = 0.05; } );
''')
run_case('sheet', sheet)
near('momentum of a sheet on a rough floor', summary('sheet')['momentum']['defect'], 0, 1e-10, 'sheet.txt')
run_case('incline', varied(sheet, 'gravity = (0, -9.81)', 'gravity = (0.5, -9.81)', 'end = 2', 'end = 3'))
if lib.long:
    run_case('sheet_3d', varied(sheet, ', -9.81)', ', 0, -9.81)', '(0.2, 0.2)', '(0.2, 0.2, 0.15)', '(true, false)', '(true, true, false)',
                            '((0, 0), (0.2, 0.1))', '((0, 0, 0), (0.2, 0.2, 0.1))', '(1, 0)', '(1, 0, 0)', '"y_min"', '"z_min"',
                            'end = 2', 'end = 0.5', 'domain: {', 'domain: { dim = 3;', 'dx = 0.0125', 'dx = 0.02'))
for case, u, most in [('sheet', 0.5, 0.025), ('incline', 1, 0.05)] + [('sheet_3d', 0.8, 0.025)] * lib.long:
    near('velocity of a sheet on a rough floor, %s, m/s' % case, mean(case), u, most, case + '.txt')

# Plane Poiseuille flow between outlets 10 Pa apart: a mean of dp h^2/(12 rho nu L) = 1/24 m/s. The same flow when a
# constant is added to both pressures, with a body force in place of the pressures, and against gravity. A block on the floor
# feels what is added to the pressure, one that is wet all round the weight of what it displaces.
poiseuille = scene(3, 0.002, '''fluid: { nu = 1e-4; }; domain: { max = (0.08, 0.02); };
walls: ( { side = "x_min"; kind = "outflow"; pressure = 10; }, { side = "x_max"; kind = "outflow"; pressure = 0; },
          { side = "y_min"; kind = "no_slip"; }, { side = "y_max"; kind = "no_slip"; } );
''')
run_case('poiseuille', poiseuille)
through = mean('poiseuille')
near('flow between outlets, m/s', through, 0.041667, 0.0009, 'poiseuille.txt')
for case, changes in (('added', ('pressure = 10', 'pressure = 100010', 'pressure = 0', 'pressure = 100000')),
                      ('forced', ('pressure = 10', 'pressure = 0', 'nu = 1e-4;', 'nu = 1e-4; gravity = (0.125, 0);')),
                      ('uphill', ('pressure = 10', 'pressure = 794.8', 'nu = 1e-4;', 'nu = 1e-4; gravity = (-9.81, 0);'))):
    if case == 'forced' and not lib.long:
        continue
    run_case(case, varied(poiseuille, 'end = 3', 'end = 1.5', *changes))
    wanted = mean('poiseuille', until=1.5)
    near('the same flow, %s, m/s' % case, mean(case), wanted, 0.01 * wanted, case + '.txt')
blocks = varied(poiseuille, '0.08, 0.02', '0.1, 0.04', 'end = 3', 'end = 0.05', 'pressure = 10', 'pressure = 1000', 'pressure = 0',
                'pressure = 1000') + '''bodies: ( { name = "sill"; points = ((0.045, 0), (0.055, 0), (0.055, 0.01), (0.045, 0.01)); },
          { name = "free"; points = ((0.04, 0.02), (0.05, 0.02), (0.05, 0.03), (0.04, 0.03)); } );\n'''
run_case('blocks', blocks)
run_case('hanging', varied(blocks, '1000; }, { side = "x_max"', '981; }, { side = "x_max"', 'pressure = 1000', 'pressure = 0',
                       'nu = 1e-4;', 'nu = 1e-4; gravity = (-9.81, 0);'))
ends_at('1000 Pa press a sill 1 cm long, N/m', 'blocks', 'sill force y', -10, 0.3)
ends_at('1000 Pa press a block, N/m', 'blocks', 'free force y', 0, 0.3)
ends_at('buoyancy between outlets, N/m', 'hanging', 'free force x', 0.981, 0.03)

# A stream meets a square of four particles in a duct, with c0 100 times its speed: what a gauge on its front reads above the
# undisturbed stream is the dynamic pressure, 45 Pa, and behind it there is suction. Half of that is what a support as wide as
# the square leaves room for; the damper, where it takes errors of gradients for sound, makes -72 Pa there.
stream = scene(1.2, 0.025, '''domain: { max = (1.6, 0.6); }; initial: { field = "uniform"; velocity = (0.3, 0); };
walls: ( { side = "x_min"; kind = "inflow"; velocity = (0.3, 0); }, { side = "x_max"; kind = "outflow"; }, { side = "y_min"; }, { side = "y_max"; } );
bodies: ( { name = "pier"; box = ((0.75, 0.25), (0.85, 0.35)); } );
probes: ( { name = "up"; at = (0.4, 0.3); }, { name = "front"; at = (0.75, 0.3); }, { name = "back"; at = (0.85, 0.3); } );
''')
if lib.long:
    run_case('stream', varied(stream, 'dx = 0.025', 'dx = 0.025; c0 = 31'))
    up, front, back = (lib.mean('stream', gauge, 0.7) for gauge in ('up', 'front', 'back'))
    near('dynamic pressure before a square, Pa', front - up, 45, 22.5, 'stream.txt')
    lib.check(back < up, 'suction behind a square: %g Pa' % (back - up), 'stream.txt')

# The same under a free surface, where c0, 31 m/s, bears the depth: a pier of six particles. What the openings do makes no sound.
under = scene(1.2, 0.025, '''fluid: { gravity = (0, -9.81); }; domain: { max = (1.6, 0.7); };
initial: { field = "uniform"; velocity = (0.3, 0); }; shapes: ( { form = "below"; level = 0.5; } );
walls: ( { side = "x_min"; kind = "inflow"; discharge = 0.15; }, { side = "x_max"; kind = "outflow"; level = 0.5; }, { side = "y_min"; } );
bodies: ( { name = "pier"; box = ((0.7, 0.2), (0.9, 0.35)); } );
probes: ( { name = "up"; at = (0.35, 0.275); }, { name = "front"; at = (0.7, 0.275); }, { name = "back"; at = (0.9, 0.275); } );
''')
run_case('under', under)
up, front, back = (lib.mean('under', gauge, 0.9) for gauge in ('up', 'front', 'back'))
near('dynamic pressure before a pier under a surface, Pa', front - up, 45, 45, 'under.txt')
lib.check(back < up, 'suction behind a pier: %g Pa' % (back - up), 'under.txt')
late = [p - up for t, p in zip(column('under/series.csv', 't '), column('under/series.csv', 'up')) if t > 0.9]
near('sound under the surface, rms, Pa', math.sqrt(sum(p * p for p in late) / len(late)), 0, 45, 'under.txt')

# A column that hits a wall, with c0 140 times its speed: a box of the fine spacing gives what that spacing gives all over.
# A shift bounded by c0 instead of the expected speed was off there (7 % of y4). The run's end is before that of the case: exit code 1
shutil.copy(lib.root + '/cases/apr_column/wall.csv', '.')
column_case = open(lib.root + '/cases/apr_column/case.cfg').read()
short = '-p', 'time.end=0.1', '-p', 'output.snapshots=false'
run_case('fine', column_case, *short, '-p', 'sph.dx=0.4', '-p', 'apr.levels=0', '-p', 'apr.regions=()', code=1)
run_case('refined', column_case, *short, '-p', 'sph.dx=0.8', '-p', 'apr.levels=1', '-p', 'apr.regions=({min=(-9.6,0);max=(0,12);})', code=1)


def impulse(case, gauge):
    """Of its pressure over the run, Pa s."""
    t = column(case + '/series.csv', 't ')
    return sum((now - before) * p for before, now, p in zip([0] + t, t, column(case + '/series.csv', gauge)))


for gauge in 'y4', 'y6':
    wanted = impulse('fine', gauge)
    near('impulse of %s, Pa s' % gauge, impulse('refined', gauge), wanted, 0.01 * wanted, 'refined.txt')

# Water that falls on a floor from wall to wall, 14 rows from a height of 14.4: it is at rest before and after, so that the mean of
# the pressure over the whole time is its weight, and from 0.7 s on every gauge has rho g h. Compressed from R on, as if there
# were no air between it and the floor, it had 1.34 times that, and 6 % too much.
run_case('lands', scene(1.5, 0.025, '''fluid: { gravity = (0, -9.81); }; domain: { max = (0.625, 1.4); };
walls: ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } ); shapes: ( { box = ((0, 0.36), (0.625, 0.71)); } );
probes: ( { name = "floor"; at = (0.3125, 0); } );
''').replace('snapshots = false;', 'snapshots = false; series = 1;'))
depth = 9810 * 0.35
near('mean pressure of water that falls, Pa', impulse('lands', 'floor') / 1.5, depth, 0.08 * depth, 'lands.txt')
near('pressure of water that has fallen, Pa', lib.mean('lands', 'floor', 0.7), depth, 0.05 * depth, 'lands.txt')

# A film of eight rows without weight goes straight on over a slot of 2 dx in its plate, and over steps of 2 dx and dx/2 down: it lost
# 8, 4 and 10 % of its momentum, drawn down by the face before and stopped by the one behind.
film = scene(0.25, 0.01, '''fluid: { }; domain: { min = (-0.4, 0); max = (0.64, 0.4); };
walls: ( { points = ((-0.4, 0.1), (0.2, 0.1), (0.2, 0.02), (0.22, 0.02), (0.22, 0.1), (0.64, 0.1)); } );
shapes: ( { box = ((-0.38, 0.1), (0.04, 0.18)); velocity = (2, 0); } );
''')
run_case('over_slot', film)
run_case('over_step', varied(film, '(0.2, 0.02), (0.22, 0.02), (0.22, 0.1), (0.64, 0.1)', '(0.2, 0.08), (0.64, 0.08)'))
run_case('over_half', varied(film, '(0.2, 0.02), (0.22, 0.02), (0.22, 0.1), (0.64, 0.1)', '(0.2, 0.095), (0.64, 0.095)'))
for case in 'over_slot', 'over_step', 'over_half':
    first, *_, end = column(case + '/series.csv', 'momentum x')
    near('momentum of a film, %s' % case, end / first, 1, 0.005, case + '.txt')

lib.end('torque %g of 209.4 N, running down at %.4g of 0.105 1/s, fall of pressure %.5g of 1500 to 1800 Pa, flow between outlets %.4g'
        ' of 0.0417 m/s; %d faults' % (-last('couette/series.csv', 'inner moment'), rate, fall, through, lib.failed))
