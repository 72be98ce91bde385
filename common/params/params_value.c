/* params_value.c - values of the parameter table: from libconfig settings into the members of a
 * struct. SPDX-License-Identifier: BSD-3-Clause */
#include "params_value.h"

#include "../base/base.h"
#include "params_hints.h"
#include "params_let.h"

/* Texts are numbers where they were computed as expressions. */
bool param_number(const config_setting_t *s, double *v)
{
    switch (config_setting_type(s)) {
    case CONFIG_TYPE_INT:
        *v = config_setting_get_int(s);
        return true;
    case CONFIG_TYPE_INT64:
        *v = (double)config_setting_get_int64(s);
        return true;
    case CONFIG_TYPE_FLOAT:
        *v = config_setting_get_float(s);
        return true;
    default:
        return let_value(s, v, NULL);
    }
}

const char *param_real(double v, char text[32])
{
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, 32, "%.*g", digits, v);
        if (strtod(text, NULL) == v)
            break;
    }
    return text;
}

void param_place(const config_setting_t *s, const char *path, const char *name, char *place,
                 size_t size)
{
    const char *file = s ? config_setting_source_file(s) : NULL;
    const unsigned line = s ? config_setting_source_line(s) : 0;
    if (s && line == 0)
        snprintf(place, size, "command line: %s", name);
    else if (s)
        snprintf(place, size, "%s:%u: %s", file ? file : path, line, name);
    else
        snprintf(place, size, "%s: %s", path, name);
}

/* Component k of the member; bounds were looked at. */
static void set_real(const struct param *r, void *target, int k, double v)
{
    char *at = (char *)target + r->offset;
    if (r->type == PARAM_INT || r->type == PARAM_CHOICE)
        *(int *)(void *)at = (int)v;
    else if (r->type == PARAM_INTS)
        ((int *)(void *)at)[k] = (int)v;
    else
        ((double *)(void *)at)[k] = v;
}

static bool is_integer(const struct param *r)
{
    return r->type == PARAM_INT || r->type == PARAM_INTS;
}

/* With what is wrong with an expression. */
static void not_a_number(const struct param *r, const config_setting_t *s, char *why, size_t size)
{
    const char *unit = strcmp(r->unit, "-") ? r->unit : "", *cause = NULL;
    double v;
    (void)let_value(s, &v, &cause);
    snprintf(why, size, "expected a plain number%s%s%s%s", *unit ? " in " : "", unit,
             cause ? " or an expression: " : "", cause ? cause : "");
}

/* "0.3/0.1" is 2.9999999999999996. */
static double nearly_whole(double v)
{
    return fabs(v - round(v)) < 1e-9 * fmax(1.0, fabs(v)) ? round(v) : v;
}

/* Reads one number into component k; what is wrong with it goes to why. */
static bool get_number(const struct param *r, const config_setting_t *s, void *target, int k,
                       char *why, size_t size)
{
    double v;
    if (!param_number(s, &v)) {
        not_a_number(r, s, why, size);
        return false;
    }
    if (is_integer(r) && config_setting_type(s) == CONFIG_TYPE_STRING)
        v = nearly_whole(v);
    if (is_integer(r) && (v != floor(v) || fabs(v) > 2147483647.0)) {
        snprintf(why, size, "%g is not a whole number", v);
        return false;
    }
    if (!(v >= r->min && v <= r->max)) {
        snprintf(why, size, "%g is not allowed: from %g to %g%s%s", v, r->min, r->max,
                 strcmp(r->unit, "-") ? " " : "", strcmp(r->unit, "-") ? r->unit : "");
        return false;
    }
    set_real(r, target, k, v);
    return true;
}

/* The index of the word among the choices. */
static bool get_choice(const struct param *r, const config_setting_t *s, void *target, char *why,
                       size_t size)
{
    const char *word = config_setting_get_string(s);
    const size_t n = word ? strlen(word) : 0;
    int k = 0;
    for (const char *c = r->choices; word; k++) {
        const char *end = strchr(c, '|');
        const size_t m = end ? (size_t)(end - c) : strlen(c);
        if (m == n && strncmp(c, word, n) == 0) {
            set_real(r, target, 0, k);
            return true;
        }
        if (!end)
            break;
        c = end + 1;
    }
    char hint[120] = "";
    if (word)
        hint_choice(r->choices, word, hint, sizeof hint);
    snprintf(why, size, "%s%s%sexpected one of %s%s", word ? "`" : "", word ? word : "",
             word ? "' is not known: " : "", r->choices, hint);
    return false;
}

/* The rest is set to 0, for ranks get bytes and defaults are compared by them. */
static bool get_text(const struct param *r, const config_setting_t *s, void *target, char *why,
                     size_t size)
{
    const char *word = config_setting_get_string(s);
    if (!word || strlen(word) >= PARAM_TEXT_SIZE) {
        snprintf(why, size, "expected text in quotes, at most %d characters", PARAM_TEXT_SIZE - 1);
        return false;
    }
    memset((char *)target + r->offset, 0, PARAM_TEXT_SIZE);
    memcpy((char *)target + r->offset, word, strlen(word));
    return true;
}

static bool get_bool(const config_setting_t *s, bool *to, char *why, size_t size)
{
    if (config_setting_type(s) != CONFIG_TYPE_BOOL) {
        snprintf(why, size, "expected true or false");
        return false;
    }
    *to = config_setting_get_bool(s);
    return true;
}

/* (a, b) or (a, b, c): components from `first' on; the rest keeps `rest'. */
static bool get_vector(const struct param *r, const config_setting_t *s, void *target, int first,
                       char *why, size_t size)
{
    const int n = config_setting_is_aggregate(s) ? config_setting_length(s) : 0;
    bool *flags = (bool *)(void *)((char *)target + r->offset);
    const int most = r->type == PARAM_REALS && r->numbers ? r->numbers : 3;
    if (config_setting_is_group(s) || n < 2 || n > most) {
        snprintf(why, size, "expected two%s %s in ( )%s", most == 3 ? " or three" : "",
                 r->type == PARAM_BOOLS ? "truth values" : "numbers",
                 n > most ? ": there are too many" : "");
        return false;
    }
    for (int k = 0; k < 3; k++) {
        const config_setting_t *c = k < n ? config_setting_get_elem(s, (unsigned)k) : NULL;
        if (r->type == PARAM_BOOLS) {
            flags[k] = false;
            if (c && !get_bool(c, flags + k, why, size))
                return false;
        } else if (!c) {
            set_real(r, target, first + k, r->type == PARAM_INTS ? 1.0 : 0.0);
        } else if (!get_number(r, c, target, first + k, why, size)) {
            return false;
        }
    }
    return true;
}

static bool get_box(const struct param *r, const config_setting_t *s, void *target, char *why,
                    size_t size)
{
    if (config_setting_is_group(s) || !config_setting_is_aggregate(s) ||
        config_setting_length(s) != 2) {
        snprintf(why, size, "expected two corners: ((x, y), (x, y))");
        return false;
    }
    return get_vector(r, config_setting_get_elem(s, 0), target, 0, why, size) &&
           get_vector(r, config_setting_get_elem(s, 1), target, 3, why, size);
}

/* One point of a list: as many finite numbers as it has components; more of them are 0. */
static bool get_point(const struct param *r, const config_setting_t *s, int dim, double *v)
{
    const int n = config_setting_is_aggregate(s) ? config_setting_length(s) : 0;
    for (int a = 0; a < dim; a++) {
        const config_setting_t *c = a < n ? config_setting_get_elem(s, (unsigned)a) : NULL;
        if (!c || !param_number(c, v + a) || !(v[a] >= r->min && v[a] <= r->max))
            return false;
    }
    for (int a = dim; a < n; a++) {
        double more = 1.0;
        if (!param_number(config_setting_get_elem(s, (unsigned)a), &more) || more != 0.0)
            return false;
    }
    return true;
}

/* Why one of the numbers of a point is no expression; NULL: they all are, or none is a text. */
static const char *cause_within(const config_setting_t *s)
{
    const char *cause = NULL;
    double v;
    for (int a = 0; config_setting_is_aggregate(s) && a < config_setting_length(s) && !cause; a++)
        (void)let_value(config_setting_get_elem(s, (unsigned)a), &v, &cause);
    return cause;
}

/* ((x, y), (x, y), ...): at most PARAM_POINTS_MAX; with three components PARAM_PLACES_MAX. */
static bool get_points(const struct param *r, const config_setting_t *s, void *target, char *why,
                       size_t size)
{
    const bool plane = r->type == PARAM_POINTS;
    const int dim = plane ? 2 : 3, most = plane ? PARAM_POINTS_MAX : PARAM_PLACES_MAX;
    struct param_points *points = (struct param_points *)(void *)((char *)target + r->offset);
    struct param_places *places = (struct param_places *)(void *)((char *)target + r->offset);
    const int n = config_setting_is_aggregate(s) ? config_setting_length(s) : -1;
    int *count = plane ? &points->n : &places->n;
    *count = 0;
    if (config_setting_is_group(s) || n < 0 || n > most) {
        snprintf(why, size, "expected at most %d points: ((x, y%s), ...)%s", most,
                 plane ? "" : ", z",
                 config_setting_type(s) == CONFIG_TYPE_STRING ? "; a file is read by outline" : "");
        return false;
    }
    for (int k = 0; k < n; k++) {
        double *v = plane ? points->x[k] : places->x[k];
        if (!get_point(r, config_setting_get_elem(s, (unsigned)k), dim, v)) {
            const char *cause = cause_within(config_setting_get_elem(s, (unsigned)k));
            snprintf(why, size, "point %d: expected %s numbers in ( ) from %g to %g%s%s", k + 1,
                     plane ? "two" : "three", r->min, r->max, cause ? ": " : "",
                     cause ? cause : "");
            return false;
        }
    }
    *count = n;
    return true;
}

/* A number, or (a, b, ...): at most PARAM_NUMBERS_MAX. */
static bool get_numbers(const struct param *r, const config_setting_t *s, void *target, char *why,
                        size_t size)
{
    struct param_numbers *to = (struct param_numbers *)(void *)((char *)target + r->offset);
    const bool many = config_setting_is_aggregate(s) && !config_setting_is_group(s);
    struct param one = *r;
    one.type = PARAM_REALS;
    one.offset += offsetof(struct param_numbers, v);
    memset(to, 0, sizeof *to);
    if (many && config_setting_length(s) > PARAM_NUMBERS_MAX) {
        snprintf(why, size, "expected at most %d numbers in ( )", PARAM_NUMBERS_MAX);
        return false;
    }
    to->n = many ? config_setting_length(s) : 1;
    for (int k = 0; k < to->n; k++)
        if (!get_number(&one, many ? config_setting_get_elem(s, (unsigned)k) : s, target, k, why,
                        size))
            return false;
    return true;
}

/* A plain number turns about z. */
static bool get_turn(const struct param *r, const config_setting_t *s, void *target, char *why,
                     size_t size)
{
    double v;
    if (!param_number(s, &v))
        return get_vector(r, s, target, 0, why, size);
    set_real(r, target, 0, 0.0);
    set_real(r, target, 1, 0.0);
    return get_number(r, s, target, 2, why, size);
}

bool param_read(const struct param *r, const config_setting_t *s, void *target, char *why,
                size_t size)
{
    switch (r->type) {
    case PARAM_REAL:
    case PARAM_INT:
        return get_number(r, s, target, 0, why, size);
    case PARAM_BOOL:
        return get_bool(s, (bool *)(void *)((char *)target + r->offset), why, size);
    case PARAM_CHOICE:
        return get_choice(r, s, target, why, size);
    case PARAM_TEXT:
        return get_text(r, s, target, why, size);
    case PARAM_REALS:
    case PARAM_INTS:
    case PARAM_BOOLS:
        return get_vector(r, s, target, 0, why, size);
    case PARAM_TURN:
        return get_turn(r, s, target, why, size);
    case PARAM_NUMBERS:
        return get_numbers(r, s, target, why, size);
    case PARAM_POINTS:
    case PARAM_PLACES:
        return get_points(r, s, target, why, size);
    default:
        return get_box(r, s, target, why, size);
    }
}

void param_default_of(const struct param_group *g, const struct param *r, void *target, int k)
{
    param_default(g, r, target);
    if (r->type != PARAM_TEXT || !r->dflt)
        return;
    char *text = (char *)target + r->offset, *number = strchr(text, '#');
    if (number && k > 0)
        snprintf(number, (size_t)(text + PARAM_TEXT_SIZE - number), "%d", k + 1);
    else if (number)
        *number = 0;
}

/* A default is text of the table: it goes through the same reader as a value of a case. */
void param_default(const struct param_group *g, const struct param *r, void *target)
{
    char line[512], why[256];
    config_t c;
    if (r->type == PARAM_LIST) {
        char *list = (char *)target + r->offset, *first = list + r->list->first;
        memset(list, 0, param_size(r));
        for (int i = 0; i < r->list->nrows; i++)
            param_default(g, r->list->rows + i, first);
        for (int k = 1; k < r->list->max; k++) /* to parse all took 17 ms */
            memcpy(first + r->list->stride * k, first, r->list->stride);
        return;
    }
    if (!r->dflt)
        return;
    config_init(&c);
    config_set_auto_convert(&c, CONFIG_TRUE);
    const bool text = r->type == PARAM_CHOICE || r->type == PARAM_TEXT;
    snprintf(line, sizeof line, text ? "value = \"%s\";" : "value = %s;", r->dflt);
    if (config_read_string(&c, line) != CONFIG_TRUE)
        abort_run("default of %s.%s is not a value: %s", g->name, r->key, r->dflt);
    struct param any = *r; /* a default may lie outside the range: "not given" */
    any.min = -INFINITY;
    any.max = INFINITY;
    if (!param_read(&any, config_lookup(&c, "value"), target, why, sizeof why))
        abort_run("default of %s.%s: %s", g->name, r->key, why);
    config_destroy(&c);
}
