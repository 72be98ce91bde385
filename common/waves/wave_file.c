/* wave_file.c - see wave_file.h. A file's waves are known as modes over time; components of its
 * first field, as if they were free linear waves, serve for lengths, the gains of zones and the
 * height, not for the velocities.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "wave_file.h"

#include "../base/base.h"

static const double least = 1e-6; /* of the largest amplitude: no component */

/* Modes below `least' of the largest amplitude are rounding or empty. */
struct wave_component *wave_file_components(struct swd *s, double g, double depth, int *n)
{
    const struct swd_header is = swd_header_of(s);
    struct wave_component *c = NEW(struct wave_component, is.n);
    double *h = NEW(double, 2 * (is.n + 1)), *phi = NEW(double, 2 * (is.n + 1)), most = 0.0;
    swd_read(s, 0, h, phi);
    for (int j = 1; j <= is.n; j++)
        most = fmax(most, hypot(h[2 * j], h[2 * j + 1]));
    *n = 0;
    for (int j = 1; j <= is.n; j++) {
        const double a = hypot(h[2 * j], h[2 * j + 1]), k = j * is.dk;
        if (a > least * most)
            c[(*n)++] = (struct wave_component){.a = a,
                                                .k = k,
                                                .w = waves_frequency(k, g, depth),
                                                .phase = -atan2(h[2 * j + 1], h[2 * j]),
                                                .way = {1.0, 0.0}};
    }
    FREE(h, phi);
    return c;
}

/* The length of the mean wave number: single amplitudes are random and do not tell a peak. */
static void measure(struct swd *s, double *height, double *length)
{
    int n;
    double sum = 0.0, mean = 0.0;
    struct wave_component *c = wave_file_components(s, 1.0, 1.0, &n);
    for (int i = 0; i < n; i++) {
        const double square = c[i].a * c[i].a;
        sum += 0.5 * square;
        mean += 0.5 * square * c[i].k;
    }
    *height = 4.0 * sqrt(sum);
    *length = sum > 0.0 ? 2.0 * M_PI * sum / mean : 0.0;
    mem_free(c);
}

/* Three times are left at the end, for cubics between frames. */
bool wave_file_probe(const char *path, double depth, double t0, double t1, double *height,
                     double *length, char *error, size_t size)
{
    struct swd *s = swd_open(path, error, size);
    if (!s)
        return false;
    const struct swd_header is = swd_header_of(s);
    const double end = (is.nsteps - 3) * is.dt;
    measure(s, height, length);
    FREE(s);
    const bool deep = isinf(is.depth);
    const double wanted = deep ? 0.5 * *length : is.depth;
    if (!(*height > 0.0))
        snprintf(error, size, "%s: its first field is still water", path);
    else if (t0 < 0.0 || t1 > end)
        snprintf(error, size,
                 "%s: it holds waves from 0 to %g s, and the run asks for %g to %g s: move its "
                 "beginning by waves.at, or end before it",
                 path, end, t0, t1);
    else if (deep ? depth < wanted : fabs(depth - wanted) > 0.01 * wanted)
        snprintf(error, size, "%s: its waves run over %s%.4g m of water, the case has %.4g m", path,
                 deep ? "deep water, at least " : "", wanted, depth);
    else
        return true;
    return false;
}
