/* hos.c - see hos.h. A call costs for each order m one transform to modes and (order - m + 2)/2
 * transforms back, two derivatives in each as real and imaginary part. Terms of eta^q times k^q
 * grow before they cancel: hence the orders up to 9 and the bound on steepness (waves.c). Called by
 * evolution.c four times a step.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "hos.h"

#include "../base/base.h"

enum { TERMS = HOS_ORDERS + 1 };

/* Work arrays. Order m of W and phi stands at [m][cells]. */
struct hos {
    const struct wave_grid *grid;
    int order;
    double *factor;   /* [cells][TERMS]: of d_z^q, q = 1 .. order; 0 beyond `highest' */
    double *keep;     /* [cells]: 1, or 0 beyond `highest' */
    double *W, *phi;  /* [order + 1][cells], orders from 1 */
    double *z, *work; /* [cells][2][(TERMS + 1)/2] */
};

/* factor: k^q, for odd q times tanh kh, which is 1 beyond kh = 300 without an overflow. */
struct hos *hos_create(const struct wave_grid *grid, double depth, int order, double highest)
{
    struct hos *h = NEW(struct hos, 1);
    const size_t cells = (size_t)grid->cells, all = cells * (size_t)(order + 1);
    *h = (struct hos){.grid = grid, .order = order};
    h->factor = NEW_IN(h, double, cells *TERMS);
    h->keep = NEW_IN(h, double, cells);
    h->W = NEW_IN(h, double, all);
    h->phi = NEW_IN(h, double, all);
    h->z = NEW_IN(h, double, cells *(TERMS + 2));
    h->work = NEW_IN(h, double, cells *(TERMS + 2));
    for (size_t m = 0; m < cells; m++) {
        const double k = grid->size[m], t = tanh(fmin(k * depth, 300.0));
        h->keep[m] = k <= highest;
        for (int q = 1; q <= order; q++)
            h->factor[m * TERMS + (size_t)q] = h->keep[m] * pow(k, q) * (q % 2 ? t : 1.0);
    }
    return h;
}

/* Fields d_z^q phi, q = 1 .. n, of a field phi: q odd in real parts, even in imaginary ones (the
 * factors are real and even in k). */
static void derive(struct hos *h, const double *phi, int n)
{
    const int half = (n + 1) / 2, cells = h->grid->cells;
    for (int i = 0; i < cells; i++) {
        h->work[2 * i] = phi[i];
        h->work[2 * i + 1] = 0.0;
    }
    wave_grid_to_modes(h->grid, 1, h->work, h->z);
    for (int i = 0; i < cells; i++) {
        const double re = h->work[2 * i], im = h->work[2 * i + 1],
                     *factor = h->factor + (size_t)i * TERMS;
        double *z = h->z + (size_t)i * 2 * (size_t)half;
        for (int b = 0; b < half; b++) {
            const double odd = factor[2 * b + 1], even = 2 * b + 2 <= n ? factor[2 * b + 2] : 0.0;
            z[b] = odd * re - even * im;
            z[half + b] = odd * im + even * re;
        }
    }
    wave_grid_to_fields(h->grid, half, h->z, h->work);
}

/* phi <- its modes up to `highest'. Products of the orders below fill modes beyond `highest'; left
 * in, they would be raised by k^q in the next order. */
static void cut(struct hos *h, double *phi)
{
    const int cells = h->grid->cells;
    for (int i = 0; i < cells; i++) {
        h->z[2 * i] = phi[i];
        h->z[2 * i + 1] = 0.0;
    }
    wave_grid_to_modes(h->grid, 1, h->z, h->work);
    for (int i = 0; i < 2 * cells; i++)
        h->z[i] *= h->keep[i / 2];
    wave_grid_to_fields(h->grid, 1, h->z, h->work);
    for (int i = 0; i < cells; i++)
        phi[i] = h->z[2 * i];
}

/* Adds what phi^(m) gives to W^(m + q) and to phi^(m + q). */
static void spread_order(struct hos *h, int m, const double *eta)
{
    const int cells = h->grid->cells, n = h->order - m + 1, half = (n + 1) / 2;
    for (int i = 0; i < cells; i++) {
        const double *z = h->z + (size_t)i * 2 * (size_t)half;
        double power = 1.0; /* eta^q/q! */
        for (int q = 0; q < n; q++) {
            const size_t to = (size_t)(m + q) * (size_t)cells + (size_t)i;
            h->W[to] += power * z[q / 2 + q % 2 * half]; /* d_z^(q+1) */
            if (q > 0)
                h->phi[to] -= power * z[(q - 1) / 2 + (q - 1) % 2 * half];
            power *= eta[i] / (q + 1);
        }
    }
}

/* Sums W^(i) and W^(i) W^(j), i + j, up to an order. Products beyond the order are left out, so
 * that all terms kept are of the order that is right. */
static void sums(const struct hos *h, int cell, int most, double *rise, double *square)
{
    const double *W = h->W + cell;
    const size_t n = (size_t)h->grid->cells;
    double below[TERMS] = {0.0};
    for (int i = 1; i <= most; i++)
        below[i] = below[i - 1] + W[(size_t)i * n];
    *rise = most > 0 ? below[most] : 0.0;
    *square = 0.0;
    for (int i = 1; i < most; i++)
        *square += W[(size_t)i * n] * below[most - i];
}

/* Orders one after the other: phi^(m) is complete once all below it have been spread. |grad eta|^2
 * is of order 2, so it multiplies sums up to order - 2. */
void hos_rise(struct hos *h, const double *eta, const double *phi, const double *slope2,
              double *rise, double *square)
{
    const size_t cells = (size_t)h->grid->cells, all = cells * (size_t)(h->order + 1);
    memset(h->W, 0, all * sizeof *h->W);
    memset(h->phi, 0, all * sizeof *h->phi);
    memcpy(h->phi + cells, phi, cells * sizeof *phi);
    for (int m = 1; m <= h->order; m++) {
        if (m > 1)
            cut(h, h->phi + (size_t)m * cells);
        derive(h, h->phi + (size_t)m * cells, h->order - m + 1);
        spread_order(h, m, eta);
    }
    for (int i = 0; i < h->grid->cells; i++) {
        double a, b, c, d;
        sums(h, i, h->order, &a, &b);
        sums(h, i, h->order - 2, &c, &d);
        rise[i] = a + slope2[i] * c;
        square[i] = b + slope2[i] * d;
    }
}
