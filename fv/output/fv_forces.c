/* fv_forces.c - forces of the flow on walls and bodies, in the series and in the summary.
 * SPDX-License-Identifier: BSD-3-Clause */

#include "../boundary/fv_boundary.h"
#include "../operators/fv_operators.h"
#include "output.h"

/* Whether there are such columns. */
static bool has_forces(const struct run *r, const struct fv_params *prm)
{
    return r->scene.nwalls > 0 || flow_bodies(prm) > 0;
}

static const char *body_name(const struct fv_params *prm, int k)
{
    return prm->blocks.n > 0 ? prm->blocks.of[k].name : prm->boxes[k].name;
}

/* Whether those on a body have columns of their own: on a box that is cut out; on a block's own
 * where other sides are closed, too, so that the sum is not this body's. Otherwise they would
 * repeat the sum. */
static bool has_own_forces(const struct run *r, const struct fv_params *prm, int k)
{
    int n = 0;
    if (prm->blocks.n == 0)
        return true;
    for (int w = 0; w < r->scene.nwalls; w++)
        n += r->scene.walls[w].kind == WALL_NO_SLIP || r->scene.walls[w].kind == WALL_SLIP;
    for (int b = 0; b < prm->blocks.n; b++)
        n += mesh_block_has(prm->blocks.of + b, MESH_WALL) ||
             mesh_block_has(prm->blocks.of + b, MESH_SLIP);
    return n > 1 && mesh_block_is_body(r, prm->blocks.of + k);
}

/* The columns of a force and, on blocks, its moment; of: "" or the name of a body and a blank. */
static void add_force(const struct fv *s, const char *of, const double force[4], struct figures *to)
{
    static const char *const names[2][4] = {
        {"force x [N/m]", "force y [N/m]", "", "moment z [N]"},
        {"force x [N]", "force y [N]", "force z [N]", "moment z [N m]"}};
    for (int a = 0; a < 4; a++)
        if (a == 3 ? s->prm.blocks.n > 0 : a < s->dim)
            FIGURE(to, force[a], "%s%s", of, names[s->dim - 2][a]);
}

/* For summarise_oscillation. */
static void keep_forces(struct fv *s, double (*of)[4])
{
    struct fv_output *o = s->output;
    ROOM_IN(o, o->history, o->nhistory + 1);
    double *row = o->history[o->nhistory++];
    row[0] = s->t;
    row[1] = row[2] = 0.0;
    for (int k = 0; k < flow_bodies(&s->prm); k++)
        for (int a = 0; a < 2; a++)
            row[1 + a] += of[k][a];
}

/* All walls and bodies together first, then each body; moments on blocks alone. */
void fv_forces_row(struct fv *s, struct figures *to)
{
    double all[4] = {0.0}, of[FLOW_BODIES_MAX][4] = {{0.0}};
    if (!has_forces(s->run, &s->prm))
        return;
    if (to->measures)
        flow_forces(s, of, all);
    add_force(s, "", all, to);
    for (int k = 0; k < flow_bodies(&s->prm); k++)
        if (has_own_forces(s->run, &s->prm, k))
            add_force(s, key_text("%s ", body_name(&s->prm, k)), of[k], to);
    if (to->measures && s->prm.blocks.n > 0)
        keep_forces(s, of);
}

/* Mean and half range of the forces on the bodies of blocks over the second half of the run, by the
 * trapezoidal rule; frequency of the one along y by upward crossings of its mean. Fewer than eight
 * rows give nothing. */
static void summarise_oscillation(const struct fv *s)
{
    struct summary *to = s->run->summary;
    const struct fv_output *o = s->output;
    double mean[2] = {0.0, 0.0}, least[2] = {INFINITY, INFINITY}, most[2] = {-INFINITY, -INFINITY};
    double first = 0.0, last = 0.0, weight = 0.0;
    int from = 1, crossings = 0;
    while (from < o->nhistory && o->history[from][0] < 0.5 * s->run->scene.time.end)
        from++;
    if (o->nhistory - from < 8)
        return;
    for (int k = from; k < o->nhistory; k++) {
        const double *a = o->history[k - 1], *b = o->history[k];
        weight += b[0] - a[0];
        for (int q = 0; q < 2; q++) {
            mean[q] += 0.5 * (a[1 + q] + b[1 + q]) * (b[0] - a[0]);
            least[q] = fmin(least[q], b[1 + q]);
            most[q] = fmax(most[q], b[1 + q]);
        }
    }
    for (int q = 0; q < 2; q++)
        mean[q] /= weight;
    bool low = false; /* a crossing counts after the lower half of the range has been reached */
    for (int k = from; k < o->nhistory; k++) {
        const double *a = o->history[k - 1], *b = o->history[k];
        low = low || b[2] < mean[1] - 0.25 * (most[1] - least[1]);
        if (!low || b[2] < mean[1])
            continue;
        low = false;
        last = a[0] + (b[0] - a[0]) * (mean[1] - a[2]) / (b[2] - a[2]);
        first = crossings++ == 0 ? last : first;
    }
    const double frequency = crossings > 1 ? (crossings - 1) / (last - first) : 0.0;
    const double found[3] = {mean[0], 0.5 * (most[1] - least[1]), frequency};
    static const char *const names[3] = {"error.force_x", "error.force_y", "error.frequency"};
    summary_real(to, "force.x_mean", mean[0]);
    summary_real(to, "force.x_amplitude", 0.5 * (most[0] - least[0]));
    summary_real(to, "force.y_mean", mean[1]);
    summary_real(to, "force.y_amplitude", found[1]);
    summary_real(to, "force.frequency", frequency);
    for (int q = 0; q < 3; q++)
        if (s->prm.force[q] != 0.0)
            summary_real(to, names[q], fabs(found[q] / s->prm.force[q] - 1.0));
}

/* of "": of all together, "force.x". */
static void summarise_force(const struct fv *s, const char *of, const double force[4])
{
    static const char *const names[] = {"x", "y", "z", "moment"};
    const int dim = s->dim, moment = s->prm.blocks.n > 0;
    for (int a = 0; a < dim + moment; a++) {
        summary_real(s->run->summary,
                     key_text("force.%s%s%s", of, *of ? "." : "", names[a < dim ? a : 3]),
                     force[a < dim ? a : 3]);
    }
}

/* Those at the end of the run. */
void fv_summarise_forces(struct fv *s)
{
    double all[4], of[FLOW_BODIES_MAX][4];
    if (s->m ? !mesh_bc_has_walls(s->m) : !has_forces(s->run, &s->prm))
        return;
    flow_forces(s, of, all);
    summarise_force(s, "", all);
    for (int k = 0; k < flow_bodies(&s->prm); k++)
        if (has_own_forces(s->run, &s->prm, k))
            summarise_force(s, body_name(&s->prm, k), of[k]);
    summarise_oscillation(s);
}
