/* params_hints.c - see params_hints.h. SPDX-License-Identifier: BSD-3-Clause */
#include "params_hints.h"

#include <ctype.h>
#include <regex.h>

#include "../base/base.h"

size_t param_size(const struct param *r)
{
    switch (r->type) {
    case PARAM_REAL:
        return sizeof(double);
    case PARAM_INT:
    case PARAM_CHOICE:
        return sizeof(int);
    case PARAM_BOOL:
        return sizeof(bool);
    case PARAM_TEXT:
        return PARAM_TEXT_SIZE;
    case PARAM_POINTS:
        return sizeof(struct param_points);
    case PARAM_PLACES:
        return sizeof(struct param_places);
    case PARAM_REALS:
    case PARAM_TURN:
        return 3 * sizeof(double);
    case PARAM_NUMBERS:
        return sizeof(struct param_numbers);
    case PARAM_INTS:
        return 3 * sizeof(int);
    case PARAM_BOOLS:
        return 3 * sizeof(bool);
    case PARAM_LIST:
        return r->list->first + r->list->stride * (size_t)r->list->max;
    default:
        return 6 * sizeof(double);
    }
}

static bool same_letter(char a, char b)
{
    return tolower((unsigned char)a) == tolower((unsigned char)b);
}

/* Edit distance with swaps of neighbours (optimal string alignment); capitals count as small. */
static int distance(const char *a, const char *b)
{
    enum { MOST = 48 };
    const int n = (int)strlen(a), m = (int)strlen(b);
    int d[MOST + 1][MOST + 1];
    if (n > MOST || m > MOST)
        return MOST;
    for (int i = 0; i <= n; i++)
        d[i][0] = i;
    for (int j = 0; j <= m; j++)
        d[0][j] = j;
    for (int i = 1; i <= n; i++)
        for (int j = 1; j <= m; j++) {
            int least = d[i - 1][j - 1] + !same_letter(a[i - 1], b[j - 1]);
            least = d[i - 1][j] + 1 < least ? d[i - 1][j] + 1 : least;
            least = d[i][j - 1] + 1 < least ? d[i][j - 1] + 1 : least;
            if (i > 1 && j > 1 && same_letter(a[i - 1], b[j - 2]) &&
                same_letter(a[i - 2], b[j - 1]) && d[i - 2][j - 2] + 1 < least)
                least = d[i - 2][j - 2] + 1;
            d[i][j] = least;
        }
    return d[n][m];
}

struct hint_nearest hint_nearest_start(const char *word)
{
    const int third = (int)strlen(word) / 3, most = third > 1 ? third : 1;
    return (struct hint_nearest){.word = word, .distance = most + 1};
}

/* The first of the nearest stays. */
void hint_nearest_try(struct hint_nearest *n, const char *known)
{
    const int d = distance(n->word, known);
    if (d < n->distance) {
        n->distance = d;
        n->best = known;
    }
}

const char *hint_nearest_word(const struct hint_nearest *n) { return n->best; }

/* What a newcomer calls a key, from other codes and papers: the first of a word whose key a group
 * has is meant. A word without a key is of what these programs do not have; the remark says so. */
static const struct hint_name names[] = {{"density", "rho", ""},
                                         {"rho0", "rho", ""},
                                         {"viscosity", "nu", " (m^2/s)"},
                                         {"mu", "nu", " = mu/rho"},
                                         {"g", "gravity", ""},
                                         {"endTime", "end", ""},
                                         {"t_end", "end", ""},
                                         {"duration", "end", ""},
                                         {"type", "kind", ""},
                                         {"kind", "mapping", ""},
                                         {"type", "mapping", ""},
                                         {"r", "radius", ""},
                                         {"patch", "side", ""},
                                         {"size", "max", ""},
                                         {"box", "min", " and `max'"},
                                         {"box", "max", ""},
                                         {"position", "at", ""},
                                         {"location", "at", ""},
                                         {"place", "at", ""},
                                         {"floating", "free", ""},
                                         {"vertices", "points", ""},
                                         {"wavelength", "length", ""},
                                         {"H", "height", ""},
                                         {"T", "period", ""},
                                         {"dt", "every", ""},
                                         {"interval", "every", ""},
                                         {"writeInterval", "every", ""},
                                         {"dp", "dx", ""},
                                         {"spacing", "dx", ""},
                                         {"resolution", "dx", ""},
                                         {"cells", "dx", ""},
                                         {"h", "R_dx", ": the kernel's support R over dx"},
                                         {"smoothing", "R_dx", ": the kernel's support R over dx"},
                                         {"smoothing_length", "R_dx", ": R over dx"},
                                         {"dx", "cells", ""},
                                         {"resolution", "cells", ""},
                                         {"deltaT", "cfl", ""},
                                         {"dt", "cfl", ""},
                                         {"maxCo", "cfl", ""},
                                         {"courant", "cfl", ""},
                                         {"nx", "cells", " = (nx, ny)"},
                                         {"ny", "cells", " = (nx, ny)"},
                                         {"nz", "cells", " = (nx, ny, nz)"},
                                         {"dt", "steps", ": particles' steps in an exchange"},
                                         {"window", "steps", ": particles' steps in an exchange"},
                                         {"dt", "end", ": the programs choose their steps"},
                                         {"start", "end", ": a run starts at t = 0"},
                                         {"amplitude", "height", " from trough to crest"},
                                         {"gamma", "peak", ": JONSWAP's gamma"},
                                         {"frequency", "period", " = 1/frequency"},
                                         {"omega", "period", " = 2 pi/omega"},
                                         {"disc", "radius", ""},
                                         {"circle", "radius", ""},
                                         {"diameter", "radius", " = diameter/2"},
                                         {"depth", "level", ""},
                                         {"file", "mesh", " (STL, OBJ, PLY), `outline' in 2D"},
                                         {"fixed", "free", ": without it a body is fixed"},
                                         {"dof", "lock", ": degrees of freedom taken out"},
                                         {"spring", "lines", ""},
                                         {"moorings", "lines", ""},
                                         {"speed", "velocity", ""},
                                         {"length", "beach", ": of the zone"},
                                         {"kernel", NULL,
                                          "the kernel is Wendland's C2; R_dx is "
                                          "its support over dx"},
                                         {"sigma", NULL, "there is no surface tension"},
                                         {"surface_tension", NULL, "there is no surface tension"},
                                         {"rho_air", NULL, "air has no density: its pressure is 0"},
                                         {"turbulence", NULL, "there are no turbulence models"}};

const struct hint_name *hint_name_next(const char *word, const struct hint_name *after)
{
    const struct hint_name *end = names + sizeof names / sizeof names[0];
    for (after = after ? after + 1 : names; after < end; after++)
        if (strcmp(after->word, word) == 0)
            return after;
    return NULL;
}

/* Likewise of values; the first of a word that a row has is meant, or a remark tells what is. */
static const struct hint_name values[] = {
    {"no_slip", "wall", ""},
    {"noslip", "wall", ""},
    {"wall", "no_slip", ""},
    {"solid", "no_slip", ""},
    {"inlet", "inflow", ""},
    {"outlet", "outflow", ""},
    {"open", "outflow", ""},
    {"free", "outflow", ""},
    {"symmetry", "slip", ""},
    {"left", "x_min", ""},
    {"right", "x_max", ""},
    {"circle", "disc", ""},
    {"cylinder", "disc", ""},
    {"rectangle", "box", ""},
    {"height", "level", ""},
    {"elevation", "level", ""},
    {"flux", "discharge", ""},
    {"flow", "discharge", ""},
    {"p", "pressure", ""},
    {"implicit", "newton", ""},
    {"rk4", "rk3", ""},
    {"ring", "annulus", ""},
    {"atmosphere", "outflow", ""},
    {"sine", "harmonic", ""},
    {"csv", "file", ""},
    {"stokes", "regular", ""},
    {"airy", "regular", ""},
    {"linear", "regular", ""},
    {"jonswap", "sea", ""},
    {"irregular", "sea", ""},
    {"sponge", "beach", ""},
    {"damping", "beach", ""},
    {"periodic", NULL, "a period is domain.periodic"},
    {"piston", NULL, "a paddle is a body that moves, of motion.kind \"waves\""}};

/* Whether `choices', words between |, has this one. */
static bool has_choice(const char *choices, const char *word)
{
    const size_t n = strlen(word);
    for (const char *c = strstr(choices, word); c; c = strstr(c + 1, word))
        if ((c == choices || c[-1] == '|') && (c[n] == '|' || c[n] == '\0'))
            return true;
    return false;
}

/* Words that newcomers use first, then slips of the pen. */
void hint_choice(const char *choices, const char *word, char *text, size_t size)
{
    const char *best = NULL;
    char one[64];
    const char *remark = NULL;
    for (size_t k = 0; k < sizeof values / sizeof values[0] && !best; k++)
        if (strcmp(values[k].word, word) == 0 && !values[k].key)
            remark = values[k].remark;
        else if (strcmp(values[k].word, word) == 0 && has_choice(choices, values[k].key))
            best = values[k].key;
    int least = hint_nearest_start(word).distance;
    snprintf(text, size,
             best     ? "; did you mean `%s'?"
             : remark ? "; %s"
                      : "",
             best ? best : remark);
    for (const char *c = choices; *c && !best && !remark; c += strcspn(c, "|"), c += *c == '|') {
        struct hint_nearest near = hint_nearest_start(word);
        snprintf(one, sizeof one, "%.*s", (int)strcspn(c, "|"), c);
        hint_nearest_try(&near, one);
        if (near.distance < least)
            snprintf(text, size, "; did you mean `%s'?", one);
        least = near.distance < least ? near.distance : least;
    }
}

bool hint_has_key(const struct param_group *g, const char *key)
{
    for (int k = 0; k < g->nrows; k++)
        if (strcmp(g->rows[k].key, key) == 0)
            return true;
    return false;
}

const char *hint_meant(const struct param_group *g, const char *key, const char **remark)
{
    *remark = "";
    for (const struct hint_name *n = hint_name_next(key, NULL); n; n = hint_name_next(key, n))
        if (!n->key || hint_has_key(g, n->key)) {
            *remark = n->remark;
            return n->key;
        }
    struct hint_nearest n = hint_nearest_start(key);
    for (int k = 0; k < g->nrows; k++)
        hint_nearest_try(&n, g->rows[k].key);
    return hint_nearest_word(&n);
}

void hint_keys(const struct param_group *g, char *text, size_t size)
{
    *text = '\0';
    for (int k = 0; k < g->nrows; k++)
        text_add(text, size, "%s%s", k ? ", " : "", g->rows[k].key);
}

/* A copy with blanks for comments (of #, //, or between marks) and, unless they are kept, for what
 * stands in quotes, which end with their line: the same places. Owned by the caller. */
static char *bare_copy(const char *text, bool keep_quoted)
{
    enum { BARE, QUOTED, COMMENT, BLOCK } in = BARE;
    char *bare = NEW(char, strlen(text) + 1);
    memcpy(bare, text, strlen(text));
    for (char *c = bare; *c; c++) {
        const bool closes = in == BLOCK && *c == '/' && text[c - bare - 1] == '*';
        if (closes || (in == QUOTED && *c == '"') || (in < BLOCK && *c == '\n'))
            in = BARE;
        else if (in == BARE)
            in = *c == '"'                               ? QUOTED
                 : *c == '#' || strncmp(c, "//", 2) == 0 ? COMMENT
                 : strncmp(c, "/*", 2) == 0              ? BLOCK
                                                         : BARE;
        const bool shown = in == BARE || (in == QUOTED && (keep_quoted || *c == '"'));
        *c = *c == '\n' || (shown && !closes) ? *c : ' ';
    }
    return bare;
}

/* Line `line', from 1; no copy longer than size. */
static const char *line_at(const char *text, int line, char *copy, size_t size)
{
    for (int k = 1; k < line && text; k++) {
        text = strchr(text, '\n');
        text = text ? text + 1 : NULL;
    }
    size_t n = text ? strcspn(text, "\n") : 0;
    while (n > 0 && text[n - 1] == ' ')
        n--;
    snprintf(copy, size, "%.*s", (int)(n < size ? n : size - 1), text ? text : "");
    return copy;
}

/* More ( than ), or less. */
static int open_vectors(const char *s)
{
    int open = 0;
    for (; *s; s++)
        open += (*s == '(') - (*s == ')');
    return open;
}

static const char OPEN_QUOTE[] = "a quote \" is opened and not closed";

static const char *after_blanks(const char *s) { return s + strspn(s, " \t\r"); }

static bool has_open_quote(const char *s)
{
    int n = 0;
    for (; *s; s++)
        n += *s == '"';
    return n % 2 == 1;
}

/* side = x_min: a word that is no truth value and stands in no quotes. */
static bool has_bare_text(const char *s)
{
    for (const char *c = s; *c; c++) {
        if (!strchr("=:", *c))
            continue;
        const char *word = after_blanks(c + 1);
        const size_t n = strcspn(word, " \t\r;,}");
        const bool truth =
            (n == 4 && strncmp(word, "true", 4) == 0) || (n == 5 && strncmp(word, "false", 5) == 0);
        if (isalpha((unsigned char)*word) && !truth)
            return true;
    }
    return false;
}

/* What is likely wrong in a line that has the pattern, a regular expression, or passes the test;
 * most certain first. quoted: the line with what stands in quotes. */
static const struct slip {
    const char *pattern;
    bool (*test)(const char *);
    bool quoted;
    const char *hint;
} slips[] = {
    /* only behind the sign =, as vectors have commas, too */
    {"=[ \t]*[-+0-9]+,[0-9]", .hint = "decimal numbers take a point, as in 0.01"},
    {"\\[.*,", .hint = "use ( ) for vectors: [ ] needs all numbers of one kind"},
    {"[=(, \t[](yes|no|on|off|True|False)([^[:alnum:]]|$)",
     .hint = "truth values are true and false; text stands in quotes"},
    /* a unit is no exponent and no L */
    {"=[ \t]*[-+0-9.eE]+([A-DF-KM-Za-df-z]|[ \t]+[A-KM-Za-z])",
     .hint = "numbers are plain SI, without a unit, as in 0.01"},
    {"[0-9]\\.[0-9]*\\.", .hint = "a number has one point"},
    {.test = has_open_quote, .quoted = true, .hint = OPEN_QUOTE},
    {"[[:alpha:]]\\.[[:alpha:]]",
     .hint = "a key within a group: fv: { cfl = 1.0; }; not fv.cfl = 1.0"},
    {"\xe2\x80(\x9c|\x9d)", .quoted = true,
     .hint = "quotes are straight ones, \", not those of a text program"},
    {"[0-9)][ \t\r]*[*/+]", .hint = "an expression stands in quotes, as in dx = \"0.3/15\""},
    {.test = has_bare_text, .hint = "text stands in quotes, as in kind = \"slip\""},
    {"^[ \t\r]*[[:alpha:]][[:alnum:]_]*[ \t\r]*[{(]",
     .hint = "a name takes : or = before what it holds, as in time: { end = 1.0; };"},
    {",[ \t\r]*[])},;]", .hint = "a comma stands between two values, none after the last"},
    {"[})][ \t\r]*[{(]",
     .hint = "a comma is missing between two elements, as in ( { ... }, { ... } )"},
    {"[0-9.][ \t]+[-+.0-9]", .hint = "a comma is missing between two numbers, as in (0, -9.81)"},
    {"[{][ \t\r]*[{]",
     .hint = "several groups are a list in ( ), as in walls: ( { ... }, { ... } );"},
};

static bool has_pattern(const char *s, const char *pattern)
{
    regex_t compiled;
    require(regcomp(&compiled, pattern, REG_EXTENDED | REG_NOSUB) == 0);
    const bool found = regexec(&compiled, s, 0, NULL, 0) == 0;
    regfree(&compiled);
    return found;
}

/* NULL: nothing that is known. all: the line s with what stands in quotes. */
static const char *slip(const char *s, const char *all)
{
    for (size_t k = 0; k < sizeof slips / sizeof slips[0]; k++) {
        const struct slip *is = slips + k;
        const char *line = is->quoted ? all : s;
        if (is->test ? is->test(line) : has_pattern(line, is->pattern))
            return is->hint;
    }
    return NULL;
}

/* First line of a group that is never closed; 0 if all are. */
static int open_group(const char *bare, char *name, size_t size)
{
    int lines[64], depth = 0, line = 1;
    const char *start[64];
    for (const char *c = bare; *c; c++) {
        line += *c == '\n';
        if (*c == '{' && depth < 64) {
            start[depth] = c;
            lines[depth++] = line;
        } else if (*c == '}' && depth > 0) {
            depth--;
        }
    }
    if (depth == 0)
        return 0;
    const char *end = start[0];
    while (end > bare && !isalpha((unsigned char)end[-1]))
        end--;
    const char *begin = end;
    while (begin > bare && (isalnum((unsigned char)begin[-1]) || begin[-1] == '_'))
        begin--;
    snprintf(name, size, "%.*s", (int)(end - begin), begin);
    return lines[0];
}

/* libconfig often tells the line after the one at fault: that one is looked at first, then the one
 * before. */
static int find_slip(const char *text, const char *bare, int line, const char *error, char *hint,
                     size_t size)
{
    char copy[512], without[512], name[64];
    *hint = '\0';
    if (strstr(error, "include") || strstr(error, "uplicate")) {
        line_at(text, line, copy, sizeof copy);
        snprintf(hint, size, "in the line `%s'", copy + strspn(copy, " \t"));
        return line;
    }
    for (int k = line; k >= line - 1 && k > 0; k--) {
        const char *what =
            slip(line_at(bare, k, without, sizeof without), line_at(text, k, copy, sizeof copy));
        if (what) {
            snprintf(hint, size, "%s", what);
            return k;
        }
    }
    for (int k = 1; k <= line; k++) /* one that swallows the lines below it */
        if (has_open_quote(line_at(text, k, copy, sizeof copy))) {
            snprintf(hint, size, "%s", OPEN_QUOTE);
            return k;
        }
    if (strncmp(text, "\xef\xbb\xbf", 3) == 0)
        snprintf(hint, size, "an included file begins with a mark of UTF-8: save it without");
    const int open = open_group(bare, name, sizeof name);
    if (open > 0)
        snprintf(hint, size, "group `%s', opened at line %d, is not closed", name, open);
    const char *at = after_blanks(line_at(text, line, copy, sizeof copy));
    const int vectors = open_vectors(line_at(bare, line, without, sizeof without));
    if (!*hint)
        snprintf(hint, size, "in or before the line `%s'%s", at,
                 vectors > 0   ? ", which opens more ( than it closes"
                 : vectors < 0 ? ", which closes more ( than it opens"
                               : "");
    return line;
}

int hint_syntax(const char *text, int line, const char *error, char *hint, size_t size)
{
    char *without_comments = bare_copy(text, true), *bare = bare_copy(text, false);
    line = find_slip(without_comments, bare, line, error, hint, size);
    FREE(without_comments, bare);
    return line;
}

/* A 0 counts as no text, too. */
const char *hint_no_text(const char *text, size_t n)
{
    const unsigned char *b = (const unsigned char *)text;
    if (n > 1 && ((b[0] == 0xff && b[1] == 0xfe) || (b[0] == 0xfe && b[1] == 0xff)))
        return "is text in UTF-16: save it as UTF-8";
    for (size_t k = 0; k < n; k++)
        if (b[k] < ' ' && !strchr("\t\n\v\f\r", b[k] ? b[k] : 'x'))
            return "is not text: a case is a text file in UTF-8";
    return NULL;
}

/* Ten digits and more, bare: those of a real have a point, an exponent or an L behind. */
int hint_long_integer(const char *text, char *word, size_t size)
{
    int line = 1, found = 0;
    char *all = bare_copy(text, false);
    for (const char *c = all; *c && !found; c++) {
        line += *c == '\n';
        if (!isdigit((unsigned char)*c))
            continue;
        const size_t n = strspn(c, "0123456789");
        const bool bare = c == all || !(isalnum((unsigned char)c[-1]) || strchr("._", c[-1]));
        if (bare && n >= 10 && (!c[n] || !strchr(".eEL", c[n]))) {
            snprintf(word, size, "%.*s", (int)n, c);
            found = line;
        }
        c += n - 1;
    }
    mem_free(all);
    return found;
}
