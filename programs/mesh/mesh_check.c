/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Finds what assimp does not notice, or does not survive: truncated files that load as a part of themselves, and counts
 * that would exhaust memory. Only certain damage is refused. */
#define _FILE_OFFSET_BITS 64
#define _POSIX_C_SOURCE 200809L
#include "mesh/mesh_model.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* ---- Object file format ------------------------------------------------------------------------------------- */

/* The counts are on the first line that is no comment, perhaps after "OFF" or the like. Each vertex and each face takes
 * more than a byte. All else is left to assimp. */
static int check_off(cgt_trajectory *t, text_reader *r)
{
    for (int lines = 0; lines < 1000; lines++) {
        text_span line, word;
        const char *reason = "";
        const int result = text_reader_next(r, &line, &reason);
        if (result <= 0)
            return result < 0 ? trajectory_fail(t, r->line, "%s", reason) : 1;
        if (!text_word(&line, &word) || *word.begin == '#' || (word.end[-1] == 'F' && !text_word(&line, &word)))
            continue;
        for (int i = 0; i < 2; i++) {
            uint64_t count = 0;
            if (!text_u64(word, UINT64_MAX, &count))
                return 1;
            if (count > t->file_size)
                return trajectory_fail(t, r->line, "%" PRIu64 " %s cannot lie in %" PRIu64 " bytes", count,
                                       i == 0 ? "vertices" : "faces", t->file_size);
            if (i == 0 && !text_word(&line, &word))
                return 1;
        }
        return 1;
    }
    return 1;
}

/* ---- Industry foundation classes ---------------------------------------------------------------------------- */

/* assimp accepts truncated files. The standard (ISO 10303-21) requires a last line. */
static int check_ifc(cgt_trajectory *t, text_reader *r)
{
    static const char last[] = "END-ISO-10303-21;";
    char tail[1024 + 1] = "";
    const off_t offset = t->file_size > 1024 ? (off_t)(t->file_size - 1024) : 0;
    if (fseeko(r->file, offset, SEEK_SET) != 0)
        return trajectory_fail(t, 0, "%s", strerror(errno));
    size_t size = fread(tail, 1, sizeof tail - 1, r->file);
    for (size_t i = 0; i + sizeof last - 1 <= size; i++)
        if (memcmp(tail + i, last, sizeof last - 1) == 0)
            return 1;
    return trajectory_fail(t, 0, "the file does not end in %s it is cut off", last);
}

/* ---- Text --------------------------------------------------------------------------------------------------- */

/* Notes a text that ends inside a line. Formats whose last line closes something, with } or > or ;, are whole where it
 * is there. A file with control characters near its end is no text. */
static int check_last_line(cgt_trajectory *t)
{
    unsigned char tail[4096];
    const off_t offset = t->file_size > sizeof tail ? (off_t)(t->file_size - sizeof tail) : 0;
    if (fseeko(t->file, offset, SEEK_SET) != 0)
        return trajectory_fail(t, 0, "%s", strerror(errno));
    const size_t size = fread(tail, 1, sizeof tail, t->file);
    for (size_t i = 0; i < size; i++)
        if (tail[i] < ' ' && !(tail[i] >= '\t' && tail[i] <= '\r'))
            return 1;
    size_t end = size;
    while (end > 0 && tail[end - 1] != '\n' && (tail[end - 1] == ' ' || tail[end - 1] < ' '))
        end--;
    if (end > 0 && tail[end - 1] != '\n' && strchr("}])>;", tail[end - 1]) == NULL)
        trajectory_warn_open(t, 0);
    return 1;
}

/* ---- Whole files -------------------------------------------------------------------------------------------- */

int mesh_read_bytes(cgt_trajectory *t, char **bytes, size_t *size)
{
    if (t->file_size > SIZE_MAX - 1 || (*bytes = malloc((size_t)t->file_size + 1)) == NULL)
        return trajectory_fail(t, 0, "not enough memory for %" PRIu64 " bytes", t->file_size);
    *size = fseeko(t->file, 0, SEEK_SET) == 0 ? fread(*bytes, 1, (size_t)t->file_size, t->file) : 0;
    (*bytes)[*size] = '\0';
    if (*size == (size_t)t->file_size)
        return 1;
    free(*bytes);
    return trajectory_fail(t, 0, "%s", strerror(ferror(t->file) ? EIO : errno));
}

/* ---- By ending ---------------------------------------------------------------------------------------------- */

int mesh_check_file(cgt_trajectory *t)
{
    static const struct {
        const char *ending;
        int (*check)(cgt_trajectory *t, text_reader *r);
    } checks[] = {{".ply", mesh_check_ply}, {".off", check_off}, {".ifc", check_ifc}};
    const char *const ending = strrchr(t->path, '.');
    int result = t->regular ? check_last_line(t) : 1;
    if (result < 0 || (t->regular && fseeko(t->file, 0, SEEK_SET) != 0))
        return result < 0 ? -1 : trajectory_fail(t, 0, "%s", strerror(errno));
    for (size_t i = 0; i < sizeof checks / sizeof checks[0]; i++) {
        if (strcasecmp(ending, checks[i].ending) == 0) {
            text_reader reader;
            text_reader_init(&reader, t->file);
            result = checks[i].check(t, &reader);
            text_reader_free(&reader);
        }
    }
    return result;
}
