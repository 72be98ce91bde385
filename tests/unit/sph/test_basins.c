/* test_basins.c - the first particles under gravity: each water stands under its own level, under
 * roofs under that of its neighbours; what falls has no weight; seams and pockets stay dry.
 * ranks: 1 2. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "sph_case.h"

static const double g = 9.81, rho = 1000.0;

/* A domain of 2 x 1 in units of `scale', walls at its sides and its bottom, g downwards. */
static struct scene *tank(struct sph_case *c, double scale, int cells)
{
    struct scene *s = sph_case_tank(c, cells, g, 3);
    s->fluid.rho = rho;
    s->domain.max[0] = 2.0 * scale;
    s->domain.max[1] = scale;
    c->prm.dx = scale / cells;
    c->prm.c0 = 1000.0 * sqrt(g * scale); /* density hardly varies */
    c->prm.surface = SURFACE_YES;
    c->prm.scheme = SCHEME_RIEMANN;
    c->prm.dissipation = 0.1;
    return s;
}

static void add_box(struct scene *s, double x0, double y0, double x1, double y1)
{
    const double box[2][3] = {{x0, y0, 0.0}, {x1, y1, 0.0}};
    memcpy(s->shapes[s->nshapes++].box, box, sizeof box);
}

static void add_body(struct scene *s, double x0, double y0, double x1, double y1)
{
    const double x[4][2] = {{x0, y0}, {x0, y1}, {x1, y1}, {x1, y0}};
    struct scene_body *b = s->bodies + s->nbodies++;
    b->points.n = 4;
    memcpy(b->points.x, x, sizeof x);
}

/* Largest |p/(rho g) - head(x)| over all particles, m. */
static double worst(const struct sph *s, double (*head)(const double *x, double scale),
                    double scale)
{
    double most = 0.0;
    for (int i = 0; i < s->p.n; i++) {
        const double *y = s->p.y + (size_t)i * s->p.nstate;
        const double p = eos_p(y[5] / y[4], s->rho0, s->c0, s->gamma) / (rho * g);
        most = fmax(most, fabs(p - head(y, scale)));
    }
    return max_anywhere(most);
}

/* Starts the run, with so many particles (0: any), whose heads are off by no more than that, m, and
 * ends it. */
static void stands(struct sph_case *c, int count, double (*head)(const double *x, double scale),
                   double scale, double off)
{
    sph_case_start(c, NULL);
    assert_true(count == 0 || sph_case_count(c->s) == count);
    assert_close(worst(c->s, head, scale), 0.0, off);
    DROP(c->s);
}

static double wet_bed(const double *x, double L) { return (x[0] < 0.5 * L ? 0.6 : 0.1) * L - x[1]; }

TEST(a_dam_and_its_wet_bed_have_their_own_heads)
{
    static const double scales[] = {1e-3, 1.0, 1e3};
    for (int k = 0; k < 3; k++) {
        struct sph_case c;
        const double L = scales[k];
        struct scene *s = tank(&c, L, 40);
        add_box(s, 0.0, 0.0, 0.5 * L, 0.6 * L);
        add_box(s, 0.5 * L, 0.0, 2.0 * L, 0.1 * L);
        stands(&c, 20 * 24 + 60 * 4, wet_bed, L, 1e-4 * L);
    }
}

static double three(const double *x, double L)
{
    return (x[0] < 0.5 * L ? 0.6 : x[0] < 1.25 * L ? 0.2 : 0.8) * L - x[1];
}

TEST(basins_do_not_know_of_each_other)
{
    struct sph_case c;
    struct scene *s = tank(&c, 1.0, 40);
    add_box(s, 0.0, 0.0, 0.5, 0.6);
    add_box(s, 0.6, 0.0, 1.2, 0.2);
    add_box(s, 1.3, 0.0, 2.0, 0.8);
    add_body(s, 0.5, 0.0, 0.6, 0.9);
    add_body(s, 1.2, 0.0, 1.3, 0.9);
    stands(&c, 20 * 24 + 24 * 8 + 28 * 32, three, 1.0, 1e-4);
}

/* Legs of 0.8 and 0.4 joined under a body from 0.5 to 1.5 by a duct 0.1 high: a straight line of
 * head from one to the other (potential theory of a long duct; its ends are blunt). */
static double u_tube(const double *x, double L)
{
    const double f = fmin(fmax((x[0] / L - 0.5) / 1.0, 0.0), 1.0);
    return (0.8 - 0.4 * f) * L - x[1];
}

TEST(a_duct_leads_from_one_level_to_the_other)
{
    struct sph_case c;
    struct scene *s = tank(&c, 1.0, 40);
    add_box(s, 0.0, 0.0, 0.5, 0.8);
    add_box(s, 0.5, 0.0, 1.5, 0.4);
    add_box(s, 1.5, 0.0, 2.0, 0.4);
    add_body(s, 0.5, 0.1, 1.5, 0.9);
    stands(&c, 20 * 32 + 40 * 4 + 20 * 16, u_tube, 1.0, 0.4 / 40); /* a cell at the ends */
}

static double level_half(const double *x, double L) { return 0.5 * L - x[1]; }

TEST(water_under_a_body_stands_under_the_same_level)
{
    struct sph_case c;
    struct scene *s = tank(&c, 1.0, 40);
    s->nshapes = 1;
    s->shapes[0].form = SHAPE_BELOW;
    s->shapes[0].level = 0.5;
    add_body(s, 0.3, 0.1, 0.7, 0.3);
    add_body(s, 1.0, 0.2, 1.5, 0.8);
    stands(&c, 0, level_half, 1.0, 1e-4);
}

static double closed(const double *x, double L) { return L - x[1]; }

TEST(a_full_closed_tank_stands_under_its_lid)
{
    struct sph_case c;
    struct scene *s = tank(&c, 1.0, 20);
    s->nwalls = 4;
    s->walls[3].side = SIDE_Y_MAX;
    c.prm.surface = SURFACE_NO;
    add_body(s, 0.4, 0.4, 0.8, 0.6);
    stands(&c, 0, closed, 1.0, 1e-4);
}

static double falls(const double *x, double L) { return x[1] > 0.5 * L ? 0.0 : 0.2 * L - x[1]; }

TEST(what_falls_has_no_weight)
{
    struct sph_case c;
    struct scene *s = tank(&c, 1.0, 40);
    add_box(s, 0.0, 0.0, 2.0, 0.2);
    add_box(s, 0.8, 0.6, 1.2, 0.9);
    stands(&c, 0, falls, 1.0, 1e-4);
}

/* The level is where the shapes end, not the steps of the lattice. */
TEST(a_tilted_tank_has_one_level)
{
    for (int k = 0; k < 6; k++) {
        struct sph_case c;
        struct scene *s = tank(&c, 1.0, 40);
        const double angle = 0.1 + 0.12 * k;
        double most = 0.0;
        s->nwalls = 4; /* a lid for the deep end */
        s->walls[3].side = SIDE_Y_MAX;
        s->fluid.gravity[0] = g * sin(angle);
        s->fluid.gravity[1] = -g * cos(angle);
        s->nshapes = 1;
        s->shapes[0].form = SHAPE_BELOW;
        s->shapes[0].level = 0.1;
        sph_case_start(&c, NULL);
        for (int i = 0; i < c.s->p.n; i++) {
            const double *y = c.s->p.y + (size_t)i * c.s->p.nstate, x[3] = {y[0], y[1], 0.0};
            const double p = eos_p(y[5] / y[4], rho, c.s->c0, c.s->gamma) / (rho * g);
            most = fmax(most, fabs(p - (0.1 - scene_height(s, x))));
        }
        assert_close(max_anywhere(most), 0.0, 1e-4);
        DROP(c.s);
    }
}

/* The wet bed again, turned by quarters, and in 3D with gravity along any axis. */
TEST(heads_know_no_axes)
{
    for (int k = 0; k < 10; k++) {
        const int dim = k < 4 ? 2 : 3, up = k < 4 ? k / 2 : (k - 4) / 2, along = up == 0 ? 1 : 0;
        const double sense = k % 2 ? 1.0 : -1.0; /* of gravity */
        struct sph_case c;
        struct scene *s = tank(&c, 1.0, 20);
        double most = 0.0;
        s->domain.dim = dim;
        c.prm.R_dx = dim == 2 ? 4.0 : 2.5;
        c.prm.walls = WALLS_GHOSTS;
        s->nwalls = 2 * dim;
        memset(s->fluid.gravity, 0, sizeof s->fluid.gravity);
        s->fluid.gravity[up] = sense * g;
        for (int a = 0; a < dim; a++) {
            s->domain.max[a] = 1.0;
            s->domain.periodic[a] = false;
            s->walls[2 * a].side = SIDE_X_MIN + 2 * a;
            s->walls[2 * a + 1].side = SIDE_X_MAX + 2 * a;
        }
        s->nshapes = 2;
        for (int q = 0; q < 2; q++) {
            double(*box)[3] = s->shapes[q].box;
            const double head = q ? 0.2 : 0.6;
            for (int a = 0; a < dim; a++)
                box[1][a] = 1.0;
            box[q ? 0 : 1][along] = 0.5;
            box[sense > 0.0 ? 0 : 1][up] = sense > 0.0 ? 1.0 - head : head;
        }
        sph_case_start(&c, NULL);
        for (int i = 0; i < c.s->p.n; i++) {
            const double *y = c.s->p.y + (size_t)i * c.s->p.nstate;
            const double depth = (y[along] < 0.5 ? 0.6 : 0.2) - (sense > 0.0 ? 1.0 - y[up] : y[up]);
            const double p = eos_p(y[2 * dim + 1] / y[2 * dim], rho, c.s->c0, c.s->gamma);
            most = fmax(most, fabs(p / (rho * g) - depth));
        }
        assert_int_equal(sph_case_count(c.s), (dim == 2 ? 1 : 20) * 10 * (12 + 4));
        assert_close(max_anywhere(most), 0.0, 1e-4);
        DROP(c.s);
    }
}

static double nothing(const double *x, double L)
{
    (void)x;
    return 0.0 * L;
}

TEST(gravity_along_a_period_lets_no_pressure_rise)
{
    struct sph_case c;
    struct scene *s = tank(&c, 1.0, 20);
    s->fluid.gravity[0] = g;
    s->fluid.gravity[1] = 0.0;
    s->domain.periodic[0] = true;
    s->nwalls = 2;
    s->walls[0].side = SIDE_Y_MIN;
    s->walls[1].side = SIDE_Y_MAX;
    c.prm.surface = SURFACE_NO;
    stands(&c, 0, nothing, 1.0, 1e-9);
}

/* A block on the floor holds no particle, whatever its place against the lattice; and a disc on the
 * floor none where the two are less than dx apart. */
TEST(seams_stay_dry)
{
    for (int k = 0; k < 12; k++) {
        struct sph_case c;
        struct scene *s = tank(&c, 1.0, 40);
        const double x0 = 0.45 + 0.003 * k, dx = 1.0 / 40;
        s->nshapes = 1;
        s->shapes[0].form = SHAPE_BELOW;
        s->shapes[0].level = 0.5;
        add_body(s, x0, 0.0, x0 + 0.1, k % 2 ? 0.9 : 0.3);
        struct scene_body *disc = s->bodies + s->nbodies++;
        disc->points.n = 60;
        for (int i = 0; i < 60; i++) {
            disc->points.x[i][0] = 1.5 + 0.004 * k + 0.2 * sin(2.0 * M_PI * i / 60);
            disc->points.x[i][1] = 0.2 - 0.2 * cos(2.0 * M_PI * i / 60);
        }
        scene_orient(s);
        c.prm.packing = k % 3;
        sph_case_start(&c, NULL);
        long bad = 0;
        for (int i = 0; i < c.s->p.n; i++) {
            const double *y = c.s->p.y + (size_t)i * c.s->p.nstate;
            const double a = y[0] - 1.5 - 0.004 * k;
            const double under = fabs(a) < 0.2 ? 0.2 - sqrt(0.04 - a * a) : 1.0;
            bad += !scene_is_room(s, y);
            bad += y[1] < 0.2 && under < 0.8 * dx; /* packing moves by less */
        }
        assert_true(none_anywhere(bad));
        DROP(c.s);
    }
}

/* Two cells of water walled in: said, and left out. */
TEST(pockets_are_dropped)
{
    struct sph_case c;
    struct scene *s = tank(&c, 1.0, 40);
    s->nshapes = 1;
    s->shapes[0].form = SHAPE_BELOW;
    s->shapes[0].level = 0.5;
    add_body(s, 0.5, 0.0, 0.6, 0.3); /* a well of 0.6 to 0.65 x 0 to 0.05 under a lid */
    add_body(s, 0.65, 0.0, 0.75, 0.3);
    add_body(s, 0.6, 0.05, 0.65, 0.3);
    sph_case_start(&c, NULL);
    long bad = 0;
    for (int i = 0; i < c.s->p.n; i++) {
        const double *y = c.s->p.y + (size_t)i * c.s->p.nstate;
        bad += y[0] > 0.5 && y[0] < 0.75 && y[1] < 0.3;
    }
    assert_true(none_anywhere(bad));
    assert_int_equal(sph_case_count(c.s), 80 * 20 - 10 * 12);
    DROP(c.s);
}
