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
        lines = f.read().splitlines()
    hit = [float(found[1]) for found in (re.search(r'kill_at: .*, ms (\d+)', line) for line in lines) if found]
    if not hit:
        return ['the phase was not reached, exit %d' % code]
    faults = ['the job ended %.0f ms after the signal' % (end - hit[0])] if end - hit[0] > 5000 else []
    if phase == 'end' and signal != 9 and code == 0:  # it was over
        return faults
    if signal != 9 and code == 5:
        if not says('asks for an orderly end|stopping in order', name + '.txt'):
            faults.append('stopped without a word')
        if not os.path.exists(name + '/checkpoint.txt') or not os.path.getsize(name + '/checkpoint.txt'):
            faults.append('stopped without a restart point')
        return faults
    if code == 0:
        faults.append('exit code 0')
    for program in PROGRAMS:  # who, where, when
        said = [line for line in lines if line.startswith(program + ' rank 0: ')]
        if program != victim and not any(victim + ' rank 0' in line and re.search(
                'in coupling step [0-9]|before the first coupling step|last heard', line) for line in said):
            faults.append('exit %d: %s says nothing of %s: %s' % (code, program, victim, said))
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


def left_over():
    """Processes that stand in this folder."""
    found = []
    for link in glob.glob('/proc/[0-9]*/cwd'):
        try:
            found += [link] if os.readlink(link) == os.getcwd() and link != '/proc/%d/cwd' % os.getpid() else []
        except OSError:
            pass
    return found


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
