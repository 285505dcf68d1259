/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The viewer without a window: cameras, what is under a pixel beside a brute force, quality at rest, memory of frames,
 * any events. */
#define _GNU_SOURCE
#include "support/suite.h"
#include "support/test.h"

#include <math.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "view/viewer/viewer_internal.h"

enum { SPHERES = 200, FRAMES = 12, WIDTH = 96, HEIGHT = 64 };

static char folder[] = "viewer_XXXXXX";
static char path[64];
static const char *inputs[] = {path};
static float spheres[SPHERES][4];
static double clock_now;

/* Frame i is moved by i along x; ids run backwards, so that they are not the numbers. */
static int write_run(void **state)
{
    (void)state;
    test_random random = random_make(1);
    FILE *const file = mkdtemp(folder) && chdir(folder) == 0 ? fopen("run.lammpstrj", "w") : NULL;
    if (!file)
        return -1;
    snprintf(path, sizeof path, "run.lammpstrj");
    for (int i = 0; i < SPHERES; i++) {
        for (int c = 0; c < 3; c++)
            spheres[i][c] = floorf(random_float(&random, 0.0f, 640.0f)) / 64.0f;
        spheres[i][3] = (float)(1 + random_below(&random, 7)) / 8.0f;
    }
    for (int frame = 0; frame < FRAMES; frame++) {
        fprintf(file,
                "ITEM: TIMESTEP\n%d\nITEM: NUMBER OF ATOMS\n%d\nITEM: BOX BOUNDS pp pp pp\n0 100\n0 100\n0 100\n"
                "ITEM: ATOMS id type x y z radius q\n",
                10 * frame, SPHERES);
        for (int i = 0; i < SPHERES; i++)
            fprintf(file, "%d %d %.9g %.9g %.9g %.9g %d\n", SPHERES - i, i % 3 + 1, (double)spheres[i][0] + frame,
                    (double)spheres[i][1], (double)spheres[i][2], (double)spheres[i][3], i * 2);
    }
    return fclose(file);
}

static int remove_run(void **state)
{
    (void)state;
    return system("rm -f ./*") == 0 && chdir("..") == 0 && rmdir(folder) == 0 ? 0 : -1;
}

static viewer *waiting; /* the one that was opened last */

/* What a test does where a step goes on and has a picture; NULL: nothing. */
static void (*on_picture)(void);

static void wake(void *user, int has_picture)
{
    (void)user;
    if (has_picture && on_picture)
        on_picture();
}

static void on_frames(void *user) { (void)user; }

static const char *settings = "ambient = 16\n";
static uint64_t survey_of = VIEW_SURVEY_AUTO; /* frames */
static double follow_of;                      /* seconds */

static viewer *open_viewer(uint32_t memory)
{
    view_options o = {.budget = 16.0f, .pictures = "view_%04d.png", .keys = "camera.keys"};
    render_options_init(&o.render);
    o.render.inputs = inputs;
    o.render.input = path;
    o.render.input_count = 1;
    o.render.no_images = 1;
    o.render.figure.width = WIDTH;
    o.render.figure.height = HEIGHT;
    o.render.settings = strdup(settings);
    o.render.output.survey = survey_of;
    o.render.reading.follow = follow_of;
    o.render.threads = 2;
    o.render.memory_mib = memory;
    viewer *const v = waiting = viewer_create(&o, wake, NULL);
    assert_non_null(v);
    viewer_step(v, clock_now);
    assert_false(viewer_has_failed(v));
    return v;
}

/* Steps until nothing changes any more; time passes a millisecond a step. */
static void settle(viewer *v)
{
    for (int i = 0; i < 100000 && !viewer_is_settled(v); i++) {
        clock_now += 0.05;
        if (viewer_step(v, clock_now) > 0.0)
            usleep(200); /* for the thread that reads */
    }
    assert_true(viewer_is_settled(v));
    viewer_step(v, clock_now);
}

static void key(viewer *v, int name, int shift)
{
    const view_event e = {.kind = VIEW_KEY, .key = name, .shift = shift};
    viewer_send(v, &e);
    viewer_step(v, clock_now);
}

static void button(viewer *v, view_event_kind kind, int clicks, float x, float y)
{
    const view_event e = {.kind = kind, .button = 1, .clicks = clicks, .x = x, .y = y};
    viewer_send(v, &e);
    viewer_step(v, clock_now);
}

static void click(viewer *v, float x, float y)
{
    button(v, VIEW_PRESS, 1, x, y);
    button(v, VIEW_RELEASE, 1, x, y);
}

static void drag(viewer *v, float x, float y, float to_x, float to_y)
{
    button(v, VIEW_PRESS, 1, x, y);
    button(v, VIEW_MOVE, 1, to_x, to_y);
    button(v, VIEW_RELEASE, 1, to_x, to_y);
}

/* ---- Cameras ------------------------------------------------------------------------------------------------ */

static cgt_camera random_camera(test_random *r)
{
    cgt_camera c;
    cgt_camera_init(&c);
    for (int k = 0; k < 3; k++) {
        c.eye[k] = random_float(r, -10.0f, 10.0f);
        c.target[k] = c.eye[k];
        c.up[k] = k == 2;
    }
    float direction[3];
    random_direction(r, direction);
    for (int k = 0; k < 3; k++)
        c.target[k] += 5.0f * direction[k];
    c.fov = random_float(r, 10.0f, 60.0f);
    view_camera_straighten(&c);
    return c;
}

static double distance(const float a[3], const float b[3])
{
    double sum = 0.0;
    for (int k = 0; k < 3; k++)
        sum += ((double)a[k] - (double)b[k]) * ((double)a[k] - (double)b[k]);
    return sqrt(sum);
}

/* What the camera turns about, and what it zooms to, stays where it is in the picture. */
TEST(cameras_keep_their_point)
{
    const float axis[3] = {0.0f, 0.0f, 1.0f};
    test_random r = random_make(2);
    for (int i = 0; i < 1000; i++) {
        cgt_camera c = random_camera(&r);
        float place[3], before[2], after[2];
        view_camera_place(&c, 1.5f, random_float(&r, 0.0f, 1.0f), random_float(&r, 0.0f, 1.0f), place);
        assert_true(view_camera_project(&c, 0, 1.5f, place, before));
        const double far = distance(c.eye, place);
        view_camera_turn(&c, place, axis, random_float(&r, -1.0f, 1.0f), random_float(&r, -1.0f, 1.0f));
        assert_true(fabs(distance(c.eye, place) - far) < 1e-4 * far);
        assert_true(view_camera_project(&c, 0, 1.5f, place, after));
        assert_true(fabsf(after[0] - before[0]) < 1e-3f && fabsf(after[1] - before[1]) < 1e-3f);
        assert_true(c.up[2] > -1e-4f); /* never upside down */
        view_camera_zoom(&c, place, 0.5f);
        assert_true(fabs(distance(c.eye, place) - 0.5 * far) < 1e-4 * far);
        assert_true(view_camera_project(&c, 0, 1.5f, place, after));
        assert_true(fabsf(after[0] - before[0]) < 1e-3f && fabsf(after[1] - before[1]) < 1e-3f);
        view_camera_pan(&c, 30.0f, 10.0f, 100); /* by 0.2 of the width, 0.1 of the height */
        view_camera_place(&c, 1.5f, 0.5f, 0.5f, place);
        assert_true(distance(place, c.target) < 1e-4);
    }
}

/* Dragging up turns the eye up, to the right turns it to the left; the axis' end is the end. */
TEST(turns_go_the_way_of_the_hand)
{
    const float axis[3] = {0.0f, 0.0f, 1.0f}, zero[3] = {0.0f};
    cgt_camera c;
    cgt_camera_init(&c);
    memcpy(c.eye, (const float[]){0.0f, -5.0f, 0.0f}, sizeof c.eye);
    memcpy(c.up, axis, sizeof c.up);
    view_camera_turn(&c, zero, axis, 0.5f, 0.0f);
    assert_true(c.eye[0] < -2.0f && c.eye[1] < 0.0f);
    view_camera_turn(&c, zero, axis, -0.5f, 0.5f);
    assert_true(c.eye[2] > 2.0f && fabsf(c.eye[0]) < 1e-3f);
    view_camera_turn(&c, zero, axis, 0.0f, 9.0f);
    assert_true(c.eye[2] > 4.99f);
    assert_true(c.up[1] > 0.99f);
}

/* ---- Picking ------------------------------------------------------------------------------------------------ */

/* The nearest sphere but `without` along a pixel's ray in double: -1 none, -2 too near to tell. */
static int brute_force(const view_frame *f, const cgt_camera *camera, uint32_t x, uint32_t y, int without)
{
    float org[3], dir[3];
    double nearest = INFINITY, second = INFINITY;
    int found = -1, grazes = 0;
    assert_int_equal(cgt_camera_get_ray(camera, WIDTH, HEIGHT, x, y, org, dir), CGT_OK);
    for (uint32_t i = 0; i < f->frame.count; i++) {
        const float *const s = f->frame.xyzr + 4 * (size_t)i;
        double a = 0.0, b = 0.0, c = -(double)s[3] * (double)s[3];
        for (int k = 0; k < 3; k++) {
            const double o = (double)org[k] - (double)s[k], d = (double)dir[k];
            a += d * d;
            b += o * d;
            c += o * o;
        }
        const double root = b * b - a * c;
        grazes |= fabs(root) < 1e-6 * b * b;
        if (root < 0.0 || (int)i == without)
            continue;
        const double t = (-b - sqrt(root)) / a;
        if (t <= 0.0)
            continue;
        second = fmin(second, fmax(t, nearest));
        if (t < nearest) {
            nearest = t;
            found = (int)i;
        }
    }
    return grazes || second - nearest < 1e-6 * nearest ? -2 : found;
}

static void try_clicks(void)
{
    viewer *const v = open_viewer(64);
    test_random r = random_make(3);
    uint32_t hits = 0, misses = 0;
    settle(v);
    for (uint32_t i = 0; i < 400; i++) {
        if (i % 100 == 0) {
            key(v, VIEW_KEY_RIGHT, 0);
            drag(v, 20.0f, 30.0f, random_float(&r, 0.0f, 90.0f), random_float(&r, 0.0f, 40.0f));
            settle(v);
        }
        const uint32_t x = random_below(&r, WIDTH), y = random_below(&r, HEIGHT - 23); /* above the bar */
        const int wanted = brute_force(v->shown, &v->camera, x, y, -1);
        if (wanted == -2)
            continue;
        key(v, VIEW_KEY_ESCAPE, 0);
        click(v, (float)x + 0.5f, (float)y + 0.5f);
        assert_int_equal(v->picks, wanted >= 0);
        hits += wanted >= 0;
        misses += wanted < 0;
        if (wanted < 0)
            continue;
        char text[512], name[64];
        assert_int_equal(v->pick[0].element, wanted);
        viewer_describe(v, text, sizeof text);
        snprintf(name, sizeof name, "selected sphere %d, id %d, type %d", wanted, SPHERES - wanted, wanted % 3 + 1);
        assert_non_null(strstr(text, name));
    }
    assert_true(hits > 50 && misses > 50);
    viewer_free(v);
}

/* Some of it seen through. */
TEST(clicks_select_what_is_hit)
{
    try_clicks();
    settings = "ambient = 16\nopacity = mod(index, 3) == 1=0.4\n";
    try_clicks();
    settings = "ambient = 16\n";
}

/* What is selected is followed by its id; columns, distance and angle are told. */
TEST(selection_tells_and_follows)
{
    viewer *const v = open_viewer(64);
    char lines[32][128];
    settle(v);
    v->picks = 1;
    v->pick[0] = (view_pick){.element = 7, .id = SPHERES - 7};
    key(v, VIEW_KEY_RIGHT, 0);
    settle(v);
    assert_int_equal(v->pick[0].element, 7);
    assert_true(fabsf(v->pick[0].place[0] - spheres[7][0] - 1.0f) < 1e-4f);
    uint32_t count = viewer_pick_lines(v, lines, 32);
    int has_column = 0;
    for (uint32_t i = 0; i < count; i++)
        has_column |= strcmp(lines[i], "q  14") == 0;
    assert_true(has_column);
    v->picks = 3;
    for (int i = 0; i < 3; i++)
        v->pick[i] = (view_pick){.element = (uint32_t)i, .place = {i == 0 ? 3.0f : 0.0f, i == 2 ? 4.0f : 0.0f, 0.0f}};
    count = viewer_pick_lines(v, lines, 32);
    assert_true(count > 2);
    assert_string_equal(lines[count - 2], "distance of the last  4");
    assert_string_equal(lines[count - 1], "angle at the second  90 degrees");
    v->picks = 4;
    v->pick[3] = (view_pick){.element = 3, .place = {0.0f, 4.0f, 98.0f}}; /* through the box's boundary */
    count = viewer_pick_lines(v, lines, 32);
    assert_string_equal(lines[count - 3], "distance of the last  2");
    assert_string_equal(lines[count - 1], "dihedral about the middle two  90 degrees");
    viewer_free(v);
}

/* A bond is its two ends; a second click on a sphere takes it back. */
TEST(bonds_and_clicks)
{
    settings = "ambient = 0\nview = top\nbonds = 1.6\nbond-radius = 0.2\nradius-scale = 0.2\n";
    FILE *const file = fopen("two.xyz", "w");
    assert_non_null(file);
    fputs("3\n\nC -0.75 0 0\nC 0.75 0 0\nO 0.75 5 0\n", file);
    assert_int_equal(fclose(file), 0);
    snprintf(path, sizeof path, "two.xyz");
    viewer *const v = open_viewer(16);
    settings = "ambient = 16\n";
    settle(v);
    float at[3][2], middle[2];
    const float places[3][3] = {{-0.75f, 0.0f, 0.0f}, {0.75f, 0.0f, 0.0f}, {0.75f, 5.0f, 0.0f}};
    for (int i = 0; i < 3; i++) {
        assert_true(view_camera_project(&v->camera, 0, (float)WIDTH / HEIGHT, places[i], at[i]));
        at[i][0] *= WIDTH;
        at[i][1] *= HEIGHT;
    }
    middle[0] = 0.5f * (at[0][0] + at[1][0]);
    middle[1] = 0.5f * (at[0][1] + at[1][1]);
    click(v, middle[0], middle[1]);
    assert_int_equal(v->picks, 2);
    assert_int_equal(v->pick[0].element + v->pick[1].element, 1);
    char lines[32][128];
    const uint32_t count = viewer_pick_lines(v, lines, 32);
    assert_string_equal(lines[count - 2], "a bond of these two");
    assert_string_equal(lines[count - 1], "distance  1.5");
    /* without a distance they are guessed, which needs another reading */
    assert_int_equal(viewer_unset(v, "bonds"), 0);
    assert_int_equal(viewer_set(v, "bonds", NULL), 0);
    settle(v);
    click(v, at[2][0], at[2][1]);
    assert_int_equal(v->picks, 3);
    click(v, at[0][0], at[0][1]);
    assert_int_equal(v->picks, 2);
    assert_int_equal(v->pick[1].element, 2);
    viewer_free(v);
    snprintf(path, sizeof path, "run.lammpstrj");
}

/* A sphere that is hidden is not hit; all are back with a, also after the file was read anew. */
TEST(hiding)
{
    viewer *const v = open_viewer(64);
    settle(v);
    uint32_t x = 0, y = 0;
    int first = -1;
    for (y = 10; y < HEIGHT - 23 && first < 0; y++)
        for (x = 0; x < WIDTH && first < 0; x++) { /* with one of a higher number behind it */
            first = brute_force(v->shown, &v->camera, x, y, -1);
            const int next = first >= 0 ? brute_force(v->shown, &v->camera, x, y, first) : -1;
            first = next > first ? first : -1;
        }
    assert_true(first >= 0);
    x--, y--;
    click(v, (float)x + 0.5f, (float)y + 0.5f);
    assert_int_equal(v->pick[0].element, first);
    key(v, 'd', 0);
    settle(v);
    click(v, (float)x + 0.5f, (float)y + 0.5f);
    const int behind = brute_force(v->shown, &v->camera, x, y, first);
    assert_int_equal(v->picks, behind >= 0);
    if (behind >= 0)
        assert_int_equal(v->pick[0].element, behind);
    key(v, 'r', 0);
    settle(v);
    key(v, VIEW_KEY_ESCAPE, 0);
    key(v, 'a', 0);
    settle(v);
    click(v, (float)x + 0.5f, (float)y + 0.5f);
    assert_int_equal(v->pick[0].element, first);
    viewer_free(v);
}

/* In a window where more rows fit than a panel has, a click takes the row that is seen there. */
TEST(the_list_is_as_it_is_seen)
{
    enum { NAMES = 100, ROWS = 64, AT = 80 };
    viewer *const v = open_viewer(64);
    settle(v);
    v->list = 1;
    v->list_count = NAMES;
    v->list_at = AT;
    v->height = 3000;
    const float x = (float)v->width - 20.0f, first = 12.0f + 4.0f + 9.0f, line = 18.0f;
    assert_int_equal(viewer_list_row(v, x, first), AT - ROWS + 1);
    assert_int_equal(viewer_list_row(v, x, first + line * (ROWS - 1)), AT);
    assert_int_equal(viewer_list_row(v, x, first + line * ROWS), -1);
    v->height = HEIGHT;
    v->list = 0;
    viewer_free(v);
}

/* ---- Pictures ----------------------------------------------------------------------------------------------- */

/* Pictures grow at rest, fall back where something moves, and what is sent is what differs. */
TEST(pictures_grow_at_rest)
{
    viewer *const v = open_viewer(64);
    view_picture p;
    settle(v);
    assert_int_equal(v->quality, VIEW_FULL);
    viewer_take(v, &p);
    assert_int_equal(p.width, WIDTH);
    uint32_t *const seen = malloc(sizeof *seen * WIDTH * HEIGHT);
    assert_non_null(seen);
    memcpy(seen, p.pixels, sizeof *seen * WIDTH * HEIGHT);
    viewer_give_back(v);
    drag(v, 20.0f, 10.0f, 40.0f, 20.0f);
    assert_true(v->quality < VIEW_FULL);
    assert_false(viewer_is_settled(v));
    assert_true(viewer_step(v, clock_now) > 0.0); /* waits for the hand */
    settle(v);
    viewer_take(v, &p);
    for (uint32_t i = 0; i < p.rect_count; i++)
        for (uint32_t y = p.rects[i].y; y < p.rects[i].y + p.rects[i].height; y++)
            memcpy(seen + y * WIDTH + p.rects[i].x, p.pixels + y * WIDTH + p.rects[i].x,
                   p.rects[i].width * sizeof *seen);
    assert_memory_equal(seen, p.pixels, sizeof *seen * WIDTH * HEIGHT);
    viewer_give_back(v);
    viewer_step(v, clock_now);
    viewer_take(v, &p);
    assert_int_equal(p.rect_count, 0); /* nothing has changed */
    viewer_give_back(v);
    free(seen);
    viewer_free(v);
}

/* ---- Options ------------------------------------------------------------------------------------------------ */

static uint64_t sum(viewer *v)
{
    uint64_t total = 0;
    for (size_t i = 0; i < 3 * (size_t)WIDTH * HEIGHT; i++)
        total = total * 31 + v->rgb[i];
    return total;
}

/* Any option may be set while a frame is shown, the last two by reading anew; what is refused says why, and changes
 * nothing. */
TEST(options_are_set_in_the_window)
{
    static const char *const options[][2] = {{"style", "paper"},     {"color", "q"},  {"bonds", "0.9"},
                                             {"show", "type > 1"},   {"ortho", NULL}, {"background", "white"},
                                             {"radius-by", "q/300"}, {"box", NULL},   {"trails", "3"},
                                             {"type-element", "1=O"}};
    static const char *const wrong[][2] = {
        {"size", "10 x 10"}, {"color", "no_such"}, {"trails", "0"}, {"fill", "much"}, {"nothing", "1"}};
    viewer *const v = open_viewer(64);
    settle(v);
    key(v, VIEW_KEY_END, 0);
    settle(v);
    const cgt_camera camera = v->camera;
    const uint64_t before = sum(v);
    for (size_t i = 0; i < TEST_COUNT(options); i++) {
        assert_int_equal(viewer_set(v, options[i][0], options[i][1]), 0);
        settle(v);
        assert_true(sum(v) != before);
        assert_memory_equal(&v->camera, &camera, sizeof camera);
        assert_int_equal(viewer_unset(v, options[i][0]), 0);
        settle(v);
        assert_true(sum(v) == before);
    }
    for (size_t i = 0; i < TEST_COUNT(wrong); i++) {
        assert_int_equal(viewer_set(v, wrong[i][0], wrong[i][1]), -1);
        assert_true(v->messages > 0);
        settle(v);
        assert_false(v->scene_is_wrong);
        assert_true(sum(v) == before);
    }
    assert_int_equal(viewer_set(v, "view", "top"), 0); /* in place of the hand's */
    assert_true(v->camera.target[2] < v->camera.eye[2] - 1.0f && fabsf(v->camera.eye[0] - v->camera.target[0]) < 1e-3f);
    viewer_free(v);
}

static void send_text(viewer *v, view_event_kind kind, const char *text)
{
    const view_event e = {.kind = kind, .text = text ? strdup(text) : NULL};
    viewer_send(v, &e);
    viewer_step(v, clock_now);
}

static void expect_selection(viewer *v, const char *expected)
{
    char *const text = viewer_copy_selection(v);
    assert_non_null(strstr(text, expected));
    free(text);
}

TEST(selections)
{
    viewer *const v = open_viewer(64);
    settle(v);
    const uint64_t before = sum(v);
    send_text(v, VIEW_SELECT, "q >= 100"); /* not the first */
    expect_selection(v, "150 of 200 spheres");
    send_text(v, VIEW_SELECT, "q");
    send_text(v, VIEW_USE, "hide");
    settle(v);
    assert_true(sum(v) != before);
    key(v, 'u', 0);
    send_text(v, VIEW_SELECT, "no_such > 1");
    expect_selection(v, "no column \"no_such\"");
    send_text(v, VIEW_USE, "hide"); /* nothing */
    settle(v);
    assert_true(sum(v) == before);
    static const char *const uses[] = {"hide", "show", "fade", "label"};
    for (size_t i = 0; i < TEST_COUNT(uses); i++) {
        send_text(v, VIEW_SELECT, "type == 2");
        send_text(v, VIEW_USE, uses[i]);
        settle(v);
        if (i < 3) /* a small window has no room for labels */
            assert_true(sum(v) != before);
        key(v, 'u', 0);
        settle(v);
        assert_true(sum(v) == before);
    }
    /* all move by 1 along x with each frame */
    const cgt_camera camera = v->camera;
    send_text(v, VIEW_USE, "follow");
    key(v, VIEW_KEY_RIGHT, 0);
    settle(v);
    assert_true(fabsf(v->camera.eye[0] - camera.eye[0] - 1.0f) < 1e-3f);
    assert_true(fabsf(v->camera.target[1] - camera.target[1]) < 1e-3f);
    send_text(v, VIEW_USE, "follow");
    key(v, VIEW_KEY_RIGHT, 0);
    settle(v);
    assert_true(fabsf(v->camera.eye[0] - camera.eye[0] - 1.0f) < 1e-3f);

    v->picks = 2;
    v->pick[0] = (view_pick){.element = 0, .id = 200};
    v->pick[1] = (view_pick){.element = 9, .id = 191};
    send_text(v, VIEW_SELECT, NULL);
    expect_selection(v, "2 of 200 spheres");
    char *const formula = viewer_take_formula(v);
    assert_string_equal(formula, "id == 200 or id == 191");
    free(formula);
    viewer_free(v);
}

static void expect_option(viewer *v, const char *name, const char *lines)
{
    char *const text = view_draw_get(v->draw, cgt_figure_get, name);
    assert_string_equal(text, lines);
    free(text);
}

/* What one key has changed comes back at once, and what cannot come back yet by the next undo. */
TEST(changes_are_undone)
{
    settings = "ambient = 16\ntrails = 2\nshow = z < 5\ncolor = q\nrange = 0,100\n";
    viewer *const v = open_viewer(64);
    settings = "ambient = 16\n";
    settle(v);
    assert_int_equal(viewer_set(v, "style", "paper"), 0);
    const view_event next = {.kind = VIEW_KEY, .key = VIEW_KEY_RIGHT};
    viewer_send(v, &next);
    key(v, 'u', 0); /* before the frame is there */
    expect_option(v, "style", "paper\n");
    settle(v);
    key(v, 'u', 0);
    expect_option(v, "style", "");

    key(v, 'l', 0);
    key(v, VIEW_KEY_UP, 0);
    key(v, VIEW_KEY_ENTER, 0);
    expect_option(v, "range", "");
    key(v, 'u', 0);
    expect_option(v, "range", "0,100\n");
    expect_option(v, "color", "q\n");

    v->picks = 1;
    v->pick[0] = (view_pick){.element = 7, .id = SPHERES - 7};
    key(v, 'd', 0);
    key(v, 'a', 0);
    expect_option(v, "show", "z < 5\n");
    key(v, 'u', 0);
    expect_option(v, "show", "z < 5\nid != 193\n");
    viewer_free(v);
}

static void expect_message(viewer *v, const char *part) { assert_non_null(strstr(v->message[0].text, part)); }

/* However many files there are; without a place for its log it is not made. */
TEST(movies_of_many_files)
{
    enum { MANY = 5000 };
    static const char *many[MANY];
    viewer *const v = open_viewer(64);
    settle(v);
    for (int i = 0; i < MANY; i++)
        many[i] = path;
    v->options.render.inputs = many;
    v->options.render.input_count = MANY;
    setenv("TMPDIR", "/nonexistent", 1);
    key(v, 'm', 0);
    unsetenv("TMPDIR");
    assert_false(v->movie.is_made);
    expect_message(v, "no temporary file for a movie: ");
    key(v, 'm', 0);
    if (!v->movie.is_made)
        expect_message(v, "cgt-render cannot be started: ");
    viewer_free(v);
}

/* ---- Frames ------------------------------------------------------------------------------------------------- */

TEST(frames_stay_within_memory)
{
    viewer *const v = open_viewer(16);
    view_frames_state s;
    settle(v);
    for (int i = 0; i < 3 * FRAMES; i++) {
        key(v, i % 5 == 4 ? VIEW_KEY_LEFT : VIEW_KEY_RIGHT, 0);
        settle(v);
        view_frames_get(v->frames, &s);
        assert_true(s.bytes <= (size_t)16 << 20);
        assert_true(fabsf(v->shown->frame.xyzr[0] - spheres[0][0] - (float)v->shown->frame.number) < 1e-4f);
    }
    assert_int_equal(s.count, FRAMES);
    assert_true(s.is_final);
    viewer_free(v);
}

/* Less memory than the run takes: the frames are those of a run that is kept whole. */
TEST(little_memory_loses_no_frame)
{
    view_frames_state s;
    viewer *const v = open_viewer(64);
    settle(v);
    const size_t frame = v->shown->bytes;
    view_frames_finish(v->frames);
    frame_sequence sequence = {0};
    frame_source source;
    char error[256];
    cgt_trajectory_options reading;
    cgt_trajectory_options_init(&reading);
    assert_int_equal(frame_source_open(&source, &sequence, inputs, 1, &reading, error, sizeof error), 0);
    assert_int_equal(figure_run_want_all(&source, error, sizeof error), 1);
    const view_frames_options o = {.figure = v->draw->figure,
                                   .paths = inputs,
                                   .path_count = 1,
                                   .reading = &reading,
                                   .range = {1, UINT64_MAX - 1, 2},
                                   .memory = 3 * frame,
                                   .wake = on_frames};
    v->frames = view_frames_start(&source, &o);
    v->shown = NULL; /* it was one of the frames that are gone */
    assert_non_null(v->frames);
    test_random r = random_make(4);
    for (int i = 0; i < 60; i++) {
        const uint64_t chosen = random_below(&r, FRAMES / 2);
        view_frame *f = NULL;
        for (int k = 0; k < 20000 && !(f = view_frames_take(v->frames, chosen)); k++)
            usleep(100);
        assert_non_null(f);
        assert_int_equal(f->frame.number, 1 + 2 * chosen);
        assert_true(fabsf(f->frame.xyzr[0] - spheres[0][0] - (float)f->frame.number) < 1e-4f);
        view_frames_get(v->frames, &s);
        assert_true(s.bytes <= 4 * frame);
        view_frames_release(v->frames, f);
    }
    viewer_free(v);
}

/* A reader that waits for more of a run does not keep the window waiting. */
TEST(a_followed_run_is_read_anew)
{
    view_frames_state s = {0};
    follow_of = 60.0;
    viewer *const v = open_viewer(64);
    follow_of = 0.0;
    settle(v);
    for (int i = 0; i < 20000 && !(s.is_reading && s.reading == FRAMES); i++) {
        usleep(200);
        view_frames_get(v->frames, &s);
    }
    assert_int_equal(s.reading, FRAMES);
    const double begin = program_seconds();
    key(v, 'r', 0);
    assert_true(program_seconds() - begin < 30.0);
    expect_message(v, "read anew");
    viewer_free(v);
}

/* ---- Anything ----------------------------------------------------------------------------------------------- */

static view_event random_event(test_random *r)
{
    static const int keys[] = {'h',
                               'f',
                               'x',
                               'y',
                               'z',
                               'o',
                               'p',
                               'u',
                               'l',
                               'd',
                               'i',
                               'a',
                               'k',
                               'c',
                               '+',
                               '-',
                               ' ',
                               VIEW_KEY_LEFT,
                               VIEW_KEY_RIGHT,
                               VIEW_KEY_UP,
                               VIEW_KEY_DOWN,
                               VIEW_KEY_HOME,
                               VIEW_KEY_END,
                               VIEW_KEY_ENTER,
                               VIEW_KEY_ESCAPE,
                               VIEW_KEY_PAGE_UP,
                               VIEW_KEY_PAGE_DOWN,
                               VIEW_KEY_DELETE,
                               0};
    view_event e = {.kind = (view_event_kind)random_below(r, VIEW_RESIZE + 1)};
    e.x = random_below(r, 50) ? random_float(r, -20.0f, 140.0f) : random_any_float(r);
    e.y = random_below(r, 50) ? random_float(r, -20.0f, 140.0f) : random_any_float(r);
    e.button = 1 + (int)random_below(r, 3);
    e.clicks = 1 + (random_below(r, 4) == 0);
    e.turns = random_below(r, 20) ? random_float(r, -3.0f, 3.0f) : random_any_float(r);
    e.key = keys[random_below(r, sizeof keys / sizeof keys[0])];
    if (random_below(r, 400) == 0)
        e.key = 's';
    e.shift = random_below(r, 4) == 0;
    e.control = random_below(r, 10) == 0;
    if (e.kind == VIEW_RESIZE && random_below(r, 10))
        e.kind = VIEW_MOVE;
    if (e.kind == VIEW_RESIZE && random_below(r, 2)) { /* what a panel sends */
        static const char *const texts[] = {"", "\n", "1\n", "x > 3\n", "a\nb\n", "top"};
        e.kind = (view_event_kind)(VIEW_PUT + random_below(r, VIEW_PANEL - VIEW_PUT + 1));
        e.option = random_below(r, 80);
        e.text = strdup(texts[random_below(r, sizeof texts / sizeof texts[0])]);
        e.continues = (int)random_below(r, 2);
        e.panel = (int)random_below(r, 3);
    }
    e.width = random_below(r, 160);
    e.height = random_below(r, 120);
    e.scale = random_below(r, 2) ? 1.0f : 2.0f;
    return e;
}

/* ---- Opening ------------------------------------------------------------------------------------------------ */

static int ends_by; /* a run without an end */
static uint32_t pictures, with_count;
static atomic_int is_over;

enum { BY_ESCAPE, BY_WINDOW };

static void end_opening(void)
{
    pthread_mutex_lock(&waiting->lock);
    with_count += strstr(waiting->progress, "reading") && strstr(waiting->progress, " frames");
    pthread_mutex_unlock(&waiting->lock);
    if (++pictures != 3) /* progress is told ten times a second, as pictures are shown */
        return;
    const view_event escape = {.kind = VIEW_KEY, .key = VIEW_KEY_ESCAPE};
    if (ends_by == BY_ESCAPE)
        viewer_send(waiting, &escape);
    else
        viewer_stop(waiting);
}

static void *write_without_end(void *user)
{
    FILE *const to = fopen(user, "w");
    for (int frame = 0; to && !is_over; frame++) {
        fprintf(to, "1\nframe %d\nH 0 0 %d\n", frame, frame % 10);
        usleep(fflush(to) ? 1000 : 100); /* the reader has left, or reads on */
    }
    return to && fclose(to) == 0 ? NULL : user;
}

static pthread_t writer;

/* A run without an end, which end_opening ends once it is opened. */
static void begin_slow(void)
{
    assert_int_equal(mkfifo("slow.xyz", 0600), 0);
    pictures = with_count = 0;
    is_over = 0;
    on_picture = end_opening;
    assert_int_equal(pthread_create(&writer, NULL, write_without_end, "slow.xyz"), 0);
}

static void end_slow(void)
{
    on_picture = NULL;
    is_over = 1;
    pthread_join(writer, NULL);
    assert_int_equal(unlink("slow.xyz"), 0);
    assert_true(pictures >= 3 && with_count > 0);
}

/* What takes long to open tells how far it is, and can be ended: by Escape, which leaves what is shown, and with the
 * window. */
TEST(openings_can_be_ended)
{
    signal(SIGPIPE, SIG_IGN);
    for (ends_by = BY_ESCAPE; ends_by <= BY_WINDOW; ends_by++) {
        waiting = open_viewer(16);
        settle(waiting);
        for (float x = 0.5f; x < WIDTH && !waiting->picks; x += 4.0f)
            click(waiting, x, HEIGHT / 2.0f);
        const view_frame *const shown = waiting->shown;
        waiting->options.render.output.survey = UINT64_MAX; /* as a legend has it */
        begin_slow();
        const view_event open = {.kind = VIEW_OPEN, .text = strdup("slow.xyz\n")};
        viewer_send(waiting, &open);
        viewer_step(waiting, clock_now);
        end_slow();
        assert_true(waiting->shown == shown && waiting->frames && !waiting->is_opening);
        if (ends_by == BY_ESCAPE) {
            viewer_step(waiting, clock_now); /* the key ended this, and nothing else */
            assert_int_equal(waiting->picks, 1);
            settle(waiting);
            assert_string_equal(waiting->options.render.input, path);
        }
        viewer_free(waiting);
    }
}

/* Settings leave frame and picks of the same files where they are, and can be undone; with other files they are for
 * these, where the camera goes with nothing of before. */
TEST(settings_files_are_opened)
{
    static const char *const both[] = {"view.settings\nagain.lammpstrj\n", "again.lammpstrj\nview.settings"};
    const view_event save = {.kind = VIEW_KEY, .key = 's', .control = 1};
    assert_int_equal(system("cp run.lammpstrj again.lammpstrj && rm -f view.settings"), 0);
    viewer *const v = open_viewer(64);
    settle(v);
    key(v, VIEW_KEY_END, 0);
    settle(v);
    assert_int_equal(viewer_set(v, "style", "paper"), 0);
    viewer_send(v, &save);
    settle(v);
    assert_int_equal(viewer_set(v, "style", "plain"), 0);
    drag(v, 20.0f, 30.0f, 50.0f, 40.0f);
    const cgt_camera camera = v->camera;
    v->picks = 1;
    v->pick[0] = (view_pick){.element = 7, .id = SPHERES - 7};
    send_text(v, VIEW_OPEN, "view.settings\n");
    settle(v);
    expect_option(v, "style", "paper\n");
    assert_memory_not_equal(&v->camera, &camera, sizeof camera);
    assert_int_equal(v->shown->frame.number, FRAMES - 1);
    assert_int_equal(v->picks, 1);
    key(v, 'u', 0);
    settle(v);
    expect_option(v, "style", "plain\n");
    assert_memory_equal(&v->camera, &camera, sizeof camera);
    assert_int_equal(v->shown->frame.number, FRAMES - 1);
    for (size_t i = 0; i < TEST_COUNT(both); i++) {
        send_text(v, VIEW_SELECT, "z > 5");
        send_text(v, VIEW_USE, "follow");
        assert_true(v->filter.is_followed);
        send_text(v, VIEW_OPEN, both[i]);
        settle(v);
        expect_option(v, "style", "paper\n");
        assert_int_equal(v->options.render.input_count, 1);
        assert_string_equal(v->options.render.input, "again.lammpstrj");
        assert_false(v->filter.is_followed);
    }
    viewer_free(v);
}

/* The first file that is not waited for is none, and nothing has failed. */
TEST(first_openings_can_be_ended)
{
    survey_of = UINT64_MAX;
    snprintf(path, sizeof path, "slow.xyz");
    for (ends_by = BY_ESCAPE; ends_by <= BY_WINDOW; ends_by++) {
        begin_slow();
        viewer *const v = open_viewer(16); /* asserts that it has not failed */
        end_slow();
        assert_true(!v->draw && viewer_is_settled(v));
        assert_int_equal(v->messages, ends_by == BY_ESCAPE);
        viewer_free(v);
    }
    snprintf(path, sizeof path, "run.lammpstrj");
    survey_of = VIEW_SURVEY_AUTO;
}

TEST(any_events)
{
    viewer *const v = open_viewer(16);
    test_random r = random_make(5);
    const uint32_t count = test_between(1000, 10000);
    for (uint32_t i = 0; i < count; i++) {
        const view_event e = random_event(&r);
        viewer_send(v, &e);
        clock_now += (double)random_float(&r, 0.0f, 0.1f);
        if (random_below(&r, 3) == 0)
            viewer_step(v, clock_now);
        for (int c = 0; c < 3; c++)
            assert_true(isfinite(v->camera.eye[c]) && isfinite(v->camera.target[c]) && isfinite(v->camera.up[c]));
    }
    const view_event end = {.kind = VIEW_RESIZE, .width = WIDTH, .height = HEIGHT, .scale = 1.0f};
    viewer_send(v, &end);
    viewer_step(v, clock_now);
    if (v->playing)
        key(v, ' ', 0);
    key(v, 'a', 0);
    settle(v);
    assert_false(v->scene_is_wrong);
    viewer_free(v);
}

SEEDED_SUITE("test_viewer", write_run, remove_run)
