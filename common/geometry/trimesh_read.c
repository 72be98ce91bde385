/* trimesh_read.c - files of triangles through assimp (Open Asset Import Library), if the program
 * was built with it. It hands out numbers in single precision.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "trimesh_read.h"

#include <ctype.h>
#ifdef HAVE_ASSIMP
#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#endif

#include "../base/base.h"

/* Known endings: what else assimp reads has moving parts, units and hierarchies. */
static bool is_known(const char *path)
{
    static const char *const known[] = {"stl", "obj", "ply"};
    const char *dot = strrchr(path, '.');
    for (int k = 0; dot && k < 3; k++) {
        int i = 0;
        while (i < 3 && tolower((unsigned char)dot[1 + i]) == known[k][i])
            i++;
        if (i == 3 && dot[4] == '\0')
            return true;
    }
    return false;
}

/* Readable, and not empty. */
static bool is_file(const char *path)
{
    FILE *f = fopen(path, "rb");
    const bool readable = f && fgetc(f) != EOF;
    if (f)
        fclose(f);
    return readable;
}

#ifdef HAVE_ASSIMP

bool trimesh_has_reader(void) { return true; }

/* assimp triangulates polygons, drops points and lines and all that is not geometry; it does not
 * join vertices, which trimesh_weld does with a tolerance of our own. */
static const struct aiScene *import(const char *path)
{
    struct aiPropertyStore *how = aiCreatePropertyStore();
    aiSetImportPropertyInteger(how, AI_CONFIG_PP_RVC_FLAGS,
                               aiComponent_NORMALS | aiComponent_COLORS | aiComponent_TEXCOORDS |
                                   aiComponent_MATERIALS);
    aiSetImportPropertyInteger(how, AI_CONFIG_PP_SBP_REMOVE,
                               aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    const struct aiScene *s = aiImportFileExWithProperties(
        path, aiProcess_Triangulate | aiProcess_RemoveComponent | aiProcess_SortByPType, NULL, how);
    aiReleasePropertyStore(how);
    return s;
}

/* All of a file's meshes go into one list; faces that are no triangles are left out. */
static void add(struct trimesh *m, const struct aiMesh *from)
{
    GROW(m->x, m->nvertices, m->nvertices + (int)from->mNumVertices);
    GROW(m->vertex, m->ntriangles, m->ntriangles + (int)from->mNumFaces);
    for (unsigned f = 0; f < from->mNumFaces; f++) {
        const struct aiFace *face = from->mFaces + f;
        if (face->mNumIndices != 3)
            continue;
        for (int k = 0; k < 3; k++)
            m->vertex[m->ntriangles][k] = m->nvertices + (int)face->mIndices[k];
        m->ntriangles++;
    }
    for (unsigned v = 0; v < from->mNumVertices; v++, m->nvertices++) {
        m->x[m->nvertices][0] = (double)from->mVertices[v].x;
        m->x[m->nvertices][1] = (double)from->mVertices[v].y;
        m->x[m->nvertices][2] = (double)from->mVertices[v].z;
    }
}

static bool read_known(const char *path, struct trimesh *m, char *why, size_t size)
{
    const struct aiScene *s = import(path);
    if (!s) {
        snprintf(why, size, "%.200s: export it anew, as binary STL", aiGetErrorString());
        return false;
    }
    for (unsigned k = 0; k < s->mNumMeshes; k++)
        add(m, s->mMeshes[k]);
    aiReleaseImport(s);
    return true;
}

#else

bool trimesh_has_reader(void) { return false; }

static bool read_known(const char *path, struct trimesh *m, char *why, size_t size)
{
    (void)path;
    (void)m;
    snprintf(why, size,
             "this program was built without a reader of meshes: `make deps' installs "
             "libassimp-dev, then build anew");
    return false;
}

#endif

/* A failed read leaves an empty mesh, and nothing to free. */
bool trimesh_read(const char *path, struct trimesh *m, char *why, size_t size)
{
    *m = (struct trimesh){0};
    if (!is_known(path)) {
        snprintf(why, size, "expected a file of STL, OBJ or PLY, named .stl, .obj or .ply");
        return false;
    }
    if (!is_file(path)) {
        snprintf(why, size, "there is no such file, or nothing in it; looked for %s", path);
        return false;
    }
    if (!read_known(path, m, why, size))
        return false;
    if (m->ntriangles == 0)
        snprintf(why, size, "no triangles are in it: export a surface, not points or lines");
    for (int v = 0; v < m->nvertices && m->ntriangles > 0; v++)
        if (!isfinite(m->x[v][0]) || !isfinite(m->x[v][1]) || !isfinite(m->x[v][2])) {
            snprintf(why, size, "vertex %d is not finite: export it anew", v);
            m->ntriangles = 0;
        }
    if (m->ntriangles == 0)
        trimesh_free(m);
    return m->ntriangles > 0;
}

/* In pieces of 1 GB, as counts of MPI_Bcast are int. */
static void *share(void *p, int n, size_t size, int rank, MPI_Comm comm)
{
    const size_t bytes = (size_t)n * size, chunk = (size_t)1 << 30;
    if (rank > 0)
        p = mem_new((size_t)n, size);
    for (size_t at = 0; at < bytes; at += chunk)
        MPI_Bcast((char *)p + at, (int)(bytes - at < chunk ? bytes - at : chunk), MPI_BYTE, 0,
                  comm);
    return p;
}

/* Sizes and flags go as one struct, whose pointers each rank then replaces by its own. */
void trimesh_broadcast(struct trimesh *m, MPI_Comm comm)
{
    struct trimesh all = *m;
    int rank;
    MPI_Comm_rank(comm, &rank);
    MPI_Bcast(&all, (int)sizeof all, MPI_BYTE, 0, comm);
    all.x = share(m->x, all.nvertices, sizeof *all.x, rank, comm);
    all.vertex = share(m->vertex, all.ntriangles, sizeof *all.vertex, rank, comm);
    all.neighbour = share(m->neighbour, all.ntriangles, sizeof *all.neighbour, rank, comm);
    all.part = share(m->part, all.ntriangles, sizeof *all.part, rank, comm);
    *m = all;
}
