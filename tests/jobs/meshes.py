"""Scenes between meshes, as a user makes them: a tank at rest is as still however it is turned, in millimetres as in kilometres,
on one rank as on two; nobody gets out; ParaView's files name what is there. SPDX-License-Identifier: BSD-3-Clause"""
import re

import lib
from lib import TANK, bad, box_stl, changed, check, held, last, number, run, run_case, says, sides, write

lib.scratch()
box_stl('tank.stl', (-0.4, -0.3, -0.3), (0.4, 0.3, 0.3))
box_stl('cube.stl', (-0.1, -0.1, -0.1), (0.1, 0.1, 0.1))
TANK3 = changed(TANK, fluid='rho = 1000.0; gravity = (0, 0, -9.81);', sph='dx = 0.05; R_dx = 2.5;')
TURN = 10, 20, 15


def tank(size, turn, end):
    """Of that size in units of the file, turned about its middle."""
    def times(*values):
        return ', '.join('%.9g' % (value * size) for value in values)
    return changed(TANK3, time='end = %.9g;' % (end * size ** 0.5), domain='dim = 3; max = (%s);' % times(1, 1, 1),
                   shapes='{ form = "below"; level = %s; }' % times(0.55), sph='dx = %s; R_dx = 2.5;' % times(0.05),
                   walls='{ mesh = "tank.stl"; scale = %g; rotate = (%g, %g, %g); translate = (%s); }'
                   % (size, *turn, times(0.5, 0.5, 0.5)))


def within(a, b, factor, what):
    """They are positive and do not differ by more."""
    check(0 < a <= factor * b and b <= factor * a, '%s: %g and %g' % (what, a, b))


write('straight.cfg', tank(1, (0, 0, 0), 0.5))
lib.start('sph', 'straight.cfg', '--check')
if says('built without a reader'):
    lib.end('no reader of meshes in this build')
run_case('straight')
run_case('turned', tank(1, TURN, 0.5))
for name, size, ranks in ('short', 1, 1), ('ranks', 1, 2), ('small', 0.001, 1), ('large', 1000, 1):
    run_case(name, tank(size, TURN, 0.2), ranks=ranks)
for name in 'straight', 'turned', 'ranks':
    held(name)
    check(0 < number(name, 'max_mach') < 0.01, '%s: not still, Ma %g' % (name, number(name, 'max_mach')))
within(last('straight', 'kinetic energy'), last('turned', 'kinetic energy'), 4, 'kinetic energy of a straight and a turned tank')
within(last('short', 'kinetic energy'), last('ranks', 'kinetic energy'), 1.000000001, 'kinetic energy on one rank and on two')
within(number('short', 'particles'), number('ranks', 'particles'), 1, 'particles on one rank and on two')
for name in 'small', 'large':
    within(number('short', 'particles'), number(name, 'particles'), 1, 'particles of tanks of 1 m and ' + name)
    within(number('short', 'max_mach'), number(name, 'max_mach'), 1.001, 'Mach number of tanks of 1 m and ' + name)

# what is written: a free cube floats up, with its places in each snapshot
afloat = changed(TANK3, time='end = 0.02;', domain='dim = 3; max = (0.8, 0.6, 0.6);', shapes='{ form = "below"; level = 0.45; }',
                 walls='{ mesh = "tank.stl"; translate = (0.4, 0.3, 0.3); }', output='',
                 bodies='{ name = "cube"; mesh = "cube.stl"; translate = (0.4, 0.3, 0.25); density = 500; free = true; }')
run_case('float', afloat, ranks=2)
view = open('float/sph_walls.xdmf').read()
for path, data in re.findall(r'>(sph_[a-z0-9_]*\.h5):([^<]*)<', view):
    if run('h5dump', '-d', data, '-H', 'float/' + path):
        bad('sph_walls.xdmf names %s of %s, which is not there' % (data, path), 'out.txt')
check('.h5:' in view and view.count('<Time') == 2, 'sph_walls.xdmf has %d times, wanted 2' % view.count('<Time'))
for solid, low, high in ('cube', 0.00799, 0.00801), ('tank', 0.2879, 0.2881):
    volume = number('float', 'mesh.%s.volume' % solid)
    check(low < volume < high, 'volume of the mesh %s in summary.json: %g' % (solid, volume))
check(last('float', 'cube z') > 0.2503, 'the light cube does not rise: z = %g' % last('float', 'cube z'))

# a tank without a floor: refused where its rim ends in the water, run where that is closed by a side of the domain, or
# as a thin wall; an open top in the air is none of this
box_stl('tube.stl', (0.3, 0.3, 0.3), (0.7, 0.7, 0.9), 'zm zp', -1)
box_stl('bowl.stl', (0.3, 0.3, 0.3), (0.7, 0.7, 0.9), 'zp', -1)


def rim(mesh, floor=0, more=''):
    return changed(TANK3, time='end = 0.01;', domain='dim = 3; min = (0, 0, %g); max = (1, 1, 1);' % floor,
                   walls='{ mesh = "%s.stl"; %s }, ' % (mesh, more) + sides('z_min x_min x_max y_min y_max'),
                   shapes='{ form = "box"; box = ((0.3, 0.3, 0.3), (0.7, 0.7, 0.6)); }')


run_case('hole', rim('tube'), code=2, words='mesh tube ends in the water at .*thin = true')
run_case('thin', rim('tube', more='thin = true;'))
run_case('floor', rim('tube', 0.3))
run_case('bowl', rim('bowl'))


def forecast(z, radius=0.15):
    """Run time in s that --check says, with a ball at that height."""
    write('ball.cfg', changed(TANK3, domain='dim = 3; max = (0.8, 0.6, 1.2);', walls=sides('z_min x_min x_max y_min y_max'),
                              shapes='{ form = "box"; box = ((0, 0, 0), (0.8, 0.6, 0.6)); }', time='end = 0.5;',
                              bodies='{ name = "ball"; radius = %g; centre = (0.4, 0.3, %g); }' % (radius, z), sph='dx = 0.05; c0 = 40;'))
    lib.start('sph', 'ball.cfg', '--check')
    said = re.search(r'^run time.* ([0-9.e+]+) (s|min|h) of', open('out.txt').read(), flags=re.M)
    return float(said[1]) * {'s': 1, 'min': 60, 'h': 3600}[said[2]]


# the forecast counts the triangles that have particles near them: a ball in water costs three times the tank alone, one in the air nothing
wet, dry = forecast(0.3), forecast(1)
check(2 * dry < wet < 8 * dry, 'forecast with a ball in the water, above it: %g, %g s' % (wet, dry))
forecast(0.3, 0.12)
check(not says('smooth surface'), 'facets that sph makes itself are warned of')
lib.end('%d faults' % lib.failed)
