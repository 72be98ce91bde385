/* properties_random.h - draws for random scenes. SPDX-License-Identifier: BSD-3-Clause */
#ifndef TESTS_PROPERTIES_RANDOM_H
#define TESTS_PROPERTIES_RANDOM_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

struct random {
    uint64_t state;
};

/* splitmix64 (Steele, Lea & Flood 2014): the same on every machine. */
static inline double uniform(struct random *r, double lo, double hi)
{
    uint64_t z = r->state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return lo + (hi - lo) * (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}
static inline double decades(struct random *r, double lo, double hi)
{
    return exp(uniform(r, log(lo), log(hi)));
}
/* lo .. hi, both in. */
static inline int whole(struct random *r, int lo, int hi)
{
    return lo + (int)uniform(r, 0.0, (double)(hi - lo + 1));
}
static inline bool chance(struct random *r, double p) { return uniform(r, 0.0, 1.0) < p; }
#define one_of(r, ...)                                                                             \
    (((const char *const[]){__VA_ARGS__})[whole(                                                   \
        r, 0, (int)(sizeof((const char *const[]){__VA_ARGS__}) / sizeof(char *)) - 1)])

#endif
