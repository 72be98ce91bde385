/* mesh_probes.c - gauges of the case on blocks: level, pressure, velocity, discharge. Positions are
 * looked for in all blocks (struct overset in s->output); values are linear between cells, by the
 * block with the smallest cell there.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../fv.h"

#include "../boundary/fv_boundary.h"
#include "../grid/fv_grid.h"
#include "../surface/fv_surface.h"
#include "mesh_output.h"
#include "output.h"
#include "probe_flow.h"

/* Whether some block has computed cells around x; from what all ranks know. */
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

enum { ALONG = 400 };

/* Values of phi at ALONG + 1 positions along gravity over x, from the top of the domain down; 0, as
 * on a surface, where no cells are. Collective. */
static void levels_along(struct fv *s, int gauge, const double *at, int up, bool down, double *phi)
{
    const struct scene_domain *d = &s->run->scene.domain;
    const double L = d->max[up] - d->min[up];
    double x[ALONG + 1][3];
    for (int n = 0; n <= ALONG; n++) {
        for (int a = 0; a < 3; a++)
            x[n][a] = at[a];
        x[n][up] = down ? d->min[up] + n * L / ALONG : d->max[up] - n * L / ALONG;
    }
    const struct block_samples *of = block_samples_of(s, gauge, ALONG + 1, x);
    for (int n = 0; n <= ALONG; n++)
        phi[n] = block_sample_phi(s, of, n, x[n]);
    MPI_Allreduce(MPI_IN_PLACE, phi, ALONG + 1, MPI_DOUBLE, MPI_SUM, s->comm);
}

static bool covers_at(const struct fv *s, const double *at, int up, double height)
{
    double x[3] = {at[0], at[1], at[2]};
    x[up] = height;
    return mesh_covers(s, s->output->search, x);
}

/* Place along gravity where cells begin, between one where none are and one where some are. */
static double edge_between(const struct fv *s, const double *at, int up, double out, double in)
{
    enum { HALVINGS = 24 };
    for (int k = 0; k < HALVINGS; k++) {
        const double middle = 0.5 * (out + in);
        *(covers_at(s, at, up, middle) ? &in : &out) = middle;
    }
    return in;
}

/* Place along gravity of the lowest cells over x, the ground of a dry column, from top to end; NAN:
 * there are none, as where a tank has moved away or a partner's part is. */
static double ground_at(const struct fv *s, const double *at, int up, double top, double end)
{
    const double part = (top - end) / ALONG;
    int n = 0;
    while (n <= ALONG && !covers_at(s, at, up, end + n * part))
        n++;
    if (n == 0 || n > ALONG)
        return n == 0 ? end : NAN;
    return edge_between(s, at, up, end + (n - 1) * part, end + n * part);
}

/* Length without water from sample n of a column of phi down to sample `floor', in distances
 * between samples, linear between them: under drops and jets, and of air that is shut in. Where no
 * cells are, phi is 0, as in a body that water stands on. */
static double dry_below(const double *phi, int n, int floor)
{
    double sum = 0.0;
    for (int k = n; k < floor; k++) {
        const double a = fmax(phi[k], 0.0), b = fmax(phi[k + 1], 0.0);
        const double change = fabs(phi[k + 1] - phi[k]);
        sum += phi[k] * phi[k + 1] < 0.0 ? (a + b) / change : phi[k] > 0.0 || phi[k + 1] > 0.0;
    }
    return sum;
}

/* The first sample at or below the place, which is `share' of the way down, where no cells are: it
 * stands on what is there. */
static int floor_below(const double *phi, double share)
{
    int n = (int)ceil(fmin(fmax(share, 0.0), 1.0) * ALONG);
    while (n < ALONG && phi[n] != 0.0)
        n++;
    return n;
}

/* Height against gravity of the highest water over x, linear between samples, as keys of levels
 * are; of the ground if there is none, NAN where FV does not compute. What it stands on without
 * water is taken off, so that a drop counts by its height, as in columns of even cells. */
static double level_at(struct fv *s, int gauge, const double *x)
{
    const struct scene_domain *d = &s->run->scene.domain;
    const int up = still_upright(&s->run->scene);
    const bool down = s->run->scene.fluid.gravity[up] > 0.0;
    const double top = down ? -d->min[up] : d->max[up], end = down ? -d->max[up] : d->min[up];
    const double most = 1.5 * (top - end) / ALONG;
    const double sign = down ? -1.0 : 1.0;
    double phi[ALONG + 1], ground = NAN;
    if (!mesh_stays(s)) {
        ground = ground_at(s, x, up, sign * top, sign * end);
        if (isnan(ground))
            return NAN;
    }
    levels_along(s, gauge, x, up, down, phi);
    const int bottom = floor_below(phi, (top - sign * x[up]) / (top - end));
    for (int n = 0; n <= ALONG; n++) {
        if (!(phi[n] < 0.0))
            continue;
        /* 0 before it is the surface itself, or no cell: then phi need not be near 0 here */
        const bool falls = n > 0 && (phi[n - 1] > 0.0 || (phi[n - 1] == 0.0 && -phi[n] < most));
        const double step = (top - end) / ALONG, place = top - n * step;
        const double dry = step * dry_below(phi, n, bottom);
        if (n > 0 && !falls) /* below a roof */
            return sign * edge_between(s, x, up, sign * (place + step), sign * place) - dry;
        const double back = falls ? phi[n] / (phi[n] - phi[n - 1]) : 0.0;
        return place + back * step - dry;
    }
    return sign * (isnan(ground) ? ground_at(s, x, up, sign * top, sign * end) : ground);
}

bool mesh_is_out(const struct fv *s, const double *x)
{
    return !mesh_stays(s) && !mesh_covers(s, s->output->search, x);
}

static void point_of(const struct fv *s, const double *x, int nq, double *const *q, double *here)
{
    const int width = s->surface ? 2 : 0;
    for (int a = 0; a < nq; a++)
        here[a] = mesh_value_at(s, s->output->search, x, width, q[a]);
    here[nq] = s->surface ? mesh_phi_at(s, s->output->search, x) : -1.0;
}

/* The samples are summed over ranks here, so that only rank 0 returns the result. */
static double discharge_of(struct fv *s, int gauge, const struct scene_probe *g)
{
    struct flow_samples f = flow_samples_create(s, g);
    const struct block_samples *of = block_samples_of(s, gauge, f.n, f.x);
    for (int k = 0; k < f.n; k++) {
        for (int a = 0; a < s->dim; a++)
            f.value[k][a] = block_sample(s, of, k, s->u[a]);
        f.value[k][3] = s->surface ? block_sample_phi(s, of, k, f.x[k]) : 0.0;
    }
    MPI_Allreduce(MPI_IN_PLACE, f.value, FLOW_VALUES * f.n, MPI_DOUBLE, MPI_SUM, s->comm);
    for (int k = 0; k < f.n && !s->surface; k++)
        f.value[k][3] = -f.step;
    const double sum = flow_samples_sum(&f, s->dim);
    flow_samples_free(&f);
    return s->m->rank == 0 ? sum : 0.0; /* all know it */
}

static double level_of(struct fv *s, int gauge, const double *x)
{
    const double level = level_at(s, gauge, x);
    return s->m->rank == 0 ? level : 0.0;
}

const struct probe_reader mesh_reader = {
    .point = point_of, .level = level_of, .discharge = discharge_of};
