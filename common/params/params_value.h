/* params_value.h - reads the value of one row of the parameter table.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_PARAMS_VALUE_H
#define COMMON_PARAMS_VALUE_H

#include <libconfig.h>
#include <stdbool.h>

#include "params.h"

/* A number of any kind, or a text that is an expression (params_let.h); false: it is neither. */
bool param_number(const config_setting_t *s, double *v);
/* Reads a row's value into its member of target; false: why[size] says what is wrong with it. */
bool param_read(const struct param *r, const config_setting_t *s, void *target, char *why,
                size_t size);
/* Fills in the row's default, if it has one. */
void param_default(const struct param_group *g, const struct param *r, void *target);
/* The same of element k of a list. */
void param_default_of(const struct param_group *g, const struct param *r, void *target, int k);

#endif
