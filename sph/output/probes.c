/* probes.c - gauges and forces on bodies, as columns of series.csv. A gauge of pressure or velocity
 * is a Shepard mean over the particles that flow within R,
 *   f(x) = sum_j w_j W(x - x_j) f_j / sum_j w_j W(x - x_j),
 * p_j extrapolated to x by its gradient (c^2 grad rho). Levels, shorelines and discharges have
 * files of their own. Called by sph_row, after slopes were made; collective.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "probes.h"

#include "../bodies/sph_bodies.h"
#include "../pairs/sph_pairs.h"
#include "../particles/sph_particles.h"
#include "../surface/sph_surface.h"
#include "discharge_gauge.h"
#include "shore.h"

/* The gauge where it is now: one that is fixed to a body moves with it, one in a box that reaches
 * over a period is there as its image. */
static struct scene_probe placed(const struct sph *s, const struct scene_probe *g)
{
    const struct scene_domain *d = &s->run->scene.domain;
    struct scene_probe now = *g;
    for (int k = 0; g->body[0] && k < s->run->scene.nbodies; k++)
        if (strcmp(s->run->scene.bodies[k].name, g->body) == 0)
            body_place(s->walls->bodies + k, g->at, now.at);
    for (int a = 0; a < s->dim; a++) {
        const double at = now.at[a];
        now.at[a] = s->periodic[a] ? at : scene_image_from(d, a, s->lo[a], at);
        now.to[a] += now.at[a] - at;
    }
    return now;
}

/* Displacement d from x to a gauge by the nearest periodic image, m; returns its square. */
static double way_to(const struct sph *s, const struct scene_probe *g, const double *x, double *d)
{
    const struct scene_domain *o = &s->run->scene.domain;
    double r2 = 0.0;
    for (int a = 0; a < s->dim; a++) {
        d[a] = g->at[a] - x[a];
        if (o->periodic[a])
            d[a] -= (o->max[a] - o->min[a]) * round(d[a] / (o->max[a] - o->min[a]));
        r2 += d[a] * d[a];
    }
    return r2;
}

/* w W of local particle i at a gauge; 0: out of reach, behind a thin wall, or a guard. A gauge with
 * a face as large as `radius' has at least that for its support. */
static double weight_at(const struct sph *s, int i, const struct scene_probe *g)
{
    const double *q = prim_line(&s->p, i);
    const double R = fmax(s->p.size ? s->p.size[i][0] : s->R, g->radius);
    double d[3];
    const double r2 = way_to(s, g, q, d);
    return r2 >= R * R || particles_is_guard(&s->p, i) || walls_hide(s, q, d)
               ? 0.0
               : q[at_volume(s->dim)] * kernel_w(s->dim, sqrt(r2), R);
}

/* How much of the pressure's gradient at local i is that of water at rest, rho g: where the support
 * is cut by a surface the measured one is flat, for the first rows have up to 0.5 rho g dx too much
 * (3 rows on a floor: 0.76 rho g, and the gauge there 7 % low). 1 at rest, 0 from 0.01 c0 on and
 * away from the surface. */
static double rests(const struct sph *s, int i)
{
    const double *u = prim_line(&s->p, i) + s->dim;
    double u2 = 0.0;
    for (int a = 0; a < s->dim; a++)
        u2 += u[a] * u[a];
    return s->surface && s->surface->is[i] == SURFACE_NEAR
               ? fmax(0.0, 1.0 - u2 / pow(0.01 * s->c0, 2.0))
               : 0.0;
}

/* Of one level, what flows there: sums of w W p, p carried to the place by its gradient, and of w
 * W. */
static void add_pressure(const struct sph *s, const struct scene_probe *g, double sums[2])
{
    const int dim = s->dim;
    double still[3];
    scene_still_gravity(&s->run->scene, still);
    for (int i = 0; i < s->p.n; i++) {
        const double *q = prim_line(&s->p, i), rho = q[at_rho(dim)], W = weight_at(s, i, g);
        const double *grho = slope_line(&s->p, i);
        double more = 0.0, weight = 0.0, d[3];
        if (W == 0.0)
            continue;
        way_to(s, g, q, d);
        for (int a = 0; a < dim; a++) {
            more += d[a] * grho[a];
            weight += d[a] * rho * still[a];
        }
        const double c = eos_c(rho, s->rho0, s->c0, s->gamma), rest = rests(s, i);
        sums[0] += W * (eos_p(rho, s->rho0, s->c0, s->gamma) + (1.0 - rest) * c * c * more +
                        rest * weight);
        sums[1] += W;
    }
}

/* Kernel average of p; 0 where there is hardly any fluid. An instrument with a face of its own
 * reads what presses on all of it: less as less of it is wet than a corner of walls leaves, a
 * quarter of the disc or an eighth of the sphere, so that one particle of a splash does not count
 * as a face full of water. */
static double pressure_at(struct sph *s, const struct scene_probe *g)
{
    double sums[2] = {0.0, 0.0};
    for (const struct sph *q = s; q; q = q->finer)
        add_pressure(q, g, sums);
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, s->run->comm);
    const double least = g->radius > 0.0 ? ldexp(1.0, -s->dim) : 0.05;
    return sums[1] > 0.05
               ? scene_reference_at(&s->reference, s->dim, g->at) + sums[0] / fmax(sums[1], least)
               : 0.0;
}

/* Kernel average of the velocity; NAN where there is hardly any fluid. 5 % of a full support is the
 * least for a value. */
static void velocity_at(struct sph *s, const struct scene_probe *g, double *u)
{
    double sums[4] = {0.0, 0.0, 0.0, 0.0};
    for (const struct sph *f = s; f; f = f->finer)
        for (int i = 0; i < f->p.n; i++) {
            const double *q = prim_line(&f->p, i), W = weight_at(f, i, g);
            for (int a = 0; a < s->dim && W > 0.0; a++)
                sums[a] += W * q[s->dim + a];
            sums[3] += W;
        }
    MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPI_DOUBLE, MPI_SUM, s->run->comm);
    for (int a = 0; a < s->dim; a++)
        u[a] = sums[3] > 0.05 ? sums[a] / sums[3] : NAN;
}

static void gauge_row(struct sph *s, const struct scene_probe *g, struct figures *to)
{
    double v[3] = {0.0, 0.0, 0.0};
    if (to->measures && g->kind == PROBE_VELOCITY)
        velocity_at(s, g, v);
    else if (to->measures)
        v[0] = g->kind == PROBE_LEVEL       ? level_gauge(s, g->at)
               : g->kind == PROBE_SHORE     ? shore_height(s, g->at[0])
               : g->kind == PROBE_DISCHARGE ? discharge_gauge(s, g)
                                            : pressure_at(s, g);
    probe_row(g, s->dim, v, to);
}

struct force probes_force(struct sph *s, int k)
{
    struct force force;
    return forces_of(s, k, &force) ? force : body_average(s, k);
}

/* Adds the kernel average of the force on the first body to its mean over the second half of the
 * run, each value for the time since the last row. */
void probes_sample(struct sph *s)
{
    const double begin = fmax(s->total.mean_force.average_t, 0.5 * s->run->scene.time.end),
                 dt = s->t - begin;
    if (s->run->scene.nbodies == 0)
        return;
    s->total.mean_force.average_t = s->t;
    if (dt <= 0.0)
        return;
    const struct force force = body_average(s, 0);
    s->total.mean_force.average_time += dt;
    for (int a = 0; a < s->dim; a++)
        s->total.mean_force.average_sum[a] += dt * force.F[a];
}

/* Force and moment on body k. */
static void force_row(struct sph *s, int k, struct figures *to)
{
    static const char *const plane[] = {"force x [N/m]", "force y [N/m]", "moment [N]"};
    static const char *const space[] = {"force x [N]",    "force y [N]",    "force z [N]",
                                        "moment x [N m]", "moment y [N m]", "moment z [N m]"};
    const char *name = s->run->scene.bodies[k].name;
    struct force f = {.F = {0.0, 0.0, 0.0}};
    if (to->measures)
        f = probes_force(s, k);
    const double of[2][6] = {{f.F[0], f.F[1], f.M[2]},
                             {f.F[0], f.F[1], f.F[2], f.M[0], f.M[1], f.M[2]}};
    for (int a = 0; a < 3 * (s->dim - 1); a++)
        FIGURE(to, of[s->dim - 2][a], "%s %s", name, (s->dim == 2 ? plane : space)[a]);
}

/* Gauges that another program of the job has are left out. */
void probes_row(struct sph *s, struct figures *to)
{
    const struct scene *c = &s->run->scene;
    for (int k = 0; k < c->nprobes; k++)
        if (!s->run->gauge_elsewhere[k]) {
            const struct scene_probe g = placed(s, c->probes + k);
            gauge_row(s, &g, to);
        }
    for (int k = 0; k < c->nbodies; k++)
        force_row(s, k, to);
    for (int k = 0; k < c->nbodies; k++)
        bodies_row(s, k, to);
}
