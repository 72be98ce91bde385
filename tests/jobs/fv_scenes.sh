#!/bin/sh
# Scenes of fv alone where two treatments meet: a shape and a period, an inflow and the first row.
# SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
run() { # CASE ARGUMENTS...: runs CASE.cfg into the folder CASE
    name=$1
    shift
    timeout 100 "$b/fv" "$name.cfg" -o "$name" --force "$@" >"$name.txt" 2>&1 || bad "$name ends with $?" "$name.txt"
}
# a film on a slope, gravity along a period: levels count across the film, wherever it lies
cat >slope.cfg <<'END'
format = 1;
time:    { end = 0.05; };
fluid:   { rho = 1000.0; nu = 0.01; gravity = (5, -5); };
domain:  { dim = 2; min = (3.7, -11.3); max = (4.7, -10.8); periodic = (true, false); };
walls:   ( { side = "y_min"; kind = "no_slip"; } );
shapes:  ( { form = "below"; level = -11.09; } );
probes:  ( { name = "film"; kind = "level"; at = (3.9, -11.3); } );
fv:      { cells = (16, 24); };
END
run slope
near "$(last slope/series.csv film)" -11.09 1e-9 || bad "a film on a slope stands at $(last slope/series.csv film) m" slope.txt
# a solitary wave meets a box as high as the domain as it meets the wall that ends a domain there; it is no exact solution then
cat >meets.cfg <<'END'
format = 1;
time:    { end = 1.5; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (3, 0.6); };
initial: { field = "solitary"; amplitude = 0.08; crest = 1.2; level = 0.3; };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
probes:  ( { name = "up"; kind = "level"; at = (2.9, 0); } );
fv:      { cells = (60, 12); };
END
sed 's/max = (3, /max = (3.4, /; s/(60, /(68, /; s/^probes/bodies:  ( { name = "box"; box = ((3, 0), (3.4, 0.6)); } );\n&/' meets.cfg >meets_box.cfg
run meets
run meets_box
up() { awk -F, 'NR == 1 { while ($(++k) !~ /^up/) ; next } $k > most { most = $k } END { print most }' "$1/series.csv"; }
close_to "$(up meets_box)" "$(up meets)" 0.001 || bad "a solitary wave runs up to $(up meets_box) m at a box, $(up meets) at a wall" meets_box.txt
awk "BEGIN { exit !($(up meets) > 0.46) }" || bad "a solitary wave of 0.08 m over 0.3 m runs up to $(up meets) m alone" meets.txt
sed 's/^bodies: .*/blocked: ( { name = "box"; min = (3, 0); max = (3.4, 0.6); } );/; s/end = 1.5/end = 0.1/' meets_box.cfg >meets_blocked.cfg
run meets_blocked
for name in meets_box meets_blocked; do
    ! grep -q '"error"' $name/summary.json || bad "errors of a wave that meets a box are reported" $name.txt
done
# a discharge that opens at once over water at rest: the first row has the weight of the water, on cells and on blocks, on any
# ranks (the pressure of the push is without bounds: it showed 1.7 and 255 kN)
cat >push.cfg <<'END'
format = 1;
time:    { end = 0.02; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (2, 0.5); };
walls:   ( { side = "x_min"; kind = "inflow"; discharge = 0.1; }, { side = "x_max"; kind = "outflow"; }, { side = "y_min"; } );
shapes:  ( { box = ((0, 0), (0.5, 0.1)); } );
fv:      { cells = (64, 32); };
output:  { series = 1; };
END
sed 's/^fv:.*/fv: { };\nblocks: ( { max = (2, 0.5); cells = (64, 32); j_max = "slip"; } );/' push.cfg >push_block.cfg
first() { awk -F, -v name="$2" 'NR == 1 { for (i = 1; i <= NF; i++) if (index($i, name) == 1) c = i } NR == 2 { print $c }' "$1"; }
run push
run push_block
$mpi -np 2 "$b/fv" push.cfg -o push2 >push2.txt 2>&1 || bad "push on two ranks ends with $?" push2.txt
for name in push push_block push2; do
    near "$(first $name/series.csv 'force y')" -490.5 1 || bad "$name: first force $(first $name/series.csv 'force y') N" $name.txt
done
# a level alone makes no surface, which the run says
sed 's/^shapes:.*/initial: { level = 0.3; };/; s/^walls:.*/walls: ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );/' push.cfg >full.cfg
run full
grep -q '^warning: initial.level: 0.3 m .*no free surface.*form = "below"' full.txt || bad "a level without a surface passes without a word" full.txt
sed -i 's/level = 0.3/level = 0.5/' full.cfg
run full
! grep -q 'warning: initial.level' full.txt || bad "a level on the top of the domain is warned of" full.txt
# a fine block on the floor of a tank of still water: the floor that both have counts once (it pressed with 1.15 of the weight)
cat >floor.cfg <<'END'
format = 1;
time:    { end = 0.05; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (1, 1); };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } );
shapes:  ( { form = "below"; level = 0.53; } );
blocks:  ( { name = "tank"; max = (1, 1); cells = (24, 24); j_max = "slip"; },
           { name = "fine"; min = (0.3, 0); max = (0.7, 0.4); cells = (20, 20); j_min = "slip"; } );
fv:      { };
END
run floor
$mpi -np 2 "$b/fv" floor.cfg -o floor2 >floor2.txt 2>&1 || bad "floor on two ranks ends with $?" floor2.txt
for name in floor floor2; do
    close_to "$(last $name/series.csv 'force y')" -5199.3 0.001 || bad "$name: $(last $name/series.csv 'force y') N" $name.txt
done
# a channel of 10 mm after 40 times of its layers in one step of newton is 2.4 % off, and a warning says so; its remedy is right
cat >steps.cfg <<'END'
format = 1;
time:    { end = 40.0; };
fluid:   { rho = 1000.0; nu = 1e-5; };
domain:  { dim = 2; max = (1, 0.01); };
walls:   ( { side = "x_min"; kind = "outflow"; pressure = 1.0; }, { side = "x_max"; kind = "outflow"; },
           { side = "y_min"; kind = "no_slip"; }, { side = "y_max"; kind = "no_slip"; } );
probes:  ( { name = "q"; kind = "discharge"; at = (0.3, 0); to = (0.3, 0.01); } );
fv:      { cells = (8, 16); integrator = "newton"; cfl = 100.0; };
output:  { snapshots = false; };
END
run steps
cfl=$(sed -n 's/^warning: .*layers that grow.*fv.cfl below \([0-9.e-]*\),.*/\1/p' steps.txt)
[ -n "$cfl" ] || bad "one step for 40 times of a channel's layers passes without a word" steps.txt
run steps -p "fv.cfl=${cfl:-1}"
! grep -q 'layers that grow' steps.txt || bad "fv.cfl=$cfl: warned of again" steps.txt
close_to "$(last steps/series.csv q)" 8.3333e-6 0.005 || bad "q = $(last steps/series.csv q) m^2/s for 8.3333e-6" steps.txt
# water thrown up to the lid is not told to stand above it
cat >lid.cfg <<'END'
format = 1;
time:    { end = 0.55; };
fluid:   { nu = 1e-4; gravity = (0, -9.81, 0); };
domain:  { dim = 3; max = (0.8, 0.6, 0.4); };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; }, { side = "z_min"; }, { side = "z_max"; } );
shapes:  ( { box = ((0, 0, 0), (0.3, 0.4, 0.4)); } );
fv:      { cells = (16, 12, 8); };
output:  { snapshots = false; series = 1; };
END
run lid
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /^water up to y/) c = i; next } $c > most { most = $c } END { exit !(most == 0.6) }' lid/series.csv ||
    bad "water stands above the lid at 0.6 m, or does not reach it" lid.txt
echo "fv_scenes: $failed faults"
[ $failed = 0 ]
