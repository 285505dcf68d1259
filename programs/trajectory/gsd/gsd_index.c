/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Names and index of a GSD file. */
#define _FILE_OFFSET_BITS 64
#define _POSIX_C_SOURCE 200809L
#include "trajectory/gsd/gsd_index.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#define MAGIC UINT64_C(0x65DF65DF65DF65DF)
#define HEADER_BYTES 256u
#define ENTRY_BYTES 32u
#define MOST_NAMES 65536u /* an entry has 16 bits for its name */
#define MOST_TYPE 11      /* 1 to 4 unsigned, 5 to 8 signed, 9 float, 10 double, 11 characters */
#define NO_NAME UINT32_MAX

static const char *const known_names[GSD_KNOWN] = {
    [GSD_STEP] = "configuration/step",     [GSD_BOX] = "configuration/box",        [GSD_COUNT] = "particles/N",
    [GSD_POSITION] = "particles/position", [GSD_TYPES] = "particles/types",        [GSD_BONDS] = "bonds/N",
    [GSD_BOND_PAIRS] = "bonds/group",      [GSD_SHAPES] = "particles/type_shapes",
};

const char gsd_chunk[] = "an array of a frame";

size_t gsd_size_of(int type)
{
    static const size_t sizes[MOST_TYPE] = {1, 2, 4, 8, 1, 2, 4, 8, 4, 8, 1};
    return type >= 1 && type <= MOST_TYPE ? sizes[type - 1] : 1;
}

double gsd_value_of(int type, const unsigned char *bytes)
{
    if (type == 9)
        return (double)binary_get_f32(bytes, 0);
    if (type == 10)
        return binary_get_f64(bytes, 0);
    const size_t size = gsd_size_of(type);
    const int is_negative = type >= 5 && type <= 8 && bytes[size - 1] > 127;
    uint64_t bits = is_negative ? UINT64_MAX : 0;
    for (size_t i = size; i-- > 0;)
        bits = bits << 8 | bytes[i];
    return is_negative ? -(double)(~bits + 1) : (double)bits;
}

static int seek(cgt_trajectory *t, uint64_t place)
{
    gsd_index *const s = t->state;
    if (fseeko(t->file, (off_t)place, SEEK_SET) != 0)
        return trajectory_fail(t, 0, "%s", strerror(errno));
    s->in.read = place;
    return 1;
}

/* Reads a block that the header tells of. */
static int read_block(cgt_trajectory *t, uint64_t place, uint64_t count, uint64_t bytes, unsigned char **block,
                      size_t *capacity)
{
    gsd_index *const s = t->state;
    if (place > t->file_size || count > (t->file_size - place) / bytes)
        return trajectory_fail(t, 0, "the index or the names lie beyond the end of the file: it is cut off");
    return seek(t, place) < 0 ? -1 : binary_blob(&s->in, block, capacity, (size_t)(count * bytes), "the index");
}

static gsd_entry entry_at(const gsd_index *s, uint64_t i)
{
    const unsigned char *const b = s->index + ENTRY_BYTES * i;
    return (gsd_entry){.frame = binary_get_u64(b, 0),
                       .rows = binary_get_u64(b + 8, 0),
                       .place = binary_get_u64(b + 16, 0),
                       .columns = binary_get_u32(b + 24, 0),
                       .name = (uint32_t)b[28] | (uint32_t)b[29] << 8,
                       .type = b[30]};
}

/* Looks what a name is for; of equal names the first counts. */
static void note_name(gsd_index *s, uint32_t number)
{
    const char *const name = s->name[number];
    for (int k = 0; k < GSD_KNOWN; k++)
        if (s->known[k] == NO_NAME && strcmp(name, known_names[k]) == 0)
            s->known[k] = number;
    if (strncmp(name + (strncmp(name, "log/", 4) == 0 ? 4 : 0), "particles/", 10) == 0)
        s->particle[s->particles++] = number;
}

/* Whether a name begins at byte i: they follow each other, each with a zero behind it. */
static int begins_name(const unsigned char *bytes, size_t i)
{
    return bytes[i] != '\0' && (i == 0 || bytes[i - 1] == '\0');
}

static int reserve_names(cgt_trajectory *t, uint32_t count)
{
    gsd_index *const s = t->state;
    if (trajectory_grow(&s->name, count + 1, sizeof *s->name) ||
        trajectory_grow(&s->particle, count + 1, sizeof *s->particle) ||
        trajectory_grow(&s->first, count + 1, sizeof *s->first) ||
        trajectory_grow(&s->here, count + 1, sizeof *s->here))
        return trajectory_fail(t, 0, "not enough memory for the names");
    memset(s->first, 0, (count + 1) * sizeof *s->first);
    memset(s->here, 0, (count + 1) * sizeof *s->here);
    return 1;
}

/* In version 1 there are as many names as fill 64 bytes. */
static int list_names(cgt_trajectory *t, size_t size)
{
    gsd_index *const s = t->state;
    uint32_t count = 0;
    if (size > 0 && s->name_bytes[size - 1] != '\0')
        return trajectory_fail(t, 0, "a name of an array without end");
    for (size_t i = 0; i < size && count < MOST_NAMES; i++)
        count += (uint32_t)begins_name(s->name_bytes, i);
    if (reserve_names(t, count) < 0)
        return -1;
    for (int k = 0; k < GSD_KNOWN; k++)
        s->known[k] = NO_NAME;
    s->names = s->particles = 0;
    for (size_t i = 0; i < size && s->names < count; i++) {
        if (begins_name(s->name_bytes, i)) {
            s->name[s->names] = (const char *)s->name_bytes + i;
            note_name(s, s->names++);
        }
    }
    return 1;
}

/* Counts entries, which are in the order of frames, and frames. */
static int check_index(cgt_trajectory *t, uint64_t allocated)
{
    gsd_index *const s = t->state;
    s->frames = 0;
    for (s->entries = 0; s->entries < allocated; s->entries++) {
        const gsd_entry e = entry_at(s, s->entries);
        if (e.place == 0)
            break;
        if (e.type < 1 || e.type > MOST_TYPE || e.columns == 0 || e.name >= s->names || e.frame >= UINT32_MAX ||
            e.frame + 1 < s->frames)
            return trajectory_fail(t, 0, "entry %" PRIu64 " of the index is damaged", s->entries);
        s->frames = e.frame + 1;
        if (e.frame == 0 && s->first[e.name] == 0)
            s->first[e.name] = s->entries + 1;
    }
    return 1;
}

int gsd_go_to(cgt_trajectory *t, const gsd_entry *e)
{
    const uint64_t room = e->place < t->file_size ? t->file_size - e->place : 0;
    if (e->rows > room / gsd_size_of(e->type) / e->columns)
        return trajectory_fail(t, 0, "frame %" PRIu64 ": the file ends in %s: it is cut off", t->next, gsd_chunk);
    return seek(t, e->place);
}

int gsd_begin(cgt_trajectory *t)
{
    gsd_index *const s = t->state;
    unsigned char head[HEADER_BYTES];
    binary_begin(&s->in, t, 0);
    s->at = s->here_begin = s->here_end = 0;
    if (!t->regular)
        return trajectory_fail(t, 0, "GSD has to be a regular file, neither compressed nor a pipe");
    if (binary_bytes(&s->in, head, sizeof head, "the header") < 0)
        return -1;
    const uint32_t version = binary_get_u32(head + 44, 0);
    if (binary_get_u64(head, 0) != MAGIC || version >> 16 < 1 || version >> 16 > 2)
        return trajectory_fail(t, 0, "not a GSD file of version 1 or 2");
    if (memcmp(head + 112, "hoomd", 6) != 0)
        return trajectory_fail(t, 0, "a GSD file of the schema '%.40s', not hoomd", (const char *)head + 112);
    const uint64_t allocated = binary_get_u64(head + 16, 0), names = binary_get_u64(head + 32, 0);
    return read_block(t, binary_get_u64(head + 24, 0), names, 64, &s->name_bytes, &s->name_capacity) < 0 ||
                   list_names(t, (size_t)(64 * names)) < 0 ||
                   read_block(t, binary_get_u64(head + 8, 0), allocated, ENTRY_BYTES, &s->index, &s->index_capacity) < 0
               ? -1
               : check_index(t, allocated);
}

void gsd_enter_frame(gsd_index *s)
{
    uint64_t low = 0, high = s->entries;
    for (uint64_t i = s->here_begin; i < s->here_end; i++)
        s->here[entry_at(s, i).name] = 0;
    while (low < high) {
        const uint64_t middle = low + (high - low) / 2;
        if (entry_at(s, middle).frame < s->at)
            low = middle + 1;
        else
            high = middle;
    }
    s->here_begin = low;
    for (; low < s->entries && entry_at(s, low).frame == s->at; low++) {
        uint64_t *const entry = &s->here[entry_at(s, low).name];
        *entry = *entry > 0 ? *entry : low + 1;
    }
    s->here_end = low;
}

int gsd_find_number(const gsd_index *s, uint32_t name, gsd_entry *e)
{
    const uint64_t entry = name == NO_NAME ? 0 : s->here[name] > 0 ? s->here[name] : s->first[name];
    if (entry > 0)
        *e = entry_at(s, entry - 1);
    return entry > 0;
}

int gsd_find(const gsd_index *s, gsd_known name, gsd_entry *e) { return gsd_find_number(s, s->known[name], e); }

int gsd_has(const gsd_index *s, gsd_known name) { return s->known[name] != NO_NAME; }

int gsd_check_growth(cgt_trajectory *t, uint64_t bytes)
{
    const gsd_index *const s = t->state;
    const uint64_t frames = s->at + 1, each = bytes + 16;
    const uint64_t made = frames > UINT64_MAX / each ? UINT64_MAX : frames * each;
    if (t->options.no_limit || !trajectory_input_is_blown_up(t->file_size, made))
        return 1;
    return trajectory_fail(t, 0,
                           "frame %" PRIu64 ": with what frames take from the first the file becomes " INPUT_BLOWN_UP,
                           t->next, INPUT_MOST_TIMES);
}

void gsd_index_free(gsd_index *s)
{
    free(s->index);
    free(s->name_bytes);
    free(s->name);
    free(s->particle);
    free(s->first);
    free(s->here);
}
