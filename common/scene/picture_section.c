/* picture_section.c - see picture_section.h. SPDX-License-Identifier: BSD-3-Clause */
#include "picture_section.h"

/* By a raster: N places along each axis are enough for where to cut. */
double picture_water_middle(const struct scene *s, int axis)
{
    enum { N = 16 };
    const struct exact e = exact_create(s);
    const struct scene_domain *d = &s->domain;
    double sum = 0.0;
    int n = 0;
    for (int k = 0; k < N * N * N; k++) {
        const int i[3] = {k % N, k / N % N, k / N / N};
        double x[3];
        for (int a = 0; a < 3; a++)
            x[a] = d->min[a] + (i[a] + 0.5) / N * (d->max[a] - d->min[a]);
        if (scene_matter(s, &e, x) != MATTER_FLUID)
            continue;
        sum += x[axis];
        n++;
    }
    return n > 0 ? sum / n : 0.5 * (d->min[axis] + d->max[axis]);
}

bool picture_is_sharp(const struct trimesh *m, int a, int b)
{
    double n[3], q[3];
    trimesh_normal(m, a, n);
    trimesh_normal(m, b, q);
    return vec3_dot(n, q) < cos(30.0 * M_PI / 180.0);
}
