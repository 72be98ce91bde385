/* scene_currents.c - see scene_currents.h. SPDX-License-Identifier: BSD-3-Clause */
#include "scene_currents.h"

#include "scene_fluid.h"
#include "scene_waves.h"
#include "wave_maker.h"

bool scene_currents_flow(const struct scene *s)
{
    return s->has_waves && (s->waves.current != 0.0 || !s->waves.closed);
}

/* The axis along which waves run; -1: they run between two. */
static int axis_of(const struct scene *s)
{
    double d[3];
    scene_waves_direction(s, d, NULL);
    for (int a = 0; a < s->domain.dim; a++)
        if (fabs(d[a]) > 1.0 - 1e-12)
            return a;
    return -1;
}

/* The zone before a side of that axis; NULL: none. A beach of a slip wall has that wall behind. */
static struct scene_wall *end_of(const struct scene *s, int axis, int upper)
{
    const struct scene_wall *w = scene_wall_of(s, SIDE_X_MIN + 2 * axis + upper);
    return w && w->zone != ZONE_NONE ? (struct scene_wall *)w : NULL;
}

/* Waves grow on a current that runs from the start on: accelerated later it would be a wave of its
 * own. */
static void check_start(const struct scene *s, const struct params *p, struct faults *f)
{
    double d[3];
    scene_waves_direction(s, d, NULL);
    const double U = s->waves.current;
    double off = 0.0;
    for (int a = 0; a < s->domain.dim; a++)
        off = fmax(off, fabs(s->initial.velocity[a] - U * d[a]));
    if (U != 0.0 && (s->initial.field != FIELD_UNIFORM || off > 1e-9 * fabs(U)))
        params_fault(p, f, "waves.current",
                     "%g m/s from the start: give initial: { field = \"uniform\"; velocity = (%g, "
                     "%g, %g); } (in 2D without the last)",
                     U, U * d[0], U * d[1], U * d[2]);
}

static void check_ends(const struct scene *s, const struct params *p, const char *key,
                       struct faults *f)
{
    const int axis = axis_of(s);
    if (axis < 0) {
        params_fault(p, f, "waves.direction",
                     "%g degrees: what the current carries goes in and out across the waves' way: "
                     "a multiple of 90, or no current and waves.closed = true",
                     s->waves.direction);
        return;
    }
    for (int upper = 0; upper < 2; upper++)
        if (!end_of(s, axis, upper))
            params_fault(p, f, key,
                         "the water comes in at one end of the waves' way and leaves at the other: "
                         "give %s the kind \"wave\" or \"beach\", which is open then",
                         scene_side_names[2 * axis + upper]);
}

void scene_currents_check(const struct scene *s, const struct params *p, struct faults *f)
{
    const char *key = s->waves.current != 0.0 ? "waves.current" : "waves.closed";
    if (!scene_currents_flow(s))
        return;
    if (scene_has_wave_maker(s))
        params_fault(p, f, key,
                     "a paddle closes the tank behind it, so nothing flows through: give a side "
                     "kind = \"wave\" instead");
    if (s->waves.kind == WAVE_FILE || s->waves.evolve != EVOLVE_NO || s->waves.spread > 0.0)
        params_fault(p, f, key,
                     "it is for regular waves and for sums of one direction: neither of a file nor "
                     "with waves.evolve or waves.spread");
    if (s->waves.order == 1 && s->waves.kind != WAVE_REGULAR && !s->waves.closed)
        params_fault(p, f, "waves.closed",
                     "waves of first order carry nothing: waves.order = 2, or closed = true");
    if (s->ngauges > 0)
        params_fault(p, f, "gauges",
                     "on a current waves that come back have another length, and gauges tells "
                     "them apart by one: take probes alone");
    check_ends(s, p, key, f);
    check_start(s, p, f);
}

/* m^2/s: along the waves' direction. */
static double flux_of(const struct scene *s, const struct waves *made)
{
    return s->waves.current * made->of.depth + (s->waves.closed ? 0.0 : made->transport);
}

double scene_currents_mean(const struct scene *s, const struct waves *made)
{
    return flux_of(s, made) / made->of.depth;
}

double scene_currents_rate(const struct wave_spec *of, double rate)
{
    const double c = waves_group_velocity(2.0 * M_PI / waves_length(of), of->g, of->depth);
    return of->current == 0.0 ? rate : rate * c / (c + of->current);
}

/* m^2/s: mean of what fully grown waves bring through x over their own period, n steps of dt. */
static double mean_flux(struct waves *made, double x, int n, double dt)
{
    double sum = 0.0;
    for (int k = 0; k < n; k++) {
        waves_at(made, k * dt);
        sum += waves_flux(made, x);
    }
    return sum / n;
}

/* Rows of t and what goes along the waves' direction through a side at x (m, along it), m^2/s. The
 * mean is flux_of at both ends, however the sum is cut; no waves reach a side behind a beach. */
static double *rows_of(const struct scene *s, bool wavy, double x, int *n)
{
    struct wave_spec of = scene_waves_spec(s);
    const double T = of.start * waves_period(&of);
    of.start = 0.0;
    of.window[0][0] = of.window[0][1] = x;
    struct waves *made = waves_create(&of);
    const bool regular = made->ncomponents == 0;
    const double whole = regular ? made->period : of.repeat;
    const int steps = regular ? 80 : (int)ceil(2.0 * whole / made->dt);
    const double dt = whole / steps, mean = flux_of(s, made),
                 off = wavy ? mean_flux(made, x, steps, dt) : 0.0;
    *n = (int)ceil(s->time.end / dt) + 3;
    double *rows = NEW(double, (size_t)*n * 2);
    for (int k = 0; k < *n; k++) {
        const double t = k * dt, grown = t < T ? 0.5 * (1.0 - cos(M_PI * t / T)) : 1.0;
        rows[2 * k] = t;
        rows[2 * k + 1] = mean;
        if (!wavy)
            continue;
        waves_at(made, t);
        rows[2 * k + 1] += grown * (waves_flux(made, x) - off);
    }
    FREE(made);
    return rows;
}

/* The side becomes an opening of given discharge: what the current and the waves bring through it,
 * as rows over time, into the domain or out of it as the mean goes. */
static void open_side(struct scene *s, double flux, int axis, int upper, double width,
                      struct motion_files *files)
{
    struct scene_wall *w = end_of(s, axis, upper);
    double d[3];
    int n;
    scene_waves_direction(s, d, NULL);
    const double x = (upper ? s->domain.max[axis] : s->domain.min[axis]) * d[axis];
    double *rows = rows_of(s, w->zone == ZONE_WAVE, x, &n);
    const bool in = (flux * d[axis] > 0.0) == !upper;
    const double sign = (in == !upper ? 1.0 : -1.0) * d[axis] * width;
    for (int k = 0; k < n; k++)
        rows[2 * k + 1] *= sign;
    w->kind = in ? WALL_INFLOW : WALL_OUTFLOW;
    w->has_discharge = true;
    snprintf(w->discharge_file, sizeof w->discharge_file, "the waves through %s",
             scene_side_names[2 * axis + upper]);
    motion_files_add(files, w->discharge_file, n, 2, rows);
    w->discharges = motion_files_read(files, w->discharge_file, 2);
}

/* After zones and directions are known, before sides are read by the programs. */
void scene_currents_resolve(struct scene *s, struct motion_files *files)
{
    if (!scene_currents_flow(s))
        return;
    const int axis = axis_of(s), up = scene_still_axis(s);
    const struct wave_spec of = scene_waves_spec(s);
    struct waves *made = waves_create(&of);
    const double flux = flux_of(s, made);
    double width = 1.0;
    FREE(made);
    for (int a = 0; a < s->domain.dim; a++)
        width *= a == axis || a == up ? 1.0 : s->domain.max[a] - s->domain.min[a];
    for (int upper = 0; upper < 2; upper++)
        open_side(s, flux, axis, upper, width, files);
}

void scene_currents_describe(const struct scene *s, const struct waves *made)
{
    const double U = s->waves.current, k = 2.0 * M_PI / made->length,
                 along = waves_group_velocity(k, made->of.g, made->of.depth);
    if (!scene_currents_flow(s))
        return;
    if (U != 0.0)
        log_say("on a current of %g m/s: period %.4g s at rest, %.4g s in the water's frame; their "
                "energy moves at %.3g m/s over the water, %.3g m/s over the ground",
                U, made->period, made->length / (made->celerity - U), along, along + U);
    log_say("mean velocity below the troughs %.4g m/s; %.4g m^2/s go through the ends of the "
            "waves' way",
            U + made->current, flux_of(s, made));
}
