/* run.h - the door of this folder, the one header of it that others include: the life of a
 * solver program, its gauges, watches, acceptance and forecasts.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "accept.h"
#include "coupling_steps.h"
#include "crossing.h"
#include "forecast.h"
#include "program.h"
#include "solids.h"
#include "watch.h"
