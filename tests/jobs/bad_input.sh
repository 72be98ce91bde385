#!/bin/sh
# Faulty case files and command lines: each ends with exit code 2, with the words that help, before any
# work, and leaves no folder behind. SPDX-License-Identifier: BSD-3-Clause
tmp=$(mktemp -d "${TMPDIR:-/tmp}/bad input ü.XXXXXX") # a space and an accent on purpose
. "$(dirname "$0")/lib.sh"
trap 'rm -rf "$tmp"' EXIT
passed=0

cat >sph.cfg <<'END'
format = 1;
time:    { end = 0.01; };
fluid:   { rho = 1.0; nu = 0.005; };
domain:  { dim = 2; min = (0, 0); max = (1, 1); periodic = (true, true); };
initial: { field = "taylor_green"; U = 1.0; L = 1.0; };
sph:     { dx = 0.02; };
output:  { every = 0.01; };
END
sed 's/^sph:.*/fv: { cells = (16, 16); };/' sph.cfg >fv.cfg
sed 's/^sph:.*/sph: { dx = 0.02; box = ((0.2, 0.2), (0.8, 0.8)); };\nfv: { cells = (16, 16); };\ncoupling: { steps = 32; };/' \
    sph.cfg >coupled.cfg

# says WORDS COMMAND...: exit code 2, WORDS (each alternative of |) in the output, nothing written
says() {
    words=$1
    shift
    case $1 in
    "$b/sph" | "$b/fv") p=${1##*/} && shift && start "$p" out.txt "$@" && set -- "$p" "$@" ;;
    *) "$@" >out.txt 2>&1 </dev/null ;;
    esac
    code=$?
    if [ $code = 2 ] && grep -q -- "$words" out.txt && [ ! -e out ] && [ ! -e result ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAIL: exit code $code, wanted 2 and the words: $words"
        echo "      $*"
        sed 's/^/      | /' out.txt | head -n 12
        rm -rf out result
    fi
}
# with BASE EDIT WORDS PROGRAM [ARGS]: the same on BASE.cfg edited by sed
with() {
    sed "$2" "$1.cfg" >case.cfg
    w=$3 p=$4
    shift 4
    says "$w" "$b/$p" case.cfg -o result "$@"
}

# the command line
says "no case" "$b/sph"
says "nowhere" "$b/sph" nowhere -o result
says "nowhere.cfg" "$b/fv" nowhere.cfg -o result
says "did you mean .*--restart" "$b/sph" sph.cfg --restrat -o result
says "frobnicate" "$b/coupler" coupled.cfg --frobnicate
says "-p" "$b/sph" sph.cfg -o result -p
says "sph.dx" "$b/sph" sph.cfg -o result -p sph.dx
says "command line: .*sph.dy: .*did you mean .*dx" "$b/sph" sph.cfg -o result -p sph.dy=0.1
says "command line: .*sph.dx" "$b/sph" sph.cfg -o result -p sph.dx=thick
says "command line: .*fv.cells" "$b/fv" fv.cfg -o result -p "fv.cells=(0,16)"
says "restart" "$b/sph" sph.cfg -o result --restart
says "coupled job" "$b/sph" coupled.cfg -o result
says "coupled job" "$b/fv" coupled.cfg -o result
says "no group .*fv" "$b/fv" sph.cfg -o result
says "no group .*sph" "$b/sph" fv.cfg -o result

# what libconfig reads as a syntax error
with sph 's/dx = 0.02/dx = 0.02 m/' 'case.cfg:6: .*plain' sph
with sph 's/dx = 0.02/dx = 0,02/' 'case.cfg:6: .*decimal' sph
with sph 's/true, true/yes, yes/' 'case.cfg:4: .*true' sph
with sph 's/min = (0, 0)/min = [0, 0.5]/' 'case.cfg:4: .*( )' sph
with sph 's/dx = 0.02;/dx = 0.02; dx = 0.03;/' 'case.cfg:6: .*dx' sph
with sph 's/dx = 0.02; };/dx = 0.02;/' 'not closed' sph
with sph 's/^format.*/@include "nothing.cfg"/' 'nothing.cfg' sph
with sph 's/every = 0.01/series = 3000000000/' 'case.cfg:7: .*3000000000' sph
with sph 's/time:  /time /' 'case.cfg:2: .*takes : or =' sph
with sph 's/"taylor_green"/taylor_green/' 'case.cfg:5: .*text stands in quotes' sph
with sph 's/"taylor_green"/"taylor_green/' 'case.cfg:5: .*quote .*not closed' sph
with sph 's/^sph:.*/walls: ( { side = "y_min"; }, );\nsph: { dx = 0.02; };/' 'case.cfg:6: .*none after the last' sph
with sph 's/^sph:.*/walls: ( { side = "y_min"; } { side = "y_max"; } );\nsph: { dx = 0.02; };/' 'case.cfg:6: .*comma is missing' sph
with sph 's/^sph:.*/walls: { { side = "y_min"; } };\nsph: { dx = 0.02; };/' 'case.cfg:6: .*list in ( )' sph
with sph 's/^sph:.*/walls: { side = "y_min"; };\nsph: { dx = 0.02; };/' 'case.cfg:6: walls: expected a list' sph
with sph 's/dx = 0.02/dx = 0.0.2/' 'case.cfg:6: .*one point' sph
with sph 's/min = (0, 0)/min = (0 0)/' 'case.cfg:4: .*comma is missing between two numbers' sph
with sph 's/min = (0, 0)/min = (0, 0/' 'case.cfg:4: .*more ( than it closes' sph
with sph 's/dx = 0.02/dx = 0.02; apr.levels = 1/' 'case.cfg:6: .*within a group' sph
with sph 's/dx = 0.02/dx 0.02/' 'case.cfg:6: .*the line .sph:' sph
printf '\000\001\002' >binary.cfg
says "binary.cfg: is not text" "$b/sph" binary.cfg -o result
printf '\377\376f\000' >wide.cfg
says "wide.cfg: .*UTF-16.*save it as UTF-8" "$b/sph" wide.cfg -o result
{ printf '\357\273\277'; grep '^fluid' sph.cfg; } >part.inc
with sph 's/^fluid.*/@include "part.inc"/' 'part.inc:1: .*mark of UTF-8' sph

# keys
with sph 's/dx = 0.02/Dx = 0.02/' 'sph.Dx: .*did you mean .*dx' sph
with sph 's/dx = 0.02/cells = (50, 50)/' '^1 fault' sph
with sph 's/dx = 0.02/cells = (50, 50)/' 'case.cfg:6: sph.cells: .*did you mean .dx' sph
with sph 's/nu = 0.005/mu = 0.005/' 'case.cfg:3: fluid.mu: .*.nu. = mu/rho' sph
with sph 's/end = 0.01/endTime = 0.01/' '^1 fault' sph
with sph 's/dx = 0.02/dx = 20/' '^1 fault' sph
with sph 's/end = 0.01/end = 0.01; nu = 0.1/' 'time.nu: .*known in group .fluid' sph
with sph 's/dx = 0.02/dx = 0.02; shceme = "riemann"/' 'case.cfg:6: sph.shceme: .*did you mean .*scheme' sph
with sph 's/^output:/outptu:/' 'outptu: .*did you mean .*output' sph
with sph 's/dx = 0.02; //' 'sph.dx: ' sph
with sph 's/dx = 0.02/dx = "thick"/' 'case.cfg:6: sph.dx: ' sph
with sph 's/dx = 0.02/dx = -0.02/' 'case.cfg:6: sph.dx: ' sph
with sph 's/dx = 0.02/dx = 0.02; scheme = "upwind"/' 'case.cfg:6: sph.scheme: .*riemann_ale' sph
with sph 's/dim = 2/dim = 4/' 'case.cfg:4: domain.dim: ' sph
with sph 's/max = (1, 1)/max = (1, 1, 1, 1)/' 'case.cfg:4: domain.max: ' sph
with sph 's/max = (1, 1)/max = (0, 1)/' 'case.cfg:4: domain.max: ' sph
with sph 's/end = 0.01/end = -1/' 'case.cfg:2: time.end: ' sph
with sph 's/nu = 0.005/nu = -0.005/' 'case.cfg:3: fluid.nu: ' sph
with sph 's/dx = 0.02/dx = 0.03/' 'case.cfg:6: sph.dx: .*take dx = "1/34" (0.02941 m) or dx = "1/33" (0.0303 m)' sph
with sph 's/dx = 0.02/dx = 0.03/; s/"taylor_green"/"rest"/; s/max = (1, 1)/max = (1.6, 0.6)/' 'sph.dx: .*take dx = "1.6/56" (0.02857 m) or dx = "1.6/48"' sph
with sph 's/dx = 0.02/dx = 0.03/; s/"taylor_green"/"rest"/; s/max = (1, 1)/max = (1.57, 0.997)/' 'sph.dx: .*none near it fits all axes: round the corners' sph
with sph 's/nu = 0.005/zeta = 0.005/' 'fluid.zeta: unknown key; there are rho, nu, gravity' sph
with sph 's/dx = 0.02/dx = 0.5/' 'case.cfg:6: sph.dx: ' sph
with sph 's/dx = 0.02/dx = 0.02; box = ((0.2, 0.2), (0.35, 0.8))/' 'sph.box: ' sph
rough='s/(true, true)/(true, false)/; s/"taylor_green"/"rest"/; s/^sph/walls: ( { side = "y_min"; friction = 0.01; } );\n&/; s/^fv/walls: ( { side = "y_min"; friction = 0.01; } );\n&/'
with sph "$rough; s/friction = 0.01/friction = -0.01/" 'walls.friction: -0.01' sph
with sph "$rough; s/friction/kind = \"no_slip\"; friction/" 'walls.\[0\].friction: .*bed friction is a slip wall' sph
with sph "$rough; s/dx = 0.02/dx = 0.02; walls = \"ghosts\"/" 'walls.\[0\].friction: mirrored ghosts' sph
with fv "$rough" 'walls.\[0\].friction: is not used: fv has no bed friction' fv
with fv 's/cells = (16, 16)/cells = (16, 2)/' 'fv.cells: ' fv
with fv 's/cells = (16, 16)/cells = (16, 16); graded = (0.5, 8)/' 'case.cfg:6: fv.graded: y is periodic' fv
with fv 's/cells = (16, 16)/cells = (16, 16); graded = (0.9, 6)/; s/(true, true)/(true, false)/' 'fv.graded: layers grow by' fv
with fv 's/cells = (16, 16)/cells = (16, 16); graded = (0.5, 12)/; s/(true, true)/(true, false)/' 'fv.graded: no heights' fv
with fv 's/cells = (16, 16)/cells = (16, 16); graded = (0.5, 6.5)/; s/(true, true)/(true, false)/' 'fv.graded: 6.5 is not a number' fv
with fv 's/cells = (16, 16)/cells = (16, 16); cfl = 7/' 'case.cfg:6: fv.cfl: ' fv
with fv 's/cells = (16, 16)/cells = (16, 16); cfl = 1.25/' 'case.cfg:6: fv.cfl: 1.25: rk3 is stable up to 1.2' fv
with fv 's/cells = (16, 16)/cells = (16, 16); cfl = 0.8; integrator = "bdf2"/' 'fv.cfl: 0.8: bdf2 is stable up to 0.7' fv
with fv 's/cells = (16, 16)/cells = (16, 16); integrator = "bdf2"/; s/nu = 0.005/nu = 0.0/' 'fv.integrator: bdf2 has no stable step without viscosity' fv
with fv 's/cells = (16, 16)/cells = (16, 16); integrator = "euler"/' 'case.cfg:6: fv.integrator: .*rk3' fv
with coupled 's/steps = 32/steps = -1/' 'coupling.steps: ' coupler --check
with coupled 's/steps = 32/steps = 32; mapping = "nearest"/' 'coupling.mapping: .*mls' coupler --check
says "4 faults" "$b/sph" sph.cfg -o result -p sph.dx=-1 -p sph.cfll=1 -p time.end=-3 -p sph.scheme=none

# fv: keys that a run does not use, scenes that contradict themselves
cat >basin.cfg <<'END'
format = 1;
time:    { end = 0.1; };
fluid:   { rho = 1.0; nu = 0.01; };
domain:  { dim = 2; min = (0, 0); max = (1, 1); };
walls:   ( { side = "x_min"; kind = "no_slip"; }, { side = "x_max"; kind = "no_slip"; },
           { side = "y_min"; kind = "no_slip"; }, { side = "y_max"; kind = "no_slip"; } );
fv:      { cells = (16, 16); };
END
cat >block.cfg <<'END'
format = 1;
time:    { end = 0.1; };
fluid:   { rho = 1.0; nu = 0.01; };
domain:  { dim = 2; min = (0, 0); max = (1, 1); };
blocks:  ( { name = "a"; cells = (16, 16); i_min = "wall"; i_max = "wall"; j_min = "wall"; j_max = "wall"; } );
fv:      { };
END
cat >tank.cfg <<'END'
format = 1;
time:    { end = 0.1; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (1, 1); };
shapes:  ( { form = "box"; box = ((0, 0), (0.5, 0.5)); } );
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
fv:      { cells = (16, 16); };
END
for sound in basin block tank; do # or the faults below could come from something else
    "$b/fv" $sound.cfg --check >out.txt 2>&1 || { echo "FAIL: $sound.cfg is refused: $(head -n 1 out.txt)"; failed=$((failed + 1)); }
done
# lengths in cm: accepted, with a word
sed 's/gravity = (0, -9.81)/gravity = (0, -981)/' tank.cfg >case.cfg
"$b/fv" case.cfg --check >out.txt 2>&1 && grep -q 'fluid.gravity: 981 m/s^2 looks like cm/s^2' out.txt && grep -q 'run time' out.txt || { echo "FAIL: gravity in cm/s^2"; failed=$((failed + 1)); }
# steps of a third of a basin's period: accepted, with a word; of a twentieth: without
for cfl in 20 2; do
    sed "s/cells = (16, 16)/& ; integrator = \"newton\"; cfl = $cfl/" tank.cfg >case.cfg
    "$b/fv" case.cfg --check -p time.end=9 >out.txt 2>&1 && ! grep -q 'layers that grow' out.txt && grep -q 'longest wave has a period of .* fv.cfl below' out.txt
    [ $? = $((cfl < 10)) ] || { echo "FAIL: newton's long steps of a basin, fv.cfl $cfl"; failed=$((failed + 1)); }
done
# the picture of blocks has their names and what their sides are
"$b/fv" block.cfg --check=picture -o drawn >out.txt 2>&1 && grep -q '>a<' drawn/fv-scene.svg && grep -q 'no-slip wall' drawn/fv-scene.svg &&
    grep -q 'run time' out.txt || { echo "FAIL: block.cfg is not drawn, or without its forecast"; failed=$((failed + 1)); }
# boxes that are cut out
box() { # WORDS EDIT: basin with a box
    with basin "s/^fv:/blocked: ( { name = \"b\"; min = (0.25, 0); max = (0.5, 0.5); } );\n&/; $2" "$1" fv
}
box 'blocked.\[0\].max: box "b": from 0.5 to 0.5 m along x: give max above min' 's/min = (0.25, 0)/min = (0.5, 0)/'
box 'blocked.\[0\].min: box "b": it lies outside the domain along y' 's/min = (0.25, 0); max = (0.5, 0.5)/min = (0.25, -1); max = (0.5, -0.5)/'
box 'blocked.\[0\].min: box "b": from -0.25 to 0.25 m along x it reaches over a periodic side: give its parts as two boxes, 0 to 0.25 m and 0.75 to 1 m' 's/min = (0.25, 0); max = (0.5, 0.5)/min = (-0.25, 0); max = (0.25, 0.5)/; s/max = (1, 1);/& periodic = (true, false);/; s/{ side = "x_min"; kind = "no_slip"; }, { side = "x_max"; kind = "no_slip"; },//'
box 'box "b": only 2 cells along x are left' 's/min = (0.25, 0)/min = (0.125, 0)/'
box 'box "b": only 2 cells along y are left' 's/max = (0.5, 0.5)/max = (0.5, 0.9)/'
box 'box "b": only 3 cells along x are left between it and what is next: at least 4 between no-slip' 's/min = (0.25, 0)/min = (0.1875, 0)/; s/"b";/"b"; kind = "no_slip";/'
box 'blocked: the boxes cut the domain into separate parts' 's/max = (0.5, 0.5)/max = (0.5, 1)/'
box 'blocked: nothing is left' 's/min = (0.25, 0)/min = (0, 0)/; s/max = (0.5, 0.5)/max = (1, 1)/'
box 'blocked.\[0\].kind: box "b": without viscosity' 's/nu = 0.01/nu = 0.0/; s/no_slip/slip/g; s/"b";/"b"; kind = "no_slip";/'
box 'blocked.\[0\].min: box "b": it stands on the wall y_min, which moves' 's/"y_min";/"y_min"; velocity = (1, 0);/'
box 'blocked.\[0\].min: box "b": it stands on the side y_min, which is no wall' 's/"y_min"; kind = "no_slip";/"y_min"; kind = "outflow";/'
box 'probes.\[0\].at: probe "p" lies in the box "b"' 's/^walls:/probes: ( { name = "p"; at = (0.3, 0.2); } );\n&/'
box 'blocked: not with newton' 's/16);/16); integrator = "newton";/'
box 'initial.field: its exact solution has no boxes' 's/^walls:/initial: { field = "two_modes"; U = 1.0; L = 1.0; };\n&/'
with block 's/^fv:/blocked: ( { name = "b"; min = (0.25, 0); max = (0.5, 0.5); } );\n&/' 'blocked: not with blocks' fv
with tank 's/max = (1, 1)/max = (1000, 1)/; s/(0.5, 0.5)/(500, 0.5)/' 'fv.cells: cells 1000 times as long as high' fv
with tank 's/{ side = "x_max"; }/{ side = "x_max"; kind = "outflow"; level = 1.5; }/' 'walls.\[1\].level: 1.5 m is above the domain, whose heights are 0 to 1 m: raise domain.max' fv
with tank 's/{ side = "x_min"; }, { side = "x_max"; }/{ side = "x_min"; kind = "inflow"; level = -0.5; }, { side = "x_max"; kind = "outflow"; }/' 'walls.\[0\].level: -0.5 m is no higher than .*: nothing flows in; a higher level, or' fv
with tank 's/{ side = "x_max"; }/{ side = "x_max"; kind = "inflow"; velocity = (1, 0); }/; s/{ side = "x_min"; }/{ side = "x_min"; kind = "outflow"; }/' 'walls.\[1\]: .*points out of the domain: with a free surface that is kind = "outflow" with a discharge' fv
with basin 's/nu = 0.01/& ; gravity = (0, -9.81)/; s/^fv:/initial: { field = "standing_wave"; L = 1.0; level = 0.7; amplitude = 0.2; };\n&/' 'initial.amplitude: .*k a = 1.26' fv
with basin 's/nu = 0.01/nu = 0.01; central = 1.0/' 'case.cfg:3: fluid.central: is not used' fv
with basin 's/^fv:/initial: { amplitude = 0.1; };\n&/' 'initial.amplitude: is not used' fv
with basin 's/^fv:/initial: { L = 2.0; };\n&/' 'initial.L: is not used' fv
with basin 's/^fv:/initial: { velocity = (1, 0); };\n&/' 'initial.velocity: is not used' fv
with basin 's/^fv:/initial: { level = 2.0; };\n&/' 'initial.level: is not used' fv
with basin 's/^fv:/bodies: ( { points = ((0.4, 0.4), (0.4, 0.6), (0.6, 0.6)); } );\n&/' 'bodies.*: is not used' fv
with basin 's/^fv:/shapes: ( { box = ((0, 0), (0.5, 0.5)); velocity = (1, 0); } );\n&/; s/16);/16); surface = "no";/' 'shapes.*: is not used' fv
with basin 's/^fv:/coupling: { steps = 8; };\n&/' 'coupling.steps: is not used' fv
with basin 's/^fv:/output: { snapshots = false; fields = "velocity"; };\n&/' 'output.fields: is not used' fv
with basin 's/^fv:/output: { fields = "velocity zone"; };\n&/' 'output.fields: zone: ' fv
with basin 's/"x_min"; kind = "no_slip";/& profile = "parabolic";/' 'case.cfg:5: walls.\[0\].profile: is not used' fv
with basin 's/"x_min"; kind = "no_slip";/& pressure = 1.0;/' 'walls.\[0\].pressure: is not used' fv
with basin 's/"x_min"; kind = "no_slip";/"x_min"; kind = "slip"; velocity = (0, 1);/' 'walls.\[0\].velocity: is not used' fv
with basin 's/16);/16); tol_newton = 1e-8;/' 'fv.tol_newton: is not used' fv
with basin 's/16);/16); integrator = "newton"; upwind = 0.5;/' 'fv.upwind: is not used' fv
with basin 's/16);/16); integrator = "newton"; tol_pressure = 1e-3;/' 'fv.tol_pressure: is not used' fv
with basin 's/nu = 0.01/nu = 0.0/' 'case.cfg:5: walls.\[0\]: .*a wall exerts no friction' fv
with block 's/nu = 0.01/nu = 0.0/' 'blocks.\[0\].i_min: .*a wall exerts no friction' fv
with basin 's/nu = 0.01/nu = 0.0/; s/no_slip/slip/g; s/16);/16); tol_viscous = 1e-5;/' 'fv.tol_viscous: is not used' fv
with basin 's/16);/16); force = (1.0, 0.0, 0.0);/' 'fv.force: is not used' fv
with basin 's/max = (1, 1)/max = (1, 1, 1)/' 'domain.max: .*component' fv
with block 's/fv:      {/& cells = (16, 16);/' 'fv.cells: is not used' fv
with block 's/16);/16); kind = "annulus";/' 'blocks.kind: unknown key; did you mean .mapping' fv
with block 's/max = (1, 1)/max = (4, 4)/; s/^blocks.*/blocks: ( { name = "far"; cells = (16, 16); }, { mapping = "annulus"; centre = (2, 2); cells = (8, 32); i_min = "wall"; j_min = "joined"; j_max = "joined"; } );/' \
    'orphan cells.*far has min (0, 0) and max (1, 1)' fv
with block 's/16);/16); arc = (0, 90);/' 'blocks.\[0\].arc: is not used' fv
with block 's/16);/16); focus = (0.5, 0.5);/' 'blocks.\[0\].focus: is not used' fv
with block 's/16);/16); spin = (0, 0, 1);/' 'blocks.\[0\].spin: is not used' fv
with basin 's/"x_min"; kind = "no_slip";/"x_min"; kind = "inflow"; velocity = (1, 0);/' 'an inflow without an outflow: 1 m\|inflow into a closed box' fv
with block 's/i_min = "wall"/i_min = "inflow"; velocity = (1, 0); lid = "j_max"/' 'an inflow without an outflow: 1 m\|inflow into a closed box' fv
with basin 's/"x_min"; kind = "no_slip";/"x_min"; kind = "inflow"; velocity = (0, 1);/; s/"x_max"; kind = "no_slip"/"x_max"; kind = "outflow"/' 'nothing flows in' fv
with basin 's/"x_min"; kind = "no_slip";/& velocity = (1, 0);/' 'would pump fluid through' fv
with block 's/16);/16); velocity = (1, 0);/' 'would pump fluid through itself' fv
with basin 's/nu = 0.01/& ; gravity = (1, 0)/; s/x_m\([a-z]*\)"; kind = "no_slip"/x_m\1"; kind = "outflow"/g' 'two outflows at different heights' fv
with block 's/nu = 0.01/& ; gravity = (1, 0)/; s/i_m\([a-z]*\) = "wall"/i_m\1 = "outflow"/g' 'two outflows at different heights' fv
with block 's/min = (0, 0)/min = (0.1, 0)/' 'reaches out of the domain' fv
with basin 's/^fv:/probes: ( { name = "p"; at = (2, 0.5); } );\n&/' 'outside the domain' fv
with block 's/^fv:/probes: ( { name = "p"; at = (2, 0.5); } );\n&/' 'no block has computed cells\|outside the domain' fv
with basin 's/^fv:/initial: { field = "poiseuille"; };\n&/' 'a channel along x' fv
with basin 's/^fv:/initial: { field = "patch"; };\n&/' 'is for sph' fv
with basin 's/16);/16); extrema = (0.1, 0.0, 0.1);/' 'fv.extrema: .*none may be 0' fv
with basin 's/(16, 16)/(2, 1)/' '1 cells along y: at least 4' fv
with block 's/(16, 16)/(1, 2)/' '2 cells along j: at least 6' fv
with tank 's/gravity = (0, -9.81)/rho = 2.0/' 'a free surface.* gravity' fv
with tank 's/box = ((0, 0), (0.5, 0.5))/box = ((0, 0.5), (0.5, 1))/' 'water touches the side y_max' fv
with tank 's/(0, -9.81)/(9, -4)/; s/max = (1, 1)/&; periodic = (true, false)/; s/{ side = "x_m[a-z]*"; }, //g; s/((0, 0), (0.5, 0.5))/((-1, 0.5), (2, 1))/' \
    'water touches the side y_max' fv
with basin 's/^fv:/initial: { field = "uniform"; velocity = (1, 0); };\n&/' 'initial.velocity: uniform: along x both sides are walls' fv
with tank 's/(0.5, 0.5)/(0.5, 1.5)/' 'its water .* above the domain' fv
with tank 's/box = ((0, 0), (0.5, 0.5))/box = ((2, 0), (3, 0.5))/' 'lies outside the domain' fv
with tank 's/form.*}/form = "below"; level = 2.0; }/' 'level,* 2 m.* the domain' fv
with tank 's/"y_min";/"y_min"; kind = "outflow";/' 'water would fall out of it' fv
with tank 's/^shapes.*/shapes: ( { box = ((0, 0), (2, 0.001)); } );/' 'shapes: no centre of a cell lies in' fv
with tank 's/^shapes.*/initial: { field = "standing_wave"; amplitude = 0.6; L = 2.0; level = 0.5; };/' 'the crest of the wave' fv
with tank 's/^shapes.*/initial: { field = "standing_wave"; amplitude = 0.1; L = 3.0; level = 0.5; };/' 'must stand at crests or troughs' fv
# --- particles: what a run has no use for, and what contradicts itself ---
cat >tank.cfg <<'END'
format = 1;
time:    { end = 0.5; };
fluid:   { rho = 1000.0; gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (2, 1); };
initial: { U = 3.0; };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } );
shapes:  ( { form = "below"; level = 0.5; } );
bodies:  ( { name = "b"; points = ((0.8, 0.2), (0.8, 0.4), (1.2, 0.4), (1.2, 0.2)); } );
probes:  ( { name = "p"; at = (1, 0.1); } );
sph:     { dx = 0.05; c0 = 30.0; };
END
cat >channel.cfg <<'END'
format = 1;
time:    { end = 0.01; };
fluid:   { rho = 1.0; nu = 0.01; };
domain:  { dim = 2; min = (0, 0); max = (2, 1); };
initial: { field = "uniform"; velocity = (1, 0); };
walls:   ( { side = "x_min"; kind = "inflow"; velocity = (1, 0); },
           { side = "x_max"; kind = "outflow"; },
           { side = "y_min"; }, { side = "y_max"; } );
sph:     { dx = 0.05; R_dx = 2.0; };
END
# keys without use
with tank 's/U = 3.0/U = 3.0; velocity = (1, 0)/' 'case.cfg:5: initial.velocity: is not used: ' sph
with tank 's/U = 3.0/U = 3.0; L = 2.0/' 'case.cfg:5: initial.L: is not used: ' sph
with tank 's/U = 3.0/U = 3.0; amplitude = 0.1/' 'case.cfg:5: initial.amplitude: is not used: ' sph
with tank 's/c0 = 30.0/c0 = 30.0; delta = 0.1/' 'case.cfg:10: sph.delta: is not used: ' sph
with tank 's/c0 = 30.0/c0 = 30.0; scheme = "delta"; limiter = "minmod"/' 'sph.limiter: is not used: ' sph
with tank 's/c0 = 30.0/c0 = 30.0; alpha = 0.1/' 'sph.alpha: is not used: ' sph
with tank 's/c0 = 30.0/c0 = 30.0; background = true/' 'sph.background: is not used: ' sph
with tank 's/c0 = 30.0/c0 = 30.0; viscosity = "morris"/' 'sph.viscosity: is not used: ' sph
with tank 's/c0 = 30.0/c0 = 30.0; low_dissipation = false; dissipation = 0.3/' 'sph.dissipation: is not used: ' sph
with tank 's/c0 = 30.0/c0 = 30.0; outer = "sides"/' 'sph.outer: is not used: ' sph
with sph 's/dx = 0.02/dx = 0.02; noise = 0.0; packing = 9/' 'case.cfg:6: sph.packing: is not used: ' sph
with sph 's/dx = 0.02/dx = 0.02; walls = "ghosts"/' 'case.cfg:6: sph.walls: is not used: ' sph
with sph 's/every = 0.01/every = 0.01; }; coupling: { steps = 9/' 'coupling.steps: is not used: ' sph
with sph 's/every = 0.01/every = 0.01; }; coupling: { buffer = 0.1/' 'coupling.buffer: is not used: ' sph
with sph 's/every = 0.01/fields = "velocity presure"/' 'case.cfg:7: output.fields: .*presure.*pressure' sph
with sph 's/L = 1.0/L = 1.0; level = 0.5/' 'initial.level: is not used: ' sph
with tank 's/"x_min"/"x_min"; velocity = (0, 1)/' 'case.cfg:6: walls.\[0\].velocity: is not used: ' sph
with tank 's/"x_min"/"x_min"; pressure = 10.0/' 'walls.\[0\].pressure: is not used: ' sph
with tank 's/"x_min"/"x_min"; profile = "parabolic"/' 'walls.\[0\].profile: is not used: ' sph
with tank 's/"x_min"/"x_min"; kind = "no_slip"/' 'walls.\[0\].kind: is not used: .*fluid.nu' sph
with tank 's/"x_min"/"x_min"; closed = true/' 'walls.\[0\].closed: is not used: ' sph
with tank 's/level = 0.5/level = 0.5; radius = 0.3/' 'case.cfg:7: shapes.\[0\].radius: is not used: ' sph
with tank 's/level = 0.5/level = 0.5; box = ((0, 0), (1, 1))/' 'shapes.\[0\].box: is not used: ' sph
with channel 's/"outflow"/"outflow"; carried = true/' 'walls.\[1\].carried: is not used: ' sph
with channel 's/"outflow"/"outflow"; velocity = (1, 0)/' 'walls.\[1\].velocity: is not used: ' sph
with channel 's/kind = "inflow"/kind = "inflow"; pressure = 3.0/' 'walls.\[0\].pressure: is not used: ' sph
with channel 's/kind = "inflow"; velocity = (1, 0)/kind = "inflow"/' 'walls.\[0\].velocity: an inflow of 0 m/s lets nothing in' sph
# gauges with the name of another column, criteria of what is not there
with tank 's/name = "p"/name = "t"/' 'probes.\[0\].*: t: series.csv has a column of this name' sph --check
with tank 's/^sph:/accept: ( { what = "p"; tolerance = 1.0; } );\n&/' 'accept.\[0\].what: p is a gauge, .*give a reference' sph --check
with tank 's/^sph:/accept: ( { what = "body.c.mass"; tolerance = 1.0; } );\n&/' 'accept.\[0\].what: summary.json will have no body.c.mass: no body' sph --check
with tank 's/^sph:/accept: ( { what = "discharge.p.volume"; tolerance = 1.0; } );\n&/' 'accept.\[0\].what: .* no gauge of kind discharge' sph --check
# lines
with tank 's/(1.2, 0.4), (1.2, 0.2)/(1.2, 0.2), (1.2, 0.4)/' 'case.cfg:8: bodies.\[0\].points: at (1, 0.3) m: crosses' sph
with tank 's/(1.2, 0.4),/(1.2, 0.4), (1.2, 0.4),/' 'bodies.\[0\].points: at (1.2, 0.4) m: .*twice' sph
with tank 's/(0.8, 0.4), (1.2, 0.4), (1.2, 0.2)/(1, 0.2), (1.2, 0.2)/' 'bodies.\[0\].points: .*no area' sph
with tank 's/(0.8, 0.2), (0.8, 0.4), (1.2, 0.4), (1.2, 0.2)/(0.8, 0.2), (0.8, 0.201), (0.801, 0.201), (0.801, 0.2)/' 'bodies.\[0\]: b is .* m in size, less than sph.dx' sph
with tank 's/(1.2, 0.2))/(1.2, 0.2), (1.2, 0.3))/' 'bodies.\[0\].points: .*runs back' sph
with tank 's/points = ((0.8, 0.2), .*; }/points = ((0.8, 0.2), (0.9, 0.4)); }/' 'three points' sph
# bodies and walls
with tank 's/(1.2, 0.4), (1.2, 0.2)/(2.2, 0.4), (2.2, 0.2)/' 'case.cfg:8: bodies.\[0\]: .*leaves the domain' sph
with tank 's/"b"/"b"; velocity = (2, 0)/' 'bodies.\[0\]: .*leaves the domain across x at (.*t = 0.4' sph
with tank 's/"b"/"b"; centre = (1.5, 0.3); spin = 3.0/' 'bodies.\[0\]: .*leaves the domain across y' sph
with sph 's/^sph:/bodies: ( { points = ((0.9, 0.2), (0.9, 0.4), (1.1, 0.4), (1.1, 0.2)); } );\nsph:/' 'bodies.\[0\]: .*periodic side x' sph
with coupled 's/^sph:/bodies: ( { velocity = (30, 0); points = ((0.45, 0.45), (0.45, 0.55), (0.55, 0.55), (0.55, 0.45)); } );\nsph:/; s/dx = 0.02/dx = 0.01; c0 = 100.0/' 'bodies.\[0\]: .*leaves the free zone' sph --check
with tank 's/^bodies:  (/bodies: ( { name = "c"; points = ((1.1, 0.3), (1.1, 0.45), (1.4, 0.45), (1.4, 0.3)); },/' 'overlaps with body 1 (c)' sph
with tank 's/^bodies:  (/bodies: ( { name = "c"; points = ((1.22, 0.2), (1.22, 0.4), (1.4, 0.4), (1.4, 0.2)); },/' 'bodies: a gap of 0.02 m between .* close it' sph
with tank 's/(1.2, 0.4), (1.2, 0.2)/(1.98, 0.4), (1.98, 0.2)/' 'a gap of 0.02 m' sph
with tank 's/^walls:   (/walls: ( { points = ((1, 0), (1, 0.3)); },/' 'body 1 (b) cuts wall 1' sph
with tank 's/"b"/"b"; velocity = (20, 0)/; s/end = 0.5/end = 0.01/' 'half the speed of sound.*raise sph.c0' sph
with channel 's/"y_min"; }/"y_min"; kind = "no_slip"; velocity = (0, 1); }/' 'walls.\[2\].velocity: 1 m.s across the wall' sph
printf '0 0 0 0\n0.2 0 0 0\n0.2 0.1 0 0\n' >motion.txt
with tank 's/"b"/"b"; motion = "motion.txt"/' 'bodies.\[0\].motion: .*increasing times' sph
printf '0 0 0 0\n0.2 nan 0 0\n1 0 0 0\n' >motion.txt
with tank 's/"b"/"b"; motion = "motion.txt"/' 'bodies.\[0\].motion: row 2 .*not a number' sph
printf '0 0 0 0\n0.2 0.1 0 0\n' >motion.txt
with tank 's/"b"/"b"; motion = "motion.txt"/' 'bodies.\[0\].motion: .*0 to 0.2 s, the run goes from 0 to 0.5' sph
printf '0 0 0 0\n0.2 0 0 0\n0.201 0.4 0 0\n1 0.4 0 0\n' >motion.txt
with tank 's/"b"/"b"; motion = "motion.txt"/' 'bodies.\[0\].motion: jumps at t = 0.2 s, row 3' sph
with tank 's/"b"/"b"; motion = "nothing.txt"/' 'case.cfg:8: bodies.\[0\].motion: .*no such file' sph
# moved by forces: tank's body with "b" replaced
free='"b"; free = true'
with tank 's/"b"/"b"; density = 500.0/' 'bodies.\[0\].density: is not used: .*free = true' sph
with tank 's/"b"/"b"; lock = "x"/' 'bodies.\[0\].lock: is not used: .*free = true' sph
with tank "s/\"b\"/$free/" 'bodies.\[0\].mass: .*density, or mass, centre and inertia' sph
with tank "s/\"b\"/$free; mass = 3.0/" 'bodies.\[0\].mass: with mass goes inertia' sph
with tank "s/\"b\"/$free; mass = 3.0; inertia = -1.0/" 'bodies.\[0\].mass: with mass goes inertia, a number above 0' sph
with tank "s/\"b\"/$free; mass = 3.0; density = 500.0/" 'bodies.\[0\].density: density or mass, not both' sph
with tank "s/\"b\"/$free; density = 500.0; inertia = 1.0/" 'bodies.\[0\].inertia: is not used' sph
with tank "s/\"b\"/$free; density = 500.0; centre = (1, 0.3)/" 'bodies.\[0\].centre: is not used' sph
with tank "s/\"b\"/$free; density = 500.0; lock = \"x ry\"/" 'bodies.\[0\].lock: expected words of x y rz' sph
with tank "s/\"b\"/$free; density = 500.0; lock = \"x, y rz\"/" 'bodies.\[0\].lock: all degrees are locked' sph
with tank "s/\"b\"/$free; density = 500.0; lock = \"x\"; hinge = { at = (1, 0.5); }/" 'bodies.\[0\].lock: is not used: a hinge' sph
with tank "s/\"b\"/$free; density = 500.0; slider = { axis = (0, 0); }/" 'bodies.\[0\].slider.axis: expected a direction' sph
with tank "s/\"b\"/$free; density = 500.0; slider = { axis = (0, 1); }; lock = \"y\"/" 'slider: .*remove x, y, z from lock' sph
with tank "s/\"b\"/$free; density = 500.0; slider = { axis = (0, 1); }; hinge = { at = (1, 0.5); }/" 'a hinge or a slider' sph
with tank "s/\"b\"/$free; density = 500.0; hinge = { stiffness = 3.0; }/" 'bodies.\[0\].hinge.at: must be given' sph
with tank "s/\"b\"/$free; density = 500.0; hinge = { at = (1, 0.5); stiffnes = 3.0; }/" 'bodies.\[0\].hinge.stiffnes: .*did you mean .stiffness' sph
with tank "s/\"b\"/$free; density = 500.0; hinge = { at = (1, 0.5); stiffness = 1e9; }/" 'bodies.\[0\].hinge: stiffness 1e+09 is too large .* at most' sph
with tank "s/\"b\"/$free; density = 500.0; lines = ( { from = (1, 0.4); to = (1, 0.9); stiffness = 1e9; } )/" 'bodies.\[0\].lines.\[0\]: stiffness 1e+09 is too large .* at most' sph
with tank "s/\"b\"/$free; density = 500.0; lines = ( { from = (1, 0.4); to = (1, 0.9); damping = 1e9; } )/" 'lines.\[0\]: damping 1e+09 is too large .* at most' sph
with tank "s/\"b\"/$free; density = 500.0; lines = ( { from = (1, 0.4); to = (1, 0.9); } )/" 'lines.\[0\]: without stiffness and damping' sph
with tank "s/\"b\"/$free; density = 500.0; lines = ( { from = (1, 0.4); to = (1, 0.4); stiffness = 3.0; } )/" 'lines.\[0\]: from and to are one place' sph
with tank "s/\"b\"/$free; density = 500.0; lines = ( { from = (1, 0.4); to = (1, 0.9); stiffness = 3.0; body = \"c\"; } )/" 'lines.\[0\]: body .c. is none of this case' sph
with tank "s/\"b\"/$free; density = 500.0; motion = ( { kind = \"harmonic\"; axis = \"y\"; amplitude = 0.01; period = 0.2; } )/" 'bodies.\[0\].motion.\[0\]: forces move y, too: add it to lock' sph
with tank "s/\"b\"/$free; density = 500.0; release = -1.0/" 'bodies.release: -1 is not allowed' sph
with tank "s/\"b\"/$free; density = 500.0/; s/c0 = 30.0/c0 = 30.0; walls = \"ghosts\"/" 'sph.walls: ' sph
with tank "s/\"b\"/$free; density = 500.0; hinge = { at = (1.7, 0.3); }/; s/(0.8, 0.2), (0.8, 0.4), (1.2, 0.4), (1.2, 0.2)/(1.59, 0.2), (1.59, 0.4), (1.99, 0.4), (1.99, 0.2)/" 'bodies.\[0\]: .*starts in contact with wall .*move it away' sph
with tank "s/\"b\"/$free; density = 500.0; hinge = { at = (1, 0.3); }/; s/^bodies:  (/bodies: ( { name = \"c\"; points = ((1.21, 0.2), (1.21, 0.4), (1.4, 0.4), (1.4, 0.2)); },/" 'starts in contact with body 1 (c)' sph
with tank "s/\"b\"/$free; density = 500.0/; s/^walls:   (/walls: ( { points = ((1, 0), (1, 0.3)); },/" 'body 1 (b) cuts wall 1' sph
with tank 's/"b"/"b"; motion = ( { kind = "harmonic"; axis = "x"; amplitude = 0.1; } )/' 'motion.\[0\]: a harmonic term needs an amplitude and a period' sph
with tank 's/"b"/"b"; motion = ( { kind = "harmonic"; axis = "z"; amplitude = 0.1; period = 1.0; } )/' 'motion.\[0\]: axis z in a case of 2 dimensions' sph
with tank 's/"b"/"b"; motion = ( { kind = "harmonic"; axis = "w"; amplitude = 0.1; period = 1.0; } )/' 'motion.axis: .*one of x|y|z|rx|ry|rz' sph
with tank 's/"b"/"b"; motion = ( { kind = "harmonic"; amplitude = 0.1; period = 1.0; coefficients = (1, 2); } )/' 'motion.\[0\].coefficients: is not used' sph
with tank 's/"b"/"b"; motion = ( { kind = "polynomial"; coefficients = (0, 0.1); from = 0.2; until = 0.1; } )/' 'motion.\[0\]: it ends at 0.1 s' sph
with tank 's/"b"/"b"; motion = ( { kind = "polynomial"; coefficients = (0, 9); } )/; s/end = 0.5/end = 0.01/; s/c0 = 30.0/c0 = 10.0/' 'half the speed of sound' sph
with tank 's/"b"/"b"; motion = ( { axis = "y"; } )/' 'bodies.\[0\].motion: .* needs the name of the file' sph
with tank 's/"b"/"b"; spin = (1, 0, 0)/' 'bodies.\[0\].spin: in 2 dimensions a number' sph
printf '0 0 0 0\n0.1 0.001 0 0\n0.2 0.002 0 0\n0.205 0.1 0 0\n0.3 0.101 0 0\n1 0.11 0 0\n' >motion.txt
with tank 's/"b"/"b"; motion = "motion.txt"/; s/c0 = 30.0;//' 'bodies.\[0\].motion: jumps at t = 0.2 s, row 4: 0.098 m in 0.005 s' sph
printf '0 0 0 0\n0.1 0.4 0 0\n1 0.4 0 0\n' >motion.txt
with tank 's/"b"/"b"; motion = "motion.txt"/' 'bodies.\[0\].motion: jumps .*a tenth of the speed of sound' sph
# water, gauges
with tank 's/level = 0.5/level = 1.5/' 'case.cfg:7: shapes.\[0\]: level 1.5 m is not in the domain' sph
with tank 's/form = "below"; level = 0.5/box = ((0, 0), (1, 1.2))/' 'shapes.\[0\]: .*above the domain' sph
with tank 's/form = "below"; level = 0.5/form = "disc"; centre = (5, 5); radius = 0.5/' 'shapes.\[0\]: lies outside' sph
with tank 's/level = 0.5/level = 0.5; hole = true/' 'shapes.\[0\]: a hole' sph
with tank 's/bodies:  (\(.*\) );/bodies: (\1, { name = "b"; points = ((0.2, 0.2), (0.2, 0.4), (0.4, 0.4), (0.4, 0.2)); } );/' 'bodies.\[1\].name: bodies 1 and 2 are both called `b' sph
with tank 's/name = "p"/name = "p,q"/' 'probes.name: a name heads columns' sph
with tank 's/form = "below"; level = 0.5/form = "disc"; centre = (1, 0.5); radius = 0.001/' 'shapes: no place of a particle lies in' sph
with tank 's/level = 0.5; }/level = 0.5; }, { hole = true; box = ((0, 0), (2, 1)); }/' 'shapes: no place of a particle lies in' sph
with tank 's/gravity = (0, -9.81)/nu = 0.0/; /^bodies/d' 'fluid.gravity: .*nothing that moves' sph
with tank 's/at = (1, 0.1)/at = (1, -0.1)/' 'case.cfg:9: probes.\[0\].at: p: y = -0.1 m is outside' sph
with tank 's/at = (1, 0.1)/at = (1, 0.3)/' 'probes.\[0\].at: p is inside body b' sph
with tank 's/at = (1, 0.1); }/at = (1, 0.1); }, { name = "p"; at = (1.5, 0.1); }/' 'probes.\[1\].at: p: a gauge of this name' sph
with tank 's/at = (1, 0.1)/at = (1, 0.1); kind = "level"/; s/(0, -9.81)/(1, -9.81)/' 'probes.\[0\].kind: p: gauges of levels read' sph
with tank 's/gravity = (0, -9.81)/gravity = (0, 0, -9.81)/' 'fluid.gravity: .*as in (0, -9.81)' sph
with tank 's/max = (2, 1)/max = (2, 1, 3)/' 'domain.max: z component 3' sph
with tank 's/U = 3.0/U = 0.0/' 'case.cfg:5: initial.U: 0 m' sph
with tank 's/(0, -9.81)/(0, -9.81); central = 1.0/; s/max = (2, 1)/max = (2, 1); periodic = (true, false)/; s/^walls.*/walls: ( { side = "y_min"; } );/' 'fluid.central: .*periodic' sph
with tank 's/at = (1, 0.1)/at = (1.9, 0.9)/; s/^walls.*/walls: ( { closed = true; points = ((0, 0), (1.5, 0), (1.5, 1), (0, 1)); } );/' 'probes.\[0\].at: p is behind wall 1' sph
with tank 's/^walls:   (/walls: ( { points = ((3, 0), (4, 0.3)); },/' 'walls.\[0\].points: is not used: .*outside' sph
# open sides
with channel 's/{ side = "x_max"; kind = "outflow"; }/{ side = "x_max"; }/' 'walls.\[0\].kind: inflow into a closed box' sph
with channel 's/^sph:/shapes: ( { box = ((0, 0), (2, 0.5)); } );\nsph:/' 'walls.\[0\].kind: inlets and outlets under a free surface need gravity' sph
with channel 's/nu = 0.01/nu = 0.01; gravity = (0, -9.81)/' 'walls.\[1\].pressure: .*9.81 Pa more' sph
with channel 's/"inflow"; velocity = (1, 0)/"outflow"/; s/nu = 0.01/gravity = (1, 0)/' 'fluid.gravity: .*open ends x_min and x_max.*differ by 2 Pa' sph
with channel 's/{ side = "y_max"; }/{ side = "y_min"; }/' 'walls.\[3\]: .*has a wall already' sph
with channel 's/, { side = "y_max"; }//' 'domain: .*up to its side y_max' sph
with sph 's/nu = 0.005/gravity = (1, 0)/' 'fluid.gravity: 1 m.s^2 along the periodic x' sph
# water around a line or a body, up to sides that hold nothing
island='s/^walls.*/walls: ( { closed = true; points = ((0.5, 0.2), (0.5, 0.8), (1.5, 0.8), (1.5, 0.2)); } );/; /^bodies/d'
with tank "$island" 'case.cfg:6: walls.\[0\].points: clockwise, .*counter-clockwise' sph
with tank "$island; /^shapes/d" 'walls.\[0\].points: clockwise' sph
with tank '/^walls/d; /^shapes/d' 'domain: .*up to its side x_min' sph
# the box of the particles
with coupled 's/(0.2, 0.2), (0.8, 0.8)/(0.21, 0.2), (0.8, 0.8)/' 'sph.box: x from 0.21 .*as 0.2' sph --check
with coupled 's/(0.2, 0.2), (0.8, 0.8)/(0.4, 0.4), (0.6, 0.6)/' 'sph.box: .*leave nothing .*larger' sph --check
with sph 's/dx = 0.02/dx = 0.02; box_velocity = (0.1, 0)/' 'case.cfg:6: sph.box_velocity: no box has both sides open' sph
with coupled 's/box = .*));/free = ((-3.0, 0.4), (-2.6, 0.6));/' 'sph.free: x from -3.* is not inside the domain' sph --check
sed 's/^sph:.*/sph: { dx = 0.02; R_dx = 2.0; c0 = 30.0; box = ((0.5, 0.2), (1.5, 1)); };\nfv: { cells = (16, 16); };/; /^bodies/d' tank.cfg >part.cfg
with part 's/{ side = "x_max"; },*//' 'walls: with a free surface each side .*x_max is neither' fv --check
with part '/^fv:/d; s/^walls.*/walls: ( { side = "y_min"; } );/; s/U = 3.0/field = "rest"; U = 3.0/; s/box = ((0.5, 0.2)/outer = "exact"; box = ((0.5, 0)/' \
    'sph.box: ends at x = 0.5 m under a free surface' sph --check
with part '/^fv:/d; s/(0.5, 0.2), (1.5, 1)/(0, 0), (2, 0.8)/' 'sph.box: must hold the free surface: .*y_max' sph --check
with tank 's/^sph:.*/sph: { dx = 0.02; R_dx = 2.0; box = ((0.5, 0), (1.5, 1)); };/; /^bodies/d; /^shapes/d; s/^walls.*/walls: ( { side = "y_min"; } );/' 'sph.outer: no exact solution' sph
# rows of particles
with tank 's/max = (2, 1)/max = (2.01, 1)/' 'case.cfg:10: sph.dx: .*take dx = "2.01/41" (0.04902 m) or dx = "2.01/40" (0.05025 m)' sph

# the launcher
says "no case" "$root/cases/run" nowhere
says "unknown option" "$root/cases/run" taylor_green --fast
says "SPH:COUPLER:FV" "$root/cases/run" "$tmp/coupled.cfg" -n 3
says "a rank at least" "$root/cases/run" "$tmp/coupled.cfg" -n 2:0:1
says "a rank at least" "$root/cases/run" "$tmp/sph.cfg" -n 0
printf 'format = 1;\n' >empty.cfg
says "neither" "$root/cases/run" "$tmp/empty.cfg"
mkdir folder
says "folder is a folder without a case.cfg" "$root/cases/run" folder

# meshes: files of boxes, some of them broken
all="xm xp ym yp zm zp"
stl "0.3 0.3 0.2" "0.7 0.7 0.6" >solid.stl
stl "0.3 0.3 0.2" "0.7 0.7 0.6" "" -1 >inside_out.stl
stl "0.3 0.3 0.2" "0.7 0.7 0.6" zp >open.stl
stl "0.3 0.3 0.2" "0.7 0.7 0.6" "$all" >none.stl
stl "300 300 200" "700 700 600" >mm.stl
stl "5230456 300 200" "5230457 301 201" >far.stl
stl "0.3 0.3 0.2" "nan 0.7 0.6" >not_finite.stl
stl "0.3 0.3 0.2" "0.7 0.7 0.204" >sheet_metal.stl
stl "0.5 0.3 0.2" "0.5 0.7 0.6" "xp ym yp zm zp" >plate.stl
stl "0.3 0.3 0.2" "0.32 0.32 0.22" >crumb.stl
{ stl "0.2 0.3 0.2" "0.4 0.7 0.6"; stl "0.41 0.31 0.21" "0.8 0.7 0.6"; stl "0.7 0.6 0.5" "0.9 0.9 0.9"; } >three.stl
awk 'function at(i, up, q) { q = 6.283185307 * i / 200; return "vertex " 0.5 + 0.2 * cos(q) " " 0.5 + 0.2 * sin(q) " " 0.3 + 0.02 * up }
    function tri(a, b, c) { print "facet normal 0 0 0\nouter loop\n" a "\n" b "\n" c "\nendloop\nendfacet" }
    BEGIN { print "solid drum" # without lids: short edges alone
        for (k = 0; k < 200; k++) { tri(at(k, 0), at(k + 1, 0), at(k + 1, 1)); tri(at(k, 0), at(k + 1, 1), at(k, 1)) }
        print "endsolid drum" }' >drum.stl
: >empty.stl
cat >mesh.cfg <<'END'
format = 1;
time:    { end = 0.01; };
fluid:   { rho = 1000.0; gravity = (0, 0, -9.81); };
domain:  { dim = 3; min = (0, 0, 0); max = (1, 1, 1); };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; }, { side = "z_min"; },
           { mesh = "solid.stl"; } );
shapes:  ( { form = "below"; level = 0.8; } );
sph:     { dx = 0.05; R_dx = 2.5; };
END
# tells BASE EDIT WORDS...: a case that is accepted, and what --check says of it
tells() {
    sed "$2" "$1.cfg" >case.cfg
    base=$1 edit=$2
    shift 2
    start sph out.txt case.cfg --check
    code=$?
    for words in "$@"; do
        if [ $code = 0 ] && grep -q -- "$words" out.txt; then
            passed=$((passed + 1))
        else
            failed=$((failed + 1))
            echo "FAIL: exit code $code of --check, wanted the words: $words ($base, $edit)"
            sed 's/^/      | /' out.txt | head -n 12
        fi
    done
}
if "$b/sph" mesh.cfg --check 2>&1 | grep -q 'built without a reader'; then
    echo "note: this build has no reader of meshes: their faults are not looked at"
else
    tells mesh 's/^$//' 'mesh solid: 12 triangles, closed, volume 0.064 m^3, fluid outside'
    tells mesh 's/solid.stl/inside_out.stl/' 'mesh inside_out: 1 of its 1 part(s) inside out in the file: turned' 'fluid outside'
    tells mesh 's/solid.stl/three.stl/' 'mesh three: 36 triangles in 3 parts' 'triangles pierce others, the first at' \
        'face others across less than 2 dx'
    tells mesh 's/dx = 0.05/dx = 0.1/; s/solid.stl/drum.stl/' 'edges of 0.0.* finer than the particles'
    # a gauge that the file's 7 digits put behind a body's face is on it, however fine the particles
    tells mesh '/^ *{ mesh/d; s/,$/);/; s/dx = 0.05/dx = 0.01/; s/^sph/bodies: ( { mesh = "solid.stl"; } );\nprobes: ( { name = "p"; at = (0.69999995, 0.5, 0.4); } );\n&/' \
        'mesh body'
    tells mesh 's/solid.stl"/&; weld = 0.01/' 'weld = 0.01 m is more than sph.dx.100'
    with mesh 's/solid.stl/nothing.stl/' 'case.cfg:6: walls.\[5\].mesh: nothing.stl: there is no such file' sph
    with mesh 's/solid.stl/empty.stl/' 'walls.\[5\].mesh: empty.stl: .*nothing in it' sph
    with mesh 's/solid.stl/none.stl/' 'walls.\[5\].mesh: none.stl: ' sph
    with mesh 's/solid.stl/mesh.cfg/' 'mesh.cfg: expected a file of STL, OBJ or PLY' sph
    with mesh 's/solid.stl/not_finite.stl/' 'not_finite.stl: .*not finite' sph
    with mesh 's/solid.stl/far.stl/' 'far.stl: its coordinates reach 5.23.*e+06 .*Shift it to the origin' sph
    with mesh 's/solid.stl/mm.stl/' 'mm.stl lies outside the domain: .*scale = 0.001' sph
    with mesh 's/solid.stl/crumb.stl/' 'crumb.stl is 0.02 m in size, less than sph.dx' sph
    with mesh 's/solid.stl/sheet_metal.stl/' 'sheet_metal.stl is 0.004 m thick at triangle .*thin = true' sph
    with mesh 's/^shapes/bodies: ( { mesh = "open.stl"; } );\n&/; s/,$/);/; /solid.stl/d' 'bodies.\[0\].mesh: open.stl: a body must be closed, and 4 edges .*part 1 at triangle' sph
    with mesh 's/form = "below"; level = 0.8/form = "mesh"; mesh = "open.stl"/' 'shapes.\[0\].mesh: open.stl: a shape must be closed' sph
    with mesh 's/form = "below"; level = 0.8/form = "mesh"/' 'shape 1: its mesh must be given' sph
    with mesh 's/solid.stl"/&; points = ((0, 0), (1, 1))/' 'wall 6: give one of side, points and mesh' sph
    with mesh 's/"solid.stl"/"open.stl"; kind = "no_slip"; velocity = (1, 0, 0)/; s/rho = 1000.0/& ; nu = 1e-3/' 'walls.\[5\].velocity: .*across the wall' sph
    with mesh 's/mesh = "solid.stl"/side = "z_max"; scale = 2.0/' 'walls.\[5\].scale: is not used' sph
    with mesh 's/mesh = "solid.stl"/side = "z_max"; thin = true/' 'walls.\[5\].thin: is not used' sph
    with mesh 's/mesh = "solid.stl"/side = "z_max"/; s/^sph/initial: { seed = ((0.5, 0.5, 0.1)); };\n&/' 'initial.seed: is not used' sph
    with mesh 's/sph: .*/sph: { dx = 0.05; walls = "ghosts"; };/' 'sph.walls: mirrored ghosts need plane sides' sph
    with mesh 's/^sph/probes: ( { name = "p"; at = (0.5, 0.5, 0.4); } );\n&/' 'probes.\[0\].at: p is behind the surface solid.stl' sph
    with mesh 's/sph: .*/fv: { cells = (16, 16, 16); };/' 'walls.\[5\].mesh: surfaces of triangles are for sph in 3D' fv
    with sph 's/^sph:/walls: ( { mesh = "solid.stl"; } );\n&/' 'walls.\[0\].mesh: a surface of triangles bounds a fluid of 3 dimensions' sph
    with mesh 's/mesh = "solid.stl"/points = ((0, 0), (1, 1))/' 'walls and bodies of points need 2 dimensions: in space give a mesh' sph
    with mesh 's/{ side = "y_max"; }, //; s/^shapes.*//' 'domain: the fluid fills it up to its side y_max, which is open' sph
    # what only filling finds
    for edit in 's/solid.stl/plate.stl/' 's/^sph/initial: { seed = ((0.5, 0.5, 0.9)); };\n&/'; do
        sed "$edit" mesh.cfg >case.cfg
        "$b/sph" case.cfg -o filled --force >out.txt 2>&1
        if [ $? = 2 ] && grep -q 'thin = true\|initial.seed (0.5, 0.5, 0.9) m: no fluid is there' out.txt; then
            passed=$((passed + 1))
        else
            failed=$((failed + 1))
            echo "FAIL: filling accepts $edit: $(tail -n 2 out.txt)"
        fi
    done
    # and what is none: the plate as a thin wall, in the picture
    sed 's/solid.stl"/plate.stl"; thin = true/' mesh.cfg >case.cfg
    "$b/sph" case.cfg --check=picture -o seen >out.txt 2>&1 && grep -q 'section at y' seen/sph-scene.svg ||
        { echo "FAIL: the scene with a plate is not drawn: $(tail -n 2 out.txt)"; failed=$((failed + 1)); }
fi

# the place and the time of a group's focus
cat >group.cfg <<'END'
format = 1;
time:    { end = 10.0; };
fluid:   { gravity = (0, -9.81); };
domain:  { max = (10, 1.2); };
waves:   { kind = "focused"; height = 0.1; period = 1.4; at = (6, 8); };
walls:   ( { side = "x_min"; kind = "wave"; }, { side = "x_max"; kind = "beach"; }, { side = "y_min"; } );
shapes:  ( { form = "below"; level = 0.6; } );
sph:     { dx = 0.05; };
END
tells group 's/^$//' 'its focus: 6 m along its direction, t = 8 s'
grep -q 'waves.at' out.txt && bad "a focus within the run is warned of" out.txt
tells group 's/at = (6, 8)/at = (6, 0)/' 'warning: waves.at: the focus, t = 0 s, is not within the run, from t = 2.8 s'

# regions of refinement
cat >apr.cfg <<'END'
format = 1;
time:    { end = 1.0; };
fluid:   { nu = 0.005; gravity = (0, -9.81); };
domain:  { min = (0, 0); max = (2, 1); };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } );
shapes:  ( { form = "box"; box = ((0, 0), (1, 0.6)); } );
sph:     { dx = 0.02; };
apr:     { levels = 2; regions = (
  { level = 1; min = (0.2, -0.1); max = (1.2, 0.6); },
  { level = 2; min = (0.5, -0.1); max = (0.9, 0.3); } ); };
END
sed 's/domain:.*/domain: { min = (0, 0); max = (2, 1); periodic = (false, true); };/; s/"x_min"/"x_min"; kind = "inflow"; velocity = (1, 0)/
s/"x_max"/"x_max"; kind = "outflow"/; s/, { side = "y_min"; }//; /^shapes/d; s/, gravity.*/;/; s/gravity[^;]*;//' apr.cfg >apr_open.cfg
timeout 60 "$b/sph" apr.cfg --check >out.txt 2>&1 && timeout 60 "$b/sph" apr_open.cfg --check -p 'apr.regions=({ min = (0.6, 0.3); max = (1.2, 0.7); })' -p apr.levels=1 >out.txt 2>&1 ||
    { failed=$((failed + 1)); echo "FAIL: regions in order are refused"; cat out.txt; }
with apr 's/levels = 2/levels = 2; method = "graded"/' 'case.cfg:3: .*gravity: graded particles have no gravity' sph
with apr 's/levels = 2/levels = 2; method = "graded"/; s/, gravity = (0, -9.81)//' 'apr.regions: graded needs one box' sph
with apr 's/levels = 2/levels = 2; method = "weights"/; s/{ side = "y_min"; }/{ points = ((2, 0), (0, 0)); }/' 'walls: particles of mixed sizes need plane sides' sph
with apr 's/levels = 2/levels = 2; method = "coalescence"/; s/dx = 0.02;/dx = 0.02; scheme = "delta";/' 'sph.scheme: particles of mixed sizes need riemann' sph
with apr 's/levels = 2/levels = 2; method = "weights"/; s/"y_min"/"y_min"; kind = "no_slip"/' 'walls: particles of mixed sizes need slip walls' sph
with apr 's/levels = 2/levels = 1/' 'case.cfg:10: .*level: 2 is above apr.levels = 1' sph
with apr 's/levels = 2/levels = 3/' 'case.cfg:8: apr.levels: 3, but no region' sph
with apr 's/max = (0.9, 0.3)/max = (0.4, 0.3)/' 'case.cfg:10: .*max: 0.4 m is not larger than min, 0.5 m' sph
with apr 's/max = (0.9, 0.3)/max = (0.6, 0.3)/' 'case.cfg:10: .*max: x from 0.5 to 0.6 m: guards R = 0.04 m deep .*at least 0.12 m' sph
with apr 's/max = (0.9, 0.3)/max = (1.1, 0.3)/' 'case.cfg:10: .*min: level 2 comes to 0.1 m from the edge of level 1 .*0.12 m' sph
with apr 's/max = (0.9, 0.3)/max = (1.4, 0.3)/' 'case.cfg:10: .*min: level 2 comes .*outside of it' sph
with apr 's/min = (0.2, -0.1); max = (1.2/min = (2.2, -0.1); max = (3.2/' 'case.cfg:9: .*min: the region, x from 2.2 to 3.2 m, lies outside' sph
with apr 's/max = (1.2, 0.6);/max = (1.2, 0.6); radius = 0.1;/' 'case.cfg:9: .*radius: is not used: only a sphere' sph
with apr 's/max = (1.2, 0.6);/max = (1.2, 0.6); along = "x";/' 'case.cfg:9: .*along: is not used: nothing is followed' sph
with apr 's/max = (1.2, 0.6);/max = (1.2, 0.6); follow = "hull";/' 'case.cfg:9: .*follow: no body has the name `hull' sph
with apr 's/max = (1.2, 0.6);/max = (1.2, 0.6); follow = "peak"; along = "w";/' 'case.cfg:9: .*along: `w. is not a list of axes' sph
with apr 's/{ level = 1; .*/{ shape = "sphere"; level = 1; centre = (0.4, 0.3); },/' 'case.cfg:8: apr.regions: region 1: a sphere needs a radius' sph
with apr 's/{ level = 1; .*/{ shape = "body"; level = 1; body = "hull"; offset = 0.3; },/' 'case.cfg:9: .*body: no body has the name `hull' sph
with apr 's/{ level = 1; .*/{ shape = "wall"; level = 1; wall = 2; offset = 0.3; },/' 'case.cfg:9: .*wall: wall 2 is a side of the domain' sph
with apr 's/max = (0.9, 0.3);/max = (0.9, 0.3); velocity = (60, 0);/' 'case.cfg:10: .*velocity: 60 m/s: the region moves .* dx of level 2 in a step' sph
with apr 's/max = (0.9, 0.3);/max = (0.9, 0.3); velocity = (3, 0);/' 'case.cfg:10: .*velocity: the region has left .* along x at t = ' sph
with apr 's/max = (0.9, 0.3);/max = (0.9, 0.3); motion = ({ kind = "harmonic"; axis = "rz"; amplitude = 1; period = 1; });/' 'case.cfg:10: .*motion: term 1: a region does not turn' sph
with apr 's/max = (0.9, 0.3);/max = (0.9, 0.3); motion = "nothing.txt";/' 'case.cfg:10: .*motion: term 1: motion .*nothing.txt: no such file' sph
with apr 's/max = (0.9, 0.3);/max = (0.9, 0.3); motion = ({ kind = "harmonic"; axis = "z"; amplitude = 0.1; period = 1; });/' 'case.cfg:10: .*motion: term 1: axis z in a case of 2 dim' sph
with apr 's/max = (0.9, 0.3);/max = (0.9, 0.3); motion = ({ kind = "harmonic"; axis = "x"; period = 1; });/' 'case.cfg:10: .*motion: term 1: a harmonic term needs an amplitude' sph
with apr 's/max = (0.9, 0.3);/max = (0.9, 0.3); motion = ({ kind = "polynomial"; axis = "x"; coefficients = (0, 0.1); amplitude = 1; });/' 'case.cfg:10: .*motion.*amplitude: is not used: only a harmonic' sph
with apr 's/max = (0.9, 0.3);/max = (0.9, 0.3, 0.2);/' 'case.cfg:10: .*max: z component 0.2 in a case of 2 dim' sph
with apr 's/max = (0.9, 0.3);/max = (0.9, 0.3); velocity = (0, 0, 1);/' 'case.cfg:10: .*velocity: z component 1 in a case of 2 dim' sph
with apr 's/levels = 2;/levels = 2; around = 4;/' 'case.cfg:8: apr.around: is not used' sph
with apr 's/levels = 2;/levels = 2; particles = 1e5;/' 'case.cfg:8: apr.particles: is not used' sph
with apr 's/levels = 2;/levels = 2; particles = 1000; criteria = ( { kind = "surface"; distance = 1; } );/' 'apr.particles: level 0 and the regions .* could refine nothing within 1000' sph
with apr 's/levels = 2;/levels = 2; criteria = ({ kind = "vorticity"; });/' 'case.cfg:8: apr.criteria: criterion 1 needs .above' sph
with apr 's/levels = 2;/levels = 2; criteria = ({ kind = "surface"; above = 0.1; });/' 'case.cfg:8: .*above: is not used: this kind has a bound `distance' sph
with apr 's/levels = 2;/levels = 2; margin = 1.0;/' 'case.cfg:8: apr.margin: 1 is not allowed' sph
with apr '9,10d; s/levels = 2;.*/levels = 2; };/' 'case.cfg:8: apr: neither regions nor criteria' sph
with apr_open 's/(0.9, 0.3)/(1.5, 0.3)/; s/(1.2, 0.6)/(1.8, 0.6)/; s/-0.1/0.1/g' 'case.cfg:.*apr.regions: level 1 reaches into the open side x_max' sph
says 'apr.regions: level 1 reaches into the open side x_min at' "$b/sph" "$root/cases/taylor_green/case.cfg" --check -p 'apr.regions=({ min = (0.25, 0.4); max = (0.6, 0.6); })'
says 'apr.local_steps: levels of a coupled job step together' "$b/sph" "$root/cases/taylor_green/case.cfg" --check -p 'apr.regions=({ min = (0.36, 0.36); max = (0.64, 0.64); })' -p apr.local_steps=true
sed '/^accept/,$d; s/j_min = "joined"; j_max = "joined";//' "$root/cases/half_cylinder_fv/case.cfg" >ring.cfg
says 'blocks.\[1\].j_min: .*the ends of a full ring lie on each other' "$b/fv" ring.cfg --check
sed '/^accept/,$d; s/j_min = "joined"; j_max = "joined";/j_min = "periodic"; j_max = "periodic";/' "$root/cases/half_cylinder_fv/case.cfg" >ring.cfg
says 'blocks.\[1\].j_min: .*the ends of a full ring lie on each other' "$b/fv" ring.cfg --check

# folders and files of others, where root can become another user
chmod 755 .
if [ "$(id -u)" = 0 ] && setpriv --reuid=65534 --clear-groups test -r sph.cfg 2>/dev/null; then
    cp sph.cfg mine.cfg && chmod 600 mine.cfg
    says "result/deep, or write in it: Permission denied" env OMPI_MCA_orte_tmpdir_base=/tmp setpriv --reuid=65534 --clear-groups "$b/sph" sph.cfg -o result/deep
    says "mine.cfg cannot be read: no permission" setpriv --reuid=65534 --clear-groups "$root/cases/run" mine.cfg
fi

# what is no fault: a mark of UTF-8, ends of lines of other systems, tabs, all on one line
{ printf '\357\273\277'; sed 's/$/\r/; s/ /\t/g' sph.cfg; } >marked.cfg
tr '\n' ' ' <sph.cfg >line.cfg
for c in marked line; do
    if "$b/sph" $c.cfg --check >out.txt 2>&1; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAIL: $c.cfg is refused: $(head -n 3 out.txt)"
    fi
done

# nothing is overwritten
"$b/sph" sph.cfg -o kept >/dev/null 2>&1 || { echo "FAIL: the sound case does not run"; failed=$((failed + 1)); }
before=$(ls -l kept | cksum)
says "already" "$b/sph" sph.cfg -o kept
[ "$before" = "$(ls -l kept | cksum)" ] || { echo "FAIL: a refused run touched its folder"; failed=$((failed + 1)); }

# What a series is to be compared with is known once the columns are: before the first step.
printf 't,E\n0,1\n1,1\n' >ref.csv
"$b/fv" fv.cfg -p 'accept=({what="kinetic enrgy";reference="ref.csv";column="E";tolerance=1.0;})' -o accepted >out.txt 2>&1 </dev/null
if [ $? = 2 ] && grep -q 'accept.*no column kinetic enrgy: did you mean kinetic energy?' out.txt; then
    passed=$((passed + 1))
else
    failed=$((failed + 1))
    echo "FAIL: accept.what that no series has"
    tail -n 5 out.txt
fi
# the columns of a program, too
sed 's/name = "p"/name = "mass"/' tank.cfg >case.cfg
"$b/sph" case.cfg -o alike >out.txt 2>&1 </dev/null
if [ $? = 2 ] && grep -q 'probes.\[0\].name: mass: series.csv has a column of this name' out.txt; then
    passed=$((passed + 1))
else
    failed=$((failed + 1))
    echo "FAIL: a gauge with the name of another column"
    tail -n 5 out.txt
fi
# a coupled job: what all three programs find is printed once; -o is one folder; ranks of a solver alone are one number
cat >three.cfg <<'CASE'
format = 1;
time:    { end = 1.0; };
fluid:   { rho = -1.0; nu = 0.01; };
domain:  { dim = 2; min = (0, 0); max = (1, 1); periodic = (true, true); };
initial: { field = "taylor_green"; U = 1.0; L = 1.0; };
sph:     { dx = 0.0125; box = ((0.15, 0.15), (0.85, 0.85)); };
fv:      { cells = (32, 32); };
CASE
for how in "-n 1:1:1" --check; do
    # shellcheck disable=SC2086
    ESTRAN_BUILD="$b" "$root/cases/run" three.cfg $how -o three >out.txt 2>&1
    [ $? = 2 ] && [ "$(grep -c 'fluid.rho: -1 is not allowed' out.txt)" = 1 ] || bad "a fault of three programs, $how: $(cat out.txt)"
done
sed 's/rho = -1.0/rho = 1.0/' three.cfg >split.cfg
timeout -k 1 60 mpirun --quiet --bind-to none --oversubscribe -np 1 "$b/sph" split.cfg -o one : -np 1 "$b/coupler" split.cfg -o two : \
    -np 1 "$b/fv" split.cfg -o two >out.txt 2>&1
[ $? = 2 ] && grep -q 'sph writes into one, coupler into two: give all programs the same -o' out.txt || bad "two folders: $(cat out.txt)"
ESTRAN_BUILD="$b" "$root/cases/run" poiseuille_sph -n 1:1:1 >out.txt 2>&1
[ $? = 2 ] && grep -q 'is for sph alone, which takes one number, as -n 1' out.txt || bad "three numbers for one program: $(cat out.txt)"
echo "bad_input: $passed refused as wanted, $failed not"
[ $failed = 0 ]
