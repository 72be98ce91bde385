/* fv_bc_case.h - a vortex in a box with no-slip walls: psi = sin^2(pi x) sin^2(pi y)/pi at the
 * start, its cell averages and fluxes, and the difference of two grids of which one halves the
 * other. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../../../fv/boundary/bc.h"
#include "fv_case.h"

/* Largest difference of the velocity along x from the averages of 6 y (1 - y) over the layers,
 * which a channel of the unit square has. */
static inline double parabola_error(const struct fv *s)
{
    const double h = s->b.h[1];
    double most = 0.0;
    BLOCK_CELLS (&s->b, i, j, k, c) {
        const double y = j * h;
        const double u = 2.0 * (2.0 * y + h) - 4.0 / 3.0 * (3.0 * y * y + 3.0 * y * h + h * h);
        most = fmax(most, fabs(s->u[0][c] - u));
    }
    return most;
}

struct box_flow {
    struct fv_case c;
    double *u[2], *p; /* without ghosts */
    int n;
};

static inline double box_sin2(double x) { return sin(M_PI * x) * sin(M_PI * x); }
static inline double box_integral(double x) { return 0.5 * x - sin(2.0 * M_PI * x) / (4.0 * M_PI); }

static inline void box_fill(struct fv *s)
{
    const struct block *b = &s->b;
    const double h = b->h[0];
    for (int j = -1; j <= b->n[1]; j++)
        for (int i = -1; i <= b->n[0]; i++) {
            const int64_t c = block_at(b, i, j, 0);
            const double x = (b->lo[0] + i) * h, y = (b->lo[1] + j) * h;
            const double X = box_integral(x + h) - box_integral(x),
                         Y = box_integral(y + h) - box_integral(y);
            s->u[0][c] = X * (box_sin2(y + h) - box_sin2(y)) / (M_PI * h * h);
            s->u[1][c] = -Y * (box_sin2(x + h) - box_sin2(x)) / (M_PI * h * h);
            s->U[0][c] = box_sin2(x) * (box_sin2(y + h) - box_sin2(y)) / (M_PI * h);
            s->U[1][c] = -box_sin2(y) * (box_sin2(x + h) - box_sin2(x)) / (M_PI * h);
        }
    fv_start(s);
}

static inline void box_run(struct box_flow *f, int n, double cfl, double t)
{
    char cells[64], step[64];
    snprintf(cells, sizeof cells, "fv.cells=(%d,%d)", n, n);
    snprintf(step, sizeof step, "fv.cfl=%g", cfl);
    fv_case_set(&f->c, MPI_COMM_SELF,
                (const char *const[]){"initial.field=\"rest\"", CLOSED, cells, step, NULL});
    for (int k = SIDE_X_MIN; k <= SIDE_Y_MAX; k++)
        wall_add(&f->c, (enum scene_side)k, WALL_NO_SLIP, 0.0);
    struct fv *s = fv_case_start(&f->c, NULL);
    box_fill(s);
    if (!fv_case_run(&f->c, 100000, t))
        abort();
    f->n = n;
    for (int a = 0; a < 2; a++) {
        f->u[a] = NEW(double, n *n);
        block_pack_from(&s->b, 0, s->u[a], f->u[a]);
    }
    f->p = NEW(double, n *n);
    double mean = 0.0;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++)
            mean += (f->p[i + n * j] = fv_pressure(s, block_at(&s->b, i, j, 0)));
    for (int i = 0; i < n * n; i++)
        f->p[i] -= mean / (n * n);
    fv_free(&f->c.s);
}

static inline double box_coarse(const double *q, int n, int i, int j)
{
    const int64_t at = 2 * i + 2 * (int64_t)j * n;
    return 0.25 * (q[at] + q[at + 1] + q[at + n] + q[at + n + 1]);
}

/* d: relative L2 and largest difference of velocity, L2 of pressure. */
static inline void box_difference(const struct box_flow *f, const struct box_flow *g, double *d)
{
    double sum[4] = {0.0}, most = 0.0;
    for (int j = 0; j < f->n; j++)
        for (int i = 0; i < f->n; i++) {
            for (int a = 0; a < 2; a++) {
                const double v = box_coarse(g->u[a], g->n, i, j), e = f->u[a][i + j * f->n] - v;
                sum[0] += e * e;
                sum[1] += v * v;
                most = fmax(most, fabs(e));
            }
            const double v = box_coarse(g->p, g->n, i, j), e = f->p[i + j * f->n] - v;
            sum[2] += e * e;
            sum[3] += v * v;
        }
    d[0] = sqrt(sum[0] / sum[1]);
    d[1] = most;
    d[2] = sqrt(sum[2] / sum[3]);
}

static inline void box_free(struct box_flow *f) { FREE(f->u[0], f->u[1], f->p); }

/* Error of Taylor-Green, which meets slip walls on the sides of the square, at t = 0.5. */
static inline double box_slip_error(int n, const char *graded)
{
    struct fv_case c;
    char cells[64];
    double row[FV_CASE_ROW];
    snprintf(cells, sizeof cells, "fv.cells=(%d,%d)", n, n);
    fv_case_set(&c, MPI_COMM_SELF,
                (const char *const[]){CLOSED, cells, graded, "fv.cfl=0.5", NULL});
    for (int k = SIDE_X_MIN; k <= SIDE_Y_MAX; k++)
        wall_add(&c, (enum scene_side)k, WALL_SLIP, 0.0);
    fv_case_start(&c, NULL);
    c.s->prm.errors = true;
    if (!fv_case_run(&c, 100000, 0.5))
        abort();
    VALUES_OF(fv_row, c.s, row);
    fv_free(&c.s);
    return row[3];
}
