/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Static meshes: small files with known vertices, real ones with known counts, and damaged ones. */
#define _GNU_SOURCE
#include <fcntl.h>
#include <math.h>
#include <pthread.h>
#include <sys/stat.h>

#include "readers/trajectory_scratch.h"

#ifdef CGT_HAVE_MESHES

/* assimp 5.2 leaks the half-read mesh of an .obj or .stl that it refuses. Memory from C++'s operator new is assimp's:
 * the code under test is C, and its own leaks are still seen. Called by the leak sanitizer only. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void) { return "leak:libassimp.so\nleak:libstdc++.so\n"; }

#define CUBE_VERTICES "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
#define CUBE_QUADS "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 1 5 8 4\nf 2 3 7 6\n"

/* Opens a mesh and reads its only frame. */
static cgt_trajectory_frame read_mesh(const char *path)
{
    cgt_trajectory *t = scratch_open(path, NULL);
    const cgt_trajectory_frame f = scratch_read(t);
    scratch_expect_end(t);
    assert_int_equal(f.kind, CGT_TRAJECTORY_TRIANGLES);
    assert_true(f.number == 0 && f.xyzr == NULL && f.triangles > 0);
    for (size_t i = 0; i < 3 * (size_t)f.triangles; i++)
        assert_true(f.index[i] < f.count);
    return f;
}

static const cgt_trajectory_mesh *facts(void) { return cgt_trajectory_get_mesh(scratch_open_one); }

/* Six times the volume that closed triangles enclose; positive if they face outwards. */
static double six_volumes(const cgt_trajectory_frame *f)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < f->triangles; i++) {
        double p[3][3];
        for (int k = 0; k < 9; k++)
            p[k / 3][k % 3] = (double)f->position[3 * (size_t)f->index[3 * (size_t)i + (size_t)k / 3] + (size_t)k % 3];
        sum += p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) - p[0][1] * (p[1][0] * p[2][2] - p[1][2] * p[2][0]) +
               p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
    }
    return sum;
}

/* ---- Good files ------------------------------------------------------------------------------------------- */

TEST(quads_become_triangles)
{
    const cgt_trajectory_frame f = read_mesh(scratch_text(".obj", CUBE_VERTICES CUBE_QUADS));
    assert_int_equal(f.triangles, 12);
    assert_int_equal(f.count, 8); /* each corner once, although three faces share it */
    assert_null(f.vertex_normal);
    assert_true(six_volumes(&f) == 6.0);
    const cgt_trajectory_mesh *m = facts();
    assert_non_null(m);
    assert_true(m->meshes == 1 && m->instances == 1 && m->bones == 0 && m->clips == 0);
    assert_true(m->points == 0 && m->lines == 0 && m->lost_triangles == 0 && m->degenerate == 0 && m->unused == 0);
}

/* An L of six corners: a fan from its first corner would extend outside. */
TEST(polygons_may_be_concave)
{
    const cgt_trajectory_frame f =
        read_mesh(scratch_text(".obj", "v 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nf 1 2 3 4 5 6\n"));
    assert_int_equal(f.triangles, 4);
    double area = 0.0;
    for (uint32_t i = 0; i < f.triangles; i++) {
        const float *a = f.position + 3 * f.index[3 * i], *b = f.position + 3 * f.index[3 * i + 1];
        const float *c = f.position + 3 * f.index[3 * i + 2];
        const double twice =
            (double)(b[0] - a[0]) * (double)(c[1] - a[1]) - (double)(b[1] - a[1]) * (double)(c[0] - a[0]);
        assert_true(twice > 0.0);
        area += 0.5 * twice;
    }
    assert_true(area == 3.0);
}

/* The file's bits are preserved: nothing is multiplied if no node has a transformation, and close vertices stay
 * distinct. */
TEST(values_pass_as_they_are)
{
    const cgt_trajectory_frame f =
        read_mesh(scratch_text(".ply", "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
                                       "property float z\nelement face 2\nproperty list uchar int vertex_indices\n"
                                       "end_header\n0.1 -0.0 16777216\n1 0 0\n1.0000001 0 0\n1e-40 3e38 0\n-1e-30 0 "
                                       "1\n3 0 1 2\n3 2 3 4\n"));
    assert_int_equal(f.count, 5);
    assert_int_equal(f.triangles, 2);
    const float *p = f.position;
    assert_true(p[0] == 0.1f && p[1] == 0.0f && p[2] == 16777216.0f);
    assert_true(p[3] == 1.0f && p[6] > 1.0f && p[6] < 1.000001f);
    assert_true(p[9] > 0.0f && p[9] < 1.2e-40f && p[10] == 3e38f && p[12] == -1e-30f);
}

/* The library counts primitives with a NaN; the reader must neither drop nor move them. */
TEST(values_that_are_not_finite_stay)
{
    const cgt_trajectory_frame f = read_mesh(
        scratch_text(".obj", "v 0 0 0\nv nan 0 0\nv 0 inf 0\nv 1 1 1\nv nan 0 0\nf 1 2 4\nf 3 4 1\nf 1 4 5\n"));
    assert_int_equal(f.triangles, 3);
    unsigned nans = 0, infinite = 0;
    for (uint32_t i = 0; i < 3 * f.count; i++) {
        nans += isnan(f.position[i]) != 0;
        infinite += isinf(f.position[i]) != 0;
    }
    assert_int_equal(infinite, 1);
    assert_int_equal(nans, f.count - 3); /* the same bits: one vertex, or two */
    assert_true(nans == 1 || nans == 2);
}

TEST(normals_where_the_file_has_them)
{
    const cgt_trajectory_frame f = read_mesh(scratch_text(
        ".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 2\nvn 0 1 0\nf 1//1 2//1 3//1\nf 1//2 4//2 2//2\n"));
    assert_int_equal(f.triangles, 2);
    assert_int_equal(f.count, 6); /* two normals split a vertex */
    assert_non_null(f.vertex_normal);
    for (uint32_t k = 0; k < 6; k++) {
        const float *n = f.vertex_normal + 3 * f.index[k];
        assert_true(n[0] == 0.0f && n[1] == (k < 3 ? 0.0f : 1.0f) && n[2] == (k < 3 ? 2.0f : 0.0f));
    }
}

TEST(what_is_left_out_is_counted)
{
    const cgt_trajectory_frame f =
        read_mesh(scratch_text(".obj", CUBE_VERTICES "v 9 9 9\nv 0 0 0\np 9\nl 1 2 3\nf 1 2 3\nf 1 1 2\nf 1 10 4\n"));
    assert_int_equal(f.triangles, 3);
    const cgt_trajectory_mesh *m = facts();
    assert_int_equal(m->points, 1);
    assert_int_equal(m->lines, 2);
    assert_int_equal(m->degenerate, 2); /* kept: one by its numbers, one by its positions */
    assert_true(m->unused > 0);
}

TEST(limits_hold)
{
    cgt_trajectory_options options;
    cgt_trajectory_options_init(&options);
    const char *path = scratch_text(".obj", CUBE_VERTICES CUBE_QUADS);
    options.max_count = 11;
    scratch_expect_error(path, &options, 0, "12 triangles are more than the limit of 11");
    const char *apart = scratch_text(".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    options.max_count = 2;
    scratch_expect_error(apart, &options, 0, "more vertices than the limit of 2");
    options.max_count = 3;
    assert_int_equal(scratch_read(scratch_open(apart, &options)).count, 3);
}

TEST(going_back)
{
    char error[1024] = "";
    cgt_trajectory *t = scratch_open(scratch_text(".obj", CUBE_VERTICES CUBE_QUADS), NULL);
    uint64_t frames = 0;
    assert_int_equal(told_count_frames(t, &frames, error, sizeof error), 0);
    assert_int_equal(frames, 1);
    for (int pass = 0; pass < 3; pass++) {
        assert_true(cgt_trajectory_progress(t) == 0.0);
        assert_int_equal(scratch_read(t).count, 8);
        assert_true(cgt_trajectory_progress(t) == 1.0);
        scratch_expect_end(t);
        assert_int_equal(told_rewind(t, error, sizeof error), 0);
    }
}

/* ---- Real files --------------------------------------------------------------------------------------------- */

typedef struct real_mesh {
    const char *path;
    uint32_t triangles, meshes, bones;
    int normals;
} real_mesh;

static const real_mesh real_meshes[] = {
    {"/usr/share/glmark2/models/bunny.obj", 69666, 1, 0, 0},
    {"/usr/share/glmark2/models/horse.3ds", 7172, 1, 0, 1},
    {"/usr/share/assimp/models/IFC/AC14-FZK-Haus.ifc", 35906, 200, 0, 0},
    {"/usr/share/assimp/models/X/BCN_Epileptic.X", 5126, 3, 54, 1},
    {"/usr/share/assimp/models/X/Testwuson.X", 3732, 1, 37, 1},
    {"/usr/share/assimp/models/Collada/human.zae", 28796, 2, 0, 1},
};

TEST(real_files_have_their_counts)
{
    for (size_t i = 0; i < sizeof real_meshes / sizeof real_meshes[0]; i++) {
        const real_mesh *r = &real_meshes[i];
        if (access(r->path, R_OK) != 0) {
            print_message("not here: %s\n", r->path);
            continue;
        }
        cgt_trajectory *t = scratch_open(r->path, NULL);
        const cgt_trajectory_frame f = scratch_read(t);
        assert_int_equal(f.triangles, r->triangles);
        assert_int_equal(facts()->meshes, r->meshes);
        assert_int_equal(facts()->bones, r->bones);
        assert_int_equal(f.vertex_normal != NULL, r->normals);
        assert_true(f.count < 2 * f.triangles);
        assert_true(facts()->lost_triangles == 0 && facts()->points == 0 && facts()->unshown == 0);
        for (size_t k = 0; k < 3 * (size_t)f.count; k++)
            assert_true(isfinite(f.position[k]));
    }
}

/* ---- Damage ------------------------------------------------------------------------------------------------- */

#define PLY_HEAD_OF(format, vertices, faces, length)                                                                   \
    "ply\nformat " format " 1.0\ncomment made by hand\nelement vertex " vertices "\nproperty float x\n"                \
    "property float y\nproperty float z\nelement face " faces "\nproperty list " length " int vertex_indices\n"        \
    "end_header\n"
#define PLY_HEAD(format, vertices, faces) PLY_HEAD_OF(format, vertices, faces, "uchar")
#define TRIANGLE "0 0 0\n1 0 0\n0 1 0\n"

#ifdef CGT_HAVE_GLTF
#define BROKEN_DOCUMENT "parse error"
#else
#define BROKEN_DOCUMENT "glTF is read by tinygltf"
#endif

TEST(damage_is_refused)
{
    static const struct {
        const char *ending, *text, *what;
    } cases[] = {
        {".obj", "", "assimp: "},
        {".obj", "this is a text\nthat nobody could take for a mesh\n", "assimp: "},
        {".obj", CUBE_VERTICES "# and no faces at all, but a comment\n", "assimp: "},
        {".obj", CUBE_VERTICES "f 1 2 9\n", "index out of range"},
        {".obj", CUBE_VERTICES "f 1 2 99999999999\n", "assimp: "},
        {".obj", CUBE_VERTICES "l 1 2 3\np 4\n", "the file holds no triangles: 1 points, 2 lines"},
        {".ply", "", "the file ends in the header"},
        {".ply", "plain text\n", ":1: not a .ply file"},
        {".ply", PLY_HEAD("ascii", "3", "1") TRIANGLE "3 0 1 3\n", "assimp: "},
        {".ply", PLY_HEAD("ascii", "3", "1") TRIANGLE "3 0 1\n", ":14: the line of this face has too few numbers"},
        {".ply", PLY_HEAD("ascii", "3", "2") TRIANGLE "3 0 1 2\n", "after 1 of 2 elements 'face'"},
        {".ply", PLY_HEAD("ascii", "3", "1") "0 0 0\n1 0\n0 1 0\n3 0 1 2\n", ":12: the line of this vertex"},
        {".ply", PLY_HEAD("ascii", "4000000000", "1") TRIANGLE, ":4: 4000000000 elements cannot lie in"},
        {".ply", PLY_HEAD("ascii", "-1", "1") TRIANGLE, ":4: '-1' is not a number of elements"},
        {".ply", PLY_HEAD("ebcdic", "3", "1") TRIANGLE, ":2: 'ebcdic' is no format"},
        {".ply", PLY_HEAD("ascii", "3", "1") TRIANGLE "x 0 1 2\n", ":14: 'x' is not the length of a list"},
        {".ply",
         "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
         "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" TRIANGLE "1 1 0\n4 0 1 2 3\n",
         ":7: triangle strips"},
        {".off", "OFF\n353535235358 6 0\n0 0 0\n", ":2: 353535235358 vertices cannot lie in"},
        {".off", "OFF 3 2000000000 0\n0 0 0\n", ":1: 2000000000 faces cannot lie in"},
        {".ifc", "ISO-10303-21;\nHEADER;\n", "the file does not end in END-ISO-10303-21; it is cut off"},
        {".gltf", "{\"asset\": {\"version\": \"2.0\"}, \"meshes\": [", BROKEN_DOCUMENT},
        {".stl", "solid nothing\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", "assimp: "},
        {".dae", "<COLLADA><library_geometries>", "assimp: "},
        {".x", "xof 0303txt 0032\nMesh {\n3;\n0;0;0;,\n", "assimp: "},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        scratch_expect_error(scratch_text(cases[i].ending, cases[i].text), NULL, 0, cases[i].what);
}

typedef struct often {
    const char *path;
    int is_good, wrong;
} often;

static void *read_often(void *argument)
{
    often *const o = argument;
    for (int i = 0; i < 20; i++) {
        char error[1024] = "";
        cgt_trajectory_frame frame;
        cgt_trajectory *const t = (told_open)(o->path, NULL, error, sizeof error);
        const int status = t != NULL ? (told_read)(t, &frame, error, sizeof error) : -1;
        const int is_as_it_should = o->is_good ? status == 1 && cgt_trajectory_get_mesh(t)->warnings == 0
                                               : status == -1 && strstr(error, "index out of range") != NULL;
        o->wrong += !is_as_it_should;
        (cgt_trajectory_close)(t);
    }
    return NULL;
}

/* assimp has one log and one last error: each file gets its own nevertheless. */
TEST(several_at_once)
{
    pthread_t threads[4];
    often of[4];
    const char *const good = scratch_text(".obj", CUBE_VERTICES CUBE_QUADS);
    const char *const bad = scratch_text(".obj", CUBE_VERTICES "f 1 2 9\n");
    for (int i = 0; i < 4; i++) {
        of[i] = (often){.path = i % 2 ? bad : good, .is_good = i % 2 == 0};
        assert_int_equal(pthread_create(&threads[i], NULL, read_often, &of[i]), 0);
    }
    for (int i = 0; i < 4; i++) {
        assert_int_equal(pthread_join(threads[i], NULL), 0);
        assert_int_equal(of[i].wrong, 0);
    }
}

static void put(unsigned char *bytes, size_t *at, const void *value, size_t size, int big)
{
    uint32_t bits = 0;
    memcpy(&bits, value, sizeof bits);
    for (size_t i = 0; i < size; i++)
        bytes[*at + (big ? size - 1 - i : i)] = (unsigned char)(bits >> (8 * i));
    *at += size;
}

/* Writes a square of two triangles; returns its size. */
static size_t binary_ply(unsigned char bytes[512], int big)
{
    const char *head = big ? PLY_HEAD_OF("binary_big_endian", "4", "2", "ushort")
                           : PLY_HEAD_OF("binary_little_endian", "4", "2", "ushort");
    static const float corners[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    static const uint32_t faces[8] = {3, 0, 1, 2, 3, 0, 2, 3};
    size_t at = strlen(head);
    memcpy(bytes, head, at + 1);
    for (int i = 0; i < 12; i++)
        put(bytes, &at, &corners[i], 4, big);
    for (int i = 0; i < 8; i++)
        put(bytes, &at, &faces[i], i % 4 == 0 ? 2 : 4, big);
    return at;
}

/* A file truncated anywhere is refused: assimp would read a part of it, or loop for ever. */
TEST(every_truncation_of_a_binary_file_is_noticed)
{
    unsigned char bytes[512];
    for (int big = 0; big < 2; big++) {
        const size_t size = binary_ply(bytes, big);
        const cgt_trajectory_frame f = read_mesh(scratch_bytes(".ply", bytes, size));
        assert_true(f.triangles == 2 && f.count == 4 && f.position[6] == 1.0f && f.position[7] == 1.0f);
        const char *path = scratch_path(".ply");
        char error[1024];
        for (size_t cut = 0; cut < size; cut++) {
            scratch_fill(path, bytes, cut);
            assert_null(told_open(path, NULL, error, sizeof error));
            assert_int_equal(strncmp(error, path, strlen(path)), 0);
        }
    }
}

TEST(every_truncation_of_a_text_is_noticed)
{
    static const char text[] = PLY_HEAD("ascii", "3", "1") TRIANGLE "3 0 1 2\n";
    const char *path = scratch_path(".ply");
    char error[1024];
    for (size_t cut = 0; cut + 2 < sizeof text; cut++) { /* complete with or without its last line feed */
        scratch_fill(path, text, cut);
        assert_null(told_open(path, NULL, error, sizeof error));
    }
    assert_int_equal(read_mesh(scratch_bytes(".ply", text, sizeof text - 2)).triangles, 1);
}

TEST(cannot_be_opened)
{
    cgt_trajectory_options options;
    cgt_trajectory_options_init(&options);
    scratch_expect_error("no/such/file.obj", NULL, 0, "No such file");
    options.fps = -1.0;
    scratch_expect_error(scratch_text(".obj", CUBE_VERTICES CUBE_QUADS), &options, 0, "frames per second");
    options.fps = NAN;
    scratch_expect_error(scratch_text(".obj", CUBE_VERTICES CUBE_QUADS), &options, 0, "frames per second");
    const char *path = scratch_path(".obj");
    assert_int_equal(unlink(path), 0);
    assert_int_equal(mkfifo(path, 0600), 0);
    const int pipe_end = open(path, O_RDWR); /* so that opening does not block */
    assert_true(pipe_end >= 0);
    scratch_expect_error(path, NULL, 0, "has to be a regular file");
    assert_int_equal(close(pipe_end), 0);
}

SUITE(NULL, NULL)

#else

/* Without assimp a mesh is refused, and the message says why. */
TEST(meshes_are_refused)
{
    scratch_expect_error(scratch_text(".obj", "v 0 0 0\n"), NULL, 0, "assimp, which this build does not have");
    scratch_expect_error(scratch_text(".GLTF", "{}"), NULL, 0, "assimp, which this build does not have");
    scratch_expect_error("no/such/file.ply", NULL, 0, "No such file");
    scratch_expect_error("file.txt", NULL, 0, "No such file");
}

SUITE(NULL, NULL)

#endif
