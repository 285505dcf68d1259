/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A tile of a camera's frame, ready for its first primitive: tables of its pixels' coordinates, bounds of its rays, and
 * the depth error that it allows for. */
#include "kernel/tile_draw/tile_capsules.h"
#include "kernel/tile_draw/tile_parallel_triangles.h"
#include "kernel/tile_frame/tile_planes.h"

/* ---- the camera ---- */

CGT_SPU_INLINE void tile_cross(const float p[3], const float q[3], double cross[3])
{
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        cross[a] = (double)p[b] * (double)q[c] - (double)p[c] * (double)q[b];
    }
}

CGT_SPU_INLINE void tile_init_camera(const cgt_camera_rays *c, tile_camera *q)
{
    double normal[3][3], right = 0, up = 0, volume = 0;
    tile_cross(c->right, c->up, normal[0]);
    tile_cross(c->up, c->fwd, normal[1]);
    tile_cross(c->fwd, c->right, normal[2]);
    for (int a = 0; a < 3; a++) {
        right += (double)c->right[a] * (double)c->right[a];
        up += (double)c->up[a] * (double)c->up[a];
        volume += (double)c->fwd[a] * normal[0][a];
    }
    const double length[3] = {1, sqrt(right), sqrt(up)};
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++)
            q->dual[k][a] = (float)(normal[k][a] / volume * length[k]);
    q->right = (float)length[1];
    q->up = (float)length[2];
    q->a = c->orthographic ? 0 : (float)right;
    q->b = c->orthographic ? 0 : (float)up;
    q->rright = (float)(1 / length[1]);
    q->rup = (float)(1 / length[2]);
}

/* ---- tables and bounds ---- */

CGT_SPU_INLINE tile_span tile_compute_span(float scale, float first, float pixel, uint32_t pixels)
{
    return (tile_span){scale / pixel, first / pixel, (float)pixels, (float)(pixels - 1)};
}

CGT_SPU_INLINE void tile_init_tables(tile *t, uint32_t x0, uint32_t y0)
{
    const float *pixel = t->rays->pixel;
    const uint32_t last_column = t->columns - 1, last_row = t->rows - 1;
    const vmask second = spu_cmpeq(spu_and(spux_lane_index(), spux_vuint(1)), spux_vuint(1));
    for (uint32_t k = 0; k < TILE_EDGE; k++) { /* in the order of camera.h */
        t->column[k] = ((float)(int32_t)(x0 + (k < last_column ? k : last_column)) + 0.5f) * pixel[0] - 1;
        t->row[k] = 1 - ((float)(int32_t)(y0 + (k < last_row ? k : last_row)) + 0.5f) * pixel[1];
    }
    for (uint32_t k = 0; k < TILE_EDGE; k++)
        t->px[2 * k] = t->px[2 * k + 1] = t->column[k];
    for (uint32_t k = 0; k < TILE_PAD; k++)
        t->px[TILE_ROW_PAIR + k] = NAN;
    for (uint32_t y = 0; y < TILE_EDGE; y += 2)
        spux_store(t->py[y / 2], spux_select(spux_vfloat(t->row[y]), spux_vfloat(t->row[y + 1]), second));
    t->column_span = tile_compute_span(t->camera.rright, t->column[0], pixel[0], t->columns);
    t->row_span = tile_compute_span(-t->camera.rup, -t->row[0], pixel[1], t->rows); /* rows run down */
    t->span_ratio = t->row_span.scale / t->column_span.scale;
}

CGT_SPU_INLINE float tile_min_square(float a, float b)
{
    const float low = fabsf(a) < fabsf(b) ? fabsf(a) : fabsf(b);
    return (a < 0) != (b < 0) ? 0 : low * low;
}
CGT_SPU_INLINE float tile_max_square(float a, float b)
{
    const float high = fabsf(a) > fabsf(b) ? fabsf(a) : fabsf(b);
    return high * high;
}

/* Each coordinate of a canonical origin has four roundings: px right, eye + px right, py up and the sum. With |px| and
 * |py| at most 1 it is off by u (2 |eye| + 3 |right| + 2 |up|) of that axis, and as a vector by u times the sum of
 * those lengths. The inverse of the axes takes this error to camera space unchanged, except for a relative 4 u. */
CGT_SPU_INLINE void tile_init_parallel(tile *t)
{
    const cgt_camera_rays *c = t->rays;
    const double e[3] = {(double)c->eye[0], (double)c->eye[1], (double)c->eye[2]};
    const double eye = sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]);
    const double right = (double)t->camera.right, up = (double)t->camera.up;
    t->parallel = c->orthographic;
    t->origin_error = t->parallel ? (float)((2 * eye + 3 * right + 2 * up) * (1 + 0x1p-18)) : 0;
    t->origin_offset = t->parallel ? (float)((right + up) * (1 + 0x1p-18)) : 0;
    t->length_error = 0x1p-60f + t->origin_error * TILE_EPS_ORIGIN;
}

/* The range of N over the tile, and 1 / sqrt(N) of its parts, rounded outwards. Squares, lengths, sums lose 5 u of N,
 * the root half of that and u, the quotient u. */
CGT_SPU_INLINE void tile_init_norms(tile *t)
{
    const float *x = t->column, *y = t->row, a = t->camera.a, b = t->camera.b;
    const uint32_t last = TILE_EDGE - 1;
    t->max_norm = (1 + a * tile_max_square(x[0], x[last]) + b * tile_max_square(y[0], y[last])) * TILE_FAR_FACTOR;
    t->min_norm = (1 + a * tile_min_square(x[0], x[last]) + b * tile_min_square(y[0], y[last])) * (2 - TILE_FAR_FACTOR);
    t->max_dir_length = sqrtf(t->max_norm) * TILE_FAR_FACTOR;
    for (uint32_t k = 0; k < TILE_PARTS * TILE_PARTS; k++) {
        const uint32_t u = k % TILE_PARTS * 16, v = k / TILE_PARTS * 16;
        const float min_norm = 1 + a * tile_min_square(x[u], x[u + 15]) + b * tile_min_square(y[v], y[v + 15]);
        t->rlength[k] = 1 / sqrtf(min_norm) * TILE_FAR_FACTOR;
    }
}

CGT_SPU_INLINE void tile_init_parts(tile *t)
{
    for (uint32_t k = 0; k < TILE_PARTS * TILE_PARTS; k++) {
        const float *x = t->column + k % TILE_PARTS * 16, *y = t->row + k / TILE_PARTS * 16;
        t->part_x[k] = 0.5f * (x[0] + x[15]);
        t->part_y[k] = 0.5f * (y[0] + y[15]);
        t->part_half_width[k] = 0.5f * fabsf(x[15] - x[0]) + 0x1p-22f;
        t->part_half_height[k] = 0.5f * fabsf(y[15] - y[0]) + 0x1p-22f;
    }
}

/* The cone around the axis through the tile's middle that contains the corner rays contains all rays. The margin of the
 * culling (2^-18) covers the rounding of the axis. */
CGT_SPU_INLINE void tile_init_cone(tile *t)
{
    const uint32_t last = TILE_EDGE - 1;
    const float gx[2] = {t->column[0] * t->camera.right, t->column[last] * t->camera.right};
    const float gy[2] = {t->row[0] * t->camera.up, t->row[last] * t->camera.up};
    const float mx = 0.5f * (gx[0] + gx[1]), my = 0.5f * (gy[0] + gy[1]), r = 1 / sqrtf(1 + mx * mx + my * my);
    float sine2 = 0;
    bool narrow = !t->parallel;
    t->axis[0] = r;
    t->axis[1] = mx * r;
    t->axis[2] = my * r;
    for (int k = 0; k < 4; k++) {
        const float x = gx[k & 1], y = gy[k >> 1], s = r + x * t->axis[1] + y * t->axis[2];
        const float ez = 1 - s * t->axis[0], ex = x - s * t->axis[1], ey = y - s * t->axis[2];
        const float square = (ex * ex + ey * ey + ez * ez) / (1 + x * x + y * y);
        sine2 = square > sine2 ? square : sine2;
        narrow = narrow && s > 0;
    }
    sine2 = sine2 * (1 + 0x1p-18f) + 0x1p-40f;
    narrow = narrow && sine2 < 0.5f;
    t->secant = narrow ? 1 / sqrtf(1 - sine2) * (1 + 0x1p-18f) : 0;
    t->tangent = narrow ? sqrtf(sine2) * t->secant : 0;
}

/* ---- the tile ---- */

#define USUAL_SHARE 64u /* of the primitives: a level with less does not make the depth error */

/* A box, seen from the eye. */
typedef struct tile_box {
    double low[3], high[3];
} tile_box;

/* The distance from the eye to the farthest corner of a box, rounded up. */
CGT_SPU_INLINE float tile_max_corner_distance(const tile_box *b)
{
    double square = 0;
    for (int a = 0; a < 3; a++) {
        const double low = fabs(b->low[a]), high = fabs(b->high[a]), distance = low > high ? low : high;
        square += distance * distance;
    }
    return (float)(sqrt(square) * (1 + 0x1p-20));
}

/* The box of all primitives of a level. */
CGT_SPU_INLINE tile_box tile_level_box(const cgt_loose_level *l, const float eye[3])
{
    tile_box b;
    for (int a = 0; a < 3; a++) {
        const double low = (double)l->low[a] - (double)eye[a], reach = (double)l->reach[a] * (1 + 0x1p-40);
        b.low[a] = low - reach;
        b.high[a] = low + (double)l->cell[a] * l->size[a] + reach;
    }
    return b;
}

/* Whether some ray of the tile may meet the box: false where all its corners lie beyond one side of the tile. In camera
 * space a ray of pixel (px, py) passes x = px rho z, or x = px rho where rays are parallel. The axes and the canonical
 * directions and origins are off by less than 2^-20 of what they are multiplied with. */
#define TILE_EPS_SEEN (64 * FILTER_ROUNDOFF) /* 2^-18 */

static bool tile_sees_box(const tile *t, const tile_box *b)
{
    const double column[2] = {(double)t->column[0], (double)t->column[TILE_EDGE - 1]};
    const double row[2] = {(double)t->row[TILE_EDGE - 1], (double)t->row[0]};
    const double right = (double)t->camera.right, up = (double)t->camera.up;
    bool in[5] = {false, false, false, false, false};
    for (int k = 0; k < 8; k++) {
        const double p[3] = {k & 1 ? b->high[0] : b->low[0], k & 2 ? b->high[1] : b->low[1],
                             k & 4 ? b->high[2] : b->low[2]};
        const double size = fabs(p[0]) + fabs(p[1]) + fabs(p[2]);
        double v[3];
        for (int i = 0; i < 3; i++)
            v[i] = p[0] * (double)t->camera.dual[i][0] + p[1] * (double)t->camera.dual[i][1] +
                   p[2] * (double)t->camera.dual[i][2];
        const double z = t->parallel ? 1 : v[0];
        const double share = (double)TILE_EPS_SEEN, length_error = (double)t->length_error;
        const double error = (size * (1 + right + up) + length_error) * share + length_error;
        in[0] = in[0] || v[0] >= -error;
        in[1] = in[1] || v[1] >= column[0] * right * z - error;
        in[2] = in[2] || v[1] <= column[1] * right * z + error;
        in[3] = in[3] || v[2] >= row[0] * up * z - error;
        in[4] = in[4] || v[2] <= row[1] * up * z + error;
    }
    return in[0] && in[1] && in[2] && in[3] && in[4];
}

/* The largest distance from the eye of a primitive that the tile may hit: of the levels that it sees, so that a
 * primitive far away, or a huge one, counts only where it is in view. usual: the same of the levels with a good share
 * of the primitives, for the depth error; primitives beyond are slow (tile_double.c, tile_queue.h).
 *
 * The z of a hit at a distance c beyond them is rounded, by at most u c |d|, which may be more than the half of the
 * depth error that tile_compute_depth leaves on both sides. That does no harm: a primitive whose depth is certain errs
 * by less than the depth error, and its bound is at least 32 u of its own distance, so a z of like size is within its
 * interval, and one of another size is told apart all the same. A depth that is compared with such a z to cull is a
 * lower bound, by 3 u c |d| or more below all that its errors add up to (spheres 3.5 u of 44, parallel ones 18,
 * triangles 5.5 of 40, parallel ones 8 of 72, capsules 8). tile_double.c, which has no such bounds, adds the
 * rounding. */
CGT_SPU_INLINE float tile_max_distance(const tile *t, const cgt_committed_scene *committed_scene, float *usual)
{
    const float *eye = t->rays->eye;
    const cgt_loose_grid *g = &committed_scene->loose;
    float most = 0;
    tile_box all;
    for (int a = 0; a < 3; a++) {
        all.low[a] = (double)committed_scene->low[a] - (double)eye[a];
        all.high[a] = (double)committed_scene->high[a] - (double)eye[a];
    }
    const float whole = tile_max_corner_distance(&all);
    *usual = 0;
    for (uint32_t k = 0; k < g->levels && g->levels > 1; k++) {
        const tile_box b = tile_level_box(&g->level[k], eye);
        const float distance = tile_max_corner_distance(&b);
        if (!(distance > most || distance > *usual) || !tile_sees_box(t, &b))
            continue;
        most = distance > most ? distance : most;
        if (g->level[k].prims >= committed_scene->valid / USUAL_SHARE)
            *usual = distance > *usual ? distance : *usual;
    }
    most = most > 0 && most < whole ? most : whole;
    if (!(*usual > 0 && *usual < most))
        *usual = most;
    return most;
}

/* The radius that the tile's depth error is made for. Larger spheres are slow (tile_double.c); smaller ones are
 * undecided where something lies within the depth error behind them, which is rarer. So it is the largest radius that a
 * good share of the primitives has, if that is small compared to the scene, otherwise the radius of most primitives.
 * Levels are sorted from large to small. */
CGT_SPU_INLINE float tile_typical_radius(const cgt_committed_scene *committed_scene, float farthest)
{
    const cgt_loose_level *level = committed_scene->loose.level, *largest = level;
    for (const cgt_loose_level *l = level; l < level + committed_scene->loose.levels; l++) {
        const float reach = fminf(l->reach[0], fminf(l->reach[1], l->reach[2]));
        if (l->prims >= committed_scene->valid / USUAL_SHARE && reach < farthest * 0.125f)
            return reach;
        largest = l->prims > largest->prims ? l : largest;
    }
    return fminf(largest->reach[0], fminf(largest->reach[1], largest->reach[2]));
}

/* c: the largest usual distance from the eye. far_t: no hit has a larger t. */
CGT_SPU_INLINE void tile_init_depth_errors(tile *t, const cgt_committed_scene *committed_scene, float c, float far_t)
{
    const cgt_primitives *prims = &committed_scene->prims;
    const bool round = prims->spheres || prims->capsules;
    const float r = prims->spheres ? tile_typical_radius(committed_scene, c) : 0; /* capsules: any hit may not fit */
    if (t->parallel)
        tile_init_parallel_depth_error(t, c, r, far_t);
    else
        tile_init_sphere_depth_error(t, c, r, far_t);
    if (prims->triangles && t->parallel)
        tile_widen_parallel_error(t, c, round);
    else if (prims->triangles)
        tile_widen_depth_error(t, c);
    if (prims->capsules)
        tile_widen_capsule_error(t, c);
}

void CGT_KERNEL(cgt_tile_init)(tile *t, const cgt_committed_scene *committed_scene, const cgt_camera_rays *camera,
                               const cgt_region *r)
{
    t->rays = camera;
    t->linear = committed_scene->prims.triangles == committed_scene->prims.count && !camera->orthographic;
    t->columns = r->width;
    t->rows = r->height;
    tile_init_camera(camera, &t->camera);
    tile_init_parallel(t);
    tile_init_tables(t, r->x, r->y);
    tile_init_norms(t);
    tile_init_parts(t);
    tile_init_cone(t);
    float usual;
    const float c = tile_max_distance(t, committed_scene, &usual);
    tile_init_depth_errors(t, committed_scene, usual, c * (1 + 0x1p-18f) + t->length_error);
    tile_init_pixels(t, c * (1 + 0x1p-18f) + t->length_error);
}
