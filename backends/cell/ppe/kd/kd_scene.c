/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The image of kd-trees, and of bounding interval hierarchies (kd_scene_bih.c). */
#include "cell/ppe/kd/kd_scene.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scene/scene.h"

#define MOST_BYTES 0xffffff80u /* of an array: its window of addresses */
#define MOST_SCALE 0x1p100f

static cgt_result refuse(char message[CGT_PPE_MESSAGE_BYTES], cgt_result result, const char *sentence)
{
    snprintf(message, CGT_PPE_MESSAGE_BYTES, "%s", sentence);
    return result;
}

static cgt_result check_scene(const cgt_scene *scene, cgt_structure structure, char message[CGT_PPE_MESSAGE_BYTES])
{
    const cgt_committed_scene *const c = &scene->committed_scene;
    if (!scene->is_committed)
        return refuse(message, CGT_ERROR_INVALID_ARGUMENT, "a scene is not committed");
    if (c->prims.spheres)
        return refuse(message, CGT_ERROR_INVALID_ARGUMENT,
                      "the kd program has triangles alone; spheres go by the grid");
    if (!scene->in_bands && (c->prims.count == 0 || c->valid == 0))
        return CGT_OK;
    for (int a = 0; a < 3; a++)
        if (!(fabsf(c->low[a]) <= CGT_SPE_MAX_COORDINATE && fabsf(c->high[a]) <= CGT_SPE_MAX_COORDINATE))
            return refuse(message, CGT_ERROR_INVALID_ARGUMENT,
                          "triangles reach beyond 2^40, where the bounds of an SPU's single precision end");
    if (c->scale > MOST_SCALE)
        return refuse(
            message, CGT_ERROR_INVALID_ARGUMENT,
            "triangles are nearer to the origin than 2^-100, where the bounds of an SPU's single precision end");
    if (scene->in_bands || c->brute_force)
        return refuse(message, CGT_ERROR_INVALID_ARGUMENT, "triangles of such different magnitudes are in no tree");
    if (c->structure != structure)
        return refuse(message, CGT_ERROR_INVALID_ARGUMENT,
                      "a scene was committed with neither a kd-tree nor a bounding interval hierarchy, or scenes with "
                      "different ones: some with ropes and some without, or of both kinds");
    return CGT_OK;
}

/* ---- copies ---- */

/* A face of the whole tree, moved outwards where it is too near to 0: boxes round there. */
static void move_out(float *low, float *high)
{
    if (fabsf(*low) < CGT_KD_MIN_COORDINATE)
        *low = *low < 0 ? -CGT_KD_MIN_COORDINATE : 0;
    if (fabsf(*high) < CGT_KD_MIN_COORDINATE)
        *high = *high > 0 ? CGT_KD_MIN_COORDINATE : 0;
}

static void *copy(const cgt_memory_hooks *memory, const void *from, size_t bytes, size_t *allocated)
{
    *allocated = (bytes + 127) / 128 * 128;
    if (!bytes)
        return NULL;
    void *const to = cgt_allocate(memory, *allocated);
    if (to) {
        memset(to, 0, *allocated);
        memcpy(to, from, bytes);
    }
    return to;
}

static bool copy_kd(const cgt_memory_hooks *memory, const cgt_kd_tree *tree, cgt_kd_scene_part *p)
{
    p->node = copy(memory, tree->node, tree->nodes * sizeof *tree->node, &p->node_bytes);
    p->reference =
        copy(memory, tree->reference, (size_t)tree->references * sizeof *tree->reference, &p->reference_bytes);
    if (tree->leaf)
        p->leaf = copy(memory, tree->leaf, tree->leaves * sizeof *tree->leaf, &p->leaf_bytes);
    if (!p->node || (!p->reference && p->reference_bytes) || (tree->leaf && !p->leaf))
        return false;
    /* primitives get their numbers through all parts */
    for (uint64_t k = 0; k < tree->references; k++)
        p->reference[k] += p->first;
    cgt_kd_node *const node = p->node;
    for (uint32_t k = 0; k < tree->nodes && !tree->leaf; k++)
        if (k != 1 && cgt_kd_is_leaf(node[k]) && cgt_kd_count(node[k]) == 1)
            node[k].word[1] += p->first;
    for (uint32_t k = 0; k < tree->leaves && tree->leaf; k++)
        for (int a = 0; a < 3; a++) {
            float low = p->leaf[k].low[a], high = p->leaf[k].high[a];
            move_out(&low, &high);
            if (p->leaf[k].packet_rope[2 * a] == CGT_INVALID_ID)
                p->leaf[k].low[a] = low;
            if (p->leaf[k].packet_rope[2 * a + 1] == CGT_INVALID_ID)
                p->leaf[k].high[a] = high;
        }
    p->image.nodes = tree->nodes;
    p->image.references = (uint32_t)tree->references;
    p->image.leaves = tree->leaves;
    p->image.ropes = tree->leaf != NULL;
    return true;
}

static bool copy_part(const cgt_memory_hooks *memory, const cgt_scene *scene, bool bih, cgt_kd_scene_part *p)
{
    const cgt_committed_scene *const c = &scene->committed_scene;
    const cgt_research_scene_options *const o = &scene->research_options;
    for (int a = 0; a < 3; a++) {
        p->image.low[a] = bih ? c->papers->bih.low[a] : c->papers->kd.low[a];
        p->image.high[a] = bih ? c->papers->bih.high[a] : c->papers->kd.high[a];
        move_out(&p->image.low[a], &p->image.high[a]);
    }
    return bih ? cgt_kd_scene_add_bih(memory, &c->papers->bih, o->kd_layout, o->kd_break_level, p) == CGT_OK
               : copy_kd(memory, &c->papers->kd, p);
}

static void fill_triangles(cgt_kd_scene *image, const cgt_primitives *prims, uint32_t first)
{
    for (uint32_t k = 0; k < prims->count; k++) {
        const cgt_triangle q = cgt_primitives_triangle(prims, k);
        cgt_leaf_triangle *const t = &image->triangle[first + k];
        cgt_leaf_triangle_prepare(&q, image->scale, t);
        for (int a = 0; a < 3; a++) {
            t->vertex[a] = cgt_spe_normal(t->vertex[a]);
            t->edge[0][a] = cgt_spe_normal(t->edge[0][a]);
            t->edge[1][a] = cgt_spe_normal(t->edge[1][a]);
        }
        t->sum[0] = cgt_spe_normal(t->sum[0]);
        t->sum[1] = cgt_spe_normal(t->sum[1]);
    }
}

/* Along ropes differences of planes must not underflow. */
static bool has_tiny_planes(const cgt_kd_scene_part *p)
{
    bool tiny = false;
    for (uint32_t k = 0; k < p->image.leaves && p->leaf; k++)
        for (int a = 0; a < 3; a++) {
            const float low = fabsf(p->leaf[k].low[a]), high = fabsf(p->leaf[k].high[a]);
            tiny |= (low != 0 && low < CGT_KD_MIN_COORDINATE) || (high != 0 && high < CGT_KD_MIN_COORDINATE);
        }
    return tiny;
}

/* ---- the call ---- */

static bool is_too_large(const cgt_committed_scene *c, bool bih)
{
    if (bih) /* all its nodes may be clips, whose children have a pair each */
        return (2 * (uint64_t)c->papers->bih.nodes + 2) * sizeof(cgt_bih_node) > MOST_BYTES ||
               c->papers->bih.references * sizeof(uint32_t) > MOST_BYTES;
    return c->papers->kd.nodes * (uint64_t)sizeof(cgt_kd_node) > MOST_BYTES ||
           c->papers->kd.references * sizeof(uint32_t) > MOST_BYTES ||
           c->papers->kd.leaves * (uint64_t)sizeof(cgt_kd_leaf) > MOST_BYTES;
}

static bool is_tree(cgt_structure structure)
{
    return structure == CGT_STRUCTURE_KD_ROPES || structure == CGT_STRUCTURE_BIH;
}

static cgt_result check_scenes(cgt_kd_scene *image, const cgt_scene *const *scene, uint32_t count,
                               char message[CGT_PPE_MESSAGE_BYTES])
{
    cgt_structure structure = CGT_STRUCTURE_AUTO;
    uint64_t triangles = 0;
    if (count < 1 || count > CGT_KD_PARTS)
        return refuse(message, CGT_ERROR_INVALID_ARGUMENT, "1 to 16 scenes make an image");
    for (uint32_t k = 0; k < count; k++) {
        const cgt_committed_scene *const c = &scene[k]->committed_scene;
        if (c->valid && structure == CGT_STRUCTURE_AUTO)
            structure = is_tree(c->structure) ? c->structure : CGT_STRUCTURE_KD;
        const cgt_result result = check_scene(scene[k], structure, message);
        if (result != CGT_OK)
            return result;
        triangles += c->prims.count;
        if (c->valid && (image->scale == 0 || c->scale < image->scale))
            image->scale = c->scale;
        for (int a = 0; a < 3 && c->valid; a++)
            image->magnitude = fmaxf(image->magnitude, fmaxf(fabsf(c->low[a]), fabsf(c->high[a])));
        if (c->valid && is_too_large(c, structure == CGT_STRUCTURE_BIH))
            return refuse(message, CGT_ERROR_TOO_LARGE, "an array of a tree exceeds the 4 GB of addresses for it");
    }
    if (triangles * sizeof(cgt_leaf_triangle) > MOST_BYTES)
        return refuse(message, CGT_ERROR_TOO_LARGE, "triangles exceed the 4 GB of addresses for them");
    image->triangles = (uint32_t)triangles;
    image->ropes = structure == CGT_STRUCTURE_KD_ROPES;
    if (structure == CGT_STRUCTURE_AUTO) /* nothing to trace, by whichever program the first scene is for */
        structure = scene[0]->options.structure;
    image->bih = structure == CGT_STRUCTURE_BIH;
    return CGT_OK;
}

cgt_result cgt_kd_scene_init(cgt_kd_scene *image, const cgt_memory_hooks *memory, const cgt_scene *const *scene,
                             uint32_t count, char message[CGT_PPE_MESSAGE_BYTES])
{
    *image = (cgt_kd_scene){.memory = *memory};
    cgt_result result = check_scenes(image, scene, count, message);
    if (result != CGT_OK)
        return result;
    if (image->scale == 0) { /* no triangles at all */
        image->scale = 1;
        return CGT_OK;
    }
    bool made = true;
    image->triangle_bytes = ((size_t)image->triangles * sizeof *image->triangle + 127) / 128 * 128;
    image->triangle = cgt_allocate(memory, image->triangle_bytes);
    made = image->triangle != NULL;
    if (made)
        memset(image->triangle, 0, image->triangle_bytes);
    for (uint32_t k = 0, first = 0; k < count && made; first += scene[k]->committed_scene.prims.count, k++) {
        const cgt_committed_scene *const c = &scene[k]->committed_scene;
        if (c->valid == 0)
            continue;
        cgt_kd_scene_part *const p = &image->part[image->parts++];
        *p = (cgt_kd_scene_part){.scene = scene[k], .first = first};
        made = copy_part(memory, scene[k], image->bih, p);
        if (made)
            fill_triangles(image, &c->prims, first);
        if (made && has_tiny_planes(p))
            result =
                refuse(message, CGT_ERROR_INVALID_ARGUMENT,
                       "a plane of a tree with ropes lies within 2^-100 of 0, where differences underflow on an SPU");
    }
    if (!made)
        result = refuse(message, CGT_ERROR_OUT_OF_MEMORY, "out of memory for the image of trees");
    if (result != CGT_OK)
        cgt_kd_scene_release(image);
    return result;
}

void cgt_kd_scene_release(cgt_kd_scene *image)
{
    for (uint32_t k = 0; k < image->parts; k++) {
        cgt_kd_scene_part *const p = &image->part[k];
        if (p->node)
            cgt_free(&image->memory, p->node, p->node_bytes);
        if (p->reference)
            cgt_free(&image->memory, p->reference, p->reference_bytes);
        if (p->leaf)
            cgt_free(&image->memory, p->leaf, p->leaf_bytes);
    }
    image->parts = 0;
    if (image->triangle)
        cgt_free(&image->memory, image->triangle, image->triangle_bytes);
    image->triangle = NULL;
}

bool cgt_kd_scene_get(const void *scene, uint32_t object, cgt_decided_hit *hit)
{
    const cgt_kd_scene *const image = scene;
    if (!image->parts || object < image->part[0].first)
        return false;
    uint32_t k = 0;
    while (k + 1 < image->parts && image->part[k + 1].first <= object)
        k++;
    const cgt_primitives *const prims = &image->part[k].scene->committed_scene.prims;
    const uint32_t local = object - image->part[k].first;
    if (local >= prims->count)
        return false;
    *hit = (cgt_decided_hit){.primitive = cgt_primitives_get(prims, local)};
    return true;
}
