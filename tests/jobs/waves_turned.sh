#!/bin/sh
# A tank with a wave zone at one end and a beach at the other, waves on a current, turned so that gravity points along each axis and
# against it, in 2D and 3D, both programs: the same levels. Waves of initial.field have gravity along -y alone: one fault says so,
# and what to do instead. SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
# at ALONG UP ACROSS: a vector of the scene whose gravity points against the axis `up' (1), or along it (-1); waves run along `along'
at() {
    awk -v l="$1" -v u="$2" -v w="$3" -v along=$along -v up=$up -v sign=$sign -v dim=$dim 'BEGIN { x[along] = l; x[up] = sign * u; if (dim == 3) x[3 - along - up] = w
        printf "(%.9g, %.9g", x[0], x[1]; if (dim == 3) printf ", %.9g", x[2]; print ")" }'
}
# n ALONG UP ACROSS: numbers of cells
n() { (sign=1 && at "$@"); }
# side along|up|across low|high
side() {
    case $1 in along) a=$along ;; up) a=$up ;; *) a=$((3 - along - up)) ;; esac
    end=$2
    [ "$1$sign" != up-1 ] || { [ "$2" = min ] && end=max || end=min; }
    echo "side = \"$(echo xyz | cut -c$((a + 1)))_$end\";"
}
# turned NAME PROGRAM: waves of 0.03 m x 1 m over 0.16 m on 0.2 m/s
turned() {
    low=0 high=0.24
    [ $sign = 1 ] || low=0.24 high=0 # of the coordinate's lower and upper end
    walls="{ $(side along min) kind = \"wave\"; }, { $(side along max) kind = \"beach\"; beach = 1.0; }, { $(side up min) }, { $(side up max) }"
    [ $dim = 2 ] || walls="$walls, { $(side across min) }, { $(side across max) }"
    case $2 in fv) keys="fv: { cells = $(n "${cells:-72}" 24 4); };" ;; sph) keys="sph: { dx = 0.02; };" ;; esac
    cat >"$1.cfg" <<EOF
format = 1;
time:    { end = $end_time; };
fluid:   { gravity = $(at 0 -9.81 0); };
domain:  { dim = $dim; min = $(at 0 $low 0); max = $(at 3 $high 0.1); };
initial: { field = "uniform"; velocity = $(at 0.2 0 0); };
shapes:  ( { form = "below"; level = 0.16; } );
walls:   ( $walls );
waves:   { height = 0.03; length = 1.0; start = 1; zone = 1.0; current = 0.2; direction = $direction; };
probes:  ( { name = "a"; kind = "level"; at = $(at 1.2 0.17 0.05); }, { name = "b"; kind = "level"; at = $(at 1.8 0.17 0.05); } );
$keys
output:  { snapshots = false; series = 5; };
EOF
}
# levels DIR: a and b of all rows but the first
levels() { awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /^[ab] /) c[++k] = i } NR > 1 { print $c[1], $c[2] }' "$1/series.csv"; }
# off DIR DIR: the largest difference of their levels, m
off() {
    levels "$1" >one.txt && levels "$2" >other.txt
    paste -d' ' one.txt other.txt | awk 'NF == 4 { n++; for (i = 1; i <= 2; i++) { d = $i - $(i + 2); if (d < 0) d = -d; if (d > most) most = d } } NF != 4 { bad = 1 } END { print (n > 5 && !bad ? most + 0 : "nan") }'
}
# Along, up, sign of up, and the direction of the waves (degrees from the first horizontal axis towards the second).
run() { # DIM PROGRAM LIMIT SCENES...
    dim=$1 program=$2 limit=$3 first=
    shift 3
    for scene; do
        along=${scene%%:*} rest=${scene#*:}
        up=${rest%%:*} rest=${rest#*:}
        sign=${rest%%:*} direction=${rest#*:}
        name=$program$dim$along$up$sign
        turned "$name" "$program"
        "$b/$program" "$name.cfg" -o "$name" >"$name.log" 2>&1 || bad "$program, gravity $(at 0 -9.81 0)" "$name.log"
        first=${first:-$name}
        most=$(off $first $name)
        echo "waves_turned: $program, ${dim}D, gravity $(at 0 -9.81 0): levels within ${most} m"
        below "$most" "$limit" || bad "$program: with gravity $(at 0 -9.81 0) levels differ by $most m"
    done
    moved=$(levels $first | awk '{ if (NR == 1 || $1 > hi) hi = $1; if (NR == 1 || $1 < lo) lo = $1 } END { print hi - lo }')
    holds "$moved > 0.005" || bad "$program: waves move the level by $moved m"
}
end_time=1.6
# 0.2 % of the amplitude
run 2 fv 3e-5 0:1:1:0 0:1:-1:0 1:0:1:0 1:0:-1:0
run 2 sph 3e-5 0:1:1:0 0:1:-1:0 1:0:1:0 1:0:-1:0
end_time=1.2 cells=48
run 3 fv 3e-5 0:1:1:0 0:2:1:0 0:2:-1:0 1:2:1:90 2:1:1:90 1:0:1:0 2:0:-1:90
# One fault for waves of initial.field, in both programs.
for field in regular solitary standing_wave stokes; do
    for g in "0, 0, -9.81" "-9.81, 0, 0" "0, 9.81, 0" "1, -9.81, 0"; do
        for program in fv sph; do
            keys='fv: { cells = (32, 24, 8); };'
            [ $program = fv ] || keys='sph: { dx = 0.1; };'
            printf '%s\n' 'format = 1;' 'time: { end = 1; };' "fluid: { gravity = ($g); };" \
                'domain: { dim = 3; max = (4, 1.5, 1); periodic = (true, false, true); };' \
                "initial: { field = \"$field\"; L = 4; amplitude = 0.1; level = 1.0; };" 'walls: ( { side = "y_min"; }, { side = "y_max"; } );' "$keys" >faulty.cfg
            "$b/$program" faulty.cfg --check >faulty.log 2>&1 && bad "$program: accepted: $field under ($g)"
            grep -q 'fluid.gravity: the waves of initial.field have gravity along -y alone: .*walls.kind' faulty.log && grep -q '^1 fault;' faulty.log ||
                bad "$program: $field under ($g): not one fault" faulty.log
        done
    done
done
echo "waves_turned: $failed faults"
[ $failed = 0 ]
