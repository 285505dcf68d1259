/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Lines and words. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/text/text_reader.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* ---- Lines -------------------------------------------------------------------------------------------------- */

#define FIRST_CAPACITY ((size_t)1 << 16)

void text_reader_init(text_reader *r, FILE *file)
{
    memset(r, 0, sizeof *r);
    r->file = file;
}

void text_reader_free(text_reader *r)
{
    free(r->data);
    r->data = NULL;
}

void text_reader_restart(text_reader *r)
{
    r->begin = r->end = r->searched = r->whole = 0;
    r->line = 0;
    r->at_end = 0;
    r->is_open = 0;
}

static int grow(text_reader *r, size_t capacity, const char **reason)
{
    char *data = realloc(r->data, capacity + TEXT_SLACK);
    if (data == NULL) {
        *reason = "not enough memory";
        return -1;
    }
    memset(data + capacity, 0, TEXT_SLACK);
    r->data = data;
    r->capacity = capacity;
    return 0;
}

/* Makes room after the buffered bytes: moves them to the front, or grows the buffer. */
static int make_room(text_reader *r, const char **reason)
{
    if (r->begin > 0) {
        memmove(r->data, r->data + r->begin, r->end - r->begin);
        r->end -= r->begin;
        r->whole = r->whole > r->begin ? r->whole - r->begin : 0;
        r->searched = r->searched > r->begin ? r->searched - r->begin : 0;
        r->begin = 0;
    }
    if (r->end < r->capacity)
        return 0;
    if (r->capacity >= TEXT_LONGEST_LINE) {
        r->line++;
        *reason = "the line is longer than 1 MiB: this is not a text file of this kind";
        return -1;
    }
    const size_t capacity = r->capacity == 0 ? FIRST_CAPACITY : 2 * r->capacity;
    return grow(r, capacity, reason);
}

static int read_more(text_reader *r, const char **reason)
{
    if (make_room(r, reason))
        return -1;
    errno = 0;
    const size_t room = r->capacity - r->end;
    const long some = r->read_some != NULL ? r->read_some(r->input, r->data + r->end, room) : 0;
    const size_t got = r->read_some == NULL ? fread(r->data + r->end, 1, room, r->file) : some > 0 ? (size_t)some : 0;
    if (got == 0) {
        if (r->read_some != NULL ? some < 0 : ferror(r->file)) {
            *reason = r->why != NULL && *r->why != '\0' ? r->why : strerror(errno != 0 ? errno : EIO);
            return -1;
        }
        r->at_end = 1;
    }
    r->end += got;
    return 0;
}

int text_reader_next(text_reader *r, text_span *line, const char **reason)
{
    /* Only new bytes are searched, so that a long line costs its length once. */
    size_t searched = 0;
    char *feed = NULL;
    while (1) {
        const size_t start = r->begin + searched;
        if (start < r->end && (feed = memchr(r->data + start, '\n', r->end - start)) != NULL)
            break;
        searched = r->end - r->begin;
        if (r->at_end)
            break;
        if (read_more(r, reason))
            return -1;
    }
    if (feed == NULL && searched == 0)
        return 0;
    const size_t length = feed != NULL ? (size_t)(feed - (r->data + r->begin)) : searched;
    char *begin = r->data + r->begin;
    char *end = begin + length;
    if (r->line == 0 && length >= 3 && memcmp(begin, "\xef\xbb\xbf", 3) == 0)
        begin += 3; /* the mark of UTF-8 that some editors write */
    r->last_begin = r->begin;
    r->begin += length + (feed != NULL);
    r->has_feed = feed != NULL;
    r->is_open = feed == NULL && end > begin && end[-1] != ' ' && !(end[-1] >= '\t' && end[-1] <= '\r');
    if (end > begin && end[-1] == '\r')
        end--;
    r->last_zero = (size_t)(end - r->data);
    r->last_byte = *end;
    *end = '\0';
    r->line++;
    line->begin = begin;
    line->end = end;
    return 1;
}

int text_reader_lines(text_reader *r, uint64_t least, size_t wanted, text_span *lines, const char **reason)
{
    if (wanted > r->capacity && grow(r, wanted, reason))
        return -1;
    if (r->begin == r->end && !r->at_end && read_more(r, reason))
        return -1;
    while (!r->at_end && r->end - r->begin < wanted && r->end - r->begin < least)
        if (read_more(r, reason))
            return -1;
    lines->begin = lines->end = r->data;
    if (r->data == NULL)
        return 0;
    /* Only new bytes are searched: the line that is cut may be as long as all lines before it. */
    for (size_t end = r->end; end > r->searched; end--) {
        if (r->data[end - 1] == '\n') {
            r->whole = end;
            break;
        }
    }
    r->searched = r->end;
    lines->begin = r->data + r->begin;
    lines->end = r->data + (r->whole > r->begin ? r->whole : r->begin);
    return 0;
}

void text_reader_back(text_reader *r)
{
    r->data[r->last_zero] = r->last_byte;
    r->begin = r->last_begin;
    r->line--;
}

/* ---- Words -------------------------------------------------------------------------------------------------- */

int text_is(text_span span, const char *text)
{
    const size_t length = strlen(text);
    return text_length(span) == length && memcmp(span.begin, text, length) == 0;
}

int text_begins(text_span span, const char *text)
{
    const size_t length = strlen(text);
    return text_length(span) >= length && memcmp(span.begin, text, length) == 0;
}

static int is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

void text_trim(text_span *span)
{
    while (span->begin < span->end && is_blank(*span->begin))
        span->begin++;
    while (span->end > span->begin && is_blank(span->end[-1]))
        span->end--;
}

int text_is_blank(text_span span)
{
    text_span word;
    return !text_word(&span, &word);
}

const char *text_quote(text_span word, char buffer[TEXT_QUOTE_SIZE])
{
    const size_t limit = TEXT_QUOTE_SIZE - 4;
    const size_t length = text_length(word);
    const size_t shown = length > limit ? limit : length;
    for (size_t i = 0; i < shown; i++) {
        const char c = word.begin[i];
        buffer[i] = (char)(c >= 0x20 && c < 0x7f ? c : '?');
    }
    strcpy(buffer + shown, length > limit ? "..." : "");
    return buffer;
}
