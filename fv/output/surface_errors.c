/* surface_errors.c - what the water does as a whole: energy, reach, period and damping of a
 * standing wave. SPDX-License-Identifier: BSD-3-Clause */

#include "../boundary/fv_boundary.h"
#include "../operators/fv_operators.h"
#include "../surface/fv_surface.h"
#include "output.h"

/* m^(dim+2)/s^2, over rho. Collective. */
double surface_energy(const struct fv *s)
{
    double sum = 0.0;
    FLOW_NEAR_AT (s, part, j, c, n)
        for (int64_t i = c; i < c + n; i++) {
            double square = 0.0;
            if (s->forcing && s->forcing->forced[i])
                continue;
            for (int a = 0; a < s->dim; a++)
                square += s->u[a][i] * s->u[a][i];
            sum += square > 0.0 ? 0.5 * square * surface_water(s, i) * surface_cell_volume(s, i, j)
                                : 0.0;
        }
    return ranks_sum(s->comm, sum);
}

/* Where along a the water ends that is in cell c, m from its centre; the end must be within `most'
 * cells. NAN: it is not. Linear between the last wet and the first dry centre. */
static double end_of_water(const struct fv *s, int64_t c, int a, int most)
{
    const double *phi = s->surface->phi;
    const int64_t d = s->b.stride[a];
    int m = 0;
    while (m < most && phi[c + m * d] < 0.0 && !is_blocked(s, c + (m + 1) * d))
        m++;
    if (m > 0 && phi[c + m * d] >= 0.0)
        return (m - 1 + phi[c + (m - 1) * d] / (phi[c + (m - 1) * d] - phi[c + m * d])) * s->b.h[a];
    return NAN;
}

/* The same on the wall that cell (i, j, k) touches across a: the foot of a tongue lies before its
 * end half a cell higher, by as much as that end lies before the one in the next layer, at most a
 * cell. */
static double foot_of_water(const struct fv *s, const int *at, int64_t c, int a)
{
    const struct block *b = &s->b;
    const double end = end_of_water(s, c, a, 1);
    double more = 0.0;
    for (int t = 0; t < b->dim && isfinite(end); t++)
        for (int up = 0; up < 2; up++) {
            const int64_t in = up ? -b->stride[t] : b->stride[t];
            if (t == a || b->periodic[t] || b->lo[t] + at[t] != (up ? b->cells[t] - 1 : 0))
                continue;
            double next = NAN;
            for (int m = 0; m <= 2 && !isfinite(next); m++)
                next = end_of_water(s, c + in - m * b->stride[a], a, 1) - m * b->h[a];
            more = fmax(more, isfinite(next) ? fmin(0.5 * (end - next), b->h[a]) : b->h[a]);
        }
    return end + more;
}

/* What foot_of_water adds, on blocks: to the place `end' along axis a of the surface between cell i
 * of a part and that at step d. out[] marks cells behind sides. */
static double foot_on_blocks(const struct fv *s, const struct part *p, int64_t i, int64_t d, int a,
                             double end)
{
    const struct surface_mesh *w = s->surface->mesh;
    const double *phi = s->surface->phi, *x = w->x[a], h = fabs(x[i + d] - x[i]);
    double more = 0.0;
    for (int b = 0; b < 2 * s->dim; b++) {
        const int64_t in = b % 2 ? -p->stride[b / 2] : p->stride[b / 2];
        double next = NAN;
        if (llabs(d) == p->stride[b / 2] || !w->out[i - in])
            continue;
        for (int m = 0; m <= 2 && !isfinite(next); m++) {
            const int64_t k = i + in - m * d;
            if (!w->out[k] && !w->out[k + d] && phi[k] < 0.0 && phi[k + d] >= 0.0)
                next = x[k] + phi[k] / (phi[k] - phi[k + d]) * (x[k + d] - x[k]);
        }
        more = fmax(more, isfinite(next) ? fmin(0.5 * (end - next), h) : h);
    }
    return more;
}

/* Whether there is water of the flow, or of a partner, in the cell. */
static bool has_water(const struct fv *s, int64_t c)
{
    const struct surface_forced *p = s->surface->forced;
    return s->surface->phi[c] < 0.0 &&
           (s->m->status[c] == CELL_COMPUTED || (p && p->holds && p->holds[c]));
}

/* On blocks: to the surface along the indices, or to a wall. Along all indices, since none need run
 * along axis a. Collective. */
static double reach_on_blocks(const struct fv *s, int a)
{
    const struct surface_mesh *w = s->surface->mesh;
    const double *phi = s->surface->phi, *x = w->x[a];
    double most = -INFINITY;
    FLOW_ROWS_AT (s, part, j, c, n)
        for (int64_t i = c; i < c + n; i++)
            for (int b = 0; b < 2 * s->dim && has_water(s, i); b++) {
                const int64_t d = b % 2 ? part->stride[b / 2] : -part->stride[b / 2], to = i + d;
                const bool inside = w->out[to] || phi[to] < 0.0;
                const double way = inside ? 0.5 : phi[i] / (phi[i] - phi[to]);
                const double end = x[i] + way * (x[to] - x[i]);
                most = fmax(most, end);
                if (!inside && end > x[i])
                    most = fmax(most, end + foot_on_blocks(s, part, i, d, a, end));
            }
    return ranks_max(s->comm, most);
}

/* The way `end' along axis a from the centre of the cell at c, at most that to a box there. */
static double up_to_box(const struct fv *s, int64_t c, int a, double end)
{
    const int64_t d = s->b.stride[a];
    for (int m = 2; m >= 1; m--)
        if (is_blocked(s, c + m * d))
            end = fmin(end, (m - 0.5) * s->b.h[a]);
    return end;
}

/* The same of uniform cells and layers; those with water next to them in that direction are
 * skipped. */
static double reach_on_cells(const struct fv *s, int a)
{
    const struct block *b = &s->b;
    const double *phi = s->surface->phi;
    double most = -INFINITY, x[3];
    int at[3];
    BLOCK_NEAR (s, 0, row, n)
        for (int64_t c = row; c < row + n; c++) {
            const int64_t beyond = c + b->stride[a];
            const double next = phi[beyond];
            if (!(phi[c] < 0.0) || is_blocked(s, c))
                continue;
            grid_part(&s->grid, c, at);
            if (at[a] + 1 < b->n[a] && next < 0.0 && !is_blocked(s, beyond))
                continue; /* the next one reaches further */
            block_centre(b, at[0], at[1], at[2], x);
            double end = up_to_box(s, c, a, foot_of_water(s, at, c, a));
            if (a == 1 && b->rows)
                end = (next >= 0.0 ? phi[c] / (phi[c] - next) : 0.5) * block_step(b, a, at[1] + 1);
            most = fmax(most, x[a] + (isfinite(end) ? end : 0.5 * b->h[a]));
        }
    return ranks_max(b->cart, most);
}

/* The foot of a tongue, which is found from its slope, is no further than the domain. */
double surface_reach(const struct fv *s, int a)
{
    return fmin(s->m ? reach_on_blocks(s, a) : reach_on_cells(s, a), s->run->scene.domain.max[a]);
}

/* Of the water, m^dim/s^2. Collective. */
static double enstrophy(const struct fv *s)
{
    double sum = 0.0;
    FLOW_NEAR_AT (s, p, j, c, n)
        for (int64_t i = c; i < c + n; i++) {
            const double part = surface_water(s, i);
            sum += part > 0.0
                       ? 0.5 * part * flow_curl_squared(s, p, i) * surface_cell_volume(s, i, j)
                       : 0.0;
        }
    return ranks_sum(s->comm, sum);
}

/* Period and damping of the modal amplitude against the exact ones. */
static void summarise_oscillation(struct fv *s)
{
    struct summary *to = s->run->summary;
    double period, rate;
    if (s->run->coupled || s->prm.nboxes > 0 || s->exact.field != FIELD_STANDING_WAVE ||
        !exact_oscillation(&s->exact, &period, &rate))
        return;
    exact_summarise_oscillation(&s->surface->oscillation, period, rate, to);
    if (rate != 0.0 && !s->m) {
        const struct scene_domain *d = &s->run->scene.domain;
        summary_real(to, "error.enstrophy",
                     fabs(enstrophy(s) / exact_enstrophy(&s->exact, d->min, d->max, s->t) - 1.0));
    }
}

/* Volumes that were moved are told as shares of surface_volume_scale. */
void surface_summarise(struct fv *s)
{
    const struct surface *f = s->surface;
    struct summary *to = s->run->summary;
    const double volume = surface_volume(s);
    summarise_oscillation(s);
    summary_real(to, "largest_velocity", fv_fastest(s));
    summary_real(to, "drift.volume", volume / f->volume0 - 1.0);
    summary_real(to, "volume_returned", f->returned / surface_volume_scale(s));
    summary_real(to, "volume_lost", f->lost / surface_volume_scale(s));
    summary_real(to, "volume_gained", f->gained / surface_volume_scale(s));
    if (f->fraction) {
        summary_real(to, "volume_moved", f->fraction->moved / surface_volume_scale(s));
        summary_real(to, "level_volume", surface_level_volume(s, NULL) / volume - 1.0);
    }
    summary_int(to, "reinitialisations", f->reinits);
    summary_int(to, "steps_repeated", f->repeats);
}
