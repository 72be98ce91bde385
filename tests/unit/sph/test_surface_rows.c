/* test_surface_rows.c - the first particles at free surfaces inclined to the lattice or between two
 * of its rows: no steps, and the volume of the shape, at every level; ranks, mirrors and units
 * agree. ranks: 1 2. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/refinement/refinement.h"
#include "sph_case.h"

enum { SIDES = 3, CELLS = 64, LEVELS = SANITIZED ? 1 : 2 };
static const double pi = 3.14159265358979323846;

/* Corners of a triangle of some 0.35 L radius around the middle of a domain of side L. */
struct triangle {
    double x[SIDES][2];
};

static struct triangle triangle_of(int seed, bool mirrored)
{
    struct triangle t;
    for (int k = 0; k < SIDES; k++) {
        const double wobble = 0.3 * sin(12.9898 * (seed + 1) + 78.233 * k);
        const double angle = 2.0 * pi * k / SIDES + 0.71 * seed + wobble;
        t.x[k][0] = 0.5 + 0.35 * cos(angle) * (mirrored ? -1.0 : 1.0);
        t.x[k][1] = 0.5 + 0.35 * sin(angle);
    }
    return t;
}

static double area_of(const struct triangle *t)
{
    double sum = 0.0;
    for (int k = 0; k < SIDES; k++) {
        const double *a = t->x[k], *b = t->x[(k + 1) % SIDES];
        sum += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
    return fabs(sum);
}

/* Water at rest in the triangle, without weight; levels of refinement everywhere. */
static void set(struct sph_case *c, const struct triangle *t, double L, int levels)
{
    sph_case_set(c, 2, CELLS);
    struct scene *s = &c->run.scene;
    s->fluid.nu = 0.0;
    s->initial.field = FIELD_REST;
    c->prm.dx = L / CELLS;
    c->prm.surface = SURFACE_YES;
    c->prm.scheme = SCHEME_RIEMANN;
    s->nshapes = 1;
    s->shapes[0].form = SHAPE_POLYGON;
    s->shapes[0].points.n = SIDES;
    for (int k = 0; k < SIDES; k++)
        for (int a = 0; a < 2; a++)
            s->shapes[0].points.x[k][a] = L * t->x[k][a];
    apr_given = (struct apr_params){.levels = levels, .margin = 3.0};
    apr_given.regions.n = levels > 0;
    apr_given.regions.of[0].level = levels;
    for (int a = 0; a < 2; a++) {
        s->domain.max[a] = L;
        s->domain.periodic[a] = false;
        apr_given.regions.of[0].min[a] = -L;
        apr_given.regions.of[0].max[a] = 2.0 * L;
    }
}

static struct sph *start(struct sph_case *c, const struct triangle *t, double L, int levels)
{
    set(c, t, L, levels);
    return sph_case_start(c, NULL);
}

static void finish(struct sph_case *c)
{
    DROP(c->s);
    apr_given = (struct apr_params){0};
}

static double sum_anywhere(double v) { return ranks_sum(MPI_COMM_WORLD, v); }

/* Sum of w f over the particles of a level, f = 1, or the cube of x from the middle. */
static double volume(const struct sph *q)
{
    double sum = 0.0;
    for (int i = 0; i < q->p.n; i++)
        sum += state_row(&q->p, q->p.y, i)[at_volume(2)];
    return sum_anywhere(sum);
}

static double skewness(const struct sph *q, double L)
{
    double sum = 0.0;
    for (int i = 0; i < q->p.n; i++) {
        const double *y = state_row(&q->p, q->p.y, i);
        sum += y[at_volume(2)] * pow(y[0] / L - 0.5, 3.0);
    }
    return sum_anywhere(sum);
}

/* Least and largest distance of places on the edges, but for corners, to the nearest particle of a
 * level. */
static void find_gaps(const struct sph *q, const struct triangle *t, double gap[2])
{
    enum { PLACES = 101 };
    double least[SIDES * PLACES]; /* squared */
    for (int k = 0; k < SIDES * PLACES; k++) {
        const double *a = t->x[k / PLACES], *b = t->x[(k / PLACES + 1) % SIDES];
        const double part = 0.15 + 0.7 * (k % PLACES) / (PLACES - 1.0);
        const double x[2] = {a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])};
        least[k] = INFINITY;
        for (int i = 0; i < q->p.n; i++) {
            const double *y = state_row(&q->p, q->p.y, i);
            const double d[2] = {y[0] - x[0], y[1] - x[1]};
            least[k] = fmin(least[k], d[0] * d[0] + d[1] * d[1]);
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, least, SIDES * PLACES, MPI_DOUBLE, MPI_MIN, MPI_COMM_WORLD);
    gap[0] = INFINITY;
    gap[1] = 0.0;
    for (int k = 0; k < SIDES * PLACES; k++) {
        gap[0] = fmin(gap[0], sqrt(least[k]) / q->dx);
        gap[1] = fmax(gap[1], sqrt(least[k]) / q->dx);
    }
}

/* A row ends half of its spacing from the surface along itself: 0.33 dx across it at 45 degrees,
 * with a spacing of 15/16 dx; midway between two rows there the nearest particle is
 * hypot(0.38, 0.71) = 0.80 dx away. Steps of a lattice: 0 to 1.1 dx. Corners miss, or have too
 * much, up to 0.7 dx^2 each. */
TEST(levels_end_at_the_surface)
{
    for (int seed = 0; seed < (SANITIZED ? 1 : getenv("LONG") ? 12 : 6); seed++) {
        const struct triangle t = triangle_of(seed, false);
        struct sph_case c;
        int level = 0;
        for (const struct sph *q = start(&c, &t, 1.0, LEVELS); q; q = q->finer, level++) {
            double gap[2];
            find_gaps(q, &t, gap);
            assert_true(gap[0] > 0.3 && gap[1] < 0.85);
            assert_close(volume(q) / q->dxD, area_of(&t) / q->dxD, 2.0);
        }
        assert_int_equal(level, LEVELS + 1);
        finish(&c);
    }
}

TEST(mirrors_and_units_agree)
{
    for (int seed = 0; seed < (SANITIZED ? 1 : 4); seed++) {
        const struct triangle t = triangle_of(seed, false), u = triangle_of(seed, true);
        struct sph_case c, d;
        const struct sph *q = start(&c, &t, 1.0, 1), *r = start(&d, &u, 1e3, 1);
        for (; q; q = q->finer, r = r->finer) {
            assert_close(volume(q), 1e-6 * volume(r), 1e-9);
            assert_close(skewness(q, 1.0), -1e-6 * skewness(r, 1e3), 1e-9);
        }
        finish(&d);
        finish(&c);
    }
}

/* Under gravity each column stands under the surface above it, at every level: to what the surface
 * falls over half a coarse spacing and the half of it that a row moves aside. */
TEST(columns_weigh_what_is_above_them)
{
    const double g = 9.81, left = 0.63, right = 0.38, slope = (left - right) / 0.75;
    const double x[4][2] = {{0.125, 0.0}, {0.875, 0.0}, {0.875, right}, {0.125, left}};
    const struct triangle t = triangle_of(0, false);
    struct sph_case c;
    set(&c, &t, 1.0, LEVELS);
    struct scene *s = &c.run.scene;
    s->fluid.gravity[1] = -g;
    s->initial.level = LEVEL_TOP;
    s->nwalls = 1;
    s->walls[0].side = SIDE_Y_MIN;
    s->shapes[0].points.n = 4;
    memcpy(s->shapes[0].points.x, x, sizeof x);
    s->nshapes = 2; /* a drop above it falls, without weight */
    s->shapes[1].form = SHAPE_DISC;
    s->shapes[1].centre[0] = 0.6;
    s->shapes[1].centre[1] = 0.8;
    s->shapes[1].radius = 0.1;
    c.prm.c0 = 1000.0 * sqrt(g); /* density hardly varies */
    int level = 0;
    for (const struct sph *q = sph_case_start(&c, NULL); q; q = q->finer, level++) {
        double worst = 0.0;
        for (int i = 0; i < q->p.n; i++) {
            const double *y = state_row(&q->p, q->p.y, i);
            const double p = eos_p(y[at_mass(2)] / y[at_volume(2)], q->rho0, q->c0, q->gamma);
            const double head = y[1] < 0.65 ? left - slope * (y[0] - 0.125) - y[1] : 0.0;
            worst = fmax(worst, fabs(p / g - head));
        }
        assert_true(max_anywhere(worst) < slope * c.prm.dx);
        assert_close(volume(q), 0.375 * (left + right) + 0.01 * pi, 3.0 * q->dxD);
    }
    assert_int_equal(level, LEVELS + 1);
    finish(&c);
}

/* A dam and a level whose surfaces lie anywhere between rows: all of their water is there, but for
 * what volumes beside the floor make up for at the dam's toe, and the last row half of its spacing
 * inside. */
TEST(flat_surfaces_hold_their_water)
{
    const struct triangle t = triangle_of(0, false);
    for (int k = 0; k < (SANITIZED ? 2 : 4); k++) {
        const double dx = 1.0 / CELLS, width = (30.0 + 0.37 * k) * dx,
                     height = (25.0 + 0.55 * k) * dx;
        struct sph_case c;
        set(&c, &t, 1.0, LEVELS);
        struct scene *s = &c.run.scene;
        s->nwalls = 1;
        s->walls[0].side = SIDE_Y_MIN;
        s->fluid.gravity[1] = -9.81;
        s->shapes[0].form = k % 2 ? SHAPE_BOX : SHAPE_BELOW;
        s->shapes[0].level = height;
        s->shapes[0].box[1][0] = width;
        s->shapes[0].box[1][1] = height;
        c.prm.c0 = 1000.0;
        for (const struct sph *q = sph_case_start(&c, NULL); q; q = q->finer) {
            double top = 0.0;
            for (int i = 0; i < q->p.n; i++)
                top = fmax(top, state_row(&q->p, q->p.y, i)[1]);
            assert_close(volume(q), (k % 2 ? width : 1.0) * height, 1e-5 * height);
            assert_close(max_anywhere(top), height - 0.5 * q->dx, 0.07 * q->dx);
        }
        finish(&c);
    }
}
