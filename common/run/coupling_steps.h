/* coupling_steps.h - divides the time span of a coupled job into equal coupling steps, and tells
 * which of them end with an output. Pure functions of the case: all programs get the same answer.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stdbool.h>
#include <stdint.h>

/* The span that is divided begins `since' s, >= 0, after an output or the start of the job: 0 but
 * for what a restart leaves to do.
 *
 * Number n of steps of span/n s, none longer than dt, s, > 0, nor than `every', s, the interval of
 * outputs (0 or more than span: the only output is at the end). If some n lets every output fall on
 * the end of a step it is taken, provided that this adds no more steps than there are outputs;
 * otherwise each output comes at the end of the step nearest to its time. Returns 0 where there
 * would be more than 1e15 steps. */
int64_t coupling_steps_number(double span, double since, double every, double dt);
/* Whether the k-th of n steps (from 1) ends with an output; the last one always does. */
bool coupling_steps_output(int64_t n, int64_t k, double span, double since, double every);
/* Largest distance, s, of an output from its nominal time; 0 if all fall on ends of steps. */
double coupling_steps_off(int64_t n, double span, double since, double every);
