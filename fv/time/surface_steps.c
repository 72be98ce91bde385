/* surface_steps.c - the surface at the start and around a step of the velocity. A step goes half a
 * step of phi, the velocity with the surface at half time, the other half of phi: second order in
 * time. Each half: phi (or the shares of water, fraction.c) is carried, what others impose on it is
 * set, the cut faces are found anew (rebuild), then values of the water are continued into the air
 * as far as stencils reach (surface_extend). At the end phi becomes a distance again where it has
 * travelled, and the volume is kept. surface_keep_state and surface_back take a step back that was
 * too long.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../surface/fv_surface.h"

#include "../boundary/fv_boundary.h"
#include "../poisson/poisson.h"
#include "moving.h"
#include "stages.h"
#include "steps.h"
#include "surface_steps.h"

enum { REINIT_STEPS = 10 }; /* of 0.45 h each: more than what the surface has travelled */

static void rebuild(struct fv *s)
{
    surface_rebuild(s);
    poisson_rebuild(s);
}

/* Velocity that a shape at x adds to that of place c; whether it does. */
static bool add_velocity(struct fv *s, int64_t c, const double *x)
{
    const struct scene_shape *h = surface_shape(s, x);
    bool any = false;
    for (int a = 0; h && a < s->dim; a++) {
        s->u[a][c] += h->velocity[a];
        any = any || h->velocity[a] != 0.0;
    }
    return any;
}

/* Velocities that shapes add to the field's; whether the fluxes must follow. */
static bool add_velocities(struct fv *s)
{
    bool any = false;
    double x[3];
    for (int64_t c = 0; c < s->size; c++) {
        grid_place(&s->grid, c, x);
        any = add_velocity(s, c, x) || any;
    }
    any = ranks_any(s->comm, any) || s->m;
    if (any)
        extension_apply(s, s->u, EXTEND_FREE, LAYERS);
    return any;
}

/* p = 0 at the highest water, if the case does not say where. */
static void set_level(struct fv *s)
{
    const struct surface *f = s->surface;
    double top = -INFINITY;
    for (int a = 0; a < s->dim; a++)
        for (int64_t i = 0; i < f->ncut[a]; i++)
            top = fmax(top, f->cut[a][i].height);
    MPI_Allreduce(MPI_IN_PLACE, &top, 1, MPI_DOUBLE, MPI_MAX, s->comm);
    if (s->run->scene.initial.level < LEVEL_TOP || !isfinite(top) || f->g == 0.0)
        return;
    s->gravity.level += top / f->g;
    rebuild(s);
}

/* m: how wide a side of the domain is across gravity. */
static double width_of(const struct fv *s, int side)
{
    const struct scene_domain *d = &s->run->scene.domain;
    double width = 1.0;
    for (int a = 0; a < s->dim; a++)
        width *= a == side / 2 || a == still_upright(&s->run->scene) ? 1.0 : d->max[a] - d->min[a];
    return width;
}

/* What is under water of an opening; adds its area to that of its side. */
static void measure_water(const struct fv *s, struct outflow *o, double *wet)
{
    for (int64_t i = 0; i < o->n; i++) {
        o->share[i] = s->surface->layer[o->cell[i]] == 0;
        o->wet[i] = !o->own[i] ? 0.0 : o->stood ? o->stood[i] : surface_share(s, o->cell[i]);
        wet[o->side] += o->own[i] ? o->wet[i] * carried_area(o, i) : 0.0;
    }
}

/* What is under water of the sides that carry the flow out, and how fast waves run there. */
static void set_outflows(struct fv *s)
{
    struct outflows *all = s->outflows;
    double wet[6] = {0.0};
    if (!all)
        return;
    for (int k = 0; k < all->n; k++)
        measure_water(s, all->of + k, wet);
    MPI_Allreduce(MPI_IN_PLACE, wet, 6, MPI_DOUBLE, MPI_SUM, s->comm);
    memcpy(all->area, wet, sizeof wet);
    for (int side = 0; side < 6; side++)
        all->waves[side] = sqrt(s->surface->g * wet[side] / width_of(s, side));
    all->level_free = s->surface->cuts > 0;
}

/* Water that stands by a quarter of the opening's depth higher or lower is another pool's, behind a
 * weir; wet: areas of the openings. */
static void measure_basins(struct fv *s, const double wet[LEVEL_GROUPS])
{
    struct levels *l = s->levels;
    double all = 0.0;
    for (int k = 0; k < LEVEL_GROUPS; k++)
        all += wet[k];
    for (int k = 0; k < 6; k++)
        if (l->tide[k] > 0.0)
            l->basin[k] =
                surface_plan(s, l->level[k], 0.25 * wet[k] / width_of(s, k)) / fmax(all, 1e-300);
}

static void set_openings(struct fv *s)
{
    double wet[LEVEL_GROUPS] = {0.0};
    set_outflows(s);
    held_measure(s);
    if (!s->levels)
        return;
    for (int k = 0; k < s->levels->n; k++)
        measure_water(s, s->levels->of + k, wet);
    MPI_Allreduce(MPI_IN_PLACE, wet, LEVEL_GROUPS, MPI_DOUBLE, MPI_SUM, s->comm);
    for (int side = 0; side < 6; side++)
        s->levels->waves[side] = sqrt(s->surface->g * wet[side] / width_of(s, side));
    measure_basins(s, wet);
}

/* The openings as the first step finds them, and the fluxes through them. */
static void start_openings(struct fv *s, bool fluxes)
{
    set_openings(s);
    held_choose(s);
    outflow_start(s);
    if (fluxes) {
        sides_velocity(s, BC_GIVEN, s->u);
        s->ops->face_velocities(s, s->u, s->U);
    }
    outflow_meet_level(s);
    levels_start(s);
}

void surface_extend(struct fv *s, int layers)
{
    extension_apply(s, s->u, EXTEND_SHEAR, layers);
    surface_set_pressure(s);
    sides_velocity(s, BC_GIVEN, s->u);
    s->ops->dry_fluxes(s, layers <= STENCILS);
}

void surface_interface_moved(struct fv *s, double before)
{
    s->surface->ops->close_cells(s);
    s->surface->volume0 += surface_volume(s) - before;
    rebuild(s);
}

void surface_start(struct fv *s)
{
    struct surface *f = s->surface;
    s->surface->ops->close_cells(s);
    if (fraction_wanted(s)) {
        fraction_start(s);
        f->fraction->carries = !fraction_is_calm(s);
    }
    f->volume0 = surface_volume(s);
    rebuild(s);
    surface_note_calm(s, true);
    if (f->fraction)
        fraction_note_layers(s);
    set_level(s);
    start_openings(s, add_velocities(s));
    surface_extend(s, LAYERS);
}

/* What the band has not seen yet must be told before the surface comes there. */
static void refresh_band(struct fv *s)
{
    if (s->surface->travelled > 2.0)
        surface_reinit(s, REINIT_STEPS);
}

/* phi becomes a distance again at the end of a step in which the surface has travelled a tenth of a
 * cell more: what its slopes are off by gives waves energy. Water at rest is left alone. */
static void refresh(struct fv *s)
{
    const double travelled = s->surface->travelled, before = s->surface->travelled_before;
    surface_note_calm(s, false);
    if (travelled > 2.0)
        surface_reinit(s, REINIT_STEPS);
    else if (s->surface->reinit->is_known && floor(10.0 * travelled) != floor(10.0 * before))
        surface_redistance(s);
}

/* Of projected steps: the normal stress of the last stage is part of the surface's pressure: clean
 * while nu dt/(theta h^2) is at most 5 (measured), here 3.3, as limits.c keeps nu dt/h^2 below 1.
 */
static double least_theta(const struct fv *s, double dt)
{
    const double h = s->surface->least;
    if (s->newton)
        return 0.0;
    return fmin(0.3 * s->nu * dt / (h * h), 0.3);
}

static void impose(struct fv *s, double t)
{
    if (s->surface->forced)
        surface_forced_impose(s, t);
}

/* Newmark's beta of waves: 1/12 has no error of second order; more where the shortest ones, omega^2
 * = 4 g/h at most, want it to be stable: omega dt < 2/sqrt(1 - 4 beta). */
static double newmark_beta(const struct fv *s, double dt)
{
    const struct surface *f = s->surface;
    return fmax(1.0 / 12.0, 0.25 * (1.0 - f->across / (f->g * dt * dt)));
}

/* Backward differences want the pressure where the step ends: the surface goes on there with the
 * velocity of the start, and comes back to half time afterwards. Of the velocities that then take
 * turns with phi, u^n+1 - u^n = dt F(n+1/2) is left where nothing but gravity acts: the leapfrog,
 * which has no loss. The first step has no such difference. */
static void go_ahead(struct fv *s, double dt)
{
    struct surface *f = s->surface;
    const double travelled = f->travelled;
    memcpy(f->half, f->phi, (size_t)s->size * sizeof(double));
    f->rise = newmark_beta(s, dt) * dt * dt;
    if (s->moving) { /* phi less the height goes with the cells */
        surface_mesh_change_height(s, -1.0, f->half);
        surface_advance_to(s, s->t + dt, 0.5 * dt);
        moving_end_rows(s);
    } else if (s->step.dt > 0.0) {
        surface_advance(s, 0.5 * dt);
    }
    f->travelled = travelled;
    impose(s, s->t + dt);
}

/* The same as flows() through the outline of a partner's cells. */
static void add_outline(const struct fv *s, double sums[2])
{
    const struct forcing *g = s->forcing;
    for (int a = 0; a < s->dim; a++)
        for (int64_t i = 0; i < g->nface[a]; i++) {
            const int64_t c = g->face[a][i], d = grid_part(&s->grid, c, NULL)->stride[a];
            if (!g->counts[a][i] || (g->forced[c] != 1 && g->forced[c - d] != 1))
                continue;
            const double in = -g->sign[a][i] * grid_flow_area(&s->grid, c, a) * s->U[a][c] *
                              surface_face_share(s, c, a);
            sums[0] += in;
            sums[1] += fabs(in);
        }
}

/* Of a cell beside an opening: what counts as water of what passes. */
static double share_that_counts(const struct fv *s, int64_t c, int64_t in)
{
    const double held = carried_held(s, c, in);
    return surface_counted(s, c, held >= 0.0 ? held : surface_share(s, c));
}

/* m^dim/s: water that comes in through openings less what leaves, their sum, and the former without
 * a partner's outline, over all ranks. */
static void flows(const struct fv *s, double sums[3])
{
    sums[0] = sums[1] = 0.0;
    sides_passing(s, share_that_counts, sums);
    sums[2] = sums[0];
    if (s->surface->forced)
        add_outline(s, sums);
    MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, s->comm);
}

/* Whether phi follows the shares of water in cells. */
static bool is_carried(const struct fv *s)
{
    return s->surface->fraction && s->surface->fraction->carries > 0.0;
}

/* phi and the water of cells by dt, to time t: the flows are those of where blocks are now. */
static void advance_water(struct fv *s, double t, double dt)
{
    if (is_carried(s))
        fraction_set_flows(s);
    const int parts = s->moving ? surface_advance_to(s, t, dt) : surface_advance(s, dt);
    if (is_carried(s))
        fraction_advance(s, dt, parts);
}

/* -: of the water, what phi loses in a step of water that is not calm, however smooth. Running
 * waves lose 2e-6 and less, 2e-5 a tank that sways until it breaks, from where the shares take
 * over. */
static const double LOST = 1e-5;

/* Whether phi has lost so much in this step. Long steps of newton and bdf2, and flat cells, in
 * which shares make waves rough, lose more and are left to phi. */
static bool loses(const struct fv *s, double before)
{
    const struct surface *f = s->surface;
    return s->prm.integrator == INTEGRATOR_RK3 && f->largest <= 2.001 * f->least &&
           fabs(f->returned - before) > LOST * surface_volume_scale(s);
}

/* The water at the end of a step: what phi has lost is put back, or it follows the shares, which
 * may change from one to the other. */
static void keep_water(struct fv *s)
{
    struct fraction *f = s->surface->fraction;
    const double before = s->surface->returned;
    if (is_carried(s))
        fraction_correct_level(s);
    else
        surface_keep_volume(s);
    if (!f)
        return;
    const bool calm = !loses(s, before) && fraction_is_calm(s);
    f->calm = calm ? fmin(f->calm + 1.0, SURFACE_CALM) : 0.0;
    if (is_carried(s) && f->calm == SURFACE_CALM) {
        f->carries = 0.0;
        surface_keep_volume(s);
    } else if (!is_carried(s) && !calm) {
        fraction_take(s);
        f->passed_time = -1.0;
        f->carries = 1.0;
    }
}

/* Through openings within a step dt: what the fluxes of the shares say, else half of the flows at
 * its start and end (now). */
static void note_openings(struct fv *s, double dt, const double now[3])
{
    struct surface *f = s->surface;
    const double half = 0.5 * dt, *start = f->through;
    const bool carried = is_carried(s);
    if (!carried)
        outflow_count_flows(s, half, share_that_counts);
    outflow_settle(s, dt);
    f->volume0 += carried ? f->carried_in + f->fraction->entered : half * (start[0] + now[0]);
    f->passed += half * (start[1] + now[1]);
    f->entered += carried ? f->carried_in + f->fraction->entered : half * (start[2] + now[2]);
}

void surface_first_half(struct fv *s, double dt)
{
    s->surface->theta_least = least_theta(s, dt);
    flows(s, s->surface->through);
    if (!is_carried(s))
        outflow_count_flows(s, 0.5 * dt, share_that_counts);
    if (s->surface->fraction)
        fraction_count(s->surface->fraction, s->size);
    if (s->moving)
        moving_begin_surface(s, dt);
    advance_water(s, s->t + 0.5 * dt, 0.5 * dt);
    impose(s, s->t + 0.5 * dt);
    refresh_band(s);
    if (is_carried(s)) {
        s->surface->carried_in = s->surface->fraction->entered;
        fraction_correct_level(s);
    }
    if (s->surface->half)
        go_ahead(s, dt);
    rebuild(s);
    set_openings(s);
    surface_smooth(s, dt);
    surface_extend(s, STENCILS);
    if (s->moving && s->prm.integrator != INTEGRATOR_NEWTON)
        moving_to_start(s);
}

void surface_second_half(struct fv *s, double dt)
{
    struct surface *f = s->surface;
    double now[3];
    if (f->half)
        memcpy(f->phi, f->half, (size_t)s->size * sizeof(double));
    if (s->moving && f->half)
        surface_mesh_change_height(s, 1.0, f->phi);
    if (f->fraction)
        fraction_note_layers(s);
    advance_water(s, s->t, 0.5 * dt);
    if (is_carried(s)) /* the next step begins with them */
        f->fraction->has_flows = true;
    if (s->moving)
        surface_mesh_count(s);
    impose(s, s->t);
    flows(s, now);
    note_openings(s, dt, now);
    refresh(s);
    keep_water(s);
    surface_sample(s);
}

/* What is counted and summed up, too: before a step, or `back' after one that is taken back. */
static void keep_numbers(struct surface *f, bool back)
{
    struct kept_number numbers[FV_RESTART_NUMBERS];
    const int n = fv_surface_numbers(f, numbers);
    for (int k = 0; k < n; k++)
        if (back)
            kept_number_set(numbers + k, f->numbers_before[k]);
        else
            f->numbers_before[k] = kept_number_get(numbers + k);
}

void surface_keep_state(struct fv *s)
{
    double *f[FV_RESTART_FIELDS];
    const char *names[FV_RESTART_FIELDS];
    const int n = fv_restart_fields(s, f, names);
    for (int k = 0; k < n; k++) {
        if (!s->surface->before[k])
            s->surface->before[k] = NEW_IN(s->surface, double, s->size);
        grid_copy_near(&s->grid, f[k], s->surface->before[k]);
    }
    near_water_keep(s);
    s->surface->travelled_before = s->surface->travelled;
    keep_numbers(s->surface, false);
    levels_keep(s);
    outflow_keep_budget(s);
}

void surface_back(struct fv *s)
{
    double *f[FV_RESTART_FIELDS];
    const char *names[FV_RESTART_FIELDS];
    const int n = fv_restart_fields(s, f, names);
    near_water_back(s);
    for (int k = 0; k < n; k++)
        grid_copy_near(&s->grid, s->surface->before[k], f[k]);
    fraction_forget_flows(s);
    outflow_restore(s);
    outflow_budget_back(s);
    keep_numbers(s->surface, true);
    levels_back(s);
    if (s->moving) {
        moving_back(s);
        surface_mesh_update(s);
    }
    s->surface->repeats++;
}

const char *surface_trouble(const struct fv *s)
{
    if (s->surface->cuts == 0 && sides_give_inflow(s) && !sides_give_pressure(s))
        return "the domain is full of water, and more flows in";
    const bool leaves = sides_kinds(s) & 1u << MESH_OUTFLOW; /* then it may all have left */
    return s->surface->wet > 0 || s->surface->forced || leaves ? NULL
                                                               : "no cell holds water any more";
}
