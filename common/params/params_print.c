/* params_print.c - what the parameter table says of itself: --help, the manual, values with units.
 * SPDX-License-Identifier: BSD-3-Clause */

#include "../base/base.h"
#include "params_hints.h"
#include "params_use.h"
#include "params_value.h"

/* How a value is written in a case. */
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

/* "box#" stands for box, box2, ..; a default above the range for none. */
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

/* | would end a cell of the table. */
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

static void print_numbers(FILE *to, const struct param *r, const char *at, int n)
{
    char text[32];
    for (int k = 0; k < n; k++) {
        fputs(k ? ", " : "(", to);
        if (r->type == PARAM_INTS)
            fprintf(to, "%d", ((const int *)(const void *)at)[k]);
        else if (r->type == PARAM_BOOLS)
            fputs(((const bool *)(const void *)at)[k] ? "true" : "false", to);
        else
            fputs(param_real(((const double *)(const void *)at)[k], text), to);
    }
    fputs(n > 0 ? ")" : "()", to);
}

/* As libconfig reads it. */
static void print_text(FILE *to, const char *text)
{
    fputc('"', to);
    for (; *text; text++)
        fprintf(to, *text == '"' || *text == '\\' ? "\\%c" : "%c", *text);
    fputc('"', to);
}

/* n points x[n][dim] as ((x, y), ..). */
static void print_points(FILE *to, int n, int dim, const double *x)
{
    char text[32];
    fputs("(", to);
    for (int k = 0; k < n; k++)
        for (int a = 0; a < dim; a++)
            fprintf(to, "%s%s%s%s", k || a ? ", " : "", a ? "" : "(",
                    param_real(x[dim * k + a], text), a == dim - 1 ? ")" : "");
    fputs(")", to);
}

/* Value as libconfig text. */
static void print_value(FILE *to, const struct param *r, const void *target)
{
    const char *at = (const char *)target + r->offset, *c = r->choices;
    const struct param_numbers *numbers = (const void *)at;
    const struct param_points *points = (const void *)at;
    const struct param_places *places = (const void *)at;
    char text[32];
    switch (r->type) {
    case PARAM_REAL:
        fputs(param_real(*(const double *)(const void *)at, text), to);
        break;
    case PARAM_INT:
        fprintf(to, "%d", *(const int *)(const void *)at);
        break;
    case PARAM_BOOL:
        fputs(*(const bool *)(const void *)at ? "true" : "false", to);
        break;
    case PARAM_TEXT:
        print_text(to, at);
        break;
    case PARAM_CHOICE:
        for (int index = *(const int *)(const void *)at; index > 0 && strchr(c, '|'); index--)
            c = strchr(c, '|') + 1;
        fprintf(to, "\"%.*s\"", (int)strcspn(c, "|"), c);
        break;
    case PARAM_BOX:
        fputs("(", to);
        print_numbers(to, r, at, 3);
        fputs(", ", to);
        print_numbers(to, r, at + 3 * sizeof(double), 3);
        fputs(")", to);
        break;
    case PARAM_NUMBERS:
        print_numbers(to, r, (const char *)numbers->v, numbers->n);
        break;
    case PARAM_POINTS:
        print_points(to, points->n, 2, points->x[0]);
        break;
    case PARAM_PLACES:
        print_points(to, places->n, 3, places->x[0]);
        break;
    default:
        print_numbers(to, r, at, 3);
        break;
    }
}

/* The rows of one group; what is not given stands in comments. */
static void print_rows(FILE *to, const struct params *p, const char *path, const struct param *rows,
                       int nrows, const void *target)
{
    for (int r = 0; r < nrows; r++) {
        const struct param_list *l = rows[r].list;
        char key[160];
        snprintf(key, sizeof key, "%s.%s", path, rows[r].key);
        const bool given = params_given(p, key);
        if (!l) {
            fprintf(to, "  %s%s = ", given ? "" : "# ", rows[r].key);
            print_value(to, rows + r, target);
            fputs(";\n", to);
            continue;
        }
        const char *at = (const char *)target + rows[r].offset;
        const int count = given ? *(const int *)(const void *)at : 0;
        if (count > 0)
            fprintf(to, "  %s = %s", rows[r].key, l->max > 1 ? "(" : "");
        for (int k = 0; k < count; k++) {
            if (l->max > 1)
                snprintf(key, sizeof key, "%s.%s.[%d]", path, rows[r].key, k);
            fprintf(to, "%s{\n", k ? ", " : "");
            print_rows(to, p, key, l->rows, l->nrows, at + l->first + l->stride * (size_t)k);
            fputs("  }", to);
        }
        if (count > 0)
            fputs(l->max > 1 ? ");\n" : ";\n", to);
    }
}

void params_print_group(FILE *to, const struct params *p, const struct param_group *g)
{
    fprintf(to, "%s: %s\n", g->name, g->stride ? "(" : "{");
    for (int e = 0; e < (g->stride ? *g->count : 1); e++) {
        char path[80];
        snprintf(path, sizeof path, "%s", g->name);
        if (g->stride) {
            snprintf(path, sizeof path, "%s.[%d]", g->name, e);
            fprintf(to, "  %s{\n", e ? ", " : "");
        }
        print_rows(to, p, path, g->rows, g->nrows, (const char *)g->target + g->stride * (size_t)e);
        if (g->stride)
            fputs("  }\n", to);
    }
    fprintf(to, "%s;\n", g->stride ? ")" : "}");
}
