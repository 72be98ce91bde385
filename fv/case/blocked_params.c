/* blocked_params.c - the list blocked: boxes that are cut out of the grid, and what is wrong with
 * them. SPDX-License-Identifier: BSD-3-Clause */
#include "fv_case.h"

#include <stdarg.h>

#include "../../common/scene/scene.h"

#define P struct blocked_params
/* clang-format off */
const struct param blocked_rows[BLOCKED_ROWS] = {
    PARAM(P, name, "-", "box#", 0, 0, "its name in outputs and messages"),
    PARAM(P, min,  "m", NULL, -1e9, 1e9, "lower corner; corners go to the nearest faces of cells"),
    PARAM(P, max,  "m", NULL, -1e9, 1e9, "upper corner"),
    CHOICE(P, kind, "slip|no_slip", "slip", "kind of boundary on its faces"),
};
/* clang-format on */
#undef P

struct blocked_params blocked_given[BLOCKED_MAX];
int blocked_given_count;

/* What faults of all boxes are told of. */
static const char *group_of(void) { return blocked_given_count > 0 ? "blocked" : "bodies"; }

static double spacing(const struct run *r, int a)
{
    const struct scene_domain *d = &r->scene.domain;
    return (d->max[a] - d->min[a]) / fv_params_of(r)->cells[a];
}

/* In the words of whoever gave the box: the list blocked with its key, or a body. */
static void fault(const struct run *r, struct faults *f, int k, const char *key, const char *fmt,
                  ...) __attribute__((format(printf, 5, 6)));
static void fault(const struct run *r, struct faults *f, int k, const char *key, const char *fmt,
                  ...)
{
    char text[400], path[64];
    va_list args;
    va_start(args, fmt);
    vsnprintf(text, sizeof text, fmt, args);
    va_end(args);
    const struct blocked_params *box = fv_params_of(r)->boxes + k;
    if (box->body > 0)
        snprintf(path, sizeof path, "bodies.[%d]", box->body - 1);
    else
        snprintf(path, sizeof path, "blocked.[%d].%s", k, key);
    params_fault(r->params, f, path, "box \"%s\": %s", box->name, text);
}

/* off: how far a corner is from what it was given as, in cells; beyond the domain nothing counts.
 */
void blocked_describe(const struct run *r)
{
    const struct scene_domain *d = &r->scene.domain;
    const struct fv_params *prm = fv_params_of(r);
    for (int k = 0; k < prm->nboxes; k++) {
        int lo[3], hi[3];
        char text[200] = "";
        double off = 0.0;
        blocked_cells(&r->scene.domain, prm, k, lo, hi);
        for (int a = 0; a < d->dim; a++) {
            const double h = spacing(r, a), x = d->min[a] + lo[a] * h, y = d->min[a] + hi[a] * h;
            off = fmax(off, fabs(fmax(prm->boxes[k].min[a], d->min[a]) - x) / h);
            off = fmax(off, fabs(fmin(prm->boxes[k].max[a], d->max[a]) - y) / h);
            text_add(text, sizeof text, "%s%g to %g", a ? " x " : "", x, y);
        }
        log_say("box \"%s\": %s m%s", prm->boxes[k].name, text,
                off > 1e-6 ? ", the nearest faces of cells" : "");
        snprintf(text, sizeof text, "box \"%.100s\"", prm->boxes[k].name);
        if (prm->boxes[k].body == 0)
            scene_waves_stands(&r->scene, text, prm->boxes[k].min, prm->boxes[k].max);
    }
}

/* --- a coarse grid whose lines are the faces of all boxes --- */

struct coarse {
    int n[3], edge[3][2 * BLOCKED_MAX + 2]; /* cells of the whole grid */
    int *box;                               /* 0 free, else 1 + number */
    int narrow, beside, across; /* cells of the narrowest gap below gravity's side, its box, axis */
    const struct fv_params *prm;
};

static int coarse_at(const struct coarse *g, int i, int j, int k)
{
    return i + g->n[0] * (j + g->n[1] * k);
}

/* Keeps the edges in order and each once, so that n + 1 of them bound n cells. */
static void add_edge(struct coarse *g, int a, int at)
{
    int m = g->n[a] + 1;
    for (int i = 0; i < m; i++)
        if (g->edge[a][i] == at)
            return;
    while (m > 0 && g->edge[a][m - 1] > at) {
        g->edge[a][m] = g->edge[a][m - 1];
        m--;
    }
    g->edge[a][m] = at;
    g->n[a]++;
}

/* Of boxes that overlap the later one has the cell. box: owned by the caller. */
static struct coarse make_coarse(const struct run *r)
{
    struct coarse g = {.prm = fv_params_of(r)};
    int lo[BLOCKED_MAX][3], hi[BLOCKED_MAX][3];
    for (int a = 0; a < 3; a++) {
        g.edge[a][0] = 0;
        add_edge(&g, a, a < r->scene.domain.dim ? g.prm->cells[a] : 1);
    }
    for (int k = 0; k < g.prm->nboxes; k++) {
        blocked_cells(&r->scene.domain, g.prm, k, lo[k], hi[k]);
        for (int a = 0; a < 3; a++) {
            add_edge(&g, a, lo[k][a]);
            add_edge(&g, a, hi[k][a]);
        }
    }
    g.box = NEW(int, g.n[0] * g.n[1] * g.n[2]);
    for (int c = 0; c < g.n[0] * g.n[1] * g.n[2]; c++) {
        const int i[3] = {c % g.n[0], c / g.n[0] % g.n[1], c / (g.n[0] * g.n[1])};
        for (int k = 0; k < g.prm->nboxes; k++) {
            bool in = true;
            for (int a = 0; a < 3; a++)
                in = in && g.edge[a][i[a]] >= lo[k][a] && g.edge[a][i[a]] < hi[k][a];
            g.box[c] = in ? k + 1 : g.box[c];
        }
    }
    return g;
}

/* Whether a gap ends at a no-slip face: at a box (from 1 on), or (0) at the side. */
static bool has_friction(const struct run *r, const struct coarse *g, int a, int up, int box)
{
    const struct scene_wall *w =
        scene_wall_of(&r->scene, (enum scene_side)(SIDE_X_MIN + 2 * a + up));
    return box > 0 ? g->prm->boxes[box - 1].kind == WALL_NO_SLIP : w && w->kind == WALL_NO_SLIP;
}

/* Whether the domain ends there in the air, without a wall of the case. */
static bool is_air(const struct run *r, int a, int up)
{
    const struct scene_wall *w =
        scene_wall_of(&r->scene, (enum scene_side)(SIDE_X_MIN + 2 * a + up));
    return !w || w->assumed;
}

/* Keeps the narrowest gap that is enough for the scheme. */
static void note_gap(struct coarse *g, int a, int box, int cells)
{
    if (2 * cells < g->prm->cells[a] && (g->narrow == 0 || cells < g->narrow)) {
        g->narrow = cells;
        g->beside = box;
        g->across = a;
    }
}

/* Inviscid water that leaves a slot under water: with 4 cells 0.83 of it for 0.73; into the air it
 * parts from sharp edges (surface/vents.c). */
static void warn_narrow(const struct coarse *g)
{
    enum { ENOUGH = 12 };
    if (g->narrow > 0 && g->narrow < ENOUGH)
        log_warn(
            "box \"%s\": %d cells along %c between it and what is next: under water a jet out of "
            "so narrow an opening contracts too little, and 13 %% (4 cells) too much passes at "
            "a given head; more cells (fv.cells) if that matters",
            g->prm->boxes[g->beside].name, g->narrow, "xyz"[g->across]);
}

/* Whether the free cells from `first' to before `last' along an axis at i are open on either side
 * across it, and no pocket or shaft that ends at a wall. */
static bool is_passage(const struct run *r, const struct coarse *g, int a, const int i[3],
                       int first, int last)
{
    for (int b = 0; b < r->scene.domain.dim; b++) {
        bool open[2] = {false, false};
        for (int up = 0; up < 2 && b != a; up++) {
            int j[3] = {i[0], i[1], i[2]};
            j[b] += up ? 1 : -1;
            if (r->scene.domain.periodic[b])
                j[b] = (j[b] + g->n[b]) % g->n[b];
            for (int m = first; m < last && j[b] >= 0 && j[b] < g->n[b]; m++) {
                j[a] = m % g->n[a];
                open[up] = open[up] || g->box[coarse_at(g, j[0], j[1], j[2])] == 0;
            }
        }
        if (open[0] && open[1])
            return true;
    }
    return false;
}

/* Ghosts are made of three cells: so wide at least must be what lies between a box and another, or
 * a side. */
static void check_gaps(const struct run *r, struct coarse *g, int a, struct faults *f)
{
    const int t = a == 0 ? 1 : 0, q = a == 2 ? 1 : 2;
    const bool periodic = a < r->scene.domain.dim && r->scene.domain.periodic[a];
    bool told[BLOCKED_MAX] = {false};
    int i[3];
    for (i[q] = 0; i[q] < g->n[q]; i[q]++)
        for (i[t] = 0; i[t] < g->n[t]; i[t]++) {
            int from = periodic ? -1 : 0, box = 0; /* where free cells begin, after which box */
            int first = 0;                         /* of them on the coarse grid */
            for (int m = 0; m < (periodic ? 2 : 1) * g->n[a] + 1; m++) {
                const bool end = !periodic && m == g->n[a];
                i[a] = m % g->n[a];
                const int at = g->edge[a][i[a]] + m / g->n[a] * g->edge[a][g->n[a]];
                const int here = end ? 0 : g->box[coarse_at(g, i[0], i[1], i[2])];
                if (!here && !end)
                    continue;
                const int k = here ? here - 1 : box - 1;
                const int least = has_friction(r, g, a, 0, box) && has_friction(r, g, a, 1, here)
                                      ? BLOCKED_GAP_NO_SLIP
                                      : BLOCKED_GAP;
                if (k >= 0 && from >= 0 && at - from > 0 && at - from < least && !told[k]) {
                    fault(r, f, k, "min",
                          "only %d cells along %c are left between it and what is next: at least "
                          "%d%s, or none; more cells (fv.cells)",
                          at - from, "xyz"[a], least,
                          least > BLOCKED_GAP ? " between no-slip faces" : "");
                    told[k] = true;
                } else if (k >= 0 && from >= 0 && at - from > 0 && !(end && is_air(r, a, 1)) &&
                           !(box == 0 && is_air(r, a, 0)) && is_passage(r, g, a, i, first, m))
                    note_gap(g, a, k, at - from);
                from = at + (end ? 0 : g->edge[a][i[a] + 1] - g->edge[a][i[a]]);
                box = here;
                first = m + 1;
            }
        }
}

/* Without a surface the pressure of each region counts from a level of its own. */
static void check_whole(const struct run *r, const struct coarse *g, struct faults *f)
{
    const int n = g->n[0] * g->n[1] * g->n[2], step[3] = {1, g->n[0], g->n[0] * g->n[1]};
    int *queue = NEW(int, n), head = 0, tail = 0, left = 0;
    for (int c = 0; c < n && tail == 0; c++)
        if (!g->box[c]) {
            g->box[c] = -1;
            queue[tail++] = c;
        }
    while (head < tail) {
        const int c = queue[head++], i[3] = {c % g->n[0], c / g->n[0] % g->n[1], c / step[2]};
        for (int way = 0; way < 6; way++) {
            const int a = way / 2, m = g->n[a];
            int to = i[a] + (way % 2 ? 1 : -1);
            if ((to < 0 || to >= m) && !(a < r->scene.domain.dim && r->scene.domain.periodic[a]))
                continue;
            to = c + ((to + m) % m - i[a]) * step[a];
            if (g->box[to] == 0) {
                g->box[to] = -1;
                queue[tail++] = to;
            }
        }
    }
    for (int c = 0; c < n; c++)
        left += g->box[c] == 0;
    if (tail == 0)
        params_fault(r->params, f, group_of(), "nothing is left of the domain");
    else if (left > 0 && !surface_wanted(r))
        params_fault(r->params, f, group_of(),
                     "the boxes cut the domain into separate parts: each would need a pressure of "
                     "its own; run them one by one, or leave a gap of %d cells",
                     BLOCKED_GAP);
    mem_free(queue);
}

/* --- one box --- */

/* A box may stand on a wall at rest alone: at an opening there would be no room for what flows in,
 * and a wall that moves would end at a corner. */
static void check_sides(const struct run *r, int k, const int *lo, const int *hi, struct faults *f)
{
    const struct scene *s = &r->scene;
    for (int side = 0; side < 2 * s->domain.dim; side++) {
        const int a = side / 2;
        const struct scene_wall *w = scene_wall_of(s, (enum scene_side)(SIDE_X_MIN + side));
        if (s->domain.periodic[a] || !(side % 2 ? hi[a] == fv_params_of(r)->cells[a] : lo[a] == 0))
            continue;
        bool moves = false;
        for (int q = 0; w && q < 3; q++)
            moves = moves || w->velocity[q] != 0.0;
        if (!w || w->kind > WALL_NO_SLIP)
            fault(r, f, k, side % 2 ? "max" : "min",
                  "it stands on the side %c_%s, which is no wall: leave %d cells between, or give "
                  "it a wall",
                  "xyz"[a], side % 2 ? "max" : "min", BLOCKED_GAP);
        else if (moves && w->kind == WALL_NO_SLIP)
            fault(r, f, k, side % 2 ? "max" : "min",
                  "it stands on the wall %c_%s, which moves along itself: leave %d cells between",
                  "xyz"[a], side % 2 ? "max" : "min", BLOCKED_GAP);
    }
}

/* A box has one place: what reaches over a side of the period would be lost, unless it fills it. */
static void check_period(const struct run *r, int k, int a, struct faults *f)
{
    const struct scene_domain *d = &r->scene.domain;
    const struct blocked_params *p = fv_params_of(r)->boxes + k;
    const double L = d->max[a] - d->min[a], below = d->min[a] - p->min[a],
                 above = p->max[a] - d->max[a];
    if (!d->periodic[a] || fmax(below, above) < 1e-9 * L || fmin(below, above) > -1e-9 * L)
        return;
    fault(r, f, k, below > above ? "min" : "max",
          "from %g to %g m along %c it reaches over a periodic side: give its parts as two boxes, "
          "%g to %g m and %g to %g m",
          p->min[a], p->max[a], "xyz"[a], below > above ? d->min[a] : p->min[a],
          below > above ? p->max[a] : d->max[a], below > above ? d->max[a] - below : d->min[a],
          below > above ? d->max[a] : d->min[a] + above);
}

/* false: what looks at all boxes together cannot go on. */
static bool check_box(const struct run *r, int k, struct faults *f)
{
    const struct scene_domain *d = &r->scene.domain;
    const struct fv_params *prm = fv_params_of(r);
    const struct blocked_params *p = prm->boxes + k;
    const int before = f->n;
    int lo[3], hi[3];
    blocked_cells(&r->scene.domain, prm, k, lo, hi);
    for (int a = 0; a < d->dim; a++)
        if (p->max[a] <= p->min[a])
            fault(r, f, k, "max", "from %g to %g m along %c: give max above min", p->min[a],
                  p->max[a], "xyz"[a]);
        else if (!(p->max[a] > d->min[a] && p->min[a] < d->max[a]))
            fault(r, f, k, "min", "it lies outside the domain along %c", "xyz"[a]);
        else if (hi[a] <= lo[a])
            fault(r, f, k, "max",
                  "from %g to %g m along %c it is no whole cell: cells are %g m there", p->min[a],
                  p->max[a], "xyz"[a], spacing(r, a));
    if (p->kind == WALL_NO_SLIP && !(r->scene.fluid.nu > 0.0))
        fault(
            r, f, k, "kind",
            "without viscosity (fluid.nu) it exerts no friction: kind = \"slip\", or a viscosity");
    for (int q = 0; q < k; q++)
        if (strcmp(p->name, prm->boxes[q].name) == 0)
            fault(r, f, k, "name", "another box has this name");
    for (int a = 0; a < d->dim && f->n == before; a++)
        check_period(r, k, a, f);
    if (f->n == before)
        check_sides(r, k, lo, hi, f);
    for (int q = 0; q < r->scene.nprobes; q++) {
        const struct scene_probe *g = r->scene.probes + q;
        bool in = probe_is_point(g);
        for (int a = 0; a < d->dim; a++)
            in = in && g->at[a] > p->min[a] + 1e-9 && g->at[a] < p->max[a] - 1e-9;
        if (in)
            params_fault(r->params, f, key_text("probes.[%d].at", q),
                         "probe \"%s\" lies in the box \"%s\"", g->name, p->name);
    }
    return f->n == before;
}

/* What knows no boxes. */
static void check_mode(const struct run *r, struct faults *f)
{
    const struct fv_params *prm = fv_params_of(r);
    const int field = r->scene.initial.field;
    const char *group = group_of();
    if (mesh_given_count > 0)
        params_fault(r->params, f, group,
                     "not with blocks: leave them out there, and give their sides kinds");
    if (r->coupled)
        params_fault(r->params, f, group, "not in a coupled job: use bodies");
    if (prm->integrator == INTEGRATOR_NEWTON)
        params_fault(r->params, f, group, "not with newton: fv.integrator = \"rk3\"");
    if (prm->graded[1] > 0.0)
        params_fault(r->params, f, group, "not with graded layers (fv.graded)");
    if (prm->hole[1][0] > prm->hole[0][0])
        params_fault(r->params, f, group, "not with fv.hole");
    if (field != FIELD_REST && field != FIELD_UNIFORM && !scene_has_wave(&r->scene))
        params_fault(r->params, f, "initial.field",
                     "it has no boxes: \"rest\", \"uniform\" or a wave with them");
}

/* Each box alone, then all together on the coarse grid, which wants sound ones. */
void blocked_check(const struct run *r, struct faults *f)
{
    const int before = f->n;
    bool good = true;
    const struct fv_params *prm = fv_params_of(r);
    if (prm->nboxes == 0)
        return;
    check_mode(r, f);
    for (int a = 0; a < r->scene.domain.dim; a++)
        good = good && prm->cells[a] > 0;
    for (int k = 0; k < prm->nboxes && f->n == before && good; k++)
        good = check_box(r, k, f);
    if (f->n > before || !good)
        return;
    struct coarse g = make_coarse(r);
    for (int a = 0; a < r->scene.domain.dim; a++)
        check_gaps(r, &g, a, f);
    warn_narrow(&g);
    check_whole(r, &g, f);
    mem_free(g.box);
}
