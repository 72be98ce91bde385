/* wall_files.h - meshes of walls and bodies for ParaView, beside the snapshots, and what restart
 * files keep of them.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../sph.h"

/* With the first snapshot of a run writes NAME_walls.h5 and .xdmf; into each snapshot f, of the
 * name `file', the vertices of bodies. x: NULL except on rank 0. Collective. */
void wall_files_snapshot(struct sph *s, struct h5 *f, const struct xdmf *x, const char *file);
/* Writes hashes of the meshes into a restart file; wall_files_fit returns whether they are those of
 * the case, and logs if they are not. Collective. */
void wall_files_save(const struct sph *s, struct h5 *f);
bool wall_files_fit(const struct sph *s, struct h5 *f);
