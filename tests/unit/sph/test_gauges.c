/* test_gauges.c - a gauge of the level reads the same water whichever way gravity points, beside a
 * wall, too; a coupled job knows how deep that water is; waves start as high as they are.
 * ranks: 1 2.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/output/probes.h"
#include "sph_case.h"

enum { CELLS = 50, GAUGES = 3 };
static const double depth = 0.3, across[GAUGES] = {0.51, 0.992, 0.0};

/* Water 0.3 deep at the end of axis a to which gravity draws it. */
static void tank(struct sph_case *c, int a, double gravity)
{
    sph_case_set(c, 2, CELLS);
    struct scene *s = &c->run.scene;
    s->initial.field = FIELD_REST;
    s->initial.level = LEVEL_TOP;
    s->fluid.nu = 0.0;
    s->fluid.gravity[a] = gravity;
    s->domain.periodic[0] = s->domain.periodic[1] = false;
    s->nshapes = 1;
    s->shapes[0].form = SHAPE_BOX;
    s->shapes[0].box[1][0] = s->shapes[0].box[1][1] = 1.0;
    s->shapes[0].box[gravity < 0.0][a] = gravity < 0.0 ? depth : 1.0 - depth;
    s->nprobes = GAUGES;
    for (int k = 0; k < GAUGES; k++) {
        s->probes[k] = (struct scene_probe){.kind = PROBE_LEVEL};
        s->probes[k].at[1 - a] = across[k];
    }
    c->prm.surface = SURFACE_YES;
    c->prm.scheme = SCHEME_RIEMANN;
}

TEST(levels_are_read_along_gravity)
{
    for (int k = 0; k < 4; k++) {
        struct sph_case c;
        double row[GAUGES];
        const double gravity = k % 2 ? 9.81 : -9.81;
        tank(&c, k / 2, gravity);
        sph_case_start(&c, NULL);
        integrate_gradients(c.s);
        VALUES_OF(probes_row, c.s, row);
        for (int q = 0; q < GAUGES; q++)
            assert_close(row[q], gravity < 0.0 ? depth : depth - 1.0, 1e-9);
        DROP(c.s);
    }
}

TEST(depths_are_measured_from_where_gravity_points)
{
    for (int k = 0; k < 4; k++) {
        struct sph_case c;
        const int a = k / 2;
        tank(&c, a, k % 2 ? 9.81 : -9.81);
        struct scene *s = &c.run.scene;
        assert_close(crossing_depth(s, a), depth, 1e-12);
        assert_close(crossing_time(s), sqrt(depth / 9.81), 1e-12);
        s->shapes[0].form = SHAPE_DISC;
        s->shapes[0].radius = 0.1;
        s->shapes[0].centre[a] = k % 2 ? 0.9 : 0.1;
        assert_close(crossing_depth(s, a), 0.2, 1e-12);
        s->initial.level = k % 2 ? -0.6 : 0.4; /* against gravity, from the origin */
        assert_close(crossing_depth(s, a), 0.4, 1e-12);
    }
}

/* In 3D along z, either way: water of triangles, and of forms that have no ends there. */
TEST(depths_of_all_forms_of_shapes)
{
    static struct scene_meshes meshes = {
        .n = 1, .of = {{.owner = MESH_OF_SHAPE, .lo = {0, 0, 0.2}, .hi = {1, 1, 0.7}}}};
    for (int up = 0; up < 2; up++) {
        struct sph_case c;
        tank(&c, 1, -9.81);
        struct scene *s = &c.run.scene;
        s->domain.dim = 3;
        s->domain.max[2] = 1.0;
        s->fluid.gravity[1] = 0.0;
        s->fluid.gravity[2] = up ? 9.81 : -9.81;
        assert_close(crossing_depth(s, 2), 1.0, 1e-12); /* a plane box */
        s->shapes[0].form = SHAPE_POLYGON;
        assert_close(crossing_depth(s, 2), 1.0, 1e-12);
        s->shapes[0].form = SHAPE_MESH;
        s->meshes = &meshes;
        assert_close(crossing_depth(s, 2), up ? 0.8 : 0.7, 1e-12);
        s->meshes = NULL;
    }
}

/* A wave of 2 m in water of 0.503 m, which ends on no row. */
static void wave(struct sph_case *c, int cells, double amplitude, double crest)
{
    sph_case_set(c, 2, cells);
    struct scene *s = &c->run.scene;
    s->initial.field = FIELD_REGULAR;
    s->initial.L = 2.0;
    s->initial.amplitude = amplitude;
    s->initial.crest = crest;
    s->initial.level = 0.503;
    s->fluid.nu = 0.0;
    s->fluid.gravity[1] = -1.0;
    s->domain.max[0] = 2.0;
    s->domain.periodic[1] = false;
    s->nwalls = 2;
    for (int k = 0; k < 2; k++)
        s->walls[k] = (struct scene_wall){.side = SIDE_Y_MIN + k, .kind = WALL_SLIP};
    c->prm.surface = SURFACE_YES;
    c->prm.scheme = SCHEME_RIEMANN;
    c->prm.walls = WALLS_NFM;
}

/* Lattices end on the surface of a wave of little more than a row, whichever its place. */
TEST(waves_start_at_their_height)
{
    for (int k = 0; k < 4; k++) {
        struct sph_case c;
        double row[GAUGES], volume = 0.0, area = 0.0;
        const int n = 4000;
        wave(&c, CELLS, 0.026, 0.13 * k);
        struct scene *s = &c.run.scene;
        s->nprobes = GAUGES;
        for (int q = 0; q < GAUGES; q++)
            s->probes[q] = (struct scene_probe){.kind = PROBE_LEVEL, .at = {0.37 + 0.5 * q}};
        sph_case_start(&c, NULL);
        integrate_gradients(c.s);
        VALUES_OF(probes_row, c.s, row);
        const struct exact e = exact_create(s);
        for (int q = 0; q < GAUGES; q++)
            assert_close(row[q], exact_surface(&e, s->probes[q].at[0]), 0.05 * c.s->dx);
        for (int i = 0; i < c.s->p.n; i++)
            volume += state_row(&c.s->p, c.s->p.y, i)[at_volume(2)];
        MPI_Allreduce(MPI_IN_PLACE, &volume, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
        for (int i = 0; i < n; i++)
            area += exact_surface(&e, 2.0 * (i + 0.5) / n) * 2.0 / n;
        assert_close(volume / area, 1.0, 1e-4);
        DROP(c.s);
    }
}

static double kinetic_energy(const struct sph *s)
{
    double sum = 0.0;
    for (int i = 0; i < s->p.n; i++) {
        const double *y = state_row(&s->p, s->p.y, i);
        sum += 0.5 * (y[2] * y[2] + y[3] * y[3]) / y[at_mass(2)];
    }
    return ranks_sum(MPI_COMM_WORLD, sum);
}

/* Shifting evens particles out: lattices whose columns are not alike would start a flow. */
TEST(waves_keep_their_energy)
{
    struct sph_case c;
    wave(&c, 25, 0.04, 0.3);
    c.prm.transport = TRANSPORT_TVS;
    struct sph *s = sph_case_start(&c, NULL);
    const double start = kinetic_energy(s);
    for (int k = 1; k <= (SANITIZED ? 1 : 4); k++) {
        while (s->t < k - 1e-9)
            assert_true(sph_case_run(&c, 1, k));
        print_message("t = %d: kinetic energy %.3f of the start's\n", k, kinetic_energy(s) / start);
        assert_close(kinetic_energy(s) / start, 1.0, 0.15);
    }
    DROP(c.s);
}
