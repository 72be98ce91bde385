/* spring.c - a program that moves a body of sph: a mass on a spring along x, pushed by the water.
 *
 *   spring DIR BODY MASS STIFFNESS STRETCH ADDED [3], beside sph and coupler (coupler/README.md)
 *
 * MASS kg, STIFFNESS N/m (2D: per metre), STRETCH m: where the spring has no force, from the start;
 * ADDED kg: the water's mass that moves with it, roughly; 3: in 3D. While the force F was measured
 * the body had its old acceleration a, so that F holds the reaction to that:
 *
 *   (MASS + ADDED) a' = F + ADDED a - STIFFNESS (x - STRETCH)
 *
 * With a' = a it is Newton's law for any ADDED. An error dies out if ADDED is above (3 A - MASS)/4,
 * A being the true added mass: rather too large than too small.
 *
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <cpl.h>

static struct cpl *c;

/* The library has told all programs of the job already, or the reason is ours alone. */
static void must(int code)
{
    if (code == CPL_OK)
        return;
    fprintf(stderr, "spring: %s\n", cpl_strerror(c));
    cpl_close(&c, -code);
    MPI_Finalize();
    exit(-code);
}

/* Where it is and how it goes on: 3 displacements, 3 rotations, their 6 rates; terms in time. */
static void tell(int field, double t, double x, double v, double a)
{
    const double now[12] = {x, 0, 0, 0, 0, 0, v}, rate[12] = {v, 0, 0, 0, 0, 0, a},
                 half[12] = {0.5 * a};
    must(cpl_put_course(c, field, t, 1, 3, (const double *const[]){now, rate, half}));
}

int main(int argc, char **argv)
{
    const double origin[3] = {0, 0, 0}, one = 1.0;
    const int64_t id = 0;
    double t0, t1, x = 0.0, v = 0.0, a = 0.0, of[5] = {0}, force[6], body[12], old = 0.0;
    int point, motion, pushed, moved, action, code = 0;
    char name[3][CPL_NAME];
    MPI_Comm mine;
    for (int i = 3; i < argc && i < 7; i++)
        of[i - 3] = atof(argv[i]);
    const double mass = of[0], k = of[1], stretch = of[2], added = of[3];
    const int dim = argc == 8 ? atoi(argv[7]) : 2;
    if (argc < 7 || argc > 8 || !(mass + added > 0.0) ||
        !(k > 0.0)) { /* before MPI_Init: the launcher ends the others */
        fprintf(stderr, "usage, beside sph and coupler: spring DIR BODY MASS STIFFNESS STRETCH "
                        "ADDED [3]\n");
        return 2;
    }
    MPI_Init(&argc, &argv);
    if (cpl_open(MPI_COMM_WORLD, "spring", 30.0, &c, &mine) || !c) {
        fprintf(stderr, "spring: no other program takes part in this job\n");
        return MPI_Finalize(), 2;
    }
    must(cpl_meet(c, 0, -1, 0, argv[1]));
    must(cpl_points(c, "spring", dim, 1.0, &point)); /* one point, at the origin, that has it all */
    snprintf(name[0], CPL_NAME, "%s.motion", argv[2]);
    snprintf(name[1], CPL_NAME, "sph.%s.force", argv[2]);
    snprintf(name[2], CPL_NAME, "sph.%s.motion", argv[2]);
    must(cpl_field(c, point, name[0], "m", 12, CPL_PUT, 0, &motion));
    must(cpl_field(c, point, name[1], "N", 6, CPL_GET, CPL_NEAREST, &pushed));
    must(cpl_field(c, point, name[2], "m", 12, CPL_GET, CPL_NEAREST, &moved));
    must(cpl_ready(c, 0.0, 0.1 * sqrt((mass + added) / k))); /* a tenth of a radian of its swing */
    must(cpl_move(c, point, 1, origin, &id, &one));
    tell(motion, 0.0, x, v, a);
    printf("t, x, v, force\n");
    for (;;) {
        must(cpl_window(c, &t0, &t1, &action, &code));
        if (action & CPL_STOP)
            break;
        must(cpl_get(c, pushed, 1, force, NULL)); /* means over the step that sph has just done */
        must(cpl_get(c, moved, 1, body, NULL));
        const double h = t1 - t0, heavy = mass + added, was = (body[6] - old) / h;
        old = body[6];
        /* the spring by the trapezoidal rule: no step is too long for it */
        a = (force[0] + added * was - k * (x + 0.5 * h * v - stretch)) / (heavy + 0.25 * k * h * h);
        x += h * (v + 0.5 * h * a);
        v += h * a;
        tell(motion, t1, x, v, a);
        printf("%.9g, %.9g, %.9g, %.9g\n", t1, x, v, force[0]);
        must(cpl_advance(c, t1, 0));
    }
    code = cpl_close(&c, code);
    MPI_Finalize();
    return code;
}
