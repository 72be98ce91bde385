/* body_output.c - what moving bodies show: columns of the series, the summary, the restart file.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../../common/files/files.h"
#include "bodies.h"
#include "contact_places.h"

enum { MOTION_COLUMNS = 12 };

/* Place, rotation, velocity, spin, in this order; those of the plane are marked. */
static const struct {
    const char *name, *unit;
    bool flat;
} shown[MOTION_COLUMNS] = {{"x", "m", true},       {"y", "m", true},       {"z", "m", false},
                           {"rx", "rad", false},   {"ry", "rad", false},   {"angle", "rad", true},
                           {"u", "m/s", true},     {"v", "m/s", true},     {"w", "m/s", false},
                           {"ox", "rad/s", false}, {"oy", "rad/s", false}, {"spin", "rad/s", true}};

static const char *name_of(bool solid, int i)
{
    return solid && i == 5 ? "rz" : solid && i == 11 ? "oz" : shown[i].name;
}

/* The centre's place is that in space. */
static void motion_of(const struct body *b, double v[MOTION_COLUMNS])
{
    for (int a = 0; a < 3; a++) {
        v[a] = b->centre[a] + b->now.x[a];
        v[3 + a] = b->now.r[a];
        v[6 + a] = b->now.u[a];
        v[9 + a] = b->now.omega[a];
    }
}

/* Of its motion, its mooring lines, its contacts. */
void bodies_row(const struct sph *s, int k, struct figures *to)
{
    const struct scene_body *b = s->run->scene.bodies + k;
    const bool solid = s->dim == 3;
    const char *force = solid ? "N" : "N/m";
    double v[MOTION_COLUMNS] = {0.0};
    if (!scene_body_moves(b))
        return;
    const struct body *now = s->walls->bodies + k;
    motion_of(now, v);
    for (int i = 0; i < MOTION_COLUMNS; i++)
        if (solid || shown[i].flat)
            FIGURE(to, v[i], "%s %s [%s]", b->name, name_of(solid, i), shown[i].unit);
    for (int i = 0; i < b->lines.n && now->free; i++)
        FIGURE(to, now->free->tension[i], "%s line %d [%s]", b->name, i + 1, force);
    if (now->free)
        FIGURE(to, vec3_length(now->free->contact), "%s contact [%s]", b->name, force);
}

/* --- summary --- */

static void put(struct summary *to, const struct body *b, const char *what, double v)
{
    char key[PARAM_TEXT_SIZE + 48];
    snprintf(key, sizeof key, "body.%s.%s", b->is->name, what);
    for (char *c = key + 5; *c; c++)
        if (*c == ' ')
            *c = '_';
    summary_real(to, key, v);
}

static void summarise_free(const struct sph *s, int k)
{
    const struct body *b = s->walls->bodies + k;
    const struct body_free *f = b->free;
    struct summary *to = s->run->summary;
    double kinetic, lost[3];
    const double energy = body_energy(b, s->run->scene.fluid.gravity, &kinetic);
    put(to, b, "mass", f->mass);
    put(to, b, "inertia", f->inertia[2][2]);
    put(to, b, "kinetic", kinetic);
    put(to, b, "potential", energy - kinetic);
    put(to, b, "springs", body_lines_energy(&s->run->scene, s->walls->bodies, k));
    put(to, b, "stopping_rate", f->lambda);
    vec3_from(f->impulse[0], f->impulse[1], lost);
    if (f->size > 0.0)
        put(to, b, "momentum_defect", vec3_length(lost) / f->size);
}

void bodies_summarise(const struct sph *s)
{
    for (int k = 0; s->walls && k < s->walls->nbodies; k++) {
        const struct body *b = s->walls->bodies + k;
        double v[MOTION_COLUMNS];
        if (!scene_body_moves(b->is))
            continue;
        motion_of(b, v);
        for (int i = 0; i < MOTION_COLUMNS; i++)
            if (s->dim == 3 || shown[i].flat)
                put(s->run->summary, b, name_of(s->dim == 3, i), v[i]);
        if (b->free)
            summarise_free(s, k);
    }
}

/* --- restart --- */

/* The last rates belong to it: averaged forces carry pressures with them. */
enum {
    KEPT = 2 * BODY_STATE + 6 + LINES_MAX + 3 + 7,
    FRICTION = (BODIES_MAX + 1) * (int)(sizeof(struct pair_friction) / sizeof(double))
};

/* One row of the restart file; `take' reads it in the same order, KEPT is its length. */
static void flatten(const struct body_free *f, double *v)
{
    memcpy(v, f->y, sizeof f->y);
    memcpy(v += BODY_STATE, f->rate, sizeof f->rate);
    memcpy(v += BODY_STATE, f->force, sizeof f->force);
    memcpy(v += 6, f->tension, sizeof f->tension);
    memcpy(v += LINES_MAX, f->contact, sizeof f->contact);
    memcpy(v += 3, f->impulse, sizeof f->impulse);
    v[6] = f->size;
}

static void take(struct body_free *f, const double *v)
{
    memcpy(f->y, v, sizeof f->y);
    memcpy(f->rate, v += BODY_STATE, sizeof f->rate);
    memcpy(f->force, v += BODY_STATE, sizeof f->force);
    memcpy(f->tension, v += 6, sizeof f->tension);
    memcpy(f->contact, v += LINES_MAX, sizeof f->contact);
    memcpy(f->impulse, v += 3, sizeof f->impulse);
    f->size = v[6];
}

bool bodies_restart(struct sph *s, struct h5 *f)
{
    struct walls *w = s->walls;
    double *rows = NEW(double, KEPT *BODIES_MAX);
    int n = 0, at = 0;
    for (int k = 0; k < w->nbodies; k++)
        if (w->bodies[k].free)
            flatten(w->bodies[k].free, rows + (size_t)KEPT * n++);
    const bool fits = n == 0 || h5_keep_rows(f, "bodies", "state of free bodies", n, KEPT, rows);
    for (int k = 0; fits && !h5_writes(f) && k < w->nbodies; k++)
        if (w->bodies[k].free)
            take(w->bodies[k].free, rows + (size_t)KEPT * at++);
    mem_free(rows);
    if (n == 0)
        return true;
    (void)h5_keep_rows(f, "contacts", "m/s", BODIES_MAX, BODIES_MAX + 1, &w->approach[0][0]);
    (void)h5_keep_rows(f, "contact gaps", "m", BODIES_MAX, BODIES_MAX + 1, &w->start_gap[0][0]);
    (void)h5_keep_rows(f, "contact ways", "-", BODIES_MAX, 3, &w->start_way[0][0]);
    contact_places_restart(w, f);
    (void)h5_keep_rows(f, "contact friction", "N", BODIES_MAX, FRICTION, (double *)w->friction);
    if (!h5_writes(f))
        walls_move(s, s->t);
    return fits;
}
