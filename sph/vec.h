/* vec.h - four doubles at once on gcc's vector types: no intrinsics, any machine; pair bodies are
 * written on these. Lines of four particles become columns by a transpose in registers, which beats
 * gathers on all machines tried. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_VEC_H
#define SPH_VEC_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

enum { LANES = 4 };
typedef double vec __attribute__((vector_size(32)));
typedef int64_t mask __attribute__((vector_size(32)));

static inline vec vec_all(double a) { return (vec){a, a, a, a}; }
static inline vec vec_pick(mask m, vec a, vec b) { return (vec)((m & (mask)a) | (~m & (mask)b)); }
static inline vec vec_max(vec a, vec b) { return vec_pick(a > b, a, b); }
static inline vec vec_min(vec a, vec b) { return vec_pick(a < b, a, b); }
static inline vec vec_sqrt(vec a) { return (vec){sqrt(a[0]), sqrt(a[1]), sqrt(a[2]), sqrt(a[3])}; }
static inline double vec_sum(vec a) { return (a[0] + a[1]) + (a[2] + a[3]); }
static inline vec vec_load(const double *p) { return *(const vec *)(const void *)p; }
static inline void vec_store(double *p, vec a) { *(vec *)(void *)p = a; }

static inline __attribute__((always_inline)) void vec_transpose(vec *a, vec *b, vec *c, vec *d)
{
    const vec t0 = __builtin_shuffle(*a, *b, (mask){0, 4, 2, 6});
    const vec t1 = __builtin_shuffle(*a, *b, (mask){1, 5, 3, 7});
    const vec t2 = __builtin_shuffle(*c, *d, (mask){0, 4, 2, 6});
    const vec t3 = __builtin_shuffle(*c, *d, (mask){1, 5, 3, 7});
    *a = __builtin_shuffle(t0, t2, (mask){0, 1, 4, 5});
    *b = __builtin_shuffle(t1, t3, (mask){0, 1, 4, 5});
    *c = __builtin_shuffle(t0, t2, (mask){2, 3, 6, 7});
    *d = __builtin_shuffle(t1, t3, (mask){2, 3, 6, 7});
}

/* n columns (a multiple of 4) of the lines j[0..3], each `width' doubles long. */
static inline __attribute__((always_inline)) void vec_columns(const double *lines, int width,
                                                              const int *j, int n, vec *column)
{
    const double *a = lines + (size_t)j[0] * width, *b = lines + (size_t)j[1] * width;
    const double *c = lines + (size_t)j[2] * width, *d = lines + (size_t)j[3] * width;
    for (int k = 0; k < n; k += 4) {
        column[k] = vec_load(a + k);
        column[k + 1] = vec_load(b + k);
        column[k + 2] = vec_load(c + k);
        column[k + 3] = vec_load(d + k);
        vec_transpose(column + k, column + k + 1, column + k + 2, column + k + 3);
    }
}

#endif
