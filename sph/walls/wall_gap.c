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
 * alone or beyond the support gets nothing. */
#include "wall_gap.h"

#include <math.h>

#include "forces.h"

static const double least_gamma = 0.15;

bool wall_gap_between(const struct wall_list *l, int k)
{
    for (int j = l->first[k] + 1; j < l->first[k + 1]; j++)
        if (l->touch[j].body != l->touch[l->first[k]].body)
            return true;
    return false;
}

static bool is_thin(const struct sph *s, const struct wall_touch *t)
{
    return s->dim == 3 && s->walls->meshes[t->of].thin;
}

/* Those with the largest weights, at most GAP_FACES; returns their number. */
static int pick_faces(const struct sph *s, const struct wall_list *l, int k, int *face)
{
    int n = 0;
    for (int j = l->first[k]; j < l->first[k + 1]; j++) {
        if (l->touch[j].is.W == 0.0 || is_thin(s, l->touch + j))
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

/* The foot of x on the nearest piece of a touch's plane, a little way into the fluid. */
static void foot_of(const struct sph *s, const struct wall_list *l, int k, int j, const double *x,
                    double *foot)
{
    const struct wall_touch *t = l->touch + j;
    double least = INFINITY;
    for (int i = j; i < l->first[k + 1]; i++) {
        const struct wall_touch *o = l->touch + i;
        double y[3];
        if (i > j && !(o->joined && o->of == t->of && o->plane == t->plane))
            continue;
        const double d = wall_list_nearest(s, l, o, x, y);
        for (int a = 0; a < s->dim && d < least; a++)
            foot[a] = y[a] - 1e-4 * s->R * t->n[a];
        least = fmin(least, d);
    }
}

/* A face that is seen from behind counts where its foot is wet. */
static double share_of_face(const struct wall_touch *t, double gamma)
{
    return t->height > 0.0 ? 1.0 : fmax(0.0, fmin((gamma - 0.25) / 0.05, 1.0));
}

/* Along the normal of the face that cuts; between two bodies neither is before the other. */
static void part_along(const struct sph *s, const double *q, const double *n, bool bodies,
                       double *part)
{
    double along = 0.0;
    for (int a = 0; a < s->dim; a++)
        along += q[a] * n[a];
    for (int a = 0; a < s->dim; a++)
        part[a] = bodies ? 0.5 * (q[a] + along * n[a]) : along * n[a];
}

/* Face j with the faces of other owners. */
static void exchange(const struct sph *s, struct wall_list *l, int k, int j, const double *q,
                     double w)
{
    const struct wall_touch *t = l->touch + j, *o = l->touch + l->first[k];
    const int n = l->first[k + 1] - l->first[k];
    const double *x = prim_line(&s->p, l->who[k]);
    double foot[3], gamma = 1.0, sum[3] = {0.0, 0.0, 0.0};
    foot_of(s, l, k, j, x, foot);
    const double *share = wall_list_shares(s, l, k, t->body, foot);
    if (!share)
        return;
    for (int m = 0; m < n; m++)
        gamma += share[m];
    const double factor = 0.5 * w * share_of_face(t, gamma) / fmax(gamma, least_gamma);
    for (int m = 0; m < n && factor > 0.0; m++, o++) {
        double f[3], back[3];
        if (o->body == t->body || share[m] == 0.0 || is_thin(s, o))
            continue;
        part_along(s, q, o->n, o->body >= 0 && t->body >= 0, f);
        for (int a = 0; a < s->dim; a++) {
            f[a] *= factor * share[m];
            back[a] = -f[a];
            sum[a] += f[a];
        }
        forces_add(s, o->body, x, back);
    }
    forces_add(s, t->body, x, sum);
}

void wall_gap_exchange(const struct sph *s, struct wall_list *l, int k, const double (*q)[3],
                       double w)
{
    int face[GAP_FACES];
    const int n = pick_faces(s, l, k, face);
    for (int i = 0; i < n; i++)
        exchange(s, l, k, face[i], q[face[i] - l->first[k]], w);
}
