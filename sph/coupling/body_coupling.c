/* body_coupling.c - see body_coupling.h. The force is the impulse of the fluid over the coupling
 * step divided by its length, so that a partner that integrates it loses no momentum; the motion
 * that a partner gives is read at the end of the step, by its own extrapolation from the start, and
 * taken up by then (body_courses.h). A body that bends has a set of points of its own, those of its
 * outline at the start, with the loads on them and their motion. Rank 0 holds the points.
 * SPDX-License-Identifier: BSD-3-Clause
 */
#include "body_coupling.h"

#include "../../common/params/params.h"
#include "../../coupler/cpl_partner.h"
#include "../bodies/sph_bodies.h"
#include "../particles/sph_particles.h"
#include "../walls/sph_walls.h"

enum { PLACE = 2 * BODY_AXES, BENT = 4 }; /* displacement and velocity along x and y */

struct body_coupling {
    struct cpl *c;
    int set;
    int force[BODIES_MAX], motion[BODIES_MAX], moved[BODIES_MAX]; /* moved: -1: by no partner */
    int load[BODIES_MAX];                                         /* of bodies that bend */
    struct force before[BODIES_MAX];                              /* N s: at t0 */
    double t0;
};

static bool any_partnered(const struct run *r)
{
    bool any = false;
    for (int k = 0; k < r->scene.nbodies; k++)
        any = any || scene_body_partnered(r->scene.bodies + k);
    return any;
}

/* Without a job nobody could move it. */
bool body_coupling_possible(const struct run *r)
{
    struct faults f = {0};
    for (int k = 0; k < r->scene.nbodies && !r->coupled; k++) {
        if (scene_body_partnered(r->scene.bodies + k))
            params_fault(r->params, &f, key_text("bodies.[%d].motion", k),
                         "a partner is to move body `%s', but no other program takes part in this "
                         "job: start it with cases/run CASE --with 'PROGRAM ...'",
                         r->scene.bodies[k].name);
    }
    return params_report(&f) == 0;
}

/* "sph.flap.force"; without the program: "flap.motion". Blanks of a name become underscores. */
static const char *field_of(const struct run *r, const char *program, int body, const char *what)
{
    static char text[CPL_NAME];
    const int n = snprintf(text, sizeof text, "%s%s%s.%s", program, *program ? "." : "",
                           r->scene.bodies[body].name, what);
    if (n >= (int)sizeof text)
        fail_with(RUN_INPUT,
                  "bodies.[%d].name: `%s' is too long for a field of a coupled job: at "
                  "most %d letters",
                  body, r->scene.bodies[body].name,
                  CPL_NAME - 9 - (int)strlen(*program ? program : "sph"));
    for (char *c = text; *c; c++)
        *c = *c == ' ' ? '_' : *c;
    return text;
}

/* The points of an outline that bends, where the case has them, and the fields on them. */
static void create_bend(struct sph *s, struct body_coupling *k, int b)
{
    const struct param_points *p = &s->run->scene.bodies[b].points;
    const int mine = s->run->rank == 0 ? p->n : 0;
    int set;
    double(*const x)[3] = mem_new((size_t)p->n, sizeof *x);
    int64_t *const id = NEW(int64_t, p->n);
    double *const one = NEW(double, p->n);
    for (int i = 0; i < p->n; i++) {
        x[i][0] = p->x[i][0];
        x[i][1] = p->x[i][1];
        id[i] = i;
        one[i] = 1.0;
    }
    partner_check(k->c, cpl_points(k->c, field_of(s->run, s->run->name, b, "outline"), 2,
                                   0.01 * s->dx, &set));
    partner_check(k->c, cpl_field(k->c, set, field_of(s->run, s->run->name, b, "load"), "N", 2,
                                  CPL_PUT | CPL_OPTIONAL, 0, k->load + b));
    partner_check(k->c, cpl_field(k->c, set, field_of(s->run, "", b, "outline"), "m", BENT, CPL_GET,
                                  CPL_NEAREST, k->moved + b));
    partner_check(k->c, cpl_move(k->c, set, mine, *x, id, one));
    FREE(x, id, one);
}

/* All bodies are at one place of one set: their numbers have none. */
void body_coupling_create(struct sph *s)
{
    static const double origin[3] = {0.0, 0.0, 0.0}, one = 1.0;
    const struct run *r = s->run;
    const int mine = r->rank == 0, n = s->walls ? s->walls->nbodies : 0;
    const int64_t id = 0;
    char set[CPL_NAME];
    if (n == 0)
        return;
    struct body_coupling *k = s->body_coupling = NEW_IN(s, struct body_coupling, 1);
    k->c = r->partner_ctx;
    snprintf(set, sizeof set, "%.50s.bodies", r->name);
    partner_check(k->c, cpl_points(k->c, set, s->dim, 1.0, &k->set));
    for (int b = 0; b < n; b++) {
        partner_check(k->c, cpl_field(k->c, k->set, field_of(r, r->name, b, "force"), "N",
                                      BODY_AXES, CPL_PUT | CPL_OPTIONAL, 0, k->force + b));
        partner_check(k->c, cpl_field(k->c, k->set, field_of(r, r->name, b, "motion"), "m", PLACE,
                                      CPL_PUT | CPL_OPTIONAL, 0, k->motion + b));
        k->moved[b] = -1;
        if (s->walls->bodies[b].bend)
            create_bend(s, k, b);
        else if (s->walls->bodies[b].course)
            partner_check(k->c, cpl_field(k->c, k->set, field_of(r, "", b, "motion"), "m", PLACE,
                                          CPL_GET, CPL_NEAREST, k->moved + b));
    }
    partner_check(k->c, cpl_move(k->c, k->set, mine, origin, &id, &one));
}

/* Nominal steps, so that one of them fits although flow and bodies shorten it a little. */
static const double of_step = 0.9;

double body_coupling_window(const struct sph *s)
{
    return any_partnered(s->run) ? of_step * sph_params_dt(&s->prm, s->nu, s->c0, NULL) : INFINITY;
}

/* A body begins where the case has it: what a partner says of another place would be a jump. */
static void judge_start(const struct sph *s, int b, const double *at)
{
    const struct body *body = s->walls->bodies + b;
    double far = 0.0;
    if (!body->bend)
        far = vec3_length(at) + body->reach * vec3_length(at + 3);
    for (int i = 0; body->bend && i < body->bend->n; i++)
        far = fmax(far, hypot(at[2 * i], at[2 * i + 1]));
    if (far > 0.1 * s->dx)
        fail_with(RUN_INPUT,
                  "bodies.[%d].motion: its partner begins %.3g m from where the case has body "
                  "`%s' (a tenth of sph.dx, %.3g m, is allowed): displacements count from there",
                  b, far, s->run->scene.bodies[b].name, 0.1 * s->dx);
}

/* What a partner says of time t: the degrees of freedom, then their rates, at[2 n]. */
static void hear(const struct sph *s, int b, double t, double *at)
{
    const struct body_coupling *k = s->body_coupling;
    const struct body_bend *bend = s->walls->bodies[b].bend;
    const int n = s->walls->bodies[b].course->n, points = bend ? bend->n : 1;
    double *const v = NEW(double, 2 * n);
    unsigned char *const there = NEW(unsigned char, points);
    int all = 1;
    partner_check(k->c, cpl_get_at(k->c, k->moved[b], CPL_START, t, s->run->rank ? 0 : points, v,
                                   s->run->rank ? NULL : there));
    for (int i = 0; s->run->rank == 0 && i < points; i++)
        all = all && there[i];
    MPI_Bcast(&all, 1, MPI_INT, 0, s->run->comm);
    MPI_Bcast(v, 2 * n, MPI_DOUBLE, 0, s->run->comm);
    if (!all)
        fail_with(RUN_INPUT, "%s: its partner's %s",
                  field_of(s->run, "", b, bend ? "outline" : "motion"),
                  bend ? "points must be those of the outline in the case"
                       : "point must lie at the origin");
    for (int i = 0; i < n; i++) {
        at[i] = bend ? v[BENT * (i / 2) + i % 2] : v[i];
        at[n + i] = bend ? v[BENT * (i / 2) + 2 + i % 2] : v[n + i];
    }
    FREE(v, there);
}

/* At the very start where it begins, too; then its end is what the partner says. */
static void take_motion(struct sph *s, int b, double t0, double t1)
{
    struct body_course *c = s->walls->bodies[b].course;
    double *const at = NEW(double, 2 * c->n);
    if (s->run->step == 0 && !s->run->restart) { /* later it is where it has come to */
        hear(s, b, t0, at);
        judge_start(s, b, at);
        for (int a = 0; a < c->n; a++)
            c->c[a][1] = at[c->n + a];
    }
    hear(s, b, t1, at);
    body_course_set(c, t0, t1, at);
    mem_free(at);
}

void body_coupling_begin(struct sph *s, double t0, double t1)
{
    struct body_coupling *k = s->body_coupling;
    if (!k)
        return;
    k->t0 = t0;
    memcpy(k->before, s->walls->forces.impulse, sizeof k->before);
    for (int b = 0; b < s->walls->nbodies; b++) {
        const struct body_bend *bend = s->walls->bodies[b].bend;
        if (k->moved[b] >= 0)
            take_motion(s, b, t0, t1);
        if (bend)
            body_bend_clear(bend, BEND_WINDOW);
    }
}

/* Loads on the points of an outline, the mean over the coupling step. */
static void put_loads(struct body_coupling *k, int b, const struct body_bend *bend, int rank,
                      double t1)
{
    double(*const mean)[2] = bend->load[BEND_WINDOW];
    for (int i = 0; i < bend->n; i++)
        for (int a = 0; a < 2; a++)
            mean[i][a] /= t1 - k->t0;
    partner_check(k->c, cpl_put(k->c, k->load[b], t1, rank ? 0 : bend->n, *mean, NULL));
}

/* The force is the mean over the coupling step, by the impulse that was summed in it. */
void body_coupling_end(struct sph *s, double t1)
{
    struct body_coupling *k = s->body_coupling;
    const int mine = s->run->rank == 0;
    for (int b = 0; k && b < s->walls->nbodies; b++) {
        const struct force *now = s->walls->forces.impulse + b, *old = k->before + b;
        const struct body_motion *m = &s->walls->bodies[b].now;
        double force[BODY_AXES], place[PLACE];
        for (int a = 0; a < 3; a++) {
            force[a] = (now->F[a] - old->F[a]) / (t1 - k->t0);
            force[3 + a] = (now->M[a] - old->M[a]) / (t1 - k->t0);
        }
        memcpy(place, m->x, sizeof m->x);
        memcpy(place + 3, m->r, sizeof m->r);
        memcpy(place + 6, m->u, sizeof m->u);
        memcpy(place + 9, m->omega, sizeof m->omega);
        partner_check(k->c, cpl_put(k->c, k->force[b], t1, mine, force, NULL));
        partner_check(k->c, cpl_put(k->c, k->motion[b], t1, mine, place, NULL));
        if (s->walls->bodies[b].bend)
            put_loads(k, b, s->walls->bodies[b].bend, s->run->rank, t1);
    }
}
