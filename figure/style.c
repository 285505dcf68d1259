/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Styles of pictures; see style.h. */
#include "style.h"

#include <math.h>

const float cgt_style_mesh_color[3] = {0xdc / 255.0f, 0xd3 / 255.0f, 0xc4 / 255.0f};

const style_values *cgt_style_get(picture_style style)
{
    /* Where all of a style's light falls, a colour is shown as it is or little brighter. */
    static const style_values styles[] = {
        [STYLE_SOFT] = {5, 16, 1, 0.62f, 0.36f, 0.10f, 0.0f, {0x2a, 0x2f, 0x37}},
        [STYLE_PAPER] = {5, 16, 1, 0.45f, 0.55f, 0.12f, 0.8f, {0xff, 0xff, 0xff}},
        [STYLE_PLAIN] = {0, 0, 0, 0.85f, 0.05f, 0.35f, 0.0f, {0x3a, 0x3f, 0x47}},
    };
    return &styles[style];
}

float cgt_style_distance(const cgt_camera *camera)
{
    float square = 0.0f;
    for (int c = 0; c < 3; c++) {
        const float arm = camera->target[c] - camera->eye[c];
        square += arm * arm;
    }
    return sqrtf(square);
}

float cgt_style_shown_height(const cgt_camera *camera)
{
    return 2.0f * cgt_style_distance(camera) * tanf(camera->fov * 0.00872664626f);
}

float cgt_style_ambient_radius(const cgt_camera *camera)
{
    const float share = 0.25f; /* of the height */
    return share * cgt_style_shown_height(camera);
}
