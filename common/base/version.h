/* version.h - which version of the code this is, for --version, logs and files.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

/* "0.1 (9f3c2a1)": release and commit, set by the Makefile when version.c is compiled. */
extern const char run_version[];
