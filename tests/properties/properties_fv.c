/* properties_fv.c - random scenes of cells, of blocks and of coupled jobs.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "properties_families.h"

#include <string.h>

/* Whether fluid sticks to a wall, which wants viscosity. */
static bool sticks(const struct scene *s)
{
    bool any = false;
    for (int k = 0; k < 6; k++) {
        any = any || (s->sides[k].kind && !strcmp(s->sides[k].kind, "no_slip"));
        for (int b = 0; b < BLOCKS; b++)
            any = any || (s->blocks[b].sides[k] && !strcmp(s->blocks[b].sides[k], "wall"));
    }
    return any;
}

/* cost: of a cell and step, in us. */
static void settle(struct scene *s, struct random *r, double cost)
{
    double h = 1e300, V = s->speed, gH = 0.0;
    int cells = 1;
    s->program = FV;
    if (s->nu == 0.0 && sticks(s))
        s->nu = 1e-6 * s->speed * s->length;
    for (int a = 0; a < s->dim; a++) {
        h = fmin(h, (s->hi[a] - s->lo[a]) / s->cells[a]);
        V = fmax(V, fabs(s->V[a]));
        gH += fabs(s->g[a]) * (s->hi[a] - s->lo[a]);
        cells *= s->cells[a];
    }
    (void)gH;
    make_end(s, r, 0.5 * h / V, 1e-6 * cost * cells + 1e-4);
    s->mass = s->rho;
    for (int a = 0; a < s->dim; a++)
        s->mass *= s->hi[a] - s->lo[a];
}

/* Cells of one shape, or of any up to 8:1, a few up to 1000:1. */
static void box_of(struct scene *s, struct random *r, int nx, int ny, int nz)
{
    const int n[3] = {nx, ny, nz};
    s->dx = make_spacing(r);
    double h[3] = {s->dx, s->dx, s->dx};
    if (chance(r, 0.3))
        h[whole(r, 0, s->dim - 1)] *= ldexp(1.0, whole(r, 0, chance(r, 0.2) ? 10 : 3));
    make_box(s, r, n, h);
    memcpy(s->cells, n, sizeof n);
}

static int even(struct random *r, int lo, int hi) { return 2 * whole(r, lo / 2, hi / 2); }

/* Of each integrator; returns the cost of a cell and step, us. */
static double integrator(struct scene *s, struct random *r, bool newton)
{
    const double at = uniform(r, 0.0, 1.0);
    if (at < 0.2 && s->nu > 0.0) {
        s->fv_more = " integrator = \"bdf2\"; cfl = 0.5;";
        return 1.0;
    }
    if (at < 0.35 && newton) {
        s->fv_more = one_of(r, " integrator = \"newton\";", " integrator = \"newton\"; cfl = 5;",
                            " integrator = \"newton\"; cfl = 100;",
                            " integrator = \"newton\"; flux = \"upwind\";");
        return 60.0;
    }
    if (at < 0.45)
        s->fv_more = " cfl = 0.5;";
    return 1.0;
}

static void fields(struct scene *s, struct random *r)
{
    s->dim = chance(r, 0.2) ? 3 : 2;
    const int n = s->dim > 2 ? even(r, 6, 14) : even(r, 4, 48), wide = chance(r, 0.3) ? 2 : 1;
    s->dx = make_spacing(r);
    for (int a = 0; a < s->dim; a++) {
        s->cells[a] = n;
        s->hi[a] = n * s->dx;
        s->periodic[a] = true;
    }
    s->cells[0] *= wide;
    s->hi[0] *= wide;
    s->speed = decades(r, 0.02, 30.0);
    const double waves = make_waves(s, r, n, s->dx);
    if (chance(r, 0.2)) /* cells of another shape */
        s->cells[1] = even(r, 4, 2 * n);
    make_fluid(s, r);
    settle(s, r, integrator(s, r, true));
    if (waves < 6.0 && strcmp(s->field, "rest") && strcmp(s->field, "uniform"))
        s->standard = s->unforced = false; /* means of four cells a wave hold 2/3 of its energy */
    if (waves > 12.0 && s->cells[1] >= n && !strstr(s->fv_more, "newton") && make_lasting(s))
        s->error = 0.1;
}

static void closed(struct scene *s, struct random *r)
{
    s->dim = chance(r, 0.2) ? 3 : 2;
    const int most = s->dim > 2 ? 12 : 32;
    box_of(s, r, whole(r, 4, most), whole(r, 4, most), whole(r, 4, most));
    s->speed = decades(r, 0.02, 30.0);
    s->length = s->dx * s->cells[0];
    make_fluid(s, r);
    make_sides(s, r, NULL);
    if (chance(r, 0.5))
        make_gravity(s, r, decades(r, 0.1, 100.0), 1);
    s->closed = s->unforced = s->still = true;
    if (chance(r, 0.7)) {
        s->sides[2].kind = "no_slip";
        s->sides[2].velocity[0] = s->speed;
        s->unforced = s->still = false;
    }
    s->U = s->speed;
    s->say_U = chance(r, 0.6);
    s->mirrors = s->turns = s->shifts = true;
    s->cycles = s->dim == 3;
    if (s->dim == 2 && chance(r, 0.25) && s->cells[1] > 16) { /* rows that grow downwards */
        s->graded[1] = s->cells[1] / 2;
        s->graded[0] = s->lo[1] + uniform(r, 0.5, 0.7) * (s->hi[1] - s->lo[1]);
        s->turns = false;
        settle(s, r, 1.0);
    } else
        settle(s, r, integrator(s, r, true));
}

static void channel(struct scene *s, struct random *r)
{
    s->dim = 2;
    box_of(s, r, even(r, 4, 16), whole(r, 4, 40), 1);
    make_channel(s, r, s->hi[1] - s->lo[1]);
    settle(s, r, integrator(s, r, true));
}

/* Streams through a box: along a channel, or oblique with two inlets. */
static void openings(struct scene *s, struct random *r)
{
    s->dim = 2;
    box_of(s, r, whole(r, 6, 40), whole(r, 6, 32), 1);
    s->speed = s->U = decades(r, 0.02, 30.0);
    s->say_U = true;
    s->length = s->hi[1] - s->lo[1];
    make_fluid(s, r);
    make_sides(s, r, "slip");
    s->sides[0].kind = "inflow";
    s->sides[0].velocity[0] = s->speed;
    s->sides[1].kind = "outflow";
    s->sides[1].carried = chance(r, 0.4);
    if (chance(r, 0.5)) {
        s->field = "uniform";
        s->V[0] = s->speed;
    }
    if (chance(r, 0.4)) {
        s->V[1] = s->speed * uniform(r, 0.1, 2.0);
        s->sides[0].velocity[1] = s->sides[2].velocity[1] = s->V[1];
        s->sides[2].velocity[0] = s->V[0] = s->speed;
        s->field = "uniform";
        s->sides[2].kind = "inflow";
        s->sides[3].kind = "outflow";
        s->sides[3].carried = s->sides[1].carried;
    } else if (chance(r, 0.5)) {
        s->sides[0].profile = "parabolic";
        s->sides[2].kind = s->sides[3].kind = "no_slip";
    }
    s->stream = !strcmp(s->field, "uniform") && !s->sides[0].profile;
    s->mirrors = s->turns = s->shifts = true;
    settle(s, r, integrator(s, r, true));
}

static void add_box(struct scene *s, double x1, double y1, double z1)
{
    struct shape *h = s->shapes + s->nshapes++;
    h->form = "box";
    h->line.n = 2;
    for (int a = 0; a < 3; a++) /* on beyond the walls, but not above */
        h->line.x[0][a] = s->lo[a] - (s->g[a] > 0.0 ? 0.0 : 8.0 * s->dx);
    h->line.x[1][0] = x1;
    h->line.x[1][1] = y1;
    h->line.x[1][2] = z1;
    for (int a = 0; a < s->dim; a++)
        if (s->g[a] < 0.0)
            h->line.x[1][a] = fmin(h->line.x[1][a], s->hi[a]);
}

/* Water under a level set: columns, beds, discs. */
static void surface(struct scene *s, struct random *r)
{
    s->dim = chance(r, 0.15) ? 3 : 2;
    const int most = s->dim > 2 ? 12 : 32;
    box_of(s, r, whole(r, 6, most), whole(r, 6, most), whole(r, 6, most));
    double size[3];
    for (int a = 0; a < 3; a++)
        size[a] = s->hi[a] - s->lo[a];
    s->length = size[1];
    s->speed = sqrt(9.81 * size[1]);
    make_fluid(s, r);
    make_gravity(s, r, 9.81, 1);
    make_sides(s, r, NULL);
    const double beyond = 8.0 * s->dx;
    const double w = s->lo[0] + size[0] * uniform(r, 0.1, 0.9),
                 d = s->lo[1] + size[1] * uniform(r, 0.05, 0.8);
    const int kind = whole(r, 0, 3);
    if (kind == 0) { /* at rest, or almost */
        add_box(s, s->hi[0] + beyond, d, s->hi[2] + beyond);
    } else {
        add_box(s, w, d, kind == 2 && s->dim > 2 ? s->lo[2] + 0.5 * size[2] : s->hi[2] + beyond);
        if (kind == 3)
            add_box(s, s->hi[0] + beyond, s->lo[1] + uniform(r, 0.2, 1.0) * (d - s->lo[1]),
                    s->hi[2] + beyond);
    }
    s->U = s->speed;
    s->say_U = chance(r, 0.5);
    s->closed = true;
    s->mirrors = s->turns = s->shifts = true;
    s->cycles = s->dim == 3;
    settle(s, r, s->dim > 2 ? 20.0 : 10.0);
    s->mass = s->rho * size[0] * size[1] * (s->dim > 2 ? size[2] : 1.0);
}

static void wave(struct scene *s, struct random *r)
{
    s->dim = 2;
    const int nx = even(r, 8, 48), ny = whole(r, 5, 24), air = whole(r, 3, 8);
    box_of(s, r, nx, ny + air, 1);
    make_wave(s, r, (s->hi[1] - s->lo[1]) * ny / (ny + air), s->hi[0] - s->lo[0]);
    s->sides[3].kind = "slip";
    settle(s, r, 10.0);
}

/* --- blocks --- */

static void all_sides(struct block *b, const char *i_min, const char *i_max, const char *j_min,
                      const char *j_max)
{
    b->sides[0] = i_min;
    b->sides[1] = i_max;
    b->sides[2] = j_min;
    b->sides[3] = j_max;
}

static struct block *add_block(struct scene *s, const char *mapping, int nx, int ny)
{
    struct block *b = s->blocks + s->nblocks++;
    b->mapping = mapping;
    b->cells[0] = nx;
    b->cells[1] = ny;
    memcpy(b->lo, s->lo, sizeof b->lo);
    memcpy(b->hi, s->hi, sizeof b->hi);
    for (int a = 0; a < 3; a++)
        b->centre[a] = b->focus[a] = 0.5 * (s->lo[a] + s->hi[a]);
    return b;
}

/* Waves on 2 x 2 joined blocks, or on one with another over it, turned. */
static void block_fields(struct scene *s, struct random *r)
{
    s->dim = 2;
    const int n = even(r, 16, 32);
    s->dx = make_spacing(r);
    for (int a = 0; a < 2; a++) {
        s->cells[a] = n;
        s->hi[a] = n * s->dx;
        s->periodic[a] = true;
    }
    s->speed = decades(r, 0.02, 30.0);
    const double waves = make_waves(s, r, n, s->dx);
    make_fluid(s, r);
    s->shifts = false;
    const double half = 0.5 * s->hi[0];
    if (chance(r, 0.5)) {
        for (int k = 0; k < 4; k++) {
            struct block *b = add_block(s, "box", n / 2, n / 2);
            b->lo[0] = k % 2 ? half : 0.0;
            b->lo[1] = k / 2 ? half : 0.0;
            b->hi[0] = b->lo[0] + half;
            b->hi[1] = b->lo[1] + half;
            all_sides(b, k % 2 ? "joined" : "periodic", k % 2 ? "periodic" : "joined",
                      k / 2 ? "joined" : "periodic", k / 2 ? "periodic" : "joined");
        }
    } else {
        const char *p = "periodic";
        struct block *b = add_block(s, chance(r, 0.3) ? "sheared" : "box", n, n);
        b->wave = b->mapping[0] == 's' ? uniform(r, -0.04, 0.04) : 0.0;
        all_sides(b, p, p, p, p);
        if (b->mapping[0] == 'b') {
            const double reach = half * uniform(r, 0.4, 0.6);
            const int fine = (int)(2.0 * reach / s->dx * uniform(r, 0.8, 1.6)) + 6;
            b = add_block(s, "box", fine, fine);
            for (int a = 0; a < 2; a++) {
                b->lo[a] = half - reach;
                b->hi[a] = half + reach;
            }
            b->angle = uniform(r, -90.0, 90.0);
        }
    }
    settle(s, r, 6.0);
    s->mirrors = s->turns = s->turns_half = s->shifts_by_L = false;
    if (waves > 12.0 && make_lasting(s))
        s->error = 0.1;
}

/* A ring between turning walls, a cavity with finer cells at its walls, a duct. */
static void block_walls(struct scene *s, struct random *r)
{
    s->dim = 2;
    box_of(s, r, whole(r, 8, 24), whole(r, 8, 24), 1);
    s->speed = s->U = decades(r, 0.02, 30.0);
    s->say_U = true;
    s->length = s->hi[0] - s->lo[0];
    make_fluid(s, r);
    const int kind = whole(r, 0, 2);
    struct block *b = add_block(s,
                                kind == 0        ? "annulus"
                                : chance(r, 0.6) ? "stretched"
                                                 : "box",
                                s->cells[0], s->cells[1]);
    if (b->mapping[0] == 's')
        b->stretch[0] = b->stretch[1] = uniform(r, -1.5, 3.0);
    s->closed = kind < 2;
    if (kind == 0) {
        const double outer = 0.5 * fmin(s->hi[0] - s->lo[0], s->hi[1] - s->lo[1]);
        b->radius[0] = outer * uniform(r, 0.2, 0.9);
        b->radius[1] = outer;
        b->cells[1] = whole(r, 24, 48);
        b->spin[0] = s->speed / b->radius[0];
        b->spin[1] = chance(r, 0.5) ? -b->spin[0] : 0.0;
        all_sides(b, "wall", "wall", "joined", "joined");
    } else if (kind == 1) {
        all_sides(b, "wall", "wall", "wall", "wall");
        if (chance(r, 0.6)) {
            b->velocity[0] = s->speed;
            b->lid = "j_max";
        } else
            s->still = s->unforced = true;
        if (chance(r, 0.5))
            make_gravity(s, r, 9.81, 1);
    } else {
        all_sides(b, "inflow", "outflow", "slip", "slip");
        b->velocity[0] = s->speed;
    }
    s->shifts = true;
    settle(s, r, 6.0);
}

/* --- coupled --- */

static void coupled(struct scene *s, struct random *r)
{
    s->dim = 2;
    const int n = even(r, 40, 56), margin = whole(r, 2, 6);
    s->dx = make_spacing(r);
    for (int a = 0; a < 2; a++) {
        s->cells[a] = even(r, n / 4, n / 2);
        s->hi[a] = n * s->dx;
        s->periodic[a] = true;
        s->box[0][a] = margin * s->dx;
        s->box[1][a] = (n - margin) * s->dx;
    }
    s->speed = decades(r, 0.02, 30.0);
    make_waves(s, r, n, s->dx);
    make_fluid(s, r);
    s->nu = fmax(s->nu, 1e-4 * s->speed * s->length);
    s->steps = whole(r, 4, 24);
    double carried = 0.0;
    for (int a = 0; a < 2; a++)
        carried += s->V[a] * s->V[a];
    double dt = 0.15 * s->dx / (s->speed + sqrt(carried));
    dt = fmin(dt, 0.03 * 16.0 * s->dx * s->dx / s->nu);
    make_end(s, r, dt, 3e-6 * n * n * 2.0);
    s->program = COUPLED;
    s->mass = s->rho * n * n * s->dx * s->dx;
    s->closed = s->free_of_walls = s->still = false;
    s->mirrors = s->turns = s->turns_half = s->shifts = s->shifts_by_L = false;
    s->error = strcmp(s->field, "rest") && make_lasting(s) ? 0.25 : 0.0;
}

const struct family fv_families[] = {{"fv fields", 4, fields},
                                     {"fv closed", 3, closed},
                                     {"fv channel", 1.5, channel},
                                     {"fv openings", 3, openings},
                                     {"fv surface", 4, surface},
                                     {"fv wave", 1, wave},
                                     {"fv block fields", 2, block_fields},
                                     {"fv block walls", 2, block_walls},
                                     {"coupled", 1, coupled},
                                     {NULL, 0, NULL}};
