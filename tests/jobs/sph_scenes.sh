#!/bin/sh
# Scenes as a newcomer writes them, on defaults: c0, limits and steps follow from the scene. They run through
# without a warning, in any units; where the case sets what cannot work, the diagnosis names the remedy,
# alike on any number of ranks. SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
# scene NAME END DX DOMAIN GRAVITY WALLS SHAPES [MORE]: writes NAME.cfg
scene() {
    cat >"$1.cfg" <<END
format = 1;
time:   { end = $2; };
fluid:  { gravity = $5; };
domain: { $4 };
walls:  ( $6 );
shapes: ( $7 );
${8}
sph:    { dx = $3; };
output: { snapshots = false; };
END
}
# runs NAME [ARGS]: exit 0, every value finite, no warning but of particles that leave or discs of few particles
runs() {
    name=$1
    shift
    timeout -k 5 60 "$b/sph" "$name.cfg" -o "$name" --force "$@" >"$name.txt" 2>&1 || { bad "$name $*: exit code $?" "$name.txt"; return; }
    grep '^warning' "$name.txt" | grep -Eqv 'left the region|first particles hold' && bad "$name $*: warns" "$name.txt"
    grep -q '"energy_gain"' "$name/summary.json" || bad "$name $*: its energy is not watched" "$name.txt"
}

# a square of water into a corner, a column over an obstacle, jets, a drop into a pool, a film, a moving body
scene corner 1 0.04 'min = (-2, 0); max = (0, 2);' '(0, 0)' '{ side = "x_max"; }, { side = "y_min"; }' \
    '{ form = "box"; box = ((-0.9, 0.3), (-0.3, 0.9)); velocity = (1, -1); }'
scene oblique 0.7 0.04 'max = (2, 2);' '(0, 0)' '{ side = "x_min"; }, { side = "y_min"; }' \
    '{ form = "box"; box = ((0.3, 0.8), (1.3, 1.2)); velocity = (-1.8, -0.8); }'
scene jets 0.6 0.05 'min = (-2, -2); max = (2, 2);' '(0, 0)' '' \
    '{ form = "box"; box = ((-1.2, -0.2), (-0.2, 0.2)); velocity = (2, 0); }, { form = "box"; box = ((0.2, -0.2), (1.2, 0.2)); velocity = (-2, 0); }'
scene pool 0.7 0.05 'max = (2, 1.4);' '(0, -9.81)' '{ side = "x_min"; }, { side = "y_min"; }, { side = "x_max"; }' \
    '{ form = "below"; level = 0.4; }, { form = "disc"; centre = (1, 1.1); radius = 0.16; }'
scene film 0.6 0.04 'max = (0.8, 0.6); periodic = (true, false);' '(1, -9)' '{ side = "y_min"; }' \
    '{ form = "box"; box = ((0, 0), (0.8, 0.31)); }'
scene column 1 0.04 'max = (2, 1.2);' '(0, -9.81)' \
    '{ points = ((0, 1.2), (0, 0), (1.2, 0), (1.35, 0.2), (1.5, 0), (2, 0), (2, 1.2)); }' \
    '{ form = "box"; box = ((0, 0), (0.5, 0.6)); }'
scene paddle 0.6 0.04 'max = (1, 1.04);' '(0, 0)' '{ side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; }' '' \
    'bodies: ( { spin = 1.5; centre = (0.5, 0.5); points = ((0.3, 0.44), (0.3, 0.56), (0.7, 0.56), (0.7, 0.44)); } );'
# a dam that breaks onto a beach, drawn into the tank as one line more; water at rest before it
sides='{ side = "x_min"; }, { side = "y_min"; }, { side = "x_max"; }'
scene beach 0.6 0.02 'max = (2, 1.2);' '(0, -9.81)' "$sides, { points = ((1.2, 0), (2, 0.4)); }" '{ form = "box"; box = ((0, 0), (0.5, 0.5)); }'
scene shore 0.4 0.02 'max = (2, 1.2);' '(0, -9.81)' "$sides, { points = ((1.1, -0.05), (2.2, 0.5)); }" '{ form = "below"; level = 0.3; }'
for name in corner oblique jets pool film column paddle beach shore; do runs $name; done
awk -v m="$(number shore max_mach)" 'BEGIN { exit !(m > 0 && m < 0.003) }' || bad "water before a beach does not rest" shore.txt
sed 's/(1.1, -0.05), (2.2, 0.5)/(1.1, 0), (1.7, 0.25)/' shore.cfg >plate.cfg
"$b/sph" plate.cfg --check >plate.txt 2>&1
grep -q 'walls.\[3\].points: the line stands on another wall .*both of its faces' plate.txt || bad "a line with water on both sides" plate.txt
runs corner -p 'sph.scheme="riemann_ale"'
runs jets -p 'sph.scheme="delta"'

# what a coarse lattice cannot fill of a tank that is one open line is told beside what was asked; a fine one can
scene asked 0.01 0.05 'min = (-0.12, -0.12); max = (1.12, 1);' '(0, -9.81)' '{ points = ((0, 0.8), (0, 0), (1, 0), (1, 0.8)); }' \
    '{ form = "below"; level = 0.28; }'
runs asked
grep -q 'more than the shapes: 0.2[0-9]* of 0.2[78][0-9]* m^2' asked.txt || bad "the water asked for between open lines is not told" asked.txt
runs asked -p sph.dx=0.02
grep -q '^warning' asked.txt && bad "a lattice that fits is warned of" asked.txt

# the same column 1024 times smaller and larger. Lengths by a power of four scale times by a power of two:
# nothing is rounded otherwise, so every figure without a unit is the same to its last digit
for k in 0.0009765625 1 1024; do
    at() { for x in "$@"; do awk -v x="$x" -v k=$k 'BEGIN { printf "%.17g ", x * k }'; done; }
    # shellcheck disable=SC2046
    set -- $(at 4 3.04 1 2 0.08)
    end=$(awk -v k=$k 'BEGIN { printf "%.17g", sqrt(k) }')
    scene "units$k" "$end" "$5" "max = ($1, $2);" '(0, -9.81)' '{ side = "x_min"; }, { side = "y_min"; }, { side = "x_max"; }' \
        "{ form = \"box\"; box = ((0, 0), ($3, $4)); }"
    runs "units$k"
    echo "$(number "units$k" steps) $(number "units$k" max_mach) $(tail -n 1 "units$k/series.csv" | cut -d , -f 8-15)"
done >units.txt
[ "$(sort -u units.txt | wc -l)" = 1 ] || bad "a column in other units is another flow" units.txt

# water that runs out where no wall is: the place, the same on two ranks
scene spill 0.4 0.05 'max = (1, 0.8);' '(0, -9.81)' '{ side = "x_min"; }, { side = "y_min"; }' '{ form = "box"; box = ((0, 0), (0.5, 0.4)); }'
for n in 1 2; do
    timeout -k 5 60 mpirun --oversubscribe -np $n "$b/sph" spill.cfg -o spill --force >spill.txt 2>&1 || bad "spill on $n ranks ended with $?" spill.txt
    grep -q 'left the region since the start, the first across x_max at (1' spill.txt || bad "spill on $n ranks: not told where" spill.txt
done

# c0 too low: the remedy is c0, the place is the same on any number of ranks
for n in 1 2 4; do
    timeout -k 5 60 mpirun --oversubscribe -np $n "$b/sph" column.cfg -o low --force -p sph.c0=3.0 >low$n.txt 2>&1
    [ $? = 3 ] || bad "c0 too low on $n ranks: not stopped" low$n.txt
    grep -q 'likely .*raise it to 34.3 m/s' low$n.txt || bad "c0 too low on $n ranks: another remedy" low$n.txt
    grep -A 2 'diverged at' low$n.txt >low$n.said
done
for n in 2 4; do
    cmp -s low1.said low$n.said || bad "c0 too low: $n ranks differ" low$n.said
done
grep -q '"mach"' low/summary.json || bad "a run that failed does not tell its watches" low4.txt

# a star that starts at once in a full tank: its work against the weight of the water is known
scene star 0.16 0.1 'max = (4, 3);' '(0, -9.81)' '{ side = "x_min"; }, { side = "y_min"; }, { side = "x_max"; }, { side = "y_max"; }' '' \
    'bodies: ( { name = "star"; velocity = (-0.3, -1.1); points = ((2.42, 2.24), (2.71, 1.85), (3.2, 1.86), (3, 1.42), (3.26, 1), (2.77, 0.95),
                (2.55, 0.52), (2.26, 0.91), (1.77, 0.9), (1.97, 1.34), (1.71, 1.76), (2.19, 1.81)); } );'
runs star -p fluid.nu=0.001

# creeping water that leans into a corner of slip walls
scene creep 2 0.90625 'max = (29, 9.0625);' '(-4.5427783941475974, -8.6947837501381109)' '{ side = "x_min"; }, { side = "y_min"; }, { side = "y_max"; }' \
    '{ form = "box"; box = ((0, 0), (29, 2.71875)); }, { form = "disc"; centre = (14.5, 5.96894454); radius = 2.1873; }'
runs creep -p fluid.nu=100

# a lid at Re 0.1: friction's pressure sets c0, so that density stays within some percent; a given c0 that is too low is told
cat >lid.cfg <<'END'
format = 1;
time:    { end = 0.005; };
fluid:   { rho = 1000.0; nu = 10.0; };
domain:  { dim = 2; max = (1, 1); };
initial: { field = "rest"; };
walls:   ( { side = "x_min"; kind = "no_slip"; }, { side = "x_max"; kind = "no_slip"; }, { side = "y_min"; kind = "no_slip"; },
           { side = "y_max"; kind = "no_slip"; velocity = (1, 0); } );
sph:     { dx = 0.1; };
output:  { series = 1; snapshots = false; };
END
runs lid
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /max density/) k = i; next } $k > m { m = $k } END { exit !(m > 1000 && m < 1030) }' \
    lid/series.csv || bad "creeping lid: density off by more than 3 %" lid.txt
"$b/sph" lid.cfg --check -p sph.c0=10 >lid.txt 2>&1
grep -q '^warning: sph.c0 = 10 m/s: friction alone .* raise it to 100 m/s' lid.txt || bad "creeping lid: c0 too low without a word" lid.txt
"$b/sph" lid.cfg --check -p sph.dx=0.5 >lid.txt 2>&1
grep -q '^warning: 2 particles between the walls along x' lid.txt || bad "two particles across: no word" lid.txt
"$b/sph" lid.cfg --check -p sph.dx=1 >lid.txt 2>&1
grep -q 'sph.dx: 1 m: one particle has no room between the walls along x' lid.txt || bad "one particle across: no word" lid.txt

# water that nothing catches is told before it falls, and not where it is caught: by a tank of lines, of which "below"
# is meant to fill the inside alone, by a bowl under a drop, by a side that gravity at a slant leads to
scene falls 1 0.04 'max = (2, 1.2);' '(0, -9.81)' '{ side = "x_min"; }, { side = "y_max"; }' '{ form = "box"; box = ((0, 0.2), (0.5, 0.6)); }'
scene upward 1 0.04 'max = (1, 1.2);' '(0, 9.81)' "$sides" '{ form = "box"; box = ((0, 0), (1, 0.6)); }'
scene spout 1 0.04 'max = (2, 1.2);' '(0, -9.81)' '{ points = ((0, 1.2), (0, 0.4), (0.6, 0.4)); }' \
    '{ form = "box"; box = ((0.2, 0.4), (0.6, 0.8)); velocity = (3, 0); }'
for name in falls upward spout; do
    "$b/sph" $name.cfg --check >$name.txt 2>&1
    grep -q '^warning: nothing catches .* % of the water' $name.txt || bad "$name: water falls out without a word" $name.txt
done
scene vat 0.1 0.05 'min = (-2, -2); max = (3, 2);' '(0, -9.81)' '{ points = ((0, 1), (0, 0), (1, 0), (1, 1)); }' '{ form = "below"; level = 0.6; }'
scene bowl 0.1 0.04 'max = (2, 1.2);' '(0, -9.81)' '{ points = ((0.4, 0.5), (0.6, 0.2), (1, 0.2), (1.2, 0.5)); }' \
    '{ form = "disc"; centre = (0.8, 0.8); radius = 0.2; }'
scene slant 0.1 0.04 'max = (1, 1.2);' '(-5, -7)' '{ side = "x_min"; }, { side = "y_min"; }' '{ form = "box"; box = ((0, 0), (0.4, 0.4)); }'
for name in vat bowl slant; do runs $name; done

# a region that a body fills but for the guards at its edges refines nothing, and says so; a larger one does
scene idle 0.005 0.04 'max = (2, 1.2);' '(0, -9.81)' "$sides" '{ form = "box"; box = ((0, 0), (2, 1)); }' \
    'bodies: ( { points = ((0.84, 0.4), (0.84, 0.72), (1.16, 0.72), (1.16, 0.4)); } ); apr: { regions = ( { min = (0.68, 0.24); max = (1.32, 0.88); } ); };'
"$b/sph" idle.cfg -o idle >idle.txt 2>&1
grep -q '^warning: level 1 refines nothing' idle.txt || bad "a level without particles that flow: no word" idle.txt
sed 's/min = (0.68, 0.24); max = (1.32, 0.88)/min = (0.52, 0.08); max = (1.48, 1.04)/' idle.cfg >busy.cfg
"$b/sph" busy.cfg -o busy >busy.txt 2>&1
grep -q 'refines nothing' busy.txt && bad "a level with particles that flow is called idle" busy.txt

# steps beyond the bound
refused() { # ARGS: the step is beyond the bound
    "$b/sph" jets.cfg -o never "$@" >cfl.txt 2>&1
    code=$?
    grep -q "is unstable with this" cfl.txt || code="$code and other words"
    [ "$code" = 2 ] || bad "$* is not refused: exit code $code" cfl.txt
}
refused -p sph.cfl=0.7
refused -p sph.cfl=1.3 -p 'sph.scheme="delta"'
refused -p sph.cfl_viscous=0.2 -p fluid.nu=10
[ $failed = 0 ] && echo "all scenes run"
