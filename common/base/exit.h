/* exit.h - the exit codes of all programs. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_EXIT_H
#define COMMON_EXIT_H

enum run_exit {
    RUN_DONE = 0,
    RUN_NOT_ACCEPTED = 1, /* done, outside the case's own tolerances */
    RUN_INPUT = 2,
    RUN_DIVERGED = 3,
    RUN_PARTNER = 4,
    RUN_STOPPED = 5 /* in order, on request; can be restarted */
};

#endif
