/* test_outflow_blocks.c - blocks whose flow leaves as it is carried: a vortex passes out of joined,
 * stretched, curved and overlapping blocks as out of the uniform grid, with each integrator; what
 * comes in goes out; a restart changes nothing. ranks: 1 2. SPDX-License-Identifier: BSD-3-Clause
 */
#include "../test.h"

#include "mesh_case.h"

static const char *const steps[3] = {"fv.integrator=\"rk3\"", "fv.integrator=\"bdf2\"",
                                     "fv.integrator=\"newton\""};
static const char *const cfls[3] = {"fv.cfl=1", "fv.cfl=0.4", "fv.cfl=1"};

#define LOOP "j_min = \"periodic\"; j_max = \"periodic\"; "
static const char joined[] = "{ name = \"l\"; cells = (24, 48); max = (0.5, 1.0); i_max = "
                             "\"joined\"; " LOOP "}, { name = \"r\"; cells = (24, 48); min = (0.5, "
                             "0.0); max = (1.0, 1.0); i_min = \"joined\"; " LOOP "}";
/* two blocks share the side that the vortex leaves through */
static const char above[] =
    "{ name = \"low\"; cells = (48, 24); max = (1.0, 0.5); j_min = \"periodic\"; j_max = "
    "\"joined\"; }, { name = \"high\"; cells = (48, 24); min = (0.0, 0.5); max = (1.0, 1.0); "
    "j_min = \"joined\"; j_max = \"periodic\"; }";
static const char stretched[] =
    "{ name = \"one\"; mapping = \"stretched\"; stretch = (1.0, 0.0); focus = (0.6, 0.5); cells = "
    "(48, 48); " LOOP "}";
static const char curved[] =
    "{ name = \"one\"; mapping = \"sheared\"; wave = 0.03; cells = (48, 48); " LOOP "}";
static const char over[] = "{ name = \"back\"; cells = (48, 48); " LOOP
                           "}, { name = \"over\"; cells = (24, 24); min = (0.4, 0.3); max = (0.8, "
                           "0.7); angle = 20.0; centre = (0.6, 0.5); }";

static struct fv *start(struct mesh_case *c, MPI_Comm comm, const char *blocks, int step,
                        bool carried, struct h5 *f)
{
    mesh_case_read(c, comm, blocks,
                   (const char *const[]){"initial.field=\"uniform\"", "initial.velocity=(1,0)",
                                         "domain.periodic=(false,true)", "fluid.nu=1e-4",
                                         steps[step], cfls[step], step == 2 ? NULL : "fv.upwind=1",
                                         NULL});
    const struct scene_wall walls[] = {
        {.side = SIDE_X_MIN, .kind = WALL_INFLOW, .velocity = {1.0, 0.0, 0.0}},
        {.side = SIDE_X_MAX, .kind = WALL_OUTFLOW, .carried = carried}};
    memcpy(c->run.scene.walls, walls, sizeof walls);
    c->run.scene.nwalls = 2;
    return mesh_case_create(c, f);
}

/* An inlet that opens at once before fluid at rest moves all of it alike, the cells beside it, too:
 * they had 0.97, 1.28 and 0.81 of its velocity. */
TEST(an_inlet_starts_a_uniform_stream)
{
    const char *const all[] = {joined, stretched};
    for (int k = 0; k < 2; k++) {
        struct mesh_case c;
        double most = 0.0;
        mesh_case_read(&c, MPI_COMM_WORLD, all[k],
                       (const char *const[]){"initial.field=\"rest\"", "initial.U=1",
                                             "domain.periodic=(false,true)", "fluid.nu=1e-4",
                                             NULL});
        c.run.scene.walls[0] = (struct scene_wall){
            .side = SIDE_X_MIN, .kind = WALL_INFLOW, .velocity = {1.0, 0.0, 0.0}};
        c.run.scene.walls[1] = (struct scene_wall){.side = SIDE_X_MAX, .kind = WALL_OUTFLOW};
        c.run.scene.nwalls = 2;
        struct fv *s = mesh_case_create(&c, NULL);
        FLOW_ROWS (s, at, n)
            for (int64_t i = at; i < at + n; i++)
                most = fmax(most, fabs(s->u[0][i] - 1.0));
        print_message("%s: %.3g off\n", k ? "stretched" : "joined", most);
        assert_true(most < (k ? 5e-3 : 1e-5)); /* G of a psi that is linear in x */
        mesh_case_end(&c, &s);
    }
}

/* A vortex of Gaussian stream function in the uniform flow. */
static void add_vortex(struct fv *s, double x0, double y0)
{
    const double r = 0.1, A = 0.25 * sqrt(2.0) * exp(0.5);
    for (int q = 0; q < s->grid.nparts; q++) {
        const struct part *p = s->grid.part + q;
        const struct mesh_block *b = s->m->block + p->block;
        int i[3];
        PART_CELLS (p, i, c) {
            const int at[3] = {p->lo[0] + i[0], p->lo[1] + i[1], p->lo[2] + i[2]};
            const double *o = b->centre[mesh_cell(b, at)];
            const double x = (o[0] - x0) / r, y = (o[1] - y0) / r, e = A * exp(-x * x - y * y);
            s->u[0][c] -= e * y;
            s->u[1][c] += e * x;
        }
    }
    fv_project_start(s);
}

/* What is left of the vortex's velocity, relative to its largest, when it should have gone. */
static double left_behind(const char *blocks, int step, bool carried)
{
    struct mesh_case c;
    double most = 0.0;
    struct fv *s = start(&c, MPI_COMM_WORLD, blocks, step, carried, NULL);
    add_vortex(s, 0.6, 0.5);
    assert_true(mesh_case_run(s, 100000, 1.0));
    FLOW_ROWS (s, at, n)
        for (int64_t i = at; i < at + n; i++)
            if (s->free[i] > 0.0)
                most = fmax(most, hypot(s->u[0][i] - 1.0, s->u[1][i]));
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, s->comm);
    mesh_case_end(&c, &s);
    return most / 0.25;
}

TEST_ALONE(vortices_leave)
{
    static const struct {
        const char *blocks;
        int step;
        double most;
    } of[] = {{joined, 0, 8e-4},    {joined, 1, 8e-4}, {above, 2, 1.3e-3},
              {stretched, 0, 8e-4}, {curved, 1, 3e-3}, {over, 0, 8e-4}};
    for (size_t k = SANITIZED ? 5 : 0; k < sizeof of / sizeof of[0] && is_alone(); k++) {
        const double left = left_behind(of[k].blocks, of[k].step, true);
        print_message("%s: %.2g of the vortex stays\n", steps[of[k].step], left);
        assert_true(left < of[k].most);
    }
    if (!is_alone() || SANITIZED)
        return;
    const double given = left_behind(joined, 0, false);
    print_message("with given pressure %.2g\n", given);
    assert_true(given > 1e-3); /* so there was something to see */
}

/* m^2/s: largest net flux that the steps of a vortex on its way out leave. */
TEST(what_comes_in_goes_out)
{
    for (int k = 0; k < 3; k++) {
        struct mesh_case c;
        struct fv *s = start(&c, MPI_COMM_WORLD, above, k, true, NULL);
        add_vortex(s, 0.9, 0.4);
        for (int n = 0; n < 3; n++) {
            assert_true(mesh_case_run(s, 1, 1.0));
            assert_close(mesh_bc_net_flux(s), 0.0, 1e-12);
        }
        mesh_case_end(&c, &s);
    }
}

/* Two pipes end on one side of the domain, the lower one of two joined blocks: each has its own
 * parabola, and steady flow through both stays as it is. */
TEST(each_opening_has_its_parabola)
{
    static const char pipes[] =
        "{ name = \"a\"; cells = (8, 8); min = (0, 0); max = (1, 0.5); j_min = \"wall\"; j_max = "
        "\"joined\"; }, { name = \"b\"; cells = (8, 8); min = (0, 0.5); max = (1, 1); j_min = "
        "\"joined\"; j_max = \"wall\"; }, { name = \"c\"; cells = (8, 16); min = (0, 1.5); max = "
        "(1, 2); j_min = \"wall\"; j_max = \"wall\"; }";
    static const struct {
        int block;
        double y, u;
    } places[] = {{0, 0.0, 0.0}, {0, 0.25, 0.75}, {0, 0.5, 1.0},  {1, 0.5, 1.0},
                  {1, 1.0, 0.0}, {2, 1.5, 0.0},   {2, 1.75, 1.0}, {2, 2.0, 0.0}};
    struct mesh_case c;
    mesh_case_read(&c, MPI_COMM_WORLD, pipes,
                   (const char *const[]){"initial.field=\"rest\"", "domain.min=(0,0)",
                                         "domain.max=(1,2)", "fluid.nu=0.1", NULL});
    c.run.scene.walls[c.run.scene.nwalls++] = (struct scene_wall){.side = SIDE_X_MIN,
                                                                  .kind = WALL_INFLOW,
                                                                  .velocity = {1.0, 0.0, 0.0},
                                                                  .profile = PROFILE_PARABOLIC};
    c.run.scene.walls[c.run.scene.nwalls++] =
        (struct scene_wall){.side = SIDE_X_MAX, .kind = WALL_OUTFLOW};
    struct fv *s = mesh_case_create(&c, NULL);
    for (size_t k = 0; k < sizeof places / sizeof places[0]; k++) {
        double w[3];
        mesh_side_velocity(&c.run, s->m->block + places[k].block, 0,
                           (const double[]){0.0, places[k].y, 0.0}, w);
        assert_close(w[0], places[k].u, 1e-12);
    }
    assert_true(mesh_case_run(s, 1000, 8.0)); /* 8 times H^2/(pi^2 nu) */
    assert_close(s->max.u[0], 1.0, 0.01);     /* (h/H)^2 below the crest */
    mesh_case_end(&c, &s);
}

/* Largest velocity at t = 0.3 of a stream that starts at once through a waving block. */
static double fastest(double pressure)
{
    static const char block[] = "{ name = \"a\"; mapping = \"sheared\"; wave = 0.05; cells = (16, "
                                "16); min = (0, 0); max = (1, 1); j_min = \"wall\"; j_max = "
                                "\"slip\"; }";
    struct mesh_case c;
    mesh_case_read(&c, MPI_COMM_SELF, block,
                   (const char *const[]){"initial.field=\"rest\"", "domain.min=(0,0)",
                                         "domain.max=(1,1)", "fluid.nu=0.1", NULL});
    c.run.scene.walls[c.run.scene.nwalls++] =
        (struct scene_wall){.side = SIDE_X_MIN, .kind = WALL_INFLOW, .velocity = {1.0, 0.0, 0.0}};
    c.run.scene.walls[c.run.scene.nwalls++] =
        (struct scene_wall){.side = SIDE_X_MAX, .kind = WALL_OUTFLOW, .pressure = pressure};
    struct fv *s = mesh_case_create(&c, NULL);
    assert_true(mesh_case_run(s, 1000, 0.3));
    const double most = s->max.u[0];
    mesh_case_end(&c, &s);
    return most;
}

TEST(the_level_of_pressure_moves_nothing)
{
    const double u = fastest(0.0);
    assert_close(fastest(1e-6) / u, 1.0, 1e-6); /* as well as psi is solved for */
    assert_close(fastest(1e3) / u, 1.0, 1e-6);
}

static double energy(const struct fv *s)
{
    double sum = 0.0;
    FLOW_ROWS (s, c, n)
        for (int64_t i = c; i < c + n; i++)
            sum += s->free[i] * s->m->V[i] *
                   ((s->u[0][i] - 1.0) * (s->u[0][i] - 1.0) + s->u[1][i] * s->u[1][i]);
    return ranks_sum(s->comm, sum);
}

TEST(ranks_agree_and_a_restart_is_exact)
{
    struct mesh_case one, all, again;
    char path[1100];
    int64_t differ = 0;
    struct fv *s = start(&one, MPI_COMM_SELF, above, 0, true, NULL),
              *z = start(&all, MPI_COMM_WORLD, above, 0, true, NULL);
    add_vortex(s, 0.9, 0.4);
    add_vortex(z, 0.9, 0.4);
    assert_true(mesh_case_run(s, 3, 1.0) && mesh_case_run(z, 3, 1.0));
    assert_close(energy(z) / energy(s), 1.0, 1e-4); /* fv.tol_pressure */
    snprintf(path, sizeof path, "%s.h5", all.path);
    MPI_Bcast(path, sizeof path, MPI_CHAR, 0, MPI_COMM_WORLD);
    struct h5 *f = h5_create_restart(MPI_COMM_WORLD, path);
    fv_checkpoint(z, f);
    h5_close(&f);
    f = h5_open(MPI_COMM_WORLD, path);
    struct fv *y = start(&again, MPI_COMM_WORLD, above, 0, true, f);
    h5_close(&f);
    assert_non_null(y);
    y->t = z->t;
    assert_true(mesh_case_run(y, 3, 1.0) && mesh_case_run(z, 3, 1.0));
    FLOW_ROWS (y, c, n)
        for (int64_t i = c; i < c + n; i++)
            differ += y->u[0][i] != z->u[0][i] || y->p[i] != z->p[i];
    assert_int_equal(ranks_count(MPI_COMM_WORLD, differ), 0);
    mesh_case_end(&one, &s);
    mesh_case_end(&all, &z);
    mesh_case_end(&again, &y);
    MPI_Barrier(MPI_COMM_WORLD);
    remove(path);
}
