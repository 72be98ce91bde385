"""The coupler between two mock solvers: same bits on any ranks, refused plans, dying programs, waiting.
SPDX-License-Identifier: BSD-3-Clause"""
import os
import shutil
import signal

import lib
from lib import bad, build as b, judge, lines_of, meanwhile, mpirun, says, write

CASE = '''format = 1;
time: { end = 0.5; };
domain: { dim = 2; min = (0.0, 0.0); max = (1.0, 1.0); periodic = (true, true); };
output: { every = 0.25; };
sph: { dx = 0.02; };
fv: { cells = (40, 40); };
'''
FAILED = range(1, 6)


def mock(name, ranks, keys='', folder='o'):
    return (ranks, b + '/tests/mock', name, 'points' if name == 'sph' else 'grid', folder, *keys.split())


def coupler(ranks, *options, within=()):
    return (ranks, *within, b + '/coupler', 'case.cfg', '-o', 'o', *options)


def job(ranks='1:1:1', sph='', options='', fv='', hit=None, version=False, most=30):
    """Runs it, into the folder o: the exit code; hit: a signal to the coupler after coupling step 2."""
    shutil.rmtree('o', ignore_errors=True)
    n, p, q = ranks.split(':')
    first, within = mock('sph', n, sph), ()
    if version:  # its hello speaks another one
        first = (n, 'env', 'LD_PRELOAD=%s/tests/kill_at.so' % b, 'KILL_AT=version', *first[1:])
    if hit:
        within = 'sh', '-c', 'echo $$ >pid; exec "$@"', 'sh'
        thread = meanwhile(lambda: os.path.exists('o/sph.0') and says('^2 ', 'o/sph.0'), lambda: os.kill(int(open('pid').read()), hit))
    code = mpirun(first, coupler(p, *options.split(), within=within), mock('fv', q, fv), most=most)
    if hit:
        thread.join()
    return code


def bits():
    return lines_of('o/sph.*'), lines_of('o/fv.*')


def death(what, *patterns, **how):
    """The job fails within 5 s on a quiet machine, long before the patience everywhere, and says each pattern. The launcher
    kills all within 1 s of the first end: whom a busy machine gives no processor time until then says nothing, so a fault is
    what happens three times out of three."""
    for _ in range(3):
        code = job(**how, most=20)
        if code not in (0, 124) and all(map(says, patterns)):
            return
    judge(what, code, set(range(1, 256)) - {124}, *patterns)


def all_say(what, *patterns):
    for pattern in patterns:
        n = sum(pattern in line for line in open('out.txt', errors='replace'))
        if n != 3:
            bad('%s: "%s" is said by %d programs of 3' % (what, pattern, n), 'out.txt')


lib.scratch()
write('case.cfg', CASE)
for keys in 'mls=0 cubic=0', 'mls=1 cubic=1', 'mls=1 cubic=1 still=1':
    judge('a plain job', job('1:1:1', keys, fv=keys), 0)
    plain = bits()
    busy = lib.summary('o')['cpu_of']
    for ranks in '2:3:1', '1:2:3', '3:1:2':
        judge('a job on ' + ranks, job(ranks, keys, fv=keys), 0)
        if bits() != plain or not all(plain):
            bad('%s: other bits on ranks %s' % (keys, ranks))
    shutil.rmtree('o')
    judge('programs in another order', mpirun(mock('fv', 1, keys), coupler(2), mock('sph', 1, keys)), 0)
    if bits() != plain:
        bad('%s: other bits in another order of the programs' % keys)
if lib.summary('o')['error']['velocity_l2'] != 0.001:
    bad('norms of the solvers do not add up in summary.json', 'o/summary.json')

for how in 'kill', 'segv', 'exit', 'abort', 'finalize':
    death('sph, ' + how, '^fv rank 0: .*sph rank 0', '^coupler rank 0: .*sph rank 0', sph='fault=' + how)
    death('fv, ' + how, '^sph rank 0: .*fv rank [01]', '^coupler rank [01]: .*fv rank [01]', ranks='1:2:2', fv='fault=' + how)
for hit in signal.SIGKILL, signal.SIGSEGV, signal.SIGABRT:
    death('coupler, %s' % hit.name, '^sph rank 0: .*coupler rank 0', '^fv rank 0: .*coupler rank 0', sph='fault=sleep at=3', hit=hit)

# who is stopped is named after the patience; who is at work for longer shows signs of life, and who waits for it those 3 s
# leaves the processor to others
impatient = {'options': '--patience 1', 'fv': 'patience=1'}
judge('a stopped program', job(sph='fault=stop patience=1', **impatient), 4, 'sph rank 0 has shown no sign of life for [1-9] s')
judge('a program at work for longer than the patience', job(sph='fault=sleep patience=1', **impatient), 0)
waiting = lib.summary('o')['cpu_of']
for name in 'coupler', 'fv':
    if not (waiting[name] - busy[name]) / 3 < 0.3:  # of a busy machine's starts, not 1
        bad('%s waits at %g s of processor time in 3 s (without waiting: %g s)' % (name, waiting[name], busy[name]))
# who writes on another disk, and shows no sign there, is not taken for dead
shutil.rmtree('o')
os.mkdir('elsewhere')
judge('folders on two disks', mpirun(mock('sph', 1, 'fault=sleep patience=1', 'elsewhere'), coupler(1, '--patience', '1'),
                                     mock('fv', 1, 'patience=1')), 0)

# numbers that are no numbers, puts that are forgotten
judge('NaN in a field', job(sph='fault=nan'), 2, 'velocity: value 0 of particles on rank 0 is not finite')
judge('a forgotten put', job(fv='fault=forget', most=20), FAILED,
      'sph waits in coupling step 3 for pressure of fv, which has not been given')
judge('a forgotten put', job(sph='fault=forget', most=20), FAILED,
      'fv waits for velocity, but sph has ended coupling step 2 without giving it')

# plans that do not fit are refused by all, with the whole list
knots = 'velocity: sph gives it in knots'
judge('wrong units', job('1:2:1', 'unit=knots', fv='unit=bar dt=-1'), 2, 'asks for coupling steps of -1 s')
all_say('wrong units', knots, 'pressure: fv gives it in bar')
judge('wrong unit and dimensions', job(sph='unit=knots dim=3'), 2)
all_say('wrong unit and dimensions', knots, 'velocity: particles of sph has 3 dimensions, targets of fv has 2')
judge('wrong direction', job(sph='unit=knots', fv='back=2'), 2)
all_say('wrong direction', knots, 'pressure: sph takes it, but nobody gives it')
judge('another version', job(version=True, most=20), 2, 'programs of different versions')
judge('another case', job(sph='hash=1'), 2, 'sph reads another case than coupler')
judge('a faulty case', job(options='-p time.end=0'), 2, 'coupler: 1 fault in its input')

# a program that is silent, or not there
judge('silent sph', job(sph='late=6 deadline=1', options='--deadline 1', fv='deadline=1', most=20), 2,
      '^coupler rank .*no message from world rank 0')
judge('no fv', mpirun(mock('sph', 1), coupler(1, '--force')), 2, 'group fv, but no program .fv')
judge('no coupler', mpirun(mock('sph', 1), mock('fv', 1)), 2, 'fv: no program .coupler. in this job')

# ends: in order on request, with a restart point after one more coupling step; not accepted
judge('an orderly end', job(sph='end=1'), 5)
if 'window 2' not in lines_of('o/checkpoint.txt') or lib.summary('o')['status'] != 'stopped':
    bad('an orderly end: no restart point, or not in summary.json', 'o/summary.json')
if open('o/fv.0').read().splitlines()[-1].split()[0] != '2':
    bad('an orderly end: not after one more coupling step', 'o/fv.0')
write('case.cfg', CASE + 'accept: ( { what = "error.velocity_l2"; tolerance = 1e-4; } );')
judge('not accepted', job('1:2:1'), 1)
lib.end('%d faults' % lib.failed)
