/* mesh_probes.c - gauges of the case on blocks: level, pressure, velocity, discharge.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../fv.h"

#include <math.h>
#include <string.h>

#include "../../common/scene/scene_probe.h"
#include "../boundary/still.h"
#include "../grid/mesh_motion.h"
#include "../grid/overset.h"
#include "../surface/levelset.h"
#include "mesh_output.h"
#include "output.h"
#include "probe_flow.h"

static bool mesh_covers(const struct fv *s, const struct overset *o, const double *x)
{
    for (int k = 0; k < s->m->nblocks; k++) {
        int cell[3], from[3];
        double xi[3], w[64];
        if (overset_locate(s->m, o, k, x, cell, xi) &&
            overset_weights(s->m, k, cell, xi, 1, 2, from, w))
            return true;
    }
    return false;
}

/* Values of phi at places along gravity over x, from the top of the domain; `far' where no cells
 * are. */
enum { ALONG = 400 };

static void levels_along(struct fv *s, const double *at, int up, bool down, double *phi)
{
    const struct scene_domain *d = &s->run->scene.domain;
    const double L = d->max[up] - d->min[up];
    for (int n = 0; n <= ALONG; n++) {
        double x[3] = {at[0], at[1], at[2]};
        x[up] = down ? d->min[up] + n * L / ALONG : d->max[up] - n * L / ALONG;
        phi[n] = mesh_value_at(s, s->search, x, 2, s->surface->phi);
    }
    MPI_Allreduce(MPI_IN_PLACE, phi, ALONG + 1, MPI_DOUBLE, MPI_SUM, s->comm);
}

/* Whether some cell over x is computed: a partner's part moves, and has no level of FV's. */
static bool is_known(const struct fv *s, const double *at, int up)
{
    const struct scene_domain *d = &s->run->scene.domain;
    for (int n = 0; n <= ALONG && s->past[0][0]; n++) {
        double x[3] = {at[0], at[1], at[2]};
        x[up] = d->min[up] + n * (d->max[up] - d->min[up]) / ALONG;
        if (mesh_covers(s, s->search, x))
            return true;
    }
    return !s->past[0][0];
}

/* Place along gravity of the highest water over x; the domain's end if there is none, NAN where
 * FV does not compute. */
static double level_at(struct fv *s, const double *x)
{
    const struct scene_domain *d = &s->run->scene.domain;
    const int up = still_upright(&s->run->scene);
    const bool down = s->run->scene.fluid.gravity[up] > 0.0;
    const double top = down ? d->min[up] : d->max[up], end = down ? d->max[up] : d->min[up];
    double phi[ALONG + 1];
    if (!is_known(s, x, up))
        return NAN;
    levels_along(s, x, up, down, phi);
    for (int n = 0; n <= ALONG; n++) {
        if (!(phi[n] < 0.0))
            continue;
        const double back = n > 0 && phi[n - 1] > 0.0 ? phi[n] / (phi[n] - phi[n - 1]) : 0.0;
        return top + (end - top) * (n - back) / ALONG;
    }
    return end;
}

/* Velocity and distance to the surface at a place: this rank's share. */
static void share_at(const struct fv *s, const double *x, double here[FLOW_VALUES])
{
    for (int a = 0; a < s->dim; a++)
        here[a] = mesh_value_at(s, s->search, x, 2, s->u[a]);
    here[3] = s->surface ? mesh_value_at(s, s->search, x, 2, s->surface->phi) : 0.0;
}

/* Whether a body or a partner is there, whose cells are not computed. */
static bool is_out(const struct fv *s, const double *x)
{
    return (s->m->moves || s->past[0][0]) && !mesh_covers(s, s->search, x);
}

static void velocity_at(struct fv *s, const double *x, double *u)
{
    double here[FLOW_VALUES] = {0.0};
    share_at(s, x, here);
    MPI_Allreduce(MPI_IN_PLACE, here, FLOW_VALUES, MPI_DOUBLE, MPI_SUM, s->comm);
    const bool dry = is_out(s, x) || (s->surface && here[3] >= 0.0);
    for (int a = 0; a < s->dim; a++)
        u[a] = dry ? NAN : here[a];
}

static double discharge_of(struct fv *s, const struct scene_probe *g)
{
    struct flow_samples f = flow_samples_create(s, g);
    for (int k = 0; k < f.n; k++)
        share_at(s, f.x[k], f.value[k]);
    MPI_Allreduce(MPI_IN_PLACE, f.value, FLOW_VALUES * f.n, MPI_DOUBLE, MPI_SUM, s->comm);
    for (int k = 0; k < f.n && !s->surface; k++)
        f.value[k][3] = -f.step;
    const double sum = flow_samples_sum(&f, s->dim);
    flow_samples_free(&f);
    return sum;
}

static double pressure_at(struct fv *s, const double *x)
{
    double here[2];
    here[0] = mesh_value_at(s, s->search, x, s->surface ? 2 : 0, NULL);
    here[1] = s->surface ? mesh_value_at(s, s->search, x, 2, s->surface->phi) : -1.0;
    MPI_Allreduce(MPI_IN_PLACE, here, 2, MPI_DOUBLE, MPI_SUM, s->comm);
    if (is_out(s, x))
        return NAN;
    return here[1] < 0.0 ? here[0] + fv_still_pressure(s, x) + s->datum : 0.0;
}

/* The gauge where it is now: with the block that it is fixed to. */
static struct scene_probe placed(const struct fv *s, const struct scene_probe *p)
{
    struct scene_probe now = *p;
    for (int k = 0; p->body[0] && k < s->m->nblocks; k++)
        if (s->m->block[k].motion && strcmp(s->m->block[k].prm->name, p->body) == 0)
            mesh_motion_now(s->m->block + k, p->at, now.at);
    return now;
}

void mesh_probes(struct fv *s, double *values)
{
    const struct scene *scene = &s->run->scene;
    for (int k = 0; k < scene->nprobes; k++) {
        const struct scene_probe g = placed(s, scene->probes + k), *p = &g;
        if (!fv_probe_mine(s->run, k))
            continue;
        if (p->kind == PROBE_VELOCITY)
            velocity_at(s, p->at, values);
        else
            *values = p->kind == PROBE_LEVEL       ? level_at(s, p->at)
                      : p->kind == PROBE_DISCHARGE ? discharge_of(s, p)
                                                   : pressure_at(s, p->at);
        values += probe_columns(p, s->dim);
    }
}
