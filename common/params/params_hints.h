/* params_hints.h - what the parameter table knows about common slips.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_PARAMS_HINTS_H
#define COMMON_PARAMS_HINTS_H

#include <stddef.h>

#include "params.h"

/* Bytes of a row's member. */
size_t param_size(const struct param *r);

/* A group as libconfig text, plain SI; owned by the caller (mem_free). */
char *params_group_text(const struct params *p, const struct param_group *g);

/* The known word with the smallest edit distance to a given one. */
struct hint_nearest {
    const char *word, *best;
    int distance;
};
struct hint_nearest hint_nearest_start(const char *word);
void hint_nearest_try(struct hint_nearest *n, const char *known);
const char *hint_nearest_word(const struct hint_nearest *n); /* NULL if none is near */

/* A name that other codes have for a key, and what to say behind the key. */
struct hint_name {
    const char *word, *key, *remark;
};
/* The next of a word; after: the one before, NULL for the first. NULL: there is none. */
const struct hint_name *hint_name_next(const char *word, const struct hint_name *after);

/* The names of a group's keys, as "a, b, c". */
void hint_keys(const struct param_group *g, char *text, size_t size);

/* Line of a syntax fault (libconfig may name a later one) and a remedy by the looks of it. */
int hint_syntax(const char *text, int line, const char *error, char *hint, size_t size);
/* Why n bytes are no text that can be read; NULL if they may be. */
const char *hint_no_text(const char *text, size_t n);
/* Line of the first integer of ten digits or more without L, copied to word; 0 if there is none. */
int hint_long_integer(const char *text, char *word, size_t size);

#endif
