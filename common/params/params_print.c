/* params_print.c - what the parameter table says of itself: --help, the manual, values with units.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../base/base.h"
#include "params_hints.h"
#include "params_use.h"

static const char *kind(const struct param *r)
{
    if (r->numbers == 2)
        return "(v, v)";
    switch (r->type) {
    case PARAM_BOOL:
        return "true|false";
    case PARAM_CHOICE:
        return r->choices;
    case PARAM_TEXT:
        return "text";
    case PARAM_BOX:
        return "((x, y), (x, y))";
    case PARAM_POINTS:
        return "((x, y), (x, y), ...)";
    case PARAM_PLACES:
        return "((x, y, z), ...)";
    case PARAM_LIST:
        return r->list->max == 1 ? "{ ... }" : "( { ... }, { ... } )";
    case PARAM_TURN:
        return "z or (x, y, z)";
    case PARAM_NUMBERS:
        return "v or (v, v, ...)";
    case PARAM_REALS:
    case PARAM_INTS:
    case PARAM_BOOLS:
        return "(x, y[, z])";
    default:
        return r->unit;
    }
}

static bool is_numeric(const struct param *r)
{
    return r->type != PARAM_BOOL && r->type != PARAM_CHOICE && r->type != PARAM_TEXT &&
           r->type != PARAM_LIST;
}

static const char *default_of(const struct param *r)
{
    static char names[160];
    if (r->type == PARAM_TEXT && r->dflt && strchr(r->dflt, '#')) {
        const int n = (int)strcspn(r->dflt, "#");
        snprintf(names, sizeof names, "%.*s, %.*s2, ..", n, r->dflt, n, r->dflt);
        return names;
    }
    if (is_numeric(r) && r->dflt && strtod(r->dflt, NULL) > r->max)
        return "not given"; /* the key's words say what stands for it */
    return r->type == PARAM_LIST ? "none" : r->dflt ? r->dflt : "required";
}

static void print_row(const struct param_group *g, const struct param *r)
{
    const bool numeric = is_numeric(r);
    const char *when = params_use_words(g->rows, g->nrows, r);
    printf("  %s.%-18s %-14s %s", g->name, r->key, kind(r), r->help);
    printf("; %s%s", r->dflt ? "default " : "", default_of(r));
    if (numeric)
        printf("; from %g to %g%s%s", r->min, r->max, strcmp(r->unit, "-") ? " " : "",
               strcmp(r->unit, "-") ? r->unit : "");
    printf("%s%s%s\n", *when ? "; used when: " : "", when,
           r->comparison ? "; for comparisons" : "");
}

/* The group that a row stands for, "bodies.motion". */
static struct param_group inner_of(const struct param_group *g, const struct param *r, char *name,
                                   size_t size)
{
    snprintf(name, size, "%s.%s", g->name, r->key);
    return (struct param_group){.name = name, .rows = r->list->rows, .nrows = r->list->nrows};
}

/* Nothing has this name: the nearest one that has. */
static void print_unknown(const struct param_group *groups, int ngroups, const char *key)
{
    const char *dot = strrchr(key, '.');
    struct hint_nearest n = hint_nearest_start(dot ? dot + 1 : key);
    for (int k = 0; k < ngroups; k++) {
        if (!dot)
            hint_nearest_try(&n, groups[k].name);
        for (int r = 0; r < groups[k].nrows; r++) {
            const struct param *row = groups[k].rows + r;
            hint_nearest_try(&n, row->key);
            for (int i = 0; row->type == PARAM_LIST && i < row->list->nrows; i++)
                hint_nearest_try(&n, row->list->rows[i].key);
        }
    }
    const char *near = hint_nearest_word(&n);
    printf(near ? "no key or group %s; did you mean `%s'?\n" : "no key or group %s\n", key, near);
}

/* Rows of a group that the key asks for, NULL: all; whether there are any. */
static bool help_group(const struct param_group *g, const char *key)
{
    bool title = false, any = false;
    for (int r = 0; r < g->nrows; r++) {
        const struct param *row = g->rows + r;
        char name[160];
        snprintf(name, sizeof name, "%s.%s", g->name, row->key);
        const bool asked = !key || strcmp(key, name) == 0 || strcmp(key, g->name) == 0 ||
                           strcmp(key, row->key) == 0;
        if (asked && !title && g->help)
            printf("%s: %s\n", g->name, g->help);
        if (asked) {
            title = any = true;
            print_row(g, row);
        }
        if (row->type == PARAM_LIST) {
            const struct param_group inner = inner_of(g, row, name, sizeof name);
            any = help_group(&inner, asked ? NULL : key) || any;
        }
    }
    return any;
}

void params_help(const struct param_group *groups, int ngroups, const char *key)
{
    bool any = false;
    for (int k = 0; k < ngroups; k++)
        any = help_group(groups + k, key) || any;
    if (key && !any)
        print_unknown(groups, ngroups, key);
}

static void print_cell(const char *text)
{
    for (const char *c = text; *c; c++)
        printf(*c == '|' ? "\\|" : "%c", *c);
    printf(" |");
}

/* Rows that are for comparisons, or those that are not. */
static void manual_rows(const struct param_group *g, bool comparison)
{
    for (int r = 0; r < g->nrows; r++) {
        const struct param *p = g->rows + r;
        char range[80] = "", name[160];
        if (is_numeric(p))
            snprintf(range, sizeof range, "%g .. %g", p->min, p->max);
        if (p->comparison == comparison) {
            printf("| `%s.%s` | ", g->name, p->key);
            print_cell(kind(p));
            printf(" %s | %s | ", default_of(p), range);
            print_cell(params_use_words(g->rows, g->nrows, p));
            printf(" ");
            print_cell(p->help);
            printf("\n");
        }
        if (p->type == PARAM_LIST) {
            const struct param_group inner = inner_of(g, p, name, sizeof name);
            manual_rows(&inner, comparison);
        }
    }
}

static void manual_head(const char *name, const char *help)
{
    printf("## %s\n\n%s.\n\n| key | value | default | range | used when | meaning |\n"
           "|---|---|---|---|---|---|\n",
           name, help);
}

void params_manual(const struct param_group *groups, int ngroups)
{
    for (int k = 0; k < ngroups; k++) {
        manual_head(groups[k].name, groups[k].help);
        manual_rows(groups + k, false);
        printf("\n");
    }
    manual_head("For comparisons", "Keys that compare methods with those of others, or tune what "
                                   "nobody needs to tune; a case of practice has none");
    for (int k = 0; k < ngroups; k++)
        manual_rows(groups + k, true);
}

static int print_numbers(char *to, size_t size, const struct param *r, const char *at, int n)
{
    int len = snprintf(to, size, "(");
    for (int k = 0; k < n; k++) {
        const char *comma = k ? ", " : "";
        size_t left = size - (size_t)len;
        if (r->type == PARAM_INTS)
            len += snprintf(to + len, left, "%s%d", comma, ((const int *)(const void *)at)[k]);
        else if (r->type == PARAM_BOOLS)
            len += snprintf(to + len, left, "%s%s", comma,
                            ((const bool *)(const void *)at)[k] ? "true" : "false");
        else
            len +=
                snprintf(to + len, left, "%s%.17g", comma, ((const double *)(const void *)at)[k]);
    }
    return len + snprintf(to + len, size - (size_t)len, ")");
}

static void print_text(char *to, size_t size, const char *text)
{
    size_t n = 0;
    to[n++] = '"';
    for (; *text && n + 3 < size; text++) {
        if (*text == '"' || *text == '\\')
            to[n++] = '\\';
        to[n++] = *text;
    }
    to[n++] = '"';
    to[n] = '\0';
}

/* n points x[n][dim] as ((x, y), ..), as many as fit in. */
static void print_points(char *to, size_t size, int n, int dim, const double *x)
{
    size_t at = (size_t)snprintf(to, size, "(");
    for (int k = 0; k < n && at + 40 + 20 * (size_t)dim < size; k++)
        for (int a = 0; a < dim; a++)
            at += (size_t)snprintf(to + at, size - at, "%s%s%.17g%s", k || a ? ", " : "",
                                   a ? "" : "(", x[dim * k + a], a == dim - 1 ? ")" : "");
    snprintf(to + at, size - at, ")");
}

/* Value as libconfig text. */
static void print_value(char *to, size_t size, const struct param *r, const void *target)
{
    const char *at = (const char *)target + r->offset;
    int index, len;
    switch (r->type) {
    case PARAM_REAL:
        snprintf(to, size, "%.17g", *(const double *)(const void *)at);
        break;
    case PARAM_INT:
        snprintf(to, size, "%d", *(const int *)(const void *)at);
        break;
    case PARAM_BOOL:
        snprintf(to, size, "%s", *(const bool *)(const void *)at ? "true" : "false");
        break;
    case PARAM_TEXT:
        print_text(to, size, at);
        break;
    case PARAM_CHOICE: {
        const char *c = r->choices;
        for (index = *(const int *)(const void *)at; index > 0 && strchr(c, '|'); index--)
            c = strchr(c, '|') + 1;
        snprintf(to, size, "\"%.*s\"", (int)strcspn(c, "|"), c);
        break;
    }
    case PARAM_BOX:
        len = snprintf(to, size, "(");
        len += print_numbers(to + len, size - (size_t)len, r, at, 3);
        len += snprintf(to + len, size - (size_t)len, ", ");
        len += print_numbers(to + len, size - (size_t)len, r, at + 3 * sizeof(double), 3);
        snprintf(to + len, size - (size_t)len, ")");
        break;
    case PARAM_NUMBERS:
        print_numbers(to, size, r, at + offsetof(struct param_numbers, v),
                      ((const struct param_numbers *)(const void *)at)->n);
        break;
    case PARAM_POINTS:
        print_points(to, size, ((const struct param_points *)(const void *)at)->n, 2,
                     (const double *)(const void *)(at + offsetof(struct param_points, x)));
        break;
    case PARAM_PLACES:
        print_points(to, size, ((const struct param_places *)(const void *)at)->n, 3,
                     (const double *)(const void *)(at + offsetof(struct param_places, x)));
        break;
    default:
        print_numbers(to, size, r, at, 3);
        break;
    }
}

/* Most bytes that a row takes as text. */
static size_t room_of(const struct param *r)
{
    size_t room =
        r->type == PARAM_POINTS || r->type == PARAM_PLACES ? 80 * (size_t)PARAM_POINTS_MAX : 640;
    for (int k = 0; r->type == PARAM_LIST && k < r->list->nrows; k++)
        room += (size_t)r->list->max * (room_of(r->list->rows + k) + 32);
    return room;
}

/* The rows of one group; what is not given stands in comments. */
static size_t print_rows(const struct params *p, const char *path, const struct param *rows,
                         int nrows, const void *target, char *to, size_t room)
{
    size_t n = 0;
    char *value = mem_new(80 * (size_t)PARAM_POINTS_MAX, 1); /* the longest value */
    for (int r = 0; r < nrows; r++) {
        const struct param_list *l = rows[r].list;
        char key[160];
        snprintf(key, sizeof key, "%s.%s", path, rows[r].key);
        const bool given = params_given(p, key);
        if (!l) {
            print_value(value, 80 * (size_t)PARAM_POINTS_MAX, rows + r, target);
            n += (size_t)snprintf(to + n, room - n, "  %s%s = %s;\n", given ? "" : "# ",
                                  rows[r].key, value);
            continue;
        }
        const char *at = (const char *)target + rows[r].offset;
        const int count = given ? *(const int *)(const void *)at : 0;
        if (count > 0)
            n +=
                (size_t)snprintf(to + n, room - n, "  %s = %s", rows[r].key, l->max > 1 ? "(" : "");
        for (int k = 0; k < count; k++) {
            if (l->max > 1)
                snprintf(key, sizeof key, "%s.%s.[%d]", path, rows[r].key, k);
            n += (size_t)snprintf(to + n, room - n, "%s{\n", k ? ", " : "");
            n += print_rows(p, key, l->rows, l->nrows, at + l->first + l->stride * (size_t)k,
                            to + n, room - n);
            n += (size_t)snprintf(to + n, room - n, "  }");
        }
        if (count > 0)
            n += (size_t)snprintf(to + n, room - n, "%s;\n", l->max > 1 ? ")" : "");
    }
    mem_free(value);
    return n;
}

char *params_group_text(const struct params *p, const struct param_group *g)
{
    size_t room = 256;
    for (int r = 0; r < g->nrows; r++)
        room += room_of(g->rows + r) * (size_t)(g->stride ? *g->count + 1 : 1);
    char *text = mem_new(room, 1);
    size_t n = (size_t)snprintf(text, room, "%s: %s\n", g->name, g->stride ? "(" : "{");
    for (int e = 0; e < (g->stride ? *g->count : 1); e++) {
        char path[80];
        snprintf(path, sizeof path, "%s", g->name);
        if (g->stride)
            snprintf(path, sizeof path, "%s.[%d]", g->name, e);
        if (g->stride)
            n += (size_t)snprintf(text + n, room - n, "  %s{\n", e ? ", " : "");
        n += print_rows(p, path, g->rows, g->nrows, (const char *)g->target + g->stride * (size_t)e,
                        text + n, room - n);
        if (g->stride)
            n += (size_t)snprintf(text + n, room - n, "  }\n");
    }
    snprintf(text + n, room - n, "%s;\n", g->stride ? ")" : "}");
    return text;
}
