/* wet_pressure.c - the pressure of blocks under a free surface; a matrix for each place of it. Rows
 * of wet computed cells: minus the sums of the fluxes of psi (surface_faces.c beside the surface);
 * dry cells and holes, where psi = 0, have none. Wet cells that other blocks interpolate: psi less
 * its linear interpolation; beside the surface, where donors are dry, what psi has beyond the
 * surface's pressure P grows with the distance, psi = P + phi <(psi_k - P_k)/phi_k>, the mean over
 * the wet donors k, phi less what the surface rises within an implicit step (surface_pressure.c).
 * Where all donors are wet, what cubics of the start value have beyond the linear rows stands on
 * the right: psi is the whole pressure here, and linear donors half a cell off take (k h)^2/8 of a
 * wave's, which damps it. GMRES with a cycle of BoomerAMG; the surface's pressure makes the matrix
 * regular. SPDX-License-Identifier: BSD-3-Clause */
#include "../fv.h"

#include <HYPRE.h>
#include <HYPRE_IJ_mv.h>
#include <HYPRE_krylov.h>
#include <HYPRE_parcsr_ls.h>

#include "../boundary/fv_boundary.h"
#include "../grid/fv_grid.h"
#include "../surface/fv_surface.h"
#include "backend.h"
#include "ij_rows.h"

struct wet_pressure {
    int n; /* rows of this rank */
    HYPRE_BigInt first, pinned;
    int64_t total;  /* rows of all ranks; 0: there is no matrix */
    int64_t *place; /* [n] index of the row's cell in a field */
    double *number; /* row of each place, behind walls of the mirrored cell; -1: psi is 0 there */
    struct mesh_exchange ghosts; /* of the numbers */
    double *value, *residual;    /* of each row; borrowed */
    unsigned char *whole;        /* of each place: interpolated from wet donors alone */
    double *dry; /* right side of interpolated cells: what they have of the surface's pressure */
    double scale;
    struct matrix A;
    struct vector b, x, r;
    HYPRE_Solver gmres, amg;
    int *special[3]; /* of each place: 1 + index of its wet_face, 0: a plain face */
    /* entries of all rows */
    HYPRE_Int *count;
    HYPRE_BigInt *col;
    double *entry;
    int64_t nentry, room;
    /* donors of interpolated cells: phi, P and row of theirs stand behind the fields' own places */
    struct mesh_exchange donors;
    double *beyond[3];
};

/* The backend's state. */
static struct wet_pressure *own(const struct fv *s) { return s->poisson->of; }

/* --- what stays --- */

/* The real cell of one that may lie behind sides: behind walls its mirror image; false: none. */
static bool find_cell(const struct mesh *m, int *block, int *at)
{
    double move[3] = {0.0, 0.0, 0.0};
    if (mesh_resolve(m, block, at, move))
        return true;
    const int *n = m->block[*block].n;
    for (int a = 0; a < m->dim; a++)
        at[a] = at[a] < 0 ? -1 - at[a] : at[a] >= n[a] ? 2 * n[a] - 1 - at[a] : at[a];
    return mesh_resolve(m, block, at, move);
}

/* Where ghosts have their row from. */
static void make_ghosts(struct fv *s, struct wet_pressure *p)
{
    struct mesh *m = s->m;
    struct mesh_request *request = NEW(struct mesh_request, s->size);
    int64_t n = 0;
    for (int q = 0; q < m->nparts; q++) {
        const struct part *part = m->part + q;
        int i[3];
        PART_ALL (part, i, c) {
            int block = part->block, at[3];
            for (int a = 0; a < 3; a++)
                at[a] = part->lo[a] + i[a];
            if (part_has(part, i) || !find_cell(m, &block, at))
                continue;
            request[n] = (struct mesh_request){.in = c};
            mesh_owner(m, block, at, &request[n].rank, &request[n].out);
            n++;
        }
    }
    mesh_exchange_create(p, m, &p->ghosts, 1, n, request);
    mem_free(request);
}

/* Where the donors of the fringe give their phi and P to. */
static void make_donors(struct fv *s, struct wet_pressure *p)
{
    struct mesh *m = s->m;
    const int each = 1 << m->dim;
    struct mesh_request *request = NEW(struct mesh_request, each * m->nfringe);
    for (int64_t k = 0; k < m->nfringe; k++)
        for (int d = 0; d < each; d++) {
            const struct mesh_fringe *f = m->fringes + k;
            int at[3] = {f->from[0] + (d & 1), f->from[1] + (d >> 1 & 1),
                         f->from[2] + (d >> 2 & 1)};
            int block = f->donor;
            double move[3] = {0.0, 0.0, 0.0};
            struct mesh_request *q = request + each * k + d;
            if (!mesh_resolve(m, &block, at, move))
                abort_run("a donor behind a wall");
            *q = (struct mesh_request){.in = s->size + each * k + d};
            mesh_owner(m, block, at, &q->rank, &q->out);
        }
    mesh_exchange_create(p, m, &p->donors, 1, each * m->nfringe, request);
    for (int k = 0; k < 3; k++) {
        mem_free(p->beyond[k]);
        p->beyond[k] = NEW_IN(p, double, s->size + each * m->nfringe);
    }
    mem_free(request);
}

/* The rows of the fringe (m->fringes) have changed. */
static void renew(struct fv *s, void *of, bool hierarchy)
{
    struct wet_pressure *p = of;
    (void)hierarchy;
    mesh_exchange_free(&p->donors);
    make_donors(s, p);
}

static void free_solver(struct wet_pressure *p)
{
    if (!p->A.ij)
        return;
    HYPRE_ParCSRGMRESDestroy(p->gmres);
    HYPRE_BoomerAMGDestroy(p->amg);
    matrix_free(&p->A);
    vector_free(&p->b);
    vector_free(&p->x);
    vector_free(&p->r);
}

static void close_hypre(void *of) { free_solver(of); }

static void *create(struct fv *s)
{
    const struct mesh *m = s->m;
    if (!m || !s->surface)
        return NULL;
    struct wet_pressure *p = NEW(struct wet_pressure, 1);
    double sum[2] = {0.0, 0.0};
    p->place = NEW_IN(p, int64_t, s->poisson->n);
    p->number = NEW_IN(p, double, s->size);
    p->value = s->poisson->b;
    p->residual = s->poisson->x;
    p->dry = NEW_IN(p, double, s->size);
    p->whole = NEW_IN(p, unsigned char, s->size);
    p->count = NEW_IN(p, HYPRE_Int, s->poisson->n);
    for (int a = 0; a < m->dim; a++)
        p->special[a] = NEW_IN(p, int, s->size);
    make_ghosts(s, p);
    if (m->has_fringe)
        make_donors(s, p);
    FLOW_ROWS (s, c, n)
        for (int64_t i = c; i < c + n; i++)
            if (m->status[i] == CELL_COMPUTED) {
                sum[0] += 2.0 * m->dim * m->G[0][0][i];
                sum[1] += 1.0;
            }
    MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, m->comm);
    p->scale = sum[0] / fmax(sum[1], 1.0);
    mem_at_free(p, close_hypre);
    return p;
}

/* --- rows --- */

/* Water: what is computed, and what other blocks interpolate. */
static bool has_row(const struct fv *s, int64_t c)
{
    return s->free[c] > 0.0 || (s->m->status[c] == CELL_FRINGE && s->surface->layer[c] == 0);
}

/* Numbers of the rows, in the order of ranks. */
static void number_rows(struct fv *s, struct wet_pressure *p)
{
    long long n = 0, before = 0;
    for (int64_t c = 0; c < s->size; c++)
        p->number[c] = -1.0;
    p->n = 0;
    FLOW_ROWS (s, c, len)
        for (int64_t i = c; i < c + len; i++)
            if (has_row(s, i))
                p->place[p->n++] = i;
    n = p->n;
    MPI_Scan(&n, &before, 1, MPI_LONG_LONG, MPI_SUM, s->comm);
    p->first = (HYPRE_BigInt)(before - n);
    p->total = ranks_count(s->comm, n);
    for (int k = 0; k < p->n; k++)
        p->number[p->place[k]] = (double)(p->first + k);
    mesh_exchange(s->m, &p->ghosts, 1, &p->number);
}

/* v times psi of a row; < 0: it is 0. */
static void add_number(struct row *r, double number, double v)
{
    if (number >= 0.0)
        row_add(r, (HYPRE_BigInt)number, v);
}

/* v times psi at a place with ghosts. */
static void add_at(const struct fv *s, int64_t at, double v, struct row *r)
{
    add_number(r, own(s)->number[at], s->surface->mesh->out[at] == BEHIND_ODD ? -v : v);
}

/* weight times the flux of psi through the lower face along a of cell c. */
static void add_face(const struct fv *s, const struct part *part, int a, int64_t c, double weight,
                     struct row *r)
{
    const struct mesh *m = s->m;
    const struct wet_pressure *p = own(s);
    const struct surface_mesh *w = s->surface->mesh;
    const int64_t d = part->stride[a];
    const double open = weight * s->surface->open[a][c];
    if (p->special[a][c]) {
        const struct wet_face *x = w->face[a] + p->special[a][c] - 1;
        for (int k = x->first; k < x->first + x->n; k++)
            add_number(r, p->number[w->at[k]], weight * w->weight[k]);
        return;
    }
    if (open == 0.0)
        return;
    add_at(s, c, open * m->G[a][a][c], r);
    add_at(s, c - d, -open * m->G[a][a][c], r);
    for (int t = 0; t < m->dim; t++) {
        const int64_t b = part->stride[t];
        const double g = t == a ? 0.0 : 0.25 * open * m->G[a][t][c];
        if (g == 0.0)
            continue;
        add_at(s, c + b, g, r);
        add_at(s, c - b, -g, r);
        add_at(s, c - d + b, g, r);
        add_at(s, c - d - b, -g, r);
    }
}

/* p/rho of the surface next to a cell, phi from it along the normal. phi over its slope is nearer
 * where phi is no distance, but slopes at the fringe are rough: P then drives what makes them so,
 * and water at rest grows by up to a quarter a step. With phi as it is P in the mean over the
 * donors has all that is needed. */
static double surface_pressure_near(const struct fv *s, const struct part *part, int64_t c)
{
    const struct surface_mesh *w = s->surface->mesh;
    const double *phi = s->surface->phi;
    double g[3], foot[3], g2 = 0.0;
    surface_mesh_gradient(s, part, c, phi, g);
    for (int a = 0; a < 3; a++)
        g2 += g[a] * g[a];
    for (int a = 0; a < 3; a++)
        foot[a] = w->x[a][c] - phi[c] * g[a] / fmax(sqrt(g2), 0.5);
    return -fv_still_pressure(s, foot) / s->run->scene.fluid.rho;
}

/* phi, the surface's pressure and rows at the donors of the fringe. */
static void ask_donors(struct fv *s, struct wet_pressure *p)
{
    memset(p->beyond[1], 0, (size_t)s->size * sizeof(double));
    memcpy(p->beyond[0], s->surface->phi, (size_t)s->size * sizeof(double));
    FLOW_ROWS_AT (s, part, j, c, n)
        for (int64_t i = c; i < c + n; i++)
            if (s->m->status[i] != CELL_HOLE && s->surface->layer[i] == 0)
                p->beyond[1][i] = surface_pressure_near(s, part, i);
    memcpy(p->beyond[2], p->number, (size_t)s->size * sizeof(double));
    mesh_exchange(s->m, &p->donors, 3, p->beyond);
}

/* A wet cell of the fringe. */
static void fringe_row(const struct fv *s, struct wet_pressure *p, int64_t k, struct row *r)
{
    const struct mesh_fringe *f = s->m->fringes + k;
    const int each = 1 << s->m->dim;
    const double *phi = p->beyond[0] + s->size + each * k, *P = p->beyond[1] + s->size + each * k,
                 *number = p->beyond[2] + s->size + each * k;
    const double near = -0.2 * s->surface->least, rise = s->surface->rise * s->surface->g,
                 own = fmin(s->surface->phi[f->place], 0.0) - rise;
    double weights = 0.0, scale;
    bool all = true;
    for (int d = 0; d < each; d++) {
        all = all && (f->weight[d] == 0.0 || phi[d] < 0.0);
        weights += phi[d] < near ? f->weight[d] : 0.0;
    }
    p->whole[f->place] = all;
    p->dry[f->place] = all ? 0.0 : p->scale * p->beyond[1][f->place];
    for (int d = 0; d < each; d++) {
        if (f->weight[d] == 0.0 || (!all && (!(phi[d] < near) || !(weights > 0.2))))
            continue;
        scale = all ? 1.0 : own / ((phi[d] - rise) * weights);
        scale *= p->scale * f->weight[d];
        add_number(r, number[d], -scale);
        p->dry[f->place] -= all ? 0.0 : scale * P[d];
    }
}

static void make_row(const struct fv *s, struct wet_pressure *p, const struct part *part, int64_t c,
                     HYPRE_BigInt own, const int64_t *fringe, struct row *r)
{
    r->n = 0;
    if (s->free[c] > 0.0 && own != p->pinned) {
        for (int a = 0; a < s->dim; a++) {
            add_face(s, part, a, c, 1.0, r);
            add_face(s, part, a, c + part->stride[a], -1.0, r);
        }
        if (r->n > 0)
            return;
    }
    row_add(r, own, p->scale);
    if (s->m->status[c] == CELL_FRINGE)
        fringe_row(s, p, fringe[c], r);
}

/* Entries of all rows one after the other, as hypre takes them. */
static void keep_row(struct wet_pressure *p, int k, const struct row *r)
{
    if (p->nentry + r->n > p->room) {
        const int64_t more = 2 * p->room + 16 * (int64_t)p->n + ROW_MAX;
        GROW_IN(p, p->col, p->nentry, more);
        GROW_IN(p, p->entry, p->nentry, more);
        p->room = more;
    }
    p->count[k] = r->n;
    memcpy(p->col + p->nentry, r->col, (size_t)r->n * sizeof *p->col);
    memcpy(p->entry + p->nentry, r->v, (size_t)r->n * sizeof *p->entry);
    p->nentry += r->n;
}

/* In the order of FLOW_ROWS_AT, which is that of the rows' numbers. */
static void make_rows(struct fv *s, struct wet_pressure *p)
{
    const struct surface_mesh *w = s->surface->mesh;
    int64_t *fringe = NEW(int64_t, s->m->has_fringe ? s->size : 1);
    struct row r;
    for (int64_t q = 0; q < s->m->nfringe; q++)
        fringe[s->m->fringes[q].place] = q;
    for (int a = 0; a < s->dim; a++) {
        memset(p->special[a], 0, (size_t)s->size * sizeof(int));
        for (int64_t q = 0; q < w->nface[a]; q++)
            p->special[a][w->face[a][q].face] = (int)q + 1;
    }
    p->nentry = 0;
    const struct part *part = s->grid.part;
    for (int k = 0; k < p->n; k++) {
        while (p->place[k] >= part->base + part->size)
            part++;
        make_row(s, p, part, p->place[k], p->first + k, fringe, &r);
        keep_row(p, k, &r);
    }
    mem_free(fringe);
}

/* A tank that is full has no pressure given: psi is 0 in one cell. */
static void find_pinned(const struct fv *s, struct wet_pressure *p)
{
    HYPRE_BigInt mine = (HYPRE_BigInt)1 << 30;
    p->pinned = -1;
    if (s->surface->cuts > 0 || mesh_bc_pressure_given(s))
        return;
    for (int k = p->n - 1; k >= 0; k--)
        mine = s->free[p->place[k]] > 0.0 ? p->first + k : mine;
    MPI_Allreduce(&mine, &p->pinned, 1, HYPRE_MPI_BIG_INT, MPI_MIN, s->comm);
}

static void make_solver(const struct mesh *m, struct wet_pressure *p)
{
    HYPRE(HYPRE_BoomerAMGCreate(&p->amg));
    /* HMIS and direct interpolation: of what has few iterations the cheapest to set up */
    HYPRE(HYPRE_BoomerAMGSetCoarsenType(p->amg, 10));
    HYPRE(HYPRE_BoomerAMGSetInterpType(p->amg, 3));
    HYPRE(HYPRE_BoomerAMGSetPMaxElmts(p->amg, 4));
    HYPRE(HYPRE_BoomerAMGSetRelaxType(p->amg, 3));
    HYPRE(HYPRE_BoomerAMGSetNumSweeps(p->amg, 1));
    HYPRE(HYPRE_BoomerAMGSetStrongThreshold(p->amg, 0.25));
    HYPRE(HYPRE_BoomerAMGSetTol(p->amg, 0.0));
    HYPRE(HYPRE_BoomerAMGSetMaxIter(p->amg, 1));
    HYPRE(HYPRE_ParCSRGMRESCreate(m->comm, &p->gmres));
    HYPRE(HYPRE_GMRESSetKDim(p->gmres, 50));
    HYPRE(HYPRE_GMRESSetMaxIter(p->gmres, 100));
    HYPRE(HYPRE_GMRESSetPrecond(p->gmres, (HYPRE_PtrToSolverFcn)HYPRE_BoomerAMGSolve,
                                (HYPRE_PtrToSolverFcn)HYPRE_BoomerAMGSetup, p->amg));
    HYPRE(HYPRE_ParCSRGMRESSetup(p->gmres, p->A.A, p->b.v, p->x.v));
}

/* Donors first: rows of the fringe have their phi in them. */
static void rebuild(struct fv *s, void *of)
{
    struct wet_pressure *p = of;
    free_solver(p);
    number_rows(s, p);
    find_pinned(s, p);
    if (s->m->has_fringe)
        ask_donors(s, p);
    make_rows(s, p);
    if (p->total == 0)
        return;
    vector_create(&p->b, s->comm, p->first, p->n);
    vector_create(&p->x, s->comm, p->first, p->n);
    vector_create(&p->r, s->comm, p->first, p->n);
    matrix_create(&p->A, s->comm, p->first, p->n, p->count, p->col, p->entry);
    make_solver(s->m, p);
}

/* --- solve --- */

static double norm(const struct fv *s, const double *v, int n)
{
    double sum = 0.0;
    for (int k = 0; k < n; k++)
        sum += v[k] * v[k];
    return sqrt(ranks_sum(s->comm, sum));
}

/* |b - A x|. */
static double residual(const struct fv *s, struct wet_pressure *p, const double *b)
{
    HYPRE(HYPRE_ParCSRMatrixMatvec(1.0, p->A.A, p->x.v, 0.0, p->r.v));
    vector_get(&p->r, p->residual);
    for (int k = 0; k < p->n; k++)
        p->residual[k] = b[k] - p->residual[k];
    return norm(s, p->residual, p->n);
}

/* What rounding leaves of the pressure of a column as high as the scene. */
static double rounding(const struct fv *s, const struct wet_pressure *p)
{
    const struct scene_domain *d = &s->run->scene.domain;
    double L = 0.0;
    for (int a = 0; a < s->dim; a++)
        L = fmax(L, d->max[a] - d->min[a]);
    return 1e-15 * s->surface->g * L * p->scale * sqrt((double)s->surface->wet);
}

/* From the vector of rows to the field, which is 0 elsewhere. */
static void put_rows(const struct fv *s, struct wet_pressure *p, double *psi)
{
    memset(psi, 0, (size_t)s->size * sizeof(double));
    for (int k = 0; k < p->n; k++)
        psi[p->place[k]] = p->residual[k];
}

/* In rows with wet donors: what the start value, in x and of cubics there, has beyond linear. */
static void add_cubics(const struct fv *s, struct wet_pressure *p, double *b)
{
    HYPRE(HYPRE_ParCSRMatrixMatvec(1.0, p->A.A, p->x.v, 0.0, p->r.v));
    vector_get(&p->r, p->residual);
    for (int k = 0; k < p->n; k++) {
        const int64_t c = p->place[k];
        if (s->m->status[c] == CELL_FRINGE && p->whole[c])
            b[k] = p->residual[k];
    }
}

/* tol: of the residual of psi, the start. */
static bool solve(struct fv *s, double tau, double *div, double tol, double *psi)
{
    struct wet_pressure *p = own(s);
    double *b = p->value;
    HYPRE_Int its = 0;
    surface_mesh_add_pressure(s, tau, div);
    if (p->total == 0) {
        memset(psi, 0, (size_t)s->size * sizeof(double));
        return true;
    }
    if (s->m->has_fringe)
        mesh_fill(s->m, 1, &psi);
    for (int k = 0; k < p->n; k++) {
        const int64_t c = p->place[k];
        b[k] = p->first + k == p->pinned ? 0.0 : s->free[c] > 0.0 ? -div[c] / tau : p->dry[c];
        p->residual[k] = psi[c];
    }
    vector_set(&p->x, p->residual);
    if (s->m->has_fringe)
        add_cubics(s, p, b);
    vector_set(&p->b, b);
    const double before = residual(s, p, b), least = rounding(s, p), size = norm(s, b, p->n),
                 wanted = fmax(tol * before, least);
    if (before > least && size > 0.0) {
        HYPRE(HYPRE_GMRESSetTol(p->gmres, wanted / size));
        HYPRE(HYPRE_ParCSRGMRESSolve(p->gmres, p->A.A, p->b.v, p->x.v));
        HYPRE(HYPRE_GMRESGetNumIterations(p->gmres, &its));
        s->totals.iterations += its;
    }
    const double left = its > 0 ? residual(s, p, b) : before;
    vector_get(&p->x, p->residual);
    put_rows(s, p, psi);
    return left <= fmax(10.0 * wanted, 1e-12 * size);
}

/* Nothing on the surface. */
static void cycle(struct fv *s, double *div, double *psi)
{
    struct wet_pressure *p = own(s);
    if (p->total == 0) {
        memset(psi, 0, (size_t)s->size * sizeof(double));
        return;
    }
    for (int k = 0; k < p->n; k++) {
        const int64_t c = p->place[k];
        p->value[k] = s->free[c] > 0.0 && p->first + k != p->pinned ? div[c] : 0.0;
        p->residual[k] = 0.0;
    }
    vector_set(&p->b, p->value);
    vector_set(&p->x, p->residual);
    HYPRE(HYPRE_BoomerAMGSolve(p->amg, p->A.A, p->b.v, p->x.v));
    vector_get(&p->x, p->residual);
    put_rows(s, p, psi);
}

const struct backend backend_wet = {.create = create,
                                    .solve_field = solve,
                                    .cycle_field = cycle,
                                    .rebuild = rebuild,
                                    .renew = renew};
