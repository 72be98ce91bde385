/* wall_share.h - how much of the kernel around a point lies behind the faces of one owner.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WALL_SHARE_H
#define SPH_WALL_SHARE_H

#include "walls.h"

/* The part, -, of the kernel around x, m, which lies behind the faces of a body (-1: of walls at
 * rest), counting an x behind them as within. Of what a Shepard factor lacks it is that owner's.
 * Local. */
double wall_share(const struct sph *s, int body, const double *x);
/* The same of the owner of a mesh, thin ones left out, for a point `own' in the mesh's own frame,
 * without images beyond periods: it stays what it is however the owner moves. In 3D. */
double wall_share_in_frame(const struct sph *s, int mesh, const double *own);
/* What the water behind these faces, if it were there, would weigh between them and a body whose
 * surface has the normal n, out of the fluid, at x: adds to out, m^2/s^2, n g.b + g m, the
 * density over rho of what their pair forces have beside those of a uniform pressure. b is the
 * first moment of the kernel behind the faces, and m summed over the body's surface is the double
 * integral of the kernel over what is behind the one and the other. */
void wall_share_weight(const struct sph *s, int body, const double *x, const double *n,
                       double out[3]);

#endif
