/* surface_case.h - small flows with a free surface for the tests of the level set and of the
 * integrators. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../../../fv/surface/levelset.h"
#include "fv_case.h"

#define SURFACE "fv.surface=\"yes\"", "initial.field=\"rest\"", CLOSED
#define BDF2 "fv.integrator=\"bdf2\""
#define NEWTON "fv.integrator=\"newton\""
#define WAVE                                                                                       \
    "fv.surface=\"yes\"", "initial.field=\"standing_wave\"", "initial.level=1",                    \
        "initial.amplitude=0.01", "initial.U=0.01", "initial.L=4", "fluid.gravity=(0,-1)",         \
        "domain.max=(4,1.25)", "domain.periodic=(true,false)"

static const char *const integrators[2] = {BDF2, NEWTON};

/* Sides that are not periodic are walls of this kind; shape: NULL or the water. */
static inline struct fv *start(struct fv_case *c, MPI_Comm comm, const char *const *overrides,
                               const struct scene_shape *shape, enum wall_kind kind)
{
    fv_case_set(c, comm, overrides);
    fv_case_close(c, kind);
    if (shape)
        c->run.scene.shapes[c->run.scene.nshapes++] = *shape;
    return fv_case_start(c, NULL);
}
