/* fv_errors.c - what the series and the summary hold on all grids: errors against exact cell
 * averages, energies, over the computed cells.
 * SPDX-License-Identifier: BSD-3-Clause */

#include "../boundary/fv_boundary.h"
#include "../coupling/fv_coupling.h"
#include "../grid/fv_grid.h"
#include "../operators/fv_operators.h"
#include "../surface/fv_surface.h"
#include "mesh_output.h"
#include "output.h"

/* Cells that later blocks compute, too; NULL: none. */
static const bool *counted_twice(const struct fv *s)
{
    return s->m ? mesh_twice(s->run, s->m, mesh_stays(s)) : NULL;
}

/* A cell's volume, m^dim, 0 where none is computed, and its centre. */
struct cell {
    double volume, x[3];
};

static struct cell cell_at(const struct fv *s, const struct part *p, const int *i, int64_t c)
{
    struct cell of = {.volume = 0.0};
    if (!forcing_is_free(s, c))
        return of;
    of.volume = grid_volume(&s->grid, c);
    grid_centre(&s->grid, p, i, of.x);
    return of;
}

/* Visits the computed cells: i (int[3]) has place c, `of' what it has. */
#define COMPUTED_CELLS(s, p, i, c, of)                                                             \
    for (const struct part *p = (s)->grid.part; p < (s)->grid.part + (s)->grid.nparts; p++)        \
        PART_CELLS (p, i, c)                                                                       \
            for (struct cell of = cell_at(s, p, i, c); of.volume > 0.0; of.volume = 0.0)

/* n: velocity, pressure, vorticity. On blocks u, p and vorticity are averages over indices, and so
 * are the exact ones; where blocks overlap cells of the latest count. Collective. */
void fv_errors(struct fv *s, struct norm n[NORMS])
{
    double *vorticity = NEW(double, s->size), u[3], p, w;
    const bool *twice = counted_twice(s);
    int i[3];
    flow_vorticity(s, vorticity);
    for (int k = 0; k < NORMS; k++)
        n[k] = (struct norm){0};
    COMPUTED_CELLS (s, part, i, c, of) {
        if (twice && twice[c])
            continue;
        cell_exact(s, part, i, s->t, u, &p, &w);
        for (int a = 0; a < s->dim; a++)
            norm_add(n, of.volume, s->u[a][c] - u[a], u[a]);
        norm_add(n + 1, of.volume, fv_pressure(s, c) + fv_still_in_exact(s, of.x) - p, p);
        norm_add(n + 2, of.volume, vorticity[c] - w, w);
    }
    mem_free(vorticity);
    norm_reduce(n, NORMS, s->comm);
}

/* Half of a slope over the distance of two cells is that over one: on layers of unequal height. */
static double share_of_step(const struct fv *s, int64_t c, int b)
{
    const int j = s->b.rows ? block_row(&s->b, c) : 0;
    return s->m ? 0.5
                : block_size(&s->b, b, j) / (block_step(&s->b, b, j) + block_step(&s->b, b, j + 1));
}

/* m^2/s^2: mean of u^2 over a cell less the square of its average, of fourth order: 1/12 of the
 * squares of slopes s. On blocks averages are over indices, and volumes V vary: the mean of V f is
 * <V><f> + s(V) s(f)/12. Without it the energy of a flow that is carried through cells of different
 * size swings (vortices through waving cells, 28 x 28: by 0.16 %). */
static double square_within(const struct fv *s, const struct part *p, int64_t c)
{
    double sum = 0.0;
    for (int b = 0; b < s->dim; b++) {
        const int64_t d = p->stride[b];
        const double part = share_of_step(s, c, b), *V = s->m ? s->m->V + c : NULL,
                     bend = V && V[d] > 0.0 && V[-d] > 0.0 ? part * (V[d] - V[-d]) / V[0] : 0.0;
        for (int a = 0; a < s->dim && !is_blocked(s, c - d) && !is_blocked(s, c + d); a++) {
            const double slope = part * (s->u[a][c + d] - s->u[a][c - d]);
            sum += slope * (slope + 2.0 * s->u[a][c] * bend);
        }
    }
    return sum / 12.0;
}

/* sum[0]: of averages, int u^2/2, sum[1]: of the exact ones, sum[2]: what the velocity within cells
 * adds to sum[0], m^(dim+2)/s^2; with a surface of the water alone, and without sum[2]. Collective.
 */
void fv_energies(struct fv *s, double sum[3])
{
    const bool *twice = s->surface ? NULL : counted_twice(s);
    double u[3] = {0.0, 0.0, 0.0}, p, w;
    int i[3];
    sum[0] = s->surface ? surface_energy(s) : 0.0;
    sum[1] = sum[2] = 0.0;
    if (s->surface)
        return;
    grid_halo(&s->grid, s->dim, s->u);
    COMPUTED_CELLS (s, part, i, c, of) {
        if (twice && twice[c])
            continue;
        if (s->prm.errors)
            cell_exact(s, part, i, s->t, u, &p, &w);
        for (int a = 0; a < s->dim; a++) {
            sum[0] += 0.5 * of.volume * s->u[a][c] * s->u[a][c];
            sum[1] += 0.5 * of.volume * u[a] * u[a];
        }
        sum[2] += 0.5 * of.volume * square_within(s, part, c);
    }
    MPI_Allreduce(MPI_IN_PLACE, sum, 3, MPI_DOUBLE, MPI_SUM, s->comm);
}

/* Over the cells outside of the partner's part; where blocks overlap those of the latest count. A
 * cell counts by the share that no box of a partner counts; a force along a period has no
 * potential. Collective. */
void fv_tell(void *state, struct summary *report)
{
    static const char *const names[] = {"sum.kinetic", "sum.enstrophy", "sum.signal",
                                        "sum.potential", "sum.water"};
    struct fv *s = state;
    const bool *twice = counted_twice(s);
    const double rho = s->run->scene.fluid.rho;
    double sum[5] = {0.0, 0.0, 0.0, 0.0, 0.0}, g[3];
    int i[3];
    (void)scene_still_gravity(&s->run->scene, g);
    COMPUTED_CELLS (s, p, i, c, of) {
        const double *x = of.x;
        if (twice && twice[c])
            continue;
        const double u[3] = {s->u[0][c], s->u[1][c], s->dim == 3 ? s->u[2][c] : 0.0};
        const double wet = s->surface ? surface_water(s, c) : 1.0;
        double h[3];
        grid_box(&s->grid, p, i, h);
        const double part = of.volume * wet * water_budget_share(s, x, h);
        sum[0] += 0.5 * rho * part * (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
        sum[1] += 0.5 * part * flow_curl_squared(s, p, c);
        sum[2] += rho * part * exact_signal(&s->exact, x, u);
        sum[3] -= rho * part * (g[0] * x[0] + g[1] * x[1] + g[2] * x[2]);
        sum[4] += part;
    }
    MPI_Allreduce(MPI_IN_PLACE, sum, 5, MPI_DOUBLE, MPI_SUM, s->comm);
    for (int k = 0; k < (s->surface ? 5 : 4); k++)
        summary_real(report, names[k], sum[k]);
}
