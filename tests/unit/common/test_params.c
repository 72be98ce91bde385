/* test_params.c - the parameter table: defaults, values of all kinds, ranges, all faults at once.
 * ranks: 1 2. SPDX-License-Identifier: BSD-3-Clause */
#include "params_case.h"

TEST(defaults_fill_what_is_not_given)
{
    sound("format = 1;\nbox: { size = 3; };\nalien: { anything = 1; };\n", NULL);
    assert_close(box.size, 3.0, 0);
    assert_close(box.lo[0] + 10 * box.lo[1] + 100 * box.lo[2], 21.0, 0);
    assert_int_equal(box.count, 7);
    assert_int_equal(box.cells[0] * box.cells[1], 16);
    assert_int_equal(box.cells[2], 1);
    assert_int_equal(box.kind, 1);
    assert_true(box.on && !box.axes[0] && box.axes[1] && !box.axes[2]);
    assert_string_equal(box.name, "plain");
    assert_int_equal(nitems, 0);
    assert_true(has_box);
}

TEST(values_of_every_kind_are_read)
{
    sound("box: { size = 0.25; lo = (-1, 2.5, 3); hold = ((-1, -2), (1, 2)); count = 12; cells = "
          "(3, 5, 7);\n"
          "  kind = \"blue\"; on = false; axes = (true, false, true); name = \"a ü b\"; };\n"
          "items: ( { weight = 1; }, { kind = \"soft\"; } );\n",
          NULL);
    assert_close(box.size, 0.25, 0);
    assert_close(box.lo[0] + 10 * box.lo[1] + 100 * box.lo[2], 324.0, 0);
    assert_close(box.hold[0][0] + 10 * box.hold[0][1] + 100 * box.hold[0][2], -21.0, 0);
    assert_close(box.hold[1][0] + 10 * box.hold[1][1] + 100 * box.hold[1][2], 21.0, 0);
    assert_int_equal(box.count, 12);
    assert_int_equal(box.cells[0] + 10 * box.cells[1] + 100 * box.cells[2], 753);
    assert_int_equal(box.kind, 2);
    assert_true(!box.on && box.axes[0] && !box.axes[1] && box.axes[2]);
    assert_string_equal(box.name, "a ü b");
    assert_int_equal(nitems, 2);
    assert_close(items[0].weight + 10 * items[1].weight, 26.0, 0);
    assert_int_equal(items[0].kind + 10 * items[1].kind, 1);
}

TEST(ends_of_a_range_are_allowed_and_no_more)
{
    sound("box: { size = 0.1; };", NULL);
    sound("box: { size = 10; count = 1000000000L; };", NULL);
    FAULTY("box: { size = 0.0999; };", 1, ":1: box.size: ", "0.1", "10", " m");
    FAULTY("box: { size = 10.001; };", 1, ":1: box.size: ");
    FAULTY("box: {\nsize = 1;\nlo = (0, 6); };", 1, ":3: box.lo: ", "-5");
    FAULTY("box: { size = 1; hold = ((0, 0), (0, 9)); };", 1, "box.hold: ");
    FAULTY("box: { size = 1; count = 1.5; };", 1, "box.count: ", "whole");
    FAULTY("box: { size = 1; lo = (1); };", 1, "box.lo: ", "two or three");
    FAULTY("box: { size = 1; axes = (1, 0); };", 1, "box.axes: ", "true or false");
    FAULTY("items: ( {}, {}, {}, {} );", 1, ":1: items", "3");
}

/* Lists of groups within a group, one group within it, and a text for a list of one. */
TEST(groups_within_groups)
{
    struct faults f;
    struct params *p =
        read_case("trees: ( { turn = 2; powers = (1, 2, 3); parts = ( { x = 3; }, {} ); "
                  "root = { x = 4; }; }, { turn = (1, 2, 3); powers = 7; parts = \"a b\"; } );\n",
                  NULL, &f);
    assert_int_equal(f.n, 0);
    assert_close(trees[0].turn[0] + trees[0].turn[1] + 10 * trees[0].turn[2], 20.0, 0);
    assert_close(trees[1].turn[0] + 10 * trees[1].turn[1] + 100 * trees[1].turn[2], 321.0, 0);
    assert_int_equal(trees[0].powers.n * 10 + trees[1].powers.n, 31);
    assert_close(trees[0].powers.v[2] + trees[1].powers.v[0], 10.0, 0);
    assert_int_equal(trees[0].parts.n * 10 + trees[1].parts.n, 21);
    assert_close(trees[0].parts.of[0].x + 10 * trees[0].parts.of[1].x, 8.0, 0);
    assert_int_equal(trees[0].root.n * 10 + trees[1].root.n, 10);
    assert_close(trees[0].root.of[0].x, 4.0, 0);
    assert_string_equal(trees[1].parts.of[0].file, "a b");
    assert_true(params_given(p, "trees.[0].parts.[0].x"));
    assert_false(params_given(p, "trees.[0].parts.[1].x"));
    assert_true(params_given(p, "trees.[0].root.x"));
    const struct tree_case before = trees[0];
    char *text = rank == 0 ? params_text(p) : NULL;
    params_free(&p);
    if (rank == 0)
        put_alone(path, text); /* what is written can be read */
    MPI_Barrier(MPI_COMM_WORLD);
    p = params_read(MPI_COMM_WORLD, path, 0, NULL, groups, 3, others, &f);
    if (f.n)
        fail_msg("%s in %s", f.text, text);
    assert_true(memcmp(&before, &trees[0], sizeof before) == 0);
    params_free(&p);
    mem_free(text);
    FAULTY("trees: ( { parts = ( { y = 3; } ); } );", 1, "trees.[0].parts.y: unknown key");
    FAULTY("trees: ( { parts = ( { x = 10; } ); } );", 1, "trees.[0].parts.x: 10 is not allowed");
    FAULTY("trees: ( { parts = ( {}, {}, {}, {} ); } );", 1, "trees.[0].parts: ", "at most 3");
    FAULTY("trees: ( { root = ( {} ); } );", 1, "trees.[0].root: expected a group");
}

TEST(all_faults_are_found_at_once)
{
    FAULTY("format = 2;\nbox: {\n  sise = 1;\n  kind = \"grey\";\n};\nbxo: { };\nitems: ( { weigth "
           "= 1; } );\n",
           5, ".cfg:1: format: ", ".cfg:3: box.sise: unknown key; did you mean `size'",
           ".cfg:4: box.kind: ", "red|green|blue", ".cfg:6: bxo: unknown group; did you mean `box'",
           ".cfg:7: items.weigth: unknown key; did you mean `weight'");
    FAULTY("box: { size = 1; zzzzzzzz = 1; };", 1, "box.zzzzzzzz: unknown key");
}
