# gerris.sh - Gerris on cases/taylor_green_fv: approximate projection, Courant 0.8. SPDX-License-Identifier: BSD-3-Clause
if ! command -v gerris2D >/dev/null || ! pkg-config --exists gerris2D; then # the second compiles its expressions
    echo "gerris2D is not installed: apt-get install gerris libgfs-dev"
    exit 0
fi
. "$HERE/foam.sh" # seconds
for level in 5 6 ${QUICK:-7}; do
    [ "$level" = 1 ] && continue
    dir=taylor_green_gerris_$level
    rm -rf "$dir" && mkdir "$dir" && cd "$dir" || exit 1
    cat >case.gfs <<END
1 2 GfsSimulation GfsBox GfsGEdge { x = 0.5 y = 0.5 } {
  Time { end = 1 }
  Refine $level
  Init {} { U = sin(2.*M_PI*x)*cos(2.*M_PI*y) V = -cos(2.*M_PI*x)*sin(2.*M_PI*y) }
  SourceViscosity 5e-3
  OutputErrorNorm { start = end } u.txt { v = U } { s = sin(2.*M_PI*x)*cos(2.*M_PI*y)*exp(-8.*M_PI*M_PI*5e-3*t) }
  OutputErrorNorm { start = end } v.txt { v = V } { s = -cos(2.*M_PI*x)*sin(2.*M_PI*y)*exp(-8.*M_PI*M_PI*5e-3*t) }
}
GfsBox {}
1 1 right
1 1 top
END
    t=$(seconds gerris2D case.gfs) || exit 1
    # rms of each component over that of the exact one, exp(-8 pi^2 nu)/2
    cat u.txt v.txt | awk -v t="$t" -v n=$((1 << level)) '{ for (i = 1; i < NF; i++) if ($i == "second:") e += $(i + 1) ^ 2 }
        END { pi = atan2(0, -1); r = 0.5 * exp(-8 * pi * pi * 5e-3); split(t, q, " ")
              printf "Taylor-Green,error.velocity_l2,gerris,%d,%s,%s,%.4g\n", n, q[1], q[2], sqrt(e / 2) / r }'
    cd ..
done
