/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What ranks are told that make mistakes: the same result and sentence on all of them, with the rank's number, whoever
 * made it; and the next good call works. Run by mpirun; exit code 0 where all is right. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cgt/mpi.h>

static int rank, ranks;
static cgt_mpi *mpi;

static const float center[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
static const uint32_t index[3] = {0, 1, 2};
static const float radii[2] = {0.1f, 0.2f};
static uint32_t ids[4];

/* The geometries of a rank, all right but for what a case changes. */
typedef struct shapes {
    cgt_spheres spheres;
    cgt_triangles triangles;
    cgt_capsules capsules;
    cgt_look look;
    cgt_mpi_geometry geometry[2];
    uint32_t count;
} shapes;

static void set_up(shapes *s)
{
    memset(s, 0, sizeof *s);
    s->spheres = (cgt_spheres){.count = 4, .centers = cgt_floats(center[0], 0), .radius = 0.1f};
    s->triangles = (cgt_triangles){
        .count = 1, .indices = cgt_uint32s(index, 0), .vertex_count = 4, .vertices = cgt_floats(center[0], 0)};
    s->capsules = (cgt_capsules){.count = 2, .vertex_count = 4, .vertices = cgt_floats(center[0], 0), .radius = 0.1f};
    for (uint32_t i = 0; i < 4; i++)
        ids[i] = (uint32_t)rank * 4 + i;
    s->geometry[0] = (cgt_mpi_geometry){.spheres = &s->spheres, .ids = ids, .look = &s->look};
    s->geometry[1] = (cgt_mpi_geometry){.triangles = &s->triangles};
    s->count = 2;
}

static void fail(const char *what, const char *text)
{
    fprintf(stderr, "rank %d: %s: %s\n", rank, what, text);
    MPI_Abort(MPI_COMM_WORLD, 1);
}

/* All ranks have the result, and the same sentence with the words. */
static void expect(cgt_result result, cgt_result wanted, const char *words)
{
    char text[400], first[400];
    cgt_mpi_get_error_message(mpi, text, sizeof text);
    memcpy(first, text, sizeof first);
    MPI_Bcast(first, sizeof first, MPI_CHAR, 0, MPI_COMM_WORLD);
    if (result != wanted || !strstr(text, words))
        fail(words, text);
    if (strcmp(text, first) != 0)
        fail("another sentence than rank 0's", text);
}

static void expect_gather(const shapes *s, cgt_result wanted, const char *words)
{
    expect(cgt_mpi_gather(mpi, s->geometry, s->count), wanted, words);
    if (cgt_mpi_get_scene(mpi))
        fail(words, "there is a scene");
}

static void gather_well(void)
{
    shapes s;
    set_up(&s);
    if (cgt_mpi_gather(mpi, s.geometry, s.count) != CGT_OK)
        fail("a good call", "failed");
    if ((cgt_mpi_get_scene(mpi) != NULL) != (rank == 0))
        fail("a scene", "is not where it should be");
}

/* Mistakes of the last rank alone. */
static void gather_badly(void)
{
    const cgt_result bad = CGT_ERROR_INVALID_ARGUMENT;
    const int last = rank == ranks - 1;
    static const uint8_t types[4] = {0, 1, 0, 2};
    static const uint32_t wrong_index[3] = {0, 4, 2};
    char name[32];
    shapes s;
    snprintf(name, sizeof name, "rank %d: ", ranks - 1);
#define MISTAKE(change, words)                                                                                         \
    do {                                                                                                               \
        set_up(&s);                                                                                                    \
        if (last) {                                                                                                    \
            change;                                                                                                    \
        }                                                                                                              \
        expect_gather(&s, bad, words);                                                                                 \
    } while (0)
    MISTAKE(ids[2] = ids[3], "two primitives have the id");
    MISTAKE(ids[0] = 4000000000u, "ids up to 4000000000");
    MISTAKE(ids[0] = 4000000000u, name);
    MISTAKE(ids[0] = CGT_INVALID_ID, "ids up to 4294967295");
    MISTAKE(s.spheres.centers.data = NULL, name);
    MISTAKE(s.spheres.centers.stride = 2, "stride");
    MISTAKE(s.triangles.indices = cgt_uint32s(wrong_index, 0), "geometry 1: vertex 4 of primitive 0: there are 4");
    MISTAKE(s.geometry[1].triangles = NULL, "geometry 1: either spheres or triangles or capsules");
    MISTAKE(s.geometry[1].spheres = &s.spheres, "geometry 1: either spheres or triangles or capsules");
    MISTAKE((s.spheres.radii = cgt_floats(radii, 0), s.spheres.types = cgt_uint8s(types, 0), s.spheres.type_count = 2),
            "geometry 0: type 2 of primitive 3: there are 2");
    MISTAKE(s.look.halves = true, "geometry 0: a look's halves are for capsules");
    MISTAKE(s.look.per_vertex = true, "geometry 0: a look's per_vertex and vertex_normals are for triangles");
    MISTAKE(s.look.vertex_normals = center[0], "geometry 0: a look's per_vertex and vertex_normals are for triangles");
    if (ranks > 1) { /* they differ */
        MISTAKE(s.count = 1, "ranks have from 1 to 2 geometries");
        MISTAKE(s.spheres.mask = 2, "geometry 0: ranks differ");
        MISTAKE(s.look.color[0] = 0.5f, "geometry 0: ranks differ");
        MISTAKE(s.geometry[0].ids = NULL, "geometry 0: ranks differ");
        MISTAKE((s.geometry[1].triangles = NULL, s.geometry[1].capsules = &s.capsules), "geometry 1: ranks differ");
    }
    set_up(&s);
    expect(cgt_mpi_gather(mpi, NULL, 1), bad, "geometries are NULL");
    gather_well();
}

static void draw_badly(void)
{
    static uint8_t bytes[3 * 8 * 8];
    cgt_picture_options options;
    cgt_camera camera, wrong;
    cgt_image image = {.bytes = bytes};
    cgt_picture_options_init(&options);
    options.width = options.height = 8;
    cgt_camera_init(&camera);
    wrong = camera;
    memcpy(wrong.target, wrong.eye, sizeof wrong.eye);
    expect(cgt_mpi_draw(mpi, &options, NULL, &image), CGT_ERROR_INVALID_ARGUMENT, "rank 0: a picture needs a camera");
    expect(cgt_mpi_draw(mpi, &options, &camera, NULL), CGT_ERROR_INVALID_ARGUMENT, "a picture needs");
    expect(cgt_mpi_draw(mpi, &options, &wrong, &image), CGT_ERROR_INVALID_ARGUMENT, "camera");
    image.channels = 2;
    expect(cgt_mpi_draw(mpi, &options, &camera, &image), CGT_ERROR_INVALID_ARGUMENT, "2 channels");
    image.channels = 3;
    image.row_stride = 8;
    expect(cgt_mpi_draw(mpi, &options, &camera, &image), CGT_ERROR_INVALID_ARGUMENT, "row_stride");
    image.row_stride = 0;
    options.antialias = 3;
    expect(cgt_mpi_draw(mpi, &options, &camera, &image), CGT_ERROR_INVALID_ARGUMENT, "antialias 3");
    options.antialias = 1;
    options.bounces.material_count = 3;
    expect(cgt_mpi_draw(mpi, &options, &camera, &image), CGT_ERROR_INVALID_ARGUMENT, "3 materials");
    options.bounces.material_count = 0;
    if (cgt_mpi_draw(mpi, &options, &camera, &image) != CGT_OK || (rank == 0 && !bytes[3 * (3 * 8 + 4)]))
        fail("a good picture", "failed");
    if (cgt_mpi_gather(mpi, NULL, 0) != CGT_OK || cgt_mpi_draw(mpi, &options, &camera, &image) != CGT_OK)
        fail("a picture of nothing", "failed");
}

/* Each rank keeps its rows; the last one has no room for them. */
static void keep_badly(void)
{
    static uint8_t bytes[3 * 8 * 8], alpha[8 * 8];
    const cgt_mpi_options each = {.ranks_per_leader = 1};
    const cgt_image image = {.bytes = bytes}, other = {.alpha = alpha};
    cgt_picture_options options;
    cgt_camera camera;
    uint32_t first, rows;
    shapes s;
    cgt_picture_options_init(&options);
    options.width = options.height = 8;
    cgt_camera_init(&camera);
    set_up(&s);
    if (cgt_mpi_create(MPI_COMM_WORLD, &each, &mpi) != CGT_OK || cgt_mpi_gather(mpi, s.geometry, s.count) != CGT_OK)
        fail("a leader on each rank", "failed");
    if (ranks > 1)
        expect(cgt_mpi_draw_rows(mpi, &options, &camera, rank == ranks - 1 ? &other : &image, &first, &rows),
               CGT_ERROR_INVALID_ARGUMENT, "image lacks a kind");
    if (cgt_mpi_draw_rows(mpi, &options, &camera, &image, &first, &rows) != CGT_OK)
        fail("good rows", "failed");
    cgt_mpi_release(mpi);
}

/* Whether joining fails, and the job tells why. */
static int is_refused(MPI_Comm joined, const cgt_mpi_options *options, const char *word)
{
    char text[200];
    const cgt_result result = cgt_mpi_create(joined, options, &mpi);
    cgt_mpi_get_error_message(mpi, text, sizeof text);
    const int refused = result == CGT_ERROR_INVALID_ARGUMENT && strstr(text, word) && !cgt_mpi_get_scene(mpi) &&
                        cgt_mpi_gather(mpi, NULL, 0) == CGT_ERROR_INVALID_ARGUMENT &&
                        cgt_mpi_draw(mpi, NULL, NULL, NULL) == CGT_ERROR_INVALID_ARGUMENT;
    cgt_mpi_release(mpi);
    return refused;
}

static void create_badly(void)
{
    cgt_mpi_options options = {.exchange_bytes = SIZE_MAX};
    if (!is_refused(MPI_COMM_WORLD, &options, "exchange_bytes"))
        fail("exchange_bytes", "was taken");
    options.exchange_bytes = 0;
    options.context.variant = "fast";
    if (!is_refused(MPI_COMM_WORLD, &options, "fast"))
        fail("a variant", "was taken");
    if (!is_refused(MPI_COMM_NULL, &options, "NULL"))
        fail("no communicator", "was taken");
    if (cgt_mpi_create(MPI_COMM_WORLD, &options, NULL) != CGT_ERROR_INVALID_ARGUMENT ||
        cgt_mpi_gather(NULL, NULL, 0) != CGT_ERROR_INVALID_ARGUMENT || cgt_mpi_get_scene(NULL) ||
        cgt_mpi_draw(NULL, NULL, NULL, NULL) != CGT_ERROR_INVALID_ARGUMENT || !cgt_mpi_get_error_message(NULL, NULL, 0))
        fail("a NULL", "was taken");
    cgt_mpi_release(NULL);
}

int main(int argc, char **argv)
{
    if (!is_refused(MPI_COMM_WORLD, NULL, "after MPI_Init"))
        return 1;
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    create_badly();
    if (cgt_mpi_create(MPI_COMM_WORLD, NULL, &mpi) != CGT_OK)
        fail("joining", "failed");
    static uint8_t byte[3];
    const cgt_image image = {.bytes = byte};
    cgt_camera camera;
    cgt_camera_init(&camera);
    expect(cgt_mpi_draw(mpi, NULL, &camera, &image), CGT_ERROR_INVALID_ARGUMENT, "nothing was gathered");
    gather_badly();
    draw_badly();
    cgt_mpi_release(mpi);
    keep_badly();
    MPI_Finalize();
    return 0;
}
