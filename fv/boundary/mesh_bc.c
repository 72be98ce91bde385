/* mesh_bc.c - physical sides of blocks: ghosts as in bc.c, along the indices across the side.
 * No-slip, inflow, exact: the cubic through the average w on the face and three cells; slip: the
 * normal component mirrored oddly; outflow: evenly, with p/rho = 0 on the face. w is averaged over
 * Gauss points of the face. SPDX-License-Identifier: BSD-3-Clause */
#include "mesh_bc.h"
#include "../fv.h"
#include "../grid/mesh.h"
#include "../grid/mesh_motion.h"

#include <math.h>
#include <string.h>

#include "../../common/mem.h"
#include "still.h"

struct side {
    const struct part *p;
    int a, k; /* axis, side of the block */
    enum mesh_side kind;
    bool slides;          /* a wall that moves along itself */
    int t[2], g[2], n[2]; /* tangents, their ghosts and cells */
    int first;            /* cell along a that touches the side */
    int64_t in;           /* step inwards */
    int64_t face;         /* step from that cell to the face's place */
    int64_t width;
    bool moves;              /* with its block */
    double pressure;         /* m^2/s^2: p/rho of an outflow */
    double *w[3], *w_old[3]; /* m/s: now and before the last change of time */
    double *slip[3];         /* m/s: what the next projection takes off */
    double *grad_xi[2][3];   /* 1/m: of the tangents' indices on the face */
    double *tilt;            /* m: slope outwards, a cell, of a level set; NULL: there is none */
};

struct mesh_bc {
    int n;
    struct side *side;
    bool pressure_given;
    bool set; /* values have been */
};

/* Visits the places of a side with all ghosts of its tangents: m counts them, c: cell inside. */
#define SIDE_PLACES(s, more, i, j, m, c)                                                           \
    for (int j = -(more) * (s)->g[1]; j < (s)->n[1] + (more) * (s)->g[1]; j++)                     \
        for (int i = -(more) * (s)->g[0]; i < (s)->n[0] + (more) * (s)->g[0]; i++)                 \
            for (int64_t m = place(s, i, j), c = cell(s, i, j), once_ = 1; once_; once_ = 0)

static int64_t place(const struct side *s, int i, int j)
{
    return (i + s->g[0]) + s->width * (j + s->g[1]);
}

static int64_t cell(const struct side *s, int i, int j)
{
    int at[3];
    at[s->a] = s->first;
    at[s->t[0]] = i;
    at[s->t[1]] = j;
    return part_at(s->p, at[0], at[1], at[2]);
}

static bool is_physical(enum mesh_side k)
{
    return k != MESH_OVERLAP && k != MESH_JOINED && k != MESH_PERIODIC;
}

/* Gradients of the tangential indices at the centre of the face: cofactors / J. */
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

static void turn_slopes(const struct fv *s, const struct side *d)
{
    SIDE_PLACES(d, 1, i, j, at, c)
    {
        set_slopes(s, d, i, j, at);
        (void)c;
    }
}

static void add_side(struct fv *s, struct mesh_bc *bc, const struct part *p, int k)
{
    const struct mesh_block *b = s->m->block + p->block;
    const int a = k / 2;
    if (!is_physical(b->side[k]) || (k % 2 ? p->lo[a] + p->n[a] < b->n[a] : p->lo[a] > 0))
        return;
    struct side *d = bc->side + bc->n++;
    *d = (struct side){.p = p, .a = a, .k = k, .kind = b->side[k], .moves = b->motion};
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
            *all[q] = NEW(double, d->width *(d->n[1] + 2 * d->g[1]));
    }
    turn_slopes(s, d);
}

/* That of a lid comes last: its ghosts go on through the corners (set_turns in bc.c). */
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

void mesh_bc_create(struct fv *s)
{
    const struct mesh *m = s->m;
    struct mesh_bc *bc = s->sides = NEW(struct mesh_bc, 1);
    bc->side = NEW(struct side, 6 * m->nparts);
    for (int turn = 0; turn < m->dim;
         turn++) /* axis by axis: corners take the values of the first */
        for (int q = 0; q < m->nparts; q++)
            for (int up = 0; up < 2; up++)
                add_side(s, bc, m->part + q, 2 * axis_of_turn(m, q, turn) + up);
    for (int k = 0; k < m->nblocks; k++)
        for (int q = 0; q < 2 * m->dim; q++)
            bc->pressure_given = bc->pressure_given || m->block[k].side[q] == MESH_OUTFLOW;
    mesh_bc_time(s, s->t);
}

void mesh_bc_free(struct mesh_bc **b)
{
    for (int k = 0; *b && k < (*b)->n; k++)
        for (int c = 0; c < 3; c++) {
            struct side *d = (*b)->side + k;
            double *const all[] = {d->w[c], d->w_old[c], d->slip[c], d->grad_xi[0][c],
                                   d->grad_xi[1][c]};
            for (int q = 0; q < 5; q++)
                mem_free(all[q]);
            if (c == 0)
                mem_free(d->tilt);
        }
    if (*b)
        mem_free((*b)->side);
    mem_free(*b);
    *b = NULL;
}

bool mesh_bc_pressure_given(const struct fv *s) { return s->sides->pressure_given; }

bool mesh_bc_has_walls(const struct mesh *m)
{
    for (int k = 0; k < m->nblocks; k++)
        for (int q = 0; q < 2 * m->dim; q++)
            if (m->block[k].side[q] == MESH_WALL || m->block[k].side[q] == MESH_SLIP)
                return true;
    return false;
}

static void value_at(const struct fv *s, const struct side *d, const double *x, double t, double *w)
{
    if (d->kind == MESH_EXACT)
        mesh_exact_at(s, x, t, w, NULL, NULL);
    else
        mesh_side_velocity(s->run, s->m->block + d->p->block, d->k, x, w);
}

/* Gauss points of the face at a place. */
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

static void set_values(const struct fv *s, struct side *d, double t)
{
    SIDE_PLACES(d, 1, i, j, m, c)
    {
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

void mesh_bc_time(struct fv *s, double t)
{
    for (int k = 0; k < s->sides->n; k++) {
        struct side *d = s->sides->side + k;
        const size_t bytes = (size_t)(d->width * (d->n[1] + 2 * d->g[1])) * sizeof(double);
        const bool changes = d->moves || (d->kind == MESH_EXACT && s->ring < 0);
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

/* tau times the gradient of psi along the side, of psi on the face, (7 psi_1 - psi_2)/6. */
void mesh_bc_set_slip(const struct fv *s, double tau, const double *psi)
{
    for (int k = 0; k < s->sides->n; k++) {
        const struct side *d = s->sides->side + k;
        if (d->kind == MESH_SLIP || d->kind == MESH_OUTFLOW)
            continue;
        SIDE_PLACES(d, 1, i, j, at, c)
        {
            double g[3] = {0.0, 0.0, 0.0}, gS = 0.0, S2 = 0.0;
            const bool near = i >= -1 && i <= d->n[0] && j >= -1 && j <= d->n[1];
            for (int n = 0; near && n < 2 && d->t[n] < s->m->dim; n++) {
                double f[5];
                for (int l = 0; l < 5; l++) {
                    const double *q = psi + c + (l - 2) * d->p->stride[d->t[n]];
                    f[l] = (7.0 * q[0] - q[d->in]) / 6.0;
                }
                const double slope = (8.0 * (f[3] - f[1]) - (f[4] - f[0])) / 12.0;
                for (int e = 0; e < s->m->dim; e++)
                    g[e] += slope * d->grad_xi[n][e][at];
            }
            for (int e = 0; e < s->m->dim; e++) {
                const double S = s->m->S[d->a][e][c + d->face];
                gS += g[e] * S;
                S2 += S * S;
            }
            for (int e = 0; e < s->m->dim; e++)
                d->slip[e][at] =
                    near ? tau * (g[e] - gS / S2 * s->m->S[d->a][e][c + d->face]) : 0.0;
        }
    }
}

static void given(double *q, int64_t in, double w)
{
    q[-in] = 4.0 * w - (13.0 * q[0] - 5.0 * q[in] + q[2 * in]) / 3.0;
    q[-2 * in] = 16.0 * w - (70.0 * q[0] - 32.0 * q[in] + 7.0 * q[2 * in]) / 3.0;
    q[-3 * in] = q[-2 * in];
}

static void mirrored(double *q, int64_t in, double sign)
{
    for (int m = 0; m < MESH_GHOSTS; m++)
        q[-(m + 1) * in] = sign * q[m * in];
}

/* wS: flux that the wall itself makes. */
static void slip(const struct mesh *m, const struct side *d, int64_t c, double wS,
                 double *const u[3])
{
    double S2 = 0.0;
    for (int q = 0; q < m->dim; q++)
        S2 += m->S[d->a][q][c + d->face] * m->S[d->a][q][c + d->face];
    for (int l = 0; l < MESH_GHOSTS; l++) {
        double un = -wS;
        for (int q = 0; q < m->dim; q++)
            un += u[q][c + l * d->in] * m->S[d->a][q][c + d->face];
        for (int q = 0; q < m->dim; q++)
            u[q][c - (l + 1) * d->in] =
                u[q][c + l * d->in] - 2.0 * un * m->S[d->a][q][c + d->face] / S2;
    }
}

static double wanted(const struct side *d, int q, int64_t at, enum bc_value what)
{
    switch (what) {
    case BC_GIVEN:
        return d->w[q][at];
    case BC_AHEAD:
        return d->w[q][at] + d->slip[q][at];
    case BC_CHANGE:
        return d->w[q][at] + d->slip[q][at] - d->w_old[q][at];
    case BC_ZERO:
        break;
    }
    return 0.0;
}

/* Of a slip wall that moves. */
static double flux_wanted(const struct mesh *m, const struct side *d, int64_t at, int64_t c,
                          enum bc_value what)
{
    double sum = 0.0;
    for (int q = 0; q < m->dim && what != BC_ZERO; q++)
        sum += (d->w[q][at] - (what == BC_CHANGE ? d->w_old[q][at] : 0.0)) *
               m->S[d->a][q][c + d->face];
    return sum;
}

void mesh_bc_velocity(const struct fv *s, enum bc_value what, double *const u[3])
{
    const struct mesh *m = s->m;
    for (int k = 0; k < s->sides->n; k++) {
        const struct side *d = s->sides->side + k;
        SIDE_PLACES(d, 1, i, j, at, c)
        {
            if (d->kind == MESH_SLIP)
                slip(m, d, c, d->moves ? flux_wanted(m, d, at, c, what) : 0.0, u);
            else
                for (int q = 0; q < m->dim; q++) {
                    if (d->kind == MESH_OUTFLOW)
                        mirrored(u[q] + c, d->in, 1.0);
                    else
                        given(u[q] + c, d->in, wanted(d, q, at, what));
                }
        }
    }
}

void mesh_bc_even(const struct fv *s, bool odd, double *q)
{
    for (int k = 0; k < s->sides->n; k++) {
        const struct side *d = s->sides->side + k;
        SIDE_PLACES(d, 1, i, j, at, c)
        {
            mirrored(q + c, d->in, odd && d->kind == MESH_OUTFLOW ? -1.0 : 1.0);
            (void)at;
        }
    }
}

/* Whether a level surface meets the face at a slant. */
static bool is_slanting(const struct fv *s, const struct side *d, int64_t c)
{
    const double *g = s->run->scene.fluid.gravity;
    double gS = 0.0, S2 = 0.0, g2 = 0.0;
    for (int q = 0; q < s->m->dim; q++) {
        const double S = s->m->S[d->a][q][c + d->face];
        gS += g[q] * S;
        S2 += S * S;
        g2 += g[q] * g[q];
    }
    const double cosine2 = gS * gS / (S2 * g2);
    return cosine2 > 1e-8 && cosine2 < 1.0 - 1e-8;
}

void mesh_bc_level(const struct fv *s, bool keep, double *phi)
{
    for (int k = 0; k < s->sides->n; k++) {
        struct side *d = s->sides->side + k;
        if (!d->tilt)
            d->tilt = NEW(double, d->width *(d->n[1] + 2 * d->g[1]));
        SIDE_PLACES(d, 1, i, j, at, c)
        {
            double *q = phi + c;
            if (!keep)
                d->tilt[at] = is_slanting(s, d, c) ? q[0] - q[d->in] : 0.0;
            for (int m = 1; m <= MESH_GHOSTS; m++)
                q[-m * d->in] = q[(m - 1) * d->in] + (2 * m - 1) * d->tilt[at];
        }
    }
}

static void extended(double *q, int64_t in)
{
    for (int l = 1; l <= MESH_GHOSTS; l++)
        q[-l * in] = 3.0 * (q[(1 - l) * in] - q[(2 - l) * in]) + q[(3 - l) * in];
}

void mesh_bc_extend(const struct fv *s, double *q)
{
    for (int k = 0; k < s->sides->n; k++) {
        const struct side *d = s->sides->side + k;
        SIDE_PLACES(d, 1, i, j, at, c)
        {
            extended(q + c, d->in);
            (void)at;
        }
    }
}

void mesh_bc_pressure(const struct fv *s, double *p)
{
    for (int k = 0; k < s->sides->n; k++) {
        const struct side *d = s->sides->side + k;
        SIDE_PLACES(d, 1, i, j, at, c)
        {
            if (d->kind == MESH_OUTFLOW)
                given(p + c, d->in, d->pressure);
            else
                extended(p + c, d->in);
            (void)at;
        }
    }
}

void mesh_bc_fluxes(const struct fv *s, double *const U[3])
{
    for (int k = 0; k < s->sides->n; k++) {
        const struct side *d = s->sides->side + k;
        if (d->kind != MESH_WALL && d->kind != MESH_SLIP)
            continue;
        SIDE_PLACES(d, 1, i, j, at, c)
        {
            U[d->a][c + d->face] = d->moves ? s->m->grid[d->a][c + d->face] : 0.0;
            (void)at;
        }
    }
}

void mesh_bc_beside_walls(const struct fv *s, const struct part *p, int a, double *f)
{
    for (int k = 0; k < s->sides->n; k++) {
        const struct side *d = s->sides->side + k;
        if (d->p != p || d->a == a || !d->slides)
            continue;
        for (int j = 0; j < d->n[1] + (d->t[1] == a); j++)
            for (int i = 0; i < d->n[0] + (d->t[0] == a); i++) {
                double *q = f + cell(d, i, j);
                q[-d->in] = 4.0 * (q[0] + q[2 * d->in]) - 6.0 * q[d->in] - q[3 * d->in];
            }
    }
}

double mesh_bc_rate(const struct fv *s, double *speed)
{
    const struct mesh *m = s->m;
    double rate = 0.0;
    for (int k = 0; k < s->sides->n; k++) {
        const struct side *d = s->sides->side + k;
        SIDE_PLACES(d, 0, i, j, at, c)
        {
            double w2 = 0.0, sum = 0.0;
            for (int a = 0; a < m->dim; a++) {
                const int64_t f = c + (a == d->a ? d->face : 0);
                double wS = d->moves ? -m->grid[a][f] : 0.0;
                for (int q = 0; q < m->dim; q++)
                    wS += d->w[q][at] * m->S[a][q][f];
                sum += fabs(wS);
                w2 += d->w[a][at] * d->w[a][at];
            }
            rate = fmax(rate, sum / m->V[c]);
            *speed = fmax(*speed, sqrt(w2));
        }
    }
    return rate;
}

/* Slopes across and along the face of a field with ghosts, at the place of the face. */
static void face_slopes(const struct mesh *m, const struct side *d, int64_t f, const double *u,
                        double *slope)
{
    const int64_t a = d->p->stride[d->a];
    slope[d->a] = (15.0 * (u[f] - u[f - a]) - (u[f + a] - u[f - 2 * a])) / 12.0;
    for (int n = 0; n < 2 && d->t[n] < m->dim; n++) {
        double v[5];
        const int64_t b = d->p->stride[d->t[n]];
        for (int l = -2; l <= 2; l++) {
            const double *q = u + f + l * b;
            v[l + 2] = (7.0 * (q[-a] + q[0]) - (q[-2 * a] + q[a])) / 12.0;
        }
        slope[d->t[n]] = (8.0 * (v[3] - v[1]) - (v[4] - v[0])) / 12.0;
    }
}

/* Place, pressure (Pa) and velocity gradient on one face. */
static void face_state(const struct fv *s, const struct side *d, int64_t c, int i, int j,
                       double x[3], double *pressure, double g[3][3])
{
    const struct mesh *m = s->m;
    const int64_t f = c + d->face, a = d->p->stride[d->a];
    double dx[3][3], xi[3] = {0.5, 0.5, 0.5}, slope[3][3] = {{0.0}};
    int at[3];
    at[d->a] = d->p->lo[d->a] + d->first;
    at[d->t[0]] = d->p->lo[d->t[0]] + i;
    at[d->t[1]] = d->p->lo[d->t[1]] + j;
    xi[d->a] = d->k % 2;
    mesh_map_point(m->block + d->p->block, m->dim, at, xi, x, dx);
    const double J = mesh_determinant(dx);
    for (int q = 0; q < m->dim; q++)
        face_slopes(m, d, f, s->u[q], slope[q]);
    for (int k = 0; k < m->dim; k++) /* grad xi_k = cofactors / J */
        for (int e = 0; e < m->dim; e++) {
            const int p = (k + 1) % 3, q = (k + 2) % 3, v = (e + 1) % 3, w = (e + 2) % 3;
            const double dxi = (dx[p][v] * dx[q][w] - dx[p][w] * dx[q][v]) / J;
            for (int r = 0; r < m->dim; r++)
                g[r][e] += slope[r][k] * dxi;
        }
    double p[4];
    for (int l = 0; l < 4; l++)
        p[l] = fv_pressure(s, f + (l - 2) * a);
    *pressure = (7.0 * (p[1] + p[2]) - (p[0] + p[3])) / 12.0;
}

/* Average of the pressure over the face at f, Pa. */
static double face_pressure(const struct fv *s, int64_t f, int64_t a)
{
    return (7.0 * (fv_pressure(s, f - a) + fv_pressure(s, f)) -
            (fv_pressure(s, f - 2 * a) + fv_pressure(s, f + a))) /
           12.0;
}

/* nu <G_ab dq/dxi_b> of the face at f, as mesh_viscous has it. */
static double viscous_flux(const struct fv *s, const struct side *d, int64_t f, const double *q)
{
    const struct mesh *m = s->m;
    const int a = d->a;
    double slope[3], up[3], down[3], F = 0.0;
    face_slopes(m, d, f, q, slope);
    for (int k = 0; k < m->dim; k++)
        F += m->G[a][k][f] * slope[k];
    for (int n = 0; n < 2 && d->t[n] < m->dim; n++) {
        const int64_t t = d->p->stride[d->t[n]];
        face_slopes(m, d, f + t, q, up);
        face_slopes(m, d, f - t, q, down);
        for (int k = 0; k < m->dim; k++)
            F += (up[k] - down[k]) * (m->G[a][k][f + t] - m->G[a][k][f - t]) / 48.0;
    }
    return s->nu * F;
}

/* -p S + mu (grad u + grad u^T) S on one face, outwards of the fluid. p S and grad u S are the
 * fluxes of the momentum equation. Of grad u^T S the slopes across the wall are 0 by continuity;
 * those along it remain where it turns. */
static void face_force(const struct fv *s, const struct side *d, int64_t c, int i, int j,
                       double *force)
{
    const struct mesh *m = s->m;
    const double rho = s->run->scene.fluid.rho, out = d->k % 2 ? 1.0 : -1.0;
    const int64_t f = c + d->face, a = d->p->stride[d->a];
    double x[3], pf, g[3][3] = {{0.0}}, S2 = 0.0;
    face_state(s, d, c, i, j, x, &pf, g);
    pf += still_pressure(&s->run->scene, s->still, s->level, x);
    for (int e = 0; e < m->dim; e++)
        S2 += m->S[d->a][e][f] * m->S[d->a][e][f];
    for (int q = 0; q < m->dim; q++) {
        force[q] = rho * viscous_flux(s, d, f, s->u[q]) - pf * m->S[d->a][q][f];
        for (int n = 0; n < 2 && d->t[n] < m->dim; n++) {
            const int64_t t = d->p->stride[d->t[n]];
            force[q] -= (face_pressure(s, f + t, a) - face_pressure(s, f - t, a)) *
                        (m->S[d->a][q][f + t] - m->S[d->a][q][f - t]) / 48.0;
        }
        for (int e = 0; e < m->dim; e++) {
            double across = 0.0;
            for (int r = 0; r < m->dim; r++)
                across += g[e][r] * m->S[d->a][r][f];
            force[q] += rho * s->nu * (g[e][q] - across * m->S[d->a][q][f] / S2) * m->S[d->a][e][f];
        }
        force[q] *= -out; /* on the wall */
    }
    x[2] = 0.0;
    double o[3];
    mesh_motion_now(m->block + d->p->block, m->block[d->p->block].prm->centre, o);
    force[3] = (x[0] - o[0]) * force[1] - (x[1] - o[1]) * force[0];
}

/* Energy and pressure that flow in through one face, and friction on it, over rho. */
static double face_power(const struct fv *s, const struct side *d, int64_t c, int i, int j)
{
    const struct mesh *m = s->m;
    const double out = d->k % 2 ? 1.0 : -1.0;
    const int64_t f = c + d->face, a = d->p->stride[d->a];
    double x[3], pf, g[3][3] = {{0.0}}, square = 0.0, friction = 0.0;
    face_state(s, d, c, i, j, x, &pf, g);
    for (int q = 0; q < m->dim; q++) {
        const double *u = s->u[q] + f;
        const double w = (7.0 * (u[-a] + u[0]) - (u[-2 * a] + u[a])) / 12.0;
        square += w * w;
        for (int e = 0; e < m->dim; e++)
            friction += s->nu * w * g[q][e] * m->S[d->a][e][f];
    }
    return out * (friction - s->U[d->a][f] * (0.5 * square + pf / s->run->scene.fluid.rho));
}

double mesh_bc_power(struct fv *s)
{
    double sum = 0.0;
    double *both[2] = {s->p, s->p_before};
    mesh_fill(s->m, 2, both);
    for (int k = 0; k < 2; k++)
        mesh_bc_pressure(s, both[k]);
    for (int k = 0; k < s->sides->n; k++) {
        const struct side *d = s->sides->side + k;
        if (d->kind == MESH_SLIP)
            continue;
        SIDE_PLACES(d, 0, i, j, at, c)
        {
            sum += s->free[c] > 0.0 ? face_power(s, d, c, i, j) : 0.0;
            (void)at;
        }
    }
    return sum;
}

double mesh_bc_net_flux(const struct fv *s)
{
    double sum = 0.0;
    for (int k = 0; k < s->sides->n; k++) {
        const struct side *d = s->sides->side + k;
        SIDE_PLACES(d, 0, i, j, at, c)
        {
            sum += s->free[c] * (d->k % 2 ? 1.0 : -1.0) * s->U[d->a][c + d->face];
            (void)at;
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, s->m->comm);
    return sum;
}

void mesh_bc_force(struct fv *s, double (*force)[4])
{
    double *both[2] = {s->p, s->p_before};
    memset(force, 0, (size_t)s->m->nblocks * sizeof *force);
    mesh_fill(s->m, 2, both);
    for (int k = 0; k < 2; k++)
        mesh_bc_pressure(s, both[k]);
    for (int k = 0; k < s->sides->n; k++) {
        const struct side *d = s->sides->side + k;
        if (d->kind != MESH_WALL)
            continue;
        SIDE_PLACES(d, 0, i, j, at, c)
        {
            double one[4] = {0.0, 0.0, 0.0, 0.0};
            if (s->free[c] > 0.0)
                face_force(s, d, c, i, j, one);
            for (int q = 0; q < 4; q++)
                force[d->p->block][q] += one[q];
            (void)at;
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, force, 4 * s->m->nblocks, MPI_DOUBLE, MPI_SUM, s->m->comm);
}
