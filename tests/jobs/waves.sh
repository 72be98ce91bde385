#!/bin/sh
# Sides of kind wave and beach in both programs: waves have the height that was asked for, the
# level stays, --check tells them, waves and zones that cannot be are refused. SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
# tank NAME END WAVES SOLVER: 1 m long, 0.16 m deep (kh 1) unless told
tank() {
    cat >"$1.cfg" <<EOF
format = 1;
time:    { end = $2; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; max = (4.5, 0.24); };
shapes:  ( { form = "below"; level = 0.16; } );
walls:   ( { side = "x_min"; kind = "wave"; }, { side = "x_max"; kind = "beach"; }, { side = "y_min"; }, { side = "y_max"; } );
waves:   { $3 };
probes:  ( { name = "a"; kind = "level"; at = (1.9, 0.17); }, { name = "b"; kind = "level"; at = (2.15, 0.17); } );
gauges:  ( { name = "tank"; probes = "a b"; } );
$4
output:  { snapshots = false; series = 2; };
EOF
}
# swing NAME PROBE FROM TO: difference of the largest and the least level, m
swing() { awk -F, -v p="$2 " -v from="$3" -v to="$4" 'NR == 1 { for (i = 1; i <= NF; i++) if (index($i, p) == 1) c = i; next }
    $1 >= from && $1 <= to { if (!n++ || $c > hi) hi = $c; if (n == 1 || $c < lo) lo = $c } END { if (n) print hi - lo }' "$1/series.csv"; }
regular='height = 0.03; length = 1.0;'
tank regular 10 "$regular" 'fv: { cells = (144, 24); };'
tank group 12 'kind = "focused"; height = 0.03; length = 1.0; at = (2.15, 9.0); zone = 1.2; start = 0;' 'fv: { cells = (144, 24); };'
tank grains 6 "$regular" 'sph: { dx = 0.02; scheme = "riemann_ale"; };'
"$b/fv" regular.cfg --check 2>&1 | grep -q 'regular waves: height 0.03 m, 1 m long, period 0.911[0-9]* s, celerity 1.09[0-9]* m/s over 0.16 m' || bad "--check of waves"
"$b/fv" regular.cfg --check 2>&1 | grep -q 'x_max: beach over 1 m, 1 lengths of waves of 0.911' || bad "--check of a beach by the waves"
"$b/fv" regular.cfg --check=picture -o drawn >drawn.log 2>&1 && grep -q '>wave zone<' drawn/fv-scene.svg && grep -q '>beach<' drawn/fv-scene.svg || bad "zones of waves in the picture"
"$b/fv" regular.cfg --check=waves -o drawn >drawn.log 2>&1 && grep -q 'Regular waves: height 0.03 m, 1 m long' drawn/fv-waves.svg || bad "the picture of waves alone" drawn.log
"$b/fv" group.cfg --check=waves -o drawn >drawn.log 2>&1 && grep -q 'amplitudes of the components' drawn/fv-waves.svg && grep -q 'second order: pairs' drawn.log || bad "the picture of a group" drawn.log
sed '/^waves:/d; s/kind = "wave"/kind = "slip"/; s/kind = "beach"/kind = "slip"/; /^gauges/d' regular.cfg >calm.cfg
"$b/fv" calm.cfg --check=waves -o drawn >drawn.log 2>&1
[ $? = 2 ] && grep -q 'no group waves' drawn.log || bad "--check=waves of a case without" drawn.log
for name in regular group; do "$b/fv" $name.cfg -o $name >$name.log 2>&1 || bad "fv $name" $name.log; done
"$b/sph" grains.cfg -o grains >grains.log 2>&1 || bad "sph, waves" grains.log
# a run that is stopped in its waves goes on bit for bit
for end in 1 1.5; do
    "$b/fv" regular.cfg -o parts -p time.end=$end -p output.checkpoint=1 -p 'gauges=()' $([ $end = 1 ] && echo --force || echo --restart) >parts.log 2>&1 ||
        bad "fv, waves to $end s" parts.log
done
"$b/fv" regular.cfg -o unbroken -p time.end=1.5 -p output.checkpoint=1 -p 'gauges=()' >unbroken.log 2>&1 || bad "fv, waves to 1.5 s" unbroken.log
[ "$(tail -n 1 parts/series.csv)" = "$(tail -n 1 unbroken/series.csv)" ] || bad "a restart gives other waves"
height=$(swing regular a 7 10) other=$(swing regular b 7 10) grains=$(swing grains a 4 6)
holds "$height > 0.0285 && $height < 0.0315 && $other > 0.0285 && $other < 0.0315" || bad "fv: waves of 0.03 m are $height and $other m high"
holds "$grains > 0.025 && $grains < 0.033" || bad "sph: waves of 0.03 m are $grains m high"
back=$(number regular R) half=$(number regular incident) wave=$(sed -n '/"a": {/,/}/s/.*"mean": \([0-9.e-]*\),*/\1/p' regular/summary.json)
below "$back" 0.04 || bad "fv: $back of the waves come back"
holds "$half > 0.0142 && $half < 0.0158" || bad "fv: incident waves of $half m, not 0.015 m"
close_to "$wave" 0.03 0.05 || bad "fv: waves from crossing to crossing are $wave m high"
[ "$(wc -l <regular/spectrum_tank.csv)" -gt 10 ] || bad "no spectrum"
first=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /^b /) c = i; next } $c > hi { hi = $c; t = $1 } END { print t }' group/series.csv)
holds "$first > 8.85 && $first < 9.15" || bad "fv: a group focuses at t = $first s, not at 9 s"
below "$(number regular volume_gained)" 5e-3 || bad "fv: water gained $(number regular volume_gained)"
# Pistons and flaps over 0.4 m make the waves, too; 8 particles over the depth.
for paddle in piston flap; do
    motion='axis = "x";' points='(-0.4, 0), (-0.4, 0.6), (0, 0.6), (0, 0)'
    [ $paddle = piston ] || { motion='axis = "rz";' points='(-0.15, 0.15), (-0.15, 0.6), (0, 0.6), (0, 0)'; }
    cat >$paddle.cfg <<EOF
format = 1;
time:    { end = 8.4; };
fluid:   { gravity = (0, -9.81); };
domain:  { min = (-0.6, 0); max = (5.4, 0.64); };
waves:   { height = 0.06; period = 1.4; };
walls:   ( { side = "y_min"; }, { side = "x_max"; kind = "beach"; } );
shapes:  ( { form = "box"; box = ((0, 0), (5.4, 0.4)); } );
bodies:  ( { name = "paddle"; points = ($points); motion = ( { kind = "waves"; $motion } ); } );
probes:  ( { name = "a"; kind = "level"; at = (2.0, 0.4); }, { name = "b"; kind = "level"; at = (2.24, 0.4); }, { name = "c"; kind = "level"; at = (2.65, 0.4); } );
gauges:  ( { name = "tank"; probes = "a b c"; from = 5.5; } );
sph:     { dx = 0.05; scheme = "riemann_ale"; };
output:  { snapshots = false; series = 3; };
EOF
    "$b/sph" $paddle.cfg --check 2>&1 | grep -q "paddle makes them as a $paddle: height over stroke" || bad "--check of a $paddle"
    [ $paddle = piston ] || continue # water still leaks below flaps that stand on the floor
    "$b/sph" $paddle.cfg -o $paddle >$paddle.log 2>&1 || bad "sph $paddle" $paddle.log
    made=$(number $paddle incident)
    close_to "$made" 0.03 0.1 || bad "sph: a $paddle makes waves of an amplitude of $made m, not 0.03 m"
    echo "waves: $paddle $made m"
done
# told, and run: gauges in a zone, gauges half a length apart, which tell nothing of what comes back, cells that are too few
sed 's/at = (1.9,/at = (0.9,/' regular.cfg >told.cfg
"$b/fv" told.cfg --check 2>&1 | grep -q 'gauges tank: a stands in the zone of 1 m before x_min' || bad "a gauge in a zone"
# solid NAME PROGRAM GROUP WORDS: what stands in a zone is told; none: what does not
solid() {
    sed "s/^fv:/$3; &/; s/^sph:/$3; &/" "$1.cfg" >told.cfg
    "$b/$2" told.cfg --check >told.log 2>&1 || bad "$2: $3" told.log
    [ "$4" = none ] && ! grep -q 'stands in' told.log || grep -q "$4" told.log || bad "$2: $3: not told \"$4\"" told.log
}
box='blocked: ( { name = "step"; min = (0, 0); max = (0.5, 0.06); } )' body='bodies: ( { name = "b"; box = ((3.8, 0.1), (4.1, 0.2)); } )'
solid regular fv "$box" 'box "step" stands in the zone of 1 m before x_min, .*: the tank gets others'
solid regular fv "$(echo "$box" | sed 's/(0, 0)/(1.5, 0)/; s/(0.5,/(2,/')" none
solid grains sph "$body" 'body b stands in the zone of 1 m before x_max, .*: more of them come back'
solid grains sph "$(echo "$body" | sed 's/3.8/2.2/; s/4.1/2.5/')" none
sed 's/at = (2.15,/at = (2.4,/; s/cells = (144, 24)/cells = (45, 12)/; s/end = 10/end = 4/' regular.cfg >told.cfg
"$b/fv" told.cfg -o told >told.log 2>&1
grep -q 'gauges tank: from where they stand' told.log && [ "$(sed -n 's/.*"R": \([a-z0-9.]*\).*/\1/p' told/summary.json)" = null ] || bad "gauges half a length apart" told.log
sed 's/cells = (144, 24)/cells = (45, 12)/' regular.cfg >told.cfg
"$b/fv" told.cfg --check 2>&1 | grep -q 'waves: 10 cells a length, 1.5 a height: below 12 and 1.5' || bad "cells that are too few for waves"
sed 's/dim = 2; max = (4.5, 0.24)/dim = 3; max = (4.5, 0.24, 1)/; s/gravity = (0, -9.81)/gravity = (0, -9.81, 0)/; s/length = 1.0/direction = 20; &/; s/0.17)/0.17, 0.5)/g
    s/cells = (144, 24)/cells = (45, 16, 10)/; s/{ side = "y_min"; }/&, { side = "z_min"; }, { side = "z_max"; }/' regular.cfg >told.cfg
"$b/fv" told.cfg --check >told.log 2>&1 && grep -q 'waves: they run against z_max, which throws them back' told.log || bad "oblique waves beside a closed side" told.log
# refused CHANGE MESSAGE PROGRAM
cp grains.cfg sph.cfg
sed 's/^sph:.*/fv: { cells = (80, 16); };/' grains.cfg >fv.cfg
refused() { refused_by "$3" "$3.cfg" "$1" "$2"; }
refused 's/probes = "a b"/probes = "a c"/' 'gauges.\[0\].probes: c is no level gauge' fv
refused 's/probes = "a b"/probes = "a"/' 'gauges.\[0\].probes: two gauges or more' sph
refused 's/probes = "a b"; /&from = 7; /' 'gauges.\[0\].from: 7 s: less than two periods' sph
refused 's/height = 0.03/height = 0.2/' 'waves.height: 0.2 m: at a length of 1 m over 0.16 m of water the highest wave has 0.101 m' sph
refused 's/length = 1.0;//' 'waves.length: give one of length (m) and period (s)' fv
refused 's/^waves:.*//' 'walls.\[0\].kind: what waves? give the group waves' fv
refused 's/kind = "wave"/kind = "slip"/' 'waves: nobody makes them' sph
refused 's/length = 1.0/depth = 0.5; &/' 'waves.depth: 0.5 m: the water is 0.16 m deep down to the floor' fv
refused 's/length = 1.0/direction = 90; &/' 'waves.direction: 90 degrees: in 2D waves run along the horizontal axis' sph
refused 's/length = 1.0/direction = 180; &/' 'waves.direction: 180 degrees: the waves run out through x_min' fv
refused 's/4.5, 0.24/4.5, 0.17/' 'domain.max: 0.17 m: crests reach 0.1769 m' fv
refused 's/dim = 2; max = (4.5, 0.24)/dim = 3; max = (4.5, 0.24, 1); periodic = (false, false, true)/; s/gravity = (0, -9.81)/gravity = (0, -9.81, 0)/; s/length = 1.0/direction = 20; &/
    s/0\.17)/0.17, 0.5)/g; s/cells = (80, 16)/cells = (80, 16, 20)/' 'domain.max: the period of 1 m along z holds 0.342 waves of that direction, and must hold a whole number: 2.9238 m' fv
refused 's/length = 1.0/length = 2.5/' 'along x the zones before the sides leave no room between them' fv
refused 's/"y_min";/"y_min"; kind = "wave";/' 'walls.\[2\].kind: a zone is before an upright side' sph
refused 's/kind = "wave";/kind = "wave"; beach = 0.5;/' 'walls.\[0\].beach: ' sph
refused 's/cells = (80, 16);/cells = (80, 16); integrator = "newton";/' 'newton has no beaches and makes no waves' fv
refused 's/cells = (80, 16);/integrator = "newton"; }; blocks: ( { cells = (80, 16); max = (4.5, 0.24); } ); output: {/; /^output/d' 'newton has no beaches and makes no waves' fv
refused 's/^shapes:.*//; s/^waves:/initial: { level = 0.16; };\n&/' 'walls.\[0\].kind: no water has a free surface' fv
echo "waves: 0.03 m are $height, $other m (fv), $grains m (sph), focus at $first s; $failed faults"
[ $failed = 0 ]
