/* blocked_cells.c - corrections of the operators beside boxes that are cut out of uniform cells.
 * The operators run over all cells as if there were no boxes; then the few cells and faces whose
 * stencils reach into one (lists near and beside of blocked.h) are done again here. A stencil's
 * line v[-2 .. 2] is continued behind a box's face by ghosts that follow from the cells before it
 * (blocked_ghost): zero gradient, antisymmetric, no-slip or linear. Cost is proportional to the
 * boxes' surface.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "blocked_cells.h"

#include "../surface/fv_surface.h"

/* The ghosts' rule below and above a cell near boxes, for component q along axis a. */
static void rules(const struct fv *s, const struct near_box *x, int q, int a,
                  enum blocked_ghost rule[2])
{
    for (int up = 0; up < 2; up++)
        rule[up] = blocked_rule(s, x->box[up], q, a);
}

/* On the lower face of v[0]; with the bias of convection.c. U and C as there; C = 0: the plain
 * fourth-order value. */
static double face_value(const double *v, double U, double C)
{
    const double plain = (7.0 * (v[-1] + v[0]) - (v[-2] + v[1])) / 12.0;
    const double a = v[-1] - v[-2], b = v[0] - v[-1], c = v[1] - v[0], d = a - 2.0 * b + c;
    const double r = fabs(d) / (fabs(a) + 2.0 * fabs(b) + fabs(c) + 1e-300);
    return C > 0.0 ? plain + copysign(fmin(1.0, C * r * r) / 12.0, U) * d : plain;
}

/* On the face of a box behind the free cell at q. Zero gradient: (7 q_0 - q_1)/6 is the mean of (7
 * (q + q) - (q + q))/12 with mirrored ghosts; 0 where nothing passes. */
static double wall_value(const double *q, int64_t in, enum blocked_ghost rule)
{
    return rule == GHOST_EVEN ? (7.0 * q[0] - q[in]) / 6.0 : 0.0;
}

/* On the face of a box below or above the cell at c, which may let air in: q goes with it. */
static double box_value(const struct fv *s, const double *q, int64_t c, int a, int up,
                        enum blocked_ghost rule)
{
    return blocked_vents(s, a, c, up) ? q[c]
                                      : wall_value(q + c, (up ? -1 : 1) * s->b.stride[a], rule);
}

/* layer: between dry cells alone; NULL: everywhere. */
static void set_faces(const struct fv *s, int q, int a, const double *u, const double *U, double C,
                      const unsigned char *layer, double *face)
{
    const struct blocked *w = s->blocked;
    const int64_t d = s->b.stride[a];
    for (int64_t k = 0; k < w->nnear[a]; k++) {
        const struct near_box *x = w->near[a] + k;
        const int64_t c = x->cell;
        enum blocked_ghost rule[2];
        double v[5];
        rules(s, x, q, a, rule);
        const bool all = !layer || layer[c];
        if (x->free[0] == 0 && all)
            face[c] = box_value(s, u, c, a, 0, rule[0]);
        else if (x->free[0] > 0 && (x->free[0] < 2 || x->free[1] < 1) &&
                 (!layer || (layer[c] && layer[c - d]))) {
            blocked_line(x, u, d, 2, rule, v + 2);
            face[c] = face_value(v + 2, C > 0.0 ? U[c] : 0.0, C);
        }
        if (x->free[1] == 0 && all)
            face[c + d] = box_value(s, u, c, a, 1, rule[1]);
    }
}

void blocked_faces(const struct fv *s, int q, int a, const double *u, const double *U, double C,
                   double *face)
{
    set_faces(s, q, a, u, U, C, NULL, face);
}

void blocked_face_velocities(const struct fv *s, double *const u[3], double *const U[3],
                             bool only_dry)
{
    for (int a = 0; a < s->b.dim; a++)
        set_faces(s, a, a, u[a], NULL, 0.0, only_dry ? s->surface->layer : NULL, U[a]);
}

/* What the product along t is beside a box, less what it was with the numbers within the box. The
 * correction of 1/48 (U_t+1 - U_t-1)(f_t+1 - f_t-1), see convection.c. */
static double product(const struct beside_box *x, const double *U, const double *f,
                      enum blocked_ghost of_U, enum blocked_ghost of_f)
{
    const double *V = U + x->face, *g = f + x->face;
    const int64_t in = x->in;
    const double was = (V[in] - V[-in]) * (g[in] - g[-in]);
    if (x->both)
        return -was;
    return (V[in] - blocked_ghost(V, in, 1, of_U)) * (g[in] - blocked_ghost(g, in, 1, of_f)) - was;
}

/* The rule of products beside a box: under a surface one-sided behind faces without slip, as
 * convection_beside_walls. */
static enum blocked_ghost product_rule(const struct fv *s, int box, int q, int t)
{
    const enum blocked_ghost rule = blocked_rule(s, box, q, t);
    return s->surface && rule == GHOST_NO_SLIP ? GHOST_LINEAR : rule;
}

/* First the products along the tangents t, then the fluxes through the boxes' own faces, which are
 * 0 but for air that comes in. */
void blocked_fluxes(const struct fv *s, int q, int a, const double *U, const double *face,
                    double *F)
{
    const struct blocked *w = s->blocked;
    const int64_t d = s->b.stride[a];
    for (int t = 0; t < s->b.dim; t++)
        for (int64_t k = 0; k < w->nbeside[a][t]; k++) {
            const struct beside_box *x = w->beside[a][t] + k;
            F[x->face] +=
                product(x, U, face, product_rule(s, x->box, a, t), product_rule(s, x->box, q, t)) /
                48.0;
        }
    for (int64_t k = 0; k < w->nnear[a]; k++) {
        const struct near_box *x = w->near[a] + k;
        for (int up = 0; up < 2; up++) {
            const int64_t at = x->cell + up * d;
            if (x->free[up] == 0)
                F[at] = blocked_vents(s, a, x->cell, up) ? U[at] * face[at] : 0.0;
        }
    }
}

/* Adds what the true ghosts change of nu/(12 h^2) (16 (q_1 + q_-1) - (q_2 + q_-2) - 30 q_0). */
void blocked_viscous(const struct fv *s, int q, const double *u, double *out)
{
    const struct blocked *w = s->blocked;
    for (int a = 0; a < s->b.dim; a++) {
        const int64_t d = s->b.stride[a];
        const double c = s->nu / (12.0 * s->b.h[a] * s->b.h[a]);
        for (int64_t k = 0; k < w->nnear[a]; k++) {
            const struct near_box *x = w->near[a] + k;
            const double *at = u + x->cell;
            enum blocked_ghost rule[2];
            double v[5];
            if (!x->own || (x->free[0] > 1 && x->free[1] > 1))
                continue;
            rules(s, x, q, a, rule);
            blocked_line(x, u, d, 2, rule, v + 2);
            out[x->cell] += c * (16.0 * ((v[1] - at[-d]) + (v[3] - at[d])) -
                                 ((v[0] - at[-2 * d]) + (v[4] - at[2 * d])));
        }
    }
}

/* As block_derivative of equal cells has it. */
double blocked_derivative(const struct fv *s, int q, int a, int64_t c)
{
    const struct near_box x = blocked_near(s, c, a);
    enum blocked_ghost rule[2];
    double v[5];
    if (s->blocked->box[c])
        return 0.0;
    rules(s, &x, q, a, rule);
    blocked_line(&x, s->u[q], s->b.stride[a], 2, rule, v + 2);
    return (8.0 * (v[3] - v[1]) - (v[4] - v[0])) / (12.0 * s->b.h[a]);
}

void blocked_zero(const struct fv *s, double *q)
{
    for (int64_t c = 0; c < s->b.size; c++)
        q[c] = s->blocked->box[c] ? 0.0 : q[c];
}

/* psi on the face beside the cell m cells along the step e from c, (7 psi_1 - psi_2)/6; even behind
 * boxes and closed sides. m runs along the face from c in steps of e; where cells end before m the
 * last ones are mirrored. */
static double on_face(const struct fv *s, const double *psi, int64_t c, int64_t in, int64_t e,
                      int m)
{
    const unsigned char *solid = s->forcing->forced;
    const int way = m < 0 ? -1 : 1;
    int at = 0, left = m * way;
    for (; left > 0 && !solid[c + (at + way) * e]; left--)
        at += way;
    if (left > 0)
        at -= way * (left - 1);
    const double *p = psi + c + at * e;
    return solid[c + at * e + in] ? p[0] : (7.0 * p[0] - p[in]) / 6.0;
}

/* The tangential slope of psi on the face, fourth order, times tau; component a, across, is 0. */
void blocked_set_slip(const struct fv *s, double tau, const double *psi)
{
    const struct blocked *w = s->blocked;
    for (int a = 0; a < s->b.dim; a++)
        for (int64_t k = 0; k < w->nnear[a]; k++)
            for (int up = 0; up < 2 && w->near[a][k].own; up++) {
                const struct near_box *x = w->near[a] + k;
                const int64_t in = up ? -s->b.stride[a] : s->b.stride[a];
                if (x->free[up] > 1 || s->prm.boxes[x->box[up]].kind != WALL_NO_SLIP)
                    continue;
                const int64_t c = x->cell + (x->free[up] ? -in : 0); /* the one at the face */
                for (int q = 0; q < s->b.dim; q++) {
                    double v[5];
                    for (int m = -2; m <= 2; m++)
                        v[2 + m] = q == a ? 0.0 : on_face(s, psi, c, in, s->b.stride[q], m);
                    w->slip[a][k][up][q] =
                        tau * (8.0 * (v[3] - v[1]) - (v[4] - v[0])) / (12.0 * s->b.h[q]);
                }
            }
}

/* Ghosts of a value w on the face have 4 w and 16 w more (blocked_ghost). Hence 16*4 - 16 in the
 * first cell and -4 in the second, with the weights of the Laplacian. */
void blocked_add_slip(const struct fv *s, int q, double *out)
{
    const struct blocked *w = s->blocked;
    for (int a = 0; a < s->b.dim; a++) {
        const double c = s->nu / (12.0 * s->b.h[a] * s->b.h[a]);
        for (int64_t k = 0; k < w->nnear[a]; k++)
            for (int up = 0; up < 2 && w->near[a][k].own; up++)
                if (w->near[a][k].free[up] < 2)
                    out[w->near[a][k].cell] +=
                        c * w->slip[a][k][up][q] *
                        (w->near[a][k].free[up] == 0 ? 16.0 * 4.0 - 16.0 : -4.0);
    }
}
