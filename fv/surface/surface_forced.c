/* surface_forced.c - see surface_forced.h. SPDX-License-Identifier: BSD-3-Clause */
#include "surface_forced.h"

#include "../../common/waves/waves.h"
#include "../boundary/fv_boundary.h"
#include "../grid/fv_grid.h"
#include "levelset.h"
#include "mesh_view.h"

/* --- cells and places --- */

/* Images of x[0] beyond closed sides of even cells, behind it: a wall cuts the water, not its
 * surface. Where both sides of an axis are within reach there are images of images: at most four
 * places along each axis, IMAGES_MOST in all. */
static int images(const struct fv *s, double R, double (*x)[3])
{
    const struct block *b = &s->b;
    int n = 1;
    for (int a = 0; a < b->dim; a++)
        for (int up = 0; up < 2 && !b->periodic[a]; up++) {
            const double side = b->origin[a] + (up ? b->length[a] : 0.0);
            const int before = n;
            if (fabs(x[0][a] - side) >= R)
                continue;
            for (int k = 0; k < before; k++, n++) {
                memcpy(x[n], x[k], sizeof x[n]);
                x[n][a] = 2.0 * side - x[k][a];
            }
        }
    return n;
}

static void list_places(const struct fv *s, struct surface_forced *f)
{
    double x[IMAGES_MOST][3];
    struct block_walls *walls = s->m ? block_walls_create(s->m) : NULL;
    int64_t room = 0;
    f->first = NEW_IN(f, int64_t, f->n + 1);
    for (int64_t i = 0; i < f->n; i++) {
        grid_place(&s->grid, f->cell[i], x[0]);
        const int n = walls ? block_walls_images(walls, f->R, x) : images(s, f->R, x);
        require(n <= IMAGES_MOST);
        if (f->first[i] + n > room) {
            const int64_t before = room;
            room = 2 * room + IMAGES_MOST;
            GROW_IN(f, f->x, 3 * before, 3 * room);
        }
        memcpy(f->x + 3 * f->first[i], x, (size_t)n * sizeof x[0]);
        f->first[i + 1] = f->first[i] + n;
    }
    f->nplaces = f->first[f->n];
    FREE(walls);
}

/* m: spacing of cells along any axis, of blocks that of a partner's and those beside them. */
static double largest(const struct fv *s, const struct surface_forced *f)
{
    double h = 0.0;
    for (int a = 0; a < s->dim && !s->m; a++)
        h = fmax(h, s->b.h[a]);
    for (int64_t i = 0; s->m && i < f->n; i++) {
        const struct part *p = grid_part(&s->grid, f->cell[i], NULL);
        const struct surface_mesh *w = s->surface->mesh;
        for (int a = 0; a < s->dim; a++)
            h = fmax(h, w->size[p - s->grid.part][a] / sqrt(w->K[a][a][f->cell[i]]));
    }
    return s->m ? ranks_max(s->comm, h) : h;
}

/* m: spacing of the partner's particles, of several the largest. */
static double coarsest_particles(const struct fv *s)
{
    char names[PARAM_PROGRAMS_MAX][64], key[80];
    const int n = params_programs(s->run->params, "sph", names);
    double dx[3], most = 0.0;
    for (int k = 0; k < n; k++) {
        snprintf(key, sizeof key, ":%.63s.dx", names[k]);
        if (params_peek(s->run->params, s->run->comm, key, dx))
            most = fmax(most, dx[0]);
    }
    return most;
}

/* Places and cells are found once for a forcing; the partner is asked there at each coupling step.
 */
struct surface_forced *surface_forced_create(const struct fv *s)
{
    const struct forcing *g = s->forcing;
    if (!g)
        return NULL;
    struct surface_forced *f = NEW(struct surface_forced, 1);
    f->cell = NEW_IN(f, int64_t, s->size);
    FLOW_ROWS (s, at, n)
        for (int64_t c = at; c < at + n; c++)
            if (g->forced[c] == 1 || grid_is_given(&s->grid, c))
                f->cell[f->n++] = c;
    f->nforced = f->n;
    f->holds = grid_all_computed(&s->grid) ? NULL : NEW_IN(f, bool, s->size);
    for (int64_t i = 0; i < f->n && f->holds; i++)
        f->holds[f->cell[i]] = true;
    for (int64_t i = g->npartner; i < g->npartner + g->nrim; i++)
        f->cell[f->n++] = g->partner[i];
    f->h = largest(s, f);
    f->R = fmax(2.0 * f->h, 4.0 * coarsest_particles(s)); /* fewer make noise */
    list_places(s, f);
    f->profile = NEW_IN(f, double, COLOUR_PARTS + 1);
    colour_profile(s->dim, f->profile);
    for (int k = 0; k < 2; k++) {
        f->phi[k] = NEW_IN(f, double, s->size);
        memcpy(f->phi[k], s->surface->phi, (size_t)s->size * sizeof(double));
        f->t[k] = s->t;
    }
    return f;
}

/* --- in time --- */

/* The next end is foreseen on the line through the last two, until the partner says otherwise. */
void surface_forced_shift(struct fv *s, double t0, double t1)
{
    struct surface_forced *f = s->surface->forced;
    double *now = f->phi[1], *next = f->phi[0];
    const double before = f->t[1] - f->t[0], share = before > 0.0 ? (t1 - t0) / before : 0.0;
    for (int64_t i = 0; i < f->n; i++) {
        const int64_t c = f->cell[i];
        next[c] = now[c] + share * (now[c] - next[c]);
    }
    f->phi[0] = now;
    f->phi[1] = next;
    f->t[0] = t0;
    f->t[1] = t1;
}

/* Mean over the free cells beside the outline of phi less the partner's, where both know it. */
static void look_at_step(struct fv *s, const double *phi)
{
    struct surface_forced *f = s->surface->forced;
    const double h = f->h;
    double sums[2] = {0.0, 0.0};
    for (int64_t i = f->nforced; i < f->n; i++) {
        const double own = s->surface->phi[f->cell[i]], theirs = phi[f->cell[i]];
        if (fabs(own) < h && fabs(theirs) < h) {
            sums[0] += own - theirs;
            sums[1] += 1.0;
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, s->comm);
    f->step = sums[1] > 0.0 ? sums[0] / sums[1] : 0.0;
}

void surface_forced_take(struct fv *s, const double *share)
{
    struct surface_forced *f = s->surface->forced;
    for (int64_t i = 0; i < f->n; i++) {
        double sum = 0.0;
        for (int64_t k = f->first[i]; k < f->first[i + 1]; k++)
            sum += share[k];
        f->phi[1][f->cell[i]] = colour_height(f->profile, f->R, sum);
    }
}

/* Far from the surface phi is what the field itself has made of it, if the sides agree. */
void surface_forced_impose(struct fv *s, double t)
{
    struct surface_forced *f = s->surface->forced;
    double *phi = s->surface->phi;
    const double T = f->t[1] - f->t[0], part = T > 0.0 ? (t - f->t[0]) / T : 0.0;
    if (part > 1.0 - 1e-9) /* phi of the free cells is of that time, too */
        look_at_step(s, f->phi[1]);
    for (int64_t i = 0; i < f->nforced; i++) {
        const int64_t c = f->cell[i];
        const double v = f->phi[0][c] + part * (f->phi[1][c] - f->phi[0][c]);
        if (fabs(v) < 0.95 * colour_reach(f->R) || (v < 0.0) != (phi[c] < 0.0))
            phi[c] = v;
    }
    surface_ghosts(s, phi);
}
