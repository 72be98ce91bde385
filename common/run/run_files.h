/* run_files.h - the output folder of a run: snapshots, restart files and their manifest, view.py.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_RUN_FILES_H
#define COMMON_RUN_FILES_H

#include "run.h"

struct run_files {
    struct run *run;
    const struct program *program;
    void *state;
    struct xdmf *xdmf;
    char *case_text; /* rank 0; others "" */
    int next;        /* number of the next snapshot */
    char last[256];  /* the last restart file (alone) */
};

/* Writes NAME_NNNNNN.h5 (or NAME_WHAT.h5) and its XDMF entry. Collective, as all here. */
void files_snapshot(struct run_files *f, const char *what);
/* Writes the restart file of number n; alone: also the manifest, and keeps two. file[256]: its
 * name. */
void files_checkpoint(struct run_files *f, int64_t n, char *file);
/* Opens the restart file that DIR/checkpoint.txt names for this program; NULL with the reason
 * logged. *window: of the manifest, -1 if it is of a lone run. */
struct h5 *files_open_restart(struct run *r, const struct program *p, int64_t *window);
/* What a restart file holds for the run itself. */
bool files_read_clock(struct run_files *f, struct h5 *h);
/* Names the keys in which the case of a restart file differs from this one; those of time and
 * output may. */
void files_tell_difference(const struct run_files *f, struct h5 *h);
void files_view(const struct run *r);
/* out/CASE/NAME-WHAT when coupled, out/CASE/WHAT alone. */
void files_path(const struct run *r, const char *what, char *path, size_t size);

#endif
