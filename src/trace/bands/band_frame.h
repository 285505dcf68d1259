/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A camera's frame through the bands of a scene. A band's camera has the caller's directions and a scaled eye, so that
 * t' = t 2^k (band_ray.h), and frames go through the band's structure as any frame does. Where the scaled camera's rays
 * are not exactly the scaled rays of the camera, these go one by one. */
#ifndef CGT_BAND_FRAME_H
#define CGT_BAND_FRAME_H

#include "query/camera.h"
#include "query/region.h"
#include "trace/bands/band_trace.h"

typedef struct cgt_band_camera {
    cgt_camera_rays camera;
    bool is_scaled; /* its rays are the caller's, scaled */
    bool by_tiles;  /* whole tiles go through the band's loose grid */
} cgt_band_camera;

typedef struct cgt_band_frame {
    cgt_band_call call; /* slots for regions of max_pixels */
    const cgt_camera_rays *camera;
    cgt_band_camera band[CGT_MAX_BANDS];
} cgt_band_frame;

/* Scales a camera for each band and allocates scratch for `regions` regions of at most max_pixels. packets: the caller
 * has asked for packets. Settings, camera and scene stay in use. Fails with a message; else release with
 * cgt_bands_end. */
cgt_result cgt_band_frame_begin(const cgt_scene *scene, const cgt_camera_rays *camera,
                                const cgt_trace_settings *settings, bool packets, uint32_t regions, uint32_t max_pixels,
                                cgt_band_frame *frame);

/* Traces a region of the frame as cgt_trace_region_fn does. */
void cgt_band_trace_region(const cgt_band_frame *frame, uint32_t slot, const cgt_region *region, cgt_counts *counts);

#endif
