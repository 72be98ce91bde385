/* test_outline.c - corners from CSV files and SVG drawings: rows and names, closed or not, the page
 * turned upright, curves by chords, relative and absolute commands alike, one path of several; what
 * cannot be read says why. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../common/geometry/outline.h"

static char path[512], why[256];

static const char *scratch(void)
{
    const char *dir = getenv("TEST_SCRATCH");
    return dir ? dir : "/tmp";
}

static bool read_text(const char *name, const char *id, const char *text, int most,
                      struct outline *is)
{
    char file[600];
    snprintf(path, sizeof path, "%s/%s", scratch(), name);
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    fputs(text, f);
    fclose(f);
    snprintf(file, sizeof file, "%s%s", path, id);
    return outline_read(file, most, false, is, why, sizeof why);
}

static bool read_path(const char *d, struct outline *is)
{
    char text[1000];
    snprintf(text, sizeof text, "<svg viewBox=\"0 0 10 8\"><g><path id='p' d='%s'/></g></svg>", d);
    return read_text("p.svg", "", text, 400, is);
}

static double area(const struct outline *is)
{
    double sum = 0.0;
    for (int k = 0; k < is->n; k++) {
        const double *a = is->x[k], *b = is->x[(k + 1) % is->n];
        sum += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
    return sum;
}

TEST(rows_are_corners)
{
    struct outline is;
    assert_true(read_text("a.csv", "", "# bed\nx, y\n0, 1\n2;1\n4 1\n\n4,3\n", 400, &is));
    assert_int_equal(is.n, 3); /* the one between two others is left out */
    assert_false(is.closed);
    assert_close(is.x[2][1], 3.0, 0.0);
    mem_free(is.x);
    assert_true(read_text("b.csv", "", "0,0\n1,0\n1,1\n0,0\n", 400, &is));
    assert_int_equal(is.n, 3);
    assert_true(is.closed);
    mem_free(is.x);
    assert_false(read_text("c.csv", "", "0,0\n1,0\none,1\n", 400, &is));
    assert_non_null(strstr(why, "line 3 is no row of x, y"));
    assert_false(read_text("d.csv", "", "x,y\n", 400, &is));
    assert_false(outline_read("/nowhere/e.csv", 400, false, &is, why, sizeof why));
    assert_non_null(strstr(why, "cannot be read"));
}

/* The page's lower left corner is the origin. */
TEST(drawings_stand_upright)
{
    struct outline is;
    assert_true(read_path("M 1 8 H 4 V 6 L 1,6 Z", &is));
    assert_true(is.closed);
    assert_int_equal(is.n, 4);
    assert_close(is.x[0][1], 0.0, 1e-12);
    assert_close(is.x[2][1], 2.0, 1e-12);
    assert_close(fabs(area(&is)), 6.0, 1e-12);
    mem_free(is.x);
    assert_true(read_path("m1 8h3v-2l-3,0z", &is));
    assert_close(fabs(area(&is)), 6.0, 1e-12);
    mem_free(is.x);
}

/* A circle by arcs and by cubics, a parabola, both by smooth continuation, too. */
TEST(curves_are_followed)
{
    struct outline is;
    assert_true(read_path("M 7 4 A 2 2 0 1 1 3 4 A 2 2 0 1 1 7 4 Z", &is));
    assert_close(fabs(area(&is)), 4.0 * M_PI, 0.03);
    assert_true(is.n > 20 && is.n < 120);
    mem_free(is.x);
    /* flags without blanks, and an arc to where the pen stands, which is none */
    assert_true(read_path("M7 4a2 2 0 11-4 0a2 2 0 0 0 0 0a2 2 0 114 0z", &is));
    assert_close(fabs(area(&is)), 4.0 * M_PI, 0.03);
    mem_free(is.x);
    assert_true(
        read_path("M7 4c0 1.1046-0.8954 2-2 2s-2-0.8954-2-2s0.8954-2 2-2s2 0.8954 2 2z", &is));
    assert_close(fabs(area(&is)), 4.0 * M_PI, 0.04);
    mem_free(is.x);
    assert_true(read_path("M 0 0 Q 2 4 4 0 T 8 0 L 8 8 L 0 8 Z", &is)); /* hump and hollow */
    assert_close(fabs(area(&is)), 64.0, 0.1);
    mem_free(is.x);
}

TEST(many_corners_become_few)
{
    static char text[100000];
    struct outline is;
    size_t n = 0;
    for (int k = 0; k < 2000; k++)
        n += (size_t)snprintf(text + n, sizeof text - n, "%.9g,%.9g\n", cos(M_PI * k / 1000.0),
                              sin(M_PI * k / 1000.0));
    assert_true(read_text("many.csv", "", text, 100, &is));
    assert_true(is.n <= 100 && is.n > 50);
    assert_close(area(&is), M_PI, 0.01);
    mem_free(is.x);
}

TEST(one_path_of_several)
{
    static const char text[] = "<svg height=\"8\"><path d=\"M 0 0 L 1 0 L 1 1 Z\" id=\"a\"/>"
                               "<polygon points=\"0,0 2,0 2,2 0,2\" id=\"b\"/></svg>";
    struct outline is;
    assert_true(read_text("two.svg", "#b", text, 400, &is));
    assert_int_equal(is.n, 4);
    assert_true(is.closed);
    mem_free(is.x);
    assert_false(read_text("two.svg", "#c", text, 400, &is));
    assert_non_null(strstr(why, "no path, polygon or polyline of the id c"));
    assert_false(read_path("M 0 0 L 1", &is));
    assert_non_null(strstr(why, "a number is missing"));
    assert_false(read_path("M 0 0 L 1 0 M 2 2 L 3 3", &is));
    assert_false(read_path("M 0 0 H 1 V 1 Z M 2 2 H 3 V 3 Z", &is));
    assert_non_null(strstr(why, "behind Z"));
    assert_true(read_path("M 0 0 H 1 V 1 Z z ", &is));
    mem_free(is.x);
    assert_false(read_text("t.svg", "",
                           "<svg height='8'><path transform='scale(2)' d='M 0 0 L 1 1'/></svg>",
                           400, &is));
    assert_non_null(strstr(why, "transform"));
}
