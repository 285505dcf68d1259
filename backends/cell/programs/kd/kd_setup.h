/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Ray set-up on an SPE (thesis, section 7.5): the canonical rays of its envelopes go to main memory, one envelope while
 * the next is made. The thesis' listing 7.1 takes atan for tan and the height over the width for its reciprocal, and
 * adds up steps from tile to tile, so that rounding depends on where an SPE begins; a ray here depends on its pixel
 * alone: a column's and a row's vector from the PPE, their sum rounded to nearest as on the host.
 *
 * An SPU's floats are truncated, its doubles are not: the sum of two floats, rounded to double and again to float, is
 * the sum rounded once, since 53 bits are more than 2 * 24 + 1. */
#ifndef KD_SETUP_H
#define KD_SETUP_H

#include "cell/programs/kd/kd_store.h"

/* The host's doubles round to nearest outside the SPU's mode alone. */
#if defined(CGT_SPU_EXACT_X86)
#define KD_NEAREST ((cgt_spu_arithmetic){0x1f80})
#else
#define KD_NEAREST ((cgt_spu_arithmetic){0})
#endif

/* A tile's rays; apart from what computes in the SPU's mode (spu_arithmetic_mode.h). */
static __attribute__((noinline)) void kd_sum_tiles(const float (*column)[4], const float (*row)[4], uint32_t tiles_x,
                                                   uint32_t tiles_y, cgt_kd_ray_tile *ray)
{
    for (uint32_t y = 0; y < tiles_y; y++)
        for (uint32_t x = 0; x < tiles_x; x++, ray++)
            for (uint32_t a = 0; a < 3; a++) {
                const vec_double2 c = {(double)column[2 * x][a], (double)column[2 * x + 1][a]};
                const double first = (double)row[2 * y][a], second = (double)row[2 * y + 1][a];
                const vec_double2 upper = c + (vec_double2){first, first}, lower = c + (vec_double2){second, second};
                ray->dir[a][0] = (float)upper[0];
                ray->dir[a][1] = (float)upper[1];
                ray->dir[a][2] = (float)lower[0];
                ray->dir[a][3] = (float)lower[1];
            }
}

static void kd_sum_rays(uint32_t buffer)
{
    const cgt_kd_frame_image *const f = &s()->frame;
#if defined(__SPU__)
    kd_sum_tiles((const float(*)[4])s()->column[buffer], (const float(*)[4])s()->row[buffer], f->tiles_x, f->tiles_y,
                 s()->ray[buffer]);
#else
    const cgt_spu_arithmetic saved = cgt_spu_enter_arithmetic();
    cgt_spu_leave_arithmetic(KD_NEAREST);
    kd_sum_tiles((const float(*)[4])s()->column[buffer], (const float(*)[4])s()->row[buffer], f->tiles_x, f->tiles_y,
                 s()->ray[buffer]);
    cgt_spu_leave_arithmetic(saved);
#endif
}

/* Which rays of a tile are pixels. */
static inline uint32_t kd_pixels(uint32_t x, uint32_t y)
{
    const cgt_kd_frame_image *const f = &s()->frame;
    if (x >= f->width || y >= f->height)
        return 0;
    return (x + 1 < f->width ? 3u : 1u) * (y + 1 < f->height ? 5u : 1u);
}

static void kd_fill_tiles(const cgt_kd_info *envelope, uint32_t buffer)
{
    const cgt_kd_frame_image *const f = &s()->frame;
    cgt_kd_ray_tile *ray = s()->ray[buffer];
    cgt_kd_info *info = s()->ray_info[buffer];
    for (uint32_t y = 0; y < f->tiles_y; y++)
        for (uint32_t x = 0; x < f->tiles_x; x++, ray++, info++) {
            const uint32_t left = envelope->x + 2 * x, top = envelope->y + 2 * y;
            for (uint32_t a = 0; a < 3; a++)
                ray->org[a] = s()->camera.eye[a];
            ray->org[3] = 0;
            *info = (cgt_kd_info){kd_pixels(left, top), left, top, 0};
        }
}

/* Starts to fetch the columns and rows of an envelope; beyond the picture the tables repeat its edge up to a multiple
 * of four, and what is left of the last envelope takes what the buffer holds. */
static void kd_get_tables(const cgt_kd_info *envelope, uint32_t buffer)
{
    const cgt_kd_frame_image *const f = &s()->frame;
    const uint32_t columns = (f->width + 3) / 4 * 4 - envelope->x, rows = (f->height + 3) / 4 * 4 - envelope->y;
    const uint32_t x = columns < 2 * f->tiles_x ? columns : 2 * f->tiles_x;
    const uint32_t y = rows < 2 * f->tiles_y ? rows : 2 * f->tiles_y;
    mfc_get(s()->column[buffer], kd_ea(f->columns) + 16 * (uint64_t)envelope->x, 16 * x, TAG_IN0 + buffer, 0, 0);
    mfc_get(s()->row[buffer], kd_ea(f->rows) + 16 * (uint64_t)envelope->y, 16 * y, TAG_IN0 + buffer, 0, 0);
}

static void kd_put_rays(uint32_t envelope, uint32_t buffer)
{
    const uint32_t tiles = s()->frame.tiles_x * s()->frame.tiles_y;
    mfc_put(s()->ray[buffer], kd_ea(s()->control.rays) + (uint64_t)envelope * tiles * sizeof(cgt_kd_ray_tile),
            tiles * sizeof(cgt_kd_ray_tile), TAG_OUT0 + buffer, 0, 0);
    mfc_put(s()->ray_info[buffer], kd_ea(s()->control.ray_infos) + (uint64_t)envelope * tiles * sizeof(cgt_kd_info),
            tiles * sizeof(cgt_kd_info), TAG_OUT0 + buffer, 0, 0);
}

/* The info packets of up to eight envelopes. */
static void kd_get_infos(uint32_t envelope, uint32_t left, uint32_t half)
{
    const uint32_t count = left < 8 ? left : 8;
    if (!left)
        return;
    mfc_get(s()->info[half], kd_ea(s()->control.infos) + 16 * (uint64_t)envelope, 16 * count, TAG_SETUP, 0, 0);
    kd_wait(1u << TAG_SETUP);
}

/* Tables of envelope k + 1 come, and rays of envelope k - 1 go, while those of envelope k are made. */
static void kd_set_up(void)
{
    const uint32_t first = s()->control.setup_first, count = s()->control.setup_envelopes;
    memset(s()->column, 0, sizeof s()->column);
    memset(s()->row, 0, sizeof s()->row);
    kd_get_infos(first, count, 0);
    if (count)
        kd_get_tables(&s()->info[0][0], 0);
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t buffer = k & 1, next = k + 1;
        if (next < count) {
            if (next % 8 == 0)
                kd_get_infos(first + next, count - next, next / 8 & 1);
            kd_get_tables(&s()->info[next / 8 & 1][next % 8], buffer ^ 1);
        }
        kd_wait(1u << (TAG_IN0 + buffer) | 1u << (TAG_OUT0 + buffer));
        kd_sum_rays(buffer);
        kd_fill_tiles(&s()->info[k / 8 & 1][k % 8], buffer);
        kd_put_rays(first + k, buffer);
    }
    kd_wait(3u << TAG_OUT0);
}

#endif
