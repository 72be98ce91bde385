"""Bed friction of fv (walls.friction, blocks.friction): a sheet that slows down and one on an incline, on cells and on blocks.
SPDX-License-Identifier: BSD-3-Clause"""
import math

import lib
from lib import close, last, refused, run_case, varied

lib.scratch()
# Water 0.1 m deep, 0.2 m long, viscous enough to move as one: nu/(c_f u d) = 10
sheet = '''format = 1;
time: { end = 2.0; };
fluid: { nu = 0.05; gravity = (0, -9.81); };
domain: { max = (0.2, 0.2); periodic = (true, false); };
shapes: ( { box = ((0, 0), (0.2, 0.1)); velocity = (1, 0); } );
walls: ( { side = "y_min"; friction = 0.05; } );
fv: { cells = (4, 16); };
output: { snapshots = false; };
'''
BLOCKS = 'fv: { }; blocks: ( { max = (0.2, 0.2); cells = (6, 16); j_max = "slip"; i_min = "periodic"; i_max = "periodic"; } );'
blocks = varied(sheet, 'fv: { cells = (4, 16); };', BLOCKS)
own = varied(blocks, 'walls: ( { side = "y_min"; friction = 0.05; } );', '', 'j_max', 'friction = 0.05; j_min = "slip"; j_max')


def velocity(folder):
    """Root of the mean square, m/s, by the kinetic energy; 20 kg/m of water."""
    return math.sqrt(last(folder, 'kinetic energy') / 10)


# du/dt = -c_f u^2/d: 1/(1 + 1) m/s, and as the bed's is less than the mean by u^2 c_f d/(3 nu) it slows down by 2 % less
run_case('sheet', sheet, program='fv')
close('velocity of a sheet on a rough floor, m/s', velocity('sheet'), 0.5, 0.025)
close('force on its floor, N/m', last('sheet', 'force x'), 1000 * 0.05 * 0.2 * velocity('sheet') ** 2, 0.04)
for case, text in ('blocks', blocks), ('own', own):
    run_case(case, text, program='fv')
    for title in 'kinetic energy', 'force x':
        close(case + ': ' + title, last(case, title), last('sheet', title), 1e-5)
# Steady flow: the floor carries the weight along it, 10 N/m, at c_f u^2 = g d on the bed; a parabola stands on that
run_case('incline', varied(sheet, '(0, -9.81)', '(0.5, -9.81)', 'end = 2.0', 'end = 4.0'), program='fv')
close('weight of a sheet down an incline, N/m', last('incline', 'force x'), 10, 0.005)
close('its velocity, m/s', velocity('incline'), math.sqrt(1.068), 0.01)
# so rough that a step would stop it many times over: nothing turns round
run_case('rough', varied(sheet, 'nu = 0.05; ', '', 'friction = 0.05', 'friction = 1', '(4, 16)', '(4, 64)', 'end = 2.0', 'end = 0.5'), program='fv')
lib.check(last('rough', 'force x') >= 0, 'a very rough floor pushes upstream')
refused('fv', varied(sheet, 'cells', 'integrator = "newton"; cells'), r'walls.\[0\].friction: is not used: newton has no bed friction')
refused('fv', varied(own, 'slip"; i', 'wall"; i', 'j_min = "slip"', 'j_min = "wall"'), r'blocks.\[0\].friction: .*none of the block')
lib.end('sheet %.4f m/s, incline %.4f m/s' % (velocity('sheet'), velocity('incline')))
