"""Inlets and outlets of sph under a free surface against the laws of shallow water: a level channel stays level, what is asked for
comes in and goes out, a bore has the height of its jump relations, water at rest between two levels rests.
SPDX-License-Identifier: BSD-3-Clause"""
import lib
from lib import alone, bad, close, column, number, near, refused, says, start, told

lib.scratch()


def mean(folder, title, begin, end):
    """Of a column over that time."""
    path = folder + '/series.csv'
    values = [value for t, value in zip(column(path, 't'), column(path, title)) if begin <= t <= end]
    return sum(values) / len(values)


def level(folder, wanted, begin, end):
    for gauge in 'up', 'middle', 'down':
        close('%s: level %s' % (folder, gauge), mean(folder, gauge, begin, end), wanted, 0.01, folder + '.txt')


# 1 m long; Froude number 0.25, seven transits of a wave; the level does not end on a lattice row in the second
for folder, end, velocity, height, inflow, outflow in (
        ('level', 5, 0.35, 0.2, 'discharge = 0.07', 'level = 0.2;'),
        ('shifted', 5, 0.35, 0.207, 'discharge = 0.07245', 'level = 0.207;'),
        ('shallow', 5, 0.3, 0.16, 'discharge = 0.048', 'level = 0.16;'),
        ('still', 4, 0, 0.2, 'level = 0.2', 'level = 0.2;'),
        ('bore', 0.8, 0, 0.2, 'velocity = (0.35, 0)', '')):
    if folder == 'level' and not lib.long:
        continue
    alone('sph', folder, '''format = 1;
time:    { end = %g; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; max = (1, 0.4); };
initial: { field = "uniform"; velocity = (%g, 0); };
walls:   ( { side = "x_min"; kind = "inflow"; %s; }, { side = "x_max"; kind = "outflow"; %s }, { side = "y_min"; } );
shapes:  ( { form = "below"; level = %g; } );
probes:  ( { name = "up"; kind = "level"; at = (0.25, 0.1); }, { name = "middle"; kind = "level"; at = (0.5, 0.1); },
           { name = "down"; kind = "level"; at = (0.75, 0.1); }, { name = "flow"; kind = "discharge"; at = (0.5, 0); to = (0.5, 0.4); },
           { name = "slant"; kind = "discharge"; at = (0.375, -0.05); to = (0.6, 0.4); } );
sph:     { dx = 0.02; c0 = 20.0; };
output:  { snapshots = false; };
''' % (end, velocity, inflow, outflow, height))
    if says('^warning(?!.*sph.c0)', folder + '.txt'):
        bad(folder + ': warns', folder + '.txt')
if lib.long:
    level('level', 0.2, 3, 5)
level('shifted', 0.207, 3, 5)
level('still', 0.2, 3, 4)
# eight rows, what is in them: 160 kg and g h^2/(2 c0^2) for the weight of the water (-1.7 % where the pressure outside was
# hydrostatic up to the surface, which particles exceed there)
close('shallow: kg', mean('shallow', 'mass [', 3, 5), 160.31, 0.01, 'shallow.txt')
close('shifted: kg that came in', number('shifted', 'through.x_min'), 362.25, 0.02)
close('shifted: kg through the outlet', number('shifted', 'through.x_max'), -362.25, 0.02)
for gauge in 'flow', 'slant':  # the same through any section, upright or not
    close('shifted: m^2/s at ' + gauge, mean('shifted', gauge, 3, 5), 0.07245, 0.02)
near('shifted: mass lost or made', number('shifted', 'budget'), 0, 0.02)
near('water at rest: kg that come in', number('still', 'x_min'), 0, 1)
# jump relations: u = (h2 - h1) sqrt(g (h1 + h2)/(2 h1 h2)) = 0.35 m/s
close('bore: level', mean('bore', 'up', 0.35, 0.8), 0.2528, 0.02)
start('sph', 'still.cfg', '--check', log='check.txt')
told('check', 'x_max: water 0.2 m high outside')

# Froude number 2.5: nothing runs up against it, so its level is that of the start (1.1 % low and falling where it followed the
# level inside)
alone('sph', 'torrent', '''format = 1;
time:    { end = 1.6; };
fluid:   { gravity = (0, -9.81); };
domain:  { max = (1.2, 0.2); };
initial: { field = "uniform"; velocity = (2.5, 0); };
walls:   ( { side = "x_min"; kind = "inflow"; discharge = 0.25; }, { side = "x_max"; kind = "outflow"; level = 0.1; }, { side = "y_min"; } );
shapes:  ( { form = "below"; level = 0.1; } );
probes:  ( { name = "middle"; kind = "level"; at = (0.6, 0); } );
sph:     { dx = 0.0125; };
output:  { snapshots = false; };
''')
told('torrent', 'x_min: 2.5 m/s, faster than its waves')
close('torrent: level', mean('torrent', 'middle', 1, 1.6), 0.1, 0.004)

# over a sill of three rows behind it the level falls by no more than the velocity head over it, all of which may be lost:
# what walls take by sound (twice that where corners felt it whole) stays small at 115 times the stream, too
alone('sph', 'sill', '''format = 1;
time:    { end = 2; };
fluid:   { gravity = (0, -9.81); };
domain:  { max = (0.8, 0.4); };
initial: { field = "uniform"; velocity = (0.35, 0); };
walls:   ( { side = "x_min"; kind = "inflow"; discharge = 0.07; }, { side = "x_max"; kind = "outflow"; level = 0.2; }, { side = "y_min"; },
           { points = ((0.49, 0), (0.43, 0.06), (0.37, 0.06), (0.31, 0)); } );
shapes:  ( { form = "below"; level = 0.2; } );
probes:  ( { name = "before"; kind = "level"; at = (0.25, 0); }, { name = "behind"; kind = "level"; at = (0.55, 0); } );
sph:     { dx = 0.02; c0 = 40; };
output:  { snapshots = false; };
''')
lost = mean('sill', 'before', 1, 2) - mean('sill', 'behind', 1, 2)
if not 0 < lost < (0.07 / 0.14)**2 / (2 * 9.81):
    bad('a sill takes %.4f m of the level' % lost, 'sill.txt')

# an inlet that a block cuts in two: a parabola in each opening, of two thirds of its largest velocity
alone('sph', 'two', '''format = 1;
time:    { end = 3; };
fluid:   { nu = 0.002; };
domain:  { max = (1.2, 1); };
walls:   ( { side = "x_min"; kind = "inflow"; velocity = (0.4, 0); profile = "parabolic"; }, { side = "x_max"; kind = "outflow"; },
           { side = "y_min"; kind = "no_slip"; }, { side = "y_max"; kind = "no_slip"; },
           { kind = "no_slip"; points = ((0, 0.6), (1.2, 0.6), (1.2, 0.4), (0, 0.4)); } );
probes:  ( { name = "low"; kind = "discharge"; at = (0.6, 0); to = (0.6, 0.4); },
           { name = "high"; kind = "discharge"; at = (0.6, 0.6); to = (0.6, 1); } );
sph:     { dx = 0.025; };
output:  { snapshots = false; };
''')
for gauge in 'low', 'high':  # m^2/s, within what gauges of discharge err by; what the sudden start held back comes until 2 s
    close('two inlets: m^2/s at ' + gauge, mean('two', gauge, 2, 3), 0.10667, 0.03)
# in 3D a parabola spans the whole side, and is refused where a mesh cuts that
lib.box_stl('wall.stl', (-0.2, 0.4, -0.2), (1.4, 0.6, 1.2))
parabola = '''format = 1;
time:    { end = 0.1; };
fluid:   { nu = 0.002; };
domain:  { dim = 3; max = (1.2, 1, 1); };
walls:   ( { side = "x_min"; kind = "inflow"; velocity = (0.4, 0, 0); profile = "parabolic"; }, { side = "x_max"; kind = "outflow"; },
           { side = "y_min"; }, { side = "y_max"; }, { side = "z_min"; }, { side = "z_max"; }, { mesh = "wall.stl"; } );
sph:     { dx = 0.05; };
'''
refused('sph', parabola, r'walls.\[0\].profile: parabolic in 3D spans the whole side')
lib.write('uniform.cfg', lib.varied(parabola, 'profile = "parabolic";', ''))
if start('sph', 'uniform.cfg', '--check', log='uniform.txt') != 0:
    bad('a uniform inlet that a mesh cuts is refused', 'uniform.txt')

# A duct that narrows: the flow starts with sound, which needs some transits to leave by the inflow; an outflow that absorbs lets it out at once.
duct = '''format = 1;
time:    { end = 2.0; };
domain:  { max = (4, 1); };
initial: { field = "uniform"; velocity = (0.5, 0); };
walls:   ( { side = "x_min"; kind = "inflow"; velocity = (0.5, 0); }, { side = "x_max"; kind = "outflow"; }, { side = "y_max"; },
           { points = ((0, 0), (2, 0), (2.5, 0.4), (4, 0.4)); } );
sph:     { dx = 0.1; };
output:  { snapshots = false; };
'''
for folder, text in (('rings', duct), ('fades', lib.varied(duct, '"outflow"', '"absorbing"; velocity = (0.83, 0)'))):
    alone('sph', folder, text)
    if says('sound still runs to and fro', folder + '.txt') != (folder == 'rings'):
        bad(folder + ': sound between inflow and outflow is not told', folder + '.txt')
lib.end('%d faults' % lib.failed)
