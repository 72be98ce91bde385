/* coupling_check.c - scenes that a coupled job cannot do, found before it starts: FV fills all that
 * lies around SPH's box, without a surface, a body or a polyline, and both need the rim where they
 * overlap. Called from the check of the case on all ranks alike: each fault names its key and what
 * would help. Water and cells are only looked at when nothing else is wrong, for they need boxes
 * that make sense.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../../common/scene/scene.h"
#include "../open_boundaries/sph_open_boundaries.h"
#include "../particles/sph_particles.h"
#include "coupling_solids.h"
#include "sph_link.h"
#include "windows.h"

static const char axes[] = "xyz";

/* Points of the lattice of spacing dx over the box lo .. hi that f holds of; *x: the last one. */
typedef bool test(const void *ctx, const double *x);
/* O(volume/dx^dim) calls of f. */
static double count(int dim, double dx, const double *lo, const double *hi, test *f,
                    const void *ctx, double *x)
{
    int n[3] = {1, 1, 1};
    double found = 0.0;
    for (int a = 0; a < dim; a++)
        n[a] = (int)fmax(round((hi[a] - lo[a]) / dx), 1.0);
    for (int k = 0; k < n[2]; k++)
        for (int j = 0; j < n[1]; j++)
            for (int i = 0; i < n[0]; i++) {
                const int at[3] = {i, j, k};
                double y[3] = {0.0, 0.0, 0.0};
                for (int a = 0; a < dim; a++)
                    y[a] = lo[a] + (at[a] + 0.5) * (hi[a] - lo[a]) / n[a];
                if (!f(ctx, y))
                    continue;
                found += 1.0;
                memcpy(x, y, sizeof y);
            }
    return found;
}

/* What the tests of a lattice point need to know. */
struct box_water {
    const struct scene *scene;
    double dx;
    struct exact exact;
    double given[2][3], hidden[2][3]; /* what SPH gives, and of it what fv does not look at */
};

/* Whether x is in the fluid at the start. */
static bool is_wet(const struct box_water *w, const double *x)
{
    return scene_is_fluid(w->scene, &w->exact, x, NULL);
}

/* Whether x lies within the box. */
static bool is_inside(const struct box_water *w, const double box[2][3], const double *x)
{
    const struct scene_domain *d = &w->scene->domain;
    bool inside = true;
    for (int a = 0; a < d->dim; a++) {
        const double at = scene_image_from(d, a, box[0][a], x[a]);
        inside = inside && at > box[0][a] && at < box[1][a];
    }
    return inside;
}

/* Outside of what sph gives, and no water. */
static bool dry_outside(const void *ctx, const double *x)
{
    const struct box_water *w = ctx;
    return !is_inside(w, w->given, x) && !is_wet(w, x);
}

/* In what fv takes from sph: given, but not hidden. */
static bool in_edge(const void *ctx, const double *x)
{
    const struct box_water *w = ctx;
    return is_inside(w, w->given, x) && !is_inside(w, w->hidden, x);
}

/* There, and no water. */
static bool dry_in_edge(const void *ctx, const double *x)
{
    return in_edge(ctx, x) && !is_wet(ctx, x);
}

static bool wet(const void *ctx, const double *x) { return is_wet(ctx, x); }

/* FV's flow has no surface: all that SPH does not give must be water at the start, and most of what
 * FV takes from it; the troughs of steep waves may reach there. More than half of the edge must be
 * wet. */
static void check_water(const struct run *r, const struct box_water *w, struct faults *f)
{
    const struct scene_domain *d = &r->scene.domain;
    const double dx = w->dx;
    double x[3] = {0.0, 0.0, 0.0};
    if (!scene_has_surface(&r->scene) || r->crossed)
        return;
    const bool outside = count(d->dim, dx, d->min, d->max, dry_outside, w, x) > 0.0;
    if (!outside && count(d->dim, dx, d->min, d->max, dry_in_edge, w, x) <=
                        0.5 * count(d->dim, dx, d->min, d->max, in_edge, w, (double[3]){0.0}))
        return;
    const double(*box)[3] = outside ? w->given : w->hidden;
    params_fault(
        r->params, f, "sph.box",
        "at (%g, %g, %g) m there is no water: outside of (%g, %g, %g) to (%g, %g, %g) m, what fv "
        "takes from sph, fv has no surface; let the box reach the sides and the top of the domain, "
        "set its bottom lower, or make transition, buffer and overlap thinner, or fv.cells finer",
        x[0], x[1], x[2], box[0][0], box[0][1], box[0][2], box[1][0], box[1][1], box[1][2]);
}

/* Where the box reaches the domain's side, SPH ends: at a wall, or above the water. An inlet or
 * outlet there would be fv's; without a wall there must be no water along the side. */
static void check_side(const struct run *r, const struct sph_params *prm, const struct box_water *w,
                       int side, struct faults *f)
{
    const struct scene_domain *d = &r->scene.domain;
    const bool opening = scene_wall_of(&r->scene, SIDE_X_MIN + side) != NULL;
    const int a = side / 2;
    double lo[3], hi[3], x[3];
    if (!sph_params_reaches(d, prm, side) || d->periodic[a])
        return;
    if (scene_side_is_wall(&r->scene, SIDE_X_MIN + side))
        return;
    memcpy(lo, prm->box[0], sizeof lo);
    memcpy(hi, prm->box[1], sizeof hi);
    if (side % 2)
        lo[a] = hi[a] - prm->dx;
    else
        hi[a] = lo[a] + prm->dx;
    if (opening || count(d->dim, prm->dx, lo, hi, wet, w, x) > 0.0)
        params_fault(r->params, f, "sph.box",
                     "it reaches the %c side at %g m, %s: in a coupled job that is fv's; give the "
                     "side a wall, or end the box before it",
                     axes[a], side % 2 ? d->max[a] : d->min[a],
                     opening ? "an inlet or outlet" : "which has no wall");
}

/* Whether a cell of edges lo + i h lies wholly between a and b. */
static bool holds_cell(double lo, double h, double a, double b)
{
    return lo + (ceil((a - lo) / h - 1e-9) + 1.0) * h <= b + 1e-9 * h;
}

/* Cells whose kernel (forced_points of fv) is narrower than the gaps between particles find none.
 */
static void check_fineness(const struct run *r, const struct sph_params *prm, double h,
                           struct faults *f)
{
    const double least = 0.6 * prm->dx;
    if (h < least)
        params_fault(r->params, f, "fv.cells",
                     "cells of %.3g m are finer than the particles (sph.dx = %.3g m), most would "
                     "find none of them: %.3g m and more are wanted; fewer fv.cells, or refine "
                     "sph.dx",
                     h, prm->dx, least);
}

/* The box of another group of particles with its zones; false: it has none of its own. Keys of the
 * other group are read with a leading colon, which means its own name. */
static bool box_of_group(const struct run *r, const struct sph_params *prm, const char *group,
                         double box[2][3])
{
    struct sph_params other = *prm;
    double given[3];
    if (params_peek_pair(r->params, r->comm, key_text(":%s.box", group), box))
        return true;
    if (!params_peek_pair(r->params, r->comm, key_text(":%s.free", group), box))
        return false;
    if (params_peek(r->params, r->comm, key_text(":%s.dx", group), given))
        other.dx = given[0];
    if (params_peek(r->params, r->comm, key_text(":%s.R_dx", group), given))
        other.R_dx = given[0];
    for (int a = 0; a < r->scene.domain.dim; a++)
        zones_around(r, &other, a, box, &box[0][a], &box[1][a]);
    return true;
}

/* Several programs of particles, each with its box: what only one of them can have. This program
 * compares its box with all others; each program does. */
static void check_several(const struct run *r, const struct sph_params *prm, struct faults *f)
{
    char names[PARAM_PROGRAMS_MAX][64];
    const int n = params_programs(r->params, "sph", names);
    const struct scene_domain *d = &r->scene.domain;
    if (n < 2)
        return;
    if (scene_has_surface(&r->scene) && !r->crossed)
        params_fault(r->params, f, "sph.box",
                     "%d boxes of particles, and none ends in the water at an upright side: the "
                     "free surface would belong to several programs; take one box, or boxes with "
                     "fv's water between them",
                     n);
    if (box_motion_wanted(prm))
        params_fault(r->params, f, box_motion_key(prm),
                     "%d boxes of particles: one that moves could meet another; let them rest, or "
                     "take one box",
                     n);
    for (int k = 0; k < n; k++) {
        double box[2][3];
        bool apart = strcmp(names[k], r->name) == 0 || !box_of_group(r, prm, names[k], box);
        for (int a = 0; a < d->dim; a++)
            apart = apart ||
                    !scene_ranges_meet(d, a, box[0][a], box[1][a], prm->box[0][a], prm->box[1][a]);
        if (!apart)
            params_fault(r->params, f, "sph.box",
                         "it overlaps the box of group %s (with its zones %g to %g, %g to %g m): "
                         "let them lie apart",
                         names[k], box[0][0], box[1][0], box[0][1], box[1][1]);
    }
}

/* The key by which the case gives the box. */
static const char *box_key(const struct run *r)
{
    return params_given(r->params, "sph.free") ? "sph.free" : "sph.box";
}

/* FV must be told something: along axis a what sph gives, zones_given_box, must hold a cell of
 * edges lo + i h; of blocks (h = 0) it must be there. The fault names the nearest box that does,
 * wider by a whole number of dx at each open side. */
static bool gives(const struct run *r, const struct sph_params *prm, const struct box_water *w,
                  int a, struct faults *f)
{
    const struct scene_domain *d = &r->scene.domain;
    const double dx = prm->dx;
    double lo, free[2][3], more = 0.0;
    bool open[6];
    const double h = zones_cell(r, a, &lo);
    sph_params_open(r, prm, open);
    while (!holds_cell(lo, fmax(h, 1e-6 * dx), w->given[0][a] - (open[2 * a] ? more : 0.0),
                       w->given[1][a] + (open[2 * a + 1] ? more : 0.0)))
        more += dx;
    if (more == 0.0)
        return true;
    zones_free_box(r, prm, free[0], free[1]);
    const bool by_free = strcmp(box_key(r), "sph.free") == 0;
    const double below = by_free ? free[0][a] : prm->box[0][a],
                 above = by_free ? free[1][a] : prm->box[1][a];
    const double from = below - (open[2 * a] ? more : 0.0),
                 to = above + (open[2 * a + 1] ? more : 0.0);
    char mend[128] = "no wider one fits into the domain: refine sph.dx";
    if (d->periodic[a] || (from >= d->min[a] && to <= d->max[a]))
        snprintf(mend, sizeof mend, "%g to %g m would do; else refine sph.dx", from, to);
    params_fault(
        r->params, f, box_key(r),
        "%g to %g m along %c is too short: behind the zones at its open sides (transition, "
        "buffer, overlap: each 1.25 R = %g m by default) no cell of fv (%g m) gets "
        "anything from sph; %s or fv.cells, or give thinner zones",
        below, above, axes[a], 1.25 * prm->R_dx * dx, h, mend);
    return false;
}

/* The same along all axes; then whether cells are wide enough. */
static bool check_cells(const struct run *r, const struct sph_params *prm,
                        const struct box_water *w, struct faults *f)
{
    bool sound = true;
    double lo, widest = 0.0;
    for (int a = 0; a < r->scene.domain.dim; a++) {
        sound = gives(r, prm, w, a, f) && sound;
        widest = fmax(widest, zones_cell(r, a, &lo));
    }
    if (sound && widest > 0.0)
        check_fineness(r, prm, widest, f);
    return sound;
}

/* Whether the box spans the domain in all directions but a, and ends before both ends of a. */
bool coupling_cuts(const struct run *r, const struct sph_params *prm, int a)
{
    const struct scene_domain *d = &r->scene.domain;
    double lo[3], hi[3];
    bool across = a < d->dim && !d->periodic[a] && !r->crossed;
    zones_given_box(r, prm, lo, hi);
    for (int b = 0; b < d->dim; b++) {
        const double near = 1e-6 * prm->dx;
        across = across && (b == a ? lo[b] > d->min[b] + near && hi[b] < d->max[b] - near
                                   : lo[b] < d->min[b] + near && hi[b] > d->max[b] - near);
    }
    return across;
}

/* An outlet on a side of another axis counts for both parts. */
bool coupling_has_outlet(const struct run *r, int end)
{
    const int a = end / 2, up = end % 2;
    bool any = false;
    for (int side = 0; side < 2 * r->scene.domain.dim; side++) {
        const struct scene_wall *w = scene_wall_of(&r->scene, SIDE_X_MIN + side);
        any = any || ((side / 2 != a || side % 2 == up) && w && w->kind == WALL_OUTFLOW);
    }
    return any;
}

/* Why fv's flow cannot be cut in two along axis a and a remedy, or NULL: between two boxes nothing
 * would say how much flows, nor between two outlets, for pressures do not pass through sph; a part
 * without an outlet takes the level of its pressure from sph, on uniform cells alone. */
static const char *no_balance(const struct run *r, int a)
{
    char names[PARAM_PROGRAMS_MAX][64];
    const bool below = coupling_has_outlet(r, 2 * a), above = coupling_has_outlet(r, 2 * a + 1);
    if (params_programs(r->params, "sph", names) > 1)
        return "what lies between several boxes would have no sides of its own: ";
    if (below && above)
        return "with outlets beyond both of its ends nothing would say how much flows through it: "
               "give one of them an inflow, on fv.cells, or ";
    if (params_peek_any(r->params, r->comm, "fv.integrator", "newton"))
        return "fv.integrator newton solves for one pressure, where each part has its own: take "
               "rk3 or bdf2, or ";
    if (params_has_group(r->params, "blocks"))
        return "blocks beyond it have no outlet among the walls, which would set their pressure: "
               "take fv.cells, which need none, or ";
    return NULL;
}

/* Adds a fault along each axis in which the box cuts fv's flow into parts that nothing would
 * balance. */
static void check_parted(const struct run *r, const struct sph_params *prm, struct faults *f)
{
    for (int a = 0; a < r->scene.domain.dim; a++) {
        const char *why = coupling_cuts(r, prm, a) ? no_balance(r, a) : NULL;
        if (why)
            params_fault(r->params, f, box_key(r),
                         "cuts fv's flow in two along %c, and %sleave fv a way around the box: end "
                         "it before one of the sides that it reaches now",
                         axes[a], why);
    }
}

/* Adds a fault for each side of the box beyond which fv's water has no surface. */
static void check_roofed(const struct run *r, const struct sph_params *prm, struct faults *f)
{
    for (int side = 0; side < 2 * r->scene.domain.dim; side++)
        if (isinf(windows_roofed(r, prm, side)))
            params_fault(r->params, f, box_key(r),
                         "beyond its %s end along %c fv's water stands up to the roof as far as "
                         "the wall, so no surface gives its pressure: let the box reach that wall, "
                         "or leave air there",
                         side % 2 ? "upper" : "lower", axes[side / 2]);
}

/* Level gauges whose column stands in the zones of a box at rest: particles that come in there are
 * packed unevenly, and in waves their level rose by a third of dx. */
static void warn_gauges(const struct run *r, const struct sph_params *prm)
{
    const int up = scene_still_axis(&r->scene);
    double free[2][3];
    zones_free_box(r, prm, free[0], free[1]);
    for (int k = 0; k < r->scene.nprobes && r->crossed; k++) {
        const struct scene_probe *p = r->scene.probes + k;
        for (int a = 0; a < r->scene.domain.dim; a++) {
            const double at = scene_image_from(&r->scene.domain, a, prm->box[0][a], p->at[a]);
            if (p->kind == PROBE_LEVEL && !p->body[0] && !r->gauge_elsewhere[k] && a != up &&
                !box_motion_along(r, prm, a) && (at < free[0][a] || at > free[1][a]))
                log_warn("probes.[%d].at: %s stands in the transition or buffer of the particles, "
                         "whose levels are up to dx/3 too high there in waves: from %g to %g m "
                         "along %c they are free, and beyond their box fv reads it",
                         k, p->name, free[0][a], free[1][a], axes[a]);
        }
    }
}

/* Every program of a job makes this check with the same result. */
void coupling_check(const struct run *r, const struct sph_params *prm, struct faults *f)
{
    if (!sph_params_zones(r, prm)) {
        params_fault(r->params, f, "sph.box",
                     "no side of it lies in fv's flow: the programs would exchange nothing; make "
                     "it smaller than the domain, or leave out group fv");
        return;
    }
    struct box_water w = {.scene = &r->scene, .dx = prm->dx, .exact = exact_create(&r->scene)};
    zones_given_box(r, prm, w.given[0], w.given[1]);
    coupling_hidden(r, prm, w.hidden);
    for (int side = 0; side < 2 * r->scene.domain.dim; side++)
        check_side(r, prm, &w, side, f);
    if (!check_cells(r, prm, &w, f))
        return;
    check_parted(r, prm, f);
    check_roofed(r, prm, f);
    if (f->n == 0)
        check_water(r, &w, f);
    coupling_check_bodies(r, prm, f);
    check_several(r, prm, f);
    warn_gauges(r, prm);
    coupling_check_walls(r, prm, f);
    windows_check(r, prm, f);
}
