/* test_colour.c - heights over a surface from the share of a kernel that lattices of particles
 * fill, and shares of partly wet faces against exact areas. SPDX-License-Identifier: BSD-3-Clause
 */
#include "../test.h"

#include "../../../common/waves/colour.h"
#include "../../../coupler/mapping/map.h"
#include "../../../sph/open_boundaries/wet_faces.h"

static const double R = 6.0; /* lengths in spacings of the lattice */

static double in_plane(const double *x, const void *n)
{
    const double *g = n;
    return g[0] * x[0] + g[1] * x[1] + g[2] * x[2];
}

static const double radius = 20.0;

static double in_disc(const double *x, const void *centre)
{
    const double *c = centre;
    return hypot(x[0] - c[0], x[1] - c[1]) - radius;
}

/* Share of the kernel around y that the lattice's points below the surface fill. */
static double share(int dim, double (*phi)(const double *, const void *), const void *of,
                    const double *y)
{
    const int m = 40, deep = dim == 3 ? m : 0;
    double sum = 0.0;
    for (int k = -deep; k <= deep; k++)
        for (int j = -m; j <= m; j++)
            for (int i = -m; i <= m; i++) {
                const double x[3] = {i + 0.5, j + 0.5, deep ? k + 0.5 : 0.0};
                const double r = sqrt(pow(x[0] - y[0], 2) + pow(x[1] - y[1], 2) +
                                      (deep ? pow(x[2] - y[2], 2) : 0.0));
                if (r < R && phi(x, of) < 0.0)
                    sum += map_kernel(dim, r / R, R);
            }
    return sum;
}

/* A lattice whose rows end on the surface, as at the start of a run. */
TEST(planes_are_found_to_a_thirtieth_of_dx)
{
    double table[COLOUR_PARTS + 1];
    for (int dim = 2; dim <= 3; dim++) {
        const double up[3] = {0.0, 1.0, 0.0};
        colour_profile(dim, table);
        assert_close(colour_height(table, R, 0.5), 0.0, 1e-6);
        for (double s = -1.5; s <= 1.5; s += 0.19) {
            const double y[3] = {0.21, s, dim == 3 ? 0.4 : 0.0};
            assert_close(colour_height(table, R, share(dim, in_plane, up, y)), s, 0.03);
        }
    }
}

/* By theory 5/144 R^2/radius; over all places of the lattice, which does not fill a disc exactly.
 */
TEST(discs_look_lower_by_their_curvature)
{
    enum { PLACES = 20, ANGLES = 40 };
    double table[COLOUR_PARTS + 1], sum = 0.0;
    colour_profile(2, table);
    for (int q = 0; q < PLACES; q++) {
        const double centre[2] = {fmod(0.618 * q, 1.0), fmod(0.414 * q, 1.0)};
        double cells = 0.0;
        for (int j = -24; j < 24; j++)
            for (int i = -24; i < 24; i++)
                cells += in_disc((const double[]){i + 0.5, j + 0.5}, centre) < 0.0;
        const double full = cells / (M_PI * radius * radius);
        for (int k = 0; k < ANGLES; k++) {
            const double a = 2.0 * M_PI * k / ANGLES;
            const double y[3] = {centre[0] + radius * cos(a), centre[1] + radius * sin(a), 0.0};
            sum += colour_height(table, R, share(2, in_disc, centre, y) / full);
        }
    }
    assert_close(sum / (PLACES * ANGLES), 5.0 / 144.0 * R * R / radius, 0.02);
}

TEST(beyond_the_kernel_only_the_side_is_known)
{
    double table[COLOUR_PARTS + 1];
    colour_profile(2, table);
    assert_close(colour_height(table, R, 0.0), colour_reach(R), 1e-12);
    assert_close(colour_height(table, R, 1.0), -colour_reach(R), 1e-12);
}

/* Against a count over a fine grid of the face. */
TEST(shares_of_faces_are_areas)
{
    enum { N = 400 };
    const double dx = 0.3;
    for (int c = 0; c < 40; c++) {
        const double g[3] = {0.4, cos(0.7 * c), sin(1.3 * c)}, phi = 0.25 * sin(2.1 * c);
        double plane = 0.0, line = 0.0;
        for (int j = 0; j < N; j++)
            for (int i = 0; i < N; i++) {
                const double y = dx * ((i + 0.5) / N - 0.5), z = dx * ((j + 0.5) / N - 0.5);
                plane += phi + g[1] * y + g[2] * z < 0.0 ? 1.0 / (N * N) : 0.0;
                line += j == 0 && phi + g[1] * y < 0.0 ? 1.0 / N : 0.0;
            }
        assert_close(wet_faces_share(3, 0, dx, phi, g), plane, 0.005);
        assert_close(wet_faces_share(2, 0, dx, phi, g), line, 0.005);
    }
}
