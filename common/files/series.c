/* series.c - rows of series.csv: see series.h. A row goes out as one line at once, so that a run
 * can be watched and a kill loses at most one line. After a restart the file continues: what the
 * first run wrote behind the restart file's time goes, since those steps are computed again.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "series.h"

#include <stdarg.h>

#include "../base/base.h"
#include "disk.h"

void figures_add(struct figures *r, double v, const char *title, ...)
{
    char text[512];
    va_list args;
    va_start(args, title);
    if (r->measures) {
        ROOM_IN(r, r->value, r->n + 1);
        r->value[r->n++] = v;
    } else {
        ROOM_IN(r, r->title, r->n + 1);
        vsnprintf(text, sizeof text, title, args);
        r->title[r->n++] = strcpy(NEW_IN(r, char, strlen(text) + 1), text);
    }
    va_end(args);
}

struct series {
    FILE *file; /* NULL on the ranks that do not write */
    char path[1100];
    int ncolumns;
    char last[32]; /* time of the last row of the earlier run, as it stands there; "": none */
};

/* The k-th field of a line, of that length; NULL: the line has fewer. */
static const char *field_of(const char *line, int k, int *length)
{
    for (; line && k > 0; k--) {
        line = strchr(line, ',');
        line += line != NULL;
    }
    *length = line ? (int)strcspn(line, ",\r\n") : 0;
    return line;
}

/* The field of a header that has this name; -1: none. */
static int find_field(const char *header, const char *name)
{
    const size_t n = strlen(name);
    int length;
    const char *at;
    for (int k = 0; (at = field_of(header, k, &length)); k++)
        if (n == (size_t)length && strncmp(at, name, n) == 0)
            return k;
    return -1;
}

static void write_header(FILE *f, int n, const char *const *columns)
{
    for (int k = 0; k < n; k++)
        fprintf(f, "%s%s", columns[k], k < n - 1 ? "," : "\n");
}

/* A row of the earlier run, from[k] its field in column k; nan: it had none. */
static void write_earlier(FILE *f, const char *line, int n, const int *from)
{
    for (int k = 0; k < n; k++) {
        int length = 3;
        const char *at = from[k] >= 0 ? field_of(line, from[k], &length) : "nan";
        fprintf(f, "%.*s%s", length, at ? at : "", k < n - 1 ? "," : "\n");
    }
}

/* The earlier values of a column that this run has no more would be lost: where the header has more
 * than the `kept' ones the old file stays under another name. */
static void keep_dropped(const char *path, double t, const char *header, int kept)
{
    char to[1200];
    int length;
    snprintf(to, sizeof to, "%s.before-%g", path, t);
    if (field_of(header, kept, &length) && rename(path, to) == 0)
        log_warn("%s had columns that this run does not write: it is kept as %s", path, to);
}

/* Keeps the rows up to t of an existing file, which hold t in 12 digits, under the columns of this
 * run: a case may have other gauges after a restart. A row that a kill cut short goes, too. Twelve
 * digits round by up to 5e-12 of t, hence 1e-11. The shorter file takes the place of the old one by
 * rename. last[size]: the time of the last one that is kept. */
static void drop_later_rows(const char *path, double t, int n, const char *const *columns,
                            char *last, size_t size)
{
    char *line = NULL;
    size_t room = 0;
    int *from = NEW(int, n), kept = 0;
    FILE *in = fopen(path, "r"), *out = disk_begin(path);
    write_header(out, n, columns);
    if (in && getline(&line, &room, in) > 0) {
        for (int k = 0; k < n; k++) {
            from[k] = find_field(line, columns[k]);
            kept += from[k] >= 0;
        }
        keep_dropped(path, t, line, kept);
    }
    while (in && getline(&line, &room, in) > 0)
        if (strchr(line, '\n') && atof(line) <= t * (1.0 + 1e-11)) {
            write_earlier(out, line, n, from);
            snprintf(last, size, "%.*s", (int)strcspn(line, ",\r\n"), line);
        }
    free(line);
    mem_free(from);
    if (in)
        fclose(in);
    disk_finish(out, path);
}

/* Who reads columns by their names finds each of them. */
static void require_names(int n, const char *const *columns)
{
    for (int k = 0; k < n; k++)
        for (int i = 0; i < k; i++)
            if (strcmp(columns[i], columns[k]) == 0)
                abort_run("series.csv has two columns `%s'", columns[k]);
}

static void close_file(void *p)
{
    const struct series *s = p;
    if (s->file)
        fclose(s->file);
}

/* The title of a column, owned by `owner': what is of the whole flow is in the plane per metre of
 * depth. */
static const char *title_of(void *owner, const char *column, int dim)
{
    static const char *const whole[][3] = {{"[J]", "[J/m]", "[J]"},
                                           {"[kg]", "[kg/m]", "[kg]"},
                                           {"[kg m/s]", "[N s/m]", "[kg m/s]"},
                                           {"[m^dim]", "[m^2]", "[m^3]"},
                                           {"[m^dim/s^2]", "[m^2/s^2]", "[m^3/s^2]"}};
    const char *unit = strrchr(column, '[');
    for (size_t k = 0; unit && k < sizeof whole / sizeof whole[0]; k++)
        if (strcmp(unit, whole[k][0]) == 0) {
            const size_t size = strlen(column) + 8;
            char *title = mem_new_in(owner, size, 1);
            snprintf(title, size, "%.*s%s", (int)(unit - column), column, whole[k][dim - 1]);
            return title;
        }
    return column;
}

/* With `keep', but no file of an earlier run, a new one begins. */
struct series *series_create(const char *path, int dim, int ncolumns, const char *const *columns,
                             bool keep, double t_restart)
{
    struct series *s = NEW(struct series, 1);
    mem_at_free(s, close_file);
    s->ncolumns = ncolumns;
    require_names(ncolumns, columns);
    if (!path)
        return s;
    const char **titles = mem_new_in(s, (size_t)ncolumns, sizeof *titles);
    for (int k = 0; k < ncolumns; k++)
        titles[k] = title_of(s, columns[k], dim);
    FILE *old = keep ? fopen(path, "r") : NULL;
    if (old) {
        fclose(old);
        drop_later_rows(path, t_restart, ncolumns, titles, s->last, sizeof s->last);
    }
    snprintf(s->path, sizeof s->path, "%s", path);
    s->file = fopen(path, old ? "a" : "w");
    if (!s->file)
        disk_failed(path);
    setvbuf(s->file, NULL, _IOLBF, 0);
    if (!old)
        write_header(s->file, ncolumns, titles);
    if (ferror(s->file))
        disk_failed(path);
    return s;
}

/* What restarts where the earlier run ended has that row already. */
void series_row(struct series *s, const double *values)
{
    char t[32];
    snprintf(t, sizeof t, "%.12g", values[0]);
    const bool known = strcmp(t, s->last) == 0;
    s->last[0] = '\0';
    if (known)
        return;
    for (int k = 0; s->file && k < s->ncolumns; k++)
        fprintf(s->file, "%.12g%s", values[k], k < s->ncolumns - 1 ? "," : "\n");
    if (s->file && ferror(s->file))
        disk_failed(s->path);
}
