# stl.awk - a box as a text STL file, normals out: awk -v lo="0 0 0" -v hi="1 1 1" -f stl.awk
# drop: names of faces left out, of xm xp ym yp zm zp; sense = -1: normals in.
# SPDX-License-Identifier: BSD-3-Clause
function v(i, j, k) { return (i ? H[1] : L[1]) " " (j ? H[2] : L[2]) " " (k ? H[3] : L[3]) }
function tri(a, b, c) {
    print "facet normal 0 0 0\nouter loop\nvertex " a "\nvertex " (sense < 0 ? c : b) "\nvertex " (sense < 0 ? b : c)
    print "endloop\nendfacet"
}
function quad(name, a, b, c, d) {
    if (index(drop, name))
        return
    tri(a, b, c)
    tri(a, c, d)
}
BEGIN {
    split(lo, L)
    split(hi, H)
    print "solid box"
    quad("xm", v(0,0,0), v(0,0,1), v(0,1,1), v(0,1,0))
    quad("xp", v(1,0,0), v(1,1,0), v(1,1,1), v(1,0,1))
    quad("ym", v(0,0,0), v(1,0,0), v(1,0,1), v(0,0,1))
    quad("yp", v(0,1,0), v(0,1,1), v(1,1,1), v(1,1,0))
    quad("zm", v(0,0,0), v(0,1,0), v(1,1,0), v(1,0,0))
    quad("zp", v(0,0,1), v(1,0,1), v(1,1,1), v(0,1,1))
    print "endsolid box"
}
