/* bc.c - ghosts and fluxes at the sides of uniform cells and of layers. Ghost averages of velocity
 * follow from the cells inside (ghosts.h): no-slip and inflow: all components given; slip: the
 * normal one antisymmetric, the others mirrored; outflow: mirrored. In the notation of ghosts.h a
 * given value w on the face and three cells make the ghosts by a cubic. Sides are filled axis by
 * axis in the order of `turn', so that corners belong to the last one. Called by every operator
 * that needs ghosts (bc_ghosts), by projections (bc_fluxes, bc_set_slip) and by sums over faces
 * (bc_visit).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "bc.h"

#include "blocked.h"
#include "carried.h"
#include "ghosts.h"
#include "levels.h"

/* A side's cells on this rank: tangents t[0] < t[1], indices from lo to hi. Places count from -g,
 * so that those behind other sides have their own. */
struct bc_side {
    int a, t[2], lo[2], hi[2];
    int width;  /* places along t[0] */
    int first;  /* cell along a that touches the side */
    int64_t in; /* step inwards */
};

/* Tangents of an axis filled before have their ghosts by then: sides are filled axis by axis.
 * corners: with these ghosts. */
static struct bc_side side_of(const struct bc *bc, const struct block *b, int k, bool corners)
{
    struct bc_side d = {.a = k / 2};
    int n = 0;
    for (int a = 0; a < 3; a++)
        if (a != d.a)
            d.t[n++] = a;
    for (int m = 0; m < 2; m++) {
        const int t = d.t[m];
        const bool more = corners && bc->turn[t] < bc->turn[d.a];
        d.lo[m] = more && block_has_side(b, 2 * t) ? -b->g[t] : 0;
        d.hi[m] = b->n[t] + (more && block_has_side(b, 2 * t + 1) ? b->g[t] : 0);
    }
    d.width = b->n[d.t[0]] + 2 * b->g[d.t[0]];
    d.first = k % 2 ? b->n[d.a] - 1 : 0;
    d.in = k % 2 ? -b->stride[d.a] : b->stride[d.a];
    return d;
}

/* Index in the side's arrays of the place (i, j). */
static int64_t place(const struct block *b, const struct bc_side *d, int i, int j)
{
    return (i + b->g[d->t[0]]) + (int64_t)d->width * (j + b->g[d->t[1]]);
}

/* Index in a field of the cell inside at (i, j). */
static int64_t cell(const struct block *b, const struct bc_side *d, int i, int j)
{
    int at[3];
    at[d->a] = d->first;
    at[d->t[0]] = i;
    at[d->t[1]] = j;
    return block_at(b, at[0], at[1], at[2]);
}

/* Visits the places of a side: m counts them, c is the cell inside. */
#define SIDE_PLACES(b, d, i, j, m, c)                                                              \
    for (int j = (d).lo[1]; j < (d).hi[1]; j++)                                                    \
        for (int i = (d).lo[0]; i < (d).hi[0]; i++)                                                \
            for (int64_t m = place(b, &(d), i, j), c = cell(b, &(d), i, j), its_once_##c = 1;      \
                 its_once_##c; its_once_##c = 0)

/* m^(dim-1). */
static double face_area(const struct block *b, const struct bc_side *d, int i, int j)
{
    return block_size(b, d->t[0], i) * block_size(b, d->t[1], j);
}

/* Average of 4 x (1 - x) over the face from x to x + h of a side of length 1. Its maximum is 1. */
static double parabola(double x, double h)
{
    return 2.0 * (2.0 * x + h) - 4.0 / 3.0 * (3.0 * x * x + 3.0 * x * h + h * h);
}

/* The product of parabolas along the tangents that are neither periodic nor beyond dim; 1 without a
 * profile. */
static double profile_at(const struct fv *s, const struct scene_wall *wall, const struct bc_side *d,
                         int i, int j)
{
    const struct block *b = &s->b;
    const int at[2] = {i, j};
    double f = 1.0;
    for (int m = 0; wall->profile && m < 2; m++) {
        const int t = d->t[m];
        if (t >= b->dim || b->periodic[t])
            continue;
        const double h = block_size(b, t, at[m]) / b->length[t];
        f *=
            parabola(t == 1 && b->rows ? (b->rows->y[at[m]] - b->origin[1]) / b->length[1] - 0.5 * h
                                       : (b->lo[t] + at[m]) * h,
                     h);
    }
    return f;
}

/* Places of an opening and the cells inside. S points outwards; own marks faces that are counted
 * once over all ranks. */
static struct outflow *list_places(struct fv *s, struct bc *bc, int k, struct outflow **list,
                                   int *count)
{
    const struct block *b = &s->b;
    struct bc_side d = side_of(bc, b, k, true);
    struct outflow *o = carried_add(s, list, count, b->dim, k, d.a, d.in, bc->n[k], bc->n[k]);
    const bool inflow = bc->kind[k] == MESH_CARRIED && bc->wall[k]->kind == WALL_INFLOW;
    for (int m = 0; m < 2 && inflow; m++) { /* held ones set ghosts of phi, too */
        d.lo[m] = -b->g[d.t[m]];
        d.hi[m] = b->n[d.t[m]] + b->g[d.t[m]];
    }
    const double h = block_size(b, d.a, k % 2 ? b->n[1] - 1 : 0); /* a row, if it is along y */
    SIDE_PLACES (b, d, i, j, m, c) {
        o->place[o->n] = m;
        o->cell[o->n] = c;
        o->S[d.a][o->n] = (k % 2 ? 1.0 : -1.0) * face_area(b, &d, i, j);
        o->h[o->n] = h;
        o->own[o->n++] = i >= 0 && i < b->n[d.t[0]] && j >= 0 && j < b->n[d.t[1]];
    }
    return o;
}

/* A convective or given discharge: velocities w are the side's own array, changed in each stage. */
static void make_outflow(struct fv *s, struct bc *bc, int k, enum outflow_kind kind)
{
    struct outflow *o = list_places(s, bc, k, &s->outflows->of, &s->outflows->n);
    o->kind = kind;
    for (int q = 0; q < s->b.dim; q++) {
        o->w[q] = bc->w[k][q];
        bc->change[k][q] = o->change[q];
    }
}

/* Sets kind, pressure and largest speeds on all ranks, arrays only where this rank has
 * the side; outflux sums the given velocity over this rank's real faces. */
static void make_side(struct fv *s, struct bc *bc, const struct scene_wall *wall)
{
    const struct block *b = &s->b;
    if (wall->side == SIDE_NONE)
        return;
    const int k = wall->side - SIDE_X_MIN, a = k / 2;
    if (a >= b->dim || b->periodic[a])
        return;
    bc->kind[k] = carried_side(s, wall, side_of_wall(wall));
    bc->wall[k] = wall;
    bc->pressure_given = bc->pressure_given || bc->kind[k] == MESH_OUTFLOW;
    if (bc->kind[k] == MESH_OUTFLOW)
        bc->pressure[k] = wall->pressure / s->run->scene.fluid.rho;
    bc->driven = bc->driven || bc->pressure[k] != 0.0;
    for (int q = 0; q < b->dim && bc->kind[k] != MESH_OUTFLOW; q++) {
        bc->speed_along[q] = fmax(bc->speed_along[q], fabs(wall->velocity[q]));
        bc->slides[k] = bc->slides[k] || (bc->kind[k] == MESH_WALL && wall->velocity[q] != 0.0);
    }
    for (int q = 0; q < b->dim; q++)
        bc->speed = fmax(bc->speed, bc->speed_along[q]);
    if (!block_has_side(b, k))
        return;
    const struct bc_side d = side_of(bc, b, k, true), inner = side_of(bc, b, k, false);
    bc->n[k] = (int64_t)d.width * (b->n[d.t[1]] + 2 * b->g[d.t[1]]);
    for (int q = 0; q < b->dim; q++) {
        bc->w[k][q] = NEW_IN(bc, double, bc->n[k]);
        bc->slip[k][q] = NEW_IN(bc, double, bc->n[k]);
        for (int j = -b->g[d.t[1]]; j < b->n[d.t[1]] + b->g[d.t[1]]; j++)
            for (int i = -b->g[d.t[0]]; i < b->n[d.t[0]] + b->g[d.t[0]]; i++)
                bc->w[k][q][place(b, &d, i, j)] = wall->velocity[q] * profile_at(s, wall, &d, i, j);
    }
    if (bc->kind[k] == MESH_CARRIED)
        make_outflow(s, bc, k, carried_kind(wall));
    if (bc->kind[k] == MESH_OUTFLOW && s->levels)
        list_places(s, bc, k, &s->levels->of, &s->levels->n);
    SIDE_PLACES (b, inner, i, j, m, c) {
        if (bc->kind[k] != MESH_CARRIED)
            bc->outflux += (k % 2 ? 1.0 : -1.0) * face_area(b, &inner, i, j) * bc->w[k][a][m];
        (void)c;
    }
}

/* The axis whose walls slide fastest comes last, so that their ghosts go on through the corners.
 * Cut off there by the ghosts of another wall (4 V beside a fluid at rest) they are a jet of no
 * width between two cells, and the product term of convection drives the corners with it. turn[a]
 * is the rank of axis a by the speed of its sliding walls, before them those with openings, or
 * the friction beside a uniform inflow would be 0.4 % different along y; ties in the order of axes.
 */
static void set_turns(const struct scene *scene, int dim, int turn[3])
{
    double speed[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < scene->nwalls; k++) {
        const struct scene_wall *w = scene->walls + k;
        const int a = (w->side - SIDE_X_MIN) / 2;
        if (w->side != SIDE_NONE && a < dim && scene_wall_opens(w))
            speed[a] = -1.0;
    }
    for (int k = 0; k < scene->nwalls; k++) {
        const struct scene_wall *w = scene->walls + k;
        const int a = (w->side - SIDE_X_MIN) / 2;
        for (int q = 0; q < dim && w->side != SIDE_NONE && w->kind == WALL_NO_SLIP && a < dim; q++)
            speed[a] = q == a ? speed[a] : fmax(speed[a], fabs(w->velocity[q]));
    }
    for (int a = 0; a < 3; a++) {
        turn[a] = 0;
        for (int t = 0; t < 3; t++)
            turn[a] += speed[t] < speed[a] || (speed[t] == speed[a] && t < a);
    }
}

/* Openings whose values change (outflows, levels) are created first, since make_side lists their
 * cells. */
struct bc *bc_create(struct fv *s)
{
    const struct scene *scene = &s->run->scene;
    if (scene->nwalls == 0)
        return NULL;
    struct bc *bc = NEW(struct bc, 1);
    carried_create(s);
    levels_create(s);
    set_turns(scene, s->b.dim, bc->turn);
    for (int i = 0; i < scene->nwalls; i++)
        make_side(s, bc, scene->walls + i);
    if (s->outflows)
        s->outflows->given = bc->outflux;
    return bc;
}

/* MESH_NONE: another cell is there, of this rank or a ghost. */
enum mesh_side bc_behind(const struct fv *s, const int *at, int a)
{
    const struct block *b = &s->b;
    const int i = b->lo[a] + at[a];
    if (!s->bc || a >= b->dim || b->periodic[a] || (i >= 0 && i < b->cells[a]))
        return MESH_NONE;
    return s->bc->kind[2 * a + (i >= 0)];
}

/* n places of a line along a side, a step apart. w, slip: NULL for zero. */
static void fill_line(enum mesh_side kind, bool normal, int64_t in, int n, int64_t step,
                      const double *w, const double *slip, double *q)
{
    if (kind == MESH_OUTFLOW || (kind == MESH_SLIP && !normal))
        for (int i = 0; i < n; i++)
            ghosts_mirrored(q + i * step, in, 1.0, 0.0);
    else
        for (int i = 0; i < n; i++) {
            const double v = (w ? w[i] : 0.0) + (slip ? slip[i] : 0.0);
            if (kind == MESH_SLIP)
                ghosts_mirrored(q + i * step, in, -1.0, v);
            else
                ghosts_given(q + i * step, in, v);
        }
}

/* One component along one side, near water. */
static void fill(const struct fv *s, int k, enum mesh_side kind, int q, const double *w,
                 const double *slip, double *u)
{
    const struct block *b = &s->b;
    const struct bc_side d = side_of(s->bc, b, k, true);
    for (int j = d.lo[1]; j < d.hi[1]; j++) {
        int ends[2] = {d.lo[0], d.hi[0]};
        if (d.a > 0) /* lines along x */
            part_clip(&s->whole, d.a == 1 ? d.first : j, d.a == 1 ? j : d.first, ends);
        const int64_t m = place(b, &d, ends[0], j);
        fill_line(kind, q == d.a, d.in, ends[1] - ends[0], b->stride[d.t[0]], w ? w + m : NULL,
                  slip ? slip + m : NULL, u + cell(b, &d, ends[0], j));
    }
}

/* What stands on a side: its velocity, or the change of it; NULL for zero. */
static const double *side_value(const struct bc *bc, int k, int q, enum bc_value what)
{
    if (what == BC_CHANGE)
        return bc->change[k][q];
    return what == BC_ZERO ? NULL : bc->w[k][q];
}

/* The axis that is filled at this turn. */
static int axis_of_turn(const struct bc *bc, int turn)
{
    int a = 0;
    while (bc->turn[a] != turn)
        a++;
    return a;
}

/* A change (BC_CHANGE) of given walls is 0 but for convective outflows and slip. */
void bc_ghosts(const struct fv *s, enum bc_value what, double *const u[3])
{
    const struct bc *bc = s->bc;
    for (int m = 0; bc && m < 6; m++) {
        const int k = 2 * axis_of_turn(bc, m / 2) + m % 2;
        for (int q = 0; q < s->b.dim && bc->n[k] > 0; q++)
            fill(s, k, bc->kind[k], q, side_value(bc, k, q, what),
                 what == BC_AHEAD || what == BC_CHANGE ? bc->slip[k][q] : NULL, u[q]);
    }
}

/* As `fill' of a difference, along a side whose places are given. */
static void fill_zero(const struct bc *bc, const struct block *b, int k, int q,
                      const struct bc_side *d, double *u)
{
    const enum mesh_side kind = bc->kind[k];
    SIDE_PLACES (b, *d, i, j, m, c) {
        (void)m;
        if (kind == MESH_OUTFLOW || (kind == MESH_SLIP && q != d->a))
            ghosts_mirrored(u + c, d->in, 1.0, 0.0);
        else if (kind == MESH_SLIP)
            ghosts_mirrored(u + c, d->in, -1.0, 0.0);
        else
            ghosts_given(u + c, d->in, 0.0);
    }
}

/* For the steps of viscous.c that go through slabs; rows of periodic axes copy their other end. */
void bc_slab_ghosts(const struct fv *s, int q, int j, double *u)
{
    const struct block *b = &s->b;
    const int last = b->dim - 1;
    for (int k = 0; k < 2 * last; k++) {
        const int a = k / 2;
        int n = b->n[a];
        if (s->bc && s->bc->n[k] > 0) {
            struct bc_side d = side_of(s->bc, b, k, false);
            const int m = d.t[0] == last ? 0 : 1;
            d.lo[m] = j;
            d.hi[m] = j + 1;
            fill_zero(s->bc, b, k, q, &d, u);
        } else if (b->periodic[a]) {
            const int64_t e = b->stride[a];
            const int t = 1 - a, rows = b->dim == 3 ? b->n[t] : 1;
            for (int i = 0; i < rows; i++) {
                int at[3] = {0, 0, 0};
                at[last] = j;
                at[t] = b->dim == 3 ? i : at[t];
                double *row = u + block_at(b, at[0], at[1], at[2]);
                for (int g = 1; g <= GHOSTS; g++)
                    if (k % 2)
                        row[(n - 1 + g) * e] = row[(g - 1) * e];
                    else
                        row[-g * e] = row[(n - g) * e];
            }
        }
    }
}

/* For the last axis alone: the others have their own rows. */
void bc_end_ghosts(const struct fv *s, int q, bool upper, double *u)
{
    const int k = 2 * (s->b.dim - 1) + upper;
    if (!s->bc || s->bc->n[k] == 0)
        return;
    const struct bc_side d = side_of(s->bc, &s->b, k, false);
    fill_zero(s->bc, &s->b, k, q, &d, u);
}

/* Sides that mirror the velocity along them mirror what the projection has made of it; it corrects
 * faces between cells alone, and a uniform stream would not stay so beside them. */
void bc_face_ghosts(const struct fv *s, double *const U[3])
{
    for (int k = 0; s->bc && k < 2 * s->b.dim; k++)
        for (int a = 0; a < s->b.dim && s->bc->n[k] > 0; a++) {
            const bool mirrors = s->bc->kind[k] == MESH_OUTFLOW || s->bc->kind[k] == MESH_SLIP;
            struct bc_side d = side_of(s->bc, &s->b, k, false);
            if (a == d.a || !mirrors)
                continue;
            d.hi[d.t[0] == a ? 0 : 1]++; /* the upper face */
            SIDE_PLACES (&s->b, d, i, j, m, c) {
                U[a][c - d.in] = U[a][c];
                (void)m;
            }
        }
}

/* U of the faces whose velocity is given; outflows keep what the projection makes. */
void bc_fluxes(const struct fv *s, enum bc_value what, double *const U[3])
{
    const struct block *b = &s->b;
    for (int k = 0; s->bc && k < 2 * b->dim; k++) {
        if (s->bc->n[k] == 0 || s->bc->kind[k] == MESH_OUTFLOW)
            continue;
        const struct bc_side d = side_of(s->bc, b, k, true);
        const int64_t face = k % 2 ? b->stride[d.a] : 0;
        const double *w = s->bc->w[k][d.a];
        SIDE_PLACES (b, d, i, j, m, c)
            U[d.a][c + face] = what == BC_ZERO ? 0.0 : w[m];
    }
}

/* Sides without an entry: periodic, or the exact velocity. */
enum mesh_side bc_kind(const struct fv *s, int k)
{
    const enum mesh_side kind = s->bc ? s->bc->kind[k] : MESH_NONE;
    if (kind != MESH_NONE)
        return kind;
    return s->b.periodic[k / 2] ? MESH_PERIODIC : MESH_EXACT;
}

/* Ghosts along tangents are left out: each real face once. */
void bc_visit(const struct fv *s, void (*visit)(const struct side_face *f, void *with), void *with)
{
    const struct block *b = &s->b;
    for (int k = 0; k < 2 * b->dim; k++) {
        if (!block_has_side(b, k))
            continue;
        const struct bc_side d = side_of(s->bc, b, k, false);
        struct side_face f = {.once = 1.0,
                              .kind = bc_kind(s, k),
                              .part = &s->whole,
                              .side = k,
                              .a = d.a,
                              .in = d.in,
                              .wall = s->bc ? s->bc->wall[k] : NULL};
        f.friction = f.wall ? f.wall->friction : 0.0;
        SIDE_PLACES (b, d, i, j, m, c) {
            f.cell = c;
            f.face = k % 2 ? c + b->stride[d.a] : c;
            f.flow_area = face_area(b, &d, i, j);
            visit(&f, with);
            (void)m;
        }
    }
}

/* v[0 .. 4]: five values of a line around `at', that of cell c; where a box begins they are
 * mirrored. */
static void line_beside_box(const struct fv *s, const double *at, int64_t c, int64_t d, double *v)
{
    const unsigned char *box = s->blocked->box + c;
    for (int m = -2; m <= 2; m++)
        v[2 + m] = at[m];
    for (int way = -1; way <= 1; way += 2)
        if (box[way * d]) {
            v[2 + way] = at[0];
            v[2 + 2 * way] = at[-way];
        } else if (box[2 * way * d]) {
            v[2 + 2 * way] = at[way];
        }
}

/* psi on the side, continued evenly: (7 psi_1 - psi_2)/6; its gradient along the side by fourth
 * order differences, again even at the ends. line: scratch of the length of a row with ghosts. m:
 * which tangent the row runs along; step: offset in slip from one place to the next. */
static void slip_row(const struct fv *s, const struct bc_side *d, int m, double tau,
                     const double *psi, int64_t c, double *line, double *slip, int64_t step)
{
    const struct block *b = &s->b;
    const int t = d->t[m], n = b->n[t], g = b->g[t];
    double *at = line + g;
    for (int i = -g; i < n + g; i++) {
        const double *q = psi + c + i * b->stride[t];
        at[i] = (7.0 * q[0] - q[d->in]) / 6.0;
    }
    for (int i = 0; i < g; i++) {
        if (block_has_side(b, 2 * t))
            at[-1 - i] = at[i];
        if (block_has_side(b, 2 * t + 1))
            at[n + i] = at[n - 1 - i];
    }
    const struct block line_of = {
        .stride = {1, 1, 1}, .h = {b->h[0], b->h[1], b->h[2]}, .rows = b->rows};
    for (int i = 0; i < n; i++)
        slip[i * step] = tau * block_derivative(&line_of, at + i, t, i);
    for (int i = 0; s->blocked && i < n; i++) {
        double v[5];
        line_beside_box(s, at + i, c + i * b->stride[t], b->stride[t], v);
        slip[i * step] = is_blocked(s, c + i * b->stride[t])
                             ? 0.0
                             : tau * block_derivative(&line_of, v + 2, t, i);
    }
}

/* Each tangent by itself; the component across the side is left at 0. */
void bc_set_slip(const struct fv *s, double tau, const double *psi)
{
    const struct block *b = &s->b;
    for (int k = 0; s->bc && k < 2 * b->dim; k++) {
        if (s->bc->n[k] == 0 || s->bc->kind[k] == MESH_SLIP || s->bc->kind[k] == MESH_OUTFLOW)
            continue;
        const struct bc_side d = side_of(s->bc, b, k, false);
        for (int m = 0; m < 2 && d.t[m] < b->dim; m++) {
            const int other = d.t[1 - m];
            double *line = NEW(double, b->n[d.t[m]] + 2 * b->g[d.t[m]]);
            for (int i = 0; i < b->n[other]; i++) {
                const int at[2] = {m == 0 ? 0 : i, m == 0 ? i : 0};
                slip_row(s, &d, m, tau, psi, cell(b, &d, at[0], at[1]), line,
                         s->bc->slip[k][d.t[m]] + place(b, &d, at[0], at[1]), m == 0 ? 1 : d.width);
            }
            mem_free(line);
        }
    }
}
