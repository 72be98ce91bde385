/* job.h - what the coupler itself must know of a job: group `coupler' of its case, and the groups
 * time, domain, output and accept. No solver's part of the case is read: what programs want, they
 * declare (cpl.h). A case with a group sph or fv is a scene that all programs share; the coupler
 * then reads the scene, too, to compare the sums of all programs with its exact solution.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../../common/params/params.h"
#include "../../common/scene/scene.h"
#include "../transport/transport.h"

struct command_line;

enum { JOB_GROUPS = SCENE_GROUPS + 1 };

/* The group coupler of the case. */
struct job {
    char programs[PARAM_TEXT_SIZE]; /* names, by spaces; empty: those whose groups the case has */
    double window, start;           /* s; window 0: as the programs wish */
    double period[3];               /* m; 0: not periodic */
    bool shared;                    /* the case is a scene of sph and fv */
};

/* The tables of all groups that the coupler can read, for --help: groups[JOB_GROUPS]. */
void job_groups(struct job *j, struct scene *s, struct param_group *groups);
/* Reads and checks the case; faults are added to f. who: the programs of this job, whose own groups
 * it may have; NULL: not known (--check). Collective over comm. */
struct params *job_read(struct job *j, struct scene *s, MPI_Comm comm, const struct command_line *l,
                        const struct handshake *who, struct faults *f);
/* Whether the job wants this program: its name is in the list. */
bool job_wants(const struct job *j, const char *program);
/* Copies the next name of a list of names separated by spaces, from *at on, which moves; the name
 * is empty if it is too long. false: there is no more. */
bool job_next_program(const char **at, char name[HANDSHAKE_NAME]);
