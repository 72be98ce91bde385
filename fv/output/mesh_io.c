/* mesh_io.c - snapshots and restart files of a flow on blocks: datasets NAME_1, NAME_2, ... of the
 * blocks, vertices x_1, ...; cells that are not computed hold no number. What is written are
 * averages over the volumes of cells.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../operators/mesh_ops.h"
#include "mesh_output.h"
#include "../fv.h"
#include "../grid/mesh.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../../common/h5.h"
#include "../../common/log.h"
#include "../../common/mem.h"
#include "../../common/xdmf.h"
#include "../grid/layout.h"
#include "../surface/levelset.h"
#include "../boundary/still.h"

/* This rank's cells of a block: [lo, hi), empty if it has none. */
static const struct part *range(const struct mesh *m, int k, int lo[3], int hi[3])
{
    for (int a = 0; a < 3; a++)
        lo[a] = hi[a] = 0;
    for (int q = 0; q < m->nparts; q++) {
        const struct part *p = m->part + q;
        if (p->block != k)
            continue;
        for (int a = 0; a < 3; a++) {
            lo[a] = p->lo[a];
            hi[a] = p->lo[a] + p->n[a];
        }
        return p;
    }
    return NULL;
}

static void write_vertices(const struct fv *s, struct h5 *f, int k)
{
    const struct mesh *m = s->m;
    const struct mesh_block *b = m->block + k;
    int lo[3], hi[3], n[3] = {b->n[0] + 1, b->n[1] + 1, m->dim == 3 ? b->n[2] + 1 : 1};
    char name[32];
    const bool any = range(m, k, lo, hi) != NULL;
    int64_t count = 1;
    for (int a = 0; a < 3; a++) {
        hi[a] += any && hi[a] == b->n[a] && a < m->dim;
        count *= hi[a] - lo[a];
    }
    double *x = NEW(double, count * m->dim), *to = x;
    for (int l = lo[2]; l < hi[2]; l++)
        for (int j = lo[1]; j < hi[1]; j++)
            for (int i = lo[0]; i < hi[0]; i++)
                for (int c = 0; c < m->dim; c++)
                    *to++ = b->x[mesh_vertex(b, i, j, l)][c];
    snprintf(name, sizeof name, "x_%d", k + 1);
    h5_write_block(f, name, "m", m->dim, n, lo, hi, m->dim, x, false);
    mem_free(x);
}

static void write_field(const struct fv *s, struct h5 *f, int k, const char *field,
                        const char *unit, int ncomp, double *const *q)
{
    const struct mesh *m = s->m;
    int lo[3], hi[3];
    char name[64];
    const struct part *p = range(m, k, lo, hi);
    double *v = NEW(double, p ? (int64_t)ncomp * p->n[0] * p->n[1] * p->n[2] : 0), *to = v;
    int i[3];
    if (p)
        PART_CELLS (p, i, c)
            for (int a = 0; a < ncomp; a++)
                *to++ = s->free[c] == 0.0 ? NAN : q[a] ? q[a][c] : 0.0;
    snprintf(name, sizeof name, "%s_%d", field, k + 1);
    h5_write_block(f, name, unit, m->dim, m->block[k].n, lo, hi, ncomp, v, true);
    mem_free(v);
}

/* Mean place of a cell, over its volume. */
static void centroid(const struct mesh_block *b, int dim, const int *cell, double *mean)
{
    static const double gauss[2] = {0.2113248654051871, 0.7886751345948129};
    double whole = 0.0;
    mean[0] = mean[1] = mean[2] = 0.0;
    for (int g = 0; g < 1 << dim; g++) {
        const double xi[3] = {gauss[g & 1], gauss[g >> 1 & 1], gauss[g >> 2]};
        double x[3], dx[3][3];
        mesh_map_point(b, dim, cell, xi, x, dx);
        const double V = mesh_determinant(dx);
        whole += V;
        for (int c = 0; c < 3; c++)
            mean[c] += V * x[c];
    }
    for (int c = 0; c < 3; c++)
        mean[c] /= whole;
}

/* phi has a value in dry cells, too. */
static void write_level(const struct fv *s, struct h5 *f, int k)
{
    const struct mesh *m = s->m;
    int lo[3], hi[3], i[3];
    char name[64];
    const struct part *p = range(m, k, lo, hi);
    double *v = NEW(double, p ? (int64_t)p->n[0] * p->n[1] * p->n[2] : 0), *to = v;
    if (p)
        PART_CELLS (p, i, c)
            *to++ = m->status[c] == CELL_COMPUTED ? s->surface->phi[c] : NAN;
    snprintf(name, sizeof name, "level_set_%d", k + 1);
    h5_write_block(f, name, "m", m->dim, m->block[k].n, lo, hi, 1, v, true);
    mem_free(v);
}

static void add_still_pressure(const struct fv *s, double *q)
{
    const struct mesh *m = s->m;
    for (int r = 0; r < m->nparts; r++) {
        const struct part *p = m->part + r;
        int i[3];
        PART_CELLS (p, i, c) {
            const int at[3] = {p->lo[0] + i[0], p->lo[1] + i[1], p->lo[2] + i[2]};
            double x[3];
            centroid(m->block + p->block, m->dim, at, x);
            q[c] += still_pressure(&s->run->scene, s->still, s->level, x);
        }
    }
}

void mesh_output_average(struct fv *s, enum mesh_output what, double *q)
{
    if (what == OUTPUT_VORTICITY)
        mesh_vorticity(s, q);
    else
        FLOW_ROWS(s, c, n)
    for (int64_t i = c; i < c + n; i++)
        q[i] = what == OUTPUT_PRESSURE ? fv_pressure(s, i) : s->u[what][i];
    if (!s->surface || what != OUTPUT_PRESSURE) /* p ends at the surface: no differences there */
        mesh_to_volume(s, q, s->flux);
    if (what == OUTPUT_PRESSURE)
        add_still_pressure(s, q);
}

void mesh_snapshot(struct fv *s, struct h5 *f, struct xdmf *x, const char *file)
{
    const struct mesh *m = s->m;
    struct xdmf_field fields[5];
    int n = 0, cells[MESH_BLOCKS_MAX][3];
    double *u[3] = {NULL, NULL, NULL}, *q = mesh_field(m);
    h5_attribute_int(f, "blocks", m->nblocks);
    for (int k = 0; k < m->nblocks; k++) {
        write_vertices(s, f, k);
        memcpy(cells[k], m->block[k].n, sizeof cells[k]);
    }
    if (fv_field_wanted(s->run, "velocity")) {
        for (int a = 0; a < m->dim; a++) {
            u[a] = mesh_field(m);
            mesh_output_average(s, (enum mesh_output)a, u[a]);
        }
        for (int k = 0; k < m->nblocks; k++)
            write_field(s, f, k, "velocity", "m/s", 3, u);
        for (int a = 0; a < m->dim; a++)
            mem_free(u[a]);
        fields[n++] = (struct xdmf_field){"velocity", 3};
    }
    if (fv_field_wanted(s->run, "pressure")) {
        mesh_output_average(s, OUTPUT_PRESSURE, q);
        for (int k = 0; k < m->nblocks; k++)
            write_field(s, f, k, "pressure", "Pa", 1, &q);
        fields[n++] = (struct xdmf_field){"pressure", 1};
    }
    if (fv_field_wanted(s->run, "vorticity")) {
        mesh_output_average(s, OUTPUT_VORTICITY, q);
        for (int k = 0; k < m->nblocks; k++)
            write_field(s, f, k, "vorticity", "1/s", 1, &q);
        fields[n++] = (struct xdmf_field){"vorticity", 1};
    }
    if (s->surface) {
        for (int k = 0; k < m->nblocks; k++)
            write_level(s, f, k);
        fields[n++] = (struct xdmf_field){"level_set", 1};
    }
    if (x)
        xdmf_curved(x, s->t, file, m->dim, m->nblocks, (const int(*)[3])cells, n, fields);
    mem_free(q);
}
