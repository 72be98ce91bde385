/* discharge_gauges.h - the volumes that went through discharge gauges over a run: what overtops a
 * wall goes through a line over its crest. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_DISCHARGE_GAUGES_H
#define COMMON_DISCHARGE_GAUGES_H

#include "../files/series.h"
#include "../scene/scene.h"
#include "run.h"

/* From the columns of series.csv into the log and summary.json: discharge.NAME.volume (net),
 * .forward, .back (m^dim) and .largest (m^dim/s). */
void discharge_gauges_judge(const struct scene *s, const char *path, struct summary *summary);

#endif
