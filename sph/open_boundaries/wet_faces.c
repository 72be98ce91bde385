/* wet_faces.c - see wet_faces.h. All from the level set phi of the water outside: phi < 0 in it.
 * Each function looks at the points of its own list (zones->x), so that zones_look's list does not
 * hold any longer after them.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "wet_faces.h"

#include "../walls/sph_walls.h"
#include "zones.h"

/* Share of the unit square around 0 where phi + n0 s + n1 t < 0, n0 >= n1 >= 0: corners that stand
 * over the line taken out. The area of a polygon in closed form, as in volume-of-fluid methods
 * (Scardovelli & Zaleski, J. Comput. Phys. 164, 2000). */
static double below(double phi, double n0, double n1)
{
    const double sum = n0 + n1;
    if (fabs(phi) >= 0.5 * sum)
        return phi < 0.0 ? 1.0 : 0.0;
    const double alpha = 0.5 * sum - phi;
    if (n1 < 1e-6 * n0)
        return alpha / sum;
    double area = alpha * alpha;
    area -= alpha > n0 ? (alpha - n0) * (alpha - n0) : 0.0;
    area -= alpha > n1 ? (alpha - n1) * (alpha - n1) : 0.0;
    return area / (2.0 * n0 * n1);
}

/* g: slope of phi at the face, which is a line in 2D, a square in 3D. */
double wet_faces_share(int dim, int axis, double dx, double phi, const double *g)
{
    double n[2] = {0.0, 0.0};
    int m = 0;
    for (int a = 0; a < dim; a++)
        if (a != axis)
            n[m++] = fabs(g[a]) * dx;
    return below(phi, fmax(n[0], n[1]), fmin(n[0], n[1]));
}

/* All faces at one time: the partner's field is evaluated in one go. */
void wet_faces_find(struct sph *s, double t)
{
    struct zones *z = s->zones;
    struct openings *o = z->openings;
    const int n = openings_faces(o);
    zones_room(z, n);
    z->n = n;
    for (int f = 0; f < n; f++)
        (void)openings_place(o, f, z->x + 3 * f);
    zones_look_at_surface(z, t);
    for (int side = 0; side < 2 * o->dim; side++)
        for (int f = o->first[side]; f < o->first[side + 1]; f++)
            o->share[f] =
                o->room[f] * wet_faces_share(o->dim, side / 2, o->dx, z->phi[f], z->gphi + 3 * f);
}

/* Goes down from where the particle leaves to the first face that is wet, at most three rows; from
 * higher up it is a drop and is counted as one. */
int wet_faces_for(struct sph *s, int side, const double *x)
{
    const struct openings *o = s->zones->openings;
    const int up = zones_upright(s), rows = o->cells[up];
    double y[3] = {0.0, 0.0, 0.0};
    memcpy(y, x, (size_t)o->dim * sizeof *y);
    if (!s->zones->surface)
        return openings_face_at(o, side, y);
    for (int k = 0; k <= rows; k++) {
        const int f = openings_face_at(o, side, y);
        if (o->share[f] > 0.0) /* further above than its own height it is a drop */
            return k <= 3 ? f : -1;
        y[up] += s->gravity[up] < 0.0 ? -o->dx : o->dx;
    }
    return -1;
}

/* Within two rows of a closed side, or of a line. */
static bool is_film(const struct sph *s, const double *y)
{
    const double near = 2.0 * s->dx;
    for (int side = 0; side < 2 * s->dim; side++) {
        const int a = side / 2;
        if (!s->open[side] && !s->periodic[a] && zones_inside(s->lo, s->hi, side, y) < near)
            return true;
    }
    return s->dim == 2 && s->walls && walls_distance(s->walls, y, near) < near;
}

void wet_faces_rain(struct sph *s, const double *y)
{
    struct openings *o = s->zones->openings;
    o->rain[0] += y[at_mass(o->dim)];
    o->films += is_film(s, y) ? y[at_mass(o->dim)] : 0.0;
    for (int a = 0; a < o->dim; a++)
        o->rain[1 + a] += y[o->dim + a];
    o->drops++;
}

/* kg: what faces lack beyond the deficit that they may have. */
double wet_faces_voids(const struct sph *s)
{
    const struct openings *o = s->zones->openings;
    const double least = openings_max_deficit * s->rho0 * s->dxD;
    double sum = 0.0;
    for (int f = 0; f < openings_faces(o); f++)
        sum += fmax(-o->mass[f] - least, 0.0);
    return sum;
}

/* Along the gradient, by one Newton step of phi = -depth. */
void wet_faces_lower(struct sph *s, double depth, int n, double *x)
{
    for (int k = 0; k < n; k++) {
        double phi, g[3], size2 = 0.0;
        s->zones->surface(s->zones->ctx, s->t, 1, x + 3 * k, &phi, g);
        if (phi <= -depth)
            continue;
        for (int a = 0; a < s->dim; a++)
            size2 += g[a] * g[a];
        for (int a = 0; a < s->dim && size2 > 0.0; a++)
            x[3 * k + a] -= (phi + depth) * g[a] / size2;
    }
}

/* Those above the surface go; those less than dx/2 below it are pushed down to that. */
void wet_faces_ghosts(struct sph *s)
{
    struct zones *z = s->zones;
    struct openings *o = z->openings;
    int n = 0;
    zones_room(z, o->nghost);
    z->n = o->nghost;
    memcpy(z->x, o->ghost_x, 3 * (size_t)o->nghost * sizeof *z->x);
    zones_look_at_surface(z, s->t);
    for (int k = 0; k < o->nghost; k++) {
        const double *g = z->gphi + 3 * k, phi = z->phi[k];
        double size2 = 0.0;
        if (phi > 0.0)
            continue;
        for (int a = 0; a < 3; a++)
            size2 += g[a] * g[a];
        const double down = phi > -0.5 * o->dx && size2 > 0.0 ? (phi + 0.5 * o->dx) / size2 : 0.0;
        for (int a = 0; a < 3; a++)
            o->ghost_x[3 * (size_t)n + a] = z->x[3 * k + a] - down * g[a];
        n++;
    }
    o->nghost = n;
}

/* Part of a particle's square or cube that lies in the counted box. */
static double counted_share(const struct sph *s, const double *y)
{
    const struct zones *z = s->zones;
    double f = 1.0;
    for (int side = 0; side < 2 * s->dim; side++) {
        const double in = zones_inside(z->counted[0], z->counted[1], side, y);
        if (s->open[side])
            f *= fmin(fmax(in / s->dx + 0.5, 0.0), 1.0);
    }
    return f;
}

/* Particles are counted by the part of their square or cube in the box; outside it those that are
 * over the water outside, which no partner counts. Where levels of refinement meet, all of both
 * count by the level's share: particles that change their roles there must not look to the partner
 * like water that comes and goes, for which it would answer by a flow. */
void wet_faces_water(struct sph *s, double water[2])
{
    struct zones *z = s->zones;
    water[0] = 0.0;
    water[1] = z->openings->rain[0] / s->rho0;
    z->n = 0;
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++) {
            const double *y = state_row(&q->p, q->p.y, i), f = counted_share(s, y);
            const double share = particles_share(q, y);
            if (share > 0.0)
                water[0] += share * f * y[at_mass(s->dim)] / s->rho0;
            if (f < 1.0 && z->surface && q == s)
                zones_list(s, i);
        }
    if (z->surface)
        zones_look_at_surface(z, s->t);
    for (int k = 0; k < z->n; k++) {
        const double *y = state_row(&s->p, s->p.y, z->who[k]);
        if (zones_wet(z, z->phi[k]) == 0.0)
            water[0] += (1.0 - counted_share(s, y)) * y[at_mass(s->dim)] / s->rho0;
    }
    MPI_Allreduce(MPI_IN_PLACE, water, 2, MPI_DOUBLE, MPI_SUM, s->run->comm);
}

bool wet_faces_restart(struct openings *o, struct h5 *f)
{
    double rain[6] = {o->rain[0], o->rain[1], o->rain[2], o->rain[3], (double)o->drops, o->films};
    if (!h5_keep_parts(f, "zones_rain", "kg", 6, rain))
        return false;
    memcpy(o->rain, rain, sizeof o->rain);
    o->drops = llround(rain[4]);
    o->films = rain[5];
    return true;
}
