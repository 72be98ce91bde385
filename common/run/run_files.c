/* run_files.c - see run_files.h. Two things make a restart safe: a restart file gets its name only
 * when it is complete and sealed (h5_close), and the manifest checkpoint.txt names it only after
 * that, itself by rename; older files go last. Whatever moment a run is killed at, the manifest
 * names a whole file. In a coupled job the coupler writes the manifest, when all programs have
 * saved.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "run_files.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "../files/files.h"

const char *files_path(const struct run *r, const char *what)
{
    return r->coupled ? key_text("%s/%s-%s", r->dir, r->name, what)
                      : key_text("%s/%s", r->dir, what);
}

/* What any file of a run says of itself. */
static void write_clock(const struct run_files *f, struct h5 *h)
{
    const struct run *r = f->run;
    h5_attribute_int(h, "format", 1);
    h5_attribute_real(h, "time", r->t);
    h5_attribute_int(h, "step", r->step);
    h5_attribute_int(h, "next", f->next);
    h5_attribute_text(h, "program", r->name);
    h5_attribute_text(h, "version", run_version);
    h5_attribute_text(h, "case", f->case_text);
}

/* The clock stands in snapshots, too, but only restart files are sealed and carry what the ranks
 * wrote. */
void files_snapshot(struct run_files *f, const char *what)
{
    struct run *r = f->run;
    char path[1400], name[300];
    if (!r->scene.output.snapshots)
        return;
    if (what)
        snprintf(name, sizeof name, "%s_%s.h5", r->name, what);
    else
        snprintf(name, sizeof name, "%s_%06d.h5", r->name, f->next++);
    snprintf(path, sizeof path, "%s/%s", r->dir, name);
    timer_start(&r->timers, "output");
    struct h5 *h = h5_create(r->comm, path);
    write_clock(f, h);
    f->program->snapshot(f->state, h, f->xdmf, name);
    h5_close(&h);
    timer_stop(&r->timers, "output");
    if (!r->coupled)
        log_say("  output at t = %g s: %s", r->t, path);
    else
        log_quiet("  output at t = %g s: %s", r->t, path);
}

/* Rank 0 of a program that runs alone: which restart file counts. */
static void write_manifest(const struct run *r, int64_t n, const char *file)
{
    const char *path = key_text("%s/checkpoint.txt", r->dir);
    FILE *f = disk_begin(path);
    fprintf(f, "step %lld\nt %.17g\n%s %s\n", (long long)n, r->t, r->name, file);
    /* on the disk before the name is: else a crash of the machine may leave an empty manifest */
    if (fflush(f) != 0 || fsync(fileno(f)) != 0)
        disk_failed(path);
    disk_finish(f, path);
}

/* The manifest is written when the file is on the disk: it names the last sound one. */
void files_checkpoint(struct run_files *f, int64_t n, char *file)
{
    struct run *r = f->run;
    char path[1400];
    snprintf(file, 256, "%s-checkpoint-%lld.h5", r->name, (long long)n);
    snprintf(path, sizeof path, "%s/%s", r->dir, file);
    timer_start(&r->timers, "checkpoint");
    struct h5 *h = h5_create_restart(r->comm, path);
    write_clock(f, h);
    h5_attribute_int(h, "meaning", f->program->meaning);
    f->program->checkpoint(f->state, h);
    h5_close(&h);
    if (!r->coupled && r->rank == 0) {
        write_manifest(r, n, file);
        run_prune(r->dir, r->name, file, f->last);
        snprintf(f->last, sizeof f->last, "%s", file);
    }
    timer_stop(&r->timers, "checkpoint");
    log_quiet("  restart file at t = %g s: %s", r->t, file);
}

/* Reads "window N", "NAME FILE" of the manifest. */
static bool read_manifest(const struct run *r, int64_t *window, char *file, size_t size)
{
    char line[600], key[64], value[300];
    FILE *f = fopen(key_text("%s/checkpoint.txt", r->dir), "r");
    *window = -1;
    *file = '\0';
    while (f && fgets(line, sizeof line, f)) {
        if (sscanf(line, "%63s %299s", key, value) != 2)
            continue;
        if (strcmp(key, "window") == 0)
            *window = atoll(value);
        if (strcmp(key, r->name) == 0)
            snprintf(file, size, "%s", value);
    }
    if (f)
        fclose(f);
    return *file;
}

/* A restart file of a later time than the run's end leaves nothing to do; closes it. */
static bool ends_before(const struct run *r, struct h5 *h)
{
    const double end = r->scene.time.end;
    double t = 0.0;
    if (!h5_read_attribute_real(h, "time", &t) || t <= end * (1.0 + 1e-9))
        return false;
    log_say("--restart: %s stands at t = %g s, after time.end = %g s: raise time.end, or run "
            "without --restart",
            h5_path(h), t, end);
    h5_close(&h);
    return true;
}

/* Says why this program does not read the file. format: that of the file; meaning: of the program's
 * data in it, raised when a newer program would read the same numbers otherwise. */
static bool reads(const struct program *p, struct h5 *h)
{
    int64_t format = 0, meaning = 0;
    if (!h5_read_attribute_int(h, "format", &format) || format != 1) {
        log_say("--restart: %s has format %lld, this program reads 1", h5_path(h),
                (long long)format);
        return false;
    }
    const bool says = h5_read_attribute_int(h, "meaning", &meaning);
    if (says && meaning == p->meaning)
        return true;
    char *version = h5_read_attribute_text(h, "version");
    log_say("--restart: %s is of version %s of %s, which means other things by the numbers in it "
            "(%lld, this version: %d): go on with that version, or run without --restart",
            h5_path(h), version ? version : "unknown", p->name, (long long)meaning, p->meaning);
    mem_free(version);
    return false;
}

/* Rank 0 reads manifest and seal for all. A file that is missing passes the seal's check, so that
 * h5_open's answer names it as missing, not as damaged. */
struct h5 *files_open_restart(struct run *r, const struct program *p, int64_t *window)
{
    char file[300];
    int good = 0;
    *window = -1;
    if (r->rank == 0)
        good = read_manifest(r, window, file, sizeof file);
    MPI_Bcast(&good, 1, MPI_INT, 0, r->comm);
    MPI_Bcast(window, 1, MPI_INT64_T, 0, r->comm);
    MPI_Bcast(file, sizeof file, MPI_CHAR, 0, r->comm);
    if (!good) {
        const char *path = key_text("%s/checkpoint.txt", r->dir);
        if (access(path, R_OK) != 0) /* rank 0 says it, where it was read */
            log_say("--restart: %s has no restart files (output.checkpoint asks for them): run "
                    "without --restart",
                    r->dir);
        else
            log_say("--restart: %s names no restart file of %s; run without --restart", path,
                    r->name);
        return NULL;
    }
    const char *path = key_text("%s/%s", r->dir, file);
    good = r->rank == 0 && (access(path, R_OK) != 0 || disk_sealed(path));
    MPI_Bcast(&good, 1, MPI_INT, 0, r->comm);
    if (!good) {
        log_say("--restart: %s is damaged: cut short, or a bit of it has changed; take an earlier "
                "restart file (edit %s/checkpoint.txt) or run without --restart",
                path, r->dir);
        return NULL;
    }
    struct h5 *h = h5_open(r->comm, path);
    if (!h)
        log_say("--restart: %s is missing or no HDF5 file", path);
    else if (!reads(p, h))
        h5_close(&h);
    return h && ends_before(r, h) ? NULL : h;
}

bool files_read_clock(struct run_files *f, struct h5 *h)
{
    const char *file = strrchr(h5_path(h), '/');
    snprintf(f->last, sizeof f->last, "%s", file ? file + 1 : "");
    int64_t next = 0;
    const bool all = h5_read_attribute_real(h, "time", &f->run->t) &&
                     h5_read_attribute_int(h, "step", &f->run->step) &&
                     h5_read_attribute_int(h, "next", &next);
    f->next = (int)next;
    return all;
}

/* A case's text, as params_text writes it, key by key. */
struct keys {
    const char *text; /* what follows */
    char group[64], key[64], value[400];
};

/* The next "key = value;", defaults too, but of time and output, which a restart may change. False
 * at the end. */
static bool next_key(struct keys *k)
{
    char line[500];
    for (const char *end; (end = strchr(k->text, '\n')); k->text = end + 1) {
        k->text += strspn(k->text, " #");
        snprintf(line, sizeof line, "%.*s", end > k->text ? (int)(end - k->text) : 0, k->text);
        char group[sizeof k->group], open;
        if (sscanf(line, "%63[^:= ]: %c", group, &open) == 2 && (open == '{' || open == '(')) {
            memcpy(k->group, group, sizeof group);
            continue;
        }
        if (strcmp(k->group, "time") == 0 || strcmp(k->group, "output") == 0)
            continue;
        if (sscanf(line, "%63[^= ] = %399[^;];", k->key, k->value) == 2) {
            k->text = end + 1;
            return true;
        }
    }
    return false;
}

/* Goes along both texts together; they list the same keys in the same order unless a list differs
 * in length, and from there on nothing can be compared. */
void files_tell_difference(const struct run_files *f, struct h5 *h)
{
    char *text = h5_read_attribute_text(h, "case");
    struct keys then = {.text = text ? text : ""}, now = {.text = f->case_text};
    for (int told = 0; told < 5 && next_key(&then) && next_key(&now);) {
        if (strcmp(then.group, now.group) != 0 || strcmp(then.key, now.key) != 0) {
            log_say("  the case differs in %s", now.group); /* in the length of a list */
            break;
        }
        if (strcmp(then.value, now.value) == 0)
            continue;
        log_say("  the case differs: %s.%s = %s in the file, %s here", now.group, now.key,
                then.value, now.value);
        told++;
    }
    mem_free(text);
}

/* Ranks of a host share its memory; the hosts are taken to be alike. Beyond 1e9 on a rank its
 * indices, which are int, come near their end, 2^31. */
void run_check_memory(const struct run *r, struct faults *f, const char *key, double n,
                      const char *unit, double bytes)
{
    MPI_Comm host;
    int here = 1;
    MPI_Comm_split_type(r->comm, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &host);
    MPI_Comm_size(host, &here);
    MPI_Comm_free(&host);
    double room = (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
    MPI_Allreduce(MPI_IN_PLACE, &room, 1, MPI_DOUBLE, MPI_MIN, r->comm);
    MPI_Allreduce(MPI_IN_PLACE, &here, 1, MPI_INT, MPI_MAX, r->comm);
    const double need = bytes * here / r->size;
    if (n / r->size > 1e9)
        params_fault(r->params, f, key, "%.3g %s are too many for %d rank%s: at most 1e9 each", n,
                     unit, r->size, r->size == 1 ? "" : "s");
    else if (need > room)
        params_fault(r->params, f, key,
                     "%.3g %s need about %.3g GB on a machine of %.3g GB: coarser, or more hosts",
                     n, unit, 1e-9 * need, 1e-9 * room);
}

/* --- the folder --- */

/* Whether a file belongs to a run of this program. --force deletes these: sph_io.c in the folder of
 * the sources, or a case sph.cfg, must not be among them. */
static bool is_ours(const char *file, const char *name)
{
    const size_t n = strlen(name);
    static const char *const own[] = {".xdmf",         ".log",         "-case.cfg", "-series.csv",
                                      "-summary.json", "_diverged.h5", "_walls.h5", "_walls.xdmf"};
    static const char *const shared[] = {"summary.json", "series.csv", "checkpoint.txt", "log.txt"};
    for (size_t k = 0; k < sizeof shared / sizeof shared[0]; k++)
        if (strcmp(file, shared[k]) == 0)
            return true;
    if (strncmp(file, name, n) != 0)
        return false;
    for (size_t k = 0; k < sizeof own / sizeof own[0]; k++)
        if (strcmp(file + n, own[k]) == 0)
            return true;
    int end = 0;
    sscanf(file + n, "_%*d.h5%n", &end);
    if (end == 0)
        sscanf(file + n, "-checkpoint-%*d.h5%n", &end);
    return end > 0 && (!file[n + (size_t)end] || strcmp(file + n + end, ".part") == 0);
}

/* Number in "NAME-checkpoint-NUMBER.h5"; -1: another file. */
static long long checkpoint_number(const char *file, const char *name)
{
    const size_t n = strlen(name);
    long long number = -1;
    int end = 0;
    if (strncmp(file, name, n) == 0)
        sscanf(file + n, "-checkpoint-%lld.h5%n", &number, &end);
    return end > 0 && !file[n + (size_t)end] ? number : -1;
}

/* Removes restart files older than `newest' except `older', the one before it: if the newest turns
 * out to be unreadable, there is one left. */
void run_prune(const char *dir, const char *name, const char *newest, const char *older)
{
    const long long last = checkpoint_number(newest, name);
    DIR *d = opendir(dir);
    for (struct dirent *e; d && (e = readdir(d));) {
        const long long number = checkpoint_number(e->d_name, name);
        if (number >= 0 && number < last && strcmp(e->d_name, older) != 0)
            unlink(key_text("%s/%s", dir, e->d_name));
    }
    if (d)
        closedir(d);
}

/* Makes the folders above, too. */
bool run_make_folder(const char *dir)
{
    char path[1024];
    snprintf(path, sizeof path, "%s", dir);
    int why = 0; /* of the first folder above that cannot be made: the last one only misses it */
    for (char *c = path + 1; *c; c++)
        if (*c == '/') {
            *c = '\0';
            if (mkdir(path, 0777) != 0 && errno != EEXIST && !why)
                why = errno;
            if (access(path, F_OK) == 0)
                why = 0;
            *c = '/';
        }
    struct stat is;
    if (mkdir(path, 0777) == 0)
        return true;
    if (errno == EEXIST && stat(path, &is) == 0) {
        errno = S_ISDIR(is.st_mode) ? 0 : ENOTDIR;
        return errno == 0 && access(path, W_OK | X_OK) == 0;
    }
    errno = errno == ENOENT && why ? why : errno;
    return false;
}

/* Number of files of a run of this name in a folder, which are removed if so wished. */
static int find_ours(const char *dir, const char *name, bool removed)
{
    DIR *d = opendir(dir);
    int found = 0;
    for (struct dirent *e; d && (e = readdir(d));) {
        if (!is_ours(e->d_name, name))
            continue;
        found++;
        if (removed)
            unlink(key_text("%s/%s", dir, e->d_name));
    }
    if (d)
        closedir(d);
    return found;
}

/* Whether another process has the folder. If not, this one has it until it ends, however it does:
 * the descriptor stays open, and the system drops its lock. Where there are no locks, no folder is
 * taken. The lock belongs to the process (fcntl), so rank 0 of each program has its own file,
 * .NAME.lock. */
static bool is_taken(const char *dir, const char *name)
{
    const int at = open(key_text("%s/.%s.lock", dir, name), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    return at >= 0 && fcntl(at, F_SETLK, &whole) != 0 && (errno == EACCES || errno == EAGAIN);
}

/* Rank 0: from the folder's state and the options to 0 or an exit code, after saying why. Files of
 * an earlier run go only once the lock is held. */
static int prepare(const char *dir, const char *name, bool force, bool restart)
{
    const bool there = access(dir, F_OK) == 0;
    const int found = find_ours(dir, name, false);
    if (found && !force && !restart) {
        log_say("%s holds a run of %s already: -o DIR for another folder, --force to replace it, "
                "--restart to go on",
                dir, name);
        return RUN_INPUT;
    }
    if (!there && restart) {
        log_say("--restart: there is no folder %s; run without --restart", dir);
        return RUN_INPUT;
    }
    if (!run_make_folder(dir)) {
        log_say("cannot make the folder %s, or write in it: %s", dir, strerror(errno));
        return RUN_INPUT;
    }
    if (is_taken(dir, name)) {
        log_say("a run of %s is at work in %s: stop it, or -o DIR for another folder", name, dir);
        return RUN_INPUT;
    }
    if (force && !restart)
        find_ours(dir, name, true);
    return 0;
}

/* By rank 0; all get its verdict. */
int run_folder(MPI_Comm comm, const char *dir, const char *name, bool force, bool restart)
{
    int rank, code = 0;
    MPI_Comm_rank(comm, &rank);
    if (rank == 0)
        code = prepare(dir, name, force, restart);
    MPI_Bcast(&code, 1, MPI_INT, 0, comm);
    return code;
}
