/* geometry.h - the door of this folder, the one header of it that others include: bodies,
 * triangle meshes, outlines, their search tree. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "body_math.h"
#include "outline.h"
#include "tree.h"
#include "trimesh.h"
#include "trimesh_check.h"
#include "trimesh_read.h"
