/* command_line.c - options of a program, the place of its case and of its output. Runs on all ranks
 * before the case is read and before the program meets others, so it takes no part in
 * communication; what it prints, rank 0 prints. The result is a struct command_line or the exit
 * code to end with.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <getopt.h>
#include <unistd.h>

#include "../params/params.h"
#include "program.h"

static const struct option options[] = {{"help", optional_argument, NULL, 'h'},
                                        {"version", no_argument, NULL, 'V'},
                                        {"params", no_argument, NULL, 'M'},
                                        {"check", optional_argument, NULL, 'c'},
                                        {"param", required_argument, NULL, 'p'},
                                        {"output", required_argument, NULL, 'o'},
                                        {"restart", no_argument, NULL, 'r'},
                                        {"force", no_argument, NULL, 'f'},
                                        {"deadline", required_argument, NULL, 'd'},
                                        {"patience", required_argument, NULL, 't'},
                                        {"groups", no_argument, NULL, 'g'},
                                        {"as", required_argument, NULL, 'a'},
                                        {NULL, 0, NULL, 0}};

/* All options, as the README has them. */
static void usage(const char *name, const char *help)
{
    printf("%s - %s\n"
           "usage: %s CASE [-p group.key=value ...] [-o DIR] [--check] [--restart] [--force]\n"
           "CASE is a folder with a case.cfg, a folder of cases/, or a .cfg file.\n"
           "  -p, --param K=V   overrides a key of the case: -p sph.dx=0.01 -p 'fv.cells=(64,64)'\n"
           "                    or of an element of a list: -p 'walls.[0].kind=no_slip'\n"
           "  -o, --output DIR  where the run writes (out/CASE)\n"
           "      --check       reads and validates the case, says what it uses and costs; no run\n"
           "      --check=picture  draws the scene as well, to DIR/PROGRAM-scene.svg\n"
           "      --check=waves    says and draws the waves alone, to DIR/PROGRAM-waves.svg\n"
           "      --restart     continues from the last restart file in DIR\n"
           "      --force       replaces an earlier run in DIR\n"
           "      --deadline S  time to find the other programs of a coupled job (30 s)\n"
           "      --patience S  time without a sign of life after which a partner counts as hung "
           "(120 s)\n"
           "      --help [KEY]  this text and all keys, or one key or group\n"
           "      --params      all keys as a markdown table\n"
           "      --as NAME     one of several programs of this kind: `%s_left' reads that group\n"
           "      --groups      names of the groups of the case, included files and all\n"
           "      --version\n"
           "Exit codes: 0 done, 1 done but not accepted, 2 input at fault, 3 diverged, 4 a partner "
           "failed,\n"
           "5 stopped in order.\n\n",
           name, help, name, name);
}

/* Says what is wrong, before log_open. */
static int refuse(const char *name, const char *what, const char *arg)
{
    struct hint_nearest n = hint_nearest_start(arg);
    log_early("%s: %s%s%s", name, what, *arg ? " " : "", arg);
    if (strncmp(arg, "--", 2) == 0) {
        char known[64] = "";
        n.word = arg + 2;
        for (const struct option *o = options; o->name; o++)
            hint_nearest_try(&n, o->name);
        if (hint_nearest_word(&n))
            snprintf(known, sizeof known, "did you mean `--%s'? ", hint_nearest_word(&n));
        log_early("%s: %ssee %s --help", name, known, name);
    }
    return RUN_INPUT;
}

static bool readable(const char *path) { return access(path, R_OK) == 0; }

/* The file of a case: as given, in the folder given, or cases/NAME/case.cfg. Static buffer. */
static const char *find_case(const char *given)
{
    static char path[1024];
    const size_t n = strlen(given);
    snprintf(path, sizeof path, "%s", given);
    if (n > 4 && strcmp(given + n - 4, ".cfg") == 0)
        return readable(path) ? path : NULL;
    snprintf(path, sizeof path, "%s/case.cfg", given);
    if (readable(path))
        return path;
    snprintf(path, sizeof path, "cases/%s/case.cfg", given);
    return readable(path) ? path : NULL;
}

void run_case_dir(const char *file, char *dir, size_t size)
{
    const char *slash = strrchr(file, '/');
    snprintf(dir, size, "%.*s", slash ? (int)(slash - file) : 1, slash ? file : ".");
}

/* A case's name, from which the folder of its output follows: that of the folder around a case.cfg,
 * else the file's without .cfg. */
void run_case_name(const char *file, char *name, size_t size)
{
    char copy[1024];
    snprintf(copy, sizeof copy, "%s", file);
    char *slash = strrchr(copy, '/'), *base = slash ? slash + 1 : copy;
    if (strcmp(base, "case.cfg") == 0 && slash) {
        *slash = '\0';
        base = strrchr(copy, '/') ? strrchr(copy, '/') + 1 : copy;
    }
    const size_t n = strlen(base);
    if (n > 4 && strcmp(base + n - 4, ".cfg") == 0)
        base[n - 4] = '\0';
    snprintf(name, size, "%s", *base && strcmp(base, ".") != 0 ? base : "case");
}

/* Prints what --help, --version or --params ask for. On rank 0 of the world alone: log_open comes
 * later. */
static int print_and_end(int option, const char *name, const char *help, const char *key,
                         const struct param_group *groups, int ngroups)
{
    int rank = 0, up;
    MPI_Initialized(&up);
    if (up)
        MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank != 0)
        return RUN_DONE;
    if (option == 'V')
        printf("%s %s\n", name, run_version);
    else if (option == 'M')
        params_manual(groups, ngroups);
    else {
        if (!key)
            usage(name, help);
        params_help(groups, ngroups, key);
    }
    return RUN_DONE;
}

/* -1: go on with *c; else the exit code. opterr = 0: getopt prints nothing itself; optind = 1: it
 * begins anew, its state is global. */
int run_command_line(struct command_line *c, int argc, char **argv, const char *name,
                     const char *help, const struct param_group *groups, int ngroups)
{
    static char dir[1024];
    const char **overrides = mem_new((size_t)argc, sizeof *overrides);
    const char *given = NULL;
    int option;
    *c = (struct command_line){.overrides = overrides, .deadline = 30.0, .patience = 120.0};
    opterr = 0;
    optind = 1;
    while ((option = getopt_long(argc, argv, ":hVcp:o:rf", options, NULL)) != -1) {
        switch (option) {
        case 'h':
            return print_and_end(option, name, help,
                                 optarg ? optarg : (optind < argc ? argv[optind] : NULL), groups,
                                 ngroups);
        case 'V':
        case 'M':
            return print_and_end(option, name, help, NULL, groups, ngroups);
        case 'c':
            c->check = true;
            c->waves = optarg && strcmp(optarg, "waves") == 0;
            c->picture = optarg && !c->waves;
            if (c->picture && strcmp(optarg, "picture") != 0)
                return refuse(name, "expected --check, --check=picture or --check=waves, not",
                              optarg);
            break;
        case 'p':
            overrides[c->noverrides++] = optarg;
            break;
        case 'o':
            c->dir = optarg;
            break;
        case 'r':
            c->restart = true;
            break;
        case 'f':
            c->force = true;
            break;
        case 'g':
            c->groups = true;
            break;
        case 'a':
            c->as = optarg;
            if (strncmp(optarg, name, strlen(name)) != 0 || optarg[strlen(name)] != '_' ||
                strlen(optarg) > 40)
                return refuse(name, "expected a name that begins with the program's and _, not",
                              optarg);
            break;
        case 'd':
        case 't':
            if (!(atof(optarg) > 0.0))
                return refuse(name, "expected a time in s above 0, not", optarg);
            *(option == 'd' ? &c->deadline : &c->patience) = atof(optarg);
            break;
        case ':':
            return refuse(name, "a value is missing behind", argv[optind - 1]);
        default:
            return refuse(name, "unknown option", argv[optind - 1]);
        }
    }
    given = optind < argc ? argv[optind] : NULL;
    if (!given)
        return refuse(name, "no case given; see --help", "");
    if (optind + 1 < argc)
        return refuse(name, "one case at a time; not understood:", argv[optind + 1]);
    c->case_file = find_case(given);
    if (!c->case_file) {
        log_early("%s: there is no case %s: neither a .cfg file, nor a folder with a case.cfg, nor "
                  "in cases/",
                  name, given);
        return RUN_INPUT;
    }
    if (c->groups)
        return params_list_groups(c->case_file) ? RUN_DONE : RUN_INPUT;
    if (!c->dir) {
        char case_name[256];
        run_case_name(c->case_file, case_name, sizeof case_name);
        snprintf(dir, sizeof dir, "out/%s", case_name);
        c->dir = dir;
    }
    return -1;
}
