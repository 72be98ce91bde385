/* wall_gaps.c - see wall_gaps.h. A wedge that is narrower than the spacing of the parents holds no
 * child, although there is room for some: below a flap on a point 2 % of the water beside it, which
 * then rushed in and rang (lift +9 % for seconds). Cells of the level's own lattice that are empty
 * and within 2 dx of a wall are filled from the particles on, so that rooms without water and
 * pockets behind walls stay empty.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "wall_gaps.h"

#include "../../common/scene/scene.h"
#include "../parallel/domain.h"
#include "../particles/sph_particles.h"
#include "../refinement/sph_refinement.h"
#include "../time/sph_time.h"
#include "../walls/sph_walls.h"
#include "first_lattice.h"
#include "rooms.h"

enum { ROUNDS = 16 };
/* dx: of places from walls, of particles from a place that is empty, and from one that is next. */
static const double beside = 2.0, empty = 0.85, next_to = 1.6;

/* A particle or an empty place beside a wall, and the cell of the lattice that it is in; of a place
 * the density at rest with a particle next to it, and how far that is. */
struct gap_place {
    int cell[2];
    double x[3], rho, far2; /* m, kg/m^3, m^2 */
};

struct gap_places {
    int n;
    struct gap_place *of;
};

static int by_cell(const void *a, const void *b)
{
    const struct gap_place *p = a, *q = b;
    return p->cell[1] != q->cell[1] ? (p->cell[1] > q->cell[1]) - (p->cell[1] < q->cell[1])
                                    : (p->cell[0] > q->cell[0]) - (p->cell[0] < q->cell[0]);
}

/* The nearest particle's word counts. */
static int by_word(const void *a, const void *b)
{
    const struct gap_place *p = a, *q = b;
    const int cells = by_cell(a, b);
    return cells                ? cells
           : p->far2 != q->far2 ? (p->far2 > q->far2) - (p->far2 < q->far2)
                                : (p->rho > q->rho) - (p->rho < q->rho);
}

static bool is_beside(const struct sph *s, const double *x, double reach)
{
    return walls_distance(s->walls, x, reach * s->dx) < reach * s->dx;
}

static void add_place(struct gap_places *to, const struct gap_place *is)
{
    ROOM_IN(NULL, to->of, to->n + 1);
    to->of[to->n++] = *is;
}

/* Particles of this level, with those of other ranks, within reach of what may be filled. */
static struct gap_places find_near(const struct sph *s, const double *origin)
{
    struct gap_places near = {0};
    for (int i = 0; i < s->p.n + s->p.nghost; i++) {
        const double *x = prim_line(&s->p, i);
        if (is_beside(s, x, beside + next_to))
            add_place(&near, &(struct gap_place){.cell = {(int)floor((x[0] - origin[0]) / s->dx),
                                                          (int)floor((x[1] - origin[1]) / s->dx)},
                                                 .x = {x[0], x[1]},
                                                 .rho = x[at_rho(2)]});
    }
    if (near.n > 0)
        qsort(near.of, (size_t)near.n, sizeof *near.of, by_cell);
    return near;
}

/* Whether a particle is near the place x of a cell. */
static bool is_taken(const struct gap_places *near, const struct gap_place *is, double reach)
{
    for (int row = is->cell[1] - 1; row <= is->cell[1] + 1; row++) {
        const struct gap_place from = {.cell = {is->cell[0] - 1, row}};
        int lo = 0, hi = near->n;
        while (lo < hi) {
            const int mid = (lo + hi) / 2;
            if (by_cell(near->of + mid, &from) < 0)
                lo = mid + 1;
            else
                hi = mid;
        }
        for (;
             lo < near->n && near->of[lo].cell[1] == row && near->of[lo].cell[0] <= is->cell[0] + 1;
             lo++)
            if (vec_distance2(2, near->of[lo].x, is->x) < reach * reach)
                return true;
    }
    return false;
}

struct gap_filling {
    struct sph *s;
    const struct regions *regions;
    struct exact exact;
    double origin[3], lo[3], hi[3]; /* m: the lattice, this rank's part */
    double still[3];                /* m/s^2: scene_still_gravity */
};

static bool has_water(const struct gap_filling *f, const double *x)
{
    const struct sph *s = f->s;
    for (int a = 0; a < 2; a++)
        if (x[a] < f->lo[a] || x[a] >= f->hi[a])
            return false;
    return regions_distance(f->regions, s->level, x) >= 0.0 && first_in_walls(s, x) &&
           is_beside(s, x, beside) && first_has_room(s, x) &&
           scene_is_fluid(&s->run->scene, &f->exact, x, NULL);
}

/* The empty cells around a particle that no wall parts from it. */
static void look_around(const struct gap_filling *f, const struct gap_places *near,
                        const struct gap_place *from, struct gap_places *to)
{
    const struct sph *s = f->s;
    const double c = eos_c(from->rho, s->rho0, s->c0, s->gamma), reach = next_to * s->dx;
    for (int k = 0; k < 9; k++) {
        struct gap_place is = {.cell = {from->cell[0] + k % 3 - 1, from->cell[1] + k / 3 - 1},
                               .rho = from->rho};
        double way[3] = {0.0, 0.0, 0.0};
        for (int a = 0; a < 2; a++) {
            is.x[a] = f->origin[a] + (is.cell[a] + 0.5) * s->dx;
            way[a] = is.x[a] - from->x[a];
            is.far2 += way[a] * way[a];
            is.rho += from->rho * f->still[a] * way[a] / (c * c);
        }
        if (is.far2 < reach * reach && !is_taken(near, &is, empty * s->dx) && has_water(f, is.x) &&
            walls_meet(s, from->x, way) >= 1.0)
            add_place(to, &is);
    }
}

static void add_particle(struct sph *s, const struct exact *e, const struct gap_place *is)
{
    const int i = first_add(s, e, s->p.next_id, is->x, 1.0);
    double *y = state_row(&s->p, s->p.y, i);
    const double more = is->rho * y[at_volume(2)] / y[at_mass(2)];
    for (int a = 0; a < 2; a++)
        y[2 + a] *= more;
    y[at_mass(2)] *= more;
    s->p.next_id += s->run->size;
    memset(slope_line(&s->p, i), 0, (size_t)s->p.nslope * sizeof(double));
    s->p.role[i] = ROLE_GUARD; /* until it gets its role */
}

/* Fills what is next to particles; the number of all ranks. Cells are dx apart, so that ranks need
 * not know of each other's. */
static int64_t fill_next(const struct gap_filling *f)
{
    struct sph *s = f->s;
    level_prepare(s);
    struct gap_places near = find_near(s, f->origin), to = {0};
    for (int k = 0; k < near.n; k++)
        look_around(f, &near, near.of + k, &to);
    if (to.n > 0)
        qsort(to.of, (size_t)to.n, sizeof *to.of, by_word);
    int64_t n = 0;
    s->p.nghost = 0;
    for (int k = 0; k < to.n; k++)
        if (k == 0 || by_cell(to.of + k, to.of + k - 1) != 0) {
            add_particle(s, &f->exact, to.of + k);
            n++;
        }
    FREE(near.of, to.of);
    s->lists.ready = false;
    return ranks_count(s->run->comm, n);
}

void wall_gaps_fill(struct sph *s)
{
    const struct sph *coarsest = s;
    while (coarsest->coarser)
        coarsest = coarsest->coarser;
    if (s->dim != 2 || !s->walls || s->walls->nsegments == 0 || rooms_parted(s))
        return;
    struct gap_filling f = {
        .s = s, .regions = coarsest->refinement->regions, .exact = exact_create(&s->run->scene)};
    (void)scene_still_gravity(&s->run->scene, f.still);
    for (int a = 0; a < 3; a++) /* nothing where the reference of the pressure has it */
        f.still[a] = s->gravity[a] != 0.0 ? f.still[a] : 0.0;
    for (int a = 0; a < 2; a++)
        f.origin[a] = first_lattice_begin(&s->run->scene, a, s->lo[a], s->hi[a], s->dx);
    domain_bounds(s->domain, f.lo, f.hi);
    for (int k = 0; k < ROUNDS && fill_next(&f) > 0;)
        k++;
}
