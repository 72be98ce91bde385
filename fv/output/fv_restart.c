/* fv_restart.c - restart files: what a step starts from, on any number of ranks.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <string.h>

#include "../../common/base/log.h"
#include "../../common/files/h5.h"
#include "../boundary/levels.h"
#include "../boundary/outflow.h"
#include "../coupling/fv_link.h"
#include "../fv.h"
#include "../grid/layout.h"
#include "../grid/mesh.h"
#include "../poisson/poisson.h"
#include "../surface/fraction.h"
#include "../surface/levelset.h"
#include "../surface/surface_forced.h"
#include "../time/moving.h"
#include "../time/newton.h"
#include "../time/stages.h"
#include "../time/steps.h"
#include "../watch/watches.h"
#include "output.h"

enum { SURFACE_NUMBERS = 6 };
static const char *const surface_numbers[SURFACE_NUMBERS] = {"volume0", "returned",  "lost",
                                                             "gained",  "travelled", "passed"};

enum { FRACTION_NUMBERS = 3 };
static const char *const fraction_numbers[FRACTION_NUMBERS] = {"carries", "calm", "first_axis"};

static double *fraction_number(struct fraction *f, int k)
{
    double *const of[FRACTION_NUMBERS] = {&f->carries, &f->calm, &f->first};
    return of[k];
}

static const char *const level_numbers[LEVEL_GROUPS] = {
    "outflow_x_min", "outflow_x_max", "outflow_y_min", "outflow_y_max",
    "outflow_z_min", "outflow_z_max", "outflow_others"};

enum { FORCED_NUMBERS = 3 };
static const char *const forced_numbers[FORCED_NUMBERS] = {"phi_start_t", "phi_end_t", "entered"};

static double *forced_number(struct surface *f, int k)
{
    return k < 2 ? f->forced->t + k : &f->entered;
}

static double *surface_number(struct surface *f, int k)
{
    double *const of[SURFACE_NUMBERS] = {&f->volume0, &f->returned,  &f->lost,
                                         &f->gained,  &f->travelled, &f->passed};
    return of[k];
}

/* What this rank has of each grid: of the uniform one, or of each block; empty where it has none.
 */
static int boxes_of(const struct fv *s, struct layout_box *of)
{
    const int n = s->m ? s->m->nblocks : 1;
    for (int k = 0; k < n; k++)
        of[k] = (struct layout_box){.grid = k};
    for (int q = 0; q < s->nparts; q++) {
        const struct part *p = s->part + q;
        struct layout_box *x = of + p->block;
        memcpy(x->lo, p->lo, sizeof x->lo);
        memcpy(x->n, p->n, sizeof x->n);
        memcpy(x->g, p->g, sizeof x->g);
        x->base = p->base;
    }
    return n;
}

static void save_newton(const struct newton *w, struct h5 *f)
{
    h5_attribute_real(f, "dtau", w->dtau);
    h5_attribute_real(f, "longest_step", w->longest_step);
    h5_attribute_real(f, "pace", w->pace);
    h5_attribute_real(f, "residual", w->norm);
    h5_attribute_real(f, "steady", w->steady);
    h5_attribute_real(f, "best", w->best);
    h5_attribute_real(f, "best_at", (double)w->best_at);
    h5_attribute_real(f, "pseudo_steps", (double)w->pseudo_steps);
    h5_attribute_real(f, "newtons", (double)w->newtons);
    h5_attribute_real(f, "krylovs", (double)w->krylovs);
}

void fv_checkpoint(void *state, struct h5 *f)
{
    struct fv *s = state;
    double *fields[FV_RESTART_FIELDS];
    const char *names[FV_RESTART_FIELDS];
    struct layout_box mine[MESH_BLOCKS_MAX];
    const int n = fv_restart_fields(s, fields, names), grids = boxes_of(s, mine);
    layout_save(f, "layout", grids, mine);
    for (int k = 0; k < n; k++)
        h5_write_real(f, names[k], "-", s->size, 1, fields[k], false);
    h5_attribute_real(f, "dt", s->dt);
    h5_attribute_real(f, "dt_old", s->dt_old);
    if (s->newton)
        save_newton(s->newton, f);
    watches_save(s->watches, f);
    moving_save(s, f);
    if (s->surface)
        for (int k = 0; k < SURFACE_NUMBERS; k++)
            h5_attribute_real(f, surface_numbers[k], *surface_number(s->surface, k));
    for (int k = 0; levels_set_any(s) && k < LEVEL_GROUPS; k++)
        h5_attribute_real(f, level_numbers[k], s->levels->past[k]);
    for (int k = 0; s->surface && s->surface->fraction && k < FRACTION_NUMBERS; k++)
        h5_attribute_real(f, fraction_numbers[k], *fraction_number(s->surface->fraction, k));
    for (int k = 0; s->surface && s->surface->forced && k < FORCED_NUMBERS; k++)
        h5_attribute_real(f, forced_numbers[k], *forced_number(s->surface, k));
    if (s->link)
        coupling_save(s, f);
}

static bool restore_newton(struct newton *w, struct h5 *f)
{
    double steady = 0.0, newtons = 0.0, krylovs = 0.0, best_at = 0.0, steps = 0.0;
    const bool there = h5_read_attribute_real(f, "dtau", &w->dtau) &&
                       h5_read_attribute_real(f, "longest_step", &w->longest_step) &&
                       h5_read_attribute_real(f, "pace", &w->pace) &&
                       h5_read_attribute_real(f, "residual", &w->norm) &&
                       h5_read_attribute_real(f, "steady", &steady) &&
                       h5_read_attribute_real(f, "best", &w->best) &&
                       h5_read_attribute_real(f, "best_at", &best_at) &&
                       h5_read_attribute_real(f, "pseudo_steps", &steps) &&
                       h5_read_attribute_real(f, "newtons", &newtons) &&
                       h5_read_attribute_real(f, "krylovs", &krylovs);
    w->steady = steady != 0.0;
    w->best_at = llround(best_at);
    w->pseudo_steps = llround(steps);
    w->newtons = llround(newtons);
    w->krylovs = llround(krylovs);
    return there;
}

/* A field of all grids; ghosts behind sides of blocks are those that were beside the same cells. */
static bool gather(const struct fv *s, const struct layout *l, struct h5 *f, const char *name,
                   double *q)
{
    static const bool never[3] = {false, false, false};
    struct layout_box mine[MESH_BLOCKS_MAX];
    const int n = boxes_of(s, mine);
    bool good = true;
    for (int k = 0; good && k < n; k++)
        good = layout_read(l, f, name, 1, mine + k, s->m ? never : s->b.periodic, q + mine[k].base);
    return good;
}

/* Fields with their ghosts: bit for bit on the same ranks, else gathered. */
static bool restore_fields(struct fv *s, struct h5 *f, const struct layout *l)
{
    double *fields[FV_RESTART_FIELDS];
    const char *names[FV_RESTART_FIELDS];
    const int n = fv_restart_fields(s, fields, names);
    const bool same = layout_same_ranks(f, s->run->size);
    for (int k = 0; k < n; k++)
        if (!(same ? h5_read_real(f, names[k], s->size, 1, fields[k])
                   : gather(s, l, f, names[k], fields[k]))) {
            log_say("the restart file has no field %s of this shape: was it written by another "
                    "integrator (fv.integrator), or without a free surface?",
                    names[k]);
            return false;
        }
    return true;
}

static bool restore_grids(struct fv *s, struct h5 *f)
{
    struct layout *l = layout_load(f, "layout");
    int fits = h5_rows(f, "p") == s->size;
    MPI_Allreduce(MPI_IN_PLACE, &fits, 1, MPI_INT, MPI_MIN, s->comm);
    if (!l && !fits)
        log_say("the restart file is of another grid or another number of ranks, and of an older "
                "version that does not say which");
    else
        fits = 1;
    for (int k = 0; l && fits && k < (s->m ? s->m->nblocks : 1); k++)
        fits = layout_fits(l, k, s->m ? s->m->block[k].n : s->b.cells);
    fits = fits && restore_fields(s, f, l);
    layout_free(&l);
    return fits;
}

/* Says what is not there. */
static bool there(bool good, const char *what)
{
    if (!good)
        log_say("the restart file has no %s that fits this case", what);
    return good;
}

bool fv_restore(struct fv *s, struct h5 *f)
{
    if (!there(coupling_stand(s, f), "place of sph.box") || !restore_grids(s, f))
        return false;
    for (int k = 0; s->surface && k < SURFACE_NUMBERS; k++)
        if (!there(h5_read_attribute_real(f, surface_numbers[k], surface_number(s->surface, k)),
                   surface_numbers[k]))
            return false;
    for (int k = 0; levels_set_any(s) && k < LEVEL_GROUPS; k++)
        if (!there(h5_read_attribute_real(f, level_numbers[k], s->levels->past + k),
                   "mean velocity of the openings"))
            return false;
    for (int k = 0; s->surface && s->surface->fraction && k < FRACTION_NUMBERS; k++)
        if (!there(h5_read_attribute_real(f, fraction_numbers[k],
                                          fraction_number(s->surface->fraction, k)),
                   fraction_numbers[k]))
            return false;
    for (int k = 0; s->surface && s->surface->forced && k < FORCED_NUMBERS; k++)
        if (!there(h5_read_attribute_real(f, forced_numbers[k], forced_number(s->surface, k)),
                   forced_numbers[k]))
            return false;
    if (!there(moving_restore(s, f), "cut of blocks that move"))
        return false;
    if (s->surface) {
        surface_rebuild(s);
        poisson_rebuild(s);
    }
    outflow_restore(s);
    watches_load(s->watches, f);
    return there(h5_read_attribute_real(f, "dt", &s->dt) &&
                     h5_read_attribute_real(f, "dt_old", &s->dt_old),
                 "time step") &&
           there(!s->newton || restore_newton(s->newton, f), "state of Newton's method") &&
           there(!s->link || coupling_load(s, f), "past of the coupling");
}
