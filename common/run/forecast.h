/* forecast.h - how long a run will take, from what `make bench' measured on this machine.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_FORECAST_H
#define COMMON_FORECAST_H

/* Says the processor time of a run of `steps' steps of `units' units (sph: particles times the
 * pairs of each, fv: cells) in `dim' dimensions. The figures stand beside the programs in
 * bench.txt, rows "PROGRAM DIM SECONDS", for a unit and step of one rank; without them it takes
 * figures of another machine and says that they are rough. */
void forecast_say(const char *program, int dim, double units, double steps);

#endif
