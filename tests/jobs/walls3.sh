#!/bin/sh
# Walls and bodies of triangles as a case has them: a body that goes with the stream, water beside a thin plate, tanks
# that are turned and cut otherwise. SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
run() { timeout 100 "$b/sph" "$1.cfg" -o "$1" --force >"$1.txt" 2>&1 || bad "$1 ended with $?: $(tail -n 3 "$1.txt")"; }
# largest FILE COLUMN: of the absolute values
largest() { awk -F, -v w="$2" 'NR == 1 { for (i = 1; i <= NF; i++) if (index($i, w) == 1) k = i; next }
    { v = $k < 0 ? -$k : $k; m = v > m ? v : m } END { print m + 0 }' "$1/series.csv"; }

# no force, no moment on a body that goes with the stream; over rho U^2 a^2 = 1.1e2 N
stl "0.35 0.35 0.35" "0.65 0.65 0.65" >cube.stl
cat >stream.cfg <<'END2'
format = 1;
time:    { end = 0.1; };
fluid:   { rho = 1000.0; };
domain:  { dim = 3; min = (0, 0, 0); max = (1, 1, 1); periodic = (true, true, true); };
initial: { field = "uniform"; U = 1.0; velocity = (1.0, 0.5, 0.0); };
bodies:  ( { name = "cube"; mesh = "cube.stl"; centre = (0.5, 0.5, 0.5); velocity = (1.0, 0.5, 0.0); } );
sph:     { dx = 0.0833333333333333333; R_dx = 2.5; c0 = 10.0; transport = "none"; };
output:  { series = 1; snapshots = false; };
END2
run stream
for what in "cube force x" "cube force y" "cube force z" "cube moment x" "cube moment z"; do
    f=$(largest stream "$what")
    holds "$f < 1e-7" || bad "stream: $what is $f"
done

# a thin plate, solid or a sheet, with water of 0.5 m on one side and air on the other: nothing gets through, and the
# water does not know of the other side
stl "0.49 -0.2 -0.2" "0.51 0.7 1.2" >plate.stl
stl "0.5 -0.2 -0.2" "0.52 0.7 1.2" "xp ym yp zm zp" >sheet.stl
cat >plate.cfg <<'END2'
format = 1;
time:    { end = 0.3; };
fluid:   { rho = 1000.0; gravity = (0, 0, -9.81); };
domain:  { dim = 3; min = (0, 0, 0); max = (1, 0.5, 1); };
initial: { field = "rest"; U = 2.2; };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; }, { side = "z_min"; },
           { mesh = "plate.stl"; thin = true; fluid_side = "outside"; } );
shapes:  ( { form = "box"; box = ((0, 0, 0), (0.49, 0.5, 0.5)); } );
probes:  ( { name = "left"; kind = "level"; at = (0.25, 0.25, 0); }, { name = "right"; kind = "level"; at = (0.65, 0.25, 0); } );
sph:     { dx = 0.05; R_dx = 2.5; c0 = 30.0; };
output:  { series = 10; snapshots = false; };
END2
sed 's/plate.stl/sheet.stl/; s/"outside"/"sheet"/' plate.cfg >sheet.cfg
for c in plate sheet; do
    run $c
    holds "$(number $c particles_returned) + $(number $c particles_lost) == 0" || bad "$c: particles through it"
    [ "$(largest $c right)" = 0 ] || bad "$c: $(largest $c right) m of water behind it"
    holds "$(number $c max_mach) < 5e-3" || bad "$c: Mach $(number $c max_mach) beside it"
    holds "$(number $c defect) < 1e-10" || bad "$c: momentum off by $(number $c defect)"
done

# a cube of eight particles that stands on the floor under water: p A on its top, 3 %, and nothing to a side
stl "0.3 0.3 0" "0.7 0.7 0.4" >block.stl
cat >block.cfg <<'END2'
format = 1;
time:    { end = 0.3; };
fluid:   { rho = 1000.0; gravity = (0, 0, -9.81); };
domain:  { dim = 3; min = (0, 0, 0); max = (1, 1, 1); };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; }, { side = "z_min"; } );
shapes:  ( { form = "below"; level = 0.7; } );
bodies:  ( { name = "block"; mesh = "block.stl"; } );
sph:     { dx = 0.05; };
output:  { series = 10; snapshots = false; };
END2
run block
holds "$(number block z) < -456.8 && $(number block z) > -485.1" || bad "block: $(number block z) N, wanted -470.9 N within 3 %"
for way in x y; do
    holds "$(number block $way) < 1 && $(number block $way) > -1" || bad "block: pushed along $way by $(number block $way) N"
done

# the same tank as sides of the domain, as a mesh, and turned by 30 degrees: nobody lost, and when what the start has
# stirred is over, |u| below 1e-3 c0 in the mean of squares
stl "0 0 0" "0.6 0.6 0.8" >tank.stl
cat >sides.cfg <<'END2'
format = 1;
time:    { end = 0.8; };
fluid:   { rho = 1000.0; gravity = (0, 0, -9.81); };
domain:  { dim = 3; min = (0, 0, 0); max = (0.6, 0.6, 0.8); };
initial: { field = "rest"; U = 2.0; };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; }, { side = "z_min"; } );
shapes:  ( { form = "below"; level = 0.4; } );
sph:     { dx = 0.05; R_dx = 2.5; c0 = 25.0; };
output:  { series = 5; snapshots = false; };
END2
sed 's/walls:.*/walls: ( { mesh = "tank.stl"; } );/' sides.cfg >mesh.cfg
sed 's/walls:.*/walls: ( { mesh = "tank.stl"; rotate = (0, 0, 30); } );/
    s/min = (0, 0, 0); max = (0.6, 0.6, 0.8)/min = (-0.35, -0.05, 0); max = (0.6, 0.9, 0.8)/' sides.cfg >turned.cfg
for c in sides mesh turned; do
    run $c
    holds "$(number $c particles_returned) + $(number $c particles_lost) == 0" || bad "$c: particles through walls"
    holds "$(number $c defect) < 1e-10" || bad "$c: momentum off by $(number $c defect)"
done
# a mesh on the sides of the domain holds the water as these do: its weight is there from the start
deepest() { awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /max density/) k = i } NR == 2 { print $k - 1000 }' "$1/series.csv"; }
holds "$(deepest mesh) > 0.95 * $(deepest sides)" || bad "mesh: starts with a density of 1000 + $(deepest mesh) kg/m^3"
speed() { # rms over c0
    awk -F, 'NR > 1 && $1 > 0.5 { s += 2 * $3 / $5; n++ } END { print sqrt(s / n) / 25 }' "$1/series.csv"
}
for c in sides mesh turned; do
    u=$(speed $c)
    holds "$u < 1e-3" || bad "$c: |u| is $u c0"
done
# a lid that drives a cavity: the work that it does is no energy from nowhere (the watch of the run would end it)
cat >lid.cfg <<'END2'
format = 1;
time:    { end = 1.0; };
fluid:   { rho = 1000.0; nu = 0.01; };
domain:  { dim = 3; min = (0, 0, 0); max = (1, 1, 1); periodic = (false, true, false); };
initial: { field = "rest"; U = 1.0; };
walls:   ( { side = "x_min"; kind = "no_slip"; }, { side = "x_max"; kind = "no_slip"; }, { side = "z_min"; kind = "no_slip"; },
           { side = "z_max"; kind = "no_slip"; velocity = (1, 0, 0); } );
sph:     { dx = 0.08333333333333333; R_dx = 2.5; c0 = 10.0; };
output:  { series = 10; snapshots = false; };
END2
run lid
holds "$(number lid energy_gain) < 0.03" || bad "lid: $(number lid energy_gain) of the energy from nowhere"

echo "walls3: $failed faults; |u|/c0 $(speed sides), $(speed mesh), $(speed turned)"
[ $failed = 0 ]
