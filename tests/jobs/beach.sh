#!/bin/sh
# Beaches (walls.beach) in both programs: standing waves in a long tank run into one and do not come back; without it they stand
# and nothing grows. Momentum balances with what a beach takes. SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
# tank NAME END LENGTH BEACH SOLVER: waves of 1 m over 0.25 m of water, period 0.836 s, 0.01 m
tank() {
    cat >"$1.cfg" <<EOF
format = 1;
time:    { end = $2; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; max = ($3, 0.4); };
initial: { field = "standing_wave"; U = 0.1; L = 1.0; amplitude = 0.01; level = 0.25; };
walls:   ( { side = "x_min"; }, { side = "x_max"; $4 }, { side = "y_min"; }, { side = "y_max"; } );
probes:  ( { name = "wall"; kind = "level"; at = (0.02, 0.2); } );
$5
output:  { snapshots = false; };
EOF
}
# swing NAME FROM TO: half of the difference of the largest and the least level, m
swing() { awk -F, -v from="$2" -v to="$3" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /^wall /) c = i; next }
    $1 >= from && $1 <= to { if (!n++ || $c > hi) hi = $c; if (n == 1 || $c < lo) lo = $c } END { if (n) print (hi - lo) / 2 }' "$1/series.csv"; }
cells='fv: { cells = (128, 16); };'
tank beach 16 4 'beach = 1.5; beach_period = 0.836;' "$cells"
tank wall 16 4 '' "$cells"
tank slow 10 2.5 'beach = 1.5; beach_period = 0.836;' 'fv: { cells = (80, 16); integrator = "bdf2"; };'
tank grains 7 2.5 'beach = 1.5; beach_period = 0.836;' 'sph: { dx = 0.02; scheme = "riemann_ale"; };'
sed -i "s/gravity/nu = 1e-6; gravity/" slow.cfg
"$b/fv" beach.cfg --check 2>&1 | grep -q 'x_max: beach over 1.5 m, 1.5 lengths of waves of 0.836 s (1 m): 0.068 % of their height comes back' || bad "--check of a beach"
for name in beach wall slow; do "$b/fv" $name.cfg -o $name >$name.log 2>&1 || bad "fv $name" $name.log; done
"$b/sph" grains.cfg -o grains >grains.log 2>&1 || bad "sph, a beach" grains.log
first=$(swing beach 0 2) late=$(swing beach 10 16) alone=$(swing wall 12 16) slow=$(swing slow 8 10) grains=$(swing grains 5 7)
holds "$first > 0.008 && $late < 0.03 * $first" || bad "fv: waves of $first m leave $late m before a beach"
holds "$alone > 0.85 * $first && $alone < 1.05 * $first" || bad "fv: waves of $first m between walls swing by $alone m later"
holds "$slow > 0 && $slow < 0.05 * $first" || bad "fv, bdf2: waves of $first m leave $slow m before a beach"
holds "$grains > 0 && $grains < 0.1 * $first" || bad "sph: waves of $first m leave $grains m before a beach"
below "$(number grains defect)" 1e-10 || bad "sph: momentum off by $(number grains defect)"
# refused SCENE_CHANGE MESSAGE PROGRAM
refused() {
    sed "$1" grains.cfg >faulty.cfg
    [ "$3" = sph ] || sed -i 's/^sph:.*/fv: { cells = (80, 16); };/' faulty.cfg
    "$b/$3" faulty.cfg --check >faulty.log 2>&1 && bad "accepted: $1"
    grep -q "$2" faulty.log || bad "$3: $1: not told \"$2\"" faulty.log
}
refused 's/beach_period = 0.836;//' 'walls.\[1\].beach: a beach needs its length and the period' sph
refused 's/beach = 1.5/beach = 3/' 'walls.\[1\].beach: 3 m: the domain is 2.5 m long there' fv
refused 's/"y_min"; }/"y_min"; beach = 0.1; beach_period = 1; }/' 'a zone is before an upright side' sph
refused 's/beach = 1.5/kind = "outflow"; beach = 1.5/' 'an opening lets waves out by itself' fv
echo "beach: $first m; later fv $late, bdf2 $slow, sph $grains, without $alone m; $failed faults"
[ $failed = 0 ]
