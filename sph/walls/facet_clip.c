/* facet_clip.c - the quadrature of the thesis, beside which the closed form of facet.c stands: n x
 * n squares over the disc that the support has in common with the plane, cut by the triangle's
 * edges (Sutherland & Hodgman, Commun. ACM 17, 1974) [4.90-4.91].
 * SPDX-License-Identifier: BSD-3-Clause */
#include "facet.h"

#include "../pairs/sph_pairs.h"

enum { CORNERS = 8 };

struct clip_polygon {
    int n;
    double x[CORNERS][2];
};

/* A line of the plane: e = c - m.x, positive inside. */
struct line2 {
    double c, m[2];
};

/* Signed distance from the line, m, since m is a unit vector. */
static double inside(const struct line2 *l, const double *x)
{
    return l->c - l->m[0] * x[0] - l->m[1] * x[1];
}

/* The part of a convex polygon on the inner side of a line: each cut adds one corner at most, so a
 * square that three edges cut has seven. */
static struct clip_polygon cut(const struct clip_polygon *p, const struct line2 *l)
{
    struct clip_polygon q = {.n = 0};
    for (int k = 0; k < p->n; k++) {
        const double *a = p->x[k], *b = p->x[(k + 1) % p->n];
        const double ea = inside(l, a), eb = inside(l, b);
        if (ea >= 0.0) {
            memcpy(q.x[q.n], a, sizeof q.x[0]);
            q.n++;
        }
        if ((ea >= 0.0) != (eb >= 0.0)) {
            for (int c = 0; c < 2; c++)
                q.x[q.n][c] = a[c] + (b[c] - a[c]) * ea / (ea - eb);
            q.n++;
        }
    }
    return q;
}

/* Area and centroid, from the first corner for the digits' sake. */
static double area_of(const struct clip_polygon *p, double *centre)
{
    double area = 0.0, sum[2] = {0.0, 0.0};
    for (int k = 1; k + 1 < p->n; k++) {
        const double *a = p->x[0], *b = p->x[k], *c = p->x[k + 1];
        const double z = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
        area += z;
        for (int i = 0; i < 2; i++)
            sum[i] += z * (a[i] + b[i] + c[i]) / 3.0;
    }
    for (int i = 0; i < 2 && area > 0.0; i++)
        centre[i] = sum[i] / area;
    return area;
}

/* The part of a square within the triangle. */
static double part_of(const struct line2 edge[3], const double *middle, double side, double *centre)
{
    const double h = 0.5 * side, x = middle[0], y = middle[1];
    bool whole = true;
    memcpy(centre, middle, 2 * sizeof *centre);
    for (int s = 0; s < 3; s++) {
        const double e = inside(edge + s, middle);
        if (e <= -h * sqrt(2.0))
            return 0.0;
        whole = whole && e >= h * sqrt(2.0);
    }
    if (whole)
        return side * side;
    struct clip_polygon p = {4, {{x - h, y - h}, {x + h, y - h}, {x + h, y + h}, {x - h, y + h}}};
    for (int s = 0; s < 3 && p.n > 0; s++)
        p = cut(&p, edge + s);
    return area_of(&p, centre);
}

void facet_clip(const struct facet *f, const double *x, double R, int n, struct wall_integrals *to)
{
    double y[3], axis[2][3];
    struct line2 edge[3];
    vec3_from(x, f->v[0], y);
    const double D = vec3_dot(f->n, y);
    to->W = to->e[0] = to->e[1] = to->e[2] = 0.0;
    if (fabs(D) >= R)
        return;
    memcpy(axis[0], f->t[0], sizeof axis[0]);
    vec3_cross(f->n, axis[0], axis[1]);
    for (int s = 0; s < 3; s++) {
        vec3_from(x, f->v[s], y);
        edge[s] = (struct line2){vec3_dot(f->m[s], y),
                                 {vec3_dot(f->m[s], axis[0]), vec3_dot(f->m[s], axis[1])}};
    }
    const double disc = sqrt(R * R - D * D), side = 2.0 * disc / n;
    for (int i = 0; i < n * n; i++) {
        const double middle[2] = {(i % n + 0.5) * side - disc, (i / n + 0.5) * side - disc};
        double c[2];
        const double area = part_of(edge, middle, side, c),
                     r = sqrt(c[0] * c[0] + c[1] * c[1] + D * D);
        const double W = area > 0.0 && r < R ? area * kernel_w(3, r, R) : 0.0;
        to->W += W;
        for (int a = 0; a < 3; a++)
            to->e[a] += W * (c[0] * axis[0][a] + c[1] * axis[1][a] + D * f->n[a]);
    }
}

void facet_centroid(const struct facet *f, const double *x, double R, struct wall_integrals *to)
{
    double y[3];
    vec3_from(x, f->centre, y);
    const double r = vec3_length(y);
    to->W = r < R ? f->area * kernel_w(3, r, R) : 0.0;
    for (int a = 0; a < 3; a++)
        to->e[a] = to->W * y[a];
}
