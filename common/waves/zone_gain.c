/* zone_gain.c - see zone_gain.h. Unknown: p/rho in cells, x from the side. Each face has
 * u = (-grad p + r u_w)/(i w + r); at the surface i w eta = w, p = g eta; at the far end waves run
 * out as e^(i(wt - kx)). SPDX-License-Identifier: BSD-3-Clause */
#include "zone_gain.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>

#include "../base/base.h"

enum { NZ = 32, A_LENGTH = 64, RIGHT = 3 };

struct problem {
    double w, k, g, h, length, rate; /* h: as deep as waves reach */
    double kx, ky;                   /* 1/m: along the side's normal, along the side */
    double dx, dz;
    int nx;
    double *re, *im; /* rows of WIDTH: upper band of the symmetric matrix, then right sides */
};

enum { BAND = NZ + 1, WIDTH = BAND + RIGHT };

static double rate_at(const struct problem *q, double x)
{
    const double chi = fmax(0.0, 1.0 - x / q->length);
    return q->rate * chi * chi;
}

static double wave_cosh(const struct problem *q, double z)
{
    return (exp(q->k * z) + exp(-q->k * (z + 2.0 * q->h))) / (1.0 + exp(-2.0 * q->k * q->h));
}

static double wave_sinh(const struct problem *q, double z)
{
    return (exp(q->k * z) - exp(-q->k * (z + 2.0 * q->h))) / (1.0 + exp(-2.0 * q->k * q->h));
}

/* p/rho of a wave of height 1 above rest that runs to +x (way 1) or -x (-1). */
static double complex wave_p(const struct problem *q, double x, double z, int way)
{
    return q->g * wave_cosh(q, z) * cexp(-I * (way * q->kx * x));
}

static double complex wave_u(const struct problem *q, double x, double z, int way)
{
    return way * q->kx / q->w * wave_p(q, x, z, way);
}

static double complex wave_w(const struct problem *q, double x, double z, int way)
{
    return I * (q->g * q->k / q->w) * wave_sinh(q, z) * cexp(-I * (way * q->kx * x));
}

static void add_at(struct problem *q, int row, int at, double complex value)
{
    q->re[(size_t)row * WIDTH + (size_t)at] += creal(value);
    q->im[(size_t)row * WIDTH + (size_t)at] += cimag(value);
}

static void add(struct problem *q, int row, int column, double complex value)
{
    add_at(q, row < column ? row : column, abs(column - row), value);
}

static void add_right(struct problem *q, int row, int way, double complex value)
{
    add_at(q, row, BAND + way, value);
}

/* Flux through the face between two cells, out of the first: area u. Right sides: u_w of a wave to
 * +x, to -x. u (i w + r) = (p_first - p_second)/gap + r u_w. */
static void between(struct problem *q, int first, int second, double area, double gap, double r,
                    const double complex u_w[2])
{
    const double complex all = area / (I * q->w + r), c = all / gap;
    add(q, first, first, c);
    add(q, first, second, -c);
    add(q, second, second, c);
    for (int k = 0; k < 2; k++) {
        add_right(q, first, k, -all * r * u_w[k]);
        add_right(q, second, k, all * r * u_w[k]);
    }
}

/* Half a cell from the centre to the surface, where p = g eta and i w eta = w. */
static void surface(struct problem *q, int cell, double x)
{
    const double r = rate_at(q, x);
    const double complex below = I * q->w + r + 2.0 * q->g / (I * q->w * q->dz);
    add(q, cell, cell, q->dx * 2.0 / q->dz / below);
    for (int k = 0; k < 2; k++)
        add_right(q, cell, k, -q->dx * r * wave_w(q, x, 0.0, k ? -1 : 1) / below);
}

/* What an oblique wave, e^(-i ky y), moves along the side. */
static void along(struct problem *q, int cell, double x, double z)
{
    const double r = rate_at(q, x), all = q->dx * q->dz;
    const double complex c = all * q->ky / (I * q->w + r);
    add(q, cell, cell, c * q->ky);
    for (int k = 0; k < 2; k++)
        add_right(q, cell, k, I * c * (r * q->ky / q->w) * wave_p(q, x, z, k ? -1 : 1));
}

/* The third right side is a wave that comes in. */
static void far_end(struct problem *q, int cell, double z)
{
    const double x = q->nx * q->dx, centre = x - 0.5 * q->dx, area = q->dz;
    const double complex turn = cexp(-0.5 * I * (q->kx * q->dx)), c = area * q->kx / q->w;
    add(q, cell, cell, c * turn);
    add_right(q, cell, 2, c * (wave_p(q, centre, z, -1) * turn + wave_p(q, x, z, -1)));
}

/* Continuity of every cell: the fluxes out of it sum to 0. Columns of NZ cells from the bed up, one
 * after the other from the far end, so that neighbours are NZ rows apart at most. The side and the
 * bed are walls: no face, no flux. */
static void assemble(struct problem *q)
{
    for (int i = 0; i < q->nx; i++)
        for (int j = 0; j < NZ; j++) {
            const int cell = (q->nx - 1 - i) * NZ + j;
            const double x = (i + 0.5) * q->dx, z = (j + 0.5) * q->dz - q->h;
            const double xf = x + 0.5 * q->dx, zf = z + 0.5 * q->dz;
            along(q, cell, x, z);
            if (i + 1 < q->nx)
                between(q, cell, cell - NZ, q->dz, q->dx, rate_at(q, xf),
                        (double complex[]){wave_u(q, xf, z, 1), wave_u(q, xf, z, -1)});
            else
                far_end(q, cell, z);
            if (j + 1 < NZ)
                between(q, cell, cell + 1, q->dx, q->dz, rate_at(q, x),
                        (double complex[]){wave_w(q, x, zf, 1), wave_w(q, x, zf, -1)});
            else
                surface(q, cell, x);
        }
}

/* a -= f b for complex rows, real and imaginary parts apart: several columns at once. */
static inline void subtract(double *restrict a_re, double *restrict a_im, const double *restrict re,
                            const double *restrict im, double complex f, int n)
{
    const double fr = creal(f), fi = cimag(f);
    for (int j = 0; j < n; j++) {
        a_re[j] -= fr * re[j] - fi * im[j];
        a_im[j] -= fr * im[j] + fi * re[j];
    }
}

/* L D L^T without pivots, which waves that run out of the far end make safe: what has been
 * eliminated, the water from there on, has no resonance. Solutions take the place of right sides.
 */
static void solve(struct problem *q)
{
    const int n = q->nx * NZ;
    for (int k = 0; k < n; k++) {
        const double *re = q->re + (size_t)k * WIDTH, *im = q->im + (size_t)k * WIDTH;
        const double complex pivot = 1.0 / CMPLX(re[0], im[0]);
        for (int i = 1; i < BAND && k + i < n; i++) {
            const double complex f = pivot * CMPLX(re[i], im[i]);
            double *to_re = q->re + (size_t)(k + i) * WIDTH,
                   *to_im = q->im + (size_t)(k + i) * WIDTH;
            subtract(to_re, to_im, re + i, im + i, f, BAND - i);
            subtract(to_re + BAND, to_im + BAND, re + BAND, im + BAND, f, RIGHT);
        }
    }
    for (int k = n - 1; k >= 0; k--) {
        double *re = q->re + (size_t)k * WIDTH, *im = q->im + (size_t)k * WIDTH;
        for (int i = 1; i < BAND && k + i < n; i++)
            subtract(re + BAND, im + BAND, re + i * WIDTH + BAND, im + i * WIDTH + BAND,
                     CMPLX(re[i], im[i]), RIGHT);
        for (int way = 0; way < RIGHT; way++) {
            const double complex x = CMPLX(re[BAND + way], im[BAND + way]) / CMPLX(re[0], im[0]);
            re[BAND + way] = creal(x);
            im[BAND + way] = cimag(x);
        }
    }
}

/* Height of the wave that leaves, of a right side. By projection on cosh k(z + h), which waves that
 * cannot travel are orthogonal to: half a length or two depths behind the zone they have decayed
 * away. */
static double complex leaves(const struct problem *q, int way)
{
    double complex sum = 0.0;
    double all = 0.0;
    const double x = (q->nx - 0.5) * q->dx;
    for (int j = 0; j < NZ; j++) {
        const double z = (j + 0.5) * q->dz - q->h, weight = wave_cosh(q, z);
        double complex p = CMPLX(q->re[j * WIDTH + BAND + way], q->im[j * WIDTH + BAND + way]);
        p -= way == 2 ? wave_p(q, x, z, -1) : 0.0;
        sum += weight * p;
        all += weight * weight * q->g;
    }
    return sum / all * cexp(I * (q->kx * x));
}

/* Three right sides at once: u_w of a wave from the side, of one to it, and a wave that comes in.
 * make asks for height 1 that leaves; pass adds just so much that what comes back is cancelled. h:
 * below 0.8 of a length waves have no effect. */
struct zone_response zone_response(double omega, double number, double cosine, double g,
                                   double depth, double length, double rate)
{
    const double wave = 2.0 * M_PI / number, h = fmin(depth, 0.8 * wave),
                 whole = length + fmax(0.5 * wave, 2.0 * h);
    struct problem q = {.w = omega, .k = number, .g = g, .h = h, .length = length, .rate = rate};
    q.kx = number * cosine;
    q.ky = number * sqrt(fmax(0.0, 1.0 - cosine * cosine));
    struct zone_response is = {1.0, 1.0, 0.0};
    if (length > 6.0 * wave || cosine < 0.1) /* nothing gets through; the side is in no way */
        return is;
    q.nx = (int)ceil(whole / wave * A_LENGTH);
    q.dx = whole / q.nx;
    q.dz = h / NZ;
    const int n = q.nx * NZ;
    q.re = NEW(double, (size_t)n *WIDTH);
    q.im = NEW(double, (size_t)n *WIDTH);
    assemble(&q);
    solve(&q);
    const double complex back = leaves(&q, 2);
    is = (struct zone_response){
        .make = 1.0 / leaves(&q, 0), .pass = -back / leaves(&q, 1), .reflected = cabs(back)};
    FREE(q.re, q.im);
    return is;
}
