/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Triangles over the pixels of a tile: the bounds of single precision hold against exact decisions and canonical
 * depths. Then they are tightened, by lowering FILTER_ROUNDOFF below the unit roundoff, until they break. For the
 * variant that this is compiled for. */
#include "exact/valid_primitive.h"

#include "vector.h"

static float filter_u = 0x1p-24f;
#define FILTER_ROUNDOFF filter_u
#include "kernel/tile_draw/tile_decide_triangles.c"
#include "kernel/tile_draw/tile_parallel_triangles.h"
#include "kernel/tile_draw/tile_triangle_draw.h"
#include "kernel/tile_frame/tile_init.c"

#include "tile/tile_bounds.h"

static void tile_of(tile *t, const tile_case *at, float c, bool linear)
{
    t->linear = linear;
    begin_tile(t, at);
    if (t->parallel) {
        tile_init_parallel_depth_error(t, c, 0, 2 * c);
        tile_widen_parallel_error(t, c, at->at[0] % 2);
    } else {
        tile_init_sphere_depth_error(t, c, 0, 2 * c);
        tile_widen_depth_error(t, c);
    }
    tile_init_pixels(t, 2 * c);
    tile_ensure_pixels(t);
}

/* ---- bounds ---- */

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

static tile_case at;
static cgt_triangle q;

/* A triangle with an edge or a vertex as close to a ray of the tile as float allows. Its size ranges from far below a
 * pixel to far above its distance, where it may cross the eye's plane. */
static bool make_case(test_random *r, bool parallel)
{
    float e[2][3];
    at = make_camera_case(r, parallel);
    const float t = at.scale * random_float(r, 0.5f, 3);
    const float size = t * (random_below(r, 3) ? random_log(r, 1e-4f, 1) : random_log(r, 1, 100));
    const float share = random_below(r, 4) ? random_float(r, 0, 1) : 0; /* the part of the edge before the ray */
    const float width = random_below(r, 3) ? 1 : random_log(r, 1e-7f, 1);
    random_direction(r, e[0]);
    random_direction(r, e[1]);
    if (parallel && random_below(r, 4) == 0) { /* nearly parallel to the rays */
        const float off = random_log(r, 1e-8f, 1e-2f);
        for (int a = 0; a < 3; a++)
            e[1][a] = at.line.dir[a] + off * e[1][a];
    }
    for (int a = 0; a < 3; a++) {
        const float p = at.line.org[a] + t * at.line.dir[a];
        q.v[0][a] = p - share * size * e[0][a];
        q.v[1][a] = p + (1 - share) * size * e[0][a];
        q.v[2][a] = p + size * (width * e[1][a] + (width < 1 ? 0.3f * e[0][a] : 0));
    }
    if (random_below(r, 2)) /* the opposite orientation */
        for (int a = 0; a < 3; a++) {
            const float first = q.v[0][a];
            q.v[0][a] = q.v[2][a];
            q.v[2][a] = first;
        }
    return cgt_tile_supports_camera(&at.rays) && cgt_triangle_has_area(&q);
}

static float farthest(void)
{
    float most = 0;
    for (int k = 0; k < 3; k++) {
        float square = 0;
        for (int a = 0; a < 3; a++)
            square += (q.v[k][a] - at.rays.eye[a]) * (q.v[k][a] - at.rays.eye[a]);
        most = square > most ? square : most;
    }
    return sqrtf(most) * (1 + 0x1p-18f);
}

/* Linear depths, which are for perspective alone, are the second form. */
static void judge_case(uint32_t form, bool fresh, tally *sum)
{
    static tile t;
    static tile_truth truth;
    tile_of(&t, &at, farthest(), form == 1);
    if (fresh)
        find_truth(&t, &q, &truth);
    judge_triangle(&t, &q, &truth, sum);
}

static const double least[3] = {0x1p-8, 0x1p-8, 0x1p-10};

TEST(bounds_hold) { assert_true(check_bounds(410, false, 2, 8000).culled_by_depth > 0); }

TEST(bounds_of_parallel_rays_hold) { check_bounds(420, true, 1, 8000); }

TEST(bounds_break_where_they_are_tightened) { check_tightened_bounds(430, false, 2, least); }

TEST(bounds_of_parallel_rays_break_where_they_are_tightened) { check_tightened_bounds(440, true, 1, least); }

/* ---- triangles next to a tile ---- */

/* A triangle that may cross the eye's plane, and lies as close to one side of a camera's tile as float allows: its
 * vertices are in that side's plane, some of them moved outwards. */
static bool make_adjacent(test_random *r)
{
    static tile t;
    const cgt_camera_rays *rays = &at.rays;
    float size[3];
    if (!make_case(r, false))
        return false;
    tile_of(&t, &at, 1, true);
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
            q.v[k][a] = line.org[a] + size[k] * line.dir[a] + off * out[a];
    }
    return cgt_triangle_has_area(&q);
}

/* Culled triangles have no hit. Those that just touch the tile may be culled or not. */
static void judge_side_culling(const tile *t, const tile_truth *truth, tally *sum)
{
    vfloat v[3][3];
    for (int k = 0; k < 9; k++)
        v[k / 3][k % 3] = spux_vfloat(q.v[k / 3][k % 3]);
    const tile_projected_triangles seen = tile_project_triangles(t, v);
    const bool culled_by_sides = spux_mask_bits(tile_cull_triangles_by_sides(t, &seen)) & 1, hit = any_hit(t, truth);
    sum->lanes++;
    sum->hits += hit;
    sum->culled_by_sides += culled_by_sides;
    sum->lost += culled_by_sides && hit;
}

TEST(triangles_next_to_a_tile)
{
    static tile_truth truth;
    static tile t;
    test_random r = random_make(460);
    tally sum[STEPS] = {{0}};
    for (uint32_t k = 2000 + test_scaled(8000); k; k--) {
        float scale = 0x1p-24f;
        if (!make_adjacent(&r))
            continue;
        tile_of(&t, &at, farthest(), true);
        find_truth(&t, &q, &truth);
        for (int step = 0; step < bound_steps(); step++, scale *= 0.70710678f) {
            filter_u = scale;
            judge_side_culling(&t, &truth, &sum[step]);
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
TEST(pairs_are_decided_like_any_primitives)
{
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
TEST(thin_triangles_are_certain)
{
    static tile t;
    static tile_truth truth;
    cgt_camera camera;
    cgt_camera_init(&camera);
    at = (tile_case){.at = {28, 28}};
    make_case_rays(&camera, 64, &at.rays);
    for (int turn = 0; turn < 3; turn++) {
        static const float corner[3][3] = {{-40, 0, 0}, {40, -0.06f, 0}, {40, 0.06f, 0}};
        tally sum = {0};
        for (int k = 0; k < 9; k++)
            q.v[k / 3][k % 3] = corner[(k / 3 + turn) % 3][k % 3] + (k % 3 == 1 ? 0.05f : 0);
        tile_of(&t, &at, farthest(), true);
        find_truth(&t, &q, &truth);
        judge_triangle(&t, &q, &truth, &sum);
        assert_true(sum.double_lanes == 0 && sum.coarse == 0 && sum.certain > 0 &&
                    sum.lost + sum.invented + sum.outside == 0);
    }
}

/* ---- fetching ---- */

/* No byte beyond the last triangle and the last vertex of an array is read. */
TEST(fetches_every_triangle)
{
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
            const cgt_triangle fetched = cgt_primitives_triangle(&prims, prim[k]);
            for (int i = 0; i < 9; i++) {
                _Alignas(64) float lane[CGT_LANES];
                spux_store(lane, v[i / 3][i % 3]);
                assert_true(lane[k] == fetched.v[i / 3][i % 3]);
            }
        }
    }
}

VARIANT_SUITE("test_tile_triangles", NULL, NULL)
