/* scene_currents.h - waves on a uniform current (waves.current) or with a mass transport of their
 * own (waves.closed = false): the upright sides behind zones at both ends of the waves' way are
 * open: what the current and the waves bring at each moment goes through them, uniform over the
 * water, in the mean the same at both, so that the domain keeps its water. That is the current
 * times the depth and, of waves that are not closed, what they carry.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../waves/waves.h"
#include "motion_files.h"
#include "scene_groups.h"

/* Whether water goes through the sides behind zones. */
bool scene_currents_flow(const struct scene *s);
/* Faults: a direction between the axes, an end without a zone, paddles, waves that evolve, water
 * that starts otherwise, groups of gauges. */
void scene_currents_check(const struct scene *s, const struct params *p, struct faults *f);
/* Opens the sides, with what flows through them over the run as files of discharges. */
void scene_currents_resolve(struct scene *s, struct motion_files *files);
/* 1/s: of a zone on still water in which waves stay as long as they do in one of that rate on the
 * current. */
double scene_currents_rate(const struct wave_spec *of, double rate);
/* m/s: along the waves' direction, of what flows through the sides over the still water's depth. */
double scene_currents_mean(const struct scene *s, const struct waves *made);
/* Says the waves' period seen from both frames, where their energy goes, and what flows through the
 * ends; nothing where no water does. */
void scene_currents_describe(const struct scene *s, const struct waves *made);
