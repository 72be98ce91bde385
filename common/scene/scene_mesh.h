/* scene_mesh.h - the triangles of a scene's walls, bodies and shapes: read, welded, repaired and
 * given the sense that they must have. Every rank holds all of them.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../geometry/geometry.h"
#include "scene_groups.h"

struct summary;

/* What a mesh belongs to: a shape of fluid, a body, a wall. */
enum mesh_owner { MESH_OF_SHAPE, MESH_OF_BODY, MESH_OF_WALL };
enum { MESH_OF_ALL = 7 }; /* bits 1 << owner */

/* One mesh. Its normals point out of the fluid, of shapes as well. */
struct scene_mesh {
    /* Name in the summary; key in the case, "walls.[0].mesh". */
    char name[64], key[64];
    enum mesh_owner owner;
    int index; /* in the list of its owner; -1: another program has it */
    struct trimesh mesh;
    struct tree *tree; /* over mesh; owned */
    int fluid_side;    /* enum fluid_side, no longer FLUID_AUTO */
    bool turned;       /* an open mesh that was reversed, since fluid was on the wrong side only */
    int welded, flat;  /* vertices joined, triangles without area removed */
    int reversed, parts;     /* triangles against their neighbours, parts inside out; all turned */
    int crossings, crossing; /* triangles that pierce others of the mesh, the first of them */
    struct trimesh_sizes sizes;
    double area, volume; /* m^2, m^3 (0 of open ones) */
    double lo[3], hi[3]; /* m */
    uint64_t hash;
};

/* All meshes of a scene; owned by it. */
struct scene_meshes {
    int n;
    struct scene_mesh of[WALLS_MAX + BODIES_MAX + SHAPES_MAX];
};

/* Whether the case names any mesh. */
bool scene_has_meshes(const struct scene *s);
/* What the case says of the surface of wall, body or shape k. Borrowed from the scene. */
const struct scene_surface *scene_surface_of(const struct scene *s, enum mesh_owner owner, int k);
/* How many walls, bodies or shapes the scene has. */
int scene_mesh_owners(const struct scene *s, enum mesh_owner owner);
/* The key in the case that names the surface's file, or its form, for the place of a fault. */
void scene_mesh_key(const struct scene *s, enum mesh_owner owner, int k, char key[64]);
/* Whether it has triangles, from a file or as a body of simple form in 3D. */
bool scene_has_triangles(const struct scene *s, enum mesh_owner owner, int k);
/* Their file, or the name of the body of simple form, for messages. Borrowed from the scene. */
const char *scene_mesh_source(const struct scene *s, enum mesh_owner owner, int k);
/* Whether fluid is on both sides of it, by the key thin of its wall or body; not of shapes and of
 * what another program has. */
bool scene_mesh_thin(const struct scene *s, const struct scene_mesh *m);
/* Reads and repairs all meshes of the scene into s->meshes (scene_mesh_read.c). Faults name file,
 * triangle and remedy. Collective over comm. */
void scene_meshes_read(struct scene *s, const char *case_dir, const struct params *p, MPI_Comm comm,
                       struct faults *f);
/* Adds the fault WHY for each mesh that the case names for such owners. */
void scene_meshes_refuse(const struct scene *s, enum mesh_owner owner, const struct params *p,
                         const char *why, struct faults *f);
/* Frees s->meshes and sets it to NULL, which it may be. */
void scene_meshes_free(struct scene *s);
/* The mesh of an owner's element of this index; NULL: it has none. Borrowed from the scene. */
const struct scene_mesh *scene_mesh_of(const struct scene *s, enum mesh_owner owner, int index);
/* The triangles of body k; NULL: it has none. */
const struct trimesh *scene_body_mesh(const struct scene *s, int k);
/* Whether x lies on the fluid's side of the surface, which the normals point away from. */
bool scene_mesh_holds(const struct scene_mesh *m, const double *x);
/* What is at a point at the start: nothing, fluid of the shapes on the right side of all meshes, or
 * the inside of a body or an obstacle. */
enum scene_matter { MATTER_NONE, MATTER_FLUID, MATTER_SOLID };
struct exact;
enum scene_matter scene_matter(const struct scene *s, const struct exact *e, const double *x);
/* Logs a line or two on each mesh, with warnings. */
void scene_meshes_say(const struct scene *s);
/* Writes the figures of each mesh to the summary, as mesh.NAME.triangles. */
void scene_meshes_summary(const struct scene *s, struct summary *to);
