/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Animated meshes: a glTF file written here, whose vertices are computed by hand, and characters made by others. */
#define _GNU_SOURCE
#include <math.h>

#include "readers/mesh/gltf_builder.h"
#include "support/trajectory_told.h"

#ifdef CGT_HAVE_GLTF

/* ---- The file ----------------------------------------------------------------------------------------------- */

/* Mesh 0, a triangle in z = 0, is instanced by two nodes below a parent at (10, 0, 0) that scales x by 2: `turned`
 * rotates it by 90 degrees about x, `mirrored` has scale (-1, 1, 1). Mesh 1 is a strip along y on two bones: `hips`,
 * and `tip` one unit above it; its node stands at z = 7.
 *   clip "bend"   0 to 2 s: hips move from 0 to 4 along x in 2 s; tip rotates by 90 degrees about z in the first second
 *   clip "still"  one key at 0 s: mirrored has scale (-3, 3, 3) */
static const char gltf_scene[] =
    "\"scene\": 0, \"scenes\": [{\"nodes\": [0, 3, 5]}],\n"
    "\"nodes\": [{\"name\": \"parent\", \"translation\": [10, 0, 0], \"scale\": [2, 1, 1], \"children\": [1, 2]},\n"
    "{\"name\": \"turned\", \"mesh\": 0, \"rotation\": [0.70710678118, 0, 0, 0.70710678118]},\n"
    "{\"name\": \"mirrored\", \"mesh\": 0, \"scale\": [-1, 1, 1]},\n"
    "{\"name\": \"hips\", \"children\": [4]}, {\"name\": \"tip\", \"translation\": [0, 1, 0]},\n"
    "{\"name\": \"skin\", \"mesh\": 1, \"skin\": 0, \"translation\": [0, 0, 7]}],\n"
    "\"meshes\": [{\"primitives\": [{\"attributes\": {\"POSITION\": 0, \"NORMAL\": 1}}]},\n"
    "{\"primitives\": [{\"attributes\": {\"POSITION\": 2, \"JOINTS_0\": 4, \"WEIGHTS_0\": 5}, \"indices\": 3}]}],\n"
    "\"skins\": [{\"joints\": [3, 4], \"inverseBindMatrices\": 6}],\n"
    "\"animations\": [{\"name\": \"bend\",\n"
    "\"channels\": [{\"sampler\": 0, \"target\": {\"node\": 4, \"path\": \"rotation\"}},\n"
    "{\"sampler\": 1, \"target\": {\"node\": 3, \"path\": \"translation\"}}],\n"
    "\"samplers\": [{\"input\": 7, \"output\": 8}, {\"input\": 9, \"output\": 10}]},\n"
    "{\"name\": \"still\", \"channels\": [{\"sampler\": 0, \"target\": {\"node\": 2, \"path\": \"scale\"}}],\n"
    "\"samplers\": [{\"input\": 11, \"output\": 12}]}]";

/* The parts of the buffer, in the order of their accessors. */
static const float triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
static const float triangle_normals[9] = {0.6f, 0, 0.8f, 0.6f, 0, 0.8f, 0.6f, 0, 0.8f};
static const float strip[15] = {0, 0, 0, 1, 1, 0, 0, 2, 0, 5, 5, 5, 0, 2, 0};
static const uint8_t joints[20] = {0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
/* the first bone; half of each, in unnormalised weights; the second; none; the first */
static const float weights[20] = {1, 0, 0, 0, 0.25f, 0.25f, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0};
static const float inverse_binds[32] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,
                                        1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1};
static const float tip_times[2] = {0, 1};
static const float tip_rotations[8] = {0, 0, 0, 1, 0, 0, 0.70710678118f, 0.70710678118f};
static const float hips_times[2] = {0, 2};
static const float hips_positions[6] = {0, 0, 0, 4, 0, 0};
static const float still_time[1] = {0};
static const float still_scale[3] = {-3, 3, 3};

/* Writes the file and returns its path. The strip's last triangle ends with the given vertex. */
static const char *write_gltf_ending_with(uint32_t vertex)
{
    const uint32_t strip_index[9] = {0, 1, 2, 0, 2, 3, 0, 1, vertex};
    gltf_builder b = {.size = 0};
    gltf_floats(&b, triangle, 9, "VEC3");
    gltf_floats(&b, triangle_normals, 9, "VEC3");
    gltf_floats(&b, strip, 15, "VEC3");
    gltf_indices(&b, strip_index, 9, 2);
    gltf_add(&b, joints, sizeof joints, "", "\"componentType\":5121,\"count\":5,\"type\":\"VEC4\"");
    gltf_floats(&b, weights, 20, "VEC4");
    gltf_floats(&b, inverse_binds, 32, "MAT4");
    gltf_floats(&b, tip_times, 2, "SCALAR");
    gltf_floats(&b, tip_rotations, 8, "VEC4");
    gltf_floats(&b, hips_times, 2, "SCALAR");
    gltf_floats(&b, hips_positions, 6, "VEC3");
    gltf_floats(&b, still_time, 1, "SCALAR");
    gltf_floats(&b, still_scale, 3, "VEC3");
    return gltf_text(&b, gltf_scene);
}

static const char *write_gltf(void) { return write_gltf_ending_with(4); }

/* ---- Expected vertices --------------------------------------------------------------------------------------- */

static cgt_trajectory *open_clip(const char *path, const char *clip, double fps)
{
    cgt_trajectory_options options;
    cgt_trajectory_options_init(&options);
    options.clip = clip;
    options.fps = fps;
    return scratch_open(path, &options);
}

/* Corner k of triangle i of a frame. */
static const float *corner(const cgt_trajectory_frame *f, const float *values, uint32_t i, uint32_t k)
{
    assert_true(i < f->triangles);
    assert_true(f->index[3 * i + k] < f->count);
    return values + 3 * (size_t)f->index[3 * i + k];
}

static void expect_vector(const float *v, double x, double y, double z)
{
    const double wanted[3] = {x, y, z};
    for (int i = 0; i < 3; i++)
        if (!(fabs((double)v[i] - wanted[i]) <= 2e-6))
            fail_msg("(%.9g, %.9g, %.9g) is not (%.9g, %.9g, %.9g)", (double)v[0], (double)v[1], (double)v[2], x, y, z);
}

#define STRIP 2 /* the first triangle of the strip, in the order of the nodes */

/* Positions of the strip, given the hips' translation and the tip's rotation. */
static void expect_strip(const cgt_trajectory_frame *f, double hips, double degrees)
{
    const double angle = degrees * acos(-1.0) / 180.0;
    const double c = cos(angle), s = sin(angle);
    /* the tip rotates its vertices about (0, 1), then everything moves with the hips */
    expect_vector(corner(f, f->position, STRIP, 0), hips, 0, 0);
    expect_vector(corner(f, f->position, STRIP, 1), hips + 0.5 * (1 + c), 1 + 0.5 * s, 0);
    expect_vector(corner(f, f->position, STRIP, 2), hips - s, 1 + c, 0);
    expect_vector(corner(f, f->position, STRIP + 1, 2), 5, 5, 12);   /* no bone: it follows its node */
    expect_vector(corner(f, f->position, STRIP + 2, 2), hips, 2, 0); /* equal to another vertex except for its bone */
}

TEST(nodes_move_their_meshes)
{
    const cgt_trajectory_frame f = scratch_read(open_clip(write_gltf(), NULL, 0.0));
    assert_int_equal(f.triangles, 5);
    assert_int_equal(f.count, 11);
    const cgt_trajectory_mesh *m = cgt_trajectory_get_mesh(scratch_open_one);
    assert_true(m->meshes == 2 && m->instances == 3 && m->bones == 2 && m->clips == 2);
    expect_vector(corner(&f, f.position, 0, 0), 10, 0, 0);
    expect_vector(corner(&f, f.position, 0, 1), 12, 0, 0);
    expect_vector(corner(&f, f.position, 0, 2), 10, 0, 1);
    /* normals transform by the inverse transpose: (0.6, -0.8, 0) under a scale of 2 along x */
    const double length = sqrt(0.3 * 0.3 + 0.8 * 0.8);
    expect_vector(corner(&f, f.vertex_normal, 0, 1), 0.3 / length, -0.8 / length, 0);
    /* mirrored: the order of the corners is reversed, so that the triangle still faces along its normal */
    expect_vector(corner(&f, f.position, 1, 0), 10, 0, 0);
    expect_vector(corner(&f, f.position, 1, 1), 10, 1, 0);
    expect_vector(corner(&f, f.position, 1, 2), 8, 0, 0);
    expect_vector(corner(&f, f.vertex_normal, 1, 1), -0.3 / length, 0, 0.8 / length);
    /* the strip has no normals */
    expect_vector(corner(&f, f.vertex_normal, STRIP, 1), 0, 0, 0);
}

TEST(bones_bend_the_strip)
{
    static const struct {
        double fps;
        unsigned frames;
    } rates[] = {{1, 3}, {2, 5}, {30, 61}, {0.4, 1}, {0.5, 2}, {0, 61}, {7, 15}, {1.4999999999, 4}};
    const char *path = write_gltf();
    for (size_t r = 0; r < sizeof rates / sizeof rates[0]; r++) {
        cgt_trajectory *t = open_clip(path, "bend", rates[r].fps);
        const double fps = rates[r].fps > 0.0 ? rates[r].fps : 30.0;
        for (unsigned i = 0; i < rates[r].frames; i++) {
            const double seconds = i / fps;
            const cgt_trajectory_frame f = scratch_read(t);
            assert_int_equal(f.number, i);
            expect_strip(&f, 2.0 * fmin(seconds, 2.0), 90.0 * fmin(seconds, 1.0));
            expect_vector(corner(&f, f.position, 1, 2), 8, 0, 0);
        }
        scratch_expect_end(t);
    }
}

/* Frames do not depend on earlier frames. */
TEST(frames_by_skipping)
{
    char error[1024] = "";
    cgt_trajectory *t = open_clip(write_gltf(), "0", 4.0);
    uint64_t frames = 0;
    assert_int_equal(told_count_frames(t, &frames, error, sizeof error), 0);
    assert_int_equal(frames, 9);
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < 3; i++)
            assert_int_equal(told_skip(t, error, sizeof error), 1);
        const cgt_trajectory_frame f = scratch_read(t);
        assert_int_equal(f.number, 3);
        expect_strip(&f, 1.5, 67.5);
        assert_int_equal(told_rewind(t, error, sizeof error), 0);
    }
}

TEST(clips_without_a_duration_are_one_frame)
{
    const char *path = write_gltf();
    static const char *const names[] = {"still", "1"};
    for (int i = 0; i < 2; i++) {
        cgt_trajectory *t = open_clip(path, names[i], 0.0);
        const cgt_trajectory_frame f = scratch_read(t);
        expect_strip(&f, 0, 0);
        expect_vector(corner(&f, f.position, 1, 2), 4, 0, 0);
        scratch_expect_end(t);
    }
}

TEST(unknown_clips_are_refused)
{
    cgt_trajectory_options options;
    cgt_trajectory_options_init(&options);
    const char *path = write_gltf();
    options.clip = "jump";
    scratch_expect_error(path, &options, 0, "no clip 'jump'; there are 0 'bend' (2 s), 1 'still' (0 s)");
    options.clip = "2";
    scratch_expect_error(path, &options, 0, "no clip '2'; there are");
    options.clip = "-1";
    scratch_expect_error(path, &options, 0, "no clip '-1'; there are");
    options.clip = "";
    scratch_expect_error(path, &options, 0, "no clip ''; there are");
    scratch_expect_error(scratch_text(".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), &options, 0,
                         "no clip '': the file has no animation");
    options.clip = "bend";
    options.fps = 1e6;
    scratch_expect_error(path, &options, 0, "the clip lasts 2 s: more than 1000000 frames");
}

TEST(lost_triangles_are_an_error)
{
    scratch_expect_error(write_gltf_ending_with(5), NULL, 0, "triangle 2 of a primitive has vertex");
    scratch_expect_error(write_gltf_ending_with(65535), NULL, 0, "triangle 2 of a primitive has vertex");
    assert_int_equal(scratch_read(open_clip(write_gltf_ending_with(0), NULL, 0.0)).triangles, 5);
}

/* A skin need not have matrices. */
TEST(skins_without_matrices)
{
    char text[8192];
    const char *path = write_gltf();
    FILE *file = fopen(path, "r+");
    assert_non_null(file);
    const size_t size = fread(text, 1, sizeof text - 1, file);
    text[size] = '\0';
    char *matrices = strstr(text, "inverseBindMatrices");
    assert_non_null(matrices);
    *matrices = 'I'; /* a key that glTF does not define */
    rewind(file);
    assert_int_equal(fwrite(text, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(scratch_read(scratch_open(path, NULL)).triangles, 5);
}

/* ---- Characters ---------------------------------------------------------------------------------------------- */

/* A walking character stays in one piece: no edge of its surface is ever longer than a third of it. */
TEST(characters_stay_in_one_piece)
{
    static const struct {
        const char *path, *clip;
        unsigned frames;
    } files[] = {
        {"/usr/share/assimp/models/X/Testwuson.X", "Wuson_Walk", 109},
        {"/usr/share/assimp/models/X/Testwuson.X", "Wuson_Run", 30},
        {"/usr/share/assimp/models/X/Testwuson.X", "Wuson_Bind", 1},
        {"/usr/share/assimp/models/X/BCN_Epileptic.X", NULL, 100},
    };
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        if (access(files[i].path, R_OK) != 0) {
            print_message("not here: %s\n", files[i].path);
            continue;
        }
        cgt_trajectory *t = open_clip(files[i].path, files[i].clip, 30.0);
        for (unsigned n = 0; n < files[i].frames; n++) {
            const cgt_trajectory_frame f = scratch_read(t);
            double low = INFINITY, high = -INFINITY, longest = 0.0;
            for (uint32_t k = 0; k < 3 * f.triangles; k++) {
                const float *p = f.position + 3 * f.index[k];
                const float *q = f.position + 3 * f.index[k % 3 == 2 ? k - 2 : k + 1];
                longest =
                    fmax(longest, hypot(hypot((double)(p[0] - q[0]), (double)(p[1] - q[1])), (double)(p[2] - q[2])));
                low = fmin(low, (double)p[1]);
                high = fmax(high, (double)p[1]);
            }
            assert_true(longest > 0.0 && longest < (high - low) / 3.0);
            assert_true(high - low > 1.0 && high - low < 2.5);
        }
        scratch_expect_end(t);
    }
}

/* If a file does not give the length of a tick, a second has 25. */
TEST(ticks_have_a_length)
{
    char error[1024] = "";
    const char *path = "/usr/share/assimp/models/3DS/RotatingCube.3DS"; /* of 181 ticks */
    if (access(path, R_OK) != 0) {
        print_message("not here: %s\n", path);
        return;
    }
    uint64_t frames = 0;
    assert_int_equal(told_count_frames(open_clip(path, NULL, 25.0), &frames, error, sizeof error), 0);
    assert_int_equal(frames, 182);
    assert_int_equal(told_count_frames(open_clip(path, NULL, 5.0), &frames, error, sizeof error), 0);
    assert_int_equal(frames, 37);
}

SUITE(NULL, NULL)

#else

int main(void)
{
    fprintf(stderr, "this build has no reader of glTF\n");
    return 77; /* ctest: skipped */
}

#endif
