/* params_override.h - what the command line gives of a case: -p GROUP.KEY=VALUE, or a list or group
 * as a whole, 'accept=()'. For params*.c; local to rank 0.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <libconfig.h>

#include "parameter_table.h"

/* One -p of the command line, taken apart. */
struct override {
    const char *text; /* as given: "sph.dx=0.02"; borrowed */
    /* Of sph.dx: "sph" and "dx"; of an element of a list: "walls" and "[0].kind"; of a whole:
     * "walls", "". */
    char group[64], key[64];
    config_t cfg; /* holds the value as setting "value" */
    bool known;   /* this program has its group, though perhaps not its element */
    bool used;    /* its value was taken; one that is not used is a fault */
};

/* Takes text (borrowed) apart. VALUE is libconfig text; a plain word is taken as text, 64x64 as the
 * vector (64, 64). Faults go to f. */
void override_read(struct override *o, const char *text, struct faults *f);
/* If the override is a list or group as a whole, puts a copy of it into cfg in place of the
 * case's. */
void override_graft(struct override *o, config_t *cfg, struct faults *f);
