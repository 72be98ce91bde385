#!/bin/sh
# Waves that evolve nonlinearly, in both programs: a group focuses where and when it should, over a restart and on two
# ranks to the same bits; --check tells line, method and cost; what cannot be is refused. SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
# tank NAME WAVES SOLVER: 0.16 m deep, the group's peak 1 m long (kh 1)
tank() {
    cat >"$1.cfg" <<END
format = 1;
time:    { end = 4.0; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; max = (4.5, 0.24); };
shapes:  ( { form = "below"; level = 0.16; } );
walls:   ( { side = "x_min"; kind = "wave"; }, { side = "x_max"; kind = "beach"; }, { side = "y_min"; }, { side = "y_max"; } );
waves:   { $2 length = 1.0; zone = 1.2; start = 0; };
probes:  ( { name = "a"; kind = "level"; at = (2.0, 0.17); } );
$3
output:  { snapshots = false; series = 2; checkpoint = 1.5; };
END
}
fv='fv: { cells = (108, 24); };' group='kind = "focused"; height = 0.02; at = (2.0, 3.2); repeat = 8.0;'
tank full "$group evolve = \"full\";" "$fv"
tank hos "$group evolve = \"hos\";" "$fv"
tank grains "$group evolve = \"hos\";" 'sph: { dx = 0.02; scheme = "riemann_ale"; };'
sed -i 's/end = 4.0/end = 0.2/; s/checkpoint = 1.5/checkpoint = 0.1/' grains.cfg
"$b/fv" full.cfg --check 2>&1 | grep -q 'evolve nonlinearly over a periodic line of .* m, [0-9]* x 1 points, by the layer' || bad "--check of the line"
"$b/fv" hos.cfg --check 2>&1 | grep -q '5 orders in steepness' || bad "--check of the orders"
"$b/fv" hos.cfg --check 2>&1 | grep -q "take .* s a period to compute" || bad "--check of the cost"
"$b/fv" full.cfg -o full >full.log 2>&1 || bad "fv, full" full.log
"$b/fv" hos.cfg -o hos >hos.log 2>&1 || bad "fv, hos" hos.log
# focus DIR: time and height of the highest level
focus() { awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /^a /) c = i; next } $c > hi { hi = $c; t = $1 } END { print t, hi }' "$1/series.csv"; }
focus full >at.txt
read -r when high <at.txt
near "$when" 3.2 0.1 || bad "a group focuses at t = $when s, not at 3.2 s"
holds "$high > 0.169 && $high < 0.172" || bad "its crest of 0.01 m stands at $high m"
focus hos >at.txt
read -r other less <at.txt
near "$other" "$when" 0.03 && near "$less" "$high" 2e-5 || bad "orders in steepness give $other s, $less m instead of $when s, $high m"
for n in 1 2; do $mpi -n $n "$b/sph" grains.cfg -o grains$n >grains.log 2>&1 || bad "sph on $n ranks" grains.log; done
"$b/sph" grains.cfg -o part -p time.end=0.1 >part.log 2>&1 || bad "the first part" part.log
"$b/sph" grains.cfg -o part --restart >part.log 2>&1 || bad "the second part" part.log
[ "$(tail -n 1 grains1/series.csv)" = "$(tail -n 1 part/series.csv)" ] || bad "a restart gives other bits"
close_to "$(last grains2/series.csv "kinetic")" "$(last grains1/series.csv kinetic)" 1e-6 || bad "sph on two ranks"
# refused CHANGE MESSAGE
refused() { refused_by fv hos.cfg "$1" "$2"; }
refused 's/evolve = "hos";/& order = 1;/' 'waves.order: is not used: waves that evolve'
refused 's/kind = "focused"; \(.*\)at = (2.0, 3.2); repeat = 8.0;/\1/' 'waves.evolve: is not used: regular waves keep their form'
refused 's/height = 0.02/height = 0.12/; s/length = 1.0/length = 1.2/; s/0.16/0.4/; s/0.24/0.8/' 'waves.height: 0.12 m: .* orders in it .* reach 0.3'
printf 'no waves' >bad.swd
refused 's/kind = "focused".*zone/kind = "file"; file = "bad.swd"; zone/' 'waves.file: .*bad.swd: byte 8: the file ends before its header does'
refused 's/kind = "focused".*zone/kind = "file"; zone/' 'waves.kind: which file'
refused 's/repeat = 8.0;/& file = "bad.swd";/' 'waves.file: is not used: only waves of kind file'
echo "waves_evolve: focus at $when s, $high m; $failed faults"
[ $failed = 0 ]
