/* test_scene_mesh.c - meshes from files: every format gives the same surface, cracks close, turned
 * triangles are turned back, normals point out of the fluid wherever that is.
 * ranks: 1 2. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../common/scene/scene_mesh.h"
#include "../../../common/scene/scene_outlines.h"
#include "mesh_files.h"

static int rank;

/* A scene read from text, its meshes with it. */
struct reading {
    struct scene scene;
    struct params *p;
    struct faults f;
};

static const char head[] = "format = 1;\ntime: { end = 1.0; };\n"
                           "domain: { dim = 3; min = (0, 0, 0); max = (4, 2, 2); };\n";

static const char *scratch(void)
{
    const char *dir = getenv("TEST_SCRATCH");
    return dir ? dir : "/tmp";
}

static void read_scene(struct reading *r, const char *text)
{
    static const char *const others[] = {"sph", NULL};
    struct param_group groups[SCENE_GROUPS];
    char path[1024];
    memset(r, 0, sizeof *r);
    snprintf(path, sizeof path, "%s/meshes.cfg", scratch());
    if (rank == 0) {
        FILE *f = fopen(path, "w");
        fprintf(f, "%s%s", head, text);
        fclose(f);
    }
    MPI_Barrier(MPI_COMM_WORLD);
    scene_groups(&r->scene, groups);
    r->p = params_read(MPI_COMM_WORLD, path, 0, NULL, groups, SCENE_GROUPS, others, &r->f);
    if (r->f.n == 0)
        scene_outlines_read(&r->scene, scratch(), r->p, &r->f);
    if (r->f.n == 0)
        scene_check(&r->scene, r->p, &r->f);
    if (r->f.n == 0)
        scene_meshes_read(&r->scene, scratch(), r->p, MPI_COMM_WORLD, &r->f);
}

static void done(struct reading *r)
{
    scene_meshes_free(&r->scene);
    params_free(&r->p);
    mem_free(r->f.text);
}

static const double low[3] = {0.5, 0.5, 0.5}, high[3] = {1.5, 1.0, 1.25};

TEST(all_formats_are_the_same_box)
{
    static const char *const files[] = {"text.stl", "binary.STL", "box.obj", "box.ply"};
    struct trimesh m = trimesh_box(low, high, 1);
    if (rank == 0) {
        write_stl_text(&m, files[0]);
        write_stl(&m, files[1]);
        write_obj(&m, files[2]);
        write_ply(&m, files[3]);
    }
    for (int k = 0; k < 4; k++) {
        struct reading r;
        char text[200];
        snprintf(text, sizeof text, "walls: ( { mesh = \"%s\"; } );\n", files[k]);
        read_scene(&r, text);
        assert_int_equal(r.f.n, 0);
        const struct scene_mesh *is = r.scene.meshes->of;
        assert_int_equal(is->mesh.nvertices, 8);
        assert_int_equal(is->mesh.ntriangles, 12);
        assert_true(is->mesh.closed);
        assert_int_equal(is->crossings, 0);
        assert_close(is->volume, 0.375, 1e-6);
        done(&r);
    }
    trimesh_free(&m);
}

/* Every corner of its own, some a little off, a fifth of the triangles turned, a needle. */
TEST(cracks_close_and_senses_agree)
{
    const double c[3] = {2.0, 1.0, 1.0};
    struct trimesh m = trimesh_sphere(c, 0.5, 3), broken = {0};
    broken.x = (double(*)[3])mem_new(3 * (size_t)m.ntriangles + 3, sizeof *m.x);
    broken.vertex = (int(*)[3])mem_new((size_t)m.ntriangles + 1, sizeof *m.vertex);
    for (int t = 0; t < m.ntriangles; t++)
        for (int k = 0; k < 3; k++) {
            const int v = broken.nvertices++;
            for (int a = 0; a < 3; a++)
                broken.x[v][a] = m.x[m.vertex[t][k]][a] + 1e-5 * ((7 * v + a) % 11 - 5) / 5.0;
            broken.vertex[t][t % 5 ? k : 2 - k] = v;
        }
    for (int k = 0; k < 3; k++) {
        broken.vertex[m.ntriangles][k] = broken.nvertices;
        memcpy(broken.x[broken.nvertices++], broken.x[0], sizeof *m.x);
    }
    broken.ntriangles = m.ntriangles + 1;
    if (rank == 0)
        write_stl(&broken, "broken.stl");
    struct reading r;
    read_scene(&r, "bodies: ( { mesh = \"broken.stl\"; weld = 1e-4; } );\n");
    assert_int_equal(r.f.n, 0);
    const struct scene_mesh *is = r.scene.meshes->of;
    assert_true(is->mesh.closed && is->mesh.clashes == 0);
    assert_int_equal(is->mesh.nvertices, m.nvertices);
    assert_int_equal(is->flat, 1);
    assert_int_equal(is->reversed, m.ntriangles / 5);
    assert_close(is->volume, trimesh_solid(&m, -1).volume, 1e-4);
    assert_true(trimesh_solid(&is->mesh, -1).volume < 0.0); /* into the body: out of the fluid */
    assert_true(scene_mesh_holds(is, (double[]){2.0, 1.0, 1.6}));
    assert_false(scene_mesh_holds(is, c));
    done(&r);
    read_scene(&r, "bodies: ( { mesh = \"broken.stl\"; } );\n"); /* its cracks stay open */
    assert_int_equal(r.f.n, 1);
    done(&r);
    trimesh_free(&m);
    trimesh_free(&broken);
}

/* A box within a box within a box: fluid, solid, fluid. */
TEST(parts_alternate)
{
    struct trimesh m = {0};
    for (int k = 0; k < 3; k++) {
        const double lo[3] = {0.5 + 0.2 * k, 0.2 + 0.2 * k, 0.2 + 0.2 * k},
                     hi[3] = {3.5 - 0.2 * k, 1.8 - 0.2 * k, 1.8 - 0.2 * k};
        struct trimesh box = trimesh_box(lo, hi, 2);
        trimesh_append(&m, &box);
        trimesh_free(&box);
    }
    if (rank == 0)
        write_stl(&m, "nested.stl");
    struct reading r;
    read_scene(&r, "walls: ( { mesh = \"nested.stl\"; fluid_side = \"inside\"; } );\n");
    assert_int_equal(r.f.n, 0);
    const struct scene_mesh *is = r.scene.meshes->of;
    assert_int_equal(is->mesh.nparts, 3);
    assert_close(is->volume, 3.0 * 1.6 * 1.6 - 2.6 * 1.2 * 1.2 + 2.2 * 0.8 * 0.8, 1e-5);
    assert_true(scene_mesh_holds(is, (double[]){0.6, 1.0, 1.0}));
    assert_false(scene_mesh_holds(is, (double[]){0.8, 1.0, 1.0}));
    assert_true(scene_mesh_holds(is, (double[]){1.0, 1.0, 1.0}));
    done(&r);
    read_scene(&r, "walls: ( { mesh = \"nested.stl\"; fluid_side = \"outside\"; } );\n");
    assert_false(scene_mesh_holds(r.scene.meshes->of, (double[]){0.6, 1.0, 1.0}));
    assert_true(scene_mesh_holds(r.scene.meshes->of, (double[]){0.1, 1.0, 1.0}));
    done(&r);
    trimesh_free(&m);
}

/* scale, then rotate about the origin, then translate. */
TEST(keys_place_the_mesh)
{
    const double lo[3] = {0, 0, 0}, hi[3] = {1000, 500, 250};
    struct trimesh m = trimesh_box(lo, hi, 1);
    if (rank == 0)
        write_stl(&m, "mm.stl");
    struct reading r;
    read_scene(&r, "walls: ( { mesh = \"mm.stl\"; scale = 0.001; rotate = (0, 0, 90);\n"
                   "translate = (3, 0.5, 0.25); } );\n");
    assert_int_equal(r.f.n, 0);
    const struct scene_mesh *is = r.scene.meshes->of;
    const double want[2][3] = {{2.5, 0.5, 0.25}, {3.0, 1.5, 0.5}};
    for (int a = 0; a < 3; a++) {
        assert_close(is->lo[a], want[0][a], 1e-6);
        assert_close(is->hi[a], want[1][a], 1e-6);
    }
    done(&r);
    trimesh_free(&m);
}

/* The fluid of the shapes says where it is: in a tank, around an obstacle. */
TEST(sides_follow_the_shapes)
{
    struct trimesh m = trimesh_box(low, high, 2);
    if (rank == 0)
        write_stl(&m, "solid.stl");
    struct reading r;
    read_scene(&r, "walls: ( { mesh = \"solid.stl\"; } );\n"
                   "shapes: ( { box = ((0.6, 0.6, 0.6), (1.4, 0.9, 0.9)); } );\n"
                   "fluid: { gravity = (0, 0, -9.81); };\n");
    assert_int_equal(r.scene.meshes->of[0].fluid_side, FLUID_INSIDE);
    done(&r);
    read_scene(&r, "walls: ( { mesh = \"solid.stl\"; }, { side = \"z_min\"; } );\n"
                   "shapes: ( { form = \"below\"; level = 0.8; } );\n"
                   "fluid: { gravity = (0, 0, -9.81); };\n");
    assert_int_equal(r.scene.meshes->of[0].fluid_side, FLUID_OUTSIDE);
    assert_true(trimesh_solid(&r.scene.meshes->of[0].mesh, -1).volume < 0.0);
    done(&r);
    /* an open tank whose normals point into its water is turned, unless flip is given */
    m.ntriangles -= 8;
    trimesh_turn(&m, -1);
    if (rank == 0)
        write_stl(&m, "open.stl");
    read_scene(&r, "walls: ( { mesh = \"open.stl\"; } );\n"
                   "shapes: ( { box = ((0.5, 0.5, 0.5), (1.5, 1.0, 0.9)); } );\n"
                   "fluid: { gravity = (0, 0, -9.81); };\n");
    assert_int_equal(r.f.n, 0);
    assert_false(r.scene.meshes->of[0].mesh.closed);
    assert_true(r.scene.meshes->of[0].turned);
    assert_int_equal(r.scene.meshes->of[0].fluid_side, FLUID_INSIDE);
    assert_true(scene_mesh_holds(r.scene.meshes->of, (double[]){1.0, 0.7, 0.6}));
    done(&r);
    read_scene(&r, "walls: ( { mesh = \"open.stl\"; flip = true; } );\n");
    assert_false(r.scene.meshes->of[0].turned);
    assert_true(scene_mesh_holds(r.scene.meshes->of, (double[]){1.0, 0.7, 0.6}));
    done(&r);
    trimesh_free(&m);
}

/* Fluid of the shapes on both sides: gravity says what is open above and below, and which side of a
 * sheet is its bed; whichever way the file has its normals. */
TEST(gravity_parts_tanks_from_obstacles)
{
    static const struct {
        const char *fluid, *more;
        int open;    /* 0: below, 1: above */
        bool inside; /* that the fluid is in what the walls enclose */
    } cases[] = {{"(0, 0, -9.81)", "", 0, false},
                 {"(0, 0, -9.81)", "", 1, true},
                 {"(0, 0, 9.81)", "", 0, true},
                 {"(0, 0, 9.81)", "", 1, false},
                 {"(0, 0, -9.81)", "fluid_side = \"inside\";", 0, true},
                 {"(0, 0, -9.81)", "fluid_side = \"outside\";", 1, false}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
        for (int sense = -1; sense <= 1; sense += 2) {
            struct trimesh m = trimesh_box(low, high, 1);
            int kept = 0;
            char text[512];
            struct reading r;
            for (int t = 0; t < m.ntriangles; t++) {
                double n[3];
                trimesh_normal(&m, t, n);
                if (n[2] * (cases[k].open ? 1.0 : -1.0) < 0.5)
                    memcpy(m.vertex[kept++], m.vertex[t], sizeof *m.vertex);
            }
            m.ntriangles = kept;
            if (sense < 0)
                trimesh_turn(&m, -1);
            if (rank == 0)
                write_stl(&m, "half.stl");
            snprintf(text, sizeof text,
                     "walls: ( { mesh = \"half.stl\"; %s }, { side = \"z_min\"; } );\n"
                     "shapes: ( { box = ((0, 0, 0), (4, 2, 1.5)); } );\n"
                     "fluid: { gravity = %s; };\n",
                     cases[k].more, cases[k].fluid);
            read_scene(&r, text);
            assert_int_equal(r.f.n, 0);
            assert_int_equal(r.scene.meshes->of[0].fluid_side,
                             cases[k].inside ? FLUID_INSIDE : FLUID_OUTSIDE);
            assert_int_equal(scene_mesh_holds(r.scene.meshes->of, (double[]){1.0, 0.7, 0.8}),
                             cases[k].inside);
            done(&r);
            trimesh_free(&m);
        }
}

/* Two boxes that overlap pierce each other; touching is not piercing. */
TEST(crossings_are_seen)
{
    const double far_lo[3] = {1.2, 0.7, 0.7}, far_hi[3] = {2.0, 1.7, 1.7}, on[3] = {0.5, 0.5, 1.25},
                 top[3] = {1.5, 1.0, 1.75};
    struct trimesh m = trimesh_box(low, high, 1), more = trimesh_box(far_lo, far_hi, 1),
                   above = trimesh_box(on, top, 3);
    struct tree *tree;
    int first;
    tree = tree_create(&m);
    assert_int_equal(trimesh_crossings(&above, tree, &m, MPI_COMM_WORLD, &first), 0);
    assert_int_equal(first, -1);
    assert_true(trimesh_crossings(&more, tree, &m, MPI_COMM_WORLD, &first) > 2);
    FREE(tree);
    trimesh_append(&m, &more);
    trimesh_connect(&m);
    tree = tree_create(&m);
    assert_true(trimesh_crossings(&m, tree, &m, MPI_COMM_WORLD, &first) > 4);
    FREE(tree);
    trimesh_free(&m);
    trimesh_free(&more);
    trimesh_free(&above);
}

/* How far facets are from the sphere or the cylinder, to a factor of 2. */
TEST(sizes_tell_facets_from_the_sphere)
{
    enum { N = 40 };
    const double c[3] = {0, 0, 0};
    double most = 0.0, x[3], circle[N][2];
    struct trimesh m = trimesh_sphere(c, 1.0, 4);
    const struct trimesh_sizes s = trimesh_sizes(&m);
    for (int t = 0; t < m.ntriangles; t++) {
        trimesh_middle(&m, t, x);
        most = fmax(most, 1.0 - vec3_length(x));
    }
    assert_true(s.sagitta > 0.5 * most && s.sagitta < 2.0 * most);
    assert_true(s.least < s.mean && s.mean < s.most);
    trimesh_free(&m);
    for (int k = 0; k < N; k++) {
        circle[k][0] = cos(2.0 * M_PI * k / N);
        circle[k][1] = sin(2.0 * M_PI * k / N);
    }
    m = trimesh_prism(N, (const double(*)[2])circle, 0.0, 1.0);
    most = 1.0 - cos(M_PI / N);
    const double sagitta = trimesh_sizes(&m).sagitta;
    assert_true(sagitta > 0.5 * most && sagitta < 2.01 * most);
    trimesh_free(&m);
}

/* A Moebius strip of five squares has one side only. */
TEST(one_sided_surfaces_are_refused)
{
    enum { N = 12 };
    struct trimesh m = {.nvertices = 2 * N, .ntriangles = 2 * N};
    m.x = (double(*)[3])mem_new((size_t)m.nvertices, sizeof *m.x);
    m.vertex = (int(*)[3])mem_new((size_t)m.ntriangles, sizeof *m.vertex);
    for (int k = 0; k < N; k++) {
        const double q = 2.0 * M_PI * k / N, half = 0.5 * q;
        for (int e = 0; e < 2; e++) {
            const double w = e ? 0.2 : -0.2, d = 0.7 + w * cos(half);
            m.x[2 * k + e][0] = 2.0 + d * cos(q);
            m.x[2 * k + e][1] = 1.0 + d * sin(q);
            m.x[2 * k + e][2] = 1.0 + w * sin(half);
        }
        const int next = (k + 1) % N, twist = k == N - 1;
        const int a = 2 * k, b = 2 * k + 1, c = 2 * next + twist, d = 2 * next + 1 - twist;
        const int v[2][3] = {{a, b, c}, {b, d, c}};
        memcpy(m.vertex[2 * k], v, sizeof v);
    }
    if (rank == 0)
        write_stl(&m, "moebius.stl");
    struct reading r;
    read_scene(&r, "walls: ( { mesh = \"moebius.stl\"; } );\n");
    assert_int_equal(r.f.n, 1);
    done(&r);
    trimesh_free(&m);
}

/* Boxes, by any two opposite corners, spheres, cylinders and prisms without a file have the volume,
 * centre and moment of inertia of what they are, wherever and however turned. */
TEST(simple_forms_are_exact)
{
    static const char text[] =
        "bodies: ( { box = ((0.5, 1.0, 0.5), (1.5, 0.5, 1.25)); },\n"
        "  { radius = 0.4; centre = (2.0, 1.0, 1.5); },\n"
        "  { radius = 0.25; length = 0.8; rotate = (0, 90, 0); translate = (3.0, 1.0, 1.0); },\n"
        "  { points = ((0, 0), (0.6, 0), (0, 0.3)); length = 0.5; rotate = (90, 0, 0); "
        "translate = (1.5, 1.5, 0.2); } );\n";
    const double volume[4] = {0.375, 4.0 / 3.0 * M_PI * 0.064, M_PI * 0.0625 * 0.8, 0.045};
    const double centre[4][3] = {
        {1.0, 0.75, 0.875}, {2.0, 1.0, 1.5}, {3.0, 1.0, 1.0}, {1.7, 1.5, 0.3}};
    const double along_x[4] = {0.375 / 12.0 * (0.25 + 0.5625), 0.4 * 0.16 * volume[1],
                               0.5 * 0.0625 * volume[2], 0.0};
    struct reading r;
    read_scene(&r, text);
    assert_int_equal(r.f.n, 0);
    assert_int_equal(r.scene.meshes->n, 4);
    for (int k = 0; k < 4; k++) {
        const struct scene_mesh *m = scene_mesh_of(&r.scene, MESH_OF_BODY, k);
        const struct trimesh_solid is = trimesh_solid(&m->mesh, -1);
        assert_true(m->mesh.closed && m->fluid_side == FLUID_OUTSIDE);
        assert_close(m->volume, volume[k], (k == 1 || k == 2 ? 1e-3 * volume[k] : 1e-12));
        for (int a = 0; a < 3; a++)
            assert_close(is.centre[a], centre[k][a], 1e-12);
        for (int a = 0; a < 3 && (k == 1 || k == 2); a++) /* about which it turns */
            assert_close(r.scene.bodies[k].centre[a], centre[k][a], 1e-15);
        if (k == 1 || k == 2) { /* to the floor and no further */
            assert_close(m->lo[1], centre[k][1] - (k == 1 ? 0.4 : 0.25), 1e-12);
            assert_close(m->hi[2], centre[k][2] + (k == 1 ? 0.4 : 0.25), 1e-12);
        }
        if (k < 3) /* of facets, to a percent */
            assert_close(fabs(is.inertia[0][0]), along_x[k], (k == 0 ? 1e-12 : 0.01 * along_x[k]));
    }
    done(&r);
}

TEST(half_given_forms_are_refused)
{
    static const char *const wrong[][2] = {
        {"box = ((1, 1, 1), (2, 1, 2));", "bodies.[0].box"},
        {"box = ((1, 1, 1), (2, 1.5, 2)); radius = 0.3;", "bodies.[0].box"},
        {"box = ((1, 1, 1), (2, 1.5, 2)); length = 0.3;", "bodies.[0].box"},
        {"radius = 0.3; centre = (1, 1, 1); translate = (1, 1, 1); free = true; density = 500.0;",
         "bodies.[0].radius"},
        {"radius = 0.3; mesh = \"ball.stl\";", "bodies.[0].radius"},
        {"points = ((0, 0), (1, 0)); length = 1.0;", "bodies.[0].length"},
        {"radius = 0.3; translate = (9, 0, 0);", "bodies.[0].radius"}};
    for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; k++) {
        struct reading r;
        char text[200];
        snprintf(text, sizeof text, "bodies: ( { %s } );\n", wrong[k][0]);
        read_scene(&r, text);
        assert_int_equal(r.f.n, 1);
        if (rank == 0)
            assert_non_null(strstr(r.f.text, wrong[k][1]));
        done(&r);
    }
}

void unit_begin(void)
{
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (!trimesh_has_reader()) {
        MPI_Finalize();
        exit(0);
    }
}
