/* output.h - series, summary, gauges, snapshots, restart files, pictures of a case.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../fv.h"

/* What outputs keep from row to row. */
struct fv_output {
    struct overset *search;        /* blocks: of the gauges; NULL: none */
    struct block_samples *samples; /* blocks: of each gauge of a level or discharge */
    struct face_weights *faces;    /* blocks: of each gauge of a discharge */
    int nhistory;
    double (*history)[3]; /* blocks: s, N: t, force x, force y of each row of the series */
    int64_t begun;        /* step of the run that this process began with */
};

/* fv_report.c: what outputs of this grid need; owned by the caller (FREE). Collective. */
struct fv_output *output_create(const struct fv *s);

/* The fields of a snapshot, m/s, Pa, 1/s. */
enum output_field { OUTPUT_VELOCITY, OUTPUT_PRESSURE, OUTPUT_VORTICITY };
/* fv_io.c: sets the components q to averages over the volumes of cells, as snapshots have them. */
void output_fill(struct fv *s, enum output_field what, double *const q[3]);
/* Snapshot, restart file and its reading (fv_restart.c); s is a struct fv *. false: the file does
 * not fit, and the reason has been logged. */
void fv_snapshot(void *s, struct h5 *f, struct xdmf *x, const char *file);
void fv_checkpoint(void *s, struct h5 *f);
bool fv_restore(struct fv *s, struct h5 *f);
/* row and finish of struct program. */
void fv_row(void *s, struct figures *to);
void fv_finish(void *s);
/* Sums over what no partner counts, for the coupler; see program.tell. */
void fv_tell(void *s, struct summary *report);

/* fv_draw.c: see program.draw. */
struct picture;
void fv_draw(const struct run *r, const struct fv_params *prm, struct picture *p);

/* fv_probes.c: adds the columns of the case's gauges, of a coupled job those that no partner reads.
 * Collective. */
void fv_probes_row(struct fv *s, struct figures *to);

/* fv_forces.c: adds the columns of forces on all walls and bodies, then on each body. Collective.
 */
void fv_forces_row(struct fv *s, struct figures *to);
/* Writes the forces now to the summary, and what follows from their history. Collective. */
void fv_summarise_forces(struct fv *s);

/* steady_errors.c: of a regular or solitary wave into the summary. */
void steady_summarise(struct fv *s);
/* fv_lines.c: extrema on the centre lines into the summary. */
void fv_summarise_extrema(const struct fv *s);

/* surface_errors.c: kinetic energy of the water over rho, m^(dim+2)/s^2, over all ranks.
 * Collective. */
double surface_energy(const struct fv *s);
/* Largest coordinate of water along axis a, m, over all ranks. Collective. */
double surface_reach(const struct fv *s, int a);
/* Writes period and damping of a standing wave, the volume and counts to the summary. */
void surface_summarise(struct fv *s);
/* even_level.c, uniform cells: height of the water over x, m, against gravity: that of the water in
 * the column of cells there on top of what x stands on. This rank's part of it. Collective. */
double surface_level(const struct fv *s, const double *x);

/* Error norms: of velocity, pressure and vorticity. */
enum { NORMS = 3 };

/* fv_errors.c: kinetic energy over the computed cells by averages, the exact field's, and what
 * velocities within cells add to the first, J/kg m^dim. */
void fv_energies(struct fv *s, double sum[3]);
/* Errors against the exact field now, of all ranks, in the fields' own units. Collective. */
void fv_errors(struct fv *s, struct norm n[NORMS]);
/* How the run steps: "rk3, three projections a step". */
const char *report_method(const struct fv_params *prm);
