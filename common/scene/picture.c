/* picture.c - a scene as SVG. SPDX-License-Identifier: BSD-3-Clause */
#include "picture.h"

#include "../files/files.h"
#include "picture_section.h"
#include "scene_fluid.h"
#include "scene_lines.h"
#include "scene_probe.h"
#include "scene_waves.h"

enum { WIDTH = 900, MARGIN = 60, LEGEND = 22, TICKS = 12, LABELS = 64, LETTER = 7, LINE = 13 };

struct picture {
    FILE *f;
    char path[1200];
    const struct scene *s;
    int axis[2];               /* to the right and up: x and y, in 3D x and z */
    double lo[2], hi[2];       /* m: what is shown */
    double scale, top, height; /* px/m; px above the view; px of all views */
    bool used[PICTURE_KINDS];
    FILE *cells; /* outlines of them, of the first view; empty: the whole domain */
    char *cells_text;
    size_t cells_size;
    double label[LABELS][3]; /* px: left, right and foot of what is written */
    int nlabels;
};

static const struct {
    const char *name, *stroke, *fill;
    double width;
} style[PICTURE_KINDS] = {{"water", "none", "#9ecae1", 0},
                          {"taken out", "none", "#ffffff", 0},
                          {"zone that makes or absorbs waves", "none", "#fec44f", 0},
                          {"slip wall", "#333333", "#cccccc", 2.5},
                          {"no-slip wall", "#a50f15", "#cccccc", 2.5},
                          {"inlet, outlet, absorbing side", "#238b45", "none", 3},
                          {"periodic side", "#999999", "none", 1},
                          {"body", "#333333", "#d9d9d9", 2},
                          {"probe", "#d94801", "#d94801", 1.5},
                          {"zone of particles", "#6a51a3", "none", 1.5},
                          {"cells", "#2171b5", "none", 1},
                          {"region of refinement", "#e7298a", "none", 1.5}};

/* From m to px; those of the page run downwards. */
static double px(const struct picture *p, double x) { return MARGIN + p->scale * (x - p->lo[0]); }
static double py(const struct picture *p, double y)
{
    return p->top + MARGIN + p->scale * (p->hi[1] - y);
}

/* Ends an element with the colours of its kind, which then stands in the legend. */
static void paint(struct picture *p, enum picture_kind kind, bool fill)
{
    p->used[kind] = true;
    fprintf(p->f, " stroke=\"%s\" stroke-width=\"%g\" fill=\"%s\"%s/>\n", style[kind].stroke,
            style[kind].width, fill ? style[kind].fill : "none",
            kind == PICTURE_WAVES                              ? " fill-opacity=\"0.3\""
            : kind == PICTURE_PERIODIC || kind == PICTURE_ZONE ? " stroke-dasharray=\"7 4\""
                                                               : "");
}

/* The first foot from y upwards at which a label of this width is on no other. */
static double free_line(struct picture *p, double x, double width, double y)
{
    for (int k = 0; k < p->nlabels; k++)
        if (x < p->label[k][1] && x + width > p->label[k][0] && fabs(y - p->label[k][2]) < LINE) {
            y = p->label[k][2] - LINE;
            k = -1;
        }
    if (p->nlabels < LABELS) {
        double *to = p->label[p->nlabels++];
        to[0] = x, to[1] = x + width, to[2] = y;
    }
    return y;
}

void picture_text(struct picture *p, const double at[3], const char *text)
{
    const double x = px(p, at[p->axis[0]]) + 4, y = py(p, at[p->axis[1]]) - 4;
    fprintf(p->f, "<text x=\"%.1f\" y=\"%.1f\" font-size=\"12\">", x,
            free_line(p, x, LETTER * (double)strlen(text), y));
    for (; *text; text++)
        if (*text == '<' || *text == '&')
            fputs(*text == '<' ? "&lt;" : "&amp;", p->f);
        else
            fputc(*text, p->f);
    fputs("</text>\n", p->f);
}

/* Ticks of a few pixels to the left of the way from a to b. */
static void normals(const struct picture *p, enum picture_kind kind, const double a[2],
                    const double b[2])
{
    const double dx = b[0] - a[0], dy = b[1] - a[1], l = hypot(dx, dy);
    const int n = (int)fmin(fmax(p->scale * l / 40.0, 1.0), TICKS);
    for (int k = 0; k < n && l > 0.0; k++) {
        const double w = (k + 0.5) / n, x = px(p, a[0] + w * dx), y = py(p, a[1] + w * dy);
        fprintf(p->f, "<path d=\"M%.1f %.1f L%.1f %.1f\" stroke=\"%s\" stroke-width=\"1\"/>\n", x,
                y, x - 7.0 * dy / l, y - 7.0 * dx / l, style[kind].stroke);
    }
}

void picture_line(struct picture *p, enum picture_kind kind, int n, const double (*x)[2],
                  bool closed, bool fill, bool with_normals)
{
    fputs("<path d=\"", p->f);
    for (int k = 0; k < n; k++)
        fprintf(p->f, "%c%.2f %.2f ", k ? 'L' : 'M', px(p, x[k][0]), py(p, x[k][1]));
    fputs(closed ? "Z\"" : "\"", p->f);
    paint(p, kind, fill);
    for (int k = 0; with_normals && k + 1 < n + closed; k++)
        normals(p, kind, x[k], x[(k + 1) % n]);
}

void picture_cells(struct picture *p, int n, const double (*x)[2])
{
    fputs("<path d=\"", p->cells);
    for (int k = 0; k < n; k++)
        fprintf(p->cells, "%c%.2f %.2f ", k ? 'L' : 'M', px(p, x[k][0]), py(p, x[k][1]));
    fputs("Z\"/>\n", p->cells);
}

/* Counter-clockwise from the lower left one. */
static void corners(const struct picture *p, const double lo[3], const double hi[3], double x[4][2])
{
    const double a[2] = {lo[p->axis[0]], lo[p->axis[1]]}, b[2] = {hi[p->axis[0]], hi[p->axis[1]]};
    memcpy(x[0], a, sizeof a);
    memcpy(x[2], b, sizeof b);
    x[1][0] = b[0], x[1][1] = a[1];
    x[3][0] = a[0], x[3][1] = b[1];
}

void picture_box(struct picture *p, enum picture_kind kind, const double lo[3], const double hi[3],
                 const char *label)
{
    double x[4][2];
    corners(p, lo, hi, x);
    picture_line(p, kind, 4, (const double(*)[2])x, true, kind <= PICTURE_WAVES, false);
    if (label)
        picture_text(p, (const double[]){lo[0], lo[1], lo[2]}, label);
}

/* Water below a level, cut to the domain: a half plane in the picture. Heights are against the
 * gravity that water at rest has; what drives it along a period tilts no surface. */
static void below(struct picture *p, enum picture_kind kind, double level)
{
    double g[3];
    const double G = scene_still_gravity(p->s, g);
    const double n[2] = {G > 0.0 ? -g[p->axis[0]] / G : 0.0, G > 0.0 ? -g[p->axis[1]] / G : 1.0};
    double box[4][2], kept[8][2];
    int m = 0;
    corners(p, p->s->domain.min, p->s->domain.max, box);
    for (int k = 0; k < 4; k++) {
        const double *a = box[k], *b = box[(k + 1) % 4];
        const double ha = level - (n[0] * a[0] + n[1] * a[1]),
                     hb = level - (n[0] * b[0] + n[1] * b[1]);
        if (ha >= 0.0)
            memcpy(kept[m++], a, sizeof kept[0]);
        if ((ha > 0.0 && hb < 0.0) || (ha < 0.0 && hb > 0.0)) {
            kept[m][0] = a[0] + ha / (ha - hb) * (b[0] - a[0]);
            kept[m++][1] = a[1] + ha / (ha - hb) * (b[1] - a[1]);
        }
    }
    if (m > 2)
        picture_line(p, kind, m, (const double(*)[2])kept, true, true, false);
}

/* In the case's order: a hole is painted over what was there before it. */
static void shape(struct picture *p, const struct scene_shape *s)
{
    const enum picture_kind kind = s->hole ? PICTURE_HOLE : PICTURE_WATER;
    double circle[64][2];
    switch (s->form) {
    case SHAPE_BOX:
        picture_box(p, kind, s->box[0], s->box[1], NULL);
        break;
    case SHAPE_POLYGON:
        picture_line(p, kind, s->points.n, s->points.x, true, true, false);
        break;
    case SHAPE_DISC:
        for (int k = 0; k < 64; k++) {
            circle[k][0] = s->centre[p->axis[0]] + s->radius * cos(2.0 * M_PI * k / 64);
            circle[k][1] = s->centre[p->axis[1]] + s->radius * sin(2.0 * M_PI * k / 64);
        }
        picture_line(p, kind, 64, (const double(*)[2])circle, true, true, false);
        break;
    default:
        below(p, kind, s->level);
    }
}

static enum picture_kind kind_of(const struct scene_wall *w)
{
    return w->kind == WALL_SLIP      ? PICTURE_SLIP
           : w->kind == WALL_NO_SLIP ? PICTURE_NO_SLIP
                                     : PICTURE_OPENING;
}

/* A side of the domain, with the fluid on the left of its way. */
static void side(struct picture *p, int number)
{
    const struct scene_domain *d = &p->s->domain;
    const struct scene_wall *w = scene_wall_of(p->s, (enum scene_side)(SIDE_X_MIN + number));
    const int a = number / 2;
    double x[4][2];
    if (a != p->axis[0] && a != p->axis[1])
        return;
    corners(p, d->min, d->max, x);
    const int first = a == p->axis[0] ? (number % 2 ? 1 : 3) : (number % 2 ? 2 : 0);
    const double line[2][2] = {{x[first][0], x[first][1]},
                               {x[(first + 1) % 4][0], x[(first + 1) % 4][1]}};
    if (w)
        picture_line(p, kind_of(w), 2, line, false, false, true);
    else if (d->periodic[a])
        picture_line(p, PICTURE_PERIODIC, 2, line, false, false, false);
}

/* Zones before sides that make waves or absorb them, over the depth of the domain. */
static void wave_zones(struct picture *p)
{
    for (int k = 0; k < p->s->nwalls; k++) {
        const struct scene_wall *w = p->s->walls + k;
        double lo[3], hi[3];
        const int axis = scene_zone_box(p->s, w, lo, hi);
        if (axis >= 0 && axis == p->axis[0])
            picture_box(p, PICTURE_WAVES, lo, hi, w->zone == ZONE_WAVE ? "wave zone" : "beach");
    }
}

/* --- sections through meshes --- */

enum { RASTER = 360, EDGES = 6000, BEYOND = 6 /* px around the domain */ };

/* Where the views cut: the middle of the first body or obstacle, seen from above half way to that
 * of the water; without one of the water. */
static double place_of_cut(const struct scene *s, int axis)
{
    const double water = picture_water_middle(s, axis);
    for (int k = 0; k < s->meshes->n; k++) {
        const struct scene_mesh *m = s->meshes->of + k;
        const double at = 0.5 * (m->lo[axis] + m->hi[axis]);
        if (m->owner != MESH_OF_SHAPE && m->fluid_side == FLUID_OUTSIDE &&
            at > s->domain.min[axis] && at < s->domain.max[axis])
            return axis < 2 ? at : 0.5 * (at + water);
    }
    return water;
}

/* What a place is painted with: in a section water and what is solid; in the plane what open lines
 * leave out, over the water of the shapes. NULL: nothing. */
static const char *fill_at(const struct picture *p, const struct exact *e, const double *x)
{
    const struct scene *s = p->s;
    if (!s->meshes)
        return scene_is_behind_lines(s, x) ? "white" : NULL;
    const enum scene_matter is = scene_matter(s, e, x);
    return is == MATTER_NONE ? NULL : style[is == MATTER_FLUID ? PICTURE_WATER : PICTURE_BODY].fill;
}

/* Rows of a raster, as runs of what is at their places. */
static void paint_raster(struct picture *p, double cut)
{
    const struct exact e = exact_create(p->s);
    const double step = fmax(p->hi[0] - p->lo[0], p->hi[1] - p->lo[1]) / RASTER;
    const int n[2] = {(int)ceil((p->hi[0] - p->lo[0]) / step),
                      (int)ceil((p->hi[1] - p->lo[1]) / step)};
    for (int j = 0; j < n[1]; j++) {
        const char *before = NULL;
        int start = 0;
        for (int i = 0; i <= n[0]; i++) {
            double x[3] = {cut, cut, cut};
            x[p->axis[0]] = p->lo[0] + (i + 0.5) * step;
            x[p->axis[1]] = p->lo[1] + (j + 0.5) * step;
            const char *is = i < n[0] ? fill_at(p, &e, x) : NULL;
            if (is == before)
                continue;
            if (before)
                fprintf(p->f,
                        "<rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\" fill=\"%s\" "
                        "shape-rendering=\"crispEdges\"/>\n",
                        px(p, p->lo[0] + start * step), py(p, p->lo[1] + (j + 1) * step),
                        p->scale * (i - start) * step, p->scale * step + 0.3, before);
            p->used[PICTURE_WATER] |= before == style[PICTURE_WATER].fill;
            p->used[PICTURE_BODY] |= before == style[PICTURE_BODY].fill;
            before = is;
            start = i;
        }
    }
}

/* What of a mesh lies beyond the section: its rims and sharp edges, thin. */
static void edges(struct picture *p, const struct trimesh *m)
{
    int count = 0;
    fputs("<path d=\"", p->f);
    for (int t = 0; t < m->ntriangles && count < EDGES; t++)
        for (int k = 0; k < 3; k++) {
            const int q = m->neighbour[t][k];
            if (q > t || (q >= 0 && !picture_is_sharp(m, t, q)))
                continue;
            const double *a = m->x[m->vertex[t][k]], *b = m->x[m->vertex[t][(k + 1) % 3]];
            fprintf(p->f, "M%.1f %.1f L%.1f %.1f ", px(p, a[p->axis[0]]), py(p, a[p->axis[1]]),
                    px(p, b[p->axis[0]]), py(p, b[p->axis[1]]));
            count++;
        }
    fputs("\" stroke=\"#bbbbbb\" stroke-width=\"0.7\" fill=\"none\"/>\n", p->f);
}

/* Where the mesh is cut, with a tick to the fluid every 30 px. */
static void cut_lines(struct picture *p, const struct scene_mesh *is, enum picture_kind kind,
                      double cut)
{
    const int off = 3 - p->axis[0] - p->axis[1];
    double way = 15.0;
    for (int t = 0; t < is->mesh.ntriangles; t++) {
        double x[2][3], n[3];
        if (!trimesh_cut(&is->mesh, t, off, cut, x))
            continue;
        const double line[2][2] = {{x[0][p->axis[0]], x[0][p->axis[1]]},
                                   {x[1][p->axis[0]], x[1][p->axis[1]]}};
        picture_line(p, kind, 2, line, false, false, false);
        way += p->scale * hypot(line[1][0] - line[0][0], line[1][1] - line[0][1]);
        if (way < 30.0)
            continue;
        way = 0.0;
        trimesh_normal(&is->mesh, t, n);
        const double u = px(p, 0.5 * (line[0][0] + line[1][0])),
                     v = py(p, 0.5 * (line[0][1] + line[1][1]));
        fprintf(p->f, "<path d=\"M%.1f %.1f L%.1f %.1f\" stroke=\"%s\" stroke-width=\"1\"/>\n", u,
                v, u - 7.0 * n[p->axis[0]], v + 7.0 * n[p->axis[1]], style[kind].stroke);
    }
}

/* Water and solids by a raster, then edges beyond, then the cut itself, so that what is nearest is
 * on top. */
static void section(struct picture *p)
{
    const struct scene *s = p->s;
    const int off = 3 - p->axis[0] - p->axis[1];
    const double cut = place_of_cut(s, off);
    fprintf(p->f,
            "<clipPath id=\"view%d\"><rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" "
            "height=\"%.1f\"/></clipPath>\n<g clip-path=\"url(#view%d)\">\n",
            off, px(p, p->lo[0]) - BEYOND, py(p, p->hi[1]) - BEYOND,
            p->scale * (p->hi[0] - p->lo[0]) + 2 * BEYOND,
            p->scale * (p->hi[1] - p->lo[1]) + 2 * BEYOND, off);
    paint_raster(p, cut);
    for (int k = 0; k < s->meshes->n; k++)
        edges(p, &s->meshes->of[k].mesh);
    for (int k = 0; k < s->meshes->n; k++) {
        const struct scene_mesh *m = s->meshes->of + k;
        if (m->owner == MESH_OF_BODY)
            cut_lines(p, m, PICTURE_BODY, cut);
        else if (m->owner == MESH_OF_WALL)
            cut_lines(p, m, kind_of(s->walls + m->index), cut);
    }
    fputs("</g>\n", p->f);
    fprintf(p->f, "<text x=\"%.1f\" y=\"%.1f\" font-size=\"13\">section at %c = %.4g m</text>\n",
            px(p, p->lo[0]), p->top + MARGIN - 12.0, "xyz"[off], cut);
}

/* That of the first view is cut to the cells, which the program tells later. */
static void water(struct picture *p, bool first)
{
    const struct scene *s = p->s;
    if (first)
        fputs("<g clip-path=\"url(#cells)\">\n", p->f);
    if (s->meshes)
        section(p);
    else if (s->nshapes == 0)
        picture_box(p, PICTURE_WATER, s->domain.min, s->domain.max, NULL);
    for (int k = 0; k < s->nshapes && !s->meshes; k++)
        shape(p, s->shapes + k);
    if (scene_has_open_lines(s))
        paint_raster(p, 0.0);
    if (first)
        fputs("</g>\n", p->f);
}

static void scene(struct picture *p, bool first)
{
    const struct scene *s = p->s;
    water(p, first);
    wave_zones(p);
    for (int k = 0; k < 2 * s->domain.dim; k++)
        side(p, k);
    for (int k = 0; k < s->nwalls; k++)
        if (s->walls[k].points.n > 0)
            picture_line(p, kind_of(s->walls + k), s->walls[k].points.n, s->walls[k].points.x,
                         s->walls[k].closed, false, true);
    for (int k = 0; k < s->nbodies; k++) {
        const struct scene_body *b = s->bodies + k;
        const double *x = b->points.x[0];
        if (b->points.n == 0)
            continue;
        picture_line(p, PICTURE_BODY, b->points.n, b->points.x, true, !b->tank, true);
        picture_text(p, (const double[]){x[0], x[1], x[1]}, b->name);
    }
    for (int k = 0; k < s->nprobes; k++) {
        const double *at = s->probes[k].at;
        fprintf(p->f, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4\"", px(p, at[p->axis[0]]),
                py(p, at[p->axis[1]]));
        paint(p, PICTURE_PROBE, probe_is_point(s->probes + k));
        picture_text(p, at, s->probes[k].name);
    }
}

/* Views of a scene with meshes: from the front, from the left, from above; else the first alone. */
static const int views[3][2] = {{0, 2}, {1, 2}, {0, 1}};

static void set_view(struct picture *p, int a, int b)
{
    const struct scene_domain *d = &p->s->domain;
    p->axis[0] = a;
    p->axis[1] = b;
    for (int k = 0; k < 2; k++) {
        p->lo[k] = d->min[p->axis[k]];
        p->hi[k] = d->max[p->axis[k]];
    }
}

/* The scene in one view, the places of its corners. */
static void draw_view(struct picture *p, bool first)
{
    const double height = p->scale * (p->hi[1] - p->lo[1]);
    scene(p, first);
    for (int k = 0; k < 2; k++)
        fprintf(
            p->f,
            "<text x=\"%.1f\" y=\"%.1f\" font-size=\"12\" text-anchor=\"%s\">(%g, %g) m</text>\n",
            px(p, k ? p->hi[0] : p->lo[0]), p->top + (k ? MARGIN - 12.0 : MARGIN + height + 18.0),
            k ? "end" : "start", k ? p->hi[0] : p->lo[0], k ? p->hi[1] : p->lo[1]);
}

/* The first view is drawn last, since the program adds to it; its clip path is written at the end,
 * when cells are known. */
struct picture *picture_create(const char *path, const struct scene *s)
{
    struct picture *p = NEW(struct picture, 1);
    const struct scene_domain *d = &s->domain;
    const int n = s->meshes ? 3 : 1;
    double size = 0.0, top[3] = {0.0};
    snprintf(p->path, sizeof p->path, "%s", path);
    p->f = fopen(path, "w");
    if (!p->f)
        disk_failed(path);
    p->s = s;
    for (int a = 0; a < d->dim; a++)
        size = fmax(size, d->max[a] - d->min[a]);
    set_view(p, 0, d->dim - 1);
    p->scale = WIDTH / (n == 1 ? fmax(p->hi[0] - p->lo[0], p->hi[1] - p->lo[1]) : size);
    for (int k = 0; k < n; k++) {
        const int up = n == 1 ? d->dim - 1 : views[k][1];
        top[k] = p->height;
        p->height += p->scale * (d->max[up] - d->min[up]) + (k < n - 1 ? 1.5 * MARGIN : 0.0);
    }
    fprintf(
        p->f,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%.0f\" "
        "font-family=\"sans-serif\">\n<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
        WIDTH + 2 * MARGIN, p->height + 2 * MARGIN + LEGEND * (PICTURE_KINDS / 3 + 1));
    for (int k = n - 1; k >= 0; k--) { /* what the program adds goes to the first */
        if (n > 1)
            set_view(p, views[k][0], views[k][1]);
        p->top = top[k];
        draw_view(p, k == 0);
    }
    p->cells = open_memstream(&p->cells_text, &p->cells_size);
    if (!p->cells)
        disk_failed(path);
    return p;
}

/* Without cells of its own the whole domain is what is seen. */
static void close_cells(struct picture *p)
{
    double x[4][2];
    corners(p, p->s->domain.min, p->s->domain.max, x);
    if (ftell(p->cells) == 0)
        picture_cells(p, 4, (const double(*)[2])x);
    fclose(p->cells);
    fprintf(p->f, "<clipPath id=\"cells\">\n%s</clipPath>\n", p->cells_text);
    free(p->cells_text);
}

void picture_close(struct picture **picture)
{
    struct picture *p = *picture;
    int n = 0;
    for (int k = 0; k < PICTURE_KINDS; k++) {
        if (!p->used[k] || k == PICTURE_HOLE)
            continue;
        const double x = MARGIN + n % 3 * WIDTH / 3.0,
                     y = p->height + 1.7 * MARGIN + n / 3 * LEGEND;
        fprintf(p->f, "<rect x=\"%.0f\" y=\"%.0f\" width=\"24\" height=\"10\"", x, y - 10.0);
        paint(p, (enum picture_kind)k,
              k <= PICTURE_WAVES || k == PICTURE_BODY || k == PICTURE_PROBE);
        fprintf(p->f, "<text x=\"%.0f\" y=\"%.0f\" font-size=\"13\">%s</text>\n", x + 32.0, y,
                style[k].name);
        n++;
    }
    close_cells(p);
    fputs("</svg>\n", p->f);
    if (ferror(p->f) || fclose(p->f) != 0)
        disk_failed(p->path);
    mem_free(p);
    *picture = NULL;
}
