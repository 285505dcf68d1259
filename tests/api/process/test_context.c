/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Contexts: options, variants, messages, the log, lifetime, and the environment variable that masks the CPU. */
#define _GNU_SOURCE
#include "support/scenes.h"
#include "support/suite.h"

#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- options ---- */

typedef struct log_record {
    unsigned lines, errors;
    bool bad_line;                /* empty, or with a line feed */
    char last[300], warning[300]; /* the last line, the last warning */
    cgt_log_level level;
} log_record;

static void record_log(void *user, cgt_log_level level, const char *message)
{
    log_record *log = user;
    log->lines++;
    log->errors += level == CGT_LOG_LEVEL_ERROR;
    log->bad_line |= !*message || strchr(message, '\n');
    log->level = level;
    snprintf(log->last, sizeof log->last, "%s", message);
    if (level == CGT_LOG_LEVEL_WARNING)
        snprintf(log->warning, sizeof log->warning, "%s", message);
}

static cgt_context_options logged_options(log_record *log)
{
    cgt_context_options options;
    cgt_context_options_init(&options);
    options.threads = 1;
    options.log = (cgt_log_hook){log, record_log};
    return options;
}

static void never_run(void *argument, uint32_t index)
{
    (void)argument;
    fail_msg("task %u runs", index);
}

static void expect_refused(const cgt_context_options *options, log_record *log, cgt_result expected, const char *word)
{
    cgt_context *context = (cgt_context *)(void *)log; /* anything but NULL */
    *log = (log_record){0};
    assert_int_equal(cgt_context_create(options, &context), expected);
    if (context) {
        char text[300];
        cgt_scene *scene;
        assert_int_equal(cgt_context_get_error_message(context, text, sizeof text), strlen(log->last));
        assert_string_equal(text, log->last);
        assert_int_equal(cgt_scene_create(context, NULL, &scene), expected);
        assert_string_equal(cgt_context_get_variant(context), "");
        assert_int_equal(cgt_context_get_threads(context), 0);
        assert_int_equal(cgt_context_run_tasks(context, never_run, NULL, 1), expected);
        cgt_context_release(context);
    } else {
        assert_int_equal(expected, CGT_ERROR_OUT_OF_MEMORY);
    }
    assert_int_equal(log->errors, 1);
    assert_false(log->bad_line);
    if (!strstr(log->last, word))
        fail_msg("\"%s\" does not mention %s", log->last, word);
}

static void run_one(void *user, cgt_task *task, void *argument, uint32_t count)
{
    (void)user;
    for (uint32_t i = 0; i < count; i++)
        task(argument, i);
}

static void *never_allocate(void *user, size_t bytes, size_t alignment)
{
    (void)user;
    fail_msg("allocate was called: %zu bytes, aligned to %zu", bytes, alignment);
    return NULL;
}

static void never_release(void *user, void *memory, size_t bytes)
{
    (void)user;
    fail_msg("release was called: %zu bytes at %p", bytes, memory);
}

TEST(bad_options_are_refused)
{
    log_record log;
    cgt_context_options options = logged_options(&log);
    options.variant = "mmx";
    expect_refused(&options, &log, CGT_ERROR_INVALID_ARGUMENT, "variant");
    options.variant = "";
    expect_refused(&options, &log, CGT_ERROR_INVALID_ARGUMENT, "variant");
    options = logged_options(&log);
    options.threads = 1025;
    expect_refused(&options, &log, CGT_ERROR_INVALID_ARGUMENT, "threads");
    options.tasks.run = run_one; /* then the number is ignored */
    cgt_context *context = NULL;
    assert_int_equal(cgt_context_create(&options, &context), CGT_OK);
    assert_int_equal(cgt_context_get_threads(context), 0);
    cgt_context_release(context);
    options = logged_options(&log);
    options.memory.allocate = never_allocate;
    expect_refused(&options, &log, CGT_ERROR_INVALID_ARGUMENT, "memory");
    options.memory.allocate = NULL;
    options.memory.release = never_release;
    expect_refused(&options, &log, CGT_ERROR_INVALID_ARGUMENT, "memory");
    assert_int_equal(cgt_context_create(NULL, NULL), CGT_ERROR_INVALID_ARGUMENT);
}

TEST(defaults_use_every_cpu)
{
    cgt_context *context = NULL;
    cpu_set_t set;
    assert_int_equal(cgt_context_create(NULL, &context), CGT_OK);
    assert_int_equal(sched_getaffinity(0, sizeof set, &set), 0);
    assert_int_equal(cgt_context_get_threads(context), CPU_COUNT(&set));
    cgt_context_release(context);
    context = context_make(3, NULL);
    assert_int_equal(cgt_context_get_threads(context), 3);
    cgt_context_release(context);
    cgt_context_release(NULL);
}

TEST(variants_are_found_by_name)
{
    const char *widest = NULL;
    assert_string_equal(cgt_get_variant_names()[0], "portable");
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        assert_string_equal(cgt_context_get_variant(context), variant);
        cgt_context_release(context);
        widest = variant;
    }
    cgt_context *context = context_make(1, NULL);
    assert_string_equal(cgt_context_get_variant(context), widest);
    cgt_context_release(context);
}

TEST(results_and_version_have_strings)
{
    for (int i = CGT_OK; i <= CGT_ERROR_STOPPED + 1; i++) {
        const char *text = cgt_get_result_string((cgt_result)i);
        assert_true(text && strlen(text) > 5);
        for (int k = CGT_OK; k < i; k++)
            assert_string_not_equal(text, cgt_get_result_string((cgt_result)k));
    }
    assert_string_equal(cgt_get_result_string((cgt_result)-5), cgt_get_result_string((cgt_result)12345));
    assert_string_equal(cgt_get_version(), CGT_VERSION_STRING);
}

/* ---- messages ---- */

TEST(messages_are_kept_and_truncated)
{
    log_record log = {0};
    const cgt_context_options options = logged_options(&log);
    cgt_context *context = NULL;
    cgt_scene *scene = NULL;
    char text[300], cut[8];
    assert_int_equal(cgt_context_create(&options, &context), CGT_OK);
    assert_int_equal(cgt_context_get_error_message(context, text, sizeof text), 0);
    assert_string_equal(text, "");
    assert_int_equal(cgt_context_get_error_message(NULL, text, sizeof text), strlen("out of memory for a context"));
    assert_string_equal(text, "out of memory for a context");
    assert_int_equal(cgt_scene_create(context, NULL, &scene), CGT_OK);
    assert_int_equal(cgt_scene_remove_geometry(scene, 4711), CGT_ERROR_INVALID_ARGUMENT);
    const size_t length = cgt_context_get_error_message(context, NULL, 0);
    assert_int_equal(cgt_context_get_error_message(context, text, sizeof text), length);
    assert_int_equal(strlen(text), length);
    assert_non_null(strstr(text, "4711"));
    assert_string_equal(text, log.last); /* the log got the same words */
    assert_int_equal(log.level, CGT_LOG_LEVEL_ERROR);
    memset(cut, 'x', sizeof cut);
    assert_int_equal(cgt_context_get_error_message(context, cut, sizeof cut - 1), length);
    assert_int_equal(strlen(cut), sizeof cut - 2);
    assert_int_equal(cut[sizeof cut - 1], 'x');
    assert_memory_equal(cut, text, sizeof cut - 2);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK); /* success leaves the message */
    assert_int_equal(cgt_context_get_error_message(context, NULL, 0), length);
    cgt_scene_release(scene);
    cgt_context_release(context);
    assert_false(log.bad_line);
}

TEST(log_reports_skipped_primitives)
{
    log_record log = {0};
    const cgt_context_options options = logged_options(&log);
    cgt_context *context = NULL;
    const float sphere[2][4] = {{0, 0, 0, 1}, {0, 0, 0, -1}};
    assert_int_equal(cgt_context_create(&options, &context), CGT_OK);
    cgt_scene *scene = scene_of(context, NULL, sphere, 1);
    assert_true(log.lines > 0 && log.level == CGT_LOG_LEVEL_INFO);
    cgt_scene_release(scene);
    log = (log_record){0};
    scene = scene_of(context, NULL, sphere, 2);
    assert_true(log.lines >= 2 && !log.errors && !log.bad_line);
    assert_non_null(strstr(log.warning, "1 skipped: negative radius"));
    cgt_scene_release(scene);
    cgt_context_release(context);
}

static void *allocate_below_a_gigabyte(void *user, size_t bytes, size_t alignment)
{
    (void)user;
    return bytes < (size_t)1 << 30 ? aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment) : NULL;
}

static void release_memory(void *user, void *memory, size_t bytes)
{
    (void)user;
    (void)bytes;
    free(memory);
}

/* A radius that was forgotten, and counts that were never meant. */
TEST(forgotten_radii_and_counts_are_told)
{
    log_record log = {0};
    cgt_context_options options = logged_options(&log);
    cgt_context *context = NULL;
    cgt_scene *scene = NULL;
    const float center[3] = {0};
    const double exact[3] = {0};
    cgt_spheres spheres = {.count = 1, .centers = cgt_floats(center, 0)};
    options.memory = (cgt_memory_hooks){NULL, allocate_below_a_gigabyte, release_memory};
    assert_int_equal(cgt_context_create(&options, &context), CGT_OK);
    assert_int_equal(cgt_scene_create(context, NULL, &scene), CGT_OK);
    assert_int_equal(cgt_scene_set_spheres(scene, NULL, &spheres), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    assert_non_null(strstr(log.warning, "geometry 0: 1 spheres of radius 0"));
    log = (log_record){0};
    spheres.radius = 1;
    assert_int_equal(cgt_scene_set_spheres(scene, &(uint32_t){0}, &spheres), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    assert_string_equal(log.warning, "");
    spheres = (cgt_spheres){.count = (uint32_t)-5, .centers = cgt_doubles(exact, 0), .radius = 1};
    assert_int_equal(cgt_scene_set_spheres(scene, NULL, &spheres), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_ERROR_OUT_OF_MEMORY);
    assert_non_null(strstr(log.last, "for 65535 MB of float copies, most of geometry 1 with 4294967291 primitives"));
    cgt_scene_release(scene);
    cgt_context_release(context);
}

TEST(a_scene_keeps_its_context)
{
    const float sphere[1][4] = {{0, 0, 0, 1}};
    const truth_ray ray = {{0, 0, 5}, {0, 0, -1}, 0, 100};
    cgt_context *context = context_make(2, NULL);
    cgt_scene *scene = scene_of(context, NULL, sphere, 1), *other = scene_of(context, NULL, sphere, 0);
    cgt_context_release(context);
    cgt_scene_release(other);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    assert_true(ray_trace(scene, ray).t == 4);
    cgt_scene_release(scene);
    cgt_scene_release(NULL);
}

/* ---- CGT_DISABLE_CPU, in child processes ---- */

#define REFUSED 100 /* UNSUPPORTED, with a message that names CGT_DISABLE_CPU */
#define UNKNOWN 101 /* INVALID_ARGUMENT, with such a message */

/* What a new context finds under the mask: the variant's index in cgt_get_variant_names, REFUSED or UNKNOWN. message
 * receives the reason. */
static int index_with_mask(const char *mask, const char *variant, char message[200])
{
    cgt_context *context = NULL;
    const cgt_context_options options = {.threads = 1, .variant = variant};
    assert_int_equal(setenv("CGT_DISABLE_CPU", mask, 1), 0);
    const cgt_result result = cgt_context_create(&options, &context);
    assert_int_equal(unsetenv("CGT_DISABLE_CPU"), 0);
    cgt_context_get_error_message(context, message, 200);
    if (result != CGT_OK) {
        cgt_context_release(context);
        assert_non_null(strstr(message, "CGT_DISABLE_CPU"));
        return result == CGT_ERROR_UNSUPPORTED ? REFUSED : result == CGT_ERROR_INVALID_ARGUMENT ? UNKNOWN : -1;
    }
    int place = 0;
    while (strcmp(cgt_get_variant_names()[place], cgt_context_get_variant(context)) != 0)
        place++;
    assert_string_equal(message, "");
    cgt_context_release(context);
    return place;
}

TEST(variants_can_be_masked)
{
    char message[200];
    int place[8], running = 0;
    for (int i = 0; cgt_get_variant_names()[i]; i++)
        if (test_variant_runs(cgt_get_variant_names()[i]))
            place[running++] = i;
    const int widest = place[running - 1];
    assert_int_equal(place[0], 0);
    assert_int_equal(index_with_mask("", NULL, message), widest);
    assert_int_equal(index_with_mask(",,", NULL, message), widest);
    assert_int_equal(index_with_mask("avx512,avx2,sse,neon", NULL, message), 0);
    assert_int_equal(index_with_mask("neon,,sse,avx512,avx2,", NULL, message), 0);
    assert_int_equal(index_with_mask("avx512,avx2,sse,neon", "portable", message), 0);
    assert_int_equal(index_with_mask("portable,avx512,avx2,sse,neon", NULL, message), REFUSED);
    assert_int_equal(index_with_mask("portable", "portable", message), REFUSED);
    assert_int_equal(index_with_mask("portable", NULL, message), running > 1 ? widest : REFUSED);
    /* with all wider variants masked, each variant is the widest; once masked itself, it is refused and the next
     * narrower one is the widest */
    char mask[100] = "";
    for (int k = running - 1; k > 0; k--) {
        const char *name = cgt_get_variant_names()[place[k]];
        assert_int_equal(index_with_mask(mask, NULL, message), place[k]);
        assert_int_equal(index_with_mask(mask, name, message), place[k]);
        snprintf(mask + strlen(mask), sizeof mask - strlen(mask), "%s%s", *mask ? "," : "", name);
        assert_int_equal(index_with_mask(mask, NULL, message), place[k - 1]);
        assert_int_equal(index_with_mask(mask, name, message), REFUSED);
        assert_int_equal(index_with_mask(name, name, message), REFUSED);
    }
}

TEST(unknown_variants_are_refused)
{
    static const char *const unknown[][2] = {
        {"sse4.1", "sse4.1"},
        {"sse4", "sse4"},
        {"SSE", "SSE"},
        {"avx9", "avx9"},
        {"avx51", "avx51"},
        {"avx5122", "avx5122"},
        {"sse ", "sse "},
        {"sse,avx9", "avx9"},
        {"avx9,sse", "avx9"},
        {" ", " "},
        {"sse:avx2", "sse:avx2"},
        {"a-name-that-is-longer-than-all-variants", "a-name-that-is-longer-than-all-\""}}; /* truncated */
    for (size_t i = 0; i < TEST_COUNT(unknown); i++)
        for (int named = 0; named < 2; named++) {
            char message[200], quoted[50];
            assert_int_equal(index_with_mask(unknown[i][0], named ? "portable" : NULL, message), UNKNOWN);
            snprintf(quoted, sizeof quoted, "\"%s", unknown[i][1]);
            assert_non_null(strstr(message, quoted));
        }
}

/* The message of a context whose creation failed is truncated to the caller's size, and always terminated. */
TEST(refusal_is_truncated)
{
    static const char sentence[] = "variant avx9: not in this build";
    const cgt_context_options options = {.variant = "avx9"};
    cgt_context *context;
    assert_int_equal(cgt_context_create(&options, &context), CGT_ERROR_INVALID_ARGUMENT);
    for (size_t size = 0; size <= sizeof sentence + 1; size++) {
        char text[64];
        memset(text, '#', sizeof text);
        assert_int_equal(cgt_context_get_error_message(context, text, size), strlen(sentence));
        const size_t stored = size > sizeof sentence ? sizeof sentence : size;
        for (size_t i = 0; i < sizeof text; i++)
            assert_int_equal(text[i], i >= stored ? '#' : i + 1 == stored ? 0 : sentence[i]);
    }
    cgt_context_release(context);
    assert_int_equal(cgt_context_create(&options, NULL), CGT_ERROR_INVALID_ARGUMENT);
}

int main(void)
{
    test_begin("test_context");
    unsetenv("CGT_DISABLE_CPU"); /* these tests set their own */
    return SUITE_RUN(NULL, NULL);
}
