#!/bin/sh
# Faulty case files and command lines: each ends with exit code 2, with the words that help, before any
# work, and leaves no folder behind. SPDX-License-Identifier: BSD-3-Clause
b=$(cd "${1:-build}" && pwd)
root=$(cd "$(dirname "$0")/.." && pwd)
tmp=$(mktemp -d "${TMPDIR:-/tmp}/bad input ü.XXXXXX") # a space and an accent on purpose
trap 'rm -rf "$tmp"' EXIT
cd "$tmp" || exit 1
passed=0
failed=0

cat >sph.cfg <<'END'
format = 1;
time:    { end = 0.01; };
fluid:   { rho = 1.0; nu = 0.005; };
domain:  { dim = 2; min = (0, 0); max = (1, 1); periodic = (true, true); };
initial: { field = "taylor_green"; U = 1.0; L = 1.0; };
sph:     { dx = 0.02; };
output:  { every = 0.01; };
END
sed 's/^sph:.*/fv: { cells = (16, 16); };/' sph.cfg >fv.cfg
sed 's/^sph:.*/sph: { dx = 0.02; box = ((0.2, 0.2), (0.8, 0.8)); };\nfv: { cells = (16, 16); };\ncoupling: { steps = 32; };/' \
    sph.cfg >coupled.cfg

# says WORDS COMMAND...: exit code 2, WORDS (each alternative of |) in the output, nothing written
says() {
    words=$1
    shift
    "$@" >out.txt 2>&1 </dev/null
    code=$?
    if [ $code = 2 ] && grep -q -- "$words" out.txt && [ ! -e out ] && [ ! -e result ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAIL: exit code $code, wanted 2 and the words: $words"
        echo "      $*"
        sed 's/^/      | /' out.txt | head -n 12
        rm -rf out result
    fi
}
# with BASE EDIT WORDS PROGRAM [ARGS]: the same on BASE.cfg edited by sed
with() {
    sed "$2" "$1.cfg" >case.cfg
    w=$3 p=$4
    shift 4
    says "$w" "$b/$p" case.cfg -o result "$@"
}

# the command line
says "no case" "$b/sph"
says "nowhere" "$b/sph" nowhere -o result
says "nowhere.cfg" "$b/fv" nowhere.cfg -o result
says "did you mean .*--restart" "$b/sph" sph.cfg --restrat -o result
says "frobnicate" "$b/coupler" coupled.cfg --frobnicate
says "-p" "$b/sph" sph.cfg -o result -p
says "sph.dx" "$b/sph" sph.cfg -o result -p sph.dx
says "command line: .*sph.dy: .*did you mean .*dx" "$b/sph" sph.cfg -o result -p sph.dy=0.1
says "command line: .*sph.dx" "$b/sph" sph.cfg -o result -p sph.dx=thick
says "command line: .*fv.cells" "$b/fv" fv.cfg -o result -p "fv.cells=(0,16)"
says "restart" "$b/sph" sph.cfg -o result --restart
says "coupled job" "$b/sph" coupled.cfg -o result
says "coupled job" "$b/fv" coupled.cfg -o result
says "no group .*fv" "$b/fv" sph.cfg -o result
says "no group .*sph" "$b/sph" fv.cfg -o result

# what libconfig reads as a syntax error
with sph 's/dx = 0.02/dx = 0.02 m/' 'case.cfg:6: .*plain' sph
with sph 's/dx = 0.02/dx = 0,02/' 'case.cfg:6: .*decimal' sph
with sph 's/true, true/yes, yes/' 'case.cfg:4: .*true' sph
with sph 's/min = (0, 0)/min = [0, 0.5]/' 'case.cfg:4: .*( )' sph
with sph 's/dx = 0.02;/dx = 0.02; dx = 0.03;/' 'case.cfg:6: .*dx' sph
with sph 's/dx = 0.02; };/dx = 0.02;/' 'not closed' sph
with sph 's/^format.*/@include "nothing.cfg"/' 'nothing.cfg' sph
with sph 's/every = 0.01/series = 3000000000/' 'case.cfg:7: .*3000000000' sph

# keys
with sph 's/dx = 0.02/dx = 0.02; shceme = "riemann"/' 'case.cfg:6: sph.shceme: .*did you mean .*scheme' sph
with sph 's/^output:/outptu:/' 'outptu: .*did you mean .*output' sph
with sph 's/dx = 0.02; //' 'sph.dx: ' sph
with sph 's/dx = 0.02/dx = "thick"/' 'case.cfg:6: sph.dx: ' sph
with sph 's/dx = 0.02/dx = -0.02/' 'case.cfg:6: sph.dx: ' sph
with sph 's/dx = 0.02/dx = 0.02; scheme = "upwind"/' 'case.cfg:6: sph.scheme: .*riemann_ale' sph
with sph 's/dim = 2/dim = 4/' 'case.cfg:4: domain.dim: ' sph
with sph 's/max = (1, 1)/max = (1, 1, 1, 1)/' 'case.cfg:4: domain.max: ' sph
with sph 's/max = (1, 1)/max = (0, 1)/' 'case.cfg:4: domain.max: ' sph
with sph 's/end = 0.01/end = -1/' 'case.cfg:2: time.end: ' sph
with sph 's/nu = 0.005/nu = -0.005/' 'case.cfg:3: fluid.nu: ' sph
with sph 's/dx = 0.02/dx = 0.03/' 'case.cfg:6: sph.dx: ' sph
with sph 's/dx = 0.02/dx = 0.5/' 'case.cfg:6: sph.dx: ' sph
with sph 's/dx = 0.02/dx = 0.02; box = ((0.2, 0.2), (0.35, 0.8))/' 'sph.box: ' sph
with fv 's/cells = (16, 16)/cells = (16, 2)/' 'fv.cells: ' fv
with fv 's/cells = (16, 16)/cells = (16, 16); graded = (0.5, 8)/' 'case.cfg:6: fv.graded: y is periodic' fv
with fv 's/cells = (16, 16)/cells = (16, 16); graded = (0.9, 6)/; s/(true, true)/(true, false)/' 'fv.graded: rows grow by' fv
with fv 's/cells = (16, 16)/cells = (16, 16); graded = (0.5, 12)/; s/(true, true)/(true, false)/' 'fv.graded: no heights' fv
with fv 's/cells = (16, 16)/cells = (16, 16); graded = (0.5, 6.5)/; s/(true, true)/(true, false)/' 'fv.graded: 6.5 is no number' fv
with fv 's/cells = (16, 16)/cells = (16, 16); cfl = 7/' 'case.cfg:6: fv.cfl: ' fv
with fv 's/cells = (16, 16)/cells = (16, 16); integrator = "euler"/' 'case.cfg:6: fv.integrator: .*rk3' fv
with coupled 's/steps = 32/steps = -1/' 'coupling.steps: ' coupler --check
with coupled 's/steps = 32/steps = 32; mapping = "nearest"/' 'coupling.mapping: .*mls' coupler --check
says "4 faults" "$b/sph" sph.cfg -o result -p sph.dx=-1 -p sph.cfll=1 -p time.end=-3 -p sph.scheme=none

# the launcher
says "no case" "$root/cases/run" nowhere
says "unknown option" "$root/cases/run" taylor_green --fast
says "SPH:COUPLER:FV" "$root/cases/run" "$tmp/coupled.cfg" -n 3
printf 'format = 1;\n' >empty.cfg
says "neither" "$root/cases/run" "$tmp/empty.cfg"

# nothing is overwritten
"$b/sph" sph.cfg -o kept >/dev/null 2>&1 || { echo "FAIL: the sound case does not run"; failed=$((failed + 1)); }
before=$(ls -l kept | cksum)
says "already" "$b/sph" sph.cfg -o kept
[ "$before" = "$(ls -l kept | cksum)" ] || { echo "FAIL: a refused run touched its folder"; failed=$((failed + 1)); }

echo "bad_input: $passed refused as wanted, $failed not"
[ $failed = 0 ]
