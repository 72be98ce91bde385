/* xdmf.c - see xdmf.h. Each snapshot is one piece of text; the file is head, pieces, tail. The
 * pieces of all snapshots stay in memory, one or two kB for each, and the whole file is written
 * anew each time: only so is it complete after every snapshot. Datasets are named with their
 * shapes, slowest index first.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "xdmf.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../base/base.h"
#include "disk.h"

static const char head[] =
    "<?xml version=\"1.0\" ?>\n<Xdmf Version=\"2.0\">\n<Domain>\n"
    "<Grid Name=\"snapshots\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
static const char tail[] = "</Grid>\n</Domain>\n</Xdmf>\n";

struct xdmf {
    char path[1100];
    char *text; /* the pieces; owned */
    size_t n, room;
};

/* Appends formatted text; the room at least doubles, so that n pieces cost O(n) copies. */
static void __attribute__((format(printf, 2, 3))) add(struct xdmf *x, const char *fmt, ...)
{
    va_list args;
    va_start(args, fmt);
    const int more = vsnprintf(NULL, 0, fmt, args);
    va_end(args);
    if (x->n + (size_t)more + 1 > x->room) {
        const size_t room = 2 * (x->n + (size_t)more) + 1024;
        x->text = mem_grow(x->text, x->text ? x->n + 1 : 0, room, 1);
        x->room = room;
    }
    va_start(args, fmt);
    vsnprintf(x->text + x->n, (size_t)more + 1, fmt, args);
    va_end(args);
    x->n += (size_t)more;
}

/* Pieces of an existing file before t, each from its <Grid to its </Grid>. depth counts open Grids
 * from the piece's own on: a snapshot of several blocks or surfaces has Grids within. A piece that
 * the file's end cuts short is lost. */
static void read_pieces(struct xdmf *x, double t)
{
    FILE *f = fopen(x->path, "r");
    char line[2048];
    struct xdmf piece = {0};
    double at = 0.0;
    int depth = 0;
    while (f && fgets(line, sizeof line, f)) {
        const char *value = strstr(line, "<Time Value=\"");
        if (strstr(line, "<Grid Name=\"at\"") || (depth > 0 && strstr(line, "<Grid ")))
            depth++;
        if (depth > 0)
            add(&piece, "%s", line);
        if (value)
            at = atof(value + 13);
        if (depth > 0 && strstr(line, "</Grid>") && --depth == 0) {
            if (at < t * (1.0 - 1e-12))
                add(x, "%s", piece.text);
            piece.n = 0;
        }
    }
    if (f)
        fclose(f);
    mem_free(piece.text);
}

struct xdmf *xdmf_create(const char *path, bool keep, double t_restart)
{
    struct xdmf *x = NEW(struct xdmf, 1);
    snprintf(x->path, sizeof x->path, "%s", path);
    if (keep)
        read_pieces(x, t_restart);
    return x;
}

void xdmf_free(struct xdmf **x)
{
    if (*x)
        mem_free((*x)->text);
    mem_free(*x);
    *x = NULL;
}

/* Under another name first, then in place of the old one, so that ParaView never reads half a
 * file. */
static void rewrite(const struct xdmf *x)
{
    char part[1110];
    snprintf(part, sizeof part, "%s.part", x->path);
    FILE *f = fopen(part, "w");
    if (!f)
        disk_failed(part);
    fprintf(f, "%s%s%s", head, x->text ? x->text : "", tail);
    if (fclose(f) != 0 || rename(part, x->path) != 0)
        disk_failed(x->path);
}

/* One Attribute for each field: of points (center "Node") or of cells ("Cell"), stored as float. */
static void add_fields(struct xdmf *x, const char *center, const char *shape, const char *file,
                       int nfields, const struct xdmf_field *fields)
{
    for (int k = 0; k < nfields; k++) {
        const int c = fields[k].ncomp;
        char comps[16] = "";
        if (c > 1)
            snprintf(comps, sizeof comps, " %d", c);
        add(x,
            "<Attribute Name=\"%s\" AttributeType=\"%s\" Center=\"%s\"><DataItem Format=\"HDF\" "
            "NumberType=\"Float\" Precision=\"4\" "
            "Dimensions=\"%s%s\">%s:/%s</DataItem></Attribute>\n",
            fields[k].name,
            c == 3   ? "Vector"
            : c == 1 ? "Scalar"
                     : "Matrix",
            center, shape, comps, file, fields[k].name);
    }
}

void xdmf_points(struct xdmf *x, double t, const char *file, int64_t n, int dim, int nfields,
                 const struct xdmf_field *fields)
{
    char shape[32];
    snprintf(shape, sizeof shape, "%lld", (long long)n);
    add(x, "<Grid Name=\"at\" GridType=\"Uniform\">\n<Time Value=\"%.17g\"/>\n", t);
    add(x, "<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"%s\"/>\n", shape);
    add(x,
        "<Geometry GeometryType=\"%s\"><DataItem Format=\"HDF\" NumberType=\"Float\" "
        "Precision=\"4\" "
        "Dimensions=\"%s %d\">%s:/position</DataItem></Geometry>\n",
        dim == 2 ? "XY" : "XYZ", shape, dim, file);
    add_fields(x, "Node", shape, file, nfields, fields);
    add(x, "</Grid>\n");
    rewrite(x);
}

/* Numbers of cells and of vertices, slowest index first, as texts. */
static void set_shape(int dim, const int *cells, char *shape, char *nodes, size_t size)
{
    if (dim == 2) {
        snprintf(shape, size, "%d %d", cells[1], cells[0]);
        snprintf(nodes, size, "%d %d", cells[1] + 1, cells[0] + 1);
    } else {
        snprintf(shape, size, "%d %d %d", cells[2], cells[1], cells[0]);
        snprintf(nodes, size, "%d %d %d", cells[2] + 1, cells[1] + 1, cells[0] + 1);
    }
}

/* Places of the vertices along each axis, written out. */
static void add_edges(struct xdmf *x, const int *cells, const double *origin, const double *spacing,
                      const double *edges, const char *nodes)
{
    add(x,
        "<Topology TopologyType=\"3DRectMesh\" Dimensions=\"%s\"/>\n<Geometry "
        "GeometryType=\"VXVYVZ\">",
        nodes);
    for (int a = 0; a < 3; a++) {
        add(x, "<DataItem Format=\"XML\" NumberType=\"Float\" Precision=\"8\" Dimensions=\"%d\">",
            cells[a] + 1);
        for (int i = 0; i <= cells[a]; i++)
            add(x, "%s%.9g", i ? " " : "", a == 1 ? edges[i] : origin[a] + i * spacing[a]);
        add(x, "</DataItem>");
    }
    add(x, "</Geometry>\n");
}

/* XDMF gives origin and spacing of a regular mesh in the order of the indices, z first; coordinates
 * of unequal planes are named by axis instead. */
void xdmf_block(struct xdmf *x, double t, const char *file, const int *cells, const double *origin,
                const double *spacing, const double *edges, int nfields,
                const struct xdmf_field *fields)
{
    char shape[64], nodes[64];
    add(x, "<Grid Name=\"at\" GridType=\"Uniform\">\n<Time Value=\"%.17g\"/>\n", t);
    set_shape(3, cells, shape, nodes, sizeof shape);
    if (edges)
        add_edges(x, cells, origin, spacing, edges, nodes);
    else
        add(x,
            "<Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"%s\"/>\n<Geometry "
            "GeometryType=\"ORIGIN_DXDYDZ\"><DataItem Format=\"XML\" Dimensions=\"3\">%.17g %.17g "
            "%.17g</DataItem><DataItem Format=\"XML\" Dimensions=\"3\">%.17g %.17g "
            "%.17g</DataItem></Geometry>\n",
            nodes, origin[2], origin[1], origin[0], spacing[2], spacing[1], spacing[0]);
    add_fields(x, "Cell", shape, file, nfields, fields);
    add(x, "</Grid>\n");
    rewrite(x);
}

void xdmf_flat(struct xdmf *x, double t, const char *file, const char *grid, const int *cells,
               int nfields, const struct xdmf_field *fields)
{
    char shape[64], nodes[64];
    add(x, "<Grid Name=\"at\" GridType=\"Uniform\">\n<Time Value=\"%.17g\"/>\n", t);
    set_shape(2, cells, shape, nodes, sizeof shape);
    add(x,
        "<Topology TopologyType=\"2DSMesh\" Dimensions=\"%s\"/>\n<Geometry GeometryType=\"XY\">"
        "<DataItem Format=\"HDF\" NumberType=\"Float\" Precision=\"8\" Dimensions=\"%s "
        "2\">%s:/vertices</DataItem></Geometry>\n",
        nodes, nodes, grid);
    add_fields(x, "Cell", shape, file, nfields, fields);
    add(x, "</Grid>\n");
    rewrite(x);
}

/* Block k of a snapshot, datasets with the suffix _k; `cells' of this block. */
static void add_curved(struct xdmf *x, const char *file, int dim, int k, const int *cells,
                       int nfields, const struct xdmf_field *fields)
{
    char shape[64], nodes[64];
    set_shape(dim, cells, shape, nodes, sizeof shape);
    add(x, "<Grid Name=\"block %d\" GridType=\"Uniform\">\n", k);
    add(x,
        "<Topology TopologyType=\"%s\" Dimensions=\"%s\"/>\n<Geometry GeometryType=\"%s\">"
        "<DataItem Format=\"HDF\" NumberType=\"Float\" Precision=\"8\" Dimensions=\"%s "
        "%d\">%s:/x_%d</DataItem></Geometry>\n",
        dim == 2 ? "2DSMesh" : "3DSMesh", nodes, dim == 2 ? "XY" : "XYZ", nodes, dim, file, k);
    for (int q = 0; q < nfields; q++) {
        const bool vector = fields[q].ncomp == 3;
        add(x,
            "<Attribute Name=\"%s\" AttributeType=\"%s\" Center=\"Cell\"><DataItem Format=\"HDF\" "
            "NumberType=\"Float\" Precision=\"4\" "
            "Dimensions=\"%s%s\">%s:/%s_%d</DataItem></Attribute>\n",
            fields[q].name, vector ? "Vector" : "Scalar", shape, vector ? " 3" : "", file,
            fields[q].name, k);
    }
    add(x, "</Grid>\n");
}

void xdmf_curved(struct xdmf *x, double t, const char *file, int dim, int nblocks,
                 const int (*cells)[3], int nfields, const struct xdmf_field *fields)
{
    add(x,
        "<Grid Name=\"at\" GridType=\"Collection\" CollectionType=\"Spatial\">\n<Time "
        "Value=\"%.17g\"/>\n",
        t);
    for (int k = 0; k < nblocks; k++)
        add_curved(x, file, dim, k + 1, cells[k], nfields, fields);
    add(x, "</Grid>\n");
    rewrite(x);
}

void xdmf_surfaces(struct xdmf *x, double t, int n, const struct xdmf_surface *of)
{
    add(x,
        "<Grid Name=\"at\" GridType=\"Collection\" CollectionType=\"Spatial\">\n<Time "
        "Value=\"%.17g\"/>\n",
        t);
    for (int k = 0; k < n; k++)
        add(x,
            "<Grid Name=\"%s\" GridType=\"Uniform\">\n<Topology TopologyType=\"Triangle\" "
            "NumberOfElements=\"%d\"><DataItem Format=\"HDF\" NumberType=\"Int\" Precision=\"8\" "
            "Dimensions=\"%lld\">%s:/%s</DataItem></Topology>\n<Geometry GeometryType=\"XYZ\">"
            "<DataItem Format=\"HDF\" NumberType=\"Float\" Precision=\"4\" Dimensions=\"%d "
            "3\">%s:/%s</DataItem></Geometry>\n</Grid>\n",
            of[k].name, of[k].ntriangles, 3LL * of[k].ntriangles, of[k].triangles_file,
            of[k].triangles, of[k].nvertices, of[k].vertices_file, of[k].vertices);
    add(x, "</Grid>\n");
    rewrite(x);
}

void xdmf_outlines(struct xdmf *x, double t, const char *file, int nlines, const char *const *names,
                   const int *n)
{
    add(x,
        "<Grid Name=\"at\" GridType=\"Collection\" CollectionType=\"Spatial\">\n<Time "
        "Value=\"%.17g\"/>\n",
        t);
    for (int k = 0; k < nlines; k++) {
        add(x,
            "<Grid Name=\"%s\" GridType=\"Uniform\">\n<Topology TopologyType=\"Polyline\" "
            "NumberOfElements=\"1\" NodesPerElement=\"%d\"><DataItem Format=\"XML\" "
            "NumberType=\"Int\" Dimensions=\"1 %d\">",
            names[k], n[k] + 1, n[k] + 1);
        for (int i = 0; i <= n[k]; i++)
            add(x, "%d ", i % n[k]);
        add(x,
            "</DataItem></Topology>\n<Geometry GeometryType=\"XY\"><DataItem Format=\"HDF\" "
            "NumberType=\"Float\" Precision=\"4\" Dimensions=\"%d 2\">%s:/outline_%d</DataItem>"
            "</Geometry>\n</Grid>\n",
            n[k], file, k + 1);
    }
    add(x, "</Grid>\n");
    rewrite(x);
}
