/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * When rays are worth a BVH, and who builds it. */
#include "builders/bvh/bvh_on_demand.h"

#include "builders/bvh/bvh_build.h"
#include "core/float_environment.h"
#include "scene/bands.h"

#define PRIMS_PER_RAY 32u   /* building takes about 1/60 as long as a ray for each primitive through an even grid */
#define EVEN_CROWDING 32.0f /* where this many primitives share a cell, rays cost more by their share */

/* Rays that came without a tree before one is built, by the estimate that they share nothing, which is not known. Where
 * a grid has regions, packets bound their rays with the rounding of the whole world, which exceeds the cells of a
 * region. */
static uint64_t min_rays_for_build(const cgt_committed_scene *s)
{
    if (s->loose.regions)
        return 0;
    const uint64_t rays = s->valid / PRIMS_PER_RAY;
    return s->loose.crowding > EVEN_CROWDING ? (uint64_t)((float)rays * (EVEN_CROWDING / s->loose.crowding)) : rays;
}

/* Several threads may need the tree: one builds it, and the others trace without it. So does what this thread itself
 * traces meanwhile, in a hook or in another task of the caller's runner. */
static cgt_result build_for_rays(cgt_scene *scene, bool *is_built)
{
    cgt_result result = CGT_OK;
    cgt_float_environment callers;
    unsigned state = CGT_BVH_STATE_NONE;
    /* acquire: a build that failed before on another thread has left its buffers */
    if (!atomic_compare_exchange_strong_explicit(&scene->bvh_state, &state, CGT_BVH_STATE_BUILDING,
                                                 memory_order_acquire, memory_order_acquire)) {
        *is_built = state == CGT_BVH_STATE_BUILT;
        return CGT_OK;
    }
    cgt_float_environment_enter(&callers);
    result = cgt_bvh_build_tree(scene);
    cgt_float_environment_leave(&callers);
    *is_built = result == CGT_OK;
    if (*is_built) {
        cgt_set_flag(&cgt_whole_scene(scene)->record.rays);
        cgt_publish_built_bvh(scene);
    }
    atomic_store_explicit(&scene->bvh_state, *is_built ? CGT_BVH_STATE_BUILT : CGT_BVH_STATE_NONE,
                          memory_order_release);
    return result;
}

/* Whether AUTO has built a grid over something: then there may be a BVH, too. */
static bool may_have_bvh_beside_grid(const cgt_scene *scene)
{
    const cgt_committed_scene *s = &scene->committed_scene;
    return scene->options.structure == CGT_STRUCTURE_AUTO && s->structure == CGT_STRUCTURE_LOOSE_GRID && s->valid &&
           !s->brute_force;
}

static cgt_result build_for_bands(const struct cgt_bands *bands)
{
    cgt_result result = CGT_OK;
    bool is_built;
    for (uint32_t b = 0; b < bands->count && result == CGT_OK; b++)
        if (may_have_bvh_beside_grid(bands->band[b].scene))
            result = build_for_rays(bands->band[b].scene, &is_built);
    return result;
}

cgt_result cgt_scene_prepare(cgt_scene *scene, cgt_ray_kind rays)
{
    bool is_built;
    if (!scene)
        return CGT_ERROR_INVALID_ARGUMENT;
    if ((unsigned)rays > CGT_RAY_KIND_INCOHERENT)
        return cgt_fail(scene->context, CGT_ERROR_INVALID_ARGUMENT, "prepare: rays %d is unknown", (int)rays);
    if (!scene->is_committed)
        return cgt_fail(scene->context, CGT_ERROR_NOT_COMMITTED, "prepare: the scene is not committed");
    if (rays == CGT_RAY_KIND_INCOHERENT && scene->in_bands)
        return build_for_bands(scene->bands);
    if (rays == CGT_RAY_KIND_COHERENT || !may_have_bvh_beside_grid(scene))
        return CGT_OK;
    return build_for_rays(scene, &is_built);
}

cgt_result cgt_bvh_build_on_demand(const cgt_scene *scene, uint64_t rays, bool *is_built)
{
    const cgt_committed_scene *committed_scene = &scene->committed_scene;
    cgt_scene *mutable_scene = scene->mutable_scene;
    *is_built = false;
    if (!may_have_bvh_beside_grid(scene)) {
        *is_built = committed_scene->structure == CGT_STRUCTURE_BVH && committed_scene->bvh.node;
        if (rays)
            cgt_set_flag(&cgt_whole_scene(mutable_scene)->record.rays);
        return CGT_OK;
    }
    if (atomic_load_explicit(&mutable_scene->bvh_state, memory_order_acquire) == CGT_BVH_STATE_BUILT) {
        *is_built = true;
        return CGT_OK;
    }
    const uint64_t earlier_rays = atomic_fetch_add_explicit(&mutable_scene->bvh_rays, rays, memory_order_relaxed);
    if (!rays || earlier_rays + rays < min_rays_for_build(committed_scene))
        return CGT_OK;
    return build_for_rays(mutable_scene, is_built);
}

uint64_t cgt_bvh_rays_left(const cgt_scene *scene)
{
    const unsigned state = atomic_load_explicit(&scene->mutable_scene->bvh_state, memory_order_acquire);
    const uint64_t rays = atomic_load_explicit(&scene->mutable_scene->bvh_rays, memory_order_relaxed);
    const uint64_t price = scene->committed_scene.valid / PRIMS_PER_RAY;
    if (state == CGT_BVH_STATE_BUILT)
        return 0;
    if (state == CGT_BVH_STATE_BUILDING || !may_have_bvh_beside_grid(scene))
        return UINT32_MAX;
    return price > rays ? price - rays : 1;
}
