/* test_fv_operators.c - the finite-volume operators against averages of waves: fourth order on
 * cells that are no squares. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../fv/operators/operators.h"
#include "fv_case.h"

enum what { VALUE, GRADIENT, LAPLACE };

/* Phase k.x + 0.3 of a wave of `number' in the domain, and the factors that averaging over cells
 * gives. */
struct plane_wave {
    double k[3], mean[3];
};

static struct plane_wave wave_in(const struct block *b)
{
    static const int number[3] = {2, -1, 1};
    struct plane_wave w = {{0}, {0}};
    for (int a = 0; a < 3; a++) {
        w.k[a] = a < b->dim ? 2.0 * M_PI * number[a] / (b->h[a] * b->cells[a]) : 0.0;
        const double x = 0.5 * w.k[a] * b->h[a];
        w.mean[a] = x != 0.0 ? sin(x) / x : 1.0;
    }
    return w;
}

static double phase(const struct plane_wave *w, const double *x)
{
    return w->k[0] * x[0] + w->k[1] * x[1] + w->k[2] * x[2] + 0.3;
}

static void fill_wave(const struct block *b, const struct plane_wave *w, double *q)
{
    double x[3];
    BLOCK_CELLS (b, i, j, k, at) {
        block_centre(b, i, j, k, x);
        q[at] = w->mean[0] * w->mean[1] * w->mean[2] * cos(phase(w, x));
    }
    block_halo(b, 1, &q);
}

/* Average over the lower face along a, or over the cell. */
static double wanted(const struct block *b, const struct plane_wave *w, const double *x,
                     enum what what, int a)
{
    const double cell = w->mean[0] * w->mean[1] * w->mean[2];
    double at[3] = {x[0], x[1], x[2]};
    if (what == GRADIENT)
        return -cell * w->k[a] * sin(phase(w, at));
    if (what == LAPLACE)
        return -cell * (w->k[0] * w->k[0] + w->k[1] * w->k[1] + w->k[2] * w->k[2]) *
               cos(phase(w, at));
    at[a] -= 0.5 * b->h[a];
    return cell / w->mean[a] * cos(phase(w, at));
}

/* Largest error, relative to the largest value, along axis a. */
static double error_of(struct fv *s, enum what what, int a)
{
    const struct block *b = &s->b;
    const struct plane_wave w = wave_in(b);
    double *out = what == VALUE ? s->U[a] : s->rhs[0], most = 0.0, scale = 0.0, x[3];
    for (int c = 0; c < b->dim; c++)
        fill_wave(b, &w, s->u[c]);
    if (what == VALUE)
        convection_face_velocities(s, s->u, s->U);
    else if (what == GRADIENT)
        gradient(s, s->u[0], a, CONTINUE_CUBIC, out);
    else
        viscous_apply(s, s->u[0], out);
    BLOCK_CELLS (b, i, j, k, at) {
        block_centre(b, i, j, k, x);
        const double v = wanted(b, &w, x, what, a) * (what == LAPLACE ? s->nu : 1.0);
        most = fmax(most, fabs(out[at] - v));
        scale = fmax(scale, fabs(v));
    }
    return most / scale;
}

static void has_order_four(int dim, enum what what)
{
    static const char *const dims[] = {"domain.dim=2", "domain.dim=3"};
    static const char *const cells[] = {"fv.cells=(32,20,16)", "fv.cells=(64,40,32)"};
    for (int a = 0; a < (what == LAPLACE ? 1 : dim); a++) {
        double e[2];
        for (int fine = 0; fine < 2; fine++) {
            struct fv_case c;
            fv_case_set(&c, MPI_COMM_WORLD,
                        (const char *const[]){dims[dim - 2], cells[fine],
                                              "domain.max=(1.0,1.2,0.7)",
                                              "initial.field=\"uniform\"", NULL});
            fv_case_start(&c, NULL);
            e[fine] = error_of(c.s, what, a);
            fv_free(&c.s);
        }
        if (!(fv_case_order(e[0], e[1]) >= 3.8 && e[1] < 2e-3))
            fail_msg("%dD operator %d axis %d: %g, %g, order %.2f", dim, what, a, e[0], e[1],
                     fv_case_order(e[0], e[1]));
    }
}

TEST(face_values_have_order_four)
{
    has_order_four(2, VALUE);
    has_order_four(3, VALUE);
}

TEST(gradient_has_order_four)
{
    has_order_four(2, GRADIENT);
    has_order_four(3, GRADIENT);
}

TEST(viscous_operator_has_order_four)
{
    has_order_four(2, LAPLACE);
    has_order_four(3, LAPLACE);
}
