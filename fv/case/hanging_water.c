/* hanging_water.c - water of the start that nothing but a side would hold up.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../../common/scene/scene.h"
#include "../fv.h"
#include "../grid/fv_grid.h"
#include "fv_case.h"

/* Whether the water of a column of the start touches the upper end: 0: no, 1: with air below it,
 * 2: it fills the column. */
static int top_of_column(const struct scene *s, const struct exact *e, int up, double *x)
{
    enum { PLACES = 200 };
    const double low = s->domain.min[up], size = s->domain.max[up] - low;
    const bool down = s->fluid.gravity[up] > 0.0;
    for (int k = 0; k < PLACES; k++) {
        const double part = (k + 0.5) / PLACES;
        x[up] = low + size * (down ? part : 1.0 - part);
        if (!scene_is_fluid(s, e, x, NULL))
            return k > 0;
    }
    return 2;
}

/* No side lets go of water, and nothing pushes it off: below 0 the pressure would hold it there. */
void surface_check_hanging(const struct run *r, struct faults *f)
{
    enum { COLUMNS = 40 };
    const struct scene *s = &r->scene;
    const struct scene_domain *d = &s->domain;
    const int up = scene_still_axis(s), one = up == 0 ? 1 : 0, other = up == 2 ? 1 : 2;
    if (up < 0 || mesh_given_count > 0 || fv_params_nboxes(r) > 0 || r->coupled)
        return;
    const struct scene_wall *above =
        scene_wall_of(s, SIDE_X_MIN + 2 * up + (s->fluid.gravity[up] < 0.0));
    if (above && above->kind == WALL_INFLOW) /* it falls from there */
        return;
    const struct exact e = exact_create(s);
    const bool down = s->fluid.gravity[up] > 0.0;
    int found[3] = {0};
    for (int k = 0; k < COLUMNS * (d->dim == 3 ? COLUMNS : 1); k++) {
        const double part[2] = {(k % COLUMNS + 0.5) / COLUMNS, (k / COLUMNS + 0.5) / COLUMNS};
        double x[3] = {0.0};
        x[one] = d->min[one] + part[0] * (d->max[one] - d->min[one]);
        if (d->dim == 3)
            x[other] = d->min[other] + part[1] * (d->max[other] - d->min[other]);
        found[top_of_column(s, &e, up, x)]++;
    }
    if (found[1] > 0 && found[2] == 0)
        params_fault(r->params, f, "shapes",
                     "water touches the side %c_%s with nothing but air below it (gravity is along "
                     "%c%c): a side lets no water go, it would hang there; leave a gap, or raise "
                     "the domain",
                     "xyz"[up], down ? "min" : "max", down ? '+' : '-', "xyz"[up]);
}
