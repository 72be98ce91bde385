# Largest |p| at each gauge while the pulse passes, over rho c0 U/2, and what comes back later at the first, over what
# passed there: awk -f reflection.awk DIR/series.csv          SPDX-License-Identifier: BSD-3-Clause
BEGIN { FS = ","; p0 = 1000 * 10 * 0.02 / 2; back = 0.1 }
/^#/ { next }
!named { named = 1; for (i = 1; i <= NF; i++) for (k = 1; k <= 3; k++) if (index($i, substr("before inside behind", 7 * k - 6, 6) " ")) c[k] = i; next }
{ for (k = 1; k <= 3; k++) { v = $c[k] < 0 ? -$c[k] : $c[k] + 0; if ($1 > back && k == 1) { if (v > r) r = v } else if (v > m[k]) m[k] = v } }
END { printf "before %.4f  inside %.4f  behind %.4f  reflected %.4f\n", m[1] / p0, m[2] / p0, m[3] / p0, r / m[1] }
