/* forecast.h - estimates how long a run will take, from what `make bench' measured on this machine.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

/* Prints (log_say) the processor time of a run of `steps' steps with `units' units (sph: particles
 * times the neighbours of each, fv: cells) in `dim' dimensions. The figures stand in bench.txt in
 * the folder of the program, rows "PROGRAM DIM SECONDS", the time of one rank for one unit and
 * step; without them built-in figures are used and the line says that they are rough. */
void forecast_say(const char *program, int dim, double units, double steps);
/* Warns of snapshots or restart files so often that they, and not the flow, say how long the steps
 * are: every so many s (0: none), for a run of `end' s that would take `steps' steps without. */
void forecast_warn_outputs(double every, double checkpoint, double end, double steps);
