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

/* Values of phi at ALONG + 1 positions along gravity over x, from the top of the domain down; NAN
 * where no cells are. Collective. */
static void levels_along(struct fv *s, int gauge, const double *at, int up, bool down, double *phi)
{
    const struct scene_domain *d = &s->run->scene.domain;
    const double L = d->max[up] - d->min[up];
    double x[ALONG + 1][3], sums[2][ALONG + 1] = {{0.0}};
    for (int n = 0; n <= ALONG; n++) {
        for (int a = 0; a < 3; a++)
            x[n][a] = at[a];
        x[n][up] = down ? d->min[up] + n * L / ALONG : d->max[up] - n * L / ALONG;
    }
    const struct block_samples *of = block_samples_of(s, gauge, ALONG + 1, x);
    for (int n = 0; n <= ALONG; n++) {
        sums[0][n] = block_sample_phi(s, of, n, x[n]);
        for (int k = of->first[n]; k < of->first[n + 1]; k++)
            sums[1][n] += of->weight[k];
    }
    MPI_Allreduce(MPI_IN_PLACE, sums, 2 * (ALONG + 1), MPI_DOUBLE, MPI_SUM, s->comm);
    for (int n = 0; n <= ALONG; n++)
        phi[n] = sums[1][n] > 0.5 ? sums[0][n] : NAN;
}

/* Place along gravity where cells begin, between one where none are and one where some are. */
static double edge_between(const struct fv *s, const double *at, int up, double out, double in)
{
    enum { HALVINGS = 24 };
    for (int k = 0; k < HALVINGS; k++) {
        const double middle = 0.5 * (out + in);
        double x[3] = {at[0], at[1], at[2]};
        x[up] = middle;
        *(mesh_covers(s, s->output->search, x) ? &in : &out) = middle;
    }
    return in;
}

/* Length without water from sample n of a column of phi down to sample `floor', in distances
 * between samples, linear between them: under drops and jets, and of air that is shut in. A body
 * that water stands on, where no cells are, is none. */
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

/* The lowest sample of cells of the column that stands `share' of the way down or, in a body, on
 * it; -1: no cells are there. */
static int ground_of(const double *phi, double share)
{
    int n = (int)ceil(fmin(fmax(share, 0.0), 1.0) * ALONG);
    while (n < ALONG && !isnan(phi[n]))
        n++;
    while (n >= 0 && isnan(phi[n]))
        n--;
    return n;
}

/* Whether a sample from n up to the next without cells is water; *top: the last of them. */
static bool wet_above(const double *phi, int n, int *top)
{
    bool any = false;
    for (*top = n; *top >= 0 && !isnan(phi[*top]); --*top)
        any = any || phi[*top] < 0.0;
    ++*top;
    return any;
}

/* The first sample from the top of a column that counts for what stands on sample `ground': beyond
 * a deck there if there is no air below it, to `air' between samples, and water on it. */
static int top_over(const double *phi, int ground, double air)
{
    int low = ground, top, next;
    (void)wet_above(phi, low, &top);
    while (!(dry_below(phi, top, low) > air)) {
        for (low = top - 1; low >= 0 && isnan(phi[low]);)
            low--;
        if (low < 0 || !wet_above(phi, low, &next))
            break;
        top = next;
    }
    return top;
}

/* Height against gravity of the highest water over x, linear between samples, as keys of levels
 * are; of the ground if there is none, NAN where FV does not compute. What it stands on without
 * water is taken off, so that a drop counts by its height, as in columns of even cells; half a cell
 * of air parts the water on a deck from that below. */
static double level_at(struct fv *s, int gauge, const double *x)
{
    const struct scene_domain *d = &s->run->scene.domain;
    const int up = still_upright(&s->run->scene);
    const bool down = s->run->scene.fluid.gravity[up] > 0.0;
    const double top = down ? -d->min[up] : d->max[up], end = down ? -d->max[up] : d->min[up];
    const double step = (top - end) / ALONG, sign = down ? -1.0 : 1.0;
    double phi[ALONG + 1];
    levels_along(s, gauge, x, up, down, phi);
    const int ground = ground_of(phi, (top - sign * x[up]) / (top - end));
    if (ground < 0)
        return NAN;
    const double lowest = top - ground * step; /* of the samples, and what it stands on */
    const double floor = ground == ALONG
                             ? end
                             : sign * edge_between(s, x, up, sign * (lowest - step), sign * lowest);
    const int first = top_over(phi, ground, 0.5 * s->surface->least / step);
    int n = first;
    while (n <= ground && !(phi[n] < 0.0))
        n++;
    if (n > ground)
        return floor;
    const double place = top - n * step, dry = step * dry_below(phi, n, ground) +
                                               (phi[ground] > 0.0 ? lowest - floor : 0.0);
    if (n > first)
        return place + step * phi[n] / (phi[n] - phi[n - 1]) - dry;
    const double roof =
        n > 0 ? sign * edge_between(s, x, up, sign * (place + step), sign * place) : top;
    return fmin(roof, place - phi[n]) - dry; /* phi of water near it, a distance */
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
static double sampled_discharge(struct fv *s, int gauge, const struct scene_probe *g)
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

/* As on uniform cells (even_probes.c): by faces where cells keep their share of water, and without
 * a surface where blocks meet round corners; one block without is smooth. */
static double discharge_of(struct fv *s, int gauge, const struct scene_probe *g)
{
    struct fraction *f = s->surface ? s->surface->fraction : NULL;
    const bool stays = !s->m->moves && !s->m->has_fringe && !s->m->has_given;
    if (f)
        f->was_read = 1.0;
    if (f && f->passed[0] && f->passed_time > 0.0)
        return block_flow(s, gauge, g, f->passed) / f->passed_time;
    if (stays && !s->surface && s->m->nblocks > 1 && s->step.dt > 0.0)
        return block_flow(s, gauge, g, s->U);
    return sampled_discharge(s, gauge, g);
}

static double level_of(struct fv *s, int gauge, const double *x)
{
    const double level = level_at(s, gauge, x);
    return s->m->rank == 0 ? level : 0.0;
}

const struct probe_reader mesh_reader = {
    .point = point_of, .level = level_of, .discharge = discharge_of};
