/* rows.c - see rows.h. Face values, slopes on faces and from them derivatives of cells come from
 * the quartic through the integral of the averages at five edges: fourth order for any heights, and
 * the plain weights for even ones. Heights: even ones at the top, growing downwards by h_i = fine
 * ratio^exponent(i), the exponent a smooth step from 1 to 0; at the bottom ROWS_BOTTOM equal ones.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "rows.h"

#include "../../common/base/base.h"

/* From 1 at x = 0 to 0 at x = 1, with two smooth derivatives. */
static double step_down(double x) { return 1.0 - x * x * x * (10.0 + x * (6.0 * x - 15.0)); }

/* Exponent of row i, of n rows below the even ones. Row 0 is the lowest. */
static double exponent(int i, int n)
{
    return i < ROWS_BOTTOM ? 1.0 : step_down((i - ROWS_BOTTOM + 0.5) / (n - ROWS_BOTTOM));
}

/* Height of the n rows below, in units of the even ones. */
static double sum_below(int n, double ratio)
{
    double sum = 0.0;
    for (int i = 0; i < n; i++)
        sum += pow(ratio, exponent(i, n));
    return sum;
}

/* The ratio follows by bisection of its logarithm, so that the heights add up to what is below
 * `above'. */
double rows_heights(int n, int even, double above, double length, double *h)
{
    const int below = n - even;
    double lo = 1.0, hi = 1e3, most = 1.0;
    if (even < 1 || below < ROWS_BOTTOM + ROWS_GROWING || !(above > 0.0 && above < length))
        return NAN;
    const double fine = (length - above) / even, want = above / fine;
    if (sum_below(below, lo) > want || sum_below(below, hi) < want)
        return NAN;
    for (int k = 0; k < 200; k++) {
        const double middle = sqrt(lo * hi);
        *(sum_below(below, middle) < want ? &lo : &hi) = middle;
    }
    for (int i = 0; i < n; i++) {
        h[i] = i < below ? fine * pow(lo, exponent(i, below)) : fine;
        most = i > 0 ? fmax(most, h[i - 1] / h[i]) : most;
    }
    return most;
}

/* First and second derivative at e[2] of Lagrange's polynomial of node m on e[0..4]. Sums over
 * products of all but two, or three, of the factors. */
static void lagrange(const double e[5], int m, double d[2])
{
    double below = 1.0, first = 0.0, second = 0.0;
    for (int k = 0; k < 5; k++)
        below *= k == m ? 1.0 : e[m] - e[k];
    for (int i = 0; i < 5; i++)
        for (int j = 0; j < 5; j++) {
            double three = 1.0, two = 1.0;
            for (int k = 0; k < 5; k++) {
                three *= k == m || k == i ? 1.0 : e[2] - e[k];
                two *= k == m || k == i || k == j ? 1.0 : e[2] - e[k];
            }
            first += j == 0 && i != m ? three : 0.0;
            second += i != j && i != m && j != m ? two : 0.0;
        }
    d[0] = first / below;
    d[1] = second / below;
}

/* Weights of the four averages of heights h around the middle edge: value and slope there. The
 * integral up to edge m is a sum of h times averages; its first derivative is the value, its second
 * one the slope. */
static void face_weights(const double h[4], double value[4], double slope[4])
{
    double e[5] = {-h[0] - h[1], -h[1], 0.0, h[2], h[2] + h[3]}, d[5][2];
    for (int m = 0; m < 5; m++)
        lagrange(e, m, d[m]);
    for (int c = 0; c < 4; c++) {
        value[c] = slope[c] = 0.0;
        for (int m = c + 1; m < 5; m++) { /* the integral up to edge m holds the averages below */
            value[c] += h[c] * d[m][0];
            slope[c] += h[c] * d[m][1];
        }
    }
}

static const double ones[9] = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};

/* The average over a layer beyond the edge is the difference of the extrapolated integral at its
 * two ends over its height. */
void rows_beyond(const double *of, int way, int n, int depth, double *w)
{
    const double *h = of ? of : ones + 4;
    double e[5] = {0.0}, y[2] = {0.0, h[way]}; /* edges before it; ends of the row behind */
    for (int m = 0; m < n; m++)
        e[m + 1] = e[m] - h[-way * m];
    for (int k = 1; k < depth; k++) {
        y[0] = y[1];
        y[1] += h[way * (k + 1)];
    }
    for (int m = 0; m < n; m++)
        w[m] = 0.0;
    for (int k = 1; k <= n; k++) {
        double ends[2]; /* the integral from edge 0 to k holds -h of the averages before */
        for (int q = 0; q < 2; q++) {
            ends[q] = 1.0;
            for (int m = 0; m <= n; m++)
                ends[q] *= m == k ? 1.0 : (y[q] - e[m]) / (e[k] - e[m]);
        }
        for (int m = 0; m < k; m++)
            w[m] -= h[-way * m] * (ends[1] - ends[0]) / (y[1] - y[0]);
    }
}

/* Mean of y^2 from a to b. */
static double mean_square(double a, double b) { return (a * a + a * b + b * b) / 3.0; }

/* q = a + b y^2 with y from the edge: its average over the layer beyond from those of the first two
 * layers; n = 1: the first one itself. */
void rows_mirror(const double *of, int way, int n, int depth, double *w)
{
    const double *h = of ? of : ones + 4;
    const double near = mean_square(0.0, h[0]), far = mean_square(h[0], h[0] + h[-way]),
                 low = depth > 1 ? h[way] : 0.0, x = mean_square(low, low + h[way * depth]);
    w[0] = n > 1 ? (far - x) / (far - near) : 1.0;
    if (n > 1)
        w[1] = 1.0 - w[0];
}

/* As rows_beyond, within four layers. */
void rows_average(const double e[5], double from, double to, double w[4])
{
    const double y[2] = {from, to};
    for (int m = 0; m < 4; m++)
        w[m] = 0.0;
    for (int k = 1; k < 5; k++) {
        double ends[2]; /* the integral up to edge k holds the averages below */
        for (int q = 0; q < 2; q++) {
            ends[q] = 1.0;
            for (int m = 0; m < 5; m++)
                ends[q] *= m == k ? 1.0 : (y[q] - e[m]) / (e[k] - e[m]);
        }
        for (int m = 0; m < k; m++)
            w[m] += (e[m + 1] - e[m]) * (ends[1] - ends[0]) / (to - from);
    }
}

/* Faces of rows from -1 to n + 1, derivatives of rows from -1 to n; what is read is from -3 to n +
 * 2. gradient and laplace are differences of the faces' values and slopes over the height. */
static void set_weights(struct rows *r, int n)
{
    for (int j = -1; j <= n + 1; j++)
        face_weights(r->h + j - 2, r->face[j], r->slope[j]);
    for (int j = -1; j <= n; j++)
        for (int m = 0; m < 5; m++) {
            const double up = m > 0 ? r->face[j + 1][m - 1] : 0.0,
                         low = m < 4 ? r->face[j][m] : 0.0;
            const double up2 = m > 0 ? r->slope[j + 1][m - 1] : 0.0,
                         low2 = m < 4 ? r->slope[j][m] : 0.0;
            r->gradient[j][m] = (up - low) / r->h[j];
            r->laplace[j][m] = (up2 - low2) / r->h[j];
        }
}

/* Arrays are shifted by GHOSTS so that j may be negative; layers beyond the ends are as high as the
 * last one. */
struct rows *rows_create(int n, int even, double bottom, const double *h, int lo, int own)
{
    struct rows *r = NEW(struct rows, 1);
    const int all = own + 2 * GHOSTS + 2;
    r->even = n - even;
    r->edge = NEW(double, n + 1);
    r->edge[0] = bottom;
    for (int j = 0; j < n; j++)
        r->edge[j + 1] = r->edge[j] + h[j];
    r->h = NEW(double, all) + GHOSTS;
    r->y = NEW(double, all) + GHOSTS;
    r->step = NEW(double, all) + GHOSTS;
    r->face = (double(*)[4])NEW(double, 4 * all) + GHOSTS;
    r->slope = (double(*)[4])NEW(double, 4 * all) + GHOSTS;
    r->gradient = (double(*)[5])NEW(double, 5 * all) + GHOSTS;
    r->laplace = (double(*)[5])NEW(double, 5 * all) + GHOSTS;
    for (int j = -GHOSTS; j < own + GHOSTS + 2; j++) {
        const int i = lo + j, in = i < 0 ? 0 : i < n ? i : n - 1;
        const double beyond = i < 0 ? i : i > n - 1 ? i - (n - 1) : 0.0;
        r->h[j] = h[in];
        r->y[j] = 0.5 * (r->edge[in] + r->edge[in + 1]) + beyond * h[in];
        r->step[j] = j > -GHOSTS ? r->y[j] - r->y[j - 1] : h[in];
    }
    r->scale = NEW(double, all) + GHOSTS;
    for (int j = -1; j < own + 2; j++)
        r->scale[j] = (8.0 * (r->y[j + 1] - r->y[j - 1]) - (r->y[j + 2] - r->y[j - 2])) / 12.0;
    set_weights(r, own);
    return r;
}

void rows_free(struct rows **rp)
{
    struct rows *r = *rp;
    if (!r)
        return;
    FREE(r->edge, r->h - GHOSTS, r->y - GHOSTS, r->step - GHOSTS, r->scale - GHOSTS,
         r->face - GHOSTS, r->slope - GHOSTS, r->gradient - GHOSTS, r->laplace - GHOSTS, r);
    *rp = NULL;
}
