/* outline.c - see outline.h. A file is read into memory as a whole; a drawing is told by its
 * "<svg". Of SVG only what is needed for one outline is read: the page's height, one shape, all
 * commands of a path. What would change its meaning (transforms, a path of several pieces) is
 * refused. Curves become PARTS chords first, then corners that matter little are left out again
 * (thin_out), so that the number of corners follows from the shape and not from PARTS.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "outline.h"

#include <ctype.h>

#include "../base/base.h"

enum { PARTS = 64 }; /* chords of a curve, before corners are left out */

/* A corner, unless the last one is there. */
static void add(struct outline *is, double x, double y)
{
    if (is->n > 0 && is->x[is->n - 1][0] == x && is->x[is->n - 1][1] == y)
        return;
    if ((is->n & (is->n - 1)) == 0) /* room doubles */
        GROW(is->x, is->n, is->n ? 2 * is->n : 1);
    is->x[is->n][0] = x;
    is->x[is->n++][1] = y;
}

/* The whole file, ended by 0; NULL: it cannot be read. */
static char *text_of(const char *path)
{
    FILE *f = fopen(path, "rb");
    if (!f)
        return NULL;
    char *text = NULL;
    size_t n = 0, got;
    do {
        GROW(text, n, n + 65537);
        got = fread(text + n, 1, 65536, f);
        n += got;
    } while (got > 0);
    text[n] = '\0';
    fclose(f);
    return text;
}

/* --- rows of numbers --- */

/* Blank lines, comments and one line of names before the first row are passed over; separators are
 * blanks, commas and semicolons. */
static bool read_rows(char *text, struct outline *is, char *why, size_t size)
{
    int line = 0;
    for (char *rest = text, *row; (row = strsep(&rest, "\n")) != NULL;) {
        const char *at = row + strspn(row, " \t\r");
        line++;
        if (*at == '#' || *at == '\0')
            continue;
        char *end, *last;
        const double x = strtod(at, &end), y = strtod(end + strspn(end, " \t,;"), &last);
        const bool names = end == at && is->n == 0;
        if (end != at && last != end + strspn(end, " \t,;")) {
            add(is, x, y);
        } else if (!names) {
            snprintf(why, size, "line %d is no row of x, y", line);
            return false;
        }
    }
    return true;
}

/* --- drawings --- */

/* The value of an attribute in a tag, into room; "": there is none. The name must stand behind a
 * blank, so that "d" is not found in "id"; quotes of both kinds. */
static void attribute(const char *tag, const char *name, char *room, size_t size)
{
    const char *end = strchr(tag, '>');
    const size_t n = strlen(name);
    *room = '\0';
    for (const char *c = tag; end && c < end; c++) {
        if (!isspace((unsigned char)*c) || strncmp(c + 1, name, n) != 0)
            continue;
        const char *v = c + 1 + n + strspn(c + 1 + n, " \t\r\n=");
        if (c[1 + n + strspn(c + 1 + n, " \t\r\n")] != '=' || (*v != '"' && *v != '\''))
            continue;
        const char *last = strchr(v + 1, *v);
        if (last)
            snprintf(room, size, "%.*s", (int)(last - v - 1), v + 1);
        return;
    }
}

/* Height of the page in the units of its paths. */
static double page_height(const char *text)
{
    char value[128];
    double box[4];
    const char *svg = strstr(text, "<svg");
    if (!svg)
        return NAN;
    attribute(svg, "viewBox", value, sizeof value);
    if (sscanf(value, "%lf%*[ ,]%lf%*[ ,]%lf%*[ ,]%lf", box, box + 1, box + 2, box + 3) == 4)
        return box[1] + box[3];
    attribute(svg, "height", value, sizeof value);
    return *value ? strtod(value, NULL) : NAN;
}

/* NAN: there is none, and c stays. */
static double number(const char **c)
{
    char *end;
    *c += strspn(*c, " \t\r\n,");
    const double v = strtod(*c, &end);
    const bool any = end != *c;
    *c = end;
    return any ? v : NAN;
}

/* A flag of an arc: 0 or 1, behind which no separator need stand. */
static double flag(const char **c)
{
    *c += strspn(*c, " \t\r\n,");
    return **c == '0' || **c == '1' ? *(*c)++ - '0' : NAN;
}

/* A Bezier curve from p[0] to p[3] with control points p[1], p[2]: PARTS corners at equal steps of
 * its parameter, the first left out, where the pen stands. */
static void cubic(struct outline *is, const double p[4][2])
{
    for (int k = 1; k <= PARTS; k++) {
        const double t = (double)k / PARTS, s = 1.0 - t;
        const double w[4] = {s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t};
        double x[2] = {0.0, 0.0};
        for (int i = 0; i < 4; i++)
            for (int a = 0; a < 2; a++)
                x[a] += w[i] * p[i][a];
        add(is, x[0], x[1]);
    }
}

/* Elliptic arc from p to q (SVG 1.1, appendix F.6). From two points to centre and angles: in the
 * ellipse's own axes (u, v) about the middle of p and q; radii that are too small to reach grow
 * until they do. large and sweep choose one of four arcs. */
static void arc(struct outline *is, const double p[2], double rx, double ry, double turn,
                bool large, bool sweep, const double q[2])
{
    const double c = cos(turn * M_PI / 180.0), s = sin(turn * M_PI / 180.0),
                 dx = 0.5 * (p[0] - q[0]), dy = 0.5 * (p[1] - q[1]), u = c * dx + s * dy,
                 v = c * dy - s * dx;
    rx = fabs(rx);
    ry = fabs(ry);
    if (!(rx > 0.0 && ry > 0.0) || (dx == 0.0 && dy == 0.0)) {
        add(is, q[0], q[1]);
        return;
    }
    const double grow = sqrt(fmax(1.0, u * u / (rx * rx) + v * v / (ry * ry)));
    rx *= grow;
    ry *= grow;
    const double d = rx * rx * v * v + ry * ry * u * u,
                 root =
                     sqrt(fmax(0.0, rx * rx * ry * ry / d - 1.0)) * (large == sweep ? -1.0 : 1.0),
                 cu = root * rx * v / ry, cv = -root * ry * u / rx,
                 from = atan2((v - cv) / ry, (u - cu) / rx);
    double angle = atan2((-v - cv) / ry, (-u - cu) / rx) - from;
    angle += sweep && angle < 0.0 ? 2.0 * M_PI : !sweep && angle > 0.0 ? -2.0 * M_PI : 0.0;
    for (int k = 1; k <= PARTS; k++) {
        const double a = from + angle * k / PARTS, x = cu + rx * cos(a), y = cv + ry * sin(a);
        add(is, c * x - s * y + 0.5 * (p[0] + q[0]), s * x + c * y + 0.5 * (p[1] + q[1]));
    }
}

/* State of a path's pen. */
struct pen {
    double at[2], start[2];
    double control[2]; /* the last one of a curve */
    char last;
};

/* Numbers of a command's group. */
static int group_of(char command)
{
    static const char *const names = "MLHVCSQTA";
    static const int n[] = {2, 2, 1, 1, 6, 4, 4, 2, 7};
    const char *c = strchr(names, toupper((unsigned char)command));
    return c && *c ? n[c - names] : 0;
}

/* Control point that goes on from the last curve's; without one, the pen's place. */
static void reflect(const struct pen *p, const char *of, double c[2])
{
    const bool curve = p->last && strchr(of, p->last);
    for (int a = 0; a < 2; a++)
        c[a] = curve ? 2.0 * p->at[a] - p->control[a] : p->at[a];
}

/* One command with its numbers v. Lower case: relative to the pen, so its place is added to each of
 * them first (an arc's radii, angle and flags, v[0] to v[4], left out). A quadratic curve (Q, T) is
 * a cubic one with control points at two thirds of the way. */
static void draw(struct outline *is, struct pen *p, char command, double v[7])
{
    const char is_what = (char)toupper((unsigned char)command);
    const int n = group_of(command);
    if (islower((unsigned char)command))
        for (int k = is_what == 'A' ? 5 : 0; k < n; k++)
            v[k] += is_what == 'V' || (k % 2 != (is_what == 'A')) ? p->at[1] : p->at[0];
    double to[2] = {is_what == 'V' ? p->at[0] : v[n > 1 ? n - 2 : 0],
                    is_what == 'H' ? p->at[1] : v[n - 1]};
    double c[2][2];
    memcpy(c[0], p->at, sizeof c[0]);
    memcpy(c[1], to, sizeof c[1]);
    if (is_what == 'C' || is_what == 'S') {
        if (is_what == 'C')
            memcpy(c[0], v, sizeof c[0]);
        else
            reflect(p, "CS", c[0]);
        memcpy(c[1], v + n - 4, sizeof c[1]);
        memcpy(p->control, c[1], sizeof c[1]);
    } else if (is_what == 'Q' || is_what == 'T') {
        double q[2];
        reflect(p, "QT", q);
        memcpy(q, is_what == 'Q' ? v : q, sizeof q);
        for (int a = 0; a < 2; a++) {
            c[0][a] = p->at[a] + 2.0 / 3.0 * (q[a] - p->at[a]);
            c[1][a] = to[a] + 2.0 / 3.0 * (q[a] - to[a]);
        }
        memcpy(p->control, q, sizeof q);
    }
    if (is_what == 'A')
        arc(is, p->at, v[0], v[1], v[2], v[3] != 0.0, v[4] != 0.0, to);
    else if (strchr("CSQT", is_what))
        cubic(is,
              (const double[4][2]){
                  {p->at[0], p->at[1]}, {c[0][0], c[0][1]}, {c[1][0], c[1][1]}, {to[0], to[1]}});
    else
        add(is, to[0], to[1]);
    memcpy(p->at, to, sizeof to);
    p->last = is_what;
}

/* Numbers may repeat without their command; behind M they are then lines. */
static bool read_path(const char *d, struct outline *is, char *why, size_t size)
{
    struct pen p = {.last = '\0'};
    char command = '\0';
    while (*(d += strspn(d, " \t\r\n,"))) {
        double v[7] = {0.0};
        if (isalpha((unsigned char)*d))
            command = *d++;
        if (toupper((unsigned char)command) == 'Z') {
            is->closed = true;
            d += strspn(d, " \t\r\n,Zz");
            if (*d)
                snprintf(why, size, "its path goes on behind Z (%c): one outline is wanted", *d);
            return !*d;
        }
        const bool moves = toupper((unsigned char)command) == 'M';
        const int n = group_of(command);
        if (n == 0 || (moves && is->n > 1)) {
            snprintf(why, size,
                     n == 0 ? "the command %c of its path is not known"
                            : "its path jumps (%c): one outline is wanted",
                     command ? command : *d);
            return false;
        }
        for (int k = 0; k < n; k++)
            v[k] = n == 7 && (k == 3 || k == 4) ? flag(&d) : number(&d);
        if (!isfinite(v[n - 1]) || (n == 7 && !isfinite(v[3] + v[4]))) {
            snprintf(why, size, "a number is missing behind %c of its path", command);
            return false;
        }
        draw(is, &p, command, v);
        command = command == 'M' ? 'L' : command == 'm' ? 'l' : command;
    }
    return true;
}

/* As long as there are pairs. */
static void read_corners(const char *points, struct outline *is)
{
    for (;;) {
        const double x = number(&points), y = number(&points);
        if (!isfinite(y))
            return;
        add(is, x, y);
    }
}

/* The tag of a shape with that id, or the first; NULL: there is none. */
static const char *find_shape(const char *text, const char *id)
{
    static const char *const shapes[] = {"<path", "<polygon", "<polyline"};
    for (const char *c = text; (c = strchr(c, '<')) != NULL; c++)
        for (int k = 0; k < 3; k++) {
            char own[128];
            const size_t n = strlen(shapes[k]);
            if (strncmp(c, shapes[k], n) != 0 || !isspace((unsigned char)c[n]))
                continue;
            attribute(c, "id", own, sizeof own);
            if (!*id || strcmp(own, id) == 0)
                return c;
        }
    return NULL;
}

/* SVG's y points down from the top of the page: the page's height turns it. */
static bool read_drawing(const char *text, const char *id, struct outline *is, char *why,
                         size_t size)
{
    const double height = page_height(text);
    const char *tag = find_shape(text, id);
    if (!isfinite(height) || !tag) {
        snprintf(why, size,
                 !tag ? "it has no path, polygon or polyline%s%s"
                      : "its page has no height (viewBox)",
                 !tag && *id ? " of the id " : "", !tag ? id : "");
        return false;
    }
    if (strstr(text, "transform=")) {
        snprintf(why, size,
                 "it has a transform, which is not read: apply it in the drawing program");
        return false;
    }
    const size_t room = strlen(tag) + 1;
    char *value = NEW(char, room);
    bool good = true;
    attribute(tag, tag[2] == 'a' ? "d" : "points", value, room);
    if (tag[2] == 'a')
        good = read_path(value, is, why, size);
    else
        read_corners(value, is);
    is->closed = is->closed || strncmp(tag, "<polygon", 8) == 0;
    for (int k = 0; k < is->n; k++)
        is->x[k][1] = height - is->x[k][1];
    mem_free(value);
    return good;
}

/* --- fewer corners --- */

/* Distance from the line through a and b; of a closed outline the two ends are one. */
static double off_chord(const double *p, const double *a, const double *b)
{
    const double t[2] = {b[0] - a[0], b[1] - a[1]}, d[2] = {p[0] - a[0], p[1] - a[1]};
    const double length = hypot(t[0], t[1]);
    return length > 0.0 ? fabs(t[0] * d[1] - t[1] * d[0]) / length : hypot(d[0], d[1]);
}

/* Marks what stays between two corners that do (Douglas & Peucker 1973). Recursion; O(n log n) on
 * average, n^2 at worst. */
static void keep(const struct outline *is, int lo, int hi, double within, bool *stays)
{
    double most = within;
    int far = -1;
    for (int k = lo + 1; k < hi; k++) {
        const double d = off_chord(is->x[k], is->x[lo], is->x[hi]);
        far = d > most ? k : far;
        most = fmax(most, d);
    }
    if (far < 0)
        return;
    stays[far] = true;
    keep(is, lo, far, within, stays);
    keep(is, far, hi, within, stays);
}

/* stays[n]: filled; how many stay. */
static int kept(const struct outline *is, double within, bool *stays)
{
    int n = 0;
    memset(stays, 0, (size_t)is->n * sizeof *stays);
    stays[0] = stays[is->n - 1] = true;
    keep(is, 0, is->n - 1, within, stays);
    for (int k = 0; k < is->n; k++)
        n += stays[k];
    return n;
}

void outline_bounds(int n, const double (*x)[2], double *lo, double *hi)
{
    for (int a = 0; a < 2; a++) {
        lo[a] = INFINITY;
        hi[a] = -INFINITY;
        for (int k = 0; k < n; k++) {
            lo[a] = fmin(lo[a], x[k][a]);
            hi[a] = fmax(hi[a], x[k][a]);
        }
    }
}

/* share: of the diagonal, what corners may be off. Where too many corners are left the tolerance
 * grows by fifths until there are few enough. A closed outline comes with its first corner twice,
 * as the two ends. */
static void thin_out(struct outline *is, int most, double share)
{
    bool *stays = NEW(bool, is->n);
    double lo[2], hi[2];
    outline_bounds(is->n, (const double(*)[2])is->x, lo, hi);
    double within = share * hypot(hi[0] - lo[0], hi[1] - lo[1]);
    while (kept(is, within, stays) > most)
        within *= 1.2;
    int n = 0;
    for (int k = 0; k < is->n; k++)
        if (stays[k]) {
            is->x[n][0] = is->x[k][0];
            is->x[n++][1] = is->x[k][1];
        }
    is->n = n;
    mem_free(stays);
}

/* Chords of a drawing may be 5e-4 of its diagonal off, rows only by rounding: measured corners are
 * kept but for those on straight lines, which bodies that bend want, too. */
bool outline_read(const char *file, int most, bool whole, struct outline *is, char *why,
                  size_t size)
{
    char path[1200];
    snprintf(path, sizeof path, "%s", file);
    char *id = strchr(path, '#');
    if (id)
        *id++ = '\0';
    *is = (struct outline){.n = 0};
    char *text = text_of(path);
    if (!text) {
        snprintf(why, size, "%s cannot be read", path);
        return false;
    }
    char what[128] = "";
    const bool drawing = strstr(text, "<svg") != NULL;
    bool good = drawing ? read_drawing(text, id ? id : "", is, what, sizeof what)
                        : read_rows(text, is, what, sizeof what);
    mem_free(text);
    if (good && is->n > 2) {
        const bool twice = is->x[0][0] == is->x[is->n - 1][0] && is->x[0][1] == is->x[is->n - 1][1];
        if (!whole)
            thin_out(is, most, drawing ? 5e-4 : 1e-9);
        is->closed = is->closed || twice;
        is->n -= twice;
        good = is->n <= most;
        if (!good)
            snprintf(what, sizeof what, "%d corners, of which at most %d are possible", is->n,
                     most);
    }
    if (good && is->n >= 2)
        return true;
    snprintf(why, size, "%s: %s", path, *what ? what : "it has no two corners");
    mem_free(is->x);
    is->x = NULL;
    return false;
}
