# taylor_green.sh - icoFoam on cases/taylor_green_fv: central differences, Crank-Nicolson, two corrections, Courant 0.2.
# SPDX-License-Identifier: BSD-3-Clause
. "$HERE/foam.sh"
missing icoFoam blockMesh && exit 0
cyclic='x0 { type cyclic; } x1 { type cyclic; } y0 { type cyclic; } y1 { type cyclic; }'
for n in 32 64 ${QUICK:-128}; do
    [ "$n" = 1 ] && continue
    dir=taylor_green_icoFoam_$n
    rm -rf "$dir" && mkdir "$dir" && cd "$dir" || exit 1
    control icoFoam 1 "$(awk -v n="$n" 'BEGIN { print 1 / (5 * n) }')" 1
    mesh 0 0 1 1 "$n" "$n" 0.1 "x0 cyclic x1
x1 cyclic x0
y0 cyclic y1
y1 cyclic y0" || exit 1
    foam dictionary transportProperties constant/transportProperties <<<'nu [0 2 -1 0 0 0 0] 5e-3;'
    foam dictionary fvSchemes system/fvSchemes <<END
ddtSchemes { default CrankNicolson 0.9; } gradSchemes { default Gauss linear; } divSchemes { default Gauss linear; }
laplacianSchemes { default Gauss linear orthogonal; } interpolationSchemes { default linear; } snGradSchemes { default orthogonal; }
END
    foam dictionary fvSolution system/fvSolution <<END
solvers { p { solver GAMG; smoother GaussSeidel; tolerance 1e-8; relTol 0.01; } pFinal { \$p; relTol 0; tolerance 1e-7; }
          U { solver smoothSolver; smoother symGaussSeidel; tolerance 1e-9; relTol 0; } }
PISO { nCorrectors 2; nNonOrthogonalCorrectors 0; pRefCell 0; pRefValue 0; }
END
    uniform p volScalarField '[0 2 -2 0 0 0 0]' 0 "$cyclic"
    { # cell averages of the exact field: sinc(pi/n) along both axes
        echo "dimensions [0 1 -1 0 0 0 0]; internalField nonuniform List<vector> $((n * n)) ("
        awk -v n="$n" 'BEGIN { pi = atan2(0, -1); s = (sin(pi / n) / (pi / n)) ^ 2
            for (j = 0; j < n; j++) for (i = 0; i < n; i++) { x = 2 * pi * (i + 0.5) / n; y = 2 * pi * (j + 0.5) / n
                printf "(%.12g %.12g 0)\n", s * sin(x) * cos(y), -s * cos(x) * sin(y) } }'
        echo "); boundaryField { $cyclic frontAndBack { type empty; } }"
    } | foam volVectorField U 0/U
    t=$(seconds icoFoam) || exit 1
    values 1/U | awk -v n="$n" -v t="$t" 'BEGIN { pi = atan2(0, -1); s = (sin(pi / n) / (pi / n)) ^ 2 * exp(-8 * pi * pi * 5e-3); split(t, q, " ") }
        { k = NR - 1; x = 2 * pi * (k % n + 0.5) / n; y = 2 * pi * (int(k / n) + 0.5) / n
          u = s * sin(x) * cos(y); v = -s * cos(x) * sin(y); e += ($1 - u) ^ 2 + ($2 - v) ^ 2; r += u * u + v * v }
        END { printf "Taylor-Green,error.velocity_l2,icoFoam,%d,%s,%s,%.4g\n", n, q[1], q[2], sqrt(e / r) }'
    cd ..
done
