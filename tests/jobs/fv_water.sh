#!/bin/sh
# Water that is carried cell by cell (fv.volume = "fraction"): a column that collapses to both sides keeps its volume, where
# shifts of the level set put a tenth of it back elsewhere; it stays symmetric. SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
cat >column.cfg <<'END'
format = 1;
time:    { end = 1.2; };
fluid:   { rho = 1000.0; nu = 1.0e-6; gravity = (0, -9.81); };
domain:  { dim = 2; min = (-1, 0); max = (1, 1); };
shapes:  ( { form = "box"; box = ((-0.25, 0), (0.25, 0.6)); } );
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
probes:  ( { name = "left"; kind = "level"; at = (-0.9, 0); }, { name = "right"; kind = "level"; at = (0.9, 0); } );
fv:      { cells = (80, 40); };
output:  { snapshots = false; };
END
for v in shift fraction; do
    timeout 100 "$b/fv" column.cfg -o $v -p "fv.volume=\"$v\"" >$v.txt 2>&1
    [ $? -le 1 ] || bad "$v ended with $?" $v.txt
done
near "$(number fraction volume_returned)" 0 0.001 || bad "$(number fraction volume_returned) of the water put back" fraction.txt
near "$(last fraction/series.csv left)" "$(last fraction/series.csv right)" 0.025 ||
    bad "levels left and right: $(last fraction/series.csv left), $(last fraction/series.csv right) m"
# the check says how, and why not otherwise
how() { # CASE ARGUMENTS...: what it says
    "$b/fv" "$@" --check 2>&1 | sed -n 's/^.*water is kept //p; s/^warning: fv.volume: //p'
}
heaving=$root/cases/heaving_cylinder_fv/case.cfg half=$root/cases/half_cylinder_fv/case.cfg
expect() { # WORDS CASE ARGUMENTS...
    words=$1
    shift
    case $(how "$@") in $words*) ;; *) bad "$*: $(how "$@"), not $words" ;; esac
}
expect 'where it is' column.cfg
expect 'as a whole*(fv.volume says so)' column.cfg -p fv.volume=shift
expect 'as a whole*(the water creeps' column.cfg -p fluid.nu=10
expect 'as a whole*(gravity leans against the lines of the cells)' column.cfg -p 'fluid.gravity=(3, -9)'
expect 'as a whole*(blocks move)' "$heaving"
expect 'as a whole*(blocks overlap)' "$half"
expect 'fraction is not to be had*blocks move' "$heaving" -p fv.volume=fraction
echo "fv_water: put back $(number shift volume_returned) with shifts, $(number fraction volume_returned) with shares; $failed faults"
[ $failed = 0 ]
