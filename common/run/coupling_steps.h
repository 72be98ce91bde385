/* coupling_steps.h - how many equal coupling steps a job takes, and which of them end with an
 * output. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_COUPLING_STEPS_H
#define COMMON_COUPLING_STEPS_H

#include <stdbool.h>
#include <stdint.h>

/* Steps of span/n s, none longer than dt (s, > 0) or than every (s, between outputs; 0 or more than
 * span: the end alone). Where some n gives all outputs the end of a step it is taken, as long as
 * the outputs then add no more steps than there are outputs; else each output comes at the end of
 * the step next to its time. Returns 0 where there would be more than 1e15 steps. */
int64_t coupling_steps_number(double span, double every, double dt);
/* Whether the k-th of n steps (from 1) ends with an output; the last one does. */
bool coupling_steps_output(int64_t n, int64_t k, double span, double every);
/* s: how far an output can lie from its own time, at most. */
double coupling_steps_off(int64_t n, double span, double every);

#endif
