"""The Python package cases/estran on runs of seconds: what it reads against the runs' own figures and laws, what it draws; new cases,
sweeps and ensembles. SPDX-License-Identifier: BSD-3-Clause"""
import os
import subprocess
import sys

import lib
from lib import alone, bad, job, root, run, says, told

lib.scratch()
python = next((p for p in ('/usr/bin/python3', 'python3')
               if subprocess.run([p, '-c', 'import numpy, h5py, matplotlib'], stderr=subprocess.DEVNULL).returncode == 0), None)
if not python:
    bad('no python3 with h5py and matplotlib: make deps')
    sys.exit(1)


def does(command, *words, fails=False):
    """A command of cases/ ends well, or fails, and tells these words in said.txt."""
    script, *args = command.split()
    if (run(root + '/cases/' + script, *args, log='said.txt') != 0) != fails:
        bad('%s %s' % ('passes:' if fails else 'fails:', command), 'said.txt')
    for word in words:
        told(command, word, 'said.txt')


# What runs for long asks before: words that it does not know start nothing.
for command, word in [('report now', 'unrecognized'), ('stability now', 'no variant begins with now'), ('gallery now', 'no case now'),
                      ('tune --help', 'trials of a coupled job')]:
    does(command, word, fails=True)

alone('fv', 'tank', '''format = 1;
time:    { end = 0.1; };
fluid:   { gravity = (0, -9.81); };
domain:  { min = (-1, -0.1); max = (1, 1); };
shapes:  ( { form = "below"; level = 0.4; } );
blocks:  ( { name = "tank"; min = (-0.5, 0); max = (0.5, 0.8); cells = (20, 16);
             i_min = "slip"; i_max = "slip"; j_min = "slip"; j_max = "slip";
             motion = ( { kind = "polynomial"; axis = "x"; coefficients = (0, 0, 10.0); } ); } );
fv:      {};
''')
alone('sph', 'pool', '''format = 1;
time:    { end = 0.1; };
fluid:   { rho = 1000.0; gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (2, 1); };
initial: { field = "rest"; U = 1.0; };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { points = ((1.5, 0), (2, 0.4)); } );
shapes:  ( { form = "below"; level = 0.5; } );
bodies:  ( { name = "box"; points = ((0.5, 0.3), (0.8, 0.3), (0.8, 0.7), (0.5, 0.7)); } );
probes:  ( { name = "P"; at = (1.0, 0.1); } );
sph:     { dx = 0.05; };
output:  { every = 0.05; fields = "velocity pressure volume"; };
accept:  ( { what = "particles_lost"; tolerance = 0; } );
''')
alone('fv', 'cube', '''format = 1;
time:    { end = 0.01; };
fluid:   { rho = 1000.0; gravity = (0, 0, -9.81); };
domain:  { dim = 3; min = (0, 0, 0); max = (1, 1, 1); };
initial: { field = "rest"; U = 1.0; };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; }, { side = "z_min"; }, { side = "z_max"; } );
shapes:  ( { form = "below"; level = 0.53; } );
fv:      { cells = (12, 12, 12); };
blocked: ( { name = "block"; min = (0.25, 0.25, 0); max = (0.5, 0.5, 0.25); } );
''')
job('job', 'taylor_green', 'time.end=0.06')
if subprocess.run([python, root + '/tests/jobs/plots.py', root, 'pool', 'cube', 'job', 'tank']).returncode != 0:
    bad('plots.py')
does('plot pool depth', 'no snapshot with a field depth, only: pressure, velocity, volume', fails=True)
os.mkdir('empty')
does('plot empty', 'no run here', fails=True)

# a new case of each kind is sound as it stands
for of in ('sph --body fixed --gauges', 'sph --dim 3', 'sph --waves --body floating', 'fv --gauges --body fixed', 'fv --dim 3 --waves --body fixed',
           'coupled --gauges', 'coupled --waves --body floating', 'coupled --dim 3 --body floating'):
    does('new my/new --force -s ' + of)
    does('run my/new.cfg --check -o new')
does('new my/new -s fv', fails=True)  # not over a file that is there

# a sweep: the error of a parabola between plates falls with the cells; an ensemble of a case without chance scatters little
does('sweep channel_fv --together fv.cells=(8,8),(16,8) fv.cfl=0.8,0.7 -p time.end=0.1 -o sweep', r'cells=\(16,8\)  fv.cfl=0.7 .* order ')
does('sweep channel_fv --together fv.cells=(8,8),(16,8) fv.cfl=0.8 -o sweep', fails=True)  # unlike lists
if len(open('sweep/sweep.csv').readlines()) != 3 or os.path.getsize('sweep/sweep.png') == 0:
    bad('files of cases/sweep')
does('ensemble channel_fv -n 2 -p fv.cells=(8,8) -p fv.cfl=0.5 -p time.end=0.1 -o ensemble')
told('a given Courant number is each member\'s own', 'cfl = 0.4[89]', 'ensemble/1/fv-case.cfg')
does('ensemble channel_fv -n 1', 'one run has no scatter', fails=True)
does('ensemble channel_fv -p fv.cfl', 'expected key=value', fails=True)
told('ensemble', '^cpu_s,', 'ensemble/ensemble.csv')
# an error that falls as a key that is no size of cells rises goes with a negative power of it
does('sweep channel_fv time.end=0.1,0.2 -p fv.cells=(8,8) -o later', 'order -')
# where nothing is known to be right, the gauges of the last run are what the others are compared with; what is there is
# not run again, unless other settings are asked for
does('new my/gauges -s fv --gauges')
sweep = 'sweep my/gauges.cfg fv.cells=(8,4),(16,8),(32,16) -o swept -p time.end='
does(sweep + '0.1', r'cells=\(16,8\)  .* order ')
if says('drift', 'said.txt'):
    bad('a sweep of gauges', 'said.txt')
does(sweep + '0.1')
if says('run again', 'said.txt'):
    bad('runs of a sweep that are there are run again', 'said.txt')
does(sweep + '0.05')
if open('said.txt').read().count('run again') != 3:
    bad('a sweep to another end', 'said.txt')
# other programs than those that made what is there: the same but for a byte at their end
os.mkdir('other')
for program in 'sph', 'coupler':
    os.symlink(lib.build + '/' + program, 'other/' + program)
with open(lib.build + '/fv', 'rb') as f, open('other/fv', 'wb') as to:
    to.write(f.read() + b'\n')
os.chmod('other/fv', 0o755)
os.environ['ESTRAN_BUILD'] = os.path.abspath('other')
does(sweep + '0.05', 'other programs than of the run that is there')
os.environ['ESTRAN_BUILD'] = lib.build
# what a case includes, and the files that it names, belong to it
lib.write('my/whole.cfg', 'format = 1;\n@include "rest.inc"\n')
for k, nu in enumerate((0.1, 0.1, 0.2)):
    lib.write('my/rest.inc', '''time: { end = 0.02; };
fluid: { nu = %g; gravity = (0.8, 0); };
domain: { max = (1, 1); periodic = (true, false); };
walls: ( { side = "y_min"; kind = "no_slip"; }, { side = "y_max"; kind = "no_slip"; } );
fv: { cells = (8, 8); };
output: { snapshots = false; };
''' % nu)
    does('sweep my/whole.cfg fv.cfl=0.8 -o whole')
    if says('run again', 'said.txt') != (k == 2):
        bad('a sweep of a case in two files, viscosity %g' % nu, 'said.txt')
lib.end('%d faults' % lib.failed)
