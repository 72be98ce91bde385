/* solids.c - see solids.h. Only for jobs with several programs of particles; solids_deal is called
 * when the case has been checked and all programs have agreed on it. What a program does not have
 * it does not build particles for.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "solids.h"

#include "crossing.h"

/* Box around a body or wall as the case has it; false: a side of the domain. Points of polygons lie
 * in the plane: their third axis stays empty (lo > hi), which no box refuses. */
static bool extent(const struct scene *s, enum mesh_owner owner, int k, double lo[3], double hi[3])
{
    const struct scene_mesh *m = scene_mesh_of(s, owner, k);
    const struct param_points *p =
        owner == MESH_OF_BODY ? &s->bodies[k].points : &s->walls[k].points;
    for (int a = 0; a < 3; a++) {
        lo[a] = m ? m->lo[a] : INFINITY;
        hi[a] = m ? m->hi[a] : -INFINITY;
    }
    if (!m)
        outline_bounds(p->n, p->x, lo, hi);
    return m || p->n > 0;
}

static bool holds(int dim, double box[2][3], const double *lo, const double *hi)
{
    bool inside = true;
    for (int a = 0; a < dim; a++)
        inside = inside && (!(box[1][a] > box[0][a]) || (lo[a] >= box[0][a] && hi[a] <= box[1][a]));
    return inside;
}

bool solids_elsewhere(const struct run *r, enum mesh_owner owner, int k)
{
    char names[PARAM_PROGRAMS_MAX][64];
    const int n = r->coupled ? params_programs(r->params, "sph", names) : 0;
    double lo[3], hi[3], box[2][3];
    bool elsewhere = false;
    if (n < 2 || !extent(&r->scene, owner, k, lo, hi))
        return false;
    for (int q = 0; q < n; q++)
        elsewhere = (strcmp(names[q], r->name) != 0 && crossing_box(r, names[q], box) &&
                     holds(r->scene.domain.dim, box, lo, hi)) ||
                    elsewhere;
    return elsewhere;
}

/* What the k-th of a list has for a mesh is now that of `index', or nobody's (-1). */
static void number_mesh(struct scene *s, enum mesh_owner owner, int k, int index)
{
    for (int m = 0; s->meshes && m < s->meshes->n; m++)
        if (s->meshes->of[m].owner == owner && s->meshes->of[m].index == k) {
            s->meshes->of[m].index = index;
            return;
        }
}

/* Gauges that a body takes along are read where the body is. */
static void give_gauges(struct run *r, const char *body)
{
    for (int k = 0; k < r->scene.nprobes; k++)
        if (strcmp(r->scene.probes[k].body, body) == 0)
            r->gauge_elsewhere[k] = true;
}

/* Lists are closed up in place, walls first, then bodies; the meshes are told the new indices,
 * since they know their solid by its number. */
void solids_deal(struct run *r)
{
    struct scene *s = &r->scene;
    int n = 0;
    for (int k = 0; k < s->nwalls; k++) {
        const bool away = solids_elsewhere(r, MESH_OF_WALL, k);
        number_mesh(s, MESH_OF_WALL, k, away ? -1 : n);
        if (!away)
            s->walls[n++] = s->walls[k];
    }
    s->nwalls = n;
    n = 0;
    for (int k = 0; k < s->nbodies; k++) {
        const bool away = solids_elsewhere(r, MESH_OF_BODY, k);
        number_mesh(s, MESH_OF_BODY, k, away ? -1 : n);
        if (away)
            give_gauges(r, s->bodies[k].name);
        else
            s->bodies[n++] = s->bodies[k];
    }
    s->nbodies = n;
}
