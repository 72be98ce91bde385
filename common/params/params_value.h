/* params_value.h - reads the value of one row of the parameter table. For params*.c.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <libconfig.h>
#include <stdbool.h>

#include "parameter_table.h"

/* Sets *v to a number of any kind, or to the value of a text that is an expression (params_let.h);
 * false: the setting is neither. */
bool param_number(const config_setting_t *s, double *v);
/* Writes v to text[32] with the fewest digits, 15 to 17, that read as the same number: 0.04.
 * Returns text. */
const char *param_real(double v, char text[32]);
/* Where a fault of `name' stands, for its message: the setting's file and line ("path" if libconfig
 * names no file), "command line", or the path alone where s is NULL. place[size] is cut. */
void param_place(const config_setting_t *s, const char *path, const char *name, char *place,
                 size_t size);
/* Reads a row's value into its member of `target', the group's struct, and checks its range. false:
 * why[size] says what is wrong and what is expected. Not for PARAM_LIST. */
bool param_read(const struct param *r, const config_setting_t *s, void *target, char *why,
                size_t size);
/* Sets the member to the row's default, without a check of the range, and all elements of a list to
 * theirs; a row without default leaves the member alone. A default that cannot be read is an error
 * of the code, abort_run(). */
void param_default(const struct param_group *g, const struct param *r, void *target);
/* The same for element k (from 0) of a list of groups: `#' at the end of a text becomes the number
 * k + 1, or nothing in the first element. */
void param_default_of(const struct param_group *g, const struct param *r, void *target, int k);
