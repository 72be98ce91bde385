/* scene.h - the door of this folder, the one header of it that others include: what is computed,
 * not how: the groups of a case that every program reads, and what follows from them.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_SCENE_DOOR_H
#define COMMON_SCENE_DOOR_H

#include "body_drive.h"
#include "exact.h"
#include "motion_files.h"
#include "picture.h"
#include "scene_body.h"
#include "scene_check.h"
#include "scene_currents.h"
#include "scene_facts.h"
#include "scene_files.h"
#include "scene_fluid.h"
#include "scene_forms.h"
#include "scene_geometry.h"
#include "scene_groups.h"
#include "scene_lines.h"
#include "scene_mesh.h"
#include "scene_openings.h"
#include "scene_outlines.h"
#include "scene_probe.h"
#include "scene_reference.h"
#include "scene_speed.h"
#include "scene_wave_file.h"
#include "scene_waves.h"
#include "wave_absorber.h"
#include "wave_maker.h"
#include "wave_picture.h"
#include "wave_zones.h"

#endif
