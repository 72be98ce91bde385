/* moving.c - see moving.h. A block's cells carry u and p along, so a step's equations are those of
 * the moving frame: fluxes relative to the faces, no other term, as blocks are rigid.
 * Where blocks meet the values of one at the places of the other change with the motion. I_k
 * interpolates at the time of stage k, c_k dt after the step's start:
 *   psi   p + psi is continuous at the time that a stage's pressure stands for, e_k dt after the
 *         start: 0, 5/3, 5/6 in rk3, that of the convection it balances, and 1 in bdf2. Hence
 *         psi = I psi + (e_k/c_k) (I_k p - p). The I of psi, which is of the order of the step, is
 *         that of the middle of the step: one matrix a step.
 *   u*    lacks tau grad psi, in which psi is that of the cells: u* = I_k u* + tau (e_k/c_k) (I_k
 *         grad p - grad p). The viscous increment is this with u_k-1 in place of u*, less u_k-1,
 *         beyond the interpolated increment.
 * With a free surface psi is the whole pressure of the middle of the step, where the surface stands
 * then: psi = I psi of that time, u* = I_k u*.
 * newton has the whole pressure where the step ends: p = I p, and what cells are is cut there.
 * The hierarchy of a matrix before preconditions until iterations have grown by a half.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "moving.h"

#include "../../common/files/files.h"
#include "../grid/fv_grid.h"
#include "../operators/fv_operators.h"
#include "../poisson/poisson.h"
#include "../surface/fv_surface.h"
#include "rk3.h"

struct moving {
    double t_cut, t_rows; /* s: middle of the last step; of that whose matrix has the hierarchy */
    double fresh;       /* iterations of the step that made the hierarchy; 0: the next makes one */
    int64_t iterations; /* before the step */
    double tau;         /* s: length of the stage */
    double *push[3];    /* m/s^2: in the fringe, grad psi there beyond that of the donors */
    double *first[3];   /* m/s^2: grad p of the step's start */
    double *now[4];     /* scratch: that, and p, by the donors of a stage */
    int stage;
    unsigned char *status[MESH_BLOCKS_MAX]; /* before the step */
    unsigned char *born[MESH_BLOCKS_MAX];   /* 1: computed now, nothing before */
    unsigned char *local;                   /* m->status before the step */
    double least;                           /* m: least height of a cell of the fringe */
};

struct moving *moving_create(struct fv *s)
{
    struct mesh *m = s->m;
    if (!m->moves)
        return NULL;
    struct moving *v = NEW(struct moving, 1);
    for (int a = 0; a < 4; a++) {
        v->now[a] = mem_own(v, mesh_field(m));
        if (a < m->dim) {
            v->push[a] = mem_own(v, mesh_field(m));
            v->first[a] = mem_own(v, mesh_field(m));
        }
    }
    /* statuses change places with those of the blocks, and belong to the mesh as they do */
    v->local = NEW_IN(v, unsigned char, m->size_local);
    for (int k = 0; k < m->nblocks; k++) {
        v->status[k] = NEW_IN(m, unsigned char, mesh_count(m->block + k));
        v->born[k] = NEW_IN(m, unsigned char, mesh_count(m->block + k));
    }
    v->t_cut = v->t_rows = s->t;
    v->least = mesh_least_height(m, CELL_FRINGE); /* it hardly changes */
    s->fringe.psi = mem_own(s, mesh_field(m));
    for (int a = 0; a < m->dim; a++)
        s->fringe.delta[a] = mem_own(s, mesh_field(m));
    if (!mesh_bc_pressure_given(s))
        s->fringe.z = mem_own(s, mesh_field(m));
    return v;
}

/* --- what cells are --- */

/* All blocks' status and the store change places. */
static void swap_status(struct mesh *m, struct moving *v)
{
    for (int k = 0; k < m->nblocks; k++) {
        unsigned char *now = m->block[k].status;
        m->block[k].status = v->status[k];
        v->status[k] = now;
    }
}

void moving_set_free(struct fv *s)
{
    const struct mesh *m = s->m;
    mesh_set_status(s->m);
    for (int q = 0; q < m->nparts; q++)
        PART_ROWS (m->part + q, no_layers, no_layers, c, n)
            for (int64_t i = c; i < c + n; i++)
                s->free[i] = m->status[i] == CELL_COMPUTED;
}

/* Cells for a step whose middle is at t. */
static void cut(struct fv *s, double t)
{
    struct mesh *m = s->m;
    mesh_motion_place(m, t);
    if (m->has_fringe) {
        overset_cut(m, m->search);
        overset_find_rows(m, m->search);
    }
    moving_set_free(s);
    s->moving->t_cut = t;
}

/* Computed cells that were not even interpolated; with newton, which wants the velocity of two
 * steps before of what may be computed next, interpolated ones, too. */
static bool find_born(struct fv *s)
{
    struct moving *v = s->moving;
    const int last = s->prm.integrator == INTEGRATOR_NEWTON ? CELL_FRINGE : CELL_COMPUTED;
    bool any = false;
    for (int k = 0; k < s->m->nblocks; k++)
        for (int64_t c = 0; c < mesh_count(s->m->block + k); c++) {
            v->born[k][c] = s->m->block[k].status[c] <= last && v->status[k][c] == CELL_HOLE;
            any = any || v->born[k][c];
        }
    return any;
}

/* Fields that cells which are computed now and were holes before take over by interpolation;
 * returns how many, 15 at most. */
static int carried(const struct fv *s, double **f)
{
    int n = 0;
    f[n++] = s->p;
    f[n++] = s->p_before;
    if (s->surface)
        f[n++] = s->surface->phi;
    for (int a = 0; a < 3; a++) {
        double *const all[] = {s->u[a], s->stages.u_old[a], s->stages.psi[a], s->stages.start[a]};
        for (int k = 0; k < 4; k++)
            if (all[k])
                f[n++] = all[k];
    }
    return n;
}

/* From the blocks where they stood, and the cells that were. */
static void fill_born(struct fv *s)
{
    double *f[15];
    const int n = carried(s, f);
    swap_status(s->m, s->moving);
    if (s->surface)
        surface_mesh_change_height(s, -1.0, s->surface->phi);
    overset_interpolate(s->m, s->m->search, s->moving->born, n, f);
    if (s->surface)
        surface_mesh_change_height(s, 1.0, s->surface->phi);
    swap_status(s->m, s->moving);
}

/* Velocities of a step before, where blocks stood then. */
static void fill_born_before(struct fv *s)
{
    swap_status(s->m, s->moving);
    mesh_motion_place(s->m, s->t - s->step.dt);
    overset_interpolate(s->m, s->m->search, s->moving->born, s->dim, s->stages.u_old);
    mesh_motion_place(s->m, s->t);
    swap_status(s->m, s->moving);
}

/* The velocity of a step before is wanted only where the step has two levels before it. */
static void fill_born_all(struct fv *s)
{
    fill_born(s);
    if (s->newton && s->step.dt > 0.0)
        fill_born_before(s);
}

/* Fluxes between cells that the last projection did not have: those of the interpolated velocity.
 */
static void fill_fluxes(struct fv *s)
{
    const struct mesh *m = s->m;
    const unsigned char *was = s->moving->local;
    mesh_face_velocities(s, s->u, s->rhs);
    mesh_bc_fluxes(s, s->rhs);
    for (int q = 0; q < m->nparts; q++)
        for (int a = 0; a < m->dim; a++) {
            const struct part *p = m->part + q;
            const int64_t d = p->stride[a];
            int up[3] = {0, 0, 0};
            up[a] = 1;
            PART_ROWS (p, no_layers, up, c, n)
                for (int64_t i = c; i < c + n; i++)
                    if (was[i] != CELL_COMPUTED && was[i - d] != CELL_COMPUTED)
                        s->U[a][i] = s->rhs[a][i];
        }
}

/* Donors of the last step's end are those of this one's start then. */
static bool is_as_before(const struct mesh *m, const struct moving *v)
{
    bool same = true;
    for (int k = 0; k < m->nblocks && same; k++)
        same = memcmp(v->status[k], m->block[k].status, (size_t)mesh_count(m->block + k)) == 0;
    return same;
}

/* The times of cut and hierarchy are what a restart needs to make both again. */
static void renew_matrix(struct fv *s)
{
    struct moving *v = s->moving;
    const bool hierarchy = v->fresh == 0.0;
    v->t_rows = hierarchy ? v->t_cut : v->t_rows;
    timer_start(&s->run->timers, "pressure");
    poisson_renew(s, hierarchy);
    timer_stop(&s->run->timers, "pressure");
}

/* What cells are in the step, then blocks where they stand at its start, donors and all. */
static void cut_step(struct fv *s)
{
    struct moving *v = s->moving;
    struct mesh *m = s->m;
    v->iterations = s->totals.iterations;
    v->stage = 0;
    if (!m->has_fringe)
        return;
    timer_start(&s->run->timers, "overlap");
    for (int k = 0; k < m->nblocks; k++)
        memcpy(v->status[k], m->block[k].status, (size_t)mesh_count(m->block + k));
    memcpy(v->local, m->status, (size_t)m->size_local);
    cut(s, s->t + 0.5 * s->step.dt_now);
    timer_stop(&s->run->timers, "overlap");
    if (!s->surface)
        renew_matrix(s);
    timer_start(&s->run->timers, "overlap");
    mesh_motion_place(m, s->t);
    if (!is_as_before(m, v)) {
        if (find_born(s))
            fill_born_all(s);
        overset_find(m, m->search);
    }
    timer_stop(&s->run->timers, "overlap");
}

/* Fringes and ghosts by this step's donors: sides come after, for a ghost of a given side is of the
 * cell beside it. */
static void fill_step(struct fv *s)
{
    mesh_fill(s->m, 1, &s->p);
    mesh_fill(s->m, s->dim, s->u);
    mesh_bc_velocity(s, BC_GIVEN, s->u);
    fill_fluxes(s);
}

/* At an event of a motion, say the time at which it begins, velocities of walls jump: what the step
 * starts from has those after it. The tolerance is that of times that were reached by adding steps.
 */
bool moving_turns(struct fv *s)
{
    const double instant = 1e-9 * fmax(1.0, fabs(s->t));
    const bool now = grid_motion_event(&s->grid, s->t - 2.0 * instant) <= s->t + instant;
    for (int after = now ? 0 : 1; after < 2; after++) { /* walls that a restart has made, too */
        s->m->turn = after ? grid_motion_event(&s->grid, s->t) : s->t;
        if (now) {
            mesh_motion_place(s->m, s->t);
            mesh_bc_time(s, s->t);
        }
    }
    if (now) {
        mesh_bc_velocity(s, BC_GIVEN, s->u);
        mesh_bc_fluxes(s, s->U);
    }
    return now;
}

void moving_begin(struct fv *s)
{
    cut_step(s);
    if (s->m->has_fringe)
        fill_step(s);
}

/* The surface's own arrays are of the cells as they are cut now, so they come before the matrix,
 * which asks them what is air. */
void moving_begin_surface(struct fv *s, double dt)
{
    s->step.dt_now = dt;
    cut_step(s);
    surface_mesh_update(s);
    if (s->m->has_fringe) {
        fill_step(s);
        poisson_renew(s, false);
    }
    surface_ghosts(s, s->surface->phi);
}

void moving_end_rows(struct fv *s)
{
    if (!s->m->has_fringe)
        return;
    overset_find_rows(s->m, s->m->search);
    poisson_renew(s, false);
}

void moving_to_start(struct fv *s)
{
    mesh_motion_place(s->m, s->t);
    mesh_bc_fluxes(s, s->U);
    if (!s->m->has_fringe)
        return;
    overset_find(s->m, s->m->search);
    mesh_fill(s->m, s->dim, s->u);
    mesh_bc_velocity(s, BC_GIVEN, s->u);
}

void moving_begin_implicit(struct fv *s, double dt)
{
    struct moving *v = s->moving;
    struct mesh *m = s->m;
    s->step.dt_now = dt;
    if (!m->has_fringe)
        return;
    timer_start(&s->run->timers, "overlap");
    mesh_fill(m, 1, &s->p);
    mesh_fill(m, m->dim, s->u);
    mesh_fill(m, m->dim, s->stages.u_old);
    for (int k = 0; k < m->nblocks; k++)
        memcpy(v->status[k], m->block[k].status, (size_t)mesh_count(m->block + k));
    cut(s, s->t + dt);
    v->fresh = 0.0;
    timer_stop(&s->run->timers, "overlap");
    renew_matrix(s);
    timer_start(&s->run->timers, "overlap");
    mesh_motion_place(m, s->t);
    if (!is_as_before(m, v) && find_born(s))
        fill_born_all(s);
    timer_stop(&s->run->timers, "overlap");
}

/* Cells are those before the step, blocks stand where they did at its start. */
void moving_back(struct fv *s)
{
    struct moving *v = s->moving;
    struct mesh *m = s->m;
    mesh_motion_place(m, s->t);
    mesh_bc_time(s, s->t);
    if (!m->has_fringe)
        return;
    for (int k = 0; k < m->nblocks; k++)
        memcpy(m->block[k].status, v->status[k], (size_t)mesh_count(m->block + k));
    moving_set_free(s);
    overset_find(m, m->search);
}

/* --- stages --- */

/* R takes a vector that is fixed to the block from its direction at `from' to that at `to'. */
static void turn_back_and_on(struct mesh_motion *v, double from, double to, double R[3][3])
{
    struct body_motion a, b;
    body_drive_motion(&v->drive, from, &a);
    body_drive_motion(&v->drive, to, &b);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            R[i][j] = vec3_dot(b.Q[i], a.Q[j]);
}

/* Place of a stage's pressure in the step: of rk3 the mean of the times whose convection it
 * balances. */
static double pressure_at(const struct fv *s)
{
    const int k = s->moving->stage;
    if (s->prm.integrator != INTEGRATOR_RK3)
        return 1.0;
    const double c1 = k > 0 ? rk3_at[k - 1] : 0.0, c0 = k > 1 ? rk3_at[k - 2] : 0.0;
    return (rk3_gamma[k] * c1 + rk3_zeta[k] * c0) / (rk3_gamma[k] + rk3_zeta[k]);
}

void moving_gradient(struct fv *s)
{
    mesh_fill(s->m, s->dim, s->stages.step_p);
    for (int a = 0; a < s->dim; a++)
        memcpy(s->moving->first[a], s->stages.step_p[a], (size_t)s->size * sizeof(double));
}

/* g = the gradient of the step's start as it has turned until t, ghosts and all. */
static void turn_gradient(struct fv *s, double t, double *const g[3])
{
    const struct mesh *m = s->m;
    double *const *first = s->moving->first, R[3][3];
    for (int q = 0; q < m->nparts; q++) {
        const struct part *p = m->part + q;
        struct mesh_motion *w = m->block[p->block].motion;
        const bool turns = w && w->turns;
        for (int a = 0; a < m->dim && !turns; a++)
            memcpy(g[a] + p->base, first[a] + p->base, (size_t)p->size * sizeof(double));
        if (!turns)
            continue;
        turn_back_and_on(w, s->t, t, R);
        for (int64_t c = p->base; c < p->base + p->size; c++)
            for (int a = 0; a < m->dim; a++) {
                g[a][c] = 0.0;
                for (int k = 0; k < m->dim; k++)
                    g[a][c] += R[a][k] * first[k][c];
            }
    }
}

void moving_turn_pressure(struct fv *s, double tau)
{
    s->moving->tau = tau;
    if (s->surface)
        return;
    turn_gradient(s, s->t + pressure_at(s) * s->step.dt_now, s->stages.step_p);
}

void moving_convection(struct fv *s, double *const N[3])
{
    const struct mesh *m = s->m;
    const unsigned char *was = s->moving->local;
    for (int q = 0; q < m->nparts && s->prm.integrator == INTEGRATOR_BDF2 && m->has_fringe; q++)
        PART_ROWS (m->part + q, no_layers, no_layers, c, n)
            for (int64_t i = c; i < c + n; i++)
                for (int a = 0; a < m->dim && was[i] != CELL_COMPUTED; a++)
                    s->stages.N_old[a][i] = N[a][i];
}

/* f is e_k/c_k of the head comment. */
void moving_stage(struct fv *s, double t)
{
    struct moving *v = s->moving;
    struct mesh *m = s->m;
    const double f = pressure_at(s) * s->step.dt_now / (t - s->t);
    v->stage++;
    timer_start(&s->run->timers, "overlap");
    mesh_motion_place(m, t);
    if (m->has_fringe)
        overset_find(m, m->search);
    if (m->has_fringe && !s->surface && s->prm.integrator != INTEGRATOR_NEWTON) {
        turn_gradient(s, t, v->now);
        memcpy(v->now[m->dim], s->p, (size_t)s->size * sizeof(double));
        mesh_exchange(m, &m->fringe, m->dim + 1, v->now);
        for (int64_t c = 0; c < s->size; c++) {
            s->fringe.psi[c] = f * (v->now[m->dim][c] - s->p[c]);
            for (int a = 0; a < m->dim; a++)
                v->push[a][c] =
                    (1.0 - f) * v->first[a][c] + f * v->now[a][c] - s->stages.step_p[a][c];
        }
    }
    timer_stop(&s->run->timers, "overlap");
}

/* The second rule of the head comment. With a surface it is u* = I u* alone. */
void moving_fill(struct fv *s, double *const u[3])
{
    const struct mesh *m = s->m;
    mesh_fill(s->m, m->dim, u);
    if (s->surface)
        return;
    for (int a = 0; a < m->dim; a++)
        for (int64_t c = 0; c < s->size; c++)
            u[a][c] += m->status[c] == CELL_FRINGE ? s->moving->tau * s->moving->push[a][c] : 0.0;
    mesh_halo(s->m, m->dim, u);
}

void moving_change(struct fv *s)
{
    const struct mesh *m = s->m;
    double *const *delta = s->fringe.delta;
    for (int a = 0; a < m->dim; a++)
        memcpy(delta[a], s->u[a], (size_t)s->size * sizeof(double));
    moving_fill(s, delta);
    for (int a = 0; a < m->dim; a++)
        for (int64_t c = 0; c < s->size; c++)
            delta[a][c] = m->status[c] == CELL_FRINGE ? delta[a][c] - s->u[a][c] : 0.0;
}

void moving_end(struct fv *s)
{
    struct moving *v = s->moving;
    const double its = (double)(s->totals.iterations - v->iterations);
    if (s->surface)
        return;
    if (v->fresh == 0.0)
        v->fresh = fmax(its, 1.0);
    else if (its > 1.5 * v->fresh + 2.0)
        v->fresh = 0.0;
}

/* The largest speed in as long as a step may last, beside what it is now. */
double moving_rate(const struct fv *s)
{
    const struct mesh *m = s->m;
    const struct moving *v = s->moving;
    double most = 0.0;
    for (int k = 0; k < m->nblocks; k++) {
        const struct mesh_motion *w = m->block[k].motion;
        struct body_motion now;
        if (!w || w->block != k)
            continue;
        const double reach = w->turns ? w->reach : 0.0;
        const double ahead =
            s->step.dt > 0.0 ? 2.0 * s->step.dt : v->least / fmax(w->speed, 1e-300);
        for (int e = 0; e < 5; e++) {
            body_drive_motion(&w->drive, s->t + 0.25 * e * ahead, &now);
            most = fmax(most, vec3_length(now.u) + reach * vec3_length(now.omega));
        }
    }
    return m->has_fringe ? sqrt((double)m->dim) * most / v->least : 0.0;
}

/* --- restart --- */

void moving_save(const struct fv *s, struct h5 *f)
{
    const struct moving *v = s->moving;
    if (!v)
        return;
    h5_attribute_real(f, "t_cut", v->t_cut);
    h5_attribute_real(f, "t_rows", v->t_rows);
    h5_attribute_real(f, "fresh", v->fresh);
    h5_attribute_real(f, "level", s->gravity.level); /* found where blocks stood at the start */
}

/* The hierarchy is made of the matrix that it had, then cells and donors are those of the last
 * step's end. */
bool moving_restore(struct fv *s, struct h5 *f)
{
    struct moving *v = s->moving;
    double t_cut, t_rows, fresh;
    if (!v)
        return true;
    if (!h5_read_attribute_real(f, "t_cut", &t_cut) ||
        !h5_read_attribute_real(f, "t_rows", &t_rows) ||
        !h5_read_attribute_real(f, "fresh", &fresh) ||
        !h5_read_attribute_real(f, "level", &s->gravity.level))
        return false;
    if (s->m->has_fringe && fresh > 0.0 && !s->surface) {
        double *zw = mesh_field(s->m);
        if (s->fringe.z)
            memcpy(zw, s->fringe.z, (size_t)s->size * sizeof(double));
        cut(s, t_rows);
        v->fresh = 0.0;
        renew_matrix(s);
        if (s->fringe.z)
            memcpy(s->fringe.z, zw, (size_t)s->size * sizeof(double));
        mem_free(zw);
    }
    v->fresh = fresh;
    if (s->m->has_fringe)
        cut(s, t_cut);
    mesh_motion_place(s->m, s->t);
    if (s->m->has_fringe)
        overset_find(s->m, s->m->search);
    if (s->surface) {
        surface_mesh_update(s);
        surface_mesh_count(s);
        if (s->m->has_fringe)
            poisson_renew(s, false);
    }
    return true;
}
