/* properties_bodies.c - random scenes of bodies that float or sink, and of meshes in space; how
 * such a mesh is written. SPDX-License-Identifier: BSD-3-Clause */
#include "properties_families.h"

#include <stdlib.h>
#include <string.h>

/* Density of anything from a float to a stone; with a push at times. */
static void set_free(const struct scene *s, struct random *r, struct body *b, double radius)
{
    b->free = true;
    b->density = s->rho * decades(r, 0.2, 5.0);
    for (int a = 0; a < s->dim && chance(r, 0.5); a++)
        b->velocity[a] = 0.3 * s->speed * uniform(r, -1.0, 1.0);
    for (int a = 0; a < 3 && chance(r, 0.3); a++)
        b->turning[a] = s->dim > 2 ? 0.3 * s->speed / radius * uniform(r, -1.0, 1.0) : 0.0;
    if (s->dim == 2 && chance(r, 0.3))
        b->spin = 0.3 * s->speed / radius * uniform(r, -1.0, 1.0);
}

static void fill(struct scene *s, int deep)
{
    struct shape *h = s->shapes + s->nshapes++;
    h->form = "box";
    h->line.n = 2;
    memcpy(h->line.x[0], s->lo, sizeof s->lo);
    memcpy(h->line.x[1], s->hi, sizeof s->hi);
    h->line.x[1][1] = s->lo[1] + deep * s->dx;
}

/* Free polygons in a tank, at its surface, above or below. */
void make_floating(struct scene *s, struct random *r)
{
    s->dim = 2;
    const int nx = whole(r, 20, 44), ny = whole(r, 20, 36);
    make_particles(s, r, nx, ny, 1);
    make_tank(s, r);
    const bool full = chance(r, 0.2);
    const int deep = full ? ny : whole(r, 8, ny - 4), count = chance(r, 0.2) ? 2 : 1;
    if (!full)
        fill(s, deep);
    make_sides(s, r, NULL);
    for (int k = 0; k < count; k++) {
        struct body *b = s->bodies + s->nbodies++;
        const double reach = s->dx * fmin(nx / count, ny), radius = reach * uniform(r, 0.12, 0.3);
        const double least = s->lo[1] + radius + 2.0 * s->dx,
                     most = s->hi[1] - radius - 2.0 * s->dx;
        b->centre[0] = s->lo[0] + (k + 0.5) * nx * s->dx / count + reach * uniform(r, -0.1, 0.1);
        b->centre[1] =
            fmax(least, fmin(s->lo[1] + deep * s->dx + radius * uniform(r, -2.0, 1.5), most));
        b->kind = one_of(r, "slip", "no_slip");
        make_obstacle(&b->line, r, b->centre, radius);
        set_free(s, r, b, radius);
    }
    settle_particles(s, r, nx * deep);
}

/* --- meshes --- */

/* A box, its sides two triangles each, or a tetrahedron; turned about a random axis. */
static void make_mesh(struct body *b, struct random *r, double radius)
{
    static const int box[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6},
                                   {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                                   {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    static const int tetrahedron[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    const bool is_box = chance(r, 0.6);
    const double size[3] = {uniform(r, 0.8, 1.0), uniform(r, 0.8, 1.0), uniform(r, 0.8, 1.0)};
    double q[4], length = 0.0;
    for (int a = 0; a < 4; a++)
        q[a] = chance(r, 0.8) ? uniform(r, -1.0, 1.0) : a == 0;
    for (int a = 0; a < 4; a++)
        length += q[a] * q[a];
    for (int a = 0; a < 4; a++)
        q[a] /= sqrt(length);
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    const double Q[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                            {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                            {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
    b->line.n = is_box ? 8 : 4;
    b->ntriangles = is_box ? 12 : 4;
    memcpy(b->triangle, is_box ? box : tetrahedron, (size_t)b->ntriangles * sizeof *b->triangle);
    for (int k = 0; k < b->line.n; k++) {
        double v[3];
        for (int a = 0; a < 3; a++)
            v[a] = is_box ? (k >> a & 1 ? 0.577 : -0.577) * size[a] * radius
                          : radius * ((k == a + 1) - 0.25);
        for (int a = 0; a < 3; a++)
            b->line.x[k][a] = b->centre[a] + Q[a][0] * v[0] + Q[a][1] * v[1] + Q[a][2] * v[2];
    }
    b->stl = chance(r, 0.5);
    b->thin = !is_box && chance(r, 0.8); /* its edges are */
}

/* A mesh in a small tank: at rest, driven or free. */
void make_solid(struct scene *s, struct random *r)
{
    s->dim = 3;
    const int nx = whole(r, 10, 13), ny = whole(r, 10, 13), nz = whole(r, 10, 11);
    make_particles(s, r, nx, ny, nz);
    make_tank(s, r);
    const bool full = chance(r, 0.4);
    const int deep = full ? ny : whole(r, 4, ny), motion = whole(r, 0, 3);
    if (!full)
        fill(s, deep);
    make_sides(s, r, NULL);
    struct body *b = s->bodies + s->nbodies++;
    const double radius = s->dx * uniform(r, 3.2, 3.7);
    for (int a = 0; a < 3; a++)
        b->centre[a] = 0.5 * (s->lo[a] + s->hi[a]) + s->dx * uniform(r, -0.5, 0.5);
    b->kind = one_of(r, "slip", "no_slip");
    make_mesh(b, r, radius);
    for (int a = 0; a < 3 && motion == 1; a++)
        b->velocity[a] = 0.2 * s->speed * uniform(r, -1.0, 1.0);
    for (int a = 0; a < 3 && motion == 2; a++)
        b->turning[a] = 0.2 * s->speed / radius * uniform(r, -1.0, 1.0);
    if (motion == 3)
        set_free(s, r, b, radius);
    s->unforced = s->still = motion == 0 && full;
    settle_particles(s, r, nx * deep * nz);
}

static void write_stl(const struct body *b, FILE *f)
{
    fprintf(f, "solid body\n");
    for (int k = 0; k < b->ntriangles; k++) {
        fprintf(f, "facet normal 0 0 0\nouter loop\n");
        for (int i = 0; i < 3; i++) {
            const double *x = b->line.x[b->triangle[k][i]];
            fprintf(f, "vertex %.17g %.17g %.17g\n", x[0], x[1], x[2]);
        }
        fprintf(f, "endloop\nendfacet\n");
    }
    fprintf(f, "endsolid body\n");
}

static void write_obj(const struct body *b, FILE *f)
{
    for (int k = 0; k < b->line.n; k++)
        fprintf(f, "v %.17g %.17g %.17g\n", b->line.x[k][0], b->line.x[k][1], b->line.x[k][2]);
    for (int k = 0; k < b->ntriangles; k++)
        fprintf(f, "f %d %d %d\n", b->triangle[k][0] + 1, b->triangle[k][1] + 1,
                b->triangle[k][2] + 1);
}

void scene_write_meshes(const struct scene *s, const char *dir, const char *name)
{
    char path[1024];
    for (int k = 0; k < s->nbodies; k++) {
        const struct body *b = s->bodies + k;
        if (b->ntriangles == 0)
            continue;
        snprintf(path, sizeof path, "%s/%s.b%d.%s", dir, name, k, b->stl ? "stl" : "obj");
        FILE *f = fopen(path, "w");
        if (!f) {
            perror(path);
            exit(2);
        }
        if (b->stl)
            write_stl(b, f);
        else
            write_obj(b, f);
        fclose(f);
    }
}
