/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The definitions for bindings: cgt_get_struct_size knows every struct that they define, by its size. */
#include <cgt/all_hits.h>
#include <cgt/bounces.h>
#include <cgt/research.h>

#include "support/suite.h"

#include <stdio.h>
#include <string.h>

TEST(sizes_are_those_of_the_headers)
{
    assert_int_equal(cgt_get_struct_size("cgt_frame"), sizeof(cgt_frame));
    assert_int_equal(cgt_get_struct_size("cgt_spheres"), sizeof(cgt_spheres));
    assert_int_equal(cgt_get_struct_size("cgt_hit_rows"), sizeof(cgt_hit_rows));
    assert_int_equal(cgt_get_struct_size("cgt_bounced_rays"), sizeof(cgt_bounced_rays));
    assert_int_equal(cgt_get_struct_size("cgt_research_trace_options"), sizeof(cgt_research_trace_options));
    assert_int_equal(cgt_get_struct_size("cgt_scene"), 0); /* its size is nobody's business */
    assert_int_equal(cgt_get_struct_size(""), 0);
    assert_int_equal(cgt_get_struct_size(NULL), 0);
}

/* A line "} cgt_name;" of the definitions ends a struct where "typedef struct" began it. */
TEST(every_struct_of_the_definitions_has_a_size)
{
    FILE *file = fopen(CGT_DEFINITIONS, "r");
    char line[400], name[100];
    bool in_struct = false;
    unsigned structs = 0;
    assert_non_null(file);
    while (fgets(line, sizeof line, file)) {
        in_struct = strncmp(line, "typedef", 7) ? in_struct : !strncmp(line, "typedef struct", 14);
        assert_null(strstr(line, "CGT_API"));
        if (in_struct && sscanf(line, "} %90[a-z_];", name) == 1) {
            if (!cgt_get_struct_size(name))
                fail_msg("cgt_get_struct_size does not know %s", name);
            structs++;
        }
    }
    fclose(file);
    assert_in_range(structs, 30, 1000);
}

SUITE(NULL, NULL)
