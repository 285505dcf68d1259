/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Shapes by the names that GSD's schema has: {"type": "Sphere", "diameter": 2.0}, {"type": "Ellipsoid", "a": 1.0, "b":
 * 2.0, "c": 3.0}, {"type": "ConvexPolyhedron", ...}. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/gsd/gsd_shapes.h"

#include <math.h>
#include <string.h>

/* What follows "key": in the JSON of one object without others in it, up to a comma or bracket: 1, or 0. */
static int find_value(text_span json, const char *key, text_span *value)
{
    const size_t length = strlen(key);
    for (const char *p = json.begin; p + length + 2 <= json.end; p++) {
        if (p[0] != '"' || memcmp(p + 1, key, length) != 0 || p[length + 1] != '"')
            continue;
        const char *q = p + length + 2;
        while (q < json.end && (*q == ' ' || *q == '\t'))
            q++;
        if (q == json.end || *q != ':')
            continue;
        *value = (text_span){q + 1, q + 1};
        while (value->end < json.end && strchr(",}]", *value->end) == NULL)
            value->end++;
        text_trim(value);
        return 1;
    }
    return 0;
}

static int find_size(text_span json, const char *key, double *size)
{
    text_span value;
    return find_value(json, key, &value) && text_double(value, size) && *size >= 0.0 && isfinite(*size);
}

gsd_shape gsd_shape_read(text_span json, float *radius)
{
    text_span type;
    double a, b, c;
    if (!find_value(json, "type", &type))
        return GSD_SHAPE_NONE;
    if (text_is(type, "\"Sphere\"") && find_size(json, "diameter", &a)) {
        *radius = (float)(0.5 * a);
        return GSD_SHAPE_SPHERE;
    }
    if (text_is(type, "\"Ellipsoid\"") && find_size(json, "a", &a) && find_size(json, "b", &b) &&
        find_size(json, "c", &c)) {
        *radius = (float)cbrt(a * b * c);
        return a == b && b == c ? GSD_SHAPE_SPHERE : GSD_SHAPE_OF_VOLUME;
    }
    return GSD_SHAPE_OTHER;
}
