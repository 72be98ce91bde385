#!/bin/sh
# Scenes between meshes, as a user makes them: a tank at rest is as still however it is turned, in millimetres as in
# kilometres, on one rank as on two; nobody gets out; ParaView's files name what is there.
# SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
bad() { # WHAT
    failed=$((failed + 1))
    echo "FAIL: $1"
    tail -n 6 out.txt
}
stl "-0.4 -0.3 -0.3" "0.4 0.3 0.3" >tank.stl
stl "-0.1 -0.1 -0.1" "0.1 0.1 0.1" >cube.stl
# tank NAME SIZE TURN: of that size in units of the file, turned about its middle
tank() {
    at() { awk -v x="$1" -v k="$size" 'BEGIN { printf "%.9g", x * k }'; }
    size=$2
    cat >"$1.cfg" <<END
format = 1;
time:    { end = $(awk -v k="$2" 'BEGIN { printf "%.9g", 0.5 * sqrt(k) }'); };
fluid:   { rho = 1000.0; gravity = (0, 0, -9.81); };
domain:  { dim = 3; max = ($(at 1), $(at 1), $(at 1)); };
walls:   ( { mesh = "tank.stl"; scale = $2; rotate = $3; translate = ($(at 0.5), $(at 0.5), $(at 0.5)); } );
shapes:  ( { form = "below"; level = $(at 0.55); } );
sph:     { dx = $(at 0.05); R_dx = 2.5; };
END
}
run() { # NAME RANKS [ARGS]
    name=$1 ranks=$2
    shift 2
    timeout -k 5 100 mpirun --quiet --bind-to none --oversubscribe -np "$ranks" "$b/sph" "$name.cfg" -o "$name-$ranks" --force "$@" >out.txt 2>&1 </dev/null ||
        bad "$name on $ranks ranks: exit code $?"
}
# within A B FACTOR WHAT: A and B do not differ by more
within() { awk -v a="$1" -v b="$2" -v f="$3" 'BEGIN { exit !(a + 0 > 0 && b + 0 > 0 && a <= f * b && b <= f * a) }' || bad "$4: $1 and $2"; }

tank straight 1 "(0, 0, 0)"
"$b/sph" straight.cfg --check 2>&1 | grep -q 'built without a reader' && { echo "note: no reader of meshes in this build"; exit 0; }
tank turned 1 "(10, 20, 15)"
tank small 0.001 "(10, 20, 15)"
tank large 1000 "(10, 20, 15)"
for name in straight turned small large; do run $name 1 -p output.snapshots=false; done
run turned 2 -p output.snapshots=false
for name in straight-1 turned-1 turned-2; do
    [ "$(number $name particles_returned)$(number $name particles_lost)" = 00 ] || bad "$name: $(number $name particles_returned) put back, $(number $name particles_lost) lost"
    awk -v m="$(number $name max_mach)" 'BEGIN { exit !(m + 0 > 0 && m < 0.01) }' || bad "$name: not still, Ma $(number $name max_mach)"
done
within "$(last straight-1/series.csv 'kinetic energy')" "$(last turned-1/series.csv 'kinetic energy')" 4 "kinetic energy of a straight and a turned tank"
within "$(last turned-1/series.csv 'kinetic energy')" "$(last turned-2/series.csv 'kinetic energy')" 1.000000001 "kinetic energy on one rank and on two"
within "$(number turned-1 particles)" "$(number turned-2 particles)" 1 "particles on one rank and on two"
for name in small large; do
    within "$(number turned-1 particles)" "$(number $name-1 particles)" 1 "particles of tanks of 1 m and $name"
    within "$(number turned-1 max_mach)" "$(number $name-1 max_mach)" 1.001 "Mach number of tanks of 1 m and $name"
done

# what is written: a free cube floats up, with its places in each snapshot
cat >float.cfg <<'END'
format = 1;
time:    { end = 0.02; };
fluid:   { rho = 1000.0; gravity = (0, 0, -9.81); };
domain:  { dim = 3; max = (0.8, 0.6, 0.6); };
walls:   ( { mesh = "tank.stl"; translate = (0.4, 0.3, 0.3); } );
bodies:  ( { name = "cube"; mesh = "cube.stl"; translate = (0.4, 0.3, 0.25); density = 500; free = true; } );
shapes:  ( { form = "below"; level = 0.45; } );
sph:     { dx = 0.05; R_dx = 2.5; };
END
run float 2
for data in $(sed -n 's/.*>\(sph_[a-z0-9_]*\.h5:[^<]*\)<.*/\1/p' float-2/sph_walls.xdmf); do
    h5dump -d "${data#*:}" -H "float-2/${data%%:*}" >out.txt 2>&1 || bad "sph_walls.xdmf names $data, which is not there"
done
[ "$(grep -c '<Time' float-2/sph_walls.xdmf)" = 2 ] || bad "sph_walls.xdmf has $(grep -c '<Time' float-2/sph_walls.xdmf) times, wanted 2"
awk -v v="$(number float-2 volume)" 'BEGIN { exit !(v > 0.00799 && v < 0.00801 || v > 0.2879 && v < 0.2881) }' || bad "volume of a mesh in summary.json: $(number float-2 volume)"
awk -v up="$(last float-2/series.csv 'cube z')" 'BEGIN { exit !(up > 0.2503) }' || bad "the light cube does not rise: z = $(last float-2/series.csv 'cube z')"

# a tank without a floor: refused where its rim ends in the water, run where that is closed by a side of the domain, or
# as a thin wall; an open top in the air is none of this
stl "0.3 0.3 0.3" "0.7 0.7 0.9" "zm zp" -1 >tube.stl
stl "0.3 0.3 0.3" "0.7 0.7 0.9" "zp" -1 >bowl.stl
rim() { # NAME MESH SIDE_OF_THE_FLOOR MORE
    cat >"$1.cfg" <<END
format = 1;
time:    { end = 0.01; };
fluid:   { rho = 1000.0; gravity = (0, 0, -9.81); };
domain:  { dim = 3; min = (0, 0, $3); max = (1, 1, 1); };
walls:   ( { mesh = "$2.stl"; $4 }, { side = "z_min"; }, { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
shapes:  ( { form = "box"; box = ((0.3, 0.3, 0.3), (0.7, 0.7, 0.6)); } );
sph:     { dx = 0.05; R_dx = 2.5; };
END
}
rim hole tube 0
timeout 60 "$b/sph" hole.cfg -o hole --force >out.txt 2>&1
[ $? = 2 ] || bad "a rim in the water is not refused"
grep -q 'mesh tube ends in the water at .*thin = true' out.txt || bad "a rim in the water: its message"
rim thin tube 0 "thin = true;"
rim floor tube 0.3
rim bowl bowl 0
for name in thin floor bowl; do run $name 1; done

# the forecast counts the triangles that have particles near them: a ball in water costs three times the tank alone, one
# in the air nothing
forecast() { # Z: height of the ball
    cat >ball.cfg <<END
format = 1;
time:    { end = 0.5; };
fluid:   { rho = 1000.0; gravity = (0, 0, -9.81); };
domain:  { dim = 3; max = (0.8, 0.6, 1.2); };
walls:   ( { side = "z_min"; }, { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
shapes:  ( { form = "box"; box = ((0, 0, 0), (0.8, 0.6, 0.6)); } );
bodies:  ( { name = "ball"; radius = 0.15; translate = (0.4, 0.3, $1); } );
sph:     { dx = 0.05; c0 = 40; };
END
    "$b/sph" ball.cfg --check 2>&1 | awk '/^run time/ { for (i = 1; i < NF; i++) if ($(i + 1) ~ /^(s|min|h)$/) print $i * ($(i + 1) == "s" ? 1 : $(i + 1) == "h" ? 3600 : 60) }'
}
awk -v wet="$(forecast 0.3)" -v dry="$(forecast 1.0)" 'BEGIN { exit !(dry > 0 && wet > 2 * dry && wet < 8 * dry) }' ||
    bad "forecast with a ball in the water, above it: $(forecast 0.3), $(forecast 1.0) s"

echo "meshes: $failed faults"
[ $failed = 0 ]
