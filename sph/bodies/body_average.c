/* body_average.c - the force on a body by kernel averages of pressure and friction over its
 * surface. A particle contributes to a point of the surface its pressure carried there as in a
 * fluid that moves with the wall, p + rho (g - a).(x - x_j), a the wall's acceleration; at a free
 * surface no suction is carried beyond the particle's own.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "bins.h"
#include "bodies.h"
#include "body_seal.h"

#include "../pairs/sph_pairs.h"
#include "../particles/sph_particles.h"

/* Pressure at the wall of a particle's own, carried there as in a fluid that goes with the wall: at
 * a surface no less than its own or none, so that the air does not suck. */
static double carried_pressure(const struct sph *s, const double *q, const double *e,
                               const double *acceleration)
{
    const double rho = q[at_rho(s->dim)], p = eos_p(rho, s->rho0, s->c0, s->gamma);
    double more = 0.0;
    for (int a = 0; a < s->dim; a++)
        more += (s->gravity[a] - acceleration[a]) * e[a];
    return s->surface ? fmax(p + rho * more, fmin(p, 0.0)) : p + rho * more;
}

/* Whether walls that meet at a joint stand between the particle and the point, which is looked at
 * from a little way within the fluid. */
static bool is_hidden(const struct sph *s, const struct average_node *d, const double *x)
{
    double y[2];
    for (int a = 0; d->joint && a < 2; a++)
        y[a] = d->x[a] - 1e-3 * s->dx * d->n[a];
    return d->joint && wall_joint_hides(d->joint, x, y);
}

/* Particle i, or its image, at x. */
static void ask_particle(const struct sph *s, int i, const double *x, struct average_node *d)
{
    const int dim = s->dim;
    const double *q = prim_line(&s->p, i), *u = q + dim;
    double e[3], r2 = 0.0, away = 0.0, un = 0.0;
    for (int a = 0; a < dim; a++) {
        e[a] = d->x[a] - x[a];
        r2 += e[a] * e[a];
    }
    if (r2 >= s->R * s->R)
        return;
    for (int a = 0; a < dim; a++) {
        away += e[a] * d->n[a];
        un += (u[a] - d->u[a]) * d->n[a];
    }
    if (d->around ? is_hidden(s, d, x) : away <= 0.0) /* not from the other side of a thin body */
        return;
    const double W = q[at_volume(dim)] * kernel_w(dim, sqrt(r2), s->R);
    d->said.W += W;
    d->said.P +=
        W * (carried_pressure(s, q, e, d->du) + scene_reference_at(&s->reference, dim, d->x));
    for (int a = 0; a < dim && d->no_slip; a++)
        d->said.shear[a] +=
            W * s->rho0 * s->nu * (u[a] - d->u[a] - un * d->n[a]) / fmax(away, 0.25 * s->dx);
}

/* Particle i at x. */
static void ask_at(const struct sph *s, int i, const double *x, const struct body_bins *bins,
                   struct nodes *nodes)
{
    struct bins_run run[BINS_RUNS];
    const int n = bins_near(bins, x, run);
    for (int q = 0; q < n; q++)
        for (int k = run[q].first; k < run[q].end; k++)
            ask_particle(s, i, x, nodes->node + bins->who[k]);
}

/* Particle i at x, and images of it within R beyond the periodic sides from an axis on. */
static void ask_images(const struct sph *s, int i, const double *x, int axis,
                       const struct body_bins *bins, struct nodes *nodes)
{
    if (axis >= 3 || axis >= s->dim) {
        ask_at(s, i, x, bins, nodes);
        return;
    }
    ask_images(s, i, x, axis + 1, bins, nodes);
    for (int way = -1; way <= 1 && s->periodic[axis]; way += 2) {
        double y[3] = {0.0, 0.0, 0.0};
        memcpy(y, x, (size_t)s->dim * sizeof *x);
        y[axis] += way * (s->hi[axis] - s->lo[axis]);
        if (y[axis] > s->lo[axis] - s->R && y[axis] < s->hi[axis] + s->R)
            ask_images(s, i, y, axis + 1, bins, nodes);
    }
}

/* All particles of one level; each node hears them in their order. */
static void ask_all(const struct sph *s, struct nodes *nodes)
{
    if (nodes->n == 0)
        return;
    struct body_bins bins =
        bins_create(s->dim, nodes->n, nodes->node->x, sizeof *nodes->node / sizeof(double), s->R);
    for (int i = 0; i < s->p.n; i++)
        if (!particles_is_guard(&s->p, i))
            ask_images(s, i, prim_line(&s->p, i), 0, &bins, nodes);
    bins_free(&bins);
}

/* Every rank lays the same nodes in the same order, so that sums go by their number. */
static void sum_over_ranks(const struct sph *s, struct nodes *nodes)
{
    struct said *sums = NEW(struct said, nodes->n);
    for (int k = 0; k < nodes->n; k++)
        sums[k] = nodes->node[k].said;
    MPI_Allreduce(MPI_IN_PLACE, sums, SAID * nodes->n, MPI_DOUBLE, MPI_SUM, s->run->comm);
    for (int k = 0; k < nodes->n; k++)
        nodes->node[k].said = sums[k];
    mem_free(sums);
}

void body_nodes_ask(const struct sph *s, struct nodes *nodes)
{
    for (const struct sph *q = s; q; q = q->finer)
        ask_all(q, nodes);
    sum_over_ranks(s, nodes);
}

/* Adds a force at a point of the surface. */
static void push(const struct body *b, const struct average_node *d, const double f[3],
                 struct force *to)
{
    double arm[3], moment[3];
    for (int a = 0; a < 3; a++)
        arm[a] = d->x[a] - body_centre(b, a);
    vec3_cross(arm, f, moment);
    vec3_add(to->F, 1.0, f);
    vec3_add(to->M, 1.0, moment);
}

/* Shepard's mean over what was heard; below AVERAGE_WET of a whole support it fades with the weight
 * instead of being a mean of few. */
static void add_force(const struct sph *s, const struct body *b, const struct average_node *d,
                      struct force *to)
{
    double f[3] = {0.0};
    for (int a = 0; a < s->dim; a++)
        f[a] = d->area * (d->said.P * d->n[a] + d->said.shear[a]) / fmax(d->said.W, AVERAGE_WET);
    push(b, d, f, to);
}

/* Of a point of the surface: its |p| times area by sides, down and up each axis, and area. */
static void add_pushed(const struct average_node *d, double to[3][2], double sums[2])
{
    const double P = fabs(d->said.P) / fmax(d->said.W, AVERAGE_WET);
    for (int a = 0; a < 3; a++)
        to[a][d->n[a] > 0.0] += d->area * P * fabs(d->n[a]);
    sums[0] += d->area * P;
    sums[1] += d->area;
}

struct force body_average_pushed(struct sph *s, int which, double *pushed, double *pressure)
{
    const struct walls *w = s->walls;
    struct nodes nodes = body_nodes_lay(s, which);
    struct force force = {0};
    double sides[3][2] = {{0.0}}, sums[2] = {0.0, 0.0};
    body_nodes_ask(s, &nodes);
    seal_nodes_fill(s, which, &nodes);
    for (int k = 0; k < nodes.n; k++) {
        add_force(s, w->bodies + which, nodes.node + k, &force);
        add_pushed(nodes.node + k, sides, sums);
    }
    mem_free(nodes.node);
    *pushed = 0.0;
    for (int a = 0; a < 3; a++)
        *pushed = fmax(*pushed, fmax(sides[a][0], sides[a][1]));
    *pressure = sums[1] > 0.0 ? sums[0] / sums[1] : 0.0;
    return force;
}

struct force body_average(struct sph *s, int which)
{
    double pushed, pressure;
    return body_average_pushed(s, which, &pushed, &pressure);
}

/* Whether there is room for fluid before the surface there. */
static bool is_wet(const struct sph *s, const struct average_node *d)
{
    const struct scene_domain *in = &s->run->scene.domain;
    double x[3];
    int mesh;
    for (int a = 0; a < 3; a++) {
        x[a] = d->x[a] - 0.25 * s->dx * d->n[a];
        if (a < s->dim && !in->periodic[a] && (x[a] < in->min[a] || x[a] > in->max[a]))
            return false;
    }
    return (s->dim == 2 ? walls_distance(s->walls, x, INFINITY)
                        : wall_meshes_nearest(s->walls, x, INFINITY, &mesh).distance) > 0.0;
}

/* The pressure that scene and particles leave out (of a depth, of a slope) acts on what of the
 * surface has room for water before it. */
struct force body_reference(const struct sph *s, int which)
{
    const struct scene_reference *r = &s->reference;
    struct force force = {0};
    if (r->p == 0.0 && vec3_length(r->slope) == 0.0)
        return force;
    struct nodes nodes = body_nodes_lay(s, which);
    const struct body_bend *bend = s->walls->bodies[which].bend;
    if (bend)
        body_bend_clear(bend, BEND_REFERENCE);
    for (int k = 0; k < nodes.n; k++) {
        const struct average_node *d = nodes.node + k;
        double f[3] = {0.0, 0.0, 0.0};
        if (is_wet(s, d))
            vec3_add(f, d->area * scene_reference_at(r, s->dim, d->x), d->n);
        push(s->walls->bodies + which, d, f, &force);
        if (bend)
            body_bend_load(bend, d->x, f, BEND_REFERENCE);
    }
    mem_free(nodes.node);
    return force;
}
