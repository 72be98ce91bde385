/* moved_box.c - see moved_box.h. SPDX-License-Identifier: BSD-3-Clause */
#include "moved_box.h"

#include <string.h>

#include "../../common/mem.h"
#include "../boundary/forcing.h"
#include "../poisson/pressure.h"
#include "../surface/levelset.h"
#include "../surface/surface_forced.h"
#include "../time/stages.h"

static bool differs(const struct fv *s, const struct forcing *f)
{
    int other = memcmp(f->forced, s->forcing->forced, (size_t)s->size) != 0;
    MPI_Allreduce(MPI_IN_PLACE, &other, 1, MPI_INT, MPI_MAX, s->comm);
    return other != 0;
}

/* The values of the new lists: the partner's, where the old lists had them, else FV's own. */
static void carry(const struct fv *s, struct forcing *to)
{
    const struct forcing *from = s->forcing;
    double *field = NEW(double, s->size);
    for (int m = 0; m < 3; m++)
        for (int a = 0; a < s->dim; a++) {
            const double *v = m == 0 ? from->v_next[a] : m == 1 ? from->v[a] : from->v_old[a];
            double *w = m == 0 ? to->v_next[a] : m == 1 ? to->v[a] : to->v_old[a];
            memcpy(field, m == 0 ? s->u[a] : s->past[m - 1][a], (size_t)s->size * sizeof *field);
            for (int64_t i = 0; i < from->npartner + from->nrim; i++)
                field[from->partner[i]] = v[i];
            for (int64_t i = 0; i < to->npartner + to->nrim; i++)
                w[i] = field[to->partner[i]];
        }
    mem_free(field);
    to->t0 = from->t0;
    to->t1 = from->t1;
    to->t_old = from->t_old;
    to->levels = from->levels;
    to->inflow = from->inflow;
}

/* The partner's surface of the last window, where both lists have it. */
static void carry_surface(struct fv *s, struct surface_forced *from)
{
    struct surface_forced *to = surface_forced_create(s);
    for (int k = 0; k < 2; k++) {
        to->t[k] = from->t[k];
        for (int64_t i = 0; i < from->n; i++)
            to->phi[k][from->cell[i]] = from->phi[k][from->cell[i]];
    }
    s->surface->forced = to;
    surface_forced_free(&from);
}

enum moved moved_box(struct fv *s, int n, const double (*box)[2][3])
{
    struct forcing *f = forcing_create(s, n, box, true);
    if (!f)
        return MOVED_LOST;
    if (!differs(s, f)) {
        forcing_free(&f);
        return MOVED_NOT;
    }
    forcing_extend(s, s->forcing->near, s->p);
    forcing_extend(s, s->forcing->near, s->p_before);
    carry(s, f);
    const double before = s->surface ? surface_volume(s, NULL) : 0.0;
    forcing_free(&s->forcing);
    s->forcing = f;
    if (s->surface) {
        carry_surface(s, s->surface->forced);
        surface_outline_moved(s, before);
        return MOVED;
    }
    pressure_free(&s->pressure);
    s->pressure = pressure_create(s);
    return MOVED;
}
