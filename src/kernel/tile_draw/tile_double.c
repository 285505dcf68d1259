/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A sphere or a triangle against the pixels of a tile in double precision, pixel by pixel, where the bounds of
 * tile_spheres.h and tile_triangles.h do not hold: primitives around the eye or behind it, primitives that the range's
 * begin may cut, and those so large that single precision is coarser than the tile's depth error. The arithmetic is
 * that of sphere_double.h and triangle_double.h, so a certain result is what decide.h would find; the rest is queued.
 * So are spheres whose t is next to an end of the range: the short formula may round it to the other side. */
#include "exact/sphere_double.h"
#include "exact/triangle_pair.h"
#include "kernel/tile_draw/tile_queue.h"

/* The tile's depth of a hit, infinite if its t is not in the range. */
CGT_SPU_INLINE double tile_double_depth(const tile *t, float px, float py, double hit, bool linear)
{
    const double rounded = (double)(float)hit, t_min = (double)t->rays->t_min, t_max = (double)t->rays->t_max;
    const double x = (double)px, y = (double)py;
    const double norm = 1 + (double)t->camera.a * x * x + (double)t->camera.b * y * y;
    const double depth = linear ? -1 / (hit > 0x1p-120 ? hit : 0x1p-120) : hit * norm; /* finite in float */
    const bool inside = (rounded >= t_min) & (rounded <= t_max) & (rounded < INFINITY);
    return inside ? depth : (double)INFINITY;
}

/* Pixels first to end - 1 of a pair of rows: the depth of a certain hit, infinity for a certain miss, NaN if double
 * precision does not decide. */
CGT_SPU_INLINE void tile_test_double_sphere(const tile *t, cgt_sphere q, uint32_t pair, bool parallel, uint32_t first,
                                            uint32_t end, double depth[TILE_ROW_PAIR])
{
    const cgt_camera_rays *c = t->rays;
    const double t_min = (double)c->t_min, t_max = (double)c->t_max;
    const cgt_sphere_terms of_eye = cgt_sphere_double_terms(c->eye, c->fwd, q);
    double product = of_eye.product; /* of all rays, but parallel ones */
    const uint64_t unsafe_product =
        cgt_sphere_double_unsafe_product(of_eye) && !cgt_sphere_double_refine(c->eye, q, &product);
    for (uint32_t i = first; i < end; i++) {
        const float px = t->px[i], py = t->row[2 * pair + (i & 1)];
        const cgt_exact_ray line = tile_pixel_line(c, parallel, px, py);
        cgt_sphere_terms e = cgt_sphere_double_terms(line.org, line.dir, q);
        const uint64_t product_error = parallel ? cgt_sphere_double_unsafe_product(e) : unsafe_product;
        e.product = parallel ? e.product : product;
        const double error = cgt_sphere_double_disc_error(line.org, line.dir, q);
        const double half = sqrt(e.disc);
        const cgt_sphere_roots root = cgt_sphere_double_roots(e, half);
        const double near = (double)(float)root.near, hit = near >= t_min ? root.near : root.far;
        const double inside = tile_double_depth(t, px, py, hit, false);
        const double known = e.disc < -error ? INFINITY : inside;
        const double other = root.near * (1 + 0x1p-21), /* beyond the next float */ before = root.near * (1 - 0x1p-21);
        const uint64_t at_end = ((before <= t_min) & (other >= t_min)) | ((before <= t_max) & (other >= t_max));
        const uint64_t undecided =
            cgt_sphere_double_unsafe_sum(e, half) | product_error | !(e.disc > error || e.disc < -error) | at_end;
        depth[i] = undecided && !(e.disc < -error) ? (double)NAN : known;
    }
}

CGT_SPU_INLINE void tile_test_double_triangle(const tile *t, const cgt_triangle *q, uint32_t pair, tile_kind kind,
                                              uint32_t first, uint32_t end, double depth[TILE_ROW_PAIR])
{
    cgt_triangle_plane of_eye = cgt_triangle_double_plane(t->rays->eye, t->rays->fwd, q);
    if (kind != TILE_PARALLEL && of_eye.num_error > fabs(of_eye.num) * CGT_DOUBLE_SAFE)
        cgt_triangle_refine_num(t->rays->eye, q, &of_eye);
    for (uint32_t i = first; i < end; i++) {
        const float px = t->px[i], py = t->row[2 * pair + (i & 1)];
        const cgt_exact_ray line = tile_pixel_line(t->rays, kind == TILE_PARALLEL, px, py);
        const cgt_triangle_sides s = cgt_triangle_double_sides(line.org, line.dir, q);
        cgt_triangle_plane p = cgt_triangle_double_plane(line.org, line.dir, q);
        p.num = kind == TILE_PARALLEL ? p.num : of_eye.num; /* of all rays from one origin */
        p.num_error = kind == TILE_PARALLEL ? p.num_error : of_eye.num_error;
        int positive = 0, negative = 0;
        for (int k = 0; k < 3; k++) {
            positive += s.w[k] > s.error[k];
            negative += s.w[k] < -s.error[k];
        }
        const double known = tile_double_depth(t, px, py, p.num / p.den, kind == TILE_LINEAR);
        const bool missed = (positive != 0) & (negative != 0);
        const bool hit = ((positive == 3) | (negative == 3)) & cgt_triangle_double_t_safe(&p);
        depth[i] = missed ? (double)INFINITY : hit ? known : (double)NAN;
    }
}

CGT_SPU_INLINE void tile_test_double_rows(const tile *t, const cgt_primitive *q, uint32_t pair, uint32_t first,
                                          uint32_t end, double depth[TILE_ROW_PAIR])
{
    const bool sphere = q->kind == CGT_KIND_SPHERES;
    if (sphere && t->parallel)
        tile_test_double_sphere(t, q->sphere, pair, true, first, end, depth);
    else if (sphere)
        tile_test_double_sphere(t, q->sphere, pair, false, first, end, depth);
    else if (t->linear)
        tile_test_double_triangle(t, &q->triangle, pair, TILE_LINEAR, first, end, depth);
    else if (t->parallel)
        tile_test_double_triangle(t, &q->triangle, pair, TILE_PARALLEL, first, end, depth);
    else
        tile_test_double_triangle(t, &q->triangle, pair, TILE_PERSPECTIVE, first, end, depth);
}

/* ---- culling by parts ---- */

/* A canonical direction, also one of a corner, is within 3.5 2^-24 |d| of a linear function of the pixel. A triangle's
 * sides and its d.n are linear in d, so between corners they deviate from the corners' convex combination by at most
 * 7 2^-24 |d| times the lengths of their factors. Their error bounds are 10 2^-53 times at least these lengths, so the
 * deviation is below 2^29 error bounds. TILE_DOUBLE_ERROR_SCALE, 2^30, covers the errors themselves, too. */

/* A triangle's sides and its d.n as factors of d, and their errors over |d| including the deviation between corners. */
typedef struct tile_double_forms {
    double form[4][3], error[4];
    double num, num_error;
} tile_double_forms;

CGT_SPU_INLINE void tile_init_double_forms(const tile *t, const cgt_triangle *q, tile_double_forms *f)
{
    static const float one[3] = {1, 0, 0}; /* of norm 1: gives errors over |d| */
    const float *eye = t->rays->eye;
    const cgt_triangle_plane plane = cgt_triangle_double_plane(eye, one, q);
    for (int k = 0; k < 3; k++)
        f->error[k] = cgt_triangle_double_edge(eye, q, (k + 1) % 3, (k + 2) % 3, f->form[k]) * TILE_DOUBLE_ERROR_SCALE;
    for (int a = 0; a < 3; a++)
        f->form[3][a] = plane.n[a];
    f->error[3] = plane.den_error * TILE_DOUBLE_ERROR_SCALE;
    f->num = plane.num;
    f->num_error = plane.num_error;
}

/* Whether no ray between two columns and two rows hits a triangle before far_t: all pass outside, or meet its plane
 * behind the eye or beyond far_t. */
CGT_SPU_INLINE bool tile_cull_double(const tile *t, const tile_double_forms *f, const float px[2], const float py[2],
                                     double far_t)
{
    double low[4] = {INFINITY, INFINITY, INFINITY, INFINITY}, high[4] = {-INFINITY, -INFINITY, -INFINITY, -INFINITY};
    bool below = false, above = false;
    /* the range of each form over the corners */
    for (int corner = 0; corner < 4; corner++) {
        const cgt_exact_ray line = tile_pixel_line(t->rays, false, px[corner & 1], py[corner >> 1]);
        const double x = (double)line.dir[0], y = (double)line.dir[1], z = (double)line.dir[2];
        const double size = fabs(x) + fabs(y) + fabs(z);
        for (int k = 0; k < 4; k++) {
            const double w = x * f->form[k][0] + y * f->form[k][1] + z * f->form[k][2], error = size * f->error[k];
            low[k] = w - error < low[k] ? w - error : low[k];
            high[k] = w + error > high[k] ? w + error : high[k];
        }
    }
    /* outside of one edge on each side, or the plane out of sight */
    for (int k = 0; k < 3; k++) {
        below = below || high[k] < 0;
        above = above || low[k] > 0;
    }
    const double min_num = fabs(f->num) - f->num_error, max_den = fmax(fabs(low[3]), fabs(high[3]));
    const bool certain = min_num > 0 && (low[3] > 0 || high[3] < 0), ahead = certain && (f->num > 0) == (low[3] > 0);
    const bool behind = certain && !ahead && min_num > max_den * 0x1p-100; /* a t that rounds to -0 is in the range */
    return (below && above) || behind || (ahead && min_num * (1 - 0x1p-20) > max_den * far_t);
}

/* The parts of a window, as bits, that a primitive may reach. */
static unsigned tile_visible_double_parts(const tile *t, const cgt_primitive *q, tile_rect rect)
{
    const uint32_t side = TILE_EDGE / TILE_PARTS, x0 = rect.x0 / side, x1 = rect.x1 / side, y0 = rect.y0 / side,
                   y1 = rect.y1 / side;
    tile_double_forms f;
    unsigned parts = 0;
    if (q->kind == CGT_KIND_SPHERES || t->parallel)
        return (1u << TILE_PARTS * TILE_PARTS) - 1;
    tile_init_double_forms(t, &q->triangle, &f);
    if ((x1 - x0 + 1) * (y1 - y0 + 1) > TILE_PARTS) {
        const float px[2] = {t->column[rect.x0], t->column[rect.x1]}, py[2] = {t->row[rect.y0], t->row[rect.y1]};
        if (tile_cull_double(t, &f, px, py, (double)t->max_far_t))
            return 0;
    }
    for (uint32_t y = y0; y <= y1; y++)
        for (uint32_t x = x0; x <= x1; x++) {
            const float px[2] = {t->column[x * side], t->column[x * side + side - 1]};
            const float py[2] = {t->row[y * side], t->row[y * side + side - 1]};
            const uint32_t k = y * TILE_PARTS + x;
            const double far_t = (double)t->far_distance[k] * (t->linear ? 1 : (double)t->rlength[k] * (1 + 0x1p-20));
            parts |= (unsigned)!tile_cull_double(t, &f, px, py, far_t) << k;
        }
    return parts;
}

/* ---- pixels ---- */

/* Rasterises pixels first to end - 1 of a pair of rows. */
CGT_SPU_INLINE void tile_rasterise_double_run(const cgt_primitives *prims, tile *t, const cgt_primitive *q,
                                              uint32_t prim, uint32_t pair, uint32_t first, uint32_t end,
                                              tile_queue *queue, cgt_counts *counts)
{
    double depth[TILE_ROW_PAIR];
    uint64_t found = 0;
    tile_test_double_rows(t, q, pair, first, end, depth);
    counts->ray_tests += end - first;
    counts->double_tests += end - first;
    for (uint32_t k = first; k < end; k++)
        found += !(depth[k] == INFINITY);
    if (!found)
        return;
    for (uint32_t k = first; k < end; k++) {
        const uint32_t i = pair * TILE_ROW_PAIR + k;
        const double z = (double)t->z[i];
        const double rounding =
            t->linear || z == INFINITY ? 0 : fabs(z) * 0x1p-22; /* of a hit beyond usual distances */
        if (depth[k] == INFINITY || depth[k] > tile_depth_bound(t, z) + rounding || z == -INFINITY)
            continue;
        if (depth[k] + fabs(depth[k]) * 0x1p-28 < z - rounding) {
            t->z[i] =
                (float)(t->linear ? depth[k] * (1 + 0.5 * TILE_LINEAR_ERROR) : depth[k] - 0.5 * (double)t->depth_error);
            tile_set_closest(t, i, prim);
            continue;
        }
        counts->double_tests--; /* the decision counts it */
        tile_queue_push(prims, t, queue, i, prim, counts);
    }
}

void CGT_KERNEL(cgt_tile_rasterise_double)(const cgt_primitives *prims, tile *t, uint32_t prim, tile_rect rect,
                                           tile_queue *queue, cgt_counts *counts)
{
    const cgt_primitive q = cgt_primitives_get(prims, prim);
    const uint32_t first = 2 * rect.x0, end = 2 * rect.x1 + 2, side = 2 * TILE_EDGE / TILE_PARTS;
    const unsigned parts = tile_visible_double_parts(t, &q, rect);
    counts->packet_tests++;
    for (uint32_t pair = rect.y0 / 2; parts && pair <= rect.y1 / 2; pair++) {
        const unsigned row = parts >> pair / (side / 4) * TILE_PARTS;
        for (uint32_t k = first / side; k * side < end; k++)
            if (row >> k & 1) {
                const uint32_t from = k * side > first ? k * side : first;
                const uint32_t to = (k + 1) * side < end ? (k + 1) * side : end;
                tile_rasterise_double_run(prims, t, &q, prim, pair, from, to, queue, counts);
            }
    }
}
