/* test_refinement_flow.c - flows through levels of refinement: every scheme, water at rest, a body
 * that the fluid moves.
 * ranks: 1 2. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/refinement/apr_params.h"
#include "sph_case.h"

/* A box of level 1; none where it is empty. */
static void refine(double x0, double y0, double x1, double y1)
{
    apr_given = (struct apr_params){0};
    if (x1 <= x0)
        return;
    apr_given.levels = apr_given.regions.n = apr_given.regions.of[0].level = 1;
    memcpy(apr_given.regions.of[0].min, (double[2]){x0, y0}, 2 * sizeof(double));
    memcpy(apr_given.regions.of[0].max, (double[2]){x1, y1}, 2 * sizeof(double));
}

static double vortices(int scheme, int transport, bool refined)
{
    struct sph_case c;
    sph_case_set(&c, 2, 32);
    c.prm.scheme = scheme;
    c.prm.transport = transport;
    c.prm.limiter = LIMITER_KOREN;
    c.prm.alpha = 0.02;
    c.prm.delta = 0.1;
    if (refined)
        refine(0.2, 0.25, 0.75, 0.8);
    struct sph *s = sph_case_start(&c, NULL);
    assert_true((s->finer != NULL) == refined);
    assert_true(sph_case_run(&c, (refined ? 40 : 20) / (SANITIZED ? 4 : 1), 100.0));
    const double error = velocity_error(s);
    DROP(c.s);
    refine(0.0, 0.0, 0.0, 0.0);
    return error;
}

/* Vortices through a box are no worse than without it, whatever the particles do to each other. */
TEST(every_scheme_keeps_its_order)
{
    static const int of[][2] = {
        {SCHEME_RIEMANN_ALE, TRANSPORT_TVS}, {SCHEME_RIEMANN_ALE, TRANSPORT_EULERIAN},
        {SCHEME_RIEMANN, TRANSPORT_TVS},     {SCHEME_RIEMANN, TRANSPORT_TVO},
        {SCHEME_RIEMANN, TRANSPORT_XSPH},    {SCHEME_DELTA, TRANSPORT_TVS},
        {SCHEME_STANDARD, TRANSPORT_TVS}};
    for (size_t k = SANITIZED ? 6 : 0; k < sizeof of / sizeof of[0]; k++) {
        const double plain = vortices(of[k][0], of[k][1], false);
        const double refined = vortices(of[k][0], of[k][1], true);
        print_message("scheme %d, transport %d: %.2e, refined %.2e\n", of[k][0], of[k][1], plain,
                      refined);
        assert_true(refined < 1.1 * plain);
    }
}

enum { PARTS = SANITIZED ? 20 : 4 }; /* of the stream's period a run takes one */

/* Vortices that a stream of 1 m/s carries along x: what their mean velocity misses of it after such
 * a part of the period. walled: between slip walls; strip: through a level across it. */
static double lost_by_stream(bool walled, bool strip, bool local)
{
    struct sph_case c;
    double sums[SUM_COUNT];
    sph_case_set(&c, 2, 32);
    struct scene *e = &c.run.scene;
    e->initial.velocity[0] = 1.0;
    e->domain.periodic[1] = !walled;
    e->nwalls = walled ? 2 : 0;
    for (int k = 0; k < e->nwalls; k++)
        e->walls[k].side = SIDE_Y_MIN + k;
    c.prm.scheme = SCHEME_RIEMANN_ALE;
    c.prm.transport = TRANSPORT_TVS;
    c.prm.limiter = LIMITER_KOREN;
    c.prm.walls = WALLS_NFM;
    if (strip)
        refine(0.2, -0.1, 0.8, 1.1);
    apr_given.local_steps = local;
    struct sph *s = sph_case_start(&c, NULL);
    assert_true((s->finer != NULL) == strip);
    const double end = (SANITIZED ? 0.25 : 1.0) / PARTS;
    while (s->t < end)
        assert_true(sph_case_run(&c, 1, end));
    sph_sums(s, sums);
    DROP(c.s);
    refine(0.0, 0.0, 0.0, 0.0);
    return sums[SUM_MOMENTUM] / sums[SUM_MASS] - 1.0;
}

/* No observer is at rest rather than another: mass that edges of levels and walls lose or create,
 * and that comes back elsewhere, takes its momentum along, so that nothing slows a stream. Guards
 * give nothing back, which may cost 1 % of it a period. */
TEST_ALONE(vortices_are_carried_whole)
{
    if (!is_alone())
        skip();
    static const bool of[][3] = {
        {true, false, false}, {false, true, false}, {true, true, false}, {false, true, true}};
    for (int k = SANITIZED ? 2 : 0; k < (SANITIZED ? 3 : 4); k++) {
        const double lost = lost_by_stream(of[k][0], of[k][1], of[k][2]);
        print_message("walls %d, strip %d, own steps %d: %.2e of the stream\n", of[k][0], of[k][1],
                      of[k][2], lost);
        /* sums over vortices swing as a row changes level */
        assert_close(lost, 0.0, of[k][1] ? fmax(0.01 / PARTS, 1e-3) : 1e-6);
    }
}

/* Amplitude of the velocity of guards over that of the vortices there, less 1, on the lattice of
 * the start and one step on. */
static double amplitude_of_guards(int kind)
{
    struct sph_case c;
    sph_case_set(&c, 2, 32);
    c.prm.scheme = SCHEME_RIEMANN_ALE;
    c.prm.transport = TRANSPORT_TVS;
    c.prm.limiter = LIMITER_KOREN;
    refine(0.2, 0.25, 0.75, 0.8);
    apr_given.guards = kind;
    struct sph *s = sph_case_start(&c, NULL);
    const struct exact e = exact_create(&s->run->scene);
    double sums[2] = {0.0};
    assert_true(sph_case_run(&c, 1, 100.0));
    integrate_gradients(s); /* as for an output: at the end of a step only some have been set */
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++) {
            const double *line = prim_line(&q->p, i), x[3] = {line[0], line[1], 0.0};
            double u[3];
            if (!particles_is_guard(&q->p, i))
                continue;
            exact_point(&e, x, s->t, u, NULL, NULL);
            for (int a = 0; a < 2; a++) {
                sums[0] += line[2 + a] * u[a];
                sums[1] += u[a] * u[a];
            }
        }
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    DROP(c.s);
    refine(0.0, 0.0, 0.0, 0.0);
    return sums[0] / sums[1] - 1.0;
}

/* A mean over the kernel of the finer level, R = 4/64, takes <r^2> k^2/4 from a field whose
 * Laplacian is -k^2 times it: k^2 = 8 pi^2 and <r^2> = 5/36 R^2, that is 1.07 %, but for sums over
 * so few coarse particles; slopes, to third order, a tenth of it at most. */
TEST(means_of_guards_damp_as_kernels_do)
{
    const double pi = acos(-1.0), R = 4.0 / 64.0, law = -8.0 * pi * pi * 5.0 / 144.0 * R * R;
    const double mean = amplitude_of_guards(GUARDS_MEAN),
                 slopes = amplitude_of_guards(GUARDS_SLOPES);
    print_message("guards by means %.4f (%.4f), by slopes %.5f\n", mean, law, slopes);
    assert_close(mean, law, -0.2 * law);
    assert_close(slopes, 0.0, -0.1 * law);
}

/* Kinetic energy of what flows, and how many particles there are of both levels, after 70 steps of
 * vortices that a mirror at x = 1/2 leaves as they are, through a box that it does not. */
static void run_mirrored(MPI_Comm comm, bool mirrored, double *kinetic, double *count)
{
    struct sph_case c;
    double sums[SUM_COUNT];
    sph_case_set(&c, 2, 32);
    c.run.comm = comm;
    MPI_Comm_rank(comm, &c.run.rank);
    MPI_Comm_size(comm, &c.run.size);
    c.prm.scheme = SCHEME_RIEMANN_ALE;
    c.prm.transport = TRANSPORT_TVS;
    c.prm.limiter = LIMITER_KOREN;
    refine(mirrored ? 0.3 : 0.1, 0.2, mirrored ? 0.9 : 0.7, 0.7);
    struct sph *s = sph_case_start(&c, NULL);
    assert_true(sph_case_run(&c, SANITIZED ? 6 : 70, 100.0));
    sph_sums(s, sums);
    *kinetic = sums[SUM_KINETIC];
    *count = s->p.n + s->finer->p.n;
    MPI_Allreduce(MPI_IN_PLACE, count, 1, MPI_DOUBLE, MPI_SUM, comm);
    DROP(c.s);
    refine(0.0, 0.0, 0.0, 0.0);
}

/* Births and deaths know neither left nor right nor ranks: what is left is rounding and its growth
 * (turns by the place of cells in the lattice: 8e-4 of the energy). */
TEST(a_mirror_and_ranks_change_nothing)
{
    double kinetic[3], count[3];
    run_mirrored(MPI_COMM_WORLD, false, kinetic, count);
    run_mirrored(MPI_COMM_WORLD, true, kinetic + 1, count + 1);
    if (!is_alone())
        run_mirrored(MPI_COMM_SELF, false, kinetic + 2, count + 2);
    for (int k = 1; k < (is_alone() ? 2 : 3); k++) {
        print_message("energy off by %.2e, %.0f particles, %.0f\n", kinetic[k] / kinetic[0] - 1.0,
                      count[0], count[k]);
        assert_close(kinetic[k], kinetic[0], 1e-8 * kinetic[0]);
        assert_true(count[k] == count[0]);
    }
}

/* Water 10 dx deep in a tank of 24 dx; a box from the middle to the wall and out of the water. */
static void set_tank(struct sph_case *c, int scheme, int walls)
{
    struct scene *e = sph_case_tank(c, 20, 1.0, 3);
    e->time.end = 10.0;
    e->domain.max[0] = 1.2;
    e->nshapes = 1;
    e->shapes[0].form = SHAPE_BOX;
    e->shapes[0].box[1][0] = 1.2;
    e->shapes[0].box[1][1] = 0.5;
    c->prm.scheme = scheme;
    c->prm.transport = TRANSPORT_NONE;
    c->prm.surface = SURFACE_YES;
    c->prm.walls = walls;
    c->prm.alpha = 0.02;
    c->prm.delta = 0.1;
    c->prm.density_limit = 0.5;
    refine(0.45, -0.1, 1.3, 1.1);
}

/* Sum of the squares of all places and momenta, those of guards, too, after ten steps of a tank
 * that sloshes through the edge of a box, where some of the coarse guards are deep; shown: slopes
 * are made for an output after each step. */
static double state_of(bool shown)
{
    struct sph_case c;
    double sums[2] = {0.0, 0.0};
    set_tank(&c, SCHEME_RIEMANN, WALLS_NFM);
    c.run.scene.fluid.gravity[0] = 0.5;
    c.prm.transport = TRANSPORT_TVS;
    c.prm.R_dx = 3.0;
    refine(0.1, -0.1, 1.3, 1.1);
    struct sph *s = sph_case_start(&c, NULL);
    for (int k = 0; k < 10; k++) {
        assert_true(sph_case_run(&c, 1, 100.0));
        if (shown || k == 9) /* which gives guards the fields of the end */
            integrate_gradients(s);
    }
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++) {
            sums[0] += (q->p.role[i] & ROLE_DEEP) != 0;
            for (int k = 0; k < 4; k++)
                sums[1] += pow(state_row(&q->p, q->p.y, i)[k], 2.0);
        }
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    assert_true(sums[0] > 0.0);
    DROP(c.s);
    refine(0.0, 0.0, 0.0, 0.0);
    return sums[1];
}

/* Rows of a uniform stream pass from level to level, and no sum over the fluid knows it: where two
 * levels meet each particle counts by its share. */
TEST(sums_of_a_stream_stay_at_edges)
{
    struct sph_case c;
    double start[SUM_COUNT], now[SUM_COUNT];
    sph_case_set(&c, 2, 32);
    c.run.scene.initial.field = FIELD_UNIFORM;
    c.run.scene.initial.velocity[0] = 1.0;
    c.prm.scheme = SCHEME_RIEMANN_ALE;
    refine(0.2, 0.0, 0.8, 1.0);
    struct sph *s = sph_case_start(&c, NULL);
    sph_sums(s, start);
    assert_close(start[SUM_MOMENTUM], 1.0, 1e-9);
    for (int k = 0; k < (SANITIZED ? 8 : 25); k++) { /* of 0.05 dx */
        assert_true(sph_case_run(&c, 1, 100.0));
        sph_sums(s, now);
        assert_close(now[SUM_MASS], start[SUM_MASS], 1e-9);
        assert_close(now[SUM_MOMENTUM], start[SUM_MOMENTUM], 1e-9);
        assert_close(now[SUM_KINETIC], start[SUM_KINETIC], 1e-9);
    }
    DROP(c.s);
    refine(0.0, 0.0, 0.0, 0.0);
}

/* A level stream under a surface, 10 dx deep, through a region from floor to surface: nothing
 * pushes it, so that it keeps its mean velocity. Guards gave it 0.33 % in this time. */
TEST(a_level_stream_keeps_its_speed)
{
    if (SANITIZED)
        skip();
    struct sph_case c;
    double start[SUM_COUNT], now[SUM_COUNT];
    set_tank(&c, SCHEME_RIEMANN, WALLS_NFM);
    struct scene *e = &c.run.scene;
    e->domain.max[0] = e->shapes[0].box[1][0] = 2.0;
    e->domain.periodic[0] = true;
    e->nwalls = 1;
    e->walls[0].side = SIDE_Y_MIN;
    e->initial.field = FIELD_UNIFORM;
    e->initial.velocity[0] = 0.1;
    c.prm.transport = TRANSPORT_TVS;
    c.prm.limiter = LIMITER_KOREN;
    refine(0.6, -0.1, 1.4, 1.1);
    struct sph *s = sph_case_start(&c, NULL);
    sph_sums(s, start);
    while (s->t < 3.0)
        assert_true(sph_case_run(&c, 1, 100.0));
    sph_sums(s, now);
    const double gained = now[SUM_MOMENTUM] / start[SUM_MOMENTUM] - 1.0;
    print_message("level stream: %+.2e of its momentum\n", gained);
    assert_close(gained, 0.0, 2e-3);
    DROP(c.s);
    refine(0.0, 0.0, 0.0, 0.0);
}

/* An output leaves no trace. Deep guards, given fields once a step, had them in its first stage
 * only, so that with a surface they stood still unless an output came. */
TEST(an_output_leaves_no_trace)
{
    const double shown = state_of(true), plain = state_of(false);
    print_message("%.15g with outputs, %.15g without\n", shown, plain);
    assert_true(fabs(shown - plain) < 1e-12 * shown);
}

/* It stays at rest; without a common pressure at rest a circulation stood at the box's edge. */
TEST(water_at_rest_stays)
{
    static const int of[][2] = {{SCHEME_RIEMANN, WALLS_NFM}, {SCHEME_DELTA, WALLS_GHOSTS}};
    for (int k = SANITIZED; k < 2; k++) {
        struct sph_case c;
        set_tank(&c, of[k][0], of[k][1]);
        struct sph *s = sph_case_start(&c, NULL);
        assert_non_null(s->finer);
        while (s->t < (SANITIZED ? 0.1 : 0.5))
            assert_true(sph_case_run(&c, 1, 100.0));
        print_message("tank at rest: %.2e c0\n", s->total.max_mach);
        assert_true(s->total.max_mach < 1e-3);
        DROP(c.s);
    }
    refine(0.0, 0.0, 0.0, 0.0);
}

/* A square that is pushed through a fluid in a full tank: its velocity after a while. from: corner
 * of a box around it; 0: none. */
static double pushed(int cells, double from)
{
    struct sph_case c;
    sph_case_set(&c, 2, cells);
    struct scene *e = &c.run.scene;
    e->initial.field = FIELD_REST;
    e->fluid.nu = 0.0;
    e->time.end = 10.0;
    e->nbodies = 1;
    struct scene_body *b = e->bodies;
    b->points.n = 4;
    memcpy(b->points.x,
           (double[4][2]){{0.375, 0.375}, {0.375, 0.625}, {0.625, 0.625}, {0.625, 0.375}},
           8 * sizeof(double));
    strcpy(b->name, "square");
    b->free = true;
    b->density = 2.0;
    b->velocity[0] = 0.5;
    b->spin[2] = 1.0;
    c.prm.scheme = SCHEME_RIEMANN;
    c.prm.walls = WALLS_NFM;
    c.prm.density_limit = 0.5;
    if (from > 0.0) {
        refine(from, from, 1.0 - from, 1.0 - from);
        strcpy(apr_given.regions.of[0].follow, "square");
    }
    struct sph *s = sph_case_start(&c, NULL);
    while (s->t < 0.04)
        assert_true(sph_case_run(&c, 1, 0.04));
    for (const struct sph *q = s->finer; q; q = q->finer)
        assert_true(q->walls->bodies[0].free == s->walls->bodies[0].free &&
                    q->walls->bodies[0].now.x[0] == s->walls->bodies[0].now.x[0]);
    assert_true(max_anywhere(s->total.lost) == 0.0);
    const double u = s->walls->bodies[0].now.u[0];
    DROP(c.s);
    refine(0.0, 0.0, 0.0, 0.0);
    return u;
}

/* What it feels is one kernel's worth, wherever the fine particles end. */
TEST(a_body_moves_as_in_the_fine_fluid)
{
    if (SANITIZED)
        skip();
    const double fine = pushed(48, 0.0), both = pushed(24, 0.06), near = pushed(24, 0.15);
    print_message("body at %.5f m/s, %.5f refined, %.5f with the edge near\n", fine, both, near);
    assert_true(fine < 0.45); /* it has pushed */
    assert_close(both, fine, 0.005);
    assert_close(near, fine, 0.02);
}
