/* pressure.c - the 5-point (7-point) problem of even cells and rows: conjugate gradients with one
 * cycle of PFMG, under a surface mostly of halving.c, started from what is given. They are written
 * out here: hypre's would spend a second cycle on the residual of its last iteration, and most
 * solves take one iteration. Forced cells are identity rows. SPDX-License-Identifier: BSD-3-Clause
 */
#include "../fv.h"

#include "../boundary/fv_boundary.h"
#include "../operators/fv_operators.h"
#include "../surface/fv_surface.h"
#include "backend.h"
#include "halving.h"
#include "pfmg.h"
#include "wet_boxes.h"

enum { MOST = 50 }; /* iterations */
static const double NO_RESIDUAL =
    1e-200; /* square sum of a residual whose products are still numbers */

struct pressure {
    struct halving *halving; /* under a surface, on few ranks; else NULL, and */
    struct pfmg *pfmg;
    struct wet_boxes boxes; /* its cells */
    int outer[2][3];        /* the cells of a field, ghosts too, as the cycle counts them */
    double *diagonal;       /* 1/m^2: sum of 1/h^2 over the open faces */
    double *p, *Ap, *z;     /* direction, its image, residual after a cycle */
    double free_cells;      /* of all ranks */
    bool singular;          /* no side gives the pressure */
    double shift;           /* 1/m^2: on the diagonal of the cycle's matrix, beside the least one */
};

/* The backend's state. */
static struct pressure *own(const struct fv *s) { return s->poisson->of; }

/* Rows of uneven height count by their mean spacing. */
static struct pfmg *make_pfmg(const struct block *b, const struct wet_boxes *w)
{
    struct pfmg_grid g = {.comm = b->cart,
                          .dim = b->dim,
                          .uneven = b->rows,
                          .nboxes = w->n,
                          .lo = w->lo,
                          .hi = w->hi};
    for (int a = 0; a < 3; a++) {
        g.cells[a] = b->cells[a];
        g.periodic[a] = b->periodic[a];
        g.h[a] = b->length[a] / b->cells[a];
    }
    return pfmg_create(&g);
}

/* A thousandth of the smallest eigenvalue, about (pi/L)^2, on the diagonal of the cycle's matrix:
 * the problem is singular, and the coarsest level would divide the rounding error of the residual's
 * mean by that of a zero. The iteration's own matrix has none of it. */
static double shift(const struct block *b)
{
    double L = 0.0;
    for (int a = 0; a < b->dim; a++)
        L = fmax(L, b->length[a]);
    return 1e-2 / (L * L);
}

/* Weight of a row: its height over that of the even ones, so that the matrix is symmetric. */
static double weight(const struct block *b, int j)
{
    return b->rows ? b->rows->h[j] / b->h[1] : 1.0;
}

/* -Lap times the weight: of the lower face along a of a cell in row j, 1/m^2. */
static double coefficient(const struct block *b, int a, int j)
{
    return a == 1 ? 1.0 / (b->h[1] * block_step(b, 1, j)) : weight(b, j) / (b->h[a] * b->h[a]);
}

/* Row of a cell: what is open passes, forced cells stand alone. Returns the diagonal. */
static double fill_row(const struct fv *s, const struct pressure *p, int64_t c, int j, double *row)
{
    const struct block *b = &s->b;
    const struct forcing *f = s->forcing;
    double *const *open = s->surface ? s->surface->open : f ? f->open : NULL;
    double sum = s->surface ? p->z[c] : 0.0;
    for (int e = 1; e <= 2 * b->dim; e++) {
        const int a = (e - 1) / 2;
        const int64_t face = (e - 1) % 2 ? c + b->stride[a] : c;
        const double is_open = open ? open[a][face] : 1.0;
        const double w = is_open * coefficient(b, a, j + (e == 4)); /* 4: above, along y */
        row[e] = is_open <= 1.0 ? -w : 0.0; /* outflow: psi is 0 behind it */
        sum += w;
    }
    row[0] = sum > 0.0 ? sum + fmax(p->shift * weight(b, j), shift(b))
                       : 1.0; /* forced, dry, or free and shut in */
    return sum;
}

/* What a cut face adds to the diagonal of the weighted row, 1/m^2. */
static double cut_coefficient(const struct block *b, const struct cut *x)
{
    const double weight_of = b->rows ? weight(b, block_row(b, x->wet)) : 1.0;
    return weight_of / (x->theta * x->step * x->size);
}

/* z = what the surface adds to the diagonal. */
static void add_cuts(const struct fv *s, double *z)
{
    const struct surface *f = s->surface;
    grid_clear_near(&s->grid, z);
    for (int a = 0; a < s->b.dim; a++)
        for (int64_t i = 0; i < f->ncut[a]; i++)
            z[f->cut[a][i].wet] += cut_coefficient(&s->b, f->cut[a] + i);
}

/* Rows of a box of cells. */
static void fill_box(const struct fv *s, struct pressure *p, int q, double *row)
{
    const struct block *b = &s->b;
    const int *lo = p->boxes.lo[q], *hi = p->boxes.hi[q], m = 2 * b->dim + 1;
    for (int k = lo[2]; k <= hi[2]; k++)
        for (int j = lo[1]; j <= hi[1]; j++) {
            const int64_t c = block_at(b, lo[0] - b->lo[0], j - b->lo[1], k - b->lo[2]);
            for (int64_t i = c; i <= c + hi[0] - lo[0]; i++, row += m)
                p->diagonal[i] = fill_row(s, p, i, j - b->lo[1], row);
        }
}

/* The rows of a line's wet cells, c the first of them. */
static void halve_line(const struct fv *s, struct pressure *p, int64_t c, int j, int n)
{
    double row[7], *own = halving_own(p->halving);
    for (int64_t i = c; i < c + n; i++) {
        p->diagonal[i] = fill_row(s, p, i, j, row);
        own[i] = p->diagonal[i] > 0.0 ? row[0] : 0.0;
        for (int a = 0; a < s->dim && p->diagonal[i] > 0.0; a++) {
            double *through = halving_through(p->halving, a);
            through[i] = -row[1 + 2 * a];
            through[i + s->b.stride[a]] = -row[2 + 2 * a];
            own[i] += row[1 + 2 * a] + row[2 + 2 * a];
        }
        own[i] = fmax(own[i], 0.0);
    }
}

static void set_halving(const struct fv *s, struct pressure *p)
{
    const struct block *b = &s->b;
    halving_begin(p->halving);
    for (int k = 0; k < b->n[2]; k++)
        for (int j = 0; j < b->n[1]; j++) {
            int *run = halving_run(p->halving, j, k);
            wet_boxes_run(s->surface->layer + block_at(b, 0, j, k), b->n[0], run);
            halve_line(s, p, block_at(b, run[0], j, k), j, run[1]);
        }
    halving_set_matrix(p->halving);
}

static void set_pfmg(const struct fv *s, struct pressure *p)
{
    const struct wet_boxes *w = &p->boxes;
    double *values = NEW(double, (2 * s->dim + 1) * w->cells), *row = values,
           **rows = NEW(double *, w->n);
    for (int q = 0; q < w->n; q++) {
        int64_t cells = 2 * s->dim + 1;
        for (int a = 0; a < 3; a++)
            cells *= w->hi[q][a] - w->lo[q][a] + 1;
        fill_box(s, p, q, row);
        rows[q] = row;
        row += cells;
    }
    pfmg_set_matrix(p->pfmg, rows);
    FREE(rows, values);
}

/* z holds what cut faces add until rows have been made; after that it is 0 wherever no cycle
 * writes. */
static void make_matrix(const struct fv *s, struct pressure *p)
{
    memset(p->diagonal, 0, (size_t)s->size * sizeof(double));
    if (s->surface)
        add_cuts(s, p->z);
    if (p->halving)
        set_halving(s, p);
    else
        set_pfmg(s, p);
    memset(p->z, 0, (size_t)s->size * sizeof(double));
    if (s->forcing)
        forcing_zero(s->forcing, p->diagonal);
}

static void *create(struct fv *s)
{
    const struct block *b = &s->b;
    if (s->m)
        return NULL;
    struct pressure *p = NEW(struct pressure, 1);
    p->diagonal = mem_own(p, block_field(b));
    p->p = mem_own(p, block_field(b));
    p->Ap = mem_own(p, block_field(b));
    p->z = mem_own(p, block_field(b));
    p->free_cells = (double)b->cells[0] * b->cells[1] * b->cells[2];
    if (s->forcing)
        p->free_cells = (double)s->forcing->free_cells;
    p->singular = !s->bc || !s->bc->pressure_given;
    if (s->surface) {
        p->singular = p->singular && s->surface->cuts == 0;
        p->free_cells = fmax(1.0, (double)s->surface->wet);
    }
    for (int a = 0; a < 3; a++) {
        p->outer[0][a] = b->lo[a] - b->g[a];
        p->outer[1][a] = b->hi[a] - 1 + b->g[a];
    }
    if (s->surface && halving_fits(b)) {
        p->halving = mem_own(p, halving_create(b));
    } else {
        wet_boxes_find(s, p, &p->boxes);
        p->pfmg = mem_own(p, make_pfmg(b, &p->boxes));
    }
    make_matrix(s, p);
    return p;
}

/* Called when the surface has moved: other wet cells, another matrix. Boxes, and with them hypre's
 * grid, change seldom. */
static void rebuild(struct fv *s, void *of)
{
    struct pressure *p = of;
    p->singular = s->surface->cuts == 0 && (!s->bc || !s->bc->pressure_given);
    p->free_cells = fmax(1.0, (double)s->surface->wet);
    if (!p->halving && wet_boxes_find(s, p, &p->boxes)) {
        DROP(p->pfmg);
        p->pfmg = mem_own(p, make_pfmg(&s->b, &p->boxes));
    }
    make_matrix(s, p);
}

/* Forced cells, and under a surface dry ones next to the water, which loops over wet rows touch. */
static void zero_idle(const struct fv *s, double *x)
{
    if (s->forcing)
        forcing_zero(s->forcing, x);
    if (s->surface)
        surface_zero(s, x);
}

/* q = A x for the n cells of row j from c on, x with its ghosts; q is 0 in forced cells and in dry
 * ones, whose diagonal is 0, and x is. */
static void apply_row(const struct fv *s, const double *restrict x, int j, int64_t c, int64_t n,
                      double *restrict q)
{
    const struct block *b = &s->b;
    const double *restrict d = own(s)->diagonal + c;
    const int64_t y = b->stride[1], z = b->stride[2];
    const double cx = coefficient(b, 0, j), low = coefficient(b, 1, j),
                 up = coefficient(b, 1, j + 1), cz = b->dim == 3 ? coefficient(b, 2, j) : 0.0;
    x += c;
    for (int64_t i = 0; i < n; i++)
        q[i] = d[i] > 0.0
                   ? d[i] * x[i] - cx * (x[i - 1] + x[i + 1]) - (low * x[i - y] + up * x[i + y])
                   : 0.0;
    for (int64_t i = 0; i < n && b->dim == 3; i++)
        q[i] -= d[i] > 0.0 ? cz * (x[i - z] + x[i + z]) : 0.0;
}

static double dot(const struct fv *s, const double *x, const double *y)
{
    return ranks_sum(s->comm, helmholtz_dot(s, x, y));
}

/* Takes the mean over the free cells out: the rows of A sum to zero. Returns the sum of the squares
 * then. */
static double remove_mean(const struct fv *s, double *restrict x)
{
    double sums[2] = {0.0, 0.0};
    zero_idle(s, x);
    if (s->forcing && s->forcing->parted) {
        parted_remove_means(s->forcing->parted, s, x);
        return dot(s, x, x);
    }
    if (!own(s)->singular)
        return dot(s, x, x);
    BLOCK_WET (s, 0, c, n) {
        sums[0] += lanes_dot_any(x + c, x + c, n);
        sums[1] += lanes_total(x + c, n);
    }
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, s->comm);
    const double mean = sums[1] / own(s)->free_cells;
    BLOCK_WET (s, 0, c, n)
        for (int64_t i = c; i < c + n; i++)
            x[i] -= mean;
    zero_idle(s, x);
    return fmax(sums[0] - sums[1] * mean, 0.0);
}

/* x = one cycle on r. */
static void cycle(const struct fv *s, double *r, double *x)
{
    struct pressure *p = own(s);
    if (p->halving) {
        if (x != p->z)
            memset(x, 0, (size_t)s->size * sizeof(double));
        halving_cycle(p->halving, r, x);
        return;
    }
    for (int q = 0; q < p->boxes.n; q++)
        pfmg_put(p->pfmg, q, p->outer, r);
    pfmg_cycle(p->pfmg);
    if (s->surface) /* beside the boxes */
        memset(x, 0, (size_t)s->size * sizeof(double));
    for (int q = 0; q < p->boxes.n; q++)
        pfmg_get(p->pfmg, q, p->outer, x);
}

/* z = one cycle on r, and p = z + beta p with the beta that makes p conjugate. Returns r.z. */
static double next_direction(const struct fv *s, double *r, double rz_last)
{
    struct pressure *p = own(s);
    cycle(s, r, p->z);
    if (s->surface && !p->halving)
        surface_zero(s, p->z);
    const double rz = dot(s, r, p->z), beta = rz_last > 0.0 ? rz / rz_last : 0.0;
    if (!p->halving && beta == 0.0) { /* that needs its zeros again */
        double *const first = p->z;
        p->z = p->p;
        p->p = first;
        return rz;
    }
    const double *restrict z = p->z;
    double *restrict d = p->p;
    BLOCK_WET (s, 0, c, n)
        for (int64_t i = c; i < c + n; i++)
            d[i] = z[i] + beta * d[i];
    return rz;
}

/* x += alpha p, r -= alpha A p with the alpha of the smallest error. Returns r.r. */
static double advance(const struct fv *s, double rz, double *restrict x, double *restrict r)
{
    struct pressure *p = own(s);
    double *restrict d = p->p, *restrict Ad = p->Ap, sum = 0.0;
    block_halo(&s->b, 1, &p->p);
    BLOCK_WET_AT (s, 0, j, c, n) {
        apply_row(s, d, j, c, n, Ad + c);
        sum += lanes_dot_any(d + c, Ad + c, n);
    }
    const double alpha = rz / ranks_sum(s->comm, sum);
    sum = 0.0;
    BLOCK_WET (s, 0, c, n) {
        for (int64_t i = c; i < c + n; i++) {
            x[i] += alpha * d[i];
            r[i] -= alpha * Ad[i];
        }
        sum += lanes_dot_any(r + c, r + c, n);
    }
    return ranks_sum(s->comm, sum);
}

/* r = -div - A psi in place of div. Returns r.r. */
static double first_residual(const struct fv *s, double *psi, double *restrict div)
{
    double *restrict row = own(s)->Ap, sum = 0.0;
    if (s->forcing)
        forcing_zero(s->forcing, psi);
    if (s->surface)
        surface_zero_all(s, psi);
    block_halo(&s->b, 1, &psi);
    BLOCK_WET_AT (s, 0, j, c, n) {
        apply_row(s, psi, j, c, n, row);
        for (int64_t i = 0; i < n; i++)
            div[c + i] = -div[c + i] - row[i];
        sum += lanes_dot_any(div + c, div + c, n);
    }
    return ranks_sum(s->comm, sum);
}

/* Square sum of a residual that rounding leaves: g L/h^2 in all wet cells. */
static double least_residual(const struct fv *s)
{
    double L = 0.0, h = INFINITY;
    for (int a = 0; a < s->b.dim; a++) {
        L = fmax(L, s->b.length[a]);
        h = fmin(h, s->b.h[a]);
    }
    const double one = 1e-15 * s->surface->g * L / (h * h);
    return one * one * (double)s->surface->wet;
}

/* So that the matrix is symmetric over rows of different heights. */
static void weight_rows(const struct fv *s, double *r)
{
    const struct block *b = &s->b;
    if (b->rows)
        BLOCK_WET_AT (s, 0, j, c, n)
            for (int64_t i = c; i < c + n; i++)
                r[i] *= weight(b, j);
}

/* div becomes the residual; psi is the start and the result, its ghosts set. At least one iteration
 * unless there is nothing to solve for. */
static bool solve(struct fv *s, double tau, double *div, double tol, double *psi)
{
    (void)tau; /* div is over it */
    weight_rows(s, div);
    double enough = tol * tol * remove_mean(s, div);
    double rr = first_residual(s, psi, div), rz = 0.0;
    if (s->surface) /* psi is the whole pressure: of its change */
        enough = fmax(tol * tol * rr, least_residual(s));
    int n = 0;
    while (rr > NO_RESIDUAL && (n == 0 || rr > enough) && n < MOST) {
        rz = next_direction(s, div, rz);
        rr = advance(s, rz, psi, div);
        n++;
    }
    if (!s->surface || own(s)->singular || (s->forcing && s->forcing->parted))
        remove_mean(s, psi); /* else it has none, and idle cells are 0 */
    block_halo(&s->b, 1, &psi);
    s->totals.iterations += n;
    return true; /* the watches see what is left */
}

/* With a shift the matrix is regular, and means stay. */
static void cycle_field(struct fv *s, double *r, double *x)
{
    struct pressure *p = own(s);
    weight_rows(s, r);
    if (p->shift == 0.0)
        remove_mean(s, r);
    cycle(s, r, x);
    if (p->shift == 0.0)
        remove_mean(s, x);
    else if (s->forcing)
        forcing_zero(s->forcing, x);
    block_halo(&s->b, 1, &x);
}

static void set_shift(struct fv *s, void *of, double given)
{
    struct pressure *p = of;
    if (given == p->shift)
        return;
    p->shift = given;
    make_matrix(s, p);
}

const struct backend backend_even = {.create = create,
                                     .solve_field = solve,
                                     .cycle_field = cycle_field,
                                     .shift = set_shift,
                                     .rebuild = rebuild};
