#!/bin/sh
# A region of particles alone in a wave of permanent form: its upright sides are open, the wave is around them (sph.box,
# sph.outer = "exact"). The wave goes through with its velocities, pressures and level; a restart goes on bit for bit, two
# ranks say the same; a wave that is not of permanent form, and gravity along x, are refused.
# SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
cat >wave.cfg <<'END'
format = 1;
time:    { end = 3.3; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (4, 1.5); };
initial: { field = "regular"; U = 0.3; L = 4.0; amplitude = 0.1; level = 1.0; };
walls:   ( { side = "y_min"; } );
probes:  ( { name = "a"; kind = "level"; at = (2, 1); } );
sph:     { dx = 0.05; scheme = "riemann_ale"; box = ((0.5, 0), (3.5, 1.5)); outer = "exact"; };
output:  { snapshots = false; series = 5; };
END
timeout -k 5 300 "$b/sph" wave.cfg -o whole --force >whole.log 2>&1 || bad "exit code $?" whole.log
# two periods, 80 particles a length: what waves of SPH err by there (cases/waves_crossing), the level within a tenth of dx
velocity=$(number whole velocity_l2) pressure=$(number whole pressure_l2)
below "$velocity" 0.1 || bad "velocity is off by $velocity of the wave's"
below "$pressure" 0.02 || bad "pressure is off by $pressure"
mean=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /^a \[/) c = i; next } $1 >= 1.65 { n++; sum += $c; if (n == 1 || $c > hi) hi = $c; if (n == 1 || $c < lo) lo = $c } END { print sum/n, hi - lo }' whole/series.csv)
near "${mean% *}" 1 0.02 || bad "mean level ${mean% *}, not 1 m"
close_to "${mean#* }" 0.2 0.1 || bad "a wave of 0.2 m is ${mean#* } m high in the box"
below "$(number whole level_gap)" 0.5 || bad "the level parts from that of the wave by $(number whole level_gap) dx"
for n in 1 2; do
    run="$b/sph"
    [ $n = 1 ] || run="$mpi -n 2 $b/sph"
    timeout -k 5 300 $run wave.cfg -o part$n -p time.end=0.4 -p output.checkpoint=0.2 --force >part$n.log 2>&1 || bad "on $n ranks: exit code $?" part$n.log
done
timeout -k 5 300 "$b/sph" wave.cfg -o again -p time.end=0.2 -p output.checkpoint=0.2 --force >again.log 2>&1 || bad "to the restart: exit code $?" again.log
timeout -k 5 300 "$b/sph" wave.cfg -o again -p time.end=0.4 -p output.checkpoint=0.2 --restart >again.log 2>&1 || bad "restart: exit code $?" again.log
[ "$(tail -n 1 part1/series.csv)" = "$(tail -n 1 again/series.csv)" ] || bad "after a restart the wave is another one"
close_to "$(last part1/series.csv 'kinetic energy')" "$(last part2/series.csv 'kinetic energy')" 1e-6 || bad "two ranks say another wave"
# refused CHANGE MESSAGE
refused() {
    sed "$1" wave.cfg >faulty.cfg
    "$b/sph" faulty.cfg --check >faulty.log 2>&1 && bad "accepted: $1"
    grep -q "$2" faulty.log || bad "$1: not told \"$2\"" faulty.log
}
refused 's/field = "regular"; U = 0.3;/field = "stokes"; U = 0.3;/' 'sph.outer: no exact solution is known around the particles at all times'
refused 's/(3.5, 1.5)/(3.5, 1.2)/' 'sph.box: must hold the free surface'
echo "wave_box: velocity off by $velocity, pressure $pressure, level ${mean% *} m, height ${mean#* } m; $failed faults"
[ $failed = 0 ]
