/* opening_columns.c - see opening_columns.h. SPDX-License-Identifier: BSD-3-Clause */
#include "opening_columns.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../open_boundaries/openings.h"
#include "../open_boundaries/sides.h"
#include "../open_boundaries/zone_steps.h"
#include "../particles/params_derived.h"

int opening_columns(const struct run *r, const struct sph_params *prm, const char **names)
{
    static char text[6][2][32];
    bool open[6];
    int n = 0;
    if (prm->outer != OUTER_SIDES)
        return 0;
    sph_params_open(r, prm, open);
    for (int side = 0; side < 2 * r->scene.domain.dim; side++) {
        if (!open[side])
            continue;
        snprintf(text[side][0], sizeof text[side][0], "through %s [kg]", scene_side_names[side]);
        snprintf(text[side][1], sizeof text[side][1], "level %s [m]", scene_side_names[side]);
        names[n++] = text[side][0];
        if (prm->surface == SURFACE_YES)
            names[n++] = text[side][1];
    }
    return n;
}

static void sum_through(const struct sph *s, double through[6])
{
    memcpy(through, s->zones->openings->through, 6 * sizeof *through);
    MPI_Allreduce(MPI_IN_PLACE, through, 6, MPI_DOUBLE, MPI_SUM, s->run->comm);
}

double *opening_row(const struct sph *s, double *values)
{
    double through[6];
    if (!s->zones || s->prm.outer != OUTER_SIDES)
        return values;
    sum_through(s, through);
    for (int side = 0; side < 2 * s->dim; side++) {
        if (!s->open[side])
            continue;
        *values++ = through[side];
        if (s->surface)
            *values++ = sides_level(s, side);
    }
    return values;
}

/* What the mass at the end differs from that of the start and what has passed, over what was there
 * and came in. */
void opening_summary(const struct sph *s, struct summary *to)
{
    double through[6], sum = 0.0, in = s->start.mass;
    char name[32];
    if (s->prm.outer != OUTER_SIDES)
        return;
    sum_through(s, through);
    for (int side = 0; side < 2 * s->dim; side++) {
        if (!s->open[side])
            continue;
        snprintf(name, sizeof name, "through.%s", scene_side_names[side]);
        summary_real(to, name, through[side]);
        sum += through[side];
        in += fmax(through[side], 0.0);
    }
    summary_real(to, "drift.budget", (zones_mass(s) - sum - s->start.mass) / in);
}
