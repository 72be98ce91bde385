# Drag, lift and frequency of shedding from the second half of a run: C = 2 F/(rho U^2 D), mean and half range, St = f D/U from
# the rising zeros of the lift less its mean: awk -f coefficients.awk DIR/series.csv      SPDX-License-Identifier: BSD-3-Clause
BEGIN { FS = "," }
/^#/ { next }
!named { named = 1; for (i = 1; i <= NF; i++) { if ($i ~ /^cylinder force x/) cx = i; if ($i ~ /^cylinder force y/) cy = i }; next }
{ t[++n] = $1; d[n] = 2 * $cx; l[n] = 2 * $cy }
function smooth(v, i, j, m, s) { for (j = i - 3; j <= i + 3; j++) if (j >= first && j <= n) { s += v[j]; m++ } return s / m }
END {
    for (first = 1; t[first] < t[n] / 2;) first++
    for (i = first; i <= n; i++) { sd += d[i]; sl += l[i] }
    m = n - first + 1
    for (i = first; i <= n; i++) {
        a = smooth(d, i); b = smooth(l, i) - sl / m
        if (i == first || a < da) da = a
        if (i == first || a > db) db = a
        if (i == first || b < la) la = b
        if (i == first || b > lb) lb = b
        if (i > first && old < 0 && b >= 0) { z = t[i - 1] - old * (t[i] - t[i - 1]) / (b - old); if (!k++) z0 = z; z1 = z }
        old = b
    }
    printf "C_D %.4f +- %.4f  C_L %.4f  (mean %.4f)  St %s  periods %d\n", sd / m, (db - da) / 2, (lb - la) / 2, sl / m,
        (k > 1 ? sprintf("%.4f", (k - 1) / (z1 - z0)) : "-"), (k > 1 ? k - 1 : 0)
}
