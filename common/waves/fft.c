/* fft.c - see fft.h. With n = r m, s the product of the radices done before and w = e^(sign 2 pi
 * i/n): y[q + s (r p + k)] = w^(kp) sum over j of x[q + s (p + m j)] e^(sign 2 pi i jk/r).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "fft.h"

#include "../base/base.h"

enum { FACTORS = 32, RADIX = 5 };

struct fft {
    int n, nfactors, factor[FACTORS];
    double *turn; /* [n][2]: cosine and sine of 2 pi k/n */
};

/* What is left of n when 2, 3 and 5 are divided out. */
static int without_factors(int n)
{
    for (int r = 2; r <= RADIX; r += r == 2 ? 1 : 2)
        while (n % r == 0)
            n /= r;
    return n;
}

int fft_size(int n)
{
    n += n % 2;
    while (without_factors(n) > 1)
        n += 2;
    return n;
}

/* Radix 4 first: it needs the fewest operations. n has no other factors (fft_size). */
struct fft *fft_create(int n)
{
    static const int radices[] = {4, 2, 3, 5};
    struct fft *f = NEW(struct fft, 1);
    f->n = n;
    f->turn = NEW_IN(f, double, (size_t)n * 2);
    for (int k = 0; k < n; k++) {
        f->turn[2 * k] = cos(2.0 * M_PI * k / n);
        f->turn[2 * k + 1] = sin(2.0 * M_PI * k / n);
    }
    for (int i = 0; i < 4; i++)
        for (; n % radices[i] == 0; n /= radices[i])
            f->factor[f->nfactors++] = radices[i];
    return f;
}

/* What one sum needs: where its terms stand, the factors of its results and of the radix. */
struct butterfly {
    const double *x[RADIX];
    double *y[RADIX];
    double turn[RADIX][2], root[RADIX][2];
};

/* One block of `batch' values: radix r is a constant of each caller. Complex products in real
 * numbers, since those of C look for NaN. */
INLINE void sum_terms(const struct butterfly *of, const int r, int at, int batch)
{
    for (int k = 0; k < r; k++) {
        double *restrict y = of->y[k] + at;
        const double tr = of->turn[k][0], ti = of->turn[k][1];
        for (int b = 0; b < batch; b++) {
            double re = of->x[0][at + b], im = of->x[0][at + batch + b];
            for (int j = 1; j < r; j++) {
                const double *w = of->root[j * k % r];
                const double xr = of->x[j][at + b], xi = of->x[j][at + batch + b];
                re += w[0] * xr - w[1] * xi;
                im += w[0] * xi + w[1] * xr;
            }
            y[b] = tr * re - ti * im;
            y[batch + b] = tr * im + ti * re;
        }
    }
}

/* Radices 2 and 4 need no products but those of their results. */
INLINE void sum_two(const struct butterfly *of, int at, int batch)
{
    double *restrict y0 = of->y[0] + at, *restrict y1 = of->y[1] + at;
    const double *x0 = of->x[0] + at, *x1 = of->x[1] + at, tr = of->turn[1][0], ti = of->turn[1][1];
    for (int b = 0; b < batch; b++) {
        const double re = x0[b] - x1[b], im = x0[batch + b] - x1[batch + b];
        y0[b] = x0[b] + x1[b];
        y0[batch + b] = x0[batch + b] + x1[batch + b];
        y1[b] = tr * re - ti * im;
        y1[batch + b] = tr * im + ti * re;
    }
}

/* One butterfly of radix 4, with its turns. */
INLINE void sum_four(const struct butterfly *of, double sign, int at, int batch)
{
    const double *x0 = of->x[0] + at, *x1 = of->x[1] + at, *x2 = of->x[2] + at, *x3 = of->x[3] + at;
    double *restrict y0 = of->y[0] + at, *restrict y1 = of->y[1] + at, *restrict y2 = of->y[2] + at,
                     *restrict y3 = of->y[3] + at;
    const double(*t)[2] = of->turn;
    for (int b = 0, c = batch; b < batch; b++, c++) {
        const double ar = x0[b] + x2[b], ai = x0[c] + x2[c], br = x0[b] - x2[b], bi = x0[c] - x2[c],
                     cr = x1[b] + x3[b], ci = x1[c] + x3[c], dr = -sign * (x1[c] - x3[c]),
                     di = sign * (x1[b] - x3[b]);
        y0[b] = ar + cr;
        y0[c] = ai + ci;
        y1[b] = t[1][0] * (br + dr) - t[1][1] * (bi + di);
        y1[c] = t[1][0] * (bi + di) + t[1][1] * (br + dr);
        y2[b] = t[2][0] * (ar - cr) - t[2][1] * (ai - ci);
        y2[c] = t[2][0] * (ai - ci) + t[2][1] * (ar - cr);
        y3[b] = t[3][0] * (br - dr) - t[3][1] * (bi - di);
        y3[c] = t[3][0] * (bi - di) + t[3][1] * (br - dr);
    }
}

/* One radix for all blocks: s inner of them. */
static void sum_blocks(const struct butterfly *of, int r, double sign, int blocks, int batch)
{
    for (int i = 0; i < blocks; i++) {
        const int at = 2 * batch * i;
        if (r == 2)
            sum_two(of, at, batch);
        else if (r == 3)
            sum_terms(of, 3, at, batch);
        else if (r == 4)
            sum_four(of, sign, at, batch);
        else
            sum_terms(of, 5, at, batch);
    }
}

/* Stockham's form: every factor reads one array and writes the other in the order of its result, so
 * that no rows need to be swapped at the end. inner: neighbours in memory that are transformed
 * alike (the other axis of a plane), batch: fields at once; both are innermost loops, real and
 * imaginary parts `batch' apart, which a compiler turns into vector operations. O(n sum of the
 * factors) for each field. */
void fft_run(const struct fft *f, int sign, int inner, int batch, double *z, double *work)
{
    const size_t block = (size_t)inner * 2 * (size_t)batch;
    double *x = z, *y = work;
    for (int i = 0, s = 1, n = f->n; i < f->nfactors; i++) {
        const int r = f->factor[i], m = n / r;
        struct butterfly of;
        for (int k = 0; k < r; k++) {
            of.root[k][0] = f->turn[2 * (k * (f->n / r))];
            of.root[k][1] = sign * f->turn[2 * (k * (f->n / r)) + 1];
        }
        for (int p = 0; p < m; p++) {
            for (int k = 0; k < r; k++) {
                of.x[k] = x + block * (size_t)s * (size_t)(p + m * k);
                of.y[k] = y + block * (size_t)s * (size_t)(r * p + k);
                of.turn[k][0] = f->turn[2 * (k * p * s)];
                of.turn[k][1] = sign * f->turn[2 * (k * p * s) + 1];
            }
            sum_blocks(&of, r, sign, s * inner, batch);
        }
        double *const other = x;
        x = y;
        y = other;
        s *= r;
        n = m;
    }
    if (x != z)
        memcpy(z, x, block * (size_t)f->n * sizeof *z);
}
