/* mem.h - allocation that never returns NULL; blocks are aligned to 64 bytes.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_MEM_H
#define COMMON_MEM_H

#include <stddef.h>

/* n elements of `size' bytes, zeroed; n = 0 is legal. Owned by the caller, freed by mem_free. */
void *mem_new(size_t n, size_t size);
/* Grows to n elements and keeps the first n_old; the rest is zero. p may be NULL with n_old 0. */
void *mem_grow(void *p, size_t n_old, size_t n, size_t size);
void mem_free(void *p);
/* Bytes this process holds through the functions above, and the most it ever held. */
size_t mem_held(void);
size_t mem_peak(void);

#define NEW(type, n) ((type *)mem_new((size_t)(n), sizeof(type)))
#define GROW(p, n_old, n) ((p) = mem_grow((p), (size_t)(n_old), (size_t)(n), sizeof *(p)))

#endif
