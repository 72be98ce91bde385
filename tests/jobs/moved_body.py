"""A program of its own moves a body of sph (motion of kind partner): coupler/examples/spring.c, a cylinder on a spring in a round tank
of water. Its period is that of its mass and of the water's that theory adds, heavy or lighter than that water; beside fv it goes as
the free body on the same spring that sph has itself. An elastic plate (coupler/examples/plate.c) bends under water at rest as theory
says and swings with its wet period. What cannot be is refused, and a program that never starts MPI ends the job.
SPDX-License-Identifier: BSD-3-Clause"""
import re
from math import cos, cosh, pi, sin, sinh, sqrt, tanh
import subprocess
import time

import lib
from lib import bad, below, build, close, column, job, last, refused_by, root, run, settings, start, told

lib.scratch()
launcher, tank = root + '/cases/run', root + '/coupler/examples/spring.cfg'


def command(folder, case, of, keys, ranks='1'):
    """A job with the spring, `of' the body's name, mass, stiffness, stretch and a mass that it adds to its own in the iteration."""
    return [launcher, case, '-n', ranks, '-o', folder, '--force', *settings(keys),
            '--with', '%s/examples/spring %s %s' % (build, folder, of)]


def spring(folder, case, of, keys='', ranks='1', ends=(0,)):
    lib.ended(folder, run(*command(folder, case, of, keys, ranks), log=folder + '.txt'), ends)


def places(log):
    """Times and places of lines "t, x, v, force"."""
    return [tuple(map(float, m.groups())) for m in re.finditer(r'^([\d.e-]+), ([\d.e-]+), [^,]+, [^,]+$', open(log).read(), re.M)]


def crossings(log, middle):
    """Times at which the body passes the middle."""
    rows = places(log)
    return [s + (t - s) * (x - middle) / (x - y) for (s, x), (t, y) in zip(rows, rows[1:]) if (x - middle) * (y - middle) < 0]


def period(log, middle):
    """Twice the mean time between crossings of the middle."""
    at = crossings(log, middle)
    return 2 * (at[-1] - at[0]) / (len(at) - 1) if len(at) > 1 else float('nan')


# whoever reads what a job of a moment says does not wait for what watches it
began = time.time()
subprocess.run(command('brief', tank, 'cylinder 200 14745 0.02 173', 'time.end=0.02'), stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
               timeout=300)
below('a job of a moment with another program: s', time.time() - began, 30)
# pi a^2 rho (b^2 + a^2)/(b^2 - a^2) = 173.5 kg/m: with 200 kg and 14 745 N/m a period of 1 s, with 50 kg 8823 N/m. Sound
# crosses the tank in a tenth of it, so that a second order of that, 1 %, is left, and one for 8 particles in a radius
for of in ('200 14745', '50 8823')[:2 if lib.long else 1]:
    folder = 'swing' + of.split()[0]
    spring(folder, tank, 'cylinder %s 0.02 173' % of, 'time.end=0.9 output.every=0.3')
    close(folder + ': period, with the added mass of theory', period(folder + '.txt', 0.02), 1, 0.02)
    print('%s: period %.5g s' % (folder, period(folder + '.txt', 0.02)))
# on two ranks of sph the same
spring('ranks', tank, 'cylinder 200 14745 0.02 173', 'time.end=0.3', '2')
t, x = (column('swing200/sph-series.csv', title) for title in ('t', 'cylinder x'))
close('two ranks: motion', last('ranks/sph-series.csv', 'cylinder x'), next(x for t, x in zip(t, x) if t > 0.3 - 1e-9), 1e-6)
# 3D: a ball of 0.1 m in a cube of 0.6 m, which holds as much as a ball of b = 0.372 m: 4 kg and (b^3 + 2 a^3)/(b^3 - a^3)/2 of
# the water that it displaces on 240.6 N/m, a quarter of whose period after the start it is in the middle; the first step has no force yet
ball = lib.scene('''format = 1;
time:    { end = 0.3; };
fluid:   { rho = 1000.0; nu = 1.0e-6; };
domain:  { dim = 3; min = (-0.3, -0.3, -0.3); max = (0.3, 0.3, 0.3); };
initial: { field = "rest"; U = 0.2; };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; }, { side = "z_min"; }, { side = "z_max"; } );
bodies:  ( { name = "ball"; radius = 0.1; centre = (0, 0, 0); motion = ( { kind = "partner"; } ); } );
sph:     { dx = 0.03; R_dx = 2.5; c0 = 4.0; };
output:  { snapshots = false; };
''', 'ball')
spring('ball', ball, 'ball 4 240.6 0.02 2.4 3')
close('ball: a quarter of its period', (crossings('ball.txt', 0.02) or [0])[0], 0.25 * 1.0101, 0.03)
# beside fv; the free body of sph has the same mass, and a line that pulls to the same place with the same stiffness
beside = '''format = 1;
time:    { end = 0.5; };
fluid:   { rho = 1000.0; nu = 0.001; };
domain:  { dim = 2; min = (-1, -1); max = (1, 1); };
initial: { field = "rest"; U = 0.2; };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
bodies:  ( { name = "box"; points = ((-0.1, -0.1), (-0.1, 0.1), (0.1, 0.1), (0.1, -0.1)); motion = ( { kind = "partner"; } ); } );
sph:     { dx = 0.025; c0 = 10.0; box = ((-0.7, -0.7), (0.7, 0.7)); };
fv:      { cells = (32, 32); };
output:  { every = 0.25; series = 5; snapshots = false; };
'''
case, of = lib.scene(beside, 'moved'), 'box 80 6000 0.02 60'
spring('beside', case, of, 'coupling.memory=9', '1:1:1', (0, 1))
job('free', re.sub('motion = .*', '''free = true; mass = 80; inertia = 1; lock = "y rz";
             lines = ( { from = (0, 0); to = (0.92, 0); stiffness = 6000; length = 0.9; } ); } );''', beside), ends=(0, 1))
close('moved by a partner, or free: place', *(last(folder + '/sph-series.csv', 'box x') for folder in ('beside', 'free')), 0.02)
# coupling steps that another program shortens want more smoothing: told, with what it takes
spring('short', case, of, 'time.end=0.05', '1:1:1', (0, 1))
told('short', 'another program wishes coupling steps of .*coupling.memory = ')


# --- an elastic plate ---

plate_case, outline = (root + '/coupler/examples/plate.' + end for end in ('cfg', 'csv'))


def plate(folder, of, keys='', ranks='1', how='--force'):
    """Deflection of the top over time beside water of depth 1 m in a tank of 1 m; `of': stiffness, mass, resistance, damping."""
    lib.ended(folder, run(launcher, plate_case, '-n', ranks, '-o', folder, how, *settings(keys), '--with',
                          '%s/examples/plate %s plate %s %s' % (build, folder, outline, of), log=folder + '.txt'), (0,))
    return places(folder + '.txt')


def top(D, l, H, L, load=9810.0):
    """Of a cantilever of length l > H under the water's load: that of the depth H after the level has fallen by what the plate gives way."""
    H -= load * H ** 5 / (72 * D * L)
    return load * H ** 5 / (30 * D) + (l - H) * load * H ** 4 / (24 * D)


def wet_period(D, m, l, H, L, rho, n=400):
    """Of the first mode in air, of m kg/m^2 and the water's mass (potential flow to a wall at L, no pressure at the surface)."""
    b = 1.8751040687 / l
    s = (cosh(b * l) + cos(b * l)) / (sinh(b * l) + sin(b * l))

    def shape(z):
        return cosh(b * z) - cos(b * z) - s * (sinh(b * z) - sin(b * z))

    def integral(f, to):
        return sum(f((i + 0.5) * to / n) for i in range(n)) * to / n
    dry = integral(lambda z: shape(z) ** 2, l)
    water = sum(2 * rho / H * integral(lambda z, k=k: shape(z) * cos(k * z), H) ** 2 / (k * tanh(k * L))
                for k in ((j + 0.5) * pi / H for j in range(40)))
    return 2 * pi * sqrt((m * dry + water) / (D * b ** 4 * dry))


rows = plate('bent', '65400 200 2e5 60', 'time.end=0.6')
late = [w for t, w in rows if t > 0.4]
close('plate: static deflection of its top', -sum(late) / len(late), top(65400, 1.2, 1, 1), 0.03)
print('plate: static %.5g m of %.5g m' % (-sum(late) / len(late), top(65400, 1.2, 1, 1)))
# released from rest: light enough that without resistance the loop would end (mass 200), 0 for a heavy one
for of, mass in (('65400 200 2e5', 200), ('65400 400 0', 400))[:2 if lib.long else 1]:
    folder = 'swing_of_%d' % mass
    plate(folder, of, 'time.end=0.5')
    was, wanted = period(folder + '.txt', -top(65400, 1.2, 1, 1)), wet_period(65400, mass, 1.2, 1, 1, 1000)
    close(folder + ': period, wet', was, wanted, 0.05)
    print('%s: period %.5g s of %.5g s' % (folder, was, wanted))
# loads do not depend on the ranks, and a restart goes on as if nothing had been
keys = 'time.end=0.05 output.checkpoint=0.03'
a, b = plate('plate1', '65400 200 2e5', keys), plate('plate2', '65400 200 2e5', 'time.end=0.05', '2')
close('plate on two ranks: deflection', b[-1][1], a[-1][1], 1e-6)
unbroken = open('plate1/sph-series.csv').read()
again = plate('plate1', '65400 200 2e5 0 restart', keys, how='--restart')
if not 1 < len(again) < len(a) or again != a[-len(again):] or open('plate1/sph-series.csv').read() != unbroken:
    bad('plate: a restart does not go on as the unbroken run')
refused_by('sph', beside, 'kind = "partner"', 'kind = "bending"; }, { kind = "harmonic"; amplitude = 0.1; period = 1.0',
           'a partner that bends a body moves all of its outline')

# refused
if start('sph', tank, '-o', 'alone', '--force', log='alone.txt') == 0:
    bad('a body that a partner moves runs without one')
told('alone', r'bodies.\[0\].motion: a partner is to move body .cylinder., but no other program')
refused_by('sph', beside, 'motion = ', 'free = true; mass = 80; inertia = 1; motion = ', 'a partner moves all of a body, forces move this')
spring('other', tank, 'cylnder 200 14745 0.02 173', ends=(2,))
told('other', 'field cylinder.motion: sph takes it, but nobody gives it')
code = run(launcher, tank, '-n', '1', '-o', 'never', '--deadline', '3', '--with', 'true', log='never.txt', most=60)
if not 0 < code < 124:
    bad('a program without MPI: exit code %d' % code, 'never.txt')
told('never', 'has not called MPI_Init within 3 s')
lib.end('%d faults' % lib.failed)
