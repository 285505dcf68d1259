/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A run of LAMMPS that draws itself: lammps-live INPUT STEPS EVERY [WIDTH HEIGHT] >frames.ppm
 * INPUT sets everything up but does not run. After each EVERY steps LAMMPS calls draw, which reads positions, radii and
 * types where LAMMPS has them and writes a picture, for instance to ffmpeg:
 *
 *   lammps-live in.melt 2000 20 | ffmpeg -f image2pipe -c:v ppm -i - -pix_fmt yuv420p melt.mp4
 *
 * Spheres without radii of their own have half a unit of length, a quarter where there are bonds. Of a bond that leaves
 * the periodic box, half goes from each of its atoms towards the nearest image of the other, so that it goes on at the
 * other side. Standard error tells which share of the processor's time the pictures took. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include <cgt/cgt.h>
#include <lammps/library.h>

/* The bonds of LAMMPS as capsules, one for each, and two for one that leaves the box. */
typedef struct sticks {
    uint32_t geometry, count, bonds, room; /* room: of bonds */
    int *table;                            /* type and both ids of each bond */
    double (*end)[2][3];
    int (*atom)[2];     /* whose colours both halves have */
    int *place, places; /* of the atom of each id; -1: none */
    double longest;     /* bond of the last picture */
} sticks;

typedef struct movie {
    void *lammps;
    cgt_context *context;
    cgt_scene *scene;
    uint32_t atoms; /* the geometry */
    sticks sticks;
    cgt_camera camera;
    cgt_light sun;
    cgt_frame frame;
    float *visibility;
    uint8_t *shadow, *rgb;
    unsigned pictures;
    clock_t time; /* of the processor, in draw */
} movie;

static const float type_color[][3] = {{0.02f, 0.25f, 0.45f}, {0.80f, 0.30f, 0.05f}, {0.05f, 0.45f, 0.25f},
                                      {0.85f, 0.55f, 0.02f}, {0.35f, 0.65f, 0.85f}, {0.70f, 0.25f, 0.45f}};

/* LAMMPS ends the process at its errors, unless it was built with exceptions. */
static bool told;
static void tell_log(void)
{
    if (!told)
        fputs("lammps-live: LAMMPS ended the run: the end of log.lammps tells why\n", stderr);
}

static void fail(const char *format, ...)
{
    va_list arguments;
    told = true;
    va_start(arguments, format);
    fputs("lammps-live: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    exit(EXIT_FAILURE);
}

static void check(const movie *m, cgt_result result)
{
    char message[256] = "";
    if (result == CGT_OK)
        return;
    cgt_context_get_error_message(m->context, message, sizeof message);
    fail("%s: %s", cgt_get_result_string(result), message);
}

static void check_lammps(void *lammps)
{
    char message[256];
    if (!lammps_has_error(lammps))
        return;
    lammps_get_last_error_message(lammps, message, sizeof message);
    fail("LAMMPS: %s", message);
}

static void *array_of(size_t count, size_t size)
{
    void *array = calloc(count, size);
    if (!array)
        fail("out of memory");
    return array;
}

/* ---- Bonds --------------------------------------------------------------------------------------------------- */

static uint32_t count_bonds(void *lammps)
{
    const void *bonds = lammps_extract_global(lammps, "nbonds");
    const bool is_long = lammps_extract_global_datatype(lammps, "nbonds") == LAMMPS_INT64;
    const int64_t count = !bonds ? 0 : is_long ? *(const int64_t *)bonds : *(const int *)bonds;
    if (count > INT32_MAX / 2)
        fail("%lld bonds are more than a scene can have", (long long)count);
    return (uint32_t)count;
}

/* Where each atom is in LAMMPS' arrays, by its id. */
static void find_places(sticks *s, int count, const int *ids)
{
    int most = 0;
    for (int i = 0; i < count; i++)
        most = ids[i] > most ? ids[i] : most;
    if (most >= s->places) {
        free(s->place);
        s->places = most + 1;
        s->place = array_of((size_t)s->places, sizeof *s->place);
    }
    for (int id = 0; id < s->places; id++)
        s->place[id] = -1;
    for (int i = 0; i < count; i++)
        s->place[ids[i]] = i;
}

static int place_of(const sticks *s, int id) { return id > 0 && id < s->places ? s->place[id] : -1; }

/* The edges of the box as LAMMPS has them, the second and the third tilted; 0 along walls. */
static void read_edges(void *lammps, double edge[3][3])
{
    double low[3], high[3];
    int periodic[3];
    lammps_extract_box(lammps, low, high, &edge[1][0], &edge[2][1], &edge[2][0], periodic, NULL);
    for (int a = 0; a < 3; a++)
        edge[a][a] = periodic[a] ? high[a] - low[a] : 0;
}

/* Adds a capsule from atom a by a share of the step to atom b; its other half has the colour of `far`. */
static void add_stick(sticks *s, double **x, int a, const double step[3], double share, int far)
{
    for (int c = 0; c < 3; c++) {
        s->end[s->count][0][c] = x[a][c];
        s->end[s->count][1][c] = x[a][c] + share * step[c];
    }
    s->atom[s->count][0] = a;
    s->atom[s->count++][1] = far;
}

static void add_bond(sticks *s, double edge[3][3], double **x, int a, int b)
{
    double step[3], length = 0;
    bool crosses = false;
    for (int c = 0; c < 3; c++)
        step[c] = x[b][c] - x[a][c];
    for (int e = 2; e >= 0; e--) { /* to the nearest image */
        const double images = edge[e][e] > 0 ? rint(step[e] / edge[e][e]) : 0;
        for (int c = 0; c <= e; c++)
            step[c] -= images * edge[e][c];
        crosses |= images != 0;
    }
    for (int c = 0; c < 3; c++)
        length += step[c] * step[c];
    add_stick(s, x, a, step, crosses ? 0.5 : 1, crosses ? a : b);
    if (crosses)
        add_stick(s, x, b, step, -0.5, b);
    s->bonds++;
    s->longest = fmax(s->longest, sqrt(length));
}

static void update_sticks(movie *m, int count, const int *ids, double **x)
{
    sticks *s = &m->sticks;
    const uint32_t bonds = count_bonds(m->lammps);
    double edge[3][3] = {{0}};
    s->count = s->bonds = 0;
    s->longest = 0;
    if (bonds > s->room) {
        free(s->table), free(s->end), free(s->atom);
        s->room = bonds;
        s->table = array_of(bonds, 3 * sizeof *s->table);
        s->end = array_of(bonds, 2 * sizeof *s->end); /* pages that are not used cost nothing */
        s->atom = array_of(bonds, 2 * sizeof *s->atom);
    }
    if (bonds) {
        find_places(s, count, ids);
        read_edges(m->lammps, edge);
        lammps_gather_bonds(m->lammps, s->table);
        check_lammps(m->lammps);
    }
    for (uint32_t k = 0; k < bonds; k++) {
        const int a = place_of(s, s->table[3 * k + 1]), b = place_of(s, s->table[3 * k + 2]);
        if (a >= 0 && b >= 0)
            add_bond(s, edge, x, a, b);
    }
    const cgt_capsules capsules = {.count = s->count,
                                   .vertex_count = 2 * s->count,
                                   .vertices = cgt_doubles(s->count ? s->end[0][0] : NULL, 0),
                                   .radius = 0.12f};
    check(m, cgt_scene_set_capsules(m->scene, &s->geometry, &capsules));
}

/* ---- Pictures ------------------------------------------------------------------------------------------------ */

/* Where LAMMPS has its atoms now: it moves its arrays when atoms change processors, or are sorted. */
static void update_atoms(movie *m, int count, double **x)
{
    const double *radius = lammps_extract_atom(m->lammps, "radius");
    const cgt_spheres atoms = {.count = (uint32_t)count,
                               .centers = cgt_doubles(count ? x[0] : NULL, 0),
                               .radii = cgt_doubles(radius, 0),
                               .radius = radius            ? 0
                                         : m->sticks.count ? 0.25f
                                                           : 0.5f};
    check(m, cgt_scene_set_spheres(m->scene, &m->atoms, &atoms));
}

/* Light from the sun and from the sky: linear, then encoded by a square root, which is near to sRGB. */
static void shade(const movie *m)
{
    const cgt_frame *f = &m->frame;
    const int *type = lammps_extract_atom(m->lammps, "type");
    const int colors = (int)(sizeof type_color / sizeof *type_color);
    const float *sun = m->sun.position, length = sqrtf(sun[0] * sun[0] + sun[1] * sun[1] + sun[2] * sun[2]);
    for (size_t i = 0; i < (size_t)f->width * f->height; i++) {
        const bool hit = f->primitive[i] != CGT_INVALID_ID;
        const bool on_stick = hit && f->geometry[i] == m->sticks.geometry;
        const int atom = !hit ? 0 : on_stick ? m->sticks.atom[f->primitive[i]][f->u[i] > 0.5f] : (int)f->primitive[i];
        const float *color = hit ? type_color[(type[atom] - 1) % colors] : NULL;
        float facing = 0;
        for (int a = 0; a < 3; a++)
            facing += f->normal[a][i] * sun[a] / length;
        const float light = 0.5f * m->visibility[i] + (m->shadow[i] || facing < 0 ? 0 : 0.9f * facing);
        for (size_t a = 0; a < 3; a++)
            m->rgb[3 * i + a] = hit ? (uint8_t)(255 * sqrtf(fminf(1, color[a] * light))) : 245;
    }
}

/* What LAMMPS calls from within its run, between two steps. The forces are added to the atoms': LAMMPS does not clear
 * them before. */
static void draw(void *user, int64_t step, int count, int *ids, double **x, double **force)
{
    movie *m = user;
    const cgt_ambient_options ambient = {.samples = 8, .radius = 4};
    const clock_t begin = clock();
    (void)step;
    for (int i = 0; i < count; i++)
        for (int a = 0; a < 3; a++)
            force[i][a] = 0.0;
    update_sticks(m, count, ids, x);
    update_atoms(m, count, x);
    check(m, cgt_scene_commit(m->scene));
    check(m, cgt_trace_camera(m->scene, &m->camera, &m->frame, NULL));
    check(m, cgt_occluded_frame(m->scene, &m->camera, &m->frame, &m->sun, 1, NULL, m->shadow, NULL));
    check(m, cgt_ambient_occlusion(m->scene, &m->camera, &m->frame, &ambient, m->visibility, NULL));
    shade(m);
    printf("P6 %u %u 255\n", m->frame.width, m->frame.height);
    if (fwrite(m->rgb, 3, (size_t)m->frame.width * m->frame.height, stdout) == 0 || fflush(stdout))
        fail("standard output: write failed");
    m->pictures++;
    m->time += clock() - begin;
}

static void open_movie(movie *m, uint32_t width, uint32_t height)
{
    const size_t pixels = (size_t)width * height;
    const cgt_spheres no_atoms = {0};
    const cgt_capsules no_sticks = {0};
    check(m, cgt_context_create(NULL, &m->context));
    check(m, cgt_scene_create(m->context, NULL, &m->scene));
    m->atoms = m->sticks.geometry = CGT_INVALID_ID;
    check(m, cgt_scene_set_spheres(m->scene, &m->atoms, &no_atoms));
    check(m, cgt_scene_set_capsules(m->scene, &m->sticks.geometry, &no_sticks));
    cgt_frame_init(&m->frame, width, height);
    m->frame.t = array_of(pixels, sizeof(float));
    m->frame.primitive = array_of(pixels, sizeof(uint32_t));
    m->frame.geometry = array_of(pixels, sizeof(uint32_t));
    m->frame.u = array_of(pixels, sizeof(float));
    m->frame.v = array_of(pixels, sizeof(float));
    for (int a = 0; a < 3; a++)
        m->frame.normal[a] = array_of(pixels, sizeof(float));
    m->visibility = array_of(pixels, sizeof(float));
    m->shadow = array_of(pixels, 1);
    m->rgb = array_of(pixels, 3);
}

/* Looks at the box's middle from a corner, far enough to see all of it. */
static void place_camera(movie *m)
{
    static const float from[3] = {0.62f, -0.70f, 0.36f};
    double low[3], high[3], edge = 0;
    lammps_extract_box(m->lammps, low, high, NULL, NULL, NULL, NULL, NULL);
    for (int a = 0; a < 3; a++)
        edge += (high[a] - low[a]) * (high[a] - low[a]);
    for (int a = 0; a < 3; a++) {
        m->camera.target[a] = (float)(0.5 * (low[a] + high[a]));
        m->camera.eye[a] = m->camera.target[a] + 2.0f * (float)sqrt(edge) * from[a];
    }
    m->camera.up[2] = 1;
    m->camera.fov = 30;
    m->sun = (cgt_light){CGT_LIGHT_DIRECTIONAL, {0.3f, -0.8f, 1}};
}

/* A number of the command line, from 1 to `most`. */
static int number(const char *text, int most)
{
    char *end;
    const long value = strtol(text, &end, 10);
    if (end == text || *end || value < 1 || value > most)
        fail("'%s' is not a whole number from 1 to %d", text, most);
    return (int)value;
}

int main(int argc, char **argv)
{
    static char *quiet[] = {"lammps-live", "-screen", "none"}; /* standard output has the pictures */
    movie m = {0};
    char command[80];
    if (argc != 4 && argc != 6)
        fail("usage: lammps-live INPUT STEPS EVERY [WIDTH HEIGHT] >frames.ppm");
    const int steps = number(argv[2], INT32_MAX), every = number(argv[3], INT32_MAX);
    open_movie(&m, argc == 6 ? (uint32_t)number(argv[4], 16384) : 1280,
               argc == 6 ? (uint32_t)number(argv[5], 16384) : 720);
    atexit(tell_log);
    m.lammps = lammps_open_no_mpi(3, quiet, NULL);
    if (!m.lammps)
        fail("LAMMPS does not start");
    lammps_file(m.lammps, argv[1]);
    check_lammps(m.lammps);
    place_camera(&m);
    snprintf(command, sizeof command, "fix cgt all external pf/callback %d %d", every, every);
    lammps_command(m.lammps, command);
    check_lammps(m.lammps);
    lammps_set_fix_external_callback(m.lammps, "cgt", draw, &m);
    snprintf(command, sizeof command, "run %d", steps);
    const clock_t begin = clock();
    lammps_command(m.lammps, command);
    check_lammps(m.lammps);
    const double all = (double)(clock() - begin);
    fprintf(stderr, "%.0f atoms, %u pictures: %.2f %% of the run's %.1f s\n", lammps_get_natoms(m.lammps), m.pictures,
            100.0 * (double)m.time / all, all / CLOCKS_PER_SEC);
    if (m.sticks.bonds)
        fprintf(stderr, "%u bonds, the longest %.3g\n", m.sticks.bonds, m.sticks.longest);
    lammps_close(m.lammps);
    told = true;
    cgt_scene_release(m.scene);
    cgt_context_release(m.context);
    free(m.frame.t), free(m.frame.primitive), free(m.frame.geometry), free(m.frame.u), free(m.frame.v);
    for (int a = 0; a < 3; a++)
        free(m.frame.normal[a]);
    free(m.visibility), free(m.shadow), free(m.rgb);
    free(m.sticks.table), free(m.sticks.end), free(m.sticks.atom), free(m.sticks.place);
}
