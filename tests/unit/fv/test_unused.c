/* test_unused.c - no key of a case is accepted and ignored: in scenes of every mode each key gets
 * other values; each is refused, or something in the rows of the series, the fields or the summary
 * changes. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "fv_case.h"

enum { STEPS = 2, SEEN_MAX = 4096, TEXT_MAX = 4096, CANDIDATES = 12 };

/* --- scenes: one a mode --- */

#define HEAD "format = 1;\ntime: { end = 0.5; };\n"
#define SQUARE "domain: { dim = 2; min = (0, 0); max = (1, 1); };\n"
#define ROUND "domain: { dim = 2; min = (0, 0); max = (1, 1); periodic = (true, true); };\n"
#define FOUR_WALLS(kind, top)                                                                      \
    "walls: ( { side = \"x_min\"; kind = \"" kind "\"; }, { side = \"x_max\"; kind = \"" kind      \
    "\"; }, { side = \"y_min\"; kind = \"" kind "\"; }, { side = \"y_max\"; kind = \"" kind        \
    "\"; " top "} );\n"
#define DUCT                                                                                       \
    "walls: ( { side = \"x_min\"; kind = \"inflow\"; velocity = (1, 0); }, "                       \
    "{ side = \"x_max\"; kind = \"outflow\"; }, "                                                  \
    "{ side = \"y_min\"; kind = \"no_slip\"; }, { side = \"y_max\"; kind = \"slip\"; } );\n"
#define MODES "initial: { field = \"two_modes\"; U = 0.9; L = 0.5; velocity = (0.5, 0.25); };\n"

static const struct {
    const char *name, *text;
} scenes[] = {
    {"periodic, rk3", HEAD ROUND MODES "fluid: { nu = 0.005; };\nfv: { cells = (12, 12); };\n"},
    {"inviscid", HEAD ROUND MODES "fv: { cells = (12, 12); cfl = 0.6; };\n"},
    {"bdf2", HEAD ROUND MODES
     "fluid: { nu = 0.005; };\nfv: { cells = (12, 12); integrator = \"bdf2\"; cfl = 0.4; };\n"},
    {"hole", HEAD ROUND MODES
     "fluid: { nu = 0.005; };\nfv: { cells = (16, 16); hole = ((0.3, 0.3), (0.7, 0.7)); };\n"},
    {"exact sides", HEAD SQUARE MODES "fluid: { nu = 0.005; };\nfv: { cells = (12, 12); };\n"},
    {"cavity, rk3", HEAD SQUARE
     "fluid: { nu = 0.01; gravity = (0, -9.81); };\n"
     "probes: ( { name = \"p\"; at = (0.5, 0.2); } );\nfv: { cells = (12, 12); };\n" FOUR_WALLS(
         "no_slip", "velocity = (1, 0); ")},
    {"cavity, newton",
     HEAD SQUARE "fluid: { nu = 0.01; };\nfv: { cells = (8, 8); integrator = \"newton\"; cfl = 2; "
                 "};\n" FOUR_WALLS("no_slip", "velocity = (1, 0); ")},
    {"cavity, steady",
     HEAD SQUARE "fluid: { nu = 0.01; };\nfv: { cells = (8, 8); integrator = "
                 "\"newton\"; steady = true; };\n" FOUR_WALLS("no_slip", "velocity = (1, 0); ")},
    {"cavity, dual time",
     HEAD SQUARE "fluid: { nu = 0.01; };\nfv: { cells = (8, 8); integrator = \"newton\"; cfl = 2; "
                 "dual_time = true; };\n" FOUR_WALLS("no_slip", "velocity = (1, 0); ")},
    {"duct",
     HEAD SQUARE DUCT "fluid: { nu = 0.01; };\nprobes: ( { name = \"p\"; at = (0.5, 0.2); } );\n"
                      "fv: { cells = (12, 12); };\n"},
    {"duct, carried", HEAD SQUARE
     "walls: ( { side = \"x_min\"; kind = \"inflow\"; velocity = (1, 0); profile = "
     "\"parabolic\"; }, { side = \"x_max\"; kind = \"outflow\"; carried = true; }, "
     "{ side = \"y_min\"; kind = \"no_slip\"; }, { side = \"y_max\"; kind = \"no_slip\"; } );\n"
     "fluid: { nu = 0.01; };\nfv: { cells = (12, 12); };\n"},
    {"graded",
     HEAD "domain: { dim = 2; min = (0, 0); max = (1, 1); periodic = (true, false); };\n"
          "fluid: { nu = 0.01; gravity = (0.8, 0); };\ninitial: { field = \"taylor_green\"; };\n"
          "walls: ( { side = \"y_min\"; kind = \"slip\"; }, { side = \"y_max\"; kind = "
          "\"no_slip\"; } );\nfv: { cells = (8, 20); graded = (0.5, 12); };\n"},
    {"channel, couette",
     HEAD "domain: { dim = 2; min = (0, 0); max = (1, 1); periodic = (true, false); };\n"
          "fluid: { nu = 0.1; };\ninitial: { field = \"couette\"; };\n"
          "walls: ( { side = \"y_min\"; kind = \"no_slip\"; }, { side = \"y_max\"; kind = "
          "\"no_slip\"; velocity = (1, 0); } );\nfv: { cells = (8, 12); cfl = 0.2; };\n"},
    {"water", HEAD SQUARE
     "fluid: { nu = 1e-3; gravity = (0, -9.81); };\n"
     "shapes: ( { box = ((0, 0), (0.5, 0.6)); }, { form = \"disc\"; centre = (0.3, 0.3); radius = "
     "0.1; hole = true; }, { form = \"below\"; level = 0.21; }, { form = \"polygon\"; points = "
     "((0.6, 0.1), (0.9, 0.1), (0.75, 0.5)); } );\n"
     "probes: ( { name = \"p\"; at = (0.2, 0.05); }, { name = \"h\"; kind = \"level\"; at = (0.2, "
     "0); } );\nfv: { cells = (16, 16); };\n" FOUR_WALLS("slip", "")},
    {"boxes", HEAD SQUARE
     "fluid: { nu = 0.01; gravity = (0, -9.81); };\n"
     "shapes: ( { box = ((0, 0), (0.5, 0.6)); } );\n"
     "initial: { field = \"uniform\"; velocity = (0.3, 0.1); };\n"
     "blocked: ( { name = \"a\"; min = (0.25, 0); max = (0.5, 0.25); kind = \"no_slip\"; } );\n"
     "fv: { cells = (16, 16); };\n" FOUR_WALLS("slip", "")},
    {"standing wave",
     HEAD "domain: { dim = 2; min = (0, 0); max = (4, 1.25); periodic = (true, false); };\n"
          "fluid: { nu = 2e-3; gravity = (0, -1); };\ninitial: { field = \"standing_wave\"; L = 4; "
          "amplitude = 0.05; level = 1; };\nwalls: ( { side = \"y_min\"; kind = \"no_slip\"; }, { "
          "side = \"y_max\"; } );\nfv: { cells = (16, 10); };\n"},
    {"stokes wave",
     HEAD "domain: { dim = 2; min = (0, -1); max = (1, 0.5); periodic = (true, false); };\n"
          "fluid: { nu = 0.02; gravity = (0, -1); };\ninitial: { field = \"stokes\"; L = 1; "
          "amplitude = 0.05; level = 0; };\nwalls: ( { side = \"y_min\"; }, { "
          "side = \"y_max\"; } );\nfv: { cells = (16, 24); };\n"},
    {"beltrami",
     HEAD "domain: { dim = 3; min = (0, 0, 0); max = (1, 1, 1); periodic = (true, true, true); };\n"
          "initial: { field = \"beltrami\"; velocity = (0.5, 0.25, 0.125); };\n"
          "fluid: { nu = 0.1; };\nfv: { cells = (8, 8, 8); };\n"},
    {"ring",
     HEAD "domain: { dim = 2; min = (-1, -1); max = (1, 1); };\nfluid: { nu = 0.05; };\n"
          "initial: { field = \"couette\"; };\nblocks: ( { name = \"ring\"; mapping = \"annulus\"; "
          "radius = (0.5, 1.0); cells = (6, 24); spin = (2.0, -0.5); i_min = \"wall\"; i_max = "
          "\"wall\"; j_min = \"joined\"; j_max = \"joined\"; } );\nfv: { };\n"},
    {"overlapping", HEAD ROUND MODES
     "fluid: { nu = 0.005; };\nblocks: ( { name = \"a\"; cells = (24, 24); i_min = \"periodic\"; "
     "i_max = \"periodic\"; j_min = \"periodic\"; j_max = \"periodic\"; }, { name = \"b\"; cells = "
     "(14, 14); min = (0.25, 0.25); max = (0.75, 0.75); centre = (0.5, 0.5); angle = 20.0; } );\n"
     "fv: { };\n"},
    {"sheared", HEAD ROUND MODES
     "fluid: { nu = 0.005; };\nblocks: ( { name = \"a\"; cells = (12, 12); mapping = \"sheared\"; "
     "wave = 0.06; i_min = \"periodic\"; i_max = \"periodic\"; j_min = \"periodic\"; j_max = "
     "\"periodic\"; } );\nfv: { };\n"},
    {"stream", HEAD
     "domain: { dim = 2; min = (-3, -3); max = (5, 3); };\nfluid: { nu = 0.01; gravity = (0, "
     "-9.81); };\n"
     "initial: { field = \"uniform\"; velocity = (1.0, 0.2); };\nprobes: ( { name = \"p\"; at = "
     "(2, "
     "0.5); } );\n"
     "blocks: ( { name = \"s\"; mapping = \"stretched\"; min = (-3, -3); max = (5, 3); cells = "
     "(28, 26); focus = (0, 0); stretch = (2, 2); velocity = (1, 0); i_min = \"inflow\"; i_max = "
     "\"outflow\"; j_min = \"slip\"; j_max = \"slip\"; }, { name = \"c\"; mapping = \"annulus\"; "
     "radius = (0.5, 2.4); stretch = (1.0, 0); cells = (12, 32); i_min = \"wall\"; j_min = "
     "\"joined\"; j_max = \"joined\"; } );\nfv: { };\n"},
    {"wave zone", HEAD
     "domain: { dim = 2; max = (3, 0.5); };\n"
     "fluid: { gravity = (0, -9.81); };\nshapes: ( { form = \"below\"; level = 0.25; } );\n"
     "walls: ( { side = \"x_min\"; kind = \"wave\"; }, { side = \"x_max\"; kind = \"beach\"; }, "
     "{ side = \"y_min\"; }, { side = \"y_max\"; } );\n"
     "waves: { kind = \"focused\"; height = 0.05; length = 0.9; zone = 0.3; start = 0.1; order = "
     "1; };\n"
     "fv: { cells = (24, 12); };\n"},
    {"lid on a block", HEAD SQUARE
     "fluid: { nu = 0.01; };\nblocks: ( { name = \"a\"; cells = (8, 8); velocity = (1, 0); lid = "
     "\"j_max\"; i_min = \"wall\"; i_max = \"wall\"; j_min = \"wall\"; j_max = \"wall\"; } );\n"
     "fv: { };\n"},
};

/* Keys that are used where this test does not look, or rightly change nothing. */
static const struct {
    const char *key, *why;
} exceptions[] = {
    {"output", "run.c writes the files; the state does not know"},
    {"accept", "judged by run.c at the end"},
    {"probes.name", "a heading in series.csv"},
    {"blocked.name", "a heading in series.csv, in messages"},
    {"blocks.name", "a heading in series.csv, in messages"},
    {"fv.force", "wants eight rows in the second half of the run"},
    {"fv.pseudo_steps", "binds where pseudo steps do not converge"},
    {"fv.surface", "\"no\" repeats what auto finds in a scene without water"},
    {"time.end", "a march to a steady state ends by itself"},
    {"domain.min", "bounds of blocks, which are checked"},
    {"domain.max", "bounds of blocks, which are checked"},
    {"fluid.rho", "of a scene whose energies vanish"},
    {"walls.friction", "of a wall that is dry or beside water at rest: fv_bed.py"},
};

/* In a flow of one dimension nothing is to be projected and nothing biased. */
static bool is_idle(const char *scene, const char *key)
{
    return strcmp(scene, "channel, couette") == 0 &&
           (strcmp(key, "fv.tol_pressure") == 0 || strcmp(key, "fv.upwind") == 0);
}

static bool is_excepted(const char *key, bool with_blocks)
{
    for (size_t k = 0; k < sizeof exceptions / sizeof exceptions[0]; k++)
        if (strncmp(key, exceptions[k].key, strlen(exceptions[k].key)) == 0)
            return strncmp(key, "domain", 6) != 0 || with_blocks;
    return false;
}

/* --- a case with one key changed --- */

static const char *path;

/* Where the element (from 0) of a group begins, behind its brace; NULL: there is none. */
static char *element_of(char *text, const char *group, int element)
{
    char head[64];
    snprintf(head, sizeof head, "\n%s: ", group);
    char *c = strstr(text, head);
    for (int k = 0; c && k <= element; k++) {
        char *end = strchr(c + 1, '\n');
        c = strchr(c + 1, '{');
        if (c && end && c > end)
            return NULL;
    }
    return c ? c + 1 : NULL;
}

static void put_key(char *text, const char *group, int element, const char *key, const char *value)
{
    char word[80], rest[TEXT_MAX], line[2600];
    char *at = element_of(text, group, element);
    if (!at) {
        snprintf(text + strlen(text), TEXT_MAX - strlen(text), "%s: { %s = %s; };\n", group, key,
                 value);
        return;
    }
    snprintf(word, sizeof word, " %s = ", key);
    char *old = strstr(at, word), *end = strchr(at, '}');
    if (old && old < end) {
        char *next = strchr(old, ';') + 1;
        memmove(old, next, strlen(next) + 1);
    }
    snprintf(rest, sizeof rest, "%s", at);
    snprintf(line, sizeof line, " %s = %s;", key, value);
    snprintf(at, TEXT_MAX - (size_t)(at - text), "%s%s", line, rest);
}

/* What the run shows: rows, fields, summary. n < 0: refused. */
struct seen {
    int n;
    bool unused; /* a fault says that the changed key is not used */
    double v[SEEN_MAX];
};

static void see(void *ctx, const char *key, double v)
{
    struct seen *s = ctx;
    if (strncmp(key, "time_s", 6) != 0 && strncmp(key, "cell_steps", 10) != 0 &&
        strncmp(key, "us_per", 6) != 0 && s->n < SEEN_MAX)
        s->v[s->n++] = v;
}

static void see_fields(struct seen *s, double *const *u, const double *p, int64_t n, double whole)
{
    double sum[4] = {0.0};
    for (int64_t i = 0; i < n; i++) {
        const double w = 1.0 + 0.37 * sin(1.7 * (double)i);
        for (int a = 0; a < 3; a++)
            sum[a] += u[a] && isfinite(u[a][i]) ? w * u[a][i] : 0.0;
        sum[3] += isfinite(p[i]) ? w * p[i] : 0.0;
    }
    for (int a = 0; a < 3; a++)
        see(s, "u", sum[a]);
    see(s, "p", sum[3] + whole);
}

static void run_steps(struct run *r, struct seen *seen)
{
    struct fv *s = fv_create(r, NULL);
    struct diagnosis d = {0};
    for (int k = 0; k < STEPS && s->t < r->scene.time.end && !d.bad; k++) {
        double row[64];
        r->dt = integrate(s, r->scene.time.end, &d);
        r->t = s->t;
        r->step++;
        for (int q = 0; q < 64; q++)
            row[q] = NAN;
        fv_row(s, row);
        see(seen, "t", s->t);
        for (int q = 0; q < 64; q++)
            see(seen, "row", row[q]);
    }
    const double foot[3] = {0.1, 0.1, 0.1};
    see_fields(seen, s->u, s->p, s->size, fv_still_pressure(s, foot));
    fv_finish(s);
    fv_free(&s);
}

static struct run run;

/* key: the changed one as faults name it, or NULL. */
static void outcome(const char *text, const char *key, struct seen *seen)
{
    struct faults f = {0};
    char told[120];
    struct params *p = fv_case_read(&run, MPI_COMM_WORLD, path, text, NULL, &f);
    run.scene.has_fv = true;
    if (f.n == 0)
        scene_outlines_read(&run.scene, ".", p, &f);
    if (f.n == 0)
        scene_check(&run.scene, p, &f);
    if (f.n == 0)
        fv_params_check(&run, &f);
    *seen = (struct seen){.n = -1};
    if (f.n == 0) {
        seen->n = 0;
        run.summary = summary_create();
        run_steps(&run, seen);
        summary_each(run.summary, see, seen);
        DROP(run.summary);
    }
    snprintf(told, sizeof told, " %s: is not used", key ? key : "");
    seen->unused = f.text && key && strstr(f.text, told);
    if (seen->n < 0 && getenv("VERBOSE"))
        print_message("%s", f.text);
    mem_free(f.text);
    params_free(&p);
}

static bool same(const struct seen *a, const struct seen *b)
{
    return a->n == b->n && memcmp(a->v, b->v, (size_t)a->n * sizeof(double)) == 0;
}

/* Bytes of a value of which others are made. */
static size_t size_of(enum param_type type)
{
    switch (type) {
    case PARAM_BOOL:
        return sizeof(bool);
    case PARAM_BOOLS:
        return 3 * sizeof(bool);
    case PARAM_INT:
    case PARAM_CHOICE:
        return sizeof(int);
    case PARAM_INTS:
        return 3 * sizeof(int);
    case PARAM_REAL:
        return sizeof(double);
    case PARAM_REALS:
    case PARAM_TURN:
        return 3 * sizeof(double);
    case PARAM_POINTS:
        return sizeof(struct param_points);
    default:
        return 6 * sizeof(double);
    }
}

/* Other values of a row, given the present one at `at'. Returns their number. */
static int candidates(const struct param *row, const void *at, char value[][200])
{
    static const double factors[] = {0.6, 1.7, 0.01, 1e5}; /* the last for tolerances */
    const double *x = at;
    const int *i = at;
    int n = 0, which = 0;
    switch (row->type) {
    case PARAM_REAL:
        for (int k = 0; k < (strncmp(row->key, "tol", 3) == 0 ? 4 : 3); k++)
            snprintf(value[n++], 200, "%.9g",
                     x[0] > 0.0 && x[0] < 1e29 ? factors[k] * x[0] : 0.11 * (k + 1));
        break;
    case PARAM_INT:
        for (int k = 0; k < 2; k++)
            snprintf(value[n++], 200, "%d", i[0] + 1 + k);
        break;
    case PARAM_BOOL:
        snprintf(value[n++], 200, *(const bool *)at ? "false" : "true");
        break;
    case PARAM_CHOICE:
        for (const char *c = row->choices; *c && n < CANDIDATES; c += strcspn(c, "|")) {
            c += *c == '|';
            if (which++ != i[0])
                snprintf(value[n++], 200, "\"%.*s\"", (int)strcspn(c, "|"), c);
        }
        break;
    case PARAM_TEXT:
        snprintf(value[n++], 200, "\"other\"");
        break;
    case PARAM_REALS:
        for (int k = 0; k < 3; k++)
            snprintf(value[n++], 200, "(%.9g, %.9g, %.9g)",
                     x[0] + (k == 0 ? 0.1 + 0.5 * fabs(x[0]) : 0.0),
                     x[1] + (k == 1 ? 0.1 + 0.5 * fabs(x[1]) : 0.0),
                     x[2] + (k == 2 ? 0.1 + 0.5 * fabs(x[2]) : 0.0));
        break;
    case PARAM_INTS:
        for (int k = 0; k < 3; k++)
            snprintf(value[n++], 200, "(%d, %d, %d)", i[0] + 4 * (k == 0), i[1] + 4 * (k == 1),
                     i[2] + 4 * (k == 2));
        break;
    case PARAM_BOOLS:
        for (int k = 0; k < 3; k++) {
            const bool *b = at;
            snprintf(value[n++], 200, "(%s, %s, %s)", b[0] != (k == 0) ? "true" : "false",
                     b[1] != (k == 1) ? "true" : "false", b[2] != (k == 2) ? "true" : "false");
        }
        break;
    case PARAM_BOX:
        for (int k = 0; k < 2; k++)
            snprintf(value[n++], 200, "((%.9g, %.9g), (%.9g, %.9g))", x[0] + 0.03, x[1] + 0.03 * k,
                     x[3] + 0.08, x[4] + 0.08);
        snprintf(value[n++], 200, "((0.25, 0.25), (0.75, 0.75))");
        break;
    case PARAM_POINTS:
        snprintf(value[n++], 200, "((0.61, 0.12), (0.9, 0.1), (0.75, 0.45))");
        break;
    case PARAM_TURN: /* fv, whose scenes these are, has boxes among bodies alone */
    case PARAM_NUMBERS:
    case PARAM_LIST:
        break;
    case PARAM_PLACES:
        snprintf(value[n++], 200, "((0.61, 0.12, 0.1))");
        break;
    }
    return n;
}

/* Number of keys of this element that are accepted and change nothing. */
static int try_row(const char *scene, const char *text, const struct seen *plain,
                   const struct param_group *group, int element, const struct param *row,
                   const void *at)
{
    char value[CANDIDATES][200], changed[TEXT_MAX], key[80], told[100];
    static struct seen other;
    const int n = candidates(row, at, value);
    int ignored = 0, worked = 0;
    snprintf(key, sizeof key, "%s.%s", group->name, row->key);
    snprintf(told, sizeof told, "%s", key);
    if (group->stride)
        snprintf(told, sizeof told, "%s.[%d].%s", group->name, element, row->key);
    other.unused = false;
    for (int k = 0; k < n && worked == 0 && (!other.unused || row->type == PARAM_CHOICE); k++) {
        snprintf(changed, sizeof changed, "%s", text);
        put_key(changed, group->name, element, row->key, value[k]);
        if (getenv("VERBOSE"))
            print_message("--- %s: %s = %s\n", scene, key, value[k]);
        outcome(changed, told, &other);
        if (other.n >= 0 && !same(plain, &other))
            worked++;
        else if (other.n >= 0)
            ignored++;
    }
    if (ignored == 0 || worked > 0)
        return 0;
    print_message("%s: %s [%d] is accepted and changes nothing\n", scene, key, element);
    return 1;
}

/* Number of keys of one element of a group, whose values begin at `from', that change nothing. */
static int try_element(const char *scene, const char *text, const struct seen *plain,
                       const struct param_group *group, int element, bool with_blocks,
                       const char *from)
{
    int bad = 0;
    for (int q = 0; q < group->nrows; q++) {
        char key[80];
        const struct param *row = group->rows + q;
        snprintf(key, sizeof key, "%s.%s", group->name, row->key);
        if (!is_excepted(key, with_blocks) && !is_idle(scene, key))
            bad += try_row(scene, text, plain, group, element, row, from + row->offset);
    }
    return bad;
}

/* Scenes of whose keys other scenes have all but those of groups that begin so: these will do,
 * unless all are asked for (LONG). */
static const char *groups_of(const char *name)
{
    static const char *const of[][2] = {{"wave zone", "wa"},          {"inviscid", "f"},
                                        {"cavity, newton", "fv"},     {"cavity, steady", "fv"},
                                        {"cavity, dual time", "fv"},  {"duct, carried", "walls"},
                                        {"channel, couette", "init"}, {"stream", "b"},
                                        {"lid on a block", "b"}};
    for (size_t k = 0; k < sizeof of / sizeof of[0] && !getenv("LONG"); k++)
        if (strcmp(name, of[k][0]) == 0)
            return of[k][1];
    return "";
}

static int try_scene(const char *name, const char *text)
{
    const char *ours = groups_of(name);
    static struct seen plain;
    static struct {
        char bytes[1 << 15];
    } values; /* a group's, before params_read of the next case */
    int bad = 0;
    for (int g = 0; g < SCENE_GROUPS + FV_GROUPS; g++) {
        if (g > 0 && strncmp(fv_case_groups[g].name, ours, strlen(ours)) != 0)
            continue; /* the first run names the groups */
        outcome(text, NULL, &plain);
        if (plain.n < 0)
            fail_msg("%s: the scene itself is refused", name);
        struct faults f = {0}; /* its values as they were read: checks change some */
        struct params *p = fv_case_read(&run, MPI_COMM_WORLD, path, text, NULL, &f);
        params_free(&p);
        const struct param_group group = fv_case_groups[g];
        const bool with_blocks = mesh_given_count > 0;
        const int n = group.stride ? *group.count : 1;
        size_t span = group.stride * (size_t)n;
        for (int q = 0; q < group.nrows && !group.stride; q++)
            if (group.rows[q].offset + size_of(group.rows[q].type) > span)
                span = group.rows[q].offset + size_of(group.rows[q].type);
        assert_true(span <= sizeof values);
        memcpy(values.bytes, group.target, span);
        for (int e = 0; e < n; e++)
            bad += try_element(name, text, &plain, &group, e, with_blocks,
                               values.bytes + group.stride * (size_t)e);
    }
    return bad;
}

TEST(no_key_is_accepted_and_ignored)
{
    const char *only = getenv("ONLY");
    int bad = 0;
    for (size_t k = 0; k < sizeof scenes / sizeof scenes[0]; k += SANITIZED ? 8 : 1)
        if (!only || strstr(scenes[k].name, only))
            bad += try_scene(scenes[k].name, scenes[k].text);
    assert_int_equal(bad, 0);
}

void unit_begin(void) { path = unit_file("unused.cfg"); }
