#!/bin/sh
# What --check says of coupled cases: windows and memory that the flow wants, scenes that are refused, each with its
# reason. Nothing runs. SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
look() { # CASE ARGS...
    case=$1
    shift
    [ -f "$case" ] || case=$root/cases/$case/case.cfg
    "$b/sph" "$case" --check "$@" >text 2>&1
    code=$?
}
accepts() { look "$@"; [ $code = 0 ] || bad "$*: refused: $(tail -n 2 text)"; }
says() { grep -q -- "$1" text || bad "$what: no line like \"$1\": $(tail -n 2 text)"; }
refuses() { # WHAT REASON CASE ARGS...
    what=$1 reason=$2
    shift 2
    look "$@"
    [ $code = 2 ] || bad "$what: exit $code, wanted 2"
    says "$reason"
}
what=windows
accepts taylor_green -p coupling.steps=0
says 'coupling steps of 15 steps, 0.03 s, limited by the flow: U T/L = 0.030'
accepts taylor_green -p coupling.steps=0 -p 'initial.velocity=(0.8,0.6)' -p sph.c0=10 # twice the speed
says 'coupling steps of 7 steps, 0.014 s, limited by the flow'
accepts standing_wave -p coupling.steps=0 -p coupling.memory=0
says 'limited by the waves'
accepts taylor_green -p coupling.steps=50
says 'times what this flow allows'
refuses "windows too long" 'values cannot be extrapolated in time' taylor_green -p coupling.steps=150
refuses "windows too short for their memory" 'is unstable above' standing_wave -p coupling.steps=1 -p coupling.memory=1
for case in taylor_green uniform_flow standing_wave standing_wave_3d breaking_wave beltrami; do
    accepts $case
done

# cells as fine as the particles, and a loop whose gain only smoothing bounds: said, with a c0 that mends it
what="cells and gain"
accepts taylor_green -p 'fv.cells=(150,150)'
says 'warning: fv.cells: cells of 0.00667 m are .* times sph.dx; below 1.5'
accepts taylor_green
grep -q 'times sph.dx' text && bad "$what: a word about cells that are coarse enough"
cat >gain.cfg <<'CASE'
format = 1;
time:    { end = 3.0; };
fluid:   { rho = 1.0; nu = 1.0e-3; };
domain:  { dim = 2; min = (0, 0); max = (2.4, 0.6); };
initial: { field = "uniform"; U = 0.3; velocity = (0.2, 0.0); };
walls:   ( { side = "x_min"; kind = "inflow"; velocity = (0.2, 0); }, { side = "x_max"; kind = "outflow"; },
           { side = "y_min"; kind = "no_slip"; }, { side = "y_max"; kind = "no_slip"; } );
sph:     { dx = 0.01; box = ((0.5, 0), (1.5, 0.46)); };
fv:      { cells = (144, 36); };
CASE
accepts gain.cfg
says 'warning: gain of the coupling loop .*, above 1: .* sph.c0 = [0-9.]* m/s lowers it to 1'
c0=$(sed -n 's|.*; sph.c0 = \([0-9.]*\) m/s lowers.*|\1|p' text)
accepts gain.cfg -p "sph.c0=$c0"
grep -q 'above 1:' text && bad "$what: with the c0 proposed, $c0 m/s, the gain is still above 1"

# bdf2 under a violent surface: a warning with its steps; none where the flow is slow and viscous
slow() { "$b/fv" "$root/cases/dam_break_fv/case.cfg" --check -p fv.integrator=bdf2 -p fluid.nu="$1" 2>&1 | grep -c 'warning: fv.integrator: bdf2 is for slow'; }
[ "$(slow 1e-6)" = 1 ] || bad "bdf2 in water that breaks: not a word"
[ "$(slow 1e-2)" = 0 ] || bad "bdf2 in honey: a warning"
# newton over the layers of a sudden start: a warning where the run ends in their midst in one step
printf 'format = 1;\ntime: { end = 0.05; };\nfluid: { rho = 1.0; nu = 1.0; };\ndomain: { dim = 2; min = (0, 0); max = (0.25, 1); periodic = (true, false); };\nwalls: ( { side = "y_min"; kind = "no_slip"; }, { side = "y_max"; kind = "no_slip"; velocity = (1, 0); } );\nfv: { cells = (4, 20); integrator = "newton"; };\n' >couette.cfg
sudden() { "$b/fv" couette.cfg --check "$@" 2>&1 | grep -c 'warning: fv.integrator: newton.s steps of'; }
[ "$(sudden)" = 1 ] || bad "newton in one step over a sudden start: no warning"
[ "$(sudden -p fv.cfl=0.15)" = 0 ] || bad "newton in seven steps: a warning"
[ "$(sudden -p time.end=1)" = 0 ] || bad "newton to the steady flow: a warning"

# scenes without a place for the coupling
refuses "no cell of fv in what sph gives" 'no cell of fv .* lies wholly in' taylor_green -p coupling.overlap=0.19
refuses "cells finer than the particles" 'fv.cells: cells of 0.005 m are finer than' taylor_green -p 'fv.cells=(200,200)'
accepts taylor_green -p 'fv.cells=(150,150)'
refuses "cells wider than what sph gives" 'no cell of fv .* lies wholly in' taylor_green -p 'fv.cells=(4,4)'
refuses "no room left for what sph gives" 'leave nothing along x of what sph gives' taylor_green -p coupling.overlap=0.4
refuses "sph everywhere" 'no side of it lies in fv' taylor_green -p 'sph.free=((0,0),(1,1))'
accepts taylor_green -p 'sph.free=((0.7,0.3),(1.1,0.7))' # across a periodic side
refuses "a box longer than the period" 'is longer than the period' taylor_green -p 'sph.free=((0.05,0.3),(0.97,0.7))'
accepts taylor_green -p 'sph.box_velocity=(0.5,0.3)' # it moves
refuses "a box that moves along its walls" 'cannot move along y' standing_wave -p 'sph.box_velocity=(0,0.1)'
refuses "a body that is not there" 'no body is named' taylor_green -p sph.box_follows=ship
refined() { # KEYS of a region, in a box that moves
    { cat "$root/cases/taylor_green/case.cfg" && echo "apr: { levels = 1; regions = ( { level = 1; $1 } ); };"; } >refined.cfg
}
part='min = (0.43, 0.43); max = (0.57, 0.57);'
refined "$part follow = \"sph.box\";"
accepts refined.cfg -p 'sph.box_velocity=(0.5,0.3)'
refuses "a region that follows a box at rest" 'the box rests' refined.cfg
refined "$part velocity = (0.5, 0.3);"
accepts refined.cfg -p 'sph.box_velocity=(0.5,0.3)'
refined "$part"
refuses "a region that a moving box leaves" 'reaches into the open side' refined.cfg -p 'sph.box_velocity=(0.5,0.3)'
accepts solitary_crossing -p 'sph.box_follows="breaker"'
refuses "a breaker without a surface" 'a crest is followed where the surface crosses' taylor_green -p 'sph.box_follows="breaker"'
two=$root/cases/taylor_green/two_boxes.cfg
accepts "$two"
refuses "boxes whose zones overlap" 'overlaps the box of group sph_right' "$two" -p 'sph.free=((0.3,0.3),(1.1,0.7))'
refuses "one of two boxes that moves" 'one that moves could meet another' "$two" -p 'sph.box_velocity=(0.1,0)'

# surfaces of triangles: where the particles are
stl "0.4 0.4 0.4" "0.6 0.6 0.6" >cube.stl
solid() { # LISTS of a confined tank, a cube in it
    cat >solid.cfg <<CASE
format = 1;
time:    { end = 1.0; };
fluid:   { rho = 1000.0; nu = 0.01; gravity = (0, 0, -1); };
domain:  { dim = 3; min = (-1, 0, 0); max = (2, 1, 1); };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; }, { side = "z_min"; },
           { side = "z_max"; }$2 );
$1
sph:     { dx = 0.025; R_dx = 2.5; free = ((0.2, 0.2, 0), (0.8, 0.8, 1)); };
fv:      { cells = (96, 32, 32); };
CASE
}
if "$b/sph" "$root/cases/sphere_3d/case.cfg" --check 2>&1 | grep -q 'built without a reader'; then
    echo "note: this build has no reader of meshes"
else
    solid 'bodies: ( { name = "cube"; mesh = "cube.stl"; } );'
    accepts solid.cfg
    "$b/fv" solid.cfg --check >text 2>&1 || bad "fv refuses a coupled body of triangles: $(tail -n 2 text)"
    solid 'bodies: ( { name = "cube"; mesh = "cube.stl"; velocity = (0.5, 0, 0); } );'
    refuses "a body of triangles that leaves" "body .cube' is outside of (0.25[0-9]*, 0.25[0-9]*, 0) to .* m at t = 0.[0-9]* s" solid.cfg
    solid 'bodies: ( { name = "cube"; mesh = "cube.stl"; velocity = (0.5, 0, 0); } );'
    accepts solid.cfg -p 'sph.box_follows="cube"'
    solid '' ', { mesh = "cube.stl"; translate = (0.9, 0, 0); fluid_side = "outside"; }'
    refuses "a wall of triangles in fv's flow" 'walls.\[6\].mesh: at (1.3.*fv, which has no walls but' solid.cfg
    solid 'shapes: ( { form = "mesh"; mesh = "cube.stl"; } );'
    refuses "water given by triangles" 'shapes.\[0\].mesh: surfaces of triangles are for sph in 3D' solid.cfg
fi
cat >channel.cfg <<'CASE'
format = 1;
time:    { end = 1.0; };
fluid:   { rho = 1000.0; nu = 0.01; };
domain:  { dim = 2; min = (0, 0); max = (4, 1); };
initial: { field = "uniform"; velocity = (1, 0); };
walls:   ( { side = "x_min"; kind = "inflow"; velocity = (1, 0); }, { side = "x_max"; kind = "outflow"; },
           { side = "y_min"; }, { side = "y_max"; } );
sph:     { dx = 0.025; box = ((0.8, 0), (2.6, 1)); };
fv:      { cells = (96, 24); };
CASE
accepts channel.cfg # cut in two: wall_to_wall.sh runs such a job
accepts channel.cfg -p 'domain.max=(4,2)' -p 'fv.cells=(96,48)' # a way around
refuses "a box between two outlets" "nothing would say how much flows through it" channel.cfg -p 'walls.[0].kind=outflow' -p 'walls.[0].velocity=(0,0)' -p 'walls.[0].pressure=100'
cat >basin.cfg <<'CASE'
format = 1;
time:    { end = 1.6; };
fluid:   { rho = 1000.0; nu = 1.0e-6; gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (2, 1.2); };
initial: { field = "rest"; U = 3.13; };
shapes:  ( { box = ((0, 0), (2, 0.6)); } );
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } );
sph:     { dx = 0.02; box = ((0, 0.1), (2, 1.2)); };
fv:      { cells = (64, 40); };
CASE
accepts basin.cfg
refuses "a surface in the transition" 'there is no water' basin.cfg -p 'sph.box=((0,0.44),(2,1.2))'
accepts basin.cfg -p 'sph.box=((0.5,0.0),(1.5,1.2))' # the surface crosses its sides
accepts basin.cfg -p 'sph.box=((0.5,0.0),(1.5,0.4))' # or is fv's alone
accepts standing_wave_3d -p 'sph.box=((0.25,0,0),(1.75,1.25,2))' # and in 3D
sed 's|walls:   (|walls: ( { points = ((1.2, 0), (2, 0.8)); },|' basin.cfg >beach.cfg
accepts beach.cfg -p 'sph.box=((0.5,0.0),(2,1.2))' # a beach where sph gives the flow
refuses "a beach that reaches into fv" 'fv, which has no walls but the domain' beach.cfg -p 'sph.box=((1,0),(2,1.2))'
sed '/x_max/s/, { side = "x_max"; }//' basin.cfg >open.cfg
refuses "a side without a wall" 'which has no wall' open.cfg
cat >body.cfg <<'CASE'
format = 1;
time:    { end = 1.6; };
fluid:   { rho = 1.0; nu = 1.0e-2; };
domain:  { dim = 2; min = (0, 0); max = (2, 1); periodic = (true, true); };
initial: { field = "rest"; U = 1.0; };
bodies:  ( { name = "plate"; centre = (1, 0.5); velocity = (0.4, 0.0); points = ((0.9,0.45),(0.9,0.55),(1.1,0.55),(1.1,0.45)); kind = "no_slip"; } );
sph:     { dx = 0.02; box = ((0.5, 0), (1.5, 1)); };
fv:      { cells = (64, 32); };
CASE
refuses "a body that leaves the box" "leaves the free zone of the particles across x" body.cfg
accepts body.cfg -p time.end=0.2
echo "coupling_check: $failed faults"
[ $failed = 0 ]
