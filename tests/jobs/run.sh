#!/bin/sh
# The life of a program, with the toy solver: output times, restart, divergence, stop, refusals, exit codes.
# SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
mpi="mpirun --quiet --bind-to none --oversubscribe -np 2"
toy="$b/tests/toy"
[ -x "$b/asan/tests/toy" ] && toy="$b/asan/tests/toy"
# ends CODE COMMAND...: with this exit code; output in out.txt
ends() {
    wanted=$1
    shift
    timeout -k 5 60 "$@" >out.txt 2>&1 </dev/null
    code=$?
    [ $code = "$wanted" ] || { bad "exit code $code, wanted $wanted: $*"; head -n 20 out.txt; }
}
has() { grep -q -- "$2" "$1" || { bad "$1 lacks: $2"; head -n 20 "$1"; }; }
count() { [ "$(ls $2 2>/dev/null | wc -l)" = "$1" ] || bad "wanted $1 files $2: $(ls $2 2>/dev/null | tr '\n' ' ')"; }

mkdir swing
cat >swing/case.cfg <<'END'
format = 1;
time:   { end = 1.0; };
domain: { max = (1, 1); };
toy:    { dt = 0.007; };
output: { every = 0.3; };
accept: ( { what = "error.x_linf"; tolerance = 1e-12; } );
END

# t = 0, 0.3, 0.6, 0.9 and the end; the folder is named after the case
ends 0 "$toy" swing
count 5 'out/swing/toy_0*.h5'
has out/swing/summary.json '"status": "done"'
has out/swing/summary.json '"accepted": true'
has out/swing/summary.json '"t_end": 1,*$'
has out/swing/toy.xdmf 'Time Value="0.89999999999999991"'
[ "$(tail -n 1 out/swing/series.csv | cut -d, -f1)" = 1 ] || bad "series.csv does not reach the end"
[ "$(head -n 1 out/swing/series.csv)" = "t [s],dt [s],energy [J]" ] || bad "series.csv: header"
has out/swing/log.txt 'oscillators'
ends 0 $mpi "$toy" swing -o two
h5diff -d 1e-12 out/swing/toy_000004.h5 two/toy_000004.h5 >/dev/null || bad "two ranks give another result"
ends 0 "$toy" swing --check -o checked
[ ! -e checked ] || bad "--check wrote something"

# cpu_s counts all from main() on, as the shell does but for loading the program; wall_s the start, too
times >t0
ends 0 "$toy" swing -o counted -p output.snapshots=false
times >t1
real() { sed -n "s/^  \"$2\": *\([-0-9.e]*\).*/\1/p" "$1"; }
awk -v cpu="$(real counted/summary.json cpu_s)" -v wall="$(real counted/summary.json wall_s)" \
    -v start="$(real counted/summary.json start_s)" '
    { split($1, u, /[ms]/); split($2, s, /[ms]/); t[FILENAME] = 60 * (u[1] + s[1]) + u[2] + s[2] }
    END { spent = t["t1"] - t["t0"]; print "cpu_s " cpu " of " spent ", wall_s " wall ", start_s " start
          exit !(cpu > 0.4 * spent && cpu < spent + 0.03 && start > 0 && start < wall) }' t0 t1 >counts.txt ||
    bad "what a run costs: $(cat counts.txt)"

# tolerances, refusals, --force, and what --force must leave alone
sed 's/1e-12/-1/' swing/case.cfg >strict.cfg
ends 1 "$toy" strict.cfg -p output.snapshots=false
has out/strict/summary.json '"accepted": false'
count 0 'out/strict/*.h5'
cat >film.cfg <<'END'
format = 1;
time:    { end = 0.8; };
fluid:   { nu = 1e-06; gravity = (2, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (1, 1); };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
shapes:  ( { form = "box"; box = ((-1, -1), (2, 0.02)); } );
fv:      { cells = (32, 32); };
output:  { snapshots = false; };
END
ends 1 "$b/fv" film.cfg # the level set loses a film thinner than a cell: done, but not accepted
has out.txt 'NOT ACCEPTED'
has out/film/summary.json '"not_accepted": "'
ends 2 "$toy" swing
has out.txt 'already'
touch out/swing/toy.c out/swing/toy_io.c out/swing/toy.cfg
ends 0 "$toy" swing --force
count 3 'out/swing/toy.c out/swing/toy_io.c out/swing/toy.cfg'
count 5 'out/swing/toy_0*.h5'
ends 2 "$toy" swing --restart -o nothing
ends 2 "$toy" swing -p toy.slwo=1
has out.txt 'did you mean .slow'
ends 0 "$toy" --help dt
has out.txt 'time step'
ends 0 "$toy" --help tooy
has out.txt 'did you mean .toy'

# straight through, and in two parts: the same bits, rows and times
for n in 1 2 3; do
    run="mpirun --quiet --bind-to none --oversubscribe -np $n $toy"
    ends 0 $run swing -o "whole$n" -p output.checkpoint=0.45
    ends 0 $run swing -o "parts$n" -p output.checkpoint=0.45 -p time.end=0.93
    count 2 "parts$n/toy-checkpoint-*.h5"
    ends 0 $run swing -o "parts$n" -p output.checkpoint=0.45 --restart
    h5diff "whole$n/toy_000004.h5" "parts$n/toy_000004.h5" >diff.txt 2>&1 || bad "restart gives other bits: $(cat diff.txt)"
    cmp -s "whole$n/series.csv" "parts$n/series.csv" || bad "restart gives another series.csv"
    cmp -s "whole$n/toy.xdmf" "parts$n/toy.xdmf" || bad "restart gives another toy.xdmf"
done

# a restart file is read by any number of ranks; one of another case is refused with the key that differs
for n in 1 3; do
    run="mpirun --quiet --bind-to none --oversubscribe -np $n $toy"
    ends 0 $mpi "$toy" swing -o "moved$n" -p output.checkpoint=0.45 -p time.end=0.93
    ends 0 $run swing -o "moved$n" -p output.checkpoint=0.45 --restart
    h5diff "whole$n/toy_000004.h5" "moved$n/toy_000004.h5" >diff.txt 2>&1 || bad "restart from 2 to $n ranks: $(cat diff.txt)"
done
ends 2 "$toy" swing -o moved1 --restart -p toy.n=11
has out.txt 'the case differs: toy.n = 10 in the file, 11 here'

# a restart file of a time after the end; a folder in which a run is at work, which --force spares
ends 2 "$toy" swing -o parts1 --restart -p time.end=0.1
has out.txt 'stands at t = .* after time.end = 0.1 s'
"$toy" swing -o busy -p time.end=1e6 -p output.every=1e6 -p toy.dt=1e-5 >busy.txt 2>&1 &
busy=$!
for tenth in $(seq 300); do [ -e busy/log.txt ] || sleep 0.1; done
ends 2 "$toy" swing -o busy --force
has out.txt 'a run of toy is at work in busy'
kill "$busy"
wait "$busy"
ends 0 "$toy" swing -o busy --force

# a restart file that is cut short or has another bit is refused; without it, one can go on from an earlier one
ends 0 "$toy" swing -o hurt -p output.checkpoint=0.45 -p time.end=0.93
file=hurt/$(sed -n 's/^toy //p' hurt/checkpoint.txt)
cp "$file" whole.h5
printf X | dd of="$file" bs=1 seek=2100 conv=notrunc 2>/dev/null
ends 2 "$toy" swing -o hurt --restart
has out.txt 'is damaged: cut short, or a bit of it has changed'
head -c 3000 whole.h5 >"$file"
ends 2 "$toy" swing -o hurt --restart
has out.txt 'is damaged'
cp whole.h5 "$file"
ends 0 "$toy" swing -o hurt --restart -p output.checkpoint=0.02
count 2 'hurt/toy-checkpoint-*.h5'

# a disk that takes no more: one sentence, code 2, what was complete stays
mkdir small # a disk of its own
small="unshare -rm sh -c 'mount -t tmpfs -o size=24k tmpfs small && \"\$@\"' small"
if eval "$small true" 2>/dev/null; then
    for n in 1 2; do
        eval "timeout 60 $small ${mpi%2}$n \$b/tests/toy swing -o small/out" >full.txt 2>&1
        [ $? = 2 ] || bad "full disk on $n ranks: not code 2"
        has full.txt 'cannot write small/out/.*: the disk is full; restart files that were complete'
    done
else
    echo "note: no disk of one's own can be made here; the full disk is not tested"
fi

# divergence: a reason, a place, a last snapshot
ends 3 $mpi "$toy" swing -o ill -p toy.bad=20
has out.txt 'diverged at t = 0.13.* step 20: oscillator 9 is tired'
has out.txt 'where *rank 1'
has ill/summary.json '"status": "diverged"'
count 1 'ill/toy_diverged.h5'
has ill/toy.xdmf toy_diverged.h5

# an orderly stop, by each signal, right behind the first file, also in slow steps; then on to the end
for s in INT TERM USR1; do
    "$toy" swing -o "stop$s" -p toy.slow=1 -p toy.dt=0.05 -p output.every=0 >out.txt 2>&1 &
    job=$!
    until [ -f "stop$s/series.csv" ] || ! kill -0 $job 2>/dev/null; do :; done
    kill -$s $job
    wait $job
    code=$?
    [ $code = 5 ] || { bad "SIG$s ended with $code, wanted 5"; cat out.txt; }
    has "stop$s/summary.json" '"status": "stopped"'
    ends 0 "$toy" swing -o "stop$s" -p output.every=0 --restart
    [ "$(grep -o 'toy_[0-9]*.h5:/position' "stop$s/toy.xdmf" | sort | uniq -d)" = "" ] || bad "SIG$s: a file twice in toy.xdmf"
done

# a fault of the program is named
timeout 60 $mpi "$toy" swing -o fault -p toy.fault=5 >out.txt 2>&1 && bad "a segmentation fault ended with 0"
has out.txt 'toy rank .: segmentation fault'

echo "run: $failed faults"
[ $failed = 0 ]
