/* table.c - CSV files of numbers: see table.h. A row is read in place; the array of all numbers
 * doubles whenever the number of rows is a power of two.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "table.h"

#include "../base/base.h"

static int count_fields(const char *line)
{
    int n = 1;
    for (; *line; line++)
        n += *line == ',';
    return n;
}

/* The next field, without blanks at its ends; *line goes past it. */
static char *next_field(char **line)
{
    char *at = *line, *end = at + strcspn(at, ",\r\n");
    *line = *end == ',' ? end + 1 : end;
    *end = '\0';
    while (end > at && end[-1] == ' ')
        *--end = '\0';
    return at + strspn(at, " ");
}

/* The first line that is no comment: names up to " [", where the unit begins. */
static void read_names(struct table *t, char *line)
{
    t->ncolumns = count_fields(line);
    t->name = NEW_IN(t, char *, t->ncolumns);
    for (int k = 0; k < t->ncolumns; k++) {
        char *field = next_field(&line), *unit = strstr(field, " [");
        if (unit)
            *unit = '\0';
        t->name[k] = NEW_IN(t, char, strlen(field) + 1);
        memcpy(t->name[k], field, strlen(field) + 1);
    }
}

/* A field that is no number, or missing because the line is short, becomes NaN; fields beyond the
 * header's are left out. */
static void read_row(struct table *t, char *line)
{
    const int n = t->ncolumns, at = t->nrows * n;
    if ((t->nrows & (t->nrows - 1)) == 0) /* room doubles */
        GROW_IN(t, t->v, at, (t->nrows ? 2 * t->nrows : 1) * n);
    for (int k = 0; k < n; k++) {
        char *field = next_field(&line), *end;
        t->v[at + k] = strtod(field, &end);
        if (end == field)
            t->v[at + k] = NAN;
    }
    t->nrows++;
}

struct table *table_read(const char *path)
{
    FILE *f = fopen(path, "r");
    if (!f)
        return NULL;
    struct table *t = NEW(struct table, 1);
    char *line = NULL;
    size_t room = 0;
    while (getline(&line, &room, f) > 0) {
        if (line[0] == '#' || line[strspn(line, " \r\n")] == '\0')
            continue;
        if (!t->name)
            read_names(t, line);
        else
            read_row(t, line);
    }
    fclose(f);
    free(line); /* getline's own */
    if (t->nrows == 0)
        DROP(t);
    return t;
}

int table_column(const struct table *t, const char *name)
{
    for (int k = 0; k < t->ncolumns; k++)
        if (strcmp(t->name[k], name) == 0)
            return k;
    return -1;
}
