/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Inputs: plain files are read by stdio alone; all others through a stream of our own, whose bytes come from a
 * descriptor, perhaps by way of libarchive, and go to a temporary file where they must be read again. */
#define _FILE_OFFSET_BITS 64
#define _POSIX_C_SOURCE 200809L
#include "trajectory/trajectory_input.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "system/system.h"

#ifdef CGT_HAVE_ARCHIVE
#include <archive.h>
#include <archive_entry.h>
#endif

/* ---- What compresses ---------------------------------------------------------------------------------------- */

/* How to ask libarchive for the part that unpacks it. */
#ifdef CGT_HAVE_ARCHIVE
#define FILTER(ask) ask
#else
#define FILTER(ask) NULL
#endif

typedef struct compression {
    const char *ending;
    const char *name;
    size_t size;
    unsigned char magic[INPUT_HEAD];
    int (*ask)(struct archive *archive);
} compression;

static const compression compressions[] = {
    {".gz", "gzip", 2, {0x1f, 0x8b}, FILTER(archive_read_support_filter_gzip)},
    {".zst", "Zstandard", 4, {0x28, 0xb5, 0x2f, 0xfd}, FILTER(archive_read_support_filter_zstd)},
    {".xz", "xz", 6, {0xfd, '7', 'z', 'X', 'Z', 0}, FILTER(archive_read_support_filter_xz)},
    {".bz2", "bzip2", 3, {'B', 'Z', 'h'}, FILTER(archive_read_support_filter_bzip2)},
    {".lz4", "LZ4", 4, {0x04, 0x22, 0x4d, 0x18}, FILTER(archive_read_support_filter_lz4)},
};
enum { COMPRESSIONS = sizeof compressions / sizeof compressions[0] };

size_t trajectory_input_bare_length(const char *path)
{
    const size_t length = strlen(path);
    for (size_t i = 0; i < COMPRESSIONS; i++) {
        const size_t ending = strlen(compressions[i].ending);
        if (length > ending && strcasecmp(path + length - ending, compressions[i].ending) == 0)
            return length - ending;
    }
    return length;
}

static const compression *find_compression(const trajectory_input *in)
{
    for (size_t i = 0; i < COMPRESSIONS; i++) {
        const compression *const c = &compressions[i];
        if (in->head_size >= c->size && memcmp(in->head, c->magic, c->size) == 0)
            return c;
    }
    return NULL;
}

int trajectory_input_is_blown_up(uint64_t read, uint64_t made)
{
    return made > (uint64_t)1 << 30 && made / INPUT_MOST_TIMES > read;
}

int trajectory_input_is_beside(const char *input, const char *path)
{
    const char *const slash = strrchr(input, '/');
    const size_t folder = slash != NULL ? (size_t)(slash + 1 - input) : 0;
    if (strcmp(path, input) == 0)
        return 1;
    if (strncmp(path, input, folder) != 0 || path[folder] == '/')
        return 0;
    for (const char *part = path + folder; *part != '\0'; part += strspn(part, "/")) {
        const size_t length = strcspn(part, "/");
        if (length == 2 && strncmp(part, "..", 2) == 0)
            return 0;
        part += length;
    }
    return 1;
}

/* ---- Bytes of the descriptor -------------------------------------------------------------------------------- */

static int is_stopped(const trajectory_input *in) { return in->stop != NULL && in->stop(in->stop_user); }

/* Waits for a twentieth of a second. Returns 0 where waiting has to end. */
static int wait_for_more(const trajectory_input *in, double *waited)
{
    const struct timespec pause = {0, 50000000};
    if (!(*waited < in->follow) || is_stopped(in))
        return 0;
    nanosleep(&pause, NULL);
    *waited += 0.05;
    return 1;
}

/* Whether a file that is followed is shorter than what was read of it: another run has begun to write it, and what
 * comes to stand here does not go on from there. */
static int was_cut(trajectory_input *in)
{
    struct stat status;
    const off_t at = in->follow > 0.0 ? lseek(in->descriptor, 0, SEEK_CUR) : 0;
    if (at <= 0 || fstat(in->descriptor, &status) != 0 || status.st_size >= at)
        return 0;
    snprintf(in->error, sizeof in->error, "the file became shorter while it was followed");
    errno = EIO;
    return 1;
}

/* As read(2), beginning with the head; at the end of a file that is followed it waits. */
static ssize_t read_raw(trajectory_input *in, void *bytes, size_t size)
{
    if (in->head_at < in->head_size) {
        const size_t left = in->head_size - in->head_at;
        const size_t count = size < left ? size : left;
        memcpy(bytes, in->head + in->head_at, count);
        in->head_at += count;
        return (ssize_t)count;
    }
    double waited = 0.0;
    ssize_t got;
    do {
        got = read(in->descriptor, bytes, size);
        if (got == 0 && was_cut(in))
            return -1;
    } while ((got == 0 && wait_for_more(in, &waited)) || (got < 0 && errno == EINTR && !is_stopped(in)));
    return got;
}

static int read_head(trajectory_input *in)
{
    while (in->head_size < INPUT_HEAD) {
        const ssize_t got = read(in->descriptor, in->head + in->head_size, INPUT_HEAD - in->head_size);
        if (got < 0)
            return -1;
        if (got == 0)
            break;
        in->head_size += (size_t)got;
    }
    return 0;
}

/* ---- Decompression ------------------------------------------------------------------------------------------ */

#ifdef CGT_HAVE_ARCHIVE
static la_ssize_t give_block(struct archive *archive, void *client, const void **block)
{
    trajectory_input *const in = client;
    const ssize_t got = read_raw(in, in->block, INPUT_BLOCK);
    *block = in->block;
    in->packed += got > 0 ? (uint64_t)got : 0;
    if (got < 0)
        archive_set_error(archive, errno, "%s", strerror(errno));
    return got;
}

static int fail_archive(trajectory_input *in)
{
    const char *reason = archive_error_string(in->archive);
    snprintf(in->error, sizeof in->error, "cannot be decompressed: %s", reason != NULL ? reason : "damaged");
    errno = EIO;
    return -1;
}

/* Asks for what the first bytes call for, and nothing else. libarchive starts programs for some formats, and for those
 * that it was built without: a file must not start anything. */
static int choose_filter(trajectory_input *in)
{
    const compression *const packed = find_compression(in);
    if (packed->ask(in->archive) == ARCHIVE_OK)
        return 1;
    snprintf(in->error, sizeof in->error, "compressed by %s, which this build's libarchive cannot read", packed->name);
    errno = EIO;
    return -1;
}

/* Begins to decompress: 1, 0 where nothing is in it, -1. */
static int begin_archive(trajectory_input *in)
{
    struct archive_entry *entry;
    in->archive = archive_read_new();
    if (in->archive == NULL || (in->block == NULL && (in->block = malloc(INPUT_BLOCK)) == NULL)) {
        errno = ENOMEM;
        return -1;
    }
    if (choose_filter(in) < 0)
        return -1;
    archive_read_support_format_raw(in->archive);
    archive_read_support_format_empty(in->archive);
    if (archive_read_open(in->archive, in, NULL, give_block, NULL) != ARCHIVE_OK)
        return fail_archive(in);
    const int status = archive_read_next_header(in->archive, &entry);
    if (archive_filter_count(in->archive) > 2) { /* the last is none */
        snprintf(in->error, sizeof in->error, "compressed twice: only one layer is unpacked");
        errno = EIO;
        return -1;
    }
    return status == ARCHIVE_EOF ? 0 : status == ARCHIVE_OK || status == ARCHIVE_WARN ? 1 : fail_archive(in);
}

static ssize_t read_archive(trajectory_input *in, void *bytes, size_t size)
{
    if (in->archive == NULL) {
        const int status = begin_archive(in);
        if (status <= 0)
            return status;
    }
    const la_ssize_t got = archive_read_data(in->archive, bytes, size);
    in->unpacked += got > 0 ? (uint64_t)got : 0;
    if (!in->no_limit && trajectory_input_is_blown_up(in->packed, in->unpacked)) {
        snprintf(in->error, sizeof in->error, "a small file unpacks to " INPUT_BLOWN_UP, INPUT_MOST_TIMES);
        errno = EIO;
        return -1;
    }
    return got < 0 ? fail_archive(in) : got;
}

static void end_archive(trajectory_input *in)
{
    archive_read_free(in->archive);
    in->archive = NULL;
    in->packed = in->unpacked = 0;
}
#else
static ssize_t read_archive(trajectory_input *in, void *bytes, size_t size)
{
    (void)in, (void)bytes, (void)size;
    errno = EIO;
    return -1;
}

static void end_archive(trajectory_input *in) { in->archive = NULL; }
#endif

/* ---- The stream --------------------------------------------------------------------------------------------- */

static ssize_t read_source(trajectory_input *in, void *bytes, size_t size)
{
    if (in->peeked_at < in->peeked_size) {
        const size_t left = in->peeked_size - in->peeked_at, count = size < left ? size : left;
        memcpy(bytes, in->peeked + in->peeked_at, count);
        in->peeked_at += count;
        return (ssize_t)count;
    }
    return in->is_compressed ? read_archive(in, bytes, size) : read_raw(in, bytes, size);
}

static long fail_spool(trajectory_input *in)
{
    snprintf(in->error, sizeof in->error, "the temporary file that keeps the input: %s", strerror(errno));
    return -1;
}

long trajectory_input_read(void *input, char *bytes, size_t size)
{
    trajectory_input *const in = input;
    if (in->spool != NULL && in->replayed < in->spooled) {
        const uint64_t left = in->spooled - in->replayed;
        const size_t count = fread(bytes, 1, size < left ? size : (size_t)left, in->spool);
        in->replayed += count;
        return count > 0 ? (long)count : fail_spool(in);
    }
    const ssize_t got = read_source(in, bytes, size);
    if (got > 0 && in->spool != NULL) {
        /* between reading and writing a stream must be positioned */
        if (fseeko(in->spool, 0, SEEK_END) != 0 || fwrite(bytes, 1, (size_t)got, in->spool) != (size_t)got)
            return fail_spool(in);
        in->spooled += (uint64_t)got;
        in->replayed = in->spooled;
    }
    return (long)got;
}

long trajectory_input_peek(trajectory_input *in, char *bytes, size_t size)
{
    size_t count = 0;
    ssize_t got = 1;
    if (in->plain) {
        count = fread(bytes, 1, size, in->stream);
        return fseeko(in->stream, 0, SEEK_SET) == 0 ? (long)count : -1;
    }
    while (count < size && got > 0) {
        got = read_source(in, bytes + count, size - count);
        count += got > 0 ? (size_t)got : 0;
    }
    in->peeked = got >= 0 ? malloc(count + 1) : NULL;
    if (in->peeked == NULL)
        return -1;
    memcpy(in->peeked, bytes, count);
    in->peeked_size = count;
    in->peeked_at = 0;
    return (long)count;
}

static int open_stream(trajectory_input *in)
{
    in->stream = in->plain ? fdopen(in->descriptor, "rb") : system_open_reader(trajectory_input_read, in);
    return in->stream != NULL || (!in->plain && errno == ENOSYS) ? 0 : -1;
}

/* Decides how to read. Returns NULL or a sentence. */
static const char *choose_way(trajectory_input *in, int keep, char *text, size_t size)
{
    if (read_head(in))
        return strerror(errno);
    const compression *const packed = find_compression(in);
    in->is_compressed = packed != NULL;
#ifndef CGT_HAVE_ARCHIVE
    if (packed != NULL) {
        snprintf(text, size, "compressed by %s, which this build cannot read: it has no libarchive", packed->name);
        return text;
    }
#else
    (void)text, (void)size;
#endif
    in->can_rewind = in->is_regular;
    in->plain = in->is_regular && !in->is_compressed && in->follow == 0.0;
    if (in->plain) {
        in->head_size = 0;
        return lseek(in->descriptor, 0, SEEK_SET) == 0 ? NULL : strerror(errno);
    }
    if (!in->is_regular && keep) {
        in->spool = system_temporary();
        in->can_rewind = in->spool != NULL;
        return in->spool != NULL ? NULL : strerror(errno);
    }
    return NULL;
}

static const char *open_descriptor(trajectory_input *in, const char *path)
{
    struct stat status;
    const int is_standard = strcmp(path, "-") == 0;
    in->descriptor = is_standard ? dup(STDIN_FILENO) : open(path, O_RDONLY | O_BINARY | O_CLOEXEC);
    if (in->descriptor < 0 || fstat(in->descriptor, &status) != 0)
        return strerror(errno);
    if (S_ISDIR(status.st_mode))
        return strerror(EISDIR);
    in->is_regular = S_ISREG(status.st_mode) && !is_standard;
    in->file_size = in->is_regular ? (uint64_t)status.st_size : 0;
    return NULL;
}

int trajectory_input_open(trajectory_input *in, const char *path, double follow, const cgt_trajectory_options *options,
                          char *error, size_t error_size)
{
    memset(in, 0, sizeof *in);
    in->descriptor = -1;
    in->follow = follow;
    in->stop = options->stop;
    in->stop_user = options->stop_user;
    in->no_limit = options->no_limit;
    const char *reason = open_descriptor(in, path);
    reason = reason != NULL ? reason : choose_way(in, options->keep, in->error, sizeof in->error);
    reason = reason != NULL || open_stream(in) == 0 ? reason : strerror(errno);
    if (reason != NULL) {
        snprintf(error, error_size, "%s", reason);
        trajectory_input_close(in);
        return -1;
    }
    return 0;
}

int trajectory_input_rewind(trajectory_input *in, char *error, size_t error_size)
{
    const char *reason = NULL;
    in->error[0] = '\0';
    if (!in->can_rewind) {
        reason = "cannot go back to the first frame: not a regular file";
    } else if (in->plain) {
        clearerr(in->stream);
        reason = fseeko(in->stream, 0, SEEK_SET) != 0 ? strerror(errno) : NULL;
    } else {
        if (in->stream != NULL)
            fclose(in->stream);
        in->stream = NULL;
        in->replayed = 0;
        if (in->spool != NULL) {
            reason = fseeko(in->spool, 0, SEEK_SET) != 0 ? strerror(errno) : NULL;
        } else {
            end_archive(in);
            in->peeked_at = in->peeked_size = 0;
            in->head_at = in->head_size;
            reason = lseek(in->descriptor, 0, SEEK_SET) != 0 ? strerror(errno) : NULL;
        }
        reason = open_stream(in) != 0 ? strerror(errno) : reason;
    }
    if (reason != NULL)
        snprintf(error, error_size, "%s", reason);
    return reason != NULL ? -1 : 0;
}

double trajectory_input_progress(const trajectory_input *in, uint64_t buffered)
{
    if (!in->is_regular || in->file_size == 0 || (in->plain && in->stream == NULL))
        return -1.0;
    /* bytes in the line buffer are not used yet; of a compressed file it is not known how many those were */
    const off_t offset = in->plain ? ftello(in->stream) : lseek(in->descriptor, 0, SEEK_CUR);
    if (offset < 0)
        return -1.0;
    const double used = in->is_compressed ? (double)offset : (double)offset - (double)buffered;
    const double share = used / (double)in->file_size;
    return share > 1.0 ? 1.0 : share < 0.0 ? 0.0 : share;
}

void trajectory_input_close(trajectory_input *in)
{
    end_archive(in);
    if (in->stream != NULL)
        fclose(in->stream);
    if (in->descriptor >= 0 && !(in->plain && in->stream != NULL))
        close(in->descriptor);
    if (in->spool != NULL)
        fclose(in->spool);
    free(in->block);
    free(in->peeked);
    in->peeked = NULL;
    in->peeked_at = in->peeked_size = 0;
    in->stream = in->spool = NULL;
    in->block = NULL;
    in->descriptor = -1;
}
