/* fft.h - discrete Fourier transforms of many fields at once, in double precision and without
 * plans that measure: the same bits every time. Stockham's autosort algorithm with radices 4, 2,
 * 3 and 5. Fields stand side by side: z[n][inner][2][batch], real parts of a batch before its
 * imaginary parts, so that all loops run over neighbours in memory.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_FFT_H
#define COMMON_FFT_H

struct fft;

/* The next even number >= n without other factors than 2, 3 and 5. */
int fft_size(int n);
/* Of n points, n = fft_size(n), or 1. */
struct fft *fft_create(int n);
void fft_free(struct fft **f);
/* z <- sum over j of z_j e^(sign 2 pi i jk/n), sign = -1 or 1, not scaled. work: as large as z; the
 * result stands in z. */
void fft_run(const struct fft *f, int sign, int inner, int batch, double *z, double *work);

#endif
