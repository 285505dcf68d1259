/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bodies of meshes: numbered, closed or open, by indices or by places. */
#include <string.h>

#include "support/suite.h"
#include "support/test.h"
#include <cgt/picture.h>

enum { TETRAHEDRA = 3 };

static const uint32_t faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

/* Some tetrahedra apart from each other, their faces taken in turns. */
static void make(float position[TETRAHEDRA * 4][3], uint32_t index[TETRAHEDRA * 4][3])
{
    for (uint32_t k = 0; k < TETRAHEDRA; k++)
        for (uint32_t i = 0; i < 4; i++)
            for (uint32_t a = 0; a < 3; a++) {
                position[4 * k + i][a] = (float)(10 * k) + (float)(i == a + 1);
                index[TETRAHEDRA * i + k][a] = 4 * k + faces[i][a];
            }
}

TEST(bodies_are_numbered)
{
    float position[TETRAHEDRA * 4][3];
    uint32_t index[TETRAHEDRA * 4][3], body[TETRAHEDRA * 4], bodies;
    uint32_t wrong[3];
    make(position, index);
    assert_int_equal(cgt_find_bodies(index[0], 12, position[0], 12, body, &bodies, wrong), 0);
    assert_int_equal(bodies, TETRAHEDRA);
    for (uint32_t i = 0; i < 12; i++)
        assert_int_equal(body[i], i % TETRAHEDRA);
}

/* The triangles of an STL file share no index. */
TEST(places_are_vertices)
{
    float position[TETRAHEDRA * 4][3], soup[36][3];
    uint32_t index[TETRAHEDRA * 4][3], own[12][3], body[TETRAHEDRA * 4], bodies;
    uint32_t wrong[3];
    make(position, index);
    for (uint32_t i = 0; i < 36; i++) {
        memcpy(soup[i], position[index[i / 3][i % 3]], sizeof soup[i]);
        own[i / 3][i % 3] = i;
    }
    assert_int_equal(cgt_find_bodies(own[0], 12, soup[0], 36, body, &bodies, wrong), 0);
    assert_int_equal(bodies, TETRAHEDRA);
}

TEST(open_ones_are_told)
{
    float position[TETRAHEDRA * 4][3];
    uint32_t index[TETRAHEDRA * 4][3], body[TETRAHEDRA * 4], bodies;
    uint32_t wrong[3];
    make(position, index);
    assert_int_equal(cgt_find_bodies(index[0], 11, position[0], 12, body, &bodies, wrong), 1);
    assert_true(wrong[0] < 11 && wrong[1] < 12 && wrong[2] < 12);
    const uint32_t turned = index[4][1]; /* one face inside out */
    index[4][1] = index[4][2];
    index[4][2] = turned;
    assert_int_equal(cgt_find_bodies(index[0], 12, position[0], 12, body, &bodies, wrong), 1);
    assert_int_equal(cgt_find_bodies(index[0], 0, position[0], 0, body, &bodies, wrong), 0);
    assert_int_equal(bodies, 0);
}

SEEDED_SUITE("test_closed_mesh", NULL, NULL)
