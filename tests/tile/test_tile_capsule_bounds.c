/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Capsules over the pixels of a tile: windows, strips, least distances and depths hold against exact arithmetic. Then
 * they are tightened, by lowering FILTER_ROUNDOFF below the unit roundoff, until they break. For the variant that this
 * is compiled for. */
#include "support/oracle/oracle.h"

#include "vector.h"

static float filter_u = 0x1p-24f;
#define FILTER_ROUNDOFF filter_u
#include "kernel/tile_draw/tile_capsule_pairs.h"
#include "kernel/tile_frame/tile_init.c"

#include "tile/tile_bounds.h"

static tile_case at;
static oracle_primitive capsule;
static float farthest; /* of the capsule's ends, from the eye */

/* ---- one tile ---- */

typedef struct tile_truth {
    bool hit[TILE_PIXELS];
    truth_real depth[TILE_PIXELS];
} tile_truth;

static void find_truth(const tile *t, tile_truth *truth)
{
    for (uint32_t y = 0; y < t->rows; y++)
        for (uint32_t x = 0; x < t->columns; x++) {
            const uint32_t i = tile_index(x, y);
            const cgt_ray of = tile_pixel_ray(t, i);
            truth_ray ray = {.t_max = INFINITY};
            oracle_hit hit;
            memcpy(ray.org, of.line.org, sizeof ray.org);
            memcpy(ray.dir, of.line.dir, sizeof ray.dir);
            const truth_real px = t->column[x], py = t->row[y];
            truth->hit[i] = oracle_hits(&capsule, &ray, &hit);
            truth->depth[i] = hit.t * (1 + t->camera.a * px * px + t->camera.b * py * py);
        }
}

static void init_tile(tile *t)
{
    begin_tile(t, &at);
    if (t->parallel)
        tile_init_parallel_depth_error(t, farthest, 0, 4 * farthest);
    else
        tile_init_sphere_depth_error(t, farthest, 0, 4 * farthest);
    tile_widen_capsule_error(t, farthest);
    tile_init_pixels(t, 4 * farthest);
    tile_ensure_pixels(t);
}

/* Draws the capsule over an empty tile: stored pixels are certain, queued ones undecided. */
static void draw(tile *t, bool undecided[TILE_PIXELS])
{
    static tile_queue queue;
    const cgt_primitive_array array = {.kind = CGT_KIND_CAPSULES,
                                       .point = (const char *)capsule.data,
                                       .point_stride = 12,
                                       .radius = (const char *)(capsule.data + 6),
                                       .radius_stride = 4,
                                       .points = 2,
                                       .count = 1};
    const cgt_primitives prims = {.array = &array, .arrays = 1, .count = 1, .capsules = 1};
    const uint32_t reference = 0;
    tile_capsules s;
    cgt_counts counts = {0};
    queue.entries = 0;
    memset(undecided, 0, TILE_PIXELS * sizeof *undecided);
    tile_cull_capsules(t, &reference, 1, &prims, &s);
    (void)tile_draw_capsules(&(tile_capsule_draw){&prims, t, &s, &reference, &queue, &counts}, t->parallel);
    for (uint32_t k = 0; k < queue.entries; k++)
        undecided[queue.pixel[k]] = true;
}

static void judge_case(uint32_t form, bool fresh, tally *sum)
{
    static tile t;
    static tile_truth truth;
    static bool undecided[TILE_PIXELS];
    (void)form;
    init_tile(&t);
    if (fresh)
        find_truth(&t, &truth);
    draw(&t, undecided);
    for (uint32_t y = 0; y < t.rows; y++)
        for (uint32_t x = 0; x < t.columns; x++) {
            const uint32_t i = tile_index(x, y);
            const bool certain = t.prim[i] == 0, lost = truth.hit[i] && !certain && !undecided[i];
            if (lost && filter_u == 0x1p-24f)
                print_message("capsule %a %a %a, %a %a %a, r %a: pixel %u, %u\n", (double)capsule.data[0],
                              (double)capsule.data[1], (double)capsule.data[2], (double)capsule.data[3],
                              (double)capsule.data[4], (double)capsule.data[5], (double)capsule.data[6], x, y);
            sum->lanes++;
            sum->hits += truth.hit[i];
            sum->certain += certain;
            sum->undecided += undecided[i];
            sum->lost += lost;
            sum->invented += certain && !truth.hit[i];
            sum->outside += certain && truth.hit[i] &&
                            !((truth_real)t.z[i] <= truth.depth[i] &&
                              truth.depth[i] <= (truth_real)t.z[i] + (truth_real)t.depth_error);
        }
}

/* ---- cases ---- */

/* An axis that passes the ray at one radius, so that the ray is as close to tangential as float allows; it may be a rod
 * of a million radii, lead away from the eye, or begin next to it. */
static bool make_case(test_random *r, bool parallel)
{
    float side[3], away[3], across[3], axis[3], length[2], square = 0, along = 0, size = 0;
    at = make_camera_case(r, parallel);
    const float *d = at.line.dir;
    random_direction(r, away);
    for (int a = 0; a < 3; a++) {
        square += d[a] * d[a];
        along += d[a] * away[a];
    }
    for (int a = 0; a < 3; a++) {
        side[a] = away[a] - along / square * d[a];
        size += side[a] * side[a];
    }
    for (int a = 0; a < 3; a++)
        across[a] = d[(a + 1) % 3] * side[(a + 2) % 3] - d[(a + 2) % 3] * side[(a + 1) % 3];
    const float lean = random_below(r, 3) ? random_float(r, -4, 4) : random_log(r, 10, 1e6f);
    float norm = 0;
    for (int a = 0; a < 3; a++) {
        axis[a] = across[a] / sqrtf(size) + lean * d[a];
        norm += axis[a] * axis[a];
    }
    const float distance = at.scale * random_float(r, 0.5f, 3) / sqrtf(square), eye = distance * sqrtf(square);
    const float out = random_below(r, 4) ? 1 : random_float(r, 0, 2);
    const float radius = random_below(r, 20) ? eye * random_log(r, 1e-4f, 0.3f) : 0;
    for (int k = 0; k < 2; k++)
        length[k] = eye * (random_below(r, 2) ? random_float(r, -0.05f, 1) : random_log(r, 1e-3f, 1e6f));
    farthest = 0;
    capsule = (oracle_primitive){.kind = ORACLE_CAPSULE};
    for (int k = 0; k < 2; k++) {
        float from_eye = 0;
        for (int a = 0; a < 3; a++) {
            const float middle = at.line.org[a] + distance * d[a] + out * radius * side[a] / sqrtf(size);
            const float end = middle + (k ? length[k] : -length[k]) * axis[a] / sqrtf(norm);
            capsule.data[3 * k + a] = end;
            from_eye += (end - at.rays.eye[a]) * (end - at.rays.eye[a]);
        }
        farthest = fmaxf(farthest, sqrtf(from_eye));
    }
    capsule.data[6] = radius;
    farthest = fmaxf(farthest, eye) * (1 + 0x1p-10f);
    return cgt_tile_supports_camera(&at.rays);
}

TEST(bounds_of_perspective_hold) { (void)check_bounds(940, false, 1, 4000); }
TEST(bounds_of_parallel_rays_hold) { (void)check_bounds(941, true, 1, 2000); }

TEST(bounds_break_where_they_are_tightened)
{
    check_tightened_bounds(942, false, 1, (const double[3]){0.0005, 0.0005, 0.0005});
    check_tightened_bounds(943, true, 1, (const double[3]){0.0005, 0.0005, 0.0005});
}

VARIANT_SUITE("test_tile_capsule_bounds", NULL, NULL)
