/* surface.c - detection of the free surface; see surface.h. With lambda the smallest eigenvalue of
 * M, walls included: lambda <= 0.2 is spray, on the surface; lambda >= 0.75 is inside; in between a
 * particle is on the surface if no neighbour lies in the cone of 45 degrees along its normal N =
 * -M^-1 sum w grad W (or in the disc around its tip, h = R/3, at least 4/3 dx, away) (Marrone et
 * al., J. Comput. Phys. 229, 2010; Chiron 2017, [3.12]). Order: moments (pairs from the first pass,
 * walls added), classify each particle, find_near for shifting. Called once for every list of
 * pairs, from level.c after the first pass.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "surface.h"

#include "../pairs/sph_pairs.h"
#include "../parallel/domain.h"
#include "../walls/sph_walls.h"

static const double spray = 0.20, inside = 0.75; /* bounds of the eigenvalue */

/* reach is how far the surface acts on shifts: 2 dx where the law has that radius itself, else the
 * whole support R. */
struct free_surface *sph_surface_create(struct sph *s)
{
    if (!s->prm.surface)
        return NULL;
    struct free_surface *f = NEW(struct free_surface, 1);
    f->fades = s->prm.surface_shift == SURFACE_SHIFT_BETA;
    f->reach = f->fades || s->prm.transport == TRANSPORT_TVO ? 2.0 * s->dx : s->R;
    return f;
}

/* Grown by an eighth more, since numbers change with every list. */
void surface_room(struct free_surface *f, int n, int dim)
{
    if (n <= f->capacity)
        return;
    const int old = f->capacity, more = n + n / 8 + 64;
    GROW_IN(f, f->is, old, more);
    GROW_IN(f, f->normal, old * dim, more * dim);
    GROW_IN(f, f->M, old * dim * dim, more * dim * dim);
    GROW_IN(f, f->g, old * dim, more * dim);
    GROW_IN(f, f->lambda, old, more);
    f->capacity = more;
}

/* g = sum_j w_j grad W over the neighbours of particle i, 1/m: it points away from where support is
 * missing, into the fluid, since grad W at x_i of a pair is -(W'/r)(x_j - x_i) with W' < 0. */
INLINE void add_crowding(const struct sph *s, int i, double *g, const int dim)
{
    const struct neighbours *l = s->list;
    const double *x = prim_line(&s->p, i), R_1 = 1.0 / s->R;
    vec sum[3] = {vec_all(0.0), vec_all(0.0), vec_all(0.0)};
    for (const int *j = l->j + l->start[i], *end = j + l->count[i]; j < end; j += LANES) {
        vec d[3], w, spare, r2 = vec_all(0.0);
        vec_columns(s->p.prim, PRIM, j, 0, d, d + 1);
        if (dim == 3)
            vec_columns(s->p.prim, PRIM, j, 2, d + 2, &spare);
        vec_columns(s->p.prim, PRIM, j, at_volume(dim), &w, &spare);
        for (int a = 0; a < dim; a++) {
            d[a] -= x[a];
            r2 += d[a] * d[a];
        }
        const vec t = vec_max(1.0 - vec_sqrt(r2) * R_1, vec_all(0.0));
        for (int a = 0; a < dim; a++)
            sum[a] += t * t * t * w * d[a];
    }
    for (int a = 0; a < dim; a++)
        g[a] -= kernel_dw_r(dim, 0.0, s->R) * vec_sum(sum[a]);
}

/* To the pairs' M of the first pass what walls add; g where a normal may be asked for, which walls
 * do not bring about. M is 0 for particles with so many neighbours that they cannot be on the
 * surface. g costs a second loop over the neighbours, hence only below the bound beyond which no
 * normal is needed. */
static void moments(struct sph *s, struct free_surface *f)
{
    const int dim = s->dim;
    if (s->p.n > 0)
        memset(f->g, 0, (size_t)s->p.n * dim * sizeof *f->g);
    for (int i = 0; i < s->p.n; i++) {
        double *M = f->M + (size_t)dim * dim * i;
        if (s->list->whole[i])
            memset(M, 0, (size_t)dim * dim * sizeof *M);
        else if (eigenvalue_smallest(M, dim) < inside && dim == 2)
            add_crowding(s, i, f->g + (size_t)2 * i, 2);
        else if (eigenvalue_smallest(M, dim) < inside)
            add_crowding(s, i, f->g + (size_t)3 * i, 3);
    }
    if (s->walls && s->walls->model->moments)
        s->walls->model->moments(s, f->M, f->g);
}

/* N = -B g over its size [3.12], [4.87]; false where M is singular. The sign makes N point out of
 * the fluid; M^-1 corrects the direction near corners, where the support is cut on two sides. 1e-12
 * is far below any determinant of particles with two neighbours. */
static bool find_normal(const double *M, const double *g, double *N, int dim)
{
    double A[3][3] = {{0.0}, {0.0}, {0.0, 0.0, 1.0}}, c[3][3], v[3] = {0.0};
    for (int a = 0; a < dim * dim; a++)
        A[a / dim][a % dim] = M[a];
    const double det = vec3_cofactors(A, c);
    if (!(fabs(det) > 1e-12))
        return false;
    for (int a = 0; a < dim; a++)
        for (int b = 0; b < dim; b++)
            v[a] -= c[a][b] * g[b] / det; /* B^T */
    const double size = vec3_unit(v);
    memcpy(N, v, (size_t)dim * sizeof *N);
    return size > 0.0;
}

/* Whether a neighbour lies in the cone of 45 degrees along N, to a distance of sqrt(2) h, or beyond
 * that in the disc of radius h around its tip x + h N. */
static bool is_covered(const struct sph *s, int i, const double *N)
{
    const int dim = s->dim, *j = s->list->j + s->list->start[i];
    const double *x = prim_line(&s->p, i), h = fmax(s->R / 3.0, 4.0 / 3.0 * s->dx);
    for (int k = 0; k < s->list->count[i]; k++) {
        const double *q = prim_line(&s->p, j[k]);
        double y2 = 0.0, along = 0.0, tip2 = 0.0;
        for (int a = 0; a < dim; a++) {
            const double y = q[a] - x[a];
            y2 += y * y;
            along += y * N[a];
            tip2 += (y - h * N[a]) * (y - h * N[a]);
        }
        if (y2 >= 2.0 * h * h ? tip2 < h * h : along > sqrt(0.5 * y2))
            return true;
    }
    return false;
}

/* Sets class, lambda and normal of particle i: inside by lambda, spray by lambda, else by the cone.
 * Normals are kept for particles on the surface alone. */
static void classify(struct sph *s, struct free_surface *f, int i)
{
    const int dim = s->dim;
    const double *M = f->M + (size_t)dim * dim * i;
    double *N = f->normal + (size_t)dim * i;
    f->is[i] = SURFACE_INNER;
    memset(N, 0, (size_t)dim * sizeof *N);
    f->lambda[i] = s->list->whole[i] ? 1.0 : eigenvalue_smallest(M, dim);
    if (f->lambda[i] >= inside)
        return;
    const bool has_normal = find_normal(M, f->g + (size_t)dim * i, N, dim);
    if (f->lambda[i] <= spray || !has_normal || !is_covered(s, i, N))
        f->is[i] = SURFACE_ON;
    else
        memset(N, 0, (size_t)dim * sizeof *N);
}

/* [nghost][1 + dim]: flag and normal of ghosts; those of walls and openings have none. */
static double *share(struct sph *s, const struct free_surface *f)
{
    const int dim = s->dim;
    double *own = NEW(double, (size_t)s->p.n *(1 + dim));
    double *ghosts = NEW(double, (size_t)s->p.nghost *(1 + dim));
    for (int i = 0; i < s->p.n; i++) {
        double *row = own + (size_t)(1 + dim) * i;
        row[0] = f->is[i] == SURFACE_ON;
        memcpy(row + 1, f->normal + (size_t)dim * i, (size_t)dim * sizeof *row);
    }
    domain_share(s, own, 1 + dim, ghosts);
    mem_free(own);
    return ghosts;
}

/* A particle i near another with normal N takes it, weighted by the kernel. The kernel's radius is
 * 5 % larger than R so that weights at the very edge are not 0. */
static void take_normal(const struct sph *s, struct free_surface *f, int i, int j, const double *N)
{
    const int dim = s->dim;
    const double *x = prim_line(&s->p, i), *y = prim_line(&s->p, j);
    const double r2 = vec_distance2(dim, y, x);
    const double W = kernel_w(dim, sqrt(r2), 1.05 * s->R);
    if (r2 < f->reach * f->reach)
        f->is[i] = SURFACE_NEAR;
    for (int a = 0; a < dim; a++)
        f->normal[(size_t)dim * i + a] += W * N[a];
}

/* Those near ghosts on the surface; ghosts stand at the end of a row. Each rank does so for its own
 * particles; the symmetric search of find_near ends at ghosts. */
static void find_near_ghosts(struct sph *s, struct free_surface *f)
{
    const struct neighbours *l = s->list;
    const int n = s->p.n, width = 1 + s->dim;
    double *ghosts = share(s, f);
    for (int i = 0; i < n; i++) {
        const int *j = l->j + l->start[i];
        for (int k = l->count[i] - 1; k >= 0 && j[k] >= n && f->is[i] != SURFACE_ON; k--) {
            const double *row = ghosts + (ptrdiff_t)width * (j[k] - n);
            if (row[0] == 1.0)
                take_normal(s, f, i, j[k], row + 1);
        }
    }
    mem_free(ghosts);
}

/* Particles within reach of the surface take its normal: from those on it, which are few. A
 * particle that is near several takes a mean of their normals, made a unit vector at the end. */
static void find_near(struct sph *s, struct free_surface *f)
{
    const int dim = s->dim, n = s->p.n;
    for (int i = 0; i < n; i++) {
        const int *j = s->list->j + s->list->start[i];
        for (int k = 0; k < s->list->count[i] && j[k] < n && f->is[i] == SURFACE_ON; k++)
            if (f->is[j[k]] != SURFACE_ON)
                take_normal(s, f, j[k], i, f->normal + (size_t)dim * i);
    }
    if (s->run->size > 1 || s->p.nghost > 0)
        find_near_ghosts(s, f);
    for (int i = 0; i < n; i++) {
        double *N = f->normal + (size_t)dim * i, size2 = 0.0;
        for (int a = 0; a < dim; a++)
            size2 += N[a] * N[a];
        const double to_unit = f->is[i] == SURFACE_INNER || size2 == 0.0 ? 0.0 : 1.0 / sqrt(size2);
        for (int a = 0; a < dim && f->is[i] != SURFACE_ON; a++)
            N[a] *= to_unit;
    }
}

/* Shifting laws alone ask who is near the surface. */
static bool finds_near(const struct sph *s)
{
    return s->prm.transport == TRANSPORT_TVS || s->prm.transport == TRANSPORT_TVO;
}

bool surface_reaches(const struct sph *s, int i)
{
    return s->surface && s->surface->lambda[i] < 1.0 &&
           (s->surface->is[i] != SURFACE_INNER || !finds_near(s));
}

/* Collective where ranks or ghosts exist: near ghosts are asked of their owners. */
void surface_detect(struct sph *s)
{
    struct free_surface *f = s->surface;
    moments(s, f);
    for (int i = 0; i < s->p.n; i++)
        classify(s, f, i);
    f->known = true;
    if (!finds_near(s))
        return; /* nobody asks */
    find_near(s, f);
    if (s->walls && f->reach == s->R)
        s->walls->near_surface = f->is;
}

/* Next to a surface div u is an error of the gradients, not sound. The damper would take it for
 * sound and work against the sum over the cut support, which is not that div u: a wave of H/dx = 25
 * lost 25 % too much, without 5 % (cases/standing_wave_sph). */
void surface_calm(struct sph *s)
{
    const int dim = s->dim;
    const double beside_walls = s->mixed ? 1.0 : 1.0 - scheme_streams(s);
    for (int i = 0; i < s->p.n; i++) {
        const double lambda = s->surface->lambda[i];
        if (lambda >= 1.0)
            continue;
        const double share = surface_reaches(s, i) ? 1.0 : beside_walls;
        const double out = share * (lambda < inside ? 1.0 : (1.0 - lambda) / (1.0 - inside)) / dim;
        double *g = slope_line(&s->p, i) + dim, divergence = 0.0;
        for (int a = 0; a < dim; a++)
            divergence += g[dim * a + a];
        for (int a = 0; a < dim; a++)
            g[dim * a + a] -= out * divergence;
    }
}
