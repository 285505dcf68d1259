/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * replay [FILE]...: a fuzz target without libFuzzer, for every compiler and machine. Without a FILE: every file of the
 * target's corpus as it is, and mutations of them by CGT_TEST_SEED, their number scaled by CGT_TEST_SCALE. The current
 * mutation is stored as <target>.input in the working directory, so that it survives a crash; replay <target>.input
 * repeats it. With FILEs: only those. */
#define _POSIX_C_SOURCE 200809L
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fuzz/fuzz.h"
#include "support/test.h"

#define MOST_BYTES 4096u /* bytes of a mutation */

typedef struct input {
    uint8_t *bytes;
    size_t size;
} input;

typedef struct corpus {
    input *input;
    uint32_t count;
} corpus;

/* ---- files ---- */

static void quit(const char *path, const char *what)
{
    fprintf(stderr, "%s: ", path);
    perror(what);
    exit(1);
}

static input read_input(const char *path)
{
    input in = {0};
    FILE *file = fopen(path, "rb");
    if (!file)
        quit(path, "cannot be opened");
    if (fseek(file, 0, SEEK_END))
        quit(path, "has no size");
    const long size = ftell(file);
    if (size < 0 || fseek(file, 0, SEEK_SET))
        quit(path, "has no size");
    in.size = (size_t)size;
    in.bytes = fuzz_allocate(in.size);
    if (fread(in.bytes, 1, in.size, file) != in.size || fclose(file))
        quit(path, "cannot be read");
    return in;
}

static int is_visible(const struct dirent *entry) { return entry->d_name[0] != '.'; }

/* All files of a folder, by name, so that the order is the same everywhere. */
static corpus read_corpus(const char *folder)
{
    struct dirent **entry;
    const int count = scandir(folder, &entry, is_visible, alphasort);
    if (count < 0)
        quit(folder, "cannot be listed");
    corpus c = {.input = fuzz_allocate((size_t)count * sizeof *c.input), .count = (uint32_t)count};
    for (int i = 0; i < count; i++) {
        char path[4096];
        const int length = snprintf(path, sizeof path, "%s/%s", folder, entry[i]->d_name);
        FUZZ_CHECK(length > 0 && (size_t)length < sizeof path, "a path is too long");
        c.input[i] = read_input(path);
        free(entry[i]);
    }
    free(entry);
    return c;
}

static void free_corpus(corpus *c)
{
    for (uint32_t i = 0; i < c->count; i++)
        free(c->input[i].bytes);
    free(c->input);
}

/* ---- mutations ---- */

typedef struct buffer {
    uint8_t bytes[MOST_BYTES];
    uint32_t size;
} buffer;

/* Makes room for at most `length` bytes; returns the number. */
static uint32_t open_gap(buffer *b, uint32_t at, uint32_t length)
{
    if (length > MOST_BYTES - b->size)
        length = MOST_BYTES - b->size;
    memmove(b->bytes + at + length, b->bytes + at, b->size - at);
    b->size += length;
    return length;
}

static void cut(buffer *b, uint32_t at, uint32_t length)
{
    if (length > b->size - at)
        length = b->size - at;
    memmove(b->bytes + at, b->bytes + at + length, b->size - at - length);
    b->size -= length;
}

/* Overwrites or inserts a piece of another input. */
static void splice(buffer *b, test_random *r, const input *from, uint32_t at)
{
    if (!from->size)
        return;
    const uint32_t most = from->size < MOST_BYTES ? (uint32_t)from->size : MOST_BYTES;
    const uint32_t start = random_below(r, most);
    uint32_t length = 1 + random_below(r, most - start);
    if (random_below(r, 2))
        length = open_gap(b, at, length);
    else if (length > b->size - at)
        length = b->size - at;
    memcpy(b->bytes + at, from->bytes + start, length);
}

static void mutate_once(buffer *b, test_random *r, const corpus *c)
{
    static const char *const words[] = {"nan",        "inf", "-1", "0",      "1e39",
                                        "4294967295", "\n",  " ",  "ITEM: ", "f 1 2 3\n"};
    const uint32_t at = b->size ? random_below(r, b->size) : 0, kind = random_below(r, 7);
    const char *const word = words[random_below(r, TEST_COUNT(words))];
    if (kind == 6)
        splice(b, r, &c->input[random_below(r, c->count)], at);
    else if (kind == 5)
        memcpy(b->bytes + at, word, open_gap(b, at, (uint32_t)strlen(word)));
    else if (!b->size)
        return;
    else if (kind == 4)
        cut(b, at, 1 + random_below(r, random_below(r, 4) ? 8 : 64));
    else if (kind == 3)
        b->bytes[at] = (uint8_t)(b->bytes[at] + (random_below(r, 2) ? 1 : 255));
    else if (kind == 2)
        b->bytes[at] ^= (uint8_t)(1u << random_below(r, 8));
    else
        b->bytes[at] = (uint8_t)random_bits(r);
}

/* A new file each time: some file systems write one that was cut to nothing to the disk when it is closed, which took
 * most of a test's time. */
static void save(const char *path, const buffer *b)
{
    remove(path);
    FILE *file = fopen(path, "wb");
    if (!file || fwrite(b->bytes, 1, b->size, file) != b->size || fclose(file))
        quit(path, "cannot be written");
}

static void try_mutations(const corpus *c, uint32_t count, const char *path)
{
    test_random r = random_make(77);
    for (uint32_t n = 0; n < count; n++) {
        buffer b;
        const input *from = &c->input[random_below(&r, c->count)];
        b.size = from->size < MOST_BYTES ? (uint32_t)from->size : MOST_BYTES;
        memcpy(b.bytes, from->bytes, b.size);
        for (uint32_t edits = 1 + random_below(&r, 8); edits > 0; edits--)
            mutate_once(&b, &r, c);
        save(path, &b);
        /* an exact-size copy, so that a sanitizer sees reads past its end */
        uint8_t *bytes = memcpy(fuzz_allocate(b.size), b.bytes, b.size);
        LLVMFuzzerTestOneInput(bytes, b.size);
        free(bytes);
    }
    remove(path);
}

int main(int argc, char **argv)
{
    test_begin(FUZZ_TARGET);
    for (int i = 1; i < argc; i++) {
        input in = read_input(argv[i]);
        LLVMFuzzerTestOneInput(in.bytes, in.size);
        free(in.bytes);
    }
    if (argc > 1)
        return 0;
    corpus c = read_corpus(FUZZ_CORPUS);
    const uint32_t mutations = test_scaled(FUZZ_MUTATIONS);
    if (!c.count) {
        fprintf(stderr, "%s: the corpus is empty\n", FUZZ_CORPUS);
        return 1;
    }
    for (uint32_t i = 0; i < c.count; i++)
        LLVMFuzzerTestOneInput(c.input[i].bytes, c.input[i].size);
    try_mutations(&c, mutations, FUZZ_TARGET ".input");
    printf("%u files, %u mutations of them\n", c.count, mutations);
    free_corpus(&c);
    return 0;
}
