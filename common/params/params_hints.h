/* params_hints.h - what the parameter table knows about common slips: names of other codes,
 * misspelt words, syntax that libconfig reports in the wrong line. For params*.c; local to rank 0.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stddef.h>
#include <stdio.h>

#include "parameter_table.h"

/* Bytes of a row's member, by its type. */
size_t param_size(const struct param *r);

/* Writes a group as libconfig text in plain SI. */
void params_print_group(FILE *to, const struct params *p, const struct param_group *g);

/* A search for the known word that is nearest to a given one by edit distance, where swapped
 * neighbours count once. Words further away than a third of the letters (at least one) do not
 * count. Texts are borrowed. */
struct hint_nearest {
    const char *word, *best; /* the given one; the nearest so far, NULL: none is near enough */
    int distance;            /* edits between the two */
};
/* A search for `word' that has seen no known word yet. */
struct hint_nearest hint_nearest_start(const char *word);
/* Compares one more known word; the first of equally near ones is kept. */
void hint_nearest_try(struct hint_nearest *n, const char *known);
/* The nearest word tried so far; NULL: none is near. */
const char *hint_nearest_word(const struct hint_nearest *n);

/* What other codes call a key, and a remark to print behind it; key NULL: only the remark. */
struct hint_name {
    const char *word, *key, *remark;
};
/* The next entry for a word after `after' (NULL: the first); NULL: there is no more. Static
 * memory. */
const struct hint_name *hint_name_next(const char *word, const struct hint_name *after);

/* Writes "; did you mean `x'?" to text[size] where one of choices, words between |, is near to a
 * word that is none of them, or is what other codes call so; else nothing. */
void hint_choice(const char *choices, const char *word, char *text, size_t size);

bool hint_has_key(const struct param_group *g, const char *key);
/* The key of a group that an unknown one stands for, and what to say behind it; NULL: none, and the
 * remark, if there is any, why. */
const char *hint_meant(const struct param_group *g, const char *key, const char **remark);
/* Writes the names of a group's keys, "a, b, c", to text[size]; cut if need be. */
void hint_keys(const struct param_group *g, char *text, size_t size);

/* Guesses the true line of a syntax fault that libconfig reports at `line' with the text `error',
 * since it may name a later one; hint[size] gets a remedy that fits what stands there. Returns the
 * line. */
int hint_syntax(const char *text, int line, const char *error, char *hint, size_t size);
/* Why n bytes cannot be read as text (UTF-16, binary); NULL if they may be text. Static memory. */
const char *hint_no_text(const char *text, size_t n);
/* Line of the first integer of ten digits or more without L, which libconfig would wrap, copied to
 * word[size]; 0 if there is none. */
int hint_long_integer(const char *text, char *word, size_t size);
