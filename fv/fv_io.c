/* fv_io.c - snapshots and restart files. SPDX-License-Identifier: BSD-3-Clause */
#include "fv.h"

#include <math.h>
#include <string.h>

#include "../common/h5.h"
#include "../common/log.h"
#include "../common/mem.h"
#include "../common/xdmf.h"
#include "forcing.h"
#include "layout.h"
#include "levelset.h"
#include "newton.h"
#include "outflow.h"
#include "rows.h"
#include "watches.h"

static int64_t local_cells(const struct block *b) { return (int64_t)b->n[0] * b->n[1] * b->n[2]; }

static bool idle(const struct fv *s, int64_t c)
{
    return (s->forcing && s->forcing->forced[c]) || (s->surface && s->surface->phi[c] >= 0.0);
}

/* Forced and dry cells hold what the stencils need, not a flow: no number in a picture. */
static void blank_idle(const struct fv *s, int ncomp, double *v)
{
    const struct block *b = &s->b;
    if (!s->forcing && !s->surface)
        return;
    BLOCK_CELLS (b, i, j, k, c) {
        for (int a = 0; idle(s, c) && a < ncomp; a++)
            v[a] = NAN;
        v += ncomp;
    }
}

static void write(const struct fv *s, struct h5 *f, const char *name, const char *unit, int ncomp,
                  double *v)
{
    const struct block *b = &s->b;
    if (*unit != '-')
        blank_idle(s, ncomp, v);
    h5_write_block(f, name, unit, b->dim, b->cells, b->lo, b->hi, ncomp, v, true);
}

static void write_velocity(const struct fv *s, struct h5 *f, double *v)
{
    const int64_t n = local_cells(&s->b);
    double *one = NEW(double, n);
    memset(v, 0, 3 * (size_t)n * sizeof(double));
    for (int a = 0; a < s->b.dim; a++) {
        block_pack(&s->b, s->u[a], one);
        for (int64_t i = 0; i < n; i++)
            v[3 * i + a] = one[i];
    }
    mem_free(one);
    write(s, f, "velocity", "m/s", 3, v);
}

/* Corners of the domain, for whoever draws. */
static void write_frame(const struct fv *s, struct h5 *f)
{
    static const char *const lo[] = {"xmin", "ymin", "zmin"}, *const hi[] = {"xmax", "ymax",
                                                                             "zmax"};
    for (int a = 0; a < s->b.dim; a++) {
        h5_attribute_real(f, lo[a], s->b.origin[a]);
        h5_attribute_real(f, hi[a], s->b.origin[a] + s->b.length[a]);
    }
    if (s->b.rows)
        h5_write_real(f, "rows", "m", s->run->rank == 0 ? s->b.cells[1] + 1 : 0, 1, s->b.rows->edge,
                      false);
    if (s->run->coupled) /* Pa: what the pressures below have of the partner's level */
        h5_attribute_real(f, "datum", coupling_datum(s));
}

/* Of a flat grid, in the first snapshot alone: they stay. */
static const char first_snapshot[] = "fv_000000.h5";

static void write_vertices(const struct fv *s, struct h5 *f)
{
    const struct block *b = &s->b;
    int hi[2];
    for (int a = 0; a < 2; a++)
        hi[a] = b->hi[a] + (b->hi[a] == b->cells[a]);
    double *x = NEW(double, 2 * (int64_t)(hi[0] - b->lo[0]) * (hi[1] - b->lo[1])), *to = x;
    for (int j = b->lo[1]; j < hi[1]; j++)
        for (int i = b->lo[0]; i < hi[0]; i++) {
            *to++ = b->origin[0] + i * b->h[0];
            *to++ = b->rows ? b->rows->edge[j] : b->origin[1] + j * b->h[1];
        }
    h5_write_block(f, "vertices", "m", 2, (const int[]){b->cells[0] + 1, b->cells[1] + 1}, b->lo,
                   hi, 2, x, false);
    mem_free(x);
}

static void whole_pressure(const struct fv *s, double *field)
{
    for (int64_t c = 0; c < s->b.size; c++)
        field[c] = fv_pressure(s, c) + coupling_datum(s);
    fv_add_still_pressure(s, field);
}

/* Of the exact solution, in forced cells, too, for a picture beside the other. */
static void write_exact(const struct fv *s, struct h5 *f, double *field, double *v)
{
    const struct block *b = &s->b;
    double x[3];
    BLOCK_CELLS (b, i, j, k, c) {
        block_centre(b, i, j, k, x);
        double *w = field + c;
        exact_point(&s->exact, x, s->t, NULL, NULL, w);
        if (scene_has_wave(&s->run->scene) && x[1] > exact_surface(&s->exact, x[0]))
            *w = NAN;
    }
    block_pack(b, field, v);
    h5_write_block(f, "vorticity_exact", "1/s", b->dim, b->cells, b->lo, b->hi, 1, v, true);
}

void fv_snapshot(void *state, struct h5 *f, struct xdmf *x, const char *file)
{
    struct fv *s = state;
    const struct block *b = &s->b;
    const int64_t n = local_cells(b);
    struct xdmf_field fields[8];
    int nfields = 0;
    double *v = NEW(double, 3 * n), *field = block_field(b);
    write_frame(s, f);
    if (b->dim == 2 && strcmp(file, first_snapshot) == 0)
        write_vertices(s, f);
    if (fv_field_wanted(s->run, "velocity")) {
        write_velocity(s, f, v);
        fields[nfields++] = (struct xdmf_field){"velocity", 3};
    }
    if (fv_field_wanted(s->run, "pressure")) {
        whole_pressure(s, field);
        block_pack(b, field, v);
        write(s, f, "pressure", "Pa", 1, v);
        fields[nfields++] = (struct xdmf_field){"pressure", 1};
    }
    if (fv_field_wanted(s->run, "vorticity")) {
        fv_vorticity(s, field);
        block_pack(b, field, v);
        write(s, f, "vorticity", "1/s", 1, v);
        fields[nfields++] = (struct xdmf_field){"vorticity", 1};
    }
    if (fv_field_wanted(s->run, "vorticity_exact") && exact_at_all_times(&s->run->scene)) {
        write_exact(s, f, field, v);
        fields[nfields++] = (struct xdmf_field){"vorticity_exact", 1};
    }
    if (s->surface) {
        block_pack(b, s->surface->phi, v);
        h5_write_block(f, "level_set", "m", b->dim, b->cells, b->lo, b->hi, 1, v, true);
        fields[nfields++] = (struct xdmf_field){"level_set", 1};
    }
    if (s->forcing) {
        for (int64_t c = 0; c < b->size; c++)
            field[c] = s->forcing->forced[c];
        block_pack(b, field, v);
        write(s, f, "forced", "-", 1, v);
        fields[nfields++] = (struct xdmf_field){"forced", 1};
    }
    if (x && b->dim == 2)
        xdmf_flat(x, s->t, file, first_snapshot, b->cells, nfields, fields);
    else if (x)
        xdmf_block(x, s->t, file, b->cells, b->origin, b->h, b->rows ? b->rows->edge : NULL,
                   nfields, fields);
    mem_free(field);
    mem_free(v);
}

/* All fields that a step starts from, ghosts and all: bit for bit on the same ranks. */
int fv_restart_fields(const struct fv *s, double **f, const char **names)
{
    static const char *const vector[][3] = {
        {"u0", "u1", "u2"}, {"U0", "U1", "U2"}, {"N0", "N1", "N2"}, {"old0", "old1", "old2"}};
    static const char *const starts[] = {"psi0", "psi1", "psi2"};
    int n = 0;
    f[n] = s->p;
    names[n++] = "p";
    f[n] = s->p_before;
    names[n++] = "p_before";
    if (s->surface) {
        f[n] = s->surface->phi;
        names[n++] = "phi";
    }
    for (int a = 0; a < 3; a++) {
        double *const all[] = {s->u[a], s->U[a], s->N[a], s->u_old[a]};
        for (int k = 0; k < 4; k++)
            if (all[k]) {
                f[n] = all[k];
                names[n++] = vector[k][a];
            }
        if (s->psi[a]) {
            f[n] = s->psi[a];
            names[n++] = starts[a];
        }
    }
    return n;
}

enum { SURFACE_NUMBERS = 3 };
static const char *const surface_numbers[SURFACE_NUMBERS] = {"volume0", "returned", "travelled"};

static double *surface_number(struct surface *f, int k)
{
    return k == 0 ? &f->volume0 : k == 1 ? &f->returned : &f->travelled;
}

void fv_checkpoint(void *state, struct h5 *f)
{
    struct fv *s = state;
    double *fields[FV_RESTART_FIELDS];
    const char *names[FV_RESTART_FIELDS];
    const int n = fv_restart_fields(s, fields, names);
    const struct box mine = layout_block(&s->b);
    layout_save(f, "layout", 1, &mine);
    for (int k = 0; k < n; k++)
        h5_write_real(f, names[k], "-", s->b.size, 1, fields[k], false);
    h5_attribute_real(f, "dt", s->dt);
    h5_attribute_real(f, "dt_old", s->dt_old);
    if (s->newton) {
        h5_attribute_real(f, "dtau", s->newton->dtau);
        h5_attribute_real(f, "residual", s->newton->norm);
        h5_attribute_real(f, "steady", s->newton->steady);
        h5_attribute_real(f, "newtons", (double)s->newton->newtons);
        h5_attribute_real(f, "krylovs", (double)s->newton->krylovs);
    }
    watches_save(s->watches, f);
    outflow_save(s, f);
    if (s->surface)
        for (int k = 0; k < SURFACE_NUMBERS; k++)
            h5_attribute_real(f, surface_numbers[k], *surface_number(s->surface, k));
    if (s->link)
        coupling_save(s, f);
}

static bool restore_newton(struct newton *w, struct h5 *f)
{
    double steady = 0.0, newtons = 0.0, krylovs = 0.0;
    const bool there = h5_read_attribute_real(f, "dtau", &w->dtau) &&
                       h5_read_attribute_real(f, "residual", &w->norm) &&
                       h5_read_attribute_real(f, "steady", &steady) &&
                       h5_read_attribute_real(f, "newtons", &newtons) &&
                       h5_read_attribute_real(f, "krylovs", &krylovs);
    w->steady = steady != 0.0;
    w->newtons = llround(newtons);
    w->krylovs = llround(krylovs);
    return there;
}

/* Fields with their ghosts: bit for bit on the same ranks, else gathered. */
static bool restore_fields(struct fv *s, struct h5 *f, const struct layout *l)
{
    double *fields[FV_RESTART_FIELDS];
    const char *names[FV_RESTART_FIELDS];
    const int n = fv_restart_fields(s, fields, names);
    const struct box mine = layout_block(&s->b);
    const bool same = layout_same_ranks(f, s->run->size);
    for (int k = 0; k < n; k++)
        if (!(same ? h5_read_real(f, names[k], s->b.size, 1, fields[k])
                   : layout_read(l, f, names[k], 1, &mine, s->b.periodic, fields[k]))) {
            log_say("the restart file has no field %s of this shape: was it written by another "
                    "integrator (fv.integrator), or without a free surface?",
                    names[k]);
            return false;
        }
    return true;
}

static bool restore_grid(struct fv *s, struct h5 *f)
{
    struct layout *l = layout_load(f, "layout");
    bool fits = false;
    int same = h5_rows(f, "p") == s->b.size;
    MPI_Allreduce(MPI_IN_PLACE, &same, 1, MPI_INT, MPI_MIN, s->b.cart);
    if (!l && !same)
        log_say(
            "the restart file is of another grid or another number of ranks, and of an age that "
            "does not say which");
    else
        fits = (!l || layout_fits(l, 0, s->b.cells)) && restore_fields(s, f, l);
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
    if (!restore_grid(s, f))
        return false;
    for (int k = 0; s->surface && k < SURFACE_NUMBERS; k++)
        if (!there(h5_read_attribute_real(f, surface_numbers[k], surface_number(s->surface, k)),
                   surface_numbers[k]))
            return false;
    if (s->surface)
        surface_rebuild(s);
    watches_load(s->watches, f);
    return there(h5_read_attribute_real(f, "dt", &s->dt) &&
                     h5_read_attribute_real(f, "dt_old", &s->dt_old),
                 "time step") &&
           there(!s->newton || restore_newton(s->newton, f), "state of Newton's method") &&
           there(outflow_load(s, f), "velocity of an outflow") &&
           there(!s->link || coupling_load(s, f), "past of the coupling");
}
