/* test_params_text.c - keys from the command line, the hash of a case, and its text, which can be
 * read again. ranks: 1 2. SPDX-License-Identifier: BSD-3-Clause */
#include "params_case.h"

#include <unistd.h>

TEST(the_command_line_goes_before_the_file)
{
    const char *text = "box: { size = 1; kind = \"red\"; };";
    sound(text,
          WITH("box.size=2", "box.size=0.5", "box.cells=64x32", "box.kind=blue", "box.on=false",
               "box.name=out of here", "box.lo=(3,4)", "box.hold=((1,1),(2,2))"));
    assert_close(box.size, 0.5, 0); /* the last one counts */
    assert_int_equal(box.cells[0] + 1000 * box.cells[1] + 1000000 * box.cells[2], 1032064);
    assert_int_equal(box.kind, 2);
    assert_false(box.on);
    assert_string_equal(box.name, "out of here");
    assert_close(box.lo[0] + 10 * box.lo[1], 43.0, 0);
    assert_close(box.hold[0][0] + 10 * box.hold[1][1], 21.0, 0);
    sound(text, WITH("box.cells=2x3x4"));
    assert_int_equal(box.cells[0] + 10 * box.cells[1] + 100 * box.cells[2], 432);
    sound("alien: { };", WITH("box.size=2")); /* makes the group */
    assert_true(has_box);
    faulty(text, WITH("box.size=99", "box.sice=1", "bix.size=1", "box", "box.=1", "alien.x=1"), 5,
           WITH("command line: -p box.size=99: box.size: ",
                "-p box.sice=1: box.sice: unknown key; did you mean `size'",
                "-p bix.size=1: bix.size: unknown group; did you mean `box'", "GROUP.KEY=VALUE"));
    faulty("alien: { };", WITH("box.count=3"), 1, WITH("box.size: must be given"));
    faulty(text, WITH("box.count=4294967299"), 1, WITH("-p box.count=4294967299: "));
}

/* "walls.[0].kind" is how messages name a key: so it can be given, too. */
TEST(the_command_line_reaches_into_lists)
{
    const char *text =
        "items: ({ weight = 1; }, { weight = 3; });\n"
        "trees: ({ }, { parts = ({ x = 1; file = \"a\"; }, { x = 2; }); root = { x = 3; }; });\n";
    sound(text, WITH("items.[1].weight=4", "items.[0].kind=soft", "trees.[1].parts.[1].x=5",
                     "trees.[1].parts.[0].file=b", "trees.[1].root.x=6"));
    assert_close(items[0].weight + 10 * items[1].weight, 41.0, 0);
    assert_int_equal(items[0].kind + 10 * items[1].kind, 10);
    assert_int_equal(trees[1].parts.n, 2);
    assert_close(trees[1].parts.of[0].x + 10 * trees[1].parts.of[1].x, 51.0, 0);
    assert_string_equal(trees[1].parts.of[0].file, "b");
    assert_close(trees[1].root.of[0].x, 6.0, 0);
    faulty(text,
           WITH("items.[2].weight=4", "items.[0].wait=4", "trees.[0].parts.[0].x=1",
                "items.weight=1", "items.[1].weight=999", "items.[1].kind=firm"),
           6,
           WITH("-p items.[2].weight=4: items.[2].weight: no such element",
                "-p items.[0].wait=4: items.[0].wait: no such", "elements count from 0",
                "-p trees.[0].parts.[0].x=1: trees.[0].parts.[0].x: no such",
                "-p items.weight=1: items.weight: no such",
                "-p items.[1].weight=999: items.[1].weight: 999 is not allowed"));
}

/* A list or a group as a whole, of any depth, in place of the file's or where it has none. */
TEST(the_command_line_gives_whole_lists)
{
    const char *text = "items: ({ weight = 1; }, { weight = 3; }); box: { size = 1; };\n";
    sound(text, WITH("items=()"));
    assert_int_equal(nitems, 0);
    sound(text, WITH("items=({ weight = 7; kind = \"soft\"; })", "items.[0].weight=8",
                     "box={ size = 2; lo = (3, 4.5); on = false; }"));
    assert_int_equal(nitems, 1);
    assert_close(items[0].weight + 10 * items[0].kind, 8.0, 0); /* soft: 0 */
    assert_close(box.size + box.lo[0] + box.lo[1], 9.5, 0);
    assert_false(box.on);
    sound("box: { size = 1; };", WITH("trees=({ parts = ({ x = 1; file = \"a\"; }); })"));
    assert_close(trees[0].parts.of[0].x, 1.0, 0);
    faulty(text,
           WITH("itms=()", "items=5", "box={ size = 99; sice = 1; }", "items=({ wait = 1; })"), 5,
           WITH("-p itms=(): itms: unknown group; did you mean `items'", "GROUP.KEY=VALUE",
                "command line: box.size: 99 is not allowed", "command line: box.sice: unknown key",
                "command line: items.wait: unknown key"));
}

static unsigned long long hash(const char *text, const char *const *over)
{
    struct faults f;
    struct params *p = read_case(text, over, &f);
    unsigned long long h = params_hash(p), h0 = h;
    MPI_Bcast(&h0, 1, MPI_UNSIGNED_LONG_LONG, 0, MPI_COMM_WORLD);
    assert_int_equal(f.n, 0);
    assert_true(h == h0);
    params_free(&p);
    mem_free(f.text);
    return h;
}

TEST(the_hash_is_of_the_case_and_not_of_its_output)
{
    char included[600];
    snprintf(included, sizeof included, "%.*spart.inc", (int)(strrchr(path, '/') + 1 - path), path);
    const char *a = "box: { size = 1.0000000001; };", *b = "box: { size = 1.0000000002; };";
    const char *c = "box: {\n@include \"part.inc\"\n};";
    assert_true(hash(a, NULL) == hash(a, NULL));
    assert_true(hash(a, NULL) != hash(b, NULL));
    assert_true(hash(a, NULL) != hash(a, WITH("box.size=2")));
    assert_true(hash(a, WITH("box.size=3")) != hash(a, WITH("box.size=2")));
    assert_true(hash(a, NULL) == hash(a, WITH("output.every=2")));
    put(included, "size = 1.0;\n");
    const unsigned long long one = hash(c, NULL);
    put(included, "size = 2.0;\n");
    assert_true(hash(c, NULL) != one); /* included text belongs to the case */
    MPI_Barrier(MPI_COMM_WORLD);
    unlink(included);
}

TEST(the_text_of_a_case_can_be_read_again)
{
    struct faults f;
    struct params *p = read_case(
        "box: { size = 0.1000000000000001; hold = ((-1, 0.3), (1, 2)); axes = (true, true);\n"
        "  name = \"a \\\"b\\\" c\\\\d\"; };\nitems: ( { weight = 3; }, { kind = \"soft\"; } );",
        WITH("box.cells=6x7"), &f);
    const struct box_case wanted = box;
    const struct item_case wanted_items[2] = {items[0], items[1]};
    char *text = rank == 0 ? params_text(p) : NULL;
    assert_int_equal(f.n, 0);
    assert_true(!text || strstr(text, "size = 0.1000000000000001;")); /* 16 digits are needed */
    assert_true(!text || !strstr(text, "0.2999"));                    /* of 0.3 one */
    params_free(&p);
    sound(text ? text : "", NULL);
    assert_memory_equal(&box.size, &wanted.size, sizeof box.size);
    assert_memory_equal(box.hold, wanted.hold, sizeof box.hold);
    assert_memory_equal(box.lo, wanted.lo, sizeof box.lo);
    assert_memory_equal(box.cells, wanted.cells, sizeof box.cells);
    assert_memory_equal(box.axes, wanted.axes, sizeof box.axes);
    assert_int_equal(box.kind, wanted.kind);
    assert_string_equal(wanted.name, "a \"b\" c\\d");
    assert_string_equal(box.name, wanted.name);
    assert_int_equal(nitems, 2);
    for (int k = 0; k < 2; k++) {
        assert_close(items[k].weight, wanted_items[k].weight, 0);
        assert_int_equal(items[k].kind, wanted_items[k].kind);
    }
    mem_free(text);
}

TEST(a_given_key_that_is_not_used_is_a_fault)
{
    struct faults f;
    struct params *p = read_case("box: {\n  size = 1;\n};\nitems: ( { weight = 3; }, { kind = "
                                 "\"soft\"; weight = 2.5; } );",
                                 WITH("box.count=2"), &f);
    assert_true(params_given(p, "box.size"));
    assert_true(params_given(p, "box.count"));
    assert_false(params_given(p, "box.cells"));
    assert_false(params_given(p, "items.[0].kind"));
    assert_true(params_given(p, "items.[1].kind"));
    params_unused(p, &f, "box.size", true, "-");
    params_unused(p, &f, "box.cells", false, "-");
    assert_int_equal(f.n, 0);
    params_unused(p, &f, "box.count", false, "nothing is counted");
    params_unused(p, &f, "items.[1].kind", false, "all are soft");
    params_unused(p, &f, "items.[1].weight", false, "2.5 is the default");
    assert_int_equal(f.n, 2);
    assert_true(params_on_command_line(p, "box.count"));
    assert_false(params_on_command_line(p, "box.size"));
    if (rank == 0) {
        assert_non_null(strstr(f.text, "box.count: is not used: nothing is counted\n"));
        assert_non_null(strstr(f.text, ".cfg:4: items.[1].kind: is not used: all are soft\n"));
    }
    params_free(&p);
    mem_free(f.text);
}

TEST(the_default_asks_for_nothing)
{
    struct faults f;
    struct params *p =
        read_case("box: { size = 1; lo = (1, 2); cells = (4, 4); kind = \"green\"; on "
                  "= true; axes = (false, true); name = \"plain\"; };\n"
                  "items: ( { weight = 2.5; kind = \"soft\"; } );",
                  WITH("box.count=7"), &f);
    static const char *const same[] = {"box.lo",   "box.cells", "box.kind",  "box.on",
                                       "box.axes", "box.name",  "box.count", "items.[0].weight"};
    for (int k = 0; k < 8; k++) {
        assert_true(params_given(p, same[k]));
        params_unused(p, &f, same[k], false, "-");
    }
    assert_int_equal(f.n, 0);
    params_unused(p, &f, "items.[0].kind", false, "-");
    assert_int_equal(f.n, 1);
    params_free(&p);
    mem_free(f.text);
}

TEST(a_fault_between_keys_stands_at_its_key)
{
    struct faults f;
    struct params *p = read_case("box: {\n  size = 1;\n  count = 3;\n};", WITH("box.size=2"), &f);
    params_fault(p, &f, "box.count", "too %s", "few");
    params_fault(p, &f, "box.size", "too small");
    assert_int_equal(f.n, 2);
    if (rank == 0) {
        assert_non_null(strstr(f.text, ".cfg:3: box.count: too few\n"));
        assert_non_null(strstr(f.text, "command line: -p box.size=2: box.size: too small\n"));
    }
    params_free(&p);
    mem_free(f.text);
    f.text = NULL;
    p = params_read(MPI_COMM_WORLD, "there/is no/such.cfg", 0, NULL, groups, 2, others, &f);
    assert_int_equal(f.n, 3);
    assert_true(rank > 0 || strstr(f.text, "there/is no/such.cfg: "));
    params_free(&p);
    mem_free(f.text);
}

/* Numbers by expressions of the variables of group `let', in vectors, lists and on the command
 * line. */
TEST(numbers_are_expressions_of_variables)
{
    const char *text =
        "let: { H = 0.3; n = 30; dx = \"H/n\"; };\n"
        "box: { size = \"100*dx\"; lo = (\"-H\", 2); count = \"H/0.1\"; name = \"H\"; };\n"
        "items: ( { weight = \"sqrt(n+6)\"; }, { weight = \"2*pi\"; } );\n"
        "alien: { x = \"H\"; };";
    struct faults f;
    struct params *p = read_case(text, NULL, &f);
    double v[3];
    assert_int_equal(f.n, 0);
    assert_close(box.size, 1.0, 1e-15);
    assert_close(box.lo[0], -0.3, 0);
    assert_int_equal(box.count, 3); /* though 0.3/0.1 is 2.9999999999999996 */
    assert_string_equal(box.name, "H");
    assert_close(items[0].weight, 6.0, 1e-15);
    assert_close(items[1].weight, 2.0 * acos(-1.0), 1e-15);
    assert_true(params_peek(p, MPI_COMM_WORLD, "alien.x", v)); /* of another program's group */
    assert_close(v[0], 0.3, 0);
    char *print = rank == 0 ? params_text(p) : NULL;
    assert_true(rank > 0 || strstr(print, "# let: H = 0.3, n = 30, dx = 0.01\n"));
    params_free(&p);
    sound(print ? print : "", NULL); /* all numbers are plain in it */
    assert_close(box.size, 1.0, 1e-15);
    mem_free(print);
    sound(text, WITH("let.n=60", "let.H=2*0.3", "items.[0].weight=n/H"));
    assert_close(box.size, 1.0, 1e-15);
    assert_close(items[0].weight, 100.0, 1e-15);
    assert_true(hash(text, NULL) != hash(text, WITH("let.n=60")));
}

TEST(a_fault_of_an_expression_says_what_is_known)
{
    FAULTY("let: { Hight = 0.3;\n  dx = \"Hihgt/3\"; };\nbox: { size = 1; };", 1,
           ".cfg:2: let.dx: `Hihgt' in \"Hihgt/3\" is not known: did you mean `Hight'?; known "
           "here: Hight\n");
    FAULTY("let: { H = 0.3; };\nbox: { size = \"H/k\"; count = \"H\"; lo = (\"H+\", 1); };", 3,
           ".cfg:2: box.size: expected a plain number in m or an expression: `k' in \"H/k\" is not "
           "known",
           "known here: H\n", "box.count: 0.3 is not a whole number",
           "box.lo: expected a plain number in m or an expression: \"H+\" is no expression: ");
    FAULTY("let: { H = 0.3;\n  g = 1; };\nbox: { size = \"H\"; };", 1,
           ".cfg:2: let.g: is not used: no expression names this variable");
    FAULTY("let: { H = true; a = \"b\"; b = 1; pi = 3; };\nbox: { size = 1; };", 3,
           "let.H: expected a number or an expression", "let.a: `b' in \"b\" is not known",
           "let.pi: is the name of a function or a constant");
    FAULTY("let: ( 1, 2 );\nbox: { size = \"1/0\"; };", 2, "cfg:1: let: expected a group",
           "box.size: expected a plain number in m or an expression: \"1/0\" is inf");
    FAULTY("box: { size = \"H\"; };", 1, "`H' in \"H\" is not known; no variable is defined");
    faulty("let: { H = 1; };\nbox: { size = \"H\"; };", WITH("let.h=3"), 1,
           WITH("-p let.h=3: let.h: no such variable in the case; known here: H\n"));
}
