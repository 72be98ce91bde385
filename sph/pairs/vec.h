/* vec.h - vectors of LANES doubles for the pair loops: one lane a neighbour, on gcc's vector types.
 * Lines of neighbours are loaded whole and transposed in registers, which beats gathers; results go
 * back to them the same way. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_VEC_H
#define SPH_VEC_H

#include "../../common/base/base.h"

/* Four on machines with registers for eight, too: transposes of eight lines, packing and sums of
 * rows take more than wider arithmetic gives (Taylor-Green 0.72, dam breaks 0.84 and 0.88 of the
 * time of eight lanes on AVX-512 with the plain forms below). */
#ifndef LANES
#define LANES 4
#endif

/* LANES doubles; LANES masks of comparisons, all bits set where they hold; two and four doubles
 * that move between memory and registers whatever LANES is. */
typedef double vec __attribute__((vector_size(8 * LANES), may_alias));
typedef long long vec_bits __attribute__((vector_size(8 * LANES)));
typedef double vec2 __attribute__((vector_size(16), may_alias));
typedef double vec4 __attribute__((vector_size(32), may_alias));

/* The vector whose lanes all hold a. */
INLINE vec vec_all(double a)
{
    vec v = {0};
    for (int l = 0; l < LANES; l++)
        v[l] = a;
    return v;
}

/* Where the plain form compiles to several instructions though the machine has one, it is named. */
#if LANES == 4 && defined __AVX__
INLINE vec vec_sqrt(vec a) { return (vec)__builtin_ia32_sqrtpd256(a); }
INLINE vec vec_max(vec a, vec b) { return (vec)__builtin_ia32_maxpd256(a, b); }
INLINE vec vec_min(vec a, vec b) { return (vec)__builtin_ia32_minpd256(a, b); }
#else
INLINE vec vec_sqrt(vec a)
{
    vec v;
    for (int l = 0; l < LANES; l++)
        v[l] = sqrt(a[l]);
    return v;
}
INLINE vec vec_max(vec a, vec b)
{
    const vec_bits first = a > b;
    return (vec)((first & (vec_bits)a) | (~first & (vec_bits)b));
}
INLINE vec vec_min(vec a, vec b)
{
    const vec_bits first = a < b;
    return (vec)((first & (vec_bits)a) | (~first & (vec_bits)b));
}
#endif

/* Bit l is set where a < b. */
INLINE unsigned vec_less(vec a, vec b)
{
#if LANES == 4 && defined __AVX__
    return (unsigned)__builtin_ia32_movmskpd256((vec)(a < b));
#else
    unsigned bits = 0;
    for (int l = 0; l < LANES; l++)
        bits |= (unsigned)(a[l] < b[l]) << l;
    return bits;
#endif
}

/* Writes the entries of from[LANES] whose bits are set to the front of to[LANES]; returns their
 * number. */
INLINE int vec_pack(int *to, const int *from, unsigned bits)
{
#if LANES == 4
    typedef int four __attribute__((vector_size(16), aligned(4), may_alias));
    static const int front[16][4] __attribute__((aligned(16))) = {
        {0, 0, 0, 0}, {0, 0, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}, {2, 0, 0, 0}, {0, 2, 0, 0},
        {1, 2, 0, 0}, {0, 1, 2, 0}, {3, 0, 0, 0}, {0, 3, 0, 0}, {1, 3, 0, 0}, {0, 1, 3, 0},
        {2, 3, 0, 0}, {0, 2, 3, 0}, {1, 2, 3, 0}, {0, 1, 2, 3}};
    *(four *)to = __builtin_shuffle(*(const four *)from, *(const four *)front[bits]);
    return __builtin_popcount(bits);
#else
    int n = 0;
    for (int l = 0; l < LANES; l++) {
        to[n] = from[l];
        n += bits >> l & 1;
    }
    return n;
#endif
}

/* The two doubles at p. */
INLINE vec2 load2(const double *p) { return *(const vec2 *)(const void *)p; }

/* Low and high half of one vector. */
INLINE vec4 join(vec2 a, const double *p)
{
#ifdef __AVX__ /* takes its operand from memory; from the shuffle gcc makes two steps */
    return __builtin_ia32_vinsertf128_pd256(__builtin_ia32_pd256_pd(a), load2(p), 1);
#else
    return __builtin_shufflevector(a, load2(p), 0, 1, 2, 3);
#endif
}

/* Columns k and k+1 (k even) of the lines of LANES neighbours: line + stride * j[l]. */
INLINE void vec_columns(const double *line, const ptrdiff_t stride, const int *j, const int k,
                        vec *a, vec *b)
{
#if LANES == 4
    const vec4 even = join(load2(line + stride * j[0] + k), line + stride * j[2] + k);
    const vec4 odd = join(load2(line + stride * j[1] + k), line + stride * j[3] + k);
    *a = __builtin_shufflevector(even, odd, 0, 4, 2, 6);
    *b = __builtin_shufflevector(even, odd, 1, 5, 3, 7);
#else
    vec first = vec_all(0.0), second = first;
    for (int l = 0; l < LANES; l++) {
        first[l] = line[stride * j[l] + k];
        second[l] = line[stride * j[l] + k + 1];
    }
    *a = first;
    *b = second;
#endif
}

/* Adds (a, b, c, d) of each lane to the first four entries of its row. The rows of one vector
 * differ but for padding, whose lanes are zero. */
INLINE void vec_add_rows(double *row, const ptrdiff_t stride, const int *j, vec a, vec b, vec c,
                         vec d)
{
#if LANES == 4
    const vec ab02 = __builtin_shufflevector(a, b, 0, 4, 2, 6);
    const vec ab13 = __builtin_shufflevector(a, b, 1, 5, 3, 7);
    const vec cd02 = __builtin_shufflevector(c, d, 0, 4, 2, 6);
    const vec cd13 = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    *(vec4 *)(void *)(row + stride * j[0]) += __builtin_shufflevector(ab02, cd02, 0, 1, 4, 5);
    *(vec4 *)(void *)(row + stride * j[1]) += __builtin_shufflevector(ab13, cd13, 0, 1, 4, 5);
    *(vec4 *)(void *)(row + stride * j[2]) += __builtin_shufflevector(ab02, cd02, 2, 3, 6, 7);
    *(vec4 *)(void *)(row + stride * j[3]) += __builtin_shufflevector(ab13, cd13, 2, 3, 6, 7);
#else
    for (int l = 0; l < LANES; l++)
        *(vec4 *)(void *)(row + stride * j[l]) += (vec4){a[l], b[l], c[l], d[l]};
#endif
}

/* a . b of two vectors in space, lane by lane. */
INLINE vec vec_dot(const vec *a, const vec *b, const int dim)
{
    return dim == 2 ? a[0] * b[0] + a[1] * b[1] : a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The sum of all lanes. */
INLINE double vec_sum(vec a)
{
    double s = 0.0;
    for (int l = 0; l < LANES; l++)
        s += a[l];
    return s;
}

/* The sums of four vectors. */
INLINE vec4 vec_sums(vec a, vec b, vec c, vec d)
{
#if LANES == 4
    const vec ab =
        __builtin_shufflevector(a, b, 0, 4, 2, 6) + __builtin_shufflevector(a, b, 1, 5, 3, 7);
    const vec cd =
        __builtin_shufflevector(c, d, 0, 4, 2, 6) + __builtin_shufflevector(c, d, 1, 5, 3, 7);
    return __builtin_shufflevector(ab, cd, 0, 1, 4, 5) +
           __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
#else
    return (vec4){vec_sum(a), vec_sum(b), vec_sum(c), vec_sum(d)};
#endif
}

#endif
