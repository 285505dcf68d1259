/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The sentences of the readers of meshes that no other test brings out: an input for each. */
#define _GNU_SOURCE
#include "readers/mesh/gltf_builder.h"

#if defined(CGT_HAVE_GLTF)

/* assimp's own leaks; see test_mesh.c. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void) { return "leak:libassimp.so\nleak:libstdc++.so\n"; }

#define SCENE "\"scene\":0,\"scenes\":[{\"nodes\":[0]}]"
#define TRIANGLE "\"attributes\":{\"POSITION\":0}"
#define MESH(primitive) ",\"meshes\":[{\"primitives\":[{" primitive "}]}]"
#define NODE(more) SCENE ",\"nodes\":[{\"mesh\":0" more "}]"
#define SKINNED(attributes, skin)                                                                                      \
    SCENE ",\"nodes\":[{\"mesh\":0,\"skin\":0},{}],\"skins\":[{" skin                                                  \
          "}]" MESH("\"attributes\":{\"POSITION\":0," attributes "}")
#define CHANNEL(node, path) "{\"sampler\":0,\"target\":{\"node\":" node ",\"path\":\"" path "\"}}"
#define CLIP(node, channels, input)                                                                                    \
    NODE(node)                                                                                                         \
    MESH(TRIANGLE) ",\"animations\":[{\"channels\":[" channels "],\"samplers\":[{\"input\":" input ",\"output\":2}]}]"
#define INSTANCES(attributes)                                                                                          \
    NODE(",\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{" attributes "}}}") MESH(TRIANGLE)

/* The accessors that the rows name by their numbers. */
static gltf_builder begin(void)
{
    static const float floats[16] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, up[2] = {0, 1}, down[2] = {1, 0};
    static const unsigned char joints[12] = {9};
    gltf_builder b = {.size = 0};
    gltf_floats(&b, floats, 9, "VEC3");                                                   /* 0: a triangle */
    gltf_floats(&b, up, 2, "SCALAR");                                                     /* 1: times */
    gltf_floats(&b, floats, 6, "VEC3");                                                   /* 2: two vectors */
    gltf_floats(&b, down, 2, "SCALAR");                                                   /* 3: times that descend */
    gltf_add(&b, joints, 12, "", "\"componentType\":5121,\"count\":3,\"type\":\"VEC4\""); /* 4: joint 9, then 0 */
    gltf_floats(&b, (const float[12]){1, 0, 0, 0, 1, 0, 0, 0, 1}, 12, "VEC4");            /* 5: weights */
    gltf_floats(&b, floats, 4, "VEC4");                                                   /* 6: one weight */
    gltf_floats(&b, floats, 16, "MAT4");                                                  /* 7: one matrix */
    gltf_add(
        &b, floats, 36, "",
        "\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"sparse\":{\"count\":1,\"indices\":{\"bufferView\":99,"
        "\"componentType\":5123},\"values\":{\"bufferView\":0}}"); /* 8 */
    gltf_add(
        &b, floats, 36, "",
        "\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"sparse\":{\"count\":9,\"indices\":{\"bufferView\":0,"
        "\"componentType\":5123},\"values\":{\"bufferView\":0}}"); /* 9 */
    return b;
}

TEST(gltf)
{
    static const char *const rows[][2] = {
        {NODE("") MESH("\"attributes\":{\"POSITION\":8}"), "positions: there is no bufferView 99"},
        {NODE("") MESH("\"attributes\":{\"POSITION\":9}"), "positions: 9 sparse elements of type 5123"},
        {NODE("") ",\"meshes\":[{\"weights\":[1],\"primitives\":[{" TRIANGLE ",\"targets\":[{\"POSITION\":2}]}]}]",
         "2 positions of a morph target for 3 vertices"},
        {NODE("") ",\"meshes\":[{\"weights\":[1],\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":0},"
                  "\"targets\":[{\"POSITION\":0,\"NORMAL\":2}]}]}]",
         "2 normals of a morph target for 3 vertices"},
        {INSTANCES("\"TRANSLATION\":0,\"SCALE\":2"), "transforms of 3 and of 2 instances"},
        {INSTANCES(""), "a node has instances without transforms"},
        {SKINNED("\"JOINTS_0\":4,\"WEIGHTS_0\":6", "\"joints\":[1]"), "3 joints and 1 weights for 3 vertices"},
        {SKINNED("\"JOINTS_0\":4,\"WEIGHTS_0\":5", "\"joints\":[1]"), "vertex 0 follows joint 9 of 1"},
        {SKINNED("\"JOINTS_0\":4,\"WEIGHTS_0\":99", "\"joints\":[1]"), "weights of joints: there is no accessor 99"},
        {SKINNED("\"JOINTS_0\":4", "\"joints\":[1]"), "weights of joints are missing"},
        {SKINNED("\"JOINTS_0\":4,\"WEIGHTS_0\":5,\"JOINTS_4\":4", "\"joints\":[1]"), "more than 16 joints a vertex"},
        {SKINNED("\"JOINTS_0\":4,\"WEIGHTS_0\":5", "\"joints\":[0,1],\"inverseBindMatrices\":7"),
         "1 inverse bind matrices for 2 joints"},
        {SKINNED("\"JOINTS_0\":4,\"WEIGHTS_0\":5", "\"joints\":[1],\"inverseBindMatrices\":99"),
         "inverse bind matrices: there is no accessor 99"},
        {CLIP("", CHANNEL("0", "translation"), "3"), "the times of a clip do not ascend: key 1 is at 0 s"},
        {CLIP("", CHANNEL("0", "translation"), "99"), "times of keys: there is no accessor 99"},
        {CLIP("", CHANNEL("7", "translation"), "1"), "a clip moves node 7 of 1"},
        {CLIP("", CHANNEL("0", "odd"), "1"), "a clip changes something unknown of node 0"},
        {CLIP(",\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]", CHANNEL("0", "scale"), "1"),
         "a clip moves node 0, which has a matrix"},
        {CLIP("", CHANNEL("0", "scale") "," CHANNEL("0", "scale"), "1"), "a clip moves node 0 in two ways at once"},
    };
    const gltf_builder b = begin();
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        scratch_expect_error(gltf_text(&b, rows[i][0]), NULL, 0, rows[i][1]);
    unsigned char bytes[8192];
    const size_t size = gltf_binary(&b, NODE("") MESH(TRIANGLE), bytes, sizeof bytes);
    bytes[16] = 'X'; /* the kind of the first part */
    scratch_expect_error(scratch_bytes(".glb", bytes, size), NULL, 0, "the file does not begin with its document");
}

/* A few words may name the same numbers again and again. */
TEST(used_again)
{
    static char nodes[16384];
    gltf_builder b = begin();
    const float zero = 0;
    gltf_add(&b, &zero, 4, "",
             "\"componentType\":5126,\"count\":1,\"type\":\"SCALAR\"},"       /* 10 */
             "{\"componentType\":5126,\"count\":16777216,\"type\":\"MAT4\"}," /* 11 */
             "{\"componentType\":5126,\"count\":90000,\"type\":\"VEC3\"");    /* 12 */
    scratch_expect_error(
        gltf_text(&b, SKINNED("\"JOINTS_0\":4,\"WEIGHTS_0\":5", "\"joints\":[1],\"inverseBindMatrices\":11")), NULL, 0,
        "with what it uses again and again the file becomes more than 1 GiB and 500 times");
    strcpy(nodes, "\"nodes\":[{}");
    for (int i = 0; i < 1000; i++)
        strcat(nodes, ",{\"mesh\":0}");
    strcat(nodes, "]" MESH("\"attributes\":{\"POSITION\":12}"));
    scratch_expect_error(gltf_text(&b, nodes), NULL, 0,
                         "with meshes that many nodes show the file becomes more than 1 GiB and 500 times");
}

TEST(ply)
{
    char text[8192] = "ply\nformat ascii 1.0\n";
    scratch_expect_error(scratch_text(".ply", "ply\nformat ascii 1.0\nproperty float x\n"), NULL, 0,
                         ":3: a property without an element");
    const size_t head = strlen(text);
    for (int i = 0; i < 200; i++)
        strcat(text, "element e 0\n");
    scratch_expect_error(scratch_text(".ply", text), NULL, 0, ":67: more than 64 elements");
    strcpy(text + head, "element e 0\n");
    for (int i = 0; i < 300; i++)
        strcat(text, "property float x\n");
    scratch_expect_error(scratch_text(".ply", text), NULL, 0, "more than 256 properties");
}

SUITE(NULL, NULL)

#else

TEST(no_gltf) { skip(); }

SUITE(NULL, NULL)

#endif
