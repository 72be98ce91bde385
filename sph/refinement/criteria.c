/* criteria.c - see criteria.h. Indicators of level n are made with dx of level n - 1 wherever they
 * are read, so that they do not depend on how fine a place is already. Order of an evaluation:
 * criteria_begin clears the cells, criteria_add enters particles (this rank), criteria_end reduces
 * over ranks and decides. With r = indicator/bound in a cell, it is refined if r > factor, and once
 * refined stays while 3 r > factor or 20 R/c0 have not passed. factor >= 1 is found by bisection so
 * that the forecast of particles stays within the budget; each trial marks all levels anew,
 * O(cells).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "criteria.h"

#include "../../common/files/files.h"
#include "regions_parts.h"

/* Mark, depth, value, until, surface, seed, units and allowed are 29 bytes a cell: 2^25 cells are 1
 * GB on every rank, 2^30 would be more than a rank can hold. */
#define CELLS_MOST 33554432.0

struct criteria_grid {
    struct marks cells;
    double *value; /* [cells] largest indicator over its bound, of this evaluation */
    double *until; /* [cells] s: kept at least until then */
    unsigned char *surface, *seed; /* [cells] holds the surface now; is refined for itself */
    int64_t *units;                /* [cells] fluid outside of fixed regions, see UNITS */
    unsigned char *allowed;        /* [cells] far enough from open sides */
};

/* Volumes are summed as integers, so that sums do not depend on the ranks. */
#define UNITS 1024.0

struct criteria {
    int levels;
    struct criteria_grid grid[APR_LEVELS_MAX + 1];
    double speed, gravity;                    /* m/s, largest so far; m/s^2 */
    double next;                              /* s: of the next evaluation */
    double factor;                            /* on all bounds */
    double forecast;                          /* particles */
    bool told;                                /* that the budget leaves nothing */
    int64_t fluid, fixed[APR_LEVELS_MAX + 1]; /* units: all; within fixed regions of a level */
};

/* Volume, m^dim, of a unit of fluid: 1/UNITS of a particle of the finest level. */
static double unit(const struct regions *g)
{
    return pow(ldexp(g->dx, -g->prm->levels), g->dim) / UNITS;
}

/* Particles of level n in so many units of fluid. */
static double particles_of(const struct regions *g, int n, double units)
{
    return units * unit(g) / pow(ldexp(g->dx, -n), g->dim);
}

/* --- life --- */

/* Cells whose guards would come into the zones at open sides are not marked. A cell is allowed if
 * it ends before the depth that the level may reach (regions_allowed). */
static void allow(struct regions *g, int n)
{
    struct criteria_grid *q = g->criteria->grid + n;
    const struct marks *c = &q->cells;
    for (size_t k = 0; k < marks_count(c); k++) {
        const size_t at[3] = {k % (size_t)c->n[0], k / (size_t)c->n[0] % (size_t)c->n[1],
                              k / ((size_t)c->n[0] * (size_t)c->n[1])};
        bool in = true;
        for (int a = 0; a < g->dim; a++) {
            const double lo = c->lo[a] + (double)at[a] * c->h[a];
            in = in && lo >= regions_allowed(g, n, 2 * a) - g->near &&
                 lo + c->h[a] <= regions_allowed(g, n, 2 * a + 1) + g->near;
        }
        q->allowed[k] = in;
    }
}

/* Cells are as wide as R of the level outside, in which guards lie at the edge. */
struct criteria *criteria_create(struct regions *g)
{
    int levels = 0;
    for (int k = 0; k < g->prm->criteria.n; k++)
        levels = g->prm->criteria.of[k].level > levels ? g->prm->criteria.of[k].level : levels;
    if (levels == 0)
        return NULL;
    struct criteria *c = g->criteria = NEW_IN(g, struct criteria, 1);
    c->levels = levels;
    c->factor = 1.0;
    c->next = -INFINITY;
    for (int n = 1; n <= levels; n++) {
        struct criteria_grid *q = c->grid + n;
        if (!marks_create(c, &q->cells, g->dim, g->domain.lo, g->domain.hi, g->periodic, g->open,
                          regions_R(g, n - 1), CELLS_MOST))
            abort_run("criteria of level %d need more than %g cells", n, CELLS_MOST);
        const size_t cells = marks_count(&q->cells);
        q->value = NEW_IN(c, double, cells);
        q->until = NEW_IN(c, double, cells);
        q->surface = NEW_IN(c, unsigned char, cells);
        q->seed = NEW_IN(c, unsigned char, cells);
        q->units = NEW_IN(c, int64_t, cells);
        q->allowed = NEW_IN(c, unsigned char, cells);
        g->level[n].cells = &q->cells;
        allow(g, n);
    }
    return c;
}

/* --- what particles say --- */

bool criteria_due(const struct regions *g, double t)
{
    return g->criteria && t >= g->criteria->next;
}

bool criteria_want_jumps(const struct regions *g)
{
    bool any = false;
    for (int k = 0; k < g->prm->criteria.n; k++)
        any = any || g->prm->criteria.of[k].kind == CRITERION_JUMP;
    return any;
}

double criteria_factor(const struct regions *g) { return g->criteria ? g->criteria->factor : 1.0; }
double criteria_forecast(const struct regions *g)
{
    return g->criteria ? g->criteria->forecast : 0;
}

/* speed is the largest so far, so that criteria do not refine everything as a flow comes to
 * rest. */
void criteria_begin(struct regions *g, double speed, double gravity)
{
    struct criteria *c = g->criteria;
    c->speed = fmax(c->speed, speed);
    c->gravity = gravity;
    c->fluid = 0;
    memset(c->fixed, 0, sizeof c->fixed);
    for (int n = 1; n <= c->levels; n++) {
        struct criteria_grid *q = c->grid + n;
        const size_t cells = marks_count(&q->cells);
        memset(q->value, 0, cells * sizeof *q->value);
        memset(q->surface, 0, cells);
        memset(q->units, 0, cells * sizeof *q->units);
    }
}

/* Indicator over its bound; dx: m, of the level below. vorticity: |curl u| dx/(U above); pressure:
 * |grad p| dx/(rho max(u^2, g dx) above); jump: dp/(the same). 0 where there is no scale. */
static double ratio(const struct criteria *c, const struct apr_criterion *is, double dx,
                    const struct flow_sample *s)
{
    const double head = s->rho * fmax(s->speed * s->speed, c->gravity * dx);
    switch (is->kind) {
    case CRITERION_VORTICITY:
        return c->speed > 0.0 ? s->curl * dx / (c->speed * is->above) : 0.0;
    case CRITERION_PRESSURE:
        return head > 0.0 ? s->slope * dx / (head * is->above) : 0.0;
    case CRITERION_JUMP:
        return head > 0.0 ? s->jump / (head * is->above) : 0.0;
    default:
        return 0.0;
    }
}

/* Enters particle at x, of `units' of fluid, for level n: criteria of finer levels ask for this one
 * too. */
static void add_to_level(struct regions *g, int n, const double *x, const struct flow_sample *is,
                         int64_t units)
{
    struct criteria *c = g->criteria;
    struct criteria_grid *q = c->grid + n;
    const size_t cell = marks_find(&q->cells, x);
    const double dx = ldexp(g->dx, 1 - n);
    for (int k = 0; k < g->prm->criteria.n; k++) {
        const struct apr_criterion *one = g->prm->criteria.of + k;
        if (one->level >= n)
            q->value[cell] = fmax(q->value[cell], ratio(c, one, dx, is));
    }
    q->surface[cell] |= is->on_surface;
    if (regions_fixed_distance(g, n, x) > 0.0)
        c->fixed[n] += units;
    else
        q->units[cell] += units;
}

/* Fluid within fixed regions is counted apart, since it is refined in any case. */
void criteria_add(struct regions *g, const double *x, const struct flow_sample *is)
{
    const int64_t units = llround(is->volume / unit(g));
    g->criteria->fluid += units;
    for (int n = 1; n <= g->criteria->levels; n++)
        add_to_level(g, n, x, is, units);
    for (int n = g->criteria->levels + 1; n <= g->prm->levels; n++)
        if (regions_fixed_distance(g, n, x) > 0.0)
            g->criteria->fixed[n] += units;
}

/* --- what is made of it --- */

/* Widest distance from the surface that a criterion asks of level n, R; < 0: none does. */
static double surface_distance(const struct regions *g, int n)
{
    double d = -1.0;
    for (int k = 0; k < g->prm->criteria.n; k++) {
        const struct apr_criterion *is = g->prm->criteria.of + k;
        if (is->kind == CRITERION_SURFACE && is->level >= n)
            d = fmax(d, is->distance);
    }
    return d;
}

/* Cells near the surface count as much above their bound as they are nearer than it asks for. k = 0
 * is the cell with the surface itself; each dilation is one cell, R of the coarser level, further
 * away. */
static void add_surface(const struct regions *g, int n)
{
    struct criteria_grid *q = g->criteria->grid + n;
    const size_t cells = marks_count(&q->cells);
    const int width = (int)ceil(surface_distance(g, n));
    if (surface_distance(g, n) < 0.0)
        return;
    for (int k = 0; k <= width; k++) {
        for (size_t i = 0; i < cells; i++)
            if (q->surface[i])
                q->value[i] = fmax(q->value[i], (width + 2.0) / (k + 1.0));
        if (k < width)
            marks_dilate(&q->cells, q->surface, 1);
    }
}

/* Whether a cell is refined for itself at this factor: above the bound, or, with patience, refined
 * before and not yet released. */
static bool is_kept(const struct criteria_grid *q, size_t i, double factor, double t, bool patient)
{
    if (q->value[i] > factor)
        return true;
    return patient && q->seed[i] && (3.0 * q->value[i] > factor || t < q->until[i]);
}

/* Marks of all levels for this factor on the bounds, from the finest; returns the particles.
 * Coarser levels cover the finer ones with the margin, so that levels stay nested. The forecast
 * counts parents that stay as guards as well: every level holds all fluid of its region. */
static double mark_all(struct regions *g, double factor, double t, bool patient)
{
    struct criteria *c = g->criteria;
    double sum = particles_of(g, 0, (double)c->fluid);
    for (int n = g->prm->levels; n > c->levels; n--)
        sum += particles_of(g, n, (double)c->fixed[n]);
    for (int n = c->levels; n >= 1; n--) {
        struct criteria_grid *q = c->grid + n;
        const size_t cells = marks_count(&q->cells);
        for (size_t i = 0; i < cells; i++)
            q->cells.mark[i] = is_kept(q, i, factor, t, patient);
        marks_dilate(&q->cells, q->cells.mark, g->prm->around);
        if (n < c->levels)
            marks_cover(&q->cells, &c->grid[n + 1].cells, (int)ceil(g->prm->margin));
        int64_t units = c->fixed[n];
        for (size_t i = 0; i < cells; i++) {
            q->cells.mark[i] &= q->allowed[i];
            units += q->cells.mark[i] ? q->units[i] : 0;
        }
        sum += particles_of(g, n, (double)units);
    }
    return sum;
}

/* The least factor >= 1 that keeps the budget; without patience what was refined is kept no longer
 * than it is asked for. Quadruples until it fits, then halves the interval 12 times in the
 * logarithm, to 0.03 %. INFINITY: not even 1e6 does. */
static double find_factor(struct regions *g, double t, bool patient)
{
    const double budget = CRITERIA_SHARE * g->prm->particles;
    double low = 1.0, high = 1.0;
    if (g->prm->particles <= 0.0 || mark_all(g, 1.0, t, patient) <= budget)
        return 1.0;
    while (high < 1e6) {
        high *= 4.0;
        if (mark_all(g, high, t, patient) <= budget)
            break;
        low = high;
    }
    if (high >= 1e6)
        return INFINITY;
    for (int k = 0; k < 12; k++) {
        const double mid = sqrt(low * high);
        if (mark_all(g, mid, t, patient) <= budget)
            high = mid;
        else
            low = mid;
    }
    return high;
}

/* Largest of the indicators and sums of all ranks. Sums are of integers, so that all ranks decide
 * alike whatever their number. */
static void reduce(struct regions *g)
{
    struct criteria *c = g->criteria;
    MPI_Comm comm = g->run->comm;
    MPI_Allreduce(MPI_IN_PLACE, &c->fluid, 1, MPI_INT64_T, MPI_SUM, comm);
    MPI_Allreduce(MPI_IN_PLACE, c->fixed, APR_LEVELS_MAX + 1, MPI_INT64_T, MPI_SUM, comm);
    for (int n = 1; n <= c->levels; n++) {
        struct criteria_grid *q = c->grid + n;
        const int cells = (int)marks_count(&q->cells);
        MPI_Allreduce(MPI_IN_PLACE, q->value, cells, MPI_DOUBLE, MPI_MAX, comm);
        MPI_Allreduce(MPI_IN_PLACE, q->surface, cells, MPI_UNSIGNED_CHAR, MPI_MAX, comm);
        MPI_Allreduce(MPI_IN_PLACE, q->units, cells, MPI_INT64_T, MPI_SUM, comm);
    }
}

/* Seeds of this evaluation, and how long they stay. 20 R/c0 is the time that sound takes across 20
 * supports of the coarser level. */
static void remember(struct regions *g, double t, double sound, bool patient)
{
    struct criteria *c = g->criteria;
    for (int n = 1; n <= c->levels; n++) {
        struct criteria_grid *q = c->grid + n;
        const double life = 20.0 * regions_R(g, n - 1) / sound;
        for (size_t i = 0; i < marks_count(&q->cells); i++) {
            q->seed[i] = is_kept(q, i, c->factor, t, patient);
            if (q->value[i] > c->factor)
                q->until[i] = t + life;
        }
        marks_measure(&q->cells);
    }
}

/* Whether any cell of level 1 is marked, or asks for it. */
static bool any_cell(const struct criteria_grid *q, bool asks)
{
    bool any = false;
    for (size_t i = 0; i < marks_count(&q->cells) && !any; i++)
        any = asks ? q->value[i] > 1.0 && q->allowed[i] : q->cells.mark[i];
    return any;
}

/* Warns once if the budget keeps criteria from refining anything at all. */
static void tell_budget(struct regions *g, double t, double wanted)
{
    struct criteria *c = g->criteria;
    if (c->told || c->factor <= 1.0 || any_cell(c->grid + 1, false) || !any_cell(c->grid + 1, true))
        return;
    c->told = true;
    log_warn("t = %.4g s: criteria ask for refinement that takes about %.0f particles of all "
             "levels, and the least of it is too much for apr.particles = %.0f: nothing is "
             "refined by them; give more, fewer levels or a smaller apr.around",
             t, wanted, g->prm->particles);
}

/* With patience first; if the budget then cannot be kept at all, cells that were refined before are
 * given up at once. The next evaluation is due after half the time that sound takes across R. */
void criteria_end(struct regions *g, double t, double sound)
{
    struct criteria *c = g->criteria;
    reduce(g);
    for (int n = 1; n <= c->levels; n++)
        add_surface(g, n);
    bool patient = true;
    const double wanted = mark_all(g, 1.0, t, false);
    c->factor = find_factor(g, t, patient);
    if (c->factor == INFINITY) {
        patient = false;
        c->factor = find_factor(g, t, patient);
    }
    c->forecast = mark_all(g, c->factor, t, patient);
    tell_budget(g, t, wanted);
    remember(g, t, sound, patient);
    c->next = t + 0.5 * regions_R(g, c->levels - 1) / sound * (1.0 - 1e-9);
}

/* --- restart --- */

/* false: the file has none for this grid. */
static bool keep_level(struct criteria_grid *q, int n, struct h5 *f)
{
    const size_t cells = marks_count(&q->cells);
    double(*row)[3] = mem_new(cells, sizeof *row);
    for (size_t i = 0; i < cells; i++) {
        row[i][0] = q->cells.mark[i];
        row[i][1] = q->seed[i];
        row[i][2] = q->until[i];
    }
    const bool fits = h5_keep_rows(f, key_text("apr_cells_%d", n), "-", (int64_t)cells, 3, row[0]);
    for (size_t i = 0; !h5_writes(f) && i < cells && fits; i++) {
        q->cells.mark[i] = row[i][0] > 0.0;
        q->seed[i] = row[i][1] > 0.0;
        q->until[i] = row[i][2];
    }
    mem_free(row);
    if (!h5_writes(f))
        marks_measure(&q->cells);
    return fits;
}

/* The forecast is not kept; it comes with the next evaluation. */
bool criteria_restart(struct regions *g, struct h5 *f)
{
    struct criteria *c = g->criteria;
    if (!c)
        return true;
    bool fits = h5_keep(f, "apr_next", &c->next) && h5_keep(f, "apr_factor", &c->factor) &&
                h5_keep(f, "apr_speed", &c->speed);
    for (int n = 1; n <= c->levels; n++)
        fits = keep_level(c->grid + n, n, f) && fits;
    return fits;
}
