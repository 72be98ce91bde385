/* basins.c - water at the start as runs: cells in a row against gravity, one on the other. A run
 * with air above stands under its own top. So a dam has its own head and the tail water its own;
 * where they touch the pressure jumps, as it does when a gate is drawn. A run under a roof (a body,
 * a duct) stands under what its neighbours stand under: one level in a basin, and from one basin to
 * another through a duct the straight line that Laplace's equation wants of a pressure at rest. A
 * water that touches no floor falls, and has no weight.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "basins.h"

#include "../../common/scene/scene.h"
#include "../walls/sph_walls.h"
#include "basin_runs.h"
#include "basins_shut.h"
#include "rooms.h"
#include "surface_rows.h"

/* Parts of fewer cells that walls cut off are no water that could flow. */
enum { LEAST_CELLS = 8 };

/* --- runs and waters --- */

/* Runs go along the axis nearest to gravity at rest; along the last one where there is none. */
static void find_axes(struct basins *b)
{
    double g[3];
    b->g = scene_still_gravity(&b->s->run->scene, g);
    b->up = b->s->dim - 1;
    for (int a = 0; a < b->s->dim; a++)
        if (fabs(g[a]) > fabs(g[b->up]) * (1.0 + 1e-9))
            b->up = a;
    b->sign = g[b->up] > 0.0 ? -1 : 1;
    b->rows = surface_rows_wanted(b->s);
    b->oblique = b->g - fabs(g[b->up]) > 1e-9 * b->g;
    b->across[0] = b->up == 0 ? 1 : 0;
    b->across[1] = b->up == 2 ? 1 : 2;
}

/* A mesh between two filled cells ends a run, too. */
static void find_runs(struct basins *b)
{
    const struct lattice *l = b->l;
    b->columns = l->n[b->across[0]] * l->n[b->across[1]];
    b->start = NEW_IN(b, int, b->columns + 1);
    for (int c = 0; c < b->columns; c++) {
        bool in = false, parted = false;
        b->start[c] = b->nruns;
        for (int k = 0; k < l->n[b->up]; k++) {
            int ic[3];
            basin_cell(b, c, k, ic);
            const int64_t cell = lattice_cell(l, ic);
            const bool has = lattice_has(l, cell);
            if (has && (!in || parted)) {
                ROOM_IN(b, b->runs, b->nruns + 1);
                b->runs[b->nruns] = (struct basin_run){.first = k, .part = b->nruns};
                b->nruns++;
            }
            if (has)
                b->runs[b->nruns - 1].last = k;
            in = has;
            parted = lattice_is_cut(l, cell, b->up);
        }
    }
    b->start[b->columns] = b->nruns;
}

/* The lower number becomes the representative, so that the result does not depend on the order. */
static void join(struct basins *b, int r, int q)
{
    r = basin_part(b, r);
    q = basin_part(b, q);
    b->runs[r > q ? r : q].part = r > q ? q : r;
}

/* Cells of the places where two runs lie side by side that no wall parts. */
static int open_width(const struct basins *b, int column, int beside, int from, int to)
{
    int n = 0;
    for (int k = from; k <= to; k++) {
        int ic[3], jc[3];
        double x[3], y[3];
        basin_cell(b, column, k, ic);
        basin_cell(b, beside, k, jc);
        if (b->l->cut[0]) {
            const int axis = b->across[ic[b->across[0]] == jc[b->across[0]]];
            n += !lattice_is_cut(b->l, lattice_cell(b->l, ic), axis);
            continue;
        }
        lattice_centre(b->l, ic, b->s->dim, x);
        lattice_centre(b->l, jc, b->s->dim, y);
        for (int a = 0; a < 3; a++)
            x[a] = fabs(x[a] - y[a]) > 1.5 * b->l->dx ? x[a] : 0.5 * (x[a] + y[a]);
        n += !b->s->walls || walls_distance(b->s->walls, x, INFINITY) > 0.0;
    }
    return n;
}

/* Cells over which two runs that touch are open to each other. */
static int common_width(const struct basins *b, int r, int q, int column, int beside)
{
    const struct basin_run *A = b->runs + r, *B = b->runs + q;
    return open_width(b, column, beside, A->first > B->first ? A->first : B->first,
                      A->last < B->last ? A->last : B->last);
}

typedef void meet(struct basins *b, int r, int q, int column, int beside);

/* Runs that touch are one water, unless meshes part them all along. */
static void join_runs(struct basins *b, int r, int q, int column, int beside)
{
    if (!b->l->cut[0] || common_width(b, r, q, column, beside) > 0)
        join(b, r, q);
}

/* Links are wanted where one of the two has no top of its own; their widths are conductances. */
static void link_runs(struct basins *b, int r, int q, int column, int beside)
{
    const struct basin_run *A = b->runs + r, *B = b->runs + q;
    if (!A->covered && !B->covered)
        return;
    const int width = common_width(b, r, q, column, beside);
    if (width == 0)
        return;
    if (b->nlinks % 256 == 0)
        GROW_IN(b, b->links, b->nlinks, b->nlinks + 256);
    b->links[b->nlinks++] = (struct basin_link){{r, q}, width};
}

/* Runs of two columns side by side that touch. */
static void each_of_columns(struct basins *b, int c, int d, meet *at)
{
    int r = b->start[c], q = b->start[d];
    while (r < b->start[c + 1] && q < b->start[d + 1]) {
        if (b->runs[r].first <= b->runs[q].last && b->runs[q].first <= b->runs[r].last)
            at(b, r, q, c, d);
        if (b->runs[r].last < b->runs[q].last)
            r++;
        else
            q++;
    }
}

/* Each pair of columns side by side once, over periods, too. */
static void each_meeting(struct basins *b, meet *at)
{
    const struct lattice *l = b->l;
    for (int c = 0; c < b->columns; c++)
        for (int k = 0; k < 2; k++) {
            const int a = b->across[k];
            int ic[3];
            basin_cell(b, c, 0, ic);
            if (++ic[a] == l->n[a]) {
                if (!b->s->periodic[a] || l->n[a] < 2)
                    continue;
                ic[a] = 0;
            }
            each_of_columns(b, c, basin_column(b, ic), at);
        }
}

/* --- roofs and floors --- */

/* The top of a run with air above. Where gravity is along the lattice its upper face, as rows end
 * there: the column weighs what it holds. Else steps of the lattice would be waves of its size:
 * there it is where the shapes end. */
static double top_of(const struct basins *b, const int *ic)
{
    const struct scene *c = &b->s->run->scene;
    double x[3], lo = 0.0, hi = b->l->dx;
    lattice_centre(b->l, ic, b->s->dim, x);
    if (!b->oblique) {
        const double shift = b->rows ? surface_rows_shift(b->s, &b->exact, x, b->up, b->sign) : 0.0;
        return scene_height(c, x) + 0.5 * b->l->dx + b->sign * shift;
    }
    for (int k = 0; k < 40; k++) {
        const double mid = 0.5 * (lo + hi);
        double y[3] = {x[0], x[1], x[2]};
        y[b->up] += b->sign * mid;
        const bool inside = y[b->up] > b->s->lo[b->up] && y[b->up] < b->s->hi[b->up];
        *(inside && scene_is_fluid(c, &b->exact, y, NULL) ? &lo : &hi) = mid;
    }
    x[b->up] += b->sign * lo;
    return scene_height(c, x);
}

/* NAN as level: not known yet, the run is under a roof. */
static void find_tops(struct basins *b)
{
    for (int c = 0; c < b->columns; c++)
        for (int r = b->start[c]; r < b->start[c + 1]; r++) {
            struct basin_run *run = b->runs + r;
            int ic[3];
            basin_cell(b, c, basin_top(b, run), ic);
            run->covered = basin_look(b, ic, b->up, b->sign) == BEYOND_WALL;
            run->level = run->covered ? NAN : top_of(b, ic);
        }
}

/* Whether a run rests on something; under oblique gravity any of its cells may lean on a wall. */
static bool rests(const struct basins *b, int column, const struct basin_run *r)
{
    double g[3];
    int ic[3];
    scene_still_gravity(&b->s->run->scene, g);
    basin_cell(b, column, b->sign > 0 ? r->first : r->last, ic);
    if (basin_look(b, ic, b->up, -b->sign) != BEYOND_AIR)
        return true;
    for (int a = 0; b->oblique && a < b->s->dim; a++)
        for (int k = r->first; a != b->up && fabs(g[a]) > 1e-9 * b->g && k <= r->last; k++) {
            const int way = g[a] > 0.0 ? 1 : -1;
            basin_cell(b, column, k, ic);
            int jc[3] = {ic[0], ic[1], ic[2]};
            jc[a] += way;
            const bool water =
                jc[a] >= 0 && jc[a] < b->l->n[a] && lattice_has(b->l, lattice_cell(b->l, jc));
            if (!water && basin_look(b, ic, a, way) != BEYOND_AIR)
                return true;
        }
    return false;
}

/* --- levels under roofs --- */

/* Highest top of the water, or of the part of it that links hold together, where nothing is open to
 * the air: its lid holds it, and p = 0 is there. */
static void level_of_closed(struct basins *b, const int *group)
{
    double *top = NEW(double, b->nruns);
    for (int r = 0; r < b->nruns; r++)
        top[r] = -INFINITY;
    for (int c = 0; c < b->columns; c++)
        for (int r = b->start[c]; r < b->start[c + 1]; r++) {
            int ic[3];
            double x[3];
            basin_cell(b, c, basin_top(b, b->runs + r), ic);
            lattice_centre(b->l, ic, b->s->dim, x);
            top[group[r]] =
                fmax(top[group[r]], scene_height(&b->s->run->scene, x) + 0.5 * b->l->dx);
        }
    for (int r = 0; r < b->nruns; r++)
        if (isnan(b->runs[r].level))
            b->runs[r].level = top[group[r]];
    mem_free(top);
}

/* y = A x of the links' Laplacian over runs with free[r]; others count as given. */
static void laplacian(const struct basins *b, const bool *is_free, const double *x, double *y)
{
    memset(y, 0, (size_t)b->nruns * sizeof *y);
    for (int k = 0; k < b->nlinks; k++) {
        const int r = b->links[k].run[0], q = b->links[k].run[1];
        const double flux = b->links[k].width * (x[r] - x[q]);
        y[r] += is_free[r] ? flux : 0.0;
        y[q] -= is_free[q] ? flux : 0.0;
    }
}

/* Conjugate gradients: x of the free runs such that the Laplacian vanishes there. */
static void relax(const struct basins *b, const bool *is_free, double *x)
{
    const int n = b->nruns;
    double *r = NEW(double, n), *p = NEW(double, n), *Ap = NEW(double, n), rr = 0.0, first;
    laplacian(b, is_free, x, r);
    for (int i = 0; i < n; i++) {
        r[i] = -r[i];
        p[i] = r[i];
        rr += r[i] * r[i];
    }
    first = rr;
    for (int k = 0; k < 2 * n + 10 && rr > 1e-24 * first && rr > 0.0; k++) {
        double pAp = 0.0, old = rr;
        laplacian(b, is_free, p, Ap);
        for (int i = 0; i < n; i++)
            pAp += p[i] * Ap[i];
        if (!(pAp > 0.0))
            break;
        rr = 0.0;
        for (int i = 0; i < n; i++) {
            x[i] += old / pAp * p[i];
            r[i] -= old / pAp * Ap[i];
        }
        for (int i = 0; i < n; i++)
            rr += r[i] * r[i];
        for (int i = 0; i < n; i++)
            p[i] = r[i] + rr / old * p[i];
    }
    FREE(r, p, Ap);
}

/* Groups of runs that links hold together; returns by group[r] the least run of each. */
static int *find_groups(const struct basins *b)
{
    int *group = NEW(int, b->nruns);
    for (int r = 0; r < b->nruns; r++)
        group[r] = r;
    for (bool more = true; more;) {
        more = false;
        for (int k = 0; k < b->nlinks; k++) {
            const int r = b->links[k].run[0], q = b->links[k].run[1];
            const int least = group[r] < group[q] ? group[r] : group[q];
            more = more || group[r] != least || group[q] != least;
            group[r] = group[q] = least;
        }
    }
    return group;
}

/* Levels of covered runs; those of groups without any open top by their own highest. */
static void find_levels(struct basins *b)
{
    each_meeting(b, link_runs);
    int *group = find_groups(b);
    bool *open = NEW(bool, b->nruns), *is_free = NEW_IN(b, bool, b->nruns);
    double *x = NEW(double, b->nruns), *mean = NEW_IN(b, double, 2 * (size_t)b->nruns);
    for (int r = 0; r < b->nruns; r++)
        if (!b->runs[r].covered) {
            open[group[r]] = true;
            mean[2 * group[r]] += b->runs[r].level;
            mean[2 * group[r] + 1] += 1.0;
        }
    for (int r = 0; r < b->nruns; r++) { /* the first guess: the mean of the open tops around */
        is_free[r] = b->runs[r].covered && open[group[r]];
        x[r] = is_free[r]           ? mean[2 * group[r]] / mean[2 * group[r] + 1]
               : b->runs[r].covered ? 0.0
                                    : b->runs[r].level;
    }
    relax(b, is_free, x);
    for (int r = 0; r < b->nruns; r++)
        if (is_free[r])
            b->runs[r].level = x[r];
    level_of_closed(b, group);
    FREE(group, open, is_free, x, mean);
}

/* What touches no floor falls: no level. */
static void find_falling(struct basins *b)
{
    bool *rest = NEW(bool, b->nruns);
    for (int c = 0; c < b->columns; c++)
        for (int r = b->start[c]; r < b->start[c + 1]; r++) {
            const int part = basin_part(b, r);
            rest[part] = rest[part] || rests(b, c, b->runs + r);
        }
    for (int r = 0; r < b->nruns; r++)
        if (!rest[basin_part(b, r)])
            b->runs[r].level = NAN;
    mem_free(rest);
}

/* --- pockets --- */

/* Whether a wall took away water that the shapes have beside cell ic, or parts it from there. */
static bool is_cut(const struct basins *b, const int *ic)
{
    for (int a = 0; a < b->s->dim; a++)
        for (int way = -1; way <= 1; way += 2) {
            int jc[3] = {ic[0], ic[1], ic[2]};
            double x[3];
            jc[a] += way;
            if (jc[a] < 0 || jc[a] >= b->l->n[a])
                continue;
            if (lattice_is_cut(b->l, lattice_cell(b->l, way > 0 ? ic : jc), a))
                return true;
            if (lattice_has(b->l, lattice_cell(b->l, jc)))
                continue;
            lattice_centre(b->l, jc, b->s->dim, x);
            if (scene_is_fluid(&b->s->run->scene, &b->exact, x, NULL))
                return true;
        }
    return false;
}

/* Cells of each part, at its representative. */
static int64_t *count_cells(struct basins *b)
{
    int64_t *cells = NEW(int64_t, b->nruns);
    for (int r = 0; r < b->nruns; r++)
        cells[basin_part(b, r)] += b->runs[r].last - b->runs[r].first + 1;
    return cells;
}

/* Counts pockets and marks their runs; the largest part of all is never one. */
static void drop_pockets(struct basins *b)
{
    int64_t *cells = count_cells(b), most = 0;
    bool *cut = NEW(bool, b->nruns);
    for (int r = 0; r < b->nruns; r++) {
        const bool dry = b->runs[basin_part(b, r)].dropped;
        most = !dry && cells[basin_part(b, r)] > most ? cells[basin_part(b, r)] : most;
    }
    for (int c = 0; c < b->columns; c++)
        for (int r = b->start[c]; r < b->start[c + 1]; r++)
            for (int k = b->runs[r].first; k <= b->runs[r].last; k++) {
                const int part = basin_part(b, r);
                int ic[3];
                basin_cell(b, c, k, ic);
                if (cells[part] < LEAST_CELLS && cells[part] < most && !cut[part] &&
                    is_cut(b, ic)) {
                    cut[part] = true;
                    lattice_centre(b->l, ic, b->s->dim, b->where);
                }
            }
    for (int r = 0; r < b->nruns; r++) {
        const int part = basin_part(b, r);
        if (b->runs[r].dropped) /* dry already */
            continue;
        b->runs[r].dropped = cut[part];
        b->pockets += r == part && cut[part];
        b->lost += r == part && cut[part] ? cells[part] : 0;
    }
    FREE(cells, cut);
}

/* --- rooms that meshes part --- */

/* Samples of each part: the place that is farthest from meshes. */
struct sample {
    int64_t seen;
    double distance, x[3];
};

/* Of each part about SAMPLES cells evenly among its cells, in the order of runs. */
static void find_middles(struct basins *b, const int64_t *cells, struct sample *of)
{
    enum { SAMPLES = 64 };
    for (int c = 0; c < b->columns; c++)
        for (int r = b->start[c]; r < b->start[c + 1]; r++)
            for (int k = b->runs[r].first; k <= b->runs[r].last; k++) {
                const int part = basin_part(b, r);
                struct sample *to = of + part;
                int ic[3];
                double x[3];
                if (to->seen++ % (1 + cells[part] / SAMPLES) != 0)
                    continue;
                basin_cell(b, c, k, ic);
                lattice_centre(b->l, ic, 3, x);
                const double d = rooms_distance(b->s, x, INFINITY);
                if (d > to->distance) {
                    to->distance = d;
                    memcpy(to->x, x, sizeof x);
                }
            }
}

/* The part of a seed: of its cell or of one beside that no mesh parts from it. */
static int part_at(struct basins *b, const double *seed)
{
    for (int k = 0; k < 27; k++) { /* its own first */
        const int way = (k + 13) % 27;
        const double dx = b->l->dx,
                     near[3] = {seed[0] + dx * (way % 3 - 1), seed[1] + dx * (way / 3 % 3 - 1),
                                seed[2] + dx * (way / 9 - 1)};
        const int64_t cell = lattice_find(b->l, 3, near);
        double x[3];
        if (cell < 0 || !lattice_has(b->l, cell))
            continue;
        lattice_place(b->l, cell, 3, x);
        if (!rooms_crossed(b->s, seed, x))
            return basin_part(b, (int)(basin_run_at(b, cell) - b->runs));
    }
    return -1;
}

/* By the seeds, or where there are none by the side of the meshes; the ranks share the parts. */
static void find_wet(struct basins *b, const int64_t *cells, unsigned char *wet)
{
    const struct param_places *seed = &b->s->run->scene.initial.seed;
    struct sample *of = NEW(struct sample, b->nruns);
    for (int k = 0; k < seed->n; k++) {
        const int part = part_at(b, seed->x[k]);
        if (part < 0)
            fail_with(RUN_INPUT,
                      "initial.seed (%g, %g, %g) m: no fluid is there; put it where the shapes "
                      "have some, a little away from walls",
                      seed->x[k][0], seed->x[k][1], seed->x[k][2]);
        wet[part] = 1;
    }
    if (seed->n == 0)
        find_middles(b, cells, of);
    for (int r = 0, n = 0; seed->n == 0 && r < b->nruns; r++)
        if (b->runs[r].part == r && n++ % b->s->run->size == b->s->run->rank)
            wet[r] = cells[r] < LEAST_CELLS ? rooms_are_before(b->s, of[r].x)
                                            : rooms_are_wet(b->s, of[r].x);
    MPI_Allreduce(MPI_IN_PLACE, wet, b->nruns, MPI_UNSIGNED_CHAR, MPI_BOR, b->s->run->comm);
    mem_free(of);
}

/* Fluid on both sides of a surface that has but one. */
static void refuse_sheets(struct basins *b)
{
    for (int64_t cell = 0; cell < lattice_cells(b->l); cell++)
        for (int a = 0; a < 3; a++) {
            int ic[3], jc[3];
            double x[3], y[3];
            if (!lattice_is_cut(b->l, cell, a))
                continue;
            lattice_indices(b->l, cell, ic);
            lattice_centre(b->l, ic, 3, x);
            memcpy(y, x, sizeof y);
            y[a] += b->l->dx;
            lattice_next(b->l, ic, a, b->s->periodic, jc);
            const struct basin_run *r = basin_run_at(b, cell),
                                   *q = basin_run_at(b, lattice_cell(b->l, jc));
            if (!r->dropped && !q->dropped &&
                basin_part(b, (int)(r - b->runs)) == basin_part(b, (int)(q - b->runs)))
                rooms_refuse_sheet(b->s, x, y);
        }
}

/* Rooms on the wrong side of the meshes hold no fluid. */
static void drop_dry(struct basins *b)
{
    int64_t *cells = count_cells(b);
    unsigned char *wet = NEW(unsigned char, b->nruns);
    int64_t counts = 0; /* the water may be one drop */
    find_wet(b, cells, wet);
    for (int r = 0; r < b->nruns; r++)
        if (r == basin_part(b, r) && wet[r] && cells[r] > counts)
            counts = cells[r] < LEAST_CELLS ? cells[r] : LEAST_CELLS;
    for (int r = 0; r < b->nruns; r++) {
        const int part = basin_part(b, r);
        b->runs[r].dropped = !wet[part];
        b->wet += r == part && wet[part] && cells[part] >= counts;
        b->dry += r == part && !wet[part] && cells[part] >= LEAST_CELLS;
    }
    FREE(cells, wet);
    refuse_sheets(b);
}

/* Rooms first, as pockets are counted among wet ones; levels last, of what is left. */
struct basins *basins_create(const struct sph *s, const struct lattice *l)
{
    struct basins *b = NEW(struct basins, 1);
    b->s = s;
    b->l = l;
    b->exact = exact_create(&s->run->scene);
    find_axes(b);
    find_runs(b);
    each_meeting(b, join_runs);
    if (l->cut[0])
        drop_dry(b);
    drop_pockets(b);
    if (b->g > 0.0) {
        find_tops(b);
        find_levels(b);
        find_falling(b);
    }
    basins_find_shut(b);
    return b;
}

/* The whole loop is left out where nothing was dropped. */
void basins_clear(const struct basins *b, struct lattice *l)
{
    for (int c = 0; c < b->columns && b->pockets + (l->cut[0] != NULL) > 0; c++)
        for (int r = b->start[c]; r < b->start[c + 1]; r++)
            for (int k = b->runs[r].first; b->runs[r].dropped && k <= b->runs[r].last; k++) {
                int ic[3];
                basin_cell(b, c, k, ic);
                lattice_clear(l->bits, lattice_cell(l, ic));
            }
}

double basins_level(const struct basins *b, int64_t cell) { return basin_run_at(b, cell)->level; }

void basins_rooms(const struct basins *b, int *wet, int *dry)
{
    *wet = b->wet;
    *dry = b->dry;
}

/* How far the highest roof stands above the level that its water has, m; where: its place. */
double basins_suction(const struct basins *b, double *where)
{
    double most = 0.0;
    for (int c = 0; c < b->columns; c++)
        for (int r = b->start[c]; r < b->start[c + 1]; r++) {
            const struct basin_run *run = b->runs + r;
            int ic[3];
            double x[3];
            if (!run->covered || run->dropped || isnan(run->level))
                continue;
            basin_cell(b, c, basin_top(b, run), ic);
            lattice_centre(b->l, ic, b->s->dim, x);
            const double over = scene_height(&b->s->run->scene, x) + 0.5 * b->l->dx - run->level;
            if (over > most) {
                most = over;
                memcpy(where, x, sizeof x);
            }
        }
    return most;
}

int basins_pockets(const struct basins *b, int64_t *cells, double *where)
{
    *cells = b->lost;
    memcpy(where, b->where, sizeof b->where);
    return b->pockets;
}
