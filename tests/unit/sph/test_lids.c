/* test_lids.c - a lid is a lid on whichever side, and whichever way it slides: corners of mirrored
 * ghosts do not depend on the order of axes. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "sph_case.h"

/* Kinetic energy after 12 steps in a closed cube without slip, its high side of an axis sliding. */
static double energy_of(int dim, int scheme, int axis, int along)
{
    struct sph_case c;
    double sums[SUM_COUNT];
    sph_case_set(&c, dim, dim == 2 ? 16 : 8);
    struct scene *e = &c.run.scene;
    e->initial.field = FIELD_REST;
    e->fluid.nu = 0.02;
    e->nwalls = 2 * dim;
    for (int side = 0; side < 2 * dim; side++) {
        e->domain.periodic[side / 2] = false;
        e->walls[side].side = SIDE_X_MIN + side;
        e->walls[side].kind = WALL_NO_SLIP;
    }
    e->walls[2 * axis + 1].velocity[along] = 1.0;
    c.prm.scheme = scheme;
    c.prm.walls = WALLS_GHOSTS;
    c.prm.cfl_viscous = 0.02;
    sph_case_start(&c, NULL);
    assert_true(sph_case_run(&c, 12, 100.0));
    sph_sums(c.s, sums);
    DROP(c.s);
    return sums[SUM_KINETIC];
}

TEST(lids_are_alike_on_all_sides)
{
    static const int schemes[2] = {SCHEME_RIEMANN_ALE, SCHEME_DELTA};
    for (int dim = 2; dim <= 3; dim++)
        for (int k = 0; k < 2; k++) {
            const double first = energy_of(dim, schemes[k], 0, 1);
            assert_true(first > 0.0);
            for (int axis = SANITIZED ? dim - 1 : 0; axis < dim; axis++)
                for (int along = 0; along < dim; along++)
                    if (along != axis)
                        assert_close(energy_of(dim, schemes[k], axis, along) / first, 1.0, 1e-9);
        }
}
