/* checkpoint.c - a restart point exists when its manifest does: written, by rename, when every program has
 * its file of the same window on disk. SPDX-License-Identifier: BSD-3-Clause */
#include "coupler.h"

#include <stdio.h>

#include "../common/log.h"

static void write_manifest(const struct coupler *c)
{
    char path[1100], key[128];
    struct summary *s = summary_create();
    summary_text(s, "case", c->command->case_file);
    summary_int(s, "window", c->save_window);
    summary_real(s, "t", window_start(c, c->save_window + 1));
    snprintf(key, sizeof key, "%016llx", (unsigned long long)c->hash);
    summary_text(s, "case_hash", key);
    for (int i = 0; i < c->nsolvers; i++) {
        snprintf(key, sizeof key, "files.%s", c->solver[i].name);
        summary_text(s, key, c->saved[i]);
    }
    snprintf(path, sizeof path, "%s/manifest.json", c->dir);
    summary_write(s, path);
    summary_free(&s);
    log_say("restart point at t = %.6g s (window %lld)", window_start(c, c->save_window + 1),
            (long long)c->save_window);
}

void checkpoint_saved(struct coupler *c, struct solver *s, struct message *m)
{
    const int i = (int)(s - c->solver);
    if (m->head.tick != c->save_window) {
        log_warn("%s saved window %lld, asked for was %lld: no restart point", s->name,
                 (long long)m->head.tick, (long long)c->save_window);
        return;
    }
    c->nsaved += c->saved[i][0] == '\0';
    take_text(&c->wire, m, c->saved[i], sizeof c->saved[i]);
    if (c->nsaved == c->nsolvers)
        write_manifest(c);
}
