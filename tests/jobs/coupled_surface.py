"""Coupled jobs whose free surface crosses upright open sides of SPH's box: rest, a wave through two sides, a dam that breaks into FV,
any number of ranks, restart, what is refused. SPDX-License-Identifier: BSD-3-Clause"""
import glob

import lib
from lib import alone, bad, below, close, column, dataset, last, near, number, refused_by, restarted, root, says, start, told, varied

lib.scratch()


def job(folder, case, keys='', ends=(0, 1), **how):
    """Short runs need not meet what their case accepts."""
    lib.job(folder, case, keys, ends=ends, **how)


def at_rest(folder):
    below(folder + ': Mach in water at rest', number(folder, 'max_mach'), 2e-3)
    keeps_water(folder)
    below(folder + ': gap of the levels in dx', number(folder, 'level_gap'), 0.1)


def keeps_water(folder, most=1e-3):
    below(folder + ': share of the water that is missing', number(folder, 'water_missing'), most)


def gauge(folder, program, name, wanted):
    near('%s: gauge %s of %s' % (folder, name, program), last('%s/%s-series.csv' % (folder, program), name + ' [m]'), wanted, 0.005)


def not_read(folder, **gauges):
    for program, title in gauges.items():
        if column('%s/%s-series.csv' % (folder, program), title):
            bad('%s: %s reads %s, which is of another program' % (folder, program, title))


def lifted(folder):
    """A body of each of two boxes: force of Archimedes."""
    for program, body in ('sph', 'one'), ('sph_right', 'two'):
        close('%s: force on body %s' % (folder, body), last('%s/%s-series.csv' % (folder, program), body + ' force y'), 0.15, 0.03)


# water at rest, SPH in the right half, a strip in the middle, and a level that no row of particles ends on
water = open(root + '/cases/still_water_crossing/case.cfg').read()
still = 'time.end=1 sph.dx=0.05 fv.cells=(32,11) output.snapshots=false '
gauges = '''probes:  ( { name = "left"; kind = "level"; at = (1, 0); }, { name = "right"; kind = "level"; at = (3, 0); },
           { name = "edge"; kind = "level"; at = (2, 0); } );
'''
off = varied(water, 'level = 1.0;', 'level = 1.015;') + gauges
job('right', water, still)
job('strip', water, still + 'sph.box=((0.7,0),(3.3,1.4))')
job('off', off, still)
# the same in 3D, periodic along the side
if lib.long:
    job('thick', water, 'time.end=0.6 output.snapshots=false domain.dim=3 domain.max=(4,1.4,0.8) domain.periodic=(false,false,true) '
        'fluid.gravity=(0,-1,0) sph.dx=0.1 sph.R_dx=3 fv.cells=(20,7,8) sph.box=((2,0,0),(4,1.4,0.8))', ranks='2:1:1')
for folder in ['right', 'strip', 'off'] + ['thick'] * lib.long:
    at_rest(folder)
    # the partner's pressures are its particles': no odd-even waves of fv's (0.215, a warning, where they were counted)
    below(folder + ': odd-even waves of pressure in water at rest', number(folder, 'odd_even_pressure'), 0.1)

# two levels side by side in fv's part: from its first row on its pressure is that which sets them in motion, as in fv alone
# (3793 Pa, not 4905 of water at rest); without the particles, whose own pressures move it by more once they are there
levels = '''format = 1;
time:    { end = 0.01; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; max = (4, 1); };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
shapes:  ( { box = ((0, 0), (1, 0.6)); }, { box = ((1, 0), (4, 0.4)); } );
probes:  ( { name = "high"; at = (0.9, 0.1); }, { name = "low"; at = (1.3, 0.1); } );
output:  { every = 0.01; series = 1; snapshots = false; };
fv:      { cells = (80, 20); };
'''
alone('fv', 'levels_fv', levels)
job('levels', levels + 'sph: { dx = 0.04; box = ((2.2, 0), (4, 1)); };\n')
for name in 'high', 'low':
    close('pressure under two levels at the start: ' + name, column('levels/fv-series.csv', name + ' [Pa]')[0],
          column('levels_fv/series.csv', name + ' [Pa]')[0], 0.005)

# a level gauge in the zones of the box, whose particles are packed unevenly in waves, is told with where they are free
lib.write('zone.cfg', varied(water, 'output:', gauges.replace('(3, 0)', '(2.2, 0)') + 'output:'))
start('sph', 'zone.cfg', '--check')
told('zone', r'probes.\[1\].at: right stands in the transition or buffer of the particles', 'out.txt')
if says(r'probes.\[0\].at'):
    bad('zone: a gauge beyond the box is told as one in its zones', 'out.txt')

# a refined region in the box at rest: particles that change levels are no water that came or went (0.0018 of it seemed missing, and
# fv's flow against that lifted the level of the box by 4 mm in 0.8 s)
job('refined', '''format = 1;
time:    { end = 0.3; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (4, 1.4); };
initial: { U = 0.3; };
shapes:  ( { form = "below"; level = 1.0; } );
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
apr:     { regions = ( { min = (1.7, 0); max = (2.3, 0.6); } ); };
sph:     { dx = 0.04; box = ((1, 0), (3, 1.4)); };
fv:      { cells = (50, 18); };
output:  { snapshots = false; };
''')
at_rest('refined')
told('refined', 'without mass flux')  # which grows a plume over a refined floor under waves

# still water keeps its level in the box, with masses that follow the packing and without, and beside waves that are fv's (within 3 s
# -0.06 dx where the outside had not the pressure that particles at rest have near the surface; -0.08 dx beside waves, where mass
# that walls lost was not given back)
level = '''format = 1;
time:    { end = 3.0; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (6, 0.7); };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
shapes:  ( { form = "below"; level = 0.5; } );
probes:  ( { name = "inside"; kind = "level"; at = (2.85, 0.5); } );
sph:     { dx = 0.05; box = ((2, 0), (3.7, 0.7)); };
fv:      { cells = (60, 14); };
output:  { series = 4; snapshots = false; };
'''
ripples = varied(level, 'x_min";', 'x_min"; kind = "wave";', 'x_max";', 'x_max"; kind = "beach";', 'shapes:',
                 'waves: { height = 0.0005; period = 1.0; };\nshapes:')
job('level', level)
if lib.long:
    job('level_ale', level, 'sph.scheme=riemann_ale')
job('level_waves', ripples, 'sph.scheme=riemann_ale')
for folder in ['level', 'level_waves'] + ['level_ale'] * lib.long:
    near(folder + ': level of still water in the box', last(folder + '/sph-series.csv', 'inside [m]'), 0.5, 0.05 * 0.05)

# where crests come over the top of the box the particles have a part of the surface alone, and its level is fv's (9.7 mm too low)
job('crests', varied(ripples, '0.0005', '0.05'), 'time.end=0.02 sph.dx=0.025 sph.box=((2,0),(3.7,0.525))')
gauge('crests', 'fv', 'inside', 0.5)
not_read('crests', sph='inside')

# a box that reaches over a period holds what the case gives in the first one: levels, sections
round_trip = '''format = 1;
time:    { end = 0.1; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (4, 0.7); periodic = (true, false); };
walls:   ( { side = "y_min"; }, { side = "y_max"; } );
initial: { field = "uniform"; velocity = (0.2, 0); level = 0.5; };
shapes:  ( { form = "below"; level = 0.5; } );
probes:  ( { name = "inside"; kind = "level"; at = (0.2, 0.5); }, { name = "flow"; kind = "discharge"; at = (0.2, 0.1); to = (0.2, 0.4); } );
sph:     { dx = 0.05; box = ((3, 0), (5, 0.7)); };
fv:      { cells = (40, 14); };
output:  { snapshots = false; };
'''
job('round', round_trip)
gauge('round', 'sph', 'inside', 0.5)
close('discharge in a box over a period', last('round/sph-series.csv', 'flow'), 0.06, 0.02)
not_read('round', fv='inside')
refused_by('sph', round_trip, r'\(0.2, 0.1\); to = \(0.2', '(2.8, 0.1); to = (3.4', 'flow: a discharge is read by one program')

# a tank as narrow as two supports: an imposed cell has images beyond both of its sides; 3D, gravity along -y
job('narrow', '''format = 1;
time:    { end = 0.3; };
fluid:   { rho = 1.0; gravity = (0, -1, 0); };
domain:  { dim = 3; min = (0, 0, 0); max = (2, 1.2, 0.48); };
initial: { field = "rest"; U = 0.1; level = 1.0; };
shapes:  ( { form = "below"; level = 1.0; } );
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; }, { side = "z_min"; }, { side = "z_max"; } );
sph:     { dx = 0.08; R_dx = 3.0; box = ((0.72, 0, 0), (2, 1.2, 0.48)); };
fv:      { cells = (20, 16, 4); };
output:  { snapshots = false; };
''', ends=(0,))
keeps_water('narrow')
below('narrow: gap of the levels in dx', number('narrow', 'level_gap'), 0.1)

# a river that starts from rest: without smoothing at its gain of 0.28 the programs' pressures part by e in 0.07 s
job('river', '''format = 1;
time:    { end = 0.7; };
fluid:   { rho = 1000.0; nu = 1.0e-6; gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (4, 0.8); };
shapes:  ( { form = "below"; level = 0.4; } );
walls:   ( { side = "x_min"; kind = "inflow"; discharge = 0.1; }, { side = "x_max"; kind = "outflow"; level = 0.4; },
           { side = "y_min"; }, { side = "y_max"; } );
sph:     { dx = 0.02; box = ((1.6, 0), (2.4, 0.8)); };
fv:      { cells = (80, 20); };
output:  { snapshots = false; };
''', ends=(0,))
below('river: pressures of the programs apart, in rho g H', number('river', 'overlap_pressure'), 0.06)

# a full tank with weight, at rest but for the particles' sound, which is no wave of two cells (0.27 of its own size by then)
full = '''format = 1;
time:    { end = 0.8; };
fluid:   { rho = 1000.0; nu = 1.0e-6; gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (2, 1); };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
sph:     { dx = 0.025; box = ((0.575, 0.075), (1.425, 0.925)); };
fv:      { cells = (40, 20); };
output:  { snapshots = false; };
'''
job('full', full, ends=(0,))
below('full: odd-even waves of pressure', number('full', 'odd_even_pressure'), 0.1)
for program in 'sph', 'fv':
    refused_by(program, full, '^output', 'probes: ( { name = "p"; kind = "level"; at = (1, 0); } );\noutput', 'there is no free surface')

# a gauge is read by the program in whose part it lies, and by that alone; levels within dx/10 (particles that began on
# the rows of their lattice had theirs at 1.0)
gauge('off', 'fv', 'left', 1.015)
gauge('off', 'sph', 'right', 1.015)
gauge('off', 'fv', 'edge', 1.015)  # on the box's face, where half of sph's column would be outside
not_read('off', sph='left', fv='right')
not_read('off', sph='edge')
back = last('off/fv-series.csv', 'volume put back')
if not 1e-12 <= back <= 1e-3:
    bad("off: columns of fv's series are out of place: volume put back %g" % back)

# over a box that lies below the surface the level is fv's (it read the top of the box)
job('low', off, still + 'time.end=0.3 sph.box=((2,0),(4,0.9))')
gauge('low', 'fv', 'right', 1.015)
not_read('low', sph='right')

# a cube of triangles half in the water, held: fv, which reads no mesh, has the water around its box; force of Archimedes
start('sph', root + '/cases/sphere_3d/case.cfg', '--check')
if says('built without a reader'):
    print('note: this build has no reader of meshes: no body of triangles is looked at')
else:
    lib.box_stl('cube.stl', (1.0, 0.24, 0.3), (1.4, 0.56, 0.7))
    job('cube', '''format = 1;
time:    { end = 0.2; };
fluid:   { rho = 1000.0; nu = 1e-3; gravity = (0, 0, -9.81); };
domain:  { dim = 3; min = (0, 0, 0); max = (2.4, 0.8, 0.8); };
initial: { field = "rest"; U = 0.5; };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; }, { side = "z_min"; }, { side = "z_max"; } );
shapes:  ( { form = "below"; level = 0.55; } );
bodies:  ( { name = "cube"; mesh = "cube.stl"; } );
sph:     { dx = 0.05; R_dx = 2.5; free = ((0.8, 0, 0), (1.6, 0.8, 0.8)); };
fv:      { cells = (48, 16, 16); };
output:  { snapshots = false; };
''')
    close('cube: force', last('cube/sph-series.csv', 'cube force z'), 313.9, 0.05)
    keeps_water('cube')

# two boxes, each a program, under one surface: levels, water, each gauge by its own program
begin, end = water.index('sph: '), water.index('fv: ')
two = water[:begin] + 'sph: { dx = 0.05; c0 = 10.0; transport = "none"; free = ((1, 0), (2.5, 1.4)); };\n' + water[end:] + '''
sph_right: { dx = 0.05; c0 = 10.0; transport = "none"; free = ((5, 0), (6.5, 1.4)); };
probes:  ( { name = "a"; kind = "level"; at = (2, 0); }, { name = "b"; kind = "level"; at = (4, 0); },
           { name = "c"; kind = "level"; at = (6, 0); } );
'''
wide = 'fv.cells=(80,14) domain.max=(8,1.4) output.snapshots=false '
boxes = 'sph', 'sph_right'
job('two', two, wide + 'time.end=1', boxes=boxes)
below('two: Mach in water at rest', number('two', 'max_mach'), 2e-3)
keeps_water('two')
for program, name in ('sph', 'a'), ('fv', 'b'), ('sph_right', 'c'):
    gauge('two', program, name, 1.0)
not_read('two', sph='c [m]', fv='a [m]')

# a body and a line in each of them: each program has its own
own = varied(two, 'walls:   (', '''walls:   ( { points = ((1.6, 0), (1.75, 0.2), (1.9, 0)); kind = "slip"; },
           { points = ((5.6, 0), (5.75, 0.2), (5.9, 0)); kind = "slip"; },''') + '''
bodies: ( { name = "one"; points = ((1.5, 0.7), (1.5, 1.2), (2, 1.2), (2, 0.7)); },
          { name = "two"; points = ((5.6, 0.5), (5.6, 1.2), (5.9, 1.2), (5.9, 0.5)); } );
'''
if lib.long:
    job('own', own, wide + 'time.end=1', boxes=boxes)
    lifted('own')
    not_read('own', sph='two force', sph_right='one force')
    keeps_water('own')

# a wave through two sides: the level that leaves one program comes to the other; ranks; restart half-way
wave = ('time.end=0.5 output.every=0.25 output.checkpoint=0.26 sph.dx=0.05 fv.cells=(40,12) sph.R_dx=4 sph.box=((0.5,0),(3.5,1.2)) '
        'coupling.transition=0.25 coupling.buffer=0.25 coupling.overlap=0.25 ')
job('wave', 'standing_wave_crossing', wave)
job('wave2', 'standing_wave_crossing', wave, ranks='2:2:2')
below('wave: velocity error', number('wave', 'velocity_l2'), 0.06)
keeps_water('wave')
close('wave on 2:2:2: velocity error, on one rank each', number('wave2', 'velocity_l2'), number('wave', 'velocity_l2'), 1e-6)
restarted('wave', 'standing_wave_crossing', wave, ends=(0, 1))
# what is left is divided anew where the end and the outputs are others now: outputs come at their times
job('other', 'standing_wave_crossing', wave + 'time.end=0.25 output.checkpoint=0.25')
lib.job('other', 'standing_wave_crossing', wave + 'time.end=0.45 output.every=0.1', '--restart', ends=(0, 1))
near('another end', last('other/series.csv', 't'), 0.45, 1e-9 * 0.45)
below('another end: velocity error', number('other', 'velocity_l2'), 0.06)
for program in 'sph', 'fv':
    snapshots = glob.glob('other/%s_0*.h5' % program)  # 0, 0.25, 0.3, 0.4, 0.45
    if len(snapshots) != 5:
        bad('another end: %s has %d snapshots, wanted 5' % (program, len(snapshots)))

# water over a box on the floor, from wall to wall: sound in it finds no side that lets it go (before windows followed it
# the velocity error was 3.4 at t = 1, with exit code 0)
job('cup', '''format = 1;
time:    { end = 0.8; };
fluid:   { rho = 1000.0; nu = 1e-6; gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (2, 1); };
initial: { field = "standing_wave"; L = 2.0; amplitude = 0.05; level = 0.7; U = 0.2; };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
sph:     { dx = 0.025; free = ((0, 0), (2, 0.3)); };
fv:      { cells = (40, 20); };
output:  { snapshots = false; };
''')
below('cup: velocity error of U', number('cup', 'velocity_linf'), 0.1)
below('cup: velocities of the programs apart', number('cup', 'overlap_velocity'), 0.05)

# oil on a slope in a period: gravity's part along it drives, and the level does not lean
job('film', '''format = 1;
time:    { end = 0.3; };
fluid:   { rho = 900.0; nu = 0.02; gravity = (0.98, -9.76); };
domain:  { dim = 2; min = (0, 0); max = (1, 0.3); periodic = (true, false); };
initial: { U = 0.5; };
shapes:  ( { form = "below"; level = 0.2; } );
walls:   ( { side = "y_min"; kind = "no_slip"; }, { side = "y_max"; } );
sph:     { dx = 0.02; free = ((0.3, 0), (0.7, 0.3)); };
fv:      { cells = (32, 12); };
output:  { snapshots = false; };
''')
below('film: gap of the levels in dx', number('film', 'level_gap'), 0.02)
keeps_water('film', 1e-4)


def on_blocks(text, blocks):
    """A case whose fv has these blocks."""
    begin = text.index('fv: ')
    return text[:begin] + 'fv: {};\n' + text[text.index('\n', begin) + 1:] + 'blocks: ( %s );\n' % blocks


# on blocks: two joined ones whose seam lies in sph's box, turned cells under a box that moves, bdf2; a bed that rises
# through both programs, which a side of fv's block follows; restart
on = 'time.end=1 sph.dx=0.05 output.every=0.5 output.checkpoint=0.51 '
job('joined', on_blocks(water, '''{ name = "l"; cells = (20, 14); max = (2, 1.4); i_max = "joined"; },
    { name = "r"; cells = (20, 14); min = (2, 0); max = (4, 1.4); i_min = "joined"; }'''),
    on + 'sph.box=((0.8,0),(2.8,1.4))', ranks='1:1:2')
job('waving', on_blocks(water, '{ name = "all"; mapping = "sheared"; wave = 0.03; cells = (40, 14); max = (4, 1.4); }'),
    on + 'sph.box=((0.7,0),(2.5,1.4)) sph.box_velocity=(0.1,0) fv.integrator=bdf2')
bed = on_blocks(varied(water, '( { side = "x_min"', '( { points = ((0.5, 0), (3.5, 0.5), (4, 0.5)); kind = "slip"; }, { side = "x_min"'),
                '''{ name = "all"; mapping = "file"; file = "bed.xyz"; i_min = "slip"; i_max = "slip"; j_min = "slip"; j_max = "slip"; }''')
heights = [min(max((i / 10 - 0.5) / 6, 0), 0.5) for i in range(41)]
lib.write('bed.xyz', '41 15\n' + ''.join('%g\n' % (i / 10) for j in range(15) for i in range(41)) +
          ''.join('%.7g\n' % (h + (1.4 - h) * j / 14) for j in range(15) for h in heights))
job('bed', bed, on + 'sph.box=((1,0),(3,1.4))')
for folder in 'joined', 'waving', 'bed':
    at_rest(folder)
restarted('bed', bed, on + 'sph.box=((1,0),(3,1.4))', ends=(0, 1))
if says('left the region', 'bed.txt'):
    bad('bed: particles came in behind it', 'bed.txt')

# a dam that breaks out of sph into fv on a block: phi of the partner's cells is a distance, far from its water, too
job('dam', on_blocks(open(root + '/cases/dam_break_crossing/case.cfg').read(), '{ name = "all"; cells = (64, 24); max = (1.6, 0.6); }'),
    'time.end=0.35 output.snapshots=false')
keeps_water('dam', 0.003)

# two boxes with their bodies on blocks that overlap between them, one of them stretched
job('own_blocks', on_blocks(own, '''{ name = "a"; cells = (44, 14); max = (4.4, 1.4); i_max = "overlap"; },
          { name = "b"; mapping = "stretched"; stretch = (0.5, 0); focus = (5.5, 0); cells = (42, 14); min = (3.8, 0); max = (8, 1.4);
            i_min = "overlap"; }'''), 'time.end=1 domain.max=(8,1.4) output.every=0.5', ranks='1:1:2', boxes=boxes)
lifted('own_blocks')
for program in boxes:
    told('own_blocks', 'outline_1', 'own_blocks/%s_walls.xdmf' % program)  # a body of its own
keeps_water('own_blocks')

# a post through the surface is a wall of the water: to fv's cells there it is water up to the level, not air (0.11 m of it)
post = water + 'bodies: ( { name = "post"; points = ((1.85, -0.2), (1.85, 1.6), (2.15, 1.6), (2.15, -0.2)); } );'
job('post', post, 'time.end=0.1 sph.dx=0.05 fv.cells=(40,14) sph.box=((0.7,0),(3.3,1.4))')
phi = dataset(max(glob.glob('post/fv_[0-9]*.h5')), 'level_set')
for row in range(14):
    below('post: phi of a cell in it, times that of its place', -phi[40 * row + 20] * (row - 9.5), 0.0)
for row in 9, 10:  # beside the surface the distance is exact by symmetry
    near('post: height over the surface of a cell in it', phi[40 * row + 20], 0.1 * (row - 9.5), 0.01)

# walls that but one of the programs has
for folder, old, new, words in (
        ('line', '(0.5, 0), (3.5, 0.5), (4, 0.5)', '(0, 0.2), (4, 0.2)', 'it lies in cells of fv.s blocks and is no side'),
        ('side', '{ points = ((0.5, 0), (3.5, 0.5), (4, 0.5)); kind = "slip"; },', '', 'its side is a wall, within sph.box')):
    job(folder, varied(bed, old, new), 'time.end=0.1 sph.dx=0.05 sph.box=((1,0),(3,1.4))', ends=(2,))
    told(folder, words)

# what cannot be done says so
if start('fv', root + '/cases/standing_wave_crossing/case.cfg', '--check', '-p', 'fv.surface=no') != 2:
    bad('a surface that fv shall not have is not refused')
told('a surface that fv shall not have', 'both programs have the surface', 'out.txt')
lib.end('%d faults' % lib.failed)
