#!/bin/sh
# A restart file is read by any number of ranks: a run that was written on some and went on on others ends where the
# straight run does, but for rounding and its growth.
# SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
# ends CODE COMMAND...: with at most this exit code (1: done, not accepted, as short runs of coarse cases are)
ends() {
    most=$1
    shift
    timeout -k 5 120 "$@" >out.txt 2>&1 </dev/null
    code=$?
    [ $code -le "$most" ] && return 0
    bad "exit code $code: $*"
    tail -n 5 out.txt
    return 1
}
# agree STRAIGHT RESTARTED COLUMN TOLERANCE WHAT
agree() {
    awk -v a="$(last "$1" "$3")" -v b="$(last "$2" "$3")" -v e="$4" -v what="$5" 'BEGIN {
        d = a - b; d = d < 0 ? -d : d; s = b < 0 ? -b : b
        print what ": " d / (s > 0 ? s : 1) " relative, wanted " e
        exit !(a != "" && b != "" && a + 0 == a && s > 0 && d <= e * s) }' ||
        bad "$5: $3 is $(last "$2" "$3"), in the straight run $(last "$1" "$3")"
}
# family NAME COLUMN TOLERANCE "WRITERS" "READERS ..." END CASE ARGS...: a straight run to END on the writers, half of
# it, and the rest on each of the readers
family() {
    name=$1 column=$2 tolerance=$3 writers=$4 readers=$5 end=$6
    shift 6
    half=$(awk -v t="$end" 'BEGIN { print t / 2 }')
    every="-p output.checkpoint=$half -p output.every=$half -p output.snapshots=false"
    rm -rf "$name" "$name"-*
    # shellcheck disable=SC2086
    ends 1 "$root/cases/run" "$@" $every -n "$writers" -o "$name" -p "time.end=$end" || return
    # shellcheck disable=SC2086
    ends 1 "$root/cases/run" "$@" $every -n "$writers" -o "$name-half" -p "time.end=$half" || return
    series=series.csv
    [ -f "$name/series.csv" ] || series=fv-series.csv
    for n in $readers; do
        cp -r "$name-half" "$name-$n"
        # shellcheck disable=SC2086
        ends 1 "$root/cases/run" "$@" $every -n "$n" -o "$name-$n" -p "time.end=$end" --restart &&
            agree "$name/$series" "$name-$n/$series" "$column" "$tolerance" "$name, $writers to $n"
    done
}

cat >dam.cfg <<'END'
format = 1;
time:    { end = 0.2; };
fluid:   { rho = 1000.0; gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (1.2, 0.8); };
initial: { field = "rest"; U = 1.7; };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } );
shapes:  ( { form = "box"; box = ((0, 0), (0.6, 0.3)); } );
sph:     { dx = 0.02; c0 = 30.0; };
END

cat >channel.cfg <<'END'
format = 1;
time:    { end = 0.4; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; max = (1, 0.4); };
initial: { field = "uniform"; velocity = (0.35, 0); };
walls:   ( { side = "x_min"; kind = "inflow"; discharge = 0.07; }, { side = "x_max"; kind = "outflow"; level = 0.2; }, { side = "y_min"; } );
shapes:  ( { form = "below"; level = 0.2; } );
sph:     { dx = 0.02; c0 = 20.0; };
END

cat >column.cfg <<'END'
format = 1;
time:    { end = 0.4; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; min = (-1, 0); max = (1, 1); };
shapes:  ( { form = "box"; box = ((-0.25, 0), (0.25, 0.6)); } );
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
fv:      { cells = (40, 20); volume = "fraction"; };
END

# series.csv has 12 digits: 1e-9 leaves rounding three orders of magnitude to grow by
family dam kinetic 1e-9 2 "1 3" 0.1 dam.cfg
family channel kinetic 1e-9 2 "1 2" 0.4 channel.cfg
family sloshing kinetic 1e-9 2 "1 3" 0.2 sloshing_fv
family column kinetic 1e-9 2 "1 2 3" 0.4 column.cfg
family outflow kinetic 1e-9 2 "1 3" 0.1 "$root/cases/stress/outflow_fv.cfg"
# the default tolerance of the pressure alone moves the fifth digit of the divergence
family blocks kinetic 1e-9 2 "1 3" 0.1 taylor_green_blocks -p fv.tol_pressure=1e-11 -p fv.tol_viscous=1e-11
family coupled kinetic 1e-9 2:1:1 "1:2:2 3:1:1" 0.08 taylor_green -p sph.dx=0.0125 -p "fv.cells=(24,24)"
family wave kinetic 1e-9 2:1:1 "2:1:1 1:2:2 3:1:3" 0.5 standing_wave -p "fv.cells=(16,20)"

# regions of refinement that follow a body and the largest pressure, and cells that the surface asks for: on as many
# ranks as before to the last digit
sed 's/^sph:.*/sph: { dx = 0.025; c0 = 30.0; };/; s/end = 0.2/end = 0.03/' dam.cfg >regions.cfg
cat >>regions.cfg <<'END'
bodies: ( { name = "block"; points = ((0.2, 0.1), (0.2, 0.2), (0.3, 0.2), (0.3, 0.1)); velocity = (0.5, 0); } );
apr:    { around = 2; particles = 6e3;
          regions = ( { level = 1; shape = "body"; body = "block"; offset = 0.16; },
                      { level = 1; min = (0.3, -0.1); max = (0.6, 0.2); follow = "peak"; along = "x"; pressure = 100; } );
          criteria = ( { kind = "surface"; distance = 0; } ); };
END
family regions kinetic 1e-9 2 "1 3" 0.03 regions.cfg
family regions_same kinetic 0 1 1 0.03 regions.cfg
family regions_local kinetic 0 2 2 0.03 regions.cfg -p apr.local_steps=true

# waves of a zone: a function of place and time alone
cat >sea.cfg <<'END'
format = 1;
time:    { end = 1.0; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; max = (4.5, 0.3); };
walls:   ( { side = "x_min"; kind = "wave"; }, { side = "x_max"; kind = "beach"; }, { side = "y_min"; }, { side = "y_max"; } );
shapes:  ( { form = "below"; level = 0.2; } );
waves:   { kind = "sea"; height = 0.03; length = 1.0; start = 0; };
END
sed '$a fv: { cells = (72, 12); };' sea.cfg >sea_fv.cfg
sed '$a sph: { dx = 0.025; };' sea.cfg >sea_sph.cfg
family sea_fv 'kinetic energy' 1e-6 1 "1 2" 1.0 sea_fv.cfg
family sea_sph 'kinetic energy' 1e-3 2 "1 2" 0.4 sea_sph.cfg

# meshes: a column of water in a tank without lid, an obstacle; the restart file knows its meshes
stl "0 0 0" "1 0.4 0.6" zp >tank.stl
stl "0.62 0.13 0" "0.78 0.27 0.17" zm >block.stl
cat >meshes.cfg <<'END'
format = 1;
time:    { end = 0.1; };
fluid:   { rho = 1000.0; gravity = (0, 0, -9.81); };
domain:  { dim = 3; min = (0, 0, 0); max = (1, 0.4, 0.6); };
walls:   ( { mesh = "tank.stl"; }, { mesh = "block.stl"; flip = true; fluid_side = "outside"; } );
shapes:  ( { box = ((0, 0, 0), (0.5, 0.4, 0.3)); } );
sph:     { dx = 0.05; R_dx = 2.5; };
END
if "$b/sph" meshes.cfg --check 2>&1 | grep -q 'built without a reader'; then
    echo "note: this build has no reader of meshes: runs between them are not restarted"
else
    family meshes kinetic 1e-9 2 "1 2 3" 0.1 meshes.cfg
fi

# What restart files hold, by name. Whoever changes it, or what stands under a name, raises `meaning' of the program
# (struct program), so that files of before are refused, and writes this list anew: what "$names" has then
names=names.txt
if command -v h5dump >/dev/null; then
    for p in sph fv; do
        [ $p = sph ] && runs="dam-half regions-half channel-half" || runs="sloshing-half column-half outflow-half blocks-half"
        for run in $runs; do
            for f in "$run"/$p-checkpoint-*.h5; do
                h5dump -n 1 "$f" | awk -v p=$p '$1 == "attribute" || $1 == "dataset" { print p, $1, $2 }'
            done
            h5dump -a /meaning "$f" | sed -n "s/^ *(0): */$p meaning /p"
        done
    done | LC_ALL=C sort -u >$names
    diff "$root/tests/data/restart_names.txt" $names || bad "restart files hold other things than tests/data/restart_names.txt says"
fi

# a run of another case: what differs, and from what
refuses() { # SAYS ARGS...
    says=$1
    shift
    "$root/cases/run" "$@" --restart >out.txt 2>&1 && bad "went on: $*"
    grep -q "$says" out.txt || { bad "lacks: $says"; tail -n 5 out.txt; }
}
refuses 'sph.dx = 0.02.* in the file, 0.04.* here' dam.cfg -o dam-half -n 1 -p sph.dx=0.04
refuses 'is of 64 x 16 x 1 cells, the case of 32 x 16 x 1' "$root/cases/stress/outflow_fv.cfg" -o outflow-half -n 1 -p "fv.cells=(32,16)"
if [ -d meshes-half ]; then
    stl "0.62 0.13 0" "0.78 0.27 0.18" zm >block.stl
    refuses 'of another mesh block: its file, or scale' meshes.cfg -o meshes-half -n 1
fi

echo "restart: $failed faults"
[ $failed = 0 ]
