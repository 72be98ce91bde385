/* test_walls.c - walls: integrals in closed form against the table and quadrature, the
 * operators near walls, surface detection with and without wall terms, water at rest, ranks.
 * ranks: 1 4. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/output/probes.h"
#include "../../../sph/pairs/eigenvalue.h"
#include "../../../sph/pairs/kernel.h"
#include "../../../sph/surface/surface.h"
#include "../../../sph/walls/wall_points.h"
#include "../../../sph/walls/walls.h"
#include "sph_restart.h"

/* Corners of the table's walls, R = 1; returns their number. */
static int table_walls(const char *what, double p[20][2])
{
    if (strstr(what, "flat")) {
        p[0][0] = -5.0;
        p[1][0] = 5.0;
        p[0][1] = p[1][1] = 0.0;
        return 2;
    }
    if (strstr(what, "16-gon")) {
        for (int k = 0; k <= 16; k++) {
            p[k][0] = cos(-k * M_PI / 8.0);
            p[k][1] = sin(-k * M_PI / 8.0);
        }
        return 17;
    }
    const double a = (strstr(what, "270")  ? 270.0
                      : strstr(what, "45") ? 45.0
                                           : 90.0) *
                     M_PI / 180.0;
    p[0][0] = 3.0 * cos(a);
    p[0][1] = 3.0 * sin(a);
    p[1][0] = p[1][1] = p[2][1] = 0.0;
    p[2][0] = 3.0;
    return 3;
}

static double gamma_of(double p[20][2], int n, const double *x)
{
    double gamma = 1.0;
    for (int k = 0; k + 1 < n; k++) {
        const double d[2] = {p[k + 1][0] - p[k][0], p[k + 1][1] - p[k][1]}, l = hypot(d[0], d[1]);
        const double a[2] = {p[k][0] - x[0], p[k][1] - x[1]};
        const double along = (d[0] * a[0] + d[1] * a[1]) / l;
        gamma += wall_moments((d[1] * a[0] - d[0] * a[1]) / l, along, along + l).gamma;
    }
    return gamma;
}

TEST(gamma_agrees_with_the_table)
{
    char line[256], what[128];
    double x[2], wanted, p[20][2], worst = 0.0;
    int n = 0;
    FILE *f = fopen("tests/data/gamma2d.csv", "r");
    assert_non_null(f);
    while (fgets(line, sizeof line, f)) {
        if (sscanf(line, "%127[^,],%lf,%lf,%lf", what, x, x + 1, &wanted) != 4)
            continue;
        worst = fmax(worst, fabs(gamma_of(p, table_walls(what, p), x) - wanted));
        n++;
    }
    fclose(f);
    assert_true(n > 20);
    assert_close(worst, 0.0, 1e-12);
}

/* int W ds over a flat wall, in units of R: d gamma/dd [4.92's 2D form]. */
static double line_integral(double d)
{
    const double m = sqrt(1.0 - d * d), A = asinh(m / d), d2 = d * d, m3 = m * m * m;
    const double J1 = 0.5 * (m + d2 * A), J3 = 0.25 * (m + 3.0 * d2 * J1);
    const double J5 = (m + 5.0 * d2 * J3) / 6.0, K2 = d2 * m + m3 / 3.0;
    const double K4 = d2 * d2 * m + 2.0 * d2 * m3 / 3.0 + m3 * m * m / 5.0;
    return 14.0 / M_PI * (m - 10.0 * K2 + 20.0 * J3 - 15.0 * K4 + 4.0 * J5);
}

/* Against Simpson's rule, for walls at random; and sums over the pieces of a wall are the wall's.
 */
TEST(moments_are_integrals)
{
    enum { POINTS = 2000, WALLS = 300 };
    srand(7);
    for (int k = 0; k < WALLS; k++) {
        const double d = 1e-3 + rand() / (double)RAND_MAX;
        const double from = 2.4 * rand() / RAND_MAX - 1.2, to = from + 2.0 * rand() / RAND_MAX;
        const double half = sqrt(fmax(0.0, 1.0 - d * d));
        const double a = fmax(from, -half), b = fmin(to, half);
        const struct wall_moments m = wall_moments(d, from, to);
        double sum[2] = {0.0}, parts[3] = {0.0};
        for (int j = 0; j <= POINTS && b > a; j++) {
            const double y = a + (b - a) * j / POINTS, r = hypot(d, y);
            const double W = kernel_w(2, r, 1.0) * (b - a) / (3.0 * POINTS) *
                             (j == 0 || j == POINTS ? 1.0
                              : j % 2               ? 4.0
                                                    : 2.0);
            sum[0] += W;
            sum[1] += W * y;
        }
        assert_close(m.W, sum[0], 1e-8);
        assert_close(m.W * m.along, sum[1], 1e-8);
        for (int j = 0; j < 5; j++) {
            const double l = (to - from) / 5.0;
            const struct wall_moments p = wall_moments(d, from + j * l, from + (j + 1) * l);
            parts[0] += p.W;
            parts[1] += p.W * p.along;
            parts[2] += p.gamma;
        }
        assert_close(parts[0], m.W, 1e-10);
        assert_close(parts[1], m.W * m.along, 1e-10);
        assert_close(parts[2], m.gamma, 1e-10);
    }
}

/* Of a wall through points h apart at the distance d the part of Poisson's kernel that the Shepard
 * factor has, d/(pi r^2), sums to tanh(pi d/h) where the foot is between two points and to
 * coth(pi d/h) where it is on one; its integral is 1, and the rest is smooth. */
TEST(points_miss_gamma_before_them)
{
    const double h = 1.0 / WALL_POINTS;
    for (double d = 0.005; d < 1.0; d *= 1.3)
        for (int on = 0; on < 2; on++) {
            const double from = -5.0 + 0.5 * h * on, law = tanh(M_PI * d / h);
            const double gamma = wall_points(d, from, from + 10.0, true).gamma;
            const double off = gamma - wall_moments(d, from, from + 10.0).gamma;
            assert_close(off, 0.5 - 0.5 * (on ? 1.0 / law : law), 1e-3);
            assert_close(wall_points(-d, from, from + 10.0, true).gamma, -gamma, 1e-15);
        }
}

/* Midpoints of h err by h^2/24 times the largest second derivative along the wall: 140/pi of W,
 * less of W y. */
TEST(points_are_of_second_order)
{
    const double h = 1.0 / WALL_POINTS, most = 140.0 / M_PI * h * h / 24.0;
    srand(9);
    for (int k = 0; k < 300; k++) {
        const double d = 1.2 * rand() / RAND_MAX, from = 2.4 * rand() / RAND_MAX - 1.2;
        const double to = from + 1e-6 + 2.0 * rand() / RAND_MAX;
        const struct wall_moments m = wall_moments(d, from, to),
                                  p = wall_points(d, from, to, false);
        assert_close(p.W, m.W, most * (to - from));
        assert_close(p.W * p.along, m.W * m.along, most * (to - from));
        assert_close(p.gamma, m.gamma, 0.0);
    }
}

/* W is the derivative of gamma over a plane. */
TEST(gamma_rises_with_the_wall)
{
    for (double d = 0.02; d < 1.0; d += 0.07) {
        const double h = 1e-5, g1 = wall_moments(d, -5.0, 5.0).gamma;
        assert_close(wall_moments(d, -5.0, 5.0).W, line_integral(d), 1e-10);
        assert_close((wall_moments(d + h, -5.0, 5.0).gamma - g1) / h, line_integral(d), 1e-3);
    }
}

/* Friction on a wall leaves linear profiles as they are, and is 2 of y^2 as far as a lattice's
 * second moment goes; with the kernel's own integrals a linear one had 0.103 and -0.036 /R in two
 * rows. */
TEST(laplacian_at_a_wall)
{
    const double R = 4.0 / 32.0;
    print_message("Lap y %.3f %.3f /R, Lap y^2 %.3f %.3f\n", sph_case_laplacian(2, 32, 0, 1) * R,
                  sph_case_laplacian(2, 32, 1, 1) * R, sph_case_laplacian(2, 32, 0, 2),
                  sph_case_laplacian(2, 32, 1, 2));
    for (int row = 0; row < 2; row++) {
        assert_close(sph_case_laplacian(2, 32, row, 1) * R, 0.0, 1e-4);
        assert_close(sph_case_laplacian(2, 32, row, 2), 2.0, 0.03);
    }
}

/* Box [0,1]^2 of still fluid under gravity; closed walls on all sides, or open above. */
static void tank(struct sph_case *c, int cells, bool surface, int walls)
{
    struct scene *e = sph_case_tank(c, cells, 9.81, surface ? 3 : 4);
    e->fluid.rho = 1000.0;
    if (surface) {
        e->nshapes = 1;
        e->shapes[0] = (struct scene_shape){.form = SHAPE_BELOW, .level = 0.5};
    }
    c->prm.scheme = SCHEME_RIEMANN;
    c->prm.dissipation = 0.1;
    c->prm.surface = surface;
    c->prm.walls = walls;
    c->prm.c0 = 25.0;
}

static double largest_speed(const struct sph *s)
{
    double most = 0.0;
    for (int i = 0; i < s->p.n; i++) {
        const double *y = s->p.y + (size_t)i * s->p.nstate;
        double u2 = 0.0;
        for (int a = 0; a < s->dim; a++)
            u2 += y[s->dim + a] * y[s->dim + a];
        most = fmax(most, sqrt(u2) / y[2 * s->dim + 1]);
    }
    return max_anywhere(most);
}

TEST(water_at_rest_stays)
{
    for (int walls = WALLS_NFM; walls <= WALLS_GHOSTS; walls++) {
        static const double wanted[] = {1e-3, 1e-3}; /* of c0 */
        struct sph_case c;
        tank(&c, 20, true, walls);
        struct sph *s = sph_case_start(&c, NULL);
        double before = s->p.n, mass = s->start.mass, sums[SUM_COUNT];
        assert_true(sph_case_run(&c, SANITIZED ? 60 : 300, 10.0));
        MPI_Allreduce(MPI_IN_PLACE, &before, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
        sph_sums(s, sums);
        print_message("%s: |u| %.2g c0\n", s->walls->model->name, largest_speed(s) / s->c0);
        assert_close(before, 200.0, 0.0);
        assert_close(sums[SUM_MASS] / mass, 1.0, 1e-12);
        assert_true(SANITIZED || largest_speed(s) < wanted[walls] * s->c0);
        DROP(c.s);
    }
}

/* What the shift of a stirred tank does against gravity, over what it would if all of it sank. */
static double shift_work(int scheme)
{
    struct sph_case c;
    double sums[2] = {0.0, 0.0};
    tank(&c, 20, true, WALLS_NFM);
    c.prm.noise = 0.2;
    c.prm.scheme = scheme;
    c.prm.transport = TRANSPORT_TVS;
    struct sph *s = sph_case_start(&c, NULL);
    for (int i = 0; i < s->p.n; i++) {
        double *y = state_row(&s->p, s->p.y, i);
        y[2] = y[5] * sin(9.0 * y[0]) * cos(7.0 * y[1]);
        y[3] = y[5] * cos(5.0 * y[0] + 3.0 * y[1]);
    }
    integrate_gradients(s);
    for (int i = 0; i < s->p.n; i++) {
        const double *q = prim_line(&s->p, i), *u0 = slope_line(&s->p, i) + 6;
        sums[0] += q[at_volume(2)] * (u0[1] - q[3]);
        sums[1] += q[at_volume(2)] * hypot(u0[0] - q[2], u0[1] - q[3]);
    }
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    DROP(c.s);
    assert_true(sums[1] > 0.0);
    return fabs(sums[0]) / sums[1];
}

/* Else the level sinks: of densities that do not know of the shift. */
TEST(the_shift_is_workless)
{
    assert_true(shift_work(SCHEME_RIEMANN) < 1e-12);
    assert_true(shift_work(SCHEME_RIEMANN_ALE) > 1e-4); /* its densities know */
}

/* The force on a body in still water is its weight of water, from the first evaluation on. */
static void float_in_still_water(int integrals)
{
    struct sph_case c;
    tank(&c, 50, false, WALLS_NFM);
    c.prm.wall_integrals = integrals;
    struct scene_body *b = c.run.scene.bodies;
    c.run.scene.nbodies = 1;
    b->points.n = 4;
    memcpy(b->points.x, (double[4][2]){{0.4, 0.4}, {0.4, 0.6}, {0.6, 0.6}, {0.6, 0.4}},
           8 * sizeof(double));
    b->centre[0] = b->centre[1] = 0.5;
    struct sph *s = sph_case_start(&c, NULL);
    integrate_gradients(s);
    const struct force f = probes_force(s, 0);
    print_message("force %g %g N/m, moment %g N\n", f.F[0], f.F[1], f.M[2]);
    assert_close(f.F[0], 0.0, 1e-6);
    assert_close(f.F[1], 0.04 * 1000.0 * 9.81, 0.01 * 0.04 * 1000.0 * 9.81);
    assert_close(f.M[2], 0.0, 1e-6);
    DROP(c.s);
}

TEST(body_in_still_water)
{
    float_in_still_water(INTEGRALS_CLOSED);
    float_in_still_water(INTEGRALS_CENTROIDS);
    float_in_still_water(INTEGRALS_NUMERICAL);
}

/* Rates of the momentum along y of shallow water in a tension that comes down on the floor at 0.1
 * c0, beside a block on the floor or, without it, the tank's end at the same place. Keeps the
 * values of the particles in the four rows beside it; returns their number. */
static int fall_beside(bool block, double rate[64])
{
    struct sph_case c;
    int n = 0;
    tank(&c, 20, true, WALLS_NFM);
    struct scene *e = &c.run.scene;
    c.run.comm = MPI_COMM_SELF;
    c.run.rank = 0;
    c.run.size = 1;
    e->shapes[0].level = 0.15;
    e->domain.max[0] = block ? 1.0 : 0.4;
    e->nbodies = block;
    e->bodies[0].points.n = 4;
    memcpy(e->bodies[0].points.x, (double[4][2]){{0.4, 0.0}, {0.4, 0.4}, {0.6, 0.4}, {0.6, 0.0}},
           8 * sizeof(double));
    struct sph *s = sph_case_start(&c, NULL);
    for (int i = 0; i < s->p.n; i++) {
        double *y = state_row(&s->p, s->p.y, i);
        y[at_volume(2)] *= 1.004;
        y[3] = -0.1 * s->c0 * y[at_mass(2)];
    }
    integrate_prepare(s);
    integrate_rates(s);
    for (int i = 0; i < s->p.n; i++)
        if (prim_line(&s->p, i)[0] > 0.2 && prim_line(&s->p, i)[0] < 0.4 && n < 64)
            rate[n++] = state_row(&s->p, s->p.rate, i)[3] / state_row(&s->p, s->p.y, i)[at_mass(2)];
    DROP(c.s);
    return n;
}

/* What a block covers of a floor is no floor and no roof: neither its wave nor a lack of tension is
 * left there. */
TEST(a_block_covers_the_floor)
{
    double of_block[64], of_end[64];
    const int n = fall_beside(true, of_block);
    assert_int_equal(fall_beside(false, of_end), n);
    assert_true(n >= 12);
    for (int i = 0; i < n; i++)
        assert_close(of_block[i], of_end[i], 1e-6 * fabs(of_end[i]));
}

/* A star turned by `degrees' in the middle of a full tank: the least of what walls leave of the
 * supports. */
static double least_room(double degrees)
{
    struct sph_case c;
    tank(&c, 30, false, WALLS_NFM);
    struct scene_body *b = c.run.scene.bodies;
    c.run.scene.nbodies = 1;
    b->points.n = 8;
    for (int k = 0; k < 8; k++) { /* tips of 53 degrees, clockwise */
        const double r = k % 2 ? 0.15 : 0.05 * sqrt(2.0), at = M_PI / 180.0 * (degrees - 45.0 * k);
        b->points.x[k][0] = 0.5 + r * cos(at);
        b->points.x[k][1] = 0.5 + r * sin(at);
    }
    b->centre[0] = b->centre[1] = 0.5;
    struct sph *s = sph_case_start(&c, NULL);
    integrate_gradients(s);
    double *room = walls_rooms(s), least = 1.0;
    for (int i = 0; i < s->p.n; i++)
        least = fmin(least, room[i]);
    mem_free(room);
    DROP(c.s);
    return -max_anywhere(-least);
}

/* In the corner of a tank a quarter of the support is fluid, before tips more than half of it: none
 * of those particles is taken for one behind a wall, whose volume would be none. */
TEST(sharp_tips_leave_room)
{
    for (double degrees = 0.0; degrees < 90.0; degrees += 5.0)
        assert_true(least_room(degrees) > 0.25);
}

/* A gauge with a radius reads the mean over its face: the weight of the water in its middle, and of
 * one particle's own pressure no more than that particle's share of the face. */
TEST(gauge_reads_mean)
{
    struct sph_case c;
    double row[2], loud[2];
    tank(&c, 50, false, WALLS_NFM);
    c.run.scene.nprobes = 2;
    for (int k = 0; k < 2; k++)
        c.run.scene.probes[k] = (struct scene_probe){
            .kind = PROBE_PRESSURE, .at = {0.51, 0.51}, .radius = k ? 0.1 : 0.0};
    struct sph *s = sph_case_start(&c, NULL);
    integrate_gradients(s);
    VALUES_OF(probes_row, s, row);
    for (int i = 0; i < s->p.n; i++) {
        double *q = prim_line(&s->p, i);
        if (hypot(q[0] - 0.51, q[1] - 0.51) < 0.5 * s->dx)
            q[at_rho(2)] *= 1.01;
    }
    VALUES_OF(probes_row, s, loud);
    print_message("gauge: %g, %g Pa; one loud particle: +%g, +%g\n", row[0], row[1],
                  loud[0] - row[0], loud[1] - row[1]);
    for (int k = 0; k < 2; k++)
        assert_close(row[k], 0.49 * 1000.0 * 9.81, 0.01 * 1000.0 * 9.81);
    assert_true(loud[0] > row[0] + 500.0);
    assert_close((loud[1] - row[1]) / (loud[0] - row[0]), 0.64, 0.02); /* (R/radius)^2 */
    for (int i = 0; i < s->p.n + s->p.nghost; i++) { /* all but that one weigh nothing now */
        double *q = prim_line(&s->p, i);
        if (hypot(q[0] - 0.51, q[1] - 0.51) > 0.5 * s->dx)
            q[at_volume(2)] = 0.0;
    }
    VALUES_OF(probes_row, s, row);
    assert_close(row[1] / row[0], 7.0 / M_PI * 0.04 / 0.25, 0.01); /* w W(0), of a quarter */
    DROP(c.s);
}

/* A closed ALE run: pair fluxes with mirrored ghosts are antisymmetric, NFM gives mass back. */
TEST(mass_is_kept)
{
    for (int walls = WALLS_NFM; walls <= WALLS_GHOSTS; walls++) {
        struct sph_case c;
        double sums[SUM_COUNT];
        tank(&c, 24, false, walls);
        c.prm.scheme = SCHEME_RIEMANN_ALE;
        c.prm.noise = 0.2;
        sph_case_start(&c, NULL);
        assert_true(sph_case_run(&c, 20, 10.0));
        sph_sums(c.s, sums);
        assert_close(sums[SUM_MASS] / c.s->start.mass, 1.0, 1e-12);
        DROP(c.s);
    }
}

/* Flat surface: row 1 and no other; along walls nobody, with wall terms or with ghosts. */
TEST(surface_is_found)
{
    for (int walls = WALLS_NFM; walls <= WALLS_GHOSTS; walls++)
        for (int noise = 0; noise < 3; noise++) {
            struct sph_case c;
            long missed = 0, falsely = 0;
            tank(&c, 20, true, walls);
            c.prm.noise = 0.1 * noise;
            struct sph *s = sph_case_start(&c, NULL);
            integrate_gradients(s);
            for (int i = 0; i < s->p.n; i++) {
                const int64_t row = s->p.id[i] / 20;
                missed += row == 9 && s->surface->is[i] != SURFACE_ON;
                falsely += row < (noise == 0 ? 9 : 8) && s->surface->is[i] == SURFACE_ON;
            }
            assert_true(none_anywhere(missed));
            assert_true(none_anywhere(falsely));
            DROP(c.s);
        }
}

TEST(eigenvalues)
{
    const double M[9] = {2.0, 0.3, 0.1, 0.3, 1.5, -0.2, 0.1, -0.2, 0.7};
    const double lambda = eigenvalue_smallest(M, 3), shift = lambda + 1e-9;
    /* det(M - lambda) changes sign there and M - lambda is positive semidefinite */
    const double a = M[0] - lambda, b = M[4] - lambda, c = M[8] - lambda;
    const double det = a * (b * c - 0.04) - 0.3 * (0.3 * c + 0.02) + 0.1 * (-0.06 - 0.1 * b);
    assert_close(det, 0.0, 1e-12);
    assert_true(a > 0.0 && a * b - 0.09 > 0.0 && shift < 0.7);
    assert_close(eigenvalue_smallest((double[4]){2.0, 1.0, 1.0, 2.0}, 2), 1.0, 1e-15);
}

static double energy_after(int walls, MPI_Comm comm)
{
    struct sph_case c;
    double sums[SUM_COUNT];
    tank(&c, 24, true, walls);
    c.prm.noise = 0.1;
    c.run.comm = comm;
    MPI_Comm_rank(comm, &c.run.rank);
    MPI_Comm_size(comm, &c.run.size);
    sph_case_start(&c, NULL);
    assert_true(sph_case_run(&c, 20, 10.0));
    sph_sums(c.s, sums);
    DROP(c.s);
    return sums[SUM_KINETIC];
}

/* A disordered tank after 20 steps, shared out over the ranks and by each rank alone. */
TEST(ranks_agree)
{
    for (int walls = WALLS_NFM; walls <= WALLS_GHOSTS; walls++) {
        const double together = energy_after(walls, MPI_COMM_WORLD);
        const double alone = energy_after(walls, MPI_COMM_SELF);
        assert_close(together / alone, 1.0, 1e-8);
    }
}

/* A turning body in a tank (0: nfm), a tank (1: mirrored ghosts), or a channel with inlet and
 * outlet (2). */
static void restart_scene(struct sph_case *c, int kind)
{
    tank(c, 24, kind < 2, kind < 2 ? kind : WALLS_NFM);
    struct scene *e = &c->run.scene;
    c->prm.noise = 0.1;
    if (kind == 2) {
        e->fluid.gravity[1] = 0.0;
        e->walls[0].kind = WALL_INFLOW;
        e->walls[0].velocity[0] = 1.0;
        e->walls[1].kind = WALL_ABSORBING;
        c->prm.outer = OUTER_SIDES;
        e->coupling.transition = e->coupling.buffer = 5.0 / 24.0;
    } else if (kind != WALLS_GHOSTS) {
        e->nbodies = 1;
        e->bodies[0].points.n = 3;
        memcpy(e->bodies[0].points.x, (double[3][2]){{0.4, 0.4}, {0.5, 0.7}, {0.6, 0.4}},
               6 * sizeof(double));
        e->bodies[0].spin[2] = 2.0;
        e->bodies[0].centre[0] = e->bodies[0].centre[1] = 0.5;
        c->prm.packing = 5;
    }
}

static double *run_scene(int kind, bool restart, int *n)
{
    struct sph_case c;
    restart_scene(&c, kind);
    assert_non_null(sph_case_start(&c, NULL));
    return sph_case_twelve(&c, restart, n);
}

TEST(restart_is_exact)
{
    for (int kind = 0; kind < 3; kind++) {
        int n[2];
        double *straight = run_scene(kind, false, n), *again = run_scene(kind, true, n + 1);
        const bool same =
            n[0] == n[1] && memcmp(straight, again, (size_t)n[0] * sizeof(double)) == 0;
        if (!same)
            print_message("kind %d differs\n", kind);
        assert_true(none_anywhere(!same));
        FREE(straight, again);
    }
}

/* walls_velocity is the derivative of places. */
TEST(motion)
{
    struct sph_case c;
    double u[2], du[2], before[2], after[2];
    tank(&c, 20, true, WALLS_NFM);
    struct scene_body *b = c.run.scene.bodies;
    c.run.scene.nbodies = 1;
    b->points.n = 3;
    memcpy(b->points.x, (double[3][2]){{0.4, 0.7}, {0.5, 0.9}, {0.6, 0.7}}, 6 * sizeof(double));
    b->centre[0] = 0.5;
    b->centre[1] = 0.8;
    b->velocity[0] = 0.2;
    b->spin[2] = 3.0;
    struct sph *s = sph_case_start(&c, NULL);
    struct walls *w = s->walls;
    const struct segment *g = w->segments + w->bodies[0].first;
    const double h = 1e-5;
    walls_move(s, 0.3 - h);
    memcpy(before, g->a, sizeof before);
    walls_move(s, 0.3 + h);
    memcpy(after, g->a, sizeof after);
    walls_move(s, 0.3);
    walls_velocity(w, g, g->a, u, du);
    for (int a = 0; a < 2; a++) {
        assert_close(u[a], (after[a] - before[a]) / (2.0 * h), 1e-6);
        assert_close(du[a], (after[a] + before[a] - 2.0 * g->a[a]) / (h * h), 1e-3);
    }
    DROP(c.s);
}

/* Nothing flows yet when the first lattice is rearranged, with a free surface or without. */
TEST(packing_moves_the_lattice)
{
    for (int surface = 0; surface <= 1; surface++) {
        struct sph_case c;
        double most = 0.0;
        tank(&c, 24, surface, WALLS_NFM);
        struct scene *e = &c.run.scene;
        e->nbodies = 1;
        e->bodies[0].points.n = 3;
        memcpy(e->bodies[0].points.x, (double[3][2]){{0.4, 0.2}, {0.53, 0.4}, {0.6, 0.2}},
               6 * sizeof(double));
        c.prm.packing = 20;
        struct sph *s = sph_case_start(&c, NULL);
        for (int i = 0; i < s->p.n; i++) /* from the middle of its place on the lattice */
            most =
                fmax(most, fabs(remainder(s->p.y[(size_t)i * s->p.nstate] - 0.5 * s->dx, s->dx)));
        assert_true(max_anywhere(most) > 0.05 * s->dx);
        DROP(c.s);
    }
}
