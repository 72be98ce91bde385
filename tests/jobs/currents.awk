# currents.awk - judges waves on a current by a series.csv (-F, -v T=period): over the last ten periods of T s (-v periods=5: five;
# whole steps; trapezoid) the first harmonic of the gauges g0 to g8, 0.15 m apart (m, mean), wave length (m, slope of their phases), mean level (m), mean velocity
# `low' (m/s), mean discharge `all' (m^2/s), volume (m^2) or mass (kg). SPDX-License-Identifier: BSD-3-Clause
BEGIN { pi = atan2(0, -1) }
NR == 1 { for (i = 1; i <= NF; i++) { split($i, w, " "); if (w[1] ~ /^g[0-8]$/) c[substr(w[1], 2)] = i; if ($i ~ /^low u /) u = i; if (w[1] == "all") q = i; if ((w[1] == "volume" || w[1] == "mass") && !v) v = i }; next }
{ n++; t[n] = $1; U[n] = $u; Q[n] = $q; V[n] = $v; for (j = 0; j < 9; j++) e[n, j] = $(c[j]) }
END { from = t[n] - (periods ? periods : 10) * T
    for (k = 2; k <= n; k++) { if (t[k - 1] < from) continue
        d = t[k] - t[k - 1]; all += d; um += d * (U[k] + U[k - 1]) / 2; qm += d * (Q[k] + Q[k - 1]) / 2; vm += d * (V[k] + V[k - 1]) / 2
        for (j = 0; j < 9; j++) { m[j] += d * (e[k, j] + e[k - 1, j]) / 2
            for (s = 0; s < 2; s++) { p = 2 * pi * t[k - s] / T; re[j] += d * e[k - s, j] * cos(p); im[j] += d * e[k - s, j] * sin(p) } } }
    for (j = 0; j < 9; j++) { a += sqrt(re[j]^2 + im[j]^2) / all / 9; level += m[j] / all / 9; p = atan2(im[j], re[j])
        if (j) { step = p - last; while (step < 0) step += 2 * pi; phase += step }; last = p
        sx += j; sy += phase; sxx += j * j; sxy += j * phase }
    slope = (9 * sxy - sx * sy) / (9 * sxx - sx * sx)
    printf "%.6g %.6g %.6g %.6g %.6g %.6g\n", a, 2 * pi * 0.15 / slope, level, um / all, qm / all, vm / all }
