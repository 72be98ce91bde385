/* params.c - reads a case through the parameter table: rank 0 parses, all ranks get the bytes.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "parameter_table.h"

#include <ctype.h>
#include <libconfig.h>
#include <stdarg.h>

#include "../base/base.h"
#include "params_hints.h"
#include "params_let.h"
#include "params_override.h"
#include "params_value.h"

enum { NAMES_SIZE = 2048, GIVEN_SIZE = 64 };

struct params {
    char path[1024];
    int rank, ngroups, noverrides;
    const struct param_group *groups; /* borrowed */
    bool read;                        /* rank 0: cfg holds a case */
    config_t cfg;
    struct override *overrides;
    struct let *let; /* rank 0: variables of the case */
    unsigned long long hash;
    char kind[64], as[64];  /* keys of group `kind' are those of group `as'; "": none */
    char names[NAMES_SIZE]; /* " sph fv ": groups the case has, the same on all ranks */
    /* " sph.dx walls.[0].kind ": keys with values, the same on all ranks; again as "sph.dx=" where
     * the value is the default, as "sph.dx!" where it comes from the command line. */
    char *given;
};

/* --- faults --- */

/* text: owned, NULL for none yet. */
static void append(char **text, const char *more)
{
    const size_t old = *text ? strlen(*text) : 0, n = strlen(more) + 1;
    *text = mem_grow(*text, old, old + n, 1);
    memcpy(*text + old, more, n);
}

static void add_fault(struct faults *f, const char *place, const char *fmt, va_list args)
{
    char what[1024];
    vsnprintf(what, sizeof what, fmt, args);
    append(&f->text, place);
    append(&f->text, ": ");
    append(&f->text, what);
    append(&f->text, "\n");
    f->n++;
}

void params_add_fault(struct faults *f, const char *place, const char *fmt, ...)
{
    va_list args;
    va_start(args, fmt);
    add_fault(f, place, fmt, args);
    va_end(args);
}

int params_report(const struct faults *f)
{
    if (f->n > 0 && f->text)
        log_say("%s%d fault%s; nothing was started. --help KEY explains a key.", f->text, f->n,
                f->n == 1 ? "" : "s");
    return f->n;
}

/* --- the file --- */

/* The bytes of a file and a 0 behind them; n (may be NULL): their number. */
static char *read_text(const char *path, size_t *bytes)
{
    FILE *f = fopen(path, "rb");
    if (!f)
        return NULL;
    size_t n = 0, room = 4096, got;
    char *text = mem_new(room, 1);
    while ((got = fread(text + n, 1, room - n - 1, f)) > 0) {
        n += got;
        if (room - n < 2) {
            text = mem_grow(text, n, 2 * room, 1);
            room *= 2;
        }
    }
    fclose(f);
    text[n] = '\0';
    if (bytes)
        *bytes = n;
    return text;
}

/* Some editors begin a file with a mark of UTF-8, which libconfig takes for a value. */
static bool has_mark(const char *text) { return strncmp(text, "\xef\xbb\xbf", 3) == 0; }

/* FNV-1a, 64 bits (Fowler, Noll & Vo). */
static unsigned long long fnv(unsigned long long h, const char *s)
{
    for (; *s; s++)
        h = (h ^ (unsigned char)*s) * 1099511628211ULL;
    return h;
}

/* Hash of a setting and all below it: names, kinds and values, whatever file they stand in. */
static unsigned long long hash_of(unsigned long long h, const config_setting_t *s)
{
    char text[64] = "";
    const char *name = config_setting_name(s), *word = config_setting_get_string(s);
    double v;
    if (param_number(s, &v))
        snprintf(text, sizeof text, "%.17g", v);
    else if (config_setting_type(s) == CONFIG_TYPE_BOOL)
        snprintf(text, sizeof text, config_setting_get_bool(s) ? "true" : "false");
    h = fnv(fnv(fnv(fnv(h, name ? name : ""), "="), text), word ? word : "");
    for (int k = 0; config_setting_is_aggregate(s) && k < config_setting_length(s); k++)
        h = fnv(hash_of(h, config_setting_get_elem(s, (unsigned)k)), ",");
    return fnv(h, ";");
}

/* Opens the case; syntax faults end the reading, with a hint from the line at fault. */
static void read_file(struct params *p, struct faults *f)
{
    size_t bytes = 0;
    char *text = read_text(p->path, &bytes), dir[1024], place[1300];
    if (!text) {
        params_add_fault(f, p->path, "no such case file, or it cannot be read");
        return;
    }
    const char *no_text = hint_no_text(text, bytes);
    if (no_text) {
        params_add_fault(f, p->path, "%s", no_text);
        mem_free(text);
        return;
    }
    snprintf(dir, sizeof dir, "%s", p->path);
    char *slash = strrchr(dir, '/');
    if (slash)
        *slash = '\0';
    config_set_include_dir(&p->cfg, slash ? dir : ".");
    config_set_auto_convert(&p->cfg, CONFIG_TRUE);
    char number[64];
    const int large = hint_long_integer(text, number, sizeof number);
    if (large > 0) { /* libconfig would wrap it silently */
        snprintf(place, sizeof place, "%s:%d", p->path, large);
        params_add_fault(f, place,
                         "%s is too large for an integer; with an L behind it, it is read whole",
                         number);
    }
    if ((has_mark(text) ? config_read_string(&p->cfg, text + 3)
                        : config_read_file(&p->cfg, p->path)) == CONFIG_TRUE) {
        p->read = true;
        p->hash = hash_of(1469598103934665603ULL, config_root_setting(&p->cfg));
    } else {
        const char *in = config_error_file(&p->cfg) ? config_error_file(&p->cfg) : p->path;
        char hint[512];
        char *included = strcmp(in, p->path) ? read_text(in, NULL) : NULL;
        const int line = hint_syntax(included ? included : text, config_error_line(&p->cfg),
                                     config_error_text(&p->cfg), hint, sizeof hint);
        mem_free(included);
        snprintf(place, sizeof place, "%s:%d", in, line);
        params_add_fault(f, place, "%s%s%s", config_error_text(&p->cfg), *hint ? ": " : "", hint);
    }
    mem_free(text);
}

/* --- groups --- */

static void place_of(const struct params *p, const config_setting_t *s, char *place, size_t size,
                     const char *group, const char *key)
{
    param_place(s, p->path, key_text("%s%s%s", group, *key ? "." : "", key), place, size);
}

/* The name of a key of a group, or of an element of a list (element >= 0); see key_text. */
static const char *name_of(const char *group, int element, const char *key)
{
    return element < 0 ? key_text("%s.%s", group, key)
                       : key_text("%s.[%d].%s", group, element, key);
}

/* What the command line gives for a key of a group, or of an element of a list (element >= 0). */
static struct override *override_of(struct params *p, const char *group, int element,
                                    const char *key)
{
    struct override *found = NULL;
    char whole[256];
    snprintf(whole, sizeof whole, "%s", name_of(group, element, key));
    for (int k = 0; k < p->noverrides; k++) {
        if (strcmp(key_text("%s.%s", p->overrides[k].group, p->overrides[k].key), whole) == 0) {
            found = p->overrides + k; /* the last one counts */
            found->used = true;
        }
    }
    return found;
}

/* mark: "", "=" or "!", see struct params. */
static void mark_given(struct params *p, const char *group, int element, const char *key,
                       const char *mark)
{
    append(&p->given, key_text("%s%s ", name_of(group, element, key), mark));
}

static bool same_value(const struct param *r, const void *a, const void *b)
{
    return r->type == PARAM_TEXT ? strcmp(a, b) == 0 : memcmp(a, b, param_size(r)) == 0;
}

/* A name that series.csv can have in its first line. */
static bool heads_columns(const char *name) { return *name && !strpbrk(name, ",;\"\t\n\r"); }

static void read_inner(struct params *p, const char *path, const struct param *r,
                       const config_setting_t *s, void *target, struct faults *f);

/* Whether a group has the key under a wrong name: one fault, not two. */
static bool is_misspelt(const struct param_group *g, const config_setting_t *group, const char *key)
{
    for (int k = 0; group && k < config_setting_length(group); k++) {
        const char *name = config_setting_name(config_setting_get_elem(group, (unsigned)k));
        if (!name || hint_has_key(g, name))
            continue;
        const char *remark, *meant = hint_meant(g, name, &remark);
        bool same = meant && strcmp(meant, key) == 0;
        for (const struct hint_name *n = hint_name_next(name, NULL); n; n = hint_name_next(name, n))
            same = same || (n->key && strcmp(n->key, key) == 0);
        if (same)
            return true;
    }
    return false;
}

/* element: of a list; -1: a plain group. The command line may give keys of both. */
static void read_row(struct params *p, const struct param_group *g, const struct param *r,
                     const config_setting_t *group, void *target, int element, struct faults *f)
{
    char place[1300], why[512];
    const struct override *o = override_of(p, g->name, element, r->key);
    const config_setting_t *s = o ? config_lookup(&o->cfg, "value")
                                  : (group ? config_setting_get_member(group, r->key) : NULL);
    if (o && !s)
        return; /* its fault is known */
    if (o)
        snprintf(place, sizeof place, "command line: -p %s: %s.%s", o->text, o->group, o->key);
    else
        place_of(p, s ? s : group, place, sizeof place, g->name, r->key);
    if (!s) {
        if (!r->dflt && r->type != PARAM_LIST && (group || params_has_group(p, g->name)) &&
            !is_misspelt(g, group, r->key))
            params_add_fault(f, place, "must be given: %s%s%s", r->help,
                             strcmp(r->unit, "-") ? ", in " : "",
                             strcmp(r->unit, "-") ? r->unit : "");
        return;
    }
    mark_given(p, g->name, element, r->key, "");
    if (o)
        mark_given(p, g->name, element, r->key, "!");
    if (r->type == PARAM_LIST) {
        char path[160];
        snprintf(path, sizeof path, "%s", name_of(g->name, element, r->key));
        read_inner(p, path, r, s, target, f);
        return;
    }
    char *before = mem_new(param_size(r), 1);
    memcpy(before, (char *)target + r->offset, param_size(r));
    if (!param_read(r, s, target, why, sizeof why))
        params_add_fault(f, place, "%s", why);
    else if (element >= 0 && strcmp(r->key, "name") == 0 && r->type == PARAM_TEXT &&
             !heads_columns((char *)target + r->offset))
        params_add_fault(
            f, place,
            "a name heads columns of series.csv: a word or two, without commas, semicolons and "
            "quotes");
    else if (r->dflt && same_value(r, before, (char *)target + r->offset))
        mark_given(p, g->name, element, r->key, "=");
    mem_free(before);
}

/* The only group that has such a key; NULL if none has, or several. */
static const struct param_group *group_with(const struct params *p, const char *key)
{
    const struct param_group *home = NULL;
    for (int k = 0; k < p->ngroups; k++)
        if (hint_has_key(p->groups + k, key)) {
            if (home)
                return NULL;
            home = p->groups + k;
        }
    return home;
}

/* Tells which key of the group an unknown one stands for, or why there is none; false: no idea. */
static bool tell_meant(struct faults *f, const char *place, const struct param_group *g,
                       const char *key)
{
    const char *remark, *near = hint_meant(g, key, &remark);
    if (near)
        params_add_fault(f, place, "unknown key; did you mean `%s'%s?", near, remark);
    else if (*remark)
        params_add_fault(f, place, "unknown key; %s", remark);
    return near || *remark;
}

/* In this order: a slip of the pen, a key of another group, else all that there are. */
static void find_unknown_keys(const struct params *p, const struct param_group *g,
                              const config_setting_t *group, struct faults *f)
{
    char place[1300], keys[1024];
    hint_keys(g, keys, sizeof keys);
    for (int k = 0; k < config_setting_length(group); k++) {
        const config_setting_t *s = config_setting_get_elem(group, (unsigned)k);
        const char *key = config_setting_name(s);
        if (!key || hint_has_key(g, key))
            continue;
        place_of(p, s, place, sizeof place, g->name, key);
        const struct param_group *home = group_with(p, key);
        if (tell_meant(f, place, g, key))
            continue;
        if (home)
            params_add_fault(f, place, "unknown key; it is known in group `%s'", home->name);
        else
            params_add_fault(f, place, "unknown key; there are %s", keys);
    }
}

/* s NULL: the case has no such group; its rows may come from the command line. */
static void read_plain(struct params *p, const struct param_group *g, const config_setting_t *s,
                       struct faults *f)
{
    char place[1300];
    if (s && !config_setting_is_group(s)) {
        place_of(p, s, place, sizeof place, g->name, "");
        params_add_fault(f, place, "expected a group { ... }");
        return;
    }
    for (int k = 0; k < g->nrows; k++)
        read_row(p, g, g->rows + k, s, g->target, -1, f);
    if (s)
        find_unknown_keys(p, g, s, f);
}

/* Elements after one at fault are read, too, so that all faults are told at once. */
static void read_list(struct params *p, const struct param_group *g, const config_setting_t *s,
                      struct faults *f)
{
    char place[1300];
    *g->count = 0;
    if (!s)
        return;
    if (!config_setting_is_list(s) || config_setting_length(s) > g->max) {
        place_of(p, s, place, sizeof place, g->name, "");
        params_add_fault(f, place, "expected a list ( { ... }, { ... } ) of at most %d groups",
                         g->max);
        return;
    }
    for (int k = 0; k < config_setting_length(s); k++) {
        const config_setting_t *e = config_setting_get_elem(s, (unsigned)k);
        void *target = (char *)g->target + g->stride * (size_t)k;
        if (!config_setting_is_group(e)) {
            place_of(p, e, place, sizeof place, g->name, "");
            params_add_fault(f, place, "element %d: expected a group { ... }", k + 1);
            continue;
        }
        for (int r = 0; r < g->nrows; r++) {
            param_default_of(g, g->rows + r, target, k);
            read_row(p, g, g->rows + r, e, target, k, f);
        }
        find_unknown_keys(p, g, e, f);
        *g->count = k + 1;
    }
}

/* Groups within a group are read as a group of their own, "bodies.[0].motion". */
static void read_inner(struct params *p, const char *path, const struct param *r,
                       const config_setting_t *s, void *target, struct faults *f)
{
    const struct param_list *l = r->list;
    int *count = (int *)(void *)((char *)target + r->offset);
    struct param_group g = {.name = path,
                            .rows = l->rows,
                            .nrows = l->nrows,
                            .target = (char *)target + r->offset + l->first,
                            .stride = l->stride,
                            .max = l->max,
                            .count = count};
    const bool plain = l->plain && config_setting_type(s) == CONFIG_TYPE_STRING;
    for (int k = 0; plain && k < l->nrows; k++)
        if (strcmp(l->rows[k].key, l->plain) == 0) {
            char why[512], place[1300];
            place_of(p, s, place, sizeof place, path, "");
            mark_given(p, path, 0, l->plain, "");
            if (!param_read(l->rows + k, s, g.target, why, sizeof why))
                params_add_fault(f, place, "%s", why);
            *count = 1;
        }
    if (!plain && l->max == 1) {
        g.stride = 0;
        *count = 1;
        read_plain(p, &g, s, f);
    } else if (!plain) {
        read_list(p, &g, s, f);
    }
}

/* Whether "sph_*" stands for "sph_left". */
static bool is_of_kind(const char *kind, const char *name)
{
    const size_t n = strlen(kind);
    return n > 1 && kind[n - 1] == '*' && strncmp(kind, name, n - 1) == 0;
}

/* others: groups of partners, which this program does not read. */
static bool known_group(const struct params *p, const char *const *others, const char *name)
{
    bool known = strcmp(name, "format") == 0 || strcmp(name, "let") == 0;
    for (int k = 0; k < p->ngroups; k++)
        known = known || strcmp(p->groups[k].name, name) == 0;
    for (int k = 0; others && others[k]; k++)
        known = known || strcmp(others[k], name) == 0 || is_of_kind(others[k], name);
    return known;
}

static const char *nearest_group(const struct params *p, const char *const *others,
                                 const char *name)
{
    struct hint_nearest n = hint_nearest_start(name);
    for (int k = 0; k < p->ngroups; k++)
        hint_nearest_try(&n, p->groups[k].name);
    for (int k = 0; others && others[k]; k++)
        hint_nearest_try(&n, others[k]);
    return hint_nearest_word(&n);
}

/* Notes the names of all groups in passing. */
static void find_unknown_groups(struct params *p, const char *const *others, struct faults *f)
{
    const config_setting_t *root = config_root_setting(&p->cfg);
    char place[1300];
    for (int k = 0; k < config_setting_length(root); k++) {
        const config_setting_t *s = config_setting_get_elem(root, (unsigned)k);
        const char *name = config_setting_name(s);
        text_add(p->names, sizeof p->names, "%s ", name);
        if (known_group(p, others, name) || config_setting_source_line(s) == 0)
            continue; /* of the command line: see find_unknown_overrides */
        const char *near = nearest_group(p, others, name);
        place_of(p, s, place, sizeof place, name, "");
        params_add_fault(f, place, near ? "unknown group; did you mean `%s'?" : "unknown group",
                         near);
    }
}

/* What a run computes depends on the command line, too, but for its outputs: those do not go into
 * the hash, so that a restart may change them. */
static void find_unknown_overrides(struct params *p, const char *const *others, struct faults *f)
{
    char place[256];
    for (int k = 0; k < p->noverrides; k++) {
        struct override *o = p->overrides + k;
        const struct param_group *g = NULL;
        if (!*o->group)
            continue;
        for (int i = 0; i < p->ngroups; i++)
            if (strcmp(p->groups[i].name, o->group) == 0)
                g = p->groups + i;
        if (!strstr(p->names, key_text(" %s ", o->group)))
            text_add(p->names, sizeof p->names, "%s ", o->group);
        snprintf(place, sizeof place, "command line: -p %s: %s%s%s", o->text, o->group,
                 *o->key ? "." : "", o->key);
        if (!g && !known_group(p, others, o->group)) {
            const char *near = nearest_group(p, others, o->group);
            const char *none = strchr(o->group, '[')
                                   ? "elements of a list are walls.[0].kind, with a point"
                                   : "unknown group";
            params_add_fault(f, place, near ? "unknown group; did you mean `%s'?" : none, near);
        } else if (g && *o->key && !g->stride && !hint_has_key(g, o->key) &&
                   !strstr(o->key, ".[")) {
            if (!tell_meant(f, place, g, o->key))
                params_add_fault(f, place, "unknown key");
        } else if (g) {
            o->known = true; /* if some list has such an element and key, seen once it is read */
        }
        if (strcmp(o->group, "output") != 0)
            p->hash = fnv(p->hash, o->text);
    }
}

/* Keys of elements of lists that no list of the case has. */
static void find_unused_overrides(const struct params *p, struct faults *f)
{
    for (int k = 0; k < p->noverrides; k++) {
        const struct override *o = p->overrides + k;
        if (!o->known || o->used)
            continue;
        params_add_fault(
            f, key_text("command line: -p %s: %s.%s", o->text, o->group, o->key),
            "no such element of a list in the case, or no such key: elements count from 0, as in "
            "walls.[0].kind, and must be there; the command line adds none");
    }
}

/* Without the key the case counts as format 1. */
static void check_format(const struct params *p, struct faults *f)
{
    const config_setting_t *s = config_lookup(&p->cfg, "format");
    double v;
    char place[1300];
    if (s && !(param_number(s, &v) && v == 1.0)) {
        place_of(p, s, place, sizeof place, "format", "");
        params_add_fault(f, place, "expected 1: this program reads format 1");
    }
}

/* Order matters: lists of the command line first, for expressions may stand in them; variables
 * before rows, which may be expressions. */
static void read_case(struct params *p, const char *const *texts, const char *const *others,
                      struct faults *f)
{
    p->overrides = NEW(struct override, p->noverrides);
    for (int k = 0; k < p->noverrides; k++)
        override_read(p->overrides + k, texts[k], f);
    read_file(p, f);
    snprintf(p->names, sizeof p->names, " ");
    if (!p->read)
        return;
    for (int k = 0; k < p->noverrides; k++)
        override_graft(p->overrides + k, &p->cfg, f);
    p->let = let_read(&p->cfg, p->path, p->overrides, p->noverrides, f);
    check_format(p, f);
    find_unknown_groups(p, others, f);
    find_unknown_overrides(p, others, f);
    for (int k = 0; k < p->ngroups; k++) {
        const config_setting_t *s = config_lookup(&p->cfg, p->groups[k].name);
        if (p->groups[k].stride)
            read_list(p, p->groups + k, s, f);
        else
            read_plain(p, p->groups + k, s, f);
    }
    find_unused_overrides(p, f);
}

/* Rank 0 has read the case; the others get its length first. */
static void share_given(struct params *p, MPI_Comm comm)
{
    int n = (int)strlen(p->given) + 1;
    MPI_Bcast(&n, 1, MPI_INT, 0, comm);
    if (p->rank > 0) {
        mem_free(p->given);
        p->given = mem_new((size_t)n, 1);
    }
    MPI_Bcast(p->given, n, MPI_CHAR, 0, comm);
}

/* Defaults on all ranks, values on rank 0, then their bytes to all: structs of rows hold no
 * pointers. */
struct params *params_read(MPI_Comm comm, const char *path, int noverrides,
                           const char *const *overrides, const struct param_group *groups,
                           int ngroups, const char *const *others, struct faults *f)
{
    struct params *p = NEW(struct params, 1);
    MPI_Comm_rank(comm, &p->rank);
    snprintf(p->path, sizeof p->path, "%s", path);
    p->groups = groups;
    p->ngroups = ngroups;
    p->noverrides = p->rank == 0 ? noverrides : 0;
    p->given = mem_new(GIVEN_SIZE, 1);
    snprintf(p->given, GIVEN_SIZE, " ");
    config_init(&p->cfg);
    for (int k = 0; k < ngroups; k++)
        for (int r = 0; r < groups[k].nrows && !groups[k].stride; r++)
            param_default(groups + k, groups[k].rows + r, groups[k].target);
    if (p->rank == 0)
        read_case(p, overrides, others, f);
    MPI_Bcast(&f->n, 1, MPI_INT, 0, comm);
    MPI_Bcast(p->names, NAMES_SIZE, MPI_CHAR, 0, comm);
    MPI_Bcast(&p->hash, 1, MPI_UNSIGNED_LONG_LONG, 0, comm);
    share_given(p, comm);
    for (int k = 0; k < ngroups; k++) {
        const struct param_group *g = groups + k;
        if (g->count)
            MPI_Bcast(g->count, 1, MPI_INT, 0, comm);
        for (int e = 0; e < (g->stride ? *g->count : 1); e++)
            for (int r = 0; r < g->nrows; r++)
                MPI_Bcast((char *)g->target + g->stride * (size_t)e + g->rows[r].offset,
                          (int)param_size(g->rows + r), MPI_BYTE, 0, comm);
        if (g->present)
            *g->present = params_has_group(p, g->name);
    }
    return p;
}

void params_free(struct params **p)
{
    if (!*p)
        return;
    let_free(&(*p)->let);
    config_destroy(&(*p)->cfg);
    for (int k = 0; k < (*p)->noverrides; k++)
        config_destroy(&(*p)->overrides[k].cfg);
    FREE((*p)->overrides, (*p)->given, *p);
    *p = NULL;
}

void params_alias(struct params *p, const char *kind, const char *as)
{
    snprintf(p->kind, sizeof p->kind, "%s", kind);
    snprintf(p->as, sizeof p->as, "%s", as);
}

/* A key as the case has it. */
static const char *key_of(const struct params *p, const char *key, char buffer[160])
{
    const size_t n = strlen(p->kind);
    if (key[0] == ':') /* of that very group */
        return key + 1;
    if (n == 0 || strncmp(key, p->kind, n) != 0 || (key[n] != '.' && key[n] != '\0'))
        return key;
    snprintf(buffer, 160, "%s%s", p->as, key + n);
    return buffer;
}

/* kind "sph": sph itself and all sph_*. */
int params_programs(const struct params *p, const char *kind, char names[PARAM_PROGRAMS_MAX][64])
{
    const size_t n = strlen(kind);
    int found = 0;
    for (const char *at = p->names; *at;) {
        const size_t space = strspn(at, " "), length = strcspn(at + space, " ");
        at += space;
        if (length >= n && length < 64 && found < PARAM_PROGRAMS_MAX && strncmp(at, kind, n) == 0 &&
            (length == n || at[n] == '_')) {
            memcpy(names[found], at, length);
            names[found++][length] = '\0';
        }
        at += length;
    }
    return found;
}

bool params_has_group(const struct params *p, const char *group)
{
    return strstr(p->names, key_text(" %s ", group)) != NULL;
}

unsigned long long params_hash(const struct params *p) { return p->hash; }

/* The value of `key' on rank 0: of the command line, of the case, or NULL. */
static const config_setting_t *value_of(const struct params *p, const char *name)
{
    char buffer[160];
    const char *key = key_of(p, name, buffer);
    for (int k = p->noverrides - 1; p->rank == 0 && k >= 0; k--) {
        const struct override *o = p->overrides + k;
        if (strcmp(key_text("%s.%s", o->group, o->key), key) == 0)
            return config_lookup(&o->cfg, "value");
    }
    return p->read ? config_lookup(&p->cfg, key) : NULL;
}

/* Numbers that a setting holds; how many. */
static int peek(const config_setting_t *s, double v[3])
{
    int n = 0;
    v[0] = v[1] = v[2] = 0.0;
    if (s && param_number(s, v))
        n = 1;
    for (int k = 0; s && config_setting_is_aggregate(s) && k < 3 && k < config_setting_length(s);
         k++)
        n += param_number(config_setting_get_elem(s, (unsigned)k), v + k);
    return n;
}

bool params_peek(const struct params *p, MPI_Comm comm, const char *key, double v[3])
{
    int n = peek(value_of(p, key), v);
    MPI_Bcast(v, 3, MPI_DOUBLE, 0, comm);
    MPI_Bcast(&n, 1, MPI_INT, 0, comm);
    return n > 0;
}

/* One number of the two corners is enough. */
bool params_peek_pair(const struct params *p, MPI_Comm comm, const char *key, double v[2][3])
{
    const config_setting_t *s = value_of(p, key);
    int n = 0;
    for (int k = 0; k < 2; k++) {
        const bool there = s && config_setting_is_aggregate(s) && k < config_setting_length(s);
        n += peek(there ? config_setting_get_elem(s, (unsigned)k) : NULL, v[k]);
    }
    MPI_Bcast(v, 6, MPI_DOUBLE, 0, comm);
    MPI_Bcast(&n, 1, MPI_INT, 0, comm);
    return n > 0;
}

bool params_peek_any(const struct params *p, MPI_Comm comm, const char *key, const char *text)
{
    const config_setting_t *s = value_of(p, key);
    const char *is = s && text ? config_setting_get_string(s) : NULL;
    bool there = text ? is && strcmp(is, text) == 0 : s != NULL;
    MPI_Bcast(&there, 1, MPI_C_BOOL, 0, comm);
    return there;
}

/* Keys in p->given stand between blanks, so that none is found within another. */
static bool marked(const struct params *p, const char *key, const char *mark)
{
    char word[168], buffer[160];
    snprintf(word, sizeof word, " %s%s ", key_of(p, key, buffer), mark);
    return strstr(p->given, word) != NULL;
}

bool params_given(const struct params *p, const char *key) { return marked(p, key, ""); }
bool params_on_command_line(const struct params *p, const char *key) { return marked(p, key, "!"); }

void params_unused(const struct params *p, struct faults *f, const char *key, bool used,
                   const char *why)
{
    if (!used && params_given(p, key) && !marked(p, key, "="))
        params_fault(p, f, key, "is not used: %s", why);
}

/* Only rank 0 has the words, all ranks count. */
void params_fault(const struct params *p, struct faults *f, const char *name, const char *fmt, ...)
{
    char place[1400], text[256], buffer[160], holds[256];
    const char *key = key_of(p, name, buffer);
    va_list args;
    if (p->rank > 0) {
        f->n++;
        return;
    }
    snprintf(text, sizeof text, "%s=", key);
    snprintf(holds, sizeof holds, "%s", key);
    const config_setting_t *s = p->read ? config_lookup(&p->cfg, holds) : NULL;
    for (char *end; p->read && !s && (end = strrchr(holds, '.')); s = config_lookup(&p->cfg, holds))
        *end = '\0'; /* a key that is missing: where its group or element begins */
    param_place(s, p->path, key, place, sizeof place);
    for (int k = 0; k < p->noverrides; k++)
        if (strncmp(p->overrides[k].text, text, strlen(text)) == 0)
            snprintf(place, sizeof place, "command line: -p %s: %s", p->overrides[k].text, key);
    va_start(args, fmt);
    add_fault(f, place, fmt, args);
    va_end(args);
}

/* Without any table: what programs a case is for. */
bool params_list_groups(const char *path)
{
    struct params p = {.rank = 0};
    struct faults f = {0};
    char line[1024] = "";
    snprintf(p.path, sizeof p.path, "%s", path);
    config_init(&p.cfg);
    read_file(&p, &f);
    const config_setting_t *root = config_root_setting(&p.cfg);
    for (int k = 0; p.read && k < config_setting_length(root); k++)
        text_add(line, sizeof line, "%s%s", k ? " " : "",
                 config_setting_name(config_setting_get_elem(root, (unsigned)k)));
    if (p.read && f.n == 0)
        log_say("%s", line);
    else
        params_report(&f);
    config_destroy(&p.cfg);
    mem_free(f.text);
    return p.read && f.n == 0;
}

/* Copied, since the stream's own memory is not of mem_new. */
char *params_text(const struct params *p)
{
    char *text;
    size_t n;
    FILE *to = open_memstream(&text, &n);
    require(to);
    fputs("format = 1;\n", to);
    let_print(to, p->let);
    for (int k = 0; k < p->ngroups; k++)
        if (params_has_group(p, p->groups[k].name))
            params_print_group(to, p, p->groups + k);
    require(fclose(to) == 0);
    char *all = NEW(char, n + 1);
    memcpy(all, text, n + 1);
    free(text);
    return all;
}
