/* output_state.c - what outputs keep from row to row. The search of blocks for gauges is made once;
 * blocks that move are searched in their own frame (overset_search.c).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "output.h"

#include "../grid/fv_grid.h"
#include "mesh_output.h"

struct fv_output *output_create(const struct fv *s)
{
    struct fv_output *o = NEW(struct fv_output, 1);
    o->begun = s->run->step;
    if (s->m && s->run->scene.nprobes > 0) {
        o->search = mem_own(o, overset_search(s->run, s->m));
        o->samples = NEW_IN(o, struct block_samples, s->run->scene.nprobes);
        o->faces = NEW_IN(o, struct face_weights, s->run->scene.nprobes);
    }
    return o;
}
