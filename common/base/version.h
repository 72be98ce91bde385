/* version.h - which version of the code this is. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_VERSION_H
#define COMMON_VERSION_H

extern const char run_version[]; /* "0.1 (9f3c2a1)" */

#endif
