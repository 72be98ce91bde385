/* graded.c - first particles whose spacing grows away from a box, by less than 3 % from one layer
 * to the next: the finest lattice in the box, then frames of cells around it, each as thick as the
 * one before times a constant, up to the case's dx; the cells tile the plane, so volumes are exact.
 * Each particle keeps the R of its layer. Called once at the start, instead of the lattice of
 * fill.c; on one rank, in 2D (mixed.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "mixed.h"

#include "../../common/scene/scene.h"
#include "../particles/sph_particles.h"

static const double growth = 0.025;

struct filler {
    struct sph *s;
    struct exact exact;
};

/* The particle of one cell of a layer of this spacing, if there is fluid at its centre. Its state
 * is the exact field's at the centre and t = 0, with the density that p asks for. */
static void add_cell(struct filler *f, double x0, double x1, double y0, double y1, double dx)
{
    struct sph *s = f->s;
    const double x[3] = {0.5 * (x0 + x1), 0.5 * (y0 + y1), 0.0}, w = (x1 - x0) * (y1 - y0);
    double u[3], p, more[3];
    if (!scene_is_fluid(&s->run->scene, &f->exact, x, more))
        return;
    exact_point(&f->exact, x, 0.0, u, &p, NULL);
    for (int a = 0; a < 2; a++)
        u[a] += more[a];
    particles_reserve(&s->p, s->p.n + 1);
    const int i = particles_add(&s->p, s->p.next_id++, ZONE_FREE);
    particles_set(s, i, x, u, w, eos_rho(p, s->rho0, s->c0, s->gamma));
    *mixed_R(s, i) = s->prm.R_dx * dx;
    *mixed_weight(s, i) = 1.0;
}

/* A rectangle in cells of about this size. */
static void add_cells(struct filler *f, const double lo[2], const double hi[2], double dx)
{
    const double length[2] = {hi[0] - lo[0], hi[1] - lo[1]};
    if (length[0] <= 0.0 || length[1] <= 0.0)
        return;
    const int nx = (int)fmax(1.0, round(length[0] / dx)),
              ny = (int)fmax(1.0, round(length[1] / dx));
    for (int j = 0; j < ny; j++)
        for (int i = 0; i < nx; i++)
            add_cell(f, lo[0] + length[0] * i / nx, lo[0] + length[0] * (i + 1) / nx,
                     lo[1] + length[1] * j / ny, lo[1] + length[1] * (j + 1) / ny, dx);
}

/* Thickness of layer k around the core: finest (1 + growth)^(k+1), at most the case's dx. */
static double thickness(double finest, double most, int k)
{
    return fmin(finest * pow(1.0 + growth, k + 1), most);
}

/* Layers from the box to a side of the domain, and the factor with which they fit. */
struct layers {
    int n;
    double scale;
};

/* How many layers fit into `length' and by what factor they are stretched or shrunk to fill it; one
 * more or less is taken, whichever comes nearer. */
static struct layers lay(double length, double finest, double most)
{
    struct layers l = {0, 1.0};
    double sum = 0.0, before = 0.0;
    while (sum < length) {
        before = sum;
        sum += thickness(finest, most, l.n++);
    }
    if (l.n > 1 && length - before < sum - length) {
        l.n--;
        sum = before;
    }
    l.scale = l.n > 0 ? length / sum : 1.0;
    return l;
}

/* The frame around the rectangle with these thicknesses at its sides x low, x high, y low, y high;
 * the rectangle grows by it. Eight rectangles: four sides, and the four corners, which have a
 * thickness of their own in either direction. */
static void add_frame(struct filler *f, double lo[2], double hi[2], const double t[4], double dx)
{
    for (int i = -1; i <= 1; i++)
        for (int j = -1; j <= 1; j++) {
            if (i == 0 && j == 0)
                continue;
            const double from[2] = {i < 0   ? lo[0] - t[0]
                                    : i > 0 ? hi[0]
                                            : lo[0],
                                    j < 0   ? lo[1] - t[2]
                                    : j > 0 ? hi[1]
                                            : lo[1]};
            const double to[2] = {i < 0   ? lo[0]
                                  : i > 0 ? hi[0] + t[1]
                                          : hi[0],
                                  j < 0   ? lo[1]
                                  : j > 0 ? hi[1] + t[3]
                                          : hi[1]};
            add_cells(f, from, to, dx);
        }
    for (int a = 0; a < 2; a++) {
        lo[a] -= t[2 * a];
        hi[a] += t[2 * a + 1];
    }
}

/* The box of the finest level, less the belt R wide that guards would have at its edges, in whole
 * cells from a side of the domain where it reaches one. belt is R of the level outside of the
 * finest, 2 R_dx finest. */
static void find_core(const struct sph *s, const struct apr_params *prm, double finest,
                      double lo[2], double hi[2])
{
    const struct apr_region *is = prm->regions.of;
    while (is->level != prm->levels)
        is++;
    const double belt = 2.0 * s->prm.R_dx * finest, near = 1e-6 * finest;
    for (int a = 0; a < 2; a++) {
        const bool at_lo = is->min[a] <= s->lo[a] + near, at_hi = is->max[a] >= s->hi[a] - near;
        lo[a] = at_lo ? s->lo[a] : is->min[a] + belt;
        hi[a] = at_hi ? s->hi[a] : is->max[a] - belt;
        const double length = fmax(1.0, round((hi[a] - lo[a]) / finest)) * finest;
        if (at_lo && at_hi)
            continue;
        if (at_hi)
            lo[a] = hi[a] - length;
        else
            hi[a] = lo[a] + length;
    }
}

/* The core first, then frames outwards; a side whose layers are all laid gets frames of thickness 0
 * from then on. */
void graded_fill(struct sph *s)
{
    const struct apr_params *prm = apr_params_of(s->run);
    const double finest = ldexp(s->dx, -prm->levels);
    struct filler f = {s, exact_create(&s->run->scene)};
    struct layers side[4];
    double lo[2], hi[2];
    int most = 0;
    particles_add_sizes(&s->p, s->R);
    find_core(s, prm, finest, lo, hi);
    for (int k = 0; k < 4; k++) {
        const int a = k / 2;
        side[k] = lay(k % 2 ? s->hi[a] - hi[a] : lo[a] - s->lo[a], finest, s->dx);
        most = side[k].n > most ? side[k].n : most;
    }
    add_cells(&f, lo, hi, finest);
    for (int k = 0; k < most; k++) {
        const double dx = thickness(finest, s->dx, k);
        double t[4];
        for (int a = 0; a < 4; a++)
            t[a] = k < side[a].n ? dx * side[a].scale : 0.0;
        add_frame(&f, lo, hi, t, dx);
    }
}
