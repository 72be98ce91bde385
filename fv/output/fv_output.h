/* fv_output.h - the door of this folder, the one header of it that others include: what a run of
 * fv writes. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_OUTPUT_DOOR_H
#define FV_OUTPUT_DOOR_H

#include "mesh_output.h"
#include "output.h"
#include "report.h"

#endif
