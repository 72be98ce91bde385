/* fv_io.c - snapshots and restart files. SPDX-License-Identifier: BSD-3-Clause */
#include "../fv.h"
#include "mesh_output.h"

#include <math.h>
#include <string.h>

#include "../../common/h5.h"
#include "../../common/log.h"
#include "../../common/mem.h"
#include "../../common/xdmf.h"
#include "../boundary/forcing.h"
#include "../grid/layout.h"
#include "../poisson/pressure.h"
#include "../surface/levelset.h"
#include "../time/newton.h"
#include "../boundary/outflow.h"
#include "../grid/rows.h"
#include "../boundary/still.h"
#include "output.h"
#include "../coupling/fv_link.h"

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

static void snapshot(struct fv *s, struct h5 *f, struct xdmf *x, const char *file)
{
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

void fv_snapshot(void *state, struct h5 *f, struct xdmf *x, const char *file)
{
    struct fv *s = state;
    if (s->m)
        mesh_snapshot(s, f, x, file);
    else
        snapshot(s, f, x, file);
}
