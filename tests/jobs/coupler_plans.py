"""Every promise of cpl.h beside those of coupler.py: three programs and more, targets of one field, times of reads, mappings,
general cells, periods, names, extremes. Partners: mock_any.c. SPDX-License-Identifier: BSD-3-Clause"""
import glob
import os
import shutil

import lib
from lib import bad, build as b, judge, lines_of, mpirun, root, write

HALF = 'time: { end = 0.5; }; output: { every = 0.25; };'
GIVER, TAKER = '1 giver points=a:2:9:0 put=T:a:1:1:end', '1 taker points=x:2:9:0.3 get=T:x:1:0:1:1'
FAILED = range(1, 6)


def job(what, *programs, keys=HALF, ranks=1, wanted=0, words=(), within=(), more=()):
    """Programs ("RANKS NAME WORDS" of mock_any, or another with its ranks) and ranks of the coupler, into the folder o."""
    write('job.cfg', 'format = 1;\n%s\n' % keys)
    if not more:
        shutil.rmtree('o', ignore_errors=True)
    partners = [(p.split()[0], b + '/tests/mock_any', p.split()[1], 'o', *p.split()[2:]) if isinstance(p, str) else p for p in programs]
    judge(what, mpirun((ranks, *within, b + '/coupler', 'job.cfg', '-o', 'o', *more), *partners), wanted, *words)


def refused(what, giver, taker, *words, code=2):
    job(what, giver, taker, wanted=code, words=words)


def got(*programs):
    """Window, field, point, component, mask and value of all that they took."""
    return [tuple(line.split()) for program in programs for line in lines_of('o/%s.[0-9]*' % program)]


def same(what, bits, wanted):
    if not bits or bits != wanted:
        bad('%s: other bits' % what)


def numbers(program, field, what):
    return [float(line.split()[-1]) for line in lines_of('o/%s.sums' % program) if line.startswith('%s %s ' % (field, what))]


def off(program, what, **limits):
    """The largest difference of each field from the exact one."""
    for field, most in limits.items():
        values = numbers(program, field, 'off')
        if not values or not all(value <= most for value in values):
            bad('%s: %s of %s is off by %s, wanted at most %g' % (what, field, program, values, most))


def conserved(what, *fields):
    """What was put and what was got in each coupling step agree to rounding."""
    for field in fields:
        put, taken = numbers('giver', field, 'put'), numbers('taker', field, 'got')
        if not 2 <= len(taken) <= len(put) or not all(abs(v - w) <= 1e-13 * abs(v) for v, w in zip(put, taken)):
            bad('%s: sums of %s: %s beside %s' % (what, field, put, taken))


def errors(words, n, most):
    """So many lines of the log say these words before an error and its unit."""
    values = [float(line.split()[-2]) for line in open('out.txt', errors='replace') if words in line]
    if len(values) != n or not all(value <= most for value in values):
        bad('%s: %s, wanted at most %g' % (words, values, most))


lib.scratch()
# three solvers, one field with four takers (two sets of one program among them), another way round, ranks of all kinds
first = None
for ranks, hot, cold, both in (1, 1, 1, 1), (2, 3, 2, 3):
    job('three solvers', '%d hot points=a:2:400:0.2 put=T:a:1:1:end get=S:a:2:1:1:1' % hot,
        '%d cold points=x:2:50:0.2 points=y:2:70:0.2 get=T:x:1:0:1:1 get=T:y:1:1:1:1' % cold,
        '%d both points=z:2:90:0.3 points=w:2:40:0.1 get=T:z:1:1:1:1 get=T:w:1:2:1:1 put=S:z:2:1:end' % both,
        keys=HALF + ' coupler: { programs = "hot cold both"; };', ranks=ranks)
    off('cold', 'three solvers', T=3)  # Shepard
    first = first or got('hot', 'cold', 'both')
    same('three solvers on %d:%d:%d:%d' % (ranks, hot, cold, both), got('hot', 'cold', 'both'), first)
if 'hot' not in lib.summary('o')['waited_for']:
    bad('three solvers: not all in summary.json')

# least squares keep linear functions; coefficients in time are exact for the field's parabola, wherever it is read.
# Between: a straight line; the parabola is off by (1 + x + 2 y) s (1 - s) dt^2 = 4 * 0.25 * 0.25^2 at most
job('a course in time', '2 giver points=a:2:900:0 grid=g:8:8 put=S:a:3:3:start put=E:a:1:3:end put=B:a:1:1:end put=G:g:1:1:end '
    'put=P:g:1:3:start first=B first=G', '2 taker points=x:2:60:0.15 points=y:2:60:0 get=S:x:3:1:0:0.37 get=E:x:1:1:1:0.4 '
    'get=B:x:1:1:2:0.5 patch=G:y:1:0:2:0.5 patch=P:y:1:1:0:0.81')
off('taker', 'points, followed from the start, back from the end, between', S=1e-11, E=1e-11, B=0.0626)
off('taker', 'a patch, between, followed from the start', G=0.0626, P=1e-11)
refused('nothing at the start', GIVER, TAKER.replace('1:1', '2:0.5'),
        'taker needs T of giver as it was at the start of coupling step 0, but giver has put none', code=4)
refused('a read outside of the window', GIVER, TAKER.replace('1:1', '1:1.5'), r'T: t = 0\.375 s is not in the coupling step 0 \.\. 0\.25 s')

# conservative: sums to rounding for all kinds, also where nobody is in reach, on any ranks; periodic, too
fields = ['F%d%s' % (way, x) for way in (16, 17, 18) for x in 'xy']
first = None
for ranks, p, q in (1, 1, 1), (3, 2, 2):
    job('conservative', '%d giver points=a:2:300:0 %s' % (p, ' '.join('put=%s:a:2:2:end' % field for field in fields)),
        '%d taker points=x:2:80:0.2 points=y:2:80:1e-3 ' % q + ' '.join('get=%s:%s:2:%s:1:1' % (f, f[3], f[1:3]) for f in fields),
        keys=HALF + ' coupler: { period = (1.0, 0.0); };', ranks=ranks)
    conserved('conservative on %d:%d:%d' % (ranks, p, q), *fields)
    first = first or got('taker')
    same('conservative on %d:%d:%d' % (ranks, p, q), got('taker'), first)
job('conservative in three dimensions', '1 giver points=a:3:200:0 put=F:a:1:1:end', '1 taker points=x:3:40:0.3 get=F:x:1:17:1:1')
conserved('conservative in three dimensions', 'F')
# the transpose of a consistent mapping: sum of (T mapped to x) g = sum of T (g dealt out), unit by unit in test_map.c
refused('conservative from a grid', '1 giver grid=g:4:4 put=F:g:1:1:end', '1 taker points=x:2:8:0.2 get=F:x:1:16:1:1',
        'F: taker takes it conservatively, but giver gives it on a grid')

# general cells: their volumes fill the square, means at centroids are exact for linear functions
job('general cells', '2 giver cells=c:20:0 points=a:2:500:0 put=T:c:1:1:end put=U:a:1:1:end',
    '2 taker points=x:2:60:0.2 cells=d:10:0.2 get=T:x:1:1:1:1 get=U:d:1:1:1:1')
off('taker', 'general cells, and onto them', T=1e-11, U=1e-11)

# periods: of a set (U), of the case
for period, wanted in (0, range(18)), (1, [18]):
    job('periods', '1 giver points=a:2:40:0 points=b:2:40:0:1 put=T:a:1:1:end put=U:b:1:1:end',
        '1 taker shift=0.9 points=x:2:9:0.3 get=T:x:1:2:1:1 get=U:x:1:2:1:1',
        keys=HALF + ' coupler: { period = (%d.0, %d.0); };' % (period, period))
    n = {field: sum(line[1] == field and line[4] == '1' for line in got('taker')) for field in 'TU'}
    if n['T'] not in wanted or n['U'] != 18:
        bad('period %d of the case, 1 of the second set: %s points mapped' % (period, n))
refused('different periods', '1 giver points=a:2:40:0:1 put=T:a:1:1:end', '1 taker points=x:2:9:0.3:2 get=T:x:1:2:1:1',
        'a of giver has the period 1 m, x of taker 2 m')

# a start that is not 0, windows by the case, by the shortest wish
job('a late start', '1 giver t0=2 points=a:2:900:0 put=T:a:1:1:end', '1 taker t0=2 points=x:2:9:0.15 get=T:x:1:1:1:1',
    keys='time: { end = 3.0; }; coupler: { start = 2.0; window = 0.25; };')
off('taker', 'a late start', T=1e-10)
if lib.summary('o')['windows'] != 4:
    bad('coupler.window: %d coupling steps, wanted 4' % lib.summary('o')['windows'])
refused('another start', GIVER.replace('points', 't0=1 points'), TAKER, 'giver starts at t = 1 s, but coupling step 0')
job('other programs', GIVER, TAKER, keys=HALF + ' coupler: { programs = "giver other"; };', wanted=2,
    words=['coupler.programs names `other., but it is not in this job', 'program `taker. is in this job, but not in coupler.programs'])
alone = GIVER.replace('T:', '?T:')
job('a case without an end', alone, keys='coupler: { window = 0.1; };', wanted=2, words=['the case must have this group'])
job('a group of nobody', alone, keys=HALF + ' giver: { anything = 1; }; nobody: { };', wanted=2, words=['nobody.*unknown group'])
job("a program's own group; a field that nobody needs", alone, keys=HALF + ' giver: { anything = 1; }; fluid: { anything = 2; };')

# a restart: by the manifest, the same bits
saves = 'time: { end = 1.0; }; output: { every = 0.25; checkpoint = 0.5; }; coupler: { start = 0.0; };'
giver, taker = '1 giver %s points=a:2:90:0 put=T:a:2:2:end', '2 taker %s points=x:2:9:0.4 get=T:x:2:1:1:0.3'
job('a job with restart points', giver % '', taker % '', keys=saves)
late = [line for line in got('taker') if int(line[0]) > 1]
if not {'window 3', 'taker state.bin'} <= set(lines_of('o/checkpoint.txt')):
    bad('manifest', 'o/checkpoint.txt')
job('a restart', giver % 'restart=1 t0=0.5', taker % 'restart=1 t0=0.5', keys=saves, more=['--restart'])
same('a restart', got('taker'), late)

# plans that do not fit
refused('two givers', GIVER, '1 other points=a:2:9:0.3 put=T:a:1:1:end get=T:a:1:0:1:1', 'field T: it is given 2 times')
refused('an unknown mapping', GIVER, TAKER.replace('x:1:0', 'x:1:7'), r'T: taker asks for an unknown way \(7\) of mapping')
refused('too many terms', GIVER.replace('1:1', '1:5'), TAKER, 'T: 5 terms in time; 1 to 4 are possible', code=FAILED)
refused('too many components', GIVER.replace('a:1', 'a:65'), TAKER.replace('x:1', 'x:65'),
        'field T: 65 components, 1 to 64 are possible', code=FAILED)
refused('another header', GIVER.replace('points', 'version=2 points'), TAKER, r'compiled with cpl\.h 2, but its libcpl is 3')
refused('another number of components', GIVER.replace('a:1', 'a:2'), TAKER, 'T: giver gives 2 components, taker takes 1')
refused('no support radius', GIVER, TAKER.replace('0.3', '0'), 'T: x of taker has no support radius')
refused('another restart window', GIVER.replace('points', 'restart=3 points'), TAKER,
        'taker starts at coupling step -1, giver at coupling step 3: restart all from one manifest')
refused('a zone twice, faults of a partner', GIVER.replace('points', 'zone=box points'),
        TAKER.replace('points', 'zone=box faults=2 points'),
        'zone box is published by taker and by giver', 'taker: 2 faults in its input')

# every call that is wrong says so, and the job goes on
job('wrong calls', *((1, b + '/tests/mock_calls', name, 'o') for name in ('one', 'two')))

# as many programs as can be, and one more; all of their names in full
takers = [TAKER.replace('taker', name).replace('9:0.3', '3:0.9') for name in ['a-rather-long-name', *map('p{}'.format, range(1, 30))]]
job('31 solvers, 30 takers of a field', GIVER, *takers, words=['^  a-rather-long-name  .* 1$'])
lines = lines_of('o/p*.0')
if set(map(lines.count, lines)) != {29}:
    bad('31 solvers: takers got different values')
job('32 solvers', GIVER, *takers, '1 more', wanted=2, words=['more programs in one job than this version knows'])

# a list of problems that is too long says so
gets = ' '.join('get=a-rather-long-name-of-a-field-that-nobody-in-this-job-gives-%d:x:1:0:1:1' % i for i in range(1, 21))
job('a long list', *('1 %s points=x:2:1:0.3 %s' % (name, gets) for name in ('one', 'two', 'three')), wanted=2, words=[r'^\.\.\. and more$'])

# names: the longest, and one longer
n63, n64 = 63 * 'n', 64 * 'n'
job('63 bytes', GIVER.replace('giver', n63).replace('a:', n63 + ':').replace('T', n63), TAKER.replace('T', n63))
if n63 not in lib.summary('o')['waited_for']:
    bad('a program of 63 bytes: cut in the summary')
for what, giver, taker in ('set', GIVER.replace('a:', n64 + ':'), TAKER), ('field', GIVER.replace('T', n64), TAKER.replace('T', n64)):
    refused('a long ' + what, giver, taker, '%s .%s.: a name of 64 bytes, 63 are possible' % (what, n64), code=FAILED)
for name in n64, 'a.b':
    refused('a program ' + name, GIVER.replace('giver', name), TAKER, 'cannot be the name of a program')

# extremes: nothing at all, one point, one cell, far outside, 16 components
ways = 0, 1, 2, 16, 17, 18
puts, gets = (' '.join(word % (way, way) for way in ways) for word in ('put=T%d:a:1:1:end%.0s', 'get=T%d:x:1:%d:1:1'))
job('no points on either side', '3 giver points=a:2:0:0 put=T:a:1:1:end', '3 taker points=x:2:0:0.3 get=T:x:1:1:1:1', ranks=3)
job('no givers', '3 giver points=a:2:0:0 ' + puts, '3 taker points=x:2:5:0.3 ' + gets, ranks=3)
job('no takers', '3 giver points=a:2:5:0 ' + puts, '3 taker points=x:2:0:0.3 ' + gets, ranks=3)
job('one point; points far off; a grid of one cell, and places outside',
    '3 giver points=a:2:1:0 grid=g:1:1 shift=5 points=b:2:5:0 put=F:b:1:1:end put=G:g:1:1:start ' + puts,
    '3 taker points=x:2:1:0.3 shift=-5 points=y:2:5:0.3 shift=7 points=z:2:5:0 get=F:y:1:1:1:1 patch=G:z:1:1:0:0 ' + gets, ranks=3)
lines = got('taker')
for way in ways:
    if ('T%d' % way, '3', '0', '1') not in {line[1:5] for line in lines}:
        bad('one point, mapping %d: not mapped' % way)
if sum(line[1] == 'F' and line[4] == '0' and float.fromhex(line[5]) == 0 for line in lines) != 10:
    bad('points far off: mapped')
for window in '0', '1':
    values = {float.fromhex(line[5]) for line in lines if line[:2] == (window, 'G')}
    if len(values) != 1 or 0 in values:
        bad('a grid of one cell: its value is not everywhere: %s' % values)
job('16 components', '2 giver points=a:2:900:0 put=T:a:16:3:start grid=g:9:9 put=G:g:16:2:start',
    '2 taker points=x:2:60:0.15 get=T:x:16:1:0:0.5 patch=G:x:16:1:0:0 patch=G:x:16:0:0:0', ranks=2)
off('taker', '16 components of points, and of a grid, linear and cubic', T=1e-10, G=1e-10)

# 25000 windows of nothing: memory stays, where the least block of each, 32 bytes, would be 800 kB
watch = '(while read -r _ n _ </proc/$$/statm; do echo $n; sleep 0.05; done >pages 2>/dev/null) & exec "$@"'
job('25000 windows of nothing', '1 one dt=4e-5 say=2000', '1 two say=2000', keys='time: { end = 1.0; };', within=['sh', '-c', watch, 'sh'])
if lib.summary('o')['windows'] != 25000:
    bad('%d windows, wanted 25000' % lib.summary('o')['windows'])
for program in 'one', 'two':
    kb = [int(line.split()[1]) for line in open('o/%s.sums' % program) if line.startswith('memory ')]
    if len(kb) != 2 or kb[1] - kb[0] > 512:
        bad('25000 windows: resident kB of %s at window 2000 and the end: %s' % (program, kb))
# pages of the coupler, from the middle of the job on: as many readings as its run time leaves, which may be 0.3 s
pages = [int(n) for n in open('pages').read().split() if n != '0']
if len(pages) < 4 or 4 * (pages[-1] - pages[len(pages) // 2 - 1]) > 512:
    bad('25000 windows: pages of the coupler: %s' % pages)

# the plain example: the same as one program with the whole wall; its error is Euler's
left, right = ((1, b + '/examples/heat', side, 'h', '40') for side in ('left', 'right'))
judge('coupler/examples/heat', mpirun(left, (1, b + '/coupler', root + '/coupler/examples/heat.cfg', '-o', 'h', '--force'), right), 0)
errors('is off by', 2, 2e-5)  # T decays as exp(-pi^2 t): by Taylor the scheme's rate is off by pi^4 h^2/24, at t = 0.1 by 1.2e-5 K

# python: exact.py in fv's place
python = [p for p in ('python3', '/usr/bin/python3') if shutil.which(p) and lib.run(p, '-c', 'import mpi4py') == 0]
if not python:
    print('skipped: coupler/python: no python3 with mpi4py (apt-get install python3-mpi4py)')
else:
    os.environ.update(PYTHONPATH='%s/coupler/python:%s' % (root, os.environ.get('PYTHONPATH', '')), OMP_NUM_THREADS='1',
                      ESTRAN_LIB=max(glob.glob(b + '/libcpl.so.*')))
    job('python, every call', (1, python[0], root + '/tests/jobs/partner.py', 'o'),
        '2 mock points=a:2:900:0 grid=g:8:8 points=x:2:40:0 put=T:a:1:1:end put=G:g:2:1:end patch=P:x:1:1:0:0.6')
    off('mock', 'what python gives', P=1e-11)
    case = [root + '/cases/taylor_green/case.cfg', '-o', 'py', '--force', '-p', 'coupler.programs="sph exact"']
    for change in 'sph.dx=0.02', 'time.end=0.24', 'output.every=0', 'output.snapshots=false':
        case += '-p', change
    exact = (1, python[0], root + '/coupler/examples/exact.py', 'py')
    judge('coupler/examples/exact.py', mpirun((1, b + '/sph', *case), (1, b + '/coupler', *case), exact), 0)
    errors('exact: velocity of sph', 1, 2)  # with the exact flow outside sph is no worse than the case wants of both together
lib.end('%d faults' % lib.failed)
