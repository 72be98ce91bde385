/* patterns.h - windows of dry cells that are alike: on equal cells the weights of a polynomial in
 * the window's own cells depend on nothing but its shift and on which of its cells are known, since
 * neither the frame nor the foot point change the polynomials there are. Flat and far water has few
 * such patterns, step after step. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_PATTERNS_H
#define FV_PATTERNS_H

#include <stdint.h>

/* What decides the weights. */
struct pattern_key {
    uint64_t known[4];      /* a byte for each line of the window, a bit for each known cell */
    signed char shift[3];   /* of the window's middle from the cell */
    signed char layer;      /* the second, or one further out: 3 */
    signed char order;      /* of the polynomial */
    unsigned char fills[3]; /* 0 */
};

struct pattern {
    struct pattern_key key;
    int first, n; /* place and number of its weights; n < 0: it is new, and the caller sets both */
};

struct patterns {
    int n, room; /* room: a power of two, or 0 */
    struct pattern *of;
};

/* The pattern of this key, new or not; borrowed until the next call. */
struct pattern *patterns_find(void *owner, struct patterns *p, const struct pattern_key *key);

#endif
