/* marks.c - a region of marked cells: dilation by cells, and the distance to its edge. Used by
 * criteria.c. All operations go axis by axis over the whole grid (O(cells)), the distance of one
 * position looks at the cells at most two off: depth[], found beforehand by peeling layers, tells
 * when no more is needed.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "marks.h"

#include "../../common/base/base.h"

/* The number of cells along an axis is the largest at which they are at least `width' wide; 1e-12
 * keeps a length that is a multiple of it from losing one to rounding. */
bool marks_create(void *owner, struct marks *c, int dim, const double lo[3], const double hi[3],
                  const bool periodic[3], const bool open[6], double width, double most)
{
    double all = 1.0;
    *c = (struct marks){.dim = dim};
    for (int a = 0; a < 3; a++) {
        const double length = a < dim ? hi[a] - lo[a] : 1.0;
        const double n = a < dim ? fmax(floor(length / width * (1.0 + 1e-12)), 1.0) : 1.0;
        all *= n;
        if (all > most)
            return false;
        c->n[a] = (int)n;
        c->lo[a] = a < dim ? lo[a] : 0.0;
        c->h[a] = length / n;
        c->periodic[a] = a < dim && periodic[a];
    }
    memcpy(c->open, open, sizeof c->open);
    c->mark = NEW_IN(owner, unsigned char, all);
    c->depth = NEW_IN(owner, signed char, all);
    marks_measure(c);
    return true;
}

size_t marks_count(const struct marks *c)
{
    return (size_t)c->n[0] * (size_t)c->n[1] * (size_t)c->n[2];
}

/* Number of the cell with these indices. */
static size_t number(const struct marks *c, const int *at)
{
    return (size_t)at[0] + (size_t)c->n[0] * ((size_t)at[1] + (size_t)c->n[1] * (size_t)at[2]);
}

/* Indices of the cell that holds x, clamped into the grid. */
static void place(const struct marks *c, const double *x, int *at)
{
    for (int a = 0; a < 3; a++) {
        const double i = a < c->dim ? floor((x[a] - c->lo[a]) / c->h[a]) : 0.0;
        at[a] = i < 0.0 ? 0 : i >= c->n[a] ? c->n[a] - 1 : (int)i;
    }
}

size_t marks_find(const struct marks *c, const double *x)
{
    int at[3];
    place(c, x, at);
    return number(c, at);
}

/* --- one axis at a time --- */

/* Cells along an axis: `stride' apart, n of them, from each of `lines' places. */
struct sweep {
    int axis, n;
    size_t stride, lines;
};

/* How to run through all lines of cells along an axis. */
static struct sweep sweep_of(const struct marks *c, int axis)
{
    struct sweep s = {.axis = axis, .n = c->n[axis], .stride = 1};
    for (int a = 0; a < axis; a++)
        s.stride *= (size_t)c->n[a];
    s.lines = marks_count(c) / (size_t)s.n;
    return s;
}

/* Number of the first cell of a line; lines are counted over the other axes in the order of the
 * cells. */
static size_t first_of(const struct sweep *s, size_t line)
{
    return line / s->stride * s->stride * (size_t)s->n + line % s->stride;
}

/* The mark next to cell i of a line; beyond an end that of the cell itself, 0, or the other end's.
 */
static unsigned char beside(const struct marks *c, const struct sweep *s, const unsigned char *line,
                            int i, int step)
{
    const int j = i + step;
    if (j >= 0 && j < s->n)
        return line[j];
    if (c->periodic[s->axis])
        return line[(j + s->n) % s->n];
    return c->open[2 * s->axis + (step > 0)] ? 0 : line[i];
}

/* Grows marks by one cell (or, grow = false, what is not marked) along one axis. A copy of the line
 * is read, so that marks do not run along it. */
static void step_axis(const struct marks *c, unsigned char *bits, int axis, bool grow)
{
    const struct sweep s = sweep_of(c, axis);
    unsigned char *line = NEW(unsigned char, s.n);
    for (size_t l = 0; l < s.lines; l++) {
        const size_t first = first_of(&s, l);
        for (int i = 0; i < s.n; i++)
            line[i] = bits[first + (size_t)i * s.stride];
        for (int i = 0; i < s.n; i++) {
            const unsigned char low = beside(c, &s, line, i, -1), high = beside(c, &s, line, i, 1);
            bits[first + (size_t)i * s.stride] = grow ? line[i] | low | high : line[i] & low & high;
        }
    }
    mem_free(line);
}

/* One cell in all directions: after one axis the next one carries on what has grown, hence
 * diagonals. */
static void step_all(const struct marks *c, unsigned char *bits, bool grow)
{
    for (int a = 0; a < c->dim; a++)
        step_axis(c, bits, a, grow);
}

void marks_dilate(const struct marks *c, unsigned char *bits, int by)
{
    for (int k = 0; k < by; k++)
        step_all(c, bits, true);
}

/* First and last cell of c that cell i of `fine' meets along an axis. */
static void meets(const struct marks *c, const struct marks *fine, int axis, int i, int *first,
                  int *last)
{
    const double near = 1e-6 * fine->h[axis];
    const double lo = i * fine->h[axis] + near, hi = (i + 1) * fine->h[axis] - near;
    *first = (int)fmax(floor(lo / c->h[axis]), 0.0);
    *last = (int)fmin(floor(hi / c->h[axis]), c->n[axis] - 1);
}

/* Cells of both grids start at the same corner, but their widths are no multiples of each other. */
void marks_cover(struct marks *c, const struct marks *fine, int by)
{
    unsigned char *bits = NEW(unsigned char, marks_count(c));
    int at[3], first[3], last[3], i[3];
    size_t cell = 0;
    for (at[2] = 0; at[2] < fine->n[2]; at[2]++)
        for (at[1] = 0; at[1] < fine->n[1]; at[1]++)
            for (at[0] = 0; at[0] < fine->n[0]; at[0]++) {
                if (!fine->mark[cell++])
                    continue;
                for (int a = 0; a < 3; a++)
                    meets(c, fine, a, at[a], first + a, last + a);
                for (i[2] = first[2]; i[2] <= last[2]; i[2]++)
                    for (i[1] = first[1]; i[1] <= last[1]; i[1]++)
                        for (i[0] = first[0]; i[0] <= last[0]; i[0]++)
                            bits[number(c, i)] = 1;
            }
    marks_dilate(c, bits, by);
    for (size_t k = 0; k < marks_count(c); k++)
        c->mark[k] |= bits[k];
    mem_free(bits);
}

/* --- distance --- */

/* depth: 1 for marked cells, plus one for each of the MARKS_DEEP - 1 layers that can be peeled off
 * before the cell goes; -1 and -2 for others, beside a marked one or not. */
void marks_measure(struct marks *c)
{
    const size_t n = marks_count(c);
    unsigned char *inner = NEW(unsigned char, n), *outer = NEW(unsigned char, n);
    c->any = false;
    memcpy(inner, c->mark, n);
    memcpy(outer, c->mark, n);
    marks_dilate(c, outer, 1);
    for (size_t k = 0; k < n; k++) {
        c->depth[k] = (signed char)(c->mark[k] ? 1 : outer[k] ? -1 : -2);
        c->any = c->any || c->mark[k];
    }
    for (int d = 2; d <= MARKS_DEEP; d++) {
        step_all(c, inner, false);
        for (size_t k = 0; k < n; k++)
            c->depth[k] = (signed char)(c->depth[k] + inner[k]);
    }
    FREE(inner, outer);
}

/* The cells at most two off along an axis, in the order of their distance from the middle one:
 * squared distance of x from them, and what stands for them in the grid; -1: no marks there. */
enum { NEAR = 5 };
struct marks_row {
    double d2[NEAR];
    int at[NEAR];
};

/* home is the cell of x; beyond a closed end the last cell's mark continues, beyond an open one
 * nothing is marked. */
static struct marks_row row_of(const struct marks *c, int a, int home, double x)
{
    static const int step[NEAR] = {0, -1, 1, -2, 2};
    struct marks_row r;
    const double h = c->h[a], in = x - c->lo[a] - home * h;
    for (int k = 0; k < NEAR; k++) {
        const double off = step[k] > 0   ? step[k] * h - in
                           : step[k] < 0 ? in - (step[k] + 1) * h
                                         : 0;
        int i = home + step[k];
        if (i < 0 || i >= c->n[a]) {
            if (c->periodic[a])
                i = ((i % c->n[a]) + c->n[a]) % c->n[a];
            else
                i = c->open[2 * a + (i >= 0)] ? -1 : i < 0 ? 0 : c->n[a] - 1;
        }
        r.at[k] = i;
        r.d2[k] = off > 0.0 ? off * off : 0.0;
    }
    return r;
}

/* Least distance of x, in cell `home', from cells with this mark; found at most two cells off. Runs
 * through up to 5^dim cells, nearest first along each axis, and stops where nothing nearer can
 * come. */
static double nearest(const struct marks *c, const int *home, const double *x, bool mark)
{
    const bool solid = c->dim == 3;
    struct marks_row r[3] = {row_of(c, 0, home[0], x[0]), row_of(c, 1, home[1], x[1])};
    if (solid)
        r[2] = row_of(c, 2, home[2], x[2]);
    double best = INFINITY;
    for (int k = 0; k < (solid ? NEAR : 1); k++)
        for (int j = 0; j < NEAR; j++) {
            const double d2 = r[1].d2[j] + (solid ? r[2].d2[k] : 0.0);
            for (int i = 0; i < NEAR && d2 < best; i++) {
                const int at[3] = {r[0].at[i], r[1].at[j], solid ? r[2].at[k] : 0};
                if (d2 + r[0].d2[i] >= best)
                    continue;
                const bool there = at[0] >= 0 && at[1] >= 0 && at[2] >= 0;
                if ((there && c->mark[number(c, at)]) == mark)
                    best = d2 + r[0].d2[i];
            }
        }
    return sqrt(best);
}

/* Least distance of x to the faces of its cell. */
static double to_face(const struct marks *c, const int *home, const double *x)
{
    double d = INFINITY;
    for (int a = 0; a < c->dim; a++) {
        const double lo = c->lo[a] + home[a] * c->h[a];
        const double low = x[a] - lo, high = lo + c->h[a] - x[a], least = low < high ? low : high;
        d = least < d ? least : d;
    }
    return d > 0.0 ? d : 0.0;
}

/* Cells with depth 1 and -1 are searched; with depth 2 the search may miss what is beyond two
 * cells, so that it is bounded by 2 h plus the way out of the cell; deeper cells get the lower
 * bound (depth - 1) h plus that way. */
double marks_distance(const struct marks *c, const double *x)
{
    if (!c->any)
        return -INFINITY;
    int home[3];
    place(c, x, home);
    const int depth = c->depth[number(c, home)];
    const double h = fmin(fmin(c->h[0], c->h[1]), c->dim == 3 ? c->h[2] : INFINITY);
    switch (depth) {
    case 1:
        return nearest(c, home, x, false);
    case 2: /* levels take over from each other a cell deep */
        return fmin(nearest(c, home, x, false), 2.0 * h + to_face(c, home, x));
    case -1:
        return -nearest(c, home, x, true);
    default:
        return (depth > 0 ? depth - 1 : -1) * h + (depth > 0 ? 1.0 : -1.0) * to_face(c, home, x);
    }
}
