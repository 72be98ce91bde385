/* zones.c - where the zones lie, and what the flow outside is there; see zones.h. The functions
 * that take a run and its parameters are pure, and serve the checks of a case as well as partners
 * that ask for the boxes before any particle exists.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "zones.h"

#include "../particles/sph_particles.h"
#include "../surface/sph_surface.h"

void zones_widths(const struct run *r, const struct sph_params *prm, double *transition,
                  double *buffer)
{
    const double least = 1.25 * prm->R_dx * prm->dx; /* narrower ones were unstable */
    *transition = r->scene.coupling.transition > 0.0 ? r->scene.coupling.transition : least;
    *buffer = r->scene.coupling.buffer > 0.0 ? r->scene.coupling.buffer : least;
}

/* Outwards to whole particles from domain.min on. */
void zones_around(const struct run *r, const struct sph_params *prm, int a, double free[2][3],
                  double *from, double *to)
{
    const double corner = r->scene.domain.min[a], dx = prm->dx;
    double transition, buffer;
    zones_widths(r, prm, &transition, &buffer);
    *from = corner + dx * floor((free[0][a] - transition - buffer - corner) / dx + 1e-6);
    *to = corner + dx * ceil((free[1][a] + transition + buffer - corner) / dx - 1e-6);
}

const char *zones_extent(int dim, double box[2][3])
{
    static char text[160];
    if (dim == 2)
        snprintf(text, sizeof text, "(%g, %g) to (%g, %g)", box[0][0], box[0][1], box[1][0],
                 box[1][1]);
    else
        snprintf(text, sizeof text, "(%g, %g, %g) to (%g, %g, %g)", box[0][0], box[0][1], box[0][2],
                 box[1][0], box[1][1], box[1][2]);
    return text;
}

void zones_free_box(const struct run *r, const struct sph_params *prm, double lo[3], double hi[3])
{
    double s, b;
    bool open[6];
    zones_widths(r, prm, &s, &b);
    sph_params_open(r, prm, open);
    for (int a = 0; a < 3; a++) {
        lo[a] = prm->box[0][a] + (open[2 * a] ? s + b : 0.0);
        hi[a] = prm->box[1][a] - (open[2 * a + 1] ? s + b : 0.0);
    }
}

/* 0: the case has no such cells. */
double zones_cell(const struct run *r, int a, double *lo)
{
    const struct scene_domain *d = &r->scene.domain;
    double cells[3], graded[3];
    params_peek(r->params, r->comm, "fv.cells", cells);
    params_peek(r->params, r->comm, "fv.graded", graded);
    const bool rows = a == 1 && graded[1] > 0.0;
    const double n = rows ? graded[1] : cells[a];
    *lo = rows ? graded[0] : d->min[a];
    return n > 0.0 ? (d->max[a] - *lo) / n : 0.0;
}

/* Whether sph has a box in the midst of the flow, without solids in it. */
static bool is_confined(const struct run *r, const struct sph_params *prm)
{
    const struct scene *c = &r->scene;
    bool open[6], confined = r->params && prm->outer == OUTER_PARTNER && c->nbodies == 0;
    sph_params_open(r, prm, open);
    for (int side = 0; side < 2 * c->domain.dim; side++)
        confined = confined && open[side];
    for (int k = 0; k < c->nwalls; k++)
        confined = confined && c->walls[k].side != SIDE_NONE;
    return confined && !scene_has_surface(c);
}

/* Where nothing but water is around, fv knows as much of a smooth flow as sph: what sph errs by
 * comes back through fv the less, the farther its imposed cells are from the open sides (of
 * Taylor-Green with 0.07, 0.1, 0.14 L: 0.034, 0.017, 0.008 % of the velocity). Four cells are left,
 * where fv's width is known. */
void zones_overlap(const struct run *r, const struct sph_params *prm, double width[3])
{
    const double given = r->scene.coupling.overlap, least = 1.25 * prm->R_dx * prm->dx;
    const bool confined = given == 0.0 && is_confined(r, prm);
    double lo[3], hi[3], corner;
    zones_free_box(r, prm, lo, hi);
    for (int a = 0; a < 3; a++) {
        const double h = confined ? zones_cell(r, a, &corner) : 0.0;
        width[a] = given > 0.0 ? given : least;
        if (h > 0.0)
            width[a] = fmax(least, 0.5 * (hi[a] - lo[a]) - (2.0 + 1e-6) * h);
    }
}

void zones_given_box(const struct run *r, const struct sph_params *prm, double lo[3], double hi[3])
{
    double width[3];
    bool open[6];
    zones_overlap(r, prm, width);
    zones_free_box(r, prm, lo, hi);
    sph_params_open(r, prm, open);
    for (int a = 0; a < r->scene.domain.dim; a++) {
        lo[a] += open[2 * a] ? width[a] : 0.0;
        hi[a] -= open[2 * a + 1] ? width[a] : 0.0;
    }
}

/* Of uniform cells only whole ones count, rounded into the box; eps keeps a cell whose edge lies on
 * the box's. */
void zones_counted_box(const struct run *r, const struct sph_params *prm, const double way[3],
                       double lo[3], double hi[3])
{
    const struct scene_domain *d = &r->scene.domain;
    double cells[3] = {0.0, 0.0, 0.0}, graded[3] = {0.0, 0.0, 0.0};
    bool open[6];
    zones_given_box(r, prm, lo, hi);
    sph_params_open(r, prm, open);
    for (int a = 0; a < d->dim; a++) {
        lo[a] += way[a];
        hi[a] += way[a];
    }
    if (!r->crossed || !params_peek(r->params, r->comm, "fv.cells", cells))
        return; /* on blocks cells are counted by their share */
    params_peek(r->params, r->comm, "fv.graded", graded);
    for (int a = 0; a < d->dim; a++) {
        const double h = (d->max[a] - d->min[a]) / cells[a], eps = 1e-9;
        if (!(cells[a] > 0.0) || (a == 1 && graded[1] > 0.0))
            continue;
        if (open[2 * a])
            lo[a] = d->min[a] + h * ceil((lo[a] - d->min[a]) / h - eps);
        if (open[2 * a + 1])
            hi[a] = d->min[a] + h * floor((hi[a] - d->min[a]) / h + eps);
    }
}

void zones_room(struct zones *z, int n)
{
    ROOM_IN(z, z->who, n);
    ROOM_IN(z, z->x, 3 * n);
    ROOM_IN(z, z->u, 3 * n);
    ROOM_IN(z, z->p, n);
    ROOM_IN(z, z->gu, 9 * n);
    ROOM_IN(z, z->gp, 3 * n);
    ROOM_IN(z, z->phi, n);
    ROOM_IN(z, z->gphi, 3 * n);
}

/* Below 0: x is beyond that side. */
int zones_nearest(const struct zones *z, const double *x, double *below)
{
    int nearest = 0;
    *below = INFINITY;
    for (int side = 0; side < 2 * z->dim; side++) {
        const double d = zones_inside(z->lo, z->hi, side, x);
        if (z->open[side] && d < *below) {
            *below = d;
            nearest = side;
        }
    }
    return nearest;
}

int zones_upright(const struct sph *s)
{
    int up = 0;
    for (int a = 1; a < s->dim; a++)
        up = fabs(s->gravity[a]) > fabs(s->gravity[up]) ? a : up;
    return up;
}

/* Outwards through the nearest open side, m/s. */
static void add_drain(struct zones *z)
{
    double below;
    for (int k = 0; k < z->n; k++) {
        const int side = zones_nearest(z, z->x + 3 * k, &below);
        z->u[z->dim * k + side / 2] += side % 2 ? z->drain : -z->drain;
    }
}

double zones_wet(const struct zones *z, double phi)
{
    const double dx = z->dx;
    return z->surface ? fmax(0.0, fmin(1.0, (3.0 * dx - phi) / (2.5 * dx))) : 1.0;
}

void zones_look_at_surface(struct zones *z, double t)
{
    z->surface(z->ctx, t, z->n, z->x, z->phi, z->gphi);
}

void zones_add_outflow(const struct zones *z, const double *x, double *u)
{
    double below;
    const int side = zones_nearest(z, x, &below);
    u[side / 2] += (side % 2 ? 1.0 : -1.0) * z->outflow[side];
}

/* The pressure outside is that of a constant density, and where the surface is near no suction:
 * interpolation across it must not make any. The level of the flow inside draws at that outside. In
 * order: no suction near the surface, what particles at rest have there, from the partner's
 * constant density to this equation of state, and the flow that levels ask for. */
static void look_under_surface(struct zones *z, double t)
{
    const struct sph_eos *e = &z->eos;
    z->surface(z->ctx, t, z->n, z->x, z->phi, NULL);
    for (int k = 0; k < z->n; k++) {
        if (z->phi[k] > -z->dx)
            z->p[k] = fmax(z->p[k], 0.0);
        if (z->weight > 0.0)
            z->p[k] += z->weight * rest_excess(-z->phi[k] / z->R);
        z->p[k] = eos_p_from_constant(z->p[k], e->rho0, e->c0, e->gamma);
        zones_add_outflow(z, z->x + 3 * k, z->u + z->dim * k);
    }
}

/* The one place where the outer solution is asked for: then the gauge is added to p, and drain and
 * outflow to u. */
void zones_look(struct zones *z, double t, bool gradients)
{
    if (!z->eval) { /* a partner's patch has not come: at rest */
        memset(z->u, 0, 3 * (size_t)z->n * sizeof *z->u);
        memset(z->p, 0, (size_t)z->n * sizeof *z->p);
        memset(z->gu, 0, 9 * (size_t)z->n * sizeof *z->gu);
        memset(z->gp, 0, 3 * (size_t)z->n * sizeof *z->gp);
        return;
    }
    z->eval(z->ctx, t, z->n, z->x, z->u, z->p, gradients ? z->gu : NULL, gradients ? z->gp : NULL);
    for (int k = 0; k < z->n; k++)
        z->p[k] += z->gauge;
    if (z->surface)
        look_under_surface(z, t);
    if (z->drain != 0.0)
        add_drain(z);
}

double zones_depth(const struct sph *s, const double *x)
{
    double below;
    zones_nearest(s->zones, x, &below);
    return below;
}

/* Falls from 1 to 0 over one dx around the rim of the free zone. */
double zones_share(const struct sph *s, int i)
{
    const double *y = state_row(&s->p, s->p.y, i);
    double f = 1.0;
    for (int side = 0; s->zones && side < 2 * s->dim; side++) {
        const double in = zones_inside(s->lo, s->hi, side, y);
        const double rim = s->zones->buffer + s->zones->transition;
        if (s->open[side])
            f *= fmin(fmax((in - rim) / s->dx + 0.5, 0.0), 1.0);
    }
    return f;
}

/* By depth from the nearest open side, of local particles. */
void zones_mark(struct sph *s)
{
    const struct zones *z = s->zones;
    for (int i = 0; i < s->p.n; i++) {
        const double d = zones_depth(s, state_row(&s->p, s->p.y, i));
        s->p.zone[i] = d < z->buffer                   ? ZONE_BUFFER
                       : d < z->buffer + z->transition ? ZONE_TRANSITION
                                                       : ZONE_FREE;
    }
}

void zones_list(struct sph *s, int i)
{
    struct zones *z = s->zones;
    const double *y = state_row(&s->p, s->p.y, i);
    zones_room(z, z->n + 1);
    for (int a = 0; a < 3; a++)
        z->x[3 * z->n + a] = a < s->dim ? y[a] : 0.0;
    z->who[z->n++] = i;
}
