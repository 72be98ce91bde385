"""A channel whose slope is given by gravity that leans: normal depth and backwater curve with bed friction, in fv on cells and on
blocks, in sph, coupled; level gauges in a tank that leans.
SPDX-License-Identifier: BSD-3-Clause"""
import math

import lib
from lib import close, last, mean, refused, run_case, varied

lib.scratch()
q, slope, rough, nu, g = 0.14, 0.005, 0.02, 0.01, 9.81
channel = '''format = 1;
time: { end = 8.0; };
fluid: { rho = 1000.0; nu = 0.01; gravity = (0.04905, -9.80988); };
domain: { max = (2, 0.32); };
initial: { field = "uniform"; velocity = (0.7, 0); };
walls: ( { side = "x_min"; kind = "inflow"; discharge = 0.14; }, { side = "x_max"; kind = "outflow"; level = 0.2; },
         { side = "y_min"; friction = 0.02; } );
shapes: ( { form = "below"; level = 0.2; } );
probes: ( { name = "H"; kind = "level"; at = (0.8, 0); } );
output: { snapshots = false; };
fv: { cells = (50, 16); };
'''


def depth(x, end, at):
    """By dh/dx = (S - S_f)/(1 - Fr^2) upstream from depth `end' at x = `at', steps of 1 mm: S_f = c_f u^2/(g h), u on the bed,
    below the mean by c_f u^2 h/(3 nu), what friction makes of the profile."""
    h, dx = end, 1e-3
    for _ in range(round((at - x) / dx)):
        a = rough * h / (3 * nu)
        u = (math.sqrt(1 + 4 * a * q / h) - 1) / (2 * a)
        h -= dx * (slope - rough * u * u / (g * h)) / (1 - q * q / (g * h ** 3))
    return h


wanted = depth(0.8, 0.2, 2)
run_case('cells', channel, program='fv')
levels = [mean('cells', 'H', 6)]
close('fv: level in a channel that leans, m', levels[0], wanted, 0.005)
close('its volume, m^2', last('cells', 'volume'), 2 * depth(1, 0.2, 2), 0.005)
run_case('blocks', varied(channel, 'fv: { cells = (50, 16); };', 'fv: { }; blocks: ( { max = (2, 0.32); cells = (50, 16); j_max = "slip"; } );'),
         program='fv')
close('the same on a block', mean('blocks', 'H', 6), levels[0], 0.001)
run_case('particles', varied(channel, 'fv: { cells = (50, 16); };', 'sph: { dx = 0.02; };', 'end = 8', 'end = 4'))
levels.append(mean('particles', 'H', 2))
close('sph: level in a channel that leans, ten rows, m', levels[1], wanted, 0.02)
if lib.long:
    lib.job('coupled', varied(channel, 'fv: {', 'sph: { dx = 0.02; box = ((0.5, 0), (1.5, 0.32)); }; fv: {'))
    levels.append(lib.column('coupled/sph-series.csv', 'H')[-1])
    close('coupled: level in a channel that leans, m', levels[2], wanted, 0.01)
# with a wall at its end it is a tank that leans
refused('fv', varied(channel, 'side = "x_min"; kind = "inflow"; discharge = 0.14', 'side = "x_min"'), r'walls.\[1\]: .*would fall out')
refused('sph', varied(channel, 'fv: { cells = (50, 16); };', 'sph: { dx = 0.02; };', 'side = "x_max"; kind = "outflow"; level = 0.2', 'side = "x_max"'),
        r'walls.\[0\].kind: the water of a tank that leans')
tank = '''format = 1;
time: { end = 0.5; };
fluid: { gravity = (2.4, -9.5); };
domain: { max = (1.0, 0.8); };
walls: ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } );
shapes: ( { form = "below"; level = 0.25; } );
probes: ( { name = "H"; kind = "level"; at = (0.3, 0); } );
output: { snapshots = false; };
'''
for program, own in ('fv', 'fv: { cells = (25, 20); };'), ('sph', 'sph: { dx = 0.04; };'):
    run_case('tank_' + program, tank + own, program=program)
    close(program + ': level in a tank that leans, m', last('tank_' + program, 'H'), (0.25 * math.hypot(2.4, 9.5) + 2.4 * 0.3) / 9.5, 0.01)
lib.end('levels %s for %.4f m' % (', '.join('%.4f' % level for level in levels), wanted))
