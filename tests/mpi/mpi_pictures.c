/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Pictures of one scene, by one process with cgt/picture.h or by the ranks of a job with cgt/mpi.h: mpi_pictures.sh
 * compares the bytes.
 *   mpi_pictures one SHADING OUT
 *   mpi_pictures deal|ids|rows|die SHADING OUT RANKS_PER_LEADER EXCHANGE_BYTES DEAL
 *
 * SHADING is that of cgt_shading. DEAL says who has what: 0 in turn, 1 at random, 2 all at the last rank, 3 nothing at
 * even ranks. `deal` has no ids: each rank's primitives are consecutive. `die`: the last rank does, in the second
 * frame. Several frames follow each other, of changing counts. Each writes bytes, linear pixels and picks to OUT. */
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cgt/mpi.h>

enum {
    WIDTH = 90,
    HEIGHT = 61,
    PIXELS = WIDTH * HEIGHT,
    BALLS = 900,
    EDGE = 24,
    STICKS = 200,
    FRAMES = 3,
    GEOMETRIES = 3
};
enum { FACETS = 2 * EDGE * EDGE, CORNERS = (EDGE + 1) * (EDGE + 1) };

/* What one process has: everything, or a rank its share, by the arrays of the API that take the longest way. */
typedef struct arrays {
    uint32_t balls, facets, corners, sticks;
    double center[BALLS][3];
    uint8_t type[BALLS], material[BALLS];
    uint16_t entry[BALLS];
    uint32_t ball_id[BALLS];
    float corner[CORNERS][3], normal[CORNERS][3], color[CORNERS][3];
    uint32_t index[FACETS][3], facet_id[FACETS], body[FACETS];
    float end[STICKS][2][3], radius[STICKS], half[STICKS][2][3];
    uint32_t stick_id[STICKS];
} arrays;

static const float radii[3] = {0.0f, 0.25f, 0.4f};
static const float palette[4][3] = {{0.9f, 0.3f, 0.2f}, {0.2f, 0.7f, 0.3f}, {0.3f, 0.4f, 0.9f}, {0.9f, 0.8f, 0.3f}};
static const cgt_material materials[3] = {{CGT_MATERIAL_MATTE, {0}, 0, {0}, 0, 0},
                                          {CGT_MATERIAL_MIRROR, {0.8f, 0.8f, 0.8f}, 0, {0}, 0, 60.0f},
                                          {CGT_MATERIAL_GLASS, {0}, 1.4f, {0.1f, 0.2f, 0.1f}, 1, 60.0f}};

static float noise(uint32_t *state, float from, float to)
{
    *state = *state * 1664525u + 1013904223u;
    return from + (to - from) * (float)(*state >> 8) * 0x1p-24f;
}

/* Everything. Each fifth ball lies where the one before lies, and has another colour; one has no place. */
static void make_arrays(arrays *a, int frame)
{
    uint32_t r = 17 + (uint32_t)frame;
    memset(a, 0, sizeof *a);
    a->balls = frame == 1 ? BALLS : BALLS / 2;
    a->facets = FACETS;
    a->corners = CORNERS;
    a->sticks = frame == 2 ? 0 : STICKS;
    for (uint32_t i = 0; i < BALLS; i++) {
        for (int c = 0; c < 3; c++)
            a->center[i][c] = i % 5 == 4 ? a->center[i - 1][c] : 1e6 + (double)noise(&r, c == 1 ? 0.3f : -4, 4);
        a->type[i] = i % 5 == 4 ? a->type[i - 1] : (uint8_t)(1 + i % 2);
        a->material[i] = (uint8_t)(i % 3);
        a->entry[i] = (uint16_t)(i % 4);
    }
    a->center[7][1] = NAN;
    for (uint32_t j = 0; j < CORNERS; j++) {
        const float x = (float)(j % (EDGE + 1)) / EDGE * 12 - 6, z = (float)(j / (EDGE + 1)) / EDGE * 12 - 6;
        const float corner[3] = {x, 0.3f * sinf(x) * cosf(z) - 1, z};
        const float normal[3] = {-0.3f * cosf(x) * cosf(z), 1, 0.3f * sinf(x) * sinf(z)};
        memcpy(a->corner[j], corner, sizeof corner);
        memcpy(a->normal[j], normal, sizeof normal);
        for (int c = 0; c < 3; c++)
            a->color[j][c] = noise(&r, 0.2f, 0.9f);
    }
    for (uint32_t i = 0; i < FACETS; i++) {
        const uint32_t j = i / 2 % EDGE + i / 2 / EDGE * (EDGE + 1);
        const uint32_t index[3] = {j, i % 2 ? j + EDGE + 1 : j + EDGE + 2, i % 2 ? j + EDGE + 2 : j + 1};
        memcpy(a->index[i], index, sizeof index);
    }
    for (uint32_t i = 0; i < STICKS; i++) {
        for (int c = 0; c < 6; c++) {
            a->end[i][c / 3][c % 3] = noise(&r, c % 3 == 1 ? 0 : -4, 4);
            a->half[i][c / 3][c % 3] = noise(&r, 0, 1);
        }
        a->radius[i] = noise(&r, 0.02f, 0.1f);
    }
}

/* Whether a rank has element i of n. */
static int is_mine(int deal, uint32_t i, uint32_t n, int rank, int ranks)
{
    uint32_t r = i * 2654435761u;
    if (rank < 0)
        return 1;
    if (deal == 1)
        return (int)(noise(&r, 0, 1) * (float)ranks) == rank;
    if (deal == 2)
        return rank == ranks - 1;
    if (deal == 3)
        return ranks == 1 || (int)(i % (uint32_t)(ranks / 2)) * 2 + 1 == rank;
    return (int)((uint64_t)i * (uint64_t)ranks / n) == rank;
}

/* A rank's share of everything, in turn or by ids: backwards, so that their order is not that of the arrays. */
static void take_share(const arrays *all, arrays *mine, int deal, int by_ids, int rank, int ranks)
{
    const uint32_t turn = 37 * ((uint32_t)rank + 1) % CORNERS;
    memset(mine, 0, sizeof *mine);
    mine->corners = all->corners; /* of which a rank uses some; each rank has them in another order */
    for (uint32_t j = 0; j < CORNERS; j++) {
        const uint32_t from = (j + turn) % CORNERS;
        memcpy(mine->corner[j], all->corner[from], sizeof mine->corner[j]);
        memcpy(mine->normal[j], all->normal[from], sizeof mine->normal[j]);
        memcpy(mine->color[j], all->color[from], sizeof mine->color[j]);
    }
    for (uint32_t k = 0; k < all->balls; k++) {
        const uint32_t i = by_ids ? all->balls - 1 - k : k, n = mine->balls;
        if (!is_mine(deal, i, all->balls, rank, ranks) || (by_ids && i == 7)) /* a number that nobody has */
            continue;
        memcpy(mine->center[n], all->center[i], sizeof mine->center[n]);
        mine->type[n] = all->type[i];
        mine->material[n] = all->material[i];
        mine->entry[n] = all->entry[i];
        mine->ball_id[n] = i;
        mine->balls++;
    }
    for (uint32_t k = 0; k < all->facets; k++) {
        const uint32_t i = by_ids ? all->facets - 1 - k : k, n = mine->facets;
        if (!is_mine(deal, i, all->facets, rank, ranks))
            continue;
        for (int c = 0; c < 3; c++)
            mine->index[n][c] = (all->index[i][c] + CORNERS - turn) % CORNERS;
        mine->body[n] = all->body[i];
        mine->facet_id[n] = i;
        mine->facets++;
    }
    for (uint32_t k = 0; k < all->sticks; k++) {
        const uint32_t i = by_ids ? all->sticks - 1 - k : k, n = mine->sticks;
        if (!is_mine(deal, i, all->sticks, rank, ranks))
            continue;
        memcpy(mine->end[n], all->end[i], sizeof mine->end[n]);
        memcpy(mine->half[n], all->half[i], sizeof mine->half[n]);
        mine->radius[n] = all->radius[i];
        mine->stick_id[n] = i;
        mine->sticks++;
    }
}

typedef struct shapes {
    cgt_spheres spheres;
    cgt_triangles triangles;
    cgt_capsules capsules;
    cgt_look looks[GEOMETRIES];
} shapes;

/* Mirrors and glass have no capsules, and read floats without an origin. */
static uint32_t describe(const arrays *a, int shading, shapes *s)
{
    s->spheres = (cgt_spheres){.count = a->balls,
                               .centers = cgt_doubles(a->center[0], 0),
                               .origin = {1e6, 1e6, 1e6},
                               .radii = cgt_floats(radii, 0),
                               .types = cgt_uint8s(a->type, 0),
                               .type_count = 3};
    s->triangles = (cgt_triangles){.count = a->facets,
                                   .indices = cgt_uint32s(a->index[0], 0),
                                   .vertex_count = a->corners,
                                   .vertices = cgt_floats(a->corner[0], 0)};
    s->capsules = (cgt_capsules){.count = a->sticks,
                                 .vertex_count = 2 * a->sticks,
                                 .vertices = cgt_floats(a->end[0][0], 0),
                                 .radii = cgt_floats(a->radius, 0)};
    s->looks[0] = (cgt_look){.index = a->entry, .palette = palette[0], .materials = a->material};
    s->looks[1] = (cgt_look){
        .colors = a->color[0], .per_vertex = true, .vertex_normals = a->normal[0], .bodies = a->body, .sheet = true};
    s->looks[2] = (cgt_look){.colors = a->half[0][0], .halves = true};
    return shading == CGT_SHADING_BOUNCES ? 2 : 3;
}

static void set_options(int shading, cgt_picture_options *o, cgt_camera *camera)
{
    cgt_picture_options_init(o);
    o->width = WIDTH;
    o->height = HEIGHT;
    o->shading = (cgt_shading)shading;
    o->antialias = shading == CGT_SHADING_BOUNCES ? 1 : 2;
    o->style.background[2] = 0.4f;
    o->lighting.sky = 0.4f;
    if (shading != CGT_SHADING_PLAIN) {
        o->lighting.light_count = 2;
        o->lighting.lights[0] = (cgt_picture_light){{CGT_LIGHT_DIRECTIONAL, {1, 2, 1}}, {0.6f, 0.6f, 0.5f}, true, 3};
        o->lighting.lights[1] = (cgt_picture_light){{CGT_LIGHT_POINT, {-5, 6, 3}}, {0.3f, 0.3f, 0.3f}, true, 0};
    }
    o->lighting.ambient = 8;
    o->style.outline = 1.5f;
    o->bounces.limit = 4;
    o->bounces.materials = materials;
    o->bounces.material_count = 3;
    cgt_camera_init(camera);
    camera->eye[0] = 3;
    camera->eye[1] = 5;
    camera->eye[2] = 10;
}

static void check(cgt_result result, const cgt_mpi *mpi)
{
    char text[400] = "";
    if (result == CGT_OK)
        return;
    if (mpi)
        cgt_mpi_get_error_message(mpi, text, sizeof text);
    fprintf(stderr, "%s: %s\n", cgt_get_result_string(result), text);
    exit(3);
}

/* The picture's bytes, and the primitives that rays across the picture hit. */
typedef struct picture {
    uint8_t bytes[4 * PIXELS], alpha[PIXELS];
    cgt_linear_pixel linear[PIXELS];
    uint32_t picked[2][WIDTH];
} picture;

static void pick(const cgt_scene *scene, const cgt_camera *camera, picture *p)
{
    for (uint32_t x = 0; x < WIDTH; x++) {
        cgt_single_ray ray = {.t_min = 0};
        cgt_hit hit;
        check(cgt_camera_get_ray(camera, WIDTH, HEIGHT, x, HEIGHT / 2, ray.org, ray.dir), NULL);
        check(cgt_trace_ray(scene, &ray, &hit, NULL), NULL);
        p->picked[0][x] = hit.primitive;
        p->picked[1][x] = hit.geometry;
    }
}

static cgt_image image_of(picture *p)
{
    return (cgt_image){.bytes = p->bytes, .channels = 4, .alpha = p->alpha, .linear = p->linear};
}

static void write_picture(FILE *file, const picture *p)
{
    if (fwrite(p, sizeof *p, 1, file) != 1)
        exit(4);
}

/* ---- One process --------------------------------------------------------------------------------------------- */

static void draw_alone(int shading, FILE *file)
{
    static arrays a;
    static picture p;
    static float floats[BALLS][4];
    cgt_context *context;
    cgt_picture *drawn;
    cgt_picture_options options;
    cgt_camera camera;
    shapes s;
    set_options(shading, &options, &camera);
    check(cgt_context_create(NULL, &context), NULL);
    check(cgt_picture_create(context, &options, &drawn), NULL);
    for (int frame = 0; frame < FRAMES; frame++) {
        cgt_scene *scene;
        make_arrays(&a, frame);
        const uint32_t count = describe(&a, shading, &s);
        for (uint32_t i = 0; i < a.balls; i++) {
            for (int c = 0; c < 3; c++)
                floats[i][c] = (float)(a.center[i][c] - 1e6);
            floats[i][3] = radii[a.type[i]];
        }
        const cgt_spheres spheres = {
            .count = a.balls, .centers = cgt_floats(floats[0], 16), .radii = cgt_floats(floats[0] + 3, 16)};
        check(cgt_scene_create(context, NULL, &scene), NULL);
        check(cgt_scene_set_spheres(scene, NULL, shading == CGT_SHADING_BOUNCES ? &spheres : &s.spheres), NULL);
        check(cgt_scene_set_triangles(scene, NULL, &s.triangles), NULL);
        if (count > 2)
            check(cgt_scene_set_capsules(scene, NULL, &s.capsules), NULL);
        check(cgt_scene_commit(scene), NULL);
        const cgt_image image = image_of(&p);
        check(cgt_picture_draw(drawn, scene, &camera, s.looks, count, &image, NULL), NULL);
        pick(scene, &camera, &p);
        write_picture(file, &p);
        cgt_scene_release(scene);
    }
    cgt_picture_release(drawn);
    cgt_context_release(context);
}

/* ---- The ranks of a job -------------------------------------------------------------------------------------- */

typedef struct job {
    cgt_mpi *mpi;
    int rank, ranks, deal, by_ids, rows, dies;
    int shading;
    cgt_picture_options options;
    cgt_camera camera;
} job;

static void gather(const job *j, int frame)
{
    static arrays all, mine;
    static shapes s;
    make_arrays(&all, frame);
    take_share(&all, &mine, j->deal, j->by_ids, j->rank, j->ranks);
    const uint32_t count = describe(&mine, j->shading, &s);
    const cgt_mpi_geometry geometries[GEOMETRIES] = {
        {.spheres = &s.spheres, .ids = j->by_ids ? mine.ball_id : NULL, .look = &s.looks[0]},
        {.triangles = &s.triangles, .ids = j->by_ids ? mine.facet_id : NULL, .look = &s.looks[1]},
        {.capsules = &s.capsules, .ids = j->by_ids ? mine.stick_id : NULL, .look = &s.looks[2]}};
    check(cgt_mpi_gather(j->mpi, geometries, count), j->mpi);
    memset(&mine, 0x55, sizeof mine); /* nobody reads the arrays any more */
}

/* Rows that stay where they are made, put together: each is made once, and the others are left alone. */
static void draw_rows(const job *j, picture *p)
{
    static picture part;
    uint32_t first, rows;
    memset(&part, 0, sizeof part);
    const cgt_image image = image_of(&part);
    check(cgt_mpi_draw_rows(j->mpi, &j->options, &j->camera, &image, &first, &rows), j->mpi);
    for (uint32_t i = 0; i < PIXELS; i++)
        if (i / WIDTH - first >= rows && (part.alpha[i] || part.linear[i].a != 0.0f))
            exit(5);
    MPI_Reduce(&part, p, sizeof part, MPI_BYTE, MPI_BOR, 0, MPI_COMM_WORLD);
}

static void draw_together(job *j, FILE *file)
{
    static picture p;
    for (int frame = 0; frame < FRAMES; frame++) {
        if (j->dies && frame == 1 && j->rank == j->ranks - 1)
            raise(SIGKILL);
        gather(j, frame);
        const cgt_image image = image_of(&p);
        if (j->rows)
            draw_rows(j, &p);
        else
            check(cgt_mpi_draw(j->mpi, &j->options, &j->camera, j->rank ? NULL : &image), j->mpi);
        if (!cgt_mpi_get_scene(j->mpi) && j->rank == 0)
            exit(6);
        if (j->rank)
            continue;
        pick(cgt_mpi_get_scene(j->mpi), &j->camera, &p);
        write_picture(file, &p);
    }
}

int main(int argc, char **argv)
{
    job j = {.shading = argc > 3 ? atoi(argv[2]) : 0};
    if (argc < 4)
        return 2;
    if (strcmp(argv[1], "one") == 0) {
        FILE *const file = fopen(argv[3], "wb");
        if (!file)
            return 4;
        draw_alone(j.shading, file);
        return fclose(file) ? 4 : 0;
    }
    MPI_Init(&argc, &argv);
    if (argc < 7)
        return 2;
    MPI_Comm_rank(MPI_COMM_WORLD, &j.rank);
    MPI_Comm_size(MPI_COMM_WORLD, &j.ranks);
    const cgt_mpi_options options = {.ranks_per_leader = (uint32_t)atoi(argv[4]),
                                     .exchange_bytes = (size_t)atol(argv[5])};
    j.deal = atoi(argv[6]);
    j.by_ids = strcmp(argv[1], "deal") != 0;
    j.rows = strcmp(argv[1], "rows") == 0;
    j.dies = strcmp(argv[1], "die") == 0;
    set_options(j.shading, &j.options, &j.camera);
    check(cgt_mpi_create(MPI_COMM_WORLD, &options, &j.mpi), NULL);
    FILE *const file = j.rank ? NULL : fopen(argv[3], "wb");
    if (!j.rank && !file)
        return 4;
    draw_together(&j, file);
    if (file && fclose(file))
        return 4;
    cgt_mpi_release(j.mpi);
    MPI_Finalize();
    return 0;
}
