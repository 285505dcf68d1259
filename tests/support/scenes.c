/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Contexts, clouds of spheres and scenes for tests. */
#include "support/scenes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/memory.h"
#include "model/triangle_cluster.h"

/* ---- contexts ---- */

const char *variant_next(size_t *index)
{
    for (const char *name; (name = cgt_get_variant_names()[*index]);) {
        ++*index;
        if (test_variant_runs(name))
            return name;
    }
    return NULL;
}

bool variant_is_outer(const char *name)
{
    const char *first = NULL, *last = NULL;
    FOR_EACH_VARIANT(variant)
    {
        first = first ? first : variant;
        last = variant;
    }
    return first && (!strcmp(name, first) || !strcmp(name, last));
}

bool clusters_always(void)
{
    const cgt_primitives nothing = {0};
    float area;
    return cgt_choose_clusters(&nothing, &area) == CGT_CLUSTERS_ALL;
}

cgt_context *context_make(uint32_t threads, const char *variant)
{
    cgt_context_options options;
    cgt_context *context = NULL;
    cgt_context_options_init(&options);
    options.threads = threads;
    options.variant = variant;
    assert_int_equal(cgt_context_create(&options, &context), CGT_OK);
    return context;
}

static void *count_allocation(void *user, size_t bytes, size_t alignment)
{
    ++*(unsigned *)user;
    return cgt_memory_default().allocate(NULL, bytes, alignment);
}

cgt_context *context_counting(unsigned *allocations)
{
    cgt_context_options options;
    cgt_context *context = NULL;
    cgt_context_options_init(&options);
    options.threads = 2;
    options.memory = (cgt_memory_hooks){allocations, count_allocation, cgt_memory_default().release};
    assert_int_equal(cgt_context_create(&options, &context), CGT_OK);
    return context;
}

const char *context_message(const cgt_context *context)
{
    static char text[512];
    text[0] = 0;
    cgt_context_get_error_message(context, text, sizeof text);
    return text;
}

/* ---- clouds ---- */

const char *cloud_name(cloud_kind kind)
{
    static const char *const name[CLOUD_KINDS] = {"uniform", "clustered", "planar", "mixed", "far", "lattice", "line"};
    return name[kind];
}

static void place_sphere(test_random *r, const cloud *c, cloud_kind kind, const float (*clump)[3], int flat, float q[4])
{
    const float size = c->reach / cbrtf((float)c->count + 1);
    const float *around = kind == CLOUD_CLUSTERED ? clump[random_below(r, 8)] : c->middle;
    const float reach = kind == CLOUD_CLUSTERED ? 0.05f * c->reach : c->reach;
    for (int a = 0; a < 3; a++)
        q[a] = random_float(r, around[a] - reach, around[a] + reach);
    q[3] = random_float(r, 0.3f, 0.6f) * size;
    if (kind == CLOUD_PLANAR)
        q[flat] = c->middle[flat];
    if (kind == CLOUD_LINE)
        for (int a = 0; a < 3; a++)
            q[a] = a == flat ? q[a] : c->middle[a];
    if (kind == CLOUD_MIXED) {
        const float factor = random_log(r, 1e-3f, 1e3f); /* the largest would hide everything else: few of them */
        q[3] *= factor > 10 && random_below(r, 20) ? 1 : factor;
    }
    if (kind == CLOUD_LATTICE) {
        for (int a = 0; a < 3; a++)
            q[a] = rintf(q[a] / size) * size;
        q[3] = random_below(r, 2) ? size : size / 2;
    }
}

cloud cloud_make(test_random *r, cloud_kind kind, uint32_t count)
{
    cloud c = {.count = count, .reach = kind == CLOUD_LATTICE ? 8 : random_log(r, 0.5f, 50)};
    float clump[8][3];
    const int flat = (int)random_below(r, 3);
    c.sphere = malloc((count + 1) * sizeof *c.sphere);
    assert_non_null(c.sphere);
    for (int a = 0; a < 3; a++) {
        const float offset = kind == CLOUD_FAR ? random_log(r, 1e3f, 1e5f) : 0;
        c.middle[a] = kind == CLOUD_LATTICE ? 0 : random_float(r, -1, 1) + offset;
        for (int k = 0; k < 8; k++)
            clump[k][a] = c.middle[a] + random_float(r, -1, 1) * c.reach;
    }
    for (uint32_t i = 0; i < count; i++)
        place_sphere(r, &c, kind, (const float(*)[3])clump, flat, c.sphere[i]);
    return c;
}

void cloud_free(cloud *c)
{
    free(c->sphere);
    *c = (cloud){0};
}

/* ---- scenes ---- */

cgt_spheres spheres_of(const float (*sphere)[4], uint32_t count)
{
    return (cgt_spheres){.count = count,
                         .centers = cgt_floats(sphere ? sphere[0] : NULL, sizeof sphere[0]),
                         .radii = cgt_floats(sphere ? &sphere[0][3] : NULL, sizeof sphere[0])};
}

cgt_scene *scene_of(cgt_context *context, const cgt_scene_options *options, const float (*sphere)[4], uint32_t count)
{
    const cgt_spheres spheres = spheres_of(sphere, count);
    cgt_scene *scene = NULL;
    uint32_t geometry = CGT_INVALID_ID;
    assert_int_equal(cgt_scene_create(context, options, &scene), CGT_OK);
    assert_int_equal(cgt_scene_set_spheres(scene, &geometry, &spheres), CGT_OK);
    assert_int_equal(geometry, 0);
    if (cgt_scene_commit(scene) != CGT_OK)
        fail_msg("%s", context_message(context));
    return scene;
}
