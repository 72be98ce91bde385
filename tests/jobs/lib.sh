# What the job scripts share. A script reads it first, `. "$(dirname "$0")/lib.sh"`, and then stands in a folder of
# its own: $b is the build, $root the project, $tmp that folder, $failed the number of faults so far.
# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=sh disable=SC2034
b=$(cd "${1:-build}" && pwd)
root=$(cd "$(dirname "$0")/../.." && pwd)
if [ -z "$tmp" ]; then
    tmp=${TEST_SCRATCH:-$(mktemp -d)}/$(basename "$0" .sh)
    mkdir -p "$tmp"
fi
cd "$tmp" || exit 2
export ESTRAN_BUILD="$b" OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
mpi="mpirun --quiet --bind-to none --oversubscribe --mca mpi_yield_when_idle 1 --mca btl_vader_single_copy_mechanism none"
failed=0
# bad WHAT [LOG]: one fault more, with the end of its log
bad() {
    failed=$((failed + 1))
    echo "FAIL: $1"
    [ -z "$2" ] || tail -n 6 "$2"
}
# start PROGRAM LOG ARGS...: a run of sph or fv on one rank: its exit code. One process of each program has started MPI once for
# all of them (starts.c); it ends with the script, which must not `wait' for it.
serve() {
    mkfifo "$tmp/$1.ask" "$tmp/$1.told"
    LD_PRELOAD="$b/tests/starts.so" "$b/$1" <"$tmp/$1.ask" >"$tmp/$1.told" &
}
start() {
    started=$1
    shift
    asked=$(printf '%s\t' "$PWD" "$@")
    [ -p "$tmp/$started.ask" ] || case $started in
    sph) serve sph && exec 3>"$tmp/sph.ask" 4<"$tmp/sph.told" ;;
    fv) serve fv && exec 5>"$tmp/fv.ask" 6<"$tmp/fv.told" ;;
    esac
    case $started in
    sph) printf '%s\n' "$asked" >&3 && read -r ended <&4 ;;
    fv) printf '%s\n' "$asked" >&5 && read -r ended <&6 ;;
    esac
    return "$ended"
}
# refused_by PROGRAM CASE CHANGE WORDS: the case, changed by sed, is refused by --check with these words
refused_by() {
    sed "$3" "$2" >faulty.cfg
    start "$1" faulty.log faulty.cfg --check && bad "accepted: $3"
    grep -q "$4" faulty.log || bad "$3: not told \"$4\"" faulty.log
}
# number DIR KEY: of DIR/summary.json; number_of FILE KEY; the first of that name
number() { number_of "$1/summary.json" "$2"; }
number_of() { sed -n "s/.*\"$2\": *\([-+0-9.eE]*\).*/\1/p" "$1" | head -n 1; }
# last FILE NAME: the last value of a column of a series, by the beginning of its title
last() { awk -F, -v name="$2" 'NR == 1 { for (i = 1; i <= NF; i++) if (index($i, name) == 1) c = i } END { if (c) print $c }' "$1"; }
holds() { awk "BEGIN { exit !($1) }"; }
below() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a != "" && a + 0 == a && a <= b) }'; }
# close_to VALUE WANTED RELATIVE; near VALUE WANTED ABSOLUTE
close_to() { awk -v a="$1" -v b="$2" -v e="$3" 'BEGIN { d = a - b; if (d < 0) d = -d; exit !(a != "" && b != "" && d <= e * (b < 0 ? -b : b)) }'; }
near() { awk -v v="$1" -v w="$2" -v t="$3" 'BEGIN { exit !(v != "" && v - w <= t && w - v <= t) }'; }
# same_bits DIR DIR: the last snapshots of two coupled runs hold the same values
same_bits() {
    for p in sph fv; do
        for f in "$1/$p"_[0-9]*.h5; do a=$f; done
        for f in "$2/$p"_[0-9]*.h5; do c=$f; done
        h5diff "$a" "$c" >diff.txt 2>&1 && ! grep -q 'not comparable' diff.txt || return 1 # other numbers of particles
    done
}
# stl LOW HIGH [LEFT_OUT: xm xp ym yp zm zp] [1: normals out, -1: in]: the triangles of a box
stl() { python3 "$root/tests/jobs/stl.py" "$@"; }
