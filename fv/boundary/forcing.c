/* forcing.c - cells whose velocity is imposed, and fluxes through their interface. Made at the
 * start and whenever sph.box moves. `forced' says what each cell is, `layer' how far an imposed one
 * is from the free cells; lists of cells (local, set, partner) and of faces between free and
 * imposed cells (face[a]) serve everything else. In a stage: forcing_velocity imposes the values at
 * its time, forcing_fluxes those of the interface before the projection, corrected so that the
 * pressure equation has a solution (balance). In 2D and 3D, on uniform cells and blocks alike;
 * gradients beside imposed cells are those of forcing_fixes.c and given_cells.c.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "forcing.h"

#include "bc.h"
#include "blocked.h"
#include "fv_sides.h"
#include "mesh_bc.h"
#include "parted.h"

/* Visits all cells of all parts with their ghosts: at (int[3]) of part p has place c. */
#define ALL_CELLS(s, p, at, c)                                                                     \
    for (const struct part *p = (s)->grid.part; p < (s)->grid.part + (s)->grid.nparts; p++)        \
        PART_ALL (p, at, c)

/* Whether it is a cell of the part, not a ghost. */
static bool is_local(const struct part *p, const int *at)
{
    for (int a = 0; a < 3; a++)
        if (at[a] < 0 || at[a] >= p->n[a])
            return false;
    return true;
}

static double *new_field(const struct fv *s) { return NEW(double, s->size); }

/* What an even cell is with one box: 1 inside the box, 2 behind a closed side, 0 free. Of a
 * periodic axis the image counts that is not below the box. */
static unsigned char kind_of(const struct block *b, const int *at, const double (*box)[3])
{
    const double *const lo = box[0], *const hi = box[1];
    bool inside = true;
    for (int a = 0; a < b->dim; a++) {
        int i = b->lo[a] + at[a];
        if (!b->periodic[a] && (i < 0 || i >= b->cells[a]))
            return 2;
        i = ((i % b->cells[a]) + b->cells[a]) % b->cells[a];
        const double h = block_size(b, a, at[a]), eps = 1e-9 * h;
        double x = a == 1 && b->rows ? b->rows->y[at[1]] - 0.5 * h : b->origin[a] + i * h;
        if (b->periodic[a] && isfinite(lo[a])) /* the image that is not below the box */
            x += b->length[a] * ceil((lo[a] - eps - x) / b->length[a]);
        inside = inside && x >= lo[a] - eps && x + h <= hi[a] + eps;
    }
    return inside;
}

/* The same with n boxes: in any of them. */
static unsigned char kind_in(const struct block *b, const int *at, int n, const double (*box)[2][3])
{
    unsigned char kind = 0;
    for (int k = 0; k < n && kind == 0; k++)
        kind = kind_of(b, at, box[k]);
    return kind;
}

/* Fills `forced' for all cells and ghosts, and counts free cells over all ranks. Returns the number
 * of imposed cells, ghosts included, of all ranks. */
static int64_t count_kind(const struct fv *s, struct forcing *f, int n, const double (*box)[2][3])
{
    static const unsigned char kinds[] = {
        [CELL_COMPUTED] = 0, [CELL_FRINGE] = 0, [CELL_HOLE] = 4, [CELL_GIVEN] = 1};
    int64_t forced = 0, free_cells = 0;
    int at[3];
    ALL_CELLS (s, p, at, c) {
        f->forced[c] = s->m ? kinds[s->m->status[c]] : kind_in(&s->b, at, n, box);
        if (!s->m && f->forced[c] != 2 && is_blocked(s, c))
            f->forced[c] = 3;
        forced += f->forced[c] != 0 && f->forced[c] != 4;
        free_cells += !f->forced[c] && is_local(p, at);
    }
    MPI_Allreduce(&free_cells, &f->free_cells, 1, MPI_INT64_T, MPI_SUM, s->comm);
    return ranks_count(s->comm, forced);
}

/* Whether one of the up to 26 neighbours has this layer. */
static bool beside_layer(const struct part *p, const double *field, const int *at, double layer)
{
    int d[3];
    for (d[2] = -(p->g[2] > 0); d[2] <= (p->g[2] > 0); d[2]++)
        for (d[1] = -1; d[1] <= 1; d[1]++)
            for (d[0] = -1; d[0] <= 1; d[0]++) {
                bool there = true;
                for (int a = 0; a < 3; a++)
                    there = there && at[a] + d[a] >= -p->g[a] && at[a] + d[a] < p->n[a] + p->g[a];
                if (there && field[part_at(p, at[0] + d[0], at[1] + d[1], at[2] + d[2])] == layer)
                    return true;
            }
    return false;
}

/* Layers by spreading from the free cells over faces and corners; halo by way of a field. 99 marks
 * imposed cells not yet reached, 999 those that are no cells. */
static void find_layers(const struct fv *s, struct forcing *f)
{
    double *field = new_field(s), *const fields[1] = {field};
    int at[3];
    for (int64_t c = 0; c < s->size; c++)
        field[c] = f->forced[c] == 4 ? 999.0 : f->forced[c] ? 99.0 : 0.0;
    for (int layer = 1; layer <= f->near; layer++) {
        ALL_CELLS (s, p, at, c)
            if (field[c] == 99.0 && beside_layer(p, field, at, layer - 1.0))
                field[c] = layer;
        grid_halo(&s->grid, 1, fields);
    }
    for (int64_t c = 0; c < s->size; c++)
        f->layer[c] = field[c] < 99.0 ? (unsigned char)field[c] : 0;
    mem_free(field);
}

/* Whether the cell lies behind a wall or an opening, whose ghosts bc.c fills. */
static bool has_bc(const struct fv *s, const int *at)
{
    return bc_behind(s, at, 0) || bc_behind(s, at, 1) || bc_behind(s, at, 2);
}

/* Whether a free cell has a cell of the hole within two cells along an axis; on curved cells those
 * beside such lines count, too, for the products of fluxes read them. Partners give it values, for
 * fluxes alone. */
static bool is_rim(const struct fv *s, const struct part *p, const struct forcing *f, int64_t c)
{
    bool rim = false;
    for (int a = 0; a < f->dim; a++)
        for (int m = -2; m <= 2; m++) {
            rim = rim || f->forced[c + m * p->stride[a]] == 1;
            for (int t = 0; t < f->dim && s->m; t++)
                for (int e = -1; e <= 1; e += 2)
                    rim = rim || f->forced[c + m * p->stride[a] + e * p->stride[t]] == 1;
        }
    return rim && !f->forced[c];
}

/* A halo of a field of ones, so that ghosts are marked as well. */
static void mark_known(const struct fv *s, struct forcing *f)
{
    double *field = new_field(s), *const fields[1] = {field};
    for (int64_t i = 0; i < f->npartner + f->nrim; i++)
        field[f->partner[i]] = 1.0;
    grid_halo(&s->grid, 1, fields);
    f->known = NEW_IN(f, bool, s->size);
    for (int64_t c = 0; c < s->size; c++)
        f->known[c] = field[c] == 1.0;
    mem_free(field);
}

/* The free cells beside the interface come after the imposed ones, see struct forcing. */
static void list_partner(const struct fv *s, struct forcing *f)
{
    FLOW_ROWS_AT (s, part, j, at, n)
        for (int64_t c = at; c < at + n; c++)
            if (is_rim(s, part, f, c))
                f->partner[f->npartner + f->nrim++] = c;
    mark_known(s, f);
    for (int a = 0; a < f->dim; a++) {
        f->v[a] = NEW_IN(f, double, f->npartner + f->nrim);
        f->v_next[a] = NEW_IN(f, double, f->npartner + f->nrim);
        f->v_old[a] = NEW_IN(f, double, f->npartner + f->nrim);
        f->given[a] = mem_own(f, new_field(s));
    }
}

/* set: exact values, of cells near the free ones and of ghosts without a condition of their own;
 * partner: those of a partner. */
static void list_cells(const struct fv *s, struct forcing *f)
{
    int at[3];
    f->local = NEW_IN(f, int64_t, s->size);
    f->set = NEW_IN(f, int64_t, s->size);
    f->partner = NEW_IN(f, int64_t, s->size);
    ALL_CELLS (s, p, at, c) {
        if (!f->forced[c] || f->forced[c] == 4)
            continue;
        const bool local = is_local(p, at);
        if (local)
            f->local[f->nlocal++] = c;
        if (f->forced[c] == 1 && local && f->layer[c] && f->from_partner)
            f->partner[f->npartner++] = c;
        else if ((f->forced[c] == 1 && local && f->layer[c]) ||
                 (f->forced[c] == 2 && !has_bc(s, at))) {
            f->set[f->nset++] = c;
        }
    }
    if (f->from_partner)
        list_partner(s, f);
    f->imposed = f->nset > 0;
    MPI_Allreduce(MPI_IN_PLACE, &f->imposed, 1, MPI_C_BOOL, MPI_LOR, s->comm);
}

/* Whether the face between a free cell and one that is not is of the interface with imposed cells:
 * neither of a physical side nor of a box that is cut out. At an outflow it sets open to 2, since
 * psi is 0 on the face, half a cell away. */
static bool is_outline(const struct fv *s, struct forcing *f, const int *at, int a, int64_t c,
                       int64_t d)
{
    const bool here = f->forced[c] != 0;
    int outer[3] = {at[0], at[1], at[2]}; /* the forced cell */
    outer[a] -= here ? 0 : 1;
    if (s->m)
        return s->m->status[here ? c - d : c] == CELL_COMPUTED && f->forced[here ? c : c - d] == 1;
    const enum mesh_side kind = bc_behind(s, outer, a);
    if (kind == MESH_OUTFLOW) /* psi is 0 on the face, half a cell away */
        f->open[a][c] = 2.0;
    return !kind && f->forced[here ? c : c - d] != 3;
}

/* Faces between free and forced cells along axis a. sign is +1 where the imposed cell is above;
 * open is 1 between free cells, 0 elsewhere. */
static void list_faces(const struct fv *s, struct forcing *f, int a)
{
    int at[3];
    f->face[a] = NEW_IN(f, int64_t, s->size);
    f->sign[a] = NEW_IN(f, signed char, s->size);
    f->counts[a] = NEW_IN(f, bool, s->size);
    f->open[a] = s->m ? NULL : NEW_IN(f, double, s->size);
    ALL_CELLS (s, p, at, c) {
        const int64_t d = p->stride[a];
        if (at[a] == -p->g[a])
            continue;
        const bool here = f->forced[c] != 0, below = f->forced[c - d] != 0;
        if (f->open[a])
            f->open[a][c] = !here && !below;
        if (here == below || !is_outline(s, f, at, a, c, d))
            continue;
        int inner[3] = {at[0], at[1], at[2]}; /* the free cell */
        inner[a] -= here ? 1 : 0;
        f->face[a][f->nface[a]] = c;
        f->sign[a][f->nface[a]] = here ? 1 : -1;
        f->counts[a][f->nface[a]++] = is_local(p, inner);
    }
}

struct closed {
    const struct fv *s;
    const unsigned char *forced;
    double *sum;
};

/* Adds the vectors, inwards, of walls behind cells of the hole, deep ones too: nothing flows
 * there. */
static void add_closed(const struct side_face *f, void *with)
{
    const struct closed *x = with;
    double S[3];
    if (!side_is_wall(f->kind) || (x->forced[f->cell] != 1 && !grid_is_given(&x->s->grid, f->cell)))
        return;
    grid_face_vector(&x->s->grid, f->face, f->a, S);
    for (int e = 0; e < x->s->dim; e++)
        x->sum[e] += (f->side % 2 ? -1.0 : 1.0) * S[e];
}

/* Which faces take the net flux: by whether the vectors of the interface's faces sum to zero, with
 * those of the walls that close it or with those of the sides of blocks: it has a whole inside, or
 * the rest of the fluid has. 1e-9 of the sum of sizes is rounding. Collective. */
static enum net_flux net_of(const struct fv *s, const struct forcing *f)
{
    const bool open = sides_give_pressure(s);
    double sum[4] = {0.0}, sides[3] = {0.0};
    for (int a = 0; a < s->dim; a++)
        for (int64_t i = 0; i < f->nface[a]; i++)
            if (f->counts[a][i]) {
                double S[3];
                grid_face_vector(&s->grid, f->face[a][i], a, S);
                for (int e = 0; e < s->dim; e++) {
                    sum[e] += f->sign[a][i] * S[e];
                    sum[3] += fabs(S[e]);
                }
            }
    double whole[3] = {sum[0], sum[1], sum[2]};
    sides_visit(s, add_closed, &(struct closed){s, f->forced, whole});
    MPI_Allreduce(MPI_IN_PLACE, sum, 4, MPI_DOUBLE, MPI_SUM, s->comm);
    MPI_Allreduce(MPI_IN_PLACE, whole, 3, MPI_DOUBLE, MPI_SUM, s->comm);
    if (s->m)
        mesh_bc_vectors(s, sides);
    const double small = 1e-9 * sum[3], *to = sides;
    const bool closed = hypot(hypot(whole[0], whole[1]), whole[2]) <= small;
    if (closed && (open || grid_overlaps(&s->grid)))
        return NET_INTERFACE;
    const bool closes =
        !s->m || hypot(hypot(sum[0] + to[0], sum[1] + to[1]), sum[2] + to[2]) <= small;
    return closes && !open ? NET_SIDES : NET_OTHERS;
}

/* On blocks what cells are comes from the mesh's status, on uniform cells from the boxes. */
struct forcing *forcing_create(const struct fv *s, int n, const double (*box)[2][3], bool partner)
{
    struct forcing *f = NEW(struct forcing, 1);
    f->dim = s->dim;
    f->from_partner = partner;
    f->whole = partner && s->surface;
    f->near = NEAR + (partner && s->partners.past[0][0] ? AHEAD : 0);
    f->forced = NEW_IN(f, unsigned char, s->size);
    f->layer = NEW_IN(f, unsigned char, s->size);
    if (count_kind(s, f, n, box) == 0) {
        FREE(f);
        return NULL;
    }
    find_layers(s, f);
    list_cells(s, f);
    for (int a = 0; a < f->dim; a++) {
        list_faces(s, f, a);
        if (!s->m)
            forcing_list_fixes(s, f, a);
    }
    f->net = net_of(s, f);
    f->parted = partner ? mem_own(f, parted_create(s, f->forced)) : NULL;
    if (s->m)
        given_rows_create(s, f);
    return f;
}

void forcing_zero(const struct forcing *f, double *q)
{
    for (int64_t i = 0; i < f->nlocal; i++)
        q[f->local[i]] = 0.0;
}

/* Partner's velocity at t: a parabola through the ends of the coupling step and of the one before,
 * as soon as there was one. */
static double partner_value(const struct forcing *f, int a, int64_t i, double t)
{
    const double T = f->t1 - f->t0, x = T > 0.0 ? (t - f->t0) / T : 0.0;
    const double linear = f->v[a][i] + x * (f->v_next[a][i] - f->v[a][i]);
    if (f->levels < 3)
        return linear;
    const double y = (f->t0 - f->t_old) / T; /* 1 for even windows */
    const double second =
        ((f->v_next[a][i] - f->v[a][i]) - (f->v[a][i] - f->v_old[a][i]) / y) / (1.0 + y);
    return linear + x * (x - 1.0) * second;
}

/* With differences d0, d1 over the last two steps the new v_next is v + T (d0 + (T + h) bend), bend
 * = (d0 - d1)/(h + g): Newton's form of the parabola. Arrays take turns. */
void forcing_shift(struct forcing *f, double t0, double t1)
{
    const double h = t0 - f->t0, g = f->t0 - f->t_old, T = t1 - t0;
    for (int a = 0; a < f->dim; a++) {
        double *oldest = f->v_old[a], *v = f->v_next[a], *old = f->v[a];
        for (int64_t i = 0; i < f->npartner + f->nrim; i++) {
            const double d0 = f->levels > 1 ? (v[i] - old[i]) / h : 0.0;
            const double d1 = f->levels > 2 ? (old[i] - oldest[i]) / g : d0;
            const double bend = f->levels > 2 ? (d0 - d1) / (h + g) : 0.0;
            oldest[i] = v[i] + T * (d0 + (T + h) * bend);
        }
        f->v_old[a] = old;
        f->v[a] = v;
        f->v_next[a] = oldest;
    }
    f->t_old = f->t0;
    f->t0 = t0;
    f->t1 = t1;
    f->levels = f->levels < 3 ? f->levels + 1 : 3;
}

/* One round: listed cells without a value take the mean of their neighbours that have one.
 * Neighbours over faces only; next[] says who has a value afterwards. */
static void fill_round(const struct fv *s, const double *has, double *next)
{
    const struct forcing *f = s->forcing;
    memcpy(next, has, (size_t)s->size * sizeof *next);
    for (int64_t i = 0; i < f->npartner + f->nrim; i++) {
        const int64_t c = f->partner[i], *stride = grid_part(&s->grid, c, (int[3]){0})->stride;
        double sum[3] = {0.0, 0.0, 0.0}, n = 0.0;
        for (int way = 0; way < 2 * f->dim && has[c] == 0.0; way++) {
            const int64_t d = c + (way % 2 ? 1 : -1) * stride[way / 2];
            if (has[d] == 0.0)
                continue;
            n += 1.0;
            for (int a = 0; a < f->dim; a++)
                sum[a] += f->given[a][d];
        }
        for (int a = 0; a < f->dim && n > 0.0; a++)
            f->given[a][c] = sum[a] / n;
        next[c] = has[c] > 0.0 || n > 0.0 ? 1.0 : 0.0;
    }
}

/* As many rounds as there are layers of cells; each needs a halo, since chains cross ranks. */
void forcing_fill(const struct fv *s, const unsigned char *mask)
{
    const struct forcing *f = s->forcing;
    double *has = new_field(s), *next = new_field(s);
    for (int64_t i = 0; i < f->npartner + f->nrim; i++) {
        has[f->partner[i]] = mask[i];
        for (int a = 0; a < f->dim; a++)
            f->given[a][f->partner[i]] = mask[i] ? f->v_next[a][i] : 0.0;
    }
    for (int round = 0; round < f->near; round++) {
        double *spare = has;
        grid_halo(&s->grid, 1, (double *const[]){has});
        grid_halo(&s->grid, f->dim, f->given);
        fill_round(s, has, next);
        has = next;
        next = spare;
    }
    for (int a = 0; a < f->dim; a++)
        for (int64_t i = 0; i < f->npartner + f->nrim; i++)
            f->v_next[a][i] = f->given[a][f->partner[i]];
    FREE(has, next);
}

/* By the exact field, or between the partner's times. What lies deeper in the hole is nobody's:
 * left to the operators it gathered speed beside walls until the run ended. With a free surface the
 * velocity is extended into it. */
void forcing_velocity(const struct fv *s, double t, double *const u[3])
{
    const struct forcing *f = s->forcing;
    double v[3];
    for (int64_t i = 0; i < f->nset; i++) {
        forcing_average(s, f->set[i], t, v, NULL);
        for (int a = 0; a < f->dim; a++)
            u[a][f->set[i]] = v[a];
    }
    for (int a = 0; a < f->dim; a++)
        for (int64_t i = 0; i < f->npartner; i++)
            u[a][f->partner[i]] = partner_value(f, a, i, t);
    for (int64_t i = 0; i < f->nlocal && !s->surface; i++)
        if (f->forced[f->local[i]] == 1 && !f->layer[f->local[i]])
            for (int a = 0; a < f->dim; a++)
                u[a][f->local[i]] = 0.0;
}

/* So that u + delta is what is imposed. */
void forcing_subtract(const struct forcing *f, double *const u[3], double *const delta[3])
{
    for (int a = 0; a < f->dim; a++) {
        for (int64_t i = 0; i < f->nset; i++)
            delta[a][f->set[i]] -= u[a][f->set[i]];
        for (int64_t i = 0; i < f->npartner; i++)
            delta[a][f->partner[i]] -= u[a][f->partner[i]];
    }
}

/* Average of the exact velocity over the lower face along a of c, times the area on blocks. */
static double exact_flux(const struct fv *s, int64_t c, int a, double t)
{
    double x[3], h[3], v[3];
    int at[3];
    if (s->m)
        return given_exact_flux(s, c, a, t);
    block_place(&s->b, c, at);
    block_cell(&s->b, at[0], at[1], at[2], x, h);
    x[a] -= 0.5 * h[a];
    exact_face(&s->exact, x, h, a, t, v);
    return v[a];
}

/* Whether the flux of a face comes from the exact solution. */
static bool is_exact(const struct forcing *f, int64_t c, int64_t d)
{
    return f->forced[c] == 2 || f->forced[c - d] == 2 || !f->from_partner;
}

/* Sets given[] to a partner's values at t, in the cells two deep on both sides of the interface. */
static void look_at_partner(const struct fv *s, double t)
{
    const struct forcing *f = s->forcing;
    for (int a = 0; a < f->dim; a++)
        for (int64_t i = 0; i < f->npartner + f->nrim; i++)
            f->given[a][f->partner[i]] = partner_value(f, a, i, t);
    grid_halo(&s->grid, f->dim, f->given);
}

/* Whether the flux through the lower face of c is a partner's alone. */
static bool is_partners(const struct forcing *f, int64_t c, int64_t d)
{
    return f->from_partner && f->known[c - 2 * d] && f->known[c - d] && f->known[c] &&
           f->known[c + d];
}

/* Face value of averages, fourth order. */
static double partner_flux(const double *u, int64_t d)
{
    return (7.0 * (u[-d] + u[0]) - (u[-2 * d] + u[d])) / 12.0;
}

/* Takes `excess' m/s outwards off U of a face of the interface. */
static void take_off(const struct fv *s, int a, int64_t i, double excess, double *U)
{
    const struct forcing *f = s->forcing;
    const int64_t c = f->face[a][i];
    U[c] -=
        f->sign[a][i] * excess * (grid_face_area(&s->grid, c, a) / grid_flow_area(&s->grid, c, a));
}

/* The part that the computed cell beside a face of the interface lies in; 0 where there are
 * none. */
static int face_part(const struct fv *s, int a, int64_t i)
{
    const struct forcing *f = s->forcing;
    const int64_t c = f->face[a][i];
    if (!f->parted)
        return 0;
    return f->parted->of[f->sign[a][i] > 0 ? c - grid_part(&s->grid, c, NULL)->stride[a] : c];
}

/* Net flux of the interface's faces of each part outwards, m^dim/s, and their area; of this
 * rank. */
static void sum_outline(const struct fv *s, double *const U[3], double sums[2][PARTS_MAX])
{
    const struct forcing *f = s->forcing;
    memset(sums, 0, 2 * sizeof *sums);
    for (int a = 0; a < f->dim; a++)
        for (int64_t i = 0; i < f->nface[a]; i++)
            if (f->counts[a][i]) {
                const int64_t c = f->face[a][i];
                const int k = face_part(s, a, i);
                sums[0][k] += f->sign[a][i] * U[a][c] * grid_flow_area(&s->grid, c, a);
                sums[1][k] += grid_face_area(&s->grid, c, a);
            }
}

/* Takes the excess of each part, m/s outwards, off U of its faces. */
static void take_off_all(const struct fv *s, const double *excess, double *const U[3])
{
    const struct forcing *f = s->forcing;
    for (int a = 0; a < f->dim; a++)
        for (int64_t i = 0; i < f->nface[a]; i++)
            take_off(s, a, i, excess[face_part(s, a, i)], U[a]);
}

/* What flows out of a floating part through its sides flows in through its interface with the
 * partners; the other parts take what is then left of the interface's net flux, for the partners'
 * density is constant in the mean. */
static void balance_parts(const struct fv *s, double *const U[3])
{
    const struct parted *p = s->forcing->parted;
    double net[PARTS_MAX], sums[2][PARTS_MAX], excess[PARTS_MAX], left[2] = {0.0};
    parted_net_fluxes(p, s, U, net);
    sum_outline(s, U, sums);
    MPI_Allreduce(MPI_IN_PLACE, sums, 2 * PARTS_MAX, MPI_DOUBLE, MPI_SUM, s->comm);
    for (int k = 0; k < p->n; k++) {
        excess[k] = p->floats[k] && sums[1][k] > 0.0 ? net[k] / sums[1][k] : 0.0;
        left[0] += sums[0][k] - excess[k] * sums[1][k];
        left[1] += p->floats[k] ? 0.0 : sums[1][k];
    }
    for (int k = 0; k < p->n; k++)
        if (!p->floats[k] && left[1] > 0.0)
            excess[k] = left[0] / left[1];
    take_off_all(s, excess, U);
}

/* Makes the net flux through the interface what the rest of the fluid leaves, by one velocity added
 * to all its faces; not where a surface or an outflow takes the difference. sides: theirs counts.
 * Collective. */
static void balance(const struct fv *s, bool sides, double *const U[3])
{
    const struct forcing *f = s->forcing;
    double of[2][PARTS_MAX];
    if (f->parted) {
        balance_parts(s, U);
        return;
    }
    if (s->surface || f->net == NET_OTHERS)
        return;
    sides = sides && f->net == NET_SIDES;
    sum_outline(s, U, of);
    double sums[2] = {of[0][0], of[1][0]};
    if (s->bc && sides)
        sums[0] += s->bc->outflux;
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, s->comm);
    if (s->m && sides)
        sums[0] += mesh_bc_net_flux(s);
    const double excess = sums[1] > 0.0 ? sums[0] / sums[1] : 0.0;
    take_off_all(s, &excess, U);
}

/* Whether the flux through the lower face of c is a partner's alone, and what it is. */
static bool partners_flux(const struct fv *s, int64_t c, int a, int64_t d, double *U)
{
    const struct forcing *f = s->forcing;
    if (!is_partners(f, c, d))
        return false;
    *U = s->m ? given_flux_of(s, f->given, c, a) : partner_flux(f->given[a] + c, d);
    return true;
}

/* Faces neither exact nor a partner's keep what was interpolated. */
void forcing_fluxes(const struct fv *s, double t, double *const U[3])
{
    const struct forcing *f = s->forcing;
    if (f->from_partner)
        look_at_partner(s, t);
    for (int a = 0; a < f->dim; a++)
        for (int64_t i = 0; i < f->nface[a]; i++) {
            const int64_t c = f->face[a][i], d = grid_part(&s->grid, c, NULL)->stride[a];
            if (is_exact(f, c, d))
                U[a][c] = exact_flux(s, c, a, t);
            else
                partners_flux(s, c, a, d, U[a] + c);
            if (f->inflow != 0.0 && (f->forced[c] == 1 || f->forced[c - d] == 1))
                take_off(s, a, i, f->inflow, U[a]);
        }
    balance(s, true, U);
}

/* 0 where the flux is imposed; a partner's interface is balanced as before. */
void forcing_fluxes_variation(const struct fv *s, double *const U[3])
{
    const struct forcing *f = s->forcing;
    for (int a = 0; a < f->dim; a++)
        for (int64_t i = 0; i < f->nface[a]; i++) {
            const int64_t c = f->face[a][i], d = grid_part(&s->grid, c, NULL)->stride[a];
            if (is_exact(f, c, d) || is_partners(f, c, d))
                U[a][c] = 0.0;
        }
    if (f->from_partner)
        balance(s, false, U);
}
