/* even_probes.c - what gauges read on uniform cells and layers: by polynomials (even_value.c); near
 * and under a surface pressures, and what else has no room for them, linear between the centres of
 * cells and beyond them at a wall; past boxes that are cut out.
 * SPDX-License-Identifier: BSD-3-Clause */

#include "../boundary/fv_boundary.h"
#include "../surface/fv_surface.h"
#include "even_value.h"
#include "output.h"
#include "probe_flow.h"

/* The layer below y, so that it and the next one are layers of the grid; *weight of the next. */
static int row_below(const struct block *b, double y, double *weight)
{
    const double *e = b->rows->edge;
    int i = 0;
    while (i < b->cells[1] - 2 && 0.5 * (e[i + 1] + e[i + 2]) <= y)
        i++;
    *weight = (y - 0.5 * (e[i] + e[i + 1])) / (0.5 * (e[i + 2] - e[i]));
    return i;
}

/* The same of cells along axis a. */
static int base(const struct block *b, int a, double x, double *weight)
{
    if (a == 1 && b->rows)
        return row_below(b, x, weight);
    const double at = (x - b->origin[a]) / b->h[a] - 0.5;
    int i = (int)floor(at);
    if (!b->periodic[a])
        i = i < 0 ? 0 : i > b->cells[a] - 2 ? b->cells[a] - 2 : i;
    *weight = at - i;
    return b->periodic[a] ? (i % b->cells[a] + b->cells[a]) % b->cells[a] : i;
}

/* The index in a field of the cell that x lies in. */
static int64_t host_at(const struct fv *s, const int *i, const double *w)
{
    int host[3];
    even_host(s, i, w, host);
    return block_at(&s->b, host[0], host[1], host[2]);
}

/* A gauge that lies in a box, whose faces went to those of cells, belongs to the given face that is
 * next: the first free cell there. Ties go to the lower axis. */
static void leave_box(const struct fv *s, const double *x, int *host)
{
    const int box = s->blocked->box[block_at(&s->b, host[0], host[1], host[2])] - 1;
    double nearest = INFINITY;
    int axis = 0, way = 1;
    for (int a = 0; a < s->b.dim && box >= 0; a++)
        for (int up = 0; up < 2; up++) {
            const double *face = up ? s->prm.boxes[box].max : s->prm.boxes[box].min;
            int to[3] = {host[0], host[1], host[2]};
            to[a] += up ? 1 : -1;
            if (even_is_solid(s, to) || !(fabs(face[a] - x[a]) < nearest))
                continue;
            nearest = fabs(face[a] - x[a]);
            axis = a;
            way = up ? 1 : -1;
        }
    if (nearest < INFINITY)
        host[axis] += way;
}

/* The two cells along each axis: free ones, where a box is next beyond it two on this side. Weights
 * may be outside of [0, 1] then. */
static void look_past_boxes(const struct fv *s, const double *x, int *i, double *w)
{
    const struct block *b = &s->b;
    int host[3];
    even_host(s, i, w, host);
    leave_box(s, x, host);
    for (int a = 0; a < b->dim; a++) {
        double at = (x[a] - b->origin[a]) / b->h[a] - 0.5 - b->lo[a];
        if (b->periodic[a]) /* of the image that locate has taken */
            at += b->cells[a] * rint((i[a] + w[a] - at) / b->cells[a]);
        const bool up = at >= host[a];
        int to[3] = {host[0], host[1], host[2]};
        to[a] += up ? 1 : -1;
        i[a] = host[a] - (up == even_is_solid(s, to));
        w[a] = at - i[a];
    }
}

/* A corner of the cells around may still lie in a box: the host's value there. q NULL: pressure. */
static double corner_of(const struct fv *s, const double *q, const int *at, const int *i,
                        const double *w)
{
    int64_t c = block_at(&s->b, at[0], at[1], at[2]);
    if (is_blocked(s, c))
        c = host_at(s, i, w);
    return q ? q[c] : fv_pressure(s, c);
}

/* The cells about x and their weights. false: the lower one is another rank's. i counts from this
 * rank's first cell. */
static bool locate(const struct fv *s, const double *x, int i[3], double w[3])
{
    const struct block *b = &s->b;
    for (int a = 0; a < 3; a++) {
        i[a] = 0;
        w[a] = 0.0;
    }
    for (int a = 0; a < b->dim; a++) {
        i[a] = base(b, a, x[a], w + a) - b->lo[a];
        if (i[a] < 0 || i[a] >= b->n[a])
            return false;
    }
    return true;
}

/* Sum over the 2^dim cells about the gauge; q NULL: pressure, Pa. */
static double linear(const struct fv *s, const double *q, const int *i, const double *w)
{
    double sum = 0.0;
    for (int m = 0; m < 1 << s->b.dim; m++) {
        double f = 1.0;
        int at[3];
        for (int a = 0; a < 3; a++) {
            const int up = m >> a & 1;
            at[a] = i[a] + up;
            f *= up ? w[a] : 1.0 - w[a];
        }
        sum += f * corner_of(s, q, at, i, w);
    }
    return sum;
}

/* Whether x lies between a wall, of the domain or a box, and the centre beside it along axis a. */
static bool is_at_wall(const struct fv *s, int a, const int *i, const double *w)
{
    const bool up = w[a] > 1.0;
    const int cell = s->b.lo[a] + i[a] + up;
    if (w[a] >= 0.0 && !up)
        return false;
    return cell != (up ? s->b.cells[a] - 1 : 0) || side_is_wall(s->bc->kind[2 * a + up]);
}

/* Pressure under a surface is linear: it may have kinks where water hits. Before a wall it levels
 * off (probe_weight_at_wall). */
static double value_of(const struct fv *s, const double *q, const double *x, const int *i,
                       const double *w)
{
    double value, weight[3] = {w[0], w[1], w[2]};
    if ((q || !s->surface) && even_value(s, q, x, i, w, &value))
        return value;
    for (int a = 0; a < s->dim && !q; a++)
        if (s->surface && is_at_wall(s, a, i, w))
            weight[a] = w[a] < 0.0 ? probe_weight_at_wall(0.5 + w[a])
                                   : 1.0 - probe_weight_at_wall(1.5 - w[a]);
    return linear(s, q, i, weight);
}

/* Whether water is at a place of this rank. */
static bool find_water(const struct fv *s, const double *x, int i[3], double w[3])
{
    if (!locate(s, x, i, w))
        return false;
    if (s->blocked)
        look_past_boxes(s, x, i, w);
    return !s->surface || s->surface->layer[host_at(s, i, w)] == 0;
}

/* 0 unless the lower cell is this rank's own. */
static void point_of(const struct fv *s, const double *x, int nq, double *const *q, double *here)
{
    int i[3];
    double w[3];
    if (!find_water(s, x, i, w))
        return;
    for (int a = 0; a < nq; a++)
        here[a] = value_of(s, q[a], x, i, w);
    here[nq] = -1.0;
}

/* Velocity at a sample, and the distance to the surface there; without a surface -step, so that all
 * of it is wet. */
static void look_at(const struct fv *s, const struct flow_samples *f, const double *x, int *i,
                    double *w, double *v)
{
    if (s->blocked)
        look_past_boxes(s, x, i, w);
    for (int a = 0; a < s->dim; a++)
        v[a] = f->across[a] != 0.0 ? value_of(s, s->u[a], x, i, w) : 0.0;
    v[3] = s->surface ? linear(s, s->surface->phi, i, w) : -f->step;
}

/* The cell of this rank that x lies in, and how far from its lower faces, in its sizes: all faces
 * of an own cell are known, of ghosts some are not. false: it is another rank's. */
static bool cell_around(const struct block *b, const double *x, int cell[3], double at[3])
{
    for (int a = 0; a < 3; a++) {
        const int n = b->cells[a];
        double place = a < b->dim ? (x[a] - b->origin[a]) / b->h[a] : 0.0;
        if (a == 1 && b->rows) {
            const double *e = b->rows->edge;
            const int row = lookup_row(e, 1, n, x[a]);
            place = row + (x[a] - e[row]) / (e[row + 1] - e[row]);
        }
        int i = (int)floor(place);
        if (!b->periodic[a])
            i = i < 0 ? 0 : i > n - 1 ? n - 1 : i;
        at[a] = place - i;
        cell[a] = (b->periodic[a] ? (i % n + n) % n : i) - b->lo[a];
        if (cell[a] < 0 || cell[a] >= b->n[a])
            return false;
    }
    return true;
}

/* Beyond closed sides nothing flows. */
static bool is_outside(const struct block *b, const double *x)
{
    bool out = false;
    for (int a = 0; a < b->dim; a++)
        out =
            out || (!b->periodic[a] && (x[a] < b->origin[a] || x[a] > b->origin[a] + b->length[a]));
    return out;
}

/* What crosses a sample by the faces of its cell, so that a section has the discharge of what flows
 * into and out of the scene, whatever the profile beside corners of boxes: the projected fluxes
 * without a surface; where cells keep their share of water what crossed them in the last advance,
 * so that films and jets which phi does not resolve count. All of the sample is wet. Samples of
 * equal parts are more or fewer to a cell, and made a film of one cell 20 % thicker. */
static void look_at_faces(const struct fv *s, const struct flow_samples *f, const double *x,
                          double *v)
{
    int cell[3];
    double at[3];
    if (!cell_around(&s->b, x, cell, at))
        return;
    const int64_t c = block_at(&s->b, cell[0], cell[1], cell[2]);
    if (is_blocked(s, c))
        return;
    for (int a = 0; a < s->dim; a++) {
        const double *U = s->U[a] + c;
        v[a] = f->across[a] == 0.0 ? 0.0
               : s->surface        ? fraction_passed(s, c, a, at[a])
                                   : (1.0 - at[a]) * U[0] + at[a] * U[s->b.stride[a]];
    }
    v[3] = -f->step;
}

/* This rank's samples; those in boxes and outside are dry. */
static double discharge_of(struct fv *s, int gauge, const struct scene_probe *g)
{
    (void)gauge;
    struct fraction *fraction = s->surface ? s->surface->fraction : NULL;
    const bool faces =
        s->surface ? fraction && fraction->passed_time > 0.0 : s->blocked && s->step.dt > 0.0;
    if (fraction)
        fraction->was_read = 1.0;
    struct flow_samples f = faces ? flow_samples_of_cells(s, g) : flow_samples_create(s, g);
    for (int k = 0; k < f.n; k++) {
        int i[3];
        double w[3];
        f.value[k][3] = f.step;
        if (is_outside(&s->b, f.x[k]))
            continue;
        if (faces)
            look_at_faces(s, &f, f.x[k], f.value[k]);
        else if (locate(s, f.x[k], i, w) && !is_blocked(s, host_at(s, i, w)))
            look_at(s, &f, f.x[k], i, w, f.value[k]);
    }
    const double sum = flow_samples_sum(&f, s->dim);
    flow_samples_free(&f);
    return sum;
}

static double level_of(struct fv *s, int gauge, const double *x)
{
    (void)gauge;
    return surface_level(s, x);
}

const struct probe_reader even_reader = {
    .point = point_of, .level = level_of, .discharge = discharge_of};
