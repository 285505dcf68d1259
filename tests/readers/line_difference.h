/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What differs in two texts, line by line. */
#ifndef LINE_DIFFERENCE_H
#define LINE_DIFFERENCE_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Cuts a text into its lines; owned by the caller. */
static inline size_t cut_lines(char *bytes, char ***line)
{
    size_t count = 0;
    for (const char *p = bytes; *p != '\0'; p++)
        count += *p == '\n';
    *line = malloc((count + 1) * sizeof **line);
    if (*line == NULL)
        abort();
    count = 0;
    for (char *p = strtok(bytes, "\n"); p != NULL; p = strtok(NULL, "\n")) /* there are no blank lines */
        (*line)[count++] = p;
    return count;
}

/* How many lines stand in one text alone before both go on alike: as few as possible in both together. */
static inline void find_equal(char *const *left, size_t lefts, char *const *right, size_t rights, size_t gone[2])
{
    for (size_t sum = 1; sum <= lefts + rights; sum++)
        for (size_t i = sum > rights ? sum - rights : 0; i <= sum && i <= lefts; i++) {
            const size_t k = sum - i;
            gone[0] = i;
            gone[1] = k;
            if (i < lefts && k < rights ? strcmp(left[i], right[k]) == 0 : i == lefts && k == rights)
                return;
        }
}

/* Prints the lines that differ, below the last line before them that begins with "== ". Cuts both texts. */
static inline void print_difference(char *expected, char *got)
{
    enum { MOST_LINES = 200 };
    char **left, **right;
    const char *file = NULL, *last = NULL;
    const size_t lefts = cut_lines(expected, &left), rights = cut_lines(got, &right);
    int lines = 0;
    for (size_t i = 0, k = 0; (i < lefts || k < rights) && lines < MOST_LINES;) {
        size_t gone[2] = {0, 0};
        if (i < lefts && k < rights && strcmp(left[i], right[k]) == 0) {
            file = strncmp(right[k], "== ", 3) == 0 ? right[k] : file;
            i++;
            k++;
            continue;
        }
        find_equal(left + i, lefts - i, right + k, rights - k, gone);
        if (file != last)
            printf("%s\n", file);
        last = file;
        for (size_t n = 0; n < gone[0]; n++, lines++)
            printf("- %s\n", left[i++]);
        for (size_t n = 0; n < gone[1]; n++, lines++)
            printf("+ %s\n", right[k++]);
    }
    if (lines >= MOST_LINES)
        printf("...\n");
    free(left);
    free(right);
}

#endif
