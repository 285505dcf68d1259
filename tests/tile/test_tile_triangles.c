/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Triangles over the pixels of a tile: the bounds of single precision hold against exact decisions and canonical
 * depths. Then they are tightened, by lowering FILTER_ROUNDOFF below the unit roundoff, until they break. For the
 * variant that this is compiled for. */
#include "support/test.h"
#include "exact/valid_primitive.h"
#include "support/tightened.h"

#include <math.h>
#include <string.h>

#include "vector.h"

static float filter_u = 0x1p-24f;
#define FILTER_ROUNDOFF filter_u
#include "kernel/tile_draw/tile_decide_triangles.c"
#include "kernel/tile_draw/tile_parallel_triangles.h"
#include "kernel/tile_draw/tile_triangle_draw.h"
#include "kernel/tile_frame/tile_init.c"

#include "query/tile_limits.h"

static void tile_of(tile *t, const cgt_camera_rays *rays, const uint32_t at[2], float c, bool linear)
{
    t->rays = rays;
    t->linear = linear;
    t->columns = t->rows = 8;
    tile_init_camera(rays, &t->camera);
    tile_init_parallel(t);
    tile_init_tables(t, at[0], at[1]);
    tile_init_norms(t);
    tile_init_parts(t);
    tile_init_cone(t);
    if (t->parallel) {
        tile_init_parallel_depth_error(t, c, 0, 2 * c);
        tile_widen_parallel_error(t, c, at[0] % 2);
    } else {
        tile_init_sphere_depth_error(t, c, 0, 2 * c);
        tile_widen_depth_error(t, c);
    }
    tile_init_pixels(t, 2 * c);
    tile_ensure_pixels(t);
}

/* ---- bounds ---- */

typedef struct tally {
    uint64_t lanes, hits, certain, undecided, double_lanes, coarse;
    uint64_t culled_by_depth, culled_by_sides; /* triangles that are culled for the whole tile */
    uint64_t lost, invented, outside;          /* must be 0 */
} tally;

/* The exact decision about a triangle at each pixel of a tile, and its t. */
typedef struct tile_truth {
    bool hit[TILE_PIXELS];
    double hit_t[TILE_PIXELS];
} tile_truth;

static void find_truth(const tile *t, const cgt_triangle *q, tile_truth *truth)
{
    for (uint32_t k = 0; k < t->rows * t->columns; k++) {
        const uint32_t i = tile_index(k % t->columns, k / t->columns);
        const cgt_ray ray = tile_pixel_ray(t, i);
        cgt_decided_hit hit = {.primitive = {.kind = CGT_KIND_TRIANGLES, .triangle = *q}};
        uint64_t exact = 0;
        truth->hit[i] = cgt_decide_hit(&ray, &hit, &exact);
        truth->hit_t[i] = hit.t;
    }
}

static bool depth_holds(const tile *t, uint32_t i, double hit_t)
{
    const double depth = t->linear ? -1 / hit_t : hit_t * tile_norm(t, i), rounding = fabs(depth) * 0x1p-40;
    return (double)t->z[i] <= depth + rounding && depth <= tile_depth_bound(t, (double)t->z[i]) + rounding;
}

static bool any_hit(const tile *t, const tile_truth *truth)
{
    bool any = false;
    for (uint32_t k = 0; k < t->rows * t->columns; k++)
        any = any || truth->hit[tile_index(k % t->columns, k / t->columns)];
    return any;
}

/* Rasterises a triangle over an empty tile: stored pixels are certain, queued ones undecided. */
static void judge_triangle(tile *t, const cgt_triangle *q, const tile_truth *truth, tally *sum)
{
    static tile_queue queue;
    static bool undecided[TILE_PIXELS];
    static const uint32_t index[2][3] = {{0, 1, 2}, {0, 0, 0}};
    float point[4][3] = {{0}};
    memcpy(point, q->v, sizeof q->v);
    const cgt_primitive_array array = {.kind = CGT_KIND_TRIANGLES,
                                       .point = (const char *)point,
                                       .point_stride = 12,
                                       .index = (const char *)index,
                                       .index_stride = 12,
                                       .count = 2,
                                       .points = 4};
    const cgt_primitives prims = {.array = &array, .arrays = 1, .count = 2, .triangles = 2};
    const uint32_t reference = 0;
    vfloat v[3][3];
    tile_triangles s;
    cgt_counts counts = {0};
    queue.entries = 0;
    memset(undecided, 0, sizeof undecided);
    spux_store_uint(s.prim, load_references(&reference, 1));
    gather_scene_triangles(&prims, s.prim, v);
    if (t->parallel)
        tile_init_parallel_triangles(t, v, 1, &s);
    else
        tile_init_triangles(t, v, 1, &s);
    sum->double_lanes += s.double_lanes & 1;
    if (s.double_lanes & 1)
        return;
    sum->coarse += s.single_lanes & 1 && s.certain[0] == INFINITY;
    if (s.single_lanes & 1 && spux_mask_bits(tile_cull_triangles_by_forms(t, &s)) & 1) {
        sum->culled_by_depth++;
        sum->lost += any_hit(t, truth);
    }
    if (s.single_lanes & 1 && t->linear)
        tile_rasterise_triangle(&prims, t, &s, 0, TILE_LINEAR, &queue, &counts);
    else if (s.single_lanes & 1 && t->parallel)
        tile_rasterise_triangle(&prims, t, &s, 0, TILE_PARALLEL, &queue, &counts);
    else if (s.single_lanes & 1)
        tile_rasterise_triangle(&prims, t, &s, 0, TILE_PERSPECTIVE, &queue, &counts);
    for (uint32_t k = 0; k < queue.entries; k++)
        undecided[queue.pixel[k]] = true;
    for (uint32_t k = 0; k < t->rows * t->columns; k++) {
        const uint32_t i = tile_index(k % t->columns, k / t->columns);
        const bool certain = t->prim[i] == 0;
        sum->lanes++;
        sum->hits += truth->hit[i];
        sum->certain += certain;
        sum->undecided += undecided[i];
        sum->lost += truth->hit[i] && !certain && !undecided[i];
        sum->invented += certain && !truth->hit[i];
        sum->outside += certain && truth->hit[i] && !depth_holds(t, i, truth->hit_t[i]);
    }
}

/* A camera, and a triangle with an edge or a vertex as close to a ray of a tile of 8x8 pixels as float allows. Its size
 * ranges from far below a pixel to far above its distance, where it may cross the eye's plane. */
static void make_case(test_random *r, bool parallel, cgt_camera_rays *rays, uint32_t at[2], cgt_triangle *q)
{
    cgt_camera camera;
    char message[160];
    float e[2][3];
    const float scale = random_below(r, 3) ? 1 : random_log(r, 1e-6f, 1e6f);
    const float offset = random_below(r, 2) ? 0 : random_log(r, 0.1f, 1e4f);
    cgt_camera_init(&camera);
    for (int a = 0; a < 3; a++) {
        camera.eye[a] = scale * random_float(r, -1, 1) * offset;
        camera.target[a] = camera.eye[a] + scale * (a == 1 ? 2 : random_float(r, -1, 1));
    }
    random_direction(r, camera.up);
    camera.fov = random_below(r, 2) ? random_float(r, 20, 100) : random_log(r, 0.5f, 160);
    if (parallel) {
        camera.projection = CGT_PROJECTION_ORTHOGRAPHIC;
        camera.height = scale * (random_below(r, 2) ? random_float(r, 0.5f, 4) : random_log(r, 1e-3f, 30));
        if (random_below(r, 3) == 0) /* along an axis */
            for (int a = 0; a < 3; a++) {
                camera.target[a] = camera.eye[a] + (a == 2 ? scale : 0);
                camera.up[a] = a == 1;
            }
    }
    const uint32_t edge = 8 + random_below(r, random_below(r, 2) ? 1000 : 20);
    assert_int_equal(cgt_camera_prepare(&camera, edge, edge, rays, message), CGT_OK);
    at[0] = random_below(r, edge - 7);
    at[1] = random_below(r, edge - 7);
    const float px = ((float)(at[0] + random_below(r, 8)) + 0.5f) * rays->pixel[0] - 1;
    const float py = 1 - ((float)(at[1] + random_below(r, 8)) + 0.5f) * rays->pixel[1];
    const float t = scale * random_float(r, 0.5f, 3);
    const float size = t * (random_below(r, 3) ? random_log(r, 1e-4f, 1) : random_log(r, 1, 100));
    const float share = random_below(r, 4) ? random_float(r, 0, 1) : 0; /* the part of the edge before the ray */
    const float width = random_below(r, 3) ? 1 : random_log(r, 1e-7f, 1);
    const cgt_exact_ray line = tile_pixel_line(rays, parallel, px, py);
    random_direction(r, e[0]);
    random_direction(r, e[1]);
    if (parallel && random_below(r, 4) == 0) { /* nearly parallel to the rays */
        const float off = random_log(r, 1e-8f, 1e-2f);
        for (int a = 0; a < 3; a++)
            e[1][a] = line.dir[a] + off * e[1][a];
    }
    for (int a = 0; a < 3; a++) {
        const float p = line.org[a] + t * line.dir[a];
        q->v[0][a] = p - share * size * e[0][a];
        q->v[1][a] = p + (1 - share) * size * e[0][a];
        q->v[2][a] = p + size * (width * e[1][a] + (width < 1 ? 0.3f * e[0][a] : 0));
    }
    if (random_below(r, 2)) /* the opposite orientation */
        for (int a = 0; a < 3; a++) {
            const float first = q->v[0][a];
            q->v[0][a] = q->v[2][a];
            q->v[2][a] = first;
        }
}

static float farthest_of(const cgt_camera_rays *rays, const cgt_triangle *q)
{
    float most = 0;
    for (int k = 0; k < 3; k++) {
        float square = 0;
        for (int a = 0; a < 3; a++)
            square += (q->v[k][a] - rays->eye[a]) * (q->v[k][a] - rays->eye[a]);
        most = square > most ? square : most;
    }
    return sqrtf(most) * (1 + 0x1p-18f);
}

static void judge_case(const cgt_camera_rays *rays, const uint32_t at[2], const cgt_triangle *q, bool linear,
                       tile_truth *truth, bool fresh, tally *sum)
{
    static tile t;
    tile_of(&t, rays, at, farthest_of(rays, q), linear);
    if (fresh)
        find_truth(&t, q, truth);
    judge_triangle(&t, q, truth, sum);
}

static void check_bounds(uint64_t stream, bool parallel)
{
    static tile_truth truth;
    test_random r = random_make(stream);
    tally sum = {0};
    for (uint32_t k = 100 + test_scaled(8000); k; k--) {
        cgt_camera_rays rays;
        uint32_t at[2];
        cgt_triangle q;
        make_case(&r, parallel, &rays, at, &q);
        if (!cgt_tile_supports_camera(&rays) || !cgt_triangle_has_area(&q))
            continue;
        if (!parallel)
            judge_case(&rays, at, &q, true, &truth, true, &sum);
        judge_case(&rays, at, &q, false, &truth, parallel, &sum);
    }
    print_message("%llu lanes, %llu hits, %llu certain, %llu undecided; triangles: %llu slow, %llu coarse; lost %llu, "
                  "invented %llu, outside %llu\n",
                  (unsigned long long)sum.lanes, (unsigned long long)sum.hits, (unsigned long long)sum.certain,
                  (unsigned long long)sum.undecided, (unsigned long long)sum.double_lanes,
                  (unsigned long long)sum.coarse, (unsigned long long)sum.lost, (unsigned long long)sum.invented,
                  (unsigned long long)sum.outside);
    assert_int_equal(sum.lost, 0);
    assert_int_equal(sum.invented, 0);
    assert_int_equal(sum.outside, 0);
    assert_true(sum.certain > 100 && sum.undecided > 20 && sum.hits > 100 &&
                sum.lanes - sum.certain - sum.undecided > 100);
    assert_true(parallel || sum.culled_by_depth > 0);
}

static void bounds_hold(void **state)
{
    (void)state;
    check_bounds(410, false);
}

static void bounds_of_parallel_rays_hold(void **state)
{
    (void)state;
    check_bounds(420, true);
}

static void check_tightened_bounds(uint64_t stream, bool parallel)
{
    static tile_truth truth;
    test_random r = random_make(stream);
    tally sum[STEPS] = {{0}};
    for (uint32_t k = 400 + test_scaled(2000); k; k--) {
        cgt_camera_rays rays;
        uint32_t at[2];
        cgt_triangle q;
        make_case(&r, parallel, &rays, at, &q);
        if (!cgt_tile_supports_camera(&rays) || !cgt_triangle_has_area(&q))
            continue;
        float scale = 0x1p-24f;
        for (int step = 0; step < STEPS; step++, scale *= 0.70710678f) {
            filter_u = scale;
            judge_case(&rays, at, &q, !parallel && k % 2, &truth, step == 0, &sum[step]);
        }
        filter_u = 0x1p-24f;
    }
    /* the bounds are worst cases: random rays come within a few orders of magnitude */
    check_break("a hit lost", sum, sizeof *sum, offsetof(tally, lost), 0x1p-8);
    check_break("a hit invented", sum, sizeof *sum, offsetof(tally, invented), 0x1p-8);
    check_break("depth outside", sum, sizeof *sum, offsetof(tally, outside), 0x1p-10);
}

static void bounds_break_where_they_are_tightened(void **state)
{
    (void)state;
    check_tightened_bounds(430, false);
}

static void bounds_of_parallel_rays_break_where_they_are_tightened(void **state)
{
    (void)state;
    check_tightened_bounds(440, true);
}

/* ---- triangles next to a tile ---- */

/* A triangle that may cross the eye's plane, and lies as close to one side of a camera's tile as float allows: its
 * vertices are in that side's plane, some of them moved outwards. */
static bool make_adjacent(test_random *r, cgt_camera_rays *rays, uint32_t at[2], cgt_triangle *q)
{
    static tile t;
    float size[3];
    make_case(r, false, rays, at, q);
    if (!cgt_tile_supports_camera(rays))
        return false;
    tile_of(&t, rays, at, 1, true);
    const bool across = random_below(r, 2), first = random_below(r, 2);
    const float *of = across ? t.column : t.row, *other = across ? t.row : t.column;
    const float outward = (of[first ? 0 : 7] - of[first ? 7 : 0]) * random_log(r, 1e-6f, 1e2f);
    const float side = of[first ? 0 : 7], scale = random_log(r, 1e-2f, 1e2f);
    for (int k = 0; k < 3; k++)
        size[k] = scale * (k ? random_float(r, -1, 1) : random_float(r, 0.1f, 1));
    for (int k = 0; k < 3; k++) {
        const float along = other[random_below(r, 8)] + (k && random_below(r, 2) ? random_float(r, -3, 3) : 0);
        const cgt_exact_ray line = tile_pixel_line(rays, false, across ? side : along, across ? along : side);
        const float *out = across ? rays->right : rays->up;
        const float off = k && random_below(r, 2) ? outward * scale * random_float(r, 0, 1) : 0;
        for (int a = 0; a < 3; a++)
            q->v[k][a] = line.org[a] + size[k] * line.dir[a] + off * out[a];
    }
    return cgt_triangle_has_area(q);
}

/* Culled triangles have no hit. Those that just touch the tile may be culled or not. */
static void judge_side_culling(const tile *t, const cgt_triangle *q, const tile_truth *truth, tally *sum)
{
    vfloat v[3][3];
    for (int k = 0; k < 9; k++)
        v[k / 3][k % 3] = spux_vfloat(q->v[k / 3][k % 3]);
    const tile_projected_triangles seen = tile_project_triangles(t, v);
    const bool culled_by_sides = spux_mask_bits(tile_cull_triangles_by_sides(t, &seen)) & 1, hit = any_hit(t, truth);
    sum->lanes++;
    sum->hits += hit;
    sum->culled_by_sides += culled_by_sides;
    sum->lost += culled_by_sides && hit;
}

static void triangles_next_to_a_tile(void **state)
{
    (void)state;
    static tile_truth truth;
    static tile t;
    test_random r = random_make(460);
    tally sum[STEPS] = {{0}};
    for (uint32_t k = 2000 + test_scaled(8000); k; k--) {
        cgt_camera_rays rays;
        uint32_t at[2];
        cgt_triangle q;
        if (!make_adjacent(&r, &rays, at, &q))
            continue;
        float scale = 0x1p-24f;
        tile_of(&t, &rays, at, farthest_of(&rays, &q), true);
        find_truth(&t, &q, &truth);
        for (int step = 0; step < STEPS; step++, scale *= 0.70710678f) {
            filter_u = scale;
            judge_side_culling(&t, &q, &truth, &sum[step]);
        }
        filter_u = 0x1p-24f;
    }
    print_message("%llu triangles, %llu hit, %llu culled, %llu lost\n", (unsigned long long)sum[0].lanes,
                  (unsigned long long)sum[0].hits, (unsigned long long)sum[0].culled_by_sides,
                  (unsigned long long)sum[0].lost);
    assert_true(sum[0].hits > 100 && sum[0].culled_by_sides > 50);
    check_break("a visible triangle culled", sum, sizeof *sum, offsetof(tally, lost), 0x1p-10);
}

/* ---- pairs of triangles ---- */

/* Two triangles in one plane, exactly or except for rounding, or sharing vertices, or neither. */
static void make_pair(test_random *r, cgt_triangle pair[2])
{
    const uint32_t kind = random_below(r, 5), axis = random_below(r, 3);
    const float slope = random_below(r, 2) ? random_float(r, -1, 1) : random_log(r, 1e-9f, 1e-6f);
    for (int i = 0; i < 6; i++) {
        float *v = pair[i / 3].v[i % 3];
        for (int a = 0; a < 3; a++)
            v[a] = random_float(r, -3, 3);
        if (kind == 0) /* one plane exactly */
            v[axis] = 0.75f;
        else if (kind == 1) /* except for rounding */
            v[axis] = slope * v[(axis + 1) % 3];
        else if (kind == 2) /* layers */
            v[axis] = 0.5f + (float)(i / 3) * 0x1p-24f * (float)random_below(r, 3);
    }
    if (random_below(r, 4) == 0)
        for (int a = 0; a < 3; a++)
            pair[1].v[2][a] = pair[1].v[0][a] + random_log(r, 1e-7f, 1e-2f) * pair[1].v[2][a]; /* a sliver */
    for (uint32_t k = kind == 3 ? 1 + random_below(r, 3) : 0; k; k--)
        memcpy(pair[1].v[k - 1], pair[0].v[k - 1], sizeof pair[1].v[k - 1]);
}

/* Decisions of pairs agree with those of any two primitives, and hits have the same bits. */
static void pairs_are_decided_like_any_primitives(void **state)
{
    (void)state;
    test_random r = random_make(470);
    uint64_t answers[3] = {0}, planes[5] = {0};
    for (uint32_t round = 500 + test_scaled(4000); round; round--) {
        float point[6][3];
        const cgt_primitive_array array = {
            .kind = CGT_KIND_TRIANGLES, .point = (const char *)point, .point_stride = 12, .count = 2, .points = 6};
        const cgt_primitives prims = {.array = &array, .arrays = 1, .count = 2, .triangles = 2};
        cgt_triangle pair[2];
        tile_pair_cache s;
        cgt_counts counts = {0};
        cgt_ray ray = {.t_min = random_below(&r, 4) ? 0 : 1, .t_max = random_below(&r, 4) ? INFINITY : 3};
        make_pair(&r, pair);
        memcpy(point, pair, sizeof point);
        if (!cgt_triangle_has_area(&pair[0]) || !cgt_triangle_has_area(&pair[1]))
            continue;
        s.prim.prim = s.closest.prim = CGT_INVALID_ID;
        s.planes = TILE_PLANES_UNKNOWN;
        for (int a = 0; a < 3; a++)
            ray.line.org[a] = random_float(&r, -4, 4);
        for (uint32_t k = 0; k < 12; k++) {
            const uint32_t prim = k / 4 & 1, of = random_below(&r, 2);
            const float x = random_float(&r, 0, 1), y = random_float(&r, 0, 1 - x);
            for (int a = 0; a < 3; a++)
                ray.line.dir[a] =
                    (1 - x - y) * pair[of].v[0][a] + x * pair[of].v[1][a] + y * pair[of].v[2][a] - ray.line.org[a];
            cgt_decided_hit best = {.primitive = cgt_primitives_get(&prims, !prim)};
            uint64_t exact = 0;
            double t[2] = {0, 0};
            const uint32_t closest = cgt_decide_hit(&ray, &best, &exact) ? !prim : CGT_INVALID_ID;
            const tile_decision decision = tile_decide_pair(&prims, &ray, closest, prim, &s, &t[0], &counts);
            const bool accepted = filter_is_closer(&prims, &ray, closest, prim, &t[1], &counts);
            answers[decision]++;
            if (decision == TILE_UNDECIDED)
                continue;
            planes[s.planes]++;
            assert_int_equal(decision == TILE_ACCEPTED, accepted);
            assert_true(decision == TILE_REJECTED || t[0] == t[1]);
        }
    }
    print_message("undecided %llu, loses %llu, beats %llu; planes: cross %llu, same %llu, nearer %llu, farther %llu\n",
                  (unsigned long long)answers[TILE_UNDECIDED], (unsigned long long)answers[TILE_REJECTED],
                  (unsigned long long)answers[TILE_ACCEPTED], (unsigned long long)planes[TILE_PLANES_CROSS],
                  (unsigned long long)planes[TILE_PLANES_SAME], (unsigned long long)planes[TILE_PLANES_NEARER],
                  (unsigned long long)planes[TILE_PLANES_FARTHER]);
    assert_true(answers[TILE_REJECTED] > 500 && answers[TILE_ACCEPTED] > 500);
    assert_true(planes[TILE_PLANES_SAME] > 20 && planes[TILE_PLANES_NEARER] > 20 && planes[TILE_PLANES_FARTHER] > 20);
}

/* ---- long thin triangles ---- */

/* The order of vertices does not matter to the bounds: with its smallest angle first, a large triangle is decided with
 * the same certainty. */
static void thin_triangles_are_certain(void **state)
{
    (void)state;
    static tile t;
    static tile_truth truth;
    cgt_camera camera;
    cgt_camera_rays rays;
    char message[160];
    const uint32_t at[2] = {28, 28};
    cgt_camera_init(&camera);
    assert_int_equal(cgt_camera_prepare(&camera, 64, 64, &rays, message), CGT_OK);
    for (int turn = 0; turn < 3; turn++) {
        static const float corner[3][3] = {{-40, 0, 0}, {40, -0.06f, 0}, {40, 0.06f, 0}};
        cgt_triangle q;
        tally sum = {0};
        for (int k = 0; k < 9; k++)
            q.v[k / 3][k % 3] = corner[(k / 3 + turn) % 3][k % 3] + (k % 3 == 1 ? 0.05f : 0);
        tile_of(&t, &rays, at, farthest_of(&rays, &q), true);
        find_truth(&t, &q, &truth);
        judge_triangle(&t, &q, &truth, &sum);
        assert_true(sum.double_lanes == 0 && sum.coarse == 0 && sum.certain > 0 &&
                    sum.lost + sum.invented + sum.outside == 0);
    }
}

/* ---- fetching ---- */

/* No byte beyond the last triangle and the last vertex of an array is read. */
static void fetches_every_triangle(void **state)
{
    (void)state;
    test_random r = random_make(450);
    float point[40][3];
    uint32_t index[60][3];
    for (int k = 0; k < 120; k++)
        point[k / 3][k % 3] = random_float(&r, -1, 1);
    for (int k = 0; k < 180; k++)
        index[k / 3][k % 3] = random_below(&r, k < 150 ? 39 : 40);
    cgt_primitive_array array = {.kind = CGT_KIND_TRIANGLES,
                                 .first = 7,
                                 .point = (const char *)point,
                                 .point_stride = 12,
                                 .index = (const char *)index,
                                 .index_stride = 12,
                                 .count = 60,
                                 .points = 40};
    const cgt_primitives prims = {.array = &array, .arrays = 1, .count = 67, .triangles = 60};
    for (uint32_t round = 0; round < 200; round++) {
        _Alignas(CGT_VECTOR_BYTES) uint32_t prim[CGT_LANES];
        uint32_t reference[CGT_LANES] = {0};
        vfloat v[3][3];
        const uint32_t count = 1 + random_below(&r, CGT_LANES);
        array.index = round % 4 < 3 ? (const char *)index : NULL; /* otherwise there are 13, and one more vertex */
        array.count = array.index ? 60 : 13;
        for (uint32_t k = 0; k < count; k++)
            reference[k] = 7 + random_below(&r, array.count - (round % 2 ? 0 : array.count / 6));
        spux_store_uint(prim, load_references(reference, count));
        gather_scene_triangles(&prims, prim, v);
        for (uint32_t k = 0; k < CGT_LANES; k++) {
            assert_int_equal(prim[k], reference[k < count ? k : 0]);
            const cgt_triangle q = cgt_primitives_triangle(&prims, prim[k]);
            for (int i = 0; i < 9; i++) {
                _Alignas(64) float lane[CGT_LANES];
                spux_store(lane, v[i / 3][i % 3]);
                assert_true(lane[k] == q.v[i / 3][i % 3]);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fetches_every_triangle),
        cmocka_unit_test(bounds_hold),
        cmocka_unit_test(bounds_of_parallel_rays_hold),
        cmocka_unit_test(bounds_break_where_they_are_tightened),
        cmocka_unit_test(bounds_of_parallel_rays_break_where_they_are_tightened),
        cmocka_unit_test(triangles_next_to_a_tile),
        cmocka_unit_test(pairs_are_decided_like_any_primitives),
        cmocka_unit_test(thin_triangles_are_certain),
    };
    test_begin("test_tile_triangles");
    if (!test_variant_runs(CGT_VARIANT_NAME))
        return TEST_SKIPPED;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
