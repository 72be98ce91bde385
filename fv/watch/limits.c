/* limits.c - see limits.h. rk3: the convective terms are stable while the sum over the axes of
 * |u_a| dt/h_a is below sqrt(3)/1.372 = 1.262 in every cell: the stability limit of the scheme on
 * the imaginary axis over the largest modified wave number of fourth-order differences, (8 sin x -
 * sin 2x)/6. bdf2: extrapolated convection amplifies every wave a little, which viscosity must
 * outweigh; the linear limit of the sum is close to 0.9 Re^(-1/3), Re = |u| h/nu of a cell (0.42,
 * 0.20, 0.097 at 10, 100, 1000), and 0 without viscosity. limits_of gives the next step from the
 * state as it was measured, limits_estimate one from the scene alone, for --check; both take the
 * least of the bounds and name it. A bound of the kind "rate now and rise per second" is solved for
 * the time in which dt (rate + rise dt) reaches cfl (time_to_cross).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "limits.h"

#include "../../common/scene/scene.h"
#include "../boundary/fv_boundary.h"
#include "../grid/fv_grid.h"
#include "../operators/fv_operators.h"
#include "../surface/fv_surface.h"

#define RK3_CFL 1.1      /* default */
#define RK3_MOST 1.2     /* refused above */
#define RK3_LINEAR 1.262 /* stable to here */
#define BDF2_CFL 0.5
#define BDF2_MOST 0.7
#define BDF2_SLOW 500.0   /* U h/nu: above, its steps are a tenth of rk3's */
#define NEWTON_CFL 1.0    /* of accuracy: it is stable at any */
#define TRANSIENT 0.25    /* of the time of layers that grow from walls: a step of newton */
#define STEPS_OF_WAVE 6.0 /* of newton in the period of the longest wave: measured */
#define OUTFLOW_CFL 0.5   /* of the whole flow, which a carried outflow meets in time: measured */
#define VISCOUS_MOST 1.0  /* nu dt/h^2 where a surface's normal stress is explicit */
#define STIFFEST 7.75     /* h^2/nu times the largest eigenvalue of friction with walls */
#define START_STIFF 60.0  /* first steps after a sudden start, of the time of that eigenvalue */
#define START_SHARE 0.1   /* and later ones, of the time since: measured, README.md */
#define DECAY_SHARE 0.1   /* of the time in which friction levels the start: README.md */
#define MOVED_STIFF                                                                                \
    240.0         /* always where walls go with their blocks, which start anew all the time */
#define WAVES 0.5 /* dt of sqrt(h/g), h of the smallest cell */

const char *limit_name(enum limit by)
{
    static const char *const names[] = {"nothing",   "flow",  "forces", "outflow", "bdf2",
                                        "viscosity", "waves", "motion", "output"};
    return names[by];
}

/* fv.cfl, or the integrator's own. */
double limits_cfl(const struct fv_params *p)
{
    static const double own[] = {RK3_CFL, BDF2_CFL, NEWTON_CFL};
    return p->cfl > 0.0 ? p->cfl : own[p->integrator];
}

/* Bounds of stability; bdf2 has none without viscosity. */
void limits_check(const struct run *r, const struct fv_params *p, struct faults *f)
{
    const bool bdf2 = p->integrator == INTEGRATOR_BDF2;
    const double most = bdf2 ? BDF2_MOST : RK3_MOST;
    if (p->integrator != INTEGRATOR_NEWTON && p->cfl > most)
        params_fault(r->params, f, "fv.cfl",
                     "%g: %s is stable up to %g (of the sum over the axes of |u_a| dt/h_a)", p->cfl,
                     bdf2 ? "bdf2" : "rk3", most);
    if (bdf2 && r->scene.fluid.nu == 0.0)
        params_fault(r->params, f, "fv.integrator",
                     "bdf2 has no stable step without viscosity: rk3, or fluid.nu > 0");
}

/* The positive root of rise dt^2 + rate dt = cfl, in the form without cancellation. */
static double time_to_cross(double cfl, double rate, double rise)
{
    const double sum = rate + sqrt(rate * rate + 4.0 * cfl * rise);
    return sum > 0.0 ? 2.0 * cfl / sum : INFINITY;
}

/* Replaces the bound by dt if that is shorter. */
static void lower(struct step_limit *l, double dt, enum limit by)
{
    if (dt < l->dt)
        *l = (struct step_limit){dt, by};
}

/* --- the scene --- */

/* Largest side of the domain, m. */
static double length_of(const struct scene *s)
{
    double L = 0.0;
    for (int a = 0; a < s->domain.dim; a++)
        L = fmax(L, s->domain.max[a] - s->domain.min[a]);
    return L;
}

/* Pressures at openings, the largest difference over rho; 0 where one side alone is open. */
double limits_pressure_difference(const struct scene *s)
{
    double least = INFINITY, most = -INFINITY;
    for (int k = 0; k < s->nwalls; k++)
        if (s->walls[k].kind == WALL_OUTFLOW && !s->walls[k].carried) {
            least = fmin(least, s->walls[k].pressure / s->fluid.rho);
            most = fmax(most, s->walls[k].pressure / s->fluid.rho);
        }
    return most > least ? most - least : 0.0;
}

/* The scene's own where something moves or can fall: nothing does without a surface, where the
 * pressure takes gravity across sides, but for a partner's fluid, which sound compresses; or what
 * enters through blocks' sides. At least a thousandth of the domain in the run's time. */
double limits_reference(const struct run *r)
{
    const struct scene *s = &r->scene;
    struct scene held = *s;
    for (int a = 0; a < s->domain.dim && !scene_has_surface(s) && !r->coupled; a++)
        held.fluid.gravity[a] = s->domain.periodic[a] ? s->fluid.gravity[a] : 0.0;
    const struct scene_speed v = scene_speed_of(&held, 0.0, 0.0);
    const double flows = v.moves || scene_has_surface(s) || r->coupled ? v.speed : 0.0;
    return fmax(fmax(flows, vec3_length(s->initial.velocity)), 1e-3 * length_of(s) / s->time.end);
}

/* Of the field alone: what carries it changes nothing. Beltrami flow on 8^3 cells, from U h/nu =
 * 4000 on, gained energy after 17 turns; at 400 it does not,
 * but two thirds of what is left are waves of two cells (with the bias 6 %). */
double limits_upwind(const struct run *r, bool walls, double cells)
{
    const struct scene *s = &r->scene;
    double volume = 1.0;
    for (int a = 0; a < s->domain.dim; a++)
        volume *= s->domain.max[a] - s->domain.min[a];
    const double h = pow(volume / cells, 1.0 / s->domain.dim);
    return walls || s->initial.U * h > 200.0 * s->fluid.nu ? 1.0 : 0.0;
}

/* The reference may grow by 2 % a step, so that a burst does not raise its own limit; ten times it
 * is the limit. */
double limits_follow(double *reference, double most)
{
    *reference = fmax(*reference, fmin(most, 1.02 * *reference));
    return 10.0 * *reference;
}

/* --- the step --- */

/* Rows of unequal height grow downwards: b->h is the least one, the lowest row the largest. */
static double largest_size(const struct block *b, int a)
{
    return a == 1 && b->rows ? (b->rows->edge[1] - b->rows->edge[0]) : b->h[a];
}

/* Cells a second that walls, openings and pressures will make the fluid beside them cross. */
static double imposed_rate(const struct scene *s, const double *h)
{
    double most = 0.0;
    for (int k = 0; k < s->nwalls; k++) {
        double rate = 0.0;
        for (int a = 0; a < s->domain.dim; a++)
            rate += fabs(s->walls[k].velocity[a]) / h[a];
        most = fmax(most, rate);
    }
    if (s->initial.field == FIELD_POISEUILLE) /* starts from rest */
        most = fmax(most, s->initial.U / h[0]);
    return most;
}

static const struct scene_wall *opening_of(const struct scene *s, int side)
{
    const struct scene_wall *w = scene_wall_of(s, (enum scene_side)side);
    return w && w->kind == WALL_OUTFLOW && !w->carried ? w : NULL;
}

/* Whether pressures are given on opposite sides alone, of which a straight channel between them
 * makes a gradient along the axis that joins them. */
static bool openings_face_each_other(const struct scene *s, const struct fv_params *p)
{
    int axes = 0;
    for (int a = 0; a < s->domain.dim; a++)
        axes += opening_of(s, SIDE_X_MIN + 2 * a) || opening_of(s, SIDE_X_MIN + 2 * a + 1);
    return axes == 1 && p->nboxes == 0;
}

/* Gradient of pressure over rho between openings, m/s^2: along an axis over the distance of its two
 * sides; round a corner or boxes any path may be the steepest. */
static double gradient_along(const struct scene *s, const struct fv_params *p, int a)
{
    const struct scene_wall *lower = opening_of(s, SIDE_X_MIN + 2 * a),
                            *upper = opening_of(s, SIDE_X_MIN + 2 * a + 1);
    const double L = s->domain.max[a] - s->domain.min[a];
    if (!openings_face_each_other(s, p))
        return limits_pressure_difference(s) / L;
    return lower && upper ? fabs(upper->pressure - lower->pressure) / (s->fluid.rho * L) : 0.0;
}

/* What forces add to that in a second, 1/s^2: gravity where it moves the fluid, differences of
 * pressure between sides. h: sizes along the axes. */
static double rise_of(const struct scene *s, const struct fv_params *p, bool surface,
                      const double *h)
{
    const struct gravity split = still_split(s);
    double sum = 0.0;
    for (int a = 0; a < s->domain.dim; a++)
        sum += (fabs(surface ? s->fluid.gravity[a] : split.periodic[a]) + gradient_along(s, p, a)) /
               h[a];
    return sum;
}

/* VISCOUS_MOST h^2/nu with the least size. */
static double viscous_time(double nu, const double *h, int dim)
{
    double least = INFINITY;
    for (int a = 0; a < dim; a++)
        least = fmin(least, h[a]);
    return nu > 0.0 ? VISCOUS_MOST * least * least / nu : INFINITY;
}

/* Waves of two cells: stable steps (rk3), or exact ones of waves that cells resolve. Implicit ones
 * do not see how flat the cells lie. */
static void lower_surface(struct step_limit *l, const struct scene *s, const struct fv_params *p,
                          double shortest, const double *h)
{
    const double g = vec3_length(s->fluid.gravity), cfl = limits_cfl(p),
                 part[] = {fmin(cfl, 1.0), cfl / BDF2_CFL, cfl};
    lower(l, g > 0.0 ? WAVES * part[p->integrator] * sqrt(shortest / g) : INFINITY, LIMIT_WAVES);
    if (p->integrator != INTEGRATOR_NEWTON)
        lower(l, viscous_time(s->fluid.nu, h, s->domain.dim), LIMIT_VISCOUS);
}

/* Spacing that tells the shortest waves of an even grid. */
static double shortest_of(const struct scene *s, const struct fv_params *p, const double *h)
{
    const double g = vec3_length(s->fluid.gravity);
    double shortest = INFINITY;
    for (int a = 0; a < s->domain.dim; a++)
        if (p->integrator == INTEGRATOR_RK3 || fabs(s->fluid.gravity[a]) < 0.7 * g)
            shortest = fmin(shortest, h[a]);
    return shortest;
}

/* Convection by two steps' extrapolation, at cell Reynolds number Re. */
static double bdf2_time(double rate, double Re)
{
    return rate > 0.0 ? 0.8 / (cbrt(Re) * rate) : INFINITY;
}

/* s: of the slowest layer between walls that exert friction, L^2/(pi^2 nu); INFINITY: none do. The
 * slowest mode of diffusion between two walls. */
static double friction_time(const struct scene *s)
{
    double T = INFINITY;
    for (int k = 0; k < s->nwalls && s->fluid.nu > 0.0; k++) {
        const int a = (s->walls[k].side - SIDE_X_MIN) / 2;
        if (s->walls[k].side == SIDE_NONE || s->walls[k].kind != WALL_NO_SLIP)
            continue;
        const double L = s->domain.max[a] - s->domain.min[a];
        T = fmin(T, L * L / (M_PI * M_PI * s->fluid.nu));
    }
    return T;
}

/* -: of a mode that decays as exp(-t/T), what newton's steps leave of it at the end more than that:
 * one step of backward Euler, then y_n+1 (3/2 + a) = 2 y_n - y_n-1/2, a = dt/T. */
static double left_over(double T, double end, double dt)
{
    const double n = ceil(end / dt * (1.0 - 1e-9)), a = end / n / T;
    double before = 1.0, now = 1.0 / (1.0 + a);
    for (double k = 1.0; k < fmin(n, 1000.0); k++) {
        const double next = (2.0 * now - 0.5 * before) / (1.5 + a);
        before = now;
        now = next;
    }
    return fabs(now - exp(-end / T));
}

/* newton has no bound by friction, for it goes to steady states; where the run ends in the midst of
 * the layers' growth, this is what it misses. Couette flow from rest to half of their time: energy
 * 24.6, 5.2, 1.2, 0.14 % off in 1, 2, 3, 5 steps. A run of many of their times in a step or two is
 * off, too: a channel of 40 in one step by 2.4 %. */
static void warn_transient(const struct run *r, const struct fv_params *p, double h)
{
    const struct scene *s = &r->scene;
    const double T = friction_time(s), whole = fmin(T, s->time.end);
    double dt = 0.0;
    if (p->integrator != INTEGRATOR_NEWTON || p->steady || !isfinite(T))
        return;
    const double most = limits_estimate(r, p, (const double[]){h, h, h}).dt;
    dt = fmin(most, s->time.end);
    dt = s->output.every > 0.0 ? fmin(dt, s->output.every) : dt;
    if (s->time.end <= 3.0 * T
            ? dt > TRANSIENT * whole
            : s->initial.field == FIELD_REST && left_over(T, s->time.end, dt) > 0.01)
        log_warn(
            "fv.integrator: newton's steps of %.2g s pass over the layers that grow from walls, "
            "whose time is %.2g s: the flow at %.2g s will be some per cent off; fv.cfl below "
            "%.2g, or rk3, which resolves them",
            dt, T, s->time.end, limits_cfl(p) * TRANSIENT * whole / most);
}

/* s: period of the longest standing wave of the water, as deep as it is at its highest; along a
 * period the longest is as long as that. w^2 = g k tanh(k H), k = pi/L or 2 pi/L. INFINITY: none.
 */
static double longest_period(const struct scene *s)
{
    const double g = vec3_length(s->fluid.gravity);
    const int up = scene_still_axis(s);
    double low, high, k = INFINITY;
    if (up < 0)
        return INFINITY;
    scene_heights(s, &low, &high);
    const double depth = fmin(scene_water_top(s), high) - low;
    for (int a = 0; a < s->domain.dim; a++)
        if (a != up)
            k = fmin(k, (s->domain.periodic[a] ? 2.0 : 1.0) * M_PI /
                            (s->domain.max[a] - s->domain.min[a]));
    return depth > 0.0 ? 2.0 * M_PI / sqrt(g * k * tanh(k * depth)) : INFINITY;
}

/* newton is stable at any step for small waves, but with steps of a quarter of a basin's
 * period their amplitude grows: 1 m x 0.4 m on 20 x 16 cells, 0.035 m at first: after 8 s 0.028 m
 * at 11 steps a period, 0.031 at 7, 0.21 at 4.4, 0.27 at 3. */
static void warn_long_steps(const struct run *r, const struct fv_params *p, double h)
{
    const double T = p->water ? longest_period(&r->scene) : INFINITY;
    if (p->integrator != INTEGRATOR_NEWTON || !(T < INFINITY))
        return;
    const double most = limits_estimate(r, p, (const double[]){h, h, h}).dt,
                 every = r->scene.output.every > 0.0 ? r->scene.output.every : INFINITY,
                 dt = fmin(fmin(most, every), r->scene.time.end);
    if (dt > T / STEPS_OF_WAVE)
        log_warn("fv.cfl: newton's steps of %.2g s are long for the water, whose longest wave has "
                 "a period of %.2g s: below %g steps a period its amplitude grows; fv.cfl "
                 "below %.2g",
                 dt, T, STEPS_OF_WAVE, limits_cfl(p) * T / STEPS_OF_WAVE / most);
}

/* Under a surface it is the number of steps, too, at which the level set loses water: the dam of
 * dam_break_crossing, cell Reynolds numbers 70, 700, 7e4: put back 4.6, 5.3, 39 % of the volume
 * (rk3: 0.9 %); the last one ends by the water that is missing at t = 0.44 s. */
void limits_warn(const struct run *r, const struct fv_params *p, double h)
{
    const double nu = r->scene.fluid.nu, Re = nu > 0.0 ? limits_reference(r) * h / nu : 0.0;
    warn_transient(r, p, h);
    warn_long_steps(r, p, h);
    if (p->integrator != INTEGRATOR_BDF2 || !p->water || Re < BDF2_SLOW)
        return;
    log_warn("fv.integrator: bdf2 is for slow, viscous flow: at a cell Reynolds number U h/nu of "
             "%.2g its "
             "steps will be %.2g times shorter than those of rk3, and a free surface loses more "
             "water in them: take rk3",
             Re, RK3_CFL / bdf2_time(1.0, Re));
}

/* Convection and forces, and under a surface waves and viscosity. */
static struct step_limit bulk_limit(const struct scene *s, const struct fv_params *p, double rate,
                                    bool surface, const double *h)
{
    /* what falls within an implicit step is seen when it has: the step is taken back */
    const bool falls = surface && p->integrator != INTEGRATOR_NEWTON;
    const double rise = surface && !falls ? 0.0 : rise_of(s, p, surface, h),
                 dt = time_to_cross(limits_cfl(p), rate, rise);
    struct step_limit l = {INFINITY, LIMIT_NONE};
    lower(&l, dt, rise * dt > rate ? LIMIT_FORCES : LIMIT_FLOW);
    if (surface)
        lower_surface(&l, s, p, shortest_of(s, p, h), h);
    return l;
}

/* 1/s: of uniform cells between walls. 0 without walls. */
static double friction_rate(const struct fv *s)
{
    double sum = 0.0;
    for (int a = 0; a < s->dim && s->bc; a++)
        sum += STIFFEST * s->nu / (s->b.h[a] * s->b.h[a]);
    return sum;
}

/* After a sudden start layers of sqrt(nu t) grow from walls; steps that pass over them leave the
 * pressure, which each step corrects once, behind the walls' friction: 15 steps and more. 1/s:
 * largest eigenvalue of the viscous terms. The first steps are START_STIFF over that eigenvalue,
 * later ones grow in proportion to the time since. */
static void lower_start(struct step_limit *l, const struct fv *s)
{
    const double stiffest = viscous_stiffest(s) > 0.0 ? viscous_stiffest(s) : friction_rate(s);
    const double later =
        s->moving ? MOVED_STIFF / fmax(stiffest, 1e-300) : START_SHARE * fabs(s->t);
    if (stiffest > 0.0 && s->prm.integrator != INTEGRATOR_NEWTON)
        lower(l, fmax(START_STIFF / stiffest, later), LIMIT_VISCOUS);
}

/* Prescribed motions, which the flow does not tell: small ones are slow beside their cells. */
static void lower_motion(struct step_limit *l, const struct fv *s)
{
    lower(l, grid_motion_step(&s->grid, s->t), LIMIT_MOTION);
}

double limits_decay(const struct scene *s)
{
    double k2 = 0.0, lo[3], hi[3];
    const int field = s->initial.field;
    if (scene_has_surface(s))
        return 0.0;
    if (field == FIELD_TAYLOR_GREEN || field == FIELD_TWO_MODES || field == FIELD_BELTRAMI)
        k2 = exact_create(s).K2;
    for (int k = 0; k < s->nshapes && scene_shapes_move(s); k++) {
        scene_shape_extent(s->shapes + k, lo, hi);
        for (int a = 0; a < s->domain.dim; a++)
            k2 = fmax(k2, pow(M_PI / (hi[a] - lo[a]), 2.0));
    }
    return s->fluid.nu * k2;
}

/* Newton's steps are the user's. The first one of bdf2 is of first order. */
static void lower_decay(struct step_limit *l, const struct fv_params *p, double rate, double t)
{
    const double first = p->integrator == INTEGRATOR_BDF2 ? 0.3 : 1.0;
    if (rate > 0.0 && p->integrator != INTEGRATOR_NEWTON)
        lower(l, DECAY_SHARE * fmax(first / rate, fabs(t)), LIMIT_VISCOUS);
}

/* Of cells of any shape: as the state was measured. */
static struct step_limit limit_on_blocks(const struct fv *s)
{
    const bool falls = s->surface && s->newton; /* such a step is taken back */
    const double rise = falls ? 0.0 : s->max.rise,
                 dt = time_to_cross(s->prm.cfl, s->max.rate, rise);
    struct step_limit l = {dt, rise * dt > s->max.rate ? LIMIT_FORCES : LIMIT_FLOW};
    if (s->surface) {
        const double h = s->surface->least;
        lower_surface(&l, &s->run->scene, &s->prm,
                      s->prm.integrator == INTEGRATOR_RK3 ? h : s->surface->across,
                      (const double[]){h, h, h});
    }
    if (s->outflows && s->outflows->convects && s->prm.integrator != INTEGRATOR_NEWTON)
        lower(&l, time_to_cross(fmin(s->prm.cfl, OUTFLOW_CFL), s->max.rate, 0.0), LIMIT_OUTFLOW);
    if (s->prm.integrator == INTEGRATOR_BDF2)
        lower(&l, bdf2_time(s->max.rate, s->max.Re), LIMIT_BDF2);
    lower_start(&l, s);
    lower_decay(&l, &s->prm, s->speed.decay, s->t);
    lower_motion(&l, s);
    return l;
}

double limits_next_motion(const struct fv *s) { return grid_motion_event(&s->grid, s->t); }

/* Largest |u_a| to count with along axis a, m/s: of the flow, of sides, or what drives it will
 * make. */
double fv_speed(const struct fv *s, int a)
{
    const bool falls = s->gravity.periodic[a] != 0.0 && s->run->scene.domain.periodic[a],
               driven = falls || (s->bc && s->bc->driven);
    return fmax(fmax(s->max.u[a], s->bc ? s->bc->speed_along[a] : 0.0),
                driven ? s->speed.scene : 0.0);
}

/* The size is that of the smallest cells; bdf2's Reynolds number that of the largest. */
struct step_limit limits_of(const struct fv *s)
{
    if (s->m)
        return limit_on_blocks(s);
    const double cfl = s->prm.cfl;
    double h[3] = {1.0, 1.0, 1.0}, Re = 0.0;
    for (int a = 0; a < s->b.dim; a++) {
        h[a] = s->b.h[a];
        Re = fmax(Re, fv_speed(s, a) * largest_size(&s->b, a) / fmax(s->nu, 1e-300));
    }
    const struct scene *scene = &s->run->scene;
    const double rate = fmax(s->max.rate, imposed_rate(scene, h));
    struct step_limit l = bulk_limit(scene, &s->prm, rate, s->surface != NULL, h);
    if (s->outflows && s->outflows->convects && s->prm.integrator != INTEGRATOR_NEWTON)
        lower(&l, time_to_cross(fmin(cfl, OUTFLOW_CFL), rate, 0.0), LIMIT_OUTFLOW);
    if (s->prm.integrator == INTEGRATOR_BDF2)
        lower(&l, bdf2_time(rate, Re), LIMIT_BDF2);
    lower_start(&l, s);
    lower_decay(&l, &s->prm, s->speed.decay, s->t);
    return l;
}

/* As limits_of from the scene's own velocities. */
struct step_limit limits_estimate(const struct run *r, const struct fv_params *p, const double *h)
{
    const struct scene *s = &r->scene;
    double rate = 0.0, shortest = INFINITY, longest = 0.0;
    for (int a = 0; a < s->domain.dim; a++) {
        rate += fabs(s->initial.velocity[a]) / h[a];
        shortest = fmin(shortest, h[a]);
        longest = fmax(longest, h[a]);
    }
    if (s->initial.field > FIELD_UNIFORM && !scene_has_wave(s))
        rate += s->initial.U / shortest;
    rate = fmax(rate, imposed_rate(s, h));
    struct step_limit l = bulk_limit(s, p, rate, p->water, h);
    for (int k = 0; k < s->nwalls; k++)
        if (s->walls[k].carried && p->integrator != INTEGRATOR_NEWTON)
            lower(&l, time_to_cross(OUTFLOW_CFL, rate, 0.0), LIMIT_OUTFLOW);
    if (p->integrator == INTEGRATOR_BDF2)
        lower(&l, bdf2_time(rate, limits_reference(r) * longest / s->fluid.nu), LIMIT_BDF2);
    lower_decay(&l, p, limits_decay(s), 0.0);
    return l;
}

/* The likely cause when a run has blown up: before and after are sums of |u_a| dt/h_a. */
void limits_explain(const struct fv_params *p, enum limit by, double before, double after,
                    bool surface, char *text, size_t size)
{
    if (p->integrator != INTEGRATOR_NEWTON && after > RK3_LINEAR && after > 1.2 * before)
        snprintf(text, size,
                 "the flow grew within the step, from %.2g to %.2g cells (sum over the axes): %s",
                 before, after,
                 surface ? "an impact, or water thinner than the cells: more cells"
                         : "what drives it begins suddenly, or it is finer than the cells; "
                           "fv.cfl below 0.6 tells which");
    else
        snprintf(text, size,
                 "the flow is finer than the cells: more cells or viscosity%s; the step was within "
                 "its limits (%s, %.2g cells)",
                 p->integrator == INTEGRATOR_NEWTON ? ", or fv.flux = \"upwind\""
                 : p->upwind > 0.0                  ? ""
                                                    : ", or fv.upwind = 1",
                 limit_name(by), before);
}
