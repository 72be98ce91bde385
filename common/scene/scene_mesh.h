/* scene_mesh.h - the triangles of a scene's walls, bodies and shapes: read, repaired, given the
 * sense that they must have. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_SCENE_MESH_H
#define COMMON_SCENE_MESH_H

#include "../geometry/trimesh_check.h"
#include "scene.h"

struct summary;

enum mesh_owner { MESH_OF_SHAPE, MESH_OF_BODY, MESH_OF_WALL };
enum { MESH_OF_ALL = 7 }; /* bits 1 << owner */

/* Of walls and bodies the normals point out of the fluid, of shapes out of it as well. */
struct scene_mesh {
    char name[64], key[64]; /* in the summary; in the case, "walls.[0].mesh" */
    enum mesh_owner owner;
    int index; /* in the list of its owner; -1: another program has it */
    struct trimesh mesh;
    struct tree *tree;
    int fluid_side;          /* enum fluid_side, no longer FLUID_AUTO */
    bool turned;             /* an open one, for fluid was on the wrong side alone */
    int welded, flat;        /* vertices made one, triangles without area taken out */
    int reversed, parts;     /* triangles against their neighbours, parts inside out: all turned */
    int crossings, crossing; /* triangles that pierce others of the mesh, the first of them */
    struct trimesh_sizes sizes;
    double area, volume; /* m^2, m^3 (0 of open ones) */
    double lo[3], hi[3]; /* m */
    uint64_t hash;
};

struct scene_meshes {
    int n;
    struct scene_mesh of[WALLS_MAX + BODIES_MAX + SHAPES_MAX];
};

/* Whether the case names any mesh. */
bool scene_has_meshes(const struct scene *s);
/* What a wall, body or shape has for a mesh; how many of them there are; the key of its file. */
const struct scene_surface *scene_surface_of(const struct scene *s, enum mesh_owner owner, int k);
int scene_mesh_owners(const struct scene *s, enum mesh_owner owner);
void scene_mesh_key(enum mesh_owner owner, int k, char key[64]);
/* scene_mesh_read.c: reads all meshes of the scene into s->meshes; faults name file, triangle and
 * remedy. Collective over comm. */
void scene_meshes_read(struct scene *s, const char *case_dir, const struct params *p, MPI_Comm comm,
                       struct faults *f);
/* A fault for each mesh of such owners that the case names. */
void scene_meshes_refuse(const struct scene *s, enum mesh_owner owner, const struct params *p,
                         const char *why, struct faults *f);
void scene_meshes_free(struct scene *s);
/* NULL: it has none. */
const struct scene_mesh *scene_mesh_of(const struct scene *s, enum mesh_owner owner, int index);
/* The triangles of a body; NULL: it has none. */
const struct trimesh *scene_body_mesh(const struct scene *s, int k);
/* Whether x lies on the side of the surface that the normals point away from. */
bool scene_mesh_holds(const struct scene_mesh *m, const double *x);
/* What is at x at the start: fluid of the shapes on the right side of all meshes, or the inside of
 * a body or an obstacle. */
enum scene_matter { MATTER_NONE, MATTER_FLUID, MATTER_SOLID };
struct exact;
enum scene_matter scene_matter(const struct scene *s, const struct exact *e, const double *x);
/* A line or two on each mesh through log_say and log_warn. */
void scene_meshes_say(const struct scene *s);
void scene_meshes_summary(const struct scene *s, struct summary *to);

#endif
