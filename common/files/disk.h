/* disk.h - one wording for files that cannot be written, and checksums that show that a restart
 * file is whole. The functions are local to a rank.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stdbool.h>
#include <stdio.h>

/* Ends the run with RUN_INPUT (fail_with): names the file, the system's reason from errno and
 * whether the disk is full (less than 1 MB free). If path ends in ".part" the unfinished file is
 * removed, which makes room for the failure report. From any rank; does not return. */
_Noreturn void disk_failed(const char *path);
/* Opens a file that is to take the place of `path' when it is complete, so that a reader never
 * finds half of it: PATH.part. disk_failed if it cannot be. The caller hands it to disk_finish. */
FILE *disk_begin(const char *path);
/* Closes the file of disk_begin and gives it its name; disk_failed if what was written is not all
 * there. */
void disk_finish(FILE *f, const char *path);
/* Calls disk_failed if fewer than `bytes' bytes and 64 kB of spare are free where path is. Asked
 * before a collective write: one that fails on a single rank may leave the others waiting inside
 * the library. */
void disk_room(const char *path, double bytes);
/* Appends 16 bytes, a mark and a 64-bit checksum over the length and all bytes before them, to a
 * file that is complete. false: it cannot be read or written. HDF5 takes the length of a file from
 * its own header and ignores what follows. */
bool disk_seal(const char *path);
/* Whether a file ends with the mark and the right checksum: it is not cut short and no bit
 * changed. */
bool disk_sealed(const char *path);
