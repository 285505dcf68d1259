/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Animation clips: by name or number, and how many frames they have. */
#define _POSIX_C_SOURCE 200809L
#include "mesh/animation/mesh_pose.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#define DEFAULT_TICKS 25.0  /* a second, where the file does not say: assimp's own rule */
#define MOST_FRAMES 1000000 /* more mean a damaged duration */

/* ---- Choice ------------------------------------------------------------------------------------------------- */

static double ticks_per_second(const struct aiAnimation *a)
{
    return a->mTicksPerSecond > 0.0 && isfinite(a->mTicksPerSecond) ? a->mTicksPerSecond : DEFAULT_TICKS;
}

static double last_key(const struct aiNodeAnim *channel)
{
    double last = 0.0;
    for (unsigned i = 0; i < channel->mNumPositionKeys; i++)
        last = fmax(last, channel->mPositionKeys[i].mTime);
    for (unsigned i = 0; i < channel->mNumRotationKeys; i++)
        last = fmax(last, channel->mRotationKeys[i].mTime);
    for (unsigned i = 0; i < channel->mNumScalingKeys; i++)
        last = fmax(last, channel->mScalingKeys[i].mTime);
    return last;
}

/* In ticks. Files that give no duration end with their last key. */
static double duration(const struct aiAnimation *a)
{
    if (a->mDuration > 0.0 && isfinite(a->mDuration))
        return a->mDuration;
    double last = 0.0;
    for (unsigned c = 0; c < a->mNumChannels; c++)
        last = fmax(last, last_key(a->mChannels[c]));
    return isfinite(last) ? last : 0.0;
}

static double seconds_of(const struct aiAnimation *a) { return duration(a) / ticks_per_second(a); }

/* The clip's number, or MESH_NONE. A name counts before a number. */
static uint32_t find_clip(const struct aiScene *scene, const char *name)
{
    for (unsigned a = 0; a < scene->mNumAnimations; a++)
        if (strcmp(scene->mAnimations[a]->mName.data, name) == 0)
            return a;
    const text_span word = {name, name + strlen(name)};
    uint64_t number = 0;
    if (scene->mNumAnimations > 0 && text_u64(word, scene->mNumAnimations - 1, &number))
        return (uint32_t)number;
    return MESH_NONE;
}

/* Reports the existing clips. */
static int unknown_clip(cgt_trajectory *t, const struct aiScene *scene)
{
    if (scene->mNumAnimations == 0)
        return trajectory_fail(t, 0, "no clip '%.60s': the file has no animation", t->options.clip);
    char list[400] = "";
    size_t used = 0;
    for (unsigned a = 0; a < scene->mNumAnimations && used + 120 < sizeof list; a++) {
        const int length = snprintf(list + used, sizeof list - used, "%s%u '%.60s' (%.3g s)", a > 0 ? ", " : "", a,
                                    scene->mAnimations[a]->mName.data, seconds_of(scene->mAnimations[a]));
        used += length > 0 ? (size_t)length : 0;
        if (used + 120 >= sizeof list && a + 1 < scene->mNumAnimations)
            snprintf(list + used, sizeof list - used, ", ...");
    }
    return trajectory_fail(t, 0, "no clip '%.60s'; there are %s", t->options.clip, list);
}

int mesh_clip_choose(cgt_trajectory *t, const mesh_model *model, mesh_clip *clip)
{
    const struct aiScene *const scene = model->scene;
    *clip = (mesh_clip){.animation = NULL, .ticks_per_second = DEFAULT_TICKS, .seconds = 0.0, .frames = 1};
    uint32_t number = scene->mNumAnimations > 0 ? 0 : MESH_NONE;
    if (t->options.clip != NULL) {
        number = find_clip(scene, t->options.clip);
        if (number == MESH_NONE)
            return unknown_clip(t, scene);
    }
    if (number == MESH_NONE)
        return 1;
    clip->animation = scene->mAnimations[number];
    clip->ticks_per_second = ticks_per_second(clip->animation);
    clip->seconds = seconds_of(clip->animation);
    /* The tolerance keeps a last frame that rounding put past the end. */
    const double frames = floor(clip->seconds * t->options.fps + 1e-6) + 1.0;
    if (!(frames <= MOST_FRAMES))
        return trajectory_fail(t, 0, "the clip lasts %g s: more than %d frames at %g per second", clip->seconds,
                               MOST_FRAMES, t->options.fps);
    clip->frames = (uint64_t)frames;
    return 1;
}

double mesh_clip_time(const mesh_clip *clip, double fps, uint64_t number)
{
    return fmin((double)number / fps, clip->seconds);
}
