# water.sh - what the cases of interFoam share: water over air (1000 to 1, water as in the case, air's nu 1.5e-5), slip
# walls, Courant 0.5. To be sourced after foam.sh. SPDX-License-Identifier: BSD-3-Clause

# water NU GRAVITY PATCHES-OF-U: dictionaries, fields but alpha.water
water() {
    foam dictionary transportProperties constant/transportProperties <<END
phases (water air);
water { transportModel Newtonian; nu $1; rho 1000; } air { transportModel Newtonian; nu 1.5e-5; rho 1; } sigma 0;
END
    foam dictionary turbulenceProperties constant/turbulenceProperties <<<'simulationType laminar;'
    foam uniformDimensionedVectorField g constant/g <<<"dimensions [0 1 -2 0 0 0 0]; value (0 -$2 0);"
    foam dictionary fvSchemes system/fvSchemes <<END
ddtSchemes { default Euler; } gradSchemes { default Gauss linear; }
divSchemes { div(rhoPhi,U) Gauss linearUpwind grad(U); div(phi,alpha) Gauss vanLeer; div(phirb,alpha) Gauss linear; div(((rho*nuEff)*dev2(T(grad(U))))) Gauss linear; }
laplacianSchemes { default Gauss linear orthogonal; } interpolationSchemes { default linear; } snGradSchemes { default orthogonal; }
END
    foam dictionary fvSolution system/fvSolution <<END
solvers {
"alpha.water.*" { nAlphaCorr 2; nAlphaSubCycles 1; cAlpha 1; MULESCorr yes; nLimiterIter 5; solver smoothSolver; smoother symGaussSeidel; tolerance 1e-8; relTol 0; }
"pcorr.*" { solver PCG; preconditioner DIC; tolerance 1e-6; relTol 0; }
p_rgh { solver GAMG; smoother DIC; tolerance 1e-8; relTol 0.01; } p_rghFinal { \$p_rgh; relTol 0; }
U { solver smoothSolver; smoother symGaussSeidel; tolerance 1e-7; relTol 0; } UFinal { \$U; } }
PIMPLE { momentumPredictor no; nOuterCorrectors 1; nCorrectors 3; nNonOrthogonalCorrectors 0; pRefPoint (${4:-0.01 0.01 0.01}); pRefValue 0; }
END
    uniform U volVectorField '[0 1 -1 0 0 0 0]' '(0 0 0)' "$3"
    fixed='{ type fixedFluxPressure; value uniform 0; }' sides=
    for p in x0 x1 y0 y1; do
        case $3 in *"$p { type cyclic"*) sides="$sides $p { type cyclic; }" ;; *) sides="$sides $p $fixed" ;; esac
    done
    uniform p_rgh volScalarField '[1 -1 -2 0 0 0 0]' 0 "$sides"
}
# alpha PATCHES: 0/alpha.water from the standard input, a value a cell
alpha() {
    list=$(cat)
    foam volScalarField alpha.water 0/alpha.water <<END
dimensions [0 0 0 0 0 0 0]; internalField nonuniform List<scalar> $(echo "$list" | wc -l) (
$list
); boundaryField { $1 frontAndBack { type empty; } }
END
}
