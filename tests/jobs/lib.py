"""lib.py - what job scripts in Python share. A script that imports it stands in a folder of its own afterwards: `build' is
the build, `root' the project. SPDX-License-Identifier: BSD-3-Clause"""
import atexit
import csv
import glob
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time

import stl

build = os.path.abspath(sys.argv[1] if len(sys.argv) > 1 else 'build')
root = os.path.abspath(os.path.join(os.path.dirname(__file__), '..', '..'))
name = os.path.splitext(os.path.basename(sys.argv[0]))[0]
long = 'LONG' in os.environ  # make check-long: what is finer, too
os.environ.update(ESTRAN_BUILD=build, OMPI_ALLOW_RUN_AS_ROOT='1', OMPI_ALLOW_RUN_AS_ROOT_CONFIRM='1')
mpi = 'mpirun --quiet --bind-to none --oversubscribe --mca mpi_yield_when_idle 1 --mca btl_vader_single_copy_mechanism none'.split()
failed = 0


def scratch(own=name):
    """Goes to an empty folder, which is removed at the end."""
    folder = tempfile.mkdtemp(prefix=own + '.', dir=os.environ.get('TEST_SCRATCH'))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    os.chdir(folder)


def bad(what, log=None):
    """One fault more, with the end of its log."""
    global failed
    failed += 1
    print('FAIL: %s' % what)
    if log:
        print(''.join(open(log, errors='replace').readlines()[-6:]), end='')


def end(said):
    print('%s: %s' % (name, said))
    sys.exit(1 if failed else 0)


class Starts:
    """Runs of one program on one rank, which starts MPI once for all of them (starts.c)."""

    def __init__(self, program):
        self.server = subprocess.Popen([os.path.join(build, program)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                                       env=dict(os.environ, LD_PRELOAD=build + '/tests/starts.so'))

    def __call__(self, *args, log='out.txt'):
        """The exit code, 128 and more for a signal; what it says is in `log'."""
        self.server.stdin.write('\t'.join([os.getcwd(), log, *args]) + '\n')
        self.server.stdin.flush()
        return int(self.server.stdout.readline())

    def close(self):
        self.server.stdin.close()
        self.server.wait()


servers = {}


def start(program, *args, log='out.txt'):
    """A run of sph or fv on one rank: the exit code."""
    if program not in servers:
        servers[program] = Starts(program)
        atexit.register(servers[program].close)
    return servers[program](*args, log=log)


def run(*command, log='out.txt', most=300):
    """Any command, at most so many seconds: the exit code."""
    with open(log, 'w') as out:
        return subprocess.run(['timeout', '-k', '5', str(most), *command], stdin=subprocess.DEVNULL, stdout=out, stderr=out).returncode


def says(words, log='out.txt'):
    """Whether a line of the log has a match of this pattern."""
    return any(re.search(words, line) for line in open(log, errors='replace'))


def write(path, text):
    with open(path, 'w', encoding='utf-8') as out:
        out.write(text)


def refused(program, text, words, what=''):
    """A fault unless --check refuses the text with these words."""
    write('faulty.cfg', text)
    code = start(program, 'faulty.cfg', '--check', log='faulty.log')
    if code != 2 or not says(words, 'faulty.log'):
        bad('%sexit code %d, wanted 2 and the words: %s' % (what, code, words), 'faulty.log')


def refused_by(program, case, old, new, words):
    """The same of the case (text) with the pattern `old' replaced."""
    refused(program, re.sub(old, new, case, flags=re.M), words, '%s -> %s: ' % (old, new))


def summary(folder, program=None):
    with open(os.path.join(folder, (program + '-' if program else '') + 'summary.json')) as f:
        return json.load(f)


def series(path):
    """Columns of a CSV file by title."""
    with open(path) as f:
        rows = list(csv.reader(f))
    return {title: [float(row[k] or 'nan') for row in rows[1:]] for k, title in enumerate(rows[0])}


def box_stl(path, low, high, without='', sense=1):
    """The triangles of a box, normals out of it; `without' names open faces (zp: upper z); sense -1: normals in."""
    write(path, stl.box(low, high, without, sense))


def check(well, what, log=None):
    """A fault unless it is well."""
    if not well:
        bad(what, log)


# A tank of water at rest, of which scripts change groups
TANK = '''format = 1;
time: { end = 0.4; };
fluid: { rho = 1000.0; gravity = (0, -9.81); };
domain: { max = (1, 1); };
walls: ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } );
shapes: ( { form = "below"; level = 0.5; } );
sph: { dx = 0.025; };
output: { snapshots = false; };
'''


def changed(case, **groups):
    """The case (text) with other contents of whole groups, which begin a line; a group that it lacks is added."""
    for group, contents in groups.items():
        ends = '()' if group in ('walls', 'shapes', 'bodies', 'probes') else '{}'
        line = '%s: %s %s %s;\n' % (group, ends[0], contents, ends[1])
        case, known = re.subn(r'^%s *:.*?(?=^\w+ *[:=]|\Z)' % group, lambda _: line, case, flags=re.M | re.S)
        case += '' if known else line
    return case


def sides(names, kind='slip'):
    """The elements of walls for these sides of the domain."""
    return ', '.join('{ side = "%s"; kind = "%s"; }' % (side, kind) for side in names.split())


def run_case(name, case=None, *args, program='sph', ranks=1, code=0, words=None):
    """Runs NAME.cfg, written first if there is a text, into the folder NAME. A fault unless it ends with this code and a line of what
    it says, in NAME.txt, has a match of the pattern."""
    if case:
        write(name + '.cfg', case)
    log, rest = name + '.txt', [name + '.cfg', '-o', name, *([] if '--restart' in args else ['--force']), *args]
    found = start(program, *rest, log=log) if ranks == 1 else run(*mpi, '-np', str(ranks), os.path.join(build, program), *rest, log=log)
    what = '%s on %d rank(s)' % (' '.join([name, *args]), ranks)
    check(found == code, '%s: exit code %d instead of %d' % (what, found, code), log)
    check(words is None or says(words, log), '%s: not told "%s"' % (what, words), log)


def mean(folder, title, after):
    """Of the lines later than `after' s."""
    values = [value for t, value in zip(column(folder, 't ['), column(folder, title)) if t > after]
    return sum(values) / len(values)


def column(path, title):
    """The values of the first column whose title begins so, of a CSV file or of the series of a run's folder; none: empty."""
    if os.path.isdir(path):
        path += '/series.csv'
    whole = series(path) if os.path.exists(path) else {}
    return next((whole[name] for name in whole if name.startswith(title)), [])


def last(path, title):
    return (column(path, title) or [math.nan])[-1]


def number(folder, key, program=None):
    """A number of a summary by its keys, force.x, or the first of that name in whatever group; none, or no file: nan."""
    def first(group, name, *inner):
        if name in group:
            return first(group[name], *inner) if inner else group[name]
        inside = (first(each, name, *inner) for each in group.values() if isinstance(each, dict))
        return next((found for found in inside if found is not None), None)

    try:
        found = first(summary(folder, program), *key.split('.'))
    except FileNotFoundError:
        found = None
    return found if isinstance(found, (int, float)) else math.nan


def varied(text, *changes):
    """The text with `old', `new', `old', `new' ... replaced in turn, each wherever it stands; what stands nowhere is an error."""
    for old, new in zip(changes[::2], changes[1::2]):
        assert old in text, 'no "%s" in the text to change' % old
        text = text.replace(old, new)
    return text


def near(what, value, wanted, most, log=None):
    """A fault if a value is farther than `most' from what is wanted, or no number."""
    if not abs(value - wanted) <= most:
        bad('%s: %.8g instead of %.8g (within %.3g)' % (what, value, wanted, most), log)


def close(what, value, wanted, share, log=None):
    """The same with a share of what is wanted."""
    near(what, value, wanted, share * abs(wanted), log)


def below(what, value, most, log=None):
    """A fault if a value is above `most', or no number."""
    if not value <= most:
        bad('%s: %.6g, wanted at most %.6g' % (what, value, most), log)


def scene(case, folder):
    """The file of a case: of a folder of cases/, of a text, which becomes FOLDER.cfg, or that file itself."""
    if '\n' in case:
        write(folder + '.cfg', case)
        return folder + '.cfg'
    return case if case.endswith('.cfg') else '%s/cases/%s/case.cfg' % (root, case)


def settings(keys):
    """The arguments that set "a.b=1 c.d=2"."""
    return [word for key in keys.split() for word in ('-p', key)]


def ended(folder, code, ends):
    """The exit code of a run into this folder; a fault if it is not one of `ends'."""
    if code not in ends:
        bad('%s ended with %d, wanted %s' % (folder, code, ' or '.join(map(str, ends))), folder + '.txt')
    return code


def alone(program, folder, case, keys='', *args, ends=(0,)):
    """A run of sph or fv on one rank of a case (as of `scene') with these keys into a folder; what it says is in FOLDER.txt."""
    return ended(folder, start(program, scene(case, folder), '-o', folder, *settings(keys), *args, log=folder + '.txt'), ends)


def job(folder, case, keys='', *args, ranks='1:1:1', boxes=('sph',), ends=(0,)):
    """The same of a coupled job on SPH:COUPLER:FV ranks; boxes are its groups of sph, a program each."""
    said = [scene(case, folder), '-o', folder, *settings(keys), *args]
    of_sph, of_coupler, of_fv = ranks.split(':')
    command = []
    for box in boxes:
        command += ['-np', of_sph, build + '/sph', *said, *(() if box == 'sph' else ('--as', box)), ':']
    command += ['-np', of_coupler, build + '/coupler', *said, ':', '-np', of_fv, build + '/fv', *said]
    return ended(folder, run(*mpi, *command, log=folder + '.txt'), ends)


def told(folder, words, log=None):
    """A fault unless FOLDER.txt, or another log, has a line with a match of this pattern."""
    if not says(words, log or folder + '.txt'):
        bad('%s: not told "%s"' % (folder, words), log or folder + '.txt')


def dataset(path, name):
    """The numbers of a data set of a file of HDF5, one after the other."""
    run('h5dump', '-d', '/' + name, '-y', '-w', '0', '-m', '%.9g', path, log='dataset.txt')
    return [float(x) for x in re.findall(r'[-+.\de]+', re.search(r'DATA {(.*?)}', open('dataset.txt').read(), re.S)[1])]


def same_bits(folder, other):
    """A fault unless the last snapshots of two coupled jobs hold the same values."""
    for program in 'sph', 'fv':
        pair = [max(glob.glob('%s/%s_[0-9]*.h5' % (where, program))) for where in (folder, other)]
        if not same_values(*pair):
            bad('%s of %s has other bits than that of %s' % (program, other, folder), 'diff.txt')


def restarted(folder, case, keys, **how):
    """The job that made a folder, restarted in a copy, FOLDER_again, from the point that it left on its way: a fault if it has other
    last snapshots, another number of rows in its series, or other worst values of what both programs differ by."""
    again = folder + '_again'
    shutil.copytree(folder, again)
    for program in 'sph', 'fv':  # those that are compared come from the restart
        os.remove(max(glob.glob('%s/%s_[0-9]*.h5' % (again, program))))
    job(again, case, keys, '--restart', **how)
    same_bits(folder, again)
    for path in glob.glob(folder + '/*series.csv'):
        if len(open(path).readlines()) != len(open(path.replace(folder, again, 1)).readlines()):
            bad('%s: another number of rows after a restart' % path)
    for program, keys in ('sph', 'overlap_velocity overlap_pressure level_gap'), ('fv', 'unmapped_cells water_missing volume_returned'):
        whole, part = (summary(at, program)['watch'] for at in (folder, again))
        for key in keys.split():
            if whole.get(key) != part.get(key):
                bad('%s: %s.watch.%s is %s after a restart, not %s' % (folder, program, key, part.get(key), whole[key]))


def mpirun(*programs, log='out.txt', most=60):
    """A job of programs, each its ranks, its file and its arguments: the exit code. Under the sanitizers, too, a program tells
    of its death itself."""
    os.environ.setdefault('ASAN_OPTIONS', 'detect_leaks=0:handle_segv=0')
    line = [word for program in programs for word in (':', '-np', *map(str, program))]
    return run(*mpi, *line[1:], log=log, most=most)


def judge(what, code, wanted, *words, log='out.txt'):
    """A fault unless the exit code is the wanted one, or one of them, and the log says all words; whether all is well."""
    missing = [pattern for pattern in words if not says(pattern, log)]
    ended = code in (wanted if hasattr(wanted, '__iter__') else [wanted])
    if not ended or missing:
        bad('%s: exit code %d%s%s' % (what, code, '' if ended else ', wanted %s' % (wanted if isinstance(wanted, int) else 'another'),
                                      ''.join('; not told: ' + pattern for pattern in missing)), log)
    return ended and not missing


def lines_of(pattern):
    """The lines of all files of such names, sorted."""
    return sorted(line.rstrip('\n') for path in glob.glob(pattern) for line in open(path, errors='replace'))


def until(holds, most=30):
    """Waits until it holds, at most so many seconds: whether it does."""
    end = time.monotonic() + most
    while not holds() and time.monotonic() < end:
        time.sleep(0.02)
    return holds()


def meanwhile(holds, act):
    """In a thread: as soon as it holds, acts."""
    thread = threading.Thread(target=lambda: until(holds) and act())
    thread.start()
    return thread


def same_values(one, other):
    """Whether two files of HDF5 hold the same, also as many particles; what differs is in diff.txt."""
    return run('h5diff', one, other, log='diff.txt') == 0 and not says('not comparable', 'diff.txt')


def held(name, defect=None):
    """No particle was lost or put back; the momentum defect of fluid, bodies and walls is below that, if one is given."""
    lost, returned = number(name, 'particles_lost'), number(name, 'particles_returned')
    check(lost == 0 and returned == 0, '%s: %g particles lost, %g put back' % (name, lost, returned))
    if defect:
        check(number(name, 'momentum.defect') < defect, '%s: momentum off by %g' % (name, number(name, 'momentum.defect')))
