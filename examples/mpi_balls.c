/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A simulation on the ranks of an MPI job that draws itself: balls bounce in a box, each rank has those in its slab of
 * it, and every picture is of all of them, whoever has them.
 *   mpi-balls PICTURES NAME [BALLS]: writes NAME_0.png, NAME_1.png, ... and prints what they took */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cgt/mpi.h>

enum { WIDTH = 1280, HEIGHT = 720 };

/* Where ball i is at a time: it goes straight on, and back from the walls. */
static void move(uint32_t i, double time, double x[3])
{
    for (uint32_t c = 0; c < 3; c++) {
        uint32_t hash = (3 * i + c + 1) * 2654435761u;
        hash = (hash ^ hash >> 15) * 2246822519u;
        const double way = (double)(hash >> 16) / 32768 + time * ((double)(hash & 0xffff) / 32768 - 1);
        x[c] = 10 * fabs(remainder(way, 2)) - 5;
    }
}

static void check(const cgt_mpi *mpi, cgt_result result)
{
    if (result != CGT_OK) {
        char text[400];
        cgt_mpi_get_error_message(mpi, text, sizeof text);
        fprintf(stderr, "mpi-balls: %s\n", text);
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
}

int main(int argc, char **argv)
{
    static uint8_t rgb[3 * WIDTH * HEIGHT];
    const uint32_t balls = argc > 3 ? (uint32_t)strtoul(argv[3], NULL, 10) : 3000;
    double(*const x)[3] = malloc(balls * sizeof *x);
    uint32_t *const id = malloc(balls * sizeof *id);
    uint16_t *const kind = malloc(balls * sizeof *kind);
    float color[8][3];
    const cgt_picture_options options = {
        .width = WIDTH, .height = HEIGHT, .shading = CGT_SHADING_FULL, .lighting = {.ambient = 8}};
    const cgt_image image = {.bytes = rgb};
    cgt_camera camera = {.eye = {9, 7, 14}};
    int rank, ranks;
    cgt_mpi *mpi;
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    if (!x || !id || !kind)
        MPI_Abort(MPI_COMM_WORLD, 1);
    const cgt_result joined = cgt_mpi_create(MPI_COMM_WORLD, NULL, &mpi);
    check(mpi, joined);
    for (uint32_t k = 0; k < 8; k++) {
        cgt_get_type_color(k + 1, color[k]);
        for (uint32_t c = 0; c < 3; c++)
            color[k][c] = cgt_srgb_to_linear(color[k][c]);
    }
    for (int picture = 0; picture < (argc > 2 ? atoi(argv[1]) : 0); picture++) {
        char path[1000];
        cgt_scene_statistics built;
        cgt_spheres mine = {.centers = cgt_doubles(x[0], 0), .radius = (float)(2 / cbrt(balls))};
        for (uint32_t i = 0; i < balls; i++) { /* a real simulation would hand balls from rank to rank */
            double *const at = x[mine.count];
            move(i, 0.2 * picture, at);
            if ((int)fmin((at[0] + 5) / 10 * ranks, ranks - 1) != rank)
                continue;
            kind[mine.count] = i % 8;
            id[mine.count++] = i;
        }
        const cgt_look look = {.index = kind, .palette = color[0]};
        const cgt_mpi_geometry geometry = {.spheres = &mine, .ids = id, .look = &look};
        MPI_Barrier(MPI_COMM_WORLD);
        const double start = MPI_Wtime();
        check(mpi, cgt_mpi_gather(mpi, &geometry, 1));
        const double gathered = MPI_Wtime();
        check(mpi, cgt_mpi_draw(mpi, &options, &camera, &image));
        if (rank)
            continue;
        cgt_scene_get_statistics(cgt_mpi_get_scene(mpi), &built);
        printf("gather %.1f ms, commit %.1f ms, picture %.1f ms\n", 1e3 * (gathered - start) - built.commit_ms,
               built.commit_ms, 1e3 * (MPI_Wtime() - gathered));
        snprintf(path, sizeof path, "%s_%d.png", argv[2], picture);
        if (cgt_write_png(path, &image, WIDTH, HEIGHT)) {
            perror(path);
            MPI_Abort(MPI_COMM_WORLD, 1);
        }
    }
    cgt_mpi_release(mpi);
    MPI_Finalize();
    return 0;
}
