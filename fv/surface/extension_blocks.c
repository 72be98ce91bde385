/* extension_blocks.c - windows of cells of blocks, along the indices that lead into the water
 * (extension_window.h); dry cells that other blocks interpolate are not known.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "extension_window.h"

#include "levelset.h"
#include "mesh_view.h"

enum { OWN = 5 };

static double mean_size(const struct fv *s, int64_t c)
{
    return s->dim == 2 ? sqrt(s->m->V[c]) : cbrt(s->m->V[c]);
}

/* The shift of a window and the index along which the cell's faces are most across gravity. */
static void lie(const struct fv *s, int64_t c, struct place *p)
{
    const struct mesh *m = s->m;
    double most = -1.0;
    for (int a = 0; a < 3; a++) {
        double along = 0.0, size = 0.0, down = 0.0;
        p->shift[a] = 0;
        for (int k = 0; k < m->dim && a < m->dim; k++) {
            const double S = m->S[a][k][c] + m->S[a][k][c + p->part->stride[a]];
            along += p->e[0][k] * S;
            down += s->gravity.hydrostatic[k] * S;
            size += S * S;
        }
        if (a < m->dim)
            p->shift[a] = -(int)lround(1.2 * along / sqrt(size));
        if (a < m->dim && fabs(down) > most * sqrt(size)) {
            most = fabs(down) / sqrt(size);
            p->upright = a;
        }
    }
}

/* The window is moved by 1.2 cells against the normal, along the indices that lead into the water;
 * places are measured from the foot point in the frame of the surface, in cells. */
static void look_around(const struct fv *s, int64_t c, int layer, struct place *p)
{
    const struct mesh *m = s->m;
    const struct surface_mesh *w = s->surface->mesh;
    const struct part *part = p->part;
    const int reach = window_reach(s, layer), deep = m->dim == 3 ? reach : 0;
    int n = 0;
    p->room = 0;
    lie(s, c, p);
    const int *shift = p->shift;
    for (int k = -deep; k <= deep; k++)
        for (int j = -reach; j <= reach; j++)
            for (int i = -reach; i <= reach; i++) {
                const int64_t step = shift[0] + i + (shift[1] + j) * part->stride[1] +
                                     (shift[2] + k) * part->stride[2];
                const int64_t at = c + step;
                double x[3];
                for (int a = 0; a < 3; a++)
                    x[a] = w->x[a][at] - w->x[a][c] + p->depth * p->e[0][a];
                for (int a = 0; a < 3; a++)
                    p->r[a][n] =
                        (x[0] * p->e[a][0] + x[1] * p->e[a][1] + x[2] * p->e[a][2]) / p->spacing;
                p->step[n] = (int)step;
                const int of = s->surface->layer[at];
                p->room += !w->out[at];
                const bool known =
                    !w->out[at] && of < layer && (of == 0 || m->status[at] == CELL_COMPUTED);
                p->mixed = p->mixed || (known && m->status[at] == CELL_FRINGE);
                n += known;
            }
    window_fill_lanes(p, n);
}

static void begin(struct fv *s)
{
    struct surface_mesh *w = s->surface->mesh;
    memset(w->keep, 0, (size_t)s->size);
    s->m->fringe.keep = w->keep;
}

/* Dry cells of the fringe are extended in the first layer alone, and kept only where is_own says
 * so. */
static bool is_wanted(const struct fv *s, int64_t c, int layer)
{
    const enum mesh_status is = s->m->status[c];
    return is == CELL_COMPUTED || (is == CELL_FRINGE && layer == 1);
}

/* A dry cell of the fringe whose block has water of its own beside it: what donors have there comes
 * from another block's surface, and where the surface runs along a block's side the two drive each
 * other. */
static bool is_own(const struct fv *s, int64_t c, const struct place *p)
{
    int own = 0;
    if (s->m->status[c] != CELL_FRINGE)
        return true;
    for (int k = 0; k < p->known; k++)
        own += s->m->status[c + p->step[k]] == CELL_COMPUTED;
    s->surface->mesh->keep[c] = own >= (s->dim == 2 ? OWN : 3 * OWN);
    return s->surface->mesh->keep[c];
}

const struct window_ops block_window = {.size = mean_size,
                                        .look_around = look_around,
                                        .begin = begin,
                                        .is_wanted = is_wanted,
                                        .is_own = is_own};
