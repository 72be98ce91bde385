/* wave_field_save.c - a wave field in restart files: one state from which its frames follow, so
 * that it need not evolve again from its start. SPDX-License-Identifier: BSD-3-Clause */
#include "wave_field_save.h"

/* Of the waves themselves: files of other ones do not fit. */
static double mark_of(const struct wave_field *f)
{
    double sum = f->t0;
    for (int i = 0; i < f->n; i++)
        sum += f->components[i].a * (f->components[i].k + f->components[i].phase);
    return sum;
}

/* The oldest of the states kept: the frames about the present time, which the cubics need, reach
 * back before the last step. */
void wave_field_save(const struct wave_field *f, struct h5 *file)
{
    int oldest = -1;
    for (int k = 0; k < WAVE_FIELD_KEPT; k++)
        if (f->kept[k] >= 0 && (oldest < 0 || f->kept[k] < f->kept[oldest]))
            oldest = k;
    if (oldest < 0)
        return;
    (void)h5_keep_rows(file, "waves_modes", "m, m^2/s", f->of->grid->cells, 2, f->states[oldest]);
    h5_attribute_int(file, "waves_step", f->kept[oldest]);
    h5_attribute_real(file, "waves_energy", f->energy);
    h5_attribute_real(file, "waves_mark", mark_of(f));
}

/* Where the file has none of these waves they are made again from their start. */
void wave_field_load(struct wave_field *f, struct h5 *file)
{
    int64_t step, n = 0;
    double energy, mark;
    if (!h5_read_attribute_int(file, "waves_step", &step) ||
        !h5_read_attribute_real(file, "waves_energy", &energy) ||
        !h5_read_attribute_real(file, "waves_mark", &mark) || mark != mark_of(f))
        return;
    double *modes = h5_read_all_real(file, "waves_modes", 2, &n);
    if (modes && n == f->of->grid->cells)
        wave_field_set(f, (long)step, modes, energy);
    mem_free(modes);
}
