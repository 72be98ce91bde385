/* unit.c - what all units share: the list of their tests, main, and a file of their own.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "test.h"

#include <unistd.h>

static struct {
    struct CMUnitTest test;
    int line;
} list[64];
static int n;
static char file[512];

/* Keeps the order of the source, which constructors need not have. */
void unit_enlist(const char *name, CMUnitTestFunction test, int line)
{
    int at = n++;
    if (n > (int)(sizeof list / sizeof *list))
        abort();
    for (; at > 0 && list[at - 1].line > line; at--)
        list[at] = list[at - 1];
    list[at].test = (struct CMUnitTest){.name = name, .test_func = test};
    list[at].line = line;
}

const char *unit_file(const char *name)
{
    const char *dir = getenv("TEST_SCRATCH");
    int id = (int)getpid();
    MPI_Bcast(&id, 1, MPI_INT, 0, MPI_COMM_WORLD);
    snprintf(file, sizeof file, "%s/unit %d %s", dir ? dir : P_tmpdir, id, name);
    return file;
}

__attribute__((weak)) void unit_begin(void) {}

int main(int argc, char **argv)
{
    struct CMUnitTest tests[sizeof list / sizeof *list];
    for (int i = 0; i < n; i++)
        tests[i] = list[i].test;
    int rank;
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    unit_begin();
    const int failed = _cmocka_run_group_tests("tests", tests, (size_t)n, NULL, NULL);
    if (rank == 0 && file[0])
        unlink(file);
    MPI_Finalize();
    return failed;
}
