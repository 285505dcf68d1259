/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Output files that are whole or not there: signals, links, targets that are no files. */
#define _GNU_SOURCE
#include "support/suite.h"
#include "support/test.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/out_file.h"

static char folder[] = "out_file_XXXXXX";

static int enter_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) && chdir(folder) == 0 ? 0 : -1;
}

static int leave_folder(void **state)
{
    (void)state;
    return chdir("..") == 0 && rmdir(folder) == 0 ? 0 : -1; /* empty: nothing was left behind */
}

static void write_file(const char *name, const char *text)
{
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static void expect_file(const char *name, const char *expected)
{
    char text[64] = "";
    FILE *file = fopen(name, "rb");
    assert_non_null(file);
    const size_t length = fread(text, 1, sizeof text - 1, file);
    fclose(file);
    text[length] = '\0';
    assert_string_equal(text, expected);
}

static int replace(const char *name, const char *text, char error[300])
{
    out_file file;
    const char *temporary = out_file_begin(&file, name, error, 300);
    if (!temporary)
        return -1;
    write_file(temporary, text);
    return out_file_end(&file, 1, error, 300);
}

/* ---- signals ---- */

/* In a child: begins a file and sends itself the signals. */
static void raise_in_child(const int *signals, int count, stop_flag *stop)
{
    out_file file;
    char error[300];
    const struct rlimit no_core = {0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    for (int number = 1; number < 32; number++)
        signal(number, SIG_DFL);
    out_file_catch_signals(stop);
    if (!out_file_begin(&file, "unfinished", error, sizeof error))
        _exit(100);
    for (int i = 0; i < count; i++)
        raise(signals[i]);
    out_file_end(&file, 0, error, sizeof error);
    _exit(stop && *stop ? 1 : 0);
}

static int status_of(const int *signals, int count, stop_flag *stop)
{
    int status = 0;
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0)
        raise_in_child(signals, count, stop);
    assert_int_equal(waitpid(child, &status, 0), child);
    return status;
}

TEST(signals_leave_nothing_behind)
{
    static const int number[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};
    static stop_flag stop;
    for (size_t i = 0; i < TEST_COUNT(number); i++) {
        const int twice[] = {number[i], number[i]};
        int status = status_of(twice, 1, NULL);
        assert_true(WIFSIGNALED(status) && WTERMSIG(status) == number[i]);
        status = status_of(twice, 2, &stop); /* the second one ends the program */
        assert_true(WIFSIGNALED(status) && WTERMSIG(status) == number[i]);
        status = status_of(twice, 1, &stop);
        assert_true(number[i] == SIGQUIT ? WIFSIGNALED(status) : WIFEXITED(status) && WEXITSTATUS(status) == 1);
    }
    const int limit[] = {SIGXFSZ};
    const int status = status_of(limit, 1, NULL);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

/* ---- targets ---- */

TEST(links_stay_links)
{
    struct stat status;
    char error[300];
    write_file("file", "old");
    assert_int_equal(chmod("file", 0640), 0);
    assert_int_equal(mkdir("far", 0777), 0);
    assert_int_equal(symlink("file", "link"), 0);
    assert_int_equal(symlink("../link", "far/chain"), 0);
    assert_int_equal(symlink("far/new", "early"), 0);
    assert_int_equal(replace("far/chain", "one", error), 0);
    expect_file("file", "one");
    assert_int_equal(lstat("file", &status), 0);
    assert_int_equal(status.st_mode & 07777, 0640);
    assert_int_equal(replace("early", "two", error), 0);
    expect_file("far/new", "two");
    static const char *const links[] = {"link", "far/chain", "early"};
    for (size_t i = 0; i < TEST_COUNT(links); i++) {
        assert_int_equal(lstat(links[i], &status), 0);
        assert_true(S_ISLNK(status.st_mode));
        unlink(links[i]);
    }
    unlink("file");
    unlink("far/new");
    rmdir("far");
}

TEST(what_is_no_file_is_refused)
{
    char error[300];
    assert_int_equal(symlink("loop", "loop"), 0);
    assert_int_equal(mkdir("folder", 0777), 0);
    assert_int_equal(replace("loop", "", error), -1);
    assert_string_equal(error, "loop: cannot write: the symbolic links are too many or too long");
    assert_int_equal(replace("folder", "", error), -1);
    assert_string_equal(error, "folder: cannot write: not a regular file");
    assert_int_equal(replace("missing/file", "", error), -1);
    assert_string_equal(error, "missing/file: cannot write: No such file or directory");
    unlink("loop");
    rmdir("folder");
}

SEEDED_SUITE("test_out_file", enter_folder, leave_folder)
