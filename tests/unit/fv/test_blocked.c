/* test_blocked.c - boxes that are cut out of the grid: water at rest beside them stays at rest, in
 * 2D and 3D, and presses on them by its depth; walls made of boxes are walls; a box through which
 * nothing flows parts two basins; a duct between boxes has its parabola; ranks change nothing but
 * rounding. ranks: 1 2. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../fv/boundary/blocked.h"
#include "../../../fv/operators/flow_measures.h"
#include "../../../fv/surface/levelset.h"
#include "../../../fv/watch/watches.h"
#include "fv_case.h"

#define SURFACE "fv.surface=\"yes\"", "initial.field=\"rest\"", CLOSED

static struct blocked_params boxes[2]; /* of the next start */
static int nboxes;

static void add_box(const char *name, const double *min, const double *max, enum wall_kind kind)
{
    struct blocked_params *p = boxes + nboxes++;
    snprintf(p->name, sizeof p->name, "%s", name);
    memcpy(p->min, min, sizeof p->min);
    memcpy(p->max, max, sizeof p->max);
    p->kind = kind;
}

#define BOX(name, kind, x0, y0, z0, x1, y1, z1)                                                    \
    add_box(name, (const double[]){x0, y0, z0}, (const double[]){x1, y1, z1}, kind)

/* Of a case that is set. */
static struct fv *start_set(struct fv_case *c, const struct scene_shape *shape, enum wall_kind kind)
{
    fv_case_close(c, kind);
    if (shape)
        c->run.scene.shapes[c->run.scene.nshapes++] = *shape;
    memcpy(blocked_given, boxes, sizeof boxes);
    blocked_given_count = nboxes;
    nboxes = 0;
    return fv_case_start(c, NULL);
}

static struct fv *start(struct fv_case *c, MPI_Comm comm, const char *const *overrides,
                        const struct scene_shape *shape, enum wall_kind kind)
{
    fv_case_set(c, comm, overrides);
    return start_set(c, shape, kind);
}

static void end(struct fv_case *c)
{
    fv_free(&c->s);
    blocked_given_count = 0;
}

TEST(still_water_stays)
{
    for (int dim = 2; dim <= 3; dim++)
        for (int kind = WALL_SLIP; kind <= WALL_NO_SLIP; kind++) {
            struct fv_case c;
            double force[FLOW_BODIES_MAX][4], all[4];
            const int up = dim - 1;
            /* one through the surface, a cell thick; one under water; both on the floor */
            if (dim == 2)
                BOX("post", kind, 0.25, 0, 0, 0.3, 0.8, 0);
            else
                BOX("post", kind, 0.25, 0.25, 0, 0.35, 0.5, 0.8);
            if (dim == 2)
                BOX("sill", kind, 0.5, 0, 0, 0.8, 0.2, 0);
            else
                BOX("sill", kind, 0.6, 0.25, 0, 0.8, 0.75, 0.2);
            const struct scene_shape water = {.form = SHAPE_BELOW, .level = 0.5123};
            struct fv *s =
                start(&c, MPI_COMM_WORLD,
                      (const char *const[]){
                          SURFACE, dim == 2 ? "domain.dim=2" : "domain.dim=3",
                          dim == 2 ? "fluid.gravity=(0,-9.81)" : "fluid.gravity=(0,0,-9.81)",
                          dim == 2 ? "fv.cells=(20,20)" : "fv.cells=(20,12,20)", NULL},
                      &water, WALL_NO_SLIP);
            assert_true(fv_case_run(&c, 5, 10.0));
            for (int a = 0; a < dim; a++)
                assert_close(s->max.u[a], 0.0, 1e-10);
            flow_forces(s, force, all);
            for (int a = 0; a < up; a++) /* as much from either side */
                assert_close(force[1][a], 0.0, 1e-9);
            assert_close(force[0][up], 0.0, 1e-9);
            assert_close(force[1][up], -9.81 * (0.5123 - 0.2) * (dim == 2 ? 0.3 : 0.2 * 0.5), 1e-9);
            end(&c);
        }
}

/* Water drawn as a box up to the lower face of a body, or 0.4 cells over it, which closes a part of
 * its upper side: phi under the body jumped, and the water at rest reached 0.24 and 0.16 m/s. */
TEST(water_under_a_body_stays)
{
    const double levels[2] = {0.5, 0.52}, most[2] = {5e-3, 1e-10};
    for (int k = 0; k < 2; k++) {
        struct fv_case c;
        const struct scene_shape water = {.form = SHAPE_BOX, .box = {{0, 0, 0}, {1, levels[k], 0}}};
        BOX("body", WALL_SLIP, 0.4, 0.5, 0, 0.6, 1, 0);
        struct fv *s = start(&c, MPI_COMM_WORLD,
                             (const char *const[]){SURFACE, "domain.dim=2", "fv.cells=(20,20)",
                                                   "fluid.gravity=(0,-9.81)", NULL},
                             &water, WALL_SLIP);
        for (int n = 0; n < 10; n++) {
            assert_true(fv_case_run(&c, 1, 10.0));
            for (int a = 0; a < 2; a++)
                assert_close(s->max.u[a], 0.0, most[k]);
        }
        end(&c);
    }
}

static double oscillation(bool between, bool deep, enum wall_kind kind)
{
    struct fv_case c;
    const bool solid = deep;
    const struct scene_shape column = {.form = SHAPE_BOX, .box = {{0, 0, 0}, {0.4, 0.6, 0.6}}};
    if (between && solid) {
        BOX("left", kind, -1, -1, -1, 0, 2, 2);
        BOX("low", kind, -1, -1, -1, 2, 2, 0);
    } else if (between) {
        BOX("left", kind, -1, -1, 0, 0, 2, 0);
        BOX("low", kind, -1, -1, 0, 2, 0, 0);
    }
    struct fv *s =
        start(&c, MPI_COMM_WORLD,
              (const char *const[]){SURFACE, "fv.tol_pressure=1e-6", "fluid.nu=1e-3",
                                    solid ? "domain.dim=3" : "domain.dim=2",
                                    solid ? "fluid.gravity=(0,0,-9.81)" : "fluid.gravity=(0,-9.81)",
                                    !solid ? between ? "domain.min=(-0.1,-0.1)" : "domain.min=(0,0)"
                                    : between ? "domain.min=(-0.1,0,-0.1)"
                                              : "domain.min=(0,0,0)",
                                    !solid    ? between ? "fv.cells=(22,22)" : "fv.cells=(20,20)"
                                    : between ? "fv.cells=(22,6,22)"
                                              : "fv.cells=(20,6,20)",
                                    NULL},
              &column, kind);
    assert_true(fv_case_run(&c, 1000, SANITIZED ? 0.05 : 0.2));
    const double e = surface_energy(s);
    end(&c);
    return e;
}

/* The same flow as in a tank whose walls are the domain's sides, but for corner terms of O(h^2). */
TEST(boxes_are_walls)
{
    for (int deep = 0; deep < 2; deep++)
        for (int kind = SANITIZED ? WALL_NO_SLIP : WALL_SLIP; kind <= WALL_NO_SLIP; kind++) {
            const double sides = oscillation(false, deep, kind),
                         other = oscillation(true, deep, kind);
            print_message("column, %dD, %s: energy %.8g, between boxes %.8g\n", deep ? 3 : 2,
                          kind == WALL_SLIP ? "slip" : "no slip", sides, other);
            assert_close(other, sides, 5e-3 * sides); /* 2 (h/H)^2 */
        }
}

/* A drop falls, over a film at rest, beside a box in the air to which fluid sticks: what sticks
 * there has no part in the friction of water, which is none. */
TEST(boxes_in_air_rub_no_water)
{
    struct fv_case c;
    const struct scene_shape drop = {
        .form = SHAPE_DISC, .centre = {0.2955132286689605, 0.249, 0}, .radius = 0.0436952176863742};
    const struct scene_shape film = {.form = SHAPE_BOX,
                                     .box = {{0, 0.08, 0}, {0.54, 0.10428251190085225, 0}}};
    BOX("post", WALL_SLIP, 0.36, 0.18, 0, 0.39, 0.24, 0);
    BOX("other", WALL_NO_SLIP, 0.18, 0.18, 0, 0.21, 0.24, 0);
    fv_case_set(&c, MPI_COMM_WORLD,
                (const char *const[]){
                    "fv.surface=\"yes\"", "initial.field=\"rest\"", "domain.periodic=(true,false)",
                    "fluid.gravity=(0,-1)", "fluid.nu=2e-4", "domain.dim=2", "domain.min=(0,0.08)",
                    "domain.max=(0.54,0.34)", "fv.cells=(18,13)", "fv.tol_viscous=1e-12",
                    "fv.tol_pressure=1e-9", "fluid.rho=1000", NULL});
    c.run.scene.shapes[c.run.scene.nshapes++] = film;
    start_set(&c, &drop, WALL_SLIP);
    assert_true(fv_case_run(&c, 4, 1.68));
    end(&c);
}

/* A wall of one cell: no water and no pressure passes, whatever the stencils reach. */
TEST(thin_wall_parts_basins)
{
    struct fv_case c;
    const struct scene_shape column = {.form = SHAPE_BOX, .box = {{0, 0, 0}, {0.3, 0.8, 0}}};
    BOX("wall", WALL_SLIP, 0.5, 0, 0, 0.55, 1, 0);
    struct fv *s = start(&c, MPI_COMM_WORLD,
                         (const char *const[]){SURFACE, "fluid.gravity=(0,-9.81)", "fluid.nu=0",
                                               "domain.dim=2", "fv.cells=(20,20)", NULL},
                         &column, WALL_SLIP);
    assert_true(fv_case_run(&c, 1000, 0.6));
    assert_true(surface_reach(s, 0) < 0.5 + 1e-9);
    assert_close(surface_volume(s), s->surface->volume0, 1e-9);
    end(&c);
}

/* Over all ranks. */
static double level_at(const struct fv *s, double x)
{
    double level = surface_level(s, (const double[]){x, 0, 0});
    return ranks_sum(MPI_COMM_WORLD, level);
}

/* Two shafts round a core: each has the level of its own shape, whatever box lies between, and the
 * energy of what then swings is that of the fall. */
TEST(shafts_have_their_own_levels)
{
    struct fv_case c;
    const struct scene_shape left = {.form = SHAPE_BOX, .box = {{0, 0, 0}, {0.5, 0.65, 0}}},
                             right = {.form = SHAPE_BOX, .box = {{0.5, 0, 0}, {1, 0.55, 0}}};
    BOX("core", WALL_SLIP, 0.25, 0.25, 0, 0.75, 1, 0);
    fv_case_set(&c, MPI_COMM_WORLD,
                (const char *const[]){SURFACE, "fluid.gravity=(0,-9.81)", "fluid.nu=0",
                                      "domain.dim=2", "fv.cells=(32,32)", NULL});
    c.run.scene.shapes[c.run.scene.nshapes++] = left;
    struct fv *s = start_set(&c, &right, WALL_SLIP);
    assert_close(level_at(s, 0.1), 0.65, 1e-9);
    assert_close(level_at(s, 0.9), 0.55, 1e-9);
    assert_true(fv_case_run(&c, 1000, 3.5)); /* more than a hundred steps, two periods */
    print_message("U tube: %d steps, energy gained %.3g\n", (int)c.run.step,
                  s->watches->energy.worst);
    assert_true(c.run.step > 105 && s->watches->energy.worst < s->watches->energy.warn);
    end(&c);
}

/* The height of the surface, over what stands on the floor and what hangs in the water, beside it,
 * and the ground where there is no water. */
TEST(gauges_read_over_boxes)
{
    static const struct {
        double water, top, x, level; /* of the water, the sill; the gauge and what it reads */
    } all[] = {{0.4, 0.2, 0.45, 0.4},
               {0.4, 0.2, 0.2, 0.4},
               {0.4, 0.2, 0.7, 0.4},
               {0.4, 0.6, 0.2, 0.6},
               {0.1, 0.2, 0.2, 0.2},
               {0.1, 0.2, 0.7, 0.1},
               /* on the faces of a sill that stands out of the water, and just within */
               {0.4, 0.6, 0.1, 0.4},
               {0.4, 0.6, 0.3, 0.4},
               {0.4, 0.6, 0.29, 0.6}};
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++) {
        struct fv_case c;
        const struct scene_shape water = {.form = SHAPE_BELOW, .level = all[k].water};
        BOX("sill", WALL_SLIP, 0.1, 0, 0, 0.3, all[k].top, 0);
        BOX("bar", WALL_SLIP, 0.6, 0.2, 0, 0.8, 0.3, 0);
        struct fv *s = start(&c, MPI_COMM_WORLD,
                             (const char *const[]){SURFACE, "fluid.gravity=(0,-9.81)",
                                                   "domain.dim=2", "fv.cells=(20,20)", NULL},
                             &water, WALL_SLIP);
        assert_close(level_at(s, all[k].x), all[k].level, 1e-9);
        end(&c);
    }
}

TEST(duct_has_its_parabola)
{
    struct fv_case c;
    double most = 0.0, turned = 0.0, x[3], force[FLOW_BODIES_MAX][4], all[4];
    BOX("floor", WALL_NO_SLIP, -1, -0.5, 0, 2, 0, 0);
    BOX("roof", WALL_NO_SLIP, -1, 1, 0, 2, 2, 0);
    struct fv *s =
        start(&c, MPI_COMM_WORLD,
              (const char *const[]){"initial.field=\"rest\"", "domain.periodic=(true,false,false)",
                                    "domain.min=(0,-0.5)", "domain.max=(1,1.5)", "fluid.nu=0.1",
                                    "fluid.gravity=(0.8,0)", "fv.tol_viscous=1e-9", "domain.dim=2",
                                    "fv.cells=(8,16)", NULL},
              NULL, WALL_SLIP);
    assert_true(fv_case_run(&c, 1000, 30.0));
    double *w = NEW(double, s->size);
    flow_vorticity(s, w);
    BLOCK_CELLS (&s->b, i, j, k, at) {
        block_centre(&s->b, i, j, k, x);
        const double y = x[1], h = s->b.h[1];
        const bool flows = y > 0.0 && y < 1.0;
        const double vorticity = flows ? 4.0 * (2.0 * y - 1.0) : 0.0;
        turned = fmax(turned, fabs(w[at] - vorticity));
        turned = fmax(turned, fabs(flow_curl_squared(s, s->grid.part, at) - vorticity * vorticity));
        const double exact = flows ? 4.0 * (y * (1.0 - y) - h * h / 12.0) : 0.0;
        most = fmax(most, fabs(s->u[0][at] - exact));
    }
    mem_free(w);
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    assert_close(turned, 0.0, 1e-4); /* 1e-6 over a fifteenth of h, times 8 of the square */
    flow_forces(s, force, all);
    print_message("duct: %.3g off the parabola, friction %.8g and %.8g\n", most, force[0][0],
                  force[1][0]);
    assert_close(most, 0.0, 1e-6);
    assert_close(force[0][0], 0.4, 1e-6); /* half of what gravity pulls */
    assert_close(force[1][0], 0.4, 1e-6);
    end(&c);
}

/* Steady flow that a body force drives past a bar in a duct: bar and walls take the force on what
 * flows, 0.1 (4 - 0.25). */
static void weigh(int kind, double part)
{
    struct fv_case c;
    double bar[FLOW_BODIES_MAX][4], all[4];
    BOX("bar", kind, 0.75, 0.75, 0, 1.25, 1.25, 0);
    struct fv *s =
        start(&c, MPI_COMM_WORLD,
              (const char *const[]){"initial.field=\"rest\"", "fluid.nu=0.05",
                                    "fluid.gravity=(0.1,0)", "domain.max=(2,2)",
                                    "domain.periodic=(true,false)", "domain.dim=2", NULL},
              NULL, WALL_NO_SLIP);
    assert_true(fv_case_run(&c, 100000, SANITIZED ? 2.0 : 80.0)); /* H^2/(pi^2 nu) = 8 s */
    flow_forces(s, bar, all);
    print_message("bar %g, walls %g: %.6f of 0.375 N\n", bar[0][0], all[0] - bar[0][0], all[0]);
    if (!SANITIZED) {
        assert_close(all[0], 0.375, part * 0.375);
        assert_close(all[1], 0.0, 1e-9);
    }
    end(&c);
}

/* The force along a stream on a post, after a step of a fiftieth it has not changed by more than in
 * the whole step before and 5 %. */
static void shorten(const char *const *overrides, bool surface)
{
    struct fv_case c;
    struct scene_shape water = {.form = SHAPE_BOX, .box = {{0.0}, {2.0, 0.5, 1.0}}};
    double force[FLOW_BODIES_MAX][4], all[4], of[3];
    BOX("post", WALL_SLIP, 0.8, 0.15, 0, 1.0, 0.25, 0);
    struct fv *s = start(&c, MPI_COMM_WORLD, overrides, surface ? &water : NULL, WALL_SLIP);
    assert_true(fv_case_run(&c, SANITIZED ? 5 : 40, 100.0));
    for (int k = 0; k < 3; k++) {
        flow_forces(s, force, all);
        of[k] = force[0][0];
        assert_true(fv_case_run(&c, 1, k == 0 ? 100.0 : s->t + 0.02 * s->step.dt));
    }
    print_message("force on a post %.5g, %.5g, after a short step %.5g N\n", of[0], of[1], of[2]);
    assert_close(of[2], of[1], fabs(of[1] - of[0]) + 0.05 * fabs(of[1]));
    end(&c);
}

#define STREAM                                                                                     \
    "initial.field=\"uniform\"", "initial.velocity=(0.6,0)", "domain.max=(2,0.75)",                \
        "domain.periodic=(true,false)", "fv.cells=(80,30)"
TEST(a_short_step_keeps_the_force)
{
    shorten((const char *const[]){STREAM, "fluid.nu=0", NULL}, false);
    shorten((const char *const[]){STREAM, "fluid.nu=1e-3", "fv.integrator=\"bdf2\"", NULL}, false);
    shorten((const char *const[]){STREAM, "fluid.nu=0", "fv.surface=\"yes\"",
                                  "fluid.gravity=(0,-9.81)", NULL},
            true);
}

/* Steps of CFL 0.05: p has odd-even waves of 1/dt unless they are taken off. */
static void step_slowly(const char *surface, const char *gravity)
{
    struct fv_case c;
    struct scene_shape water = {.form = SHAPE_BOX, .box = {{0.0}, {2.0, 0.5, 1.0}}};
    BOX("sill", WALL_SLIP, 0.8, 0, 0, 1.0, 0.1, 0);
    struct fv *s =
        start(&c, MPI_COMM_WORLD,
              (const char *const[]){STREAM, "fluid.nu=0", "fv.cfl=0.05", surface, gravity, NULL},
              gravity ? &water : NULL, WALL_SLIP);
    assert_true(fv_case_run(&c, SANITIZED ? 5 : 60, 100.0));
    print_message("odd-even pressure %.3g\n", s->watches->pressure.worst);
    assert_true(s->watches->pressure.worst < s->watches->pressure.warn);
    end(&c);
}

TEST(small_steps_have_smooth_pressures)
{
    step_slowly("fv.surface=\"yes\"", "fluid.gravity=(0,-9.81)");
    step_slowly("fv.surface=\"no\"", NULL);
}
#undef STREAM

TEST(bar_and_walls_take_the_weight)
{
    weigh(WALL_NO_SLIP, 1e-3);
    weigh(WALL_SLIP, 5e-3); /* fast, and turns sharply, round its edges */
}

/* Water at rest on one side of a box presses on it by rho g h^2/2, wherever the surface lies in its
 * cell: on a face, a little above it, in the centre, above that. */
TEST(a_dam_bears_its_water)
{
    static const double level[] = {0.5, 0.51, 0.525, 0.54};
    for (int dim = 2; dim < 4; dim++)
        for (int k = 0; k < 4; k++) {
            struct fv_case c;
            const bool flat = dim == 2;
            double force[FLOW_BODIES_MAX][4], all[4], box[2][3] = {{0.0}, {0.5, 1.0, 1.0}};
            struct scene_shape water = {.form = SHAPE_BOX};
            box[1][dim - 1] = level[k];
            memcpy(water.box, box, sizeof box);
            BOX("dam", WALL_SLIP, 0.5, 0, 0, 0.75, 1, 1);
            struct fv *s = start(
                &c, MPI_COMM_WORLD,
                (const char *const[]){SURFACE, flat ? "domain.dim=2" : "domain.dim=3",
                                      flat ? "fluid.gravity=(0,-10)" : "fluid.gravity=(0,0,-10)",
                                      flat ? "fv.cells=(20,20)" : "fv.cells=(20,6,20)", NULL},
                &water, WALL_SLIP);
            flow_forces(s, force, all);
            const double want = 5.0 * c.run.scene.fluid.rho * level[k] * level[k];
            assert_close(force[0][0], want, 1e-9 * want);
            end(&c);
        }
}

/* A stream through boxes in a periodic domain loses energy, whoever has it; the watch of what a
 * flow has over its mean knows that a box stirs it. */
TEST(stream_loses_energy)
{
    for (int bdf2 = 0; bdf2 < 2; bdf2++) {
        struct fv_case c;
        double row[FV_CASE_ROW], before = INFINITY;
        BOX("a", WALL_NO_SLIP, 0.25, 0.25, 0.25, 0.5, 0.6, 0.6);
        start(&c, MPI_COMM_WORLD,
              (const char *const[]){
                  "initial.field=\"uniform\"", "initial.velocity=(1,0.2,0.1)", "domain.dim=3",
                  "domain.periodic=(true,true,true)", "fluid.nu=1e-2", "fv.cells=(16,16,16)",
                  bdf2 ? "fv.integrator=\"bdf2\"" : "fv.integrator=\"rk3\"", NULL},
              NULL, WALL_SLIP);
        for (int k = 0; k < (SANITIZED ? 1 : 6); k++) {
            assert_true(fv_case_run(&c, 1000, 0.2 * (k + 1)));
            VALUES_OF(fv_row, c.s, row);
            assert_true(row[0] < before);
            before = row[0];
        }
        end(&c);
    }
}

/* Discharge through the gap open[0] < y < open[1] of the section x = 1/2. */
static double discharge(const struct fv *s, const double *open)
{
    const struct block *b = &s->b;
    double sum = 0.0, area = b->dim == 3 ? b->h[1] * b->h[2] : b->h[1];
    const int i = b->cells[0] / 2 - b->lo[0];
    for (int k = 0; k < b->n[2] && i >= 0 && i < b->n[0]; k++)
        for (int j = 0; j < b->n[1]; j++) {
            const double y = b->origin[1] + (b->lo[1] + j + 0.5) * b->h[1];
            sum += y > open[0] && y < open[1] ? area * s->U[0][block_at(b, i, j, k)] : 0.0;
        }
    return ranks_sum(s->comm, sum);
}

/* An inflow that starts at once through an orifice: the flow of the start and that of each step
 * carry the inflow's discharge through it, at no more than some times its mean speed there, and a
 * gauge reads it. */
TEST(orifice_starts)
{
    static const struct {
        const char *cells, *dim, *by;
        double u, open[2], n; /* m/s; m of y; share of the section */
    } of[] = {
        {"fv.cells=(40,40)", "domain.dim=2", "fv.integrator=\"rk3\"", 0.1, {0.45, 0.55}, 0.1},
        {"fv.cells=(40,40)", "domain.dim=2", "fv.integrator=\"rk3\"", 2.0, {0.0, 0.2}, 0.2},
        {"fv.cells=(40,40)", "domain.dim=2", "fv.integrator=\"bdf2\"", 0.5, {0.4, 0.6}, 0.2},
        {"fv.cells=(20,20,8)", "domain.dim=3", "fv.integrator=\"rk3\"", 0.3, {0.4, 0.6}, 0.2}};
    for (size_t k = 0; k < sizeof of / sizeof *of; k++) {
        struct fv_case c;
        fv_case_set(&c, MPI_COMM_WORLD,
                    (const char *const[]){"initial.field=\"rest\"", CLOSED, "fluid.nu=1e-3",
                                          "fv.tol_pressure=1e-6", of[k].cells, of[k].dim, of[k].by,
                                          NULL});
        struct scene *scene = &c.run.scene;
        for (int side = SIDE_X_MIN; side < SIDE_X_MIN + 2 * scene->domain.dim; side++)
            scene->walls[scene->nwalls++] =
                (struct scene_wall){.side = side,
                                    .kind = side == SIDE_X_MIN   ? WALL_INFLOW
                                            : side == SIDE_X_MAX ? WALL_OUTFLOW
                                                                 : WALL_SLIP,
                                    .velocity = {side == SIDE_X_MIN ? of[k].u : 0.0, 0.0, 0.0}};
        scene->probes[scene->nprobes++] = (struct scene_probe){.name = "q",
                                                               .kind = PROBE_DISCHARGE,
                                                               .at = {0.47, of[k].open[0], 0.0},
                                                               .to = {0.47, of[k].open[1], 1.0}};
        if (of[k].open[0] > 0.0)
            BOX("lower", WALL_SLIP, 0.45, 0, 0, 0.55, of[k].open[0], 1);
        BOX("upper", WALL_SLIP, 0.45, of[k].open[1], 0, 0.55, 1, 1);
        memcpy(blocked_given, boxes, sizeof boxes);
        blocked_given_count = nboxes;
        nboxes = 0;
        struct fv *s = fv_case_start(&c, NULL);
        const double start = discharge(s, of[k].open);
        double gauge;
        assert_close(start, of[k].u, 1e-5 * of[k].u);
        for (int n = 0; n < 3; n++) {
            assert_true(fv_case_run(&c, 5, 1.0));
            assert_close(discharge(s, of[k].open), of[k].u, 1e-3 * of[k].u);
            VALUES_OF(fv_probes_row, s,
                      &gauge); /* on rank 0; beside a corner, within the orifice */
            MPI_Bcast(&gauge, 1, MPI_DOUBLE, 0, MPI_COMM_WORLD);
            assert_close(gauge, of[k].u, 1e-3 * of[k].u);
            assert_true(s->max.u[0] > 0.9 * of[k].u / of[k].n &&
                        s->max.u[0] < 4.0 * of[k].u / of[k].n);
        }
        print_message("orifice of %g: discharge %.8g of %g m^2/s, fastest %.3g of %g m/s\n",
                      of[k].n, start, of[k].u, s->max.u[0], of[k].u / of[k].n);
        end(&c);
    }
}

static void sums_on(MPI_Comm comm, int dim, double sums[6])
{
    struct fv_case c;
    const struct scene_shape column = {.form = SHAPE_BOX, .box = {{0, 0, 0}, {0.43, 1, 0.57}}};
    const bool flat = dim == 2;
    double force[FLOW_BODIES_MAX][4], all[4];
    BOX("box", flat ? WALL_NO_SLIP : WALL_SLIP, 0.61, flat ? 0 : 0.3, 0, 0.74, flat ? 0.2 : 0.7,
        0.2);
    struct fv *s = start(
        &c, comm,
        (const char *const[]){SURFACE, flat ? "domain.dim=2" : "domain.dim=3", "fluid.nu=1e-3",
                              flat ? "fluid.gravity=(0,-9.81)" : "fluid.gravity=(0,0,-9.81)",
                              flat ? "fv.cells=(30,24)" : "fv.cells=(20,10,14)", NULL},
        &column, WALL_SLIP);
    const bool good = fv_case_run(&c, 12, 0.17);
    sums[0] = good ? surface_energy(s) : NAN;
    flow_forces(s, force, all);
    memcpy(sums + 1, force[0], 3 * sizeof(double));
    sums[4] = surface_reach(s, 0);
    sums[5] = s->t;
    if (flat)
        sums[3] = 0.0;
    end(&c);
}

TEST(ranks_agree)
{
    if (is_alone())
        return;
    for (int dim = 2; dim <= 3; dim++) {
        double alone[6], shared[6];
        sums_on(MPI_COMM_SELF, dim, alone);
        sums_on(MPI_COMM_WORLD, dim, shared);
        for (int k = 0; k < 6; k++) {
            MPI_Bcast(alone + k, 1, MPI_DOUBLE, 0, MPI_COMM_WORLD);
            assert_close(shared[k], alone[k], 1e-7 * fmax(1e-2, fabs(alone[k])));
        }
        print_message("%dD: energy %.10g, force %.6g, reach %.6g\n", dim, alone[0], alone[1],
                      alone[4]);
    }
}
