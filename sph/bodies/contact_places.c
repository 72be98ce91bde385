/* contact_places.c - where contact begins between a sharp corner and what it touches: a gap away if
 * it has come from outside, else where it was first seen, as at the start, when bodies may stand on
 * each other. As it parts, water comes in below it, one particle thick or less; pressed flat again
 * by a body that rocks on its edge, or falls back, that is shot out and ends the run. So the place
 * follows what parts, and from there sinks back slowly. A round surface rolls: others of its
 * corners come down, and what they come down on has no slit. SPDX-License-Identifier: BSD-3-Clause
 */
#include "contact_places.h"

#include "../../common/files/files.h"

enum { PARTS = sizeof(struct contact_place) / sizeof(double) };

static const double behind = 0.1; /* dx: how much a place is behind the corner that parts */
static const double sinks = 0.1;  /* sqrt(g dx): at which a place sinks; with 0.3 runs ended */

/* Of those of the last stage; NULL: it is a new one. Touches are found in one order, so one way
 * through both lists will do. */
static const struct contact_place *same(const struct walls *w, const double *id, int *at)
{
    for (int k = *at; k < w->nplaces; k++)
        if (memcmp(w->places[k].id, id, sizeof w->places[k].id) == 0) {
            *at = k + 1;
            return w->places + k;
        }
    return NULL;
}

struct contact_place *contact_places_add(const struct sph *s, struct contact_places *to,
                                         const struct pair *p, const struct touch *t, double gap)
{
    const double now = gap - t->depth, step = fmax(0.0, -vec3_dot(t->u, t->out)) * s->dt;
    const bool outside = now + 2.0 * step > gap;
    struct contact_place is = {.id = {p->a, p->b, t->mine, t->of, t->corner},
                               .from = outside ? gap : now,
                               .first = outside ? gap : now};
    const struct contact_place *was = same(s->walls, is.id, &to->at);
    if (was)
        is = *was;
    is.from = fmax(is.from, now - behind * s->dx);
    ROOM_IN(NULL, to->of, to->n + 1);
    to->of[to->n] = is;
    return to->of + to->n++;
}

void contact_places_take(struct walls *w, struct contact_places *from)
{
    ROOM_IN(w, w->places, from->n);
    if (from->n > 0)
        memcpy(w->places, from->of, (size_t)from->n * sizeof *from->of);
    w->nplaces = from->n;
    FREE(from->of);
}

void contact_places_settle(struct sph *s)
{
    const double way = sinks * sqrt(vec3_length(s->run->scene.fluid.gravity) * s->dx) * s->dt;
    for (int k = 0; k < s->walls->nplaces; k++) {
        struct contact_place *c = s->walls->places + k;
        c->from = fmax(c->first, c->from - way);
    }
}

void contact_places_restart(struct walls *w, struct h5 *f)
{
    int64_t n = w->nplaces;
    if (h5_writes(f)) {
        (void)h5_keep_rows(f, "contact places", "m", n, PARTS, (double *)w->places);
        return;
    }
    double *rows = h5_read_all_real(f, "contact places", PARTS, &n);
    struct contact_places read = {.n = rows ? (int)n : 0, .of = (struct contact_place *)rows};
    contact_places_take(w, &read);
}
