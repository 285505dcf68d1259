/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Collects a row cell by cell and prints it, below the section's head where it is the first one. */
#include "common/bench_table.h"

#include <assert.h>
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/out_file.h"
#include "common/program.h"

enum { HEAD_SIZE = 4096, ROW_SIZE = 16384 };

struct bench_table {
    FILE *json; /* NULL: none */
    const char *path;
    out_file file;
    const char *section;
    size_t sections, rows; /* sections with rows; rows of the current one */
    char head[HEAD_SIZE], row[ROW_SIZE];
};

const char *bench_cpu_name(void)
{
    static char name[128];
    char line[256], *colon;
    FILE *file = name[0] ? NULL : fopen("/proc/cpuinfo", "r");
    while (file && !name[0] && fgets(line, sizeof line, file))
        if (!strncmp(line, "model name", 10) && (colon = strstr(line, ": ")) != NULL)
            snprintf(name, sizeof name, "%.*s", (int)strcspn(colon + 2, "\n"), colon + 2);
    if (file)
        fclose(file);
    return name;
}

static void write_json_text(FILE *json, const char *text)
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

/* Returns 0, or -1 after a message. */
static int open_json(bench_table *table)
{
    char error[PROGRAM_ERROR_SIZE], ignored[PROGRAM_ERROR_SIZE];
    const char *temporary = out_file_begin(&table->file, table->path, error, sizeof error);
    if (!temporary) {
        program_error("%s", error);
        return -1;
    }
    table->json = fopen(temporary, "w");
    if (!table->json) {
        program_error("%s: %s", table->path, strerror(errno));
        out_file_end(&table->file, 0, ignored, sizeof ignored);
        return -1;
    }
    fputs("{\n  \"cpu\": ", table->json);
    write_json_text(table->json, bench_cpu_name());
    return 0;
}

bench_table *bench_table_open(const char *json_path)
{
    bench_table *table = calloc(1, sizeof *table);
    if (!table) {
        program_error("out of memory");
        return NULL;
    }
    table->path = json_path;
    if (json_path && open_json(table)) {
        free(table);
        return NULL;
    }
    return table;
}

/* Returns 0, or -1 after a message. */
static int close_json(bench_table *table)
{
    char error[PROGRAM_ERROR_SIZE];
    if (table->sections)
        fputs("\n  ]\n}\n", table->json);
    int failed = ferror(table->json) != 0;
    failed |= fclose(table->json) != 0;
    if (failed)
        program_error("%s: the rows could not be written: %s", table->path, strerror(errno));
    const int keep = !failed && table->sections;
    if (out_file_end(&table->file, keep, error, sizeof error)) {
        program_error("%s", error);
        failed = 1;
    }
    return failed ? -1 : 0;
}

int bench_table_close(bench_table *table)
{
    const int failed = table && table->json && close_json(table);
    free(table);
    return failed ? -1 : 0;
}

void bench_table_section(bench_table *table, const char *name)
{
    assert(!table->row[0]); /* no row is half done */
    if (table->section && !strcmp(table->section, name))
        return;
    table->section = name;
    table->rows = 0;
    table->head[0] = '\0';
}

/* What precedes the first cell of a row in the JSON. */
static void begin_json_row(bench_table *table)
{
    if (!table->rows) {
        fputs(table->sections ? "\n  ],\n  " : ",\n  ", table->json);
        write_json_text(table->json, table->section);
        fputs(": [", table->json);
    }
    fputs(table->rows ? ",\n    {" : "\n    {", table->json);
}

static void append(char *line, size_t size, const char *text)
{
    const size_t length = strlen(line);
    snprintf(line + length, size - length, "%s%s", length ? "\t" : "", text);
}

/* A cell: its text, and what JSON calls it; NULL: the text in quotes. */
static void add_cell(bench_table *table, const char *column, const char *text, const char *json)
{
    if (table->json) {
        table->row[0] ? (void)fputs(", ", table->json) : begin_json_row(table);
        write_json_text(table->json, column);
        fputs(": ", table->json);
        json ? (void)fputs(json, table->json) : write_json_text(table->json, text);
    }
    if (!table->rows)
        append(table->head, HEAD_SIZE, column);
    append(table->row, ROW_SIZE, text[0] ? text : " ");
}

static void add_text(bench_table *table, const char *column, const char *text)
{
    char clean[1024];
    snprintf(clean, sizeof clean, "%s", text);
    for (char *c = clean; *c; c++) /* the name of a file may hold what ends a cell */
        if ((unsigned char)*c < 0x20)
            *c = ' ';
    add_cell(table, column, clean, NULL);
}

static void add_real(bench_table *table, const char *column, double number)
{
    char text[32], json[32];
    snprintf(text, sizeof text, "%.6g", number);
    snprintf(json, sizeof json, "%.9g", number);
    add_cell(table, column, isnan(number) ? "-" : text, isfinite(number) ? json : "null");
}

void bench_table_cells(bench_table *table, const table_cell *cell, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        char text[24];
        snprintf(text, sizeof text, "%" PRIu64, cell[i].count);
        if (cell[i].text)
            add_text(table, cell[i].column, cell[i].text);
        else if (cell[i].is_count)
            add_cell(table, cell[i].column, text, text);
        else
            add_real(table, cell[i].column, cell[i].real);
    }
}

void bench_table_end_row(bench_table *table)
{
    const char *comment = table->sections + !table->rows > 1 ? "# " : "";
    if (!table->rows && *comment)
        printf("#\n# %s\n", table->section);
    if (!table->rows)
        printf("%s%s\n", comment, table->head);
    printf("%s%s\n", comment, table->row);
    fflush(stdout);
    if (table->json)
        putc('}', table->json);
    table->sections += !table->rows;
    table->rows++;
    table->row[0] = '\0';
}
