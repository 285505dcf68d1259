/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Whether a scaled camera's rays are the scaled rays of the camera, and its range the scaled range. */
#include "trace/bands/band_camera.h"

#include <math.h>

#include "exact/triangle_double.h"
#include "trace/bands/band_ray.h"

/* Whether the products and sums that make an orthographic camera's origins round alike in both units: no product of a
 * component and a pixel's coordinate, which is 0 or at least 2^-24 and at most 1, leaves the normal floats. Sums of floats
 * are exact where they are small. */
static bool component_commutes(float v) { return v == 0 || (fabsf(v) >= 0x1p-100f && fabsf(v) <= 0x1p100f); }

static bool scale_axis(const float v[3], int exponent, float scaled[3])
{
    bool fits = cgt_band_scale(v, exponent, scaled);
    for (int a = 0; a < 3; a++)
        fits &= component_commutes(v[a]) && component_commutes(scaled[a]);
    return fits;
}

/* Whether no surface of the band is so near to the eye that a t below 0, which the band would not report, might still
 * round to 0 in the caller's units: -2^-150 and more, times 2^k. zone: that distance. Surfaces are bounded in double, by
 * far less than the 2^-40 of lengths that are left for it here. */
static bool eye_is_clear(const cgt_band *band, const float eye[3], double zone)
{
    static const float axes[3] = {1, 1, 1};
    const cgt_committed_scene *c = &band->scene->committed_scene;
    bool outside = false;
    for (int a = 0; a < 3; a++)
        outside |= (double)eye[a] + zone < (double)c->low[a] || (double)eye[a] - zone > (double)c->high[a];
    for (uint32_t i = 0; !outside && i < c->prims.arrays; i++) {
        const cgt_primitive_array *array = &c->prims.array[i];
        for (uint32_t k = 0; k < array->count; k++) {
            const cgt_primitive q = cgt_array_primitive(array, k);
            if (q.kind == CGT_KIND_SPHERES) {
                const double x = (double)q.sphere.x - (double)eye[0], y = (double)q.sphere.y - (double)eye[1],
                             z = (double)q.sphere.z - (double)eye[2], r = (double)q.sphere.r;
                const double distance = sqrt(x * x + y * y + z * z);
                if (!(fabs(distance - r) > zone + (distance + r) * 0x1p-40))
                    return false;
            } else {
                const cgt_triangle_plane p = cgt_triangle_double_plane(eye, axes, &q.triangle);
                const double normal = fabs(p.n[0]) + fabs(p.n[1]) + fabs(p.n[2]) + p.den_error;
                if (!(fabs(p.num) - p.num_error > zone * normal))
                    return false;
            }
        }
    }
    return true;
}

/* The same for the origins of an orthographic camera: whether all lie outside the band's bounds. */
static bool origins_are_clear(const cgt_band *band, const cgt_camera_rays *c, double zone)
{
    const cgt_committed_scene *scene = &band->scene->committed_scene;
    for (int a = 0; a < 3; a++) {
        const double reach = (fabs((double)c->right[a]) + fabs((double)c->up[a])) * (1 + 0x1p-20) + zone +
                             fabs((double)c->eye[a]) * 0x1p-20;
        if ((double)c->eye[a] + reach < (double)scene->low[a] || (double)c->eye[a] - reach > (double)scene->high[a])
            return true;
    }
    return false;
}

static bool range_is_clear(const cgt_band *band, const cgt_camera_rays *c)
{
    double length = 0;
    if (c->t_min != 0 || band->exponent <= 0)
        return true;
    for (int a = 0; a < 3; a++)
        length += fabs((double)c->fwd[a]) + (c->orthographic ? 0 : fabs((double)c->right[a]) + fabs((double)c->up[a]));
    const double zone = cgt_power_of_two(band->exponent - 149) * length;
    return c->orthographic ? origins_are_clear(band, c, zone) : eye_is_clear(band, c->eye, zone);
}

bool cgt_band_scale_camera(const cgt_band *band, const cgt_camera_rays *from, cgt_camera_rays *c)
{
    *c = *from;
    bool fits = cgt_band_scale(from->eye, band->exponent, c->eye);
    if (from->orthographic)
        fits = fits && scale_axis(from->right, band->exponent, c->right) && scale_axis(from->up, band->exponent, c->up);
    for (int a = 0; a < 3; a++)
        fits = fits && fabsf(c->eye[a]) <= CGT_BAND_MAX_ORG;
    cgt_band_scale_range(from->t_min, from->t_max, band->exponent, &c->t_min, &c->t_max);
    if (from->t_min == 0)
        c->t_min = 0;
    return fits && range_is_clear(band, c);
}
