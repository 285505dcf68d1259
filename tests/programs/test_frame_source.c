/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames by their numbers, with speeds that do not depend on what was read before; surveys in parts; copies of
 * frames. */
#define _GNU_SOURCE
#include "support/suite.h"
#include "support/test.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "data/frame_copy.h"
#include "playback/survey_walk.h"
#include "survey/survey.h"

enum { FRAMES = 70 };

static cgt_context *context; /* of two threads */
static char path[] = "frame_source_XXXXXX";
static stop_flag stop;

/* A survey of what a source's sequence takes. */
typedef struct survey_plan {
    uint64_t most;                /* looks at the first frames alone, this many */
    int count;                    /* counts the frames up to the file's end in any case */
    int quiet;                    /* no progress on the terminal */
    const stop_flag *stop;        /* not 0: ends the survey with an error */
    cgt_context *context;         /* whose threads look at large frames; the survey is the same from any number */
    const camera_directions *fit; /* of spheres, and one more of triangles: what the camera needs; NULL: nothing */
} survey_plan;

static int look(void *user, char *error, size_t error_size)
{
    (void)error;
    (void)error_size;
    cgt_survey_look(user);
    return 0;
}

static int survey_run(frame_source *source, const survey_plan *plan, survey *result, char *error, size_t error_size)
{
    survey_team team;
    survey_walk walk = {.most = plan->most,
                        .count = plan->count,
                        .quiet = plan->quiet,
                        .stop = plan->stop,
                        .look = look,
                        .user = &team};
    cgt_survey_begin(&team, source->sequence, plan->fit, plan->context, result);
    const int failed = survey_walk_run(&walk, source, error, error_size);
    cgt_survey_end(&team);
    result->has_total = walk.has_total;
    result->total = walk.total;
    result->is_cut = walk.is_cut;
    return failed;
}

/* Frame i has i % 3 + 1 spheres; the first one moves by i in frame i. */
static int write_run(void **state)
{
    (void)state;
    if (cgt_context_create(&(cgt_context_options){.threads = 2}, &context))
        return -1;
    const int descriptor = mkstemp(path);
    FILE *const file = descriptor < 0 ? NULL : fdopen(descriptor, "w");
    if (!file)
        return -1;
    for (int i = 0; i < FRAMES; i++) {
        fprintf(file, "%d\nframe %d\nC %d 0 0\n", i % 3 + 1, i, i * (i + 1) / 2);
        for (int k = 0; k < i % 3; k++)
            fprintf(file, "O 0 %d 0\n", k + i);
    }
    return fclose(file);
}

static int remove_run(void **state)
{
    (void)state;
    cgt_context_release(context);
    return unlink(path);
}

static frame_sequence sequences[2]; /* of the sources that are open at once */

static void open_file(frame_source *source, const char *name)
{
    static uint32_t opened;
    frame_sequence *const sequence = &sequences[opened++ % 2];
    const char *const paths[] = {name};
    cgt_trajectory_options options;
    char error[300];
    cgt_trajectory_options_init(&options);
    options.format = "xyz";
    assert_int_equal(frame_source_open(source, sequence, paths, 1, &options, error, sizeof error), 0);
    sequence->tracker = cgt_speed_create(context);
    assert_non_null(sequence->tracker);
}

static void open_run(frame_source *source) { open_file(source, path); }

static void close_run(frame_source *source)
{
    cgt_frame_sequence_close(source->sequence);
    frame_source_close(source);
}

TEST(ranges_count_their_frames)
{
    static const uint64_t rows[][5] = {{0, UINT64_MAX - 1, 1, 10, 10},
                                       {0, UINT64_MAX - 1, 3, 10, 4},
                                       {9, 20, 1, 10, 1},
                                       {10, 20, 1, 10, 0},
                                       {2, 5, 2, 10, 2},
                                       {2, 6, 2, 10, 3},
                                       {0, 0, 7, 10, 1},
                                       {0, 5, 1, 0, 0},
                                       {0, UINT64_MAX - 1, 1, UINT64_MAX, UINT64_MAX}};
    for (size_t i = 0; i < TEST_COUNT(rows); i++) {
        const frame_range range = {rows[i][0], rows[i][1], rows[i][2]};
        assert_true(frame_range_count(&range, rows[i][3]) == rows[i][4]);
    }
}

/* Every way to reach a frame gives its number, its spheres and its speed. */
TEST(frames_are_found_by_number)
{
    static const uint64_t steps[] = {1, 2, 3, 7, 69};
    char error[300];
    for (size_t s = 0; s < TEST_COUNT(steps); s++) {
        frame_source source;
        open_run(&source);
        for (uint64_t number = steps[s] - 1; number < FRAMES; number += steps[s]) {
            assert_int_equal(frame_source_read(&source, number, error, sizeof error), 1);
            assert_int_equal(source.sequence->frame.number, number);
            assert_int_equal(source.sequence->frame.count, number % 3 + 1);
            if (number > 0 && number % 3 > 0) /* fewer spheres than before: nothing is known */
                assert_true(source.sequence->speed[0] == (float)number);
        }
        assert_int_equal(frame_source_read(&source, source.next < FRAMES ? FRAMES : source.next, error, sizeof error),
                         0);
        close_run(&source);
    }
}

/* Of spheres that are in both of the first two frames; where nothing is known of the second, there is no speed. */
TEST(first_frames_have_the_speeds_towards_the_second)
{
    char error[300];
    frame_source source;
    open_run(&source);
    source.looks_ahead = 1;
    for (uint64_t number = 0; number < 3; number++) {
        assert_int_equal(frame_source_read(&source, number, error, sizeof error), 1);
        assert_int_equal(source.sequence->frame.number, number);
        assert_int_equal(source.sequence->frame.count, number + 1);
        assert_true(source.sequence->speed[0] == (float)(number ? number : 1));
    }
    close_run(&source);
    open_run(&source);
    source.looks_ahead = 1;
    assert_int_equal(frame_source_read(&source, 1, error, sizeof error), 1);
    assert_true(source.sequence->frame.number == 1 && source.sequence->speed[0] == 1.0f);
    close_run(&source);
}

/* Trails are the same however a frame is reached. Where there are fewer spheres than before nothing is known of the
 * frame before, so they reach back to the last frame of one sphere. */
TEST(trails_do_not_depend_on_what_was_read)
{
    static const uint64_t steps[] = {1, 2, 3, 7, 69};
    char error[300];
    float place[6][3];
    for (size_t s = 0; s < TEST_COUNT(steps); s++)
        for (uint32_t length = 1; length <= 5; length += 2) {
            frame_source source;
            open_run(&source);
            cgt_speed_release(source.sequence->tracker);
            source.sequence->tracker = NULL;
            source.sequence->trails = cgt_trail_history_create(length);
            assert_non_null(source.sequence->trails);
            for (uint64_t number = steps[s] - 1; number < FRAMES; number += steps[s]) {
                const uint64_t back = number % 3 < length ? number % 3 : length;
                assert_int_equal(frame_source_read(&source, number, error, sizeof error), 1);
                assert_int_equal(cgt_trail_history_places(source.sequence->trails, 0, place), back + 1);
                for (uint64_t k = 0; k <= back; k++)
                    assert_true(place[k][0] == (float)((number - k) * (number - k + 1) / 2));
            }
            assert_int_equal(frame_source_rewind(&source, error, sizeof error), 0);
            assert_int_equal(frame_source_read(&source, 0, error, sizeof error), 1);
            assert_int_equal(cgt_trail_history_places(source.sequence->trails, 0, place), 1);
            close_run(&source);
        }
}

/* What an automatic camera asks for, of spheres and of triangles. */
static const camera_directions *camera_fits(void)
{
    static camera_directions fit[2];
    static const float view[3] = {0.5f, -1.0f, 0.45f}, up[3] = {0.0f, 0.0f, 1.0f};
    for (int kind = 0; kind < 2; kind++)
        cgt_camera_directions_set(&fit[kind], view, up, 30.0f, 1.5, 90.0, 1);
    return fit;
}

/* What the survey says of how far the run reaches, from a look at each sphere. */
static void expect_reach(frame_source *source, const survey *s)
{
    const camera_directions *const fit = camera_fits();
    camera_reach reach;
    char error[300];
    float min[3] = {INFINITY, INFINITY, INFINITY}, max[3] = {-INFINITY, -INFINITY, -INFINITY};
    cgt_camera_reach_clear(&reach);
    for (uint64_t number = 0; frame_source_read(source, number, error, sizeof error) == 1; number++)
        for (uint32_t i = 0; i < source->sequence->frame.count; i++) {
            const float *const p = source->sequence->frame.xyzr + 4 * (size_t)i;
            const double place[3] = {(double)p[0], (double)p[1], (double)p[2]};
            if (!isfinite(p[0]))
                continue;
            cgt_camera_reach_add(&reach, fit, place, (double)p[3]);
            for (int c = 0; c < 3; c++) {
                min[c] = fminf(min[c], p[c] - p[3]);
                max[c] = fmaxf(max[c], p[c] + p[3]);
            }
        }
    assert_true(fit->count > 8);
    assert_memory_equal(s->reach.along, reach.along, fit->count * sizeof reach.along[0]);
    assert_memory_equal(s->bounds_min, min, sizeof min);
    assert_memory_equal(s->bounds_max, max, sizeof max);
}

/* A survey of large frames, some of whose spheres have no place, is the same from any number of threads. */
TEST(threads_do_not_change_surveys)
{
    static survey one, many;
    char name[] = "frame_source_large_XXXXXX", error[300];
    const char *const paths[] = {name};
    const int descriptor = mkstemp(name);
    FILE *const file = descriptor < 0 ? NULL : fdopen(descriptor, "w");
    uint64_t seed = 11;
    assert_non_null(file);
    for (int i = 0; i < 3; i++) {
        const int count = 150000 - 1234 * i;
        fprintf(file, "%d\n\n", count);
        for (int k = 0; k < count; k++) {
            seed = seed * UINT64_C(6364136223846793005) + 1442695040888963407u;
            fprintf(file, "%s %s %u %u\n", k == 140001 ? "O" : "Q7", k % 1000 ? "1" : "nan",
                    (unsigned)(k / 16 + (seed >> 59)), (unsigned)(seed >> 40 & 1023));
        }
    }
    assert_int_equal(fclose(file), 0);
    for (uint32_t threads = 1; threads <= (test_samples() ? 3 : 7); threads += threads < 3 ? 1 : 4) {
        frame_source source;
        cgt_trajectory_options options;
        cgt_context *some;
        assert_int_equal(cgt_context_create(&(cgt_context_options){.threads = threads}, &some), CGT_OK);
        const survey_plan plan = {.most = UINT64_MAX, .quiet = 1, .stop = &stop, .context = some, .fit = camera_fits()};
        cgt_trajectory_options_init(&options);
        options.format = "xyz";
        options.threads = (int)threads;
        assert_int_equal(frame_source_open(&source, &sequences[0], paths, 1, &options, error, sizeof error), 0);
        sequences[0].tracker = cgt_speed_create(some);
        source.keep.most = threads % 2 ? 0 : SIZE_MAX; /* then the next frame is read while one is looked at */
        assert_int_equal(cgt_frame_sequence_bind(source.sequence, cgt_expression_parse("y + z", error, sizeof error),
                                                 error, sizeof error),
                         0);
        assert_int_equal(survey_run(&source, &plan, threads == 1 ? &one : &many, error, sizeof error), 0);
        assert_true(one.drawable == 446298 - 447 && one.has_element && one.speeds == 0);
        assert_true(one.values == 446298 && one.id_max == 149999);
        if (threads > 1)
            assert_memory_equal(&many, &one, sizeof one);
        expect_reach(&source, &one);
        cgt_expression_free(source.sequence->formulas[0]);
        close_run(&source);
        cgt_context_release(some);
    }
    assert_int_equal(unlink(name), 0);
}

TEST(surveys_look_at_the_first_frames)
{
    static survey found;
    char error[300];
    for (int count = 0; count < 2; count++) {
        frame_source source;
        const survey_plan plan = {.most = 2, .count = count, .quiet = 1, .stop = &stop, .context = context};
        open_run(&source);
        assert_int_equal(survey_run(&source, &plan, &found, error, sizeof error), 0);
        assert_int_equal(found.frames, 2);
        assert_int_equal(found.has_total, count);
        assert_int_equal(found.total, count ? FRAMES : 2);
        assert_int_equal(frame_source_read(&source, 0, error, sizeof error), 1); /* it went back */
        close_run(&source);
    }
}

static void check_same_array(const void *a, const void *b, size_t bytes)
{
    assert_int_equal(!a, !b);
    if (a && bytes)
        assert_memory_equal(a, b, bytes);
}

/* A source's frame with all that it has, beside another's. */
static void check_same_frame(const frame_source *a, const frame_source *b)
{
    const cgt_trajectory_frame *const f = &a->sequence->frame, *const g = &b->sequence->frame;
    assert_int_equal(f->number, g->number);
    assert_int_equal(f->count, g->count);
    check_same_array(f->xyzr, g->xyzr, f->count * 4 * sizeof *f->xyzr);
    check_same_array(f->id, g->id, f->count * sizeof *f->id);
    check_same_array(f->type, g->type, f->count * sizeof *f->type);
    check_same_array(f->element, g->element, f->count * sizeof *f->element);
    check_same_array(a->sequence->speed, b->sequence->speed, f->count * sizeof *a->sequence->speed);
    assert_int_equal(f->columns, g->columns);
    for (uint32_t i = 0; i < f->columns; i++) {
        assert_string_equal(f->column[i].name, g->column[i].name);
        check_same_array(f->column[i].value, g->column[i].value, f->count * sizeof(float));
    }
}

/* What a survey has read comes from memory, as far as that may reach, and is what the file has; also after frames
 * that were counted alone. */
TEST(frames_of_a_survey_are_kept)
{
    static const size_t budgets[] = {0, 3000, 1 << 20};
    static survey found;
    char error[300];
    for (uint32_t turn = 0; turn < 3 * TEST_COUNT(budgets); turn++) {
        const size_t most = budgets[turn / 3];
        const uint64_t step = turn % 3 == 2 ? 7 : 1;
        const survey_plan plan = {
            .most = turn % 3 == 2 ? FRAMES / 2 : UINT64_MAX, .count = 1, .quiet = 1, .stop = &stop, .context = context};
        frame_source kept, fresh;
        uint64_t number = 0;
        open_run(&kept);
        open_run(&fresh);
        assert_int_equal(cgt_frame_sequence_bind(kept.sequence, cgt_expression_parse("x + y", error, sizeof error),
                                                 error, sizeof error),
                         0);
        assert_int_equal(cgt_frame_sequence_bind(fresh.sequence, cgt_expression_parse("x + y", error, sizeof error),
                                                 error, sizeof error),
                         0);
        kept.keep.most = most;
        assert_int_equal(survey_run(&kept, &plan, &found, error, sizeof error), 0);
        assert_true(kept.keep.bytes <= most && (kept.keep.bytes > 0) == (most > 0));
        assert_int_equal(kept.keep.is_keeping, 0);
        for (; number < FRAMES; number += step) {
            assert_int_equal(frame_source_read(&kept, number, error, sizeof error), 1);
            assert_int_equal(frame_source_read(&fresh, number, error, sizeof error), 1);
            check_same_frame(&kept, &fresh);
            double sum[3], expected[3];
            cgt_expression_values(kept.sequence->formulas[0], 0, kept.sequence->frame.count, sum);
            cgt_expression_values(fresh.sequence->formulas[0], 0, fresh.sequence->frame.count, expected);
            assert_memory_equal(sum, expected, kept.sequence->frame.count * sizeof *sum);
        }
        /* all of it was kept: the file was not read again */
        assert_int_equal(kept.keep.file_next == 0, most > 100000 && plan.most == UINT64_MAX);
        assert_int_equal(frame_source_read(&kept, number, error, sizeof error), 0);
        cgt_expression_free(kept.sequence->formulas[0]);
        cgt_expression_free(fresh.sequence->formulas[0]);
        close_run(&kept);
        close_run(&fresh);
    }
}

/* Sphere k is at k + number, so that each frame is known; the file may end in the midst of one more. */
static void write_large(const char *name, uint32_t frames, uint32_t spheres, int is_cut)
{
    FILE *const file = fopen(name, "w");
    assert_non_null(file);
    for (uint32_t i = 0; i < frames + (is_cut ? 1 : 0); i++) {
        fprintf(file, "%u\n\n", spheres);
        for (uint32_t k = 0; k < (i < frames ? spheres : 10000); k++)
            fprintf(file, "%s %u 0.%u 1\n", k % 5 ? "C" : "O", k + i, k);
    }
    assert_int_equal(fclose(file), 0);
}

static int stop_at_second(void *user, char *error, size_t error_size)
{
    (void)error;
    (void)error_size;
    stop = ++*(uint32_t *)user == 2;
    return 0;
}

/* Large frames are read ahead, by a thread, and keep the arrays that they were read into. */
TEST(large_frames_are_kept_and_read_ahead)
{
    enum { LARGE = 70000, COUNT = 5 };
    static const size_t budgets[] = {0, 2 * LARGE * 21 + 10000, SIZE_MAX};
    static survey found;
    char name[] = "frame_source_ahead_XXXXXX", error[300];
    const int descriptor = mkstemp(name);
    assert_true(descriptor >= 0 && close(descriptor) == 0);
    for (uint32_t turn = 0; turn < 2 * TEST_COUNT(budgets); turn++) {
        const int is_cut = (int)(turn % 2);
        const survey_plan plan = {.most = UINT64_MAX, .quiet = 1, .stop = &stop, .context = context};
        frame_source kept, fresh;
        uint32_t looked = 0;
        survey_walk stopped = {.most = UINT64_MAX, .quiet = 1, .stop = &stop, .look = stop_at_second, .user = &looked};
        write_large(name, COUNT, LARGE, is_cut);
        open_file(&kept, name);
        open_file(&fresh, name);
        kept.keep.most = budgets[turn / 2];
        assert_int_equal(survey_run(&kept, &plan, &found, error, sizeof error), 0);
        assert_true(found.frames == COUNT && found.is_cut == is_cut);
        assert_true(kept.keep.bytes <= kept.keep.most && (kept.keep.bytes > 0) == (kept.keep.most > 0));
        for (uint64_t number = 0; number < COUNT; number++) {
            assert_int_equal(frame_source_read(&kept, number, error, sizeof error), 1);
            assert_int_equal(frame_source_read(&fresh, number, error, sizeof error), 1);
            check_same_frame(&kept, &fresh);
            assert_int_equal(frame_keep_has(&kept.keep, &kept.sequence->frame),
                             number < 2 ? turn > 1 : kept.keep.most == SIZE_MAX);
            kept.sequence->frame.xyzr += 4; /* as unwrapped places are not those that are kept */
            assert_int_equal(frame_keep_has(&kept.keep, &kept.sequence->frame), 0);
        }
        assert_int_equal(frame_source_read(&kept, COUNT, error, sizeof error), is_cut ? -1 : 0);
        assert_true(!is_cut || strstr(error, "the file ends after 10000 of 70000 spheres"));
        close_run(&kept);
        kept = fresh;
        kept.keep.most = budgets[turn / 2];
        assert_int_equal(frame_source_rewind(&kept, error, sizeof error), 0);
        assert_int_equal(survey_walk_run(&stopped, &kept, error, sizeof error), -1); /* while one is read */
        assert_string_equal(error, "interrupted");
        stop = 0;
        close_run(&kept);
    }
    assert_int_equal(unlink(name), 0);
}

TEST(copies_outlive_the_frame)
{
    frame_copy copy = {0};
    char error[300];
    frame_source source;
    open_run(&source);
    for (uint64_t number = 0; number < 10; number++) {
        assert_int_equal(frame_source_read(&source, number, error, sizeof error), 1);
        assert_int_equal(cgt_frame_copy_set(&copy, &source.sequence->frame), 0);
        assert_int_equal(frame_source_read(&source, number + 1, error, sizeof error), 1); /* writes over its arrays */
        assert_int_equal(copy.frame.number, number);
        assert_true(copy.frame.xyzr[0] == (float)(number * (number + 1) / 2));
        frame_source_rewind(&source, error, sizeof error);
    }
    cgt_frame_copy_free(&copy);
    close_run(&source);
}

/* Types are told apart beyond the colours of the palette; of those that are too high the
 * largest is known. */
TEST(surveys_tell_high_types)
{
    static survey result;
    static const float xyzr[4 * 4];
    static const uint32_t type[] = {3, 1500, SURVEY_TYPES - 1, SURVEY_TYPES};
    survey_team team;
    uint32_t found = 0;
    frame_sequence sequence = {
        .wants_kinds = 1,
        .frame = {.kind = CGT_TRAJECTORY_SPHERES, .count = 4, .xyzr = xyzr, .type = type, .angstrom = 1.0f}};
    cgt_survey_begin(&team, &sequence, NULL, context, &result);
    cgt_survey_look(&team);
    cgt_survey_end(&team);
    for (uint32_t k = 0; k < SURVEY_TYPES; k++)
        found += result.has_types[k / 8] >> k % 8 & 1u;
    assert_int_equal(found, 3);
    for (int k = 0; k < 3; k++)
        assert_true(result.has_types[type[k] / 8] >> type[k] % 8 & 1u);
    assert_int_equal(result.type_max, SURVEY_TYPES);
}

SEEDED_SUITE("test_frame_source", write_run, remove_run)
