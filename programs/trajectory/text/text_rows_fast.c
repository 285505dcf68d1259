/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rows straight from the reader's buffer into the arrays of a frame. A row with anything unusual (a new name, a number
 * in another form, a missing column) is left alone: text_rows.c reads it, finds the error or the doubt, and tells the
 * line. With several threads the lines are cut into parts; the rows of each are counted, which tells where they go, and
 * read. Names are only looked up, so that the order of the rows, which numbers them, is that of one thread. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/text/text_rows.h"
#include "trajectory/text/text_scan.h"

#include <pthread.h>
#include <stdatomic.h>
#include <string.h>

#define PART_BYTES ((size_t)1 << 19) /* text for a thread: starting one takes some 50 us, reading this 1 ms */
#define MOST_THREADS 64
#define THREAD_PARTS 4 /* of a thread: those that are left are taken by the fastest */
#define MOST_PARTS (MOST_THREADS * THREAD_PARTS)

typedef struct fast_part {
    const cgt_trajectory *t;
    const row_plan *plan;
    trajectory_store *store;
    const char *begin, *end; /* whole lines */
    size_t rows;             /* to read at most */
    size_t at;               /* index of the first */
    size_t done;             /* read */
    int has_element;
    uint32_t last; /* index of the name found last, 0: none */
} fast_part;

int rows_can_be_fast(const cgt_trajectory *t, const row_plan *plan)
{
    return !t->columns.has_words && !(plan->roles & ROW_BIT(ROW_NUMBER));
}

/* ---- A row -------------------------------------------------------------------------------------------------- */

static int is_end(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

static const char *skip_word(const char *p)
{
    while (!is_end(*p))
        p++;
    return p;
}

/* What a name stands for: one that is known or, where the plan says so, a type by its number. */
static const char *scan_name(fast_part *f, const char *p, row *r)
{
    const row_plan *const plan = f->plan;
    const char *const after = skip_word(p);
    const text_span name = {p, after};
    uint32_t type = 0;
    const float radius = r->value[ROW_RADIUS];
    if (plan->names == NULL || after == p)
        return NULL;
    if (plan->names_may_be_types && *p >= '0' && *p <= '9') {
        if (scan_whole(p, &type) != after)
            return NULL;
    } else {
        type =
            f->last > 0 && text_is(name, plan->names->name[f->last - 1]) ? f->last : name_table_peek(plan->names, name);
        if (type == 0)
            return NULL;
        f->last = type;
        r->element = plan->names->element[type - 1];
        r->value[ROW_RADIUS] = plan->names->radius[type - 1];
    }
    if (plan->roles & ROW_BIT(ROW_TYPE))
        type = r->type;
    r->type = type;
    /* a radius of the row's own, or of the options, counts more */
    if (f->t->options.radius > 0.0f || (plan->roles & (ROW_BIT(ROW_RADIUS) | ROW_BIT(ROW_DIAMETER))))
        r->value[ROW_RADIUS] = radius;
    return after;
}

static inline const char *scan_place(const cgt_trajectory *t, size_t axis, const char *p, float *place)
{
    double value;
    if (t->origin[axis] == 0.0)
        return scan_float(p, place);
    p = scan_double(p, &value);
    *place = p != NULL ? trajectory_place(t, axis, value) : 0.0f;
    return p;
}

/* Reads a value by its role. Returns what follows it, or NULL. is_plain, a constant: as has_plain_columns. */
static inline __attribute__((always_inline)) const char *scan_value(fast_part *f, row_role role, const char *p, row *r,
                                                                    int is_plain)
{
    float number;
    switch (role) {
    case ROW_UNUSED: return is_end(*p) ? NULL : skip_word(p);
    case ROW_ID: return scan_whole(p, &r->id);
    case ROW_TYPE: return scan_whole(p, &r->type);
    case ROW_NAME: return scan_name(f, p, r);
    case ROW_NUMBER: return NULL;
    case ROW_DIAMETER:
        p = scan_float(p, &number);
        if (p != NULL && !(f->plan->roles & ROW_BIT(ROW_RADIUS)))
            r->value[ROW_RADIUS] = 0.5f * number;
        return p;
    case ROW_X:
    case ROW_Y:
    case ROW_Z:
        if (is_plain)
            break;
        if (f->plan->scaled & (1u << (role - ROW_X)))
            return scan_double(p, &r->fraction[role - ROW_X]);
        return scan_place(f->t, role - ROW_X, p, &r->value[role]);
    case ROW_RADIUS:
    case ROW_VX:
    case ROW_VY:
    case ROW_VZ: break;
    }
    return scan_float(p, &r->value[role]);
}

/* Reads row i. Returns the start of the next line, or NULL: the row is not of a usual form. is_plain: as above. */
static inline __attribute__((always_inline)) const char *scan_row(fast_part *f, const char *p, size_t i, row *r,
                                                                  int is_plain)
{
    const row_plan *const plan = f->plan;
    float value;
    for (uint32_t column = 0; column < plan->columns; column++) {
        while (*p == ' ' || *p == '\t')
            p++;
        const char *const after = scan_value(f, (row_role)plan->role[column], p, r, is_plain);
        if (after == NULL || !is_end(*after))
            return NULL;
        if (!is_plain && plan->slot[column] != 0) {
            if (scan_float(p, &value) != after)
                return NULL;
            columns_values(f->t, plan->slot[column])[i] = value;
        }
        p = after;
    }
    if (plan->open_ended) {
        p = memchr(p, '\n', (size_t)(f->end - p));
        return p + 1; /* lines are whole */
    }
    while (*p == ' ' || *p == '\t')
        p++;
    p += p[0] == '\r' && p[1] == '\n';
    return *p == '\n' ? p + 1 : NULL;
}

/* Most rows: what columns say goes into the fields of a row alone, as it is. */
static int has_plain_columns(const fast_part *f)
{
    int is_plain = f->plan->scaled == 0 && !f->t->has_origin;
    for (uint32_t column = 0; column < f->plan->columns; column++)
        is_plain &= f->plan->slot[column] == 0;
    return is_plain;
}

/* Reads rows up to one of another form. */
static void read_part(fast_part *f)
{
    const row_plan *const plan = f->plan;
    const float radius = trajectory_default_radius(f->t);
    const char *p = f->begin;
    const int is_plain = has_plain_columns(f);
    row r;
    memset(&r, 0, sizeof r);
    while (f->done < f->rows && p < f->end) {
        const size_t i = f->at + f->done;
        r.element = 0;
        r.value[ROW_RADIUS] = radius;
        const char *const next = is_plain ? scan_row(f, p, i, &r, 1) : scan_row(f, p, i, &r, 0);
        if (next == NULL)
            break;
        if (plan->place != NULL)
            plan->place(f->t, &r);
        row_store(f->store, i, plan->roles, &r);
        f->has_element |= r.element != 0;
        f->done++;
        p = next;
    }
    f->begin = p;
}

/* ---- Threads ------------------------------------------------------------------------------------------------ */

/* By blocks whose counts fit a byte: compilers make vectors of that. */
static void count_part(fast_part *f)
{
    enum { BLOCK = 240 };
    size_t rows = 0;
    for (const char *p = f->begin; p < f->end;) {
        const size_t left = (size_t)(f->end - p), block = left < BLOCK ? left : BLOCK;
        uint8_t feeds = 0;
        for (size_t i = 0; i < block; i++)
            feeds = (uint8_t)(feeds + (p[i] == '\n'));
        rows += feeds;
        p += block;
    }
    f->rows = rows;
}

/* Parts of one text. Each thread takes the next part that is left, since not all are as fast. */
typedef struct row_team {
    void (*run)(fast_part *part);
    atomic_size_t next;
    size_t parts;
    fast_part part[MOST_PARTS];
} row_team;

/* On copies: parts lie side by side, and threads that count rows in one cache line would wait for each other. */
static void *run_parts(void *user)
{
    row_team *const team = user;
    for (size_t i; (i = atomic_fetch_add(&team->next, 1)) < team->parts;) {
        fast_part own = team->part[i];
        team->run(&own);
        team->part[i] = own;
    }
    return NULL;
}

/* Runs each part, on as many threads as can be started. */
static void run_team(row_team *team, void (*run)(fast_part *part), size_t threads)
{
    pthread_t thread[MOST_THREADS];
    size_t running = 0;
    team->run = run;
    atomic_store(&team->next, 0);
    while (running + 1 < threads && pthread_create(&thread[running], NULL, run_parts, team) == 0)
        running++;
    run_parts(team);
    for (size_t i = 0; i < running; i++)
        pthread_join(thread[i], NULL);
}

/* Cuts the lines into parts and reads them. Returns how many rows were read up to the first of another form. */
static int64_t read_parts(cgt_trajectory *t, row_plan *plan, text_span lines, uint32_t done, uint32_t count,
                          size_t threads)
{
    row_team team = {.parts = 0};
    fast_part *const part = team.part;
    const char *begin = lines.begin;
    const size_t most = threads * THREAD_PARTS;
    for (size_t i = 0; i < most && begin < lines.end; i++) {
        const size_t left = (size_t)(lines.end - begin), share = left / (most - i);
        const char *end = i + 1 < most ? memchr(begin + share, '\n', left - share) : NULL;
        end = end != NULL ? end + 1 : lines.end;
        part[team.parts++] = (fast_part){.t = t, .plan = plan, .store = &t->store, .begin = begin, .end = end};
        begin = end;
    }
    run_team(&team, count_part, threads);
    size_t at = done;
    for (size_t i = 0; i < team.parts; i++) {
        part[i].at = at;
        part[i].rows = part[i].rows < count - at ? part[i].rows : count - at;
        at += part[i].rows;
    }
    if (trajectory_reserve(t, at, count) < 0)
        return -1;
    run_team(&team, read_part, threads);
    int64_t rows = 0;
    for (size_t i = 0; i < team.parts && part[i].rows > 0; i++) { /* without rows: beyond the frame */
        rows += (int64_t)part[i].done;
        plan->has_element |= part[i].has_element;
        t->text.begin += (size_t)(part[i].begin - (t->text.data + t->text.begin));
        if (part[i].done < part[i].rows) {
            /* What later parts have read is read again, by one thread: otherwise a file with many such rows would be
             * read once for each. */
            plan->serial = (uint32_t)(at - done);
            break;
        }
    }
    return rows;
}

/* Leaves away lines that are likely beyond the frame's rows, which would leave threads without work: by the length of
 * the first rows, and a quarter more. */
static void cut_lines(text_span *lines, uint32_t rows)
{
    const size_t bytes = text_length(*lines), look = bytes < 4096 ? bytes : 4096;
    const char *const end = lines->begin + look;
    const char *p = lines->begin;
    size_t feeds = 0;
    for (const char *feed; p < end && (feed = memchr(p, '\n', (size_t)(end - p))) != NULL; feeds++)
        p = feed + 1;
    const uint64_t likely = feeds > 0 ? (uint64_t)rows * (uint64_t)(p - lines->begin) / feeds * 5 / 4 : bytes;
    if (likely < bytes)
        lines->end = (const char *)memchr(lines->begin + likely, '\n', bytes - (size_t)likely) + 1;
}

int64_t rows_read_fast(cgt_trajectory *t, row_plan *plan, uint32_t done, uint32_t count)
{
    text_span lines;
    const char *reason = "";
    /* each column takes two bytes at least */
    const uint64_t least = 2 * (uint64_t)plan->columns * (count - done);
    const int limit = t->options.threads < MOST_THREADS ? t->options.threads : MOST_THREADS;
    const int most = plan->serial > 0 ? 1 : limit;
    const size_t wanted = most > 1 && least > PART_BYTES ? (size_t)most * 2 * PART_BYTES : 0;
    if (text_reader_lines(&t->text, least, wanted, &lines, &reason) < 0)
        return trajectory_fail(t, t->text.line, "%s", reason);
    if (most > 1)
        cut_lines(&lines, count - done);
    const size_t bytes = text_length(lines);
    const size_t parts = (bytes + PART_BYTES / 2) / PART_BYTES; /* rounded: the last line is cut */
    const size_t threads = parts < (size_t)most ? parts : (size_t)most;
    if (bytes == 0 || plan->columns == 0)
        return 0;
    int64_t rows;
    if (threads > 1) {
        rows = read_parts(t, plan, lines, done, count, threads);
    } else {
        const size_t possible = bytes / (2 * (size_t)plan->columns), left = count - done;
        fast_part part = {.t = t, .plan = plan, .store = &t->store, .begin = lines.begin, .end = lines.end, .at = done};
        part.rows = possible < left ? possible : left;
        if (trajectory_reserve(t, done + part.rows, count) < 0)
            return -1;
        read_part(&part);
        rows = (int64_t)part.done;
        plan->has_element |= part.has_element;
        t->text.begin += (size_t)(part.begin - lines.begin);
    }
    if (rows > 0) {
        t->text.line += (uint64_t)rows;
        t->text.has_feed = 1;
        t->text.is_open = 0;
    }
    return rows;
}
