/* properties_sph.c - random scenes of particles. SPDX-License-Identifier: BSD-3-Clause */
#include "properties_families.h"

#include <string.h>

/* Without viscosity walls are slip walls. */
static void nothing_sticks(struct scene *s)
{
    for (int k = 0; k < 6; k++)
        if (s->sides[k].kind && !strcmp(s->sides[k].kind, "no_slip"))
            s->sides[k].kind = "slip";
    for (int k = 0; k < LISTS; k++)
        s->walls[k].kind = s->bodies[k].kind = "slip";
}

/* Half of the scenes have a scale of velocity, as their writer knows one; c0 is the default. */
void settle_particles(struct scene *s, struct random *r, int particles)
{
    static const char *const schemes[] = {" scheme = \"riemann\";", " scheme = \"riemann_ale\";",
                                          " scheme = \"delta\";", " scheme = \"standard\";"};
    double carried = 0.0, gH = 0.0;
    s->program = SPH;
    if (s->nu == 0.0)
        nothing_sticks(s);
    if (chance(r, 0.25)) {
        const int k = whole(r, 0, 3);
        s->sph_more = schemes[k];
        s->standard = false;
    }
    for (int a = 0; a < s->dim; a++) {
        carried += s->V[a] * s->V[a];
        gH += s->periodic[a] ? 0.0 : fabs(s->g[a]) * (s->hi[a] - s->lo[a]);
    }
    const double U = s->say_U ? s->U : fmax(1.0, s->speed);
    const double c0 = 10.0 * fmax(U + sqrt(carried), sqrt(gH)), R = 4.0 * s->dx;
    double dt = 0.375 * R / c0;
    if (s->nu > 0.0)
        dt = fmin(dt, 0.03 * R * R / s->nu);
    make_end(s, r, dt, particles * (s->dim > 2 ? 1.2e-5 : s->nwalls + s->nbodies ? 5e-6 : 3e-6));
    s->mass = s->rho * particles * pow(s->dx, s->dim);
}

void make_particles(struct scene *s, struct random *r, int nx, int ny, int nz)
{
    const int n[3] = {nx, ny, nz};
    s->dx = make_spacing(r);
    const double h[3] = {s->dx, s->dx, s->dx};
    make_box(s, r, n, h);
}

/* Vortices start from noise, which neither mirrors nor turns; half of them go without. */
static void noise_of(struct scene *s, struct random *r)
{
    if (!strcmp(s->field, "rest") || !strcmp(s->field, "uniform"))
        return;
    s->even = chance(r, 0.5);
    s->mirrors = s->mirrors && s->even;
    s->turns = s->turns && s->even;
    s->turns_half = s->turns_half && s->even;
    s->cycles = s->cycles && s->even;
}

static void fields(struct scene *s, struct random *r)
{
    s->dim = chance(r, 0.2) ? 3 : 2;
    const int n = s->dim > 2 ? whole(r, 10, 11) : whole(r, 10, 32);
    const int wide = s->dim == 2 && chance(r, 0.3) ? 2 : 1;
    make_particles(s, r, n * wide, n, n);
    s->speed = decades(r, 0.02, 30.0);
    for (int a = 0; a < s->dim; a++) {
        s->hi[a] -= s->lo[a];
        s->lo[a] = 0.0;
        s->periodic[a] = true;
    }
    const double waves = make_waves(s, r, n, s->dx);
    make_fluid(s, r);
    settle_particles(s, r, n * n * wide * (s->dim > 2 ? n : 1));
    if (waves > 12.0 && s->standard && strcmp(s->field, "rest") && make_lasting(s))
        s->error = 0.25;
    noise_of(s, r);
}

/* Full of water, walls all around, some with a lid. */
static void closed(struct scene *s, struct random *r)
{
    s->dim = chance(r, 0.2) ? 3 : 2;
    const int most = s->dim > 2 ? 8 : 30, nx = whole(r, 1, most), ny = whole(r, 1, most),
              nz = s->dim > 2 ? whole(r, 1, most) : 1;
    make_particles(s, r, nx, ny, nz);
    s->length = s->dx * fmin(nx, ny);
    s->speed = decades(r, 0.02, 30.0);
    make_fluid(s, r);
    make_sides(s, r, NULL);
    if (chance(r, 0.6))
        make_gravity(s, r, decades(r, 0.1, 100.0), s->dim - 1);
    s->closed = s->unforced = s->still = true;
    if (chance(r, 0.4)) {
        s->sides[2].kind = "no_slip";
        s->nu = fmax(s->nu, 1e-6 * s->speed * s->length);
        s->sides[2].velocity[0] = s->speed * (chance(r, 0.5) ? 1.0 : -1.0);
        s->unforced = s->still = false;
    }
    s->U = s->speed;
    s->say_U = chance(r, 0.6) || !s->still;
    s->mirrors = s->turns = s->shifts = true;
    s->cycles = s->dim == 3;
    settle_particles(s, r, nx * ny * nz);
}

static void channel(struct scene *s, struct random *r)
{
    s->dim = 2;
    const int nx = whole(r, 10, 24), ny = whole(r, 2, 24);
    make_particles(s, r, nx, ny, 1);
    make_channel(s, r, ny * s->dx);
    settle_particles(s, r, nx * ny);
}

static void add_shape(struct scene *s, const char *form, double x0, double y0, double x1, double y1)
{
    struct shape *h = s->shapes + s->nshapes++;
    h->form = form;
    h->line.n = strcmp(form, "disc") ? 2 : 1;
    h->line.x[0][0] = x0;
    h->line.x[0][1] = y0;
    h->line.x[0][2] = s->lo[2];
    h->line.x[1][0] = x1;
    h->line.x[1][1] = y1;
    h->line.x[1][2] = s->hi[2];
}

/* Columns, beds and discs of water. Returns about how many cells of dx they fill. */
static int put_water(struct scene *s, struct random *r, int nx, int ny)
{
    const double h = s->dx, *lo = s->lo;
    const int kind = whole(r, 0, 4), w = whole(r, 1, nx), d = whole(r, 1, ny);
    if (kind == 0) { /* a level bed */
        add_shape(s, "box", lo[0], lo[1], s->hi[0], lo[1] + d * h);
        return nx * d;
    }
    add_shape(s, "box", lo[0], lo[1], lo[0] + w * h, lo[1] + d * h);
    int n = w * d;
    if (kind == 1 && w < nx) { /* over a wet bed */
        const int bed = whole(r, 1, d);
        add_shape(s, "box", lo[0] + w * h, lo[1], s->hi[0], lo[1] + bed * h);
        n += (nx - w) * bed;
    } else if (kind == 2 && nx - w > 4) { /* two columns */
        const int first = whole(r, w + 2, nx - 1), high = whole(r, 1, ny);
        add_shape(s, "box", lo[0] + first * h, lo[1], s->hi[0], lo[1] + high * h);
        n += (nx - first) * high;
    } else if (kind == 3 && ny - d > 6 && s->dim == 2) { /* a disc above */
        const double radius = h * uniform(r, 1.0, 0.4 * (ny - d));
        s->shapes[0].line.x[1][0] = s->hi[0];
        add_shape(s, "disc", 0.5 * (lo[0] + s->hi[0]), s->hi[1] - radius - h, 0.0, 0.0);
        s->shapes[1].radius = radius;
        n = nx * d;
    }
    return n;
}

/* Tanks as polylines: with slopes and steps, open above. */
static void tank_walls(struct scene *s, struct random *r)
{
    const double *lo = s->lo, *hi = s->hi, X = hi[0] - lo[0], Y = hi[1] - lo[1];
    const double at = lo[0] + X * uniform(r, 0.5, 0.7), high = Y * uniform(r, 0.1, 0.5);
    struct wall *w = s->walls + s->nwalls++;
    w->kind = one_of(r, "slip", "no_slip");
    double x[8][2] = {{lo[0], hi[1]},
                      {lo[0], lo[1]},
                      {at, lo[1]},
                      {at, lo[1] + high},
                      {at + 0.2 * X, lo[1] + high},
                      {at + 0.2 * X, lo[1]},
                      {hi[0], lo[1]},
                      {hi[0], hi[1]}};
    const int kind = whole(r, 0, 2); /* step, triangle, slope */
    if (kind == 1)
        x[3][0] = x[4][0] = at + 0.1 * X;
    for (int k = 0; k < 8; k++) {
        if ((kind == 1 && k == 4) || (kind == 2 && k > 2 && k < 7))
            continue;
        w->line.x[w->line.n][0] = kind == 2 && k == 7 ? hi[0] : x[k][0];
        w->line.x[w->line.n++][1] = x[k][1];
    }
}

void make_tank(struct scene *s, struct random *r)
{
    s->speed = sqrt(9.81 * (s->hi[1] - s->lo[1]));
    s->length = s->hi[1] - s->lo[1];
    make_fluid(s, r);
    make_gravity(s, r, 9.81, 1);
    s->closed = true;
    s->unforced = false;
    s->U = s->speed;
    s->say_U = chance(r, 0.5);
    s->mirrors = s->turns = s->shifts = true;
    s->cycles = s->dim == 3;
}

static void tank(struct scene *s, struct random *r)
{
    s->dim = chance(r, 0.15) ? 3 : 2;
    const int nx = whole(r, 4, s->dim > 2 ? 16 : 60), ny = whole(r, 4, s->dim > 2 ? 12 : 40),
              nz = s->dim > 2 ? whole(r, 3, 8) : 1;
    make_particles(s, r, nx, ny, nz);
    make_tank(s, r);
    const int n = put_water(s, r, nx, ny);
    if (s->dim == 2 && s->g[1] < 0.0 && chance(r, 0.35)) /* they are open above */
        tank_walls(s, r);
    else
        make_sides(s, r, NULL);
    for (int a = 0; a < s->dim && chance(r, 0.5); a++) /* open above */
        if (!s->nwalls && s->g[a] < 0.0)
            s->sides[2 * a + 1].kind = NULL, s->closed = fabs(s->g[a]) > 9.8;
    s->open_above = s->nwalls > 0;
    for (int a = 0; a < s->dim && !s->nwalls; a++)
        s->open_above = s->open_above || !s->sides[2 * a + 1].kind;
    struct probe *p = s->probes + s->nprobes++;
    const bool upright = s->dim == 2 && s->g[0] == 0.0; /* a gauge of levels wants that */
    p->kind = !upright || chance(r, 0.6) ? "pressure" : "level";
    s->turns = s->turns && p->kind[0] == 'p';
    p->at[0] = s->lo[0] + s->dx * whole(r, 0, nx);
    p->at[1] = s->lo[1] + (p->kind[0] == 'p' ? s->dx * uniform(r, 0.0, 3.0) : 0.0);
    p->at[2] = s->dim > 2 ? s->lo[2] + s->dx * whole(r, 0, nz) : 0.0;
    settle_particles(s, r, n * nz + 10);
}

/* A closed tank that leans, full or half full. */
static void tilted(struct scene *s, struct random *r)
{
    s->dim = 2;
    const int n = whole(r, 12, 40);
    make_particles(s, r, n, n, 1);
    const double c[2] = {0.5 * (s->lo[0] + s->hi[0]), 0.5 * (s->lo[1] + s->hi[1])};
    const double a = uniform(r, -0.8, 0.8), w = 0.33 * n * s->dx * uniform(r, 0.3, 1.0),
                 v = 0.33 * n * s->dx;
    const double fill = chance(r, 0.5) ? 1.0 : uniform(r, -0.5, 0.8);
    const double corners[4][2] = {{-w, v}, {-w, -v}, {w, -v}, {w, v}};
    make_tank(s, r);
    struct wall *tank = s->walls + s->nwalls++;
    struct shape *h = s->shapes + s->nshapes++;
    tank->closed = true;
    tank->kind = one_of(r, "slip", "no_slip");
    h->form = "polygon";
    for (int k = 0; k < 4; k++) {
        const double x = corners[k][0], y = corners[k][1], z = y > 0.0 ? fill * y : y;
        tank->line.x[k][0] = c[0] + cos(a) * x - sin(a) * y;
        tank->line.x[k][1] = c[1] + sin(a) * x + cos(a) * y;
        h->line.x[k][0] = c[0] + cos(a) * x - sin(a) * z;
        h->line.x[k][1] = c[1] + sin(a) * x + cos(a) * z;
    }
    tank->line.n = h->line.n = 4;
    s->still = s->unforced = fill == 1.0;
    settle_particles(s, r, (int)(2.0 * w * v * (1.0 + fill) / (s->dx * s->dx)) + 1);
}

/* Bodies in a full or half full tank, at rest or driven, or in a periodic box. */
static void driven(struct scene *s, struct random *r)
{
    s->dim = 2;
    const int nx = whole(r, 16, 44), ny = whole(r, 16, 36);
    make_particles(s, r, nx, ny, 1);
    make_tank(s, r);
    s->unforced = true;
    const bool full = chance(r, 0.5), open = full && chance(r, 0.4);
    const int deep = full ? ny : whole(r, 8, ny);
    if (open)
        s->periodic[0] = s->periodic[1] = true;
    for (int a = 0; a < 2 && open; a++)
        s->g[a] = 0.0;
    if (!full)
        add_shape(s, "box", s->lo[0], s->lo[1], s->hi[0], s->lo[1] + deep * s->dx);
    make_sides(s, r, NULL);
    const int count = chance(r, 0.2) ? 2 : 1;
    for (int k = 0; k < count; k++) {
        struct body *b = s->bodies + s->nbodies++;
        const double reach = s->dx * fmin(nx / count, ny), radius = reach * uniform(r, 0.1, 0.3);
        b->centre[0] = s->lo[0] + (k + 0.5) * nx * s->dx / count + reach * uniform(r, -0.1, 0.1);
        b->centre[1] = 0.5 * (s->lo[1] + s->hi[1]) + reach * uniform(r, -0.1, 0.1);
        b->kind = one_of(r, "slip", "no_slip");
        make_obstacle(&b->line, r, b->centre, radius);
        const int motion = whole(r, 0, 2);
        for (int a = 0; a < 2 && motion == 1; a++)
            b->velocity[a] = 0.3 * s->speed * uniform(r, -1.0, 1.0);
        b->spin = motion == 2 ? 0.3 * s->speed / radius * uniform(r, -1.0, 1.0) : 0.0;
        s->unforced = s->unforced && motion == 0;
    }
    s->still = s->unforced && full;
    s->say_U = s->say_U || open;
    settle_particles(s, r, nx * deep);
}

static void bodies(struct scene *s, struct random *r)
{
    void (*const make[])(struct scene *, struct random *) = {driven, make_floating, make_solid};
    static const char *const names[] = {"sph bodies", "sph floating", "sph solid"};
    const int k = whole(r, 0, 2);
    s->family = names[k];
    make[k](s, r);
}

/* A channel with inlet and outlet, or an oblique stream through an open box. */
static void openings(struct scene *s, struct random *r)
{
    s->dim = 2;
    const int nx = whole(r, 20, 44), ny = whole(r, 12, 24);
    make_particles(s, r, nx, ny, 1);
    s->speed = s->U = decades(r, 0.02, 30.0);
    s->say_U = true;
    s->length = ny * s->dx;
    make_fluid(s, r);
    make_sides(s, r, "slip");
    s->field = "uniform";
    s->V[0] = s->speed;
    s->sides[0].kind = "inflow";
    s->sides[1].kind = chance(r, 0.7) ? "outflow" : "absorbing";
    s->sides[0].velocity[0] = s->speed;
    const bool absorbs = !strcmp(s->sides[1].kind, "absorbing"); /* a far state that streams, too */
    s->sides[1].velocity[0] = absorbs ? s->speed : 0.0;
    if (chance(r, 0.3)) {
        s->V[1] = s->sides[0].velocity[1] = s->sides[2].velocity[1] =
            s->speed * uniform(r, 0.1, 1.0);
        s->sides[2].velocity[0] = s->speed;
        s->sides[2].kind = "inflow";
        s->sides[1].velocity[1] = absorbs ? s->V[1] : 0.0;
        s->sides[3].kind = "outflow";
    } else if (chance(r, 0.5)) {
        s->sides[0].profile = "parabolic";
        s->sides[2].kind = s->sides[3].kind = "no_slip";
    }
    s->stream = !s->sides[0].profile;
    s->mirrors = s->turns = s->shifts = true;
    settle_particles(s, r, nx * ny * 2);
}

static void patch_or_drop(struct scene *s, struct random *r)
{
    const bool drop = chance(r, 0.5);
    const int n = whole(r, 6, 24);
    s->dim = 2;
    s->dx = make_spacing(r);
    s->L = n * s->dx;
    for (int a = 0; a < 2; a++) {
        s->hi[a] = 3 * n * s->dx;
        s->lo[a] = -s->hi[a];
    }
    s->length = s->L;
    s->speed = s->U = decades(r, 0.02, 30.0);
    s->say_U = true;
    make_fluid(s, r);
    s->field = drop ? "drop" : "patch";
    s->central = drop ? s->U / s->L : 0.0;
    s->closed = true;
    s->unforced = s->turns = s->free_of_walls = !drop;
    s->mirrors = drop;
    settle_particles(s, r, n * n * (drop ? 4 : 1));
}

/* Lumps of water meet in the void. */
static void jets(struct scene *s, struct random *r)
{
    s->dim = chance(r, 0.15) ? 3 : 2;
    const int most = s->dim > 2 ? 5 : 14, n = 60;
    make_particles(s, r, n, n, s->dim > 2 ? n : 1);
    s->speed = s->U = decades(r, 0.02, 30.0);
    s->say_U = true;
    s->length = most * s->dx;
    make_fluid(s, r);
    int count = 0;
    const int gap = whole(r, 0, 4);
    for (int k = 0; k < 2; k++) {
        const int w = whole(r, 1, most), h = whole(r, 1, most),
                  d = s->dim > 2 ? whole(r, 1, most) : 1;
        const int x = k ? 30 + gap : 30 - w, y = whole(r, 28 - h, 32), z = whole(r, 28, 32);
        add_shape(s, "box", s->lo[0] + x * s->dx, s->lo[1] + y * s->dx, s->lo[0] + (x + w) * s->dx,
                  s->lo[1] + (y + h) * s->dx);
        struct shape *b = s->shapes + k;
        b->line.x[0][2] = s->lo[2] + z * s->dx;
        b->line.x[1][2] = s->lo[2] + (z + d) * s->dx;
        b->velocity[0] = s->speed * (k ? -1.0 : 1.0) * uniform(r, 0.0, 1.0);
        b->velocity[1] = s->speed * uniform(r, -0.5, 0.5);
        count += w * h * d;
    }
    if (s->dim == 2)
        s->hi[2] = s->lo[2] = 0.0;
    s->closed = s->unforced = s->free_of_walls = s->carried = true;
    s->mirrors = s->turns = s->shifts = true;
    s->cycles = s->dim == 3;
    settle_particles(s, r, count);
    s->end = fmin(s->end, 15.0 * s->dx / s->speed); /* nothing reaches the sides */
}

static void wave(struct scene *s, struct random *r)
{
    s->dim = 2;
    const int nx = whole(r, 20, 48), ny = whole(r, 5, 16), air = whole(r, 3, 8);
    make_particles(s, r, nx, ny + air, 1);
    make_wave(s, r, ny * s->dx, nx * s->dx);
    s->shifts_by_L = false;
    settle_particles(s, r, nx * ny);
}

/* Boxes and spheres of one or two levels in scenes that have room for them: at least R and two
 * spacings of the coarser level behind each edge. Their faces lie between the places of the lattice
 * and not on them, where rounding would decide. */
static void add_region(struct scene *s, struct random *r, int level)
{
    struct region *is = s->regions + s->nregions++;
    const double least = 12.5 * ldexp(s->dx, 1 - level);
    const bool flows = s->sides[0].kind && !strcmp(s->sides[0].kind, "inflow");
    const double off = flows ? 0.45 : 0.05; /* away from open sides */
    is->level = level;
    is->radius = chance(r, 0.3) ? least * uniform(r, 0.55, 0.8) : 0.0;
    for (int a = 0; a < s->dim; a++) {
        const double L = s->hi[a] - s->lo[a],
                     length = fmin(least * uniform(r, 1.0, flows ? 1.2 : 2.0), 0.9 * L);
        const double from = s->lo[a] + uniform(r, off, 1.0 - off) * (L - length);
        is->lo[a] = is->radius > 0.0 ? s->lo[a] + uniform(r, 0.45, 0.55) * L : from;
        is->hi[a] = from + length;
    }
}

/* In space a slab of level 1 across the longest axis, from a wall on if there is one: at least R
 * and two spacings at each edge. */
static bool add_slab(struct scene *s, struct random *r)
{
    int along = 0;
    for (int a = 1; a < 3; a++)
        along = s->hi[a] - s->lo[a] > s->hi[along] - s->lo[along] ? a : along;
    const double L = s->hi[along] - s->lo[along], least = s->periodic[along] ? 12.3 : 6.2;
    const double length = least * s->dx;
    if (L < length + 0.3 * s->dx)
        return false;
    struct region *is = s->regions + s->nregions++;
    *is = (struct region){.level = 1};
    memcpy(is->lo, s->lo, sizeof is->lo);
    memcpy(is->hi, s->hi, sizeof is->hi);
    if (s->periodic[along])
        is->lo[along] += uniform(r, 0.05, 0.95) * (L - length);
    is->hi[along] = is->lo[along] + length;
    return true;
}

/* Regions that move go at most three spacings, and stay in the domain; slowly enough for births. */
static void set_in_motion(struct scene *s, struct random *r)
{
    for (int k = 0; k < s->nregions; k++)
        for (int a = 0; a < s->dim && s->regions[k].offset == 0.0; a++)
            s->regions[k].velocity[a] =
                fmin(3.0 * s->dx / s->end, 0.5 * s->speed) * uniform(r, -1.0, 1.0);
}

/* What the flow asks for, of a kind that the scene has. */
static void ask(struct scene *s, struct random *r)
{
    const bool wet = s->nshapes > 0, still = s->still;
    s->criterion = wet && chance(r, 0.5)     ? "surface"
                   : still || chance(r, 0.3) ? "pressure"
                                             : "vorticity";
    s->bound = !strcmp(s->criterion, "surface") ? whole(r, 0, 1) : decades(r, 0.02, 0.5);
}

static bool add_regions(struct scene *s, struct random *r)
{
    int level = s->sides[0].profile || s->stream ? 1 : whole(r, 1, 2);
    bool room = s->dim == 2;
    for (int a = 0; a < s->dim; a++)
        room = room && s->hi[a] - s->lo[a] > 14.0 * s->dx;
    if (s->dim == 3 ? !add_slab(s, r) : !room)
        return false;
    if (s->nbodies > 0 && chance(r, 0.6)) /* R and two spacings, and some that flow */
        s->regions[s->nregions++] =
            (struct region){.level = 1, .offset = s->dx * uniform(r, 6.5, 9.0)};
    else if (s->dim == 2)
        add_region(s, r, level);
    if (s->dim == 2 && level == 1 && chance(r, 0.2))
        add_region(s, r, 1);
    return true;
}

static void refined(struct scene *s, struct random *r)
{
    void (*const make[])(struct scene *, struct random *) = {fields, closed, channel,  tank,
                                                             driven, tilted, openings, jets};
    make[whole(r, 0, 7)](s, r);
    for (int a = 0; a < 2 && s->sides[0].kind && !strcmp(s->sides[0].kind, "inflow"); a++)
        s->hi[a] += 32.0 * s->dx; /* room between the zones */
    const bool asked = s->dim == 2 && chance(r, 0.25);
    if (asked)
        ask(s, r);
    else if (!add_regions(s, r))
        return;
    int most = asked ? 1 : 0;
    for (int k = 0; k < s->nregions; k++)
        most = s->regions[k].level > most ? s->regions[k].level : most;
    s->end *= s->dim == 3 ? 0.08 : most == 1 ? 0.2 : 0.05;
    if (chance(r, 0.35))
        set_in_motion(s, r);
    s->local_steps = chance(r, 0.25);
    s->carried = false; /* the regions stay */
    s->error = 0.0;     /* of waves that have gone through edges there is no table */
}

const struct family sph_families[] = {
    {"sph fields", 3, fields},     {"sph closed", 3, closed},
    {"sph channel", 1.5, channel}, {"sph tank", 5, tank},
    {"sph tilted", 2, tilted},     {"sph bodies", 4, bodies},
    {"sph openings", 2, openings}, {"sph patch or drop", 1, patch_or_drop},
    {"sph jets", 2, jets},         {"sph wave", 1, wave},
    {"sph refined", 4, refined},   {NULL, 0, NULL}};
