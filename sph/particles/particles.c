/* particles.c - storage of the particles and the lines that the pair loops load. Positions in the
 * arrays change at every sort and migration: what must find a particle again goes by its id. The
 * state y is what steps integrate; packed records are made anew from it in every stage
 * (particles_lines).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../sph.h"

/* The line that pads neighbour rows: outside every support and without volume, yet harmless in any
 * quotient. */
static void set_dummy(struct particles *p, int dim)
{
    double *line = p->prim + (size_t)PRIM * p->capacity;
    memset(line, 0, PRIM * sizeof(double));
    for (int a = 0; a < dim; a++)
        line[a] = 1e15;
    line[at_rho(dim)] = 1.0; /* rho */
    memset(p->slope + (size_t)p->nslope * p->capacity, 0, (size_t)p->nslope * sizeof(double));
}

/* Reallocates all arrays to `capacity' records. The dummy stands at the end of prim, slope and rate
 * and is written anew; `sum' is dropped, since its contents matter within a stage only. */
static void grow(struct particles *p, int capacity)
{
    const size_t old = (size_t)p->capacity, n = (size_t)capacity, ns = (size_t)p->nstate;
    GROW_IN(p->owner, p->y, old * ns, n * ns);
    GROW_IN(p->owner, p->y0, old * ns, n * ns);
    GROW_IN(p->owner, p->rate, old * ns, (n + 1) * ns);
    GROW_IN(p->owner, p->prim, old * PRIM, (n + 1) * PRIM);
    GROW_IN(p->owner, p->slope, old * p->nslope, (n + 1) * p->nslope);
    GROW_IN(p->owner, p->id, old, n);
    GROW_IN(p->owner, p->false_divergence, old, n);
    GROW_IN(p->owner, p->zone, old, n);
    GROW_IN(p->owner, p->role, old, n);
    if (p->size)
        GROW(p->size, old, n);
    p->capacity = capacity;
    p->sum_capacity = 0;
    p->pull_capacity = 0;
    DROP(p->sum);
    DROP(p->pull);
    set_dummy(p, (p->nstate - 2) / 2);
}

void particles_create(void *owner, struct particles *p, int dim, int capacity)
{
    *p = (struct particles){.owner = owner, .nstate = 2 * dim + 2, .nslope = dim == 2 ? 8 : 16};
    grow(p, capacity > 0 ? capacity : 1);
}

void particles_add_sizes(struct particles *p, double R)
{
    p->size = mem_new_in(p->owner, (size_t)p->capacity, sizeof *p->size);
    for (int i = 0; i < p->n; i++) {
        p->size[i][0] = R;
        p->size[i][1] = 1.0;
    }
}

void particles_reserve(struct particles *p, int total)
{
    if (total > p->capacity)
        grow(p, total + total / 16 + 64);
}

double *particles_sum(struct particles *p)
{
    if (p->sum_capacity < p->capacity) {
        p->sum = NEW_IN(p->owner, double, (size_t)p->capacity * p->nstate);
        p->sum_capacity = p->capacity;
    }
    return p->sum;
}

double *particles_pull(struct particles *p)
{
    if (p->pull_capacity < p->capacity) {
        p->pull = NEW_IN(p->owner, double, (size_t)p->capacity *PULL);
        p->pull_capacity = p->capacity;
    }
    return p->pull;
}

int particles_add(struct particles *p, int64_t id, enum sph_zone zone)
{
    particles_reserve(p, p->n + 1);
    p->id[p->n] = id;
    p->zone[p->n] = (unsigned char)zone;
    p->role[p->n] = 0;
    p->false_divergence[p->n] = 0.0;
    memset(p->y + (size_t)p->n * p->nstate, 0, (size_t)p->nstate * sizeof(double));
    return p->n++;
}

void particles_copy(struct particles *p, int to, int from)
{
    if (to == from)
        return;
    memcpy(p->y + (size_t)to * p->nstate, p->y + (size_t)from * p->nstate,
           (size_t)p->nstate * sizeof(double));
    p->id[to] = p->id[from];
    p->zone[to] = p->zone[from];
    p->role[to] = p->role[from];
    p->false_divergence[to] = p->false_divergence[from];
    if (p->size)
        memcpy(p->size[to], p->size[from], sizeof *p->size);
    memcpy(slope_line(p, to), slope_line(p, from), (size_t)p->nslope * sizeof(double));
}

/* Applies the order to the slope records of locals, by a copy of all. */
static void permute_slopes(struct particles *p, int n, const int *order)
{
    const size_t row = (size_t)p->nslope;
    double *old = NEW(double, (size_t)n *row);
    if (n > 0)
        memcpy(old, p->slope, (size_t)n * row * sizeof *old);
    for (int i = 0; i < n; i++)
        memcpy(slope_line(p, i), old + (size_t)order[i] * row, row * sizeof *old);
    mem_free(old);
}

/* Applies the order to the sizes of locals; those of ghosts are lost. */
static void permute_sizes(struct particles *p, int n, const int *order)
{
    double(*size)[2] = mem_new_in(p->owner, (size_t)p->capacity, sizeof *size);
    for (int i = 0; i < n; i++)
        memcpy(size[i], p->size[order[i]], sizeof *size);
    mem_free(p->size);
    p->size = size;
}

/* y0 is free between steps: the new order is made there and swapped in. Arrays of bytes and ids are
 * replaced by new ones. O(n). */
void particles_permute(struct particles *p, int n, const int *order, bool slopes)
{
    const size_t row = (size_t)p->nstate;
    int64_t *id = NEW_IN(p->owner, int64_t, p->capacity);
    unsigned char *zone = NEW_IN(p->owner, unsigned char, p->capacity);
    unsigned short *role = NEW_IN(p->owner, unsigned short, p->capacity);
    double *false_divergence = NEW_IN(p->owner, double, p->capacity);
    for (int i = 0; i < n; i++) {
        memcpy(p->y0 + (size_t)i * row, p->y + (size_t)order[i] * row, row * sizeof(double));
        id[i] = p->id[order[i]];
        zone[i] = p->zone[order[i]];
        role[i] = p->role[order[i]];
        false_divergence[i] = p->false_divergence[order[i]];
    }
    if (slopes)
        permute_slopes(p, n, order);
    double *y = p->y;
    p->y = p->y0;
    p->y0 = y;
    if (p->size)
        permute_sizes(p, n, order);
    FREE(p->id, p->zone, p->role, p->false_divergence);
    p->false_divergence = false_divergence;
    p->id = id;
    p->zone = zone;
    p->role = role;
}

void particles_set(struct sph *s, int i, const double *x, const double *u, double w, double rho)
{
    double *y = state_row(&s->p, s->p.y, i);
    const int dim = s->dim;
    for (int a = 0; a < dim; a++) {
        y[a] = x[a];
        y[dim + a] = rho * w * u[a];
    }
    y[at_volume(dim)] = w;
    y[at_mass(dim)] = rho * w;
}

double particles_share(const struct sph *s, const double *x)
{
    return s->places ? s->places->share(s, x) : 1.0;
}

/* The packed record q of a state: velocity momentum/mass, density mass/volume; in 2D, where room is
 * left in the 64 bytes, the false divergence as well. */
INLINE void line(const double *y, double false_divergence, double *q, const int dim)
{
    const double w = y[at_volume(dim)], m = y[at_mass(dim)], rho = m / w, to_u = 1.0 / m;
    for (int a = 0; a < dim; a++) {
        q[a] = y[a];
        q[dim + a] = y[dim + a] * to_u;
    }
    q[at_volume(dim)] = w;
    q[at_rho(dim)] = rho;
    if (dim == 2)
        q[PRIM_FALSE] = false_divergence;
}

INLINE void lines(struct sph *s, const int dim)
{
    for (int i = 0; i < s->p.n; i++)
        line(s->p.y + (size_t)s->p.nstate * i, s->p.false_divergence[i], prim_line(&s->p, i), dim);
}

/* Packs states interpolated linearly between y0 and y, part 0 .. 1: levels with steps of their own
 * need each other's fields at times within a step. */
INLINE void lines_between(struct sph *s, double part, const int dim)
{
    for (int i = 0; i < s->p.n; i++) {
        const double *y0 = state_row(&s->p, s->p.y0, i), *y1 = state_row(&s->p, s->p.y, i);
        double y[8];
        for (int k = 0; k < 2 * dim + 2; k++)
            y[k] = y0[k] + part * (y1[k] - y0[k]);
        line(y, s->p.false_divergence[i], prim_line(&s->p, i), dim);
    }
}

void particles_lines_between(struct sph *s, double part)
{
    if (s->dim == 2)
        lines_between(s, part, 2);
    else
        lines_between(s, part, 3);
}

void particles_lines(struct sph *s)
{
    if (s->dim == 2)
        lines(s, 2);
    else
        lines(s, 3);
}
