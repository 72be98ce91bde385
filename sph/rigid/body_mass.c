/* body_mass.c - mass, centre and inertia of a body, given or of a uniform density. Called with the
 * case, to refuse what no body can have, and by body_create; in 2D all per metre, and inertia is
 * that about z.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <lapacke.h>

#include "../../common/geometry/geometry.h"
#include "../../common/scene/scene.h"
#include "body.h"

/* Says why, and is false. */
static bool no(char *why, size_t size, const char *what)
{
    snprintf(why, size, "%s", what);
    return false;
}

/* From J (2D; halves about x and y are never used) or J_xx, J_yy, J_zz, J_xy, J_yz, J_zx. */
static void take_inertia(const struct param_numbers *v, int dim, double J[3][3])
{
    static const int at[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
    memset(J, 0, 9 * sizeof(double));
    if (dim == 2) {
        J[0][0] = J[1][1] = 0.5 * v->v[0];
        J[2][2] = v->v[0];
        return;
    }
    for (int k = 0; k < v->n && k < 6; k++)
        J[at[k][0]][at[k][1]] = J[at[k][1]][at[k][0]] = v->v[k];
}

/* Moments of inertia of masses: none above the sum of the others. */
static bool possible(double J[3][3], char *why, size_t size)
{
    double e[3], A[9];
    memcpy(A, J, sizeof A);
    require(LAPACKE_dsyev(LAPACK_ROW_MAJOR, 'N', 'U', 3, A, 3, e) == 0); /* ascending */
    if (e[0] > 0.0 && e[2] <= (e[0] + e[1]) * (1.0 + 1e-9))
        return true;
    snprintf(
        why, size,
        "no body has the principal moments %.4g, %.4g, %.4g kg m^2: each must be above 0 and at "
        "most the sum of the others",
        e[0], e[1], e[2]);
    return false;
}

static bool of_outline(const struct scene_body *is, double density, struct body_mass *m)
{
    const struct line l = line_of(&is->points, true);
    double area, polar;
    line_moments(&l, &area, m->centre, &polar);
    m->centre[2] = 0.0;
    m->mass = density * area;
    const struct param_numbers v = {1, {density * polar}};
    take_inertia(&v, 2, m->inertia);
    return true;
}

/* Normals point into the body: its volume counts as negative. */
static bool of_mesh(const struct trimesh *mesh, double density, struct body_mass *m)
{
    const struct trimesh_solid is = trimesh_solid(mesh, -1);
    const double sign = is.volume < 0.0 ? -density : density;
    m->mass = sign * is.volume;
    memcpy(m->centre, is.centre, sizeof m->centre);
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            m->inertia[a][b] = sign * is.inertia[a][b];
    return true;
}

double body_volume_of(const struct scene_body *is, const struct trimesh *mesh)
{
    const struct line l = line_of(&is->points, true);
    return fabs(mesh ? trimesh_solid(mesh, -1).volume : line_area(&l));
}

/* Density with what it can be integrated over, or mass with inertia; one of them. */
bool body_mass_of(const struct scene_body *is, const struct trimesh *mesh, int dim,
                  struct body_mass *m, char *why, size_t size)
{
    *m = (struct body_mass){.mass = is->mass};
    memcpy(m->centre, is->centre, sizeof m->centre);
    if (is->density > 0.0 && is->mass > 0.0)
        return no(why, size, "density or mass, not both");
    if (is->density > 0.0 && is->tank)
        return no(
            why, size,
            "the points of a tank say nothing of its own mass: give mass, centre and inertia");
    if (is->density > 0.0 && dim == 2)
        return of_outline(is, is->density, m);
    if (is->density > 0.0 && mesh && mesh->closed)
        return of_mesh(mesh, is->density, m);
    if (is->density > 0.0)
        return no(
            why, size,
            "only what a closed mesh holds has a mass by its density: close the mesh, or give "
            "mass, centre and inertia");
    if (!(is->mass > 0.0))
        return no(why, size, "a free body has a density, or mass, centre and inertia");
    if (dim == 2 ? is->inertia.n != 1 || !(is->inertia.v[0] > 0.0)
                 : is->inertia.n != 3 && is->inertia.n != 6)
        return no(why, size,
                  dim == 2 ? "with mass goes inertia, a number above 0 (kg m^2 per metre), about "
                             "the centre"
                           : "with mass goes inertia = (xx, yy, zz) or (xx, yy, zz, xy, yz, zx)");
    take_inertia(&is->inertia, dim, m->inertia);
    return dim == 2 || possible(m->inertia, why, size);
}
