"""The life of a program, with the toy solver: output times, restart, divergence, stop, refusals, exit codes.
SPDX-License-Identifier: BSD-3-Clause"""
import glob
import os
import re
import resource
import shutil
import signal
import subprocess
import time

import lib
from lib import bad, build as b, judge, mpirun, run, same_values, says, start, summary, until, write

TOY = next(path for path in ('asan/tests/toy', 'tests/toy') if os.access(os.path.join(b, path), os.X_OK))
os.environ['ASAN_OPTIONS'] = 'detect_leaks=0:handle_segv=0:verify_asan_link_order=0'  # behind starts.so


def ends(wanted, *args, ranks=0, words=()):
    """A run of the toy, by mpirun if ranks are given, ends with this exit code and says the words."""
    code = mpirun((ranks, b + '/' + TOY, *args)) if ranks else start(TOY, *args)
    judge('toy ' + ' '.join(args), code, wanted, *words)


def holds(well, what, log=None):
    if not well:
        bad(what, log)


def count(n, *patterns):
    found = [path for pattern in patterns for path in glob.glob(pattern)]
    holds(len(found) == n, 'wanted %d files %s: %s' % (n, patterns, found))


lib.scratch()
CASE = '''format = 1;
time:   { end = 1.0; };
domain: { max = (1, 1); };
toy:    { dt = 0.007; };
output: { every = 0.3; };
accept: ( { what = "error.x_linf"; tolerance = 1e-12; } );
'''
os.mkdir('swing')
write('swing/case.cfg', CASE)
quiet = '-p', 'output.snapshots=false'
# t = 0, 0.3, 0.6, 0.9 and the end; the folder is named after the case
ends(0, 'swing')
count(5, 'out/swing/toy_0*.h5')
well = summary('out/swing')
# files that a case names by a path from the root
write('half.csv', 't,E\n0,5\n1,5.001\n')
write('root.cfg', CASE[:CASE.index('accept')] + 'accept: ( { what = "energy"; column = "E"; reference = "%s"; '
      'measure = "peak"; tolerance = 0.01; } );\n' % os.path.abspath('half.csv'))
ends(0, 'root.cfg', *quiet)
# a series has as many columns as the program adds
ends(0, 'swing', *quiet, '-p', 'toy.columns=1000', '-o', 'wide')
holds({len(line.split(',')) for line in open('wide/series.csv')} == {1002}, 'wide/series.csv')
holds(well['status'] == 'done' and well['accepted'] is True and well['t_end'] == 1, 'summary.json', 'out/swing/summary.json')
holds(says('Time Value="0.89999999999999991"', 'out/swing/toy.xdmf'), 'toy.xdmf lacks t = 0.9', 'out/swing/toy.xdmf')
rows = open('out/swing/series.csv').read().splitlines()
holds(rows[0] == 't [s],dt [s],energy [J/m]' and rows[-1].split(',')[0] == '1', 'series.csv: its header, or its end', 'out/swing/series.csv')
holds(says('oscillators', 'out/swing/log.txt'), 'log.txt', 'out/swing/log.txt')
ends(0, 'swing', '-o', 'two', ranks=2)
holds(run('h5diff', '-d', '1e-12', 'out/swing/toy_000004.h5', 'two/toy_000004.h5') == 0, 'two ranks give another result')
ends(0, 'swing', '--check', '-o', 'checked')
holds(not os.path.exists('checked'), '--check wrote something')

# cpu_s counts all from main() on, as the shell does but for loading the program; wall_s the start, too
before = resource.getrusage(resource.RUSAGE_CHILDREN)
subprocess.run([b + '/' + TOY, 'swing', '-o', 'counted', *quiet], stdout=subprocess.DEVNULL, check=True)
spent = sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2]) - sum(before[:2])
cost = summary('counted')
holds(0.4 * spent < cost['cpu_s'] < spent + 0.03 and 0 < cost['start_s'] < cost['wall_s'],
      'what a run costs: cpu_s %(cpu_s)g of {:g}, wall_s %(wall_s)g, start_s %(start_s)g'.format(spent) % cost)

# tolerances, refusals, --force, and what --force must leave alone
write('strict.cfg', CASE.replace('1e-12', '-1'))
ends(1, 'strict.cfg', *quiet)
holds(summary('out/strict')['accepted'] is False, 'accepted', 'out/strict/summary.json')
count(0, 'out/strict/*.h5')
write('film.cfg', '''format = 1;
time:    { end = 0.8; };
fluid:   { nu = 1e-06; gravity = (2, -9.81); };
domain:  { max = (1, 1); };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
shapes:  ( { form = "box"; box = ((-1, -1), (2, 0.02)); } );
fv:      { cells = (32, 32); volume = "shift"; };
output:  { snapshots = false; };
''')
# the level set loses a film thinner than a cell: done, but not accepted
judge('a film', start('fv', 'film.cfg'), 1, 'NOT ACCEPTED')
holds(summary('out/film')['not_accepted'], 'no reason', 'out/film/summary.json')
ends(2, 'swing', words=['already'])
for name in 'toy.c', 'toy_io.c', 'toy.cfg':
    write('out/swing/' + name, '')
ends(0, 'swing', '--force')
count(3, 'out/swing/toy*.c', 'out/swing/toy.cfg')
count(5, 'out/swing/toy_0*.h5')
ends(2, 'swing', '--restart', '-o', 'nothing')
ends(2, 'swing', '-p', 'toy.slwo=1', words=['did you mean .slow'])
ends(0, '--help', 'dt', words=['time step'])
ends(0, '--help', 'tooy', words=['did you mean .toy'])

# straight through, and in two parts: the same bits, rows and times; a restart file is read by any number of ranks
saves, early = ('-p', 'output.checkpoint=0.45'), ('-p', 'time.end=0.93')
for n in 1, 2, 3:
    ends(0, 'swing', '-o', 'whole%d' % n, *saves, ranks=n)
    ends(0, 'swing', '-o', 'parts%d' % n, *saves, *early, ranks=n)
    count(2, 'parts%d/toy-checkpoint-*.h5' % n)
    if n == 2:
        for moved in 'moved1', 'moved3':
            shutil.copytree('parts2', moved)
    ends(0, 'swing', '-o', 'parts%d' % n, *saves, '--restart', ranks=n)
    holds(same_values('whole%d/toy_000004.h5' % n, 'parts%d/toy_000004.h5' % n), 'restart gives other bits', 'diff.txt')
    for file in '/series.csv', '/toy.xdmf':
        holds(open('whole%d' % n + file).read() == open('parts%d' % n + file).read(), 'restart gives another ' + file[1:])
for n in 1, 3:
    ends(0, 'swing', '-o', 'moved%d' % n, *saves, '--restart', ranks=n)
    holds(same_values('whole%d/toy_000004.h5' % n, 'moved%d/toy_000004.h5' % n), 'restart from 2 to %d ranks' % n, 'diff.txt')
ends(2, 'swing', '-o', 'moved1', '--restart', '-p', 'toy.n=11', words=['the case differs: toy.n = 10 in the file, 11 here'])

# a restart file of a time after the end; a folder in which a run is at work, which --force spares
ends(2, 'swing', '-o', 'parts1', '--restart', '-p', 'time.end=0.1', words=['stands at t = .* after time.end = 0.1 s'])
busy = subprocess.Popen([b + '/' + TOY, 'swing', '-o', 'busy', '-p', 'time.end=1e6', '-p', 'output.every=1e6', '-p', 'toy.slow=0.01'],
                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
until(lambda: os.path.exists('busy/log.txt'))
ends(2, 'swing', '-o', 'busy', '--force', words=['a run of toy is at work in busy'])
busy.terminate()
busy.wait()
ends(0, 'swing', '-o', 'busy', '--force')

# a restart file that is cut short or has another bit is refused; without it, one can go on from an earlier one
ends(0, 'swing', '-o', 'hurt', *saves, *early)
file = 'hurt/' + re.search('^toy (.*)', open('hurt/checkpoint.txt').read(), flags=re.M)[1]
whole = open(file, 'rb').read()
for hurt in whole[:2100] + b'X' + whole[2101:], whole[:3000]:
    open(file, 'wb').write(hurt)
    ends(2, 'swing', '-o', 'hurt', '--restart', words=['is damaged: cut short, or a bit of it has changed'])
open(file, 'wb').write(whole)
ends(0, 'swing', '-o', 'hurt', '--restart', '-p', 'output.checkpoint=0.02')
count(2, 'hurt/toy-checkpoint-*.h5')

# a disk of its own that takes no more: one sentence, code 2, what was complete stays
os.mkdir('small')
small = ['unshare', '-rm', 'sh', '-c', 'mount -t tmpfs -o size=24k tmpfs small && "$@"', 'small']
if run(*small, 'true') == 0:
    for n in '1', '2':
        judge('a full disk on %s ranks' % n, run(*small, *lib.mpi, '-np', n, b + '/tests/toy', 'swing', '-o', 'small/out'), 2,
              'cannot write small/out/.*: the disk is full; restart files that were complete')
else:
    print("note: no disk of one's own can be made here; the full disk is not tested")

# divergence: a reason, a place, a last snapshot
ends(3, 'swing', '-o', 'ill', '-p', 'toy.bad=20', ranks=2, words=['diverged at t = 0.13.* step 20: oscillator 9 is tired', 'where *rank 1'])
holds(summary('ill')['status'] == 'diverged', 'not diverged', 'ill/summary.json')
count(1, 'ill/toy_diverged.h5')
holds(says('toy_diverged.h5', 'ill/toy.xdmf'), 'toy.xdmf lacks toy_diverged.h5', 'ill/toy.xdmf')

# an orderly stop, by each signal, right behind the first file, also in slow steps; then on to the end
for number in signal.SIGINT, signal.SIGTERM, signal.SIGUSR1:
    folder = 'stop' + number.name
    job = subprocess.Popen([b + '/' + TOY, 'swing', '-o', folder, '-p', 'toy.slow=1', '-p', 'toy.dt=0.05', '-p', 'output.every=0'],
                           stdout=open('out.txt', 'w'), stderr=subprocess.STDOUT)
    while job.poll() is None and not os.path.exists(folder + '/series.csv'):
        time.sleep(0.001)
    job.send_signal(number)
    judge(folder, job.wait(60), 5)
    holds(summary(folder)['status'] == 'stopped', folder, folder + '/summary.json')
    ends(0, 'swing', '-o', folder, '-p', 'output.every=0', '--restart')
    files = re.findall('toy_[0-9]*.h5:/position', open(folder + '/toy.xdmf').read())
    holds(len(set(files)) == len(files), folder + ': a file twice in toy.xdmf')

# a fault of the program is named
ends(range(1, 256), 'swing', '-o', 'fault', '-p', 'toy.fault=5', ranks=2, words=['toy rank .: segmentation fault'])
lib.end('%d faults' % lib.failed)
