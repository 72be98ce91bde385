/* facet.c - see facet.h. Lengths in units of R within. With D = n.(v - x), d = |D|, and of an edge
 * p = m.(v - x), h^2 = p^2 + d^2, a and b the ends of its part within the support, counted from
 * the foot of x: the potential of the kernel in the plane [4.64] turns integrals over the triangle
 * into some over its edges. SPDX-License-Identifier: BSD-3-Clause */
#include "facet.h"

#include "../pairs/sph_pairs.h"
#include "vec_math.h"

static const double C = 21.0 / (2.0 * M_PI); /* W = C (1-r)^4 (1+4r) */

/* fmin and fmax are calls: they know NaN. */
static inline double less(double a, double b) { return a < b ? a : b; }
static inline double more(double a, double b) { return a > b ? a : b; }

/* Edge s runs from corner s to the next one. m lies in the plane and points out of the triangle, so
 * that m.(v - x) is positive while the foot of x lies on the inner side of the edge. The area must
 * not be 0: the normal is divided by it. */
struct facet facet_of(const double *a, const double *b, const double *c)
{
    const double *const v[3] = {a, b, c};
    struct facet f = {.radius = 0.0};
    double e[2][3];
    for (int k = 0; k < 3; k++) {
        memcpy(f.v[k], v[k], sizeof f.v[k]);
        e[0][k] = b[k] - a[k];
        e[1][k] = c[k] - a[k];
        f.centre[k] = (a[k] + b[k] + c[k]) / 3.0;
    }
    vec3_cross(e[0], e[1], f.n);
    const double twice = vec3_length(f.n);
    f.area = 0.5 * twice;
    for (int k = 0; k < 3; k++)
        f.n[k] /= twice;
    for (int s = 0; s < 3; s++) {
        double out[3];
        for (int k = 0; k < 3; k++) {
            f.t[s][k] = v[(s + 1) % 3][k] - v[s][k];
            out[k] = v[s][k] - f.centre[k];
        }
        f.length[s] = vec3_length(f.t[s]);
        f.longest = fmax(f.longest, f.length[s]);
        f.radius = fmax(f.radius, vec3_length(out));
        for (int k = 0; k < 3; k++)
            f.t[s][k] /= f.length[s];
        vec3_cross(f.t[s], f.n, f.m[s]);
    }
    return f;
}

/* What the polynomials in d are. */
struct heights {
    vec d, d2, d4, d6;
    vec Ae, Ao;     /* of gamma: even and odd part of (1-d)^6 (1+3d+3d^2) */
    vec e0, e1, e2; /* of W: even */
    vec o0, o1, o2; /* odd over d */
};

/* Even and odd parts in d stand apart, because each goes with one of the two angles of an edge. */
INLINE struct heights heights_of(vec d)
{
    struct heights h = {.d = d, .d2 = d * d};
    h.d4 = h.d2 * h.d2;
    h.d6 = h.d4 * h.d2;
    h.Ae = 1.0 + 28.0 * h.d6 + 3.0 * h.d4 * h.d4;
    h.Ao = d * (-3.0 + 7.0 * h.d2 - 21.0 * h.d4 - 15.0 * h.d6);
    h.e0 = 1.0 / 14.0 - 0.5 * h.d2 + 2.5 * (h.d4 + h.d6);
    h.e1 = -0.5 + 5.0 * h.d2 + 7.5 * h.d4;
    h.e2 = 2.5 + 7.5 * h.d2;
    h.o0 = 4.0 * h.d4 + 4.0 / 7.0 * h.d6;
    h.o1 = 8.0 * h.d2 + 12.0 / 7.0 * h.d4;
    h.o2 = 4.0 + 12.0 / 7.0 * h.d2;
    return h;
}

/* Integrals along the part of an edge within the support: int r^k dx (J; J0: int dx/r), int x^(k-1)
 * dx (Y), angles. */
struct along {
    vec T1, T2, J0, J1, J3, J5, J7, Y1, Y3, Y5, Y7, h2;
};

/* T2 = atan(b/p) - atan(a/p) is the angle under which the foot of x sees the part of the edge, T1 =
 * atan(d b/(p r_b)) - atan(d a/(p r_a)) what it takes of the solid angle; one arc tangent each
 * keeps the digits when a and b are close. Each J follows by parts from the one two powers below
 * it. */
INLINE struct along along_of(const struct heights *H, vec p, vec a, vec b)
{
    const vec zero = vec_all(0.0), a2 = a * a, b2 = b * b, p2 = p * p, h2 = p2 + H->d2;
    const vec ra2 = h2 + a2, rb2 = h2 + b2, ra = vec_sqrt(ra2), rb = vec_sqrt(rb2);
    struct along l = {.h2 = h2, .Y1 = b - a};
    l.T2 = vec_atan2(p * (b - a), p2 + a * b);
    l.T1 = vec_atan2(H->d * p * (b * ra - a * rb), p2 * ra * rb + H->d2 * a * b);
    /* asinh(b/h) - asinh(a/h), by the form that keeps the digits */
    const vec_bits before = b <= zero, after = a >= zero;
    const vec num = vec_pick(after, b + rb, vec_pick(before, ra - a, (b + rb) * (ra - a)));
    const vec den = vec_pick(after, a + ra, vec_pick(before, rb - b, h2));
    l.J0 = vec_log(num / den);
    vec fa = a * ra, fb = b * rb;
    l.J1 = 0.5 * (fb - fa + h2 * l.J0);
    l.J3 = 0.25 * ((fb *= rb2) - (fa *= ra2) + 3.0 * h2 * l.J1);
    l.J5 = 1.0 / 6.0 * ((fb *= rb2) - (fa *= ra2) + 5.0 * h2 * l.J3);
    l.J7 = 0.125 * ((fb *= rb2) - (fa *= ra2) + 7.0 * h2 * l.J5);
    l.Y3 = 1.0 / 3.0 * (b * b2 - a * a2);
    l.Y5 = 0.2 * (b * b2 * b2 - a * a2 * a2);
    l.Y7 = 1.0 / 7.0 * (b * b2 * b2 * b2 - a * a2 * a2 * a2);
    return l;
}

/* Part of an edge in gamma (S), in W (Z), and in what moves the centre along m (H). */
INLINE void edges(const double *p_, const double *d_, const double *a_, const double *b_, vec *S,
                  vec *Z, vec *H)
{
    const vec p = *(const vec *)p_, d = *(const vec *)d_;
    const struct heights q = heights_of(d);
    const struct along l = along_of(&q, p, *(const vec *)a_, *(const vec *)b_);
    const vec p2 = p * p, h2 = l.h2, h4 = h2 * h2;
    const vec K2 = p2 * l.Y1 + l.Y3, K4 = p2 * p2 * l.Y1 + 2.0 * p2 * l.Y3 + l.Y5;
    *S = q.Ae * l.T1 + q.Ao * l.T2 +
         d * p *
             (7.0 * l.Y1 - 21.0 * (K2 + 2.0 * q.d2 * l.Y1) -
              15.0 * (K4 + 3.0 * q.d2 * K2 + 3.0 * q.d4 * l.Y1) +
              28.0 * (l.J3 + q.d2 * l.J1 + q.d4 * l.J0) +
              3.0 * (l.J5 + q.d2 * l.J3 + q.d4 * l.J1 + q.d6 * l.J0));
    *Z = q.o0 * d * l.T1 - q.e0 * l.T2 -
         p * (q.e1 * l.Y1 + q.e2 * K2 + 2.5 * K4 - q.o0 * l.J0 - q.o1 * l.J1 -
              q.o2 * (l.J3 - q.d2 * l.J1) - 4.0 / 7.0 * (l.J5 - 2.0 * q.d2 * l.J3 + q.d4 * l.J1));
    *H = 1.0 / 14.0 * l.Y1 - 0.5 * (h2 * l.Y1 + l.Y3) + 2.5 * (h4 * l.Y1 + 2.0 * h2 * l.Y3 + l.Y5) -
         4.0 * l.J5 + 2.5 * (h4 * h2 * l.Y1 + 3.0 * h4 * l.Y3 + 3.0 * h2 * l.Y5 + l.Y7) -
         4.0 / 7.0 * l.J7;
}

/* S, Z, H in units of R as what they add; see facet_ask for the sign. */
static void add(const struct facet_batch *b, int k, double S, double Z, double H)
{
    double *to = b->to[k];
    to[0] += (b->D[k] >= -1e-9 ? S : -S) / (4.0 * M_PI);
    to[1] += C / b->R[k] * Z;
    for (int a = 0; a < 3; a++)
        to[2 + a] += C * (Z * b->D[k] * b->normal[k][a] - H * b->m[k][a]);
}

/* Signs that do not depend on the lane are applied by `add', so the vector loop itself has no
 * branch. */
void facet_finish(struct facet_batch *b)
{
    for (int k = b->n; k < b->n + LANES - 1 && k < FACET_EDGES; k++) { /* any edge fills up */
        b->p[k] = b->b[k] = 0.5;
        b->d[k] = b->a[k] = 0.0;
    }
    for (int k = 0; k < b->n; k += LANES) {
        vec S, Z, H;
        edges(b->p + k, b->d + k, b->a + k, b->b + k, &S, &Z, &H);
        for (int l = 0; l < LANES && k + l < b->n; l++)
            add(b, k + l, S[l], Z[l], H[l]);
    }
    b->n = 0;
}

/* Symmetric rules on a triangle of degree 1, 2 and 5 (Radon): parts of the corners, weight. */
enum { POINTS = 8 };
struct facet_rule {
    double corner[3][POINTS], weight[POINTS];
};

#define A 0.10128650732345633 /* (6 - sqrt 15)/21 */
#define B 0.47014206410511508 /* (6 + sqrt 15)/21 */
#define T (1.0 / 3.0)
#define S (1.0 / 6.0)
static const struct facet_rule rule1 __attribute__((aligned(64))) = {{{T}, {T}, {T}}, {1.0}};
static const struct facet_rule rule3 __attribute__((aligned(64))) = {
    {{1 - 2 * S, S, S}, {S, 1 - 2 * S, S}, {S, S, 1 - 2 * S}}, {T, T, T}};
static const struct facet_rule rule7 __attribute__((aligned(64))) = {
    {{1 - 2 * A, A, A, 1 - 2 * B, B, B, T},
     {A, 1 - 2 * A, A, B, 1 - 2 * B, B, T},
     {A, A, 1 - 2 * A, B, B, 1 - 2 * B, T}},
    {0.12593918054482715, 0.12593918054482715, 0.12593918054482715, 0.13239415278850618,
     0.13239415278850618, 0.13239415278850618, 0.225}};
#undef A
#undef B
#undef T
#undef S

/* Of LANES points: r is kept from 0, for those without weight lie anywhere. */
INLINE void add_points(const struct facet *f, const double *x, double R, double D,
                       const struct facet_rule *q, int k, struct wall_integrals *to)
{
    const double R_1 = 1.0 / R;
    const vec one = vec_all(1.0), w = *(const vec *)(q->weight + k) * f->area;
    vec y[3], r2 = vec_all(1e-12);
    for (int a = 0; a < 3; a++) {
        y[a] = vec_all(-x[a] * R_1);
        for (int c = 0; c < 3; c++)
            y[a] += *(const vec *)(q->corner[c] + k) * (f->v[c][a] * R_1);
        r2 += y[a] * y[a];
    }
    const vec r = vec_min(vec_sqrt(r2), one), t = one - r, t2 = t * t;
    const vec W = w * (C * R_1 * R_1 * R_1) * t2 * t2 * (1.0 + 4.0 * r);
    const vec potential = /* [4.45] */
        (-1.0 / 42.0 +
         r * r * r *
             (1.0 / 3.0 + r * r * (-2.0 + r * (10.0 / 3.0 + r * (-15.0 / 7.0 + 0.5 * r))))) /
        (r * r * r);
    const vec4 sums = vec_sums(w * potential, W, W * y[0], W * y[1]);
    to->gamma += C * D * R_1 * R_1 * sums[0];
    to->W += sums[1];
    to->e[0] += R * sums[2];
    to->e[1] += R * sums[3];
    to->e[2] += R * vec_sum(W * y[2]);
}

/* n is 1, 3 or 7 points; lanes beyond those of the rule have the weight 0. */
static void by_points(const struct facet *f, const double *x, double R, double D, int n,
                      struct wall_integrals *to)
{
    const struct facet_rule *q = n == 1 ? &rule1 : n == 3 ? &rule3 : &rule7;
    for (int k = 0; k < n; k += LANES)
        add_points(f, x, R, D, q, k, to);
}

/* Points that a triangle needs at a distance; 0: the closed form. gap, m, is the distance of the
 * centre less the radius: the triangle is no nearer. */
static int points_for(const struct facet *f, double gap, double R)
{
    if (f->longest < 0.06 * gap)
        return 1;
    if (f->longest < 0.25 * gap)
        return 3;
    return f->longest < 0.9 * gap && f->longest < 0.5 * R ? 7 : 0;
}

/* The part of an edge within the support. */
static void push(struct facet_batch *b, const struct facet *f, int s, double p, double x1, double D,
                 double R, struct wall_integrals *to)
{
    const double q2 = 1.0 - p * p - D * D, q = q2 > 0.0 ? sqrt(q2) : 0.0;
    const double from = more(x1, -q), end = less(x1 + f->length[s] / R, q);
    if (end <= from)
        return;
    if (b->n == FACET_EDGES)
        facet_finish(b);
    const int k = b->n++;
    b->p[k] = p;
    b->d[k] = fabs(D);
    b->a[k] = from;
    b->b[k] = end;
    b->to[k] = &to->gamma;
    b->m[k] = f->m[s];
    b->normal[k] = f->n;
    b->D[k] = D;
    b->R[k] = R;
}

/* The whole circle around a foot on the triangle. */
static void add_circle(const struct facet *f, double D, double R, struct wall_integrals *to)
{
    const double d = fabs(D), d2 = d * d, d4 = d2 * d2, d6 = d4 * d2, t = 1.0 - d, t2 = t * t;
    const double Z =
        2.0 * M_PI * (1.0 / 14.0 - 0.5 * d2 + 2.5 * (d4 + d6) - d * (4.0 * d4 + 4.0 / 7.0 * d6));
    const double S = 0.5 * t2 * t2 * t2 * (1.0 + 3.0 * d + 3.0 * d2);
    to->gamma -= D >= -1e-9 ? S : -S;
    to->W += C / R * Z;
    for (int a = 0; a < 3; a++)
        to->e[a] += C * Z * D * f->n[a];
}

/* The signs of p decide where the foot is and the signs of the angles, so that their jumps cancel:
 * p is kept from 0, and a foot on a corner is moved, for all is continuous. */
struct facet_place facet_ask(struct facet_batch *b, const struct facet *f, const double *x,
                             double R, struct wall_integrals *to)
{
    double y[3], p[3], x1[3], least2 = INFINITY;
    vec3_from(x, f->centre, y);
    const double D = vec3_dot(f->n, y) / R, away2 = vec3_dot(y, y);
    struct facet_place place = {D * R, fabs(D) * R, false};
    if (f->longest < 0.5 * R) {
        const double away = sqrt(away2), gap = away - f->radius;
        const int n = points_for(f, gap, R);
        if (n > 0) {
            place.distance = away;
            if (gap < R)
                by_points(f, x, R, D, n, to);
            return place;
        }
    }
    if (fabs(D) >= 1.0)
        return place;
    place.foot = true;
    for (int s = 0; s < 3; s++) {
        vec3_from(x, f->v[s], y);
        p[s] = vec3_dot(f->m[s], y) / R;
        x1[s] = vec3_dot(f->t[s], y) / R;
        const double out = more(0.0, more(x1[s], -x1[s] - f->length[s] / R));
        least2 = less(least2, p[s] * p[s] + out * out);
        if (p[s] * p[s] + x1[s] * x1[s] < 1e-16) {
            double moved[3], size2 = 0.0;
            for (int a = 0; a < 3; a++)
                size2 += (f->centre[a] - f->v[s][a]) * (f->centre[a] - f->v[s][a]);
            for (int a = 0; a < 3; a++)
                moved[a] = x[a] + 2e-8 * R / sqrt(size2) * (f->centre[a] - f->v[s][a]);
            return facet_ask(b, f, moved, R, to);
        }
        if (fabs(p[s]) < 1e-15)
            p[s] = p[s] < 0.0 ? -1e-15 : 1e-15;
        place.foot = place.foot && p[s] > 0.0;
    }
    if (!place.foot)
        place.distance = R * sqrt(D * D + least2);
    for (int s = 0; s < 3; s++)
        push(b, f, s, p[s], x1[s], D, R, to);
    if (place.foot)
        add_circle(f, D, R, to);
    return place;
}

/* The sector under which x sees the edge has the weight T2 e0, the triangle of x and the edge Z +
 * T2 e0. */
double facet_rim(const struct facet *f, int edge, const double *x, double R)
{
    double y[3], p2 = 0.0;
    vec S, Z, H;
    for (int a = 0; a < 3; a++)
        y[a] = (f->v[edge][a] - x[a]) / R;
    const double x1 = vec3_dot(f->t[edge], y);
    for (int a = 0; a < 3; a++)
        p2 += (y[a] - x1 * f->t[edge][a]) * (y[a] - x1 * f->t[edge][a]);
    const double q = p2 < 1.0 ? sqrt(1.0 - p2) : 0.0;
    const double from = more(x1, -q), to = less(x1 + f->length[edge] / R, q);
    if (to <= from || p2 < 1e-24)
        return 0.0;
    const vec p = vec_all(sqrt(p2)), d = vec_all(0.0), a = vec_all(from), b = vec_all(to);
    edges((const double *)&p, (const double *)&d, (const double *)&a, (const double *)&b, &S, &Z,
          &H);
    return -C / R * Z[0];
}

double facet_nearest(const struct facet *f, const double *x, double *foot)
{
    double y[3], least2 = INFINITY;
    bool inside = true;
    for (int s = 0; s < 3; s++) {
        vec3_from(x, f->v[s], y);
        inside = inside && vec3_dot(f->m[s], y) >= 0.0;
        const double along = more(0.0, less(-vec3_dot(f->t[s], y), f->length[s]));
        double r2 = 0.0;
        for (int a = 0; a < 3; a++) {
            y[a] += along * f->t[s][a];
            r2 += y[a] * y[a];
        }
        if (r2 >= least2)
            continue;
        least2 = r2;
        for (int a = 0; a < 3; a++)
            foot[a] = x[a] + y[a];
    }
    if (!inside)
        return sqrt(least2);
    const double D = vec3_dot(f->n, y); /* of any point of the plane */
    for (int a = 0; a < 3; a++)
        foot[a] = x[a] + D * f->n[a];
    return fabs(D);
}
