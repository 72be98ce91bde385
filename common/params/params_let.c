/* params_let.c - see params_let.h. The library muparser computes; what it finds of a text hangs at
 * the setting (libconfig's hook), for only the reader of a row knows whether a number is wanted.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "params_let.h"

#include <ctype.h>
#include <muParserDLL.h>

#include "../base/base.h"
#include "params_hints.h"
#include "params_value.h"

enum { LET_MAX = 64, UNASSIGNABLE_TOKEN = 1 };

struct variable {
    const char *name;          /* borrowed from the case */
    const config_setting_t *s; /* its place in the case */
    double value;
    bool used;
};

struct let {
    muParserHandle_t parser;
    const char *path;              /* borrowed */
    const config_setting_t *group; /* the case's group let; NULL: it has none */
    int n;
    struct variable of[LET_MAX];
};

/* What is known of a text: its value, or why it has none. */
struct expression {
    bool good;
    double value;
    char why[400];
};

static void free_expression(void *e) { mem_free(e); }

static void place_of(const struct let *l, const config_setting_t *s, const char *name, char *place,
                     size_t size)
{
    param_place(s, l->path, key_text("let.%s", name), place, size);
}

/* "known here: H, n", for a message. */
static void say_known(const struct let *l, char *to, size_t size)
{
    snprintf(to, size, l->n ? "known here: " : "no variable is defined (group let)");
    for (int k = 0; k < l->n && strlen(to) + 70 < size; k++)
        text_add(to, size, "%s%s", k ? ", " : "", l->of[k].name);
}

/* Why muparser did not take the text. */
static void explain(const struct let *l, const char *text, struct expression *e)
{
    char known[200], token[64];
    const int code = mupGetErrorCode(l->parser);
    snprintf(token, sizeof token, "%s", mupGetErrorToken(l->parser));
    if (code == UNASSIGNABLE_TOKEN && (isalpha((unsigned char)*token) || *token == '_')) {
        struct hint_nearest near = hint_nearest_start(token);
        for (int k = 0; k < l->n; k++)
            hint_nearest_try(&near, l->of[k].name);
        const char *word = hint_nearest_word(&near);
        const bool below = l->group && config_setting_get_member(l->group, token);
        say_known(l, known, sizeof known);
        if (below)
            snprintf(known, sizeof known, "let.%s stands below: put it above", token);
        snprintf(e->why, sizeof e->why, "`%s' in \"%.80s\" is not known%s%s%s; %s", token, text,
                 word ? ": did you mean `" : "", word ? word : "", word ? "'?" : "", known);
    } else {
        snprintf(e->why, sizeof e->why, "\"%.80s\" is no expression: %.200s", text,
                 mupGetErrorMsg(l->parser));
        e->why[strcspn(e->why, "\n")] = '\0';
    }
}

/* Those that the parser has met in the expression of before. */
static void mark_used(struct let *l)
{
    const int n = mupGetExprVarNum(l->parser);
    for (int k = 0; k < n; k++) {
        const muChar_t *name = NULL;
        muFloat_t *at = NULL;
        mupGetExprVar(l->parser, (unsigned)k, &name, &at);
        for (int i = 0; i < l->n; i++)
            l->of[i].used = l->of[i].used || at == &l->of[i].value;
    }
}

/* Computes the text of one setting and hangs the result there. */
static void compute(struct let *l, config_setting_t *s)
{
    const char *text = config_setting_get_string(s);
    struct expression *e = NEW(struct expression, 1);
    mupErrorReset(l->parser);
    mupSetExpr(l->parser, text);
    e->value = mupEval(l->parser);
    e->good = !mupError(l->parser);
    if (!e->good)
        explain(l, text, e);
    else if (!isfinite(e->value))
        snprintf(e->why, sizeof e->why, "\"%.80s\" is %g", text, e->value);
    e->good = e->good && isfinite(e->value);
    if (e->good)
        mark_used(l);
    mem_free(config_setting_get_hook(s));
    config_setting_set_hook(s, e);
}

static void compute_all(struct let *l, config_setting_t *s)
{
    const char *name = config_setting_name(s);
    if (name && config_setting_parent(s) && config_setting_is_root(config_setting_parent(s)) &&
        strcmp(name, "let") == 0)
        return; /* done, each with those above it */
    if (config_setting_type(s) == CONFIG_TYPE_STRING)
        compute(l, s);
    for (int k = 0; config_setting_is_aggregate(s) && k < config_setting_length(s); k++)
        compute_all(l, config_setting_get_elem(s, (unsigned)k));
}

/* false without a cause: it is no text, or nobody has computed it. */
bool let_value(const config_setting_t *s, double *v, const char **why)
{
    const struct expression *e =
        config_setting_type(s) == CONFIG_TYPE_STRING ? config_setting_get_hook(s) : NULL;
    if (why)
        *why = e && !e->good ? e->why : NULL;
    if (e && e->good)
        *v = e->value;
    return e && e->good;
}

/* What the command line gives for a variable; NULL: nothing. The last one counts. */
static config_setting_t *given_for(const char *name, struct override *o, int n)
{
    config_setting_t *found = NULL;
    for (int k = 0; k < n; k++)
        if (strcmp(o[k].group, "let") == 0 && strcmp(o[k].key, name) == 0) {
            o[k].used = true;
            found = config_lookup(&o[k].cfg, "value");
        }
    return found;
}

static bool is_name(const char *s)
{
    return (isalpha((unsigned char)*s) || *s == '_') && strchr(s, '-') == NULL &&
           strchr(s, '*') == NULL;
}

/* Variables are defined in their order, each from those above it. One at fault is defined, too, so
 * that its uses are no faults of their own. */
static void define(struct let *l, config_setting_t *s, config_setting_t *given, struct faults *f)
{
    char place[1300];
    struct variable *v = l->of + l->n;
    const char *why = NULL;
    v->name = config_setting_name(s);
    v->s = s;
    place_of(l, s, v->name, place, sizeof place);
    if (given)
        snprintf(place, sizeof place, "command line: -p let.%s", v->name);
    else
        given = s;
    if (config_setting_type(given) == CONFIG_TYPE_STRING)
        compute(l, given);
    if (!is_name(v->name)) {
        params_add_fault(f, place, "a variable's name is of letters, digits and _");
    } else if (!param_number(given, &v->value)) {
        (void)let_value(given, &v->value, &why);
        params_add_fault(f, place, "%s", why ? why : "expected a number or an expression");
    }
    mupErrorReset(l->parser);
    mupDefineVar(l->parser, v->name, &v->value);
    if (is_name(v->name) && mupError(l->parser))
        params_add_fault(f, place, "is the name of a function or a constant of expressions");
    l->n++;
}

/* Variables of the command line that the case has not, and those that no expression names. */
static void find_strays(const struct let *l, const struct override *o, int n, int before,
                        struct faults *f)
{
    char place[1300], known[200];
    for (int k = 0; k < n; k++) {
        if (strcmp(o[k].group, "let") != 0 || o[k].used || !*o[k].key)
            continue;
        say_known(l, known, sizeof known);
        snprintf(place, sizeof place, "command line: -p %s: let.%s", o[k].text, o[k].key);
        params_add_fault(f, place, "no such variable in the case; %s", known);
    }
    for (int k = 0; k < l->n && f->n == before; k++) {
        place_of(l, l->of[k].s, l->of[k].name, place, sizeof place);
        if (!l->of[k].used)
            params_add_fault(f, place, "is not used: no expression names this variable");
    }
}

static void read_variables(struct let *l, config_setting_t *group, struct override *o, int n,
                           struct faults *f)
{
    char place[1300];
    snprintf(place, sizeof place, "%s:%u: let", l->path, config_setting_source_line(group));
    if (!config_setting_is_group(group)) {
        params_add_fault(f, place, "expected a group { H = 0.3; ... }");
        return;
    }
    if (config_setting_length(group) > LET_MAX) {
        params_add_fault(f, place, "at most %d variables", LET_MAX);
        return;
    }
    l->group = group;
    for (int k = 0; k < config_setting_length(group); k++) {
        config_setting_t *s = config_setting_get_elem(group, (unsigned)k);
        define(l, s, given_for(config_setting_name(s), o, n), f);
    }
}

/* Values of the command line are expressions of the case's variables. */
struct let *let_read(config_t *cfg, const char *path, struct override *o, int noverrides,
                     struct faults *f)
{
    struct let *l = NEW(struct let, 1);
    config_setting_t *group = config_lookup(cfg, "let");
    const int before = f->n;
    l->path = path;
    l->parser = mupCreate(muBASETYPE_FLOAT);
    mupSetErrorHandler(l->parser, NULL);
    mupDefineConst(l->parser, "pi", M_PI);
    config_set_destructor(cfg, free_expression);
    for (int k = 0; k < noverrides; k++)
        config_set_destructor(&o[k].cfg, free_expression);
    if (group)
        read_variables(l, group, o, noverrides, f);
    compute_all(l, config_root_setting(cfg));
    for (int k = 0; k < noverrides; k++)
        if (strcmp(o[k].group, "let") != 0)
            compute_all(l, config_root_setting(&o[k].cfg));
    find_strays(l, o, noverrides, before, f);
    return l;
}

void let_free(struct let **l)
{
    if (!*l)
        return;
    mupRelease((*l)->parser);
    mem_free(*l);
    *l = NULL;
}

/* As a comment: the values that follow hold the results. */
void let_print(FILE *to, const struct let *l)
{
    char text[32];
    for (int k = 0; l && k < l->n; k++)
        fprintf(to, "%s%.80s = %s", k ? ", " : "# let: ", l->of[k].name,
                param_real(l->of[k].value, text));
    if (l && l->n > 0)
        fputs("\n", to);
}
