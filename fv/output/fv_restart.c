/* fv_restart.c - restart files: what a step starts from, on any number of ranks. Fields with all
 * their ghosts (so that the same ranks go on bit for bit; others gather them by layout.h), numbers
 * by name (fv_restart_numbers), then what watches, moving blocks, zones of waves and the coupling
 * keep of their own. SPDX-License-Identifier: BSD-3-Clause */

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

/* Names are unique in a file; who they belong to is said in messages alone. */
static void save_numbers(struct fv *s, struct h5 *f)
{
    struct kept_number all[FV_RESTART_NUMBERS];
    const int n = fv_restart_numbers(s, all);
    for (int k = 0; k < n; k++)
        h5_attribute_real(f, all[k].name, kept_number_get(all + k));
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
    struct kept_number all[FV_RESTART_NUMBERS];
    const int n = fv_restart_numbers(s, all);
    for (int k = 0; k < n; k++) {
        double value = 0.0;
        if (!there(h5_read_attribute_real(f, all[k].name, &value), all[k].of))
            return false;
        kept_number_set(all + k, value);
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

/* What the summary of the whole run needs of its past: the surface's oscillation, and forces on
 * blocks in each row of the series. A file that has none gives a summary of the rest of the run. */
static void keep_samples(struct fv *s, struct h5 *f)
{
    struct fv_output *o = s->output;
    if (s->surface)
        fit_restart(s->surface, &s->surface->oscillation, f);
    if (o && o->nhistory > 0 && h5_writes(f))
        (void)h5_keep_rows(f, "forces", "s, N, N", o->nhistory, 3, o->history[0]);
    int64_t n;
    double *rows = o && !h5_writes(f) ? h5_read_all_real(f, "forces", 3, &n) : NULL;
    if (!rows)
        return;
    ROOM_IN(o, o->history, n);
    o->nhistory = (int)n;
    memcpy(o->history, rows, (size_t)n * sizeof *o->history);
    mem_free(rows);
}

/* The layers of air as the last projection had them: with them the next step begins. */
static void save_layers(const struct fv *s, struct h5 *f)
{
    double *layers = NEW(double, s->size);
    for (int64_t i = 0; i < s->size; i++)
        layers[i] = s->surface->layer[i];
    h5_write_real(f, "layers", "-", s->size, 1, layers, false);
    FREE(layers);
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
    if (s->surface)
        save_layers(s, f);
    save_numbers(s, f);
    watches_restart(s->watches, f);
    moving_save(s, f);
    keep_samples(s, f);
    if (s->wave_zones)
        wave_zones_restart(s->wave_zones, f);
    if (s->link)
        (void)coupling_restart(s, f);
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

/* A field with its ghosts: bit for bit on the same ranks, else gathered. */
static bool restore_field(const struct fv *s, struct h5 *f, const struct layout *l,
                          const char *name, double *q)
{
    return layout_same_ranks(f, s->run->size) ? h5_read_real(f, name, s->size, 1, q)
                                              : gather(s, l, f, name, q);
}

static bool restore_fields(struct fv *s, struct h5 *f, const struct layout *l)
{
    double *fields[FV_RESTART_FIELDS];
    const char *names[FV_RESTART_FIELDS];
    const int n = fv_restart_fields(s, fields, names);
    for (int k = 0; k < n; k++)
        if (!restore_field(s, f, l, names[k], fields[k])) {
            log_say("the restart file has no field %s of this shape: was it written by another "
                    "integrator (fv.integrator), or without a free surface?",
                    names[k]);
            return false;
        }
    return true;
}

/* The surface where it is; then the layers that the step before had, and the fields anew, for what
 * is not near the surface of now has been cleared. */
static bool restore_surface(struct fv *s, struct h5 *f)
{
    struct layout *l = layout_load(f, "layout");
    double *layers = NEW(double, s->size);
    surface_rebuild(s);
    poisson_rebuild(s);
    bool good = there(restore_field(s, f, l, "layers", layers), "layers of air");
    if (good) {
        for (int64_t i = 0; i < s->size; i++)
            s->surface->layer[i] = (unsigned char)layers[i];
        near_water_find(s);
        for (int64_t i = 0; i < s->size && s->m; i++)
            s->free[i] = s->m->status[i] == CELL_COMPUTED && layers[i] == 0.0;
        good = restore_fields(s, f, l);
    }
    FREE(layers, l);
    return good;
}

/* false: another grid, or an older file of another number of ranks. */
static bool restore_grids(struct fv *s, struct h5 *f)
{
    struct layout *l = layout_load(f, "layout");
    const bool same = ranks_all(s->comm, h5_rows(f, "p") == s->size);
    bool fits = l || same;
    if (!fits)
        log_say("the restart file is of another grid or another number of ranks, and of an older "
                "version that does not say which");
    for (int k = 0; l && fits && k < grid_blocks(&s->grid); k++)
        fits = layout_fits(l, k, grid_cells(&s->grid, k));
    fits = fits && restore_fields(s, f, l);
    FREE(l);
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
    if (s->surface && !restore_surface(s, f))
        return false;
    outflow_restore(s);
    watches_restart(s->watches, f);
    keep_samples(s, f);
    if (s->wave_zones)
        wave_zones_restart(s->wave_zones, f);
    return there(!s->link || coupling_restart(s, f), "past of the coupling");
}
