/* wall_share.c - see wall_share.h. SPDX-License-Identifier: BSD-3-Clause */
#include "wall_share.h"

#include "facet.h"
#include "wall_moments.h"

/* Part of the Shepard factor that the faces of one body take at x, with the sign of 1 - gamma. */
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

/* Triangles of a mesh near a place `own' in its frame; *to is the caller's (mem_free). */
static int near_facets(const struct wall_mesh *m, double R, const double *own, struct facet **to)
{
    double lo[3], hi[3];
    for (int a = 0; a < 3; a++) {
        lo[a] = own[a] - R;
        hi[a] = own[a] + R;
    }
    const int n = tree_box(m->tree, lo, hi, 0, NULL);
    int *near = NEW(int, n + 1);
    *to = NEW(struct facet, n + 1);
    tree_box(m->tree, lo, hi, n, near);
    for (int k = 0; k < n; k++) {
        const int *v = m->mesh.vertex[near[k]];
        (*to)[k] = facet_of(m->mesh.x[v[0]], m->mesh.x[v[1]], m->mesh.x[v[2]]);
    }
    mem_free(near);
    return n;
}

/* own: in the frame of the mesh. As share_of_segments, of the triangles within R of a place in the
 * frame of the mesh. */
static double share_of_mesh(const struct wall_mesh *m, double R, const double *own)
{
    struct wall_integrals sum = {0};
    struct facet_batch batch; /* 20 KB: not cleared */
    struct facet *facet;
    const int n = near_facets(m, R, own, &facet);
    batch.n = 0;
    for (int k = 0; k < n; k++)
        facet_ask(&batch, facet + k, own, R, &sum);
    facet_finish(&batch);
    mem_free(facet);
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

enum { POINTS = 5 }; /* of Gauss, on (0, 1) */
static const double at[POINTS] = {0.0469100770306680, 0.2307653449471585, 0.5, 0.7692346550528415,
                                  0.9530899229693320};
static const double gauss[POINTS] = {0.1184634425280945, 0.2393143352496832, 0.2844444444444444,
                                     0.2393143352496832, 0.1184634425280945};

/* Integrals of both along a line at the height h from the node, from its foot to the place `to', in
 * R; by points that crowd at the foot, where the second has a logarithm. */
static void add_to(double h, double to, double sign, double sums[2])
{
    const double reach = sqrt(fmax(1.0 - h * h, 0.0)), end = fmax(-reach, fmin(to, reach));
    for (int half = 0; half < 2; half++)
        for (int k = 0; k < POINTS; k++) {
            const double u = 0.5 * (half + at[k]), q = hypot(h, end * u * u);
            const double weight = sign * gauss[k] * u * end;
            sums[0] += weight * ring_of(q);
            sums[1] += weight * potential_of(fmax(q, 1e-9));
        }
}

/* In 3D both are integrals over triangles, by their edges as in facet.c: over a sector with its tip
 * at the node's foot, d high, and an edge of it p from there, int f dS = int (F(d) - F(q)) dtheta,
 * F(q) = int_q^1 f s ds. Of the first, and of the second, int_q^1 ds/s^2 int_s^1 W t^2 dt. */
static void plane_of(double q, double F[2])
{
    const double q2 = q * q, q4 = q2 * q2;
    F[0] = 1.0 / 28.0 - 1.0 / 8.0 + 5.0 / 12.0 - 4.0 / 7.0 + 5.0 / 16.0 - 4.0 / 63.0 -
           q2 * (1.0 / 28.0 - q2 / 8.0 +
                 q4 * (5.0 / 12.0 + q * (-4.0 / 7.0 + q * (5.0 / 16.0 - q * 4.0 / 63.0))));
    F[1] = 1.0 / 42.0 - 1.0 / 28.0 + 1.0 / 24.0 - 1.0 / 12.0 + 2.0 / 21.0 - 5.0 / 112.0 +
           1.0 / 126.0 -
           q * (1.0 / 42.0 - q / 28.0 + q * q2 / 24.0 +
                q * q4 * (-1.0 / 12.0 + q * (2.0 / 21.0 + q * (-5.0 / 112.0 + q / 126.0))));
    for (int k = 0; k < 2; k++)
        F[k] = q < 1.0 ? 21.0 / (2.0 * M_PI) * F[k] : 0.0;
}

/* From the edge's nearest point to `to' along it, in R. */
static void add_sector(double d, double p, double to, double sign, double sums[2])
{
    const double reach = sqrt(fmax(1.0 - d * d - p * p, 0.0)), end = fmax(-reach, fmin(to, reach));
    double whole[2], F[2];
    plane_of(d, whole);
    for (int half = 0; half < 2; half++)
        for (int k = 0; k < POINTS; k++) {
            const double u = 0.5 * (half + at[k]), t = end * u * u, r2 = p * p + t * t;
            plane_of(sqrt(d * d + r2), F);
            for (int m = 0; m < 2 && r2 > 0.0; m++)
                sums[m] += sign * gauss[k] * u * end * p / r2 * (whole[m] - F[m]);
        }
    for (int m = 0; m < 2 && p != 0.0; m++)
        sums[m] += sign * whole[m] * (atan(to / p) - atan(end / p));
}

/* Of one triangle; x, n and the gravity g in the frame of its mesh. */
static void add_facet(const struct facet *f, double R, const double *x, const double *n,
                      const double *g, double out[3])
{
    double sums[2] = {0.0, 0.0};
    for (int e = 0; e < 3; e++) {
        double to[3];
        vec3_from(x, f->v[e], to);
        const double d = fabs(vec3_dot(f->n, to)) / R, p = vec3_dot(f->m[e], to) / R,
                     from = vec3_dot(f->t[e], to) / R;
        if (d >= 1.0)
            return;
        add_sector(d, p, from + f->length[e] / R, 1.0, sums);
        add_sector(d, p, from, -1.0, sums);
    }
    vec3_add(out, R * vec3_dot(f->n, g) * sums[0], n);
    vec3_add(out, -R * vec3_dot(f->n, n) * sums[1], g);
}

static void weight_of_mesh(const struct wall_mesh *m, double R, const double *x, const double *n,
                           const double *g, double out[3])
{
    double own[3], own_n[3], own_g[3], sum[3] = {0.0, 0.0, 0.0}, turned[3];
    struct facet *facet;
    wall_mesh_to_own(m, x, own);
    wall_mesh_turn_to_own(m, n, own_n);
    wall_mesh_turn_to_own(m, g, own_g);
    const int near = near_facets(m, R, own, &facet);
    for (int k = 0; k < near; k++)
        add_facet(facet + k, R, own, own_n, own_g, sum);
    mem_free(facet);
    wall_mesh_turn_to_world(m, sum, turned);
    vec3_add(out, 1.0, turned);
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
    for (int k = 0; k < w->nmeshes; k++)
        if (w->meshes[k].body == body && !w->meshes[k].thin)
            weight_of_mesh(w->meshes + k, s->R, x, n, s->gravity, out);
}

/* Inside an owner the sum over its faces is one less than its share. */
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
