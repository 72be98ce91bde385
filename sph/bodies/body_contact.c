/* body_contact.c - bodies that touch walls or each other: a spring and damper that act from one
 * spacing before they meet: a row of particles stays between, which pressed flat would be shot out
 * (a block of 3000 kg/m^3 that sinks to the floor ended the run with half of that). Corners of each
 * line against the other; the points of a pair share its stiffness by their depths, so that it has
 * no jumps. Friction after Coulomb, smoothed below a small slip velocity.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <string.h>

#include "../../common/base/mem.h"
#include "../../common/geometry/body_math.h"
#include "bodies.h"
#include "body_touch.h"

/* How many of the largest steps a contact lasts: a body that comes at c0/10 goes 0.3 dx deep. */
enum { CONTACT_STEPS = 6 };

/* Force on the corner's side: out of what it touches, and against its slip. most: damping that a
 * step follows, kg/s. */
static void force_of(const struct touch *t, double share, double k, double d, double friction,
                     double v0, double most, double F[3])
{
    const double un = vec3_dot(t->u, t->out), spring = k * t->depth;
    const double fn = share * spring * fmax(0.0, 1.0 - fmin(d, 1.5 * most / spring) * un);
    double slip[3] = {t->u[0], t->u[1], t->u[2]};
    vec3_add(slip, -un, t->out);
    const double drag = fmin(friction * fn / fmax(vec3_length(slip), v0), 0.2 * share * most);
    for (int a = 0; a < 3; a++)
        F[a] = fn * t->out[a] - drag * slip[a];
}

/* d of the force k depth (1 + d rate/v), v the rate at the first touch, that gives a restitution e:
 * d (1 + e) = ln((1 + d)/(1 - e d)) (after Hunt & Crossley, J. Appl. Mech. 42, 1975). The damping
 * begins at 0, so that steps of any phase see the same. */
static double damping_of(double e)
{
    double lo = 1e-9, hi = 1.0 / e;
    for (int k = 0; k < 80 && e < 1.0; k++) {
        const double mid = 0.5 * (lo + hi);
        *(log1p(mid) - log1p(-e * mid) < mid * (1.0 + e) ? &lo : &hi) = mid;
    }
    return e < 1.0 ? lo : 0.0;
}

/* The rate at the first touch of a pair, m/s. */
static double first_rate(struct walls *w, const struct pair *p)
{
    double *rate = &w->approach[p->a][p->b < 0 ? BODIES_MAX : p->b];
    for (int i = 0; i < p->n && *rate <= 0.0; i++)
        *rate = fmax(*rate, -vec3_dot(p->touch[i].u, p->touch[i].out));
    return *rate;
}

static double mass_of(const struct walls *w, int body)
{
    return body >= 0 && w->bodies[body].free && !w->bodies[body].free->held
               ? w->bodies[body].free->mass
               : INFINITY;
}

/* What a force between two bodies at a touch meets, kg. */
static double mass_at(const struct walls *w, const struct pair *p, const struct touch *t)
{
    double yields = 0.0;
    for (int e = 0; e < 2; e++) {
        const int k = e ? p->b : p->a;
        double arm[3] = {0.0, 0.0, 0.0};
        if (k < 0)
            continue;
        for (int a = 0; a < w->bodies[k].dim; a++)
            arm[a] = t->x[a] - body_centre(w->bodies + k, a);
        yields += 1.0 / body_effective_mass(w->bodies + k, arm, t->out);
    }
    return 1.0 / yields;
}

static void push(struct sph *s, const struct pair *p, double (*loads)[6])
{
    struct walls *w = s->walls;
    const struct scene_contact *c = &w->bodies[p->a].contact;
    const double M = 1.0 / (1.0 / mass_of(w, p->a) + 1.0 / mass_of(w, p->b));
    const double rate = M_PI / (CONTACT_STEPS * w->dt_contact), k = M * rate * rate;
    const double first = first_rate(w, p),
                 d = first > 0.0 ? damping_of(c->restitution) / first : 0.0;
    const double v0 =
        fmax(0.01 * sqrt(vec3_length(s->run->scene.fluid.gravity) * w->bodies[p->a].reach),
             1e-5 * s->c0);
    double all = 0.0;
    if (!isfinite(M))
        return;
    for (int i = 0; i < p->n; i++)
        all += p->touch[i].depth;
    for (int i = 0; i < p->n; i++) {
        const struct touch *t = p->touch + i;
        const int of = t->mine ? p->a : p->b, against = t->mine ? p->b : p->a;
        double F[3];
        force_of(t, t->depth / all, k, d, c->friction, v0, mass_at(w, p, t) / w->dt_contact, F);
        if (of >= 0)
            body_load(w->bodies + of, t->x, F, 1.0, loads[of]);
        if (against >= 0)
            body_load(w->bodies + against, t->x, F, -1.0, loads[against]);
        for (int e = 0; e < 2; e++) {
            const int who = e ? against : of;
            if (who >= 0 && w->bodies[who].free)
                vec3_add(w->bodies[who].free->contact, e ? -1.0 : 1.0, F);
        }
    }
}

void body_contacts_add(struct sph *s, double (*loads)[6])
{
    struct walls *w = s->walls;
    struct pair p = {0};
    for (int a = 0; a < w->nbodies; a++) {
        if (!w->bodies[a].free)
            continue;
        const double gap = w->bodies[a].contact.gap * s->dx;
        for (int b = -1; b < w->nbodies; b++) {
            if (b == a || (b >= 0 && b < a && w->bodies[b].free))
                continue; /* two free ones once */
            p.a = a;
            p.b = b;
            p.n = 0;
            (s->dim == 2 ? pair_find2 : pair_find3)(w, &p, gap);
            if (p.n > 0)
                push(s, &p, loads);
            else
                w->approach[a][b < 0 ? BODIES_MAX : b] = 0.0;
        }
    }
    mem_free(p.touch);
}
