/* properties_scene.c - from a seed a random scene, its twins and what must hold between them.
 * usage: properties_scene SEED DIR: writes DIR/base.cfg, twins DIR/LAW.cfg, and DIR/plan with
 *     run NAME PROGRAM RANKS             what to run
 *     twin LAW axes signs L U rho shift  columns of the twin against those of the base
 *     know KEY VALUE                     what the laws of the base alone need to know
 * SPDX-License-Identifier: BSD-3-Clause */
#include "properties_families.h"

#include <stdlib.h>
#include <string.h>

static const double BUDGET = 0.35; /* s of processor time of one run, roughly */

double make_spacing(struct random *r) { return ldexp((double)whole(r, 16, 31), whole(r, -11, -2)); }

void make_box(struct scene *s, struct random *r, const int *n, const double *h)
{
    const int away = chance(r, 0.5) ? 0 : 40;
    for (int a = 0; a < s->dim; a++) {
        const int first = whole(r, -away, away);
        s->lo[a] = first * h[a];
        s->hi[a] = (first + n[a]) * h[a];
    }
}

void make_fluid(struct scene *s, struct random *r)
{
    s->rho = chance(r, 0.3) ? 1000.0 : decades(r, 0.01, 5000.0);
    s->nu = chance(r, 0.25) ? 0.0 : s->speed * s->length / decades(r, 0.1, 1e6);
}

void make_sides(struct scene *s, struct random *r, const char *kind)
{
    for (int k = 0; k < 2 * s->dim; k++)
        if (!s->periodic[k / 2])
            s->sides[k].kind = kind ? kind : one_of(r, "slip", "no_slip");
}

void make_channel(struct scene *s, struct random *r, double length)
{
    s->periodic[0] = true;
    s->length = s->L = length;
    s->speed = s->U = decades(r, 0.02, 30.0);
    s->say_U = true;
    s->rho = decades(r, 0.01, 5000.0);
    s->nu = s->speed * s->length / decades(r, 0.1, 1e4);
    make_sides(s, r, "no_slip");
    s->closed = true;
    if (chance(r, 0.5)) {
        s->field = "poiseuille";
        s->g[0] = 8.0 * s->nu * s->U / (s->L * s->L);
    } else {
        s->field = "couette";
        s->sides[3].velocity[0] = s->U;
    }
    s->shifts = true;
}

void make_wave(struct scene *s, struct random *r, double depth, double L)
{
    s->hi[0] -= s->lo[0];
    s->lo[0] = 0.0;
    s->periodic[0] = true;
    s->length = depth;
    s->speed = sqrt(9.81 * s->length);
    make_fluid(s, r);
    s->g[1] = -9.81;
    s->field = "standing_wave";
    s->amplitude = s->length * uniform(r, 0.01, 0.15);
    s->L = L;
    s->U = 6.283 * s->amplitude * sqrt(9.81 / s->L);
    s->level = s->lo[1] + s->length;
    s->sides[2].kind = one_of(r, "slip", "no_slip");
    s->closed = true;
}

void make_reverse(struct outline *o)
{
    for (int k = 0; k < o->n / 2; k++) {
        double x[3];
        memcpy(x, o->x[k], sizeof x);
        memcpy(o->x[k], o->x[o->n - 1 - k], sizeof x);
        memcpy(o->x[o->n - 1 - k], x, sizeof x);
    }
}

void make_gravity(struct scene *s, struct random *r, double g, int axis)
{
    double d[3] = {0.0, 0.0, 0.0}, sum = 0.0;
    if (chance(r, 0.7))
        d[axis] = -1.0;
    else
        for (int a = 0; a < s->dim; a++)
            d[a] = uniform(r, -1.0, 1.0);
    for (int a = 0; a < 3; a++)
        sum += d[a] * d[a];
    for (int a = 0; a < 3; a++)
        s->g[a] = s->periodic[a] || d[a] == 0.0 ? 0.0 : g * d[a] / sqrt(sum);
}

void make_obstacle(struct outline *o, struct random *r, const double *centre, double radius)
{
    const int kind = whole(r, 0, 2); /* regular, star, rugged */
    const double start = uniform(r, 0.0, 6.28318);
    o->n = kind == 1 ? 2 * whole(r, 3, 6) : whole(r, 3, chance(r, 0.3) ? 60 : 8);
    for (int k = 0; k < o->n; k++) {
        const double angle = start - 6.283185307179586 * k / o->n; /* clockwise */
        const double far = kind == 0 ? 1.0 : kind == 1 ? (k % 2 ? 0.6 : 1.0) : uniform(r, 0.7, 1.0);
        o->x[k][0] = centre[0] + radius * far * cos(angle);
        o->x[k][1] = centre[1] + radius * far * sin(angle);
    }
    for (int k = 0; k < o->n / 2 && chance(r, 0.3) && k == 0; k++)
        make_reverse(o);
}

void make_end(struct scene *s, struct random *r, double dt, double seconds)
{
    const double most = BUDGET / seconds;
    s->end = dt * fmax(8.0, fmin(decades(r, 20.0, 1000.0), most));
}

double make_waves(struct scene *s, struct random *r, int n, double h)
{
    s->field = s->dim > 2 && chance(r, 0.6)
                   ? "beltrami"
                   : one_of(r, "taylor_green", "two_modes", "uniform", "rest");
    s->L = n * h;
    s->U = s->speed;
    s->say_U = true;
    s->length = s->L;
    s->closed = s->unforced = s->free_of_walls = true;
    if (strcmp(s->field, "rest") && chance(r, 0.5))
        for (int a = 0; a < s->dim; a++)
            s->V[a] = s->speed * uniform(r, -2.0, 2.0);
    s->still = !strcmp(s->field, "rest");
    s->carried = true;
    s->shifts = s->still || !strcmp(s->field, "uniform");
    s->shifts_by_L = true;
    s->mirrors = s->shifts || !strcmp(s->field, "taylor_green");
    s->turns = s->mirrors && s->dim == 2;
    s->turns_half = !strcmp(s->field, "two_modes");
    s->cycles = s->dim == 3 && (s->shifts || !strcmp(s->field, "beltrami"));
    return !strcmp(s->field, "two_modes") ? n / 2.236 : n;
}

bool make_lasting(const struct scene *s)
{
    const double k = 6.283 / s->L; /* the shortest waves of two_modes: 5 k^2 */
    return !strcmp(s->field, "uniform") ||
           (s->nu * 5.0 * k * k * s->end < 1.0 && s->end * s->speed < s->L);
}

/* --- twins --- */

struct twins {
    const char *dir;
    FILE *plan;
    const struct scene *base;
    struct random r;
};

static void write_case(const struct twins *t, const char *name, const struct scene *s)
{
    char path[1024];
    static const char *const programs[] = {"sph", "fv", "coupled"};
    snprintf(path, sizeof path, "%s/%s.cfg", t->dir, name);
    FILE *f = fopen(path, "w");
    if (!f) {
        perror(path);
        exit(2);
    }
    fprintf(f, "# %s\n", s->family);
    scene_write(s, name, f);
    fclose(f);
    scene_write_meshes(s, t->dir, name);
    fprintf(t->plan, "run %s %s %d\n", name, programs[s->program], s->ranks);
}

static void plan_twin(const struct twins *t, const char *law, const struct motion *m, double l,
                      double u, double d)
{
    fprintf(t->plan, "twin %s", law);
    for (int a = 0; a < 3; a++)
        fprintf(t->plan, " %d", m->axis[a]);
    for (int a = 0; a < 3; a++)
        fprintf(t->plan, " %g", m->sign[a]);
    fprintf(t->plan, " %.17g %.17g %.17g", l, u, d);
    for (int a = 0; a < 3; a++)
        fprintf(t->plan, " %.17g", m->t[a]);
    fprintf(t->plan, "\n");
}

static const struct motion stay = {{0, 1, 2}, {1, 1, 1}, {0, 0, 0}};

static void move(struct twins *t, const char *law, const struct motion *m)
{
    struct scene s = *t->base;
    scene_move(&s, m);
    write_case(t, law, &s);
    plan_twin(t, law, m, 1.0, 1.0, 1.0);
}

static void units(struct twins *t)
{
    struct scene s = *t->base;
    double l, u;
    do { /* a gravity that the table allows */
        l = ldexp(1.0, whole(&t->r, -10, 10));
        u = ldexp(1.0, whole(&t->r, -10, 10));
    } while (u * u / l > 1e3 || u * l * fmax(1.0, s.nu) > 1e4);
    double d = ldexp(1.0, whole(&t->r, -10, 10));
    while (s.rho * d < 2e-3)
        d *= 2.0;
    while (s.rho * d > 5e4)
        d *= 0.5;
    scene_scale(&s, l, u, d);
    write_case(t, "units", &s);
    plan_twin(t, "units", &stay, l, u, d);
}

static void ranks(struct twins *t)
{
    struct scene s = *t->base;
    s.ranks = s.ranks == 1 ? whole(&t->r, 2, 4) : 1;
    write_case(t, "ranks", &s);
    plan_twin(t, "ranks", &stay, 1.0, 1.0, 1.0);
}

static void mirror(struct twins *t)
{
    struct motion m = stay;
    m.sign[0] = -1.0;
    move(t, "mirror", &m);
}

static void turn(struct twins *t)
{
    struct motion m = {{1, 0, 2}, {1, -1, 1}, {0, 0, 0}}; /* x to y, y to -x */
    if (t->base->cycles) {
        const struct motion c = {{1, 2, 0}, {1, 1, 1}, {0, 0, 0}};
        m = c;
    } else if (t->base->turns_half) {
        const struct motion c = {{0, 1, 2}, {-1, -1, 1}, {0, 0, 0}};
        m = c;
    } else if (!strcmp(t->base->field, "taylor_green"))
        m.t[0] = 0.5 * t->base->L; /* whose quarter turn is its opposite */
    move(t, "turn", &m);
}

static void shift(struct twins *t)
{
    struct motion m = stay;
    const struct scene *s = t->base;
    for (int a = 0; a < s->dim; a++) {
        const double h = s->shifts ? s->dx : s->L;
        m.t[a] = whole(&t->r, -20, 20) * h;
    }
    move(t, "shift", &m);
}

/* Kinetic energies differ by that of the whole, which the laws take off. */
static void galilean(struct twins *t)
{
    struct scene s = *t->base;
    for (int a = 0; a < s.dim; a++)
        s.V[a] += s.speed * uniform(&t->r, -1.0, 1.0);
    if (!strcmp(s.field, "rest"))
        s.field = "uniform";
    s.say_U = true;
    write_case(t, "carried", &s);
    plan_twin(t, "carried", &stay, 1.0, 1.0, 1.0);
    for (int a = 0; a < s.dim; a++)
        fprintf(t->plan, "know d%c %.17g\nknow V%c %.17g\n", "xyz"[a], s.V[a] - t->base->V[a],
                "xyz"[a], t -> base -> V[a]);
}

/* Two of the twins that the scene has. */
static void make_twins(struct twins *t)
{
    const struct scene *s = t->base;
    const bool has[] = {true,
                        s->program != COUPLED,
                        s->mirrors,
                        s->turns || s->cycles || s->turns_half,
                        s->shifts || s->shifts_by_L,
                        s->carried};
    void (*const make[])(struct twins *) = {units, ranks, mirror, turn, shift, galilean};
    bool done[6] = {false};
    for (int n = 0; n < 2;) {
        const int k = whole(&t->r, 0, 5);
        if (done[k] || !has[k]) {
            bool left = false;
            for (int i = 0; i < 6; i++)
                left = left || (has[i] && !done[i]);
            if (!left)
                return;
            continue;
        }
        done[k] = true;
        make[k](t);
        n++;
    }
}

static void know(const struct twins *t)
{
    const struct scene *s = t->base;
    fprintf(t->plan, "know family %s\n", s->family);
    fprintf(t->plan, "know speed %.17g\nknow length %.17g\nknow rho %.17g\nknow dim %d\n", s->speed,
            s->length, s->rho, s->dim);
    fprintf(t->plan, "know program %d\nknow blocks %d\nknow mass %.17g\nknow error %g\n",
            s->program, s->nblocks, s->mass, s->error);
    const struct {
        const char *name;
        bool is;
    } facts[] = {{"standard", s->standard},
                 {"closed", s->closed},
                 {"open_above", s->open_above},
                 {"unforced", s->unforced},
                 {"free_of_walls", s->free_of_walls},
                 {"still", s->still},
                 {"refined", s->nregions > 0 || s->criterion}};
    for (int k = 0; k < 7; k++)
        fprintf(t->plan, "know %s %d\n", facts[k].name, facts[k].is);
    fprintf(t->plan, "know stream %.17g\n", s->stream ? fmax(fabs(s->V[0]), fabs(s->V[1])) : 0.0);
    fprintf(t->plan, "know gravity %.17g\n",
            sqrt(s->g[0] * s->g[0] + s->g[1] * s->g[1] + s->g[2] * s->g[2]));
}

static const struct family *draw(struct random *r)
{
    const struct family *lists[] = {sph_families, fv_families};
    double sum = 0.0;
    for (int k = 0; k < 2; k++)
        for (const struct family *f = lists[k]; f->name; f++)
            sum += f->weight;
    double at = uniform(r, 0.0, sum);
    for (int k = 0; k < 2; k++)
        for (const struct family *f = lists[k]; f->name; f++)
            if ((at -= f->weight) < 0.0)
                return f;
    return sph_families;
}

int main(int argc, char **argv)
{
    char path[1024];
    if (argc != 3) {
        fprintf(stderr, "usage: properties_scene SEED DIR\n");
        return 2;
    }
    struct random r = {strtoull(argv[1], NULL, 10) * 0x2545f4914f6cdd1du};
    const struct family *family = draw(&r);
    static struct scene s;
    s.level = -1e30;
    s.U = s.L = 1.0;
    s.field = "rest";
    s.sph_more = s.fv_more = "";
    s.family = family->name;
    s.standard = true;
    s.ranks = whole(&r, 1, 4);
    if (chance(&r, 0.6))
        s.ranks = 1;
    family->make(&s, &r);
    if (!s.say_U && (!strcmp(s.field, "rest") || !strcmp(s.field, "uniform")))
        s.U = 1.0; /* the default */
    snprintf(path, sizeof path, "%s/plan", argv[2]);
    struct twins t = {argv[2], fopen(path, "w"), &s, r};
    if (!t.plan) {
        perror(path);
        return 2;
    }
    write_case(&t, "base", &s);
    know(&t);
    make_twins(&t);
    fclose(t.plan);
    return 0;
}
