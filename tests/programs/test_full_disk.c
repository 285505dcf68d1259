/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Disks that are full at some byte of every kind of output, by a limit of the size of files: a program ends with 1 and
 * a sentence that names the file, and no part of it stays. CGT_TEST_SCALE 100 takes every byte. */
#define _GNU_SOURCE
#include "support/suite.h"
#include "support/test.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

typedef struct output {
    const char *program, *file; /* what it writes; "-": standard output */
    const char *argument[12];
    bool grows;      /* a log, which keeps the lines that it has; so does standard output */
    bool needed;     /* else the format may be missing in this build, and takes others long to write */
    uint32_t varies; /* bytes that another run may need less: digits of times */
} output;

#ifdef CGT_RENDER
#define RENDER(name, ...)                                                                                              \
    .program = CGT_RENDER, .file = name, .argument = {"-q", "-s", "16x10", "-t", "1", "one.xyz", __VA_ARGS__}
#endif

static const output outputs[] = {
#ifdef CGT_RENDER
    {RENDER("a.png", "-o", "a.png"), .needed = true},
    {RENDER("sheet.png", "-n", "--contact-sheet=sheet.png"), .needed = true},
    {RENDER("log", "-n", "--log-file=log"), .grows = true, .needed = true, .varies = 5 * 4},
    {RENDER("-", "-o", "-"), .grows = true, .needed = true},
    {RENDER("a.exr", "-o", "a.exr")},
    {RENDER("a.jpg", "-o", "a.jpg")},
    {RENDER("a.tif", "-o", "a.tif")},
    {RENDER("a.gif", "-o", "a.gif")},
    {RENDER("a.mp4", "-o", "a.mp4")},
#endif
#ifdef CGT_CONVERT
    {.program = CGT_CONVERT, .file = "a.frames", .argument = {"-q", "one.xyz", "a.frames"}, .needed = true},
#endif
    {.program = NULL}};

static char folder[] = "full_disk_XXXXXX";

static int enter_folder(void **state)
{
    (void)state;
    if (!mkdtemp(folder) || chdir(folder))
        return -1;
    FILE *const file = fopen("one.xyz", "w");
    return file && fputs("2\n\nC 0 0 0\nO 1 2 0\n", file) >= 0 && !fclose(file) ? 0 : -1;
}

static int leave_folder(void **state)
{
    (void)state;
    return unlink("one.xyz") || chdir("..") || rmdir(folder) ? -1 : 0; /* empty: nothing was left behind */
}

/* Runs a program whose files may have `limit` bytes. Returns its exit code; text gets its errors. */
static int run(const output *o, rlim_t limit, char text[4096])
{
    const char *argument[16] = {o->program};
    int pipes[2], status = -1;
    size_t length = 0;
    memcpy(argument + 1, o->argument, sizeof o->argument);
    assert_int_equal(pipe(pipes), 0);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        const struct rlimit bytes = {limit, limit}, no_core = {0, 0};
        const int out = open(strcmp(o->file, "-") ? "/dev/null" : "-", O_WRONLY | O_CREAT | O_TRUNC, 0600);
        if (out < 0 || dup2(out, 1) < 0 || dup2(pipes[1], 2) < 0 || close(pipes[0]) ||
            setrlimit(RLIMIT_CORE, &no_core) || setrlimit(RLIMIT_FSIZE, &bytes))
            _exit(99);
        execv(o->program, (char **)(uintptr_t)argument);
        _exit(98);
    }
    close(pipes[1]);
    for (ssize_t got; (got = read(pipes[0], text + length, 4095 - length)) > 0;)
        length += (size_t)got;
    text[length] = '\0';
    close(pipes[0]);
    assert_int_equal(waitpid(child, &status, 0), child);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/* The files in the folder beyond the input. */
static unsigned count_files(void)
{
    unsigned files = 0;
    DIR *const all = opendir(".");
    assert_non_null(all);
    for (const struct dirent *entry; (entry = readdir(all));)
        files += entry->d_name[0] != '.' && strcmp(entry->d_name, "one.xyz") != 0;
    closedir(all);
    return files;
}

static void check_full(const output *o, rlim_t limit)
{
    char text[4096];
    const int code = run(o, limit, text);
    const char *const name = strcmp(o->file, "-") ? o->file : "standard output";
    if (code != 1 || !strstr(text, name))
        fail_msg("%s, full at byte %llu: exit code %d: %s", o->file, (unsigned long long)limit, code, text);
    if (o->grows)
        unlink(o->file);
    if (count_files())
        fail_msg("%s, full at byte %llu: a part of it is left", o->file, (unsigned long long)limit);
}

/* The first bytes, the last one, and some between. */
static uint32_t check_every(const output *o, uint32_t size)
{
    test_random r = random_make(size);
    const uint32_t tries = test_scaled(o->needed ? 40 : 6), step = size > tries ? size / tries : 1;
    uint32_t done = 0;
    for (uint32_t at = 0; at < size; done++) {
        check_full(o, at);
        at += at < 4 ? 1 : 1 + random_below(&r, 2 * step - 1);
    }
    check_full(o, size - 1);
    return done + 1;
}

TEST(nothing_half_is_left)
{
    char text[4096];
    uint32_t kinds = 0, total = 0;
    for (const output *o = outputs; o->program; o++) {
        struct stat status;
        const int code = run(o, RLIM_INFINITY, text);
        if (code && !o->needed) {
            print_message("left out: %s", text);
            continue;
        }
        assert_int_equal(code, 0);
        assert_int_equal(stat(o->file, &status), 0);
        assert_int_equal(unlink(o->file), 0);
        const uint32_t size = (uint32_t)status.st_size - o->varies, done = check_every(o, size);
        print_message("%s: %u limits below %u bytes\n", o->file, done, size);
        total += done, kinds++;
    }
    print_message("%u outputs, %u limits\n", kinds, total);
    assert_true(kinds > 0);
}

SEEDED_SUITE("test_full_disk", enter_folder, leave_folder)
