/* mesh_map.c - vertices of blocks from their mappings or from files, and the smooth map through
 * them: cubic in each index, so that places and metrics between vertices are of fourth order.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "mesh.h"

#include "mesh_file.h"

/* x(s) = c + K sinh(B (s - s0)) from min to max, finest at c: s in [0, 1]. B < 0: by a tanh, finest
 * at both ends. s0 and K follow from x(0) = min, x(1) = max and the least slope at c. */
static double focused(double min, double max, double c, double B, double s)
{
    if (B == 0.0)
        return min + s * (max - min);
    if (B < 0.0)
        return 0.5 * (min + max) + 0.5 * (max - min) * tanh(B * (2.0 * s - 1.0)) / tanh(B);
    const double f = fmin(fmax((c - min) / (max - min), 0.0), 1.0);
    const double s0 = 0.5 / B * log((1.0 + (exp(B) - 1.0) * f) / (1.0 + (exp(-B) - 1.0) * f));
    const double K = (max - min) / (sinh(B * (1.0 - s0)) + sinh(B * s0));
    return min + K * (sinh(B * (s - s0)) + sinh(B * s0));
}

/* Turns x about the block's centre by `angle', degrees. */
static void rotate(const struct mesh_block_params *p, double *x)
{
    const double a = p->angle * M_PI / 180.0, c = cos(a), s = sin(a);
    const double X = x[0] - p->centre[0], Y = x[1] - p->centre[1];
    if (p->angle != 0.0) {
        x[0] = p->centre[0] + c * X - s * Y;
        x[1] = p->centre[1] + s * X + c * Y;
    }
}

/* Place at s (0 to 1 within the block, beyond behind its sides). For all mappings but that of a
 * file. */
static void map(const struct mesh_block_params *p, int dim, const double *s, double *x)
{
    for (int a = 0; a < 3; a++)
        x[a] = a < dim ? p->min[a] + s[a] * (p->max[a] - p->min[a]) : 0.0;
    if (p->mapping == MAPPING_ANNULUS) {
        const double r = focused(p->radius[0], p->radius[1], p->radius[0], p->stretch[0], s[0]);
        const double angle = (p->arc[0] + s[1] * (p->arc[1] - p->arc[0])) * M_PI / 180.0;
        x[0] = p->centre[0] + r * cos(angle);
        x[1] = p->centre[1] + r * sin(angle);
        return;
    }
    for (int a = 0; a < dim && p->mapping == MAPPING_STRETCHED; a++)
        x[a] = focused(p->min[a], p->max[a], p->focus[a], p->stretch[a], s[a]);
    if (p->mapping == MAPPING_SHEARED) {
        const double w = p->wave * sin(2.0 * M_PI * s[0]) * sin(2.0 * M_PI * s[1]);
        x[0] += w * (p->max[0] - p->min[0]);
        x[1] += w * (p->max[1] - p->min[1]);
        x[0] += p->shear * (x[1] - p->min[1]);
    }
    rotate(p, x);
}

/* Vertices beyond the end x by the cubic through the last four, one after the other: 4 (x_1 + x_3)
 * - 6 x_2 - x_4. */
static void extend_line(double (*x)[3], int64_t step)
{
    for (int m = 1; m <= MESH_VERTICES; m++)
        for (int c = 0; c < 3; c++)
            x[-m * step][c] = 4.0 * (x[(1 - m) * step][c] + x[(3 - m) * step][c]) -
                              6.0 * x[(2 - m) * step][c] - x[(4 - m) * step][c];
}

/* Fills the layers behind the sides of a block from a file by cubics along each index; axis by
 * axis, so that corners follow. */
static void extend(struct mesh_block *b, int dim)
{
    for (int a = 0; a < dim; a++) {
        const int64_t step = a == 0 ? 1 : a == 1 ? b->nv[0] : (int64_t)b->nv[0] * b->nv[1];
        int i[3];
        for (i[2] = b->v0[2]; i[2] < b->v0[2] + b->nv[2]; i[2]++)
            for (i[1] = b->v0[1]; i[1] < b->v0[1] + b->nv[1]; i[1]++)
                for (i[0] = b->v0[0]; i[0] < b->v0[0] + b->nv[0]; i[0]++) {
                    if (i[a] != 0)
                        continue;
                    double(*x)[3] = b->x + mesh_vertex(b, i[0], i[1], i[2]);
                    extend_line(x, step);
                    extend_line(x + b->n[a] * step, -step);
                }
    }
}

/* s = i/n in [0, 1] within the block; layers behind the sides are mapped as well, where the mapping
 * has no file. */
bool mesh_map_vertices(const struct run *r, struct faults *f, struct mesh_block *b)
{
    const struct mesh_block_params *p = b->prm;
    const int dim = r->scene.domain.dim;
    double *vertices = NULL;
    for (int a = 0; a < 3; a++)
        b->n[a] = a < dim ? p->cells[a] : 1;
    if (p->mapping == MAPPING_FILE && !(vertices = mesh_file_read(r, f, p, b->n)))
        return false;
    for (int a = 0; a < 3; a++) {
        b->v0[a] = a < dim ? -MESH_VERTICES : 0;
        b->nv[a] = a < dim ? b->n[a] + 1 + 2 * MESH_VERTICES : 1;
    }
    b->x = (double(*)[3])NEW(double, 3 * (int64_t)b->nv[0] * b->nv[1] * b->nv[2]);
    int i[3];
    for (i[2] = b->v0[2]; i[2] < b->v0[2] + b->nv[2]; i[2]++)
        for (i[1] = b->v0[1]; i[1] < b->v0[1] + b->nv[1]; i[1]++)
            for (i[0] = b->v0[0]; i[0] < b->v0[0] + b->nv[0]; i[0]++) {
                double *x = b->x[mesh_vertex(b, i[0], i[1], i[2])], s[3];
                bool inside = true;
                for (int a = 0; a < 3; a++) {
                    s[a] = (double)i[a] / b->n[a];
                    inside = inside && i[a] >= 0 && i[a] <= b->n[a];
                }
                if (!vertices)
                    map(p, dim, s, x);
                else if (inside)
                    for (int c = 0; c < dim; c++)
                        x[c] = vertices[dim * (i[0] + (b->n[0] + 1) *
                                                          (int64_t)(i[1] + (b->n[1] + 1) * i[2])) +
                                        c];
            }
    if (vertices)
        extend(b, dim);
    mem_free(vertices);
    return true;
}

/* Lagrange's cubics through -1, 0, 1, 2 at s (w) and their slopes (d). */
static void cubic(double s, double *w, double *d)
{
    w[0] = -s * (s - 1.0) * (s - 2.0) / 6.0;
    w[1] = (s + 1.0) * (s - 1.0) * (s - 2.0) / 2.0;
    w[2] = -(s + 1.0) * s * (s - 2.0) / 2.0;
    w[3] = (s + 1.0) * s * (s - 1.0) / 6.0;
    d[0] = -(3.0 * s * s - 6.0 * s + 2.0) / 6.0;
    d[1] = (3.0 * s * s - 4.0 * s - 1.0) / 2.0;
    d[2] = -(3.0 * s * s - 2.0 * s - 2.0) / 2.0;
    d[3] = (3.0 * s * s - 1.0) / 6.0;
}

/* Sums along the first index, then the second, then the third: x and dx of a point. dim is a
 * constant in both callers. */
INLINE void sum_up(const struct mesh_block *b, const int dim, const int *from, double w[3][4],
                   double d[3][4], double *x, double dx[3][3])
{
    const int n2 = dim == 3 ? 4 : 1;
    for (int k = 0; k < n2; k++) {
        double plane[3][3] = {{0.0}};
        for (int j = 0; j < 4; j++) {
            const double(*v)[3] =
                (const double(*)[3])(b->x + mesh_vertex(b, from[0], from[1] + j, from[2] + k));
            for (int c = 0; c < dim; c++) {
                double f = 0.0, slope = 0.0;
                for (int i = 0; i < 4; i++) {
                    f += w[0][i] * v[i][c];
                    slope += d[0][i] * v[i][c];
                }
                plane[0][c] += w[1][j] * f;
                plane[1][c] += w[1][j] * slope;
                plane[2][c] += d[1][j] * f;
            }
        }
        for (int c = 0; c < dim; c++) {
            x[c] += w[2][k] * plane[0][c];
            dx[0][c] += w[2][k] * plane[1][c];
            dx[1][c] += w[2][k] * plane[2][c];
            dx[2][c] += d[2][k] * plane[0][c];
        }
    }
}

/* Cubic through the four vertices around the cell along each index, one-sided at the last
 * layers. */
void mesh_map_point(const struct mesh_block *b, int dim, const int *cell, const double *xi,
                    double *x, double dx[3][3])
{
    double w[3][4] = {{1.0}, {1.0}, {1.0}}, d[3][4] = {{0.0}};
    int from[3] = {0, 0, 0};
    for (int a = 0; a < dim; a++) {
        const int least = b->v0[a], most = b->v0[a] + b->nv[a] - 4;
        from[a] = cell[a] - 1 < least ? least : cell[a] - 1 > most ? most : cell[a] - 1;
        cubic(xi[a] + cell[a] - 1 - from[a], w[a], d[a]);
    }
    memset(x, 0, 3 * sizeof(double));
    memset(dx, 0, 9 * sizeof(double));
    if (dim == 3)
        sum_up(b, 3, from, w, d, x, dx);
    else
        sum_up(b, 2, from, w, d, x, dx);
    if (dim == 2)
        dx[2][2] = 1.0;
}

double mesh_determinant(double d[3][3])
{
    return d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) -
           d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
           d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
}
