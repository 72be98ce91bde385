/* summary.c - summary.json: keys with dots become nested objects. The entries are a list in the
 * order of their first setting; a key is looked up along the list, some hundred comparisons for
 * each of some hundred entries at the end of a run.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "series.h"

#include "../base/base.h"
#include "disk.h"

/* A key with its value: a number, or anything else as finished JSON text. */
struct entry {
    char key[96];
    bool number;
    double value;
    char *text; /* JSON text of what is no double; the library's own, for free() */
};

struct summary {
    int n;
    struct entry *of;
};

static void free_texts(void *p)
{
    const struct summary *s = p;
    for (int k = 0; k < s->n; k++)
        free(s->of[k].text);
}

struct summary *summary_create(void)
{
    struct summary *s = NEW(struct summary, 1);
    mem_at_free(s, free_texts);
    return s;
}

/* The entry of this key, emptied; made if need be. */
static struct entry *entry(struct summary *s, const char *key)
{
    for (int k = 0; k < s->n; k++)
        if (strcmp(s->of[k].key, key) == 0) {
            free(s->of[k].text);
            s->of[k].text = NULL;
            return s->of + k;
        }
    ROOM_IN(s, s->of, s->n + 1);
    struct entry *e = s->of + s->n++;
    *e = (struct entry){0};
    snprintf(e->key, sizeof e->key, "%s", key);
    return e;
}

void summary_real(struct summary *s, const char *key, double v)
{
    struct entry *e = entry(s, key);
    e->number = true;
    e->value = v;
}

void summary_int(struct summary *s, const char *key, long long v)
{
    struct entry *e = entry(s, key);
    e->number = true;
    e->value = (double)v;
    require(asprintf(&e->text, "%lld", v) > 0);
}

/* v as a JSON string; control characters become blanks. */
static void quote(FILE *to, const char *v)
{
    fputc('"', to);
    for (; *v; v++) {
        if (*v == '"' || *v == '\\')
            fputc('\\', to);
        fputc((unsigned char)*v < 32 ? ' ' : *v, to);
    }
    fputc('"', to);
}

void summary_bool(struct summary *s, const char *key, bool v)
{
    struct entry *e = entry(s, key);
    e->number = false;
    require(asprintf(&e->text, "%s", v ? "true" : "false") > 0);
}

/* n texts between `open' and `close'. */
static void set_texts(struct summary *s, const char *key, const char *open, int n,
                      const char *const *v, const char *close)
{
    size_t size;
    struct entry *e = entry(s, key);
    FILE *to = open_memstream(&e->text, &size);
    require(to);
    e->number = false;
    fputs(open, to);
    for (int k = 0; k < n; k++) {
        fputs(k ? ", " : "", to);
        quote(to, v[k]);
    }
    fputs(close, to);
    require(fclose(to) == 0);
}

void summary_text(struct summary *s, const char *key, const char *v)
{
    set_texts(s, key, "", 1, &v, "");
}

void summary_texts(struct summary *s, const char *key, int n, const char *const *v)
{
    set_texts(s, key, "[", n, v, "]");
}

bool summary_find(const struct summary *s, const char *key, double *v)
{
    for (int k = 0; k < s->n; k++)
        if (s->of[k].number && strcmp(s->of[k].key, key) == 0) {
            *v = s->of[k].value;
            return true;
        }
    return false;
}

const char *summary_find_text(const struct summary *s, const char *key)
{
    for (int k = 0; k < s->n; k++)
        if (!s->of[k].number && strcmp(s->of[k].key, key) == 0)
            return s->of[k].text;
    return NULL;
}

void summary_each(const struct summary *s, void (*f)(void *ctx, const char *key, double v),
                  void *ctx)
{
    for (int k = 0; k < s->n; k++)
        if (s->of[k].number)
            f(ctx, s->of[k].key, s->of[k].value);
}

static void print_value(FILE *f, const struct entry *e)
{
    if (e->text)
        fputs(e->text, f);
    else if (isfinite(e->value))
        fprintf(f, "%.12g", e->value);
    else
        fputs("null", f);
}

/* Entries [0, n) whose key begins with prefix, each object where its first key stood. Calls itself
 * for objects within. An object is printed when its first key comes up, with all keys of it,
 * wherever they stand in the list; its later keys are then passed over (`seen'). */
static void print_object(FILE *f, const struct summary *s, const char *prefix, int depth)
{
    const size_t skip = strlen(prefix);
    bool first = true;
    fputs("{", f);
    for (int k = 0; k < s->n; k++) {
        const struct entry *e = s->of + k;
        if (strncmp(e->key, prefix, skip) != 0)
            continue;
        const char *rest = e->key + skip;
        const size_t head = strcspn(rest, ".");
        bool seen = false;
        for (int j = 0; j < k && rest[head]; j++)
            seen = seen || strncmp(s->of[j].key, e->key, skip + head + 1) == 0;
        if (seen)
            continue;
        fprintf(f, "%s\n%*s\"%.*s\": ", first ? "" : ",", 2 * depth + 2, "", (int)head, rest);
        first = false;
        if (rest[head]) {
            char deeper[128];
            snprintf(deeper, sizeof deeper, "%.*s.", (int)(skip + head), e->key);
            print_object(f, s, deeper, depth + 1);
        } else {
            print_value(f, e);
        }
    }
    fprintf(f, "\n%*s}", 2 * depth, "");
}

void summary_extrema(struct summary *s, const double found[3], const double known[3])
{
    static const char *const names[3] = {"extrema.u_min", "extrema.v_max", "extrema.v_min"};
    double worst = 0.0;
    for (int k = 0; k < 3; k++) {
        summary_real(s, names[k], found[k]);
        worst = fmax(worst, fabs(found[k] / known[k] - 1.0));
    }
    summary_real(s, "error.extrema", worst);
}

void summary_write(const struct summary *s, const char *path)
{
    FILE *f = disk_begin(path);
    print_object(f, s, "", 0);
    fputs("\n", f);
    disk_finish(f, path);
}
