/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Text for the readers: numbered lines, words, and numbers parsed exactly as strtof does.
 *   span    a piece of a line: [begin, end)
 *   reader  a file, one line at a time, through a buffer that grows to the longest line
 * The byte at a line's end is zero, so that the C library's functions stop there. Numbers have a decimal point: the
 * programs stay in the C locale. */
#ifndef TEXT_READER_H
#define TEXT_READER_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef struct text_span {
    const char *begin;
    const char *end;
} text_span;

typedef struct text_reader {
    FILE *file;
    /* what there is now, as read(2) does; NULL: fread, which waits for all that it is asked for */
    long (*read_some)(void *input, char *bytes, size_t size);
    void *input;
    const char *why; /* where not "" the reason why reading the file failed; may be NULL */
    char *data;      /* capacity + TEXT_SLACK bytes */
    size_t capacity;
    size_t begin;                 /* the next line starts here */
    size_t end;                   /* bytes in data */
    size_t searched, whole;       /* data up to here has no line feed behind `whole`: the end of the last whole line */
    size_t last_begin, last_zero; /* the last line: its place, and where a zero took the place of last_byte */
    char last_byte;
    uint64_t line; /* number of the last line, from 1 */
    int at_end;    /* the file has no more bytes than those in data */
    int has_feed;  /* the last line ends in a line feed */
    int is_open;   /* the last line has neither a line feed nor a blank at its end: its last word may go on */
} text_reader;

#define TEXT_SLACK 32                       /* bytes after the text that may be read */
#define TEXT_LONGEST_LINE ((size_t)1 << 20) /* bytes; longer lines are not text and must not exhaust memory */

void text_reader_init(text_reader *r, FILE *file);
void text_reader_free(text_reader *r);

/* Forgets what was read; call it after seeking the file to its start. */
void text_reader_restart(text_reader *r);

/* Reads a line without its line feed (or carriage return and line feed): 1 line read, 0 end of the file, -1 error,
 * *reason gets a sentence. The span is valid until the next call. */
int text_reader_next(text_reader *r, text_span *line, const char **reason);

/* Hands out the whole lines that the reader holds from its place on, each with its line feed: none where the next line
 * is not whole. It reads first where nothing is there and, where `wanted` bytes are to be held, as long as fewer than
 * `least` are, which must follow in any case. The caller takes lines by adding to begin and line. 0, or -1: *reason
 * gets a sentence. */
int text_reader_lines(text_reader *r, uint64_t least, size_t wanted, text_span *lines, const char **reason);

/* Gives the last line back: the next call reads it again. Once after each line. */
void text_reader_back(text_reader *r);

/* Removes the next word from the front of text: 1, or 0 where there is none. */
static inline int text_word(text_span *text, text_span *word)
{
    const char *p = text->begin;
    while (p < text->end && (*p == ' ' || (*p >= '\t' && *p <= '\r')))
        p++;
    word->begin = p;
    while (p < text->end && *p != ' ' && !(*p >= '\t' && *p <= '\r'))
        p++;
    word->end = p;
    text->begin = p;
    return word->begin < word->end;
}

static inline size_t text_length(text_span span) { return (size_t)(span.end - span.begin); }

/* Whether the span equals `text`, or begins with it. */
int text_is(text_span span, const char *text);
int text_begins(text_span span, const char *text);

/* Removes blanks from both ends. */
void text_trim(text_span *span);

/* Whether the span holds only blanks. */
int text_is_blank(text_span span);

/* Numbers: the whole word, or 0. Exponents may have Fortran's or Mathematica's marks: 1.5D+01, 1.5-101, 6.3*^-6. NaN
 * and infinity are numbers; too large for a float is infinity, as in strtof. Words must lie in a line of a reader, or
 * have a blank or a zero after them. */
int text_float(text_span word, float *value);
int text_double(text_span word, double *value);
int text_i64(text_span word, int64_t *value);
int text_u64(text_span word, uint64_t max, uint64_t *value);

/* The word for a message: shortened, and without control characters. Returns buffer. */
#define TEXT_QUOTE_SIZE 44
const char *text_quote(text_span word, char buffer[TEXT_QUOTE_SIZE]);

#endif
