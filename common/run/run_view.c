/* run_view.c - view.py beside a run's output: a script for ParaView that shows all programs of the
 * run; what it knows of the scene stands here, the rest is common/run/view.py.
 * SPDX-License-Identifier: BSD-3-Clause */

#include "program.h"
#include "run_files.h"

static const char begin[] = "# paraview --script=view.py\n"
                            "import glob, os, re, sys\n"
                            "from paraview.simple import *\n";
static const char *const rest[] = {
#include "view.inc"
};

/* The run's folder, as a string of Python. */
static void write_folder(FILE *f, const char *dir)
{
    char *path = realpath(dir, NULL);
    fputs("written = '", f);
    for (const char *c = path ? path : dir; *c; c++)
        fprintf(f, *c == '\\' || *c == '\'' ? "\\%c" : "%c", *c);
    fputs("'\n", f);
    free(path);
}

/* What view.py must know of the scene, as assignments of Python: dimensions and the direction
 * against gravity, corners of the domain, walls given by points, the fields to show first, whether
 * there is a surface and whether the box of the domain is to be drawn. */
static void write_scene(FILE *f, const struct scene *s)
{
    double g[3];
    const double *a = s->domain.min, *b = s->domain.max;
    const double all = scene_still_gravity(s, g), G = all > 0.0 ? all : 1.0;
    fprintf(f, "dim, up = %d, [%g, %g, %g]\n", s->domain.dim, -g[0] / G, -g[1] / G,
            all > 0.0 ? -g[2] / G : 1.0);
    fprintf(f, "low, high = [%.9g, %.9g, %.9g], [%.9g, %.9g, %.9g]\n", a[0], a[1], a[2], b[0], b[1],
            b[2]);
    bool tank = false;
    fprintf(f, "walls = [\n");
    for (const struct scene_wall *w = s->walls; w < s->walls + s->nwalls; w++) {
        tank = tank || *w->surface.mesh != '\0';
        if (w->points.n == 0)
            continue;
        fprintf(f, "    [");
        for (int i = 0; i < w->points.n + w->closed; i++)
            fprintf(f, "%s%.9g, %.9g, 0", i > 0 ? ", " : "", w->points.x[i % w->points.n][0],
                    w->points.x[i % w->points.n][1]);
        fprintf(f, "],\n");
    }
    for (int k = 0; k < s->nbodies; k++)
        tank = tank || s->bodies[k].tank;
    fprintf(f, "]\nfields = ('%s', '%s', 'pressure')\nsurface, opaque = %s, %s\n",
            all > 0.0 ? "velocity" : "vorticity", all > 0.0 ? "vorticity" : "velocity",
            scene_has_surface(s) ? "True" : "False", tank ? "False" : "True");
}

void files_view(const struct run *r)
{
    FILE *f = r->rank == 0 ? fopen(key_text("%s/view.py", r->dir), "w") : NULL;
    if (!f)
        return;
    fputs(begin, f);
    write_folder(f, r->dir);
    write_scene(f, &r->scene);
    for (size_t k = 0; k < sizeof rest / sizeof rest[0]; k++)
        fputs(rest[k], f);
    fclose(f);
}
