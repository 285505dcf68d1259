/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench simd: every word of the vocabulary in every variant that the CPU runs, against a native form written by
 * hand. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/bench.h"
#include "common/bench_scene.h"
#include "simd/simd_measure.h"
#include "simd/simd_rows.h"

#define MOST_WORDS 64
#define DEFAULT_REPEAT 60
static const char no_reason[] = "!!! NO REASON GIVEN !!!";

/* ---- tables of a variant ---- */

typedef struct part_tables {
    const simd_table *words, *wide, *exact, *native;
} part_tables;

#define TABLES(variant)                                                                                                \
    extern const simd_table bench_simd_words_##variant, bench_simd_wide_##variant, bench_simd_exact_##variant,         \
        bench_simd_native_##variant;                                                                                   \
    static const part_tables tables_##variant = {&bench_simd_words_##variant, &bench_simd_wide_##variant,              \
                                                 &bench_simd_exact_##variant, &bench_simd_native_##variant};
#ifdef CGT_HAVE_PORTABLE
TABLES(portable)
#endif
#ifdef CGT_HAVE_SSE
TABLES(sse)
#endif
#ifdef CGT_HAVE_NEON
TABLES(neon)
#endif
#ifdef CGT_HAVE_AVX2
TABLES(avx2)
#endif
#ifdef CGT_HAVE_AVX512
TABLES(avx512)
#endif

static const part_tables *const all_tables[] = {
#ifdef CGT_HAVE_PORTABLE
    &tables_portable,
#endif
#ifdef CGT_HAVE_SSE
    &tables_sse,
#endif
#ifdef CGT_HAVE_NEON
    &tables_neon,
#endif
#ifdef CGT_HAVE_AVX2
    &tables_avx2,
#endif
#ifdef CGT_HAVE_AVX512
    &tables_avx512,
#endif
};
#define VARIANTS (sizeof all_tables / sizeof all_tables[0])

/* ---- job ---- */

/* The summary of a variant. */
typedef struct tally {
    size_t rows, compared, within, with_reason, without_reason, different;
} tally;

typedef struct simd_job {
    const char *variant; /* NULL: all that the CPU runs */
    const char *words[MOST_WORDS];
    bool word_found[MOST_WORDS];
    size_t word_count; /* 0: all */
    uint32_t repeat;
    bool lists;
    simd_memory *memory;
    double *samples[2];
    const simd_table *machine; /* native forms of the first variant that has some:
                                the portable one's opponent */
    tally tally;
} simd_job;

static bool is_asked_for(simd_job *job, const char *word)
{
    bool found = job->word_count == 0;
    for (size_t i = 0; i < job->word_count; i++)
        if (strcmp(word, job->words[i]) == 0 || (strncmp(word, "spu_", 4) == 0 && !strcmp(word + 4, job->words[i]))) {
            job->word_found[i] = true;
            found = true;
        }
    return found;
}

/* Of the rows compiled for the SPU's arithmetic, those whose code differs. */
static bool is_single_precision(const simd_row *row)
{
    bool single = row->result == SIMD_f32;
    for (int i = 0; i < 3; i++) {
        if (row->operand[i] == SIMD_f64 || row->result == SIMD_f64)
            return false;
        single |= row->operand[i] == SIMD_f32;
    }
    return single;
}

/* ---- rows ---- */

static void print_row_name(const char *variant, const simd_pair *pair)
{
    static const char *const count_name[] = {"-", "variable", "constant"};
    const simd_row *row = pair->mapped;
    const bool literal = row->operand[1] == SIMD_n_scale || row->operand[1] == SIMD_n_special;
    printf("%s\t%s\t(%s", variant, row->word, simd_kind_name(row->operand[0]));
    for (int i = 1; i < 3 && row->operand[i]; i++)
        printf(" %s", simd_kind_name(row->operand[i]));
    printf(") %s\t%s\t%d", simd_kind_name(row->result), count_name[literal ? SIMD_CONSTANT : row->count],
           simd_row_lanes(row, pair->lanes));
}

static void print_times(simd_job *job, const char *variant, const simd_pair *pair, simd_times times)
{
    const char *reason = "";
    printf("\t%.3f\t%.4f", times.mapped_ns, times.mapped_ns / simd_row_lanes(pair->mapped, pair->lanes));
    if (!pair->native) {
        printf("\t-\t-\t\n");
        return;
    }
    const double ratio = times.mapped_ns / times.native_ns;
    job->tally.compared++;
    if (ratio <= SIMD_TOLERANCE) {
        job->tally.within++;
    } else {
        const char *said = simd_reason(variant, pair->mapped);
        reason = said ? said : no_reason;
        job->tally.with_reason += said != NULL;
        job->tally.without_reason += said == NULL;
    }
    printf("\t%.3f\t%.2f\t%s\n", times.native_ns, ratio, reason);
}

static void do_row(simd_job *job, const char *variant, const simd_pair *pair)
{
    job->tally.rows++;
    if (!simd_agrees(job->memory, pair)) {
        fflush(stdout);
        program_error("%s: %s(%s): the native form gives another result", variant, pair->mapped->word,
                      simd_kind_name(pair->mapped->operand[0]));
        job->tally.different++;
    }
    print_row_name(variant, pair);
    if (job->lists)
        printf("\t%s\n", pair->native ? "native" : "-");
    else
        print_times(job, variant, pair, simd_measure(job->memory, pair, job->repeat, job->samples));
    fflush(stdout);
}

static void do_table(simd_job *job, const char *variant, const simd_table *table, const simd_table *native,
                     bool is_exact)
{
    for (size_t i = 0; i < table->count; i++) {
        const simd_row *row = &table->row[i];
        if ((is_exact && !is_single_precision(row)) || !is_asked_for(job, row->word))
            continue;
        const bool are_alike = !is_exact && strcmp(native ? native->variant : "", table->variant) == 0;
        const simd_pair pair = {row, simd_find(native, row), table->lanes, are_alike};
        do_row(job, variant, &pair);
    }
}

/* Each native form belongs to a word. */
static size_t count_orphans(const part_tables *t)
{
    size_t orphans = 0;
    for (size_t i = 0; i < t->native->count; i++)
        if (!simd_find(t->words, &t->native->row[i]) && !simd_find(t->wide, &t->native->row[i])) {
            program_error("%s: a native form of %s(%s ...) and no such word", t->native->variant,
                          t->native->row[i].word, simd_kind_name(t->native->row[i].operand[0]));
            orphans++;
        }
    return orphans;
}

/* ---- variants ---- */

/* Whether the CPU runs a variant, according to the library. */
static bool runs(const char *variant, cgt_result *result)
{
    cgt_context *context = NULL;
    *result = bench_context_create(1, variant, &context);
    if (*result == CGT_OK)
        cgt_context_release(context);
    return *result == CGT_OK;
}

static void print_tally(const simd_job *job, const char *variant)
{
    const tally *t = &job->tally;
    printf("# %s\t%zu rows\t%zu with a native form\t%zu within %.0f %%\t%zu "
           "above, with a reason\t"
           "%zu above, without a reason\t%zu with another result\n",
           variant, t->rows, t->compared, t->within, (SIMD_TOLERANCE - 1) * 100, t->with_reason, t->without_reason,
           t->different);
}

static int do_variant(simd_job *job, const part_tables *t)
{
    const char *const variant = t->words->variant;
    const simd_table *const native = t->native->count ? t->native : job->machine;
    char exact[64];
    snprintf(exact, sizeof exact, "%s+exact", variant);
    memset(&job->tally, 0, sizeof job->tally);
    const size_t orphans = count_orphans(t);
    if (!job->lists)
        simd_warm_up(job->memory, &t->words->row[0], t->words->lanes);
    do_table(job, variant, t->words, native, false);
    do_table(job, variant, t->wide, native, false);
    do_table(job, exact, t->exact, native, true);
    if (!job->lists)
        print_tally(job, variant);
    return orphans || job->tally.different ? PROGRAM_FAILED : PROGRAM_OK;
}

static int do_variants(simd_job *job)
{
    int code = PROGRAM_OK;
    cgt_result result = CGT_OK;
    for (size_t i = 0; i < VARIANTS && !job->machine; i++)
        if (all_tables[i]->native->count && runs(all_tables[i]->native->variant, &result))
            job->machine = all_tables[i]->native;
    printf("variant\tword\toverload\tcount\tlanes\t%s\n",
           job->lists ? "native" : "ns_per_word\tns_per_lane\tnative_ns_per_word\tratio\treason");
    for (size_t i = 0; i < VARIANTS; i++) {
        const char *const variant = all_tables[i]->words->variant;
        if (job->variant && strcmp(job->variant, variant) != 0)
            continue;
        if (!runs(variant, &result)) {
            if (result != CGT_ERROR_UNSUPPORTED || job->variant)
                return bench_scene_failed(NULL, variant, result);
            printf("# variant %s left out: this CPU lacks it\n", variant);
        } else if (do_variant(job, all_tables[i]) != PROGRAM_OK) {
            code = PROGRAM_FAILED;
        }
    }
    return code;
}

/* ---- command ---- */

static const struct argp_option options[] = {
    {"variant", 'v', "NAME", 0, "this variant alone (default: all that the CPU runs)", 0},
    {"word", 'w', "WORD", 0, "this word alone, with or without spu_; may be given several times", 0},
    {"repeat", 'r', "COUNT", 0, "samples of each form (default 60)", 0},
    {"list", 'l', NULL, 0, "say which rows there are and measure nothing", 0},
    {NULL, 0, NULL, 0, NULL, 0}};

/* Whether the CPU runs it shows when the context is created. */
static int parse_variant(const char *text, const char **variant, char *error, size_t error_size)
{
    size_t length = (size_t)snprintf(error, error_size, "%s: no such variant; this build has", text);
    for (size_t i = 0; i < VARIANTS; i++) {
        const char *name = all_tables[i]->words->variant;
        if (strcmp(text, name) == 0) {
            *variant = name;
            return 0;
        }
        if (length < error_size)
            length += (size_t)snprintf(error + length, error_size - length, " %s", name);
    }
    return -1;
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
    simd_job *job = state->input;
    char error[PROGRAM_ERROR_SIZE] = "";
    switch (key) {
    case 'v':
        if (parse_variant(argument, &job->variant, error, sizeof error))
            argp_error(state, "-v: %s", error);
        return 0;
    case 'w':
        if (job->word_count == MOST_WORDS)
            argp_error(state, "-w: more than %d words", MOST_WORDS);
        job->words[job->word_count++] = argument;
        return 0;
    case 'r':
        if (program_parse_u32(argument, 1, 100000, &job->repeat, error, sizeof error))
            argp_error(state, "-r: %s", error);
        return 0;
    case 'l': job->lists = true; return 0;
    case ARGP_KEY_ARG: argp_error(state, "no FILE is wanted: %s", argument); return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

/* Words that no table has are errors of the command line, found before anything is printed. */
static bool knows_words(simd_job *job)
{
    for (size_t v = 0; v < VARIANTS; v++)
        for (int wide = 0; wide < 2; wide++) {
            const simd_table *table = wide ? all_tables[v]->wide : all_tables[v]->words;
            for (size_t i = 0; i < table->count; i++)
                is_asked_for(job, table->row[i].word);
        }
    for (size_t i = 0; i < job->word_count; i++)
        if (!job->word_found[i]) {
            program_error("-w: no word %s; --list says which there are", job->words[i]);
            return false;
        }
    return true;
}

static int measure_all(simd_job *job)
{
    const size_t most = SIMD_MOST_SAMPLES(job->repeat);
    int code = PROGRAM_FAILED;
    job->memory = aligned_alloc(alignof(simd_memory), sizeof(simd_memory));
    for (int f = 0; f < 2; f++)
        job->samples[f] = calloc(most, sizeof(double));
    if (job->memory && job->samples[0] && job->samples[1])
        code = do_variants(job);
    else
        program_error("out of memory for %zu samples", most);
    free(job->memory);
    free(job->samples[0]);
    free(job->samples[1]);
    return code;
}

int bench_simd(int argc, char **argv)
{
    static const struct argp parser = {.options = options,
                                       .parser = parse,
                                       .doc = "Times every word of the vocabulary (simd/spu_words.h, "
                                              "simd/vector.h) in every variant that the CPU "
                                              "runs, against a native form written by hand. Rows more than 10 "
                                              "% above native have a reason. Fails "
                                              "where a native form gives another result."};
    simd_job job;
    memset(&job, 0, sizeof job);
    job.repeat = DEFAULT_REPEAT;
    if (argp_parse(&parser, argc, argv, 0, NULL, &job))
        return PROGRAM_USAGE;
    if (!knows_words(&job))
        return PROGRAM_USAGE;
#ifndef __OPTIMIZE__
    program_error("this build is not optimised: the times mean nothing");
#endif
    return measure_all(&job);
}
