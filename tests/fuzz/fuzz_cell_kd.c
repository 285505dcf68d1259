/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Fuzz target: the thesis' program on damaged images. The input makes triangles, of which the library builds kd-trees
 * with or without ropes, or bounding interval hierarchies, and a frame; then a list of damages: words of parts, nodes,
 * references, boxes with ropes, and triangles. The program, native, says that a tree is broken, breaks a rule of DMA,
 * or traces what is there; it touches no memory but its own and ends, and the PPE believes none of its answers.
 * Undamaged it succeeds, and its ids are numbers of triangles. */
#include <stdlib.h>
#include <string.h>

#include <cgt/research.h>

#include "cell/ppe/kd/kd_frame.h"
#include "cell/programs/kd/spe_kd.h"
#include "fuzz/fuzz.h"

#define MOST_EDGE 24u
#define MOST_TRIANGLES 40u
#define MOST_DAMAGES 12u
#define MOST_PARTS 2u
#define MOST_RAYS 2u

typedef struct world {
    cgt_context *context;
    cgt_scene *scene[MOST_PARTS];
    uint32_t parts;
} world;

static void make_part(fuzz_bytes *b, world *w, cgt_structure structure)
{
    static float corner[MOST_TRIANGLES][9];
    const cgt_research_scene_options research = {.kd_layout = (cgt_kd_layout)fuzz_below(b, 4), .kd_break_level = 2};
    const cgt_scene_options options = {.structure = structure, .research = &research};
    const uint32_t count = fuzz_below(b, MOST_TRIANGLES + 1);
    for (uint32_t i = 0; i < count; i++)
        for (int k = 0; k < 9; k++)
            corner[i][k] = fuzz_finite(b);
    const cgt_triangles triangles = {
        .count = count, .vertex_count = 3 * count, .vertices = cgt_floats(count ? &corner[0][0] : NULL, 0)};
    cgt_scene *scene;
    FUZZ_CHECK(cgt_scene_create(w->context, &options, &scene) == CGT_OK, "no scene");
    w->scene[w->parts++] = scene;
    FUZZ_CHECK(cgt_scene_set_triangles(scene, NULL, &triangles) == CGT_OK, "no triangles");
    FUZZ_CHECK(cgt_scene_commit(scene) == CGT_OK, "no tree");
}

static cgt_kd_frame_options make_options(fuzz_bytes *b, const cgt_kd_scene *image)
{
    static const cgt_kd_cache_size nodes[] = {{0}, {1, 1}, {4, 3}}, references[] = {{0}, {1, 2}, {2, 4}},
                                   leaves[] = {{0}, {1, 0}, {2, 1}}, slots[] = {{0}, {1, 0}, {16, 8}, {64, 2}};
    cgt_kd_frame_options o = {.cell = {.spes = 1 + fuzz_below(b, 3), .doubts_half = 16}};
    o.cell.function = image->bih ? spe_bih : spe_kd;
    o.cell.assignment = (cgt_assignment)fuzz_below(b, CGT_ASSIGNMENTS);
    o.tiles_x = 1 + fuzz_below(b, 8);
    o.tiles_y = 1 + fuzz_below(b, 8);
    o.nodes = nodes[fuzz_below(b, 3)];
    o.references = references[fuzz_below(b, 3)];
    o.leaves = leaves[fuzz_below(b, 3)];
    o.triangles = slots[fuzz_below(b, 4)];
    o.batch = fuzz_below(b, 33);
    o.prefetch = fuzz_below(b, 2);
    o.lights = fuzz_below(b, MOST_RAYS);
    const uint8_t rays = fuzz_byte(b);
    o.ambient = rays % MOST_RAYS;
    o.mirror = rays >> 1 & 1 && image->parts <= 1;
    for (int a = 0; a < 3; a++)
        o.light[0][a] = (float)fuzz_byte(b) - 128;
    o.light_t_min = o.ambient_t_min = o.mirror_t_min = 0x1p-10f;
    o.ambient_t_max = o.mirror_t_max = 4;
    return o;
}

/* One word of one array: any bits, one bit, a step up or down, or a small number, such as another node's. */
static void damage(fuzz_bytes *b, cgt_kd_scene *image)
{
    cgt_kd_scene_part *const p = &image->part[fuzz_below(b, MOST_PARTS) % (image->parts ? image->parts : 1)];
    struct {
        void *at;
        size_t bytes;
    } const array[] = {{&p->image, 40}, /* counts and box; addresses are the frame's */
                       {p->node, p->node_bytes},
                       {p->reference, p->reference_bytes},
                       {p->leaf, p->leaf_bytes},
                       {image->triangle, image->triangle_bytes}};
    const uint32_t how = fuzz_below(b, 4), which = fuzz_below(b, 5), how_much = fuzz_byte(b);
    const uint32_t at = fuzz_byte(b) | (uint32_t)fuzz_byte(b) << 8;
    if (!image->parts || !array[which].at || !array[which].bytes)
        return;
    char *const place = (char *)array[which].at + at % (array[which].bytes / 4) * 4;
    uint32_t word;
    memcpy(&word, place, sizeof word);
    switch (how) {
    case 0: word = fuzz_word(b); break;
    case 1: word ^= 1u << how_much % 32; break;
    case 2: word += how_much - 128; break;
    default: word = how_much;
    }
    memcpy(place, &word, sizeof word);
}

static void trace(fuzz_bytes *b, cgt_kd_scene *image)
{
    static uint32_t ids[MOST_EDGE * MOST_EDGE];
    static uint32_t reflected[MOST_EDGE * MOST_EDGE];
    static uint8_t occluded[(2 * MOST_RAYS + 1) * MOST_EDGE * MOST_EDGE];
    static cgt_cell_frame_result r;
    const uint32_t width = 1 + fuzz_below(b, MOST_EDGE), height = 1 + fuzz_below(b, MOST_EDGE);
    const cgt_kd_frame_options o = make_options(b, image);
    cgt_camera camera;
    cgt_camera_init(&camera);
    for (int a = 0; a < 3; a++)
        camera.eye[a] = (float)fuzz_byte(b) / 16 - 8;
    camera.fov = 1 + (float)fuzz_below(b, 160);
    uint32_t damages = 0;
    for (; b->left && damages < MOST_DAMAGES; damages++)
        damage(b, image);
    const uint32_t batches = o.lights + o.ambient + o.mirror;
    const cgt_kd_frame_output output = {.ids = ids, .occluded = batches ? occluded : NULL, .reflected = reflected};
    const cgt_result result = cgt_kd_frame_trace(image, &camera, width, height, &o, &output, &r);
    FUZZ_CHECK((result == CGT_OK) == !*r.message, "%d, and the message: %s", (int)result, r.message);
    FUZZ_CHECK(result == CGT_OK || result == CGT_ERROR_INVALID_ARGUMENT || (damages && result == CGT_ERROR_STOPPED),
               "%d: %s", (int)result, r.message);
    for (uint32_t k = 0; k < width * height && result == CGT_OK; k++)
        FUZZ_CHECK(ids[k] == CGT_INVALID_ID || ids[k] < image->triangles, "id %u", (unsigned)ids[k]);
    for (uint32_t k = 0; k < width * height && result == CGT_OK && o.mirror; k++)
        FUZZ_CHECK(reflected[k] == CGT_INVALID_ID || reflected[k] < image->triangles, "id %u", (unsigned)reflected[k]);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_bytes b = fuzz_bytes_of(data, size);
    const cgt_memory_hooks hooks = cgt_memory_default();
    char message[CGT_PPE_MESSAGE_BYTES];
    cgt_kd_scene image;
    world w = {.parts = 0};
    const uint32_t parts = 1 + fuzz_below(&b, MOST_PARTS);
    static const cgt_structure structures[] = {CGT_STRUCTURE_KD, CGT_STRUCTURE_KD_ROPES, CGT_STRUCTURE_BIH};
    const cgt_structure structure = structures[fuzz_below(&b, 3)];
    FUZZ_CHECK(cgt_context_create(&(cgt_context_options){.threads = 1}, &w.context) == CGT_OK, "no context");
    while (w.parts < parts)
        make_part(&b, &w, structure);
    if (cgt_kd_scene_init(&image, &hooks, (const cgt_scene *const *)w.scene, parts, message) == CGT_OK) {
        trace(&b, &image);
        cgt_kd_scene_release(&image);
    }
    for (uint32_t k = 0; k < parts; k++)
        cgt_scene_release(w.scene[k]);
    cgt_context_release(w.context);
    return 0;
}
