/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Statistics and messages of a commit. */
#include "builders/report.h"
#include "scene/check_geometry.h"

#include <stdio.h>

void cgt_report_scene(cgt_scene *scene, const cgt_primitive_bounds *s)
{
    cgt_scene_statistics *st = &scene->statistics;
    st->structure = scene->committed_scene.structure;
    st->skipped_not_finite = s->skipped_not_finite;
    st->skipped_radius = s->skipped_radius;
    st->skipped_degenerate = s->skipped_degenerate;
    for (int a = 0; a < 3; a++) {
        st->bounds_min[a] = s->min[a];
        st->bounds_max[a] = s->max[a];
    }
    st->bytes = cgt_scene_bytes(scene);
}

void cgt_report_local_store(cgt_scene *scene, size_t sphere_bytes, size_t triangle_bytes)
{
    const cgt_primitives *prims = &scene->committed_scene.prims;
    cgt_research_scene_statistics *st = &scene->research_statistics;
    st->local_store_bytes =
        scene->statistics.structure_bytes + prims->spheres * sphere_bytes + prims->triangles * triangle_bytes;
    st->fits_local_store = st->local_store_bytes + (64u << 10) <= 256u << 10;
}

/* A radius that was forgotten draws nothing. */
static void warn_of_points(const cgt_scene *scene, const cgt_log_hook *log)
{
    const cgt_geometry *geometry = scene->buffer[CGT_BUFFER_GEOMETRY].data;
    const cgt_primitives *prims = &scene->committed_scene.prims;
    for (uint32_t k = 0; k < prims->arrays; k++) {
        const cgt_primitive_array *a = &prims->array[k];
        const cgt_geometry *g = &geometry[a->geometry];
        const bool capsules = a->kind == CGT_KIND_CAPSULES;
        char text[CGT_MESSAGE_BYTES];
        if (a->kind == CGT_KIND_TRIANGLES)
            continue;
        const cgt_radii r = capsules ? CGT_RADII_OF(&g->capsules) : CGT_RADII_OF(&g->spheres);
        if (r.radii.data || r.radius != 0)
            continue;
        snprintf(text, sizeof text, "commit: geometry %u: %u %s of radius 0, which almost no ray hits", a->geometry,
                 a->count, capsules ? "capsules" : "spheres");
        log->write(log->user, CGT_LOG_LEVEL_WARNING, text);
    }
}

void cgt_log_commit(const cgt_scene *scene)
{
    const cgt_scene_statistics *st = &scene->statistics;
    const uint32_t *resolution = scene->research_statistics.resolution;
    const cgt_log_hook *log = &scene->context->log;
    char text[CGT_MESSAGE_BYTES];
    if (!log->write || scene->band_of)
        return;
    if (st->skipped_not_finite || st->skipped_radius || st->skipped_degenerate) {
        snprintf(text, sizeof text,
                 "commit: of %u primitives %u skipped: not finite, %u skipped: negative radius, %u skipped: no area",
                 st->primitives, st->skipped_not_finite, st->skipped_radius, st->skipped_degenerate);
        log->write(log->user, CGT_LOG_LEVEL_WARNING, text);
    }
    warn_of_points(scene, log);
    snprintf(text, sizeof text, "commit: %u spheres, %u triangles, %u capsules, %ux%ux%u cells, %.3f ms; %s",
             st->spheres, st->triangles, st->capsules, resolution[0], resolution[1], resolution[2], st->commit_ms,
             st->reason);
    log->write(log->user, CGT_LOG_LEVEL_INFO, text);
}
