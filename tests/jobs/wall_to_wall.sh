#!/bin/sh
# Coupled jobs whose box reaches from wall to wall: the part of fv's flow that it cuts off has no outlet, takes the level of
# its pressure from sph, and gives what flows in. SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
cat >channel.cfg <<'CASE'
format = 1;
time:    { end = 6.0; };
fluid:   { rho = 1.0; nu = 1.0e-2; };
domain:  { dim = 2; min = (0, 0); max = (3.0, 0.4); };
initial: { field = "uniform"; U = 0.3; velocity = (0.2, 0.0); };
walls:   ( { side = "x_min"; kind = "inflow"; velocity = (0.3, 0); profile = "parabolic"; }, { side = "x_max"; kind = "outflow"; },
           { side = "y_min"; kind = "no_slip"; }, { side = "y_max"; kind = "no_slip"; } );
probes:  ( { name = "in"; at = (0.4, 0.2); }, { name = "a"; at = (1.3, 0.2); }, { name = "b"; at = (1.6, 0.2); }, { name = "out"; at = (2.5, 0.2); },
           { name = "v"; kind = "velocity"; at = (1.45, 0.2); }, { name = "w"; kind = "velocity"; at = (2.5, 0.2); } );
sph:     { dx = 0.02; box = ((0.8, 0), (2.1, 0.4)); };
fv:      { cells = (96, 12); };
output:  { snapshots = false; series = 10; };
CASE
job() { # DIR RANKS CASE ARGS...
    d=$1 r=$2 case=$3
    shift 3
    "$root/cases/run" "$case" -n "$r" -o "$d" --force "$@" >"$d.txt" 2>&1 || bad "$d ended with $?: $(tail -n 3 "$d.txt")"
}
# Poiseuille's flow: 8 nu rho u/H^2 = 0.15 Pa/m in sph, over fv's parts and sph between them, and the same discharge in both
for ranks in 1:1:1 1:2:1; do
    d=channel${ranks%:*}
    job "$d" $ranks channel.cfg
    a=$(last "$d/sph-series.csv" "a ") b_=$(last "$d/sph-series.csv" "b ") v=$(last "$d/sph-series.csv" "v u")
    in=$(last "$d/fv-series.csv" "in ") out=$(last "$d/fv-series.csv" "out ") w=$(last "$d/fv-series.csv" "w u")
    holds "(($a - $b_) / 0.045 - 1)^2 < 0.03^2" || bad "$d: sph loses $a - $b_ Pa over 0.3 m instead of 0.045"
    holds "(($in - $out) / 0.315 - 1)^2 < 0.1^2" || bad "$d: $in - $out Pa from inlet to outlet instead of 0.315"
    holds "($v / 0.3 - 1)^2 < 0.02^2 && ($w / 0.3 - 1)^2 < 0.02^2" || bad "$d: $v and $w m/s on the axis instead of 0.3"
    # each gauge stands in the series of the program in whose part it lies
    [ -z "$(last "$d/fv-series.csv" "a ")$(last "$d/fv-series.csv" "v u")$(last "$d/sph-series.csv" "in ")" ] || bad "$d: a gauge is read by both programs"
done
# what has no balance of its own is refused
refused() { # NAME WORDS CASE: a fault that says why
    "$root/cases/run" "$3" -n 1:1:1 -o "$1" --force >"$1.txt" 2>&1
    { [ $? = 2 ] && grep -q "$2" "$1.txt"; } || bad "$1 is not refused with: $2" "$1.txt"
}
sed 's/^sph: .*/sph_a: { dx = 0.0125; box = ((0.5, 0), (1.2, 0.4)); }; sph_b: { dx = 0.0125; box = ((1.8, 0), (2.5, 0.4)); };/; /^probes/,/^  .*);$/d' channel.cfg >two.cfg
refused two "what lies between several boxes" two.cfg
sed 's/^fv: .*/fv: {}; blocks: ( { cells = (96, 12); max = (3, 0.4); } );/' channel.cfg >blocks.cfg
refused blocks "take fv.cells, which need none" blocks.cfg
sed 's/kind = "inflow"; velocity = (0.3, 0); profile = "parabolic"/kind = "outflow"; pressure = 0.45/' channel.cfg >outlets.cfg
refused outlets "nothing would say how much flows through it" outlets.cfg
sed 's/^fv: .*/fv: {}; blocks: ( { cells = (96, 12); max = (3, 0.4); } );/' outlets.cfg >outlets_blocks.cfg
refused outlets_blocks "nothing would say how much flows through it" outlets_blocks.cfg
sed 's/cells = (96, 12)/integrator = "newton"; cells = (96, 12)/' channel.cfg >newton.cfg
refused newton "newton solves for one pressure" newton.cfg

echo "wall to wall: $a - $b_, $in - $out Pa; $v, $w m/s; $failed faults"
[ $failed = 0 ]
