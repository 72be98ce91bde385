/* surface_pressure.c - p = 2 nu n.(D n) on the surface in the equations of the wet cells (ghost
 * fluid: Gibou, Fedkiw, Cheng & Kang, J. Comput. Phys. 176, 2002, symmetric): between a wet cell L
 * and a dry one the gradient is (p_I - p_L)/(theta h), theta = phi_L/(phi_L - phi_R) >= 0.01,
 * with viscosity more (surface_first_half): p_I is explicit, and 1/theta amplifies it.
 * Without gravity's part, so p_I has -(pressure at rest). In implicit steps the surface yields to
 * the velocity within the step: Newmark's scheme, for which its height counts at eta + beta dt^2
 * dw/dt, dw/dt = -dp/dy: the same value of p, beta g dt^2 further off; along a line inclined by
 * an angle of up to 45 degrees, where dp/dy is the slope over its cosine, over that.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "levelset.h"

#include "../boundary/fv_boundary.h"
#include "level_ops.h"
#include "mesh_view.h"

/* m: what the surface's rise within an implicit step adds to the distance from a wet centre to its
 * pressure; e: unit vector from the wet to the dry cell. */
static double rise_of(const struct fv *s, const double *e)
{
    const double g = s->surface->g;
    double up = 0.0;
    for (int a = 0; a < s->dim && g > 0.0; a++)
        up -= e[a] * s->gravity.hydrostatic[a] / g;
    return s->surface->rise * g * fmax(0.0, up) / fmax(up * up, 0.5);
}

struct cut level_cut(const struct surface *f, int64_t face, int64_t d, bool here)
{
    struct cut x = {.face = face,
                    .wet = here ? face : face - d,
                    .dry = here ? face - d : face,
                    .up = here ? -1.0 : 1.0};
    const double inside = fmin(0.0, f->phi[x.wet]);
    x.theta = inside / (inside - f->phi[x.dry]);
    return x;
}

void level_add_cut(struct fv *s, int a, struct cut cut, const double *x, const double *e)
{
    struct surface *f = s->surface;
    cut.theta = fmax(cut.theta, fmax(f->theta_least, 0.01)) + rise_of(s, e) / cut.step;
    cut.height = -fv_still_pressure(s, x) / s->run->scene.fluid.rho;
    ROOM_IN(f, f->cut[a], f->ncut[a] + 1);
    f->cut[a][f->ncut[a]++] = cut;
}

static void add_cut(struct fv *s, int a, int64_t face, bool wet_here)
{
    const struct block *b = &s->b;
    int at[3];
    block_place(b, face, at);
    struct cut x = level_cut(s->surface, face, b->stride[a], wet_here);
    double at_surface[3], e[3] = {0.0, 0.0, 0.0};
    e[a] = x.up;
    block_centre(b, at[0], at[1], at[2], at_surface);
    x.step = block_step(b, a, at[1]);
    x.size = block_size(b, a, wet_here ? at[1] : at[1] - (a == 1));
    at_surface[a] += ((wet_here ? 0.0 : -1.0) + x.up * x.theta) * x.step;
    level_add_cut(s, a, x, at_surface, e);
}

/* Faces of local cells and of one layer around, and the next further up along a: that of a cell two
 * places below, see surface_line.c. */
static void find_cuts(struct fv *s, int a)
{
    struct surface *f = s->surface;
    const int64_t d = s->b.stride[a];
    const int deep = s->dim == 3, down[3] = {1, 1, deep},
              up[3] = {1 + (a == 0), 1 + (a == 1), deep + (a == 2)};
    f->ncut[a] = 0;
    PART_NEAR (&s->whole, down, up, at, n)
        for (int64_t c = at; c < at + n; c++) {
            const double free = s->forcing ? s->forcing->open[a][c] : 1.0;
            const bool here = f->layer[c] == 0, below = f->layer[c - d] == 0;
            f->open[a][c] = (here && below) || free == 2.0 ? free : 0.0;
            if (free == 2.0 && !here && !below)
                f->open[a][c] = 0.0;
            if (free == 1.0 && here != below)
                add_cut(s, a, c, here);
        }
}

static bool dry_water_side(const struct fv *s, int64_t c)
{
    return s->surface->layer[c] && forcing_is_free(s, c);
}

static bool has_vent(const struct fv *s, int a, int64_t c)
{
    return blocked_vents(s, a, c, 0) || blocked_vents(s, a, c, 1);
}

/* Wet cells whose fourth-order gradient along a would read dry ones, or a box's face that is none
 * now: they take the mean of their two faces. */
static void find_leaving(struct fv *s, int a)
{
    struct surface *f = s->surface;
    const int64_t d = s->b.stride[a];
    f->nleaving[a] = 0;
    BLOCK_WET (s, 0, c, n)
        for (int64_t i = c; i < c + n; i++) {
            if (f->layer[i] || !(dry_water_side(s, i - d) || dry_water_side(s, i + d) ||
                                 dry_water_side(s, i - 2 * d) || dry_water_side(s, i + 2 * d) ||
                                 has_vent(s, a, i)))
                continue;
            ROOM_IN(f, f->leaving[a], f->nleaving[a] + 1);
            f->leaving[a][f->nleaving[a]++] = i;
        }
}

void level_find_cuts(struct fv *s)
{
    if (s->blocked && s->surface->fraction)
        vents_find(s);
    for (int a = 0; a < s->dim; a++) {
        find_cuts(s, a);
        if (s->blocked && s->surface->fraction)
            vents_add_cuts(s, a);
        find_leaving(s, a);
    }
}

static void count(struct fv *s)
{
    struct surface *f = s->surface;
    int64_t n[2] = {0, 0};
    FLOW_NEAR (s, c, len)
        for (int64_t i = c; i < c + len; i++)
            n[0] += f->layer[i] == 0 && !(f->forced && s->forcing->forced[i]);
    for (int a = 0; a < s->dim; a++)
        n[1] += f->ncut[a];
    MPI_Allreduce(MPI_IN_PLACE, n, 2, MPI_INT64_T, MPI_SUM, s->comm);
    f->wet = n[0];
    f->cuts = n[1];
}

/* In this order: layers say what is wet, faces follow from it, and counts from both. */
void surface_rebuild(struct fv *s)
{
    struct surface *f = s->surface;
    extension_build(s);
    f->ops->find_faces(s);
    count(s);
}

void surface_set_pressure(struct fv *s)
{
    struct surface *f = s->surface;
    if (s->nu > 0.0)
        grid_fill(&s->grid, 1, &f->stress);
    for (int a = 0; a < s->dim; a++)
        for (int64_t i = 0; i < f->ncut[a]; i++) {
            struct cut *x = f->cut[a] + i;
            x->p = x->height + 2.0 * s->nu * f->stress[x->dry];
        }
}

static void zero_row(const unsigned char *restrict layer, int64_t n, double *restrict q)
{
    for (int64_t i = 0; i < n; i++)
        q[i] = layer[i] ? 0.0 : q[i];
}

void surface_zero(const struct fv *s, double *q)
{
    FLOW_WET (s, c, n)
        zero_row(s->surface->layer + c, n, q + c);
}

void surface_zero_all(const struct fv *s, double *q)
{
    FLOW_NEAR (s, c, n)
        zero_row(s->surface->layer + c, n, q + c);
}

/* Moves what is known of cut faces, the surface's pressure, to the right side of the wet cell's
 * row. */
void surface_add_pressure(const struct fv *s, double *div)
{
    const struct surface *f = s->surface;
    for (int a = 0; a < s->b.dim; a++)
        for (int64_t i = 0; i < f->ncut[a]; i++) {
            const struct cut *x = f->cut[a] + i;
            div[x->wet] -= x->p / (x->theta * x->step * x->size);
        }
}

double surface_cut_gradient(const struct cut *x, const double *psi, bool change)
{
    return x->up * ((change ? 0.0 : x->p) - psi[x->wet]) / (x->theta * x->step);
}

void surface_fluxes(const struct fv *s, double tau, const double *psi)
{
    s->surface->ops->fluxes(s, tau, psi);
}

void level_cut_fluxes(const struct fv *s, double tau, const double *psi)
{
    const struct surface *f = s->surface;
    for (int a = 0; a < s->b.dim; a++)
        for (int64_t i = 0; i < f->ncut[a]; i++)
            s->U[a][f->cut[a][i].face] -= tau * surface_cut_gradient(f->cut[a] + i, psi, false);
}

/* U of dry faces of a row; w: weights of u of the four cells around. */
static void dry_row(const double *restrict u, const unsigned char *layer, const double *w,
                    int64_t d, int64_t n, double *restrict U)
{
    for (int64_t i = 0; i < n; i++)
        if (layer[i] && layer[i - d])
            U[i] = (w[1] * u[i - d] + w[2] * u[i]) + (w[0] * u[i - 2 * d] + w[3] * u[i + d]);
}

void surface_dry_fluxes(const struct fv *s, bool stencils)
{
    static const double even[4] = {-1.0 / 12.0, 7.0 / 12.0, 7.0 / 12.0, -1.0 / 12.0};
    const unsigned char *layer = s->surface->layer;
    for (int a = 0; a < s->b.dim; a++) {
        double(*const w)[4] = a == 1 && s->b.rows ? s->b.rows->face : NULL;
        const int64_t d = s->b.stride[a];
        if (stencils)
            BLOCK_WET_AT (s, 1, j, c, n)
                dry_row(s->u[a] + c, layer + c, w ? w[j] : even, d, n, s->U[a] + c);
        else
            BLOCK_NEAR_AT (s, 1, j, c, n)
                dry_row(s->u[a] + c, layer + c, w ? w[j] : even, d, n, s->U[a] + c);
    }
}

/* Gradient of psi on a face along a; w: 1 over the step of the cells. */
static double on_face(const struct fv *s, int a, int64_t face, const double *psi, double w)
{
    const double open = s->surface->open[a][face];
    const int64_t below = face - s->b.stride[a];
    if (open == 2.0) /* outflow: psi is 0 on the face */
        return 2.0 * w * (s->forcing->forced[face] ? -psi[below] : psi[face]);
    return open * w * (psi[face] - psi[below]);
}

/* The same on both faces of the cells whose stencil leaves the water. */
static void leaving_gradient(const struct fv *s, int a, const double *psi, double *out)
{
    const struct block *b = &s->b;
    const int64_t d = b->stride[a];
    for (int64_t k = 0; k < s->surface->nleaving[a]; k++) {
        const int64_t c = s->surface->leaving[a][k];
        const int j = b->rows ? block_row(b, c) : 0;
        out[c] = on_face(s, a, c, psi, 1.0 / block_step(b, a, j));
        out[c + d] = on_face(s, a, c + d, psi, 1.0 / block_step(b, a, j + (a == 1)));
    }
}

/* Gradient on the faces along a that count beside the surface, beside a partner on all; p on the
 * surface: what stands there, or 0. */
static void face_gradient(const struct fv *s, int a, const double *psi, bool change, double *out)
{
    const struct surface *f = s->surface;
    if (f->forced)
        BLOCK_WET_AT (s, 1, j, c, n)
            for (int64_t i = c; i < c + n; i++)
                out[i] = on_face(s, a, i, psi, 1.0 / block_step(&s->b, a, j));
    else
        leaving_gradient(s, a, psi, out);
    for (int64_t i = 0; i < f->ncut[a]; i++) {
        const struct cut *x = f->cut[a] + i;
        out[x->face] = surface_cut_gradient(x, psi, change);
    }
    if (!change)
        levels_face_gradient(s, a, out);
    for (int64_t i = 0; f->forced && i < s->forcing->nface[a]; i++) { /* into a partner's cells */
        const int64_t face = s->forcing->face[a][i];                  /* it goes on */
        out[face] = out[face - s->forcing->sign[a][i] * s->b.stride[a]];
    }
}

/* Cells beside a partner's whose one-sided stencil would leave the water, too. */
static void gradient_beside_partner(const struct fv *s, int a, const double *F, double *out)
{
    const struct forcing *g = s->forcing;
    const int64_t d = s->b.stride[a];
    for (int64_t i = 0; i < g->nfix[a]; i++) {
        const int64_t c = g->fix_cell[a][i];
        bool dry = false;
        for (int way = -1; way <= 1; way += 2)
            for (int m = 1; m <= REACH && !g->forced[c + way * m * d]; m++)
                dry = dry || s->surface->layer[c + way * m * d];
        if (dry && !s->surface->layer[c])
            out[c] = 0.5 * (F[c] + F[c + d]);
    }
}

static void near_gradient(const struct fv *s, int a, const double *psi, bool change, double *out)
{
    const struct surface *f = s->surface;
    const int64_t d = s->b.stride[a];
    double *F = f->rate;
    face_gradient(s, a, psi, change, F);
    BLOCK_WET (s, 0, c, n)
        for (int64_t i = c; i < c + n; i++)
            out[i] = f->layer[i] ? 0.0 : out[i];
    for (int64_t k = 0; k < f->nleaving[a]; k++) {
        const int64_t c = f->leaving[a][k];
        out[c] = 0.5 * (F[c] + F[c + d]);
    }
    surface_line_slopes(s, a, psi, change, out);
    if (f->forced)
        gradient_beside_partner(s, a, F, out);
}

void surface_gradient(const struct fv *s, int a, const double *psi, double *out)
{
    near_gradient(s, a, psi, false, out);
}

void surface_gradient_change(const struct fv *s, int a, const double *psi, double *out)
{
    near_gradient(s, a, psi, true, out);
}
