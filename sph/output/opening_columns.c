/* opening_columns.c - what has passed inlets, outlets and sides where water falls out. For each
 * such side the mass that has come in less what has gone out since the start, kg, and with a free
 * surface the level outside, m: columns of the series, sums of the summary, and the balance of the
 * run's mass. At zones that is what the outer solution brings: particles there exchange mass with
 * the lattice behind the faces, too, so that those which leave do not tell it.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "opening_columns.h"

#include "../open_boundaries/sph_open_boundaries.h"
#include "../particles/sph_particles.h"

/* What a side of the region is to what passes it. */
enum passing { PASSES_NOTHING, PASSES_FALLING, PASSES_ZONE };

/* What passes this side: zones are of this run's own inlets and outlets, not a partner's. */
static enum passing passing(const struct sph *s, int side)
{
    const struct scene_wall *w = scene_wall_of(&s->run->scene, SIDE_X_MIN + side);
    const bool open = s->zones && s->prm.outer == OUTER_SIDES && s->open[side];
    return w && w->kind == WALL_FALLS ? PASSES_FALLING : open ? PASSES_ZONE : PASSES_NOTHING;
}

/* Mass through each side since the start, kg, positive inwards, summed over levels and ranks.
 * Collective. */
static void sum_through(const struct sph *s, double through[6])
{
    for (int side = 0; side < 6; side++) {
        through[side] = s->zones ? s->zones->openings->through[side] : 0.0;
        for (const struct sph *q = s; q; q = q->finer)
            through[side] -= q->total.fallen[side];
    }
    MPI_Allreduce(MPI_IN_PLACE, through, 6, MPI_DOUBLE, MPI_SUM, s->run->comm);
}

/* A column for each side that something passes, and one for its level. */
void opening_row(const struct sph *s, struct figures *to)
{
    double through[6];
    sum_through(s, through);
    for (int side = 0; side < 2 * s->dim; side++) {
        const enum passing is = passing(s, side);
        if (is != PASSES_NOTHING)
            FIGURE(to, through[side], "through %s [kg]", scene_side_names[side]);
        if (is == PASSES_ZONE && s->surface)
            FIGURE(to, s->zones->update ? sides_level(s, side) : wave_stream_level(s, side),
                   "level %s [m]", scene_side_names[side]);
    }
}

/* drift.budget: the mass at the end, with what faces hold that has come in and is no whole particle
 * yet, less that of the start and what has passed, over what was there and came in. */
void opening_summary(const struct sph *s, struct summary *to)
{
    const double held = s->zones ? openings_held(s) : 0.0;
    double through[6], sum = 0.0, in = s->start.mass;
    bool any = s->prm.outer == OUTER_EXACT && s->zones && s->zones->surface;
    if (any)
        summary_real(to, "faces_hold", held / s->start.mass);
    sum_through(s, through);
    for (int side = 0; side < 2 * s->dim; side++) {
        sum += through[side]; /* what has gone over a side without a wall, too */
        in += fmax(through[side], 0.0);
        if (passing(s, side) == PASSES_NOTHING)
            continue;
        any = true;
        summary_real(to, key_text("through.%s", scene_side_names[side]), through[side]);
    }
    if (any)
        summary_real(to, "drift.budget", (zones_mass(s) + held - sum - s->start.mass) / in);
}
