#!/bin/sh
# Water that hangs by suction, or that a line cuts off, is told at the start, a U-tube of ten particles an arm is not warned of; figures of a
# run that water leaves do not depend on where the origin is, and hold no balance that nobody has booked.
# SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
# tube NAME BODIES SHAPES: a tank of 1.2 m x 1 m
tube() {
    cat >"$1.cfg" <<END
format = 1;
time:   { end = 0.001; };
fluid:  { gravity = (0, -9.81); };
domain: { max = (1.2, 1); };
walls:  ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } );
bodies: ( $2 );
shapes: ( $3 );
sph:    { dx = 0.02; };
output: { snapshots = false; };
END
    start sph "$1.txt" "$1.cfg" -o "$1" --force || bad "$1: exit code $?" "$1.txt"
}
tube siphon '{ points = ((0.5, 0.3), (0.5, 0.6), (0.7, 0.6), (0.7, 0.2)); },
    { points = ((0.4, 0.2), (0.3, 0.2), (0.3, 0.8), (0.96, 0.8), (0.96, 0.1), (0.8, 0.1), (0.8, 0.7), (0.4, 0.7)); }' \
    '{ form = "box"; box = ((0, 0), (0.6, 0.4)); },
    { form = "polygon"; points = ((0.4, 0.1), (0.4, 0.7), (0.8, 0.7), (0.8, 0.1), (0.7, 0.1), (0.7, 0.6), (0.5, 0.6), (0.5, 0.1)); }'
grep -q '^warning: .* stands 0.3 m above the level .*suction' siphon.txt || bad "a siphon: no word" siphon.txt
tube utube '{ points = ((0.2, 0.2), (0.2, 0.9), (1, 0.9), (1, 0.2)); }' \
    '{ form = "box"; box = ((0, 0), (0.2, 0.5)); }, { form = "box"; box = ((0.2, 0), (1, 0.2)); }, { form = "box"; box = ((1, 0), (1.2, 0.4)); }'
grep -q '^warning' utube.txt && bad "a U-tube of ten particles is warned of" utube.txt

# a partition that is a line leaves out the water on its right; a beach does not, whose water lies under it
for line in '(0.2, 1), (0.2, 0)' '(0.7, 0), (1.2, 0.6)'; do
    cat >parted.cfg <<END
format = 1;
time:   { end = 0.001; };
fluid:  { gravity = (0, -9.81); };
domain: { max = (1.2, 1); };
walls:  ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { points = ($line); } );
shapes: ( { form = "below"; level = 0.4; } );
sph:    { dx = 0.02; };
output: { snapshots = false; };
END
    start sph parted.txt parted.cfg -o parted --force || bad "parted: exit code $?" parted.txt
    case $line in
    *"1), (0.2"*) grep -q '^warning: lines among the walls leave out 1[5-7] %' parted.txt || bad "a partition: no word" parted.txt ;;
    *) grep -q 'leave out' parted.txt && bad "a beach is taken for a partition" parted.txt ;;
    esac
done

# a column that falls out over an edge, and the same 3 m lower
for low in 0 -3; do
    cat >spill$low.cfg <<END
format = 1;
time:   { end = 0.4; };
fluid:  { gravity = (0, -9.81); };
domain: { min = (0, $low); max = (0.6, $((low + 1))); };
walls:  ( { side = "x_min"; }, { side = "y_min"; }, { side = "x_max"; kind = "outflow"; } );
shapes: ( { form = "box"; box = ((0, $low), (0.4, $(awk "BEGIN { print $low + 0.3 }"))); } );
sph:    { dx = 0.02; };
output: { snapshots = false; };
END
    start sph spill.txt spill$low.cfg -o spill$low --force || bad "spill $low: exit code $?" spill.txt
    grep -q '"defect"' spill$low/summary.json && bad "water that leaves takes momentum along: a defect is shown" spill.txt
done
below "$(number spill0 x_max)" -10 || bad "no water falls out" spill.txt
near "$(sed -n '/"drift"/,/}/p' spill0/summary.json | sed -n 's/.*"energy": *\([^,]*\).*/\1/p')" \
    "$(sed -n '/"drift"/,/}/p' spill-3/summary.json | sed -n 's/.*"energy": *\([^,]*\).*/\1/p')" 1e-3 ||
    bad "drift.energy depends on the origin" spill-3/summary.json
[ $failed = 0 ] && echo "suction, and water that leaves"
