/* carried.c - lists of openings whose values change with the flow. An opening is listed once for
 * each part of this rank that has some of it; what all its parts share (mean velocities, areas) is
 * kept by side of the domain in struct outflows and struct levels. outflow.c and levels.c fill in
 * the values.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "carried.h"

enum outflow_kind carried_kind(const struct scene_wall *w)
{
    if (w->kind == WALL_INFLOW)
        return w->has_discharge ? OUTFLOW_GIVEN_IN : OUTFLOW_STEADY;
    return w->has_discharge ? OUTFLOW_GIVEN_OUT : OUTFLOW_CONVECTS;
}

enum mesh_side carried_side(const struct fv *s, const struct scene_wall *w, enum mesh_side kind)
{
    const bool listed = s->prm.water && s->prm.integrator != INTEGRATOR_NEWTON;
    return w && listed && kind == MESH_INFLOW ? MESH_CARRIED : kind;
}

/* any and convects are the same on all ranks, so that collective calls are made by all or none. */
void carried_create(struct fv *s)
{
    const struct scene *scene = &s->run->scene;
    bool any = false, convects = false, steady = false;
    for (int k = 0; k < scene->nwalls; k++) {
        const struct scene_wall *w = scene->walls + k;
        const bool listed = carried_side(s, w, side_of_wall(w)) == MESH_CARRIED;
        convects = convects || w->carried;
        steady = steady || (listed && carried_kind(w) == OUTFLOW_STEADY);
        any = any || listed;
    }
    if (!any)
        return;
    s->outflows = NEW_IN(s, struct outflows, 1);
    s->outflows->convects = convects;
    s->outflows->steady = steady;
    for (int q = 0; q < s->dim; q++)
        s->outflows->kept[q] = NEW_IN(s->outflows, double, s->size);
}

/* Everything is under water (share, wet 1) until a surface says otherwise. */
struct outflow *carried_add(void *owner, struct outflow **list, int *count, int dim, int side,
                            int a, int64_t in, int64_t n, int64_t values)
{
    GROW_IN(owner, *list, *count, *count + 1);
    struct outflow *o = *list + (*count)++;
    *o = (struct outflow){.side = side, .a = a, .in = in, .face = in < 0 ? -in : 0};
    o->place = NEW_IN(owner, int64_t, n);
    o->cell = NEW_IN(owner, int64_t, n);
    o->own = NEW_IN(owner, bool, n);
    o->share = NEW_IN(owner, double, n);
    o->wet = NEW_IN(owner, double, n);
    for (int64_t i = 0; i < n; i++)
        o->share[i] = o->wet[i] = 1.0;
    o->h = NEW_IN(owner, double, n);
    for (int q = 0; q < dim; q++) {
        o->S[q] = NEW_IN(owner, double, n);
        o->line[q] = NEW_IN(owner, double, 3 * n);
        o->change[q] = NEW_IN(owner, double, values);
    }
    return o;
}

/* m^dim/s, by the side's area towards larger indices. */
double carried_flux(const struct outflow *o, int dim, int64_t i)
{
    double sum = 0.0;
    for (int q = 0; q < dim; q++)
        sum += o->S[q][i] * o->w[q][o->place[i]];
    return sum;
}

double carried_area(const struct outflow *o, int64_t i)
{
    const double S[3] = {o->S[0][i], o->S[1][i], o->S[2] ? o->S[2][i] : 0.0};
    return vec3_length(S);
}

/* Where water stood outside it stands still: ghosts are no drier than that level. */
void carried_level_ghosts(const struct fv *s, double *phi)
{
    OUTFLOWS (s, o)
        for (int64_t i = 0; i < o->n && o->stood; i++)
            for (int m = 1; m <= GHOSTS && o->stood[i] > 0.0; m++) {
                double *q = phi + o->cell[i] - m * o->in;
                *q = fmin(*q, o->level[i]);
            }
}

/* What comes in brings the share that stood there. */
void carried_share_ghosts(const struct fv *s, double *C)
{
    OUTFLOWS (s, o)
        for (int64_t i = 0; i < o->n && o->stood; i++)
            for (int m = 1; m <= GHOSTS; m++)
                C[o->cell[i] - m * o->in] = o->full[i];
}
