/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Large frames of text: any number of threads gives the same bits, the same names and the same errors, whatever rows of
 * an unusual form are among the others. */
#define _GNU_SOURCE
#include <math.h>

#include "readers/trajectory_scratch.h"
#include "trajectory/text/text_reader.h"
#include "trajectory/text/text_scan.h"

/* Of each frame. The buffer of several threads ends within a frame, and holds more than one. */
static const uint32_t frame_rows[] = {150000, 20000, 20000, 90000};
#define ROWS 280000u /* of all */

static uint32_t random_state;

static uint32_t next_random(void)
{
    random_state = random_state * 1664525u + 1013904223u;
    return random_state >> 8;
}

/* Writes a run. One row in `odd` has a number that is left to strtof, and now and then a new name comes up. bad: a
 * row with a word that is no number; ROWS: none. */
static const char *write_run(uint32_t odd, uint32_t bad)
{
    static const char *const odd_numbers[] = {"+1.5", "123456789.125",          "1e-30",
                                              "0x",   "5.00000000000000000001", "1.5D1"};
    const char *path = scratch_path(".dump");
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    uint32_t frame = 0, first = 0;
    for (uint32_t i = 0; i < ROWS; i++) {
        if (i == first) {
            fprintf(file, "ITEM: TIMESTEP\n%u\nITEM: NUMBER OF ATOMS\n%u\nITEM: ATOMS id element x y z q\n", frame,
                    frame_rows[frame]);
            first += frame_rows[frame++];
        }
        const uint32_t name = i > 20000 && i < 100000 && i % 30011 == 0 ? i : i % 3;
        const char *number = i == bad                              ? "1.5x"
                             : odd > 0 && next_random() % odd == 0 ? odd_numbers[next_random() % 6]
                                                                   : "2.25";
        if (strcmp(number, "0x") == 0)
            number = "17";                           /* no hexadecimal numbers */
        if (first - i + 100 > frame_rows[frame - 1]) /* a frame's first rows are longer than the others */
            fprintf(file, "%60s", "");
        fprintf(file, "%u N%u %d.%u %s %.9g -%ue-0%u\n", i + 1, name, (int)(next_random() % 100) - 50,
                next_random() % 1000000, number, (double)next_random() / 1e5, next_random() % 1000, next_random() % 10);
    }
    assert_int_equal(fclose(file), 0);
    return path;
}

typedef struct result {
    int status; /* of the read after the last frame */
    uint32_t rows;
    char error[1024];
    uint64_t hash;
} result;

static uint64_t hash_bytes(uint64_t hash, const void *bytes, size_t size)
{
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ ((const uint8_t *)bytes)[i]) * UINT64_C(0x100000001b3);
    return hash;
}

static result read_file(const char *path, int threads)
{
    static const char *const names[] = {"q", "y"};
    result r = {.hash = UINT64_C(0xcbf29ce484222325)};
    cgt_trajectory_options options;
    cgt_trajectory_frame frame;
    cgt_trajectory_options_init(&options);
    options.threads = threads;
    cgt_trajectory *t = scratch_open(path, &options);
    assert_int_equal(told_want_columns(t, names, 2, r.error, sizeof r.error), 0);
    while ((r.status = told_read(t, &frame, r.error, sizeof r.error)) == 1) {
        r.rows += frame.count;
        r.hash = hash_bytes(r.hash, frame.xyzr, 16 * (size_t)frame.count);
        r.hash = hash_bytes(r.hash, frame.id, 4 * (size_t)frame.count);
        r.hash = hash_bytes(r.hash, frame.type, 4 * (size_t)frame.count);
        for (int i = 0; i < 2; i++)
            r.hash = hash_bytes(r.hash, cgt_trajectory_find_column(&frame, names[i])->value, 4 * (size_t)frame.count);
    }
    return r;
}

static void expect_same(uint32_t odd, uint32_t bad)
{
    static const int threads[] = {2, 3, 4, 7, 64};
    const char *path = write_run(odd, bad);
    const result one = read_file(path, 1);
    assert_int_equal(one.status, bad < ROWS ? -1 : 0);
    assert_true(bad < ROWS || one.rows == ROWS);
    assert_true(bad >= ROWS || strstr(one.error, "'1.5x' is not a number") != NULL);
    for (size_t i = 0; i < sizeof threads / sizeof threads[0]; i++) {
        const result other = read_file(path, threads[i]);
        assert_int_equal(other.status, one.status);
        assert_string_equal(other.error, one.error);
        if (other.hash != one.hash)
            fail_msg("%d threads, one row in %u odd: other values", threads[i], odd);
    }
}

TEST(test_usual_rows) { expect_same(0, ROWS); }

TEST(test_odd_rows)
{
    expect_same(50000, ROWS);
    expect_same(20, ROWS);
}

TEST(test_errors)
{
    expect_same(0, ROWS - 1);
    expect_same(1000, 100000);
}

/* A number of 16 digits, the nearest to one half-way between two floats: some become that very number as a double. */
static void write_half_way(char text[40])
{
    const float number = (float)next_random() / 3e3f;
    snprintf(text, 40, "%.15e", 0.5 * ((double)number + (double)nextafterf(number, INFINITY)));
}

/* The rows of the numbers themselves: text_float's bits, or nothing. */
TEST(test_numbers)
{
    unsigned taken = 0;
    for (uint32_t i = 0; i < 400000; i++) {
        char text[64] = {0};
        const uint32_t shape = next_random() % 9;
        const double number = ((double)next_random() / 3e3 - 2e3) * (shape == 7 ? 1e-5 : 1.0);
        if (shape == 8)
            write_half_way(text);
        else
            snprintf(text, 40, shape < 3 ? "%.*f" : shape < 6 ? "%.*g" : "%.*e", (int)(next_random() % 17), number);
        const size_t length = strlen(text);
        float expected, value;
        text[length] = '\n';
        const char *const after = scan_float(text, &value);
        if (after == NULL || (*after >= '0' && *after <= '9')) /* more digits than are taken: no row ends there */
            continue;
        taken++;
        text[length] = '\0';
        assert_ptr_equal(after, text + length);
        assert_true(text_float((text_span){text, text + length}, &expected));
        if (memcmp(&value, &expected, sizeof value) != 0)
            fail_msg("%s: %.9g, not %.9g", text, (double)value, (double)expected);
        expected = strtof(text, NULL);
        assert_memory_equal(&value, &expected, sizeof value);
    }
    assert_true(taken > 200000);
}

/* What is nearly a short number is none: a row ends only where text_float takes the word, too. */
TEST(test_short_numbers)
{
    static const char *const words[] = {
        ".",        "-.",   ".5",    "-.5",  "5.",   "-0.0", "1.2.3",  "0.123456", "-0.123456", "12345.67", "1234567.",
        "12345678", "1..2", "1.5e3", "1.5e", "1.-5", "1.5x", "1.\x8b", "1.5\xff",  "1.5\x0b",   "--1.5"};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        char text[64] = {0};
        const size_t length = (size_t)snprintf(text, 40, "%s\n", words[i]) - 1;
        float value = -1.0f, expected = -1.0f;
        double number = -1.0, exact = -1.0;
        const int is_float = scan_float(text, &value) == text + length;
        const int is_double = scan_double(text, &number) == text + length;
        text[length] = '\0';
        const text_span word = {text, text + length};
        if (is_float && (!text_float(word, &expected) || memcmp(&value, &expected, sizeof value) != 0))
            fail_msg("%s: %.9g", words[i], (double)value);
        if (is_double && (!text_double(word, &exact) || memcmp(&number, &exact, sizeof number) != 0))
            fail_msg("%s: %.17g", words[i], number);
    }
}

int main(void)
{
    const char *seed = getenv("CGT_TEST_SEED");
    random_state = seed != NULL ? (uint32_t)strtoul(seed, NULL, 10) : 20261125u;
    print_message("CGT_TEST_SEED=%u\n", random_state);
    return SUITE_RUN(NULL, NULL);
}
