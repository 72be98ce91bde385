/* test_fraction.c - the share of water of each cell is carried without loss; a level is that of the
 * water; a column in mid-tank falls evenly; a drop, a full tank and none run or say why not.
 * ranks: 1 2.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../fv/operators/flow_measures.h"
#include "../../../fv/surface/fraction.h"
#include "../../../fv/time/surface_steps.h"
#include "surface_case.h"

#define FRACTION "fv.volume=\"fraction\""

/* Velocities through faces by differences of a vector potential on the edges: no cell has a
 * divergence. Two vortices in the unit square, turned around the other axes, too, in 3D. */
static double potential(int a, const double *x)
{
    const double p = sin(M_PI * x[(a + 1) % 3]) * sin(M_PI * x[(a + 2) % 3]);
    return p * p / M_PI;
}

static double edge(const struct fv *s, const int *at, int along, const int *up)
{
    const struct block *b = &s->b;
    double x[3];
    for (int a = 0; a < 3; a++)
        x[a] =
            a == along ? (b->lo[a] + at[a] + 0.5) * b->h[a] : (b->lo[a] + at[a] + up[a]) * b->h[a];
    if (s->dim == 2)
        x[2] = 0.5;
    return s->dim == 2 && along != 2 ? 0.0 : potential(along, x);
}

static void set_vortex(struct fv *s, double sign)
{
    const struct block *b = &s->b;
    int more[3], at[3];
    for (int a = 0; a < 3; a++)
        more[a] = a < s->dim;
    for (int a = 0; a < s->dim; a++) {
        const int t = (a + 1) % 3, w = (a + 2) % 3;
        for (at[2] = 0; at[2] < b->n[2] + more[2]; at[2]++)
            for (at[1] = 0; at[1] < b->n[1] + more[1]; at[1]++)
                for (at[0] = 0; at[0] < b->n[0] + more[0]; at[0]++) {
                    const int here[3] = {0, 0, 0};
                    int up_t[3] = {0, 0, 0}, up_w[3] = {0, 0, 0};
                    up_t[t] = up_w[w] = 1;
                    const double along_w = (edge(s, at, w, up_t) - edge(s, at, w, here)) /
                                           (t < s->dim ? b->h[t] : 1.0);
                    const double along_t = (edge(s, at, t, up_w) - edge(s, at, t, here)) /
                                           (w < s->dim ? b->h[w] : 1.0);
                    s->U[a][block_at(b, at[0], at[1], at[2])] =
                        sign * ((t < s->dim ? along_w : 0.0) - (w < s->dim ? along_t : 0.0));
                }
    }
}

static double sum_of(const struct fv *s) { return fraction_volume(s); }

/* Steps of half a cell at most there and back; the sum of |C - C at the start|, of the water. */
static double there_and_back(struct fv *s, int steps, double dt)
{
    struct fraction *f = s->surface->fraction;
    double *first = NEW(double, s->size), off[2] = {0.0, 0.0}, worst = 0.0;
    const double before = sum_of(s);
    DROP(s->whole.near), DROP(s->whole.wet); /* all cells move */
    memcpy(first, f->C, (size_t)s->size * sizeof(double));
    for (int k = 0; k < 2 * steps; k++) {
        set_vortex(s, k < steps ? 1.0 : -1.0);
        for (int64_t c = 0; c < s->size; c++)
            f->layer[c] =
                f->C[c] > 0.5 ? 0.0 : 200.0; /* no air beside water: the vortex has no divergence */
        fraction_advance(s, dt, 1);
        FLOW_ROWS (s, c, n)
            for (int64_t i = c; i < c + n; i++)
                worst = fmax(worst, fmax(-f->C[i], f->C[i] - 1.0));
    }
    FLOW_ROWS (s, c, n)
        for (int64_t i = c; i < c + n; i++) {
            off[0] += fabs(f->C[i] - first[i]) * f->volume[i];
            off[1] += first[i] * f->volume[i];
        }
    MPI_Allreduce(MPI_IN_PLACE, off, 2, MPI_DOUBLE, MPI_SUM, s->comm);
    MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, s->comm);
    mem_free(first);
    double moved = f->moved;
    MPI_Allreduce(MPI_IN_PLACE, &moved, 1, MPI_DOUBLE, MPI_SUM, s->comm);
    assert_close(sum_of(s) / before, 1.0, 1e-11); /* 1e-12 of a cell is cut a step */
    assert_true(worst <= 0.0);
    assert_true(moved == 0.0);
    return off[0] / off[1];
}

static double vortex(int dim, int n)
{
    struct fv_case c;
    char cells[64], dims[32];
    snprintf(cells, sizeof cells, "fv.cells=(%d,%d,%d)", n, n, n);
    snprintf(dims, sizeof dims, "domain.dim=%d", dim);
    const struct scene_shape shape = {.form = SHAPE_DISC,
                                      .centre = {0.5, 0.7, dim == 3 ? 0.5 : 0.0},
                                      .radius = dim == 3 ? 0.25 : 0.2};
    struct fv *s =
        start(&c, MPI_COMM_WORLD, (const char *const[]){SURFACE, FRACTION, cells, dims, NULL},
              &shape, WALL_SLIP);
    const double h = 1.0 / n, dt = 0.24 * h;
    const double off = there_and_back(s, (int)(0.5 / dt), dt);
    fv_free(&c.s);
    return off;
}

/* Without a divergence sweeps keep 0 <= C <= 1 and the sum to rounding; first to second order. */
TEST(disc_in_a_vortex)
{
    const double coarse = vortex(2, 32), fine = vortex(2, 64);
    print_message("disc: %.4f, %.4f\n", coarse, fine);
    assert_true(fine < 0.55 * coarse && fine < 0.03);
}

TEST(sphere_in_a_vortex)
{
    const double coarse = vortex(3, 12), fine = SANITIZED ? 0.0 : vortex(3, 24);
    print_message("sphere: %.4f, %.4f\n", coarse, fine);
    assert_true(fine < 0.6 * coarse && fine < 0.06);
}

/* A column's level is that of its water, whatever steps phi has beyond its band. */
TEST(air_beyond_the_band_is_dry)
{
    const struct scene_shape below = {.form = SHAPE_BELOW, .level = 0.31};
    struct fv_case c;
    struct fv *s =
        start(&c, MPI_COMM_WORLD,
              (const char *const[]){SURFACE, "fluid.gravity=(0,-1)", "fv.volume=\"shift\"", NULL},
              &below, WALL_SLIP);
    for (int64_t i = 0; i < s->size; i++)
        s->surface->phi[i] += s->surface->phi[i] > 7.0 / 32.0 ? 1.0 : 0.0;
    for (double x = 0.05; x < 1.0; x += 0.3) {
        double level = surface_level(s, (const double[]){x, 0.0, 0.0}); /* this rank's part of it */
        MPI_Allreduce(MPI_IN_PLACE, &level, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
        assert_close(level, 0.31, 1e-9);
    }
    fv_free(&c.s);
}

/* A column in a tank from the origin on, let go under 9.81 m/s^2. */
static struct fv *start_falling(struct fv_case *c, const char *max, const char *cells,
                                const struct scene_shape *column)
{
    return start(c, MPI_COMM_WORLD,
                 (const char *const[]){SURFACE, "fluid.gravity=(0,-9.81)", "domain.min=(0,0)", max,
                                       cells, NULL},
                 column, WALL_SLIP);
}

/* A column that collapses in mid-tank and reaches both walls at once pushes to no side: none of its
 * halves is computed first. */
TEST(column_stays_even)
{
    const struct scene_shape column = {.form = SHAPE_BOX, .box = {{0.8, 0, 0}, {1.2, 0.6, 0}}};
    struct diagnosis d = {0};
    double force[FLOW_BODIES_MAX][4], all[4], aside = 0.0, down = 0.0;
    struct fv_case c;
    struct fv *s = start_falling(&c, "domain.max=(2,1)", "fv.cells=(64,32)", &column);
    while (s->t < 0.44 && !d.bad) {
        integrate(s, 0.44, &d);
        flow_forces(s, force, all);
        aside = fmax(aside, fabs(all[0]));
        down = fmax(down, fabs(all[1]));
    }
    print_message("column in mid-tank: %.2g N aside, %.4g N down\n", aside, down);
    assert_false(d.bad);
    assert_true(aside <= 1e-6 * down);
    fv_free(&c.s);
}

/* The first half of a step moves the water; taken back, cells near water are bit for bit what they
 * were, though others have been near between, and what it counts is not counted. */
TEST(steps_taken_back_restore_what_is_near)
{
    const struct scene_shape column = {.form = SHAPE_BOX, .box = {{0, 0, 0}, {0.3, 0.6, 0}}};
    struct diagnosis d = {0};
    struct fv_case c;
    struct fv *s = start_falling(&c, "domain.max=(2,2)", "fv.cells=(48,48)", &column);
    while (s->t < 0.2 && !d.bad)
        integrate(s, 0.2, &d);
    assert_false(d.bad);
    double *const now[] = {s->surface->phi, s->surface->fraction->C, s->u[0], s->u[1], s->p};
    double *was[5];
    for (int f = 0; f < 5; f++) {
        was[f] = NEW(double, s->size);
        memcpy(was[f], now[f], (size_t)s->size * sizeof(double));
    }
    const double moved = s->surface->fraction->moved, lost = s->surface->lost;
    const int64_t reinits = s->surface->reinits;
    s->surface->travelled = 1.9; /* so that the first half makes phi a distance again */
    surface_keep_state(s);
    surface_first_half(s, 4.0 * s->step.dt);
    assert_true(s->surface->fraction->moved > moved && s->surface->reinits > reinits);
    surface_back(s);
    assert_true(s->surface->fraction->moved == moved && s->surface->lost == lost);
    assert_int_equal(s->surface->reinits, reinits);
    double *const back[] = {s->surface->phi, s->surface->fraction->C, s->u[0], s->u[1], s->p};
    int64_t cells = 0;
    FLOW_NEAR (s, at, n) {
        cells += n;
        for (int f = 0; f < 5; f++)
            assert_memory_equal(back[f] + at, was[f] + at, (size_t)n * sizeof(double));
    }
    assert_true(ranks_count(s->comm, cells) < 48 * 48);
    for (int f = 0; f < 5; f++)
        mem_free(was[f]);
    fv_free(&c.s);
}

/* A front over a floor without slip, a side or a box, whose layer is thinner than a cell: the water
 * has the momentum that walls gave it (a tenth of it was lost to the air, and the front slow). */
TEST(fronts_over_a_floor_without_slip_keep_their_momentum)
{
    for (int box = 0; box < 2; box++) {
        const double low = box ? 0.25 : 0.0, end = SANITIZED ? 0.2 : 0.45;
        const struct scene_shape column = {.form = SHAPE_BOX,
                                           .box = {{0, low, 0}, {0.5, low + 0.6, 0}}};
        struct diagnosis d = {0};
        double force[2][4], given = 0.0, momentum = 0.0;
        struct fv_case c;
        fv_case_set(&c, MPI_COMM_WORLD,
                    (const char *const[]){SURFACE, "fluid.gravity=(0,-9.81)", "domain.min=(0,0)",
                                          "domain.max=(2,1)", "fv.cells=(48,24)", "fluid.nu=1e-5",
                                          NULL});
        fv_case_close(&c, box ? WALL_SLIP : WALL_NO_SLIP);
        c.run.scene.shapes[c.run.scene.nshapes++] = column;
        blocked_given[0] = (struct blocked_params){
            .name = "floor", .min = {0, 0, 0}, .max = {2, 0.25, 0}, .kind = WALL_NO_SLIP};
        blocked_given_count = box;
        struct fv *s = fv_case_start(&c, NULL);
        flow_forces(s, NULL, force[0]);
        while (s->t < end && !d.bad) {
            integrate(s, end, &d);
            flow_forces(s, NULL, force[1]);
            given -= 0.5 * s->step.dt * (force[0][0] + force[1][0]);
            memcpy(force[0], force[1], sizeof force[0]);
        }
        FLOW_NEAR (s, at, n)
            for (int64_t i = at; i < at + n; i++)
                momentum += is_blocked(s, i) ? 0.0 : s->surface->fraction->C[i] * s->u[0][i];
        momentum = ranks_sum(s->comm, momentum) * s->run->scene.fluid.rho / (24.0 * 24.0);
        print_message("front over a %s: momentum %.4g, given %.4g\n", box ? "box" : "side",
                      momentum, given);
        assert_close(momentum, given, 0.01 * given);
        fv_free(&c.s);
        blocked_given_count = 0;
    }
}

/* Water two cells deep over a floor without slip stays at rest, in a tank of 9 mm and under a weak
 * weight, too: what the air had left in memory, 1 m/s and more, was a part of products beside the
 * floor, and the run diverged in five steps. */
TEST(shallow_water_over_a_floor_without_slip_rests)
{
    const struct scene_shape pool = {.form = SHAPE_BOX, .box = {{0, 0, 0}, {8.8e-3, 2e-3, 0}}};
    struct diagnosis d = {0};
    struct fv_case c;
    fv_case_set(&c, MPI_COMM_WORLD,
                (const char *const[]){SURFACE, "fluid.gravity=(0,-6e-4)", "domain.min=(0,0)",
                                      "domain.max=(8.8e-3,11e-3)", "fv.cells=(8,10)",
                                      "fluid.nu=1e-9", NULL});
    fv_case_close(&c, WALL_NO_SLIP);
    c.run.scene.shapes[c.run.scene.nshapes++] = pool;
    struct fv *s = fv_case_start(&c, NULL);
    while (s->t < 5.0 && !d.bad)
        integrate(s, 5.0, &d);
    assert_false(d.bad);
    assert_true(fmax(s->max.u[0], s->max.u[1]) < 1e-12);
    fv_free(&c.s);
}

/* Water that falls freely has no pressure from the start on, though it moves already (that of water
 * at rest in it, at first). */
TEST(water_that_falls_has_no_pressure)
{
    const struct scene_shape block = {
        .form = SHAPE_BOX, .box = {{0.8, 0.4, 0}, {1.2, 0.7, 0}}, .velocity = {0.0, -1.0, 0.0}};
    struct fv_case c;
    struct fv *s = start_falling(&c, "domain.max=(2,1)", "fv.cells=(48,24)", &block);
    double most = 0.0, x[3];
    BLOCK_CELLS (&s->b, i, j, k, at)
        if (s->surface->layer[at] == 0) {
            block_centre(&s->b, i, j, k, x);
            most = fmax(most, fabs(fv_pressure(s, at) + fv_still_pressure(s, x)));
        }
    most = ranks_max(s->comm, most) / (s->run->scene.fluid.rho * 9.81 * 0.3);
    print_message("falling: pressure %.2g of that at rest\n", most);
    assert_true(most < 0.01);
    fv_free(&c.s);
}

/* Some steps; NULL, or why the run stopped. */
static const char *odd(const struct scene_shape *shape, int steps)
{
    static struct diagnosis d;
    struct fv_case c;
    struct fv *s =
        start(&c, MPI_COMM_WORLD,
              (const char *const[]){SURFACE, "fluid.gravity=(0,-9.81)", "fv.cells=(16,16)", NULL},
              shape, WALL_NO_SLIP);
    d = (struct diagnosis){0};
    for (int k = 0; k < steps && !d.bad; k++)
        integrate(s, 10.0, &d);
    print_message("odd water: %.3g m/s, %d wet cells %s\n", s->max.u[1], (int)s->surface->wet,
                  d.bad ? d.reason : "");
    assert_true(d.bad || isfinite(s->max.u[0] + s->max.u[1]));
    fv_free(&c.s);
    return d.bad ? d.reason : NULL;
}

/* A drop of a few cells, a surface through the corners of cells, a full tank; water that is finer
 * than the cells may stop the run, but says so. */
TEST(odd_water_runs_or_says_why_not)
{
    static const struct scene_shape runs[] = {
        {.form = SHAPE_DISC, .centre = {0.5, 0.52, 0}, .radius = 0.1},
        {.form = SHAPE_BELOW, .level = 0.5},
        {.form = SHAPE_BELOW, .level = 0.53125}, /* through centres */
        {.form = SHAPE_BOX, .box = {{0.25, 0.25, 0}, {0.75, 0.75, 0}}},
        {.form = SHAPE_BELOW, .level = 2.0}};
    static const struct scene_shape speck = {.form = SHAPE_DISC,
                                             .centre = {0.5, 0.52, 0},
                                             .radius = 0.05},
                                    none = {.form = SHAPE_BELOW, .level = -1.0};
    for (int k = 0; k < 5; k++)
        assert_null(odd(runs + k, 6));
    odd(&speck, 6);
    assert_non_null(odd(&none, 1));
}
