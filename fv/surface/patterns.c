/* patterns.c - see patterns.h: a table with open places, twice as large whenever it is half full.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "patterns.h"

#include "../../common/base/base.h"

enum { ROOM = 1024 };

static bool is_free(const struct pattern *x) { return x->key.layer == 0; }

/* Mixes all bits of the key (Fibonacci hashing, Knuth, TAOCP 3, 6.4). */
static uint64_t mixed(const struct pattern_key *key)
{
    uint64_t rest, sum = 0;
    memcpy(&rest, key->shift, sizeof rest);
    const uint64_t words[5] = {key->known[0], key->known[1], key->known[2], key->known[3], rest};
    for (int k = 0; k < 5; k++) {
        sum = (sum ^ words[k]) * UINT64_C(0x9E3779B97F4A7C15);
        sum ^= sum >> 29;
    }
    return sum;
}

/* Its place, or a free one. */
static struct pattern *place_of(const struct patterns *p, const struct pattern_key *key)
{
    const uint64_t last = (uint64_t)p->room - 1;
    uint64_t k = mixed(key) & last;
    while (!is_free(p->of + k) && memcmp(&p->of[k].key, key, sizeof *key) != 0)
        k = (k + 1) & last;
    return p->of + k;
}

/* Pointers to patterns do not outlive it: their numbers are kept in `first', the stencil's place.
 */
static void grow(void *owner, struct patterns *p)
{
    struct patterns wider = {.n = p->n, .room = p->room > 0 ? 2 * p->room : ROOM};
    wider.of = NEW_IN(owner, struct pattern, wider.room);
    for (int k = 0; k < p->room; k++)
        if (!is_free(p->of + k))
            *place_of(&wider, &p->of[k].key) = p->of[k];
    mem_free(p->of);
    *p = wider;
}

struct pattern *patterns_find(void *owner, struct patterns *p, const struct pattern_key *key)
{
    if (2 * p->n >= p->room)
        grow(owner, p);
    struct pattern *x = place_of(p, key);
    if (is_free(x)) {
        *x = (struct pattern){.key = *key, .n = -1};
        p->n++;
    }
    return x;
}
