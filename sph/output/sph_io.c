/* sph_io.c - snapshots for pictures and restart files. A snapshot has what the key output.fields
 * asks for, of particles that flow (guards only if asked for), as single-precision numbers, with
 * XDMF text beside it. A restart file has the state in full: particles of each level
 * (save_particles), numbers that are equal on all ranks (`numbers'), this rank's parts of sums
 * (h5_read_parts), then whatever each module writes of its own. What is saved in sph_checkpoint is
 * read in sph_restore in the same order, on any number of ranks.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../../common/files/files.h"
#include "../../common/scene/scene.h"
#include "../bodies/sph_bodies.h"
#include "../coupling/sph_coupling.h"
#include "../open_boundaries/sph_open_boundaries.h"
#include "../parallel/domain.h"
#include "../particles/sph_particles.h"
#include "../refinement/sph_refinement.h"
#include "../sph.h"
#include "../surface/sph_surface.h"
#include "../time/sph_time.h"
#include "../walls/sph_walls.h"
#include "restart_eos.h"
#include "sph_output.h"
#include "wall_files.h"

/* What particle i shows in a snapshot, v[ncomp]. Three components in 2D, too: ParaView wants
 * vectors of three. */
static void get_velocity(const struct sph *s, int i, double *v)
{
    for (int a = 0; a < 3; a++)
        v[a] = a < s->dim ? prim_line(&s->p, i)[s->dim + a] : 0.0;
}

/* With the linear part that the particles leave out. */
static void get_pressure(const struct sph *s, int i, double *v)
{
    const double *q = prim_line(&s->p, i);
    *v = scene_reference_at(&s->reference, s->dim, q) +
         eos_p(q[at_rho(s->dim)], s->rho0, s->c0, s->gamma);
}

static void get_density(const struct sph *s, int i, double *v)
{
    *v = prim_line(&s->p, i)[at_rho(s->dim)];
}

/* One component in 2D, three in 3D. */
static void get_vorticity(const struct sph *s, int i, double *v)
{
    double w[3];
    sph_vorticity(s, i, w);
    if (s->dim == 3)
        memcpy(v, w, sizeof w);
    else
        *v = w[2];
}

static void get_volume(const struct sph *s, int i, double *v)
{
    *v = prim_line(&s->p, i)[at_volume(s->dim)];
}
static void get_zone(const struct sph *s, int i, double *v) { *v = s->p.zone[i]; }
static void get_level(const struct sph *s, int i, double *v)
{
    (void)i;
    *v = s->level;
}
static void get_guard(const struct sph *s, int i, double *v) { *v = particles_is_guard(&s->p, i); }
/* Time since the particle came in; in a run without zones that since the start. */
static void get_age(const struct sph *s, int i, double *v)
{
    *v = s->zones ? openings_age(s, s->p.id[i]) : s->t;
}

/* Fields of a snapshot; ncomp 0: 1 in 2D and 3 in 3D. */
static const struct field {
    const char *name, *unit;
    int ncomp;
    void (*get)(const struct sph *s, int i, double *v);
} fields[] = {
    {"velocity", "m/s", 3, get_velocity},
    {"pressure", "Pa", 1, get_pressure},
    {"density", "kg/m^3", 1, get_density},
    {"vorticity", "1/s", 0, get_vorticity},
    {"volume", "m^dim", 1, get_volume},
    {"zone", "-", 1, get_zone},
    {"age", "s", 1, get_age},
    {"level", "-", 1, get_level},
    {"guard", "-", 1, get_guard},
};
enum { FIELDS = sizeof fields / sizeof fields[0] };

/* Whether a snapshot shows a particle: guards where the case asks for their column. */
static bool shows(const struct sph *s, int i)
{
    return !particles_is_guard(&s->p, i) || scene_shows(&s->run->scene, "guard");
}

/* Number of particles of this rank that a snapshot shows. */
static int64_t shown_here(const struct sph *s)
{
    int64_t n = 0;
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++)
            n += shows(q, i);
    return n;
}

/* v has room for them; all datasets list particles in the same order, level after level. Within the
 * periodic domain: a box that moves carries its particles past the sides. Collective. */
static void write_positions(const struct sph *s, struct h5 *f, int64_t n, double *v)
{
    const struct scene_domain *d = &s->run->scene.domain;
    double *to = v;
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++)
            if (shows(q, i))
                for (int a = 0; a < q->dim; a++)
                    *to++ = scene_image_from(d, a, d->min[a], prim_line(&q->p, i)[a]);
    h5_write_real(f, "position", "m", n, s->dim, v, true);
}

static void write_ids(const struct sph *s, struct h5 *f, int64_t n)
{
    int64_t *ids = NEW(int64_t, n), *to = ids;
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++)
            if (shows(q, i))
                *to++ = q->p.id[i];
    h5_write_int(f, "id", n, ids);
    mem_free(ids);
}

/* Number of components of a field in this run's dimension. */
static int components(const struct sph *s, const struct field *k)
{
    return k->ncomp ? k->ncomp : s->dim == 3 ? 3 : 1;
}

/* As write_positions. */
static void write_field(const struct sph *s, struct h5 *f, const struct field *k, int64_t n,
                        double *v)
{
    const int ncomp = components(s, k);
    double *to = v;
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++)
            if (shows(q, i)) {
                k->get(q, i, to);
                to += ncomp;
            }
    h5_write_real(f, k->name, k->unit, n, ncomp, v, true);
}

/* What a picture needs to know: spacing and corners of the region, level of the pressure outside.
 */
static void write_region(const struct sph *s, struct h5 *f)
{
    h5_attribute_real(f, "dx", s->dx);
    if (s->zones) /* Pa: what it adds to a partner's pressure */
        h5_attribute_real(f, "gauge", s->zones->gauge);
    for (int a = 0; a < s->dim; a++) {
        h5_attribute_real(f, key_text("%cmin", "xyz"[a]), s->lo[a]);
        h5_attribute_real(f, key_text("%cmax", "xyz"[a]), s->hi[a]);
    }
}

/* Slopes are made for it unless the state is broken, when pairs cannot be listed and only what the
 * state holds is shown. */
void sph_snapshot(void *state, struct h5 *f, struct xdmf *x, const char *file)
{
    struct sph *s = state;
    struct xdmf_field shown[FIELDS];
    int nshown = 0;
    for (struct sph *q = s; q && s->lists.broken; q = q->finer)
        particles_lines(q);
    if (!s->lists.broken)
        integrate_gradients(s);
    const int64_t n = shown_here(s);
    double *v = NEW(double, 3 * (size_t)n);
    write_positions(s, f, n, v);
    for (int k = 0; k < FIELDS; k++)
        if (scene_shows(&s->run->scene, fields[k].name) ||
            (s->finer && fields[k].get == get_level)) {
            write_field(s, f, fields + k, n, v);
            shown[nshown++] = (struct xdmf_field){fields[k].name, components(s, fields + k)};
        }
    if (scene_shows(&s->run->scene, "id"))
        write_ids(s, f, n);
    mem_free(v);
    write_region(s, f);
    wall_files_snapshot(s, f, x, file);
    const int64_t all = ranks_count(s->run->comm, n);
    if (x)
        xdmf_points(x, s->t, file, all, s->dim, nshown, shown);
}

/* Members of struct sph that are the same on all ranks and that the next step depends on or that
 * are reported. */
static const struct number {
    const char *name;
    size_t offset;
} numbers[] = {
#define NUMBER(name, member)                                                                       \
    {                                                                                              \
        name, offsetof(struct sph, member)                                                         \
    }
    NUMBER("dt_most", step.dt_most),
    NUMBER("stray", step.stray),
    NUMBER("carried", step.carried),
    NUMBER("drift[0]", step.drift[0]),
    NUMBER("drift[1]", step.drift[1]),
    NUMBER("drift[2]", step.drift[2]),
    NUMBER("max_speed", step.max_speed),
    NUMBER("max_shift", step.max_shift),
    NUMBER("max_c", step.max_c),
    NUMBER("rho_min", step.rho_min),
    NUMBER("rho_max", step.rho_max),
    NUMBER("max_mach", total.max_mach),
    NUMBER("shift_speed", step.shift_speed),
    NUMBER("skin", lists.skin),
    NUMBER("signal", step.signal),
    NUMBER("fluctuation", total.fluctuation),
    NUMBER("fluctuation_particles", total.fluctuation_particles),
    NUMBER("mass0", start.mass),
    NUMBER("energy0", start.energy),
    NUMBER("dt", dt),
    NUMBER("momentum0[0]", start.momentum[0]),
    NUMBER("momentum0[1]", start.momentum[1]),
    NUMBER("momentum0[2]", start.momentum[2]),
    NUMBER("force_time", total.mean_force.time),
    NUMBER("force_sum[0]", total.mean_force.sum[0]),
    NUMBER("force_sum[1]", total.mean_force.sum[1]),
    NUMBER("force_sum[2]", total.mean_force.sum[2]),
    NUMBER("force_sum2", total.mean_force.sum2),
    NUMBER("mach_late", total.mach_late),
    NUMBER("average_t", total.mean_force.average_t),
    NUMBER("average_time", total.mean_force.average_time),
    NUMBER("average_sum[0]", total.mean_force.average_sum[0]),
    NUMBER("average_sum[1]", total.mean_force.average_sum[1]),
    NUMBER("average_sum[2]", total.mean_force.average_sum[2]),
    NUMBER("volume0", start.volume),
};
/* The first of them belong to the flow, one for all levels. */
enum { NUMBERS = sizeof numbers / sizeof numbers[0], NUMBERS_OF_FLOW = 13 };

/* The member itself. */
static double *number(struct sph *s, int k) { return (double *)((char *)s + numbers[k].offset); }

/* A dataset of one level: the first has plain names. Valid as key_text. */
static const char *name(const struct sph *s, const char *plain)
{
    return s->level > 0 ? key_text("%s_%d", plain, s->level) : plain;
}

/* Writes the surface's class of each particle: a coupling step begins with what the last step has
 * found. */
static void save_surface(const struct sph *s, struct h5 *f)
{
    int64_t *is = NEW(int64_t, s->p.n);
    for (int i = 0; i < s->p.n && i < s->surface->capacity; i++)
        is[i] = s->surface->is[i];
    h5_write_int(f, name(s, "surface"), s->p.n, is);
    mem_free(is);
}

/* Reads it back; all inside where the file does not say. */
static void read_surface(struct sph *s, struct h5 *f)
{
    int64_t *is = NEW(int64_t, s->p.n);
    h5_read_int(f, name(s, "surface"), s->p.n, is);
    surface_room(s->surface, s->p.n, s->dim);
    for (int i = 0; i < s->p.n; i++)
        s->surface->is[i] = (unsigned char)is[i];
    mem_free(is);
}

/* The particles of one level; with levels their roles, and slopes, which guards take. Zone and role
 * share an integer. Slopes are those before an output was made, if one was. */
static void save_particles(const struct sph *s, struct h5 *f)
{
    int64_t *kind = NEW(int64_t, s->p.n);
    for (int i = 0; i < s->p.n; i++)
        kind[i] = s->p.zone[i] + 256 * s->p.role[i];
    h5_write_real(f, name(s, "state"), "x, m u, w, m", s->p.n, s->p.nstate, s->p.y, false);
    h5_write_int(f, name(s, "id"), s->p.n, s->p.id);
    h5_write_int(f, name(s, "zone"), s->p.n, kind);
    h5_write_int(f, name(s, "next_id"), 1, &s->p.next_id);
    h5_write_real(f, name(s, "false_divergence"), "1/s", s->p.n, 1, s->p.false_divergence, false);
    mem_free(kind);
    if (s->guards)
        h5_write_real(f, name(s, "slope"), "-", s->p.n, s->p.nslope,
                      s->guards->nprior == s->p.n ? s->guards->prior : s->p.slope, false);
    if (s->p.size)
        h5_write_real(f, "sizes", "R, weight", s->p.n, 2, s->p.size[0], false);
    if (s->surface)
        save_surface(s, f);
}

/* What each level has of its own beside its particles. The first three are sums of this rank, hence
 * a dataset, not attributes. */
static void save_levels(struct sph *s, struct h5 *f)
{
    const struct refinement *r = s->refinement;
    h5_write_real(f, "levels_mass", "kg", 3, 1, (double[3]){r->added, s->step.mass, r->gone},
                  false);
    h5_attribute_real(f, "levels_mass0", r->mass0);
    h5_attribute_real(f, "levels_debt", r->mass_surplus);
    for (struct sph *q = s->finer; q; q = q->finer) {
        h5_attribute_real(f, name(q, "skin"), q->lists.skin);
        h5_attribute_real(f, name(q, "signal"), q->step.signal);
    }
    (void)regions_restart(s->refinement->regions, f);
}

/* Called at the end of a step on all ranks; it leaves no trace in the run. */
void sph_checkpoint(void *state, struct h5 *f)
{
    struct sph *s = state;
    for (const struct sph *q = s; q; q = q->finer)
        save_particles(q, f);
    h5_write_real(f, "lost", "-", 1, 1, &s->total.lost, false);
    double fallen[6] = {0.0};
    for (const struct sph *q = s; q; q = q->finer)
        for (int side = 0; side < 6; side++)
            fallen[side] += q->total.fallen[side];
    h5_write_real(f, "fallen", "kg", 6, 1, fallen, false);
    double back = 0.0;
    for (const struct sph *q = s; q && q->walls; q = q->finer)
        back += (double)q->walls->returned;
    h5_write_real(f, "put_back", "-", 1, 1, &back, false);
    if (s->refinement)
        save_levels(s, f);
    fit_restart(s, &s->total.signal_fit, f);
    for (int k = 0; k < NUMBERS; k++)
        (void)h5_keep(f, numbers[k].name, number(s, k));
    write_region(s, f);
    restart_eos(s, f);
    wall_files_save(s, f);
    sph_watch_save(s, f);
    domain_save(s, f);
    if (s->zones)
        (void)zones_restart(s, f);
    if (s->zones && s->zones->watched)
        overlap_restart(s->zones->watched, f);
    if (s->wave_zones)
        wave_zones_restart(s->wave_zones, f);
    if (s->walls)
        forces_save(s, f);
    shut_waters_save(s, f);
    if (s->walls && s->walls->any_free)
        (void)bodies_restart(s, f);
    (void)paddles_restart(s, f);
    (void)body_courses_restart(s, f);
}

/* Each rank reads its share of the file; domain_load sends particles to their owners afterwards.
 * false: lengths do not fit. */
static bool read_particles(struct sph *s, struct h5 *f)
{
    const int64_t n = h5_share(f, name(s, "state"));
    if (n < 0)
        return false;
    int64_t *kind = NEW(int64_t, n);
    particles_reserve(&s->p, (int)n);
    const bool fits = h5_read_real(f, name(s, "state"), n, s->p.nstate, s->p.y) &&
                      h5_read_int(f, name(s, "id"), n, s->p.id) &&
                      h5_read_int(f, name(s, "zone"), n, kind) &&
                      h5_read_real(f, name(s, "false_divergence"), n, 1, s->p.false_divergence) &&
                      (!s->guards || h5_read_real(f, name(s, "slope"), n, s->p.nslope, s->p.slope));
    for (int64_t i = 0; fits && i < n; i++) {
        s->p.zone[i] = (unsigned char)(kind[i] % 256);
        s->p.role[i] = (unsigned short)(kind[i] / 256);
    }
    s->p.n = fits ? (int)n : 0;
    mem_free(kind);
    if (!fits || !s->refinement || apr_params_of(s->run)->method == APR_GUARDS)
        return fits;
    return mixed_restart(s, f);
}

/* The next id of this rank: its own, or on another number of ranks above all of theirs. */
static bool read_next_id(struct sph *s, struct h5 *f)
{
    const int64_t size = s->run->size, rank = s->run->rank;
    int64_t n, most = 0;
    int64_t *all = h5_read_all_int(f, name(s, "next_id"), &n);
    for (int64_t k = 0; all && k < n; k++)
        most = all[k] > most ? all[k] : most;
    s->p.next_id = all && n == size ? all[rank] : (most + size) / size * size + rank;
    mem_free(all);
    return all != NULL;
}

/* Parts of sums (lost, fallen, put back) go to the first rank where the number of ranks has
 * changed. */
static bool read_numbers(struct sph *s, struct h5 *f)
{
    if (!read_next_id(s, f) || !h5_read_parts(f, "lost", 1, &s->total.lost) ||
        !h5_read_parts(f, "fallen", 6, s->total.fallen))
        return false;
    double back;
    if (s->walls && h5_read_parts(f, "put_back", 1, &back))
        s->walls->returned = (int64_t)back;
    for (int k = 0; k < NUMBERS; k++)
        if (!h5_keep(f, numbers[k].name, number(s, k)))
            return false;
    sph_params_dt(&s->prm, s->nu, s->step.signal, &s->step.limited_by);
    return true;
}

/* What the file is of: spacing and region. Says what differs. A file of another dx, dimension or
 * region is refused, with the figure that differs. */
static bool same_region(const struct sph *s, struct h5 *f)
{
    const struct corner {
        const char *name;
        double now;
    } wanted[] = {{"dx", s->dx},      {"xmin", s->lo[0]}, {"xmax", s->hi[0]}, {"ymin", s->lo[1]},
                  {"ymax", s->hi[1]}, {"zmin", s->lo[2]}, {"zmax", s->hi[2]}};
    double any;
    const bool solid = h5_read_attribute_real(f, "zmin", &any);
    if (h5_read_attribute_real(f, "dx", &any) && solid != (s->dim == 3)) {
        log_say("the restart file is of %d dimensions, the case of %d", solid ? 3 : 2, s->dim);
        return false;
    }
    for (int k = 0; k < 1 + 2 * s->dim; k++) {
        double then;
        const bool moved = k > 0 && box_motion_wanted(&s->prm); /* its way is in the file, too */
        if (!moved && h5_read_attribute_real(f, wanted[k].name, &then) && then != wanted[k].now) {
            log_say("the restart file is of another case: %s = %.10g m, here %.10g m",
                    wanted[k].name, then, wanted[k].now);
            return false;
        }
    }
    return true;
}

/* What finer levels have of their own; all else they have of the first. NUMBERS_OF_FLOW of the
 * flow's numbers are copied from the coarsest level. */
static bool read_levels(struct sph *s, struct h5 *f)
{
    struct refinement *r = s->refinement;
    double parts[3] = {0.0, 0.0, 0.0};
    bool fits = h5_read_parts(f, "levels_mass", 3, parts) &&
                h5_read_attribute_real(f, "levels_mass0", &r->mass0) &&
                h5_read_attribute_real(f, "levels_debt", &r->mass_surplus);
    r->added = parts[0];
    s->step.mass = parts[1];
    r->gone = parts[2];
    for (struct sph *q = s->finer; q && fits; q = q->finer) {
        for (int k = 0; k < NUMBERS_OF_FLOW; k++)
            *number(q, k) = *number(s, k);
        fits = read_next_id(q, f) && h5_read_attribute_real(f, name(q, "skin"), &q->lists.skin) &&
               h5_read_attribute_real(f, name(q, "signal"), &q->step.signal);
    }
    return fits && regions_restart(s->refinement->regions, f);
}

/* What the file lacks, NULL: nothing. Particles first, since everything else refers to them. The
 * partition comes before zones and bodies, which ask who owns a position. */
static const char *missing(struct sph *s, struct h5 *f)
{
    bool particles = true;
    for (struct sph *q = s; q; q = q->finer)
        particles = particles && read_particles(q, f);
    if (!particles)
        return "particles";
    if (!read_numbers(s, f))
        return "numbers of the run";
    if (s->refinement && !read_levels(s, f))
        return "levels of refinement";
    if (!sph_watch_load(s, f))
        return "watches";
    if (!domain_load(s, f))
        return "partition";
    if (s->zones && !zones_restart(s, f))
        return "open sides";
    if (s->wave_zones)
        wave_zones_restart(s->wave_zones, f);
    if (s->walls && !forces_load(s, f))
        return "forces on walls";
    if (!shut_waters_load(s, f))
        return "waters that walls shut in";
    if (s->walls && !bodies_restart(s, f))
        return "free bodies";
    if (!paddles_restart(s, f) || !body_courses_restart(s, f))
        return "paddles";
    return NULL;
}

/* Lists are made anew; all else continues bit for bit on the same number of ranks. */
bool sph_restore(struct sph *s, struct h5 *f)
{
    if (!same_region(s, f) || !wall_files_fit(s, f))
        return false;
    const char *lacks = missing(s, f);
    if (lacks && h5_ranks(f) == 0)
        log_say("the restart file is of another number of ranks, or has no %s that fit this case: "
                "files of this version are read by the number of ranks that wrote them",
                lacks);
    else if (lacks)
        log_say("the restart file has no %s that fit this case", lacks);
    else
        restart_eos(s, f);
    for (struct sph *q = s; q; q = q->finer) {
        if (q->surface)
            read_surface(q, f);
        if (q->walls) /* the first list reaches as far as it would have */
            walls_expect_speed(q);
        q->lists.ready = false;
    }
    fit_restart(s, &s->total.signal_fit, f);
    return !lacks;
}
