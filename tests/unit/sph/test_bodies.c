/* test_bodies.c - rigid bodies by themselves: tops, pendulums, springs, motion as told, contact.
 * ranks: 1. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include <time.h>
#include <unistd.h>

#include "../../../sph/bodies/bodies.h"

/* A box of unit sides about `centre' in the plane. */
static struct scene_body square(double x, double y)
{
    struct scene_body b = {.free = true, .density = 1.0};
    const double p[4][2] = {{-0.5, -0.5}, {-0.5, 0.5}, {0.5, 0.5}, {0.5, -0.5}};
    b.points.n = 4;
    for (int k = 0; k < 4; k++) {
        b.points.x[k][0] = x + p[k][0];
        b.points.x[k][1] = y + p[k][1];
    }
    return b;
}

typedef void load_fn(struct body *b, double loads[6]);

/* One step of the classical scheme, as a run makes it. */
static void step(struct body *b, double t, double dt, load_fn *fn)
{
    static const double at[4] = {0.0, 0.5, 0.5, 1.0}, ahead[4] = {0.5, 0.5, 1.0, 0.0},
                        part[4] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
    struct body_free *f = b->free;
    memcpy(f->y0, f->y, sizeof f->y);
    memset(f->sum, 0, sizeof f->sum);
    for (int k = 0; k < 4; k++) {
        double loads[6] = {0.0};
        body_move(b, t + at[k] * dt);
        if (fn)
            fn(b, loads);
        body_rates(b, loads, loads + 3);
        for (int i = 0; i < BODY_STATE; i++) {
            f->sum[i] += part[k] * dt * f->rate[i];
            f->y[i] = f->y0[i] + (k == 3 ? f->sum[i] : ahead[k] * dt * f->rate[i]);
        }
    }
    body_finish(b);
    body_move(b, t + dt);
}

/* sn, cn, dn of u and the parameter m, by descending Landen transformation (Abramowitz & Stegun
 * 16.4). */
static void jacobi(double u, double m, double *sn, double *cn, double *dn)
{
    double a[16] = {1.0}, c[16] = {sqrt(m)}, b = sqrt(1.0 - m);
    int n = 0;
    for (; n < 14 && fabs(c[n]) > 1e-16; n++) {
        a[n + 1] = 0.5 * (a[n] + b);
        c[n + 1] = 0.5 * (a[n] - b);
        b = sqrt(a[n] * b);
    }
    double phi = ldexp(a[n] * u, n), before = phi;
    for (; n > 0; n--) {
        before = phi;
        phi = 0.5 * (phi + asin(c[n] / a[n] * sin(phi)));
    }
    *sn = sin(phi);
    *cn = cos(phi);
    *dn = cos(phi) / cos(before - phi);
}

/* Angular velocity in body axes of a torque-free top with moments 1, 2, 3 (Landau & Lifshitz,
 * Mechanics, section 37) that starts with (1.2, 0, 0.8). */
static void euler_top(double t, double omega[3])
{
    const double I[3] = {1.0, 2.0, 3.0}, w[3] = {1.2, 0.0, 0.8};
    double E2 = 0.0, M2 = 0.0, sn, cn, dn;
    for (int a = 0; a < 3; a++) {
        E2 += I[a] * w[a] * w[a];
        M2 += I[a] * I[a] * w[a] * w[a];
    }
    const bool swapped = M2 <= E2 * I[1]; /* turns about the axis of the least moment */
    const double a1 = swapped ? I[2] : I[0], a2 = I[1], a3 = swapped ? I[0] : I[2];
    const double rate = sqrt((a3 - a2) * (M2 - E2 * a1) / (a1 * a2 * a3));
    const double m = (a2 - a1) * (E2 * a3 - M2) / ((a3 - a2) * (M2 - E2 * a1));
    jacobi(rate * t, m, &sn, &cn, &dn);
    const double first = sqrt((E2 * a3 - M2) / (a1 * (a3 - a1))) * cn;
    const double third = sqrt((M2 - E2 * a1) / (a3 * (a3 - a1))) * dn;
    omega[0] = swapped ? third : first;
    omega[1] = (swapped ? -1.0 : 1.0) * sqrt((E2 * a3 - M2) / (a2 * (a3 - a2))) * sn;
    omega[2] = swapped ? first : third;
}

static double error_of_top(int steps)
{
    struct scene_body is = {.free = true, .mass = 1.0, .inertia = {3, {1.0, 2.0, 3.0}}};
    struct body b;
    double exact[3], own[3], err = 0.0, other = 0.0;
    is.spin[0] = 1.2;
    is.spin[2] = 0.8;
    body_create(&b, &is, NULL, 3, NULL);
    for (int k = 0; k < steps; k++)
        step(&b, 6.0 * k / steps, 6.0 / steps, NULL);
    const double L[3] = {1.2, 0.0, 2.4};
    for (int a = 0; a < 3; a++) /* in space axes it is kept */
        assert_close(b.free->y[BODY_L + a], L[a], 1e-12);
    euler_top(6.0, exact);
    turn_back3(b.now.Q, b.now.omega, own);
    for (int a = 0; a < 3; a++) {
        err = fmax(err, fabs(own[a] - exact[a]));
        other = fmax(other, fabs(own[a] - (a == 1 ? -1.0 : 1.0) * exact[a]));
    }
    body_destroy(&b);
    return fmin(err, other); /* the sense of the middle axis is a matter of convention */
}

TEST(torque_free_top)
{
    const double coarse = error_of_top(100), fine = error_of_top(200);
    print_message("top: %.1e %.1e, order %.2f\n", coarse, fine, log2(coarse / fine));
    assert_true(fine < 1e-7);
    assert_true(log2(coarse / fine) > 3.8);
}

static void twist(struct body *b, double loads[6])
{
    (void)b;
    loads[3] += 0.4;
    loads[4] -= 0.7;
}

/* The angular acceleration that pressures carry with them is the slope of omega, by differences
 * over 2 steps of 1e-3 s, with and without a torque. */
TEST(acceleration_of_a_top)
{
    for (int k = 0; k < 2; k++) {
        struct scene_body is = {.free = true, .mass = 1.0, .inertia = {3, {1.0, 2.0, 3.0}}};
        struct body b;
        const double dt = 1e-3;
        double before[3], slope[3];
        is.spin[0] = 1.2;
        is.spin[1] = 0.5;
        is.spin[2] = 0.8;
        body_create(&b, &is, NULL, 3, NULL);
        for (int i = 0; i < 500; i++) {
            memcpy(before, b.now.omega, sizeof before);
            step(&b, i * dt, dt, k ? twist : NULL);
        }
        memcpy(slope, b.now.domega, sizeof slope);
        step(&b, 500 * dt, dt, k ? twist : NULL);
        for (int a = 0; a < 3; a++)
            assert_close(slope[a], (b.now.omega[a] - before[a]) / (2.0 * dt), 1e-5);
        body_destroy(&b);
    }
}

static void weight(struct body *b, double loads[6]) { loads[1] -= 9.81 * b->free->mass; }

/* Complete elliptic integral K by the arithmetic-geometric mean. */
static double elliptic(double k)
{
    double a = 1.0, b = sqrt(1.0 - k * k);
    for (int i = 0; i < 8; i++) {
        const double mean = 0.5 * (a + b);
        b = sqrt(a * b);
        a = mean;
    }
    return M_PI / (2.0 * a);
}

/* A square that hangs 1 m under its hinge, let go at 1 rad: back after 4 sqrt(J/(M g l)) K(sin
 * 1/2), whose ratio to the small swing is 1.06633. */
TEST(pendulum)
{
    const double l = 1.0, J = 1.0 / 6.0 + l * l, K = elliptic(sin(0.5));
    const double T = 4.0 * sqrt(J / (9.81 * l)) * K;
    struct scene_body is = square(sin(1.0) * l, -cos(1.0) * l);
    struct body b;
    enum { STEPS = 400 };
    is.hinge.n = 1;
    body_create(&b, &is, NULL, 2, NULL);
    assert_close(K / (M_PI / 2.0), 1.06633, 1e-5);
    assert_close(b.free->J, J, 1e-12);
    for (int k = 0; k < STEPS; k++) {
        step(&b, T * k / STEPS, T / STEPS, weight);
        const double r[2] = {b.centre[0] + b.now.x[0], b.centre[1] + b.now.x[1]};
        assert_close(hypot(r[0], r[1]), l, 1e-12); /* nothing drifts */
    }
    assert_close(b.now.angle, 0.0, 1e-7);
    assert_close(b.now.spin, 0.0, 1e-6);
    body_destroy(&b);
}

static struct scene none;

static void spring(struct body *b, double loads[6])
{
    double all[1][6] = {{0.0}};
    body_lines_add(&none, b, 0, all);
    memcpy(loads, all[0], sizeof all[0]);
}

/* Energy of a square on a spring at its corner is kept, to the order of the scheme. */
TEST(spring_keeps_energy)
{
    const double g[3] = {0.0, 0.0, 0.0};
    double drift[2];
    for (int e = 0; e < 2; e++) {
        struct scene_body is = square(0.0, 0.0);
        struct body b;
        double kinetic;
        const int steps = e ? 800 : 400;
        is.lines.n = 1;
        is.lines.of[0] = (struct scene_line){
            .from = {0.5, 0.5}, .to = {0.5, 3.0}, .stiffness = 10.0, .length = 1.5};
        is.velocity[0] = 0.4;
        body_create(&b, &is, NULL, 2, NULL);
        body_lines_slack(&b);
        const double start = body_energy(&b, g, &kinetic) + body_lines_energy(&none, &b, 0);
        assert_close(start, 0.5 * 0.16 + 0.5 * 10.0, 1e-12);
        for (int k = 0; k < steps; k++)
            step(&b, 4.0 * k / steps, 4.0 / steps, spring);
        drift[e] = fabs(body_energy(&b, g, &kinetic) + body_lines_energy(&none, &b, 0) - start);
        body_destroy(&b);
    }
    print_message("spring: energy off by %.1e, %.1e of 5.08\n", drift[0], drift[1]);
    assert_true(drift[1] < 1e-6);
    assert_true(drift[0] / drift[1] > 12.0);
}

/* A line between two free bodies meets their masses in series, m M/(m + M) through both centres;
 * off a centre the body's rotation yields, too: 1/m + r^2/J, J = m/6. */
TEST(a_line_meets_both_bodies)
{
    struct scene c = {.domain.dim = 2, .nbodies = 2};
    struct body b;
    double way[3];
    struct scene_line l = {.from = {0.0, 0.0}, .to = {3.0, 0.0}, .body = "other"};
    c.bodies[0] = square(0.0, 0.0);
    c.bodies[1] = square(3.0, 0.0);
    c.bodies[1].density = 3.0;
    snprintf(c.bodies[1].name, sizeof c.bodies[1].name, "other");
    body_create(&b, c.bodies, NULL, 2, NULL);
    assert_close(body_line_mass(&c, &b, &l, way), 0.75, 1e-12);
    assert_close(way[0], 3.0, 1e-15);
    l.from[1] = l.to[1] = 0.5;
    assert_close(1.0 / body_line_mass(&c, &b, &l, way), (1.0 + 1.0 / 3.0) * (1.0 + 1.5), 1e-12);
    *l.body = '\0';
    assert_close(1.0 / body_line_mass(&c, &b, &l, way), 1.0 + 1.5, 1e-12);
    c.bodies[1].free = false;
    snprintf(l.body, sizeof l.body, "other");
    assert_close(1.0 / body_line_mass(&c, &b, &l, way), 1.0 + 1.5, 1e-12);
    body_destroy(&b);
}

/* A mooring line pulls alone. */
TEST(mooring_is_slack)
{
    struct scene_body is = square(0.0, 0.0);
    struct body b;
    double loads[1][6] = {{0.0}};
    is.lines.n = 1;
    is.lines.of[0] = (struct scene_line){
        .from = {0.0, 0.5}, .to = {0.0, 2.0}, .stiffness = 10.0, .length = 2.0, .pull_only = true};
    body_create(&b, &is, NULL, 2, NULL);
    body_lines_slack(&b);
    body_lines_add(&none, &b, 0, loads);
    assert_close(loads[0][1], 0.0, 0.0);
    b.is = &is;
    is.lines.of[0].pull_only = false;
    body_lines_add(&none, &b, 0, loads);
    assert_close(loads[0][1], -5.0, 1e-12);
    body_destroy(&b);
}

/* Outline of an L (Steiner's theorem), anywhere, either sense. */
TEST(inertia_of_an_outline)
{
    struct scene_body is = {.free = true, .density = 3.0};
    const double L[6][2] = {{0, 0}, {0, 3}, {1, 3}, {1, 1}, {2, 1}, {2, 0}};
    struct body_mass m;
    char why[256];
    is.points.n = 6;
    for (int k = 0; k < 6; k++) {
        is.points.x[k][0] = 100.0 + L[k][0];
        is.points.x[k][1] = -50.0 + L[k][1];
    }
    for (int e = 0; e < 2; e++, points_reverse(&is.points)) {
        assert_true(body_mass_of(&is, NULL, 2, &m, why, sizeof why));
        assert_close(m.mass, 12.0, 1e-10); /* 1 x 3 and 1 x 1 */
        assert_close(m.centre[0], 100.75, 1e-10);
        assert_close(m.centre[1], -48.75, 1e-10);
        const double J = 3.0 * (3.0 * 10.0 / 12.0 + 3.0 * (0.25 * 0.25 + 0.25 * 0.25)) +
                         3.0 * (2.0 / 12.0 + 0.75 * 0.75 + 0.75 * 0.75);
        assert_close(m.inertia[2][2], J, 1e-8);
    }
    is.density = 0.0;
    assert_false(body_mass_of(&is, NULL, 2, &m, why, sizeof why));
    is.mass = 1.0;
    is.inertia = (struct param_numbers){3, {1.0, 1.0, 3.0}};
    assert_false(body_mass_of(&is, NULL, 3, &m, why, sizeof why)); /* 3 > 1 + 1 */
    is.inertia.v[2] = 1.9;
    assert_true(body_mass_of(&is, NULL, 3, &m, why, sizeof why));
}

/* Velocity and acceleration are derivatives of the place, rotation included. */
TEST(motion_is_differentiable)
{
    struct scene_body is = {.motion = {.n = 4}};
    struct body_drive v;
    const double h = 1e-5;
    is.motion.of[0] = (struct scene_motion){
        .kind = MOTION_HARMONIC, .axis = AXIS_RX, .amplitude = 0.7, .period = 1.3, .phase = 0.4};
    is.motion.of[1] = (struct scene_motion){
        .kind = MOTION_HARMONIC, .axis = AXIS_RZ, .amplitude = 1.1, .period = 0.9, .ramp = 2.0};
    is.motion.of[2] = (struct scene_motion){.kind = MOTION_POLYNOMIAL,
                                            .axis = AXIS_RY,
                                            .coefficients = {4, {0.3, -0.2, 0.5, -0.1}},
                                            .from = 0.1,
                                            .until = 3.0};
    is.motion.of[3] = (struct scene_motion){.kind = MOTION_POLYNOMIAL,
                                            .axis = AXIS_X,
                                            .coefficients = {3, {0.0, 1.0, 2.0}},
                                            .ramp = 1.5};
    is.motion.of[3].until = 10.0;
    is.velocity[1] = 0.3;
    body_drive_create(&v, &is, 3, NULL);
    for (double t = 0.2; t < 1.4; t += 0.17) {
        struct body_motion m, low, high;
        double W[3][3] = {{0.0}};
        body_drive_motion(&v, t, &m);
        body_drive_motion(&v, t - h, &low);
        body_drive_motion(&v, t + h, &high);
        for (int a = 0; a < 3; a++) {
            assert_close((high.x[a] - low.x[a]) / (2.0 * h), m.u[a], 1e-7);
            assert_close((high.u[a] - low.u[a]) / (2.0 * h), m.du[a], 1e-6);
            assert_close((high.omega[a] - low.omega[a]) / (2.0 * h), m.domega[a], 1e-5);
            for (int b = 0; b < 3; b++)
                for (int c = 0; c < 3; c++) /* dQ/dt Q^T is the matrix of omega x */
                    W[a][b] += (high.Q[a][c] - low.Q[a][c]) / (2.0 * h) * m.Q[b][c];
        }
        assert_close(W[2][1], m.omega[0], 1e-7);
        assert_close(W[0][2], m.omega[1], 1e-7);
        assert_close(W[1][0], m.omega[2], 1e-7);
    }
}

/* What is towed at c_1 from 0.4 s on with a ramp of 1.5 s stands until then, never goes faster than
 * c_1, and is half a ramp behind at its end. */
TEST(ramp_of_a_polynomial_is_that_of_its_rate)
{
    struct scene_body is = {.motion = {.n = 1}};
    struct body_drive v;
    is.motion.of[0] = (struct scene_motion){.kind = MOTION_POLYNOMIAL,
                                            .axis = AXIS_X,
                                            .coefficients = {2, {0.0, 3.0}},
                                            .from = 0.4,
                                            .until = 10.0,
                                            .ramp = 1.5};
    body_drive_create(&v, &is, 2, NULL);
    for (double t = 0.0; t < 12.0; t += 0.1) {
        struct body_motion m;
        body_drive_motion(&v, t, &m);
        assert_true(m.u[0] >= 0.0 && m.u[0] <= 3.0 * (1.0 + 1e-12));
        if (t < 0.4 || t > 1.9)
            assert_close(m.x[0], t < 0.4 ? 0.0 : 3.0 * (fmin(t, 10.0) - 0.4 - 0.75), 1e-12);
    }
    assert_close(body_drive_event(&v, 0.5), 1.9, 1e-12);
}

/* Whatever part of the run a period is: the largest speed is A omega, also of one that even
 * samples, a period apart, would show at rest. */
TEST(no_period_hides_between_samples)
{
    for (int n = 10; n <= 2000; n += 199) {
        const double period = 2000.0 / n;
        struct scene_body is = {.motion = {.n = 1}};
        struct body_drive v;
        is.motion.of[0] = (struct scene_motion){.kind = MOTION_HARMONIC,
                                                .axis = AXIS_X,
                                                .amplitude = 0.5,
                                                .period = period,
                                                .phase = 0.5 * M_PI};
        body_drive_create(&v, &is, 2, NULL);
        const double wanted = M_PI / period;
        assert_close(body_drive_speed(&v, 0.0, 2000.0), wanted, 0.02 * wanted);
    }
}

/* Locked degrees stay where they are, or go as told; a slider keeps its line. */
static void push(struct body *b, double loads[6])
{
    (void)b;
    loads[0] = loads[1] = 1.0;
    loads[5] = 1.0;
}

TEST(locks_hold)
{
    struct scene_body is = square(0.0, 0.0);
    struct body b;
    snprintf(is.lock, sizeof is.lock, "x rz");
    is.velocity[0] = 2.0;
    body_create(&b, &is, NULL, 2, NULL);
    for (int k = 0; k < 10; k++)
        step(&b, 0.1 * k, 0.1, push);
    assert_close(b.now.x[0], 2.0, 1e-12);
    assert_close(b.now.x[1], 0.5, 1e-12);
    assert_close(b.now.angle, 0.0, 0.0);
    body_destroy(&b);
    is.lock[0] = '\0';
    is.velocity[0] = 0.0;
    is.slider.n = 1;
    is.slider.of[0] = (struct scene_slider){{3.0, 4.0}};
    body_create(&b, &is, NULL, 2, NULL);
    for (int k = 0; k < 10; k++)
        step(&b, 0.1 * k, 0.1, push);
    assert_close(b.now.x[0] * 4.0, b.now.x[1] * 3.0, 1e-12);
    assert_close(b.now.x[0], 0.5 * 1.4 * 0.6, 1e-12);
    assert_close(b.now.angle, 0.5 / (1.0 / 6.0), 1e-12);
    body_destroy(&b);
}

/* Plate of thickness H wet on both sides: 2 rho c/(rho_b H) across; with a hinge its own. */
TEST(impedance_of_a_plate)
{
    struct scene_body is = {.free = true, .density = 2.0};
    const double x[4][2] = {{0, 0}, {0, 0.1}, {4, 0.1}, {4, 0}};
    struct impedance z = {{{0.0}}};
    struct body b;
    enum { PIECES = 1000 };
    is.points.n = 4;
    memcpy(is.points.x, x, sizeof x);
    snprintf(is.lock, sizeof is.lock, "rz");
    body_create(&b, &is, NULL, 2, NULL);
    for (int k = 0; k < PIECES; k++)
        for (int e = -1; e < 2; e += 2) {
            const double arm[3] = {-2.0 + 4.0 * (k + 0.5) / PIECES, 0.05 * e, 0.0};
            const double n[3] = {0.0, -e, 0.0};
            impedance_add(&z, arm, n, 1.0 * 4.0 / PIECES, 0.0);
        }
    assert_close(impedance_rate(&z, &b), 2.0 / (2.0 * 0.1), 1e-9);
    body_destroy(&b);
    is.lock[0] = '\0';
    is.hinge.n = 1;
    is.hinge.of[0] = (struct scene_hinge){.at = {0.0, 0.05}};
    body_create(&b, &is, NULL, 2, NULL);
    const double J = 0.8 * (16.01 / 12.0 + 4.0); /* and Z = 2 int x^2 dx */
    assert_close(impedance_rate(&z, &b), 2.0 * 64.0 / 3.0 / J, 1e-4);
    body_destroy(&b);
}

/* A file of motion is read once, whoever asks: later changes of the file, or none of it any more,
 * are not seen. A long one takes as long as its rows (1e5: 0.4 s, minutes where each was copied
 * with every other). */
TEST(motion_files_are_read_once)
{
    enum { ROWS = SANITIZED ? 1000 : 100000 };
    struct motion_files *files = motion_files_create(P_tmpdir);
    char name[64], path[256];
    struct scene_motions is = {.n = 1};
    struct body_drive first, second;
    snprintf(name, sizeof name, "once_%d.txt", (int)getpid());
    snprintf(path, sizeof path, "%s/%s", P_tmpdir, name);
    snprintf(is.of[0].file, sizeof is.of[0].file, "%s", name);
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    fprintf(f, "# t x y angle\n0 0 0 0\n1, 2; 0 0\n");
    for (int k = 2; k < ROWS; k++)
        fprintf(f, "%d 0 0 0\n", k);
    fclose(f);
    const clock_t begin = clock();
    body_drive_terms(&first, &is, 2, files);
    assert_true((double)(clock() - begin) / CLOCKS_PER_SEC < 10.0);
    unlink(path);
    body_drive_terms(&second, &is, 2, files);
    assert_int_equal(first.term[0].n, ROWS);
    assert_ptr_equal(first.term[0].rows, second.term[0].rows);
    assert_close(second.term[0].rows[5], 2.0, 0.0);
    FREE(files);
}

/* The course of point 1 of a square, up by 0.1 m at 2 m/s at t = 0.5: the velocity of the pieces
 * beside it is linear, and loads on the points have the force and the power of what they stand for.
 */
TEST(bent_square)
{
    static const double x[2] = {-0.4, 0.1}, f[2] = {3.0, 7.0};
    struct scene_body is = square(0.0, 0.0);
    struct body b = {.is = &is, .dim = 2, .bend = body_bend_create(&is)};
    struct body_course *c = mem_new(1, sizeof *c + 8 * sizeof c->c[0]);
    double u[2], sum[2] = {0.0, 0.0};
    c->n = 8;
    c->c[3][0] = -0.9;
    c->c[3][1] = 2.0;
    b.course = c;
    body_bend_move(&b, 0.5);
    assert_close(b.bend->x[1][1], 0.6, 1e-14);
    body_bend_velocity(b.bend, 0, 0.25, u, NULL);
    assert_close(u[1], 0.5, 1e-14);
    body_bend_velocity(b.bend, 1, 0.25, u, NULL);
    assert_close(u[1], 1.5, 1e-14);
    /* what touches it there meets it at that: contact knows who comes, and rubs */
    body_velocity(&b, (const double[2]){-0.5, -0.5 + 0.25 * 1.1}, u);
    assert_close(u[0], 0.0, 1e-14);
    assert_close(u[1], 0.5, 1e-14);
    body_bend_load(b.bend, x, f, BEND_STAGE);
    for (int i = 0; i < 4; i++)
        for (int a = 0; a < 2; a++)
            sum[a] += b.bend->load[BEND_STAGE][i][a];
    assert_close(sum[0], f[0], 1e-14);
    assert_close(sum[1], f[1], 1e-14);
    /* the nearest piece is the left side, from -0.5 to 0.6 now, 0.6 m of 1.1 m up */
    assert_close(body_bend_power(b.bend), f[1] * 2.0 * 0.6 / 1.1, 1e-13);
    DROP(b.bend);
    mem_free(c);
}
