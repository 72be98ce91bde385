/* forcing.c - see forcing.h. SPDX-License-Identifier: BSD-3-Clause */
#include "forcing.h"

#include <math.h>
#include <string.h>

#include "../../common/mem.h"
#include "bc.h"
#include "blocked.h"

/* Visits all cells with their ghosts. */
#define ALL_CELLS(b, i, j, k)                                                                      \
    for (int k = -(b)->g[2]; k < (b)->n[2] + (b)->g[2]; k++)                                       \
        for (int j = -(b)->g[1]; j < (b)->n[1] + (b)->g[1]; j++)                                   \
            for (int i = -(b)->g[0]; i < (b)->n[0] + (b)->g[0]; i++)

static bool is_local(const struct block *b, const int *at)
{
    for (int a = 0; a < 3; a++)
        if (at[a] < 0 || at[a] >= b->n[a])
            return false;
    return true;
}

/* 1: inside the box, 2: behind a closed side, 0: free. */
static unsigned char kind_of(const struct block *b, const int *at, const double *lo,
                             const double *hi)
{
    bool inside = true;
    for (int a = 0; a < b->dim; a++) {
        int i = b->lo[a] + at[a];
        if (!b->periodic[a] && (i < 0 || i >= b->cells[a]))
            return 2;
        i = ((i % b->cells[a]) + b->cells[a]) % b->cells[a];
        const double h = block_size(b, a, at[a]), eps = 1e-9 * h,
                     x = a == 1 && b->rows ? b->rows->y[at[1]] - 0.5 * h : b->origin[a] + i * h;
        inside = inside && x >= lo[a] - eps && x + h <= hi[a] + eps;
    }
    return inside;
}

static int64_t count_kind(const struct fv *s, struct forcing *f, const double *lo, const double *hi)
{
    const struct block *b = &s->b;
    int64_t forced = 0, free_cells = 0;
    ALL_CELLS (b, i, j, k) {
        const int at[3] = {i, j, k};
        const int64_t c = block_at(b, i, j, k);
        f->forced[c] = kind_of(b, at, lo, hi);
        if (f->forced[c] != 2 && is_blocked(s, c))
            f->forced[c] = 3;
        forced += f->forced[c] != 0;
        free_cells += !f->forced[c] && is_local(b, at);
    }
    MPI_Allreduce(&free_cells, &f->free_cells, 1, MPI_INT64_T, MPI_SUM, b->cart);
    MPI_Allreduce(MPI_IN_PLACE, &forced, 1, MPI_INT64_T, MPI_SUM, b->cart);
    return forced;
}

/* Layers by spreading from the free cells over faces and corners; halo by way of a field. */
static void find_layers(const struct fv *s, struct forcing *f)
{
    const struct block *b = &s->b;
    double *field = block_field(b), *const fields[1] = {field};
    for (int64_t c = 0; c < b->size; c++)
        field[c] = f->forced[c] ? 99.0 : 0.0;
    for (int layer = 1; layer <= NEAR; layer++) {
        ALL_CELLS (b, i, j, k) {
            const int64_t c = block_at(b, i, j, k);
            if (field[c] < 99.0)
                continue;
            for (int dk = -(b->g[2] > 0); dk <= (b->g[2] > 0); dk++)
                for (int dj = -1; dj <= 1; dj++)
                    for (int di = -1; di <= 1; di++) {
                        const int at[3] = {i + di, j + dj, k + dk};
                        bool there = true;
                        for (int a = 0; a < 3; a++)
                            there = there && at[a] >= -b->g[a] && at[a] < b->n[a] + b->g[a];
                        if (there && field[block_at(b, at[0], at[1], at[2])] == layer - 1.0)
                            field[c] = layer;
                    }
        }
        block_halo(b, 1, fields);
    }
    for (int64_t c = 0; c < b->size; c++)
        f->layer[c] = field[c] < 99.0 ? (unsigned char)field[c] : 0;
    mem_free(field);
}

/* Behind a wall or an opening: bc.c gives the values. */
static bool has_bc(const struct fv *s, const int *at)
{
    return bc_behind(s, at, 0) || bc_behind(s, at, 1) || bc_behind(s, at, 2);
}

/* Whether a free cell has a cell of the hole within two cells along an axis. */
static bool is_rim(const struct block *b, const struct forcing *f, int64_t c)
{
    bool rim = false;
    for (int a = 0; a < b->dim; a++)
        for (int m = -2; m <= 2; m++)
            rim = rim || f->forced[c + m * b->stride[a]] == 1;
    return rim && !f->forced[c];
}

static void mark_known(const struct block *b, struct forcing *f)
{
    double *field = block_field(b), *const fields[1] = {field};
    for (int64_t i = 0; i < f->npartner + f->nrim; i++)
        field[f->partner[i]] = 1.0;
    block_halo(b, 1, fields);
    f->known = NEW(bool, b->size);
    for (int64_t c = 0; c < b->size; c++)
        f->known[c] = field[c] == 1.0;
    mem_free(field);
}

static void list_partner(const struct fv *s, struct forcing *f)
{
    const struct block *b = &s->b;
    BLOCK_ROWS (b, 0, at, n)
        for (int64_t c = at; c < at + n; c++)
            if (is_rim(b, f, c))
                f->partner[f->npartner + f->nrim++] = c;
    mark_known(b, f);
    for (int a = 0; a < f->dim; a++) {
        f->v[a] = NEW(double, f->npartner + f->nrim);
        f->v_next[a] = NEW(double, f->npartner + f->nrim);
        f->v_old[a] = NEW(double, f->npartner + f->nrim);
        f->given[a] = block_field(b);
    }
}

static void list_cells(const struct fv *s, struct forcing *f)
{
    const struct block *b = &s->b;
    f->local = NEW(int64_t, b->size);
    f->set = NEW(int64_t, b->size);
    f->partner = NEW(int64_t, b->size);
    ALL_CELLS (b, i, j, k) {
        const int at[3] = {i, j, k};
        const int64_t c = block_at(b, i, j, k);
        if (!f->forced[c])
            continue;
        const bool local = is_local(b, at);
        if (local)
            f->local[f->nlocal++] = c;
        if (f->forced[c] == 1 && local && f->layer[c] && f->from_partner)
            f->partner[f->npartner++] = c;
        else if ((f->forced[c] == 1 && local && f->layer[c]) ||
                 (f->forced[c] == 2 && !has_bc(s, at))) {
            f->set[f->nset++] = c;
        }
    }
    if (f->from_partner)
        list_partner(s, f);
    f->imposed = f->nset > 0;
    MPI_Allreduce(MPI_IN_PLACE, &f->imposed, 1, MPI_C_BOOL, MPI_LOR, b->cart);
}

/* Faces between free and forced cells along axis a. */
static void list_faces(const struct fv *s, struct forcing *f, int a)
{
    const struct block *b = &s->b;
    f->face[a] = NEW(int64_t, b->size);
    f->sign[a] = NEW(signed char, b->size);
    f->counts[a] = NEW(bool, b->size);
    f->open[a] = NEW(double, b->size);
    ALL_CELLS (b, i, j, k) {
        const int at[3] = {i, j, k};
        const int64_t c = block_at(b, i, j, k), d = b->stride[a];
        if (at[a] == -b->g[a])
            continue;
        const bool here = f->forced[c] != 0, below = f->forced[c - d] != 0;
        f->open[a][c] = !here && !below;
        if (here == below)
            continue;
        int inner[3] = {i, j, k}, outer[3] = {i, j, k}; /* the free cell, the forced one */
        (here ? inner : outer)[a]--;
        const enum bc_kind kind = bc_behind(s, outer, a);
        if (kind == BC_OUTFLOW) /* psi is 0 on the face, half a cell away */
            f->open[a][c] = 2.0;
        if (kind || f->forced[here ? c : c - d] == 3)
            continue;
        f->face[a][f->nface[a]] = c;
        f->sign[a][f->nface[a]] = here ? 1 : -1;
        f->counts[a][f->nface[a]++] = is_local(b, inner);
    }
}

/* Adds to the weights, counted from cell 0 outwards, g times the ghost `depth' = 1, 2 cells beyond
 * the free cell at `edge', behind which `run' free cells stand in line. */
static void spread_ghost(int edge, int run, int depth, double g, double *cubic, double *even,
                         int way)
{
    static const double beyond[4][2][4] = {{{1}, {1}},
                                           {{2, -1}, {3, -2}},
                                           {{3, -3, 1}, {6, -8, 3}},
                                           {{4, -6, 4, -1}, {10, -20, 15, -4}}};
    for (int m = 0; m < run; m++)
        cubic[REACH + way * (edge - m)] += g * beyond[run - 1][depth - 1][m];
    even[REACH + way * (edge - (depth <= run ? depth - 1 : run - 1))] += g;
}

/* Boundary that the two cells beside a cell reach, if any. */
struct beside {
    enum bc_kind kind;
    double pressure; /* m^2/s^2: of an outflow */
};

/* The same where the pressure is given on the face: p by the cubic through it, psi odd; and at a
 * slip wall, where both are even. */
static void spread_mirror(const struct beside *side, int edge, int run, int depth, double g,
                          struct fix *x, int way)
{
    static const double given[2][3] = {{-13.0 / 3.0, 5.0 / 3.0, -1.0 / 3.0},
                                       {-70.0 / 3.0, 32.0 / 3.0, -7.0 / 3.0}};
    const double sign = side->kind == BC_OUTFLOW ? -1.0 : 1.0;
    const int near = REACH + way * (edge - (depth <= run ? depth - 1 : run - 1));
    x->even[near] += sign * g;
    if (side->kind == BC_SLIP || run < 3)
        x->cubic[near] += sign * g;
    else
        for (int m = 0; m < 3; m++)
            x->cubic[REACH + way * (edge - m)] += g * given[depth - 1][m];
    x->given += side->pressure * (run < 3 ? 2.0 * g : g * (depth == 1 ? 4.0 : 16.0));
}

/* Adds what the two cells on one side of a free cell c have beyond the plain weights 8/12, -1/12.
 * d: the step to that side, of sign `way'. False if both are free. */
static bool add_side(const struct forcing *f, int64_t c, int64_t d, int way,
                     const struct beside *side, struct fix *x)
{
    static const double plain[2] = {8.0 / 12.0, -1.0 / 12.0};
    const int edge = f->forced[c + d] ? 0 : 1;
    const int most = side->kind ? 3 : 4; /* by a cubic the pressure in a cavity's corners grows */
    int run = 1;
    if (!f->forced[c + d] && !f->forced[c + 2 * d])
        return false;
    while (run < most && edge - run >= -REACH && !f->forced[c + (edge - run) * d])
        run++;
    for (int m = edge + 1; m <= 2; m++) {
        const double g = way * plain[m - 1];
        x->cubic[REACH + way * m] -= g;
        x->even[REACH + way * m] -= g;
        if (side->kind == BC_SLIP || side->kind == BC_OUTFLOW) {
            spread_mirror(side, edge, run, m - edge, g, x, way);
        } else if (f->whole && f->forced[c + (edge + 1) * d] == 1) {
            double spare[2 * REACH + 1] = {0.0};
            spread_ghost(edge, run, m - edge, g, x->cubic, spare, way);
            spread_ghost(edge, run, m - edge, g, x->even, spare, way);
        } else
            spread_ghost(edge, run, m - edge, g, x->cubic, x->even, way);
    }
    return true;
}

static struct beside beside(const struct fv *s, const struct forcing *f, int64_t c, int a, int way)
{
    const struct block *b = &s->b;
    const int64_t d = way * b->stride[a], box = f->forced[c + d] ? c + d : c + 2 * d;
    int at[3];
    block_place(b, c, at);
    at[a] += 2 * way;
    if (f->forced[box] == 3)
        return (struct beside){
            blocked_params(s->blocked->box[box] - 1)->kind == WALL_SLIP ? BC_SLIP : BC_NO_SLIP,
            0.0};
    if (f->forced[c + way * b->stride[a]] == 1)
        return (struct beside){BC_NONE, 0.0};
    const enum bc_kind kind = bc_behind(s, at, a);
    return (struct beside){kind, kind ? s->bc->pressure[2 * a + (way > 0)] : 0.0};
}

static void list_fixes(const struct fv *s, struct forcing *f, int a)
{
    const struct block *b = &s->b;
    int64_t room = 0;
    BLOCK_ROWS (b, 0, at, n)
        for (int64_t c = at; c < at + n; c++) {
            struct fix x = {.cell = c};
            if (f->forced[c])
                continue;
            const int64_t d = b->stride[a];
            const struct beside above = beside(s, f, c, a, 1), below = beside(s, f, c, a, -1);
            const bool one = add_side(f, c, d, 1, &above, &x);
            if (!add_side(f, c, -d, -1, &below, &x) && !one)
                continue;
            const double h = block_size(b, a, j_); /* rows near a side or a hole are even */
            x.given /= h;
            for (int m = 0; m <= 2 * REACH; m++) {
                x.cubic[m] /= h;
                x.even[m] /= h;
            }
            if (f->nfix[a] == room) {
                room = 2 * room + 64;
                GROW(f->fix[a], f->nfix[a], room);
            }
            f->fix[a][f->nfix[a]++] = x;
        }
}

struct forcing *forcing_create(const struct fv *s, const double *lo, const double *hi, bool partner)
{
    const struct block *b = &s->b;
    struct forcing *f = NEW(struct forcing, 1);
    f->dim = b->dim;
    f->from_partner = partner;
    f->whole = partner && s->surface;
    f->forced = NEW(unsigned char, b->size);
    f->layer = NEW(unsigned char, b->size);
    if (count_kind(s, f, lo, hi) == 0) {
        forcing_free(&f);
        return NULL;
    }
    find_layers(s, f);
    list_cells(s, f);
    for (int a = 0; a < f->dim; a++) {
        list_faces(s, f, a);
        list_fixes(s, f, a);
    }
    return f;
}

void forcing_free(struct forcing **fp)
{
    struct forcing *f = *fp;
    if (!f)
        return;
    mem_free(f->forced);
    mem_free(f->layer);
    mem_free(f->local);
    mem_free(f->set);
    mem_free(f->partner);
    mem_free(f->known);
    for (int a = 0; a < 3; a++) {
        mem_free(f->fix[a]);
        mem_free(f->face[a]);
        mem_free(f->sign[a]);
        mem_free(f->counts[a]);
        mem_free(f->open[a]);
        mem_free(f->v[a]);
        mem_free(f->v_next[a]);
        mem_free(f->v_old[a]);
        mem_free(f->given[a]);
    }
    mem_free(f);
    *fp = NULL;
}

void forcing_zero(const struct forcing *f, double *q)
{
    for (int64_t i = 0; i < f->nlocal; i++)
        q[f->local[i]] = 0.0;
}

/* Partner's velocity at t: linear over the window, or through the window before, too. */
static double partner_value(const struct forcing *f, bool quadratic, int a, int64_t i, double t)
{
    const double T = f->t1 - f->t0, x = T > 0.0 ? (t - f->t0) / T : 0.0;
    const double linear = f->v[a][i] + x * (f->v_next[a][i] - f->v[a][i]);
    if (!quadratic || f->levels < 3)
        return linear;
    const double y = (f->t0 - f->t_old) / T; /* 1 for even windows */
    const double second =
        ((f->v_next[a][i] - f->v[a][i]) - (f->v[a][i] - f->v_old[a][i]) / y) / (1.0 + y);
    return linear + x * (x - 1.0) * second;
}

void forcing_shift(struct forcing *f, double t0, double t1)
{
    const double h = t0 - f->t0, g = f->t0 - f->t_old, T = t1 - t0;
    for (int a = 0; a < f->dim; a++) {
        double *oldest = f->v_old[a], *v = f->v_next[a], *old = f->v[a];
        for (int64_t i = 0; i < f->npartner + f->nrim; i++) {
            const double d0 = f->levels > 1 ? (v[i] - old[i]) / h : 0.0;
            const double d1 = f->levels > 2 ? (old[i] - oldest[i]) / g : d0;
            const double bend = f->levels > 2 ? (d0 - d1) / (h + g) : 0.0;
            oldest[i] = v[i] + T * (d0 + (T + h) * bend);
        }
        f->v_old[a] = old;
        f->v[a] = v;
        f->v_next[a] = oldest;
    }
    f->t_old = f->t0;
    f->t0 = t0;
    f->t1 = t1;
    f->levels = f->levels < 3 ? f->levels + 1 : 3;
}

/* One round: listed cells without a value take the mean of their neighbours that have one. */
static void fill_round(const struct fv *s, const double *has, double *next)
{
    const struct forcing *f = s->forcing;
    memcpy(next, has, (size_t)s->b.size * sizeof *next);
    for (int64_t i = 0; i < f->npartner + f->nrim; i++) {
        const int64_t c = f->partner[i];
        double sum[3] = {0.0, 0.0, 0.0}, n = 0.0;
        for (int way = 0; way < 2 * f->dim && has[c] == 0.0; way++) {
            const int64_t d = c + (way % 2 ? 1 : -1) * s->b.stride[way / 2];
            if (has[d] == 0.0)
                continue;
            n += 1.0;
            for (int a = 0; a < f->dim; a++)
                sum[a] += f->given[a][d];
        }
        for (int a = 0; a < f->dim && n > 0.0; a++)
            f->given[a][c] = sum[a] / n;
        next[c] = has[c] > 0.0 || n > 0.0 ? 1.0 : 0.0;
    }
}

void forcing_fill(const struct fv *s, const unsigned char *mask)
{
    const struct forcing *f = s->forcing;
    double *has = block_field(&s->b), *next = block_field(&s->b);
    for (int64_t i = 0; i < f->npartner + f->nrim; i++) {
        has[f->partner[i]] = mask[i];
        for (int a = 0; a < f->dim; a++)
            f->given[a][f->partner[i]] = mask[i] ? f->v_next[a][i] : 0.0;
    }
    for (int round = 0; round < NEAR; round++) {
        double *spare = has;
        block_halo(&s->b, 1, (double *const[]){has});
        block_halo(&s->b, f->dim, f->given);
        fill_round(s, has, next);
        has = next;
        next = spare;
    }
    for (int a = 0; a < f->dim; a++)
        for (int64_t i = 0; i < f->npartner + f->nrim; i++)
            f->v_next[a][i] = f->given[a][f->partner[i]];
    mem_free(has);
    mem_free(next);
}

void forcing_velocity(const struct fv *s, double t, double *const u[3])
{
    const struct forcing *f = s->forcing;
    double x[3], h[3], v[3];
    for (int64_t i = 0; i < f->nset; i++) {
        int at[3];
        block_place(&s->b, f->set[i], at);
        block_cell(&s->b, at[0], at[1], at[2], x, h);
        exact_average(&s->exact, x, h, t, v, NULL, NULL);
        for (int a = 0; a < f->dim; a++)
            u[a][f->set[i]] = v[a];
    }
    for (int a = 0; a < f->dim; a++)
        for (int64_t i = 0; i < f->npartner; i++)
            u[a][f->partner[i]] = partner_value(f, s->prm.forced_order == 2, a, i, t);
}

/* Centre of the lower face of a cell given by its index; the cell's size. */
static void face_centre(const struct block *b, int64_t c, int a, double *x, double *h)
{
    int at[3];
    block_place(b, c, at);
    block_cell(b, at[0], at[1], at[2], x, h);
    x[a] -= 0.5 * h[a];
}

static double face_area(const struct block *b, int64_t c, int a)
{
    int at[3];
    block_place(b, c, at);
    return block_volume(b, at[1]) / block_size(b, a, at[1]);
}

static bool is_exact(const struct forcing *f, int64_t c, int64_t d)
{
    return f->forced[c] == 2 || f->forced[c - d] == 2 || !f->from_partner;
}

/* A partner's values at t, two cells to both sides of the outline. */
static void look_at_partner(const struct fv *s, double t)
{
    const struct forcing *f = s->forcing;
    for (int a = 0; a < f->dim; a++)
        for (int64_t i = 0; i < f->npartner + f->nrim; i++)
            f->given[a][f->partner[i]] = partner_value(f, s->prm.forced_order == 2, a, i, t);
    block_halo(&s->b, f->dim, f->given);
}

/* Whether the flux through the lower face of c is a partner's alone. */
static bool is_partners(const struct forcing *f, int64_t c, int64_t d)
{
    return f->from_partner && f->known[c - 2 * d] && f->known[c - d] && f->known[c] &&
           f->known[c + d];
}

static double partner_flux(const double *u, int64_t d)
{
    return (7.0 * (u[-d] + u[0]) - (u[-2 * d] + u[d])) / 12.0;
}

/* Takes the net flux out, evenly; with that of walls and inflow if given. */
static void balance(const struct fv *s, bool given, double *const U[3])
{
    const struct forcing *f = s->forcing;
    double sums[2] = {0.0, 0.0};
    if (s->surface) /* which takes what is too much */
        return;
    for (int a = 0; a < f->dim; a++)
        for (int64_t i = 0; i < f->nface[a]; i++)
            if (f->counts[a][i]) {
                const double area = face_area(&s->b, f->face[a][i], a);
                sums[0] += f->sign[a][i] * U[a][f->face[a][i]] * area;
                sums[1] += area;
            }
    if (s->bc) {
        if (s->bc->pressure_given)
            return; /* the outflow takes what is too much */
        sums[0] += given ? s->bc->outflux : 0.0;
    }
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, s->b.cart);
    const double excess = sums[1] > 0.0 ? sums[0] / sums[1] : 0.0;
    for (int a = 0; a < f->dim; a++)
        for (int64_t i = 0; i < f->nface[a]; i++)
            U[a][f->face[a][i]] -= f->sign[a][i] * excess;
}

void forcing_fluxes(const struct fv *s, double t, double *const U[3])
{
    const struct forcing *f = s->forcing;
    if (f->from_partner)
        look_at_partner(s, t);
    for (int a = 0; a < f->dim; a++)
        for (int64_t i = 0; i < f->nface[a]; i++) {
            const int64_t c = f->face[a][i], d = s->b.stride[a];
            if (is_exact(f, c, d)) {
                double x[3], h[3], v[3];
                face_centre(&s->b, c, a, x, h);
                exact_face(&s->exact, x, h, a, t, v);
                U[a][c] = v[a];
            } else if (is_partners(f, c, d)) {
                U[a][c] = partner_flux(f->given[a] + c, d);
            }
            if (f->forced[c] == 1 || f->forced[c - d] == 1)
                U[a][c] -= f->sign[a][i] * f->inflow;
        }
    balance(s, true, U);
}

void forcing_fluxes_variation(const struct fv *s, double *const U[3])
{
    const struct forcing *f = s->forcing;
    for (int a = 0; a < f->dim; a++)
        for (int64_t i = 0; i < f->nface[a]; i++)
            if (is_exact(f, f->face[a][i], s->b.stride[a]) ||
                is_partners(f, f->face[a][i], s->b.stride[a]))
                U[a][f->face[a][i]] = 0.0;
    if (f->from_partner)
        balance(s, false, U);
}

void forcing_gradient(const struct fv *s, int a, enum continuation how, const double *q,
                      double *out)
{
    const struct forcing *f = s->forcing;
    const int64_t d = s->b.stride[a];
    for (int64_t i = 0; i < f->nfix[a]; i++) {
        const struct fix *x = f->fix[a] + i;
        const double *w = (how == CONTINUE_EVEN ? x->even : x->cubic) + REACH, *at = q + x->cell;
        for (int m = -REACH; m <= REACH; m++)
            out[x->cell] += w[m] * at[m * d];
        if (how == CONTINUE_CUBIC)
            out[x->cell] += x->given;
    }
}

/* A cell takes the mean of what its known lines say: cubic where three cells behind are known, else
 * linear. */
void forcing_extend(const struct fv *s, double *p)
{
    const struct forcing *f = s->forcing;
    const struct block *b = &s->b;
    double *const fields[1] = {p};
    for (int layer = 1; layer <= NEAR; layer++) {
        block_halo(b, 1, fields);
        for (int64_t i = 0; i < f->nlocal; i++) {
            const int64_t c = f->local[i];
            double sum = 0.0, n = 0.0;
            if (f->layer[c] != layer || f->forced[c] != 1)
                continue;
            for (int way = 0; way < 2 * f->dim; way++) {
                const int64_t d = (way % 2 ? 1 : -1) * b->stride[way / 2];
#define KNOWN(m) (!f->forced[c + (m)*d] || (f->layer[c + (m)*d] && f->layer[c + (m)*d] < layer))
                if (!KNOWN(1))
                    continue;
                n += 1.0;
                if (KNOWN(2) && KNOWN(3))
                    sum += 3.0 * p[c + d] - 3.0 * p[c + 2 * d] + p[c + 3 * d];
                else
                    sum += p[c + d];
#undef KNOWN
            }
            if (n == 0.0) { /* a corner cell: its diagonal neighbours */
                for (int q = 0; q < 4; q++) {
                    const int64_t d =
                        (q % 2 ? 1 : -1) * b->stride[0] + (q / 2 ? 1 : -1) * b->stride[1];
                    if (!f->forced[c + d] || (f->layer[c + d] && f->layer[c + d] < layer)) {
                        sum += p[c + d];
                        n += 1.0;
                    }
                }
            }
            if (n > 0.0)
                p[c] = sum / n;
        }
    }
    block_halo(b, 1, fields);
}
