/* mem.h - allocation that never returns NULL; blocks are zeroed and aligned to 64 bytes, a cache
 * line. Any block can own others, which are freed with it: a struct owns its arrays and the structs
 * it is made of, and one FREE of a state frees all that it holds. When memory runs out the run ends
 * with RUN_INPUT and a sentence that names the amounts. The counters belong to the process and are
 * not safe against threads. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stddef.h>

/* n elements of `size' bytes, zeroed; n = 0 is legal and gives a block as well. Owned by the
 * caller, freed by mem_free and never by free(). */
void *mem_new(size_t n, size_t size);
/* The same, owned by the block `owner' (of any function here) and freed with it or before it. */
void *mem_new_in(void *owner, size_t n, size_t size);
/* Makes `owner' the owner of p, which had none or another, and returns p; p may be NULL. NULL as
 * owner takes p away from the one it had: the caller owns it. */
void *mem_own(void *owner, void *p);
/* close(p) is called when p is freed, before all that p owns: for what a library must give back. */
void mem_at_free(void *p, void (*close)(void *p));
/* Moves p to a new block of n elements, keeping min(n_old, n) of them; the rest is zero. The old
 * block is freed, so the caller replaces p by the returned pointer. The new block has the owner,
 * the close function and all that the old one owned. p may be NULL with n_old 0. There is no spare
 * room, see mem_room. */
void *mem_grow(void *p, size_t n_old, size_t n, size_t size);
/* The same; a new block belongs to `owner', if p is NULL. */
void *mem_grow_in(void *owner, void *p, size_t n_old, size_t n, size_t size);
/* Room for n elements in p, a block or NULL: if it has less it grows to more than 2 n, so that
 * elements can be added one by one; contents are kept, the rest is zero. A new block belongs to
 * `owner'. */
void *mem_room(void *owner, void *p, size_t n, size_t size);
/* Frees a block and all that it owns, the youngest first; NULL does nothing. */
void mem_free(void *p);
/* Frees the n blocks p[n], in their order; FREE below is the way to call it. */
void mem_free_all(size_t n, void *const *p);

/* NEW(double, n): n zeroed elements. GROW(p, n_old, n) replaces the pointer p itself. The forms
 * with _IN name the owner: s->p = NEW_IN(s, double, n). */
#define NEW(type, n) ((type *)mem_new((size_t)(n), sizeof(type)))
#define GROW(p, n_old, n) ((p) = mem_grow((p), (size_t)(n_old), (size_t)(n), sizeof *(p)))
#define NEW_IN(owner, type, n) ((type *)mem_new_in((owner), (size_t)(n), sizeof(type)))
#define GROW_IN(owner, p, n_old, n)                                                                \
    ((p) = mem_grow_in((owner), (p), (size_t)(n_old), (size_t)(n), sizeof *(p)))
/* ROOM_IN(owner, p, n): mem_room, which replaces p. */
#define ROOM_IN(owner, p, n) ((p) = mem_room((owner), (p), (size_t)(n), sizeof *(p)))
/* DROP(p): mem_free of p, which is NULL then. */
#define DROP(p) (mem_free(p), (void)((p) = NULL))
/* FREE(p, q, ...): mem_free of each; the pointers keep their values. */
#define FREE(...)                                                                                  \
    mem_free_all(sizeof((void *[]){__VA_ARGS__}) / sizeof(void *), (void *[]){__VA_ARGS__})
