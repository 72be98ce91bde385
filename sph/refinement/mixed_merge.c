/* mixed_merge.c - splitting and coalescence of particles (Vacondio et al., Comput. Methods Appl.
 * Mech. Eng. 256, 2013; Chiron 2017, 5.1): a particle that enters the region of the next level
 * becomes four of a quarter of its mass, R 0.6 times its own [5.1-5.2]; outside two such become
 * one, once a step each: mass, place and velocity by their masses, R from the density at its place
 * [5.6-5.11]. SPDX-License-Identifier: BSD-3-Clause */
#include "mixed.h"

#include "../pairs/sph_pairs.h"
#include "refinement.h"

static const double alpha = 0.6;      /* R of a child over that of its parent [5.2] */
static const double hysteresis = 0.5; /* coarser dx */
static const double fewest = 0.75;    /* of R_dx: below it supports hold too few particles, which
                                         [5.11] alone comes to after some cycles */

/* Halvings of the spacing that the mass stands for: half a level between two merges. A particle of
 * mass m has level 0.5 log2(rho0 dx^2/m): 0 for the coarsest, 1 for a quarter of its mass. */
static double level_of(const struct sph *s, int i)
{
    const double m = state_row(&s->p, s->p.y, i)[at_mass(2)];
    return 0.5 * log2(s->rho0 * s->dxD / m);
}

/* The finest level whose region holds particle i, edges moved outwards by `wider' spacings of the
 * coarser level, so that what has just split is not merged at once. */
static int level_at(const struct sph *s, int i, double wider)
{
    const struct regions *g = s->refinement->regions;
    int n = 0;
    while (n < regions_levels(g) &&
           regions_distance(g, n + 1, state_row(&s->p, s->p.y, i)) >= -wider * ldexp(s->dx, -n))
        n++;
    return n;
}

/* Splits every particle that is more than 0.75 levels coarser than its place asks for: four
 * children at the corners of a square, +-1/4 of the particle's width from its centre. Children come
 * at the end and are looked at in turn; the last particle takes the parent's index. */
static void split(struct sph *s)
{
    for (int i = 0; i < s->p.n; i++)
        while (level_of(s, i) < level_at(s, i, 0.0) - 0.75) {
            const double w = state_row(&s->p, s->p.y, i)[at_volume(2)], quarter = 0.25 * sqrt(w);
            const double R = alpha * *mixed_R(s, i);
            for (int k = 0; k < 4; k++) {
                const double d[2] = {k & 1 ? quarter : -quarter, k & 2 ? quarter : -quarter};
                mixed_bear(s, i, d, R);
            }
            particles_copy(&s->p, i, --s->p.n);
        }
}

/* A particle that may merge, and the level that its place asks for. */
struct candidate {
    double x[2], level;
    int i, to;
    bool done;
};

static int by_x(const void *a, const void *b)
{
    const struct candidate *p = a, *q = b;
    return p->x[0] < q->x[0] ? -1 : p->x[0] > q->x[0] ? 1 : p->i - q->i;
}

/* Lists the particles that are finer than their place asks for by more than a quarter of a level,
 * in order of x. */
static int find_candidates(const struct sph *s, struct candidate *c)
{
    int n = 0;
    for (int i = 0; i < s->p.n; i++) {
        const double level = level_of(s, i);
        const int to = level > 0.25 ? level_at(s, i, hysteresis) : 0;
        if (level > to + 0.25) {
            c[n] = (struct candidate){.level = level, .i = i, .to = to};
            memcpy(c[n++].x, state_row(&s->p, s->p.y, i), 2 * sizeof(double));
        }
    }
    qsort(c, (size_t)n, sizeof *c, by_x);
    return n;
}

/* R at which the density at x is what both made there [5.11]. From m W(0; R) = sum of m_k W(x -
 * x_k; R_k) with W(0) ~ 1/R^2, bounded below by `fewest' and above by the coarsest R. */
static double merged_R(const struct sph *s, const double *x, const int who[2], double m, double w)
{
    double sum = 0.0;
    for (int k = 0; k < 2; k++) {
        const double *y = state_row(&s->p, s->p.y, who[k]);
        sum += y[at_mass(2)] * kernel_w(2, hypot(y[0] - x[0], y[1] - x[1]), *mixed_R(s, who[k]));
    }
    const double R = sum > 0.0 ? sqrt(kernel_w0(2, 1.0) * m / sum) : INFINITY;
    return fmax(fewest * s->prm.R_dx * sqrt(w), fmin(R, s->R));
}

/* i becomes both; j is left to be removed, without mass. Sums of mass, momentum and volume are
 * conserved, and the centre of mass. */
static void merge(struct sph *s, int i, int j)
{
    double *a = state_row(&s->p, s->p.y, i), *b = state_row(&s->p, s->p.y, j), x[2];
    const double m = a[at_mass(2)] + b[at_mass(2)];
    for (int k = 0; k < 2; k++)
        x[k] = (a[at_mass(2)] * a[k] + b[at_mass(2)] * b[k]) / m;
    *mixed_R(s, i) = merged_R(s, x, (const int[2]){i, j}, m, a[at_volume(2)] + b[at_volume(2)]);
    memcpy(a, x, sizeof x);
    for (int k = 2; k < s->p.nstate; k++)
        a[k] += b[k];
    memset(b, 0, (size_t)s->p.nstate * sizeof *b);
}

/* The nearest candidate behind c in order of x, within twice its spacing, that is to merge to the
 * same level and has about its size; NULL: none. Candidates are sorted by x, so that the search
 * ends at the reach. */
static struct candidate *partner(const struct sph *s, struct candidate *c,
                                 const struct candidate *end)
{
    const double reach = 2.0 * ldexp(s->dx, -1) * exp2(1.0 - c->level);
    struct candidate *best = NULL;
    double least = reach * reach;
    for (struct candidate *k = c + 1; k < end && k->x[0] - c->x[0] < reach; k++) {
        const double dx = k->x[0] - c->x[0], dy = k->x[1] - c->x[1], r2 = dx * dx + dy * dy;
        if (!k->done && k->to == c->to && fabs(k->level - c->level) < 0.3 && r2 < least) {
            least = r2;
            best = k;
        }
    }
    return best;
}

/* Each particle merges once a step at most; those left without mass are removed at the end. O(n log
 * n). */
static void coalesce(struct sph *s)
{
    struct candidate *c = NEW(struct candidate, s->p.n);
    const int n = find_candidates(s, c);
    for (int k = 0; k < n; k++) {
        struct candidate *with = c[k].done ? NULL : partner(s, c + k, c + n);
        if (!with)
            continue;
        merge(s, c[k].i, with->i);
        c[k].done = with->done = true;
    }
    mem_free(c);
    for (int i = 0; i < s->p.n;)
        if (state_row(&s->p, s->p.y, i)[at_mass(2)] == 0.0)
            particles_copy(&s->p, i, --s->p.n);
        else
            i++;
}

/* Ghosts are dropped first, since particles are added and removed. */
void mixed_split(struct sph *s)
{
    s->p.nghost = 0;
    split(s);
    coalesce(s);
}
