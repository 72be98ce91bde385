/* key_text.c - see key_text.h. SPDX-License-Identifier: BSD-3-Clause */
#include "key_text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

const char *key_text(const char *format, ...)
{
    static char text[8][2048];
    static int turn;
    char *to = text[turn];
    turn = (turn + 1) % 8;
    va_list args;
    va_start(args, format);
    vsnprintf(to, sizeof text[0], format, args);
    va_end(args);
    return to;
}

const char *case_path(const char *dir, const char *file)
{
    return *file == '/' || !*dir ? key_text("%s", file) : key_text("%s/%s", dir, file);
}

void text_add(char *text, size_t size, const char *format, ...)
{
    const size_t n = strlen(text);
    va_list args;
    va_start(args, format);
    vsnprintf(text + n, size - n, format, args);
    va_end(args);
}
