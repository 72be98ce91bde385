/* wave_gauges.h - what groups of level gauges (gauges = ( {...} )) say of waves at the end of a
 * run, from its series.csv: incident and reflected waves, heights, spectra.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_WAVE_GAUGES_H
#define COMMON_WAVE_GAUGES_H

#include "../files/series.h"
#include "../scene/scene.h"

/* Faults: names that are no level gauges, no period, gauges that tell nothing. */
void wave_gauges_check(const struct scene *s, const struct params *p, struct faults *f);
/* Into the summary: reflection.NAME.incident (m), .reflected, .R of a group, height.GAUGE.mean,
 * .significant, .largest, .period, .waves, .spectral (4 sqrt(m0)) of each of its gauges, in a sea
 * that the case makes .error of that against waves.height; DIR/spectrum_NAME.csv. path: of
 * the series. Columns that it lacks (another program of a job has them) are left out. Rank 0. */
void wave_gauges_judge(const struct scene *s, const char *path, const char *dir,
                       struct summary *summary);

#endif
