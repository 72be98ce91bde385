/* test_restart_file.c - a restart file of a program that meant other things by its numbers is
 * refused, whatever it holds; that of the same meaning is opened.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../common/run/run_files.h"

enum { UNSAID = -1 };

static struct run r;
static const struct program toy = {.name = "toy", .meaning = 3};

/* A complete, sealed file that the manifest names; meaning: UNSAID as in files of long ago. */
static void write_file(int meaning)
{
    char path[1100];
    snprintf(path, sizeof path, "%s/toy-checkpoint-7.h5", r.dir);
    struct h5 *f = h5_create_restart(MPI_COMM_WORLD, path);
    h5_attribute_int(f, "format", 1);
    h5_attribute_real(f, "time", 0.5);
    h5_attribute_text(f, "version", "0.0 (of long ago)");
    if (meaning != UNSAID)
        h5_attribute_int(f, "meaning", meaning);
    h5_close(&f);
    snprintf(path, sizeof path, "%s/checkpoint.txt", r.dir);
    FILE *manifest = fopen(path, "w");
    assert_non_null(manifest);
    fprintf(manifest, "step 7\nt 0.5\ntoy toy-checkpoint-7.h5\n");
    assert_int_equal(fclose(manifest), 0);
}

static bool opens(int meaning)
{
    int64_t window;
    write_file(meaning);
    struct h5 *f = files_open_restart(&r, &toy, &window);
    const bool is = f != NULL;
    h5_close(&f);
    return is;
}

TEST(test_meaning)
{
    assert_true(opens(3));
    assert_false(opens(2));
    assert_false(opens(4));
    assert_false(opens(UNSAID));
}

void unit_begin(void)
{
    const char *scratch = getenv("TEST_SCRATCH");
    r = (struct run){.comm = MPI_COMM_WORLD, .name = "toy", .scene = {.time = {.end = 1.0}}};
    MPI_Comm_rank(r.comm, &r.rank);
    MPI_Comm_size(r.comm, &r.size);
    snprintf(r.dir, sizeof r.dir, "%s", scratch ? scratch : P_tmpdir);
}
