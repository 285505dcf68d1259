/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Tables of cgt-bench: tab-separated values on standard output and, on request, the same rows as JSON, an object with
 * the CPU's name and an array of objects for each section. A cell is given with its column's name: the first row of a
 * section makes the head. Lines of the second section and of later ones begin with "# ", so that a reader that skips
 * comments sees one table. */
#ifndef BENCH_TABLE_H
#define BENCH_TABLE_H

#include <stddef.h>
#include <stdint.h>

typedef struct bench_table bench_table;

/* json_path: NULL for none. Returns NULL, after a message, where the file cannot be written or memory is refused. */
bench_table *bench_table_open(const char *json_path);

/* Ends the tables. The JSON gets its name when it is whole; without a row there is none, and a file of that name stays
 * as it is. Returns 0, or -1 after a message where the JSON could not be written. NULL: does nothing. */
int bench_table_close(bench_table *table);

/* The rows that follow belong to this section. The name must outlive them. */
void bench_table_section(bench_table *table, const char *name);

/* A cell: CELL("config", text), CELL("hits", whole number), CELL("ms", floating-point number). A NaN means "no value":
 * it is printed as "-". JSON has null for values that are not finite. */
typedef struct table_cell {
    const char *column, *text; /* text: NULL for numbers */
    int is_count;
    uint64_t count;
    double real;
} table_cell;

static inline table_cell table_text(const char *column, const char *text)
{
    return (table_cell){column, text, 0, 0, 0};
}
static inline table_cell table_count(const char *column, uint64_t n) { return (table_cell){column, NULL, 1, n, 0}; }
static inline table_cell table_real(const char *column, double x) { return (table_cell){column, NULL, 0, 0, x}; }
#define CELL(column, value)                                                                                            \
    _Generic((value), char *: table_text, const char *: table_text, double: table_real,                 \
             float: table_real, default: table_count)(column, value)

/* Adds the next cells of the row. All rows of a section have the same columns. */
void bench_table_cells(bench_table *table, const table_cell *cell, size_t count);

/* Ends the row, and prints it. */
void bench_table_end_row(bench_table *table);

#define BENCH_CELLS(table, ...)                                                                                        \
    bench_table_cells(table, (const table_cell[]){__VA_ARGS__},                                                        \
                      sizeof((const table_cell[]){__VA_ARGS__}) / sizeof(table_cell))
#define BENCH_ROW(table, ...) (BENCH_CELLS(table, __VA_ARGS__), bench_table_end_row(table))

/* The CPU's name; "" where it is not known. */
const char *bench_cpu_name(void);

#endif
