/* disk.c - files that cannot be written, files that are damaged; see disk.h. disk_seal and
 * disk_sealed read the whole file back once, in pieces of CHUNK bytes, on the one rank that closes
 * or opens a restart file. The seal is kept in the machine's order of bytes, so that a restart file
 * is good between machines of the same order alone.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "disk.h"

#include <errno.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include "../base/base.h"

enum { CHUNK = 1 << 20, WORDS = 2, SPARE = 1 << 16 /* bytes: what the library adds */ };
static const uint64_t MARK = 0x314c414553545345u; /* "ESTSEAL1" */

/* Bytes that are free where a path is, infinite if that cannot be told. */
static double free_bytes(const char *path)
{
    char dir[1200];
    struct statvfs v;
    snprintf(dir, sizeof dir, "%s", path);
    char *slash = strrchr(dir, '/');
    if (slash)
        *slash = '\0';
    return statvfs(slash ? dir : ".", &v) == 0 ? (double)v.f_bavail * (double)v.f_frsize : INFINITY;
}

/* errno is read first, before other calls change it. A file that is open keeps its blocks when its
 * name is removed, therefore it is cut to nothing first. */
void disk_failed(const char *path)
{
    char reason[160];
    snprintf(reason, sizeof reason, "%s", errno ? strerror(errno) : "no reason is known");
    if (free_bytes(path) < 1e6)
        snprintf(reason, sizeof reason, "the disk is full");
    if (strlen(path) > 5 && strcmp(path + strlen(path) - 5, ".part") == 0) {
        const int gone = truncate(path, 0); /* room for last words, though it is still open */
        if (gone == 0)
            unlink(path);
    }
    fail_with(RUN_INPUT, "cannot write %s: %s; restart files that were complete before are intact",
              path, reason);
}

FILE *disk_begin(const char *path)
{
    char part[1200];
    snprintf(part, sizeof part, "%s.part", path);
    FILE *f = fopen(part, "w");
    if (!f)
        disk_failed(part);
    return f;
}

void disk_finish(FILE *f, const char *path)
{
    char part[1200];
    snprintf(part, sizeof part, "%s.part", path);
    if (fclose(f) != 0 || rename(part, path) != 0)
        disk_failed(path);
}

void disk_room(const char *path, double bytes)
{
    if (free_bytes(path) >= bytes + SPARE)
        return;
    errno = ENOSPC;
    disk_failed(path);
}

/* Sum of n bytes read from f, eight at a time (multiply and rotate, so that the place counts). With
 * h the sum so far and w the next eight bytes (zeros behind the end): h <- rotate((h ^ w) m, 29) +
 * c. m is odd, so that no step loses a bit of h: a change in one word always changes the sum. The
 * length is mixed in last, for the zeros that fill the last word would else hide a file that is cut
 * short there. It guards against accidents, not against intent. */
static bool sum_of(FILE *f, long n, uint64_t *sum)
{
    uint64_t h = 0x9e3779b97f4a7c15u, *words = NEW(uint64_t, CHUNK / 8);
    bool good = true;
    for (long left = n; left > 0 && good;) {
        const size_t want = left < CHUNK ? (size_t)left : CHUNK;
        memset(words, 0, CHUNK);
        good = fread(words, 1, want, f) == want;
        for (size_t k = 0; k < (want + 7) / 8; k++) {
            h = (h ^ words[k]) * 0xff51afd7ed558ccdu;
            h = (h << 29 | h >> 35) + 0x52dce729u;
        }
        left -= (long)want;
    }
    mem_free(words);
    *sum = h ^ (uint64_t)n;
    return good;
}

static long length_of(FILE *f) { return fseek(f, 0, SEEK_END) == 0 ? ftell(f) : -1; }

bool disk_seal(const char *path)
{
    FILE *f = fopen(path, "r+b");
    if (!f)
        return false;
    uint64_t seal[WORDS] = {MARK, 0};
    const long n = length_of(f);
    rewind(f);
    bool good = n >= 0 && sum_of(f, n, seal + 1);
    good = good && fseek(f, 0, SEEK_END) == 0 && fwrite(seal, sizeof seal, 1, f) == 1;
    return fclose(f) == 0 && good;
}

bool disk_sealed(const char *path)
{
    FILE *f = fopen(path, "rb");
    if (!f)
        return false;
    uint64_t seal[WORDS] = {0, 0}, sum = 0;
    const long n = length_of(f) - (long)sizeof seal;
    bool good = n > 0 && fseek(f, n, SEEK_SET) == 0 && fread(seal, sizeof seal, 1, f) == 1;
    rewind(f);
    good = good && seal[0] == MARK && sum_of(f, n, &sum) && sum == seal[1];
    fclose(f);
    return good;
}
