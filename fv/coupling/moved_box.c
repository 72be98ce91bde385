/* moved_box.c - see moved_box.h. Called at the start of a coupling step (fv_coupling.c) once a box
 * has moved. On uniform cells new lists are made and compared with the old ones; blocks are cut
 * anew only if the set of cells in the box has changed. Then values go from the old lists to the
 * new ones, and the pressure equation is set up anew.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "moved_box.h"

#include "../boundary/fv_boundary.h"
#include "../grid/fv_grid.h"
#include "../operators/fv_operators.h"
#include "../poisson/poisson.h"
#include "../surface/fv_surface.h"
#include "../time/fv_time.h"

/* Whether any rank's imposed cells are others. Collective. */
static bool differs(const struct fv *s, const struct forcing *f)
{
    return ranks_any(s->comm, memcmp(f->forced, s->forcing->forced, (size_t)s->size) != 0);
}

/* Fills the new lists with the partner's values where the old lists had them, else with FV's own at
 * the same times. */
static void carry(const struct fv *s, struct forcing *to)
{
    const struct forcing *from = s->forcing;
    double *field = NEW(double, s->size);
    for (int m = 0; m < 3; m++)
        for (int a = 0; a < s->dim; a++) {
            const double *v = m == 0 ? from->v_next[a] : m == 1 ? from->v[a] : from->v_old[a];
            double *w = m == 0 ? to->v_next[a] : m == 1 ? to->v[a] : to->v_old[a];
            memcpy(field, m == 0 ? s->u[a] : s->partners.past[m - 1][a],
                   (size_t)s->size * sizeof *field);
            for (int64_t i = 0; i < from->npartner + from->nrim; i++)
                field[from->partner[i]] = v[i];
            for (int64_t i = 0; i < to->npartner + to->nrim; i++)
                w[i] = field[to->partner[i]];
        }
    mem_free(field);
    to->t0 = from->t0;
    to->t1 = from->t1;
    to->t_old = from->t_old;
    to->levels = from->levels;
    to->inflow = from->inflow;
}

/* Takes over the partner's surface of the last coupling step where both lists have it. */
static void carry_surface(struct fv *s, struct surface_forced *from)
{
    struct surface_forced *to = mem_own(s->surface, surface_forced_create(s));
    for (int k = 0; k < 2; k++) {
        to->t[k] = from->t[k];
        for (int64_t i = 0; i < from->n; i++)
            to->phi[k][from->cell[i]] = from->phi[k][from->cell[i]];
    }
    s->surface->forced = to;
    FREE(from);
}

/* --- blocks --- */

/* Copies what the cells of all blocks are (freed by the caller). Those deep in the box count as
 * imposed: where they come near free cells, the partner has values for them. */
static void copy_status(const struct mesh *m, unsigned char *was[MESH_BLOCKS_MAX])
{
    for (int k = 0; k < m->nblocks; k++) {
        const struct mesh_block *b = m->block + k;
        was[k] = NEW(unsigned char, mesh_count(b));
        memcpy(was[k], b->status, (size_t)mesh_count(b));
        for (int64_t c = 0; c < mesh_count(b); c++)
            if (was[k][c] == CELL_HOLE && mesh_given_holds(m, b, c))
                was[k][c] = CELL_GIVEN;
    }
}

/* Twice in turn: all is as before. */
static void swap_status(struct mesh *m, unsigned char *was[MESH_BLOCKS_MAX])
{
    for (int k = 0; k < m->nblocks; k++) {
        unsigned char *const now = m->block[k].status;
        m->block[k].status = was[k];
        was[k] = now;
    }
}

enum { PAST = 10 };

/* Velocities of now and before, and the surface. Returns their number. */
static int past_fields(const struct fv *s, double **f)
{
    int n = 0;
    for (int a = 0; a < s->dim; a++) {
        f[n++] = s->u[a];
        f[n++] = s->partners.past[0][a];
        f[n++] = s->partners.past[1][a];
    }
    if (s->surface)
        f[n++] = s->surface->phi;
    return n;
}

/* Cells that later blocks hid and that the box has now come to get values from those blocks, as
 * these were cut before. Collective. */
static void fill_hidden(struct fv *s, unsigned char *was[MESH_BLOCKS_MAX])
{
    struct mesh *m = s->m;
    unsigned char *wanted[MESH_BLOCKS_MAX];
    double *f[PAST];
    const int n = past_fields(s, f);
    bool any = false;
    for (int k = 0; k < m->nblocks; k++) {
        const struct mesh_block *b = m->block + k;
        wanted[k] = NEW(unsigned char, mesh_count(b));
        for (int64_t c = 0; c < mesh_count(b); c++) {
            wanted[k][c] = was[k][c] == CELL_HOLE && b->status[c] == CELL_GIVEN;
            any = any || wanted[k][c];
        }
    }
    if (any && m->has_fringe) {
        swap_status(m, was);
        overset_interpolate(m, m->search, wanted, n, f);
        swap_status(m, was);
    }
    for (int k = 0; k < m->nblocks; k++)
        mem_free(wanted[k]);
}

/* Copies to `why' what the lowest rank with a cell without donors says of it. Collective. */
static void tell_trouble(const struct fv *s, char why[256])
{
    const bool mine = *s->m->trouble != '\0';
    if (mine)
        snprintf(why, 256, "%.255s", s->m->trouble);
    (void)ranks_first(s->comm, mine, why, 256);
}

/* Cuts the blocks around the box and renews which cells are free. */
static void cut(struct fv *s, const double (*box)[2][3])
{
    mesh_recut(s->m, box);
    moving_set_free(s);
}

/* Makes the lists of blocks cut around the box. NULL: the place is none for FV, and blocks are as
 * before. */
static struct forcing *cut_anew(struct fv *s, const double (*box)[2][3], char why[256])
{
    struct mesh *m = s->m;
    const struct mesh_boxes old = m->given;
    unsigned char *was[MESH_BLOCKS_MAX], *local = NEW(unsigned char, s->size);
    double *f[PAST];
    const int n = past_fields(s, f);
    memcpy(local, m->status, (size_t)s->size);
    mesh_fill(m, 1, &s->p);
    mesh_fill(m, n, f);
    copy_status(m, was);
    cut(s, box);
    tell_trouble(s, why);
    struct forcing *to = *why ? NULL : forcing_create(s, 1, NULL, true);
    if (to)
        fill_hidden(s, was);
    else
        cut(s, (const double(*)[2][3])old.box);
    *m->trouble = '\0';
    for (int64_t c = 0; s->partners.born && to && c < s->size; c++)
        s->partners.born[c] = m->status[c] == CELL_COMPUTED && local[c] != CELL_COMPUTED;
    s->partners.born_at = s->t;
    for (int k = 0; k < m->nblocks; k++)
        mem_free(was[k]);
    mem_free(local);
    return to;
}

void moved_box_renew(struct fv *s)
{
    viscous_solver_renew(s);
    DROP(s->poisson);
    poisson_create(s);
}

/* --- both --- */

/* past has velocities at the starts of this coupling step and the one before; blocks get AHEAD more
 * layers of imposed cells. */
void moved_box_prepare(struct fv *s, const double (*box)[2][3])
{
    for (int m = 0; m < 2; m++)
        for (int a = 0; a < s->dim; a++)
            s->partners.past[m][a] = NEW_IN(s, double, s->size);
    if (!s->m)
        return;
    if (s->prm.integrator == INTEGRATOR_BDF2)
        s->partners.born = NEW_IN(s, unsigned char, s->size);
    s->m->search = mem_own(s->m, overset_search(s->run, s->m));
    s->m->given.layers += AHEAD;
    cut(s, box);
}

/* Makes the lists for these boxes; NULL: they are the same, or none can be. Pressures are extended
 * into the imposed cells first, for those that come free. */
static struct forcing *new_lists(struct fv *s, int n, const double (*box)[2][3], char why[256])
{
    if (s->m && !mesh_recut_wanted(s->m, box))
        return NULL;
    struct forcing *f = s->m ? NULL : forcing_create(s, n, box, true);
    if (f && !differs(s, f)) {
        FREE(f);
        return NULL;
    }
    if (f || s->m) {
        forcing_extend(s, s->forcing->near, s->p);
        forcing_extend(s, s->forcing->near, s->p_before);
    }
    if (s->m)
        f = cut_anew(s, box, why);
    if (!f && !*why)
        snprintf(
            why, 256, "no cell of fv lies wholly in (%g, %g, %g) to (%g, %g, %g) m, what sph gives",
            box[0][0][0], box[0][0][1], box[0][0][2], box[0][1][0], box[0][1][1], box[0][1][2]);
    return f;
}

/* With a surface the volume before decides what surface_interface_moved restores. */
bool moved_box(struct fv *s, int n, const double (*box)[2][3], char why[256])
{
    *why = '\0';
    struct forcing *f = new_lists(s, n, box, why);
    if (!f)
        return false;
    carry(s, f);
    const double before = s->surface ? surface_volume(s) : 0.0;
    DROP(s->forcing);
    s->forcing = mem_own(s, f);
    if (s->surface)
        carry_surface(s, s->surface->forced);
    if (s->m || !s->surface)
        moved_box_renew(s);
    if (s->surface) {
        surface_interface_moved(s, before);
        return true;
    }
    if (s->m && sides_give_pressure(s) && f->net == NET_OTHERS)
        snprintf(why, 256,
                 "what flows through the interface of the cells that sph gives, in blocks that "
                 "overlap there, cannot be balanced, and with an outflow the pressure oscillates");
    return true;
}
