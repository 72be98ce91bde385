/* fv_io.c - snapshots: one list of fields for all grids, averages over the volumes of cells. On
 * blocks datasets NAME_1, NAME_2, ... of the blocks, vertices x_1, ...
 * SPDX-License-Identifier: BSD-3-Clause */
#include "output.h"

#include "../../common/files/files.h"
#include "../boundary/fv_boundary.h"
#include "../grid/fv_grid.h"
#include "../operators/fv_operators.h"
#include "../surface/fv_surface.h"

/* ---- the fields: their components in all cells of this rank ---- */

/* What a cell has is the mean over indices: files have that over its volume. */
static void velocity(struct fv *s, double *const q[3])
{
    for (int a = 0; a < s->dim; a++) {
        FLOW_ROWS (s, c, n)
            memcpy(q[a] + c, s->u[a] + c, (size_t)n * sizeof(double));
        flow_to_volume(s, q[a]);
    }
}

/* Full pressure, Pa: with the hydrostatic part and a partner's level. */
static void pressure(struct fv *s, double *const q[3])
{
    FLOW_ROWS (s, c, n)
        for (int64_t i = c; i < c + n; i++)
            q[0][i] = fv_pressure(s, i) + s->partners.pressure;
    if (!s->surface) /* p ends there: no differences */
        flow_to_volume(s, q[0]);
    for (const struct part *p = s->grid.part; p < s->grid.part + s->grid.nparts; p++) {
        double x[3];
        int i[3];
        PART_CELLS (p, i, c) {
            grid_mean_place(&s->grid, p, i, x);
            q[0][c] += fv_still_pressure(s, x);
        }
    }
}

static void vorticity(struct fv *s, double *const q[3])
{
    flow_vorticity(s, q[0]);
    flow_to_volume(s, q[0]);
}

static bool has_exact_vorticity(const struct fv *s)
{
    return !s->m && scene_shows(&s->run->scene, "vorticity_exact") &&
           exact_at_all_times(&s->run->scene);
}

/* In forced cells, too, for a picture beside the other. */
static void exact_vorticity(struct fv *s, double *const q[3])
{
    double x[3];
    BLOCK_CELLS (&s->b, i, j, k, c) {
        block_centre(&s->b, i, j, k, x);
        exact_point(&s->exact, x, s->t, NULL, NULL, q[0] + c);
        if (scene_has_wave(&s->run->scene) && x[1] > exact_surface(&s->exact, x[0]))
            q[0][c] = NAN;
    }
}

static bool has_level(const struct fv *s) { return s->surface; }

/* phi, m, negative in water. */
static void level(struct fv *s, double *const q[3])
{
    memcpy(q[0], s->surface->phi, (size_t)s->size * sizeof(double));
}

/* On blocks holes have no numbers anyway. */
static bool has_forced(const struct fv *s) { return s->forcing && !s->m; }

static void forced(struct fv *s, double *const q[3])
{
    for (int64_t c = 0; c < s->size; c++)
        q[0][c] = s->forcing->forced[c];
}

/* Fields that a snapshot can have; output_field counts them in this order. */
static const struct field {
    const char *name, *unit;
    int ncomp;
    bool flows;                      /* cells where nothing flows hold no number */
    bool (*has)(const struct fv *s); /* NULL: if output.fields asks for it */
    void (*fill)(struct fv *s, double *const q[3]);
} fields[] = {{"velocity", "m/s", 3, true, NULL, velocity},
              {"pressure", "Pa", 1, true, NULL, pressure},
              {"vorticity", "1/s", 1, true, NULL, vorticity},
              {"vorticity_exact", "1/s", 1, false, has_exact_vorticity, exact_vorticity},
              {"level_set", "m", 1, false, has_level, level},
              {"forced", "-", 1, false, has_forced, forced}};
enum { FIELDS = sizeof fields / sizeof fields[0] };

void output_fill(struct fv *s, enum output_field what, double *const q[3])
{
    fields[what].fill(s, q);
}

/* ---- the file ---- */

/* Datasets of the blocks have their numbers, and vertices are written at all times. */
static bool in_blocks(const struct fv *s) { return grid_name(&s->grid, 0) != NULL; }

/* Forced and dry cells hold what the stencils need, not a flow: no number in a picture. */
static bool is_blank(const struct fv *s, bool flows, int64_t c)
{
    if (s->m)
        return flows ? s->free[c] == 0.0 : s->m->status[c] != CELL_COMPUTED;
    return flows &&
           ((s->forcing && s->forcing->forced[c]) || (s->surface && s->surface->phi[c] >= 0.0));
}

/* This rank's cells of a block: [lo, hi), empty if it has none. */
static const struct part *range(const struct fv *s, int k, int lo[3], int hi[3])
{
    const struct part *p = s->grid.part, *const end = s->grid.part + s->grid.nparts;
    while (p < end && p->block != k)
        p++;
    for (int a = 0; a < 3; a++) {
        lo[a] = p < end ? p->lo[a] : 0;
        hi[a] = p < end ? p->lo[a] + p->n[a] : 0;
    }
    return p < end ? p : NULL;
}

/* One dataset for each block, collective: ranks without cells take part with an empty range. */
static void write(const struct fv *s, struct h5 *f, int k, const struct field *of, double *const *q)
{
    int lo[3], hi[3], i[3];
    const struct part *p = range(s, k, lo, hi);
    double *v = NEW(double, p ? (int64_t)of->ncomp * p->n[0] * p->n[1] * p->n[2] : 0), *to = v;
    if (p)
        PART_CELLS (p, i, c)
            for (int a = 0; a < of->ncomp; a++)
                *to++ = is_blank(s, of->flows, c) ? NAN : q[a][c];
    const char *name = key_text("%s_%d", of->name, k + 1);
    h5_write_block(f, in_blocks(s) ? name : of->name, of->unit, s->dim, grid_cells(&s->grid, k), lo,
                   hi, of->ncomp, v, true);
    mem_free(v);
}

/* The last rank along an axis writes the end's vertices, too. */
static void write_vertices(const struct fv *s, struct h5 *f, int k)
{
    int lo[3], hi[3], n[3], i[3];
    const bool any = range(s, k, lo, hi);
    int64_t count = 1;
    for (int a = 0; a < 3; a++) {
        n[a] = grid_cells(&s->grid, k)[a] + (a < s->dim);
        hi[a] += any && a < s->dim && hi[a] == n[a] - 1;
        count *= hi[a] - lo[a];
    }
    double *all = NEW(double, count * s->dim), *to = all, x[3];
    for (i[2] = lo[2]; i[2] < hi[2]; i[2]++)
        for (i[1] = lo[1]; i[1] < hi[1]; i[1]++)
            for (i[0] = lo[0]; i[0] < hi[0]; i[0]++, to += s->dim) {
                grid_vertex(&s->grid, k, i, x);
                memcpy(to, x, (size_t)s->dim * sizeof *x);
            }
    h5_write_block(f, in_blocks(s) ? key_text("x_%d", k + 1) : "vertices", "m", s->dim, n, lo, hi,
                   s->dim, all, false);
    mem_free(all);
}

/* Of a flat grid, in the first snapshot alone: they stay. */
static const char first_snapshot[] = "fv_000000.h5";

/* Corners of the domain, for whoever draws. */
static void write_frame(const struct fv *s, struct h5 *f)
{
    for (int a = 0; a < s->b.dim; a++) {
        h5_attribute_real(f, key_text("%cmin", "xyz"[a]), s->b.origin[a]);
        h5_attribute_real(f, key_text("%cmax", "xyz"[a]), s->b.origin[a] + s->b.length[a]);
    }
    if (s->b.rows)
        h5_write_real(f, "rows", "m", s->run->rank == 0 ? s->b.cells[1] + 1 : 0, 1, s->b.rows->edge,
                      false);
}

/* Only rank 0 has x. */
static void view(const struct fv *s, struct xdmf *x, const char *file, int n,
                 const struct xdmf_field *of)
{
    const struct block *b = &s->b;
    int cells[MESH_BLOCKS_MAX][3];
    for (int k = 0; k < grid_blocks(&s->grid); k++)
        memcpy(cells[k], grid_cells(&s->grid, k), sizeof cells[k]);
    if (in_blocks(s))
        xdmf_curved(x, s->t, file, s->dim, grid_blocks(&s->grid), (const int(*)[3])cells, n, of);
    else if (s->dim == 2)
        xdmf_flat(x, s->t, file, first_snapshot, b->cells, n, of);
    else
        xdmf_block(x, s->t, file, b->cells, b->origin, b->h, b->rows ? b->rows->edge : NULL, n, of);
}

/* Fields are made one at a time, each with memory of its own, in the order of the list. */
void fv_snapshot(void *state, struct h5 *f, struct xdmf *x, const char *file)
{
    struct fv *s = state;
    struct xdmf_field of[FIELDS];
    int n = 0;
    if (in_blocks(s))
        h5_attribute_int(f, "blocks", grid_blocks(&s->grid));
    else
        write_frame(s, f);
    if (s->run->coupled) /* Pa: what the pressures below have of the partner's level */
        h5_attribute_real(f, "datum", s->partners.pressure);
    for (int k = 0; k < grid_blocks(&s->grid); k++)
        if (in_blocks(s) || (s->dim == 2 && strcmp(file, first_snapshot) == 0))
            write_vertices(s, f, k);
    for (const struct field *one = fields; one < fields + FIELDS; one++) {
        double *q[3] = {NULL, NULL, NULL};
        if (!(one->has ? one->has(s) : scene_shows(&s->run->scene, one->name)))
            continue;
        for (int a = 0; a < one->ncomp; a++)
            q[a] = NEW(double, s->size);
        one->fill(s, q);
        for (int k = 0; k < grid_blocks(&s->grid); k++)
            write(s, f, k, one, q);
        for (int a = 0; a < one->ncomp; a++)
            mem_free(q[a]);
        of[n++] = (struct xdmf_field){one->name, one->ncomp};
    }
    if (x)
        view(s, x, file, n, of);
}
