/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * See point_batch.h. What is off or invalid here is what kernels take for that (kernel/packet/ray_packet.h). Points are
 * ordered along a Morton curve as the light sees them: a counting sort by 32 x 32 cells. */
#include "trace/point_batch.h"

#include <math.h>
#include <string.h>

#define ORDER_CELLS 32u /* along each axis */

/* Points are ordered where the bounds of their chunks, as the light sees them and by the sum of the sides, are on average
 * more than this share of the bounds of all. */
#define COHERENT_SHARE 0.6f

_Static_assert(CGT_MAX_TASK_POINTS <= UINT16_MAX + 1, "a task's points are numbered in 16 bits");

/* ---- the caller's arrays ---- */

static size_t stride_of(const cgt_rays *points) { return points->stride ? points->stride : sizeof(float); }

static const void *element(const void *array, size_t stride, uint64_t i)
{
    return (const char *)array + (size_t)i * stride;
}
static float float_at(const float *array, size_t stride, uint64_t i)
{
    return *(const float *)element(array, stride, i);
}
static uint32_t number_at(const uint32_t *array, size_t stride, uint64_t i)
{
    return *(const uint32_t *)element(array, stride, i);
}

/* ---- live points ---- */

/* Lists the live ones of points first to end - 1, and finds the middle of their bounds. */
static void list_points(cgt_point_order *o, const cgt_rays *points, const cgt_light *light, uint64_t first,
                        uint64_t end, double middle[3])
{
    const size_t stride = stride_of(points);
    float low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint64_t i = first; i < end; i++) {
        const float position[3] = {float_at(points->org[0], stride, i), float_at(points->org[1], stride, i),
                                   float_at(points->org[2], stride, i)};
        const float t_min = points->t_min ? float_at(points->t_min, stride, i) : 0;
        const float t_max = points->t_max ? float_at(points->t_max, stride, i) : INFINITY;
        const cgt_point_state state = cgt_find_point_state(position, t_min, t_max, light);
        const bool live = state == CGT_POINT_LIVE;
        o->listed[o->live] = (uint16_t)(i - first); /* the next one overwrites a point that is not live */
        o->live += live;
        o->invalid += state == CGT_POINT_INVALID;
        for (int a = 0; a < 3; a++) {
            low[a] = live && position[a] < low[a] ? position[a] : low[a];
            high[a] = live && position[a] > high[a] ? position[a] : high[a];
        }
    }
    for (int a = 0; a < 3; a++)
        middle[a] = o->live ? 0.5 * (double)low[a] + 0.5 * (double)high[a] : 0;
}

/* ---- the order ---- */

/* What the light sees of points: slopes from a point, or offsets across a direction. */
typedef struct point_view {
    const float *array[3]; /* positions: along the main axis, then along the others */
    size_t stride;
    float origin[3], slope[3]; /* in that order */
    bool is_point;
} point_view;

/* The main axis is that of the ray of the middle point. */
static point_view view_init(const cgt_rays *points, const cgt_light *light, const double middle[3])
{
    point_view v = {.stride = stride_of(points), .is_point = light->kind == CGT_LIGHT_POINT};
    int main = 0;
    double d[3];
    for (int a = 0; a < 3; a++) {
        d[a] = (double)light->position[a] - (v.is_point ? middle[a] : 0);
        main = fabs(d[a]) > fabs(d[main]) ? a : main;
    }
    for (int k = 0; k < 3; k++) {
        const int a = (main + k) % 3;
        v.array[k] = points->org[a];
        v.origin[k] = v.is_point ? light->position[a] : (float)middle[a];
        v.slope[k] = v.is_point || d[main] == 0 ? 0 : (float)(d[a] / d[main]);
    }
    return v;
}

static void view_point(const point_view *v, uint64_t i, float seen[2])
{
    const float w = float_at(v->array[0], v->stride, i) - v->origin[0], scale = v->is_point ? 1 / w : 1;
    for (int k = 0; k < 2; k++)
        seen[k] = (float_at(v->array[k + 1], v->stride, i) - v->origin[k + 1] - v->slope[k + 1] * w) * scale;
}

typedef struct view_bounds {
    float low[2], high[2];
} view_bounds;

/* Whatever a light among the points sees beyond this slope is one cell. */
#define MAX_SLOPE 4.f

static void widen(const point_view *v, uint64_t i, view_bounds *b)
{
    float seen[2];
    view_point(v, i, seen);
    for (int k = 0; k < 2; k++) {
        const bool counts = !v->is_point || fabsf(seen[k]) < MAX_SLOPE;
        b->low[k] = counts && seen[k] < b->low[k] ? seen[k] : b->low[k];
        b->high[k] = counts && seen[k] > b->high[k] ? seen[k] : b->high[k];
    }
}

/* The sum of the sides; 0 of no points. */
static float sides(const view_bounds *b)
{
    float sum = 0;
    for (int k = 0; k < 2; k++)
        sum += b->high[k] > b->low[k] ? b->high[k] - b->low[k] : 0;
    return sum;
}

/* Finds the bounds of what is listed. Returns whether chunks of it are coherent. */
static bool find_bounds(const cgt_point_order *o, const point_view *v, uint64_t first, view_bounds *bounds)
{
    const view_bounds none = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    float chunk_sides = 0;
    *bounds = none;
    for (uint32_t i = 0; i < o->live; i += CGT_RAYS_CHUNK) {
        const uint32_t count = o->live - i < CGT_RAYS_CHUNK ? o->live - i : CGT_RAYS_CHUNK;
        view_bounds chunk = none;
        for (uint32_t k = i; k < i + count; k++)
            widen(v, first + o->listed[k], &chunk);
        for (int k = 0; k < 2; k++) {
            bounds->low[k] = fminf(bounds->low[k], chunk.low[k]);
            bounds->high[k] = fmaxf(bounds->high[k], chunk.high[k]);
        }
        chunk_sides += sides(&chunk) * (float)count;
    }
    return o->live <= CGT_RAYS_CHUNK || chunk_sides <= COHERENT_SHARE * sides(bounds) * (float)o->live;
}

/* Moves bits 0 to 4 to the even bits. */
static uint32_t spread_bits(uint32_t i) { return (i & 1) | (i & 2) << 1 | (i & 4) << 2 | (i & 8) << 3 | (i & 16) << 4; }

/* Also of a NaN. */
static uint32_t cell_of(float cell)
{
    return cell < (float)(ORDER_CELLS - 1) ? (uint32_t)(cell > 0 ? cell : 0) : ORDER_CELLS - 1;
}

/* Sorts what is listed by cells along the curve. */
static void sort_points(cgt_point_order *o, const point_view *v, uint64_t first, const view_bounds *bounds,
                        cgt_scratch *scratch)
{
    uint16_t *key = cgt_scratch_take(scratch, CGT_MAX_TASK_POINTS * sizeof *key),
             start[ORDER_CELLS * ORDER_CELLS] = {0}, sum = 0;
    float scale[2];
    for (int k = 0; k < 2; k++) { /* bounds beyond the range of float are one cell */
        const float side = bounds->high[k] - bounds->low[k];
        scale[k] = side > 0 ? (float)ORDER_CELLS / side : 0;
    }
    /* count, sum up, place */
    for (uint32_t i = 0; i < o->live; i++) {
        float seen[2];
        view_point(v, first + o->listed[i], seen);
        key[i] = (uint16_t)(spread_bits(cell_of((seen[0] - bounds->low[0]) * scale[0])) |
                            spread_bits(cell_of((seen[1] - bounds->low[1]) * scale[1])) << 1);
        start[key[i]]++;
    }
    for (uint32_t k = 0; k < ORDER_CELLS * ORDER_CELLS; k++) {
        const uint16_t count = start[k];
        start[k] = sum;
        sum = (uint16_t)(sum + count);
    }
    for (uint32_t i = 0; i < o->live; i++)
        o->number[start[key[i]]++] = o->listed[i];
    cgt_scratch_return(scratch, key);
}

#define MAGNITUDE 0x7fffffff /* the bits of a float but its sign: they order as magnitudes do */
#define INFINITE 0x7f800000

static inline int32_t magnitude_bits(float f)
{
    int32_t bits;
    memcpy(&bits, &f, sizeof bits);
    return bits & MAGNITUDE;
}

/* In whole numbers: the compiler makes vectors of the loop. */
bool cgt_points_are_live(const cgt_rays *points, const cgt_light *light)
{
    const bool is_point = light->kind == CGT_LIGHT_POINT;
    const float *x = points->org[0], *y = points->org[1], *z = points->org[2];
    const float lx = is_point ? light->position[0] : 0, ly = is_point ? light->position[1] : 0,
                lz = is_point ? light->position[2] : 0;
    int32_t most = 0, least = MAGNITUDE;
    if (stride_of(points) != sizeof(float) || points->t_min || points->t_max)
        return false;
    for (uint64_t i = 0; i < points->count; i++) {
        const int32_t px = magnitude_bits(x[i]), py = magnitude_bits(y[i]), pz = magnitude_bits(z[i]);
        const int32_t dx = magnitude_bits(lx - x[i]), dy = magnitude_bits(ly - y[i]), dz = magnitude_bits(lz - z[i]);
        most = px > most ? px : most;
        most = py > most ? py : most;
        most = pz > most ? pz : most;
        most = dx > most ? dx : most;
        most = dy > most ? dy : most;
        most = dz > most ? dz : most;
        least = (dx | dy | dz) < least ? dx | dy | dz : least;
    }
    return most < INFINITE && (!is_point || least > 0);
}

void cgt_point_order_init(cgt_point_order *o, const cgt_rays *points, const cgt_light *light, uint64_t first,
                          uint64_t end, cgt_scratch *scratch)
{
    double middle[3];
    view_bounds bounds;
    o->live = o->invalid = 0;
    list_points(o, points, light, first, end, middle);
    const point_view view = view_init(points, light, middle);
    const bool coherent = o->live <= CGT_RAYS_CHUNK || find_bounds(o, &view, first, &bounds);
    o->as_given = coherent && o->live == end - first;
    if (coherent)
        memcpy(o->number, o->listed, o->live * sizeof *o->number);
    else
        sort_points(o, &view, first, &bounds, scratch);
}

/* ---- batches ---- */

static void copy_numbers(const uint32_t *array, size_t stride, uint64_t first, const uint16_t *number, uint32_t count,
                         uint32_t *to)
{
    for (uint32_t k = 0; array && k < count; k++)
        to[k] = number_at(array, stride, first + number[k]);
}

static void copy_floats(const float *array, size_t stride, uint64_t first, const uint16_t *number, uint32_t count,
                        float *to)
{
    for (uint32_t k = 0; array && k < count; k++)
        to[k] = float_at(array, stride, first + number[k]);
}

void cgt_point_batch_fill(cgt_point_batch *b, const cgt_rays *points, uint64_t first, const uint16_t *number,
                          uint32_t count)
{
    const size_t stride = stride_of(points);
    for (int a = 0; a < 3; a++)
        copy_floats(points->org[a], stride, first, number, count, b->position[a]);
    copy_floats(points->t_min, stride, first, number, count, b->t_min);
    copy_floats(points->t_max, stride, first, number, count, b->t_max);
    copy_numbers(points->mask, stride, first, number, count, b->mask);
    copy_numbers(points->skip_primitive, stride, first, number, count, b->primitive);
    copy_numbers(points->skip_geometry, stride, first, number, count, b->geometry);
    b->rays = (cgt_rays){.count = count,
                         .org = {b->position[0], b->position[1], b->position[2]},
                         .t_min = points->t_min ? b->t_min : NULL,
                         .t_max = points->t_max ? b->t_max : NULL,
                         .mask = points->mask ? b->mask : NULL,
                         .skip_primitive = points->skip_primitive ? b->primitive : NULL,
                         .skip_geometry = points->skip_geometry ? b->geometry : NULL};
}
