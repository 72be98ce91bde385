/* test_still.c - the pressure of water at rest is the whole one, rho g times the depth below the
 * level, at gauges and in forces, on cells, on blocks and under a free surface.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "fv_case.h"

enum { COLUMNS = 40 };

#define HEAD                                                                                       \
    "format = 1;\ntime: { end = 0.1; };\n"                                                         \
    "domain: { dim = 2; min = (-1, -1); max = (1, 1); };\n"                                        \
    "probes: ( { name = \"p\"; at = (0.85, -0.5); } );\n"
#define CELLS                                                                                      \
    "fv: { cells = (16, 16); };\nwalls: ( { side = \"x_min\"; }, { side = \"x_max\"; kind = "      \
    "\"no_slip\"; }, { side = \"y_min\"; }, { side = \"y_max\"; } );\n"
#define BOX                                                                                        \
    "{ name = \"box\"; cells = (48, 48); min = (-1, -1); max = (1, 1); i_min = \"wall\"; i_max = " \
    "\"wall\"; j_min = \"wall\"; j_max = \"wall\"; }"
#define RING                                                                                       \
    "{ name = \"ring\"; mapping = \"annulus\"; radius = (0.3, 0.8); cells = (16, 64); i_min = "    \
    "\"wall\"; j_min = \"joined\"; j_max = \"joined\"; }"

static struct run run;
static const char *path;
static double datum; /* Pa: of a partner */

/* The row of the series after the first step, and its headings. */
static void row_of(const char *text, double *row, char (*columns)[80])
{
    struct faults f = {0};
    struct diagnosis d = {0};
    struct params *p = fv_case_read(&run, MPI_COMM_WORLD, path, text, NULL, &f);
    fv_params_check(&run, &f);
    assert_int_equal(params_report(&f), 0);
    struct fv *s = fv_create(&run, NULL);
    integrate(s, 0.1, &d);
    s->partners.pressure = datum;
    struct figures *named = NEW(struct figures, 1);
    fv_row(s, named);
    for (int k = 0; k < named->n && columns; k++)
        snprintf(columns[k], sizeof columns[k], "%s", named->title[k]);
    FREE(named);
    VALUES_OF(fv_row, s, row);
    fv_free(&s);
    assert_false(d.bad);
    params_free(&p);
}

/* Energy, speed, divergence, forces, then what the scene has. */
TEST(cells_know_the_whole_pressure)
{
    double row[COLUMNS] = {0};
    row_of(HEAD "fluid: { rho = 1000; nu = 0.01; gravity = (0, -9.81); };\n" CELLS, row, NULL);
    assert_close(row[3], 0.0, 1e-6);
    assert_close(row[4], -1000 * 9.81 * 4, 1e-6); /* the lid feels nothing, the floor the weight */
    assert_close(row[5], 1000 * 9.81 * 1.5, 1e-6);
    row_of(HEAD "initial: { level = 2; };\n" /* under pressure: the lid feels 1 m of water */
                "fluid: { rho = 1000; nu = 0.01; gravity = (0, -9.81); };\n" CELLS,
           row, NULL);
    assert_close(row[4], -1000 * 9.81 * 4, 1e-6);
    assert_close(row[5], 1000 * 9.81 * 2.5, 1e-6);
}

/* A wall without water feels nothing. */
TEST(walls_under_a_free_surface_feel_the_water_alone)
{
    double row[COLUMNS] = {0};
    row_of(HEAD "fluid: { rho = 1000; nu = 0.01; gravity = (0, -9.81); };\nshapes: ( { form = "
                "\"below\"; level "
                "= 0.2; } );\n" CELLS,
           row, NULL);
    assert_close(row[3], 0.0, 1e-6);
    assert_close(row[4], -1000 * 9.81 * 2 * 1.2, 1e-6);
    assert_close(row[8], 1000 * 9.81 * 0.7, 1e-6);
}

/* The level is a height against gravity, whichever way that points. */
TEST(levels_stand_against_gravity)
{
    static const char *const walls =
        "walls: ( { side = \"x_min\"; }, { side = \"x_max\"; }, { side = \"y_min\"; }, { side = "
        "\"y_max\"; }, { side = \"z_min\"; }, { side = \"z_max\"; } );\n"
        "probes: ( { name = \"h\"; kind = \"level\"; at = (0.5, 0.5, 0.5); } );\n"
        "fv: { cells = (8, 8, 8); };\n";
    static const double wanted[4] = {0.2, 0.2, 0.2, -0.8};
    static const char *const gravity[4] = {"(-1, 0, 0)", "(0, -1, 0)", "(0, 0, -1)", "(0, 1, 0)"};
    for (int k = 0; k < 4; k++) {
        double row[COLUMNS] = {0};
        char text[2048];
        snprintf(
            text, sizeof text,
            "format = 1;\ntime: { end = 0.1; };\ndomain: { dim = 3; min = (0, 0, 0); max = (1, "
            "1, 1); };\nfluid: { gravity = %s; };\nshapes: ( { form = \"below\"; level = %g; } "
            ");\n%s",
            gravity[k], k == 3 ? -0.8 : 0.2, walls);
        row_of(text, row, NULL);
        assert_close(row[10], wanted[k], 1e-9);
    }
}

/* What runs down along a periodic axis, steeper than 45 degrees, stands on the floor across it. */
TEST(films_stand_across_their_flow)
{
    double row[COLUMNS] = {0};
    row_of("format = 1;\ntime: { end = 0.1; };\nfluid: { rho = 1000; nu = 0.01; gravity = (8, -5); "
           "};\n"
           "domain: { dim = 2; min = (0, 0); max = (1, 1); periodic = (true, false); };\n"
           "shapes: ( { box = ((-1, -1), (2, 0.5)); } );\n"
           "walls: ( { side = \"y_min\"; kind = \"no_slip\"; }, { side = \"y_max\"; } );\n"
           "probes: ( { name = \"h\"; kind = \"level\"; at = (0.3, 0); }, { name = \"p\"; at = "
           "(0.3, 0); } );\n"
           "fv: { cells = (8, 8); };\n",
           row, NULL);
    assert_close(row[8], 0.5, 1e-6);
    assert_close(row[9], 1000 * 5 * 0.5, 1e-3);
}

TEST(blocks_know_the_whole_pressure)
{
    char columns[COLUMNS][80];
    double row[COLUMNS] = {0};
    const double lift = 1000 * 9.81 * M_PI * 0.3 * 0.3;
    row_of(HEAD "fluid: { rho = 1000; nu = 0.01; gravity = (0, -9.81); };\nfv: { };\nblocks: ( " BOX
                ", " RING " );\n",
           row, columns);
    assert_string_equal(columns[7], "box force y [N/m]");
    assert_string_equal(columns[10], "ring force y [N/m]");
    assert_string_equal(columns[11], "ring moment z [N]");
    assert_close(row[7], -1000 * 9.81 * 4, 1e-6);
    assert_close(row[9], 0.0, 1e-6);
    assert_close(row[10], lift, 1e-3 * lift); /* a circle of 64 corners */
    assert_close(row[11], 0.0, 1e-6);
    assert_close(row[4], row[7] + row[10], 1e-6);
    assert_close(row[12], 1000 * 9.81 * 1.5, 1e-6);
}

/* Gauges have it on all grids; it is no force on what is closed. */
TEST(a_partners_level_counts)
{
    static const char *const grids[2] = {CELLS, "fv: { };\nblocks: ( " BOX " );\n"};
    datum = 250.0;
    for (int k = 0; k < 2; k++) {
        double row[COLUMNS] = {0};
        char text[2048];
        snprintf(text, sizeof text,
                 HEAD "fluid: { rho = 1000; nu = 0.01; gravity = (0, -9.81); };\n%s", grids[k]);
        row_of(text, row, NULL);
        assert_close(row[3], 0.0, 1e-6);
        assert_close(row[4], -1000 * 9.81 * 4, 1e-6);
        assert_close(row[k ? 6 : 5], 1000 * 9.81 * 1.5 + datum, 1e-6);
    }
    datum = 0.0;
}

void unit_begin(void) { path = unit_file("still.cfg"); }
