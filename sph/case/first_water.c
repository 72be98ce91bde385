/* first_water.c - see first_water.h. SPDX-License-Identifier: BSD-3-Clause */
#include "first_water.h"

#include "../../common/run/run.h"
#include "../../common/scene/scene.h"
#include "sph_sense.h"

static const double least_parted = 0.02; /* of the water that shapes draw, behind partitions */

/* Whether no line or body is above x; so it is under a beach, and not behind a partition. */
static bool is_open_above(const struct scene *c, const double *x)
{
    double g[3], up[3], room = 0.0;
    const double size = scene_still_gravity(c, g);
    for (int a = 0; a < c->domain.dim; a++)
        room += c->domain.max[a] - c->domain.min[a];
    for (int a = 0; a < 3; a++)
        up[a] = size > 0.0 ? -room * g[a] / size : 0.0;
    return size > 0.0 && !sph_falls_stopped(c, x, up);
}

/* By m[a] samples along each axis. */
static struct first_water sample(const struct run *r, const struct sph_params *used, const int *m)
{
    const struct scene *c = &r->scene;
    const int dim = c->domain.dim, samples = m[0] * m[1] * m[2];
    const double one = 1.0 / samples;
    const bool lines = scene_has_open_lines(c);
    const struct exact e = exact_create(c);
    struct first_water is = {0.0, 0.0, 0.0};
    for (int k = 0; k < samples; k++) {
        const int at[3] = {k % m[0], k / m[0] % m[1], k / m[0] / m[1]};
        double x[3] = {0.0, 0.0, 0.0};
        for (int a = 0; a < dim; a++)
            x[a] = used->box[0][a] + (at[a] + 0.5) / m[a] * (used->box[1][a] - used->box[0][a]);
        if (scene_matter(c, &e, x) != MATTER_FLUID || !scene_is_room(c, x))
            continue;
        const bool behind = lines && scene_is_behind_lines(c, x);
        is.kept += behind ? 0.0 : one;
        is.behind += behind ? one : 0.0;
        is.open += behind && is_open_above(c, x) ? one : 0.0;
    }
    return is;
}

/* Where a few thousand find less than a particle, each place of one is asked: there may be a drop.
 */
struct first_water first_water_look(const struct run *r, const struct sph_params *used)
{
    const int dim = r->scene.domain.dim, few = dim == 2 ? 96 : 24;
    const struct first_water is = sample(r, used, (const int[]){few, few, dim == 2 ? 1 : few});
    int m[3] = {1, 1, 1};
    double all = 1.0;
    for (int a = 0; a < dim; a++) {
        m[a] = (int)fmin(ceil((used->box[1][a] - used->box[0][a]) / used->dx - 1e-6), 1e6);
        all *= m[a];
    }
    return is.kept * all >= 1.0 || all > 1e7 ? is : sample(r, used, m);
}

/* Sides that hold water; without any the lines are all there is of a tank. */
static bool has_wall_sides(const struct scene *c)
{
    bool any = false;
    for (int k = 0; k < c->nwalls; k++)
        any = any || (c->walls[k].side != SIDE_NONE && c->walls[k].kind < WALL_INFLOW);
    return any;
}

/* More water left out than kept: of the lines one runs the wrong way, or the shapes are wrong. A
 * line that is all there is of a tank may leave out what a level draws beyond it. */
void first_water_warn(const struct run *r, const struct sph_params *used, struct first_water is)
{
    const struct scene *c = &r->scene;
    if (!scene_has_open_lines(c) || !has_wall_sides(c))
        return;
    const double drawn = is.behind + is.kept;
    double size = 1.0; /* m^2 */
    for (int a = 0; a < c->domain.dim; a++)
        size *= used->box[1][a] - used->box[0][a];
    if (is.behind <= is.kept && is.open > least_parted * drawn)
        log_warn("lines among the walls leave out %.2g %% of the water that the shapes draw, with "
                 "air above, %.3g of %.3g m^%d, which lies behind them: a line has fluid on its "
                 "left alone. If water is meant there, too, draw the partition as a body; if not, "
                 "draw the shapes before the lines alone",
                 100.0 * is.open / drawn, is.open * size, drawn * size, c->domain.dim);
    if (is.behind > is.kept)
        log_warn(
            "lines among the walls leave out %.2g %% of the water that the shapes draw, "
            "%.3g of %.3g m^%d, which lies behind them: a line has its fluid on its left; "
            "reverse the points of one that has not, or draw the shapes before the lines alone",
            100.0 * is.behind / drawn, is.behind * size, drawn * size, c->domain.dim);
}
