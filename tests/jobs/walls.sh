#!/bin/sh
# Walls and bodies as a case has them: a wedge that enters water, schemes and the walls they can take, walls that are
# too thin. SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"

# 30 degrees at constant speed, no gravity: F = 14.02 rho V^3 t of both sides (similarity solution; Zhao & Faltinsen,
# J. Fluid Mech. 246, 1993: 14.14). The slope does not depend on where in its first dx the entry begins.
cat >wedge.cfg <<'END'
format = 1;
time:    { end = 0.1; };
fluid:   { rho = 1000.0; };
domain:  { dim = 2; min = (-0.7, -0.5); max = (0.7, 0.3); };
initial: { field = "rest"; U = 1.0; };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } );
shapes:  ( { form = "box"; box = ((-0.7, -0.5), (0.7, 0)); } );
bodies:  ( { name = "wedge"; velocity = (0, -1); points = ((0, 0), (-0.4, 0.23094), (0.4, 0.23094)); } );
sph:     { dx = 0.01; c0 = 50.0; };
output:  { series = 1; snapshots = false; };
END
timeout 60 "$b/sph" wedge.cfg -o wedge --force >log.txt 2>&1 || bad "wedge ended with $?: $(tail -n 3 log.txt)"
slope=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /force y/) k = i; next }
    $1 > 0.025 { n++; t += $1; f += $k; tt += $1 * $1; tf += $1 * $k }
    END { print (n * tf - t * f) / (n * tt - t * t) / 14020 }' wedge/series.csv)
holds "$slope > 0.85 && $slope < 1.15" || bad "wedge: dF/dt is $slope of the similarity solution, wanted within 15 %"
[ "$(number wedge particles_returned)" = 0 ] || bad "wedge: $(number wedge particles_returned) particles put back"
defect=$(number wedge defect)
holds "$defect < 1e-10" || bad "wedge: momentum off by $defect"

# a block at rest near a floor, beside a side and between both: Archimedes on each of its faces, 392.4 N/m, and the
# balance of fluid, block and walls
sum() { awk -v x="$1" 'BEGIN { print x + 0.2 }'; }
# resting NAME HEIGHT POINTS [END]: a body at rest in water of 0.5 m, in a tank of that height
resting() {
    cat >"$1.cfg" <<END
format = 1;
time:    { end = ${4:-0.4}; };
fluid:   { rho = 1000.0; gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (1.0, $2); };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } );
shapes:  ( { form = "below"; level = 0.5; } );
bodies:  ( { name = "b"; points = ($3); } );
sph:     { dx = 0.025; };
output:  { series = 10; snapshots = false; };
END
    timeout 60 "$b/sph" "$1.cfg" -o "$1" --force >log.txt 2>&1 || bad "$1: ended with $?" log.txt
}
gap() { # NAME X Y
    resting gap 0.6 "($2, $3), ($2, $(sum "$3")), ($(sum "$2"), $(sum "$3")), ($(sum "$2"), $3)"
    up=$(number gap y) across=$(number gap x)
    holds "$up > 380.6 && $up < 404.2" || bad "gap, $1: lift $up, Archimedes 392.4 N/m within 3 %"
    holds "$across < 20 && $across > -20" || bad "gap, $1: pushed sideways by $across N/m"
    holds "$(number gap defect) < 1e-10" || bad "gap, $1: momentum off by $(number gap defect)"
}
gap "1.6 dx over the floor" 0.4 0.04
gap "2 dx over the floor" 0.4 0.05
gap "1.5 dx from a side" 0.0375 0.15
gap "2.5 dx from floor and side" 0.0625 0.0625

# faces that stand on the floor at an angle, and a block in a corner: p A on each, 3 % of the whole
corner() { # NAME WANTED_X WANTED_Y POINTS
    resting corner 0.8 "$4" 0.8 # the start takes half of 0.4 s
    off=$(awk -v x="$(number corner x)" -v y="$(number corner y)" -v wx="$2" -v wy="$3" 'BEGIN {
        print sqrt((x - wx) ^ 2 + (y - wy) ^ 2) / sqrt(wx ^ 2 + wy ^ 2) }')
    holds "$off < 0.03" || bad "corner, $1: force off by $off, wanted 3 %: ($(number corner x), $(number corner y)) N/m"
    holds "$(number corner defect) < 1e-10" || bad "corner, $1: momentum off by $(number corner defect)"
}
corner "block on the floor" 0 -588.6 "(0.4, 0), (0.4, 0.2), (0.6, 0.2), (0.6, 0)"
corner "block in the corner" 784.8 -588.6 "(0.8, 0), (0.8, 0.2), (1, 0.2), (1, 0)"
corner "45 degrees" 1226.25 784.8 "(0.8, 0), (0.6, 0.2), (0.6, 0.8), (1, 0.8), (1, 0)"
corner "120 degrees" 1226.25 -453.1 "(0.6, 0), (0.71547, 0.2), (0.71547, 0.8), (1, 0.8), (1, 0)"

# walls that stand on a point between waters of different depth let nothing pass: once the first particles have found
# their places, the levels stay within dx/10
stands() { # NAME WALLS BODIES
    cat >stands.cfg <<END
format = 1;
time:    { end = 1.2; };
fluid:   { rho = 1000.0; gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (1.2, 1.0); };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }$2 );
shapes:  ( { form = "box"; box = ((0, 0), (0.6, 0.6)); }, { form = "box"; box = ((0.6, 0), (1.2, 0.3)); } );
$3
probes:  ( { name = "deep"; kind = "level"; at = (0.2, 0.2); }, { name = "low"; kind = "level"; at = (1.0, 0.2); } );
sph:     { dx = 0.025; };
output:  { series = 5; snapshots = false; };
END
    timeout 60 "$b/sph" stands.cfg -o stands --force >log.txt 2>&1 || bad "$1: ended with $?"
    holds "$(number stands particles_lost) + $(number stands particles_returned) == 0" ||
        bad "$1: $(number stands particles_lost) particles lost, $(number stands particles_returned) put back"
    for what in deep low; do
        moved=$(awk -F, -v w=$what 'NR == 1 { for (i = 1; i <= NF; i++) if (index($i, w) == 1) k = i; next }
            $1 > 0.4 && !n++ { first = $k } { z = $k } END { print z - first }' stands/series.csv)
        near "$moved" 0 0.0025 || bad "$1: the $what water moved by $moved m, wanted dx/10"
    done
}
stands "flap on a point" "" 'bodies: ( { name = "f"; points = ((0.6, 0), (0.55, 0.15), (0.55, 0.9), (0.65, 0.9), (0.65, 0.15)); } );'
stands "blunt wall on a point" ', { closed = true; points = ((0.6, 0), (0.5, 0.1), (0.5, 0.9), (0.7, 0.9), (0.7, 0.1)); }' ""
stands "body on the tip of another" "" 'bodies: ( { name = "a"; points = ((0.4, 0), (0.4, 0.1), (0.6, 0.2), (0.8, 0.1), (0.8, 0)); },
    { name = "b"; points = ((0.6, 0.2), (0.55, 0.35), (0.55, 0.9), (0.65, 0.9), (0.65, 0.35)); } );'
stands "flap on the ridge of a floor" ', { points = ((0, 0), (0.6, 0.15), (1.2, 0)); }' 'bodies: ( { name = "f"; points = ((0.6, 0.15),
    (0.55, 0.3), (0.55, 0.9), (0.65, 0.9), (0.65, 0.3)); } );'

# a closed tank full of water at rest: the background pressure is uniform and moves nothing, so p = -rho g (y - 0.5)
cat >closed.cfg <<'END'
format = 1;
time:    { end = 0.6; };
fluid:   { rho = 1000.0; gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (1, 1); };
initial: { level = 0.5; };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
probes:  ( { name = "floor"; at = (0.5, 0.0); }, { name = "top"; at = (0.5, 1.0); } );
sph:     { dx = 0.05; c0 = 40.0; walls = "nfm"; background = true; };
output:  { series = 10; snapshots = false; };
END
for scheme in riemann delta; do
    timeout 60 "$b/sph" closed.cfg -o closed --force -p sph.scheme=$scheme >log.txt 2>&1 || bad "closed, $scheme ended with $?"
    ends=$(awk -F, 'END { print $(NF - 1) / 4905, $NF / -4905 }' closed/series.csv)
    echo "$ends" | awk '{ exit !($1 > 0.95 && $1 < 1.05 && $2 > 0.95 && $2 < 1.05) }' ||
        bad "closed, $scheme: pressures at floor and roof are $ends of rho g h"
    [ "$(number closed particles_returned)" = 0 ] || bad "closed, $scheme: particles put back"
done

# 2D dam break, 15 particles deep: what the shift gives back to gravity presses nobody through the floor
cat >dam.cfg <<'END'
format = 1;
time:    { end = 1.2; };
fluid:   { rho = 997.0; gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (1.6, 1.2); };
initial: { field = "rest"; U = 1.72; };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } );
shapes:  ( { form = "box"; box = ((0, 0), (0.6, 0.3)); } );
sph:     { dx = 0.02; c0 = 30.0; };
output:  { series = 10; snapshots = false; };
END
timeout 60 "$b/sph" dam.cfg -o dam --force >log.txt 2>&1 || bad "dam ended with $?"
holds "$(number dam particles_returned) <= 20" || bad "dam: $(number dam particles_returned) of 450 particles put back"

# a particle and a layer of them under a roof, in air: walls hold nothing up, all falls with g
for left in 0 -0.2; do
    cat >roof.cfg <<END
format = 1;
time:    { end = 0.3; };
fluid:   { rho = 1000.0; gravity = (0, -9.81); };
domain:  { dim = 2; min = (-0.5, 0); max = (0.5, 1.0); };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
shapes:  ( { form = "box"; box = (($left, 0.98), (0.02, 1.0)); } );
sph:     { dx = 0.02; };
output:  { series = 5; snapshots = false; };
END
    timeout 20 "$b/sph" roof.cfg -o roof --force >log.txt 2>&1 || bad "roof ended with $?"
    fall=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) { if ($i ~ /momentum y/) k = i; if ($i ~ /^mass/) m = i }; next }
        END { print -$k / ($m * 9.81 * $1) }' roof/series.csv)
    holds "$fall > 0.999 && $fall < 1.001" || bad "under a roof water falls with $fall g"
done
# one that runs there at 30 m/s is held: let go at 0.2 m/s, a plate that follows would hit it again and again
sed 's/end = 0.3/end = 0.01/; s/((-0.2, 0.98), (0.02, 1.0));/((-0.2, 0.98), (0.02, 1.0)); velocity = (30, -0.2);/; s/series = 5/series = 1/' roof.cfg >film.cfg
timeout 20 "$b/sph" film.cfg -o film --force >log.txt 2>&1 || bad "film ended with $?"
left=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /momentum y/) k = i; next } !first { first = $k } END { print $k / first }' film/series.csv)
holds "$left > -0.2 && $left < 0.2" || bad "a film leaves the roof that it runs along with $left of its speed"

# a tank with an oblique floor and a wall between two levels, 3 dx thick; delta takes normal flux walls, standard none
cat >tank.cfg <<'END'
format = 1;
time:    { end = 0.5; };
fluid:   { rho = 1000.0; gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (1, 1); };
initial: { field = "rest"; U = 2.21; };
walls:   ( { points = ((0, 1), (0, 0), (0.4, 0), (0.4, 0.9), (0.55, 0.9), (0.55, 0), (1, 0), (1, 1)); } );
shapes:  ( { form = "box"; box = ((0, 0), (0.4, 0.6)); }, { form = "box"; box = ((0.55, 0), (1, 0.3)); } );
sph:     { dx = 0.05; c0 = 30.0; };
output:  { series = 10; snapshots = false; };
END
for scheme in delta riemann; do
    timeout 60 "$b/sph" tank.cfg -o tank --force -p sph.scheme=$scheme >log.txt 2>&1 || bad "$scheme ended with $?"
    holds "$(number tank particles_returned) + $(number tank particles_lost) == 0" || bad "$scheme: particles through walls"
done
# refuses WORDS ARGS...
refuses() {
    words=$1
    shift
    timeout 20 "$b/sph" "$@" -o none >log.txt 2>&1
    [ $? = 2 ] || bad "$* is not refused"
    grep -q "$words" log.txt || bad "$*: no word of: $words"
}
# channel.cfg: plane Poiseuille flow, Re 10; delta and standard [4.22-4.25] beside no-slip walls on their default step
cat >channel.cfg <<'END'
format = 1;
time:    { end = 4.0; };
fluid:   { rho = 1000.0; nu = 0.1; gravity = (0.8, 0); };
domain:  { dim = 2; min = (0, 0); max = (0.5, 1); periodic = (true, false); };
initial: { field = "poiseuille"; U = 1.0; L = 1.0; };
walls:   ( { side = "y_min"; kind = "no_slip"; }, { side = "y_max"; kind = "no_slip"; } );
sph:     { dx = 0.05; c0 = 10.0; walls = "nfm"; };
output:  { series = 20; snapshots = false; };
END
for scheme in delta standard; do
    for dx in 0.05 $([ $scheme = standard ] || echo 0.025); do
        timeout 120 "$b/sph" channel.cfg -o channel --force -p sph.scheme=$scheme -p sph.dx=$dx >log.txt 2>&1 || bad "channel, $scheme, ended with $?"
        holds "$(number channel velocity_l2) < 0.01" || bad "channel, $scheme, dx $dx: velocity off by $(number channel velocity_l2)"
    done
done
refuses "sph.scheme: standard .* take riemann" tank.cfg -p sph.scheme=standard
refuses "sph.scheme: standard .* corners" channel.cfg -p sph.scheme=standard -p domain.periodic="(false,false)" -p 'walls=({ side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; kind = "no_slip"; }, { side = "y_max"; })'
refuses "sph.scheme: standard .* weighs" channel.cfg -p sph.scheme=standard -p 'initial.field=rest' -p 'fluid.gravity=(0.8,-1)'
timeout 60 "$b/sph" tank.cfg -o tank --force -p sph.scheme=standard -p sph.walls=fixed -p time.end=0.2 >log.txt 2>&1 || bad "standard with fixed ghosts ended with $?"
refuses "sph.walls: .*fixed_ghosts" tank.cfg -p sph.walls=fixed_ghosts
sed 's/0\.55/0.5/g' tank.cfg >thin.cfg
refuses "faces of wall 1 are 0.1 m apart at (0.45, " thin.cfg
sed 's/^sph:/bodies: ( { name = "block"; points = ((0.1, 0.02), (0.1, 0.2), (0.35, 0.2), (0.35, 0.02)); } );\nsph:/' tank.cfg >gap.cfg
refuses "a gap of 0.02 m between body 1 (block) and wall 1" gap.cfg
sed 's/^sph:/bodies: ( { name = "block"; points = ((0.06, 0), (0.06, 0.2), (0.35, 0.2), (0.35, 0.02), (0.12, 0.02), (0.12, 0)); } );\nsph:/' tank.cfg >foot.cfg
refuses "wall 1 and body 1 (block) are 0.02 m apart" foot.cfg # it touches elsewhere
echo "walls: wedge $slope, momentum $defect, $failed faults"
[ $failed = 0 ]
