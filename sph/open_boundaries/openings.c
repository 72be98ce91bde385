/* openings.c - face masses, births and removals at the open sides; see openings.h.
 * A face with booked mass f rho dx^D stands for a lattice whose next row is (1/2 - f) dx behind it:
 * that is where the transport law sees neighbours beyond the open side.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "openings.h"

#include <math.h>
#include <string.h>

#include "../../common/mem.h"
#include "../parallel/domain.h"
#include "../particles/eos.h"
#include "../pairs/neighbours.h"
#include "../sph_params.h"
#include "wet_faces.h"
#include "zones.h"

/* What a face that cannot give birth holds beyond this goes to its neighbours; what it owes beyond
 * this is a void that went out. */
static const double most_debt = 1.5;

/* In R/c0: how long the drain takes for what voids left. With 50 the drain of the breaking wave is
 * some 0.02 m/s at most. */
static const double drain_time = 50.0;

struct openings *openings_create(struct sph *s)
{
    struct openings *o = NEW(struct openings, 1);
    o->dim = s->dim;
    o->dx = s->dx;
    for (int a = 0; a < 3; a++) {
        o->lo[a] = s->lo[a];
        o->hi[a] = s->hi[a];
        o->bounded[a] = a < s->dim && !s->periodic[a];
        o->cells[a] = a < s->dim ? (int)lround((s->hi[a] - s->lo[a]) / s->dx) : 1;
    }
    for (int side = 0; side < 2 * o->dim; side++) {
        o->open[side] = s->open[side];
        int faces = o->open[side] ? 1 : 0;
        for (int b = 0; b < o->dim; b++)
            faces *= b == side / 2 ? 1 : o->cells[b];
        o->first[side + 1] = o->first[side] + faces;
    }
    const int n = openings_faces(o);
    o->mass = NEW(double, n);
    o->change = NEW(double, n);
    o->flux = NEW(double, n);
    o->shift = NEW(double, n);
    o->share = NEW(double, n);
    for (int f = 0; f < n; f++)
        o->share[f] = 1.0;
    o->first_id = (int64_t)1 << 40; /* above those of the first filling */
    o->tick = sph_params_dt(&s->prm, s->nu, s->c0, NULL) / 64.0;
    return o;
}

void openings_free(struct openings **o)
{
    if (!*o)
        return;
    mem_free((*o)->mass);
    mem_free((*o)->change);
    mem_free((*o)->flux);
    mem_free((*o)->shift);
    mem_free((*o)->share);
    mem_free((*o)->ghost_x);
    mem_free(*o);
    *o = NULL;
}

int openings_faces(const struct openings *o) { return o->first[2 * o->dim]; }

double openings_age(const struct sph *s, int64_t id)
{
    const struct openings *o = s->zones->openings;
    if (id < o->first_id)
        return s->t;
    return s->t - o->tick * (double)((id - o->first_id) / openings_faces(o));
}

double openings_held(const struct sph *s)
{
    const struct openings *o = s->zones->openings;
    double sum = 0.0;
    for (int f = 0; f < openings_faces(o); f++)
        sum += o->mass[f];
    return sum - o->owed;
}

void openings_let_out(struct openings *o, double mass)
{
    const int n = openings_faces(o);
    for (int f = 0; f < n; f++)
        o->mass[f] -= mass / n;
}

/* Face of a side at lattice indices I (that of the side's axis does not matter); indices of bounded
 * axes are clamped, of periodic ones wrapped. */
static int face_at(const struct openings *o, int side, const int *I)
{
    int f = 0;
    for (int b = o->dim - 1; b >= 0; b--) {
        if (b == side / 2)
            continue;
        const int c = o->cells[b];
        const int i = o->bounded[b] ? (I[b] < 0    ? 0
                                       : I[b] >= c ? c - 1
                                                   : I[b])
                                    : ((I[b] % c) + c) % c;
        f = f * c + i;
    }
    return o->first[side] + f;
}

/* Side, centre and inward normal sign of a face. */
int openings_place(const struct openings *o, int f, double *x)
{
    int side = 0;
    while (f >= o->first[side + 1])
        side++;
    int k = f - o->first[side];
    x[2] = 0.0;
    for (int b = 0; b < o->dim; b++) {
        if (b == side / 2) {
            x[b] = side % 2 ? o->hi[b] : o->lo[b];
            continue;
        }
        x[b] = o->lo[b] + (k % o->cells[b] + 0.5) * o->dx;
        k /= o->cells[b];
    }
    return side;
}

int openings_face_at(const struct openings *o, int side, const double *x)
{
    int I[3] = {0, 0, 0};
    for (int a = 0; a < o->dim; a++)
        I[a] = (int)floor((x[a] - o->lo[a]) / o->dx);
    return face_at(o, side, I);
}

static double inward(int side) { return side % 2 ? -1.0 : 1.0; }

/* Adds one ghost at y if this rank can see it. */
static void add_ghost(struct sph *s, const double *y, const double *lo, const double *hi,
                      double reach)
{
    struct openings *o = s->zones->openings;
    for (int a = 0; a < o->dim; a++)
        if (y[a] < lo[a] - reach || y[a] > hi[a] + reach)
            return;
    if (o->nghost == o->ghost_capacity) {
        const int more = 2 * o->ghost_capacity + 256;
        GROW(o->ghost_x, 3 * o->ghost_capacity, 3 * more);
        o->ghost_capacity = more;
    }
    memcpy(o->ghost_x + 3 * (size_t)o->nghost++, y, 3 * sizeof *y);
}

/* Lattice places beyond side `side'. Axes before the side's own stay inside, so that an edge is
 * counted once; behind walls there are none. */
static void list_side(struct sph *s, int side, const double *lo, const double *hi, double reach)
{
    const struct openings *o = s->zones->openings;
    const int axis = side / 2, layers = (int)ceil(reach / o->dx) + 2;
    int first[3] = {0, 0, 0}, last[3] = {0, 0, 0}, I[3];
    for (int b = 0; b < o->dim; b++) {
        const bool low = o->bounded[b] && (b < axis || !o->open[2 * b]);
        const bool high = o->bounded[b] && (b < axis || !o->open[2 * b + 1]);
        const int i = (int)floor((lo[b] - reach - o->lo[b]) / o->dx) - 2;
        const int j = (int)floor((hi[b] + reach - o->lo[b]) / o->dx) + 2;
        first[b] = low && i < 0 ? 0 : i;
        last[b] = high && j >= o->cells[b] ? o->cells[b] - 1 : j;
    }
    first[axis] = side % 2 ? o->cells[axis] : -layers;
    last[axis] = side % 2 ? o->cells[axis] + layers - 1 : -1;
    for (I[2] = first[2]; I[2] <= last[2]; I[2]++)
        for (I[1] = first[1]; I[1] <= last[1]; I[1]++)
            for (I[0] = first[0]; I[0] <= last[0]; I[0]++) {
                double y[3] = {0.0, 0.0, 0.0};
                for (int b = 0; b < o->dim; b++) {
                    y[b] = o->lo[b] + (I[b] + 0.5) * o->dx;
                    const int beyond = I[b] < 0 ? 2 * b : I[b] >= o->cells[b] ? 2 * b + 1 : -1;
                    if (beyond >= 0 && o->open[beyond])
                        y[b] += o->shift[face_at(o, beyond, I)];
                }
                add_ghost(s, y, lo, hi, reach);
            }
}

void openings_ghosts(struct sph *s)
{
    struct openings *o = s->zones->openings;
    double lo[3], hi[3];
    const double reach = s->R + s->skin;
    domain_bounds(s->domain, lo, hi);
    o->nghost = 0;
    for (int side = 0; side < 2 * o->dim; side++) {
        const int a = side / 2;
        const double d = side % 2 ? o->hi[a] - hi[a] : lo[a] - o->lo[a];
        if (o->open[side] && d < reach)
            list_side(s, side, lo, hi, reach);
    }
    if (s->zones->surface)
        wet_faces_ghosts(s);
    o->first_ghost = s->p.nghost;
    particles_reserve(&s->p, s->p.n + s->p.nghost + o->nghost);
    s->p.nghost += o->nghost;
    o->ghost_t = s->t;
    openings_ghost_lines(s);
}

/* They drift with the flow outside within the step. */
void openings_ghost_lines(struct sph *s)
{
    struct openings *o = s->zones->openings;
    struct zones *z = s->zones;
    const int dim = o->dim;
    const double dt = s->t - o->ghost_t;
    z->n = 0;
    zones_room(z, o->nghost);
    z->n = o->nghost;
    memcpy(z->x, o->ghost_x, 3 * (size_t)o->nghost * sizeof *z->x);
    zones_look(z, s->t, false);
    for (int k = 0; k < o->nghost; k++) {
        const int i = s->p.n + o->first_ghost + k;
        double *line = prim_line(&s->p, i), *g = slope_line(&s->p, i);
        const double *u = z->u + (size_t)dim * k;
        const double rho = eos_rho(z->p[k], s->rho0, s->c0, s->gamma);
        memset(g, 0, (size_t)s->p.nslope * sizeof *g);
        for (int a = 0; a < dim; a++) {
            line[a] = o->ghost_x[3 * (size_t)k + a] + dt * u[a];
            line[dim + a] = u[a];
            g[dim + dim * dim + a] = s->prm.transport == TRANSPORT_EULERIAN ? 0.0 : u[a];
        }
        line[at_volume(dim)] = s->dxD;
        line[at_rho(dim)] = rho;
    }
}

/* Particles beyond an open side give their mass to the nearest face. */
static void remove_leavers(struct sph *s)
{
    struct openings *o = s->zones->openings;
    struct particles *p = &s->p;
    for (int i = 0; i < p->n;) {
        const double *y = state_row(p, p->y, i);
        if (zones_depth(s, y) >= 0.0) {
            i++;
            continue;
        }
        int side = 0;
        double most = 0.0;
        for (int a = 0; a < o->dim; a++)
            for (int k = 0; k < 2; k++) {
                const double out = k ? y[a] - o->hi[a] : o->lo[a] - y[a];
                if (o->open[2 * a + k] && out > most) {
                    most = out;
                    side = 2 * a + k;
                }
            }
        const double m = y[at_mass(o->dim)];
        const int to = wet_faces_for(s, side, y);
        if (to >= 0)
            o->change[to] += m;
        else
            wet_faces_rain(s, y);
        o->gone_mass += m;
        o->gone++;
        particles_copy(p, i, --p->n);
    }
}

/* rho u.n dx^(D-1) of the faces this rank owns [6.13], from the flow outside at the middle of the
 * step. */
static void add_fluxes(struct sph *s, double dt)
{
    struct openings *o = s->zones->openings;
    struct zones *z = s->zones;
    const int n = openings_faces(o), dim = o->dim;
    const double area = s->dxD / s->dx;
    z->n = 0;
    zones_room(z, n);
    for (int f = 0; f < n; f++) {
        double x[3], in[3];
        const int side = openings_place(o, f, x);
        memcpy(in, x, sizeof x);
        in[side / 2] += 0.5 * o->dx * inward(side);
        o->flux[f] = 0.0;
        if (domain_owner(s->domain, in) != s->run->rank)
            continue;
        memcpy(z->x + 3 * z->n, x, sizeof x);
        z->who[z->n++] = f;
    }
    zones_look(z, s->t - 0.5 * dt, false);
    for (int k = 0; k < z->n; k++) {
        const int f = z->who[k];
        int side = 0;
        while (f >= o->first[side + 1])
            side++;
        const double rho = eos_rho(z->p[k], s->rho0, s->c0, s->gamma);
        o->flux[f] = rho * area * o->share[f] * inward(side) * z->u[dim * k + side / 2];
        o->change[f] += dt * o->flux[f];
        o->inflow += dt * (o->flux[f] + s->rho0 * area * o->drain);
    }
    o->owed -= dt * openings_faces(o) * s->rho0 * area * o->drain;
}

/* A void that reaches an open side goes out as water: the outside knows no voids, and lets as much
 * in elsewhere. Below it faces are booked particles that do not come. They would wait for them, one
 * row of void after the other; what they owe beyond most_debt goes instead to one account, and
 * leaves the region by a slow flow through all open sides. */
static void collect_debts(struct sph *s)
{
    struct openings *o = s->zones->openings;
    const double least = -most_debt * s->rho0 * s->dxD, area = s->dxD / s->dx;
    /* an outlet's faces may stand in air; an outside with a surface has room for voids */
    if (!s->surface || s->prm.outer == OUTER_SIDES || s->zones->surface)
        return;
    for (int f = 0; f < openings_faces(o); f++)
        if (o->mass[f] < least) {
            o->owed += least - o->mass[f];
            o->mass[f] = least;
        }
    o->drain =
        o->owed / (s->rho0 * area * openings_faces(o)) * s->c0 / (drain_time * s->R); /* m/s */
}

/* Places near the open sides in a hash of cells of side dx, to keep births apart. */
struct strip {
    int n, capacity, heads;
    double (*x)[3];
    int *next, *head;
};

static int strip_cell(const struct strip *t, const struct openings *o, const double *x,
                      const int *off)
{
    uint32_t key = 0;
    for (int a = 0; a < o->dim; a++)
        key = key * 73856093u + (uint32_t)((int)floor((x[a] - o->lo[a]) / o->dx) + off[a]);
    return (int)(key % (uint32_t)t->heads);
}

static void strip_add(struct strip *t, const struct openings *o, const double *y)
{
    static const int here[3] = {0, 0, 0};
    if (t->n == t->capacity) {
        GROW(t->x, t->capacity, 2 * t->capacity);
        GROW(t->next, t->capacity, 2 * t->capacity);
        t->capacity *= 2;
    }
    for (int a = 0; a < o->dim; a++)
        t->x[t->n][a] = y[a];
    const int c = strip_cell(t, o, y, here);
    t->next[t->n] = t->head[c];
    t->head[c] = t->n++;
}

/* Locals where they are now, ghosts where the last stage saw them. */
static struct strip strip_create(const struct sph *s)
{
    const struct openings *o = s->zones->openings;
    const int room = 4 * openings_faces(o) + 64;
    struct strip t = {.capacity = room,
                      .heads = room,
                      .x = mem_new((size_t)room, sizeof *t.x),
                      .next = NEW(int, room),
                      .head = NEW(int, room)};
    for (int c = 0; c < t.heads; c++)
        t.head[c] = -1;
    for (int i = 0; i < s->p.n + o->first_ghost; i++) {
        const double *y =
            i < s->p.n ? state_row(&s->p, s->p.y, i) : prim_line(&s->p, s->list->n + i - s->p.n);
        if (zones_depth(s, y) < 2.0 * s->dx)
            strip_add(&t, o, y);
    }
    return t;
}

static void strip_free(struct strip *t)
{
    mem_free(t->x);
    mem_free(t->next);
    mem_free(t->head);
}

static bool crowded(const struct strip *t, const struct openings *o, const double *x)
{
    const double least2 = 0.25 * o->dx * o->dx;
    int off[3] = {0, 0, 0};
    for (off[2] = o->dim > 2 ? -1 : 0; off[2] <= (o->dim > 2 ? 1 : 0); off[2]++)
        for (off[1] = -1; off[1] <= 1; off[1]++)
            for (off[0] = -1; off[0] <= 1; off[0]++)
                for (int k = t->head[strip_cell(t, o, x, off)]; k >= 0; k = t->next[k]) {
                    double r2 = 0.0;
                    for (int a = 0; a < o->dim; a++)
                        r2 += (x[a] - t->x[k][a]) * (x[a] - t->x[k][a]);
                    if (r2 < least2)
                        return true;
                }
    return false;
}

static void born(struct sph *s, int f, const double *x, const double *u, double rho)
{
    struct openings *o = s->zones->openings;
    const int64_t id = o->first_id + f + llround(s->t / o->tick) * openings_faces(o);
    const int i = particles_add(&s->p, id, ZONE_BUFFER);
    particles_set(s, i, x, u, s->dxD, rho);
    o->change[f] -= rho * s->dxD;
    o->born_mass += rho * s->dxD;
    o->born++;
}

/* Mass goes to the face beside f, on the same side, that holds least. */
static void pass_on(struct openings *o, int f, double mass)
{
    double x[3], least = INFINITY;
    const int side = openings_place(o, f, x);
    int to = f;
    for (int b = 0; b < o->dim; b++)
        for (int way = -1; b != side / 2 && way <= 1; way += 2) {
            int I[3];
            for (int a = 0; a < 3; a++)
                I[a] = a < o->dim ? (int)floor((x[a] - o->lo[a]) / o->dx) + (a == b ? way : 0) : 0;
            const int g = face_at(o, side, I);
            if (g != f && o->share[g] > 0.25 && o->mass[g] + o->change[g] < least) {
                least = o->mass[g] + o->change[g];
                to = g;
            }
        }
    o->change[f] -= mass;
    o->change[to] += mass;
}

/* What a newborn may be moved on, in dx: with a half, faces at an edge gave birth on it, and
 * rounding lost the particle. */
static const double most_over = 0.49;

/* A face that holds a particle's mass and lets fluid in gives birth dx/2 inside, moved on along the
 * flow by what the step overshot. */
static void give_birth(struct sph *s)
{
    struct openings *o = s->zones->openings;
    struct zones *z = s->zones;
    const int looked = z->n, dim = o->dim;
    struct strip near = strip_create(s);
    s->p.nghost = 0; /* newborn take their place */
    for (int k = 0; k < looked; k++) {
        const int f = z->who[k];
        const double rho = eos_rho(z->p[k], s->rho0, s->c0, s->gamma), whole = rho * s->dxD;
        double held = o->mass[f] + o->change[f], *u = z->u + dim * k;
        if (held < whole || o->share[f] == 0.0 || (o->flux[f] <= 0.0 && held < most_debt * whole))
            continue;
        double x[3];
        const int side = openings_place(o, f, x), a = side / 2;
        const double over = fmin(held / whole - 1.0, most_over) * s->dx, un = fabs(u[a]);
        for (int b = 0; b < dim; b++)
            x[b] += b == a ? inward(side) * (0.5 * s->dx + over)
                           : (un > 0.0 ? fmax(fmin(u[b] / un, 1.0), -1.0) * over : 0.0);
        if (s->zones->surface)
            wet_faces_lower(s, 0.25 * s->dx, 1, x);
        if (crowded(&near, o, x)) {
            o->refused++;
            if (held > most_debt * whole)
                pass_on(o, f, held - most_debt * whole);
            continue;
        }
        born(s, f, x, u, rho);
        strip_add(&near, o, x);
    }
    strip_free(&near);
}

static void sum_changes(struct sph *s)
{
    struct openings *o = s->zones->openings;
    const int n = openings_faces(o);
    if (s->run->size > 1)
        MPI_Allreduce(MPI_IN_PLACE, o->change, n, MPI_DOUBLE, MPI_SUM, s->run->comm);
    for (int f = 0; f < n; f++)
        o->mass[f] += o->change[f];
    memset(o->change, 0, (size_t)n * sizeof(double));
}

void openings_settle(struct sph *s)
{
    struct openings *o = s->zones->openings;
    collect_debts(s);
    for (int side = 0; side < 2 * o->dim; side++)
        for (int f = o->first[side]; f < o->first[side + 1]; f++)
            o->shift[f] =
                inward(side) * s->dx * fmin(fmax(o->mass[f] / (s->rho0 * s->dxD), -1.0), most_debt);
}

void openings_step(struct sph *s, double dt)
{
    if (s->zones->surface)
        wet_faces_find(s, s->t - 0.5 * dt);
    remove_leavers(s);
    add_fluxes(s, dt);
    sum_changes(s);
    give_birth(s);
    sum_changes(s);
    openings_settle(s);
}
