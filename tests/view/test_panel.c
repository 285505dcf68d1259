/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The panel of cgt-view without a window: each row of the figure's table has a control that the keyboard finds by its
 * name, and that reaches its option and no other; any events. */
#define _GNU_SOURCE
#include "support/suite.h"
#include "support/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cgt/figure.h>

#include "view/view_field.h"
#include "view/view_options.h"
#include "view/window/view_panel.h"

enum { WIDTH = 380, HEIGHT = 700, OPTIONS = 200 };

static const char *inputs[] = {CGT_DATA_DIR "/caffeine.xyz"};
static double clock_now;
static viewer *v;
static view_panel *p;
static char *before[OPTIONS], *refused[OPTIONS];

static void wake(void *user, int has_picture)
{
    (void)user;
    (void)has_picture;
}

static void open_panel(void)
{
    view_options o = {.budget = 16.0f, .pictures = "view_%04d.png", .keys = "camera.keys"};
    render_options_init(&o.render);
    o.render.inputs = inputs;
    o.render.input = inputs[0];
    o.render.input_count = 1;
    o.render.no_images = 1;
    o.render.figure.width = o.render.figure.height = 64;
    o.render.settings = strdup("ambient = 0\nantialias = 1\n");
    o.render.output.survey = VIEW_SURVEY_AUTO;
    o.render.threads = 1;
    o.render.memory_mib = 16;
    v = viewer_create(&o, wake, NULL);
    assert_non_null(v);
    viewer_step(v, clock_now);
    assert_false(viewer_has_failed(v));
    for (int i = 0; i < 100000 && !viewer_is_settled(v); i++)
        if (viewer_step(v, clock_now += 0.05) > 0.0)
            usleep(200);
    p = view_panel_create(v);
    assert_non_null(p);
    assert_non_null(view_panel_draw(p, WIDTH, HEIGHT, 1.0f, 1));
}

static void close_panel(void)
{
    view_panel_free(p);
    viewer_free(v);
    for (int i = 0; i < OPTIONS; i++) {
        free(before[i]);
        free(refused[i]);
        before[i] = refused[i] = NULL;
    }
}

/* ---- Hands -------------------------------------------------------------------------------------------------- */

/* The viewer takes what was sent, and the panel shows what comes of it. */
static void step(void)
{
    viewer_step(v, clock_now += 0.01);
    view_panel_draw(p, WIDTH, HEIGHT, 1.0f, 0);
}

static int send(const SDL_Event *e)
{
    const int result = view_panel_event(p, e, 0.0f, 1.0f);
    step();
    return result;
}

static void press(SDL_Keycode key, int modifiers)
{
    SDL_Event e = {.key = {.type = SDL_KEYDOWN, .keysym = {.sym = key, .mod = (Uint16)modifiers}}};
    send(&e);
    e.type = SDL_KEYUP;
    e.key.keysym.mod = KMOD_NONE;
    send(&e);
}

static void type(const char *text)
{
    SDL_Event e = {.text = {.type = SDL_TEXTINPUT}};
    snprintf(e.text.text, sizeof e.text.text, "%s", text);
    send(&e);
}

/* The control of an option gets the keyboard. */
static void find(const char *name)
{
    view_panel_focus(p);
    step();
    press(SDLK_a, KMOD_LCTRL);
    type(name);
    press(SDLK_RETURN, 0);
}

/* ---- What came of it ---------------------------------------------------------------------------------------- */

static void look(void)
{
    for (uint32_t i = 0; i < OPTIONS; i++) {
        free(before[i]);
        free(refused[i]);
        viewer_copy_option(v, i, &before[i], &refused[i]);
    }
}

/* Whether the values or the sentence of an option alone have changed since look(). */
static int reached(uint32_t option, char **values, char **sentence)
{
    int wanted = 0, others = 0;
    cgt_figure_option o;
    for (uint32_t i = 0; cgt_figure_get_option(i, &o); i++) {
        char *now, *why;
        viewer_copy_option(v, i, &now, &why);
        const int differs = strcmp(now, before[i]) != 0 || strcmp(why, refused[i]) != 0;
        wanted |= i == option && differs;
        others |= i != option && differs;
        if (i == option) {
            *values = now;
            *sentence = why;
        } else {
            free(now);
            free(why);
        }
    }
    return wanted && !others;
}

/* A value of the kind, or where the form is an option's own, one that is refused, with a sentence. */
static const char *value_of(const cgt_figure_option *o)
{
    static char text[32];
    const int is_number = o->kind == CGT_FIGURE_NUMBER || o->kind == CGT_FIGURE_WHOLE;
    snprintf(text, sizeof text, "%.0f", o->low < 1.0 ? 1.0 : o->low);
    return is_number                       ? text
           : o->kind == CGT_FIGURE_COLOR   ? "336699"
           : o->kind == CGT_FIGURE_TEXT    ? "a"
           : o->kind == CGT_FIGURE_FORMULA ? "x"
                                           : "?";
}

TEST(each_option_has_a_control)
{
    cgt_figure_option o;
    uint32_t count = 0;
    open_panel();
    for (uint32_t i = 0; cgt_figure_get_option(i, &o); i++, count++) {
        char *values = NULL, *sentence = NULL;
        if (view_field_why_not(o.name))
            continue;
        find(o.name);
        look();
        if (o.kind == CGT_FIGURE_SWITCH || o.is_optional) {
            press(SDLK_SPACE, 0);
        } else if (o.kind == CGT_FIGURE_WORD) {
            press(SDLK_SPACE, 0);
            press(SDLK_DOWN, 0);
            press(SDLK_SPACE, 0);
        } else {
            type(value_of(&o));
            press(SDLK_RETURN, 0);
        }
        if (!reached(i, &values, &sentence))
            fail_msg("the control of %s does not reach it alone", o.name);
        assert_true(*values || *sentence); /* it is set, or told why not */
        free(values);
        free(sentence);
        const view_event back = {.kind = VIEW_PUT, .option = i, .text = strdup("")}; /* another may refuse it */
        viewer_send(v, &back);
        step();
    }
    close_panel();
    assert_true(count > 50);
}

static void expect(const char *name, const char *values)
{
    cgt_figure_option o;
    for (uint32_t i = 0; cgt_figure_get_option(i, &o); i++)
        if (strcmp(o.name, name) == 0) {
            char *now, *why;
            viewer_copy_option(v, i, &now, &why);
            assert_string_equal(now, values);
            free(now);
            free(why);
        }
}

TEST(refusals_undo_and_lists)
{
    char *values = NULL, *sentence = NULL;
    open_panel();
    find("radius-scale");
    type("much");
    look();
    press(SDLK_RETURN, 0);
    assert_true(reached(50, &values, &sentence));
    assert_non_null(strstr(sentence, "much"));
    free(values);
    free(sentence);
    find("radius-scale");
    press(SDLK_a, KMOD_LCTRL);
    type("0.5");
    press(SDLK_RETURN, 0);
    expect("radius-scale", "0.5\n");

    /* an option that repeats gets a value more, by the field after the last */
    find("type-color");
    type("C=red");
    press(SDLK_RETURN, 0);
    find("type-color");
    press(SDLK_TAB, 0);
    type("O=blue");
    press(SDLK_RETURN, 0);
    expect("type-color", "C=red\nO=blue\n");

    /* a step back each */
    static const view_event undo = {.kind = VIEW_KEY, .key = 'z', .control = 1};
    viewer_send(v, &undo);
    step();
    expect("type-color", "C=red\n");
    viewer_send(v, &undo);
    step();
    expect("type-color", "");
    expect("radius-scale", "0.5\n");
    viewer_send(v, &undo);
    step();
    expect("radius-scale", "");
    viewer_send(v, &undo); /* there is nothing any more */
    step();
    close_panel();
}

/* ---- Anything ----------------------------------------------------------------------------------------------- */

TEST(any_events)
{
    static const SDL_Keycode keys[] = {SDLK_TAB,       SDLK_LEFT,   SDLK_RIGHT, SDLK_UP,  SDLK_DOWN,
                                       SDLK_PAGEDOWN,  SDLK_HOME,   SDLK_SPACE, SDLK_END, SDLK_RETURN,
                                       SDLK_BACKSPACE, SDLK_ESCAPE, SDLK_a,     SDLK_z};
    test_random r = random_make(9);
    const uint32_t count = test_between(200, 1000);
    open_panel();
    view_panel_focus(p);
    for (uint32_t i = 0; i < count; i++) {
        SDL_Event e = {0};
        const int x = (int)random_below(&r, WIDTH + 40) - 20, y = (int)random_below(&r, HEIGHT);
        switch (random_below(&r, 6)) {
        case 0:
            e.button = (SDL_MouseButtonEvent){.type = SDL_MOUSEBUTTONDOWN, .button = 1, .clicks = 1, .x = x, .y = y};
            break;
        case 1:
            e.button = (SDL_MouseButtonEvent){.type = SDL_MOUSEBUTTONUP, .button = 1, .clicks = 1, .x = x, .y = y};
            break;
        case 2: e.motion = (SDL_MouseMotionEvent){.type = SDL_MOUSEMOTION, .x = x, .y = y}; break;
        case 3:
            e.wheel =
                (SDL_MouseWheelEvent){.type = SDL_MOUSEWHEEL, .preciseY = (float)x / 100.0f, .mouseX = x, .mouseY = y};
            break;
        case 4:
            e.key = (SDL_KeyboardEvent){.type = SDL_KEYDOWN,
                                        .keysym = {.sym = keys[random_below(&r, sizeof keys / sizeof keys[0])],
                                                   .mod = random_below(&r, 4) ? KMOD_NONE : KMOD_LCTRL}};
            break;
        default:
            e.text.type = SDL_TEXTINPUT;
            snprintf(e.text.text, sizeof e.text.text, random_below(&r, 3) ? "%u" : "\xC3\xA9%u=x",
                     random_below(&r, 20));
            break;
        }
        view_panel_event(p, &e, 0.0f, 1.0f);
        if (random_below(&r, 3) == 0)
            step();
        if (random_below(&r, 50) == 0)
            view_panel_draw(p, (int)(1 + random_below(&r, 500)), (int)(1 + random_below(&r, 700)),
                            random_below(&r, 2) ? 1.0f : 2.0f, 1);
    }
    close_panel();
}

static int begin(void **state)
{
    (void)state;
    return setenv("SDL_VIDEODRIVER", "dummy", 1) || SDL_Init(SDL_INIT_VIDEO);
}

static int end(void **state)
{
    (void)state;
    SDL_Quit();
    return 0;
}

SEEDED_SUITE("test_panel", begin, end)
