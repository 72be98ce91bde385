/* xdmf.c - see xdmf.h. Each snapshot is one piece of text; the file is head, pieces, tail. The
 * pieces of all snapshots stay in memory, one or two kB for each, and the whole file is written
 * anew each time: only so is it complete after every snapshot. Datasets are named with their
 * shapes, slowest index first.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "xdmf.h"

#include "../base/base.h"
#include "disk.h"

static const char head[] =
    "<?xml version=\"1.0\" ?>\n<Xdmf Version=\"2.0\">\n<Domain>\n"
    "<Grid Name=\"snapshots\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
static const char tail[] = "</Grid>\n</Domain>\n</Xdmf>\n";

struct xdmf {
    char path[1100];
    FILE *to;   /* takes the pieces, into memory */
    char *text; /* the pieces as of the last fflush: the stream's own */
    size_t n;
};

/* Pieces of an existing file before t, each from its <Grid to its </Grid>. depth counts open Grids
 * from the piece's own on: a snapshot of several blocks or surfaces has Grids within. A piece that
 * the file's end cuts short is lost. */
static void read_pieces(struct xdmf *x, double t)
{
    FILE *f = fopen(x->path, "r");
    char line[2048];
    long begin = 0;
    double at = 0.0;
    int depth = 0;
    while (f && fgets(line, sizeof line, f)) {
        const char *value = strstr(line, "<Time Value=\"");
        if (strstr(line, "<Grid Name=\"at\"") || (depth > 0 && strstr(line, "<Grid ")))
            depth++;
        if (depth > 0)
            fputs(line, x->to);
        if (value)
            at = atof(value + 13);
        if (depth > 0 && strstr(line, "</Grid>") && --depth == 0) {
            if (at >= t * (1.0 - 1e-12))
                fseek(x->to, begin, SEEK_SET);
            begin = ftell(x->to);
        }
    }
    fseek(x->to, begin, SEEK_SET);
    if (f)
        fclose(f);
}

static void close_stream(void *p)
{
    const struct xdmf *x = p;
    if (x->to)
        fclose(x->to);
    free(x->text);
}

struct xdmf *xdmf_create(const char *path, bool keep, double t_restart)
{
    struct xdmf *x = NEW(struct xdmf, 1);
    mem_at_free(x, close_stream);
    snprintf(x->path, sizeof x->path, "%s", path);
    x->to = open_memstream(&x->text, &x->n);
    require(x->to);
    if (keep)
        read_pieces(x, t_restart);
    return x;
}

/* Begins the piece of a snapshot at t: one grid, or a collection of several. */
static void begin(struct xdmf *x, double t, bool collection)
{
    fprintf(x->to, "<Grid Name=\"at\" GridType=\"%s\">\n<Time Value=\"%.17g\"/>\n",
            collection ? "Collection\" CollectionType=\"Spatial" : "Uniform", t);
}

/* Ends it and writes the file anew. */
static void end(struct xdmf *x)
{
    fputs("</Grid>\n", x->to);
    require(fflush(x->to) == 0);
    FILE *f = disk_begin(x->path);
    fprintf(f, "%s%.*s%s", head, (int)x->n, x->text, tail);
    disk_finish(f, x->path);
}

/* One Attribute for each field: of points (center "Node") or of cells ("Cell"), stored as float in
 * the dataset of its name and `suffix'. */
static void add_fields(struct xdmf *x, const char *center, const char *shape, const char *file,
                       const char *suffix, int nfields, const struct xdmf_field *fields)
{
    for (int k = 0; k < nfields; k++) {
        const int c = fields[k].ncomp;
        char comps[16] = "";
        if (c > 1)
            snprintf(comps, sizeof comps, " %d", c);
        fprintf(
            x->to,
            "<Attribute Name=\"%s\" AttributeType=\"%s\" Center=\"%s\"><DataItem Format=\"HDF\" "
            "NumberType=\"Float\" Precision=\"4\" "
            "Dimensions=\"%s%s\">%s:/%s%s</DataItem></Attribute>\n",
            fields[k].name,
            c == 3   ? "Vector"
            : c == 1 ? "Scalar"
                     : "Matrix",
            center, shape, comps, file, fields[k].name, suffix);
    }
}

void xdmf_points(struct xdmf *x, double t, const char *file, int64_t n, int dim, int nfields,
                 const struct xdmf_field *fields)
{
    char shape[32];
    snprintf(shape, sizeof shape, "%lld", (long long)n);
    begin(x, t, false);
    fprintf(x->to, "<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"%s\"/>\n", shape);
    fprintf(x->to,
            "<Geometry GeometryType=\"%s\"><DataItem Format=\"HDF\" NumberType=\"Float\" "
            "Precision=\"4\" "
            "Dimensions=\"%s %d\">%s:/position</DataItem></Geometry>\n",
            dim == 2 ? "XY" : "XYZ", shape, dim, file);
    add_fields(x, "Node", shape, file, "", nfields, fields);
    end(x);
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
    fprintf(x->to,
            "<Topology TopologyType=\"3DRectMesh\" Dimensions=\"%s\"/>\n<Geometry "
            "GeometryType=\"VXVYVZ\">",
            nodes);
    for (int a = 0; a < 3; a++) {
        fprintf(x->to,
                "<DataItem Format=\"XML\" NumberType=\"Float\" Precision=\"8\" Dimensions=\"%d\">",
                cells[a] + 1);
        for (int i = 0; i <= cells[a]; i++)
            fprintf(x->to, "%s%.9g", i ? " " : "", a == 1 ? edges[i] : origin[a] + i * spacing[a]);
        fprintf(x->to, "</DataItem>");
    }
    fprintf(x->to, "</Geometry>\n");
}

/* XDMF gives origin and spacing of a regular mesh in the order of the indices, z first; coordinates
 * of unequal planes are named by axis instead. */
void xdmf_block(struct xdmf *x, double t, const char *file, const int *cells, const double *origin,
                const double *spacing, const double *edges, int nfields,
                const struct xdmf_field *fields)
{
    char shape[64], nodes[64];
    begin(x, t, false);
    set_shape(3, cells, shape, nodes, sizeof shape);
    if (edges)
        add_edges(x, cells, origin, spacing, edges, nodes);
    else
        fprintf(
            x->to,
            "<Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"%s\"/>\n<Geometry "
            "GeometryType=\"ORIGIN_DXDYDZ\"><DataItem Format=\"XML\" Dimensions=\"3\">%.17g %.17g "
            "%.17g</DataItem><DataItem Format=\"XML\" Dimensions=\"3\">%.17g %.17g "
            "%.17g</DataItem></Geometry>\n",
            nodes, origin[2], origin[1], origin[0], spacing[2], spacing[1], spacing[0]);
    add_fields(x, "Cell", shape, file, "", nfields, fields);
    end(x);
}

void xdmf_flat(struct xdmf *x, double t, const char *file, const char *grid, const int *cells,
               int nfields, const struct xdmf_field *fields)
{
    char shape[64], nodes[64];
    begin(x, t, false);
    set_shape(2, cells, shape, nodes, sizeof shape);
    fprintf(x->to,
            "<Topology TopologyType=\"2DSMesh\" Dimensions=\"%s\"/>\n<Geometry GeometryType=\"XY\">"
            "<DataItem Format=\"HDF\" NumberType=\"Float\" Precision=\"8\" Dimensions=\"%s "
            "2\">%s:/vertices</DataItem></Geometry>\n",
            nodes, nodes, grid);
    add_fields(x, "Cell", shape, file, "", nfields, fields);
    end(x);
}

/* Block k of a snapshot, datasets with the suffix _k; `cells' of this block. */
static void add_curved(struct xdmf *x, const char *file, int dim, int k, const int *cells,
                       int nfields, const struct xdmf_field *fields)
{
    char shape[64], nodes[64];
    set_shape(dim, cells, shape, nodes, sizeof shape);
    fprintf(x->to, "<Grid Name=\"block %d\" GridType=\"Uniform\">\n", k);
    fprintf(x->to,
            "<Topology TopologyType=\"%s\" Dimensions=\"%s\"/>\n<Geometry GeometryType=\"%s\">"
            "<DataItem Format=\"HDF\" NumberType=\"Float\" Precision=\"8\" Dimensions=\"%s "
            "%d\">%s:/x_%d</DataItem></Geometry>\n",
            dim == 2 ? "2DSMesh" : "3DSMesh", nodes, dim == 2 ? "XY" : "XYZ", nodes, dim, file, k);
    add_fields(x, "Cell", shape, file, key_text("_%d", k), nfields, fields);
    fprintf(x->to, "</Grid>\n");
}

void xdmf_curved(struct xdmf *x, double t, const char *file, int dim, int nblocks,
                 const int (*cells)[3], int nfields, const struct xdmf_field *fields)
{
    begin(x, t, true);
    for (int k = 0; k < nblocks; k++)
        add_curved(x, file, dim, k + 1, cells[k], nfields, fields);
    end(x);
}

void xdmf_surfaces(struct xdmf *x, double t, int n, const struct xdmf_surface *of)
{
    begin(x, t, true);
    for (int k = 0; k < n; k++)
        fprintf(
            x->to,
            "<Grid Name=\"%s\" GridType=\"Uniform\">\n<Topology TopologyType=\"Triangle\" "
            "NumberOfElements=\"%d\"><DataItem Format=\"HDF\" NumberType=\"Int\" Precision=\"8\" "
            "Dimensions=\"%lld\">%s:/%s</DataItem></Topology>\n<Geometry GeometryType=\"XYZ\">"
            "<DataItem Format=\"HDF\" NumberType=\"Float\" Precision=\"4\" Dimensions=\"%d "
            "3\">%s:/%s</DataItem></Geometry>\n</Grid>\n",
            of[k].name, of[k].ntriangles, 3LL * of[k].ntriangles, of[k].triangles_file,
            of[k].triangles, of[k].nvertices, of[k].vertices_file, of[k].vertices);
    end(x);
}

void xdmf_outlines(struct xdmf *x, double t, const char *file, int nlines, const char *const *names,
                   const int *n)
{
    begin(x, t, true);
    for (int k = 0; k < nlines; k++) {
        fprintf(x->to,
                "<Grid Name=\"%s\" GridType=\"Uniform\">\n<Topology TopologyType=\"Polyline\" "
                "NumberOfElements=\"1\" NodesPerElement=\"%d\"><DataItem Format=\"XML\" "
                "NumberType=\"Int\" Dimensions=\"1 %d\">",
                names[k], n[k] + 1, n[k] + 1);
        for (int i = 0; i <= n[k]; i++)
            fprintf(x->to, "%d ", i % n[k]);
        fprintf(x->to,
                "</DataItem></Topology>\n<Geometry GeometryType=\"XY\"><DataItem Format=\"HDF\" "
                "NumberType=\"Float\" Precision=\"4\" Dimensions=\"%d 2\">%s:/outline_%d</DataItem>"
                "</Geometry>\n</Grid>\n",
                n[k], file, k + 1);
    }
    end(x);
}
