/* fv_watch.h - the door of this folder, the one header of it that others include: limits of the
 * step, and what a sound run keeps small. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "limits.h"
#include "watches.h"
