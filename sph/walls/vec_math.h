/* vec_math.h - arc tangent and logarithm of LANES doubles without branches, to the last digits.
 * Coefficients: Moshier, Methods and Programs for Mathematical Functions, 1989 (atan); Ng, fdlibm,
 * 1993 (log). SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_VEC_MATH_H
#define SPH_VEC_MATH_H

#include "../pairs/sph_pairs.h"

/* a where the mask is set, else b. */
INLINE vec vec_pick(vec_bits mask, vec a, vec b)
{
    return (vec)((mask & (vec_bits)a) | (~mask & (vec_bits)b));
}

/* |x| <= tan(pi/8) */
INLINE vec vec_atan_small(vec x)
{
    const vec z = x * x;
    const vec P = (((-8.750608600031904122785e-1 * z - 1.615753718733365076637e1) * z -
                    7.500855792314704667340e1) *
                       z -
                   1.228866684490136173410e2) *
                      z -
                  6.485021904942025371773e1;
    const vec Q = ((((z + 2.485846490142306297962e1) * z + 1.650270098316988542046e2) * z +
                    4.328810604912902668951e2) *
                       z +
                   4.853903996359136964868e2) *
                      z +
                  1.945506571482613964425e2;
    return x + x * (z * P / Q);
}

/* Of finite numbers that are not both 0. */
INLINE vec vec_atan2(vec y, vec x)
{
    const vec_bits minus = (vec_bits)vec_all(-0.0), sign = (vec_bits)y & minus;
    const vec ay = (vec)((vec_bits)y & ~minus), ax = (vec)((vec_bits)x & ~minus);
    const vec lo = vec_min(ay, ax), hi = vec_max(ay, ax);
    const vec_bits large = lo > 0.41421356237309503 * hi; /* beyond tan(pi/8) turn by pi/4 */
    const vec t = vec_pick(large, lo - hi, lo) / vec_pick(large, lo + hi, hi);
    vec angle = vec_atan_small(t) + vec_pick(large, vec_all(0.25 * M_PI), vec_all(0.0));
    angle = vec_pick(ay > ax, 0.5 * M_PI - angle, angle);
    angle = vec_pick(x < vec_all(0.0), M_PI - angle, angle);
    return (vec)((vec_bits)angle ^ sign);
}

/* Of normal numbers > 0. */
INLINE vec vec_log(vec x)
{
    const vec_bits bits = (vec_bits)x;
    const vec_bits above = bits + (0x3ff0000000000000 - 0x3fe6a09e667f3bcd); /* sqrt(1/2) */
    const vec_bits k = (above >> 52) - 0x3ff;
    const vec f = (vec)(bits - (k << 52)) - 1.0; /* x = 2^k (1 + f) */
    const vec K = __builtin_convertvector(k, vec);
    const vec s = f / (2.0 + f), z = s * s, half = 0.5 * f * f;
    const vec R =
        z * (6.666666666666735130e-1 +
             z * (3.999999999940941908e-1 +
                  z * (2.857142874366239149e-1 +
                       z * (2.222219843214978396e-1 +
                            z * (1.818357216161805012e-1 +
                                 z * (1.531383769920937332e-1 + z * 1.479819860511658591e-1))))));
    return K * 6.93147180369123816490e-1 -
           ((half - (s * (half + R) + K * 1.90821492927058770002e-10)) - f);
}

#endif
