/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bodies of meshes; see cgt/picture.h. */
#include <cgt/picture.h>

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

typedef struct place {
    float at[3];
    uint32_t vertex;
} place;

typedef struct edge {
    uint32_t from, to; /* from < to */
    int32_t way;       /* 1: used in that order, -1: in the other */
    uint32_t triangle;
} edge;

static int compare_places(const void *a, const void *b)
{
    const place *p = a, *q = b;
    for (int i = 0; i < 3; i++)
        if (p->at[i] != q->at[i])
            return p->at[i] < q->at[i] ? -1 : 1;
    return 0;
}

static int compare_edges(const void *a, const void *b)
{
    const edge *p = a, *q = b;
    if (p->from != q->from)
        return p->from < q->from ? -1 : 1;
    return p->to < q->to ? -1 : p->to > q->to;
}

/* The first vertex at the place of each. */
static bool weld(const float *position, uint32_t vertices, uint32_t *same)
{
    place *places = malloc((size_t)vertices * sizeof *places + 1);
    if (!places)
        return false;
    for (uint32_t i = 0; i < vertices; i++) {
        memcpy(places[i].at, position + 3 * (size_t)i, sizeof places[i].at);
        places[i].vertex = i;
    }
    qsort(places, vertices, sizeof *places, compare_places);
    for (uint32_t i = 0; i < vertices;) {
        uint32_t end = i + 1, first = places[i].vertex;
        for (; end < vertices && compare_places(&places[i], &places[end]) == 0; end++)
            first = places[end].vertex < first ? places[end].vertex : first;
        for (; i < end; i++)
            same[places[i].vertex] = first;
    }
    free(places);
    return true;
}

/* Union-find with halved paths. */
static uint32_t root_of(uint32_t *parent, uint32_t i)
{
    for (; parent[i] != i; i = parent[i])
        parent[i] = parent[parent[i]];
    return i;
}

/* Numbers the bodies: triangles whose vertices are connected. parent, number: one a vertex. */
static uint32_t number_bodies(const uint32_t *index, uint32_t triangles, uint32_t vertices, const uint32_t *same,
                              uint32_t *parent, uint32_t *number, uint32_t *body)
{
    uint32_t bodies = 0;
    for (uint32_t i = 0; i < vertices; i++)
        parent[i] = i, number[i] = UINT32_MAX;
    for (uint32_t i = 0; i < triangles; i++)
        for (size_t k = 1; k < 3; k++)
            parent[root_of(parent, same[index[3 * (size_t)i]])] = root_of(parent, same[index[3 * (size_t)i + k]]);
    for (uint32_t i = 0; i < triangles; i++) {
        const uint32_t root = root_of(parent, same[index[3 * (size_t)i]]);
        if (number[root] == UINT32_MAX)
            number[root] = bodies++;
        body[i] = number[root];
    }
    return bodies;
}

static uint32_t list_edges(const uint32_t *index, uint32_t triangles, const uint32_t *same, edge *edges)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < triangles; i++)
        for (size_t k = 0; k < 3; k++) {
            const uint32_t from = same[index[3 * (size_t)i + k]], to = same[index[3 * (size_t)i + (k + 1) % 3]];
            if (from != to)
                edges[count++] = from < to ? (edge){from, to, 1, i} : (edge){to, from, -1, i};
        }
    return count;
}

/* The first edge that is not used as often one way as the other; NULL: none. */
static const edge *open_edge(const edge *edges, uint32_t count)
{
    for (uint32_t i = 0; i < count;) {
        const uint32_t first = i;
        int32_t sum = 0;
        for (; i < count && compare_edges(&edges[first], &edges[i]) == 0; i++)
            sum += edges[i].way;
        if (sum != 0)
            return &edges[first];
    }
    return NULL;
}

/* For mistakes; returns what the call does then. */
static cgt_result refuse(uint32_t wrong[3], uint32_t triangle, uint32_t from, uint32_t to)
{
    wrong[0] = triangle;
    wrong[1] = from;
    wrong[2] = to;
    return CGT_ERROR_INVALID_ARGUMENT;
}

cgt_result cgt_find_bodies(const uint32_t *index, uint32_t triangles, const float *position, uint32_t vertices,
                           uint32_t *body, uint32_t *bodies, uint32_t wrong[3])
{
    const size_t n = vertices, most_edges = 3 * (size_t)triangles;
    if (triangles > UINT32_MAX / 3)
        return CGT_ERROR_TOO_LARGE;
    for (uint32_t i = 0; i < 3 * triangles; i++)
        if (index[i] >= vertices)
            return refuse(wrong, i / 3, CGT_INVALID_ID, CGT_INVALID_ID);
    if (n > SIZE_MAX / sizeof(place) || most_edges > SIZE_MAX / sizeof(edge)) /* a place outgrows three of `same` */
        return CGT_ERROR_OUT_OF_MEMORY;
    uint32_t *same = malloc(3 * n * sizeof *same + 1);
    edge *edges = malloc(most_edges * sizeof *edges + 1);
    cgt_result result = CGT_ERROR_OUT_OF_MEMORY;
    if (same && edges && weld(position, vertices, same)) {
        *bodies = number_bodies(index, triangles, vertices, same, same + n, same + 2 * n, body);
        const uint32_t count = list_edges(index, triangles, same, edges);
        qsort(edges, count, sizeof *edges, compare_edges);
        const edge *open = open_edge(edges, count);
        result = open ? refuse(wrong, open->triangle, open->from, open->to) : CGT_OK;
    }
    free(same);
    free(edges);
    return result;
}
