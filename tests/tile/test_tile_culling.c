/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What a tile of a camera leaves out before it tests pixels: boxes of cells, clusters and levels, cells that the march
 * passes by, what is occluded, what ends before the range, parts of large triangles. A ray of the tile meets each as
 * closely as float allows, and is not left out. Then the bounds are tightened, by lowering FILTER_ROUNDOFF below the
 * unit roundoff and likewise what stands for it in double, until it is. For the variant that this is compiled for. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "exact/valid_primitive.h"

#include "vector.h"

#include "kernel/tunables.h"

static const double given_scale = TILE_DOUBLE_ERROR_SCALE;
static float filter_u = 0x1p-24f;
static double double_scale = TILE_DOUBLE_ERROR_SCALE;
#undef FILTER_ROUNDOFF
#define FILTER_ROUNDOFF filter_u
#undef TILE_DOUBLE_ERROR_SCALE
#define TILE_DOUBLE_ERROR_SCALE double_scale
#include "kernel/tile_draw/tile_double.c"
#include "kernel/tile_frame/tile_cull.h"
#include "kernel/tile_frame/tile_init.c"

#include "support/tightened.h"
#include "tile/tile_case.h"

#define EDGE 8u /* of a tile */

static tile_case at;
static uint32_t pixel[2];  /* of at.line */
static double hit_t, p[3]; /* a point of that ray */

/* A ray of a camera, mostly at the tile's edge. Half of the pictures are as fine as they may be. */
static bool make_ray(test_random *r, bool parallel)
{
    at = make_camera_case(r, parallel);
    if (random_below(r, 2))
        for (int k = 0; k < 2; k++) {
            at.rays.pixel[k] = 2.f / 65536;
            at.at[k] = random_below(r, 65536 - EDGE);
        }
    for (int k = 0; k < 2; k++)
        pixel[k] = random_below(r, 3) ? random_below(r, 2) * (EDGE - 1) : random_below(r, EDGE);
    at.line = tile_pixel_line(&at.rays, parallel, ((float)(at.at[0] + pixel[0]) + 0.5f) * at.rays.pixel[0] - 1,
                              1 - ((float)(at.at[1] + pixel[1]) + 0.5f) * at.rays.pixel[1]);
    hit_t = (double)(at.scale * random_float(r, 0.5f, 3));
    for (int a = 0; a < 3; a++)
        p[a] = (double)at.line.org[a] + hit_t * (double)at.line.dir[a];
    return cgt_tile_supports_camera(&at.rays);
}

/* A float that is at least x, by a little. */
static float above(double x) { return nextafterf(nextafterf((float)x, INFINITY), INFINITY); }

/* ---- boxes ---- */

static cgt_cluster cluster;
static tile_box box; /* the same, from the eye */

/* A box with the point in a corner, an edge, a face or, except for rounding, alone. */
static bool make_box(test_random *r, bool parallel)
{
    if (!make_ray(r, parallel))
        return false;
    const bool is_point = random_below(r, 2);
    for (int a = 0; a < 3; a++) {
        const float half = !is_point && random_below(r, 3) ? at.scale * random_log(r, 1e-6f, 0.3f) : 0;
        cluster.middle[a] = (float)(p[a] + (double)(random_below(r, 2) ? half : -half));
        cluster.half[a] = above(fabs(p[a] - (double)cluster.middle[a]));
        const double middle = (double)cluster.middle[a] - (double)at.rays.eye[a];
        box.low[a] = middle - (double)cluster.half[a];
        box.high[a] = middle + (double)cluster.half[a];
    }
    return true;
}

static bool loses_cluster(const tile *t)
{
    const uint32_t reference = 0;
    return !tile_visible_clusters(t, &cluster, &reference, 1);
}

static bool loses_level(const tile *t) { return !tile_sees_box(t, &box); }

/* ---- cells and the march ---- */

static cgt_loose_grid grid;
static uint32_t place[3]; /* of the cell with the point */

/* A grid of few cells, one of which, with its reach, ends at the point, more or less. */
static bool make_grid(test_random *r, bool parallel)
{
    cgt_loose_level *l = &grid.level[0];
    if (!make_ray(r, parallel))
        return false;
    grid.levels = 1;
    l->prims = 1;
    for (int a = 0; a < 3; a++) {
        const float cell = at.scale * random_log(r, 1e-7f, 1e-3f);
        l->size[a] = 1 + random_below(r, 6);
        place[a] = random_below(r, l->size[a]);
        l->cell[a] = cell;
        l->reach[a] = random_below(r, 2) ? cell * random_float(r, 0.5f, 1) : cell * 0x1p-20f;
        const double before = (double)l->reach[a], after = (double)cell + (double)l->reach[a];
        l->low[a] = (float)(p[a] - place[a] * (double)cell + (random_below(r, 2) ? before : -after));
        const double low = (double)l->low[a] + place[a] * (double)cell, high = low + (double)cell;
        l->reach[a] = above(fmax(fmax(low - p[a], p[a] - high), before));
    }
    return true;
}

static bool loses_cell(const tile *t)
{
    tile_march m;
    tile_march_init(t, &grid, &m);
    const cgt_loose_level *l = &grid.level[0];
    const tile_slice s = {.cell = place[m.w], .high = {l->size[m.u] - 1, l->size[m.v] - 1}};
    const tile_cells c = tile_init_cells(t, &m, &s);
    const uint32_t number = place[m.v] * c.row_length + place[m.u], first = number / CGT_LANES * CGT_LANES;
    return !(tile_visible_cells(t, &c, first) >> (number - first) & 1);
}

/* Whether the march passes the cell by; *late: whether it comes to its slice after the hit. */
static bool march(const tile *t, bool *late)
{
    tile_march m;
    tile_slice s;
    tile_march_init(t, &grid, &m);
    *late = false;
    while (tile_march_next_slice(&m, &s)) {
        *late = *late || s.near_t > hit_t;
        if (s.cell == place[m.w])
            return !(s.low[0] <= place[m.u] && place[m.u] <= s.high[0] && s.low[1] <= place[m.v] &&
                     place[m.v] <= s.high[1]);
    }
    return true;
}

static bool loses_column(const tile *t)
{
    bool late;
    return march(t, &late);
}

static bool comes_late(const tile *t)
{
    bool late;
    return !march(t, &late) && late;
}

/* ---- what is occluded ---- */

static float depth;

static bool make_depth(test_random *r, bool parallel)
{
    depth = at.scale * random_log(r, 0.1f, 10);
    return make_ray(r, parallel);
}

/* Whether a hit of some pixel, all having the same depth, is beyond what its part can see; and the bounds of N. */
static bool sees_too_near(const tile *of, bool linear)
{
    static tile t;
    t = *of;
    t.linear = linear;
    t.depth_error = depth * 0x1p-10f;
    t.padded_depth_error = t.depth_error * TILE_FAR_FACTOR;
    for (uint32_t i = 0; i < TILE_PIXELS; i++)
        t.z[i] = linear ? -depth : depth;
    tile_update_far_distances(&t);
    for (uint32_t i = 0; i < EDGE * EDGE; i++) {
        const uint32_t k = tile_index(i % EDGE, i / EDGE);
        const double norm = tile_norm(&t, k), most = tile_depth_bound(&t, (double)t.z[k]);
        const double far_t = linear ? -1 / most : most / norm, far = linear ? far_t : most / sqrt(norm);
        if (far > (double)t.far_distance[0] || far_t > (double)t.max_far_t || norm > (double)t.max_norm ||
            norm < (double)t.min_norm || sqrt(norm) > (double)t.max_dir_length)
            return true;
    }
    return false;
}

static bool loses_depth(const tile *t) { return sees_too_near(t, false); }
static bool loses_linear_depth(const tile *t) { return sees_too_near(t, true); }

/* Whether some ray gets to a z in front of where it is said to. */
static bool comes_early(const tile *of)
{
    static tile t;
    t = *of;
    for (uint32_t i = 0; i < 2 * EDGE * EDGE; i++) {
        const uint32_t k = tile_index(i % EDGE, i / EDGE % EDGE);
        const cgt_ray ray = tile_pixel_ray(&t, k);
        double z = 0;
        t.linear = i >= EDGE * EDGE;
        for (int a = 0; a < 3; a++)
            z += (double)t.camera.dual[0][a] * (double)ray.line.dir[a];
        if ((double)tile_min_distance_scale(&t) * z > (t.linear ? 1 : sqrt(tile_norm(&t, k))))
            return true;
    }
    return false;
}

/* ---- the begin of the range ---- */

static float vertex[3][3], ball[4];

/* A triangle that faces the camera, as long as it is far away, and where the ray meets it. */
static bool make_facing(test_random *r, bool parallel)
{
    static const float corner[3][2] = {{-1, -1}, {1, -1}, {0, 1.5f}};
    if (!make_ray(r, parallel))
        return false;
    cgt_decided_hit hit = {.primitive = {.kind = CGT_KIND_TRIANGLES}};
    const cgt_ray ray = {.line = at.line, .t_max = INFINITY};
    uint64_t exact = 0;
    const float size = (float)hit_t * random_log(r, 1e-5f, 0.1f);
    double across[2][3], length[2] = {0, 0};
    for (int a = 0; a < 3; a++) {
        across[0][a] = (double)at.rays.right[a];
        across[1][a] = (double)at.rays.up[a];
        length[0] += across[0][a] * across[0][a];
        length[1] += across[1][a] * across[1][a];
    }
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++)
            vertex[k][a] = (float)(p[a] + (double)size * ((double)corner[k][0] * across[0][a] / sqrt(length[0]) +
                                                          (double)corner[k][1] * across[1][a] / sqrt(length[1])));
    memcpy(hit.primitive.triangle.v, vertex, sizeof vertex);
    if (!cgt_triangle_has_area(&hit.primitive.triangle) || !cgt_decide_hit(&ray, &hit, &exact))
        return false;
    cgt_decide_t(&ray, &hit);
    hit_t = hit.t;
    return true;
}

/* Whether a range that begins with the hit drops it, or one that begins behind lets it be drawn. */
static bool loses_begin_of_triangle(const tile *of)
{
    static tile t;
    static cgt_camera_rays rays;
    bool wrong = false;
    vfloat v[3][3];
    t = *of;
    rays = *of->rays;
    t.rays = &rays;
    for (int k = 0; k < 9; k++)
        v[k / 3][k % 3] = spux_vfloat(vertex[k / 3][k % 3]);
    for (int after = 0; after < 2; after++) {
        rays.t_min = after ? nextafterf((float)hit_t, INFINITY) : (float)hit_t;
        const tile_projected_triangles s =
            t.parallel ? tile_project_parallel_triangles(&t, v) : tile_project_triangles(&t, v);
        wrong = wrong || (spux_mask_bits(after ? spux_not(s.crosses_t_min) : s.before_t_min) & 1);
    }
    return wrong;
}

/* A sphere around a point of the ray, or around one beside it. */
static bool make_ball(test_random *r, bool parallel)
{
    float length = 0;
    if (!make_ray(r, parallel))
        return false;
    for (int a = 0; a < 3; a++) {
        length += at.line.dir[a] * at.line.dir[a];
        ball[a] = (float)p[a];
    }
    ball[3] = (float)hit_t * sqrtf(length) * random_log(r, 1e-6f, 0.3f);
    return true;
}

/* The ray's t where it enters or leaves the ball. */
static bool find_root(bool leaves, float *t)
{
    const cgt_ray ray = {.line = at.line, .t_min = -INFINITY, .t_max = INFINITY};
    cgt_decided_hit hit = {.primitive = {.kind = CGT_KIND_SPHERES}, .far = leaves};
    memcpy(&hit.primitive.sphere, ball, sizeof ball);
    if (!cgt_decide_root(&ray, &hit))
        return false;
    *t = (float)hit.t;
    return true;
}

static bool loses_begin_of_sphere(const tile *of)
{
    static tile t;
    static tile_spheres s;
    static cgt_camera_rays rays;
    bool wrong = false;
    float root[2];
    vfloat q[4], sphere[4];
    t = *of;
    rays = *of->rays;
    t.rays = &rays;
    if (!find_root(false, &root[0]) || !find_root(true, &root[1]) || !(root[0] > 0))
        return false;
    for (int k = 0; k < 4; k++)
        sphere[k] = spux_vfloat(ball[k]);
    tile_transform_spheres(&t, sphere, q);
    /* the ray leaves it as the range begins */
    rays.t_min = root[1];
    const tile_projected_spheres v = t.parallel ? tile_project_parallel_spheres(&t, q) : tile_project_spheres(&t, q);
    wrong = spux_mask_bits(t.parallel ? tile_cull_parallel_by_depth(&t, &v)
                                      : tile_cull_spheres_by_depth(&t, v.distance, v.r, v.min_distance)) &
            1;
    /* the range begins after it enters */
    rays.t_min = nextafterf(root[0], INFINITY);
    return wrong || ((t.parallel ? tile_setup_parallel_spheres(&t, &v, &s) : tile_setup_spheres(&t, &v, &s)) & 1);
}

/* ---- parts of a triangle in double precision ---- */

static cgt_triangle large;
static bool hits_large;

/* A triangle beside the tile, with an edge that follows its side. Do rays of that side hit it? */
static bool make_beside(test_random *r, bool parallel)
{
    static tile t;
    uint64_t exact = 0;
    if (!make_ray(r, parallel))
        return false;
    begin_tile(&t, &at);
    const bool across = random_below(r, 2), first = random_below(r, 2);
    const uint32_t side = first ? 0 : EDGE - 1;
    for (int k = 0; k < 3; k++) {
        const float t_vertex = (float)hit_t * random_log(r, 0.1f, 10);
        const float share = k == 2 ? 0.5f : k ? 1.5f : -0.5f, out = k == 2 ? 4 : 0;
        const float *of = across ? t.column : t.row, *other = across ? t.row : t.column;
        const float along = other[0] + share * (other[EDGE - 1] - other[0]);
        const float away = of[side] + out * (of[side] - of[EDGE - 1 - side]);
        const cgt_exact_ray line = tile_pixel_line(&at.rays, false, across ? away : along, across ? along : away);
        for (int a = 0; a < 3; a++)
            large.v[k][a] = line.org[a] + t_vertex * line.dir[a];
    }
    if (!cgt_triangle_has_area(&large))
        return false;
    hits_large = false;
    for (uint32_t k = 0; k < EDGE; k++) {
        const cgt_ray ray = tile_pixel_ray(&t, across ? tile_index(side, k) : tile_index(k, side));
        cgt_decided_hit hit = {.primitive = {.kind = CGT_KIND_TRIANGLES, .triangle = large}};
        hits_large = hits_large || cgt_decide_hit(&ray, &hit, &exact);
    }
    return hits_large;
}

static bool loses_part(const tile *t)
{
    const float px[2] = {t->column[0], t->column[EDGE - 1]}, py[2] = {t->row[0], t->row[EDGE - 1]};
    tile_double_forms f;
    tile_init_double_forms(t, &large, &f);
    return tile_cull_double(t, &f, px, py, INFINITY);
}

/* ---- all of them ---- */

static const struct bound {
    const char *name;
    bool (*make)(test_random *r, bool parallel);
    bool (*fails)(const tile *t);
    bool also_parallel;
} bounds[] = {
    {"a cluster culled", make_box, loses_cluster, true},
    {"a level out of sight", make_box, loses_level, true},
    {"a cell culled", make_grid, loses_cell, true},
    {"a cell passed by", make_grid, loses_column, true},
    {"a slice too late", make_grid, comes_late, false},
    {"a depth occluded", make_depth, loses_depth, true},
    {"a linear depth occluded", make_depth, loses_linear_depth, false},
    {"a hit said to be farther", make_ray, comes_early, false},
    {"the begin of a triangle", make_facing, loses_begin_of_triangle, true},
    {"the begin of a sphere", make_ball, loses_begin_of_sphere, true},
    {"a part of a triangle", make_beside, loses_part, false},
};

static void tighten(uint64_t stream, const struct bound *b, bool parallel)
{
    static tile t;
    test_random r = random_make(stream);
    uint64_t fails[STEPS] = {0}, cases = 0;
    char name[80];
    for (uint32_t k = 800 + test_scaled(4000); k; k--) {
        if (!b->make(&r, parallel))
            continue;
        cases++;
        for (int step = 0; step < bound_steps(); step++) {
            const float scale = exp2f(-0.5f * (float)step);
            filter_u = 0x1p-24f * scale;
            double_scale = given_scale * (double)scale;
            begin_tile(&t, &at);
            t.max_far_distance = t.max_far_t = INFINITY;
            for (uint32_t i = 0; i < TILE_PARTS * TILE_PARTS; i++)
                t.far_distance[i] = INFINITY;
            fails[step] += b->fails(&t);
        }
        filter_u = 0x1p-24f;
        double_scale = given_scale;
    }
    snprintf(name, sizeof name, "%llu%s: %s", (unsigned long long)cases, parallel ? " parallel" : "", b->name);
    check_break(name, fails, sizeof *fails, 0, 0);
}

TEST(bounds_of_perspective_break_where_they_are_tightened)
{
    for (uint32_t k = 0; k < TEST_COUNT(bounds); k++)
        tighten(480 + k, &bounds[k], false);
}

TEST(bounds_of_parallel_rays_break_where_they_are_tightened)
{
    for (uint32_t k = 0; k < TEST_COUNT(bounds); k++)
        if (bounds[k].also_parallel)
            tighten(500 + k, &bounds[k], true);
}

/* ---- underflow ---- */

/* Boxes of a few of the least floats, around a point of a ray, next to the eye. */
TEST(boxes_of_the_least_floats_are_seen)
{
    static tile t;
    test_random r = random_make(520);
    uint32_t cases = 0;
    for (uint32_t k = 800 + test_scaled(4000); k; k--) {
        if (!make_ray(&r, false))
            continue;
        memset(at.rays.eye, 0, sizeof at.rays.eye);
        begin_tile(&t, &at);
        t.max_far_distance = INFINITY;
        for (uint32_t i = 0; i < TILE_PARTS * TILE_PARTS; i++)
            t.far_distance[i] = INFINITY;
        const double least_t = (double)random_log(&r, 4, 1000) * 0x1p-149;
        for (int a = 0; a < 3; a++) {
            cluster.middle[a] = (float)((double)at.line.dir[a] * least_t);
            cluster.half[a] = 0x1p-149f;
        }
        cases++;
        if (loses_cluster(&t))
            fail_msg("a box of %a, %a, %a is culled", (double)cluster.middle[0], (double)cluster.middle[1],
                     (double)cluster.middle[2]);
    }
    assert_true(cases > 100);
}

VARIANT_SUITE("test_tile_culling", NULL, NULL)
