/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * --help and --usage; see option_help.h. */
#define _POSIX_C_SOURCE 200809L
#include "common/option_help.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 79, WIDEST = 10000, HEADING_AT = 1, LETTER_AT = 2, NAME_AT = 6, TEXT_AT = 29, USAGE_AT = 12 };
enum { ITEM_SIZE = 160 };

const option_row option_standard_rows[OPTION_STANDARD_ROWS] = {
    {"help", '?', NULL, "Give this help list", .group = 0},
    {"usage", 0, NULL, "Give a short usage message", .group = 0},
    {"version", 'V', NULL, "Print program version", .group = 0},
};

/* ---- Lines -------------------------------------------------------------------------------------------------- */

typedef struct shown_row {
    const option_row *row;
    int group; /* of the heading before it */
} shown_row;

typedef struct page {
    FILE *to;
    int width;
    int column;
    shown_row rows[OPTIONS_MOST + OPTION_STANDARD_ROWS]; /* as they are shown */
    size_t count;
} page;

static void indent(page *p, int column)
{
    for (; p->column < column; p->column++)
        fputc(' ', p->to);
}

static void end_line(page *p)
{
    fputc('\n', p->to);
    p->column = 0;
}

static void put(page *p, const char *text, size_t length)
{
    fwrite(text, 1, length, p->to);
    p->column += (int)length;
}

/* How much of a line fits, at least a word; *next: where the rest begins. */
static size_t fitting(const page *p, const char *line, size_t length, size_t *next)
{
    size_t end = p->column < p->width ? (size_t)(p->width - p->column) : 0;
    *next = length;
    if (length < end)
        return length;
    while (end > 0 && line[end] != ' ')
        end--;
    if (end == 0) /* one word that is too long */
        while (end < length && line[end] != ' ')
            end++;
    for (*next = end; *next < length && line[*next] == ' ';)
        ++*next;
    while (end > 0 && line[end - 1] == ' ')
        end--;
    return end;
}

/* Prints a text and ends its last line. Lines that are too long are broken at blanks, and go on at column `at`. */
static void put_text(page *p, const char *text, int at)
{
    for (;;) {
        size_t length = strcspn(text, "\n"), next;
        while (length > 0) {
            put(p, text, fitting(p, text, length, &next));
            text += next;
            length -= next;
            if (length > 0) {
                end_line(p);
                indent(p, at);
            }
        }
        end_line(p);
        if (*text++ == '\0')
            return;
    }
}

/* ---- Order -------------------------------------------------------------------------------------------------- */

static int first_letter(const option_row *row) { return (unsigned char)(row->letter ? row->letter : row->name[0]); }

static int compare_letters(int a, int b) { return tolower(a) != tolower(b) ? tolower(a) - tolower(b) : b - a; }

/* By groups, -1 at the end; the heading, then the options by what is shown first, letters behind names. */
static int compare_rows(const void *left, const void *right)
{
    const shown_row *const a = left, *const b = right;
    if (a->group != b->group)
        return (unsigned)a->group < (unsigned)b->group ? -1 : 1;
    if (!a->row->name || !b->row->name)
        return (a->row->name != NULL) - (b->row->name != NULL);
    const int order = compare_letters(first_letter(a->row), first_letter(b->row));
    if (order)
        return order;
    return !a->row->letter != !b->row->letter ? !b->row->letter - !a->row->letter : strcmp(a->row->name, b->row->name);
}

/* CGT_HELP_WIDTH sets the width of lines. */
static page begin_page(const option_table *table, FILE *to)
{
    page p = {.to = to, .width = WIDTH};
    const char *const width = getenv("CGT_HELP_WIDTH");
    const long wanted = width ? strtol(width, NULL, 10) : 0;
    if (wanted > 0)
        p.width = wanted < WIDTH ? WIDTH : wanted > WIDEST ? WIDEST : (int)wanted;
    for (size_t i = 0, group = 0; i < table->count; i++) {
        group = table->rows[i].name ? group : (size_t)table->rows[i].group;
        if (table->rows[i].type != OPTION_REFUSED)
            p.rows[p.count++] = (shown_row){&table->rows[i], (int)group};
    }
    for (size_t i = 0; i < OPTION_STANDARD_ROWS; i++)
        p.rows[p.count++] = (shown_row){&option_standard_rows[i], -1};
    qsort(p.rows, p.count, sizeof p.rows[0], compare_rows);
    return p;
}

/* ---- Usage -------------------------------------------------------------------------------------------------- */

/* Prints an item of the line of usage, on the next line where it does not fit. */
static void put_item(page *p, const char *item)
{
    if (p->column + (int)strlen(item) + 1 > p->width) {
        end_line(p);
        indent(p, USAGE_AT);
    } else {
        put(p, " ", 1);
    }
    put(p, item, strlen(item));
}

/* The letters of options without a value, letters with a value, and the long names. */
static void put_options(page *p)
{
    char item[ITEM_SIZE] = "[-";
    size_t used = 2;
    for (size_t i = 0; i < p->count; i++)
        if (p->rows[i].row->letter && !p->rows[i].row->value && used < sizeof item - 2)
            item[used++] = p->rows[i].row->letter;
    item[used++] = ']';
    item[used] = '\0';
    put_item(p, item); /* there is -? */
    for (size_t i = 0; i < p->count; i++)
        if (p->rows[i].row->letter && p->rows[i].row->value) {
            snprintf(item, sizeof item, p->rows[i].row->is_optional ? "[-%c[%s]]" : "[-%c %s]", p->rows[i].row->letter,
                     p->rows[i].row->value);
            put_item(p, item);
        }
    for (size_t i = 0; i < p->count; i++)
        if (p->rows[i].row->name) {
            const option_row *const row = p->rows[i].row;
            snprintf(item, sizeof item,
                     !row->value        ? "[--%s]"
                     : row->is_optional ? "[--%s[=%s]]"
                                        : "[--%s=%s]",
                     row->name, row->value);
            put_item(p, item);
        }
}

/* A line for each line of the table's `arguments`; with all options in the first one, or with none. */
static void put_usage(page *p, const option_table *table, const char *program, int with_options)
{
    const char *arguments = table->arguments ? table->arguments : "";
    for (const char *before = "Usage:"; before; before = *arguments ? "  or: " : NULL) {
        put(p, before, strlen(before));
        put(p, " ", 1);
        put(p, program, strlen(program));
        if (with_options)
            put_options(p);
        else
            put_item(p, "[OPTION...]");
        with_options = 0;
        char line[ITEM_SIZE];
        const size_t length = strcspn(arguments, "\n");
        snprintf(line, sizeof line, "%.*s", (int)length, arguments);
        if (length > 0)
            put_item(p, line);
        arguments += length;
        arguments += *arguments == '\n';
        end_line(p);
    }
}

void option_print_usage(const option_table *table, const char *program, FILE *to)
{
    page p = begin_page(table, to);
    put_usage(&p, table, program, 1);
}

void option_print_hint(const char *program, FILE *to)
{
    char text[ITEM_SIZE];
    page p = {.to = to, .width = WIDTH};
    snprintf(text, sizeof text, "Try `%s --help' or `%s --usage' for more information.", program, program);
    put_text(&p, text, 0);
}

/* ---- Help --------------------------------------------------------------------------------------------------- */

static void put_row(page *p, const option_row *row)
{
    char item[ITEM_SIZE];
    if (!row->name) {
        indent(p, HEADING_AT);
        put_text(p, row->help, HEADING_AT);
        return;
    }
    indent(p, LETTER_AT);
    if (row->letter) {
        snprintf(item, sizeof item, "-%c, ", row->letter);
        put(p, item, strlen(item));
    }
    indent(p, NAME_AT);
    snprintf(item, sizeof item,
             !row->value        ? "--%s"
             : row->is_optional ? "--%s[=%s]"
                                : "--%s=%s",
             row->name, row->value);
    put(p, item, strlen(item));
    if (p->column > TEXT_AT + 3)
        end_line(p);
    else if (p->column >= TEXT_AT)
        put(p, "   ", 3);
    indent(p, TEXT_AT);
    put_text(p, row->help, TEXT_AT);
}

void option_print_help(const option_table *table, const char *program, FILE *to)
{
    page p = begin_page(table, to);
    const char *const after = strchr(table->text, '\v');
    int has_headings = 0, has_both = 0;
    put_usage(&p, table, program, 0);
    char *const before = strdup(table->text);
    if (before) {
        before[strcspn(before, "\v")] = '\0';
        put_text(&p, before, 0);
    }
    free(before);
    end_line(&p);
    for (size_t i = 0; i < p.count; i++) {
        has_headings |= !p.rows[i].row->name;
        has_both |= p.rows[i].row->letter && p.rows[i].row->value;
        if (has_headings && i > 0 && p.rows[i].group != p.rows[i - 1].group)
            end_line(&p);
        put_row(&p, p.rows[i].row);
    }
    if (has_both) {
        end_line(&p);
        put_text(&p,
                 "Mandatory or optional arguments to long options are also mandatory or optional for any corresponding "
                 "short options.",
                 0);
    }
    if (after) {
        end_line(&p);
        put_text(&p, after + 1, 0);
    }
}
