#!/usr/bin/python3
"""A channel of given discharge and level over a sill, sph in the middle of fv: gauges of the discharge in both programs, each of which
reads the section that lies in its part, tell what was given. usage: tests/jobs/coupled_channel.py [BUILD]
SPDX-License-Identifier: BSD-3-Clause"""
import lib
from lib import bad, job, mean, refused, varied

lib.scratch()
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

# Sections that no program has
refused('sph', varied(channel, 'at = (1.4, 0); to = (1.4, 0.6)', 'at = (0.8, 0.2); to = (1.4, 0.2)'),
        'mid: .* end its section at the box of the particles, .1, 0. to .2.6, 0.6. m')
for program in 'sph', 'fv':
    refused(program, varied(channel, 'R_dx = 3; box', 'R_dx = 3; box_velocity = (0.1, 0); box'), 'mid: .* the box of the particles moves')


def later(program, title):
    """Mean of a column from 2 s on, which a long wave takes through the channel."""
    return mean('channel/%s-series.csv' % program, title, 2)


# Discharges and level within 2 %
if job('channel', channel) == 0:
    means = [later(program, gauge + ' [') for program, gauge in (('fv', 'up'), ('sph', 'mid'), ('fv', 'down'))]
    print('discharges %.4f, %.4f, %.4f of 0.12 m^2/s, level %.4f of 0.4 m' % (*means, later('fv', 'level')))
    if any(abs(q / 0.12 - 1) > 0.02 for q in means) or abs(later('fv', 'level') / 0.4 - 1) > 0.02:
        bad('discharges or level are not as given')
lib.end('%d faults' % lib.failed)
