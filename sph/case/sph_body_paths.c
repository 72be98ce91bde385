/* sph_body_paths.c - bodies and walls of a scene as particles meet them: gaps that none can enter,
 * bodies that overlap, pierce walls or leave the domain, now or later, files of motion that a run
 * cannot follow. SPDX-License-Identifier: BSD-3-Clause */
#include "../../common/run/run.h"
#include "../../common/scene/scene.h"
#include "../bodies/sph_bodies.h"
#include "../open_boundaries/sph_open_boundaries.h"
#include "../walls/sph_walls.h"
#include "sph_sense.h"

enum { LEAST_TIMES = 20, MOST_TIMES = 2000 };

/* A line of the scene that particles meet. */
struct bound {
    struct line line;
    char name[64];
    int body, wall; /* in the scene's lists; body -1: a wall */
    bool elsewhere; /* a body in another program's box */
    double x[2][2]; /* of a side */
};

enum { BOUNDS_MAX = WALLS_MAX + BODIES_MAX };

/* The side as a line of two points, in 2D. */
static void side_ends(const struct scene_domain *d, int side, double x[2][2])
{
    const int a = side / 2, b = 1 - a;
    x[0][a] = x[1][a] = side % 2 ? d->max[a] : d->min[a];
    x[0][b] = d->min[b];
    x[1][b] = d->max[b];
}

/* Bodies first, each at its own index, then walls that the particles reach; returns how many. */
static int find_bounds(const struct scene *c, const struct sph_params *used, struct bound *all)
{
    int n = 0;
    for (int k = 0; k < c->nbodies; k++, n++) {
        all[n].line = line_of(&c->bodies[k].points, true);
        all[n].body = k;
        snprintf(all[n].name, sizeof all[n].name, "body %d (%.40s)", k + 1, c->bodies[k].name);
    }
    for (int k = 0; k < c->nwalls; k++) {
        const struct scene_wall *w = c->walls + k;
        const int side = w->side - SIDE_X_MIN;
        if (w->kind >= WALL_INFLOW || (side >= 0 && !sph_params_reaches(&c->domain, used, side)))
            continue;
        all[n].body = -1;
        all[n].wall = k;
        snprintf(all[n].name, sizeof all[n].name, "wall %d", k + 1);
        if (side >= 0)
            side_ends(&c->domain, side, all[n].x);
        all[n].line = side >= 0 ? (struct line){2, (const double(*)[2])all[n].x, false}
                                : line_of(&w->points, w->closed);
        n++;
    }
    return n;
}

/* A side of the domain, whose fluid is within whatever the sense of its ends. */
static bool is_side(const struct bound *b) { return b->line.x == (const double(*)[2])b->x; }

/* --- gaps --- */

/* Nearest point of a line to x; side: > 0 if x is on its left, 0 beyond an end. */
static void foot_of(const struct line *l, const double *x, double foot[2], double *side)
{
    const struct line_foot f = line_foot(l, x);
    memcpy(foot, f.x, sizeof f.x);
    *side = f.past ? 0.0 : f.aside;
}

/* Whether the middle of the gap at x, or its image, lies where fluid could be: behind no wall. */
static bool is_wet(const struct scene *c, const struct bound *A, const struct bound *B,
                   const double *x)
{
    double p[2], q[2], left[2];
    foot_of(&A->line, x, p, left);
    foot_of(&B->line, x, q, left + 1);
    const double mid[3] = {0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]), 0.0};
    foot_of(&A->line, mid, p, left);
    foot_of(&B->line, mid, q, left + 1);
    double y[3] = {mid[0], mid[1], 0.0};
    for (int a = 0; a < 2; a++)
        y[a] = scene_image_from(&c->domain, a, c->domain.min[a], mid[a]);
    bool in = scene_is_room(c, y) && !scene_is_behind_lines(c, y);
    for (int a = 0; a < 2; a++)
        in = in &&
             (c->domain.periodic[a] || (mid[a] > c->domain.min[a] && mid[a] < c->domain.max[a]));
    return in && (is_side(A) || left[0] >= 0.0) && (is_side(B) || left[1] >= 0.0);
}

static bool is_free(const struct scene *c, const struct bound *b)
{
    return b->body >= 0 && c->bodies[b->body].free;
}

/* Whether it is told to turn, and not about what. Sets *axes to the bits 1 << a of what it turns
 * about. */
static bool turns_about_origin(const struct run *r, int k, int *axes)
{
    const struct scene_body *b = r->scene.bodies + k;
    *axes = scene_motions_turn(&b->motion);
    for (int a = 0; a < 3; a++)
        *axes |= b->spin[a] != 0.0 ? 1 << a : 0;
    return *axes && !b->free && !params_given(r->params, key_text("bodies.[%d].centre", k));
}

/* One that so swings on an arm that nobody drew. What turns about one axis may be anywhere along
 * it. */
static void warn_of_arm(const struct run *r, const struct body *b, int k)
{
    int axes;
    bool beside = false;
    if (!turns_about_origin(r, k, &axes) || vec3_length(b->centre) > 0.0)
        return;
    for (int a = 0; a < r->scene.domain.dim; a++)
        beside = beside || (axes != 1 << a && fabs(b->middle[a]) > b->half[a]);
    if (beside)
        log_warn("body %d (%s) turns about the origin, which lies outside of it: give its centre, "
                 "also if that is meant",
                 k + 1, b->is->name);
}

/* What to do with body k, which is beyond a side along an axis. */
static const char *beyond_remedy(const struct run *r, int k, int axis)
{
    int axes;
    return turns_about_origin(r, k, &axes)
               ? "it turns about the origin, by angles in rad: give its centre, or make the "
                 "domain larger"
           : r->scene.domain.periodic[axis]
               ? "a body may come up to it, not through it; shift the domain, or make it larger"
           : scene_body_moves(r->scene.bodies + k)
               ? "make the domain larger, or the motion smaller; a flap that turns on a side "
                 "stands on a point there, as points = ((0, 0), (-0.1, 0.1), ...)"
               : "make the domain larger, or end it on the side: one that crosses "
                 "a closed side once is cut there";
}

/* How it goes beyond that side. */
static const char *beyond_word(const struct run *r, int axis)
{
    return r->scene.domain.periodic[axis] ? "crosses the periodic side"
                                          : "leaves the domain across";
}

static const char *place_of(int dim, const double *x)
{
    return dim == 3 ? key_text("(%g, %g, %g) m", x[0], x[1], x[2])
                    : key_text("(%g, %g) m", x[0], x[1]);
}

/* The room that a body may have at a time: of the domain the free zone of the particles, m. */
struct room {
    double lo[3], hi[3];
};

static struct room room_at(const struct run *r, const struct sph_params *used, double t)
{
    const struct scene_domain *d = &r->scene.domain;
    struct room is;
    double way[3];
    if (d->dim == 3 && used->outer == OUTER_PARTNER) { /* judged there: coupling_solids.c */
        memcpy(is.lo, d->min, sizeof is.lo);
        memcpy(is.hi, d->max, sizeof is.hi);
        return is;
    }
    zones_free_box(r, used, is.lo, is.hi);
    (void)box_motion_foretold(r, used, t, way);
    for (int a = 0; a < 3; a++) {
        is.lo[a] += way[a];
        is.hi[a] += way[a];
    }
    return is;
}

/* What to do with x of body k, which is beyond the free zone along an axis but not beyond the
 * domain. */
static const char *zone_remedy(const struct scene *s, int k, const struct room *room, int axis,
                               const double *x)
{
    const double image = scene_image_from(&s->domain, axis, room->lo[axis], x[axis]);
    if (image != x[axis] && image <= room->hi[axis])
        return key_text("sph.box lies in another period: draw it %+g m farther along %c",
                        image - x[axis], "xyz"[axis]);
    if (s->has_fv || scene_body_moves(s->bodies + k))
        return "only there it is known; keep it 2.5 R from openings, or make sph.box larger";
    return key_text("only there it is known; keep it 2.5 R from openings, or make it a wall "
                    "(walls.%s), which openings may cross",
                    s->domain.dim == 2 ? "points" : "mesh");
}

/* Whether a corner x of body k is in its room; when: the words for the time. */
static bool check_room(const struct run *r, const struct room *room, int k, const char *name,
                       const double *x, const char *when, struct faults *f)
{
    const struct scene_domain *d = &r->scene.domain;
    for (int a = 0; a < d->dim; a++) {
        const double small = 1e-6 * (d->max[a] - d->min[a]); /* a file's last digits */
        const bool leaves = x[a] < d->min[a] - small || x[a] > d->max[a] + small;
        if (x[a] >= room->lo[a] - small && x[a] <= room->hi[a] + small)
            continue;
        params_fault(r->params, f, key_text("bodies.[%d]", k), "%s %s %c at %s, %s: %s", name,
                     leaves ? beyond_word(r, a) : "leaves the free zone of the particles across",
                     "xyz"[a], place_of(d->dim, x), when,
                     leaves ? beyond_remedy(r, k, a) : zone_remedy(&r->scene, k, room, a, x));
        return false;
    }
    return true;
}

/* Whether x is so near to the axis of a free body's hinge that contact leaves it alone: see
 * body_touch.h. */
static bool is_held(const struct scene_body *b, const double *x, double gap)
{
    static const double z[3] = {0.0, 0.0, 1.0};
    double axis[3], arm[3] = {0.0, 0.0, 0.0};
    if (b->hinge.n == 0)
        return false;
    const bool flat = b->points.n > 0;
    const struct scene_hinge *h = b->hinge.of;
    memcpy(axis, flat ? z : h->axis, sizeof axis);
    vec3_unit(axis);
    for (int a = 0; a < (flat ? 2 : 3); a++)
        arm[a] = x[a] - h->at[a];
    vec3_add(arm, -vec3_dot(arm, axis), axis);
    return vec3_length(arm) < gap;
}

/* d: between body k and another, m; below zero one is in the other. */
static void fault_contact(const struct run *r, int k, const char *name, const char *other, double d,
                          double gap, const double *at, struct faults *f)
{
    const char *key = key_text("bodies.[%d]", k), *place = place_of(r->scene.domain.dim, at);
    if (d < 0.0)
        params_fault(r->params, f, key, "%s reaches %g m into %s at %s: move it away", name, -d,
                     other, place);
    else
        params_fault(r->params, f, key,
                     "%s starts in contact with %s: %g m apart at %s, where contact holds %g m "
                     "(contact.gap): move it away by that; only corners that near to its hinge "
                     "may touch, so let it stand on a point there",
                     name, other, d, place, gap);
}

/* Least distance of two lines, and of those corners of each that no hinge of b holds. */
static double free_gap(const struct scene_body *b, const struct line *mine,
                       const struct line *other, double gap, double at[2])
{
    double least = INFINITY;
    for (int e = 0; e < 2; e++) {
        const struct line *of = e ? other : mine, *against = e ? mine : other;
        for (int i = 0; i < of->n; i++) {
            const double d = line_distance(against, of->x[i]);
            if (d >= least || is_held(b, of->x[i], gap))
                continue;
            least = d;
            memcpy(at, of->x[i], 2 * sizeof *at);
        }
    }
    return least;
}

/* Whether body k is the one of a pair that looks whether they touch: before what no fluid moves, of
 * two free ones that on a hinge, else the later one. */
static bool looks(const struct scene *c, int k, int other)
{
    const bool hinged = c->bodies[k].hinge.n > 0;
    if (other < 0 || !c->bodies[other].free)
        return true;
    return hinged == (c->bodies[other].hinge.n > 0) ? other < k : hinged;
}

/* What turns about a hinge would be jammed by what it touches at the start. Others stand where they
 * are: body_contact.c. */
static void check_contacts(const struct run *r, const struct sph_params *used,
                           const struct bound *all, int n, struct faults *f)
{
    for (int k = 0; k < r->scene.nbodies; k++)
        for (int m = 0; m < n; m++) {
            const struct scene_body *b = r->scene.bodies + k;
            const double gap = scene_contact_of(b).gap * used->dx * (1.0 - 1e-6);
            double at[2] = {0.0, 0.0};
            if (m == k || !b->free || b->hinge.n == 0 || !looks(&r->scene, k, all[m].body))
                continue;
            const double d = free_gap(b, &all[k].line, &all[m].line, gap, at);
            if (d < gap)
                fault_contact(r, k, all[k].name, all[m].name, d, gap, at, f);
        }
}

/* The wall next to x, of all or of lines alone; shows: its back. NULL: there is none. */
static const struct bound *nearest_wall(const struct run *r, const struct bound *all, int n,
                                        bool lines, const double *x, bool *shows)
{
    const struct bound *next = NULL;
    double least = INFINITY;
    for (int m = r->scene.nbodies; m < n; m++) {
        double foot[2], side = 0.0;
        if (lines && is_side(all + m))
            continue;
        foot_of(&all[m].line, x, foot, &side);
        const double d = hypot(x[0] - foot[0], x[1] - foot[1]);
        if (d >= least)
            continue;
        least = d;
        *shows = side < 0.0;
        next = all + m;
    }
    return next;
}

/* A line acts on what stands on its left. A body in a room that a wall shows its back to, or a free
 * one of which the nearest line that is no side of the domain shows its back to all corners, stands
 * in that line's solid: it would fall through it, and be thrown out where it comes to the other
 * side, and water beside it would have no floor. */
static void check_backs(const struct run *r, const struct sph_params *used, const struct bound *all,
                        int n, struct faults *f)
{
    for (int k = 0; k < r->scene.nbodies; k++) {
        bool behind = is_free(&r->scene, all + k), shows = false;
        for (int i = 0; i < all[k].line.n && behind; i++) {
            const struct bound *next = nearest_wall(r, all, n, false, all[k].line.x[i], &shows);
            behind = next && !is_side(next) && shows;
        }
        const struct param_points *of = &r->scene.bodies[k].points;
        if (!behind &&
            (all[k].line.n == 0 || of->n == 0 ||
             body_backs_first_open(&r->scene, used, of->n, (const double(*)[2])of->x) < of->n))
            continue;
        const struct bound *at_back = nearest_wall(r, all, n, true, all[k].line.x[0], &shows);
        if (!at_back)
            continue;
        params_fault(r->params, f, key_text("bodies.[%d]", k), "%s stands behind %s, %s: %s",
                     all[k].name, at_back->name,
                     at_back->line.closed ? "within what is solid there"
                                          : "an open line, which acts on its left alone",
                     at_back->line.closed ? "move it"
                                          : "give the points of that line in reverse order, close "
                                            "it round what is solid, or move the body");
    }
}

/* Ends of open lines on a periodic side, where another line, side or body must go on beyond it: a
 * bed has one height at both. */
static void check_period_ends(const struct run *r, const struct sph_params *used,
                              const struct bound *all, int n, struct faults *f)
{
    const struct scene_domain *d = &r->scene.domain;
    const double near = 0.1 * used->dx;
    for (int k = 0; k < 4 * n; k++) {
        const struct bound *b = all + k / 4;
        const int a = k / 2 % 2, last = k % 2;
        const double *x = b->line.x[last ? b->line.n - 1 : 0], *lo = d->min, *hi = d->max;
        double y[2] = {x[0], x[1]}, least = INFINITY;
        const bool low = fabs(x[a] - lo[a]) < near;
        if (b->line.closed || is_side(b) || !d->periodic[a] ||
            (!low && fabs(x[a] - hi[a]) >= near) || x[1 - a] < lo[1 - a] + near ||
            x[1 - a] > hi[1 - a] - near)
            continue;
        y[a] += low ? hi[a] - lo[a] : lo[a] - hi[a];
        for (int m = 0; m < n; m++)
            least = fmin(least, line_distance(&all[m].line, y));
        if (least <= near)
            continue;
        params_fault(r->params, f, key_text("walls.[%d]", b->wall),
                     "%s ends on the periodic side %c at (%g, %g) m, and nothing goes on from "
                     "(%g, %g) m, where its image ends: a bed needs the same height at both "
                     "ends; else end it on a wall, or take walls for the period",
                     b->name, "xy"[a], x[0], x[1], y[0], y[1]);
        return;
    }
}

/* --- meshes --- */

/* Distance of x to the nearest wall of the domain's sides and its place in the scene's words. */
static double side_distance(const struct scene *c, const double *x, char *what, size_t size)
{
    double least = INFINITY;
    for (int side = 0; side < 6; side++) {
        const struct scene_wall *w = scene_wall_of(c, SIDE_X_MIN + side);
        const int a = side / 2;
        const double d = side % 2 ? c->domain.max[a] - x[a] : x[a] - c->domain.min[a];
        if (w && w->kind <= WALL_NO_SLIP && d < least) {
            least = d;
            snprintf(what, size, "wall %d", (int)(w - c->walls) + 1);
        }
    }
    return least;
}

/* Vertices of free body b, whose mesh is m, against another, those of that against the body:
 * nearest of all that its hinge does not hold; of faces that are flush, whose vertices lie on each
 * other, the middles of triangles, too. reach: of contact, of the search. */
static double mesh_distance(const struct scene *c, const struct scene_body *b,
                            const struct scene_mesh *m, const struct scene_mesh *n,
                            const double reach[2], double at[3])
{
    double least = INFINITY;
    for (int e = 0; e < 2; e++) {
        const struct scene_mesh *of = e ? n : m, *against = e ? m : n;
        const int nv = of->mesh.nvertices;
        for (int i = 0; i < nv + of->mesh.ntriangles; i++) {
            double x[3];
            if (i < nv)
                memcpy(x, of->mesh.x[i], sizeof x);
            else
                trimesh_middle(&of->mesh, i - nv, x);
            struct tree_foot t = tree_nearest(against->tree, x, reach[1]);
            if (!against->mesh.closed && scene_mesh_thin(c, against))
                t = tree_foot_of_sheet(t);
            if (t.triangle < 0 || t.rim || t.distance >= (i < nv ? least : fmin(least, 0.0)) ||
                is_held(b, x, reach[0]))
                continue;
            least = t.distance;
            memcpy(at, x, sizeof x);
        }
    }
    return least;
}

/* A free body in 3D against sides, walls and other bodies at the start. */
static void check_start3(const struct run *r, const struct sph_params *used, int k,
                         struct faults *f)
{
    const struct scene *c = &r->scene;
    const struct scene_body *b = c->bodies + k;
    const struct scene_mesh *m = scene_mesh_of(c, MESH_OF_BODY, k);
    const double gap = scene_contact_of(b).gap * used->dx * (1.0 - 1e-6),
                 least = b->hinge.n > 0 ? gap : -1e-6 * used->dx; /* as check_contacts */
    double at[3] = {0.0, 0.0, 0.0}, size = 0.0;
    char what[96];
    for (int a = 0; a < 3; a++)
        size = fmax(size, m->hi[a] - m->lo[a]);
    for (int i = 0; i < m->mesh.nvertices; i++) {
        const double d = side_distance(c, m->mesh.x[i], what, sizeof what);
        if (d < least && !is_held(b, m->mesh.x[i], gap)) {
            fault_contact(r, k, b->name, what, d, gap, m->mesh.x[i], f);
            return;
        }
    }
    for (int j = 0; j < c->meshes->n; j++) {
        const struct scene_mesh *n = c->meshes->of + j;
        if (n == m || n->owner == MESH_OF_SHAPE ||
            !looks(c, k, n->owner == MESH_OF_BODY ? n->index : -1))
            continue;
        const double d = mesh_distance(c, b, m, n, (const double[2]){gap, fmax(size, gap)}, at);
        snprintf(what, sizeof what, "%s", n->name);
        if (d < least)
            fault_contact(r, k, b->name, what, d, gap, at, f);
    }
}

/* Bodies of triangles along their motion. */
static void check_meshes(const struct run *r, const struct sph_params *used, struct body *bodies,
                         int times, struct faults *f)
{
    const struct scene *c = &r->scene;
    for (int k = 0; k < c->nbodies; k++) {
        const struct trimesh *m = bodies[k].mesh;
        const int before = f->n, most = bodies[k].free ? 0 : times < 200 ? times : 200;
        const bool here = m && !solids_elsewhere(r, MESH_OF_BODY, k);
        for (int i = 0; here && i <= most && f->n == before; i++) {
            const double t = body_drive_instant(i, most, c->time.end);
            const struct room room = room_at(r, used, t);
            char when[64];
            snprintf(when, sizeof when, t > 0.0 ? "at t = %g s" : "at the start", t);
            body_move(bodies + k, t);
            for (int v = 0; v < m->nvertices && f->n == before; v++) {
                double x[3];
                body_place(bodies + k, m->x[v], x);
                check_room(r, &room, k, c->bodies[k].name, x, when, f);
            }
        }
        if (m && bodies[k].free && f->n == before)
            check_start3(r, used, k, f);
    }
}

/* Of particles one must fit between two of which none moves by forces. beyond: b stands across a
 * period. */
static void check_gap(const struct run *r, const struct sph_params *used, const struct bound *b,
                      const struct bound *other, bool beyond, struct faults *f)
{
    double at[2] = {0.0, 0.0};
    const double gap = line_gap(&b->line, &other->line, at);
    if (gap > 1e-3 * used->dx && gap < (1.0 - 1e-6) * used->dx && is_wet(&r->scene, b, other, at))
        params_fault(r->params, f, b->body < 0 && other->body < 0 ? "walls" : "bodies",
                     "a gap of %g m between %s and %s%s at (%g, %g) m, where no particle of %g m "
                     "fits: close it, or refine sph.dx",
                     gap, other->name, b->name, beyond ? " across the period" : "", at[0], at[1],
                     used->dx);
}

/* The same with the image of b at `way' periods along each axis. */
static void check_gap_beyond(const struct run *r, const struct sph_params *used,
                             const struct bound *b, const struct bound *other, const int way[2],
                             struct faults *f)
{
    const struct scene_domain *d = &r->scene.domain;
    struct bound image = *b;
    double(*const x)[2] = mem_new((size_t)b->line.n, sizeof *x);
    for (int i = 0; i < b->line.n; i++)
        for (int a = 0; a < 2; a++)
            x[i][a] = b->line.x[i][a] + way[a] * (d->max[a] - d->min[a]);
    image.line.x = (const double(*)[2])x;
    check_gap(r, used, &image, other, true, f);
    mem_free(x);
}

/* Of a body with others' images across periods, its own among them; walls go on there, and lines
 * that do not are check_period_ends'. One of two that face each other suffices. */
static void check_gaps_beyond(const struct run *r, const struct sph_params *used,
                              const struct bound *b, const struct bound *other, struct faults *f)
{
    const bool *periodic = r->scene.domain.periodic;
    int way[2];
    for (way[0] = -periodic[0]; way[0] <= periodic[0]; way[0]++)
        for (way[1] = -periodic[1]; way[1] <= periodic[1]; way[1]++) {
            const int order = way[0] ? way[0] : way[1]; /* an own image has an opposite one */
            if (order != 0 && (b != other || order > 0))
                check_gap_beyond(r, used, b, other, way, f);
        }
}

/* Between what does not move by forces, at the start. */
static void check_gaps(const struct run *r, const struct sph_params *used, struct faults *f)
{
    struct bound all[BOUNDS_MAX];
    const int n = find_bounds(&r->scene, used, all);
    for (int k = 0; k < n; k++)
        for (int m = 0; m <= k; m++) {
            if (is_free(&r->scene, all + k) || is_free(&r->scene, all + m))
                continue; /* it closes and opens */
            if (m < k)
                check_gap(r, used, all + k, all + m, false, f);
            if (all[k].body >= 0 && !is_side(all + m))
                check_gaps_beyond(r, used, all + k, all + m, f);
            else if (all[m].body >= 0 && !is_side(all + k))
                check_gaps_beyond(r, used, all + m, all + k, f);
        }
}

/* --- motion --- */

/* Corners of all bodies at a time, in now; lines of the bounds point there. */
static void place_bodies(const struct scene *c, struct body *bodies, double t,
                         struct param_points *now)
{
    for (int k = 0; k < c->nbodies; k++) {
        body_move(bodies + k, t);
        now[k].n = c->bodies[k].points.n;
        for (int i = 0; i < now[k].n; i++)
            body_place(bodies + k, c->bodies[k].points.x[i], now[k].x[i]);
    }
}

/* Two that are in each other at a time. */
static void fault_of_places(const struct run *r, struct faults *f, const struct bound *b,
                            const struct bound *other, const double *at, const char *when)
{
    const bool wall = other->body < 0, moves = scene_body_moves(r->scene.bodies + b->body);
    params_fault(r->params, f, key_text("bodies.[%d]", b->body), "%s %s %s %s at (%g, %g) m: %s",
                 b->name, wall ? "cuts" : "overlaps with", other->name, when, at[0], at[1],
                 moves ? "move it away, or make the motion smaller"
                 : wall
                     ? "let it end on the wall, with corners on it, or draw it as part of the wall"
                     : "let them touch, or draw them as one");
}

static bool is_tank(const struct run *r, const struct bound *b)
{
    return b->body >= 0 && r->scene.bodies[b->body].tank;
}

/* What is wrong at one time; true: something. What a tank holds is inside it. */
static bool check_places(const struct run *r, const struct sph_params *used,
                         const struct bound *all, int n, double t, struct faults *f)
{
    char when[64];
    double at[2];
    const int before = f->n;
    const struct room room = room_at(r, used, t);
    snprintf(when, sizeof when, t > 0.0 ? "at t = %g s" : "at the start", t);
    for (int k = 0; k < r->scene.nbodies; k++) {
        if (t > 0.0 && r->scene.bodies[k].free)
            continue; /* goes where forces take it, and is watched there */
        for (int i = 0; i < all[k].line.n && !all[k].elsewhere; i++)
            if (!check_room(r, &room, k, all[k].name, all[k].line.x[i], when, f))
                return true;
        for (int m = 0; m < n; m++) {
            if (t > 0.0 && all[m].body >= 0 && r->scene.bodies[all[m].body].free)
                continue;
            if (m == k || (all[m].body >= 0 && m > k))
                continue;
            const bool apart = all[m].body >= 0 && !is_tank(r, all + k) && !is_tank(r, all + m);
            if (apart ? line_overlaps(&all[k].line, &all[m].line, at)
                      : line_pierces(&all[k].line, &all[m].line, at))
                fault_of_places(r, f, all + k, all + m, at, when);
        }
    }
    return f->n > before;
}

/* Of one in 2D, as of meshes in 3D (sph_meshes.c). */
static void check_size(const struct run *r, const struct sph_params *used, int k, struct faults *f)
{
    const struct line l = line_of(&r->scene.bodies[k].points, true);
    const double size = line_size(&l);
    if (size < used->dx)
        params_fault(r->params, f, key_text("bodies.[%d]", k),
                     "%s is %.3g m in size, less than sph.dx = %g m: no particle sees it. Are its "
                     "points in m? Else take sph.dx = %.2g or less",
                     r->scene.bodies[k].name, size, used->dx, 0.25 * size);
}

/* Motion, of bodies and of a box, is followed over times so near that the fastest goes half a
 * spacing between two, 2000 at most. Checks later in the list take for granted what those before
 * have found in order. */
void sph_bodies_check(const struct run *r, const struct sph_params *used, struct faults *f)
{
    const struct scene *c = &r->scene;
    struct body bodies[BODIES_MAX];
    struct param_points *now = NEW(struct param_points, BODIES_MAX);
    struct bound all[BOUNDS_MAX];
    double speed = 0.0;
    const int before = f->n;
    body_check(r, used, f);
    paddles_check(r, used, f);
    if (f->n > before) {
        mem_free(now);
        return;
    }
    for (int k = 0; k < c->nbodies; k++) {
        body_create(bodies + k, c->bodies + k, scene_body_mesh(c, k), c->domain.dim, r->motions);
        warn_of_arm(r, bodies + k, k);
    }
    const bool plane = c->domain.dim == 2;
    const int n = plane ? find_bounds(c, used, all) : 0;
    for (int k = 0; k < c->nbodies && plane; k++) {
        all[k].line = line_of(&c->bodies[k].points, true);
        all[k].line.x = (const double(*)[2])now[k].x;
        all[k].elsewhere = solids_elsewhere(r, MESH_OF_BODY, k);
        if (!all[k].elsewhere)
            check_size(r, used, k, f);
    }
    for (int k = 0; k < c->nbodies; k++)
        speed = fmax(speed, body_drive_speed(&bodies[k].drive, bodies[k].reach, c->time.end));
    if (speed > 0.5 * used->c0)
        params_fault(r->params, f, "bodies",
                     "a body moves at %g m/s, above half the speed of sound, %g m/s: raise sph.c0",
                     speed, 0.5 * used->c0);
    speed = fmax(speed, box_motion_speed(r, used)); /* of the room that they must stay in */
    const double wanted = fmin(2.0 * speed * c->time.end / used->dx, MOST_TIMES);
    const int times = speed > 0.0 ? (int)fmax(wanted, LEAST_TIMES) : 0;
    for (int i = 0; i <= times && plane; i++) {
        const double t = body_drive_instant(i, times, c->time.end);
        place_bodies(c, bodies, t, now);
        if (check_places(r, used, all, n, t, f))
            break;
    }
    if (plane)
        place_bodies(c, bodies, 0.0, now);
    if (f->n == before && plane)
        check_contacts(r, used, all, n, f);
    check_backs(r, used, all, n, f);
    check_period_ends(r, used, all, n, f);
    if (!plane)
        check_meshes(r, used, bodies, times, f);
    for (int k = 0; k < c->nbodies; k++)
        body_destroy(bodies + k);
    mem_free(now);
    if (plane)
        check_gaps(r, used, f);
}
