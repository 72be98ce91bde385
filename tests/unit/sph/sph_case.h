/* sph_case.h - a small SPH run without a case file, for the tests of its modules.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../../../sph/bodies/body_pace.h"
#include "../../../sph/case/sph_params.h"
#include "../../../sph/case/sph_state.h"
#include "../../../sph/sph.h"
#include "../../../sph/time/integrate.h"

struct sph_case {
    struct run run;
    struct sph_params prm;
    struct sph *s;
};

/* Unit square or cube of `cells' particles a side, Taylor-Green of Re 200 unless the caller changes
 * c->run.scene before sph_case_start. */
static inline void sph_case_set(struct sph_case *c, int dim, int cells)
{
    *c = (struct sph_case){.run = {.comm = MPI_COMM_WORLD, .name = "sph"}};
    MPI_Comm_rank(MPI_COMM_WORLD, &c->run.rank);
    MPI_Comm_size(MPI_COMM_WORLD, &c->run.size);
    struct scene *e = &c->run.scene;
    e->fluid.rho = 1.0;
    e->fluid.nu = 0.005;
    e->domain.dim = dim;
    e->initial.field = FIELD_TAYLOR_GREEN;
    e->initial.U = e->initial.L = 1.0;
    for (int a = 0; a < dim; a++) {
        e->domain.max[a] = 1.0;
        e->domain.periodic[a] = true;
    }
    c->prm = (struct sph_params){.dx = 1.0 / cells,
                                 .R_dx = dim == 2 ? 4.0 : 2.7,
                                 .c0 = 10.0,
                                 .gamma = 7.0,
                                 .low_dissipation = true,
                                 .damper = 0.2,
                                 .integrator = INTEGRATOR_J3,
                                 .cfl = dim == 2 ? 0.5 : 0.45,
                                 .cfl_viscous = 0.09,
                                 .density_limit = 0.1};
}

/* The unit square as a tank of inviscid water at rest, gravity g, m/s^2, downwards, its first
 * `nwalls' sides closed: left, right, bottom, top. */
static inline struct scene *sph_case_tank(struct sph_case *c, int cells, double g, int nwalls)
{
    sph_case_set(c, 2, cells);
    struct scene *e = &c->run.scene;
    e->fluid.nu = 0.0;
    e->fluid.gravity[1] = -g;
    e->initial.field = FIELD_REST;
    e->initial.level = LEVEL_TOP;
    e->domain.periodic[0] = e->domain.periodic[1] = false;
    e->nwalls = nwalls;
    for (int k = 0; k < nwalls; k++)
        e->walls[k].side = SIDE_X_MIN + k;
    return e;
}

/* The tank with a column of water in its left corner that falls, in units of its height; wall
 * terms, Riemann. */
static inline struct scene *sph_case_column(struct sph_case *c, int cells)
{
    struct scene *e = sph_case_tank(c, cells, 1.0, 3);
    e->fluid.rho = 1000.0;
    e->time.end = 10.0;
    e->nshapes = 1;
    e->shapes[0].form = SHAPE_BOX;
    e->shapes[0].box[1][0] = e->shapes[0].box[1][1] = 0.5;
    c->prm.scheme = SCHEME_RIEMANN;
    c->prm.surface = SURFACE_YES;
    c->prm.dissipation = 0.1;
    c->prm.walls = WALLS_NFM;
    c->prm.density_limit = 0.5;
    return e;
}

static inline struct sph *sph_case_start(struct sph_case *c, struct h5 *f)
{
    memcpy(c->prm.box[0], c->run.scene.domain.min, sizeof c->prm.box[0]);
    memcpy(c->prm.box[1], c->run.scene.domain.max, sizeof c->prm.box[1]);
    c->run.motions = motion_files_create(c->run.case_dir);
    const struct body_pace pace = bodies_pace(&c->run.scene, c->run.motions, 0.0);
    c->prm.speed = scene_speed_of(&c->run.scene, pace.speed, 0.0);
    c->s = sph_create(&c->run, &c->prm, f);
    return c->s;
}

/* As run_main does it: steps up to t_stop. */
static inline bool sph_case_run(struct sph_case *c, int steps, double t_stop)
{
    struct diagnosis d = {0};
    for (int k = 0; k < steps && !d.bad; k++) {
        c->run.dt = integrate_step(c->s, t_stop, &d);
        c->run.t = c->s->t;
        c->run.step++;
    }
    return !d.bad;
}

/* Whether `bad' is zero on all ranks; the same answer on all. */
static inline bool none_anywhere(long bad)
{
    MPI_Allreduce(MPI_IN_PLACE, &bad, 1, MPI_LONG, MPI_SUM, MPI_COMM_WORLD);
    return bad == 0;
}

/* The share of the support of each particle that no wall cuts off; mem_free. */
static inline double *sph_case_gammas(struct sph *s)
{
    double *gamma = NEW(double, s->p.n);
    integrate_prepare(s);
    for (int i = 0; i < s->p.n; i++)
        gamma[i] = 1.0;
    s->walls->model->gammas(s, gamma);
    return gamma;
}

static inline double max_anywhere(double v) { return ranks_max(MPI_COMM_WORLD, v); }
/* Particles of all ranks. */
static inline int64_t sph_case_count(const struct sph *s)
{
    return ranks_count(MPI_COMM_WORLD, s->p.n);
}

/* State rows of the n particles of all ranks in the order of their ids, on all ranks; mem_free. */
static inline double *sph_case_gather(const struct sph *s, int n)
{
    const size_t row = (size_t)s->p.nstate;
    double *all = NEW(double, (size_t)n *row);
    for (int i = 0; i < s->p.n; i++)
        memcpy(all + (size_t)s->p.id[i] * row, s->p.y + (size_t)i * row, row * sizeof(double));
    MPI_Allreduce(MPI_IN_PLACE, all, n * (int)row, MPI_DOUBLE, MPI_SUM, s->run->comm);
    return all;
}

/* Root of the mean square, by mass, of what the velocity misses of the exact one: free particles of
 * all levels and ranks, without guards. Collective. */
static inline double velocity_error(const struct sph *s)
{
    const struct exact e = exact_create(&s->run->scene);
    double sums[2] = {0.0, 0.0};
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++) {
            const double *y = state_row(&q->p, q->p.y, i), m = y[at_mass(q->dim)];
            const double x[3] = {y[0], y[1], q->dim == 3 ? y[2] : 0.0};
            double u[3];
            if (particles_is_guard(&q->p, i) || q->p.zone[i] != ZONE_FREE)
                continue;
            exact_point(&e, x, s->t, u, NULL, NULL);
            for (int a = 0; a < q->dim; a++)
                sums[0] += m * pow(y[q->dim + a] / m - u[a], 2.0);
            sums[1] += m;
        }
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    return sqrt(sums[0] / sums[1]);
}

/* nu Lap u of the particles in row `row' above a no-slip wall, u_x = z^power with z the last axis,
 * over the rate by a step so short that nothing moves; R = 4 dx. NAN: the run failed. */
static inline double sph_case_laplacian(int dim, int cells, int row, int power)
{
    struct sph_case c;
    sph_case_set(&c, dim, cells);
    struct scene *e = &c.run.scene;
    const int z = dim - 1, w = 2 * dim + 1;
    e->fluid.nu = 1.0;
    e->domain.periodic[z] = false;
    e->initial.field = FIELD_REST;
    e->nwalls = 2;
    for (int k = 0; k < 2; k++) {
        e->walls[k].side = SIDE_X_MIN + 2 * z + k;
        e->walls[k].kind = WALL_NO_SLIP;
        e->walls[k].velocity[0] = k;
    }
    c.prm.R_dx = 4.0;
    c.prm.scheme = SCHEME_RIEMANN;
    c.prm.transport = TRANSPORT_EULERIAN;
    c.prm.limiter = LIMITER_NONE;
    const struct sph *s = sph_case_start(&c, NULL);
    for (int i = 0; i < s->p.n; i++) {
        double *y = state_row(&s->p, s->p.y, i);
        y[dim] = y[w] * pow(y[z], power);
    }
    const bool good = sph_case_run(&c, 1, 1e-8);
    double most = -1e300;
    for (int i = 0; i < s->p.n; i++) {
        const double *y = state_row(&s->p, s->p.y, i);
        if (fabs(y[z] - (row + 0.5) / cells) < 1e-6)
            most = fmax(most, (y[dim] / y[w] - pow(y[z], power)) / 1e-8);
    }
    DROP(c.s);
    return good ? max_anywhere(most) : NAN;
}
