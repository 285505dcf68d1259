/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Parts of cgt-bench structures: the memories that count transfers, against plain implementations; the walk through a
 * kd-tree small enough to follow by hand; and the comparison, which must find every differing bit. */
#include "support/test.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "structures/structures_cache.h"
#include "structures/structures_found.h"
#include "structures/structures_walk.h"

/* ---- Memories ------------------------------------------------------------------------------------------------ */

enum { NODES = 20001, MOST_BLOCKS = 256 };

/* A memory of blocks, each with the time of its last use. */
typedef struct plain {
    uint32_t block[MOST_BLOCKS];
    uint64_t used[MOST_BLOCKS]; /* 0: empty */
    uint64_t time, misses;
} plain;

static void read_lru(plain *m, uint32_t blocks, uint32_t block)
{
    uint32_t oldest = 0;
    m->time++;
    for (uint32_t i = 0; i < blocks; i++) {
        if (m->used[i] && m->block[i] == block) {
            m->used[i] = m->time;
            return;
        }
        if (m->used[i] < m->used[oldest])
            oldest = i;
    }
    m->misses++;
    m->block[oldest] = block;
    m->used[oldest] = m->time;
}

static void read_direct(plain *m, uint32_t blocks, uint32_t block)
{
    const uint32_t i = block % blocks;
    if (m->used[i] && m->block[i] == block)
        return;
    m->misses++;
    m->block[i] = block;
    m->used[i] = 1;
}

/* Nodes as a traversal reads them, from the root down, mostly near the last ones. */
static uint32_t *make_reads(test_random *r, uint32_t count)
{
    uint32_t *reads = test_malloc(count * sizeof *reads);
    uint32_t at = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (random_below(r, 20) == 0)
            at = random_below(r, 2) ? 0 : random_below(r, NODES);
        else
            at = (at + random_below(r, 12)) % NODES;
        reads[i] = at;
    }
    return reads;
}

static uint64_t misses_of(const cache_count *count, const uint32_t *reads, uint32_t n)
{
    static plain m;
    const uint32_t nodes = count->block_bytes / CACHE_NODE_BYTES, blocks = count->bytes / count->block_bytes;
    memset(&m, 0, sizeof m);
    for (uint32_t i = 0; i < n; i++)
        if (count->kind == CACHE_LRU)
            read_lru(&m, blocks, reads[i] / nodes);
        else
            read_direct(&m, blocks, reads[i] / nodes);
    return m.misses;
}

static void test_memories(void **state)
{
    (void)state;
    test_random r = random_make(1);
    const uint32_t n = 2000 + test_scaled(20000);
    uint32_t *reads = make_reads(&r, n), compared = 0;
    cache_set *set = cache_set_create(NODES);
    assert_non_null(set);
    cache_set_ray(set);
    for (uint32_t i = 0; i < n; i++)
        cache_set_read(set, reads[i]);
    assert_int_equal(cache_set_reads(set), n);
    const cache_count *count;
    for (uint32_t i = 0; (count = cache_set_count(set, i)) != NULL; i++) {
        assert_true(count->misses > 0 && count->misses <= n);
        assert_true(count->bytes_transfer <= count->misses * count->block_bytes);
        if (count->kind != CACHE_LRU && count->kind != CACHE_DIRECT)
            continue;
        assert_int_equal(count->misses, misses_of(count, reads, n));
        compared++;
    }
    assert_int_equal(compared, 48);
    cache_set_release(set);
    test_free(reads);
}

static const cache_count *find_count(const cache_set *set, cache_kind kind, uint32_t block_bytes)
{
    const cache_count *count;
    for (uint32_t i = 0; (count = cache_set_count(set, i)) != NULL; i++)
        if (count->kind == kind && count->block_bytes == block_bytes)
            return count;
    fail_msg("no memory %s of %u bytes", cache_kind_name(kind), (unsigned)block_bytes);
    return NULL;
}

/* By hand: windows of 16 nodes, starting at the pair of the missing node; the end of the tree truncates one. */
static void test_windows(void **state)
{
    (void)state;
    static const uint32_t reads[] = {0, 15, 16, 31, 5, 1003, 1002, 1001};
    cache_set *set = cache_set_create(1004);
    assert_non_null(set);
    for (size_t i = 0; i < TEST_COUNT(reads); i++) {
        if (i % 2 == 0)
            cache_set_ray(set);
        cache_set_read(set, reads[i]);
    }
    const cache_count *window = find_count(set, CACHE_WINDOW, 128), *top = find_count(set, CACHE_TOP, 128);
    assert_int_equal(window->misses, 5); /* 0..15, 16..31, 4..19, 1002..1003, 1000..1003 */
    assert_int_equal(window->bytes_transfer, 8 * (16 + 16 + 16 + 2 + 4));
    assert_int_equal(top->misses, 3); /* 16..31, 1002..1003, 1000..1003: the first 16 stay */
    /* rays 0, 15; 16, 31; 5, 1003; 1002, 1001, in lines of 16 nodes */
    assert_int_equal(find_count(set, CACHE_RAY, 128)->misses, 1 + 1 + 2 + 1);
    assert_int_equal(find_count(set, CACHE_RAY, 64)->misses, 2 + 2 + 2 + 1);
    cache_set_release(set);
}

/* ---- Walk ---------------------------------------------------------------------------------------------------- */

typedef struct path {
    uint32_t node[16];
    uint32_t nodes;
} path;

static void note(void *user, uint32_t node)
{
    path *p = user;
    assert_true(p->nodes < TEST_COUNT(p->node));
    p->node[p->nodes++] = node;
}

static void expect_path(const cgt_kd_tree *tree, const float org[3], const float dir[3], double t_end,
                        const uint32_t *node, uint32_t nodes)
{
    path p = {.nodes = 0};
    structures_walk(tree, org, dir, t_end, note, &p);
    assert_int_equal(p.nodes, nodes);
    assert_memory_equal(p.node, node, nodes * sizeof *node);
}

/* The box from 0 to 4: cut at x = 2 into nodes 2 and 3, the upper half at y = 1 into nodes 4 and 5. */
static void test_walk(void **state)
{
    (void)state;
    const cgt_kd_node node[] = {cgt_kd_inner(0, 2, 2), cgt_kd_leaf_node(0, 0), cgt_kd_leaf_node(0, 0),
                                cgt_kd_inner(1, 1, 4), cgt_kd_leaf_node(0, 0), cgt_kd_leaf_node(0, 0)};
    const cgt_kd_tree tree = {.node = node, .nodes = TEST_COUNT(node), .high = {4, 4, 4}, .depth = 2, .leaves = 3};
    /* along x at y = 3, from outside: the lower half, then the upper one's upper half; backwards the other way */
    expect_path(&tree, (const float[]){-1, 3, 1}, (const float[]){1, 0, 0}, INFINITY, (const uint32_t[]){0, 2, 3, 5},
                4);
    expect_path(&tree, (const float[]){9, 3, 1}, (const float[]){-2, 0, 0}, INFINITY, (const uint32_t[]){0, 3, 5, 2},
                4);
    /* the hit lies in the lower half, at its plane, or behind it */
    expect_path(&tree, (const float[]){-1, 3, 1}, (const float[]){1, 0, 0}, 2.5, (const uint32_t[]){0, 2}, 2);
    expect_path(&tree, (const float[]){-1, 3, 1}, (const float[]){1, 0, 0}, 4, (const uint32_t[]){0, 2, 3, 5}, 4);
    /* up through the upper half; from a point in it, away from the other leaves */
    expect_path(&tree, (const float[]){3, 0, 1}, (const float[]){0, 1, 0}, INFINITY, (const uint32_t[]){0, 3, 4, 5}, 4);
    expect_path(&tree, (const float[]){3, 2, 1}, (const float[]){1, 1, 0}, INFINITY, (const uint32_t[]){0, 3, 5}, 3);
    /* past the box */
    expect_path(&tree, (const float[]){-1, 5, 1}, (const float[]){1, 0, 0}, INFINITY, (const uint32_t[]){0}, 0);
    expect_path(&tree, (const float[]){-1, 3, 1}, (const float[]){-1, 0, 0}, INFINITY, (const uint32_t[]){0}, 0);
}

/* ---- Comparison ---------------------------------------------------------------------------------------------- */

enum { WIDTH = 7, HEIGHT = 5, PIXELS = WIDTH * HEIGHT, RAYS = 40 };

static structures_found make_found(void)
{
    structures_found found;
    assert_int_equal(structures_found_create(&found, WIDTH, HEIGHT), 0);
    assert_int_equal(structures_found_reset(&found, FOUND_FRAME, PIXELS), 0);
    assert_int_equal(structures_found_reset(&found, FOUND_HITS, RAYS), 0);
    assert_int_equal(structures_found_reset(&found, FOUND_OCCLUDED, RAYS), 0);
    return found;
}

static void test_comparison(void **state)
{
    (void)state;
    test_random random = random_make(2);
    structures_found a = make_found(), b = make_found();
    char text[400], name[64];
    const struct {
        found_form form;
        void *memory;
        uint32_t count, bytes; /* rays, and bytes of each */
    } places[] = {{FOUND_FRAME, b.planes.t, PIXELS, 4},         {FOUND_FRAME, b.planes.primitive, PIXELS, 4},
                  {FOUND_FRAME, b.planes.normal[0], PIXELS, 4}, {FOUND_FRAME, b.planes.normal[1], PIXELS, 4},
                  {FOUND_FRAME, b.planes.normal[2], PIXELS, 4}, {FOUND_HITS, b.t, RAYS, 4},
                  {FOUND_HITS, b.primitive, RAYS, 4},           {FOUND_OCCLUDED, b.occluded, RAYS, 1}};
    for (size_t p = 0; p < TEST_COUNT(places); p++)
        for (int round = 0; round < 20; round++) {
            unsigned char *bytes = places[p].memory;
            const uint32_t ray = random_below(&random, places[p].count);
            const size_t at = (size_t)ray * places[p].bytes + random_below(&random, places[p].bytes);
            const unsigned char bit = (unsigned char)(1u << random_below(&random, 8));
            assert_int_equal(structures_found_differ(&a, &b, places[p].form, places[p].count, text, sizeof text), 0);
            assert_string_equal(text, "");
            bytes[at] ^= bit;
            assert_int_equal(structures_found_differ(&a, &b, places[p].form, places[p].count, text, sizeof text), 1);
            snprintf(name, sizeof name, "ray %u: ", (unsigned)ray);
            assert_non_null(strstr(text, name));
            bytes[at] ^= bit;
        }
    /* Several rays: the first one is named. */
    b.t[3] = b.t[5] = 1.0f;
    b.primitive[3] = 7;
    assert_int_equal(structures_found_differ(&a, &b, FOUND_HITS, RAYS, text, sizeof text), 2);
    assert_non_null(strstr(text, "ray 3: t 1 (3f800000), primitive 7, not t "));
    structures_found_release(&a);
    structures_found_release(&b);
}

static void test_hits(void **state)
{
    (void)state;
    structures_found found = make_found();
    for (uint32_t i = 0; i < RAYS; i++) {
        found.t[i] = i % 4 ? (float)i : INFINITY;
        found.occluded[i] = i % 4 == 0;
    }
    for (uint32_t i = 0; i < PIXELS; i++)
        found.planes.t[i] = i % 5 ? INFINITY : 2.0f;
    assert_int_equal(structures_found_hits(&found, FOUND_HITS, RAYS), 30);
    assert_int_equal(structures_found_hits(&found, FOUND_OCCLUDED, RAYS), 10);
    assert_int_equal(structures_found_hits(&found, FOUND_FRAME, PIXELS), 7);
    structures_found_release(&found);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_memories), cmocka_unit_test(test_windows),
                                       cmocka_unit_test(test_walk), cmocka_unit_test(test_comparison),
                                       cmocka_unit_test(test_hits)};
    test_begin("test_bench_structures");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
