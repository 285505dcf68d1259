/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Values of options by rows of a table; see option_row.h. */
#include "options/option_row.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static const char separators[] = ", ";

/* "is not A, B or C". */
static void refuse_word(const char *text, const char *list, char *error, size_t size)
{
    size_t used = (size_t)snprintf(error, size, "\"%.80s\" is not ", text);
    for (const char *between = ""; *list && used < size;) {
        const size_t length = strcspn(list, separators);
        used += (size_t)snprintf(error + used, size - used, "%s%.*s", between, (int)length, list);
        list += length + strspn(list + length, separators);
        between = list[strcspn(list, separators)] ? ", " : " or ";
    }
}

int cgt_option_find(const char *const *names, const char *name, char *error, size_t error_size)
{
    int which = 0;
    while (names[which] && strcmp(name, names[which]) != 0)
        which++;
    if (names[which])
        return which;
    size_t used = (size_t)snprintf(error, error_size, "\"%.80s\" is not ", name);
    for (which = 0; names[which] && used < error_size; which++)
        used += (size_t)snprintf(error + used, error_size - used, "%s%s",
                                 !which             ? ""
                                 : names[which + 1] ? ", "
                                                    : " or ",
                                 names[which]);
    return -1;
}

int cgt_option_next(const char **list, char item[OPTION_ITEM_SIZE])
{
    if (!*list)
        return 0;
    const size_t length = strcspn(*list, ",");
    snprintf(item, OPTION_ITEM_SIZE, "%.*s", length < OPTION_ITEM_SIZE ? (int)length : OPTION_ITEM_SIZE, *list);
    *list = (*list)[length] ? *list + length + 1 : NULL;
    return 1;
}

/* ---- Values ------------------------------------------------------------------------------------------------- */

static int set_word(const option_row *row, const char *text, void *to, char *error, size_t size)
{
    const int word = row->names ? cgt_option_find(row->names, text, error, size) : cgt_find_word(row->words, text);
    if (word < 0) {
        if (!row->names)
            refuse_word(text, row->words, error, size);
        return -1;
    }
    if (row->type == OPTION_NAME)
        *(const char **)to = text;
    else
        *(int *)to = (int)row->first + word;
    return 0;
}

static int set_list(const option_row *row, const char *list, int *chosen, char *error, size_t size)
{
    char item[OPTION_ITEM_SIZE];
    while (cgt_option_next(&list, item)) {
        const int which = cgt_option_find(row->names, item, error, size);
        if (which < 0)
            return -1;
        chosen[which] = 1;
    }
    return 0;
}

static int set_double(const option_row *row, const char *text, double *to, char *error, size_t size)
{
    float value;
    if (cgt_read_float(text, (float)row->low, (float)row->high, &value, error, size))
        return -1;
    *to = (double)value;
    return 0;
}

int cgt_option_set(const option_row *row, const char *text, void *options, char *error, size_t size)
{
    void *const to = (char *)options + row->at;
    if (row->given)
        *(int *)(void *)((char *)options + row->given - 1) = 1;
    if (row->given_bool)
        *(bool *)(void *)((char *)options + row->given_bool - 1) = true;
    if (row->value && !text && !(text = row->otherwise))
        return 0;
    switch (row->type) {
    case OPTION_FLAG: *(int *)to = (int)row->first; return 0;
    case OPTION_BOOL: *(bool *)to = true; return 0;
    case OPTION_TEXT: *(const char **)to = text; return 0;
    case OPTION_WORD:
    case OPTION_NAME: return set_word(row, text, to, error, size);
    case OPTION_LIST: return set_list(row, text, to, error, size);
    case OPTION_FLOAT: return cgt_read_float(text, (float)row->low, (float)row->high, to, error, size);
    case OPTION_DOUBLE: return set_double(row, text, to, error, size);
    case OPTION_U32: return cgt_read_u32(text, (uint32_t)row->first, (uint32_t)row->last, to, error, size);
    case OPTION_U64: return cgt_read_u64(text, row->first, row->last, to, error, size);
    case OPTION_PARSED: return row->parse(text, to, error, size);
    case OPTION_FIGURE: break;
    case OPTION_REFUSED: snprintf(error, size, "%s", row->help); return -1;
    }
    return 0;
}
