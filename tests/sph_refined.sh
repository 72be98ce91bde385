#!/bin/sh
# Refined scenes as a newcomer writes them, on defaults. SPDX-License-Identifier: BSD-3-Clause
b=$(cd "${1:-build}" && pwd)
tmp=${TEST_SCRATCH:-$(mktemp -d)}/sph_refined
mkdir -p "$tmp" && cd "$tmp" || exit 2
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
failed=0
bad() { # WHAT LOG
    failed=$((failed + 1))
    { echo "FAIL: $1"; tail -n 6 "$2"; } >&2
}
value() { awk -v key="\"$2\":" '$1 == key { gsub(",", "", $2); print $2; exit }' "$1/summary.json"; }

# Water at rest, a box through its surface: what the law of shifting carried across the switch turned the water
# about it, 1.8e-3 c0 after 1500 steps and 5e-3 after 2e4. Wanted: below 1e-3.
cat >rest.cfg <<'END'
format = 1;
time:   { end = 4; };
fluid:  { gravity = (0, -9.81); };
domain: { max = (0.5, 0.4); };
walls:  ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } );
shapes: ( { form = "below"; level = 0.25; } );
sph:    { dx = 0.025; };
apr:    { regions = ( { min = (0.25, 0); max = (0.6, 0.4); } ); };
output: { snapshots = false; };
END
timeout -k 5 60 "$b/sph" rest.cfg -o rest --force >rest.txt 2>&1 || bad "water at rest: exit code $?" rest.txt
grep -q '^warning' rest.txt && bad "water at rest warns" rest.txt
awk -v m="$(value rest max_mach)" 'BEGIN { exit !(m > 0 && m < 1e-3) }' || bad "water at rest: $(value rest max_mach) c0" rest.txt

[ $failed = 0 ]
