/* params_override.h - what the command line gives of a case: -p GROUP.KEY=VALUE, or a list or group
 * as a whole. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_PARAMS_OVERRIDE_H
#define COMMON_PARAMS_OVERRIDE_H

#include <libconfig.h>

#include "params.h"

struct override {
    const char *text;        /* as given: "sph.dx=0.02"; borrowed */
    char group[64], key[64]; /* of an element of a list: "walls", "[0].kind"; of all: "walls", "" */
    config_t cfg;            /* holds the value as setting "value" */
    bool known;              /* this program has its group, though perhaps not its element */
    bool used;
};

/* Takes text apart; what is wrong with it goes to f. */
void override_read(struct override *o, const char *text, struct faults *f);
/* A list or group that is given as a whole takes the place of the case's in cfg. */
void override_graft(struct override *o, config_t *cfg, struct faults *f);

#endif
