# standing_wave.sh - interFoam on cases/standing_wave_fv over two periods: period of the level at x = 0, by its crossings of
# the mean, and damping by its extrema, against the linear viscous theory. SPDX-License-Identifier: BSD-3-Clause
. "$HERE/foam.sh"
. "$HERE/water.sh"
missing interFoam blockMesh && exit 0
for n in 64 ${QUICK:-128}; do
    [ "$n" = 1 ] && continue
    m=$((n * 5 / 8)) dir=standing_wave_interFoam_$n
    rm -rf "$dir" && mkdir "$dir" && cd "$dir" || exit 1
    control interFoam 12 0 0.1
    mesh 0 0 4 1.25 "$n" "$m" 0.1 "x0 cyclic x1
x1 cyclic x0
y0 wall
y1 wall" || exit 1
    water 2e-3 1 'x0 { type cyclic; } x1 { type cyclic; } y0 { type fixedValue; value uniform (0 0 0); } y1 { type slip; }' '2 1.24 0.05'
    awk -v n="$n" -v m="$m" 'BEGIN { pi = atan2(0, -1); for (j = 0; j < m; j++) for (i = 0; i < n; i++) {
        y = (1 + 0.01 * cos(2 * pi * (i + 0.5) / n)) * m / 1.25 - j; print (y > 1 ? 1 : y < 0 ? 0 : y) } }' |
        alpha 'x0 { type cyclic; } x1 { type cyclic; } y0 { type zeroGradient; } y1 { type zeroGradient; }'
    t=$(seconds interFoam) || exit 1
    for time in [0-9]*; do # 0 is as it was written here
        [ "$time" != 0 ] && [ -f "$time/alpha.water" ] && values "$time/alpha.water" | awk -v n="$n" -v m="$m" -v time="$time" '(NR - 1) % n == 0 { s += $1 } END { print time, s * 1.25 / m - 1 }'
    done | sort -g >level.txt
    awk -v n="$n" -v t="$t" '{ T[NR] = $1; Z[NR] = $2 } END {
            for (i = 2; i <= NR; i++) if ((Z[i] > 0) != (Z[i - 1] > 0)) c[++k] = T[i - 1] + (T[i] - T[i - 1]) * Z[i - 1] / (Z[i - 1] - Z[i])
            for (i = 2; i < NR; i++) if (Z[i] < 0 && Z[i] <= Z[i - 1] && Z[i] < Z[i + 1]) { at[++b] = T[i]; low[b] = -Z[i] }
            period = 2 * (c[k] - c[1]) / (k - 1); rate = log(low[1] / low[b]) / (at[b] - at[1])
            e = period / 5.25706 - 1; f = rate / 0.01463 - 1; split(t, q, " ")
            printf "Standing-wave,error.period,interFoam,%d,%s,%s,%.4g\n", n, q[1], q[2], e < 0 ? -e : e
            printf "Standing-wave,error.damping,interFoam,%d,%s,%s,%.4g\n", n, q[1], q[2], f < 0 ? -f : f }' level.txt
    cd ..
done
