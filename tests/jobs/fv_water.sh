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
# boxes and gauges without names have some; a row of the series every third step and at the end
sed 's/^fv: /blocked: ( { min = (0.5, 0); max = (0.6, 0.1); }, { min = (-0.6, 0); max = (-0.5, 0.1); } );\n&/; s/name = "[a-z]*"; //g' column.cfg >nameless.cfg
timeout 100 "$b/fv" nameless.cfg -o nameless -p time.end=0.2 >nameless.txt 2>&1 || bad "boxes without names end with $?" nameless.txt
for column in 'box force x' 'box2 force y' 'probe \[m\]' 'probe2 \[m\]'; do
    head -n 1 nameless/series.csv | grep -q ",$column" || bad "no column $column" nameless.txt
done
steps=$(number nameless steps) rows=$(($(wc -l <nameless/series.csv) - 1))
[ "$rows" = $((1 + (steps + 2) / 3)) ] || bad "$rows rows of $steps steps"
# pictures: water is in cells alone, not in the cylinder; a coupled job has its particles
clips() { sed -n '/<clipPath id="cells">/,/<.clipPath>/p' drawn/fv-scene.svg | grep -c '<path'; }
"$b/fv" "$half" --check=picture -o drawn >drawn.txt 2>&1 && [ "$(clips)" -gt 40 ] || bad "the cylinder's holes are not cut out of the water" drawn.txt
"$b/fv" column.cfg --check=picture -o drawn >drawn.txt 2>&1 && [ "$(clips)" = 1 ] || bad "the column's picture" drawn.txt
"$b/fv" "$root/cases/still_water_crossing/case.cfg" --check=picture -o drawn >drawn.txt 2>&1 && grep -q '>particles<' drawn/fv-scene.svg ||
    bad "no particles in the picture of a coupled job" drawn.txt
echo "fv_water: put back $(number shift volume_returned) with shifts, $(number fraction volume_returned) with shares; $failed faults"
[ $failed = 0 ]
