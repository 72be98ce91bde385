# dam_break.sh - interFoam on cases/dam_break_fv: the front, where alpha = 0.5 in the lowest cells, as rms over the range of
# Martin & Moyce's. SPDX-License-Identifier: BSD-3-Clause
. "$HERE/foam.sh"
. "$HERE/water.sh"
missing interFoam blockMesh && exit 0
for n in 40 ${QUICK:-80}; do
    [ "$n" = 1 ] && continue
    m=$((n * 3 / 5)) dir=dam_break_interFoam_$n
    rm -rf "$dir" && mkdir "$dir" && cd "$dir" || exit 1
    control interFoam 0.175 0 0.0025
    mesh 0 0 0.2286 0.13716 "$n" "$m" 0.01 "x0 wall
x1 wall
y0 wall
y1 wall" || exit 1
    water 8.9e-7 9.81 'x0 { type slip; } x1 { type slip; } y0 { type slip; } y1 { type slip; }' '0.22 0.13 0.005'
    awk -v n="$n" -v m="$m" 'BEGIN { for (j = 0; j < m; j++) for (i = 0; i < n; i++) { # shares of the cells
        x = n / 4 - i; y = 0.1143 / 0.13716 * m - j; x = x > 1 ? 1 : x < 0 ? 0 : x; y = y > 1 ? 1 : y < 0 ? 0 : y; print x * y } }' |
        alpha 'x0 { type zeroGradient; } x1 { type zeroGradient; } y0 { type zeroGradient; } y1 { type zeroGradient; }'
    t=$(seconds interFoam) || exit 1
    for time in [0-9]*; do # 0 is as it was written here
        { [ "$time" != 0 ] && [ -f "$time/alpha.water" ]; } || continue
        values "$time/alpha.water" | head -n "$n" | awk -v n="$n" -v time="$time" '{ a[NR] = $1 }
            END { for (i = n; i > 1 && a[i] < 0.5; i--); d = i < n ? (a[i] - 0.5) / (a[i] - a[i + 1]) : 0.5
                  print time, (i - 0.5 + d) * 0.2286 / n / 0.05715 }'
    done | sort -g >front.txt
    # their clock starts 0.25 late in units of sqrt(a/2g)
    awk -F '[ ,]' -v n="$n" -v t="$t" 'NR == FNR { T[++k] = $1; Z[k] = $2; next } /^[0-9]/ {
            s = ($1 - 0.25) * 0.0539690; if (s < 0 || s > T[k]) next
            for (i = 2; i < k && T[i] < s; i++); z = Z[i - 1] + (Z[i] - Z[i - 1]) * (s - T[i - 1]) / (T[i] - T[i - 1])
            e += (z - $2) ^ 2; c++; if (!lo || $2 < lo) lo = $2; if ($2 > hi) hi = $2 }
        END { split(t, q, " "); printf "Dam-break,compare.water_up_to_x_rms,interFoam,%d,%s,%s,%.4g\n", n, q[1], q[2], sqrt(e / c) / (hi - lo) }' \
        front.txt "$HERE/../dam_break_fv/reference.csv"
    cd ..
done
