/* test_shore.c - the water's edge on a beach is where it is half a row deep; what flies ahead of it
 * does not count. ranks: 1 2. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/output/shore.h"
#include "sph_case.h"

static const double dx = 0.02, slope = 0.25, level = 0.3;

/* Water under y = 0.3 over a beach y = x/4, turned about if way < 0, and a drop beyond its edge. */
static void beach(struct sph_case *c, int way, bool drop)
{
    sph_case_set(c, 2, 50);
    struct scene *s = &c->run.scene;
    const double L = 2.0, wedge[3][2] = {{0.0, 0.0}, {0.0, level}, {level / slope, level}};
    s->initial.field = FIELD_REST;
    s->fluid.nu = 0.0;
    s->domain.max[0] = L;
    for (int a = 0; a < 2; a++)
        s->domain.periodic[a] = false;
    s->nshapes = drop ? 2 : 1;
    s->shapes[0].form = SHAPE_POLYGON;
    s->shapes[0].points.n = 3;
    for (int k = 0; k < 3; k++) {
        s->shapes[0].points.x[k][0] = way > 0 ? wedge[k][0] : L - wedge[k][0];
        s->shapes[0].points.x[k][1] = wedge[k][1];
    }
    s->shapes[1].form = SHAPE_DISC;
    s->shapes[1].centre[0] = way > 0 ? 1.6 : L - 1.6;
    s->shapes[1].centre[1] = 0.8;
    s->shapes[1].radius = 0.1;
    c->prm.surface = SURFACE_YES;
    c->prm.scheme = SCHEME_RIEMANN;
    sph_case_start(c, NULL);
    integrate_gradients(c->s);
}

TEST(the_edge_is_where_half_a_row_is_left)
{
    for (int k = 0; k < 4; k++) {
        struct sph_case c;
        const int way = k % 2 ? -1 : 1;
        beach(&c, way, k > 1);
        const double edge = shore_height(c.s, way > 0 ? 0.1 : 1.9);
        assert_true(fabs(edge - (level - 0.5 * dx)) < 0.5 * dx);
        DROP(c.s);
    }
}

TEST(a_tank_without_a_beach_has_no_edge)
{
    struct sph_case c;
    beach(&c, 1, false);
    assert_true(isnan(shore_height(c.s, 1.9)));
    DROP(c.s);
}
