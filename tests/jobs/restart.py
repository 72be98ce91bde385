"""A restart file is read by any number of ranks: a run that was written on some and went on on others ends where the
straight run does, but for rounding and its growth. SPDX-License-Identifier: BSD-3-Clause"""
import glob
import math
import os
import re
import shutil
import subprocess

import lib
from lib import bad, box_stl, build as b, judge, mpirun, root, run, start, write

DONE = 0, 1  # done, not accepted, as short runs of coarse cases are
OTHERS = '1 3' if lib.long else '3'  # what dam and sloshing go on on, too: fewer ranks than they were written on, and more


def go(case, ranks, folder, *more):
    """A run of one program ("sph 2") or of both ("both 2:1:1"): its exit code."""
    program, n = ranks.split()
    if program == 'both':
        return run(root + '/cases/run', case, '-n', n, '-o', folder, *more, most=120)
    if n == '1':
        return start(program, case, '-o', folder, *more)
    return mpirun((n, b + '/' + program, case, '-o', folder, *more), most=120)


def last(path, column):
    """The last value of the last column whose title begins so."""
    return [values[-1] for title, values in lib.series(path).items() if title.startswith(column)][-1]


def halfway(straight, folder, t):
    """A run that has just written its first restart file, that of the time t, and no more."""
    shutil.copytree(straight, folder)
    first, second = sorted({re.findall(r'\d+', file)[-2] for file in glob.glob(folder + '/*-checkpoint-*.h5')}, key=int)
    for file in glob.glob('%s/*-checkpoint-%s.h5' % (folder, second)):
        os.remove(file)
    manifest = open(folder + '/checkpoint.txt').read()
    write(folder + '/checkpoint.txt', re.sub(r'(?<=-)%s(?=\.h5)|(?<=window )%s$' % (second, second), first, manifest, flags=re.M))
    for path in glob.glob(folder + '/*series.csv'):
        lines = open(path).read().splitlines(keepends=True)
        write(path, ''.join(line for line in lines if not line[0].isdigit() or float(line.split(',')[0]) < t * (1 + 1e-9)))


def family(name, case, writers, readers, end, tolerance=1e-9, column='kinetic', changes=()):
    """A straight run on the writers, and from its half on on each of the readers, where `column' ends at the same value."""
    program = writers.split()[0]
    options = [word for change in ('time.end=%g' % end, 'output.checkpoint=%g' % (end / 2), 'output.every=%g' % (end / 2),
                                   'output.snapshots=false', *changes) for word in ('-p', change)]
    if not judge(name, go(case, writers, name, *options), DONE):
        return
    series = '/series.csv' if os.path.exists(name + '/series.csv') else '/fv-series.csv'
    halfway(name, name + '-half', end / 2)
    wanted = last(name + series, column)
    for n in readers.split():
        what, folder = '%s, %s to %s' % (name, writers, n), '%s-%s' % (name, n)
        shutil.copytree(name + '-half', folder)
        if judge(what, go(case, program + ' ' + n, folder, *options, '--restart'), DONE):
            value = last(folder + series, column)
            off = abs(value - wanted) / wanted if wanted > 0 else math.inf
            print('%s: %.1e relative, wanted %g' % (what, off, tolerance))
            if not off <= tolerance:
                bad('%s: %s is %.12g, in the straight run %.12g' % (what, column, value, wanted))


lib.scratch()
HEAD = '''format = 1;
time:    { end = 1; };
fluid:   { rho = 1000.0; gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (%s); };
'''
DAM = HEAD % '1.2, 0.8' + '''initial: { field = "rest"; U = 1.7; };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } );
shapes:  ( { form = "box"; box = ((0, 0), (0.6, 0.3)); } );
'''
BELOW = 'shapes:  ( { form = "below"; level = 0.2; } );\n'
write('dam.cfg', DAM + 'sph: { dx = 0.02; c0 = 30.0; };')
write('channel.cfg', HEAD % '1, 0.4' + BELOW + '''initial: { field = "uniform"; velocity = (0.35, 0); };
walls:   ( { side = "x_min"; kind = "inflow"; discharge = 0.07; }, { side = "x_max"; kind = "outflow"; level = 0.2; },
           { side = "y_min"; } );
sph:     { dx = 0.02; c0 = 20.0; };''')
write('column.cfg', HEAD.replace('(0, 0)', '(-1, 0)') % '1, 1' + '''shapes: ( { form = "box"; box = ((-0.25, 0), (0.25, 0.6)); } );
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
fv:      { cells = (40, 20); volume = "fraction"; };''')
cases, outflow = root + '/cases/%s/case.cfg', root + '/cases/stress/outflow_fv.cfg'
# series.csv has 12 digits: 1e-9 leaves rounding three orders of magnitude to grow by
family('dam', 'dam.cfg', 'sph 2', '1 3', 0.1)
write('slab.cfg', DAM.replace('(0.6, 0.3)', '(1.2, 0.5)') + '''sph: { dx = 0.02; c0 = 30.0; };
bodies: ( { name = "b"; box = ((0.3, 0), (0.4, 0.1)); }, { box = ((0.6, 0), (0.7, 0.1)); }, { box = ((0.3, 0.1), (0.7, 0.2)); } );''')
family('slab', 'slab.cfg', 'sph 2', OTHERS, 0.1)
family('channel', 'channel.cfg', 'sph 2', '1', 0.4)
family('sloshing', cases % 'sloshing_fv', 'fv 2', '1 3', 0.2)
family('column', 'column.cfg', 'fv 2', OTHERS, 0.4)
# violent water past a post, by shifts, too: to the last digit on as many ranks
POST = HEAD % '1.2, 0.8' + '''shapes: ( { form = "box"; box = ((0, 0), (0.3, 0.5)); } );
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
blocked: ( { name = "post"; min = (0.6, 0); max = (0.75, 0.1); } );
probes:  ( { name = "through"; kind = "discharge"; at = (0.9, 0); to = (0.9, 0.8); } );
fv:      { cells = (48, 32); volume = "%s"; };'''
for kept in 'fraction', 'shift':
    write('post_%s.cfg' % kept, POST % kept)
    family('post_' + kept, 'post_%s.cfg' % kept, 'fv 1', '1', 0.8, tolerance=0)
# a tank that rolls, within the ramp of its motion
write('rolls.cfg', HEAD.replace('(0, 0)', '(-0.7, -0.2)') % '0.7, 0.9' + '''shapes: ( { form = "below"; level = 0.4; } );
blocks:  ( { name = "tank"; min = (-0.5, 0); max = (0.5, 0.7); cells = (32, 24); centre = (0, 0);
             i_min = "slip"; i_max = "slip"; j_min = "slip"; j_max = "slip";
             motion = ( { kind = "harmonic"; axis = "rz"; amplitude = 0.05; period = 1.2; ramp = 0.6; } ); } );
fv:      {};''')
family('rolls', 'rolls.cfg', 'fv 1', '1', 0.8, tolerance=1e-11, changes=['fluid.nu=1e-3'])
# what the surface was counted for is of the whole run, too
for key in 'reinitialisations', 'steps_repeated', 'volume_moved':
    lib.close('%s of a run that goes on' % key, *(lib.number(folder, key) for folder in ('column-3', 'column')), 1e-6)
family('outflow', outflow, 'fv 2', OTHERS, 0.1)
# the default tolerance of the pressure alone moves the fifth digit of the divergence
family('blocks', cases % 'taylor_green_blocks', 'fv 2', OTHERS, 0.1, changes=['fv.tol_pressure=1e-11', 'fv.tol_viscous=1e-11'])
# maxima are of the whole run: this flow decays
for key in 'max_cfl', 'max_speed_over_U':
    lib.close('%s of a run that goes on' % key, *(lib.number(folder, key) for folder in ('blocks-3', 'blocks')), 1e-6)
# the period is fitted to the samples of the whole run
family('standing', cases % 'standing_wave_fv', 'fv 2', '1', 12.0, tolerance=1e-5, changes=['fv.cells=(16,20)', 'output.series=4'])
periods = [lib.number(folder, 'error.period') for folder in ('standing', 'standing-1')]
if not abs(periods[0] - periods[1]) < 1e-5:
    bad('the period of a run that goes on is off by %.5g, of the straight run %.5g' % (periods[1], periods[0]))
family('coupled', 'taylor_green', 'both 2:1:1', '3:2:2', 0.08, changes=['sph.dx=0.0125', 'fv.cells=(24,24)'])
family('wave', 'standing_wave', 'both 2:1:1', '2:1:1 3:2:2' if lib.long else '3:2:2', 0.5, changes=['fv.cells=(16,20)'])

# regions of refinement that follow a body and the largest pressure, and cells that the surface asks for: on as many
# ranks as before to the last digit
write('regions.cfg', DAM + '''sph:    { dx = 0.025; c0 = 30.0; };
bodies: ( { name = "block"; points = ((0.2, 0.1), (0.2, 0.2), (0.3, 0.2), (0.3, 0.1)); velocity = (0.5, 0); } );
apr:    { around = 2; particles = 6e3;
          regions = ( { level = 1; shape = "body"; body = "block"; offset = 0.16; },
                      { level = 1; min = (0.3, -0.1); max = (0.6, 0.2); follow = "peak"; along = "x"; pressure = 100; } );
          criteria = ( { kind = "surface"; distance = 0; } ); };''')
family('regions', 'regions.cfg', 'sph 2', OTHERS, 0.03)
family('regions_same', 'regions.cfg', 'sph 1', '1', 0.03, tolerance=0)
family('regions_local', 'regions.cfg', 'sph 2', '2', 0.03, tolerance=0, changes=['apr.local_steps=true'])

# waves of a zone: a function of place and time alone
sea = HEAD % '4.5, 0.3' + BELOW + '''waves: { kind = "sea"; height = 0.03; length = 1.0; start = 0; };
walls:   ( { side = "x_min"; kind = "wave"; }, { side = "x_max"; kind = "beach"; }, { side = "y_min"; }, { side = "y_max"; } );
'''
write('sea_fv.cfg', sea + 'fv: { cells = (72, 12); };')
write('sea_sph.cfg', sea + 'sph: { dx = 0.025; };')
family('sea_fv', 'sea_fv.cfg', 'fv 1', '1 2', 1.0, tolerance=1e-6, column='kinetic energy')
family('sea_sph', 'sea_sph.cfg', 'sph 2', '1', 0.4, tolerance=1e-3, column='kinetic energy')

# meshes: a column of water in a tank without lid, an obstacle; the restart file knows its meshes
box_stl('tank.stl', (0, 0, 0), (1, 0.4, 0.6), 'zp')
box_stl('block.stl', (0.62, 0.13, 0), (0.78, 0.27, 0.17), 'zm')
write('meshes.cfg', '''format = 1;
fluid:   { rho = 1000.0; gravity = (0, 0, -9.81); };
domain:  { dim = 3; min = (0, 0, 0); max = (1, 0.4, 0.6); };
walls:   ( { mesh = "tank.stl"; }, { mesh = "block.stl"; flip = true; fluid_side = "outside"; } );
shapes:  ( { box = ((0, 0, 0), (0.5, 0.4, 0.3)); } );
sph:     { dx = 0.05; R_dx = 2.5; };
time:    { end = 1; };''')
start('sph', 'meshes.cfg', '--check')
if lib.says('built without a reader'):
    print('note: this build has no reader of meshes: runs between them are not restarted')
else:
    family('meshes', 'meshes.cfg', 'sph 2', OTHERS, 0.1)
    box_stl('block.stl', (0.62, 0.13, 0), (0.78, 0.27, 0.18), 'zm')
    judge('another mesh', go('meshes.cfg', 'sph 1', 'meshes-half', '--restart'), 2, 'of another mesh block: its file, or scale')

# a run of another case: what differs, and from what
judge('another dx', go('dam.cfg', 'sph 1', 'dam-half', '-p', 'sph.dx=0.04', '--restart'), 2, r'sph\.dx = 0\.02.* in the file, 0\.04.* here')
judge('other cells', go(outflow, 'fv 1', 'outflow-half', '-p', 'fv.cells=(32,16)', '--restart'), 2,
      'is of 64 x 16 x 1 cells, the case of 32 x 16 x 1')

# a run that goes on for longer has another speed of sound where its flow grows: pressures stay what they are, as a part of
# the weight (with the densities of the file, twice that speed made -1600 Pa of 3900)
write('driven.cfg', '''format = 1;
time:    { end = 0.3; };
fluid:   { gravity = (4, -9.81); };
domain:  { max = (1, 0.8); periodic = (true, false); };
walls:   ( { side = "y_min"; } );
shapes:  ( { form = "below"; level = 0.4; } );
probes:  ( { name = "P"; at = (0.5, 0); } );
sph:     { dx = 0.05; };
output:  { checkpoint = 0.3; snapshots = false; };''')
for what, change, wanted in (('longer', 'time.end=1.2', 3924), ('salt water', 'fluid.rho=1025', 1025 * 9.81 * 0.4),
                             ('lighter', 'fluid.gravity=(1,-2.4525)', 981)):
    judge('driven', go('driven.cfg', 'sph 1', 'driven', '--force'), DONE)
    judge(what, go('driven.cfg', 'sph 1', 'driven', '--restart', '-p', 'time.end=0.6', '-p', change), DONE, 'pressures are kept')
    late = [p for t, p in zip(lib.column('driven/series.csv', 't'), lib.column('driven/series.csv', 'P [')) if t > 0.31]
    lib.close(what + ': mean of p', sum(late) / len(late), wanted, 0.02)
    if max(late) - min(late) > 0.05 * late[0]:
        bad('%s: p from %.0f to %.0f Pa' % (what, min(late), max(late)))

# What restart files hold, by name. Whoever changes it, or what stands under a name, raises `meaning' of the program
# (struct program), so that files of before are refused, and writes this list anew: what `names' has then
if shutil.which('h5dump'):
    names = set()
    for program, runs in ('sph', ('dam', 'slab', 'regions', 'channel')), ('fv', ('sloshing', 'column', 'outflow', 'blocks')):
        for file in [file for name in runs for file in glob.glob('%s-half/%s-checkpoint-*.h5' % (name, program))]:
            contents, meaning = (subprocess.run(['h5dump', *how, file], stdout=subprocess.PIPE, text=True).stdout
                                 for how in (['-n', '1'], ['-a', '/meaning']))
            names.update('%s %s %s' % (program, *words) for words in re.findall(r'^ *(attribute|dataset) +(\S+)', contents, flags=re.M))
            names.update('%s meaning %s' % (program, number) for number in re.findall(r'^ *\(0\): *(.*)', meaning, flags=re.M))
    with open(root + '/tests/data/restart_names.txt') as f:
        known = set(f.read().split('\n')[:-1])
    if names != known:
        bad('restart files hold other things than tests/data/restart_names.txt says: %s' % sorted(names ^ known))
lib.end('%d faults' % lib.failed)
