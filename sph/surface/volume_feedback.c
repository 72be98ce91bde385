/* volume_feedback.c - see volume_feedback.h. Volumes follow div u, and disorder opens between
 * particles what the shift closes again: div u > 0 on the scale of a spacing, balanced by a slow
 * sinking of the whole, of which volumes, and so pressures, know nothing. A tank of 1 m, R = 2.5 dx
 * in 3D, sank by a tenth in 20 s, and 27 % of the pressure at three quarters of its depth were lost
 * (8 % with R = 4 dx); with this 0.6 % (2 %). Volumes go to what makes sum w W that of a lattice
 * beside the same walls, as a Shepard density does at once, within 150 R/c0: long against sound and
 * short against the sinking. Particles that the surface sees have no sum to go by.
 * Water at rest and gentle waves deviate by less than 1 %. Violent flow leaves voids of 10 to 20 %,
 * where water lands on water or slowly on a wall (fast: wall_air_gap), which hangs under up to 1.6
 * times its weight until they are filled. What is beyond 1 % so goes within 25 R/c0 besides.
 * Beside edges of levels sums count guards, which have others' volumes: what flows within R of one
 * keeps to div u, and with levels so does what is nearly at rest, for it is hardly shifted there. A
 * block that goes through water at 0.25 m/s lost 10 % of its lift with levels, 18 % after it had
 * gone over an edge; now 2 %. If all followed all the time: 4 to 9 % too much after the edge, and a
 * tank of 20 x 10 particles, half refined, at 2e-3 c0 after 3e4 steps. At rest is what rests in a
 * stream that carries all alike, too.
 * ALE does not sink, so it has the faster law alone: water that held on below the crest of a dyke
 * while the level fell took volume, up to 1.6 dx^2, and mass from its neighbours. At the foot of
 * the dyke these filled 1.15 times their room, a third of the pressure was missing, and the run
 * ended. Of other schemes not with zones, and of none what zones have: sums there are made up of
 * others' particles. Nor without shift: a lattice cut by an inclined wall stays uneven, 0.7e-3 c0
 * instead of 0.2e-3. SPDX-License-Identifier: BSD-3-Clause */
#include "volume_feedback.h"

#include "../pairs/sph_pairs.h"
#include "../walls/sph_walls.h"

static const double slow = 150.0;     /* R/c0 */
static const double voids = 25.0;     /* R/c0: of what no calm water has */
static const double calm = 0.01;      /* largest deviation in calm water */
static const double most = 0.1;       /* of the deviation that counts */
static const double least_room = 0.2; /* of the support: in narrower places sums say nothing */
static const double rest = 1e-3;      /* of c0: the speed below which levels are taken for calm */

static bool is_ale(const struct sph *s) { return s->prm.scheme == SCHEME_RIEMANN_ALE; }

/* Whether this run corrects its volumes at all; see the head of this file for what is left out. */
static bool wanted(const struct sph *s)
{
    return s->prm.transport == TRANSPORT_TVS && vec3_length(s->gravity) > 0.0 && !s->packing &&
           (is_ale(s) || !s->zones) && !s->mixed;
}

/* Before the first pass, which leaves its sums of w W in `less'. */
void volume_feedback_prepare(struct sph *s)
{
    struct free_surface *f = s->surface;
    f->follows = wanted(s);
    if (f->follows && s->p.n > f->less_capacity) {
        mem_free(f->less);
        f->less_capacity = s->p.n + s->p.n / 8 + 64;
        f->less = NEW_IN(f, double, f->less_capacity);
    }
}

/* 1/s: growth of a volume that lacks the share `less' of its room. less is within +-0.1 (`most');
 * beyond +-calm the faster law is added. */
static double rate_of(const struct sph *s, double less)
{
    const double beyond = less > calm ? less - calm : less < -calm ? less + calm : 0.0;
    return ((is_ale(s) ? 0.0 : less / slow) + beyond / voids) * s->c0 / s->R;
}

/* less = 1 - sum w W/(room x sum of a lattice): positive where the particle has more room than its
 * volume says. room is the share of the support that is not behind walls. */
void volume_feedback_find(struct sph *s)
{
    struct free_surface *f = s->surface;
    if (!f->follows)
        return;
    const double lattice = kernel_lattice_sum(s);
    double *room = walls_rooms(s);
    for (int i = 0; i < s->p.n; i++) {
        const bool counts = f->is[i] == SURFACE_INNER && room[i] > least_room &&
                            (!s->zones || s->p.zone[i] == ZONE_FREE);
        const double less = counts ? 1.0 - f->less[i] / (room[i] * lattice) : 0.0;
        f->less[i] = fmax(-most, fmin(less, most));
    }
    mem_free(room);
}

/* How much of the law holds for particle i, 0 to 1; see the head of this file. */
static double share_of(const struct sph *s, int i)
{
    if (!s->coarser && !s->finer)
        return 1.0;
    const double u2 = transport_speed2(s, prim_line(&s->p, i) + s->dim);
    return s->p.role[i] & (ROLE_GUARD | ROLE_EDGE) ? 0.0 : fmin(1.0, u2 / pow(rest * s->c0, 2.0));
}

void volume_feedback_add(struct sph *s)
{
    const struct free_surface *f = s->surface;
    const int V = at_volume(s->dim);
    for (int i = 0; i < s->p.n && f->follows; i++)
        state_row(&s->p, s->p.rate, i)[V] +=
            share_of(s, i) * rate_of(s, f->less[i]) * state_row(&s->p, s->p.y, i)[V];
}

/* Guards, too, for what flows beside them counts on their volumes. */
static void fill_level(struct sph *s)
{
    const bool *beside = s->walls->beside;
    for (int i = 0; i < s->p.n && beside; i++) {
        double *y = state_row(&s->p, s->p.y, i);
        for (int k = s->dim; k < s->p.nstate && beside[i]; k++)
            y[k] *= 1.0 + s->surface->less[i]; /* momentum, volume, mass */
    }
    s->lists.ready = false;
}

bool volume_feedback_fill(struct sph *s)
{
    if (!s->surface || !s->surface->follows || !s->walls || is_ale(s))
        return false;
    for (struct sph *q = s; q; q = q->finer)
        fill_level(q);
    return true;
}
