/* series.c - rows of series.csv: see series.h. A row goes out as one line at once, so that a run
 * can be watched and a kill loses at most one line. After a restart the file continues: what the
 * first run wrote behind the restart file's time goes, since those steps are computed again.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "series.h"

#include "../base/base.h"
#include "disk.h"

struct series {
    FILE *file; /* NULL on the ranks that do not write */
    char path[1100];
    int ncolumns;
};

/* Keeps the header and the rows up to t of an existing file; they hold t in 12 digits. A row that a
 * kill cut short goes, too. Twelve digits round by up to 5e-12 of t, hence 1e-11. The shorter file
 * takes the place of the old one by rename. */
static void drop_later_rows(const char *path, double t)
{
    char *line = NULL;
    size_t room = 0;
    FILE *in = fopen(path, "r"), *out = disk_begin(path);
    for (bool header = true; in && getline(&line, &room, in) > 0; header = false)
        if (strchr(line, '\n') && (header || atof(line) <= t * (1.0 + 1e-11)))
            fputs(line, out);
    free(line);
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

/* With `keep', but no file of an earlier run, a new one begins. */
struct series *series_create(const char *path, int ncolumns, const char *const *columns, bool keep,
                             double t_restart)
{
    struct series *s = NEW(struct series, 1);
    mem_at_free(s, close_file);
    s->ncolumns = ncolumns;
    require_names(ncolumns, columns);
    if (!path)
        return s;
    FILE *old = keep ? fopen(path, "r") : NULL;
    if (old) {
        fclose(old);
        drop_later_rows(path, t_restart);
    }
    snprintf(s->path, sizeof s->path, "%s", path);
    s->file = fopen(path, old ? "a" : "w");
    if (!s->file)
        disk_failed(path);
    setvbuf(s->file, NULL, _IOLBF, 0);
    for (int k = 0; !old && k < ncolumns; k++)
        fprintf(s->file, "%s%s", columns[k], k < ncolumns - 1 ? "," : "\n");
    if (ferror(s->file))
        disk_failed(path);
    return s;
}

void series_row(struct series *s, const double *values)
{
    for (int k = 0; s->file && k < s->ncolumns; k++)
        fprintf(s->file, "%.12g%s", values[k], k < s->ncolumns - 1 ? "," : "\n");
    if (s->file && ferror(s->file))
        disk_failed(s->path);
}
