/* params_case.h - a small table of all kinds of keys, and cases read through it.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../test.h"

#include "../../../common/params/parameter_table.h"

enum { ITEMS = 3 };

struct box_case {
    double size, lo[3], hold[2][3];
    int count, cells[3], kind;
    bool on, axes[3];
    char name[PARAM_TEXT_SIZE];
};
struct item_case {
    double weight;
    int kind;
};
struct part {
    double x;
    char file[PARAM_TEXT_SIZE];
};
struct tree_case {
    double turn[3];
    struct param_numbers powers;
    struct parts {
        int n;
        struct part of[3];
    } parts, root;
};

#define P struct box_case
static const struct param box_rows[] = {
    PARAM(P, size, "m", NULL, 0.1, 10.0, "of the box"),
    PARAM(P, lo, "m", "(1.0, 2.0)", -5, 5, "corner"),
    PARAM(P, hold, "m", "((0, 0), (0, 0))", -5, 5, "part that is held"),
    PARAM(P, count, "-", "7", 1, 1e9, "of things"),
    PARAM(P, cells, "-", "(4, 4)", 1, 1000, "a side"),
    CHOICE(P, kind, "red|green|blue", "green", "of box"),
    PARAM(P, on, "-", "true", 0, 0, "whether it is"),
    PARAM(P, axes, "-", "(false, true)", 0, 0, "that are open"),
    PARAM(P, name, "-", "plain", 0, 0, "what it is called"),
};
#undef P
#define P struct item_case
static const struct param item_rows[] = {
    PARAM(P, weight, "kg", "2.5", 0, 100, "of an item"),
    CHOICE(P, kind, "soft|hard", "hard", "of item"),
};
#undef P

#define P struct part
static const struct param part_rows[] = {
    PARAM(P, x, "m", "0.5", 0, 9, "place of a part"),
    PARAM(P, file, "-", "", 0, 0, "of a part"),
};
#undef P
static const struct param_list parts_list = {
    part_rows, 2, sizeof(struct part), offsetof(struct parts, of), 3, "file"};
static const struct param_list root_list = {
    part_rows, 2, sizeof(struct part), offsetof(struct parts, of), 1, NULL};
#define P struct tree_case
static const struct param tree_rows[] = {
    TURN(P, turn, "rad", "0.0", -9, 9, "of a tree"),
    PARAM(P, powers, "-", "0.0", -9, 9, "of a tree"),
    LIST(P, parts, &parts_list, "parts of a tree"),
    LIST(P, root, &root_list, "root of a tree"),
};
#undef P

static struct box_case box;
static struct tree_case trees[2];
static int ntrees;
static struct item_case items[ITEMS];
static int nitems;
static bool has_box;
static const struct param_group groups[] = {
    {"box", "A box", box_rows, sizeof box_rows / sizeof *box_rows, &box, &has_box, 0, 0, NULL},
    {"items", "Items", item_rows, 2, items, NULL, sizeof items[0], ITEMS, &nitems},
    {"trees", "Trees", tree_rows, 4, trees, NULL, sizeof trees[0], 2, &ntrees},
};
static const char *const others[] = {"alien", "output", NULL};
static const char *path;
static int rank;

static inline void put_alone(const char *to, const char *text)
{
    FILE *f = fopen(to, "w");
    assert_non_null(f);
    fputs(text, f);
    fclose(f);
}

static inline void put(const char *to, const char *text)
{
    if (rank == 0)
        put_alone(to, text);
    MPI_Barrier(MPI_COMM_WORLD);
}

/* What was read of `text' with overrides, ended by NULL; the faults' text in *said (rank 0). */
static inline struct params *read_case(const char *text, const char *const *over, struct faults *f)
{
    int n = 0;
    while (over && over[n])
        n++;
    memset(&box, 0x5a, sizeof box);
    memset(items, 0, sizeof items);
    *f = (struct faults){0};
    put(path, text);
    struct params *p = params_read(MPI_COMM_WORLD, path, n, over, groups, 3, others, f);
    MPI_Barrier(MPI_COMM_WORLD);
    return p;
}

static inline void sound(const char *text, const char *const *over)
{
    struct faults f;
    struct params *p = read_case(text, over, &f);
    if (f.n)
        fail_msg("%d faults: %s", f.n, f.text ? f.text : "");
    params_free(&p);
    mem_free(f.text);
}

/* That many faults, each of the words in their text. */
static inline void faulty(const char *text, const char *const *over, int n,
                          const char *const *words)
{
    struct faults f;
    struct params *p = read_case(text, over, &f);
    if (f.n != n)
        fail_msg("%d faults, wanted %d: %s", f.n, n, f.text ? f.text : "");
    for (int k = 0; rank == 0 && words[k]; k++)
        if (!strstr(f.text, words[k]))
            fail_msg("no `%s' in: %s", words[k], f.text);
    params_free(&p);
    mem_free(f.text);
}
#define FAULTY(text, n, ...) faulty(text, NULL, n, (const char *const[]){__VA_ARGS__, NULL})
#define WITH(...) ((const char *const[]){__VA_ARGS__, NULL})

void unit_begin(void)
{
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    path = unit_file("case.cfg");
}
