/* probe_flow.c - samples of a section through which a gauge measures the discharge. 400 in 2D, 100
 * x 100 in 3D, in the middle of equal parts. The sum of u.n counts each by how much of it is water,
 * by the level set over the samples' distance: a share between 0 and 1 next to the surface.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "probe_flow.h"

#include "../../common/scene/scene.h"

enum { ALONG_LINE = 400, ALONG_SIDE = 100 };

/* Position k of the sample runs along the section's tangents; across is its unit normal. */
struct flow_samples flow_samples_create(const struct fv *s, const struct scene_probe *g)
{
    const struct probe_section c = probe_section_of(g, s->dim);
    const int each = s->dim == 2 ? ALONG_LINE : ALONG_SIDE, second = s->dim == 2 ? 1 : each;
    struct flow_samples f = {.n = each * second, .area = 1.0};
    f.x = (double(*)[3])NEW(double, f.n * 3);
    f.value = (double(*)[FLOW_VALUES])NEW(double, f.n *FLOW_VALUES);
    for (int k = 0; k < c.n; k++) {
        f.area *= c.length[k] / each;
        f.step = fmax(f.step, c.length[k] / each);
    }
    for (int a = 0; a < s->dim; a++)
        f.across[a] = c.across[a];
    for (int i = 0; i < f.n; i++) {
        const int at[2] = {i % each, i / each};
        for (int a = 0; a < s->dim; a++) {
            f.x[i][a] = g->at[a];
            for (int k = 0; k < c.n; k++)
                f.x[i][a] += c.along[k][a] * c.length[k] * (at[k] + 0.5) / each;
        }
    }
    return f;
}

void flow_samples_free(struct flow_samples *f) { FREE(f->x, f->value); }

/* m^dim/s: area of a sample times the sum. */
double flow_samples_sum(const struct flow_samples *f, int dim)
{
    double sum = 0.0;
    for (int i = 0; i < f->n; i++) {
        const double *v = f->value[i];
        const double wet = fmin(fmax(0.5 - v[3] / f->step, 0.0), 1.0);
        for (int a = 0; a < dim; a++)
            sum += wet * f->across[a] * v[a];
    }
    return f->area * sum;
}
