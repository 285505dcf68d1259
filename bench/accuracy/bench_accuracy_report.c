/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Tables as tab-separated values and as JSON. */
#include "accuracy/bench_accuracy_report.h"

#include <assert.h>
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/program.h"

struct accuracy_report {
    FILE *json; /* NULL: none */
    const char *path;
    const char *const *columns;
    size_t column; /* of the next cell */
    size_t tables, rows;
};

accuracy_report *accuracy_report_open(const char *json_path)
{
    accuracy_report *report = calloc(1, sizeof *report);
    if (!report) {
        program_error("out of memory");
        return NULL;
    }
    report->path = json_path;
    if (json_path && !(report->json = fopen(json_path, "w"))) {
        program_error("%s: %s", json_path, strerror(errno));
        free(report);
        return NULL;
    }
    if (report->json)
        fputs("{", report->json);
    return report;
}

int accuracy_report_close(accuracy_report *report)
{
    int failed = 0;
    if (report->json) {
        fputs(report->tables ? "\n  ]\n}\n" : "}\n", report->json);
        failed = ferror(report->json) != 0;
        failed |= fclose(report->json) != 0;
        if (failed)
            program_error("%s: the rows could not be written: %s", report->path, strerror(errno));
    }
    free(report);
    return failed ? -1 : 0;
}

static void put_json_text(FILE *json, const char *text)
{
    putc('"', json);
    for (; *text; text++) {
        const unsigned char c = (unsigned char)*text;
        if (c == '"' || c == '\\')
            fprintf(json, "\\%c", c);
        else if (c < 0x20)
            fprintf(json, "\\u%04x", c);
        else
            putc(c, json);
    }
    putc('"', json);
}

void accuracy_report_table(accuracy_report *report, const char *name, const char *const *columns)
{
    assert(report->column == 0); /* the rows before were whole */
    report->columns = columns;
    report->rows = 0;
    if (report->tables)
        printf("#\n# %s\n# ", name);
    for (size_t i = 0; columns[i]; i++)
        printf("%s%c", columns[i], columns[i + 1] ? '\t' : '\n');
    if (report->json) {
        fputs(report->tables ? "\n  ],\n  " : "\n  ", report->json);
        put_json_text(report->json, name);
        fputs(": [", report->json);
    }
    report->tables++;
}

/* What stands before a cell. */
static void begin_cell(accuracy_report *report)
{
    if (report->column)
        putchar('\t');
    else if (report->tables > 1)
        fputs("# ", stdout);
    if (!report->json)
        return;
    if (report->column)
        fputs(", ", report->json);
    else
        fputs(report->rows ? ",\n    {" : "\n    {", report->json);
    put_json_text(report->json, report->columns[report->column]);
    fputs(": ", report->json);
}

static void end_cell(accuracy_report *report)
{
    if (report->columns[++report->column])
        return;
    putchar('\n');
    fflush(stdout);
    if (report->json)
        putc('}', report->json);
    report->column = 0;
    report->rows++;
}

void accuracy_report_text(accuracy_report *report, const char *text)
{
    begin_cell(report);
    for (const char *p = text; *p; p++) /* a file's name may hold what ends a cell */
        putchar((unsigned char)*p < 0x20 ? ' ' : *p);
    if (report->json)
        put_json_text(report->json, text);
    end_cell(report);
}

void accuracy_report_count(accuracy_report *report, uint64_t count)
{
    begin_cell(report);
    printf("%" PRIu64, count);
    if (report->json)
        fprintf(report->json, "%" PRIu64, count);
    end_cell(report);
}

void accuracy_report_real(accuracy_report *report, double number)
{
    begin_cell(report);
    if (isnan(number))
        putchar('-');
    else
        printf("%.6g", number);
    if (report->json)
        isfinite(number) ? fprintf(report->json, "%.9g", number) : fputs("null", report->json);
    end_cell(report);
}
