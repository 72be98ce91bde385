/* run_files.h - the output folder of a run: snapshots, restart files and their manifest, view.py.
 * For run.c; collective over run->comm where no other is said.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "program.h"

/* What is needed to write the files of a run. Pointers are borrowed from run.c. */
struct run_files {
    struct run *run;
    const struct program *program;
    void *state;
    struct xdmf *xdmf;
    char *case_text; /* the case as params_text has it, on every rank */
    int next;        /* number of the next snapshot */
    char last[256]; /* name of the last restart file of a program that runs alone, without folder */
};

/* Writes NAME_NNNNNN.h5, numbered by f->next, or NAME_WHAT.h5, and its XDMF entry; nothing if the
 * case wants no snapshots. */
void files_snapshot(struct run_files *f, const char *what);
/* Writes the restart file of number n (step, or coupling step) and returns its name in file[256]. A
 * program that runs alone also writes the manifest and keeps the two newest files. */
void files_checkpoint(struct run_files *f, int64_t n, char *file);
/* Opens the restart file that DIR/checkpoint.txt names for this program. NULL with the reason
 * logged: no such file, damaged (disk_sealed), of another meaning, or later than the run's end.
 * *window: coupling step in the manifest, -1 if it is of a program that ran alone. */
struct h5 *files_open_restart(struct run *r, const struct program *p, int64_t *window);
/* Sets time, step and number of the next snapshot from a restart file; false: it lacks one of
 * them. */
bool files_read_clock(struct run_files *f, struct h5 *h);
/* Logs the keys, five at most, in which the case of a restart file differs from this one; the
 * groups time and output are left out, for a restart may change them. */
void files_tell_difference(const struct run_files *f, struct h5 *h);
/* Writes view.py, a script for ParaView, into the folder. */
void files_view(const struct run *r);
/* DIR/NAME-WHAT when coupled, DIR/WHAT when alone; valid as key_text is. */
const char *files_path(const struct run *r, const char *what);
