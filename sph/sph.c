/* sph.c - main program of the SPH solver. SPDX-License-Identifier: BSD-3-Clause */
#include "sph.h"

#include "../coupler/cpl_partner.h"
#include "bodies/sph_bodies.h"
#include "case/sph_case.h"
#include "coupling/sph_coupling.h"
#include "open_boundaries/sph_open_boundaries.h"
#include "output/sph_output.h"
#include "pairs/sph_pairs.h"
#include "parallel/domain.h"
#include "refinement/sph_refinement.h"
#include "time/sph_time.h"
#include "walls/sph_walls.h"

/* What a triangle near a particle costs, in pairs: three stages of integrals, fluxes, forces. */
static const double PAIRS_OF_TOUCH = 20.0;

/* About how many particles the run will have, of which so large a part of the region is filled. */
static double lattice(const struct run *r, double part)
{
    const struct sph_params *prm = sph_params_of(r);
    double n = part;
    for (int a = 0; a < r->scene.domain.dim; a++)
        n *= round((prm->box[1][a] - prm->box[0][a]) / prm->dx);
    return n;
}

/* Particles within the support of one. */
static double pairs_of_particle(const struct run *r)
{
    const double R = sph_params_of(r)->R_dx;
    return r->scene.domain.dim == 2 ? M_PI * R * R : 4.0 / 3.0 * M_PI * R * R * R;
}

/* Whether a triangle of a wall or body stands in water at the start, on either side. */
static bool is_wet(const struct run *r, const struct exact *e, const struct trimesh *m, int k)
{
    double x[3], n[3];
    bool wet = false;
    trimesh_normal(m, k, n);
    for (int way = -1; way <= 1 && !wet; way += 2) {
        trimesh_middle(m, k, x);
        vec3_add(x, 0.5 * way * sph_params_of(r)->dx, n);
        wet = scene_matter(&r->scene, e, x) == MATTER_FLUID;
    }
    return wet;
}

/* How many triangles particles have within their support, of all: beside a flat triangle of the
 * area A and the circumference U particles are in A R + pi U R^2/4 + 2 pi R^3/3 (half of Steiner's
 * formula), as many as have no room. Of large meshes some triangles stand for all. */
static double touches_of_meshes(const struct run *r, double n)
{
    enum { SAMPLES = 2000 };
    const struct sph_params *prm = sph_params_of(r);
    const double dx = prm->dx, R = prm->R_dx * dx;
    const struct exact e = exact_create(&r->scene);
    double sum = 0.0;
    for (int i = 0; r->scene.meshes && i < r->scene.meshes->n; i++) {
        const struct scene_mesh *is = r->scene.meshes->of + i;
        const int every = 1 + is->mesh.ntriangles / SAMPLES;
        for (int k = 0; k < is->mesh.ntriangles && is->owner != MESH_OF_SHAPE; k += every) {
            const int *v = is->mesh.vertex[k];
            double normal[3], U = 0.0, side[3];
            const double A = trimesh_normal(&is->mesh, k, normal);
            for (int c = 0; c < 3; c++) {
                vec3_from(is->mesh.x[v[c]], is->mesh.x[v[(c + 1) % 3]], side);
                U += vec3_length(side);
            }
            const double V = A * R + 0.25 * M_PI * U * R * R + 2.0 / 3.0 * M_PI * R * R * R;
            sum += is_wet(r, &e, &is->mesh, k) ? every * fmin(V / (dx * dx * dx), n) : 0.0;
        }
    }
    return sum;
}

/* The flow goes on in fv; other programs of a job may move bodies alone. */
static bool has_partner_flow(const struct run *r) { return r->coupled && r->scene.has_fv; }

/* Bytes of a particle: rows, lines, surface and places of the list, with room to grow; entries of
 * the list, 1.1 times what the support holds, and what pads them. */
static double bytes_per_particle(const struct run *r)
{
    const struct sph_params *prm = sph_params_of(r);
    const int dim = r->scene.domain.dim, rows = prm->integrator == INTEGRATOR_RK4 ? 4 : 3;
    const int surface = prm->surface == SURFACE_YES ? 2 * dim + dim * dim + 1 : 0;
    const double line = 8.0 * (rows * (2 * dim + 2) + 8 + (dim == 2 ? 8 : 16) + surface) + 10.0;
    return 1.12 * (line + 25.0) + 4.0 * 1.1 * (1.1 * pairs_of_particle(r) + LANES);
}

/* One line of what the scene uses and what it leaves out. */
static void describe_modules(const struct run *r, bool gravity, bool viscous)
{
    static const char *const walls[] = {"normal flux walls", "walls by mirrored ghosts",
                                        "walls by fixed ghosts"};
    const struct sph_params *prm = sph_params_of(r);
    const bool has_walls = sph_params_walls(&r->scene, prm);
    const struct log_use uses[] = {
        {viscous, prm->viscosity == VISCOSITY_MORRIS ? "viscous (Morris)" : "viscous (Monaghan)",
         "viscosity"},
        {gravity, "gravity", "gravity"},
        {has_walls, walls[prm->walls], "walls"},
        {r->scene.nbodies > 0, "bodies", "bodies"},
        {prm->surface == SURFACE_YES, "free surface", "free surface"},
        {sph_params_zones(r, prm),
         prm->outer == OUTER_SIDES ? "inlets and outlets" : "zones and openings",
         "zones and openings"},
        {prm->packing > 0, "packing", "packing"},
        {r->scene.nprobes > 0, "gauges", "gauges"},
        {regions_finest(r, prm) < prm->dx, "refinement", "refinement"},
    };
    log_uses(uses, (int)(sizeof uses / sizeof *uses));
}

/* Lines that ran the other way. */
static void say_turned(const struct scene *c)
{
    for (int k = 0; k < c->nwalls; k++)
        if (c->walls[k].turned)
            log_say("wall %d: its points had the fluid on their right: turned", k + 1);
    for (int k = 0; k < c->nbodies; k++)
        if (c->bodies[k].turned)
            log_say("body %d (%s): its points ran %sclockwise: turned", k + 1, c->bodies[k].name,
                    c->bodies[k].tank ? "" : "counter-");
    for (int k = 0; k < c->nbodies; k++)
        if (c->bodies[k].tank)
            log_say("body %d (%s) is a tank: it holds all water of the shapes", k + 1,
                    c->bodies[k].name);
    for (int k = 0; k < c->nbodies; k++)
        if (c->bodies[k].cut)
            log_say("body %d (%s): what of it is beyond closed sides or behind lines is left out",
                    k + 1, c->bodies[k].name);
}

/* Of a box that reaches beyond the domain, which ends it. */
static void say_cut_box(const struct run *r)
{
    const struct scene_domain *d = &r->scene.domain;
    double box[2][3];
    if (!crossing_box(r, r->name, box))
        return;
    for (int a = 0; a < d->dim; a++) {
        const double lo = d->min[a], hi = d->max[a], near = 1e-6 * (hi - lo);
        if (!d->periodic[a] && (box[0][a] < lo - near || box[1][a] > hi + near))
            log_say("%s.box: %c from %g to %g m ends at the domain's sides, %g to %g m", r->name,
                    "xyz"[a], box[0][a], box[1][a], lo, hi);
    }
}

static void describe_scene(const struct run *r)
{
    static const char *const schemes[] = {"Riemann ALE (Vila)", "Riemann without mass flux (Leduc)",
                                          "delta-SPH (Antuono)", "artificial viscosity"};
    static const char *const limiters[] = {"Koren", "minmod", "no limiter"};
    static const char *const transports[] = {"whole-support shifting", "shifting of Oger",
                                             "no shifting", "particles at rest", "X-SPH"};
    static const char *const outers[] = {"none", "exact solution", "partner", "inlets and outlets"};
    const struct sph_params *prm = sph_params_of(r);
    const double *g = r->scene.fluid.gravity;
    const bool gravity = g[0] != 0.0 || g[1] != 0.0 || g[2] != 0.0,
               viscous = r->scene.fluid.nu > 0.0;
    const bool riemann = sph_params_is_riemann(prm->scheme);
    log_say("%dD, %s%s%s, %s%s%s%s", r->scene.domain.dim, schemes[prm->scheme], riemann ? ", " : "",
            riemann ? limiters[prm->limiter] : "", transports[prm->transport],
            riemann && prm->low_dissipation ? ", low dissipation" : "",
            riemann && prm->damper > 0.0 ? ", acoustic damper" : "",
            prm->background ? ", background pressure" : "");
    describe_modules(r, gravity, viscous);
    say_turned(&r->scene);
    if (sph_params_zones(r, prm)) {
        double box[2][3], transition, buffer;
        zones_widths(r, prm, &transition, &buffer);
        zones_free_box(r, prm, box[0], box[1]);
        log_say("free zone %s m, transition %g m, buffer %g m, around it: %s",
                zones_extent(r->scene.domain.dim, box), transition, buffer, outers[prm->outer]);
        say_cut_box(r);
    }
    if (wave_stream_wanted(r, prm))
        log_say(
            "behind the zones before open sides: the waves on their current with their pressure "
            "and level, behind a beach the mean flow");
    else if (!has_partner_flow(r) && prm->surface == SURFACE_YES)
        openings_describe(&r->scene);
    if (!r->coupled || !r->scene.has_fv) /* which says it */
        scene_waves_describe(&r->scene);
    const double h[3] = {prm->dx, prm->dx, prm->dx}, wave_points[2] = {40.0, 1.5};
    scene_waves_resolution(&r->scene, "particles", h, wave_points);
    paddles_describe(r, prm);
}

/* Two rows between walls have no particle that is not a wall's neighbour: a full tank of 2 dx stirs
 * at 8e-3 c0 where one of 3 dx and more stays below 2e-3. */
static void warn_narrow(const struct run *r, const struct sph_params *prm)
{
    const struct scene *c = &r->scene;
    for (int a = 0; a < c->domain.dim; a++) {
        const double length = c->domain.max[a] - c->domain.min[a];
        if (scene_side_is_wall(c, SIDE_X_MIN + 2 * a) &&
            scene_side_is_wall(c, SIDE_X_MIN + 2 * a + 1) && length < 2.5 * prm->dx)
            log_warn("2 particles between the walls along %c, %g m: the flow there is noise; take "
                     "sph.dx = %.3g m or less",
                     "xyz"[a], length, 0.25 * length);
    }
}

static void warn_of_passage(const struct run *r, const struct sph_params *prm)
{
    struct wall_thin t;
    if (r->scene.domain.dim == 3 || !prm->speed.moves ||
        !wall_thin_passage(&r->scene, SPH_PASSAGE * prm->dx, &t))
        return;
    sph_passage_warn(key_text("%s are %.3g m apart at (%g, %g)", t.what, t.width, t.at[0], t.at[1]),
                     t.width, prm->dx);
}

/* Whether water stands around most of the mesh of a body at the start. */
static bool has_body_in_water(const struct run *r)
{
    const struct exact e = exact_create(&r->scene);
    bool any = false;
    for (int i = 0; r->scene.meshes && i < r->scene.meshes->n && !any; i++) {
        const struct scene_mesh *is = r->scene.meshes->of + i;
        int wet = 0;
        for (int k = 0; k < is->mesh.ntriangles && is->owner == MESH_OF_BODY; k++)
            wet += is_wet(r, &e, &is->mesh, k);
        any = wet > 0.75 * is->mesh.ntriangles;
    }
    return any;
}

/* Tank at rest, 16 rows, 2D: the floor's pressure is 27, 11, 6, 1 % too large with R/dx 1.5, 1.6,
 * 1.8, 2, and the water is stirred at Mach 0.015 below 1.8; 6 % in 3D with 1.6. */
static void warn_of_support(const struct sph_params *prm)
{
    if (prm->R_dx < 1.9)
        log_warn("sph.R_dx = %g: particles have too few neighbours: water at rest does not stay "
                 "so, and its pressures are 6 to 27 %% too large; take 2.5 or more",
                 prm->R_dx);
}

/* Pairs of a lattice transmit less than the pressure where the support is small (0.967 of it at
 * R/dx 2.5 in 2D, 0.979 in 3D, 0.997 and 1.001 at 3), so that what presses uniformly does not
 * cancel around a body; in 3D its first rows stand off, too, and the more the worse it fits the
 * lattice. */
static void warn_of_lift(const struct run *r, const struct sph_params *prm)
{
    const struct scene *c = &r->scene;
    const bool flat = c->domain.dim == 2;
    if (prm->R_dx < 3.0 && vec3_length(c->fluid.gravity) > 0.0 &&
        (flat ? c->nbodies > 0 : has_body_in_water(r)))
        log_warn("sph.R_dx = %g: the lift of bodies under water is %s %% too large at 2.5, %s %% "
                 "at 3; take 3 or more",
                 prm->R_dx, flat ? "6" : "3 to 14", flat ? "0.5" : "0.3 to 1.6");
}

/* An inflow into fluid at rest that has no surface: fv has the flow at once, particles after its
 * sound, rho c0 U, has run to and fro. */
static void warn_of_start(const struct run *r, const struct sph_params *prm)
{
    const struct scene *c = &r->scene;
    const bool rests =
        c->initial.field == FIELD_REST && !scene_has_surface(c) && !scene_shapes_flow(c);
    double U = 0.0;
    for (int k = 0; k < c->nwalls && rests; k++)
        if (c->walls[k].kind == WALL_INFLOW)
            U = fmax(U, vec3_length(c->walls[k].velocity));
    if (U > 0.0)
        log_warn("initial.field: the fluid rests, and an inflow of %.3g m/s begins at once: %s; "
                 "start with field = \"uniform\" and that velocity",
                 U,
                 has_partner_flow(r)
                     ? "in fv everywhere, in sph by its sound, so the programs part, "
                       "and may end"
                     : key_text("its sound, rho c0 U = %.3g Pa, runs to and fro for "
                                "long, and what refines or moves may not bear it",
                                c->fluid.rho * prm->c0 * U));
}

/* Where no surface lets it out the sound of a jump runs to and fro. A disc of 8 dx that is
 * accelerated uniformly from rest in a full box of ten times its radius has 109 to 172 kg/m of
 * added mass over a period of 0.5 s with c0 10 m/s, 108 to 170 over 0.25 s with 20, 137 on average.
 */
static void warn_of_jolts(const struct run *r, const struct sph_params *prm)
{
    const struct scene *c = &r->scene;
    const double period = 2.0 * prm->speed.across / prm->c0, *U = c->initial.velocity;
    if (scene_has_surface(c) || !(period > 0.0))
        return;
    const struct body_jolt j = bodies_jolt(c, r->motions, U, c->time.end - period);
    if (j.u > 0.0)
        log_warn("bodies: %s changes its velocity by %.3g m/s at once, at t = %.3g s, in a room "
                 "without air: its sound, rho c0 U = %.2g Pa, runs to and fro for long, and forces "
                 "and pressures swing with it: read their means over whole periods of some %.3g s, "
                 "or let the motion begin with a ramp of several",
                 j.name, j.u, j.at, c->fluid.rho * prm->c0 * j.u, period);
    else if (j.name)
        log_warn("bodies: %s changes its acceleration by %.3g m/s^2 at once, at t = %.3g s, in a "
                 "room without air: its sound runs to and fro for long, and its force swings by a "
                 "fifth with it, whatever sph.c0 is: read means over whole periods of some %.3g s",
                 j.name, j.a, j.at, period);
}

/* A tank of 48 x 32 particles without air, a level's edge across it: Mach 0.018 after 1.4 s of
 * rest, twice that each half a second. Under a surface riemann_ale does not rest either: water of
 * 12 rows, half of its length refined, after 3 s Mach 0.018, at the floor 2.6 % too much (riemann
 * 0.0005, -0.5 %), with an outlet's level 0.012, -3 %; the bed refined alone 0.003, 6 %. */
static void warn_of_levels(const struct run *r, const struct sph_params *prm)
{
    double g[3];
    if (!apr_params_of(r) || scene_still_gravity(&r->scene, g) == 0.0)
        return;
    if (prm->surface == SURFACE_NO)
        log_warn("apr: under weight, without air, fluid at rest is stirred more and more where "
                 "levels of refinement meet: leave fluid.gravity away and add rho g h to its "
                 "pressures, or leave air above it");
    else if (prm->scheme == SCHEME_RIEMANN_ALE)
        log_warn("apr: under weight, with sph.scheme = \"riemann_ale\", water at rest is stirred "
                 "where levels of refinement meet (Mach 0.01 to 0.02), pressures err by up to 6 %% "
                 "of its depth: %s",
                 prm->outer != OUTER_NONE
                     ? "where sides are open, which need that scheme, refine sph.dx instead"
                     : "take \"riemann\"");
}

/* Pressures that compress the fluid by themselves; a speed of sound of ten times what the scene
 * asks for costs ten times the steps. */
static void warn_of_pressures(double c0, const struct scene_speed *v)
{
    const struct {
        double p;
        const char *what;
    } all[] = {{v->pressure, "the static pressure alone"},
               {v->viscous, "friction alone (nu U/L)"},
               {v->pushed, "the acceleration of bodies alone"}};
    double asked = v->moves ? v->speed : INFINITY;
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++) {
        asked = fmax(asked, sqrt(all[k].p));
        if (c0 * c0 < 30.0 * all[k].p) {
            log_warn("sph.c0 = %g m/s: %s compresses by %.2g %%; raise it to %.3g m/s", c0,
                     all[k].what, 100.0 * all[k].p / (c0 * c0), 10.0 * sqrt(all[k].p));
            return;
        }
    }
    const double room = 6.0 * v->across * v->rate;
    asked = fmax(asked, 0.1 * room);
    if (c0 < 0.6 * room)
        log_warn("sph.c0 = %g m/s: bodies swing in %.3g s, and a wave of sound that stands in the "
                 "fluid in %.3g s, so it answers them with compression; raise it to %.3g m/s",
                 c0, 1.0 / v->rate, 2.0 * v->across / c0, room);
    if (c0 > 100.0 * asked)
        log_warn("sph.c0 = %g m/s takes %.2g times the steps of %.3g m/s, which keep the density "
                 "within 1 %%: that of real water is not needed; leave sph.c0 out",
                 c0, 0.1 * c0 / asked, 10.0 * asked);
}

static void warn_of(const struct run *r)
{
    const struct sph_params *prm = sph_params_of(r);
    const struct scene_speed v = prm->speed;
    const double bound = sph_params_cfl_bound(prm, r->scene.domain.dim);
    warn_narrow(r, prm);
    warn_of_support(prm);
    warn_of_lift(r, prm);
    warn_of_start(r, prm);
    warn_of_jolts(r, prm);
    warn_of_levels(r, prm);
    if (prm->outer == OUTER_SIDES && prm->surface == SURFACE_YES &&
        prm->scheme != SCHEME_RIEMANN_ALE)
        log_warn(
            "inlets and outlets under a free surface need sph.scheme = \"riemann_ale\": with "
            "the others, whose masses do not follow their packing, the level wanders by a tenth "
            "in ten transits");
    sph_meshes_warn(r, prm);
    warn_of_passage(r, prm);
    sph_falls_warn(r, prm);
    if (prm->cfl > 0.85 * bound)
        log_warn("sph.cfl = %g is close to the stability bound of this scheme, %g", prm->cfl,
                 bound);
    if (v.moves && prm->c0 < 8.0 * v.speed)
        log_warn("sph.c0 = %g m/s is below 8 times the %.3g m/s expected in the scene (%s): the "
                 "density will vary by %.2g %% and more; raise it to %.3g m/s",
                 prm->c0, v.speed, v.from, 100.0 * pow(v.speed / prm->c0, 2.0), 10.0 * v.speed);
    else
        warn_of_pressures(prm->c0, &v);
    if (sph_params_zones(r, prm)) {
        double transition, buffer;
        const double least = 1.25 * prm->R_dx * prm->dx * (1.0 - 1e-9);
        zones_widths(r, prm, &transition, &buffer);
        if (transition < least || buffer < least)
            log_warn("transition %g m or buffer %g m is below 1.25 R = %g m", transition, buffer,
                     least);
    }
}

static void describe(const struct run *r)
{
    const struct sph_params *prm = sph_params_of(r);
    const char *limit;
    struct sph_params fine = *prm;
    fine.dx = regions_finest(r, prm);
    const struct first_water water = first_water_look(r, prm);
    double dt = sph_params_dt(&fine, r->scene.fluid.nu, prm->c0, &limit);
    const double n = lattice(r, water.kept);
    const double all = n + regions_particles(r, prm);
    describe_scene(r);
    scene_meshes_say(&r->scene);
    log_say("about %.0f particles, dx %g m, R/dx %g, c0 %g m/s; %.0f MB", n, prm->dx, prm->R_dx,
            prm->c0, 1e-6 * all * bytes_per_particle(r));
    regions_describe(r, prm);
    const struct scene_speed v = prm->speed;
    log_say("expected speed %.3g m/s: %s; c0 is %.3g times that%s", v.speed, v.from,
            prm->c0 / v.speed,
            prm->c0 == 6.0 * v.across * v.rate ? ": sound crosses the fluid in a sixth of a swing"
                                               : "");
    const double of_bodies = bodies_describe(r, &fine, dt);
    limit = of_bodies < dt ? "body" : limit;
    dt = fmin(dt, of_bodies);
    const double steps = ceil(r->scene.time.end / dt);
    const struct apr_params *apr = apr_params_of(r);
    log_say("dt about %.3g s (%s), %.0f steps%s", dt, limit, steps,
            apr && apr->local_steps ? " of the finest level; coarser ones take fewer" : "");
    forecast_warn_outputs(r->scene.output.every, r->scene.output.checkpoint, r->scene.time.end,
                          steps);
    if (all >= 1.0)
        forecast_say("sph", r->scene.domain.dim,
                     all * pairs_of_particle(r) + PAIRS_OF_TOUCH * touches_of_meshes(r, n), steps);
    else if (r->crossed)
        log_say("sph.box is dry at the start: what runs in from fv becomes particles");
    else
        log_warn(
            "there is no water at the start, or walls and bodies leave it no place: lines have "
            "fluid on their left; a body is a tank if all water of the shapes is inside "
            "and there are no walls");
    if (has_partner_flow(r))
        windows_describe(r, prm);
    if (has_partner_flow(r))
        coupling_warn(r, prm);
    if (!sph_params_zones(r, prm))
        first_water_warn(r, prm, water);
    warn_of(r);
}

static void draw(const struct run *r, struct picture *p)
{
    const struct sph_params *prm = sph_params_of(r);
    double lo[3], hi[3];
    regions_draw(r, prm, p);
    if (!sph_params_zones(r, prm))
        return;
    zones_free_box(r, prm, lo, hi);
    picture_box(p, PICTURE_ZONE, prm->box[0], prm->box[1], "particles");
    picture_box(p, PICTURE_ZONE, lo, hi, "free zone");
}

static void *create(struct run *r, struct h5 *f)
{
    if (!body_coupling_possible(r))
        return NULL;
    solids_deal(r);
    struct sph *s = sph_create(r, sph_params_of(r), f);
    if (s && has_partner_flow(r))
        sph_coupling_create(s);
    if (s && f && has_partner_flow(r))
        overlap_restart(s->zones->watched, f);
    if (s && r->coupled)
        body_coupling_create(s);
    return s;
}

static struct overlap *watched(const struct sph *s) { return s->zones ? s->zones->watched : NULL; }

static struct level_gap *gap(const struct sph *s) { return s->zones ? s->zones->gap : NULL; }

static double step(void *state, double t_stop, struct diagnosis *d)
{
    struct sph *s = state;
    if (watched(s))
        overlap_judge(s, d);
    return d->bad ? 0.0 : integrate_step(s, t_stop, d);
}

/* Outflows beyond which nothing stands are ends of the region, and no zones. */
static void complete(struct run *r)
{
    struct scene *c = &r->scene;
    if (has_partner_flow(r) || sph_params_of(r)->surface != SURFACE_YES)
        return;
    openings_resolve(c);
    for (int k = 0; k < c->nwalls; k++)
        c->walls[k].kind = c->walls[k].falls ? WALL_FALLS : c->walls[k].kind;
}

static void check(const struct run *r, struct faults *f)
{
    sph_params_check(r, f);
    if (params_has_group(r->params, "blocked") && !r->coupled) /* there fv refuses them */
        params_fault(r->params, f, "blocked", "boxes cut out of fv's cells: give them as bodies");
    if (f->n == 0 && has_partner_flow(r))
        coupling_check(r, sph_params_of(r), f);
    if (f->n == 0) {
        const struct sph_params *prm = sph_params_of(r);
        const double n = lattice(r, first_water_look(r, prm).kept) + regions_particles(r, prm);
        run_check_memory(r, f, "sph.dx", n, "particles", n * bytes_per_particle(r));
        regions_check_budget(r, n, f);
    }
}

static void offer(struct run *r)
{
    if (has_partner_flow(r))
        coupling_offer(r, sph_params_of(r));
}

static double longest_window(void *state)
{
    const struct sph *s = state;
    return has_partner_flow(s->run) ? windows_choose(s->run, &s->prm).T : body_coupling_window(s);
}

/* A new partition first: the patch is taken for each rank's part. By numbers alone: costs are known
 * where a snapshot has made a list, and not after a restart. */
static void window_begin(void *state, double t0, double t1)
{
    struct sph *s = state;
    if (has_partner_flow(s->run)) {
        for (struct sph *q = s; q; q = q->finer)
            q->lists.ready = false;
        domain_balance(s, 0.1);
        sph_coupling_window_begin(s, t0, t1);
    }
    body_coupling_begin(s, t0, t1);
}

static void window_end(void *state, double t1)
{
    struct sph *s = state;
    if (has_partner_flow(s->run))
        sph_coupling_window_end(s, t1);
    body_coupling_end(s, t1);
}

static void progress(void *state, char *line, int size)
{
    const struct sph *s = state;
    const struct sph *q = s;
    while (q->finer && q->level < s->step.limited_level)
        q = q->finer;
    snprintf(line, (size_t)size, "dt %.3g s (%s%s)  Ma %.3f  rho %+.2f .. %+.2f %%", s->dt,
             s->step.limited_by, sph_level_name(q), s->step.max_speed / s->c0,
             100.0 * (s->step.rho_min / s->rho0 - 1.0), 100.0 * (s->step.rho_max / s->rho0 - 1.0));
}

static void row(void *state, struct figures *to)
{
    struct sph *s = state;
    sph_row(s, to);
    if (watched(s))
        overlap_row(watched(s), to);
    if (gap(s))
        level_gap_row(s, to);
}

static void finish(void *state)
{
    struct sph *s = state;
    sph_finish(s);
    if (watched(s))
        overlap_summary(watched(s), s->run->summary);
    if (gap(s))
        level_gap_summary(s, s->run->summary);
}

static void tell(void *state, struct summary *report)
{
    struct sph *s = state;
    sph_tell(s, report);
    if (watched(s))
        overlap_tell(watched(s), report);
}

static const char *const others[] = {"sph", "sph_*", "fv", "blocks", "blocked", "coupler", NULL};

static const struct program sph_program = {.name = "sph",
                                           .help = "weakly compressible SPH, 2D and 3D",
                                           .meaning = 14,
                                           .groups = sph_groups,
                                           .ngroups = SPH_GROUPS,
                                           .other_groups = others,
                                           .meshes = sph_meshes_read,
                                           .mesh_owners = MESH_OF_ALL,
                                           .complete = complete,
                                           .check = check,
                                           .describe = describe,
                                           .draw = draw,
                                           .offer = offer,
                                           .create = create,
                                           .destroy = mem_free,
                                           .step = step,
                                           .longest_window = longest_window,
                                           .window_begin = window_begin,
                                           .window_end = window_end,
                                           .tell = tell,
                                           .row = row,
                                           .progress = progress,
                                           .snapshot = sph_snapshot,
                                           .checkpoint = sph_checkpoint,
                                           .finish = finish};

int main(int argc, char **argv) { return run_main(argc, argv, &sph_program, &cpl_partner); }
