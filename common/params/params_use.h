/* params_use.h - when a run uses a key, as data of the key's row, and what a run that does not use
 * it is told. A key that a case gives and the run passes over is a fault of the case.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "parameter_table.h"

/* A condition of a row, which all of its conditions must meet. It holds if any of its three parts
 * does: a fact of the run, another key of the same group, a test. Conditions are written with the
 * macros below, and the list of a row with USED(...). */
struct param_use {
    const char *why;          /* reason and remedy where it does not hold; NULL ends the list */
    unsigned long long facts; /* bits, of which the run must have one */
    const char *key;          /* of the group: a choice that must be one of `choices', or given */
    unsigned choices;         /* bits 1 << index; 0: key must be given */
    bool without;             /* key must not be given */
    bool (*test)(const void *context, const void *element); /* the group's struct */
    const char *words; /* the facts or the test in the manual, behind "used with" */
};

/* Conditions at the end of a row: PARAM(P, radius, .., "of a disc", USED(ONLY(form, ..))). */
#define USED(...)                                                                                  \
    .uses = (const struct param_use[])                                                             \
    {                                                                                              \
        __VA_ARGS__, { .why = NULL }                                                               \
    }
#define ONE(choice) (1u << (choice))
/* The choice `k' is one of these: ONLY(form, ONE(SHAPE_BOX), "the form is not box"). */
#define ONLY(k, bits, reason)                                                                      \
    {                                                                                              \
        .key = #k, .choices = (bits), .why = (reason)                                              \
    }
/* The key `k' of the group is given: neither 0, nor empty, nor false. Or it is not. */
#define WITH(k, reason)                                                                            \
    {                                                                                              \
        .key = #k, .why = (reason)                                                                 \
    }
#define WITHOUT(k, reason)                                                                         \
    {                                                                                              \
        .key = #k, .without = true, .why = (reason)                                                \
    }
/* The function says so, and the manual so. */
#define WHERE(function, text, reason)                                                              \
    {                                                                                              \
        .test = (function), .words = (text), .why = (reason)                                       \
    }
/* A fact X is an enumerator FACT_X, its bit, and WORDS_X, a macro of its words. */
#define FACT(x) (1ULL << FACT_##x)
#define NEED(x, reason)                                                                            \
    {                                                                                              \
        .facts = FACT(x), .words = WORDS_##x, .why = (reason)                                      \
    }
#define NEED_ANY(x, y, reason)                                                                     \
    {                                                                                              \
        .facts = FACT(x) | FACT(y), .words = WORDS_##x " or " WORDS_##y, .why = (reason)           \
    }
/* The fact, or the choice. */
#define NEED_OR_ONLY(x, k, bits, reason)                                                           \
    {                                                                                              \
        .facts = FACT(x), .words = WORDS_##x, .key = #k, .choices = (bits), .why = (reason)        \
    }

/* Adds the fault "is not used: WHY" for each key of these groups, and of lists in them, that is
 * given although a condition of its row does not hold; a key that repeats its default is accepted.
 * facts NULL: asks the conditions without facts alone; else those with facts, *facts being what the
 * run has. context: what their tests get. Call on all ranks alike. */
void params_check_use(const struct params *p, const struct param_group *groups, int ngroups,
                      const unsigned long long *facts, const void *context, struct faults *f);
/* Adds a fault for each vector with a third component, in a case of two dimensions. */
void params_check_plane(const struct params *p, const struct param_group *groups, int ngroups,
                        struct faults *f);
/* The conditions of a row in words, "form = disc"; "" if it has none. Static buffer. */
const char *params_use_words(const struct param *rows, int nrows, const struct param *row);
