/* sph_state.c - struct sph from the case's parameters, at t = 0 or from a restart file. sph_create
 * makes the levels from the coarsest on; at t = 0 then the first lattice, a first look at the
 * criteria of refinement, the finer levels' particles and the volumes. All ranks.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sph_state.h"

#include "../../common/scene/scene.h"
#include "../bodies/sph_bodies.h"
#include "../open_boundaries/sph_open_boundaries.h"
#include "../output/sph_output.h"
#include "../pairs/sph_pairs.h"
#include "../parallel/domain.h"
#include "../particles/sph_particles.h"
#include "../refinement/sph_refinement.h"
#include "../surface/sph_surface.h"
#include "../time/sph_time.h"
#include "../walls/sph_walls.h"
#include "fill.h"

/* Half a period must hold R and the skin, see check_axis in sph_params.c. */
static double widest_skin(const struct sph *s)
{
    double most = 0.25 * s->R;
    for (int a = 0; a < s->dim; a++)
        if (s->periodic[a])
            most = fmin(most, 0.499 * (s->hi[a] - s->lo[a]) - s->R);
    return most;
}

/* After the parameters, before anything that asks for gravity: where a reference pressure has the
 * weight, the particles have none. */
static void set_constants(struct sph *s)
{
    const struct scene *c = &s->run->scene;
    s->dim = c->domain.dim;
    s->dx = s->prm.dx;
    s->R = s->prm.R_dx * s->prm.dx;
    s->dxD = s->dim == 2 ? s->dx * s->dx : s->dx * s->dx * s->dx;
    s->rho0 = c->fluid.rho;
    s->nu = c->fluid.nu;
    s->c0 = s->prm.c0;
    s->gamma = s->prm.gamma;
    s->central = c->fluid.central;
    s->wave_zones = mem_own(s, wave_zones_create(c, wave_stream_wanted(s->run, &s->prm)));
    memcpy(s->gravity, c->fluid.gravity, sizeof s->gravity);
    if (s->prm.surface != SURFACE_YES)
        s->reference = scene_reference(c);
    for (int a = 0; a < 3; a++)
        s->gravity[a] = s->reference.slope[a] != 0.0 ? 0.0 : s->gravity[a];
    sph_params_open(s->run, &s->prm, s->open);
    sph_params_region(&c->domain, &s->prm, s->lo, s->hi, s->periodic);
    s->lists.skin_most = widest_skin(s);
}

/* What drifts in summary.json are measured from. */
static void remember_start(struct sph *s)
{
    double sums[SUM_COUNT];
    sph_sums(s, sums);
    s->start.mass = sums[SUM_MASS];
    volume_remember(s, sums[SUM_VOLUME]);
    shut_waters_remember(s);
    s->start.energy = sums[SUM_ENERGY];
    memcpy(s->start.momentum, sums + SUM_MOMENTUM, sizeof s->start.momentum);
}

/* Laid out once: as far as the box may come. */
static void create_walls(struct sph *s)
{
    double now[2][3];
    memcpy(now[0], s->lo, sizeof now[0]);
    memcpy(now[1], s->hi, sizeof now[1]);
    box_motion_range(s, s->lo, s->hi);
    s->walls = mem_own(s, walls_create(s));
    memcpy(s->lo, now[0], sizeof now[0]);
    memcpy(s->hi, now[1], sizeof now[1]);
}

/* Without particles; coarser: the level above, NULL: the first. */
static struct sph *create_level(struct run *r, const struct sph_params *prm, struct sph *coarser)
{
    struct sph *s = NEW(struct sph, 1);
    s->run = r;
    s->prm = *prm;
    s->t = r->t;
    s->coarser = coarser;
    if (coarser) {
        coarser->finer = mem_own(coarser, s);
        s->level = coarser->level + 1;
        s->prm.dx = 0.5 * coarser->dx;
    }
    set_constants(s);
    particles_create(s, &s->p, s->dim, 0);
    s->p.next_id = ((int64_t)s->level << 56) + r->rank;
    s->list = mem_own(s, neighbours_create());
    s->list->touching = collisions_distance(s);
    s->zones = coarser ? NULL : mem_own(s, zones_create(s)); /* open sides are of the first level */
    domain_create(s);
    create_walls(s);
    if (s->zones)
        openings_find_room(s, s->zones->openings);
    bodies_create(s);
    s->surface = mem_own(s, sph_surface_create(s));
    s->passes = scheme_pick(s);
    s->scheme = &s->passes;
    s->stages = stages_of(prm->integrator, prm->scheme);
    sph_watch_create(s);
    return s;
}

/* The finer levels of a case that refines. Levels from the coarsest on; unshifted_finest is of the
 * last alone. */
static void create_finer(struct sph *s)
{
    struct regions *g = regions_create(s->run, &s->prm);
    if (!g)
        return;
    const bool local = apr_params_of(s->run)->local_steps;
    s->refinement = NEW_IN(s, struct refinement, 1);
    s->refinement->regions = mem_own(s->refinement, g);
    if (apr_params_of(s->run)->method != APR_GUARDS)
        return;
    s->refinement->local_steps = s->local_steps = local;
    s->guards = mem_own(s, guards_create(s->run));
    s->places = &refinement_places;
    for (struct sph *q = s; q->level < regions_levels(g);) {
        struct sph_params prm = s->prm;
        if (apr_params_of(s->run)->unshifted_finest && q->level + 1 == regions_levels(g))
            prm.transport = TRANSPORT_NONE;
        q = create_level(s->run, &prm, q);
        q->guards = mem_own(q, guards_create(s->run));
        q->local_steps = local;
        q->places = &refinement_places;
    }
}

/* Whether there is nobody, and nobody can come in. */
static bool is_dry(const struct sph *s)
{
    return ranks_count(s->run->comm, s->p.n) == 0 && !s->zones;
}

/* Four times: volumes beside each other depend on each other. */
static void fill_volumes(struct sph *s)
{
    for (int k = 0; k < 4; k++) {
        if (k > 0)
            integrate_gradients(s);
        if (!volume_feedback_fill(s))
            return;
    }
}

/* The first look at criteria comes before finer levels are filled, for it says where. */
struct sph *sph_create(struct run *r, const struct sph_params *prm, struct h5 *f)
{
    struct sph *s = create_level(r, prm, NULL);
    create_finer(s);
    if (f) {
        if (!sph_restore(s, f))
            DROP(s);
        return s;
    }
    struct fill *fill = NULL;
    if (s->refinement && apr_params_of(r)->method == APR_GRADED)
        graded_fill(s);
    else
        fill = fill_lattice(s);
    if (is_dry(s)) {
        log_say("%s: walls and bodies leave no place for a particle: no water, nothing to compute; "
                "nothing was started",
                r->case_name);
        FREE(fill, s);
        return NULL;
    }
    if (s->finer && criteria_due(s->refinement->regions, s->t)) { /* of the coarsest level alone */
        integrate_start(s);
        refinement_look(s);
    }
    if (s->refinement)
        fill_finer(s, fill);
    integrate_start(s);
    fill_volumes(s);
    fill_check(s, fill);
    FREE(fill);
    remember_start(s);
    return s;
}
