/* hypre_call.h - calls of hypre. The library combines all errors in one flag; "not converged" is
 * left for the caller to judge, any other error ends the run through abort_run().
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <HYPRE_utilities.h>

#include "../../common/base/base.h"

#define HYPRE(call)                                                                                \
    do {                                                                                           \
        (void)(call);                                                                              \
        HYPRE_ClearError(HYPRE_ERROR_CONV);                                                        \
        if (HYPRE_GetError())                                                                      \
            abort_run("%s: hypre error %d", #call, (int)HYPRE_GetError());                         \
    } while (0)
