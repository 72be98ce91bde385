/* params_let.h - numbers of a case by expressions, and the variables that these name. `let: { H =
 * 0.3; dx = "H/30"; };' defines variables, each by a number or by an expression of those above it;
 * wherever the case or the command line gives a number, a text in quotes may stand for it. For
 * params*.c; local to rank 0.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <libconfig.h>
#include <stdbool.h>
#include <stdio.h>

#include "parameter_table.h"
#include "params_override.h"

struct let; /* the variables of a case: made by let_read, freed by let_free */

/* Reads the group `let' of cfg (read from `path', borrowed) and what the command line gives of it,
 * then computes all texts of cfg and of the overrides that are expressions; the values hang on the
 * settings, see let_value. Only faults of variables go to f, for another text that is no expression
 * may be meant as a text. Never NULL; freed by let_free. */
struct let *let_read(config_t *cfg, const char *path, struct override *o, int noverrides,
                     struct faults *f);
void let_free(struct let **l);
/* Sets *v to the value of a setting whose text is an expression. false: it is none; *why, if
 * wanted, says why not, or is NULL for a setting that is no text. Valid once let_read has seen the
 * setting; *why is borrowed from it. */
bool let_value(const config_setting_t *s, double *v, const char **why);
/* Writes the variables and their values as a comment of a case, "# let: H = 0.3"; nothing if there
 * are none or l is NULL. */
void let_print(FILE *to, const struct let *l);
