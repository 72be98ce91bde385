/* restart_eos.c - see restart_eos.h. SPDX-License-Identifier: BSD-3-Clause */
#include "restart_eos.h"

#include "../../common/files/files.h"
#include "../../common/scene/scene.h"
#include "../particles/sph_particles.h"
#include "../refinement/sph_refinement.h"

/* What pressures go with: the equation of state, and the weight. */
struct eos {
    double rho0, c0, gamma; /* kg/m^3, m/s, - */
    double gravity;         /* m/s^2 */
};

static double gravity_of(const struct sph *s) { return vec3_length(s->run->scene.fluid.gravity); }

/* Masses of one level; sums[0] and [1]: before and after, kg, this rank. */
static void restate(struct sph *s, const struct eos *then, double sums[2])
{
    const int dim = s->dim;
    const double now = gravity_of(s);
    const double weight =
        s->rho0 / then->rho0 * (now > 0.0 && then->gravity > 0.0 ? now / then->gravity : 1.0);
    for (int i = 0; i < s->p.n; i++) {
        double *y = state_row(&s->p, s->p.y, i);
        const double rho = y[at_mass(dim)] / y[at_volume(dim)];
        const double p = weight * eos_p(rho, then->rho0, then->c0, then->gamma);
        const double factor = eos_rho(p, s->rho0, s->c0, s->gamma) / rho;
        sums[0] += y[at_mass(dim)];
        y[at_mass(dim)] *= factor;
        sums[1] += y[at_mass(dim)];
        for (int a = 0; a < dim; a++)
            y[dim + a] *= factor;
    }
    s->step.signal += fmax(s->c0 - then->c0, 0.0);
    s->step.mass *= sums[1] / fmax(sums[0], 1e-300);
}

/* What the run compares its masses with: those of the start, by the factor of the whole. */
static void scale_start(struct sph *s, double factor)
{
    s->start.mass *= factor;
    s->start.energy *= factor;
    for (int a = 0; a < 3; a++)
        s->start.momentum[a] *= factor;
    if (s->refinement) {
        s->refinement->mass0 *= factor;
        s->refinement->added *= factor;
        s->refinement->gone *= factor;
    }
    s->watch.budget.n = 0; /* energies of the last steps are those of other masses */
}

void restart_eos(struct sph *s, struct h5 *f)
{
    const struct eos now = {s->rho0, s->c0, s->gamma, gravity_of(s)};
    struct eos then = now;
    if (!h5_keep(f, "rho0", &then.rho0) || !h5_keep(f, "c0", &then.c0) ||
        !h5_keep(f, "gamma", &then.gamma) || !h5_keep(f, "gravity", &then.gravity))
        return;
    if (then.rho0 == now.rho0 && then.c0 == now.c0 && then.gamma == now.gamma &&
        then.gravity == now.gravity)
        return; /* and so it is where the file is written */
    double all[2] = {0.0, 0.0};
    for (struct sph *q = s; q; q = q->finer) {
        double sums[2] = {0.0, 0.0};
        restate(q, &then, sums);
        all[0] += sums[0];
        all[1] += sums[1];
    }
    const double before = ranks_sum(s->run->comm, all[0]), after = ranks_sum(s->run->comm, all[1]);
    scale_start(s, after / before);
    log_say(
        "  the restart file has c0 %.4g m/s, %.5g kg/m^3 and %.4g m/s^2, this run %.4g, %.5g and "
        "%.4g: pressures are kept%s, masses change by %.2g %%",
        then.c0, then.rho0, then.gravity, s->c0, s->rho0, gravity_of(s),
        then.rho0 == s->rho0 && then.gravity == gravity_of(s) ? "" : " as a part of the weight",
        100.0 * (after / before - 1.0));
}
