#!/bin/sh
# Inlets and outlets of sph under a free surface against the laws of shallow water: a level channel stays level, what is
# asked for comes in and goes out, a bore has the height of its jump relations, water at rest between two levels rests.
# SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
# channel NAME END VELOCITY LEVEL INFLOW OUTFLOW: 1 m long
channel() {
    cat >"$1.cfg" <<END
format = 1;
time:    { end = $2; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; max = (1, 0.4); };
initial: { field = "uniform"; velocity = ($3, 0); };
walls:   ( { side = "x_min"; kind = "inflow"; $5; }, { side = "x_max"; kind = "outflow"; $6 }, { side = "y_min"; } );
shapes:  ( { form = "below"; level = $4; } );
probes:  ( { name = "up"; kind = "level"; at = (0.25, 0.1); }, { name = "middle"; kind = "level"; at = (0.5, 0.1); }, { name = "down"; kind = "level"; at = (0.75, 0.1); },
           { name = "flow"; kind = "discharge"; at = (0.5, 0); to = (0.5, 0.4); }, { name = "slant"; kind = "discharge"; at = (0.375, -0.05); to = (0.6, 0.4); } );
sph:     { dx = 0.02; c0 = 20.0; };
output:  { snapshots = false; };
END
}
runs() {
    timeout -k 5 120 "$b/sph" "$1.cfg" -o "$1" --force >"$1.txt" 2>&1 || bad "$1: exit code $?" "$1.txt"
    grep '^warning' "$1.txt" | grep -qv 'sph.c0' && bad "$1: warns" "$1.txt"
}
# mean NAME COLUMN FROM TO: over that time
mean() { awk -F, -v name="$2" -v from="$3" -v to="$4" 'NR == 1 { for (i = 1; i <= NF; i++) if (index($i, name) == 1) c = i; next }
    $1 >= from && $1 <= to { s += $c; n++ } END { if (n) print s / n }' "$1/series.csv"; }
# level NAME WANTED FROM TO RELATIVE: of all three gauges
level() { for gauge in up middle down; do
    close_to "$(mean $1 $gauge $3 $4)" $2 $5 || bad "$1: level $gauge $(mean $1 $gauge $3 $4) m, not $2 m" "$1.txt"; done; }

# Froude number 0.25, ten transits of a wave; the level does not end on a lattice row in the second
channel level 7 0.35 0.2 'discharge = 0.07' 'level = 0.2;'
channel shifted 7 0.35 0.207 'discharge = 0.07245' 'level = 0.207;'
channel shallow 7 0.3 0.16 'discharge = 0.048' 'level = 0.16;'
channel still 4 0 0.2 'level = 0.2' 'level = 0.2;'
channel bore 0.8 0 0.2 'velocity = (0.35, 0)' ''
for name in level shifted shallow still bore; do runs $name; done
level level 0.2 5 7 0.01
level shifted 0.207 5 7 0.01
level still 0.2 3 4 0.01
# eight rows, what is in them: 160 kg and g h^2/(2 c0^2) for the weight of the water (-1.7 % where the pressure outside was hydrostatic up
# to the surface, which particles exceed there)
close_to "$(mean shallow 'mass [' 5 7)" 160.31 0.01 || bad "shallow: $(mean shallow 'mass [' 5 7) kg for 160.31" shallow.txt
close_to "$(number level x_min)" 490 0.02 || bad "discharge in: $(number level x_min) kg for 490" level.txt
close_to "$(number level x_max)" -490 0.02 || bad "discharge out: $(number level x_max) kg for -490" level.txt
# the same through any section, upright or not
for gauge in flow slant; do
    close_to "$(mean level $gauge 4 7)" 0.07 0.02 || bad "level: $gauge $(mean level $gauge 4 7) m^2/s for 0.07" level.txt
done
near "$(number level budget)" 0 0.02 || bad "mass lost or made: $(number level budget)" level.txt
near "$(number still x_min)" 0 1 || bad "water at rest comes in: $(number still x_min) kg" still.txt
# jump relations: u = (h2 - h1) sqrt(g (h1 + h2)/(2 h1 h2)) = 0.35 m/s
close_to "$(mean bore up 0.35 0.8)" 0.2528 0.02 || bad "bore: $(mean bore up 0.35 0.8) m for 0.2528" bore.txt
"$b/sph" level.cfg --check | grep -q 'x_max: water 0.2 m high outside' || bad "--check does not say what the outflow does"

# an inlet that a block cuts in two: a parabola in each opening, of two thirds of its largest velocity
cat >two.cfg <<'END'
format = 1;
time:    { end = 2; };
fluid:   { nu = 0.002; };
domain:  { max = (1.2, 1); };
walls:   ( { side = "x_min"; kind = "inflow"; velocity = (0.4, 0); profile = "parabolic"; }, { side = "x_max"; kind = "outflow"; },
           { side = "y_min"; kind = "no_slip"; }, { side = "y_max"; kind = "no_slip"; },
           { kind = "no_slip"; points = ((0, 0.6), (1.2, 0.6), (1.2, 0.4), (0, 0.4)); } );
probes:  ( { name = "low"; kind = "discharge"; at = (0.6, 0); to = (0.6, 0.4); }, { name = "high"; kind = "discharge"; at = (0.6, 0.6); to = (0.6, 1); } );
sph:     { dx = 0.025; };
output:  { snapshots = false; };
END
timeout -k 5 60 "$b/sph" two.cfg -o two --force >two.txt 2>&1 || bad "two inlets: exit code $?" two.txt
for name in low high; do # m^2/s, within what gauges of discharge err by
    close_to "$(mean two $name 1 2)" 0.10667 0.03 || bad "$name of two inlets: $(mean two $name 1 2) m^2/s for 0.1067" two.txt
done
# in 3D a parabola spans the whole side, and is refused where a mesh cuts that
stl '-0.2 0.4 -0.2' '1.4 0.6 1.2' >wall.stl
cat >two3.cfg <<'END'
format = 1;
time:    { end = 0.1; };
fluid:   { nu = 0.002; };
domain:  { dim = 3; max = (1.2, 1, 1); };
walls:   ( { side = "x_min"; kind = "inflow"; velocity = (0.4, 0, 0); profile = "parabolic"; }, { side = "x_max"; kind = "outflow"; },
           { side = "y_min"; }, { side = "y_max"; }, { side = "z_min"; }, { side = "z_max"; }, { mesh = "wall.stl"; } );
sph:     { dx = 0.05; };
END
refused_by sph two3.cfg '' 'walls.\[0\].profile: parabolic in 3D spans the whole side'
sed 's/profile = "parabolic";//' two3.cfg >whole3.cfg
start sph whole3.txt whole3.cfg --check || bad "a uniform inlet that a mesh cuts is refused" whole3.txt

exit $failed
