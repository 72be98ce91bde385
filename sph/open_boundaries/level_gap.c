/* level_gap.c - see level_gap.h. Probes stand on the surface outside, one in each column of width
 * dx of the transition; the share of a kernel that the particles fill there (colour.h) says how
 * high they stand. SPDX-License-Identifier: BSD-3-Clause */
#include "level_gap.h"

#include "../pairs/sph_pairs.h"
#include "openings.h"
#include "wet_faces.h"
#include "zones.h"

/* Where what flows in the two programs differs by e, m/s, the blending of velocities, whose
 * impedance is that of sound, and this term let a step of e sqrt(d/g)/(M + kappa) stand, M = sqrt(g
 * d)/c0, and its height times the flow goes out of a wave: standing_wave_crossing, with e = 0.2 %
 * of the flow (kernels and cells see a surface and a floor differently), damps too fast by 12, 8
 * and 5 % with 0.1, 0.2 and 0.4. A slower part, over four times that, takes away what lasts. Of
 * Flather's sqrt(g/d): 1 would take all of a step at once, and feed waves (3e-4 sqrt(g/H)). */
static const double kappa = 0.4;
/* Of a wave outside that nothing inside changes. A box in a wave errs by 4.3 instead of 4.0 % of
 * its velocity with 0.3. */
static const double kappa_exact = 0.1;
/* Of a level that is kept: with 0.1 4 m of water took 16 s to come back. */
static const double kappa_kept = 0.3;
/* The slower part of that: with 0.25 the water of 25 depths overshoots by 40 %. */
static const double slow_kept = 0.02;
static const double most = 0.05; /* of sqrt(g d) */

/* The columns of one side: i along it inwards, j across it and across gravity (3D). */
struct gap_columns {
    int side, up, across, n[2];
    double from;    /* m: depth below the side at which they begin */
    double sense;   /* 1: water lies at the lower end of axis `up' */
    double (*x)[3]; /* [n[0] n[1]] the probe */
    double *depth;  /* m: of the water below it; 0: no surface there */
    double *share;  /* of the kernel that particles fill */
};

struct level_gap *level_gap_create(const struct sph *s, bool kept)
{
    struct level_gap *g = NEW(struct level_gap, 1);
    g->kept = kept;
    g->profile = NEW_IN(g, double, COLOUR_PARTS + 1);
    colour_profile(s->dim, g->profile);
    g->watched = (struct watch){
        .key = "level_gap",
        .what =
            "levels of sph and outside at an open side, difference in dx over ten coupling steps",
        .likely = "waves too steep or too near to breaking at the side: move the side of sph.box; "
                  "or lower coupling.steps",
        .warn = 0.5,
        .stop = 3.0};
    return g;
}

/* n[0] columns across the transition, at least one; in 3D n[1] along the side. */
static struct gap_columns columns_of(const struct sph *s, int side)
{
    const struct zones *z = s->zones;
    struct gap_columns c = {.side = side, .up = zones_upright(s), .across = -1};
    c.sense = s->gravity[c.up] < 0.0 ? 1.0 : -1.0;
    c.from = z->buffer + (z->watched ? z->transition : 0.0);
    c.n[0] = (int)fmax(floor((z->watched ? z->overlap : z->transition) / s->dx), 1.0);
    c.n[1] = 1;
    for (int a = 0; a < s->dim; a++)
        if (a != side / 2 && a != c.up) {
            c.across = a;
            c.n[1] = (int)lround((s->hi[a] - s->lo[a]) / s->dx);
        }
    const int n = c.n[0] * c.n[1];
    c.x = mem_new((size_t)n, sizeof *c.x);
    c.depth = NEW(double, n);
    c.share = NEW(double, n);
    return c;
}

static void columns_free(struct gap_columns *c) { FREE(c->x, c->depth, c->share); }

/* Foot of column (i, j) on the lower end of the region. */
static void foot(const struct sph *s, const struct gap_columns *c, int i, int j, double *x)
{
    const int a = c->side / 2;
    const double in = c->from + (i + 0.5) * s->dx;
    x[0] = x[1] = x[2] = 0.0;
    x[a] = c->side % 2 ? s->hi[a] - in : s->lo[a] + in;
    x[c->up] = c->sense > 0.0 ? s->lo[c->up] : s->hi[c->up];
    if (c->across >= 0)
        x[c->across] = s->lo[c->across] + (j + 0.5) * s->dx;
}

/* The topmost place of a column where phi changes its sign. From the top, so that a cavity in the
 * water does not count. depth stays 0 where the outside has no surface. */
static void find_surface(struct sph *s, struct gap_columns *c, int k)
{
    struct zones *z = s->zones;
    const int n = (int)ceil((s->hi[c->up] - s->lo[c->up]) / s->dx) + 1;
    double x[3];
    foot(s, c, k % c->n[0], k / c->n[0], x);
    zones_room(z, n);
    z->n = n;
    for (int m = 0; m < n; m++) {
        memcpy(z->x + 3 * m, x, sizeof x);
        z->x[3 * m + c->up] += c->sense * m * s->dx;
    }
    z->surface(z->ctx, s->t, n, z->x, z->phi, NULL);
    for (int m = n - 1; m > 0 && c->depth[k] == 0.0; m--)
        if (z->phi[m] >= 0.0 && z->phi[m - 1] < 0.0) {
            const double part = z->phi[m - 1] / (z->phi[m - 1] - z->phi[m]);
            c->depth[k] = (m - 1 + part) * s->dx;
            memcpy(c->x[k], x, sizeof x);
            c->x[k][c->up] += c->sense * c->depth[k];
        }
}

/* Beside walls a kernel is cut. */
static bool is_beside_wall(const struct sph *s, const struct gap_columns *c, int j)
{
    const int a = c->across;
    if (a < 0 || s->periodic[a])
        return false;
    const double x = (j + 0.5) * s->dx, L = s->hi[a] - s->lo[a];
    return (!s->open[2 * a] && x < s->R) || (!s->open[2 * a + 1] && x > L - s->R);
}

/* To all probes within R, which are at most R/dx columns away; across a period to their images. */
static void add_particle(const struct sph *s, struct gap_columns *c, const double *y, double w)
{
    const int more = (int)ceil(s->R / s->dx), b = c->across, rows = c->n[1];
    const bool round = b >= 0 && s->periodic[b];
    const double in = zones_inside(s->lo, s->hi, c->side, y) - c->from;
    const int i0 = (int)floor(in / s->dx);
    int first = 0, last = 0;
    if (b >= 0) {
        const int j0 = (int)floor((y[b] - s->lo[b]) / s->dx);
        first = round || j0 > more ? j0 - more : 0;
        last = round || j0 + more < rows - 1 ? j0 + more : rows - 1;
    }
    for (int j = first; j <= last; j++) {
        const int turns = (int)floor((double)j / rows);
        double at[3] = {y[0], y[1], s->dim > 2 ? y[2] : 0.0};
        if (turns != 0)
            at[b] -= turns * (s->hi[b] - s->lo[b]);
        for (int i = i0 > more ? i0 - more : 0; i <= i0 + more && i < c->n[0]; i++) {
            const int k = i + c->n[0] * (j - turns * rows);
            const double r2 = vec_distance2(s->dim, at, c->x[k]);
            if (c->depth[k] > 0.0 && r2 < s->R * s->R)
                c->share[k] += w * kernel_w(s->dim, sqrt(r2), s->R);
        }
    }
}

/* In order: the surface outside in each column, the kernel's share filled there summed over the
 * ranks, the mean of the heights with weights alpha as in blending (1 at the buffer, 0 at the free
 * zone), then the velocity outwards that lowers the gap. What the columns say at the start counts
 * as 0 where a partner started from the same shapes: it is what the initial lattice makes of a
 * surface. A level that is to be kept is not that of the start: whole rows start up to dx/2 off. */
static void look_at_side(struct sph *s, int side, double dt)
{
    struct level_gap *g = s->zones->gap;
    struct gap_columns c = columns_of(s, side);
    const int n = c.n[0] * c.n[1];
    double sum = 0.0, weights = 0.0, depth = 0.0;
    for (int k = 0; k < n; k++)
        if (!is_beside_wall(s, &c, k / c.n[0]))
            find_surface(s, &c, k);
    for (int i = 0; i < s->p.n; i++) {
        const double *y = state_row(&s->p, s->p.y, i);
        add_particle(s, &c, y, y[at_volume(s->dim)]);
    }
    MPI_Allreduce(MPI_IN_PLACE, c.share, n, MPI_DOUBLE, MPI_SUM, s->run->comm);
    for (int k = 0; k < n; k++) {
        const double alpha = 1.0 - (k % c.n[0] + 0.5) / c.n[0];
        if (c.depth[k] == 0.0)
            continue;
        sum -= alpha * colour_height(g->profile, s->R, c.share[k]);
        depth += alpha * c.depth[k];
        weights += alpha;
        g->probes++;
    }
    columns_free(&c);
    const double gap = weights > 0.0 ? sum / weights : 0.0;
    if (!g->started && !g->kept)
        g->at_rest[side] = gap;
    const double d = weights > 0.0 ? fmax(depth / weights, s->R) : s->R;
    const double U = sqrt(fabs(s->gravity[zones_upright(s)]) * d),
                 of = g->kept                       ? kappa_kept
                      : s->prm.outer == OUTER_EXACT ? kappa_exact
                                                    : kappa,
                 rate = of * U / d, slow = g->kept ? slow_kept : 0.25;
    g->gap[side] = weights > 0.0 ? gap - g->at_rest[side] : 0.0;
    const double now = rate * g->gap[side], lasting = g->lasting[side] + slow * rate * dt * now;
    g->lasting[side] = fmax(-most * U, fmin(most * U, lasting));
    s->zones->outflow[side] = fmax(-most * U, fmin(most * U, now + g->lasting[side]));
}

/* A flow in by one side and out by the other changes the levels of both programs alike, so no gap
 * resists it: in a period the partner gives it back, and in a tank it only tilts the water. Waves
 * leave a millimetre of gap where they come in (particles that enter stand closer there), which
 * called for ever more of it: after 16 periods the water before the box stood 0.15 of their
 * amplitude above that behind it, instead of 0.08. What both sides have in common is kept: it
 * changes how much water the region holds. */
static void leave_out_circulation(const struct sph *s, double *outflow, int axis)
{
    double *low = outflow + 2 * axis, *high = low + 1;
    if (s->open[2 * axis] && s->open[2 * axis + 1])
        *low = *high = 0.5 * (*low + *high);
}

/* Once a step, after births: sets the flow, m/s, that openings add until the next one. */
void level_gap_look(struct sph *s, double dt)
{
    const int up = zones_upright(s);
    s->zones->gap->probes = 0;
    for (int side = 0; side < 2 * s->dim; side++)
        if (s->open[side] && side / 2 != up)
            look_at_side(s, side, dt);
    for (int a = 0; a < s->dim; a++) {
        leave_out_circulation(s, s->zones->outflow, a);
        leave_out_circulation(s, s->zones->gap->lasting, a);
    }
    s->zones->gap->started = true;
}

/* Of the two sides along the first axis that has any. */
void level_gap_row(struct sph *s, struct figures *to)
{
    const struct level_gap *g = s->zones->gap;
    const struct openings *o = s->zones->openings;
    double sums[3] = {o->rain[0], (double)o->refused, o->films};
    int axis = 0;
    double water[2] = {0.0, 0.0};
    if (to->measures)
        wet_faces_water(s, water);
    while (axis < s->dim - 1 && !s->open[2 * axis] && !s->open[2 * axis + 1])
        axis++;
    MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, s->run->comm);
    FIGURE(to, g->gap[2 * axis], "level gap [m]");
    FIGURE(to, g->gap[2 * axis + 1], "level gap beyond [m]");
    FIGURE(to, sums[0], "drops [kg]");
    FIGURE(to, openings_held(s), "faces hold [kg]");
    FIGURE(to, sums[1], "births refused [-]");
    FIGURE(to, sums[2], "films [kg]");
    FIGURE(to, wet_faces_voids(s), "voids [kg]");
    FIGURE(to, water[0], "water [m^dim]");
}

static const double several = 10.0; /* windows */

/* A mean over `several' coupling steps, so that a short peak does not end the run. */
void level_gap_judge(struct sph *s, struct diagnosis *d)
{
    struct level_gap *g = s->zones->gap;
    double now = 0.0;
    int worst = 0;
    for (int side = 0; side < 2 * s->dim; side++)
        if (fabs(g->gap[side]) > now) {
            now = fabs(g->gap[side]);
            worst = side;
        }
    g->mean += (now - g->mean) / several;
    if (watch_judge(&g->watched, g->mean / s->dx, s->t, s->run->step, d))
        snprintf(d->where, sizeof d->where, "the %s open side along %c, t = %.4g s",
                 worst % 2 ? "upper" : "lower", "xyz"[worst / 2], s -> t);
}

void level_gap_summary(const struct sph *s, struct summary *to)
{
    const struct openings *o = s->zones->openings;
    static const char *const momentum[] = {"drops.momentum_x", "drops.momentum_y",
                                           "drops.momentum_z"};
    double sums[6] = {o->rain[0], (double)o->drops, o->films, o->rain[1], o->rain[2], o->rain[3]};
    MPI_Allreduce(MPI_IN_PLACE, sums, 6, MPI_DOUBLE, MPI_SUM, s->run->comm);
    watch_summary(&s->zones->gap->watched, to);
    summary_real(to, "drops.mass", sums[0]);
    summary_real(to, "drops.number", sums[1]);
    summary_real(to, "drops.films", sums[2]);
    for (int a = 0; a < s->dim; a++)
        summary_real(to, momentum[a], sums[3 + a]);
}

/* A restart is no start: what the columns say then is a gap already. */
bool level_gap_restart(struct sph *s, struct h5 *f)
{
    struct level_gap *g = s->zones->gap;
    g->started = g->started || !h5_writes(f);
    return h5_keep_same(f, "level_at_rest", "m", 6, g->at_rest) &&
           h5_keep_same(f, "level_outflow", "m/s", 6, s->zones->outflow) &&
           h5_keep_same(f, "level_lasting", "m/s", 6, g->lasting) &&
           h5_keep_same(f, "level_gap", "m", 6, g->gap) && h5_keep(f, "level_mean", &g->mean) &&
           h5_keep(f, "level_worst", &g->watched.worst);
}
