/* cpl_declare.c - behind cpl.h: sets and fields of a solver, before the plan is checked.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cpl_client.h"

/* s is borrowed from c, as long as that lives. */
static int new_set(struct cpl *c, const char *name, int dim, struct client_set **s, int *id)
{
    if (c->state != MET)
        return client_out_of_order(c, "a set", "between cpl_meet and cpl_ready");
    if (c->nsets == LIMIT_SETS)
        return client_error(c, CPL_EINPUT, "more than %d sets", LIMIT_SETS);
    if (client_check_name(c, "set", name))
        return CPL_EINPUT;
    if (dim != 2 && dim != 3)
        return client_error(c, CPL_EINPUT, "set %s: dimension %d, not 2 or 3", name, dim);
    *id = c->nsets;
    *s = &c->set[c->nsets++];
    snprintf((*s)->name, sizeof(*s)->name, "%s", name);
    (*s)->dim = dim;
    return CPL_OK;
}

/* A flat grid is one cell thick, so that all loops run over three indices. */
int cpl_grid(struct cpl *c, const char *set, const struct cpl_grid *g, int *id)
{
    struct client_set *s = NULL;
    for (int a = 0; a < g->dim && a < 3; a++)
        if (!(g->spacing[a] > 0.0) || g->cells[a] < 1 || g->lo[a] < 0 || g->hi[a] > g->cells[a])
            return client_error(c, CPL_EINPUT, "grid %s: spacing, cells or block of axis %d", set,
                                a);
    const int code = new_set(c, set, g->dim, &s, id);
    if (code == CPL_OK) {
        s->is_grid = true;
        s->grid = *g;
        for (int a = g->dim; a < 3; a++) {
            s->grid.cells[a] = s->grid.hi[a] = 1;
            s->grid.lo[a] = s->grid.periodic[a] = 0;
            s->grid.origin[a] = 0.0;
            s->grid.spacing[a] = 1.0;
        }
    }
    return code;
}

/* A support of a set that only gives is not read. */
int cpl_points(struct cpl *c, const char *set, int dim, double support, int *id)
{
    struct client_set *s = NULL;
    const int code = new_set(c, set, dim, &s, id);
    if (code == CPL_OK)
        s->support = support;
    return code;
}

/* 0: none along that axis. */
int cpl_period(struct cpl *c, int set, const double period[3])
{
    if (c->state != MET || set < 0 || set >= c->nsets || c->set[set].is_grid)
        return client_out_of_order(c, "cpl_period", "after its set of points, before cpl_ready");
    for (int a = 0; a < 3; a++)
        if (!(period[a] >= 0.0) || isinf(period[a]))
            return client_error(c, CPL_EINPUT, "set %s: a period of %g m", c->set[set].name,
                                period[a]);
    memcpy(c->set[set].period, period, sizeof c->set[set].period);
    return CPL_OK;
}

int cpl_field(struct cpl *c, int set, const char *name, const char *unit, int ncomp, int d, int how,
              int *id)
{
    if (c->state != MET || set < 0 || set >= c->nsets)
        return client_out_of_order(c, "cpl_field", "after its set, before cpl_ready");
    if (client_check_name(c, "field", name) || client_check_name(c, "unit of a field", unit))
        return CPL_EINPUT;
    if (c->nfields == LIMIT_FIELDS)
        return client_error(c, CPL_EINPUT, "field %s: more than %d fields", name, LIMIT_FIELDS);
    if (ncomp < 1 || ncomp > 64)
        return client_error(c, CPL_EINPUT, "field %s: %d components, 1 to 64 are possible", name,
                            ncomp);
    if (d != CPL_PUT && d != CPL_GET && d != (CPL_PUT | CPL_OPTIONAL))
        return client_error(c, CPL_EINPUT, "field %s: %d is no direction (CPL_PUT, CPL_GET)", name,
                            d);
    *id = c->nfields;
    struct client_field *f = &c->field[c->nfields++];
    *f = (struct client_field){.set = set, .ncomp = ncomp, .how = how, .direction = d};
    snprintf(f->name, sizeof f->name, "%s", name);
    snprintf(f->unit, sizeof f->unit, "%s", unit);
    f->last_tick = f->got_tick = f->slot[0].tick = f->slot[1].tick = -1;
    return CPL_OK;
}
