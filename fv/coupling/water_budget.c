/* water_budget.c - see water_budget.h. SPDX-License-Identifier: BSD-3-Clause */
#include "water_budget.h"

#include <math.h>
#include <stdio.h>

#include "../../common/crossing.h"
#include "../../common/h5.h"
#include "../boundary/forcing.h"
#include "../surface/levelset.h"

/* sqrt(H/g) over which what is missing comes back. Waves last longer, 4.4 of it and more, and take
 * no part in what is missing; what drops and shifted particles take away comes steadily: a slower
 * part, four times that, takes the lasting loss away which the part in proportion leaves, without
 * swinging. */
static const double memory = 2.0;

struct water_budget water_budget_create(int n)
{
    return (struct water_budget){
        .n = n,
        .start = NAN,
        .watched = {.key = "water_missing",
                    .what = "water of both programs that came or went unbooked, over all of it",
                    .likely = "waves break at an open side of sph.box, or drops cross it: move the "
                              "side to calmer water; or windows too long: coupling.steps",
                    .warn = 0.003,
                    .stop = 0.02}};
}

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

double water_budget_share(const struct fv *s, const double *x, const double *h)
{
    double outside = 1.0;
    for (int k = 0; k < s->npartners; k++)
        outside -= share_within(s, s->partner[k], x, h);
    return outside;
}

static double own_water(const struct fv *s, const struct water_budget *w)
{
    const struct block *b = &s->b;
    double x[3], h[3], sum = 0.0;
    BLOCK_CELLS (b, i, j, k, c) {
        if (s->forcing->forced[c] || s->surface->phi[c] > 3.0 * b->h[0])
            continue;
        block_cell(b, i, j, k, x, h);
        double own = 1.0;
        for (int q = 0; q < w->n; q++)
            own -= share_within(s, w->box[q], x, h);
        sum += h[0] * h[1] * h[2] * surface_share(s, c) * own;
    }
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, b->cart);
    return sum;
}

/* m^(dim-1): of the outline. */
static double wet_area(const struct fv *s)
{
    const struct forcing *f = s->forcing;
    double sum = 0.0;
    for (int a = 0; a < f->dim; a++)
        for (int64_t i = 0; i < f->nface[a]; i++) {
            const int row = block_row(&s->b, f->face[a][i]);
            if (f->counts[a][i])
                sum += block_volume(&s->b, row) / block_size(&s->b, a, row) *
                       surface_face_share(s, f->face[a][i], a);
        }
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, s->b.cart);
    return sum;
}

void water_budget_take(struct fv *s, struct water_budget *w, const double water[2])
{
    w->partners = water[0];
    s->surface->volume0 += water[1] - w->drops;
    w->drops = water[1];
}

void water_budget_close(struct fv *s, struct water_budget *w, double T)
{
    const double all = own_water(s, w) + w->partners - s->surface->entered, area = wet_area(s);
    if (isnan(w->start))
        w->start = all;
    const double tau = fmax(memory * crossing_time(&s->run->scene), 10.0 * T);
    w->missing = w->start - all;
    w->lasting += T * w->missing / (4.0 * tau * tau);
    s->forcing->inflow = area > 0.0 ? (w->missing / tau + w->lasting) / area : 0.0;
}

void water_budget_judge(const struct fv *s, struct water_budget *w, struct diagnosis *d)
{
    const double whole = w->start + s->surface->entered;
    if (watch_judge(&w->watched, fabs(w->missing) / whole, s->t, s->run->step, d))
        snprintf(d->where, sizeof d->where, "all water, %g m^%d, t = %.4g s", whole, s->b.dim,
                 s->t);
}

void water_budget_save(const struct water_budget *w, struct h5 *f)
{
    h5_attribute_real(f, "water_start", w->start);
    h5_attribute_real(f, "water_missing", w->missing);
    h5_attribute_real(f, "water_lasting", w->lasting);
    h5_attribute_real(f, "water_drops", w->drops);
    h5_attribute_real(f, "water_worst", w->watched.worst);
}

bool water_budget_load(struct water_budget *w, struct h5 *f)
{
    return h5_read_attribute_real(f, "water_start", &w->start) &&
           h5_read_attribute_real(f, "water_missing", &w->missing) &&
           h5_read_attribute_real(f, "water_lasting", &w->lasting) &&
           h5_read_attribute_real(f, "water_drops", &w->drops) &&
           h5_read_attribute_real(f, "water_worst", &w->watched.worst);
}
