/* test_surface_openings.c - openings below a free surface keep the level that shallow-water theory
 * gives, for as long as the run lasts, on uniform cells, graded layers and blocks.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../../../fv/watch/watches.h"
#include "../test.h"
#include "surface_blocks.h"

#define G 9.81
#define DEPTH 0.5 /* m: of the water at rest */
#define LENGTH 2.0
#define TRANSIT (LENGTH / sqrt(G * DEPTH)) /* s: of a wave from one opening to the other */

static bool floor_is_of_block;           /* of the next start: y_min is no wall of the scene */
static const struct blocked_params *box; /* of the next start; NULL: none */
static const struct scene_wall *tap;     /* likewise: an inflow above, with 0.3 m of its water */

/* Water DEPTH deep between an opening on the left and one on the right, from rest or in uniform
 * flow; blocks: "" for the uniform grid. */
static void read_case(struct mesh_case *c, const char *blocks, const char *const *with, double U,
                      const struct scene_wall *left, const struct scene_wall *right)
{
    const struct scene_wall walls[] = {
        *left,
        *right,
        tap ? *tap : (struct scene_wall){.side = SIDE_Y_MAX, .kind = WALL_SLIP},
        {.side = SIDE_Y_MIN, .kind = WALL_SLIP}};
    mesh_case_read(
        c, MPI_COMM_WORLD, blocks,
        (const char *const[]){
            "fluid.gravity=(0,-9.81)", "fluid.rho=1000", "fv.surface=\"yes\"", "domain.min=(0,0)",
            "domain.max=(2,1)", U > 0.0 ? "initial.field=\"uniform\"" : "initial.field=\"rest\"",
            *blocks ? "time.end=100" : "fv.cells=(40,24)", with[0], with[1], with[2], NULL});
    c->run.scene.initial.velocity[0] = U;
    c->run.scene.initial.velocity[1] = 0.0;
    memcpy(c->run.scene.walls, walls, sizeof walls);
    c->run.scene.nwalls = floor_is_of_block ? 3 : 4;
    c->run.scene.shapes[c->run.scene.nshapes++] =
        (struct scene_shape){.form = SHAPE_BELOW, .level = DEPTH};
    if (tap)
        c->run.scene.shapes[c->run.scene.nshapes++] =
            (struct scene_shape){.form = SHAPE_BOX,
                                 .box = {{0.8, 0.7, 0.0}, {1.2, 1.0, 0.0}},
                                 .velocity = {0.0, -2.0, 0.0}};
    blocked_given_count = box != NULL;
    if (box)
        blocked_given[0] = *box;
    fv_params_check(&c->run, &c->faults);
    if (params_report(&c->faults) > 0)
        abort();
}

static struct fv *start(struct mesh_case *c, const char *blocks, const char *const *with, double U,
                        const struct scene_wall *left, const struct scene_wall *right)
{
    read_case(c, blocks, with, U, left, right);
    return fv_create(&c->run, NULL);
}

/* m: depth behind a bore that runs into water at rest of depth H with velocity U behind it: mass
 * and momentum, C (h - H) = U h and C^2 = g h (h + H)/(2 H). */
static double depth_behind_bore(double U, double H)
{
    double low = H, high = 10.0 * H;
    for (int k = 0; k < 60; k++) {
        const double h = 0.5 * (low + high);
        *(sqrt(G * h * (h + H) / (2.0 * H)) * (h - H) > U * h ? &high : &low) = h;
    }
    return 0.5 * (low + high);
}

static double mean_level(const struct fv *s) { return surface_volume(s) / LENGTH; }

#define RK3 "fv.integrator=\"rk3\"", "fluid.nu=0"
#define BDF2 "fv.integrator=\"bdf2\"", "fluid.nu=1e-3"
static const struct {
    const char *blocks, *with[3];
} grids[] = {{"", {RK3, NULL}},     {"", {RK3, "fv.graded=(0.4,16)"}},
             {halves, {RK3, NULL}}, {stretched, {RK3, NULL}},
             {"", {BDF2, NULL}},    {halves, {BDF2, NULL}}};
enum { GRIDS = sizeof grids / sizeof grids[0] };

/* From rest the inlet opens at once: a bore runs through the outflow. What six transits leave is
 * its depth where the outflow keeps none, and what ten leave else the given level. */
TEST(levels_become_those_of_theory)
{
    static const struct {
        const char *name;
        struct scene_wall in, out;
        double bore, level; /* m/s behind the bore, at its depth; m: given */
    } pairs[] = {
#define IN .side = SIDE_X_MIN, .kind = WALL_INFLOW
#define OUT .side = SIDE_X_MAX, .kind = WALL_OUTFLOW
        {"velocity, convective", {IN, .velocity = {0.5}}, {OUT, .carried = true}, 0.5, 0.0},
        {"velocity, level", {IN, .velocity = {0.5}}, {OUT}, 0.0, 0.5},
        {"discharge, convective",
         {IN, .discharge = 0.3093597, .has_discharge = true},
         {OUT, .carried = true},
         0.5,
         0.0},
        {"discharge, level",
         {IN, .discharge = 0.25, .has_discharge = true},
         {OUT, .level = 0.52, .has_level = true},
         0.0,
         0.52},
        {"level, convective",
         {IN, .level = 0.6, .has_level = true},
         {OUT, .carried = true},
         0.0,
         0.6},
        {"level, discharge",
         {IN, .level = 0.5, .has_level = true},
         {OUT, .discharge = 0.1, .has_discharge = true},
         0.0,
         0.5}};
    for (int q = 0; q < (int)(sizeof pairs / sizeof pairs[0]); q++)
        for (int k = 0; k < GRIDS; k++) {
            struct mesh_case c;
            /* the first has been on all, the others take turns */
            if (q > 0 && k != 2 * (q % 2) && !(q == 1 && k == 4))
                continue;
            if (SANITIZED && q == 0 && k % 2 == 0)
                continue;
            struct fv *s =
                start(&c, grids[k].blocks, grids[k].with, 0.0, &pairs[q].in, &pairs[q].out);
            const double theory =
                pairs[q].bore > 0.0 ? depth_behind_bore(pairs[q].bore, DEPTH) : pairs[q].level;
            assert_true(mesh_case_run(s, 10000, (SANITIZED ? 0.5 : q == 0 ? 6.0 : 10.0) * TRANSIT));
            print_message("%s: %.5g m of %.5g m\n", pairs[q].name, mean_level(s), theory);
            if (!SANITIZED)
                assert_close(mean_level(s), theory, 0.01 * theory);
            mesh_case_end(&c, &s);
        }
}

/* Vertices of a channel 10 m x 0.8 m whose bed rises by b in its middle, as Plot3D. */
static void write_sill(const char *path, double b, int nx, int ny)
{
    FILE *f = fopen(path, "w");
    if (!f)
        abort();
    fprintf(f, "1\n%d %d\n", nx + 1, ny + 1);
    for (int a = 0; a < 2; a++)
        for (int j = 0; j <= ny; j++)
            for (int i = 0; i <= nx; i++) {
                const double x = 10.0 * i / nx, up = (double)j / ny,
                             bed = b * exp(-0.5 * (x - 5.0) * (x - 5.0));
                fprintf(f, "%.12g\n", a == 0 ? x : 0.8 * up + bed * (1.0 - up));
            }
    fclose(f);
}

/* m: highest water of a column through x. */
static double level_at(const struct fv *s, double x)
{
    double top = 0.0;
    FLOW_ROWS_AT (s, part, j, c, n)
        for (int64_t i = c; i < c + n; i++) {
            double at[3], up[3];
            const int64_t d = part->stride[1];
            const double *phi = s->surface->phi + i;
            grid_place(&s->grid, i, at);
            if (fabs(at[0] - x) > 0.11 || !(phi[0] < 0.0 && phi[d] >= 0.0))
                continue;
            grid_place(&s->grid, i + d, up);
            top = fmax(top, at[1] + (up[1] - at[1]) * phi[0] / (phi[0] - phi[d]));
        }
    return top;
}

/* A current of Froude number 0.3 over a smooth sill: the discharge leaves as it came in, levels are
 * Bernoulli's, and stay. */
TEST(current_over_a_sill_has_bernoullis_levels)
{
    const double q = 0.3 * sqrt(G * DEPTH) * DEPTH, E = DEPTH + q * q / (2.0 * G * DEPTH * DEPTH),
                 b = 0.1;
    const struct scene_wall
        in = {.side = SIDE_X_MIN, .kind = WALL_INFLOW, .discharge = q, .has_discharge = true},
        out = {.side = SIDE_X_MAX, .kind = WALL_OUTFLOW, .level = DEPTH, .has_level = true};
    static const char *const with[3] = {RK3, "domain.max=(10,0.8)"};
    double depth = DEPTH, past = 0.0;
    struct mesh_case c;
    char path[1100], blocks[200];
    for (int k = 0; k < 100; k++)
        depth = E - b - q * q / (2.0 * G * depth * depth);
    const char *dir = getenv("TEST_SCRATCH");
    snprintf(path, sizeof path, "%s/sill.xyz", dir ? dir : P_tmpdir);
    snprintf(blocks, sizeof blocks,
             "{ name = \"channel\"; mapping = \"file\"; file = \"sill.xyz\"; j_min = \"slip\"; }");
    write_sill(path, b, 50, 12);
    floor_is_of_block = true;
    struct fv *s = start(&c, blocks, with, q / DEPTH, &in, &out);
    floor_is_of_block = false;
    for (int k = 1; k <= 2; k++) {
        const double volume = surface_volume(s);
        past = s->surface->volume0;
        assert_true(mesh_case_run(s, 10000, (SANITIZED ? 0.02 : 1.0) * (k == 1 ? 30.0 : 38.0)));
        if (k == 2 && !SANITIZED)
            assert_close(surface_volume(s), volume, 0.005 * volume);
    }
    const double gained = s->surface->volume0 - past; /* over the last 8 s */
    print_message(
        "sill: crest %.5g m of %.5g m, upstream %.5g m, downstream %.5g m, %.3g m^2/s more "
        "in than out of %.3g\n",
        level_at(s, 5.0), depth + b, level_at(s, 1.0), level_at(s, 9.0), gained / 8.0, q);
    if (!SANITIZED) {
        assert_close(level_at(s, 5.0), depth + b, 0.02 * DEPTH);
        assert_close(level_at(s, 1.0), DEPTH, 0.02 * DEPTH);
        assert_close(level_at(s, 9.0), DEPTH, 0.02 * DEPTH);
        assert_close(gained / 8.0, 0.0, 0.02 * q);
    }
    remove(path);
    mesh_case_end(&c, &s);
}

/* A sill of half of the depth a metre ahead of an outflow, whose wake leaves with water that runs
 * back: nowhere is it faster than its head allows, and what is there stays. */
TEST(wakes_leave_without_gain)
{
    static const char around[] =
        "{ name = \"al\"; max = (0.8, 0.25); cells = (16, 6); i_max = \"slip\"; j_max = "
        "\"joined\"; }, "
        "{ name = \"ah\"; min = (0, 0.25); max = (0.8, 1.0); cells = (16, 16); i_max = \"joined\"; "
        "j_min = \"joined\"; }, "
        "{ name = \"b\"; min = (0.8, 0.25); max = (1.2, 1.0); cells = (8, 16); i_min = \"joined\"; "
        "i_max = \"joined\"; j_min = \"slip\"; }, "
        "{ name = \"cl\"; min = (1.2, 0.0); max = (2.0, 0.25); cells = (16, 6); i_min = \"slip\"; "
        "j_max = \"joined\"; }, "
        "{ name = \"ch\"; min = (1.2, 0.25); max = (2.0, 1.0); cells = (16, 16); i_min = "
        "\"joined\"; "
        "j_min = \"joined\"; }";
    static const struct blocked_params sill = {
        .name = "sill", .min = {0.8, 0.0, 0.0}, .max = {1.2, 0.25, 1.0}, .kind = WALL_SLIP};
    static const struct scene_wall in = {.side = SIDE_X_MIN,
                                         .kind = WALL_INFLOW,
                                         .velocity = {0.4, 0.0, 0.0}},
                                   out = {.side = SIDE_X_MAX, .kind = WALL_OUTFLOW};
    static const char *const with[3] = {RK3, NULL};
    for (int blocks = 0; blocks < 2; blocks++) {
        struct mesh_case c;
        box = blocks ? NULL : &sill;
        struct fv *s = start(&c, blocks ? around : "", with, 0.4, &in, &out);
        double fastest = 0.0, least = INFINITY, most = 0.0;
        for (int k = 1; k <= (SANITIZED ? 2 : 30); k++) {
            assert_true(mesh_case_run(s, 10000, 0.5 * k));
            fastest = fmax(fastest, hypot(s->max.u[0], s->max.u[1]));
            least = fmin(least, mean_level(s));
            most = fmax(most, mean_level(s));
        }
        print_message("wake of a sill: %.3g m/s, level %.3g to %.3g m\n", fastest, least, most);
        assert_true(fastest < sqrt(2.0 * G * most + 0.16));
        assert_true(most - least < 0.1 * DEPTH);
        assert_true(s->watches->has_energy && s->watches->energy.worst < 0.01);
        box = NULL;
        mesh_case_end(&c, &s);
    }
}

/* What openings know of the past is in restart files. */
TEST(restart_is_exact)
{
    static const struct scene_wall inlets[] = {
        {.side = SIDE_X_MIN, .kind = WALL_INFLOW, .velocity = {0.5, 0.0, 0.0}},
        {.side = SIDE_X_MIN, .kind = WALL_INFLOW, .discharge = 0.25, .has_discharge = true},
        {.side = SIDE_X_MIN, .kind = WALL_INFLOW, .velocity = {3.0, 0.0, 0.0}}};
    for (int k = 0; k < 12; k += SANITIZED ? 5 : 1) {
        const struct scene_wall in = inlets[k / 4];
        const struct scene_wall out = {.side = SIDE_X_MAX, .kind = WALL_OUTFLOW, .carried = k % 2};
        struct mesh_case one, again;
        struct fv *s = start(&one, k / 2 % 2 ? halves : "", grids[0].with, 0.0, &in, &out);
        read_case(&again, k / 2 % 2 ? halves : "", grids[0].with, 0.0, &in, &out);
        assert_int_equal(mesh_case_restart(&one, s, &again, 8), 0);
    }
}

/* An inflow that is faster than its waves brings in the water of the start and no more, into a
 * closed tank whose water soon stands above it and falls back on it. */
TEST(fast_inflow_feeds_nothing_but_its_own_water)
{
    const double u = 3.0, q = u * DEPTH, end = SANITIZED ? 0.05 : 0.5;
    const struct scene_wall inlets[] = {
        {.side = SIDE_X_MIN, .kind = WALL_INFLOW, .velocity = {u, 0.0, 0.0}},
        {.side = SIDE_X_MIN, .kind = WALL_INFLOW, .discharge = q, .has_discharge = true}};
    const struct scene_wall closed = {.side = SIDE_X_MAX, .kind = WALL_SLIP};
    for (int k = 0; k < 2 * GRIDS; k += SANITIZED ? 5 : 1) {
        struct mesh_case c;
        if (k % 2 == 0 && *grids[k / 2].blocks) /* refused: nothing leaves */
            continue;
        struct fv *s =
            start(&c, grids[k / 2].blocks, grids[k / 2].with, 0.0, inlets + k % 2, &closed);
        const double before = surface_volume(s);
        assert_true(mesh_case_run(s, 10000, end));
        const double passed = surface_volume(s) - before;
        print_message("%.6g m^2 of %g, put back %.2g\n", passed, q * end, s->surface->returned);
        assert_close(passed, q * end, 1e-3 * q * end);
        mesh_case_end(&c, &s);
    }
}

/* Water falls from an inflow above into a pool. */
TEST(water_falls_from_an_inflow_above)
{
    const double u = 2.0, width = 0.4, end = SANITIZED ? 0.05 : 0.5;
    const struct scene_wall above = {.side = SIDE_Y_MAX,
                                     .kind = WALL_INFLOW,
                                     .discharge = u * width,
                                     .has_discharge = true},
                            left = {.side = SIDE_X_MIN, .kind = WALL_SLIP},
                            right = {.side = SIDE_X_MAX, .kind = WALL_SLIP};
    for (int k = 0; k < 3; k++) {
        struct mesh_case c;
        tap = &above;
        struct fv *s = start(&c, grids[k].blocks, grids[k].with, 0.0, &left, &right);
        const double before = surface_volume(s);
        assert_true(mesh_case_run(s, 10000, end));
        const double passed = surface_volume(s) - before;
        print_message("%.6g m^2 of %g\n", passed, u * width * end);
        assert_close(passed, u * width * end, 1e-3 * u * width * end);
        tap = NULL;
        mesh_case_end(&c, &s);
    }
}

/* Steps that are taken back, as those of the trial in a coupled job, leave no trace: the same steps
 * again have the same bits. Waves leave through the openings, which know the flow of the past. */
TEST(steps_taken_back_leave_no_trace)
{
    for (int k = 0; k < 8; k++) {
        const struct scene_wall in = {.side = SIDE_X_MIN,
                                      .kind = WALL_INFLOW,
                                      .velocity = {k / 4 ? 3.0 : 0.5, 0.0, 0.0}},
                                out = {.side = SIDE_X_MAX, .kind = WALL_OUTFLOW, .carried = k % 2};
        struct mesh_case c;
        struct fv *s = start(&c, k / 2 % 2 ? halves : "", grids[0].with, 0.0, &in, &out);
        struct kept *kept = kept_create(s);
        double *once = NEW(double, 3 * s->size);
        assert_true(mesh_case_run(s, 8, 100.0));
        kept_take(kept, s);
        assert_true(mesh_case_run(s, 4, 100.0));
        const double *const then[] = {s->u[0], s->p, s->surface->phi};
        for (int f = 0; f < 3; f++)
            memcpy(once + f * s->size, then[f], (size_t)s->size * sizeof *once);
        kept_put_back(kept, s);
        assert_true(mesh_case_run(s, 4, 100.0));
        const double *const now[] = {s->u[0], s->p, s->surface->phi}; /* steps swap the last */
        for (int f = 0; f < 3; f++)
            assert_memory_equal(once + f * s->size, now[f], (size_t)s->size * sizeof *once);
        FREE(once, kept);
        mesh_case_end(&c, &s);
    }
}

/* A tank opens at once to a level outside below its bed: from the side the wave of Ritter (1892)
 * runs back, and (8/27) sqrt(g) H^(3/2) flow out. Air cannot pull: no water is faster than its
 * head, sqrt(2 g H). */
TEST(nothing_pulls_where_the_level_outside_is_low)
{
    static const double levels[] = {-0.5, -5.0};
    const struct scene_wall left = {.side = SIDE_X_MIN, .kind = WALL_SLIP};
    const double q = 8.0 / 27.0 * sqrt(G) * pow(DEPTH, 1.5);
    for (int k = 0; k < 4; k++) {
        const struct scene_wall out = {
            .side = SIDE_X_MAX, .kind = WALL_OUTFLOW, .level = levels[k % 2], .has_level = true};
        struct mesh_case c;
        struct fv *s = start(&c, grids[k / 2 * 2].blocks, grids[0].with, 0.0, &left, &out);
        assert_true(mesh_case_run(s, 10000, (SANITIZED ? 0.1 : 1.0) * TRANSIT));
        const double before = surface_volume(s);
        assert_true(SANITIZED || mesh_case_run(s, 10000, 1.7 * TRANSIT));
        const double discharge = (before - surface_volume(s)) / (0.7 * TRANSIT),
                     fastest = hypot(s->max.u[0], s->max.u[1]);
        print_message("%.4g m^2/s of %.4g, at most %.4g m/s\n", discharge, q, fastest);
        if (!SANITIZED)
            assert_close(discharge, q, 0.05 * q);
        assert_true(fastest < sqrt(2.0 * G * DEPTH));
        mesh_case_end(&c, &s);
    }
}

/* A tank that one opening fills or empties has gained or lost the discharge times the time, to a
 * thousandth. */
TEST(what_passes_is_the_given_discharge)
{
    const double q = 0.1, end = SANITIZED ? 0.2 : 2.0;
    for (int k = 0; k < 2 * GRIDS; k++) {
        const bool fills = k % 2 == 0;
        const struct scene_wall closed = {.side = SIDE_X_MIN, .kind = WALL_SLIP},
                                opening = {.side = SIDE_X_MAX,
                                           .kind = fills ? WALL_INFLOW : WALL_OUTFLOW,
                                           .discharge = q,
                                           .has_discharge = true};
        struct mesh_case c;
        struct fv *s = start(&c, grids[k / 2].blocks, grids[k / 2].with, 0.0, &closed, &opening);
        const double before = surface_volume(s);
        assert_true(mesh_case_run(s, 10000, end));
        const double passed = fabs(surface_volume(s) - before);
        print_message("%s: %.6g m^2 of %g\n", fills ? "in" : "out", passed, q * end);
        if (!SANITIZED)
            assert_close(passed, q * end, 1e-3 * q * end);
        mesh_case_end(&c, &s);
    }
}

/* An outlet that is to let out half as much again as there is drains the tank, and the run ends as
 * it should. Critical flow all the time, dh/dt = -(2/3)^(3/2) sqrt(g) h^(3/2)/LENGTH, leaves 0.28
 * of the water. */
TEST(an_outlet_that_runs_short_drains_its_tank)
{
    const double q = 0.5, end = 3.0;
    const struct scene_wall closed = {.side = SIDE_X_MIN, .kind = WALL_SLIP},
                            opening = {.side = SIDE_X_MAX,
                                       .kind = WALL_OUTFLOW,
                                       .discharge = q,
                                       .has_discharge = true};
    for (int k = 0; k < (SANITIZED ? 1 : 4); k += 2) {
        struct mesh_case c;
        struct fv *s = start(&c, grids[k].blocks, grids[k].with, 0.0, &closed, &opening);
        const double before = surface_volume(s);
        assert_true(before < q * end);
        assert_true(mesh_case_run(s, 100000, end));
        print_message("%g of %g m^2 are left\n", surface_volume(s), before);
        assert_true(surface_volume(s) > 0.0 && surface_volume(s) < 0.3 * before);
        mesh_case_end(&c, &s);
    }
}
