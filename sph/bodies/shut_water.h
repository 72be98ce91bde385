/* shut_water.h - waters that walls and bodies shut in while others are open to the air: each keeps
 * the volume that it has at the start, and with it the mean of its pressure.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_SHUT_WATER_H
#define SPH_SHUT_WATER_H

#include "../walls/sph_walls.h"

struct h5;

enum { BESIDE_REST = 1 << BODIES_MAX };

struct shut_water {
    double volume;   /* m^dim: of its particles at the start; 0: a body around it has moved */
    unsigned beside; /* bit k: body k bounds it; BESIDE_REST: walls at rest do */
    int64_t n, id[]; /* of the particles that stood there at the start, ascending */
};

/* Whether water seeps into one with these around: between a body and what else shuts it in. */
static inline bool shut_water_seeps(unsigned beside)
{
    return (beside & (BESIDE_REST - 1)) != 0 && (beside & (beside - 1)) != 0;
}
/* Which of them are within 1.5 dx of x. */
unsigned shut_water_beside(const struct sph *s, const double *x);
/* A water of n particles, whose ids are to be filled in; NULL: as many as are kept are there
 * already. Owned by s->walls. */
struct shut_water *shut_water_add(struct sph *s, int64_t n, unsigned beside);
/* At the start, when the first volumes are there; collective, as the next. */
void shut_waters_remember(struct sph *s);
/* After the stages of a step: scales the volumes of each by one factor. One beside a body that has
 * moved by half a spacing is let go for good. */
void shut_waters_keep(struct sph *s);
/* Restart files. Collective. false: the file has none, though it should. */
void shut_waters_save(const struct sph *s, struct h5 *f);
bool shut_waters_load(struct sph *s, struct h5 *f);

#endif
