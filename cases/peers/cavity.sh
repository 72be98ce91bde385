# cavity.sh - icoFoam on cases/cavity_fv: Re 1000 to t = 60, central differences, Courant 0.5; extrema on the centre lines
# against Botella & Peyret 1998. SPDX-License-Identifier: BSD-3-Clause
. "$HERE/foam.sh"
missing icoFoam blockMesh && exit 0
for n in 32 ${QUICK:-64}; do
    [ "$n" = 1 ] && continue
    dir=cavity_icoFoam_$n
    rm -rf "$dir" && mkdir "$dir" && cd "$dir" || exit 1
    control icoFoam 60 "$(awk -v n="$n" 'BEGIN { print 0.5 / n }')" 60
    mesh 0 0 1 1 "$n" "$n" 0.1 "x0 wall
x1 wall
y0 wall
y1 wall" || exit 1
    foam dictionary transportProperties constant/transportProperties <<<'nu [0 2 -1 0 0 0 0] 1e-3;'
    foam dictionary fvSchemes system/fvSchemes <<END
ddtSchemes { default backward; } gradSchemes { default Gauss linear; } divSchemes { default Gauss linear; }
laplacianSchemes { default Gauss linear orthogonal; } interpolationSchemes { default linear; } snGradSchemes { default orthogonal; }
END
    foam dictionary fvSolution system/fvSolution <<END
solvers { p { solver GAMG; smoother GaussSeidel; tolerance 1e-6; relTol 0.01; } pFinal { \$p; relTol 0; }
          U { solver smoothSolver; smoother symGaussSeidel; tolerance 1e-7; relTol 0; } }
PISO { nCorrectors 2; nNonOrthogonalCorrectors 0; pRefCell 0; pRefValue 0; }
END
    rest='{ type fixedValue; value uniform (0 0 0); }' slope='{ type zeroGradient; }'
    uniform p volScalarField '[0 2 -2 0 0 0 0]' 0 "x0 $slope x1 $slope y0 $slope y1 $slope"
    uniform U volVectorField '[0 1 -1 0 0 0 0]' '(0 0 0)' "x0 $rest x1 $rest y0 $rest y1 { type fixedValue; value uniform (1 0 0); }"
    t=$(seconds icoFoam) || exit 1
    # values in the middle of even counts are means of two cells; extrema by the parabola through three
    values 60/U | awk -v n="$n" -v t="$t" '
        function most(f, sign, k, b) { for (k = 1; k < n - 1; k++) if (!b || sign * f[k] > sign * f[b]) b = k
            return f[b] - (f[b + 1] - f[b - 1]) ^ 2 / (8 * (f[b + 1] - 2 * f[b] + f[b - 1])) }
        function off(x, y) { x = x / y - 1; return x < 0 ? -x : x }
        { k = NR - 1; i = k % n; j = int(k / n)
          if (i == n / 2 - 1 || i == n / 2) u[j] += $1 / 2
          if (j == n / 2 - 1 || j == n / 2) v[i] += $2 / 2 }
        END { split(t, q, " "); e = off(most(u, -1), -0.3885698); a = off(most(v, 1), 0.3769447); if (a > e) e = a
              a = off(most(v, -1), -0.5270771); if (a > e) e = a
              printf "Cavity,error.extrema,icoFoam,%d,%s,%s,%.4g\n", n, q[1], q[2], e }'
    cd ..
done
