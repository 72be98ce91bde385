/* wave_maker.c - see wave_maker.h. SPDX-License-Identifier: BSD-3-Clause */
#include "wave_maker.h"

#include "scene_fluid.h"
#include "scene_mesh.h"
#include "scene_waves.h"

enum { COLUMNS_2D = 4, COLUMNS_3D = 7 };

/* Before wave_makers_resolve: after it their motions are files. */
bool scene_has_wave_maker(const struct scene *s)
{
    for (int k = 0; k < s->nbodies; k++)
        for (int i = 0; i < s->bodies[k].motion.n; i++)
            if (s->bodies[k].motion.of[i].kind == MOTION_WAVES)
                return true;
    return false;
}

/* Height over stroke at the still level (Biesel 1951), l the height of a flap's axis over the
 * floor, < 0: a piston. kh is bounded, for sinh overflows where the floor no longer counts; the
 * axis of a flap stays as far below the surface as it is. */
double wave_maker_ratio(double k, double h, double l)
{
    const double kh = fmin(k * h, 300.0), below = sinh(2.0 * kh) + 2.0 * kh;
    if (l < 0.0)
        return 4.0 * sinh(kh) * sinh(kh) / below;
    const double down = k * (h - l);
    return 4.0 * sinh(kh) * (sinh(kh) + (cosh(fmax(kh - down, 0.0)) - cosh(kh)) / down) / below;
}

/* Second order of a piston over its first; 0 where it does not hold. */
static double second_order(double a, double k, double h)
{
    const double kh = k * h, n = 0.5 * (1.0 + 2.0 * kh / sinh(2.0 * kh)), sh = sinh(kh),
                 length = 2.0 * M_PI / k;
    if (kh > 1.5 || 2.0 * a * length * length / (h * h * h) > 8.0 * M_PI * M_PI / 3.0)
        return 0.0;
    return a / (2.0 * h * n) * (3.0 / (4.0 * sh * sh) - 0.5 * n);
}

static bool is_flap(const struct scene_motion *m) { return m->axis >= AXIS_RX; }

/* m: of a flap's axis over the floor; a piston < 0. */
static double axis_height(const struct scene *s, const struct scene_body *b,
                          const struct scene_motion *m)
{
    const double depth = scene_waves_depth(s);
    return is_flap(m) ? scene_height(s, b->centre) - (scene_waves_level(s) - depth) : -1.0;
}

/* m: along the waves, from where to where a body reaches. */
static void reach_of(const struct scene *s, const struct scene_body *b, double reach[2])
{
    double d[3], first = INFINITY, last = -INFINITY;
    scene_waves_direction(s, d, NULL);
    for (int i = 0; i < b->points.n; i++) {
        const double x = d[0] * b->points.x[i][0] + d[1] * b->points.x[i][1];
        first = fmin(first, x);
        last = fmax(last, x);
    }
    for (int i = 0; b->mesh && i < b->mesh->mesh.nvertices; i++) {
        first = fmin(first, vec3_dot(b->mesh->mesh.x[i], d));
        last = fmax(last, vec3_dot(b->mesh->mesh.x[i], d));
    }
    const bool known = first <= last;
    reach[0] = known ? first : vec3_dot(b->centre, d);
    reach[1] = known ? last : vec3_dot(b->centre, d);
}

/* A point in the middle of what is in the way of the waves. */
static void middle_of(const struct scene_body *b, double middle[3])
{
    double lo[3], hi[3];
    scene_body_box(b, lo, hi);
    for (int a = 0; a < 3; a++)
        middle[a] = 0.5 * (lo[a] + hi[a]);
}

/* Whether water stands, at the start, up to a fifth of the depth from x along d. */
static bool is_wet_along(const struct scene *s, const double *x, const double *d)
{
    static const double far[] = {0.01, 0.05, 0.2}; /* of the depth: shapes may begin beside it */
    const struct exact e = exact_create(s);
    bool wet = false;
    for (int k = 0; k < 3; k++) {
        double at[3] = {x[0], x[1], x[2]};
        bool inside = true;
        vec3_add(at, far[k] * scene_waves_depth(s), d);
        for (int a = 0; a < s->domain.dim; a++)
            inside = inside && at[a] > s->domain.min[a] && at[a] < s->domain.max[a];
        wet = wet || (inside && scene_is_fluid(s, &e, at, NULL));
    }
    return wet;
}

/* 1: the water lies before the body, which reaches so far along the waves, -1: behind it; of both
 * the longer way to the domain's end. */
static double water_side(const struct scene *s, const struct scene_body *b, const double reach[2])
{
    const int up = scene_still_axis(s);
    double d[3], back[3], last[3], first[3], room[2] = {0.0, 0.0};
    scene_waves_direction(s, d, NULL);
    middle_of(b, last);
    last[up] = (s->fluid.gravity[up] < 0.0 ? 1.0 : -1.0) *
               (scene_waves_level(s) - 0.1 * scene_waves_depth(s));
    memcpy(first, last, sizeof first);
    for (int a = 0; a < 3; a++) {
        back[a] = -d[a];
        room[0] += fmin(d[a] * s->domain.min[a], d[a] * s->domain.max[a]);
        room[1] += fmax(d[a] * s->domain.min[a], d[a] * s->domain.max[a]);
    }
    vec3_add(first, reach[0] - vec3_dot(first, d), d);
    vec3_add(last, reach[1] - vec3_dot(last, d), d);
    const bool before = is_wet_along(s, last, d), behind = is_wet_along(s, first, back);
    if (before != behind)
        return before ? 1.0 : -1.0;
    return room[1] - reach[1] >= reach[0] - room[0] ? 1.0 : -1.0;
}

/* What moves, over the displacement along the waves at the still level: +-1, or 1 over the height
 * over a flap's axis, in the sense of its axis. 0: the axis makes no waves. */
static double lever(const struct scene *s, const struct scene_body *b, const struct scene_motion *m)
{
    const int up = scene_still_axis(s);
    double d[3], e[3] = {0.0, 0.0, 0.0}, r[3] = {0.0, 0.0, 0.0}, moves[3];
    if (up < 0)
        return 0.0;
    scene_waves_direction(s, d, NULL);
    if (!is_flap(m))
        return fabs(d[m->axis]) > 1.0 - 1e-9 ? d[m->axis] : 0.0;
    e[m->axis - AXIS_RX] = 1.0;
    r[up] =
        (s->fluid.gravity[up] < 0.0 ? 1.0 : -1.0) * (scene_waves_depth(s) - axis_height(s, b, m));
    vec3_cross(e, r, moves);
    const double along = vec3_dot(moves, d);
    return fabs(along) > (1.0 - 1e-9) * fabs(r[up]) && r[up] != 0.0 ? 1.0 / along : 0.0;
}

void wave_paddle_of(const struct scene *s, const struct scene_body *b, const struct scene_motion *m,
                    struct wave_paddle *p)
{
    double reach[2];
    reach_of(s, b, reach);
    *p = (struct wave_paddle){
        .per = lever(s, b, m), .hinge = axis_height(s, b, m), .side = water_side(s, b, reach)};
    p->face = reach[p->side > 0.0];
    middle_of(b, p->middle);
}

void wave_makers_check(const struct scene *s, const struct params *p, struct faults *f)
{
    for (int k = 0; k < s->nbodies; k++)
        for (int i = 0; i < s->bodies[k].motion.n; i++) {
            const struct scene_body *b = s->bodies + k;
            const struct scene_motion *m = b->motion.of + i;
            const char *key = key_text("bodies.[%d].motion.[%d].kind", k, i);
            if (m->kind != MOTION_WAVES)
                continue;
            if (!s->has_waves)
                params_fault(p, f, key, "what waves? give the group waves");
            else if (!(scene_waves_depth(s) > 0.0))
                params_fault(p, f, key, "no shape tells how deep the water is (waves.depth)");
            else if (lever(s, b, m) == 0.0)
                params_fault(p, f, key,
                             "its axis makes no waves in waves.direction: a piston moves along "
                             "it, a flap turns about a horizontal axis across it, below the water");
        }
}

double wave_maker_grown(const struct waves *w, double t)
{
    const double T = w->of.start * w->period;
    return !(T > 0.0) || t >= T ? 1.0 : t <= 0.0 ? 0.0 : 0.5 * (1.0 - cos(M_PI * t / T));
}

/* Displacement along the waves at the still level and time t; face: m along them. It makes the
 * waves if the water lies before it, and takes up those that come if it lies behind: mirrored and
 * with time reversed the one is the other, at both orders. */
static double displacement(const struct waves *w, double face, double l, double t)
{
    const double h = w->of.depth;
    double x = 0.0;
    if (w->of.kind == WAVE_REGULAR) {
        const double k = 2.0 * M_PI / w->length, a = 0.5 * w->of.height,
                     turn = 2.0 * M_PI * (t - w->of.at[1]) / w->period - k * (face - w->of.at[0]),
                     second = l < 0.0 ? second_order(a, k, h) : 0.0;
        x = a / wave_maker_ratio(k, h, l) * (sin(turn) + second * sin(2.0 * turn));
    }
    for (int i = 0; i < w->ncomponents; i++) {
        const struct wave_component *c = w->components + i;
        x += c->a / wave_maker_ratio(c->k, h, l) * sin(c->w * t - c->k * face - c->phase);
    }
    return wave_maker_grown(w, t) * x;
}

/* Motions of paddles become rows of a file, 40 a period of the shortest wave, so that the programs
 * know one kind of motion less. */
static void resolve_one(struct scene *s, struct scene_body *b, struct scene_motion *m,
                        const struct waves *w, struct motion_files *files)
{
    const int columns = s->domain.dim == 2 ? COLUMNS_2D : COLUMNS_3D,
              column = columns == COLUMNS_2D ? (is_flap(m) ? 3 : 1 + m->axis) : 1 + m->axis;
    const double shortest = w->ncomponents > 0 ? 2.0 * M_PI / w->components[w->ncomponents - 1].w
                                               : 0.5 * w->period,
                 dt = shortest / 40.0;
    struct wave_paddle p;
    wave_paddle_of(s, b, m, &p);
    const int n = (int)ceil(s->time.end / dt) + 3;
    double *rows = NEW(double, (size_t)n *columns);
    for (int k = 0; k < n; k++) {
        rows[(size_t)k * columns] = k * dt;
        rows[(size_t)k * columns + column] = p.per * (displacement(w, p.face, p.hinge, k * dt) -
                                                      displacement(w, p.face, p.hinge, 0.0));
    }
    snprintf(m->file, sizeof m->file, "(waves of %.80s)", b->name);
    motion_files_add(files, m->file, n, columns, rows);
    m->kind = MOTION_FILE;
    m->made = true;
}

void wave_makers_resolve(struct scene *s, struct motion_files *files)
{
    if (!s->has_waves || !scene_has_wave_maker(s))
        return;
    const struct wave_spec of = scene_waves_spec(s);
    struct waves *w = waves_create(&of);
    for (int k = 0; k < s->nbodies; k++)
        for (int i = 0; i < s->bodies[k].motion.n; i++)
            if (s->bodies[k].motion.of[i].kind == MOTION_WAVES)
                resolve_one(s, s->bodies + k, s->bodies[k].motion.of + i, w, files);
    FREE(w);
}

void wave_makers_describe(const struct scene *s)
{
    for (int k = 0; k < s->nbodies; k++)
        for (int i = 0; i < s->bodies[k].motion.n; i++) {
            const struct scene_body *b = s->bodies + k;
            const struct scene_motion *m = b->motion.of + i;
            if (!m->made)
                continue;
            const struct wave_spec of = scene_waves_spec(s);
            struct waves *w = waves_create(&of);
            const double number = 2.0 * M_PI / w->length, l = axis_height(s, b, m),
                         ratio = wave_maker_ratio(number, of.depth, l);
            log_say("%s makes them as a %s: height over stroke %.3g, stroke at the still level "
                    "%.4g m%s",
                    b->name, is_flap(m) ? "flap" : "piston", ratio, of.height / ratio,
                    of.kind != WAVE_REGULAR ? " of the peak, first order"
                    : l < 0.0 && second_order(0.5 * of.height, number, of.depth) != 0.0
                        ? ", second order"
                        : ", first order");
            FREE(w);
        }
}
