/* wall_ghost.c - mirrored ghosts behind plane sides of the domain, in 2D and 3D [3.1-3.10] (Chiron
 * 2017, chapter 3). Every particle within reach of a side is mirrored, ghosts of other ranks and of
 * sides before included, so that corners fill themselves. A ghost has the velocity mirrored (slip
 * form), and the density that the hydrostatic equation (1/rho) dp/dn = g.n gives over the distance
 * from its original. Pair fluxes stay antisymmetric: no mass passes.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "walls.h"

#include "ghost_lines.h"

struct mirror {
    struct ghost_block ghosts;
    int *source; /* [n] line that is mirrored */
    unsigned char *plane;
};

static void *mirror_create(struct sph *s)
{
    struct mirror *m = NEW(struct mirror, 1);
    for (int k = 0; k < s->walls->nplanes; k++)
        m->ghosts.has_friction = m->ghosts.has_friction || s->walls->planes[k].no_slip;
    return m;
}

static void add(struct sph *s, struct mirror *m, int source, int plane)
{
    ROOM_IN(m, m->source, m->ghosts.n + 1);
    ROOM_IN(m, m->plane, m->ghosts.n + 1);
    m->source[m->ghosts.n] = source;
    m->plane[m->ghosts.n] = (unsigned char)plane;
    ghost_append(s, &m->ghosts, 1);
    if (s->p.size)
        memcpy(s->p.size[s->p.n + s->p.nghost - 1], s->p.size[source], sizeof *s->p.size);
}

/* How far a line is seen: of different sizes by those up to twice its own. */
static double reach_of(const struct sph *s, int i)
{
    return (s->p.size ? 1.5 * s->p.size[i][0] : s->R) + s->lists.skin;
}

/* The sides that ghost k is mirrored at, last first; *root: the line that is no such ghost. */
enum { MIRRORS = 6 };
static int sides_of(const struct mirror *m, int k, int first, const struct wall_plane *planes,
                    const struct wall_plane *side[MIRRORS], int *root)
{
    int n = 0;
    for (*root = first + k; *root >= first && n < MIRRORS; n++) {
        side[n] = planes + m->plane[*root - first];
        *root = m->source[*root - first];
    }
    return n;
}

/* u of the no-slip form: mirrored about the velocity of each side with friction. In a corner of
 * two or three sides what comes out depends on which is first, where one moves: the mean of all
 * orders does not. */
static void no_slip(const struct wall_plane *const *side, int n, const double *from, double *u,
                    int dim)
{
    static const unsigned char order[6][3] = {{0, 1, 2}, {1, 0, 2}, {0, 2, 1},
                                              {2, 1, 0}, {1, 2, 0}, {2, 0, 1}};
    const int orders = n == 1 ? 1 : n == 3 ? 6 : 2;
    double sum[3] = {0.0, 0.0, 0.0};
    for (int o = 0; o < orders; o++) {
        double v[3] = {0.0, 0.0, 0.0};
        memcpy(v, from, (size_t)dim * sizeof *v);
        for (int k = 0; k < n; k++) { /* more than three, in a slit: back and forth */
            const struct wall_plane *p = side[n <= 3 ? order[o][k] : o ? n - 1 - k : k];
            for (int a = 0; a < dim; a++)
                v[a] = a == p->axis ? -v[a] : p->no_slip ? 2.0 * p->u[a] - v[a] : v[a];
        }
        for (int a = 0; a < dim; a++)
            sum[a] += v[a];
    }
    for (int a = 0; a < dim; a++)
        u[a] = sum[a] / orders;
}

/* Ghosts are set in the order in which they were mirrored, so that the original of a ghost of a
 * ghost is there before it. */
static void lines(struct sph *s)
{
    const struct walls *w = s->walls;
    struct mirror *m = w->state;
    const int dim = s->dim, first = s->p.n + m->ghosts.first;
    for (int k = 0; k < m->ghosts.n; k++) {
        const struct wall_plane *side[MIRRORS];
        int root;
        const struct wall_plane *p = w->planes + m->plane[k];
        const double *from = prim_line(&s->p, m->source[k]);
        const double d = 2.0 * p->sign * (p->at - from[p->axis]);
        double x[3], u[3], *rub = m->ghosts.rub + (size_t)dim * k;
        memcpy(x, from, (size_t)dim * sizeof *x);
        memcpy(u, from + dim, (size_t)dim * sizeof *u);
        x[p->axis] = 2.0 * p->at - x[p->axis];
        u[p->axis] = -u[p->axis];
        if (m->ghosts.has_friction) {
            const int n = sides_of(m, k, first, w->planes, side, &root);
            no_slip(side, n, prim_line(&s->p, root) + dim, rub, dim);
            for (int a = 0; a < dim; a++)
                rub[a] -= u[a];
            /* Across a side of a corner the no-slip form takes back the friction of the slip form;
             * that of Monaghan's term is another, and the rest would accelerate the fluid. */
            for (int a = 0; a < n && n > 1 && s->prm.viscosity != VISCOSITY_MORRIS; a++)
                rub[side[a]->axis] = 0.0;
        }
        const double rho = ghost_density(s, from[at_rho(dim)], p->sign * s->gravity[p->axis], d);
        ghost_set_line(s, prim_line(&s->p, first + k), x, u, from[at_volume(dim)], rho);
        if (dim == 2)
            prim_line(&s->p, first + k)[PRIM_FALSE] = from[PRIM_FALSE];
    }
}

/* Whether the line i, at the distance d, m, has no image, for it leaves a roof. */
static bool parts_from(const struct sph *s, const struct wall_plane *p, int i, double d)
{
    const double *q = prim_line(&s->p, i);
    return ghost_parted(s, q[at_rho(s->dim)], p->sign * s->gravity[p->axis], d,
                        p->sign * q[s->dim + p->axis]);
}

static void ghosts(struct sph *s)
{
    struct mirror *m = s->walls->state;
    m->ghosts.n = 0;
    m->ghosts.first = s->p.nghost;
    for (int k = 0; k < s->walls->nplanes; k++) {
        const struct wall_plane *p = s->walls->planes + k;
        const int have = s->p.n + s->p.nghost;
        const int before = m->ghosts.n;
        for (int i = 0; i < have; i++) {
            const double d = p->sign * (p->at - prim_line(&s->p, i)[p->axis]);
            if (d >= 0.0 && d < reach_of(s, i) && !parts_from(s, p, i, d))
                add(s, m, i, k);
        }
        if (m->ghosts.n > before) /* the next sides mirror these, too */
            lines(s);
    }
}

/* The mirrored field's gradients, with that of the weight; u0 as u. */
static void ghost_slopes(struct sph *s)
{
    const struct walls *w = s->walls;
    const struct mirror *m = w->state;
    const int dim = s->dim, first = s->p.n + m->ghosts.first, width = s->p.nslope;
    for (int k = 0; k < m->ghosts.n; k++) {
        const struct wall_plane *p = w->planes + m->plane[k];
        double *to = s->p.slope + (size_t)width * (first + k);
        const double K = p->sign * s->gravity[p->axis];
        memcpy(to, s->p.slope + (size_t)width * m->source[k], (size_t)width * sizeof *to);
        to[p->axis] = -to[p->axis];
        if (K != 0.0)
            to[p->axis] +=
                2.0 * p->sign * K / (s->c0 * s->c0) * prim_line(&s->p, first + k)[at_rho(dim)];
        for (int a = 0; a < dim; a++)
            for (int b = 0; b < dim; b++)
                if ((a == p->axis) != (b == p->axis))
                    to[dim + dim * a + b] = -to[dim + dim * a + b];
        to[dim + dim * dim + p->axis] = -to[dim + dim * dim + p->axis];
    }
}

int walls_mirrored(const struct sph *s, int i)
{
    const struct mirror *m = s->walls->state;
    const int k = i - s->p.n - m->ghosts.first;
    return s->walls->model == &wall_ghost && k >= 0 && k < m->ghosts.n ? m->source[k] : -1;
}

/* Levels of refinement see to their mass together. */
static void rates(struct sph *s)
{
    const struct mirror *m = s->walls->state;
    ghost_friction(s, &m->ghosts);
    if (s->prm.scheme == SCHEME_RIEMANN_ALE && !s->zones && !s->guards)
        walls_keep_mass_of_all(s);
}

const struct wall_model wall_ghost = {.name = "mirrored_ghosts",
                                      .create = mirror_create,
                                      .ghosts = ghosts,
                                      .lines = lines,
                                      .ghost_slopes = ghost_slopes,
                                      .rates = rates};
