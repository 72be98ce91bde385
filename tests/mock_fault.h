/* mock_fault.h - what a test can make the mock solver do wrong, and its key=value options.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TESTS_MOCK_FAULT_H
#define TESTS_MOCK_FAULT_H

#include <math.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "../coupler/cpl.h"

static char **keys; /* "n=40", ... NULL */

static const char *option(const char *key, const char *otherwise)
{
    for (char **k = keys; *k; k++)
        if (strncmp(*k, key, strlen(key)) == 0 && (*k)[strlen(key)] == '=')
            return *k + strlen(key) + 1;
    return otherwise;
}

/* fault=WHAT at=WINDOW: true if a put is to be forgotten. */
static bool fault(struct cpl *c, double *v, long n)
{
    const char *what = option("fault", "none");
    if (cpl_window_number(c) != atoi(option("at", "2")))
        return false;
    if (!strcmp(what, "kill"))
        raise(SIGKILL);
    if (!strcmp(what, "segv"))
        raise(SIGSEGV);
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

#endif
