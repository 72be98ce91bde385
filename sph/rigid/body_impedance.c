/* body_impedance.c - how fast sound stops a free body. A wall that moves at u against a fluid of
 * impedance rho c is loaded by rho c u.n at once (the added mass only when the sound has run around
 * it), so the body's velocity falls at the eigenvalues of M^-1 Z, Z = int rho c [n; r x n][n; r x
 * n]^T dS; the largest bounds an explicit step. SPDX-License-Identifier: BSD-3-Clause */
#include <lapacke.h>

#include "body_impedance.h"

/* One piece of surface with the impedances `along' its normal and `across' it, rho c dS, kg/s: adds
 * to the 6 x 6 matrix Z for velocity and rotation about the centre. */
void impedance_add(struct impedance *z, const double *arm, const double *n, double along,
                   double across)
{
    double column[6][6]; /* of each unit force */
    for (int d = 0; d < 3; d++) {
        double e[3] = {d == 0, d == 1, d == 2};
        memcpy(column[d], e, sizeof e);
        vec3_cross(arm, e, column[d] + 3);
    }
    for (int d = 0; d < 3; d++)
        for (int f = 0; f < 3; f++) {
            const double part = across * (d == f) + (along - across) * n[d] * n[f];
            for (int i = 0; i < 6; i++)
                for (int j = 0; j < 6; j++)
                    z->Z[i][j] += column[d][i] * part * column[f][j];
        }
}

/* Velocities that the body may have, as columns; how many. */
static int directions(const struct body *b, double D[6][6])
{
    const struct body_free *f = b->free;
    int n = 0;
    memset(D, 0, 36 * sizeof(double));
    if (f->hinged) {
        vec3_cross(f->axis, f->arm, D[0]);
        memcpy(D[0] + 3, f->axis, sizeof f->axis);
        return 1;
    }
    if (f->slides)
        memcpy(D[n++], f->slide, sizeof f->slide);
    for (int a = 0; a < b->dim && !f->slides; a++)
        if (!(f->locked >> a & 1))
            D[n++][a] = 1.0;
    if (f->rotation == TURNS_AXIS)
        memcpy(D[n++] + 3, f->axis, sizeof f->axis);
    for (int a = 0; a < 3 && f->rotation == TURNS_FREE; a++)
        D[n++][3 + a] = 1.0;
    return n;
}

/* D_i . A D_j. */
static double form(double D[6][6], double A[6][6], int i, int j)
{
    double sum = 0.0;
    for (int a = 0; a < 6; a++)
        for (int c = 0; c < 6; c++)
            sum += D[i][a] * A[a][c] * D[j][c];
    return sum;
}

/* Z and M in the directions that constraints leave (D^T Z D), then the largest eigenvalue of M^-1
 * Z, both symmetric and M positive: LAPACK gives them ascending. */
double impedance_rate(const struct impedance *z, const struct body *b)
{
    double D[6][6], M6[6][6] = {{0.0}}, M[6][6], Z[6][6], rate[6];
    const int n = directions(b, D);
    for (int a = 0; a < 3; a++) {
        M6[a][a] = b->free->mass;
        memcpy(M6[3 + a] + 3, b->free->inertia[a], sizeof b->free->inertia[a]);
    }
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            M[i][j] = form(D, M6, i, j);
            Z[i][j] = form(D, (double(*)[6])z->Z, i, j);
        }
    require(n == 0 || LAPACKE_dsygv(LAPACK_ROW_MAJOR, 1, 'N', 'L', n, Z[0], 6, M[0], 6, rate) == 0);
    return n > 0 ? rate[n - 1] : 0.0;
}

/* The integrand is of second order in the place: the middles of the edges have it exactly. */
static void add_triangle(const struct body *b, int k, double along, double across,
                         struct impedance *z)
{
    const int *v = b->mesh->vertex[k];
    double n[3];
    const double third = trimesh_normal(b->mesh, k, n) / 3.0;
    for (int e = 0; e < 3; e++) {
        double arm[3] = {-b->centre[0], -b->centre[1], -b->centre[2]};
        vec3_add(arm, 0.5, b->mesh->x[v[e]]);
        vec3_add(arm, 0.5, b->mesh->x[v[(e + 1) % 3]]);
        impedance_add(z, arm, n, along * third, across * third);
    }
}

/* By midpoints of pieces of dx at most: a moment's arm varies along an edge. */
static void add_edge(const struct body *b, int k, double dx, double along, double across,
                     struct impedance *z)
{
    const struct line l = line_of(&b->is->points, true);
    const double *from = l.x[k], *to = l.x[(k + 1) % l.n];
    const double d[2] = {to[0] - from[0], to[1] - from[1]}, length = hypot(d[0], d[1]);
    const int pieces = (int)ceil(length / dx);
    const double n[3] = {-d[1] / length, d[0] / length, 0.0};
    for (int i = 0; i < pieces; i++) {
        double arm[3] = {0.0, 0.0, 0.0};
        for (int a = 0; a < 2; a++)
            arm[a] = from[a] + (i + 0.5) / pieces * d[a] - b->centre[a];
        impedance_add(z, arm, n, along * length / pieces, across * length / pieces);
    }
}

/* Friction by the least distance that it counts with. */
double impedance_stopping_rate(const struct body *b, double rho_c, double mu, double dx)
{
    const double rub = b->is->kind == WALL_NO_SLIP ? mu / (0.25 * dx) : 0.0;
    struct impedance z = {{{0.0}}};
    for (int k = 0; !b->mesh && k < b->is->points.n; k++)
        add_edge(b, k, dx, rho_c, rub, &z);
    for (int k = 0; b->mesh && k < b->mesh->ntriangles; k++)
        add_triangle(b, k, rho_c, rub, &z);
    return impedance_rate(&z, b);
}
