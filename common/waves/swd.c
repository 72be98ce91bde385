/* swd.c - see swd.h. A file is read byte by byte, lowest first, whatever the machine's order; only
 * shapes 1 and 2 (waves along a line) are taken. Faults found while the file is opened name the
 * byte; a file that cannot be read later ends the run. The fields of a time are summed mode by
 * mode, points times n terms, since a file's modes need not fit a transform.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "swd.h"

#include "../base/base.h"

enum { FORMAT = 100, TEXTS = 30 + 20, MODES_MAX = 1000000 };

struct swd {
    FILE *f;
    char path[512];
    struct swd_header of;
    int64_t data;  /* byte of the first time */
    float *values; /* of one time: h, dh/dt, c, dc/dt, [n + 1][2] each */
    char *error;   /* where faults are told while it is opened */
    size_t size;
};

static bool fault(struct swd *s, int64_t byte, const char *what)
{
    snprintf(s->error, s->size, "%s: byte %lld: %s", s->path, (long long)byte, what);
    return false;
}

/* Numbers of four bytes, the lowest first. */
static bool read_word(struct swd *s, uint32_t *word)
{
    unsigned char b[4];
    if (fread(b, 1, 4, s->f) != 4)
        return fault(s, ftell(s->f), "the file ends before its header does");
    *word = b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
    return true;
}

/* Of 4 bytes, as read_word turns them. */
static bool read_int(struct swd *s, int *v)
{
    uint32_t word;
    if (!read_word(s, &word))
        return false;
    *v = (int)word;
    return true;
}

static bool read_real(struct swd *s, double *v)
{
    uint32_t word;
    float x;
    if (!read_word(s, &word))
        return false;
    memcpy(&x, &word, sizeof x);
    *v = x;
    return true;
}

/* Up to the name of the case. */
static bool read_kind(struct swd *s, int *shape)
{
    double magic;
    int format, amplitudes, name;
    if (!read_real(s, &magic) || !read_int(s, &format) || !read_int(s, shape) ||
        !read_int(s, &amplitudes))
        return false;
    if (fabs(magic - 37.0221) > 1e-4)
        return fault(s, 0, "the first number is not 37.0221: it is no file of spectral wave data");
    if (format != FORMAT)
        return fault(s, 4, "only version 100 of the format is known");
    if (*shape != 1 && *shape != 2)
        return fault(s, 8,
                     "only shapes 1 and 2 (long crests over deep water or one depth) are read");
    if (amplitudes != 1)
        return fault(s, 12, "amplitudes of the velocity potential (1) are needed");
    if (fseek(s->f, TEXTS, SEEK_CUR) != 0 || !read_int(s, &name))
        return false;
    return name >= 0 && fseek(s->f, name, SEEK_CUR) == 0
               ? true
               : fault(s, 16 + TEXTS, "the length of the text is negative");
}

/* From the gravity to the depth, and how many numbers follow; bounds reject what would not be a
 * file of waves. */
static bool read_sizes(struct swd *s, int shape)
{
    double g, scale;
    int stripped;
    struct swd_header *of = &s->of;
    of->depth = -1.0;
    if (!read_real(s, &g) || !read_real(s, &scale) || !read_int(s, &stripped) ||
        !read_int(s, &of->nsteps) || !read_real(s, &of->dt) || !read_int(s, &of->order))
        return false;
    const int64_t at = ftell(s->f);
    if (!read_int(s, &of->n) || !read_real(s, &of->dk) || (shape == 2 && !read_real(s, &of->depth)))
        return false;
    of->depth = of->depth > 0.0 ? of->depth : INFINITY;
    s->data = ftell(s->f);
    if (of->nsteps < 4)
        return fault(s, at - 12, "less than four times");
    if (!(of->dt > 0.0))
        return fault(s, at - 8, "the time between two fields is not above 0");
    if (of->n < 1 || of->n > MODES_MAX)
        return fault(s, at, "the number of modes is not from 1 to 1000000");
    if (!(of->dk > 0.0))
        return fault(s, at + 4, "the step of wave numbers is not above 0");
    return true;
}

static int64_t block_of(const struct swd *s) { return 4 * 2 * 4 * ((int64_t)s->of.n + 1); }

/* Also compares the file's length with what it promises, so that a copy cut short is told at once
 * and not in the middle of a run. */
static bool read_header(struct swd *s)
{
    int shape;
    if (!read_kind(s, &shape) || !read_sizes(s, shape))
        return false;
    if (fseek(s->f, 0, SEEK_END) != 0)
        return fault(s, 0, "it has no end");
    const int64_t end = ftell(s->f);
    if (end < s->data + s->of.nsteps * block_of(s))
        return fault(s, end, "the file ends before the last of its times does");
    return true;
}

static void close_file(void *p)
{
    const struct swd *s = p;
    if (s->f)
        fclose(s->f);
}

/* NULL: what is wrong is in error. */
struct swd *swd_open(const char *path, char *error, size_t size)
{
    struct swd *s = NEW(struct swd, 1);
    mem_at_free(s, close_file);
    snprintf(s->path, sizeof s->path, "%s", path);
    s->error = error;
    s->size = size;
    s->f = fopen(path, "rb");
    if (!s->f)
        snprintf(error, size, "%s cannot be read", path);
    if (!s->f || !read_header(s)) {
        mem_free(s);
        return NULL;
    }
    s->values = NEW_IN(s, float, block_of(s) / 4);
    return s;
}

struct swd_header swd_header_of(const struct swd *s) { return s->of; }

/* Files are of the lowest byte first. */
static float host_order(const unsigned char *b)
{
    const uint32_t word = b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
    float x;
    memcpy(&x, &word, sizeof x);
    return x;
}

/* A time holds h, dh/dt, c, dc/dt; the rates are passed over. */
void swd_read(struct swd *s, int step, double *h, double *c)
{
    const int64_t at = s->data + step * block_of(s);
    const size_t values = 2 * ((size_t)s->of.n + 1);
    unsigned char *bytes = (unsigned char *)s->values;
    if (fseek(s->f, (long)at, SEEK_SET) != 0 || fread(bytes, 4, 4 * values, s->f) != 4 * values)
        abort_run("%s: byte %lld: cannot be read any more", s->path, (long long)at);
    for (size_t i = 0; i < values; i++) {
        h[i] = host_order(bytes + 4 * i);
        c[i] = host_order(bytes + 4 * (2 * values + i));
    }
}

/* Z = U S + V/S, S = e^(kz) or its series, U = (1 + tanh kd)/2, V = 1 - U. Above the still level
 * the file's own expansion of e^(kz) to its order is used: amplitudes were made with it. */
static double height_factor(const struct swd *s, double k, double z)
{
    const double U = 0.5 * (1.0 + tanh(fmin(k * s->of.depth, 300.0)));
    double S = exp(k * z);
    if (z > 0.0 && s->of.order > 0) {
        double term = S = 1.0;
        for (int p = 1; p < s->of.order; p++)
            S += term *= k * z / p;
    }
    return U * S + (1.0 - U) / S;
}

/* Level first, since the potential is asked for on it. */
void swd_fields(const struct swd *s, const double *h, const double *c, int points, double *eta,
                double *phi)
{
    for (int i = 0; i < points; i++) {
        const double x = 2.0 * M_PI * i / points;
        eta[i] = phi[i] = 0.0;
        for (int j = 1; j <= s->of.n; j++)
            eta[i] += h[2 * j] * cos(j * x) + h[2 * j + 1] * sin(j * x);
        for (int j = 1; j <= s->of.n; j++)
            phi[i] += (c[2 * j] * cos(j * x) + c[2 * j + 1] * sin(j * x)) *
                      height_factor(s, j * s->of.dk, eta[i]);
    }
}
