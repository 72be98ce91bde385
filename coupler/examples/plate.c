/* plate.c - a program that bends a body of sph: an elastic plate, pushed by the water.
 *
 *   plate DIR BODY OUTLINE.csv STIFFNESS MASS RESISTANCE [DAMPING [restart]], beside sph and
 *   coupler
 *
 * The plate of Euler and Bernoulli, small deflections, upright and clamped at its foot; in 2D.
 * OUTLINE.csv has the points of the body's outline as the case has them, m; STIFFNESS N m: E
 * d^3/(12 (1 - nu^2)) of a plate of thickness d; MASS kg/m^2; RESISTANCE kg/(m^2 s): 2 rho c0 on
 * each wet side, 0 for plates that are heavy (coupler/README.md); DAMPING 1/s: force over MASS and
 * velocity. With `restart' it goes on from the restart files in DIR, as the others do.
 *
 * Cubic elements (deflection and slope at each node), in time the theta rule, for which no step is
 * too long. A cross-section stays plane: the point at the height z and the distance d from the
 * middle moves by (w(z), -d w'(z)). Loads on points act on the elements by the same functions, so
 * that their work is that of the water.
 *
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cpl.h>

#define THETA 0.55 /* of the end of a step in its middle: above 1/2 what is stiff dies out */
enum { ELEMENTS = 24, N = 2 * ELEMENTS, POINTS = 400 }; /* the foot has no degree of freedom */

/* A point of the outline: the first degree of freedom of its element (the foot's, -2 and -1, are
 * 0), and how the four of them move it along x and y. */
struct point {
    int first;
    double by[2][4];
};

static struct cpl *c;
static int npoints;
static double x[POINTS][3];
static struct point at[POINTS];
static double M[N][N], K[N][N], S[N][N]; /* mass, stiffness, factors of the step's matrix */

/* The library has told all programs of the job already, or the reason is ours alone. */
static void must(int code)
{
    if (code == CPL_OK)
        return;
    fprintf(stderr, "plate: %s\n", cpl_strerror(c));
    cpl_close(&c, -code);
    MPI_Finalize();
    exit(-code);
}

static int read_outline(const char *path)
{
    char line[200];
    FILE *f = fopen(path, "r");
    for (npoints = 0; f && npoints < POINTS && fgets(line, sizeof line, f);)
        npoints += sscanf(line, "%lf ,%lf", &x[npoints][0], &x[npoints][1]) == 2;
    if (f)
        fclose(f);
    return npoints;
}

/* Elements of length l, and where the points of the outline are in them. */
static void build(double stiffness, double mass)
{
    double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY};
    for (int i = 0; i < npoints; i++)
        for (int a = 0; a < 2; a++) {
            lo[a] = fmin(lo[a], x[i][a]);
            hi[a] = fmax(hi[a], x[i][a]);
        }
    const double l = (hi[1] - lo[1]) / ELEMENTS, k = stiffness / (l * l * l), m = mass * l / 420.0;
    const double bend[4][4] = {{12, 6, -12, 6}, {6, 4, -6, 2}, {-12, -6, 12, -6}, {6, 2, -6, 4}},
                 inertia[4][4] = {
                     {156, 22, 54, -13}, {22, 4, 13, -3}, {54, 13, 156, -22}, {-13, -3, -22, 4}};
    for (int e = 0; e < ELEMENTS; e++)
        for (int i = e ? 0 : 2; i < 4; i++)
            for (int j = e ? 0 : 2; j < 4; j++) { /* slopes times l */
                M[2 * e - 2 + i][2 * e - 2 + j] += m * inertia[i][j];
                K[2 * e - 2 + i][2 * e - 2 + j] += k * bend[i][j];
            }
    for (int p = 0; p < npoints; p++) {
        const double from_middle = x[p][0] - 0.5 * (lo[0] + hi[0]), z = (x[p][1] - lo[1]) / l;
        const int e = z < ELEMENTS ? (int)z : ELEMENTS - 1;
        const double s = z - e,
                     shape[4] = {(1 - s) * (1 - s) * (1 + 2 * s), s * (1 - s) * (1 - s),
                                 s * s * (3 - 2 * s), -s * s * (1 - s)},
                     slope[4] = {-6 * s * (1 - s), (1 - s) * (1 - 3 * s), 6 * s * (1 - s),
                                 s * (3 * s - 2)};
        at[p].first = 2 * e - 2;
        for (int i = 0; i < 4; i++) {
            at[p].by[0][i] = shape[i];
            at[p].by[1][i] = -from_middle * slope[i] / l;
        }
    }
}

/* What degrees of freedom q do to the points: v[4 npoints], at `from' of each 4 two components. */
static void spread(const double *q, double *v)
{
    for (int p = 0; p < npoints; p++)
        for (int a = 0; a < 2; a++) {
            v[4 * p + a] = 0.0;
            for (int i = at[p].first < 0 ? 2 : 0; i < 4; i++)
                v[4 * p + a] += at[p].by[a][i] * q[at[p].first + i];
        }
}

/* The transpose: loads on points as forces on the degrees of freedom. */
static void gather(const double *load, double *f)
{
    memset(f, 0, N * sizeof *f);
    for (int p = 0; p < npoints; p++)
        for (int a = 0; a < 2; a++)
            for (int i = at[p].first < 0 ? 2 : 0; i < 4; i++)
                f[at[p].first + i] += at[p].by[a][i] * load[2 * p + a];
}

/* S = L L^T of heavy M + (THETA h)^2 K. */
static void factor(double heavy, double h)
{
    for (int j = 0; j < N; j++)
        for (int i = j; i < N; i++) {
            double sum = heavy * M[i][j] + THETA * THETA * h * h * K[i][j];
            for (int k = 0; k < j; k++)
                sum -= S[i][k] * S[j][k];
            S[i][j] = i == j ? sqrt(sum) : sum / S[j][j];
        }
}

static void solve(double *b)
{
    for (int i = 0; i < N; i++) {
        for (int k = 0; k < i; k++)
            b[i] -= S[i][k] * b[k];
        b[i] /= S[i][i];
    }
    for (int i = N - 1; i >= 0; i--) {
        for (int k = i + 1; k < N; k++)
            b[i] -= S[k][i] * b[k];
        b[i] /= S[i][i];
    }
}

/* What the elements have: deflections and slopes, and their rates. */
struct state {
    double q[N], v[N];
};

/* A step of h with the loads f of the step before, in which the mean rates were `seen'. A wall of
 * sph that is faster by du meets rho c du at once: `resist' (over MASS, 1/s) of what the rates
 * change by from step to step, so that no plate is too light for the step that lies between motion
 * and load. The inertia that this adds, resist h, is taken off: main asks for steps so short that
 * the plate has it. */
static void step(const struct state *s, double h, double resist, double damping, const double *f,
                 const double *seen, struct state *end)
{
    const double inertia = fmax(1.0 - resist * h, 0.1);
    double a[N];
    for (int i = 0; i < N; i++) {
        a[i] = f[i];
        for (int j = 0; j < N; j++)
            a[i] += M[i][j] * (resist * (seen[j] - s->v[j]) - damping * s->v[j]) -
                    K[i][j] * (s->q[j] + THETA * h * s->v[j]);
    }
    factor(inertia + THETA * h * (resist + damping), h);
    solve(a);
    for (int i = 0; i < N; i++) {
        end->q[i] = s->q[i] + h * (s->v[i] + THETA * h * a[i]);
        end->v[i] = s->v[i] + h * a[i];
    }
}

/* --- restart --- */

/* All that a step begins with: the elements, the loads and the mean rates of the last step. */
struct plate_state {
    struct state now;
    double f[N], seen[N];
};

/* Of this coupling step; all programs then name their files to the coupler (DIR/checkpoint.txt). */
static void save(const char *dir, const struct plate_state *k)
{
    char name[80], path[800];
    snprintf(name, sizeof name, "plate-%lld.bin", (long long)cpl_window_number(c));
    snprintf(path, sizeof path, "%.400s/%s", dir, name);
    FILE *to = fopen(path, "wb");
    const int written = to && fwrite(k, sizeof *k, 1, to) == 1;
    if (!to || fclose(to) || !written) {
        fprintf(stderr, "plate: %s cannot be written\n", path);
        exit(1); /* a partner that goes ends the job */
    }
    must(cpl_saved(c, name));
}

/* The coupling step and time, s, that the manifest has, and the state from the file that it names;
 * 0: there is none. */
static int load(const char *dir, long long *window, double *t, struct plate_state *k)
{
    char path[800], line[400], name[256] = "";
    snprintf(path, sizeof path, "%.400s/checkpoint.txt", dir);
    FILE *from = fopen(path, "r");
    while (from && fgets(line, sizeof line, from)) {
        (void)sscanf(line, "window %lld", window);
        (void)sscanf(line, "t %lf", t);
        (void)sscanf(line, "plate %255s", name);
    }
    if (from)
        fclose(from);
    snprintf(path, sizeof path, "%.400s/%s", dir, name);
    from = *name ? fopen(path, "rb") : NULL;
    const int read = from && fread(k, sizeof *k, 1, from) == 1;
    if (from)
        fclose(from);
    return read;
}

/* Where the points are and how they get to the state `end' a step of h later. */
static void tell(int field, double t, double h, const struct state *s, const struct state *end)
{
    static double now[4 * POINTS], rate[4 * POINTS];
    struct state per;
    for (int i = 0; i < N; i++) {
        per.q[i] = (end->q[i] - s->q[i]) / h;
        per.v[i] = (end->v[i] - s->v[i]) / h;
    }
    spread(s->q, now);
    spread(s->v, now + 2);
    spread(per.q, rate);
    spread(per.v, rate + 2);
    must(cpl_put_course(c, field, t, npoints, 2, (const double *const[]){now, rate}));
}

int main(int argc, char **argv)
{
    static double loads[2 * POINTS], ones[POINTS];
    static int64_t ids[POINTS];
    double of[4] = {0.0}, t0, t1, begin = 0.0;
    struct plate_state k = {0};
    struct state next;
    long long window = -1;
    int set, motion, pushed, action, code = 0;
    char name[2][CPL_NAME];
    MPI_Comm mine;
    for (int i = 4; i < argc && i < 8; i++)
        of[i - 4] = atof(argv[i]);
    if (argc < 7 || argc > 9 || !(of[0] > 0.0) || !(of[1] > 0.0) || read_outline(argv[3]) < 3) {
        /* before MPI_Init: the launcher ends the others */
        fprintf(stderr, "usage, beside sph and coupler: plate DIR BODY OUTLINE.csv STIFFNESS MASS "
                        "RESISTANCE [DAMPING [restart]]\n");
        return 2;
    }
    if (argc == 9 && !load(argv[1], &window, &begin, &k)) {
        fprintf(stderr, "plate: no restart files in %s\n", argv[1]);
        return 2;
    }
    build(of[0], of[1]);
    for (int i = 0; i < npoints; i++)
        ids[i] = i, ones[i] = 1.0;
    MPI_Init(&argc, &argv);
    if (cpl_open(MPI_COMM_WORLD, "plate", 30.0, &c, &mine) || !c) {
        fprintf(stderr, "plate: no other program takes part in this job\n");
        return MPI_Finalize(), 2;
    }
    must(cpl_meet(c, 0, window, 0, argv[1]));
    must(cpl_points(c, "plate", 2, 1.0, &set)); /* any support: the points are those of sph */
    snprintf(name[0], CPL_NAME, "%s.outline", argv[2]);
    snprintf(name[1], CPL_NAME, "sph.%s.load", argv[2]);
    must(cpl_field(c, set, name[0], "m", 4, CPL_PUT, 0, &motion));
    must(cpl_field(c, set, name[1], "N", 2, CPL_GET, CPL_NEAREST | CPL_CONSERVATIVE, &pushed));
    /* resist h is then at most 1 in `step' */
    must(cpl_ready(c, begin, of[2] > 0.0 ? of[1] / of[2] : INFINITY));
    must(cpl_move(c, set, npoints, *x, ids, ones));
    printf("t, deflection, velocity, load\n"); /* of the top; all of the load along x */
    for (;;) {
        must(cpl_window(c, &t0, &t1, &action, &code));
        if (action & CPL_STOP)
            break;
        const double h = t1 - t0;
        step(&k.now, h, of[2] / of[1], of[3], k.f, k.seen, &next);
        tell(motion, t0, h, &k.now, &next);
        must(cpl_get(c, pushed, npoints, loads, NULL)); /* means over the step of sph */
        gather(loads, k.f);
        for (int i = 0; i < N; i++)
            k.seen[i] = (next.q[i] - k.now.q[i]) / h;
        k.now = next;
        double all = 0.0;
        for (int i = 0; i < npoints; i++)
            all += loads[2 * i];
        printf("%.9g, %.9g, %.9g, %.9g\n", t1, k.now.q[N - 2], k.now.v[N - 2], all);
        if (action & CPL_SAVE)
            save(argv[1], &k);
        must(cpl_advance(c, t1, 0));
    }
    code = cpl_close(&c, code);
    MPI_Finalize();
    return code;
}
