/* mesh_errors.c - rows of the series and the summary of a flow on blocks: forces on walls, gauges.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../boundary/mesh_bc.h"
#include "../coupling/water_budget.h"
#include "../fv.h"
#include "../grid/mesh.h"
#include "../operators/mesh_ops.h"
#include "mesh_output.h"
#include "output.h"
#include "report.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../../common/base/log.h"
#include "../../common/base/mem.h"
#include "../../common/run/forecast.h"
#include "../boundary/still.h"
#include "../grid/mesh_motion.h"
#include "../grid/mesh_outside.h"
#include "../grid/overset.h"
#include "../surface/fraction.h"
#include "../surface/levelset.h"
#include "../watch/limits.h"

bool mesh_counts_twice(const struct fv *s, const struct overset *o, int block, const double *x)
{
    int cell[3];
    double xi[3];
    for (int k = block + 1; k < s->m->nblocks; k++) {
        const struct mesh_block *b = s->m->block + k;
        if (overset_locate(s->m, o, k, x, cell, xi) &&
            b->status[mesh_cell(b, cell)] == CELL_COMPUTED)
            return true;
    }
    return false;
}

double mesh_value_at(const struct fv *s, const struct overset *o, const double *x, int wanted,
                     const double *q)
{
    const struct mesh *m = s->m;
    double value = 0.0, finest = INFINITY;
    for (int k = 0; k < m->nblocks; k++) {
        int cell[3], from[3], width = wanted > 0 ? wanted : 4;
        double xi[3], w[64], sum = 0.0;
        if (!overset_locate(m, o, k, x, cell, xi))
            continue;
        const double v = m->block[k].volume[mesh_cell(m->block + k, cell)];
        bool good = v < finest && overset_weights(m, k, cell, xi, 1, width, from, w);
        if (!good && wanted == 0) {
            width = 2;
            good = v < finest && overset_weights(m, k, cell, xi, 1, width, from, w);
        }
        if (!good)
            continue;
        for (int n = 0; n < (m->dim == 3 ? width : 1) * width * width; n++) {
            int at[3] = {from[0] + n % width, from[1] + n / width % width,
                         from[2] + n / width / width};
            int block = k, rank;
            double move[3] = {0.0, 0.0, 0.0};
            int64_t place;
            if (!mesh_resolve(m, &block, at, move))
                continue;
            mesh_owner(m, block, at, &rank, &place);
            if (rank == m->rank)
                sum += w[n] * (q ? q[place] : fv_pressure(s, place));
        }
        finest = v;
        value = sum;
    }
    return value;
}

/* Whether the forces on a block's own body have columns of their own: where other sides are closed,
 * too, so that the sum is not this body's. */
static bool has_own_forces(const struct run *r, const struct fv_params *prm, int k)
{
    int n = 0;
    for (int w = 0; w < r->scene.nwalls; w++)
        n += r->scene.walls[w].kind == WALL_NO_SLIP || r->scene.walls[w].kind == WALL_SLIP;
    for (int b = 0; b < prm->blocks.n; b++)
        n += mesh_block_has(prm->blocks.of + b, MESH_WALL) ||
             mesh_block_has(prm->blocks.of + b, MESH_SLIP);
    return n > 1 && mesh_block_is_body(r, prm->blocks.of + k);
}

/* Places of blocks that move: x y [z] of the centre, the angle or the rotation vector. */
static int motion_columns(const struct run *r, const struct fv_params *prm, const char **columns)
{
    static const char *const axes[2][6] = {
        {"x [m]", "y [m]", "angle [rad]"},
        {"x [m]", "y [m]", "z [m]", "rx [rad]", "ry [rad]", "rz [rad]"}};
    static char own[MESH_BLOCKS_MAX][6][PARAM_TEXT_SIZE + 24];
    const int dim = r->scene.domain.dim;
    int n = 0;
    for (int k = 0; k < prm->blocks.n; k++)
        for (int a = 0; a < (dim == 3 ? 6 : 3) && prm->blocks.of[k].motion.n > 0; a++) {
            snprintf(own[k][a], sizeof own[k][a], "%s %s", prm->blocks.of[k].name,
                     axes[dim == 3][a]);
            columns[n++] = own[k][a];
        }
    return n;
}

static int motion_values(const struct fv *s, double *values)
{
    const int dim = s->dim;
    int n = 0;
    for (int k = 0; k < s->m->nblocks; k++) {
        const struct mesh_motion *v = s->m->block[k].motion;
        if (!v || v->block != k)
            continue;
        for (int a = 0; a < dim; a++)
            values[n++] = v->centre[a] + v->now.x[a];
        for (int a = dim == 3 ? 0 : 2; a < 3; a++)
            values[n++] = v->now.r[a];
    }
    return n;
}

static int force_columns(const struct run *r, const struct fv_params *prm, const char **columns)
{
    static const char *const forces[] = {"force x [N]", "force y [N]", "force z [N]"};
    static char own[MESH_BLOCKS_MAX][4][PARAM_TEXT_SIZE + 24];
    int n = 0;
    for (int a = 0; a < r->scene.domain.dim; a++)
        columns[n++] = forces[a];
    columns[n++] = "moment z [Nm]";
    for (int k = 0; k < prm->blocks.n; k++) {
        const char *name = prm->blocks.of[k].name;
        if (!has_own_forces(r, prm, k))
            continue;
        for (int a = 0; a < r->scene.domain.dim; a++) {
            snprintf(own[k][a], sizeof own[k][a], "%s force %c [N]", name, "xyz"[a]);
            columns[n++] = own[k][a];
        }
        snprintf(own[k][3], sizeof own[k][3], "%s moment z [Nm]", name);
        columns[n++] = own[k][3];
    }
    return n + motion_columns(r, prm, columns + n);
}

/* On the body of each block and on all closed sides; moments are about each block's centre. */
static void whole_force(struct fv *s, double (*of)[4], double whole[4])
{
    if (s->surface)
        surface_ghosts(s, s->surface->phi);
    mesh_bc_force(s, s->surface ? s->surface->phi : NULL, of, whole);
}

static int forces(struct fv *s, double *values)
{
    double force[4], of[MESH_BLOCKS_MAX][4], bodies[2] = {0.0, 0.0};
    int n = 0;
    whole_force(s, of, force);
    for (int a = 0; a < s->dim; a++)
        values[n++] = force[a];
    values[n++] = force[3];
    for (int k = 0; k < s->m->nblocks; k++) {
        for (int a = 0; a < 2; a++)
            bodies[a] += of[k][a];
        if (!has_own_forces(s->run, &s->prm, k))
            continue;
        for (int a = 0; a < s->dim; a++)
            values[n++] = of[k][a];
        values[n++] = of[k][3];
    }
    n += motion_values(s, values + n);
    GROW(s->history, s->nhistory, s->nhistory + 1);
    s->history[s->nhistory][0] = s->t;
    memcpy(s->history[s->nhistory++] + 1, bodies, sizeof bodies);
    return n;
}

/* Mean and half range of the forces on bodies and no-slip walls over the second half of the run,
 * frequency of the one along y by the crossings of its mean. */
static void summarise_swing(const struct fv *s)
{
    struct summary *to = s->run->summary;
    double mean[2] = {0.0, 0.0}, least[2] = {INFINITY, INFINITY}, most[2] = {-INFINITY, -INFINITY};
    double first = 0.0, last = 0.0, weight = 0.0;
    int from = 1, crossings = 0;
    while (from < s->nhistory && s->history[from][0] < 0.5 * s->run->scene.time.end)
        from++;
    if (s->nhistory - from < 8)
        return;
    for (int k = from; k < s->nhistory; k++) {
        const double *a = s->history[k - 1], *b = s->history[k];
        weight += b[0] - a[0];
        for (int q = 0; q < 2; q++) {
            mean[q] += 0.5 * (a[1 + q] + b[1 + q]) * (b[0] - a[0]);
            least[q] = fmin(least[q], b[1 + q]);
            most[q] = fmax(most[q], b[1 + q]);
        }
    }
    for (int q = 0; q < 2; q++)
        mean[q] /= weight;
    bool low = false; /* a crossing counts after the lower half of the range has been reached */
    for (int k = from; k < s->nhistory; k++) {
        const double *a = s->history[k - 1], *b = s->history[k];
        low = low || b[2] < mean[1] - 0.25 * (most[1] - least[1]);
        if (!low || b[2] < mean[1])
            continue;
        low = false;
        last = a[0] + (b[0] - a[0]) * (mean[1] - a[2]) / (b[2] - a[2]);
        first = crossings++ == 0 ? last : first;
    }
    const double frequency = crossings > 1 ? (crossings - 1) / (last - first) : 0.0;
    const double found[3] = {mean[0], 0.5 * (most[1] - least[1]), frequency};
    static const char *const names[3] = {"error.force_x", "error.force_y", "error.frequency"};
    summary_real(to, "force.x_mean", mean[0]);
    summary_real(to, "force.x_amplitude", 0.5 * (most[0] - least[0]));
    summary_real(to, "force.y_mean", mean[1]);
    summary_real(to, "force.y_amplitude", found[1]);
    summary_real(to, "force.frequency", frequency);
    for (int q = 0; q < 3; q++)
        if (s->prm.force[q] != 0.0)
            summary_real(to, names[q], fabs(found[q] / s->prm.force[q] - 1.0));
}

static void summarise_forces(struct fv *s)
{
    static const char *const names[] = {"force.x", "force.y", "force.z"};
    double force[4], of[MESH_BLOCKS_MAX][4];
    char key[PARAM_TEXT_SIZE + 24];
    whole_force(s, of, force);
    for (int a = 0; a < s->m->dim; a++)
        summary_real(s->run->summary, names[a], force[a]);
    summary_real(s->run->summary, "force.moment", force[3]);
    for (int k = 0; k < s->m->nblocks; k++) {
        const char *name = s->m->block[k].prm->name;
        if (!has_own_forces(s->run, &s->prm, k))
            continue;
        for (int a = 0; a < s->m->dim; a++) {
            snprintf(key, sizeof key, "force.%s.%c", name, "xyz"[a]);
            summary_real(s->run->summary, key, of[k][a]);
        }
        snprintf(key, sizeof key, "force.%s.moment", name);
        summary_real(s->run->summary, key, of[k][3]);
    }
    summarise_swing(s);
}

static void summarise(struct fv *s)
{
    struct summary *to = s->run->summary;
    summary_int(to, "fringe_cells", s->m->fringe_cells);
    summary_int(to, "fringe_cells_linear", s->m->linear);
    if (mesh_bc_pressure_given(s))
        s->defect = fabs(mesh_bc_net_flux(s));
    if (s->m->has_fringe && s->umax[0] > 0.0) /* relative to the flow, if there is one */
        summary_real(to, "overlap.net_flux", s->defect / s->umax[0]);
    if (s->surface)
        surface_summarise(s);
    if (mesh_bc_has_walls(s->m))
        summarise_forces(s);
    summary_int(to, "poisson_iterations_start", s->start_iterations);
    summary_real(to, "poisson_retries", (double)s->retries);
}

const struct report block_report = {.force_columns = force_columns,
                                    .forces = forces,
                                    .probes = mesh_probes,
                                    .summarise = summarise};

/* Least distance of opposite faces of a computed cell, m, about: volume over the largest face. */
static double least_height(const struct mesh *m)
{
    double least = INFINITY;
    for (int q = 0; q < m->nparts; q++) {
        const struct part *p = m->part + q;
        int i[3];
        PART_CELLS (p, i, c)
            for (int a = 0; a < m->dim && m->status[c] == CELL_COMPUTED; a++) {
                const double S[3] = {m->S[a][0][c], m->S[a][1][c], m->dim == 3 ? m->S[a][2][c] : 0};
                least = fmin(least, m->V[c] / sqrt(S[0] * S[0] + S[1] * S[1] + S[2] * S[2]));
            }
    }
    MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_DOUBLE, MPI_MIN, m->comm);
    return least;
}

/* What the sides are, and what the run uses and leaves out. */
static void describe_scene(const struct run *r, const struct fv_params *prm, const struct mesh *m)
{
    static const char *const kinds[] = {"overlap", "joined", "periodic", "walls",
                                        "slip",    "inflow", "outflow",  "exact velocity"};
    const double *g = r->scene.fluid.gravity;
    bool moves = false;
    for (int k = 0; k < m->nblocks; k++)
        moves = moves || m->block[k].motion;
    char sides[160] = "";
    for (int kind = MESH_OVERLAP; kind <= MESH_EXACT; kind++) {
        bool any = false;
        for (int k = 0; k < m->nblocks; k++)
            for (int q = 0; q < 2 * m->dim; q++)
                any = any || (int)m->block[k].side[q] == kind;
        const size_t n = strlen(sides);
        if (any)
            snprintf(sides + n, sizeof sides - n, "%s%s", n ? ", " : "", kinds[kind]);
    }
    const struct log_use uses[] = {{r->scene.fluid.nu > 0.0, "implicit viscosity", NULL},
                                   {prm->water, "free surface (level set)", NULL},
                                   {mesh_bc_has_walls(m), "walls", NULL},
                                   {m->has_fringe, "interpolation where blocks overlap", NULL},
                                   {g[0] != 0.0 || g[1] != 0.0 || g[2] != 0.0, "gravity", NULL},
                                   {moves, "moving blocks", NULL},
                                   {m->has_given, "imposed cells", NULL},
                                   {r->coupled, "coupling", NULL}};
    log_say("%dD, fourth-order averages, %s; sides: %s", m->dim, report_method(prm), sides);
    log_uses(uses, (int)(sizeof uses / sizeof *uses));
    log_say("%s", prm->errors ? "errors against the exact solution"
                              : "no exact solution to measure errors by");
}

/* Of a cell and step, over that of the uniform grid: the cavity on 48 x 48 cells. */
#define BLOCK_COST 3.6

/* Speed of the scene and of the blocks' sides across the smallest cell. */
static void describe_step(const struct run *r, const struct fv_params *prm, const struct mesh *m)
{
    double speed = limits_reference(r);
    for (int k = 0; k < m->nblocks; k++) {
        const struct mesh_block_params *b = m->block[k].prm;
        speed = fmax(speed, hypot(hypot(b->velocity[0], b->velocity[1]), b->velocity[2]));
        if (m->block[k].motion)
            speed = fmax(speed, m->block[k].motion->speed);
        for (int side = 0; side < 2 && b->mapping == MAPPING_ANNULUS; side++)
            speed = fmax(speed, fabs(b->spin[side]) * b->radius[side]);
    }
    const double cfl = limits_cfl(prm), h = least_height(m);
    limits_warn(r, prm, h);
    log_say("%lld cells computed, the flattest %.3g m high; about %.0f MB", (long long)m->computed,
            h, 8e-6 * (double)m->cells * 80.0 + 1.0);
    if (prm->steady)
        return; /* marches in pseudo-time */
    log_say("dt about %.3g s if the fastest flow crosses the flattest cell (%s, CFL %g)",
            cfl * h / speed, limit_name(LIMIT_FLOW), cfl);
    forecast_say("fv", m->dim, BLOCK_COST * (double)m->computed,
                 ceil(r->scene.time.end * speed / (cfl * h)));
}

void mesh_describe(const struct run *r, const struct fv_params *prm)
{
    static const char *const shapes[] = {"box", "stretched box", "ring", "sheared box", "file"};
    struct faults f = {0};
    struct mesh *m = mesh_take(r, &prm->blocks, fv_hole(prm) != NULL, fv_hole(prm), &f);
    for (int k = 0; m && k < m->nblocks; k++) {
        const struct mesh_block *b = m->block + k;
        int64_t count[4] = {0, 0, 0, 0};
        for (int64_t c = 0; c < (int64_t)b->n[0] * b->n[1] * b->n[2]; c++)
            count[b->status[c]]++;
        log_say("block %d \"%s\": %s, %d x %d x %d cells: %lld computed, %lld interpolated, %lld "
                "imposed, %lld cut out",
                k + 1, b->prm->name, shapes[b->prm->mapping], b->n[0], b->n[1], b->n[2],
                (long long)count[CELL_COMPUTED], (long long)count[CELL_FRINGE],
                (long long)count[CELL_GIVEN], (long long)count[CELL_HOLE]);
    }
    if (m) {
        describe_scene(r, prm, m);
        if (prm->water) {
            fraction_describe(r, prm, m, least_height(m));
            mesh_outside_describe(r, m);
        }
        describe_step(r, prm, m);
    }
    mesh_leave(&m);
}
