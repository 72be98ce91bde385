"""Coupled jobs whose box reaches from wall to wall: the part of fv's flow that it cuts off has no outlet, takes the level of its
pressure from sph, and gives what flows in. SPDX-License-Identifier: BSD-3-Clause"""
import re

import lib
from lib import bad, below, close, column, job, last, refused, refused_by, told, varied

lib.scratch()
channel = '''format = 1;
time:    { end = 6.0; };
fluid:   { rho = 1.0; nu = 1.0e-2; };
domain:  { dim = 2; min = (0, 0); max = (3.0, 0.4); };
initial: { field = "uniform"; U = 0.3; velocity = (0.2, 0.0); };
walls:   ( { side = "x_min"; kind = "inflow"; velocity = (0.3, 0); profile = "parabolic"; }, { side = "x_max"; kind = "outflow"; },
           { side = "y_min"; kind = "no_slip"; }, { side = "y_max"; kind = "no_slip"; } );
sph:     { dx = 0.02; box = ((0.8, 0), (2.1, 0.4)); };
fv:      { cells = (96, 12); };
output:  { every = 0.6; snapshots = false; series = 10; };
'''
probes = '''probes:  ( { name = "in"; at = (0.4, 0.2); }, { name = "a"; at = (1.3, 0.2); }, { name = "b"; at = (1.6, 0.2); },
           { name = "out"; at = (2.5, 0.2); }, { name = "v"; kind = "velocity"; at = (1.45, 0.2); },
           { name = "w"; kind = "velocity"; at = (2.5, 0.2); } );
'''
# each gauge stands in the series of the program in whose part it lies
read_by = {'sph': ('a ', 'b ', 'v u'), 'fv': ('in ', 'out ', 'w u')}
job('two_ranks', channel + probes, ranks='1:2:1')
of = {}
for program, titles in read_by.items():
    series = 'two_ranks/%s-series.csv' % program
    of.update((title, last(series, title)) for title in titles)
    for title in (title for other in read_by if other != program for title in read_by[other] if column(series, title)):
        bad('gauge "%s" is read by both programs' % title)
# Poiseuille's flow: 8 nu rho u/H^2 = 0.15 Pa/m in sph, over fv's parts and sph between them, and the same discharge in both
close('Pa that sph loses over 0.3 m', of['a '] - of['b '], 0.045, 0.03)
close('Pa from inlet to outlet', of['in '] - of['out '], 0.315, 0.1)
close("m/s on the axis of sph's part", of['v u'], 0.3, 0.02)
close("m/s on the axis of fv's part", of['w u'], 0.3, 0.02)
# one rank of the coupler gives the same, in the last row that both jobs have
job('one_rank', channel + probes, 'time.end=0.6')
for program, titles in read_by.items():
    for title in titles:
        one, two = (dict(zip(column(path, 't'), column(path, title))) for path in
                    ('%s/%s-series.csv' % (folder, program) for folder in ('one_rank', 'two_ranks')))
        t = max(set(one) & set(two))
        if not (t > 0.3 and abs(one[t] - two[t]) <= 1e-9):
            bad('gauge "%s" at %g s: %.10g on one rank of the coupler, %.10g on two' % (title, t, one[t], two[t]))

# a stream past a square: the loop's gain of 0.29 is smoothed (raw, the pressures parted by e in 0.12 s and the job ended)
job('square', '''format = 1;
time:    { end = 1.0; };
fluid:   { rho = 1.0; nu = 0.02; };
domain:  { dim = 2; min = (0, 0); max = (4, 1); };
initial: { field = "uniform"; velocity = (1, 0); };
walls:   ( { side = "x_min"; kind = "inflow"; velocity = (1, 0); }, { side = "x_max"; kind = "outflow"; },
           { side = "y_min"; }, { side = "y_max"; } );
bodies:  ( { name = "square"; points = ((1.4, 0.4), (1.6, 0.4), (1.6, 0.6), (1.4, 0.6)); kind = "no_slip"; } );
sph:     { dx = 0.02; box = ((0.8, 0), (2.4, 1)); };
fv:      { cells = (64, 16); };
output:  { snapshots = false; };
''')
below('square: pressures of the programs apart, in rho U^2', last('square/sph-series.csv', 'overlap pressure [-]'), 0.1)

# what has no balance of its own is refused
blocks = varied(channel, 'fv:      { cells = (96, 12); };', 'fv: {}; blocks: ( { cells = (96, 12); max = (3, 0.4); } );')
outlet = 'kind = "inflow"; velocity = .*"parabolic"', 'kind = "outflow"; pressure = 0.45', 'nothing would say how much flows through it'
refused('sph', blocks, 'take fv.cells, which need none')
refused_by('sph', channel, *outlet)
refused_by('sph', blocks, *outlet)
two_boxes = 'sph_a: { dx = 0.0125; box = ((0.5, 0), (1.2, 0.4)); };\nsph_b: { dx = 0.0125; box = ((1.8, 0), (2.5, 0.4)); };'
job('boxes', re.sub('sph: .*', two_boxes, channel), ends=(2,), boxes=('sph_a', 'sph_b'))
told('boxes', 'what lies between several boxes')
lib.end('%.3g, %.3g Pa; %.4g, %.4g m/s; %d faults' % (of['a '] - of['b '], of['in '] - of['out '], of['v u'], of['w u'], lib.failed))
