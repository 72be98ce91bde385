/* steady.c - see steady.h. Newton's method for STEADY_MODES + 2 unknowns Y_1 .. Y_N, b, c^2 (N =
 * 128): Bernoulli's equation in N + 1 points of the surface from crest to trough, xi = pi m/N, and
 * the height. The matrix is full, so a step costs some 10^6 operations; one wave needs some tens of
 * steps. Evaluation at a place inverts the map by Newton's method in the complex plane.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "steady.h"

#include <complex.h>
#include <lapacke.h>

#include "../base/base.h"

enum {
    UNKNOWNS = STEADY_MODES + 2,
    LONG = 40
}; /* depths: length that stands for a solitary wave */

/* One row of equation (b - 2y)|z'|^2 - c^2 at xi, and its residual. q: Y_1 .., b, c^2. With x' = 1
 * + sum j coth(j h*) Y_j cos j xi and y' = -sum j Y_j sin j xi on the surface, J = x'^2 + y'^2. r
 * is the row of the Jacobian. */
static double row(const double *q, double strip, double xi, double *r)
{
    const double b = q[STEADY_MODES], c2 = q[STEADY_MODES + 1];
    double y = 0.0, dx = 1.0, dy = 0.0;
    for (int j = 1; j <= STEADY_MODES; j++) {
        y += q[j - 1] * cos(j * xi);
        dx += j / tanh(j * strip) * q[j - 1] * cos(j * xi);
        dy -= j * q[j - 1] * sin(j * xi);
    }
    const double J = dx * dx + dy * dy, s = b - 2.0 * y;
    for (int j = 1; j <= STEADY_MODES; j++)
        r[j - 1] = -2.0 * cos(j * xi) * J +
                   2.0 * s * (dx * j / tanh(j * strip) * cos(j * xi) - dy * j * sin(j * xi));
    r[STEADY_MODES] = J;
    r[STEADY_MODES + 1] = -1.0;
    return s * J - c2;
}

/* The last equation: crest less trough = 2 (Y_1 + Y_3 + ...) = height. A step of more than 10 has
 * left the range of waves. */
static bool newton(double *q, double strip, double height)
{
    double *A = NEW(double, UNKNOWNS *UNKNOWNS), d[UNKNOWNS], most = INFINITY;
    lapack_int pivots[UNKNOWNS];
    for (int it = 0; it < 30 && most > 1e-12; it++) {
        for (int m = 0; m <= STEADY_MODES; m++)
            d[m] = -row(q, strip, M_PI * m / STEADY_MODES, A + (size_t)m * UNKNOWNS);
        double *last = A + (size_t)(UNKNOWNS - 1) * UNKNOWNS, h = 0.0;
        memset(last, 0, UNKNOWNS * sizeof *last);
        for (int j = 1; j <= STEADY_MODES; j += 2) {
            last[j - 1] = 2.0;
            h += 2.0 * q[j - 1];
        }
        d[UNKNOWNS - 1] = height - h;
        most = LAPACKE_dgesv(LAPACK_ROW_MAJOR, UNKNOWNS, 1, A, UNKNOWNS, pivots, d, 1) == 0 ? 0.0
                                                                                            : NAN;
        for (int j = 0; j < UNKNOWNS; j++) {
            most = fabs(d[j]) > most || isnan(d[j]) ? fabs(d[j]) : most;
            q[j] += d[j];
        }
        if (!(most < 10.0))
            break;
    }
    mem_free(A);
    return most < 1e-9;
}

/* Small waves are cosines, long ones solitary: c^2 = strip + height, y = height sech^2. Called with
 * the first of the growing heights, so the wave is small. */
static void first_guess(double *q, double strip, double height, bool is_long)
{
    memset(q, 0, UNKNOWNS * sizeof *q);
    if (!is_long) {
        q[0] = 0.5 * height;
        q[STEADY_MODES] = q[STEADY_MODES + 1] = tanh(strip);
        return;
    }
    double low = 0.0;
    const double K = sqrt(0.75 * height / strip) / strip;
    for (int m = 0; m <= STEADY_MODES; m++) {
        const double xi = M_PI * m / STEADY_MODES, s = 1.0 / cosh(fmin(K * xi, 300.0));
        const double w = m == 0 || m == STEADY_MODES ? 0.5 : 1.0, y = height * s * s;
        for (int j = 1; j <= STEADY_MODES; j++)
            q[j - 1] += 2.0 / STEADY_MODES * w * y * cos(j * xi);
        low += w * y / STEADY_MODES;
    }
    q[STEADY_MODES - 1] *= 0.5;
    q[STEADY_MODES + 1] = strip + height;
    q[STEADY_MODES] = q[STEADY_MODES + 1] - 2.0 * low; /* far away J = 1, y = -low */
}

/* Level of the mean of y over x. */
static double level(const double *q, double strip)
{
    double sum = 0.0;
    for (int j = 1; j <= STEADY_MODES; j++) /* mean of y x' */
        sum += 0.5 * j / tanh(j * strip) * q[j - 1] * q[j - 1];
    return -sum;
}

/* The sum of the modes half a length from the crest, where they alternate. */
static double trough_of(const double *q)
{
    double y = 0.0;
    for (int j = 1; j <= STEADY_MODES; j++)
        y += (j % 2 ? -1.0 : 1.0) * q[j - 1];
    return y;
}

/* In units of 1/k: the strip follows from the depth, which the wave itself changes. First along
 * growing heights with the strip fixed, each start extrapolated from the two before; then the strip
 * is adapted in turn with the wave until both fit. is_long: Ursell's number H L^2/d^3 above 4 pi^2,
 * in these units height > depth^3. */
static bool find(double *q, double *strip, bool solitary, double depth, double height)
{
    const bool is_long = solitary || height > depth * depth * depth;
    const double part = is_long ? 0.08 * depth : 0.2;
    const int steps = (int)ceil(height / part);
    double old[UNKNOWNS], last[UNKNOWNS];
    *strip = depth;
    first_guess(q, depth, height / steps, is_long);
    if (!newton(q, depth, height / steps))
        return false;
    memset(old, 0, sizeof old);
    for (int k = 2; k <= steps; k++) {
        memcpy(last, q, sizeof last);
        for (int j = 0; j < UNKNOWNS && k > 2; j++)
            q[j] = 2.0 * q[j] - old[j];
        memcpy(old, last, sizeof old);
        if (!newton(q, depth, k * height / steps))
            return false;
    }
    for (int round = 0; round < 60; round++) {
        const double before = *strip;
        *strip = solitary ? depth - trough_of(q) : depth + level(q, *strip);
        if (!newton(q, *strip, height))
            return false;
        if (fabs(*strip - before) < 1e-13)
            break;
    }
    return true;
}

/* z and z' at zeta: sums of Y_j/(1 - e^(-2j h*)) (e^(-ij zeta) -+ e^(ij zeta - 2j h*)). */
static double complex place(const struct steady *w, double complex zeta, double complex *slope)
{
    const double complex E = cexp(-I * zeta), G = cexp(I * zeta - 2.0 * w->strip);
    const double Er = creal(E), Ei = cimag(E), Gr = creal(G), Gi = cimag(G);
    double er = 1.0, ei = 0.0, gr = 1.0, gi = 0.0, zr = 0.0, zi = 0.0, sr = 0.0, si = 0.0;
    for (int j = 0; j < w->modes; j++) { /* in reals: complex products look for NaN */
        const double a = er * Er - ei * Ei, b = er * Ei + ei * Er;
        const double c = gr * Gr - gi * Gi, d = gr * Gi + gi * Gr;
        er = a;
        ei = b;
        gr = c;
        gi = d;
        zr += w->A[j] * (a - c);
        zi += w->A[j] * (b - d);
        sr += (j + 1) * w->A[j] * (a + c);
        si += (j + 1) * w->A[j] * (b + d);
    }
    *slope = 1.0 + sr + I * si;
    return zeta + I * w->y0 + I * (zr + I * zi);
}

/* Coefficients of the sums, up to those that are lost in rounding. */
static void set_modes(struct steady *w, const double *Y)
{
    w->modes = STEADY_MODES;
    while (w->modes > 1 && fabs(Y[w->modes - 1]) < 1e-16 * fabs(Y[0]))
        w->modes--;
    for (int j = 0; j < STEADY_MODES; j++)
        w->A[j] = Y[j] / (1.0 - exp(-2.0 * (j + 1) * w->strip));
}

/* In units of 1/k and sqrt(g/k). `back': a wave of 40 depths has a slow current under its trough
 * where the solitary one has still water; it is taken out of all velocities. */
static bool create(struct steady *w, bool solitary, double depth, double length, double height)
{
    const double g = w->g;
    double q[UNKNOWNS];
    double complex slope;
    w->k = 2.0 * M_PI / (solitary ? LONG * depth : length);
    if (!(height > 0.0) || !(depth > 0.0) ||
        !find(q, &w->strip, solitary, w->k * depth, w->k * height))
        return false;
    set_modes(w, q);
    w->b = q[STEADY_MODES];
    w->frame = sqrt(q[STEADY_MODES + 1]);
    w->y0 = solitary ? -trough_of(q) : level(q, w->strip);
    w->tail = fabs(q[STEADY_MODES - 1] / q[0]);
    w->trough = cimag(place(w, M_PI, &slope)) / w->k;
    w->back = solitary ? creal(w->frame * (1.0 - 1.0 / slope)) : 0.0;
    w->crest = w->trough + height;
    w->c = (w->frame - w->back) * sqrt(g / w->k);
    return w->tail < 1e-5;
}

/* Newton's method takes as long as many steps of a flow, and one wave is asked for again and again:
 * the last one is kept. */
bool steady_create(struct steady *w, bool solitary, double depth, double length, double height,
                   double x, double g, double rho)
{
    static struct {
        bool any, solitary, good;
        double of[6];
        struct steady w;
    } last;
    const double of[6] = {depth, solitary ? 0.0 : length, height, x, g, rho};
    if (!last.any || last.solitary != solitary || memcmp(of, last.of, sizeof of) != 0) {
        last.w = (struct steady){.g = g, .rho = rho, .x = x};
        last.good = create(&last.w, solitary, depth, length, height);
        last.any = true;
        last.solitary = solitary;
        memcpy(last.of, of, sizeof of);
    }
    *w = last.w;
    return last.good;
}

/* zeta of the place (x, y) in units of 1/k, |x| <= pi; above the surface of what is below it there.
 * Steps are kept below a fifth of the strip's scale, and zeta within the strip, for the map is
 * one to one only there. */
static double complex invert(const struct steady *w, double x, double y)
{
    const double most = 0.2 * fmin(1.0, w->strip);
    double complex zeta = x + I * fmax(fmin(y, 0.0), -w->strip), slope;
    for (int it = 0; it < 60; it++) {
        double complex d = (x + I * y) - place(w, zeta, &slope), step = d / slope;
        if (cimag(zeta) >= 0.0 && cimag(step) > 0.0) /* held on the surface */
            step = creal(d) / creal(slope);
        const double size = cabs(step);
        step *= size > most ? most / size : 1.0;
        zeta += step;
        zeta = creal(zeta) + I * fmax(fmin(cimag(zeta), 0.0), -w->strip);
        if (size < 1e-13)
            break;
    }
    return zeta;
}

/* k times the distance from the crest, within half a length. */
static double phase(const struct steady *w, double x, double t)
{
    const double a = w->k * (x - w->x - w->c * t);
    return a - 2.0 * M_PI * round(a / (2.0 * M_PI));
}

/* A solitary wave is over half a length away. */
static bool is_far(const struct steady *w, double x, double t)
{
    return w->back != 0.0 && fabs(w->k * (x - w->x - w->c * t)) > M_PI;
}

/* On the surface the inverse of the map is real but for rounding. */
double steady_eta(const struct steady *w, double x, double t)
{
    double complex slope;
    if (is_far(w, x, t))
        return 0.0;
    return cimag(place(w, creal(invert(w, phase(w, x, t), 1e3)), &slope)) / w->k;
}

/* z'' at zeta. */
static double complex bend(const struct steady *w, double complex zeta)
{
    const double complex E = cexp(-I * zeta), G = cexp(I * zeta - 2.0 * w->strip);
    double complex e = 1.0, g = 1.0, sum = 0.0;
    for (int j = 0; j < w->modes; j++) {
        e = CMPLX(creal(e) * creal(E) - cimag(e) * cimag(E),
                  creal(e) * cimag(E) + cimag(e) * creal(E));
        g = CMPLX(creal(g) * creal(G) - cimag(g) * cimag(G),
                  creal(g) * cimag(G) + cimag(g) * creal(G));
        sum += (j + 1) * (j + 1) * w->A[j] * (e - g);
    }
    return -I * sum;
}

/* The velocity in the wave's frame, -c/z', is analytic in z: its derivative there is c z''/z'^3.
 * The gradient of p is Bernoulli's. Above the surface nothing changes upwards. D = du/dx - i dv/dx
 * in the wave's frame, of u - iv = -c/z'. v's derivatives follow from continuity and zero
 * vorticity: u_y = v_x, v_y = -u_x. */
static void add_slopes(const struct steady *w, double complex zeta, double complex slope,
                       bool above, struct steady_slopes *of)
{
    const double complex D = w->frame * bend(w, zeta) / (slope * slope * slope);
    const double uf = -creal(w->frame / slope), vf = cimag(w->frame / slope);
    const double ux = creal(D), vx = -cimag(D), scale = sqrt(w->g * w->k), weight = w->rho * w->g;
    const double tilt = cimag(slope) / creal(slope); /* of the streamline */
    const double up = above ? 0.0 : 1.0, along = above ? tilt : 0.0;
    of->u[0][0] = scale * (ux + along * vx);
    of->u[0][1] = scale * up * vx;
    of->u[1][0] = scale * (vx - along * ux);
    of->u[1][1] = -scale * up * ux;
    of->p[0] = above ? 0.0 : -weight * (uf * ux + vf * vx);
    of->p[1] = above ? 0.0 : -weight * (uf * vx - vf * ux + 1.0);
}

void steady_point(const struct steady *w, double x, double y, double t, double *u, double *p)
{
    steady_point_slopes(w, x, y, t, u, p, NULL);
}

/* Bernoulli's equation gives p. Far from a solitary wave the water is at rest. */
void steady_point_slopes(const struct steady *w, double x, double y, double t, double *u, double *p,
                         struct steady_slopes *of)
{
    double complex slope;
    double v[2] = {0.0, 0.0}, q = -w->rho * w->g * fmin(y, 0.0);
    if (of)
        *of = (struct steady_slopes){.p = {0.0, y < 0.0 ? -w->rho * w->g : 0.0}};
    if (!is_far(w, x, t)) {
        const double complex zeta = invert(w, phase(w, x, t), w->k * y);
        const double up = cimag(place(w, zeta, &slope));
        const double complex flow = w->frame * (1.0 - 1.0 / slope);
        const double speed2 =
            w->frame * w->frame / (creal(slope) * creal(slope) + cimag(slope) * cimag(slope));
        v[0] = (creal(flow) - w->back) * sqrt(w->g / w->k);
        v[1] = -cimag(flow) * sqrt(w->g / w->k);
        q = w->rho * w->g / w->k * (0.5 * w->b + w->y0 - 0.5 * speed2 - up);
        if (of)
            add_slopes(w, zeta, slope, cimag(zeta) >= 0.0 && w->k * y > up, of);
    }
    if (u) {
        u[0] = v[0];
        u[1] = v[1];
    }
    if (p)
        *p = q;
}
