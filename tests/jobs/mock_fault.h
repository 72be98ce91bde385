/* mock_fault.h - options of the mock solver, and what a test can make it do wrong. Keys: n (a
 * side), dim, back (direction of what it gives), mls, cubic, unit, hash, dt, still (never moves),
 * end (window in which it asks for an orderly end), deadline, patience and late (s), fault (below)
 * at=WINDOW. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <math.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "../../coupler/cpl.h"

static char **keys; /* "n=40", ... NULL */

static const char *option(const char *key, const char *otherwise)
{
    for (char **k = keys; *k; k++)
        if (strncmp(*k, key, strlen(key)) == 0 && (*k)[strlen(key)] == '=')
            return *k + strlen(key) + 1;
    return otherwise;
}

static int number(const char *key, int otherwise)
{
    const char *text = option(key, NULL);
    return text ? atoi(text) : otherwise;
}

static void read_options(char **all)
{
    keys = all;
    sleep((unsigned)number("late", 0));
}

/* A refused plan: leaves in order; anything else ends the job. */
static void must(struct cpl *c, int code)
{
    if (code == CPL_OK)
        return;
    fprintf(stderr, "%s\n", cpl_strerror(c));
    cpl_close(&c, -code);
    MPI_Finalize();
    exit(-code);
}

/* SIGTERM: the launcher ends the job. Says why. */
static void last_words(int signal)
{
    cpl_obituary(STDERR_FILENO);
    _exit(128 + signal);
}

/* True if a put is to be forgotten. */
static bool fault(struct cpl *c, double *v, long n)
{
    const char *what = option("fault", "none");
    if (cpl_window_number(c) != number("at", 2))
        return false;
    if (!strcmp(what, "kill"))
        raise(SIGKILL);
    if (!strcmp(what, "segv"))
        raise(SIGSEGV);
    if (!strcmp(what, "stop"))
        raise(SIGSTOP);
    if (!strcmp(what, "exit"))
        exit(0);
    if (!strcmp(what, "finalize"))
        MPI_Finalize();
    if (!strcmp(what, "abort"))
        cpl_fail(c, 3, "the mock has had enough");
    if (!strcmp(what, "sleep"))
        sleep(3);
    if (!strcmp(what, "nan") && n > 0)
        v[0] = NAN;
    return !strcmp(what, "forget");
}
