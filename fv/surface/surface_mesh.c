/* surface_mesh.c - see mesh_view.h. SPDX-License-Identifier: BSD-3-Clause */
#include "levelset.h"
#include "mesh_view.h"

#include "../boundary/fv_boundary.h"
#include "../grid/fv_grid.h"

/* Mean distance of neighbouring vertices along axis a of the whole block: the same on all ranks. */
static double mean_spacing(const struct mesh_block *b, int dim, int a)
{
    double sum = 0.0;
    int64_t n = 0;
    int i[3];
    for (i[2] = 0; i[2] <= (dim == 3 ? b->n[2] : 0); i[2]++)
        for (i[1] = 0; i[1] <= b->n[1]; i[1]++)
            for (i[0] = 0; i[0] <= b->n[0]; i[0]++) {
                int up[3] = {i[0], i[1], i[2]};
                if (i[a] == b->n[a])
                    continue;
                up[a]++;
                const double *x = b->x[mesh_vertex(b, i[0], i[1], i[2])],
                             *y = b->x[mesh_vertex(b, up[0], up[1], up[2])];
                sum += hypot(hypot(y[0] - x[0], y[1] - x[1]), y[2] - x[2]);
                n++;
            }
    return sum / (double)n;
}

bool surface_inclined(const struct fv *s, const struct part *p)
{
    return s->surface->inclined[p - s->grid.part];
}

bool surface_any_inclined(const struct fv *s) { return s->surface->any_inclined; }

/* Whether some edge of the block is neither along gravity nor across it. */
static bool is_slanting(const struct fv *s, const struct mesh_block *b)
{
    const double *g = s->gravity.hydrostatic, g2 = g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
    int i[3];
    for (i[2] = 0; i[2] <= (s->dim == 3 ? b->n[2] : 0); i[2]++)
        for (i[1] = 0; i[1] <= b->n[1]; i[1]++)
            for (i[0] = 0; i[0] <= b->n[0]; i[0]++)
                for (int a = 0; a < s->dim; a++) {
                    int up[3] = {i[0], i[1], i[2]};
                    double along = 0.0, size = 0.0;
                    if (up[a]++ == b->n[a])
                        continue;
                    const double *x = b->x[mesh_vertex(b, i[0], i[1], i[2])],
                                 *y = b->x[mesh_vertex(b, up[0], up[1], up[2])];
                    for (int k = 0; k < s->dim; k++) {
                        along += g[k] * (y[k] - x[k]);
                        size += (y[k] - x[k]) * (y[k] - x[k]);
                    }
                    const double cosine2 = along * along / (g2 * size);
                    if (cosine2 > 1e-6 && cosine2 < 1.0 - 1e-6)
                        return true;
                }
    return false;
}

/* Ghosts too, by the block's mapping beyond its ends. */
static void set_centres(const struct fv *s, const struct part *p, struct surface_mesh *w)
{
    const struct mesh *m = s->m;
    int i[3];
    PART_ALL (p, i, c) {
        const int at[3] = {p->lo[0] + i[0], p->lo[1] + i[1], p->lo[2] + i[2]};
        double x[3], dx[3][3];
        mesh_map_point(m->block + p->block, m->dim, at, (double[3]){0.5, 0.5, 0.5}, x, dx);
        for (int a = 0; a < 3; a++)
            w->x[a][c] = x[a];
    }
}

/* grad xi_a of a cell, 1/m. */
static void index_gradients(const struct mesh *m, const struct part *p, int64_t c, double g[3][3])
{
    for (int a = 0; a < m->dim; a++)
        for (int k = 0; k < m->dim; k++)
            g[a][k] = 0.5 * (m->S[a][k][c] + m->S[a][k][c + p->stride[a]]) / m->V[c];
}

/* Of the step from one centre to another along a unit vector e: its length; *off: across it. */
static double length_along(const struct surface_mesh *w, int64_t from, int64_t to, const double *e,
                           double *off)
{
    double d[3], along = 0.0, square = 0.0;
    for (int k = 0; k < 3; k++) {
        d[k] = w->x[k][to] - w->x[k][from];
        along += d[k] * e[k];
        square += d[k] * d[k];
    }
    *off = sqrt(fmax(0.0, square - along * along));
    return along;
}

/* Whether the lines of a part's cells are straight and at right angles, those of neighbours that
 * are seen through joins, too: then sets the places along them. Only what is a cell counts. */
static bool set_lines(const struct fv *s, const struct part *p, struct surface_mesh *w)
{
    const int q = (int)(p - s->grid.part);
    const int64_t first = part_at(p, 0, 0, 0);
    double e[3][3] = {{0.0}}, off;
    bool good = true;
    int i[3];
    for (int a = 0; a < s->dim; a++) {
        const double h = w->size[q][a];
        for (int k = 0; k < 3; k++)
            e[a][k] = (w->x[k][first + p->stride[a]] - w->x[k][first]) / h;
        const double size = vec3_length(e[a]);
        for (int k = 0; k < 3; k++)
            e[a][k] /= size;
    }
    for (int a = 0; a < s->dim; a++) {
        double *line = NEW_IN(w, double, p->n[a] + 2 * p->g[a]) + p->g[a];
        bool even = true;
        for (int k = -p->g[a]; k < p->n[a] + p->g[a]; k++) {
            line[k] = length_along(w, first, first + k * p->stride[a], e[a], &off);
            even = even && fabs(line[k] - k * w->size[q][a]) < 1e-9 * w->size[q][a];
        }
        w->line[q][a] = even ? NULL : line;
        PART_ALL (p, i, c) {
            const double x = length_along(w, first, c, e[a], &off), h = w->size[q][a];
            good = good && (w->out[c] || fabs(x - line[i[a]]) < 1e-6 * h);
        }
    }
    return good;
}

static void set_metric(const struct fv *s, const struct part *p, struct surface_mesh *w)
{
    const struct mesh *m = s->m;
    const double *size = w->size[p - s->grid.part];
    PART_ROWS (p, no_layers, no_layers, c, n)
        for (int64_t i = c; i < c + n; i++) {
            double g[3][3];
            index_gradients(m, p, i, g);
            for (int a = 0; a < m->dim; a++)
                for (int b = a; b < m->dim; b++) {
                    double dot = 0.0;
                    for (int k = 0; k < m->dim; k++)
                        dot += g[a][k] * g[b][k];
                    w->K[a][b][i] = dot * size[a] * size[b];
                }
        }
}

/* How far the step from a cell to the next along an index goes across gravity, m; infinite along
 * lines that are steeper than 45 degrees. */
static double across_gravity(const struct fv *s, const struct surface_mesh *w, int64_t c, int64_t d)
{
    const double *g = s->gravity.hydrostatic, size = vec3_length(g);
    double e2 = 0.0, up = 0.0;
    for (int k = 0; k < s->dim; k++) {
        const double e = 0.5 * (w->x[k][c + d] - w->x[k][c - d]);
        e2 += e * e;
        up += size > 0.0 ? e * g[k] / size : 0.0;
    }
    return up * up < 0.55 * e2 ? sqrt(e2 - up * up) : INFINITY;
}

static void set_sizes(const struct fv *s, const struct surface_mesh *w, struct surface *f)
{
    double ends[3] = {-INFINITY, 0.0, -INFINITY};
    for (int q = 0; q < s->grid.nparts; q++)
        PART_ROWS (s->grid.part + q, no_layers, no_layers, c, n)
            for (int64_t i = c; i < c + n; i++)
                for (int a = 0; a < s->dim && s->m->status[i] == CELL_COMPUTED; a++) {
                    const double h = w->size[q][a] / sqrt(w->K[a][a][i]);
                    ends[0] = fmax(ends[0], -h);
                    ends[1] = fmax(ends[1], h);
                    ends[2] = fmax(ends[2], -across_gravity(s, w, i, s->grid.part[q].stride[a]));
                }
    MPI_Allreduce(MPI_IN_PLACE, ends, 3, MPI_DOUBLE, MPI_MAX, s->comm);
    f->least = -ends[0];
    f->largest = ends[1];
    f->across = -ends[2];
}

/* Of a place that is no cell: behind how many outflows it lies. */
static unsigned char behind(const struct mesh *m, int block, const int *cell)
{
    int at[3] = {cell[0], cell[1], cell[2]};
    double move[3] = {0.0, 0.0, 0.0};
    bool odd = false;
    if (mesh_resolve(m, &block, at, move))
        return BEHIND_EVEN; /* a hole */
    const struct mesh_block *b = m->block + block;
    for (int a = 0; a < m->dim; a++)
        if (at[a] < 0 || at[a] >= b->n[a])
            odd ^= b->side[2 * a + (at[a] > 0)] == MESH_OUTFLOW;
    return odd ? BEHIND_ODD : BEHIND_EVEN;
}

static void set_part_out(const struct fv *s, const struct part *p, unsigned char *out)
{
    int i[3];
    PART_ALL (p, i, c) {
        const int at[3] = {p->lo[0] + i[0], p->lo[1] + i[1], p->lo[2] + i[2]};
        if (s->m->status[c] == CELL_HOLE)
            out[c] = behind(s->m, p->block, at);
    }
}

/* Heights of centres. */
static void set_height(const struct fv *s, struct surface_mesh *w)
{
    const double *g = s->gravity.hydrostatic, size = s->surface ? s->surface->g : 0.0;
    for (int64_t c = 0; c < s->size && size > 0.0; c++) {
        w->height[c] = 0.0;
        for (int k = 0; k < s->dim; k++)
            w->height[c] -= g[k] / size * w->x[k][c];
    }
}

/* Which places are no cells of the water: behind sides, holes, a partner's inner cells. */
static void set_out(const struct fv *s, struct surface_mesh *w)
{
    const struct forcing *g = s->forcing;
    memset(w->out, 0, (size_t)s->size * sizeof *w->out);
    for (int q = 0; q < s->grid.nparts; q++)
        set_part_out(s, s->grid.part + q, w->out);
    for (int64_t c = 0; g && c < s->size; c++)
        if (s->m->status[c] == CELL_GIVEN && !g->known[c])
            w->out[c] = BEHIND_EVEN;
}

/* sign = -1: phi less the height of places; 1: back. */
static void add_height(const struct fv *s, double sign, double *restrict phi)
{
    const double *restrict height = s->surface->mesh->height;
    for (int64_t c = 0; c < s->size; c++)
        phi[c] += sign * height[c];
}

void surface_mesh_fill(const struct fv *s, double *phi)
{
    const bool level = s->surface && s->m->has_fringe;
    if (level)
        add_height(s, -1.0, phi);
    mesh_fill(s->m, 1, &phi);
    if (level)
        add_height(s, 1.0, phi);
}

void surface_mesh_change_height(const struct fv *s, double sign, double *phi)
{
    add_height(s, sign, phi);
}

/* After blocks have moved: centres, heights, then what is out, which asks for the statuses of now.
 */
void surface_mesh_update(struct fv *s)
{
    for (int q = 0; q < s->grid.nparts; q++)
        if (s->m->block[s->m->part[q].block].motion)
            set_centres(s, s->grid.part + q, s->surface->mesh);
    set_height(s, s->surface->mesh);
    set_out(s, s->surface->mesh);
}

/* Metrics and overlaps of the blocks at time t, and what of the surface depends on them. */
void surface_mesh_place(struct fv *s, double t)
{
    mesh_motion_place(s->m, t);
    if (s->m->has_fringe)
        overset_find(s->m, s->m->search);
    surface_mesh_update(s);
}

struct surface_mesh *surface_mesh_create(const struct fv *s, struct surface *f)
{
    struct surface_mesh *w = NEW(struct surface_mesh, 1);
    int most = 1;
    if (s->m->moves) /* sizes are those of the start, to the last bit, after a restart, too */
        mesh_motion_place(s->m, 0.0);
    w->count = mem_own(w, mesh_field(s->m));
    w->height = mem_own(w, mesh_field(s->m));
    for (int k = 0; k < s->m->nblocks; k++)
        f->any_inclined = f->any_inclined || is_slanting(s, s->m->block + k);
    w->out = NEW_IN(w, unsigned char, s->size);
    w->keep = NEW_IN(w, unsigned char, s->size);
    for (int a = 0; a < 3; a++) {
        w->x[a] = mem_own(w, mesh_field(s->m));
        w->speed[a] = mem_own(w, mesh_field(s->m));
        for (int b = a; b < 3 && a < s->dim; b++)
            w->K[a][b] = mem_own(w, mesh_field(s->m));
    }
    for (int q = 0; q < s->grid.nparts; q++) {
        const struct part *p = s->grid.part + q;
        for (int a = 0; a < s->dim; a++)
            w->size[q][a] = mean_spacing(s->m->block + p->block, s->dim, a);
        f->inclined[q] = is_slanting(s, s->m->block + p->block);
        w->slants[q] = s->m->has_fringe || f->inclined[q];
        set_centres(s, p, w);
        set_metric(s, p, w);
        most = p->n[0] > most ? p->n[0] : most;
    }
    for (int a = 0; a < s->dim; a++)
        for (int up = 0; up < 2; up++)
            w->slopes[a][up] = NEW_IN(w, double, most);
    set_out(s, w);
    set_sizes(s, w, f);
    w->boxes = f->largest <= 8.0 * f->least; /* eight flat cells a wave are no cubics */
    for (int q = 0; q < s->grid.nparts; q++)
        w->boxes = set_lines(s, s->grid.part + q, w) && w->boxes;
    w->boxes = ranks_all(s->comm, w->boxes);
    if (s->m->moves)
        mesh_motion_place(s->m, s->t);
    return w;
}

double surface_mesh_spacing(const struct fv *s, const struct part *p)
{
    const double *size = s->surface->mesh->size[p - s->grid.part];
    double most = 0.0;
    for (int a = 0; a < s->dim; a++)
        most = fmax(most, size[a]);
    return most;
}

double surface_mesh_speeds(const struct fv *s, double band)
{
    const struct mesh *m = s->m;
    struct surface_mesh *w = s->surface->mesh;
    double most = 0.0;
    for (int q = 0; q < s->grid.nparts; q++) {
        const struct part *p = s->grid.part + q;
        const double near = band * surface_mesh_spacing(s, p);
        const bool moves = m->block[p->block].motion != NULL;
        PART_ROWS (p, no_layers, no_layers, c, n)
            for (int64_t i = c; i < c + n; i++) {
                double g[3][3], u[3], sum = 0.0;
                index_gradients(m, p, i, g);
                surface_foot_velocity(s, p, i, (const double(*)[3])g, u);
                for (int a = 0; a < m->dim; a++) {
                    double rate = 0.0;
                    if (moves)
                        rate = -0.5 * (m->grid[a][i] + m->grid[a][i + p->stride[a]]) / m->V[i];
                    for (int k = 0; k < m->dim; k++)
                        rate += u[k] * g[a][k];
                    w->speed[a][i] = rate * w->size[q][a];
                    sum += fabs(rate);
                }
                if (fabs(s->surface->phi[i]) < near && m->status[i] != CELL_HOLE)
                    most = fmax(most, sum);
            }
    }
    return ranks_max(s->comm, most);
}

void surface_mesh_gradient(const struct fv *s, const struct part *p, int64_t c, const double *phi,
                           double g[3])
{
    const struct surface_mesh *w = s->surface->mesh;
    double d[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}, rise[3] = {0.0, 0.0, 0.0};
    for (int a = 0; a < s->dim; a++) {
        rise[a] = phi[c + p->stride[a]] - phi[c - p->stride[a]];
        for (int k = 0; k < s->dim; k++)
            d[a][k] = w->x[k][c + p->stride[a]] - w->x[k][c - p->stride[a]];
    }
    const double J = mesh_determinant(d);
    for (int k = 0; k < 3; k++) { /* column k of the inverse: cofactors over J */
        const int q = (k + 1) % 3, r = (k + 2) % 3;
        g[k] = 0.0;
        for (int a = 0; a < 3; a++) {
            const int u = (a + 1) % 3, v = (a + 2) % 3;
            g[k] += rise[a] * (d[u][q] * d[v][r] - d[u][r] * d[v][q]) / J;
        }
    }
}

void surface_mesh_metric(const struct fv *s, int64_t c, double K[3][3])
{
    for (int a = 0; a < s->dim; a++)
        for (int b = a; b < s->dim; b++)
            K[a][b] = K[b][a] = s->surface->mesh->K[a][b][c];
}
