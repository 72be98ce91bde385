/* exact.c - plane waves with one decay rate; averages by products of sinc. See exact.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "exact.h"

#include <complex.h>

static void set_mode(struct exact *e, int m, double kx, double ky, double A, double s)
{
    e->k[m][0] = kx;
    e->k[m][1] = ky;
    e->A[m] = A;
    e->s[m] = s;
    e->K2 = kx * kx + ky * ky;
}

bool exact_at_all_times(const struct scene *s)
{
    const int f = s->initial.field;
    const double *g = s->fluid.gravity;
    const bool driven = g[0] != 0.0 || g[1] != 0.0 || g[2] != 0.0;
    const bool bounded = s->nbodies > 0 || s->nshapes > 0 || s->nwalls > 0;
    if (f == FIELD_POISEUILLE || f == FIELD_COUETTE || f == FIELD_STANDING_WAVE ||
        scene_has_steady_wave(s))
        return true;
    return !driven && !bounded &&
           (f == FIELD_UNIFORM || f == FIELD_TAYLOR_GREEN || f == FIELD_TWO_MODES ||
            f == FIELD_BELTRAMI);
}

static void set_layer(struct exact *e, const struct scene *s)
{
    const struct scene_domain *d = &s->domain;
    const double level = s->initial.level < LEVEL_TOP ? s->initial.level : d->max[1];
    e->bottom = d->min[1];
    e->height = (scene_has_wave(s) ? level : d->max[1]) - d->min[1];
    if (e->field == FIELD_STOKES)
        e->stokes = stokes_create(s->initial.L, -s->fluid.gravity[1], e->rho, s->initial.amplitude);
    if (scene_has_steady_wave(s)) {
        const bool alone = e->field == FIELD_SOLITARY;
        if (!steady_create(&e->steady, alone, e->height, s->initial.L,
                           (alone ? 1.0 : 2.0) * s->initial.amplitude, s->initial.crest,
                           -s->fluid.gravity[1], e->rho))
            e->steady = (struct steady){.c = 0.0}; /* scene_check says so */
    }
    if (e->field != FIELD_STANDING_WAVE)
        return;
    const double L = s->initial.L, L_z = s->initial.L_z;
    e->crossed = L_z > 0.0;
    e->along[0] = e->crossed ? L_z / hypot(L, L_z) : 1.0;
    e->along[1] = e->crossed ? L / hypot(L, L_z) : 0.0;
    e->wave = wave_create(e->height, e->along[0] * L, -s->fluid.gravity[1], e->nu, e->rho,
                          s->initial.amplitude);
}

struct exact exact_create(const struct scene *s)
{
    struct exact e = {.dim = s->domain.dim,
                      .nu = s->fluid.nu,
                      .rho = s->fluid.rho,
                      .U = s->initial.U,
                      .field = s->initial.field,
                      .L = s->initial.L,
                      .W = s->fluid.central,
                      .force = s->fluid.gravity[0]};
    if (e.field == FIELD_BELTRAMI) {
        for (int a = 0; a < 3; a++)
            e.V[a] = s->initial.velocity[a];
        return e;
    }
    if (e.field >= FIELD_POISEUILLE) {
        set_layer(&e, s);
        return e;
    }
    const double k = 2.0 * M_PI / s->initial.L, U = s->initial.U;
    for (int a = 0; a < 3; a++)
        e.V[a] = s->initial.field == FIELD_REST ? 0.0 : s->initial.velocity[a];
    if (s->initial.field == FIELD_TAYLOR_GREEN) { /* psi = U/k sin kx sin ky */
        e.n = 2;
        set_mode(&e, 0, k, -k, 0.5 * U / k, 0.0);
        set_mode(&e, 1, k, k, -0.5 * U / k, 0.0);
    } else if (s->initial.field == FIELD_TWO_MODES) { /* largest speed of the modes about U */
        e.n = 2;
        set_mode(&e, 0, k, 2.0 * k, 0.45 * U * s->initial.L / (3.0 * M_PI), 0.0);
        set_mode(&e, 1, -2.0 * k, k, 0.55 * U * s->initial.L / (3.0 * M_PI), 0.0);
    }
    return e;
}

/* Average of cos(k.x) over a box is cos(k.xc) times this, for each side. */
static double sinc(double a) { return fabs(a) < 1e-4 ? 1.0 - a * a / 6.0 : sin(a) / a; }

/* Cell averages of plane waves are exact by these factors, so that errors of fv are measured
 * against averages, not points. */
static double filter(double kx, double ky, const double *h)
{
    return sinc(0.5 * kx * h[0]) * sinc(0.5 * ky * h[1]);
}

/* p/rho = -1/4 sum_mn A_m A_n [(k_m.k_n + K^2) cos(a-b) + (K^2 - k_m.k_n) cos(a+b)] less m = n of
 * the first term, which is the mean; a, b the phases of m, n. */
static double pressure(const struct exact *e, const double *c, const double *h)
{
    double p = 0.0;
    for (int m = 0; m < e->n; m++)
        for (int n = 0; n < e->n; n++) {
            const double *km = e->k[m], *kn = e->k[n];
            const double kk = km[0] * kn[0] + km[1] * kn[1], AA = e->A[m] * e->A[n];
            if (m != n)
                p -= 0.25 * AA * (kk + e->K2) * cos(c[m] - c[n]) *
                     filter(km[0] - kn[0], km[1] - kn[1], h);
            p -= 0.25 * AA * (e->K2 - kk) * cos(c[m] + c[n]) *
                 filter(km[0] + kn[0], km[1] + kn[1], h);
        }
    return e->rho * p;
}

/* Channel flow from rest under a body force (Poiseuille), or with the upper wall at U (Couette):
 * the steady profile and its decaying Fourier series, which at t = 0 is a jump at the wall that
 * moves: any finite part of it would leave the first layers a share of that wall's velocity. */
static void channel(const struct exact *e, double y, double t, double *u, double *w)
{
    const double H = e->height, z = (y - e->bottom) / H, rate = e->nu * M_PI * M_PI / (H * H);
    const bool forced = e->field == FIELD_POISEUILLE;
    const double scale = forced ? e->force * H * H / (2.0 * e->nu) : e->U;
    double v = forced ? z * (1.0 - z) : z, dv = forced ? 1.0 - 2.0 * z : 1.0;
    *u = *w = 0.0;
    if (t <= 0.0)
        return;
    for (int n = 1; n < 4000 && rate * n * n * t < 40.0; n += forced ? 2 : 1) {
        const double k = M_PI * n, decay = exp(-rate * n * n * t);
        const double a = forced ? -8.0 / (k * k * k) : 2.0 * (n % 2 ? -1.0 : 1.0) / k;
        v += a * decay * sin(k * z);
        dv += a * k * decay * cos(k * z);
    }
    *u = scale * v;
    *w = -scale * dv / H;
}

/* Pressure of the square patch at t = 0: the Fourier series of Laplace p = 2 rho w^2, 0 on its
 * sides. */
static double patch_pressure(const struct exact *e, const double *x)
{
    const double spin = e->U / e->L, X = x[0] / e->L + 0.5, Y = x[1] / e->L + 0.5;
    double p = 0.0;
    for (int m = 1; m < 60; m += 2)
        for (int n = 1; n < 60; n += 2)
            p -= 32.0 / (M_PI * M_PI * M_PI * M_PI * m * n * (m * m + n * n)) * sin(m * M_PI * X) *
                 sin(n * M_PI * Y);
    return e->rho * spin * spin * e->L * e->L * p;
}

/* cos ax cos bz is the mean of cos(ax + bz) and cos(ax - bz): two waves that cross. */
static void wave_at(const struct exact *e, const double *x, double t, double *u, double *p,
                    double *w)
{
    const double *d = e->along, y = x[1] - e->bottom - e->height;
    if (!e->crossed) {
        wave_point(&e->wave, x[0], y, t, u, p, w);
        return;
    }
    for (int sign = -1; sign <= 1; sign += 2) {
        double v[2], q, r;
        wave_point(&e->wave, d[0] * x[0] + sign * d[1] * x[2], y, t, v, &q, &r);
        u[0] += 0.5 * d[0] * v[0];
        u[1] += 0.5 * v[1];
        u[2] += 0.5 * sign * d[1] * v[0];
        *p += 0.5 * q;
        *w += 0.5 * d[0] * r;
    }
}

static void other_point(const struct exact *e, const double *x, double t, double *u, double *p,
                        double *w)
{
    const double rate = e->U / e->L;
    u[0] = u[1] = u[2] = *p = *w = 0.0;
    if (e->field == FIELD_STANDING_WAVE) {
        wave_at(e, x, t, u, p, w);
    } else if (e->field == FIELD_STOKES) {
        stokes_point(&e->stokes, x[0], x[1] - e->bottom - e->height, u, p);
    } else if (e->steady.c > 0.0) {
        steady_point(&e->steady, x[0], x[1] - e->bottom - e->height, t, u, p);
    } else if (e->field == FIELD_PATCH) { /* clockwise */
        u[0] = rate * x[1];
        u[1] = -rate * x[0];
        *w = -2.0 * rate;
        *p = patch_pressure(e, x);
    } else if (e->field == FIELD_DROP) {
        u[0] = rate * x[0];
        u[1] = -rate * x[1];
        *p = 0.5 * e->rho * (rate * rate + e->W * e->W) * (e->L * e->L - x[0] * x[0] - x[1] * x[1]);
    } else {
        channel(e, x[1], t, u, w);
    }
}

/* Time in which the drop is round again, twice: its ellipse obeys
 * dA/dt = (A^2 + W^2)(b^2 - a^2)/(a^2 + b^2), da/dt = A a, a b = const (RK4). */
static double drop_period(const struct exact *e)
{
    const double W = e->W, dt = 1e-4 / W;
    double t = 0.0, y[2] = {e->U / e->L, 1.0}; /* A, a/R */
    do {
        double k[2] = {0.0, 0.0}, sum[2] = {0.0, 0.0};
        for (int stage = 0; stage < 4; stage++) {
            const double h = stage == 0 ? 0.0 : stage == 3 ? dt : 0.5 * dt;
            const double A = y[0] + h * k[0], a = y[1] + h * k[1], a2 = a * a, b2 = 1.0 / a2;
            k[0] = (A * A + W * W) * (b2 - a2) / (a2 + b2);
            k[1] = A * a;
            for (int c = 0; c < 2; c++)
                sum[c] += (stage == 1 || stage == 2 ? 2.0 : 1.0) * k[c];
        }
        const double before = y[1];
        for (int c = 0; c < 2; c++)
            y[c] += dt / 6.0 * sum[c];
        if (y[1] <= 1.0)
            return 2.0 * (t + dt * (before - 1.0) / (before - y[1]));
        t += dt;
    } while (t * W < 1e3);
    return NAN;
}

/* What oscillates with one period, s, and decays, 1/s; false: nothing that is known. */
bool exact_oscillation(const struct exact *e, double *period, double *rate)
{
    if (e->field == FIELD_STANDING_WAVE) {
        *period = 2.0 * M_PI / cimag(e->wave.s);
        *rate = creal(e->wave.s);
        return true;
    }
    if (e->field == FIELD_DROP && e->W > 0.0) {
        *period = drop_period(e);
        *rate = 0.0;
        return true;
    }
    return false;
}

/* Where no damping is expected its error is what is lost in a period. */
void exact_summarise_oscillation(const struct fit *samples, double period, double rate,
                                 struct summary *to)
{
    const double T = fit_period(samples), r = fit_rate(samples);
    if (isfinite(T)) {
        summary_real(to, "period", T);
        summary_real(to, "error.period", fabs(T / period - 1.0));
    }
    if (isfinite(r)) {
        summary_real(to, "damping", r);
        summary_real(to, "error.damping", rate != 0.0 ? fabs(r / rate - 1.0) : fabs(r) * period);
    }
}

bool exact_until_end(const struct scene *s)
{
    bool exact = exact_at_all_times(s) && s->nbodies == 0;
    if (!exact || !scene_has_steady_wave(s))
        return exact;
    const struct exact e = exact_create(s);
    const bool solitary = s->initial.field == FIELD_SOLITARY;
    const double crest = e.steady.x + e.steady.c * s->time.end;
    if (solitary && s->domain.periodic[0] && crest > s->domain.max[0])
        return false; /* it comes in again at the other end */
    for (int k = 0; k < s->nwalls; k++) {
        const struct scene_wall *w = s->walls + k;
        const bool end = (w->side == SIDE_X_MIN && !solitary) || w->side == SIDE_X_MAX;
        const bool closed = end && w->kind < WALL_INFLOW && w->zone == ZONE_NONE;
        const bool met = !solitary || crest > s->domain.max[0];
        exact = exact && w->side != SIDE_NONE && !(closed && met);
    }
    return exact;
}

bool exact_has_past(const struct exact *e)
{
    return e->field != FIELD_POISEUILLE && e->field != FIELD_COUETTE;
}

double exact_surface(const struct exact *e, double x) { return exact_surface_at(e, x, 0.0); }

double exact_surface_at(const struct exact *e, double x, double t)
{
    const double eta = e->field == FIELD_STOKES ? stokes_eta(&e->stokes, x)
                       : e->steady.c > 0.0      ? steady_eta(&e->steady, x, t)
                                                : 0.0;
    return e->bottom + e->height + eta;
}

double exact_enstrophy(const struct exact *e, const double *lo, const double *hi, double t)
{
    double area = 1.0;
    for (int a = 0; a < e->dim; a++)
        area *= a == 1 ? 1.0 : hi[a] - lo[a];
    return (e->crossed ? 0.5 : 1.0) * area * wave_enstrophy(&e->wave, t);
}

/* What is summed over the fluid to find the amplitude: of a standing wave the projection of u on
 * the wave's own velocity, of the drop x^2 - y^2. */
double exact_signal(const struct exact *e, const double *x, const double *u)
{
    const double k = e->wave.k, z = k * (x[1] - e->bottom), *d = e->along;
    if (e->field == FIELD_DROP)
        return x[0] * x[0] - x[1] * x[1];
    if (e->field != FIELD_STANDING_WAVE)
        return 0.0;
    const double a = k * d[0] * x[0], b = e->crossed ? k * d[1] * x[2] : 0.0;
    const double across = e->crossed ? d[1] * u[2] * cos(a) * sin(b) : 0.0;
    return u[1] * sinh(z) * cos(a) * cos(b) - cosh(z) * (d[0] * u[0] * sin(a) * cos(b) + across);
}

/* By Gauss's rule of three points along x and y, and along z where that matters. */
static void other_average(const struct exact *e, const double *x, const double *h, double t,
                          double *u, double *p, double *w)
{
    static const double at[3] = {-0.3872983346207417, 0.0, 0.3872983346207417};
    static const double weight[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    const int n[3] = {h[0] > 0.0 ? 3 : 1, h[1] > 0.0 ? 3 : 1, e->crossed && h[2] > 0.0 ? 3 : 1};
    double sum[5] = {0.0};
    for (int i = 0; i < n[0] * n[1] * n[2]; i++) {
        const int m[3] = {i % n[0], i / n[0] % n[1], i / (n[0] * n[1])};
        double y[3] = {x[0], x[1], x[2]}, f = 1.0, v[5];
        for (int a = 0; a < 3; a++) {
            y[a] += n[a] == 3 ? at[m[a]] * h[a] : 0.0;
            f *= n[a] == 3 ? weight[m[a]] : 1.0;
        }
        other_point(e, y, t, v, v + 3, v + 4);
        for (int k = 0; k < 5; k++)
            sum[k] += f * v[k];
    }
    for (int a = 0; u && a < 3; a++)
        u[a] = sum[a];
    if (p)
        *p = sum[3];
    if (w)
        *w = sum[4];
}

/* u_a = U (sin k x_a-1 + cos k x_a+1), indices modulo 3: curl u = k u, so that convection is a
 * gradient, p/rho = -|u|^2/2 less its mean. */
static void beltrami(const struct exact *e, const double *x, const double *h, double t, double *u,
                     double *p, double *w)
{
    const double k = 2.0 * M_PI / e->L, d = exp(-e->nu * k * k * t);
    double s[3], c[3], sum = 0.0;
    for (int a = 0; a < 3; a++) {
        const double f = sinc(0.5 * k * h[a]), phase = k * (x[a] - e->V[a] * t);
        s[a] = f * sin(phase);
        c[a] = f * cos(phase);
    }
    for (int a = 0; a < 3; a++) {
        const int up = (a + 1) % 3, down = (a + 2) % 3;
        if (u)
            u[a] = e->V[a] + d * e->U * (s[down] + c[up]);
        sum += s[down] * c[up];
    }
    if (p)
        *p = -e->rho * d * d * e->U * e->U * sum;
    if (w)
        *w = k * d * e->U * (s[1] + c[0]);
}

void exact_average(const struct exact *e, const double *x, const double *h, double t, double *u,
                   double *p, double *w)
{
    if (e->field == FIELD_BELTRAMI) {
        beltrami(e, x, h, t, u, p, w);
        return;
    }
    if (e->field >= FIELD_POISEUILLE) {
        other_average(e, x, h, t, u, p, w);
        return;
    }
    const double d = exp(-e->nu * e->K2 * t);
    double c[2], v[3] = {e->V[0], e->V[1], e->V[2]}, vort = 0.0;
    for (int m = 0; m < e->n; m++) {
        const double *k = e->k[m];
        c[m] = k[0] * (x[0] - e->V[0] * t) + k[1] * (x[1] - e->V[1] * t) + e->s[m];
        const double A = e->A[m] * d * filter(k[0], k[1], h), s = sin(c[m]);
        v[0] -= A * k[1] * s;
        v[1] += A * k[0] * s;
        vort += A * e->K2 * cos(c[m]);
    }
    for (int a = 0; u && a < 3; a++)
        u[a] = v[a];
    if (p)
        *p = d * d * pressure(e, c, h);
    if (w)
        *w = vort;
}

void exact_point(const struct exact *e, const double *x, double t, double *u, double *p, double *w)
{
    const double h[3] = {0.0, 0.0, 0.0};
    exact_average(e, x, h, t, u, p, w);
}

/* Average over the face of the box across axis a: no width along that. */
void exact_face(const struct exact *e, const double *x, const double *h, int a, double t, double *u)
{
    double side[3] = {h[0], h[1], h[2]};
    side[a] = 0.0;
    exact_average(e, x, side, t, u, NULL, NULL);
}

void exact_gradient(const struct exact *e, const double *x, double t, double g[3][3])
{
    const double d = exp(-e->nu * e->K2 * t);
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            g[a][b] = 0.0;
    if (e->field >= FIELD_POISEUILLE) { /* by differences of fourth order */
        const double h = 1e-3 * (e->height > 0.0 ? e->height : e->L);
        for (int b = 0; b < e->dim; b++)
            for (int k = -2; k <= 2; k++) {
                static const double weight[5] = {1.0, -8.0, 0.0, 8.0, -1.0};
                double y[3] = {x[0], x[1], x[2]}, u[3];
                y[b] += k * h;
                exact_point(e, y, t, u, NULL, NULL);
                for (int a = 0; a < e->dim; a++)
                    g[a][b] += weight[k + 2] * u[a] / (12.0 * h);
            }
        return;
    }
    for (int m = 0; m < e->n; m++) {
        const double *k = e->k[m];
        const double C =
            e->A[m] * d * cos(k[0] * (x[0] - e->V[0] * t) + k[1] * (x[1] - e->V[1] * t) + e->s[m]);
        for (int b = 0; b < 2; b++) {
            g[0][b] -= C * k[1] * k[b];
            g[1][b] += C * k[0] * k[b];
        }
    }
}

void norm_add(struct norm *n, double w, double e, double ref)
{
    n->vol += w;
    n->e1 += w * e;
    n->e2 += w * e * e;
    n->r2 += w * ref * ref;
    if (fabs(e) > n->emax)
        n->emax = fabs(e);
}

/* vol, e1, e2 and r2 stand together in the struct and are summed as one; the largest is a maximum.
 */
void norm_reduce(struct norm *n, int count, MPI_Comm comm)
{
    for (int i = 0; i < count; i++) {
        MPI_Allreduce(MPI_IN_PLACE, &n[i].vol, 4, MPI_DOUBLE, MPI_SUM, comm);
        MPI_Allreduce(MPI_IN_PLACE, &n[i].emax, 1, MPI_DOUBLE, MPI_MAX, comm);
    }
}

double norm_relative_l2(const struct norm *n) { return n->r2 > 0.0 ? sqrt(n->e2 / n->r2) : 0.0; }
double norm_rms(const struct norm *n) { return n->vol > 0.0 ? sqrt(n->e2 / n->vol) : 0.0; }
double norm_mean(const struct norm *n) { return n->vol > 0.0 ? n->e1 / n->vol : 0.0; }

/* A pressure that is known up to a constant: its error less the mean. */
double norm_rms_mean_free(const struct norm *n)
{
    const double m = norm_mean(n);
    return n->vol > 0.0 ? sqrt(fmax(n->e2 / n->vol - m * m, 0.0)) : 0.0;
}

void norm_tell(struct summary *to, const char *name, const struct norm *n, double unit)
{
    static const char *const part[] = {"vol", "e1", "e2", "r2", "emax", "unit"};
    const double v[] = {n->vol, n->e1, n->e2, n->r2, n->emax, unit};
    const size_t parts = sizeof v / sizeof v[0] - (unit > 0.0 ? 0 : 1);
    for (size_t k = 0; k < parts; k++)
        summary_real(to, key_text("norm.%s.%s", name, part[k]), v[k]);
}
