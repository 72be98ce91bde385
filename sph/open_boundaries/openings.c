/* openings.c - the faces of the open sides and what they hold; see openings.h.
 * A face with accumulated mass f rho dx^D stands for a lattice whose next row is (1/2 - f) dx
 * behind it: that is where the transport law sees neighbours beyond the open side.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "openings.h"

#include "../particles/sph_particles.h"
#include "../walls/sph_walls.h"
#include "zones.h"

/* In R/c0: how long the drain takes for what voids left. With 50 the drain of the breaking wave is
 * some 0.02 m/s at most. */
static const double drain_time = 50.0;

/* Faces; for comparison their vertices (Kassiotis) [6.11-6.12], on the side itself and with half of
 * the mass. On a straight side without ends the mean over the faces at a vertex is one face. */
static const struct birth_law at_faces = {0.5, 1.0, 0.5, false},
                              at_vertices = {0.0, 0.5, 0.0, true};

/* Faces of all sides are numbered one after the other, first[side] on. tick: 1/64 of the step as it
 * is expected at the start, so that steps do not share one. */
struct openings *openings_create(struct sph *s)
{
    struct openings *o = NEW(struct openings, 1);
    o->dim = s->dim;
    o->law = s->prm.births == BIRTHS_VERTICES ? &at_vertices : &at_faces;
    o->dx = s->dx;
    for (int a = 0; a < 3; a++) {
        o->lo[a] = s->lo[a];
        o->hi[a] = s->hi[a];
        o->bounded[a] = a < s->dim && !s->periodic[a];
        o->cells[a] = a < s->dim ? (int)lround((s->hi[a] - s->lo[a]) / s->dx) : 1;
    }
    for (int side = 0; side < 2 * o->dim; side++) {
        o->open[side] = s->open[side];
        int faces = o->open[side] ? 1 : 0;
        for (int b = 0; b < o->dim; b++)
            faces *= b == side / 2 ? 1 : o->cells[b];
        o->first[side + 1] = o->first[side] + faces;
    }
    const int n = openings_faces(o);
    o->mass = NEW_IN(o, double, n);
    o->change = NEW_IN(o, double, n);
    o->flux = NEW_IN(o, double, n);
    o->shift = NEW_IN(o, double, n);
    o->share = NEW_IN(o, double, n);
    o->room = NEW_IN(o, double, n);
    for (int f = 0; f < n; f++)
        o->room[f] = o->share[f] = 1.0;
    o->first_id = (int64_t)1 << 40; /* above those of the first filling */
    o->tick = sph_params_dt(&s->prm, s->nu, s->c0, NULL) / 64.0;
    return o;
}

/* Walls other than sides. */
static bool has_lines(const struct sph *s)
{
    bool any = false;
    for (int k = 0; k < s->run->scene.nwalls; k++)
        any = any || s->run->scene.walls[k].side == SIDE_NONE;
    return any && s->walls;
}

/* Distance of x to the walls, m: negative behind them. */
static double before_walls(const struct sph *s, const double *x)
{
    int mesh;
    return s->dim == 2 ? walls_distance(s->walls, x, INFINITY)
                       : wall_meshes_nearest(s->walls, x, INFINITY, &mesh).distance;
}

/* By POINTS points along a face, in each direction of it, unless the face lies wholly before or
 * behind the walls. Done again when the box has moved. */
void openings_find_room(const struct sph *s, struct openings *o)
{
    enum { POINTS = 8 }; /* along a face */
    const int n = has_lines(s) ? openings_faces(o) : 0;
    for (int f = 0; f < n; f++) {
        double x[3], y[3];
        const int across = openings_place(o, f, x) / 2;
        const int b = (across + 1) % s->dim, c = (across + 2) % s->dim;
        const int rows = s->dim == 3 ? POINTS : 1;
        const double middle = before_walls(s, x);
        const bool cut = fabs(middle) < o->dx;
        int before = !cut && middle > 0.0 ? POINTS * rows : 0;
        for (int k = 0; k < POINTS * rows && cut; k++) {
            memcpy(y, x, sizeof y);
            y[b] += ((k % POINTS + 0.5) / POINTS - 0.5) * o->dx;
            y[c] += rows > 1 ? ((k / POINTS + 0.5) / POINTS - 0.5) * o->dx : 0.0;
            before += before_walls(s, y) > 0.0;
        }
        o->room[f] = o->share[f] = (double)before / (POINTS * rows);
    }
}

int openings_faces(const struct openings *o) { return o->first[2 * o->dim]; }

/* Of the points that give birth, the row nearest to x along an axis. */
static int row_of(const struct openings *o, int a, double x)
{
    return (int)floor((x - o->lo[a]) / o->dx + (0.5 - o->law->along));
}

/* Of the faces next to f, round an edge between two open sides too, the one that holds most (sense
 * 1) or least (-1) and is wet; f itself if there is none. */
int openings_beside(const struct openings *o, int f, double sense)
{
    double x[3], most = -INFINITY;
    const int side = openings_place(o, f, x);
    int to = f;
    for (int k = 0; k < 2 * o->dim; k++) {
        const int b = k / 2, way = k % 2 ? 1 : -1;
        int I[3] = {0, 0, 0}, beside = side;
        if (b == side / 2)
            continue;
        for (int a = 0; a < o->dim; a++)
            I[a] = row_of(o, a, x[a]) + (a == b ? way : 0);
        if (o->bounded[b] && (I[b] < 0 || I[b] >= o->cells[b]) && o->open[2 * b + (way > 0)])
            beside = 2 * b + (way > 0);
        const int g = openings_face(o, beside, I);
        const double held = sense * (o->mass[g] + o->change[g]);
        if (g != f && o->share[g] > 0.25 && held > most) {
            most = held;
            to = g;
        }
    }
    return to;
}

/* s: since a particle came in, by its identity; those of the first filling are as old as the run.
 */
double openings_age(const struct sph *s, int64_t id)
{
    const struct openings *o = s->zones->openings;
    if (id < o->first_id)
        return s->t;
    return s->t - o->tick * (double)((id - o->first_id) / openings_faces(o));
}

/* kg: in the faces, waiting to be born, less what was born ahead. */
double openings_held(const struct sph *s)
{
    const struct openings *o = s->zones->openings;
    double sum = 0.0;
    for (int f = 0; f < openings_faces(o); f++)
        sum += o->mass[f];
    return sum - o->deficit;
}

/* Evenly over all faces, wherever it came in. */
void openings_let_out(struct openings *o, double mass)
{
    const int n = openings_faces(o);
    for (int f = 0; f < n; f++)
        o->mass[f] -= mass / n;
}

/* Beyond the ends of a side the last face stands for the place; across a period faces go round. */
int openings_face(const struct openings *o, int side, const int *I)
{
    int f = 0;
    for (int b = o->dim - 1; b >= 0; b--) {
        if (b == side / 2)
            continue;
        const int c = o->cells[b];
        const int i = o->bounded[b] ? (I[b] < 0    ? 0
                                       : I[b] >= c ? c - 1
                                                   : I[b])
                                    : ((I[b] % c) + c) % c;
        f = f * c + i;
    }
    return o->first[side] + f;
}

/* Side, centre and inward normal sign of a face. */
int openings_place(const struct openings *o, int f, double *x)
{
    int side = 0;
    while (f >= o->first[side + 1])
        side++;
    int k = f - o->first[side];
    x[2] = 0.0;
    for (int b = 0; b < o->dim; b++) {
        if (b == side / 2) {
            x[b] = side % 2 ? o->hi[b] : o->lo[b];
            continue;
        }
        x[b] = o->lo[b] + (k % o->cells[b] + o->law->along) * o->dx;
        k /= o->cells[b];
    }
    return side;
}

int openings_face_at(const struct openings *o, int side, const double *x)
{
    int I[3] = {0, 0, 0};
    for (int a = 0; a < o->dim; a++)
        I[a] = row_of(o, a, x[a]);
    return openings_face(o, side, I);
}

/* Bilinear, for births at vertices; the mass goes to 2 of them in the plane, to 4 in space. */
void openings_share(struct openings *o, int side, const double *x, double m)
{
    for (int corner = 0; corner < 1 << o->dim; corner++) {
        double part = m;
        int I[3] = {0, 0, 0};
        if (corner >> (side / 2) & 1)
            continue;
        for (int b = 0; b < o->dim; b++) {
            const double at = (x[b] - o->lo[b]) / o->dx - o->law->along, low = floor(at);
            const bool high = corner >> b & 1;
            I[b] = (int)low + high;
            part *= b == side / 2 ? 1.0 : high ? at - low : 1.0 - (at - low);
        }
        o->change[openings_face(o, side, I)] += part;
    }
}

/* A void that reaches an open side goes out as water: the outside knows no voids, and lets as much
 * in elsewhere. Below it faces are booked particles that do not come. They would wait for them, one
 * row of void after the other; what they owe beyond openings_max_deficit goes instead to one
 * account, and leaves the region by a slow flow through all open sides. */
static void collect_deficits(struct sph *s)
{
    struct openings *o = s->zones->openings;
    const double least = -openings_max_deficit * s->rho0 * s->dxD, area = s->dxD / s->dx;
    /* an outlet's faces may stand in air; an outside with a surface has room for voids */
    if (!s->surface || s->prm.outer == OUTER_SIDES || s->zones->surface || s->run->crossed)
        return; /* at a restart the partner's is not known yet */
    for (int f = 0; f < openings_faces(o); f++)
        if (o->mass[f] < least) {
            o->deficit += least - o->mass[f];
            o->mass[f] = least;
        }
    s->zones->drain =
        o->deficit / (s->rho0 * area * openings_faces(o)) * s->c0 / (drain_time * s->R); /* m/s */
}

/* After the masses have changed: what they say of the lattice behind the faces, m, inwards
 * positive; no farther in than a face may lack, one dx out. */
void openings_settle(struct sph *s)
{
    struct openings *o = s->zones->openings;
    collect_deficits(s);
    for (int side = 0; side < 2 * o->dim; side++)
        for (int f = o->first[side]; f < o->first[side + 1]; f++)
            o->shift[f] = openings_inward(side) * s->dx *
                          fmin(fmax(o->mass[f] / (s->rho0 * s->dxD), -1.0), openings_max_deficit);
}
