/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Meshes that assimp would read as something else: refused. Of glTF, which tinygltf reads, test_mesh_gltf.c has
 * more. */
#define _GNU_SOURCE
#include "readers/trajectory_scratch.h"

#ifdef CGT_HAVE_MESHES

/* assimp's own leaks; see test_mesh.c. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void) { return "leak:libassimp.so\nleak:libstdc++.so\n"; }

#ifdef CGT_HAVE_GLTF
/* One triangle; more: further members of the document. */
static const char *gltf(const char *more)
{
    static char text[4096];
    snprintf(text, sizeof text,
             "{\"asset\":{\"version\":\"2.0\"},%s\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
             "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],"
             "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"min\":[0,0,0],"
             "\"max\":[1,1,0]},{\"bufferView\":1,\"componentType\":5123,\"count\":3,\"type\":\"SCALAR\"}],"
             "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{\"buffer\":0,\"byteOffset\":36,\"byteLength\":6}],"
             "\"buffers\":[{\"byteLength\":42,\"uri\":\"data:application/octet-stream;base64,"
             "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIA\"}]}",
             more);
    return scratch_text(".gltf", text);
}

TEST(required_extensions)
{
    static const char *const unknown[] = {
        "\"extensionsRequired\":[\"ACME_things\"],",
        "\"extensionsRequired\" : [ \"KHR_materials_unlit\" , \"EXT_meshopt_compression\" ],",
    };
    for (size_t i = 0; i < sizeof unknown / sizeof unknown[0]; i++)
        scratch_expect_error(gltf(unknown[i]), NULL, 0, "the file requires the extension");
    static const char *const known[] = {
        "",
        "\"extensionsRequired\":[],",
        "\"extensionsRequired\":[\"KHR_materials_unlit\",\"KHR_texture_transform\"],",
        "\"extensionsUsed\":[\"ACME_things\"],",
        "\"extras\":{\"extensionsRequired\":[\"ACME_things\"],\"s\":\"\\\"extensionsRequired\\\":[\"},",
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        cgt_trajectory *t = scratch_open(gltf(known[i]), NULL);
        assert_int_equal(scratch_read(t).triangles, 1);
        assert_null(cgt_trajectory_take_warning(t));
    }
}

/* The walk over a document must end on each. */
TEST(broken_documents)
{
    static char deep[4096];
    memset(deep, '[', sizeof deep - 1);
    const char *const broken[] = {"{", "}", "\"", "{\"a", "{\"a\":\"\\", "{\"a\":]}", ",,::", deep, "glTF"};
    for (size_t i = 0; i < sizeof broken / sizeof broken[0]; i++)
        scratch_expect_error(scratch_text(".gltf", broken[i]), NULL, 0, ":");
}

#else
TEST(gltf_needs_its_reader)
{
    scratch_expect_error(scratch_text(".gltf", "{}"), NULL, 0, "glTF is read by tinygltf");
    scratch_expect_error(scratch_text(".GLB", "glTF"), NULL, 0, "glTF is read by tinygltf");
}
#endif

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
