/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The drawings of docs/internals/structures.md, docs/images/structures/, are what the library builds over a slice
 * through the shipped run of grains, in the variant of four lanes that every machine has.
 *   test_drawings         compares them byte by byte
 *   test_drawings print   writes them anew */
#define CGT_SPU_PORTABLE
#define CGT_VARIANT portable
#define CGT_VARIANT_PORTABLE 1
#define CGT_LANES 4

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cgt/research.h>

#include "kernel/bvh/bvh_node.h"
#include "papers/model/paper_structures.h"
#include "scene/scene.h"

enum { MOST_GRAINS = 400, FRAME = 40 };
static const float scale = 32; /* pixels of a metre */

typedef struct drawing {
    char text[1 << 18];
    size_t length;
    float low[2], high[2]; /* x and z of the scene */
} drawing;

typedef struct box {
    float low[3], high[3];
} box;

static void put(drawing *d, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    const int length = vsnprintf(d->text + d->length, sizeof d->text - d->length, format, list);
    va_end(list);
    if (length < 0 || (size_t)length >= sizeof d->text - d->length)
        abort();
    d->length += (size_t)length;
}

/* A rectangle of the plane y = 0; `style` are SVG attributes. */
static void put_box(drawing *d, const float low[3], const float high[3], const char *style)
{
    const float x = fmaxf(low[0], d->low[0]), z = fminf(high[2], d->high[1]);
    put(d, "<rect x='%.1f' y='%.1f' width='%.1f' height='%.1f' %s/>\n", (double)((x - d->low[0]) * scale),
        (double)((d->high[1] - z) * scale), (double)((fminf(high[0], d->high[0]) - x) * scale),
        (double)((z - fmaxf(low[2], d->low[1])) * scale), style);
}

/* A plane across an axis, within a box. */
static void put_plane(drawing *d, box b, uint32_t axis, float at, const char *style)
{
    b.low[axis] = b.high[axis] = at;
    put(d, "<path d='M%.1f %.1fL%.1f %.1f' %s/>\n", (double)((b.low[0] - d->low[0]) * scale),
        (double)((d->high[1] - b.low[2]) * scale), (double)((b.high[0] - d->low[0]) * scale),
        (double)((d->high[1] - b.high[2]) * scale), style);
}

/* Every cell of the level, the fullest one filled, and how far its grains may reach. */
static void draw_loose_grid(drawing *d, const cgt_committed_scene *s)
{
    static const char *const color[] = {"#1b6ca8", "#b5532a", "#3d7f3d", "#7a4f9a"};
    for (uint32_t l = 0; l < s->loose.levels; l++) {
        const cgt_loose_level *level = &s->loose.level[l];
        uint32_t fullest = 0, most = 0;
        char style[96];
        snprintf(style, sizeof style, "fill='none' stroke='%s' stroke-width='0.7'", color[l % 4]);
        for (uint32_t c = 0; c < level->size[0] * level->size[1] * level->size[2]; c++) {
            const uint32_t at[3] = {c % level->size[0], c / level->size[0] % level->size[1],
                                    c / level->size[0] / level->size[1]};
            const uint32_t count = s->loose.start[level->first + c + 1] - s->loose.start[level->first + c];
            box b;
            for (int a = 0; a < 3; a++) {
                b.low[a] = level->low[a] + (float)at[a] * level->cell[a];
                b.high[a] = b.low[a] + level->cell[a];
            }
            put_box(d, b.low, b.high, style);
            if (count > most)
                most = count, fullest = c;
        }
        box b;
        const uint32_t at[3] = {fullest % level->size[0], 0, fullest / level->size[0] / level->size[1]};
        for (int a = 0; a < 3; a++) {
            b.low[a] = level->low[a] + (float)at[a] * level->cell[a];
            b.high[a] = b.low[a] + level->cell[a];
        }
        put_box(d, b.low, b.high, "fill='#e0a000' fill-opacity='0.45'");
        for (int a = 0; a < 3; a++)
            b.low[a] -= level->reach[a], b.high[a] += level->reach[a];
        put_box(d, b.low, b.high, "fill='none' stroke='#c07000' stroke-width='2' stroke-dasharray='6 4'");
    }
}

static void draw_bvh(drawing *d, const cgt_bvh *tree, uint32_t number, uint32_t depth)
{
    static const char *const style[] = {"fill='none' stroke='#7a1f5c' stroke-width='3'",
                                        "fill='none' stroke='#b5532a' stroke-width='2'",
                                        "fill='none' stroke='#1b6ca8' stroke-width='1.2'"};
    const bvh_node *n = (const bvh_node *)tree->node + number;
    for (uint32_t c = 0; c < n->children; c++) {
        const float low[3] = {n->low[0][c], n->low[1][c], n->low[2][c]};
        const float high[3] = {n->high[0][c], n->high[1][c], n->high[2][c]};
        if (n->child[c] & CGT_BVH_LEAF) {
            put_box(d, low, high, "fill='#3d7f3d' fill-opacity='0.18' stroke='#3d7f3d' stroke-width='0.7'");
        } else {
            put_box(d, low, high, style[depth < 2 ? depth : 2]);
            draw_bvh(d, tree, n->child[c], depth + 1);
        }
    }
}

static void draw_kd(drawing *d, const cgt_kd_tree *tree, uint32_t number, box b, uint32_t depth)
{
    static const char *const style[] = {"stroke='#7a1f5c' stroke-width='3'", "stroke='#b5532a' stroke-width='2'",
                                        "stroke='#1b6ca8' stroke-width='0.9'"};
    const cgt_kd_node n = tree->node[number];
    if (cgt_kd_is_leaf(n)) {
        if (cgt_kd_count(n) == 0)
            put_box(d, b.low, b.high, "fill='#999' fill-opacity='0.25'");
        return;
    }
    const uint32_t axis = cgt_kd_axis(n);
    box lower = b, upper = b;
    lower.high[axis] = upper.low[axis] = cgt_kd_split(n);
    if (axis != 1)
        put_plane(d, b, axis, cgt_kd_split(n), style[depth < 4 ? depth / 2 : 2]);
    draw_kd(d, tree, n.word[1], lower, depth + 1);
    draw_kd(d, tree, n.word[1] + 1, upper, depth + 1);
}

/* Of the upper splits: where lower children end, where upper ones begin, and the room that both share. */
static void draw_bih(drawing *d, const cgt_bih *tree, uint32_t number, box b, uint32_t depth)
{
    const cgt_bih_node *n = tree->node + number;
    if (cgt_bih_is_leaf(n) || depth > 5)
        return;
    const uint32_t axis = cgt_bih_axis(n);
    const float plane[2] = {cgt_bih_plane(n, 0), cgt_bih_plane(n, 1)};
    if (cgt_bih_is_clip(n)) {
        b.low[axis] = plane[0], b.high[axis] = plane[1];
        draw_bih(d, tree, n->word[3], b, depth);
        return;
    }
    box lower = b, upper = b, both = b;
    lower.high[axis] = both.high[axis] = plane[0];
    upper.low[axis] = both.low[axis] = plane[1];
    if (axis != 1) {
        if (plane[1] < plane[0])
            put_box(d, both.low, both.high, "fill='#e0a000' fill-opacity='0.3'");
        put_plane(d, b, axis, plane[0], "stroke='#1b6ca8' stroke-width='1.5'");
        put_plane(d, b, axis, plane[1], "stroke='#b5532a' stroke-width='1.5'");
    }
    draw_bih(d, tree, n->word[3], lower, depth + 1);
    draw_bih(d, tree, n->word[3] + 1, upper, depth + 1);
}

/* Each voxel, darker the more references it has. */
static void draw_queue_grid(drawing *d, const cgt_queue_grid *grid)
{
    for (uint32_t z = 0; z < grid->resolution[2]; z++) {
        for (uint32_t x = 0; x < grid->resolution[0]; x++) {
            const cgt_voxel *v = &grid->voxel[x * grid->stride[0] + z * grid->stride[2]];
            const float low[3] = {grid->org[0] + (float)x / grid->rcell[0], 0,
                                  grid->org[2] + (float)z / grid->rcell[2]};
            const float high[3] = {low[0] + 1 / grid->rcell[0], 0, low[2] + 1 / grid->rcell[2]};
            int count = 0;
            for (int i = 0; i < CGT_QUEUE_LENGTH; i++)
                count += v->reference[i] != CGT_QUEUE_NONE;
            char style[96];
            snprintf(style, sizeof style, "fill='#1b6ca8' fill-opacity='%.2f' stroke='#1b6ca8' stroke-width='0.4'",
                     0.055 * count);
            put_box(d, low, high, style);
        }
    }
}

/* The grains of a frame whose middles lie within 0.8 of the plane y = 6, moved into the plane y = 0. */
static uint32_t read_grains(float grain[MOST_GRAINS][4])
{
    FILE *file = fopen(CGT_DATA_DIR "/pour2k.lammpstrj", "r");
    char line[256];
    uint32_t count = 0;
    float x, y, z, radius;
    if (!file)
        return 0;
    for (int frame = -1; fgets(line, sizeof line, file) && frame <= FRAME;) {
        frame += strncmp(line, "ITEM: TIMESTEP", 14) == 0;
        if (frame == FRAME && sscanf(line, "%*u %*u %f %f %f %f", &x, &y, &z, &radius) == 4 && fabsf(y - 6) < 0.8f &&
            count < MOST_GRAINS)
            memcpy(grain[count++], (float[4]){x, 0, z, radius}, sizeof *grain);
    }
    fclose(file);
    return count;
}

static void draw(drawing *d, cgt_context *context, const cgt_spheres *grains, cgt_structure structure)
{
    cgt_scene *scene = NULL;
    if (cgt_scene_create(context, &(cgt_scene_options){.structure = structure}, &scene) != CGT_OK ||
        cgt_scene_set_spheres(scene, NULL, grains) != CGT_OK || cgt_scene_commit(scene) != CGT_OK) {
        char message[256];
        cgt_context_get_error_message(context, message, sizeof message);
        fprintf(stderr, "%s\n", message);
        exit(1);
    }
    const cgt_committed_scene *s = &scene->committed_scene;
    box all;
    memcpy(all.low, s->low, sizeof all.low);
    memcpy(all.high, s->high, sizeof all.high);
    for (int i = 0; i < 2; i++)
        d->low[i] = all.low[2 * i] - 0.2f, d->high[i] = all.high[2 * i] + 0.2f;
    d->length = 0;
    put(d,
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 %.1f %.1f' fill='none'>\n<rect width='100%%' "
        "height='100%%' fill='#fff'/>\n",
        (double)((d->high[0] - d->low[0]) * scale), (double)((d->high[1] - d->low[1]) * scale));
    for (uint32_t i = 0; i < grains->count; i++) {
        const float *g = (const float *)grains->centers.data + (size_t)4 * i;
        put(d, "<circle cx='%.1f' cy='%.1f' r='%.1f' fill='#ddd' stroke='#888'/>\n",
            (double)((g[0] - d->low[0]) * scale), (double)((d->high[1] - g[2]) * scale), (double)(g[3] * scale));
    }
    if (structure == CGT_STRUCTURE_LOOSE_GRID)
        draw_loose_grid(d, s);
    else if (structure == CGT_STRUCTURE_BVH)
        draw_bvh(d, &s->bvh, 0, 0);
    else if (structure == CGT_STRUCTURE_KD)
        draw_kd(d, &s->papers->kd, 0, all, 0);
    else if (structure == CGT_STRUCTURE_BIH)
        draw_bih(d, &s->papers->bih, 0, all, 0);
    else
        draw_queue_grid(d, &s->papers->grid);
    put(d, "</svg>\n");
    cgt_scene_release(scene);
}

int main(int argc, char **argv)
{
    static const struct {
        const char *name;
        cgt_structure structure;
    } row[] = {{"loose_grid", CGT_STRUCTURE_LOOSE_GRID},
               {"bvh", CGT_STRUCTURE_BVH},
               {"kd_tree", CGT_STRUCTURE_KD},
               {"bih", CGT_STRUCTURE_BIH},
               {"queue_grid", CGT_STRUCTURE_QUEUE_GRID}};
    static float grain[MOST_GRAINS][4];
    static drawing d;
    static char kept[sizeof d.text];
    const int print = argc > 1 && strcmp(argv[1], "print") == 0;
    const cgt_spheres grains = {.count = read_grains(grain),
                                .centers = cgt_floats(grain[0], sizeof *grain),
                                .radii = cgt_floats(&grain[0][3], sizeof *grain)};
    cgt_context *context = NULL;
    int failures = 0;
    if (grains.count < 50 ||
        cgt_context_create(&(cgt_context_options){.threads = 1, .variant = "portable"}, &context) != CGT_OK)
        return 1;
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        char path[512];
        snprintf(path, sizeof path, "%s/../docs/images/structures/%s.svg", CGT_TESTS_DIR, row[i].name);
        draw(&d, context, &grains, row[i].structure);
        FILE *file = fopen(path, print ? "wb" : "rb");
        const size_t length = !file ? 0 : print ? fwrite(d.text, 1, d.length, file) : fread(kept, 1, sizeof kept, file);
        if (length != d.length || (!print && memcmp(kept, d.text, length) != 0))
            printf("%s is not what the library builds: test_drawings print\n", path), failures++;
        if (file && fclose(file) != 0)
            failures++;
    }
    cgt_context_release(context);
    printf("%u grains\n", grains.count);
    return failures != 0;
}
