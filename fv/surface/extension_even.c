/* extension_even.c - windows of uniform cells and of layers of unequal height (extension_window.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "extension_window.h"

#include "../boundary/fv_boundary.h"
#include "levelset.h"

/* Cells of the window (its corner at `corner' from the cell c) that are reached from c over faces
 * within it: water beyond a thin box is none of this cell's. False: no box is near, all are. */
static bool look_past_boxes(const struct fv *s, int64_t c, const int *corner, bool *seen)
{
    const struct block *b = &s->b;
    const int deep = b->dim == 3 ? 5 : 1, n = 25 * deep, width[3] = {1, 5, 25};
    int64_t cell[125];
    int queue[125], head = 0, tail = 0;
    bool near = false;
    for (int m = 0; m < n; m++) {
        cell[m] = c + corner[0] + m % 5 + (corner[1] + m / 5 % 5) * b->stride[1] +
                  (corner[2] + m / 25) * b->stride[2];
        near = near || is_blocked(s, cell[m]);
        seen[m] = cell[m] == c;
        if (seen[m])
            queue[tail++] = m;
    }
    while (near && head < tail) {
        const int m = queue[head++], at[3] = {m % 5, m / 5 % 5, m / 25};
        for (int way = 0; way < 2 * b->dim; way++) {
            const int a = way / 2, to = m + (way % 2 ? width[a] : -width[a]);
            if (way % 2 ? at[a] == 4 : at[a] == 0)
                continue;
            if (!seen[to] && !s->forcing->forced[cell[to]]) {
                seen[to] = true;
                queue[tail++] = to;
            }
        }
    }
    return near;
}

static double mean_size(const struct fv *s, int64_t c)
{
    const double *h = s->b.h, volume = h[0] * h[1] * (s->dim == 3 ? h[2] : 1.0);
    (void)c;
    return s->dim == 2 ? sqrt(volume) : cbrt(volume);
}

static void find_shift(const struct fv *s, struct place *p)
{
    for (int a = 0; a < 3; a++)
        p->shift[a] = a < s->dim ? -(int)lround(p->e[0][a] * 1.2) : 0;
    p->upright = s->gravity.upright;
}

/* The window of a cell whose middle is `shift' away. */
static void look_at(const struct fv *s, int64_t c, int layer, const int *shift, struct place *p)
{
    const struct block *b = &s->b;
    const unsigned char *known = s->surface->layer + c;
    const bool *out = s->surface->closed + c;
    const int reach = window_reach(s, layer), deep = b->dim == 3 ? reach : 0;
    const double per = 1.0 / p->spacing, *y = b->rows ? b->rows->y + block_row(b, c) : NULL;
    int n = 0;
    p->room = 0;
    const int corner[3] = {shift[0] - 2, shift[1] - 2, shift[2] - (b->dim == 3 ? 2 : 0)};
    bool seen[125], *const some = s->blocked && look_past_boxes(s, c, corner, seen) ? seen : NULL;
    for (int k = -deep; k <= deep; k++)
        for (int j = -reach; j <= reach; j++) {
            const int row = 5 * (j + 2 + 5 * (deep ? k + 2 : 0));
            const int step =
                (int)(shift[0] - 2 + (j + shift[1]) * b->stride[1] + (k + shift[2]) * b->stride[2]);
            double x[3], r[3];
            x[0] = (shift[0] - 2) * b->h[0] + p->depth * p->e[0][0];
            x[1] = (y ? y[shift[1] + j] - y[0] : (shift[1] + j) * b->h[1]) + p->depth * p->e[0][1];
            x[2] = deep ? (shift[2] + k) * b->h[2] + p->depth * p->e[0][2] : 0.0;
            for (int a = 0; a < 3; a++)
                r[a] = (x[0] * p->e[a][0] + x[1] * p->e[a][1] + x[2] * p->e[a][2]) * per;
            for (int i = 2 - reach; i <= 2 + reach;
                 i++) { /* kept without a branch: n goes on if it is known */
                const bool there = !out[step + i] && !(some && !some[row + i]);
                p->room += there;
                for (int a = 0; a < 3; a++)
                    p->r[a][n] = r[a] + i * p->e[a][0] * (b->h[0] * per);
                p->step[n] = step + i;
                n += there && known[step + i] < layer;
            }
        }
    window_fill_lanes(p, n);
}

static void look_around(const struct fv *s, int64_t c, int layer, struct place *p)
{
    find_shift(s, p);
    look_at(s, c, layer, p->shift, p);
}

/* All cells are equal, and none is hidden behind a box. */
static bool has_patterns(const struct fv *s)
{
    return !s->b.rows && !s->blocked && s->prm.integrator == INTEGRATOR_RK3;
}

/* Five bytes of a line of cells and three more, side by side. */
static uint64_t bytes_at(const void *p)
{
    uint64_t x;
    memcpy(&x, p, sizeof x);
    return x;
}

/* A bit for each byte that is 1, in some order. */
static uint64_t bits_of(uint64_t ones) { return ones * UINT64_C(0x0102040810204080) >> 56; }

/* Which cells of the window are known, and how the window is moved, as bits: cells alike in that
 * have the same weights. Cells of a line at once: layers are less than 128, and cells that hold
 * nothing are DEEP. */
static struct pattern_key pattern(const struct fv *s, int64_t c, int layer, struct place *p)
{
    const struct block *b = &s->b;
    const unsigned char *known = s->surface->layer + c;
    const bool *out = s->surface->closed + c;
    const int reach = window_reach(s, layer), deep = b->dim == 3 ? reach : 0;
    static const unsigned char wide[8] = {1, 1, 1, 1, 1}, narrow[8] = {0, 1, 1, 1};
    const uint64_t ones = UINT64_C(0x0101010101010101), all = bytes_at(reach == 2 ? wide : narrow),
                   less = ones * (unsigned)(127 + layer);
    struct pattern_key key = {.layer = (signed char)lesser(layer, 3)};
    const int *shift = p->shift;
    int lines = 0;
    find_shift(s, p);
    p->room = p->known = 0;
    for (int k = -deep; k <= deep; k++)
        for (int j = -reach; j <= reach; j++) {
            const int64_t row =
                shift[0] - 2 + (j + shift[1]) * b->stride[1] + (k + shift[2]) * b->stride[2];
            const uint64_t is = (less - bytes_at(known + row)) >> 7 & all;
            p->room += __builtin_popcountll(all & ~bytes_at(out + row));
            p->known += __builtin_popcountll(is);
            key.known[lines / 8] |= bits_of(is) << lines % 8 * 8;
            lines++;
        }
    for (int a = 0; a < 3; a++)
        key.shift[a] = (signed char)shift[a];
    return key;
}

static void look_along_axes(const struct fv *s, int64_t c, int layer, const signed char *shift,
                            struct place *p)
{
    p->depth = 0.0;
    for (int a = 0; a < 3; a++)
        for (int k = 0; k < 3; k++)
            p->e[a][k] = a == k;
    look_at(s, c, layer, (const int[]){shift[0], shift[1], shift[2]}, p);
}

const struct window_ops even_window = {.size = mean_size,
                                       .look_around = look_around,
                                       .has_patterns = has_patterns,
                                       .pattern = pattern,
                                       .look_along_axes = look_along_axes};
