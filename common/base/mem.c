/* mem.c - see mem.h. A header of one cache line before each block keeps its size in bytes, so that
 * mem_free can count without being told; the block itself then begins on a cache line again. Sizes
 * are whole lines, as aligned_alloc asks for.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "mem.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "exit.h"
#include "log.h"

enum { LINE = 64 };
static size_t held; /* bytes of this process */

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
    memcpy(p, &bytes, sizeof bytes);
    held += bytes;
    return p + LINE;
}

void *mem_grow(void *p, size_t n_old, size_t n, size_t size)
{
    void *q = mem_new(n, size);
    if (p)
        memcpy(q, p, (n_old < n ? n_old : n) * size);
    mem_free(p);
    return q;
}

void mem_free(void *p)
{
    if (!p)
        return;
    char *block = (char *)p - LINE;
    size_t bytes;
    memcpy(&bytes, block, sizeof bytes);
    held -= bytes;
    free(block);
}

void mem_free_all(size_t n, void *const *p)
{
    for (size_t i = 0; i < n; i++)
        mem_free(p[i]);
}
