/* test_reflection.c - incident and reflected waves from gauges: exact for made-up ones, as Goda &
 * Suzuki have it for two, insensitive to noise, as wrong as theory says with a wrong wave number;
 * heights and spectra of known histories. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include <complex.h>
#include <sys/stat.h>

#include "../../../common/run/wave_gauges.h"
#include "../../../common/waves/reflection.h"

enum { N = 2000, GAUGES = 3 };
static const double places[GAUGES] = {0.0, 0.1, 0.27}; /* wave lengths */

/* Gauge g of a wave of 1 and one of R back, T = 1, over n periods with uneven steps, noise. */
static double complex measured(int g, double R, int periods, double noise, double second)
{
    static double t[N], v[N];
    const double k = 2.0 * M_PI, w = 2.0 * M_PI, x = places[g];
    for (int i = 0; i < N; i++) {
        t[i] = periods * (i + 0.3 * sin(0.7 * i) * (i > 0 && i < N - 1)) / (N - 1.0);
        v[i] = 0.3 + cos(w * t[i] - k * x) + R * cos(w * t[i] + k * x + 0.4) +
               second * cos(2.0 * w * t[i] - k * x) +
               noise * 2.0 * sqrt(3.0) * (rand() / (RAND_MAX + 1.0) - 0.5);
    }
    return reflection_amplitude(N, t, v, w);
}

static double ratio(int n, double R, double k_off, double noise)
{
    double x[GAUGES];
    double complex A[GAUGES];
    for (int g = 0; g < n; g++) {
        x[g] = places[g];
        A[g] = measured(g, R, 10, noise, 0.1);
    }
    const struct reflection r = reflection_separate(n, x, A, 2.0 * M_PI * (1.0 + k_off));
    return cabs(r.back) / cabs(r.onward);
}

TEST(waves_are_told_apart)
{
    assert_close(ratio(3, 0.3, 0.0, 0.0), 0.3, 1e-9);
    assert_close(ratio(2, 0.05, 0.0, 0.0), 0.05, 1e-9);
    assert_close(ratio(3, 0.05, 0.0, 0.01), 0.05, 0.003);
    const double wrong = ratio(3, 0.0, 0.01, 0.0); /* 0.006 of the incident wave */
    assert_true(wrong > 0.003 && wrong < 0.009);
}

/* Two gauges: Goda & Suzuki's closed form; half a length apart tells nothing. */
TEST(two_gauges_are_goda_and_suzukis)
{
    const double x[2] = {0.2, 0.31}, k = 2.0 * M_PI, d = k * (x[1] - x[0]);
    const double complex A[2] = {1.0 + 0.2 * I, 0.4 - 0.9 * I};
    const struct reflection r = reflection_separate(2, x, A, k);
    const double complex onward = (A[0] * cexp(I * d) - A[1]) / (2.0 * I * sin(d)),
                         back = (A[1] - A[0] * cexp(-I * d)) / (2.0 * I * sin(d));
    assert_close(cabs(r.onward), cabs(onward), 1e-13);
    assert_close(cabs(r.back), cabs(back), 1e-13);
    assert_close(r.rest, 0.0, 1e-13);
    const double half[2] = {0.0, 0.5};
    assert_close(reflection_separate(2, half, A, k).condition, 0.0, 1e-12);
}

TEST(wave_numbers_are_found)
{
    const double x[4] = {0.0, 0.1, 0.27, 0.8}, k = 2.0 * M_PI;
    double complex A[4];
    for (int g = 0; g < 4; g++)
        A[g] = cexp(-I * (k * x[g])) + 0.1 * cexp(I * (k * x[g] + 1.0));
    assert_close(reflection_fit_number(4, x, A, 1.02 * k, 0.05), k, 1e-6);
}

enum { LINES = 29 }; /* 12/20 to 40/20 Hz */

/* A sea of the peak period 0.9 s that repeats itself after 20 s, and a share R of each of its lines
 * that runs back, at gauges over 0.16 m of water, from 18 s to the end: rows of the file. */
static void write_sea(const char *path, const double *x, double R, double end)
{
    FILE *f = fopen(path, "w");
    fputs("t [s],a [m],b [m],c [m]\n", f);
    for (double t = 18.0; t <= end; t += 0.02) {
        fprintf(f, "%.17g", t);
        for (int g = 0; g < GAUGES; g++) {
            double eta = 0.16;
            for (int j = 0; j < LINES; j++) {
                const double w = 2.0 * M_PI * (12 + j) / 20.0, k = waves_number(w, 9.81, 0.16),
                             a = 0.001 * exp(-0.02 * (j - 10) * (j - 10)), at = w * t + 7.0 * j * j;
                eta += a * (cos(at - k * x[g]) + R * cos(at + k * x[g] + 2.0 * j));
            }
            fprintf(f, ",%.17g", eta);
        }
        fputc('\n', f);
    }
    fclose(f);
}

/* What comes back of a sea, by a record that is longer than what it repeats itself after: its last
 * 20 s are taken, for their lines do not leak into each other. waves, below: depths of the waves
 * that are made and below the gauges, m; 0: the same. */
static double of_sea_to(double end, double R, double waves, double below)
{
    const char *folder = unit_file("sea"); /* of its own: tests run beside each other */
    char path[400], spectrum[400];
    const double x[GAUGES] = {2.0, 2.2, 2.6};
    struct scene *s = NEW(struct scene, 1);
    double is = NAN;
    *s = (struct scene){.has_waves = true, .nprobes = GAUGES, .ngauges = 1, .nshapes = 1};
    s->domain.dim = 2;
    s->fluid.gravity[1] = -9.81;
    s->shapes[0] = (struct scene_shape){.form = SHAPE_BELOW, .level = waves};
    s->waves =
        (struct scene_waves){.kind = WAVE_SEA, .height = 0.01, .period = 0.9, .repeat = 20.0};
    s->waves.made.period = 0.9;
    s->gauges[0] =
        (struct scene_gauges){.name = "tank", .probes = "a b c", .from = 18.0, .depth = below};
    for (int g = 0; g < GAUGES; g++) {
        s->probes[g] = (struct scene_probe){.kind = PROBE_LEVEL, .at = {x[g], 0.17}};
        s->probes[g].name[0] = (char)('a' + g);
    }
    struct summary *to = summary_create();
    mkdir(folder, 0700);
    snprintf(path, sizeof path, "%s/series.csv", folder);
    snprintf(spectrum, sizeof spectrum, "%s/spectrum_tank.csv", folder);
    write_sea(path, x, R, end);
    wave_gauges_judge(s, path, folder, to);
    summary_find(to, "reflection.tank.R", &is);
    FREE(to);
    remove(path);
    remove(spectrum);
    mem_free(s);
    return is;
}

static double of_sea(double R, double waves, double below)
{
    return of_sea_to(40.0, R, waves, below);
}

TEST(seas_are_told_apart_by_their_lines)
{
    assert_close(of_sea(0.0, 0.16, 0.0), 0.0, 0.01);
    assert_close(of_sea(0.05, 0.16, 0.0), 0.05, 0.01);
}

/* What leaks out of its lines is no wave that comes back (an R of 0.1, or 0.05 under one window for
 * all gauges): 16 periods of a sea that repeats itself after 22. */
TEST(ends_of_a_sea_are_no_reflection)
{
    assert_true(of_sea_to(18.0 + 16.5 * 0.9, 0.0, 0.16, 0.0) < 0.02);
    assert_close(of_sea_to(18.0 + 16.5 * 0.9, 0.2, 0.16, 0.0), 0.2, 0.01);
}

/* Before a wall the error of the gauges does not turn the waves round. */
TEST(walls_return_all)
{
    assert_close(of_sea(1.03, 0.16, 0.0), 1.03, 0.01);
    assert_close(of_sea(2.0, 0.16, 0.0), 0.5, 0.01);
}

/* Gauges on a shelf half as deep as where the waves are made. */
TEST(waves_have_the_length_of_the_depth_below_their_gauges)
{
    assert_close(of_sea(0.05, 0.32, 0.16), 0.05, 0.01);
    assert_true(of_sea(0.05, 0.32, 0.0) > 0.1);
}

/* Heights of a sum of two waves of 1 and 1.2 Hz: their beats; a sine has one height. The spectrum
 * holds the variance and peaks where the wave is. */
TEST(heights_and_spectra)
{
    static double t[N], v[N];
    double f[SPECTRUM_BINS], S[SPECTRUM_BINS], sum = 0.0;
    for (int i = 0; i < N; i++) {
        t[i] = 20.0 * i / (N - 1.0);
        v[i] = 5.0 + 0.1 * sin(2.0 * M_PI * t[i] - 1.0);
    }
    const struct wave_heights h = wave_heights_of(N, t, v);
    assert_true(h.n == 19);
    assert_close(h.mean, 0.2, 1e-4);
    assert_close(h.significant, 0.2, 1e-4);
    assert_close(h.period, 1.0, 1e-4);
    assert_close(h.spectral, 0.2 * sqrt(2.0), 1e-4); /* 4 a/sqrt(2) */
    wave_spectrum(N, t, v, 3, f, S);
    int peak = 0;
    for (int j = 0; j < SPECTRUM_BINS; j++) {
        sum += S[j] * f[0];
        peak = S[j] > S[peak] ? j : peak;
    }
    assert_close(sum, 0.005, 1e-4);
    assert_close(f[peak], 1.0, 0.06);
}
