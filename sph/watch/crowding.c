/* crowding.c - whether particles of a refined flow overlap. Where births and removals, or guards
 * that stray, do not keep up with a jet across the edge of a region, a level holds more volume than
 * there is room for: sum w W, 1 where water fills its place, at most 1.15 in flows of one size,
 * however violent, rises to 2, and densities know nothing of it. Those deep in a finer region,
 * which nobody takes anything from, do not count. SPDX-License-Identifier: BSD-3-Clause */
#include "sph_watch.h"

#include "../pairs/sph_pairs.h"
#include "../sph.h"

static const double overlap = 1.35; /* sum w W that is too much */

/* O(pairs), by the present list and records; local, the caller sums and takes maxima. */
struct sph_crowd sph_watch_crowd(const struct sph *s)
{
    struct sph_crowd c = {0};
    for (; s; s = s->finer)
        for (int i = 0; i < s->p.n; i++) {
            if (s->p.role[i] & ROLE_DEEP)
                continue;
            const double sum = kernel_sum(s, i);
            c.counted += 1.0;
            c.crowded += sum > overlap;
            if (sum <= c.most)
                continue;
            c.most = sum;
            c.level = s->level;
            memcpy(c.place, prim_line(&s->p, i), (size_t)s->dim * sizeof *c.place);
        }
    return c;
}

/* The place comes from the rank with the largest sum, so that all ranks write the same text. */
void sph_watch_say_crowd(const struct sph *s, char *text, size_t size)
{
    const struct sph_crowd *c = &s->watch.crowd;
    double at[4] = {c->place[0], c->place[1], c->place[2], c->level};
    const double worst = ranks_most(s->run->comm, c->most, at, sizeof at);
    char place[64];
    if (s->dim == 2)
        snprintf(place, sizeof place, "(%.4g, %.4g)", at[0], at[1]);
    else
        snprintf(place, sizeof place, "(%.4g, %.4g, %.4g)", at[0], at[1], at[2]);
    snprintf(text, size,
             "%.3g at %s m, level %d: pressures near are those of too much water; keep the edges "
             "of apr.regions clear of jets and sheets there, or refine one level less",
             worst, place, (int)at[3]);
}
