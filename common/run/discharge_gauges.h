/* discharge_gauges.h - the volumes that went through discharge gauges in a run. The overtopping of
 * a wall, for example, is what goes through a gauge above its crest.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../files/files.h"
#include "../scene/scene.h"
#include "program.h"

/* Integrates the columns of the series at `path' in time, linear between rows, or (means) of rows
 * that are means over the time since the row before, and reports to log and summary:
 * discharge.NAME.volume (net), .forward, .back (m^dim, both positive) and .largest (magnitude,
 * m^dim/s). Columns that the series lacks are left out. Rank 0. */
void discharge_gauges_judge(const struct scene *s, bool means, const char *path,
                            struct summary *summary);
