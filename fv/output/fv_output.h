/* fv_output.h - the door of this folder, the one header of it that others include: what a run of
 * fv writes. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "mesh_output.h"
#include "output.h"
