"""Beaches (walls.beach) in both programs: standing waves in a long tank run into one and do not come back; without it they stand and
nothing grows. Momentum balances with what a beach takes. SPDX-License-Identifier: BSD-3-Clause"""
import lib
from lib import alone, bad, below, column, number, near, refused_by, start, told, varied

lib.scratch()
# waves of 1 m over 0.25 m of water, period 0.836 s, 0.01 m
tank = '''format = 1;
time:    { end = 16; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; max = (4, 0.4); };
initial: { field = "standing_wave"; U = 0.1; L = 1.0; amplitude = 0.01; level = 0.25; };
walls:   ( { side = "x_min"; }, { side = "x_max"; beach = 1.5; beach_period = 0.836; }, { side = "y_min"; }, { side = "y_max"; } );
probes:  ( { name = "wall"; kind = "level"; at = (0.02, 0.2); } );
fv:      { cells = (128, 16); };
output:  { snapshots = false; };
'''
beach = ' beach = 1.5; beach_period = 0.836;'
short = varied(tank, '(4, 0.4)', '(2.5, 0.4)', '(128, 16)', '(80, 16)')
grains = varied(short, 'end = 16', 'end = 7', 'fv:      { cells = (80, 16); };', 'sph:     { dx = 0.025; scheme = "riemann_ale"; };')
alone('fv', 'beach', tank)
alone('fv', 'wall', varied(tank, beach, ''))
alone('fv', 'slow', varied(short, 'end = 16', 'end = 10', 'gravity', 'nu = 1e-6; gravity', '(80, 16);', '(80, 16); integrator = "bdf2";'))
alone('sph', 'grains', grains)
start('fv', 'beach.cfg', '--check', log='check.txt')
told('check', r'x_max: beach over 1.5 m, 1.5 lengths of waves of 0.836 s \(1 m\): 0.068 % of their height comes back')


def swing(folder, begin, end):
    """Half of the difference of the largest and the least level, m."""
    path = folder + '/series.csv'
    levels = [z for t, z in zip(column(path, 't'), column(path, 'wall ')) if begin <= t <= end]
    return (max(levels) - min(levels)) / 2


first = swing('beach', 0, 2)
if not first > 0.008:
    bad('waves of 0.01 m swing by %g m at first' % first)
near('of its height a wave between walls has later', swing('wall', 12, 16) / first, 0.95, 0.1)
for folder, begin, end, most in ('beach', 10, 16, 0.03), ('slow', 8, 10, 0.05), ('grains', 5, 7, 0.1):
    left = swing(folder, begin, end) / first
    below(folder + ': of its height a wave before a beach has later', left, most)
    if not left > 0:
        bad(folder + ': no wave at all')
    print('%s: %.3g of %.3g m is left' % (folder, left, first))
below('sph: momentum off by', number('grains', 'defect'), 1e-10)
for program, case, old, new, words in (
        ('sph', grains, 'beach_period = 0.836;', '', r'walls.\[1\].beach: a beach needs its length and the period'),
        ('fv', short, 'beach = 1.5', 'beach = 3', r'walls.\[1\].beach: 3 m: the domain is 2.5 m long there'),
        ('sph', grains, '"y_min"; }', '"y_min"; beach = 0.1; beach_period = 1; }', 'a zone is before an upright side'),
        ('fv', short, 'beach = 1.5', 'kind = "outflow"; beach = 1.5', 'an opening lets waves out by itself')):
    refused_by(program, case, old, new, words)
lib.end('%d faults' % lib.failed)
