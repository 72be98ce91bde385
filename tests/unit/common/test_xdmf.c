/* test_xdmf.c - the list of snapshots is whole and well formed after each entry, and a restart
 * keeps what lies before it. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include <ctype.h>
#include <unistd.h>

#include "../../../common/files/xdmf.h"

static const char *path;
static const struct xdmf_field fields[] = {{"velocity", 2}, {"pressure", 1}, {"force", 3}};

/* The file at path; static buffer. */
static const char *text(void)
{
    static char all[1 << 16];
    FILE *f = fopen(path, "r");
    assert_non_null(f);
    all[fread(all, 1, sizeof all - 1, f)] = '\0';
    fclose(f);
    return all;
}

static int count(const char *word)
{
    int n = 0;
    for (const char *c = strstr(text(), word); c; c = strstr(c + 1, word))
        n++;
    return n;
}

/* Elements are closed in the order opposite to their opening, attributes are quoted, one root. */
static bool well_formed(const char *c)
{
    char open[16][64];
    int depth = 0, roots = 0;
    if (strncmp(c, "<?xml", 5) != 0)
        return false;
    for (c = strstr(c, "?>") + 2; *c; c++) {
        if (*c != '<') {
            if (depth == 0 && !isspace((unsigned char)*c))
                return false;
            continue;
        }
        const size_t n = strcspn(c + 1 + (c[1] == '/'), " />");
        char name[64];
        snprintf(name, sizeof name, "%.*s", (int)n, c + 1 + (c[1] == '/'));
        const bool closing = c[1] == '/';
        bool quoted = false;
        const char *end = c + 1;
        for (; *end && (quoted || *end != '>'); end++) {
            if (*end == '"')
                quoted = !quoted;
            if (*end == '<' || (*end == '&' && strncmp(end, "&amp;", 5) != 0))
                return false;
        }
        if (!*end || n == 0)
            return false;
        if (closing && (depth == 0 || strcmp(open[--depth], name) != 0))
            return false;
        if (!closing && end[-1] != '/') {
            roots += depth == 0;
            if (depth == 16)
                return false;
            memcpy(open[depth++], name, sizeof name);
        }
        c = end;
    }
    return depth == 0 && roots == 1;
}

static void add(struct xdmf *x, int k, double t, int dim)
{
    const int cells[3] = {8, 4, 2};
    const double origin[3] = {1, 2, 3}, spacing[3] = {0.5, 0.25, 0.125};
    char file[64];
    snprintf(file, sizeof file, "sph_%06d.h5", k);
    if (k % 2)
        dim == 2 ? xdmf_flat(x, t, file, "sph_000001.h5", cells, 3, fields)
                 : xdmf_block(x, t, file, cells, origin, spacing, NULL, 3, fields);
    else
        xdmf_points(x, t, file, 1000 + k, dim, 3, fields);
}

TEST(the_judge_of_form_can_say_no)
{
    assert_true(well_formed("<?xml version=\"1.0\" ?>\n<A><B c=\"1\"/></A>\n"));
    assert_false(well_formed("<?xml version=\"1.0\" ?>\n<A><B c=\"1\"></A>\n"));
    assert_false(well_formed("<?xml version=\"1.0\" ?>\n<A><B></A></B>\n"));
    assert_false(well_formed("<?xml version=\"1.0\" ?>\n<A></A><A></A>\n"));
    assert_false(well_formed("<?xml version=\"1.0\" ?>\n<A><B c=\"1/></A>\n"));
    assert_false(well_formed("<?xml version=\"1.0\" ?>\n<A>"));
}

TEST(the_file_is_whole_after_each_snapshot)
{
    char name[64], part[520];
    snprintf(part, sizeof part, "%s.part", path);
    for (int dim = 2; dim <= 3; dim++) {
        struct xdmf *x = xdmf_create(path, false, 0);
        for (int k = 0; k < 6; k++) {
            add(x, k, 0.1 * k, dim);
            assert_true(well_formed(text()));
            assert_int_equal(count("<Time "), k + 1);
            assert_true(access(part, F_OK) != 0);
            for (int j = 0; j <= 6; j++) { /* position or topology aside, each file once a field */
                snprintf(name, sizeof name, ">sph_%06d.h5:/pressure<", j);
                assert_int_equal(count(name), j <= k);
            }
        }
        FREE(x);
    }
}

/* Order of axes is that of the data sets: x last. Nodes are one more than cells. */
TEST(entries_say_what_readers_need)
{
    struct xdmf *x = xdmf_create(path, false, 0);
    add(x, 1, 0.1, 2);
    assert_int_equal(count("\"2DSMesh\" Dimensions=\"5 9\""), 1);
    assert_int_equal(count("Dimensions=\"5 9 2\">sph_000001.h5:/vertices<"), 1);
    assert_int_equal(count("Center=\"Cell\""), 3);
    assert_int_equal(count("Dimensions=\"4 8\">sph_000001.h5:/pressure"), 1);
    assert_int_equal(count("Dimensions=\"4 8 2\">sph_000001.h5:/velocity"), 1);
    assert_int_equal(count("Dimensions=\"4 8 3\">sph_000001.h5:/force"), 1);
    assert_int_equal(count("Name=\"force\" AttributeType=\"Vector\""), 1);
    add(x, 3, 0.2, 3);
    assert_int_equal(count("\"3DCoRectMesh\" Dimensions=\"3 5 9\""), 1);
    assert_int_equal(count(">3 2 1<"), 1);
    assert_int_equal(count("Dimensions=\"2 4 8\">sph_000003.h5:/pressure"), 1);
    add(x, 4, 0.3, 2);
    assert_int_equal(count("NumberOfElements=\"1004\""), 1);
    assert_int_equal(count("\"XY\""), 2); /* the flat block above and the particles */
    assert_int_equal(count("Dimensions=\"1004 2\">sph_000004.h5:/position"), 1);
    assert_int_equal(count("Center=\"Node\""), 3);
    const double edges[] = {0, 1, 3, 6, 10};
    xdmf_block(x, 0.4, "fv_000001.h5", (const int[]){2, 4, 1}, (const double[]){-1, 0, 0},
               (const double[]){0.5, 4, 2}, edges, 1, fields + 1);
    assert_int_equal(count("\"3DRectMesh\" Dimensions=\"2 5 3\""), 1);
    assert_int_equal(count("Dimensions=\"3\">-1 -0.5 0<"), 1);
    assert_int_equal(count("Dimensions=\"5\">0 1 3 6 10<"), 1);
    assert_int_equal(count("Dimensions=\"2\">0 2<"), 1);
    FREE(x);
}

/* Restarted at entry `at', the file is at the end as if there had been no stop. */
TEST(a_restart_leaves_no_trace)
{
    static char whole[1 << 16];
    const double dt = 1.0 / 3.0;
    struct xdmf *x = xdmf_create(path, false, 0);
    for (int k = 0; k < 6; k++)
        add(x, k, k * dt, 2);
    FREE(x);
    snprintf(whole, sizeof whole, "%s", text());
    for (int at = 1; at < 5; at++) {
        x = xdmf_create(path, true, at * dt);
        add(x, at, at * dt, 2);
        assert_int_equal(count("<Time "), at + 1);
        assert_true(well_formed(text()));
        for (int k = at + 1; k < 6; k++)
            add(x, k, k * dt, 2);
        FREE(x);
        assert_string_equal(text(), whole);
    }
    x = xdmf_create(path, false, 5.0); /* a new run forgets */
    add(x, 0, 0.0, 2);
    assert_int_equal(count("<Time "), 1);
    FREE(x);
    unlink(path);
    x = xdmf_create(path, true, 5.0); /* nothing to keep */
    add(x, 0, 0.0, 2);
    assert_true(well_formed(text()));
    assert_int_equal(count("<Time "), 1);
    FREE(x);
}

void unit_begin(void) { path = unit_file("list.xdmf"); }
