/* exit.h - the exit codes of all programs, as the shell sees them.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

enum run_exit {
    RUN_DONE = 0,         /* the run reached its end and met the case's criteria */
    RUN_NOT_ACCEPTED = 1, /* done, outside the case's own tolerances; and abort_run() */
    RUN_INPUT = 2,    /* case, command line, disk or memory are at fault: the user can mend it */
    RUN_DIVERGED = 3, /* the flow left what the numerics can represent */
    RUN_PARTNER = 4,  /* another program of the coupled job failed or fell silent */
    RUN_STOPPED = 5   /* stopped in order, on request; can be restarted */
};
