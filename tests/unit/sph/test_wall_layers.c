/* test_wall_layers.c - what a plane wall does to the crowding vector is what the layers of a
 * lattice behind it would do, so that layers that end dx/2 before a wall rest where they are.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/pairs/kernel.h"
#include "../../../sph/walls/wall_layers.h"

/* The part across the layers of (1 + (W/W(dx))^4/5) grad W at the height h. */
static double push(const struct sph *s, double h, double along2)
{
    const double r = sqrt(h * h + along2);
    const double q = kernel_w(s->dim, r, s->R) / kernel_w(s->dim, s->dx, s->R);
    return -h * kernel_dw_r(s->dim, r, s->R) * (1.0 + 0.2 * pow(q, 4.0));
}

/* Of one layer at the height h, over all places of its lattice: layers slide over each other. */
static double of_layer(const struct sph *s, double h)
{
    enum { PLACES = 8 };
    const int n = (int)(s->R / s->dx) + 2, deep = s->dim == 3 ? n : 0;
    const int deep_places = s->dim == 3 ? PLACES : 1;
    double sum = 0.0;
    for (int p = 0; p < PLACES * deep_places; p++)
        for (int k = -deep; k <= deep; k++)
            for (int j = -n; j <= n; j++) {
                const double x = s->dx * (j + (p % PLACES + 0.5) / PLACES);
                const double z = s->dim == 3 ? s->dx * (k + (p / PLACES + 0.5) / PLACES) : 0.0;
                sum += push(s, h, x * x + z * z);
            }
    return sum * s->dxD / (PLACES * deep_places);
}

static double of_plane(const struct sph *s, double h) /* int W dS, 1/m */
{
    enum { POINTS = 4000 };
    double sum = 0.0;
    for (int j = 0; j < POINTS; j++) {
        const double y = (j + 0.5) / POINTS * s->R;
        sum += (s->dim == 3 ? 2.0 * M_PI * y : 2.0) * kernel_w(s->dim, hypot(h, y), s->R);
    }
    return sum * s->R / POINTS;
}

TEST(layers_that_end_before_a_wall_rest)
{
    static const double supports[3] = {2.5, 3.0, 4.0};
    for (int v = 0; v < 6; v++) {
        struct sph s = {.dim = 2 + v % 2, .dx = 0.1, .R = 0.1 * supports[v / 2]};
        s.dxD = pow(s.dx, s.dim);
        const int n = 10 * (int)(2.0 * supports[v / 2]); /* dx/2 is a multiple of R/n */
        double ratio[81];
        wall_layers_crowding(&s, n, ratio);
        for (int layer = 0; layer < 3 && layer + 0.5 < supports[v / 2]; layer++) {
            const double d = (layer + 0.5) * s.dx;
            double fluid = 0.0, first = of_layer(&s, s.dx);
            for (int k = 1; k * s.dx < s.R; k++) /* layers above push down, those below up */
                fluid += of_layer(&s, k * s.dx) - (k <= layer ? of_layer(&s, k * s.dx) : 0.0);
            const double wall = ratio[(int)lround(d / s.R * n)] * of_plane(&s, d);
            assert_close(wall / first, fluid / first, 2e-3);
        }
    }
}
