/* ghost_lines.h - packed records of mirrored ghosts: the state behind a wall from a state before it
 * [3.1-3.10], and the friction of no-slip walls (Chiron 2017, chapter 3).
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_GHOST_LINES_H
#define SPH_GHOST_LINES_H

#include "../sph.h"

/* Ghosts of walls: a contiguous block among the ghosts of s->p. */
struct ghost_block {
    int n, first;      /* first: counted from the first ghost */
    double *rub;       /* [n][dim] m/s: u of the no-slip form minus u of the slip form; owned */
    bool has_friction; /* any of it is not zero */
};

/* Density at the distance d, m, along n from a point with density rho, by (1/rho) dp/dn = K, m/s^2
 * [3.9-3.10]. */
double ghost_density(const struct sph *s, double rho, double K, double d);
/* Whether fluid of density rho, at the distance d, m, before a wall, parts from it: air comes
 * between in scenes with a free surface where fluid at u, m/s, along n relative to the wall, leaves
 * a roof (from 30 degrees to the upright on) that it hangs from by more than a quarter of the
 * weight of a row. K as above. */
bool ghost_parted(const struct sph *s, double rho, double K, double d, double u);
/* Writes x, u, w, rho into the packed record of a ghost. */
void ghost_set_line(const struct sph *s, double *line, const double *x, const double *u, double w,
                    double rho);
/* Adds to the rates of momentum the difference between no-slip and slip ghosts in the Laplacian
 * [2.31]; both forms in one pass would make particles clump [3.4]. */
void ghost_friction(struct sph *s, const struct ghost_block *g);
/* Makes room for n more ghosts behind those of s->p; returns the index of the first. */
int ghost_append(struct sph *s, struct ghost_block *g, int n);

#endif
