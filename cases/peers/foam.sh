# foam.sh - dictionaries of OpenFOAM cases in the plane, and their fields. To be sourced.
# SPDX-License-Identifier: BSD-3-Clause
export WM_PROJECT_DIR="${WM_PROJECT_DIR:-/usr/share/openfoam}" WM_PROJECT=OpenFOAM FOAM_SIGFPE=false

# missing PROGRAM ...: says what is not installed
missing() {
    for p in "$@"; do
        command -v "$p" >/dev/null || { echo "$p is not installed: apt-get install openfoam"; return 0; }
    done
    return 1
}
# foam CLASS OBJECT FILE: the head of a dictionary, what follows from the standard input
foam() {
    mkdir -p "$(dirname "$3")"
    { printf 'FoamFile { version 2.0; format ascii; class %s; object %s; }\n' "$1" "$2"; cat; } >"$3"
}
# mesh X0 Y0 X1 Y1 NX NY HIGH PATCHES: one layer of cells; sides are x0 x1 y0 y1, front and back are empty.
# PATCHES: lines "name type", cyclic sides with their neighbour as a third word
mesh() {
    foam dictionary blockMeshDict system/blockMeshDict <<END
convertToMeters 1;
vertices ( ($1 $2 0) ($3 $2 0) ($3 $4 0) ($1 $4 0) ($1 $2 $7) ($3 $2 $7) ($3 $4 $7) ($1 $4 $7) );
blocks ( hex (0 1 2 3 4 5 6 7) ($5 $6 1) simpleGrading (1 1 1) );
edges ();
boundary (
$(echo "$8" | awk 'BEGIN { f["x0"] = "(0 4 7 3)"; f["x1"] = "(1 2 6 5)"; f["y0"] = "(0 1 5 4)"; f["y1"] = "(3 7 6 2)" }
    NF > 1 { printf "%s { type %s; %sfaces (%s); }\n", $1, $2, (NF > 2 ? "neighbourPatch " $3 "; " : ""), f[$1] }')
frontAndBack { type empty; faces ((0 3 2 1) (4 5 6 7)); }
);
mergePatchPairs ();
END
    blockMesh >log.blockMesh 2>&1 || { tail -n 20 log.blockMesh; return 1; }
}
# control SOLVER END DT EVERY [MORE]: DT 0: by a Courant number of 0.5 (interFoam)
control() {
    foam dictionary controlDict system/controlDict <<END
application $1; startFrom startTime; startTime 0; stopAt endTime; endTime $2; deltaT $([ "$3" = 0 ] && echo 1e-4 || echo "$3");
writeControl $([ "$3" = 0 ] && echo adjustableRunTime || echo runTime); writeInterval $4; writeFormat ascii; writePrecision 10; timePrecision 8;
$([ "$3" = 0 ] && echo "adjustTimeStep yes; maxCo 0.5; maxAlphaCo 0.5; maxDeltaT 1;") ${5:-}
END
}
# uniform NAME CLASS DIMENSIONS VALUE PATCHES: a field of the start
uniform() {
    foam "$2" "$1" "0/$1" <<END
dimensions $3;
internalField uniform $4;
boundaryField { $5 frontAndBack { type empty; } }
END
}
# Values of an internal field, one a line, without brackets
values() {
    awk '/^internalField *nonuniform/ { at = NR } at && NR > at + 2 { if (/^\)/) exit; gsub(/[()]/, ""); print }' "$1"
}
# seconds COMMAND...: runs it, its output to log; seconds of processor and of wall time
seconds() {
    { time -p "$@" >log.run 2>&1; } 2>"times" || { tail -n 15 log.run >&2; return 1; }
    awk '/real/ { w = $2 } /user|sys/ { c += $2 } END { print c, w }' "times"
}
