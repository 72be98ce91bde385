/* mesh_files.h - meshes as files of the formats that programs exchange, for the tests that read
 * them. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../../common/geometry/trimesh.h"

/* A box without its lid, two triangles a side in each direction; connected. */
static inline struct trimesh open_box(const double *lo, const double *hi)
{
    struct trimesh m = trimesh_box(lo, hi, 2);
    int kept = 0;
    for (int t = 0; t < m.ntriangles; t++) {
        double n[3];
        trimesh_normal(&m, t, n);
        if (n[2] < 0.5)
            memmove(m.vertex[kept++], m.vertex[t], sizeof m.vertex[t]);
    }
    m.ntriangles = kept;
    trimesh_connect(&m);
    return m;
}

static inline FILE *mesh_file(const char *name)
{
    const char *dir = getenv("TEST_SCRATCH");
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", dir ? dir : "/tmp", name);
    return fopen(path, "wb");
}

static inline void write_stl_text(const struct trimesh *m, const char *name)
{
    FILE *f = mesh_file(name);
    fprintf(f, "solid of a test\n");
    for (int t = 0; t < m->ntriangles; t++) {
        fprintf(f, "facet normal 0 0 0\nouter loop\n");
        for (int k = 0; k < 3; k++) {
            const double *x = m->x[m->vertex[t][k]];
            fprintf(f, "vertex %.9g %.9g %.9g\n", x[0], x[1], x[2]);
        }
        fprintf(f, "endloop\nendfacet\n");
    }
    fprintf(f, "endsolid\n");
    fclose(f);
}

static inline void write_stl(const struct trimesh *m, const char *name)
{
    FILE *f = mesh_file(name);
    const char head[80] = "binary";
    const unsigned n = (unsigned)m->ntriangles;
    fwrite(head, 1, sizeof head, f);
    fwrite(&n, sizeof n, 1, f);
    for (int t = 0; t < m->ntriangles; t++) {
        float v[12] = {0.0F};
        const char none[2] = {0, 0};
        for (int k = 0; k < 9; k++)
            v[3 + k] = (float)m->x[m->vertex[t][k / 3]][k % 3];
        fwrite(v, sizeof v, 1, f);
        fwrite(none, 1, sizeof none, f);
    }
    fclose(f);
}

static inline void write_obj(const struct trimesh *m, const char *name)
{
    FILE *f = mesh_file(name);
    for (int v = 0; v < m->nvertices; v++)
        fprintf(f, "v %.9g %.9g %.9g\n", m->x[v][0], m->x[v][1], m->x[v][2]);
    for (int t = 0; t < m->ntriangles; t++)
        fprintf(f, "f %d %d %d\n", m->vertex[t][0] + 1, m->vertex[t][1] + 1, m->vertex[t][2] + 1);
    fclose(f);
}

static inline void write_ply(const struct trimesh *m, const char *name)
{
    FILE *f = mesh_file(name);
    fprintf(f,
            "ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\nproperty float y\n"
            "property float z\nelement face %d\nproperty list uchar int vertex_indices\n"
            "end_header\n",
            m->nvertices, m->ntriangles);
    for (int v = 0; v < m->nvertices; v++)
        fprintf(f, "%.9g %.9g %.9g\n", m->x[v][0], m->x[v][1], m->x[v][2]);
    for (int t = 0; t < m->ntriangles; t++)
        fprintf(f, "3 %d %d %d\n", m->vertex[t][0], m->vertex[t][1], m->vertex[t][2]);
    fclose(f);
}
