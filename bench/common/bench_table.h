/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Tables of cgt-bench: tab-separated values on standard output and, on request, the same rows as JSON, an object with
 * an array of objects for each section. A cell is given with its column's name: the first row of a section makes the
 * head. Lines of the second section and of later ones begin with "# ", so that a reader that skips comments sees one
 * table. */
#ifndef BENCH_TABLE_H
#define BENCH_TABLE_H

#include <stdint.h>

typedef struct bench_table bench_table;

/* json_path: NULL for none. Returns NULL, after a message, where the file cannot be written or memory is refused. */
bench_table *bench_table_open(const char *json_path);

/* Ends the tables. The JSON gets its name when it is whole; without a row there is none, and a file of that name stays as
 * it is. Returns 0, or -1 after a message where the JSON could not be written. NULL: does nothing. */
int bench_table_close(bench_table *table);

/* The rows that follow belong to this section. The name must outlive them. */
void bench_table_section(bench_table *table, const char *name);

/* The next cell of the row. All rows of a section have the same columns. A NaN means "no value": it is printed as "-".
 * JSON has null for values that are not finite. */
void bench_table_text(bench_table *table, const char *column, const char *text);
void bench_table_count(bench_table *table, const char *column, uint64_t count);
void bench_table_real(bench_table *table, const char *column, double number);

/* Ends the row, and prints it. */
void bench_table_end_row(bench_table *table);

#endif
