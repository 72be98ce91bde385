#!/bin/sh
# The Python package cases/estran on runs of seconds: what it reads against the runs' own figures and laws, what it draws.
# SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
python=
for p in /usr/bin/python3 python3; do
    "$p" -c 'import numpy, h5py, matplotlib' 2>/dev/null && python=$p && break
done
[ -n "$python" ] || { bad "no python3 with h5py and matplotlib: make deps"; exit 1; }
cat >pool.cfg <<'END'
format = 1;
time:    { end = 0.1; };
fluid:   { rho = 1000.0; gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (2, 1); };
initial: { field = "rest"; U = 1.0; };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { points = ((1.5, 0), (2, 0.4)); } );
shapes:  ( { form = "below"; level = 0.5; } );
bodies:  ( { name = "box"; points = ((0.5, 0.3), (0.8, 0.3), (0.8, 0.7), (0.5, 0.7)); } );
probes:  ( { name = "P"; at = (1.0, 0.1); } );
sph:     { dx = 0.05; };
output:  { every = 0.05; fields = "velocity pressure volume"; };
accept:  ( { what = "particles_lost"; tolerance = 0; } );
END
cat >cube.cfg <<'END'
format = 1;
time:    { end = 0.01; };
fluid:   { rho = 1000.0; gravity = (0, 0, -9.81); };
domain:  { dim = 3; min = (0, 0, 0); max = (1, 1, 1); };
initial: { field = "rest"; U = 1.0; };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; }, { side = "z_min"; }, { side = "z_max"; } );
shapes:  ( { form = "below"; level = 0.53; } );
fv:      { cells = (12, 12, 12); };
blocked: ( { name = "block"; min = (0.25, 0.25, 0); max = (0.5, 0.5, 0.25); } );
END
cat >tank.cfg <<'END'
format = 1;
time:    { end = 0.1; };
fluid:   { gravity = (0, -9.81); };
domain:  { min = (-1, -0.1); max = (1, 1); };
shapes:  ( { form = "below"; level = 0.4; } );
blocks:  ( { name = "tank"; min = (-0.5, 0); max = (0.5, 0.8); cells = (20, 16); i_min = "slip"; i_max = "slip"; j_min = "slip"; j_max = "slip";
             motion = ( { kind = "polynomial"; axis = "x"; coefficients = (0, 0, 10.0); } ); } );
fv:      {};
END
"$b/fv" tank.cfg -o tank >log.txt 2>&1 || bad "tank.cfg" log.txt
"$b/sph" pool.cfg -o pool >log.txt 2>&1 || bad "pool.cfg" log.txt
"$b/fv" cube.cfg -o cube >log.txt 2>&1 || bad "cube.cfg" log.txt
$mpi -np 1 "$b/sph" "$root/cases/taylor_green" -o job -p time.end=0.06 : -np 1 "$b/coupler" "$root/cases/taylor_green" -o job -p time.end=0.06 \
    : -np 1 "$b/fv" "$root/cases/taylor_green" -o job -p time.end=0.06 >log.txt 2>&1 || bad "taylor_green" log.txt
"$python" "$root/tests/jobs/plots.py" "$root" pool cube job tank || bad "plots.py"
"$root/cases/plot" pool depth >said.txt 2>&1 && bad "a field that is not there"
grep -q 'no snapshot with a field depth, only: pressure, velocity, volume' said.txt || bad "message of a field that is not there" said.txt
mkdir empty && "$root/cases/plot" empty >said.txt 2>&1 && bad "an empty folder"
grep -q 'no run here' said.txt || bad "message of an empty folder" said.txt
# a new case of each kind is sound as it stands
for o in "-s sph --body fixed" "-s sph --body floating --gauges" "-s sph --dim 3" "-s fv --gauges" "-s fv --dim 3" "-s coupled --gauges" "-s fv --body fixed" \
    "-s sph --waves --body floating" "-s fv --dim 3 --waves --body fixed" "-s coupled --waves --body floating" "-s coupled --dim 3 --body floating"; do
    # shellcheck disable=SC2086
    "$root/cases/new" my/new $o --force >said.txt 2>&1 && "$root/cases/run" my/new.cfg --check -o new >said.txt 2>&1 || bad "cases/new $o" said.txt
done
"$root/cases/new" my/new -s fv >said.txt 2>&1 && bad "cases/new over a file that is there"
# a sweep: the error of a parabola between plates falls with the cells; an ensemble of a case without chance scatters little
"$root/cases/sweep" channel_fv --together 'fv.cells=(8,8),(16,8)' fv.cfl=0.8,0.7 -p time.end=0.1 -o sweep >said.txt 2>&1 || bad "cases/sweep" said.txt
grep -q 'cells=(16,8)  fv.cfl=0.7 .* order ' said.txt || bad "order of a sweep" said.txt
"$root/cases/sweep" channel_fv --together 'fv.cells=(8,8),(16,8)' fv.cfl=0.8 -o sweep >said.txt 2>&1 && bad "a sweep of unlike lists" said.txt
[ "$(wc -l <sweep/sweep.csv)" = 3 ] && [ -s sweep/sweep.png ] || bad "files of cases/sweep" said.txt
"$root/cases/ensemble" channel_fv -n 2 -p 'fv.cells=(8,8)' -p time.end=0.1 -o ensemble >said.txt 2>&1 || bad "cases/ensemble" said.txt
grep -q '^cpu_s,' ensemble/ensemble.csv || bad "files of cases/ensemble" said.txt
# where nothing is known to be right, the gauges of the last run are what the others are compared with; what is there is
# not run again, unless other settings are asked for
"$root/cases/new" my/gauges -s fv --gauges >said.txt 2>&1 || bad "cases/new with gauges" said.txt
sweep_gauges() { "$root/cases/sweep" my/gauges.cfg 'fv.cells=(8,4),(16,8),(32,16)' -p "time.end=$1" -o swept >said.txt 2>&1; }
sweep_gauges 0.1 && grep -q 'cells=(16,8)  .* order ' said.txt && ! grep -q drift said.txt || bad "a sweep of gauges" said.txt
sweep_gauges 0.1 && ! grep -q 'run again' said.txt || bad "runs of a sweep that are there" said.txt
sweep_gauges 0.05 && [ "$(grep -c 'run again' said.txt)" = 3 ] || bad "a sweep to another end" said.txt
[ $failed = 0 ]
