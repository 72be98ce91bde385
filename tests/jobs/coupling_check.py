"""What --check says of coupled cases: windows and memory that the flow wants, scenes that are refused, each with its reason.
Nothing runs. SPDX-License-Identifier: BSD-3-Clause"""
import re

import lib
from lib import bad, root, says, start, varied

lib.scratch()


def accepts(case, keys='', words='', program='sph', code=0):
    """--check of the case with these keys ends so and tells these words, which are then in out.txt."""
    ended = start(program, lib.scene(case, 'looked_at'), '--check', *lib.settings(keys))
    if ended != code or not says(words):
        bad('%s %s: exit code %d, wanted %d and "%s"' % (case, keys, ended, code, words), 'out.txt')


def refuses(words, case, keys=''):
    accepts(case, keys, words, code=2)


def silent(words):
    if says(words):
        bad('told "%s"' % words, 'out.txt')


accepts('taylor_green', 'coupling.steps=0', r'coupling steps of 15 steps, 0.03 s, limited by the flow: U T/L = 0.030')
accepts('taylor_green', 'coupling.steps=0 initial.velocity=(0.8,0.6) sph.c0=10',  # twice the speed
        'coupling steps of 7 steps, 0.014 s, limited by the flow')
accepts('standing_wave', 'coupling.steps=0 coupling.memory=0', 'limited by the waves')
accepts('taylor_green', 'fluid.nu=1', 'limited by viscosity')
accepts('taylor_green', 'coupling.steps=50', 'times what this flow allows')
refuses('values cannot be extrapolated in time', 'taylor_green', 'coupling.steps=150')
refuses('is unstable above', 'standing_wave', 'coupling.steps=1 coupling.memory=1')
for case in 'uniform_flow', 'standing_wave', 'standing_wave_3d', 'breaking_wave', 'beltrami', 'taylor_green':
    accepts(case)
# in the midst of a flow the overlap is as wide as leaves four cells; it is told
accepts('taylor_green', 'fv.cells=(48,48) coupling.overlap=0', r'overlap \(0.158, 0.158\) m wide')
accepts('taylor_green', 'coupling.overlap=0', r'overlap \(0.137, 0.137\) m wide')
# cells as fine as the particles, and a loop whose gain only smoothing bounds: said, with a c0 that mends it
silent('times sph.dx')
accepts('taylor_green', 'fv.cells=(150,150)', 'warning: fv.cells: cells of 0.00667 m are .* times sph.dx; below 1.5')
accepts('box_in_waves', 'sph.scheme=auto', 'Riemann ALE')  # in waves of fv pressures fall without mass flux
accepts('dam_break_crossing', '', 'Riemann ALE')
# a box at the wall that a dam break will reach
accepts(lib.changed(lib.TANK, shapes='{ form = "box"; box = ((0, 0), (0.3, 0.5)); }', fv='cells = (40, 40);', sph='dx = 0.02; box = ((0.4, 0), (1, 1));'),
        '', 'sph.box is dry at the start')
silent('no water at the start')
accepts('dam_break_crossing', 'sph.box=((0,-1),(0.8,9))', r'sph.box: y from -1 to 9 m ends at the domain')
accepts('waves_crossing')  # waves want their cells
silent('times sph.dx')
gain = '''format = 1;
time:    { end = 3.0; };
fluid:   { rho = 1.0; nu = 1.0e-3; };
domain:  { dim = 2; min = (0, 0); max = (2.4, 0.6); };
initial: { field = "uniform"; U = 0.3; velocity = (0.2, 0.0); };
walls:   ( { side = "x_min"; kind = "inflow"; velocity = (0.2, 0); }, { side = "x_max"; kind = "outflow"; },
           { side = "y_min"; kind = "no_slip"; }, { side = "y_max"; kind = "no_slip"; } );
sph:     { dx = 0.01; box = ((0.5, 0), (1.5, 0.46)); };
fv:      { cells = (144, 36); };
'''
accepts(gain, '', r'warning: gain of the coupling loop .*, above 1: .* sph.c0 = [0-9.]* m/s lowers it to 1')
c0 = (re.findall(r'; sph.c0 = ([0-9.]*) m/s lowers', open('out.txt').read()) or ['none'])[0]
accepts(gain, 'sph.c0=' + c0)
silent('above 1:')

# bdf2 under a violent surface: a warning with its steps; none where the flow is slow and viscous
slow = 'warning: fv.integrator: bdf2 is for slow'
accepts('dam_break_fv', 'fv.integrator=bdf2 fluid.nu=1e-6', slow, 'fv')
accepts('dam_break_fv', 'fv.integrator=bdf2 fluid.nu=1e-2', program='fv')
silent(slow)
# newton over the layers of a sudden start: a warning where the run ends in their midst in one step, none in seven steps nor to the
# steady flow
couette = '''format = 1;
time:    { end = 0.05; };
fluid:   { rho = 1.0; nu = 1.0; };
domain:  { dim = 2; min = (0, 0); max = (0.25, 1); periodic = (true, false); };
walls:   ( { side = "y_min"; kind = "no_slip"; }, { side = "y_max"; kind = "no_slip"; velocity = (1, 0); } );
fv:      { cells = (4, 20); integrator = "newton"; };
'''
sudden = "warning: fv.integrator: newton.s steps of"
accepts(couette, '', sudden, 'fv')
for keys in 'fv.cfl=0.15', 'time.end=1':
    accepts(couette, keys, program='fv')
    silent(sudden)

# a wall that drags water through open sides from the start on
dragged = varied(couette, '(0.25, 1)', '(1, 1)', 'nu = 1.0', 'nu = 0.1', 'cells = (4, 20); integrator = "newton"', 'cells = (32, 32)') + \
    'sph: { dx = 0.02; c0 = 10.0; box = ((0.1, 0.4), (0.9, 1)); };\n'
holds = r'warning: walls..1.: it moves at once, along open sides'
accepts(dragged, '', holds)
for keys in 'coupling.steps=1', 'sph.box=((0,0.4),(1,1))', 'sph.box=((0.1,0),(0.9,0.6))':
    accepts(dragged, keys)
    silent(holds)

# scenes without a place for the coupling
refuses('sph.free: 0.3 to 0.7 m along x is too short: .* 0.27 to 0.73 m would do', 'taylor_green', 'coupling.overlap=0.19')
accepts('taylor_green', 'coupling.overlap=0.19 sph.free=((0.27,0.27),(0.73,0.73))')
refuses('fv.cells: cells of 0.005 m are finer than', 'taylor_green', 'fv.cells=(200,200)')
refuses('no cell of fv .0.25 m. gets anything', 'taylor_green', 'fv.cells=(4,4)')
refuses('no cell of fv .* gets anything', 'taylor_green', 'coupling.overlap=0.4')
refuses('no side of it lies in fv', 'taylor_green', 'sph.free=((0,0),(1,1))')
accepts('taylor_green', 'sph.free=((0.7,0.3),(1.1,0.7))')  # across a periodic side
refuses('is longer than the period', 'taylor_green', 'sph.free=((0.05,0.3),(0.97,0.7))')
moves = 'sph.box_velocity=(0.5,0.3)'
accepts('taylor_green', moves)
refuses('cannot move along y', 'standing_wave', 'sph.box_velocity=(0,0.1)')
refuses('no body is named', 'taylor_green', 'sph.box_follows=ship')
# a region of refinement in a box that moves
refined = open(root + '/cases/taylor_green/case.cfg').read() + '''
apr: { levels = 1; regions = ( { level = 1; min = (0.43, 0.43); max = (0.57, 0.57); %s } ); };
'''
follows = refined % 'follow = "sph.box";'
accepts(follows, moves)
refuses('the box rests', follows)
accepts(refined % 'velocity = (0.5, 0.3);', moves)
refuses('reaches into the open side', refined % '', moves)
accepts('solitary_crossing', 'sph.box_follows="breaker"')
refuses('a crest is followed where the surface crosses', 'taylor_green', 'sph.box_follows="breaker"')
two = root + '/cases/taylor_green/two_boxes.cfg'
accepts(two)
refuses('overlaps the box of group sph_right', two, 'sph.free=((0.3,0.3),(1.1,0.7))')
refuses('one that moves could meet another', two, 'sph.box_velocity=(0.1,0)')
refuses('overlaps the box of group sph_right', two, 'sph.free=((-0.7,0.3),(-0.3,0.7))')  # one period on
# a box that moves away from what rests in it, or lies in another period than that was drawn in
solid = open(root + '/cases/taylor_green/case.cfg').read() + 'bodies: ( { name = "post"; radius = 0.05; centre = (0.5, 0.5); } );'
accepts(solid)
refuses('post.* leaves the free zone of the particles across x at .*, at t = ', solid, moves)
refuses('lies in another period: draw it .1 m farther along x', solid, 'sph.free=((1.3,0.3),(1.7,0.7))')
accepts(varied(solid, 'centre = (0.5', 'centre = (1.5'), 'sph.free=((1.3,0.3),(1.7,0.7))')
post = solid[solid.index('bodies:'):]
line = varied(solid, post, 'walls: ( { points = ((0.47, 0.47), (0.53, 0.47), (0.53, 0.53), (0.47, 0.53)); closed = true; } );')
accepts(line)
refuses('outside of .* once the box has moved', line, moves)

# surfaces of triangles: where the particles are
lib.box_stl('cube.stl', (0.4, 0.4, 0.4), (0.6, 0.6, 0.6))
tank = '''format = 1;
time:    { end = 1.0; };
fluid:   { rho = 1000.0; nu = 0.01; gravity = (0, 0, -1); };
domain:  { dim = 3; min = (-1, 0, 0); max = (2, 1, 1); };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; }, { side = "z_min"; },
           { side = "z_max"; } );
sph:     { dx = 0.025; R_dx = 2.5; free = ((0.2, 0.2, 0), (0.8, 0.8, 1)); };
fv:      { cells = (96, 32, 32); };
'''
start('sph', root + '/cases/sphere_3d/case.cfg', '--check')
if says('built without a reader'):
    print('note: this build has no reader of meshes')
else:
    cube = tank + 'bodies: ( { name = "cube"; mesh = "cube.stl"; } );\n'
    accepts(cube)
    accepts(cube, program='fv')
    leaves = varied(cube, '"cube.stl";', '"cube.stl"; velocity = (0.5, 0, 0);')
    refuses("body .cube' is outside of [(]0.25[0-9]*, 0.25[0-9]*, 0[)] to .* m at t = 0.[0-9]* s", leaves)
    accepts(leaves, 'sph.box_follows="cube"')
    refuses(r'walls.\[6\].mesh: at [(]1.3.*fv, which has no walls but',
            varied(tank, '"z_max"; }', '"z_max"; }, { mesh = "cube.stl"; translate = (0.9, 0, 0); fluid_side = "outside"; }'))
    refuses(r'shapes.\[0\].mesh: surfaces of triangles are for sph in 3D',
            tank + 'shapes: ( { form = "mesh"; mesh = "cube.stl"; } );\n')
channel = '''format = 1;
time:    { end = 1.0; };
fluid:   { rho = 1000.0; nu = 0.01; };
domain:  { dim = 2; min = (0, 0); max = (4, 1); };
initial: { field = "uniform"; velocity = (1, 0); };
walls:   ( { side = "x_min"; kind = "inflow"; velocity = (1, 0); }, { side = "x_max"; kind = "outflow"; },
           { side = "y_min"; }, { side = "y_max"; } );
sph:     { dx = 0.025; box = ((0.8, 0), (2.6, 1)); };
fv:      { cells = (96, 24); };
'''
accepts(channel)  # cut in two: wall_to_wall.py runs such a job
silent('the fluid rests, and an inflow')
accepts(channel, 'initial.field="rest" initial.velocity=(0,0)', 'warning: initial.field: the fluid rests, and an inflow of 1 m/s')
accepts(channel, 'domain.max=(4,2) fv.cells=(96,48)')  # a way around
refuses('nothing would say how much flows through it', channel,
        'walls.[0].kind=outflow walls.[0].velocity=(0,0) walls.[0].pressure=100')
refuses('newton solves for one pressure', channel, 'fv.integrator=newton')
basin = '''format = 1;
time:    { end = 1.6; };
fluid:   { rho = 1000.0; nu = 1.0e-6; gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (2, 1.2); };
initial: { field = "rest"; U = 3.13; };
shapes:  ( { box = ((0, 0), (2, 0.6)); } );
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } );
sph:     { dx = 0.02; box = ((0, 0.1), (2, 1.2)); };
fv:      { cells = (64, 40); };
'''
accepts(basin)
refuses('there is no water', basin, 'sph.box=((0,0.44),(2,1.2))')
accepts(basin, 'sph.box=((0.5,0.0),(1.5,1.2))')  # the surface crosses its sides
accepts(basin, 'sph.box=((0.5,0.0),(1.5,0.4))')  # or is fv's alone
accepts('standing_wave_3d', 'sph.box=((0.25,0,0),(1.75,1.25,2))')  # and in 3D
# one voice for a fault of both programs: fv has boxes cut out of its cells, and sph that knows none leaves it to say so
boxed = basin + 'blocked: ( { min = (1.8, 0); max = (1.9, 0.2); } );\n'
accepts(boxed)
accepts(boxed, '', 'blocked: not in a coupled job: use bodies', 'fv', 2)
refuses("blocked: boxes cut out of fv's cells: give them as bodies", re.sub('(?m)^fv:.*', '', boxed))
# what a third program may take
accepts(basin, '', r'where a free surface crosses sph.box: sph.one \(-\), fv.phi', 'coupler')
accepts(root + '/coupler/examples/plate.cfg', '', r'sph.plate.load \(N\)', 'coupler')
silent('plate.motion$')
beach = varied(basin, 'walls:   (', 'walls: ( { points = ((1.2, 0), (2, 0.8)); },')
accepts(beach, 'sph.box=((0.5,0.0),(2,1.2))')  # a beach where sph gives the flow
refuses('fv, which has no walls but the domain', beach, 'sph.box=((1,0),(2,1.2))')
refuses('which has no wall', varied(basin, ', { side = "x_max"; }', ''))
plate = '''format = 1;
time:    { end = 1.6; };
fluid:   { rho = 1.0; nu = 1.0e-2; };
domain:  { dim = 2; min = (0, 0); max = (2, 1); periodic = (true, true); };
initial: { field = "rest"; U = 1.0; };
bodies:  ( { name = "plate"; centre = (1, 0.5); velocity = (0.4, 0.0); kind = "no_slip";
             points = ((0.9,0.45),(0.9,0.55),(1.1,0.55),(1.1,0.45)); } );
sph:     { dx = 0.02; box = ((0.5, 0), (1.5, 1)); };
fv:      { cells = (64, 32); };
'''
refuses('leaves the free zone of the particles across x', plate)
accepts(plate, 'time.end=0.2')
# a line of another period: 5.5 m is 1.5 m, where fv computes; in the box, which goes over the period, it may stand
over = '''
format = 1;
time:    { end = 0.1; };
fluid:   { gravity = (0, -9.81); };
domain:  { max = (4, 0.7); periodic = (true, false); };
walls:   ( { side = "y_min"; }, { side = "y_max"; }, { points = ((5.6, 0), (5.6, 0.2), (5.5, 0.2), (5.5, 0)); } );
shapes:  ( { form = "below"; level = 0.4; } );
sph:     { dx = 0.025; box = ((3.3, 0), (4.9, 0.7)); };
fv:      { cells = (160, 28); };
'''
refuses('walls.\\[2\\].points: at \\(5.*fv, which has no walls', over)
accepts(over.replace('5.6', '4.2').replace('5.5', '4.1'))
lib.end('%d faults' % lib.failed)
