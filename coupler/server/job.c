/* job.c - the coupler's own part of a case: group coupler, and what of sph's and fv's scene it
 * needs to check that they fit. A case without sph and fv is any program's: then only time and
 * domain are read, and groups of unknown names are theirs.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "job.h"

#include "../../common/run/run.h"

/* clang-format off */
#define P struct job
static const struct param rows[] = {
    PARAM(P, programs, "-", "", 0, 0, "names of all programs of the job beside the coupler, as \"sph exact\"; empty: sph and fv where the case has their groups, and any other"),
    PARAM(P, window,   "s", "0.0", 0, 1e9, "longest time between two exchanges; 0: as the programs wish"),
    PARAM(P, start,    "s", "0.0", -1e9, 1e9, "time at which the job starts"),
    PARAM(P, period,   "m", "(0.0, 0.0, 0.0)", 0, 1e9, "period of the sets of points that declare none; 0: not periodic, or as domain.periodic says"),
};
#undef P
/* clang-format on */

static const char *const of_scene[] = {"fluid",  "initial", "walls", "bodies",  "shapes",
                                       "probes", "gauges",  "waves", "coupling"};
enum { OF_SCENE = sizeof of_scene / sizeof *of_scene, OTHERS = OF_SCENE + HANDSHAKE_PROGRAMS + 8 };

/* The scene's groups first, then the coupler's own. */
void job_groups(struct job *j, struct scene *s, struct param_group *groups)
{
    scene_groups(s, groups);
    groups[SCENE_GROUPS] = (struct param_group){.name = "coupler",
                                                .help = "The coupler",
                                                .rows = rows,
                                                .nrows = (int)(sizeof rows / sizeof *rows),
                                                .target = j};
}

/* Groups that other programs read: NULL-terminated. */
static void list_others(const char *others[OTHERS], bool shared, const struct handshake *who)
{
    int n = 0;
    others[n++] = "sph";
    others[n++] = "sph_*";
    others[n++] = "apr";
    others[n++] = "fv";
    others[n++] = "blocks"; /* of fv */
    for (int k = 0; k < OF_SCENE && !shared; k++)
        others[n++] = of_scene[k];
    for (int k = 0; who && k < who->nprograms; k++)
        if (strcmp(who->program[k].name, "coupler") != 0)
            others[n++] = who->program[k].name;
    others[n] = NULL;
}

/* Without the groups that describe a scene of sph and fv. */
static int own_groups(struct param_group *groups)
{
    int n = 0;
    for (int k = 0; k < JOB_GROUPS; k++) {
        bool scene = false;
        for (int i = 0; i < OF_SCENE; i++)
            scene = scene || strcmp(groups[k].name, of_scene[i]) == 0;
        if (!scene)
            groups[n++] = groups[k];
    }
    return n;
}

/* Whether the case has a group of ours, which decides how it is read. */
static void look(struct scene *s, MPI_Comm comm, const struct command_line *l)
{
    struct faults scrap = {0};
    struct params *p =
        params_read(comm, l->case_file, l->noverrides, l->overrides, NULL, 0, NULL, &scrap);
    char names[PARAM_PROGRAMS_MAX][64];
    s->has_sph = params_programs(p, "sph", names) > 0;
    s->has_fv = params_has_group(p, "fv");
    params_free(&p);
    mem_free(scrap.text);
}

/* What the case gives in group coupler goes first. */
static void set_period(struct job *j, const struct scene_domain *d)
{
    for (int a = 0; a < 3; a++)
        if (j->period[a] == 0.0 && d->periodic[a])
            j->period[a] = d->max[a] - d->min[a];
}

/* In two passes: the first only looks which groups there are, since that decides what the second
 * accepts. */
struct params *job_read(struct job *j, struct scene *s, MPI_Comm comm, const struct command_line *l,
                        const struct handshake *who, struct faults *f)
{
    struct param_group groups[JOB_GROUPS];
    const char *others[OTHERS];
    look(s, comm, l);
    j->shared = s->has_sph || s->has_fv;
    job_groups(j, s, groups);
    list_others(others, j->shared, who);
    const int n = j->shared ? JOB_GROUPS : own_groups(groups);
    struct params *p =
        params_read(comm, l->case_file, l->noverrides, l->overrides, groups, n, others, f);
    if (f->n)
        return p;
    if (j->shared) {
        char dir[1024];
        run_case_dir(l->case_file, dir, sizeof dir);
        scene_files_read(s, dir, NULL, p, f);
    }
    if (j->shared && f->n == 0)
        scene_check(s, p, f);
    else if (!j->shared && !params_has_group(p, "time"))
        params_fault(p, f, "time", "the case must have this group");
    if (f->n == 0 && !(s->time.end > j->start))
        params_fault(p, f, "coupler.start", "%g s is not before time.end, %g s", j->start,
                     s->time.end);
    char name[HANDSHAKE_NAME];
    const char *at = j->programs;
    while (f->n == 0 && job_next_program(&at, name))
        if (!name[0])
            params_fault(p, f, "coupler.programs", "a name longer than %d bytes",
                         HANDSHAKE_NAME - 1);
    set_period(j, &s->domain);
    return p;
}

/* A name that is too long comes back empty. */
bool job_next_program(const char **at, char name[HANDSHAKE_NAME])
{
    *at += strspn(*at, " \t,");
    const size_t n = strcspn(*at, " \t,");
    name[0] = '\0';
    if (n > 0 && n < HANDSHAKE_NAME) {
        memcpy(name, *at, n);
        name[n] = '\0';
    }
    *at += n;
    return n > 0;
}

bool job_wants(const struct job *j, const char *program)
{
    char name[HANDSHAKE_NAME];
    const char *at = j->programs;
    while (job_next_program(&at, name))
        if (strcmp(name, program) == 0)
            return true;
    return false;
}
