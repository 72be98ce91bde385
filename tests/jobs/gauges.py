"""Gauges of velocity and discharge in both programs: a level channel that carries q = u h has it through any section, upright
or oblique, and the volume q t at the end; a section over the water has none; blocks say the same as cells, two ranks the
same as one; of a column that falls half goes through the middle; bodies take gauges along. SPDX-License-Identifier: BSD-3-Clause"""
import glob
import math

import lib
from lib import bad, check, column, last, mean, near, refused, run, run_case, says, start, summary, varied, write

lib.scratch()


def scene(end, text, series=1):
    return 'format = 1; time: { end = %g; }; output: { snapshots = false; series = %d; };\n' % (end, series) + text


def probes(kind, *places):
    """Gauges: name and place, of sections `from to end'."""
    return ', '.join('{ name = "%s"; kind = "%s"; at = (%s); }' % (name, kind, at.replace(' to ', '); to = ('))
                     for name, at in (place.split(None, 1) for place in places))


def ends_at(case, title, wanted, most):
    near('%s: %s at the end' % (case, title), last(case + '/series.csv', title), wanted, most, case + '.txt')


def volume(case, gauge, wanted, share):
    near('%s: m^2 through %s' % (case, gauge), summary(case)['discharge'][gauge]['volume'], wanted, share * wanted, case + '.txt')


# 1 m long, 0.2 m deep, 0.35 m/s
channel = scene(2, '''fluid: { gravity = (0, -9.81); }; domain: { dim = 2; max = (1, 0.4); };
initial: { field = "uniform"; velocity = (0.35, 0); };
walls: ( { side = "x_min"; kind = "inflow"; discharge = 0.07; }, { side = "x_max"; kind = "outflow"; level = 0.2; }, { side = "y_min"; } );
shapes: ( { form = "below"; level = 0.2; } );
probes: ( %s, %s, %s );
''' % (probes('level', 'inlet 0, 0', 'behind 0.03, 0', 'outlet 1, 0'),
       probes('discharge', 'flow 0.5, 0 to 0.5, 0.4', 'slant 0.4, 0 to 0.6, 0.4', 'turned 0.5, 0.4 to 0.5, 0',
              'over 0.5, 0.26 to 0.5, 0.4'),
       probes('velocity', 'in 0.5, 0.1', 'air 0.5, 0.35')), series=2)
run_case('cells', varied(channel, '{ side = "y_min"; }', '{ side = "y_min"; }, { side = "y_max"; }') + 'fv: { cells = (50, 20); };',
     program='fv')
run_case('grains', channel + 'sph: { dx = 0.02; c0 = 20.0; };')
if run(*lib.mpi, '-n', '2', lib.build + '/fv', 'cells.cfg', '-o', 'ranks', '--force', log='ranks.txt') != 0:
    bad('two ranks', 'ranks.txt')
for case in 'cells', 'grains':
    for gauge in 'flow', 'slant':
        ends_at(case, gauge, 0.07, 0.03 * 0.07)
        volume(case, gauge, 0.14, 0.03)
    ends_at(case, 'turned', -last(case + '/series.csv', 'flow'), 1e-9)
    for title, wanted, most in ('over', 0, 1e-6), ('in u', 0.35, 0.03 * 0.35), ('in v', 0, 0.01):
        ends_at(case, title, wanted, most)
    for title in 'inlet', 'behind', 'outlet':  # beside open sides, too, where sph's rows are born and removed: 0.05 to 0.25 of it
        levels = column(case, title)
        near('%s: lowest level at %s' % (case, title), min(levels), 0.2, 0.01, case + '.txt')
        near('%s: highest level at %s' % (case, title), max(levels), 0.2, 0.01, case + '.txt')
    if not math.isnan(last(case + '/series.csv', 'air u')):
        bad(case + ': a velocity of air')
    if not says('discharge  flow: 0.1[34]', case + '.txt'):
        bad(case + ': no volume in the log', case + '.txt')
for gauge in 'flow', 'slant', 'in u':
    wanted = last('cells/series.csv', gauge)
    ends_at('ranks', gauge, wanted, 1e-6 * wanted)

# Sections on the side of a period, or along all of one, and parts of a particle's width take what goes through them, in an
# oblique stream (exact, as of any lattice); those on open sides what comes in and goes out. At first sections beyond the
# domain or a period, and those without another end, are told.
stream = scene(0.3, '''domain: { max = (2, 1); periodic = (true, true); };
initial: { field = "uniform"; velocity = (1, 0.5); };
probes: ( %s ); sph: { dx = 0.05; };
''' % probes('discharge', 'seam 0, 0 to 0, 1', 'end 2, 0 to 2, 1', 'mid 0.51, 0 to 0.51, 1', 'thin 1, 0.5 to 1, 0.52'))
run_case('stream', stream)
run_case('ends', varied(stream, '(1, 0.5); };', '(1, 0); };', ' periodic = (true, true);', '') + '''walls: (
          { side = "x_min"; kind = "inflow"; velocity = (1, 0); }, { side = "x_max"; kind = "outflow"; },
          { side = "y_min"; }, { side = "y_max"; } );''')
for gauge in 'seam', 'end', 'mid':
    volume('stream', gauge, 0.3, 1e-9)
    volume('ends', gauge, 0.3, 0.01)
volume('stream', 'thin', 0.006, 1e-9)
refused('sph', varied(stream, 'to = (1, 0.52); ', ''), r'probes.\[3\].to: thin: must be given')
refused('sph', varied(stream, '(2, 0); to = (2, 1)', '(3, 0); to = (3, 1)'),
        r'probes.\[1\].at: end: its section, x from 3 to 3 m, lies outside')
refused('sph', varied(stream, 'to = (2, 1)', 'to = (2, 1.1)'),
        r'probes.\[1\].at: end: its section, y from 0 to 1.1 m, reaches beyond the period')

# Where levels of refinement meet a stream counts once, wherever the edge lies in a row of the coarser one (2 % off by whole rows).
run_case('levels', scene(0.1, '''domain: { dim = 2; max = (2, 1); periodic = (true, false); };
initial: { field = "uniform"; velocity = (1, 0); }; walls: ( { side = "y_min"; }, { side = "y_max"; } ); probes: ( %s );
apr: { regions: ( { level = 1; min = (0.4, -0.1); max = (1.6, 0.54); } ); }; sph: { dx = 0.04; c0 = 10.0; };
''' % probes('discharge', 'all 1, 0 to 1, 1', 'lower 1, 0 to 1, 0.6')))
for title, q in ('all', 1), ('lower', 0.6):
    for value in column('levels', title)[1:]:
        near('a stream through two levels, ' + title, value, q, 0.002 * q, 'levels.txt')
# A column of honey that falls in a closed tank, in cells and in two joined blocks: at rest half of it is beyond the middle.
tank = scene(4, '''fluid: { nu = 0.05; gravity = (0, -9.81); }; domain: { dim = 2; max = (0.8, 0.3); }; initial: { U = 2.0; };
shapes: ( { form = "box"; box = ((0, 0), (0.2, 0.2)); } );
probes: ( %s );
''' % probes('discharge', 'flow 0.4, 0 to 0.4, 0.3'))
cells = 'cells = (24, 18); j_min = "slip"; j_max = "slip";'
run_case('even', tank + '''fv: { cells = (48, 18); };
walls: ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );''', program='fv')
run_case('blocks', tank + '''fv: { };
blocks: ( { name = "a"; min = (0, 0); max = (0.4, 0.3); i_min = "slip"; i_max = "joined"; %s },
          { name = "b"; min = (0.4, 0); max = (0.8, 0.3); i_min = "joined"; i_max = "slip"; %s } );''' % (cells, cells), program='fv')
for case in 'even', 'blocks':
    volume(case, 'flow', 0.02, 0.03)

# Gauges that a body takes with it: over a box that goes up and down in water at rest (a period of 2 s, sph) the pressure
# follows the depth, rho g y, but for the water's inertia (w^2 A/g: 5 %), where a gauge that stands reads a tenth of it at
# most; before a cylinder that swings (fv) the water goes with its wall (0.96 of its speed there in potential flow).
lift = scene(2, '''fluid: { gravity = (0, -9.81); }; domain: { dim = 2; max = (0.8, 0.5); };
walls: ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } );
shapes: ( { form = "below"; level = 0.4; } );
bodies: ( { name = "box"; points = ((0.3, 0.16), (0.3, 0.24), (0.5, 0.24), (0.5, 0.16)); centre = (0.4, 0.2);
            motion = ( { kind = "harmonic"; axis = "y"; amplitude = 0.05; period = 2; ramp = 0.2; } ); } );
probes: ( { name = "with"; at = (0.6, 0.2); body = "box"; }, { name = "stands"; at = (0.6, 0.2); },
          { name = "level"; kind = "level"; at = (0.4, 0.24); body = "box"; } );
sph: { dx = 0.02; };
''', series=2)
swing = scene(2.5, '''fluid: { rho = 1.0; nu = 0.02; }; domain: { dim = 2; min = (-6, -5); max = (6, 5); };
initial: { field = "rest"; U = 1.0; };
walls: ( { side = "x_min"; }, { side = "x_max"; kind = "outflow"; }, { side = "y_min"; }, { side = "y_max"; } );
blocks: ( { name = "outer"; mapping = "stretched"; min = (-6, -5); max = (6, 5); cells = (60, 52); focus = (0, 0); stretch = (3.5, 3.5); },
          { name = "cylinder"; mapping = "annulus"; radius = (0.5, 1.75); stretch = (1.5, 0); cells = (20, 48);
            i_min = "wall"; j_min = "joined"; j_max = "joined";
            motion = ( { kind = "harmonic"; axis = "x"; amplitude = -0.7957747; period = 5.0; } ); } );
probes: ( { name = "with"; kind = "velocity"; at = (0.51, 0); body = "cylinder"; } ); fv: { };
''', series=2)
run_case('lift', lift)
run_case('swing', swing, program='fv')
t, box = column('lift/series.csv', 't '), column('lift/series.csv', 'box y')


def share(gauge):
    """What of the way of the box is in a gauge, Pa/m, least squares from 0.2 s on."""
    pairs = [(y, p) for now, y, p in zip(t, box, column('lift/series.csv', gauge)) if now >= 0.2]
    y0, p0 = (sum(values) / len(pairs) for values in zip(*pairs))
    return sum((y - y0) * (p - p0) for y, p in pairs) / sum((y - y0) ** 2 for y, _ in pairs)


near('Pa/m of its way in a gauge that a body takes with it', share('with'), -9810, 981, 'lift.txt')
near('Pa/m of a body\'s way in a gauge that stands', share('stands'), 0, 981)
ends_at('lift', 'level', 0.4, 0.02)
walls = [-math.cos(2 * math.pi * now / 5) for now in column('swing/series.csv', 't ')]
off = math.sqrt(sum((u - wall) ** 2 for u, wall in zip(column('swing/series.csv', 'with u'), walls)) / sum(wall ** 2 for wall in walls))
near('water before a cylinder, off by a share of its speed', off, 0, 0.15, 'swing.txt')
refused('sph', varied(lift, '0.2); body = "box"', '0.2); body = "bax"'), r"probes.\[0\].body: with: no body .bax' moves")
refused('fv', varied(swing, 'body = "cylinder"', 'body = "outer"'), r'probes.\[0\].body: is not used: no block of that name moves')
refused('sph', lift + 'gauges: ( { name = "g"; probes = "level level"; period = 1; } );', 'gauges that move with a body')
# of two half rings the one that has the motion takes the other along, and its gauges
half = '''period = 5.0; } ); }, { name = "half"; mapping = "annulus"; arc = (180, 360); radius = (0.5, 1.75); stretch = (1.5, 0);
            cells = (20, 24); i_min = "wall"; j_min = "joined"; j_max = "joined"; }'''
write('halves.cfg', varied(swing, 'mapping = "annulus";', 'mapping = "annulus"; arc = (0, 180);', '(20, 48)', '(20, 24)',
                           'period = 5.0; } ); }', half, 'at = (0.51, 0); body = "cylinder"', 'at = (0.02, -0.51); body = "half"'))
if start('fv', 'halves.cfg', '--check', log='halves.txt') != 0:
    bad('a gauge on a block that is joined to one that moves is refused', 'halves.txt')

# A level gauge that a tank has left behind reads nothing, one over dry ground the height of the ground, not of the domain's end
run_case('leaves', scene(0.15, '''fluid: { gravity = (0, -9.81); }; domain: { dim = 2; min = (-1, -0.3); max = (1.5, 1); };
shapes: ( { form = "box"; box = ((-0.5, 0.1), (0, 0.3)); } );
blocks: ( { name = "tank"; min = (-0.5, 0.1); max = (0.5, 0.7); cells = (20, 12);
            i_min = "slip"; i_max = "slip"; j_min = "slip"; j_max = "slip";
            motion = ( { kind = "polynomial"; axis = "x"; coefficients = (0, 0.5); until = 0.15; } ); } );
probes: ( %s ); fv: { };
''' % probes('level', 'left -0.45, 0', 'dry 0.4, 0')), program='fv')
near('m, a gauge over the dry floor at 0.1 m', column('leaves/series.csv', 'dry')[0], 0.1, 1e-4)
if not math.isnan(last('leaves/series.csv', 'left')):
    bad('a gauge that the tank has left reads %g' % last('leaves/series.csv', 'left'))

# Across periodic sides: vortices are the same on both sides of x = 0, so that no water crosses it; where the box of a coupled
# job reaches over that side, sph reads what lies in it, (cos 2kx + cos 2ky) rho U^2 F^2/4 + p0 of the vortices
seam = scene(0.1, '''fluid: { rho = 1.0; nu = 1.0e-2; }; domain: { dim = 2; min = (0, 0); max = (1.0, 1.0); periodic = (true, true); };
initial: { field = "taylor_green"; };
probes: ( { name = "near"; at = (0.05, 0.5); }, { name = "mid"; at = (0.9, 0.5); }, { name = "far"; at = (0.4, 0.5); }%s );
sph: { dx = 0.02;%s };
''')
run_case('seam', seam % (', { name = "v"; kind = "velocity"; at = (0.0, 0.25); }', ' noise = 0.0;'))
ends_at('seam', 'v u', 0, 1e-4)


def job(case, text):
    write(case + '.cfg', text)
    if run(lib.root + '/cases/run', case + '.cfg', '-n', '1:1:1', '-o', case, '--force', log=case + '.txt') != 0:
        bad(case + ' does not run', case + '.txt')


def read_by(case, program, gauge):
    return not math.isnan(last('%s/%s-series.csv' % (case, program), gauge))


job('over', seam % ('', ' free = ((0.75, 0.3), (1.2, 0.7));') + 'fv: { cells = (32, 32); };')
for gauge, wanted in ('near ', 0.386), ('mid ', 0.279):
    near('over: Pa at %s of a box over a periodic side' % gauge, last('over/sph-series.csv', gauge), wanted, 0.02)
if read_by('over', 'fv', 'near ') or read_by('over', 'sph', 'far '):
    bad('over: a gauge is read by the wrong program')
# Two boxes, each with a body that takes a gauge along: each program reads its own; waves are told apart from gauges of one part
square = '''{ name = "%s"; motion = ( { kind = "harmonic"; amplitude = 0.02; period = 1.0; } );
            points = ((%g, 0.9), (%g, 0.9), (%g, 1.1), (%g, 1.1)); }'''
job('boxes', scene(0.03, '''fluid: { rho = 1.0; nu = 1.0e-2; };
domain: { dim = 2; min = (0, 0); max = (4.0, 2.0); periodic = (true, true); };
initial: { field = "uniform"; U = 0.3; velocity = (0.2, 0.0); }; bodies: ( %s, %s );
probes: ( { name = "ga"; at = (1.0, 1.2); body = "a"; }, { name = "gb"; at = (3.0, 1.2); body = "b"; } );
sph_a: { dx = 0.04; free = ((0.6, 0.6), (1.4, 1.4)); }; sph_b: { dx = 0.04; free = ((2.6, 0.6), (3.4, 1.4)); }; fv: { cells = (64, 32); };
''' % (square % ('a', 0.9, 1.1, 1.1, 0.9), square % ('b', 2.9, 3.1, 3.1, 2.9))))
if not read_by('boxes', 'sph_a', 'ga ') or not read_by('boxes', 'sph_b', 'gb '):
    bad("boxes: a gauge on a body is not read by the body's program")
if read_by('boxes', 'sph_a', 'gb ') or read_by('boxes', 'sph_b', 'ga ') or read_by('boxes', 'fv', 'g'):
    bad('boxes: a gauge on a body is read twice')
parts = scene(4, '''fluid: { gravity = (0, -9.81); }; domain: { max = (8, 1.4); };
walls: ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } );
shapes: ( { form = "box"; box = ((0, 0), (8, 1)); } );
probes: ( %s );
gauges: ( { name = "g"; probes = "w1 w2"; period = 1.0; } );
sph: { dx = 0.1; box = ((2.5, 0), (6.5, 1.4)); }; fv: { cells = (50, 10); };
''' % probes('level', 'w1 5, 1', 'w2 5.5, 1', 'w3 7, 1'))
write('parts.cfg', parts)
for program in 'sph', 'fv':
    if start(program, 'parts.cfg', '--check', log='parts.txt') != 0:
        bad(program + ' refuses gauges in one part', 'parts.txt')
    refused(program, varied(parts, '"w1 w2"', '"w1 w3"'), 'w1 and w3 are read by different programs')
# a film of two rows that overtops a dyke: all of it through a section that stands on the crest, or begins in the dyke, or on
# the slope behind, where particles are nearer to the wall than half of their spacing
run_case('overtops', scene(0.6, '''fluid: { gravity = (0, -9.81); }; domain: { max = (1.2, 0.6); };
walls: ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } );
bodies: ( { points = ((0.3, 0), (0.4, 0.2), (0.6, 0.2), (0.8, 0)); } );
shapes: ( { box = ((0.4, 0.2), (0.5, 0.24)); velocity = (1, 0); } ); probes: ( %s ); sph: { dx = 0.02; };
''' % probes('discharge', 'crest 0.58, 0.2 to 0.58, 0.5', 'slope 0.7, 0.1 to 0.7, 0.4', 'deep 0.58, 0.1 to 0.58, 0.5')))
for gauge in 'crest', 'slope', 'deep':
    volume('overtops', gauge, 0.004, 0.03)
# in fv a film of 2.5 cells that breaks up as it falls off a box: what went over the crest comes down (0.46 of it by phi)
run_case('falls', scene(3, '''fluid: { gravity = (0, -9.81); }; domain: { max = (1.2, 0.6); };
walls: ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } ); bodies: ( { box = ((0.3, 0), (0.7, 0.2)); } );
shapes: ( { box = ((0.4, 0.2), (0.5, 0.25)); velocity = (1, 0); } ); probes: ( %s ); fv: { cells = (60, 30); };
''' % probes('discharge', 'crest 0.6, 0.2 to 0.6, 0.5', 'fall 0.7, 0.1 to 1.2, 0.1')), program='fv')
for gauge in 'crest', 'fall':
    volume('falls', gauge, 0.005, 0.1)

# Water at rest keeps its level in the mean of gauges away from walls, to a hundredth of dx, however its rows lie by then: the
# topmost holds less than a row's volume, those below it more (taken from the inside alone the level was 0.025 dx low).
for scheme in 'riemann', 'riemann_ale':
    run_case('rest', scene(1.5, '''fluid: { gravity = (0, -9.81); }; domain: { dim = 2; max = (0.6, 0.48); };
    walls: ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } ); shapes: ( { form = "below"; level = 0.32; } );
    probes: ( %s ); sph: { dx = 0.02; scheme = "%s"; };
    ''' % (probes('level', 'a 0.15, 0.1', 'b 0.25, 0.1', 'c 0.35, 0.1', 'd 0.45, 0.1'), scheme), series=5))
    near('rest: level, ' + scheme, sum(lib.mean('rest', gauge + ' [', 0.5) for gauge in 'abcd') / 4, 0.32, 0.01 * 0.02, 'rest.txt')

# Beside the edge of a ledge the column ends there: over the mean of both floors the level was 0.06 and 0.14 m low.
run_case('ledge', scene(0.01, '''fluid: { gravity = (0, -9.81); }; domain: { dim = 2; max = (1, 0.8); };
walls: ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } ); bodies: ( { name = "b"; box = ((0, 0), (0.5, 0.4)); } );
shapes: ( { box = ((0, 0.4), (0.5, 0.5)); } ); probes: ( %s ); sph: { dx = 0.02; };
''' % probes('level', 'a 0.25, 0.45', 'b 0.46, 0.45', 'c 0.48, 0.45', 'd 0.49, 0.45')))
for gauge in 'abcd':
    near('ledge: level at ' + gauge, column('ledge', gauge + ' [')[0], 0.5, 0.1 * 0.02, 'ledge.txt')

# The corner of a block in 3D: beside it and over it, before and beyond a period (0.558 and 0.526 m when 8 x 8 places told how much
# of the section it leaves)
for block, x, z in ((0.3, 0.1, 0.5, 0.3), 0.51, 0.31), ((0.6, 0.3, 0.8, 0.5), 0.01, 0.01):
    run_case('corner', scene(0.01, '''fluid: { gravity = (0, -9.81, 0); };
    domain: { dim = 3; max = (0.8, 0.8, 0.5); periodic = (true, false, true); }; walls: ( { side = "y_min"; } );
    bodies: ( { name = "b"; box = ((%g, 0, %g), (%g, 0.3, %g)); } ); shapes: ( { box = ((0, 0, 0), (0.8, 0.5, 0.5)); } );
    probes: ( %s ); sph: { dx = 0.05; };
    ''' % (*block, probes('level', 'beside %g, 0.1, %g' % (x, z), 'over %g, 0.4, %g' % (x, z)))))
    for gauge in 'beside', 'over':
        near('corner: level ' + gauge, column('corner', gauge)[0], 0.5, 0.2 * 0.05, 'corner.txt')

# Water on a deck does not count for the level below it where air is left between; it does where the deck is drowned (at
# first it always did: 0.26 m for 0.16 m). In fv, too, where what stands on the deck stood on the floor (0.36 and 0.36 m).
SOLVERS = ('sph', 'sph: { dx = %g; };'), ('fv', 'fv: { cells = (%d, %d); };')
for case, water, deck, wanted in ('decks', '{ box = ((0, 0), (1, 0.16)); }, { box = ((0, 0.4), (1, 0.5)); }', (0, 0.3, 1, 0.4), 0.16), \
        ('drowned', '{ box = ((0, 0), (1, 0.5)); }', (0.3, 0.2, 0.7, 0.3), 0.5):
    for program, group in SOLVERS:
        run_case(case, scene(0.01, '''fluid: { gravity = (0, -9.81); }; domain: { dim = 2; max = (1, 0.8); };
        walls: ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } ); bodies: ( { box = ((%g, %g), (%g, %g)); } );
        shapes: ( %s ); probes: ( %s ); %s
        ''' % (*deck, water, probes('level', 'below 0.5, 0.1', 'above 0.5, 0.45'), group % (0.02 if program == 'sph' else (50, 40)))), program=program)
        for gauge, level in ('below', wanted), ('above', 0.5):
            near('%s, %s: level %s the deck' % (case, program, gauge), column(case, gauge + ' [')[0], level, 0.1 * 0.02, case + '.txt')

# On blocks, too, over each other (0.5 m below the deck, with air there; on a bare deck 0.16 m).
TANK_OF_BLOCKS = '{ name = "%s"; min = (%g, %g); max = (%g, %g); cells = (%d, %d); i_min = "slip"; i_max = "slip"; j_min = "slip"; j_max = "slip"; }'
for case, water, wanted in ('decks', '{ box = ((0, 0), (1, 0.16)); }, { box = ((0, 0.4), (1, 0.5)); }', (0.16, 0.5)), \
        ('full', '{ box = ((0, 0), (1, 0.5)); }', (0.5, 0.5)), ('bare', '{ box = ((0, 0), (1, 0.16)); }', (0.16, 0.4)):
    run_case(case, scene(0.01, '''fluid: { gravity = (0, -9.81); }; domain: { dim = 2; max = (1, 0.8); };
    shapes: ( %s ); probes: ( %s ); fv: {}; blocks: ( %s, %s );
    ''' % (water, probes('level', 'below 0.5, 0.1', 'above 0.5, 0.45'), TANK_OF_BLOCKS % ('low', 0, 0, 1, 0.3, 50, 15), TANK_OF_BLOCKS % ('top', 0, 0.4, 1, 0.8, 50, 20))), program='fv')
    for gauge, level in zip(('below', 'above'), wanted):
        near('%s on blocks: level %s the deck' % (case, gauge), column(case, gauge + ' [')[0], level, 0.1 * 0.02, case + '.txt')

# Beside a hull that pierces the surface what of it lies above the water is none (all of it counted, up to its deck: 0.85 m for
# 0.7), below it the level is its underside; a place in a body that stands flush on the floor is taken for the one above it
# (the floor below it counted, 0.15 m for 0.3). The same where heights are below zero (-1.28 m for the underside at -1.5).
for (case, z), (program, group) in ((case, solver) for case in (('hull', 0), ('sunk', -2)) for solver in SOLVERS):
    run_case(case, scene(0.01, '''fluid: { gravity = (0, -9.81); }; domain: { dim = 2; min = (0, %g); max = (1.2, %g); };
walls: ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } ); shapes: ( { form = "below"; level = %g; } );
bodies: ( { name = "hull"; box = ((0.4, %g), (0.8, %g)); }, { name = "block"; box = ((0.9, %g), (1.1, %g)); } ); probes: ( %s ); %s
''' % (z, z + 1.1, z + 0.7, z + 0.5, z + 1, z, z + 0.4, probes('level', *('%s, %g' % (place, z + up) for place, up in (
        ('a 0.375', 0), ('b 0.39', 0), ('c 0.3999', 0), ('under 0.405', 0), ('in 1', 0.1), ('on 1', 0)))), group % (0.025 if program == 'sph' else (48, 44)))),
             program=program)
    for gauge, level, far in ('a', 0.7, 0.5), ('b', 0.7, 0.5), ('c', 0.7, 0.5), ('under', 0.5, 0.1), ('in', 0.7, 0.1), ('on', 0.7, 0.1):
        near('%s, %s: level at %s' % (case, program, gauge), column(case, gauge + ' [')[0], z + level, far * 0.025, case + '.txt')

# The level under a body is its underside, also while an edge of refinement goes down through the rows of the column: each
# of the two levels counts by its share there (by whole rows it was out by 0.4 dx, and a body was taken for drowned).
run_case('edge', scene(0.6, '''fluid: { gravity = (0, -9.81); }; domain: { dim = 2; max = (1.2, 1.2); };
walls: ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } ); shapes: ( { form = "below"; level = 0.8; } );
bodies: ( { name = "box"; box = ((0.45, 0.7), (0.75, 1)); velocity = (0, -0.1); } );
probes: ( %s ); sph: { dx = 0.04; R_dx = 3.0; };
apr: { regions = ( { shape = "body"; body = "box"; offset = 0.25; } ); };
''' % probes('level', 'under 0.6, 0.1'), series=5))
lines = list(zip(column('edge', 't ['), column('edge', 'under')))
check(len(lines) > 50, 'edge: %d lines of the series' % len(lines))
for now, level in lines:
    near('edge: level under the box at %g s' % now, level, 0.7 - 0.1 * now, 0.1 * 0.04, 'edge.txt')
# The level of inclined water is that at its end wall, be this a side or a line in its place: only where water is born or removed
# are levels read further inside (0.0118 m lower, 0.014 higher).
inclined = scene(0.001, '''fluid: { gravity = (0, -9.81); }; domain: { dim = 2; max = (1, 0.6); };
walls: ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } );
shapes: ( { form = "polygon"; points = ((0, 0), (1, 0), (1, 0.2), (0, 0.5)); } ); probes: ( %s ); sph: { dx = 0.02; };
''' % probes('level', 'left 0.01, 0', 'right 0.999, 0'))
run_case('sided', inclined)
run_case('lined', varied(inclined, '{ side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }',
                         '{ points = ((0, 0.6), (0, 0), (1, 0), (1, 0.6)); }'))
for gauge in 'left', 'right':
    near('level at a wall drawn as a line: ' + gauge, column('lined', gauge)[0], column('sided', gauge)[0], 0.25 * 0.02, 'lined.txt')
# the floor of water a few rows deep, whose rows are all near the surface (7 % low with 3 rows by their own gradients)
for rows in 2, 3, 4:
    run_case('rows_%d' % rows, scene(1, '''fluid: { gravity = (0, -9.81); }; domain: { dim = 2; max = (0.5, 0.2); };
walls: ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } ); shapes: ( { form = "box"; box = ((0, 0), (0.5, %g)); } );
probes: ( { name = "floor"; at = (0.25, 0); } ); sph: { dx = 0.02; };
''' % (0.02 * rows), series=5), program='sph')
    floor = mean('rows_%d/series.csv' % rows, 'floor', 0.5)
    near('Pa on the floor below %d rows' % rows, floor, 9810 * 0.02 * rows, 0.03 * 9810 * 0.02 * rows)
# two periods of a steady wave before the end are two, though its period, which is found, is not 2 to the last digit
waves = scene(12, '''fluid: { gravity = (0, -9.81); }; domain: { dim = 2; max = (14, 0.75); };
waves: { height = 0.03; period = 2.0; }; shapes: ( { form = "below"; level = 0.5; } );
walls: ( { side = "x_min"; kind = "wave"; }, { side = "x_max"; kind = "beach"; }, { side = "y_min"; }, { side = "y_max"; } );
probes: ( { name = "a"; kind = "level"; at = (6, 0.5); }, { name = "b"; kind = "level"; at = (6.5, 0.5); } );
gauges: ( { name = "tank"; probes = "a b"; from = 8; } ); fv: { cells = (140, 20); };
''')
write('waves.cfg', waves)
check(start('fv', 'waves.cfg', '--check') == 0, 'two periods before the end', 'out.txt')
refused('fv', varied(waves, 'from = 8', 'from = 8.001'), 'less than two periods')
# What waves throw over a dyke, by gauges of discharge on its crest and behind it, is the water that stands behind them by the
# shares of the cells at the end: all steps count, not those of the rows alone (2 and 15 % off, every third step read)
run_case('dyke', scene(10, '''fluid: { gravity = (0, -9.81); }; domain: { dim = 2; max = (8, 0.8); };
waves: { height = 0.14; length = 2.4; }; shapes: ( { box = ((0, 0), (6, 0.4)); } );
walls: ( { side = "x_min"; kind = "wave"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
bodies: ( { name = "dyke"; box = ((6, 0), (6.4, 0.48)); } ); fv: { cells = (100, 20); };
probes: ( { name = "crest"; kind = "discharge"; at = (6.2, 0.48); to = (6.2, 0.8); },
          { name = "behind"; kind = "discharge"; at = (6.44, 0); to = (6.44, 0.8); } );
'''), '-p', 'output.checkpoint=10', program='fv')
wide = 106  # cells of a row with their ghosts
shares = lib.dataset(glob.glob('dyke/fv-checkpoint-*.h5')[0], 'C')
columns = [sum(shares[row * wide + 3 + i] for row in range(3, 23)) * 0.08 * 0.04 for i in range(100)]
for gauge, at in ('crest', 6.2), ('behind', 6.44):
    cell = int(at / 0.08)
    stands = sum(columns[cell + 1:]) + columns[cell] * (cell + 1 - at / 0.08)
    volume('dyke', gauge, stands, 0.001)
lib.end('a body takes a gauge along: %.6g Pa/m (-9810), one that stands %.4g; before a wall off by %.3g; %d faults'
        % (share('with'), share('stands'), off, lib.failed))
