#!/bin/sh
# The coupler between two mock solvers: same bits on any ranks, refused plans, dying programs, waiting.
# SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
export ASAN_OPTIONS=detect_leaks=0:handle_segv=0
mpi="timeout -k 1 30 $mpi"
mock="$b/tests/mock"
wrap= # before sph
hit=  # signal to the coupler after window 2
bad() {
    echo "FAIL: $*"
    sed 's/^/      | /' text 2>/dev/null | tail -n 12
    failed=$((failed + 1))
}
cat >case.cfg <<'CASE'
format = 1;
time: { end = 0.5; };
domain: { dim = 2; min = (0.0, 0.0); max = (1.0, 1.0); periodic = (true, true); };
output: { every = 0.25; };
sph: { dx = 0.02; };
fv: { cells = (40, 40); };
CASE
# job RANKS "sph keys" "coupler options" "fv keys": runs it, into the folder o; sets code and seconds
job() {
    rm -rf o text pid
    : >text
    a=${1%%:*} rest=${1#*:}
    p=${rest%%:*} c=${rest#*:}
    began=$(date +%s%N)
    [ -z "$hit" ] || { # 30 s at most
        for tenth in $(seq 300); do grep -q '^2 ' o/sph.0 2>/dev/null && break || sleep 0.1; done
        kill -$hit "$(cat pid)"
    } &
    # shellcheck disable=SC2086,SC2016
    $mpi -np "$a" $wrap "$mock" sph points o $2 : \
        -np "$p" sh -c 'echo $$ >pid; exec "$@"' coupler "$b/coupler" case.cfg -o o $3 : \
        -np "$c" "$mock" fv grid o $4 >text 2>&1
    code=$?
    wait
    seconds=$(awk -v a="$began" -v b="$(date +%s%N)" 'BEGIN { print (b - a) * 1e-9 }')
}
says() { grep -q -- "$1" text || bad "$2: no line like \"$1\""; }
quick() { awk -v s="$seconds" 'BEGIN { exit !(s < 20) }' || bad "$1 took $seconds s"; }
got() { cat o/"$1".* | sort -n -k1,1 -k2,2 | cksum; }

for keys in "mls=0 cubic=0" "mls=1 cubic=1" "mls=1 cubic=1 still=1"; do
    job 1:1:1 "$keys" "" "$keys"
    [ $code = 0 ] || bad "plain job ended with $code"
    sph=$(got sph) fv=$(got fv)
    for ranks in 1:2:1 1:3:1 2:1:2 1:2:3 3:3:2; do
        job $ranks "$keys" "" "$keys"
        [ $code = 0 ] || bad "job on $ranks ended with $code"
        [ "$(got sph)" = "$sph" ] || bad "$keys: sph got other bits on ranks $ranks"
        [ "$(got fv)" = "$fv" ] || bad "$keys: fv got other bits on ranks $ranks"
    done
    rm -rf o
    # shellcheck disable=SC2086
    $mpi -np 1 "$mock" fv grid o $keys : -np 2 "$b/coupler" case.cfg -o o : -np 1 "$mock" sph points o $keys \
        >text 2>&1 || bad "programs in another order: exit $?"
    [ "$(got fv)" = "$fv" ] || bad "another order of the programs: other bits"
done
grep -q '"velocity_l2": 0.001,*$' o/summary.json || bad "norms of the solvers do not add up in summary.json"

# death "of what" RANKS "sph keys" "coupler options" "fv keys" PATTERN...: the job fails within 5 s on a quiet machine, long before
# the patience everywhere, and says each PATTERN. The launcher kills all within 1 s of the first end: whom a busy machine gives
# no processor time until then says nothing, so a fault is what happens three times out of three.
death() {
    what=$1
    for again in 1 2 3; do
        job "$2" "$3" "$4" "$5"
        awk -v s="$seconds" 'BEGIN { exit !(s < 20) }' && [ $code != 0 ] && said "$@" && return
    done
    bad "$what: exit $code after $seconds s; not said: $unsaid"
}
said() {
    shift 5
    for pattern in "$@"; do
        grep -q -- "$pattern" text || { unsaid=$pattern; return 1; }
    done
}
for how in kill segv exit abort finalize; do
    death "sph, $how" 1:1:1 fault=$how "" "" '^fv rank 0: .*sph rank 0' '^coupler rank 0: .*sph rank 0'
    death "fv, $how" 1:2:2 "" "" fault=$how '^sph rank 0: .*fv rank [01]' '^coupler rank [01]: .*fv rank [01]'
done
for how in KILL SEGV ABRT; do
    hit=$how
    death "coupler, $how" 1:1:1 "fault=sleep at=3" "" "" '^sph rank 0: .*coupler rank 0' '^fv rank 0: .*coupler rank 0'
done
hit=

# who is stopped is named after the patience; who is at work for longer shows signs of life
job 1:1:1 "fault=stop patience=1" "--patience 1" "patience=1"
[ $code = 4 ] || bad "a stopped program: exit $code, wanted 4"
says 'sph rank 0 has shown no sign of life for [1-9] s' "a stopped program"
job 1:1:1 "fault=sleep patience=1" "--patience 1" "patience=1"
[ $code = 0 ] || bad "a program at work for longer than the patience: exit $code, wanted 0"

# who writes on another disk, and shows no sign there, is not taken for dead
rm -rf o elsewhere && mkdir elsewhere
# shellcheck disable=SC2086
$mpi -np 1 "$mock" sph points elsewhere fault=sleep patience=1 : -np 1 "$b/coupler" case.cfg -o o --patience 1 \
    : -np 1 "$mock" fv grid o patience=1 >text 2>&1 || bad "folders on two disks: exit $?"

# numbers that are no numbers, puts that are forgotten
job 1:1:1 fault=nan "" ""
[ $code = 2 ] || bad "NaN in a field: exit $code, wanted 2"
says 'velocity: value 0 of particles on rank 0 is not finite' "NaN in a field"
job 1:1:1 "" "" fault=forget
quick "a forgotten put"
says 'sph waits in coupling step 3 for pressure of fv, which has not been given' "a forgotten put"
job 1:1:1 fault=forget "" ""
quick "a forgotten put"
says 'fv waits for velocity, but sph has ended coupling step 2 without giving it' "a forgotten put"

# plans that do not fit are refused by all, with the whole list
job 1:2:1 unit=knots "" "unit=bar dt=-1"
[ $code = 2 ] || bad "wrong units: exit $code, wanted 2"
[ "$(grep -c 'velocity: sph gives it in knots' text)" = 3 ] || bad "wrong units: not said by all programs"
[ "$(grep -c 'pressure: fv gives it in bar' text)" = 3 ] || bad "wrong units: the list is not complete"
says 'asks for coupling steps of -1 s' "wrong window"
job 1:1:1 "unit=knots dim=3" "" ""
[ $code = 2 ] || bad "wrong unit and dimensions: exit $code, wanted 2"
[ "$(grep -c 'velocity: sph gives it in knots' text)" = 3 ] || bad "wrong unit beside wrong dimensions: not said by all programs"
[ "$(grep -c 'velocity: particles of sph has 3 dimensions, targets of fv has 2' text)" = 3 ] || bad "wrong dimensions: not said by all programs"
job 1:1:1 "unit=knots" "" "back=2"
[ $code = 2 ] || bad "wrong direction: exit $code, wanted 2"
[ "$(grep -c 'pressure: sph takes it, but nobody gives it' text)" = 3 ] || bad "wrong direction: not said by all programs"
[ "$(grep -c 'velocity: sph gives it in knots' text)" = 3 ] || bad "wrong direction: the list is not complete"
wrap="env LD_PRELOAD=$b/tests/kill_at.so KILL_AT=version" # its hello speaks another version
job 1:1:1 "" "" ""
wrap=
[ $code = 2 ] || bad "another version: exit $code, wanted 2"
quick "another version"
says 'programs of different versions' "another version"
job 1:1:1 hash=1 "" ""
[ $code = 2 ] || bad "another case: exit $code, wanted 2"
says 'sph reads another case than coupler' "another case"
job 1:1:1 "" "-p time.end=0" ""
[ $code = 2 ] || bad "a faulty case: exit $code, wanted 2"
says 'coupler: 1 fault in its input' "a faulty case"

# a program that is silent, or not there
job 1:1:1 "late=6 deadline=1" "--deadline 1" "deadline=1"
[ $code = 2 ] || bad "silent sph: exit $code, wanted 2"
quick "silent sph"
says '^coupler rank .*no message from world rank 0' "silent sph"
$mpi -np 1 "$mock" sph points o : -np 1 "$b/coupler" case.cfg -o o --force >text 2>&1
[ $? = 2 ] || bad "no fv: wanted exit 2"
says 'group fv, but no program .fv' "no fv"
$mpi -np 1 "$mock" sph points o : -np 1 "$mock" fv grid o >text 2>&1
[ $? = 2 ] || bad "no coupler: wanted exit 2"
says 'fv: no program .coupler. in this job' "no coupler"

# ends: in order on request, with a restart point; not accepted
job 1:1:1 end=1 "" ""
[ $code = 5 ] || bad "orderly end: exit $code, wanted 5"
grep -q '^window 2$' o/checkpoint.txt || bad "orderly end: no restart point"
grep -q '"stopped"' o/summary.json || bad "orderly end: not in summary.json"
[ "$(tail -n 1 o/fv.0 | cut -d' ' -f1)" = 2 ] || bad "orderly end: not after one more window"
job 1:2:1 "" "" ""
cat >>case.cfg <<'CASE'
accept: ( { what = "error.velocity_l2"; tolerance = 1e-4; } );
CASE
job 1:2:1 "" "" ""
[ $code = 1 ] || bad "not accepted: exit $code, wanted 1"

# who waits leaves the processor to others: 3 s in which sph sleeps
sed -i '/^accept/d' case.cfg
job 1:1:1 "" "" ""
cpu() { sed -n '/cpu_of/,/}/s/.*"'"$1"'": *\([0-9.eE-]*\).*/\1/p' o/summary.json; }
coupler=$(cpu coupler) fv=$(cpu fv)
job 1:1:1 fault=sleep "" ""
for p in coupler fv; do
    awk -v a="$(eval echo \$$p)" -v b="$(cpu $p)" 'BEGIN { exit !((b - a) / 3 < 0.3) }' || # of a busy machine's starts, not 1
        bad "$p waits at $(cpu $p) s of processor time in 3 s (without waiting: $(eval echo \$$p) s)"
done
[ $failed = 0 ]
