#!/bin/sh
# Outflows under a free surface that are given no level, in both programs: over a dry bed water falls out, as if the
# domain went on; where water stands outside it stands as high as inside at the start, whatever stands elsewhere. fv
# closes the air above by itself. The case that a run writes down is that case. SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
# scene NAME LENGTH END X_MAX SHAPES SOLVER
scene() {
    cat >"$1.cfg" <<END
format = 1;
time:    { end = $3; };
fluid:   { gravity = (0, -9.81); };
domain:  { max = ($2, 0.6); };
walls:   ( $4 { side = "x_min"; }, { side = "y_min"; } );
shapes:  ( $5 );
probes:  ( { name = "q"; kind = "discharge"; at = (0.9, 0); to = (0.9, 0.5); } );
$6
output:  { snapshots = false; series = 2; };
END
}
go() { # PROGRAM NAME [ARGS]
    program=$1 name=$2
    shift 2
    timeout -k 5 100 "$b/$program" "$name.cfg" -o "$name" --force "$@" >"$name.txt" 2>&1 || bad "$name ends with $?" "$name.txt"
    grep '^warning' "$name.txt" | grep -v 'passages\|hold\|restored elsewhere' | grep -q . && bad "$name warns" "$name.txt"
}
passed() { number "$1" forward; } # of the gauge
fv='fv: { cells = (50, 24); };' sph='sph: { dx = 0.02; };'
out='{ side = "x_max"; kind = "outflow"; },'
column='{ form = "box"; box = ((0, 0), (0.5, 0.4)); }'
# A dam over a dry bed: beyond the front's arrival the flow is faster than waves, which know nothing of the end.
scene dry_fv 1 0.7 "$out" "$column" "$fv"
scene dry_sph 1 0.7 "$out" "$column" "$sph"
scene long_fv 4 0.7 '{ side = "x_max"; },' "$column" 'fv: { cells = (200, 24); };'
for p in fv sph; do
    go $p dry_$p
    grep -q 'x_max: nothing stands there at the start' dry_$p.txt || bad "$p: the end is not told" dry_$p.txt
done
go fv long_fv
for p in fv sph; do # 5 %: half a row of particles in a tongue of ten
    close_to "$(passed dry_$p)" "$(passed long_fv)" 0.05 || bad "$p: $(passed dry_$p) m^2 passed before the end, $(passed long_fv) without it"
done
close_to "$(last dry_fv/series.csv 'volume [')" "$(awk -v m="$(last dry_sph/series.csv mass)" 'BEGIN { print m / 1000 }')" 0.05 ||
    bad "left in the domain: $(last dry_fv/series.csv 'volume [') m^2 in fv, $(last dry_sph/series.csv mass) kg in sph"
# The same with blocks whose sides have kinds of their own (walls is empty): over a dry bed, and over a pool.
two='blocks: ( { name = "a"; max = (0.6, 0.6); cells = (30, 24); i_min = "slip"; i_max = "joined"; j_min = "slip"; j_max = "slip"; },
           { name = "b"; min = (0.6, 0); max = (1, 0.6); cells = (20, 24); i_min = "joined"; i_max = "outflow"; j_min = "slip"; j_max = "slip"; } );'
for name in dry_blocks pool_blocks; do
    shapes=$column
    [ $name = dry_blocks ] || shapes='{ form = "box"; box = ((0, 0), (0.3, 0.4)); }, { form = "box"; box = ((0.3, 0), (1, 0.15)); }'
    scene $name 1 0.7 '' "$shapes" "$two fv: { };"
    sed '/^walls/d' $name.cfg >$name.new && mv $name.new $name.cfg
    "$b/fv" $name.cfg --check -p 'fv.integrator="newton"' >newton.txt 2>&1 && bad "$name: newton takes another level than it says" newton.txt
    grep -q 'blocks.\[1\].i_max.*newton' newton.txt || bad "$name, newton: the side is not named" newton.txt
done
go fv dry_blocks
grep -q 'x_max: nothing stands there at the start' dry_blocks.txt || bad 'blocks: the end is not told' dry_blocks.txt
close_to "$(passed dry_blocks)" "$(passed long_fv)" 0.05 || bad "blocks: $(passed dry_blocks) m^2 passed before the end, $(passed long_fv) without it"
"$b/fv" pool_blocks.cfg --check 2>&1 | grep -q 'x_max: water 0.15 m high outside' || bad 'blocks: the level outside is not told'
near "$(number dry_sph budget)" 0 1e-9 || bad "sph: the water that fell out is not all told: $(number dry_sph budget)"
[ "$(number dry_sph particles_lost)" = 0 ] || bad 'sph: what falls out counts as lost'
# with levels, whose guards leave beside what they stand for
timeout -k 5 100 "$b/sph" dry_sph.cfg -o levels --force -p 'apr.regions=( { min = (0.6, -1); max = (2, 0.3); } )' -p sph.dx=0.04 >levels.txt 2>&1 ||
    bad 'refined to the end' levels.txt
near "$(number levels budget)" 0 0.02 || bad "levels: the water that fell out is told $(number levels budget) wrong"
# restart bit for bit, with what has fallen
for end in 0.5 0.7; do go sph dry_sph -p time.end=$end -p output.checkpoint=0.5 -o parts $([ $end = 0.5 ] || echo --restart); done
[ "$(last parts/series.csv 'through x_max')" = "$(last dry_sph/series.csv 'through x_max')" ] ||
    bad "through x_max after a restart: $(last parts/series.csv 'through x_max') for $(last dry_sph/series.csv 'through x_max') kg"
# A dam over a pool: outside stands the pool, not the dam. Nothing comes in, and in the end the pool's level is left.
pool='{ form = "box"; box = ((0, 0), (0.3, 0.4)); }, { form = "box"; box = ((0.3, 0), (1, 0.15)); }'
scene pool_fv 1 3 "$out" "$pool" 'fv: { cells = (75, 36); };'
scene pool_sph 1 3 "$out" "$pool" "$sph"
for p in fv sph; do
    go $p pool_$p
    grep -q 'x_max: water 0.15 m high outside, as inside' pool_$p.txt || bad "$p: the level outside is not told" pool_$p.txt
done
volume=$(last pool_fv/series.csv 'volume [')
close_to "$volume" 0.15 0.1 || bad "fv: a pool of 0.15 m^2 after the dam: $volume"
close_to "$(last pool_sph/series.csv mass)" 150 0.1 || bad "sph: a pool of 150 kg after the dam: $(last pool_sph/series.csv mass)"
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /^volume \[/) c = i; next } NR == 2 { v = $c } $c > 1.005 * v { exit 1 }' pool_fv/series.csv ||
    bad 'fv: water comes in through the outflow'
# newton knows one level alone
"$b/fv" pool_fv.cfg --check -p 'fv.integrator="newton"' >newton.txt 2>&1 && bad 'newton takes another level than it says' newton.txt
grep -q 'walls.\[0\].*newton' newton.txt || bad 'newton: the wall is not named' newton.txt
# The air above is closed, and said to be
grep -q 'y_max, which has no wall, is closed by one that slips' pool_fv.txt || bad 'the lid is not told' pool_fv.txt
# and when water comes there, that is told
sed 's/max = (1, 0.6)/max = (1, 0.45)/; s/cells = (50, 24)/cells = (50, 18)/; s/kind = "outflow"; //' dry_fv.cfg >low.cfg
timeout -k 5 100 "$b/fv" low.cfg -o low --force -p probes='()' >low.txt 2>&1
grep -q '^warning: .*water reaches the side y_max, which the case leaves open' low.txt || bad 'water at the lid is not told' low.txt
# What a run writes down of its case is that case
for name in pool_fv dry_sph; do
    p=${name#*_}
    "$b/$p" "$name/$p-case.cfg" -o again --force -p time.end=0.01 >again.txt 2>&1 || bad "$name: its own case does not run" again.txt
    sed '/time:/,/};/d' "$name/$p-case.cfg" >one.txt
    sed '/time:/,/};/d' "again/$p-case.cfg" >two.txt
    cmp -s one.txt two.txt || bad "$name: its own case becomes another" two.txt
done
[ "$failed" = 0 ]
