/* mem.h - allocation that never returns NULL; blocks are zeroed and aligned to 64 bytes, a cache
 * line. When memory runs out the run ends with RUN_INPUT and a sentence that names the amounts. The
 * counters belong to the process and are not safe against threads.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_MEM_H
#define COMMON_MEM_H

#include <stddef.h>

/* n elements of `size' bytes, zeroed; n = 0 is legal and gives a block as well. Owned by the
 * caller, freed by mem_free and never by free(). */
void *mem_new(size_t n, size_t size);
/* Moves p to a new block of n elements, keeping min(n_old, n) of them; the rest is zero. The old
 * block is freed, so the caller replaces p by the returned pointer. p may be NULL with n_old 0.
 * There is no spare room: callers that append one by one double n themselves. */
void *mem_grow(void *p, size_t n_old, size_t n, size_t size);
/* Frees a block of mem_new or mem_grow; NULL does nothing. */
void mem_free(void *p);
/* Frees the n blocks p[n], in their order; FREE below is the way to call it. */
void mem_free_all(size_t n, void *const *p);

/* NEW(double, n): n zeroed elements. GROW(p, n_old, n) replaces the pointer p itself. */
#define NEW(type, n) ((type *)mem_new((size_t)(n), sizeof(type)))
#define GROW(p, n_old, n) ((p) = mem_grow((p), (size_t)(n_old), (size_t)(n), sizeof *(p)))
/* FREE(p, q, ...): mem_free of each; the pointers keep their values. */
#define FREE(...)                                                                                  \
    mem_free_all(sizeof((void *[]){__VA_ARGS__}) / sizeof(void *), (void *[]){__VA_ARGS__})

#endif
