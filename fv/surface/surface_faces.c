/* surface_faces.c - on blocks: faces that the surface cuts, or that have dry cells around. Flux of
 * psi through the lower face along a, G_ab = S_a.S_b/J:
 *   F = G_aa D_a + sum over tangents t of G_at D_t,
 * D_a the difference of the two cells, or of the wet one to the surface at its place theta on the
 * index line; D_t the mean over the wet ones of the two of their slopes along t, from wet cells.
 * Gradients beside the surface are made of these fluxes: e_a the spacing of centres,
 *   grad psi = sum over a of e_a (F_a,lower + F_a,upper)/2V.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "level_ops.h"
#include "levelset.h"
#include "mesh_view.h"

#include "../boundary/fv_boundary.h"

enum { AROUND = 12 }; /* two cells, and the four around each along two tangents */

/* A stencil under way. */
struct stencil {
    int n;
    int64_t at[AROUND];
    double weight[AROUND];
};

/* A cell that is there already gets the weight on top, so a row has each column once. */
static void add(struct stencil *x, int64_t at, double weight)
{
    for (int k = 0; k < x->n; k++)
        if (x->at[k] == at) {
            x->weight[k] += weight;
            return;
        }
    x->at[x->n] = at;
    x->weight[x->n++] = weight;
}

/* A partner's cells, wet or dry, have no psi. */
static bool is_given(const struct fv *s, int64_t c) { return s->m->status[c] == CELL_GIVEN; }

static bool is_wet(const struct fv *s, int64_t c)
{
    return s->surface->layer[c] == 0 && !is_given(s, c);
}

/* Whether psi there is no water's: behind sides it is mirrored. */
static bool is_dry(const struct fv *s, int64_t c)
{
    return !is_wet(s, c) && (!s->surface->mesh->out[c] || is_given(s, c));
}

/* weight times the slope of psi along t at a wet cell. */
static void add_slope(const struct fv *s, int64_t c, int64_t t, double weight, struct stencil *x)
{
    const bool dry[2] = {is_dry(s, c - t), is_dry(s, c + t)};
    if (dry[0] && dry[1])
        return;
    const unsigned char *out = s->surface->mesh->out;
    const double w = dry[0] || dry[1] ? weight : 0.5 * weight;
    const int64_t low = dry[0] || out[c - t] ? c : c - t, high = dry[1] || out[c + t] ? c : c + t;
    add(x, high, out[c + t] == BEHIND_ODD ? -w : w);
    add(x, low, out[c - t] == BEHIND_ODD ? w : -w);
}

static void add_cut(struct fv *s, int a, int64_t face, int64_t d)
{
    const struct surface_mesh *w = s->surface->mesh;
    struct cut x = level_cut(s->surface, face, d, is_wet(s, face));
    double at[3], e[3];
    for (int k = 0; k < 3; k++) {
        e[k] = w->x[k][x.dry] - w->x[k][x.wet];
        at[k] = w->x[k][x.wet] + x.theta * e[k];
        x.step += e[k] * e[k];
    }
    x.step = x.size = sqrt(x.step);
    for (int k = 0; k < 3; k++)
        e[k] /= x.step;
    level_add_cut(s, a, x, at, e);
}

/* Stencils of all faces stand in one list; the face has its first entry and their number. */
static void add_face(struct fv *s, int a, const struct wet_face *x, const struct stencil *q)
{
    struct surface_mesh *w = s->surface->mesh;
    ROOM_IN(w, w->face[a], w->nface[a] + 1);
    if (w->nat + q->n > w->at_room) {
        const int64_t more = 2 * w->at_room + 1024;
        GROW_IN(w, w->at, w->nat, more);
        GROW_IN(w, w->weight, w->nat, more);
        w->at_room = more;
    }
    struct wet_face *to = w->face[a] + w->nface[a]++;
    *to = *x;
    to->first = (int)w->nat;
    to->n = q->n;
    for (int k = 0; k < q->n; k++, w->nat++) {
        w->at[w->nat] = q->at[k];
        w->weight[w->nat] = q->weight[k];
    }
}

/* Whether slopes along the face count in its flux and end at dry cells. */
static bool has_dry_around(const struct fv *s, const struct part *p, int a, int64_t c)
{
    for (int t = 0; t < s->dim; t++) {
        const int64_t d = p->stride[t], b = c - p->stride[a];
        if (t != a && s->m->G[a][t][c] != 0.0 &&
            (is_dry(s, c - d) || is_dry(s, c + d) || is_dry(s, b - d) || is_dry(s, b + d)))
            return true;
    }
    return false;
}

static void look_at_face(struct fv *s, const struct part *p, int a, int64_t c)
{
    struct surface *f = s->surface;
    const struct mesh *m = s->m;
    const int64_t d = p->stride[a], cells[2] = {c - d, c};
    const bool here = is_wet(s, c), below = is_wet(s, c - d);
    const bool leaves = (here && f->mesh->out[c - d] == BEHIND_ODD) ||
                        (below && f->mesh->out[c] == BEHIND_ODD); /* through an outflow */
    f->open[a][c] = (here && below) || leaves ? m->open[a][c] : 0.0;
    if ((!here && !below) || m->open[a][c] == 0.0 || f->mesh->out[c] || f->mesh->out[c - d] ||
        (here && below && !has_dry_around(s, p, a, c)))
        return;
    struct wet_face x = {.face = c, .cut = -1};
    struct stencil q = {0};
    f->open[a][c] = 0.0;
    if (here != below) {
        add_cut(s, a, c, d);
        x.cut = (int)f->ncut[a] - 1;
        const struct cut *cut = f->cut[a] + x.cut;
        x.given = cut->up * m->G[a][a][c] / cut->theta;
        add(&q, cut->wet, -x.given);
    } else {
        add(&q, c, m->G[a][a][c]);
        add(&q, c - d, -m->G[a][a][c]);
    }
    for (int t = 0; t < m->dim; t++)
        for (int k = 0; k < 2 && t != a && m->G[a][t][c] != 0.0; k++)
            if (is_wet(s, cells[k]))
                add_slope(s, cells[k], p->stride[t], m->G[a][t][c] * (here && below ? 0.5 : 1.0),
                          &q);
    add_face(s, a, &x, &q);
}

/* Cuts above the cell next to a part, whose line ends within it (surface_line.c); along a from the
 * face `at'. */
static void look_beside(struct fv *s, const struct part *p, int a, int at)
{
    const unsigned char *out = s->surface->mesh->out;
    const int64_t d = p->stride[a];
    int down[3] = {0, 0, 0}, up[3] = {0, 0, 0};
    down[a] = -at;
    up[a] = at + 1 - p->n[a];
    PART_ROWS (p, down, up, c, n)
        for (int64_t i = c; i < c + n; i++)
            if (is_wet(s, i) != is_wet(s, i - d) && !out[i] && !out[i - d] && !is_given(s, i) &&
                !is_given(s, i - d))
                add_cut(s, a, i, d);
}

void surface_mesh_find_faces(struct fv *s)
{
    struct surface *f = s->surface;
    f->mesh->nat = 0;
    for (int a = 0; a < s->dim; a++) {
        f->ncut[a] = f->mesh->nface[a] = 0;
        for (int q = 0; q < s->grid.nparts; q++) {
            int down[3], up[3];
            for (int t = 0; t < 3; t++)
                down[t] = up[t] = t < s->dim && t != a;
            up[a] = 1;
            PART_ROWS (s->grid.part + q, down, up, c, n)
                for (int64_t i = c; i < c + n; i++)
                    look_at_face(s, s->grid.part + q, a, i);
            if (!surface_takes_lines(s, s->grid.part + q))
                continue;
            look_beside(s, s->grid.part + q, a, -1);
            look_beside(s, s->grid.part + q, a, s->grid.part[q].n[a] + 1);
        }
    }
}

/* change: of a variation, which is 0 on the surface. */
static double flux_of(const struct fv *s, int a, const struct wet_face *x, const double *psi,
                      bool change)
{
    const struct surface_mesh *w = s->surface->mesh;
    double F = x->cut >= 0 && !change ? x->given * s->surface->cut[a][x->cut].p : 0.0;
    for (int k = x->first; k < x->first + x->n; k++)
        F += w->weight[k] * psi[w->at[k]];
    return F;
}

void surface_mesh_fluxes(const struct fv *s, double tau, const double *psi)
{
    const struct surface_mesh *w = s->surface->mesh;
    for (int a = 0; a < s->dim; a++)
        for (int64_t k = 0; k < w->nface[a]; k++)
            s->U[a][w->face[a][k].face] -= tau * flux_of(s, a, w->face[a] + k, psi, false);
}

void surface_mesh_interpolate(const struct fv *s, const double *d, double *const G[3])
{
    const struct surface_mesh *w = s->surface->mesh;
    for (int a = 0; a < s->dim; a++)
        for (int64_t k = 0; k < w->nface[a]; k++) {
            const struct wet_face *x = w->face[a] + k;
            const int64_t c = x->face, below = c - grid_part(&s->grid, c, NULL)->stride[a];
            const double each = is_wet(s, below) ? d[below] : d[c],
                         other = is_wet(s, c) ? d[c] : d[below];
            double mean = 0.0;
            for (int q = 0; q < s->dim; q++)
                mean += 0.5 * (G[q][c] + G[q][below]) * s->m->S[a][q][c];
            s->U[a][c] += 0.5 * (each + other) * (mean - flux_of(s, a, x, s->p, false));
        }
}

void surface_mesh_add_pressure(const struct fv *s, double tau, double *div)
{
    const struct surface_mesh *w = s->surface->mesh;
    for (int a = 0; a < s->dim; a++)
        for (int64_t k = 0; k < w->nface[a]; k++) {
            const struct wet_face *x = w->face[a] + k;
            if (x->cut < 0)
                continue;
            const struct cut *cut = s->surface->cut[a] + x->cut;
            if (s->m->status[cut->wet] == CELL_COMPUTED)
                div[cut->wet] -= cut->up * tau * x->given * cut->p;
        }
}

/* Fluxes of psi through the lower faces along a of a part's cells. */
static void face_fluxes(const struct fv *s, const struct part *p, int a, const double *psi,
                        double *out)
{
    const struct mesh *m = s->m;
    const int64_t d = p->stride[a];
    int up[3] = {0, 0, 0};
    up[a] = 1;
    PART_ROWS (p, no_layers, up, c, n)
        for (int64_t i = c; i < c + n; i++) {
            double F = m->G[a][a][i] * (psi[i] - psi[i - d]);
            for (int t = 0; t < m->dim; t++) {
                const int64_t b = p->stride[t];
                if (t != a && m->G[a][t][i] != 0.0)
                    F += 0.25 * m->G[a][t][i] *
                         (psi[i + b] - psi[i - b] + psi[i - d + b] - psi[i - d - b]);
            }
            out[i] = s->surface->open[a][i] * F;
        }
}

/* Whether a cell is dry and FV's own. */
static bool is_air(const struct fv *s, int64_t c) { return is_dry(s, c) && !is_given(s, c); }

/* Whether the fourth-order gradient of a cell has dry ones in it. */
static bool leaves_water(const struct fv *s, const struct part *p, int64_t c)
{
    const bool even = p->kind == PART_EVEN;
    for (int a = 0; a < s->dim; a++)
        for (int m = -2; m <= 2; m++) {
            const int64_t at = c + m * p->stride[a];
            if (is_air(s, at))
                return true;
            for (int t = 0; t < s->dim && !even; t++)
                if (t != a && (is_air(s, at - p->stride[t]) || is_air(s, at + p->stride[t])))
                    return true;
        }
    return false;
}

/* grad psi of a cell by the fluxes through its faces. */
static void mean_of_faces(const struct fv *s, const struct part *p, int64_t c, double *const F[3],
                          double *const out[3])
{
    double *const *x = s->surface->mesh->x;
    for (int k = 0; k < s->dim; k++) {
        double sum = 0.0;
        for (int a = 0; a < s->dim; a++) {
            const int64_t d = p->stride[a];
            sum += 0.25 * (x[k][c + d] - x[k][c - d]) * (F[a][c] + F[a][c + d]);
        }
        out[k][c] = sum / s->m->V[c];
    }
}

/* Into a partner's cells fluxes go on as they come. Cells beside them whose one-sided gradients
 * would leave the water, too, have the faces'. */
static void gradient_beside_partner(const struct fv *s, double *const F[3], double *const out[3])
{
    const struct forcing *g = s->forcing;
    const int64_t *place;
    int64_t cell, n;
    for (int a = 0; a < s->dim; a++)
        for (int64_t i = 0; i < g->nface[a]; i++) {
            const int64_t face = g->face[a][i], d = grid_part(&s->grid, face, NULL)->stride[a];
            if (g->counts[a][i])
                F[a][face] = F[a][face - g->sign[a][i] * d];
        }
    for (int64_t i = 0; given_stencil(g, i, &cell, &n, &place); i++) {
        bool leaves = false;
        for (int64_t k = 0; k < n; k++)
            leaves = leaves || is_air(s, place[k]);
        if (leaves && s->free[cell] > 0.0)
            mean_of_faces(s, grid_part(&s->grid, cell, NULL), cell, F, out);
    }
}

void surface_mesh_psi_gradient(const struct fv *s, double tau, const double *psi, bool change,
                               double *const out[3])
{
    const struct surface_mesh *w = s->surface->mesh;
    double *const F[3] = {s->surface->rate, s->surface->kept, s->surface->phi_new};
    for (int a = 0; a < s->dim; a++) {
        for (int q = 0; q < s->grid.nparts; q++)
            face_fluxes(s, s->grid.part + q, a, psi, F[a]);
        for (int64_t k = 0; k < w->nface[a]; k++)
            F[a][w->face[a][k].face] = flux_of(s, a, w->face[a] + k, psi, change);
        if (!change)
            mesh_bc_slope_fluxes(s, tau, a, F[a]);
    }
    if (s->surface->forced)
        gradient_beside_partner(s, F, out);
    for (int q = 0; q < s->grid.nparts; q++) {
        const struct part *p = s->grid.part + q;
        PART_ROWS (p, no_layers, no_layers, c, n)
            for (int64_t i = c; i < c + n; i++)
                if (s->free[i] > 0.0 && leaves_water(s, p, i))
                    mean_of_faces(s, p, i, F, out);
    }
    surface_mesh_line_slopes(s, psi, change, out);
}
