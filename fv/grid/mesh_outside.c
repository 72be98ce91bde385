/* mesh_outside.c - the water outside of outflows that blocks declare themselves. The surface
 * outside an outflow stands as high as the water in it at the start; water falls out where there is
 * none. All outflows on one side of the domain count as one. From the scene and the vertices alone,
 * so that every rank finds the same.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "mesh_outside.h"

#include "../../common/scene/scene.h"

/* A tenth of the first cell inside the middle of a face of a side. p, q: the face's indices along
 * the tangents. */
static void place_inside(const struct mesh *m, const struct mesh_block *b, int side, int p, int q,
                         double x[3])
{
    const int a = side / 2, t = (a + 1) % 3, u = (a + 2) % 3, end = side % 2 ? b->n[a] : 0;
    x[0] = x[1] = x[2] = 0.0;
    for (int corner = 0; corner < 8; corner++) {
        int i[3];
        i[a] = corner & 1 ? (side % 2 ? end - 1 : end + 1) : end;
        i[t] = p + (corner >> 1 & 1);
        i[u] = q + (corner >> 2);
        const double *v = b->x[mesh_vertex(b, i[0], i[1], m->dim == 3 ? i[2] : 0)];
        for (int c = 0; c < m->dim; c++)
            x[c] += (corner & 1 ? 0.1 : 0.9) * 0.25 * v[c];
    }
}

/* m: of the highest water in a side; - infinity: none. */
static double top_in(const struct run *r, const struct exact *e, const struct mesh *m, int k,
                     int side)
{
    const struct mesh_block *b = m->block + k;
    const int a = side / 2, np = b->n[(a + 1) % 3], nq = b->n[(a + 2) % 3];
    double top = -INFINITY;
    for (int q = 0; q < nq; q++)
        for (int p = 0; p < np; p++) {
            double x[3];
            place_inside(m, b, side, p, q, x);
            top = fmax(top, openings_top_over(&r->scene, e, x));
        }
    return top;
}

/* known: whether the scene has a level outside at all. */
void mesh_outside_find(const struct run *r, const struct mesh *m,
                       struct mesh_outside of[MESH_OUTSIDES])
{
    const bool known = openings_have_outside(&r->scene);
    const struct exact e = exact_create(&r->scene);
    for (int g = 0; g < MESH_OUTSIDES; g++)
        of[g] = (struct mesh_outside){.stands = -INFINITY};
    for (int k = 0; k < m->nblocks; k++)
        for (int side = 0; side < 2 * m->dim; side++) {
            const struct mesh_block *b = m->block + k;
            if (b->side[side] != MESH_OUTFLOW || b->wall[side])
                continue;
            of[b->on[side]].any = true;
            if (known)
                of[b->on[side]].stands = fmax(of[b->on[side]].stands, top_in(r, &e, m, k, side));
        }
    for (int g = 0; g < MESH_OUTSIDES; g++) {
        of[g].falls = known && of[g].any && !isfinite(of[g].stands);
        of[g].stands = isfinite(of[g].stands) ? of[g].stands : NAN;
        of[g].lower = isfinite(of[g].stands) && openings_are_lower(&r->scene, of[g].stands);
    }
}

void mesh_outside_describe(const struct run *r, const struct mesh *m)
{
    struct mesh_outside of[MESH_OUTSIDES];
    mesh_outside_find(r, m, of);
    for (int g = 0; g < MESH_OUTSIDES; g++)
        if (of[g].any)
            openings_describe_outside(g < 6 ? scene_side_names[g] : "outflow within the domain",
                                      of[g].stands, of[g].falls);
}
