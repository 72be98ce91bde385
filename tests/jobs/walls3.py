"""Walls and bodies of triangles as a case has them: a body that goes with the stream, water beside a thin plate, tanks that are
turned and cut otherwise. SPDX-License-Identifier: BSD-3-Clause"""
import math

import lib
from lib import TANK, box_stl, changed, check, column, held, near, number, run_case, sides

lib.scratch()
FIVE = sides('x_min x_max y_min y_max z_min')
TANK3 = changed(TANK, fluid='gravity = (0, 0, -9.81);', domain='dim = 3; max = (1, 1, 1);', walls=FIVE)


def largest(name, title):
    return max(abs(value) for value in column(name, title))


# no force, no moment on a body that goes with the stream; over rho U^2 a^2 = 1.1e2 N
box_stl('cube.stl', (0.35, 0.35, 0.35), (0.65, 0.65, 0.65))
run_case('stream', changed(TANK3, time='end = 0.1;', fluid='', domain='dim = 3; max = (1, 1, 1); periodic = (true, true, true);', walls='',
                           shapes='', initial='field = "uniform"; U = 1.0; velocity = (1.0, 0.5, 0.0);',
                           bodies='{ name = "cube"; mesh = "cube.stl"; centre = (0.5, 0.5, 0.5); velocity = (1.0, 0.5, 0.0); }',
                           sph='dx = 0.0833333333333333333; R_dx = 2.5; c0 = 10.0; transport = "none";',
                           output='series = 1; snapshots = false;'))
for what in 'cube force x', 'cube force y', 'cube force z', 'cube moment x', 'cube moment z':
    check(largest('stream', what) < 1e-7, 'stream: %s is %g' % (what, largest('stream', what)))

# a thin plate, solid or a sheet, with water of 0.5 m on one side and air on the other: nothing gets through, and the
# water does not know of the other side; nor does a gauge there, or a free body behind the sheet
box_stl('plate.stl', (0.49, -0.2, -0.2), (0.51, 0.7, 1.2))
box_stl('sheet.stl', (0.5, -0.2, -0.2), (0.52, 0.7, 1.2), 'xp ym yp zm zp')
for name, side in ('plate', 'outside'), ('sheet', 'sheet'):
    run_case(name, changed(TANK3, time='end = 0.3;', domain='dim = 3; max = (1, 0.4, 1);', initial='field = "rest"; U = 2.2;',
                           walls=FIVE + ', { mesh = "%s.stl"; thin = true; fluid_side = "%s"; }' % (name, side),
                           shapes='{ form = "box"; box = ((0, 0, 0), (0.49, 0.4, 0.5)); }', sph='dx = 0.05; R_dx = 2.5; c0 = 30.0;',
                           probes='{ name = "right"; kind = "level"; at = (0.65, 0.2, 0); }, { name = "dry"; at = (0.53, 0.2, 0.1); }'))
    held(name, 1e-10)
    check(largest(name, 'dry') == 0, '%s: a gauge behind it reads %g Pa' % (name, largest(name, 'dry')))
    check(largest(name, 'right') == 0, '%s: %g m of water behind it' % (name, largest(name, 'right')))
    check(number(name, 'max_mach') < 5e-3, '%s: Mach %g beside it' % (name, number(name, 'max_mach')))

run_case('behind', changed(open('sheet.cfg').read(), bodies='{ name = "cube"; free = true; density = 600; box = ((0.65, 0.1, 0.1), (0.85, 0.3, 0.3)); }'),
         '--check')

# a cube of six particles that stands on the floor under water: p A on its top, 3 %, and nothing to a side
box_stl('block.stl', (0.3, 0.3, 0), (0.7, 0.7, 0.4))
run_case('block', changed(TANK3, time='end = 0.3;', domain='dim = 3; min = (0.1, 0.1, 0); max = (0.9, 0.9, 1);',
                          shapes='{ form = "below"; level = 0.7; }', bodies='{ name = "block"; mesh = "block.stl"; }', sph='dx = "1/15";'))
check(-485.1 < number('block', 'force.z') < -456.8, 'block: %g N, wanted -470.9 N within 3 %%' % number('block', 'force.z'))
for way in 'x', 'y':
    check(abs(number('block', 'force.' + way)) < 1, 'block: pushed along %s by %g N' % (way, number('block', 'force.' + way)))
# half of a ball stands in the floor, a cube in an upright side: their lift less the push of water on what is cut off, p A of
# the cut within 3 %
for name, body, lift, push in (
        ('ball', 'centre = (0.5, 0.5, 0); radius = 0.25', 9810 * 2 / 3 * math.pi * 0.25 ** 3, 9810 * 0.7 * math.pi * 0.25 ** 2),
        ('pier', 'box = ((-0.3, 0.3, 0.2), (0.4, 0.7, 0.5))', 9810 * 0.3 * 0.4 * 0.3, None))[:2 if lib.long else 1]:
    run_case(name, changed(TANK3, time='end = 0.3;', domain='dim = 3; min = (0.1, 0.1, 0); max = (0.9, 0.9, 1);',
                           shapes='{ form = "below"; level = 0.7; }', bodies='{ name = "b"; %s; }' % body,
                           sph='dx = "1/15"; R_dx = 3.0;'), words='what of it is beyond closed sides or behind lines is left out')
    near(name + ': its lift', number(name, 'force.z'), lift - (push or 0), 0.03 * (push or 9810 * 0.35 * 0.4 * 0.3))
    check(number(name, 'particles_returned') == 0, '%s: particles put back' % name)
run_case('block', None, '--check', '-p', 'sph.R_dx=2.5', words='R_dx = 2.5: the lift of bodies under water is')

# the same tank as sides of the domain, as a mesh, and turned by 30 degrees: nobody lost, and when what the start has
# stirred is over, |u| below 1e-3 c0 in the mean of squares
box_stl('tank.stl', (0, 0, 0), (0.6, 0.6, 0.8))
plain = changed(TANK3, time='end = 0.7;', domain='dim = 3; max = (0.6, 0.6, 0.8);', initial='field = "rest"; U = 2.0;',
                shapes='{ form = "below"; level = 0.4; }', sph='dx = 0.05; R_dx = 2.5; c0 = 25.0;', output='series = 5; snapshots = false;')
speeds = []
turned = changed(plain, walls='{ mesh = "tank.stl"; rotate = (0, 0, 30); }',
                 domain='dim = 3; min = (-0.35, -0.05, 0); max = (0.6, 0.9, 0.8);')
for name, case in ('sides', plain), ('mesh', changed(plain, walls='{ mesh = "tank.stl"; }')), ('turned', turned):
    run_case(name, case)
    held(name, 1e-10)
    squares = [2 * k / m for t, k, m in zip(column(name, 't ['), column(name, 'kinetic'), column(name, 'mass')) if t > 0.5]
    speeds.append((sum(squares) / len(squares)) ** 0.5 / 25)
    check(speeds[-1] < 1e-3, '%s: |u| is %g c0' % (name, speeds[-1]))
# a mesh on the sides of the domain holds the water as these do: its weight is there from the start
deepest = {name: column(name, 'max density')[0] - 1000 for name in ('mesh', 'sides')}
check(deepest['mesh'] > 0.95 * deepest['sides'], 'mesh: starts with a density of 1000 + %g kg/m^3' % deepest['mesh'])

# a lid that drives a cavity: the work that it does is no energy from nowhere (the watch of the run would end it)
run_case('lid', changed(TANK3, time='end = 1;', fluid='nu = 0.01;',
                        domain='dim = 3; max = (1, "7/12", 1); periodic = (false, true, false);', initial='field = "rest"; U = 1.0;',
                        shapes='', sph='dx = "1/12"; R_dx = 2.5; c0 = 10.0;',
                        walls=sides('x_min x_max z_min', 'no_slip') + ', { side = "z_max"; kind = "no_slip"; velocity = (1, 0, 0); }'))
check(number('lid', 'watch.energy_gain') < 0.03, 'lid: %g of the energy from nowhere' % number('lid', 'watch.energy_gain'))
lib.end('%d faults; |u|/c0 %.2g, %.2g, %.2g' % (lib.failed, *speeds))
