/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * libcgt-mpi: pictures of what lies distributed over the ranks of an MPI job, while it runs. In outline, on every rank:
 *
 *   cgt_mpi_create(MPI_COMM_WORLD, NULL, &mpi);
 *   const cgt_spheres mine = {.count = n, .centers = cgt_doubles(x, 0), .radius = 0.5f};
 *   const cgt_mpi_geometry geometry = {.spheres = &mine, .ids = id};
 *   while (simulate(x)) {
 *       cgt_mpi_gather(mpi, &geometry, 1);
 *       cgt_mpi_draw(mpi, &options, &camera, &image);         the picture is at rank 0
 *   }
 *
 * (examples/mpi_balls.c is a whole program.) The ranks of a machine have a leader, the lowest of them. Each machine
 * gets all primitives once, in shared memory that its ranks fill together: 16 bytes a sphere, 28 a capsule, 12 a
 * triangle and 12 a vertex, and what looks have for each. There its leader has the scene, whose structure comes on top.
 * The leaders share the rows of a picture, and work with the processors of all ranks of their machines, which sleep
 * meanwhile.
 *
 * The bytes are those that cgt_picture_draw makes of all primitives in one process, in the order of their ids, for any
 * number of ranks and leaders and any distribution.
 *
 * Collective  All ranks call cgt_mpi_create, _gather, _draw, _draw_rows and _release together, in the same order.
 * Errors      All ranks return the same result and message: that of the lowest rank where something is wrong, which it
 *             names. Errors of MPI itself, a rank that has died among them, end the job: the calls make the handler of
 *             their communicator, a copy, MPI_ERRORS_ARE_FATAL.
 * Threads     One thread of a rank calls these. MPI_THREAD_FUNNELED is enough. */
#ifndef CGT_MPI_H
#define CGT_MPI_H

#include <cgt/picture.h>

#include <mpi.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct cgt_mpi cgt_mpi;

typedef struct cgt_mpi_options {
    uint32_t ranks_per_leader; /* at most, such as those of a socket; 0 (default): all ranks of a machine have one */
    /* Memory of a leader for what comes from other machines at a time, at most 2^30; 0 (default): 64 MB. */
    size_t exchange_bytes;
    cgt_context_options context; /* of leaders; threads 0 (default): as many as their ranks may use processors */
} cgt_mpi_options;

/* Joins the ranks of a communicator.
 *   ranks     a communicator of one group; copied
 *   options   NULL: the defaults; needed during the call only. ranks_per_leader and exchange_bytes are rank 0's
 *   mpi       gets the handle; on an error, one that has the message, or NULL if there is no memory even for that
 * Errors: INVALID_ARGUMENT, also before MPI_Init; OUT_OF_MEMORY, UNSUPPORTED, THREADS, as cgt_context_create */
CGT_API cgt_result cgt_mpi_create(MPI_Comm ranks, const cgt_mpi_options *options, cgt_mpi **mpi);

/* Releases it, before MPI_Finalize; NULL, on all ranks, does nothing. */
CGT_API void cgt_mpi_release(cgt_mpi *mpi);

/* Copies the message of the last call that failed, as cgt_context_get_error_message does. */
CGT_API size_t cgt_mpi_get_error_message(const cgt_mpi *mpi, char *text, size_t size);

/* A rank's share of a geometry, in its own arrays; its counts may be 0, and differ from call to call. What is no array
 * of primitives or vertices, such as mask and colour, is the same on all ranks. So is which arrays there are, where
 * there are primitives. */
typedef struct cgt_mpi_geometry {
    const cgt_spheres *spheres;     /* one of these three */
    const cgt_triangles *triangles; /* indices are those of the rank's own vertices */
    const cgt_capsules *capsules;
    /* Number of each primitive in the whole geometry, each of them once, which hits and pixels have: 1,048,576 + 4
     * times the primitives of all ranks at most. Numbers that no primitive has cost its memory. NULL (default):
     * those of a rank follow those of the ranks before it. */
    const uint32_t *ids;
    /* For cgt_mpi_draw, with arrays of this rank's primitives and vertices; its palette, the same on all ranks, is
     * read by cgt_mpi_draw. `ids` are not read; numbers of bodies are those of the whole geometry. NULL (default):
     * {0}. */
    const cgt_look *look;
} cgt_mpi_geometry;

/* Gathers all geometries on each machine, and commits them there.
 *   geometries   needed during the call only, as their arrays are, but for palettes
 *   count        of geometries, the same on all ranks; they get the ids 0, 1, and so on
 * Memory: the leaders' shared memory grows by half; it may need room in /dev/shm
 * Errors: as cgt_scene_set_spheres and cgt_scene_commit; INVALID_ARGUMENT (an id or an index is out of range or comes
 *         twice; a look is of another kind of geometry; ranks differ), TOO_LARGE (2^32 - 1 primitives), OUT_OF_MEMORY.
 *         There is no scene then */
CGT_API cgt_result cgt_mpi_gather(cgt_mpi *mpi, const cgt_mpi_geometry *geometries, uint32_t count);

/* Returns the scene of all geometries on leaders, of which rank 0 is one, for bounds, picks and other rays: valid until
 * the next gather. NULL on all other ranks and where nothing was gathered. */
CGT_API const cgt_scene *cgt_mpi_get_scene(const cgt_mpi *mpi);

/* Makes a whole picture of what was gathered.
 *   options   rank 0's count; NULL: the defaults. Of `work` rank 0's `stop` alone is asked
 *   camera    rank 0's counts
 *   image     rank 0's gets the picture; others are not read
 * Errors: as cgt_picture_create and cgt_picture_draw; INVALID_ARGUMENT if nothing was gathered */
CGT_API cgt_result cgt_mpi_draw(cgt_mpi *mpi, const cgt_picture_options *options, const cgt_camera *camera,
                                const cgt_image *image);

/* The same, but rows stay where they are made, to be written or sent on from there.
 *   image       of each leader, of the whole picture, and of the kinds that rank 0's has; gets the leader's rows
 *   first_row   gets the first of the rows that are in image
 *   row_count   gets their number; 0 on all ranks that are no leaders */
CGT_API cgt_result cgt_mpi_draw_rows(cgt_mpi *mpi, const cgt_picture_options *options, const cgt_camera *camera,
                                     const cgt_image *image, uint32_t *first_row, uint32_t *row_count);

#ifdef __cplusplus
}
#endif

#endif
