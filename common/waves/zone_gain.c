/* zone_gain.c - see zone_gain.h. Unknown: p/rho in cells, x from the side. Each face has
 * u = (-grad p + r u_w)/(i w + r); at the surface i w eta = w, p = g eta; at the far end waves run
 * out as e^(i(wt - kx)). SPDX-License-Identifier: BSD-3-Clause */
#include "zone_gain.h"

#include <complex.h>
#include <lapacke.h>

#include "../base/base.h"

enum { NZ = 32, A_LENGTH = 64, RIGHT = 3 };

struct problem {
    double w, k, g, h, length, rate; /* h: as deep as waves reach */
    double kx, ky;                   /* 1/m: along the side's normal, along the side */
    double dx, dz;
    int nx;
    double complex *ab, *b; /* LAPACK's band, right sides */
};

enum { BAND = 3 * NZ + 1 };

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

static void add(struct problem *q, int row, int column, double complex value)
{
    q->ab[(size_t)column * BAND + (size_t)(2 * NZ + row - column)] += value;
}

static void add_right(struct problem *q, int row, int way, double complex value)
{
    q->b[(size_t)way * (size_t)(q->nx * NZ) + (size_t)row] += value;
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
    add(q, second, first, -c);
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
 * after the other from the side, so that neighbours are at most NZ rows apart and the band is as
 * narrow as can be. The side and the bed are walls: no face, no flux. */
static void assemble(struct problem *q)
{
    for (int i = 0; i < q->nx; i++)
        for (int j = 0; j < NZ; j++) {
            const int cell = i * NZ + j;
            const double x = (i + 0.5) * q->dx, z = (j + 0.5) * q->dz - q->h;
            const double xf = x + 0.5 * q->dx, zf = z + 0.5 * q->dz;
            along(q, cell, x, z);
            if (i + 1 < q->nx)
                between(q, cell, cell + NZ, q->dz, q->dx, rate_at(q, xf),
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
        double complex p =
            q->b[(size_t)way * (size_t)(q->nx * NZ) + (size_t)((q->nx - 1) * NZ + j)];
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
    q.ab = NEW(double complex, (size_t)n *BAND);
    q.b = NEW(double complex, (size_t)n *RIGHT);
    lapack_int *pivots = NEW(lapack_int, n);
    assemble(&q);
    if (LAPACKE_zgbsv(LAPACK_COL_MAJOR, n, NZ, NZ, RIGHT, q.ab, BAND, pivots, q.b, n) == 0) {
        const double complex back = leaves(&q, 2);
        is = (struct zone_response){
            .make = 1.0 / leaves(&q, 0), .pass = -back / leaves(&q, 1), .reflected = cabs(back)};
    }
    FREE(q.ab, q.b, pivots);
    return is;
}
