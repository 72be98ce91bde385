/* body_drive.c - prescribed motion: files, harmonic terms, polynomials; they add up. Velocities are
 * the exact derivatives of the places. SPDX-License-Identifier: BSD-3-Clause */
#include "body_drive.h"

#include "../geometry/geometry.h"

static double file_step(const struct body_term *b, int columns);

void body_drive_terms(struct body_drive *v, const struct scene_motions *is, int dim,
                      struct motion_files *files)
{
    *v = (struct body_drive){.dim = dim, .columns = dim == 2 ? 4 : 7};
    for (int k = 0; k < is->n; k++) {
        struct body_term *t = v->term + v->nterms++;
        t->is = is->of + k;
        const struct motion_file *m = t->is->kind == MOTION_FILE && *t->is->file
                                          ? motion_files_read(files, t->is->file, v->columns)
                                          : NULL;
        t->n = m ? m->n : 0;
        t->rows = m ? m->rows : NULL;
        if (t->n > 1)
            t->step = file_step(t, v->columns);
    }
}

/* A constant velocity drives what forces do not move: all degrees of a driven body, the locked ones
 * of a free one. That of a free degree is its start. */
void body_drive_create(struct body_drive *v, const struct scene_body *is, int dim,
                       struct motion_files *files)
{
    const int locked = is->free ? scene_body_locked(is->lock, dim) : (1 << BODY_AXES) - 1;
    body_drive_terms(v, &is->motion, dim, files);
    for (int a = 0; a < BODY_AXES; a++)
        if (locked >> a & 1)
            v->constant[a] = a < 3 ? is->velocity[a] : is->spin[a - 3];
}

/* A polynomial without coefficients moves nothing: most likely a key was forgotten. */
static bool is_zero(const struct param_numbers *c)
{
    bool zero = true;
    for (int k = 0; k < c->n; k++)
        zero = zero && c->v[k] == 0.0;
    return zero;
}

bool body_term_fault(const struct body_drive *v, int term, struct motion_files *files, char *text,
                     size_t size)
{
    static const char *const names[BODY_AXES] = {"x", "y", "z", "rx", "ry", "rz"};
    const struct body_term *t = v->term + term;
    const struct scene_motion *m = t->is;
    *text = '\0';
    if (m->kind == MOTION_FILE && !*m->file)
        snprintf(text, size, "a term of kind file needs the name of the file");
    else if (m->kind == MOTION_FILE && t->n <= 0)
        motion_file_fault(motion_files_read(files, m->file, v->columns),
                          v->dim == 2 ? "t, x, y, angle" : "t, x, y, z, rx, ry, rz", text, size);
    else if (m->kind == MOTION_FILE)
        return false;
    else if (v->dim == 2 && (m->axis == AXIS_Z || m->axis == AXIS_RX || m->axis == AXIS_RY))
        snprintf(text, size, "axis %s in a case of 2 dimensions", names[m->axis]);
    else if (m->kind == MOTION_HARMONIC && (m->period <= 0.0 || m->amplitude == 0.0))
        snprintf(text, size, "a harmonic term needs an amplitude and a period other than 0");
    else if (m->kind == MOTION_POLYNOMIAL && is_zero(&m->coefficients))
        snprintf(text, size, "a polynomial term needs coefficients other than 0");
    else if (m->kind == MOTION_POLYNOMIAL && m->until <= m->from)
        snprintf(text, size, "it ends at %g s (until), before its start at %g s (from)", m->until,
                 m->from);
    return *text != '\0';
}

/* Cubic through the rows with slopes of central differences: value, rate, second rate. */
static void interpolate(const struct body_term *b, int columns, int column, double t, double *v,
                        double *dv, double *ddv)
{
    const double *rows = b->rows;
    const int n = b->n;
    *dv = *ddv = 0.0;
    if (n < 1) {
        *v = 0.0;
        return;
    }
    if (n < 2 || t <= rows[0] || t >= rows[columns * (n - 1)]) {
        *v = rows[columns * (n < 2 || t <= rows[0] ? 0 : n - 1) + column];
        return;
    }
    const int lo = lookup_row(rows, columns, n - 1, t);
    double slope[2];
    for (int e = 0; e < 2; e++) {
        const int before = lo + e > 0 ? lo + e - 1 : 0, after = lo + e < n - 1 ? lo + e + 1 : n - 1;
        slope[e] = (rows[columns * after + column] - rows[columns * before + column]) /
                   (rows[columns * after] - rows[columns * before]);
    }
    const double *p = rows + columns * lo, *q = p + columns;
    const double h = q[0] - p[0], z = (t - p[0]) / h;
    const double c2 = 3.0 * (q[column] - p[column]) - h * (2.0 * slope[0] + slope[1]);
    const double c3 = 2.0 * (p[column] - q[column]) + h * (slope[0] + slope[1]);
    *v = p[column] + z * (h * slope[0] + z * (c2 + z * c3));
    *dv = slope[0] + z * (2.0 * c2 + 3.0 * z * c3) / h;
    *ddv = (2.0 * c2 + 6.0 * z * c3) / (h * h);
}

/* s^3 (10 - 15 s + 6 s^2) with s = t / T, within 0 and 1, and its derivatives. */
static void ramp(double T, double t, double w[3])
{
    const double s = T > 0.0 ? t / T : 1.0;
    const bool over = s >= 1.0, within = !over && s > 0.0;
    w[0] = over ? 1.0 : within ? s * s * s * (10.0 + s * (6.0 * s - 15.0)) : 0.0;
    w[1] = within ? 30.0 * s * s * (1.0 - s) * (1.0 - s) / T : 0.0;
    w[2] = within ? 60.0 * s * (1.0 - s) * (1.0 - 2.0 * s) / (T * T) : 0.0;
}

/* c_0 + c_1 t + ... with two derivatives. */
static void polynomial(const struct param_numbers *c, double t, double v[3])
{
    v[0] = v[1] = v[2] = 0.0;
    for (int k = c->n - 1; k >= 0; k--) { /* Horner */
        v[2] = v[2] * t + 2.0 * v[1];
        v[1] = v[1] * t + v[0];
        v[0] = v[0] * t + c->v[k];
    }
}

/* What a ramp that multiplies the rate of a polynomial takes from its displacement by time t: c_0
 * comes as w, c_k t^k as the integral of w k c_k t^(k-1). */
static double lag(const struct param_numbers *c, double T, double t)
{
    const double within = t < T ? t : T, s = T > 0.0 ? within / T : 0.0;
    double behind = 0.0, power = 1.0;
    for (int k = 1; k < c->n; k++) {
        power *= within;
        behind +=
            c->v[k] * power *
            (1.0 - k * s * s * s * (10.0 / (k + 3) + s * (6.0 * s / (k + 5) - 15.0 / (k + 4))));
    }
    return behind;
}

/* Value and two derivatives of a polynomial term. Its ramp multiplies the rate, so that what is
 * towed at c_1 comes to that speed without passing it (by 1.7 times where it multiplied the
 * displacement). */
static void polynomial_term(const struct scene_motion *m, double t, double v[3])
{
    const double since = t - m->from, last = fmin(t, m->until) - m->from;
    const struct param_numbers *c = &m->coefficients;
    double w[3], p[3];
    ramp(m->ramp, since, w);
    polynomial(c, last > 0.0 ? last : 0.0, p);
    v[0] = p[0] - c->v[0] * (1.0 - w[0]) - lag(c, m->ramp, last > 0.0 ? last : 0.0);
    v[1] = c->v[0] * w[1];
    v[2] = c->v[0] * w[2];
    if (since >= 0.0 && t < m->until) {
        v[1] += w[0] * p[1];
        v[2] += w[0] * p[2] + w[1] * p[1];
    }
}

/* The same of a harmonic term, whose displacement the ramp multiplies. */
static void harmonic_term(const struct scene_motion *m, double t, double v[3])
{
    const double w = 2.0 * M_PI / m->period, z = w * t + m->phase;
    v[0] = m->amplitude * sin(z);
    v[1] = m->amplitude * w * cos(z);
    v[2] = -m->amplitude * w * w * sin(z);
}

/* Column 0 is the time. */
static int axis_of_column(int columns, int column)
{
    return columns == 4 ? (column == 3 ? AXIS_RZ : column - 1) : column - 1;
}

/* What a ramp that multiplies the displacement makes of it, by the product rule. */
static void ramped(double T, double t, double f[3])
{
    double w[3];
    ramp(T, t, w);
    f[2] = w[0] * f[2] + 2.0 * w[1] * f[1] + w[2] * f[0];
    f[1] = w[0] * f[1] + w[1] * f[0];
    f[0] = w[0] * f[0];
}

/* A file has all columns at once, other terms one axis. */
static void add_term(const struct body_drive *v, const struct body_term *term, double t, double *d,
                     double *dd, double *ddd)
{
    const struct scene_motion *m = term->is;
    const bool file = m->kind == MOTION_FILE;
    if (m->kind >= MOTION_PARTNER) /* says it by the course */
        return;
    for (int c = 1; c < (file ? v->columns : 2); c++) {
        const int a = file ? axis_of_column(v->columns, c) : m->axis;
        double f[3];
        if (m->kind == MOTION_POLYNOMIAL) {
            polynomial_term(m, t, f);
        } else {
            if (file)
                interpolate(term, v->columns, c, t, f, f + 1, f + 2);
            else
                harmonic_term(m, t, f);
            ramped(m->ramp, t, f);
        }
        d[a] += f[0];
        dd[a] += f[1];
        ddd[a] += f[2];
    }
}

/* Displacement from the start, its rate and second rate along each axis: constant velocity, terms,
 * what an absorbing paddle adds (steer), what a partner says (course). */
void body_drive_at(const struct body_drive *v, double t, double d[BODY_AXES], double dd[BODY_AXES],
                   double ddd[BODY_AXES])
{
    for (int a = 0; a < BODY_AXES; a++) {
        d[a] = v->constant[a] * t;
        dd[a] = v->constant[a];
        ddd[a] = 0.0;
    }
    for (int k = 0; k < v->nterms; k++)
        add_term(v, v->term + k, t, d, dd, ddd);
    if (v->steer) {
        const struct body_steer *s = v->steer;
        const double later = t - s->at;
        d[s->axis] += s->d + later * (s->v + 0.5 * later * s->a);
        dd[s->axis] += s->v + later * s->a;
        ddd[s->axis] += s->a;
    }
    for (int a = 0; a < BODY_AXES && v->course; a++)
        body_course_add(v->course, a, t, d + a, dd + a, ddd + a);
}

void body_drive_motion(const struct body_drive *v, double t, struct body_motion *m)
{
    double d[BODY_AXES], dd[BODY_AXES], ddd[BODY_AXES];
    body_drive_at(v, t, d, dd, ddd);
    for (int a = 0; a < 3; a++) {
        m->x[a] = d[a];
        m->u[a] = dd[a];
        m->du[a] = ddd[a];
        m->r[a] = d[3 + a];
    }
    rotation_of_vector(m->r, m->Q);
    spin_of_vector(m->r, dd + 3, m->omega);
    if (v->dim == 2) {
        memcpy(m->domega, ddd + 3, sizeof m->domega);
    } else { /* by central differences: only averaged forces ask for it */
        const double h = 1e-4 * (1.0 + vec3_length(m->r)) / (1.0 + vec3_length(dd + 3));
        double a[3], b[3], low[3], high[3];
        for (int k = 0; k < 3; k++) {
            low[k] = m->r[k] - h * dd[3 + k];
            high[k] = m->r[k] + h * dd[3 + k];
        }
        spin_of_vector(low, dd + 3, a);
        spin_of_vector(high, dd + 3, b);
        spin_of_vector(m->r, ddd + 3, m->domega);
        for (int k = 0; k < 3; k++)
            m->domega[k] += 0.5 * (b[k] - a[k]) / h;
    }
    m->angle = m->r[2];
    m->spin = m->omega[2];
    m->dspin = m->domega[2];
}

/* Somewhere in its own n-th part of the time, by parts of the golden section, which fill it. */
double body_drive_instant(int i, int n, double end)
{
    const double part = 0.6180339887498949 * i, at = i + (part - floor(part)) - 0.5;
    return i <= 0 ? 0.0 : i >= n ? end : end * lesser(at / n, 1.0);
}

/* At times all over the run, and between the rows of files. */
static void take_speed(const struct body_drive *v, double reach, double t, struct body_speeds *most)
{
    struct body_motion m;
    body_drive_motion(v, t, &m);
    most->any = fmax(most->any, vec3_length(m.u) + reach * vec3_length(m.omega));
    for (int a = 0; a < 3; a++)
        most->along[a] = fmax(most->along[a], fabs(m.u[a]));
}

struct body_speeds body_drive_speeds(const struct body_drive *v, double reach, double end)
{
    enum { TIMES = 2000 };
    struct body_speeds most = {0.0, {0.0}};
    for (int i = 0; i <= TIMES; i++)
        take_speed(v, reach, body_drive_instant(i, TIMES, end), &most);
    for (int k = 0; k < v->nterms; k++)
        for (int i = 1; i < v->term[k].n; i++) {
            const double *p = v->term[k].rows + (ptrdiff_t)v->columns * (i - 1);
            const double t = 0.5 * (p[0] + p[v->columns]);
            if (p[0] >= end)
                break;
            take_speed(v, reach, fmin(t, end), &most);
        }
    return most;
}

double body_drive_speed(const struct body_drive *v, double reach, double end)
{
    return body_drive_speeds(v, reach, end).any;
}

/* A column of a file: half of its range, and how often a second it falls from the upper quarter of
 * that into the lower one, from the first time to the last: the frequency of an oscillation, 0 of a
 * motion that ends. */
static void find_swing(const struct body_term *b, int columns, int c, double *half, double *rate)
{
    const double *first = b->rows, *last = first + (ptrdiff_t)columns * (b->n - 1);
    double lo = INFINITY, hi = -INFINITY, begin = 0.0, end = 0.0;
    int falls = 0, side = 0;
    for (const double *p = first; p <= last; p += columns) {
        lo = fmin(lo, p[c]);
        hi = fmax(hi, p[c]);
    }
    for (const double *p = first; p <= last; p += columns) {
        const double x = p[c] - 0.5 * (lo + hi);
        const int now = x > 0.25 * (hi - lo) ? 1 : x < -0.25 * (hi - lo) ? -1 : side;
        if (now < 0 && side > 0) {
            begin = falls > 0 ? begin : p[0];
            end = p[0];
            falls++;
        }
        side = now;
    }
    *half = 0.5 * (hi - lo);
    *rate = falls > 1 && hi > lo ? (falls - 1) / (end - begin) : 0.0;
}

/* Acceleration of a point at `reach' and frequency of a term that oscillates. */
static void term_swing(const struct body_drive *v, int k, double reach, double *acceleration,
                       double *rate)
{
    const struct body_term *b = v->term + k;
    const struct scene_motion *m = b->is;
    *acceleration = *rate = 0.0;
    if (m->kind == MOTION_HARMONIC && m->period > 0.0 && m->amplitude != 0.0) {
        *rate = 1.0 / m->period;
        *acceleration =
            fabs(m->amplitude) * pow(2.0 * M_PI * *rate, 2.0) * (m->axis >= AXIS_RX ? reach : 1.0);
    }
    for (int c = 1; m->kind == MOTION_FILE && b->n > 1 && c < v->columns; c++) {
        double half, f;
        find_swing(b, v->columns, c, &half, &f);
        *rate = fmax(*rate, f);
        *acceleration += half * pow(2.0 * M_PI * f, 2.0) * (c > v->dim ? reach : 1.0);
    }
}

/* A bound: amplitudes of terms that swing add as if in phase. */
double body_drive_acceleration(const struct body_drive *v, double reach)
{
    double sum = 0.0, a, rate;
    for (int k = 0; k < v->nterms; k++) {
        term_swing(v, k, reach, &a, &rate);
        sum += a;
    }
    return sum;
}

double body_drive_rate(const struct body_drive *v)
{
    double most = 0.0, a, rate;
    for (int k = 0; k < v->nterms; k++) {
        term_swing(v, k, 0.0, &a, &rate);
        most = fmax(most, rate);
    }
    return most;
}

/* --- steps --- */

#define PERIOD_STEPS 40.0 /* the phase of a step is 9 degrees */
#define COURSE_STEPS 20.0 /* of a polynomial that ends, of a ramp */
#define LARGEST_TURN 0.1  /* rad a step */

/* Files tell no period: 1/omega is taken as the largest rate over the largest second rate of a
 * column, but no step is shorter than their rows are apart. */
static double file_step(const struct body_term *b, int columns)
{
    double time = INFINITY;
    const double first = b->rows[0], span = b->rows[columns * (b->n - 1)] - first;
    for (int c = 1; c < columns; c++) {
        double v, dv, ddv, rate = 0.0, change = 0.0;
        for (int i = 0; i + 1 < b->n; i++) {
            const double t = 0.5 * (b->rows[columns * i] + b->rows[columns * (i + 1)]);
            interpolate(b, columns, c, t, &v, &dv, &ddv);
            rate = fmax(rate, fabs(dv));
            interpolate(b, columns, c, b->rows[columns * i], &v, &dv, &ddv);
            change = fmax(change, fabs(ddv));
        }
        if (change > 0.0 && rate > 0.0)
            time = lesser(time, rate / change);
    }
    return fmax(2.0 * M_PI / PERIOD_STEPS * time, span / (b->n - 1));
}

/* A polynomial's begins where it does. */
static double ramp_end(const struct scene_motion *m)
{
    return m->kind == MOTION_POLYNOMIAL && m->ramp > 0.0 ? m->from + m->ramp : m->ramp;
}

/* INFINITY: the term asks for no step of its own at t. */
static double term_step(const struct body_term *b, int columns, double t)
{
    const struct scene_motion *m = b->is;
    double dt = t < ramp_end(m) ? m->ramp / COURSE_STEPS : INFINITY;
    if (m->kind == MOTION_HARMONIC)
        dt = lesser(dt, m->period / PERIOD_STEPS);
    else if (m->kind == MOTION_POLYNOMIAL && t >= m->from && t < m->until)
        dt = lesser(dt, (m->until - m->from) / COURSE_STEPS);
    else if (m->kind == MOTION_FILE && b->n > 1 && t < b->rows[columns * (b->n - 1)])
        dt = lesser(dt, b->step);
    return dt;
}

double body_drive_step(const struct body_drive *v, double t)
{
    double dt = INFINITY;
    struct body_motion now;
    for (int k = 0; k < v->nterms; k++)
        dt = lesser(dt, term_step(v->term + k, v->columns, t));
    for (int e = 0; e < 3; e++) { /* what turns now, and what will within the step */
        body_drive_motion(v, t + (dt < INFINITY ? 0.5 * e * dt : 0.0), &now);
        const double spin = vec3_length(now.omega);
        dt = spin > 0.0 ? lesser(dt, LARGEST_TURN / spin) : dt;
    }
    return dt;
}

/* The next time after t at which a term begins, ends or jumps in a derivative: steps should end
 * there. 1e-9: an event that was just reached is past. */
double body_drive_event(const struct body_drive *v, double t)
{
    double next = INFINITY;
    for (int k = 0; k < v->nterms; k++) {
        const struct body_term *b = v->term + k;
        const bool polynomial = b->is->kind == MOTION_POLYNOMIAL,
                   file = b->is->kind == MOTION_FILE && b->n > 1;
        const double last = file ? b->rows[(ptrdiff_t)v->columns * (b->n - 1)] : 0.0;
        const double at[] = {ramp_end(b->is),
                             polynomial ? b->is->from
                             : file     ? b->rows[0]
                                        : 0.0,
                             polynomial ? b->is->until : last};
        for (int e = 0; e < 3; e++)
            if (at[e] > t + 1e-9 * fmax(1.0, fabs(t)))
                next = lesser(next, at[e]);
    }
    return next;
}
