/* wet_faces.c - see wet_faces.h. SPDX-License-Identifier: BSD-3-Clause */
#include "wet_faces.h"

#include <math.h>
#include <string.h>

#include "../../common/h5.h"
#include "zones.h"

/* Share of the unit square around 0 where phi + n0 s + n1 t < 0, n0 >= n1 >= 0: corners that stand
 * over the line taken out. */
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

double wet_faces_share(int dim, int axis, double dx, double phi, const double *g)
{
    double n[2] = {0.0, 0.0};
    int m = 0;
    for (int a = 0; a < dim; a++)
        if (a != axis)
            n[m++] = fabs(g[a]) * dx;
    return below(phi, fmax(n[0], n[1]), fmin(n[0], n[1]));
}

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
            o->share[f] = wet_faces_share(o->dim, side / 2, o->dx, z->phi[f], z->gphi + 3 * f);
}

static int upright(const struct sph *s)
{
    int up = 0;
    for (int a = 1; a < s->dim; a++)
        up = fabs(s->gravity[a]) > fabs(s->gravity[up]) ? a : up;
    return up;
}

int wet_faces_for(struct sph *s, int side, const double *x)
{
    const struct openings *o = s->zones->openings;
    const int up = upright(s), rows = o->cells[up];
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

void wet_faces_rain(struct sph *s, const double *y)
{
    struct openings *o = s->zones->openings;
    o->rain[0] += y[at_mass(o->dim)];
    for (int a = 0; a < o->dim; a++)
        o->rain[1 + a] += y[o->dim + a];
    o->drops++;
}

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

void wet_faces_save(const struct openings *o, struct h5 *f)
{
    const double rain[5] = {o->rain[0], o->rain[1], o->rain[2], o->rain[3], (double)o->drops};
    h5_write_real(f, "zones_rain", "kg", 5, 1, rain, false);
}

bool wet_faces_load(struct sph *s, struct h5 *f)
{
    struct openings *o = s->zones->openings;
    double rain[5];
    if (!s->zones->gap)
        return true;
    if (!h5_read_parts(f, "zones_rain", 5, rain))
        return false;
    memcpy(o->rain, rain, sizeof o->rain);
    o->drops = llround(rain[4]);
    return true;
}
