/* probe_flow.h - what flows through the section of a discharge gauge, from samples of the velocity
 * and the distance to the surface over it. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../fv.h"

enum { FLOW_VALUES = 4 }; /* of a sample: velocity, phi (m, < 0: in water) */

struct flow_samples {
    int n;
    double (*x)[3];               /* m */
    double (*value)[FLOW_VALUES]; /* all 0: to be filled */
    double across[3];
    double *area; /* m^(dim-1): of each sample */
    double step;  /* m: largest distance of two */
};
/* Where the parts of a section end along one of its tangents, m from where it starts, ascending. */
struct flow_ends {
    int n;       /* parts */
    double *end; /* [n + 1] */
};
/* The parts between these ends along each tangent of the section c. */
struct flow_samples flow_samples_between(int dim, const struct scene_probe *g,
                                         const struct probe_section *c,
                                         const struct flow_ends of[2]);
/* Equal parts. */
struct flow_samples flow_samples_create(const struct fv *s, const struct scene_probe *g);
/* Uniform cells and layers: what lies of the section in each cell is one, so that sums of what
 * crosses cells are exact. */
struct flow_samples flow_samples_of_cells(const struct fv *s, const struct scene_probe *g);
void flow_samples_free(struct flow_samples *f);
/* m^dim/s: of samples that are filled. */
double flow_samples_sum(const struct flow_samples *f, int dim);

/* Of the second cell before a wall in the pressure at a place between the wall and the centre of
 * the first, so many cells from the wall: that of the parabola without a slope there, as the
 * pressure beyond that of water at rest has none at a wall at rest. Straight on from two cells
 * impacts were too hard. */
static inline double probe_weight_at_wall(double x)
{
    const double from = x > 0.0 ? x : 0.0;
    return 0.5 * (from * from - 0.25);
}

/* How gauges read on a kind of cells: this rank's shares, which add up; gauge: its number. */
struct probe_reader {
    /* Values of nq fields at x, NULL: the pressure, and then a number below 0 where water is. */
    void (*point)(const struct fv *s, const double *x, int nq, double *const *q, double *here);
    /* Height of the water over x; NAN where FV does not compute. */
    double (*level)(struct fv *s, int gauge, const double *x);
    double (*discharge)(struct fv *s, int gauge, const struct scene_probe *g); /* m^dim/s */
};
extern const struct probe_reader even_reader, mesh_reader;
/* Whether a body or a partner is there, whose cells are not computed. */
bool mesh_is_out(const struct fv *s, const double *x);
