/* test_params_use.c - a key that a run does not use is a fault, with the reason of its row; in a
 * list of a list, too. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../common/params/params_use.h"

enum { FACT_WET, FACT_DEEP };
enum form { FORM_ROUND, FORM_SQUARE, FORM_FLAT };
#define WORDS_WET "water"
#define WORDS_DEEP "depth"

static struct thing {
    int form;
    double radius, edge, at[3], pair[3], draught;
    bool hollow;
    char file[PARAM_TEXT_SIZE], other[PARAM_TEXT_SIZE];
    struct marks {
        int n;
        struct mark {
            double size, weight;
        } of[2];
    } marks;
} thing;

static bool is_light(const void *limit, const void *element)
{
    return ((const struct mark *)element)->weight < *(const double *)limit;
}

/* clang-format off */
#define P struct mark
static const struct param mark_rows[] = {
    PARAM(P, size, "m", "0.0", 0, 9, "of a mark", USED(WHERE(is_light, "a light mark", "it is heavy"))),
    PARAM(P, weight, "kg", "0.0", 0, 9, "of a mark"),
};
#undef P
static const struct param_list mark_list = {
    mark_rows, 2, sizeof(struct mark), offsetof(struct marks, of), 2, NULL};
#define P struct thing
static const struct param rows[] = {
    CHOICE(P, form, "round|square|flat", "round", "of the thing"),
    PARAM(P, radius, "m", "1.0", 0, 9, "of it", USED(ONLY(form, ONE(FORM_ROUND), "it is not round"))),
    PARAM(P, edge, "m", "1.0", 0, 9, "of it",
          USED(ONLY(form, ~ONE(FORM_ROUND), "it is round"), WITHOUT(hollow, "it is hollow"))),
    PARAM(P, at, "m", "(0.0, 0.0)", -9, 9, "place", USED(WITH(file, "no file"))),
    PARAM(P, pair, "-", "(0.0, 0.0)", -9, 9, "two numbers", .numbers = 2),
    PARAM(P, draught, "m", "0.0", 0, 9, "of it",
          USED(NEED_ANY(WET, DEEP, "it is dry"), NEED_OR_ONLY(DEEP, form, ONE(FORM_FLAT), "shallow"))),
    PARAM(P, hollow, "-", "false", 0, 0, "or not"),
    PARAM(P, file, "-", "", 0, 0, "of it"),
    PARAM(P, other, "-", "", 0, 0, "of it", USED(WITH(file, "no first file"))),
    LIST(P, marks, &mark_list, "on it", USED(WITHOUT(hollow, "hollow things have none"))),
};
#undef P
/* clang-format on */
static const struct param_group group = {
    "thing", "A thing", rows, sizeof rows / sizeof rows[0], &thing, NULL, 0, 0, NULL};
static const char *path;

/* Reads the case and asks all conditions: n faults are expected, the first of which has the text.
 */
static void faulty(const char *text, unsigned long long facts, int n, const char *expected)
{
    struct faults f = {0};
    const double limit = 3.0;
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "thing: { %s };\n", text);
    fclose(file);
    struct params *p = params_read(MPI_COMM_SELF, path, 0, NULL, &group, 1, NULL, &f);
    assert_int_equal(f.n, 0);
    params_check_use(p, &group, 1, NULL, &limit, &f);
    params_check_use(p, &group, 1, &facts, &limit, &f);
    params_check_plane(p, &group, 1, &f);
    assert_int_equal(f.n, n);
    assert_true(n == 0 || strstr(f.text, expected));
    mem_free(f.text);
    params_free(&p);
}

TEST(choices_and_keys_of_the_group)
{
    faulty("radius = 2; at = (1, 1); file = \"a\"; other = \"b\";", 0, 0, "");
    faulty("form = \"flat\"; radius = 2;", 0, 1, "thing.radius: is not used: it is not round");
    faulty("form = \"flat\"; radius = 1;", 0, 0, ""); /* the default, which is so */
    faulty("form = \"square\"; edge = 2;", 0, 0, "");
    faulty("edge = 2; hollow = true;", 0, 1, "thing.edge: is not used: it is round");
    faulty("form = \"flat\"; edge = 2; hollow = true;", 0, 1, "is not used: it is hollow");
    faulty("at = (1, 1);", 0, 1, "thing.at: is not used: no file");
    faulty("other = \"b\";", 0, 1, "thing.other: is not used: no first file");
}

TEST(facts_of_the_run)
{
    faulty("draught = 1;", 0, 1, "thing.draught: is not used: it is dry");
    faulty("draught = 1;", FACT(WET), 1, "is not used: shallow");
    faulty("draught = 1; form = \"flat\";", FACT(WET), 0, "");
    faulty("draught = 1;", FACT(DEEP), 0, "");
}

TEST(lists_in_a_group_and_the_plane)
{
    faulty("marks = ( { size = 1; }, { size = 1; weight = 4; } );", 0, 1,
           "thing.marks.[1].size: is not used: it is heavy");
    faulty("hollow = true; marks = ( { size = 1; weight = 4; } );", 0, 1, "hollow things have");
    faulty("file = \"a\"; at = (1, 1, 2);", 0, 1, "thing.at: z component 2 in a case of 2");
    faulty("pair = (1, 1);", 0, 0, "");
}

static const char *words(const char *key)
{
    for (int k = 0; k < group.nrows; k++)
        if (strcmp(rows[k].key, key) == 0)
            return params_use_words(rows, group.nrows, rows + k);
    return "no such key";
}

TEST(the_manual_has_them_in_words)
{
    assert_string_equal(words("form"), "");
    assert_string_equal(words("radius"), "form = round");
    assert_string_equal(words("edge"), "form other than round; without hollow");
    assert_string_equal(words("at"), "with file");
    assert_string_equal(words("draught"), "water or depth; depth or form = flat");
}

void unit_begin(void) { path = unit_file("use.cfg"); }
