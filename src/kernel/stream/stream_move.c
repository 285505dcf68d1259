/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays of a stream, moved along their lines in double (query/moved_ray.h) to where single precision is fine enough:
 * those from far away or of odd lengths to the scene, and shadow rays to their common end if that lies among small
 * primitives and the rays begin far from it. Hits are decided on the rays as they were given. */
#include "kernel/stream/stream_read.h"

/* A moved origin that is less well known is left to cgt_trace_unusual: leaves count on distances below 2^7. */
#define MOVE_MAX_ERROR 0x1p-19f

/* Sets how much farther inside than 2^-18 of an end of the range t is certainly inside. 2^-19 of it leave the rest for
 * roundings. */
static void widen_range(float *error, float out, float in)
{
    const double rest = fabs((double)in - (double)out) - fabs((double)out) * 0x1p-19;
    if (rest > (double)*error)
        *error = (float)(rest * (1 + 0x1p-20));
}

/* Adds a ray of the streams to the bounds. */
static void add_to_bounds(const stream *s, uint32_t i, stream_bounds *b)
{
    const float *d = s->record[i];
    vfloat org[3], dir[3];
    for (int a = 0; a < 3; a++) {
        org[a] = spux_vfloat(d[RECORD_ORG + a]);
        dir[a] = spux_vfloat(d[RECORD_DIR + a]);
    }
    stream_bounds_add(b, org, dir, spux_vfloat(d[RECORD_NEAR]), spux_vfloat(d[RECORD_FAR]), spux_mask_all(), true);
}

/* Stores a moved ray as a record of an octant. It begins where it enters the scene, if that is later. */
static void store_moved(stream *s, uint32_t i, const moved_ray *m)
{
    const float enters = moved_end(m->near, 0, -1);
    float *d = s->record[i];
    s->key[i] = 0;
    for (uint32_t a = 0; a < 3; a++) {
        const float dir = (float)m->dir[a], rdir = 1 / (fabsf(dir) < BVH_MIN_DIR ? copysignf(BVH_MIN_DIR, dir) : dir);
        d[RECORD_RDIR + a] = rdir;
        d[RECORD_SHIFT + a] = -(m->start[a] * rdir);
        d[RECORD_ORG + a] = m->start[a];
        d[RECORD_DIR + a] = dir;
        s->key[i] |= (uint32_t)(rdir < 0) << a;
    }
    d[RECORD_NEAR] = d[RECORD_LEAF_NEAR] = m->near_out > enters ? m->near_out : enters;
    d[RECORD_FAR] = d[RECORD_LEAF_FAR] = m->far_out;
    if (m->near_in > d[RECORD_NEAR])
        widen_range(&s->call.range_error[0], d[RECORD_NEAR], m->near_in);
    widen_range(&s->call.range_error[1], m->far_out, m->far_in);
    s->unbounded = s->unbounded && m->far_out >= (float)MOVED_END;
    s->start_error = m->start_error > s->start_error ? m->start_error : s->start_error;
    if (!s->call.any_hit)
        s->best[i] = (best_hit){m->far_in, m->far_out, CGT_INVALID_ID, 0};
}

/* Moves a ray, to a t or, by NULL, to the scene. One that certainly misses is skipped, one that cannot be moved
 * stays. */
static void move_ray(stream *s, uint32_t i, const float *at)
{
    const bvh_call *c = &s->call;
    const cgt_ray ray = bvh_input_ray(c, i);
    moved_ray m = {.way = 0};
    const moved_state state = moved_ray_init_at(&m, c->committed_scene, &ray, at);
    if (state == MOVED_MISS)
        s->key[i] = STREAM_SKIPPED;
    else if (state == MOVED_READY && m.start_error <= MOVE_MAX_ERROR)
        store_moved(s, i, &m);
}

/* ---- to a common end ---- */

#define MEET_MIN_RAYS 64u   /* fewer do not pay for the search */
#define MEET_SPREAD 0x1p-8f /* ends that lie as close together, as a share of the rays' lengths, are one */
#define MEET_NEAR 0x1p-3f   /* what is as near to the end is better seen from there */
#define MEET_SMALL 0x1p-14f /* sizes of which single precision, 11 u of the lengths, decides too little */

/* How far a child of a node is from a point, plus its size: what is small and near there comes first. */
static float measure_child(const bvh_node *n, uint32_t child, const float point[3], float *size)
{
    float distance = 0;
    *size = 0;
    for (int a = 0; a < 3; a++) {
        const float low = n->low[a][child], high = n->high[a][child];
        const float away = point[a] < low ? low - point[a] : point[a] > high ? point[a] - high : 0;
        distance = away > distance ? away : distance;
        *size = high - low > *size ? high - low : *size;
    }
    return distance + *size;
}

/* Whether there are primitives near a point that are small, compared with a length. */
static bool is_fine_near(const cgt_bvh *tree, const float point[3], float length)
{
    uint32_t code = 0;
    for (;;) {
        const bvh_node *n = (const bvh_node *)tree->node + code;
        float least = INFINITY, size_of_least = INFINITY;
        for (uint32_t k = 0; k < n->children; k++) {
            float size;
            const float measure = measure_child(n, k, point, &size);
            if (measure >= least)
                continue;
            least = measure;
            size_of_least = size;
            code = n->child[k];
        }
        if (!(least < length * MEET_NEAR))
            return false;
        if (code & CGT_BVH_LEAF)
            return size_of_least < length * MEET_SMALL;
    }
}

/* Whether the rays end together, far from where they begin and among small primitives. */
static bool ends_are_fine(const stream *s, const stream_bounds *b)
{
    float length = 0, spread = 0, point[3];
    for (int a = 0; a < 3; a++) {
        const float low = spux_hmin(b->end_low[a]), high = spux_hmax(b->end_high[a]);
        const float below = low - spux_hmin(b->org_low[a]), above = spux_hmax(b->org_high[a]) - high;
        length = below > length ? below : length;
        length = above > length ? above : length;
        spread = high - low > spread ? high - low : spread;
        point[a] = 0.5f * (low + high) / s->call.scale;
    }
    return spread < length * MEET_SPREAD && is_fine_near(s->call.tree, point, length / s->call.scale);
}

/* ---- all rays ---- */

void CGT_KERNEL(cgt_stream_move_rays)(stream *s, uint32_t count, bool has_far, stream_bounds *b)
{
    const cgt_rays *rays = s->call.source->rays;
    const bool to_ends = s->call.any_hit && rays->t_max && count >= MEET_MIN_RAYS && ends_are_fine(s, b);
    if (!to_ends && !has_far)
        return;
    *b = stream_no_bounds();
    for (uint32_t i = 0; i < count; i++) {
        const bool is_far = s->key[i] == STREAM_UNUSUAL;
        if (s->key[i] == STREAM_SKIPPED)
            continue;
        if (to_ends) {
            const float t_max = ray_element(rays->t_max, s->call.source->stride, s->call.first + i);
            move_ray(s, i, &t_max);
        }
        if (is_far && s->key[i] == STREAM_UNUSUAL)
            move_ray(s, i, NULL);
        if (s->key[i] < STREAM_UNUSUAL && s->record[i][RECORD_FAR] > -BVH_MAX_T) /* else it reaches nothing */
            add_to_bounds(s, i, b);
    }
}
