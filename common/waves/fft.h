/* fft.h - discrete Fourier transforms of many fields at once, in double precision and without plans
 * that measure, so that the bits are the same every time. Stockham's autosort algorithm with
 * radices 4, 2, 3 and 5. Fields are interleaved: z[n][inner][2][batch], the real parts of a batch
 * before its imaginary parts, so that all loops run over neighbours in memory.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_FFT_H
#define COMMON_FFT_H

/* factors of a transform: made by fft_create */
struct fft;

/* The smallest even number >= n without prime factors other than 2, 3 and 5. */
int fft_size(int n);
/* For n points along the first index, n = fft_size(n) or 1. Owned by the caller. */
struct fft *fft_create(int n);
/* z_k <- sum over j of z_j exp(sign 2 pi i jk/n), sign = -1 or 1, not scaled. `work' is as large as
 * z; the result is in z. */
void fft_run(const struct fft *f, int sign, int inner, int batch, double *z, double *work);

#endif
