/* handshake.h - finds out who is in this job: every rank sends every other its program's name,
 * within a deadline; then there are one communicator per program and one intercommunicator per
 * solver with "coupler". Part of libcpl.a: depends on MPI alone.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <mpi.h>

/* Bytes of a program's name, most programs of a job, bytes of what is wrong. */
enum { HANDSHAKE_NAME = 64, HANDSHAKE_PROGRAMS = 32, HANDSHAKE_TEXT = 2048 };

/* The programs of the job, the same on all ranks but for `me', `mine' and `inter'. */
struct handshake {
    int nprograms; /* in the order of their names, so that places in mpirun do not matter */
    struct handshake_program {
        char name[HANDSHAKE_NAME];
        int size;       /* its ranks */
        int leader;     /* world rank of its rank 0 */
        MPI_Comm inter; /* to it: solver with coupler and coupler with solver, else MPI_COMM_NULL */
    } program[HANDSHAKE_PROGRAMS];
    int me, coupler;           /* index into program; coupler -1: none */
    MPI_Comm mine;             /* this program's ranks */
    char text[HANDSHAKE_TEXT]; /* what is wrong; "": nothing */
};

/* Collective over world. version: CPL_VERSION that this program was compiled with. Returns 0, or -2
 * if the programs do not make a job (h->text, the same on all). Ranks that are silent at the
 * deadline, and programs of other versions, end the job with code 2: MPI cannot be finalized
 * without them. */
int handshake(MPI_Comm world, const char *name, double deadline_s, int version,
              struct handshake *h);
