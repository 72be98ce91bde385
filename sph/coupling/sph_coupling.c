/* sph_coupling.c - SPH's place in a coupled job: gives its particles, takes patches of the flow
 * outside. Order of a window (Chiron 2017, 6.2): SPH runs first on the extrapolated patch, hands
 * its particles over, and takes the next patch when its partner has followed.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <string.h>

#include "../../common/log.h"
#include "../../common/mem.h"
#include "../../coupler/cpl.h"
#include "../parallel/domain.h"
#include "../particles/eos.h"
#include "../open_boundaries/level_gap.h"
#include "overlap.h"
#include "../sph_params.h"
#include "windows.h"
#include "../open_boundaries/zones.h"

/* Ids of the sets and fields, and scratch for what is sent. */
struct link {
    struct cpl *c;
    int dim, particles, velocity, pressure, patch_velocity, patch_pressure;
    int budget, water;  /* one point, at the free zone's corner; what that zone holds */
    int one, patch_phi; /* where a surface crosses: how much of a kernel particles fill; fv's */
    double *x, *u, *p, *w, *ones;
    int64_t *id;
    int capacity;
};

static void check(const struct link *k, int code)
{
    if (code == CPL_EPARTNER || code == CPL_EINPUT) {
        signals_handled(); /* cpl_fail says it */
        cpl_fail(k->c, RUN_PARTNER, cpl_strerror(k->c));
    }
    if (code)
        fail("coupling: %s", cpl_strerror(k->c));
}

void coupling_offer(struct run *r)
{
    const struct sph_params *prm = sph_params_of(r);
    double lo[3], hi[3];
    zones_free_box(r, prm, lo, hi);
    cpl_zone(r->partner_ctx, "sph.box", prm->box[0], prm->box[1]);
    cpl_zone(r->partner_ctx, "sph.free", lo, hi);
    zones_given_box(r, prm, lo, hi);
    cpl_zone(r->partner_ctx, "sph.given", lo, hi);
    /* a number that travels as a box: windows over which pressure is smoothed */
    const double memory[3] = {windows_choose(r, prm).memory, 0.0, 0.0};
    cpl_zone(r->partner_ctx, "sph.memory", memory, memory);
}

/* Values and gradients of the patch, one field after the other. */
static void eval_patch(void *ctx, double t, int n, const double *x, double *u, double *p,
                       double *gu, double *gp)
{
    const struct link *k = ctx;
    cpl_patch_eval(k->c, k->patch_velocity, t, n, x, u, gu);
    cpl_patch_eval(k->c, k->patch_pressure, t, n, x, p, gp);
}

static void eval_surface(void *ctx, double t, int n, const double *x, double *phi, double *gphi)
{
    const struct link *k = ctx;
    cpl_patch_eval(k->c, k->patch_phi, t, n, x, phi, gphi);
}

void coupling_create(struct sph *s)
{
    struct link *k = NEW(struct link, 1);
    const int how = s->run->scene.coupling.interpolation ? CPL_CUBIC : CPL_LINEAR;
    k->c = s->run->partner_ctx;
    k->dim = s->dim;
    check(k, cpl_points(k->c, "sph.particles", s->dim, 0.0, &k->particles));
    check(k,
          cpl_field(k->c, k->particles, "sph.velocity", "m/s", s->dim, CPL_PUT, 0, &k->velocity));
    check(k, cpl_field(k->c, k->particles, "sph.pressure", "Pa", 1, CPL_PUT | CPL_OPTIONAL, 0,
                       &k->pressure));
    check(k, cpl_field(k->c, k->particles, "fv.velocity", "m/s", s->dim, CPL_GET, how,
                       &k->patch_velocity));
    check(k,
          cpl_field(k->c, k->particles, "fv.pressure", "Pa", 1, CPL_GET, how, &k->patch_pressure));
    if (s->run->crossed) {
        check(k, cpl_field(k->c, k->particles, "sph.one", "-", 1, CPL_PUT, 0, &k->one));
        check(k,
              cpl_field(k->c, k->particles, "fv.phi", "m", 1, CPL_GET, CPL_LINEAR, &k->patch_phi));
        check(k, cpl_points(k->c, "sph.budget", s->dim, 0.0, &k->budget));
        check(k, cpl_field(k->c, k->budget, "sph.water", "m^dim", 1, CPL_PUT, 0, &k->water));
        s->zones->surface = eval_surface;
    }
    s->zones->eval = eval_patch;
    s->zones->ctx = k;
    s->zones->watched = overlap_create(s);
}

void coupling_free(struct sph *s)
{
    struct link *k = s->zones->ctx;
    overlap_free(&s->zones->watched);
    mem_free(k->x);
    mem_free(k->u);
    mem_free(k->p);
    mem_free(k->w);
    mem_free(k->ones);
    mem_free(k->id);
    mem_free(k);
}

/* All ranks know the surface around the whole region: faces and probes are everybody's. */
static void take_surface(struct sph *s)
{
    const struct link *k = s->zones->ctx;
    double lo[3], hi[3];
    for (int a = 0; a < 3; a++) {
        lo[a] = s->lo[a] - (a < s->dim ? s->R : 0.0);
        hi[a] = s->hi[a] + (a < s->dim ? s->R : 0.0);
    }
    check(k, cpl_patch_get(k->c, k->patch_phi, lo, hi));
    s->ready = false; /* the lattice behind the faces ends at the surface, which is another now */
    if (!s->zones->gap->started)
        level_gap_look(s, 0.0);
}

/* The patch that this rank's particles and faces may need until the end of the window. */
void coupling_window_begin(void *state, double t0, double t1)
{
    (void)t0;
    (void)t1;
    struct sph *s = state;
    const struct link *k = s->zones->ctx;
    double lo[3], hi[3];
    domain_bounds(s->domain, lo, hi);
    for (int a = 0; a < 3; a++) {
        lo[a] -= a < s->dim ? s->R : 0.0;
        hi[a] += a < s->dim ? s->R : 0.0;
    }
    check(k, cpl_patch_get(k->c, k->patch_velocity, lo, hi));
    check(k, cpl_patch_get(k->c, k->patch_pressure, lo, hi));
    if (s->zones->surface)
        take_surface(s);
    zones_gauge(s);
    overlap_look(s);
}

static void room(struct link *k, int n)
{
    if (n <= k->capacity)
        return;
    const int old = k->capacity;
    k->capacity = n + n / 4;
    GROW(k->x, 3 * old, 3 * k->capacity);
    GROW(k->u, k->dim * old, k->dim * k->capacity);
    GROW(k->p, old, k->capacity);
    GROW(k->w, old, k->capacity);
    GROW(k->ones, old, k->capacity);
    for (int i = old; i < k->capacity; i++)
        k->ones[i] = 1.0;
    GROW(k->id, old, k->capacity);
}

/* Where the n particles are that are given: ones; and how much water the free zone holds. */
static void give_surface(struct sph *s, int n, double t)
{
    const struct link *k = s->zones->ctx;
    const double water = zones_water(s);
    double lo[3], hi[3];
    const int64_t id = 0;
    zones_free_box(s->run, &s->prm, lo, hi);
    check(k, cpl_put(k->c, k->one, t, n, k->ones, NULL));
    room((struct link *)s->zones->ctx, 1);
    const int mine = s->run->rank == 0 ? 1 : 0;
    check(k, cpl_move(k->c, k->budget, mine, lo, &id, k->ones));
    check(k, cpl_put(k->c, k->water, t, mine, &water, NULL));
}

/* Particles of the free zone and the blended ones; never buffer particles, which would give the
 * partner its own values back. */
void coupling_window_end(void *state, double t1)
{
    struct sph *s = state;
    struct link *k = s->zones->ctx;
    const int dim = s->dim;
    int n = 0;
    room(k, s->p.n);
    for (int i = 0; i < s->p.n; i++) {
        const double *y = state_row(&s->p, s->p.y, i);
        if (zones_depth(s, y) < s->zones->buffer)
            continue;
        for (int a = 0; a < 3; a++)
            k->x[3 * n + a] = a < dim ? y[a] : 0.0;
        for (int a = 0; a < dim; a++)
            k->u[dim * n + a] = y[dim + a] / y[at_mass(dim)];
        k->p[n] = eos_p(y[at_mass(dim)] / y[at_volume(dim)], s->rho0, s->c0, s->gamma);
        k->w[n] = y[at_volume(dim)];
        k->id[n++] = s->p.id[i];
    }
    check(k, cpl_move(k->c, k->particles, n, k->x, k->id, k->w));
    check(k, cpl_put(k->c, k->velocity, t1, n, k->u, NULL));
    check(k, cpl_put(k->c, k->pressure, t1, n, k->p, NULL));
    if (s->zones->surface)
        give_surface(s, n, t1);
}
