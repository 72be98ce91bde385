/* wave_field_start.c - see wave_field_start.h. Modes of the grid that lie in the range of the
 * spectrum become components; their sum at t0, with what each two of them bind, is the state from
 * which the field evolves. Third and higher orders grow by themselves in the periods before the
 * run.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "wave_field_start.h"

#include "../base/base.h"
#include "sea.h"
#include "second_order.h"

static const double widest = 75.0 * M_PI / 180.0; /* as of a sum: sea.c */

static double group_speed(double k, double w, double h)
{
    const double kh = 2.0 * fmin(k * h, 150.0);
    return 0.5 * w / k * (1.0 + kh / sinh(kh));
}

static int by_number(const void *a, const void *b)
{
    const struct wave_component *p = a, *q = b;
    return p->k != q->k ? (p->k > q->k) - (p->k < q->k)
                        : (p->way[1] > q->way[1]) - (p->way[1] < q->way[1]);
}

/* The share of a mode: of the variance (sea) or of the amplitude (group). S(f) df = S(f) c_g dk/(2
 * pi), as modes are equidistant in k; over a plane divided by k for the area dk_x dk_y, and times
 * cos^2s(b/2) = ((1 + cos b)/2)^s. */
static double share_of(const struct wave_spec *of, double period, const struct wave_component *c,
                       bool plane)
{
    const double f = c->w * period / (2.0 * M_PI);
    const double S = sea_jonswap(f, of->peak) * group_speed(c->k, c->w, of->depth);
    return plane ? S / c->k * pow(0.5 * (1.0 + c->way[0]), of->spread) : S;
}

/* Random phases in the order of the components, which does not depend on the height. */
static void set_phases(const struct wave_spec *of, struct wave_component *c, int n)
{
    uint64_t state = (uint64_t)of->seed;
    for (int i = 0; i < n; i++)
        c[i].phase = of->kind == WAVE_SEA ? 2.0 * M_PI * sea_uniform(&state)
                                          : c[i].w * of->at[1] - c[i].k * of->at[0];
}

/* Scaled to the height: of a sea by the variance, of a group by the sum of amplitudes. */
static void set_amplitudes(const struct wave_spec *of, double period, struct wave_component *c,
                           int n, bool plane)
{
    const bool random = of->kind == WAVE_SEA;
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < n; i++) {
        const double share = share_of(of, period, c + i, plane);
        c[i].a = random ? sqrt(2.0 * share) : share;
        sum += c[i].a;
        squares += 0.5 * c[i].a * c[i].a;
    }
    const double scale = random ? 0.25 * of->height / sqrt(squares) : 0.5 * of->height / sum;
    for (int i = 0; i < n; i++)
        c[i].a *= scale;
}

/* Those modes of the grid that carry energy and run forwards, by wave number; *n of them, owned by
 * the caller. */
struct wave_component *wave_field_components(const struct wave_spec *of, double period,
                                             const struct wave_grid *g, double highest, int *n)
{
    const double peak = 2.0 * M_PI / period, low = waves_number(0.5 * peak, of->g, of->depth),
                 high = fmin(waves_number(3.0 * peak, of->g, of->depth), highest);
    struct wave_component *c = NEW(struct wave_component, g->cells);
    *n = 0;
    for (int m = 0; m < g->cells; m++) {
        const double k = g->size[m], kx = g->k[0][m % g->n[0]], ky = g->k[1][m / g->n[0]];
        if (k < low || k > high || kx < k * cos(widest))
            continue;
        c[(*n)++] = (struct wave_component){
            .k = k, .w = waves_frequency(k, of->g, of->depth), .way = {kx / k, ky / k}};
    }
    qsort(c, (size_t)*n, sizeof *c, by_number);
    set_phases(of, c, *n);
    set_amplitudes(of, period, c, *n, g->n[1] > 1);
    return c;
}

/* Adds eta cos th and phi sin th of the mode m, th = k.x + phase. eta cos th + i phi sin th is (eta
 * + phi)/2 e^(i th) + (eta - phi)/2 e^(-i th). */
static void add_wave(const struct wave_grid *g, long m, double eta, double phi, double phase,
                     double *z)
{
    const double c = 0.5 * cos(phase), s = 0.5 * sin(phase);
    double *to = z + 2 * m, *mirror = z + 2 * g->mirror[m];
    to[0] += (eta + phi) * c;
    to[1] += (eta + phi) * s;
    mirror[0] += (eta - phi) * c;
    mirror[1] -= (eta - phi) * s;
}

struct start {
    const struct wave_grid *grid;
    const struct evolution_spec *in;
    long (*mode)[2]; /* of each component */
    double *phase;   /* - */
};

/* The mode of the sum or difference of two; -1: the grid does not hold it. */
static long mode_of(const struct start *s, int i, int j, int sign)
{
    const int *n = s->grid->n;
    long m[2];
    for (int a = 0; a < 2; a++) {
        m[a] = s->mode[i][a] + sign * s->mode[j][a];
        if (2 * labs(m[a]) >= n[a] && n[a] > 1)
            return -1;
        m[a] = (m[a] + n[a]) % n[a];
    }
    return m[1] * n[0] + m[0];
}

/* A pair's sum and difference; m = 0, a mean level, is left out, and a pair whose mode the grid
 * does not hold. */
static void add_bound(const struct start *s, const struct wave_component *of, int i, int j,
                      double *z)
{
    const struct wave_component *p = of + i, *q = of + j;
    const double k1[2] = {p->k * p->way[0], p->k * p->way[1]},
                 k2[2] = {q->k * q->way[0], q->k * q->way[1]};
    for (int sign = 1; sign >= -1; sign -= 2) {
        const long m = mode_of(s, i, j, sign);
        if (m <= 0)
            continue;
        const struct bound_wave b = bound_wave_of(k1, k2, p->w, q->w, sign, s->in->g, s->in->depth);
        const double a = (i == j ? 0.5 : 1.0) * p->a * q->a;
        add_wave(s->grid, m, a * b.eta, a * b.u / b.K, s->phase[i] + sign * s->phase[j], z);
    }
}

/* phi_s is that at z = 0 and eta phi_z, both of first order: z of these. phi at z = eta is phi +
 * eta phi_z to second order, before the bound waves, which are of that order already. */
static void lift(const struct wave_grid *g, const struct evolution_spec *in, double *z)
{
    double *f = NEW(double, g->cells * 4), *work = NEW(double, g->cells * 4);
    for (int i = 0; i < g->cells; i++) {
        const double *q = z + 2 * i, *m = z + 2 * g->mirror[i],
                     rise = g->size[i] * tanh(fmin(g->size[i] * in->depth, 300.0));
        f[4 * i] = q[0]; /* eta + i phi */
        f[4 * i + 2] = q[1];
        f[4 * i + 1] = 0.5 * rise * (q[1] + m[1]); /* phi_z */
        f[4 * i + 3] = 0.5 * rise * (m[0] - q[0]);
    }
    wave_grid_to_fields(g, 2, f, work);
    for (int i = 0; i < g->cells; i++) {
        z[2 * i] = f[4 * i];
        z[2 * i + 1] = f[4 * i + 2] + f[4 * i] * f[4 * i + 1];
    }
    wave_grid_to_modes(g, 1, z, work);
    FREE(f, work);
}

/* n^2/2 pairs, once at the start. */
void wave_field_modes(const struct wave_grid *g, const struct wave_component *of, int n,
                      const struct evolution_spec *in, double t, double *z)
{
    const struct start s = {
        .grid = g, .in = in, .mode = (long(*)[2])NEW(long, n * 2), .phase = NEW(double, n)};
    memset(z, 0, (size_t)g->cells * 2 * sizeof *z);
    for (int i = 0; i < n; i++) {
        const struct wave_component *c = of + i;
        for (int a = 0; a < 2; a++)
            s.mode[i][a] = lround(c->k * c->way[a] * g->length[a] / (2.0 * M_PI));
        s.phase[i] = c->phase - c->w * t;
        add_wave(g, (s.mode[i][1] + g->n[1]) % g->n[1] * g->n[0] + s.mode[i][0], c->a,
                 in->g * c->a / c->w, s.phase[i], z);
    }
    lift(g, in, z);
    for (int i = 0; i < n; i++)
        for (int j = i; j < n; j++)
            add_bound(&s, of, i, j, z);
    for (int m = 0; m < g->cells; m++)
        if (g->size[m] > in->highest)
            z[2 * m] = z[2 * m + 1] = 0.0;
    FREE(s.mode, s.phase);
}
