/* mixed.c - particles of different sizes in one set: their sizes, order and list of pairs. Replaces
 * neighbours_sort and neighbours_build in level_prepare. Pairs interact within the mean of both R.
 * Particles are put into classes by R, each a factor of sqrt 2 wide and with a grid of cells as
 * wide as its largest R; a particle looks for partners in its own class and in those of larger
 * sizes, so that a coarse neighbourhood costs a fine particle little. In 2D, on one rank.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "mixed.h"

#include "../pairs/sph_pairs.h"
#include "../parallel/domain.h"
#include "../particles/sph_particles.h"
#include "refinement.h"

enum { CLASSES = 2 * APR_LEVELS_MAX + 8, SORT_EVERY = 50 };

/* Particles and ghosts whose R are within a factor of root two, by cells as wide as the largest of
 * them reaches. */
struct size_class {
    int n;
    int *who;        /* [n] as they come, then by cell */
    double *x, *y;   /* [n] m: of these, by cell */
    double *half;    /* [n] m: R/2 */
    double R, lo[2]; /* m: largest; lower corner of the cells */
    double edge_1;   /* 1/m */
    int cells[2];
    int *first; /* [cells + 1] */
};

struct mixed {
    struct size_class of[CLASSES];
    int npairs, pairs_capacity;
    int *spare;
    int (*pair)[2]; /* [npairs] i < j, i a local */
    double least;   /* m */
    int since_sorted;
};

/* The smallest R, on which the step depends (level_dt). */
static void find_least(struct sph *s)
{
    double least = s->R;
    for (int i = 0; i < s->p.n; i++)
        least = fmin(least, *mixed_R(s, i));
    s->mixed->least = least;
}

/* From here on the passes are those of mixed_pairs.c. */
static void begin(struct sph *s)
{
    s->mixed = NEW_IN(s, struct mixed, 1);
    s->passes.gradients = mixed_gradients;
    s->passes.rates = mixed_rates;
    s->passes.slopes = true;
    s->lists.ready = false;
}

void mixed_start(struct sph *s)
{
    if (!s->p.size)
        particles_add_sizes(&s->p, s->R);
    begin(s);
    mixed_adapt(s);
}

/* Sizes are in the file; what follows from them is found anew. */
bool mixed_restart(struct sph *s, struct h5 *f)
{
    particles_add_sizes(&s->p, s->R);
    begin(s);
    const bool fits = h5_read_real(f, "sizes", s->p.n, 2, s->p.size[0]);
    find_least(s);
    return fits;
}

double mixed_least(const struct sph *s) { return s->mixed->least; }

/* Creations and removals at the end of a step, then lists anew; with graded particles only the
 * regions move. */
void mixed_adapt(struct sph *s)
{
    const int method = apr_params_of(s->run)->method;
    timer_start(&s->run->timers, "levels");
    regions_move(s->refinement->regions, s->t);
    if (method == APR_WEIGHTS)
        mixed_weights(s);
    else if (method == APR_COALESCENCE)
        mixed_split(s);
    find_least(s);
    s->lists.ready = false;
    timer_stop(&s->run->timers, "levels");
}

/* The child keeps the weight 1 until the method sets another. */
int mixed_bear(struct sph *s, int i, const double *d, double R)
{
    const int k = refinement_child(s, s, i, d);
    *mixed_R(s, k) = R;
    *mixed_weight(s, k) = 1.0;
    return k;
}

/* --- order --- */

/* Bits of a and b in turn: particles near each other in the plane are near in this order. */
static uint64_t interleave(uint32_t a, uint32_t b)
{
    uint64_t key = 0;
    for (int k = 0; k < 32; k++)
        key |= (uint64_t)(a >> k & 1) << 2 * k | (uint64_t)(b >> k & 1) << (2 * k + 1);
    return key;
}

struct keyed {
    uint64_t key;
    int i;
};

static int by_key(const void *a, const void *b)
{
    const struct keyed *x = a, *y = b;
    return x->key != y->key ? (x->key < y->key ? -1 : 1) : x->i - y->i;
}

/* Now and then: nothing but speed depends on the order. Morton order of positions in units of the
 * least R/2, every SORT_EVERY steps; ties keep their order. */
void mixed_sort(struct sph *s)
{
    const double scale = 2.0 / s->mixed->least;
    if (s->run->step % SORT_EVERY != 0 && s->mixed->since_sorted > 0)
        return;
    s->mixed->since_sorted = 1;
    struct keyed *keys = NEW(struct keyed, s->p.n);
    int *order = NEW(int, s->p.n);
    for (int i = 0; i < s->p.n; i++) {
        const double *y = state_row(&s->p, s->p.y, i);
        const double a = fmax(0.0, (y[0] - s->lo[0]) * scale);
        const double b = fmax(0.0, (y[1] - s->lo[1]) * scale);
        keys[i] = (struct keyed){interleave((uint32_t)fmin(a, 4e9), (uint32_t)fmin(b, 4e9)), i};
    }
    qsort(keys, (size_t)s->p.n, sizeof *keys, by_key);
    for (int i = 0; i < s->p.n; i++)
        order[i] = keys[i].i;
    particles_permute(&s->p, s->p.n, order, true);
    FREE(keys, order);
}

/* Periodic images take the sizes of their originals; they have been made before, and domain_share
 * serves. */
void mixed_images(struct sph *s)
{
    double *ghosts = NEW(double, 2 * (size_t)s->p.nghost);
    domain_share(s, s->p.size[0], 2, ghosts);
    if (s->p.nghost > 0)
        memcpy(s->p.size[s->p.n], ghosts, 2 * (size_t)s->p.nghost * sizeof *ghosts);
    mem_free(ghosts);
}

/* --- list of pairs --- */

/* Appends particle or ghost i to a class and widens the class's R. */
static void put_into_class(void *owner, struct size_class *c, int i, double R)
{
    ROOM_IN(owner, c->who, c->n + 1);
    c->who[c->n++] = i;
    c->R = fmax(c->R, R);
}

/* Index of the cell along axis a, clamped to the grid. */
static int cell_of(const struct size_class *c, int a, double x)
{
    const double k = (x - c->lo[a]) * c->edge_1;
    return k > 0.0 ? k < c->cells[a] - 1 ? (int)k : c->cells[a] - 1 : 0;
}

/* Number of the cell at x. */
static int cell_at(const struct size_class *c, const double *x)
{
    return cell_of(c, 0, x[0]) + c->cells[0] * cell_of(c, 1, x[1]);
}

/* Box and cells of a class, as wide as its largest R and the skin, or wider if there would be more
 * than four cells a particle. */
static void lay_cells(struct size_class *c, const struct sph *s)
{
    double hi[2] = {-INFINITY, -INFINITY}, edge = (1.0 + 1e-9) * (c->R + s->lists.skin);
    c->lo[0] = c->lo[1] = INFINITY;
    for (int k = 0; k < c->n; k++)
        for (int a = 0; a < 2; a++) {
            const double x = prim_line(&s->p, c->who[k])[a];
            c->lo[a] = fmin(c->lo[a], x);
            hi[a] = fmax(hi[a], x);
        }
    while ((hi[0] - c->lo[0] + edge) * (hi[1] - c->lo[1] + edge) > (4.0 * c->n + 64) * edge * edge)
        edge *= 1.26;
    c->edge_1 = 1.0 / edge;
    for (int a = 0; a < 2; a++)
        c->cells[a] = (int)((hi[a] - c->lo[a]) * c->edge_1) + 1;
}

/* By cells, in the order they were in. first is shifted by two entries while counting, so that
 * filling leaves it as it must be. x, y and half are copied side by side: finding pairs reads
 * nothing else. */
static void sort_class(struct mixed *m, struct size_class *c, const struct sph *s)
{
    lay_cells(c, s);
    const int total = c->cells[0] * c->cells[1];
    ROOM_IN(m, c->first, total + 2);
    ROOM_IN(m, m->spare, c->n);
    ROOM_IN(m, c->x, c->n);
    ROOM_IN(m, c->y, c->n);
    ROOM_IN(m, c->half, c->n);
    memset(c->first, 0, ((size_t)total + 2) * sizeof *c->first);
    for (int k = 0; k < c->n; k++)
        c->first[cell_at(c, prim_line(&s->p, c->who[k])) + 2]++;
    for (int k = 0; k < total; k++)
        c->first[k + 2] += c->first[k + 1];
    for (int k = 0; k < c->n; k++)
        m->spare[c->first[cell_at(c, prim_line(&s->p, c->who[k])) + 1]++] = c->who[k];
    memcpy(c->who, m->spare, (size_t)c->n * sizeof *c->who);
    for (int k = 0; k < c->n; k++) {
        const double *x = prim_line(&s->p, c->who[k]);
        c->x[k] = x[0];
        c->y[k] = x[1];
        c->half[k] = 0.5 * *mixed_R(s, c->who[k]);
    }
}

/* The lower index first, so that sums do not depend on who was found from whom. */
static void add_pair(struct mixed *m, int i, int j)
{
    if (m->npairs == m->pairs_capacity) {
        const int more = 2 * m->pairs_capacity + 4096;
        GROW_IN(m, m->pair, m->pairs_capacity, more);
        m->pairs_capacity = more;
    }
    m->pair[m->npairs][0] = i < j ? i : j;
    m->pair[m->npairs++][1] = i < j ? j : i;
}

/* Partners of number `at' of a class in one of its own or larger sizes: the cells around it hold
 * them; in its own those behind it. Two that count for nobody are none, nor are two ghosts. In
 * cells of its own class positions up to `at' are left out: these pairs have been found from the
 * other side. Cells of a row are contiguous in x, hence one run for each row of cells. */
static void pair_with_class(const struct sph *s, const struct size_class *of, int at,
                            const struct size_class *c)
{
    struct mixed *m = s->mixed;
    const int i = of->who[at];
    const double x = of->x[at], y = of->y[at], half = of->half[at] + s->lists.skin,
                 reach = c->R + s->lists.skin;
    const bool counts = *mixed_weight(s, i) > 0.0;
    const int lo = cell_of(c, 0, x - reach), hi = cell_of(c, 0, x + reach);
    const int last = cell_of(c, 1, y + reach);
    for (int row = cell_of(c, 1, y - reach); row <= last; row++) {
        const int from = c->first[lo + c->cells[0] * row];
        for (int k = of == c && from <= at ? at + 1 : from;
             k < c->first[hi + c->cells[0] * row + 1]; k++) {
            const double dx = c->x[k] - x, dy = c->y[k] - y, within = half + c->half[k];
            if (dx * dx + dy * dy >= within * within)
                continue;
            const int j = c->who[k];
            if ((i < s->p.n || j < s->p.n) && (counts || *mixed_weight(s, j) > 0.0))
                add_pair(m, i, j);
        }
    }
}

/* Class k holds R from least 2^(k/2) on; 0.01 keeps sizes that are exact powers of two in one class
 * whatever the rounding. */
static void find_pairs(struct sph *s)
{
    struct mixed *m = s->mixed;
    const int all = s->p.n + s->p.nghost;
    m->npairs = 0;
    for (int k = 0; k < CLASSES; k++)
        m->of[k].n = 0, m->of[k].R = 0.0;
    for (int i = 0; i < all; i++) {
        const double R = *mixed_R(s, i), k = 2.0 * log2(R / m->least) + 0.01;
        put_into_class(s->mixed, m->of + (int)fmax(0.0, fmin(k, CLASSES - 1)), i, R);
    }
    for (int k = 0; k < CLASSES; k++)
        if (m->of[k].n > 0)
            sort_class(m, m->of + k, s);
    for (int k = 0; k < CLASSES; k++)
        for (int i = 0; i < m->of[k].n; i++)
            for (int l = k; l < CLASSES; l++)
                if (m->of[l].n > 0)
                    pair_with_class(s, m->of + k, i, m->of + l);
}

/* Grows the arrays of the list to n rows and this many entries. */
static void make_room(struct neighbours *l, int n, int64_t entries)
{
    neighbours_room(l, n);
    if (entries > l->capacity) {
        GROW_IN(l, l->j, l->capacity, entries + entries / 4);
        l->capacity = entries + entries / 4;
    }
}

/* Rows of the list from the pairs: those before the particle, then those behind, then dummies. tail
 * holds the number of earlier partners while count counts all; both are then used as places to
 * fill. Surface detection by the number of neighbours (whole) is off. */
void mixed_list(struct sph *s)
{
    struct neighbours *l = s->list;
    const struct mixed *m = s->mixed;
    const int n = s->p.n;
    find_pairs(s);
    make_room(l, n, 2 * (int64_t)m->npairs + (int64_t)n * (LANES - 1));
    memset(l->count, 0, (size_t)n * sizeof *l->count);
    memset(l->tail, 0, (size_t)n * sizeof *l->tail);
    for (int k = 0; k < m->npairs; k++) {
        l->count[m->pair[k][0]]++;
        if (m->pair[k][1] < n) {
            l->count[m->pair[k][1]]++;
            l->tail[m->pair[k][1]]++;
        }
    }
    l->start[0] = 0;
    for (int i = 0; i < n; i++) {
        l->start[i + 1] = l->start[i] + l->count[i] + LANES - 1;
        for (int k = 0; k < LANES - 1; k++)
            l->j[l->start[i] + l->count[i] + k] = s->p.capacity;
        l->count[i] = l->tail[i]; /* where the next goes: behind, before */
        l->tail[i] = 0;
        l->whole[i] = false;
        l->beside[i] = false;
    }
    for (int k = 0; k < m->npairs; k++) {
        const int i = m->pair[k][0], j = m->pair[k][1];
        l->j[l->start[i] + l->count[i]++] = j;
        if (j < n)
            l->j[l->start[j] + l->tail[j]++] = i;
    }
    l->n = l->nshallow = l->treated = n;
    l->nclose = 0;
    neighbours_rows(l, ROWS_ALL);
}

/* --- check --- */

/* Adds a fault about `key' that names the method without these restrictions. */
static void refuse(const struct run *r, struct faults *f, bool bad, const char *key,
                   const char *why)
{
    if (bad)
        params_fault(r->params, f, key, "%s: a method for comparisons; take apr.method = guards",
                     why);
}

/* Everything that these methods were not written for; the tests are cheap and made at the start. */
void mixed_check(const struct run *r, const struct sph_params *used, const struct apr_params *prm,
                 struct faults *f)
{
    const struct scene *c = &r->scene;
    bool points = false, rub = false;
    bool moves = false;
    for (int k = 0; k < c->nwalls; k++) {
        points = points || c->walls[k].side == SIDE_NONE;
        rub = rub || c->walls[k].kind == WALL_NO_SLIP;
    }
    for (int k = 0; k < prm->regions.n; k++) {
        const struct apr_region *is = prm->regions.of + k;
        moves = moves || is->velocity[0] != 0.0 || is->velocity[1] != 0.0 || is->motion.n > 0 ||
                *is->follow;
    }
    const bool graded = prm->method == APR_GRADED;
    refuse(r, f, c->domain.dim != 2, "apr.method", "this one is for 2D");
    refuse(r, f, r->size > 1, "apr.method", "this one runs on one rank");
    refuse(r, f, c->has_fv && c->has_sph, "apr.method", "this one is not for a coupled job");
    refuse(r, f, !sph_params_is_riemann(used->scheme), "sph.scheme",
           "particles of mixed sizes need riemann or riemann_ale");
    refuse(r, f, used->transport != TRANSPORT_TVS && used->transport != TRANSPORT_NONE,
           "sph.transport", "particles of mixed sizes need tvs or none");
    refuse(r, f, c->nbodies > 0, "bodies", "particles of mixed sizes need plane sides as walls");
    refuse(r, f, points || used->walls == WALLS_NFM, "walls",
           "particles of mixed sizes need plane sides as walls, with sph.walls = ghosts");
    refuse(r, f, rub, "walls", "particles of mixed sizes need slip walls");
    refuse(r, f, sph_params_zones(r, used), "apr.method", "this one has no open sides");
    refuse(r, f, used->background, "sph.background", "not with particles of mixed sizes");
    refuse(r, f, prm->criteria.n > 0, "apr.criteria", "this method follows regions alone");
    refuse(r, f, graded && (prm->regions.n != 1 || prm->regions.of[0].shape != REGION_BOX),
           "apr.regions", "graded needs one box");
    refuse(r, f, graded && moves, "apr.regions", "graded particles need regions at rest");
    refuse(r, f, graded && (used->noise > 0.0 || used->packing > 0),
           graded && used->noise > 0.0 ? "sph.noise" : "sph.packing",
           "graded particles start without noise and packing");
    refuse(r, f, graded && hypot(c->fluid.gravity[0], c->fluid.gravity[1]) > 0.0, "fluid.gravity",
           "graded particles have no gravity");
}
