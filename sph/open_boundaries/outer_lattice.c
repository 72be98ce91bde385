/* outer_lattice.c - see outer_lattice.h. Behind every face stands a row of places of the lattice
 * that would move in with its flow: shifted by what the face holds (openings.c), at the flow
 * outside, of volume dx^D. Their places follow from the faces alone, which every rank knows, so
 * that no messages are needed. Made with each new list, moved at each stage.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "outer_lattice.h"

#include "../parallel/domain.h"
#include "../particles/sph_particles.h"
#include "openings.h"
#include "wet_faces.h"
#include "zones.h"

/* Adds one ghost at y if this rank can see it. */
static void add_ghost(struct sph *s, const double *y, const double *lo, const double *hi,
                      double reach)
{
    struct openings *o = s->zones->openings;
    for (int a = 0; a < o->dim; a++)
        if (y[a] < lo[a] - reach || y[a] > hi[a] + reach)
            return;
    ROOM_IN(o, o->ghost_x, 3 * (o->nghost + 1));
    memcpy(o->ghost_x + 3 * (size_t)o->nghost++, y, 3 * sizeof *y);
}

/* Lattice places beyond side `side'. Axes before the side's own stay inside, so that an edge is
 * counted once; behind walls there are none. Only places that this rank's box, enlarged by the
 * reach of its lists, can see. */
static void list_side(struct sph *s, int side, const double *lo, const double *hi, double reach)
{
    const struct openings *o = s->zones->openings;
    const int axis = side / 2, layers = (int)ceil(reach / o->dx) + 2;
    int first[3] = {0, 0, 0}, last[3] = {0, 0, 0}, I[3];
    for (int b = 0; b < o->dim; b++) {
        const bool low = o->bounded[b] && (b < axis || !o->open[2 * b]);
        const bool high = o->bounded[b] && (b < axis || !o->open[2 * b + 1]);
        const int i = (int)floor((lo[b] - reach - o->lo[b]) / o->dx) - 2;
        const int j = (int)floor((hi[b] + reach - o->lo[b]) / o->dx) + 2;
        first[b] = low && i < 0 ? 0 : i;
        last[b] = high && j >= o->cells[b] ? o->cells[b] - 1 : j;
    }
    first[axis] = side % 2 ? o->cells[axis] : -layers;
    last[axis] = side % 2 ? o->cells[axis] + layers - 1 : -1;
    for (I[2] = first[2]; I[2] <= last[2]; I[2]++)
        for (I[1] = first[1]; I[1] <= last[1]; I[1]++)
            for (I[0] = first[0]; I[0] <= last[0]; I[0]++) {
                double y[3] = {0.0, 0.0, 0.0};
                if (o->room[openings_face(o, side, I)] < 0.5)
                    continue;
                for (int b = 0; b < o->dim; b++) {
                    y[b] = o->lo[b] + (I[b] + (b == axis ? 0.5 : o->law->along)) * o->dx;
                    const int beyond = I[b] < 0 ? 2 * b : I[b] >= o->cells[b] ? 2 * b + 1 : -1;
                    if (beyond >= 0 && o->open[beyond])
                        y[b] += o->shift[openings_face(o, beyond, I)];
                }
                add_ghost(s, y, lo, hi, reach);
            }
}

/* With each new list, last of all ghosts: places are those of the step's start, `ghost_t', from
 * which outer_lattice_move carries them. */
void outer_lattice_ghosts(struct sph *s)
{
    struct openings *o = s->zones->openings;
    double lo[3], hi[3];
    const double reach = s->R + s->lists.skin;
    domain_bounds(s->domain, lo, hi);
    o->nghost = 0;
    for (int side = 0; side < 2 * o->dim; side++) {
        const int a = side / 2;
        const double d = side % 2 ? o->hi[a] - hi[a] : lo[a] - o->lo[a];
        if (o->open[side] && d < reach)
            list_side(s, side, lo, hi, reach);
    }
    if (s->zones->surface)
        wet_faces_ghosts(s);
    o->first_ghost = s->p.nghost;
    particles_reserve(&s->p, s->p.n + s->p.nghost + o->nghost);
    s->p.nghost += o->nghost;
    o->ghost_t = s->t;
    outer_lattice_move(s);
}

/* They drift with the flow outside within the step. With no slopes, but the transport velocity of
 * the flow outside. */
void outer_lattice_move(struct sph *s)
{
    struct openings *o = s->zones->openings;
    struct zones *z = s->zones;
    const int dim = o->dim;
    const double dt = s->t - o->ghost_t;
    z->n = 0;
    zones_room(z, o->nghost);
    z->n = o->nghost;
    memcpy(z->x, o->ghost_x, 3 * (size_t)o->nghost * sizeof *z->x);
    zones_look(z, s->t, false);
    for (int k = 0; k < o->nghost; k++) {
        const int i = s->p.n + o->first_ghost + k;
        double *line = prim_line(&s->p, i), *g = slope_line(&s->p, i);
        const double *u = z->u + (size_t)dim * k;
        const double rho = eos_rho(z->p[k], s->rho0, s->c0, s->gamma);
        memset(g, 0, (size_t)s->p.nslope * sizeof *g);
        for (int a = 0; a < dim; a++) {
            line[a] = o->ghost_x[3 * (size_t)k + a] + dt * u[a];
            line[dim + a] = u[a];
            g[dim + dim * dim + a] = s->prm.transport == TRANSPORT_EULERIAN ? 0.0 : u[a];
        }
        line[at_volume(dim)] = s->dxD;
        line[at_rho(dim)] = rho;
        if (dim == 2)
            line[PRIM_FALSE] = 0.0;
    }
}
