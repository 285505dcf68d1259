/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A camera in a band's units: the caller's directions and a scaled eye, so that t' = t 2^k (band_ray.h). */
#ifndef CGT_BAND_CAMERA_H
#define CGT_BAND_CAMERA_H

#include "query/camera.h"
#include "scene/bands.h"

/* Scales a camera. Returns whether its rays are exactly the scaled ones, and no hit is lost at the range's begin. */
bool cgt_band_scale_camera(const cgt_band *band, const cgt_camera_rays *from, cgt_camera_rays *c);

#endif
