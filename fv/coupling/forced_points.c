/* forced_points.c - where a partner is asked for the values of FV's cells. A cell of length L along
 * an axis that is larger than the kernel's cell h is asked at n = ceil(L/h) positions, `apart' from
 * each other so that their mean, each seen through a kernel of second moment h^2/12, has the second
 * moment L^2/12 of the cell's average. Made anew when the list of imposed cells changes.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "forced_points.h"

#include "../grid/fv_grid.h"

enum { MOST = 8 }; /* points of a cell along an axis */

/* Number of positions along an axis of a cell of this length, at most MOST; *apart: distance of
 * neighbours, in cells. */
static int divide(double length, double h, double *apart)
{
    const int n = (int)fmin(ceil(length / h * (1.0 - 1e-6)), MOST);
    *apart = n > 1 ? sqrt((1.0 - h * h / (length * length)) / (n * n - 1.0)) : 0.0;
    return n > 1 ? n : 1;
}

/* Positions of cell i of the list: their number; x: filled, or NULL. */
static int points_of(const struct fv *s, int64_t i, double h, double *x)
{
    const int64_t c = s->forcing->partner[i];
    int at[3], n[3] = {1, 1, 1};
    double length[3], apart[3] = {0.0, 0.0, 0.0};
    const struct part *p = grid_part(&s->grid, c, at);
    grid_lengths(&s->grid, p, at, length);
    for (int a = 0; a < s->dim; a++)
        if (s->m ? s->partners.past[0][0] != NULL : a == 1 && s->b.rows)
            n[a] = divide(length[a], h, apart + a);
    const int all = n[0] * n[1] * n[2];
    if (x && all == 1)
        grid_place(&s->grid, c, x);
    for (int k = 0; x && all > 1 && k < all; k++) {
        const int of[3] = {k % n[0], k / n[0] % n[1], k / n[0] / n[1]};
        double xi[3];
        for (int a = 0; a < 3; a++)
            xi[a] = 0.5 + (of[a] - 0.5 * (n[a] - 1)) * apart[a];
        grid_point(&s->grid, p, at, xi, x + 3 * k);
    }
    return all;
}

/* ids are the cell's number in the whole grid times MOST^3, so that they are unique and do not
 * depend on the ranks. */
struct forced_points forced_points_create(const struct fv *s, void *owner, double h)
{
    const struct forcing *f = s->forcing;
    struct forced_points p = {.ncells = f->npartner + f->nrim};
    p.first = NEW_IN(owner, int64_t, p.ncells + 1);
    for (int64_t i = 0; i < p.ncells; i++)
        p.first[i + 1] = p.first[i] + points_of(s, i, h, NULL);
    p.n = p.first[p.ncells];
    p.x = NEW_IN(owner, double, 3 * p.n);
    p.id = NEW_IN(owner, int64_t, p.n);
    for (int64_t i = 0; i < p.ncells; i++) {
        points_of(s, i, h, p.x + 3 * p.first[i]);
        const int64_t number = grid_number(&s->grid, f->partner[i]);
        for (int64_t k = p.first[i]; k < p.first[i + 1]; k++)
            p.id[k] = number * MOST * MOST * MOST + (k - p.first[i]);
    }
    return p;
}

/* A cell has a value if any of its positions has one. */
void forced_points_mean(const struct forced_points *p, int ncomp, const double *v,
                        const unsigned char *mask, double *to, unsigned char *has)
{
    memset(has, 0, (size_t)p->ncells);
    for (int64_t i = 0; i < p->ncells; i++) {
        double n = 0.0;
        for (int64_t k = p->first[i]; k < p->first[i + 1]; k++)
            n += mask[k] ? 1.0 : 0.0;
        if (n == 0.0)
            continue;
        has[i] = 1;
        for (int a = 0; a < ncomp; a++) {
            double sum = 0.0;
            for (int64_t k = p->first[i]; k < p->first[i + 1]; k++)
                sum += mask[k] ? v[ncomp * k + a] : 0.0;
            to[ncomp * i + a] = sum / n;
        }
    }
}
