#!/bin/sh
# Each program x signal x phase of a coupled job (kill_at.c): all programs end within 5 s, the others say who, where
# and when, or the job stops in order; what was killed while it wrote restart files goes on, bit for bit.
# SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
export OMP_NUM_THREADS=1
mpi="timeout -k 1 60 $mpi"
bad() { echo "FAIL: $*" >>"${faults:-faults}"; }
: >faults
cat >case.cfg <<'CASE'
format = 1;
time:     { end = 0.24; };
fluid:    { rho = 1.0; nu = 0.005; };
domain:   { dim = 2; min = (0, 0); max = (1, 1); periodic = (true, true); };
initial:  { field = "taylor_green"; U = 1.0; L = 1.0; };
sph:      { dx = 0.02; free = ((0.36, 0.36), (0.64, 0.64)); };
fv:       { cells = (24, 24); };
coupling: { steps = 8; overlap = 0.05; };
output:   { every = 0.12; checkpoint = 0.04; };
CASE
# job DIR VICTIM PHASE SIGNAL ARGS...: VICTIM is hit by SIGNAL at PHASE; exit code in DIR.code, all output in DIR.txt
job() {
    dir=$1 victim=$2 phase=$3 signal=$4
    shift 4
    for p in sph coupler fv; do
        if [ $p = "$victim" ]; then
            eval "$p=\"env LD_PRELOAD=$b/tests/kill_at.so KILL_AT=$phase KILL_BY=$signal $b/$p\""
        else
            eval "$p=$b/$p"
        fi
    done
    # shellcheck disable=SC2086,SC2154
    $mpi -np 1 $sph case.cfg -o "$dir" "$@" : -np 1 $coupler case.cfg -o "$dir" "$@" : \
        -np 1 $fv case.cfg -o "$dir" "$@" >"$dir.txt" 2>&1
    echo $? >"$dir.code"
    date +%s%3N >"$dir.end"
}
# how a job of VICTIM, PHASE, SIGNAL ended; its faults go to the file NAME.faults
judge() {
    victim=$1 phase=$2 signal=$3 name=$1-$2-$3
    faults=$name.faults
    : >"$faults"
    code=$(cat "$name.code")
    hit=$(sed -n 's/.*kill_at: .*, ms //p' "$name.txt" | head -n 1)
    [ -n "$hit" ] || { bad "$name: the phase was not reached, exit $code"; return; }
    ms=$(($(cat "$name.end") - hit))
    [ $ms -le 5000 ] || bad "$name: the job ended $ms ms after the signal"
    [ "$phase $signal $code" = "end 15 0" ] || [ "$phase $signal $code" = "end 2 0" ] && return # it was over
    [ "$signal" != 9 ] && [ "$code" = 5 ] && {
        grep -q 'asks for an orderly end\|stopping in order' "$name.txt" || bad "$name: stopped without a word"
        grep -q . "$name/checkpoint.txt" || bad "$name: stopped without a restart point"
        return
    }
    [ "$code" != 0 ] || bad "$name: exit code 0"
    for p in sph coupler fv; do # who, where, when
        [ $p = "$victim" ] && continue
        grep "^$p rank 0: " "$name.txt" | grep "$victim rank 0" |
            grep -q 'in coupling step [0-9]\|before the first coupling step\|last heard' ||
            bad "$name (exit $code): $p says nothing of $victim: $(grep "^$p rank" "$name.txt")"
    done
}
# The launcher kills all within 1 s of the first end: whom a busy machine gives no processor time until then says nothing.
# A fault is what happens three times out of three.
trial() {
    for again in 1 2 3; do
        rm -rf "$1-$2-$3" "$1-$2-$3".*
        job "$1-$2-$3" "$1" "$2" "$3"
        judge "$1" "$2" "$3"
        [ -s "$1-$2-$3.faults" ] || return
    done
    cat "$1-$2-$3.faults" >>faults
}

job straight none none 0
[ "$(cat straight.code)" = 0 ] || { tail -n 5 straight.txt; exit 1; }
grep 'no restart point' straight.txt >>faults # windows 3 and 4 both save
for phase in handshake exchange wait work checkpoint end; do
    for signal in 9 15 2; do
        for victim in sph coupler fv; do # side by side
            [ $phase-$victim = work-coupler ] && continue
            trial $victim $phase $signal &
        done
        wait
    done
done
for victim in sph coupler fv; do
    name=$victim-checkpoint-9
    { job $name none none 0 --restart
      [ "$(cat $name.code)" = 0 ] || bad "$name: the restart ended with $(cat $name.code): $(tail -n 2 $name.txt)"; } &
done
wait
for victim in sph coupler fv; do
    same_bits straight $victim-checkpoint-9 || bad "$victim killed at a restart file: other bits after the restart"
done
pgrep -f "$tmp" >/dev/null && bad "processes left over: $(pgrep -af "$tmp")"
cat faults
[ ! -s faults ]
