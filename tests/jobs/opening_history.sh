#!/bin/sh
# Levels and discharges of openings over time (walls.level_file, walls.discharge_file) in both programs against the law of
# volume: a closed tank takes what a hydrograph lets in, and stands as high as the tide outside.
# SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
printf '0 0.2\n0.5 0.2\n7 0.26\n12 0.26\n' >tide.csv
printf '# t q\n0, 0\n0.5, 0.02\n3, 0.02\n3.5, 0\n' >hydrograph.csv
# tank NAME END OPENING SOLVER: water 0.2 m deep, 1 m long, open at x_min
tank() {
    cat >"$1.cfg" <<END
format = 1;
time:    { end = $2; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; max = (1, 0.4); };
initial: { field = "uniform"; velocity = (0, 0); };
walls:   ( { side = "x_min"; $3; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
shapes:  ( { form = "below"; level = 0.2; } );
probes:  ( { name = "up"; kind = "level"; at = (0.25, 0.1); }, { name = "down"; kind = "level"; at = (0.75, 0.1); } );
$4
output:  { snapshots = false; series = 1; };
END
}
# mean NAME FROM TO: of both gauges
mean() { awk -F, -v from="$2" -v to="$3" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /^(up|down) /) c[++n] = i; next }
    $1 >= from && $1 <= to { s += $c[1] + $c[2]; m += 2 } END { if (m) print s / m }' "$1/series.csv"; }
runs() { timeout -k 5 120 "$b/${1#*_}" "$1.cfg" -o "$1" --force >"$1.txt" 2>&1 || bad "$1: exit code $?" "$1.txt"; }
refused() { # NAME WORDS
    "$b/${1#*_}" "$1.cfg" --check >"$1.txt" 2>&1 && bad "$1: not refused" "$1.txt"
    grep -q "$2" "$1.txt" || bad "$1: does not say '$2'" "$1.txt"
}
sph='sph: { dx = 0.02; c0 = 20.0; };' fv='fv: { cells = (40, 32); surface = "yes"; };'
for p in sph fv; do
    eval "solver=\$$p"
    tank river_$p 5 'kind = "inflow"; discharge_file = "hydrograph.csv"' "$solver"
    tank sea_$p 13 'kind = "outflow"; level_file = "tide.csv"' "$solver"
    runs river_$p
    runs sea_$p
    # 0.02 m^2/s for 3 s less the ramps are 0.06 m^2, and none comes in afterwards
    close_to "$(mean river_$p 4 5)" 0.26 0.01 || bad "river_$p: level $(mean river_$p 4 5) m for 0.26"
    # the tide rises by 1 cm in a second, a wave crosses the tank in 0.7 s
    close_to "$(mean sea_$p 3.5 4)" 0.23 0.02 || bad "sea_$p: rising $(mean sea_$p 3.5 4) m for 0.23"
    close_to "$(mean sea_$p 12 13)" 0.26 0.01 || bad "sea_$p: level $(mean sea_$p 12 13) m for 0.26"
    "$b/$p" sea_$p.cfg --check | grep -q 'by tide.csv' || bad "sea_$p: --check does not say by what the level changes"
    tank none_$p 5 'kind = "outflow"; level_file = "none.csv"' "$solver"
    refused none_$p 'none.csv: no such file'
    tank both_$p 5 'kind = "outflow"; level = 0.2; level_file = "tide.csv"' "$solver"
    refused both_$p 'give one of the two'
done
# a tide of 12 s, 17 transits: in a basin closed at its other end the level swings by cos(k x)/cos(k L) of it, x from that
# end, k = w/c of long waves
awk 'BEGIN { for (k = 0; k <= 60; k++) print 0.4 * k, 0.2 + 0.02 * sin(2 * 3.14159265 * 0.4 * k / 12) }' >swing.csv
tank swing_fv 24 'kind = "outflow"; level_file = "swing.csv"' "$fv"
runs swing_fv
swing=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /^down /) c = i; next }
    $1 >= 12 { if (!n++) low = high = $c; if ($c < low) low = $c; if ($c > high) high = $c } END { print (high - low) / 2 }' swing_fv/series.csv)
close_to "$swing" 0.02139 0.05 || bad "swing_fv: a tide of 0.02 m swings by $swing m for 0.0214"
printf '0 0.2\n1 9\n' >flood.csv
for p in sph fv; do
    eval "solver=\$$p"
    tank flood_$p 5 'kind = "outflow"; level_file = "flood.csv"' "$solver"
    refused flood_$p 'level_file: 9 m is above the domain'
done
printf '0 0.02\n1 -0.02\n' >negative.csv
tank back_fv 5 'kind = "inflow"; discharge_file = "negative.csv"' "$fv"
refused back_fv 'it is positive'
exit $failed
