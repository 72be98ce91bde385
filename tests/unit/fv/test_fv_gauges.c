/* test_fv_gauges.c - gauges of velocity and discharge read averages of a cubic exactly, up to walls
 * and boxes and under a surface, whatever stands in the air; on a stretched block they are of
 * fourth order; sections through faces, on blocks, too, have what crosses the cells; levels are
 * heights against gravity. ranks: 1 2. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../fv/output/probe_flow.h"
#include "../../../fv/surface/fraction.h"
#include "../../../fv/surface/mesh_view.h"
#include "fv_bc_case.h"
#include "surface_blocks.h"

#define REST "initial.field=\"rest\"", "domain.periodic=(true,false,false)"

/* A cubic of y and its integral. */
static double cubic(double y) { return 1.0 + y * (2.0 - 3.0 * y * (1.0 - 2.0 * y)); }
static double integral(double y) { return y * (1.0 + y * (1.0 + y * (-1.0 + 1.5 * y))); }

static void add_gauge(struct scene *s, int kind, double y, double to)
{
    s->probes[s->nprobes++] =
        (struct scene_probe){.kind = kind, .at = {0.3, y, 0.0}, .to = {0.3, to, 0.0}};
}

/* Averages of the cubic below `top', m, nonsense above and in boxes. */
static void set_velocity(struct fv *s, double top)
{
    BLOCK_CELLS (&s->b, i, j, k, c) {
        double x[3], h[3];
        block_cell(&s->b, i, j, k, x, h);
        const double low = x[1] - 0.5 * h[1], high = low + h[1];
        const bool wet = x[1] < top && !is_blocked(s, c);
        s->u[0][c] = wet ? (integral(high) - integral(low)) / h[1] : 1e3;
        s->u[1][c] = 0.0;
    }
}

/* Gauges at a wall (or on a box), beside it, in the middle, and of what flows between two heights
 * that are faces of cells, also where the section goes on beyond both. x: in a period. */
static void reads_the_cubic(struct fv_case *c, double x, double low, double high, double top)
{
    double values[8];
    const double beyond = 0.5 * (high - low);
    struct scene *scene = &c->run.scene;
    add_gauge(scene, PROBE_VELOCITY, low, 0.0);
    add_gauge(scene, PROBE_VELOCITY, low + 0.013, 0.0);
    add_gauge(scene, PROBE_VELOCITY, low + 0.21, 0.0);
    add_gauge(scene, PROBE_DISCHARGE, high, low);
    add_gauge(scene, PROBE_DISCHARGE, high + beyond, low - beyond);
    for (int k = 0; k < scene->nprobes; k++)
        scene->probes[k].at[0] = scene->probes[k].to[0] = x;
    wall_add(c, SIDE_Y_MIN, WALL_NO_SLIP, 0.0);
    wall_add(c, SIDE_Y_MAX, WALL_NO_SLIP, 0.0);
    struct fv *s = fv_case_start(c, NULL);
    set_velocity(s, top);
    VALUES_OF(fv_probes_row, s, values);
    const double y[3] = {low, low + 0.013, low + 0.21};
    for (int n = 0; n < 3; n++) {
        assert_close(values[2 * n], cubic(y[n]), 1e-12);
        assert_close(values[2 * n + 1], 0.0, 1e-12);
    }
    /* 400 samples: (1/400)^2/24 of the slopes' difference, 12; 200 of the longer one */
    assert_close(fabs(values[6]), integral(high) - integral(low), 4e-6);
    assert_close(fabs(values[7]), integral(high) - integral(low), 1.6e-5);
    fv_free(&c->s);
    blocked_given_count = 0;
}

TEST(cells_and_layers)
{
    struct fv_case c;
    fv_case_set(&c, MPI_COMM_WORLD, (const char *const[]){REST, "fv.cells=(8,16)", NULL});
    reads_the_cubic(&c, 0.3, 0.0, 1.0, 2.0);
    fv_case_set(&c, MPI_COMM_WORLD,
                (const char *const[]){REST, "fv.cells=(8,24)", "fv.graded=(0.5,14)", NULL});
    reads_the_cubic(&c, 0.3, 0.0, 1.0, 2.0);
}

TEST(beside_a_box)
{
    static const double x[3] = {0.3, 0.01, 0.99}; /* between centres that the period divides, too */
    for (int k = 0; k < 3; k++) {
        struct fv_case c;
        fv_case_set(&c, MPI_COMM_WORLD, (const char *const[]){REST, "fv.cells=(8,16)", NULL});
        blocked_given[0] = (struct blocked_params){
            .name = "sill", .min = {0, 0, 0}, .max = {1, 0.25, 0}, .kind = WALL_NO_SLIP};
        blocked_given_count = 1;
        reads_the_cubic(&c, x[k], 0.25, 1.0, 2.0);
    }
}

TEST(under_a_surface)
{
    struct fv_case c;
    fv_case_set(&c, MPI_COMM_WORLD,
                (const char *const[]){REST, "fv.surface=\"yes\"", "fluid.gravity=(0,-9.81)",
                                      "fv.cells=(8,16)", NULL});
    c.run.scene.shapes[c.run.scene.nshapes++] =
        (struct scene_shape){.form = SHAPE_BELOW, .level = 0.5};
    reads_the_cubic(&c, 0.3, 0.0, 0.5, 0.5);
}

/* A gauge on the face between water and air is in the water, on whichever side it stands. */
TEST(between_water_and_air)
{
    for (int side = 0; side < 2; side++) {
        struct fv_case c;
        double value[2];
        fv_case_set(&c, MPI_COMM_WORLD,
                    (const char *const[]){"initial.field=\"rest\"", "fv.surface=\"yes\"",
                                          "domain.periodic=(false,false,false)",
                                          "fluid.gravity=(0,-9.81)", "fv.cells=(8,16)", NULL});
        for (int k = SIDE_X_MIN; k <= SIDE_Y_MAX; k++)
            wall_add(&c, k, WALL_SLIP, 0.0);
        c.run.scene.shapes[c.run.scene.nshapes++] = (struct scene_shape){
            .form = SHAPE_BOX, .box = {{0.5 * side, 0, 0}, {0.5 + 0.5 * side, 0.75, 0}}};
        c.run.scene.probes[c.run.scene.nprobes++] =
            (struct scene_probe){.kind = PROBE_VELOCITY, .at = {0.5, 0.2, 0}};
        struct fv *s = fv_case_start(&c, NULL);
        for (int64_t i = 0; i < s->size; i++)
            s->u[0][i] = 7.0;
        VALUES_OF(fv_probes_row, s, value);
        assert_close(value[0], 7.0, 1e-12);
        fv_free(&c.s);
    }
}

/* Pressure that levels off at a wall, p = 1000 + 70 (x/h)^2 above hydrostatic, is read so between
 * the wall and the first centre. */
static void reads_the_parabola(struct fv *s, const double *place, const double *value)
{
    const double rho = s->run->scene.fluid.rho, h = 1.0 / 8.0;
    for (int64_t c = 0; c < s->size; c++) {
        double x[3];
        grid_place(&s->grid, c, x);
        s->p[c] = s->p_before[c] = (1000.0 + 70.0 * x[0] * x[0] / (h * h)) / rho;
    }
    double values[3];
    VALUES_OF(fv_probes_row, s, values);
    for (int k = 0; k < 3; k++)
        assert_close(values[k], value[k] + fv_still_pressure(s, (double[]){place[k], 0.2, 0}),
                     1e-9);
}

TEST(pressure_at_walls_under_a_surface)
{
    const double place[3] = {0.0, 0.3 / 8.0, 1.0 / 8.0},
                 value[3] = {1000.0, 1000.0 + 70.0 * 0.09, 1000.0 + 70.0 * 1.25};
    const struct scene_shape water = {.form = SHAPE_BELOW, .level = 0.6};
    for (int blocks = 0; blocks < 2; blocks++) {
        struct fv_case c;
        struct mesh_case m;
        if (blocks)
            mesh_case_read(&m, MPI_COMM_WORLD,
                           "{ max = (1, 1); cells = (8, 16); " SLIP_I SLIP_J "}",
                           (const char *const[]){HEAVY, "initial.field=\"rest\"", NULL});
        else
            fv_case_set(&c, MPI_COMM_WORLD,
                        (const char *const[]){"initial.field=\"rest\"", "fv.surface=\"yes\"",
                                              "domain.periodic=(false,false,false)", HEAVY,
                                              "fv.cells=(8,16)", NULL});
        for (int k = SIDE_X_MIN; k <= SIDE_Y_MAX && !blocks; k++)
            wall_add(&c, k, WALL_SLIP, 0.0);
        struct scene *scene = blocks ? &m.run.scene : &c.run.scene;
        scene->shapes[scene->nshapes++] = water;
        for (int k = 0; k < 3; k++)
            scene->probes[scene->nprobes++] =
                (struct scene_probe){.kind = PROBE_PRESSURE, .at = {place[k], 0.2, 0}};
        struct fv *s = blocks ? mesh_case_create(&m, NULL) : fv_case_start(&c, NULL);
        reads_the_parabola(s, place, value);
        if (blocks)
            mesh_case_end(&m, &s);
        else
            fv_free(&c.s);
    }
}

/* A stream function at corners of cells with a period of eight, then within cells as fluxes have it
 * that are linear between faces. */
static double corner(int i, int j) { return sin(3.0 * ((i % 8 + 8) % 8) + 5.0 * j) + 0.1 * j * j; }

static double stream(double x, double y)
{
    const double X = 8.0 * x, Y = 10.0 * y;
    const int i = (int)floor(X), j = (int)floor(Y);
    const double a = X - i, b = Y - j;
    return (1.0 - b) * ((1.0 - a) * corner(i, j) + a * corner(i + 1, j)) +
           b * ((1.0 - a) * corner(i, j + 1) + a * corner(i + 1, j + 1));
}

/* What flows through a section is the difference of the stream function at its ends, however few
 * samples of equal parts a cell would have. */
TEST(sections_through_faces)
{
    static const double line[][4] = {{0.3, 0.0, 0.3, 1.0},    {0.25, 0.1, 0.25, 0.93},
                                     {0.11, 0.17, 0.95, 0.8}, {-0.4, 0.9, 0.7, 0.2},
                                     {0.0, 0.3, 2.1, 0.3},    {0.9, 0.5, 0.1, 0.5}};
    enum { LINES = sizeof line / sizeof line[0] };
    struct fv_case c;
    double values[LINES];
    fv_case_set(&c, MPI_COMM_WORLD, (const char *const[]){REST, "fv.cells=(8,10)", NULL});
    blocked_given[0] = (struct blocked_params){
        .name = "lid", .min = {0, 2, 0}, .max = {1, 3, 0}, .kind = WALL_NO_SLIP};
    blocked_given_count = 1;
    wall_add(&c, SIDE_Y_MIN, WALL_SLIP, 0.0);
    wall_add(&c, SIDE_Y_MAX, WALL_SLIP, 0.0);
    for (int k = 0; k < LINES; k++)
        c.run.scene.probes[c.run.scene.nprobes++] =
            (struct scene_probe){.kind = PROBE_DISCHARGE,
                                 .at = {line[k][0], line[k][1], 0.0},
                                 .to = {line[k][2], line[k][3], 0.0}};
    struct fv *s = fv_case_start(&c, NULL);
    s->step.dt = 1.0;
    for (int j = 0; j <= s->b.n[1]; j++)
        for (int i = 0; i <= s->b.n[0]; i++) {
            const int at = s->b.lo[0] + i, up = s->b.lo[1] + j;
            const int64_t face = block_at(&s->b, i, j, 0);
            s->U[0][face] = 10.0 * (corner(at, up + 1) - corner(at, up));
            s->U[1][face] = -8.0 * (corner(at + 1, up) - corner(at, up));
        }
    VALUES_OF(fv_probes_row, s, values);
    for (int k = 0; k < LINES; k++) {
        const double *x = line[k];
        assert_close(values[k], stream(x[2], x[3]) - stream(x[0], x[1]), 1e-12);
    }
    fv_free(&c.s);
    blocked_given_count = 0;
}

/* In layers, too, each has its own part of a section. */
TEST(sections_through_layers)
{
    struct fv_case c;
    fv_case_set(&c, MPI_COMM_WORLD,
                (const char *const[]){REST, "fv.cells=(8,24)", "fv.graded=(0.5,14)", NULL});
    wall_add(&c, SIDE_Y_MIN, WALL_SLIP, 0.0);
    wall_add(&c, SIDE_Y_MAX, WALL_SLIP, 0.0);
    struct fv *s = fv_case_start(&c, NULL);
    const struct scene_probe up = {.kind = PROBE_DISCHARGE, .at = {0.3, 0, 0}, .to = {0.3, 1, 0}};
    struct flow_samples f = flow_samples_of_cells(s, &up);
    assert_int_equal(f.n, 24);
    for (int k = 0; k < f.n; k++) {
        const double *e = s->b.rows->edge + k;
        assert_close(f.area[k], e[1] - e[0], 1e-14);
        assert_close(f.x[k][1], 0.5 * (e[0] + e[1]), 1e-14);
    }
    flow_samples_free(&f);
    fv_free(&c.s);
    /* in 3D each pair of parts along two axes: 8 x 6 */
    fv_case_set(&c, MPI_COMM_WORLD,
                (const char *const[]){"initial.field=\"rest\"", "domain.dim=3",
                                      "domain.periodic=(true,true,true)", "fv.cells=(8,8,6)",
                                      NULL});
    s = fv_case_start(&c, NULL);
    const struct scene_probe across = {
        .kind = PROBE_DISCHARGE, .at = {0.3, 0.93, 0.05}, .to = {0.3, 0.1, 1.0}};
    double area = 0.0;
    f = flow_samples_of_cells(s, &across);
    assert_int_equal(f.n, 8 * 6);
    for (int k = 0; k < f.n; k++)
        area += f.area[k];
    assert_close(area, 0.83 * 0.95, 1e-14);
    flow_samples_free(&f);
    fv_free(&c.s);
}

/* Error of the readings of a channel that a lid drives, u = y once steady. */
static double stretched_error(int n)
{
    char block[512];
    struct mesh_case c;
    double values[4], most = 0.0;
    snprintf(block, sizeof block,
             "{ mapping = \"stretched\"; min = (0, 0); max = (1, 1); stretch = (0, -2); cells = "
             "(8, %d); i_min = \"periodic\"; i_max = \"periodic\"; j_min = \"wall\"; j_max = "
             "\"wall\"; lid = \"j_max\"; velocity = (1, 0); }",
             n);
    const double y[2] = {0.0, 0.1};
    mesh_case_read(&c, MPI_COMM_WORLD, block,
                   (const char *const[]){"initial.field=\"rest\"", "fluid.nu=1",
                                         "domain.periodic=(true,false)", NULL});
    for (int k = 0; k < 2; k++)
        add_gauge(&c.run.scene, PROBE_VELOCITY, y[k], 0.0);
    struct fv *s = mesh_case_create(&c, NULL);
    assert_true(mesh_case_run(s, 1000, 3.0)); /* exp(-pi^2 nu t) is 1e-13 */
    VALUES_OF(fv_probes_row, s, values);
    for (int k = 0; k < 2; k++)
        most = fmax(most, fabs(values[2 * k] - y[k]));
    mesh_case_end(&c, &s);
    return most;
}

/* Water that falls into a block whose indices are turned: a gauge there, not at faces of cells, has
 * passed what stands behind it by the shares of cells. */
TEST(sections_through_turned_blocks)
{
    const struct scene_shape water = {.form = SHAPE_BOX, .box = {{0.0, 0.0}, {0.4, 0.4}}};
    const double at = 0.66, h = 0.025;
    struct mesh_case c;
    double rate, behind = 0.0;
    mesh_case_read(
        &c, MPI_COMM_WORLD,
        "{ name = \"l\"; max = (0.5, 0.7); cells = (20, 28); i_max = \"joined\"; "
        "i_min = \"slip\"; " SLIP_J
        "}, { name = \"r\"; min = (0.4, 0.1); max = (1.1, 0.6); cells = (28, 20); "
        "angle = 90.0; centre = (0.75, 0.35); j_max = \"joined\"; j_min = \"slip\"; " SLIP_I "}",
        (const char *const[]){HEAVY, "initial.field=\"rest\"", "fluid.nu=0", NULL});
    c.run.scene.shapes[c.run.scene.nshapes++] = water;
    c.run.scene.probes[c.run.scene.nprobes++] =
        (struct scene_probe){.kind = PROBE_DISCHARGE, .at = {at, 0.0, 0.0}, .to = {at, 0.7, 0.0}};
    struct fv *s = mesh_case_create(&c, NULL);
    assert_true(mesh_case_run(s, 1000, SANITIZED ? 0.3 : 0.4));
    VALUES_OF(fv_probes_row, s, &rate);
    FLOW_ROWS (s, row, n)
        for (int64_t i = row; i < row + n; i++) {
            const double beyond = s->surface->mesh->x[0][i] + 0.5 * h - at;
            behind += s->surface->fraction->C[i] * h * fmin(fmax(beyond, 0.0), h);
        }
    behind = ranks_sum(MPI_COMM_WORLD, behind);
    print_message("turned: %.7g m^2 behind a gauge that passed %.7g\n", behind, rate * s->t);
    assert_true(behind > 1e-3);
    assert_close(rate * s->t, behind, 1e-3 * behind);
    mesh_case_end(&c, &s);
}

/* Round an inner corner of joined blocks a section has what comes in. */
TEST(sections_behind_a_corner_of_blocks)
{
    struct mesh_case c;
    double rate;
    mesh_case_read(
        &c, MPI_COMM_WORLD,
        "{ max = (0.5, 0.5); cells = (10, 10); i_min = \"inflow\"; velocity = (1, 0); i_max = "
        "\"joined\"; j_max = \"joined\"; j_min = \"wall\"; }, { name = \"up\"; min = (0, 0.5); max "
        "= "
        "(0.5, 1); cells = (10, 10); i_min = \"inflow\"; velocity = (1, 0); i_max = \"slip\"; "
        "j_min = "
        "\"joined\"; j_max = \"wall\"; }, { name = \"throat\"; min = (0.5, 0); max = (1, 0.5); "
        "cells = (10, 10); i_min = \"joined\"; i_max = \"outflow\"; j_min = \"wall\"; j_max = "
        "\"wall\"; }",
        (const char *const[]){"initial.field=\"rest\"", "fluid.nu=1e-2", NULL});
    c.run.scene.probes[c.run.scene.nprobes++] = (struct scene_probe){
        .kind = PROBE_DISCHARGE, .at = {0.53, 0.0, 0.0}, .to = {0.57, 0.5, 0.0}};
    struct fv *s = mesh_case_create(&c, NULL);
    assert_true(mesh_case_run(s, 10, 100.0));
    VALUES_OF(fv_probes_row, s, &rate);
    assert_close(rate, 1.0, 1e-4);
    mesh_case_end(&c, &s);
}

TEST(stretched_blocks)
{
    const double coarse = stretched_error(16), fine = stretched_error(32);
    print_message("stretched: %.3g, %.3g\n", coarse, fine);
    assert_true(log2(coarse / fine) > 3.0);
}

/* Gauges of levels tell heights against gravity, whichever way it points. */
TEST(levels_on_blocks)
{
    for (int way = -1; way <= 1; way += 2) {
        struct mesh_case c;
        double level;
        mesh_case_read(&c, MPI_COMM_WORLD,
                       "{ min = (0, 0); max = (1, 1); cells = (8, 16); i_min = \"slip\"; i_max = "
                       "\"slip\"; j_min = \"slip\"; j_max = \"slip\"; }",
                       (const char *const[]){
                           "initial.field=\"rest\"", "fv.surface=\"yes\"",
                           way < 0 ? "fluid.gravity=(0,-9.81)" : "fluid.gravity=(0,9.81)", NULL});
        const double at_rest = way < 0 ? 0.53 : -0.47; /* the same 0.53 m of water */
        c.run.scene.shapes[c.run.scene.nshapes++] =
            (struct scene_shape){.form = SHAPE_BELOW, .level = at_rest};
        add_gauge(&c.run.scene, PROBE_LEVEL, 0.0, 0.0);
        struct fv *s = mesh_case_create(&c, NULL);
        VALUES_OF(fv_probes_row, s, &level);
        assert_close(level, at_rest, 1e-9);
        mesh_case_end(&c, &s);
    }
}

/* Between curved cells, too, water at rest stands as high as it was given, or up to a roof. */
TEST(rings_tell_the_level)
{
    struct mesh_case c;
    double value[3];
    mesh_case_read(&c, MPI_COMM_WORLD,
                   "{ mapping = \"annulus\"; radius = (0.303, 0.8); arc = (180, 360); cells = (10, "
                   "30); i_min = \"slip\"; i_max = \"slip\"; j_min = \"slip\"; j_max = \"slip\"; }",
                   (const char *const[]){"fluid.gravity=(0,-9.81)", "initial.field=\"rest\"",
                                         "fluid.nu=0", NULL});
    c.run.scene.shapes[c.run.scene.nshapes++] =
        (struct scene_shape){.form = SHAPE_BELOW, .level = -0.25};
    const double x[3] = {0.431, -0.52, 0.0};
    for (int k = 0; k < 3; k++)
        c.run.scene.probes[c.run.scene.nprobes++] =
            (struct scene_probe){.kind = PROBE_LEVEL, .at = {x[k], -0.4, 0.0}};
    struct fv *s = mesh_case_create(&c, NULL);
    VALUES_OF(fv_probes_row, s, value);
    assert_close(value[0], -0.25, 1e-9);
    assert_close(value[1], -0.25, 1e-9);
    assert_close(value[2], -0.303, 1e-4);
    mesh_case_end(&c, &s);
}
