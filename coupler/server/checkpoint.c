/* checkpoint.c - a restart point exists when its manifest does: written, by rename, when every
 * program has its file of the same coupling step on disk. SPDX-License-Identifier: BSD-3-Clause */
#include "coupler.h"

#include <unistd.h>

/* Two points stay on disk, as for a program that runs alone. */
static void prune(struct coupler *c, const struct save *s)
{
    for (int i = 0; i < c->nsolvers; i++)
        run_prune(c->dir, c->solver[i].name, s->file[i], c->last.file[i]);
    c->last = *s;
}

/* Lines "key value", which common/run/run_files.c reads at a restart. On the disk before it gets
 * its name. */
static void write_manifest(struct coupler *c, const struct save *s)
{
    char path[1100], new[1110];
    snprintf(path, sizeof path, "%s/checkpoint.txt", c->dir);
    snprintf(new, sizeof new, "%s.new", path);
    FILE *f = fopen(new, "w");
    bool good = f != NULL;
    if (f) {
        fprintf(f, "window %lld\n", (long long)s->window);
        fprintf(f, "t %.17g\n", window_start(c, s->window + 1));
        fprintf(f, "case_hash %016llx\n", (unsigned long long)c->hash);
        for (int i = 0; i < c->nsolvers; i++)
            fprintf(f, "%s %s\n", c->solver[i].name, s->file[i]);
        good = fflush(f) == 0 && fsync(fileno(f)) == 0;
        good = fclose(f) == 0 && good;
    }
    if (!good || rename(new, path) != 0) {
        log_warn("cannot write %s: no restart point at t = %.6g s", path,
                 window_start(c, s->window + 1));
        return;
    }
    prune(c, s);
    log_say("  restart point at t = %.6g s", window_start(c, s->window + 1));
}

/* What an earlier part of the run left, so that it goes when two newer points are there. */
void checkpoint_resume(struct coupler *c)
{
    char path[1100], line[600], name[64], file[256];
    snprintf(path, sizeof path, "%s/checkpoint.txt", c->dir);
    FILE *f = fopen(path, "r");
    while (f && fgets(line, sizeof line, f))
        for (int i = 0; i < c->nsolvers && sscanf(line, "%63s %255s", name, file) == 2; i++)
            if (strcmp(name, c->solver[i].name) == 0)
                memcpy(c->last.file[i], file, sizeof file);
    if (f)
        fclose(f);
}

/* Two coupling steps may be saved at once, by tick & 1: a fast program may have ended the next
 * before a slow one has written its file. */
void checkpoint_saved(struct coupler *c, struct solver *s, struct message *m)
{
    const int i = (int)(s - c->solver);
    struct save *const save = &c->save[m->head.tick & 1];
    if (m->head.tick != save->window) {
        log_warn("%s saved coupling step %lld, requested was %lld: no restart point", s->name,
                 (long long)m->head.tick, (long long)save->window);
        return;
    }
    save->n += save->file[i][0] == '\0';
    take_text(&c->wire, m, save->file[i], sizeof save->file[i]);
    if (save->n == c->nsolvers)
        write_manifest(c, save);
}
