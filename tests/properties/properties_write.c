/* properties_write.c - scenes moved, scaled and written as case files; see properties.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "properties.h"

#include <math.h>
#include <string.h>

static const char *const side_names[] = {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};

/* --- moved --- */

static double sign_of(const struct motion *m) /* of a rotation: det M */
{
    const int *p = m->axis;
    const bool even =
        (p[0] == 0 && p[1] == 1) || (p[0] == 1 && p[1] == 2) || (p[0] == 2 && p[1] == 0);
    return (even ? 1.0 : -1.0) * m->sign[0] * m->sign[1] * m->sign[2];
}

static void turn(const struct motion *m, double *v)
{
    const double old[3] = {v[0], v[1], v[2]};
    for (int a = 0; a < 3; a++)
        v[m->axis[a]] = m->sign[a] * old[a] + 0.0; /* no -0 */
}

static void place(const struct motion *m, double *x)
{
    turn(m, x);
    for (int a = 0; a < 3; a++)
        x[a] += m->t[a];
}

static void box(const struct motion *m, double *lo, double *hi)
{
    place(m, lo);
    place(m, hi);
    for (int a = 0; a < 3; a++) {
        const double least = fmin(lo[a], hi[a]), most = fmax(lo[a], hi[a]);
        lo[a] = least;
        hi[a] = most;
    }
}

/* An outline keeps its inside: a mirror turns its order round. */
static void outline(const struct motion *m, struct outline *o)
{
    for (int k = 0; k < o->n; k++)
        place(m, o->x[k]);
    if (sign_of(m) < 0.0)
        make_reverse(o);
}

/* A mirror turns triangles round. */
static void mesh(const struct motion *m, struct body *b)
{
    for (int k = 0; k < b->line.n; k++)
        place(m, b->line.x[k]);
    for (int k = 0; sign_of(m) < 0.0 && k < b->ntriangles; k++) {
        const int second = b->triangle[k][1];
        b->triangle[k][1] = b->triangle[k][2];
        b->triangle[k][2] = second;
    }
}

static void sides(const struct motion *m, struct scene *s)
{
    struct side old[6];
    memcpy(old, s->sides, sizeof old);
    for (int k = 0; k < 6; k++) {
        const int a = k / 2, end = m->sign[a] > 0.0 ? k % 2 : 1 - k % 2;
        s->sides[2 * m->axis[a] + end] = old[k];
    }
    for (int k = 0; k < 6; k++)
        turn(m, s->sides[k].velocity);
}

static void counts(const struct motion *m, int *n)
{
    const int old[3] = {n[0], n[1], n[2]};
    for (int a = 0; a < 3; a++)
        n[m->axis[a]] = old[a];
}

void scene_move(struct scene *s, const struct motion *m)
{
    const bool periodic[3] = {s->periodic[0], s->periodic[1], s->periodic[2]};
    for (int a = 0; a < 3; a++)
        s->periodic[m->axis[a]] = periodic[a];
    box(m, s->lo, s->hi);
    box(m, s->box[0], s->box[1]);
    box(m, s->hole[0], s->hole[1]);
    sides(m, s);
    counts(m, s->cells);
    turn(m, s->g);
    turn(m, s->V);
    const double g = sqrt(s->g[0] * s->g[0] + s->g[1] * s->g[1] + s->g[2] * s->g[2]);
    double up = 0.0; /* by which levels rise */
    for (int a = 0; a < 3 && g > 0.0; a++)
        up -= m->t[a] * s->g[a] / g;
    s->level += s->level > -1e29 ? up : 0.0;
    s->graded[0] += s->graded[1] > 0.0 ? m->t[1] : 0.0;
    for (int k = 0; k < s->nwalls; k++)
        outline(m, &s->walls[k].line);
    for (int k = 0; k < s->nbodies; k++) {
        struct body *b = s->bodies + k;
        if (b->ntriangles > 0)
            mesh(m, b);
        else
            outline(m, &b->line);
        place(m, b->centre);
        turn(m, b->velocity);
        turn(m, b->turning);
        for (int a = 0; a < 3; a++)
            b->turning[a] = b->turning[a] * sign_of(m) + 0.0;
        b->spin *= sign_of(m);
    }
    for (int k = 0; k < s->nshapes; k++) {
        struct shape *h = s->shapes + k;
        if (!strcmp(h->form, "box"))
            box(m, h->line.x[0], h->line.x[1]);
        else
            outline(m, &h->line);
        turn(m, h->velocity);
        h->level += up;
    }
    for (int k = 0; k < s->nprobes; k++)
        place(m, s->probes[k].at);
    for (int k = 0; k < s->nregions; k++) {
        turn(m, s->regions[k].velocity);
        if (s->regions[k].radius > 0.0)
            place(m, s->regions[k].lo);
        else
            box(m, s->regions[k].lo, s->regions[k].hi);
    }
    for (int k = 0; k < s->nblocks; k++) /* blocks are shifted only */
        for (int a = 0; a < 3; a++) {
            struct block *b = s->blocks + k;
            b->lo[a] += m->t[a];
            b->hi[a] += m->t[a];
            b->centre[a] += m->t[a];
            b->focus[a] += m->t[a];
        }
}

/* --- in other units --- */

static void times(double *v, int n, double factor)
{
    for (int a = 0; a < n; a++)
        v[a] *= factor;
}

static void scale_lists(struct scene *s, double l, double u, double d)
{
    for (int k = 0; k < s->nwalls; k++)
        times(s->walls[k].line.x[0], 3 * s->walls[k].line.n, l);
    for (int k = 0; k < s->nbodies; k++) {
        struct body *b = s->bodies + k;
        times(b->line.x[0], 3 * b->line.n, l);
        times(b->centre, 3, l);
        times(b->velocity, 3, u);
        b->spin *= u / l;
        times(b->turning, 3, u / l);
        b->density *= d;
    }
    for (int k = 0; k < s->nshapes; k++) {
        struct shape *h = s->shapes + k;
        times(h->line.x[0], 3 * h->line.n, l);
        times(h->velocity, 3, u);
        h->radius *= l;
        h->level *= l;
    }
    for (int k = 0; k < s->nprobes; k++)
        times(s->probes[k].at, 3, l);
    for (int k = 0; k < s->nregions; k++) {
        times(s->regions[k].lo, 3, l);
        times(s->regions[k].hi, 3, l);
        times(s->regions[k].velocity, 3, u);
        s->regions[k].radius *= l;
        s->regions[k].offset *= l;
    }
    for (int k = 0; k < s->nblocks; k++) {
        struct block *b = s->blocks + k;
        times(b->lo, 3, l);
        times(b->hi, 3, l);
        times(b->centre, 3, l);
        times(b->focus, 3, l);
        times(b->radius, 2, l);
        times(b->velocity, 3, u);
        times(b->spin, 2, u / l);
    }
}

void scene_scale(struct scene *s, double l, double u, double d)
{
    s->end *= l / u;
    times(s->lo, 3, l);
    times(s->hi, 3, l);
    s->rho *= d;
    s->nu *= l * u;
    times(s->g, 3, u * u / l);
    s->central *= u / l;
    s->U *= u;
    s->L *= l;
    times(s->V, 3, u);
    s->amplitude *= l;
    s->level *= s->level > -1e29 ? l : 1.0;
    s->say_U = true;
    for (int k = 0; k < 6; k++) {
        times(s->sides[k].velocity, 3, u);
        s->sides[k].pressure *= d * u * u;
    }
    scale_lists(s, l, u, d);
    s->dx *= l;
    s->c0 *= u;
    times(s->box[0], 6, l);
    times(s->hole[0], 6, l);
    s->graded[0] *= l;
    s->overlap *= l;
    s->speed *= u;
    s->length *= l;
    s->mass *= d * pow(l, s->dim);
}

/* --- written --- */

static void vector(FILE *f, const char *key, const double *v, int dim)
{
    fprintf(f, " %s = (", key);
    for (int a = 0; a < dim; a++)
        fprintf(f, "%s%.17g", a ? ", " : "", v[a]);
    fprintf(f, ");");
}

static bool is_zero(const double *v) { return v[0] == 0.0 && v[1] == 0.0 && v[2] == 0.0; }

static void points(FILE *f, const char *key, const struct outline *o, int dim)
{
    fprintf(f, " %s = (", key);
    for (int k = 0; k < o->n; k++) {
        fprintf(f, "%s(", k ? ", " : "");
        for (int a = 0; a < dim; a++)
            fprintf(f, "%s%.17g", a ? ", " : "", o->x[k][a]);
        fprintf(f, ")");
    }
    fprintf(f, ");");
}

static void write_walls(const struct scene *s, FILE *f)
{
    const char *sep = "";
    bool any = s->nwalls > 0;
    for (int k = 0; k < 2 * s->dim; k++)
        any = any || s->sides[k].kind;
    if (!any)
        return;
    fprintf(f, "walls: (");
    for (int k = 0; k < 2 * s->dim; k++) {
        const struct side *w = s->sides + k;
        if (!w->kind)
            continue;
        fprintf(f, "%s\n  { side = \"%s\"; kind = \"%s\";", sep, side_names[k], w->kind);
        if (!is_zero(w->velocity))
            vector(f, "velocity", w->velocity, s->dim);
        if (w->profile)
            fprintf(f, " profile = \"%s\";", w->profile);
        if (w->pressure != 0.0)
            fprintf(f, " pressure = %.17g;", w->pressure);
        if (w->carried)
            fprintf(f, " carried = true;");
        fprintf(f, " }");
        sep = ",";
    }
    for (int k = 0; k < s->nwalls; k++) {
        fprintf(f, "%s\n  { kind = \"%s\";%s", sep, s->walls[k].kind,
                s->walls[k].closed ? " closed = true;" : "");
        points(f, "points", &s->walls[k].line, 2);
        fprintf(f, " }");
        sep = ",";
    }
    fprintf(f, " );\n");
}

static void write_bodies(const struct scene *s, const char *name, FILE *f)
{
    for (int k = 0; k < s->nbodies; k++) {
        const struct body *b = s->bodies + k;
        fprintf(f, "%s{ name = \"b%d\"; kind = \"%s\";", k ? ",\n  " : "bodies: ( ", k, b->kind);
        if (b->free)
            fprintf(f, " free = true; density = %.17g;", b->density);
        else
            vector(f, "centre", b->centre, s->dim);
        if (!is_zero(b->velocity))
            vector(f, "velocity", b->velocity, s->dim);
        if (!is_zero(b->turning))
            vector(f, "spin", b->turning, 3);
        if (b->spin != 0.0)
            fprintf(f, " spin = %.17g;", b->spin);
        if (b->ntriangles > 0)
            fprintf(f, " mesh = \"%s.b%d.%s\";%s", name, k, b->stl ? "stl" : "obj",
                    b->thin ? " thin = true;" : "");
        else
            points(f, "points", &b->line, 2);
        fprintf(f, " }");
    }
    fprintf(f, s->nbodies ? " );\n" : "");
}

static void write_shapes(const struct scene *s, FILE *f)
{
    for (int k = 0; k < s->nshapes; k++) {
        const struct shape *h = s->shapes + k;
        fprintf(f, "%s{ form = \"%s\";", k ? ",\n  " : "shapes: ( ", h->form);
        if (!strcmp(h->form, "box"))
            points(f, "box", &h->line, s->dim);
        else if (!strcmp(h->form, "polygon"))
            points(f, "points", &h->line, 2);
        else if (!strcmp(h->form, "disc")) {
            vector(f, "centre", h->line.x[0], s->dim);
            fprintf(f, " radius = %.17g;", h->radius);
        } else
            fprintf(f, " level = %.17g;", h->level);
        if (h->hole)
            fprintf(f, " hole = true;");
        if (!is_zero(h->velocity))
            vector(f, "velocity", h->velocity, s->dim);
        fprintf(f, " }");
    }
    fprintf(f, s->nshapes ? " );\n" : "");
    for (int k = 0; k < s->nprobes; k++) {
        fprintf(f, "%s{ name = \"P%d\"; kind = \"%s\";", k ? ", " : "probes: ( ", k,
                s->probes[k].kind);
        vector(f, "at", s->probes[k].at, s->dim);
        fprintf(f, " }");
    }
    fprintf(f, s->nprobes ? " );\n" : "");
}

static void write_block(const struct block *b, int dim, FILE *f)
{
    static const char *const names[] = {"i_min", "i_max", "j_min", "j_max", "k_min", "k_max"};
    const bool ring = !strcmp(b->mapping, "annulus");
    fprintf(f, " mapping = \"%s\"; cells = (%d, %d", b->mapping, b->cells[0], b->cells[1]);
    fprintf(f, dim > 2 ? ", %d);" : ");", b->cells[2]);
    if (!ring) {
        vector(f, "min", b->lo, dim);
        vector(f, "max", b->hi, dim);
    } else {
        vector(f, "radius", b->radius, 2);
        if (b->spin[0] != 0.0 || b->spin[1] != 0.0)
            vector(f, "spin", b->spin, 2);
    }
    if (ring || b->angle != 0.0)
        vector(f, "centre", b->centre, dim);
    if (b->angle != 0.0)
        fprintf(f, " angle = %.17g;", b->angle);
    if (!is_zero(b->stretch)) {
        vector(f, "stretch", b->stretch, dim);
        if (!ring && (b->stretch[0] > 0.0 || b->stretch[1] > 0.0))
            vector(f, "focus", b->focus, dim);
    }
    if (b->shear != 0.0)
        fprintf(f, " shear = %.17g;", b->shear);
    if (b->wave != 0.0)
        fprintf(f, " wave = %.17g;", b->wave);
    if (!is_zero(b->velocity))
        vector(f, "velocity", b->velocity, dim);
    if (b->lid)
        fprintf(f, " lid = \"%s\";", b->lid);
    for (int k = 0; k < 2 * dim; k++)
        if (b->sides[k])
            fprintf(f, " %s = \"%s\";", names[k], b->sides[k]);
}

static void write_region(const struct region *is, int dim, FILE *f)
{
    fprintf(f, "{ level = %d;", is->level);
    if (is->offset > 0.0) {
        fprintf(f, " shape = \"body\"; body = \"b0\"; offset = %.17g; }", is->offset);
        return;
    }
    if (is->radius > 0.0) {
        vector(f, "centre", is->lo, dim);
        fprintf(f, " shape = \"sphere\"; radius = %.17g;", is->radius);
    } else {
        vector(f, "min", is->lo, dim);
        vector(f, "max", is->hi, dim);
    }
    if (!is_zero(is->velocity))
        vector(f, "velocity", is->velocity, dim);
    fprintf(f, " }");
}

static void write_refinement(const struct scene *s, FILE *f)
{
    if (s->nregions == 0 && !s->criterion)
        return;
    fprintf(f, "apr: {%s", s->local_steps ? " local_steps = true;" : "");
    for (int k = 0; k < s->nregions; k++) {
        fprintf(f, k ? ",\n  " : " regions = ( ");
        write_region(s->regions + k, s->dim, f);
    }
    fprintf(f, s->nregions ? " );" : "");
    if (s->criterion)
        fprintf(f, " criteria = ( { level = 1; kind = \"%s\"; %s = %.17g; } );", s->criterion,
                strcmp(s->criterion, "surface") ? "above" : "distance", s->bound);
    fprintf(f, " };\n");
}

static void write_solvers(const struct scene *s, FILE *f)
{
    for (int k = 0; k < s->nblocks; k++) {
        fprintf(f, "%s{ name = \"block %d\";", k ? ",\n  " : "blocks: ( ", k + 1);
        write_block(s->blocks + k, s->dim, f);
        fprintf(f, " }");
    }
    fprintf(f, s->nblocks ? " );\n" : "");
    if (s->program != FV) {
        fprintf(f, "sph: { dx = %.17g;", s->dx);
        if (s->c0 > 0.0)
            fprintf(f, " c0 = %.17g;", s->c0);
        if (s->even)
            fprintf(f, " noise = 0.0;");
        fprintf(f, "%s", s->sph_more);
        if (s->program == COUPLED) {
            const struct outline o = {2,
                                      {{s->box[0][0], s->box[0][1], s->box[0][2]},
                                       {s->box[1][0], s->box[1][1], s->box[1][2]}}};
            points(f, "box", &o, s->dim);
        }
        fprintf(f, " };\n");
    }
    if (s->program != SPH) {
        fprintf(f, "fv: {");
        if (!s->nblocks) {
            fprintf(f, " cells = (%d, %d", s->cells[0], s->cells[1]);
            fprintf(f, s->dim > 2 ? ", %d);" : ");", s->cells[2]);
        }
        if (s->graded[1] > 0.0)
            vector(f, "graded", s->graded, 2);
        if (s->hole[1][0] > s->hole[0][0]) {
            const struct outline o = {2,
                                      {{s->hole[0][0], s->hole[0][1], s->hole[0][2]},
                                       {s->hole[1][0], s->hole[1][1], s->hole[1][2]}}};
            points(f, "hole", &o, s->dim);
        }
        fprintf(f, "%s };\n", s->fv_more);
    }
    if (s->program == COUPLED)
        fprintf(f, "coupling: { steps = %d; };\n", s->steps);
}

/* A key that a run does not use is a fault of its case. */
static bool has_scale(const struct scene *s)
{
    const bool none = !strcmp(s->field, "rest") || !strcmp(s->field, "uniform");
    return s->program == FV ? !none && strcmp(s->field, "standing_wave") : !none || s->say_U;
}

static bool has_length(const struct scene *s)
{
    return strcmp(s->field, "rest") && strcmp(s->field, "uniform") &&
           (s->program != FV || (strcmp(s->field, "poiseuille") && strcmp(s->field, "couette")));
}

void scene_write(const struct scene *s, const char *name, FILE *f)
{
    fprintf(f, "format = 1;\ntime: { end = %.17g; };\nfluid: { rho = %.17g;", s->end, s->rho);
    if (s->nu > 0.0)
        fprintf(f, " nu = %.17g;", s->nu);
    if (!is_zero(s->g))
        vector(f, "gravity", s->g, s->dim);
    if (s->central > 0.0)
        fprintf(f, " central = %.17g;", s->central);
    fprintf(f, " };\ndomain: { dim = %d;", s->dim);
    vector(f, "min", s->lo, s->dim);
    vector(f, "max", s->hi, s->dim);
    fprintf(f, " periodic = (%s, %s", s->periodic[0] ? "true" : "false",
            s->periodic[1] ? "true" : "false");
    fprintf(f, s->dim > 2 ? ", %s); };\n" : "); };\n", s->periodic[2] ? "true" : "false");
    fprintf(f, "initial: { field = \"%s\";", s->field);
    if (has_scale(s))
        fprintf(f, " U = %.17g;", s->U);
    if (has_length(s))
        fprintf(f, " L = %.17g;", s->L);
    if (!is_zero(s->V))
        vector(f, "velocity", s->V, s->dim);
    if (s->amplitude != 0.0)
        fprintf(f, " amplitude = %.17g;", s->amplitude);
    if (s->level > -1e29)
        fprintf(f, " level = %.17g;", s->level);
    fprintf(f, " };\n");
    write_walls(s, f);
    write_bodies(s, name, f);
    write_shapes(s, f);
    write_solvers(s, f);
    write_refinement(s, f);
    fprintf(f, "output: { snapshots = false; series = 1; };\n");
}
