#!/usr/bin/python3
"""A channel of given discharge and level over a sill, sph in the middle of fv: gauges of the discharge in both programs, each of which
reads the section that lies in its part, tell what was given. usage: tests/jobs/coupled_channel.py [BUILD]
SPDX-License-Identifier: BSD-3-Clause"""
import os

import lib
from lib import bad, run, says, write

lib.scratch()
cases = os.path.join(lib.root, 'cases', 'run')
channel = '''format = 1;
time:    { end = 5.0; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; max = (3.6, 0.6); };
initial: { field = "uniform"; velocity = (0.3, 0); };
walls:   ( { side = "x_min"; kind = "inflow"; discharge = 0.12; }, { side = "x_max"; kind = "outflow"; level = 0.4; },
           { side = "y_min"; }, { side = "y_max"; } );
shapes:  ( { form = "below"; level = 0.4; } );
bodies:  ( { name = "sill"; box = ((1.7, 0), (1.9, 0.04)); } );
probes:  ( { name = "up"; kind = "discharge"; at = (0.5, 0); to = (0.5, 0.6); },
           { name = "mid"; kind = "discharge"; at = (1.4, 0); to = (1.4, 0.6); },
           { name = "down"; kind = "discharge"; at = (3, 0); to = (3, 0.6); }, { name = "level"; kind = "level"; at = (0.5, 0); } );
sph:     { dx = 0.04; R_dx = 3; box = ((1, 0), (2.6, 0.6)); };
fv:      { cells = (36, 10); };
output:  { every = 5.0; series = 5; };
'''
write('channel.cfg', channel)
write('across.cfg', channel.replace('at = (1.4, 0); to = (1.4, 0.6)', 'at = (0.8, 0.2); to = (1.4, 0.2)'))
write('away.cfg', channel.replace('R_dx = 3; box', 'R_dx = 3; box_velocity = (0.1, 0); box'))

# Sections that no program has
for name, words in (('across', 'mid: .* end its section at the box of the particles, .1, 0. to .2.6, 0.6. m'),
                    ('away', 'mid: .* the box of the particles moves')):
    if run(cases, name + '.cfg', '--check', log=name + '.txt') != 2 or not says(words, name + '.txt'):
        bad('%s.cfg is not refused with "%s"' % (name, words), name + '.txt')


def later(program, title):
    """Mean of a column from 2 s on, which a long wave takes through the channel."""
    table = lib.series('out/channel/%s-series.csv' % program)
    values = [v for t, v in zip(table['t [s]'], table[title]) if t > 2]
    return sum(values) / len(values)


# Discharges and level within 2 %
if run(cases, 'channel.cfg', log='channel.txt') != 0:
    bad('the channel', 'channel.txt')
else:
    means = [later(program, gauge + ' [m^2/s]') for program, gauge in (('fv', 'up'), ('sph', 'mid'), ('fv', 'down'))]
    print('discharges %.4f, %.4f, %.4f of 0.12 m^2/s, level %.4f of 0.4 m' % (*means, later('fv', 'level [m]')))
    if any(abs(q / 0.12 - 1) > 0.02 for q in means) or abs(later('fv', 'level [m]') / 0.4 - 1) > 0.02:
        bad('discharges or level are not as given')
lib.end('%d faults' % lib.failed)
