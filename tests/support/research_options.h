/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The options of cgt.h and research.h in one struct that can be copied and returned: tests vary both together. */
#ifndef RESEARCH_OPTIONS_H
#define RESEARCH_OPTIONS_H

#include <string.h>

#include <cgt/research.h>

typedef struct test_scene_options {
    cgt_structure structure;
    cgt_ray_kind rays;
    uint32_t resolution[3];
    cgt_kd_layout kd_layout;
    uint32_t kd_break_level;
} test_scene_options;

/* The same in the library's own types: a pointer that is valid in the enclosing block. */
#define SCENE_OPTIONS(o)                                                                                               \
    (&(cgt_scene_options){.structure = (o)->structure,                                                                 \
                          .rays = (o)->rays,                                                                           \
                          .research = &(cgt_research_scene_options){                                                   \
                              .resolution = {(o)->resolution[0], (o)->resolution[1], (o)->resolution[2]},              \
                              .kd_layout = (o)->kd_layout,                                                             \
                              .kd_break_level = (o)->kd_break_level}})

typedef struct test_trace_options {
    cgt_precision precision;
    uint32_t packet;
    cgt_tile_shape tile;
    cgt_loop loop;
    cgt_cull cull;
    cgt_mailbox mailbox;
    cgt_kd_traversal kd_traversal;
    cgt_triangle_test triangle_test;
    cgt_trace_statistics *statistics;
    cgt_research_trace_statistics *research_statistics;
} test_trace_options;

#define TRACE_OPTIONS(o)                                                                                               \
    (&(cgt_trace_options){.precision = (o)->precision,                                                                 \
                          .statistics = (o)->statistics,                                                               \
                          .research = &(cgt_research_trace_options){.packet = (o)->packet,                             \
                                                                    .tile = (o)->tile,                                 \
                                                                    .loop = (o)->loop,                                 \
                                                                    .cull = (o)->cull,                                 \
                                                                    .mailbox = (o)->mailbox,                           \
                                                                    .kd_traversal = (o)->kd_traversal,                 \
                                                                    .triangle_test = (o)->triangle_test,               \
                                                                    .statistics = (o)->research_statistics}})

/* The research statistics of a scene's last commit. */
static inline cgt_research_scene_statistics research_of(const cgt_scene *scene)
{
    cgt_research_scene_statistics research;
    memset(&research, 0xee, sizeof research);
    (void)cgt_research_get_scene_statistics(scene, &research);
    return research;
}

static inline cgt_mailbox mailbox_of(unsigned on) { return on ? CGT_MAILBOX_ON : CGT_MAILBOX_OFF; }

#endif
