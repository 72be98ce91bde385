/* key_text.h - short texts put together on the way: keys of lists, names of columns, paths.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stddef.h>

/* The text that printf would write, as "walls.[2].kind", cut off after 2047 bytes. Valid until the
 * eighth call after this one; copy what must live longer. */
const char *key_text(const char *format, ...) __attribute__((format(printf, 1, 2)));
/* The path of a file that a case in the folder `dir' names: beside the case, unless it begins at
 * the root. Valid as that of key_text. */
const char *case_path(const char *dir, const char *file);
/* Appends what printf would write to the text that stands in text[size], cut off where that ends.
 */
void text_add(char *text, size_t size, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
