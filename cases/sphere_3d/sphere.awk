# sphere.awk - a sphere as PLY, 20 * 4^level triangles, normals out: awk -v radius=0.2 -v level=3 -f sphere.awk >sphere.ply
# SPDX-License-Identifier: BSD-3-Clause
function corner(x, y, z,    r) {
    r = sqrt(x * x + y * y + z * z)
    X[nv] = radius * x / r; Y[nv] = radius * y / r; Z[nv] = radius * z / r
    return nv++
}
function middle(a, b,    key) { # on the sphere; one for each edge
    key = a < b ? a " " b : b " " a
    if (!(key in mid))
        mid[key] = corner(X[a] + X[b], Y[a] + Y[b], Z[a] + Z[b])
    return mid[key]
}
function cut(a, b, c, depth,    p, q, r) {
    if (depth == 0) {
        face[nt++] = a " " b " " c
        return
    }
    p = middle(a, b); q = middle(b, c); r = middle(c, a)
    cut(a, p, r, depth - 1); cut(p, b, q, depth - 1); cut(r, q, c, depth - 1); cut(p, q, r, depth - 1)
}
BEGIN {
    nv = nt = 0
    g = (1 + sqrt(5)) / 2
    corner(-1, g, 0); corner(1, g, 0); corner(-1, -g, 0); corner(1, -g, 0)
    corner(0, -1, g); corner(0, 1, g); corner(0, -1, -g); corner(0, 1, -g)
    corner(g, 0, -1); corner(g, 0, 1); corner(-g, 0, -1); corner(-g, 0, 1)
    n = split("0 11 5 0 5 1 0 1 7 0 7 10 0 10 11 1 5 9 5 11 4 11 10 2 10 7 6 7 1 8 " \
              "3 9 4 3 4 2 3 2 6 3 6 8 3 8 9 4 9 5 2 4 11 6 2 10 8 6 7 9 8 1", f, " ")
    for (i = 1; i < n; i += 3)
        cut(f[i], f[i + 1], f[i + 2], level)
    printf "ply\nformat ascii 1.0\nelement vertex %d\nproperty double x\nproperty double y\nproperty double z\n", nv
    printf "element face %d\nproperty list uchar int vertex_indices\nend_header\n", nt
    for (i = 0; i < nv; i++)
        printf "%.10g %.10g %.10g\n", X[i], Y[i], Z[i]
    for (i = 0; i < nt; i++)
        print 3, face[i]
}
