/* motion_files.c - see motion_files.h. SPDX-License-Identifier: BSD-3-Clause */
#include "motion_files.h"

#include "../base/base.h"
#include "../params/params.h"

enum { COLUMNS_MAX = 8 };

/* Numbers of a line, separated by blanks, commas or semicolons, up to the first word. */
static int numbers_of(const char *line, double *v)
{
    int got = 0;
    char *end;
    for (const char *at = line; got < COLUMNS_MAX; got++, at = end) {
        at += strspn(at, " ,;\t\r\n");
        v[got] = strtod(at, &end);
        if (end == at)
            break;
    }
    return line[0] == '#' ? 0 : got;
}

/* Stops at the first line that does not fit, and keeps which one for the message; n = 0 then, -1
 * where there is no file. */
static void read_rows(struct motion_file *m)
{
    FILE *f = fopen(m->path, "r");
    char line[512];
    bool sound = true;
    m->n = f ? 0 : -1;
    for (int at = 1; f && sound && fgets(line, sizeof line, f); at++) {
        double v[COLUMNS_MAX];
        const int got = numbers_of(line, v), size = m->columns * m->n;
        if (got == 0)
            continue;
        m->line = at;
        m->got = got;
        sound = got == m->columns && (m->n == 0 || v[0] > m->rows[size - m->columns]);
        if (!sound)
            break;
        ROOM_IN(m, m->rows, size + m->columns);
        memcpy(m->rows + size, v, (size_t)m->columns * sizeof *v);
        m->n++;
    }
    if (f)
        fclose(f);
    if (!sound)
        m->n = 0;
}

struct motion_files *motion_files_create(const char *dir)
{
    struct motion_files *all = NEW(struct motion_files, 1);
    all->dir = dir;
    return all;
}

/* An empty one of that name. */
static struct motion_file *new_file(struct motion_files *all, const char *file, int columns)
{
    struct motion_file *m = NEW_IN(all, struct motion_file, 1);
    const char *path = case_path(all->dir, file);
    m->path = strcpy(NEW_IN(m, char, strlen(path) + 1), path);
    m->columns = columns;
    GROW_IN(all, all->of, all->n, all->n + 1);
    return all->of[all->n++] = m;
}

/* The same file is read once, and with other columns once more: whoever asks later gets the rows of
 * then. */
const struct motion_file *motion_files_read(struct motion_files *all, const char *file, int columns)
{
    if (!all)
        return NULL;
    const char *path = case_path(all->dir, file);
    for (int k = 0; k < all->n; k++)
        if (all->of[k]->columns == columns && strcmp(all->of[k]->path, path) == 0)
            return all->of[k];
    struct motion_file *m = new_file(all, file, columns);
    read_rows(m);
    return m;
}

void motion_file_fault(const struct motion_file *m, const char *row, char *text, size_t size)
{
    char what[64];
    snprintf(what, sizeof what, "line %d has %d number%s", m->line, m->got, m->got > 1 ? "s" : "");
    if (m->n < 0)
        snprintf(text, size, "%s: no such file", m->path);
    else
        snprintf(text, size, "%s: %s: expected rows of %s with increasing times", m->path,
                 m->line == 0           ? "no line has numbers"
                 : m->got != m->columns ? what
                                        : key_text("the time of line %d does not rise", m->line),
                 row);
}

/* Rows that the program makes itself under a name that no file has; they are taken over. */
void motion_files_add(struct motion_files *all, const char *file, int n, int columns, double *rows)
{
    struct motion_file *m = new_file(all, file, columns);
    m->n = n;
    m->rows = rows;
}
