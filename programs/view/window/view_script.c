/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scripts of events, for tests and for pictures of the window: see --script. Lines go through SDL as a user's events
 * do. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/program.h"
#include "picture/files/image_write.h"
#include "view/window/view_window.h"

/* ---- Waiting ------------------------------------------------------------------------------------------------ */

/* Returns 0 where the window was closed. */
static int wait_seconds(view_window *w, double seconds)
{
    const double end = program_seconds() + seconds;
    int open = view_window_poll(w, 1);
    while (open && program_seconds() < end)
        open = view_window_poll(w, 2);
    return open;
}

/* Until the picture is as good as it gets; -1: it takes too long. */
static int settle(view_window *w)
{
    const double end = program_seconds() + 600.0;
    int open = view_window_poll(w, 1), settled = 0;
    while (open && !settled && program_seconds() < end) {
        open = view_window_poll(w, 5);
        SDL_LockMutex(w->lock);
        settled = w->is_settled;
        SDL_UnlockMutex(w->lock);
    }
    view_window_poll(w, 1);
    return open && !settled ? -1 : 0;
}

/* ---- Events ------------------------------------------------------------------------------------------------- */

static void push_button(Uint32 type, int button, int clicks, int x, int y)
{
    SDL_Event e;
    SDL_zero(e);
    e.type = type;
    e.button.button = (Uint8)(button == 1 ? SDL_BUTTON_LEFT : button == 2 ? SDL_BUTTON_MIDDLE : SDL_BUTTON_RIGHT);
    e.button.clicks = (Uint8)clicks;
    e.button.x = x;
    e.button.y = y;
    SDL_PushEvent(&e);
}

static void click(int button, int clicks, int x, int y)
{
    push_button(SDL_MOUSEBUTTONDOWN, button, clicks, x, y);
    push_button(SDL_MOUSEBUTTONUP, button, clicks, x, y);
}

/* A key by SDL's name, such as a, Left, Space; Shift+ or Ctrl+ before it. */
static int push_key(const char *name)
{
    SDL_Event e;
    SDL_zero(e);
    const int shift = strncmp(name, "Shift+", 6) == 0, control = strncmp(name, "Ctrl+", 5) == 0;
    e.type = SDL_KEYDOWN;
    e.key.keysym.sym = SDL_GetKeyFromName(name + (shift ? 6 : control ? 5 : 0));
    e.key.keysym.mod = shift ? KMOD_LSHIFT : control ? KMOD_LCTRL : KMOD_NONE;
    SDL_PushEvent(&e);
    e.type = SDL_KEYUP;
    SDL_PushEvent(&e);
    return e.key.keysym.sym == SDLK_UNKNOWN ? -1 : 0;
}

/* Text as an event for every few characters, as input methods send it. */
static void push_text(const char *text)
{
    SDL_Event e;
    const size_t most = 16;
    for (size_t length; *text; text += length) {
        SDL_zero(e);
        e.type = SDL_TEXTINPUT;
        length = strlen(text);
        for (length = length < most ? length : most; length > 1 && ((unsigned char)text[length] & 0xC0) == 0x80;)
            length--; /* not within a character */
        memcpy(e.text.text, text, length);
        SDL_PushEvent(&e);
    }
}

/* A file that is dropped on the window. */
static void push_drop(const char *path)
{
    SDL_Event e;
    SDL_zero(e);
    e.type = SDL_DROPFILE;
    e.drop.file = SDL_strdup(path);
    SDL_PushEvent(&e);
    e.type = SDL_DROPCOMPLETE;
    e.drop.file = NULL;
    SDL_PushEvent(&e);
}

static void push_wheel(float turns, int x, int y)
{
    SDL_Event e;
    SDL_zero(e);
    e.type = SDL_MOUSEWHEEL;
    e.wheel.preciseY = turns;
    e.wheel.mouseX = x;
    e.wheel.mouseY = y;
    SDL_PushEvent(&e);
}

static void push_move(int x, int y)
{
    SDL_Event e;
    SDL_zero(e);
    e.type = SDL_MOUSEMOTION;
    e.motion.x = x;
    e.motion.y = y;
    SDL_PushEvent(&e);
}

/* ---- Asking ------------------------------------------------------------------------------------------------- */

/* The picture, and beside it the panel. */
static int shoot(view_window *w, const char *path, char *error, size_t size)
{
    view_picture p;
    float scale;
    uint8_t *rgb = NULL;
    viewer_take(w->viewer, &p);
    const int beside = view_window_panel_width(w, &scale);
    const SDL_Surface *const panel = beside ? view_panel_draw(w->panel, beside, (int)p.height, scale, 1) : NULL;
    const uint32_t width = p.width + (panel ? (uint32_t)beside : 0);
    if (p.pixels)
        rgb = malloc(3 * (size_t)width * p.height + 1);
    for (uint32_t y = 0; rgb && y < p.height; y++)
        for (uint32_t x = 0; x < width; x++) {
            const uint32_t *const row = x < p.width
                                            ? p.pixels + (size_t)y * p.width
                                            : (const uint32_t *)(const void *)((const uint8_t *)panel->pixels +
                                                                               (size_t)y * (size_t)panel->pitch);
            for (int c = 0; c < 3; c++)
                rgb[3 * ((size_t)y * width + x) + (size_t)c] =
                    (uint8_t)(row[x < p.width ? x : x - p.width] >> (16 - 8 * c));
        }
    viewer_give_back(w->viewer);
    snprintf(error, size, "there is no picture");
    const int result = rgb ? image_write_png(path, rgb, width, p.height, error, size) : -1;
    free(rgb);
    return result;
}

/* Asks the thread that draws, which would hardly ever leave a lock to another. */
static void say(view_window *w)
{
    SDL_LockMutex(w->lock);
    w->asks = w->is_woken = 1;
    SDL_CondBroadcast(w->changed);
    while (w->asks && !w->closing)
        SDL_CondWait(w->changed, w->lock);
    if (!w->asks)
        printf("%s\n", w->state);
    SDL_UnlockMutex(w->lock);
    fflush(stdout);
}

/* ---- Lines -------------------------------------------------------------------------------------------------- */

enum { DONE = 0, CLOSED = 1, WRONG = -1 };

/* What waits or asks; WRONG where the word is none of them, or its work failed. */
static int run_other(view_window *w, const char *word, const char *rest, char *error, size_t size)
{
    int a, b;
    if (strcmp(word, "settle") == 0) {
        snprintf(error, size, "the picture does not settle");
        return settle(w) ? WRONG : DONE;
    }
    if (strcmp(word, "wait") == 0)
        return wait_seconds(w, atof(rest)) ? DONE : CLOSED;
    if (strcmp(word, "shot") == 0)
        return shoot(w, rest, error, size) ? WRONG : DONE;
    if (strcmp(word, "say") == 0) {
        say(w);
        return DONE;
    }
    if (strcmp(word, "close") == 0)
        return CLOSED;
    if (strcmp(word, "size") != 0 || sscanf(rest, "%d %d", &a, &b) != 2)
        return WRONG;
    SDL_SetWindowSize(w->window, a, b);
    return DONE;
}

static int run_line(view_window *w, const char *line, char *error, size_t size)
{
    char word[16] = "";
    int from = 0, button = 1, x = 0, y = 0;
    float turns = 0.0f;
    sscanf(line, "%15s %n", word, &from);
    const char *const rest = line + from;
    snprintf(error, size, "\"%.80s\" is no event", line);
    if (!*word || *word == '#')
        return DONE;
    if (strcmp(word, "key") == 0)
        return push_key(rest);
    if (strcmp(word, "drop") == 0) {
        push_drop(rest);
        return DONE;
    }
    if (strcmp(word, "text") == 0) {
        push_text(rest);
        return DONE;
    }
    if (strcmp(word, "move") == 0 && sscanf(rest, "%d %d", &x, &y) == 2)
        push_move(x, y);
    else if (strcmp(word, "press") == 0 && sscanf(rest, "%d %d %d", &button, &x, &y) == 3)
        push_button(SDL_MOUSEBUTTONDOWN, button, 1, x, y);
    else if (strcmp(word, "release") == 0 && sscanf(rest, "%d %d %d", &button, &x, &y) == 3)
        push_button(SDL_MOUSEBUTTONUP, button, 1, x, y);
    else if (strcmp(word, "click") == 0 && sscanf(rest, "%d %d", &x, &y) == 2)
        click(1, 1, x, y);
    else if (strcmp(word, "double") == 0 && sscanf(rest, "%d %d", &x, &y) == 2)
        click(1, 2, x, y);
    else if (strcmp(word, "wheel") == 0 && sscanf(rest, "%f %d %d", &turns, &x, &y) == 3)
        push_wheel(turns, x, y);
    else
        return run_other(w, word, rest, error, size);
    return DONE;
}

int view_script_run(view_window *w, const char *path)
{
    FILE *const file = fopen(path, "r");
    char line[4096], error[PROGRAM_ERROR_SIZE];
    int result = DONE;
    if (!file) {
        program_error("--script: %s cannot be opened", path);
        return -1;
    }
    for (unsigned number = 1; result == DONE && fgets(line, sizeof line, file); number++) {
        line[strcspn(line, "\r\n")] = '\0';
        result = run_line(w, line, error, sizeof error);
        if (result == WRONG)
            program_error("--script: %s:%u: %s", path, number, error);
        else if (result == DONE && !view_window_poll(w, 0))
            result = CLOSED;
    }
    fclose(file);
    return result == WRONG ? -1 : 0;
}
