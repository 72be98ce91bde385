#!/bin/sh
# Scenes of fv alone where two treatments meet: a shape and a period, an inflow and the first row.
# SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
run() { # CASE ARGUMENTS...: runs CASE.cfg into the folder CASE
    name=$1
    shift
    timeout 100 "$b/fv" "$name.cfg" -o "$name" --force "$@" >"$name.txt" 2>&1 || bad "$name ends with $?" "$name.txt"
}
# a film on a slope, gravity along a period: levels count across the film, wherever it lies
cat >slope.cfg <<'END'
format = 1;
time:    { end = 0.05; };
fluid:   { rho = 1000.0; nu = 0.01; gravity = (5, -5); };
domain:  { dim = 2; min = (3.7, -11.3); max = (4.7, -10.8); periodic = (true, false); };
walls:   ( { side = "y_min"; kind = "no_slip"; } );
shapes:  ( { form = "below"; level = -11.09; } );
probes:  ( { name = "film"; kind = "level"; at = (3.9, -11.3); } );
fv:      { cells = (16, 24); };
END
run slope
near "$(last slope/series.csv film)" -11.09 1e-9 || bad "a film on a slope stands at $(last slope/series.csv film) m" slope.txt
echo "fv_scenes: $failed faults"
[ $failed = 0 ]
