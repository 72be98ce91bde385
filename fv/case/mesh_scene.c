/* mesh_scene.c - what contradicts itself in a scene on blocks: refused with the reason before
 * anything runs. SPDX-License-Identifier: BSD-3-Clause */
#include "../../common/scene/scene.h"
#include "../boundary/fv_boundary.h"
#include "../fv.h"
#include "../grid/fv_grid.h"
#include "fv_case.h"

static const char *const sides[] = {"i_min", "i_max", "j_min", "j_max", "k_min", "k_max"};

/* A face of a side: the cell inside, the area outwards (m^(dim-1)) and the centre. */
struct scene_face {
    int cell[3];
    double S[3], x[3];
};

/* 2D: one edge lies along z with the length 1, so S is m per m of depth. */
static struct scene_face face_at(const struct mesh *m, const struct mesh_block *b, int side, int p,
                                 int q)
{
    const int a = side / 2, t[2] = {(a + 1) % 3, (a + 2) % 3};
    const double out = side % 2 ? 1.0 : -1.0;
    double e[2][3] = {{0.0, 0.0, 1.0}, {0.0, 0.0, 1.0}};
    struct scene_face f = {{0, 0, 0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    int v[3];
    v[a] = side % 2 ? b->n[a] : 0;
    v[t[0]] = f.cell[t[0]] = p;
    v[t[1]] = f.cell[t[1]] = q;
    f.cell[a] = side % 2 ? b->n[a] - 1 : 0;
    for (int n = 0; n < 2; n++) { /* edges through the middle of the face */
        const int along = t[n], across = t[1 - n];
        for (int c = 0; c < 3 && along < m->dim; c++) {
            double sum = 0.0;
            for (int k = 0; k < (across < m->dim ? 2 : 1); k++) {
                int lo[3] = {v[0], v[1], v[2]}, hi[3];
                lo[across] += k;
                for (int d = 0; d < 3; d++)
                    hi[d] = lo[d] + (d == along);
                const double *x = b->x[mesh_vertex(b, lo[0], lo[1], lo[2])],
                             *y = b->x[mesh_vertex(b, hi[0], hi[1], hi[2])];
                sum += (y[c] - x[c]) / (across < m->dim ? 2.0 : 1.0);
                f.x[c] += n == (t[0] < m->dim ? 0 : 1)
                              ? 0.5 * (x[c] + y[c]) / (across < m->dim ? 2.0 : 1.0)
                              : 0.0;
            }
            e[n][c] = sum;
        }
    }
    for (int c = 0; c < 3; c++)
        f.S[c] =
            out * (e[0][(c + 1) % 3] * e[1][(c + 2) % 3] - e[0][(c + 2) % 3] * e[1][(c + 1) % 3]);
    return f;
}

/* What a side does, over its computed cells. */
struct total {
    double flux, most; /* m^dim/s: outwards, sum of the sizes */
    double worst;      /* -: largest |w.S|/(|w| |S|) */
    double slant;      /* -: largest |g.S|/(|g| |S|) */
    double height;     /* m^2/s^2: least and most of -g.x */
    double height_most;
    bool any;
};

/* Velocities are relative to the block, which carries its sides along. */
static struct total sum_side(const struct run *r, const struct mesh *m, int k, int side,
                             const struct exact *e)
{
    const struct mesh_block *b = m->block + k;
    const int a = side / 2, p1 = b->n[(a + 1) % 3], q1 = b->n[(a + 2) % 3];
    struct total sum = {.height = INFINITY, .height_most = -INFINITY};
    double still[3];
    (void)scene_still_gravity(&r->scene, still);
    for (int q = 0; q < q1; q++)
        for (int p = 0; p < p1; p++) {
            const struct scene_face f = face_at(m, b, side, p, q);
            double w[3] = {0.0, 0.0, 0.0}, rigid[3], wS = 0.0, w2 = 0.0, S2 = 0.0, height = 0.0,
                   gS = 0.0, g2 = 0.0;
            if (b->status[mesh_cell(b, f.cell)] != CELL_COMPUTED)
                continue;
            if (b->side[side] == MESH_EXACT)
                exact_point(e, f.x, 0.0, w, NULL, NULL);
            else if (b->side[side] == MESH_WALL || b->side[side] == MESH_INFLOW)
                mesh_side_velocity(r, b, side, f.x, w);
            mesh_motion_velocity(b, f.x, rigid);
            for (int c = 0; c < m->dim; c++) {
                w[c] -= rigid[c];
                wS += w[c] * f.S[c];
                w2 += w[c] * w[c];
                S2 += f.S[c] * f.S[c];
                gS += still[c] * f.S[c];
                g2 += still[c] * still[c];
                height -= still[c] * f.x[c];
            }
            sum.any = true;
            sum.flux += wS;
            sum.most += fabs(wS);
            sum.worst = fmax(sum.worst, w2 > 0.0 ? fabs(wS) / sqrt(w2 * S2) : 0.0);
            sum.slant = fmax(sum.slant, g2 > 0.0 ? fabs(gS) / sqrt(g2 * S2) : 0.0);
            sum.height = fmin(sum.height, height);
            sum.height_most = fmax(sum.height_most, height);
        }
    return sum;
}

/* At which heights outflows are, m^2/s^2. Those on one side of the domain are one, of however many
 * blocks. */
struct outflow_heights {
    struct total of[6];
    double least, most; /* of their middles */
};

static void add_middle(struct outflow_heights *h, const struct total *t)
{
    if (!t->any)
        return;
    h->least = fmin(h->least, 0.5 * (t->height + t->height_most));
    h->most = fmax(h->most, 0.5 * (t->height + t->height_most));
}

/* on: the side of the domain, 6: within it. */
static void add_outflow(struct outflow_heights *h, int on, const struct total *t)
{
    if (on >= 6) {
        add_middle(h, t);
        return;
    }
    struct total *to = h->of + on;
    to->height = to->any ? fmin(to->height, t->height) : t->height;
    to->height_most = to->any ? fmax(to->height_most, t->height_most) : t->height_most;
    to->any = true;
}

/* Walls move along themselves; what flows in must be able to flow out, and not fall. */
static void check_sides(const struct run *r, struct faults *f, const struct mesh *m)
{
    const struct exact e = exact_create(&r->scene);
    struct outflow_heights outflows = {.least = INFINITY, .most = -INFINITY};
    double net = 0.0, all = 0.0, size = 0.0;
    bool out = false, in = false, exact = false;
    for (int k = 0; k < m->nblocks; k++)
        for (int side = 0; side < 2 * m->dim; side++) {
            const enum mesh_side kind = m->block[k].side[side];
            const struct total t = sum_side(r, m, k, side, &e);
            if (!t.any)
                continue;
            if (kind == MESH_WALL && t.worst > 0.01)
                mesh_fault(r, f, m->block[k].prm, sides[side],
                           "the wall would pump fluid through itself: it moves along itself alone, "
                           "and its velocity has a part of %.0f %% across; name the moving wall by "
                           "lid, or make an \"inflow\"",
                           100.0 * t.worst);
            if (kind == MESH_WALL && !(r->scene.fluid.nu > 0.0))
                mesh_fault(r, f, m->block[k].prm, sides[side],
                           "without viscosity (fluid.nu) a wall exerts no friction: \"slip\", or a "
                           "viscosity");
            if (kind == MESH_INFLOW && !(t.most > 0.0))
                mesh_fault(r, f, m->block[k].prm, sides[side],
                           "an inflow without a velocity across it: nothing flows in");
            if (kind == MESH_INFLOW && t.flux > 0.0 && surface_wanted(r))
                mesh_fault(r, f, m->block[k].prm, sides[side],
                           "its velocity points out of the block: with a free surface that is an "
                           "outflow with a discharge");
            if (kind == MESH_OUTFLOW && t.slant > 1e-6 && surface_wanted(r))
                mesh_fault(r, f, m->block[k].prm, sides[side],
                           "water would fall out of it: with a free surface an outflow stands "
                           "upright, along gravity");
            if (kind == MESH_OUTFLOW)
                add_outflow(&outflows, m->block[k].on[side], &t);
            out = out || (side_is_opening(kind) && kind != MESH_INFLOW);
            in = in || kind == MESH_INFLOW;
            exact = exact || kind == MESH_EXACT;
            net += kind == MESH_INFLOW || kind == MESH_EXACT ? t.flux : 0.0;
            all += kind == MESH_INFLOW || kind == MESH_EXACT ? t.most : 0.0;
        }
    for (int a = 0; a < m->dim; a++)
        size += fabs(r->scene.fluid.gravity[a]) * (r->scene.domain.max[a] - r->scene.domain.min[a]);
    for (int g = 0; g < 2 * m->dim; g++)
        add_middle(&outflows, outflows.of + g);
    if (outflows.most - outflows.least > 1e-9 * size &&
        !surface_wanted(r)) /* outside stands water, too */
        fv_fault_falls(r, f);
    if (out && in && !exact && net > 1e-6 * all && !surface_wanted(r) && !r->coupled)
        fv_fault_sucks(r, f, "blocks", net);
    if (!out && fabs(net) > (exact ? 0.01 : 1e-6) * all)
        params_fault(r->params, f, "blocks",
                     "an %s without an outflow: %g m^%d/s more flow %s, and no side is an "
                     "\"outflow\"",
                     in ? "inflow" : "exact side", fabs(net), m->dim,
                     net < 0.0 ? "in than out" : "out than in");
}

/* newton knows one level alone, outside all outflows. */
static void check_outside(const struct run *r, struct faults *f, const struct mesh *m)
{
    struct mesh_outside of[MESH_OUTSIDES];
    if (!surface_wanted(r) || fv_params_of(r)->integrator != INTEGRATOR_NEWTON)
        return;
    mesh_outside_find(r, m, of);
    for (int k = 0; k < m->nblocks; k++)
        for (int side = 0; side < 2 * m->dim; side++) {
            const struct mesh_block *b = m->block + k;
            const struct mesh_outside *o = of + b->on[side];
            if (b->side[side] != MESH_OUTFLOW || b->wall[side])
                continue;
            if (o->falls || o->lower)
                mesh_fault(r, f, b->prm, sides[side], "%s", surface_newton_lacks(o->falls));
        }
}

/* Where a block reaches furthest out of the domain, over its length; 0: nowhere. */
static double beyond_domain(const struct run *r, const struct mesh *m, const struct mesh_block *b,
                            double at[3])
{
    const struct scene_domain *d = &r->scene.domain;
    double beyond = 0.0;
    int i[3];
    for (i[2] = 0; i[2] <= (m->dim == 3 ? b->n[2] : 0); i[2]++)
        for (i[1] = 0; i[1] <= b->n[1]; i[1]++)
            for (i[0] = 0; i[0] <= b->n[0]; i[0]++) {
                const double *x = b->x[mesh_vertex(b, i[0], i[1], i[2])];
                for (int a = 0; a < m->dim; a++) {
                    const double L = d->max[a] - d->min[a],
                                 out = fmax(d->min[a] - x[a], x[a] - d->max[a]) / L;
                    if (d->periodic[a] || !(out > beyond))
                        continue;
                    beyond = out;
                    for (int c = 0; c < m->dim; c++)
                        at[c] = x[c];
                }
            }
    return beyond;
}

/* The domain is what periods, levels and centre lines are taken from. */
static void check_extent(const struct run *r, struct faults *f, const struct mesh *m)
{
    for (int k = 0; k < m->nblocks; k++) {
        double at[3] = {0.0, 0.0, 0.0};
        if (beyond_domain(r, m, m->block + k, at) > 1e-6)
            mesh_fault(r, f, m->block[k].prm, "name",
                       "it reaches out of the domain, to (%g, %g, %g) m", at[0], at[1], at[2]);
    }
}

/* --- blocks that move --- */

enum { SWEEP_TIMES = 2000, SWEEP_CUTS = 12 };

/* Whether it turns, as told by terms, and its centre is not given. */
static bool turns_about_origin(const struct run *r, const struct mesh_block_params *b)
{
    const char *key = key_text("blocks.[%d].centre", (int)(b - mesh_given));
    return scene_motions_turn(&b->motion) && !params_given(r->params, key);
}

/* At one place of the run: false: faults were added. */
static bool sound_at(const struct run *r, struct faults *f, struct mesh *m, double t)
{
    struct overset_orphan o;
    mesh_motion_place(m, t);
    for (int k = 0; k < m->nblocks; k++) {
        double at[3] = {0.0, 0.0, 0.0};
        if (m->block[k].motion && beyond_domain(r, m, m->block + k, at) > 1e-6) {
            mesh_fault(r, f, m->block[m->block[k].motion->block].prm, "motion",
                       "at t = %g s it reaches out of the domain, to (%g, %g, %g) m: a smaller "
                       "motion, or a larger domain and background%s",
                       t, at[0], at[1], at[2],
                       turns_about_origin(r, m->block[m->block[k].motion->block].prm)
                           ? "; it turns about the origin, by angles in rad: give its centre"
                           : "");
            return false;
        }
    }
    if (!m->has_fringe)
        return true;
    overset_cut(m, m->search);
    if (overset_sound(m, m->search, &o))
        return true;
    mesh_fault(r, f, m->block[o.block].prm, "name",
               "at t = %g s its cell (%d, %d, %d) at (%g, %g, %g) m has no donors: no other block "
               "has computed cells around it. A smaller motion, a background that reaches further, "
               "or 8 cells or more beyond the walls of the block that moves",
               t, o.cell[0], o.cell[1], o.cell[2], o.x[0], o.x[1], o.x[2]);
    return false;
}

/* Where each degree of freedom is least and largest, and at even times between. */
static int times_of(const struct run *r, const struct mesh_motion *v, double *times)
{
    const double end = r->scene.time.end;
    double least[BODY_AXES] = {0.0}, most[BODY_AXES] = {0.0};
    int n = 0;
    for (int e = 0; e <= SWEEP_TIMES; e++) {
        double d[BODY_AXES], dd[BODY_AXES], ddd[BODY_AXES];
        const double t = end * e / SWEEP_TIMES;
        body_drive_at(&v->drive, t, d, dd, ddd);
        for (int a = 0; a < BODY_AXES; a++) {
            if (e == 0 || d[a] < least[a]) {
                least[a] = d[a];
                times[2 * a] = t;
            }
            if (e == 0 || d[a] > most[a]) {
                most[a] = d[a];
                times[2 * a + 1] = t;
            }
        }
    }
    n = 2 * BODY_AXES;
    for (int e = 1; e <= SWEEP_CUTS; e++)
        times[n++] = end * e / SWEEP_CUTS;
    return n;
}

/* Blocks that are joined to another move with it, and are looked at with it. The first fault ends
 * it. */
void mesh_motion_sweep(const struct run *r, struct faults *f, struct mesh *m)
{
    for (int k = 0; k < m->nblocks; k++) {
        const struct mesh_motion *v = m->block[k].motion;
        double times[2 * BODY_AXES + SWEEP_CUTS], last = 0.0;
        if (!v || v->block != k)
            continue;
        const int n = times_of(r, v, times);
        for (int e = 0; e < n; e++) {
            if (times[e] == last) /* the start has been looked at */
                continue;
            last = times[e];
            if (!sound_at(r, f, m, times[e]))
                return;
        }
    }
}

/* Whether some block has computed cells around x; along gravity somewhere for the level of water.
 */
static bool is_covered(const struct run *r, const struct mesh *m, const struct overset *o,
                       const struct scene_probe *p)
{
    const int up = still_upright(&r->scene), most = p->kind == PROBE_LEVEL ? 100 : 0;
    const struct scene_domain *d = &r->scene.domain;
    for (int n = 0; n <= most; n++)
        for (int b = 0; b < m->nblocks; b++) {
            int cell[3], from[3];
            double x[3] = {p->at[0], p->at[1], p->at[2]}, xi[3], w[64];
            if (most > 0)
                x[up] = d->min[up] + n * (d->max[up] - d->min[up]) / most;
            if (overset_locate(m, o, b, x, cell, xi) &&
                overset_weights(m, b, cell, xi, 1, 2, from, w))
                return true;
        }
    return false;
}

/* That the blocks to which gauges are fixed move, by their own motion or with one they are joined
 * to. */
static void check_bodies(const struct run *r, struct faults *f, const struct mesh *m)
{
    for (int k = 0; k < r->scene.nprobes && !r->coupled; k++)
        for (int b = 0; b < m->nblocks; b++) {
            if (strcmp(m->block[b].prm->name, r->scene.probes[k].body) == 0)
                params_unused(r->params, f, key_text("probes.[%d].body", k),
                              m->block[b].motion != NULL, "no block of that name moves");
        }
}

static void check_probes(const struct run *r, struct faults *f, const struct mesh *m)
{
    check_bodies(r, f, m);
    if (r->scene.nprobes == 0)
        return;
    struct overset *o = overset_search(r, m);
    for (int k = 0; k < r->scene.nprobes; k++) {
        const struct scene_probe *p = r->scene.probes + k;
        if (!r->gauge_elsewhere[k] && p->kind != PROBE_DISCHARGE && !is_covered(r, m, o, p))
            params_fault(r->params, f, key_text("probes.[%d].at", k),
                         "probe \"%s\": no block has computed cells around (%g, %g, %g) m", p->name,
                         p->at[0], p->at[1], p->at[2]);
    }
    FREE(o);
}

void mesh_scene_check(const struct run *r, struct faults *f, const struct mesh *m)
{
    check_sides(r, f, m);
    check_outside(r, f, m);
    check_extent(r, f, m);
    check_probes(r, f, m);
}
