/* base.h - the door of this folder, the one header of it that others include: what everything
 * stands on: memory, the log, exit codes, timers, small vectors, sums over ranks and the text of
 * figures.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_BASE_DOOR_H
#define COMMON_BASE_DOOR_H

#include "digits.h"
#include "exit.h"
#include "fit.h"
#include "key_text.h"
#include "lanes.h"
#include "log.h"
#include "lookup.h"
#include "mem.h"
#include "ranks.h"
#include "timer.h"
#include "vec3.h"
#include "version.h"

#endif
