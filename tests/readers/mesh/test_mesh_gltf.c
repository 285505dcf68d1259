/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * glTF as tinygltf reads it: all kinds of primitives, numbers, nodes, skins and clips; and what is refused. Expected
 * vertices are computed by hand. */
#define _GNU_SOURCE
#include <math.h>

#include "readers/mesh/gltf_builder.h"
#include "support/trajectory_told.h"

#ifdef CGT_HAVE_GLTF

#define SCENE "\"scene\":0,\"scenes\":[{\"nodes\":[0]}]"
#define ONE_NODE SCENE ",\"nodes\":[{\"mesh\":0}]"

/* Corners of a square and one beyond it, in z = 0. */
static const float square[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0};

static gltf_builder begin(void)
{
    gltf_builder b = {.size = 0};
    gltf_floats(&b, square, 15, "VEC3");
    return b;
}

static cgt_trajectory_frame read_file(const char *path) { return scratch_read(scratch_open(path, NULL)); }

static void expect_corner(const cgt_trajectory_frame *f, uint32_t i, uint32_t k, double x, double y, double z)
{
    const double wanted[3] = {x, y, z};
    assert_true(i < f->triangles && f->index[3 * i + k] < f->count);
    const float *const v = f->position + 3 * (size_t)f->index[3 * i + k];
    for (int a = 0; a < 3; a++) {
        if (!(fabs((double)v[a] - wanted[a]) <= 2e-6))
            fail_msg("triangle %u, corner %u: (%.9g, %.9g, %.9g) is not (%.9g, %.9g, %.9g)", i, k, (double)v[0],
                     (double)v[1], (double)v[2], x, y, z);
    }
}

/* A mesh of one primitive under one node. */
static const char *one_primitive(const gltf_builder *b, const char *primitive)
{
    char members[1024];
    snprintf(members, sizeof members, ONE_NODE ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}%s}]}]",
             primitive);
    return gltf_text(b, members);
}

/* ---- Primitives and numbers ---------------------------------------------------------------------------------- */

TEST(all_kinds_of_triangles)
{
    static const struct {
        const char *mode;
        uint32_t index[6];
        size_t count;
        uint32_t corners[9]; /* of the square */
        uint32_t triangles;
    } rows[] = {
        {"", {0, 1, 2, 2, 1, 3}, 6, {0, 1, 2, 2, 1, 3}, 2},
        {",\"mode\":4", {4, 3, 2}, 3, {4, 3, 2}, 1},
        {",\"mode\":5", {0, 1, 2, 3, 4}, 5, {0, 1, 2, 1, 3, 2, 2, 3, 4}, 3},
        {",\"mode\":6", {0, 1, 3, 2}, 4, {1, 3, 0, 3, 2, 0}, 2},
        {",\"mode\":5.0", {1, 3, 4}, 3, {1, 3, 4}, 1}, /* a whole number all the same */
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        for (size_t bytes = 0; bytes <= 4; bytes += bytes < 2 ? 1 : 2) {
            gltf_builder b = begin();
            char primitive[80];
            const int index = bytes > 0 ? gltf_indices(&b, rows[i].index, rows[i].count, bytes) : 0;
            if (bytes == 0) { /* without indices: the vertices in this order */
                float ordered[18];
                for (size_t k = 0; k < rows[i].count; k++)
                    memcpy(ordered + 3 * k, square + 3 * rows[i].index[k], 12);
                b = (gltf_builder){.size = 0};
                gltf_floats(&b, ordered, 3 * rows[i].count, "VEC3");
                snprintf(primitive, sizeof primitive, "%s", rows[i].mode);
            } else {
                snprintf(primitive, sizeof primitive, "%s,\"indices\":%d", rows[i].mode, index);
            }
            const cgt_trajectory_frame f = read_file(one_primitive(&b, primitive));
            assert_int_equal(f.triangles, rows[i].triangles);
            for (uint32_t k = 0; k < 3 * f.triangles; k++) {
                const float *const v = square + 3 * rows[i].corners[k];
                expect_corner(&f, k / 3, k % 3, (double)v[0], (double)v[1], (double)v[2]);
            }
        }
    }
}

TEST(points_and_lines_are_counted)
{
    gltf_builder b = begin();
    read_file(gltf_text(&b, ONE_NODE ",\"meshes\":[{\"primitives\":["
                                     "{\"attributes\":{\"POSITION\":0},\"mode\":0},"
                                     "{\"attributes\":{\"POSITION\":0},\"mode\":2},"
                                     "{\"attributes\":{\"POSITION\":0},\"mode\":3},"
                                     "{\"attributes\":{\"POSITION\":0},\"mode\":5}]}]"));
    const cgt_trajectory_mesh *m = cgt_trajectory_get_mesh(scratch_open_one);
    assert_true(m->points == 5 && m->lines == 9 && m->meshes == 4 && m->instances == 1);
    scratch_expect_error(one_primitive(&b, ",\"mode\":1"), NULL, 0, "the file holds no triangles: 0 points, 2 lines");
}

/* KHR_mesh_quantization: positions of integers, normalised or not. */
TEST(numbers_of_all_types)
{
    static const struct {
        int type;
        size_t bytes;
        int normalized;
        int32_t most;
        double value, least; /* of most, and of -most - 1 */
    } rows[] = {
        {5120, 1, 0, 127, 127, -128},  {5120, 1, 1, 127, 1, -1},           {5121, 1, 0, 255, 255, 0},
        {5121, 1, 1, 255, 1, 0},       {5122, 2, 0, 32767, 32767, -32768}, {5122, 2, 1, 32767, 1, -1},
        {5123, 2, 0, 65535, 65535, 0}, {5123, 2, 1, 65535, 1, 0},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        gltf_builder b = {.size = 0};
        unsigned char bytes[24] = {0};
        char rest[160];
        for (size_t k = 0; k < rows[i].bytes;
             k++) { /* (0, 0, 0), (most, 0, 0), (-most - 1, most, 0), 4 numbers apart */
            bytes[4 * rows[i].bytes + k] = bytes[9 * rows[i].bytes + k] = (unsigned char)(rows[i].most >> (8 * k));
            bytes[8 * rows[i].bytes + k] = (unsigned char)((-rows[i].most - 1) >> (8 * k));
        }
        snprintf(rest, sizeof rest, "\"componentType\":%d,\"count\":3,\"type\":\"VEC3\",\"normalized\":%s",
                 rows[i].type, rows[i].normalized ? "true" : "false");
        gltf_add(&b, bytes, 12 * rows[i].bytes, rows[i].bytes == 1 ? ",\"byteStride\":4" : ",\"byteStride\":8", rest);
        const cgt_trajectory_frame f =
            read_file(gltf_text(&b, "\"extensionsRequired\":[\"KHR_mesh_quantization\"]," ONE_NODE
                                    ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}]"));
        expect_corner(&f, 0, 0, 0, 0, 0);
        expect_corner(&f, 0, 1, rows[i].value, 0, 0);
        expect_corner(&f, 0, 2, rows[i].least, rows[i].value, 0);
    }
}

/* Floats keep their bits, where no node moves them. */
TEST(values_pass_as_they_are)
{
    static const float odd[9] = {0.1f, -0.0f, 16777216.0f, 1e-40f, 3e38f, 0, NAN, INFINITY, -1e-30f};
    gltf_builder b = {.size = 0};
    gltf_floats(&b, odd, 9, "VEC3");
    const cgt_trajectory_frame f = read_file(one_primitive(&b, ""));
    assert_int_equal(f.count, 3);
    assert_memory_equal(f.position, odd, sizeof odd);
}

TEST(sparse_accessors)
{
    gltf_builder b = begin();
    static const uint32_t which[2] = {1, 4};
    static const float moved[6] = {7, 0, 0, 0, 9, 1};
    const int at = gltf_indices(&b, which, 2, 1), values = gltf_floats(&b, moved, 6, "VEC3");
    for (int has_view = 0; has_view < 2; has_view++) {
        char text[400];
        gltf_builder c = b;
        snprintf(text, sizeof text,
                 ",{%s\"componentType\":5126,\"count\":5,\"type\":\"VEC3\",\"sparse\":{\"count\":2,\"indices\":"
                 "{\"bufferView\":%d,\"componentType\":5121},\"values\":{\"bufferView\":%d}}}",
                 has_view ? "\"bufferView\":0," : "", at, values);
        strcat(c.accessors, text);
        const cgt_trajectory_frame f =
            read_file(gltf_text(&c, ONE_NODE ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":3},"
                                             "\"mode\":5}]}]"));
        assert_int_equal(f.triangles, 3);
        expect_corner(&f, 0, 0, 0, 0, 0);
        expect_corner(&f, 0, 1, 7, 0, 0);
        expect_corner(&f, 0, 2, 0, has_view, 0);
        expect_corner(&f, 2, 2, 0, 9, 1);
    }
}

/* ---- Nodes, skins and clips ---------------------------------------------------------------------------------- */

TEST(nodes_move_their_meshes)
{
    gltf_builder b = begin();
    const cgt_trajectory_frame f =
        read_file(gltf_text(&b, "\"scene\":1,\"scenes\":[{\"nodes\":[4]},{\"nodes\":[0,3]}],\"nodes\":["
                                "{\"translation\":[10,0,0],\"scale\":[2,1,1],\"children\":[1,2]},"
                                "{\"name\":\"a\",\"mesh\":0,\"rotation\":[0.70710678118,0,0,0.70710678118]},"
                                "{\"name\":\"a\",\"mesh\":0,\"scale\":[-1,1,1]},"
                                "{\"mesh\":0,\"matrix\":[0,1,0,0,1,0,0,0,0,0,1,0,5,6,7,1]},"
                                "{\"mesh\":1}],"
                                "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"mode\":5}]},"
                                "{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"mode\":6}]}]"));
    assert_int_equal(f.triangles, 9);
    const cgt_trajectory_mesh *m = cgt_trajectory_get_mesh(scratch_open_one);
    assert_true(m->meshes == 2 && m->instances == 3 && m->unshown == 1);
    expect_corner(&f, 0, 1, 12, 0, 0);
    expect_corner(&f, 0, 2, 10, 0, 1);
    /* mirrored: the order of the corners is reversed, so that the triangle still faces along its normal */
    expect_corner(&f, 3, 1, 10, 1, 0);
    expect_corner(&f, 3, 2, 8, 0, 0);
    /* the matrix exchanges x and y, which mirrors */
    expect_corner(&f, 6, 0, 5, 6, 7);
    expect_corner(&f, 6, 1, 6, 6, 7);
    expect_corner(&f, 6, 2, 5, 7, 7);
}

TEST(instances_of_an_extension)
{
    gltf_builder b = begin();
    static const float moves[6] = {0, 0, 0, 5, 0, 0}, scales[6] = {1, 1, 1, 3, 3, 3};
    gltf_floats(&b, moves, 6, "VEC3");
    gltf_floats(&b, scales, 6, "VEC3");
    const cgt_trajectory_frame f = read_file(
        gltf_text(&b, "\"extensionsRequired\":[\"EXT_mesh_gpu_instancing\"]," SCENE
                      ",\"nodes\":[{\"mesh\":0,\"translation\":[0,0,1],\"extensions\":{\"EXT_mesh_gpu_instancing\":"
                      "{\"attributes\":{\"TRANSLATION\":1,\"SCALE\":2}}}}],"
                      "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"mode\":5}]}]"));
    assert_int_equal(f.triangles, 6);
    expect_corner(&f, 0, 1, 1, 0, 1);
    expect_corner(&f, 3, 0, 5, 0, 1);
    expect_corner(&f, 3, 1, 8, 0, 1);
}

TEST(morph_targets_are_added)
{
    gltf_builder b = begin();
    static const float up[15] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    static const float right[15] = {1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0};
    gltf_floats(&b, up, 15, "VEC3");
    gltf_floats(&b, right, 15, "VEC3");
    const cgt_trajectory_frame f = read_file(gltf_text(
        &b, "\"scene\":0,\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":[{\"mesh\":0},"
            "{\"mesh\":0,\"weights\":[0,10]}],\"meshes\":[{\"weights\":[0.5,2],\"primitives\":["
            "{\"attributes\":{\"POSITION\":0},\"mode\":5,\"targets\":[{\"POSITION\":1},{\"POSITION\":2}]}]}]"));
    assert_int_equal(f.triangles, 6);
    expect_corner(&f, 0, 1, 3, 0, 0.5);
    expect_corner(&f, 3, 1, 11, 0, 0);
    assert_null(cgt_trajectory_take_warning(scratch_open_one));
}

/* Joints of one name, no matrices, and a fifth joint in a second set. */
TEST(skins)
{
    gltf_builder b = begin();
    static const unsigned char joints[20] = {0}, fifth[20] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    static const float half[20] = {0.5f, 0, 0, 0, 0.5f, 0, 0, 0, 0.5f, 0, 0, 0, 0.5f, 0, 0, 0, 1};
    static const float rest[20] = {0.5f, 0, 0, 0, 0.5f, 0, 0, 0, 0.5f, 0, 0, 0, 0.5f, 0, 0, 0, 0};
    const char *const bytes = "\"componentType\":5121,\"count\":5,\"type\":\"VEC4\"";
    gltf_add(&b, joints, 20, "", bytes);
    gltf_floats(&b, half, 20, "VEC4");
    gltf_add(&b, fifth, 20, "", bytes);
    gltf_floats(&b, rest, 20, "VEC4");
    const cgt_trajectory_frame f = read_file(gltf_text(
        &b, "\"scene\":0,\"scenes\":[{\"nodes\":[0,1,2]}],\"nodes\":[{\"mesh\":0,\"skin\":0,\"translation\":[0,0,9]},"
            "{\"name\":\"j\",\"translation\":[0,0,2]},{\"name\":\"j\",\"translation\":[0,0,4]}],"
            "\"skins\":[{\"joints\":[1,2]}],\"meshes\":[{\"primitives\":[{\"mode\":5,\"attributes\":{\"POSITION\":0,"
            "\"JOINTS_0\":1,\"WEIGHTS_0\":2,\"JOINTS_1\":3,\"WEIGHTS_1\":4}}]}]"));
    assert_int_equal(cgt_trajectory_get_mesh(scratch_open_one)->bones, 2);
    expect_corner(&f, 0, 0, 0, 0, 3);
    expect_corner(&f, 0, 1, 1, 0, 3);
    expect_corner(&f, 2, 1, 1, 1, 2);
    expect_corner(&f, 2, 2, 0, 2, 2);
}

static const char *clip_file(const char *interpolation, const float *values, size_t count)
{
    gltf_builder b = begin();
    static const float times[2] = {0, 1};
    char members[1024];
    gltf_floats(&b, times, 2, "SCALAR");
    gltf_floats(&b, values, count, "VEC3");
    snprintf(members, sizeof members,
             ONE_NODE ",\"meshes\":[{\"primitives\":[{\"mode\":5,\"attributes\":{\"POSITION\":0}}]}],"
                      "\"animations\":[{\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":"
                      "\"translation\"}}],\"samplers\":[{\"input\":1,\"output\":2,\"interpolation\":\"%s\"}]}]",
             interpolation);
    return gltf_text(&b, members);
}

TEST(interpolations_are_played)
{
    static const float ends[6] = {0, 0, 0, 0, 0, 5};
    static const float spline[18] = {0, 0, 0, 0, 0, 0, 6, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0};
    cgt_trajectory_options options;
    cgt_trajectory_options_init(&options);
    options.fps = 4;
    static const struct {
        const char *name;
        int axis;
        double at[5];
    } rows[] = {{"LINEAR", 2, {0, 1.25, 2.5, 3.75, 5}},
                {"STEP", 2, {0, 0, 0, 0, 5}},
                /* s (1 - s)^2 6 + s^2 (3 - 2 s) */
                {"CUBICSPLINE", 0, {0, 1.0, 1.25, 1.125, 1}}};
    for (size_t i = 0; i < 3; i++) {
        cgt_trajectory *t = scratch_open(clip_file(rows[i].name, i < 2 ? ends : spline, i < 2 ? 6 : 18), &options);
        for (int k = 0; k < 5; k++) {
            const cgt_trajectory_frame f = scratch_read(t);
            const double v = rows[i].at[k];
            expect_corner(&f, 0, 0, rows[i].axis == 0 ? v : 0, 0, rows[i].axis == 2 ? v : 0);
        }
        scratch_expect_end(t);
        assert_null(cgt_trajectory_take_warning(t));
    }
    scratch_expect_error(clip_file("BEZIER", ends, 6), NULL, 0, "an unknown interpolation");
    scratch_expect_error(clip_file("LINEAR", ends, 3), NULL, 0, "a clip has 1 keys, of 2 times");
}

/* Told of, and the rest is read. */
TEST(what_is_not_played)
{
    static const char *const cases[][2] = {
        {"\"target\":{\"path\":\"pointer\",\"extensions\":{\"KHR_animation_pointer\":{\"pointer\":\"/materials/0\"}}}",
         "a clip changes what is no node"},
        {"\"target\":{\"node\":0,\"path\":\"weights\"}", "morph targets stay as they are"},
    };
    for (size_t i = 0; i < 2; i++) {
        const gltf_builder b = begin();
        char members[1024];
        snprintf(members, sizeof members,
                 ONE_NODE
                 ",\"meshes\":[{\"primitives\":[{\"mode\":5,\"attributes\":{\"POSITION\":0}}]}],"
                 "\"animations\":[{\"channels\":[{\"sampler\":0,%s}],\"samplers\":[{\"input\":0,\"output\":0}]}]",
                 cases[i][0]);
        assert_int_equal(read_file(gltf_text(&b, members)).triangles, 3);
        const char *warning = cgt_trajectory_take_warning(scratch_open_one);
        assert_non_null(warning);
        assert_non_null(strstr(warning, cases[i][1]));
        assert_int_equal(cgt_trajectory_get_mesh(scratch_open_one)->still_channels, 1);
    }
}

/* ---- Files --------------------------------------------------------------------------------------------------- */

#define SQUARE_MESH ONE_NODE ",\"meshes\":[{\"primitives\":[{\"mode\":5,\"attributes\":{\"POSITION\":0}}]}]"

TEST(binary_files)
{
    const gltf_builder b = begin();
    unsigned char bytes[2048];
    const size_t size = gltf_binary(&b, SQUARE_MESH ",\"images\":[{\"uri\":\"absent.png\"}]", bytes, sizeof bytes);
    const cgt_trajectory_frame f = read_file(scratch_bytes(".glb", bytes, size));
    assert_int_equal(f.triangles, 3);
    expect_corner(&f, 2, 2, 0, 2, 0);
    assert_int_equal(read_file(scratch_bytes(".gltf", bytes, size)).triangles, 3); /* by its first bytes */
    const char *path = scratch_path(".glb");
    char error[1024];
    for (size_t cut = 0; cut < size; cut++) {
        scratch_fill(path, bytes, cut);
        assert_null(told_open(path, NULL, error, sizeof error));
        assert_int_equal(strncmp(error, path, strlen(path)), 0);
    }
}

/* A buffer lies beside the document, or below: not where a path from the root or a parent folder leads. */
TEST(buffers_stay_beside_the_file)
{
    const gltf_builder b = begin();
    char uri[640], other[1200];
    const char *const buffer = scratch_bytes(".bin", b.bytes, b.size), *const name = strrchr(buffer, '/') + 1;
    const char *folder = name - 1; /* of "/folder/name": "folder" */
    while (folder > buffer && folder[-1] != '/')
        folder--;
    snprintf(uri, sizeof uri, "\"%s\"", name);
    char *document = gltf_document(&b, SQUARE_MESH, uri);
    assert_int_equal(read_file(scratch_text(".gltf", document)).triangles, 3);
    free(document);
    snprintf(other, sizeof other, "\"../%.*s%s\"", (int)(name - folder), folder, name);
    const char *const wrong[] = {other, "\"/etc/passwd\"", "\"..%2Fodd.bin\"", "\"file:///etc/passwd\""};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        document = gltf_document(&b, SQUARE_MESH, wrong[i]);
        scratch_expect_error(scratch_text(".gltf", document), NULL, 0, "");
        free(document);
    }
}

TEST(texts_that_are_cut_off)
{
    const gltf_builder b = begin();
    char text[4096], error[1024];
    FILE *file = fopen(gltf_text(&b, SQUARE_MESH), "r");
    assert_non_null(file);
    const size_t size = fread(text, 1, sizeof text, file);
    fclose(file);
    const char *path = scratch_path(".gltf");
    for (size_t cut = 0; cut < size; cut++) {
        scratch_fill(path, text, cut);
        assert_null(told_open(path, NULL, error, sizeof error));
        assert_int_equal(strncmp(error, path, strlen(path)), 0);
    }
}

TEST(buffers_in_files)
{
    const gltf_builder b = begin();
    const char *data = scratch_bytes(".b in", b.bytes, b.size);
    char uri[600], *text;
    snprintf(uri, sizeof uri, "\"%s\"", strrchr(data, '/') + 1);
    text = gltf_document(&b, SQUARE_MESH, uri);
    const char *path = scratch_text(".gltf", text);
    free(text);
    assert_int_equal(read_file(path).triangles, 3);
    scratch_fill(data, b.bytes, b.size - 1);
    scratch_expect_error(path, NULL, 0, "File size mismatch");
    assert_int_equal(unlink(data), 0);
    scratch_expect_error(path, NULL, 0, "File not found");
}

/* ---- What is refused ----------------------------------------------------------------------------------------- */

TEST(damage_is_refused)
{
#define MESH(primitive) ONE_NODE ",\"meshes\":[{\"primitives\":[{" primitive "}]}]"
    static const char *const cases[][2] = {
        {MESH("\"attributes\":{\"POSITION\":0},\"mode\":7"), "a primitive of mode 7"},
        {MESH("\"attributes\":{\"POSITION\":0},\"mode\":4"), "a primitive of triangles has 5 corners"},
        {MESH("\"attributes\":{\"NORMAL\":0},\"mode\":5"), "a primitive without positions"},
        {MESH("\"attributes\":{\"POSITION\":9},\"mode\":5"), "positions: there is no accessor 9"},
        {MESH("\"attributes\":{\"POSITION\":1},\"mode\":5"), "positions: accessor 1 has 1 numbers of type 5121"},
        {MESH("\"attributes\":{\"POSITION\":0},\"indices\":0,\"mode\":5"), "indices: accessor 0 has 3 numbers"},
        {MESH("\"attributes\":{\"POSITION\":0},\"indices\":1"), "triangle 0 of a primitive has vertex 5 of 5"},
        {MESH("\"attributes\":{\"POSITION\":2},\"mode\":5"), "positions: 6 elements do not lie in bufferView 0"},
        {MESH("\"attributes\":{\"POSITION\":3},\"mode\":5"), "positions: 5 elements do not lie in bufferView 0"},
        {MESH("\"attributes\":{\"POSITION\":4},\"mode\":5"), "positions: sparse element 5 of 5"},
        {MESH("\"attributes\":{\"POSITION\":5},\"mode\":5"), "positions: compressed by meshopt"},
        {MESH("\"attributes\":{\"POSITION\":6},\"mode\":5"), "positions: accessor 6 has 1000000000 elements"},
        {MESH("\"attributes\":{\"POSITION\":0,\"NORMAL\":7},\"mode\":5"), "4 normals for 5 vertices"},
        {MESH("\"attributes\":{\"POSITION\":6},\"mode\":5,\"extensions\":{\"KHR_draco_mesh_compression\":"
              "{\"bufferView\":0,\"attributes\":{\"POSITION\":0}}}"),
         "mesh 0 is compressed by Draco"},
        {"\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]," MESH("\"attributes\":{\"POSITION\":0},\"mode\":5"),
         "requires the extension KHR_draco_mesh_compression"},
        {ONE_NODE ",\"meshes\":[{\"weights\":[1],\"primitives\":[{\"attributes\":{\"POSITION\":0},\"mode\":5}]}]",
         "mesh 0 has 1 weights, and 0 morph targets"},
        {SCENE ",\"nodes\":[{\"mesh\":3}]", "node 0 shows mesh 3 of 0"},
        {SCENE ",\"nodes\":[{\"children\":[1]},{\"children\":[1]}]", "node 1 has the child 1, which has a parent"},
        {SCENE ",\"nodes\":[{},{\"children\":[2]},{\"children\":[1]}]", "nodes of the file are their own parents"},
        {SCENE ",\"nodes\":[{\"children\":[7]}]", "node 0 has the child 7, which does not exist"},
        {"\"scenes\":[{\"nodes\":[4]}],\"nodes\":[{}]", "the scene shows node 4, which does not exist"},
        {SCENE ",\"nodes\":[{\"scale\":[1,1]}]", "a node's scale has 2 numbers"},
        {SCENE ",\"nodes\":[{}]", "the file holds no triangles: 0 points, 0 lines"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        gltf_builder b = begin();
        static const uint32_t beyond[3] = {0, 1, 5};
        static const unsigned char other[12] = {0};
        gltf_indices(&b, beyond, 3, 1);
        strcat(b.accessors,
               ",{\"bufferView\":0,\"componentType\":5126,\"count\":6,\"type\":\"VEC3\"},"
               "{\"bufferView\":0,\"componentType\":5126,\"count\":5,\"type\":\"VEC3\",\"byteOffset\":4},"
               "{\"componentType\":5126,\"count\":5,\"type\":\"VEC3\",\"sparse\":{\"count\":1,\"indices\":{"
               "\"bufferView\":1,\"byteOffset\":2,\"componentType\":5121},\"values\":{\"bufferView\":0}}}");
        b.count = 5;
        strcat(b.views,
               ",{\"buffer\":0,\"byteLength\":1},{\"buffer\":0,\"byteLength\":1},{\"buffer\":0,\"byteLength\":1}");
        gltf_add(&b, other, 12, ",\"extensions\":{\"EXT_meshopt_compression\":{\"buffer\":0}}",
                 "\"componentType\":5126,\"count\":5,\"type\":\"VEC3\"");
        strcat(b.accessors, ",{\"componentType\":5126,\"count\":1000000000,\"type\":\"VEC3\"},"
                            "{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"}");
        scratch_expect_error(gltf_text(&b, cases[i][0]), NULL, 0, cases[i][1]);
    }
}

TEST(documents_that_are_none)
{
    static char deep[4096];
    strcpy(deep, "{\"extras\":");
    memset(deep + strlen(deep), '[', 3000);
    static const char *const broken[] = {"", "{", "}", "[]", "\"\"", "{\"a\":1}", "glTF", "{\"asset\":{}}"};
    for (size_t i = 0; i < sizeof broken / sizeof broken[0]; i++)
        scratch_expect_error(scratch_text(".gltf", broken[i]), NULL, 0, ": ");
    scratch_expect_error(scratch_text(".gltf", deep), NULL, 0, "3001 levels of brackets");
    static const char old[] = "{\"asset\":{\"version\":\"1.0\"}}";
    scratch_expect_error(scratch_text(".gltf", old), NULL, 0, "the file is of glTF 1");
    scratch_expect_error(scratch_bytes(".glb", "glTF\1\0\0\0\0\0\0\0", 12), NULL, 0, "the file is of glTF 1");
}

SUITE(NULL, NULL)

#else

int main(void)
{
    fprintf(stderr, "this build has no tinygltf\n");
    return 77; /* ctest: skipped */
}

#endif
