#!/usr/bin/python3
"""No key is passed over in silence: in small scenes of every kind, of sph and of fv, each key of the table is set to another value;
the run is refused (exit code 2), or what it writes differs. A key of --params that has no value below is a failure, too.
usage: tests/jobs/unused.py [BUILD] [MODE...]; by default some modes, "all", as LONG=1, for each. SPDX-License-Identifier: BSD-3-Clause"""
import glob
import os
import re
import shutil
import subprocess
import sys

import lib
from lib import bad, start, write

# Groups: what each key is set to, between bars. In lists: the first wall, body, shape, probe.
VALUES = '''
time: end 0.043
fluid: rho 700 | nu 0.02 | gravity (0.3,-7) | central 2
domain: dim 3 | min (-1.2,-0.8) | max (1.2,1.2) | periodic (true,false)
initial: field taylor_green | U 1.7 | L 0.7 | velocity (0.1,0.2) | amplitude 0.03 | L_z 0.5 | level 0.9
    seed ((0.9,0.9,0.9)) | crest 0.3
coupling: steps 7 | transition 0.15 | buffer 0.15 | overlap 0.15 | memory 3 | keep_mass false | mapping shepard
    interpolation linear | in_time linear | blend all | deadline 7
output: every 0.003 | snapshots true | series 2 | checkpoint 0.002
sph: dx 0.08 | R_dx 3 | c0 17 | gamma 1 | scheme standard | riemann exact | limiter minmod | transport none
    surface_shift beta | viscosity monaghan | low_dissipation false | dissipation 0.4 | dissipation_order third | damper 0.4 | alpha 0.05
    delta 0.1 | background true | integrator rk4 | cfl 0.2 | cfl_viscous 0.0001 | box ((-1,-1),(1,0.5))
    free ((-1,-1),(1,0.5)) | box_velocity (0.1,0) | box_follows b | outer exact | density_limit 1e-6 | walls ghosts
    wall_integrals clipped | births vertices | surface yes | packing 7 | noise 0.1 | extrema (-0.3,0.2,-0.2)
walls: side "x_max" | points ((-1,-0.5),(1,-0.5)) | closed true | kind "no_slip" | velocity (0.2,0) | friction 0.05
    beach 0.2 | beach_period 0.7 | profile "parabolic" | pressure 100.0 | carried true | level 0.3
    level_file "nowhere.txt" | discharge_file "nowhere.txt" | discharge 0.02 | mesh "other.stl"
    outline "other.csv" | scale 0.9 | rotate (0,0,20) | translate (0.05,0,0) | weld 5 | fluid_side "outside"
    flip true | thin true
gauges: name other | probes "a b" | from 0.01 | period 0.3 | depth 0.5
waves: kind sea | height 0.12 | length 1.2 | period 0.8 | depth 0.9 | direction 10.0 | at (0.2,0.1) | start 1.0
    current 0.1 | closed false | zone 0.4 | peak 2.0 | repeat 50.0 | seed 3 | order 1 | evolve hos
    file nowhere.swd | spread 8.0
bodies: name "other" | mesh "other.stl" | outline "other.csv" | scale 0.9 | rotate (0,0,20) | translate (0.05,0,0)
    box ((-0.3,-0.4),(0.2,-0.1)) | radius 0.25 | length 0.4 | weld 5 | thin true | points ((-0.3,-0.4),(-0.3,-0.1),(0.2,-0.1),(0.2,-0.4)) | kind "no_slip" | centre (0.1,0.1)
    velocity (0.1,0) | spin 0.5 | motion "nowhere.txt" | force (3,4) | free true | density 700 | mass 7 | inertia 7
    lock "y" | release 0.01 | force_rule "average" | load (3,4) | torque 5
    lines ({from=(-0.2,0.2);to=(-0.2,0.8);damping=3.0;}) | hinge {at=(0.5,0.1);} | slider {axis=(1,1);}
    contact {gap=2.0;}
bodies.motion: kind "polynomial" | file "nowhere.txt" | axis "y" | amplitude 0.02 | period 0.2 | phase 0.3
    coefficients (1,2) | from 0.01 | until 0.02 | ramp 0.02 | absorb true
bodies.lines: from (0.2,0.2) | to (0.2,0.7) | body "b" | stiffness 300 | length 0.3 | damping 30 | pull_only true
bodies.hinge: at (0.3,0.2) | axis (0,1,1) | stiffness 300 | damping 30 | at_rest 0.4
bodies.slider: axis (1,1)
bodies.contact: restitution 0.6 | friction 0.6 | gap 1.2
shapes: form "disc" | box ((-1,-1),(0.3,0.2)) | points ((-1,-1),(1,-1),(0,0.5)) | centre (0.1,0.1) | radius 0.5
    level 0.3 | mesh "other.stl" | outline "other.csv" | scale 0.7 | rotate (0,20,0) | translate (0.3,0,0) | weld 5
    hole true | velocity (0.2,0)
probes: name "other" | kind "level" | at (0.2,-0.7) | to (0.3,-0.7) | radius 0.5 | body "b"
apr: levels 3 | margin 2.0 | around 4 | particles 6000 | method weights | guards shepard | local_steps true
    unshifted_finest true | regions ({min=(-0.8,-0.8);max=(0.7,0.7);}) | criteria ({kind="vorticity";above=0.02;})
apr.regions: level 1 | shape "sphere" | min (-0.4,-0.35) | max (0.4,0.45) | centre (0.1,0.1) | radius 0.5 | body "b"
    wall 1 | offset 0.4 | velocity (0.3,0) | motion ({kind="harmonic";axis="x";amplitude=0.02;period=0.2;})
    follow "peak" | along "x" | pressure 10.0
apr.regions.motion: kind "polynomial" | file "nowhere.txt" | axis "y" | amplitude 0.03 | period 0.3 | phase 0.3
    coefficients (1,2) | from 0.01 | until 0.02 | ramp 0.02 | absorb true
apr.criteria: level 2 | kind "pressure" | above 0.055 | distance 2
fv: cells (14,20) | graded (0.4,8) | cfl 0.3 | integrator bdf2 | steady true | surface yes | tol_pressure 0.9 | tol_viscous 0.5
    tol_newton 1e-2 | flux upwind | dual_time true | pseudo_cfl 0.3 | pseudo_memory 2 | hole ((0.3,0.3),(0.7,0.7))
    c0 30 | upwind 0.7 | extrema (-0.3,0.2,-0.2) | volume false
blocks: mapping "stretched" | cells (14,20) | min (0.1,0.1) | max (0.9,0.9) | centre (0.4,0.6) | angle 10.0
    focus (0.4,0.4) | stretch (0.5,0.5) | radius (0.4,0.9) | arc (0,90) | file "nowhere.txt" | zone 2 | shear 0.1 | wave 0.04
    i_min "slip" | i_max "outflow" | j_min "slip" | j_max "outflow" | k_min "slip" | k_max "slip" | velocity (0.8,0.1)
    friction 0.05 | lid "j_min" | spin (1.5,0.5) | motion ({kind="harmonic";axis="x";amplitude=0.02;period=0.2;})
blocks.motion: kind "polynomial" | file "nowhere.txt" | axis "y" | amplitude 0.03 | period 0.3 | phase 0.3
    coefficients (1,2) | from 0.01 | until 0.02 | ramp 0.02 | absorb true
blocked: min (0.3,0) | max (0.5,0.3) | kind "slip"
'''
# Where a run is written (checkpoint_wall: by the clock; fields: in snapshots, which are off here; tests/jobs/bad_input.py has
# the words of it), what judges it, what wants eight rows, what binds where pseudo steps do not converge, and headings.
EXCEPTIONS = 'output.checkpoint_wall', 'output.fields', 'fv.force', 'fv.pseudo_steps', 'blocks.name', 'blocked.name'
# Scenes in which another value is wanted, by mode and key; None: the key rightly changes nothing there.
OTHERS = '''
cube    sph.walls nfm | domain.dim 2
dam     domain.max (0.3,1.2)
float   bodies.free false | sph.viscosity morris | bodies.contact None
hinge   bodies.free false | sph.viscosity morris | bodies.contact None
touch   bodies.free false | bodies.contact.friction None
mesh    sph.viscosity morris | domain.dim 2 | sph.packing 0 | bodies.thin None
wave    sph.viscosity morris | walls.kind "slip" | domain.periodic (false,false)
lines   sph.viscosity morris | walls.kind "slip"
swirls  sph.dx 0.04 | sph.cfl_viscous 0.001
delta   sph.surface None
box     sph.outer None | domain.dim None | domain.min None | domain.max None | domain.periodic None
body    sph.background None
cavity  walls.kind "slip"
newton  walls.kind "slip"
steady  walls.kind "slip" | fv.steady false | time.end None
dual_time walls.kind "slip" | fv.dual_time false
ring    domain.min None | domain.max None
overlapping domain.min None | domain.max None
sheared domain.min None | domain.max None
stream  domain.min None | domain.max None
lid     domain.min None | domain.max None
bdf2    fv.cfl 0.1
couette fv.tol_pressure None | fv.upwind None
'''
# Why: dam: the water is far from the wall. float, hinge: they touch nothing; monaghan is what auto takes there. touch: a slider
# does not slip. mesh: it is thicker than what particles see. delta: looked for, and not found in a full box. box: the word for
# what a box takes by itself; what a box in an exact solution must lie in, no more. body: it lifts negative pressures, which
# are none in a tank at rest. steady: a march ends by itself. ring and other blocks: the domain bounds them, no
# more. bdf2: something else bounds its step. couette: in a flow of one dimension nothing is projected or biased.

OPEN = '''domain:  { dim = 2; min = (-1, -1); max = (1, 1); };
walls: ( { side = "y_min"; #walls
 }, { side = "x_min"; }, { side = "x_max"; } );
'''
BOX = OPEN.replace('"x_max"; }', '"x_max"; }, { side = "y_max"; }')
TANK = 'fluid: { rho = 1000.0; gravity = (0, -9.81); nu = 0.01; };\ninitial: { U = 3.0; };\n'
SQUARE = 'points = ((-0.2, -0.2), (-0.2, 0.2), (0.2, 0.2), (0.2, -0.2));'
SCENES = {
    'vortices': '''fluid: { rho = 1.0; nu = 0.01; };
domain: { dim = 2; min = (-1, -1); max = (1, 1); periodic = (true, true); };
initial: { field = "taylor_green"; U = 1.0; L = 2.0; };
sph: { dx = 0.1; };''',
    'delta': '''fluid: { rho = 1.0; };
domain: { dim = 2; min = (-1, -1); max = (1, 1); periodic = (true, true); };
initial: { field = "taylor_green"; U = 1.0; L = 2.0; };
sph: { dx = 0.1; scheme = "delta"; };''',
    'dam': OPEN + '''probes: ( { name = "p"; at = (0.1, -0.9); #probes
 } );
fluid: { rho = 1000.0; gravity = (0, -9.81); };
initial: { U = 3.0; };
shapes: ( { form = "box"; box = ((-1, -1), (0, 0)); #shapes
 } );
sph: { dx = 0.1; c0 = 30.0; };''',
    'body': BOX + TANK + '''bodies: ( { name = "b"; ''' + SQUARE + ''' #bodies
 } );
sph: { dx = 0.1; c0 = 30.0; packing = 5; };''',
    'float': BOX + TANK + '''shapes: ( { form = "below"; level = 0.0; } );
bodies: ( { name = "b"; ''' + SQUARE + ''' free = true; density = 600.0; lock = "x"; #bodies
 motion = ( { kind = "harmonic"; axis = "x"; amplitude = 0.01; period = 0.1; #motion
 } );
 lines = ( { from = (-0.2, 0.2); to = (-0.2, 0.8); stiffness = 200.0; length = 0.65; #lines
 } );
 } );
sph: { dx = 0.1; c0 = 30.0; packing = 5; };''',
    'hinge': BOX + TANK + '''shapes: ( { form = "below"; level = 0.0; } );
bodies: ( { name = "b"; ''' + SQUARE + ''' free = true; density = 600.0; #bodies
 hinge = { at = (0.5, 0.1); stiffness = 200.0; #hinge
 };
 } );
sph: { dx = 0.1; c0 = 30.0; packing = 5; };''',
    'touch': BOX + '''fluid: { rho = 1000.0; nu = 0.01; };
initial: { U = 3.0; };
bodies: ( { name = "b"; points = ((-0.2, -0.845), (-0.2, -0.5), (0.2, -0.5), (0.2, -0.845)); free = true; density = 600.0; velocity = (0.5, -2.0); #bodies
 slider = { axis = (0, 1); #slider
 };
 contact = { restitution = 0.3; #contact
 };
 }, { name = "c"; points = ((0.5, 0.5), (0.5, 0.8), (0.8, 0.8), (0.8, 0.5)); free = true; mass = 50.0; inertia = 3.0; centre = (0.65, 0.65); } );
sph: { dx = 0.1; c0 = 30.0; packing = 5; };''',
    'box': '''fluid: { rho = 1.0; nu = 0.01; };
domain: { dim = 2; min = (-1, -1); max = (1, 1); periodic = (true, true); };
initial: { field = "uniform"; velocity = (1, 0.5); };
sph: { dx = 0.04; R_dx = 2.0; box = ((-0.8, -0.8), (0.8, 0.8)); };''',
    'channel': '''fluid: { rho = 1.0; nu = 0.01; };
domain: { dim = 2; min = (-1, -1); max = (1, 1); };
initial: { field = "uniform"; velocity = (1, 0); };
walls: ( { side = "x_min"; kind = "inflow"; velocity = (1, 0); #walls
 }, { side = "x_max"; kind = "outflow"; }, { side = "y_min"; }, { side = "y_max"; } );
sph: { dx = 0.1; R_dx = 2.0; };''',
    'cube': '''fluid: { rho = 1000.0; gravity = (0, 0, -9.81); };
domain: { dim = 3; min = (-1, -1, -1); max = (1, 1, 1); };
walls: ( { side = "z_min"; #walls
 }, { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
initial: { U = 3.0; };
shapes: ( { form = "below"; level = 0.0; #shapes
 } );
sph: { dx = 0.2; R_dx = 2.5; c0 = 30.0; };''',
    'mesh': '''fluid: { rho = 1000.0; gravity = (0, 0, -9.81); nu = 0.01; };
domain: { dim = 3; min = (-1, -1, -1); max = (1, 1, 1); };
walls: ( { mesh = "tank.stl"; #walls
 } );
bodies: ( { mesh = "cube.stl"; #bodies
 } );
initial: { U = 3.0; };
shapes: ( { form = "mesh"; mesh = "water.stl"; #shapes
 } );
sph: { dx = 0.2; R_dx = 2.5; c0 = 30.0; packing = 3; };''',
    'regions': '''fluid: { rho = 1.0; nu = 0.01; };
domain: { dim = 2; min = (-1, -1); max = (1, 1); periodic = (true, true); };
initial: { field = "taylor_green"; U = 1.0; L = 2.0; };
sph: { dx = 0.0625; R_dx = 2.5; };
apr: { regions = ( { level = 2; min = (-0.4, -0.3); max = (0.4, 0.3); #regions
 } ); };''',
    'swirls': '''fluid: { rho = 1.0; nu = 0.01; };
domain: { dim = 2; min = (-1, -1); max = (1, 1); periodic = (true, true); };
initial: { field = "taylor_green"; U = 1.0; L = 2.0; };
sph: { dx = 0.05; R_dx = 2.5; };
apr: { around = 2; criteria = ( { kind = "vorticity"; above = 0.24; #criteria
 } ); };''',
    'wave': '''fluid: { rho = 1.0; nu = 0.002; gravity = (0, -1); };
domain: { dim = 2; min = (-1, -1); max = (1, 1); periodic = (true, false); };
walls: ( { side = "y_min"; kind = "no_slip"; #walls
 } );
initial: { field = "standing_wave"; U = 0.1; L = 2.0; amplitude = 0.05; level = 0.0; };
sph: { dx = 0.1; c0 = 10.0; };''',
    'train': '''fluid: { rho = 1000.0; gravity = (0, -9.81); };
domain: { dim = 2; min = (-1, -1); max = (1, 1); };
initial: { U = 3.0; };
walls: ( { side = "x_min"; kind = "wave"; #walls
 }, { side = "x_max"; kind = "beach"; beach = 0.5; beach_period = 0.6; }, { side = "y_min"; } );
shapes: ( { form = "below"; level = 0.0; #shapes
 } );
sph: { dx = 0.1; c0 = 30.0; };
waves: { height = 0.05; length = 0.7; start = 0.05; #kind
};''',
    'drop': '''fluid: { rho = 1.0; central = 1.0; };
domain: { dim = 2; min = (-1, -1); max = (1, 1); };
initial: { field = "drop"; L = 0.5; };
sph: { dx = 0.1; };''',
    'lines': '''fluid: { rho = 1000.0; nu = 0.01; gravity = (0, -9.81); };
domain: { dim = 2; min = (-1, -1); max = (1, 1); };
initial: { U = 3.0; };
walls: ( { points = ((-1, 1), (-1, -1), (0.5, -1), (1, -0.5), (1, 1)); kind = "no_slip"; #walls
 } );
shapes: ( { form = "below"; level = 0.8; #shapes
 } );
sph: { dx = 0.1; c0 = 30.0; scheme = "delta"; };''',
}
# --- scenes of fv ---
UNIT = 'domain: { dim = 2; min = (0, 0); max = (1, 1); };\n'
ROUND = UNIT.replace('(1, 1)', '(1, 1); periodic = (true, true)') + '''initial: { field = "two_modes"; U = 0.9; L = 0.5; velocity = (0.5, 0.25); };
'''
VISCOUS = ROUND + 'fluid: { nu = 0.005; };\n'
CAVITY = UNIT + '''fluid: { nu = 0.01; };
walls: ( { side = "x_min"; kind = "no_slip"; #walls
 }, { side = "x_max"; kind = "no_slip"; }, { side = "y_min"; kind = "no_slip"; }, { side = "y_max"; kind = "no_slip"; velocity = (1, 0); } );
'''
SLIPPERY = CAVITY.replace('no_slip', 'slip').replace(' velocity = (1, 0);', '').replace('nu = 0.01;', 'nu = 1e-3; gravity = (0, -9.81);')
DUCT = UNIT + '''fluid: { nu = 0.01; };
walls: ( { side = "x_min"; kind = "inflow"; velocity = (1, 0); #walls
 }, { side = "x_max"; kind = "outflow"; }, { side = "y_min"; kind = "no_slip"; }, { side = "y_max"; kind = "slip"; } );
'''
GAUGE = 'probes: ( { name = "p"; at = (0.5, 0.2); #probes\n } );\n'
ALONG = 'domain: { dim = 2; max = (1, 1); periodic = (true, false); };\n'
FV_SCENES = {
    'periodic': VISCOUS + 'fv: { cells = (12, 12); };',
    'inviscid': ROUND + 'fv: { cells = (12, 12); cfl = 0.6; };',
    'bdf2': VISCOUS + 'fv: { cells = (12, 12); integrator = "bdf2"; cfl = 0.4; };',
    'hole': VISCOUS + 'fv: { cells = (16, 16); hole = ((0.3, 0.3), (0.7, 0.7)); };',
    'exact': VISCOUS.replace(' periodic = (true, true);', '') + 'fv: { cells = (12, 12); };',
    'cavity': CAVITY.replace('0.01;', '0.01; gravity = (0, -9.81);') + GAUGE + 'fv: { cells = (12, 12); };',
    'newton': CAVITY + 'fv: { cells = (8, 8); integrator = "newton"; cfl = 2; };',
    'steady': CAVITY + 'fv: { cells = (8, 8); integrator = "newton"; steady = true; };',
    'dual_time': CAVITY + 'fv: { cells = (8, 8); integrator = "newton"; cfl = 2; dual_time = true; };',
    'duct': DUCT + GAUGE + 'fv: { cells = (12, 12); };',
    'carried': DUCT.replace('(1, 0);', '(1, 0); profile = "parabolic";').replace('outflow";', 'outflow"; carried = true;').replace('slip', 'no_slip')
               .replace('no_no', 'no') + 'fv: { cells = (12, 12); };',
    'graded': ALONG + '''fluid: { nu = 0.01; gravity = (0.8, 0); };
initial: { field = "taylor_green"; };
walls: ( { side = "y_min"; kind = "slip"; #walls
 }, { side = "y_max"; kind = "no_slip"; } );
fv: { cells = (8, 20); graded = (0.5, 12); };''',
    'couette': ALONG + '''fluid: { nu = 0.1; };
initial: { field = "couette"; };
walls: ( { side = "y_min"; kind = "no_slip"; #walls
 }, { side = "y_max"; kind = "no_slip"; velocity = (1, 0); } );
fv: { cells = (8, 12); cfl = 0.2; };''',
    'water': SLIPPERY + '''shapes: ( { form = "box"; box = ((0, 0), (0.5, 0.6)); #shapes
 }, { form = "disc"; centre = (0.3, 0.3); radius = 0.1; hole = true; }, { form = "below"; level = 0.21; },
 { form = "polygon"; points = ((0.6, 0.1), (0.9, 0.1), (0.75, 0.5)); } );
probes: ( { name = "p"; at = (0.2, 0.05); #probes
 }, { name = "h"; kind = "level"; at = (0.2, 0); } );
fv: { cells = (16, 16); };''',
    'boxes': SLIPPERY + '''shapes: ( { box = ((0, 0), (0.5, 0.6)); #shapes
 } );
initial: { field = "uniform"; velocity = (0.3, 0.1); };
blocked: ( { name = "a"; min = (0.25, 0); max = (0.5, 0.25); kind = "no_slip"; #blocked
 } );
fv: { cells = (16, 16); };''',
    'swell': '''domain: { dim = 2; max = (4, 1.25); periodic = (true, false); };
fluid: { nu = 2e-3; gravity = (0, -1); };
initial: { field = "standing_wave"; L = 4; amplitude = 0.05; level = 1; };
walls: ( { side = "y_min"; kind = "no_slip"; #walls
 }, { side = "y_max"; } );
fv: { cells = (16, 10); };''',
    'stokes': '''domain: { dim = 2; min = (0, -1); max = (1, 0.5); periodic = (true, false); };
fluid: { nu = 0.02; gravity = (0, -1); };
initial: { field = "stokes"; L = 1; amplitude = 0.05; level = 0; };
walls: ( { side = "y_min"; #walls
 }, { side = "y_max"; } );
fv: { cells = (16, 24); };''',
    'beltrami': '''domain: { dim = 3; max = (1, 1, 1); periodic = (true, true, true); };
initial: { field = "beltrami"; velocity = (0.5, 0.25, 0.125); };
fluid: { nu = 0.1; };
fv: { cells = (8, 8, 8); };''',
    'ring': '''domain: { dim = 2; min = (-1, -1); max = (1, 1); };
fluid: { nu = 0.05; };
initial: { field = "couette"; };
blocks: ( { name = "ring"; mapping = "annulus"; radius = (0.5, 1.0); cells = (6, 24); spin = (2.0, -0.5); i_min = "wall"; i_max = "wall"; j_min = "joined"; j_max = "joined"; #blocks
 } );
fv: { };''',
    'overlapping': VISCOUS + '''blocks: ( { name = "a"; cells = (24, 24); i_min = "periodic"; i_max = "periodic"; j_min = "periodic"; j_max = "periodic"; },
 { name = "b"; cells = (14, 14); min = (0.25, 0.25); max = (0.75, 0.75); centre = (0.5, 0.5); angle = 20.0; #blocks
 } );
fv: { };''',
    'sheared': VISCOUS + '''blocks: ( { name = "a"; cells = (12, 12); mapping = "sheared"; wave = 0.06; i_min = "periodic"; i_max = "periodic"; j_min = "periodic"; j_max = "periodic"; #blocks
 } );
fv: { };''',
    'stream': '''domain: { dim = 2; min = (-3, -3); max = (5, 3); };
fluid: { nu = 0.01; gravity = (0, -9.81); };
initial: { field = "uniform"; velocity = (1.0, 0.2); };
blocks: ( { name = "s"; mapping = "stretched"; min = (-3, -3); max = (5, 3); cells = (28, 26); focus = (0, 0); stretch = (2, 2); velocity = (1, 0); i_min = "inflow"; i_max = "outflow"; j_min = "slip"; j_max = "slip"; #blocks
 }, { name = "c"; mapping = "annulus"; radius = (0.5, 2.4); stretch = (1.0, 0); cells = (12, 32); i_min = "wall"; j_min = "joined"; j_max = "joined"; } );
fv: { };''',
    'zone': '''domain: { dim = 2; max = (3, 0.5); };
fluid: { gravity = (0, -9.81); };
shapes: ( { form = "below"; level = 0.25; #shapes
 } );
walls: ( { side = "x_min"; kind = "wave"; #walls
 }, { side = "x_max"; kind = "beach"; }, { side = "y_min"; }, { side = "y_max"; } );
waves: { kind = "focused"; height = 0.05; length = 0.9; zone = 0.3; start = 0.1; order = 1; };
fv: { cells = (24, 12); };''',
    'lid': UNIT + '''fluid: { nu = 0.01; };
blocks: ( { name = "a"; cells = (8, 8); velocity = (1, 0); lid = "j_max"; i_min = "wall"; i_max = "wall"; j_min = "wall"; j_max = "wall"; #blocks
 } );
fv: { };''',
}
SCENES['group'] = SCENES['train'].replace('#kind', 'kind = "focused";')
SCENES.update(FV_SCENES)
HEAD = '''format = 1;
time:    { end = %s; };
output:  { series = 1; snapshots = false; };
'''
ALL = list(SCENES)
# float has all else of hinge and touch, dam all else of channel, mesh, swirls and train, train all else of group, so that by default the
# keys of the groups that differ will do
USUAL = 'dam', 'channel', 'float', 'hinge', 'touch', 'mesh', 'train', 'group', 'swirls', 'periodic', 'newton', 'steady', 'duct', 'water', \
    'boxes', 'ring', 'stream', 'swell'
ENDS = {'mesh': '0.012', 'swirls': '0.012', 'ring': '0.4', 'newton': '0.4', 'dual_time': '0.4', 'lid': '0.4', 'stokes': '0.5',
        'swell': '0.8'}  # s: some steps
OURS = {'hinge': 'bodies', 'touch': 'bodies', 'train': 'wa', 'group': 'waves', 'channel': ('walls', 'initial', 'sph'),
        'mesh': ('walls', 'bodies', 'shapes', 'domain'), 'swirls': ('apr', 'sph'), 'newton': 'fv', 'steady': 'fv',
        'duct': ('walls', 'fv', 'probes', 'initial'), 'water': ('shapes', 'fluid', 'walls', 'probes', 'fv'),
        'boxes': ('blocked', 'initial'), 'ring': 'b', 'stream': 'b', 'swell': ('initial', 'domain')}
WITH_SURFACE = 'dam', 'float', 'hinge', 'cube', 'mesh', 'wave', 'train', 'group', 'drop', 'lines', 'water', 'boxes', 'swell', 'stokes', \
    'zone'
FOREIGN = {'sph': ('fv.', 'blocks.', 'blocked.'), 'fv': ('sph.', 'apr.', 'coupling.', 'bodies.')}  # keys of the other program
counts = {'refused': 0, 'change': 0, 'neither': 0}


def entries(text):
    """Head and entries of each paragraph of VALUES or OTHERS, as lists of name and value."""
    for line in re.sub(r'\n +', ' | ', text.strip()).split('\n'):
        head, rest = line.split(None, 1)
        yield head.rstrip(':'), [entry.split(None, 1) for entry in rest.split(' | ')]


VALUE = {'%s.%s' % (group, key): value for group, keys in entries(VALUES) for key, value in keys}
OTHER = {(mode, key): value for mode, keys in entries(OTHERS) for key, value in keys}
OTHER.update({(mode, program + '.surface'): 'no' for mode in WITH_SURFACE for program in ('sph', 'fv')})


def program_of(mode):
    return 'fv' if mode in FV_SCENES else 'sph'


def trace(folder):
    """What a run leaves behind, without times and names."""
    if not os.path.isdir(folder):
        return None
    text = ''.join(open(path).read() for path in (folder + '/series.csv', folder + '/summary.json') if os.path.exists(path))
    text = re.sub(r'"time_s".*?\}', '', text, flags=re.S)
    text = re.sub(r'.*(_s":|"us_per|"modules"|"version"|"case").*\n', '', text)
    return sorted(map(os.path.basename, glob.glob(folder + '/*'))), text


def put(scene, group, key, value):
    """The scene with a key of the first element of a group set; None: it has no such element."""
    marker = '#' + group
    if marker not in scene:
        return None
    line = next(line for line in scene.split('\n') if marker in line)
    changed = re.sub(r'([{;] *)%s = [^;]*;' % key, r'\1', line, count=1).replace(marker, ' %s = %s; #' % (key, value))
    return scene.replace(line, changed)


def is_own(scene, group, key, value):
    """Whether the scene, or the marked element of its list, has that very value."""
    bare = re.compile('[" ]')
    line = next((line for line in scene.split('\n') if '#' + group in line), scene)
    return bare.sub('', ' %s = %s;' % (key, value)) in re.split('(?<=[;{])', bare.sub('', line))


def attempt(mode, scene, before, key, value):
    group, _, own = key.rpartition('.')
    changes = ['-p', '%s=%s' % (key, value)]
    if is_own(scene, group.rpartition('.')[2], own, value):
        return
    if re.match(r'(walls|bodies|shapes|probes|blocks|blocked|apr\.regions|apr\.criteria)\.', key):
        scene, changes = put(scene, group.rpartition('.')[2], own, value), []
    if scene is None:
        return
    write('case.cfg', scene)
    shutil.rmtree('out', ignore_errors=True)
    code = start(program_of(mode), 'case.cfg', '-o', 'out', *changes)
    if code == 2 and lib.says('syntax error'):
        bad("%s: %s = %s: the test's own case is no case" % (mode, key, value))
    elif code == 2:
        counts['refused'] += 1
    elif trace('out') == before:
        counts['neither'] += 1
        bad('%s: %s = %s is accepted and changes nothing' % (mode, key, value))
    else:
        counts['change'] += 1


def attempt_all(mode, ours):
    scene = HEAD % ENDS.get(mode, '0.1' if mode in FV_SCENES else '0.04') + SCENES[mode] + '\n'
    write('case.cfg', scene)
    shutil.rmtree('base', ignore_errors=True)
    if start(program_of(mode), 'case.cfg', '-o', 'base') > 1:  # 1: coarse, and says so
        bad('%s does not run' % mode, 'out.txt')
        return
    before = trace('base')
    for key, value in VALUE.items():
        value = OTHER.get((mode, key), value)
        if key.startswith(ours) and not key.startswith(FOREIGN[program_of(mode)]) and value != 'None':
            attempt(mode, scene, before, key, value)


lib.scratch()
manual = ''.join(subprocess.run([lib.build + '/' + program, '--params'], stdout=subprocess.PIPE, text=True, check=True).stdout
                 for program in ('sph', 'fv'))
for key in re.findall(r'^\| `(\w+\.[\w.]*)` ', manual, flags=re.M):
    if key not in VALUE and key not in EXCEPTIONS and not key.startswith('accept.'):
        bad('no other value is known for %s: add it here' % key)
for solid, low, high, without in ('tank', -0.8, 0.8, 'zp'), ('cube', -0.3, 0.1, ''), ('other', -0.5, 0.3, ''), ('water', -1, 0.5, ''):
    lib.box_stl(solid + '.stl', [low] * 3, [high] * 3, without)
write('other.csv', '0,0\n0.3,0\n0,0.4\n0,0\n')
modes = sys.argv[2:] or ['all'] * lib.long
for mode in ALL if modes == ['all'] else modes or USUAL:
    attempt_all(mode, '' if modes == ['all'] else OURS.get(mode, ''))
lib.end('%(refused)d refused, %(change)d change the run, %(neither)d neither' % counts)
