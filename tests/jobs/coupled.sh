#!/bin/sh
# Small coupled jobs from end to end: accuracy, independence of ranks, restart, orderly stop, killed partners.
# SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
small="-p sph.dx=0.0125 -p fv.cells=(24,24) -p time.end=0.24 -p output.every=0.12"
job() { # DIR RANKS ARGS...
    d=$1 r=$2
    shift 2
    # shellcheck disable=SC2086
    "$root/cases/run" taylor_green -n "$r" -o "$d" $small "$@" >"$d.txt" 2>&1
}

job one 1:1:1 --force || bad "the plain job ended with $?: $(tail -n 3 one.txt)"
below "$(number one velocity_l2)" 0.03 || bad "velocity error $(number one velocity_l2), wanted at most 0.03"
# a job of seconds, starts included, which differ from machine to machine; README has the share of real ones
below "$(number one coupler_share)" 0.5 || bad "coupler takes $(number one coupler_share) of the job's processor time"

job coupler3 1:3:1 || bad "job with 3 coupler ranks ended with $?"
same_bits one coupler3 || bad "3 coupler ranks give other bits than one"
for n in 3:1:1; do
    job "ranks$n" $n || bad "job on ranks $n ended with $?"
    close_to "$(number "ranks$n" velocity_l2)" "$(number one velocity_l2)" 1e-6 ||
        bad "ranks $n: velocity error $(number "ranks$n" velocity_l2), one rank each: $(number one velocity_l2)"
done

# another density, and mm: the errors are numbers
job mm 1:1:1 -p fluid.rho=1000 -p 'domain.max=(1000,1000)' -p initial.U=1000 -p initial.L=1000 -p fluid.nu=5000 -p sph.dx=12.5 \
    -p 'sph.free=((300,300),(700,700))' -p coupling.overlap=100 || bad "the job in mm ended with $?"
for what in velocity_l2 velocity_linf pressure_rms pressure_l2; do
    close_to "$(number mm $what)" "$(number one $what)" 1e-6 || bad "water, mm: $what $(number mm $what), one $(number one $what)"
done

# a carried flow, windows and memory as the flow wants them: at least as good as the flow at rest
still="-p sph.dx=0.02 -p fv.cells=(16,16) -p sph.c0=18 -p time.end=0.5 -p output.every=0 -p coupling.steps=0 -p coupling.overlap=0.08"
for carried in "0.0,0.0" "0.8,0.6"; do
    # shellcheck disable=SC2086
    "$root/cases/run" taylor_green -n 1:1:1 -o "carried$carried" $still -p "initial.velocity=($carried)" >carried.txt 2>&1 ||
        bad "flow carried by ($carried) ended with $?: $(tail -n 3 carried.txt)"
done
carried=$(number carried0.8,0.6 velocity_l2)
below "$carried" 0.004 || bad "carried flow: velocity error $carried, wanted at most 0.004"
below "$carried" "$(number carried0.0,0.0 velocity_l2)" || bad "carried flow: velocity error $carried, at rest $(number carried0.0,0.0 velocity_l2)"

# a box that moves through them and across the periodic side: error; straight through, and stopped at half time and
# restarted: the same bits; other ranks
moves() { # DIR RANKS ARGS...
    d=$1 r=$2
    shift 2
    job "$d" "$r" -p output.checkpoint=0.12 -p 'sph.free=((0.45,0.3),(0.85,0.7))' -p 'sph.box_velocity=(0.6,0.4)' "$@" ||
        bad "the moving box $d ended with $?: $(tail -n 3 "$d.txt")"
}
moves whole 2:1:1
below "$(number whole velocity_l2)" 0.003 || bad "moving box: velocity error $(number whole velocity_l2), wanted at most 0.003"
for f in whole/sph_0*.h5; do :; done
outside=$(h5dump -d /position -y -w 0 "$f" | sed -n '/DATA {/,/}/p' | tr ',' '\n' | awk 'NF == 1 && $1 + 0 == $1 && ($1 < 0 || $1 > 1)' | wc -l)
[ "$outside" = 0 ] || bad "moving box: $outside coordinates of the snapshot $f are outside of the periodic domain"
moves half 2:1:1 -p time.end=0.12
moves half 2:1:1 --restart
same_bits whole half || bad "a restarted run gives other bits: $(tail -n 2 diff.txt)"
# (rounding may move a birth at its threshold by a step: 1e-4 of the error)
moves moves2 1:1:2
close_to "$(number moves2 velocity_l2)" "$(number whole velocity_l2)" 1e-3 ||
    bad "moving box on other ranks: velocity error $(number moves2 velocity_l2), wanted $(number whole velocity_l2)"

# a block on the floor of a channel with an outlet: what sph's compressible water has too much in a box at a wall must not
# drive the water downstream (it ended in the second window); the same on a block of cells
cat >step.cfg <<'CASE'
format = 1;
time:    { end = 0.5; };
fluid:   { rho = 1000.0; nu = 1e-2; };
domain:  { dim = 2; min = (0, 0); max = (3, 1); };
initial: { field = "uniform"; U = 1.0; velocity = (1, 0); };
walls:   ( { side = "x_min"; kind = "inflow"; velocity = (1, 0); }, { side = "x_max"; kind = "outflow"; },
           { side = "y_min"; kind = "no_slip"; }, { side = "y_max"; kind = "slip"; } );
bodies:  ( { name = "step"; kind = "no_slip"; points = ((1.0, 0), (1.0, 0.2), (1.2, 0.2), (1.2, 0)); } );
sph:     { dx = 0.04; free = ((0.7, 0), (1.8, 0.56)); };
fv:      { cells = (48, 16); };
output:  { snapshots = false; };
CASE
sed 's/^fv: .*/fv: {};\nblocks: ( { name = "all"; cells = (48, 16); max = (3, 1); } );/' step.cfg >step_blocks.cfg
for c in step step_blocks; do
    "$root/cases/run" $c.cfg -n 1:1:1 -o $c >$c.txt 2>&1 || bad "$c ended with $?: $(tail -n 3 $c.txt)"
    below "$(number $c overlap_velocity)" 0.15 || bad "$c: velocities $(number $c overlap_velocity) apart, wanted at most 0.15"
done
energy() { tail -n 1 "$1/fv-series.csv" | cut -d, -f3; }
close_to "$(energy step_blocks)" "$(energy step)" 0.01 || bad "step: energy $(energy step_blocks) J on a block, $(energy step) J on cells"

# weight adds rho g h to the pressure of a stream and does nothing else, wherever the outlet's pressure is meant (its
# particles were 0.9 % too dense, and the programs parted); 1000 Pa are rho U^2
cat >weight.cfg <<'CASE'
format = 1;
time:    { end = 0.3; };
fluid:   { gravity = (0, -9.81); };
domain:  { max = (4, 2); };
initial: { field = "uniform"; velocity = (1, 0); };
walls:   ( { side = "x_min"; kind = "inflow"; velocity = (1, 0); }, { side = "x_max"; kind = "outflow"; pressure = 500; },
           { side = "y_min"; }, { side = "y_max"; } );
sph:     { dx = 0.0625; box = ((0.5, 0), (3.5, 2)); };
fv:      { cells = (32, 16); };
probes:  ( { name = "in"; at = (2, 0.5); }, { name = "out"; at = (0.25, 0.5); } );
output:  { snapshots = false; };
CASE
for level in 2 3; do
    p=$(awk -v h=$level 'BEGIN { print 500 + 9810 * (h - 0.5) }')
    "$root/cases/run" weight.cfg -n 1:1:1 -o weight$level -p initial.level=$level >weight.txt 2>&1 ||
        bad "a stream with weight ended with $?: $(tail -n 3 weight.txt)"
    near "$(last weight$level/sph-series.csv 'in [')" "$p" 20 || bad "stream: sph has $(last weight$level/sph-series.csv 'in [') instead of $p Pa"
    near "$(last weight$level/fv-series.csv 'out [')" "$p" 20 || bad "stream: fv has $(last weight$level/fv-series.csv 'out [') instead of $p Pa"
    below "$(number weight$level overlap_velocity)" 0.01 || bad "stream: velocities $(number weight$level overlap_velocity) apart"
done

# a free body that the stream carries out of what fv takes from the particles ends the run, as a driven one is refused
# (before it went on through the zones, exit 0)
sed 's/^sph:/bodies: ( { name = "log"; free = true; density = 1000; points = ((1.9, 0.9), (1.9, 1.1), (2.1, 1.1), (2.1, 0.9)); } );\nsph:/' weight.cfg >carries.cfg
"$root/cases/run" carries.cfg -n 1:1:1 -o carries -p time.end=0.9 >carries.txt 2>&1
[ $? = 3 ] && grep -q 'body log leaves what fv, which has no bodies, takes from the particles' carries.txt ||
    bad "a body that leaves what fv takes from sph: $(tail -n 3 carries.txt)"

# a box that moves across rows of unequal height, between sides of the exact flow: 1.5 times the even grid's error at most
across() { # DIR ARGS...
    d=$1
    shift
    "$root/cases/run" taylor_green -n 1:1:1 -o "$d" -p 'domain.periodic=(true,false)' -p 'initial.velocity=(0.8,0.3)' -p sph.dx=0.0166667 \
        -p 'sph.free=((0.3,0.35),(0.7,0.7))' -p 'sph.box_velocity=(0.5,-0.6)' -p time.end=0.12 -p output.every=0 "$@" >"$d.txt" 2>&1 ||
        bad "the box across rows $d ended with $?: $(tail -n 3 "$d.txt")"
}
across alike
across rows -p 'fv.cells=(32,28)' -p 'fv.graded=(0.5,16)'
below "$(number_of rows/fv-summary.json velocity_l2)" "$(number_of alike/fv-summary.json velocity_l2 | awk '{ print 1.5 * $1 }')" ||
    bad "moving box across rows: velocity error of fv $(number_of rows/fv-summary.json velocity_l2), on even ones $(number_of alike/fv-summary.json velocity_l2)"

# levels of refinement go with a box that moves: 1.5 times the error without them at most
levels="-p sph.dx=0.0166667 -p sph.free=((0.25,0.25),(0.75,0.75)) -p sph.box_velocity=(0.9,-0.6) -p time.end=0.06 -p output.every=0"
{ cat "$root/cases/taylor_green/case.cfg" && echo "apr: { levels = 1; regions = ( { level = 1; min = (0.34, 0.34); max = (0.66, 0.66); follow = \"sph.box\"; } ); };"; } >levels.cfg
# shellcheck disable=SC2086
"$root/cases/run" levels.cfg -n 1:1:1 -o levels $levels >levels.txt 2>&1 || bad "levels in a moving box ended with $?: $(tail -n 3 levels.txt)"
# shellcheck disable=SC2086
"$root/cases/run" taylor_green -n 1:1:1 -o level $levels >level.txt 2>&1 || bad "the box without levels ended with $?: $(tail -n 3 level.txt)"
below "$(number levels velocity_l2)" "$(number level velocity_l2 | awk '{ print 1.5 * $1 }')" ||
    bad "levels in a moving box: velocity error $(number levels velocity_l2), without $(number level velocity_l2)"

# two boxes, each a program: the error of one
"$root/cases/run" "$root/cases/taylor_green/two_boxes.cfg" -n 1:1:1 -o two -p time.end=0.12 -p output.every=0 >two.txt 2>&1 ||
    bad "two boxes ended with $?: $(tail -n 3 two.txt)"
below "$(number two velocity_l2)" 0.0015 || bad "two boxes: velocity error $(number two velocity_l2), wanted at most 0.0015"

# water at rest, the surface through the sides of a box that moves: it stays
cat >sails.cfg <<CASE
format = 1;
time:    { end = 1.0; };
fluid:   { rho = 1.0; nu = 2.0e-3; gravity = (0, -1); };
domain:  { dim = 2; min = (0, 0); max = (4, 1.4); };
initial: { field = "rest"; U = 0.1; };
shapes:  ( { form = "below"; level = 1.0; } );
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
sph:     { dx = 0.04; c0 = 10.0; transport = "none"; box = ((1.2, 0), (2.8, 1.4)); box_velocity = (0.2, 0); };
fv:      { cells = (80, 28); };
CASE
"$root/cases/run" sails.cfg -n 1:1:1 -o sails -p output.snapshots=false >sails.txt 2>&1 || bad "moving box under a surface ended with $?: $(tail -n 3 sails.txt)"
below "$(number_of sails/fv-summary.json water_missing)" 1e-4 || bad "moving box under a surface: water missing $(number_of sails/fv-summary.json water_missing), wanted at most 1e-4"
below "$(number_of sails/sph-summary.json level_gap)" 0.05 || bad "moving box under a surface: level gap $(number_of sails/sph-summary.json level_gap) dx, wanted at most 0.05"

# fv on two blocks that overlap within the box that sph gives: error, ranks, restart
blocks() { # DIR RANKS ARGS...
    d=$1 r=$2
    shift 2
    "$root/cases/run" "$root/cases/taylor_green/blocks.cfg" -n "$r" -o "$d" -p time.end=0.12 -p output.every=0.06 \
        -p output.checkpoint=0.06 "$@" >"$d.txt" 2>&1
}
blocks blocks 1:1:1 || bad "the job on blocks ended with $?: $(tail -n 3 blocks.txt)"
below "$(number blocks velocity_l2)" 0.002 || bad "blocks: velocity error $(number blocks velocity_l2), wanted at most 0.002"
blocks blocks2 1:1:2 || bad "the job on blocks ended with $? on two ranks: $(tail -n 3 blocks2.txt)"
close_to "$(number blocks2 velocity_l2)" "$(number blocks velocity_l2)" 2e-3 ||
    bad "blocks on two ranks: velocity error $(number blocks2 velocity_l2), on one: $(number blocks velocity_l2)"
blocks blocks_half 1:1:1 -p time.end=0.06 || bad "half a job on blocks ended with $?"
blocks blocks_half 1:1:1 --restart || bad "restart on blocks ended with $?: $(tail -n 3 blocks_half.txt)"
same_bits blocks blocks_half || bad "a restarted run on blocks gives other bits: $(tail -n 2 diff.txt)"

# the box moves over these blocks: 1.5 times the error on even cells at most; restart
passes="-p sph.dx=0.0166667 -p sph.free=((0.35,0.3),(0.75,0.7)) -p sph.box_velocity=(0.9,-0.6) -p initial.velocity=(0.8,0.3)"
# shellcheck disable=SC2086
"$root/cases/run" taylor_green -n 1:1:1 -o plain $passes -p 'fv.cells=(24,24)' -p time.end=0.12 -p output.every=0.06 >plain.txt 2>&1 ||
    bad "the box over even cells ended with $?: $(tail -n 3 plain.txt)"
# shellcheck disable=SC2086
blocks over 1:1:1 $passes || bad "the box that moves over blocks ended with $?: $(tail -n 3 over.txt)"
below "$(number_of over/fv-summary.json velocity_l2)" "$(number_of plain/fv-summary.json velocity_l2 | awk '{ print 1.5 * $1 }')" ||
    bad "the box over blocks: velocity error of fv $(number_of over/fv-summary.json velocity_l2), over even cells $(number_of plain/fv-summary.json velocity_l2)"
# shellcheck disable=SC2086
blocks over_half 1:1:1 $passes -p time.end=0.06 || bad "half of the way over blocks ended with $?"
# shellcheck disable=SC2086
blocks over_half 1:1:1 $passes --restart || bad "restart over blocks ended with $?: $(tail -n 3 over_half.txt)"
same_bits over over_half || bad "a restarted run over blocks gives other bits: $(tail -n 2 diff.txt)"

# a block below SPH's water, whose outline ends nowhere but at a periodic side: what it has too much leaves none of its cells
cat >below.cfg <<'END'
format = 1;
time:     { end = 0.1; };
fluid:    { rho = 1.0; nu = 1.0e-4; gravity = (0, -1); };
domain:   { dim = 2; min = (0, -1); max = (1, 0.5); periodic = (true, false); };
initial:  { field = "stokes"; U = 1.0; L = 1.0; amplitude = 0.100267614; level = 0.0; };
sph:      { dx = 0.02; c0 = 10.0; viscosity = "monaghan"; box = ((0, -0.6), (1, 0.5)); };
fv:       { tol_pressure = 1.0e-4; };
blocks:   ( { name = "deep"; cells = (20, 30); min = (0, -1); max = (1, 0.5); i_min = "periodic"; i_max = "periodic"; j_min = "slip"; j_max = "slip"; } );
coupling: { steps = 8; };
END
"$root/cases/run" below.cfg -n 1:1:1 -o below -p output.snapshots=false >below.txt 2>&1 ||
    bad "a block below SPH's water: ended with $?: $(tail -n 3 below.txt)"
left=$(tail -n 1 below/fv-series.csv | cut -d, -f5)
below "$left" 1e-4 || bad "a block below SPH's water has a divergence of $left 1/s, wanted at most 1e-4"
head -n 1 below/fv-series.csv | grep -q growth && bad "a block below SPH's water: growth is watched in a coupled job"

# a free surface above, a wall below: error, level, any number of ranks, restart
wave() { # DIR RANKS ARGS...
    d=$1 r=$2
    shift 2
    "$root/cases/run" standing_wave -n "$r" -o "$d" -p "fv.cells=(16,20)" "$@" >"$d.txt" 2>&1
    code=$?
    [ $code -le 1 ] || bad "standing wave $d ended with $code: $(tail -n 3 "$d.txt")"
}
wave wave 1:1:1 -p time.end=3
below "$(number wave velocity_l2)" 0.04 || bad "standing wave: velocity error $(number wave velocity_l2), wanted at most 0.04"
below "$(number wave mass_fluctuation)" 0.001 || bad "standing wave: mass off by $(number wave mass_fluctuation), wanted at most 0.001"
short="-p time.end=0.5 -p output.every=0.25 -p output.checkpoint=0.25"
# shellcheck disable=SC2086
{
    wave wave1 1:1:1 $short
    wave wave2 2:2:2 $short
    wave wavehalf 1:1:1 $short -p time.end=0.25
    wave wavehalf 1:1:1 $short --restart
}
close_to "$(number wave2 velocity_l2)" "$(number wave1 velocity_l2)" 1e-6 ||
    bad "standing wave on 2:2:2: velocity error $(number wave2 velocity_l2), on one rank each $(number wave1 velocity_l2)"
same_bits wave1 wavehalf || bad "standing wave: a restarted run gives other bits: $(tail -n 2 diff.txt)"
[ "$(wc -l <wave1/series.csv)" = "$(wc -l <wavehalf/series.csv)" ] || bad "standing wave: rows of series.csv lost by a restart"

# channels, which start from rest
channel() { # FIELD NU GRAVITY LID
    cat >"$1.cfg" <<CASE
format = 1;
time:    { end = 0.5; };
fluid:   { rho = 1000.0; nu = $2; gravity = ($3, 0); };
domain:  { dim = 2; min = (0, 0); max = (1, 1); periodic = (true, false); };
initial: { field = "$1"; U = 1.0; L = 1.0; };
walls:   ( { side = "y_min"; kind = "no_slip"; }, { side = "y_max"; kind = "no_slip"; velocity = ($4, 0); } );
sph:     { dx = 0.025; c0 = 10.0; box = ((0, 0), (1, 0.6)); };
fv:      { cells = (16, 32); };
CASE
    "$root/cases/run" "$1.cfg" -n 1:1:1 -o "$1" -p output.snapshots=false >"$1.txt" 2>&1 || bad "$1 ended with $?: $(tail -n 3 "$1.txt")"
    below "$(number "$1" velocity_l2)" 0.005 || bad "$1: velocity error $(number "$1" velocity_l2), wanted at most 0.005"
}
channel poiseuille 0.1 0.8 0.0
channel couette 0.1 0.0 1.0

# times of outputs that no coupling step fits: as many steps as without, and one for each output at most
for every in 0.0317 0.0071; do
    "$root/cases/run" taylor_green -n 1:1:1 -o outputs -p sph.dx=0.025 -p 'fv.cells=(16,16)' -p coupling.steps=0 -p coupling.overlap=0.08 -p time.end=0.1 \
        -p output.snapshots=false -p output.every=$every --force >outputs.txt 2>&1 || bad "outputs every $every s: ended with $?: $(tail -n 3 outputs.txt)"
    steps=$(number outputs windows)
    below "$steps" "$(awk -v e=$every 'BEGIN { print 4 + int(0.1 / e) + 1 }')" || bad "outputs every $every s: $steps coupling steps, 4 without outputs"
done

# a band that a shape sets in motion crosses SPH's box: both programs have it. The energy is that of the heat equation, 0.4051 J
cat >shear.cfg <<'CASE'
format = 1;
time:     { end = 0.5; };
fluid:    { rho = 1.0; nu = 5.0e-3; };
domain:   { dim = 2; min = (0, 0); max = (1, 1); periodic = (true, true); };
initial:  { field = "uniform"; U = 1.0; L = 1.0; velocity = (-0.5, 0.8); };
shapes:   ( { box = ((0, 0), (1, 1)); }, { box = ((0, 0.0), (1, 0.5)); velocity = (1.0, 0.0); } );
sph:      { dx = 0.02; free = ((0.25, 0.3), (0.7, 0.7)); };
CASE
sed '$a fv: { cells = (24, 24); };' shear.cfg >shear_cells.cfg
sed '$a fv: {};\nblocks: ( { name = "all"; cells = (24, 24); max = (1, 1); i_min = "periodic"; i_max = "periodic"; j_min = "periodic"; j_max = "periodic"; } );' shear.cfg >shear_blocks.cfg
for d in shear_cells shear_blocks; do
    "$root/cases/run" $d.cfg -n 1:1:1 -o $d -p output.snapshots=false >$d.txt 2>&1 || bad "$d ended with $?: $(tail -n 3 $d.txt)"
    close_to "$(tail -n 1 $d/series.csv | cut -d, -f2)" 0.4051 0.01 || bad "$d: $(tail -n 1 $d/series.csv | cut -d, -f2) J, wanted 0.4051"
    below "$(number $d overlap_velocity)" 0.15 || bad "$d: velocities $(number $d overlap_velocity) apart, wanted at most 0.15"
done

# a basin at rest: the level, the same datum of pressure in both programs
basin() { # WIDTH SHAPES
    cat <<CASE
format = 1;
time:    { end = 1.0; };
fluid:   { rho = 1000.0; nu = 1.0e-6; gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = ($1, 1.2); };
initial: { field = "rest"; U = 3.13; };
shapes:  ( $2 );
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } );
CASE
}
{
    basin 1 '{ box = ((0, 0), (1, 0.8)); }'
    printf '%s\n' 'sph: { dx = 0.025; box = ((0, 0.2), (1, 1.2)); };' 'fv: { cells = (32, 32); };'
    echo 'probes: ( { name = "level"; kind = "level"; at = (0.5, 0); }, { name = "p"; at = (0.5, 0.1); } );'
} >rest.cfg
"$root/cases/run" rest.cfg -n 1:1:1 -o rest -p time.end=0.1 >rest.txt 2>&1 || bad "basin at rest ended with $?: $(tail -n 3 rest.txt)"
column() { awk -F, -v c="$2" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == c) n = i } END { print n ? $n : "" }' "$1"; }
close_to "$(column rest/sph-series.csv 'level [m]')" 0.8 0.002 || bad "basin at rest: level $(column rest/sph-series.csv 'level [m]') m, wanted 0.8"
close_to "$(column rest/fv-series.csv 'p [Pa]')" 6867 0.005 || bad "basin at rest: fv has $(column rest/fv-series.csv 'p [Pa]') Pa 0.1 m above the floor, wanted 6867"
grep -q '"overlap_pressure"' rest/sph-summary.json || bad "basin at rest: no watch of the overlap in the summary"

# a wide flat basin of much added mass below a dam: stable as chosen, stopped in time where the memory is too short
{
    basin 2 '{ box = ((0, 0), (0.6, 0.7)); }, { box = ((0.6, 0), (2, 0.6)); }'
    printf '%s\n' 'sph: { dx = 0.02; box = ((0, 0.1), (2, 1.2)); };' 'fv: { cells = (64, 40); };'
} >flat.cfg
"$root/cases/run" flat.cfg -n 1:1:1 -o flat -p time.end=0.3 >flat.txt 2>&1 || bad "flat basin ended with $?: $(tail -n 3 flat.txt)"
below "$(number_of flat/sph-summary.json overlap_pressure)" 0.1 || bad "flat basin: pressures differ by $(number_of flat/sph-summary.json overlap_pressure) rho g H, wanted at most 0.1"
"$root/cases/run" flat.cfg -n 1:1:1 -o torn -p time.end=0.5 -p coupling.steps=6 -p coupling.memory=8 >torn.txt 2>&1
code=$?
[ $code = 3 ] || bad "pressures that drift apart ended with $code, wanted 3: $(tail -n 3 torn.txt)"
grep -q 'pressures of sph and fv where both are free' torn.txt || bad "pressures that drift apart: not said"
grep -q 'likely .*set coupling.steps and coupling.memory to 0' torn.txt || bad "pressures that drift apart: no remedy"
awk -F, 'END { exit !($1 < 0.4) }' torn/sph-series.csv || bad "pressures that drift apart: seen late"

# the same ended before it is stopped: not a sound run, whatever the case accepts
"$root/cases/run" flat.cfg -n 1:1:1 -o part -p time.end=0.28 -p coupling.steps=6 -p coupling.memory=8 >part.txt 2>&1
code=$?
[ $code = 1 ] || bad "pressures apart at the end: exit $code, wanted 1: $(tail -n 3 part.txt)"
grep -q 'NOT ACCEPTED .*not sound at the end: pressures of sph and fv' part.txt || bad "pressures apart at the end: not said"
grep -q '"accepted": true' part/summary.json && bad "pressures apart at the end: accepted"

# a stream set in motion at once past a plate; the box spans it, so that all beyond can swing as a whole
cat >plate.cfg <<'CASE'
format = 1;
time:    { end = 0.4; };
fluid:   { rho = 1.0; nu = 1.0e-2; };
domain:  { dim = 2; min = (0, 0); max = (2, 1); periodic = (true, true); };
initial: { field = "uniform"; U = 1.0; velocity = (1, 0); };
bodies:  ( { name = "plate"; centre = (0.9, 0.5); points = ((0.8,0.45),(0.8,0.55),(1.0,0.55),(1.0,0.45)); kind = "no_slip"; } );
sph:     { dx = 0.025; box = ((0.25, 0), (1.75, 1)); };
fv:      { cells = (48, 24); };
CASE
"$root/cases/run" plate.cfg -n 1:1:1 -o plate -p output.snapshots=false >plate.txt 2>&1 || bad "stream past a plate ended with $?: $(tail -n 3 plate.txt)"
below "$(column plate/sph-series.csv 'overlap pressure [-]')" 0.1 || bad "stream past a plate: pressures differ by $(column plate/sph-series.csv 'overlap pressure [-]') rho U^2, wanted at most 0.1"

# water that sinks to where fv looks is named, with its place, before fv's flow is wrong
{
    basin 1.2 '{ box = ((0, 0), (0.4, 0.9)); }, { box = ((0.4, 0), (1.2, 0.46)); }'
    printf '%s\n' 'sph: { dx = 0.02; box = ((0, 0.2), (1.2, 1.2)); };' 'fv: { cells = (48, 48); };' 'coupling: { overlap = 0.03; };'
} >sinks.cfg
"$root/cases/run" sinks.cfg -n 1:1:1 -o sinks -p output.snapshots=false >sinks.txt 2>&1
code=$?
[ $code = 3 ] || bad "water that sinks away ended with $code, wanted 3: $(tail -n 3 sinks.txt)"
grep -q "warning: .*cells at sph's edge that hold no particle" sinks.txt || bad "water that sinks away: cells without particles not said"
grep -q 'diverged .*free surface lies in the transition' sinks.txt || bad "water that sinks away: not named"

# three dimensions
cube() { # DIR RANKS ARGS...
    d=$1 r=$2
    shift 2
    "$root/cases/run" beltrami -n "$r" -o "$d" -p sph.dx=0.041666666666666667 -p "fv.cells=(16,16,16)" -p output.every=0 "$@" >"$d.txt" 2>&1 ||
        bad "beltrami $d ended with $?: $(tail -n 3 "$d.txt")"
}
cube cube 1:1:1 -p time.end=0.1
below "$(number cube velocity_l2)" 0.002 || bad "beltrami: velocity error $(number cube velocity_l2), wanted at most 0.002"
below "$(number cube mass_fluctuation)" 0.005 || bad "beltrami: mass off by $(number cube mass_fluctuation), wanted at most 0.005"
cube cube1 1:1:1 -p time.end=0.02
cube cube2 2:2:2 -p time.end=0.02
close_to "$(number cube2 velocity_l2)" "$(number cube1 velocity_l2)" 1e-6 ||
    bad "beltrami on 2:2:2: velocity error $(number cube2 velocity_l2), on one rank each $(number cube1 velocity_l2)"

# a free surface in three dimensions, slip sides
crossed() { # DIR RANKS ARGS...
    d=$1 r=$2
    shift 2
    "$root/cases/run" standing_wave_3d -n "$r" -o "$d" -p "fv.cells=(16,10,16)" -p output.every=0 "$@" >"$d.txt" 2>&1
    code=$?
    [ $code -le 1 ] || bad "standing wave in 3D $d ended with $code: $(tail -n 3 "$d.txt")"
}
crossed crossed 1:1:1 -p time.end=0.6
below "$(number crossed velocity_l2)" 0.08 || bad "standing wave in 3D: velocity error $(number crossed velocity_l2), wanted at most 0.08"
below "$(number crossed mass_fluctuation)" 0.001 || bad "standing wave in 3D: mass off by $(number crossed mass_fluctuation), wanted at most 0.001"

# until the job NAME has written its first progress line, 50 s at most
under_way() {
    for tenth in $(seq 500); do grep -q ' %  left' "$1.txt" && return || sleep 0.1; done
}
# an orderly stop: TERM to the launcher
"$root/cases/run" taylor_green -n 1:1:1 -o stop -p sph.dx=0.0125 -p "fv.cells=(24,24)" >stop.txt 2>&1 &
job=$!
under_way stop
kill -TERM $job
wait $job
code=$?
[ $code = 5 ] || bad "orderly stop ended with $code, wanted 5: $(tail -n 3 stop.txt)"
[ -f stop/checkpoint.txt ] || bad "orderly stop left no restart file"
grep -q stopped stop/summary.json || bad "orderly stop: no status in summary.json"

# a killed partner in each role: the others end long before the patience (within 5 s on a quiet machine) and say so
for role in sph coupler fv; do
    "$root/cases/run" taylor_green -n 1:1:1 -o "kill$role" -p sph.dx=0.0125 -p "fv.cells=(24,24)" >"kill$role.txt" 2>&1 &
    job=$!
    under_way "kill$role"
    pid=$(pgrep -f "$b/$role .*kill$role" | while read -r p; do [ "$(readlink /proc/$p/exe)" = "$(readlink -f "$b/$role")" ] && echo $p; done | head -n 1)
    start=$(date +%s%N)
    [ -n "$pid" ] && kill -KILL "$pid" || bad "no $role to kill"
    wait $job
    code=$?
    ms=$((($(date +%s%N) - start) / 1000000))
    [ $code != 0 ] || bad "killed $role: exit code 0"
    [ $ms -le 20000 ] || bad "killed $role: the job ended after $ms ms"
    grep -q -i 'launcher ends\|left no\|last heard\|killed' "kill$role.txt" || bad "killed $role: no reason: $(cat "kill$role.txt")"
done
pgrep -f "$tmp" >/dev/null && bad "processes left over: $(pgrep -af "$tmp")"
echo "coupled: $failed faults"
[ $failed = 0 ]
