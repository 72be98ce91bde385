/* sph_fault.c - when the state cannot be trusted: a particle that is not finite, faster than sound,
 * or denser than impacts at the speeds seen so far can make it. The worst of all ranks is named by
 * its place; the cause follows from what is measured there. SPDX-License-Identifier: BSD-3-Clause
 */
#include "../particles/sph_particles.h"
#include "../sph.h"
#include "../walls/sph_walls.h"

/* Everything a double, so that ranks can exchange it. */
struct culprit {
    double fault, before; /* of the state, and of that at the start of the step; < 0: none */
    double x[3], speed, rho;
    double started[2]; /* speed and density at the start of the step */
    double zone, level;
};
enum { CULPRIT = sizeof(struct culprit) / sizeof(double) };

/* What is around it. */
struct fault_place {
    double pair; /* m: to the nearest particle */
    int near;    /* particles within R */
    double wall; /* m: to the nearest wall; INFINITY: none */
};

static const double fastest = 1.0; /* c0 */

/* The largest |rho/rho0 - 1| that is legal. */
static double legal_change(const struct sph *s)
{
    if (s->prm.density_limit > 0.0)
        return s->prm.density_limit;
    return fmin(0.1 + fmax(s->watch.rest, s->watch.friction) + 2.0 * s->total.max_mach, 0.5);
}

/* 0 times a number is 0 for finite ones and NaN for the rest, so one sum tests the whole record. */
double sph_fault_of(const struct sph *s, const double *y, double *speed, double *rho)
{
    const int dim = s->dim;
    const double m = y[at_mass(dim)];
    double u2 = 0.0, sum = 0.0;
    for (int k = 0; k < s->p.nstate; k++)
        sum += 0.0 * y[k];
    for (int a = 0; a < dim; a++)
        u2 += y[dim + a] * y[dim + a];
    *speed = sqrt(u2) / m;
    *rho = m / y[at_volume(dim)];
    if (sum != 0.0 || !isfinite(*speed) || !isfinite(*rho) || *rho <= 0.0)
        return 1e300;
    return fmax(fabs(*rho / s->rho0 - 1.0) / legal_change(s), *speed / (fastest * s->c0));
}

/* Whether a is worse than b, so that all ranks, and any number of them, choose the same: faults
 * alike to rounding go by what they were before the step, then by place. */
static bool is_worse(const struct culprit *a, const struct culprit *b)
{
    const double near = 1e-6;
    if (fabs(a->fault - b->fault) > near * fabs(b->fault))
        return a->fault > b->fault;
    if (fabs(a->before - b->before) > near * fabs(b->before))
        return a->before > b->before;
    for (int k = 0; k < 3; k++)
        if (a->x[k] != b->x[k])
            return a->x[k] < b->x[k];
    return false;
}

/* A particle that is not finite is shown where it was. */
static struct culprit look_at(const struct sph *s, int i)
{
    const int dim = s->dim;
    const double *y = state_row(&s->p, s->p.y, i), *y0 = state_row(&s->p, s->p.y0, i);
    struct culprit c = {.zone = s->zones ? s->p.zone[i] : 0, .level = s->level};
    c.fault = sph_fault_of(s, y, &c.speed, &c.rho);
    c.before = sph_fault_of(s, y0, c.started, c.started + 1);
    for (int a = 0; a < dim; a++)
        c.x[a] = c.fault < 1e300 ? y[a] : y0[a];
    return c;
}

/* Collective. O(n) on each rank and one gather of CULPRIT doubles from each; called only when a run
 * ends or is about to be warned of. */
static struct culprit find_worst(const struct sph *s)
{
    struct culprit worst = {.fault = -1.0, .before = -1.0};
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++) {
            const struct culprit c = look_at(q, i);
            if (is_worse(&c, &worst))
                worst = c;
        }
    struct culprit *all = NEW(struct culprit, s->run->size);
    MPI_Allgather(&worst, CULPRIT, MPI_DOUBLE, all, CULPRIT, MPI_DOUBLE, s->run->comm);
    worst = all[0];
    for (int k = 1; k < s->run->size; k++)
        if (is_worse(all + k, &worst))
            worst = all[k];
    mem_free(all);
    return worst;
}

/* Distance to the nearest wall, m; INFINITY without walls. In 3D only plane sides count, for meshes
 * are not searched here. */
static double wall_distance(const struct sph *s, const double *x)
{
    double least = INFINITY;
    if (!s->walls)
        return least;
    if (s->dim == 2)
        return fabs(walls_distance(s->walls, x, INFINITY));
    for (int k = 0; k < s->walls->nplanes; k++) {
        const struct wall_plane *p = s->walls->planes + k;
        least = fmin(least, fabs(x[p->axis] - p->at));
    }
    return least;
}

/* What is around the place c, which may be on any rank: distance of the nearest particle and number
 * within R. A particle that is not finite any more is looked at where it was, at the start of the
 * step. Collective. */
static struct fault_place survey(const struct sph *s, const struct culprit *c)
{
    const double *x = c->x, *rows = c->fault < 1e300 ? s->p.y : s->p.y0;
    struct fault_place p = {.pair = INFINITY, .wall = wall_distance(s, x)};
    for (int i = 0; i < s->p.n; i++) {
        const double *y = rows + (size_t)i * s->p.nstate;
        double r2 = 0.0;
        for (int a = 0; a < s->dim; a++) {
            double d = fabs(y[a] - x[a]);
            if (s->periodic[a])
                d = fmin(d, s->hi[a] - s->lo[a] - d);
            r2 += d * d;
        }
        if (r2 == 0.0 || !(r2 < s->R * s->R)) /* itself, or far */
            continue;
        p.pair = fmin(p.pair, sqrt(r2));
        p.near++;
    }
    MPI_Allreduce(MPI_IN_PLACE, &p.pair, 1, MPI_DOUBLE, MPI_MIN, s->run->comm);
    MPI_Allreduce(MPI_IN_PLACE, &p.near, 1, MPI_INT, MPI_SUM, s->run->comm);
    return p;
}

/* Writes position, zone, neighbours and the distance from a wall to d->where. */
static void describe_where(const struct sph *s, const struct culprit *c,
                           const struct fault_place *p, struct diagnosis *d)
{
    static const char *const zone[] = {"", ", in the transition", ", in the buffer"};
    char third[32] = "", wall[64] = "", pair[64] = ", alone";
    if (s->dim == 3)
        snprintf(third, sizeof third, ", %.4g", c->x[2]);
    if (p->near > 0)
        snprintf(pair, sizeof pair, ", %d within R, the nearest at %.2g dx", p->near,
                 p->pair / s->dx);
    if (p->wall < s->R)
        snprintf(wall, sizeof wall, ", %.2g dx from a wall", p->wall / s->dx);
    snprintf(d->where, sizeof d->where, "(%.4g, %.4g%s) m%s%s%s", c->x[0], c->x[1], third,
             zone[(int)c->zone], pair, wall);
}

/* Writes what is wrong with the particle to d->reason, with the limit that it breaks. */
static void describe_fault(const struct sph *s, const struct culprit *c, struct diagnosis *d)
{
    if (c->fault >= 1e300)
        snprintf(d->reason, sizeof d->reason,
                 "a particle is not finite any more; before the step |u| was %.3g m/s, rho %.4g "
                 "kg/m^3",
                 c->started[0], c->started[1]);
    else if (c->speed > fastest * s->c0)
        snprintf(d->reason, sizeof d->reason, "|u| of a particle is %.3g m/s, limit c0 = %.3g m/s",
                 c->speed, fastest * s->c0);
    else
        snprintf(d->reason, sizeof d->reason,
                 "density of a particle is %.4g kg/m^3, %+.1f %% from rho0, limit %.3g %%", c->rho,
                 100.0 * (c->rho / s->rho0 - 1.0), 100.0 * legal_change(s));
}

/* The first that the figures bear out. They are ordered from what is certain (a parameter beyond a
 * stability bound) to what is likely; each remedy names the key and a value. */
static void describe_cause(const struct sph *s, const struct culprit *c,
                           const struct fault_place *p, struct diagnosis *d)
{
    const size_t n = sizeof d->likely;
    const double bound = sph_params_cfl_bound(&s->prm, s->dim);
    const double expected = s->watch.reference;
    const double speed = c->fault < 1e300 ? c->speed : c->started[0];
    if (s->prm.cfl > bound)
        snprintf(d->likely, n,
                 "sph.cfl = %.3g is above the stability bound of this scheme, %.2g: lower it",
                 s->prm.cfl, bound);
    else if (s->total.max_mach > 0.2 && s->c0 < 5.0 * expected)
        snprintf(d->likely, n,
                 "sph.c0 = %.4g m/s is too low: raise it to %.3g m/s, ten times the speed that the "
                 "scene makes",
                 s->c0, 10.0 * expected);
    else if (s->watch.friction > 0.03)
        snprintf(
            d->likely, n,
            "sph.c0 = %.4g m/s is too low: friction compresses this slow flow by %.2g %%; raise "
            "it to %.3g m/s",
            s->c0, 100.0 * s->watch.friction, 10.0 * s->c0 * sqrt(s->watch.friction));
    else if (s->prm.density_limit > 0.0 && c->speed <= fastest * s->c0 && c->fault < 1e300)
        snprintf(d->likely, n,
                 "sph.density_limit = %.3g is tight: impacts at Mach %.2g compress by as much; "
                 "leave it out, or raise sph.c0 = %.4g m/s",
                 s->prm.density_limit, s->total.max_mach, s->c0);
    else if (p->wall < s->dx && speed > 2.0 * expected)
        snprintf(d->likely, n,
                 "a wall ejects it: the scene makes %.3g m/s at most; refine sph.dx = %.3g m at "
                 "this corner, or take another sph.walls",
                 expected, s->dx);
    else if (p->near > 0 && p->pair < 0.2 * s->dx)
        snprintf(d->likely, n,
                 "two particles have run into each other: set sph.transport = \"tvs\", refine "
                 "sph.dx = %.3g m or raise sph.c0 = %.4g m/s",
                 s->dx, s->c0);
    else if (speed > 0.2 * s->c0)
        snprintf(d->likely, n,
                 "the flow is faster than the %.3g m/s expected in the scene: raise sph.c0 = %.4g "
                 "m/s to ten times its speed",
                 expected, s->c0);
    else
        snprintf(d->likely, n,
                 "the flow is not resolved here: refine sph.dx = %.3g m, or lower sph.cfl = %.3g",
                 s->dx, s->prm.cfl);
}

/* The level that the particle belongs to, whose spacing and support the texts speak of. */
static const struct sph *level_of(const struct sph *s, const struct culprit *c)
{
    while (s->finer && s->level < c->level)
        s = s->finer;
    return s;
}

void sph_fault_place(struct sph *base, struct diagnosis *d)
{
    const struct culprit c = find_worst(base);
    const struct sph *s = level_of(base, &c);
    const struct fault_place p = survey(s, &c);
    describe_where(s, &c, &p, d);
}

/* The worst particle of all levels and ranks, what is around it, then what may be the cause.
 * Collective. */
void sph_fault_diagnose(struct sph *base, struct diagnosis *d)
{
    const struct culprit c = find_worst(base);
    const struct sph *s = level_of(base, &c);
    const struct fault_place p = survey(s, &c);
    d->bad = true;
    describe_fault(s, &c, d);
    describe_where(s, &c, &p, d);
    describe_cause(s, &c, &p, d);
}
