"""Waves that evolve nonlinearly, in both programs: a group focuses where and when it should, over a restart and on two ranks to the
same bits; --check tells line, method and cost; what cannot be is refused. SPDX-License-Identifier: BSD-3-Clause"""
import lib
from lib import alone, bad, build, close, column, last, mpi, near, refused_by, run, start, told, varied, write

lib.scratch()
# 0.16 m deep, the group's peak 1 m long (kh 1)
hos = '''format = 1;
time:    { end = 4.0; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; max = (4.5, 0.24); };
shapes:  ( { form = "below"; level = 0.16; } );
walls:   ( { side = "x_min"; kind = "wave"; }, { side = "x_max"; kind = "beach"; }, { side = "y_min"; }, { side = "y_max"; } );
waves:   { kind = "focused"; height = 0.02; at = (2.0, 3.2); repeat = 8.0; evolve = "hos"; length = 1.0; zone = 1.2; start = 0; };
probes:  ( { name = "a"; kind = "level"; at = (2.0, 0.17); } );
fv:      { cells = (108, 24); };
output:  { snapshots = false; series = 2; checkpoint = 1.5; };
'''
alone('fv', 'full', varied(hos, '"hos"', '"full"'))
alone('fv', 'hos', hos)
for folder, *words in (('full', 'evolve nonlinearly over a periodic line of .* m, [0-9]* x 1 points, by the layer'),
                       ('hos', '5 orders in steepness', 'take .* s a period to compute')):
    start('fv', folder + '.cfg', '--check', log=folder + '_check.txt')
    for said in words:
        told(folder + '_check', said)


def focus(folder):
    """Time and height of the highest level."""
    path = folder + '/series.csv'
    high = max(column(path, 'a '))
    return column(path, 't')[column(path, 'a ').index(high)], high


when, high = focus('full')
near('s when a group focuses', when, 3.2, 0.1)
near('m of its crest of 0.01 m over the bed', high, 0.1705, 0.0015)
near('s when it focuses by orders in steepness', focus('hos')[0], when, 0.03)
near('m of its crest by orders in steepness', focus('hos')[1], high, 2e-5)
grains = varied(hos, 'end = 4.0', 'end = 0.2', 'checkpoint = 1.5', 'checkpoint = 0.1', 'fv:      { cells = (108, 24); };',
                'sph:     { dx = 0.02; scheme = "riemann_ale"; };')
alone('sph', 'one', grains)
if run(*mpi, '-n', '2', build + '/sph', 'one.cfg', '-o', 'two') != 0:
    bad('sph on two ranks', 'out.txt')
close('kinetic energy on two ranks', last('two/series.csv', 'kinetic'), last('one/series.csv', 'kinetic'), 1e-6)
alone('sph', 'part', grains, 'time.end=0.1')
alone('sph', 'part', grains, '', '--restart')
if open('one/series.csv').readlines()[-1] != open('part/series.csv').readlines()[-1]:
    bad('a restart gives other bits')
write('bad.swd', 'no waves')
for old, new, words in (
        ('evolve = "hos";', r'\g<0> order = 1;', 'waves.order: is not used: waves that evolve'),
        (r'kind = "focused"; (.*)at = \(2.0, 3.2\); repeat = 8.0;', r'\1', 'waves.evolve: is not used: regular waves keep their form'),
        ('kind = "focused".*zone', 'kind = "file"; file = "bad.swd"; zone',
         'waves.file: .*bad.swd: byte 8: the file ends before its header does'),
        ('kind = "focused".*zone', 'kind = "file"; zone', 'waves.kind: which file'),
        ('repeat = 8.0;', r'\g<0> file = "bad.swd";', 'waves.file: is not used: only waves of kind file')):
    refused_by('fv', hos, old, new, words)
refused_by('fv', varied(hos, 'length = 1.0', 'length = 1.2', '0.16', '0.4', '0.24', '0.8'), 'height = 0.02', 'height = 0.12',
           'waves.height: 0.12 m: .* orders in it .* reach 0.3')
lib.end('focus at %.4g s, %.5g m; %d faults' % (when, high, lib.failed))
