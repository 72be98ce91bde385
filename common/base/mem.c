/* mem.c - see mem.h. A header of one cache line before each block keeps its size in bytes, so that
 * mem_free can count without being told, and its place among the blocks of its owner; the block
 * itself then begins on a cache line again. Sizes are whole lines, as aligned_alloc asks for.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "mem.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "exit.h"
#include "log.h"

enum { LINE = 64 };
static size_t held; /* bytes of this process */

/* The blocks of one owner are a list; `link' is what points to this one: its owner's `owned' or
 * the `next' of the one before it, NULL without an owner. */
struct head {
    size_t bytes;
    struct head *owned, *next, **link;
    void (*close)(void *block);
};
_Static_assert(sizeof(struct head) <= LINE, "the header is one cache line");

static struct head *head_of(void *p) { return (struct head *)(void *)((char *)p - LINE); }

/* What is moved keeps its place in the list. */
static void relink(struct head *h)
{
    if (h->link)
        *h->link = h;
    if (h->next)
        h->next->link = &h->next;
    if (h->owned)
        h->owned->link = &h->owned;
}

static void unlink_block(struct head *h)
{
    if (h->link)
        *h->link = h->next;
    if (h->next)
        h->next->link = h->link;
    h->next = NULL;
    h->link = NULL;
}

/* SIZE_MAX / 2 keeps n size, rounded up and with its header, from wrapping round. */
void *mem_new(size_t n, size_t size)
{
    if (size && n > (SIZE_MAX / 2 - 2 * LINE) / size)
        fail_with(RUN_INPUT, "%zu elements of %zu bytes are more than memory can hold", n, size);
    const size_t bytes = (n * size + LINE - 1) / LINE * LINE + LINE;
    char *p = aligned_alloc(LINE, bytes);
    if (!p)
        fail_with(RUN_INPUT,
                  "out of memory: %.3g MB requested, %.3g MB held by this rank; a coarser "
                  "resolution or more hosts",
                  1e-6 * (double)bytes, 1e-6 * (double)held);
    memset(p, 0, bytes);
    ((struct head *)(void *)p)->bytes = bytes;
    held += bytes;
    return p + LINE;
}

void *mem_own(void *owner, void *p)
{
    if (!p)
        return NULL;
    struct head *h = head_of(p);
    unlink_block(h);
    if (owner) {
        h->link = &head_of(owner)->owned;
        h->next = *h->link;
        relink(h);
    }
    return p;
}

void *mem_new_in(void *owner, size_t n, size_t size) { return mem_own(owner, mem_new(n, size)); }

void mem_at_free(void *p, void (*close)(void *p)) { head_of(p)->close = close; }

static void release(struct head *h)
{
    held -= h->bytes;
    free(h);
}

void *mem_grow(void *p, size_t n_old, size_t n, size_t size)
{
    void *q = mem_new(n, size);
    if (!p)
        return q;
    memcpy(q, p, (n_old < n ? n_old : n) * size);
    struct head *to = head_of(q), *from = head_of(p);
    const size_t bytes = to->bytes;
    *to = *from;
    to->bytes = bytes;
    relink(to);
    release(from);
    return q;
}

void *mem_grow_in(void *owner, void *p, size_t n_old, size_t n, size_t size)
{
    return p ? mem_grow(p, n_old, n, size) : mem_new_in(owner, n, size);
}

void *mem_room(void *owner, void *p, size_t n, size_t size)
{
    const size_t room = p ? (head_of(p)->bytes - LINE) / size : 0;
    return n > room ? mem_grow_in(owner, p, room, 2 * n + 64, size) : p;
}

void mem_free(void *p)
{
    if (!p)
        return;
    struct head *h = head_of(p);
    if (h->close)
        h->close(p);
    while (h->owned)
        mem_free((char *)h->owned + LINE);
    unlink_block(h);
    release(h);
}

void mem_free_all(size_t n, void *const *p)
{
    for (size_t i = 0; i < n; i++)
        mem_free(p[i]);
}
