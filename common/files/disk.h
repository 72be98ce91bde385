/* disk.h - what is said when a file cannot be written, and the sums that show that a file is whole.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_DISK_H
#define COMMON_DISK_H

#include <stdbool.h>

/* Ends the run as one whose input is at fault: what could not be written, the system's reason, and
 * what is free where it should go. From any rank. */
_Noreturn void disk_failed(const char *path);
/* disk_failed if there is no room for so many bytes and some more: a collective write that fails on
 * one rank may leave the others waiting in the library. */
void disk_room(const char *path, double bytes);
/* Appends a sum over all bytes of a file that is complete; false: it cannot be written. HDF5 reads
 * what its own header counts and passes over the rest. */
bool disk_seal(const char *path);
/* Whether a file ends with the sum over its other bytes: not cut short, no bit changed. */
bool disk_sealed(const char *path);

#endif
