/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The file of a frame's hits. */
#include "rays/bench_output.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "common/program.h"

int bench_output_begin(bench_output *output, const char *path)
{
    char error[PROGRAM_ERROR_SIZE];
    *output = (bench_output){.path = path};
    if (!path || (output->temporary = out_file_begin(&output->file, path, error, sizeof error)) != NULL)
        return PROGRAM_OK;
    program_error("%s", error);
    return PROGRAM_FAILED;
}

static int write_hits(const bench_output *output, const bench_planes *planes)
{
    FILE *file = fopen(output->temporary, "wb");
    int failed = !file || bench_planes_write(planes, file);
    int reason = errno;
    if (file && fclose(file) && !failed) {
        failed = 1;
        reason = errno;
    }
    if (failed)
        program_error("%s: %s", output->path, strerror(reason));
    return failed;
}

int bench_output_end(bench_output *output, const bench_planes *planes)
{
    char error[PROGRAM_ERROR_SIZE];
    if (!output->temporary)
        return PROGRAM_OK;
    const int is_whole = planes && !write_hits(output, planes);
    output->temporary = NULL;
    if (out_file_end(&output->file, is_whole, error, sizeof error)) {
        program_error("%s", error);
        return PROGRAM_FAILED;
    }
    return is_whole || !planes ? PROGRAM_OK : PROGRAM_FAILED;
}
