/* wall_files.h - meshes of walls and bodies for ParaView, beside the snapshots, and what a restart
 * file keeps of them. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WALL_FILES_H
#define SPH_WALL_FILES_H

#include "../sph.h"

/* With the first snapshot of a run NAME_walls.h5 and .xdmf; of bodies their places into each
 * snapshot f, `file' its name. x: NULL except on rank 0. Collective. */
void wall_files_snapshot(struct sph *s, struct h5 *f, const struct xdmf *x, const char *file);
/* Hashes of the meshes into a restart file; whether they are those of the case, said if not. */
void wall_files_save(const struct sph *s, struct h5 *f);
bool wall_files_fit(const struct sph *s, struct h5 *f);

#endif
