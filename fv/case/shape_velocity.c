/* shape_velocity.c - velocities that shapes add to the field at the start, in a flow without a
 * surface of its own; with one, surface_steps.c does it. SPDX-License-Identifier: BSD-3-Clause */
#include "../../common/scene/scene.h"
#include "fv_case.h"

/* Points along each edge of a cell; where they differ, its halves are looked at, and theirs, so
 * that u is that to a 64th of the cell, in 3D to a 16th. */
enum { POINTS = 4, HALVINGS = 4, HALVINGS_3D = 2 };

/* A cell or a face: its middle and its edges, m, 0 along axes that it does not have. */
struct sampled {
    double x[3], h[3];
};

/* The mean over n[a] points along each edge; whether all are alike. */
static bool sample(const struct fv *s, const struct sampled *r, const int *n, double *mean)
{
    const struct scene *c = &s->run->scene;
    const int all = n[0] * n[1] * n[2];
    double first[3] = {0.0, 0.0, 0.0}, sum[3] = {0.0, 0.0, 0.0};
    bool alike = true;
    for (int k = 0; k < all; k++) {
        const int at[3] = {k % n[0], k / n[0] % n[1], k / n[0] / n[1]};
        double y[3], v[3];
        for (int a = 0; a < 3; a++)
            y[a] = r->x[a] + ((at[a] + 0.5) / n[a] - 0.5) * r->h[a];
        scene_is_fluid(c, &s->exact, y, v);
        for (int a = 0; a < 3; a++) {
            first[a] = k == 0 ? v[a] : first[a];
            alike = alike && v[a] == first[a];
            sum[a] += v[a];
        }
    }
    for (int a = 0; a < 3; a++)
        mean[a] = alike ? first[a] : sum[a] / all;
    return alike;
}

static void average(const struct fv *s, const struct sampled *r, int halvings, double *mean)
{
    int n[3], parts[3];
    for (int a = 0; a < 3; a++) {
        n[a] = r->h[a] > 0.0 ? POINTS : 1;
        parts[a] = r->h[a] > 0.0 ? 2 : 1;
    }
    const int all = parts[0] * parts[1] * parts[2];
    if (sample(s, r, n, mean) || halvings == 0 || all == 1)
        return;
    double sum[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < all; k++) {
        const int at[3] = {k % parts[0], k / parts[0] % parts[1], k / parts[0] / parts[1]};
        struct sampled part;
        double v[3];
        for (int a = 0; a < 3; a++) {
            part.h[a] = r->h[a] / parts[a];
            part.x[a] = r->x[a] + (at[a] + 0.5 - 0.5 * parts[a]) * part.h[a];
        }
        average(s, &part, halvings - 1, v);
        for (int a = 0; a < 3; a++)
            sum[a] += v[a];
    }
    for (int a = 0; a < 3; a++)
        mean[a] = sum[a] / all;
}

void fv_shape_velocity(const struct fv *s, const double *x, const double *h, double *u)
{
    struct sampled r = {.h = {0.0, 0.0, 0.0}};
    double mean[3];
    if (surface_wanted(s->run) || !scene_shapes_move(&s->run->scene))
        return;
    for (int a = 0; a < 3; a++) {
        r.x[a] = x[a];
        r.h[a] = a < s->dim ? h[a] : 0.0;
    }
    average(s, &r, s->dim == 3 ? HALVINGS_3D : HALVINGS, mean);
    for (int a = 0; a < s->dim; a++)
        u[a] += mean[a];
}
