/* fraction_bounds.c - water beyond 1 or below 0 of a cell goes to the cells beside it that have
 * room, or something to give, in proportion; what finds none goes on towards the surface. All cells
 * at once, so that ranks make no difference. SPDX-License-Identifier: BSD-3-Clause */
#include "fraction.h"

#include "levelset.h"
#include "mesh_view.h"

enum { PASSES = 12 };
#define ROUNDING 1e-12

static bool takes_part(const struct fv *s, int64_t c) { return !surface_holds_none(s, c); }

/* What cell c has beyond its bounds; rounding apart. */
static double excess(double C) { return C > 1.0 + ROUNDING ? C - 1.0 : C < -ROUNDING ? C : 0.0; }

/* How much of the excess e of a cell its neighbour i takes, up to a factor. */
static double weight(const struct fv *s, double e, int64_t from, int64_t i, bool passes_on)
{
    const struct fraction *f = s->surface->fraction;
    const double C = lesser(1.0, greater(0.0, f->C[i])), *phi = s->surface->phi;
    if (!takes_part(s, i))
        return 0.0;
    if (passes_on)
        return (e > 0.0) == (phi[i] > phi[from]) ? 1.0 : 0.0;
    return f->volume[i] * (e > 0.0 ? 1.0 - C : C);
}

/* A cell's share of its excess for each unit of weight, in work; whom no neighbour can serve passes
 * on to those nearer the surface, in next. Volumes. */
static bool find_shares(struct fv *s)
{
    struct fraction *f = s->surface->fraction;
    bool any = false;
    FLOW_NEAR_AT (s, part, j, c, n)
        for (int64_t i = c; i < c + n; i++) {
            const double e = takes_part(s, i) ? excess(f->C[i]) : 0.0;
            double sum = 0.0, sum_on = 0.0;
            f->work[i] = f->next[i] = 0.0;
            if (e == 0.0)
                continue;
            for (int a = 0; a < s->dim; a++)
                for (int up = -1; up <= 1; up += 2) {
                    sum += weight(s, e, i, i + up * part->stride[a], false);
                    sum_on += weight(s, e, i, i + up * part->stride[a], true);
                }
            any = true;
            if (sum > 0.1 * fabs(e) * f->volume[i])
                f->work[i] = e * f->volume[i] / sum;
            else if (sum_on > 0.0)
                f->next[i] = e * f->volume[i] / sum_on;
        }
    return ranks_any(s->comm, any);
}

/* What cell i gets from those beside it. */
static double received(const struct fv *s, const struct part *p, int64_t i)
{
    const struct fraction *f = s->surface->fraction;
    double sum = 0.0;
    for (int a = 0; a < s->dim; a++)
        for (int up = -1; up <= 1; up += 2) {
            const int64_t from = i + up * p->stride[a];
            if (f->work[from] != 0.0)
                sum += f->work[from] * weight(s, f->work[from], from, i, false);
            if (f->next[from] != 0.0)
                sum += f->next[from] * weight(s, f->next[from], from, i, true);
        }
    return sum;
}

/* Cells give, and get into flux, which is scratch here; what they gave, m^dim, of this rank. */
static double exchange(struct fv *s)
{
    struct fraction *f = s->surface->fraction;
    double moved = 0.0;
    double *const fields[2] = {f->work, f->next};
    grid_fill(&s->grid, 2, fields);
    FLOW_NEAR_AT (s, part, j, c, n)
        for (int64_t i = c; i < c + n; i++)
            f->flux[i] = takes_part(s, i) ? received(s, part, i) / f->volume[i] : 0.0;
    FLOW_NEAR (s, c, n)
        for (int64_t i = c; i < c + n; i++) {
            if (f->work[i] != 0.0 || f->next[i] != 0.0) {
                const double e = excess(f->C[i]);
                moved += fabs(e) * f->volume[i];
                f->C[i] -= e;
            }
            f->C[i] += f->flux[i];
        }
    surface_mirror(s, f->C);
    return moved;
}

/* What is left is rounding. */
static void cut(struct fv *s)
{
    struct fraction *f = s->surface->fraction;
    FLOW_NEAR (s, c, n)
        for (int64_t i = c; i < c + n; i++) {
            if (fabs(f->C[i]) <= ROUNDING)
                f->C[i] = 0.0;
            else if (fabs(f->C[i] - 1.0) <= ROUNDING)
                f->C[i] = 1.0;
        }
    surface_mirror(s, f->C);
}

double fraction_bound(struct fv *s)
{
    struct fraction *f = s->surface->fraction;
    /* beyond periods and other ranks both are 0 unless they are sent */
    grid_clear_near(&s->grid, f->work);
    grid_clear_near(&s->grid, f->next);
    double moved = 0.0;
    for (int k = 0; k < PASSES && find_shares(s); k++)
        moved += exchange(s);
    cut(s);
    return moved;
}
