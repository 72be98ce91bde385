/* given_cells.c - what computed cells of blocks make of imposed ones beside them. A gradient is the
 * operators' own (mesh_ops.c) of q extrapolated into imposed cells along the axis of each face
 * value: with zero gradient, or by the cubic through the free cells in line; where the whole line
 * is given, its face values are extrapolated from the lines beside it. As cells do not move, each
 * such gradient is one list of weights. SPDX-License-Identifier: BSD-3-Clause */
#include "forcing.h"

#include "../grid/fv_grid.h"
#include "mesh_bc.h"

enum { WINDOW = 2 * REACH + 1, WINDOW_CELLS = WINDOW * WINDOW * WINDOW };

struct one_sided {
    int64_t n, *cell;
    int64_t *first; /* of each cell's weights, and one more */
    int64_t *place; /* of the values */
    double *w;      /* [2][3] 1/m: of each value, evenly and by a cubic */
};

/* Weights of the cells around a cell c. */
struct window {
    const struct mesh *m;
    const struct part *p;
    int64_t c;
    enum continuation how;
    double w[WINDOW_CELLS];
};

/* Offset in a field of a step along the indices. */
static int64_t step_to(const struct part *p, const int *at)
{
    return at[0] + at[1] * p->stride[1] + at[2] * p->stride[2];
}

/* What the cell at `at' from home is. */
static unsigned char status_at(const struct window *w, const int *at)
{
    return w->m->status[w->c + step_to(w->p, at)];
}

static bool is_free(unsigned char status)
{
    return status == CELL_COMPUTED || status == CELL_FRINGE;
}

static void add(struct window *w, const int *at, double g)
{
    w->w[(at[0] + REACH) + WINDOW * ((at[1] + REACH) + WINDOW * (at[2] + REACH))] += g;
}

/* Adds g times q `depth' = 1, 2 cells beyond the free cell `edge', away from home along a. run
 * counts free cells in line within the window; at least one is there. */
static void add_beyond(struct window *w, const int *edge, int a, int way, int depth, double g)
{
    int at[3] = {edge[0], edge[1], edge[2]}, run = 0;
    double beyond[4];
    while (run < 4 && at[a] >= -REACH && at[a] <= REACH && is_free(status_at(w, at))) {
        run++;
        at[a] -= way;
    }
    at[a] = edge[a];
    if (w->how == CONTINUE_EVEN) {
        at[a] -= way * ((depth <= run ? depth : run) - 1);
        add(w, at, g);
        return;
    }
    rows_beyond(NULL, way, run, depth, beyond);
    for (int k = 0; k < run; k++, at[a] -= way)
        add(w, at, g * beyond[k]);
}

/* Adds g times q m cells from home along a. The first imposed cell on the way ends the line. */
static void add_in_line(struct window *w, const int *home, int a, int m, double g)
{
    const int way = m < 0 ? -1 : 1;
    int at[3] = {home[0], home[1], home[2]};
    for (int k = 1; k <= way * m; k++) {
        at[a] = home[a] + k * way;
        if (status_at(w, at) != CELL_GIVEN)
            continue;
        at[a] -= way;
        add_beyond(w, at, a, way, way * m - k + 1, g);
        return;
    }
    add(w, at, g);
}

/* Adds g times the value on the lower (up = 0) or upper face along a of the cell `home'. */
static void add_face(struct window *w, const int *home, int a, int up, double g)
{
    static const double value[4] = {-1.0 / 12.0, 7.0 / 12.0, 7.0 / 12.0, -1.0 / 12.0};
    for (int k = 0; k < 4; k++)
        add_in_line(w, home, a, k - 2 + up, g * value[k]);
}

/* The same of the cell one step `way' along t; if that is given, from the lines on this side. How
 * many lines are used depends on the continuation: one, or up to three. */
static void add_face_beside(struct window *w, int a, int up, int t, int way, double g)
{
    int home[3] = {0, 0, 0}, run = 0;
    double beyond[3];
    home[t] = way;
    if (status_at(w, home) != CELL_GIVEN) {
        add_face(w, home, a, up, g);
        return;
    }
    for (home[t] = 0; run < (w->how == CONTINUE_EVEN ? 1 : 3) && is_free(status_at(w, home));
         home[t] -= way)
        run++;
    rows_beyond(NULL, way, run, 1, beyond);
    for (int k = 0; k < run; k++) {
        home[t] = -k * way;
        add_face(w, home, a, up, g * beyond[k]);
    }
}

/* Adds the pressure's force along e on the lower or upper face along a, over the cell's volume. S
 * with the products of mesh_ops.c along the face. */
static void add_force(struct window *w, int a, int up, int e)
{
    static const int home[3] = {0, 0, 0};
    const struct mesh *m = w->m;
    const int64_t face = w->c + up * w->p->stride[a];
    const double sign = (up ? 1.0 : -1.0) / m->V[w->c];
    add_face(w, home, a, up, sign * m->S[a][e][face]);
    for (int t = 0; t < m->dim; t++) {
        const int64_t d = w->p->stride[t];
        const double dS = t == a ? 0.0 : (m->S[a][e][face + d] - m->S[a][e][face - d]) / 48.0;
        if (dS == 0.0)
            continue;
        add_face_beside(w, a, up, t, 1, sign * dS);
        add_face_beside(w, a, up, t, -1, -sign * dS);
    }
}

/* Two cells along all indices: as far as any of its face values reach. */
static bool is_beside_given(const struct mesh *m, const struct part *p, int64_t c)
{
    const int deep = m->dim == 3 ? 2 : 0;
    int d[3];
    for (d[2] = -deep; d[2] <= deep; d[2]++)
        for (d[1] = -2; d[1] <= 2; d[1]++)
            for (d[0] = -2; d[0] <= 2; d[0]++)
                if (m->status[c + step_to(p, d)] == CELL_GIVEN)
                    return true;
    return false;
}

/* Enters the weights of one cell. Six weights a value: three components evenly,
 * three by a cubic. */
static void add_cell(const struct mesh *m, const struct part *p, int64_t c, struct one_sided *g)
{
    double all[2][3][WINDOW_CELLS];
    for (int how = 0; how < 2; how++)
        for (int e = 0; e < m->dim; e++) {
            struct window w = {.m = m, .p = p, .c = c, .how = how ? CONTINUE_CUBIC : CONTINUE_EVEN};
            for (int a = 0; a < m->dim; a++)
                for (int up = 0; up < 2; up++)
                    add_force(&w, a, up, e);
            memcpy(all[how][e], w.w, sizeof w.w);
        }
    int64_t n = g->first[g->n];
    for (int k = 0; k < WINDOW_CELLS; k++) {
        const int at[3] = {k % WINDOW - REACH, k / WINDOW % WINDOW - REACH,
                           k / WINDOW / WINDOW - REACH};
        bool any = false;
        for (int q = 0; q < 2 * m->dim; q++)
            any = any || all[q / m->dim][q % m->dim][k] != 0.0;
        if (!any)
            continue;
        ROOM_IN(g, g->place, n + 1);
        ROOM_IN(g, g->w, 6 * (n + 1));
        g->place[n] = c + step_to(p, at);
        for (int q = 0; q < 6; q++)
            g->w[6 * n + q] = q % 3 < m->dim ? all[q / 3][q % 3][k] : 0.0;
        n++;
    }
    g->cell[g->n++] = c;
    g->first[g->n] = n;
}

/* Pass 0 counts. */
void given_rows_create(const struct fv *s, struct forcing *f)
{
    struct one_sided *g = f->gradient = NEW_IN(f, struct one_sided, 1);
    int64_t n = 0;
    for (int pass = 0; pass < 2; pass++) {
        FLOW_ROWS_AT (s, part, j, at, len)
            for (int64_t c = at; c < at + len; c++) {
                if (s->m->status[c] != CELL_COMPUTED || !is_beside_given(s->m, part, c))
                    continue;
                if (pass == 1)
                    add_cell(s->m, part, c, g);
                n += pass == 0;
            }
        if (pass == 0) {
            g->cell = NEW_IN(g, int64_t, n);
            g->first = NEW_IN(g, int64_t, n + 1);
        }
    }
}

/* Replaces, not adds. */
void given_gradient(const struct fv *s, enum continuation how, const double *q, double *const g[3])
{
    const struct one_sided *of = s->forcing->gradient;
    const int from = how == CONTINUE_EVEN ? 0 : 3;
    for (int64_t i = 0; i < of->n; i++) {
        double sum[3] = {0.0, 0.0, 0.0};
        for (int64_t k = of->first[i]; k < of->first[i + 1]; k++)
            for (int a = 0; a < 3; a++)
                sum[a] += of->w[6 * k + from + a] * q[of->place[k]];
        for (int a = 0; a < s->dim; a++)
            g[a][of->cell[i]] = sum[a];
    }
}

/* Borrowed; false: there are no more. */
bool given_stencil(const struct forcing *f, int64_t i, int64_t *cell, int64_t *n,
                   const int64_t **place)
{
    const struct one_sided *of = f->gradient;
    if (!of || i >= of->n)
        return false;
    *cell = of->cell[i];
    *n = of->first[i + 1] - of->first[i];
    *place = of->place + of->first[i];
    return true;
}

/* Before and after: sources may be ghosts, and ghosts copy the result. */
void given_mirror(const struct fv *s, double *psi)
{
    const struct forcing *f = s->forcing;
    mesh_halo(s->m, 1, &psi);
    for (int64_t i = 0; i < f->nlocal; i++) {
        const int64_t c = f->local[i];
        const struct part *p = grid_part(&s->grid, c, NULL);
        int offset[MESH_SOURCES][3];
        const int n = f->layer[c] == 1 ? mesh_given_sources(s->m, p, c, offset) : 0;
        double sum = 0.0;
        for (int k = 0; k < n; k++)
            sum += psi[c + step_to(p, offset[k])];
        psi[c] = n > 0 ? sum / n : 0.0;
    }
    mesh_halo(s->m, 1, &psi);
}

/* u.S of a face along a from the derivatives of the map there; S from cofactors. */
static double flux_at(double dx[3][3], int a, int dim, const double *u)
{
    const int p = (a + 1) % 3, q = (a + 2) % 3;
    double sum = 0.0;
    for (int e = 0; e < dim; e++) {
        const int v = (e + 1) % 3, w = (e + 2) % 3;
        sum += u[e] * (dx[p][v] * dx[q][w] - dx[p][w] * dx[q][v]);
    }
    return sum;
}

/* Two Gauss points a tangent. */
double given_exact_flux(const struct fv *s, int64_t c, int a, double t)
{
    static const double gauss[2] = {0.2113248654051871, 0.7886751345948129};
    const int n = s->dim == 3 ? 4 : 2, t0 = (a + 1) % s->dim, t1 = (a + 2) % s->dim;
    double sum = 0.0;
    int at[3];
    const struct part *p = grid_part(&s->grid, c, at);
    const int cell[3] = {p->lo[0] + at[0], p->lo[1] + at[1], p->lo[2] + at[2]};
    for (int g = 0; g < n; g++) {
        double xi[3] = {0.0, 0.0, 0.0}, x[3], dx[3][3], u[3];
        if (n == 4)
            xi[t1] = gauss[g >> 1];
        xi[t0] = gauss[g & 1];
        mesh_map_point(s->m->block + p->block, s->dim, cell, xi, x, dx);
        mesh_exact_at(s, x, t, u, NULL, NULL);
        sum += flux_at(dx, a, s->dim, u) / n;
    }
    return sum;
}

/* On the lower face of c along a. */
static double face_value(const double *q, int64_t d)
{
    return (7.0 * (q[-d] + q[0]) - (q[-2 * d] + q[d])) / 12.0;
}

/* Products along tangents where a partner knows all their values. */
double given_flux_of(const struct fv *s, double *const v[3], int64_t c, int a)
{
    const struct mesh *m = s->m;
    const struct part *p = grid_part(&s->grid, c, NULL);
    const int64_t d = p->stride[a];
    const bool *known = s->forcing->known;
    double sum = 0.0;
    for (int e = 0; e < m->dim; e++) {
        sum += face_value(v[e] + c, d) * m->S[a][e][c];
        for (int t = 0; t < m->dim; t++) {
            const int64_t up = c + p->stride[t], down = c - p->stride[t];
            bool all = t != a;
            for (int k = -2; k < 2 && all; k++)
                all = known[up + k * d] && known[down + k * d];
            if (all)
                sum += (face_value(v[e] + up, d) - face_value(v[e] + down, d)) *
                       (m->S[a][e][up] - m->S[a][e][down]) / 48.0;
        }
    }
    return sum;
}
