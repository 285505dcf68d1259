/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Transforms of meshes, in double precision and rounded once at the end, so that a chain of nodes adds no error visible
 * in single precision.
 *   transform   three rows of four: affine; the fourth row of a file's matrix is assumed to be 0 0 0 1
 *   rotation    a quaternion w x y z */
#ifndef MESH_MATH_H
#define MESH_MATH_H

#include <math.h>

typedef struct mesh_transform {
    double m[3][4];
} mesh_transform;

typedef struct mesh_rotation {
    double w, x, y, z;
} mesh_rotation;

static inline mesh_transform mesh_identity(void)
{
    return (mesh_transform){{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
}

/* The product a b: applies b first, then a. */
static inline mesh_transform mesh_multiply(const mesh_transform *a, const mesh_transform *b)
{
    mesh_transform c;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 4; j++)
            c.m[i][j] = a->m[i][0] * b->m[0][j] + a->m[i][1] * b->m[1][j] + a->m[i][2] * b->m[2][j];
        c.m[i][3] += a->m[i][3];
    }
    return c;
}

static inline int mesh_is_identity(const mesh_transform *a)
{
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 4; j++)
            if (a->m[i][j] != (i == j ? 1.0 : 0.0))
                return 0;
    }
    return 1;
}

static inline double mesh_determinant(const mesh_transform *a)
{
    return a->m[0][0] * (a->m[1][1] * a->m[2][2] - a->m[1][2] * a->m[2][1]) -
           a->m[0][1] * (a->m[1][0] * a->m[2][2] - a->m[1][2] * a->m[2][0]) +
           a->m[0][2] * (a->m[1][0] * a->m[2][1] - a->m[1][1] * a->m[2][0]);
}

/* The transform of normals, up to a positive factor: the cofactors are the inverse transpose times the determinant,
 * and exist where there is no inverse. */
static inline mesh_transform mesh_normal_transform(const mesh_transform *a)
{
    mesh_transform n = {{{0}}};
    const double sign = mesh_determinant(a) < 0.0 ? -1.0 : 1.0;
    for (int i = 0; i < 3; i++) {
        const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
        for (int j = 0; j < 3; j++) {
            const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            n.m[i][j] = sign * (a->m[i1][j1] * a->m[i2][j2] - a->m[i1][j2] * a->m[i2][j1]);
        }
    }
    return n;
}

static inline void mesh_apply(const mesh_transform *a, const float p[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a->m[i][0] * (double)p[0] + a->m[i][1] * (double)p[1] + a->m[i][2] * (double)p[2] + a->m[i][3];
}

/* A unit rotation from any multiple of it; no rotation where it is zero or not finite. */
static inline mesh_rotation mesh_rotation_unit(mesh_rotation q)
{
    const double length = sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    if (!(length > 0.0) || !isfinite(length))
        return (mesh_rotation){1, 0, 0, 0};
    return (mesh_rotation){q.w / length, q.x / length, q.y / length, q.z / length};
}

/* From a to b, s = 0 to 1, along the shorter arc at constant speed (Shoemake, "Animating Rotation with Quaternion
 * Curves", SIGGRAPH 1985); both are unit rotations. */
static inline mesh_rotation mesh_slerp(mesh_rotation a, mesh_rotation b, double s)
{
    double cosine = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
    const double sign = cosine < 0.0 ? -1.0 : 1.0; /* q and -q are the same rotation */
    cosine = cosine * sign > 1.0 ? 1.0 : cosine * sign;
    double weight_a = 1.0 - s, weight_b = s;
    if (cosine < 1.0 - 1e-9) { /* closer, the sine would lose its digits, and the chord equals the arc */
        const double angle = acos(cosine);
        weight_a = sin((1.0 - s) * angle) / sin(angle);
        weight_b = sin(s * angle) / sin(angle);
    }
    weight_b *= sign;
    return mesh_rotation_unit((mesh_rotation){weight_a * a.w + weight_b * b.w, weight_a * a.x + weight_b * b.x,
                                              weight_a * a.y + weight_b * b.y, weight_a * a.z + weight_b * b.z});
}

/* First scaled, then rotated (a unit rotation), then moved. */
static inline mesh_transform mesh_compose(const double scale[3], mesh_rotation q, const double move[3])
{
    const mesh_transform r = {
        {{1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y - q.z * q.w), 2 * (q.x * q.z + q.y * q.w), 0},
         {2 * (q.x * q.y + q.z * q.w), 1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z - q.x * q.w), 0},
         {2 * (q.x * q.z - q.y * q.w), 2 * (q.y * q.z + q.x * q.w), 1 - 2 * (q.x * q.x + q.y * q.y), 0}}};
    mesh_transform c;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            c.m[i][j] = r.m[i][j] * scale[j];
        c.m[i][3] = move[i];
    }
    return c;
}

#endif
