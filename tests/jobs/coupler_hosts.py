"""A job over two hosts: two network namespaces of this machine, joined by a cable, with host names of their own, so that no
process sees those of the other host. The same bits as on one host, a coupling step's latency, a killed program, a killed host
and a cut cable, each named. Skipped where namespaces are not allowed. SPDX-License-Identifier: BSD-3-Clause"""
import atexit
import os
import shutil
import signal
import sys
import time

import lib
from lib import bad, build as b, judge, lines_of, meanwhile, root, run, says, write


def ip(words):
    """Whether it worked."""
    return run('ip', *words.split(), log='ip.txt') == 0


def skip(why):
    print('skipped: ' + why)
    sys.exit(0)


def processes(host):
    run('ip', 'netns', 'pids', host, log='pids')
    return [pid for pid in open('pids').read().split() if pid.isdigit()]


def kill(pids):
    run('sh', '-c', 'kill -KILL "$@"', 'sh', *pids, log='killed.txt')


def clean():
    for host in EAST, WEST:
        kill(processes(host))
        ip('netns delete ' + host)


lib.scratch()
EAST, WEST = ('estran%d%s' % (os.getpid(), side) for side in 'ew')
if os.getuid() != 0:
    skip('two hosts want root (namespaces of the network)')
if not shutil.which('ip'):
    skip('two hosts want the program ip (apt-get install iproute2)')
atexit.register(clean)
for number in signal.SIGTERM, signal.SIGINT:
    signal.signal(number, lambda *_: sys.exit(1))
for words in ('netns add ' + EAST, 'netns add ' + WEST, 'link add name e netns %s type veth peer name w netns %s' % (EAST, WEST),
              '-n %s addr add 10.97.1.1/24 dev e' % EAST, '-n %s addr add 10.97.1.2/24 dev w' % WEST, '-n %s link set lo up' % EAST,
              '-n %s link set lo up' % WEST, '-n %s link set e up' % EAST, '-n %s link set w up' % WEST):
    if not ip(words) or run('unshare', '--uts', 'true') != 0:
        skip('no namespaces here: ' + open('ip.txt').read())

for key in 'OMPI_MCA_pml', 'OMPI_MCA_ess_singleton_isolated':  # cases/run reaches hosts as it does for users
    os.environ.pop(key, None)
# what mpirun takes for ssh: enters the other host
write('agent', '#!/bin/sh\nshift\nexec ip netns exec %s unshare --uts sh -c "hostname west; $*"\n' % WEST)
os.chmod('agent', 0o755)
TO_EAST = ['ip', 'netns', 'exec', EAST, 'unshare', '--uts', 'sh', '-c', 'hostname east; exec "$@"', 'sh']
REACHED = {'plm_rsh_agent': os.path.abspath('agent'), 'plm_rsh_no_tree_spawn': '1', 'btl_tcp_if_include': '10.97.1.0/24',
           'oob_tcp_if_include': '10.97.1.0/24'}
# the options of cases/run --hosts
KEEPALIVE = {'oob_tcp_keepalive_time': '2', 'oob_tcp_keepalive_intvl': '1', 'oob_tcp_keepalive_probes': '2'}
MOCK, here = b + '/tests/mock', lib.mpi
there = TO_EAST + [word for word in here if word != '--oversubscribe'] + [
    word for key, value in {'pml': 'ob1', **REACHED, **KEEPALIVE}.items() for word in ('--mca', key, value)]
write('case.cfg', 'format = 1;\ntime:   { end = 0.5; };\ncoupler: { programs = "sph fv"; period = (1.0, 1.0); };\n')
ON_E, ON_W = ['-H', '10.97.1.1:8'], ['-H', '10.97.1.2:8']
SPLIT, BOTH = (ON_E, ON_E, ON_W), (['-H', '10.97.1.1:8,10.97.1.2:8', '--map-by', 'node'],) * 3  # hosts of sph, coupler, fv
happened = 0  # s, of time.monotonic


def happens(act):
    global happened
    happened = time.monotonic()
    act()


def job(what, where, *keys, faults=(), ranks=2, wanted=0, words=(), act=None):
    """Into the folder o; act: what happens after coupling step 2, while the job sleeps for 3 s in step 3 or waits."""
    shutil.rmtree('o', ignore_errors=True)
    lib.mpi = there if where else here
    on = where or ([], [], [])
    thread = act and meanwhile(lambda: os.path.exists('o/sph.0') and says('^2 ', 'o/sph.0'), lambda: happens(act))
    code = lib.mpirun((ranks, *on[0], MOCK, 'sph', 'points', 'o', *keys, *faults), (ranks, *on[1], b + '/coupler', 'case.cfg', '-o', 'o'),
                      (ranks, *on[2], MOCK, 'fv', 'grid', 'o', *keys))
    judge(what, code, wanted, *words)
    if act:  # long before the job's 60 s are over; 2 to 6 s on a quiet machine
        since = time.monotonic() - happened
        thread.join()
        print('%s: exit code %d after %.1f s' % (what, code, since))
        if since > 30:
            bad('%s: the job ended after %.1f s, wanted at most 30' % (what, since), 'out.txt')


def real(what, folder, *options, wanted=0, words=()):
    """A small coupled job by cases/run; fv alone on the other host."""
    os.environ.update({'OMPI_MCA_' + key: value for key, value in REACHED.items()}, ESTRAN_BUILD=b)
    code = run(*TO_EAST, root + '/cases/run', 'taylor_green', '-o', folder, '--force', '-n', '1:1:1', '-p', 'sph.dx=0.02', '-p',
               'fv.cells=(24,24)', '-p', 'output.snapshots=false', *options, most=60)
    for key in REACHED:
        del os.environ['OMPI_MCA_' + key]
    judge(what, code, wanted, *words)


def cut():
    ip('-n %s link set e down' % EAST)


def mend():
    kill(processes(WEST))
    ip('-n %s link set e up' % EAST)


def bits():
    return lines_of('o/sph.*'), lines_of('o/fv.*')


job('on one host', None, 'n=24')
plain = bits()
for what, where in ('split', SPLIT), ('both', BOTH):
    job('on two hosts, ' + what, where, 'n=24')
    if bits() != plain or not all(plain):
        bad('on two hosts (%s): other bits than on one' % what)

# 500 steps of four hops over the cable
job('500 coupling steps', SPLIT, 'n=8', 'dt=0.001', ranks=1)
us = 1e6 * lib.summary('o')['wall_s'] / lib.summary('o')['windows']
print('a coupling step between two hosts: %.0f us' % us)
if lib.summary('o')['windows'] != 500 or us > 50000:
    bad('a coupling step between two hosts takes %.0f us, wanted at most 50 000 (1 000 on a quiet machine)' % us)

# sph and fv by cases/run --hosts: the same to the last digit, and its exit codes
short, hosts = ('-p', 'time.end=0.12', '-p', 'output.every=0'), ('--hosts', '10.97.1.1:2,10.97.1.2:1')
real('sph and fv on one host', 'r1', *short)
real('sph and fv on two hosts', 'r2', *short, *hosts)
if lib.summary('r1')['error'] != lib.summary('r2')['error']:
    bad('sph and fv on two hosts: errors %s, on one %s' % (lib.summary('r2')['error'], lib.summary('r1')['error']))
os.remove('out.txt')
thread = meanwhile(lambda: os.path.exists('out.txt') and says(' %  left'), cut)
real('sph and fv, the cable cut', 'r3', '-p', 'time.end=9', *hosts, wanted=4, words=[
    '^sph rank 0: .*fv on west', '^coupler rank 0: .*fv on west', '^cases/run: a host of the job, or the link to it, was lost'])
thread.join()
mend()

# a program killed on the other host: its own neighbour there leaves the note; all processes of the other host, its launcher's too
faults, failed = ('fault=sleep', 'at=3'), range(1, 256)
job('fv killed on the other host', SPLIT, 'n=40', faults=faults, wanted=failed, words=['^sph rank [01]: .*fv', '^coupler rank [01]: .*fv'],
    act=lambda: kill([pid for pid in processes(WEST) if os.path.realpath('/proc/%s/exe' % pid) == os.path.realpath(MOCK)][:1]))
words = ['^sph rank [01]: .*fv on west', '^coupler rank [01]: .*fv on west']
job('a host killed', SPLIT, 'n=40', faults=faults, wanted=failed, words=words, act=lambda: kill(processes(WEST)))


def cut_quietly():
    """While the line is quiet: what is sent and not yet acknowledged would keep the link alive for net.ipv4.tcp_retries2
    trials of the kernel (coupler/README.md)."""
    time.sleep(0.5)
    happens(cut)


job('the cable cut', SPLIT, 'n=40', faults=faults, wanted=failed, words=words, act=cut_quietly)
mend()
lib.end('%d faults' % lib.failed)
