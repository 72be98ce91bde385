/* walls.c - geometry and motion of the walls; see walls.h. walls_create goes through the case's
 * walls in their order: sides and polylines become segments in the plane (what others cover is left
 * out), bodies come behind them, then images beyond periodic sides and, in 3D, the meshes
 * (wall_mesh.c); last the wall model makes its state from the walls as they are at t = 0.
 * walls_move sets them to a stage's time. What has come behind a wall is put back before it by
 * walls_put_back.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "walls.h"

#include "../particles/sph_particles.h"
#include "forces.h"
#include "wall_cover.h"

/* The normal is the tangent turned clockwise: out of a fluid on the left. */
static void set_frame(struct segment *g)
{
    const double d[2] = {g->b[0] - g->a[0], g->b[1] - g->a[1]};
    g->length = sqrt(d[0] * d[0] + d[1] * d[1]);
    g->t[0] = d[0] / g->length;
    g->t[1] = d[1] / g->length;
    g->n[0] = g->t[1];
    g->n[1] = -g->t[0];
}

/* What a wall of the case is beside its place. */
static struct segment kind_of(const struct scene_wall *is)
{
    return (struct segment){.body = -1,
                            .of = -1,
                            .no_slip = is->kind == WALL_NO_SLIP,
                            .friction = is->friction,
                            .u = {is->velocity[0], is->velocity[1]}};
}

/* As `like', at another place. */
static void add_segment(struct walls *w, const double *a, const double *b,
                        const struct segment *like)
{
    if (w->nsegments % 64 == 0)
        GROW_IN(w, w->segments, w->nsegments, w->nsegments + 64);
    struct segment g = *like;
    memcpy(g.a, a, sizeof g.a);
    memcpy(g.b, b, sizeof g.b);
    set_frame(&g);
    if (g.length > 0.0)
        w->segments[w->nsegments++] = g;
}

/* Whether fluid goes on beyond a side of the region: what an inlet or outlet has. */
static bool goes_beyond(const struct sph *s, int side)
{
    const struct scene_wall *w = scene_wall_of(&s->run->scene, SIDE_X_MIN + side);
    return w && scene_wall_opens(w);
}

/* Ends on an inlet or outlet go on beyond it, as sides do; those on a period meet images. */
static void extend(const struct sph *s, double *end, const double *other)
{
    const double d[2] = {end[0] - other[0], end[1] - other[1]};
    const double length = sqrt(d[0] * d[0] + d[1] * d[1]);
    for (int a = 0; a < 2; a++)
        if ((goes_beyond(s, 2 * a) && fabs(end[a] - s->lo[a]) < 1e-9 * s->R) ||
            (goes_beyond(s, 2 * a + 1) && fabs(end[a] - s->hi[a]) < 1e-9 * s->R)) {
            end[0] += 2.5 * s->R * d[0] / length;
            end[1] += 2.5 * s->R * d[1] / length;
            return;
        }
}

/* Whether a polyline goes straight on at b, so that how a straight wall is cut changes nothing
 * unless it bends. */
static bool goes_on(const double *a, const double *b, const double *c)
{
    const double d[2] = {b[0] - a[0], b[1] - a[1]}, e[2] = {c[0] - b[0], c[1] - b[1]};
    const double turn = d[0] * e[1] - d[1] * e[0], along = d[0] * e[0] + d[1] * e[1];
    return along > 0.0 && fabs(turn) < 1e-9 * along;
}

static void add_polyline(struct sph *s, struct walls *w, const struct param_points *p, bool closed,
                         const struct segment *like)
{
    const int n = closed ? p->n : p->n - 1;
    const bool bends = like->body >= 0 && w->bodies[like->body].bend;
    struct segment piece = *like;
    double a[2], b[2];
    for (int k = 0; k < n; k++) {
        const double *from = p->x[k], *to = p->x[(k + 1) % p->n], *next = p->x[(k + 2) % p->n];
        if (k == 0 || bends || !goes_on(p->x[k - 1], from, to))
            memcpy(a, from, sizeof a);
        memcpy(b, to, sizeof b);
        if (k < n - 1 && !bends && goes_on(from, to, next))
            continue;
        if (!closed && a[0] == p->x[0][0] && a[1] == p->x[0][1])
            extend(s, a, p->x[1]);
        if (!closed && k == n - 1)
            extend(s, b, p->x[n - 1]);
        piece.point = k;
        add_segment(w, a, b, &piece);
    }
}

/* A side of the domain that the region does not reach is no wall of its particles. */
static bool is_wall(const struct sph *s, const struct scene_wall *w)
{
    const bool is = w && (w->kind == WALL_SLIP || w->kind == WALL_NO_SLIP);
    return is && (w->side == SIDE_NONE ||
                  sph_params_reaches(&s->run->scene.domain, &s->prm, w->side - SIDE_X_MIN));
}

/* Whether a polyline of the case has a point here: a wall goes on. */
static bool is_corner(const struct sph *s, const double *x)
{
    const struct scene *c = &s->run->scene;
    for (int k = 0; k < c->nwalls; k++)
        for (int i = 0; i < c->walls[k].points.n; i++) {
            const double *p = c->walls[k].points.x[i];
            if (fabs(p[0] - x[0]) < 1e-6 * s->dx && fabs(p[1] - x[1]) < 1e-6 * s->dx)
                return true;
        }
    return false;
}

/* A side of a plane domain as a segment: to the corners where walls meet, else beyond. */
static void add_side(struct sph *s, struct walls *w, const struct scene_wall *is)
{
    const int axis = (is->side - SIDE_X_MIN) / 2, other = 1 - axis;
    const bool high = (is->side - SIDE_X_MIN) % 2;
    const struct scene *c = &s->run->scene;
    const bool low_wall = is_wall(s, scene_wall_of(c, SIDE_X_MIN + 2 * other));
    const bool high_wall = is_wall(s, scene_wall_of(c, SIDE_X_MIN + 2 * other + 1));
    double a[2], b[2];
    a[axis] = b[axis] = high ? s->hi[axis] : s->lo[axis];
    a[other] = s->lo[other];
    b[other] = s->hi[other];
    a[other] -= low_wall || is_corner(s, a) ? 0.0 : 2.5 * s->R;
    b[other] += high_wall || is_corner(s, b) ? 0.0 : 2.5 * s->R;
    const bool forward = (axis == 1) != high; /* fluid on the left: bottom goes along +x */
    struct segment like = kind_of(is);
    like.beyond = s->periodic[other];
    add_segment(w, forward ? a : b, forward ? b : a, &like);
}

/* Velocity along the side alone: a plane of mirrored ghosts stays where it is. */
static void add_plane(const struct sph *s, struct walls *w, const struct scene_wall *is)
{
    const int axis = (is->side - SIDE_X_MIN) / 2;
    const bool high = (is->side - SIDE_X_MIN) % 2;
    struct wall_plane p = {.axis = axis,
                           .sign = high ? 1 : -1,
                           .at = high ? s->hi[axis] : s->lo[axis],
                           .no_slip = is->kind == WALL_NO_SLIP};
    memcpy(p.u, is->velocity, sizeof p.u);
    p.u[axis] = 0.0;
    w->planes[w->nplanes++] = p;
}

/* An image goes where the segment is. */
static void follow(const struct walls *w, struct segment *image)
{
    for (int a = 0; a < 2; a++) {
        image->a[a] = w->segments[image->of].a[a] + image->shift[a];
        image->b[a] = w->segments[image->of].b[a] + image->shift[a];
    }
    set_frame(image);
}

/* Of a body. */
static void place_segment(const struct body *b, const struct segment *start, struct segment *now)
{
    if (b->bend) {
        body_corner(b, now->point, now->a);
        body_corner(b, (now->point + 1) % b->bend->n, now->b);
    } else {
        body_place(b, start->a, now->a);
        body_place(b, start->b, now->b);
    }
    set_frame(now);
}

/* Images are the last segments, and an image of an image points at the original, so one pass
 * backwards reaches all. Free bodies move within a stage at one and the same t: then nothing may be
 * skipped. */
void walls_move(struct sph *s, double t)
{
    struct walls *w = s->walls;
    if (t == w->t && !w->any_free)
        return;
    w->t = t;
    for (int k = 0; k < w->nbodies; k++) {
        struct body *b = w->bodies + k;
        if (w->placed && !b->moves)
            continue;
        body_move(b, t);
        body_place(b, b->middle, w->middle[k]);
        for (int i = b->first; i < b->first + b->n; i++)
            place_segment(b, w->start + i, w->segments + i);
    }
    for (int i = w->nsegments; i > 0 && w->segments[i - 1].of >= 0; i--)
        follow(w, w->segments + i - 1);
    wall_meshes_move(w);
    w->placed = true;
}

/* Rigid: u + spin x d; its derivative has the centripetal part. A body that bends interpolates
 * between the points of its outline. */
void walls_velocity(const struct walls *w, const struct segment *g, const double *x, double *u,
                    double *du)
{
    if (du)
        du[0] = du[1] = 0.0;
    if (g->body < 0) {
        u[0] = g->u[0];
        u[1] = g->u[1];
        return;
    }
    const struct body *b = w->bodies + g->body;
    const struct body_motion *m = &b->now;
    if (b->bend) {
        const double along = (x[0] - g->a[0]) * g->t[0] + (x[1] - g->a[1]) * g->t[1];
        body_bend_velocity(b->bend, g->point, along / g->length, u, du);
        return;
    }
    const double d[2] = {x[0] - g->shift[0] - body_centre(b, 0),
                         x[1] - g->shift[1] - body_centre(b, 1)};
    u[0] = m->u[0] - m->spin * d[1];
    u[1] = m->u[1] + m->spin * d[0];
    if (du) {
        du[0] = m->du[0] - m->dspin * d[1] - m->spin * m->spin * d[0];
        du[1] = m->du[1] + m->dspin * d[0] - m->spin * m->spin * d[1];
    }
}

struct wall_side wall_side_none(double reach) { return (struct wall_side){reach, reach, -1.0}; }

void wall_side_add(struct wall_side *to, const struct segment *g, const double *x)
{
    const double d[2] = {x[0] - g->a[0], x[1] - g->a[1]};
    const double height = -(d[0] * g->n[0] + d[1] * g->n[1]);
    double along = d[0] * g->t[0] + d[1] * g->t[1];
    const bool round = (along < 0.0 && g->open[0]) || (along > g->length && g->open[1]);
    along = along < 0.0 ? -along : along > g->length ? along - g->length : 0.0;
    const double r = sqrt(along * along + height * height);
    if (r < to->least * (1.0 + 1e-12) &&
        (r < to->least * (1.0 - 1e-12) || fabs(height) > to->sure * (1.0 + 1e-9))) {
        to->least = r;
        to->sure = fabs(height);
        to->distance = height < 0.0 && !round ? -r : r;
    }
}

double walls_distance(const struct walls *w, const double *x, double reach)
{
    struct wall_side side = wall_side_none(reach);
    for (int k = 0; k < w->nsegments; k++)
        wall_side_add(&side, w->segments + k, x);
    return side.distance;
}

/* The point of a segment that is nearest to x; returns its distance, m. */
static double segment_foot(const struct segment *g, const double *x, double *foot)
{
    const double along =
        fmax(0.0, fmin((x[0] - g->a[0]) * g->t[0] + (x[1] - g->a[1]) * g->t[1], g->length));
    foot[0] = g->a[0] + along * g->t[0];
    foot[1] = g->a[1] + along * g->t[1];
    return hypot(x[0] - foot[0], x[1] - foot[1]);
}

int walls_nearest(const struct walls *w, const double *x, double *foot)
{
    double least = INFINITY;
    int found = 0;
    for (int k = 0; k < w->nsegments; k++) {
        double p[2];
        const double r = segment_foot(w->segments + k, x, p);
        if (r < least) {
            least = r;
            found = k;
            foot[0] = p[0];
            foot[1] = p[1];
        }
    }
    return found;
}

/* The nearest point of all walls. With the normal of the face, not of the way from x: a particle
 * behind a wall is put back along it. */
static struct wall_foot foot_of(const struct sph *s, const double *x)
{
    const struct walls *w = s->walls;
    struct wall_foot f = {.body = -1};
    if (s->dim == 2) {
        const struct segment *g = w->segments + walls_nearest(w, x, f.x);
        memcpy(f.n, g->n, sizeof g->n);
        f.body = g->body;
        walls_velocity(w, g, f.x, f.u, NULL);
        return f;
    }
    int mesh;
    const struct tree_foot t = wall_meshes_nearest(w, x, INFINITY, &mesh);
    memcpy(f.x, t.foot, sizeof f.x);
    memcpy(f.n, t.n, sizeof f.n);
    f.body = w->meshes[mesh].body;
    wall_mesh_velocity(w, w->meshes + mesh, f.x, f.u, NULL);
    return f;
}

double walls_way(const struct sph *s, const double *x, double reach, double *way)
{
    double foot[3], h;
    if (s->dim == 2) {
        h = walls_distance(s->walls, x, reach);
        if (fabs(h) >= reach)
            return h;
        walls_nearest(s->walls, x, foot);
    } else {
        int mesh;
        const struct tree_foot t = wall_meshes_nearest(s->walls, x, reach, &mesh);
        if (t.triangle < 0)
            return reach;
        h = t.rim ? fabs(t.distance) : t.distance;
        memcpy(foot, t.foot, sizeof foot);
    }
    for (int a = 0; a < s->dim; a++)
        way[a] = foot[a] - x[a];
    return h;
}

/* Share of the way d from x at which it meets a segment, 1: it does not. */
static double meet_segment(const struct segment *g, const double *x, const double *d)
{
    const double r[2] = {g->a[0] - x[0], g->a[1] - x[1]};
    const double across = d[0] * g->n[0] + d[1] * g->n[1];
    const double share = (r[0] * g->n[0] + r[1] * g->n[1]) / across;
    if (!(share > 0.0 && share < 1.0))
        return 1.0;
    const double along = (share * d[0] - r[0]) * g->t[0] + (share * d[1] - r[1]) * g->t[1];
    return along >= 0.0 && along <= g->length ? share : 1.0;
}

double walls_meet(const struct sph *s, const double *x, const double *d)
{
    const struct walls *w = s->walls;
    double first = 1.0, to[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < w->nsegments && s->dim == 2; k++)
        first = fmin(first, meet_segment(w->segments + k, x, d));
    for (int a = 0; a < s->dim; a++)
        to[a] = x[a] + d[a];
    for (int k = 0; k < w->nmeshes && s->dim == 3; k++) {
        double a[3], b[3], where;
        wall_mesh_to_own(w->meshes + k, x, a);
        wall_mesh_to_own(w->meshes + k, to, b);
        if (tree_crosses(w->meshes[k].tree, a, b, &where))
            first = fmin(first, where);
    }
    return first;
}

/* Whether x, in the plane, is inside of the outline of a body where it is now. */
static bool in_outline(const struct body *b, const double *x)
{
    const int n = body_corners(b);
    double(*at)[2] = mem_new((size_t)n, sizeof *at);
    for (int k = 0; k < n; k++) {
        double corner[3];
        body_corner(b, k, corner);
        memcpy(at[k], corner, sizeof at[k]);
    }
    const bool in = line_inside(&(struct line){n, (const double(*)[2])at, true}, x);
    mem_free(at);
    return in;
}

bool walls_in_body(const struct sph *s, const double *x)
{
    const struct walls *w = s->walls;
    double near[3], middle[3];
    bool in = false;
    for (int k = 0; k < w->nbodies && s->dim == 2 && !in; k++) {
        const struct body *b = w->bodies + k;
        body_place(b, b->middle, middle);
        for (int a = 0; a < s->dim; a++)
            near[a] = s->periodic[a] ? middle[a] + remainder(x[a] - middle[a], s->hi[a] - s->lo[a])
                                     : x[a];
        in = !b->is->tank && in_outline(b, near);
    }
    for (int k = 0; k < w->nmeshes && s->dim == 3 && !in; k++) {
        const struct wall_mesh *m = w->meshes + k;
        if (m->thin || !m->of || m->of->owner != MESH_OF_BODY)
            continue;
        wall_mesh_to_own(m, x, near);
        in = tree_nearest(m->tree, near, INFINITY).distance < 0.0;
    }
    return in;
}

/* The velocity relative to the wall that led behind it is taken as one impulse, reported as a hit
 * on the wall's owner, so that the momentum balance holds. Guards carry no momentum of the flow,
 * and none that is back tells of water behind a wall: they are not counted. */
void walls_put_before(struct sph *s, int i, const struct wall_foot *f)
{
    const int dim = s->dim;
    double *y = state_row(&s->p, s->p.y, i), un = 0.0, impulse[3];
    const double m = y[at_mass(dim)];
    for (int a = 0; a < dim; a++)
        un += (y[dim + a] / m - f->u[a]) * f->n[a];
    for (int a = 0; a < dim; a++) {
        y[a] = f->x[a] - 0.05 * s->dx * f->n[a];
        impulse[a] = m * fmax(un, 0.0) * f->n[a];
        y[dim + a] -= impulse[a];
    }
    if (particles_is_guard(&s->p, i))
        return;
    forces_hit(s, f->body, f->x, impulse);
    s->walls->returned++;
}

/* Whether the nearest wall ends openly within 2 dx of its point nearest to x: through a line
 * particles come less than dx, so this one has come round it. */
static bool is_round_end(const struct sph *s, const double *x)
{
    double foot[2];
    if (s->dim == 3)
        return false;
    const struct segment *g = s->walls->segments + walls_nearest(s->walls, x, foot);
    return (g->open[0] && hypot(foot[0] - g->a[0], foot[1] - g->a[1]) < 2.0 * s->dx) ||
           (g->open[1] && hypot(foot[0] - g->b[0], foot[1] - g->b[1]) < 2.0 * s->dx);
}

bool walls_put_back(struct sph *s, int i)
{
    const double *y = state_row(&s->p, s->p.y, i);
    const struct wall_foot f = foot_of(s, y);
    const double away2 = vec_distance2(s->dim, y, f.x);
    if (away2 > s->dx * s->dx || is_round_end(s, y)) {
        for (int a = 0; s->walls->gone == 0 && a < s->dim; a++)
            s->walls->gone_at[a] = y[a];
        s->walls->gone++;
        return false;
    }
    walls_put_before(s, i, &f);
    return true;
}

/* The model first, which knows from which side particles came; then the planes of mirrored ghosts,
 * as far as dx behind them. */
void walls_put_back_inside(struct sph *s)
{
    const int dim = s->dim;
    if (s->walls->model->back)
        s->walls->model->back(s);
    for (int k = 0; k < s->walls->nplanes; k++) {
        const struct wall_plane *p = s->walls->planes + k;
        for (int i = 0; i < s->p.n; i++) {
            double *y = state_row(&s->p, s->p.y, i);
            const double out = p->sign * (y[p->axis] - p->at);
            if (!(out > 0.0) || out > s->dx)
                continue;
            double impulse[3] = {0.0, 0.0, 0.0};
            impulse[p->axis] = p->sign * fmax(p->sign * y[dim + p->axis], 0.0);
            y[p->axis] = p->at - 0.05 * s->dx * p->sign;
            y[dim + p->axis] -= impulse[p->axis];
            if (particles_is_guard(&s->p, i))
                continue;
            forces_hit(s, -1, y, impulse);
            s->walls->returned++;
        }
    }
}

double *walls_rooms(struct sph *s)
{
    double *room = NEW(double, s->p.n);
    for (int i = 0; i < s->p.n; i++)
        room[i] = 1.0;
    if (s->walls && s->walls->model->rooms)
        s->walls->model->rooms(s, room);
    return room;
}

/* A share of everybody's mass, the same on all ranks: mass and momentum are conserved over all
 * ranks, and velocities do not change. */
double walls_keep_mass(struct sph *s, double made, int n, const int *who)
{
    double sums[2] = {made, 0.0};
    for (int k = 0; k < n; k++)
        if (particles_keeps_mass(&s->p, who ? who[k] : k))
            sums[1] += state_row(&s->p, s->p.y, who ? who[k] : k)[at_mass(s->dim)];
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, s->run->comm);
    const double share = sums[1] > 0.0 ? sums[0] / sums[1] : 0.0;
    for (int k = 0; k < n; k++)
        if (particles_keeps_mass(&s->p, who ? who[k] : k))
            particles_give_back(&s->p, s->p.rate, who ? who[k] : k, share);
    return share;
}

void walls_keep_mass_of_all(struct sph *s)
{
    double made = 0.0;
    for (int i = 0; i < s->p.n; i++)
        made += state_row(&s->p, s->p.rate, i)[at_mass(s->dim)];
    walls_keep_mass(s, made, s->p.n, NULL);
}

/* The end of a part of a wall, which is the wall's own if it is that near. */
static void part_end(const struct segment *g, double at, double near, double *x)
{
    for (int a = 0; a < 2; a++)
        x[a] = at < near ? g->a[a] : at > g->length - near ? g->b[a] : g->a[a] + at * g->t[a];
}

/* Of walls at rest, what others cover. */
static void leave_out_covered(const struct sph *s, struct walls *w)
{
    const double near = 0.1 * s->prm.dx;
    const int n = w->nsegments;
    struct segment *const old = w->segments;
    double(*ends)[2][2] = mem_new((size_t)n, sizeof *ends), length = 0.0;
    for (int k = 0; k < n; k++) {
        memcpy(ends[k][0], old[k].a, sizeof ends[k][0]);
        memcpy(ends[k][1], old[k].b, sizeof ends[k][1]);
        length += old[k].length;
    }
    struct wall_parts parts = wall_cover(n, (const double(*)[2][2])ends, s->lo, s->hi, near);
    mem_free(ends);
    if (!parts.cut)
        return;
    w->segments = NULL;
    w->nsegments = 0;
    for (int k = 0; k < parts.n; k++) {
        const struct segment *g = old + parts.part[k].wall;
        double a[2], b[2];
        part_end(g, parts.part[k].from, 4.0 * near, a);
        part_end(g, parts.part[k].to, 4.0 * near, b);
        add_segment(w, a, b, g);
        length -= w->segments[w->nsegments - 1].length;
    }
    FREE(old, parts.part);
    if (length > near && s->level == 0)
        log_say("%.3g m of walls lie behind others, where no fluid comes, and are left out",
                length);
}

static void add_bodies(struct sph *s, struct walls *w)
{
    const struct scene *c = &s->run->scene;
    for (int k = 0; k < c->nbodies; k++) {
        struct body *b = w->bodies + w->nbodies++;
        body_create(b, c->bodies + k, scene_body_mesh(c, k), c->domain.dim, s->run->motions);
        if (w->lent && b->free) { /* one body, one state */
            mem_free(b->free);
            b->free = s->coarser->walls->bodies[k].free;
        }
        w->any_free = w->any_free || b->free;
        b->first = w->nsegments;
        const struct segment like = {.body = k, .of = -1, .no_slip = b->is->kind == WALL_NO_SLIP};
        add_polyline(s, w, &b->is->points, true, &like);
        b->n = w->nsegments - b->first;
    }
}

/* Where lines at rest end in the open: on no other segment and no side of the domain. */
static void find_open_ends(const struct sph *s, struct walls *w)
{
    const struct scene_domain *d = &s->run->scene.domain;
    const double near = 0.1 * s->prm.dx;
    for (int k = 0; k < w->nsegments; k++)
        for (int end = 0; end < 2; end++) {
            struct segment *g = w->segments + k;
            const double *x = end ? g->b : g->a;
            bool meets = g->body >= 0;
            double foot[2];
            for (int a = 0; a < 2; a++)
                meets = meets || x[a] < d->min[a] + near || x[a] > d->max[a] - near;
            for (int j = 0; j < w->nsegments && !meets; j++)
                meets = j != k && segment_foot(w->segments + j, x, foot) < near;
            g->open[end] = !meets;
            w->any_open = w->any_open || !meets;
        }
}

bool walls_want_image(const struct sph *s, bool moves, double lo, double hi, int axis, int way)
{
    const double reach = 2.5 * s->R;
    return moves || (way > 0 ? lo < s->lo[axis] + reach : hi > s->hi[axis] - reach);
}

/* Segments from `first' on that lie near a periodic side stand beyond the other one, too; near a
 * corner of two periods images have images. Those of walls at rest are walls of their own. */
static void add_images(const struct sph *s, struct walls *w, int first)
{
    for (int axis = 0; axis < s->dim; axis++) {
        const int n = w->nsegments;
        for (int k = first; k < n && s->periodic[axis]; k++)
            for (int way = -1; way <= 1; way += 2) {
                struct segment g = w->segments[k];
                const bool moves = g.body >= 0 && w->bodies[g.body].moves;
                if (g.beyond || !walls_want_image(s, moves, fmin(g.a[axis], g.b[axis]),
                                                  fmax(g.a[axis], g.b[axis]), axis, way))
                    continue;
                g.of = g.body < 0 ? -1 : g.of < 0 ? k : g.of;
                g.shift[axis] = way * (s->hi[axis] - s->lo[axis]);
                g.a[axis] += g.shift[axis];
                g.b[axis] += g.shift[axis];
                add_segment(w, g.a, g.b, &g);
            }
    }
}

void walls_expect_speed(struct sph *s)
{
    struct walls *w = s->walls;
    for (int k = 0; k < w->nbodies; k++)
        if (w->bodies[k].free)
            body_hold(w->bodies + k, s->t);
    walls_move(s, s->t);
    w->speed = 0.0;
    for (int k = 0; k < w->nbodies; k++)
        w->speed = fmax(w->speed, 1.1 * body_speed(w->bodies + k));
}

/* Bodies and meshes that are not lent. */
static void free_bodies(void *walls)
{
    struct walls *w = walls;
    for (int k = 0; k < w->nbodies; k++) {
        if (w->lent)
            w->bodies[k].free = NULL;
        body_destroy(w->bodies + k);
    }
    wall_meshes_free(w);
}

struct walls *walls_create(struct sph *s)
{
    static const struct wall_model *const models[] = {&wall_nfm, &wall_ghost,
                                                      &wall_fixed}; /* enum sph_walls */
    const struct scene *c = &s->run->scene;
    int any = c->nbodies;
    for (int k = 0; k < c->nwalls; k++)
        any += is_wall(s, c->walls + k);
    if (!any)
        return NULL;
    struct walls *w = NEW(struct walls, 1);
    w->t = NAN;
    w->lent = s->coarser != NULL;
    mem_at_free(w, free_bodies);
    s->walls = w;
    for (int k = 0; k < c->nwalls; k++) {
        const struct scene_wall *is = c->walls + k;
        if (!is_wall(s, is))
            continue;
        const struct segment like = kind_of(is);
        if (is->side != SIDE_NONE)
            add_plane(s, w, is);
        if (is->side != SIDE_NONE && s->dim == 2)
            add_side(s, w, is);
        else if (is->side == SIDE_NONE)
            add_polyline(s, w, &is->points, is->closed, &like);
    }
    if (s->dim == 2) {
        add_images(s, w, 0);
        leave_out_covered(s, w);
    }
    const int first = w->nsegments;
    add_bodies(s, w);
    if (s->dim == 2) {
        find_open_ends(s, w);
        add_images(s, w, first);
    }
    wall_meshes_create(s, w);
    w->start = NEW_IN(w, struct segment, w->nsegments);
    if (w->nsegments > 0)
        memcpy(w->start, w->segments, (size_t)w->nsegments * sizeof *w->start);
    w->model = models[s->prm.walls];
    w->state = mem_own(w, w->model->create(s)); /* of the walls as they are at t = 0 */
    walls_expect_speed(s);
    return w;
}
