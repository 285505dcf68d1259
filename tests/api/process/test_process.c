/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Contexts and the process: a forked child has no workers, a program may close the shared library while workers run,
 * and several copies of the library live in one process. */
#define _GNU_SOURCE
#include "api/calls.h"
#include "support/suite.h"

#include <dlfcn.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#define PATIENCE 60u

/* Runs action in a child; the test fails where it does not return 0 in time. */
static void expect_in_child(int (*action)(void *), void *argument)
{
    int status = -1;
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        alarm(PATIENCE);
        _exit(action(argument));
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 0);
}

/* ---- fork ---- */

typedef struct family {
    api_world world;
    cgt_context *context;
    cgt_scene *scene;
    api_results *expected;
} family;

static bool trace_as_expected(const family *f)
{
    api_results *r = api_results_make(&f->world, f->scene);
    const bool right = r && api_trace_all(r) == CGT_OK && api_results_equal(r, f->expected);
    if (r)
        api_results_free(r);
    return right;
}

/* Commits and traces as the parent did, then releases everything. */
static int use_in_child(void *argument)
{
    family *f = argument;
    if (!trace_as_expected(f))
        return 1;
    if (cgt_scene_commit(f->scene) != CGT_OK || !trace_as_expected(f))
        return 2;
    if (cgt_scene_set_spheres(f->scene, NULL, NULL) == CGT_OK)
        return 3;
    cgt_scene_release(f->scene);
    cgt_context_release(f->context);
    return 0;
}

/* A child's own contexts have workers. */
static int create_in_child(void *argument)
{
    family own = *(family *)argument;
    cgt_context_options options;
    cgt_context_options_init(&options);
    options.threads = 3;
    if (cgt_context_create(&options, &own.context) != CGT_OK)
        return 1;
    own.scene = api_scene_make(&own.world, own.context, NULL);
    return own.scene && cgt_scene_commit(own.scene) == CGT_OK ? use_in_child(&own) : 2;
}

TEST(a_child_needs_no_workers)
{
    family f = {.world = api_world_make(1, 5000, 2000, 200, 130), .context = context_make(4, NULL)};
    f.scene = api_scene_make(&f.world, f.context, NULL);
    f.expected = f.scene ? api_results_make(&f.world, f.scene) : NULL;
    assert_non_null(f.expected);
    assert_int_equal(cgt_scene_commit(f.scene), CGT_OK);
    for (int i = 0; i < 10; i++) { /* workers spin for a while after a frame, then they sleep */
        assert_int_equal(api_trace_all(f.expected), CGT_OK);
        if (i % 2)
            usleep(2000);
        expect_in_child(use_in_child, &f);
    }
    expect_in_child(create_in_child, &f);
    assert_true(trace_as_expected(&f));
    api_results_free(f.expected);
    cgt_scene_release(f.scene);
    cgt_context_release(f.context);
    api_world_free(&f.world);
}

/* ---- dlclose ---- */

#ifdef CGT_SHARED_LIBRARY
typedef cgt_result create_function(const cgt_context_options *, cgt_context **);
typedef void release_function(cgt_context *);

/* Closes the library while workers sleep in it, and while they spin; then uses it again. */
static int close_in_child(void *argument)
{
    (void)argument;
    for (int i = 0; i < 4; i++) {
        create_function *create;
        release_function *release;
        cgt_context *context = NULL;
        cgt_context_options options = {.threads = 4};
        void *library = dlopen(CGT_SHARED_LIBRARY, RTLD_NOW | RTLD_LOCAL);
        if (!library)
            return 1;
        *(void **)(void *)&create = dlsym(library, "cgt_context_create");
        *(void **)(void *)&release = dlsym(library, "cgt_context_release");
        if (!create || !release || create(&options, &context) != CGT_OK)
            return 2;
        if (i % 2)
            usleep(20000);
        if (dlclose(library) != 0)
            return 3;
        usleep(20000);
        release(context);
    }
    return 0;
}

TEST(the_library_stays_while_workers_run) { expect_in_child(close_in_child, NULL); }

/* ---- copies ---- */

typedef double trace_function(uint32_t threads, create_function **create);

/* The plugin's function, and whether the plugin calls its own library. */
typedef struct loaded_plugin {
    trace_function *trace;
    create_function *shared;
    double sum[4];
} loaded_plugin;

static void *trace_in_plugin(void *argument)
{
    loaded_plugin *p = argument;
    create_function *create = NULL;
    for (uint32_t i = 0; i < 4; i++) {
        p->sum[i] = p->trace(1 + i % 3, &create);
        if (create == p->shared || create == cgt_context_create)
            p->sum[i] = -1;
    }
    return NULL;
}

/* This program has the archive, the plugin has another copy of it, and the shared library is open to all. */
static int load_copies(void *argument)
{
    loaded_plugin p[3] = {0};
    pthread_t thread[3];
    cgt_context *contexts[2] = {NULL};
    (void)argument;
    for (int round = 0; round < 3; round++) {
        void *library = dlopen(CGT_SHARED_LIBRARY, RTLD_NOW | RTLD_GLOBAL), *plugin = dlopen(CGT_PLUGIN, RTLD_NOW);
        if (!library || !plugin)
            return 1;
        for (int i = 0; i < 3; i++) {
            *(void **)(void *)&p[i].trace = dlsym(plugin, "plugin_trace");
            *(void **)(void *)&p[i].shared = dlsym(library, "cgt_context_create");
            if (!p[i].trace || !p[i].shared || dlsym(plugin, "cgt_context_create"))
                return 2; /* the plugin shows no function of the library */
        }
        if (p[0].shared(&(cgt_context_options){.threads = 2}, &contexts[0]) != CGT_OK ||
            cgt_context_create(&(cgt_context_options){.threads = 2}, &contexts[1]) != CGT_OK)
            return 3;
        for (int i = 0; i < 3; i++)
            if (pthread_create(&thread[i], NULL, trace_in_plugin, &p[i]))
                return 4;
        for (int i = 0; i < 3; i++)
            pthread_join(thread[i], NULL);
        for (int i = 0; i < 12; i++)
            if (!(p[i / 4].sum[i % 4] > 0) || p[i / 4].sum[i % 4] != p[0].sum[0])
                return 5;
        release_function *release;
        *(void **)(void *)&release = dlsym(library, "cgt_context_release");
        release(contexts[0]);
        cgt_context_release(contexts[1]);
        if (dlclose(plugin) != 0 || dlclose(library) != 0) /* the plugin has released its contexts */
            return 6;
    }
    return 0;
}

TEST(copies_do_not_meet) { expect_in_child(load_copies, NULL); }
#endif

SEEDED_SUITE("test_process", NULL, NULL)
