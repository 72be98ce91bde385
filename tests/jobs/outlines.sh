#!/bin/sh
# Walls, bodies and shapes from files of corners (key outline): the same run as with the points themselves, in sph and fv; what
# cannot be read is told with file and line. SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
cat >ship.svg <<'EOF'
<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 200 120"><path id="hull" d="m 60,40 h 80 l -20,40 h -40 z"/>
<polygon id="pool" points="0,120 200,120 200,0 0,0"/></svg>
EOF
printf '# a slope\nx,y\n0.5,0\n2.0,0.25\n2.0,0\n' >bed.csv
# scene NAME WALL BODY SHAPE
scene() {
    cat >"$1.cfg" <<EOF
format = 1;
time:    { end = 0.1; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; max = (2, 1.2); };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { $2 } );
bodies:  ( { name = "hull"; $3 free = true; density = 300; } );
shapes:  ( { form = "polygon"; $4 } );
sph:     { dx = 0.04; };
output:  { snapshots = false; series = 1; };
EOF
}
scene files 'outline = "bed.csv";' 'outline = "ship.svg#hull"; scale = 0.005; translate = (0.3, 0.2);' 'outline = "ship.svg#pool"; scale = 0.005; rotate = (0, 0, 180); translate = (1.5, 0.6);'
sed -i 's/translate = (1.5, 0.6)/translate = (2.0, 0.6)/; s/scale = 0.005; rotate/scale = 0.01; rotate/' files.cfg
scene points 'points = ((0.5, 0), (2, 0.25), (2, 0));' 'points = ((0.6, 0.6), (1.0, 0.6), (0.9, 0.4), (0.7, 0.4));' 'points = ((2, 0.6), (0, 0.6), (0, -0.6), (2, -0.6));'
for name in files points; do "$b/sph" $name.cfg -o $name >$name.log 2>&1 || bad "sph $name" $name.log; done
for column in 'hull y' 'hull force y' 'mass' 'kinetic energy'; do
    one=$(last files/series.csv "$column") other=$(last points/series.csv "$column")
    close_to "$one" "$other" 1e-6 || bad "sph: $column is $one from files, $other from points"
done
for name in files points; do
    sed 's/^bodies.*//; s/, { outline = "bed.csv"; }//; s/, { points = ((0.5, 0), (2, 0.25), (2, 0)); }/, { side = "y_max"; }/; s/^sph:.*/fv: { cells = (20, 12); };/' $name.cfg >fv_$name.cfg
    sed -i 's/{ side = "y_min"; } );/{ side = "y_min"; }, { side = "y_max"; } );/' fv_$name.cfg
    "$b/fv" fv_$name.cfg -o fv_$name >fv_$name.log 2>&1 || bad "fv $name" fv_$name.log
done
close_to "$(last fv_files/series.csv 'volume')" "$(last fv_points/series.csv 'volume')" 1e-9 || bad "fv: another volume from a file"
# a box, turned, and a disc, as their points are
scene square 'side = "y_max";' 'points = ((0.8, 0.5), (1.1, 0.5), (1.1, 0.3), (0.8, 0.3));' 'points = ((2, 0.4), (0, 0.4), (0, -0.6), (2, -0.6));'
sed 's/points = ((0.8, 0.5), (1.1, 0.5).*free/box = ((-0.5, -1.1), (-0.3, -0.8)); rotate = (0, 0, 90); translate = (0, 0.8); free/' square.cfg >box.cfg
for name in square box; do "$b/sph" $name.cfg -o $name >$name.log 2>&1 || bad "sph $name" $name.log; done
for column in 'hull y' 'hull force y' 'kinetic energy'; do
    close_to "$(last box/series.csv "$column")" "$(last square/series.csv "$column")" 1e-6 || bad "a box: another $column than its points have"
done
# a disc in water at rest: Archimedes (3 %)
sed 's/points = ((0.8, 0.5).*density = 300;/radius = 0.1; translate = (1, 0.2);/; s/end = 0.1/end = 0.5/; s/dx = 0.04/dx = 0.025/' square.cfg >disc.cfg
"$b/sph" disc.cfg -o disc >disc.log 2>&1 || bad "sph disc" disc.log
close_to "$(number disc average_y)" 308.19 0.03 || bad "a disc bears $(number disc average_y) N/m, not 308.19"
# refused CHANGE MESSAGE
refused() { refused_by sph files.cfg "$1" "$2"; }
printf 'x,y\n0,0\n1,zero\n' >wrong.csv
refused 's/bed.csv/none.csv/' 'faulty.cfg:[0-9]*: walls.\[3\].outline: .*none.csv cannot be read'
refused 's/bed.csv/wrong.csv/' 'walls.\[3\].outline: .*wrong.csv: line 3 is no row of x, y'
refused 's/ship.svg#hull/ship.svg#keel/' 'bodies.\[0\].outline: .*ship.svg: it has no path, polygon or polyline of the id keel'
refused 's/outline = "bed.csv";/& points = ((0, 0), (1, 1));/' 'walls.\[3\].outline: points are given, too'
refused 's/outline = "bed.csv";/points = ((0.5, 0), (2, 0.25)); scale = 2.0;/' 'walls.\[3\].scale.*no mesh and no outline is given'
refused 's/form = "polygon"/form = "box"/' 'faulty.cfg:[0-9]*: shapes'
echo "outlines: $failed faults"
[ $failed = 0 ]
