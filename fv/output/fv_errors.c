/* fv_errors.c - what the series and the summary hold on all grids: errors against exact cell
 * averages, energies, over the computed cells; what even cells alone have.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "report.h"

#include <math.h>
#include <string.h>

#include "../../common/base/mem.h"
#include "../boundary/bc.h"
#include "../boundary/blocked.h"
#include "../boundary/forcing.h"
#include "../boundary/mesh_bc.h"
#include "../boundary/still.h"
#include "../coupling/water_budget.h"
#include "../grid/mesh.h"
#include "../grid/overset.h"
#include "../operators/mesh_ops.h"
#include "../surface/levelset.h"
#include "mesh_output.h"
#include "output.h"

void fv_vorticity(const struct fv *s, double *w)
{
    const struct block *b = &s->b;
    BLOCK_ROWS_AT (b, 0, j, c, n)
        for (int64_t i = c; i < c + n; i++)
            w[i] = block_derivative(b, s->u[1] + i, 0, j) - block_derivative(b, s->u[0] + i, 1, j);
}

/* What a cell has: its volume, m^dim, 0 where none is computed, centre and sides. */
struct cell {
    double volume, x[3], h[3];
};

static struct cell cell_at(const struct fv *s, const struct part *p, const int *i, int64_t c)
{
    struct cell of = {.volume = 0.0};
    if (s->m && s->free[c] > 0.0) {
        const struct mesh_block *b = s->m->block + p->block;
        const int at[3] = {p->lo[0] + i[0], p->lo[1] + i[1], p->lo[2] + i[2]};
        memcpy(of.x, b->centre[mesh_cell(b, at)], sizeof of.x);
        of.volume = s->m->V[c];
        of.h[0] = of.h[1] = of.h[2] = pow(of.volume, 1.0 / s->dim);
    } else if (!s->m && !(s->forcing && s->forcing->forced[c])) {
        block_cell(&s->b, i[0], i[1], i[2], of.x, of.h);
        of.volume = of.h[0] * of.h[1] * of.h[2];
    }
    return of;
}

/* Averages of the exact solution there. */
static void exact_at(const struct fv *s, const struct part *p, const int *i, const struct cell *of,
                     double u[3], double *pressure, double *w)
{
    if (s->m)
        mesh_exact_average(s, p, i, s->t, u, pressure, w);
    else
        exact_average(&s->exact, of->x, of->h, s->t, u, pressure, w);
}

/* Visits the computed cells: i (int[3]) has place c, `of' what it has. */
#define COMPUTED_CELLS(s, p, i, c, of)                                                             \
    for (const struct part *p = (s)->part; p < (s)->part + (s)->nparts; p++)                       \
        PART_CELLS (p, i, c)                                                                       \
            for (struct cell of = cell_at(s, p, i, c); of.volume > 0.0; of.volume = 0.0)

void fv_errors(struct fv *s, struct norm n[NORMS])
{
    double *vorticity = NEW(double, s->size), u[3], p, w;
    int i[3];
    if (s->m)
        mesh_vorticity(s, vorticity);
    else
        fv_vorticity(s, vorticity);
    for (int k = 0; k < NORMS; k++)
        n[k] = (struct norm){0};
    COMPUTED_CELLS (s, part, i, c, of) {
        exact_at(s, part, i, &of, u, &p, &w);
        for (int a = 0; a < s->dim; a++)
            norm_add(n, of.volume, s->u[a][c] - u[a], u[a]);
        norm_add(n + 1, of.volume, fv_pressure(s, c) + fv_still_in_exact(s, of.x) - p, p);
        norm_add(n + 2, of.volume, vorticity[c] - w, w);
    }
    mem_free(vorticity);
    norm_reduce(n, NORMS, s->comm);
}

void fv_energies(struct fv *s, double sum[2])
{
    double u[3] = {0.0, 0.0, 0.0}, p, w;
    int i[3];
    sum[0] = s->surface ? surface_energy(s) : 0.0;
    sum[1] = 0.0;
    if (s->surface)
        return;
    COMPUTED_CELLS (s, part, i, c, of) {
        if (s->has_exact)
            exact_at(s, part, i, &of, u, &p, &w);
        for (int a = 0; a < s->dim; a++) {
            sum[0] += 0.5 * of.volume * s->u[a][c] * s->u[a][c];
            sum[1] += 0.5 * of.volume * u[a] * u[a];
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, s->comm);
}

double fv_curl_squared(const struct fv *s, int64_t c, int j)
{
    const struct block *b = &s->b;
    double sum = 0.0;
    for (int a = b->dim == 3 ? 0 : 2; a < 3; a++) { /* d_p u_q - d_q u_p */
        double w = 0.0;
        for (int k = 0; k < 2; k++) {
            const int along = (a + 1 + k) % 3, of = (a + 2 - k) % 3;
            w += (k ? -1.0 : 1.0) * block_derivative(b, s->u[of] + c, along, j);
        }
        sum += w * w;
    }
    return sum;
}

/* Over the cells outside of the partner's part; where blocks overlap those of the latest count. */
void fv_tell(void *state, struct summary *report)
{
    static const char *const names[] = {"sum.kinetic", "sum.enstrophy", "sum.signal",
                                        "sum.potential", "sum.water"};
    struct fv *s = state;
    struct overset *o = s->m && s->m->has_fringe ? overset_search(s->run, s->m) : NULL;
    const double rho = s->run->scene.fluid.rho, *g = s->run->scene.fluid.gravity;
    double sum[5] = {0.0, 0.0, 0.0, 0.0, 0.0};
    int i[3];
    COMPUTED_CELLS (s, p, i, c, of) {
        const double *x = of.x;
        if (o && mesh_counts_twice(s, o, p->block, x))
            continue;
        const double u[3] = {s->u[0][c], s->u[1][c], s->dim == 3 ? s->u[2][c] : 0.0};
        const double wet = s->surface ? surface_water(s, c) : 1.0;
        const double part = of.volume * wet * water_budget_share(s, x, of.h);
        sum[0] += 0.5 * rho * part * (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
        sum[1] += 0.5 * part * (s->m ? mesh_curl_squared(s, p, c) : fv_curl_squared(s, c, i[1]));
        sum[2] += rho * part * exact_signal(&s->exact, x, u);
        sum[3] -= rho * part * (g[0] * x[0] + g[1] * x[1] + g[2] * x[2]);
        sum[4] += part;
    }
    overset_free(&o);
    MPI_Allreduce(MPI_IN_PLACE, sum, 5, MPI_DOUBLE, MPI_SUM, s->comm);
    for (int k = 0; k < (s->surface ? 5 : 4); k++)
        summary_real(report, names[k], sum[k]);
}

/* Largest divergence of the fluxes, 1/s: what the projection left. */
static double largest_divergence(struct fv *s)
{
    const struct block *b = &s->b;
    double most = 0.0;
    BLOCK_ROWS_AT (b, 0, j, c, n)
        for (int64_t i = c; i < c + n; i++) {
            double div = 0.0;
            if ((s->forcing && s->forcing->forced[i]) || (s->surface && s->surface->layer[i]))
                continue;
            for (int a = 0; a < b->dim; a++)
                div += (s->U[a][i + b->stride[a]] - s->U[a][i]) / block_size(b, a, j);
            most = fmax(most, fabs(div));
        }
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, b->cart);
    return most;
}

static double cells_of(const struct fv *s)
{
    double cells = 1.0;
    for (int a = 0; a < s->b.dim; a++)
        cells *= s->b.cells[a];
    return cells;
}

static int force_columns(const struct run *r, const struct fv_params *prm, const char **columns)
{
    static const char *const names[] = {"force x [N]", "force y [N]", "force z [N]"};
    const bool any = r->scene.nwalls > 0 || prm->nboxes > 0;
    int n = 0;
    for (int a = 0; any && a < r->scene.domain.dim; a++)
        columns[n++] = names[a];
    return n + fv_blocked_columns(r, prm, columns + n);
}

/* On all walls and boxes, then on each box. */
static int forces(struct fv *s, double *values)
{
    const int boxes = s->blocked ? s->prm.nboxes : 0, n = s->bc || boxes > 0 ? s->dim : 0;
    double force[3] = {0.0, 0.0, 0.0};
    if (s->bc)
        fv_wall_force(s, force);
    fv_blocked_forces(s, values + n);
    for (int a = 0; a < n; a++) {
        values[a] = force[a];
        for (int k = 0; k < boxes; k++)
            values[a] += values[n + k * s->dim + a];
    }
    return n + boxes * s->dim;
}

static void summarise_forces(struct fv *s)
{
    static const char *const names[] = {"force.x", "force.y", "force.z"};
    double values[3 + 3 * BLOCKED_MAX];
    const int n = forces(s, values);
    for (int a = 0; n > 0 && a < s->dim; a++)
        summary_real(s->run->summary, names[a], values[a]);
}

static void summarise(struct fv *s)
{
    summarise_forces(s);
    if (s->surface) {
        surface_summarise(s);
        steady_summarise(s);
    }
    fv_summarise_blocked(s);
}

const struct report even_report = {.largest_divergence = largest_divergence,
                                   .cells = cells_of,
                                   .force_columns = force_columns,
                                   .forces = forces,
                                   .probes = fv_probe,
                                   .summarise = summarise,
                                   .extrema = fv_summarise_extrema};
