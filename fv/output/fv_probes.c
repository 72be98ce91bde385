/* fv_probes.c - gauges of the case in series.csv: pressure and velocity at a point, level of the
 * water, discharge, whatever the cells. Each rank adds its share (share_of), one reduction sums all
 * gauges, then each rank reads out the same values (read_out). Uniform cells and blocks differ in
 * struct probe_reader alone.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../fv.h"

#include "../../common/scene/scene.h"
#include "../boundary/fv_boundary.h"
#include "../grid/fv_grid.h"
#include "output.h"
#include "probe_flow.h"

/* The gauge where it is now: with the block that it is fixed to. */
static struct scene_probe placed(const struct fv *s, const struct scene_probe *p)
{
    struct scene_probe now = *p;
    for (int k = 0; p->body[0] && k < s->prm.blocks.n; k++)
        if (s->m->block[k].motion && strcmp(s->m->block[k].prm->name, p->body) == 0)
            mesh_motion_now(s->m->block + k, p->at, now.at);
    return now;
}

/* A gauge's share of this rank; returns how many numbers there are. A point has its values and the
 * level set's sign, -1 for water. */
static int share_of(struct fv *s, int gauge, const struct scene_probe *g, double *here)
{
    const struct probe_reader *of = s->m ? &mesh_reader : &even_reader;
    if (probe_is_point(g)) {
        const int nq = probe_columns(g, s->dim);
        of->point(s, g->at, nq, g->kind == PROBE_VELOCITY ? s->u : (double *[]){NULL}, here);
        return nq + 1;
    }
    *here = g->kind == PROBE_LEVEL ? of->level(s, gauge, g->at) : of->discharge(s, gauge, g);
    return 1;
}

/* What it reads, of the sum over all ranks; returns as share_of. Dry: velocity nan, pressure 0;
 * outside of blocks that move nan. */
static int read_out(const struct fv *s, const struct scene_probe *g, const double *sum,
                    struct figures *to)
{
    const int nq = probe_columns(g, s->dim);
    const bool point = probe_is_point(g), out = to->measures && s->m && mesh_is_out(s, g->at),
               dry = point && (out || !(sum[nq] < 0.0));
    double values[3];
    for (int a = 0; a < nq; a++)
        values[a] = dry ? NAN : sum[a];
    if (g->kind == PROBE_PRESSURE && !out)
        *values = dry ? 0.0 : *sum + fv_still_pressure(s, g->at) + s->partners.pressure;
    probe_row(g, s->dim, values, to);
    return nq + point;
}

/* Sums of the shares of all ranks. Halos first, since gauges lie between cells of two ranks. */
static void measure_all(struct fv *s, double *sums)
{
    const struct scene *scene = &s->run->scene;
    bool velocities = false;
    for (int k = 0; k < scene->nprobes; k++)
        velocities = velocities || scene->probes[k].kind >= PROBE_DISCHARGE;
    if (!s->m)
        block_halo(&s->b, 2, (double *const[]){s->p, s->p_before});
    if (!s->m && velocities)
        block_halo(&s->b, s->dim, s->u);
    int n = 0;
    for (int k = 0; k < scene->nprobes; k++) {
        const struct scene_probe g = placed(s, scene->probes + k);
        n += !s->run->gauge_elsewhere[k] ? share_of(s, k, &g, sums + n) : 0;
    }
    MPI_Allreduce(MPI_IN_PLACE, sums, n, MPI_DOUBLE, MPI_SUM, s->comm);
}

/* Gauges that another program reads are left out. */
void fv_probes_row(struct fv *s, struct figures *to)
{
    const struct scene *scene = &s->run->scene;
    double sums[4 * PROBES_MAX] = {0.0}, *from = sums;
    if (to->measures && scene->nprobes > 0)
        measure_all(s, sums);
    for (int k = 0; k < scene->nprobes; k++)
        if (!s->run->gauge_elsewhere[k]) {
            const struct scene_probe g = placed(s, scene->probes + k);
            from += read_out(s, &g, from, to);
        }
}
