/* fraction.c - advection of the share of water in sweeps along the axes (Weymouth & Yue, J. Comput.
 * Phys. 229, 2010): the water in the slab of the donor that crosses the face, below the plane in
 * it; C += (F_a - F_a+1 + solved (V_a+1 - V_a))/volume with V the volumes that cross the faces.
 * Over all axes the last term is 0 as far as the projection went; within a sweep it keeps full
 * cells full. SPDX-License-Identifier: BSD-3-Clause */
#include "fraction.h"

#include "../boundary/fv_boundary.h"
#include "mesh_view.h"
#include "plane.h"

/* Some part of any rank has cells that are not upright. Collective. */
static bool any_curved(const struct mesh *m)
{
    bool curved = false;
    for (int q = 0; q < m->nparts; q++)
        curved = curved || m->part[q].kind == PART_CURVED;
    return ranks_any(m->comm, curved);
}

/* Gives block k, and those joined to it, the axes of its cells that the sweeps along axes `as' go
 * along; false: those that meet round a corner want different ones. */
static bool order_from(const struct mesh *m, int k, const int as[3], struct sweep_axes *to)
{
    bool fits = true;
    for (int a = 0; a < 3; a++) {
        fits = fits && (!to->known[k] || to->axis[a][k] == as[a]);
        to->axis[a][k] = as[a];
    }
    if (to->known[k])
        return fits;
    to->known[k] = true;
    for (int side = 0; side < 2 * m->dim; side++) {
        const struct mesh_join *j = m->block[k].join + side;
        int theirs[3];
        for (int a = 0; a < 3 && j->block >= 0; a++)
            theirs[a] = j->axis[as[a]];
        if (j->block >= 0 && !order_from(m, j->block, theirs, to))
            return false;
    }
    return true;
}

/* Blocks whose indices run different ways are swept at the same time along the lines of cells that
 * meet: their common faces have one flux. */
static bool order_axes(const struct mesh *m, struct sweep_axes *to)
{
    static const int as[3] = {0, 1, 2};
    memset(to, 0, sizeof *to);
    for (int k = 0; k < (m ? m->nblocks : 0); k++)
        if (!to->known[k] && !order_from(m, k, as, to))
            return false;
    for (int a = 0; a < 3 && !m; a++)
        to->axis[a][0] = a;
    return true;
}

/* Why a scene cannot have shares, for the log; NULL: it can. m: blocks, NULL: uniform cells; least:
 * smallest size of a cell, m. Creeping water breaks nothing off, and what the shares make rough in
 * phi grows at steps of its viscosity. Collective. */
static const char *obstacle(const struct run *r, const struct mesh *m, double least)
{
    const struct gravity split = still_split(&r->scene);
    const double *still = split.hydrostatic;
    if (r->crossed)
        return "a partner has part of the water";
    if (m && m->has_fringe)
        return "blocks overlap";
    struct sweep_axes axes;
    if (!order_axes(m, &axes))
        return "lines of cells change their axes round a corner where three or five blocks meet";
    const bool falls = still[0] != 0.0 || still[1] != 0.0 || still[2] != 0.0;
    if (falls && still_creep(still, r->scene.fluid.nu, least) > STILL_CREEPS)
        return "the water creeps: nu/(h sqrt(g h)) is above 10";
    return NULL;
}

void fraction_describe(const struct run *r, const struct fv_params *prm, const struct mesh *m,
                       double least)
{
    const char *why = prm->volume == VOLUME_SHIFT ? "fv.volume says so" : obstacle(r, m, least);
    if (!why)
        log_say("water is kept where it is: the fluxes carry the share of it in each cell");
    else if (prm->volume == VOLUME_FRACTION)
        log_warn("fv.volume: fraction is not to be had, shift is used: %s", why);
    else
        log_say("water is kept as a whole: a shift of the level set puts back what is lost (%s)",
                why);
}

bool fraction_wanted(const struct fv *s)
{
    return s->prm.volume != VOLUME_SHIFT && !obstacle(s->run, s->m, s->surface->least);
}

/* Of the cells of a curved part, whose spacing is that of its middle; the tensor K of mesh_view.h
 * is that of cells alone. */
static void measure_curved(const struct fv *s, struct fraction *f, const struct part *p)
{
    const double *size = s->surface->mesh->size[p - s->grid.part];
    PART_ROWS (p, no_layers, no_layers, c, n)
        for (int64_t i = c; i < c + n; i++) {
            double K[3][3];
            surface_mesh_metric(s, i, K);
            for (int a = 0; a < s->dim; a++) {
                f->height[a][i] = size[a] / sqrt(K[a][a]);
                for (int b = a + 1; b < s->dim; b++)
                    f->cosine[a][b][i] = K[a][b] / sqrt(K[a][a] * K[b][b]);
            }
        }
}

/* Spacing and angles of the cells of blocks. Collective. */
static void measure_cells(const struct fv *s, struct fraction *f)
{
    double *fields[6];
    int nf = 0;
    for (int a = 0; a < s->dim; a++) {
        fields[nf++] = f->height[a] = NEW_IN(f, double, s->size);
        for (int64_t c = 0; c < s->size; c++)
            f->height[a][c] = grid_height(&s->grid, c, a);
    }
    if (!any_curved(s->m))
        return;
    for (int a = 0; a < s->dim; a++)
        for (int b = a + 1; b < s->dim; b++)
            fields[nf++] = f->cosine[a][b] = NEW_IN(f, double, s->size);
    for (const struct part *p = s->grid.part; p < s->grid.part + s->grid.nparts; p++)
        if (p->kind == PART_CURVED)
            measure_curved(s, f, p);
    grid_halo(&s->grid, nf, fields);
}

/* Fields that stay for the run; C is set by fraction_take, the layers by fraction_note_layers. */
static struct fraction *create(const struct fv *s)
{
    struct fraction *f = NEW(struct fraction, 1);
    double **const fields[] = {&f->C,    &f->layer, &f->alpha, &f->volume,
                               &f->flux, &f->work,  &f->next};
    for (size_t k = 0; k < sizeof fields / sizeof fields[0]; k++)
        *fields[k] = NEW_IN(f, double, s->size);
    for (int a = 0; a < s->dim; a++) {
        f->n[a] = NEW_IN(f, double, s->size);
        f->flow[a] = NEW_IN(f, double, s->size);
    }
    f->smooth = NEW_IN(f, unsigned char, s->size);
    for (int64_t c = 0; c < s->size; c++)
        f->volume[c] = grid_volume(&s->grid, c);
    for (int a = 0; a < s->dim && !s->m; a++) {
        f->area[a] = NEW_IN(f, double, s->size);
        for (int64_t c = 0; c < s->size; c++)
            f->area[a][c] = f->volume[c] / grid_height(&s->grid, c, a);
    }
    if (s->m)
        measure_cells(s, f);
    return f;
}

/* The shares that phi says: at the start, and when shares take over from phi. */
void fraction_take(const struct fv *s)
{
    struct fraction *f = s->surface->fraction;
    FLOW_NEAR (s, c, n)
        for (int64_t i = c; i < c + n; i++)
            f->C[i] = surface_holds_none(s, i) ? 0.0 : surface_share(s, i);
    surface_mirror(s, f->C);
}

/* Sweeps begin along gravity, so that a scene that is turned flows alike. */
static int first_axis(const struct fv *s)
{
    int first = 0;
    for (int a = 1; a < s->dim; a++)
        if (fabs(s->gravity.hydrostatic[a]) > fabs(s->gravity.hydrostatic[first]))
            first = a;
    return first;
}

/* Collective, once: whether normals have to look round solids at all. */
static bool has_boxes(const struct fv *s)
{
    bool any = false;
    FLOW_NEAR (s, c, n)
        for (int64_t i = c; i < c + n; i++)
            any = any || surface_holds_none(s, i);
    return ranks_any(s->comm, any);
}

void fraction_start(struct fv *s)
{
    s->surface->fraction = mem_own(s->surface, create(s));
    for (int a = 0; a < s->dim && !s->moving && probe_any(&s->run->scene, PROBE_DISCHARGE); a++)
        s->surface->fraction->passed[a] = NEW_IN(s->surface->fraction, double, s->size);
    s->surface->fraction->was_read = 1.0;
    s->surface->fraction->boxes = has_boxes(s);
    s->surface->fraction->first = first_axis(s);
    order_axes(s->m, &s->surface->fraction->axes);
    fraction_take(s);
}

/* Before the surface moves: flows of a step belong to the layers that the projection had. */
void fraction_note_layers(const struct fv *s)
{
    const struct surface *f = s->surface;
    for (const struct part *p = s->grid.part; p < s->grid.part + s->grid.nparts; p++)
        PART_NEAR (p, p->g, p->g, c, n)
            for (int64_t i = c; i < c + n; i++)
                f->fraction->layer[i] = f->layer[i];
    f->fraction->has_flows = false;
}

void fraction_forget_flows(const struct fv *s)
{
    if (s->surface && s->surface->fraction)
        s->surface->fraction->has_flows = false;
}

double fraction_volume(const struct fv *s)
{
    const struct fraction *f = s->surface->fraction;
    double sum = 0.0;
    FLOW_NEAR (s, c, n)
        for (int64_t i = c; i < c + n; i++)
            sum += f->C[i] * f->volume[i];
    return ranks_sum(s->comm, sum);
}

/* -: what counts as water of a cell, by whichever of the two carries it now. */
double surface_water(const struct fv *s, int64_t c)
{
    const struct fraction *f = s->surface->fraction;
    return f && f->carries > 0.0 ? f->C[c] : surface_share(s, c);
}

double surface_volume(const struct fv *s)
{
    const struct fraction *f = s->surface->fraction;
    return f && f->carries > 0.0 ? fraction_volume(s) : surface_level_volume(s, NULL);
}

/* --- rows in short pieces: those that are all water or all air are passed over --- */

enum { PIECE = 16 };

static int64_t piece(int64_t i, int64_t n) { return n - i < PIECE ? n - i : PIECE; }

/* More than full, beyond rounding: what the cells around have no room for. */
#define OVERFULL (1.0 + 1e-9)

/* Whether some cell of a row and the cell a step d below are not the same, all water or all air. */
static bool any_mixed(const double *C, int64_t d, int64_t n)
{
    int odd = 0;
    for (int64_t i = 0; i < n; i++)
        odd |= (C[i] != C[i - d]) | ((C[i] > 0.0) & ((C[i] < 1.0) | (C[i] > OVERFULL)));
    return odd;
}

/* --- planes --- */

/* Of cell c + d + t: where that is within a box, of the one that mirrors it, which is on this side
 * along d, or t, or both. */
static double seen_from(const struct fv *s, int64_t c, int64_t d, int64_t t)
{
    const double *C = s->surface->fraction->C;
    if (!surface_holds_none(s, c + d + t))
        return C[c + d + t];
    if (!surface_holds_none(s, c + t))
        return C[c + t];
    return surface_holds_none(s, c + d) ? C[c] : C[c + d];
}

/* Sum over the 3^(dim-1) cells beside c + d of C, weights 1, 2, 1 along each tangent. Ghosts behind
 * sides mirror, boxes do not. */
static double beside(const struct fv *s, const struct part *p, int64_t c, int a, int64_t d)
{
    const double *C = s->surface->fraction->C;
    const bool boxes = s->surface->fraction->boxes;
    const int t0 = a == 0 ? 1 : 0, t1 = s->dim == 3 ? (a == 2 ? 1 : 2) : -1;
    double sum = 0.0;
    for (int k = t1 < 0 ? 0 : -1; k <= (t1 < 0 ? 0 : 1); k++)
        for (int j = -1; j <= 1; j++) {
            const int64_t t = j * p->stride[t0] + (t1 < 0 ? 0 : k * p->stride[t1]);
            const double weight = (j ? 1.0 : 2.0) * (t1 >= 0 && k ? 1.0 : 2.0);
            sum += weight * (boxes ? seen_from(s, c, d, t) : C[c + d + t]);
        }
    return sum / 8.0 / (t1 < 0 ? 1.0 : 2.0);
}

/* What lies above cell c less what lies below, along each axis: `beside' on either side. */
static void differences(const struct fv *s, const struct part *p, int64_t c, double *across)
{
    const double *C = s->surface->fraction->C + c;
    const int64_t sy = p->stride[1], sz = s->dim == 3 ? p->stride[2] : 0;
    double line[3][3], slope[3][3]; /* along x, of the lines around: sums 1, 2, 1, differences */
    for (int a = 0; a < s->dim && s->surface->fraction->boxes; a++)
        across[a] = beside(s, p, c, a, p->stride[a]) - beside(s, p, c, a, -p->stride[a]);
    if (s->surface->fraction->boxes)
        return;
    for (int k = 0; k < (sz ? 3 : 1); k++)
        for (int j = 0; j < 3; j++) {
            const double *q = C + (j - 1) * sy + (k - 1) * sz;
            line[k][j] = 2.0 * q[0] + (q[-1] + q[1]);
            slope[k][j] = q[1] - q[-1];
        }
    if (!sz) {
        across[0] = (2.0 * slope[0][1] + (slope[0][0] + slope[0][2])) / 4.0;
        across[1] = (line[0][2] - line[0][0]) / 4.0;
        return;
    }
    double along[3], beyond[3], up[3]; /* of the layers of lines */
    for (int k = 0; k < 3; k++) {
        along[k] = 2.0 * slope[k][1] + (slope[k][0] + slope[k][2]);
        beyond[k] = line[k][2] - line[k][0];
        up[k] = 2.0 * line[k][1] + (line[k][0] + line[k][2]);
    }
    across[0] = (2.0 * along[1] + (along[0] + along[2])) / 16.0;
    across[1] = (2.0 * beyond[1] + (beyond[0] + beyond[2])) / 16.0;
    across[2] = (up[2] - up[0]) / 16.0;
}

bool fraction_normal(const struct fv *s, const struct part *p, int64_t c, double *n)
{
    double sum = 0.0, across[3];
    differences(s, p, c, across);
    for (int a = 0; a < s->dim; a++) {
        const int64_t d = p->stride[a];
        const double h = fraction_height(s, c, a),
                     over = 0.5 * (fraction_height(s, c - d, a) + fraction_height(s, c + d, a)) + h;
        n[a] = -across[a] * h / over;
        sum += fabs(n[a]);
    }
    return sum > 1e-12;
}

/* Of the level over cell c, as differences per cell. */
static void lie_level(const struct fv *s, int64_t c, double *n)
{
    for (int a = 0; a < s->dim; a++) {
        double S[3] = {0.0, 0.0, 0.0};
        grid_face_vector(&s->grid, c, a, S);
        n[a] = s->surface->g > 0.0 ? -vec3_dot(S, s->gravity.hydrostatic) : a == s->dim - 1;
        n[a] *= fraction_height(s, c, a) / vec3_length(S);
    }
}

static void set_plane(const struct fv *s, const struct part *p, int64_t c)
{
    struct fraction *f = s->surface->fraction;
    double n[3] = {0.0, 0.0, 0.0};
    if (!fraction_normal(s, p, c, n))
        lie_level(s, c, n);
    for (int a = 0; a < s->dim; a++)
        f->n[a][c] = n[a];
    f->alpha[c] = plane_alpha(s->dim, n, f->C[c]);
}

/* Behind a joined side normals come in the neighbour's axes. */
static void turn_normals(const struct fv *s, const struct part *p, int side)
{
    const struct mesh_block *b = s->m->block + p->block;
    const struct mesh_join *j = b->join + side;
    const int a = side / 2;
    int down[3] = {0, 0, 0}, up[3] = {0, 0, 0};
    if (j->block < 0 || (side % 2 ? p->lo[a] + p->n[a] < b->n[a] : p->lo[a] > 0))
        return;
    down[a] = side % 2 ? -p->n[a] : 1;
    up[a] = side % 2 ? 1 : -p->n[a];
    PART_ROWS (p, down, up, c, len)
        for (int64_t i = c; i < c + len; i++) {
            double *const *n = s->surface->fraction->n;
            const double theirs[3] = {n[0][i], n[1][i], n[2] ? n[2][i] : 0.0};
            for (int k = 0; k < s->dim; k++)
                n[k][i] = j->sign[k] * theirs[j->axis[k]];
        }
}

/* Planes of the mixed cells, with ghosts. Once a sweep, of the cells as the sweep finds them. */
static void find_planes(struct fv *s)
{
    struct fraction *f = s->surface->fraction;
    FLOW_NEAR_AT (s, part, j, c, len)
        for (int64_t from = 0; from < len; from += PIECE) {
            const int64_t n = piece(from, len);
            if (!any_mixed(f->C + c + from, 0, n))
                continue;
            for (int64_t i = c + from; i < c + from + n; i++)
                if (fraction_is_mixed(f->C[i]))
                    set_plane(s, part, i);
        }
    double *fields[4] = {f->alpha, f->n[0], f->n[1], f->n[2]};
    grid_fill(&s->grid, 1 + s->dim, fields);
    for (const struct part *p = s->grid.part; s->m && p < s->grid.part + s->grid.nparts; p++)
        for (int side = 0; side < 2 * s->dim; side++)
            turn_normals(s, p, side);
}

/* --- fluxes --- */

/* The axis of a part's cells in the sweep along a. */
static int axis_of(const struct fv *s, const struct part *p, int a)
{
    return s->surface->fraction->axes.axis[a][p->block];
}

/* Share of a cell that is water and lies between two places of it along axis a, -1/2 to 1/2. */
static double plane_in(const struct fv *s, int64_t c, int a, double lo, double hi)
{
    const struct fraction *f = s->surface->fraction;
    const double n[3] = {f->n[0][c], f->n[1][c], s->dim == 3 ? f->n[2][c] : 0.0};
    return plane_slab(s->dim, n, f->alpha[c], a, lo, hi);
}

/* Of the cell that the volume v (m^dim, up if > 0) through the lower face of c comes from: water in
 * it. From behind a side it is as deep as it stands on this side of it, and no more than full: what
 * a cell at an inflow has too much would feed itself. */
static double water_across(const struct fv *s, int64_t c, int64_t d, int a, double v)
{
    const struct fraction *f = s->surface->fraction;
    const int64_t from = v > 0.0 ? c - d : c, to = v > 0.0 ? c : c - d;
    if (is_blocked(s, to)) /* air comes in there (vents.c), no water leaves */
        return 0.0;
    const double C = f->C[from], part = lesser(1.0, fabs(v) / f->volume[from]);
    if (!fraction_is_mixed(C))
        return v * (surface_holds_none(s, from) ? lesser(1.0, C) : C);
    if (surface_holds_none(s, from)) {
        const int64_t in = v > 0.0 ? c : c - d;
        if (carried_held(s, in, in - from) >= 0.0)
            return v * C;
        const double e = 1e-6, lo = v > 0.0 ? -0.5 : 0.5 - e;
        return v * plane_in(s, in, a, lo, lo + e) / e;
    }
    const double share =
        v > 0.0 ? plane_in(s, from, a, 0.5 - part, 0.5) : plane_in(s, from, a, -0.5, part - 0.5);
    const double kept = lesser(C, greater(part - (1.0 - C), share));
    return (v > 0.0 ? kept : -kept) * f->volume[from];
}

/* Water through the lower faces of n cells of a row along a. */
static void fluxes_of_piece(const struct fv *s, int64_t c, int64_t d, int a, double dt, int64_t n)
{
    struct fraction *f = s->surface->fraction;
    const double *restrict C = f->C, *restrict flow = f->flow[a];
    double *restrict flux = f->flux;
    for (int64_t i = c; i < c + n; i++)
        flux[i] = dt * flow[i] * C[i];
    if (!any_mixed(C + c, d, n))
        return;
    for (int64_t i = c; i < c + n; i++) {
        const double v = dt * flow[i];
        if (C[i] != C[i - d] || fraction_is_mixed(C[i]) || C[i] > OVERFULL)
            flux[i] = v != 0.0 ? water_across(s, i, d, a, v) : 0.0;
    }
}

/* Along the axis that the sweep has in each block. */
static void find_fluxes(const struct fv *s, int sweep, double dt)
{
    for (const struct part *p = s->grid.part; p < s->grid.part + s->grid.nparts; p++) {
        const int a = axis_of(s, p, sweep);
        int up[3] = {0, 0, 0};
        up[a] = 1;
        PART_NEAR (p, no_layers, up, c, len)
            for (int64_t i = 0; i < len; i += PIECE)
                fluxes_of_piece(s, c + i, p->stride[a], a, dt, piece(i, len));
    }
}

/* Sum over a row of what comes in through the lower faces less what leaves through the upper. */
static double gain_of_row(const double *q, int64_t d, int64_t n)
{
    double part[SUM_LANES] = {0.0};
    int64_t i = 0;
    for (; i + SUM_LANES <= n; i += SUM_LANES)
        for (int m = 0; m < SUM_LANES; m++)
            part[m] += q[i + m] - q[i + m + d];
    for (; i < n; i++)
        part[0] += q[i] - q[i + d];
    return lanes_sum(part);
}

/* C of a row; see the head. */
static void update_row(const struct fraction *f, int a, int64_t c, int64_t d, double dt, int64_t n)
{
    const double *restrict flux = f->flux, *restrict flow = f->flow[a], *restrict layer = f->layer,
                           *restrict volume = f->volume;
    double *restrict C = f->C;
    for (int64_t i = c; i < c + n; i++) {
        const double solved = layer[i] == 0.0 ? dt : 0.0, v = solved * flow[i],
                     w = solved * flow[i + d];
        C[i] += ((flux[i] - v) - (flux[i + d] - w)) / volume[i];
    }
}

static void sweep(struct fv *s, int a, double dt)
{
    struct fraction *f = s->surface->fraction;
    find_planes(s);
    grid_clear_near(&s->grid, f->flux); /* beside cells near water, too */
    find_fluxes(s, a, dt);
    outflow_count_volumes(s, f->axes.axis[a], f->flux);
    for (const struct part *p = s->grid.part; f->passed[0] && p < s->grid.part + s->grid.nparts;
         p++)
        for (int64_t i = p->base; i < p->base + p->size; i++)
            f->passed[axis_of(s, p, a)][i] += f->flux[i];
    FLOW_NEAR_AT (s, part, j, c, n) {
        const int along = axis_of(s, part, a);
        const int64_t d = part->stride[along];
        update_row(f, along, c, d, dt, n);
        f->entered += gain_of_row(f->flux + c, d, n); /* all faces within cancel */
    }
    surface_mirror(s, f->C);
}

/* m^dim that the projection left in wet cells, in dt; this rank's. */
static double excess_of(const struct fv *s, double dt)
{
    const struct fraction *f = s->surface->fraction;
    double sum = 0.0;
    FLOW_NEAR_AT (s, part, j, c, n)
        for (int64_t i = c; i < c + n; i++)
            for (int a = 0; a < s->dim && f->layer[i] == 0.0; a++)
                sum += f->flow[a][i + part->stride[a]] - f->flow[a][i];
    return dt * sum;
}

/* What the projection's tolerance left goes from, or to, the mixed cells, in proportion to how
 * mixed they are: a millionth of the water. moved: this rank's, of this advance. */
static void balance(struct fv *s, double moved)
{
    struct fraction *f = s->surface->fraction;
    double sums[4] = {f->entered, f->excess, 0.0, moved};
    FLOW_NEAR (s, c, n)
        for (int64_t i = c; i < c + n; i++)
            sums[2] += fraction_is_mixed(f->C[i]) ? f->C[i] * (1.0 - f->C[i]) * f->volume[i] : 0.0;
    MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPI_DOUBLE, MPI_SUM, s->comm);
    f->entered = sums[0];
    f->moved += sums[3];
    const double part = sums[2] > 10.0 * fabs(sums[1]) ? -sums[1] / sums[2] : 0.0;
    FLOW_NEAR (s, c, n)
        for (int64_t i = c; i < c + n && part != 0.0; i++)
            if (fraction_is_mixed(f->C[i]))
                f->C[i] += part * f->C[i] * (1.0 - f->C[i]);
    surface_note_returned(s, part * sums[2]);
    surface_mirror(s, f->C);
}

void fraction_count(struct fraction *f, int64_t size)
{
    if (f->was_read > 0.0) {
        for (int a = 0; a < 3 && f->passed[a]; a++)
            memset(f->passed[a], 0, (size_t)size * sizeof(double));
        f->passed_time = f->was_read = 0.0;
    }
    if (f->carries == 0.0)
        f->passed_time = -1.0;
}

/* n parts of dt; in each all axes, the first one in turns, so that none comes first for ever. */
void fraction_advance(struct fv *s, double dt, int n)
{
    struct fraction *f = s->surface->fraction;
    fraction_set_flows(s);
    f->has_flows = false;
    f->entered = 0.0;
    f->excess = excess_of(s, dt);
    double moved = 0.0;
    for (int k = 0; k < n; k++) {
        for (int a = 0; a < s->dim; a++)
            sweep(s, ((int)f->first + a) % s->dim, dt / n);
        f->first = ((int)f->first + 1) % s->dim;
        moved += fraction_bound(s);
    }
    f->passed_time += f->passed_time < 0.0 ? 0.0 : dt;
    balance(s, moved);
}

double fraction_passed(const struct fv *s, int64_t c, int a, double at)
{
    const struct fraction *f = s->surface->fraction;
    const double *flow = f->passed[a] + c;
    return ((1.0 - at) * flow[0] + at * flow[s->grid.part[0].stride[a]]) *
           fraction_height(s, c, a) / (f->volume[c] * f->passed_time);
}
