#!/bin/sh
# Gauges of velocity and discharge in both programs: a level channel that carries q = u h has it through any section, upright
# or oblique, and the volume q t at the end; a section over the water has none; blocks say the same as cells, two ranks the
# same as one; of a column that falls half goes through the middle; bodies take gauges along.
# SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
# volume_of DIR GAUGE
volume_of() { sed -n "/\"$2\": {/,/}/s/.*\"volume\": \([-+0-9.e]*\).*/\1/p" "$1/summary.json"; }
# channel NAME SOLVER: 1 m long, 0.2 m deep, 0.35 m/s
channel() {
    cat >"$1.cfg" <<END
format = 1;
time:    { end = 2; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; max = (1, 0.4); };
initial: { field = "uniform"; velocity = (0.35, 0); };
walls:   ( { side = "x_min"; kind = "inflow"; discharge = 0.07; }, { side = "x_max"; kind = "outflow"; level = 0.2; }, { side = "y_min"; }$3 );
shapes:  ( { form = "below"; level = 0.2; } );
probes:  ( { name = "flow"; kind = "discharge"; at = (0.5, 0); to = (0.5, 0.4); }, { name = "slant"; kind = "discharge"; at = (0.4, 0); to = (0.6, 0.4); },
           { name = "turned"; kind = "discharge"; at = (0.5, 0.4); to = (0.5, 0); }, { name = "over"; kind = "discharge"; at = (0.5, 0.26); to = (0.5, 0.4); },
           { name = "in"; kind = "velocity"; at = (0.5, 0.1); }, { name = "air"; kind = "velocity"; at = (0.5, 0.35); } );
$2
output:  { snapshots = false; series = 2; };
END
}
top=', { side = "y_max"; }'
channel cells 'fv: { cells = (50, 20); };' "$top"
channel grains 'sph: { dx = 0.02; c0 = 20.0; };'
cp cells.cfg ranks.cfg
for name in cells grains; do
    solver=fv
    [ $name = grains ] && solver=sph
    timeout -k 5 120 "$b/$solver" $name.cfg -o $name --force >$name.txt 2>&1 || bad "$name: exit code $?" $name.txt
done
timeout -k 5 120 $mpi -n 2 "$b/fv" ranks.cfg -o ranks --force >ranks.txt 2>&1 || bad "two ranks" ranks.txt
for name in cells grains; do
    for gauge in flow slant; do
        q=$(last $name/series.csv $gauge)
        close_to "$q" 0.07 0.03 || bad "$name: discharge $gauge $q, not 0.07 m^2/s" $name.txt
        volume=$(volume_of $name $gauge)
        close_to "$volume" 0.14 0.03 || bad "$name: volume $gauge $volume, not 0.14 m^2" $name.txt
    done
    sum=$(awk -v a="$(last $name/series.csv flow)" -v b="$(last $name/series.csv turned)" 'BEGIN { print a + b }')
    near "$sum" 0 1e-9 || bad "$name: a section turned round adds $sum"
    near "$(last $name/series.csv over)" 0 1e-6 || bad "$name: $(last $name/series.csv over) m^2/s through the air"
    close_to "$(last $name/series.csv 'in u')" 0.35 0.03 && near "$(last $name/series.csv 'in v')" 0 0.01 ||
        bad "$name: velocity $(last $name/series.csv 'in u') $(last $name/series.csv 'in v'), not 0.35 0 m/s"
    [ "$(last $name/series.csv 'air u')" = nan ] || [ -z "$(last $name/series.csv 'air u')" ] || bad "$name: a velocity of air: $(last $name/series.csv 'air u')"
    grep -q 'discharge  flow: 0.1[34]' $name.txt || bad "$name: no volume in the log" $name.txt
done
for gauge in flow slant 'in u'; do
    close_to "$(last cells/series.csv "$gauge")" "$(last ranks/series.csv "$gauge")" 1e-6 || bad "two ranks say another $gauge"
done
# Sections on the side of a period, or along all of one, and parts of a particle's width take what goes through them, in an
# oblique stream (exact, as of any lattice); those on open sides what comes in and goes out. At first sections beyond the
# domain or a period, and those without another end, are told.
cat >stream.cfg <<'END'
format = 1;
time:    { end = 0.3; };
domain:  { max = (2, 1); periodic = (true, true); };
initial: { field = "uniform"; velocity = (1, 0.5); };
probes:  ( { name = "seam"; kind = "discharge"; at = (0, 0); to = (0, 1); }, { name = "end"; kind = "discharge"; at = (2, 0); to = (2, 1); },
           { name = "mid"; kind = "discharge"; at = (0.51, 0); to = (0.51, 1); }, { name = "thin"; kind = "discharge"; at = (1, 0.5); to = (1, 0.52); } );
sph:     { dx = 0.05; };
output:  { snapshots = false; series = 1; };
END
sed 's/, 0.5); };/, 0); };/; s/ periodic = (true, true);//; s/^sph/walls: ( { side = "x_min"; kind = "inflow"; velocity = (1, 0); }, { side = "x_max"; kind = "outflow"; }, { side = "y_min"; }, { side = "y_max"; } );\n&/' stream.cfg >ends.cfg
for name in stream ends; do "$b/sph" $name.cfg -o $name --force >$name.txt 2>&1 || bad "$name: exit code $?" $name.txt; done
for gauge in seam end mid; do
    close_to "$(volume_of stream $gauge)" 0.3 1e-9 || bad "stream: $(volume_of stream $gauge) m^2 through $gauge, not 0.3" stream.txt
    close_to "$(volume_of ends $gauge)" 0.3 0.01 || bad "ends: $(volume_of ends $gauge) m^2 through $gauge, not 0.3" ends.txt
done
close_to "$(volume_of stream thin)" 0.006 1e-9 || bad "stream: $(volume_of stream thin) m^2 through 0.02 m, not 0.006"
refused_by sph stream.cfg 's/to = (1, 0.52); //' 'probes.\[3\].to: thin: must be given'
refused_by sph stream.cfg 's/(2, 0); to = (2, 1)/(3, 0); to = (3, 1)/' 'probes.\[1\].at: end: its section, x from 3 to 3 m, lies outside'
refused_by sph stream.cfg 's/(2, 0); to = (2, 1)/(2, 0); to = (2, 1.1)/' 'probes.\[1\].at: end: its section, y from 0 to 1.1 m, reaches beyond the period'
# A column of honey that falls in a closed tank, in cells and in two joined blocks: at rest half of it is beyond the middle.
tank() {
    cat >"$1.cfg" <<END
format = 1;
time:    { end = $2; };
fluid:   { nu = 0.05; gravity = (0, -9.81); };
domain:  { dim = 2; max = (0.8, 0.3); };
initial: { U = 2.0; };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
shapes:  ( { form = "box"; box = ((0, 0), (0.2, 0.2)); } );
probes:  ( { name = "flow"; kind = "discharge"; at = (0.4, 0); to = (0.4, 0.3); } );
$3
output:  { snapshots = false; series = 1; };
END
}
tank even 5 'fv: { cells = (64, 24); };'
sed '/^walls/d' even.cfg | sed 's/^fv:.*/blocks: ( { name = "a"; min = (0, 0); max = (0.4, 0.3); cells = (32, 24); i_min = "slip"; i_max = "joined"; j_min = "slip"; j_max = "slip"; }, { name = "b"; min = (0.4, 0); max = (0.8, 0.3); cells = (32, 24); i_min = "joined"; i_max = "slip"; j_min = "slip"; j_max = "slip"; } ); fv: { };/' >blocks.cfg
for name in even blocks; do timeout -k 5 120 "$b/fv" $name.cfg -o $name --force >$name.txt 2>&1 || bad "$name: exit code $?" $name.txt; done
for name in even blocks; do
    v=$(volume_of $name flow)
    close_to "$v" 0.02 0.03 || bad "$name: $v m^2 of 0.04 m^2 went through the middle" $name.txt
done
# Gauges that a body takes with it: over a box that goes up and down in water at rest (a period of 2 s, sph) the pressure
# follows the depth, rho g y, but for the water's inertia (w^2 A/g: 5 %), where a gauge that stands reads a tenth of it at
# most; before a cylinder that swings (fv) the water goes with its wall
# (0.96 of its speed there in potential flow).
cat >lift.cfg <<'END'
format = 1;
time:    { end = 2; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; max = (0.8, 0.5); };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } );
shapes:  ( { form = "below"; level = 0.4; } );
bodies:  ( { name = "box"; points = ((0.3, 0.16), (0.3, 0.24), (0.5, 0.24), (0.5, 0.16)); centre = (0.4, 0.2);
             motion = ( { kind = "harmonic"; axis = "y"; amplitude = 0.05; period = 2; ramp = 0.2; } ); } );
probes:  ( { name = "with"; at = (0.6, 0.2); body = "box"; }, { name = "stands"; at = (0.6, 0.2); },
           { name = "level"; kind = "level"; at = (0.4, 0.24); body = "box"; } );
sph:     { dx = 0.02; };
output:  { snapshots = false; series = 2; };
END
cat >swing.cfg <<'END'
format = 1;
time:    { end = 2.5; };
fluid:   { rho = 1.0; nu = 0.02; };
domain:  { dim = 2; min = (-6, -5); max = (6, 5); };
initial: { field = "rest"; U = 1.0; };
walls:   ( { side = "x_min"; kind = "slip"; }, { side = "x_max"; kind = "outflow"; }, { side = "y_min"; kind = "slip"; }, { side = "y_max"; kind = "slip"; } );
blocks:  ( { name = "outer"; mapping = "stretched"; min = (-6, -5); max = (6, 5); cells = (60, 52); focus = (0, 0); stretch = (3.5, 3.5); },
           { name = "cylinder"; mapping = "annulus"; radius = (0.5, 1.75); stretch = (1.5, 0); cells = (20, 48); i_min = "wall"; j_min = "joined"; j_max = "joined";
             motion = ( { kind = "harmonic"; axis = "x"; amplitude = -0.7957747; period = 5.0; } ); } );
probes:  ( { name = "with"; kind = "velocity"; at = (0.51, 0); body = "cylinder"; } );
fv:      { };
output:  { snapshots = false; series = 2; };
END
timeout -k 5 200 "$b/sph" lift.cfg -o lift --force >lift.txt 2>&1 || bad "lift: exit code $?" lift.txt
timeout -k 5 200 "$b/fv" swing.cfg -o swing --force >swing.txt 2>&1 || bad "swing: exit code $?" swing.txt
# part FILE COLUMN OTHER FROM: what of OTHER is in COLUMN, least squares, from then on
part() { awk -F, -v p="$2" -v q="$3" -v from="$4" 'NR == 1 { for (i = 1; i <= NF; i++) { if (index($i, p) == 1) a = i; if (index($i, q) == 1) c = i } next }
    $1 >= from { n++; x += $c; y += $a; xx += $c * $c; xy += $c * $a } END { if (n) print (xy - x * y / n) / (xx - x * x / n) }' "$1/series.csv"; }
follows=$(part lift with 'box y' 0.2) stands=$(part lift stands 'box y' 0.2)
close_to "$follows" -9810 0.1 || bad "a gauge that a body takes with it reads $follows Pa/m of its way, not -9810" lift.txt
near "$stands" 0 981 || bad "a gauge that stands reads $stands Pa/m of a body's way"
near "$(last lift/series.csv level)" 0.4 0.02 || bad "the level over a body is $(last lift/series.csv level) m, not 0.4"
wall=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if (index($i, "with u") == 1) c = i; next } { u = -cos(2 * 3.14159265 * $1 / 5); n += ($c - u)^2; d += u^2 } END { print sqrt(n/d) }' swing/series.csv)
below "$wall" 0.15 || bad "water before a cylinder is off by $wall of its speed" swing.txt
# not_told FILE CHANGE MESSAGE PROGRAM
not_told() {
    sed "$2" "$1" >faulty.cfg
    "$b/$4" faulty.cfg --check >faulty.txt 2>&1 && bad "accepted: $2"
    grep -q "$3" faulty.txt || bad "$2: not told \"$3\"" faulty.txt
}
not_told lift.cfg 's/0.2); body = "box"/0.2); body = "bax"/' "probes.\[0\].body: with: no body .bax' moves" sph
not_told swing.cfg 's/body = "cylinder"/body = "outer"/' 'probes.\[0\].body: is not used: no block of that name moves' fv
# of two half rings the one that has the motion takes the other along, and its gauges
sed -e 's/name = "cylinder"; mapping = "annulus";/& arc = (0, 180);/' -e 's/amplitude = -0.7957747; period = 5.0; } ); }/&, { name = "half"; mapping = "annulus"; arc = (180, 360); radius = (0.5, 1.75); stretch = (1.5, 0); cells = (20, 24); i_min = "wall"; j_min = "joined"; j_max = "joined"; }/' \
    -e 's/cells = (20, 48)/cells = (20, 24)/' -e 's/at = (0.51, 0); body = "cylinder"/at = (0.02, -0.51); body = "half"/' swing.cfg >halves.cfg
"$b/fv" halves.cfg --check >halves.txt 2>&1 || bad "a gauge on a block that is joined to one that moves is refused" halves.txt
not_told lift.cfg 's/^sph/gauges: ( { name = "g"; probes = "level level"; period = 1; } );\n&/' 'gauges that move with a body' sph
# A level gauge that a tank has left behind reads nothing, one over dry ground the height of the ground, not of the domain's end
cat >leaves.cfg <<'END'
format = 1;
time:    { end = 0.15; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; min = (-1, -0.3); max = (1.5, 1); };
shapes:  ( { form = "box"; box = ((-0.5, 0.1), (0, 0.3)); } );
blocks:  ( { name = "tank"; min = (-0.5, 0.1); max = (0.5, 0.7); cells = (20, 12); i_min = "slip"; i_max = "slip"; j_min = "slip"; j_max = "slip";
             motion = ( { kind = "polynomial"; axis = "x"; coefficients = (0, 0.5); until = 0.15; } ); } );
probes:  ( { name = "left"; kind = "level"; at = (-0.45, 0); }, { name = "dry"; kind = "level"; at = (0.4, 0); } );
fv:      { };
output:  { snapshots = false; series = 1; };
END
timeout -k 5 100 "$b/fv" leaves.cfg -o leaves --force >leaves.txt 2>&1 || bad "leaves: exit code $?" leaves.txt
dry=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if (index($i, "dry") == 1) c = i } NR == 2 { print $c }' leaves/series.csv)
near "$dry" 0.1 1e-4 || bad "a gauge over the dry floor at 0.1 m reads $dry m"
[ "$(last leaves/series.csv left)" = nan ] || bad "a gauge that the tank has left reads $(last leaves/series.csv left)"
# Across periodic sides: vortices are the same on both sides of x = 0, so that no water crosses it; where the box of a coupled
# job reaches over that side, sph reads what lies in it, (cos 2kx + cos 2ky) rho U^2 F^2/4 + p0 of the vortices
cat >seam.cfg <<'END'
format = 1;
time:    { end = 0.1; };
fluid:   { rho = 1.0; nu = 1.0e-2; };
domain:  { dim = 2; min = (0, 0); max = (1.0, 1.0); periodic = (true, true); };
initial: { field = "taylor_green"; };
probes:  ( { name = "near"; at = (0.05, 0.5); }, { name = "mid"; at = (0.9, 0.5); }, { name = "far"; at = (0.4, 0.5); },
           { name = "v"; kind = "velocity"; at = (0.0, 0.25); } );
output:  { snapshots = false; series = 1; };
sph:     { dx = 0.02; noise = 0.0; };
END
"$b/sph" seam.cfg -o seam --force >seam.txt 2>&1 || bad "seam ended with $?" seam.txt
u=$(last seam/series.csv "v u")
near "$u" 0 1e-4 || bad "seam: $u m/s across a plane of symmetry"
sed 's/^sph: .*/sph: { dx = 0.02; free = ((0.75, 0.3), (1.2, 0.7)); }; fv: { cells = (32, 32); };/; /"v"/d; s/"far"; at = (0.4, 0.5); },/"far"; at = (0.4, 0.5); } );/' seam.cfg >over.cfg
"$root/cases/run" over.cfg -n 1:1:1 -o over --force >over.txt 2>&1 || bad "over ended with $?" over.txt
near_=$(last over/sph-series.csv "near ") mid=$(last over/sph-series.csv "mid ")
near "$near_" 0.386 0.02 && near "$mid" 0.279 0.02 || bad "over: $near_, $mid Pa at the places of a box over a periodic side (0.386, 0.279)"
[ -z "$(last over/fv-series.csv "near ")$(last over/sph-series.csv "far ")" ] || bad "over: a gauge is read by the wrong program"
# Two boxes, each with a body that takes a gauge along: each program reads its own; waves are told apart from gauges of one part
cat >boxes.cfg <<'END'
format = 1;
time:    { end = 0.03; };
fluid:   { rho = 1.0; nu = 1.0e-2; };
domain:  { dim = 2; min = (0, 0); max = (4.0, 2.0); periodic = (true, true); };
initial: { field = "uniform"; U = 0.3; velocity = (0.2, 0.0); };
bodies:  ( { name = "a"; motion = ( { kind = "harmonic"; amplitude = 0.02; period = 1.0; } ); points = ((0.9, 0.9), (1.1, 0.9), (1.1, 1.1), (0.9, 1.1)); },
           { name = "b"; motion = ( { kind = "harmonic"; amplitude = 0.02; period = 1.0; } ); points = ((2.9, 0.9), (3.1, 0.9), (3.1, 1.1), (2.9, 1.1)); } );
probes:  ( { name = "ga"; at = (1.0, 1.2); body = "a"; }, { name = "gb"; at = (3.0, 1.2); body = "b"; } );
sph_a:   { dx = 0.04; free = ((0.6, 0.6), (1.4, 1.4)); };
sph_b:   { dx = 0.04; free = ((2.6, 0.6), (3.4, 1.4)); };
fv:      { cells = (64, 32); };
output:  { snapshots = false; series = 1; };
END
"$root/cases/run" boxes.cfg -n 1:1:1 -o boxes --force >boxes.txt 2>&1 || bad "boxes ended with $?" boxes.txt
[ -n "$(last boxes/sph_a-series.csv "ga ")" ] && [ -n "$(last boxes/sph_b-series.csv "gb ")" ] || bad "boxes: a gauge on a body is not read by the body's program"
[ -z "$(last boxes/sph_a-series.csv "gb ")$(last boxes/sph_b-series.csv "ga ")$(last boxes/fv-series.csv "g")" ] || bad "boxes: a gauge on a body is read twice"
cat >parts.cfg <<'END'
format = 1;
time:    { end = 4.0; };
fluid:   { gravity = (0, -9.81); };
domain:  { max = (8, 1.4); };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } );
shapes:  ( { form = "box"; box = ((0, 0), (8, 1)); } );
probes:  ( { name = "w1"; kind = "level"; at = (5.0, 1); }, { name = "w2"; kind = "level"; at = (5.5, 1); }, { name = "w3"; kind = "level"; at = (7.0, 1); } );
gauges:  ( { name = "g"; probes = "w1 w2"; period = 1.0; } );
sph:     { dx = 0.1; box = ((2.5, 0), (6.5, 1.4)); };
fv:      { cells = (50, 10); };
END
for p in sph fv; do
    "$b/$p" parts.cfg --check >parts.txt 2>&1 || bad "$p refuses gauges in one part" parts.txt
    not_told parts.cfg 's/"w1 w2"/"w1 w3"/' 'w1 and w3 are read by different programs' $p
done
echo "across a periodic side: $u m/s, $near_ and $mid Pa"
echo "a body takes a gauge along: $follows Pa/m (-9810), one that stands $stands; before a wall off by $wall"
echo "$failed faults"
[ $failed = 0 ]
