/* transport.h - the door of this folder, the one header of it that others include: what libcpl
 * sends and how it fails: connection, regions, signs of life, failure reports.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "alive.h"
#include "failure.h"
#include "handshake.h"
#include "region.h"
#include "wire.h"
