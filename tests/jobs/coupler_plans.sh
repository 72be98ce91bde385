#!/bin/sh
# Every promise of cpl.h beside those of coupler.sh: three programs and more, targets of one field, times of reads, mappings,
# general cells, periods, names, extremes. Partners: mock_any.c. SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
export ASAN_OPTIONS=detect_leaks=0:handle_segv=0
mpi="timeout -k 1 60 $mpi"
bad() {
    echo "FAIL: $*"
    sed 's/^/      | /' text 2>/dev/null | tail -n 12
    failed=$((failed + 1))
}
# job KEYS "RANKS NAME WORDS" ...: the programs of a job and RANKS of the coupler ($cpl), into the folder o; sets code
cpl=1 run_coupler= again=
job() {
    printf 'format = 1;\n%s\n' "$1" >job.cfg
    shift
    [ -n "$again" ] || rm -rf o
    set -- "$cpl coupler" "$@"
    line=
    for p in "$@"; do
        # shellcheck disable=SC2086
        set -- $p
        np=$1 name=$2
        shift 2
        [ "$name" = coupler ] && line="-np $np $run_coupler $b/coupler job.cfg -o o $again" || line="$line : -np $np $b/tests/mock_any $name o $*"
    done
    # shellcheck disable=SC2086
    $mpi $line >text 2>&1
    code=$?
}
good() { [ $code = 0 ] || bad "$1: exit $code"; }
says() { grep -q -- "$1" text || bad "$2: no line like \"$1\""; }
refused() { # "what it says" "of what"
    [ $code = 2 ] || bad "$2: exit $code, wanted 2"
    says "$1" "$2"
}
got() { cat o/"$1".[0-9]* | sort | cksum; }
off() { # PROGRAM FIELD LIMIT: largest difference from the exact field
    awk -v f="$2" -v e="$3" '$1 == f && $2 == "off" { n++; if (!($3 <= e)) n = -99 } END { exit !(n > 0) }' "o/$1.sums" ||
        bad "$4: $2 of $1 is off by $(awk -v f="$2" '$1 == f && $2 == "off" { print $3 }' "o/$1.sums"), wanted at most $3"
}
sums() { # GIVER TAKER FIELD FACTOR: what was put and what was got in each window agree to rounding
    awk -v f="$3" '$1 == f { s[$2] = s[$2] " " $4; n[$2]++ }
        END { split(s["put"], a, " "); split(s["got"], b, " ")
              for (i = 1; i <= n["got"]; i++) if (!((a[i] - b[i])^2 <= (1e-13 * a[i])^2)) bad = 1
              exit bad || n["got"] < 2 }' "o/$1.sums" "o/$2.sums" ||
        bad "$4: sums of $3: $(grep "^$3 put" "o/$1.sums" | tr '\n' ' ') beside $(grep "^$3 got" "o/$2.sums" | tr '\n' ' ')"
}
two="time: { end = 0.5; }; output: { every = 0.25; };"

# three solvers, one field with four takers (two sets of one program among them), another way round, ranks of all kinds
many="put=T:a:1:1:end"
for ranks in 1:1:1:1 2:3:2:3; do
    cpl=${ranks%%:*} r=${ranks#*:} p=${r%%:*} r=${r#*:} q=${r%%:*}
    job "$two coupler: { programs = \"hot cold both\"; };" \
        "$p hot points=a:2:400:0.2 $many get=S:a:2:1:1:1" \
        "$q cold points=x:2:50:0.2 points=y:2:70:0.2 get=T:x:1:0:1:1 get=T:y:1:1:1:1" \
        "${r#*:} both points=z:2:90:0.3 points=w:2:40:0.1 get=T:z:1:1:1:1 get=T:w:1:2:1:1 put=S:z:2:1:end"
    good "three solvers on $ranks"
    off cold T 3 "three solvers" # Shepard
    [ $ranks = 1:1:1:1 ] && { hot=$(got hot) cold=$(got cold) both=$(got both); }
    [ "$(got hot) $(got cold) $(got both)" = "$hot $cold $both" ] || bad "three solvers: other bits on ranks $ranks"
done
cpl=1
grep -q '"hot": {' o/summary.json || bad "three solvers: not all in summary.json"

# least squares keep linear functions; coefficients in time are exact for the field's parabola, wherever it is read
job "$two" "1 giver points=a:2:900:0 put=T:a:3:3:start" "2 taker points=x:2:60:0.15 get=T:x:3:1:0:0.37"
good "a course in time"
off taker T 1e-11 "points, followed in time from the window's start"
job "$two" "1 giver points=a:2:900:0 put=T:a:1:3:end" "2 taker points=x:2:60:0.15 get=T:x:1:1:1:0.4"
off taker T 1e-11 "points, followed back from the window's end"
# between: a straight line; the parabola is off by (1 + x + 2 y) s (1 - s) dt^2 = 4 * 0.25 * 0.25^2 at most
job "$two" "1 giver points=a:2:900:0 put=T:a:1:1:end first=T" "2 taker points=x:2:60:0.15 get=T:x:1:1:2:0.5"
good "between"
off taker T 0.0626 "points, between"
job "$two" "1 giver grid=g:8:8 put=T:g:1:1:end first=T" "2 taker points=x:2:60:0 patch=T:x:1:0:2:0.5"
good "patch between"
off taker T 0.0626 "a patch, between"
job "$two" "2 giver grid=g:8:8 put=T:g:1:3:start" "1 taker points=x:2:60:0 patch=T:x:1:1:0:0.81"
off taker T 1e-11 "a patch, followed in time"
job "$two" "1 giver points=a:2:900:0 put=T:a:1:1:end" "1 taker points=x:2:60:0.15 get=T:x:1:1:2:0.5"
[ $code = 4 ] || bad "nothing at the start: exit $code, wanted 4"
says 'taker needs T of giver as it was at the start of coupling step 0, but giver has put none' "nothing at the start"
job "$two" "1 giver points=a:2:9:0 put=T:a:1:1:end" "1 taker points=x:2:6:2 get=T:x:1:1:1:1.5"
refused 'T: t = 0.375 s is not in the coupling step 0 .. 0.25 s' "a read outside of the window"

# conservative: sums to rounding for all kinds, also where nobody is in reach, on any ranks; periodic, too
for how in 16 17 18; do
    for reach in 0.2 1e-3; do
        for ranks in 1:1:1 3:2:2; do
            cpl=${ranks%%:*} p=${ranks#*:}
            job "$two coupler: { period = (1.0, 0.0); };" \
                "${p%:*} giver points=a:2:300:0 put=F:a:2:2:end" "${p#*:} taker points=x:2:80:$reach get=F:x:2:$how:1:1"
            good "conservative $how"
            sums giver taker F "conservative $how within $reach on $ranks"
            [ $ranks = 1:1:1 ] && taker=$(got taker)
            [ "$(got taker)" = "$taker" ] || bad "conservative $how within $reach: other bits on ranks $ranks"
        done
    done
done
cpl=1
job "$two" "1 giver points=a:3:200:0 put=F:a:1:1:end" "1 taker points=x:3:40:0.3 get=F:x:1:17:1:1"
sums giver taker F "conservative in three dimensions"
# the transpose of a consistent mapping: sum of (T mapped to x) g = sum of T (g dealt out), unit by unit in test_map.c
job "$two" "1 giver grid=g:4:4 put=F:g:1:1:end" "1 taker points=x:2:8:0.2 get=F:x:1:16:1:1"
refused 'F: taker takes it conservatively, but giver gives it on a grid' "conservative from a grid"

# general cells: their volumes fill the square, means at centroids are exact for linear functions
job "$two" "2 giver cells=c:20:0 put=T:c:1:1:end" "1 taker points=x:2:60:0.2 get=T:x:1:1:1:1"
good "general cells"
off taker T 1e-11 "general cells"
job "$two" "2 giver points=a:2:500:0 put=T:a:1:1:end" "2 taker cells=c:10:0.2 get=T:c:1:1:1:1"
off taker T 1e-11 "onto general cells"

# periods: of a set, of the case
for how in "" 1; do
    job "$two coupler: { period = (${how:-0}.0, ${how:-0}.0); };" \
        "1 giver points=a:2:40:0:${how:+0} put=T:a:1:1:end" "1 taker shift=0.9 points=x:2:9:0.3${how:+:0} get=T:x:1:2:1:1"
    n=$(awk '$5 == 1' o/taker.0 | wc -l)
    [ "$how$n" = 118 ] || { [ -z "$how" ] && [ "$n" -lt 18 ]; } || bad "period '$how': $n points mapped"
done
job "$two" "1 giver points=a:2:40:0:1 put=T:a:1:1:end" "1 taker shift=0.9 points=x:2:9:0.3 get=T:x:1:2:1:1"
[ "$(awk '$5 == 1' o/taker.0 | wc -l)" = 18 ] || bad "the giver's period is not used"
job "$two" "1 giver points=a:2:40:0:1 put=T:a:1:1:end" "1 taker points=x:2:9:0.3:2 get=T:x:1:2:1:1"
refused 'a of giver has the period 1 m, x of taker 2 m' "different periods"

# a start that is not 0, windows by the case, by the shortest wish
job "time: { end = 3.0; }; coupler: { start = 2.0; window = 0.25; };" \
    "1 giver t0=2 points=a:2:900:0 put=T:a:1:1:end" "1 taker t0=2 points=x:2:9:0.15 get=T:x:1:1:1:1"
good "a late start"
off taker T 1e-10 "a late start"
grep -q '"windows": 4' o/summary.json || bad "coupler.window: $(grep windows o/summary.json)"
job "$two" "1 giver t0=1 points=a:2:9:0 put=T:a:1:1:end" "1 taker points=x:2:9:0.3 get=T:x:1:1:1:1"
refused 'giver starts at t = 1 s, but coupling step 0' "another start"
job "$two coupler: { programs = \"giver other\"; };" "1 giver points=a:2:9:0 put=T:a:1:1:end" "1 taker points=x:2:9:0.3 get=T:x:1:1:1:1"
refused 'coupler.programs names `other., but it is not in this job' "a program that is not there"
refused 'program `taker. is in this job, but not in coupler.programs' "a program too many"
job "coupler: { window = 0.1; };" "1 giver points=a:2:9:0 put=?T:a:1:1:end"
refused 'the case must have this group' "a case without an end"
job "$two giver: { anything = 1; }; nobody: { };" "1 giver points=a:2:9:0 put=?T:a:1:1:end"
refused 'nobody.*unknown group' "a group of nobody"
job "$two giver: { anything = 1; }; fluid: { anything = 2; };" "1 giver points=a:2:9:0 put=?T:a:1:1:end"
good "a case with a program's own group; a field that nobody needs"

# a restart: by the manifest, the same bits
saves="time: { end = 1.0; }; output: { every = 0.25; checkpoint = 0.5; }; coupler: { start = 0.0; };"
giver="points=a:2:90:0 put=T:a:2:2:end" taker="points=x:2:9:0.4 get=T:x:2:1:1:0.3"
job "$saves" "1 giver $giver" "2 taker $taker"
good "a job with restart points"
late=$(cat o/taker.[0-9]* | awk '$1 > 1' | sort | cksum)
grep -q '^window 3$' o/checkpoint.txt && grep -q '^taker state.bin$' o/checkpoint.txt || bad "manifest: $(cat o/checkpoint.txt)"
again="--restart"
job "$saves" "1 giver restart=1 t0=0.5 $giver" "2 taker restart=1 t0=0.5 $taker"
good "a restart"
[ "$(got taker)" = "$late" ] || bad "a restart: other bits"
again=

# plans that do not fit
job "$two" "1 giver points=a:2:9:0 put=T:a:1:1:end" "1 other points=a:2:9:0.3 put=T:a:1:1:end get=T:a:1:0:1:1"
refused 'field T: it is given 2 times' "two givers"
job "$two" "1 giver points=a:2:9:0 put=T:a:1:1:end" "1 taker points=x:2:9:0.3 get=T:x:1:7:1:1"
refused 'T: taker asks for an unknown way (7) of mapping' "an unknown mapping"
job "$two" "1 giver points=a:2:9:0 put=T:a:1:5:end" "1 taker points=x:2:9:0.3 get=T:x:1:0:1:1"
says 'T: 5 terms in time; 1 to 4 are possible' "too many terms"
job "$two" "1 giver points=a:2:9:0 put=T:a:65:1:end" "1 taker points=x:2:9:0.3 get=T:x:65:0:1:1"
says 'field T: 65 components, 1 to 64 are possible' "too many components"
job "$two" "1 giver version=2 points=a:2:9:0 put=T:a:1:1:end" "1 taker points=x:2:9:0.3 get=T:x:1:0:1:1"
[ $code = 2 ] || bad "another header: exit $code, wanted 2"
says 'compiled with cpl.h 2, but its libcpl is 3' "another header"

job "$two" "1 giver points=a:2:9:0 put=T:a:2:1:end" "1 taker points=x:2:9:0.3 get=T:x:1:0:1:1"
refused 'T: giver gives 2 components, taker takes 1' "another number of components"
job "$two" "1 giver points=a:2:9:0 put=T:a:1:1:end" "1 taker points=x:2:9:0 get=T:x:1:0:1:1"
refused 'T: x of taker has no support radius' "no support radius"
job "$two" "1 giver restart=3 points=a:2:9:0 put=T:a:1:1:end" "1 taker points=x:2:9:0.3 get=T:x:1:0:1:1"
refused 'taker starts at coupling step -1, giver at coupling step 3: restart all from one manifest' "another restart window"
job "$two" "1 giver zone=box points=a:2:9:0 put=T:a:1:1:end" "1 taker zone=box faults=2 points=x:2:9:0.3 get=T:x:1:0:1:1"
refused 'zone box is published by taker and by giver' "a zone twice"
refused 'taker: 2 faults in its input' "faults of a partner"

# every call that is wrong says so, and the job goes on
rm -rf o
printf 'format = 1;\n%s\n' "$two" >job.cfg
$mpi -np 1 "$b/tests/mock_calls" one o : -np 1 "$b/coupler" job.cfg -o o : -np 1 "$b/tests/mock_calls" two o >text 2>&1 ||
    bad "wrong calls: exit $?"

# as many programs as can be, and one more; all of their names in full
many='1 a-rather-long-name points=x:2:3:0.9 get=T:x:1:0:1:1'
i=1
while [ $i -lt 30 ]; do many="$many|1 p$i points=x:2:3:0.9 get=T:x:1:0:1:1" i=$((i + 1)); done
IFS='|'
# shellcheck disable=SC2086
set -- $many
unset IFS
job "$two" "1 giver points=a:2:9:0 put=T:a:1:1:end" "$@"
good "31 solvers, 30 takers of a field"
says '^  a-rather-long-name  .* 1$' "31 solvers"
[ "$(cat o/p*.0 | cut -d' ' -f1,2,3,4,5,6 | sort | uniq -c | awk '{ print $1 }' | sort -u)" = 29 ] || bad "31 solvers: takers got different values"
job "$two" "1 giver points=a:2:9:0 put=T:a:1:1:end" "$@" "1 more"
[ $code = 2 ] || bad "32 solvers: exit $code, wanted 2"
says 'more programs in one job than this version knows' "32 solvers"

# a list of problems that is too long says so
many=
for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
    many="$many get=a-rather-long-name-of-a-field-that-nobody-in-this-job-gives-$i:x:1:0:1:1"
done
job "$two" "1 one points=x:2:1:0.3 $many" "1 two points=x:2:1:0.3 $many" "1 three points=x:2:1:0.3 $many"
refused '^\.\.\. and more$' "a long list"

# names: the longest, and one longer
for n in 63 64; do
    long=$(printf "%${n}s" | tr ' ' n)
    short=$(printf '%63s' | tr ' ' m)
    job "$two" "1 $short points=$long:2:9:0 put=T:$long:1:1:end" "1 taker points=x:2:9:0.3 get=T:x:1:0:1:1"
    [ $n = 63 ] && good "a set of 63 bytes" || says "set .$long.: a name of 64 bytes, 63 are possible" "a long set"
    job "$two" "1 $short points=a:2:9:0 put=$long:a:1:1:end" "1 taker points=x:2:9:0.3 get=$long:x:1:0:1:1"
    [ $n = 63 ] && good "a field of 63 bytes" || says "field .$long.: a name of 64 bytes, 63 are possible" "a long field"
    job "$two" "1 $long points=a:2:9:0 put=T:a:1:1:end" "1 taker points=x:2:9:0.3 get=T:x:1:0:1:1"
    [ $n = 63 ] && good "a program of 63 bytes" || refused "cannot be the name of a program" "a long program"
    [ $n = 63 ] && { grep -q "\"$long\": {" o/summary.json || bad "a program of 63 bytes: cut in the summary"; }
done
job "$two" "1 a.b points=a:2:9:0 put=T:a:1:1:end" "1 taker points=x:2:9:0.3 get=T:x:1:0:1:1"
refused "cannot be the name of a program" "a name with a dot"

# extremes: nothing at all, one point, one cell, far outside, 16 components
for ranks in 3; do
    cpl=$ranks
    job "$two" "$ranks giver points=a:2:0:0 put=T:a:1:1:end" "$ranks taker points=x:2:0:0.3 get=T:x:1:1:1:1"
    good "no points on either side"
    for how in 0 1 2 16 17 18; do
        job "$two" "$ranks giver points=a:2:0:0 put=T:a:1:1:end" "$ranks taker points=x:2:5:0.3 get=T:x:1:$how:1:1"
        good "no givers, mapping $how"
        job "$two" "$ranks giver points=a:2:5:0 put=T:a:1:1:end" "$ranks taker points=x:2:0:0.3 get=T:x:1:$how:1:1"
        good "no takers, mapping $how"
        job "$two" "$ranks giver points=a:2:1:0 put=T:a:1:1:end" "$ranks taker points=x:2:1:0.3 get=T:x:1:$how:1:1"
        good "one point, mapping $how"
        cat o/taker.* | grep -q ' 3 0 1 ' || bad "one point, mapping $how: not mapped"
    done
    job "$two" "$ranks giver shift=5 points=a:2:5:0 put=T:a:1:1:end" "$ranks taker shift=-5 points=x:2:5:0.3 get=T:x:1:1:1:1"
    good "points far off"
    [ "$(cat o/taker.* | awk '$5 == 0 && $6 == 0' | wc -l)" = 10 ] || bad "points far off: mapped"
    job "$two" "$ranks giver grid=g:1:1 put=T:g:1:1:start" "$ranks taker shift=7 points=x:2:5:0 patch=T:x:1:1:0:0"
    good "a grid of one cell, and places outside"
    cat o/taker.* | awk '{ v[$1] = v[$1] == "" || v[$1] == $6 ? $6 : "differs" } END { for (k in v) if (v[k] == "differs" || v[k] == "0x0p+0") exit 1 }' ||
        bad "a grid of one cell: its value is not everywhere"
done
cpl=2
job "$two" "2 giver points=a:2:900:0 put=T:a:16:3:start grid=g:9:9 put=G:g:16:2:start" \
    "2 taker points=x:2:60:0.15 get=T:x:16:1:0:0.5 patch=G:x:16:1:0:0 patch=G:x:16:0:0:0"
good "16 components"
off taker T 1e-10 "16 components of points"
off taker G 1e-10 "16 components of a grid, linear and cubic"
cpl=1

# 1e5 windows of nothing: memory stays
rm -f pid
run_coupler="sh $tmp/remember"
echo 'echo $$ >pid; exec "$@"' >remember
(
    tries=0
    until [ -s pid ] || [ $tries = 1000 ]; do sleep 0.01; tries=$((tries + 1)); done
    while read -r _ kb _ <"/proc/$(cat pid)/statm"; do echo "$kb"; sleep 0.02; done 2>/dev/null >pages
) &
job "time: { end = 1.0; };" "1 one dt=1e-5 say=2000" "1 two say=2000"
wait
run_coupler=
good "1e5 windows of nothing"
grep -q '"windows": 100000' o/summary.json || bad "1e5 windows: $(grep windows o/summary.json)"
for p in one two; do
    awk '$1 == "memory" { n++; if (n == 1) a = $2; b = $2 } END { exit !(n == 2 && b - a <= 512) }' o/$p.sums ||
        bad "1e5 windows: resident kB of $p at window 2000 and the end: $(tr '\n' ' ' <o/$p.sums)"
done
# pages of the coupler, from the middle of the job on: as many readings as its run time leaves, which may be 0.3 s
awk '{ v[NR] = $1 } END { exit !(NR >= 4 && 4 * (v[NR] - v[int(NR / 2)]) <= 512) }' pages ||
    bad "1e5 windows: pages of the coupler: $(tr '\n' ' ' <pages)"

# the plain example: the same as one program with the whole wall; its error is Euler's
# shellcheck disable=SC2086
$mpi -np 1 "$b/examples/heat" left h 40 : -np 1 "$b/coupler" "$root/coupler/examples/heat.cfg" -o h --force : -np 1 "$b/examples/heat" right h 40 >text 2>&1 ||
    bad "coupler/examples/heat: exit $?"
# T decays as exp(-pi^2 t): by Taylor the scheme's rate is off by pi^4 h^2/24, at t = 0.1 by 1.2e-5 K
awk '/is off by/ { n++; if (!($(NF - 1) <= 2e-5)) n = -9 } END { exit n != 2 }' text || bad "coupler/examples/heat: error"

# python: exact.py in fv's place
python=
for p in python3 /usr/bin/python3; do
    [ -z "$python" ] && command -v $p >/dev/null && $p -c 'import mpi4py' 2>/dev/null && python=$p
done
if [ -z "$python" ]; then
    echo "skipped: coupler/python: no python3 with mpi4py (apt-get install python3-mpi4py)"
elif [ -n "$SAN_BUILD" ]; then
    echo "skipped: coupler/python: python does not run under the sanitizers"
else
    export PYTHONPATH="$root/coupler/python:$PYTHONPATH" OMP_NUM_THREADS=1
    for f in "$b"/libcpl.so.*; do export ESTRAN_LIB="$f"; done
    rm -rf o
    printf 'format = 1;\n%s\n' "$two" >job.cfg
    $mpi -np 1 $python "$root/tests/jobs/partner.py" o : -np 1 "$b/coupler" job.cfg -o o : -np 2 "$b/tests/mock_any" mock o points=a:2:900:0 grid=g:8:8 \
        points=x:2:40:0 put=T:a:1:1:end put=G:g:2:1:end patch=P:x:1:1:0:0.6 >text 2>&1 || bad "python, every call: exit $?"
    off mock P 1e-11 "what python gives"
    cp "$root/cases/taylor_green/case.cfg" exact.cfg # $root may have a space
    case="exact.cfg -o py --force -p sph.dx=0.02 -p time.end=0.24 -p output.every=0 -p output.snapshots=false"
    named='coupler.programs="sph exact"'
    # shellcheck disable=SC2086
    $mpi -np 1 "$b/sph" $case -p "$named" : -np 1 "$b/coupler" $case -p "$named" : -np 1 $python "$root/coupler/examples/exact.py" py >text 2>&1 ||
        bad "coupler/examples/exact.py: exit $?"
    # with the exact flow outside sph is no worse than the case wants of both together
    awk '/exact: velocity of sph/ { n++; if (!($(NF - 1) <= 2)) n = -9 } END { exit n != 1 }' text || bad "exact.py: error of sph"
fi
[ $failed = 0 ]
