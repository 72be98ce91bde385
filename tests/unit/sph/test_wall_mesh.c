/* test_wall_mesh.c - walls of triangles: sides of the domain become meshes that close where walls
 * meet and go on where they end; poses carry points there and back.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "sph_case.h"

/* A cube of walls on the sides given, the walls as normal flux has them. */
static struct sph *cube(struct sph_case *c, int nsides, const int *sides)
{
    sph_case_set(c, 3, 8);
    struct scene *s = &c->run.scene;
    s->initial.field = FIELD_REST;
    s->initial.level = LEVEL_TOP;
    for (int a = 0; a < 3; a++)
        s->domain.periodic[a] = false;
    for (int k = 0; k < nsides; k++)
        s->walls[s->nwalls++].side = sides[k];
    c->prm.walls = WALLS_NFM;
    return sph_case_start(c, NULL);
}

TEST(a_box_of_walls_is_one_closed_mesh)
{
    static const int all[] = {SIDE_X_MIN, SIDE_X_MAX, SIDE_Y_MIN,
                              SIDE_Y_MAX, SIDE_Z_MIN, SIDE_Z_MAX};
    struct sph_case c;
    struct sph *s = cube(&c, 6, all);
    assert_int_equal(s->walls->nmeshes, 1);
    const struct wall_mesh *m = s->walls->meshes;
    assert_int_equal(m->mesh.nvertices, 8);
    assert_true(m->mesh.closed && m->mesh.clashes == 0);
    assert_close(trimesh_solid(&m->mesh, -1).volume, 1.0, 1e-12);
    const double x[3] = {0.4, 0.03, 0.5}, out[3] = {1.02, 0.5, 1.03};
    int which;
    const struct tree_foot f = wall_meshes_nearest(s->walls, x, 1.0, &which);
    assert_close(f.distance, 0.03, 1e-12);
    assert_close(f.n[1], -1.0, 1e-12);
    assert_close(wall_meshes_nearest(s->walls, out, 1.0, &which).distance, -hypot(.02, .03), 1e-12);
    wall_meshes_nearest(s->walls, out, 0.01, &which);
    assert_int_equal(which, -1);
    DROP(c.s);
}

/* Beside a plane a half of the kernel is behind it, in an edge three quarters, in a corner seven
 * eighths; the same by the mesh's own frame. */
TEST(what_is_behind_faces_is_known_in_their_frame)
{
    static const int all[] = {SIDE_X_MIN, SIDE_X_MAX, SIDE_Y_MIN,
                              SIDE_Y_MAX, SIDE_Z_MIN, SIDE_Z_MAX};
    struct sph_case c;
    struct sph *s = cube(&c, 6, all);
    const double e = 1e-5 * s->R;
    const double x[4][3] = {{0.5, 0.5, 0.5}, {e, 0.5, 0.5}, {e, 0.5, e}, {e, 1.0 - e, e}};
    static const double want[] = {0.0, 0.5, 0.75, 0.875};
    for (int k = 0; k < 4; k++) {
        double own[3];
        wall_mesh_to_own(s->walls->meshes, x[k], own);
        assert_close(wall_share_in_frame(s, 0, own), wall_share(s, -1, x[k]), 1e-12);
        assert_close(wall_share_in_frame(s, 0, own), want[k], 1e-3);
    }
    DROP(c.s);
}

/* Bottom and one side; the bottom goes on by 2.5 R where no wall ends it. */
TEST(open_sides_prolong_the_others)
{
    static const int two[] = {SIDE_Z_MIN, SIDE_X_MIN};
    struct sph_case c;
    struct sph *s = cube(&c, 2, two);
    double lo[3], hi[3];
    assert_int_equal(s->walls->nmeshes, 1);
    trimesh_bounds(&s->walls->meshes[0].mesh, lo, hi);
    assert_close(lo[0], 0.0, 1e-12);
    assert_close(hi[0], 1.0 + 2.5 * s->R, 1e-12);
    assert_close(lo[1], -2.5 * s->R, 1e-12);
    assert_close(lo[2], 0.0, 1e-12);
    assert_close(hi[2], 1.0 + 2.5 * s->R, 1e-12);
    assert_int_equal(s->walls->meshes[0].mesh.nparts, 1); /* they share the edge where they meet */
    DROP(c.s);
}

TEST(walls_unlike_each_other_are_meshes_of_their_own)
{
    struct sph_case c;
    static const int none[1];
    struct sph *s;
    cube(&c, 0, none);
    DROP(c.s);
    c.run.scene.walls[0] = (struct scene_wall){.side = SIDE_Z_MIN, .kind = WALL_NO_SLIP};
    c.run.scene.walls[1] =
        (struct scene_wall){.side = SIDE_Z_MAX, .kind = WALL_NO_SLIP, .velocity = {1.0, 0.0, 0.0}};
    c.run.scene.walls[2] = (struct scene_wall){.side = SIDE_X_MAX};
    c.run.scene.nwalls = 3;
    s = sph_case_start(&c, NULL);
    assert_int_equal(s->walls->nmeshes, 3);
    assert_true(!s->walls->meshes[0].no_slip && s->walls->meshes[1].no_slip); /* x before z */
    assert_close(s->walls->meshes[2].u[0], 1.0, 0.0);
    DROP(c.s);
}

/* A floor that ends at periodic sides goes on beyond them without a rim; a ball near one of them
 * has an image. */
TEST(meshes_repeat_with_the_domain)
{
    static const int none[1];
    const double o[3] = {0.2, 0.5, 0.6};
    struct sph_case c;
    cube(&c, 0, none);
    DROP(c.s);
    struct scene *e = &c.run.scene;
    e->domain.periodic[0] = true;
    e->meshes = NEW(struct scene_meshes, 1);
    for (int k = 0; k < 2; k++) {
        struct scene_mesh *m = e->meshes->of + e->meshes->n++;
        *m = (struct scene_mesh){.owner = MESH_OF_WALL, .index = e->nwalls++};
        m->fluid_side = k ? FLUID_OUTSIDE : FLUID_SHEET;
        m->mesh = trimesh_sphere(o, 0.15, 2);
        if (k == 0) {
            const double lo[3] = {0.0, -1.0, 0.0}, hi[3] = {1.0, 2.0, 0.3};
            trimesh_free(&m->mesh);
            m->mesh = trimesh_box(lo, hi, 2);
            int kept = 0;
            for (int t = 0; t < m->mesh.ntriangles; t++) {
                double n[3];
                trimesh_normal(&m->mesh, t, n);
                if (n[2] < -0.5)
                    memmove(m->mesh.vertex[kept++], m->mesh.vertex[t], sizeof m->mesh.vertex[t]);
            }
            m->mesh.ntriangles = kept;
            trimesh_connect(&m->mesh);
        } else {
            trimesh_turn(&m->mesh, -1);
        }
        m->tree = tree_create(&m->mesh);
    }
    struct sph *s = sph_case_start(&c, NULL);
    const double edge[3] = {1.0, 0.5, 0.1}, image[3] = {0.98, 0.5, 0.6};
    int mesh;
    const struct tree_foot f = wall_meshes_nearest(s->walls, edge, 1.0, &mesh);
    assert_int_equal(mesh, 0);
    assert_false(f.rim);
    assert_close(f.distance, 0.1, 1e-12);
    assert_close(wall_meshes_nearest(s->walls, image, 1.0, &mesh).distance, 0.07, 0.005);
    assert_int_equal(mesh, 1);
    DROP(c.s);
    scene_meshes_free(e);
}

TEST(poses_carry_there_and_back)
{
    const double q = 0.7, cq = cos(q), sq = sin(q), x[3] = {1.0, -2.0, 0.5};
    const struct wall_mesh m = {.X = {3.0, 2.0, 1.0},
                                .Q = {{cq, -sq, 0.0}, {sq, cq, 0.0}, {0.0, 0.0, 1.0}}};
    double world[3], own[3];
    wall_mesh_to_world(&m, x, world);
    assert_close(world[0], 3.0 + cq + 2.0 * sq, 1e-14);
    wall_mesh_to_own(&m, world, own);
    for (int a = 0; a < 3; a++)
        assert_close(own[a], x[a], 1e-14);
}
