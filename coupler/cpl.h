/* cpl.h - what a solver calls to take part in a coupled job.
 * The only header that a third-party solver needs; link with -lcpl and MPI. coupler/README.md has a
 * page "your solver in ten calls", coupler/examples/ a plain partner. A window is a coupling
 * step: the time from one exchange to the next.
 *
 * All calls are collective over the solver's communicator, but cpl_fail, cpl_waited, cpl_heard,
 * cpl_window_number, cpl_version, cpl_strerror, cpl_cell and cpl_patch_eval. Lengths are in m,
 * times in s. The caller keeps its arrays, the library copies. n = 0 is legal on any rank, on all
 * of them, too. Calls return 0 or a negative enum cpl_error; cpl_strerror says what, where and how
 * to mend. After CPL_EPARTNER every further call returns it at once. Nothing is cut short: names of
 * CPL_NAME bytes and more, or more sets and fields than fit, are refused.
 *
 * Order: open, zone ..., meet, find_zone ..., grid/points/period/field ..., ready,
 *        then per window: window, [move, put, get, patch_get] ..., advance; at last close.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COUPLER_CPL_H
#define COUPLER_CPL_H

#include <mpi.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    CPL_VERSION = 3, /* of this header: programs, library and coupler must have the same */
    CPL_NAME = 64,   /* bytes of a name, the closing zero among them */
    CPL_TERMS = 4    /* in time */
};
enum cpl_error {
    CPL_OK = 0,
    CPL_EINPUT = -2,   /* the case, the plan or the call is at fault */
    CPL_EPARTNER = -4, /* a partner failed or the job ends */
    CPL_EORDER = -5    /* a call out of order */
};
/* What a coupling step asks for, bits: CPL_RUN, with CPL_OUTPUT or CPL_SAVE if an output or a
 * restart file is due at its end; CPL_STOP alone: the job ends. */
enum { CPL_RUN = 1, CPL_OUTPUT = 2, CPL_SAVE = 4, CPL_STOP = 8 };
/* A field that is put must have a target that gets it, unless CPL_OPTIONAL is added. */
enum cpl_direction { CPL_PUT = 1, CPL_GET = 2, CPL_OPTIONAL = 4 };
/* From points to points, within the support radius of the target's set. Consistent: the target gets
 * a mean of what is around it (constants are reproduced, by CPL_MLS linear functions, too). With
 * CPL_CONSERVATIVE added, the transpose of that: the value of each source (a force, a mass:
 * something that adds up) is distributed over the target's points around it by weights whose sum is
 * 1, so that the sum over all points is conserved to rounding; a source without a target in reach
 * gives all to the nearest one. CPL_SUM is neither: the sum of volume times value times kernel, not
 * divided by the sum of the weights, everywhere (mask 1); of ones it is the fraction of the kernel
 * that the sources fill. */
enum cpl_mapping { CPL_SHEPARD, CPL_MLS, CPL_NEAREST, CPL_SUM, CPL_CONSERVATIVE = 16 };
enum cpl_interpolation { CPL_LINEAR, CPL_CUBIC }; /* grid to anywhere */
/* Which values a read is made of. A put holds them at one time, the start or the end of a coupling
 * step, with a polynomial in time around it where the source has one. */
enum cpl_when {
    CPL_START,  /* those of the window's start, followed in time: waits for nobody's window */
    CPL_END,    /* those of its end: waits until the source has done the window */
    CPL_BETWEEN /* the straight line between the two */
};

struct cpl; /* a solver's place in the job: made by cpl_open, freed by cpl_close */

/* The library's CPL_VERSION. */
int cpl_version(void);
/* cpl_open for those who cannot include this header: `version' is the one they were written for. */
int cpl_open_as(int version, MPI_Comm world, const char *name, double deadline_s, struct cpl **c,
                MPI_Comm *mine);
/* Handshake with all ranks of `world' within `deadline_s'. Programs are told apart by `name', not
 * by place. *mine: the ranks of this name (belongs to the library). *c is NULL, and all is well,
 * when no other program is there: the solver runs alone. */
static inline int cpl_open(MPI_Comm world, const char *name, double deadline_s, struct cpl **c,
                           MPI_Comm *mine)
{
    return cpl_open_as(CPL_VERSION, world, name, deadline_s, c, mine);
}

/* Sets the time, s, without a sign of life after which a partner counts as hung and ends the job
 * (120; the same in all programs of a job); before cpl_meet. Signs come from a thread of the
 * library, also while the solver computes. */
void cpl_patience(struct cpl *c, double s);

/* A box that partners may ask for by name ("sph.box", "sph.free"). Before cpl_meet. */
int cpl_zone(struct cpl *c, const char *zone, const double lo[3], const double hi[3]);
/* Compares the hash of the case, the restart window (-1: fresh start) and the number of faults that
 * each program found in its input; CPL_EINPUT on all programs if any differs or is not zero.
 * case_hash 0: this solver does not read the case (-p and all), so that nothing can be compared.
 * dir: the job's output folder (error report, manifest). */
int cpl_meet(struct cpl *c, uint64_t case_hash, int64_t restart_window, int faults,
             const char *dir);
/* Corners of the box that a partner named so; after cpl_meet. CPL_EINPUT if nobody published it. */
int cpl_find_zone(struct cpl *c, const char *zone, double lo[3], double hi[3]);

/* A uniform grid of cells; values sit at cell centres origin + (i + 1/2) spacing and are cell
 * averages. This rank holds the global cells lo <= i < hi. */
struct cpl_grid {
    int dim;
    double origin[3], spacing[3];
    int cells[3];
    int periodic[3];
    int lo[3], hi[3];
};
/* Declares a set of this name that is such a grid; *id is its number in the calls below. */
int cpl_grid(struct cpl *c, const char *set, const struct cpl_grid *g, int *id);
/* A cloud of points. support: radius in m of the kernel in which points of another cloud are
 * gathered for this one (0 if this set only gives). */
int cpl_points(struct cpl *c, const char *set, int dim, double support, int *id);
/* Points and their distances repeat themselves by period[a] m in direction a (0: not). The target's
 * set decides, or the source's, or the coupler's case (coupler.period, domain.periodic). */
int cpl_period(struct cpl *c, int set, const double period[3]);
/* A field of a set: 1 to 64 components. One set of one program gives it, any number of sets of
 * others take it: matched by the field's name; unit and ncomp must agree. From a grid it arrives as
 * a patch (cpl_patch_get), from points mapped to the target's points (cpl_get). d: cpl_direction;
 * how: for CPL_GET, cpl_mapping (points) or cpl_interpolation (grid). */
int cpl_field(struct cpl *c, int set, const char *name, const char *unit, int ncomp, int d, int how,
              int *id);
/* The plan is checked by the coupler: all problems at once, printed by all programs. t: where this
 * solver starts, the same in all. dt_longest: the longest window it wants (INFINITY: no wish). A
 * source of grid fields puts their first values after this and before the first cpl_window. */
int cpl_ready(struct cpl *c, double t, double dt_longest);

/* The next window [t0, t1] and its action; CPL_STOP: there is none, *code is the job's exit code (0
 * done, 3 diverged, 5 stopped on request). */
int cpl_window(struct cpl *c, double *t0, double *t1, int *action, int *code);
/* New places of a set's points on this rank: x[3 n], ids that are unique over all ranks (sums run
 * in their order, so results do not depend on the number of ranks), volumes (m^dim): their weight
 * as sources, and as targets of a conservative mapping (NULL: all alike). Targets of consistent
 * ones need neither (NULL). Kept until the next call. */
int cpl_move(struct cpl *c, int set, long n, const double *x, const int64_t *gid,
             const double *volume);
/* The same for general cells, held by their centroids and volumes. In 2D polygons of nvertex[i] >=
 * 3 corners in order; in 3D tetrahedra (4), pyramids (5), wedges (6) and hexahedra (8) in VTK's
 * order. x: the corners, 3 numbers each, cell after cell. CPL_EINPUT for a cell without volume. */
int cpl_move_cells(struct cpl *c, int set, long n, const int *nvertex, const double *x,
                   const int64_t *gid);
/* Centroid and volume of one such cell; volume 0: none. */
void cpl_cell(int dim, int nvertex, const double *x, double centroid[3], double *volume);
/* Gives a field at time t, the start or the end of the window: v[n ncomp] in the order of cpl_move,
 * or of the grid's block (x fastest). dvdt: its time derivative, NULL: zero. Once at each time, in
 * their order: the end of a window is the start of the next. */
int cpl_put(struct cpl *c, int field, double t, long n, const double *v, const double *dvdt);
/* The same with its course in time: v(t') = sum of term[k] (t' - t)^k over k < nterms, at most
 * CPL_TERMS; term[0] the values. nterms must be the same on all ranks. */
int cpl_put_course(struct cpl *c, int field, double t, long n, int nterms,
                   const double *const term[]);
/* Takes a mapped field at the last moved points and a time t of the window. mask[n]: 1 mapped, 0 no
 * point within the support (v untouched); may be NULL. Of points that have moved in the window
 * CPL_BETWEEN joins what was mapped from the old places and from the new ones. */
int cpl_get_at(struct cpl *c, int field, enum cpl_when when, double t, long n, double *v,
               unsigned char *mask);
/* The same with CPL_END at the window's end. */
int cpl_get(struct cpl *c, int field, long n, double *v, unsigned char *mask);
/* Takes a grid field around the box [lo, hi] (this rank's; lo > hi: none); cpl_patch_eval then
 * knows it at any time. The patch stays until the next call. */
int cpl_patch_get_at(struct cpl *c, int field, enum cpl_when when, const double lo[3],
                     const double hi[3]);
/* The same: in a window the first call with CPL_START, the second with CPL_END. */
int cpl_patch_get(struct cpl *c, int field, const double lo[3], const double hi[3]);
/* Evaluates the patch at n points x[3 n] and time t; no communication. v[n ncomp]; grad[n ncomp 3]
 * or NULL. Points outside the patch get the value of its nearest place. */
void cpl_patch_eval(const struct cpl *c, int field, double t, long n, const double *x, double *v,
                    double *grad);
/* Reports a number for the coupler's progress line and summary; it is sent with the next advance or
 * close. Sums of norms "norm.velocity.e2" add up over programs; errors are given in the unit
 * "norm.velocity.unit". Rank 0's value counts; a key has at most 95 bytes, a program 192 keys. */
int cpl_tell(struct cpl *c, const char *key, double value);
/* Reports that the coupling step up to t1 is done. stop: asks for an orderly end of the job. */
int cpl_advance(struct cpl *c, double t1, int stop);
/* A restart file (a name of at most 255 bytes, without spaces) of the current window is complete.
 * The manifest DIR/checkpoint.txt is written when all have said so: lines "window N", "t T",
 * "PROGRAM FILE". To continue from there: the coupler with --restart, cpl_meet with N, cpl_ready
 * with T. */
int cpl_saved(struct cpl *c, const char *file);

/* Number of the coupling step under way or last done; before the first one, of the first. */
int64_t cpl_window_number(const struct cpl *c);
double cpl_waited(const struct cpl *c); /* s spent waiting for partners */
double cpl_heard(const struct cpl *c);  /* s since the coupler's last message */
/* Writes to a file descriptor why the job ends, as far as is known. The library has a handler of
 * its own for SIGTERM only where the solver has none at cpl_open; this is for the solver's handler
 * of SIGTERM, which survivors of a failure get. */
void cpl_obituary(int fd);
/* What the last error was, where, and how to mend it; borrowed until the next call. */
const char *cpl_strerror(const struct cpl *c);
/* Leaves a failure report with the reason and ends the whole job with this exit code; any rank may
 * call it. Does not return. */
void cpl_fail(struct cpl *c, int code, const char *reason);
/* Leaves the job and waits for the others to do so; sets *c to NULL. Returns the exit code of the
 * job, which is 1 on all programs when the job's results are not accepted; `code' when c is NULL or
 * the job was refused. Before CPL_STOP it is a failure of this program. */
int cpl_close(struct cpl **c, int code);

#ifdef __cplusplus
}
#endif
#endif
