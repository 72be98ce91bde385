/* params_use.c - goes over all rows: keys that a case gives and its run does not use.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "params_use.h"

#include "../base/base.h"

/* What a walk over the rows of a group, or of a list in one, carries along. */
struct walk {
    const struct params *p;
    const unsigned long long *facts;
    const void *context;
    struct faults *f;
    bool planar; /* of components alone: vectors have two */
};

/* The row of a key that a condition names: the manual, which a test writes, asks for all. */
static const struct param *row_of(const struct param *rows, int nrows, const char *key)
{
    for (int k = 0; key && k < nrows; k++)
        if (strcmp(rows[k].key, key) == 0)
            return rows + k;
    if (key)
        abort_run("a condition names the key %s, which its group has not", key);
    return NULL;
}

/* Whether a value says something: neither 0, nor empty, nor false. */
static bool says(const struct param *row, const void *element)
{
    const void *at = (const char *)element + row->offset;
    switch (row->type) {
    case PARAM_TEXT:
        return *(const char *)at != '\0';
    case PARAM_BOOL:
        return *(const bool *)at;
    case PARAM_REAL:
        return *(const double *)at > 0.0;
    default: /* an int, or a struct that begins with one, how many there are */
        return *(const int *)at > 0;
    }
}

/* Of a key that has choices one of those that are allowed, else whether it says something. */
static bool key_holds(const struct param_use *u, const struct param *rows, int nrows,
                      const void *element)
{
    const struct param *row = row_of(rows, nrows, u->key);
    if (!row)
        return false;
    if (u->choices)
        return u->choices >> *(const int *)(const void *)((const char *)element + row->offset) & 1u;
    return says(row, element) != u->without;
}

static bool holds(const struct walk *w, const struct param_use *u, const struct param *rows,
                  int nrows, const void *element)
{
    return (w->facts && *w->facts & u->facts) || key_holds(u, rows, nrows, element) ||
           (u->test && u->test(w->context, element));
}

/* The first condition that does not hold speaks. false: it has. */
static bool check_row(const struct walk *w, const char *key, const struct param *rows, int nrows,
                      const struct param *row, const void *element)
{
    if (w->planar || !row->uses || !params_given(w->p, key))
        return true;
    for (const struct param_use *u = row->uses; u->why; u++)
        if (!w->facts == !u->facts && !holds(w, u, rows, nrows, element)) {
            params_unused(w->p, w->f, key, false, u->why);
            return false;
        }
    return true;
}

/* The third component of a vector of space, of the second corner of a box where the first has none;
 * 0: the row has none. */
static double third_of(const struct param *row, const void *element)
{
    const void *at = (const char *)element + row->offset;
    switch (row->type) {
    case PARAM_REALS:
        return row->numbers ? 0.0 : ((const double *)at)[2];
    case PARAM_BOX:
        return ((const double *)at)[2] != 0.0 ? ((const double *)at)[2] : ((const double *)at)[5];
    case PARAM_INTS:
        return ((const int *)at)[2] - 1;
    case PARAM_BOOLS:
        return ((const bool *)at)[2];
    default:
        return 0.0;
    }
}

/* A component along an axis that the case does not have is a mistake. */
static void check_third(const struct walk *w, const char *key, const struct param *row,
                        const void *element)
{
    const double third = w->planar && params_given(w->p, key) ? third_of(row, element) : 0.0;
    if (third != 0.0 && row->type == PARAM_REALS)
        params_fault(w->p, w->f, key,
                     "z component %g in a case of 2 dimensions: two numbers, or domain.dim = 3",
                     third);
    else if (third != 0.0)
        params_fault(w->p, w->f, key, "z in a case of 2 dimensions: leave it out");
}

/* Lists that are used at all are gone into. */
static void check_rows(const struct walk *w, const char *path, const struct param *rows, int nrows,
                       const void *element)
{
    for (int r = 0; r < nrows; r++) {
        const struct param_list *l = rows[r].list;
        const char *at = (const char *)element + rows[r].offset;
        char key[160];
        snprintf(key, sizeof key, "%s.%s", path, rows[r].key);
        const bool used = check_row(w, key, rows, nrows, rows + r, element);
        check_third(w, key, rows + r, element);
        const int n = l && used && params_given(w->p, key) ? *(const int *)(const void *)at : 0;
        for (int k = 0; k < n; k++) {
            if (l->max > 1)
                snprintf(key, sizeof key, "%s.%s.[%d]", path, rows[r].key, k);
            check_rows(w, key, l->rows, l->nrows, at + l->first + l->stride * (size_t)k);
        }
    }
}

static void check_groups(const struct walk *w, const struct param_group *groups, int ngroups)
{
    for (int k = 0; k < ngroups; k++) {
        const struct param_group *g = groups + k;
        const char *at = g->target;
        char path[80];
        if (!g->stride)
            check_rows(w, g->name, g->rows, g->nrows, at);
        for (int e = 0; g->stride && e < *g->count; e++) {
            snprintf(path, sizeof path, "%s.[%d]", g->name, e);
            check_rows(w, path, g->rows, g->nrows, at + g->stride * (size_t)e);
        }
    }
}

void params_check_use(const struct params *p, const struct param_group *groups, int ngroups,
                      const unsigned long long *facts, const void *context, struct faults *f)
{
    check_groups(&(struct walk){p, facts, context, f, false}, groups, ngroups);
}

void params_check_plane(const struct params *p, const struct param_group *groups, int ngroups,
                        struct faults *f)
{
    check_groups(&(struct walk){p, NULL, NULL, f, true}, groups, ngroups);
}

/* --- in words --- */

static void add(char *to, size_t size, const char *before, const char *text, int length)
{
    text_add(to, size, "%s%.*s", before, length, text);
}

/* "form = box or disc", "form other than mesh". */
static void add_choices(char *to, size_t size, const struct param *row, unsigned choices)
{
    int k = 0, left_out = 0;
    for (const char *c = row->choices; *c; c += *c == '|', k++, c += strcspn(c, "|"))
        left_out += !(choices >> k & 1u);
    const bool all_but = left_out == 1;
    const char *before = all_but ? " other than " : " = ";
    add(to, size, "", row->key, (int)strlen(row->key));
    k = 0;
    for (const char *c = row->choices; *c; c += *c == '|', k++) {
        const int length = (int)strcspn(c, "|");
        if ((choices >> k & 1u) != all_but) {
            add(to, size, before, c, length);
            before = " or ";
        }
        c += length;
    }
}

/* The choices that all conditions on the key of u leave; 0 if u is not the first of them. */
static unsigned choices_left(const struct param_use *uses, const struct param_use *u)
{
    unsigned left = ~0u;
    for (const struct param_use *v = uses; v->why; v++) {
        const bool same = v->choices && !v->facts && strcmp(v->key, u->key) == 0;
        if (same && v < u)
            return 0;
        left &= same ? v->choices : ~0u;
    }
    return left;
}

static void add_condition(char *to, size_t size, const struct param *rows, int nrows,
                          const struct param_use *uses, const struct param_use *u)
{
    const struct param *key = row_of(rows, nrows, u->key);
    const unsigned left = !u->choices ? 0 : u->facts ? u->choices : choices_left(uses, u);
    const char *before = *to ? "; " : "";
    if (u->words || left || (key && !u->choices))
        add(to, size, before, "", 0);
    if (u->words)
        add(to, size, "", u->words, (int)strlen(u->words));
    if (u->words && key)
        add(to, size, " or ", "", 0);
    if (key && left)
        add_choices(to, size, key, left);
    else if (key && !u->choices)
        add(to, size, u->without ? "without " : "with ", u->key, (int)strlen(u->key));
}

/* Static memory, until the next call. */
const char *params_use_words(const struct param *rows, int nrows, const struct param *row)
{
    static char text[800];
    text[0] = '\0';
    for (const struct param_use *u = row->uses; u && u->why; u++)
        add_condition(text, sizeof text, rows, nrows, row->uses, u);
    return text;
}
