/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Settings files of figures: what is written is read again, what is wrong is named by file and line. */
#define _GNU_SOURCE
#include "support/suite.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cgt/figure.h>

#include "common/settings_file.h"

static const char path[] = "settings_test.txt";

static void write_text(const char *text)
{
    FILE *const file = fopen(path, "wb");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static void expect_read(const char *text, int without_size, const char *lines, const char *others)
{
    char left_out[64], error[300] = "";
    write_text(text);
    char *const got = settings_read_figure(path, without_size, left_out, sizeof left_out, error, sizeof error);
    assert_string_equal(error, "");
    assert_string_equal(got, lines);
    assert_string_equal(left_out, others);
    free(got);
    remove(path);
}

static void expect_error(const char *text, const char *expected)
{
    char left_out[64], error[300] = "";
    write_text(text);
    assert_null(settings_read_figure(path, 0, left_out, sizeof left_out, error, sizeof error));
    if (!strstr(error, expected))
        fail_msg("\"%s\" lacks \"%s\"", error, expected);
    remove(path);
}

TEST(reads)
{
    expect_read("", 0, "", "");
    expect_read(
        "\xEF\xBB\xBF# made by hand\n\n  style=paper  \r\ntransparent\ntype-color =1=red\ntype-color = 2=00ff00", 0,
        "style = paper\ntransparent\ntype-color = 1=red\ntype-color = 2=00ff00\n", "");
    expect_read("size = 64x48\nfirst = 3\nbonds\noutput = a b.png\n", 1, "bonds\n", "first, output");
    expect_read("title = \" two  \"\nbar = \"1\"\n", 0, "title =  two  \n", "bar");
    expect_read("title = \"\" a\"\"\n", 0, "title = \" a\"\n", ""); /* the blanks of a title in quotes */
    expect_read("title = \"a\"\n", 0, "title = \"a\"\n", "");
    expect_read("title = \"\n", 0, "title = \"\n", "");
    expect_read("title = \" \"\n", 0, "title =  \n", "");
    expect_read("size = 64x48\ntitle = # 'a' = \"b\"\n", 0, "size = 64x48\ntitle = # 'a' = \"b\"\n", "");
}

TEST(names_lines)
{
    expect_error("bonds\n\nstyle = papr\n", "settings_test.txt:3: style: \"papr\" is not ");
    expect_error("# 1\ntransparent = 1\n", "settings_test.txt:2: transparent: the option takes no value");
    expect_error("title\n", "settings_test.txt:1: title: the option takes a value");
    expect_error("radius-scale = much\n", "settings_test.txt:1: radius-scale: ");
    expect_error("camera-keys = no_such.keys\n", "settings_test.txt:1: camera-keys: no_such.keys: ");
    char left_out[8], error[300];
    assert_null(settings_read_figure("no_such_file", 0, left_out, sizeof left_out, error, sizeof error));
    assert_non_null(strstr(error, "no_such_file: "));
}

/* A figure's settings go out and come back into another one. */
TEST(writes)
{
    char before[400], after[400], left_out[64], error[300] = "";
    cgt_context *context;
    cgt_figure *one, *two;
    assert_int_equal(cgt_context_create(NULL, &context), CGT_OK);
    assert_int_equal(cgt_figure_create(context, &one), CGT_OK);
    assert_int_equal(cgt_figure_create(context, &two), CGT_OK);
    assert_int_equal(
        cgt_figure_set_lines(one, "style = paper\nbonds\ntype-color = 1=red\ntype-color = 2=blue\ntitle =  \"a \n"
                                  "time = \" {time}\"\nlegend = \"\"\" \"\"\"\n"),
        CGT_OK);
    cgt_figure_get(one, NULL, before, sizeof before);
    assert_int_equal(settings_write(path, before, error, sizeof error), 0);
    char *const lines = settings_read_figure(path, 0, left_out, sizeof left_out, error, sizeof error);
    assert_non_null(lines);
    assert_int_equal(cgt_figure_set_lines(two, lines), CGT_OK);
    cgt_figure_get(two, NULL, after, sizeof after);
    assert_string_equal(before, after);
    free(lines);
    cgt_figure_release(one);
    cgt_figure_release(two);
    cgt_context_release(context);
    remove(path);
    assert_int_equal(settings_write("no_such_folder/file", "", error, sizeof error), -1);
    assert_non_null(strstr(error, "no_such_folder"));
}

SUITE(NULL, NULL)
