/* held_inflow.c - inflows of given velocity or discharge that are faster than their waves, or lie
 * across gravity. Nothing that happens inside runs up to such an opening, so two things are given
 * there: the velocity u and the water that stood in it at the start, the share C_0 of each cell.
 * What splashes to the side or stands on the current is not fed; beside the water of the start the
 * side is closed to water. What comes in through a face is U C = u C_0 |S| with C the larger one of
 * C_0 and the share inside, so U = u C_0/C |S|: a jump that covers the opening is fed by a jet.
 * Behind the face the level is no lower than that of the start.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "held_inflow.h"

#include "../boundary/fv_boundary.h"
#include "fraction.h"
#include "level_ops.h"
#include "levelset.h"

/* Shares of water of the cells beside inflows, those of other ranks included: a field. Of phi they
 * are in scratch. */
static const double *shares(const struct fv *s)
{
    const struct surface *f = s->surface;
    if (f->fraction && f->fraction->carries > 0.0)
        return f->fraction->C;
    memset(f->kept, 0, (size_t)s->size * sizeof(double));
    OUTFLOWS (s, o)
        for (int64_t i = 0; i < o->n; i++)
            if (carried_comes_in(o) && o->own[i])
                f->kept[o->cell[i]] = surface_share(s, o->cell[i]);
    f->ops->mirror(s, f->kept);
    return f->kept;
}

/* m/s: mean velocity inwards of the water at each side of the domain where it is given. area:
 * m^(dim-1), of that water. Collective. */
static void speeds_of(const struct fv *s, const double *share, const double area[6], double V[6])
{
    memset(V, 0, 6 * sizeof *V);
    OUTFLOWS (s, o)
        for (int64_t i = 0; i < o->n; i++)
            if (o->own[i] && o->kind == OUTFLOW_STEADY)
                V[o->side] -= share[o->cell[i]] * carried_flux(o, s->dim, i);
    MPI_Allreduce(MPI_IN_PLACE, V, 6, MPI_DOUBLE, MPI_SUM, s->comm);
    for (int k = 0; k < 6; k++) {
        const struct scene_wall *w = scene_wall_of(&s->run->scene, SIDE_X_MIN + k);
        if (w && w->kind == WALL_INFLOW && w->has_discharge)
            V[k] = wall_discharge(w, s->t);
        V[k] /= fmax(area[k], 1e-300);
    }
}

/* Takes the water of now for that of the start. */
static void hold(const struct fv *s, const double *share, struct outflow *o)
{
    o->level = NEW_IN(s->outflows, double, o->n);
    o->stood = NEW_IN(s->outflows, double, o->n);
    o->full = NEW_IN(s->outflows, double, o->n);
    for (int64_t i = 0; i < o->n; i++) {
        o->level[i] = s->surface->phi[o->cell[i]];
        o->full[i] = o->stood[i] = fmin(share[o->cell[i]], 1.0);
    }
    for (int q = 0; q < s->dim; q++) {
        o->given[q] = NEW_IN(s->outflows, double, o->n);
        for (int64_t i = 0; i < o->n; i++)
            o->given[q][i] = o->w[q][o->place[i]];
    }
}

/* Of inlets that water has not come to: they cannot begin. */
static void tell_dry(const struct fv *s)
{
    for (int k = 0; k < s->run->scene.nwalls; k++) {
        const struct scene_wall *w = s->run->scene.walls + k;
        const int side = w->side - SIDE_X_MIN;
        if (w->kind != WALL_INFLOW || w->side == SIDE_NONE || !s->levels || s->surface->g == 0.0 ||
            s->surface->forced)
            continue;
        if ((w->has_level ? s->levels->waves : s->outflows->waves)[side] == 0.0)
            log_warn("%s: no water stands in this inflow at the start: nothing comes in before "
                     "water runs there; a shape beside it lets it begin at once",
                     scene_side_names[side]);
    }
}

void held_choose(struct fv *s)
{
    struct outflows *all = s->outflows;
    double V[6];
    tell_dry(s);
    if (!all)
        return;
    const double *share = shares(s);
    speeds_of(s, share, all->area, V);
    for (int k = 0; k < 6; k++) {
        const bool lies = k / 2 == still_upright(&s->run->scene); /* no level stands in it */
        all->held[k] = all->area[k] > 0.0 && V[k] > (lies ? 0.0 : all->waves[k]);
        if (all->held[k])
            log_say("%s: %.3g m/s%s: what stands in it at the start comes in, whatever happens "
                    "inside; beside that it is closed to water",
                    scene_side_names[k], V[k], lies ? "" : ", faster than its waves");
    }
    OUTFLOWS (s, o)
        if (carried_comes_in(o) && all->held[o->side])
            hold(s, share, o);
}

void held_measure(struct fv *s)
{
    bool any = false;
    for (int k = 0; k < 6 && s->outflows; k++)
        any = any || s->outflows->held[k];
    if (!any)
        return;
    const double *share = shares(s);
    OUTFLOWS (s, o)
        for (int64_t i = 0; i < o->n && o->stood; i++)
            if (o->stood[i] > 0.0)
                o->full[i] = fmax(o->stood[i], fmin(1.0, share[o->cell[i]]));
}
