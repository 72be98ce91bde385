/* test_wall_fixed.c - fixed ghosts: volumes behind curved walls, and water at rest in closed tanks
 * round bodies that are round or stand askew. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/walls/fixed_layers.h"
#include "sph_case.h"

/* A full tank of 1 m x 1 m of still water; `cells' across. */
static void tank(struct sph_case *c, int cells)
{
    struct scene *e = sph_case_tank(c, cells, 9.81, 4);
    e->fluid.rho = 1000.0;
    e->initial.U = 3.13;
    c->prm.c0 = 32.0;
    c->prm.dissipation = 0.1; /* as sph_params has it there */
    c->prm.walls = WALLS_FIXED;
    c->prm.packing = SANITIZED ? 20 : 200;
}

/* A body of n corners in the middle of the tank, clockwise; radii r[0], r[1] in turns. Returns its
 * area. */
static double add_star(struct sph_case *c, int n, const double r[2], double turned)
{
    struct scene_body *b = c->run.scene.bodies;
    c->run.scene.nbodies = 1;
    b->points.n = n;
    for (int k = 0; k < n; k++) {
        b->points.x[k][0] = 0.5 + r[k % 2] * cos(turned - 2.0 * M_PI * k / n);
        b->points.x[k][1] = 0.5 + r[k % 2] * sin(turned - 2.0 * M_PI * k / n);
    }
    b->centre[0] = b->centre[1] = 0.5;
    return 0.5 * n * r[0] * r[1] * sin(2.0 * M_PI / n);
}

/* Ghosts at the depth d have the layer's length at that radius, so that theirs and their images',
 * whose layer is as far before the wall, have the ratio (Rc - d)/(Rc + d) of a curved wall [3.11],
 * and its inverse in a round tank. */
TEST(layers_are_curved)
{
    const double dx = 1.0 / 32.0, radius[2] = {0.2, 0.2};
    struct sph_case c;
    tank(&c, 32);
    add_star(&c, 48, radius, 0.0);
    c.prm.packing = 0;
    struct sph *s = sph_case_start(&c, NULL);
    struct fixed_layers layers = {0};
    fixed_layers_lay(s, &layers);
    for (int layer = 0; layer < 4; layer++) {
        const double d = (layer + 0.5) * dx, Rc = 0.2 * cos(M_PI / 48.0); /* of the chords */
        double sum = 0.0;
        int n = 0;
        for (int k = 0; k < layers.n; k++) {
            const struct fixed_node *f = layers.of + k;
            const double to[2] = {f->x[0] - f->foot[0], f->x[1] - f->foot[1]};
            if (hypot(f->foot[0] - 0.5, f->foot[1] - 0.5) > 0.25 ||
                fabs(hypot(to[0], to[1]) - d) > 0.1 * d)
                continue;
            assert_true(hypot(f->x[0] - 0.5, f->x[1] - 0.5) < 0.2);
            sum += f->w;
            n++;
        }
        const double image = 48.0 * 2.0 * (Rc + d) * tan(M_PI / 48.0) * dx; /* m^2 */
        assert_close(sum / image, (Rc - d) / (Rc + d), 1e-9);
        assert_close(sum / (n * dx * dx), 1.0, 0.5 / n);
    }
    mem_free(layers.of);
    DROP(c.s);
}

/* Behind the sides of a tank the layers fill its frame, corners included. */
TEST(layers_fill_corners)
{
    struct sph_case c;
    double sum = 0.0;
    tank(&c, 20);
    struct sph *s = sph_case_start(&c, NULL);
    struct fixed_layers layers = {0};
    fixed_layers_lay(s, &layers);
    for (int k = 0; k < layers.n; k++)
        sum += layers.of[k].w;
    assert_close(sum, (1.0 + 2.0 * s->R) * (1.0 + 2.0 * s->R) - 1.0, 1e-9);
    mem_free(layers.of);
    DROP(c.s);
}

/* Water of a full tank rests round a body, which it bears by its weight of water: the average of
 * the pressure on it within 2 %, velocities below 1e-3 c0, nothing returned. */
static void rests_round(int n, const double r[2], double turned)
{
    struct sph_case c;
    double late = 0.0, lift = 0.0;
    tank(&c, 24);
    const double area = add_star(&c, n, r, turned);
    struct sph *s = sph_case_start(&c, NULL);
    assert_true(sph_case_run(&c, SANITIZED ? 10 : 200, 100.0));
    for (int k = 0; k < (SANITIZED ? 2 : 100); k++) {
        assert_true(sph_case_run(&c, 1, 100.0));
        late = fmax(late, s->step.max_speed);
        lift += body_average(s, 0).F[1] / (SANITIZED ? 2 : 100);
    }
    print_message("|u| %.1e c0, lift %.4f of %.4f N/m\n", late / s->c0, lift, 9810.0 * area);
    assert_close((double)s->walls->returned, 0.0, 0.0);
    assert_true(SANITIZED || late < 1e-3 * s->c0);
    assert_true(SANITIZED || fabs(lift / (9810.0 * area) - 1.0) < 0.02);
    DROP(c.s);
}

TEST(rests_round_bodies)
{
    rests_round(48, (double[2]){0.2, 0.2}, 0.1);
    rests_round(4, (double[2]){0.2, 0.2}, 0.3);
}
