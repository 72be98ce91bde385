# column.awk - an upright round column as text STL, normals out:
# awk -v x=1 -v y=0.3 -v radius=0.06 -v height=0.75 -v sides=24 -f column.awk >column.stl   SPDX-License-Identifier: BSD-3-Clause
function corner(k, z) { # k-th on the circle; -1: on the axis
    return k < 0 ? x " " y " " z : x + radius * cos(k * turn) " " y + radius * sin(k * turn) " " z
}
function facet(a, b, c) {
    print " facet normal 0 0 0\n  outer loop\n   vertex " a "\n   vertex " b "\n   vertex " c "\n  endloop\n endfacet"
}
BEGIN {
    turn = 8 * atan2(1, 1) / sides
    OFMT = CONVFMT = "%.9g"
    print "solid column"
    for (k = 0; k < sides; k++) {
        n = (k + 1) % sides
        facet(corner(k, 0), corner(n, 0), corner(n, height))
        facet(corner(k, 0), corner(n, height), corner(k, height))
        facet(corner(-1, height), corner(k, height), corner(n, height))
        facet(corner(-1, 0), corner(n, 0), corner(k, 0))
    }
    print "endsolid column"
}
