/* motion_files.h - the files of prescribed motions beside a case, and of levels and discharges of
 * openings over time, each read once a run, whoever asks for it. Every rank reads for itself.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stddef.h>

/* One file: rows of `columns' numbers separated by blanks, commas or semicolons, the first of them
 * the time, s, which rises from row to row. Lines that begin with # or a word are passed over. */
struct motion_file {
    char *path;  /* owned */
    int columns; /* numbers that a row must have */
    /* Rows; -1: there is no such file, 0: a line has another number of columns, or a time that
     * does not rise. */
    int n;
    double *rows; /* [n][columns] */
    /* Of the first line at fault: its number from 1, 0: none, and how many numbers it has. */
    int line, got;
};

/* The list of what was read; owns the files. */
struct motion_files {
    const char *dir; /* of the case: file names start there; borrowed */
    int n;
    struct motion_file **of;
};

/* An empty list, owned by the caller; dir is borrowed. */
struct motion_files *motion_files_create(const char *dir);
/* The file as it was when it was first asked for with this number of columns; owned by the list.
 * NULL if `all' is NULL. A file that cannot be read has n <= 0. */
const struct motion_file *motion_files_read(struct motion_files *all, const char *file,
                                            int columns);
/* What is wrong with a file of n <= 0, as text[size]; `row' says what a row holds: "t, x, y". */
void motion_file_fault(const struct motion_file *m, const char *row, char *text, size_t size);
/* Adds a computed file of that name, n rows with rising times, so that motion_files_read finds it.
 * rows[n][columns] must come from mem.h and passes to the list. */
void motion_files_add(struct motion_files *all, const char *file, int n, int columns, double *rows);
