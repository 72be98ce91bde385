#!/bin/sh
# A region of particles alone in a wave of permanent form: its upright sides are open, the wave is around them (sph.box,
# sph.outer = "exact"). The wave goes through with its velocities, pressures and level; a restart goes on bit for bit, two
# ranks say the same; a wave that is not of permanent form, and a box below the surface, are refused. A coupled
# job has a fixed box in waves.
# SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
cat >wave.cfg <<'END'
format = 1;
time:    { end = 2.5; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (4, 1.5); };
initial: { field = "regular"; U = 0.3; L = 4.0; amplitude = 0.1; level = 1.0; };
walls:   ( { side = "y_min"; } );
probes:  ( { name = "a"; kind = "level"; at = (2, 1); } );
sph:     { dx = 0.0625; scheme = "riemann_ale"; box = ((0.5, 0), (3.5, 1.5)); outer = "exact"; };
output:  { snapshots = false; series = 5; };
END
timeout -k 5 300 "$b/sph" wave.cfg -o whole --force >whole.log 2>&1 || bad "exit code $?" whole.log
# a period and a half, 64 particles a length: what waves of SPH err by there (cases/waves_crossing), the level within a tenth of dx
velocity=$(number whole velocity_l2) pressure=$(number whole pressure_l2)
below "$velocity" 0.1 || bad "velocity is off by $velocity of the wave's"
below "$pressure" 0.02 || bad "pressure is off by $pressure"
mean=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /^a \[/) c = i; next } $1 >= 0.85 { n++; sum += $c; if (n == 1 || $c > hi) hi = $c; if (n == 1 || $c < lo) lo = $c } END { print sum/n, hi - lo }' whole/series.csv)
near "${mean% *}" 1 0.02 || bad "mean level ${mean% *}, not 1 m"
close_to "${mean#* }" 0.2 0.1 || bad "a wave of 0.2 m is ${mean#* } m high in the box"
# particles and what faces hold, less what has flown through: what the zones impose, as at inlets and outlets 1 % at most
budget=$(number whole budget)
below "${budget#-}" 0.01 || bad "the water of the box differs by $budget from what has flown through its faces"
for n in 1 2; do
    run="$b/sph"
    [ $n = 1 ] || run="$mpi -n 2 $b/sph"
    timeout -k 5 300 $run wave.cfg -o part$n -p time.end=0.24 -p output.checkpoint=0.12 --force >part$n.log 2>&1 || bad "on $n ranks: exit code $?" part$n.log
done
timeout -k 5 300 "$b/sph" wave.cfg -o again -p time.end=0.12 -p output.checkpoint=0.12 --force >again.log 2>&1 || bad "to the restart: exit code $?" again.log
timeout -k 5 300 "$b/sph" wave.cfg -o again -p time.end=0.24 -p output.checkpoint=0.12 --restart >again.log 2>&1 || bad "restart: exit code $?" again.log
[ "$(tail -n 1 part1/series.csv)" = "$(tail -n 1 again/series.csv)" ] || bad "after a restart the wave is another one"
close_to "$(last part1/series.csv 'kinetic energy')" "$(last part2/series.csv 'kinetic energy')" 1e-6 || bad "two ranks say another wave"
# through an open floor water goes into the wave below, it is not lost
sed '/^walls:/d; s/((0.5, 0)/((0.5, 0.3125)/' wave.cfg >deep.cfg
"$b/sph" deep.cfg --check >deep.log 2>&1 || bad "--check of an open floor" deep.log
! grep -q 'nothing catches' deep.log || bad "water that leaves through an open floor is called lost" deep.log
# refused CHANGE MESSAGE
refused() { refused_by sph wave.cfg "$1" "$2"; }
refused 's/field = "regular"; U = 0.3;/field = "stokes"; U = 0.3;/' 'sph.outer: no exact solution is known around the particles at all times'
refused 's/gravity/nu = 0.01; gravity/' 'fluid.nu: the wave around the particles knows no friction'
refused 's/(3.5, 1.5)/(3.5, 1.1875)/' 'sph.box: must hold the free surface'
# SPH round a fixed box in the waves of FV (cases/box_in_waves at half its resolution, 2 particles of draught): the force on
# the box is that of linear potential flow (1498 and 2561 N/m a metre of amplitude), its mean the weight of the water that the
# box displaces (the case's criterion), and no water gets lost.
cp "$root/cases/box_in_waves/weight.csv" .
sed 's/end = "9\*T"/end = "5*T"/; s/from = "6\*T"/from = "3*T"/; s/dx = 0.025/dx = 0.05/; s/cells = (200, 36)/cells = (100, 15)/; s/every = "T"/snapshots = false/; s/at = (3.84/at = (3.7/
s/box = ((4.2, 0), (5.8, 0.75))/box = ((3.75, 0), (6.25, 0.75))/' "$root/cases/box_in_waves/case.cfg" >box.cfg
timeout -k 5 300 "$root/cases/run" box.cfg -n 1:1:1 -o box --force >box.log 2>&1 || bad "a box in waves: exit code $?" box.log
# swing COLUMN: amplitude of 1.3 s over the last period
swing() { awk -F, -v p="$1" 'BEGIN { w = 2 * 3.14159265358979 / 1.3 } NR == 1 { for (i = 1; i <= NF; i++) if (index($i, p) == 1) c = i; next }
    $1 > 5.2 { if (t) { d[++n] = $1 - t; at[n] = $1; v[n] = $c; sum += d[n] * $c; all += d[n] } t = $1 }
    END { for (i = 1; i <= n; i++) { a += d[i] * (v[i] - sum / all) * cos(w * at[i]); b += d[i] * (v[i] - sum / all) * sin(w * at[i]) } print 2 / 1.3 * sqrt(a^2 + b^2) }' box/sph-series.csv; }
along=$(swing 'box force x') up=$(swing 'box force y')
close_to "$along" 37.45 0.2 || bad "the force of waves on a box is $along N/m, not 37.5 along x" box.log
close_to "$up" 64.0 0.2 || bad "the force of waves on a box is $up N/m, not 64 along y" box.log
below "$(number box water_missing)" 1e-3 || bad "a box in waves: water missing $(number box water_missing)"
echo "wave_box: velocity off by $velocity, budget $budget, pressure $pressure, level ${mean% *} m, height ${mean#* } m; forces $along, $up N/m; $failed faults"
[ $failed = 0 ]
