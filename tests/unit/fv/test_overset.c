/* test_overset.c - overlapping blocks: search, donors, order, a vortex that crosses, ranks, faults.
 * ranks: 1 4. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../fv/grid/overset.h"
#include "mesh_case.h"

/* A box over the periodic square, turned by 30 degrees. */
static void turned(char *text, size_t size, int n)
{
    snprintf(
        text, size,
        "{ name = \"back\"; cells = (%d, %d); " PERIODIC " }, "
        "{ name = \"turned\"; cells = (%d, %d); min = (0.22, 0.22); max = (0.78, 0.78); centre "
        "= (0.5, 0.5); angle = 30.0; }",
        n, n, 5 * n / 8, 5 * n / 8);
}

static const char ring[] =
    "{ name = \"back\"; cells = (32, 32); i_min = \"exact\"; i_max = \"exact\"; j_min = \"exact\"; "
    "j_max = \"exact\"; }, "
    "{ name = \"ring\"; mapping = \"annulus\"; centre = (0.5, 0.5); radius = (0.1, 0.36); cells = "
    "(16, 48); stretch = (1.0, 0.0); i_min = \"slip\"; j_min = \"joined\"; j_max = \"joined\"; }";

static double linear(const double *x) { return 0.3 + 1.7 * x[0] - 0.9 * x[1]; }

/* Every place is found, in the cell that the map puts there. */
TEST(search_finds_places)
{
    static const char *const blocks[] = {
        "{ name = \"a\"; mapping = \"annulus\"; radius = (0.5, 1.0); stretch = (1.5, 0.0); cells = "
        "(9, "
        "40); i_min = \"wall\"; i_max = \"wall\"; j_min = \"joined\"; j_max = \"joined\"; }",
        "{ name = \"a\"; mapping = \"sheared\"; wave = 0.06; cells = (21, 30); " PERIODIC " }",
        "{ name = \"a\"; mapping = \"stretched\"; stretch = (3.0, 1.0); focus = (0.3, 1.0); angle "
        "= "
        "20.0; cells = (21, 30); i_min = \"wall\"; i_max = \"wall\"; j_min = \"wall\"; j_max = "
        "\"wall\"; }"};
    for (int k = 0; k < 3; k++) {
        struct mesh_case c;
        int wrong = 0;
        struct fv *s = mesh_case_start(
            &c, MPI_COMM_WORLD, blocks[k],
            (const char *const[]){"initial.field=\"rest\"",
                                  k == 1 ? NULL : "domain.periodic=(false,false)", NULL});
        struct overset *o = overset_search(&c.run, s->m);
        const struct mesh_block *b = s->m->block;
        for (int t = 0; t < 400; t++) {
            const int at[3] = {(t * 7919) % b->n[0], (t * 104729) % b->n[1], 0};
            const double in[3] = {0.01 + 0.98 * fmod(t * 0.6180339, 1.0),
                                  0.01 + 0.98 * fmod(t * 0.7548776, 1.0), 0.0};
            double x[3], dx[3][3], xi[3];
            int cell[3];
            mesh_map_point(b, 2, at, in, x, dx);
            const bool found = overset_locate(s->m, o, 0, x, cell, xi);
            wrong += !found || cell[0] != at[0] || cell[1] != at[1] || fabs(xi[0] - in[0]) > 1e-9 ||
                     fabs(xi[1] - in[1]) > 1e-9;
        }
        assert_int_equal(wrong, 0);
        FREE(o);
        mesh_case_end(&c, &s);
    }
}

/* The fringe of a linear field from its averages: exact between boxes, also turned ones. */
TEST(linear_fields_are_exact)
{
    struct mesh_case c;
    char text[1024];
    double worst = 0.0;
    turned(text, sizeof text, 32);
    struct fv *s = mesh_case_start(&c, MPI_COMM_WORLD, text, NULL);
    const struct mesh *m = s->m;
    double *q = mesh_field(m);
    for (int pass = 0; pass < 2; pass++) {
        for (int r = 0; r < m->nparts; r++) {
            const struct part *p = m->part + r;
            const struct mesh_block *b = m->block + p->block;
            for (int j = 0; j < p->n[1]; j++)
                for (int i = 0; i < p->n[0]; i++) {
                    const int64_t at = part_at(p, i, j, 0);
                    const double f = linear(
                        b->centre[mesh_cell(b, (const int[]){p->lo[0] + i, p->lo[1] + j, 0})]);
                    if (pass == 0)
                        q[at] = m->status[at] == CELL_COMPUTED ? f : 1e3;
                    else if (m->status[at] == CELL_FRINGE)
                        worst = fmax(worst, fabs(q[at] - f));
                }
        }
        if (pass == 0)
            mesh_fill(s->m, 1, &q);
    }
    MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    assert_true(m->fringe_cells > 100 && m->linear == 0);
    mem_free(q);
    mesh_case_end(&c, &s);
    assert_true(worst < 1e-12);
}

/* What cells are: no computed cell behind the wall of the ring, none without its stencil. */
TEST(holes_are_cut)
{
    struct mesh_case c;
    struct fv *s = mesh_case_start(
        &c, MPI_COMM_WORLD, ring,
        (const char *const[]){"initial.field=\"uniform\"", "domain.periodic=(false,false)", NULL});
    const struct mesh_block *b = s->m->block;
    int wrong = 0, holes = 0;
    for (int j = 0; j < 32; j++)
        for (int i = 0; i < 32; i++) {
            const int64_t at = mesh_cell(b, (const int[]){i, j, 0});
            const double r = hypot(b->centre[at][0] - 0.5, b->centre[at][1] - 0.5);
            wrong += r < 0.13 && b->status[at] != CELL_HOLE;
            wrong += r > 0.36 && b->status[at] != CELL_COMPUTED;
            holes += b->status[at] == CELL_HOLE;
        }
    assert_int_equal(wrong, 0);
    assert_true(holes > 30);
    mesh_case_end(&c, &s);
}

/* Its energy counts once where blocks overlap, to a part of a row of cells along their edges (11 %
 * too much where each counted its own). */
TEST(a_uniform_flow_crosses)
{
    struct mesh_case c;
    char text[1024];
    double worst = 0.0;
    turned(text, sizeof text, 32);
    struct fv *s = mesh_case_start(&c, MPI_COMM_WORLD, text,
                                   (const char *const[]){"initial.field=\"uniform\"", NULL});
    const bool good = mesh_case_run(s, 5, 100.0);
    for (int64_t i = 0; i < s->m->size_local; i++)
        for (int a = 0; a < 2 && s->free[i] > 0.0; a++)
            worst = fmax(worst, fabs(s->u[a][i] - s->run->scene.initial.velocity[a]));
    const double share = mesh_case_energy_share(s);
    mesh_case_end(&c, &s);
    MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    assert_true(good && worst < 1e-12);
    assert_close(share, 1.0, 0.01);
}

/* Vortices carried through the overlap: order of u, vorticity, p; less than 2 % of them lost. */
TEST(vortices_cross)
{
    char text[1024];
    double e[2][3];
    for (int k = 0; k < 2; k++) {
        turned(text, sizeof text, 32 << k);
        mesh_case_errors(text, NULL, 0.5, e[k]);
    }
    print_message("turned: u %.2e %.2e p %.2e %.2e w %.2e %.2e\n", e[0][0], e[1][0], e[0][1],
                  e[1][1], e[0][2], e[1][2]);
    assert_true(e[1][0] < 0.02 && e[1][2] < 0.02);
    assert_true(log2(e[0][0] / e[1][0]) > 3.0 && log2(e[0][2] / e[1][2]) > 2.8);
    assert_true(log2(e[0][1] / e[1][1]) > 1.5);
}

TEST(ranks_agree)
{
    char text[1024];
    turned(text, sizeof text, 32);
    const char *const exact[] = {"fv.tol_pressure=1e-11", "fv.tol_viscous=1e-11", NULL};
    assert_true(mesh_case_ranks_apart(text, exact) < 1e-8);
}

TEST(orphans_are_named)
{
    struct mesh_case c;
    mesh_case_read(
        &c, MPI_COMM_WORLD,
        "{ name = \"back\"; cells = (16, 16); i_min = \"wall\"; i_max = \"wall\"; j_min = "
        "\"wall\"; j_max = \"wall\"; }, "
        "{ name = \"outside\"; cells = (16, 16); min = (0.5, 0.5); max = (1.5, 1.5); }",
        (const char *const[]){"domain.periodic=(false,false)", NULL});
    assert_true(mesh_case_refused(&c, "orphan"));
}
