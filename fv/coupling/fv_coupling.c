/* fv_coupling.c - FV's place in a coupled job: its free zone's partner fills a hole, and takes
 * patches of velocity and pressure with their course in time. In window_begin FV tells what it
 * expects of the coupling step (fv_course.h), then waits for the forced velocities at its end.
 * SPDX-License-Identifier: BSD-3-Clause */

#include "../../common/files/files.h"
#include "../../common/run/run.h"
#include "../../coupler/cpl_partner.h"
#include "../boundary/fv_boundary.h"
#include "../grid/fv_grid.h"
#include "../surface/fv_surface.h"
#include "forced_points.h"
#include "forced_restart.h"
#include "fv_course.h"
#include "fv_link.h"
#include "mean_velocity.h"
#include "moved_box.h"
#include "shared_walls.h"
#include "water_budget.h"

/* One program of particles. */
struct source {
    char name[64]; /* "sph", "sph_left" */
    int forced, imposed, seen;
    int place, way;     /* of a box that moves: one point; how far it is from its start */
    int places, filled; /* where the surface crosses into its part: a kernel filled by its water */
    int budget, water;  /* one point; its water and drops */
    bool moves;
    double given[2][3], free[2][3]; /* m: what it gives, its free zone, at the start */
    double box[2][3];               /* m: and all of it, with its zones */
    double fastest;                 /* m/s: as fast as its box will be */
    double stands[3];               /* m: of the box whose cells are forced now */
    double moved[9]; /* m: how far it has moved last; the box that it counts as its own then */
};

struct link {
    struct cpl *c;
    int n;       /* sources */
    double seen; /* m: seen_size at the start */
    double wish; /* s: window in which no box passes a cell of blocks */
    struct source of[PARTNERS_MAX];
    int grid, velocity, pressure;
    bool knows_mean; /* mean_velocity_is_known */
    bool has_moved;  /* some box, once */
    char lost[256];  /* why its place is none for FV; "": it is one */
    struct water_budget of_water;
    int phi;                      /* where the surface crosses into a source's part */
    double *share, *share_of_one; /* of a kernel that the sources' water fills, at the places */
    struct patch patch;
    struct course *course;
    void *room; /* owns what follows, which depends on the cells */
    struct forced_points points;
    double *got, *one;    /* scratch: velocities, pressures of one source at the points */
    double *mean, *level; /* the same of the cells */
    unsigned char *whose, *has;
    double *p;             /* Pa: the partner's at the end of the window, where mask is 1 */
    unsigned char *mask;   /* some source has particles there */
    struct watch unmapped; /* share of the cells that fluxes look at which the partner left out */
    double missing;        /* now */
    double where[3];       /* m: one of them */
};

/* m: edge of the cell whose average the kernel is. Of blocks that of the largest one that the
 * partner gives. */
static double seen_size(const struct fv *s)
{
    const struct forcing *f = s->forcing;
    double h = 0.0;
    for (int a = 0; a < s->b.dim && !s->m; a++)
        h = fmax(h, s->b.h[a]);
    for (int64_t i = 0; s->m && i < f->npartner; i++)
        h = fmax(h, pow(grid_volume(&s->grid, f->partner[i]), 1.0 / s->dim));
    return s->m ? ranks_max(s->comm, h) : h;
}

/* m: least height of the cells of blocks that the partner gives. */
static double least_height(const struct fv *s)
{
    const struct forcing *f = s->forcing;
    double h = INFINITY;
    for (int64_t i = 0; i < f->npartner; i++)
        for (int a = 0; a < s->dim; a++) {
            const int64_t c = f->partner[i];
            h = fmin(h, grid_volume(&s->grid, c) / grid_face_area(&s->grid, c, a));
        }
    return ranks_min(s->comm, h);
}

/* Width of the kernel whose mean has the second moment of a cell average: sqrt(6/5) h in 2D,
 * sqrt(5/4) h in 3D. A sum over particles then gives the cell's average up to fourth order. */
static double support(const struct fv *s, double h) { return h * sqrt(s->dim == 2 ? 1.2 : 1.25); }

/* A name of a set or a field: "fv.forced" and "sph_left" give "fv.forced_left", "sph.velocity"
 * "sph_left.velocity". */
static const char *named(const struct source *g, const char *own, const char *name)
{
    static char text[2][CPL_NAME + 64];
    static int turn;
    char *to = text[turn = 1 - turn];
    if (own)
        snprintf(to, sizeof *text, "%s%.60s", own, g->name + 3);
    else
        snprintf(to, sizeof *text, "%.63s.%s", g->name, name);
    return to;
}

static void find_zone(const struct link *k, const struct source *g, const char *zone, double lo[3],
                      double hi[3])
{
    partner_check(k->c, cpl_find_zone(k->c, named(g, NULL, zone), lo, hi));
}

/* Two fields at the places of the imposed cells, and of a box that moves its way at one place. */
static void declare_source(struct fv *s, struct link *k, struct source *g, int how)
{
    partner_check(
        k->c, cpl_points(k->c, named(g, "fv.forced", ""), s->dim, support(s, k->seen), &g->forced));
    partner_check(k->c, cpl_field(k->c, g->forced, named(g, NULL, "velocity"), "m/s", s->dim,
                                  CPL_GET, how, &g->imposed));
    partner_check(k->c, cpl_field(k->c, g->forced, named(g, NULL, "pressure"), "Pa", 1, CPL_GET,
                                  how, &g->seen));
    if (!g->moves)
        return;
    partner_check(k->c, cpl_points(k->c, named(g, "fv.place", ""), s->dim, k->seen, &g->place));
    partner_check(k->c, cpl_field(k->c, g->place, named(g, NULL, "way"), "m", 9, CPL_GET,
                                  CPL_NEAREST, &g->way));
}

/* Where the partner's water is, at places that a kernel fills, and how much it is, at one place. */
static void declare_water(struct fv *s, struct link *k, int q)
{
    struct source *g = k->of + q;
    partner_check(k->c, cpl_points(k->c, named(g, "fv.surface", ""), s->dim, s->surface->forced->R,
                                   &g->places));
    partner_check(k->c, cpl_field(k->c, g->places, named(g, NULL, "one"), "-", 1, CPL_GET, CPL_SUM,
                                  &g->filled));
    partner_check(k->c, cpl_points(k->c, named(g, "fv.budget", ""), s->dim, k->seen, &g->budget));
    partner_check(k->c, cpl_field(k->c, g->budget, named(g, NULL, "water"), "m^dim", 2, CPL_GET,
                                  CPL_NEAREST, &g->water));
    find_zone(k, g, "counted", k->of_water.box[q][0], k->of_water.box[q][1]);
}

/* What is given: averages of the patch; then what is taken of each source. */
static void declare(struct fv *s, struct link *k)
{
    const struct patch *p = &k->patch;
    const int how = s->run->scene.coupling.mapping ? CPL_MLS : CPL_SHEPARD;
    struct cpl_grid g = {.dim = s->dim};
    for (int a = 0; a < 3; a++) {
        const int below = a == 1 ? p->below : 0;
        g.origin[a] = p->origin[a];
        g.spacing[a] = p->h[a];
        g.cells[a] = p->cells[a];
        g.periodic[a] = p->periodic[a];
        g.lo[a] = p->of.lo[a] > below ? p->of.lo[a] - below : 0;
        g.hi[a] = g.lo[a] + p->of.n[a];
    }
    partner_check(k->c, cpl_grid(k->c, "fv.cells", &g, &k->grid));
    partner_check(k->c,
                  cpl_field(k->c, k->grid, "fv.velocity", "m/s", s->dim, CPL_PUT, 0, &k->velocity));
    partner_check(k->c, cpl_field(k->c, k->grid, "fv.pressure", "Pa", 1, CPL_PUT, 0, &k->pressure));
    for (int q = 0; q < k->n; q++)
        declare_source(s, k, k->of + q, how);
    if (!s->surface)
        return;
    partner_check(k->c, cpl_field(k->c, k->grid, "fv.phi", "m", 1, CPL_PUT, 0, &k->phi));
    k->of_water = water_budget_create(k->n);
    for (int q = 0; q < k->n; q++)
        declare_water(s, k, q);
}

static void refuse(const struct link *k, const char *reason)
{
    signals_handled(); /* cpl_fail says it */
    cpl_fail(k->c, RUN_INPUT, reason);
}

/* What a source says of itself before the meeting. */
static void meet_source(struct fv *s, const struct link *k, struct source *g)
{
    double number[3];
    find_zone(k, g, "given", g->given[0], g->given[1]);
    find_zone(k, g, "free", g->free[0], g->free[1]);
    find_zone(k, g, "box", g->box[0], g->box[1]);
    for (int a = s->run->scene.domain.dim; a < 3; a++) {
        g->given[0][a] = -INFINITY;
        g->given[1][a] = INFINITY;
    }
    find_zone(k, g, "moves", number, number);
    for (int a = 0; a < 3; a++) {
        g->moves = g->moves || number[a] != 0.0;
        s->partners.moves[a] = s->partners.moves[a] || number[a] != 0.0;
    }
    find_zone(k, g, "pace", number, number);
    g->fastest = number[0];
    find_zone(k, g, "speed", number, number);
    if (s->run->scene.nbodies > 0)
        s->speed.partner = fmax(s->speed.partner, number[0]);
}

/* Before there are cells: what they have to leave to the partners. */
void coupling_boxes(struct fv *s, double box[PARTNERS_MAX][2][3])
{
    struct link *k = s->link = NEW_IN(s, struct link, 1);
    char names[PARAM_PROGRAMS_MAX][64];
    k->c = s->run->partner_ctx;
    k->n = params_programs(s->run->params, "sph", names);
    if (k->n == 0) { /* another solver in its place */
        strcpy(names[0], "sph");
        k->n = 1;
    }
    s->partners.n = k->n;
    for (int q = 0; q < k->n; q++) {
        struct source *g = k->of + q;
        memcpy(g->name, names[q], sizeof g->name);
        meet_source(s, k, g);
        memcpy(s->partners.box[q], g->free, sizeof g->free);
        memcpy(box[q], g->given, sizeof g->given);
    }
}

/* What the sources give, or all that they compute, where their boxes stand. */
static void boxes_of(const struct link *k, bool all, double box[PARTNERS_MAX][2][3])
{
    for (int q = 0; q < k->n; q++)
        for (int side = 0; side < 2; side++)
            for (int a = 0; a < 3; a++)
                box[q][side][a] =
                    (all ? k->of[q].box : k->of[q].given)[side][a] + k->of[q].stands[a];
}

void coupling_refuse(const struct fv *s, const char *reason) { refuse(s->link, reason); }

/* The cells whose averages the partner is given. */
static void make_patch(struct fv *s, struct link *k, const double (*given)[2][3])
{
    double box[PARTNERS_MAX][2][3], where[3];
    char reason[500];
    boxes_of(k, true, box);
    if (patch_create(s, k->n, (const double(*)[2][3])box, given, &k->patch, where))
        return;
    snprintf(reason, sizeof reason,
             "blocks: sph.box needs the flow at (%g, %g, %g) m, within two cells of it, and no "
             "block computes it there: move the box away from walls that it does not share, or let "
             "blocks reach further",
             where[0], where[1], where[2]);
    refuse(k, reason);
}

/* Ends the job where lines of the scene and sides of blocks are not the same walls. */
static void compare_walls(struct fv *s, const struct link *k, const double (*given)[2][3])
{
    double box[PARTNERS_MAX][2][3];
    char why[400];
    boxes_of(k, true, box);
    if (!shared_walls_agree(s, k->n, given, (const double(*)[2][3])box, why, sizeof why))
        refuse(k, why);
}

/* Forced values of the start, and before it where an exact solution knows them. */
static void start_forced(struct fv *s, double before)
{
    struct forcing *f = s->forcing;
    double u[3];
    f->t1 = s->t;
    f->t0 = s->t - before;
    f->t_old = s->t - 2.0 * before;
    const bool past = exact_has_past(&s->exact) && s->prm.errors;
    f->levels = past ? 3 : 1;
    for (int64_t i = 0; i < f->npartner + f->nrim; i++)
        for (int m = 0; m < 3; m++) {
            double *const *v = m == 0 ? f->v_next : m == 1 ? f->v : f->v_old;
            if (m > 0 && past)
                forcing_average(s, f->partner[i], s->t - m * before, u, NULL);
            for (int a = 0; a < s->dim; a++)
                v[a][i] = m > 0 && past ? u[a] : s->u[a][f->partner[i]];
        }
}

/* For what the partner gives. */
static void make_room(const struct fv *s, struct link *k)
{
    const int64_t n = s->forcing->npartner + s->forcing->nrim;
    DROP(k->room);
    void *room = k->room = NEW_IN(k, char, 1);
    k->points = forced_points_create(s, room, k->seen);
    k->got = NEW_IN(room, double, k->points.n * s->dim);
    k->one = NEW_IN(room, double, k->points.n);
    k->whose = NEW_IN(room, unsigned char, k->points.n);
    k->mean = NEW_IN(room, double, n * s->dim);
    k->level = NEW_IN(room, double, n);
    k->has = NEW_IN(room, unsigned char, n);
    k->p = NEW_IN(room, double, n);
    k->mask = NEW_IN(room, unsigned char, n);
    const int64_t nplaces = s->surface ? s->surface->forced->nplaces : 0;
    k->share = s->surface ? NEW_IN(room, double, nplaces) : NULL;
    k->share_of_one = s->surface ? NEW_IN(room, double, nplaces) : NULL;
}

/* Windows over which the pressure is smoothed, as the one wants it that wants most. */
static int longest_memory(const struct link *k)
{
    double memory[3], most = 0.0;
    for (int q = 0; q < k->n; q++) {
        find_zone(k, k->of + q, "memory", memory, memory);
        most = fmax(most, memory[0]);
    }
    return (int)most;
}

/* Where the next window begins. */
static void remember(struct fv *s)
{
    if (s->partners.past[0][0])
        grid_fill(&s->grid, s->dim, s->u);
    for (int a = 0; a < s->dim && s->partners.past[0][a]; a++) {
        double *const oldest = s->partners.past[1][a];
        s->partners.past[1][a] = s->partners.past[0][a];
        s->partners.past[0][a] = oldest;
        memcpy(oldest, s->u[a], (size_t)s->size * sizeof *oldest);
    }
}

/* Velocities before the start, where an exact solution knows them. */
static void start_past(struct fv *s, double before)
{
    const bool exact = exact_has_past(&s->exact) && s->prm.errors;
    double u[3];
    for (int m = 0; m < 2; m++)
        for (int a = 0; a < s->dim; a++)
            memcpy(s->partners.past[m][a], s->u[a], (size_t)s->size * sizeof(double));
    for (int m = 0; m < 2 && exact; m++)
        FLOW_ROWS (s, at, n)
            for (int64_t c = at; c < at + n; c++) {
                forcing_average(s, c, s->t - (m + 1) * before, u, NULL);
                for (int a = 0; a < s->dim; a++)
                    s->partners.past[m][a][c] = u[a];
            }
}

/* What cannot be coupled is refused here, by all programs at once; then what is given and taken is
 * declared, on the cells as they are. */
void fv_coupling_create(struct fv *s)
{
    struct link *k = s->link;
    double all[PARTNERS_MAX][2][3];
    boxes_of(k, false, all);
    if (s->partners.moves[0] || s->partners.moves[1] || s->partners.moves[2])
        moved_box_prepare(s, (const double(*)[2][3])all);
    s->forcing = mem_own(s, forcing_create(s, k->n, (const double(*)[2][3])all, true));
    if (s->forcing && s->forcing->parted && s->prm.integrator == INTEGRATOR_NEWTON)
        refuse(k,
               "fv.integrator: newton solves for one pressure, and sph.box cuts the flow in parts "
               "that have one each: take rk3 or bdf2, or leave fv a way around the box");
    if (!s->forcing)
        refuse(k, "no cell of fv lies wholly in the box that sph gives: refine fv.cells (or the "
                  "blocks), enlarge sph.box or lower coupling.overlap");
    if (s->m && sides_give_pressure(s) && s->forcing->net == NET_OTHERS)
        refuse(k,
               "blocks: the cells that sph gives lie in blocks that overlap there, so what flows "
               "through their interface cannot be balanced, and with an outflow the pressure would "
               "oscillate: let them lie in one block, or in blocks that are joined");
    if (s->m)
        compare_walls(s, k, (const double(*)[2][3])all);
    make_patch(s, k, (const double(*)[2][3])all);
    k->seen = seen_size(s);
    k->wish = s->m && k->of[0].fastest > 0.0 ? least_height(s) / k->of[0].fastest : INFINITY;
    if (s->surface)
        s->surface->forced = mem_own(s->surface, surface_forced_create(s));
    declare(s, k);
    k->knows_mean = mean_velocity_is_known(s);
    k->course = mem_own(k, course_create(s, &k->patch, longest_memory(k)));
    make_room(s, k);
    if (s->m) /* the start makes fluxes before the partner has said a word */
        start_forced(s, 1e-3);
    k->unmapped = (struct watch){
        .key = "unmapped_cells",
        .what = "share of the cells at sph's edge that hold no particle of sph",
        .likely = "the surface or an air cavity has come to the edge of what fv takes from sph: "
                  "set the open sides of sph.box deeper into the water, or lower coupling.overlap; "
                  "if cells of fv are finer than sph.dx, take coarser fv.cells",
        .warn = 0.05,
        .stop = 0.25};
}

/* Pa: the partner's pressure over ours in the computed cells beside its own: sum and number by
 * part of the flow, all in one where it has no parts. */
static void compare_pressure(const struct fv *s, double sum[2][PARTS_MAX])
{
    const struct link *k = s->link;
    const struct forcing *f = s->forcing;
    double x[3];
    memset(sum, 0, 2 * sizeof *sum);
    for (int64_t i = f->npartner; i < f->npartner + f->nrim; i++) {
        const int64_t c = f->partner[i];
        const int part = f->parted ? f->parted->of[c] : 0;
        if (!k->mask[i])
            continue;
        grid_place(&s->grid, c, x);
        sum[0][part] += k->p[i] - fv_pressure(s, c) - fv_still_pressure(s, x);
        sum[1][part] += 1.0;
    }
    MPI_Allreduce(MPI_IN_PLACE, sum, 2 * PARTS_MAX, MPI_DOUBLE, MPI_SUM, s->comm);
}

/* A part that floats is told the level of its pressure by the partner: a share of the difference
 * a coupling step, for the partner's own answers to it within some of them, later where it takes
 * smoothed pressures. If all parts float their mean stays: the partner's pressure is over it. */
static void follow_levels(struct fv *s)
{
    const struct parted *p = s->forcing->parted;
    const double share = 0.5 / (1.0 + s->link->course->memory), rho = s->run->scene.fluid.rho;
    double sum[2][PARTS_MAX], more[PARTS_MAX] = {0.0}, mean = 0.0, cells = 0.0;
    compare_pressure(s, sum);
    for (int k = 0; k < p->n; k++) {
        more[k] = sum[1][k] > 0.0 ? share * sum[0][k] / sum[1][k] / rho : 0.0;
        mean += more[k] * p->cells[k];
        cells += p->cells[k];
    }
    for (int k = 0; k < p->n && parted_all_float(p); k++)
        more[k] -= mean / cells;
    parted_shift(p, s, more);
}

/* A flow of constant density knows its pressure up to a constant: the partner has it. */
static void find_reference_pressure(struct fv *s)
{
    const struct parted *p = s->forcing->parted;
    double sum[2][PARTS_MAX], all[2] = {0.0, 0.0};
    if (p)
        follow_levels(s);
    compare_pressure(s, sum);
    for (int part = 0; part < PARTS_MAX; part++)
        if (!p || parted_all_float(p) || !p->floats[part])
            for (int q = 0; q < 2; q++)
                all[q] += sum[q][part];
    s->partners.pressure = all[1] > 0.0 ? all[0] / all[1] : s->partners.pressure;
}

/* Velocity, pressure and phi in turn: the terms of each are made in the same memory. */
static void put(struct fv *s)
{
    struct link *k = s->link;
    struct course *c = k->course;
    const double *const *term = (const double *const *)c->term;
    int n = course_velocity(c);
    partner_check(k->c, cpl_put_course(k->c, k->velocity, s->t, c->n, n, term));
    n = course_pressure(c);
    partner_check(k->c, cpl_put_course(k->c, k->pressure, s->t, c->n, n, term));
    if (!s->surface)
        return;
    n = course_surface(c);
    partner_check(k->c, cpl_put_course(k->c, k->phi, s->t, c->n, n, term));
}

/* Which cells take the partner's values. */
static void name_cells(struct fv *s)
{
    struct link *k = s->link;
    const struct forced_points *p = &k->points;
    const struct surface_forced *w = s->surface ? s->surface->forced : NULL;
    for (int q = 0; q < k->n; q++) {
        partner_check(k->c, cpl_move(k->c, k->of[q].forced, p->n, p->x, p->id, NULL));
        if (w)
            partner_check(k->c, cpl_move(k->c, k->of[q].places, w->nplaces, w->x, NULL, NULL));
    }
}

/* Cells and points that take values; then the first patch. */
void coupling_first(void *state)
{
    static const double one[3] = {0.0, 0.0, 0.0};
    struct fv *s = state;
    struct link *k = s->link;
    const struct forcing *f = s->forcing;
    name_cells(s);
    for (int q = 0; q < k->n; q++) {
        if (s->surface)
            partner_check(k->c, cpl_move(k->c, k->of[q].budget, 1, one, NULL, NULL));
        if (k->of[q].moves)
            partner_check(k->c, cpl_move(k->c, k->of[q].place, 1, one, NULL, NULL));
    }
    if (!s->run->restart) {
        const double before = s->exact.U > 0.0 ? 1e-3 * s->exact.L / s->exact.U : 1e-3;
        if (f)
            start_forced(s, before);
        if (s->partners.past[0][0])
            start_past(s, before);
        pressure_meet_surface(s);
        course_start(s, k->course, before);
    }
}

/* Cells without a particle near them keep their values. Two layers of the hole and the rim make
 * the fluxes of its outline: there it matters. */
static void count_missing(struct fv *s)
{
    struct link *k = s->link;
    const struct forcing *f = s->forcing;
    double sum[2] = {0.0, 0.0};
    for (int64_t i = 0; i < f->npartner + f->nrim; i++) {
        const int64_t c = f->partner[i];
        if (f->layer[c] > 2 || (s->surface && s->surface->forced->phi[1][c] > -0.5 * k->seen))
            continue;
        sum[1] += 1.0;
        if (!k->mask[i]) {
            grid_place(&s->grid, c, k->where);
            sum[0] += 1.0;
        }
    }
    const double mine = sum[0];
    MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, s->comm);
    if (sum[0] > 0.0)
        (void)ranks_most(s->comm, mine, k->where, sizeof k->where);
    k->missing = sum[1] > 0.0 ? sum[0] / sum[1] : 0.0;
}

/* A place that is none, the water of both, the cells without an answer. */
void coupling_judge(struct fv *s, struct diagnosis *d)
{
    struct link *k = s->link;
    if (*k->lost) {
        d->bad = true;
        snprintf(d->reason, sizeof d->reason, "%s", k->lost);
        snprintf(d->where, sizeof d->where, "t = %.4g s", s->t);
        snprintf(d->likely, sizeof d->likely,
                 "another path of the box, finer cells or blocks that overlap by more there");
    }
    if (s->surface && !isnan(k->of_water.start))
        water_budget_judge(s, &k->of_water, d);
    if (watch_judge(&k->unmapped, k->missing, s->t, s->run->step, d))
        snprintf(d->where, sizeof d->where, "(%g, %g, %g) m, t = %.4g s", k->where[0], k->where[1],
                 k->where[2], s->t);
}

double coupling_water_missing(const struct fv *s) { return s->link->of_water.missing; }

double coupling_longest_window(void *state)
{
    const struct fv *s = state;
    return s->link->wish;
}

double coupling_unmapped(const struct fv *s) { return s->link->missing; }

void coupling_summary(const struct fv *s, struct summary *to)
{
    watch_summary(&s->link->unmapped, to);
    if (s->surface)
        watch_summary(&s->link->of_water.watched, to);
}

/* The cells that the partner is given, of blocks cut anew. */
static void move_patch(struct fv *s, struct link *k, const double (*given)[2][3])
{
    double box[PARTNERS_MAX][2][3], where[3];
    boxes_of(k, true, box);
    if (!patch_renew(s, k->n, (const double(*)[2][3])box, given, &k->patch, where))
        snprintf(k->lost, sizeof k->lost,
                 "sph needs the flow at (%g, %g, %g) m, and no block computes it there", where[0],
                 where[1], where[2]);
}

/* The boxes stand at these ways from their starts, and other cells are forced; false: the same. */
static bool stand(struct fv *s)
{
    struct link *k = s->link;
    double box[PARTNERS_MAX][2][3];
    for (int q = 0; q < k->n; q++)
        for (int side = 0; side < 2; side++)
            for (int a = 0; a < 3; a++)
                s->partners.box[q][side][a] = k->of[q].free[side][a] + k->of[q].stands[a];
    boxes_of(k, false, box);
    const bool moved = moved_box(s, k->n, (const double(*)[2][3])box, k->lost);
    if (moved && s->m && !*k->lost)
        move_patch(s, k, (const double(*)[2][3])box);
    if (!moved)
        return false;
    make_room(s, k);
    return true;
}

/* Before the fields are read, for it decides which cells are imposed; nothing is newly born then.
 */
bool coupling_stand(struct fv *s, struct h5 *f)
{
    double way[12 * PARTNERS_MAX];
    struct link *k = s->link;
    if (!k || !s->partners.past[0][0])
        return true;
    if (!h5_read_same(f, "partners_way", 12 * k->n, way))
        return false;
    for (int q = 0; q < k->n; q++) {
        memcpy(k->of[q].stands, way + 12 * q, sizeof k->of[q].stands);
        memcpy(k->of[q].moved, way + 12 * q + 3, sizeof k->of[q].moved);
    }
    k->has_moved = true;
    (void)stand(s);
    for (int64_t c = 0; s->partners.born && c < s->size; c++)
        s->partners.born[c] = 0;
    return true;
}

/* Twelve numbers a source: where its forced cells stand, how far it has come, the box that it
 * counts. */
static void save_ways(const struct link *k, struct h5 *f)
{
    double way[12 * PARTNERS_MAX];
    for (int q = 0; q < k->n; q++) {
        memcpy(way + 12 * q, k->of[q].stands, sizeof k->of[q].stands);
        memcpy(way + 12 * q + 3, k->of[q].moved, sizeof k->of[q].moved);
    }
    h5_write_real(f, "partners_way", "m", 12 * k->n, 1, way, false);
}

/* They stand where they were when the last window ended. */
static void follow(struct fv *s)
{
    struct link *k = s->link;
    for (int q = 0; q < k->n; q++)
        memcpy(k->of[q].stands, k->of[q].moved, sizeof k->of[q].stands);
    for (int q = 0; s->surface && q < k->n; q++)
        if (k->of[q].moves)
            memcpy(k->of_water.box[q], k->of[q].moved + 3, sizeof k->of_water.box[q]);
    if (stand(s))
        name_cells(s);
}

/* What the sources have at the end of the window: of each the cells that its particles reach. */
static void take(struct fv *s)
{
    struct link *k = s->link;
    struct forcing *f = s->forcing;
    const int dim = s->dim;
    const int64_t n = f->npartner + f->nrim;
    memset(k->mask, 0, (size_t)n);
    for (int a = 0; a < dim; a++)
        memcpy(f->v_next[a], f->v[a], (size_t)n * sizeof(double));
    for (int q = 0; q < k->n; q++) {
        const struct source *g = k->of + q;
        partner_check(k->c, cpl_get(k->c, g->imposed, k->points.n, k->got, k->whose));
        partner_check(k->c, cpl_get(k->c, g->seen, k->points.n, k->one, NULL));
        forced_points_mean(&k->points, dim, k->got, k->whose, k->mean, k->has);
        forced_points_mean(&k->points, 1, k->one, k->whose, k->level, k->has);
        for (int64_t i = 0; i < n; i++) {
            if (!k->has[i])
                continue;
            k->mask[i] = 1;
            k->p[i] = k->level[i];
            for (int a = 0; a < dim; a++)
                f->v_next[a][i] = k->mean[dim * i + a];
        }
    }
    for (int q = 0; q < k->n; q++)
        if (k->of[q].moves) {
            partner_check(k->c, cpl_get(k->c, k->of[q].way, 1, k->of[q].moved, NULL));
            k->has_moved = true;
        }
}

/* The sources' surfaces and water; their boxes lie apart, so what they fill adds up. */
static void take_surface(struct fv *s)
{
    struct link *k = s->link;
    const int64_t n = s->surface->forced->nplaces;
    double water[2] = {0.0, 0.0}, of_one[2];
    memset(k->share, 0, (size_t)n * sizeof *k->share);
    for (int q = 0; q < k->n; q++) {
        partner_check(k->c, cpl_get(k->c, k->of[q].filled, n, k->share_of_one, NULL));
        for (int64_t i = 0; i < n; i++)
            k->share[i] += k->share_of_one[i];
        partner_check(k->c, cpl_get(k->c, k->of[q].water, 1, of_one, NULL));
        water[0] += of_one[0];
        water[1] += of_one[1];
    }
    surface_forced_take(s, k->share);
    water_budget_take(s, &k->of_water, water);
}

/* The partner's velocities at t1; cells that it does not reach keep theirs. */
void fv_coupling_window_begin(void *state, double t0, double t1)
{
    struct fv *s = state;
    struct link *k = s->link;
    if (k->has_moved)
        follow(s);
    remember(s);
    forcing_shift(s->forcing, t0, t1);
    if (s->surface)
        surface_forced_shift(s, t0, t1);
    course_try(s, k->course, t1);
    put(s);
    take(s);
    if (s->surface)
        take_surface(s);
    count_missing(s);
    if (s->surface)
        forcing_fill(s, k->mask);
}

/* With a surface the partner knows its pressure itself. */
void fv_coupling_window_end(void *state, double t1)
{
    struct fv *s = state;
    const struct link *k = s->link;
    if (s->forcing && !s->surface)
        find_reference_pressure(s);
    if (k->knows_mean)
        mean_velocity_relax(s);
    course_take(s, k->course);
    if (s->surface)
        water_budget_close(s, &s->link->of_water, t1 - s->forcing->t0);
}

bool coupling_restart(struct fv *s, struct h5 *f)
{
    struct link *k = s->link;
    bool good = course_restart(s, k->course, f) && h5_keep(f, "datum", &s->partners.pressure) &&
                h5_keep(f, "unmapped_worst", &k->unmapped.worst);
    if (h5_writes(f) && s->partners.past[0][0])
        save_ways(k, f);
    if (!s->forcing || !good)
        return good;
    if (s->surface)
        good = water_budget_restart(&k->of_water, f) && h5_keep(f, "inflow", &s->forcing->inflow);
    good = good && forced_restart(s, f);
    if (good && s->surface && !h5_writes(f) && !isnan(k->of_water.start))
        s->surface->whole = k->of_water.start; /* watches compare with all water at once */
    return good;
}
