/* shell.c - distance from the surface of a body or wall: in 3D by the search tree of its mesh, in
 * 2D over its segments, which are taken in runs that a box encloses. The surface stays in the frame
 * of the start and positions are brought into it. SPDX-License-Identifier: BSD-3-Clause */
#include "shell.h"

#include "../../common/geometry/geometry.h"

enum { RUN = 16 }; /* segments that follow each other share a box */

struct shell_line {
    double x[2], d[2], d2_1; /* m: start and way to the end; 1/m^2: over its square, or 0 */
};

/* The segments of a line. */
static void add_lines(void *owner, struct shell *to, const struct param_points *p, bool closed)
{
    to->nlines = closed ? p->n : p->n - 1;
    to->line = NEW_IN(owner, struct shell_line, to->nlines);
    to->run = NEW_IN(owner, struct shell_run, to->nlines / RUN + 1);
    for (int k = 0; k < to->nlines; k++) {
        const double *from = p->x[k], *end = p->x[(k + 1) % p->n];
        struct shell_line *l = to->line + k;
        struct shell_run *run = to->run + k / RUN;
        double d2 = 0.0;
        for (int a = 0; a < 2; a++) {
            l->x[a] = from[a];
            l->d[a] = end[a] - from[a];
            d2 += l->d[a] * l->d[a];
            run->lo[a] = fmin(k % RUN ? run->lo[a] : from[a], fmin(from[a], end[a]));
            run->hi[a] = fmax(k % RUN ? run->hi[a] : from[a], fmax(from[a], end[a]));
            to->lo[a] = fmin(k ? to->lo[a] : run->lo[a], run->lo[a]);
            to->hi[a] = fmax(k ? to->hi[a] : run->hi[a], run->hi[a]);
        }
        l->d2_1 = d2 > 0.0 ? 1.0 / d2 : 0.0;
    }
}

/* A scene's mesh and its tree are borrowed. */
struct shell shell_create(void *owner, const struct scene *s, enum mesh_owner kind, int index)
{
    const bool body = kind == MESH_OF_BODY;
    const struct scene_mesh *file = scene_mesh_of(s, kind, index);
    struct shell to = {.dim = s->domain.dim};
    if (file) {
        to.tree = file->tree;
        memcpy(to.lo, file->lo, sizeof to.lo);
        memcpy(to.hi, file->hi, sizeof to.hi);
    } else {
        add_lines(owner, &to, body ? &s->bodies[index].points : &s->walls[index].points,
                  body || s->walls[index].closed);
    }
    if (body)
        memcpy(to.centre, s->bodies[index].centre, sizeof to.centre);
    shell_move(&to, NULL);
    return to;
}

/* Sets displacement and rotation; NULL: as at the start. */
void shell_move(struct shell *s, const struct body_motion *now)
{
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            s->Q[a][b] = now ? now->Q[a][b] : a == b;
    for (int a = 0; a < 3; a++)
        s->x[a] = now ? now->x[a] : 0.0;
}

/* The square of how far x lies outside of a box, m^2. */
static double outside2(const double *lo, const double *hi, const double *x, int dim)
{
    double out = 0.0;
    for (int a = 0; a < dim; a++) {
        const double below = lo[a] - x[a], above = x[a] - hi[a], d = below > above ? below : above;
        out += d > 0.0 ? d * d : 0.0;
    }
    return out;
}

/* The square of the distance from the nearest segment, at most `most', m^2. */
static double nearest2(const struct shell *s, const double *x, double most)
{
    for (int r = 0; r * RUN < s->nlines; r++) {
        if (outside2(s->run[r].lo, s->run[r].hi, x, 2) >= most)
            continue;
        for (int k = r * RUN; k < s->nlines && k < (r + 1) * RUN; k++) {
            const struct shell_line *l = s->line + k;
            const double a = x[0] - l->x[0], b = x[1] - l->x[1];
            const double t = (a * l->d[0] + b * l->d[1]) * l->d2_1;
            const double at = t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
            const double p = a - at * l->d[0], q = b - at * l->d[1], d2 = p * p + q * q;
            most = d2 < most ? d2 : most;
        }
    }
    return most;
}

/* The box around the surface spares the search for whatever is farther than `reach'. */
double shell_distance(const struct shell *s, const double *x, double reach)
{
    double arm[3] = {0.0, 0.0, 0.0}, own[3];
    for (int a = 0; a < s->dim; a++)
        arm[a] = x[a] - s->centre[a] - s->x[a];
    turn_back3((double(*)[3])s->Q, arm, own);
    for (int a = 0; a < s->dim; a++)
        own[a] += s->centre[a];
    const double out = outside2(s->lo, s->hi, own, s->dim);
    if (out >= reach * reach)
        return sqrt(out);
    if (!s->tree)
        return sqrt(nearest2(s, own, reach * reach));
    const double d = fabs(tree_nearest(s->tree, own, reach).distance);
    return d < reach ? d : reach;
}
