"""Regular waves on a current of +0.3 and -0.2 m/s between two zones of kind wave in sph, alone and as a box inside fv: first harmonic,
wave length, mean velocity, discharge and level against theory; a restart goes on bit for bit; what cannot be is refused.
LONG=1: finer, and against the current, too. SPDX-License-Identifier: BSD-3-Clause"""
import lib
from currents import DEPTH, HARMONIC, Waves, below_troughs, gauges
from lib import bad, column, last, near, refused, run, run_case, start, summary, varied, write

lib.scratch()


def scene(U, end, domain, zone, at, probes, programs):
    return '''format = 1; time: { end = %g; }; output: { snapshots = false; series = 5; checkpoint = 0.2; };
fluid: { gravity = (0, -9.81); }; domain: { dim = 2; max = (%s); };
initial: { field = "uniform"; velocity = (%g, 0); };
shapes: ( { form = "below"; level = 0.16; } );
walls: ( { side = "x_min"; kind = "wave"; }, { side = "x_max"; kind = "wave"; }, { side = "y_min"; }, { side = "y_max"; } );
waves: { height = 0.03; length = 1.0; zone = %g; current = %g; };
probes: ( %s{ name = "low"; kind = "velocity"; at = (%g, 0.03); } );
%s
''' % (end, domain, U, zone, U, probes, at, programs)


# 50 particles a length, 8 over the depth, 1.5 a wave height; LONG 80, 12.8 and 2.4. Wanted of these: amplitude 5 %, length, with the
# period given that is the phase speed, 1 %, mean current (discharge over depth) 1 %; of the coarser ones, of second order, 2.5 % (1.4 and
# 1.2 measured). Of the level 0.2 % of the amplitude is wanted, of the velocity at a point 1 %, and missed (sph/README.md): 10 % and 5 % are asked for.
section = ', { name = "all"; kind = "discharge"; at = (1.7, 0); to = (1.7, 0.25); }, '
runs = [('with', 0.3, 3.95, 0.7159, 2, 0.02, 0.025)]
if lib.long:
    runs += [('with_fine', 0.3, 3.95, 0.7159, 2, 0.0125, 0.01), ('against_fine', -0.2, 14, 1.1149, 3, 0.0125, 0.01)]
for case, U, end, T, periods, dx, off in runs:
    text = scene(U, end, '3.4, 0.24' if dx == 0.02 else '3.4, 0.25', 1, 1.7, gauges(1.1, 0.16) + section, 'sph: { dx = %g; };' % dx)
    low = below_troughs('sph', case, text, 'on a current of %g m/s: period' % U,
                        'behind the zones before open sides: the waves on their current')
    run_case(case, text)
    Waves(case + '/series.csv', T, periods).judge(case, harmonic=(HARMONIC, 0.05 * HARMONIC), length=(1, off), low=(low, abs(0.05 * low)),
                                                  through=(U * DEPTH, abs(off * U * DEPTH)), level=(DEPTH, 0.0015), water=(544, 5.44))
    near(case + ': particles lost', summary(case)['particles_lost'], 0, 0)
# whole rows start 6 % below the level that the zones know: the water rises to it, 160 kg for each metre, and its own weight's 1.1 kg
if lib.long:
    run_case('rises', varied(scene(0.3, 8, '2.2, 0.25', 0.7, 1.1, '', 'sph: { dx = 0.025; };'), 'height = 0.03', 'height = 0.01'))
    # particles come in by layers of 4 kg: the mean of the last second
    risen = [m for t, m in zip(column('rises/series.csv', 't'), column('rises/series.csv', 'mass [')) if t >= 7]
    near('kg that the water has risen to from 330', sum(risen) / len(risen), 353.1, 3.531, 'rises.txt')
# in 3D with a period across, water at its level: the columns beside the period see it over the period (without, 2.6 mm too little)
run_case('across', '''format = 1; time: { end = 0.02; }; output: { snapshots = false; series = 1; };
fluid: { gravity = (0, 0, -9.81); }; domain: { dim = 3; max = (1.6, 0.48, 0.24); periodic = (false, true, false); };
initial: { field = "uniform"; velocity = (0.3, 0, 0); };
shapes: ( { form = "below"; level = 0.16; } );
walls: ( { side = "x_min"; kind = "wave"; }, { side = "x_max"; kind = "beach"; }, { side = "z_min"; } );
waves: { height = 0.001; length = 1.0; zone = 0.5; current = 0.3; depth = 0.16; };
sph: { dx = 0.04; };
''')
near('level of sph over that behind the side, m', last('across/series.csv', 'level gap ['), 0, 2e-4)
# a restart, two ranks; coarse
coarse = scene(0.3, 0.4, '3, 0.25', 1, 1.7, '', 'sph: { dx = 0.025; };')
run_case('whole', coarse)
run_case('part', coarse, '-p', 'time.end=0.2')
if start('sph', 'part.cfg', '-o', 'part', '--restart', log='part.txt') != 0:
    bad('restart on a current', 'part.txt')
if open('whole/series.csv').readlines()[-1] != open('part/series.csv').readlines()[-1]:
    bad('after a restart the waves on a current are others')
if run(*lib.mpi, '-n', '2', lib.build + '/sph', 'whole.cfg', '-o', 'two', log='two.txt') != 0:
    bad('two ranks on a current', 'two.txt')
energy = last('whole/series.csv', 'kinetic energy')
near('kinetic energy on two ranks, J', last('two/series.csv', 'kinetic energy'), energy, 1e-6 * energy)
# a box of particles inside fv, which has the waves and the current through its sides
box = varied(scene(0.3, 4.3, '4.5, 0.24', 1.2, 2, gauges(1.4, 0.16) + ', ',
                   '''sph: { dx = 0.02; scheme = "riemann_ale"; box = ((1.6, 0), (2.88, 0.24)); };
fv: { cells = (90, 15); };'''), ' checkpoint = 0.2;', '')
write('box.cfg', box)
if run(lib.root + '/cases/run', 'box.cfg', '-n', '1:1:1', '-o', 'box', log='box.txt') != 0:
    bad('a box of particles in waves on a current', 'box.txt')
Waves('box/sph-series.csv', 0.7159, 2).judge('box', harmonic=(HARMONIC, 0.05 * HARMONIC), length=(1, 0.02),
                                             low=(0.2938, 0.03 * 0.2938))  # of length and velocity 1 % wanted, 0.5 and 0.9 % measured; 1.1 and 2 % with finer ones
refused('sph', varied(coarse, 'side = "x_max"; kind = "wave"', 'side = "x_max"'),
        'waves.current: the water comes in at one end .* give x_max the kind')
write('faulty.cfg', varied(box, 'box = ((1.6, 0)', 'box = ((0, 0)'))
if run(lib.root + '/cases/run', 'faulty.cfg', '--check', log='faulty.txt') == 0 or not lib.says(
        'sph.box: it reaches the x side at 0 m, an inlet or outlet', 'faulty.txt'):
    bad('a box that reaches an inlet', 'faulty.txt')
lib.end('%d faults' % lib.failed)
