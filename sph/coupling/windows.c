/* windows.c - see windows.h. Outside there is a flow of constant density: velocities forced on it
 * that change by du over a coupling step T make a pressure rho A du/T, A the added mass of its
 * region, and SPH answers by p/(rho c0): a gain G = A/(c0 T). A cubic in time foresees a coupling
 * step to about (omega T)^3, so that T must be short beside the flow's own times.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "windows.h"

#include "../open_boundaries/sph_open_boundaries.h"
#include "../particles/sph_particles.h"

/* Bounds of T for accuracy: U T/L of the flow; omega T of waves, whose errors add up over
 * periods; T times the rate at which viscosity levels the flow: 0.16, 0.046, 0.014, 0.0035 of
 * velocity error with 1.3, 0.79, 0.44, 0.23 (Taylor-Green, Re 1). */
static const double flow_share = 0.03, wave_share = 0.1, viscous_share = 0.2;
/* Sound that no open side lets go is fed by what is late in the pressure outside: with omega T of
 * 1.1 it grew tenfold in 0.1 s, and with longer memories as fast. */
static const double sound_share = 0.5;
/* Beyond it what is foreseen by a parabola, (2 sin(omega T/2))^3 of the signal off, is worth less
 * than the last value: omega T = pi/3. */
static const double flow_most = 1.0 / 6.0, wave_most = M_PI / 3.0;
static const double gain_smoothed = 0.4, gain_most = 1.0;
static const double c0_most =
    10.0; /* times that of the case: no speed of sound is proposed beyond */
static const double cells_least =
    1.5;                             /* dx: 0.106 % of error at 2.5, 0.216 % at 1 (Taylor-Green) */
static const double most_way = 24.0; /* R/c0: longer ones were never tried */

/* Largest speed that walls and bodies are given, m/s: translation plus spin times the farthest
 * vertex. */
static double speed_of_bodies(const struct scene *c)
{
    double U = 0.0;
    for (int k = 0; k < c->nwalls; k++)
        U = fmax(U, vec3_length(c->walls[k].velocity));
    for (int k = 0; k < c->nbodies; k++) {
        const struct scene_body *b = c->bodies + k;
        double far = 0.0;
        for (int i = 0; i < b->points.n; i++)
            far = fmax(far,
                       hypot(b->points.x[i][0] - b->centre[0], b->points.x[i][1] - b->centre[1]));
        const struct trimesh *m = scene_body_mesh(c, k);
        for (int i = 0; m && i < m->nvertices; i++)
            far = fmax(far, vec3_distance(m->x[i], b->centre));
        U = fmax(U, vec3_length(b->velocity) + vec3_length(b->spin) * far);
    }
    return U;
}

static bool is_given(const struct run *r, const char *key)
{
    return r->params && params_given(r->params, key); /* a test has a scene without a case */
}

/* Sets U, L, omega and weight. U: of the initial field, if that has it, or given; of what carries
 * or moves, or of long waves sqrt(g H), 0.1 c0 if nothing else is known; L: the smallest side of
 * the box, or the field's own wave length. */
static void scales(const struct run *r, const struct sph_params *prm, struct windows *w)
{
    const struct scene *c = &r->scene;
    const int field = c->initial.field, down = scene_still_axis(c);
    const double carried = vec3_length(c->initial.velocity);
    const bool own = (field > FIELD_UNIFORM && !scene_has_wave(c)) || is_given(r, "initial.U");
    const bool periodic_field = scene_has_wave(c) || field == FIELD_TAYLOR_GREEN ||
                                field == FIELD_TWO_MODES || field == FIELD_BELTRAMI;
    w->U = own ? c->initial.U : 0.0;
    w->U = field == FIELD_TAYLOR_GREEN || field == FIELD_TWO_MODES ? w->U + carried
                                                                   : fmax(w->U, carried);
    w->U = fmax(w->U, speed_of_bodies(c));
    w->L = INFINITY;
    for (int a = 0; a < c->domain.dim; a++)
        w->L = fmin(w->L, prm->box[1][a] - prm->box[0][a]);
    if (periodic_field || is_given(r, "initial.L"))
        w->L = scene_wave_length(c);
    const double k = (periodic_field ? 2.0 : 1.0) * M_PI / w->L; /* half a wave fits the box */
    w->decay = c->fluid.nu * (periodic_field ? c->domain.dim : 1) * k * k;
    if (down >= 0 && scene_has_surface(c)) {
        const double g = fabs(c->fluid.gravity[down]), H = crossing_depth(c, down);
        const double q = 2.0 * M_PI / scene_wave_length(c) * (c->initial.L_z > 0.0 ? M_SQRT2 : 1.0);
        w->omega = scene_has_wave(c) ? sqrt(g * q * tanh(q * H)) : sqrt(g / H);
        w->weight = g * fmin(H, w->L);
        if (!scene_has_wave(c) && !r->crossed) /* else fv has the long waves, too */
            w->U = fmax(w->U, sqrt(g * H));
    }
    if (!(w->U > 0.0))
        w->U = 0.1 * prm->c0;
}

/* Least wave number of what may pass through a side of axis a: half a wave between walls, a whole
 * one around a period, half a one where the flow can go around both ends of the side; where a
 * wall is at one of them it is longer: with 1 boxes at walls round a towed body diverged, with 0.5,
 * the mirror's, four times the gain is foreseen where twice as much was there. */
static double lateral(const struct run *r, const struct sph_params *prm, const bool *open, int a)
{
    const struct scene_domain *d = &r->scene.domain;
    double k = INFINITY;
    for (int b = 0; b < d->dim; b++) {
        const double width = prm->box[1][b] - prm->box[0][b];
        const bool round = d->periodic[b] && !open[2 * b] && !open[2 * b + 1];
        const bool mirrored = open[2 * b] != open[2 * b + 1];
        if (b != a)
            k = fmin(k, (round ? 2.0 : mirrored ? 0.7 : 1.0) * M_PI / width);
    }
    return k;
}

/* Whether air stands at the start over the water below or above x, whose height is anything. */
static bool has_air(const struct scene *c, const struct exact *e, int up, double dx, double *x)
{
    const struct scene_domain *d = &c->domain;
    const int n = (int)ceil((d->max[up] - d->min[up]) / dx);
    const double upper = c->fluid.gravity[up] < 0.0 ? 1.0 - 1e-6 : 1e-6; /* end of each layer */
    bool air = false;
    for (int i = 0; i < n && !air; i++) {
        x[up] = d->min[up] + (i + upper) * (d->max[up] - d->min[up]) / n;
        air = scene_is_room(c, x) && !scene_is_fluid(c, e, x, NULL);
    }
    return air;
}

double windows_roofed(const struct run *r, const struct sph_params *prm, int side)
{
    const struct scene *c = &r->scene;
    const int a = side / 2, up = scene_still_axis(c);
    const double from = prm->box[side % 2][a], to = side % 2 ? c->domain.max[a] : c->domain.min[a];
    const int n = (int)ceil(fabs(to - from) / prm->dx - 1e-6);
    const struct exact e = exact_create(c);
    double x[3] = {0.0};
    if (!r->crossed || a == up || n == 0)
        return 0.0;
    for (int b = 0; b < c->domain.dim; b++)
        x[b] = 0.5 * (prm->box[0][b] + prm->box[1][b]);
    for (int i = 0; i < n; i++) {
        x[a] = from + (i + 0.5) * (to - from) / n;
        if (has_air(c, &e, up, prm->dx, x))
            return i * fabs(to - from) / n;
    }
    const struct scene_wall *w = scene_wall_of(c, (enum scene_side)(SIDE_X_MIN + side));
    const bool shut = w && (w->kind == WALL_SLIP || w->kind == WALL_NO_SLIP);
    return shut && c->domain.dim == 2 ? INFINITY : fabs(to - from);
}

/* Added mass that acts on SPH at one side, of the partner's region between its forced cells and a
 * wall d behind them, by potential theory: coth(k d)/k there, cosh along the overlap D. m: per area
 * and density. Along the overlap D the motion decays as cosh or exp. */
static double mass_at(const struct run *r, const struct sph_params *prm, const bool *open, int side,
                      double D)
{
    const struct scene_domain *d = &r->scene.domain;
    const int a = side / 2;
    const double k = lateral(r, prm, open, a);
    if (r->crossed) { /* a surface bounds it: Westergaard, decaying over the overlap; under a roof
                         all moves as one as far as the surface */
        const double H = crossing_depth(&r->scene, scene_still_axis(&r->scene));
        const double roofed = windows_roofed(r, prm, side);
        return 0.55 * H * exp(-1.6 * D / H) + (isfinite(roofed) ? roofed : 0.0);
    }
    const bool walled = scene_wall_of(&r->scene, (enum scene_side)(SIDE_X_MIN + side)) != NULL;
    const double beyond = side % 2 ? d->max[a] - prm->box[1][a] : prm->box[0][a] - d->min[a];
    /* The box spans the flow: what lies beyond can move as a whole, half of a period to each side.
     */
    bool spans = !walled;
    for (int b = 0; b < d->dim; b++)
        spans = spans && (b == a || (!open[2 * b] && !open[2 * b + 1]));
    if (spans) {
        const double width = prm->box[1][a] - prm->box[0][a];
        return fmax(exp(-k * D) / k,
                    d->periodic[a] ? 0.5 * (d->max[a] - d->min[a] - width) : beyond);
    }
    if (!walled || k * (beyond + D) > 20.0)
        return exp(-k * D) / k;
    return cosh(k * beyond) / sinh(k * (beyond + D)) / k;
}

/* The side with the largest added mass counts. */
static void find_gain(const struct run *r, const struct sph_params *prm, struct windows *w)
{
    double transition, buffer, free[2][3], given[2][3];
    bool open[6];
    sph_params_open(r, prm, open);
    zones_widths(r, prm, &transition, &buffer);
    zones_free_box(r, prm, free[0], free[1]);
    zones_given_box(r, prm, given[0], given[1]);
    for (int side = 0; side < 6; side++)
        if (open[side]) {
            const int a = side / 2;
            const double overlap = side % 2 ? free[1][a] - given[1][a] : given[0][a] - free[0][a];
            w->mass = fmax(w->mass, mass_at(r, prm, open, side, overlap + transition + buffer));
        }
}

/* 1 at memory 1. */
double windows_smoothed(int memory) { return (2.0 * memory - 1.0) / ((double)memory * memory); }

/* The largest gain without smoothing. A river that starts from rest ran at 0.24 and ended at 0.28,
 * a box from wall to wall round a square in a stream at 0.24 and at 0.29; at 0.2 regular waves
 * would be smoothed, too, whose phase was 0.9 instead of 0.6 % of a period off then. */
static const double gain_raw = 0.25;

/* Least memory m with G (2 m - 1)/m^2 below the limit; two windows smooth next to nothing. Solves
 * m^2 - 2 g m + g >= 0 for the least m, with g = G/limit. */
static int memory_for(double gain)
{
    if (gain <= gain_raw)
        return 1;
    const double g = fmax(gain / gain_smoothed, 1.0);
    return (int)fmax(ceil(g + sqrt(g * g - g)), 3.0);
}

/* Coupling steps are equal and serve the outputs: they are shorter than what was asked for. */
static double tiled(const struct scene *c, double T)
{
    const int64_t n = coupling_steps_number(c->time.end, 0.0, c->output.every, T);
    return n > 0 ? c->time.end / (double)n : T;
}

/* s over a radian of the sound that oscillates between a partner's water and a box that is open at
 * its top alone, under the partner's surface: what stands over it moves as a whole on the box's
 * water as on a spring, and no side lets that sound go. INFINITY: another box. */
static double sound_time(const struct run *r, const struct sph_params *prm)
{
    const struct scene *c = &r->scene;
    const int up = scene_still_axis(c);
    bool open[6];
    if (!r->crossed || up < 0)
        return INFINITY;
    sph_params_open(r, prm, open);
    const int top = 2 * up + (c->fluid.gravity[up] < 0.0);
    for (int side = 0; side < 2 * c->domain.dim; side++)
        if (open[side] != (side == top))
            return INFINITY;
    const double height = prm->box[1][up] - prm->box[0][up];
    const double over = fmax(crossing_depth(c, up) - height, 0.0);
    return sqrt(height * over + 4.0 / (M_PI * M_PI) * height * height) / prm->c0;
}

/* T becomes the bound if that is shorter, and `limit' names it. */
static void shorten(struct windows *w, double T, const char *limit)
{
    if (T < w->T) {
        w->T = T;
        w->limit = limit;
    }
}

/* Smallest width of fv's uniform cells, m; INFINITY: blocks. */
static double least_cell(const struct run *r)
{
    double from, h = INFINITY;
    for (int a = 0; a < r->scene.domain.dim && r->params; a++) {
        const double width = zones_cell(r, a, &from);
        h = width > 0.0 ? fmin(h, width) : h;
    }
    return h;
}

/* Nominal steps of dt s in a coupling step of a flow that walls set going from rest at once, or on
 * blocks a force along a period, as few as the gain allows; INFINITY: another flow. Layers grow
 * from such walls as sqrt(t), which neither a trial of the first coupling step by long steps nor a
 * straight line in time tells. Couette flow, a box of 0.6 L at the wall, nu t/L^2 = 0.01: the
 * velocity errs by 7.6, 5.1, 3.3 and 0.3 % with coupling steps of 14, 12, 6 and 1 steps. Blocks
 * take what sph gives to stand still in the first trial. */
static double start_steps(const struct run *r, const struct sph_params *prm,
                          const struct windows *w, double dt)
{
    const struct scene *c = &r->scene;
    const int field = c->initial.field;
    const bool rests = field == FIELD_REST || field == FIELD_POISEUILLE || field == FIELD_COUETTE ||
                       (field == FIELD_UNIFORM && vec3_length(c->initial.velocity) == 0.0);
    bool driven = false;
    for (int a = 0; a < c->domain.dim && isinf(least_cell(r)); a++)
        driven = driven || (c->domain.periodic[a] && c->fluid.gravity[a] != 0.0);
    for (int k = 0; k < c->nwalls; k++)
        driven =
            driven || (c->walls[k].kind == WALL_NO_SLIP && vec3_length(c->walls[k].velocity) > 0.0);
    if (!rests || !driven || scene_has_surface(c) || scene_shapes_move(c))
        return INFINITY;
    return fmax(4.0, ceil(1.1 * w->mass / (prm->c0 * gain_most * dt)));
}

/* T is the shortest of the bounds, in whole nominal steps (dt at rest); memory smooths what gain is
 * left. */
struct windows windows_choose(const struct run *r, const struct sph_params *prm)
{
    const struct scene_coupling *c = &r->scene.coupling;
    struct windows w = {.limit = "the longest tried"};
    double transition, buffer;
    const double dt = sph_params_dt(prm, r->scene.fluid.nu, prm->c0, NULL);
    scales(r, prm, &w);
    find_gain(r, prm, &w);
    zones_widths(r, prm, &transition, &buffer);
    w.T = most_way / prm->cfl * dt;
    const double still = w.decay > 0.0 ? viscous_share / w.decay : INFINITY,
                 wave = w.omega > 0.0 ? wave_share / w.omega : INFINITY;
    w.T_most = fmin(fmin(flow_share * w.L / w.U, still), wave);
    shorten(&w, flow_share * w.L / w.U, "the flow");
    shorten(&w, still, "viscosity");
    shorten(&w, wave, "the waves");
    shorten(&w, sound_share * sound_time(r, prm), "sound under the partner's water");
    const double box = box_motion_speed(r, prm);
    shorten(&w, transition / (w.U + box), "the path through the transition");
    /* cells are forced in a row or two ahead of it, and have values there; behind a crest the box
     * goes half as fast as it may at most, and shorter windows want more memory */
    const double cells = strcmp(prm->box_follows, BOX_TRACKING) == 0 ? 2.0 : 1.0;
    if (box > 0.0)
        shorten(&w, cells * least_cell(r) / box, "the path of the box through a cell");
    shorten(&w, dt * start_steps(r, prm, &w, dt), "the start from rest");
    w.steps = c->steps > 0 ? c->steps : (int)fmax(floor(w.T / dt * (1.0 + 1e-9)), 1.0);
    w.limit = c->steps > 0 ? "coupling.steps" : w.limit;
    w.T = w.steps * dt;
    w.gain = w.mass / (prm->c0 * tiled(&r->scene, w.T));
    w.memory = c->memory > 0 ? c->memory : memory_for(w.gain);
    return w;
}

/* The lowest c0 with a loop gain of at most 1, m/s; 0: ten times the case's c0 is too low. Tries it
 * in steps of 5 %, each with T chosen anew. */
static double lowest_c0(const struct run *r, const struct sph_params *prm)
{
    struct sph_params other = *prm;
    while (other.c0 < c0_most * prm->c0) {
        other.c0 *= 1.05;
        if (windows_choose(r, &other).gain <= gain_most)
            return other.c0;
    }
    return 0.0;
}

/* A wall that drags water out of a box, or into it, from the start on: what fv's imposed cells and
 * sph's zones lack of its layer in the first coupling steps holds that back, and the momentum that
 * is lost comes again as slowly as viscosity brings it (figures: start_steps). */
static void warn_of_drag(const struct run *r, const struct sph_params *prm, const struct windows *w)
{
    const struct scene *c = &r->scene;
    const int dim = c->domain.dim;
    bool open[6];
    sph_params_open(r, prm, open);
    for (int k = 0; k < c->nwalls && w->steps > 1; k++) {
        const struct scene_wall *wall = c->walls + k;
        const int side = wall->side - SIDE_X_MIN;
        bool drags = false;
        for (int a = 0; a < dim; a++)
            drags = drags || (wall->velocity[a] != 0.0 && (open[2 * a] || open[2 * a + 1]));
        if (drags && wall->kind == WALL_NO_SLIP && side >= 0 && c->fluid.nu > 0.0 &&
            sph_params_reaches(&c->domain, prm, side))
            log_warn("walls.[%d]: it moves at once, along open sides of sph.box, where its layer "
                     "grows faster than the programs can tell each other: velocities lack some "
                     "per cent of it for as long as the flow is new; coupling.steps = 1 has a "
                     "tenth of that",
                     k);
    }
}

/* What runs, but not as well as it could. Where the surface crosses the box its waves want their
 * cells (cases/waves_crossing: cells of 0.87 dx have a hundredth of the phase error of twice that).
 */
static void advise(const struct run *r, const struct sph_params *prm, const struct windows *w)
{
    const double h = least_cell(r), c0 = w->gain > gain_most ? lowest_c0(r, prm) : 0.0;
    char mend[160] = "a wider coupling.overlap, or a box whose open sides lie nearer to walls";
    if (!r->crossed && h < cells_least * prm->dx * (1.0 - 1e-9))
        log_warn("fv.cells: cells of %.3g m are %.3g times sph.dx; below %g the programs' errors "
                 "grow, as much as twofold at 1: fewer cells, or refine sph.dx",
                 h, h / prm->dx, cells_least);
    if (c0 > 0.0)
        snprintf(mend, sizeof mend, "sph.c0 = %.3g m/s lowers it to 1, at %.1f times the steps", c0,
                 c0 / prm->c0);
    if (w->gain > gain_most)
        log_warn("gain of the coupling loop %.2g, above %g: smoothing alone keeps the programs "
                 "together, and forces may be noisy; %s",
                 w->gain, gain_most, mend);
    warn_of_drag(r, prm, w);
}

/* left: the gain after smoothing. */
void windows_describe(const struct run *r, const struct sph_params *prm)
{
    const struct windows w = windows_choose(r, prm);
    const double left = w.memory > 1 ? w.gain * windows_smoothed(w.memory) : w.gain;
    double overlap[3];
    log_say(
        "coupling steps of %d steps, %.3g s, limited by %s: U T/L = %.3f (U %.3g m/s, L %.3g m)",
        w.steps, w.T, w.limit, w.U * w.T / w.L, w.U, w.L);
    zones_overlap(r, prm, overlap);
    log_say(r->scene.domain.dim == 3 ? "overlap (%.3g, %.3g, %.3g) m wide (coupling.overlap)"
                                     : "overlap (%.3g, %.3g) m wide (coupling.overlap)",
            overlap[0], overlap[1], overlap[2]);
    if (w.memory > 1)
        log_say("gain of the coupling loop %.2g: fv's pressure smoothed over %d coupling steps, "
                "%.2g is left",
                w.gain, w.memory, left);
    else
        log_say("gain of the coupling loop %.2g: fv's pressure as in its trial, not smoothed",
                w.gain);
    if (w.T > 2.0 * w.T_most)
        log_warn("coupling.steps = %d: coupling steps of %.3g s are %.1f times what this flow "
                 "allows; 0 takes %.3g s",
                 w.steps, w.T, w.T / w.T_most, w.T_most);
    if (left > (w.memory > 1 ? gain_smoothed : gain_raw) * (1.0 + 1e-9))
        log_warn("gain of the coupling loop %.2g: near its limit of %g; longer coupling steps "
                 "(coupling.steps), a longer coupling.memory or a wider coupling.overlap lower it",
                 left, gain_most);
    advise(r, prm, &w);
}

/* T: s, the coupling step that all programs have agreed on. A shorter one than ours has a
 * larger gain. */
void windows_compare(const struct run *r, const struct sph_params *prm, double T)
{
    const struct windows w = windows_choose(r, prm);
    const double gain = w.mass / (prm->c0 * T),
                 left = w.memory > 1 ? gain * windows_smoothed(w.memory) : gain;
    const int memory = memory_for(gain);
    if (T < 0.999 * tiled(&r->scene, w.T) && memory > w.memory)
        log_warn("another program wishes coupling steps of %.3g s, sph %.3g s: the gain of the "
                 "coupling loop is %.2g with them, %.2g is left: coupling.steps = %d and "
                 "coupling.memory = %d smooth it away%s",
                 T, w.T, gain, left, (int)fmax(floor(T * w.steps / w.T), 1.0), memory,
                 gain > gain_most ? "; a wider coupling.overlap lowers it" : "");
}

/* Three faults: T too long for extrapolation, a loop that is unstable even when smoothed, and
 * smoothing that takes as long as a wave. */
void windows_check(const struct run *r, const struct sph_params *prm, struct faults *f)
{
    const struct windows w = windows_choose(r, prm);
    const bool given = r->scene.coupling.steps > 0;
    const double flow = w.U * w.T / w.L, wave = w.omega * w.T;
    const double left = w.memory > 1 ? w.gain * windows_smoothed(w.memory) : w.gain;
    const double lag = w.memory > 1 ? w.omega * w.T * w.memory : 0.0;
    if (flow > flow_most || wave > wave_most)
        params_fault(r->params, f, given ? "coupling.steps" : "sph.dx",
                     "coupling steps of %d steps are %.3g s: %s = %.2g, above %.2g values cannot "
                     "be extrapolated in time; %s",
                     w.steps, w.T, flow > flow_most ? "U T/L" : "omega T of the waves",
                     flow > flow_most ? flow : wave, flow > flow_most ? flow_most : wave_most,
                     given ? "lower coupling.steps, 0 takes what the flow allows"
                           : "a single step of sph is too long for this flow: refine sph.dx");
    if (left > gain_most)
        params_fault(r->params, f,
                     r->scene.coupling.memory > 0 ? "coupling.memory" : "coupling.steps",
                     "gain of the coupling loop %.2g, %.2g smoothed over %d coupling steps, is "
                     "unstable above %g: raise coupling.steps, or leave memory and steps at 0",
                     w.gain, left, w.memory, gain_most);
    if (lag > 1.0)
        params_fault(r->params, f, "coupling.overlap",
                     "fv's pressure must be smoothed over %d coupling steps, %.2g s, as long as "
                     "the waves take: widen coupling.overlap (sph.box lower), or raise sph.c0",
                     w.memory, w.T * w.memory);
}
