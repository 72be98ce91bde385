/* steady_errors.c - the surface of FV's columns at the end of a run beside a wave of permanent form
 * (common/steady.h): a solitary wave's crest and place, and what it has left behind; of regular
 * waves mean, first and second harmonic, by least squares, as a partner may hold some columns.
 * SPDX-License-Identifier: BSD-3-Clause */

#include "../../common/scene/scene.h"
#include "../boundary/fv_boundary.h"
#include "../surface/fv_surface.h"
#include "output.h"

enum { HARMONICS = 5 }; /* 1, cos, sin, cos 2, sin 2 */

/* Heights of the water in all columns along x over the level at rest, means over z, and which of
 * them are FV's. Returns their number. Collective. */
static int columns(const struct fv *s, double **eta, double **is)
{
    const struct block *b = &s->b;
    const int n = b->cells[0];
    *eta = NEW(double, n);
    *is = NEW(double, n);
    BLOCK_CELLS (b, i, j, k, c) {
        (*eta)[b->lo[0] + i] += block_size(b, 1, j) * surface_water(s, c) / b->cells[2];
        if (b->lo[1] + j == 0 && b->lo[2] + k == 0)
            (*is)[b->lo[0] + i] = !(s->forcing && s->forcing->forced[c]);
    }
    MPI_Allreduce(MPI_IN_PLACE, *eta, n, MPI_DOUBLE, MPI_SUM, b->cart);
    MPI_Allreduce(MPI_IN_PLACE, *is, n, MPI_DOUBLE, MPI_SUM, b->cart);
    for (int i = 0; i < n; i++)
        (*eta)[i] -= s->exact.height;
    return n;
}

/* x of the middle of column i, m. */
static double place(const struct fv *s, int i) { return s->b.origin[0] + (i + 0.5) * s->b.h[0]; }

/* Crest of the parabola through the highest column and those beside it. *x is its position. */
static double crest(const struct fv *s, int n, const double *eta, const double *is, double *x)
{
    int top = 1;
    for (int i = 1; i < n - 1; i++)
        top = is[i] > 0.0 && eta[i] > eta[top] ? i : top;
    const double slope = 0.5 * (eta[top + 1] - eta[top - 1]);
    const double bend = eta[top + 1] - 2.0 * eta[top] + eta[top - 1];
    const double at = bend < 0.0 ? -slope / bend : 0.0;
    *x = place(s, top) + at * s->b.h[0];
    return eta[top] + 0.5 * slope * at;
}

/* What lies more than 0.75 wave lengths behind the crest has been left behind; errors over the
 * crest's height, the position's over the depth. */
static void solitary(struct fv *s, int n, const double *eta, const double *is)
{
    const struct steady *w = &s->exact.steady;
    struct summary *to = s->run->summary;
    const double H = s->exact.height, L = scene_wave_length(&s->run->scene);
    double x, back = 0.0, left = 0.0, sum = 0.0, count = 0.0;
    const double a = crest(s, n, eta, is, &x);
    for (int i = 0; i < n; i++)
        if (is[i] > 0.0 && place(s, i) < x - 0.75 * L) {
            back = fmax(back, eta[i]);
            left = fmax(left, fabs(eta[i]));
            sum += eta[i];
            count += 1.0;
        }
    summary_real(to, "error.crest", fabs(a / w->crest - 1.0));
    summary_real(to, "error.place", fabs(x - w->x - w->c * s->t) / H);
    summary_real(to, "error.reflected", back / w->crest);
    summary_real(to, "error.left_behind", left / w->crest);
    summary_real(to, "error.level", count > 0.0 ? fabs(sum) / count / w->crest : 0.0);
}

/* Least squares over the columns: coefficients f[HARMONICS]. Gauss-Jordan elimination of the 5 x 5
 * normal equations. */
static void harmonics(const struct fv *s, int n, const double *eta, const double *is, double *f)
{
    double A[HARMONICS][HARMONICS + 1] = {{0.0}};
    for (int i = 0; i < n; i++) {
        const double a = s->exact.steady.k * place(s, i);
        const double g[HARMONICS] = {1.0, cos(a), sin(a), cos(2.0 * a), sin(2.0 * a)};
        for (int p = 0; p < HARMONICS; p++) {
            for (int q = 0; q < HARMONICS; q++)
                A[p][q] += is[i] * g[p] * g[q];
            A[p][HARMONICS] += is[i] * g[p] * eta[i];
        }
    }
    for (int p = 0; p < HARMONICS; p++) /* positive definite: no pivots */
        for (int i = 0; i < HARMONICS; i++) {
            const double r = i == p ? 0.0 : A[i][p] / A[p][p];
            for (int q = p; q <= HARMONICS; q++)
                A[i][q] -= r * A[p][q];
        }
    for (int p = 0; p < HARMONICS; p++)
        f[p] = A[p][HARMONICS] / A[p][p];
}

/* Compares with the same fit of the exact wave on the same columns, so that gaps in them do not
 * count as errors; free: what neither has, as an amplitude. */
static void regular(struct fv *s, int n, const double *eta, const double *is)
{
    const struct steady *w = &s->exact.steady;
    struct summary *to = s->run->summary;
    double *exact = NEW(double, n), f[HARMONICS], e[HARMONICS], rest = 0.0, count = 0.0;
    for (int i = 0; i < n; i++)
        exact[i] = steady_eta(w, place(s, i), s->t);
    harmonics(s, n, eta, is, f);
    harmonics(s, n, exact, is, e);
    for (int i = 0; i < n; i++) { /* what the five do not hold and the exact wave has not */
        const double a = w->k * place(s, i);
        const double g[HARMONICS] = {1.0, cos(a), sin(a), cos(2.0 * a), sin(2.0 * a)};
        double d = eta[i] - exact[i];
        for (int p = 0; p < HARMONICS; p++)
            d -= (f[p] - e[p]) * g[p];
        rest += is[i] * d * d;
        count += is[i];
    }
    const double a = hypot(e[1], e[2]), lag = atan2(f[2], f[1]) - atan2(e[2], e[1]);
    summary_real(to, "error.amplitude", fabs(hypot(f[1], f[2]) / a - 1.0));
    summary_real(to, "error.phase", fabs(remainder(lag, 2.0 * M_PI)) / (2.0 * M_PI));
    summary_real(to, "error.second", fabs(hypot(f[3], f[4]) / hypot(e[3], e[4]) - 1.0));
    summary_real(to, "error.level", fabs(f[0] - e[0]) / a);
    summary_real(to, "error.free", sqrt(2.0 * rest / fmax(count, 1.0)) / a);
    mem_free(exact);
}

/* Uniform cells and layers alone. */
void steady_summarise(struct fv *s)
{
    double *eta, *is;
    const struct scene *c = &s->run->scene;
    if (!scene_has_steady_wave(c) || !exact_until_end(c) || s->prm.nboxes > 0 || s->m ||
        s->exact.height <= 0.0)
        return;
    const int n = columns(s, &eta, &is);
    (s->exact.field == FIELD_SOLITARY ? solitary : regular)(s, n, eta, is);
    FREE(eta, is);
}
