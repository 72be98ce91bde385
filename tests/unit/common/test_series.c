/* test_series.c - rows of series.csv that a restart keeps and drops, and summary.json as nested
 * text. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include <unistd.h>

#include "../../../common/files/series.h"

static const char *path;
static const char *const columns[] = {"t [s]", "dt [s]", "Ma"};

/* The file at path; static buffer. */
static const char *text(void)
{
    static char all[4096];
    FILE *f = fopen(path, "r");
    assert_non_null(f);
    all[fread(all, 1, sizeof all - 1, f)] = '\0';
    fclose(f);
    return all;
}

/* Rows of t = dt, 2 dt, ... up to n, from `first' on. */
static void write_rows(bool keep, double t_restart, int first, int n, double dt)
{
    struct series *s = series_create(path, 3, 3, columns, keep, t_restart);
    for (int k = first; k <= n; k++)
        series_row(s, (double[]){k * dt, dt, 0.1 * k});
    FREE(s);
}

TEST(a_row_has_its_columns)
{
    write_rows(false, 0, 1, 2, 0.25);
    assert_string_equal(text(), "t [s],dt [s],Ma\n0.25,0.25,0.1\n0.5,0.25,0.2\n");
    write_rows(false, 0, 1, 1, 0.5); /* a new run begins anew */
    assert_string_equal(text(), "t [s],dt [s],Ma\n0.5,0.5,0.1\n");
}

TEST(amounts_are_per_metre_in_the_plane)
{
    static const char *const of[] = {"t [s]", "mass [kg]", "px [kg m/s]", "volume [m^dim]",
                                     "enstrophy [m^dim/s^2]"};
    for (int dim = 2; dim <= 3; dim++) {
        FREE(series_create(path, dim, 5, of, false, 0));
        assert_string_equal(text(), dim == 2 ? "t [s],mass [kg/m],px [N s/m],volume [m^2],"
                                               "enstrophy [m^2/s^2]\n"
                                             : "t [s],mass [kg],px [kg m/s],volume [m^3],"
                                               "enstrophy [m^3/s^2]\n");
    }
}

TEST(a_row_is_on_disk_at_once)
{
    struct series *s = series_create(path, 3, 3, columns, false, 0);
    series_row(s, (double[]){1, 2, 3});
    assert_string_equal(text(), "t [s],dt [s],Ma\n1,2,3\n");
    FREE(s);
}

/* Whatever was written after the restart file, the series goes on as if there had been no stop; dt
 * is no short decimal, so that the digits of the file are rounded. */
TEST(a_restart_leaves_no_trace)
{
    static char whole[4096];
    for (int at = 1; at < 40; at++) {
        const double dt = (at % 2 ? 2.0 : 1.0) / (3 * at);
        write_rows(false, 0, 1, 43, dt);
        snprintf(whole, sizeof whole, "%s", text());
        write_rows(true, at * dt, at + 1, 43, dt);
        assert_string_equal(text(), whole);
        write_rows(true, 43 * dt, 43, 43, dt); /* at the end nothing is left to do */
        assert_string_equal(text(), whole);
    }
}

/* A gauge more, before others, moves none of the old values to another column. */
TEST(a_restart_with_other_columns_keeps_values_by_name)
{
    static const char *const others[] = {"t [s]", "dt [s]", "P [Pa]", "Ma"};
    write_rows(false, 0, 1, 2, 0.25);
    struct series *s = series_create(path, 3, 4, others, true, 0.25);
    series_row(s, (double[]){0.5, 0.25, 7.0, 0.2});
    FREE(s);
    assert_string_equal(text(), "t [s],dt [s],P [Pa],Ma\n0.25,0.25,nan,0.1\n0.5,0.25,7,0.2\n");
    FREE(series_create(path, 3, 3, others, true,
                       0.25)); /* without Ma, whose values stay elsewhere */
    assert_string_equal(text(), "t [s],dt [s],P [Pa]\n0.25,0.25,nan\n");
    char before[600];
    snprintf(before, sizeof before, "%s.before-0.25", path);
    assert_int_equal(unlink(before), 0);
}

TEST(a_restart_without_an_old_file_begins_one)
{
    unlink(path);
    write_rows(true, 3.0, 1, 1, 0.5);
    assert_string_equal(text(), "t [s],dt [s],Ma\n0.5,0.5,0.1\n");
}

TEST(other_ranks_write_nothing)
{
    struct series *s = series_create(NULL, 3, 3, columns, false, 0);
    series_row(s, (double[]){1, 2, 3});
    FREE(s);
}

TEST(keys_with_dots_are_nested)
{
    struct summary *s = summary_create();
    summary_text(s, "status", "a \"b\" \\ c\n");
    summary_real(s, "errors.all", INFINITY); /* no member of error */
    summary_real(s, "error.velocity.l2", 0.125);
    summary_int(s, "steps", 9007199254740993LL);
    summary_real(s, "error.velocity.max", NAN);
    summary_real(s, "error.p", 2.0);
    summary_texts(s, "zones", 2, (const char *const[]){"one", "two"});
    summary_texts(s, "none", 0, NULL);
    summary_real(s, "error.p", -1e-30); /* replaces, in its place */
    summary_write(s, path);
    FREE(s);
    assert_string_equal(text(), "{\n"
                                "  \"status\": \"a \\\"b\\\" \\\\ c \",\n"
                                "  \"errors\": {\n"
                                "    \"all\": null\n"
                                "  },\n"
                                "  \"error\": {\n"
                                "    \"velocity\": {\n"
                                "      \"l2\": 0.125,\n"
                                "      \"max\": null\n"
                                "    },\n"
                                "    \"p\": -1e-30\n"
                                "  },\n"
                                "  \"steps\": 9007199254740993,\n"
                                "  \"zones\": [\"one\", \"two\"],\n"
                                "  \"none\": []\n"
                                "}\n");
}

static void count_numbers(void *ctx, const char *key, double v)
{
    char *seen = ctx;
    snprintf(seen + strlen(seen), 100 - strlen(seen), "%s=%g ", key, v);
}

TEST(numbers_are_found_and_listed_in_order)
{
    struct summary *s = summary_create();
    double v = -1;
    char seen[100] = "";
    summary_real(s, "b.x", 1.5);
    summary_text(s, "name", "3");
    summary_int(s, "a", 4);
    assert_true(summary_find(s, "b.x", &v) && v == 1.5);
    assert_true(summary_find(s, "a", &v) && v == 4.0);
    assert_false(summary_find(s, "name", &v));
    assert_false(summary_find(s, "b", &v));
    summary_each(s, count_numbers, seen);
    assert_string_equal(seen, "b.x=1.5 a=4 ");
    summary_real(s, "a", 0.5); /* now of another kind */
    summary_text(s, "b.x", "gone");
    summary_write(s, path);
    assert_false(summary_find(s, "b.x", &v));
    assert_string_equal(
        text(), "{\n  \"b\": {\n    \"x\": \"gone\"\n  },\n  \"name\": \"3\",\n  \"a\": 0.5\n}\n");
    FREE(s);
}

/* Eight bodies and 24 gauges of long names make a header of more than any buffer. */
TEST(a_long_header_survives_a_restart)
{
    enum { MANY = 200 };
    static char names[MANY][80];
    const char *list[MANY];
    double row[MANY];
    for (int k = 0; k < MANY; k++) {
        snprintf(names[k], sizeof names[k], "a gauge with a name that says where it stands: %d", k);
        list[k] = names[k];
        row[k] = k;
    }
    for (int again = 0; again < 2; again++) {
        struct series *s = series_create(path, 3, MANY, list, again, 0.0);
        row[0] = again; /* the time */
        series_row(s, row);
        FREE(s);
    }
    FILE *f = fopen(path, "r");
    int lines = 0, commas = 0;
    for (int c; (c = fgetc(f)) != EOF; lines += c == '\n')
        commas += c == ',';
    fclose(f);
    assert_int_equal(lines, 3); /* header, the row that was kept, the new one */
    assert_int_equal(commas, 3 * (MANY - 1));
}

void unit_begin(void) { path = unit_file("list.csv"); }
