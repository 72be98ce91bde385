/* body_impedance.c - how fast sound stops a free body. A wall that moves at u against a fluid of
 * impedance rho c is loaded by rho c u.n at once (the added mass only when the sound has run around
 * it), so the body's velocity falls at the eigenvalues of M^-1 Z, Z = int rho c [n; r x n][n; r x
 * n]^T dS; the largest bounds an explicit step. SPDX-License-Identifier: BSD-3-Clause */
#include <string.h>

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

/* Cholesky factor of a symmetric matrix, in its lower half. */
static void factor(double A[6][6], int n)
{
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++) {
            double v = A[i][j];
            for (int k = 0; k < j; k++)
                v -= A[i][k] * A[j][k];
            A[i][j] = i == j ? sqrt(v) : v / A[j][j];
        }
}

/* A holds the factor: forward, then back. */
static void solve(double A[6][6], int n, double *v)
{
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < i; k++)
            v[i] -= A[i][k] * v[k];
        v[i] /= A[i][i];
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int k = i + 1; k < n; k++)
            v[i] -= A[k][i] * v[k];
        v[i] /= A[i][i];
    }
}

static double form(double D[6][6], double A[6][6], int i, int j)
{
    double sum = 0.0;
    for (int a = 0; a < 6; a++)
        for (int c = 0; c < 6; c++)
            sum += D[i][a] * A[a][c] * D[j][c];
    return sum;
}

/* Z and M in the directions that constraints leave (D^T Z D), then the largest eigenvalue of M^-1 Z
 * by powers: six unknowns at most, so 500 of them cost nothing. The first vector has all
 * components, unequal, so that it is no eigenvector by symmetry. */
double impedance_rate(const struct impedance *z, const struct body *b)
{
    double D[6][6], M6[6][6] = {{0.0}}, M[6][6], Z[6][6], v[6], rate = 0.0;
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
    factor(M, n);
    for (int i = 0; i < n; i++)
        v[i] = 1.0 / (1.0 + 0.3 * i) / sqrt(M[i][i]);
    for (int k = 0; k < 500; k++) { /* powers; the growth of the last one is the rate */
        double w[6] = {0.0}, size = 0.0, before = 0.0;
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++)
                w[i] += Z[i][j] * v[j];
        solve(M, n, w);
        for (int i = 0; i < n; i++) { /* in the scale of momentum^2/mass */
            size += w[i] * w[i] * M[i][i] * M[i][i];
            before += v[i] * v[i] * M[i][i] * M[i][i];
        }
        rate = before > 0.0 ? sqrt(size / before) : 0.0;
        for (int i = 0; i < n && size > 0.0; i++)
            v[i] = w[i] / sqrt(size);
    }
    return rate;
}
