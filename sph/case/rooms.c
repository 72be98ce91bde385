/* rooms.c - see rooms.h. By the trees of the meshes at the start: distances and crossings tell
 * where a particle has room and which links of the lattice a mesh cuts; the winding number, where a
 * part that is linked together holds fluid. What cannot be told is refused with a place and a
 * remedy.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "rooms.h"

#include "../walls/sph_walls.h"

/* Winding numbers nearer to the threshold than this say nothing. */
static const double doubt = 0.02;

/* Facets that sph makes of its own (m->of NULL) part nothing. */
bool rooms_parted(const struct sph *s)
{
    bool any = false;
    for (int k = 0; s->walls && k < s->walls->nmeshes; k++)
        any = any || s->walls->meshes[k].of;
    return any;
}

double rooms_distance(const struct sph *s, const double *x, double reach)
{
    int mesh;
    const struct tree_foot f = wall_meshes_nearest(s->walls, x, reach, &mesh);
    return mesh < 0 ? reach : fabs(f.distance);
}

bool rooms_crossed(const struct sph *s, const double *a, const double *b)
{
    for (int k = 0; k < s->walls->nmeshes; k++) {
        const struct wall_mesh *m = s->walls->meshes + k;
        double p[3], q[3];
        wall_mesh_to_own(m, a, p);
        wall_mesh_to_own(m, b, q);
        if (tree_crosses(m->tree, p, q, NULL))
            return true;
    }
    return false;
}

bool rooms_are_near(const struct sph *s, const double *x, double reach)
{
    for (int k = 0; k < s->walls->nmeshes; k++) {
        const struct wall_mesh *m = s->walls->meshes + k;
        double own[3];
        if (!m->of)
            continue;
        wall_mesh_to_own(m, x, own);
        if (tree_nearest(m->tree, own, reach).triangle >= 0)
            return true;
    }
    return false;
}

/* Room that a particle needs: packing moves it to its place. */
static double clearance(const struct sph *s) { return (s->prm.packing > 0 ? 0.05 : 0.3) * s->dx; }

bool rooms_have_place(const struct sph *s, const double *x)
{
    const double dx = s->dx * (1.0 - 1e-6);
    int mesh;
    const struct tree_foot f = wall_meshes_nearest(s->walls, x, dx, &mesh);
    const double d = fabs(f.distance);
    if (mesh < 0)
        return true;
    if (d <= clearance(s))
        return false;
    double end[3]; /* in a seam: another wall across, less than dx away from this one */
    for (int a = 0; a < 3; a++)
        end[a] = x[a] + (x[a] - f.foot[a]) * (dx - d) / d;
    return !rooms_crossed(s, x, end);
}

bool rooms_blocked(const struct sph *s, const double *a, const double *b)
{
    return rooms_crossed(s, a, b) || rooms_distance(s, b, s->dx) <= clearance(s);
}

/* Only between filled cells: links to the rest are never used. */
void rooms_cut_links(const struct sph *s, struct lattice *l, const int *first, const int *last)
{
    for (int a = 0; a < 3; a++)
        if (!l->cut[a])
            l->cut[a] = NEW_IN(l->bits, unsigned char, lattice_cells(l) / 8 + 1);
    for (int k = first[2]; k < last[2]; k++)
        for (int j = first[1]; j < last[1]; j++)
            for (int i = first[0]; i < last[0]; i++) {
                const int ic[3] = {i, j, k};
                const int64_t cell = lattice_cell(l, ic);
                double x[3];
                if (!lattice_has(l, cell))
                    continue;
                lattice_centre(l, ic, 3, x);
                for (int a = 0; a < 3; a++) {
                    int jc[3];
                    double y[3] = {x[0], x[1], x[2]};
                    y[a] += l->dx;
                    if (lattice_next(l, ic, a, s->periodic, jc) &&
                        lattice_has(l, lattice_cell(l, jc)) && rooms_crossed(s, x, y))
                        lattice_set(l->cut[a], cell);
                }
            }
}

/* Of which side of the threshold the fluid is; normals point out of it. */
static double threshold(int fluid_side)
{
    return fluid_side == FLUID_INSIDE ? 0.5 : fluid_side == FLUID_OUTSIDE ? -0.5 : 0.0;
}

/* Winding number around `own' of the mesh as it is in the file, and of the images of a closed wall
 * across periods. */
static double winding(const struct sph *s, const struct wall_mesh *m, const double *own)
{
    const bool repeats = m->body < 0 && m->of->mesh.closed;
    double sum = 0.0;
    for (int k = 0; k < 27; k++) {
        const int way[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
        double x[3];
        bool is_there = repeats || k == 13;
        for (int a = 0; a < 3; a++) {
            x[a] = own[a] + way[a] * (s->hi[a] - s->lo[a]);
            is_there = is_there && (way[a] == 0 || s->periodic[a]);
        }
        sum += is_there ? trimesh_winding(&m->of->mesh, x) : 0.0;
    }
    return sum;
}

bool rooms_are_wet(const struct sph *s, const double *x)
{
    for (int k = 0; k < s->walls->nmeshes; k++) {
        const struct wall_mesh *m = s->walls->meshes + k;
        double own[3];
        if (!m->of || (m->thin && !m->mesh.closed))
            continue;
        wall_mesh_to_own(m, x, own);
        const double w = winding(s, m, own) - threshold(m->of->fluid_side);
        if (fabs(w) < doubt)
            fail_with(RUN_INPUT,
                      "mesh %s does not say whether the region around (%g, %g, %g) m holds fluid: "
                      "it is open there. Close it, or name points in the fluid by initial.seed",
                      m->of->name, x[0], x[1], x[2]);
        if (w < 0.0)
            return false;
    }
    return true;
}

bool rooms_are_before(const struct sph *s, const double *x)
{
    int mesh;
    const struct tree_foot f = wall_meshes_nearest(s->walls, x, INFINITY, &mesh);
    return !f.rim && f.distance > 0.0;
}

void rooms_refuse_sheet(const struct sph *s, const double *a, const double *b)
{
    for (int k = 0; k < s->walls->nmeshes; k++) {
        const struct wall_mesh *m = s->walls->meshes + k;
        double p[3], q[3];
        if (!m->of || m->mesh.closed || m->thin)
            continue;
        wall_mesh_to_own(m, a, p);
        wall_mesh_to_own(m, b, q);
        if (!tree_crosses(m->tree, p, q, NULL))
            continue;
        const struct tree_foot f = tree_nearest(m->tree, p, INFINITY),
                               g = tree_nearest(m->tree, q, INFINITY);
        if (!f.rim && !g.rim && (f.distance > 0.0) != (g.distance > 0.0))
            fail_with(
                RUN_INPUT,
                "mesh %s has fluid on both sides at (%g, %g, %g) m, connected around its edge: "
                "close it or extend it beyond the domain; a plate in the fluid needs thin = true",
                m->of->name, f.foot[0], f.foot[1], f.foot[2]);
    }
}
