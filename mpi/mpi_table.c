/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * From the ranks' arrays to tables on every machine, in rounds: the ranks of each machine write records, number and
 * columns, into their shared memory; leaders hand them to each other; and the ranks put what has come where its number
 * says. So what a machine needs beside the table does not depend on how much there is, and a record goes through each
 * network card once. */
#include <string.h>

#include "mpi_job.h"

enum { NUMBER = sizeof(uint32_t) };

/* The exchange of a table. */
typedef struct mpi_exchange {
    cgt_mpi *mpi;
    mpi_table *table;
    const mpi_source *source;
    size_t record;      /* bytes */
    uint64_t first;     /* of this rank's elements, among those of its machine */
    uint64_t *elements; /* of each leader's machine */
    uint64_t most;      /* of them */
    uint32_t capacity;  /* records of a machine in a round */
    char *out, *in;
    bool twice; /* a number has come twice: this one */
    uint32_t number;
} mpi_exchange;

/* This rank's part of what its machine's ranks share: from *first up to *end. */
static void share_of(const cgt_mpi *m, uint64_t count, uint64_t *first, uint64_t *end)
{
    *first = count * (uint64_t)m->local / (uint64_t)m->locals;
    *end = count * ((uint64_t)m->local + 1) / (uint64_t)m->locals;
}

static size_t align(size_t bytes) { return (bytes + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT; }

/* ---- The table ----------------------------------------------------------------------------------------------- */

static cgt_result make_table(cgt_mpi *m, uint32_t geometry, mpi_table *t, const mpi_source *s, uint32_t slots)
{
    size_t bytes = 0, first[MOST_COLUMNS] = {0};
    uint64_t from, to;
    cgt_mpi_set_columns(s, t);
    for (uint32_t k = 0; k < t->columns; k++) {
        first[k] = bytes;
        bytes += align(t->bytes[k] * slots);
    }
    const size_t words = s->parts & PART_IDS && !s->vertices ? (size_t)slots / 32 + 1 : 0;
    cgt_result result = cgt_mpi_memory_reserve(m, &t->memory, bytes + words * sizeof(uint32_t));
    if (result != CGT_OK)
        return cgt_mpi_fail(m, result, "geometry %u, %u numbers: %zu bytes of shared memory were refused", geometry,
                            slots, bytes);
    t->slots = slots;
    for (uint32_t k = 0; k < t->columns; k++)
        t->column[k] = t->memory.base + first[k];
    t->taken = words ? (_Atomic uint32_t *)(void *)(t->memory.base + bytes) : NULL;
    share_of(m, words, &from, &to);
    for (uint64_t i = from; i < to; i++)
        atomic_store_explicit(&t->taken[i], 0, memory_order_relaxed);
    return CGT_OK;
}

static bool is_taken(const mpi_table *t, uint64_t i)
{
    return atomic_load_explicit(&t->taken[i / 32], memory_order_relaxed) >> i % 32 & 1;
}

/* Numbers that nobody has given: what looks have for them must be in range, too. */
static void fill_holes(const cgt_mpi *m, const mpi_table *t, int hole)
{
    uint64_t from, to;
    share_of(m, t->slots, &from, &to);
    for (uint64_t i = from; i < to && t->taken; i++)
        for (uint32_t k = 0; k < t->columns && !is_taken(t, i); k++)
            memset(t->column[k] + i * t->bytes[k], k ? 0 : hole, t->bytes[k]);
}

/* ---- Rounds -------------------------------------------------------------------------------------------------- */

static uint32_t records_in(const mpi_exchange *e, int leader, uint64_t round)
{
    const uint64_t done = round * e->capacity, all = e->elements[leader];
    return all <= done ? 0 : all - done < e->capacity ? (uint32_t)(all - done) : e->capacity;
}

static void pack_round(const mpi_exchange *e, uint64_t round)
{
    const mpi_source *const s = e->source;
    const uint64_t begin = round * e->capacity, end = begin + e->capacity;
    const uint64_t from = begin > e->first ? begin : e->first;
    const uint64_t last = e->first + s->count, to = end < last ? end : last;
    for (uint64_t i = from; i < to; i++) {
        char *const record = e->out + (i - begin) * e->record;
        const uint32_t mine = (uint32_t)(i - e->first), number = s->ids ? s->ids[mine] : s->first + mine;
        memcpy(record, &number, NUMBER);
        cgt_mpi_pack(s, mine, record + NUMBER);
    }
}

/* Leaders hand each other their machines' records. */
static void exchange_round(const mpi_exchange *e, uint64_t round)
{
    const cgt_mpi *const m = e->mpi;
    for (int k = 0; k < m->leader_count; k++) {
        m->bytes[k] = (int)(records_in(e, k, round) * e->record);
        m->places[k] = (int)((size_t)k * e->capacity * e->record);
    }
    MPI_Allgatherv(e->out, m->bytes[m->leader], MPI_BYTE, e->in, m->bytes, m->places, MPI_BYTE, m->leaders);
}

static void put(mpi_exchange *e, const char *record)
{
    const mpi_table *const t = e->table;
    uint32_t number;
    memcpy(&number, record, NUMBER);
    record += NUMBER;
    if (t->taken) {
        const uint32_t bit = 1u << number % 32;
        if (atomic_fetch_or_explicit(&t->taken[number / 32], bit, memory_order_relaxed) & bit) {
            e->twice = true;
            e->number = number;
            return;
        }
    }
    for (uint32_t k = 0; k < t->columns; k++) {
        memcpy(t->column[k] + number * t->bytes[k], record, t->bytes[k]);
        record += t->bytes[k];
    }
}

static void unpack_round(mpi_exchange *e, uint64_t round)
{
    const cgt_mpi *const m = e->mpi;
    for (int k = 0; k < m->leader_count; k++) {
        uint64_t from, to;
        share_of(m, records_in(e, k, round), &from, &to);
        for (uint64_t i = from; i < to; i++)
            put(e, e->in + ((size_t)k * e->capacity + i) * e->record);
    }
}

/* How many elements each machine has, on all ranks. */
static void count_elements(mpi_exchange *e)
{
    const cgt_mpi *const m = e->mpi;
    const uint64_t mine = e->source->count;
    uint64_t all = 0;
    e->first = 0;
    MPI_Exscan(&mine, &e->first, 1, MPI_UINT64_T, MPI_SUM, m->machine);
    MPI_Allreduce(&mine, &all, 1, MPI_UINT64_T, MPI_SUM, m->machine);
    if (m->leaders != MPI_COMM_NULL)
        MPI_Allgather(&all, 1, MPI_UINT64_T, e->elements, 1, MPI_UINT64_T, m->leaders);
    MPI_Bcast(e->elements, m->leader_count, MPI_UINT64_T, 0, m->machine);
    if (m->local == 0)
        e->first = 0; /* which MPI_Exscan leaves undefined */
    e->most = 0;
    for (int k = 0; k < m->leader_count; k++)
        e->most = e->elements[k] > e->most ? e->elements[k] : e->most;
}

/* Memory for a round: of a machine's own records, and of those of all. One machine needs no second copy. */
static cgt_result make_exchange(mpi_exchange *e)
{
    cgt_mpi *const m = e->mpi;
    const size_t leaders = (size_t)m->leader_count;
    e->record = NUMBER;
    for (uint32_t k = 0; k < e->table->columns; k++)
        e->record += e->table->bytes[k];
    const size_t fit = m->exchange_bytes / leaders / e->record;
    const uint64_t capacity = fit < e->most ? fit : e->most;
    e->capacity = capacity ? (uint32_t)capacity : 1;
    const size_t out = align(e->capacity * e->record), in = leaders > 1 ? leaders * e->capacity * e->record : 0;
    const cgt_result result = cgt_mpi_memory_reserve(m, &m->exchange, out + in);
    e->out = m->exchange.base;
    e->in = leaders > 1 ? e->out + out : e->out;
    return result;
}

static cgt_result tell_twice(const mpi_exchange *e, uint32_t geometry)
{
    return e->twice ? cgt_mpi_fail(e->mpi, CGT_ERROR_INVALID_ARGUMENT, "geometry %u: two primitives have the id %u",
                                   geometry, e->number)
                    : CGT_OK;
}

cgt_result cgt_mpi_table_gather(cgt_mpi *m, uint32_t geometry, mpi_table *t, const mpi_source *s, uint32_t slots,
                                int hole)
{
    mpi_exchange e = {.mpi = m, .table = t, .source = s, .elements = m->elements};
    cgt_result result = make_table(m, geometry, t, s, slots);
    count_elements(&e);
    if (result == CGT_OK)
        result = make_exchange(&e);
    result = cgt_mpi_agree(m, result);
    if (result != CGT_OK)
        return result;
    for (uint64_t round = 0; round * e.capacity < e.most; round++) {
        pack_round(&e, round);
        cgt_mpi_memory_fence(m);
        if (m->leader_count > 1 && m->leaders != MPI_COMM_NULL)
            exchange_round(&e, round);
        if (m->leader_count > 1)
            cgt_mpi_memory_fence(m);
        unpack_round(&e, round);
        if (m->leader_count == 1) /* the next round writes what this one has read */
            cgt_mpi_memory_fence(m);
    }
    cgt_mpi_memory_fence(m);
    fill_holes(m, t, hole);
    return cgt_mpi_agree(m, tell_twice(&e, geometry));
}
