/* unit.c - what all units share: the list of their tests, main, and a file of their own. All are
 * one program, since to link each takes as long as to run most of them. usage: [ALONE=1] units NAME
 * ALONE: of its tests those that do more on one rank.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "test.h"

#include <unistd.h>

static struct unit_test *all; /* of all units, by line */
static char file[512];

/* Keeps the order of the source, which constructors need not have. */
void unit_enlist(struct unit_test *t)
{
    struct unit_test **at = &all;
    while (*at && (*at)->line < t->line)
        at = &(*at)->next;
    t->next = *at;
    *at = t;
}

const char *unit_file(const char *name)
{
    const char *dir = getenv("TEST_SCRATCH");
    int id = (int)getpid();
    MPI_Bcast(&id, 1, MPI_INT, 0, MPI_COMM_WORLD);
    snprintf(file, sizeof file, "%s/unit %d %s", dir ? dir : P_tmpdir, id, name);
    return file;
}

/* One rank agrees with itself: of a unit that has other tests this one tells nothing there. */
static int leave_out_ranks(struct CMUnitTest *tests, int n)
{
    int kept = 0;
    for (int k = 0; k < n; k++)
        if (n == 1 || strcmp(tests[k].name, "ranks_agree") != 0)
            tests[kept++] = tests[k];
    return kept;
}

int main(int argc, char **argv)
{
    enum { MOST = 256 };
    struct CMUnitTest tests[MOST];
    void (*begin)(void) = NULL;
    int rank, n = 0;
    for (const struct unit_test *t = all; t && argc == 2; t = t->next)
        if (strcmp(t->unit, argv[1]) == 0 && n < MOST && (t->alone || !getenv("ALONE"))) {
            tests[n++] = (struct CMUnitTest){.name = t->name, .test_func = t->run};
            begin = t->begin;
        }
    if (n == 0 || n == MOST) {
        fprintf(stderr, "usage: %s NAME, of a unit of fewer than %d tests\n", argv[0], MOST);
        return 2;
    }
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (is_alone())
        n = leave_out_ranks(tests, n);
    if (begin)
        begin();
    const int failed = _cmocka_run_group_tests("tests", tests, (size_t)n, NULL, NULL);
    if (rank == 0 && file[0])
        unlink(file);
    MPI_Finalize();
    return failed;
}
