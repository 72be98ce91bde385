/* test_swd.c - waves of a file: a file that this test writes gives the level and the velocities of
 * its two linear waves, at its places and times and moved; files that are none, of other shapes or
 * cut off are refused with the byte; a case of other depth or longer is refused.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include <complex.h>
#include <unistd.h>

#include "../../../common/waves/wave_field.h"
#include "../../../common/waves/wave_file.h"

enum { MODES = 8, TIMES = 200 };
static const double gravity = 9.81, depth = 0.4, step = 0.02, amplitude[2] = {5e-4, 2e-4};
static const int mode[2] = {2, 5};
static double dk(void) { return 2.0 * M_PI / 3.0; }

static void put_int(FILE *f, int v)
{
    for (int k = 0; k < 4; k++)
        fputc((unsigned)v >> 8 * k & 255u, f);
}

static void put_real(FILE *f, double v)
{
    const float x = (float)v;
    int bits;
    memcpy(&bits, &x, sizeof bits);
    put_int(f, bits);
}

static double frequency(int w)
{
    const double k = mode[w] * dk();
    return sqrt(gravity * k * tanh(k * depth));
}

/* h, dh/dt, c, dc/dt of a time: eta = a cos(wt - kx), phi = g a/w sin(kx - wt). */
static void put_time(FILE *f, double t)
{
    for (int part = 0; part < 4; part++)
        for (int j = 0; j <= MODES; j++) {
            double complex v = 0.0;
            for (int w = 0; w < 2; w++)
                if (j == mode[w])
                    v = amplitude[w] * cexp(I * frequency(w) * t) *
                        (part >= 2 ? I * gravity / frequency(w) : 1.0) *
                        (part % 2 ? I * frequency(w) : 1.0);
            put_real(f, creal(v));
            put_real(f, cimag(v));
        }
}

static const char *write_file(int shape, double magic)
{
    static char path[256];
    const char *dir = getenv("TEST_SCRATCH");
    snprintf(path, sizeof path, "%s/test_swd_%d.swd", dir ? dir : P_tmpdir, (int)getpid());
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    put_real(f, magic);
    put_int(f, 100);
    put_int(f, shape);
    put_int(f, 1);
    fprintf(f, "%-30s%-20s", "test_swd", "today");
    put_int(f, 3);
    fputs("two", f);
    put_real(f, gravity);
    put_real(f, 1.0);
    put_int(f, 0);
    put_int(f, TIMES);
    put_real(f, step);
    put_int(f, -1);
    put_int(f, MODES);
    put_real(f, dk());
    if (shape == 2)
        put_real(f, depth);
    for (int k = 0; k < TIMES; k++)
        put_time(f, k * step);
    fclose(f);
    return path;
}

/* Linear theory holds to the steepness, 2e-3; the tables to less. */
TEST(files_give_their_waves)
{
    const char *path = write_file(2, 37.0221);
    struct wave_spec of = {.kind = WAVE_FILE,
                           .depth = depth,
                           .g = gravity,
                           .rho = 1000.0,
                           .repeat = 60.0,
                           .at = {0.7, -0.5},
                           .window = {{0.0, 1.0}, {0.0, 0.0}}};
    char error[300];
    assert_true(
        wave_file_probe(path, depth, 0.5, 2.5, &of.height, &of.length, error, sizeof error));
    assert_close(of.height, 4.0 * sqrt(0.5) * hypot(amplitude[0], amplitude[1]), 1e-9);
    snprintf(of.file, sizeof of.file, "%s", path);
    struct waves *w = waves_create(&of);
    assert_int_equal(w->ncomponents, 2);
    for (int i = 0; i < 40; i++) {
        const double t = 0.047 * i, x = 0.024 * i, z = -0.01 * i;
        double eta = 0.0, u[2] = {0.0, 0.0}, is[3], speed = 0.0;
        for (int k = 0; k < 2; k++) {
            const double q = mode[k] * dk(), a = amplitude[k] * frequency(k) / sinh(q * depth),
                         th = q * (x - 0.7) - frequency(k) * (t + 0.5);
            eta += amplitude[k] * cos(th);
            u[0] += a * cosh(q * (z + depth)) * cos(th);
            u[1] += a * sinh(q * (z + depth)) * sin(th);
            speed += a * cosh(q * depth);
        }
        waves_at(w, t);
        waves_velocity(w, x, 0.0, z, is);
        assert_close(waves_eta(w, x, 0.0), eta, 2e-3 * (amplitude[0] + amplitude[1]));
        assert_close(is[0], u[0], 6e-3 * speed);
        assert_close(is[1], u[1], 6e-3 * speed);
    }
    FREE(w);
    remove(path);
}

static void refused(const char *path, const char *what)
{
    char error[300] = "";
    struct swd *s = swd_open(path, error, sizeof error);
    assert_null(s);
    if (!strstr(error, what))
        print_message("%s\n", error);
    assert_non_null(strstr(error, what));
}

TEST(bad_files_are_told)
{
    char error[300];
    double a, b;
    refused("no such file.swd", "cannot be read");
    refused(write_file(2, 37.1), "byte 0: the first number is not 37.0221");
    refused(write_file(3, 37.0221), "byte 8: only shapes 1 and 2");
    const char *path = write_file(1, 37.0221);
    assert_false(wave_file_probe(path, depth, 0.0, 1.0, &a, &b, error, sizeof error));
    assert_non_null(strstr(error, "deep water, at least 0.6"));
    path = write_file(2, 37.0221);
    assert_false(wave_file_probe(path, 0.5, 0.0, 1.0, &a, &b, error, sizeof error));
    assert_non_null(strstr(error, "0.4 m of water, the case has 0.5 m"));
    assert_false(wave_file_probe(path, depth, 0.0, 4.5, &a, &b, error, sizeof error));
    assert_non_null(strstr(error, "from 0 to 3.94 s, and the run asks for 0 to 4.5 s"));
    assert_int_equal(truncate(path, 1000), 0);
    refused(path, "byte 1000: the file ends before the last of its times");
    assert_int_equal(truncate(path, 80), 0);
    refused(path, "byte 80: the file ends before its header does");
    remove(path);
}
