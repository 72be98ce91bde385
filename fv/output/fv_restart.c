/* fv_restart.c - restart files: what a step starts from, on any number of ranks. Fields with all
 * their ghosts (so that the same ranks go on bit for bit; others gather them by layout.h), numbers
 * by name (kept_numbers), then what watches, moving blocks, zones of waves and the coupling keep of
 * their own.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <string.h>

#include "../../common/base/base.h"
#include "../../common/files/files.h"
#include "../../common/scene/scene.h"
#include "../boundary/fv_boundary.h"
#include "../coupling/fv_coupling.h"
#include "../fv.h"
#include "../grid/fv_grid.h"
#include "../poisson/poisson.h"
#include "../surface/fv_surface.h"
#include "../time/fv_time.h"
#include "../watch/fv_watch.h"
#include "output.h"

/* A number that a run goes on with; one of the three places is given. */
struct kept_number {
    const char *name, *of; /* of the attribute; what it belongs to */
    double *real;
    int64_t *count;
    bool *flag;
};
enum { NUMBERS_MAX = 48 };
struct kept_numbers {
    int n;
    struct kept_number is[NUMBERS_MAX];
};

static void add(struct kept_numbers *to, const char *of, const struct kept_number *list, int n)
{
    for (int k = 0; k < n; k++) {
        to->is[to->n] = list[k];
        to->is[to->n++].of = of;
    }
}

#define ADD(to, of, list) add(to, of, list, (int)(sizeof(list) / sizeof *(list)))

/* Volumes, fractions and a partner's surface as far as this run has them. */
static void add_surface(struct kept_numbers *to, struct surface *f)
{
    const struct kept_number volumes[] = {
        {"volume0", .real = &f->volume0},     {"returned", .real = &f->returned},
        {"lost", .real = &f->lost},           {"gained", .real = &f->gained},
        {"travelled", .real = &f->travelled}, {"passed", .real = &f->passed}};
    ADD(to, "surface", volumes);
    if (f->fraction) {
        struct fraction *q = f->fraction;
        const struct kept_number shares[] = {{"carries", .real = &q->carries},
                                             {"calm", .real = &q->calm},
                                             {"first_axis", .real = &q->first}};
        ADD(to, "shares of water", shares);
    }
    if (f->forced) {
        const struct kept_number forced[] = {{"phi_start_t", .real = f->forced->t},
                                             {"phi_end_t", .real = f->forced->t + 1},
                                             {"entered", .real = &f->entered}};
        ADD(to, "surface of a partner", forced);
    }
}

static void add_openings(struct kept_numbers *to, struct levels *l)
{
    static const char *const names[LEVEL_GROUPS] = {
        "outflow_x_min", "outflow_x_max", "outflow_y_min", "outflow_y_max",
        "outflow_z_min", "outflow_z_max", "outflow_others"};
    for (int k = 0; k < LEVEL_GROUPS; k++) {
        const struct kept_number mean[] = {{names[k], .real = l->past + k}};
        ADD(to, "mean velocity of the openings", mean);
    }
}

static void add_discharges(struct kept_numbers *to, struct outflows *o)
{
    static const char *const names[6] = {"lacks_x_min", "lacks_x_max", "lacks_y_min",
                                         "lacks_y_max", "lacks_z_min", "lacks_z_max"};
    for (int k = 0; k < 6; k++) {
        const struct kept_number lacks[] = {{names[k], .real = o->lacks + k}};
        ADD(to, "volume that given discharges lack", lacks);
    }
}

static void add_newton(struct kept_numbers *to, struct newton *w)
{
    const struct kept_number newton[] = {
        {"dtau", .real = &w->dtau},        {"longest_step", .real = &w->longest_step},
        {"pace", .real = &w->pace},        {"residual", .real = &w->norm},
        {"steady", .flag = &w->steady},    {"best", .real = &w->best},
        {"best_at", .count = &w->best_at}, {"pseudo_steps", .count = &w->pseudo_steps},
        {"newtons", .count = &w->newtons}, {"krylovs", .count = &w->krylovs}};
    ADD(to, "state of Newton's method", newton);
}

/* One list for saving and loading: members of the state, as pointers. */
static struct kept_numbers numbers_of(struct fv *s)
{
    struct kept_numbers all = {0};
    const struct kept_number steps[] = {{"dt", .real = &s->step.dt},
                                        {"dt_old", .real = &s->step.dt_old}};
    ADD(&all, "time step", steps);
    if (s->newton)
        add_newton(&all, s->newton);
    if (s->surface)
        add_surface(&all, s->surface);
    if (levels_set_any(s))
        add_openings(&all, s->levels);
    if (s->surface && s->outflows)
        add_discharges(&all, s->outflows);
    return all;
}

static void save_numbers(struct fv *s, struct h5 *f)
{
    const struct kept_numbers all = numbers_of(s);
    for (const struct kept_number *x = all.is; x < all.is + all.n; x++)
        h5_attribute_real(f, x->name,
                          x->real    ? *x->real
                          : x->count ? (double)*x->count
                                     : (double)*x->flag);
}

/* Says what is not there. */
static bool there(bool good, const char *what)
{
    if (!good)
        log_say("the restart file has no %s that fits this case", what);
    return good;
}

/* A number that is missing names what it belongs to. */
static bool load_numbers(struct fv *s, struct h5 *f)
{
    const struct kept_numbers all = numbers_of(s);
    for (const struct kept_number *x = all.is; x < all.is + all.n; x++) {
        double value = 0.0;
        if (!there(h5_read_attribute_real(f, x->name, &value), x->of))
            return false;
        if (x->real)
            *x->real = value;
        else if (x->count)
            *x->count = llround(value);
        else
            *x->flag = value != 0.0;
    }
    return true;
}

/* What this rank has of each grid: of the uniform one, or of each block; empty where it has none.
 */
static int boxes_of(const struct fv *s, struct layout_box *of)
{
    const int n = grid_blocks(&s->grid);
    for (int k = 0; k < n; k++)
        of[k] = (struct layout_box){.grid = k};
    for (int q = 0; q < s->grid.nparts; q++) {
        const struct part *p = s->grid.part + q;
        struct layout_box *x = of + p->block;
        memcpy(x->lo, p->lo, sizeof x->lo);
        memcpy(x->n, p->n, sizeof x->n);
        memcpy(x->g, p->g, sizeof x->g);
        x->base = p->base;
    }
    return n;
}

/* Collective; nothing in the state changes. */
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
    save_numbers(s, f);
    watches_save(s->watches, f);
    moving_save(s, f);
    if (s->wave_zones)
        wave_zones_save(s->wave_zones, f, s->run->rank == 0);
    if (s->link)
        coupling_save(s, f);
}

/* A field of all grids; ghosts behind sides of blocks are those that were beside the same cells. to
 * points at the part's first ghost. */
static bool gather(const struct fv *s, const struct layout *l, struct h5 *f, const char *name,
                   double *q)
{
    struct layout_box mine[MESH_BLOCKS_MAX];
    const int n = boxes_of(s, mine);
    bool good = true;
    for (int k = 0; good && k < n; k++)
        good = layout_read(l, f, name, 1, mine + k, grid_periodic(&s->grid), q + mine[k].base);
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

/* false: another grid, or an older file of another number of ranks. */
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
    for (int k = 0; l && fits && k < grid_blocks(&s->grid); k++)
        fits = layout_fits(l, k, grid_cells(&s->grid, k));
    fits = fits && restore_fields(s, f, l);
    layout_free(&l);
    return fits;
}

/* First where sph.box stands, since it decides which cells are imposed; then fields, numbers,
 * blocks that move; what follows from them is rebuilt. */
bool fv_restore(struct fv *s, struct h5 *f)
{
    if (!there(coupling_stand(s, f), "place of sph.box") || !restore_grids(s, f))
        return false;
    if (!load_numbers(s, f) || !there(moving_restore(s, f), "cut of blocks that move"))
        return false;
    if (s->surface) {
        surface_rebuild(s);
        poisson_rebuild(s);
    }
    outflow_restore(s);
    watches_load(s->watches, f);
    if (s->wave_zones)
        wave_zones_load(s->wave_zones, f);
    return there(!s->link || coupling_load(s, f), "past of the coupling");
}
