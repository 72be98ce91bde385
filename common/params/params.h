/* params.h - the door of this folder, the one header of it that others include: case files: rows
 * of keys, what a run uses of them, hints. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "parameter_table.h"
#include "params_hints.h"
#include "params_use.h"
