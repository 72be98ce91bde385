/* shut_water.c - see shut_water.h. Volumes follow div u, whose sum drifts by parts in a thousand
 * as the packing settles (../particles/volume.c), and the pressure of a water that nothing but its
 * own volume holds drifts with it: half of 5 kPa in a hollow of 12 x 6 particles below a slab. The
 * mass does not change, and as long as its bodies stay the room does not, so neither does the mean
 * density. SPDX-License-Identifier: BSD-3-Clause */
#include "shut_water.h"

#include "../../common/files/files.h"
#include "body_touch.h"

static const double stays = 0.5; /* dx: a body that has moved further may have opened the room */

unsigned shut_water_beside(const struct sph *s, const double *x)
{
    unsigned any = 0;
    double out[3];
    for (int k = -1; k < s->walls->nbodies; k++)
        if (isfinite(touch_distance(s->walls, s->dim, k, x, 1.5 * s->dx, out)))
            any |= k < 0 ? BESIDE_REST : 1u << k;
    return any;
}

struct shut_water *shut_water_add(struct sph *s, int64_t n, unsigned beside)
{
    struct walls *w = s->walls;
    if (w->nshut == SHUT_WATERS_MAX)
        return NULL;
    struct shut_water *to = mem_new_in(w, 1, sizeof *to + (size_t)n * sizeof *to->id);
    *to = (struct shut_water){.beside = beside, .n = n};
    return w->shut[w->nshut++] = to;
}

/* Identities ascend. */
static bool holds(const struct shut_water *of, int64_t id)
{
    int64_t lo = 0, hi = of->n;
    if (id < of->id[0] || id > of->id[of->n - 1])
        return false;
    while (hi - lo > 1) {
        const int64_t mid = (lo + hi) / 2;
        *(of->id[mid] <= id ? &lo : &hi) = mid;
    }
    return of->id[lo] == id;
}

/* Where particle i's volume is kept, if it belongs to that water; else NULL. */
static double *volume_in(const struct sph *s, const struct shut_water *of, int i)
{
    return holds(of, s->p.id[i]) ? &state_row(&s->p, s->p.y, i)[at_volume(s->dim)] : NULL;
}

/* m^dim: of all ranks. */
static void sum_volumes(const struct sph *s, double sum[SHUT_WATERS_MAX])
{
    const struct walls *w = s->walls;
    for (int k = 0; k < w->nshut; k++) {
        sum[k] = 0.0;
        for (int i = 0; i < s->p.n; i++) {
            const double *v = volume_in(s, w->shut[k], i);
            sum[k] += v ? *v : 0.0;
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, sum, w->nshut, MPI_DOUBLE, MPI_SUM, s->run->comm);
}

void shut_waters_remember(struct sph *s)
{
    double sum[SHUT_WATERS_MAX];
    if (!s->walls || s->walls->nshut == 0)
        return;
    sum_volumes(s, sum);
    for (int k = 0; k < s->walls->nshut; k++)
        s->walls->shut[k]->volume = sum[k];
}

/* m: how far a corner of the box around a body is from where it was at the start. */
static double displacement(const struct body *b)
{
    double most = 0.0;
    for (int a = 0; a < b->dim; a++) {
        double from[3] = {b->centre[0], b->centre[1], b->centre[2]}, to[3] = {0.0}, e[3];
        from[a] += b->reach;
        body_place(b, from, to);
        vec3_from(from, to, e);
        most = fmax(most, vec3_length(e));
    }
    return most;
}

static bool is_open(const struct sph *s, const struct shut_water *of)
{
    bool any = false;
    for (int k = 0; k < s->walls->nbodies; k++)
        any = any || (of->beside >> k & 1 && displacement(s->walls->bodies + k) > stays * s->dx);
    return any;
}

/* Once open it stays open: the volume of reference 0 says so, and nothing is scaled any more. */
void shut_waters_keep(struct sph *s)
{
    double sum[SHUT_WATERS_MAX];
    bool any = false;
    for (int k = 0; s->walls && k < s->walls->nshut; k++) {
        struct shut_water *of = s->walls->shut[k];
        of->volume = is_open(s, of) ? 0.0 : of->volume;
        any = any || of->volume > 0.0;
    }
    if (!any) /* the same on all ranks */
        return;
    sum_volumes(s, sum);
    for (int k = 0; k < s->walls->nshut; k++) {
        const struct shut_water *of = s->walls->shut[k];
        for (int i = 0; i < s->p.n && of->volume > 0.0 && sum[k] > 0.0; i++) {
            double *v = volume_in(s, of, i);
            if (v)
                *v *= of->volume / sum[k];
        }
    }
}

void shut_waters_save(const struct sph *s, struct h5 *f)
{
    const struct walls *w = s->walls;
    const bool here = s->run->rank == 0;
    for (int k = 0; w && k < w->nshut; k++) {
        const double row[2] = {w->shut[k]->volume, w->shut[k]->beside};
        h5_write_int(f, key_text("shut_water_%d_id", k), here ? w->shut[k]->n : 0, w->shut[k]->id);
        h5_write_real(f, key_text("shut_water_%d", k), "m^dim, -", here ? 1 : 0, 2, row, false);
    }
}

bool shut_waters_load(struct sph *s, struct h5 *f)
{
    bool fits = true;
    for (int k = 0; s->walls && k < SHUT_WATERS_MAX && fits; k++) {
        int64_t n, one;
        double *row = h5_read_all_real(f, key_text("shut_water_%d", k), 2, &one);
        if (!row)
            break;
        int64_t *id = h5_read_all_int(f, key_text("shut_water_%d_id", k), &n);
        fits = id && n > 0 && one == 1;
        if (fits) {
            struct shut_water *to = shut_water_add(s, n, (unsigned)row[1]);
            to->volume = row[0];
            memcpy(to->id, id, (size_t)n * sizeof *id);
        }
        FREE(row, id);
    }
    return fits;
}
