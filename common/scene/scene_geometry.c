/* scene_geometry.c - see scene_geometry.h. Every test is relative to the size of the lines, so that
 * it holds for millimetres and kilometres alike. SPDX-License-Identifier: BSD-3-Clause */
#include "scene_geometry.h"

#include "../geometry/geometry.h"

/* Lengths below this part of a line's size are rounding. */
static const double rounding = 1e-9;

struct line line_of(const struct param_points *p, bool closed)
{
    return (struct line){p->n, p->x, closed};
}

int line_segments(const struct line *l) { return l->closed ? l->n : l->n - 1; }

/* Ends of segment k; that of the last one of a closed line is the first point. */
static const double *start_of(const struct line *l, int k) { return l->x[k]; }
static const double *end_of(const struct line *l, int k) { return l->x[(k + 1) % l->n]; }

double line_area(const struct line *l)
{
    double sum = 0.0;
    for (int k = 0; k < l->n; k++) { /* about the first point: no loss far from the origin */
        const double *a = start_of(l, k), *b = end_of(l, k), *o = l->x[0];
        sum += (a[0] - o[0]) * (b[1] - o[1]) - (b[0] - o[0]) * (a[1] - o[1]);
    }
    return 0.5 * sum;
}

/* Green's theorem, side by side (Eberly 2002), about the first point. */
void line_moments(const struct line *l, double *area, double centre[2], double *polar)
{
    double A = 0.0, C[2] = {0.0, 0.0}, J = 0.0;
    const double *o = l->x[0];
    for (int k = 0; k < l->n; k++) {
        const double a[2] = {start_of(l, k)[0] - o[0], start_of(l, k)[1] - o[1]};
        const double b[2] = {end_of(l, k)[0] - o[0], end_of(l, k)[1] - o[1]};
        const double cross = a[0] * b[1] - a[1] * b[0];
        A += 0.5 * cross;
        for (int i = 0; i < 2; i++) {
            C[i] += cross * (a[i] + b[i]) / 6.0;
            J += cross * (a[i] * a[i] + a[i] * b[i] + b[i] * b[i]) / 12.0;
        }
    }
    *area = fabs(A);
    *polar = fabs(J) - (C[0] * C[0] + C[1] * C[1]) / fabs(A);
    for (int i = 0; i < 2; i++)
        centre[i] = o[i] + C[i] / A;
}

double line_length(const struct line *l)
{
    double sum = 0.0;
    for (int k = 0; k < line_segments(l); k++)
        sum += hypot(end_of(l, k)[0] - start_of(l, k)[0], end_of(l, k)[1] - start_of(l, k)[1]);
    return sum;
}

double line_size(const struct line *l)
{
    double lo[2], hi[2];
    outline_bounds(l->n, l->x, lo, hi);
    return fmax(hi[0] - lo[0], hi[1] - lo[1]);
}

void line_trim(struct line *l)
{
    if (l->n > 3 && hypot(l->x[0][0] - l->x[l->n - 1][0], l->x[0][1] - l->x[l->n - 1][1]) <=
                        rounding * line_size(l)) {
        l->n--;
        l->closed = true;
    }
}

/* By the number of crossings to the right. Half-open intervals along y count a corner once. */
bool line_inside(const struct line *l, const double *x)
{
    bool in = false;
    for (int k = 0; k < l->n; k++) {
        const double *a = start_of(l, k), *b = end_of(l, k);
        if ((a[1] > x[1]) != (b[1] > x[1]) &&
            x[0] < a[0] + (b[0] - a[0]) * (x[1] - a[1]) / (b[1] - a[1]))
            in = !in;
    }
    return in;
}

/* Distance of x to the segment ab. */
static double to_segment(const double *a, const double *b, const double *x)
{
    const double d[2] = {b[0] - a[0], b[1] - a[1]}, e[2] = {x[0] - a[0], x[1] - a[1]};
    const double d2 = d[0] * d[0] + d[1] * d[1];
    const double f = d2 > 0.0 ? fmax(0.0, fmin(1.0, (d[0] * e[0] + d[1] * e[1]) / d2)) : 0.0;
    return hypot(e[0] - f * d[0], e[1] - f * d[1]);
}

double line_distance(const struct line *l, const double *x)
{
    double least = INFINITY;
    for (int k = 0; k < line_segments(l); k++)
        least = fmin(least, to_segment(start_of(l, k), end_of(l, k), x));
    return least;
}

struct line_foot line_foot(const struct line *l, const double *x)
{
    const double same = 1e-9; /* of squares of distances */
    const int n = line_segments(l);
    struct line_foot f = {.distance = INFINITY};
    double least = INFINITY;
    for (int k = 0; k < n; k++) {
        const double *a = start_of(l, k), *b = end_of(l, k);
        const double d[2] = {b[0] - a[0], b[1] - a[1]}, e[2] = {x[0] - a[0], x[1] - a[1]};
        const double d2 = d[0] * d[0] + d[1] * d[1], along = (d[0] * e[0] + d[1] * e[1]) / d2;
        const double z = along < 0.0 ? 0.0 : along > 1.0 ? 1.0 : along;
        const double off[2] = {e[0] - z * d[0], e[1] - z * d[1]};
        const double r2 = off[0] * off[0] + off[1] * off[1];
        if (!(r2 <= least * (1.0 + same))) /* a segment without length has none */
            continue;
        const double aside = (d[0] * e[1] - d[1] * e[0]) / sqrt(d2);
        if (r2 > least * (1.0 - same) && fabs(aside) <= fabs(f.aside))
            continue;
        const bool first = !l->closed && k == 0 && along <= 0.0,
                   last = !l->closed && k == n - 1 && along >= 1.0;
        f = (struct line_foot){.x = {a[0] + z * d[0], a[1] + z * d[1]},
                               .distance = sqrt(r2),
                               .segment = k,
                               .part = z,
                               .aside = aside,
                               .past = first ? -1 : last};
        least = r2;
    }
    return f;
}

/* Twice the area of the triangle abc. */
static double turn(const double *a, const double *b, const double *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* Whether ab and cd cross within both, each with its ends clearly on two sides of the other. */
static bool crosses(const double *a, const double *b, const double *c, const double *d,
                    double at[2])
{
    const double size = fmax(hypot(b[0] - a[0], b[1] - a[1]), hypot(d[0] - c[0], d[1] - c[1]));
    const double least = rounding * size * size;
    const double C = turn(a, b, c), D = turn(a, b, d), A = turn(c, d, a), B = turn(c, d, b);
    if (!((C > least && D < -least) || (C < -least && D > least)) ||
        !((A > least && B < -least) || (A < -least && B > least)))
        return false;
    for (int k = 0; k < 2; k++)
        at[k] = a[k] + (b[k] - a[k]) * A / (A - B);
    return true;
}

/* Distance of two segments and where it is. */
static double between(const double *a, const double *b, const double *c, const double *d,
                      double at[2])
{
    const double *ends[4] = {a, b, c, d};
    double least = INFINITY;
    if (crosses(a, b, c, d, at))
        return 0.0;
    for (int k = 0; k < 4; k++) {
        const double r = k < 2 ? to_segment(c, d, ends[k]) : to_segment(a, b, ends[k]);
        if (r < least) {
            least = r;
            memcpy(at, ends[k], 2 * sizeof *at);
        }
    }
    return least;
}

/* Neighbours that go back over each other. */
static bool folds(const double *a, const double *b, const double *c)
{
    const double d[2] = {b[0] - a[0], b[1] - a[1]}, e[2] = {c[0] - b[0], c[1] - b[1]};
    const double size = hypot(d[0], d[1]) * hypot(e[0], e[1]);
    return fabs(turn(a, b, c)) < 1e-6 * size && d[0] * e[0] + d[1] * e[1] < 0.0;
}

/* A quick no: all pairs of segments are asked. */
static bool boxes_apart(const double *a, const double *b, const double *c, const double *d,
                        double reach)
{
    for (int k = 0; k < 2; k++)
        if (fmin(a[k], b[k]) > fmax(c[k], d[k]) + reach ||
            fmin(c[k], d[k]) > fmax(a[k], b[k]) + reach)
            return true;
    return false;
}

/* Whether all points lie on one straight line, through the first and the one farthest from it. */
static bool is_straight(const struct line *l)
{
    const double *a = l->x[0], *b = a;
    for (int k = 1; k < l->n; k++)
        if (hypot(l->x[k][0] - a[0], l->x[k][1] - a[1]) > hypot(b[0] - a[0], b[1] - a[1]))
            b = l->x[k];
    const double size = hypot(b[0] - a[0], b[1] - a[1]);
    for (int k = 1; k < l->n; k++)
        if (fabs(turn(a, b, l->x[k])) > 1e-6 * size * size)
            return false;
    return true;
}

/* In this order, since each test needs that what is before it holds: lengths other than 0, an area,
 * no folds, then crossings. */
enum line_fault line_check(const struct line *l, double at[2])
{
    const double small = rounding * line_size(l);
    const int n = line_segments(l);
    for (int k = 0; k < n; k++)
        if (hypot(end_of(l, k)[0] - start_of(l, k)[0], end_of(l, k)[1] - start_of(l, k)[1]) <=
            small) {
            memcpy(at, start_of(l, k), 2 * sizeof *at);
            return LINE_REPEATED;
        }
    memcpy(at, l->x[0], 2 * sizeof *at);
    if (l->closed && is_straight(l))
        return LINE_FLAT;
    for (int k = 0; k + (l->closed ? 0 : 1) < n; k++)
        if (folds(start_of(l, k), end_of(l, k), end_of(l, (k + 1) % l->n))) {
            memcpy(at, end_of(l, k), 2 * sizeof *at);
            return LINE_FOLDED;
        }
    for (int k = 0; k < n; k++)
        for (int m = k + 2; m < n; m++)
            if (!(l->closed && k == 0 && m == n - 1) &&
                !boxes_apart(start_of(l, k), end_of(l, k), start_of(l, m), end_of(l, m), small) &&
                between(start_of(l, k), end_of(l, k), start_of(l, m), end_of(l, m), at) <= small)
                return LINE_CROSSED;
    return LINE_SOUND;
}

double line_gap(const struct line *a, const struct line *b, double at[2])
{
    double least = INFINITY, place[2];
    for (int k = 0; k < line_segments(a); k++)
        for (int m = 0; m < line_segments(b); m++) {
            if (boxes_apart(start_of(a, k), end_of(a, k), start_of(b, m), end_of(b, m), least))
                continue;
            const double r =
                between(start_of(a, k), end_of(a, k), start_of(b, m), end_of(b, m), place);
            if (r < least) {
                least = r;
                memcpy(at, place, sizeof place);
            }
        }
    return least;
}

bool line_pierces(const struct line *a, const struct line *b, double at[2])
{
    for (int k = 0; k < line_segments(a); k++)
        for (int m = 0; m < line_segments(b); m++)
            if (!boxes_apart(start_of(a, k), end_of(a, k), start_of(b, m), end_of(b, m), 0.0) &&
                crosses(start_of(a, k), end_of(a, k), start_of(b, m), end_of(b, m), at))
                return true;
    return false;
}

/* A point of a's inside beside the middle of each of its sides, looked for in b: finds equal lines
 * and lines that share sides, too. */
static bool reaches_into(const struct line *a, const struct line *b, double at[2])
{
    const double in = (line_area(a) > 0.0 ? 1e-6 : -1e-6) * line_size(a);
    for (int k = 0; k < a->n; k++) {
        const double *p = start_of(a, k), *q = end_of(a, k);
        const double length = hypot(q[0] - p[0], q[1] - p[1]);
        const double x[2] = {0.5 * (p[0] + q[0]) - in * (q[1] - p[1]) / length,
                             0.5 * (p[1] + q[1]) + in * (q[0] - p[0]) / length};
        if (line_inside(b, x) && line_distance(b, x) > 0.5 * fabs(in)) {
            memcpy(at, x, sizeof x);
            return true;
        }
    }
    return false;
}

bool line_overlaps(const struct line *a, const struct line *b, double at[2])
{
    return line_pierces(a, b, at) || reaches_into(a, b, at) || reaches_into(b, a, at);
}

void points_reverse(struct param_points *p)
{
    for (int k = 0, m = p->n - 1; k < m; k++, m--) {
        const double x[2] = {p->x[k][0], p->x[k][1]};
        memcpy(p->x[k], p->x[m], sizeof x);
        memcpy(p->x[m], x, sizeof x);
    }
}
