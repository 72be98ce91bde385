/* mesh_motion.c - blocks that move rigidly: positions, face vectors, flux of the grid. x(t) =
 * centre + X(t) + Q(t) (x_made - centre), with X and Q from the drive of the block's key; joined
 * blocks share one motion. Each keeps its vertices and centres as made; mesh_motion_place makes
 * those at time t from them, so that errors do not add up. Called at the start and by
 * fv/time/moving.c in every step.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "mesh_motion.h"

#include "../../common/geometry/geometry.h"

/* Back to the place in the block as it was made; mesh_motion_now: forth. */
void mesh_motion_made(const struct mesh_block *b, const double *x, double *to)
{
    struct mesh_motion *v = b->motion;
    double d[3] = {x[0], x[1], x[2]};
    if (v) {
        for (int c = 0; c < 3; c++)
            d[c] -= v->centre[c] + v->now.x[c];
        if (v->turns)
            turn_back3(v->now.Q, d, d);
        vec3_add(d, 1.0, v->centre);
    }
    memcpy(to, d, sizeof d);
}

void mesh_motion_now(const struct mesh_block *b, const double *made, double *to)
{
    struct mesh_motion *v = b->motion;
    double d[3] = {made[0], made[1], made[2]};
    if (v) {
        vec3_add(d, -1.0, v->centre);
        if (v->turns)
            turn3(v->now.Q, d, d);
        for (int c = 0; c < 3; c++)
            d[c] += v->centre[c] + v->now.x[c];
    }
    memcpy(to, d, sizeof d);
}

/* u + omega x (x - centre - X). */
void mesh_motion_velocity(const struct mesh_block *b, const double *x, double *w)
{
    const struct mesh_motion *v = b->motion;
    double d[3];
    w[0] = w[1] = w[2] = 0.0;
    if (!v)
        return;
    for (int c = 0; c < 3; c++)
        d[c] = x[c] - v->centre[c] - v->now.x[c];
    vec3_cross(v->now.omega, d, w);
    vec3_add(w, 1.0, v->now.u);
}

/* --- places --- */

/* Number of vertices, layers behind sides included. */
static int64_t vertices(const struct mesh_block *b)
{
    return (int64_t)b->nv[0] * b->nv[1] * b->nv[2];
}

/* Vertices and centres; every rank does all blocks. */
static void place_block(struct mesh_block *b)
{
    for (int64_t k = 0; k < vertices(b); k++)
        mesh_motion_now(b, b->made->x[k], b->x[k]);
    for (int64_t k = 0; k < mesh_count(b); k++)
        mesh_motion_now(b, b->made->centre[k], b->centre[k]);
}

/* S as made, turned by Q; the flux of the grid's velocity u.S + omega.R is taken in the frame of
 * the block as made, for which u and omega are turned back. */
static void place_faces(struct mesh *m, const struct part *p)
{
    const struct mesh_block *b = m->block + p->block;
    const struct mesh_motion *v = b->motion;
    int i[3];
    double u[3], omega[3];
    turn_back3(((struct mesh_motion *)v)->now.Q, v->now.u, u);
    turn_back3(((struct mesh_motion *)v)->now.Q, v->now.omega, omega);
    PART_ALL (p, i, c)
        for (int a = 0; a < m->dim; a++) {
            const double *S = b->faces + 6 * (m->dim * (c - p->base) + a), *R = S + 3;
            m->grid[a][c] = vec3_dot(u, S) + vec3_dot(omega, R);
            for (int q = 0; q < m->dim && v->turns; q++)
                m->S[a][q][c] = vec3_dot(v->now.Q[q], S);
        }
}

/* Place and velocity at time t. */
static void move_to(const struct mesh *m, struct mesh_motion *v, double t)
{
    const double instant = 1e-9 * fmax(1.0, fabs(t));
    struct body_motion before;
    body_drive_motion(&v->drive, t, &v->now);
    v->t = t;
    if (fabs(t - m->turn) > instant)
        return;
    body_drive_motion(&v->drive, t - 2.0 * instant, &before);
    memcpy(v->now.u, before.u, sizeof before.u);
    memcpy(v->now.du, before.du, sizeof before.du);
    memcpy(v->now.omega, before.omega, sizeof before.omega);
    memcpy(v->now.domega, before.domega, sizeof before.domega);
}

/* Motions first, then positions, then this rank's faces (once metrics exist). */
void mesh_motion_place(struct mesh *m, double t)
{
    for (int k = 0; k < m->nblocks; k++) {
        struct mesh_motion *v = m->block[k].motion;
        if (v && v->block == k)
            move_to(m, v, t);
    }
    for (int k = 0; k < m->nblocks; k++)
        if (m->block[k].motion)
            place_block(m->block + k);
    for (int q = 0; q < m->nparts && m->grid[0]; q++)
        if (m->block[m->part[q].block].motion)
            place_faces(m, m->part + q);
}

/* --- start --- */

/* The block's vertices and centres get a second store, that of the places as made. made shares all
 * other arrays with the block. */
static void keep_made(struct mesh *m, struct mesh_block *b)
{
    struct mesh_block *made = NEW_IN(m, struct mesh_block, 1);
    const size_t nv = (size_t)vertices(b) * sizeof *b->x,
                 n = (size_t)mesh_count(b) * sizeof *b->centre;
    *made = *b;
    b->x = (double(*)[3])NEW_IN(m, double, 3 * vertices(b));
    b->centre = (double(*)[3])NEW_IN(m, double, 3 * mesh_count(b));
    memcpy(b->x, made->x, nv);
    memcpy(b->centre, made->centre, n);
    made->motion = NULL;
    b->made = made;
}

/* Distance of the farthest vertex from the centre, m: the rotation's part of `speed'. */
static void set_reach(struct mesh_motion *v, const struct mesh_block *b, int dim)
{
    for (int64_t k = 0; k < vertices(b); k++)
        v->reach = fmax(v->reach, sqrt(vec_distance2(dim, b->x[k], v->centre)));
}

/* Whether any term of the motion rotates; of a file any number of its columns of angles. */
static bool ever_turns(const struct body_drive *v)
{
    for (int k = 0; k < v->nterms; k++) {
        const struct body_term *t = v->term + k;
        if (t->is->kind != MOTION_FILE && t->is->axis >= AXIS_RX)
            return true;
        for (int i = 0; i < t->n; i++)
            for (int c = v->columns == 4 ? 3 : 4; c < v->columns; c++)
                if (t->rows[(ptrdiff_t)v->columns * i + c] != 0.0)
                    return true;
    }
    return false;
}

/* Faults of the motion's terms are added at the block's key. */
static struct mesh_motion *create_one(const struct run *r, struct faults *f, struct mesh *m, int k)
{
    const struct mesh_block_params *p = m->block[k].prm;
    struct mesh_motion *v = NEW_IN(m, struct mesh_motion, 1);
    const int before = f->n;
    v->block = k;
    memcpy(v->centre, p->centre, sizeof v->centre);
    body_drive_terms(&v->drive, &p->motion, m->dim, r->motions);
    for (int i = 0; i < v->drive.nterms; i++) {
        char text[1400];
        if (body_term_fault(&v->drive, i, r->motions, text, sizeof text))
            mesh_fault(r, f, m->block[k].prm, "motion", "term %d: %s", i + 1, text);
    }
    v->turns = f->n == before && ever_turns(&v->drive);
    m->moves = true;
    return v;
}

/* Blocks joined to one that moves have its motion. Repeats until nothing changes; two motions that
 * meet are a fault. false: such a fault. */
static bool spread(const struct run *r, struct faults *f, struct mesh *m)
{
    bool any = true, good = true;
    while (any && good) {
        any = false;
        for (int k = 0; k < m->nblocks; k++)
            for (int s = 0; s < 2 * m->dim && m->block[k].motion; s++) {
                const int to = m->block[k].join[s].block;
                if (to < 0 || m->block[to].motion == m->block[k].motion)
                    continue;
                if (m->block[to].motion) {
                    mesh_fault(r, f, m->block[to].prm, "motion",
                               "it is joined to block \"%s\", which has a motion, too: one of "
                               "them has it, the other moves with it",
                               m->block[k].prm->name);
                    return false;
                }
                m->block[to].motion = m->block[k].motion;
                any = true;
            }
    }
    return good;
}

/* Sides of a block that moves cannot be openings or lie on the domain. */
static bool check_sides(const struct run *r, struct faults *f, const struct mesh *m, int k)
{
    static const char *const names[] = {"i_min", "i_max", "j_min", "j_max", "k_min", "k_max"};
    const struct mesh_block *b = m->block + k;
    const int before = f->n;
    bool slides = false;
    for (int c = 0; c < 3; c++)
        slides = slides || b->prm->velocity[c] != 0.0;
    for (int s = 0; s < 2 * m->dim; s++)
        if (b->wall[s] || b->side[s] == MESH_PERIODIC || b->side[s] == MESH_INFLOW ||
            b->side[s] == MESH_OUTFLOW || b->side[s] == MESH_EXACT)
            mesh_fault(r, f, m->block[k].prm, names[s],
                       "a side of a block that moves is \"wall\", \"slip\", \"joined\" or "
                       "\"overlap\", within the domain");
    if (slides)
        mesh_fault(r, f, m->block[k].prm, "velocity",
                   "walls of a block that moves have its velocity; turn them by spin");
    if (b->prm->friction > 0.0)
        mesh_fault(r, f, m->block[k].prm, "friction", "bed friction is that of a block at rest");
    return f->n == before;
}

/* made points to the block itself where nothing moves. */
bool mesh_motion_create(const struct run *r, struct faults *f, struct mesh *m, double t)
{
    const int before = f->n;
    for (int k = 0; k < m->nblocks; k++)
        m->block[k].made = m->block + k;
    for (int k = 0; k < m->nblocks; k++)
        if (m->block[k].prm->motion.n > 0)
            m->block[k].motion = create_one(r, f, m, k);
    if (!m->moves)
        return true;
    bool good = spread(r, f, m) && f->n == before;
    for (int k = 0; k < m->nblocks; k++)
        if (m->block[k].motion) {
            good = check_sides(r, f, m, k) && good;
            keep_made(m, m->block + k);
            set_reach(m->block[k].motion, m->block + k, m->dim);
        }
    for (int k = 0; k < m->nblocks && good; k++) {
        struct mesh_motion *v = m->block[k].motion;
        if (v && v->block == k)
            v->speed = body_drive_speed(&v->drive, v->turns ? v->reach : 0.0, r->scene.time.end);
    }
    if (good)
        mesh_motion_place(m, t);
    return good;
}

/* faces: [cell][axis] S[3], R[3] as made, of one part. */
static void keep_faces(struct mesh *m, const struct part *p)
{
    struct mesh_block *b = m->block + p->block;
    int i[3];
    b->faces = NEW_IN(m, double, 6 * m->dim * p->size);
    PART_ALL (p, i, c)
        for (int a = 0; a < m->dim; a++) {
            const int at[3] = {p->lo[0] + i[0], p->lo[1] + i[1], p->lo[2] + i[2]};
            double *S = b->faces + 6 * (m->dim * (c - p->base) + a);
            for (int q = 0; q < m->dim; q++)
                S[q] = m->S[a][q][c];
            mesh_face_moment(b->made, m->dim, at, a, b->motion->centre, S + 3);
        }
}

/* Parts that turn are treated as curved from then on. */
void mesh_motion_metrics(struct mesh *m)
{
    if (!m->moves)
        return;
    for (int a = 0; a < m->dim; a++)
        m->grid[a] = mem_own(m, mesh_field(m));
    for (int q = 0; q < m->nparts; q++) {
        struct part *p = m->part + q;
        const struct mesh_motion *v = m->block[p->block].motion;
        if (!v)
            continue;
        keep_faces(m, p);
        if (v->turns)
            p->kind = PART_CURVED;
        place_faces(m, p);
    }
}
