/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Animation clips of a glTF file. A scene knows keys with straight lines between them alone. STEP becomes a second key
 * just before the next one, which is exact; CUBICSPLINE becomes PIECES lines from key to key. */
#define _POSIX_C_SOURCE 200809L
#include "mesh/gltf/gltf_reader.h"

#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A curve with second derivative c leaves a line over time h by at most c h^2 / 8, so 1/8192 of what it would leave one
 * line by. */
#define PIECES 32

/* Keys of one kind of one node, as in the file. */
typedef struct track {
    float *time, *value;
    uint32_t keys;
    int width; /* numbers of a value */
    gltf_interpolation interpolation;
} track;

/* ---- Keys ---------------------------------------------------------------------------------------------------- */

static int check_times(const gltf_reader *r, const track *k)
{
    for (uint32_t i = 0; i < k->keys; i++) {
        if (!isfinite(k->time[i]) || k->time[i] < 0.0f || (i > 0 && !(k->time[i] > k->time[i - 1])))
            return trajectory_fail(r->t, 0, "the times of a clip do not ascend: key %" PRIu32 " is at %g s", i,
                                   (double)k->time[i]);
    }
    return 1;
}

static int read_track(const gltf_reader *r, const gltf_channel *c, track *k)
{
    uint32_t values = 0;
    k->width = c->path == GLTF_ROTATION ? 4 : 3;
    k->interpolation = c->interpolation;
    if (c->interpolation == GLTF_UNKNOWN)
        return trajectory_fail(r->t, 0, "a clip moves node %d without keys, or by an unknown interpolation", c->node);
    if (gltf_read_floats(r, c->input, 1, "times of keys", &k->time, &k->keys) < 0 ||
        gltf_read_floats(r, c->output, k->width, "keys", &k->value, &values) < 0 || check_times(r, k) < 0)
        return -1;
    const uint64_t expected = (uint64_t)k->keys * (c->interpolation == GLTF_CUBIC ? 3 : 1);
    if (values != expected)
        return trajectory_fail(r->t, 0, "a clip has %" PRIu32 " keys, of %" PRIu32 " times", values, k->keys);
    return (uint64_t)k->keys * PIECES < UINT_MAX ? 1 : trajectory_fail(r->t, 0, "%" PRIu32 " keys", k->keys);
}

/* How many keys of lines the track becomes. */
static size_t line_keys(const track *k)
{
    const size_t intervals = k->keys - 1;
    return 1 + intervals * (k->interpolation == GLTF_STEP ? 2 : k->interpolation == GLTF_CUBIC ? PIECES : 1);
}

/* Key n of the lines: its time and its value. */
static double line_key(const track *k, size_t n, float value[4])
{
    const size_t pieces = k->interpolation == GLTF_STEP ? 2 : k->interpolation == GLTF_CUBIC ? PIECES : 1;
    const size_t key = n / pieces, piece = n % pieces, width = (size_t)k->width;
    const double time = (double)k->time[key];
    if (k->interpolation != GLTF_CUBIC) {
        memcpy(value, k->value + width * key, width * sizeof *value);
        return piece == 0 ? time : nextafter((double)k->time[key + 1], 0.0);
    }
    /* in-tangent, value and out-tangent of each key */
    const float *const a = k->value + 3 * width * key, *const b = a + 3 * width;
    if (piece == 0) {
        memcpy(value, a + width, width * sizeof *value);
        return time;
    }
    const double span = (double)k->time[key + 1] - time, s = (double)piece / PIECES;
    for (size_t i = 0; i < width; i++) {
        const double from = (double)a[width + i], out = (double)a[2 * width + i];
        const double in = (double)b[i], to = (double)b[width + i];
        value[i] = (float)((1 + 2 * s) * (1 - s) * (1 - s) * from + s * (1 - s) * (1 - s) * span * out +
                           s * s * (3 - 2 * s) * to + s * s * (s - 1) * span * in);
    }
    return time + s * span;
}

/* ---- Channels ------------------------------------------------------------------------------------------------ */

static int set_vectors(const gltf_reader *r, const track *k, struct aiVectorKey **keys, unsigned *count)
{
    const size_t lines = line_keys(k);
    *keys = calloc(lines, sizeof **keys);
    if (*keys == NULL)
        return trajectory_fail(r->t, 0, "not enough memory for %zu keys", lines);
    *count = (unsigned)lines;
    for (size_t n = 0; n < lines; n++) {
        float v[4];
        (*keys)[n].mTime = line_key(k, n, v);
        (*keys)[n].mValue = (struct aiVector3D){v[0], v[1], v[2]};
    }
    return 1;
}

static int set_rotations(const gltf_reader *r, const track *k, struct aiNodeAnim *a)
{
    const size_t lines = line_keys(k);
    a->mRotationKeys = calloc(lines, sizeof *a->mRotationKeys);
    if (a->mRotationKeys == NULL)
        return trajectory_fail(r->t, 0, "not enough memory for %zu keys", lines);
    a->mNumRotationKeys = (unsigned)lines;
    for (size_t n = 0; n < lines; n++) {
        float v[4];
        a->mRotationKeys[n].mTime = line_key(k, n, v);
        a->mRotationKeys[n].mValue = (struct aiQuaternion){v[3], v[0], v[1], v[2]};
    }
    return 1;
}

static int set_track(const gltf_reader *r, gltf_path path, const track *k, struct aiNodeAnim *a)
{
    if (gltf_make(r, line_keys(k) * sizeof(struct aiQuatKey)) < 0)
        return -1;
    switch (path) {
    case GLTF_TRANSLATION: return set_vectors(r, k, &a->mPositionKeys, &a->mNumPositionKeys);
    case GLTF_SCALE: return set_vectors(r, k, &a->mScalingKeys, &a->mNumScalingKeys);
    default: return set_rotations(r, k, a);
    }
}

/* What no key moves stays as the node says. */
static int set_rest(const gltf_reader *r, const gltf_node *node, struct aiNodeAnim *a)
{
    const unsigned counts[3] = {a->mNumPositionKeys, a->mNumRotationKeys, a->mNumScalingKeys};
    const double *const rest[3] = {node->translation, node->rotation, node->scale};
    for (int path = GLTF_TRANSLATION; path <= GLTF_SCALE; path++) {
        float time = 0.0f, value[4];
        const int width = path == GLTF_ROTATION ? 4 : 3;
        for (int i = 0; i < width; i++)
            value[i] = (float)rest[path][i];
        const track k = {&time, value, 1, width, GLTF_LINEAR};
        if (counts[path] == 0 && set_track(r, (gltf_path)path, &k, a) < 0)
            return -1;
    }
    return 1;
}

static int has_keys(const struct aiNodeAnim *a, gltf_path path)
{
    return (path == GLTF_TRANSLATION ? a->mNumPositionKeys
            : path == GLTF_SCALE     ? a->mNumScalingKeys
                                     : a->mNumRotationKeys) > 0;
}

static int check_channel(const gltf_reader *r, const gltf_channel *c)
{
    if (c->node < 0 || (size_t)c->node >= r->f->nodes)
        return trajectory_fail(r->t, 0, "a clip moves node %d of %zu", c->node, r->f->nodes);
    if (c->path == GLTF_OTHER)
        return trajectory_fail(r->t, 0, "a clip changes something unknown of node %d", c->node);
    return c->path == GLTF_WEIGHTS || !r->f->node[c->node].has_matrix
               ? 1
               : trajectory_fail(r->t, 0, "a clip moves node %d, which has a matrix", c->node);
}

/* The animation's channel of a node; a new one where it has none yet. NULL: no memory. of_node: one for each node. */
static struct aiNodeAnim *channel_of(struct aiAnimation *a, int node, struct aiNodeAnim **of_node)
{
    if (of_node[node] == NULL && (of_node[node] = calloc(1, sizeof **of_node)) != NULL) {
        gltf_name_node(&of_node[node]->mNodeName, node);
        a->mChannels[a->mNumChannels++] = of_node[node];
    }
    return of_node[node];
}

static int add_channel(const gltf_reader *r, const gltf_channel *c, struct aiAnimation *a, struct aiNodeAnim **of_node)
{
    track k = {NULL, NULL, 0, 0, GLTF_LINEAR};
    if (c->node == GLTF_NONE) {
        trajectory_warn(r->t, DOUBT_INTERPOLATION, 0, "a clip changes what is no node, which is not played");
        a->mNumMorphMeshChannels++;
        return 1;
    }
    if (check_channel(r, c) < 0)
        return -1;
    if (c->path == GLTF_WEIGHTS) {
        trajectory_warn(r->t, DOUBT_MORPH, 0, "morph targets stay as they are: clips do not move them");
        a->mNumMorphMeshChannels++; /* a number alone: no array belongs to it */
        return 1;
    }
    struct aiNodeAnim *const channel = channel_of(a, c->node, of_node);
    if (channel == NULL)
        return trajectory_fail(r->t, 0, "not enough memory for a clip");
    if (has_keys(channel, c->path))
        return trajectory_fail(r->t, 0, "a clip moves node %d in two ways at once", c->node);
    const int result = read_track(r, c, &k) < 0 ? -1 : set_track(r, c->path, &k, channel);
    free(k.time);
    free(k.value);
    return result;
}

/* ---- Clips --------------------------------------------------------------------------------------------------- */

static int read_clip(const gltf_reader *r, const gltf_clip *clip, struct aiAnimation *a, struct aiNodeAnim **of_node)
{
    a->mTicksPerSecond = 1.0;
    a->mName.length =
        (ai_uint32)(strlen(clip->name) < sizeof a->mName.data ? strlen(clip->name) : sizeof a->mName.data - 1);
    memcpy(a->mName.data, clip->name, a->mName.length);
    a->mChannels = calloc(clip->channels.count + 1, sizeof(struct aiNodeAnim *));
    if (a->mChannels == NULL)
        return trajectory_fail(r->t, 0, "not enough memory for a clip");
    for (size_t c = 0; c < clip->channels.count; c++)
        if (add_channel(r, &r->f->channel[clip->channels.first + c], a, of_node) < 0)
            return -1;
    for (size_t c = 0; c < clip->channels.count; c++) {
        const int node = r->f->channel[clip->channels.first + c].node;
        struct aiNodeAnim *const channel = node != GLTF_NONE ? of_node[node] : NULL;
        if (channel != NULL && set_rest(r, &r->f->node[node], channel) < 0)
            return -1;
        if (node != GLTF_NONE)
            of_node[node] = NULL; /* for the next clip: clips and nodes may be many */
    }
    return 1;
}

int gltf_read_clips(gltf_reader *r)
{
    if (r->f->clips == 0)
        return 1;
    struct aiNodeAnim **const of_node = calloc(r->f->nodes + 1, sizeof(struct aiNodeAnim *));
    r->scene->mAnimations = calloc(r->f->clips, sizeof(struct aiAnimation *));
    int result = 1;
    for (size_t i = 0; result > 0 && i < r->f->clips; i++) {
        struct aiAnimation *const a = of_node != NULL && r->scene->mAnimations != NULL ? calloc(1, sizeof *a) : NULL;
        if (a == NULL) {
            result = trajectory_fail(r->t, 0, "not enough memory for %zu clips", r->f->clips);
            break;
        }
        r->scene->mAnimations[r->scene->mNumAnimations++] = a;
        result = read_clip(r, &r->f->clip[i], a, of_node);
    }
    free(of_node);
    return result;
}
