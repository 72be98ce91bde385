/* probes.c - gauges and forces; see probes.h. SPDX-License-Identifier: BSD-3-Clause */
#include "probes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../common/mem.h"
#include "eos.h"
#include "forces.h"
#include "kernel.h"
#include "walls.h"

enum { PRIM = 8 };

int probes_columns(const struct run *r, const char **names)
{
    static char text[PROBE_COLUMNS][PARAM_TEXT_SIZE + 24];
    static const char *const part[3] = {"force x [N/m]", "force y [N/m]", "moment [N]"};
    const struct scene *c = &r->scene;
    int n = 0;
    for (int k = 0; k < c->nprobes; k++, n++)
        snprintf(text[n], sizeof text[n], "%s [%s]", c->probes[k].name,
                 c->probes[k].kind == PROBE_LEVEL ? "m" : "Pa");
    for (int k = 0; k < c->nbodies; k++)
        for (int a = 0; a < 3; a++, n++)
            snprintf(text[n], sizeof text[n], "%s %s", c->bodies[k].name, part[a]);
    for (int k = 0; k < n; k++)
        names[k] = text[k];
    return n;
}

/* Kernel average of p, carried to the place by its gradient; 0 where there is hardly any fluid. */
static double pressure_at(struct sph *s, const double *at)
{
    const int dim = s->dim;
    double sums[2] = {0.0, 0.0};
    for (int i = 0; i < s->p.n; i++) {
        const double *q = s->p.prim + (size_t)PRIM * i, rho = q[2 * dim + 1];
        const double *grho = s->p.slope + (size_t)s->p.nslope * i;
        double r2 = 0.0, more = 0.0;
        for (int a = 0; a < dim; a++) {
            r2 += (at[a] - q[a]) * (at[a] - q[a]);
            more += (at[a] - q[a]) * grho[a];
        }
        if (r2 >= s->R * s->R)
            continue;
        const double W = q[2 * dim] * kernel_w(dim, sqrt(r2), s->R);
        const double c = eos_c(rho, s->rho0, s->c0, s->gamma);
        sums[0] += W * (eos_p(rho, s->rho0, s->c0, s->gamma) + c * c * more);
        sums[1] += W;
    }
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, s->run->comm);
    return sums[1] > 0.05 ? sums[0] / sums[1] : 0.0;
}

/* Volume of the fluid in a column around the place over the column's cross-section, on top of the
 * domain's bottom: the surface's height where there is one, drops included. */
static double level_at(struct sph *s, const double *at)
{
    const int dim = s->dim, up = dim - 1;
    const double half = 2.0 * s->dx;
    double volume = 0.0, section = 1.0;
    for (int a = 0; a < up; a++) { /* integral of the hat function over the domain */
        const double lo = fmax(-1.0, (s->lo[a] - at[a]) / half);
        const double hi = fmin(1.0, (s->hi[a] - at[a]) / half);
        const double low = 0.5 * (1.0 + lo) * (1.0 + lo), high = 0.5 * (1.0 - hi) * (1.0 - hi);
        section *= s->periodic[a] ? half : half * (1.0 - low - high);
    }
    for (int i = 0; i < s->p.n; i++) {
        const double *q = s->p.prim + (size_t)PRIM * i;
        double weight = q[2 * dim];
        for (int a = 0; a < up; a++) {
            double d = fabs(q[a] - at[a]);
            if (s->periodic[a])
                d = fmin(d, s->hi[a] - s->lo[a] - d);
            weight *= fmax(0.0, 1.0 - d / half);
        }
        volume += weight;
    }
    MPI_Allreduce(MPI_IN_PLACE, &volume, 1, MPI_DOUBLE, MPI_SUM, s->run->comm);
    return s->lo[up] + volume / section;
}

/* Points of a body's surface, dx/2 apart or closer, and what particles say there. */
struct node {
    double x[2], n[2], length, u[2], du[2];
    double W, P, shear[2];
    bool no_slip;
};

static int lay_nodes(const struct sph *s, const struct body *b, struct node **nodes)
{
    int n = 0;
    for (int k = b->first; k < b->first + b->n; k++) {
        const struct segment *g = s->walls->segments + k;
        const int pieces = (int)ceil(g->length / (0.5 * s->dx));
        GROW(*nodes, n, n + pieces);
        for (int i = 0; i < pieces; i++, n++) {
            struct node *d = *nodes + n;
            for (int a = 0; a < 2; a++) {
                d->x[a] = g->a[a] + (i + 0.5) / pieces * g->length * g->t[a];
                d->n[a] = g->n[a];
            }
            d->length = g->length / pieces;
            d->no_slip = g->no_slip;
            walls_velocity(s->walls, g, d->x, d->u, d->du);
        }
    }
    return n;
}

/* Pressure at the wall of a particle's own, carried there as in a fluid that goes with the wall: at
 * a surface no less than its own or none, so that the air does not suck. */
static double carried_pressure(const struct sph *s, const double *q, const double *e,
                               const double *acceleration)
{
    const double p = eos_p(q[5], s->rho0, s->c0, s->gamma);
    const double more =
        (s->gravity[0] - acceleration[0]) * e[0] + (s->gravity[1] - acceleration[1]) * e[1];
    return s->surface ? fmax(p + q[5] * more, fmin(p, 0.0)) : p + q[5] * more;
}

static void ask_particle(const struct sph *s, int i, struct node *d)
{
    const double *q = s->p.prim + (size_t)PRIM * i;
    const double e[2] = {d->x[0] - q[0], d->x[1] - q[1]}, r2 = e[0] * e[0] + e[1] * e[1];
    const double away = e[0] * d->n[0] + e[1] * d->n[1];
    if (r2 >= s->R * s->R || away <= 0.0) /* not from the other side of a thin body */
        return;
    const double W = q[4] * kernel_w(2, sqrt(r2), s->R);
    const double un = (q[2] - d->u[0]) * d->n[0] + (q[3] - d->u[1]) * d->n[1];
    d->W += W;
    d->P += W * carried_pressure(s, q, e, d->du);
    for (int a = 0; a < 2 && d->no_slip; a++)
        d->shear[a] +=
            W * s->rho0 * s->nu * (q[2 + a] - d->u[a] - un * d->n[a]) / fmax(away, 0.25 * s->dx);
}

static void bounds(const struct node *nodes, int n, double lo[2], double hi[2])
{
    for (int a = 0; a < 2; a++) {
        lo[a] = INFINITY;
        hi[a] = -INFINITY;
        for (int k = 0; k < n; k++) {
            lo[a] = fmin(lo[a], nodes[k].x[a]);
            hi[a] = fmax(hi[a], nodes[k].x[a]);
        }
    }
}

void probes_average(struct sph *s, int which, double force[3])
{
    const struct body *b = s->walls->bodies + which;
    struct node *nodes = NULL;
    double lo[2], hi[2];
    const int n = lay_nodes(s, b, &nodes);
    bounds(nodes, n, lo, hi);
    for (int i = 0; i < s->p.n; i++) {
        const double *x = s->p.prim + (size_t)PRIM * i;
        bool near = true;
        for (int a = 0; a < 2; a++)
            near = near && x[a] > lo[a] - s->R && x[a] < hi[a] + s->R;
        for (int k = 0; near && k < n; k++)
            ask_particle(s, i, nodes + k);
    }
    double *sums = NEW(double, 4 * (size_t)n);
    for (int k = 0; k < n; k++)
        memcpy(sums + 4 * (size_t)k, &nodes[k].W, 4 * sizeof(double));
    MPI_Allreduce(MPI_IN_PLACE, sums, 4 * n, MPI_DOUBLE, MPI_SUM, s->run->comm);
    force[0] = force[1] = force[2] = 0.0;
    for (int k = 0; k < n; k++) {
        const double *v = sums + 4 * (size_t)k, *x = nodes[k].x;
        const double W =
            fmax(v[0], 0.4); /* a wet plane has 1/2; of few particles the sum is theirs */
        double f[2];
        for (int a = 0; a < 2; a++)
            f[a] = nodes[k].length * (v[1] * nodes[k].n[a] + v[2 + a]) / W;
        force[0] += f[0];
        force[1] += f[1];
        force[2] += (x[0] - b->is->centre[0] - b->now.x[0]) * f[1] -
                    (x[1] - b->is->centre[1] - b->now.x[1]) * f[0];
    }
    mem_free(sums);
    mem_free(nodes);
}

void probes_force(struct sph *s, int k, double force[3])
{
    if (!forces_of(s, k, force))
        probes_average(s, k, force);
}

/* The second opinion on the first body, by rows, each for the time since the one before. */
static void sample_average(struct sph *s)
{
    const double begin = fmax(s->average_t, 0.5 * s->run->scene.time.end), dt = s->t - begin;
    double force[3];
    s->average_t = s->t;
    if (dt <= 0.0)
        return;
    probes_average(s, 0, force);
    s->average_time += dt;
    for (int a = 0; a < 2; a++)
        s->average_sum[a] += dt * force[a];
}

void probes_row(struct sph *s, double *values)
{
    const struct scene *c = &s->run->scene;
    for (int k = 0; k < c->nprobes; k++)
        *values++ = c->probes[k].kind == PROBE_LEVEL ? level_at(s, c->probes[k].at)
                                                     : pressure_at(s, c->probes[k].at);
    for (int k = 0; k < c->nbodies; k++, values += 3)
        probes_force(s, k, values);
    if (c->nbodies > 0)
        sample_average(s);
}
