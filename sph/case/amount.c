/* amount.c - see amount.h. A cell with filled cells all around is full; of the others, which shapes
 * or walls may cut, 64 places on a lattice of their own are asked, turned so that a level across an
 * axis is known to a 128th of a cell.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "amount.h"

#include "../../common/scene/scene.h"
#include "../sph.h"
#include "first_lattice.h"
#include "rooms.h"
#include "sph_sense.h"

static const double least_told = 0.005; /* of the water */

/* Whether a cell has filled and unfilled ones around it, itself among them; beyond the lattice is
 * none. */
static void look_around(const struct sph *s, const struct lattice *l, int64_t cell, bool *any,
                        bool *all)
{
    int ic[3], jc[3];
    lattice_indices(l, cell, ic);
    *any = false;
    *all = true;
    for (int k = 0; k < (s->dim == 3 ? 27 : 9); k++) {
        const int way[3] = {k % 3 - 1, k / 3 % 3 - 1, s->dim == 3 ? k / 9 - 1 : 0};
        bool in = true;
        for (int a = 0; a < 3; a++) {
            jc[a] = ic[a] + way[a];
            if (s->periodic[a])
                jc[a] = (jc[a] + l->n[a]) % l->n[a];
            in = in && jc[a] >= 0 && jc[a] < l->n[a];
        }
        const bool filled = in && lattice_has(l, lattice_cell(l, jc));
        *any = *any || filled;
        *all = *all && filled;
    }
}

/* Whether x is on the water's side of open lines: some filled cell around has no line before it. */
static bool is_before_lines(const struct sph *s, const struct lattice *l, const double *x)
{
    bool sees = false;
    for (int k = 0; k < 9 && !sees; k++) {
        const double near[3] = {x[0] + (k % 3 - 1) * l->dx, x[1] + (k / 3 - 1) * l->dx, 0.0};
        const int64_t cell = lattice_find(l, s->dim, near);
        double c[3] = {0.0, 0.0, 0.0};
        if (cell < 0 || !lattice_has(l, cell))
            continue;
        lattice_place(l, cell, s->dim, c);
        sees = !sph_falls_stopped(&s->run->scene, x, (double[3]){c[0] - x[0], c[1] - x[1], 0.0});
    }
    return sees;
}

/* Share of a cell that is water; lines: open ones are to be asked for. */
static double share_of(const struct sph *s, const struct lattice *l, const struct exact *e,
                       bool lines, const double *centre)
{
    enum { PLACES = 64 };
    static const int stride[3] = {1, 19, 37}; /* so that along each axis all places differ */
    int n = 0;
    for (int k = 0; k < PLACES; k++) {
        double x[3] = {centre[0], centre[1], centre[2]};
        for (int a = 0; a < s->dim; a++)
            x[a] += ((k * stride[a] % PLACES + 0.5) / PLACES - 0.5) * s->dx;
        n += scene_is_fluid(&s->run->scene, e, x, NULL) && first_in_walls(s, x) &&
             (!lines || is_before_lines(s, l, x));
    }
    return (double)n / PLACES;
}

struct asked {
    struct exact exact;
    bool lines;
    double cells; /* water in cells */
};

/* Cells without filled ones around hold nothing; full ones need not be asked, which leaves the rim.
 */
static void add_cell(struct sph *s, const struct lattice *l, int64_t cell, const double *centre,
                     void *ctx)
{
    struct asked *to = ctx;
    bool any, all;
    look_around(s, l, cell, &any, &all);
    if (any)
        to->cells += all ? 1.0 : share_of(s, l, &to->exact, to->lines, centre);
}

/* Where meshes part rooms or sides are open the shapes do not say how much water is meant. */
void amount_check(struct sph *s, const struct lattice *l)
{
    if (rooms_parted(s) || s->zones)
        return;
    struct asked asked = {.exact = exact_create(&s->run->scene),
                          .lines = scene_has_open_lines(&s->run->scene)};
    first_lattice_each_own(s, l, add_cell, &asked);
    double sums[2] = {asked.cells * s->dxD, 0.0};
    for (int i = 0; i < s->p.n; i++)
        sums[1] += state_row(&s->p, s->p.y, i)[at_volume(s->dim)];
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, s->run->comm);
    const double off = sums[1] / sums[0] - 1.0;
    if (fabs(off) > least_told)
        log_warn(
            "the first particles hold %.2g %% %s than the shapes: %.4g of %.4g m^%d; a smaller "
            "sph.dx than %g m follows them more closely",
            100.0 * fabs(off), off > 0.0 ? "more" : "less", sums[1], sums[0], s->dim, s->dx);
}
