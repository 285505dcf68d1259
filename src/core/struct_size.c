/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The sizes of the API's structs, by name: bindings compare them with the definitions that they were made from. */
#include <string.h>

#include <cgt/all_hits.h>
#include <cgt/bounces.h>
#include <cgt/cgt.h>
#include <cgt/research.h>

#define STRUCT(name)                                                                                                   \
    {                                                                                                                  \
#name, sizeof(name)                                                                                            \
    }

static const struct {
    const char *name;
    size_t bytes;
} table[] = {
    STRUCT(cgt_memory_hooks),
    STRUCT(cgt_log_hook),
    STRUCT(cgt_task_runner),
    STRUCT(cgt_context_options),
    STRUCT(cgt_spheres),
    STRUCT(cgt_triangles),
    STRUCT(cgt_capsules),
    STRUCT(cgt_scene_options),
    STRUCT(cgt_scene_statistics),
    STRUCT(cgt_trace_statistics),
    STRUCT(cgt_trace_options),
    STRUCT(cgt_camera),
    STRUCT(cgt_tile),
    STRUCT(cgt_frame),
    STRUCT(cgt_rays),
    STRUCT(cgt_hits),
    STRUCT(cgt_single_ray),
    STRUCT(cgt_single_hit),
    STRUCT(cgt_light),
    STRUCT(cgt_points),
    STRUCT(cgt_shadow_options),
    STRUCT(cgt_ambient_options),
    STRUCT(cgt_all_hits_options),
    STRUCT(cgt_hit_rows),
    STRUCT(cgt_surface_hit),
    STRUCT(cgt_inside_options),
    STRUCT(cgt_media),
    STRUCT(cgt_surfaces),
    STRUCT(cgt_bounced_rays),
    STRUCT(cgt_research_scene_options),
    STRUCT(cgt_research_scene_statistics),
    STRUCT(cgt_research_trace_statistics),
    STRUCT(cgt_research_trace_options),
};

size_t cgt_get_struct_size(const char *name)
{
    for (size_t i = 0; name && i < sizeof table / sizeof *table; i++)
        if (!strcmp(name, table[i].name))
            return table[i].bytes;
    return 0;
}
