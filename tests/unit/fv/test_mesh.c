/* test_mesh.c - blocks of any shape: metrics, free stream, order, joined faces, files, 3D, ranks,
 * restart. ranks: 1 2. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "mesh_case.h"

#include "../../../fv/watch/watches.h"

#define WAVE "name = \"a\"; mapping = \"sheared\"; wave = 0.06; " PERIODIC
#define RING                                                                                       \
    "name = \"ring\"; mapping = \"annulus\"; i_min = \"wall\"; i_max = \"wall\"; j_min = "         \
    "\"joined\"; j_max = \"joined\"; radius = (0.5, 1.0); spin = (2.0, -0.5); "
#define STREAM "initial.field=\"uniform\""

/* Four blocks, the second upside down (i and j turned by half a turn). */
static const char four[] =
    "{ name = \"a\"; cells = (16, 16); max = (0.5, 0.5); i_min = \"periodic\"; i_max = \"joined\"; "
    "j_min = \"periodic\"; j_max = \"joined\"; }, "
    "{ name = \"b\"; cells = (16, 16); min = (0.5, 0.0); max = (1.0, 0.5); centre = (0.75, 0.25); "
    "angle = 180.0; i_max = \"joined\"; i_min = \"periodic\"; j_max = \"periodic\"; j_min = "
    "\"joined\"; }, "
    "{ name = \"c\"; cells = (16, 16); min = (0.0, 0.5); max = (0.5, 1.0); i_min = \"periodic\"; "
    "i_max = \"joined\"; j_min = \"joined\"; j_max = \"periodic\"; }, "
    "{ name = \"d\"; cells = (16, 16); min = (0.5, 0.5); max = (1.0, 1.0); i_min = \"joined\"; "
    "i_max = \"periodic\"; j_min = \"joined\"; j_max = \"periodic\"; }";

static void sized(char *text, size_t size, const char *block, int nx, int ny, int nz)
{
    snprintf(text, size, "{ %s cells = (%d, %d, %d); }", block, nx, ny, nz);
}

/* Largest sum of face vectors of a cell over the largest of them; sum of the volumes. */
static double open_faces(const struct mesh *m, double *volume)
{
    double worst = 0.0;
    *volume = 0.0;
    for (int q = 0; q < m->nparts; q++) {
        const struct part *p = m->part + q;
        for (int k = 0; k < p->n[2]; k++)
            for (int j = 0; j < p->n[1]; j++)
                for (int i = 0; i < p->n[0]; i++) {
                    const int64_t c = part_at(p, i, j, k);
                    *volume += m->V[c];
                    for (int b = 0; b < m->dim; b++) {
                        double sum = 0.0, most = 0.0;
                        for (int a = 0; a < m->dim; a++) {
                            sum += m->S[a][b][c + p->stride[a]] - m->S[a][b][c];
                            most = fmax(most, fabs(m->S[a][b][c]));
                        }
                        worst = fmax(worst, fabs(sum) / most);
                    }
                }
    }
    MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, m->comm);
    MPI_Allreduce(MPI_IN_PLACE, volume, 1, MPI_DOUBLE, MPI_SUM, m->comm);
    return worst;
}

TEST(faces_of_a_cell_close)
{
    struct mesh_case c;
    char text[512];
    double volume, exact[2], e[2];
    for (int k = 0; k < 2; k++) {
        sized(text, sizeof text, RING, 8 << k, 32 << k, 1);
        struct fv *s = mesh_case_start(&c, MPI_COMM_WORLD, text, NULL);
        assert_true(open_faces(s->m, &volume) < 1e-13);
        exact[k] = M_PI * 0.75;
        e[k] = fabs(volume / exact[k] - 1.0);
        mesh_case_end(&c, &s);
    }
    assert_true(log2(e[0] / e[1]) > 3.8);
    snprintf(
        text, sizeof text,
        "{ %s max = (1.0, 1.0, 0.25); k_min = \"slip\"; k_max = \"slip\"; cells = (8, 32, 6); }",
        RING);
    struct fv *s =
        mesh_case_start(&c, MPI_COMM_WORLD, text, (const char *const[]){"domain.dim=3", NULL});
    assert_true(open_faces(s->m, &volume) < 1e-12);
    assert_close(volume, M_PI * 0.75 * 0.25, 1e-4);
    mesh_case_end(&c, &s);
}

/* Largest change of a uniform flow after some steps. */
static double change_of_stream(const char *blocks, const char *const *overrides)
{
    struct mesh_case c;
    double worst = 0.0;
    struct fv *s = mesh_case_start(&c, MPI_COMM_WORLD, blocks, overrides);
    const bool good = mesh_case_run(s, 4, 100.0);
    for (int q = 0; q < s->m->nparts; q++) {
        const struct part *p = s->m->part + q;
        for (int64_t i = p->base; i < p->base + p->size; i++)
            for (int a = 0; a < s->m->dim && s->free[i] > 0.0; a++)
                worst = fmax(worst, fabs(s->u[a][i] - s->run->scene.initial.velocity[a]));
    }
    mesh_case_end(&c, &s);
    MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    return good ? worst : NAN;
}

TEST(a_uniform_flow_stays)
{
    char text[1024];
    sized(text, sizeof text, WAVE, 20, 24, 1);
    assert_true(change_of_stream(text, (const char *const[]){STREAM, NULL}) < 1e-12);
    assert_true(change_of_stream(four, (const char *const[]){STREAM, NULL}) < 1e-12);
    snprintf(
        text, sizeof text,
        "{ name = \"r\"; mapping = \"annulus\"; radius = (0.2, 0.8); stretch = (1.5, 0.0); cells = "
        "(12, 36); j_min = \"joined\"; j_max = \"joined\"; i_min = \"exact\"; i_max = \"exact\"; "
        "}");
    assert_true(change_of_stream(text, (const char *const[]){STREAM, NULL}) < 1e-12);
    snprintf(text, sizeof text,
             "{ " WAVE "k_min = \"periodic\"; k_max = \"periodic\"; cells = (12, 10, 8); }");
    assert_true(change_of_stream(text, (const char *const[]){STREAM, "domain.dim=3",
                                                             "initial.velocity=(0.5,0.25,0.1)",
                                                             NULL}) < 1e-12);
}

TEST(ring_flow_has_order_three_and_a_half)
{
    char text[512];
    double e[2][3];
    for (int k = 0; k < 2; k++) {
        sized(text, sizeof text, RING, 8 << k, 32 << k, 1);
        mesh_case_errors(text,
                         (const char *const[]){"initial.field=\"couette\"", "fluid.nu=0.08", NULL},
                         SANITIZED ? 0.3 : 6.0, e[k]);
    }
    print_message("ring: u %.2e %.2e p %.2e %.2e\n", e[0][0], e[1][0], e[0][1], e[1][1]);
    if (SANITIZED)
        return;
    assert_true(e[1][0] < 5e-5 && log2(e[0][0] / e[1][0]) > 3.5);
    assert_true(log2(e[0][1] / e[1][1]) > 2.5);
}

/* rms error of what snapshots hold against the averages over volumes, from the exact flow: u, v, p,
 * vorticity. */
static void output_errors(const char *text, const char *const *overrides, double e[4])
{
    static const double gauss[3] = {0.1127016653792583, 0.5, 0.8872983346207417},
                        weight[3] = {5.0, 8.0, 5.0};
    struct mesh_case c;
    struct fv *s = mesh_case_start(&c, MPI_COMM_WORLD, text, overrides);
    static const enum output_field what[4] = {OUTPUT_VELOCITY, OUTPUT_VELOCITY, OUTPUT_PRESSURE,
                                              OUTPUT_VORTICITY};
    const struct mesh *m = s->m;
    double *const all[3] = {mesh_field(m), mesh_field(m), mesh_field(m)};
    for (int f = 0; f < 4; f++) {
        const double *q = all[f == 1];
        double sum[2] = {0.0, 0.0};
        for (int k = 0; k < m->nparts; k++) {
            const struct part *p = m->part + k;
            int i[3];
            PART_CELLS (p, i, at) {
                double u[3], pressure, w;
                cell_exact(s, p, i, 0.0, u, &pressure, &w);
                s->u[0][at] = u[0];
                s->u[1][at] = u[1];
                s->p[at] = s->p_before[at] = pressure;
            }
        }
        mesh_fill(s->m, 2, s->u);
        mesh_bc_velocity(s, BC_GIVEN, s->u);
        output_fill(s, what[f], all);
        for (int k = 0; k < m->nparts; k++) {
            const struct part *p = m->part + k;
            int i[3];
            PART_CELLS (p, i, at) {
                double mean = 0.0, volume = 0.0;
                for (int g = 0; g < 9; g++) {
                    const double xi[3] = {gauss[g % 3], gauss[g / 3], 0.5};
                    const int cell[3] = {p->lo[0] + i[0], p->lo[1] + i[1], 0};
                    double x[3], dx[3][3], u[3], pressure, w;
                    mesh_map_point(m->block + p->block, 2, cell, xi, x, dx);
                    mesh_exact_at(s, x, 0.0, u, &pressure, &w);
                    const double V = weight[g % 3] * weight[g / 3] * mesh_determinant(dx);
                    volume += V;
                    mean += V * (f < 2 ? u[f] : f == 2 ? pressure : w);
                }
                sum[0] += pow(q[at] - mean / volume, 2);
                sum[1] += 1.0;
            }
        }
        MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
        e[f] = sqrt(sum[0] / sum[1]);
    }
    for (int a = 0; a < 3; a++)
        mem_free(all[a]);
    mesh_case_end(&c, &s);
}

TEST(output_is_averaged_over_volumes)
{
    char text[512];
    double e[2][4];
    for (int k = 0; k < 2; k++) {
        sized(text, sizeof text, WAVE, 32 << k, 32 << k, 1);
        output_errors(text, NULL, e[k]);
    }
    for (int f = 0; f < 4; f++) {
        print_message("output on waving cells: %.2e %.2e\n", e[0][f], e[1][f]);
        assert_true(log2(e[0][f] / e[1][f]) > 3.5);
    }
    for (int k = 0; k < 2; k++) {
        snprintf(text, sizeof text,
                 "{ name = \"s\"; mapping = \"stretched\"; stretch = (1.5, -1.5); focus = (0.3, "
                 "0.5); cells = (%d, %d); "
                 "i_min = \"exact\"; i_max = \"exact\"; j_min = \"exact\"; j_max = \"exact\"; }",
                 32 << k, 32 << k);
        output_errors(text, NULL, e[k]);
    }
    for (int f = 0; f < 3; f++) {
        print_message("output on stretched cells: %.2e %.2e\n", e[0][f], e[1][f]);
        assert_true(log2(e[0][f] / e[1][f]) > 3.5);
    }
}

TEST(waves_and_joints_keep_order_three_and_a_half)
{
    char text[512];
    double e[2][3], f[3];
    for (int k = 0; k < 2; k++) {
        sized(text, sizeof text, WAVE, 32 << k, 32 << k, 1);
        mesh_case_errors(text, NULL, SANITIZED ? 0.05 : 0.25, e[k]);
    }
    print_message("wave: u %.2e %.2e p %.2e %.2e\n", e[0][0], e[1][0], e[0][1], e[1][1]);
    for (int k = 0; k < 3 && !SANITIZED; k++)
        assert_true(log2(e[0][k] / e[1][k]) > (k == 1 ? 2.5 : 3.5));
    sized(text, sizeof text, "name = \"a\"; " PERIODIC, 32, 32, 1);
    mesh_case_errors(text, NULL, 0.25, e[0]);
    mesh_case_errors(four, NULL, 0.25, f);
    assert_close(f[0] / e[0][0], 1.0, 0.02);
}

/* Couette flow between a lid and a wall, on cells finer at both: a straight profile, and a steady
 * stress; all walls moving alike: everything moves. */
TEST(a_lid_is_one_wall_alone)
{
    static const char text[] =
        "{ name = \"a\"; mapping = \"stretched\"; cells = (8, 24); stretch = (0.0, -2.0); "
        "velocity = (0.5, 0.0); %s i_min = \"periodic\"; i_max = \"periodic\"; j_min = "
        "\"wall\"; j_max = \"wall\"; }";
    char block[512];
    for (int k = 0; k < 3; k++) {
        const char *const lid[] = {"lid = \"j_max\";", "lid = \"j_min\";", ""};
        const double slope[] = {0.5, -0.5, 0.0}, start[] = {0.0, 0.5, 0.5};
        struct mesh_case c;
        double worst = 0.0;
        snprintf(block, sizeof block, text, lid[k]);
        struct fv *s =
            mesh_case_start(&c, MPI_COMM_WORLD, block,
                            (const char *const[]){"initial.field=\"rest\"", "fluid.nu=0.5",
                                                  "domain.periodic=(true,false)", NULL});
        assert_true(mesh_case_run(s, 100000, 8.0));
        const struct mesh_block *b = s->m->block;
        const double *x = b->x[mesh_vertex(b, 0, 0, 0)];
        const double first = b->x[mesh_vertex(b, 0, 1, 0)][1] - x[1];
        const double last = b->x[mesh_vertex(b, 0, 24, 0)][1] - b->x[mesh_vertex(b, 0, 23, 0)][1];
        const double middle = b->x[mesh_vertex(b, 0, 13, 0)][1] - b->x[mesh_vertex(b, 0, 12, 0)][1];
        assert_close(first, last, 1e-12);
        assert_true(middle > 3.0 * first);
        for (int q = 0; q < s->m->nparts; q++) {
            const struct part *p = s->m->part + q;
            for (int j = 0; j < p->n[1]; j++) {
                const int at[3] = {0, p->lo[1] + j, 0};
                const double y =
                    (4.0 * b->centre[mesh_cell(b, at)][1] + b->x[mesh_vertex(b, 0, at[1], 0)][1] +
                     b->x[mesh_vertex(b, 0, at[1] + 1, 0)][1]) /
                    6.0; /* average over the index */
                worst = fmax(worst, fabs(s->u[0][part_at(p, 0, j, 0)] - start[k] - slope[k] * y));
            }
        }
        MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
        print_message("lid %d: %.2e\n", k, worst);
        assert_true(worst < 2e-4);
        mesh_case_end(&c, &s);
    }
}

/* See lids_drag_alike_on_all_sides in test_fv_bc.c. */
TEST(a_lid_drags_what_its_layer_holds)
{
    struct mesh_case c;
    struct fv *s = mesh_case_start(
        &c, MPI_COMM_WORLD,
        "{ name = \"a\"; mapping = \"box\"; cells = (16, 16); velocity = (0.0, -1.0); lid = "
        "\"i_max\"; i_min = \"wall\"; i_max = \"wall\"; j_min = \"wall\"; j_max = \"wall\"; }",
        (const char *const[]){"initial.field=\"rest\"", "fluid.nu=1e-4",
                              "domain.periodic=(false,false)", NULL});
    assert_true(mesh_case_run(s, 100, 1.0));
    print_message("lid: %.4g m/s\n", s->max.u[0]);
    assert_close(s->max.u[0] / (2.0 * sqrt(1e-4 / M_PI) * 16.0), 1.0, 0.25);
    assert_close(s->watches->speed, 1.0, 1e-12); /* the lid's: the scene knows no sides of blocks */
    mesh_case_end(&c, &s);
}

/* A flow that has blown up is told with the cell, its block and its place. */
TEST(the_worst_cell_is_named)
{
    struct mesh_case c;
    struct diagnosis d = {0};
    int i[3];
    struct fv *s = mesh_case_start(
        &c, MPI_COMM_WORLD,
        "{ name = \"left\"; cells = (16, 16); max = (0.5, 1); i_min = \"periodic\"; i_max = "
        "\"joined\"; j_min = \"periodic\"; j_max = \"periodic\"; }, { name = \"right\"; cells = "
        "(16, 16); min = (0.5, 0); max = (1, 1); i_min = \"joined\"; i_max = \"periodic\"; "
        "j_min = \"periodic\"; j_max = \"periodic\"; }",
        NULL);
    for (const struct part *p = s->grid.part; p < s->grid.part + s->grid.nparts; p++)
        PART_CELLS (p, i, at)
            if (p->block == 1 && p->lo[0] + i[0] == 5 && p->lo[1] + i[1] == 7)
                s->u[1][at] = 1e3;
    integrate(s, 1e-9, &d);
    assert_true(d.bad);
    assert_non_null(strstr(d.reason, "cell (5, 7, 0) of block \"right\" is "));
    assert_non_null(strstr(d.where, "(0.671875, 0.46875, 0) m"));
    mesh_case_end(&c, &s);
}

/* Two blocks joined in the middle of a gap, each with its wall and that wall's own velocity; two
 * rings joined likewise, each wall with its spin. */
TEST(walls_of_blocks_move_on_their_own)
{
    struct mesh_case c;
    double worst = 0.0;
    struct fv *s = mesh_case_start(
        &c, MPI_COMM_WORLD,
        "{ name = \"low\"; cells = (8, 8); max = (1.0, 0.5); velocity = (-0.25, 0.0); i_min = "
        "\"periodic\"; i_max = \"periodic\"; j_min = \"wall\"; j_max = \"joined\"; }, "
        "{ name = \"high\"; cells = (8, 8); min = (0.0, 0.5); velocity = (0.75, 0.0); i_min = "
        "\"periodic\"; i_max = \"periodic\"; j_min = \"joined\"; j_max = \"wall\"; }",
        (const char *const[]){"initial.field=\"rest\"", "fluid.nu=0.5",
                              "domain.periodic=(true,false)", NULL});
    assert_true(mesh_case_run(s, 100000, 8.0));
    for (int q = 0; q < s->m->nparts; q++) {
        const struct part *p = s->m->part + q;
        for (int j = 0; j < p->n[1]; j++) {
            const double y = (p->lo[1] + j + 0.5) / 16.0 + 0.5 * p->block;
            worst = fmax(worst, fabs(s->u[0][part_at(p, 0, j, 0)] + 0.25 - y));
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    mesh_case_end(&c, &s);
    print_message("two walls: %.2e\n", worst);
    assert_true(worst < 2e-4);
    s = mesh_case_start(
        &c, MPI_COMM_WORLD,
        "{ name = \"in\"; mapping = \"annulus\"; cells = (8, 40); radius = (0.5, 0.75); spin = "
        "(2.0, 0.0); i_min = \"wall\"; i_max = \"joined\"; j_min = \"joined\"; j_max = "
        "\"joined\"; }, "
        "{ name = \"out\"; mapping = \"annulus\"; cells = (8, 40); radius = (0.75, 1.0); spin = "
        "(0.0, -0.5); i_min = \"joined\"; i_max = \"wall\"; j_min = \"joined\"; j_max = "
        "\"joined\"; }",
        (const char *const[]){"initial.field=\"rest\"", "fluid.nu=0.5",
                              "domain.periodic=(false,false)", NULL});
    assert_true(mesh_case_run(s, 100000, 2.0));
    worst = 0.0;
    for (int q = 0; q < s->m->nparts; q++) {
        const struct part *p = s->m->part + q;
        for (int i = 0; i < p->n[0]; i++) {
            const int at[3] = {p->lo[0] + i, p->lo[1], 0};
            const struct mesh_block *b = s->m->block + p->block;
            const double *x = b->centre[mesh_cell(b, at)], r = hypot(x[0], x[1]);
            const double exact = -4.0 / 3.0 * r + 2.5 / 3.0 / r; /* A r + B/r */
            const int64_t m = part_at(p, i, 0, 0);
            worst = fmax(worst, fabs((s->u[1][m] * x[0] - s->u[0][m] * x[1]) / r - exact));
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    mesh_case_end(&c, &s);
    print_message("two rings: %.2e\n", worst);
    assert_true(worst < 3e-3); /* an average is compared with a value */
}

/* A start costs a few cycles of multigrid, as many on sixteen times the cells. */
TEST(a_start_is_linear_in_the_cells)
{
    int64_t its[2], retries = 0;
    for (int k = 0; k < 2; k++) {
        struct mesh_case c;
        char text[256];
        const int n = k ? 128 : 32;
        sized(text, sizeof text, "name = \"a\"; " PERIODIC, n, n, 1);
        struct fv *s = mesh_case_start(&c, MPI_COMM_WORLD, text, NULL);
        its[k] = s->totals.start_iterations;
        retries += s->totals.retries;
        mesh_case_end(&c, &s);
    }
    print_message("iterations at the start: %d, %d\n", (int)its[0], (int)its[1]);
    assert_int_equal(retries, 0);
    assert_true(its[0] > 0 && its[1] < 2 * its[0]);
}

/* The same flow as fv.cells makes it: one uniform block. */
TEST(one_uniform_block_is_the_plain_solver)
{
    struct mesh_case c;
    char text[256];
    sized(text, sizeof text, "name = \"a\"; " PERIODIC, 32, 32, 1);
    const char *const tight[] = {"fv.tol_pressure=1e-10", "fv.tol_viscous=1e-10", NULL};
    struct fv *s = mesh_case_start(&c, MPI_COMM_SELF, text, tight);
    struct diagnosis d = {0};
    integrate(s, 0.02, &d);
    struct run r = c.run;
    mesh_given_count = 0;
    struct fv_params *prm = (struct fv_params *)(uintptr_t)fv_params_of(&r);
    prm->cells[0] = prm->cells[1] = 32;
    r.t = 0.0;
    struct fv *plain = fv_create(&r, NULL);
    double worst = 0.0;
    integrate(plain, 0.02, &d);
    for (int j = 0; j < 32; j++)
        for (int i = 0; i < 32; i++)
            for (int a = 0; a < 2; a++)
                worst = fmax(worst, fabs(plain->u[a][block_at(&plain->b, i, j, 0)] -
                                         s->u[a][part_at(s->m->part, i, j, 0)]));
    fv_free(&plain);
    mesh_case_end(&c, &s);
    MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    assert_true(worst < 2e-4);
}

static void sums_on(MPI_Comm comm, const char *blocks, const char *const *overrides, double *sums)
{
    struct mesh_case c;
    double row[16];
    struct fv *s = mesh_case_start(&c, comm, blocks, overrides);
    const bool good = mesh_case_run(s, 4, 100.0);
    VALUES_OF(fv_row, s, row);
    sums[0] = good ? row[0] : NAN;
    sums[1] = row[1];
    sums[2] = s->t;
    mesh_case_end(&c, &s);
}

static void agree(const char *blocks, const char *const *overrides)
{
    double alone[3], shared[3];
    sums_on(MPI_COMM_SELF, blocks, overrides, alone);
    sums_on(MPI_COMM_WORLD, blocks, overrides, shared);
    assert_close(most_apart(3, alone, shared), 0.0, 1e-8);
}

TEST(ranks_agree)
{
    char text[512];
    const char *const tight[] = {"fv.tol_pressure=1e-11", "fv.tol_viscous=1e-11", NULL};
    agree(four, tight);
    sized(text, sizeof text, RING, 6, 30, 1);
    agree(text, (const char *const[]){tight[0], tight[1], "initial.field=\"rest\"", NULL});
    snprintf(text, sizeof text,
             "{ " WAVE "k_min = \"periodic\"; k_max = \"periodic\"; cells = (12, 10, 8); }");
    agree(text, (const char *const[]){tight[0], tight[1], "domain.dim=3", NULL});
}

static void goes_on_bit_for_bit(const char *blocks, const char *const *overrides)
{
    struct mesh_case one, two;
    struct fv *s = mesh_case_start(&one, MPI_COMM_WORLD, blocks, overrides);
    mesh_case_read(&two, MPI_COMM_WORLD, blocks, overrides);
    assert_int_equal(mesh_case_restart(&one, s, &two, 3), 0);
}

TEST(restart_is_exact)
{
    char text[512];
    sized(text, sizeof text, RING, 8, 32, 1);
    goes_on_bit_for_bit(four, NULL);
    goes_on_bit_for_bit(four, (const char *const[]){"fv.integrator=\"bdf2\"", NULL});
    goes_on_bit_for_bit(four, (const char *const[]){"fv.integrator=\"newton\"", NULL});
    goes_on_bit_for_bit(text, (const char *const[]){"initial.field=\"rest\"", NULL});
    goes_on_bit_for_bit(
        "{ name = \"a\"; mapping = \"sheared\"; wave = 0.05; cells = (20, 20); i_min "
        "= \"exact\"; i_max = \"exact\"; j_min = \"exact\"; j_max = \"exact\"; }",
        (const char *const[]){"domain.periodic=(false,false)", NULL});
}

/* Upright boxes of one size have shorter sums, which are the same. */
TEST(even_parts_are_computed_alike)
{
    double worst = 0.0;
    struct mesh_case one, two;
    struct fv *s = mesh_case_start(&one, MPI_COMM_WORLD, four, NULL),
              *z = mesh_case_start(&two, MPI_COMM_WORLD, four, NULL);
    int even = 0;
    for (int q = 0; q < s->grid.nparts; q++) {
        even += s->grid.part[q].kind == PART_EVEN;
        z->m->part[q].kind = PART_CURVED;
    }
    MPI_Allreduce(MPI_IN_PLACE, &even, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    assert_true(even > 0); /* the block that is upside down is none of them */
    assert_true(mesh_case_run(s, 3, 100.0) && mesh_case_run(z, 3, 100.0));
    for (int64_t c = 0; c < s->m->size_local; c++)
        for (int a = 0; a < 2 && s->free[c] > 0.0; a++)
            worst = fmax(worst, fabs(s->u[a][c] - z->u[a][c]));
    MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    print_message("%.3g m/s apart\n", worst);
    assert_true(worst < 1e-10);
    mesh_case_end(&one, &s);
    mesh_case_end(&two, &z);
}

/* Errors of the cells are left as the steps shrink, whatever the integrator. */
TEST(bdf2_agrees_with_rk3_in_short_steps)
{
    double rk3[3], bdf2[3];
    mesh_case_errors(four, (const char *const[]){"fv.cfl=0.2", NULL}, 0.1, rk3);
    mesh_case_errors(four, (const char *const[]){"fv.cfl=0.2", "fv.integrator=\"bdf2\"", NULL}, 0.1,
                     bdf2);
    print_message("velocity: rk3 %.4g, bdf2 %.4g\n", rk3[0], bdf2[0]);
    assert_close(bdf2[0], rk3[0], 0.02);
}

/* Faults of a case with these blocks, as text of rank 0. */
static void finds(const char *blocks, const char *word)
{
    struct mesh_case c;
    mesh_case_read(&c, MPI_COMM_WORLD, blocks, NULL);
    assert_true(mesh_case_refused(&c, word));
}

TEST(faults_are_told)
{
    finds("{ name = \"a\"; cells = (8, 8); i_min = \"glued\"; }", "overlap");
    finds(
        "{ name = \"a\"; cells = (8, 8); i_min = \"joined\"; i_max = \"exact\"; j_min = \"exact\"; "
        "j_max = \"exact\"; }",
        "vertex by vertex");
    finds("{ name = \"a\"; cells = (8, 8); }", "orphan");
    finds("{ name = \"a\"; mapping = \"file\"; file = \"nowhere.xyz\"; }", "nowhere.xyz");
    finds("{ name = \"a\"; cells = (2, 8); " PERIODIC " }", "at least 6");
    finds("{ name = \"a\"; cells = (8, 8); lid = \"j_max\"; " PERIODIC " }", "no wall");
    finds("{ name = \"a\"; cells = (8, 8); stretch = (-1.0, 0.0); " PERIODIC " }", "only the map");
    finds("{ name = \"a\"; cells = (8, 8); lid = \"i_max\"; i_max = \"wall\"; i_min = "
          "\"wall\"; j_min = \"wall\"; j_max = \"wall\"; }",
          "velocity of the moving wall");
    finds("{ name = \"a\"; cells = (8, 8); lid = \"i_max\"; velocity = (1.0, 0.0); i_max = "
          "\"wall\"; i_min = \"wall\"; j_min = \"wall\"; j_max = \"wall\"; }",
          "along itself");
}

/* Writes a waving block as Plot3D or HDF5, by rank 0. */
static void write_file(const char *path, int form, int n, bool mirrored)
{
    int rank;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    double *x = NEW(double, 2 * (n + 1) * (n + 1));
    for (int j = 0; j <= n; j++)
        for (int i = 0; i <= n; i++) {
            const double X = (double)i / n, Y = (double)j / n;
            const double w = 0.06 * sin(2.0 * M_PI * X) * sin(2.0 * M_PI * Y);
            x[2 * (i + (n + 1) * j)] = mirrored ? 1.0 - X - w : X + w;
            x[2 * (i + (n + 1) * j) + 1] = Y + w;
        }
    if (form == 0) {
        struct h5 *f = h5_create(MPI_COMM_WORLD, path);
        h5_write_block(f, "x", "m", 2, (const int[]){n + 1, n + 1}, (const int[]){0, 0},
                       rank == 0 ? (const int[]){n + 1, n + 1} : (const int[]){0, 0}, 2, x, false);
        h5_close(&f);
    } else if (rank == 0) {
        FILE *f = fopen(path, "wb");
        const int32_t head[3] = {1, n + 1, n + 1};
        if (!f)
            abort();
        if (form == 1)
            fprintf(f, "1\n%d %d\n", n + 1, n + 1);
        else
            fwrite(head, 4, 3, f);
        for (int c = 0; c < 2; c++)
            for (int k = 0; k < (n + 1) * (n + 1); k++)
                if (form == 1)
                    fprintf(f, "%.17g\n", x[2 * k + c]);
                else
                    fwrite(x + 2 * k + c, 8, 1, f);
        fclose(f);
    }
    mem_free(x);
    MPI_Barrier(MPI_COMM_WORLD);
}

TEST(blocks_come_from_files)
{
    static const char *const suffix[] = {"h5", "p3d", "xyz"};
    const char *dir = getenv("TEST_SCRATCH");
    char text[512], path[1100], name[64];
    int id = (int)getpid();
    double e[3], f[3];
    MPI_Bcast(&id, 1, MPI_INT, 0, MPI_COMM_WORLD);
    sized(text, sizeof text, WAVE, 24, 24, 1);
    mesh_case_errors(text, NULL, 0.1, e);
    for (int form = 0; form < 3; form++) {
        snprintf(name, sizeof name, "wave_%d.%s", id, suffix[form]);
        snprintf(path, sizeof path, "%s/%s", dir ? dir : P_tmpdir, name);
        write_file(path, form, 24, false);
        snprintf(text, sizeof text,
                 "{ name = \"a\"; mapping = \"file\"; file = \"%s\"; " PERIODIC " }", name);
        mesh_case_errors(text, NULL, 0.1, f);
        assert_close(f[0] / e[0], 1.0, 1e-3);
        if (form == 0) {
            write_file(path, form, 24, true);
            finds(text, "inside out");
        }
        MPI_Barrier(MPI_COMM_WORLD);
        remove(path);
    }
}

/* Kinetic energy of vortices that are carried along, wherever they are in waving cells: U^2/4 and
 * that of the stream, to fourth order (squares of averages: 2.6 and 0.7 % less). */
TEST(energy_is_of_fourth_order)
{
    double e[2];
    for (int k = 0; k < 2; k++) {
        struct mesh_case c;
        char text[256];
        double row[64];
        snprintf(text, sizeof text, "{ " WAVE "cells = (%d, %d); }", 16 << k, 16 << k);
        struct fv *s = mesh_case_start(&c, MPI_COMM_WORLD, text,
                                       (const char *const[]){"initial.field=\"taylor_green\"",
                                                             "initial.velocity=(0.3,-0.2)", NULL});
        const double U = c.run.scene.initial.U;
        VALUES_OF(fv_row, s, row);
        e[k] = row[0] / c.run.scene.fluid.rho / (0.25 * U * U + 0.5 * (0.09 + 0.04)) - 1.0;
        mesh_case_end(&c, &s);
    }
    print_message("energy: %.2e %.2e off\n", e[0], e[1]);
    assert_true(fabs(e[1]) < 1e-3 && log2(fabs(e[0] / e[1])) > 3.5);
}
