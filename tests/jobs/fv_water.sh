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
expect 'where it is' column.cfg -p 'fluid.gravity=(3, -9)'
expect 'as a whole*(blocks overlap)' "$half"
expect 'fraction is not to be had*blocks overlap' "$heaving" -p fv.volume=fraction
# a column that collapses in a tank that is shaken, rolls, stands askew, or is a parallelogram: nothing is lost, whether walls
# move from the start on or not; where all goes with 1 m/s it goes on as in a tank at rest
basin() { # NAME POLYGON KEYS: of the block
    cat >"$1.cfg" <<END
format = 1;
time:    { end = 1.2; };
fluid:   { rho = 1000.0; gravity = (0, -9.81); };
domain:  { dim = 2; min = (-2, -1); max = (3, 2); };
shapes:  ( { form = "polygon"; points = ($2); } );
blocks:  ( { name = "t"; min = (-0.5, 0); max = (0.5, 0.7); cells = (32, 24); i_min = "slip"; i_max = "slip"; j_min = "slip"; j_max = "slip"; $3 } );
fv:      {};
output:  { snapshots = false; series = 1; };
END
    "$b/fv" "$1.cfg" -o "$1" >"$1.txt" 2>&1 || bad "the tank that $1 ends with $?" "$1.txt"
    near "$(number "$1" volume_returned)" 0 0.001 || bad "the tank that $1: $(number "$1" volume_returned) of the water put back" "$1.txt"
    near "$(number "$1" volume)" 0 1e-9 || bad "the tank that $1: its volume is off by $(number "$1" volume)" "$1.txt"
}
upright='(-0.5, 0), (-0.2, 0), (-0.2, 0.5), (-0.5, 0.5)' shake='kind = "harmonic"; amplitude = 0.05; period = 1.3;'
basin rests "$upright" ''
basin shakes "$upright" "motion = ( { axis = \"x\"; $shake } );"
basin rolls "$upright" "centre = (0, 0); motion = ( { axis = \"rz\"; $shake } );"
basin sways '(-0.5, 0), (0.5, 0), (0.5, 0.4), (-0.5, 0.4)' "motion = ( { axis = \"x\"; ramp = 1; $shake } );" # smooth until it breaks
"$b/fv" sways.cfg -o sways -p time.end=3 --force >sways.txt 2>&1 || bad "the tank that sways for longer ends with $?" sways.txt
near "$(number sways volume_returned)" 0 0.001 || bad "swaying: $(number sways volume_returned) of the water put back" sways.txt
basin leans '(-0.47, -0.17), (-0.188, -0.068), (-0.359, 0.401), (-0.641, 0.299)' 'angle = 20;'
basin shears '(-0.5, 0), (-0.2, 0), (0, 0.5), (-0.3, 0.5)' 'mapping = "sheared"; shear = 0.4;'
sed 's/form = "polygon";/& velocity = (1, 0);/; s/cells = (32, 24);/& motion = ( { kind = "polynomial"; axis = "x"; coefficients = (0, 1); } );/' rests.cfg >goes.cfg
for name in rests goes; do "$b/fv" $name.cfg -o $name -p time.end=0.2 --force >$name.txt 2>&1 || bad "the tank that $name ends with $?" $name.txt; done
close_to "$(last goes/series.csv 'force x')" "$(last rests/series.csv 'force x')" 0.01 ||
    bad "force on a tank at rest $(last rests/series.csv 'force x') N, on one that goes along $(last goes/series.csv 'force x') N"
# gravity that leans: four ranks, each with a corner of the others beside it, give what one gives
for ranks in 1 4; do
    mpirun --quiet --bind-to none --oversubscribe -np $ranks "$b/fv" column.cfg -o leans$ranks -p 'fluid.gravity=(3, -9)' -p time.end=0.2 \
        -p 'fv.cells=(40, 20)' -p 'walls=( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } )' >leans$ranks.txt 2>&1
    [ $? -le 1 ] || bad "leaning gravity on $ranks ranks ends with $?" leans$ranks.txt
done
close_to "$(last leans4/series.csv 'kinetic energy')" "$(last leans1/series.csv 'kinetic energy')" 1e-7 ||
    bad "leaning gravity: $(last leans1/series.csv 'kinetic energy') J, on four ranks $(last leans4/series.csv 'kinetic energy')"
# a tank that falls dry through an open side goes on without water; without such a side the run ends
sed 's/((-0.25, 0), (0.25, 0.6))/((-1, 0), (1, 0.3))/; s/{ side = "x_max"; }/{ side = "x_max"; kind = "outflow"; level = -1; }/; s/(80, 40)/(48, 24)/' column.cfg >dry.cfg
timeout 100 "$b/fv" dry.cfg -o dry -p time.end=40 >dry.txt 2>&1 || bad "a tank that falls dry ends with $?" dry.txt
grep -q 'the water has left, but for .* m^2 finer than the cells' dry.txt || bad "no word of a tank that fell dry" dry.txt
# on blocks the matrix has rows of water alone: some ranks have none from the start, none has any after the water has flown out
cat >flies.cfg <<'END'
format = 1;
time:    { end = 0.5; };
fluid:   { rho = 1000.0; nu = 1e-6; gravity = (0, -0.5); };
domain:  { dim = 2; min = (0, 0); max = (1, 0.5); };
initial: { field = "rest"; U = 1.4; };
shapes:  ( { form = "box"; box = ((0.7, 0.3), (1.0, 0.4)); velocity = (2, 0); } );
fv: {};
blocks:  ( { cells = (40, 20); min = (0, 0); max = (1, 0.5); i_min = "slip"; i_max = "outflow"; j_min = "slip"; j_max = "slip"; } );
END
mpirun --quiet --bind-to none --oversubscribe -np 3 "$b/fv" flies.cfg -o flies >flies.txt 2>&1 || bad "water that flies out of a block ends with $?" flies.txt
grep -q 'the water has left' flies.txt || bad "no word of water that has flown out of a block" flies.txt
# lines of blocks that lean: the same on any ranks
cat >askew.cfg <<'EOF'
format = 1;
time:    { end = 0.2; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; min = (-1, -1); max = (1, 1); };
shapes:  ( { form = "polygon"; points = ((-1, -1), (1, -1), (1, 0.2), (-1, -0.2)); } );
blocks:  ( { cells = (24, 24); min = (-0.5, -0.5); max = (0.5, 0.5); angle = 20; i_min = "slip"; i_max = "slip"; j_min = "slip"; j_max = "slip"; } );
fv:      { tol_pressure = 1e-10; };
EOF
for ranks in 1 4; do
    mpirun --quiet --bind-to none --oversubscribe -np $ranks "$b/fv" askew.cfg -o askew$ranks >askew$ranks.txt 2>&1
    [ $? -le 1 ] || bad "leaning blocks on $ranks ranks end with $?" askew$ranks.txt
done
close_to "$(last askew4/series.csv 'kinetic energy')" "$(last askew1/series.csv 'kinetic energy')" 1e-7 ||
    bad "leaning blocks: $(last askew1/series.csv 'kinetic energy') J, on four ranks $(last askew4/series.csv 'kinetic energy')"
# boxes and gauges without names have some; a row of the series every third step and at the end
sed 's/^fv: /blocked: ( { min = (0.5, 0); max = (0.6, 0.1); }, { min = (-0.6, 0); max = (-0.5, 0.1); } );\n&/; s/name = "[a-z]*"; //g' column.cfg >nameless.cfg
timeout 100 "$b/fv" nameless.cfg -o nameless -p time.end=0.2 >nameless.txt 2>&1 || bad "boxes without names end with $?" nameless.txt
for column in 'box force x' 'box2 force y' 'probe \[m\]' 'probe2 \[m\]'; do
    head -n 1 nameless/series.csv | grep -q ",$column" || bad "no column $column" nameless.txt
done
steps=$(number nameless steps) rows=$(($(wc -l <nameless/series.csv) - 1))
[ "$rows" = $((1 + (steps + 2) / 3)) ] || bad "$rows rows of $steps steps"
# a body at rest that is a box is one that is cut out: the scene of the particles runs in cells and gives the same as the list
# blocked; water at rest lifts it by what it displaces, in both programs. Other bodies are refused, each with its reason
tank() { # NAME: water at rest round what is on standard input
    cat - >"$1.cfg"
    cat >>"$1.cfg" <<END
format = 1;
time:    { end = 0.3; };
fluid:   { rho = 1000.0; gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (1.6, 1); };
shapes:  ( { form = "box"; box = ((0, 0), (1.6, 0.7)); } );
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
fv:      { cells = (64, 40); };
output:  { snapshots = false; };
END
}
echo 'bodies: ( { name = "b"; points = ((0.6, 0.3), (0.6, 0.5), (1, 0.5), (1, 0.3)); } );' | tank body
echo 'blocked: ( { name = "b"; min = (0.6, 0.3); max = (1, 0.5); } );' | tank box
for name in body box; do "$b/fv" $name.cfg -o $name >$name.txt 2>&1 || bad "$name at rest ends with $?" $name.txt; done
cmp -s body/series.csv box/series.csv || bad "a body and the box that it is give two answers" body.txt
near "$(last body/series.csv 'b force y')" 784.8 0.001 || bad "the body is lifted by $(last body/series.csv 'b force y') N, not 784.8" body.txt
{ sed '/^fv: /d' body.cfg; echo 'sph: { dx = 0.025; };'; } >particles.cfg
"$b/sph" particles.cfg -o particles >particles.txt 2>&1 || bad "the same scene in particles ends with $?" particles.txt
lift=$(awk -F, 'NR == 1 { while ($(++k) !~ /^b force y/) ; next } { sum += $k; n++ } END { print sum / n }' particles/series.csv)
close_to "$lift" 784.8 0.01 || bad "particles lift it by $lift N on average" particles.txt
stl "0.4 0.3 0.2" "0.8 0.7 0.4" >cube.stl
sed 's/dim = 2; min = (0, 0); max = (1.6, 1)/dim = 3; min = (0, 0, 0); max = (1.2, 1, 0.8)/; s/(0, -9.81)/(0, 0, -9.81)/; s/((0, 0), (1.6, 0.7))/((0, 0, 0), (1.2, 1, 0.6))/
    s/{ side = "y_max"; }/&, { side = "z_min"; }, { side = "z_max"; }/; s/points = [^;]*;/mesh = "cube.stl";/; s/(64, 40)/(24, 20, 16)/' body.cfg >cube.cfg
"$b/fv" cube.cfg -o cube >cube.txt 2>&1 || bad "a cube of triangles in cells ends with $?" cube.txt
near "$(last cube/series.csv 'b force z')" 313.92 0.001 || bad "the cube is lifted by $(last cube/series.csv 'b force z') N, not 313.92" cube.txt
refuses() { # WORDS BODY: the fault that cells find in it
    echo "bodies: ( { $2 } );" | tank refused
    "$b/fv" refused.cfg --check >refused.txt 2>&1
    [ $? = 2 ] && grep -q "bodies.\[0\].*$1" refused.txt || bad "no word of $1" refused.txt
}
refuses 'boxes along the axes alone' 'points = ((0.6, 0.3), (0.6, 0.5), (1, 0.3));'
refuses 'boxes along the axes alone' 'points = ((0.6, 0.4), (0.8, 0.5), (1, 0.4), (0.8, 0.3));'
refuses 'no bodies that move' 'points = ((0.6, 0.3), (0.6, 0.5), (1, 0.5), (1, 0.3)); velocity = (1, 0);'
refuses 'the force on a box alone' 'points = ((0.6, 0.3), (0.6, 0.5), (1, 0.5), (1, 0.3)); centre = (1, 0.3);'
refuses 'only 1 cells along y' 'points = ((0.6, 0.025), (0.6, 0.5), (1, 0.5), (1, 0.025));'
# pictures: water is in cells alone, not in the cylinder; a coupled job has its particles
clips() { sed -n '/<clipPath id="cells">/,/<.clipPath>/p' drawn/fv-scene.svg | grep -c '<path'; }
"$b/fv" "$half" --check=picture -o drawn >drawn.txt 2>&1 && [ "$(clips)" -gt 40 ] || bad "the cylinder's holes are not cut out of the water" drawn.txt
"$b/fv" column.cfg --check=picture -o drawn >drawn.txt 2>&1 && [ "$(clips)" = 1 ] || bad "the column's picture" drawn.txt
"$b/fv" "$root/cases/still_water_crossing/case.cfg" --check=picture -o drawn >drawn.txt 2>&1 && grep -q '>particles<' drawn/fv-scene.svg ||
    bad "no particles in the picture of a coupled job" drawn.txt
echo "fv_water: put back $(number shift volume_returned) with shifts, $(number fraction volume_returned) with shares; $failed faults"
[ $failed = 0 ]
