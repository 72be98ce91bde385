/* near_water.c - see near_water.h. Each row of cells has one run of them: first and last of those
 * whose layer is no more than LAYERS, or that hold some water, widened by what stencils reach in
 * all directions. The surface travels less than that between two calls, so that what becomes near
 * is what it was: air. Runs start and end on multiples of eight: sums over rows take the same
 * order. SPDX-License-Identifier: BSD-3-Clause */
#include "near_water.h"

#include <limits.h>

#include "../boundary/fv_boundary.h"
#include "../grid/fv_grid.h"
#include "fraction.h"
#include "levelset.h"

enum { EVEN_ENDS = 8 };

/* Water comes from the water that is there: through no side, and in no cell that is imposed. */
static bool is_wanted(const struct fv *s)
{
    bool closed = !s->m && !(s->forcing && (s->forcing->from_partner || s->forcing->imposed)) &&
                  s->prm.integrator == INTEGRATOR_RK3;
    for (int side = 0; side < 2 * s->dim && closed; side++) {
        const int kind = s->bc ? s->bc->kind[side] : MESH_NONE;
        closed = s->b.periodic[side / 2] || side_is_wall(kind);
    }
    return closed;
}

static int rows_of(const struct part *p, int a) { return p->n[a] + 2 * p->g[a]; }
static int rows_in(const struct part *p) { return rows_of(p, 1) * rows_of(p, 2); }
static size_t bytes_of(const struct part *p) { return (size_t)rows_in(p) * sizeof *p->near; }

static bool is_near(const struct surface *f, int64_t c)
{
    return f->layer[c] != DEEP || (f->fraction && f->fraction->C[c] != 0.0);
}

static bool is_wet(const struct surface *f, int64_t c) { return f->layer[c] == 0; }

/* First cell of each row, ghosts too, that is `wanted', and the one behind the last, with `reach'
 * more on either side. */
static void scan(const struct fv *s, bool (*wanted)(const struct surface *, int64_t), int reach,
                 int (*ends)[2])
{
    const struct part *p = &s->whole;
    for (int k = -p->g[2]; k < p->n[2] + p->g[2]; k++)
        for (int j = -p->g[1]; j < p->n[1] + p->g[1]; j++) {
            const int64_t c = part_at(p, 0, j, k);
            int first = -p->g[0], end = p->n[0] + p->g[0];
            while (first < end && !wanted(s->surface, c + first))
                first++;
            while (end > first && !wanted(s->surface, c + end - 1))
                end--;
            int *e = ends[part_row(p, j, k)];
            e[0] = first < end ? first - reach : INT_MAX;
            e[1] = first < end ? end + reach : INT_MIN;
        }
}

/* Each row has what those within `reach' of it along axis a have. */
static void widen(const struct part *p, int a, int reach, int (*from)[2], int (*to)[2])
{
    const int stride = a == 1 ? 1 : rows_of(p, 1), n = rows_of(p, a), rows = rows_in(p);
    for (int r = 0; r < rows; r++) {
        const int at = r / stride % n, low = at < reach ? -at : -reach,
                  up = n - 1 - at < reach ? n - 1 - at : reach;
        to[r][0] = INT_MAX;
        to[r][1] = INT_MIN;
        for (int m = low; m <= up; m++) {
            const int *e = from[r + m * stride];
            to[r][0] = e[0] < to[r][0] ? e[0] : to[r][0];
            to[r][1] = e[1] > to[r][1] ? e[1] : to[r][1];
        }
    }
}

/* Within the row of n cells, from first cell and end to first cell and number. */
static void round_ends(int n, int e[2])
{
    const int first = e[0] < 0 ? 0 : e[0], end = e[1] > n ? n : e[1];
    if (first >= end) {
        e[0] = e[1] = 0;
        return;
    }
    e[0] = first / EVEN_ENDS * EVEN_ENDS;
    e[1] = (end + EVEN_ENDS - 1) / EVEN_ENDS * EVEN_ENDS;
    e[1] = (e[1] > n ? n : e[1]) - e[0];
}

static void leave_shares(struct fraction *f, int64_t c)
{
    f->C[c] = f->flux[c] = f->work[c] = f->next[c] = 0.0;
    f->layer[c] = DEEP;
}

/* What no one looks after any more: air, farther off than a band is wide. Fields that are cleared
 * near water alone, and read beside it, too, are 0 there. */
static void leave(struct fv *s, int64_t c)
{
    struct surface *f = s->surface;
    const double far = f->least * (BAND_WIDTH - 1);
    f->layer[c] = DEEP;
    f->phi[c] = fmax(f->phi[c], far);
    f->stress[c] = s->p[c] = s->p_before[c] = 0.0;
    for (int a = 0; a < s->dim; a++)
        s->u[a][c] = s->U[a][c] = s->rhs[a][c] = f->open[a][c] = 0.0;
    for (int k = 0; k < 3; k++)
        if (s->stages.psi[k])
            s->stages.psi[k][c] = 0.0;
    if (f->fraction)
        leave_shares(f->fraction, c);
}

static void leave_row(struct fv *s, int j, int k, const int old[2], const int now[2])
{
    int was[2], is[2];
    part_with_ghosts(&s->whole, old, was);
    part_with_ghosts(&s->whole, now, is);
    for (int i = was[0]; i < was[1]; i++)
        if (i < is[0] || i >= is[1])
            leave(s, part_at(&s->whole, i, j, k));
}

/* From these rows to those, and clears what is in the former alone. Cells that leave are cleared
 * before the rows are taken over, for afterwards no loop meets them. */
static void change(struct fv *s, int (*now)[2])
{
    const struct part *p = &s->whole;
    for (int k = -p->g[2]; k < p->n[2] + p->g[2]; k++)
        for (int j = -p->g[1]; j < p->n[1] + p->g[1]; j++)
            leave_row(s, j, k, p->near[part_row(p, j, k)], now[part_row(p, j, k)]);
    memcpy(p->near, now, bytes_of(p));
}

static int (*make_rows(const struct part *p))[2]
{
    int(*near)[2] = (int(*)[2])NEW(int, 2 * rows_in(p));
    for (int r = 0; r < rows_in(p); r++)
        near[r][1] = p->n[0];
    return near;
}

/* Rows of what is wanted, `reach' cells more in all directions. */
static void find(const struct fv *s, bool (*wanted)(const struct surface *, int64_t), int reach,
                 int (*rows)[2])
{
    const struct part *p = &s->whole;
    int(*work)[2] = make_rows(p);
    scan(s, wanted, reach, rows);
    widen(p, 1, reach, rows, work);
    if (s->dim == 3)
        widen(p, 2, reach, work, rows);
    else
        memcpy(rows, work, bytes_of(p));
    for (int r = 0; r < rows_in(p); r++)
        round_ends(p->n[0], rows[r]);
    mem_free(work);
}

/* Collective with the layers. Where it is not wanted all loops go over whole rows. */
void near_water_find(struct fv *s)
{
    struct part *p = &s->whole;
    if (!is_wanted(s))
        return;
    int(*now)[2] = make_rows(p);
    if (!p->near)
        p->near = mem_own(s, make_rows(p));
    if (!p->wet)
        p->wet = mem_own(s, make_rows(p));
    find(s, is_near, GHOSTS, now);
    change(s, now);
    find(s, is_wet, 1, p->wet);
    mem_free(now);
}

/* The rows at the start of a step, for one that is taken back. */
void near_water_keep(struct fv *s)
{
    int(**kept)[2] = &s->surface->near_before;
    if (!s->whole.near) {
        DROP(*kept);
        return;
    }
    if (!*kept)
        *kept = mem_own(s->surface, make_rows(&s->whole));
    memcpy(*kept, s->whole.near, bytes_of(&s->whole));
}

void near_water_back(struct fv *s)
{
    if (s->whole.near && s->surface->near_before) {
        change(s, s->surface->near_before);
    } else {
        DROP(s->whole.near);
        DROP(s->whole.wet);
    }
}
