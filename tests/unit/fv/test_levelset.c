/* test_levelset.c - a disc keeps its place and size under advection and reinitialisation; the
 * pressure with a surface is second order; still water stays still; a wave swings as theory says,
 * also where two cross; columns survive their impacts;
 * ranks change nothing but rounding, a restart nothing at all. ranks: 1 2.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../fv/poisson/poisson.h"
#include "fv_restart.h"
#include "surface_case.h"

typedef double (*function)(const double *x);

/* A box of n cells a side with a disc of water. */
static struct fv *disc(struct fv_case *c, int n, double x, double y, double radius)
{
    char cells[64];
    snprintf(cells, sizeof cells, "fv.cells=(%d,%d)", n, n);
    const struct scene_shape shape = {.form = SHAPE_DISC, .centre = {x, y, 0.0}, .radius = radius};
    return start(c, MPI_COMM_WORLD,
                 (const char *const[]){SURFACE, cells, "fv.volume=\"shift\"", NULL}, &shape,
                 WALL_SLIP);
}

static void set(struct fv *s, double *field, function f)
{
    const struct block *b = &s->b;
    double x[3];
    for (int k = -b->g[2]; k < b->n[2] + b->g[2]; k++)
        for (int j = -b->g[1]; j < b->n[1] + b->g[1]; j++)
            for (int i = -b->g[0]; i < b->n[0] + b->g[0]; i++) {
                block_centre(b, i, j, k, x);
                field[block_at(b, i, j, k)] = f(x);
            }
}

/* Share of the step d behind which the cubic through q[-d] .. q[2 d] is 0, by bisection. */
static double crossing_at(const double *q, int64_t d)
{
    double low = 0.0, high = 1.0;
    for (int k = 0; k < 50; k++) {
        const double t = 0.5 * (low + high);
        const double v = -t * (t - 1.0) * (t - 2.0) / 6.0 * q[-d] +
                         (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0 * q[0] -
                         (t + 1.0) * t * (t - 2.0) / 2.0 * q[d] +
                         (t + 1.0) * t * (t - 1.0) / 6.0 * q[2 * d];
        *((v < 0.0) == (q[0] < 0.0) ? &low : &high) = t;
    }
    return low;
}

/* Largest distance of the surface on the grid's lines from the circle, m. */
static double off_circle(const struct fv *s, double x0, double y0, double radius)
{
    const struct block *b = &s->b;
    const double *phi = s->surface->phi;
    double most = 0.0, x[3];
    for (int j = 0; j < b->n[1]; j++)
        for (int i = 0; i < b->n[0]; i++)
            for (int a = 0; a < 2; a++) {
                const int64_t c = block_at(b, i, j, 0), d = b->stride[a];
                if ((phi[c] < 0.0) == (phi[c + d] < 0.0))
                    continue;
                block_centre(b, i, j, 0, x);
                x[a] += crossing_at(phi + c, d) * b->h[a];
                most = fmax(most, fabs(hypot(x[0] - x0, x[1] - y0) - radius));
            }
    return ranks_max(MPI_COMM_WORLD, most);
}

/* Once around the middle of the box; *lost: share of the volume. */
static double turned(int n, double *lost)
{
    struct fv_case c;
    struct fv *s = disc(&c, n, 0.5, 0.7, 0.17);
    const double h = s->b.h[0], dt = 0.5 * h / M_PI;
    const int steps = (int)ceil(1.0 / dt);
    double x[3];
    s->max.rate = 2.0 * M_PI / h;
    DROP(s->whole.near), DROP(s->whole.wet); /* all cells move */
    for (int j = -3; j < s->b.n[1] + 3; j++)
        for (int i = -3; i < s->b.n[0] + 3; i++) {
            const int64_t at = block_at(&s->b, i, j, 0);
            block_centre(&s->b, i, j, 0, x);
            s->u[0][at] = -2.0 * M_PI * (x[1] - 0.5);
            s->u[1][at] = 2.0 * M_PI * (x[0] - 0.5);
        }
    const double volume = surface_volume(s);
    for (int k = 0; k < steps; k++) {
        surface_advance(s, 1.0 / steps);
        if (s->surface->travelled > 2.0)
            surface_reinit(s, 10);
    }
    const double off = off_circle(s, 0.5, 0.7, 0.17);
    *lost = fabs(surface_volume(s) / volume - 1.0);
    print_message("disc, %d cells: %.3g h off, volume %.3g\n", n, off / h, *lost);
    fv_free(&c.s);
    assert_close(off, 0.0, 0.02 * h);
    return off;
}

TEST(disc_turns_once)
{
    double lost[2];
    const double coarse = turned(32, lost), fine = turned(64, lost + 1);
    assert_true(coarse / fine > 3.5);
    assert_true(lost[0] < 0.005 && lost[1] < lost[0] / 4.0);
}

/* Russo & Smereka's example: distance to a circle times something far from 1. */
static double bent(const double *x)
{
    const double r = hypot(x[0] - 0.52, x[1] - 0.49);
    return (r * r - 0.09) * (1.0 + 4.0 * (x[0] - 0.2) * (x[0] - 0.2) + 8.0 * x[1] * x[1]);
}

/* Largest | |grad phi| - 1 | within two cells of the surface. */
static double distortion(const struct fv *s)
{
    const double h = s->b.h[0];
    double most = 0.0;
    FLOW_ROWS (s, c, n)
        for (int64_t i = c; i < c + n; i++) {
            const double *q = s->surface->phi + i;
            const int64_t up = s->b.stride[1];
            if (fabs(q[0]) < 2.0 * h)
                most = fmax(most, fabs(hypot(q[1] - q[-1], q[up] - q[-up]) / (2.0 * h) - 1.0));
        }
    return most;
}

static double moved(int n)
{
    struct fv_case c;
    struct fv *s = disc(&c, n, 0.52, 0.49, 0.3);
    set(s, s->surface->phi, bent);
    surface_ghosts(s, s->surface->phi);
    surface_reinit(s, 100);
    const double off = off_circle(s, 0.52, 0.49, 0.3), slope = distortion(s);
    print_message("reinit, %d cells: %.3g h off, |grad phi| - 1: %.3g\n", n, off * n, slope);
    assert_close(slope, 0.0, 0.1);
    fv_free(&c.s);
    return off;
}

TEST(reinit_does_not_move_the_surface)
{
    const double coarse = moved(32), fine = moved(64);
    assert_close(fine * 64.0, 0.0, 0.02);
    assert_true(coarse / fine > 3.5);
}

/* What the distances that are set at once move the surface by, of h; R = 0.3. */
static double moved_at_once(int n)
{
    struct fv_case c;
    struct fv *s = disc(&c, n, 0.52, 0.49, 0.3);
    set(s, s->surface->phi, bent);
    const double h = s->b.h[0], before = off_circle(s, 0.52, 0.49, 0.3);
    double worst = 0.0, x[3], d;
    int known = 0;
    surface_ghosts(s, s->surface->phi);
    surface_note_bends(s, s->surface->phi);
    BLOCK_CELLS (&s->b, i, j, k, at) {
        block_centre(&s->b, i, j, k, x);
        const double r = hypot(x[0] - 0.52, x[1] - 0.49) - 0.3;
        if (!(fabs(r) < 1.4 * h) || !surface_closest(s, s->grid.part, s->surface->phi, at, &d))
            continue;
        worst = fmax(worst, fabs(d - r));
        known++;
    }
    worst = ranks_max(MPI_COMM_WORLD, worst);
    MPI_Allreduce(MPI_IN_PLACE, &known, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    print_message("closest points, %d cells: %.3g h off (%.3g before), %d of them\n", n, worst / h,
                  before / h, known);
    assert_true(known > 0.3 * 2.8 * 2.0 * M_PI * 0.3 / h); /* slopes of 2 and more are not */
    fv_free(&c.s);
    return worst;
}

TEST(closest_points_are_of_fourth_order)
{
    const double coarse = moved_at_once(32), fine = moved_at_once(64);
    assert_close(coarse * 32.0, 0.0, 1e-3);
    assert_true(log2(coarse / fine) > 3.0);
}

/* Water, or air under a lid, that is thinner than a cell. */
TEST(films_on_sides_have_their_volume)
{
    static const double level[] = {0.75 / 16.0, 0.45 / 16.0, 1.0 - 0.3 / 16.0};
    for (int k = 0; k < 3; k++) {
        struct fv_case c;
        const struct scene_shape shape = {.form = SHAPE_BELOW, .level = level[k]};
        struct fv *s = start(
            &c, MPI_COMM_WORLD,
            (const char *const[]){SURFACE, "fluid.gravity=(0,-9.81)", "fv.cells=(16,16)", NULL},
            &shape, WALL_SLIP);
        assert_close(surface_volume(s), level[k], 1e-4 * level[k] + 1e-3 / 16.0);
        fv_free(&c.s);
    }
}

/* Poisson with the given pressure on a circle: psi = cos(3 x) cosh(2 y) + x. */
static double solution(const double *x) { return cos(3.0 * x[0]) * cosh(2.0 * x[1]) + x[0]; }

static double off_solution(int n)
{
    struct fv_case c;
    struct fv *s = disc(&c, n, 0.51, 0.48, 0.31);
    const struct block *b = &s->b;
    struct surface *f = s->surface;
    double *psi = block_field(b), *div = block_field(b), x[3], most = 0.0;
    for (int a = 0; a < 2; a++)
        for (int64_t i = 0; i < f->ncut[a]; i++) {
            struct cut *q = f->cut[a] + i;
            const int64_t at = q->wet;
            block_centre(b, (int)(at % b->stride[1]) - b->g[0], (int)(at / b->stride[1]) - b->g[1],
                         0, x);
            x[a] += q->up * q->theta * b->h[a];
            q->p = solution(x);
        }
    for (int j = 0; j < b->n[1]; j++)
        for (int i = 0; i < b->n[0]; i++) {
            block_centre(b, i, j, 0, x);
            div[block_at(b, i, j, 0)] = -5.0 * cos(3.0 * x[0]) * cosh(2.0 * x[1]);
        }
    surface_add_pressure(s, div);
    poisson_solve(s, 1.0, div, 1e-10, NULL, psi);
    for (int j = 0; j < b->n[1]; j++)
        for (int i = 0; i < b->n[0]; i++) {
            const int64_t at = block_at(b, i, j, 0);
            block_centre(b, i, j, 0, x);
            if (f->layer[at] == 0)
                most = fmax(most, fabs(psi[at] - solution(x)));
        }
    FREE(psi, div);
    fv_free(&c.s);
    return ranks_max(MPI_COMM_WORLD, most);
}

TEST(pressure_is_second_order)
{
    const double coarse = off_solution(32), fine = off_solution(128);
    print_message("pressure: %.3g, %.3g: order %.2f\n", coarse, fine,
                  0.5 * fv_case_order(coarse, fine));
    assert_true(0.5 * fv_case_order(coarse, fine) > 1.8);
}

/* Water drawn up to the walls and beyond them is the same: phi is the distance of its surface. */
TEST(walls_are_no_surface)
{
    static const double corners[2][4][2] = {{{0, 0}, {0, 0.3}, {1, 0.4}, {1, 0}},
                                            {{-1, -1}, {-1, 0.2}, {2, 0.5}, {2, -1}}};
    for (int k = 0; k < 2; k++) {
        struct fv_case c;
        double x[3], most = 0.0;
        struct scene_shape water = {.form = SHAPE_POLYGON, .points.n = 4};
        memcpy(water.points.x, corners[k], sizeof corners[k]);
        struct fv *s = start(
            &c, MPI_COMM_WORLD,
            (const char *const[]){SURFACE, "fluid.gravity=(0,-9.81)", "fv.cells=(24,24)", NULL},
            &water, WALL_SLIP);
        BLOCK_CELLS (&s->b, i, j, l, at) {
            block_centre(&s->b, i, j, l, x);
            const double far = (x[1] - 0.3 - 0.1 * x[0]) / hypot(1.0, 0.1);
            most = fmax(most, fabs(surface_distance(s, x) - far));
            (void)at;
        }
        assert_close(ranks_max(MPI_COMM_WORLD, most), 0.0, 1e-12);
        fv_free(&c.s);
    }
}

TEST(still_water_stays)
{
    static const double slope[] = {0.0, 0.3, -1.0};
    for (int dim = 2; dim <= 3; dim++)
        for (int k = 0; k < 3; k++) {
            struct fv_case c;
            char gravity[96];
            /* gravity askew: the surface cuts the cells in all ways */
            snprintf(gravity, sizeof gravity,
                     dim == 2 ? "fluid.gravity=(%g,-9.81)" : "fluid.gravity=(%g,1.3,-9.81)",
                     9.81 * slope[k]);
            const struct scene_shape shape = {.form = SHAPE_BELOW, .level = k == 0 ? 0.4123 : 0.2};
            struct fv *s = start(
                &c, MPI_COMM_WORLD,
                (const char *const[]){SURFACE, gravity, dim == 2 ? "domain.dim=2" : "domain.dim=3",
                                      dim == 2 ? "fv.cells=(24,20)" : "fv.cells=(12,10,16)", NULL},
                &shape, WALL_NO_SLIP);
            assert_true(fv_case_run(&c, 5, 10.0));
            print_message("still water, %dD: %.3g m/s\n", dim, s->max.u[0]);
            for (int a = 0; a < dim; a++)
                assert_close(s->max.u[a], 0.0, 1e-10);
            fv_free(&c.s);
        }
}

/* A film down a slope of 60 degrees, along a periodic axis: what the floor holds back is its weight
 * along the slope (Nusselt), it stays as thick as it was, and its speed is a parabola's. */
TEST(films_run_as_theory_says)
{
    static const char *const of[3] = {"fv.integrator=\"rk3\"", "fv.integrator=\"bdf2\"",
                                      "fv.integrator=\"newton\""};
    for (int k = SANITIZED ? 2 : 0; k < 3; k++) {
        struct fv_case c;
        double force[4];
        fv_case_set(&c, MPI_COMM_SELF,
                    (const char *const[]){"fv.surface=\"yes\"", "initial.field=\"rest\"",
                                          "fluid.nu=0.5", "domain.periodic=(true,false)",
                                          "fv.cells=(4,12)", of[k], NULL});
        c.run.scene.fluid.gravity[0] = sqrt(0.75);
        c.run.scene.fluid.gravity[1] = -0.5;
        wall_add(&c, SIDE_Y_MIN, WALL_NO_SLIP, 0.0);
        wall_add(&c, SIDE_Y_MAX, WALL_SLIP, 0.0);
        c.run.scene.shapes[c.run.scene.nshapes++] =
            (struct scene_shape){.form = SHAPE_BOX, .box = {{-1, -1, 0}, {2, 0.5, 0}}};
        struct fv *s = fv_case_start(&c, NULL);
        assert_true(fv_case_run(&c, 2000, 10.0));
        flow_forces(s, NULL, force);
        print_message("film: friction %.9f of its weight, %.6f m/s\n", force[0] / sqrt(0.1875),
                      s->max.u[0]);
        assert_close(force[0], sqrt(0.75) * 0.5, 1e-4);
        assert_close(force[1], -0.25, 1e-9);
        assert_close(s->max.u[0], sqrt(0.75) * 0.25 / (2.0 * 0.5),
                     0.004); /* in the middle of a cell */
        assert_close(surface_volume(s), 0.5, 1e-12);
        fv_free(&c.s);
    }
}

/* Films down a slope of 30 degrees, from the middle of one cell to the middle of the next but one,
 * level with a centre, too: each rubs by its weight, alike all along. */
TEST(thin_films_rub_at_any_level)
{
    static const double cells[] = {1.8, 2.0, 2.25, 2.5, 2.6, 2.75, 3.0, 3.25, 3.5, 3.6};
    for (size_t k = 0; k < sizeof cells / sizeof *cells; k += SANITIZED ? 4 : 1) {
        struct fv_case c;
        double force[4];
        fv_case_set(&c, MPI_COMM_SELF,
                    (const char *const[]){"fv.surface=\"yes\"", "initial.field=\"rest\"",
                                          "fluid.nu=0.5", "domain.periodic=(true,false)",
                                          "fv.cells=(8,10)", NULL});
        c.run.scene.fluid.gravity[0] = 0.5;
        c.run.scene.fluid.gravity[1] = -sqrt(0.75);
        wall_add(&c, SIDE_Y_MIN, WALL_NO_SLIP, 0.0);
        wall_add(&c, SIDE_Y_MAX, WALL_SLIP, 0.0);
        c.run.scene.shapes[c.run.scene.nshapes++] =
            (struct scene_shape){.form = SHAPE_BOX, .box = {{-1, -1, 0}, {2, 0.1 * cells[k], 0}}};
        struct fv *s = fv_case_start(&c, NULL);
        assert_true(fv_case_run(&c, 4000, 2.0));
        flow_forces(s, NULL, force);
        print_message("film of %g cells: friction %.6f of its weight\n", cells[k],
                      force[0] / (0.05 * cells[k]));
        assert_close(force[0] / (0.05 * cells[k]), 1.0, 1e-3);
        fv_free(&c.s);
    }
}

/* A wedge of 45 degrees: its foot on the bottom, not where it is half a cell above. */
TEST(reach_is_that_on_the_wall)
{
    struct fv_case c;
    const struct scene_shape wedge = {
        .form = SHAPE_POLYGON,
        .points = {.n = 3, .x = {{-2.0, -1.0}, {1.713, -1.0}, {-2.0, 2.713}}}};
    struct fv *s = start(&c, MPI_COMM_WORLD,
                         (const char *const[]){SURFACE, "fluid.gravity=(0,-9.81)", "domain.dim=2",
                                               "fv.cells=(16,16)", NULL},
                         &wedge, WALL_SLIP);
    assert_close(surface_reach(s, 0), 0.713, 0.05 / 16.0);
    assert_close(surface_reach(s, 1), 0.713, 0.05 / 16.0);
    fv_free(&c.s);
}

#define THICK_WAVE WAVE, "fluid.nu=2e-3"

/* The surface through graded rows, upright and askew. */
TEST(still_water_stays_on_graded_rows)
{
    static const double slope[] = {0.0, 0.3};
    for (int k = 0; k < 2; k++) {
        struct fv_case c;
        char gravity[96];
        snprintf(gravity, sizeof gravity, "fluid.gravity=(%g,-9.81)", 9.81 * slope[k]);
        const struct scene_shape shape = {.form = SHAPE_BELOW, .level = 0.4123};
        struct fv *s = start(
            &c, MPI_COMM_WORLD,
            (const char *const[]){SURFACE, gravity, "fv.cells=(24,20)", "fv.graded=(0.75,7)", NULL},
            &shape, WALL_NO_SLIP);
        const double volume = surface_volume(s);
        if (k == 0)
            assert_close(volume, 0.4123, 1e-3);
        assert_true(fv_case_run(&c, 5, 10.0));
        print_message("still water on graded rows: %.3g m/s, volume %.6g\n", s->max.u[0], volume);
        for (int a = 0; a < 2; a++)
            assert_close(s->max.u[a], 0.0, 1e-10);
        fv_free(&c.s);
    }
}

/* A disc that is carried down through rows that grow, with a uniform velocity: it stays a disc of
 * its size. */
TEST(disc_sinks_through_graded_rows)
{
    struct fv_case c;
    double x[3], area, worst = 0.0;
    const struct scene_shape shape = {
        .form = SHAPE_DISC, .centre = {0.5, 0.75, 0.0}, .radius = 0.15};
    struct fv *s =
        start(&c, MPI_COMM_WORLD,
              (const char *const[]){SURFACE, "fv.cells=(64,48)", "fv.graded=(0.7,24)", NULL},
              &shape, WALL_SLIP);
    const double before = surface_level_volume(s, &area), dt = 0.005;
    assert_close(before, M_PI * 0.15 * 0.15, 2e-3);
    s->max.rate = 1.0 / s->b.h[1];
    DROP(s->whole.near), DROP(s->whole.wet); /* all cells move */
    for (int k = 0; k < 80; k++) {           /* by 0.4 */
        for (int64_t i = 0; i < s->b.size; i++)
            s->u[1][i] = -1.0;
        surface_advance(s, dt);
        if (k % 10 == 9)
            surface_reinit(s, 10);
    }
    BLOCK_CELLS (&s->b, i, j, k, at) {
        block_centre(&s->b, i, j, k, x);
        const double r = hypot(x[0] - 0.5, x[1] - 0.35) - 0.15;
        worst = fabs(r) < s->b.h[0] ? fmax(worst, fabs(s->surface->phi[at] - r)) : worst;
    }
    MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    const double after = surface_level_volume(s, &area);
    const double lowest = s->b.rows->edge[1] - s->b.rows->edge[0];
    print_message("disc: %.3g rows off, volume %.3g\n", worst / lowest, after / before - 1.0);
    assert_true(worst < 0.1 * lowest);
    assert_close(after, before, 5e-3);
    fv_free(&c.s);
}

/* A current from an inlet to an outlet, whose water stands at the level: uniform, it stays; from
 * rest it swings, and what is there is what was, and came in, and went out. */
TEST(currents_pass_openings)
{
    for (int k = 0; k < 3; k++) { /* uniform; from rest; uniform over graded rows */
        struct fv_case c;
        fv_case_set(&c, MPI_COMM_WORLD,
                    (const char *const[]){
                        "fv.surface=\"yes\"", CLOSED, "fluid.gravity=(0,-9.81)", "fv.cells=(40,24)",
                        k == 2 ? "fv.graded=(0.6,12)" : "fv.graded=(0,0)", "domain.max=(2,1)",
                        "fluid.nu=1e-4", "initial.level=0.5",
                        k == 1 ? "initial.field=\"rest\"" : "initial.field=\"uniform\"",
                        k == 1 ? "initial.U=0.1" : "initial.velocity=(0.5,0)", NULL});
        const double U = k == 1 ? 0.1 : 0.5;
        wall_add(&c, SIDE_X_MIN, WALL_INFLOW, U);
        wall_add(&c, SIDE_X_MAX, WALL_OUTFLOW, 0.0);
        wall_add(&c, SIDE_Y_MIN, WALL_SLIP, 0.0);
        wall_add(&c, SIDE_Y_MAX, WALL_SLIP, 0.0);
        c.run.scene.shapes[c.run.scene.nshapes++] =
            (struct scene_shape){.form = SHAPE_BELOW, .level = 0.5};
        struct fv *s = fv_case_start(&c, NULL);
        const double before = surface_volume(s);
        assert_true(fv_case_run(&c, 10000, k == 1 ? 4.0 : 1.0));
        const double after = surface_volume(s), passed = s->surface->passed;
        print_message("current: %.6g m/s, volume %.6g to %.6g, passed %.4g, put back %.3g\n",
                      s->max.u[0], before, after, passed, s->surface->returned);
        assert_close(before, 1.0, 1e-6);
        const double exact = k == 2 ? 1e-3 : 1e-9; /* distance is rebuilt to h^2 on graded rows */
        assert_true(k == 1 || fabs(s->max.u[0] - U) + fabs(s->max.u[1]) < exact);
        assert_true(k == 1 || fabs(passed - 0.5) < exact);
        assert_close(after, s->surface->volume0, 1e-6);
        assert_true(fabs(after - 1.0) < 0.05 && fabs(s->surface->returned) < 0.01 * passed);
        fv_free(&c.s);
    }
}

TEST_ALONE(wave_swings_as_theory_says)
{
    if (!is_alone() || SANITIZED)
        skip();
    struct fv_case c;
    double period, rate;
    for (int graded = 0; graded < 2;
         graded++) { /* there the layer at the bottom, which damps, is coarse */
        struct fv *s =
            start(&c, MPI_COMM_WORLD,
                  (const char *const[]){THICK_WAVE, "fv.cells=(32,40)",
                                        graded ? "fv.graded=(1.1,8)" : "fv.graded=(0,0)", NULL},
                  NULL, WALL_NO_SLIP);
        assert_true(exact_oscillation(&s->exact, &period, &rate));
        assert_true(fv_case_run(&c, 10000, 1.9 * period));
        const double T = fit_period(&s->surface->oscillation) / period - 1.0,
                     r = fit_rate(&s->surface->oscillation) / rate - 1.0,
                     v = surface_volume(s) / s->surface->volume0 - 1.0;
        print_message("wave: period %.3g, damping %.3g, volume %.3g\n", T, r, v);
        fv_free(&c.s);
        assert_close(T, 0.0, 0.002);
        assert_true(graded || fabs(r) < 0.05);
        assert_close(v, 0.0, 1e-10);
    }
}

/* With rk3, then the first two with bdf2 and newton each. */
enum { WAVES, COLUMN, COLUMN_3D, IMPLICIT, FLOWS = IMPLICIT + 4 };

static struct fv *flow_start(struct fv_case *c, MPI_Comm comm, int flow, struct h5 *f)
{
    const struct scene_shape column = {.form = SHAPE_BOX, .box = {{0, 0, 0}, {0.43, 0.61, 0.57}}};
    const bool implicit = flow >= IMPLICIT, solid = flow == COLUMN_3D;
    const char *by = implicit ? integrators[flow % 2] : NULL;
    struct fv *s;
    if (flow == WAVES || flow == IMPLICIT || flow == IMPLICIT + 1)
        s = start(
            c, comm,
            (const char *const[]){THICK_WAVE, "fv.cells=(24,20)", by, "fv.tol_pressure=1e-6", NULL},
            NULL, WALL_NO_SLIP);
    else
        s = start(c, comm,
                  (const char *const[]){
                      SURFACE, solid ? "domain.dim=3" : "domain.dim=2",
                      solid ? "fluid.gravity=(0,0,-9.81)" : "fluid.gravity=(0,-9.81)",
                      solid ? "fv.cells=(12,8,14)" : "fv.cells=(26,24)", by, "fv.tol_pressure=1e-9",
                      "fv.tol_viscous=1e-9", "fv.tol_newton=1e-9", NULL},
                  &column, solid ? WALL_SLIP : WALL_NO_SLIP);
    if (f) {
        assert_true(fv_restore(s, f));
        measure(s);
    }
    return s;
}

static void sums_on(MPI_Comm comm, int flow, double sums[5])
{
    struct fv_case c;
    struct fv *s = flow_start(&c, comm, flow, NULL);
    const bool good = fv_case_run(&c, flow < IMPLICIT ? 8 : 6, 100.0);
    sums[0] = good ? surface_energy(s) : NAN;
    for (int a = 0; a < 2; a++)
        sums[1 + a] = surface_reach(s, a);
    sums[3] = s->max.u[0];
    sums[4] = s->t;
    fv_free(&c.s);
}

TEST(ranks_agree)
{
    for (int flow = 0; flow < FLOWS; flow++) {
        double alone[5], shared[5], most = 0.0;
        sums_on(MPI_COMM_SELF, flow, alone);
        sums_on(MPI_COMM_WORLD, flow, shared);
        for (int k = 0; k < 5; k++) {
            const double e = fabs(alone[k] - shared[k]) / fmax(1e-3, fabs(alone[k]));
            most = e <= most ? most : e;
        }
        most = ranks_max(MPI_COMM_WORLD, most);
        print_message("flow %d: %.3g\n", flow, most);
        assert_close(most, 0.0, flow < IMPLICIT ? 1e-9 : 1e-6);
    }
}

TEST(restart_is_exact)
{
    for (int flow = 0; flow < FLOWS; flow++)
        assert_int_equal(fv_case_restart(flow_start, flow, flow < IMPLICIT ? 5 : 4), 0);
}

/* cos cos of lengths 4 and 3 m over a no-slip bottom: half a length of each between slip sides. */
TEST_ALONE(crossed_waves_swing_as_theory_says)
{
    if (!is_alone() || SANITIZED)
        skip();
    struct fv_case c;
    double period, rate;
    fv_case_set(&c, MPI_COMM_WORLD,
                (const char *const[]){THICK_WAVE, "domain.dim=3", "fluid.gravity=(0,-1,0)",
                                      "domain.max=(2,1.25,1.5)", CLOSED, "initial.L_z=3",
                                      "fv.cells=(8,40,6)", NULL});
    struct scene *scene = &c.run.scene;
    for (int side = SIDE_X_MIN; side <= SIDE_Z_MAX; side++)
        scene->walls[scene->nwalls++] = (struct scene_wall){
            .side = side, .kind = side == SIDE_Y_MIN ? WALL_NO_SLIP : WALL_SLIP};
    struct fv *s = fv_case_start(&c, NULL);
    assert_true(exact_oscillation(&s->exact, &period, &rate));
    assert_true(fv_case_run(&c, 10000, 1.9 * period));
    const double T = fit_period(&s->surface->oscillation) / period - 1.0,
                 r = fit_rate(&s->surface->oscillation) / rate - 1.0;
    print_message("crossed waves: period %.3g, damping %.3g\n", T, r);
    fv_free(&c.s);
    assert_close(T, 0.0, 0.002);
    assert_close(r, 0.0, 0.05);
}

/* However rough the water, what carries it on over two layers is little faster. */
TEST(rough_water_is_carried_on_within_bounds)
{
    if (SANITIZED)
        skip();
    struct fv_case c;
    struct fv *s = disc(&c, 32, 0.5, 0.5, 0.3);
    double most[3] = {0.0, 0.0, 0.0};
    srand(7);
    BLOCK_CELLS (&s->b, i, j, k, at)
        for (int a = 0; a < 2; a++)
            s->u[a][at] = s->surface->layer[at] ? 0.0 : rand() / (double)RAND_MAX - 0.5;
    extension_apply(s, s->u, EXTEND_FREE, LAYERS);
    BLOCK_CELLS (&s->b, i, j, k, at) {
        const int l = s->surface->layer[at];
        if (l <= 2)
            most[l] = fmax(most[l], hypot(s->u[0][at], s->u[1][at]));
    }
    for (int l = 0; l < 3; l++)
        most[l] = ranks_max(MPI_COMM_WORLD, most[l]);
    print_message("rough water: %.3g, carried on %.3g and %.3g m/s\n", most[0], most[1], most[2]);
    fv_free(&c.s);
    assert_true(most[1] > 0.0 && most[1] <= 1.2501 * most[0]);
    assert_true(most[2] > 0.0 && most[2] <= 1.25 * 1.2501 * most[0]);
}

/* A film of two cells on a floor, whose upper half is twice as fast: nothing over it is faster
 * (2.5 m/s before, by a quadratic). */
TEST(films_are_carried_on_as_they_are)
{
    for (int dim = 2; dim <= 3; dim++) {
        struct fv_case c;
        double most = 0.0;
        fv_case_set(&c, MPI_COMM_WORLD,
                    (const char *const[]){SURFACE, "fluid.nu=0", "fluid.gravity=(0,-9.81,0)",
                                          dim == 2 ? "domain.dim=2" : "domain.dim=3",
                                          "domain.max=(1,1,1)", "fv.cells=(10,10,10)", NULL});
        fv_case_close(&c, WALL_SLIP);
        c.run.scene.shapes[c.run.scene.nshapes++] =
            (struct scene_shape){.form = SHAPE_BELOW, .level = 0.19};
        struct fv *s = fv_case_start(&c, NULL);
        BLOCK_CELLS (&s->b, i, j, k, at)
            s->u[0][at] = s->surface->layer[at] ? 0.0 : j == 0 ? 1.0 : 2.0;
        extension_apply(s, s->u, EXTEND_FREE, LAYERS);
        BLOCK_CELLS (&s->b, i, j, k, at)
            most = fmax(most, s->u[0][at]);
        most = ranks_max(MPI_COMM_WORLD, most);
        fv_free(&c.s);
        print_message("film in %dD: carried on with %.3g m/s\n", dim, most);
        assert_close(most, 2.0, 1e-12);
    }
}

/* Columns of water that fall and hit sides, lid and each other: on coarse cells, wet bed, drop. */
TEST_ALONE(water_survives_impacts)
{
    if (!is_alone() || SANITIZED)
        skip();
    static const struct scene_shape column = {.form = SHAPE_BOX,
                                              .box = {{0, 0, 0}, {0.4, 0.6, 0.5}}},
                                    bed = {.form = SHAPE_BELOW, .level = 0.1};
    for (int k = 0; k < 2; k++) {
        struct fv_case c;
        fv_case_set(&c, MPI_COMM_WORLD,
                    (const char *const[]){SURFACE, "domain.dim=3", "fluid.nu=1e-6",
                                          "fluid.gravity=(0,-9.81,0)", "domain.max=(1,1,1)",
                                          k ? "fv.cells=(16,16,16)" : "fv.cells=(20,20,20)", NULL});
        struct scene *scene = &c.run.scene;
        fv_case_close(&c, WALL_SLIP);
        scene->shapes[scene->nshapes++] = column;
        if (k)
            scene->shapes[scene->nshapes++] = bed;
        struct fv *s = fv_case_start(&c, NULL);
        const double whole = 9.81 * s->surface->volume0 * 0.6;
        assert_true(fv_case_run(&c, 2000, k ? 1.0 : 0.6));
        const double v = surface_volume(s) / s->surface->volume0 - 1.0, K = surface_energy(s);
        print_message("impact: %d steps, volume %.3g, energy %.3g of %.3g\n", (int)c.run.step, v, K,
                      whole);
        assert_close(v, 0.0, 1e-4);
        assert_true(K < whole);
        fv_free(&c.s);
    }
}

/* Energy of a collapse in a slab, 6 cells wide. */
static double energy_of_slab(const char *periodic)
{
    static const struct scene_shape column = {.form = SHAPE_BOX,
                                              .box = {{0, 0, 0}, {0.4, 0.4, 0.15}}};
    struct fv_case c;
    fv_case_set(&c, MPI_COMM_WORLD,
                (const char *const[]){SURFACE, "domain.dim=3", "fluid.nu=0",
                                      "fluid.gravity=(0,-9.81,0)", "domain.max=(1.6,0.8,0.15)",
                                      "fv.cells=(64,32,6)", periodic, NULL});
    fv_case_close(&c, WALL_SLIP);
    c.run.scene.shapes[c.run.scene.nshapes++] = column;
    struct fv *s = fv_case_start(&c, NULL);
    assert_true(fv_case_run(&c, SANITIZED ? 2 : 2000, 0.2));
    const double K = surface_energy(s);
    fv_free(&c.s);
    return K;
}

/* A slip side is a plane of symmetry (0.6 % apart where water beside it was taken for a film); what
 * is left are steps: 0.1 to 0.3 % at other ends. */
TEST(a_slab_between_slip_sides_is_one_of_a_period)
{
    const double slip = energy_of_slab(CLOSED),
                 periodic = energy_of_slab("domain.periodic=(false,false,true)");
    print_message("slab: energy %.6g, of a period %.6g\n", slip, periodic);
    assert_close(slip, periodic, 0.004 * periodic);
}

/* Water in a corner of a box of flat cells, its axes put on by `way'; most gets |u| along those of
 * the first. */
static void collapse(int dim, int way, double *most)
{
    static const int n[3] = {16, 10, 6};
    static const double box[3] = {0.43, 0.61, 0.57}, g[3] = {0.0, -9.81, 0.0};
    const int count = dim == 2 ? 2 : 3;
    struct fv_case c;
    struct scene_shape column = {.form = SHAPE_BOX};
    double turned[3] = {0.0};
    int cells[3] = {1, 1, 1};
    char text[2][96];
    for (int a = 0; a < count; a++) {
        const int to = (a + way) % count;
        cells[to] = n[a];
        turned[to] = g[a];
        column.box[1][to] = box[a];
    }
    snprintf(text[0], sizeof text[0], dim == 2 ? "fv.cells=(%d,%d)" : "fv.cells=(%d,%d,%d)",
             cells[0], cells[1], cells[2]);
    snprintf(text[1], sizeof text[1],
             dim == 2 ? "fluid.gravity=(%g,%g)" : "fluid.gravity=(%g,%g,%g)", turned[0], turned[1],
             turned[2]);
    struct fv *s = start(&c, MPI_COMM_WORLD,
                         (const char *const[]){SURFACE, text[0], text[1], "fv.tol_pressure=1e-9",
                                               dim == 2 ? "domain.dim=2" : "domain.dim=3", NULL},
                         &column, WALL_SLIP);
    assert_true(fv_case_run(&c, 5, 10.0));
    for (int a = 0; a < count; a++)
        most[a] = ranks_max(MPI_COMM_WORLD, s->max.u[(a + way) % count]);
    fv_free(&c.s);
}

/* No axis comes before another, where cells are not cubes either. */
TEST(axes_are_alike)
{
    for (int dim = 2; dim <= 3; dim++) {
        double base[3], other[3];
        collapse(dim, 0, base);
        for (int way = 1; way < dim; way++) {
            collapse(dim, way, other);
            for (int a = 0; a < dim; a++)
                assert_close(other[a], base[a], 1e-6 * base[1]);
        }
    }
}
