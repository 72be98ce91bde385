/* params_print.c - what the parameter table says of itself: --help, the manual, values with units.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdio.h>
#include <string.h>

#include "mem.h"
#include "params_hints.h"

static const char *kind(const struct param *r)
{
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
    case PARAM_REALS:
    case PARAM_INTS:
    case PARAM_BOOLS:
        return "(x, y[, z])";
    default:
        return r->unit;
    }
}

static void print_row(const struct param_group *g, const struct param *r)
{
    const bool numeric = r->type != PARAM_BOOL && r->type != PARAM_CHOICE && r->type != PARAM_TEXT;
    printf("  %s.%-18s %-14s %s", g->name, r->key, kind(r), r->help);
    if (r->dflt)
        printf("; default %s", r->dflt);
    else
        printf("; required");
    if (numeric)
        printf("; from %g to %g%s%s", r->min, r->max, strcmp(r->unit, "-") ? " " : "",
               strcmp(r->unit, "-") ? r->unit : "");
    printf("\n");
}

/* Nothing has this name: the nearest one that has. */
static void print_unknown(const struct param_group *groups, int ngroups, const char *key)
{
    const char *dot = strrchr(key, '.');
    struct hint_nearest n = hint_nearest_start(dot ? dot + 1 : key);
    for (int k = 0; k < ngroups; k++) {
        if (!dot)
            hint_nearest_try(&n, groups[k].name);
        for (int r = 0; r < groups[k].nrows; r++)
            hint_nearest_try(&n, groups[k].rows[r].key);
    }
    const char *near = hint_nearest_word(&n);
    printf(near ? "no key or group %s; did you mean `%s'?\n" : "no key or group %s\n", key, near);
}

void params_help(const struct param_group *groups, int ngroups, const char *key)
{
    bool any = false;
    for (int k = 0; k < ngroups; k++) {
        const struct param_group *g = groups + k;
        bool title = false;
        for (int r = 0; r < g->nrows; r++) {
            char name[160];
            snprintf(name, sizeof name, "%s.%s", g->name, g->rows[r].key);
            if (key && strcmp(key, name) != 0 && strcmp(key, g->name) != 0 &&
                strcmp(key, g->rows[r].key) != 0)
                continue;
            if (!title)
                printf("%s: %s\n", g->name, g->help);
            title = any = true;
            print_row(g, g->rows + r);
        }
    }
    if (key && !any)
        print_unknown(groups, ngroups, key);
}

void params_manual(const struct param_group *groups, int ngroups)
{
    for (int k = 0; k < ngroups; k++) {
        const struct param_group *g = groups + k;
        printf(
            "## %s\n\n%s.\n\n| key | value | default | range | meaning |\n|---|---|---|---|---|\n",
            g->name, g->help);
        for (int r = 0; r < g->nrows; r++) {
            const struct param *p = g->rows + r;
            const bool numeric =
                p->type != PARAM_BOOL && p->type != PARAM_CHOICE && p->type != PARAM_TEXT;
            char range[80] = "";
            if (numeric)
                snprintf(range, sizeof range, "%g .. %g", p->min, p->max);
            printf("| `%s.%s` | ", g->name, p->key);
            for (const char *c = kind(p); *c; c++)
                printf(*c == '|' ? "\\|" : "%c", *c);
            printf(" | %s | %s | %s |\n", p->dflt ? p->dflt : "required", range, p->help);
        }
        printf("\n");
    }
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

static void print_points(char *to, size_t size, const struct param_points *p)
{
    size_t n = (size_t)snprintf(to, size, "(");
    for (int k = 0; k < p->n && n + 80 < size; k++)
        n += (size_t)snprintf(to + n, size - n, "%s(%.17g, %.17g)", k ? ", " : "", p->x[k][0],
                              p->x[k][1]);
    snprintf(to + n, size - n, ")");
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
    case PARAM_POINTS:
        print_points(to, size, (const struct param_points *)(const void *)at);
        break;
    default:
        print_numbers(to, size, r, at, 3);
        break;
    }
}

const char *params_value(const struct param *row, const void *target)
{
    static char text[512];
    print_value(text, sizeof text - 32, row, target);
    if (row->unit && strcmp(row->unit, "-") != 0) {
        const size_t n = strlen(text);
        snprintf(text + n, sizeof text - n, " %s", row->unit);
    }
    return text;
}

char *params_group_text(const struct params *p, const struct param_group *g)
{
    const size_t points = 80 * (size_t)PARAM_POINTS_MAX; /* the longest value */
    size_t row = 640;
    for (int r = 0; r < g->nrows; r++)
        row = g->rows[r].type == PARAM_POINTS ? points : row;
    const size_t room = 256 + (size_t)g->nrows * row * (size_t)(g->stride ? *g->count + 1 : 1);
    char *text = mem_new(room, 1), *value = mem_new(points, 1);
    size_t n = (size_t)snprintf(text, room, "%s: %s\n", g->name, g->stride ? "(" : "{");
    for (int e = 0; e < (g->stride ? *g->count : 1); e++) {
        const void *target = (const char *)g->target + g->stride * (size_t)e;
        if (g->stride)
            n += (size_t)snprintf(text + n, room - n, "  %s{\n", e ? ", " : "");
        for (int r = 0; r < g->nrows; r++) {
            char key[160];
            if (g->stride)
                snprintf(key, sizeof key, "%s.[%d].%s", g->name, e, g->rows[r].key);
            else
                snprintf(key, sizeof key, "%s.%s", g->name, g->rows[r].key);
            print_value(value, points, g->rows + r, target);
            n += (size_t)snprintf(text + n, room - n, "  %s%s = %s;\n",
                                  params_given(p, key) ? "" : "# ", g->rows[r].key, value);
        }
        if (g->stride)
            n += (size_t)snprintf(text + n, room - n, "  }\n");
    }
    snprintf(text + n, room - n, "%s;\n", g->stride ? ")" : "}");
    mem_free(value);
    return text;
}
