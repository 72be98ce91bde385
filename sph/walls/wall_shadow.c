/* wall_shadow.c - see wall_shadow.h. The shadow is what lies beyond the triangle's plane within the
 * three planes through the point and its edges; polygons are cut by these one after another
 * (Sutherland & Hodgman, Comm. ACM 17, 1974) and integrated as fans of triangles.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "wall_shadow.h"

#include "../../common/base/base.h"

enum { CORNERS = 12 };

static const double thickness = 1e-9; /* of R: what lies so little behind a plane lies in it */

/* Corners are seen from the origin. Planes are turned so that the shadow is on their positive side.
 * false: the point lies in the triangle's plane, which then hides nothing. */
bool shadow_caster_of(double (*v)[3], struct shadow_caster *c)
{
    double e[2][3];
    memcpy(c->v, v, sizeof c->v);
    vec3_from(v[0], v[1], e[0]);
    vec3_from(v[0], v[2], e[1]);
    vec3_cross(e[0], e[1], c->n);
    const double size = vec3_unit(c->n);
    c->height = vec3_dot(c->n, v[0]);
    const double way = c->height < 0.0 ? -1.0 : 1.0;
    for (int a = 0; a < 3; a++)
        c->n[a] *= way;
    c->height *= way;
    for (int k = 0; k < 3; k++) {
        vec3_cross(v[k], v[(k + 1) % 3], c->side[k]);
        vec3_unit(c->side[k]);
        for (int a = 0; a < 3; a++)
            c->side[k][a] *= way;
    }
    return size > 0.0 && c->height > 1e-9 * sqrt(size);
}

bool shadow_alike(const struct shadow_caster *a, const struct shadow_caster *b)
{
    double turned = fabs(a->height - b->height) / a->height;
    for (int k = 0; k < 3; k++)
        turned = fmax(turned, fabs(a->n[k] - b->n[k]));
    return turned < 1e-12;
}

bool shadow_is_before(const struct shadow_caster *c, int n, double (*y)[3], double R)
{
    double most = -INFINITY;
    for (int k = 0; k < n; k++) {
        const double size = fabs(y[k][0]) + fabs(y[k][1]) + fabs(y[k][2]);
        most = fmax(most, vec3_dot(c->n, y[k]) - c->height + 1e-11 * (size + c->height));
    }
    return most <= thickness * R;
}

/* Whether some corner lies above the plane n.y = h. */
static bool any_above(int corners, double (*y)[3], const double *n, double h)
{
    bool any = false;
    for (int k = 0; k < corners && !any; k++)
        any = vec3_dot(n, y[k]) - h > 0.0;
    return any;
}

/* What of the polygon lies above the plane n.y = h, in place; returns the number of its corners. */
static int keep_above(int corners, double (*y)[3], const double *n, double h)
{
    double x[CORNERS][3], at[CORNERS];
    int kept = 0;
    for (int k = 0; k < corners; k++)
        at[k] = vec3_dot(n, y[k]) - h;
    memcpy(x, y, (size_t)corners * sizeof *x);
    for (int k = 0; k < corners; k++) {
        const int next = (k + 1) % corners;
        if (at[k] > 0.0)
            memcpy(y[kept++], x[k], sizeof *y);
        if ((at[k] > 0.0) == (at[next] > 0.0))
            continue;
        const double share = at[k] / (at[k] - at[next]);
        for (int a = 0; a < 3; a++)
            y[kept][a] = x[k][a] + share * (x[next][a] - x[k][a]);
        kept++;
    }
    return kept;
}

/* A convex polygon as triangles around its first corner; slivers have no normal, and nothing to
 * add. */
static void add_fan(int n, double (*y)[3], double R, struct wall_integrals *to)
{
    static const double here[3] = {0.0, 0.0, 0.0};
    struct facet fan[CORNERS];
    struct facet_batch batch; /* 20 KB: not cleared */
    batch.n = 0;
    for (int k = 2; k < n; k++) {
        double e[2][3], across[3];
        vec3_from(y[0], y[k - 1], e[0]);
        vec3_from(y[0], y[k], e[1]);
        vec3_cross(e[0], e[1], across);
        if (vec3_length(across) < 1e-12 * R * R)
            continue;
        fan[k] = facet_of(y[0], y[k - 1], y[k]);
        facet_ask(&batch, fan + k, here, R, to);
    }
    facet_finish(&batch);
}

void shadow_add(const struct shadow_caster *c, int n, double (*y)[3], double R,
                struct wall_integrals *to)
{
    double x[CORNERS][3];
    if (!any_above(n, y, c->n, c->height + thickness * R))
        return;
    memcpy(x, y, (size_t)n * sizeof *x);
    n = keep_above(n, x, c->n, c->height + thickness * R);
    for (int k = 0; k < 3 && n > 0; k++)
        n = keep_above(n, x, c->side[k], thickness * R);
    if (n > 2)
        add_fan(n, x, R, to);
}

/* The strip from an edge to 1.5 R, away from the point at the origin: what of that plane the
 * support holds beyond the edge. */
void shadow_beyond(const double *a, const double *b, double R, double (*y)[3])
{
    double along[3];
    vec3_from(a, b, along);
    const double length2 = vec3_dot(along, along);
    const double at = fmax(0.0, fmin(-vec3_dot(a, along) / length2, 1.0));
    double foot[3];
    for (int k = 0; k < 3; k++)
        foot[k] = a[k] + at * along[k];
    const double far = fmax(1.0, 1.5 * R / fmax(vec3_length(foot), 1e-6 * R));
    for (int k = 0; k < 3; k++) {
        y[0][k] = a[k];
        y[1][k] = b[k];
        y[2][k] = far * b[k];
        y[3][k] = far * a[k];
    }
}
