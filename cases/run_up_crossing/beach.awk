# beach.awk - vertices of FV's block for beach.cfg, as a Plot3D file: 840 x 18 cells over a flat bottom and a slope of
# 1:19.85 that rises from x = 50. SPDX-License-Identifier: BSD-3-Clause
function bed(x) { return x < 50 ? 0 : (x - 50) * 1.712846 / 34 }
BEGIN {
    nx = 840; ny = 18
    print nx + 1, ny + 1
    for (j = 0; j <= ny; j++)
        for (i = 0; i <= nx; i++)
            print 84 * i / nx
    for (j = 0; j <= ny; j++)
        for (i = 0; i <= nx; i++)
            printf "%.9g\n", bed(84 * i / nx) + (1.8 - bed(84 * i / nx)) * j / ny
}
