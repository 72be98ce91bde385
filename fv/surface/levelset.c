/* levelset.c - phi_t + u.grad phi = 0: WENO5 (weno.c; level_ops.h) in a band around the surface,
 * SSP-RK3 (Shu & Osher 1988); volume by planes in the cells.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "levelset.h"

#include "../boundary/fv_boundary.h"
#include "extension_window.h"
#include "level_ops.h"
#include "mesh_view.h"
#include "plane.h"
#include "reinit_band.h"

/* -: most of the sum over the axes of |u_a| dt/h_a in a part of a step. Shares of water stay within
 * their bounds up to a half (fraction.c), beyond in all but the fastest cells; a step of CFL 1.1
 * is two halves of one part each. */
static const double PART_MOST = 0.6;

/* The grid's own, then what convective outflows and held inflows have behind them. */
void surface_ghosts(const struct fv *s, double *phi)
{
    s->surface->ops->ghosts(s, phi);
    carried_level_ghosts(s, phi);
}

void surface_mirror(const struct fv *s, double *q)
{
    s->surface->ops->mirror(s, q);
    carried_share_ghosts(s, q);
}

/* q = w p + (1 - w)(q + dt rate): the form that all three stages of SSP-RK3 have. */
void level_blend(const struct fv *s, double w, const double *p, double dt, const double *rate,
                 double *q)
{
    FLOW_NEAR (s, c, n)
        for (int64_t i = c; i < c + n; i++)
            q[i] = w * p[i] + (1.0 - w) * (q[i] + dt * rate[i]);
}

/* One step of SSP-RK3. */
static void advance(struct fv *s, double dt)
{
    static const double w[3] = {0.0, 0.75, 1.0 / 3.0};
    struct surface *f = s->surface;
    memcpy(f->phi_new, f->phi, (size_t)s->size * sizeof(double));
    for (int k = 0; k < 3; k++) {
        f->ops->stage_ghosts(s, k == 0, f->phi_new);
        carried_level_ghosts(s, f->phi_new);
        f->ops->rate(s, f->phi_new, f->rate);
        level_blend(s, w[k], f->phi, dt, f->rate, f->phi_new);
    }
    surface_ghosts(s, f->phi_new);
    double *t = f->phi;
    f->phi = f->phi_new;
    f->phi_new = t;
}

/* How many equal parts a step is taken in. */
int level_parts(double cfl) { return cfl > PART_MOST ? (int)ceil(cfl / PART_MOST) : 1; }

int surface_advance(struct fv *s, double dt)
{
    const double cfl = s->surface->ops->speed(s) * dt;
    const int n = level_parts(cfl);
    s->surface->travelled += cfl;
    for (int k = 0; k < n; k++)
        advance(s, dt / n);
    return n;
}

void surface_slopes(const struct fv *s, const struct part *p, int64_t c, double *n)
{
    s->surface->ops->slopes(s, p, c, n);
}

void level_add_water(const struct fv *s, const struct part *p, int64_t c, double volume, double e,
                     double sums[2])
{
    const double phi = s->surface->phi[c];
    double n[3] = {0.0, 0.0, 0.0};
    s->surface->ops->slopes(s, p, c, n);
    sums[0] += volume * plane_share(s->dim, n, -phi);
    sums[1] +=
        volume * (plane_share(s->dim, n, -(phi + e)) - plane_share(s->dim, n, e - phi)) / (2.0 * e);
}

/* m: beyond this a cell is all water or all air, whatever the slopes of phi, which has steps where
 * its band ends. */
static double reach_at(const struct fv *s, const struct part *p, int64_t c)
{
    return 3.0 * s->surface->ops->spacing(s, p, s->b.rows ? block_row(&s->b, c) : 0);
}

double surface_share(const struct fv *s, int64_t c)
{
    const struct part *p = grid_part(&s->grid, c, NULL);
    const double phi = s->surface->phi[c];
    double n[3] = {0.0, 0.0, 0.0};
    if (fabs(phi) > reach_at(s, p, c))
        return phi < 0.0;
    s->surface->ops->slopes(s, p, c, n);
    return plane_share(s->dim, n, -phi);
}

double surface_cell_volume(const struct fv *s, int64_t c, int j)
{
    return s->surface->ops->volume(s, c, j);
}

double surface_counted(const struct fv *s, int64_t c, double share)
{
    return s->surface->ops->counted(s, c, share);
}

/* Share of the lower face of c along a that is wet, by phi on the face and its slopes there. */
double surface_face_share(const struct fv *s, int64_t c, int a)
{
    const struct part *p = grid_part(&s->grid, c, NULL);
    const double *q = s->surface->phi + c;
    const int64_t d = p->stride[a];
    double n[3] = {0.0, 0.0, 0.0};
    int m = 0;
    for (int t = 0; t < s->dim; t++)
        if (t != a) {
            const int64_t e = p->stride[t];
            n[m++] = 0.25 * (q[e] - q[-e] + q[e - d] - q[-e - d]);
        }
    return plane_share(m, n, -0.5 * (q[0] + q[-d]));
}

/* Cells whose water counts. */
static bool is_own(const struct fv *s, int64_t c)
{
    return !(s->surface->forced && s->forcing->forced[c]);
}

double surface_level_volume(const struct fv *s, double *area)
{
    double sums[2] = {0.0, 0.0};
    FLOW_NEAR_AT (s, part, j, c, n) {
        const double h = s->surface->ops->spacing(s, part, j);
        const double e = 1e-4 * h;
        for (int64_t i = c; i < c + n; i++) {
            if (!is_own(s, i))
                continue;
            const double volume = surface_cell_volume(s, i, j);
            if (fabs(s->surface->phi[i]) > 3.0 * h) {
                sums[0] += s->surface->phi[i] < 0.0 ? volume : 0.0;
                continue;
            }
            level_add_water(s, part, i, volume, e, sums);
        }
    }
    if (s->surface->ops->add_shared)
        s->surface->ops->add_shared(s, sums);
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, s->comm);
    if (area)
        *area = sums[1];
    return sums[0];
}

/* Upward part of the lower face of c along a, m^(dim-1). */
static double upward_area(const struct fv *s, int64_t c, int a)
{
    double sum = 0.0;
    for (int q = 0; q < s->dim; q++) {
        const double S = s->m ? s->m->S[a][q][c] : q == a ? grid_face_area(&s->grid, c, a) : 0.0;
        sum -= S * s->gravity.hydrostatic[q] / s->surface->g;
    }
    return sum;
}

/* Of the faces between wet and dry cells what looks up less what looks down: that is exact. */
double surface_plan(const struct fv *s, double level, double within)
{
    const struct surface *f = s->surface;
    double sum = 0.0;
    for (int a = 0; a < s->dim && f->g > 0.0; a++)
        for (int64_t i = 0; i < f->ncut[a]; i++) {
            const struct cut *x = f->cut[a] + i;
            int at[3];
            const struct part *p = grid_part(&s->grid, x->wet, at);
            bool own = grid_is_computed(&s->grid, x->wet);
            for (int q = 0; q < s->dim; q++)
                own = own && at[q] >= 0 && at[q] < p->n[q];
            if (own && fabs(s->gravity.level + x->height / f->g - level) <= within)
                sum += x->up * upward_area(s, x->face, a);
        }
    return ranks_sum(s->comm, sum);
}

double surface_volume_scale(const struct fv *s)
{
    const struct scene_domain *d = &s->run->scene.domain;
    double least = 0.01;
    for (int a = 0; a < d->dim; a++)
        least *= d->max[a] - d->min[a];
    return fmax(fmax(s->surface->volume0 + s->surface->passed, s->surface->whole), least);
}

/* m^dim put back, with its sign, and what was lost and gained apart, which may balance. */
void surface_note_returned(struct fv *s, double volume)
{
    s->surface->returned += volume;
    s->surface->lost += fmax(0.0, volume);
    s->surface->gained += fmax(0.0, -volume);
}

/* Newton's iteration; once is enough for what a smooth step loses. */
void surface_keep_volume(struct fv *s)
{
    struct surface *f = s->surface;
    const double h = f->largest, most = (f->forced ? 0.02 : 0.1) * h;
    double area, d = INFINITY;
    for (int it = 0; it < 5 && fabs(d) > 1e-5 * f->least; it++) {
        const double volume = surface_level_volume(s, &area);
        if (!(area < 0.0))
            return;
        d = fmax(-most, fmin(most, (f->volume0 - volume) / area));
        FLOW_NEAR (s, c, n)
            for (int64_t i = c; i < c + n; i++)
                f->phi[i] += is_own(s, i) ? d : 0.0;
        surface_ghosts(s, f->phi);
        surface_note_returned(s, d * area);
    }
}

/* NULL: no free surface. The grid's functions are chosen here, nobody below asks which kind of
 * cells it is. */
struct surface *levelset_create(const struct fv *s)
{
    if (!s->prm.water)
        return NULL;
    struct surface *f = NEW(struct surface, 1);
    double **const fields[] = {&f->phi, &f->phi_new, &f->rate, &f->kept, &f->stress};
    const double *g = s->gravity.hydrostatic;
    f->ops = s->m ? &block_level : &even_level;
    f->reinit = &even_reinit;
    f->window = s->m ? &block_window : &even_window;
    for (size_t k = 0; k < sizeof fields / sizeof fields[0]; k++)
        *fields[k] = NEW_IN(f, double, s->size);
    for (int a = 0; a < s->dim; a++)
        f->open[a] = NEW_IN(f, double, s->size);
    f->layer = NEW_IN(f, unsigned char, s->size + 8); /* read by eight (extension_even.c) */
    if (!s->m && !s->b.rows)
        f->bent = NEW_IN(f, unsigned char, s->size);
    f->deep = NEW_IN(f, int64_t, s->size);
    f->closed = NEW_IN(f, bool, s->size + 8);
    f->none = (const unsigned char *)f->closed;
    if (s->prm.integrator != INTEGRATOR_RK3)
        f->half = NEW_IN(f, double, s->size);
    f->g = vec3_length(g);
    f->ops->start(s, f);
    f->ops->ghosts(s, f->phi);
    return f;
}
