/* base.h - the door of this folder, the one header of it that others include: what everything
 * stands on: memory, the log, exit codes, timers, small vectors, sums over ranks, the text of
 * figures, and the C library that every source may use. State and doors bring it: a source names
 * it where nothing else does.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <math.h>
#include <mpi.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "digits.h"
#include "exit.h"
#include "fit.h"
#include "inline.h"
#include "key_text.h"
#include "lanes.h"
#include "log.h"
#include "lookup.h"
#include "mem.h"
#include "ranks.h"
#include "timer.h"
#include "vec3.h"
#include "version.h"
