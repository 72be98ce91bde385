/* test_same_scene.c - a scene on uniform cells and the same scene as one block give one series:
 * energy, speed, forces on all closed sides, volume, gauges; the divergence has one unit.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../fv/operators/flow_measures.h"
#include "fv_case.h"

struct forms {
    const char *name, *text;
    const char *cells, *box; /* numbers of cells; box of the domain */
    double end;              /* s */
    double scale;            /* N: weight, or friction of a moving wall's speed over the height */
    double tolerance;        /* of forces in scales, of all else relative to itself */
};
#define DOMAIN "domain: { dim = 2; min = (0, 0); max = (1, 0.5); };\n"
#define PROBE "probes: ( { name = \"p\"; at = (0.4, 0.1); } );\n"
static const struct forms scenes[] = {
    {"still, slip",
     DOMAIN PROBE "fluid: { rho = 1000.0; nu = 1e-3; gravity = (0, -10.0); };\n"
                  "walls: ( { side = \"x_min\"; }, { side = \"x_max\"; }, { side = \"y_min\"; }, "
                  "{ side = \"y_max\"; } );\nshapes: ( { form = \"below\"; level = 0.31; } );\n",
     "(40, 20)", "min = (0, 0); max = (1, 0.5)", 0.05, 3100.0, 1e-9},
    {"still, slip and no-slip, full",
     DOMAIN PROBE
     "fluid: { rho = 1000.0; nu = 1e-3; gravity = (0, -10.0); };\ninitial: { level = 0.7; };\n"
     "walls: ( { side = \"x_min\"; }, { side = \"x_max\"; kind = \"no_slip\"; }, "
     "{ side = \"y_min\"; }, { side = \"y_max\"; kind = \"no_slip\"; } );\n",
     "(40, 20)", "min = (0, 0); max = (1, 0.5)", 0.05, 5000.0, 1e-9},
    {"still, 3D",
     "domain: { dim = 3; min = (0, 0, 0); max = (1, 0.5, 0.5); };\n"
     "fluid: { rho = 1000.0; nu = 1e-3; gravity = (0, 0, -10.0); };\n"
     "walls: ( { side = \"x_min\"; }, { side = \"x_max\"; kind = \"no_slip\"; }, { side = "
     "\"y_min\"; }, { side = \"y_max\"; }, { side = \"z_min\"; }, { side = \"z_max\"; } );\n"
     "shapes: ( { form = \"below\"; level = 0.31; } );\n",
     "(20, 10, 10)", "min = (0, 0, 0); max = (1, 0.5, 0.5)", 0.05, 1550.0, 1e-9},
    {"cavity",
     DOMAIN PROBE
     "fluid: { rho = 1000.0; nu = 1e-2; };\n"
     "walls: ( { side = \"x_min\"; kind = \"no_slip\"; }, { side = \"x_max\"; kind = "
     "\"no_slip\"; }, { side = \"y_min\"; }, { side = \"y_max\"; kind = \"no_slip\"; velocity = "
     "(1, 0); } );\n",
     "(32, 16)", "min = (0, 0); max = (1, 0.5)", 0.5, 20.0, 1e-3},
    {"channel",
     DOMAIN PROBE
     "fluid: { rho = 1000.0; nu = 1e-2; gravity = (0, -1.0); };\n"
     "walls: ( { side = \"x_min\"; kind = \"inflow\"; velocity = (1, 0); profile = "
     "\"parabolic\"; }, { side = \"x_max\"; kind = \"outflow\"; pressure = 50.0; }, { side = "
     "\"y_min\"; kind = \"no_slip\"; }, { side = \"y_max\"; } );\n",
     "(32, 16)", "min = (0, 0); max = (1, 0.5)", 0.5, 500.0, 1e-3},
    {"sloshing",
     DOMAIN PROBE
     "fluid: { rho = 1000.0; nu = 1e-3; gravity = (0, -10.0); };\n"
     "walls: ( { side = \"x_min\"; }, { side = \"x_max\"; }, { side = \"y_min\"; }, "
     "{ side = \"y_max\"; } );\n"
     "shapes: ( { form = \"polygon\"; points = ((-1, 0.23), (2, 0.34), (2, -1), (-1, -1)); } );\n",
     "(40, 20)", "min = (0, 0); max = (1, 0.5)", 0.3, 2850.0, 0.03},
    {"solitary wave",
     "domain: { dim = 2; min = (0, 0); max = (4, 0.5); };\n"
     "probes: ( { name = \"crest\"; kind = \"level\"; at = (2.36, 0); } );\n"
     "fluid: { rho = 1000.0; gravity = (0, -10.0); };\n"
     "initial: { field = \"solitary\"; amplitude = 0.12; level = 0.25; crest = 1.2; };\n"
     "walls: ( { side = \"x_min\"; }, { side = \"x_max\"; }, { side = \"y_min\"; }, "
     "{ side = \"y_max\"; } );\n",
     "(80, 20)", "min = (0, 0); max = (4, 0.5)", 0.6, 1e4, 6e-3},
};

/* Water 0.2 m deep and a drop of 0.1 m over it: a level gauge sees 0.3 m of water. */
static const struct forms drop = {
    "drop over water",
    DOMAIN "fluid: { rho = 1000.0; gravity = (0, -10.0); };\n"
           "probes: ( { name = \"l\"; kind = \"level\"; at = (0.5, 0); } );\n"
           "walls: ( { side = \"x_min\"; }, { side = \"x_max\"; }, { side = \"y_min\"; }, "
           "{ side = \"y_max\"; } );\n"
           "shapes: ( { form = \"below\"; level = 0.2; }, { box = ((0.4, 0.3), (0.6, 0.4)); } );\n",
    "(40, 20)",
    "min = (0, 0); max = (1, 0.5)",
    0.05,
    0.0,
    0.0};

/* A ring with a pool 0.3 m deep below it, and a film on all of its wall, 0.4 cells thick. */
static const struct forms drum = {
    "film on a drum",
    "domain: { dim = 2; min = (-0.5, -0.5); max = (0.5, 0.5); };\n"
    "fluid: { rho = 1000.0; nu = 1e-3; gravity = (0, -10.0); };\n"
    "shapes: ( { form = \"disc\"; radius = 0.5; }, { form = \"disc\"; radius = 0.492; hole = true; "
    "}, { form = \"box\"; box = ((-0.5, -0.5), (0.5, -0.2)); } );\n",
    "(20, 96)",
    "mapping = \"annulus\"; radius = (0.1, 0.5); j_min = \"joined\"; j_max = \"joined\"; "
    "i_min = \"slip\"; i_max = \"wall\"",
    0.04,
    1982.0,
    0.05};

static struct run run;
static const char *path;

/* The flow at t = 0; the case stays in `p'. */
static struct fv *start(const struct forms *of, bool block, struct params **p)
{
    struct faults f = {0};
    char text[4096];
    const int n =
        snprintf(text, sizeof text, "format = 1;\ntime: { end = %g; };\n%s", of->end, of->text);
    if (block)
        snprintf(text + n, sizeof text - (size_t)n,
                 "fv: { };\nblocks: ( { name = \"a\"; cells = %s; %s; } );\n", of->cells, of->box);
    else
        snprintf(text + n, sizeof text - (size_t)n, "fv: { cells = %s; };\n", of->cells);
    *p = fv_case_read(&run, MPI_COMM_WORLD, path, text, NULL, &f);
    fv_params_check(&run, &f);
    assert_int_equal(params_report(&f), 0);
    return fv_create(&run, NULL);
}

/* A row of the series with its titles; owned by the caller (FREE). */
static struct figures *figures_of(struct fv *s)
{
    struct figures *row = NEW(struct figures, 1);
    for (int k = 0; k < 2; k++) {
        row->n = 0;
        row->measures = k == 1;
        fv_row(s, row);
    }
    return row;
}

/* That at the end. */
static struct figures *last_row(const struct forms *of, bool block)
{
    struct params *p;
    struct diagnosis d = {0};
    struct fv *s = start(of, block, &p);
    while (s->t < of->end * (1.0 - 1e-9) && !d.bad)
        integrate(s, of->end, &d);
    assert_false(d.bad);
    struct figures *row = figures_of(s);
    fv_free(&s);
    params_free(&p);
    return row;
}

static double value(const char *name, const struct figures *row)
{
    for (int k = 0; k < row->n; k++)
        if (strcmp(row->title[k], name) == 0)
            return row->value[k];
    fail_msg("no column \"%s\"", name);
    return NAN;
}

TEST(cells_and_a_block_give_one_series)
{
    for (size_t q = 0; q < sizeof scenes / sizeof scenes[0]; q++) {
        struct figures *cells = last_row(scenes + q, false), *block = last_row(scenes + q, true);
        for (int k = 0; k < cells->n; k++) {
            const char *title = cells->title[k];
            const double here = cells->value[k], there = value(title, block);
            print_message("%s: %s %.9g %.9g\n", scenes[q].name, title, here, there);
            if (strncmp(title, "force", 5) == 0)
                assert_close(there, here, scenes[q].tolerance * scenes[q].scale);
            else if (strncmp(title, "p [", 3) == 0 || strstr(title, "kinetic"))
                assert_close(there, here, fmin(scenes[q].tolerance, 1e-3) * fabs(here) + 1e-9);
            else if (!strstr(title, "divergence") && !strstr(title, "put back"))
                assert_close(there, here, scenes[q].tolerance * fabs(here) + 1e-9);
        }
        FREE(cells, block);
    }
}

/* rho g V of the water at rest. */
TEST(closed_sides_carry_the_weight)
{
    for (int q = 0; q < 3; q++)
        for (int block = 0; block < 2; block++) {
            struct figures *row = last_row(scenes + q, block);
            const char *up = q == 2 ? "force z [N]" : "force y [N/m]";
            assert_close(value(up, row), -scenes[q].scale, 1e-9 * scenes[q].scale);
            FREE(row);
        }
}

TEST(a_level_counts_water_and_no_air_under_it)
{
    for (int block = 0; block < 2; block++) {
        struct figures *row = last_row(&drop, block);
        assert_close(value("l [m]", row), 0.3, 0.002);
        FREE(row);
    }
}

/* A film along a wall that no cell of water lies under has no weight to press with, nor draws at
 * the wall above it: the drum bears the segment of the pool, R^2 acos(d/R) - d (R^2 - d^2)^0.5. */
TEST(films_press_on_nothing)
{
    struct figures *row = last_row(&drum, true);
    const double tolerance = drum.tolerance * drum.scale;
    assert_close(value("force x [N/m]", row), 0.0, tolerance);
    assert_close(value("force y [N/m]", row), -drum.scale, tolerance);
    FREE(row);
}

/* Water at rest drawn flush with walls, or of several shapes that meet: its edges on walls of
 * blocks within the domain, leaning and round ones, and on faces of boxes that are cut out are no
 * surface, so it stands still and weighs what it does; nor is a seam, through centres of cells. A
 * tank turned by 20 degrees about its corner, filled to 0.45 m; a ring filled to 0.3 m above its
 * middle; a tank with a box in its floor that is a hole of the water. */
#define WATER "fluid: { rho = 1000.0; gravity = (0, -10.0); };\n"
#define AROUND "domain: { dim = 2; min = (-1.5, -1.5); max = (1.5, 1.5); };\n" WATER
#define RING                                                                                       \
    "mapping = \"annulus\"; radius = (0.4, 1.0); j_min = \"joined\"; j_max = \"joined\"; i_min = " \
    "\"slip\"; i_max = \"slip\""
#define SIDES                                                                                      \
    "domain: { dim = 2; min = (0, 0); max = (1.2, 0.8); };\n" WATER                                \
    "walls: ( { side = \"x_min\"; }, { side = \"x_max\"; }, { side = \"y_min\"; }, { side = "      \
    "\"y_max\"; } );\n"
#define BOX SIDES "blocked: ( { min = (0.4, 0); max = (0.8, 0.2); } );\n"
static const struct forms flush[] = {
    {"leaning tank",
     AROUND "shapes: ( { form = \"polygon\"; points = ((0, 0), (0.9396926208, 0.3420201433), "
            "(0.9003911671, 0.45), (-0.1637866054, 0.45)); } );\n",
     "(40, 28)",
     "min = (0, 0); max = (1, 0.7); angle = 20; i_min = \"slip\"; i_max = \"slip\"; j_min = "
     "\"slip\"; j_max = \"slip\"",
     0.05, 0.0, 0.0},
    {"disc in a ring",
     AROUND "shapes: ( { form = \"disc\"; radius = 1.0; }, { form = \"box\"; hole = true; box = "
            "((-2, 0.3), (2, 2)); } );\n",
     "(12, 60)", RING, 0.05, 0.0, 0.0},
    {"round hole in a ring",
     AROUND "shapes: ( { form = \"below\"; level = 0.3; }, { form = \"disc\"; radius = 0.4; hole = "
            "true; } );\n",
     "(12, 60)", RING, 0.05, 0.0, 0.0},
    {"hole at a box",
     BOX
     "shapes: ( { form = \"below\"; level = 0.41; }, { form = \"box\"; hole = true; box = ((0.4, "
     "0), (0.8, 0.2)); } );\n",
     "(24, 16)", NULL, 0.05, 0.0, 0.0},
    {"hole with corners at a box",
     BOX
     "shapes: ( { form = \"below\"; level = 0.41; }, { form = \"polygon\"; hole = true; points = "
     "((0.4, 0), (0.8, 0), (0.8, 0.2), (0.4, 0.2)); } );\n",
     "(24, 16)", NULL, 0.05, 0.0, 0.0},
    {"two boxes",
     SIDES "shapes: ( { form = \"box\"; box = ((0, 0), (0.6, 0.41)); }, { form = \"box\"; box = "
           "((0.6, 0), (1.2, 0.41)); } );\n",
     "(25, 16)", NULL, 0.05, 0.0, 0.0},
    {"two polygons",
     SIDES
     "shapes: ( { form = \"polygon\"; points = ((0, 0), (0.6, 0), (0.6, 0.41), (0, 0.41)); }, "
     "{ form = \"polygon\"; points = ((0.6, 0), (1.2, 0), (1.2, 0.41), (0.6, 0.41)); } );\n",
     "(25, 16)", "min = (0, 0); max = (1.2, 0.8)", 0.05, 0.0, 0.0},
};

TEST(walls_end_shapes_and_holes)
{
    for (size_t q = 0; q < sizeof flush / sizeof flush[0]; q++) {
        struct params *p;
        struct diagnosis d = {0};
        struct fv *s = start(flush + q, flush[q].box != NULL, &p);
        for (int k = 0; k < 2; k++) {
            struct figures *row = figures_of(s);
            const double weight = 1e4 * value("volume [m^dim]", row);
            print_message("%s: force %.9g, %.9g of %.9g N\n", flush[q].name,
                          value("force x [N/m]", row), value("force y [N/m]", row), -weight);
            assert_close(value("force x [N/m]", row), 0.0, 1e-6 * weight);
            assert_close(value("force y [N/m]", row), -weight,
                         2e-3 * weight); /* 12 cells across the ring */
            assert_true(value("largest velocity [m/s]", row) < 1e-10);
            FREE(row);
            while (s->t < flush[q].end * (1.0 - 1e-9) && !d.bad)
                integrate(s, flush[q].end, &d);
        }
        fv_free(&s);
        params_free(&p);
    }
}

/* Fluxes of the velocity (x, 0): its divergence is 1/s everywhere. */
TEST(divergence_is_a_rate)
{
    for (int block = 0; block < 2; block++) {
        struct params *p;
        struct fv *s = start(scenes + 3, block, &p);
        const struct part *own = s->grid.part;
        for (int64_t c = 0; c < s->size; c++)
            s->U[0][c] = s->U[1][c] = 0.0;
        for (int j = 0; j < own->n[1]; j++)
            for (int i = 0; i <= own->n[0]; i++)
                s->U[0][part_at(own, i, j, 0)] = i / 32.0 * (block ? 1.0 / 32.0 : 1.0);
        assert_close(flow_largest_divergence(s), 1.0, 1e-12);
        fv_free(&s);
        params_free(&p);
    }
}

void unit_begin(void) { path = unit_file("same.cfg"); }
