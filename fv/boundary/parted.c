/* parted.c - see parted.h. Parts are told apart by layers of cells across an axis that are imposed
 * from end to end. Computed cells on both sides of such a layer are joined by nothing but the
 * partner. number_layers numbers the parts along the axis; of a periodic axis the first and last
 * are one.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "parted.h"

#include "bc.h"

/* How many cells of each layer across axis a are computed, of all ranks. */
static double *count_layers(const struct fv *s, const unsigned char *forced, int a)
{
    const struct block *b = &s->b;
    double *n = NEW(double, b->cells[a]);
    int at[3];
    BLOCK_NEAR (s, 0, c, len)
        for (int64_t i = c; i < c + len; i++) {
            block_place(b, i, at);
            n[b->lo[a] + at[a]] += !forced[i];
        }
    MPI_Allreduce(MPI_IN_PLACE, n, b->cells[a], MPI_DOUBLE, MPI_SUM, s->comm);
    return n;
}

/* Part of each layer along a, imposed ones with the part below; returns how many there are. */
static int number_layers(const struct block *b, int a, const double *computed, int *part)
{
    int n = 0;
    for (int i = 0; i < b->cells[a]; i++) {
        const bool begins = computed[i] > 0.0 && (i == 0 || computed[i - 1] == 0.0);
        n += begins;
        part[i] = n > 0 ? n - 1 : 0;
    }
    const bool joined = b->periodic[a] && computed[0] > 0.0 && computed[b->cells[a] - 1] > 0.0;
    for (int i = 0; i < b->cells[a] && joined && n > 1; i++)
        part[i] = part[i] == n - 1 ? 0 : part[i];
    return joined && n > 1 ? n - 1 : n;
}

/* Finds the axis that is cut and the part of each of its layers; returns the number of parts, 0:
 * none is cut. The first such axis counts. */
static int find_cut(const struct fv *s, const unsigned char *forced, int *axis, int *part)
{
    int n = 1;
    for (int a = 0; a < s->b.dim && n < 2; a++) {
        double *computed = count_layers(s, forced, a);
        n = number_layers(&s->b, a, computed, part);
        *axis = a;
        mem_free(computed);
    }
    return n > 1 && n <= PARTS_MAX ? n : 0;
}

/* Whether a computed cell is beside a side whose pressure is given. */
static bool is_fed(const struct fv *s, const int *at)
{
    bool fed = false;
    for (int a = 0; a < s->b.dim; a++)
        for (int e = -1; e <= 1; e += 2) {
            int outer[3] = {at[0], at[1], at[2]};
            outer[a] += e;
            fed = fed || bc_behind(s, outer, a) == MESH_OUTFLOW;
        }
    return fed;
}

/* Computed cells of each part, and whether any of them is beside a side of given pressure.
 * Collective. */
static void count_parts(const struct fv *s, const unsigned char *forced, struct parted *p)
{
    double sums[2 * PARTS_MAX] = {0.0};
    int at[3];
    BLOCK_NEAR (s, 0, c, len)
        for (int64_t i = c; i < c + len; i++) {
            if (forced[i])
                continue;
            block_place(&s->b, i, at);
            sums[p->of[i]] += 1.0;
            sums[PARTS_MAX + p->of[i]] += is_fed(s, at);
        }
    MPI_Allreduce(MPI_IN_PLACE, sums, 2 * PARTS_MAX, MPI_DOUBLE, MPI_SUM, s->comm);
    for (int k = 0; k < p->n; k++) {
        p->cells[k] = sums[k];
        p->floats[k] = sums[PARTS_MAX + k] == 0.0;
    }
}

/* The layer along a that a cell, a ghost too, stands for. */
static int layer_of(const struct block *b, int a, int64_t c)
{
    int at[3];
    block_place(b, c, at);
    const int i = b->lo[a] + at[a], n = b->cells[a];
    return b->periodic[a] ? (i + n) % n : i < 0 ? 0 : i >= n ? n - 1 : i;
}

/* Whether some part has no side that gives its pressure. */
static bool any_floats(const struct parted *p)
{
    bool any = false;
    for (int k = 0; k < p->n; k++)
        any = any || p->floats[k];
    return any;
}

/* A part that all sides reach is no part: NULL. */
struct parted *parted_create(const struct fv *s, const unsigned char *forced)
{
    const struct block *b = &s->b;
    int most = 0, axis = 0;
    if (s->m || s->surface)
        return NULL;
    for (int a = 0; a < b->dim; a++)
        most = b->cells[a] > most ? b->cells[a] : most;
    int *part = NEW(int, most);
    struct parted *p = NEW(struct parted, 1);
    p->forced = forced;
    p->n = find_cut(s, forced, &axis, part);
    if (p->n > 0) {
        p->of = NEW_IN(p, signed char, s->size);
        for (int64_t c = 0; c < s->size; c++)
            p->of[c] = (signed char)part[layer_of(b, axis, c)];
        count_parts(s, forced, p);
    }
    mem_free(part);
    if (!any_floats(p))
        DROP(p);
    return p;
}

/* Then one pressure is free in all. */
bool parted_all_float(const struct parted *p)
{
    bool all = true;
    for (int k = 0; k < p->n; k++)
        all = all && p->floats[k];
    return all;
}

/* Of each part that floats its own. */
void parted_remove_means(const struct parted *p, const struct fv *s, double *x)
{
    double mean[PARTS_MAX] = {0.0};
    const unsigned char *forced = p->forced;
    BLOCK_NEAR (s, 0, c, n)
        for (int64_t i = c; i < c + n; i++)
            mean[p->of[i]] += x[i];
    MPI_Allreduce(MPI_IN_PLACE, mean, p->n, MPI_DOUBLE, MPI_SUM, s->comm);
    for (int k = 0; k < p->n; k++)
        mean[k] = p->floats[k] ? mean[k] / p->cells[k] : 0.0;
    BLOCK_NEAR (s, 0, c, n)
        for (int64_t i = c; i < c + n; i++)
            x[i] -= forced[i] ? 0.0 : mean[p->of[i]];
}

/* Outwards, m^dim/s, of the computed cells of each part. Collective. */
void parted_net_fluxes(const struct parted *p, const struct fv *s, double *const U[3],
                       double net[PARTS_MAX])
{
    const unsigned char *forced = p->forced;
    memset(net, 0, PARTS_MAX * sizeof *net);
    for (int a = 0; a < s->b.dim; a++) {
        const int64_t d = s->b.stride[a];
        BLOCK_NEAR (s, 0, c, n)
            for (int64_t i = c; i < c + n; i++)
                if (!forced[i])
                    net[p->of[i]] += U[a][i + d] * grid_flow_area(&s->grid, i + d, a) -
                                     U[a][i] * grid_flow_area(&s->grid, i, a);
    }
    MPI_Allreduce(MPI_IN_PLACE, net, p->n, MPI_DOUBLE, MPI_SUM, s->comm);
}

/* Both pressures, for outputs extrapolate between them. */
void parted_shift(const struct parted *p, struct fv *s, const double more[PARTS_MAX])
{
    for (int64_t c = 0; c < s->size; c++) {
        const double by = p->floats[p->of[c]] ? more[p->of[c]] : 0.0;
        s->p[c] += by;
        if (s->p_before)
            s->p_before[c] += by;
    }
}
