/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A simulation on the ranks of an MPI job that draws itself: balls bounce in a box, each rank has those in its slab of
 * it, and every picture is of all of them, whoever has them. mpi-balls STEPS NAME writes NAME_0.png, NAME_1.png, ... */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cgt/mpi.h>

enum { BALLS = 3000, WIDTH = 320, HEIGHT = 240, STEPS_A_PICTURE = 20 };

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

static void check(cgt_mpi *mpi, cgt_result result)
{
    char text[400] = "";
    cgt_mpi_get_error_message(mpi, text, sizeof text);
    if (result != CGT_OK) {
        fprintf(stderr, "mpi-balls: %s\n", text);
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
}

int main(int argc, char **argv)
{
    static double x[BALLS][3];
    static uint32_t id[BALLS];
    static float color[BALLS][3];
    static uint8_t rgb[3 * WIDTH * HEIGHT];
    const cgt_picture_options options = {.width = WIDTH, .height = HEIGHT, .shading = CGT_SHADING_FULL, .ambient = 16};
    const cgt_image image = {.bytes = rgb};
    int rank, ranks, wrong = 0;
    cgt_mpi *mpi;
    cgt_camera camera;
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    check(NULL, cgt_mpi_create(MPI_COMM_WORLD, NULL, &mpi));
    cgt_camera_init(&camera);
    memcpy(camera.eye, (float[]){9, 7, 14}, sizeof camera.eye);
    for (int step = 0; step < (argc > 2 ? atoi(argv[1]) : 0); step++) {
        char path[1000];
        cgt_spheres spheres = {.centers_double = x[0], .radius = 0.2f};
        for (uint32_t i = 0; i < BALLS; i++) { /* a real simulation would hand balls from rank to rank */
            double *const at = x[spheres.count];
            move(i, 0.01 * STEPS_A_PICTURE * step, at);
            if ((int)fmin((at[0] + 5) / 10 * ranks, ranks - 1) != rank)
                continue;
            cgt_get_type_color(1 + i % 8, color[spheres.count]);
            id[spheres.count++] = i;
        }
        const cgt_look look = {.colors = color[0]};
        const cgt_mpi_geometry balls = {.spheres = &spheres, .ids = id, .look = &look};
        check(mpi, cgt_mpi_gather(mpi, &balls, 1));
        check(mpi, cgt_mpi_draw(mpi, &options, &camera, &image));
        snprintf(path, sizeof path, "%s_%d.png", argv[2], step);
        wrong |= rank == 0 && cgt_write_png(path, &image, WIDTH, HEIGHT);
    }
    cgt_mpi_release(mpi);
    MPI_Finalize();
    return wrong;
}
