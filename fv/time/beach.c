/* beach.c - see beach.h. SPDX-License-Identifier: BSD-3-Clause */
#include "beach.h"

#include <math.h>

#include "../../common/scene/scene_beach.h"
#include "../boundary/forcing.h"
#include "stages.h"

void beach_relax(struct fv *s, double dt)
{
    const struct scene *c = &s->run->scene;
    if (!scene_has_beach(c))
        return;
    FLOW_ROWS (s, at, n)
        for (int64_t i = at; i < at + n; i++) {
            double x[3];
            forcing_centre(s, i, x);
            const double rate = scene_beach_rate(c, x);
            if (rate == 0.0)
                continue;
            const double kept = exp(-rate * dt);
            for (int a = 0; a < s->dim; a++) {
                s->u[a][i] *= kept;
                if (s->u_old[a])
                    s->u_old[a][i] *= kept;
            }
        }
    s->stages->fill_velocity(s);
}
