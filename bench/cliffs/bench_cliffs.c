/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench cliffs: what is measured in which order. */
#include "cliffs/bench_cliffs.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct job {
    const bench_settings *settings;
    bench_table *table;
    cliffs_rows rows;
    uint32_t primitives;
    cliffs_input input;
    cliffs_result twin[CLIFF_BASES][BENCH_MOST_WAYS], result[BENCH_MOST_WAYS]; /* for so many primitives */
    bool has_twin[CLIFF_BASES];
    char config[BENCH_MOST_WAYS][BENCH_NAME_SIZE]; /* of ways, which are the same for all scenes of a base */
} job;

/* By all ways; the twin's without Embree. */
static int measure_scene(job *j, const cliff *c, bool disturbed, cliffs_result *result)
{
    int code = cliffs_input_make(&j->input, j->settings, c, disturbed, j->primitives);
    for (size_t i = 0; i < j->input.session.tracers && code == PROGRAM_OK; i++) {
        bench_tracer *t = &j->input.session.tracer[i];
        memcpy(j->config[i], t->config, sizeof j->config[i]);
        if (!t->left_out && (disturbed || !t->way->embree))
            code = cliffs_measure(&j->input, t, &result[i]);
    }
    return code;
}

static int measure_twin(job *j, cliff_base base)
{
    const cliff twin = {.name = "twin", .base = base};
    if (j->has_twin[base])
        return PROGRAM_OK;
    const int code = measure_scene(j, &twin, false, j->twin[base]);
    cliffs_input_free(&j->input);
    j->has_twin[base] = true;
    return code;
}

static int measure_cliff(job *j, const cliff *c)
{
    static const cliffs_result none;
    const cliffs_result *embree = &none;
    if (measure_twin(j, c->base))
        return PROGRAM_FAILED;
    int code = measure_scene(j, c, true, j->result);
    const bench_session *s = &j->input.session;
    for (size_t i = 0; i < s->tracers; i++)
        if (s->way[i].embree)
            embree = &j->result[i];
    for (size_t i = 0; i < s->tracers && code == PROGRAM_OK; i++) {
        const cliffs_row name = {.scene = c->name, .config = j->config[i], .primitives = j->primitives};
        if (!s->way[i].embree && !s->tracer[i].left_out)
            code = cliffs_add_rows(&j->rows, j->table, &name, &j->result[i], &j->twin[c->base][i], embree);
    }
    cliffs_input_free(&j->input);
    return code;
}

static bool is_chosen(const bench_settings *s, const cliff *c) { return !s->text || strstr(c->name, s->text); }

static int measure_all(job *j)
{
    const bench_settings *s = j->settings;
    int code = PROGRAM_OK;
    for (uint32_t k = 0; k < s->counts; k++) {
        j->primitives = s->count[k];
        memset(j->has_twin, 0, sizeof j->has_twin);
        for (uint32_t i = 0; i < cliff_count() && code == PROGRAM_OK; i++)
            if (is_chosen(s, cliff_at(i)))
                code = measure_cliff(j, cliff_at(i));
    }
    if (code == PROGRAM_OK)
        cliffs_print_worst(&j->rows, j->table, s->worst);
    return code;
}

int bench_cliffs(const bench_settings *settings)
{
    uint32_t chosen = 0;
    for (uint32_t i = 0; i < cliff_count(); i++) {
        chosen += is_chosen(settings, cliff_at(i));
        if (settings->list)
            puts(cliff_at(i)->name);
    }
    if (settings->list)
        return PROGRAM_OK;
    if (!chosen) {
        program_error("--scene: no scene has a name with \"%s\": --list prints them", settings->text);
        return PROGRAM_USAGE;
    }
    job *j = calloc(1, sizeof *j);
    if (!j) {
        program_error("out of memory");
        return PROGRAM_FAILED;
    }
    j->settings = settings;
    j->table = bench_table_open(settings->json_path);
    int code = j->table ? measure_all(j) : PROGRAM_FAILED;
    if (bench_table_close(j->table))
        code = PROGRAM_FAILED;
    free(j->rows.row);
    free(j);
    return code;
}
