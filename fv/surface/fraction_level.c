/* fraction_level.c - phi from the shares of water: the plane through a cell that has phi's slopes
 * and the cell's share gives phi of its centre. fraction_correct_level draws phi there after the
 * shares have been carried: all of the way where phi is smooth around (is_trusted), in part
 * elsewhere; fraction_is_calm tells whether phi alone would do. Called by surface_steps.c.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "fraction.h"

#include "levelset.h"
#include "mesh_view.h"
#include "plane.h"

/* |grad phi|^2 of slopes n over a cell. */
static double slope2(const struct fv *s, int64_t c, const double *n)
{
    const struct fraction *f = s->surface->fraction;
    double g[3], sum = 0.0;
    for (int a = 0; a < s->dim; a++) {
        g[a] = n[a] / fraction_height(s, c, a);
        sum += g[a] * g[a];
    }
    for (int a = 1; a < s->dim && f->cosine[0][1]; a++)
        for (int b = 0; b < a; b++)
            sum += f->cosine[b][a][c] * 2.0 * g[a] * g[b];
    return sum;
}

/* Whether phi bends little at a cell and is a distance. Ghosts behind walls mirror phi, which says
 * nothing: there the side towards the fluid alone counts. */
static bool is_smooth(const struct fv *s, const struct part *p, int64_t c)
{
    const double *q = s->surface->phi + c;
    double n[3] = {0.0, 0.0, 0.0};
    for (int a = 0; a < s->dim; a++) {
        const int64_t d = p->stride[a];
        const bool down = !surface_holds_none(s, c - d), up = !surface_holds_none(s, c + d);
        if (up && down && fabs(q[d] - 2.0 * q[0] + q[-d]) > 0.3 * fraction_height(s, c, a))
            return false;
        n[a] = (up ? q[d] - q[0] : 0.0) + (down ? q[0] - q[-d] : 0.0);
        n[a] /= up + down > 0 ? up + down : 1;
    }
    const double sum = slope2(s, c, n);
    return sum > 0.6 && sum < 1.6;
}

/* With one layer of ghosts, so that is_trusted can look around every own cell. */
static void find_smooth(const struct fv *s)
{
    struct fraction *f = s->surface->fraction;
    const double band = 4.0 * s->surface->largest;
    int more[3];
    for (int a = 0; a < 3; a++)
        more[a] = a < s->dim;
    for (const struct part *p = s->grid.part; p < s->grid.part + s->grid.nparts; p++)
        PART_NEAR (p, more, more, c, n)
            for (int64_t i = c; i < c + n; i++)
                f->smooth[i] = surface_holds_none(s, i) ||
                               (fabs(s->surface->phi[i]) < band && is_smooth(s, p, i));
}

/* Whether phi is smooth in the cell and in all around it, corners too. */
static bool is_trusted(const struct fv *s, const struct part *p, int64_t c)
{
    const unsigned char *smooth = s->surface->fraction->smooth;
    const int deep = s->dim == 3;
    for (int k = -deep; k <= deep; k++)
        for (int j = -1; j <= 1; j++)
            for (int i = -1; i <= 1; i++)
                if (!smooth[c + i + j * p->stride[1] + k * p->stride[2]])
                    return false;
    return true;
}

/* Slopes over cell c of a distance from the plane in it: phi's own, or by the shares around; false:
 * they have none. */
static bool slopes_of(const struct fv *s, const struct part *p, int64_t c, bool trusted, double *n)
{
    if (trusted) {
        surface_slopes(s, p, c, n);
        return true;
    }
    if (!fraction_normal(s, p, c, n))
        return false;
    const double size = 1.0 / sqrt(slope2(s, c, n));
    for (int a = 0; a < s->dim; a++)
        n[a] *= size;
    return true;
}

/* What a cell that is water or air by phi may miss or hold: the projection's tolerance leaves as
 * much here and there, deep in the water, too, where a surface that touches such a cell would be a
 * hole from nothing, and grow. */
#define NOTHING 1e-3

/* Where phi of a cell wants to be: pure cells are no nearer the surface than half of their size;
 * far from it a cell that is water by more than half makes a drop, one that is not a bubble. */
static double wanted(const struct fv *s, const struct part *p, int64_t c, bool trusted)
{
    const double C = s->surface->fraction->C[c], phi = s->surface->phi[c];
    double n[3] = {0.0, 0.0, 0.0}, h = 0.0, size = 0.0;
    for (int a = 0; a < s->dim; a++)
        h = greater(h, fraction_height(s, c, a));
    if (fabs(phi) > 2.0 * h)
        return (C > 0.5) != (phi < 0.0) ? (0.5 - C) * h : phi;
    if (!slopes_of(s, p, c, trusted, n)) /* amid water, or air, alone */
        return (C > 0.5) == (phi < 0.0) && fabs(phi) > 0.5 * h ? phi : (0.5 - C) * h;
    for (int a = 0; a < s->dim; a++)
        size += 0.5 * fabs(n[a]);
    if (fabs(phi) >= size && fabs(C - (phi < 0.0)) < NOTHING)
        return phi;
    if (C <= 0.0)
        return greater(phi, size);
    if (C >= 1.0)
        return lesser(phi, -size);
    return -plane_alpha(s->dim, n, C);
}

/* How far phi goes there at once: all of the way where it is trusted; elsewhere a drop or film
 * would come and go from step to step. */
#define TRUSTED 1.0
#define DOUBTED 0.6

void fraction_correct_level(struct fv *s)
{
    struct surface *w = s->surface;
    struct fraction *f = w->fraction;
    const double band = 2.0 * w->largest;
    find_smooth(s);
    grid_copy_near(&s->grid, w->phi, f->next);
    FLOW_NEAR_AT (s, part, j, c, n)
        for (int64_t i = c; i < c + n; i++) {
            const bool mixed = fraction_is_mixed(f->C[i]);
            if ((!mixed && fabs(w->phi[i]) > band) || surface_holds_none(s, i))
                continue;
            const bool trusted = is_trusted(s, part, i);
            f->next[i] += (trusted ? TRUSTED : DOUBTED) * (wanted(s, part, i, trusted) - w->phi[i]);
        }
    grid_copy_near(&s->grid, f->next, w->phi);
    surface_ghosts(s, w->phi);
}

/* Whether the surface passes within a cell and a half of cell c, counted across itself: phi is a
 * distance in a band of the cells' least size alone. */
static bool is_beside(const struct fv *s, const struct part *p, int64_t c)
{
    double n[3], across = 0.0, least = INFINITY;
    surface_slopes(s, p, c, n);
    for (int a = 0; a < s->dim; a++) {
        across += fabs(n[a]);
        least = lesser(least, fraction_height(s, c, a));
    }
    return fabs(s->surface->phi[c]) <= 1.5 * greater(across, least);
}

/* Whether the cells beside the surface are calm: each by itself, or with those around it. */
static bool are_calm(const struct fv *s, bool around)
{
    const struct surface *w = s->surface;
    const struct fraction *f = w->fraction;
    const double band = 1.5 * w->largest * sqrt(s->dim);
    bool calm = true;
    FLOW_NEAR_AT (s, part, j, c, n)
        for (int64_t i = c; i < c + n && calm; i++) {
            const bool mixed = f->carries && f->C[i] > NOTHING && f->C[i] < 1.0 - NOTHING;
            if (surface_holds_none(s, i) ||
                (!mixed && (fabs(w->phi[i]) > band || !is_beside(s, part, i))))
                continue;
            calm = around ? is_trusted(s, part, i) &&
                                (!mixed || fabs(f->C[i] - surface_share(s, i)) < 0.1)
                          : is_smooth(s, part, i);
        }
    return calm;
}

bool fraction_is_calm(const struct fv *s)
{
    bool calm = are_calm(s, false); /* rough water shows at once */
    if (calm) {
        find_smooth(s);
        calm = are_calm(s, true);
    }
    return ranks_all(s->comm, calm);
}
