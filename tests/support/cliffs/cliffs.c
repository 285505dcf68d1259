/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The catalogue. Names are unique; those of spheres, triangles in random order and meshes end with their kind, but
 * where there is one kind alone. */
#include "support/cliffs/cliffs.h"

/* the same trouble for spheres and for triangles in random order */
#define BOTH(name, disturb, amount)                                                                                    \
    {name ", spheres", CLIFF_CLOUD, disturb, amount, NULL, 0},                                                         \
    {                                                                                                                  \
        name ", triangles", CLIFF_SOUP, disturb, amount, NULL, 0                                                       \
    }
#define SPHERES(name, disturb, amount)                                                                                 \
    {                                                                                                                  \
        name ", spheres", CLIFF_CLOUD, disturb, amount, NULL, 0                                                        \
    }
#define TRIANGLES(name, disturb, amount)                                                                               \
    {                                                                                                                  \
        name ", triangles", CLIFF_SOUP, disturb, amount, NULL, 0                                                       \
    }
#define MESH(name, disturb, amount)                                                                                    \
    {                                                                                                                  \
        name ", mesh", CLIFF_MESH, disturb, amount, NULL, 0                                                            \
    }
#define STICKS(name, disturb, amount)                                                                                  \
    {                                                                                                                  \
        name ", sticks", CLIFF_STICKS, disturb, amount, NULL, 0                                                        \
    }
/* rays through undisturbed scenes */
#define RAYS(name, bend, amount)                                                                                       \
    {name ", spheres", CLIFF_CLOUD, NULL, 0, bend, amount}, { name ", triangles", CLIFF_SOUP, NULL, 0, bend, amount }

static const cliff catalogue[] = {
    /* far away */
    BOTH("stray 1e3", cliff_one_stray, 1e3f),
    BOTH("stray 1e4", cliff_one_stray, 1e4f),
    BOTH("stray 1e6", cliff_one_stray, 1e6f),
    BOTH("stray 1e12", cliff_one_stray, 1e12f),
    BOTH("stray 1e16", cliff_one_stray, 1e16f),
    BOTH("stray 1e17", cliff_one_stray, 1e17f),
    BOTH("stray 3e38", cliff_one_stray, 3e38f),
    MESH("stray 1e6", cliff_one_stray, 1e6f),
    MESH("stray 1e17", cliff_one_stray, 1e17f),
    BOTH("strays 1e3", cliff_strays, 1e3f),
    BOTH("strays 1e6", cliff_strays, 1e6f),
    BOTH("strays 1e17", cliff_strays, 1e17f),
    BOTH("giant 1e4", cliff_giant, 1e4f),
    BOTH("giant 1e6", cliff_giant, 1e6f),
    BOTH("giant 1e7", cliff_giant, 1e7f),
    BOTH("giant 1e16", cliff_giant, 1e16f),
    BOTH("far clusters 1e2", cliff_far_clusters, 1e2f),
    BOTH("far clusters 1e4", cliff_far_clusters, 1e4f),
    SPHERES("far clusters 1e17", cliff_far_clusters, 1e17f),
    BOTH("dense 1e-3, seen near", cliff_dense_near, 1e-3f),
    BOTH("dense 1e-3, seen whole", cliff_dense_whole, 1e-3f),
    SPHERES("dense 1e-12, seen near", cliff_dense_near, 1e-12f),
    BOTH("stadium", cliff_stadium, 1e-3f),
    /* sizes */
    SPHERES("sizes over 60 octaves", cliff_octaves, 60),
    BOTH("nested over 60 octaves", cliff_nested_octaves, 60),
    BOTH("levels by 4", cliff_levels, 4),
    BOTH("log-uniform sizes", cliff_log_sizes, 1e-3f),
    BOTH("self-similar", cliff_self_similar, 1e-6f),
    SPHERES("halo of 2 decades", cliff_halo, 1e-2f),
    SPHERES("halo of 4 decades", cliff_halo, 1e-4f),
    SPHERES("Plummer", cliff_plummer, 0.02f),
    BOTH("all big", cliff_big, 0.5f),
    SPHERES("all big, eye inside", cliff_eye_inside, 0.5f),
    BOTH("log-normal sizes, eye inside", cliff_log_normal, 3),
    /* crowds */
    BOTH("at one point", cliff_copies, 0.5f),
    SPHERES("points at one point", cliff_copies, 0),
    BOTH("nearly at one point", cliff_nearly_point, 1e-6f),
    BOTH("concentric", cliff_concentric, 0.8f),
    BOTH("line", cliff_line, 0),
    BOTH("axis line", cliff_axis_line, 0),
    BOTH("plane", cliff_plane, 0),
    BOTH("tilted plane", cliff_tilted_plane, 0),
    /* everything */
    BOTH("scale 1e-40", cliff_scale, 1e-40f),
    BOTH("scale 1e-30", cliff_scale, 1e-30f),
    BOTH("scale 1e-15", cliff_scale, 1e-15f),
    BOTH("scale 1e-14", cliff_scale, 1e-14f),
    BOTH("scale 1e15", cliff_scale, 1e15f),
    BOTH("scale 1e16", cliff_scale, 1e16f),
    BOTH("scale 1e30", cliff_scale, 1e30f),
    BOTH("scale 1e38", cliff_scale, 1e38f),
    MESH("scale 1e-30", cliff_scale, 1e-30f),
    MESH("scale 1e30", cliff_scale, 1e30f),
    BOTH("far from the origin 1e3", cliff_translate, 1e3f),
    BOTH("far from the origin 1e5", cliff_translate, 1e5f),
    /* shapes */
    TRIANGLES("fan", cliff_fan, 0.3f),
    TRIANGLES("fan in an axis plane", cliff_fan, 0),
    TRIANGLES("slivers", cliff_slivers, 1e-5f),
    MESH("any order", cliff_shuffled, 0),
    /* capsules */
    STICKS("stray 1e6", cliff_one_stray, 1e6f),
    STICKS("giant 1e6", cliff_giant, 1e6f),
    STICKS("one of length 1e2", cliff_one_long, 1e2f),
    STICKS("one of length 1e6", cliff_one_long, 1e6f),
    STICKS("one of length 1e17", cliff_one_long, 1e17f),
    STICKS("needles", cliff_needles, 1e-4f),
    STICKS("parallel along the view", cliff_parallel, 0),
    STICKS("parallel along a diagonal", cliff_parallel, 1),
    STICKS("all big", cliff_big, 0.5f),
    STICKS("at one point", cliff_copies, 0.5f),
    STICKS("coaxial", cliff_coaxial, 0.4f),
    STICKS("coaxial, eye inside", cliff_coaxial_inside, 0.4f),
    STICKS("listed twice", cliff_listed_twice, 0),
    STICKS("scale 1e-30", cliff_scale, 1e-30f),
    STICKS("scale 1e30", cliff_scale, 1e30f),
    STICKS("eye at 1e4", cliff_eye_far, 1e4f),
    STICKS("parallel, eye at 1e4", cliff_eye_far_parallel, 1e4f),
    /* planes */
    MESH("floor, light in its plane", cliff_floor, 0),
    MESH("wall, light in its plane", cliff_wall, 0),
    MESH("tilted floor, light in its plane", cliff_floor, 0.3f),
    MESH("tilted wall, light in its plane", cliff_wall, 0.3f),
    TRIANGLES("decals", cliff_decals, 0),
    TRIANGLES("tilted decals", cliff_decals, 0.3f),
    TRIANGLES("decals at 1 in 2", cliff_decals, 0.5f),
    MESH("double faces", cliff_double_faces, 0),
    MESH("lying sample", cliff_lying_sample, 0),
    TRIANGLES("no area 99 %", cliff_no_area, 0.99f),
    TRIANGLES("no area at all", cliff_no_area, 2),
    SPHERES("invalid 2/3", cliff_invalid, 1.0f / 3),
    TRIANGLES("invalid half", cliff_invalid, 0.5f),
    /* eye */
    BOTH("eye at 1e3", cliff_eye_far, 1e3f),
    BOTH("eye at 1e4", cliff_eye_far, 1e4f),
    BOTH("eye at 1e5", cliff_eye_far, 1e5f),
    MESH("eye at 1e4", cliff_eye_far, 1e4f),
    BOTH("parallel, eye at 1e3", cliff_eye_far_parallel, 1e3f),
    BOTH("parallel, eye at 1e4", cliff_eye_far_parallel, 1e4f),
    BOTH("parallel, eye at 1e5", cliff_eye_far_parallel, 1e5f),
    BOTH("eye on a surface", cliff_eye_on_surface, 1),
    SPHERES("eye on a surface, turned", cliff_eye_on_surface, 0.8f),
    /* light */
    SPHERES("room of 1e4", cliff_room, 1e4f),
    MESH("room of 1e4", cliff_room, 1e4f),
    MESH("room of 1e5", cliff_room, 1e5f),
    MESH("room of 1e6", cliff_room, 1e6f),
    MESH("tilted room of 1e5", cliff_tilted_room, 1e5f),
    TRIANGLES("room of 1e5", cliff_room, 1e5f),
    SPHERES("light at 1e10", cliff_far_light, 1e10f),
    SPHERES("light at 1e30", cliff_far_light, 1e30f),
    SPHERES("light inside", cliff_light_inside, 0.03f),
    /* rays */
    RAYS("directions 1e-40", cliff_bend_length, 1e-40f),
    RAYS("directions 1e-30", cliff_bend_length, 1e-30f),
    RAYS("directions 1e-20", cliff_bend_length, 1e-20f),
    RAYS("directions 1e20", cliff_bend_length, 1e20f),
    RAYS("directions 1e30", cliff_bend_length, 1e30f),
    RAYS("origins 1e5", cliff_bend_far, 1e5f),
    RAYS("origins 1e10", cliff_bend_far, 1e10f),
    RAYS("origins 1e17", cliff_bend_far, 1e17f),
    RAYS("origins 1e30", cliff_bend_far, 1e30f),
    RAYS("along axes", cliff_bend_axis, 0),
    RAYS("dead rays", cliff_bend_dead, 0),
    RAYS("t_min = t_max", cliff_bend_moment, 0.5f),
    RAYS("short rays", cliff_bend_short, 1e-3f),
    RAYS("equal rays", cliff_bend_same, 2),
    RAYS("t_min -1e30", cliff_bend_behind, 1e30f),
    {"from inside many, spheres", CLIFF_CLOUD, cliff_big, 0.5f, cliff_bend_inside, 0.2f},
    {"from inside many, triangles", CLIFF_SOUP, cliff_big, 0.5f, cliff_bend_inside, 0.2f},
    {"giant 1e7, along axes", CLIFF_CLOUD, cliff_giant, 1e7f, cliff_bend_axis, 0},
    {"floor, rays in its plane, mesh", CLIFF_MESH, cliff_floor, 0, cliff_bend_into_plane, 1},
    {"wall, rays in its plane, mesh", CLIFF_MESH, cliff_wall, 0, cliff_bend_into_plane, 0},
    {"plane, along axes", CLIFF_SOUP, cliff_plane, 0, cliff_bend_axis, 0},
};

uint32_t cliff_count(void) { return sizeof catalogue / sizeof catalogue[0]; }

const cliff *cliff_at(uint32_t number) { return &catalogue[number]; }
