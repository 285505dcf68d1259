/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Meshes that assimp would read as something else: refused, or told of. With tinygltf glTF is read right for the most
 * part: test_mesh_gltf.c. */
#define _GNU_SOURCE
#include "readers/trajectory_scratch.h"

#ifdef CGT_HAVE_MESHES

/* assimp's own leaks; see test_mesh.c. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void) { return "leak:libassimp.so\nleak:libstdc++.so\n"; }

/* One triangle; more: further members of the document, node: of its node, mesh: of its mesh. */
static const char *gltf(const char *more, const char *node, const char *mesh)
{
    static char text[4096];
    snprintf(text, sizeof text,
             "{\"asset\":{\"version\":\"2.0\"},%s\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0%s}],"
             "\"meshes\":[{%s\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],"
             "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"min\":[0,0,0],"
             "\"max\":[1,1,0]},{\"bufferView\":1,\"componentType\":5123,\"count\":3,\"type\":\"SCALAR\"}],"
             "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{\"buffer\":0,\"byteOffset\":36,\"byteLength\":6}],"
             "\"buffers\":[{\"byteLength\":42,\"uri\":\"data:application/octet-stream;base64,"
             "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIA\"}]}",
             more, node, mesh);
    return scratch_text(".gltf", text);
}

TEST(required_extensions)
{
    static const char *const unknown[] = {
        "\"extensionsRequired\":[\"ACME_things\"],",
        "\"extensionsRequired\" : [ \"KHR_materials_unlit\" , \"EXT_meshopt_compression\" ],",
#ifndef CGT_HAVE_GLTF
        "\"extensionsRequired\":[\"KHR_mesh_quantization\"],",
        "\"extensionsRequired\":[\"EXT_mesh_gpu_instancing\"],",
#endif
    };
    for (size_t i = 0; i < sizeof unknown / sizeof unknown[0]; i++)
        scratch_expect_error(gltf(unknown[i], "", ""), NULL, 0, "the file requires the extension");
    static const char *const known[] = {
        "",
        "\"extensionsRequired\":[],",
        "\"extensionsRequired\":[\"KHR_materials_unlit\",\"KHR_texture_transform\"],",
        "\"extensionsUsed\":[\"ACME_things\"],",
        "\"extras\":{\"extensionsRequired\":[\"ACME_things\"],\"s\":\"\\\"extensionsRequired\\\":[\"},",
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        cgt_trajectory *t = scratch_open(gltf(known[i], "", ""), NULL);
        assert_int_equal(scratch_read(t).triangles, 1);
        assert_null(cgt_trajectory_take_warning(t));
    }
}

#ifndef CGT_HAVE_GLTF
static void expect_warning(const char *path, const char *what)
{
    cgt_trajectory *t = scratch_open(path, NULL);
    scratch_read(t);
    const char *warning = cgt_trajectory_take_warning(t);
    if ((warning == NULL) != (what == NULL) || (what != NULL && strstr(warning, what) == NULL))
        fail_msg("the warning \"%s\", not \"%s\"", warning != NULL ? warning : "", what != NULL ? what : "");
}

TEST(what_is_not_played)
{
    static const char *const interpolations[] = {"STEP", "CUBICSPLINE", "LINEAR"};
    for (size_t i = 0; i < 3; i++) {
        char more[512];
        snprintf(more, sizeof more,
                 "\"animations\":[{\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"translation\"}}],"
                 "\"samplers\":[{\"input\":0,\"output\":0,\"interpolation\":\"%s\"}]}],",
                 interpolations[i]);
        char error[1024];
        /* the accessors are no keys: what assimp makes of them does not matter here */
        cgt_trajectory_close(scratch_open_one);
        scratch_open_one = cgt_trajectory_open(gltf(more, "", ""), NULL, error, sizeof error);
        if (scratch_open_one != NULL) {
            const char *warning = cgt_trajectory_take_warning(scratch_open_one);
            assert_true((warning != NULL) == (i < 2));
            assert_true(warning == NULL || strstr(warning, interpolations[i]) != NULL);
        }
    }
    expect_warning(gltf("", "", "\"weights\":[0.5],"), "morph targets are left out");
    expect_warning(gltf("", ",\"weights\":[0, 1e-3]", ""), "morph targets are left out");
    expect_warning(gltf("", "", "\"weights\":[0, 0.0],"), NULL);
}

#endif

/* Broken documents are assimp's to refuse; the check must end on each. */
TEST(broken_documents)
{
    static char deep[4096];
    memset(deep, '[', sizeof deep - 1);
    const char *const broken[] = {"{", "}", "\"", "{\"a", "{\"a\":\"\\", "{\"a\":]}", ",,::", deep, "glTF"};
    for (size_t i = 0; i < sizeof broken / sizeof broken[0]; i++)
        scratch_expect_error(scratch_text(".gltf", broken[i]), NULL, 0, ":");
}

/* assimp skips a first byte of the data that looks like a line feed, and shifts all others. */
TEST(ply_data_that_begin_with_a_line_feed)
{
    static const char header[] = "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n"
                                 "property float y\nproperty float z\nelement face 1\n"
                                 "property list uchar uchar vertex_indices\nend_header\n";
    unsigned char bytes[sizeof header - 1 + 36 + 4] = {0};
    unsigned char *const data = bytes + sizeof header - 1;
    memcpy(bytes, header, sizeof header - 1);
    data[14] = data[15] = data[30] = data[31] = 0x40;
    const unsigned char face[4] = {3, 0, 1, 2};
    memcpy(data + 36, face, sizeof face);
    assert_int_equal(scratch_read(scratch_open(scratch_bytes(".ply", bytes, sizeof bytes), NULL)).triangles, 1);
    data[0] = '\n';
    scratch_expect_error(scratch_bytes(".ply", bytes, sizeof bytes), NULL, 0, "the data begin with the byte 0x0a");
}

SUITE(NULL, NULL)

#else

TEST(no_meshes) { skip(); }

SUITE(NULL, NULL)
#endif
