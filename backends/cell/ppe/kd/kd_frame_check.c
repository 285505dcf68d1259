/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What a frame of the kd program refuses. */
#include <math.h>

#include "cell/ppe/kd/kd_frame_memory.h"
#include "scene/scene.h"

#define MOST_SCALED 0x1p80f /* of the eye, seen from the scene */

static bool is_power(uint32_t n) { return n && !(n & (n - 1)); }

/* Blocks are whole quadwords and at most 16 KB, what one DMA takes. */
static const char *check_caches(const cgt_kd_frame_image *i, bool ropes, bool bih)
{
    const cgt_kd_cache_size *const size[3] = {&i->nodes, &i->references, &i->leaves};
    static const uint32_t least[3] = {1, 2, 0};
    const uint32_t most[3] = {bih ? 10 : 11, 12, 7};
    const uint32_t element[3] = {bih ? sizeof(cgt_bih_node) : sizeof(cgt_kd_node), sizeof(uint32_t),
                                 sizeof(cgt_kd_leaf)};
    uint64_t bytes = 0;
    for (int k = 0; k < 3; k++) {
        if (!is_power(size[k]->blocks) || size[k]->blocks > CGT_KD_BLOCKS || size[k]->log2 < least[k] ||
            size[k]->log2 > most[k])
            return "a cache has 1 to 128 blocks, a power of two, of 2 to 2,048 nodes (1,024 of a bounding interval "
                   "hierarchy), 4 to 4,096 references, 1 to 128 leaves";
        if (k < 2 || ropes)
            bytes += (((uint64_t)size[k]->blocks * element[k] << size[k]->log2) + 127) / 128 * 128;
    }
    if (!is_power(i->triangles.blocks) || i->triangles.blocks > 4096 || i->triangles.log2 > 13)
        return "the cache of triangles has 1 to 4,096 of them, a power of two, and up to 2^13 entries of its index";
    bytes += (i->triangles.blocks * (uint64_t)sizeof(cgt_leaf_triangle) + 127) / 128 * 128 + (8u << i->triangles.log2);
    return bytes > CGT_KD_CACHE_BYTES
               ? "the caches take more than the 131,072 bytes of local store that there are for them"
               : NULL;
}

static const char *check_secondary(const kd_frame *f)
{
    const cgt_kd_frame_options *const o = f->options;
    if (o->lights > CGT_KD_LIGHTS || o->ambient > CGT_KD_DIRECTIONS)
        return "a pixel has at most 4 shadow rays and 64 ambient rays";
    if (o->lights && !(o->light_t_min > 0 && o->light_t_min < 1))
        return "shadow rays begin between 0 and 1 of the way to their light";
    if (o->ambient && !(o->ambient_t_min > 0 && o->ambient_t_min < o->ambient_t_max && o->ambient_t_max <= 0x1p40f))
        return "ambient rays begin above 0 and end behind that, within 2^40";
    if (o->mirror && !(o->mirror_t_min > 0 && o->mirror_t_min < o->mirror_t_max && o->mirror_t_max <= 0x1p40f))
        return "reflected rays begin above 0 and end behind that, within 2^40";
    if (o->mirror && f->scene->parts > 1)
        return "reflected rays need a scene of one part";
    float most = f->scene->magnitude;
    for (uint32_t k = 0; k < o->lights; k++)
        for (int a = 0; a < 3; a++)
            most = fabsf(o->light[k][a]) <= most ? most : fabsf(o->light[k][a]); /* NaN stays */
    if ((o->lights || o->ambient || o->mirror) && !(most <= CGT_KD_SECONDARY_COORDINATE))
        return "with secondary rays coordinates of triangles and lights are at most 2^19";
    return NULL;
}

static const char *check_eye(const kd_frame *f)
{
    for (int a = 0; a < 3; a++) {
        const float x = fabsf(f->run.tables.image.eye[a]);
        if (!(x * f->scene->scale <= MOST_SCALED))
            return "the eye is 2^80 times as far away as the scene is large, where an SPU's single precision ends";
        if (f->scene->ropes && x != 0 && x < CGT_KD_MIN_COORDINATE)
            return "along ropes a coordinate of the eye is 0 or at least 2^-100";
    }
    return NULL;
}

/* The program knows no masks. */
static const char *check_masks(const kd_frame *f)
{
    for (uint32_t k = 0; k < f->scene->parts; k++)
        if (cgt_primitives_masked_out(&f->scene->part[k].scene->committed_scene.prims, f->run.tables.rays.mask))
            return "the camera's mask hides triangles of the scene, and the program knows no masks";
    return NULL;
}

const char *cgt_kd_frame_check_options(const cgt_kd_frame_options *o)
{
    const uint64_t x = o->tiles_x ? o->tiles_x : CGT_KD_TILES_EDGE, y = o->tiles_y ? o->tiles_y : CGT_KD_TILES_EDGE;
    if (x * y > CGT_KD_TILES)
        return "an envelope has at most 64 tiles of 2x2 pixels";
    if (o->batch > 32)
        return "a leaf's test takes at most 32 triangles together";
    return cgt_frame_check_options(&o->cell);
}

const char *cgt_kd_frame_check(const kd_frame *f)
{
    const char *wrong = check_caches(&f->image, f->scene->ropes, f->scene->bih);
    if (!wrong)
        wrong = check_secondary(f);
    if (!wrong)
        wrong = check_masks(f);
    return wrong ? wrong : check_eye(f);
}
