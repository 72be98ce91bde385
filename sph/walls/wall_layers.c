/* wall_layers.c - see wall_layers.h. SPDX-License-Identifier: BSD-3-Clause */
#include "wall_layers.h"

#include "../pairs/sph_pairs.h"

/* int f dS over the plane at the height h, f of the distance, within R. Midpoints. */
static double over_plane(const struct sph *s, double h, double (*f)(const struct sph *s, double r))
{
    enum { POINTS = 200 }; /* of W: 1e-5 of the whole at the wall in 3D, 1e-11 in 2D */
    const double R = s->R, half = h < R ? sqrt(R * R - h * h) : 0.0;
    double sum = 0.0;
    for (int j = 0; j < POINTS; j++) {
        const double y = (j + 0.5) / POINTS * half;
        sum += (s->dim == 3 ? 2.0 * M_PI * y : 2.0) * f(s, sqrt(h * h + y * y));
    }
    return sum * half / POINTS;
}

static double kernel(const struct sph *s, double r) { return kernel_w(s->dim, r, s->R); }

double wall_layers_plane(const struct sph *s, double h) { return over_plane(s, h, kernel); }

/* What the function whose gradient the crowding vector sums [4.89] has more than the kernel. */
static double excess(const struct sph *s, double r)
{
    const double W = kernel(s, r), q = W / kernel(s, s->dx);
    return 0.04 * W * q * q * q * q;
}

/* Of the gradient whose sum the crowding vector is, (1 + (W/W(dx))^4/5) grad W: over -r. */
static double push(const struct sph *s, double r)
{
    const double q = kernel(s, r) / kernel(s, s->dx);
    return -kernel_dw_r(s->dim, r, s->R) * (1.0 + 0.2 * q * q * q * q);
}

/* sum dx^D W over the layer of a lattice at the height h, one of whose places is the foot. */
static double over_layer(const struct sph *s, double h)
{
    const int n = (int)(s->R / s->dx) + 1, deep = s->dim == 3 ? n : 0;
    double sum = 0.0;
    for (int k = -deep; k <= deep; k++)
        for (int j = -n; j <= n; j++)
            sum += kernel_w(s->dim, sqrt(h * h + s->dx * s->dx * (j * j + k * k)), s->R);
    return sum * s->dxD;
}

/* Sums from R inwards, so that each node adds one slab to the integral behind it. */
void wall_layers_rooms(const struct sph *s, int n, double *ratio)
{
    enum { FINE = 50 };
    const double lattice = kernel_lattice_sum(s), step = s->R / (n * FINE);
    double behind = 0.0; /* int W dV */
    ratio[n] = 0.0;
    for (int k = n - 1; k >= 0; k--) {
        const double d = k * s->R / n;
        double layers = 0.0;
        for (int j = 0; j < FINE; j++)
            behind += step * over_plane(s, d + (j + 0.5) * step, kernel);
        for (double h = d + 0.5 * s->dx; h < s->R; h += s->dx)
            layers += over_layer(s, h);
        ratio[k] = layers / (lattice * behind);
    }
}

/* Layers of an even lattice stand dx/2, 3 dx/2 ... behind the wall; each stands for the slab that
 * it is the middle of. */
void wall_layers_crowding(const struct sph *s, int n, double *ratio)
{
    ratio[n] = 0.0;
    for (int k = 0; k < n; k++) {
        const double d = k * s->R / n;
        double layers = 0.0;
        for (double h = d + 0.5 * s->dx; h < s->R; h += s->dx)
            layers += s->dx * h * over_plane(s, h, push);
        ratio[k] = layers / over_plane(s, d, kernel);
    }
}

/* Whether the fluid fills all between sides of the domain: nothing else bounds it. */
static bool fills_sides(const struct sph *s)
{
    const struct scene *c = &s->run->scene;
    bool sides = s->prm.surface != SURFACE_YES && c->nbodies == 0;
    for (int k = 0; k < c->nwalls; k++)
        sides = sides && c->walls[k].side >= SIDE_X_MIN;
    return sides;
}

void wall_layers_tabulate(const struct sph *s, int n, double *ratio)
{
    if (fills_sides(s)) {
        wall_layers_crowding(s, n, ratio);
        return;
    }
    ratio[n] = 1.0;
    for (int k = 0; k < n; k++) {
        const double d = k * s->R / n;
        ratio[k] = 1.0 + over_plane(s, d, excess) / over_plane(s, d, kernel);
    }
}
