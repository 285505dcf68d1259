/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A picture by all leaders, each of which makes some rows of it. */
#include <stdlib.h>
#include <string.h>

#include "mpi_job.h"
#include "mpi_processors.h"

/* What rank 0 asks for. */
typedef struct mpi_request {
    cgt_picture_options options;
    cgt_camera camera;
    uint32_t channels; /* of bytes; 0: not wanted */
    bool has_alpha, has_linear;
} mpi_request;

/* A leader's work. */
typedef struct mpi_drawing {
    mpi_request asked;
    cgt_image image; /* the caller's, or of memory that follows */
    cgt_material *materials;
    void *memory;
    uint32_t first, rows;
} mpi_drawing;

static cgt_result check_call(cgt_mpi *m, const cgt_camera *camera, const cgt_image *image, bool stays)
{
    if (!m->committed)
        return cgt_mpi_fail(m, CGT_ERROR_INVALID_ARGUMENT, "nothing was gathered to be drawn");
    if (m->rank == 0 && (!camera || !image))
        return cgt_mpi_fail(m, CGT_ERROR_INVALID_ARGUMENT, "a picture needs a camera and an image at rank 0");
    if (stays && m->leaders != MPI_COMM_NULL && !image)
        return cgt_mpi_fail(m, CGT_ERROR_INVALID_ARGUMENT, "a leader's rows need an image");
    if (m->rank == 0 && image->channels && image->channels != 3 && image->channels != 4)
        return cgt_mpi_fail(m, CGT_ERROR_INVALID_ARGUMENT, "image: %u channels: 3 or 4", image->channels);
    return CGT_OK;
}

/* Leaders get what rank 0 wants; pointers are its own. */
static cgt_result ask(cgt_mpi *m, mpi_drawing *d)
{
    cgt_picture_options *const o = &d->asked.options;
    const cgt_material *const given = o->bounces.materials;
    MPI_Bcast(&d->asked, sizeof d->asked, MPI_BYTE, 0, m->leaders);
    if (m->rank != 0) {
        o->bounces.materials = NULL;
        o->work.stop = NULL;
    }
    if (!o->bounces.material_count || o->bounces.material_count > 256) /* the picture refuses more */
        return CGT_OK;
    const size_t bytes = o->bounces.material_count * sizeof *given;
    d->materials = malloc(bytes);
    cgt_material none[256], *const to = d->materials ? d->materials : none;
    if (m->rank == 0 && given)
        memcpy(to, given, bytes);
    else
        memset(to, 0, bytes);
    MPI_Bcast(to, (int)bytes, MPI_BYTE, 0, m->leaders);
    if (m->rank != 0 || given)
        o->bounces.materials = d->materials;
    return d->materials ? CGT_OK : cgt_mpi_fail(m, CGT_ERROR_OUT_OF_MEMORY, "out of memory for materials");
}

/* Memory of a whole picture for a leader whose caller wants none of it: rows that are not made are never touched. */
static cgt_result make_image(cgt_mpi *m, mpi_drawing *d)
{
    const mpi_request *const a = &d->asked;
    const size_t pixels = (size_t)a->options.width * a->options.height;
    const size_t linear = a->has_linear ? pixels * sizeof(cgt_linear_pixel) : 0, bytes = pixels * a->channels;
    char *const memory = malloc(linear + bytes + pixels);
    if (!memory)
        return cgt_mpi_fail(m, CGT_ERROR_OUT_OF_MEMORY, "out of memory for a picture");
    d->memory = memory;
    d->image = (cgt_image){.channels = a->channels,
                           .bytes = a->channels ? (uint8_t *)memory + linear : NULL,
                           .alpha = a->has_alpha ? (uint8_t *)memory + linear + bytes : NULL,
                           .linear = a->has_linear ? (cgt_linear_pixel *)(void *)memory : NULL};
    return CGT_OK;
}

static cgt_result fail_picture(cgt_mpi *m, cgt_result result)
{
    cgt_picture_get_error_message(m->picture, m->message, sizeof m->message);
    return result;
}

static cgt_result set_picture(cgt_mpi *m, const cgt_picture_options *options)
{
    cgt_result result;
    if (m->picture) {
        result = cgt_picture_set_options(m->picture, options);
        return result == CGT_OK ? result : fail_picture(m, result);
    }
    result = cgt_picture_create(m->context, options, &m->picture);
    if (result != CGT_OK) {
        fail_picture(m, result);
        cgt_picture_release(m->picture);
        m->picture = NULL;
    }
    return result;
}

/* Whether a leader that keeps its rows has room for all that rank 0 wants. */
static bool has_planes(const mpi_drawing *d)
{
    const mpi_request *const a = &d->asked;
    const cgt_image *const i = &d->image;
    return (i->bytes || !a->channels) && (i->alpha || !a->has_alpha) && (i->linear || !a->has_linear);
}

/* The first row of a leader. Rows are shared evenly; rank 0 has one at least, others may have none. */
static uint32_t first_row_of(const cgt_mpi *m, uint32_t height, int leader)
{
    const uint64_t leaders = (uint64_t)m->leader_count;
    return (uint32_t)((height * (uint64_t)leader + leaders - 1) / leaders);
}

static cgt_result draw_rows(cgt_mpi *m, mpi_drawing *d)
{
    cgt_picture_options *const o = &d->asked.options;
    cgt_picture_options defaults;
    cgt_picture_options_init(&defaults);
    o->width = o->width ? o->width : defaults.width;
    o->height = o->height ? o->height : defaults.height;
    d->first = first_row_of(m, o->height, m->leader);
    d->rows = first_row_of(m, o->height, m->leader + 1) - d->first;
    o->work.first_row = d->rows ? d->first : 0;
    o->work.row_count = d->rows ? d->rows : 1;
    cgt_result result = set_picture(m, o); /* checks options, where there are no rows, too */
    if (result == CGT_OK && !d->image.bytes && !d->image.alpha && !d->image.linear)
        result = make_image(m, d);
    if (result != CGT_OK || !d->rows)
        return result;
    result = cgt_picture_draw(m->picture, m->scene, &d->asked.camera, m->looks, m->count, &d->image, NULL);
    return result == CGT_OK ? result : fail_picture(m, result);
}

/* Rows of one plane from all leaders to rank 0. */
static void collect_plane(const cgt_mpi *m, const mpi_drawing *d, void *plane, size_t row, size_t stride)
{
    MPI_Datatype dense, spaced;
    const uint32_t height = d->asked.options.height;
    if (!plane)
        return;
    for (int k = 0; k < m->leader_count; k++) {
        m->places[k] = (int)first_row_of(m, height, k);
        m->bytes[k] = (int)first_row_of(m, height, k + 1) - m->places[k];
    }
    MPI_Type_contiguous((int)row, MPI_BYTE, &dense);
    MPI_Type_create_resized(dense, 0, (MPI_Aint)stride, &spaced);
    MPI_Type_commit(&spaced);
    char *const own = (char *)plane + d->first * stride;
    MPI_Gatherv(m->leader ? own : MPI_IN_PLACE, (int)d->rows, spaced, plane, m->bytes, m->places, spaced, 0,
                m->leaders);
    MPI_Type_free(&spaced);
    MPI_Type_free(&dense);
}

static void collect(const cgt_mpi *m, const mpi_drawing *d)
{
    const cgt_image *const i = &d->image;
    const size_t width = d->asked.options.width, row = width * (i->channels ? i->channels : 3);
    collect_plane(m, d, i->bytes, row, i->row_stride ? i->row_stride : row);
    collect_plane(m, d, i->alpha, width, width);
    collect_plane(m, d, i->linear, width * sizeof *i->linear, width * sizeof *i->linear);
}

static cgt_result draw(cgt_mpi *m, const cgt_picture_options *options, const cgt_camera *camera, const cgt_image *image,
                       bool stays, mpi_drawing *d)
{
    cgt_result result = cgt_mpi_agree(m, check_call(m, camera, image, stays));
    if (result != CGT_OK)
        return result;
    if (m->rank == 0) {
        cgt_picture_options_init(&d->asked.options);
        if (options)
            d->asked.options = *options;
        d->asked.camera = *camera;
        d->asked.channels = !image->bytes ? 0 : image->channels ? image->channels : 3;
        d->asked.has_alpha = image->alpha != NULL;
        d->asked.has_linear = image->linear != NULL;
    }
    if (m->leaders != MPI_COMM_NULL) {
        if (m->rank == 0 || stays)
            d->image = *image;
        cgt_mpi_take_processors(m);
        result = ask(m, d);
        if (result == CGT_OK && stays && !has_planes(d))
            result = cgt_mpi_fail(m, CGT_ERROR_INVALID_ARGUMENT, "a leader's image lacks a kind that rank 0's has");
        if (result == CGT_OK)
            result = draw_rows(m, d);
        cgt_mpi_return_processors(m);
    }
    result = cgt_mpi_agree(m, result);
    if (result == CGT_OK && m->leaders != MPI_COMM_NULL && !stays)
        collect(m, d);
    return result;
}

static cgt_result draw_and_free(cgt_mpi *m, const cgt_picture_options *options, const cgt_camera *camera,
                                const cgt_image *image, bool stays, mpi_drawing *d)
{
    const cgt_result result = draw(m, options, camera, image, stays, d);
    free(d->materials);
    free(d->memory);
    return result;
}

cgt_result cgt_mpi_draw(cgt_mpi *m, const cgt_picture_options *options, const cgt_camera *camera,
                        const cgt_image *image)
{
    mpi_drawing d = {.memory = NULL};
    return m && !m->failed ? draw_and_free(m, options, camera, image, false, &d) : CGT_ERROR_INVALID_ARGUMENT;
}

cgt_result cgt_mpi_draw_rows(cgt_mpi *m, const cgt_picture_options *options, const cgt_camera *camera,
                             const cgt_image *image, uint32_t *first_row, uint32_t *row_count)
{
    mpi_drawing d = {.memory = NULL};
    if (!m || m->failed)
        return CGT_ERROR_INVALID_ARGUMENT;
    const cgt_result result = draw_and_free(m, options, camera, image, true, &d);
    if (first_row)
        *first_row = result == CGT_OK ? d.first : 0;
    if (row_count)
        *row_count = result == CGT_OK ? d.rows : 0;
    return result;
}
