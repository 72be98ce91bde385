/* mock_calls.c - two partners, "one" and "two", that call cpl.h wrongly wherever it says what is
 * right: each call must return its code with a sentence, and the job must go on as if nothing had
 * been. Exit code 0 if so. usage: mock_calls NAME DIR
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../coupler/cpl.h"

static struct cpl *c;
static int failed;

static void expect_at(int line, int code, int wanted, const char *text)
{
    if (code == wanted && (!text || strstr(cpl_strerror(c), text)))
        return;
    printf("mock_calls.c:%d: code %d, wanted %d: \"%s\", wanted \"%s\"\n", line, code, wanted,
           cpl_strerror(c), text ? text : "");
    failed = 1;
}
#define good(call) expect_at(__LINE__, call, CPL_OK, NULL)
#define order(call, text) expect_at(__LINE__, call, CPL_EORDER, text)
#define input(call, text) expect_at(__LINE__, call, CPL_EINPUT, text)

static const double here[3] = {0.25, 0.5, 0.0}, hi[3] = {1.0, 1.0, 1.0};
static const int64_t ids[2] = {1, 2};
static const double two_places[6] = {0.2, 0.2, 0.0, 0.8, 0.8, 0.0}, two_values[2] = {1.0, 2.0};
static const double no_number[6] = {0.0, 0.0, 0.0, 0.0, NAN, 0.0};
static char longest[CPL_NAME + 1], key[200], file[400];

static void before_meeting(const char *name, const char *dir)
{
    double lo[3], up[3];
    char zone[CPL_NAME];
    int id, action, code;
    double t0, t1;
    order(cpl_find_zone(c, "one.zone", lo, up), "after cpl_meet");
    order(cpl_points(c, "p", 2, 0.0, &id), "between cpl_meet and cpl_ready");
    order(cpl_ready(c, 0.0, 1.0), "after cpl_meet");
    order(cpl_window(c, &t0, &t1, &action, &code), "after cpl_ready");
    order(cpl_put(c, 0, 0.0, 0, NULL, NULL), "not a field to put");
    input(cpl_zone(c, longest, here, hi), "64 bytes, 63 are possible");
    input(cpl_zone(c, "", here, hi), "zone without a name");
    for (int i = 0; i < 32; i++) { /* all of the job are known to all, 64 at most */
        snprintf(zone, sizeof zone, "%s.zone%d", name, i);
        good(cpl_zone(c, zone, here, hi));
    }
    good(cpl_meet(c, 0, -1, 0, dir));
    order(cpl_meet(c, 0, -1, 0, dir), "once, after cpl_open");
    order(cpl_zone(c, "late", here, hi), "before cpl_meet");
    good(cpl_find_zone(c, strcmp(name, "one") ? "one.zone31" : "two.zone0", lo, up));
    if (lo[0] != here[0] || up[1] != hi[1])
        failed = 1;
    input(cpl_find_zone(c, "nowhere", lo, up), "no program of this job has a zone `nowhere'");
}

static void declare(const char *name, int *points, int *grid, int *put, int *cells, int *get,
                    int *patch)
{
    const int first = strcmp(name, "one") == 0;
    const double back[3] = {-1.0, 0.0, 0.0};
    struct cpl_grid g = {.dim = 2, .spacing = {0.5, 0.0}, .cells = {2, 2}, .hi = {2, 2}};
    int id;
    input(cpl_points(c, "p", 4, 0.0, &id), "dimension 4, not 2 or 3");
    input(cpl_points(c, longest, 2, 0.0, &id), "63 are possible");
    input(cpl_grid(c, "g", &g, &id), "axis 1");
    g.spacing[1] = 0.5;
    good(cpl_points(c, "p", 2, 0.9, points));
    good(cpl_grid(c, "g", &g, grid));
    input(cpl_period(c, *points, back), "a period of -1 m");
    order(cpl_period(c, *grid, hi), "after its set of points");
    order(cpl_field(c, 7, "f", "m", 1, CPL_PUT, 0, &id), "after its set");
    input(cpl_field(c, *points, "f", "m", 1, CPL_PUT | CPL_GET, 0, &id), "3 is no direction");
    input(cpl_field(c, *points, "f", "", 1, CPL_PUT, 0, &id), "without a name");
    input(cpl_field(c, *points, "f", longest, 1, CPL_PUT, 0, &id), "63 are possible");
    input(cpl_field(c, *points, "f", "m", 0, CPL_PUT, 0, &id), "0 components");
    good(cpl_field(c, *points, first ? "one.p" : "two.p", "m", 1, CPL_PUT, 0, put));
    good(cpl_field(c, *grid, first ? "one.g" : "two.g", "m", 1, CPL_PUT, 0, cells));
    good(cpl_field(c, *points, first ? "two.p" : "one.p", "m", 1, CPL_GET, CPL_SHEPARD, get));
    good(cpl_field(c, *points, first ? "two.g" : "one.g", "m", 1, CPL_GET, CPL_LINEAR, patch));
    for (int i = 2; i < 32; i++)
        good(cpl_points(c, "more", 3, 0.0, &id));
    input(cpl_points(c, "more", 3, 0.0, &id), "more than 32 sets");
    for (int i = 4; i < 64; i++) {
        char field[CPL_NAME];
        snprintf(field, sizeof field, "%s.more%d", name, i);
        good(cpl_field(c, *points, field, "m", 1, CPL_PUT | CPL_OPTIONAL, 0, &id));
    }
    input(cpl_field(c, *points, "f", "m", 1, CPL_PUT | CPL_OPTIONAL, 0, &id),
          "more than 64 fields");
}

static void give(int points, int grid, int put, int cells, int get)
{
    const double flat[12] = {0, 0, 0, 1, 1, 0, 2, 2, 0, 3, 3, 0}, four[4] = {1, 1, 1, 1};
    const double *const course[5] = {two_values, two_values, two_values, two_values, two_values};
    const int three = 3;
    order(cpl_put(c, put, 0.0, 2, two_values, NULL), "before cpl_move has placed p");
    input(cpl_move(c, points, 2, no_number, ids, two_values), "point 1 on rank 0 is not finite");
    order(cpl_move(c, points, 2, two_places, NULL, two_values), "not a set of points, or no ids");
    order(cpl_move(c, grid, 2, two_places, ids, two_values), "not a set of points");
    input(cpl_move_cells(c, points, 1, &three, flat, ids),
          "cell 0 on rank 0, of 3 corners, has no");
    good(cpl_move(c, points, 2, two_places, ids, NULL));
    order(cpl_put(c, put, 0.0, 2, two_values, NULL), "its points have no volumes or ids");
    good(cpl_move(c, points, 2, two_places, ids, two_values));
    input(cpl_put(c, put, 0.0, 3, four, NULL), "3 values for 2 places of p");
    input(cpl_put(c, cells, 0.0, 2, four, NULL), "2 values for 4 places of g");
    input(cpl_put(c, cells, 0.0, 4, no_number + 1, NULL), "value 3 of g on rank 0 is not finite");
    order(cpl_put(c, get, 0.0, 2, two_values, NULL), "not a field to put");
    order(cpl_put_course(c, put, 0.0, 2, 5, course), "5 terms in time; 1 to 4");
    order(cpl_put_course(c, put, 0.0, 2, 0, course), "0 terms in time");
    good(cpl_put(c, put, 0.0, 2, two_values, two_values));
    order(cpl_put(c, put, 0.0, 2, two_values, two_values), "a second put at t = 0 s");
    good(cpl_put(c, cells, 0.0, 4, four, NULL));
}

static void take(double t0, double t1, int put, int get, int patch)
{
    double v[2] = {0.0, 0.0}, value = -1.0;
    order(cpl_get(c, patch, 2, v, NULL), "comes from a grid");
    order(cpl_patch_get(c, get, here, hi), "comes from points");
    order(cpl_get(c, put, 2, v, NULL), "not a field to get");
    order(cpl_get_at(c, get, (enum cpl_when)9, t0, 2, v, NULL), "9 is no enum cpl_when");
    input(cpl_get_at(c, get, CPL_START, t1 + 1.0, 2, v, NULL), "is not in the coupling step");
    input(cpl_get(c, get, 1, v, NULL), "1 targets, but cpl_move placed 2 of p");
    good(cpl_get_at(c, get, CPL_START, t0, 2, v, NULL));
    good(cpl_patch_get(c, patch, here, hi));
    cpl_patch_eval(c, patch, t0, 1, here, &value, NULL);
    if (v[0] == 0.0 || value != 1.0)
        failed = 1;
}

static int window(int put, int get, int patch)
{
    double t0, t1, other;
    int action, code;
    good(cpl_window(c, &t0, &t1, &action, &code));
    if (action & CPL_STOP) {
        order(cpl_put(c, put, t1, 2, two_values, NULL), "outside of a coupling step");
        return 0;
    }
    order(cpl_window(c, &other, &other, &action, &code), "after cpl_ready or cpl_advance");
    if (cpl_window_number(c) == 0)
        take(t0, t1, put, get, patch);
    input(cpl_tell(c, key, 1.0), "a key of 199 bytes, 95 are possible");
    input(cpl_saved(c, file), "a file's name of 399 bytes, 255 are possible");
    input(cpl_saved(c, "my file.h5"), "`my file.h5': expected a file's name without spaces");
    input(cpl_advance(c, t1 + 0.5, 0), "coupling step");
    good(cpl_advance(c, t1, 0));
    order(cpl_advance(c, t1, 0), "after cpl_window");
    return 1;
}

int main(int argc, char **argv)
{
    int points = 0, grid = 0, put = 0, cells = 0, get = 0, patch = 0;
    MPI_Comm mine;
    MPI_Init(&argc, &argv);
    memset(longest, 'x', CPL_NAME);
    memset(key, 'k', sizeof key - 1);
    memset(file, 'f', sizeof file - 1);
    if (cpl_version() != CPL_VERSION || cpl_open(MPI_COMM_WORLD, argv[1], 10.0, &c, &mine) || !c)
        return MPI_Finalize(), 2;
    before_meeting(argv[1], argv[2]);
    declare(argv[1], &points, &grid, &put, &cells, &get, &patch);
    good(cpl_ready(c, 0.0, INFINITY));
    order(cpl_ready(c, 0.0, INFINITY), "once, after cpl_meet");
    order(cpl_field(c, points, "f", "m", 1, CPL_PUT, 0, &put), "before cpl_ready");
    give(points, grid, put, cells, get);
    while (window(put, get, patch))
        continue;
    const int code = cpl_close(&c, 0);
    if (c)
        failed = 1;
    MPI_Finalize();
    return code ? code : failed;
}
