/* wave_gauges.h - evaluates groups of level gauges (gauges = ( {...} )) at the end of a run from
 * its series.csv: incident and reflected waves, heights, spectra.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../files/files.h"
#include "../scene/scene.h"

/* Adds a fault for names that are no level gauges, groups of fewer than two, gauges that move with
 * a body or of which a partner reads some (elsewhere, of each probe), an unknown depth or period,
 * and less than two periods of evaluation; warns of distances that do not separate the two
 * waves. */
void wave_gauges_check(const struct scene *s, const bool *elsewhere, const struct params *p,
                       struct faults *f);
/* Reads the series at `path' and writes to the summary, of each group: reflection.NAME.incident
 * (m), .reflected (m), .R; of each of its gauges: height.GAUGE.mean, .significant, .largest,
 * .period, .waves, .spectral (4 sqrt(m0)), and in a sea that the case makes .error of the latter
 * against waves.height. Writes DIR/spectrum_NAME.csv. Columns that the series lacks, since another
 * program of the job has them, are left out. Rank 0. */
void wave_gauges_judge(const struct scene *s, const char *path, const char *dir,
                       struct summary *summary);
