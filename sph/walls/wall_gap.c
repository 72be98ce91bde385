/* wall_gap.c - see wall_gap.h. SPDX-License-Identifier: BSD-3-Clause
 *
 * A face is pushed by what the particles before it have of its kernel. Where another face stands
 * within the support there are none behind that one, and the push lacks the share of the kernel
 * which is cut off there: with a uniform pressure p a plane at the distance d before another gets
 * p (1 - 2 |c|), c = c(d) the other's part of the Shepard factor at the foot of the particle. The
 * particle's own factor makes up for that in the fluid, not on the faces. So each flux q is
 * counted once more in the proportion that is missing, (w/2) q c/gamma with the Shepard factor at
 * the foot, on the face itself and, turned round, on the one that cuts: both faces together get
 * (1 - 2 |c|) (1 + 2 |c|/(1 - 2 |c|)) = 1, fluid and faces keep their momentum, and what stands
 * alone or beyond the support gets nothing.
 *
 * Faces that meet at an angle theta (normals n, m out of the fluid, n.m = -cos theta): beside each
 * wall the fluid carries less momentum than p, over a thickness d, and the wall carries the rest
 * along itself, p d. In the corner that ends. Of uniform pressure the first face lacks there
 * p D n + p d t, D the integral of 2 |c| over it and t along it, out of the corner; the other the
 * opposite, for both together are at rest: so D = d cot(theta/2), and what they owe each other is
 * p D (n - m)/(1 + cos theta), the rule of above times 2/(1 - n.m). Without it a face of ten
 * particles that stands on the floor gets 2 to 5 % less than p A. */
#include "wall_gap.h"

#include "forces.h"

static const double least_gamma = 0.15, least_turn = 0.5;

bool wall_gap_between(const struct wall_list *l, int k)
{
    for (int j = l->first[k] + 1; j < l->first[k + 1]; j++)
        if (l->touch[j].body != l->touch[l->first[k]].body)
            return true;
    return false;
}

/* Thin meshes cut their pairs and close their own sums: nothing of them is owed to others. */
static bool is_thin(const struct sph *s, const struct wall_touch *t)
{
    return s->dim == 3 && s->walls->meshes[t->of].thin;
}

/* Those with the largest weights, at most GAP_FACES; returns their number. */
static int pick_faces(const struct sph *s, const struct wall_list *l, int k, int *face)
{
    int n = 0;
    for (int j = l->first[k]; j < l->first[k + 1]; j++) {
        if (l->touch[j].is.W == 0.0 || l->touch[j].on >= 0 || is_thin(s, l->touch + j))
            continue;
        int at = n < GAP_FACES ? n++ : GAP_FACES;
        for (; at > 0 && l->touch[face[at - 1]].is.W < l->touch[j].is.W; at--)
            if (at < GAP_FACES)
                face[at] = face[at - 1];
        if (at < GAP_FACES)
            face[at] = j;
    }
    return n;
}

/* A face that is seen from behind counts where its foot is wet. */
static double share_of_face(const struct wall_touch *t, double gamma)
{
    return t->height > 0.0 ? 1.0 : fmax(0.0, fmin((gamma - 0.25) / 0.05, 1.0));
}

/* How much more than between faces that are parallel: see above. */
static double of_angle(const struct sph *s, const struct wall_touch *t, const struct wall_touch *o)
{
    double along = 0.0;
    for (int a = 0; a < s->dim; a++)
        along += t->n[a] * o->n[a];
    return 2.0 / fmax(1.0 - (o->on >= 0 ? -along : along), least_turn);
}

/* Whether a face of another owner makes a wedge with it that is sharper than a corner. */
static bool is_acute(const struct sph *s, const struct wall_list *l, int k,
                     const struct wall_touch *t)
{
    bool any = false;
    for (int j = l->first[k]; j < l->first[k + 1]; j++) {
        double along = 0.0;
        for (int a = 0; a < s->dim; a++)
            along += t->n[a] * l->touch[j].n[a];
        any = any || (l->touch[j].body != t->body && l->touch[j].is.W > 0.0 && along < -0.1);
    }
    return any;
}

/* Where the others are asked for, as shares of the face's weight: the foot of x on the nearest
 * piece of a touch's plane, or beyond its ends what it has of the kernel; in wedges (2D) points
 * along the face, since what it lacks grows quickly towards their tip, where no foot is. A little
 * way into the fluid. */
static int points_of(const struct sph *s, const struct wall_list *l, int k,
                     const struct wall_touch *t, double (*y)[3], double *share)
{
    const double *x = prim_line(&s->p, l->who[k]);
    int n = 1;
    share[0] = 1.0;
    if (s->dim == 2 && is_acute(s, l, k, t))
        n = wall_list_points(s, l, t, x, y, share);
    else
        for (int a = 0; a < s->dim; a++)
            y[0][a] = x[a] + (t->foot ? t->height * t->n[a] : t->is.e[a]);
    for (int p = 0; p < n; p++)
        for (int a = 0; a < s->dim; a++)
            y[p][a] -= 1e-4 * s->R * t->n[a];
    return n;
}

/* Face j, at the point y that has `part' of it, with the faces of other owners. */
static void exchange_at(const struct sph *s, struct wall_list *l, int k, int j, const double *q,
                        double part, const double *y)
{
    const struct wall_touch *t = l->touch + j, *o = l->touch + l->first[k];
    const int n = l->first[k + 1] - l->first[k];
    const double *x = prim_line(&s->p, l->who[k]);
    double gamma = 1.0, sum[3] = {0.0, 0.0, 0.0};
    const double *share = wall_list_shares(s, l, k, j, y);
    if (!share)
        return;
    for (int m = 0; m < n; m++)
        gamma += share[m];
    const double factor = 0.5 * part * share_of_face(t, gamma) / fmax(gamma, least_gamma);
    for (int m = 0; m < n && factor > 0.0; m++, o++) {
        double f, back[3];
        if (o->body == t->body || share[m] == 0.0 || is_thin(s, o) ||
            walls_sealed(s, t->body, o->body))
            continue;
        f = factor * share[m] * of_angle(s, t, o);
        for (int a = 0; a < s->dim; a++) {
            back[a] = -f * q[a];
            sum[a] += f * q[a];
        }
        forces_add(s, o->body, x, back);
    }
    forces_add(s, t->body, x, sum);
}

/* The flux of face j without what is covered of it. */
static void flux_of(const struct sph *s, const struct wall_list *l, int k, int j,
                    const double (*q)[3], double *sum)
{
    const int first = l->first[k];
    for (int a = 0; a < s->dim; a++)
        sum[a] = q[j - first][a];
    for (int m = first; m < l->first[k + 1]; m++)
        for (int a = 0; l->touch[m].on == j - first && a < s->dim; a++)
            sum[a] += q[m - first][a];
}

void wall_gap_exchange(const struct sph *s, struct wall_list *l, int k, const double (*q)[3],
                       double w)
{
    int face[GAP_FACES];
    const int n = pick_faces(s, l, k, face);
    for (int i = 0; i < n; i++) {
        double flux[3], y[FACE_POINTS][3], part[FACE_POINTS];
        int points;
        flux_of(s, l, k, face[i], q, flux);
        points = points_of(s, l, k, l->touch + face[i], y, part);
        for (int p = 0; p < points; p++)
            exchange_at(s, l, k, face[i], flux, w * part[p], y[p]);
    }
}
