/* water_budget.c - the water of both programs, and the flow that restores what is missing. With M
 * the water missing since the start and A the wet area of the interface, the inflow for the next
 * coupling step is
 *   (M/tau + lasting)/A,   d lasting/dt = M/(4 tau^2),   tau = max(2 sqrt(H/g), 10 T):
 * a proportional part and a slower integral, critically damped together.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "water_budget.h"

#include "../../common/files/files.h"
#include "../boundary/fv_boundary.h"
#include "../grid/fv_grid.h"
#include "../surface/fv_surface.h"

/* sqrt(H/g) over which what is missing comes back. Waves last longer, 4.4 of it and more, and take
 * no part in what is missing; drops and shifted particles take water away steadily: a slower part,
 * over four times that, removes the lasting loss which the proportional part leaves, without
 * oscillating. */
static const double memory = 2.0;

struct water_budget water_budget_create(int n)
{
    return (struct water_budget){
        .n = n,
        .start = NAN,
        .watched = {
            .key = "water_missing",
            .what =
                "water of both programs that was gained or lost without account, over all of it",
            .likely = "waves break at an open side of sph.box, or drops cross it: move the side to "
                      "calmer water; or lower coupling.steps",
            .warn = 0.003,
            .stop = 0.02}};
}

/* Part of a box of centre x and size h that lies within `box' or its periodic images. */
static double share_within(const struct fv *s, const double box[2][3], const double *x,
                           const double *h)
{
    const struct scene_domain *d = &s->run->scene.domain;
    double in = 1.0;
    for (int a = 0; a < s->dim; a++) {
        const double L = d->periodic[a] ? d->max[a] - d->min[a] : 0.0;
        const double off = L > 0.0 ? round((0.5 * (box[0][a] + box[1][a]) - x[a]) / L) * L : 0.0;
        const double lo = fmax(x[a] + off - 0.5 * h[a], box[0][a]);
        in *= fmax(fmin(x[a] + off + 0.5 * h[a], box[1][a]) - lo, 0.0) / h[a];
    }
    return in;
}

/* Part of a box of centre x and size h outside of n others. Boxes of partners lie apart. */
static double share_beyond(const struct fv *s, int n, const double (*box)[2][3], const double *x,
                           const double *h)
{
    double outside = 1.0;
    for (int k = 0; k < n; k++)
        outside -= share_within(s, box[k], x, h);
    return outside;
}

double water_budget_share(const struct fv *s, const double *x, const double *h)
{
    return share_beyond(s, s->partners.n, s->partners.box, x, h);
}

/* The same of what partners count now. */
static double share_outside(const struct fv *s, const struct water_budget *w, const double *x,
                            const double *h)
{
    return share_beyond(s, w->n, w->box, x, h);
}

/* Whether a cube of edge `far' around x meets a partner's box. */
static bool is_beside(const struct fv *s, const struct water_budget *w, const double *x, double far)
{
    const double h[3] = {far, far, far};
    return share_outside(s, w, x, h) < 1.0;
}

/* Part of a cell of blocks outside of what partners count: of a curved cell near a box by 8^dim
 * positions, each for a box of its own. */
static double cell_outside(const struct fv *s, const struct water_budget *w, const struct part *p,
                           const int *i)
{
    const struct mesh_block *b = s->m->block + p->block;
    const int at[3] = {p->lo[0] + i[0], p->lo[1] + i[1], p->lo[2] + i[2]};
    const int side = p->kind == PART_CURVED ? 8 : 1,
              n = s->dim == 3 ? side * side * side : side * side;
    double x[3], dx[3][3], h[3] = {1.0, 1.0, 1.0}, far = 0.0, sum = 0.0;
    mesh_map_point(b, s->dim, at, (const double[]){0.5, 0.5, 0.5}, x, dx);
    for (int a = 0; a < s->dim; a++) {
        h[a] = 0.0;
        for (int t = 0; t < s->dim; t++)
            h[a] += fabs(dx[t][a]);
        far = fmax(far, h[a]);
    }
    if (p->kind != PART_CURVED || !is_beside(s, w, x, 2.0 * far))
        return share_outside(s, w, x, h);
    for (int a = 0; a < 3; a++)
        h[a] /= side;
    for (int k = 0; k < n; k++) {
        const double xi[3] = {(k % side + 0.5) / side, (k / side % side + 0.5) / side,
                              s->dim == 3 ? (k / side / side + 0.5) / side : 0.5};
        mesh_map_point(b, s->dim, at, xi, x, dx);
        sum += share_outside(s, w, x, h) / n;
    }
    return sum;
}

/* FV's water outside of the partners' boxes, m^dim; cells far from the surface's wet side are
 * skipped. Collective. */
static double own_water(const struct fv *s, const struct water_budget *w)
{
    double x[3], h[3], sum = 0.0;
    int i[3];
    for (const struct part *p = s->grid.part; p < s->grid.part + s->grid.nparts; p++)
        PART_CELLS (p, i, c) {
            if (s->forcing->forced[c] || s->surface->phi[c] > 3.0 * s->surface->largest)
                continue;
            if (s->m) {
                sum +=
                    surface_cell_volume(s, c, 0) * surface_share(s, c) * cell_outside(s, w, p, i);
                continue;
            }
            block_cell(&s->b, i[0], i[1], i[2], x, h);
            sum += h[0] * h[1] * h[2] * surface_share(s, c) * share_outside(s, w, x, h);
        }
    return ranks_sum(s->comm, sum);
}

/* Wet area of the interface with imposed cells, m^(dim-1). Collective. */
static double wet_area(const struct fv *s)
{
    const struct forcing *f = s->forcing;
    double sum = 0.0;
    for (int a = 0; a < f->dim; a++)
        for (int64_t i = 0; i < f->nface[a]; i++)
            if (f->counts[a][i])
                sum += grid_face_area(&s->grid, f->face[a][i], a) *
                       surface_face_share(s, f->face[a][i], a);
    return ranks_sum(s->comm, sum);
}

/* Drops that fell into FV's water since the last time are added to what FV conserves. */
void water_budget_take(struct fv *s, struct water_budget *w, const double water[2])
{
    w->partners = water[0];
    s->surface->volume0 += water[1] - w->drops;
    w->drops = water[1];
}

/* The first call sets what there is at the start. */
void water_budget_close(struct fv *s, struct water_budget *w, double T)
{
    const double all = own_water(s, w) + w->partners - s->surface->entered, area = wet_area(s);
    if (isnan(w->start))
        w->start = all;
    s->surface->whole = w->start;
    const double tau = fmax(memory * crossing_time(&s->run->scene), 10.0 * T);
    w->missing = w->start - all;
    w->lasting += T * w->missing / (4.0 * tau * tau);
    s->forcing->inflow = area > 0.0 ? (w->missing / tau + w->lasting) / area : 0.0;
}

/* Of all water that has been there. */
void water_budget_judge(const struct fv *s, struct water_budget *w, struct diagnosis *d)
{
    const double whole = w->start + s->surface->entered;
    if (watch_judge(&w->watched, fabs(w->missing) / whole, s->t, s->run->step, d))
        snprintf(d->where, sizeof d->where, "all water, %g m^%d, t = %.4g s", whole, s->dim, s->t);
}

bool water_budget_restart(struct water_budget *w, struct h5 *f)
{
    return h5_keep(f, "water_start", &w->start) && h5_keep(f, "water_missing", &w->missing) &&
           h5_keep(f, "water_lasting", &w->lasting) && h5_keep(f, "water_drops", &w->drops) &&
           h5_keep(f, "water_worst", &w->watched.worst);
}
