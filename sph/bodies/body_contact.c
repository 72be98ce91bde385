/* body_contact.c - contact of bodies with walls and with each other: a spring and damper that act
 * from one spacing before they meet, so that a row of particles stays between; pressed flat, these
 * would be shot out (a block of 3000 kg/m^3 that sinks to the floor ended the run with half of that
 * distance). Corners of each surface are tested against the other; the points of a pair share its
 * stiffness by their depths, so that it has no jumps. With the depth h and the rate of approach v,
 * v_0 at the first touch, a pair has
 *   F_n = k h (1 + d v/v_0),   k = M (pi/(CONTACT_STEPS dt))^2
 * (after Hunt & Crossley, J. Appl. Mech. 42, 1975), d from the coefficient of restitution, M the
 * pair's reduced mass. Friction after Coulomb, smoothed below a small slip velocity; what a pair
 * rubs there is gathered step by step (hold), so that what friction can hold comes to rest, as by
 * the tangential spring of Cundall & Strack (Geotechnique 29, 1979), and does not creep.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "bodies.h"
#include "body_touch.h"
#include "contact_places.h"

/* How many of the largest steps a contact lasts: a body that comes at c0/10 goes 0.3 dx deep. */
enum { CONTACT_STEPS = 6 };

/* What the touches of a pair have in common: spring, N/m; damping, s/m; Coulomb's coefficient;
 * slip velocity of smooth friction, m/s; what friction has gathered, N, on the first body. */
struct law {
    double k, d, friction, v0, hold[3];
};

/* Force on the corner's side: out of what it touches, and against its slip. most: damping that a
 * step follows, kg/s. Adds what friction gathers in this step to more, N: what damps v' = -c v/M
 * critically, a half of c^2/M times the slip. */
static void force_of(const struct touch *t, double share, const struct law *law, double most,
                     double F[3], double more[3])
{
    const double un = vec3_dot(t->u, t->out), spring = law->k * t->depth,
                 way = t->mine ? 1.0 : -1.0;
    const double fn = share * spring * fmax(0.0, 1.0 - fmin(law->d, 1.5 * most / spring) * un);
    double slip[3] = {t->u[0], t->u[1], t->u[2]}, rub[3] = {0.0, 0.0, 0.0};
    vec3_add(slip, -un, t->out);
    const double drag =
        fmin(law->friction * fn / fmax(vec3_length(slip), law->v0), 0.2 * share * most);
    vec3_add(rub, way * share, law->hold);
    vec3_add(rub, -vec3_dot(rub, t->out), t->out);
    vec3_add(rub, -drag, slip);
    vec3_add(more, -way * drag * drag / (2.0 * share * most), slip);
    const double size = vec3_length(rub),
                 factor = fmin(1.0, law->friction * fn / fmax(size, 1e-300));
    for (int a = 0; a < 3; a++)
        F[a] = fn * t->out[a] + factor * rub[a];
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

/* Walls at rest are the last partner. */
static struct pair_friction *friction_of(struct walls *w, const struct pair *p)
{
    return &w->friction[p->a][p->b < 0 ? BODIES_MAX : p->b];
}

/* What does not yield, because it is at rest, driven or held until its release, counts as infinite.
 */
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
            arm[a] = t->x[a] - (e ? t->shift[a] : 0.0) - body_centre(w->bodies + k, a);
        yields += 1.0 / body_effective_mass(w->bodies + k, arm, t->out);
    }
    return 1.0 / yields;
}

double body_contact_depth(double v, double dt) { return v * CONTACT_STEPS * dt / M_PI; }

/* 1/s */
static double rate_of(const struct walls *w) { return M_PI / (CONTACT_STEPS * w->dt_contact); }

/* Both bodies of a pair get every touch's force with opposite signs at one point, so that a pair
 * keeps its momentum and angular momentum. The spring goes by the bodies' whole masses, damping and
 * friction by what yields at the touch. */
static void push(struct sph *s, const struct pair *p, double (*loads)[6])
{
    struct walls *w = s->walls;
    const struct scene_contact *c = &w->bodies[p->a].contact;
    const double M = 1.0 / (1.0 / mass_of(w, p->a) + 1.0 / mass_of(w, p->b));
    const double rate = rate_of(w), k = M * rate * rate;
    const double first = first_rate(w, p);
    struct pair_friction *rubs = friction_of(w, p);
    struct law law = {
        .k = k,
        .d = first > 0.0 ? damping_of(c->restitution) / first : 0.0,
        .friction = c->friction,
        .v0 = fmax(0.01 * sqrt(vec3_length(s->run->scene.fluid.gravity) * w->bodies[p->a].reach),
                   1e-5 * s->c0)};
    double all = 0.0, pressed = 0.0;
    memcpy(law.hold, rubs->hold, sizeof law.hold);
    memset(rubs->more, 0, sizeof rubs->more);
    if (!isfinite(M))
        return;
    for (int i = 0; i < p->n; i++)
        all += p->touch[i].depth;
    for (int i = 0; i < p->n; i++) {
        const struct touch *t = p->touch + i;
        const int of = t->mine ? p->a : p->b, against = t->mine ? p->b : p->a;
        double F[3], beside[3];
        vec3_from(t->shift, t->x, beside);
        force_of(t, t->depth / all, &law, mass_at(w, p, t) / w->dt_contact, F, rubs->more);
        pressed += vec3_dot(F, t->out);
        if (of >= 0)
            body_load(w->bodies + of, t->mine ? t->x : beside, F, 1.0, loads[of]);
        if (against >= 0)
            body_load(w->bodies + against, t->mine ? beside : t->x, F, -1.0, loads[against]);
        for (int e = 0; e < 2; e++) {
            const int who = e ? against : of;
            if (who >= 0 && w->bodies[who].free)
                vec3_add(w->bodies[who].free->contact, e ? -1.0 : 1.0, F);
        }
    }
    rubs->most = c->friction * pressed;
}

/* Next pair of a free body (b: -1 the walls at rest) that can touch, two free ones once; false: no
 * more. Begins with a = 0, b = -2. */
static bool next_pair(const struct walls *w, struct pair *p)
{
    while (p->a < w->nbodies) {
        p->b++;
        if (p->b == w->nbodies || !w->bodies[p->a].free) {
            p->a++;
            p->b = -2;
        } else if (p->b != p->a && !(p->b >= 0 && p->b < p->a && w->bodies[p->b].free))
            return true;
    }
    return false;
}

/* m */
static double gap_of(const struct sph *s, const struct pair *p)
{
    return s->walls->bodies[p->a].contact.gap * s->dx;
}

/* Of the first body of the pair with the second, and with the images of that across periods: those
 * of walls at rest are walls of their own. The gap is that of the first body. */
static void find(const struct sph *s, struct pair *p)
{
    int way[3], most[3] = {0, 0, 0};
    for (int a = 0; a < s->dim && p->b >= 0; a++)
        most[a] = s->periodic[a];
    p->n = p->image = 0;
    for (way[0] = -most[0]; way[0] <= most[0]; way[0]++)
        for (way[1] = -most[1]; way[1] <= most[1]; way[1]++)
            for (way[2] = -most[2]; way[2] <= most[2]; way[2]++, p->image++) {
                for (int a = 0; a < 3; a++)
                    p->shift[a] = way[a] ? way[a] * (s->hi[a] - s->lo[a]) : 0.0;
                (s->dim == 2 ? pair_find2 : pair_find3)(s->walls, p, gap_of(s, p));
            }
}

static double *start_gap(struct walls *w, const struct pair *p)
{
    return &w->start_gap[p->a][p->b < 0 ? BODIES_MAX : p->b];
}

/* dx: what is left between a body and what it stands on, or beside, at the start: faces that
 * coincide have no order, and water would come through. Less below, so that what it stands on is
 * the nearest at a corner. */
static const double stand_off = 0.002, side_off = 0.003;
enum { STAND_OFF_PASSES = 20 };

/* Moves the free body of a touch, of two the one that lies above, out of what it stands on. */
static bool lift(struct sph *s, const struct pair *p, const struct touch *t)
{
    struct walls *w = s->walls;
    const int of = t->mine ? p->a : p->b, against = t->mine ? p->b : p->a;
    const double *gravity = s->run->scene.fluid.gravity, down = -vec3_dot(gravity, t->out);
    const bool other =
        of < 0 || !w->bodies[of].free || (against >= 0 && w->bodies[against].free && down < 0.0);
    struct body *b = w->bodies + (other ? against : of);
    const double g = vec3_length(gravity), want = fabs(down) > 0.1 * g ? stand_off : side_off,
                 gap = w->bodies[p->a].contact.gap * s->dx, way = want * s->dx - (gap - t->depth);
    if (way <= 1e-6 * s->dx || b->free->hinged || b->free->slides)
        return false;
    for (int a = 0; a < b->dim; a++)
        b->free->y[a] += (other ? -way : way) * t->out[a];
    return true;
}

/* So that nothing that starts in contact begins with faces that coincide. */
static void stand_apart(struct sph *s)
{
    bool any = true;
    for (int pass = 0; pass < STAND_OFF_PASSES && any; pass++) {
        struct pair p = {.b = -2};
        any = false;
        while (next_pair(s->walls, &p)) {
            find(s, &p);
            int deepest = 0;
            for (int i = 1; i < p.n; i++)
                if (p.touch[i].depth > p.touch[deepest].depth)
                    deepest = i;
            if (p.n > 0 && lift(s, &p, p.touch + deepest)) {
                any = true;
                walls_move(s, s->t);
            }
        }
        mem_free(p.touch);
    }
}

/* Out of what the other is, for the first body of the pair. */
static void way_of(const struct touch *t, double *way)
{
    for (int a = 0; a < 3; a++)
        way[a] = t->mine ? t->out[a] : -t->out[a];
}

static const double same_way = 0.7; /* cosine */

/* The way on which a body stands off the walls at rest at the start; 0: it touches several. */
static void note_way(struct walls *w, const struct pair *p)
{
    double *first = w->start_way[p->a], way[3];
    memset(first, 0, 3 * sizeof *first);
    if (p->n > 0)
        way_of(p->touch, first);
    for (int i = 1; i < p->n; i++) {
        way_of(p->touch + i, way);
        if (vec3_dot(way, first) < same_way)
            memset(first, 0, 3 * sizeof *first);
    }
}

/* m: how deep the spring of a touch is pressed by what rests there with its weight. */
static double sag(const struct sph *s, const struct touch *t)
{
    const double down = (t->mine ? -1.0 : 1.0) * vec3_dot(s->run->scene.fluid.gravity, t->out),
                 rate = rate_of(s->walls);
    return fmax(down, 0.0) / (rate * rate);
}

/* Whether it touches the walls at rest elsewhere than where it stood at the start: what slides over
 * a floor into a side has no spring of the floor's there. It went through. */
static bool is_new(const struct walls *w, const struct pair *p, const struct touch *t)
{
    double way[3];
    way_of(t, way);
    return p->b < 0 && vec3_length(w->start_way[p->a]) > 0.0 &&
           vec3_dot(way, w->start_way[p->a]) < same_way;
}

/* With levels once for the state, which all share, and for each level's own copy of the distances.
 */
void body_contacts_start(struct sph *s)
{
    struct pair p = {.b = -2};
    struct contact_places places = {0, 0, NULL};
    if (!s->coarser)
        stand_apart(s);
    while (next_pair(s->walls, &p)) {
        double *from = start_gap(s->walls, &p);
        *from = INFINITY;
        find(s, &p);
        for (int i = 0; i < p.n; i++)
            *from = fmin(*from, gap_of(s, &p) - p.touch[i].depth);
        if (p.b < 0)
            note_way(s->walls, &p);
        for (int i = 0; i < p.n; i++)
            if (p.touch[i].sharp) {
                struct contact_place *c =
                    contact_places_add(s, &places, &p, p.touch + i, gap_of(s, &p));
                c->first = c->from += sag(s, p.touch + i);
            }
    }
    contact_places_take(s->walls, &places);
    mem_free(p.touch);
}

/* Where the contact of a touch begins, m. A pair that has been in contact since the start rests on
 * the distance that it had there, by a spring that carries the weight from the first step on: else
 * it would sink into what it stands on. */
static double begins_at(const struct sph *s, const struct pair *p, const struct touch *t,
                        struct contact_places *places)
{
    const double gap = gap_of(s, p), start = *start_gap(s->walls, p);
    if (t->sharp)
        return contact_places_add(s, places, p, t, gap)->from;
    return isfinite(start) && !is_new(s->walls, p, t) ? start + sag(s, t) : gap;
}

static void keep_start(struct sph *s, struct pair *p, struct contact_places *places)
{
    int n = 0;
    if (p->n == 0)
        *start_gap(s->walls, p) = INFINITY;
    for (int i = 0; i < p->n; i++) {
        p->touch[n] = p->touch[i];
        p->touch[n].depth += begins_at(s, p, p->touch + i, places) - gap_of(s, p);
        n += p->touch[n].depth > 0.0;
    }
    p->n = n;
}

/* Once a stage. What has parted forgets its first rate of approach and its friction. */
void body_contacts_add(struct sph *s, double (*loads)[6])
{
    struct walls *w = s->walls;
    struct pair p = {.b = -2};
    struct contact_places places = {0, 0, NULL};
    while (next_pair(w, &p)) {
        find(s, &p);
        keep_start(s, &p, &places);
        if (p.n > 0)
            push(s, &p, loads);
        else {
            w->approach[p.a][p.b < 0 ? BODIES_MAX : p.b] = 0.0;
            *friction_of(w, &p) = (struct pair_friction){.most = 0.0};
        }
    }
    contact_places_take(w, &places);
    mem_free(p.touch);
}

/* Once a step: friction gathers over steps, not stages, and at most what Coulomb allows. */
void body_contacts_finish(struct sph *s)
{
    struct walls *w = s->walls;
    contact_places_settle(s);
    for (struct pair p = {.b = -2}; next_pair(w, &p);) {
        struct pair_friction *f = friction_of(w, &p);
        vec3_add(f->hold, 1.0, f->more);
        const double size = vec3_length(f->hold), factor = size > f->most ? f->most / size : 1.0;
        for (int a = 0; a < 3; a++)
            f->hold[a] *= factor;
    }
}
