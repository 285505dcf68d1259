/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The list of ways that a subject measures, and their names. BENCH_HAS_EMBREE: it is installed. */
#include "ways/bench_way.h"

#include <stdio.h>
#include <string.h>

/* ---- names of values ---- */

const char *const bench_structures[] = {[CGT_STRUCTURE_AUTO] = "auto", [CGT_STRUCTURE_LOOSE_GRID] = "loose-grid",
                                        [CGT_STRUCTURE_BVH] = "bvh",   [CGT_STRUCTURE_QUEUE_GRID] = "queue-grid",
                                        [CGT_STRUCTURE_KD] = "kd",     [CGT_STRUCTURE_KD_ROPES] = "kd-ropes",
                                        [CGT_STRUCTURE_BIH] = "bih",   NULL};
const char *const bench_loops[] = {"auto", "nested", "flattened", NULL};
const char *const bench_culls[] = {"auto", "off", "frustum", "blocks", NULL};
const char *const bench_tiles_names[] = {"auto", "square", "strip", NULL};
const char *const bench_precisions[] = {"exact", "fast", NULL};
const char *const bench_triangle_tests[] = {"auto", "watertight", "moller-trumbore", "accelerated", NULL};
const char *const bench_kd_traversals[] = {"auto", "single", "packet", NULL};
const char *const bench_kd_layouts[] = {"auto", "depth-first", "breadth-first", "mixed", NULL};

/* ---- names of ways ---- */

enum { STRUCTURES = BENCH_LIBRARY_NAMES, EMBREE = STRUCTURES, EMBREE_ALL, EMBREE_FIRST };

#ifdef BENCH_HAS_EMBREE
static const char *const qualities[EMBREE_QUALITIES] = {"low", "medium", "refit"};
#endif

/* Structures by their numbers, then Embree's ways: three names for each quality, of any spheres, builtin and user. */
static const char *const way_names[] = {"auto",
                                        "loose-grid",
                                        "bvh",
                                        "queue-grid",
                                        "kd",
                                        "kd-ropes",
                                        "bih",
#ifdef BENCH_HAS_EMBREE
                                        "embree",
                                        "embree-all",
                                        "embree-low",
                                        "embree-low-builtin",
                                        "embree-low-user",
                                        "embree-medium",
                                        "embree-medium-builtin",
                                        "embree-medium-user",
                                        "embree-refit",
                                        "embree-refit-builtin",
                                        "embree-refit-user",
#endif
                                        NULL};

const char *const *bench_way_names(void) { return way_names; }

#ifdef BENCH_HAS_EMBREE
int bench_embree_is_here(void) { return 1; }
#else
int bench_embree_is_here(void) { return 0; }
int bench_embree_has_isa(const char *name)
{
    (void)name;
    return 0;
}
#endif

static void append(char name[BENCH_NAME_SIZE], const char *key, const char *value)
{
    const size_t length = strlen(name);
    snprintf(name + length, BENCH_NAME_SIZE - length, ",%s%s%s", key, value ? "=" : "", value ? value : "");
}

static void append_number(char name[BENCH_NAME_SIZE], const char *key, uint32_t value)
{
    char text[16];
    snprintf(text, sizeof text, "%u", (unsigned)value);
    append(name, key, text);
}

/* Where a value is not the library's choice, number 0. */
static void append_choice(char name[BENCH_NAME_SIZE], const char *key, const char *const *names, int value)
{
    if (value)
        append(name, key, names[value]);
}

#ifdef BENCH_HAS_EMBREE
static void name_embree(const bench_way *way, char name[BENCH_NAME_SIZE])
{
    snprintf(name, BENCH_NAME_SIZE, "embree-%s%s", qualities[way->quality],
             way->user < 0 ? ""
             : way->user   ? "-user"
                           : "-builtin");
    if (way->packet == 0)
        append(name, "stream", NULL);
    else if (way->packet != BENCH_NATIVE_PACKET)
        append_number(name, "packet", way->packet);
    if (way->packet != BENCH_NATIVE_PACKET && way->packet != 1 && !way->coherent)
        append(name, "incoherent", NULL);
    if (way->robust)
        append(name, "robust", NULL);
}
#endif

void bench_way_name(const bench_way *way, cgt_structure built, char name[BENCH_NAME_SIZE])
{
    const bench_choice *c = &way->choice;
    const int is_kd = built == CGT_STRUCTURE_KD || built == CGT_STRUCTURE_KD_ROPES;
#ifdef BENCH_HAS_EMBREE
    if (way->embree) {
        name_embree(way, name);
        return;
    }
#endif
    snprintf(name, BENCH_NAME_SIZE, "%s", bench_structures[built]);
    if (built == CGT_STRUCTURE_AUTO && way->rays == CGT_RAY_KIND_INCOHERENT)
        append(name, "rays", "incoherent");
    if (is_kd || built == CGT_STRUCTURE_BIH)
        append_choice(name, "traversal", bench_kd_traversals, (int)c->kd_traversal);
    if (is_kd) {
        append_choice(name, "layout", bench_kd_layouts, (int)c->kd_layout);
        if (c->kd_break)
            append_number(name, "break", c->kd_break);
    }
    if (c->variant)
        append(name, "variant", c->variant);
    if (c->packet)
        append_number(name, "packet", c->packet);
    append_choice(name, "tile", bench_tiles_names, (int)c->tile);
    append_choice(name, "loop", bench_loops, (int)c->loop);
    append_choice(name, "cull", bench_culls, c->cull == CGT_CULL_BLOCKS ? 0 : (int)c->cull);
    if (c->mailbox == CGT_MAILBOX_OFF)
        append(name, "mailbox", "off");
    if (c->precision_named || c->precision)
        append(name, "precision", bench_precisions[c->precision]);
    append_choice(name, "test", bench_triangle_tests, (int)c->test);
    if (c->resolution[0]) {
        char grid[48];
        snprintf(grid, sizeof grid, "%ux%ux%u", (unsigned)c->resolution[0], (unsigned)c->resolution[1],
                 (unsigned)c->resolution[2]);
        append(name, "grid", grid);
    }
}

/* ---- the list ---- */

typedef struct way_list {
    const bench_settings *settings;
    int triangles;
    bench_way *way;
    size_t count;
} way_list;

static bench_way *add(way_list *list, size_t built_by)
{
    bench_way *way = &list->way[list->count];
    *way = (bench_way){.built_by = built_by};
    list->count++;
    return way;
}

/* A row of a structure; rows with one build have the same built_by. */
static bench_way *add_row(way_list *list, const bench_way *like)
{
    bench_way *way = add(list, like->built_by);
    const size_t built_by = like->built_by;
    *way = *like;
    way->built_by = built_by;
    return way;
}

/* A row for each way to traverse the structure of the last row: both loops of a queue grid; in a loose grid a camera's
 * frame by whole tiles and by packets; single rays and packets of trees. */
static void add_traversals(way_list *list)
{
    enum { LARGEST_PACKET = 16 };
    bench_way *row = &list->way[list->count - 1];
    const bench_way like = *row;
    const cgt_structure s = like.structure;
    const int is_tree = s == CGT_STRUCTURE_KD || s == CGT_STRUCTURE_KD_ROPES || s == CGT_STRUCTURE_BIH;
    if (s == CGT_STRUCTURE_QUEUE_GRID)
        add_row(list, &like)->choice.loop = CGT_LOOP_FLATTENED;
    else if (s == CGT_STRUCTURE_LOOSE_GRID && !like.choice.packet)
        add_row(list, &like)->choice.packet = LARGEST_PACKET;
    else if (is_tree && like.choice.kd_traversal == CGT_KD_TRAVERSAL_AUTO) {
        row->choice.kd_traversal = CGT_KD_TRAVERSAL_SINGLE;
        add_row(list, &like)->choice.kd_traversal = CGT_KD_TRAVERSAL_PACKET;
    }
}

static bench_way *add_build(way_list *list, cgt_structure structure, cgt_ray_kind rays)
{
    bench_way *way = add(list, list->count);
    way->structure = structure;
    way->rays = rays;
    way->choice = list->settings->choice;
    return way;
}

/* --all of frame: packets and tiles, each with a scene of its own. */
static void add_shapes(way_list *list, cgt_structure structure)
{
    static const uint32_t packets[] = {4, 8, 16, 4};
    for (size_t i = 0; i < sizeof packets / sizeof packets[0]; i++) {
        bench_way *way = add_build(list, structure, CGT_RAY_KIND_COHERENT);
        way->choice.packet = packets[i];
        way->choice.tile = i < 3 ? CGT_TILE_SHAPE_SQUARE : CGT_TILE_SHAPE_STRIP;
    }
}

static void add_structure(way_list *list, cgt_structure structure)
{
    const bench_settings *s = list->settings;
    const int is_kd = structure == CGT_STRUCTURE_KD || structure == CGT_STRUCTURE_KD_ROPES;
    const int trees = s->layouts && is_kd ? 3 : 1;
    for (int k = 0; k < trees; k++) {
        bench_way *way =
            add_build(list, structure, s->subject == BENCH_BOUNCES ? CGT_RAY_KIND_INCOHERENT : CGT_RAY_KIND_COHERENT);
        if (trees > 1)
            way->choice.kd_layout = (cgt_kd_layout)(CGT_KD_LAYOUT_DEPTH_FIRST + k);
        if (s->traversals)
            add_traversals(list);
    }
    if (s->subject == BENCH_RAYS && structure == CGT_STRUCTURE_AUTO)
        add_build(list, structure, CGT_RAY_KIND_INCOHERENT);
    if (s->all)
        add_shapes(list, structure);
}

/* Embree's ways to trace arrays of rays; 0: a stream. */
static const struct {
    uint32_t packet;
    int coherent;
} forms[] = {{1, 0}, {8, 1}, {8, 0}, {16, 1}, {16, 0}, {0, 1}, {0, 0}};

/* One quality and kind of spheres; rays in all forms, where a subject traces arrays of them. Streams are for any
 * hit. */
static void add_embree(way_list *list, bench_quality quality, int user, int is_candidate)
{
    const bench_settings *s = list->settings;
    const size_t built_by = list->count;
    const size_t in_forms = s->subject & (BENCH_FRAME | BENCH_CLIFFS) ? 1 : sizeof forms / sizeof forms[0];
    const size_t streams = s->subject == BENCH_BOUNCES ? 2 : 0; /* which trace nearest hits alone */
    for (size_t k = 0; k + streams < in_forms; k++) {
        bench_way *way = add(list, built_by);
        way->embree = 1;
        way->is_candidate = is_candidate;
        way->quality = quality;
        way->user = list->triangles ? -1 : user;
        way->robust = s->embree_robust;
        way->packet = in_forms > 1 ? forms[k].packet : s->embree_packet ? s->embree_packet : BENCH_NATIVE_PACKET;
        way->coherent = in_forms > 1 ? forms[k].coherent : 1;
    }
}

static void add_named(way_list *list, int name)
{
    const bench_subject subject = list->settings->subject;
    if (name < STRUCTURES) {
        add_structure(list, (cgt_structure)name);
        return;
    }
    /* "embree" and "embree-all": every quality for frames, the fastest to build for rays, its own spheres for cliffs */
    const int all = name < EMBREE_FIRST;
    const int of_quality = (name - EMBREE_FIRST) / 3, of_user = (name - EMBREE_FIRST) % 3 - 1; /* -1: both */
    for (int user = 0; user < (list->triangles || (all && subject == BENCH_CLIFFS) ? 1 : 2); user++)
        for (int quality = 0; quality < EMBREE_QUALITIES; quality++)
            if (all ? quality == EMBREE_LOW || subject == BENCH_FRAME
                    : quality == of_quality && (list->triangles || of_user < 0 || of_user == user))
                add_embree(list, (bench_quality)quality, user, name == EMBREE);
}

size_t bench_ways_make(const bench_settings *settings, int triangles, bench_way ways[BENCH_MOST_WAYS])
{
    static const int
        of_frame[] = {CGT_STRUCTURE_AUTO, -1},
        of_light[] = {CGT_STRUCTURE_AUTO, EMBREE, -1},
        of_rays[] = {CGT_STRUCTURE_QUEUE_GRID, CGT_STRUCTURE_LOOSE_GRID, CGT_STRUCTURE_KD,   CGT_STRUCTURE_KD_ROPES,
                     CGT_STRUCTURE_BIH,        CGT_STRUCTURE_BVH,        CGT_STRUCTURE_AUTO, -1},
        of_bounces[] = {CGT_STRUCTURE_BVH, CGT_STRUCTURE_LOOSE_GRID, CGT_STRUCTURE_KD, CGT_STRUCTURE_BIH, EMBREE, -1},
        of_cliffs[] = {CGT_STRUCTURE_AUTO, CGT_STRUCTURE_LOOSE_GRID, CGT_STRUCTURE_BVH, CGT_STRUCTURE_BIH, EMBREE, -1};
    const bench_subject subject = settings->subject;
    const int *own = subject == BENCH_RAYS      ? of_rays
                     : subject == BENCH_LIGHT   ? of_light
                     : subject == BENCH_BOUNCES ? of_bounces
                     : subject == BENCH_CLIFFS  ? of_cliffs
                                                : of_frame;
    way_list list = {.settings = settings, .triangles = triangles, .way = ways};
    for (size_t i = 0; i < settings->ways; i++)
        add_named(&list, settings->way[i]);
    for (; !settings->ways && *own >= 0; own++)
        if (*own < STRUCTURES || (bench_embree_is_here() && !settings->no_embree))
            add_named(&list, *own);
    return list.count;
}
