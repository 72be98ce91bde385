/* wall_cover.c - see wall_cover.h. Walls cut each other, and with the open sides of the domain they
 * part the plane into rooms; a closed room in which a wall shows its back holds no fluid, so that
 * walls that look into it are left out. SPDX-License-Identifier: BSD-3-Clause */
#include "wall_cover.h"

#include "../../common/base/base.h"

/* A line that parts the plane: a segment of a wall, or an open side of the domain. */
struct cover_line {
    double a[2], t[2], length;
    bool wall; /* else an open side */
};

/* What of a line lies between two cuts. Its half 2 k runs from a to b with its front, the fluid's
 * side of a wall, on the left; half 2 k + 1 runs back. */
struct piece {
    int line, node[2];
    double from, to; /* m along the line */
};

struct cover_plane {
    double near; /* m: what is nearer than this meets */
    const double *lo, *hi;
    int nlines, npieces, ncuts, nnodes;
    struct cover_line *line;
    struct piece *piece;
    struct cut {
        int line;
        double at;
    } * cut;
    double (*node)[2];
    int *face;  /* [2 npieces] of each half: the first half of the walk around its room */
    bool *shut; /* [2 npieces] by the face's number: a closed room that shows a wall's back */
};

/* The place `at' m along a line, in x, which is returned. */
static double *end_of(const struct cover_line *l, double at, double x[2])
{
    for (int a = 0; a < 2; a++)
        x[a] = l->a[a] + at * l->t[a];
    return x;
}

static void add_line(struct cover_plane *p, const double *a, const double *b, bool wall)
{
    struct cover_line l = {.a = {a[0], a[1]}, .wall = wall};
    l.length = hypot(b[0] - a[0], b[1] - a[1]);
    for (int k = 0; k < 2; k++)
        l.t[k] = (b[k] - a[k]) / l.length;
    if (p->nlines % 64 == 0)
        GROW(p->line, p->nlines, p->nlines + 64);
    p->line[p->nlines++] = l;
}

static void add_cut(struct cover_plane *p, int line, double at)
{
    if (p->ncuts % 64 == 0)
        GROW(p->cut, p->ncuts, p->ncuts + 64);
    p->cut[p->ncuts++] = (struct cut){line, fmax(0.0, fmin(at, p->line[line].length))};
}

/* Cuts of line i by line j: where they cross, and where an end of j lies on i. */
static void cut_by(struct cover_plane *p, int i, int j)
{
    const struct cover_line *l = p->line + i, *m = p->line + j;
    const double d[2] = {m->a[0] - l->a[0], m->a[1] - l->a[1]};
    const double turn = l->t[0] * m->t[1] - l->t[1] * m->t[0];
    if (fabs(turn) > 1e-9) {
        const double at = (d[0] * m->t[1] - d[1] * m->t[0]) / turn;
        const double on = (d[0] * l->t[1] - d[1] * l->t[0]) / turn;
        if (at >= -p->near && at <= l->length + p->near && on >= -p->near &&
            on <= m->length + p->near)
            add_cut(p, i, at);
    }
    for (int end = 0; end < 2; end++) {
        double x[2];
        end_of(m, end ? m->length : 0.0, x);
        const double e[2] = {x[0] - l->a[0], x[1] - l->a[1]};
        const double at = e[0] * l->t[0] + e[1] * l->t[1];
        if (fabs(e[0] * l->t[1] - e[1] * l->t[0]) < p->near && at > -p->near &&
            at < l->length + p->near)
            add_cut(p, i, at);
    }
}

/* Boxes of two lines are tested first: lines are compared all with all. */
static bool are_apart(const struct cover_plane *p, const struct cover_line *l,
                      const struct cover_line *m)
{
    double x[2], y[2];
    end_of(l, l->length, x);
    end_of(m, m->length, y);
    for (int a = 0; a < 2; a++)
        if (fmax(l->a[a], x[a]) + p->near < fmin(m->a[a], y[a]) ||
            fmin(l->a[a], x[a]) - p->near > fmax(m->a[a], y[a]))
            return true;
    return false;
}

/* Whether something meets a wall between its ends. */
static bool cut_lines(struct cover_plane *p)
{
    bool any = false;
    for (int i = 0; i < p->nlines; i++)
        for (int j = 0; j < p->nlines; j++) {
            const int before = p->ncuts;
            if (i == j || are_apart(p, p->line + i, p->line + j))
                continue;
            cut_by(p, i, j);
            for (int k = before; k < p->ncuts; k++)
                any = any || (p->line[i].wall && p->cut[k].at > p->near &&
                              p->cut[k].at < p->line[i].length - p->near);
        }
    return any;
}

/* By line, then along it: consecutive cuts of one line bound a piece. */
static int by_place(const void *a, const void *b)
{
    const struct cut *c = a, *d = b;
    if (c->line != d->line)
        return c->line - d->line;
    return (c->at > d->at) - (c->at < d->at);
}

/* Numbers the places where pieces meet; what is nearer than 2 near is one node. */
static int node_at(struct cover_plane *p, const double *x)
{
    for (int k = 0; k < p->nnodes; k++)
        if (hypot(p->node[k][0] - x[0], p->node[k][1] - x[1]) < 2.0 * p->near)
            return k;
    if (p->nnodes % 64 == 0)
        GROW(p->node, p->nnodes, p->nnodes + 64);
    memcpy(p->node[p->nnodes], x, sizeof *p->node);
    return p->nnodes++;
}

/* Whether a wall runs between two nodes: no open side there. */
static bool is_laid(const struct cover_plane *p, const int node[2])
{
    for (int k = 0; k < p->npieces; k++)
        for (int end = 0; end < 2; end++)
            if (p->piece[k].node[end] == node[0] && p->piece[k].node[1 - end] == node[1])
                return true;
    return false;
}

/* Pieces whose two ends are one node are dropped, and the next piece begins where they did. */
static void lay_pieces(struct cover_plane *p)
{
    for (int i = 0; i < p->nlines; i++) {
        add_cut(p, i, 0.0);
        add_cut(p, i, p->line[i].length);
    }
    qsort(p->cut, (size_t)p->ncuts, sizeof *p->cut, by_place);
    p->piece = NEW(struct piece, p->ncuts);
    for (int k = 1; k < p->ncuts; k++) {
        const struct cover_line *l = p->line + p->cut[k].line;
        double x[2];
        if (p->cut[k].line != p->cut[k - 1].line)
            continue;
        struct piece new = {.line = p->cut[k].line, .from = p->cut[k - 1].at, .to = p->cut[k].at};
        new.node[0] = node_at(p, end_of(l, new.from, x));
        new.node[1] = node_at(p, end_of(l, new.to, x));
        if (new.node[0] == new.node[1])
            p->cut[k].at = p->cut[k - 1].at;
        else if (l->wall || !is_laid(p, new.node))
            p->piece[p->npieces++] = new;
    }
}

/* Whether another piece in the same place looks the other way, or comes before it. */
static bool is_double(const struct cover_plane *p, int piece)
{
    const struct piece *c = p->piece + piece;
    for (int k = 0; k < p->npieces; k++) {
        const struct piece *d = p->piece + k;
        if (p->line[d->line].wall &&
            ((c->node[0] == d->node[1] && c->node[1] == d->node[0]) ||
             (c->node[0] == d->node[0] && c->node[1] == d->node[1] && k < piece)))
            return true;
    }
    return false;
}

/* Of two walls back to back nothing acts, of two in one place one is enough. */
static void drop_doubles(struct cover_plane *p)
{
    struct piece *kept = NEW(struct piece, p->npieces);
    int n = 0;
    for (int k = 0; k < p->npieces; k++)
        if (!is_double(p, k))
            kept[n++] = p->piece[k];
    mem_free(p->piece);
    p->piece = kept;
    p->npieces = n;
}

/* Angle of a half where it leaves its node. */
static double heading(const struct cover_plane *p, int half)
{
    const struct cover_line *l = p->line + p->piece[half / 2].line;
    return half % 2 ? atan2(-l->t[1], -l->t[0]) : atan2(l->t[1], l->t[0]);
}

/* The half that goes on around the room on the left of `half': of those that leave its end, the
 * first to the right of the way back. */
static int next_half(const struct cover_plane *p, int half)
{
    const int node = p->piece[half / 2].node[half % 2 ? 0 : 1], back = half ^ 1;
    double least = INFINITY;
    int next = back;
    for (int k = 0; k < 2 * p->npieces; k++) {
        if (p->piece[k / 2].node[k % 2] != node || k == back)
            continue;
        double turn = heading(p, back) - heading(p, k);
        turn -= 2.0 * M_PI * floor(turn / (2.0 * M_PI));
        turn = turn < 1e-9 ? 2.0 * M_PI : turn;
        if (turn < least) {
            least = turn;
            next = k;
        }
    }
    return next;
}

static bool is_wall(const struct cover_plane *p, int half)
{
    return p->line[p->piece[half / 2].line].wall;
}

/* Walks around the room on the left of a half that has none yet. */
static void walk(struct cover_plane *p, int first)
{
    double area = 0.0;
    int half = first;
    do {
        const struct piece *c = p->piece + half / 2;
        const double *a = p->node[c->node[half % 2]], *b = p->node[c->node[1 - half % 2]];
        area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
        p->face[half] = first;
        half = next_half(p, half);
    } while (half != first && p->face[half] < 0);
    for (half = 1; half < 2 * p->npieces && area > p->near * p->near; half += 2)
        if (p->face[half] == first && p->face[half ^ 1] != first && is_wall(p, half))
            p->shut[first] = true;
}

/* Whether a piece that ends nowhere begins on the back of a wall that goes on to both sides: beyond
 * the tank. */
static bool is_beyond(const struct cover_plane *p, int piece)
{
    const struct piece *c = p->piece + piece;
    int others[2] = {0, 0};
    for (int k = 0; k < 2 * p->npieces; k++)
        for (int end = 0; end < 2; end++)
            others[end] += k / 2 != piece && p->piece[k / 2].node[k % 2] == c->node[end];
    if ((others[0] > 0) == (others[1] > 0))
        return false;
    const int end = others[0] > 0 ? 0 : 1;
    const double away = heading(p, 2 * piece + end);
    int backs = 0;
    for (int k = 0; k < 2 * p->npieces; k++) {
        double turn = heading(p, k) - away;
        turn -= 2.0 * M_PI * floor(turn / (2.0 * M_PI));
        const bool there = p->piece[k / 2].node[k % 2] == c->node[end] && is_wall(p, k) &&
                           p->piece[k / 2].line != c->line;
        /* a half that leaves has its back on the right, one that arrives on its left as it leaves
         */
        backs += there && turn > 1e-9 && (k % 2 == 0) == (turn < M_PI);
    }
    return backs > 1;
}

/* Rooms are the faces of the planar graph: each half belongs to one walk, and an inner room is
 * walked counter-clockwise, with a positive area. */
static void find_rooms(struct cover_plane *p)
{
    p->face = NEW(int, 2 * p->npieces);
    p->shut = NEW(bool, 2 * p->npieces);
    for (int k = 0; k < 2 * p->npieces; k++)
        p->face[k] = -1;
    for (int k = 0; k < 2 * p->npieces; k++)
        if (p->face[k] < 0)
            walk(p, k);
}

/* By its middle, against the domain's box. */
static bool is_outside(const struct cover_plane *p, int piece)
{
    const struct piece *c = p->piece + piece;
    double x[2];
    end_of(p->line + c->line, 0.5 * (c->from + c->to), x);
    return x[0] < p->lo[0] || x[1] < p->lo[1] || x[0] > p->hi[0] || x[1] > p->hi[1];
}

/* Whether a piece goes on outside of the domain from one within, across an open side, that lies
 * before a closed room: that room goes on, too. */
static bool goes_on(const struct cover_plane *p, int piece)
{
    for (int k = piece - 1; k <= piece + 1 && is_outside(p, piece); k += 2)
        if (k >= 0 && k < p->npieces && p->piece[k].line == p->piece[piece].line &&
            !is_outside(p, k) && p->shut[p->face[2 * k]])
            return true;
    return false;
}

/* By the room that the piece's front, its even half, looks into. */
static bool is_covered(const struct cover_plane *p, int piece)
{
    return p->shut[p->face[2 * piece]] || is_beyond(p, piece) || goes_on(p, piece);
}

static void add_part(struct wall_parts *to, int line, double from, double until)
{
    if (to->n % 64 == 0)
        GROW(to->part, to->n, to->n + 64);
    to->part[to->n++] = (struct wall_part){line, from, until};
}

/* What is left of line i, whose pieces begin with k; pieces that go on make one part. Returns the
 * first piece of the next line. */
static int keep_seen(const struct cover_plane *p, int i, int k, struct wall_parts *parts)
{
    double from = -1.0, to = -1.0;
    for (; k < p->npieces && p->piece[k].line == i; k++) {
        const struct piece *c = p->piece + k;
        if (is_covered(p, k))
            continue;
        if (from >= 0.0 && to < c->from - 4.0 * p->near) {
            add_part(parts, i, from, to);
            from = -1.0;
        }
        from = from < 0.0 ? c->from : from;
        to = c->to;
    }
    if (from >= 0.0)
        add_part(parts, i, from, to);
    return k;
}

/* Open sides of the domain close rooms, too. */
static void add_open_sides(struct cover_plane *p, const double *lo, const double *hi)
{
    const double corner[4][2] = {{lo[0], lo[1]}, {hi[0], lo[1]}, {hi[0], hi[1]}, {lo[0], hi[1]}};
    for (int k = 0; k < 4; k++)
        add_line(p, corner[k], corner[(k + 1) % 4], false);
}

/* Whether all walls are left, from end to end. */
static bool are_whole(const struct cover_plane *p, int n, const struct wall_parts *parts)
{
    bool whole = parts->n == n;
    for (int i = 0; i < n && whole; i++)
        whole = parts->part[i].wall == i && parts->part[i].from <= 4.0 * p->near &&
                parts->part[i].to >= p->line[i].length - 4.0 * p->near;
    return whole;
}

/* The walls come first and in their order, so that line k is wall k; the four open sides follow. */
static struct cover_plane make_plane(int n, const double (*ends)[2][2], const double *lo,
                                     const double *hi, double near)
{
    struct cover_plane p = {.near = near, .lo = lo, .hi = hi};
    for (int k = 0; k < n; k++)
        add_line(&p, ends[k][0], ends[k][1], true);
    add_open_sides(&p, lo, hi);
    return p;
}

/* In this order: doubles can be told by pieces alone, and rooms need a graph without them. */
static void part_plane(struct cover_plane *p)
{
    lay_pieces(p);
    drop_doubles(p);
    find_rooms(p);
}

static void free_plane(struct cover_plane *p)
{
    FREE(p->line, p->piece, p->cut, p->node, p->face, p->shut);
}

struct wall_parts wall_cover(int n, const double (*ends)[2][2], const double *lo, const double *hi,
                             double near)
{
    struct wall_parts parts = {0};
    struct cover_plane p = make_plane(n, ends, lo, hi, near);
    parts.cut = cut_lines(&p);
    if (parts.cut) {
        part_plane(&p);
        for (int i = 0, k = 0; i < n; i++) /* the first n lines are the walls */
            k = keep_seen(&p, i, k, &parts);
    }
    if (parts.cut && are_whole(&p, n, &parts)) {
        mem_free(parts.part);
        parts = (struct wall_parts){0};
    }
    free_plane(&p);
    return parts;
}

/* The half of the nearest piece that shows itself to x: its room is that of x, for nothing is
 * between. At a node it is the piece from whose line x is farther. */
static int half_before(const struct cover_plane *p, const double *x)
{
    double least = INFINITY, sure = -1.0;
    int half = -1;
    for (int k = 0; k < p->npieces; k++) {
        const struct piece *c = p->piece + k;
        const struct cover_line *l = p->line + c->line;
        const double d[2] = {x[0] - l->a[0], x[1] - l->a[1]};
        const double along = fmax(c->from, fmin(d[0] * l->t[0] + d[1] * l->t[1], c->to));
        const double left = d[1] * l->t[0] - d[0] * l->t[1];
        const double r = hypot(d[0] - along * l->t[0], d[1] - along * l->t[1]);
        if (r > least + 1e-9 * p->near || (r > least - 1e-9 * p->near && fabs(left) <= sure))
            continue;
        least = fmin(r, least);
        sure = fabs(left);
        half = 2 * k + (left < 0.0);
    }
    return half;
}

int wall_cover_first_open(int n, const double (*ends)[2][2], const double *lo, const double *hi,
                          double near, int npoints, const double (*x)[2])
{
    struct cover_plane p = make_plane(n, ends, lo, hi, near);
    int i = 0;
    cut_lines(&p);
    part_plane(&p);
    for (; i < npoints; i++) {
        const int half = half_before(&p, x[i]);
        if (half < 0 || !p.shut[p.face[half]])
            break;
    }
    free_plane(&p);
    return i;
}
