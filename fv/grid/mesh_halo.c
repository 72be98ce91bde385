/* mesh_halo.c - exchange of values between cells: copies for ghosts, interpolation for the fringe.
 * An exchange is made once from a list of requests (place here, rank and place there, weights or
 * none): requests are sorted by rank, and one all-to-all tells every rank what it has to send
 * (mesh_exchange_create). After that each use is one message to and from each peer (mesh_exchange),
 * fields interleaved. With weights the sender interpolates, so that only results travel.
 * SPDX-License-Identifier: BSD-3-Clause */

#include "mesh.h"

/* Number of weights of a value. */
static int stencil(const struct mesh *m, const struct mesh_exchange *x)
{
    return m->dim == 3 ? x->width * x->width * x->width : x->width * x->width;
}

/* Requests in the order of the ranks that give. in[] stays with this rank; out, weight and part go
 * to the ranks that send. */
static void sort_requests(struct mesh *m, struct mesh_exchange *x, int64_t n,
                          const struct mesh_request *request, int *count, int64_t *out,
                          double *weight, int *part)
{
    const int width = stencil(m, x);
    int64_t *at = NEW(int64_t, m->size + 1);
    for (int64_t k = 0; k < n; k++)
        count[request[k].rank]++;
    for (int q = 0; q < m->size; q++)
        at[q + 1] = at[q] + count[q];
    for (int64_t k = 0; k < n; k++) {
        const int64_t to = at[request[k].rank]++;
        x->in[to] = request[k].in;
        out[to] = request[k].out;
        part[to] = request[k].block;
        if (request[k].weight)
            memcpy(weight + to * width, request[k].weight, (size_t)width * sizeof(double));
    }
    mem_free(at);
}

/* Counts and offsets for MPI_Alltoallv, `times' numbers an entry. */
static void offsets(int size, const int *count, int times, int *scaled, int *offset)
{
    int sum = 0;
    for (int q = 0; q < size; q++) {
        scaled[q] = count[q] * times;
        offset[q] = sum;
        sum += scaled[q];
    }
}

/* Sends what is wanted to those who give it: of each entry `times' numbers. */
static void swap(const struct mesh *m, const int *wanted, const int *given, int times, void *from,
                 void *to, MPI_Datatype type)
{
    int *at = NEW(int, 4 * m->size);
    offsets(m->size, wanted, times, at, at + m->size);
    offsets(m->size, given, times, at + 2 * m->size, at + 3 * m->size);
    MPI_Alltoallv(from, at, at + m->size, type, to, at + 2 * m->size, at + 3 * m->size, type,
                  m->comm);
    mem_free(at);
}

/* in is ordered by peer as recv will be, out as send; both sides list the entries of a pair of
 * ranks in the same order, that of the one who wants. */
void mesh_exchange_create(void *owner, struct mesh *m, struct mesh_exchange *x, int width,
                          int64_t n, const struct mesh_request *request)
{
    int *wanted = NEW(int, m->size), *given = NEW(int, m->size);
    int64_t *out = NEW(int64_t, n), total = 0;
    int *part = NEW(int, n);
    x->width = width;
    const int w = stencil(m, x);
    double *weight = NEW(double, width > 1 ? n * w : 0);
    x->in = NEW_IN(owner, int64_t, n);
    sort_requests(m, x, n, request, wanted, out, weight, part);
    MPI_Alltoall(wanted, 1, MPI_INT, given, 1, MPI_INT, m->comm);
    for (int q = 0; q < m->size; q++) {
        total += given[q];
        x->npeers += wanted[q] > 0 || given[q] > 0;
    }
    x->out = NEW_IN(x->in, int64_t, total);
    x->part = NEW_IN(x->in, int, total);
    x->weight = width > 1 ? NEW_IN(x->in, double, total *w) : NULL;
    swap(m, wanted, given, 1, out, x->out, MPI_INT64_T);
    swap(m, wanted, given, 1, part, x->part, MPI_INT);
    for (int64_t k = 0; k < total; k++) /* of a block: of this rank's part */
        for (int p = 0, block = x->part[k]; p < m->nparts; p++)
            if (m->part[p].block == block)
                x->part[k] = p;
    if (width > 1)
        swap(m, wanted, given, w, weight, x->weight, MPI_DOUBLE);
    x->peer = NEW_IN(x->in, int, x->npeers);
    x->first_in = NEW_IN(x->in, int64_t, x->npeers + 1);
    x->first_out = NEW_IN(x->in, int64_t, x->npeers + 1);
    int k = 0;
    for (int q = 0; q < m->size; q++)
        if (wanted[q] > 0 || given[q] > 0) {
            x->peer[k] = q;
            x->first_in[k + 1] = x->first_in[k] + wanted[q];
            x->first_out[k + 1] = x->first_out[k] + given[q];
            k++;
        }
    FREE(wanted, given, out, part, weight);
}

void mesh_exchange_free(struct mesh_exchange *x)
{
    mem_free(x->in); /* owns the rest */
    *x = (struct mesh_exchange){0};
}

/* Sum of weights times values of a stencil, whose first cell q points to. */
static double interpolate(const struct part *p, int width, bool solid, const double *w,
                          const double *q)
{
    double sum = 0.0;
    for (int k = 0; k < (solid ? width : 1); k++)
        for (int j = 0; j < width; j++)
            for (int i = 0; i < width; i++)
                sum += *w++ * q[i + j * p->stride[1] + k * p->stride[2]];
    return sum;
}

/* What field c of nf gives, one behind the other for each place. Values of nf fields are
 * interleaved, value by value. */
static void gather(const struct mesh *m, const struct mesh_exchange *x, int nf, int c,
                   const double *restrict f, double *restrict send)
{
    const int64_t nout = x->first_out[x->npeers], *restrict out = x->out;
    if (x->width == 1)
        for (int64_t k = 0; k < nout; k++)
            send[nf * k + c] = f[out[k]];
    else
        for (int64_t k = 0; k < nout; k++)
            send[nf * k + c] = interpolate(m->part + x->part[k], x->width, m->dim == 3,
                                           x->weight + k * stencil(m, x), f + out[k]);
}

/* First pass all sends are made from the old values: a place that gives may also receive. Buffers
 * grow to the largest nf so far. keep protects some places from being overwritten when vectors (nf
 * > 1) are exchanged. */
void mesh_exchange_to(const struct mesh *m, struct mesh_exchange *x, int nf, double *const *f,
                      double *const *into)
{
    const int64_t nin = x->first_in[x->npeers], nout = x->first_out[x->npeers];
    MPI_Request *requests = NEW(MPI_Request, 2 * x->npeers);
    int n = 0;
    if (x->room < nf) {
        GROW_IN(x->in, x->send, 0, nout * nf);
        GROW_IN(x->in, x->recv, 0, nin * nf);
        x->room = nf;
    }
    for (int q = 0; q < x->npeers; q++)
        if (x->peer[q] != m->rank && x->first_in[q + 1] > x->first_in[q])
            MPI_Irecv(x->recv + nf * x->first_in[q],
                      (int)(nf * (x->first_in[q + 1] - x->first_in[q])), MPI_DOUBLE, x->peer[q], 0,
                      m->comm, requests + n++);
    for (int c = 0; c < nf; c++)
        gather(m, x, nf, c, f[c], x->send);
    for (int q = 0; q < x->npeers; q++) {
        const int64_t count = x->first_out[q + 1] - x->first_out[q];
        if (x->peer[q] == m->rank)
            memcpy(x->recv + nf * x->first_in[q], x->send + nf * x->first_out[q],
                   (size_t)(nf * count) * sizeof(double));
        else if (count > 0)
            MPI_Isend(x->send + nf * x->first_out[q], (int)(nf * count), MPI_DOUBLE, x->peer[q], 0,
                      m->comm, requests + n++);
    }
    MPI_Waitall(n, requests, MPI_STATUSES_IGNORE);
    for (int c = 0; c < nf; c++) {
        double *restrict to = into[c];
        const unsigned char *keep = nf > 1 ? x->keep : NULL;
        for (int64_t k = 0; k < nin; k++)
            if (!keep || !keep[x->in[k]])
                to[x->in[k]] = x->recv[nf * k + c];
    }
    mem_free(requests);
}

void mesh_exchange(const struct mesh *m, struct mesh_exchange *x, int nf, double *const *f)
{
    mesh_exchange_to(m, x, nf, f, f);
}

/* Whether i is a cell of the part, not a ghost. */
/* Requests of all ghosts of this rank that are cells elsewhere, or on this rank itself. */
void mesh_halo_create(struct mesh *m)
{
    struct mesh_request *request = NEW(struct mesh_request, m->size_local);
    int64_t n = 0;
    for (int q = 0; q < m->nparts; q++) {
        const struct part *p = m->part + q;
        int i[3];
        PART_ALL (p, i, c) {
            int at[3] = {p->lo[0] + i[0], p->lo[1] + i[1], p->lo[2] + i[2]}, k = p->block;
            double move[3] = {0.0, 0.0, 0.0};
            if (part_has(p, i) || !mesh_resolve(m, &k, at, move))
                continue;
            struct mesh_request *r = request + n++;
            *r = (struct mesh_request){.in = c};
            mesh_owner(m, k, at, &r->rank, &r->out);
        }
    }
    mesh_exchange_create(m, m, &m->halo, 1, n, request);
    mem_free(request);
}

void mesh_halo(struct mesh *m, int nf, double *const *f) { mesh_exchange(m, &m->halo, nf, f); }

/* The halo first, for interpolation reads ghosts; and again, for ghosts are copies of fringe cells,
 * too. */
void mesh_fill(struct mesh *m, int nf, double *const *f)
{
    mesh_exchange(m, &m->halo, nf, f);
    if (!m->has_fringe)
        return;
    mesh_exchange(m, &m->fringe, nf, f);
    mesh_exchange(m, &m->halo, nf, f);
}
