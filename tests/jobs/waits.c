/* waits.c - preloaded by tests/run: a rank that waits for others sleeps between two looks for their
 * messages. Open MPI only yields its core there, which takes up to a third of the processor time of
 * units on four ranks, from what else runs on these cores. SPDX-License-Identifier: BSD-3-Clause */
#include <sched.h>
#include <time.h>

int sched_yield(void)
{
    const struct timespec nap = {0, 20000}; /* and as long again until the core is given back */
    clock_nanosleep(CLOCK_MONOTONIC, 0, &nap, NULL);
    return 0;
}
