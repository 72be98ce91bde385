#!/bin/sh
# A piston that absorbs (motion of kind waves, absorb = true) before a wall that returns all: the waves that run from it are
# those that were asked for, where (LONG=1) those of a piston that does not absorb have become others; it stays in its place; a run
# goes on after a restart bit for bit, and two ranks say the same; --check tells what comes back; what cannot be is refused.
# SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
# tank NAME END HOW: 4.2 m long, 0.4 m deep, waves of 0.04 m and 1.4 s (2.4 m); 8 particles over the depth;
# judged over two periods from 8.3 s on, when waves have gone to the wall and back
tank() {
    cat >"$1.cfg" <<END
format = 1;
time:    { end = $2; };
fluid:   { gravity = (0, -9.81); };
domain:  { min = (-0.6, 0); max = (4.2, 0.64); };
waves:   { height = 0.04; period = 1.4; };
walls:   ( { side = "y_min"; }, { side = "x_max"; } );
shapes:  ( { form = "box"; box = ((0, 0), (4.2, 0.4)); } );
bodies:  ( { name = "paddle"; points = ((-0.4, 0), (-0.4, 0.6), (0, 0.6), (0, 0)); motion = ( { kind = "waves"; axis = "x"; $3 } ); } );
probes:  ( { name = "a"; kind = "level"; at = (1.6, 0.4); }, { name = "b"; kind = "level"; at = (1.84, 0.4); }, { name = "c"; kind = "level"; at = (2.25, 0.4); } );
gauges:  ( { name = "tank"; probes = "a b c"; from = 8.3; } );
sph:     { dx = 0.05; scheme = "riemann_ale"; };
output:  { snapshots = false; series = 3; };
END
}
tank active 11.2 'absorb = true;'
tank passive 11.2 ''
# column NAME TITLE FROM: its mean from then on
column() { awk -F, -v p="$2" -v from="$3" 'NR == 1 { for (i = 1; i <= NF; i++) if (index($i, p) == 1) c = i; next } $1 >= from { n++; sum += $c } END { if (n) print sum/n }' "$1/series.csv"; }
# onward NAME: amplitude of what runs away from the paddle, whichever of both is the larger
onward() {
    if grep -q 'm onward' "$1.log"; then number "$1" incident; else number "$1" reflected; fi
}
"$b/sph" active.cfg --check 2>&1 | grep -q 'paddle absorbs by a gauge 0.1 m before its face: of waves of 0.7, 1, 1.4 and 2 times' || bad "--check of a piston that absorbs"
for name in active ${LONG:+passive}; do timeout -k 5 300 "$b/sph" $name.cfg -o $name --force >$name.log 2>&1 || bad "$name: exit code $?" $name.log; done
active=$(onward active)
close_to "$active" 0.02 0.1 || bad "from a piston that absorbs run waves of an amplitude of $active m, not of 0.02 m" active.log
if [ -n "$LONG" ]; then
    passive=$(onward passive)
    close_to "$passive" 0.02 0.3 && bad "from a piston that does not absorb run waves of $passive m, too"
fi
place=$(column active 'paddle x' 9.8)
near "$place" 0 0.005 || bad "a piston of 0.05 m of stroke has drifted by $place m"
# At 1.55 s the run is written, and goes on from there; coarser.
short='-p sph.dx=0.06 -p time.end=3.1 -p gauges.[0].from=0 -p output.snapshots=true -p output.every=1.55'
timeout -k 5 120 "$b/sph" active.cfg -o whole $short --force >whole.log 2>&1 || bad "whole: exit code $?" whole.log
for n in 1 2; do
    run="$b/sph"
    [ $n = 1 ] || run="$mpi -n 2 $b/sph"
    # the same steps as in the whole run: an output ends one at 1.55 s
    timeout -k 5 120 $run active.cfg -o part$n $short -p time.end=1.55 -p output.checkpoint=1.55 --force >part$n.log 2>&1 || bad "part $n: exit code $?" part$n.log
    timeout -k 5 120 $run active.cfg -o part$n $short --restart >>part$n.log 2>&1 || bad "restart on $n: exit code $?" part$n.log
done
[ "$(tail -n 1 whole/series.csv)" = "$(tail -n 1 part1/series.csv)" ] || bad "the run is another one after a restart"
close_to "$(last whole/series.csv 'paddle x')" "$(last part2/series.csv 'paddle x')" 1e-3 || bad "on two ranks the piston goes elsewhere"
# refused CHANGE MESSAGE
refused() { refused_by sph active.cfg "$1" "$2"; }
refused 's/kind = "waves"; axis = "x";/kind = "harmonic"; axis = "x"; amplitude = 0.01; period = 1;/; /^waves/d; /^gauges/d' 'bodies.\[0\].motion.\[0\].absorb: is not used: only what makes waves'
refused 's/^sph:.*/sph: { dx = 0.2; };/' 'the gauge of a paddle that absorbs stands 0.4 m'
refused 's/^output:/apr: { levels = 1; local_steps = true; regions = ( { min = (2, 0); max = (3, 0.64); } ); };\n&/' 'apr.local_steps: a paddle that absorbs needs one step'
# A tank with one paddle, at the end to which the waves run, has none: refused, with what to turn; turned round, the mirrored
# tank is the same one. With a paddle at either end each has its gauge in the water.
sed 's/min = (-0.6, 0); max = (4.2, 0.64)/min = (-4.2, 0); max = (0.6, 0.64)/; s/"x_max"/"x_min"/; s/box = ((0, 0), (4.2, 0.4))/box = ((-4.2, 0), (0, 0.4))/
    s/points = .*0, 0))/points = ((0.4, 0), (0, 0), (0, 0.6), (0.4, 0.6))/; s/at = (/at = (-/g; s/from = 8.3/from = 0/' active.cfg >mirrored.cfg
"$b/sph" mirrored.cfg --check >faulty.log 2>&1 && bad 'waves that run towards the only paddle are accepted'
grep -q 'waves.direction: 0 degrees: the waves run out through paddle' faulty.log || bad 'waves that run towards the only paddle are not told' faulty.log
sed 's/max = (4.2, 0.64)/max = (4.8, 0.64)/; s/, { side = "x_max"; }//; s/^bodies: *( *\(.*\) );$/bodies: ( \1, { name = "far"; points = ((4.2, 0), (4.2, 0.6), (4.6, 0.6), (4.6, 0)); motion = ( { kind = "waves"; axis = "x"; absorb = true; } ); } );/' active.cfg >both.cfg
"$b/sph" both.cfg --check >both.log 2>&1 && grep -q 'far absorbs by a gauge 0.1 m' both.log || bad 'paddles at both ends' both.log
sed -i 's/period = 1.4/period = 1.4; direction = 180/' mirrored.cfg
timeout -k 5 120 "$b/sph" mirrored.cfg -o mirrored $short --force >mirrored.log 2>&1 || bad "mirrored: exit code $?" mirrored.log
near "$(awk -v a="$(last whole/series.csv 'paddle x')" -v m="$(last mirrored/series.csv 'paddle x')" 'BEGIN { print a + m }')" 0 1e-6 ||
    bad "mirrored, the paddle is at $(last mirrored/series.csv 'paddle x') m, not at the mirror image of $(last whole/series.csv 'paddle x')"
# what a message asks for is enough: 2 sph.dx before the face, as a number of three digits
sed 's/^sph:.*/sph: { dx = 0.3; };/' active.cfg >faulty.cfg
"$b/sph" faulty.cfg --check >faulty.log 2>&1
enough=$(sed -n 's/.*of a paddle that absorbs stands.* sph.dx = \([0-9.]*\) m or less.*/\1/p' faulty.log)
[ -n "$enough" ] || bad 'no sph.dx is named' faulty.log
sed "s/^sph:.*/sph: { dx = $enough; };/" active.cfg >faulty.cfg
"$b/sph" faulty.cfg --check 2>&1 | grep -q 'of a paddle that absorbs stands' && bad "sph.dx = $enough m is asked for, and refused"
echo "paddles: waves of $active m (wanted 0.02)${passive:+, without absorption $passive m}, in its place within $place m; $failed faults"
[ $failed = 0 ]
