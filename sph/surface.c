/* surface.c - detection of the free surface; see surface.h. SPDX-License-Identifier: BSD-3-Clause
 */
#include "surface.h"

#include <math.h>
#include <string.h>

#include "../common/mem.h"
#include "domain.h"
#include "kernel.h"
#include "neighbours.h"
#include "walls.h"

enum { PRIM = 8 };

static const double spray = 0.20, inside = 0.75; /* bounds of the eigenvalue */

struct surface *surface_create(struct sph *s)
{
    if (!s->prm.surface)
        return NULL;
    struct surface *f = NEW(struct surface, 1);
    f->reach = s->prm.transport == TRANSPORT_TVO ? 2.0 * s->dx : s->R;
    return f;
}

void surface_free(struct surface **f)
{
    if (!*f)
        return;
    mem_free((*f)->is);
    mem_free((*f)->normal);
    mem_free((*f)->M);
    mem_free((*f)->g);
    mem_free((*f)->lambda);
    mem_free(*f);
    *f = NULL;
}

void surface_room(struct surface *f, int n, int dim)
{
    if (n <= f->capacity)
        return;
    const int old = f->capacity, more = n + n / 8 + 64;
    GROW(f->is, old, more);
    GROW(f->normal, old * dim, more * dim);
    GROW(f->M, old * dim * dim, more * dim * dim);
    GROW(f->g, old * dim, more * dim);
    GROW(f->lambda, old, more);
    f->capacity = more;
}

double surface_eigenvalue(const double *M, int dim)
{
    if (dim == 2) {
        const double mean = 0.5 * (M[0] + M[3]), half = 0.5 * (M[0] - M[3]);
        const double off = 0.5 * (M[1] + M[2]);
        return mean - sqrt(half * half + off * off);
    }
    /* Trigonometric form for symmetric matrices of three rows. */
    const double a = M[0], b = M[4], c = M[8];
    const double d = 0.5 * (M[1] + M[3]), e = 0.5 * (M[5] + M[7]), f = 0.5 * (M[2] + M[6]);
    const double q = (a + b + c) / 3.0, off = d * d + e * e + f * f;
    const double p2 = ((a - q) * (a - q) + (b - q) * (b - q) + (c - q) * (c - q) + 2.0 * off) / 6.0;
    if (p2 <= 1e-28)
        return q;
    const double p = sqrt(p2), A = (a - q) / p, B = (b - q) / p, C = (c - q) / p;
    const double D = d / p, E = e / p, F = f / p;
    const double det = A * (B * C - E * E) - D * (D * C - E * F) + F * (D * E - B * F);
    const double phi = acos(fmax(-1.0, fmin(1.0, 0.5 * det))) / 3.0;
    return q + 2.0 * p * cos(phi + 2.0 * M_PI / 3.0);
}

/* M and sum w gradW of a particle. */
static void add_moments(const struct sph *s, int i, double *M, double *g)
{
    const int dim = s->dim, *j = s->list->j + s->list->start[i];
    const double *x = s->p.prim + (size_t)PRIM * i, R_1 = 1.0 / s->R;
    const double kernel = -kernel_dw_r(dim, 0.0, s->R);
    for (int k = 0; k < s->list->count[i]; k++) {
        const double *q = s->p.prim + (size_t)PRIM * j[k];
        double d[3], r2 = 0.0;
        for (int a = 0; a < dim; a++) {
            d[a] = q[a] - x[a];
            r2 += d[a] * d[a];
        }
        const double t = fmax(1.0 - sqrt(r2) * R_1, 0.0), f = kernel * q[2 * dim] * t * t * t;
        for (int a = 0; a < dim; a++) {
            g[a] += f * d[a];
            for (int b = 0; b < dim; b++)
                M[dim * a + b] += f * d[a] * d[b];
        }
    }
}

/* M is left 0 for particles with so many neighbours that they cannot be on the surface. */
static void moments(struct sph *s, struct surface *f)
{
    const int dim = s->dim;
    const double theta = dim == 2 ? M_PI : 4.0 / 3.0 * M_PI, reach = (s->R + s->skin) / s->dx;
    const double enough = 0.88 * theta * pow(reach, dim);
    memset(f->M, 0, (size_t)s->p.n * dim * dim * sizeof *f->M);
    memset(f->g, 0, (size_t)s->p.n * dim * sizeof *f->g);
    for (int i = 0; i < s->p.n; i++)
        if (s->list->count[i] + 1 < enough)
            add_moments(s, i, f->M + (size_t)dim * dim * i, f->g + (size_t)dim * i);
    if (s->walls && s->walls->model->moments)
        s->walls->model->moments(s, f->M, f->g);
}

/* N = -B g over its size [3.12], [4.87]; false where M is singular. */
static bool find_normal(const double *M, const double *g, double *N, int dim)
{
    double v[3] = {0.0}, size = 0.0;
    if (dim == 2) {
        const double det = M[0] * M[3] - M[1] * M[2];
        if (!(fabs(det) > 1e-12))
            return false;
        v[0] = -(M[3] * g[0] - M[2] * g[1]) / det;
        v[1] = -(M[0] * g[1] - M[1] * g[0]) / det;
    } else {
        const double c[3] = {M[4] * M[8] - M[5] * M[7], M[5] * M[6] - M[3] * M[8],
                             M[3] * M[7] - M[4] * M[6]};
        const double det = M[0] * c[0] + M[1] * c[1] + M[2] * c[2];
        if (!(fabs(det) > 1e-12))
            return false;
        v[0] = -(c[0] * g[0] + c[1] * g[1] + c[2] * g[2]) / det; /* rows of the cofactors: B^T */
        v[1] = -((M[2] * M[7] - M[1] * M[8]) * g[0] + (M[0] * M[8] - M[2] * M[6]) * g[1] +
                 (M[1] * M[6] - M[0] * M[7]) * g[2]) /
               det;
        v[2] = -((M[1] * M[5] - M[2] * M[4]) * g[0] + (M[2] * M[3] - M[0] * M[5]) * g[1] +
                 (M[0] * M[4] - M[1] * M[3]) * g[2]) /
               det;
    }
    for (int a = 0; a < dim; a++)
        size += v[a] * v[a];
    size = sqrt(size);
    for (int a = 0; a < dim; a++)
        N[a] = size > 0.0 ? v[a] / size : 0.0;
    return size > 0.0;
}

/* Whether a neighbour lies in the cone of 45 degrees along N or in the disc around its tip. */
static bool is_covered(const struct sph *s, int i, const double *N)
{
    const int dim = s->dim, *j = s->list->j + s->list->start[i];
    const double *x = s->p.prim + (size_t)PRIM * i, h = fmax(s->R / 3.0, 4.0 / 3.0 * s->dx);
    for (int k = 0; k < s->list->count[i]; k++) {
        const double *q = s->p.prim + (size_t)PRIM * j[k];
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

static void classify(struct sph *s, struct surface *f, int i)
{
    const int dim = s->dim;
    const double *M = f->M + (size_t)dim * dim * i;
    double *N = f->normal + (size_t)dim * i, trace = 0.0;
    f->is[i] = SURFACE_INNER;
    memset(N, 0, (size_t)dim * sizeof *N);
    for (int a = 0; a < dim; a++)
        trace += M[(dim + 1) * a];
    f->lambda[i] = s->list->count[i] > 0 && trace == 0.0 ? 1.0 : surface_eigenvalue(M, dim);
    if (f->lambda[i] >= inside)
        return;
    const bool has_normal = find_normal(M, f->g + (size_t)dim * i, N, dim);
    if (f->lambda[i] <= spray || !has_normal || !is_covered(s, i, N))
        f->is[i] = SURFACE_ON;
    else
        memset(N, 0, (size_t)dim * sizeof *N);
}

/* Flag and normal of every particle on the surface, for the ghosts of other ranks, too. */
static void share(struct sph *s, const struct surface *f)
{
    const int dim = s->dim, width = s->p.nslope;
    for (int i = 0; i < s->p.n; i++) {
        double *line = s->p.slope + (size_t)width * i;
        line[0] = f->is[i] == SURFACE_ON ? 1.0 : 0.0;
        memcpy(line + 1, f->normal + (size_t)dim * i, (size_t)dim * sizeof *line);
    }
    for (int i = s->p.n; i < s->p.n + s->p.nghost; i++) /* walls' and openings' ghosts: none */
        s->p.slope[(size_t)width * i] = 0.0;
    domain_halo_start(s, true);
    domain_halo_finish(s, true);
}

/* Particles within reach of the surface take its normal, weighted by the kernel. */
static void find_near(struct sph *s, struct surface *f)
{
    const int dim = s->dim, width = s->p.nslope;
    for (int i = 0; i < s->p.n; i++) {
        const int *j = s->list->j + s->list->start[i];
        const double *x = s->p.prim + (size_t)PRIM * i;
        double sum[3] = {0.0}, size = 0.0;
        bool near = false;
        if (f->is[i] == SURFACE_ON)
            continue;
        for (int k = 0; k < s->list->count[i]; k++) {
            const double *line = s->p.slope + (size_t)width * j[k];
            if (line[0] != 1.0)
                continue;
            const double *q = s->p.prim + (size_t)PRIM * j[k];
            double r2 = 0.0;
            for (int a = 0; a < dim; a++)
                r2 += (q[a] - x[a]) * (q[a] - x[a]);
            const double W = kernel_w(dim, sqrt(r2), 1.05 * s->R);
            near = near || r2 < f->reach * f->reach;
            for (int a = 0; a < dim; a++)
                sum[a] += W * line[1 + a];
        }
        if (!near)
            continue;
        for (int a = 0; a < dim; a++)
            size += sum[a] * sum[a];
        f->is[i] = SURFACE_NEAR;
        for (int a = 0; a < dim && size > 0.0; a++)
            f->normal[(size_t)dim * i + a] = sum[a] / sqrt(size);
    }
}

void surface_detect(struct sph *s)
{
    struct surface *f = s->surface;
    surface_room(f, s->p.n, s->dim);
    moments(s, f);
    for (int i = 0; i < s->p.n; i++)
        classify(s, f, i);
    if (s->prm.transport != TRANSPORT_TVS && s->prm.transport != TRANSPORT_TVO)
        return; /* nobody asks who is near */
    share(s, f);
    find_near(s, f);
}

/* Next to a surface div u is an error of the gradients, not sound. The damper would take it for
 * sound and work against the sum over the cut support, which is not that div u: a wave of H/dx = 25
 * lost 25 % too much, without 5 % (cases/standing_wave_sph). */
void surface_calm(struct sph *s)
{
    const int dim = s->dim;
    for (int i = 0; i < s->p.n; i++) {
        const double lambda = s->surface->lambda[i];
        if (lambda >= 1.0)
            continue;
        const double out = fmin((1.0 - lambda) / (1.0 - inside), 1.0) / dim;
        double *g = s->p.slope + (size_t)s->p.nslope * i + dim, divergence = 0.0;
        for (int a = 0; a < dim; a++)
            divergence += g[dim * a + a];
        for (int a = 0; a < dim; a++)
            g[dim * a + a] -= out * divergence;
    }
}
