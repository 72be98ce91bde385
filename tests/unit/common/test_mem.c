/* test_mem.c - blocks are freed with their owner, once, and keep it when they grow. What is freed
 * twice or not at all is found by the sanitizers.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../common/base/base.h"

static int closed[4]; /* numbers of the blocks that were closed, in their order */
static int nclosed;

static void note(void *p) { closed[nclosed++] = *(int *)p; }

static int *numbered(void *owner, int number)
{
    int *p = NEW_IN(owner, int, 1);
    *p = number;
    mem_at_free(p, note);
    return p;
}

TEST(owner_frees_all_it_holds_and_the_youngest_first)
{
    nclosed = 0;
    int *root = numbered(NULL, 0), *a = numbered(root, 1);
    numbered(root, 2);
    numbered(a, 3);
    FREE(root);
    assert_int_equal(nclosed, 4);
    const int order[4] = {0, 2, 1, 3};
    assert_memory_equal(closed, order, sizeof order);
}

TEST(what_is_freed_before_its_owner_leaves_the_others)
{
    nclosed = 0;
    int *root = numbered(NULL, 0), *a = numbered(root, 1), *b = numbered(root, 2);
    numbered(root, 3);
    FREE(b);
    DROP(a);
    assert_null(a);
    assert_int_equal(nclosed, 2);
    FREE(root);
    assert_int_equal(nclosed, 4);
}

TEST(block_that_grows_keeps_owner_content_and_what_it_owns)
{
    nclosed = 0;
    int *root = numbered(NULL, 0), *a = numbered(root, 1);
    double *array = NULL;
    numbered(a, 2);
    numbered(root, 3);
    GROW(a, 1, 1000);
    GROW(root, 1, 500);
    assert_int_equal(*a, 1);
    assert_int_equal(a[999], 0);
    GROW_IN(root, array, 0, 3);
    array[2] = 5.0;
    GROW_IN(root, array, 3, 3000);
    assert_close(array[2], 5.0, 0.0);
    assert_int_equal((uintptr_t)array % 64, 0);
    FREE(root);
    assert_int_equal(nclosed, 4);
}

TEST(owner_can_change)
{
    nclosed = 0;
    int *one = numbered(NULL, 0), *two = numbered(NULL, 1), *p = numbered(one, 2);
    assert_ptr_equal(mem_own(two, p), p);
    assert_null(mem_own(two, NULL));
    FREE(one);
    assert_int_equal(nclosed, 1);
    mem_own(NULL, p);
    FREE(two);
    assert_int_equal(nclosed, 2);
    FREE(p);
    assert_int_equal(nclosed, 3);
}

/* Blocks move less than once in twice as many elements. */
TEST(room_is_made_for_one_more)
{
    int *a = NULL, moves = 0;
    void *root = NEW(char, 1);
    for (int n = 0; n < 5000; n++) {
        const int *before = a;
        ROOM_IN(root, a, n + 1);
        moves += a != before;
        assert_int_equal(a[n], 0);
        a[n] = n;
    }
    for (int n = 0; n < 5000; n++)
        assert_int_equal(a[n], n);
    assert_true(moves <= 8);
    FREE(root);
}
