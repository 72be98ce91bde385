/* waves.h - the door of this folder, the one header of it that others include: waves: regular
 * ones, seas, their evolution, their measures. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_WAVES_DOOR_H
#define COMMON_WAVES_DOOR_H

#include "colour.h"
#include "imposed_waves.h"
#include "reflection.h"
#include "sea.h"
#include "second_order.h"
#include "steady.h"
#include "stokes.h"
#include "wave.h"
#include "wave_field.h"
#include "wave_field_save.h"
#include "wave_file.h"
#include "wave_statistics.h"
#include "zone_gain.h"

#endif
