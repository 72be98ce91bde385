"""Levels and discharges of openings over time (walls.level_file, walls.discharge_file) in both programs against the law of volume:
a closed tank takes what a hydrograph lets in, and stands as high as the tide outside. SPDX-License-Identifier: BSD-3-Clause"""
import cmath
import math

import lib
from lib import alone, close, column, near, number, refused, refused_by, start, told, write

lib.scratch()
PERIOD = 8  # s, of the tide
DX = 0.025  # m, of particles; the amplitude of a tide wants finer ones
write('tide.csv', '0 0.2\n0.5 0.2\n5.375 0.245\n9 0.245\n')
write('hydrograph.csv', '# t q\n0, 0\n0.5, 0.02\n3, 0.02\n3.5, 0\n')
write('swing.csv', ''.join('%g %.9g\n' % (0.2 * k, 0.2 + 0.02 * math.sin(2 * math.pi * 0.2 * k / PERIOD)) for k in range(81)))
write('flood.csv', '0 0.2\n1 9\n')
write('negative.csv', '0 0.02\n1 -0.02\n')
solvers = {'sph': 'sph: { dx = %g; c0 = 20.0; };', 'fv': 'fv: { cells = (40, 32); surface = "yes"; };'}
level, discharge = 'kind = "outflow"; level_file = "%s"', 'kind = "inflow"; discharge_file = "%s"'


def tank(program, end, opening, dx=DX):
    """Water 0.2 m deep, 1 m long, open at x_min, in particles of dx m."""
    return '''format = 1;
time:    { end = %g; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; max = (1, 0.4); };
initial: { field = "uniform"; velocity = (0, 0); };
walls:   ( { side = "x_min"; %s; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
shapes:  ( { form = "below"; level = 0.2; } );
probes:  ( { name = "up"; kind = "level"; at = (0.25, 0.1); }, { name = "down"; kind = "level"; at = (0.75, 0.1); } );
%s
output:  { snapshots = false; series = 1; };
''' % (end, opening, solvers[program].replace('%g', '%g' % dx))


def levels(folder, gauge, begin, end=math.inf):
    path = folder + '/series.csv'
    return [z for t, z in zip(column(path, 't'), column(path, gauge + ' ')) if begin <= t <= end]


def mean_level(folder, begin, end, wanted, share):
    both = levels(folder, 'up', begin, end) + levels(folder, 'down', begin, end)
    close('%s: level from %g to %g s' % (folder, begin, end), sum(both) / len(both), wanted, share)


for program in 'sph', 'fv':
    river, sea = 'river_' + program, 'sea_' + program
    alone(program, river, tank(program, 5, discharge % 'hydrograph.csv'))
    alone(program, sea, tank(program, 9, level % 'tide.csv'))
    mean_level(river, 4, 5, 0.26, 0.01)  # 0.02 m^2/s for 3 s less the ramps are 0.06 m^2, and none comes in afterwards
    mean_level(sea, 3.5, 4, 0.23, 0.02)  # the tide rises by 1 cm in a second, a wave crosses the tank in 0.7 s
    mean_level(sea, 8, 9, 0.245, 0.01)
    start(program, sea + '.cfg', '--check')
    told(sea, 'by tide.csv', 'out.txt')
    refused_by(program, tank(program, 5, level % 'tide.csv'), 'tide.csv', 'none.csv', 'none.csv: no such file')
    refused_by(program, tank(program, 5, level % 'tide.csv'), 'level_file', r'level = 0.2; \g<0>', 'give one of the two')
    refused(program, tank(program, 5, level % 'flood.csv'), 'level_file: 9 m is above the domain')
refused('fv', tank('fv', 5, discharge % 'negative.csv'), 'it is positive')
# 0.06 m^2 out of the tank; what is in it follows from what has passed, whatever walls and zones do with particles
alone('sph', 'drain', tank('sph', 5, 'kind = "outflow"; discharge_file = "hydrograph.csv"'))
for folder, passed in ('river_sph', 60), ('drain', -60):
    through, water = column(folder + '/series.csv', 'through x_min'), column(folder + '/series.csv', 'mass [')
    close('%s: kg that passed' % folder, through[-1], passed, 0.01)
    near('%s: kg that the tank differs by, of a layer of particles' % folder, (water[-1] - water[0] - passed) / (DX * 1000 * 0.26), 0, 1.1)
    near('%s: mass lost or made, with what faces hold' % folder, number(folder, 'budget'), 0, 0.01 * 60 / 260)
# a tide of eleven transits: in a basin closed at its other end the level swings by cos(k x)/cos(k L) of it, x from that
# end, k = w/c of long waves
k = 2 * math.pi / PERIOD / math.sqrt(9.81 * 0.2)
for program in ('fv', 'sph') if lib.long else ('fv',):
    path = 'swing_%s/series.csv' % program
    alone(program, 'swing_' + program, tank(program, 1.5 * PERIOD, level % 'swing.csv', 0.02))
    waves = [z * cmath.exp(2j * math.pi * t / PERIOD) for t, z in zip(column(path, 't'), column(path, 'down ')) if t >= PERIOD / 2]
    close(program + ': amplitude of the level at the closed end', 2 * abs(sum(waves)) / len(waves), 0.02 * math.cos(0.25 * k) / math.cos(k), 0.05)
lib.end('%d faults' % lib.failed)
