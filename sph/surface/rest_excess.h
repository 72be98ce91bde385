/* rest_excess.h - pressure of particles at rest beyond their weight near a free surface.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

/* Of rho g R, at a depth below the surface over R, the kernel's support; both without unit. 0 from
 * R/4 above the surface and below 0.87 R. */
double rest_excess(double depth);
