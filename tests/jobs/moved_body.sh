#!/bin/sh
# A program of its own moves a body of sph (motion of kind partner): coupler/examples/spring.c, a cylinder on a spring in a
# round tank of water. Its period is that of its mass and of the water's that theory adds, heavy or lighter than that water;
# beside fv it goes as the free body on the same spring that sph has itself. What cannot be is refused, and a program that
# never starts MPI ends the job. SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
spring() { # DIR RANKS CASE "BODY MASS STIFFNESS STRETCH ADDED" ARGS...
    d=$1 r=$2 case=$3 of=$4
    shift 4
    timeout -k 5 300 "$root/cases/run" "$case" -n "$r" -o "$d" --force "$@" --with "$b/examples/spring $d $of" >"$d.txt" 2>&1
    code=$?
}
# period FILE STRETCH: twice the mean time between crossings of the middle
period() { awk -F, -v m="$2" 'NF == 4 && $1 + 0 > 0 { x = $2 - m; if (n++ && x * old < 0) { z = t + ($1 - t) * old / (old - x); if (!k++) first = z } old = x; t = $1 }
    END { print (k > 1 ? 2 * (z - first) / (k - 1) : "none") }' "$1"; }
# pi a^2 rho (b^2 + a^2)/(b^2 - a^2) = 173.5 kg/m: with 200 kg and 14 745 N/m a period of 1 s, with 50 kg 8823 N/m. Sound
# crosses the tank in a tenth of it, so that a second order of that, 1 %, is left, and one for 8 particles in a radius
began=$(date +%s)
timeout -k 5 300 "$root/cases/run" "$root/coupler/examples/spring.cfg" -n 1 -o brief --force -p time.end=0.02 --with "$b/examples/spring brief cylinder 200 14745 0.02 173" 2>&1 | cat >brief.txt
[ $(($(date +%s) - began)) -lt 30 ] || bad "a job of a moment with another program took $(($(date +%s) - began)) s"
for of in "200 14745" "50 8823"; do
    d=swing${of% *}
    spring $d 1 "$root/coupler/examples/spring.cfg" "cylinder $of 0.02 173" -p time.end=1.4
    [ $code = 0 ] || bad "$d: exit code $code" $d.txt
    T=$(period $d.txt 0.02)
    close_to "$T" 1 0.02 || bad "$d: period $T s, with the added mass of theory 1 s"
    echo "$d: period $T s"
done
# on two ranks of sph the same
spring ranks 2 "$root/coupler/examples/spring.cfg" "cylinder 200 14745 0.02 173" -p time.end=0.3
spring rank 1 "$root/coupler/examples/spring.cfg" "cylinder 200 14745 0.02 173" -p time.end=0.3
close_to "$(last ranks/sph-series.csv 'cylinder x')" "$(last rank/sph-series.csv 'cylinder x')" 1e-6 || bad "another motion on two ranks"
# beside fv; the free body of sph has the same mass, and a line that pulls to the same place with the same stiffness
cat >beside.cfg <<'END'
format = 1;
time:    { end = 0.5; };
fluid:   { rho = 1000.0; nu = 0.001; };
domain:  { dim = 2; min = (-1, -1); max = (1, 1); };
initial: { field = "rest"; U = 0.2; };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
bodies:  ( { name = "box"; points = ((-0.1, -0.1), (-0.1, 0.1), (0.1, 0.1), (0.1, -0.1)); motion = ( { kind = "partner"; } ); } );
sph:     { dx = 0.025; c0 = 10.0; box = ((-0.7, -0.7), (0.7, 0.7)); };
fv:      { cells = (32, 32); };
output:  { every = 0.25; series = 5; snapshots = false; };
END
sed 's/motion = .*/free = true; mass = 80; inertia = 1; lock = "y rz"; lines = ( { from = (0, 0); to = (0.92, 0); stiffness = 6000; length = 0.9; } ); } );/' beside.cfg >free.cfg
spring beside 1:1:1 beside.cfg "box 80 6000 0.02 60" -p coupling.memory=9
[ $code -le 1 ] || bad "beside fv: exit code $code" beside.txt
timeout -k 5 300 "$root/cases/run" free.cfg -n 1:1:1 -o free --force >free.txt 2>&1
close_to "$(last beside/sph-series.csv 'box x')" "$(last free/sph-series.csv 'box x')" 0.02 ||
    bad "moved by a partner to $(last beside/sph-series.csv 'box x') m, free on the same spring to $(last free/sph-series.csv 'box x')"
# coupling steps that another program shortens want more smoothing: told, with what it takes
spring short 1:1:1 beside.cfg "box 80 6000 0.02 60" -p time.end=0.05
grep -q 'another program wishes coupling steps of .*coupling.memory = ' short.txt || bad "nothing is told of coupling steps that another program has shortened" short.txt
# refused
timeout -k 5 60 "$b/sph" "$root/coupler/examples/spring.cfg" -o alone --force >alone.txt 2>&1 && bad "a body that a partner moves runs without one"
grep -q 'bodies.\[0\].motion: a partner is to move body .cylinder., but no other program' alone.txt || bad "alone: not told why" alone.txt
refused_by sph beside.cfg '/^fv/d; s/box = .*;/};/; s/motion = /free = true; mass = 80; inertia = 1; motion = /' 'a partner moves all of a body, forces move this one'
spring other 1 "$root/coupler/examples/spring.cfg" "cylnder 200 14745 0.02 173"
[ $code = 2 ] || bad "another name of the body: exit code $code" other.txt
grep -q 'field cylinder.motion: sph takes it, but nobody gives it' other.txt || bad "another name of the body: not told" other.txt
timeout -k 5 60 "$root/cases/run" "$root/coupler/examples/spring.cfg" -n 1 -o never --deadline 3 --with true >never.txt 2>&1
code=$?
{ [ $code -gt 0 ] && [ $code -lt 124 ] && grep -q 'has not called MPI_Init within 3 s' never.txt; } || bad "a program without MPI: exit code $code" never.txt
echo "moved_body: $failed faults"
[ $failed = 0 ]
