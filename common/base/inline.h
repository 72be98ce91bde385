/* inline.h - functions that are compiled into each caller.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

/* A function whose callers tell its forms (dimension, scheme) by constants, so that the compiler
 * drops from each form what it has not. Under the sanitizers one form is told by values: all forms
 * would take the compiler ten times as long, and have the same lines. */
#ifdef __SANITIZE_ADDRESS__
#define INLINE static inline
#else
#define INLINE static inline __attribute__((always_inline))
#endif
