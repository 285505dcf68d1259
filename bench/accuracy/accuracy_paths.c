/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The error of paths by bounce, in ulps of the scene's size. */
#include "accuracy/bench_accuracy.h"
#include "support/reference/path_error.h"

enum { STREAM = 6 };

static void write_rows(const accuracy_job *job, const char *mirrors, const char *variant, const path_errors *e)
{
    for (uint32_t k = 0; k < PATH_BOUNCES; k++) {
        bench_table_text(job->table, "mirrors", mirrors);
        bench_table_text(job->table, "variant", variant);
        bench_table_count(job->table, "bounce", k + 1);
        bench_table_count(job->table, "paths", e->paths[k]);
        bench_table_count(job->table, "parted", e->parted[k]);
        bench_table_real(job->table, "mean_ulp", e->paths[k] ? e->sum[k] / e->paths[k] : 0.0);
        bench_table_real(job->table, "worst_ulp", e->worst[k]);
        bench_table_end_row(job->table);
    }
}

int accuracy_paths(const accuracy_job *job)
{
    const char *variant = job->variant[job->variants - 1]; /* the bits are the same in all */
    bench_table_section(job->table, "paths");
    for (int balls = 0; balls < 2; balls++) {
        path_errors errors;
        const cgt_result result = path_errors_measure(balls, job->rays, STREAM, variant, &errors);
        if (result != CGT_OK)
            return bench_scene_failed(NULL, "paths", result);
        write_rows(job, balls ? "balls" : "planes", variant, &errors);
    }
    return PROGRAM_OK;
}
