"""Each program x signal x phase of a coupled job (kill_at.c): all programs end within 5 s, the others say who, where
and when, or the job stops in order; what was killed while it wrote restart files goes on, bit for bit.
SPDX-License-Identifier: BSD-3-Clause"""
import concurrent.futures
import glob
import itertools
import os
import re
import shutil
import sys
import time

import lib
from lib import bad, build as b, mpirun, same_values, says, until, write

PROGRAMS = 'sph', 'coupler', 'fv'
CASE = '''format = 1;
time:     { end = 0.24; };
fluid:    { rho = 1.0; nu = 0.005; };
domain:   { dim = 2; min = (0, 0); max = (1, 1); periodic = (true, true); };
initial:  { field = "taylor_green"; U = 1.0; L = 1.0; };
sph:      { dx = 0.04; R_dx = 2.0; free = ((0.36, 0.36), (0.64, 0.64)); };
fv:       { cells = (24, 24); };
coupling: { steps = 8; overlap = 0.05; };
output:   { every = 0.12; checkpoint = 0.04; };
'''


def job(folder, *more, victim=None, phase='none', signal=0):
    """Exit code, and when it ended in ms; what is said is in FOLDER.txt. The victim is hit by the signal in the phase."""
    hit = ['env', 'LD_PRELOAD=%s/tests/kill_at.so' % b, 'KILL_AT=' + phase, 'KILL_BY=%d' % signal]
    code = mpirun(*((1, *(hit if program == victim else []), '%s/%s' % (b, program), 'case.cfg', '-o', folder, *more)
                    for program in PROGRAMS), log=folder + '.txt')
    return code, 1e3 * time.time()


def faults_of(name, victim, phase, signal):
    """What is wrong about such a job."""
    code, end = job(name, victim=victim, phase=phase, signal=signal)
    with open(name + '.txt', errors='replace') as f:
        text = f.read()
    hit = re.search(r'kill_at: .*, ms (\d+)', text)
    if not hit:
        return ['the phase was not reached, exit %d' % code]
    late = end - float(hit[1])
    faults = ['the job ended %.0f ms after the signal' % late] if late > 5000 else []
    if signal != 9 and code == 5:  # stopped in order
        manifest = name + '/checkpoint.txt'
        if not re.search('asks for an orderly end|stopping in order', text):
            faults.append('stopped without a word')
        if not os.path.exists(manifest) or not os.path.getsize(manifest):
            faults.append('stopped without a restart point')
    elif code == 0 and (signal == 9 or phase != 'end'):
        faults.append('exit code 0')
    elif code != 0:  # who, where, when
        named = r'^%s rank 0: (?=.*%s rank 0).*(in coupling step \d|before the first coupling step|last heard)'
        faults += ['exit %d: %s says nothing of %s' % (code, program, victim) for program in PROGRAMS
                   if program != victim and not re.search(named % (program, victim), text, flags=re.M)]
    return faults


def trial(victim, phase, signal):
    """The launcher kills all within 1 s of the first end: whom a busy machine gives no processor time until then says nothing.
    A fault is what happens three times out of three."""
    name = '%s-%s-%d' % (victim, phase, signal)
    for _ in range(3):
        shutil.rmtree(name, ignore_errors=True)
        faults = faults_of(name, victim, phase, signal)
        if not faults:
            break
    return ['%s: %s' % (name, fault) for fault in faults]


def stands_here(link):
    try:
        return os.readlink(link) == os.getcwd()
    except OSError:
        return False


def left_over():
    """Other processes that stand in this folder."""
    return list(filter(stands_here, set(glob.glob('/proc/[0-9]*/cwd')) - {'/proc/%d/cwd' % os.getpid()}))


lib.scratch()
write('case.cfg', CASE)
if job('straight')[0] != 0:
    bad('the straight job', 'straight.txt')
    sys.exit(1)
if says('no restart point', 'straight.txt'):  # coupling steps 3 and 4 both save
    bad('the straight job has no restart point', 'straight.txt')
with concurrent.futures.ThreadPoolExecutor(3) as side_by_side:
    phases = 'handshake', 'exchange', 'wait', 'work', 'checkpoint', 'end'
    trials = [how for how in itertools.product(PROGRAMS, phases, (9, 15, 2)) if how[:2] != ('coupler', 'work')]
    trials.sort(key=lambda how: (phases.index(how[1]), how[2]))
    for fault in itertools.chain(*side_by_side.map(lambda how: trial(*how), trials)):
        bad(fault)
    killed = [victim + '-checkpoint-9' for victim in PROGRAMS]
    for name, (code, _) in zip(killed, side_by_side.map(lambda name: job(name, '--restart'), killed)):
        if code != 0:
            bad('%s: the restart ended with %d' % (name, code), name + '.txt')
for name, program in itertools.product(killed, ('sph', 'fv')):
    last, wanted = (max(glob.glob('%s/%s_[0-9]*.h5' % (folder, program)), default='none') for folder in (name, 'straight'))
    if not same_values(last, wanted):
        bad('%s: other bits of %s after the restart' % (name, program), 'diff.txt')
if not until(lambda: not left_over(), 5):
    bad('processes left over: %s' % left_over())
lib.end('%d trials, %d faults' % (len(trials), lib.failed))
