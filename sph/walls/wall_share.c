/* wall_share.c - see wall_share.h. SPDX-License-Identifier: BSD-3-Clause */
#include "wall_share.h"

#include <math.h>

#include "../../common/base/base.h"
#include "facet.h"
#include "wall_moments.h"

static double share_of_segments(const struct sph *s, int body, const double *x)
{
    const struct walls *w = s->walls;
    double sum = 0.0;
    for (int k = 0; k < w->nsegments; k++) {
        const struct segment *g = w->segments + k;
        double height, from;
        segment_seen(g, x, &height, &from);
        if (g->body == body && fabs(height) < s->R)
            sum -= wall_moments(height / s->R, from / s->R, (from + g->length) / s->R).gamma;
    }
    return sum;
}

/* own: in the frame of the mesh. */
static double share_of_mesh(const struct wall_mesh *m, double R, const double *own)
{
    double lo[3], hi[3];
    struct wall_integrals sum = {0};
    struct facet_batch batch; /* 20 KB: not cleared */
    batch.n = 0;
    for (int a = 0; a < 3; a++) {
        lo[a] = own[a] - R;
        hi[a] = own[a] + R;
    }
    const int n = tree_box(m->tree, lo, hi, 0, NULL);
    int *near = NEW(int, n + 1);
    struct facet *facet = NEW(struct facet, n + 1);
    tree_box(m->tree, lo, hi, n, near);
    for (int k = 0; k < n; k++) {
        const int *v = m->mesh.vertex[near[k]];
        facet[k] = facet_of(m->mesh.x[v[0]], m->mesh.x[v[1]], m->mesh.x[v[2]]);
        facet_ask(&batch, facet + k, own, R, &sum);
    }
    facet_finish(&batch);
    FREE(near, facet);
    return -sum.gamma;
}

/* --- the weight --- */

/* Of a place q, in R, from a node: 1/R int_r^R W s ds R^2, whose slope is - W times the way, */
static double ring_of(double q) { return q < 1.0 ? wall_ring(q) : 0.0; }

/* and of that over s once more, whose divergence of the slope is W. */
static double potential_of(double q)
{
    const double q2 = q * q, q4 = q2 * q2;
    if (q >= 1.0)
        return 0.0;
    return 7.0 / M_PI *
           (-log(q) / 14.0 - (1.0 - q2) / 4.0 + 0.625 * (1.0 - q4) - 0.8 * (1.0 - q4 * q) +
            (1.0 - q4 * q2) * 2.5 / 6.0 - (1.0 - q4 * q2 * q) * 4.0 / 49.0);
}

/* Integrals of both along a line at the height h from the node, from its foot to the place `to', in
 * R; by points that crowd at the foot, where the second has a logarithm. */
static void add_to(double h, double to, double sign, double sums[2])
{
    enum { POINTS = 5 };
    static const double at[POINTS] = {0.0469100770306680, 0.2307653449471585, 0.5,
                                      0.7692346550528415, 0.9530899229693320};
    static const double gauss[POINTS] = {0.1184634425280945, 0.2393143352496832, 0.2844444444444444,
                                         0.2393143352496832, 0.1184634425280945};
    const double reach = sqrt(fmax(1.0 - h * h, 0.0)), end = fmax(-reach, fmin(to, reach));
    for (int half = 0; half < 2; half++)
        for (int k = 0; k < POINTS; k++) {
            const double u = 0.5 * (half + at[k]), q = hypot(h, end * u * u);
            const double weight = sign * gauss[k] * u * end;
            sums[0] += weight * ring_of(q);
            sums[1] += weight * potential_of(fmax(q, 1e-9));
        }
}

void wall_share_weight(const struct sph *s, int body, const double *x, const double *n,
                       double out[3])
{
    const struct walls *w = s->walls;
    for (int k = 0; k < w->nsegments && s->dim == 2; k++) {
        const struct segment *g = w->segments + k;
        double height, from, sums[2] = {0.0, 0.0};
        segment_seen(g, x, &height, &from);
        if (g->body != body || fabs(height) >= s->R)
            continue;
        add_to(height / s->R, (from + g->length) / s->R, 1.0, sums);
        add_to(height / s->R, from / s->R, -1.0, sums);
        const double down = g->n[0] * s->gravity[0] + g->n[1] * s->gravity[1];
        const double turn = g->n[0] * n[0] + g->n[1] * n[1];
        for (int a = 0; a < 2; a++)
            out[a] += s->R * (n[a] * down * sums[0] - turn * s->gravity[a] * sums[1]);
    }
}

static double within(double sum) { return sum < -1e-6 ? sum + 1.0 : sum; }

double wall_share(const struct sph *s, int body, const double *x)
{
    double sum = s->dim == 2 ? share_of_segments(s, body, x) : 0.0, own[3];
    for (int k = 0; k < s->walls->nmeshes; k++) {
        const struct wall_mesh *m = s->walls->meshes + k;
        if (m->body != body || m->thin)
            continue;
        wall_mesh_to_own(m, x, own);
        sum += share_of_mesh(m, s->R, own);
    }
    return within(sum);
}

double wall_share_in_frame(const struct sph *s, int mesh, const double *own)
{
    const struct wall_mesh *of = s->walls->meshes + mesh;
    double sum = 0.0, x[3], there[3];
    if (of->body >= 0)
        return within(share_of_mesh(of, s->R, own));
    wall_mesh_to_world(of, own, x); /* which stands still */
    for (int k = 0; k < s->walls->nmeshes; k++) {
        const struct wall_mesh *m = s->walls->meshes + k;
        if (m->body >= 0 || m->thin)
            continue;
        wall_mesh_to_own(m, x, there);
        sum += share_of_mesh(m, s->R, there);
    }
    return within(sum);
}
