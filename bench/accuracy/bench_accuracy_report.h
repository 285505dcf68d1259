/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Tables of cgt-bench accuracy, printed cell by cell: tab-separated values on standard output and, on request, the same
 * rows as JSON, an object with an array of objects for each table. Only the first table's lines do not begin with "# ",
 * so that the output is one table to whoever skips comments. */
#ifndef BENCH_ACCURACY_REPORT_H
#define BENCH_ACCURACY_REPORT_H

#include <stddef.h>
#include <stdint.h>

typedef struct accuracy_report accuracy_report;

/* json_path: NULL for none. NULL with a message where the file cannot be written or memory is refused. */
accuracy_report *accuracy_report_open(const char *json_path);

/* 0, or -1 with a message where the JSON could not be written. */
int accuracy_report_close(accuracy_report *report);

/* Begins a table; columns ends with NULL and stays valid until the next one. */
void accuracy_report_table(accuracy_report *report, const char *name, const char *const *columns);

/* The next cell of the row; the row ends with the last column. A NaN, no value, is printed as "-"; in JSON whatever is
 * not finite is null. */
void accuracy_report_text(accuracy_report *report, const char *text);
void accuracy_report_count(accuracy_report *report, uint64_t count);
void accuracy_report_real(accuracy_report *report, double number);

#endif
