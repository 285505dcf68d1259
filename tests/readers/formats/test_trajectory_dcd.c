/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * DCD in all its forms: both byte orders, markers of 4 and 8 bytes, CHARMM and X-PLOR, fixed atoms, a fourth
 * coordinate, cells by angles, by cosines and by a matrix. */
#define _GNU_SOURCE
#include <math.h>

#include "readers/trajectory_scratch.h"

#define ATOMS 4u
#define FRAMES 3u

typedef struct dcd_form {
    int is_big, marker, is_charmm, fixed, has_fourth;
    uint32_t version; /* of CHARMM; 0: 24 */
    const char *title;
    double cell[6]; /* all 0: none */
} dcd_form;

typedef struct dcd_bytes {
    unsigned char bytes[8192];
    size_t size;
    const dcd_form *form;
} dcd_bytes;

static void put(dcd_bytes *d, uint64_t bits, int size)
{
    for (int i = 0; i < size; i++) {
        const int shift = 8 * (d->form->is_big ? size - 1 - i : i);
        d->bytes[d->size++] = (unsigned char)(bits >> shift);
    }
}

static void put_float(dcd_bytes *d, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    put(d, bits, 4);
}

static void put_double(dcd_bytes *d, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    put(d, bits, 8);
}

static float place(unsigned frame, unsigned atom, unsigned axis)
{
    return (float)atom + 0.25f * (float)axis + (atom == 1 ? 0.0f : 10.0f * (float)frame); /* atom 1 may be fixed */
}

static int has_cell(const dcd_form *form) { return form->cell[0] != 0.0; }

static void put_header(dcd_bytes *d)
{
    const dcd_form *const f = d->form;
    put(d, 84, f->marker);
    memcpy(d->bytes + d->size, "CORD", 4);
    d->size += 4;
    const uint32_t numbers[9] = {FRAMES, 100, 10, FRAMES * 10, 0, 0, 0, 0, f->fixed ? 1 : 0};
    for (int i = 0; i < 9; i++)
        put(d, numbers[i], 4);
    if (f->is_charmm) {
        put_float(d, 2.0f);
        put(d, (uint64_t)has_cell(f), 4);
    } else {
        put_double(d, 2.0);
    }
    put(d, (uint64_t)(f->has_fourth != 0), 4);
    for (int i = 12; i < 20; i++)
        put(d, i < 19 || !f->is_charmm ? 0 : f->version > 0 ? f->version : 24, 4);
    put(d, 84, f->marker);
    put(d, 84, f->marker);
    put(d, 1, 4);
    memset(d->bytes + d->size, ' ', 80);
    memcpy(d->bytes + d->size, f->title != NULL ? f->title : "", f->title != NULL ? strlen(f->title) : 0);
    d->size += 80;
    put(d, 84, f->marker);
    put(d, 4, f->marker);
    put(d, ATOMS, 4);
    put(d, 4, f->marker);
    if (f->fixed) {
        put(d, 12, f->marker);
        put(d, 1, 4);
        put(d, 3, 4);
        put(d, 4, 4);
        put(d, 12, f->marker);
    }
}

static void put_frame(dcd_bytes *d, unsigned frame)
{
    const dcd_form *const f = d->form;
    if (has_cell(f)) {
        put(d, 48, f->marker);
        for (int i = 0; i < 6; i++)
            put_double(d, f->cell[i]);
        put(d, 48, f->marker);
    }
    const int only_moving = f->fixed && frame > 0;
    for (unsigned axis = 0; axis < 3u + (f->has_fourth != 0); axis++) {
        put(d, only_moving ? 12 : 16, f->marker);
        for (unsigned atom = 0; atom < ATOMS; atom++)
            if (!(only_moving && atom == 1))
                put_float(d, place(frame, atom, axis));
        put(d, only_moving ? 12 : 16, f->marker);
    }
}

static void expect_frame(const dcd_form *form, const cgt_trajectory_frame *frame, unsigned number)
{
    assert_int_equal(frame->count, ATOMS);
    assert_int_equal(frame->step, 100 + 10 * number);
    assert_true(fabs(frame->time - 0.04888821 * 2.0 * (100.0 + 10.0 * number)) < 1e-9);
    for (unsigned atom = 0; atom < ATOMS; atom++)
        scratch_expect_sphere(frame, atom, place(number, atom, 0), place(number, atom, 1), place(number, atom, 2),
                              1.0f);
    assert_true(has_cell(form) == (frame->box_min[0] <= frame->box_max[0]));
}

TEST(test_forms)
{
    static const double angles[6] = {10, 60, 20, 90, 90, 30}, cosines[6] = {10, 0.5, 20, 0, 0, 30};
    static const double matrix[6] = {10, -3, 20, -2, -4, 30}; /* no angles: negative */
    for (int i = 0; i < 64; i++) {
        static dcd_bytes d;
        dcd_form form = {.is_big = i & 1, .marker = i & 2 ? 8 : 4, .is_charmm = (i & 4) != 0, .fixed = (i & 8) != 0};
        form.has_fourth = form.is_charmm && i & 16;
        if (form.is_charmm && i & 32)
            memcpy(form.cell, i % 3 == 0 ? angles : i % 3 == 1 ? cosines : matrix, sizeof form.cell);
        d.size = 0;
        d.form = &form;
        put_header(&d);
        for (unsigned frame = 0; frame < FRAMES; frame++)
            put_frame(&d, frame);
        char error[1024] = "";
        cgt_trajectory *t = scratch_open(scratch_bytes(".dcd", d.bytes, d.size), NULL);
        cgt_trajectory_frame frame;
        for (unsigned number = 0; number < FRAMES; number++) {
            frame = scratch_read(t);
            expect_frame(&form, &frame, number);
        }
        if (has_cell(&form)) {
            const double expected = i % 3 == 2 ? -3.0 : 20.0 * 0.5;
            assert_true(fabs(frame.box_edge[1][0] - expected) < 1e-9);
        }
        scratch_expect_end(t);
        /* skipping the first frame keeps its fixed atom */
        assert_int_equal(told_rewind(t, error, sizeof error), 0);
        assert_int_equal(told_skip(t, error, sizeof error), 1);
        assert_int_equal(told_skip(t, error, sizeof error), 1);
        frame = scratch_read(t);
        expect_frame(&form, &frame, 2);
    }
}

/* The same six numbers by the program that wrote them: version, cell, the second and third edge. The edges are
 * those of MDAnalysis where it does not take angles for the matrix of a version. */
TEST(test_cells)
{
    static const struct {
        uint32_t version;
        double cell[6], edge[2][3];
        int is_doubtful;
    } cases[] = {
        {24, {10, 0.5, 20, 0, 0, 30}, {{10, 17.320508, 0}, {0, 0, 30}}, 0},
        {35, {10, 0.5, 20, 0, 0, 30}, {{0.5, 20, 0}, {0, 0, 30}}, 1}, /* a box that was a little sheared */
        {36, {10, 0, 20, 0, 0, 30}, {{0, 20, 0}, {0, 0, 30}}, 0},
        {24, {50, 60, 50, 60, 60, 50}, {{25, 43.301270, 0}, {25, 14.433757, 40.824829}}, 0},
        {21, {50, 60, 50, 90, 90, 50}, {{25, 43.301270, 0}, {0, 0, 50}}, 0},
        {44, {236, 59, 236, 59, 59, 236}, {{59, 236, 59}, {59, 59, 236}}, 0}, /* angles, were it another program */
        {24, {47, -9, 47, -9, 3, 47}, {{-9, 47, 3}, {-9, 3, 47}}, 0},
        {24, {47, 12, 47, 0, 0, 47}, {{12, 47, 0}, {0, 0, 47}}, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        static dcd_bytes d;
        dcd_form form = {.marker = 4, .is_charmm = 1, .version = cases[i].version};
        memcpy(form.cell, cases[i].cell, sizeof form.cell);
        d.size = 0;
        d.form = &form;
        put_header(&d);
        for (unsigned frame = 0; frame < FRAMES; frame++)
            put_frame(&d, frame);
        cgt_trajectory *t = scratch_open(scratch_bytes(".dcd", d.bytes, d.size), NULL);
        const cgt_trajectory_frame frame = scratch_read(t);
        for (int k = 0; k < 6; k++)
            if (fabs(frame.box_edge[1 + k / 3][k % 3] - cases[i].edge[k / 3][k % 3]) > 1e-5)
                fail_msg("row %zu: edge %d has %g", i, k, frame.box_edge[1 + k / 3][k % 3]);
        const char *const warning = cgt_trajectory_take_warning(t);
        assert_true((warning != NULL && strstr(warning, "read as CHARMM's matrix")) == cases[i].is_doubtful);
    }
}

/* LAMMPS has the unit of its run in the place of CHARMM's. */
TEST(test_lammps)
{
    static dcd_bytes d;
    static const dcd_form form = {.marker = 4, .is_charmm = 1, .title = "Written by LAMMPS"};
    d.form = &form;
    put_header(&d);
    put_frame(&d, 0);
    cgt_trajectory *t = scratch_open(scratch_bytes(".dcd", d.bytes, d.size), NULL);
    const cgt_trajectory_frame frame = scratch_read(t);
    assert_int_equal(frame.step, 100);
    assert_true(isnan(frame.time));
}

/* What is left out does not change where fixed atoms are. */
TEST(fixed_atoms_behind_a_site)
{
    static dcd_bytes d;
    static const dcd_form form = {.marker = 4, .is_charmm = 1, .fixed = 1};
    d.form = &form;
    put_header(&d);
    for (unsigned frame = 0; frame < FRAMES; frame++)
        put_frame(&d, frame);
    const cgt_trajectory_options options = {
        .topology = scratch_text(".xyz", "4\n\nX 0 0 0\nC 0 0 0\nC 0 0 0\nC 0 0 0\n"), .leave_out_sites = 1};
    cgt_trajectory *t = scratch_open(scratch_bytes(".dcd", d.bytes, d.size), &options);
    for (unsigned number = 0; number < FRAMES; number++) {
        const cgt_trajectory_frame frame = scratch_read(t);
        assert_int_equal(frame.count, 3);
        for (unsigned atom = 1; atom < ATOMS; atom++)
            scratch_expect_sphere(&frame, atom - 1, place(number, atom, 0), place(number, atom, 1),
                                  place(number, atom, 2), 1.7f);
    }
}

TEST(test_damage)
{
    static dcd_bytes d;
    static const dcd_form form = {.marker = 4, .is_charmm = 1};
    d.form = &form;
    put_header(&d);
    put_frame(&d, 0);
    const char *path = scratch_bytes(".dcd", d.bytes, d.size);
    cgt_trajectory *t = scratch_open(path, NULL);
    scratch_read(t);
    scratch_expect_end(t);
    assert_non_null(strstr(cgt_trajectory_take_warning(t), "the header says 3 frames, the file ends after 1"));
    d.bytes[d.size - 4] ^= 1;
    scratch_expect_error(scratch_bytes(".dcd", d.bytes, d.size), NULL, 0, "the length after");
    memcpy(d.bytes + 4, "VELD", 4);
    scratch_expect_error(scratch_bytes(".dcd", d.bytes, d.size), NULL, 0, "velocities has no positions");
    scratch_expect_error(scratch_text(".dcd", "not a DCD"), NULL, 0, "not a DCD file");
    static const dcd_form fixed = {.marker = 4, .is_charmm = 1, .fixed = 1};
    d.form = &fixed;
    d.size = 0;
    put_header(&d);
    d.bytes[d.size - 8] = 9; /* the last in the list of atoms that move */
    scratch_expect_error(scratch_bytes(".dcd", d.bytes, d.size), NULL, 0, "moving atom 9 is not one of 4");
}

/* 100,000 atoms, one of which moves: a frame of 36 bytes becomes 1.6 MB. */
TEST(fixed_atoms_that_become_large)
{
    static const uint32_t atoms = 100000, frames = 700, zero = 0;
    static const dcd_form form = {.is_charmm = 1, .marker = 4};
    static unsigned char places[400000];
    dcd_bytes d = {.form = &form};
    put(&d, 84, 4);
    memcpy(d.bytes + d.size, "CORD", 4);
    d.size += 4;
    for (int i = 0; i < 20; i++)
        put(&d, i == 0 ? frames : i == 8 ? atoms - 1 : i == 19 ? 24 : 0, 4);
    const uint32_t rest[] = {84, 4, 0, 4, 4, atoms, 4, 4, 1, 4}; /* a title, the number of atoms, the one that moves */
    for (size_t i = 0; i < sizeof rest / sizeof rest[0]; i++)
        put(&d, rest[i], 4);
    const char *const path = scratch_path(".dcd");
    FILE *const file = fopen(path, "wb");
    assert_non_null(file);
    fwrite(d.bytes, 1, d.size, file);
    for (uint32_t i = 0; i < 3 + 3 * frames; i++) {
        const uint32_t size = i < 3 ? 4 * atoms : 4;
        d.size = 0;
        put(&d, size, 4);
        fwrite(d.bytes, 1, 4, file);
        fwrite(i < 3 ? places : (const unsigned char *)&zero, 1, size, file);
        fwrite(d.bytes, 1, 4, file);
    }
    assert_int_equal(fclose(file), 0);
    scratch_expect_error(path, NULL, 671, "more than 1 GiB and 500 times its size; --no-limit reads it");
    cgt_trajectory_options options;
    cgt_trajectory_options_init(&options);
    options.no_limit = 1;
    cgt_trajectory *const t = scratch_open(path, &options);
    for (uint32_t i = 0; i < frames + 1; i++)
        scratch_read(t);
    scratch_expect_end(t);
}

SUITE(NULL, NULL)
