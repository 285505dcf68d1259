/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Moving a camera; see view_camera.h. In double, since errors of thousands of steps add up. */
#include "view/view_camera.h"

#include <math.h>
#include <string.h>

typedef struct vec {
    double x, y, z;
} vec;

static const double pi = 3.14159265358979323846;

static vec of(const float v[3]) { return (vec){(double)v[0], (double)v[1], (double)v[2]}; }
static vec plus(vec a, vec b, double times) { return (vec){a.x + times * b.x, a.y + times * b.y, a.z + times * b.z}; }
static double dot(vec a, vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static vec cross(vec a, vec b) { return (vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
static double length(vec v) { return sqrt(dot(v, v)); }
static vec unit(vec v)
{
    const double size = length(v);
    return size > 0.0 ? (vec){v.x / size, v.y / size, v.z / size} : (vec){0.0, 0.0, 1.0};
}

static void store(float to[3], vec v)
{
    to[0] = (float)v.x;
    to[1] = (float)v.y;
    to[2] = (float)v.z;
}

/* By Rodrigues: about a unit axis. */
static vec rotate(vec v, vec axis, double angle)
{
    const double c = cos(angle), s = sin(angle);
    vec r = {v.x * c, v.y * c, v.z * c};
    r = plus(r, cross(axis, v), s);
    return plus(r, axis, dot(axis, v) * (1.0 - c));
}

typedef struct frame {
    vec eye, target, right, up, forward;
    double distance;
} frame;

static frame frame_of(const cgt_camera *c)
{
    frame f = {.eye = of(c->eye), .target = of(c->target)};
    const vec view = plus(f.target, f.eye, -1.0);
    f.distance = length(view);
    f.forward = unit(view);
    f.right = cross(f.forward, of(c->up));
    if (!(length(f.right) > 1e-6)) /* up is along the view: any other will do */
        f.right = cross(f.forward, fabs(f.forward.z) < 0.9 ? (vec){0.0, 0.0, 1.0} : (vec){0.0, 1.0, 0.0});
    f.right = unit(f.right);
    f.up = cross(f.right, f.forward);
    return f;
}

/* Keeps the camera as it is where floats do not hold the new one. */
static void set(cgt_camera *c, vec eye, vec target, vec up)
{
    cgt_camera next = *c;
    store(next.eye, eye);
    store(next.target, target);
    store(next.up, unit(up));
    double far = 0.0;
    for (int k = 0; k < 3; k++) {
        if (!isfinite(next.eye[k]) || !isfinite(next.target[k]) || fabsf(next.eye[k]) > 1e15f ||
            fabsf(next.target[k]) > 1e15f)
            return;
        far = fmax(far, fmax(fabs((double)next.eye[k]), fabs((double)next.target[k])));
    }
    if (length(plus(of(next.target), of(next.eye), -1.0)) > fmax(far * 1e-5, 1e-15))
        *c = next;
}

void view_camera_straighten(cgt_camera *c)
{
    const frame f = frame_of(c);
    store(c->up, f.up);
}

void view_camera_turn(cgt_camera *c, const float about[3], const float axis[3], float right, float up)
{
    const frame f = frame_of(c);
    const vec a = unit(of(axis)), center = of(about);
    /* the angle between the axis and the way up is what pitch changes; it stays within a quarter turn */
    const double lean = atan2(-dot(f.forward, a), dot(f.up, a));
    const double limit = 0.4999 * pi;
    double pitch = (double)up;
    if (lean + pitch > limit)
        pitch = fmax(limit - lean, fmin(pitch, 0.0));
    if (lean + pitch < -limit)
        pitch = fmin(-limit - lean, fmax(pitch, 0.0));
    const vec eye = plus(f.eye, center, -1.0), target = plus(f.target, center, -1.0);
    const vec e = rotate(rotate(eye, f.right, -pitch), a, -(double)right);
    const vec t = rotate(rotate(target, f.right, -pitch), a, -(double)right);
    const vec u = rotate(rotate(f.up, f.right, -pitch), a, -(double)right);
    set(c, plus(center, e, 1.0), plus(center, t, 1.0), u);
}

/* Half the height of what is seen as far off as the target. */
static double half_height(const cgt_camera *c, double distance) { return distance * tan((double)c->fov * pi / 360.0); }

void view_camera_pan(cgt_camera *c, float right, float up, uint32_t height)
{
    const frame f = frame_of(c);
    const double pixel = 2.0 * half_height(c, f.distance) / (double)height;
    const vec move = plus((vec){f.right.x * -pixel * (double)right, f.right.y * -pixel * (double)right,
                                f.right.z * -pixel * (double)right},
                          f.up, -pixel * (double)up);
    set(c, plus(f.eye, move, 1.0), plus(f.target, move, 1.0), f.up);
}

void view_camera_zoom(cgt_camera *c, const float place[3], float factor)
{
    const frame f = frame_of(c);
    const vec p = of(place);
    set(c, plus(p, plus(f.eye, p, -1.0), (double)factor), plus(p, plus(f.target, p, -1.0), (double)factor), f.up);
}

void view_camera_look(cgt_camera *c, const float direction[3], const float up[3])
{
    const frame f = frame_of(c);
    set(c, plus(f.target, unit(of(direction)), f.distance), f.target, of(up));
    view_camera_straighten(c);
}

void view_camera_target(cgt_camera *c, const float place[3], int is_parallel)
{
    const frame f = frame_of(c);
    const double distance = dot(plus(of(place), f.eye, -1.0), f.forward);
    if (!(distance > 0.0) && !is_parallel)
        return;
    const vec target = plus(f.eye, f.forward, distance);
    set(c, is_parallel ? plus(target, f.forward, -f.distance) : f.eye, target, f.up);
}

void view_camera_place(const cgt_camera *c, float aspect, float x, float y, float place[3])
{
    const frame f = frame_of(c);
    const double half = half_height(c, f.distance);
    vec p = plus(f.target, f.right, (2.0 * (double)x - 1.0) * half * (double)aspect);
    p = plus(p, f.up, (1.0 - 2.0 * (double)y) * half);
    store(place, p);
}

int view_camera_project(const cgt_camera *c, int is_parallel, float aspect, const float place[3], float at[2])
{
    const frame f = frame_of(c);
    const vec to = plus(of(place), f.eye, -1.0);
    const double depth = dot(to, f.forward);
    if (!(depth > 0.0) && !is_parallel)
        return 0;
    const double half = half_height(c, is_parallel ? f.distance : depth);
    at[0] = (float)(0.5 + 0.5 * dot(to, f.right) / (half * (double)aspect));
    at[1] = (float)(0.5 - 0.5 * dot(to, f.up) / half);
    return isfinite(at[0]) && isfinite(at[1]) && fabsf(at[0]) < 100.0f && fabsf(at[1]) < 100.0f;
}
