/* test_forcing.c - fluxes through the outline of a hole that a partner fills: of fourth order,
 * whatever the free cells hold. ranks: 1 2 4. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../fv/boundary/forcing.h"
#include "../../../fv/operators/operators.h"
#include "fv_bc_case.h"

static void fill_partner(const struct fv *s, struct forcing *f)
{
    const struct block *b = &s->b;
    double x[3], u[3];
    for (int64_t i = 0; i < f->npartner + f->nrim; i++) {
        const int64_t c = f->partner[i];
        block_centre(b, (int)(c % b->stride[1]) - b->g[0],
                     (int)(c % b->stride[2] / b->stride[1]) - b->g[1],
                     (int)(c / b->stride[2]) - b->g[2], x);
        exact_average(&s->exact, x, b->h, 0.0, u, NULL, NULL);
        for (int a = 0; a < b->dim; a++)
            f->v[a][i] = f->v_next[a][i] = u[a];
    }
}

static double largest_error(const struct fv *s)
{
    const struct forcing *f = s->forcing;
    const struct block *b = &s->b;
    double most = 0.0, u[3];
    for (int a = 0; a < b->dim; a++)
        for (int64_t i = 0; i < f->nface[a]; i++) {
            const int64_t c = f->face[a][i];
            double x[3];
            if (!f->counts[a][i])
                continue;
            block_centre(b, (int)(c % b->stride[1]) - b->g[0],
                         (int)(c % b->stride[2] / b->stride[1]) - b->g[1],
                         (int)(c / b->stride[2]) - b->g[2], x);
            x[a] -= 0.5 * b->h[a];
            exact_face(&s->exact, x, b->h, a, 0.0, u);
            most = fmax(most, fabs(s->U[a][c] - u[a]));
        }
    return ranks_max(MPI_COMM_WORLD, most);
}

static double error_with(const char *const *overrides)
{
    static const double box[2][3] = {{0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}};
    struct fv_case c;
    fv_case_set(&c, MPI_COMM_WORLD, overrides);
    struct fv *s = fv_case_start(&c, NULL);
    s->forcing = mem_own(s, forcing_create(s, 1, &box, true));
    fill_partner(s, s->forcing);
    for (int a = 0; a < s->b.dim; a++)
        for (int64_t i = 0; i < s->b.size; i++)
            s->u[a][i] *= 0.5; /* what the fluxes must not see */
    convection_face_velocities(s, s->u, s->U);
    forcing_fluxes(s, 0.0, s->U);
    const double e = largest_error(s);
    fv_free(&c.s);
    return e;
}

TEST(fluxes_are_the_partners)
{
    const double coarse = error_with((const char *const[]){"fv.cells=(16,16)", NULL});
    const double fine = error_with((const char *const[]){"fv.cells=(32,32)", NULL});
    assert_true(fine < 1e-3);
    assert_true(coarse / fine > 12.0);
}

/* Beltrami's flow does not change along its components: no error but rounding. */
TEST(and_in_3d)
{
    assert_true(error_with((const char *const[]){"domain.dim=3", "initial.field=\"beltrami\"",
                                                 "fv.cells=(12,12,16)", NULL}) < 1e-14);
}

/* What a partner has too much does not drive the flow to an outlet: a source of 1/s within leaves
 * the outline without net flux. */
TEST(an_outlet_feels_no_source)
{
    static const double box[2][3] = {{0.25, 0.25, 0.0}, {0.75, 0.75, 1.0}};
    struct fv_case c;
    double net[2] = {0.0, 0.0};
    fv_case_set(&c, MPI_COMM_WORLD,
                (const char *const[]){CLOSED, "initial.field=\"uniform\"", "initial.velocity=(1,0)",
                                      "fv.cells=(16,16)", NULL});
    wall_add(&c, SIDE_X_MIN, WALL_INFLOW, 1.0);
    wall_add(&c, SIDE_X_MAX, WALL_OUTFLOW, 0.0);
    wall_add(&c, SIDE_Y_MIN, WALL_SLIP, 0.0);
    wall_add(&c, SIDE_Y_MAX, WALL_SLIP, 0.0);
    struct fv *s = fv_case_start(&c, NULL);
    DROP(s->forcing);
    struct forcing *f = s->forcing = mem_own(s, forcing_create(s, 1, &box, true));
    for (int64_t i = 0; i < f->npartner + f->nrim; i++) {
        double x[3];
        grid_place(&s->grid, f->partner[i], x);
        for (int a = 0; a < 2; a++)
            f->v[a][i] = f->v_next[a][i] = 0.5 * x[a];
    }
    convection_face_velocities(s, s->u, s->U);
    forcing_fluxes(s, 0.0, s->U);
    for (int a = 0; a < 2; a++)
        for (int64_t i = 0; i < f->nface[a]; i++)
            if (f->counts[a][i]) {
                net[0] += f->sign[a][i] * s->U[a][f->face[a][i]] / 16.0;
                net[1] += fabs(s->U[a][f->face[a][i]]) / 16.0;
            }
    MPI_Allreduce(MPI_IN_PLACE, net, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    assert_true(fabs(net[0]) < 1e-14 && net[1] > 0.1);
    fv_free(&c.s);
}

/* A hole from wall to wall: nothing but zero is in its depth, whatever was there. */
TEST(the_depth_of_a_hole_is_at_rest)
{
    static const double box[2][3] = {{-INFINITY, 0.25, -INFINITY}, {INFINITY, INFINITY, INFINITY}};
    struct fv_case c;
    fv_case_set(&c, MPI_COMM_WORLD, (const char *const[]){"fv.cells=(16,32)", NULL});
    struct fv *s = fv_case_start(&c, NULL);
    int64_t deep = 0;
    s->forcing = mem_own(s, forcing_create(s, 1, &box, true));
    const struct forcing *f = s->forcing;
    fill_partner(s, s->forcing);
    for (int a = 0; a < s->b.dim; a++)
        for (int64_t i = 0; i < s->b.size; i++)
            s->u[a][i] = 1e3;
    forcing_velocity(s, 0.0, s->u);
    for (int64_t i = 0; i < f->nlocal; i++)
        for (int a = 0; a < s->b.dim && !f->layer[f->local[i]]; a++, deep++)
            assert_close(s->u[a][f->local[i]], 0.0, 0.0);
    MPI_Allreduce(MPI_IN_PLACE, &deep, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    assert_true(deep > 0);
    fv_free(&c.s);
}
