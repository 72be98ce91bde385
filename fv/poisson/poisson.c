/* poisson.c - see poisson.h. poisson_create asks the backends in turn, the fastest first, and takes
 * the first that suits the cells: uniform ones, those with a surface, one index space, any blocks.
 * The others need the rows that are made here: -Lap psi = -div/tau in this rank's computed cells,
 * integrated over each cell. Without a side that gives the pressure psi is known up to a constant:
 * the excess of div and the mean of psi are taken out. poisson_cycle is a single cycle, for
 * newton.c.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "poisson.h"

#include "../boundary/fv_boundary.h"
#include "../grid/fv_grid.h"
#include "../operators/fv_operators.h"
#include "backend.h"

/* m^dim of computed cells, 0 of others: what the constant of psi is weighted by. */
static void set_volumes(const struct fv *s, struct poisson *p)
{
    p->volumes = 0.0;
    for (int k = 0; k < p->n; k++) {
        p->V[k] = s->free[p->place[k]] * s->m->V[p->place[k]];
        p->volumes += p->V[k];
    }
    MPI_Allreduce(MPI_IN_PLACE, &p->volumes, 1, MPI_DOUBLE, MPI_SUM, s->m->comm);
}

/* Rows are numbered rank by rank in the order of FLOW_ROWS; vectors of rows are shared by the
 * backends, no solve needs two. */
static void make_rows(const struct fv *s, struct poisson *p)
{
    int64_t first, n, k = 0;
    mesh_rows(s->m, s->m->rank, &first, &n);
    p->first = (int)first;
    p->n = (int)n;
    p->place = NEW_IN(p, int64_t, p->n);
    p->V = NEW_IN(p, double, p->n);
    p->b = NEW_IN(p, double, p->n);
    p->x = NEW_IN(p, double, p->n);
    p->psi = NEW_IN(p, double, p->n);
    FLOW_ROWS (s, c, len)
        for (int64_t i = c; i < c + len; i++)
            p->place[k++] = i;
    set_volumes(s, p);
}

void poisson_create(struct fv *s)
{
    static const struct backend *const all[] = {&backend_even, &backend_wet, &backend_pfmg,
                                                &backend_boomeramg};
    struct poisson *p = s->poisson = NEW_IN(s, struct poisson, 1);
    if (s->m)
        make_rows(s, p);
    for (size_t e = 0; !p->of; e++) {
        p->by = all[e];
        p->of = mem_own(p, p->by->create(s));
    }
}

/* Sum of f q^2; sums side by side, or each addition waits for the one before. */
static double squares(const double *restrict f, const double *restrict q, int64_t n)
{
    double part[SUM_LANES] = {0.0};
    int64_t i = 0;
    for (; i + SUM_LANES <= n; i += SUM_LANES)
        for (int k = 0; k < SUM_LANES; k++)
            part[k] += f[i + k] * q[i + k] * q[i + k];
    for (; i < n; i++)
        part[0] += f[i] * q[i] * q[i];
    return lanes_sum(part);
}

/* What rounding makes of divergences: nothing to solve for. div is 0 in cells that are not
 * computed. */
static bool negligible(struct fv *s, const double *div)
{
    double sum[2] = {0.0, 0.0};
    FLOW_ROWS (s, c, n) {
        sum[0] += squares(s->free + c, div + c, n);
        for (int64_t i = c; i < c + n && s->fringe.psi; i++)
            if (s->m->status[i] == CELL_FRINGE && s->fringe.psi[i] != 0.0)
                sum[0] = INFINITY;
        for (int a = 0; a < s->dim; a++)
            sum[1] += squares(s->free + c, s->U[a] + c, n);
    }
    MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, s->comm);
    return sum[0] <= 1e-27 * sum[1];
}

/* psi of the rows, less its mean over the computed volumes where no side gives the pressure. */
static void set_psi(struct fv *s, const struct poisson *p, const double *row, double *psi)
{
    double level = 0.0;
    if (!mesh_bc_pressure_given(s) && p->shift == 0.0) {
        for (int k = 0; k < p->n; k++)
            level += p->V[k] * row[k];
        level = ranks_sum(s->m->comm, level) / p->volumes;
    }
    memset(psi, 0, (size_t)s->size * sizeof(double));
    for (int k = 0; k < p->n; k++)
        if (s->m->status[p->place[k]] != CELL_HOLE)
            psi[p->place[k]] = row[k] - level;
}

/* Tolerances near rounding (1e-9) are taken as they are meant: a tenth. */
static double tolerance(const struct fv *s, double tol)
{
    const struct backend *by = s->poisson->by;
    if (tol > s->prm.tol_pressure)
        return by->stage * tol;
    return fmax(by->last * tol, fmin(by->stage * tol, 1e-9));
}

/* The start of the solver is kept apart from psi: of a singular problem psi has its mean taken out,
 * the start has not. */
static bool solve_rows(struct fv *s, double tau, double *div, double tol, double *start,
                       double *psi)
{
    struct poisson *p = s->poisson;
    double c = 0.0;
    if (negligible(s, div)) {
        memset(psi, 0, (size_t)s->size * sizeof(double));
        return true;
    }
    for (int k = 0; k < p->n; k++) {
        p->x[k] = start[p->place[k]];
        p->b[k] = -div[p->place[k]] / tau;
        if (s->fringe.psi && s->m->status[p->place[k]] == CELL_FRINGE)
            p->b[k] = s->fringe.psi[p->place[k]];
    }
    const bool good = p->by->solve(s, p->of, p->b, tolerance(s, tol), p->x, p->psi, &c);
    for (int k = 0; k < p->n; k++)
        start[p->place[k]] = p->x[k];
    set_psi(s, p, p->psi, psi);
    s->step.defect = fabs(c) * tau * p->volumes;
    return good;
}

bool poisson_solve(struct fv *s, double tau, double *div, double tol, double *start, double *psi)
{
    const struct backend *by = s->poisson->by;
    const bool good = by->solve_field ? by->solve_field(s, tau, div, tol, psi)
                                      : solve_rows(s, tau, div, tol, start, psi);
    if (s->ops->psi_ghosts)
        s->ops->psi_ghosts(s, psi);
    return good;
}

/* Where psi is known up to a constant the right side must sum to 0; that of Newton's residual does
 * not quite. */
static void cycle_rows(struct fv *s, double *div, double *psi)
{
    struct poisson *p = s->poisson;
    const bool singular = !mesh_bc_pressure_given(s) && p->shift == 0.0;
    double excess = 0.0;
    for (int k = 0; k < p->n; k++)
        excess += p->V[k] > 0.0 ? div[p->place[k]] : 0.0;
    MPI_Allreduce(MPI_IN_PLACE, &excess, 1, MPI_DOUBLE, MPI_SUM, s->comm);
    for (int k = 0; k < p->n; k++) {
        p->b[k] = p->V[k] > 0.0 ? div[p->place[k]] : 0.0;
        p->b[k] -= singular ? excess * p->V[k] / p->volumes : 0.0;
    }
    p->by->cycle(s, p->of, p->b, p->x);
    set_psi(s, p, p->x, psi);
}

void poisson_cycle(struct fv *s, double *div, double *psi)
{
    const struct backend *by = s->poisson->by;
    for (int k = 0; k < s->poisson->n; k++) /* of blocks: m^dim/s */
        div[s->poisson->place[k]] *= s->free[s->poisson->place[k]] * s->m->V[s->poisson->place[k]];
    if (by->cycle_field)
        by->cycle_field(s, div, psi);
    else
        cycle_rows(s, div, psi);
    if (s->ops->psi_ghosts)
        s->ops->psi_ghosts(s, psi);
}

void poisson_rebuild(struct fv *s)
{
    if (s->poisson) /* else the first matrix is of the surface as it is */
        s->poisson->by->rebuild(s, s->poisson->of);
}

void poisson_renew(struct fv *s, bool hierarchy)
{
    set_volumes(s, s->poisson);
    s->poisson->by->renew(s, s->poisson->of, hierarchy);
}

void poisson_shift(struct fv *s, double shift)
{
    s->poisson->shift = shift;
    if (s->poisson->by->shift)
        s->poisson->by->shift(s, s->poisson->of, shift);
}
