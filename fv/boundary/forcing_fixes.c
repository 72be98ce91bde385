/* forcing_fixes.c - what free cells make of imposed ones beside them: one-sided gradients of even
 * cells and rows (of blocks: given_cells.c), and a field that is extrapolated into the imposed
 * cells. For each free cell whose stencil (8 (q_1 - q_-1) - (q_2 - q_-2))/(12 h) reaches imposed
 * cells, a ghost or a box, the weights are made once: those of the plain form taken off, those of
 * the extrapolated values added (struct fix). forcing_gradient then adds them to the plain
 * gradient.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "forcing.h"

#include "../grid/fv_grid.h"
#include "bc.h"
#include "blocked.h"

/* A cell along an axis whose gradient goes on into imposed cells. */
struct line_at {
    const struct rows *rows; /* NULL: even along this axis */
    int row, way;            /* local row of the cell; the way outwards */
};

/* Adds to the weights, counted from cell 0 outwards, g times the ghost `depth' = 1, 2 cells beyond
 * the free cell at `edge', behind which `run' free cells stand in line. evenly: zero gradient, from
 * two cells; else the polynomial through up to four. */
static void spread_ghost(const struct line_at *l, int edge, int run, int depth, double g,
                         bool evenly, double *to)
{
    const double *h = l->rows ? l->rows->h + l->row + l->way * edge : NULL;
    const int n = evenly && run > 2 ? 2 : run;
    double w[4];
    (evenly ? rows_mirror : rows_beyond)(h, l->way, n, depth, w);
    for (int m = 0; m < n; m++)
        to[REACH + l->way * (edge - m)] += g * w[m];
}

/* The boundary that the two cells beside a cell reach, if any. */
struct beside {
    enum mesh_side kind;
    double pressure; /* m^2/s^2: of an outflow */
};

/* Ghosts where the pressure is given on the face: p by the cubic through it, psi antisymmetric; at
 * a slip wall both are mirrored. Fewer than three free cells in line: antisymmetric, too. */
static void spread_mirror(const struct beside *side, int edge, int run, int depth, double g,
                          struct fix *x, int way)
{
    static const double given[2][3] = {{-13.0 / 3.0, 5.0 / 3.0, -1.0 / 3.0},
                                       {-70.0 / 3.0, 32.0 / 3.0, -7.0 / 3.0}};
    const double sign = side->kind == MESH_OUTFLOW ? -1.0 : 1.0;
    const int near = REACH + way * (edge - (depth <= run ? depth - 1 : run - 1));
    x->even[near] += sign * g;
    if (side->kind == MESH_SLIP || run < 3)
        x->cubic[near] += sign * g;
    else
        for (int m = 0; m < 3; m++)
            x->cubic[REACH + way * (edge - m)] += g * given[depth - 1][m];
    x->given += side->pressure * (run < 3 ? 2.0 * g : g * (depth == 1 ? 4.0 : 16.0));
}

/* Adds what the two cells on one side of a free cell c have beyond the plain weights, 1/m: plain[m]
 * of the m-th cell that way. False if both are free. run counts free cells in line inwards from the
 * last one, at most four. */
static bool add_side(const struct forcing *f, int64_t c, int64_t d, const struct line_at *l,
                     const double *plain, const struct beside *side, struct fix *x)
{
    const int edge = f->forced[c + d] ? 0 : 1, way = l->way;
    const int most = side->kind ? 3 : 4; /* by a cubic the pressure in a cavity's corners grows */
    int run = 1;
    if (!f->forced[c + d] && !f->forced[c + 2 * d])
        return false;
    while (run < most && edge - run >= -REACH && !f->forced[c + (edge - run) * d])
        run++;
    const bool whole = f->whole && f->forced[c + (edge + 1) * d] == 1;
    for (int m = edge + 1; m <= 2; m++) {
        const double g = plain[way * m];
        x->cubic[REACH + way * m] -= g;
        x->even[REACH + way * m] -= g;
        if (side->kind == MESH_SLIP || side->kind == MESH_OUTFLOW) {
            spread_mirror(side, edge, run, m - edge, g, x, way);
            continue;
        }
        spread_ghost(l, edge, run, m - edge, g, false, x->cubic);
        spread_ghost(l, edge, run, m - edge, g, !whole, x->even);
    }
    return true;
}

/* By what the second cell in direction `way' lies behind. */
static struct beside beside(const struct fv *s, const struct forcing *f, int64_t c, int a, int way)
{
    const struct block *b = &s->b;
    const int64_t d = way * b->stride[a], box = f->forced[c + d] ? c + d : c + 2 * d;
    int at[3];
    block_place(b, c, at);
    at[a] += 2 * way;
    if (f->forced[box] == 3)
        return (struct beside){
            s->prm.boxes[s->blocked->box[box] - 1].kind == WALL_SLIP ? MESH_SLIP : MESH_WALL, 0.0};
    if (f->forced[c + way * b->stride[a]] == 1)
        return (struct beside){MESH_NONE, 0.0};
    const enum mesh_side kind = bc_behind(s, at, a);
    return (struct beside){kind, kind ? s->bc->pressure[2 * a + (way > 0)] : 0.0};
}

/* Weights of the plain gradient of cells in local row j along a, 1/m, from the cell on. */
static void plain_weights(const struct block *b, int a, int j, double w[5])
{
    static const double even[5] = {1.0 / 12.0, -8.0 / 12.0, 0.0, 8.0 / 12.0, -1.0 / 12.0};
    for (int m = 0; m < 5; m++)
        w[m] = a == 1 && b->rows ? b->rows->gradient[j][m] : even[m] / b->h[a];
}

/* All cells of this rank, along axis a; both directions may add to one fix. */
void forcing_list_fixes(const struct fv *s, struct forcing *f, int a)
{
    const struct block *b = &s->b;
    const int64_t d = b->stride[a];
    BLOCK_ROWS_AT (b, 0, j, at, n)
        for (int64_t c = at; c < at + n; c++) {
            struct fix x = {.given = 0.0};
            bool any = false;
            double plain[5];
            if (f->forced[c])
                continue;
            plain_weights(b, a, j, plain);
            for (int way = 1; way >= -1; way -= 2) {
                const struct beside side = beside(s, f, c, a, way);
                const struct line_at l = {a == 1 ? b->rows : NULL, j, way};
                any = add_side(f, c, way * d, &l, plain + 2, &side, &x) || any;
            }
            if (!any)
                continue;
            ROOM_IN(f, f->fix[a], f->nfix[a] + 1);
            ROOM_IN(f, f->fix_cell[a], f->nfix[a] + 1);
            f->fix_cell[a][f->nfix[a]] = c;
            f->fix[a][f->nfix[a]++] = x;
        }
}

/* given holds an outflow's pressure; psi and variations have none. */
void forcing_gradient(const struct fv *s, int a, enum continuation how, const unsigned char *dry,
                      const double *q, double *out)
{
    const struct forcing *f = s->forcing;
    const int64_t d = s->b.stride[a];
    for (int64_t i = 0; i < f->nfix[a]; i++) {
        const struct fix *x = f->fix[a] + i;
        const int64_t c = f->fix_cell[a][i];
        if (dry && dry[c])
            continue;
        const double *w = (how == CONTINUE_EVEN ? x->even : x->cubic) + REACH, *at = q + c;
        for (int m = -REACH; m <= REACH; m++)
            out[c] += w[m] * at[m * d];
        if (how == CONTINUE_CUBIC)
            out[c] += x->given;
    }
}

/* Sum and number of what lines say. */
struct line_sum {
    double sum, n;
};

/* Free, or a layer that was filled before. */
static bool is_known(const struct forcing *f, int64_t c, int layer)
{
    return !f->forced[c] || (f->layer[c] && f->layer[c] < layer);
}

/* What the known lines along the axes say: quadratic where three cells behind are known, else
 * constant. */
static struct line_sum along_axes(const struct forcing *f, const struct part *part, int64_t c,
                                  int layer, const double *p)
{
    struct line_sum all = {0.0, 0.0};
    for (int way = 0; way < 2 * f->dim; way++) {
        const int64_t d = (way % 2 ? 1 : -1) * part->stride[way / 2];
        if (!is_known(f, c + d, layer))
            continue;
        all.n += 1.0;
        if (is_known(f, c + 2 * d, layer) && is_known(f, c + 3 * d, layer))
            all.sum += 3.0 * p[c + d] - 3.0 * p[c + 2 * d] + p[c + 3 * d];
        else
            all.sum += p[c + d];
    }
    return all;
}

/* The same of a corner cell from its diagonal neighbours in the plane of the first two axes. */
static struct line_sum across(const struct forcing *f, const struct part *part, int64_t c,
                              int layer, const double *p)
{
    struct line_sum all = {0.0, 0.0};
    for (int q = 0; q < 4; q++) {
        const int64_t d = (q % 2 ? 1 : -1) * part->stride[0] + (q / 2 ? 1 : -1) * part->stride[1];
        if (is_known(f, c + d, layer)) {
            all.sum += p[c + d];
            all.n += 1.0;
        }
    }
    return all;
}

/* A cell takes the mean of what its known lines say. Layer by layer, with a halo before each.
 * Collective. */
void forcing_extend(const struct fv *s, int layers, double *p)
{
    const struct forcing *f = s->forcing;
    double *const fields[1] = {p};
    for (int layer = 1; layer <= layers; layer++) {
        grid_halo(&s->grid, 1, fields);
        for (int64_t i = 0; i < f->nlocal; i++) {
            const int64_t c = f->local[i];
            if (f->layer[c] != layer || f->forced[c] != 1)
                continue;
            const struct part *part = grid_part(&s->grid, c, NULL);
            struct line_sum all = along_axes(f, part, c, layer, p);
            if (all.n == 0.0)
                all = across(f, part, c, layer, p);
            if (all.n > 0.0)
                p[c] = all.sum / all.n;
        }
    }
    grid_halo(&s->grid, 1, fields);
}
