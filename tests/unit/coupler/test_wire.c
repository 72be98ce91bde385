/* test_wire.c - messages arrive whole and in order, broken ones are found, waiting is cheap, and
 * programs find each other by name wherever they stand. ranks: 1 4.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include <time.h>

#include "../../../coupler/cpl.h"
#include "../../../coupler/transport/failure.h"
#include "../../../coupler/transport/handshake.h"
#include "../../../coupler/transport/wire.h"

static jmp_buf back;
static void jump(const char *what)
{
    (void)what;
    longjmp(back, 1);
}

static struct message *await(struct wire *w)
{
    struct message *m;
    struct backoff backoff;
    backoff_begin(&backoff);
    while (!(m = wire_poll(w, -1)))
        backoff_sleep(&backoff);
    return m;
}

static struct wire to_myself(void)
{
    struct wire w = {.broken = jump};
    MPI_Comm self;
    MPI_Comm_dup(MPI_COMM_SELF, &self);
    wire_add_peer(&w, self, 1, "myself");
    return w;
}

TEST(what_is_packed_is_taken)
{
    struct wire w = to_myself();
    struct pack p;
    char text[6];
    pack_begin(&p, WIRE_PUT, 3, 1LL << 40);
    pack_head(&p)->t = 0.1;
    pack_int(&p, -5);
    pack_text(&p, "velocity");
    pack_real(&p, 1e-300);
    pack_text(&p, "");
    wire_send(&w, 0, 0, &p);
    struct message *m = await(&w);
    assert_int_equal(m->head.kind, WIRE_PUT);
    assert_int_equal(m->head.field, 3);
    assert_true(m->head.tick == 1LL << 40 && m->head.t == 0.1);
    assert_int_equal(take_int(&w, m), -5);
    take_text(&w, m, text, sizeof text);
    assert_string_equal(text, "veloc"); /* cut, never overrun */
    assert_true(take_real(&w, m) == 1e-300);
    take_text(&w, m, text, sizeof text);
    assert_string_equal(text, "");
    message_free(&m);
    assert_true(wire_flushed(&w));
}

/* Messages above 1 GiB travel in pieces; here in pieces of 1000 bytes, between others. */
TEST(long_messages_arrive_in_pieces)
{
    struct wire w = to_myself();
    struct pack p;
    w.piece = 1000;
    const size_t length[] = {0, 999, 1000, 1001, 123456, 8, 2000, 40000};
    for (size_t k = 0; k < sizeof length / sizeof *length; k++) {
        pack_begin(&p, WIRE_PUT, (int)k, 0);
        unsigned char *to = pack_room(&p, length[k]);
        for (size_t i = 0; i < length[k]; i++)
            to[i] = (unsigned char)(i * 7 + k);
        wire_send(&w, 0, 0, &p);
    }
    for (size_t k = 0; k < sizeof length / sizeof *length; k++) {
        struct message *m = await(&w);
        assert_int_equal(m->head.field, k);
        assert_int_equal(m->head.bytes, length[k]);
        for (size_t i = 0; i < length[k]; i++)
            assert_int_equal(m->body[i], (unsigned char)(i * 7 + k));
        message_free(&m);
    }
    (void)wire_flushed(&w); /* the pieces, then the memory that they shared */
    assert_true(wire_flushed(&w));
}

TEST(a_message_shorter_than_it_says_is_found)
{
    static struct wire w;
    static struct message *m;
    struct pack p;
    w = to_myself();
    pack_begin(&p, WIRE_PUT, 0, 0);
    pack_int(&p, 1000); /* length of a text that is not there */
    wire_send(&w, 0, 0, &p);
    m = await(&w);
    if (setjmp(back) == 0) {
        char text[8];
        take_text(&w, m, text, sizeof text);
        fail_msg("read past the end");
    }
    message_free(&m);
}

TEST(a_foreign_message_is_found)
{
    static struct wire w;
    struct pack p;
    w = to_myself();
    pack_begin(&p, WIRE_PUT, 0, 0);
    pack_head(&p)->version++;
    wire_send(&w, 0, 0, &p);
    if (setjmp(back) == 0) {
        (void)await(&w);
        fail_msg("took a message of another version");
    }
}

TEST(waiting_leaves_the_processor_alone)
{
    struct wire w = to_myself();
    struct backoff backoff;
    const clock_t before = clock();
    backoff_begin(&backoff);
    while (wire_time() - backoff.since < 1.0) {
        assert_null(wire_poll(&w, -1));
        backoff_sleep(&backoff);
    }
    const double cpu = (double)(clock() - before) / CLOCKS_PER_SEC;
    printf("waiting takes %.1f %% of a core\n", 100.0 * cpu);
    assert_true(cpu < 0.15); /* 0.05 on a quiet machine */
}

/* Names in an order that is neither that of ranks nor of the alphabet. */
TEST(programs_find_each_other_by_name)
{
    static const char *const names[] = {"zeta", "coupler", "alpha", "coupler"};
    int rank, size;
    struct handshake h;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    assert_int_equal(handshake(MPI_COMM_WORLD, names[rank % 4], 10.0, CPL_VERSION, &h), 0);
    failure_closed();
    assert_int_equal(h.nprograms, size == 1 ? 1 : 3);
    if (size == 1)
        return;
    assert_string_equal(h.program[0].name, "alpha");
    assert_string_equal(h.program[2].name, "zeta");
    assert_int_equal(h.coupler, 1);
    assert_int_equal(h.program[1].size, 2);
    assert_int_equal(h.program[1].leader, 1);

    /* a hundred numbered messages and a large one from each solver to each coupler rank, and back
     */
    enum { MANY = 100, LARGE = 10000000 };
    struct wire w = {.broken = jump};
    struct pack p;
    const int partners[2] = {h.me == 1 ? 0 : 1, h.me == 1 ? 2 : -1};
    for (int i = 0; i < 2 && partners[i] >= 0; i++)
        wire_add_peer(&w, h.program[partners[i]].inter, h.program[partners[i]].size, "partner");
    for (int i = 0; i < w.npeers; i++)
        for (int k = 0; k <= MANY; k++) {
            pack_begin(&p, WIRE_PUT, k, rank);
            if (k == MANY)
                memset(pack_room(&p, LARGE), 'a' + rank, LARGE);
            wire_send_all(&w, i, &p);
        }
    int next[2][2] = {{0}};
    int left = (MANY + 1) * (h.me == 1 ? 2 : h.program[1].size);
    for (; left > 0; left--) {
        struct message *m = await(&w);
        assert_int_equal(m->head.field, next[m->peer][m->rank]++);
        if (m->head.field == MANY) {
            const unsigned char *last = m->body + LARGE - 1;
            assert_int_equal(m->head.bytes, LARGE);
            assert_int_equal(*last, 'a' + (int)m->head.tick);
        }
        message_free(&m);
    }
    while (!wire_flushed(&w))
        continue;
    MPI_Barrier(MPI_COMM_WORLD);
}
