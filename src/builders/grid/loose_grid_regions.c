/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Regions of a loose grid. A grid over everything has one size of cells for a level. One primitive far away makes that
 * size large, and all others share a cell; so do the members of a cluster in a wide world. After the sort, cells with
 * many primitives are listed. Their bounding box is divided, emptiest part first, until the parts are filled or no
 * level is left; each part becomes the region of a level of its own, whose cells suit what is in it. Everything is
 * sorted again, and looked at again, as long as that helps.
 *
 * An even scene has no crowded cells and pays nothing. Primitives that share a middle, or that are larger than their
 * distances, cannot be told apart by smaller cells: they stay where they are. */
#include "builders/grid/loose_grid_regions.h"

#include <math.h>
#include <string.h>

#include "builders/order/size_levels.h"
#include "core/scratch_tasks.h"

/* The mean, over all primitives, of how many share their cell: a grid below is left as it is, the sooner the fewer
 * primitives there are. It is 10 in an even scene, and 400 in one of a million primitives in 1,000 clusters, which is
 * traced as fast. */
#define MAX_MEAN 512.0
#define MIN_MEAN 256.0
#define MEAN_SHARE 0x1p-12                /* of the primitives */
#define CROWDED (CGT_CELL_SORT_CROWD / 2) /* primitives of a cell that joins a region */
#define MIN_SHARE 256u                    /* a region has at least this part of the primitives that are crowded */
#define SAMPLES 256u                      /* of a part's primitives, to estimate its level */
#define MIN_FILL 4.0                      /* cells of a part per crowded one: emptier parts are divided */

/* ---- items: what is sorted ---- */

typedef struct item {
    float middle[3], size;
} item;

/* A valid primitive, or a cluster that has one. */
static item get_item(const cgt_cell_sort *s, uint32_t i)
{
    if (s->cluster) {
        const cgt_cluster *c = &s->cluster[i];
        return (item){{c->middle[0], c->middle[1], c->middle[2]}, c->size};
    }
    const cgt_primitive_array *a = cgt_primitives_array(s->prims, i);
    if (a->kind == CGT_KIND_SPHERES) {
        const cgt_sphere q = cgt_array_sphere(a, i - a->first);
        return (item){{q.x, q.y, q.z}, fabsf(q.r)};
    }
    const float *plane = s->keys.middle + cgt_array_boxed_number(a, i);
    const size_t stride = s->keys.boxed;
    return (item){{plane[0], plane[stride], plane[2 * stride]}, plane[3 * stride]};
}

static void add_item(cgt_size_class *c, const item *q)
{
    cgt_size_class one = {.count = 1};
    for (int a = 0; a < 3; a++) {
        one.low[a] = one.high[a] = q->middle[a];
        one.half[a] = q->size;
    }
    cgt_size_class_add(c, &one);
}

/* ---- crowded cells ---- */

static uint32_t count_cell(const cgt_loose_grid *g, uint32_t cell) { return g->start[cell + 1] - g->start[cell]; }

static double mean_of_cells(const cgt_loose_grid *g, uint32_t valid)
{
    uint64_t squares = 0; /* at most that of all primitives */
    for (uint32_t c = 0; c < g->cells; c++)
        squares += (uint64_t)count_cell(g, c) * count_cell(g, c);
    return (double)squares / valid;
}

/* Crowded cells of a level, and the box of cells around them. */
typedef struct part {
    uint32_t level;
    uint32_t begin, end; /* in the list of crowded cells */
    uint32_t low[3], high[3];
    uint64_t prims;
} part;

typedef struct part_list {
    const cgt_loose_grid *grid;
    uint32_t *cell; /* crowded cells, by part */
    part part[CGT_LOOSE_LEVELS];
    uint32_t parts, max_parts;
} part_list;

static void locate(const cgt_loose_level *l, uint32_t cell, uint32_t position[3])
{
    const uint32_t i = cell - l->first;
    position[0] = i % l->size[0];
    position[1] = i / l->size[0] % l->size[1];
    position[2] = i / l->size[0] / l->size[1];
}

/* Sets the box and the count of a part. */
static void bound_part(const part_list *list, part *p)
{
    p->prims = 0;
    for (uint32_t k = p->begin; k < p->end; k++) {
        uint32_t position[3];
        locate(&list->grid->level[p->level], list->cell[k], position);
        for (int a = 0; a < 3; a++) {
            p->low[a] = k == p->begin || position[a] < p->low[a] ? position[a] : p->low[a];
            p->high[a] = k == p->begin || position[a] > p->high[a] ? position[a] : p->high[a];
        }
        p->prims += count_cell(list->grid, list->cell[k]);
    }
}

/* Lists the crowded cells of each level as a part. */
static void list_crowded(part_list *list)
{
    const cgt_loose_grid *g = list->grid;
    uint32_t cells = 0;
    for (uint32_t i = 0; i < g->levels && list->parts < list->max_parts; i++) {
        const cgt_loose_level *l = &g->level[i];
        const uint32_t end = l->first + l->size[0] * l->size[1] * l->size[2];
        part p = {.level = i, .begin = cells};
        for (uint32_t c = l->first; c < end; c++)
            if (count_cell(g, c) > CROWDED)
                list->cell[cells++] = c;
        p.end = cells;
        if (p.begin == p.end)
            continue;
        bound_part(list, &p);
        list->part[list->parts++] = p;
    }
}

/* How many cells a part spans for each crowded one. */
static double emptiness(const part *p)
{
    double cells = 1;
    for (int a = 0; a < 3; a++)
        cells *= p->high[a] - p->low[a] + 1;
    return cells / (p->end - p->begin);
}

/* Moves the cells whose coordinate is at most `last` to the front; returns their end. */
static uint32_t partition(const part_list *list, const part *p, int axis, uint32_t last)
{
    uint32_t middle = p->begin;
    for (uint32_t k = p->begin; k < p->end; k++) {
        uint32_t position[3];
        const uint32_t cell = list->cell[k];
        locate(&list->grid->level[p->level], cell, position);
        if (position[axis] > last)
            continue;
        list->cell[k] = list->cell[middle];
        list->cell[middle++] = cell;
    }
    return middle;
}

/* Divides a part in the middle of its longest axis. Both halves have cells, since the box is tight. */
static void divide_part(part_list *list, part *p)
{
    part *upper = &list->part[list->parts++];
    int axis = 0;
    for (int a = 1; a < 3; a++)
        axis = p->high[a] - p->low[a] > p->high[axis] - p->low[axis] ? a : axis;
    const uint32_t middle = partition(list, p, axis, p->low[axis] + (p->high[axis] - p->low[axis]) / 2);
    *upper = *p;
    upper->begin = p->end = middle;
    bound_part(list, p);
    bound_part(list, upper);
}

/* Divides the parts while some are mostly empty: first what has most primitives in most empty cells. */
static void divide_parts(part_list *list)
{
    while (list->parts < list->max_parts) {
        part *next = NULL;
        double most = 0;
        for (uint32_t i = 0; i < list->parts; i++) {
            part *p = &list->part[i];
            const double e = emptiness(p);
            if (e > MIN_FILL && e * (double)p->prims > most) {
                next = p;
                most = e * (double)p->prims;
            }
        }
        if (!next)
            return;
        divide_part(list, next);
    }
}

/* ---- levels ---- */

static const uint32_t no_resolution[3] = {0, 0, 0};

/* Estimates a part's sizes from a sample of what is in its crowded cells. */
static cgt_size_class sample_part(const part_list *list, const cgt_cell_sort *sort, const part *p)
{
    const cgt_loose_grid *g = list->grid;
    const uint64_t step = p->prims / SAMPLES + 1;
    cgt_size_class all = {0};
    uint64_t next = 0; /* of the part's primitives, counted from the cell's first one */
    for (uint32_t k = p->begin; k < p->end; k++) {
        const uint32_t count = count_cell(g, list->cell[k]);
        for (; next < count; next += step) {
            const item q = get_item(sort, g->prim[g->start[list->cell[k]] + next]);
            add_item(&all, &q);
        }
        next -= count;
    }
    all.count = (uint32_t)p->prims;
    return all;
}

/* The level of a part's region: its box of cells. Returns false where the level's cells would not be much smaller. */
static bool init_region(const part_list *list, const cgt_cell_sort *sort, const part *p, cgt_loose_level *level)
{
    const cgt_loose_level *outer = &list->grid->level[p->level];
    const cgt_size_class sizes = sample_part(list, sort, p);
    double ratio = 1;
    *level = (cgt_loose_level){.least = outer->least, .has_region = true};
    cgt_loose_level_init(&sizes, no_resolution, level);
    for (int a = 0; a < 3; a++) {
        level->region_low[a] = outer->low[a] + (float)p->low[a] * outer->cell[a];
        level->region_high[a] = outer->low[a] + (float)(p->high[a] + 1) * outer->cell[a];
        ratio *= fmin((double)level->cell[a] / (double)outer->cell[a], 1);
    }
    const double cells = (double)level->size[0] * level->size[1] * level->size[2];
    return ratio < 0.25 && cells > 2.0 * (p->end - p->begin);
}

/* Inserts a level before the one whose primitives it takes. */
static void insert_level(cgt_loose_grid *g, uint32_t at, const cgt_loose_level *level)
{
    for (uint32_t i = g->levels; i > at; i--)
        g->level[i] = g->level[i - 1];
    g->level[at] = *level;
    g->levels++;
}

/* Appends the regions of the parts to the levels. Parts are in the order of their levels but for divided ones. Returns
 * whether there are any. */
static bool insert_regions(const part_list *list, const cgt_cell_sort *sort, cgt_loose_grid *g)
{
    const cgt_loose_grid before = *g; /* parts name its levels and cells */
    const part_list of = {.grid = &before, .cell = list->cell};
    uint32_t inserted[CGT_LOOSE_LEVELS] = {0};
    uint64_t prims = 0;
    bool any = false;
    for (uint32_t i = 0; i < list->parts; i++)
        prims += list->part[i].prims;
    for (uint32_t i = 0; i < list->parts; i++) {
        const part *p = &list->part[i];
        cgt_loose_level level;
        uint32_t at = p->level;
        if (p->prims < prims / MIN_SHARE || !init_region(&of, sort, p, &level))
            continue;
        for (uint32_t k = 0; k <= p->level; k++)
            at += inserted[k];
        insert_level(g, at, &level);
        inserted[p->level]++;
        any = true;
    }
    return any;
}

/* ---- levels from their primitives ---- */

#define MEASURE_CHUNK 16384u

typedef struct measure_job {
    const cgt_kernel *kernel;
    const cgt_cell_sort *sort;
    cgt_size_classes *levels; /* of each chunk: class k stands for level k */
} measure_job;

static void measure_prims(const measure_job *job, uint32_t first, uint32_t end, cgt_size_classes *levels,
                          cgt_scratch *scratch)
{
    const cgt_cell_sort *s = job->sort;
    const cgt_primitive_array *a = cgt_primitives_array(s->prims, first);
    for (uint32_t prim = first; prim < end; a++) {
        const uint32_t stop = end - a->first < a->count ? end : a->first + a->count;
        job->kernel->loose_grid_measure(&s->keys, a, prim, stop, s->key + prim, levels, scratch);
        prim = stop;
    }
}

static void measure_chunk(void *argument, uint32_t chunk, cgt_scratch *scratch)
{
    const measure_job *job = argument;
    const cgt_cell_sort *s = job->sort;
    const uint32_t first = chunk * MEASURE_CHUNK, rest = s->count - first;
    const uint32_t count = rest < MEASURE_CHUNK ? rest : MEASURE_CHUNK;
    cgt_size_classes *levels = &job->levels[chunk];
    memset(levels->used_classes, 0, sizeof levels->used_classes);
    if (s->cluster)
        job->kernel->loose_grid_measure_clusters(&s->keys, s->cluster + first, count, s->key + first, levels, scratch);
    else
        measure_prims(job, first, first + count, levels, scratch);
}

/* Lays out all levels anew: a region takes what the cells around its parts hold too, and leaves its outer level with
 * less. Levels without primitives go. */
static void place_levels(cgt_loose_grid *g, const cgt_size_classes *sizes)
{
    uint32_t levels = 0;
    g->cells = g->regions = 0;
    for (uint32_t k = 0; k < g->levels; k++) {
        if (!cgt_size_class_is_used(sizes, k))
            continue;
        cgt_loose_level *l = &g->level[levels++];
        *l = g->level[k];
        cgt_loose_level_init(&sizes->of[k], no_resolution, l);
        l->first = g->cells;
        g->cells += l->size[0] * l->size[1] * l->size[2];
        g->regions += l->has_region;
    }
    g->levels = levels;
}

/* The keys of the sort are overwritten. */
static cgt_result measure_levels(cgt_scene *scene, const cgt_cell_sort *sort, cgt_loose_grid *g)
{
    const uint32_t chunks = (uint32_t)(((uint64_t)sort->count + MEASURE_CHUNK - 1) / MEASURE_CHUNK);
    cgt_buffer *buffer = &scene->buffer[CGT_BUFFER_REGIONS];
    cgt_result result = cgt_buffer_reserve(&scene->context->memory, buffer, chunks, sizeof(cgt_size_classes));
    if (result != CGT_OK)
        return result;
    measure_job job = {scene->context->kernel, sort, buffer->data};
    result = cgt_run_scratch_tasks(scene->context, measure_chunk, &job, chunks);
    if (result != CGT_OK)
        return result;
    cgt_size_classes_merge(job.levels, chunks);
    place_levels(g, job.levels);
    return CGT_OK;
}

cgt_result cgt_loose_grid_add_regions(cgt_scene *scene, const cgt_cell_sort *sort, cgt_loose_grid *grid, bool *added)
{
    part_list list = {.grid = grid, .cell = sort->entry, .max_parts = CGT_LOOSE_LEVELS - grid->levels};
    const double max_mean = fmin(MAX_MEAN, MIN_MEAN + sort->valid * MEAN_SHARE);
    *added = false;
    grid->crowding = (float)mean_of_cells(grid, sort->valid);
    if (!list.max_parts || grid->crowding < max_mean)
        return CGT_OK;
    list_crowded(&list);
    divide_parts(&list);
    *added = insert_regions(&list, sort, grid);
    return *added ? measure_levels(scene, sort, grid) : CGT_OK;
}
