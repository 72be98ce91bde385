/* files.h - the door of this folder, the one header of it that others include: HDF5 files, their
 * XDMF description, series.csv, tables of figures, room on the disk.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "disk.h"
#include "fit_file.h"
#include "h5.h"
#include "series.h"
#include "table.h"
#include "xdmf.h"
