/* motion_files.h - the files of prescribed motions beside a case, and of what openings do over
 * time, each read once a start, whoever asks for it and how often.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_MOTION_FILES_H
#define COMMON_MOTION_FILES_H

/* One file: rows of `columns' numbers, the first of them the time, which rises from row to row. */
struct motion_file {
    char *path;
    int columns;
    int n;        /* rows; -1: there is no such file, 0: its rows are not such rows */
    double *rows; /* [n][columns] */
};

struct motion_files {
    const char *dir; /* of the case: file names start there; borrowed */
    int n;
    struct motion_file **of;
};

/* An empty list; the caller's, to be freed with motion_files_free. */
struct motion_files *motion_files_create(const char *dir);
void motion_files_free(struct motion_files *all);
/* The file as it was when it was first asked for; it belongs to the list. NULL if all is NULL. */
const struct motion_file *motion_files_read(struct motion_files *all, const char *file,
                                            int columns);
/* A file of that name that was never written: n rows, their times rising; they go over to the list.
 */
void motion_files_add(struct motion_files *all, const char *file, int n, int columns, double *rows);

#endif
