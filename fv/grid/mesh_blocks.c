/* mesh_blocks.c - questions about the blocks as the case has them. All from parameters alone:
 * before a mesh is made, and on all ranks alike.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "mesh_blocks.h"

#include <stdarg.h>

/* Adds a fault at the key of block b, with its name in the text. */
void mesh_fault(const struct run *r, struct faults *f, const struct mesh_block_params *b,
                const char *key, const char *fmt, ...)
{
    char text[900], path[64];
    va_list args;
    va_start(args, fmt);
    vsnprintf(text, sizeof text, fmt, args);
    va_end(args);
    snprintf(path, sizeof path, "blocks.[%d].%s", b->number, key);
    params_fault(r->params, f, path, "block \"%s\": %s", b->name, text);
}

bool mesh_block_has(const struct mesh_block_params *b, enum mesh_side kind)
{
    const int side[6] = {b->i_min, b->i_max, b->j_min, b->j_max, b->k_min, b->k_max};
    bool any = false;
    for (int q = 0; q < 6; q++)
        any = any || side[q] == (int)kind;
    return any;
}

/* A slip side on a side of the domain is the domain's; sides of boxes that are turned, and of other
 * mappings, do not lie there. */
bool mesh_side_is_body(const struct run *r, const struct mesh_block_params *b, int side)
{
    const int kinds[6] = {b->i_min, b->i_max, b->j_min, b->j_max, b->k_min, b->k_max};
    const int a = side / 2;
    const double *end = side % 2 ? r->scene.domain.max : r->scene.domain.min,
                 *own = side % 2 ? b->max : b->min;
    const bool upright =
        (b->mapping == MAPPING_BOX || b->mapping == MAPPING_STRETCHED) && b->angle == 0.0;
    const double L = r->scene.domain.max[a] - r->scene.domain.min[a];
    if (kinds[side] == MESH_SLIP)
        return (!upright && !(b->mapping == MAPPING_ANNULUS && a == 2)) ||
               fabs(own[a] - end[a]) > 1e-9 * L;
    return kinds[side] == MESH_WALL;
}

bool mesh_block_is_body(const struct run *r, const struct mesh_block_params *b)
{
    bool any = false;
    for (int side = 0; side < 2 * r->scene.domain.dim; side++)
        any = any || mesh_side_is_body(r, b, side);
    return any;
}

bool mesh_blocks_move(const struct mesh_blocks *all)
{
    bool any = false;
    for (int k = 0; k < all->n; k++)
        any = any || all->of[k].motion.n > 0;
    return any;
}
