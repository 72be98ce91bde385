/* regions_describe.c - what --check says and draws of refinement. All of it makes the regions anew
 * from the parameters and frees them again, for --check has no state.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../../common/scene/scene.h"
#include "regions.h"
#include "regions_check.h"
#include "regions_parts.h"

double regions_finest(const struct run *r, const struct sph_params *used)
{
    const struct apr_params *prm = apr_params_of(r);
    return prm ? ldexp(used->dx, -prm->levels) : used->dx;
}

/* Widens b by lo .. hi, grown by `by' and cut at the domain. */
static void include(struct box *b, const struct regions *g, const double *lo, const double *hi,
                    double by)
{
    for (int a = 0; a < g->dim; a++) {
        b->lo[a] = fmin(b->lo[a], fmax(lo[a] - by, g->domain.lo[a]));
        b->hi[a] = fmax(b->hi[a], fmin(hi[a] + by, g->domain.hi[a]));
    }
}

/* The part of the domain that holds the fixed regions of a level. */
static struct box bounds_of(const struct regions *g, int n)
{
    const struct level *l = g->level + n;
    struct box b = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (int k = 0; k < l->boxes.n; k++)
        include(&b, g, l->boxes.of[k].lo, l->boxes.of[k].hi, 0.0);
    for (int k = 0; k < l->nballs; k++)
        include(&b, g, l->balls[k].centre, l->balls[k].centre, l->balls[k].radius);
    for (int k = 0; k < l->nlayers; k++) {
        const struct shell *s = g->shells + l->layers[k].shell;
        include(&b, g, s->lo, s->hi, l->layers[k].width);
    }
    return b;
}

/* Volume of the fluid at the start that lies deeper than `depth' in the fixed regions of a level,
 * m^dim, by 160^2 or 32^3 samples of the box around them: good to a few per cent. */
static double volume_of(const struct run *r, const struct regions *g, int n, double depth)
{
    const int m = g->dim == 2 ? 160 : 32;
    const struct exact e = exact_create(&r->scene);
    const struct box b = bounds_of(g, n);
    double volume = 1.0;
    int in = 0;
    for (int a = 0; a < g->dim; a++)
        volume *= fmax(b.hi[a] - b.lo[a], 0.0) / m;
    for (int k = 0; k < (g->dim == 3 ? m : 1) && volume > 0.0; k++)
        for (int j = 0; j < m; j++)
            for (int i = 0; i < m; i++) {
                const int at[3] = {i, j, k};
                double x[3] = {0.0, 0.0, 0.0};
                for (int a = 0; a < g->dim; a++)
                    x[a] = b.lo[a] + (at[a] + 0.5) / m * (b.hi[a] - b.lo[a]);
                in += regions_fixed_distance(g, n, x) > depth &&
                      scene_matter(&r->scene, &e, x) == MATTER_FLUID;
            }
    return in * volume;
}

/* The same as a number of particles of that level. */
static double particles_of(const struct run *r, const struct regions *g, int n, double depth)
{
    return volume_of(r, g, n, depth) / pow(ldexp(g->dx, -n), g->dim);
}

/* Sum over the levels, for the estimate of memory and time. */
double regions_particles(const struct run *r, const struct sph_params *used)
{
    struct regions *g = regions_create(r, used);
    double sum = 0.0;
    for (int n = 1; g && n <= g->prm->levels; n++)
        sum += particles_of(r, g, n, 0.0);
    DROP(g);
    return sum;
}

/* Guards fill a region as deep as R of the level outside of it. Where that is all of it, the level
 * refines nothing. */
static void describe_level(const struct run *r, const struct regions *g, int n)
{
    const double R = regions_R(g, n - 1), all = particles_of(r, g, n, 0.0);
    const double deep = all > 0.0 ? particles_of(r, g, n, R) : 0.0;
    char guards[48] = "";
    if (all > 0.0)
        snprintf(guards, sizeof guards, ", %.0f of them guards", all - deep);
    log_say("level %d: dx %g m, R %g m, about %.0f particles in regions of the case%s%s", n,
            ldexp(g->dx, -n), regions_R(g, n), all, guards,
            g->level[n].cells ? ", more where criteria ask for it" : "");
    if (all > 0.0 && deep <= 0.0 && !g->level[n].cells)
        log_warn(
            "level %d: all fluid in its regions lies within R = %g m of their edges, where only "
            "guards are: at the start nothing is refined; let the regions reach deeper into "
            "the fluid",
            n, R);
}

/* A set of its own, made for the words and dropped. */
void regions_describe(const struct run *r, const struct sph_params *used)
{
    struct regions *g = regions_create(r, used);
    if (!g)
        return;
    for (int n = 1; n <= g->prm->levels; n++)
        describe_level(r, g, n);
    if (g->criteria && g->prm->particles > 0.0)
        log_say("criteria keep to %.4g particles of all levels", g->prm->particles);
    DROP(g);
}

/* --- picture --- */

/* The line where d_n = 0 crosses a square of four corners (marching squares; at a saddle the two
 * pairs as they come). d is linear along each side. */
static void draw_square(struct picture *p, const double x[4][2], const double *d)
{
    double cut[4][2];
    int n = 0;
    for (int k = 0; k < 4; k++) {
        const int next = (k + 1) % 4;
        if ((d[k] > 0.0) == (d[next] > 0.0))
            continue;
        const double w = isfinite(d[k]) && isfinite(d[next]) ? d[k] / (d[k] - d[next]) : 0.5;
        for (int a = 0; a < 2; a++)
            cut[n][a] = x[k][a] + w * (x[next][a] - x[k][a]);
        n++;
    }
    for (int k = 0; k + 1 < n; k += 2)
        picture_line(p, PICTURE_REGION, 2, (const double(*)[2])(cut + k), false, false, false);
}

/* The edge of level n in the plane of the picture, on a grid of the domain. In 3D it is the plane y
 * = middle of the domain. */
static void draw_level(struct picture *p, const struct regions *g, int n)
{
    enum { CELLS = 240 };
    static const int corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const int u = 0, v = g->dim == 3 ? 2 : 1;
    bool named = false;
    for (int i = 0; i < CELLS; i++)
        for (int j = 0; j < CELLS; j++) {
            double x[4][2], d[4];
            for (int k = 0; k < 4; k++) {
                double at[3] = {0.0, 0.5 * (g->domain.lo[1] + g->domain.hi[1]), 0.0};
                const double w[2] = {(double)(i + corner[k][0]) / CELLS,
                                     (double)(j + corner[k][1]) / CELLS};
                at[u] = x[k][0] = g->domain.lo[u] + w[0] * (g->domain.hi[u] - g->domain.lo[u]);
                at[v] = x[k][1] = g->domain.lo[v] + w[1] * (g->domain.hi[v] - g->domain.lo[v]);
                d[k] = regions_fixed_distance(g, n, at);
                if (!named && d[k] > 0.0) {
                    char label[32];
                    snprintf(label, sizeof label, "level %d", n);
                    picture_text(p, at, label);
                    named = true;
                }
            }
            draw_square(p, (const double(*)[2])x, d);
        }
}

void regions_draw(const struct run *r, const struct sph_params *used, struct picture *p)
{
    struct regions *g = regions_create(r, used);
    for (int n = 1; g && n <= g->prm->levels; n++)
        draw_level(p, g, n);
    DROP(g);
}
