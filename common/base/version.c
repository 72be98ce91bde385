/* version.c - the only file that is compiled with the version and the commit.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "version.h"

const char run_version[] = VERSION " (" COMMIT ")";
