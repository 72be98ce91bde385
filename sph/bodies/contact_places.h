/* contact_places.h - where the contact of each sharp corner begins, as long as it touches.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_CONTACT_PLACES_H
#define SPH_CONTACT_PLACES_H

#include "body_touch.h"

struct h5;

/* Those of a stage, and how far through those of the last one; zeroed memory is empty. */
struct contact_places {
    int n, at;
    struct contact_place *of; /* owned */
};

/* Adds a sharp corner that touches, gap, m: where contact begins with what comes from outside.
 * Returns it, valid until the next call. */
struct contact_place *contact_places_add(const struct sph *s, struct contact_places *to,
                                         const struct pair *p, const struct touch *t, double gap);
/* Makes these the walls' own. */
void contact_places_take(struct walls *w, struct contact_places *from);
/* Once a step: what has been lifted sinks back. */
void contact_places_settle(struct sph *s);
/* Restart files, written or read. */
void contact_places_restart(struct walls *w, struct h5 *f);

#endif
