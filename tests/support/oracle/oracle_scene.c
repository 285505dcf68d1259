/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scenes for the oracle from arrays as the library takes them. */
#include "support/oracle/oracle.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/oracle/oracle_filter.h"

static void *resize(const void *memory, size_t count, size_t bytes)
{
    void *larger = count <= SIZE_MAX / bytes ? realloc((void *)(uintptr_t)memory, count * bytes) : NULL;
    if (!larger) {
        fprintf(stderr, "oracle: no memory for %zu primitives\n", count);
        exit(1);
    }
    return larger;
}

/* Makes room for `more` primitives, at least one; returns the first. */
static oracle_primitive *grow(oracle_scene *scene, uint32_t more)
{
    if (more > ORACLE_NONE - ORACLE_BLOCK - scene->count) {
        fprintf(stderr, "oracle: %u and %u primitives are too many\n", (unsigned)scene->count, (unsigned)more);
        exit(1);
    }
    oracle_primitive *primitive = resize(scene->primitive, scene->count + more, sizeof *primitive);
    scene->primitive = primitive;
    return primitive + scene->count;
}

/* Counts the primitives that grow made room for, and bounds them, starting at the last block that was not full. */
static void finish(oracle_scene *scene, uint32_t more)
{
    uint32_t block = scene->count / ORACLE_BLOCK;
    scene->count += more;
    const uint32_t blocks = (scene->count + ORACLE_BLOCK - 1) / ORACLE_BLOCK;
    oracle_bounds *bounds = resize(scene->bounds, blocks, sizeof *bounds);
    for (; block < blocks; block++) {
        const uint32_t first = block * ORACLE_BLOCK, left = scene->count - first;
        oracle_bound(scene->primitive + first, left < ORACLE_BLOCK ? left : ORACLE_BLOCK, &bounds[block]);
    }
    scene->bounds = bounds;
}

void oracle_scene_add_spheres(oracle_scene *scene, uint32_t geometry, const float (*sphere)[4], uint32_t count)
{
    if (count == 0)
        return;
    oracle_primitive *p = grow(scene, count);
    for (uint32_t i = 0; i < count; i++) {
        p[i] = (oracle_primitive){.kind = ORACLE_SPHERE, .geometry = geometry, .primitive = i};
        memcpy(p[i].data, sphere[i], sizeof sphere[i]);
    }
    finish(scene, count);
}

void oracle_scene_add_triangles(oracle_scene *scene, uint32_t geometry, const float (*vertex)[3], uint32_t vertex_count,
                                const uint32_t (*index)[3], uint32_t count)
{
    if (count == 0)
        return;
    oracle_primitive *p = grow(scene, count);
    for (uint32_t i = 0; i < count; i++) {
        p[i] = (oracle_primitive){.kind = ORACLE_TRIANGLE, .geometry = geometry, .primitive = i};
        for (uint32_t k = 0; k < 3; k++) {
            const uint64_t j = index ? index[i][k] : 3 * (uint64_t)i + k;
            if (j >= vertex_count) {
                fprintf(stderr, "oracle: triangle %u of geometry %u has vertex %llu of %u\n", (unsigned)i,
                        (unsigned)geometry, (unsigned long long)j, (unsigned)vertex_count);
                exit(1);
            }
            memcpy(p[i].data + 3 * k, vertex[j], sizeof vertex[j]);
        }
    }
    finish(scene, count);
}

void oracle_scene_add_capsules(oracle_scene *scene, uint32_t geometry, const float (*capsule)[7], uint32_t count)
{
    if (count == 0)
        return;
    oracle_primitive *p = grow(scene, count);
    for (uint32_t i = 0; i < count; i++) {
        p[i] = (oracle_primitive){.kind = ORACLE_CAPSULE, .geometry = geometry, .primitive = i};
        memcpy(p[i].data, capsule[i], sizeof capsule[i]);
    }
    finish(scene, count);
}

void oracle_scene_free(oracle_scene *scene)
{
    free((void *)(uintptr_t)scene->primitive);
    free((void *)(uintptr_t)scene->bounds);
    *scene = (oracle_scene){0};
}
