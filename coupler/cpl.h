/* cpl.h - what a solver calls to take part in a coupled job.
 * The only header that a third-party solver needs; link with libcpl.a and MPI. tests/mock.c is the
 * smallest complete solver.
 *
 * All calls are collective over the solver's communicator, but cpl_fail, cpl_waited,
 * cpl_window_number and cpl_patch_eval. Lengths are in m, times in s. The caller keeps its arrays,
 * the library copies. n = 0 is legal on any rank. Calls return 0 or a negative enum cpl_error;
 * cpl_strerror says what, where and how to mend. After CPL_EPARTNER every further call returns it
 * at once.
 *
 * Order: open, zone ..., meet, find_zone ..., grid/points/field ..., ready,
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
    CPL_VERSION = 2,
    CPL_NAME = 64,
    CPL_TERMS = 4 /* in time, of a grid's field */
};
enum cpl_error {
    CPL_OK = 0,
    CPL_EINPUT = -2,   /* the case, the plan or the call is at fault */
    CPL_EPARTNER = -4, /* a partner failed or the job ends */
    CPL_EORDER = -5    /* a call out of order */
};
/* What a window asks for, bits. */
enum { CPL_RUN = 1, CPL_OUTPUT = 2, CPL_SAVE = 4, CPL_STOP = 8 };
enum cpl_direction { CPL_PUT = 1, CPL_GET = 2 };
enum cpl_mapping { CPL_SHEPARD, CPL_MLS };        /* points to points */
enum cpl_interpolation { CPL_LINEAR, CPL_CUBIC }; /* grid to anywhere */

struct cpl; /* a solver's place in the job: made by cpl_open, freed by cpl_close */

/* Meets all ranks of `world' within `deadline_s'. Programs are told apart by `name', not by place.
 * *mine: the ranks of this name (belongs to the library). *c is NULL, and all is well, when no
 * other program is there: the solver runs alone. */
int cpl_open(MPI_Comm world, const char *name, double deadline_s, struct cpl **c, MPI_Comm *mine);

/* s without a sign of life after which a partner counts as hung and ends the job (120; the same in
 * all programs of a job); before cpl_meet. Signs come from a thread of the library, also while the
 * solver computes. */
void cpl_patience(struct cpl *c, double s);

/* A box that partners may ask for by name ("sph.box", "sph.free"). Before cpl_meet. */
int cpl_zone(struct cpl *c, const char *zone, const double lo[3], const double hi[3]);
/* Compares the hash of the case, the restart window (-1: fresh start) and the number of faults that
 * each program found in its input; CPL_EINPUT on all programs if any differs or is not zero.
 * case_hash 0: this solver does not read the case (-p and all), so that nothing can be compared.
 * dir: the job's output folder (death note, manifest). */
int cpl_meet(struct cpl *c, uint64_t case_hash, int64_t restart_window, int faults,
             const char *dir);
/* CPL_EINPUT if nobody published it. */
int cpl_find_zone(struct cpl *c, const char *zone, double lo[3], double hi[3]);

/* A uniform grid of cells; value sit at cell centres origin + (i + 1/2) spacing and are cell
 * averages. This rank holds the global cells lo <= i < hi. */
struct cpl_grid {
    int dim;
    double origin[3], spacing[3];
    int cells[3];
    int periodic[3];
    int lo[3], hi[3];
};
int cpl_grid(struct cpl *c, const char *set, const struct cpl_grid *g, int *id);
/* A cloud of points. support: radius in m of the kernel in which points of another cloud are
 * gathered for this one (0 if this set only gives). */
int cpl_points(struct cpl *c, const char *set, int dim, double support, int *id);
/* A field of a set. Who gives and who takes is matched by the field's name; unit and ncomp must
 * agree. From a grid it arrives as a patch (cpl_patch_get), from points mapped to the taker's
 * points (cpl_get). For CPL_GET: mapping (points) or interpolation (grid). */
int cpl_field(struct cpl *c, int set, const char *name, const char *unit, int ncomp,
              enum cpl_direction d, int how, int *id);
/* The plan is checked by the coupler: all problems at once, printed by all programs. dt_wish: the
 * longest window this solver wants (INFINITY: no wish). A giver of grid fields puts their first
 * values after this and before the first cpl_window. */
int cpl_ready(struct cpl *c, double t, double dt_wish);

/* The next window [t0, t1] and its action; CPL_STOP: there is none, *code is the job's exit code (0
 * done, 3 diverged, 5 stopped on request). */
int cpl_window(struct cpl *c, double *t0, double *t1, int *action, int *code);
/* New places of a set's points on this rank: x[3 n], ids that are unique over all ranks (sums run
 * in their order, so results do not depend on the number of ranks), volumes (m^dim; NULL for
 * takers). Kept until the next call. */
int cpl_move(struct cpl *c, int set, long n, const double *x, const int64_t *gid,
             const double *volume);
/* Gives a field at time t, the start or the end of the window: v[n ncomp] in the order of cpl_move,
 * or of the grid's block (x fastest). dvdt: its time derivative, grids only, NULL: zero. */
int cpl_put(struct cpl *c, int field, double t, long n, const double *v, const double *dvdt);
/* The same of a grid with its course in time: v(t') = sum of term[k] (t' - t)^k over k < nterms, at
 * most CPL_TERMS; term[0] the values. */
int cpl_put_course(struct cpl *c, int field, double t, long n, int nterms,
                   const double *const term[]);
/* Takes a mapped field at the last moved points and the window's end: waits for the giver. mask[n]:
 * 1 mapped, 0 no point within the support (v untouched); may be NULL. */
int cpl_get(struct cpl *c, int field, long n, double *v, unsigned char *mask);
/* Takes a grid field around the box [lo, hi] (this rank's; lo > hi: none): waits for the giver. The
 * patch stays until the next call. In a window the first call takes the values at its start, the
 * second those at its end. */
int cpl_patch_get(struct cpl *c, int field, const double lo[3], const double hi[3]);
/* Evaluates the patch at n points x[3 n] and time t; no communication. v[n ncomp]; grad[n ncomp 3]
 * or NULL. Points outside the patch get the value of its nearest place. */
void cpl_patch_eval(const struct cpl *c, int field, double t, long n, const double *x, double *v,
                    double *grad);
/* Number for the coupler's progress line and summary, sent with the next advance or close. Sums of
 * norms "norm.velocity.e2" add up over programs. Rank 0's value counts. */
int cpl_tell(struct cpl *c, const char *key, double value);
/* The window is done. stop: asks for an orderly end of the job. */
int cpl_advance(struct cpl *c, double t1, int stop);
/* A restart file of the current window is complete; the manifest is written when all have said so.
 */
int cpl_saved(struct cpl *c, const char *file);

int64_t cpl_window_number(const struct cpl *c);
double cpl_waited(const struct cpl *c); /* s spent waiting for partners */
double cpl_heard(const struct cpl *c);  /* s since the coupler's last message */
/* Writes to a file descriptor why the job ends, as far as is known. The library has a handler of
 * its own for SIGTERM only where the solver has none at cpl_open; this is for the solver's handler
 * of SIGTERM, which survivors of a failure get. */
void cpl_obituary(int fd);
const char *cpl_strerror(const struct cpl *c);
/* Leaves a note with the reason and ends the whole job with this exit code; any rank may call. Does
 * not return. */
void cpl_fail(struct cpl *c, int code, const char *reason);
/* Says goodbye and waits for the others to do so; sets *c to NULL. Returns the exit code of the
 * job, which is 1 on all programs when the job's results are not accepted; `code' when c is NULL or
 * the job was refused. Before CPL_STOP it is a failure of this program. */
int cpl_close(struct cpl **c, int code);

#ifdef __cplusplus
}
#endif
#endif
