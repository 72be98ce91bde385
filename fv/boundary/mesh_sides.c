/* mesh_sides.c - the physical sides of blocks: where they are, what velocity is given there and
 * what the next projection takes off it. Velocities are averages over Gauss points of the faces.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "mesh_sides.h"

#include "carried.h"
#include "levels.h"

/* Whether the projection takes tau grad psi off its velocity. */
static bool slips(enum mesh_side k) { return side_gives_flux(k) && k != MESH_SLIP; }

/* Sets grad_xi at a place: gradients of the tangential indices at the centre of the face, cofactors
 * over J. */
static void set_slopes(const struct fv *s, const struct side *d, int i, int j, int64_t to)
{
    int at[3];
    double xi[3] = {0.5, 0.5, 0.5}, x[3], dx[3][3];
    at[d->a] = d->p->lo[d->a] + d->first;
    at[d->t[0]] = d->p->lo[d->t[0]] + i;
    at[d->t[1]] = d->p->lo[d->t[1]] + j;
    xi[d->a] = d->k % 2;
    mesh_map_point(s->m->block + d->p->block, s->m->dim, at, xi, x, dx);
    const double J = mesh_determinant(dx);
    for (int n = 0; n < 2 && d->t[n] < s->m->dim; n++)
        for (int e = 0; e < s->m->dim; e++) {
            const int p = (d->t[n] + 1) % 3, q = (d->t[n] + 2) % 3, v = (e + 1) % 3,
                      w = (e + 2) % 3;
            d->grad_xi[n][e][to] = (dx[p][v] * dx[q][w] - dx[p][w] * dx[q][v]) / J;
        }
}

/* For all places of a side; again after a block has turned. */
static void turn_slopes(const struct fv *s, const struct side *d)
{
    SIDE_PLACES (d, 1, i, j, at, c) {
        set_slopes(s, d, i, j, at);
        (void)c;
    }
}

/* Unit normal of the face beside cell c; 0 beyond corners, where there is none. */
static void normal_at(const struct mesh *m, const struct side *d, int64_t c, double n[3])
{
    for (int q = 0; q < 3; q++)
        n[q] = q < m->dim ? m->S[d->a][q][c + d->face] : 0.0;
    const double size = vec3_length(n);
    for (int q = 0; q < 3 && size > 0.0; q++)
        n[q] /= size;
}

/* Change of the normal along tangent k, by an index: the lesser one of those on either side, for
 * water does not follow a kink, nor does a wall go on beyond its end. */
static void bend_at(const struct mesh *m, const struct side *d, int k, int64_t c, double bend[3])
{
    const int64_t step = d->p->stride[d->t[k]];
    double low[3], here[3], high[3];
    normal_at(m, d, c - step, low);
    normal_at(m, d, c, here);
    normal_at(m, d, c + step, high);
    for (int q = 0; q < 3; q++) {
        low[q] = here[q] - low[q];
        high[q] -= here[q];
    }
    memcpy(bend, vec3_length(low) < vec3_length(high) ? low : high, sizeof low);
}

/* What is below 1e-6 is rounding. */
static bool bends(const struct fv *s, const struct side *d)
{
    double bend[3], most = 0.0;
    SIDE_PLACES (d, 0, i, j, at, c) {
        for (int k = 0; k < 2 && d->t[k] < s->m->dim; k++) {
            bend_at(s->m, d, k, c, bend);
            most = fmax(most, vec3_length(bend));
        }
        (void)at;
    }
    return most > 1e-6;
}

/* Places of an opening. h is the cell's height across the face, V/S by the metric. */
static struct outflow *list_places(struct fv *s, const struct side *d, struct outflow **list,
                                   int *count)
{
    const struct mesh *m = s->m;
    const int64_t n = d->width * (d->n[1] + 2 * d->g[1]);
    struct outflow *o =
        carried_add(s, list, count, m->dim, m->block[d->p->block].on[d->k], d->a, d->in, n, n);
    SIDE_PLACES (d, 1, i, j, at, c) {
        const bool inside = i >= 0 && i < d->n[0] && j >= 0 && j < d->n[1];
        double S2 = 0.0;
        for (int q = 0; q < m->dim; q++) {
            o->S[q][o->n] = (d->k % 2 ? 1.0 : -1.0) * m->S[d->a][q][c + d->face];
            S2 += o->S[q][o->n] * o->S[q][o->n];
        }
        o->place[o->n] = at;
        o->cell[o->n] = c;
        o->h[o->n] = sqrt(S2) / m->G[d->a][d->a][c + d->face]; /* infinite far beyond corners */
        o->own[o->n++] = inside && m->status[c] == CELL_COMPUTED;
    }
    return o;
}

/* Velocities are the side's own, shared with it. */
static void add_outflow(struct fv *s, const struct side *d)
{
    struct outflow *o = list_places(s, d, &s->outflows->of, &s->outflows->n);
    o->kind = carried_kind(s->m->block[d->p->block].wall[d->k]);
    for (int q = 0; q < s->m->dim; q++)
        o->w[q] = d->w[q];
}

/* Only if this part touches the block's side k; arrays cover ghosts of the tangents. */
static void add_side(struct fv *s, struct mesh_bc *bc, const struct part *p, int k)
{
    const struct mesh_block *b = s->m->block + p->block;
    const int a = k / 2;
    if (!side_is_end(b->side[k]) || (k % 2 ? p->lo[a] + p->n[a] < b->n[a] : p->lo[a] > 0))
        return;
    struct side *d = bc->side + bc->n++;
    *d = (struct side){.p = p, .a = a, .k = k, .kind = b->side[k], .moves = b->motion};
    d->body = b->wall[k] ? d->kind == MESH_WALL : mesh_side_is_body(s->run, b->prm, k);
    for (int t = 0, n = 0; t < 3; t++)
        if (t != a) {
            d->t[n] = t;
            d->g[n] = p->g[t];
            d->n[n++] = p->n[t];
        }
    if (b->wall[k] && d->kind == MESH_OUTFLOW)
        d->pressure = b->wall[k]->pressure / s->run->scene.fluid.rho;
    d->width = d->n[0] + 2 * d->g[0];
    d->first = k % 2 ? p->n[a] - 1 : 0;
    d->in = k % 2 ? -p->stride[a] : p->stride[a];
    d->face = k % 2 ? p->stride[a] : 0;
    for (int c = 0; c < s->m->dim; c++) {
        double **const all[] = {&d->w[c], &d->w_old[c], &d->slip[c], &d->grad_xi[0][c],
                                &d->grad_xi[1][c]};
        for (int q = 0; q < 5; q++)
            *all[q] = NEW_IN(s->sides, double, d->width *(d->n[1] + 2 * d->g[1]));
    }
    turn_slopes(s, d);
    d->bends = bends(s, d);
    if (d->kind == MESH_CARRIED)
        add_outflow(s, d);
    if (d->kind == MESH_OUTFLOW && s->levels)
        list_places(s, d, &s->levels->of, &s->levels->n);
}

/* Axis that is filled at this turn: the one with the fastest sliding wall comes last, whose ghosts
 * then go on through the corners (set_turns in bc.c). */
static int axis_of_turn(const struct mesh *m, int part, int turn)
{
    const struct mesh_block *b = m->block + m->part[part].block;
    int last = b->prm->lid > 0 ? (b->prm->lid - 1) / 2 : m->dim - 1;
    double fastest = 0.0;
    for (int k = 0; k < 2 * m->dim; k++) {
        const double *v = b->wall[k] && b->side[k] == MESH_WALL ? b->wall[k]->velocity : NULL;
        if (v && hypot(hypot(v[0], v[1]), v[2]) > fastest) {
            fastest = hypot(hypot(v[0], v[1]), v[2]);
            last = k / 2;
        }
    }
    if (turn == m->dim - 1)
        return last;
    return turn < last ? turn : turn + 1;
}

/* Who has the ghost behind the wall at a place beyond the side; false: the wall ends there. outside
 * counts directions in which the resolved cell still lies beyond a block: one is a wall, more are a
 * corner. */
static bool find_wall(const struct mesh *m, const struct side *d, int i, int j,
                      struct mesh_request *r)
{
    int at[3], k = d->p->block, outside = 0;
    double move[3];
    at[d->a] = d->p->lo[d->a] + d->first + (d->k % 2 ? 1 : -1);
    at[d->t[0]] = d->p->lo[d->t[0]] + i;
    at[d->t[1]] = d->p->lo[d->t[1]] + j;
    if (mesh_resolve(m, &k, at, move))
        return false;
    const struct mesh_block *b = m->block + k;
    for (int a = 0; a < m->dim; a++)
        if (at[a] < 0 || at[a] >= b->n[a])
            outside +=
                (at[a] == -1 || at[a] == b->n[a]) && slips(b->side[2 * a + (at[a] > 0)]) ? 1 : 2;
    if (outside == 1)
        mesh_owner(m, k, at, &r->rank, &r->out);
    return outside == 1;
}

/* For every side that slips, all places beyond its real faces; then one exchange. Collective. */
static void find_beyond(struct mesh *m, struct mesh_bc *bc)
{
    struct mesh_request *request = NULL, one = {0};
    for (int k = 0; k < bc->n; k++) {
        const struct side *d = bc->side + k;
        if (!slips(d->kind))
            continue;
        const int64_t around = d->width * (d->n[1] + 2 * d->g[1]) - (int64_t)d->n[0] * d->n[1];
        const size_t most = (size_t)(bc->nbeyond + around);
        GROW(request, bc->nbeyond, most);
        GROW_IN(bc, bc->beyond, bc->nbeyond, most);
        SIDE_PLACES (d, 1, i, j, at, c) {
            one.in = c - d->in;
            if ((i >= 0 && i < d->n[0] && j >= 0 && j < d->n[1]) || !find_wall(m, d, i, j, &one))
                continue;
            bc->beyond[bc->nbeyond] = (struct beyond){.side = k, .at = at, .ghost = one.in};
            request[bc->nbeyond++] = one;
        }
    }
    mesh_exchange_create(bc, m, &bc->walls, 1, bc->nbeyond, request);
    mem_free(request);
}

/* pressure_given and slip_anywhere come from all blocks, so that all ranks agree. */
void mesh_bc_create(struct fv *s)
{
    const struct mesh *m = s->m;
    struct mesh_bc *bc = s->sides = NEW_IN(s, struct mesh_bc, 1);
    bc->side = NEW_IN(bc, struct side, 6 * m->nparts);
    carried_create(s);
    levels_create(s);
    for (int k = 0; k < m->nblocks; k++)
        for (int q = 0; q < 2 * m->dim; q++)
            s->m->block[k].side[q] = carried_side(s, m->block[k].wall[q], m->block[k].side[q]);
    for (int turn = 0; turn < m->dim;
         turn++) /* axis by axis: corners take the values of the first */
        for (int q = 0; q < m->nparts; q++)
            for (int up = 0; up < 2; up++)
                add_side(s, bc, m->part + q, 2 * axis_of_turn(m, q, turn) + up);
    bool slip_anywhere = false;
    for (int k = 0; k < m->nblocks; k++)
        for (int q = 0; q < 2 * m->dim; q++) {
            bc->pressure_given = bc->pressure_given || m->block[k].side[q] == MESH_OUTFLOW;
            slip_anywhere = slip_anywhere || slips(m->block[k].side[q]);
        }
    if (slip_anywhere)
        find_beyond(s->m, bc);
    mesh_bc_time(s, s->t);
}

bool mesh_bc_pressure_given(const struct fv *s) { return s->sides->pressure_given; }

bool mesh_bc_has_walls(const struct mesh *m)
{
    for (int k = 0; k < m->nblocks; k++)
        for (int q = 0; q < 2 * m->dim; q++)
            if (side_is_wall(m->block[k].side[q]))
                return true;
    return false;
}

/* Velocity wanted at x, m/s. */
static void value_at(const struct fv *s, const struct side *d, const double *x, double t, double *w)
{
    if (d->kind == MESH_EXACT)
        mesh_exact_at(s, x, t, w, NULL, NULL);
    else
        mesh_side_velocity(s->run, s->m->block + d->p->block, d->k, x, w);
}

/* Gauss points of the face at a place. Returns their number, 2 or 4. */
static int face_points(const struct fv *s, const struct side *d, int i, int j, double x[4][3])
{
    static const double gauss[2] = {0.2113248654051871, 0.7886751345948129};
    const int n = s->m->dim == 3 ? 4 : 2, t0 = d->t[0], t1 = d->t[1];
    int at[3];
    at[d->a] = d->p->lo[d->a] + d->first;
    at[t0] = d->p->lo[t0] + i;
    at[t1] = d->p->lo[t1] + j;
    for (int g = 0; g < n; g++) {
        double xi[3] = {0.0, 0.0, 0.0}, dx[3][3];
        xi[d->a] = d->k % 2;
        xi[t0] = gauss[g & 1];
        xi[t1] = n == 4 ? gauss[g >> 1] : 0.0;
        mesh_map_point(s->m->block + d->p->block, s->m->dim, at, xi, x[g], dx);
    }
    return n;
}

/* Sets w at all places to averages over Gauss points at time t; slides where a wall moves other
 * than its block does. */
static void set_values(const struct fv *s, struct side *d, double t)
{
    SIDE_PLACES (d, 1, i, j, m, c) {
        double x[4][3], sum[3] = {0.0, 0.0, 0.0}, own = 0.0, w[3], rigid[3];
        const int n = face_points(s, d, i, j, x);
        for (int g = 0; g < n; g++) {
            value_at(s, d, x[g], t, w);
            mesh_motion_velocity(s->m->block + d->p->block, x[g], rigid);
            for (int q = 0; q < 3; q++) {
                sum[q] += w[q] / n;
                own = fmax(own, fabs(w[q] - rigid[q]) - 1e-12 * fabs(rigid[q]));
            }
        }
        for (int q = 0; q < s->m->dim; q++) {
            d->w[q][m] = sum[q];
            d->slides = d->slides || (d->kind == MESH_WALL && own > 0.0);
        }
        (void)c;
    }
}

/* w_old are the values before; at the first call they are the same. */
void mesh_bc_time(struct fv *s, double t)
{
    for (int k = 0; k < s->sides->n; k++) {
        struct side *d = s->sides->side + k;
        const size_t bytes = (size_t)(d->width * (d->n[1] + 2 * d->g[1])) * sizeof(double);
        const bool changes = d->moves || (d->kind == MESH_EXACT && !s->prm.ring);
        for (int q = 0; q < s->m->dim; q++)
            memcpy(d->w_old[q], d->w[q], bytes);
        if (changes || !s->sides->set)
            set_values(s, d, t);
        if (d->moves && s->m->block[d->p->block].motion->turns)
            turn_slopes(s, d);
        for (int q = 0; q < s->m->dim && !s->sides->set; q++)
            memcpy(d->w_old[q], d->w[q], bytes);
    }
    s->sides->set = true;
}

void mesh_bc_meet_water(struct fv *s)
{
    for (struct side *d = s->sides->side; d < s->sides->side + s->sides->n; d++)
        SIDE_PLACES (d, 1, i, j, at, c)
            for (int q = 0; q < s->m->dim && d->moves; q++)
                d->w_old[q][at] = s->u[q][c];
}

/* tau times the gradient of psi along the side, of psi on the face, (7 psi_1 - psi_2)/6; c: cell
 * inside. The component across the face is taken out. */
static void slip_at(const struct fv *s, const struct side *d, int64_t at, int64_t c, double tau,
                    const double *psi)
{
    double g[3] = {0.0, 0.0, 0.0}, S[3];
    for (int n = 0; n < 2 && d->t[n] < s->m->dim; n++) {
        double f[5];
        for (int l = 0; l < 5; l++) {
            const double *q = psi + c + (l - 2) * d->p->stride[d->t[n]];
            f[l] = (7.0 * q[0] - q[d->in]) / 6.0;
        }
        const double slope = (8.0 * (f[3] - f[1]) - (f[4] - f[0])) / 12.0;
        for (int e = 0; e < s->m->dim; e++)
            g[e] += slope * d->grad_xi[n][e][at];
    }
    grid_face_vector(&s->grid, c + d->face, d->a, S);
    for (int e = 0; e < s->m->dim; e++)
        d->slip[e][at] = tau * (g[e] - vec3_dot(g, S) / vec3_dot(S, S) * S[e]);
}

/* Beyond a part's side, where stencils along the wall have no more psi, the neighbour's slip, by
 * way of the ghosts behind the wall in s->faces. */
static void take_slip(const struct fv *s)
{
    const struct mesh_bc *bc = s->sides;
    for (int k = 0; k < bc->n; k++) {
        const struct side *d = bc->side + k;
        if (!slips(d->kind))
            continue;
        SIDE_PLACES (d, 0, i, j, at, c) {
            for (int e = 0; e < s->m->dim; e++)
                s->faces[e][c - d->in] = d->slip[e][at];
        }
    }
    mesh_exchange(s->m, &s->sides->walls, s->m->dim, s->faces);
    for (int k = 0; k < bc->nbeyond; k++)
        for (int e = 0; e < s->m->dim; e++)
            bc->side[bc->beyond[k].side].slip[e][bc->beyond[k].at] =
                s->faces[e][bc->beyond[k].ghost];
}

/* m/s^2: of the velocity across a slip wall in the water beside it, whose velocity along it,
 * relative to the wall, is v, for the way that it takes: normal n and velocity w of the wall change
 * by dn and dw along it, so (w + v).n = w.n wants 2 dw.n - v.dn. */
static double turning(const struct fv *s, const struct side *d, int64_t at, int64_t c)
{
    double n[3], v[3] = {0.0, 0.0, 0.0}, sum = 0.0;
    normal_at(s->m, d, c, n);
    for (int q = 0; q < s->m->dim; q++)
        v[q] = 1.5 * s->u[q][c] - 0.5 * s->u[q][c + d->in] - d->w[q][at];
    for (int k = 0; k < 2 && d->t[k] < s->m->dim; k++) {
        const int64_t step = k ? d->width : 1;
        double bend[3], speed = 0.0, change = 0.0; /* speed: indices a second */
        bend_at(s->m, d, k, c, bend);
        for (int q = 0; q < s->m->dim; q++) {
            speed += v[q] * d->grad_xi[k][q][at];
            change += (d->w[q][at + step] - d->w[q][at - step]) * n[q] - v[q] * bend[q];
        }
        sum += speed * change;
    }
    return sum;
}

/* Where a side ends nothing is known of its normals beyond it. */
static void set_turn(const struct fv *s, struct side *d, double tau)
{
    if (!d->turn)
        d->turn = NEW_IN(s->sides, double, d->width *(d->n[1] + 2 * d->g[1]));
    SIDE_PLACES (d, 1, i, j, at, c) {
        const bool inside = i >= -1 && i <= d->n[0] && j >= -1 && j <= d->n[1];
        double S[3] = {0.0, 0.0, 0.0};
        for (int q = 0; q < s->m->dim; q++)
            S[q] = s->m->S[d->a][q][c + d->face];
        d->turn[at] = inside ? tau * vec3_length(S) * turning(s, d, at, c) : 0.0;
    }
}

/* Where a wall ends at one without slip or at an overlap, the stencils reach one place beyond; the
 * slip further on is 0. Collective where any rank has a place beyond. */
void mesh_bc_set_slip(const struct fv *s, double tau, const double *psi)
{
    for (int k = 0; k < s->sides->n; k++) {
        struct side *d = s->sides->side + k;
        if (d->kind == MESH_SLIP && side_accelerates(s, d))
            set_turn(s, d, tau);
        if (!slips(d->kind))
            continue;
        SIDE_PLACES (d, 1, i, j, at, c) {
            if (i >= -1 && i <= d->n[0] && j >= -1 && j <= d->n[1])
                slip_at(s, d, at, c, tau, psi);
            else
                for (int e = 0; e < s->m->dim; e++)
                    d->slip[e][at] = 0.0;
        }
    }
    if (s->sides->walls.npeers > 0)
        take_slip(s);
}
