/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rows whose work exceeds its twin's by more than test_cliffs.c allows, and how far they may: about 1.5 times of what
 * was counted, since variants differ. The test prints a line for each row that is missing here, that has become worse
 * or that may leave. */
#include "structures/scenes/cliff_counts.h"

#include <string.h>

typedef struct known_row {
    const char *name;
    cliff_call call;
    cliff_structure structure;
    double bound; /* times the twin's work */
} known_row;

static const known_row known[] = {
    {"stray 1e12, triangles", CLIFF_LIGHT, CLIFF_AUTO, 58},
    {"strays 1e6, triangles", CLIFF_LIGHT, CLIFF_AUTO, 17},
    {"giant 1e6, triangles", CLIFF_LIGHT, CLIFF_AUTO, 27},
    {"giant 1e7, triangles", CLIFF_LIGHT, CLIFF_AUTO, 28},
    {"far clusters 1e17, spheres", CLIFF_SINGLE, CLIFF_AUTO, 103},
    {"far clusters 1e17, spheres", CLIFF_RAYS, CLIFF_AUTO, 137},
    {"far clusters 1e17, spheres", CLIFF_OCCLUDED, CLIFF_AUTO, 127},
    {"far clusters 1e17, spheres", CLIFF_SINGLE, CLIFF_BVH, 209},
    {"far clusters 1e17, spheres", CLIFF_RAYS, CLIFF_BVH, 137},
    {"far clusters 1e17, spheres", CLIFF_OCCLUDED, CLIFF_BVH, 127},
    {"far clusters 1e17, spheres", CLIFF_SINGLE, CLIFF_BIH, 135},
    {"far clusters 1e17, spheres", CLIFF_RAYS, CLIFF_BIH, 21},
    {"far clusters 1e17, spheres", CLIFF_OCCLUDED, CLIFF_BIH, 24},
    {"dense 1e-12, seen near, spheres", CLIFF_LIGHT, CLIFF_AUTO, 320},
    {"dense 1e-12, seen near, spheres", CLIFF_LIGHT, CLIFF_BVH, 120},
    {"stadium, spheres", CLIFF_CAMERA, CLIFF_AUTO, 36},
    {"stadium, spheres", CLIFF_LIGHT, CLIFF_AUTO, 17}, /* as before; the cloud that it is compared with takes less */
    {"sizes over 60 octaves, spheres", CLIFF_OCCLUDED, CLIFF_AUTO, 17},
    {"sizes over 60 octaves, spheres", CLIFF_SINGLE, CLIFF_AUTO, 16},
    {"sizes over 60 octaves, spheres", CLIFF_SINGLE, CLIFF_BVH, 21},
    {"sizes over 60 octaves, spheres", CLIFF_OCCLUDED, CLIFF_BVH, 17},
    {"levels by 4, spheres", CLIFF_CAMERA, CLIFF_AUTO, 32},
    {"levels by 4, spheres", CLIFF_LIGHT, CLIFF_AUTO, 38},
    {"levels by 4, spheres", CLIFF_LIGHT, CLIFF_BIH, 46},
    {"levels by 4, triangles", CLIFF_LIGHT, CLIFF_AUTO, 158}, /* 8 lanes; 68 with 16 */
    {"levels by 4, triangles", CLIFF_LIGHT, CLIFF_BVH, 54},
    {"levels by 4, triangles", CLIFF_LIGHT, CLIFF_BIH, 126},
    {"self-similar, spheres", CLIFF_LIGHT, CLIFF_AUTO, 17},
    {"all big, spheres", CLIFF_SINGLE, CLIFF_AUTO, 27},
    {"all big, spheres", CLIFF_RAYS, CLIFF_AUTO, 27},
    {"all big, spheres", CLIFF_SINGLE, CLIFF_BVH, 32},
    {"all big, spheres", CLIFF_RAYS, CLIFF_BVH, 27},
    {"all big, spheres", CLIFF_SINGLE, CLIFF_BIH, 23},
    {"all big, spheres", CLIFF_RAYS, CLIFF_BIH, 16},
    {"all big, eye inside, spheres", CLIFF_CAMERA, CLIFF_AUTO, 56},
    {"all big, eye inside, spheres", CLIFF_SINGLE, CLIFF_AUTO, 27},
    {"all big, eye inside, spheres", CLIFF_RAYS, CLIFF_AUTO, 27},
    {"all big, eye inside, spheres", CLIFF_CAMERA, CLIFF_BVH, 15},
    {"all big, eye inside, spheres", CLIFF_SINGLE, CLIFF_BVH, 32},
    {"all big, eye inside, spheres", CLIFF_RAYS, CLIFF_BVH, 27},
    {"all big, eye inside, spheres", CLIFF_CAMERA, CLIFF_BIH, 40},
    {"all big, eye inside, spheres", CLIFF_SINGLE, CLIFF_BIH, 23},
    {"all big, eye inside, spheres", CLIFF_RAYS, CLIFF_BIH, 16},
    {"log-normal sizes, eye inside, spheres", CLIFF_CAMERA, CLIFF_AUTO, 605},
    {"log-normal sizes, eye inside, spheres", CLIFF_SINGLE, CLIFF_AUTO, 37},
    {"log-normal sizes, eye inside, spheres", CLIFF_SINGLE, CLIFF_BVH, 83},
    {"log-normal sizes, eye inside, spheres", CLIFF_CAMERA, CLIFF_BIH, 101},
    {"log-normal sizes, eye inside, spheres", CLIFF_SINGLE, CLIFF_BIH, 206},
    {"log-normal sizes, eye inside, spheres", CLIFF_RAYS, CLIFF_BIH, 43},
    {"log-normal sizes, eye inside, triangles", CLIFF_CAMERA, CLIFF_AUTO, 122},
    {"log-normal sizes, eye inside, triangles", CLIFF_SINGLE, CLIFF_BVH, 35},
    {"log-normal sizes, eye inside, triangles", CLIFF_CAMERA, CLIFF_BIH, 40},
    {"log-normal sizes, eye inside, triangles", CLIFF_SINGLE, CLIFF_BIH, 54},
    {"log-normal sizes, eye inside, triangles", CLIFF_RAYS, CLIFF_BIH, 17},
    {"at one point, spheres", CLIFF_LIGHT, CLIFF_AUTO, 1345},
    {"at one point, spheres", CLIFF_SINGLE, CLIFF_AUTO, 164},
    {"at one point, spheres", CLIFF_RAYS, CLIFF_AUTO, 295},
    {"at one point, spheres", CLIFF_OCCLUDED, CLIFF_AUTO, 24},
    {"at one point, spheres", CLIFF_CAMERA, CLIFF_BVH, 24}, /* the twin takes a quarter */
    {"at one point, spheres", CLIFF_LIGHT, CLIFF_BVH, 344},
    {"at one point, spheres", CLIFF_SINGLE, CLIFF_BVH, 335},
    {"at one point, spheres", CLIFF_RAYS, CLIFF_BVH, 295},
    {"at one point, spheres", CLIFF_OCCLUDED, CLIFF_BVH, 24},
    {"at one point, spheres", CLIFF_CAMERA, CLIFF_BIH, 20},
    {"at one point, spheres", CLIFF_LIGHT, CLIFF_BIH, 265},
    {"at one point, spheres", CLIFF_SINGLE, CLIFF_BIH, 90},
    {"at one point, spheres", CLIFF_RAYS, CLIFF_BIH, 29},
    {"at one point, spheres", CLIFF_OCCLUDED, CLIFF_BIH, 32},
    {"at one point, triangles", CLIFF_CAMERA, CLIFF_AUTO, 580},
    {"at one point, triangles", CLIFF_LIGHT, CLIFF_AUTO, 200},
    {"at one point, triangles", CLIFF_SINGLE, CLIFF_AUTO, 440},
    {"at one point, triangles", CLIFF_RAYS, CLIFF_AUTO, 1100},
    {"at one point, triangles", CLIFF_OCCLUDED, CLIFF_AUTO, 16},
    {"at one point, triangles", CLIFF_CAMERA, CLIFF_BVH, 180}, /* the twin takes a quarter */
    {"at one point, triangles", CLIFF_LIGHT, CLIFF_BVH, 73},
    {"at one point, triangles", CLIFF_SINGLE, CLIFF_BVH, 1400},
    {"at one point, triangles", CLIFF_RAYS, CLIFF_BVH, 1100},
    {"at one point, triangles", CLIFF_OCCLUDED, CLIFF_BVH, 16},
    {"at one point, triangles", CLIFF_CAMERA, CLIFF_BIH, 86},
    {"at one point, triangles", CLIFF_LIGHT, CLIFF_BIH, 38},
    {"at one point, triangles", CLIFF_SINGLE, CLIFF_BIH, 430},
    {"at one point, triangles", CLIFF_RAYS, CLIFF_BIH, 380},
    {"nearly at one point, spheres", CLIFF_LIGHT, CLIFF_AUTO, 93},
    {"nearly at one point, spheres", CLIFF_SINGLE, CLIFF_AUTO, 78},
    {"nearly at one point, spheres", CLIFF_RAYS, CLIFF_AUTO, 169},
    {"nearly at one point, spheres", CLIFF_OCCLUDED, CLIFF_AUTO, 17},
    {"nearly at one point, spheres", CLIFF_LIGHT, CLIFF_BVH, 24},
    {"nearly at one point, spheres", CLIFF_SINGLE, CLIFF_BVH, 227},
    {"nearly at one point, spheres", CLIFF_RAYS, CLIFF_BVH, 169},
    {"nearly at one point, spheres", CLIFF_OCCLUDED, CLIFF_BVH, 17},
    {"nearly at one point, spheres", CLIFF_SINGLE, CLIFF_BIH, 113},
    {"nearly at one point, spheres", CLIFF_RAYS, CLIFF_BIH, 43},
    {"nearly at one point, triangles", CLIFF_SINGLE, CLIFF_AUTO, 18},
    {"nearly at one point, triangles", CLIFF_RAYS, CLIFF_AUTO, 50},
    {"nearly at one point, triangles", CLIFF_SINGLE, CLIFF_BVH, 48},
    {"nearly at one point, triangles", CLIFF_RAYS, CLIFF_BVH, 50},
    {"nearly at one point, triangles", CLIFF_SINGLE, CLIFF_BIH, 41},
    {"nearly at one point, triangles", CLIFF_RAYS, CLIFF_BIH, 21},
    {"concentric, spheres", CLIFF_CAMERA, CLIFF_AUTO, 34},
    {"concentric, spheres", CLIFF_LIGHT, CLIFF_AUTO, 210},
    {"concentric, spheres", CLIFF_SINGLE, CLIFF_AUTO, 160},
    {"concentric, spheres", CLIFF_RAYS, CLIFF_AUTO, 360},
    {"concentric, spheres", CLIFF_OCCLUDED, CLIFF_AUTO, 29},
    {"concentric, spheres", CLIFF_CAMERA, CLIFF_BVH, 69},
    {"concentric, spheres", CLIFF_LIGHT, CLIFF_BVH, 54},
    {"concentric, spheres", CLIFF_SINGLE, CLIFF_BVH, 490},
    {"concentric, spheres", CLIFF_RAYS, CLIFF_BVH, 360},
    {"concentric, spheres", CLIFF_OCCLUDED, CLIFF_BVH, 29},
    {"concentric, spheres", CLIFF_CAMERA, CLIFF_BIH, 74},
    {"concentric, spheres", CLIFF_LIGHT, CLIFF_BIH, 44},
    {"concentric, spheres", CLIFF_SINGLE, CLIFF_BIH, 590},
    {"concentric, spheres", CLIFF_RAYS, CLIFF_BIH, 300},
    {"concentric, spheres", CLIFF_OCCLUDED, CLIFF_BIH, 22},
    {"concentric, triangles", CLIFF_CAMERA, CLIFF_AUTO, 450},
    {"concentric, triangles", CLIFF_LIGHT, CLIFF_AUTO, 250},
    {"concentric, triangles", CLIFF_SINGLE, CLIFF_AUTO, 2900},
    {"concentric, triangles", CLIFF_RAYS, CLIFF_AUTO, 7400},
    {"concentric, triangles", CLIFF_OCCLUDED, CLIFF_AUTO, 19},
    {"concentric, triangles", CLIFF_CAMERA, CLIFF_BVH, 1900}, /* the twin takes a quarter */
    {"concentric, triangles", CLIFF_LIGHT, CLIFF_BVH, 94},
    {"concentric, triangles", CLIFF_SINGLE, CLIFF_BVH, 9100},
    {"concentric, triangles", CLIFF_RAYS, CLIFF_BVH, 7400},
    {"concentric, triangles", CLIFF_OCCLUDED, CLIFF_BVH, 19},
    {"concentric, triangles", CLIFF_CAMERA, CLIFF_BIH, 910},
    {"concentric, triangles", CLIFF_LIGHT, CLIFF_BIH, 49},
    {"concentric, triangles", CLIFF_SINGLE, CLIFF_BIH, 2800},
    {"concentric, triangles", CLIFF_RAYS, CLIFF_BIH, 2700},
    {"far from the origin 1e5, spheres", CLIFF_LIGHT, CLIFF_AUTO, 35},
    {"far from the origin 1e5, triangles", CLIFF_LIGHT, CLIFF_AUTO, 23},
    {"fan, triangles", CLIFF_LIGHT, CLIFF_AUTO, 52},
    {"fan, triangles", CLIFF_SINGLE, CLIFF_AUTO, 19},
    {"fan, triangles", CLIFF_RAYS, CLIFF_AUTO, 22},
    {"fan, triangles", CLIFF_LIGHT, CLIFF_BVH, 26},
    {"fan, triangles", CLIFF_SINGLE, CLIFF_BVH, 15},
    {"fan, triangles", CLIFF_RAYS, CLIFF_BVH, 22},
    {"fan in an axis plane, triangles", CLIFF_LIGHT, CLIFF_AUTO, 36},
    {"fan in an axis plane, triangles", CLIFF_LIGHT, CLIFF_BVH, 18},
    {"slivers, triangles", CLIFF_SINGLE, CLIFF_AUTO, 18},
    {"slivers, triangles", CLIFF_RAYS, CLIFF_AUTO, 28},
    {"slivers, triangles", CLIFF_OCCLUDED, CLIFF_AUTO, 28},
    {"slivers, triangles", CLIFF_CAMERA, CLIFF_BVH, 28},
    {"slivers, triangles", CLIFF_SINGLE, CLIFF_BVH, 29},
    {"slivers, triangles", CLIFF_RAYS, CLIFF_BVH, 28},
    {"slivers, triangles", CLIFF_OCCLUDED, CLIFF_BVH, 28},
    {"slivers, triangles", CLIFF_SINGLE, CLIFF_BIH, 23},
    /* the triangles of a row are met by each ray; those of tilted planes are decided in double, vectors at a time */
    {"floor, light in its plane, mesh", CLIFF_LIGHT, CLIFF_AUTO, 25},
    {"floor, light in its plane, mesh", CLIFF_LIGHT, CLIFF_BIH, 40},
    {"floor, rays in its plane, mesh", CLIFF_LIGHT, CLIFF_AUTO, 25},
    {"floor, rays in its plane, mesh", CLIFF_LIGHT, CLIFF_BIH, 40},
    {"tilted floor, light in its plane, mesh", CLIFF_LIGHT, CLIFF_AUTO, 696},
    {"tilted floor, light in its plane, mesh", CLIFF_LIGHT, CLIFF_BIH, 638},
    {"tilted floor, light in its plane, mesh", CLIFF_LIGHT, CLIFF_BVH, 198},
    {"tilted wall, light in its plane, mesh", CLIFF_LIGHT, CLIFF_AUTO, 700},
    {"tilted wall, light in its plane, mesh", CLIFF_LIGHT, CLIFF_BIH, 640},
    {"tilted wall, light in its plane, mesh", CLIFF_LIGHT, CLIFF_BVH, 198},
    {"wall, light in its plane, mesh", CLIFF_LIGHT, CLIFF_AUTO, 25},
    {"wall, light in its plane, mesh", CLIFF_LIGHT, CLIFF_BIH, 41},
    {"wall, rays in its plane, mesh", CLIFF_LIGHT, CLIFF_AUTO, 25},
    {"wall, rays in its plane, mesh", CLIFF_LIGHT, CLIFF_BIH, 41},
    {"from inside many, spheres", CLIFF_SINGLE, CLIFF_AUTO, 67},
    {"from inside many, spheres", CLIFF_RAYS, CLIFF_AUTO, 78},
    {"from inside many, spheres", CLIFF_SINGLE, CLIFF_BVH, 99},
    {"from inside many, spheres", CLIFF_RAYS, CLIFF_BVH, 78},
    {"from inside many, spheres", CLIFF_SINGLE, CLIFF_BIH, 66},
    {"from inside many, spheres", CLIFF_RAYS, CLIFF_BIH, 19},
    {"from inside many, triangles", CLIFF_SINGLE, CLIFF_AUTO, 20},
    {"from inside many, triangles", CLIFF_SINGLE, CLIFF_BVH, 15},
    {"giant 1e7, along axes", CLIFF_LIGHT, CLIFF_AUTO, 76},
    /* canonical t and decisions in whole numbers, one a pixel */
    {"eye at 1e4, spheres", CLIFF_CAMERA, CLIFF_BVH, 16},
    {"eye at 1e5, spheres", CLIFF_CAMERA, CLIFF_BVH, 16},
    {"parallel, eye at 1e4, spheres", CLIFF_CAMERA, CLIFF_AUTO, 19},
    {"parallel, eye at 1e4, spheres", CLIFF_CAMERA, CLIFF_BVH, 16},
    {"parallel, eye at 1e5, spheres", CLIFF_CAMERA, CLIFF_BVH, 16},
    {"eye on a surface, triangles", CLIFF_CAMERA, CLIFF_AUTO, 35},
    {"eye on a surface, triangles", CLIFF_CAMERA, CLIFF_BVH, 36},
    /* packets of the papers, whose margins follow the eye */
    {"eye at 1e5, spheres", CLIFF_CAMERA, CLIFF_BIH, 39},
    {"eye at 1e5, triangles", CLIFF_CAMERA, CLIFF_BIH, 87},
    {"parallel, eye at 1e5, spheres", CLIFF_CAMERA, CLIFF_BIH, 39},
    {"parallel, eye at 1e5, triangles", CLIFF_CAMERA, CLIFF_BIH, 88},
    /* packets on several sides of the lamp are split and try a tile before the tree takes them: half the time of going
     * ray by ray, and more tests in double */
    {"room of 1e4, mesh", CLIFF_LIGHT, CLIFF_AUTO, 16},
    {"room of 1e5, mesh", CLIFF_LIGHT, CLIFF_AUTO, 16},
    {"room of 1e6, mesh", CLIFF_LIGHT, CLIFF_AUTO, 18},
    {"tilted room of 1e5, mesh", CLIFF_LIGHT, CLIFF_AUTO, 17},
    {"room of 1e5, mesh", CLIFF_LIGHT, CLIFF_BIH, 16},
    {"room of 1e6, mesh", CLIFF_LIGHT, CLIFF_BIH, 373},
    {"tilted room of 1e5, mesh", CLIFF_LIGHT, CLIFF_BIH, 18},
    /* a frame of one task, which tries tiles first */
    {"room of 1e5, triangles", CLIFF_LIGHT, CLIFF_AUTO, 35},
    {"one of length 1e17, sticks", CLIFF_CAMERA, CLIFF_AUTO, 44},
    {"needles, sticks", CLIFF_LIGHT, CLIFF_AUTO, 101},
    {"needles, sticks", CLIFF_SINGLE, CLIFF_AUTO, 53},
    {"needles, sticks", CLIFF_RAYS, CLIFF_AUTO, 107},
    {"needles, sticks", CLIFF_OCCLUDED, CLIFF_AUTO, 125},
    {"needles, sticks", CLIFF_CAMERA, CLIFF_BVH, 170},
    {"needles, sticks", CLIFF_LIGHT, CLIFF_BVH, 40},
    {"needles, sticks", CLIFF_SINGLE, CLIFF_BVH, 108},
    {"needles, sticks", CLIFF_RAYS, CLIFF_BVH, 107},
    {"needles, sticks", CLIFF_OCCLUDED, CLIFF_BVH, 125},
    {"parallel along a diagonal, sticks", CLIFF_LIGHT, CLIFF_AUTO, 212},
    {"parallel along a diagonal, sticks", CLIFF_SINGLE, CLIFF_AUTO, 21},
    {"all big, sticks", CLIFF_SINGLE, CLIFF_AUTO, 33},
    {"all big, sticks", CLIFF_RAYS, CLIFF_AUTO, 40},
    {"all big, sticks", CLIFF_SINGLE, CLIFF_BVH, 40},
    {"all big, sticks", CLIFF_RAYS, CLIFF_BVH, 40},
    {"at one point, sticks", CLIFF_LIGHT, CLIFF_AUTO, 298},
    {"at one point, sticks", CLIFF_SINGLE, CLIFF_AUTO, 60},
    {"at one point, sticks", CLIFF_RAYS, CLIFF_AUTO, 184},
    {"at one point, sticks", CLIFF_CAMERA, CLIFF_BVH, 75},
    {"at one point, sticks", CLIFF_LIGHT, CLIFF_BVH, 100},
    {"at one point, sticks", CLIFF_SINGLE, CLIFF_BVH, 146},
    {"at one point, sticks", CLIFF_RAYS, CLIFF_BVH, 184},
    {"coaxial, sticks", CLIFF_CAMERA, CLIFF_AUTO, 875},
    {"coaxial, sticks", CLIFF_LIGHT, CLIFF_AUTO, 651},
    {"coaxial, sticks", CLIFF_RAYS, CLIFF_AUTO, 148},
    {"coaxial, sticks", CLIFF_LIGHT, CLIFF_BVH, 217},
    {"coaxial, sticks", CLIFF_SINGLE, CLIFF_BVH, 41},
    {"coaxial, sticks", CLIFF_RAYS, CLIFF_BVH, 148},
    {"coaxial, sticks", CLIFF_CAMERA, CLIFF_BVH, 47},
    {"coaxial, sticks", CLIFF_SINGLE, CLIFF_AUTO, 17},
    /* in streams and through a BVH, what leaves a capsule is decided in double */
    {"coaxial, eye inside, sticks", CLIFF_CAMERA, CLIFF_AUTO, 19},
    {"coaxial, eye inside, sticks", CLIFF_SINGLE, CLIFF_AUTO, 25},
    {"coaxial, eye inside, sticks", CLIFF_RAYS, CLIFF_AUTO, 148},
    {"coaxial, eye inside, sticks", CLIFF_CAMERA, CLIFF_BVH, 13500},
    {"coaxial, eye inside, sticks", CLIFF_SINGLE, CLIFF_BVH, 60},
    {"coaxial, eye inside, sticks", CLIFF_RAYS, CLIFF_BVH, 220},
    {"parallel, eye at 1e4, sticks", CLIFF_CAMERA, CLIFF_AUTO, 26},
};

double cliff_known_bound(const char *name, cliff_call call, cliff_structure structure)
{
    for (size_t i = 0; i < TEST_COUNT(known); i++)
        if (!strcmp(known[i].name, name) && known[i].call == call && known[i].structure == structure)
            return known[i].bound;
    return 0;
}

static bool is_in_catalogue(const char *name)
{
    for (uint32_t i = 0; i < cliff_count(); i++)
        if (!strcmp(cliff_at(i)->name, name))
            return true;
    return false;
}

uint32_t cliff_known_check(void)
{
    for (size_t i = 0; i < TEST_COUNT(known); i++) {
        if (!is_in_catalogue(known[i].name) || !(known[i].bound > 0))
            fail_msg("known row %zu: no cliff has the name \"%s\", or its bound is missing", i, known[i].name);
        for (size_t k = 0; k < i; k++)
            if (!strcmp(known[k].name, known[i].name) && known[k].call == known[i].call &&
                known[k].structure == known[i].structure)
                fail_msg("known rows %zu and %zu are the same: \"%s\"", k, i, known[i].name);
    }
    return TEST_COUNT(known);
}
