/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-view: a window on the viewer (viewer.h), by SDL. One thread takes the window's events and shows pictures, which
 * the other draws. Of the window only what differs from the picture before is sent. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

#include <SDL2/SDL.h>

#include "common/program.h"
#include "view/view_options.h"
#include "view/window/view_window.h"

/* ---- The thread that draws ---------------------------------------------------------------------------------- */

static void push(view_window *w)
{
    SDL_Event event;
    SDL_zero(event);
    event.type = w->event;
    SDL_PushEvent(&event);
}

/* Any thread: there is something to do, or to show. */
static void wake(void *user, int has_picture)
{
    view_window *const w = user;
    if (has_picture) {
        push(w);
        return;
    }
    SDL_LockMutex(w->lock);
    w->is_woken = 1;
    w->is_settled = 0;
    SDL_CondBroadcast(w->changed);
    SDL_UnlockMutex(w->lock);
}

static int draw(void *user)
{
    view_window *const w = user;
    const double longest = 3600.0;
    uint64_t shown = 0;
    SDL_LockMutex(w->lock);
    while (!w->closing) {
        view_picture picture;
        const int asks = w->asks;
        w->is_woken = 0;
        SDL_UnlockMutex(w->lock);
        const double wait = viewer_step(w->viewer, program_seconds());
        const int settled = viewer_is_settled(w->viewer), ends = viewer_wants_end(w->viewer);
        viewer_peek(w->viewer, &picture);
        SDL_LockMutex(w->lock);
        w->closing |= ends;
        if (asks) {
            viewer_describe(w->viewer, w->state, sizeof w->state);
            w->asks = 0;
            SDL_CondBroadcast(w->changed);
        }
        if (picture.number != shown || ends)
            push(w);
        shown = picture.number;
        if (w->is_woken) /* by itself, with the picture, or by others: looks again */
            continue;
        w->is_settled = settled;
        if (wait > 0.0 && !w->closing)
            SDL_CondWaitTimeout(w->changed, w->lock, (Uint32)ceil(1e3 * fmin(wait, longest)));
    }
    SDL_UnlockMutex(w->lock);
    return 0;
}

/* ---- The window --------------------------------------------------------------------------------------------- */

/* Pixels of the picture for each unit of the window's coordinates, and the size of texts. */
static void get_scale(SDL_Window *window, float *pixels, float *scale)
{
    int width = 1, height, wide = 1;
    float dpi = 96.0f;
    SDL_GetWindowSize(window, &width, &height);
    SDL_GetWindowSizeInPixels(window, &wide, &height);
    *pixels = width > 0 ? (float)wide / (float)width : 1.0f;
    *scale = *pixels;
    if (*pixels <= 1.0f && SDL_GetDisplayDPI(SDL_GetWindowDisplayIndex(window), NULL, &dpi, NULL) == 0 && dpi > 130.0f)
        *scale = floorf(fminf(dpi, 384.0f) / 48.0f) * 0.5f; /* in halves */
}

static const float panel_width = 380.0f; /* units of texts */

int view_window_panel_width(const view_window *w, float *scale)
{
    int width, height;
    float pixels;
    SDL_GetWindowSizeInPixels(w->window, &width, &height);
    get_scale(w->window, &pixels, scale);
    const int wanted = (int)(panel_width * *scale), most = width - width / 3;
    return !w->panel_is_open ? 0 : wanted < most ? wanted : most;
}

/* The picture has what the panel leaves. */
static void send_size(view_window *w)
{
    int width, height;
    view_event event = {.kind = VIEW_RESIZE};
    SDL_GetWindowSizeInPixels(w->window, &width, &height);
    width -= view_window_panel_width(w, &event.scale);
    event.width = (uint32_t)(width > 0 ? width : 1);
    event.height = (uint32_t)(height > 0 ? height : 1);
    viewer_send(w->viewer, &event);
}

/* Where there is room, the window becomes wider by the panel, so that the picture stays as it is; or narrower again. */
static void make_room(view_window *w, int is_open)
{
    float pixels, scale;
    int width, height, x, y;
    SDL_Rect screen;
    const Uint32 whole = SDL_WINDOW_MAXIMIZED | SDL_WINDOW_FULLSCREEN;
    get_scale(w->window, &pixels, &scale);
    SDL_GetWindowSize(w->window, &width, &height);
    SDL_GetWindowPosition(w->window, &x, &y);
    if (!is_open && w->grown && width > w->grown)
        SDL_SetWindowSize(w->window, width - w->grown, height);
    const int wanted = is_open ? (int)(panel_width * scale / pixels) : 0;
    w->grown = 0;
    if (!is_open || (SDL_GetWindowFlags(w->window) & whole) ||
        SDL_GetDisplayUsableBounds(SDL_GetWindowDisplayIndex(w->window), &screen) || width + wanted > screen.w)
        return;
    w->grown = wanted;
    if (x + width + wanted > screen.x + screen.w)
        SDL_SetWindowPosition(w->window, screen.x + screen.w - width - wanted, y);
    SDL_SetWindowSize(w->window, width + wanted, height);
}

static void open_panel(view_window *w, int is_open)
{
    const view_event event = {.kind = VIEW_PANEL,
                              .panel = !w->panel ? VIEW_PANEL_ABSENT
                                       : is_open ? VIEW_PANEL_OPEN
                                                 : VIEW_PANEL_CLOSED};
    if (w->panel && w->panel_is_open != is_open)
        make_room(w, is_open);
    w->panel_is_open = w->panel && is_open;
    viewer_send(w->viewer, &event);
    send_size(w);
    if (w->panel_is_open)
        view_panel_focus(w->panel);
}

static void set_picture_size(view_window *w, const uint32_t size[2])
{
    float pixels, scale;
    get_scale(w->window, &pixels, &scale);
    w->grown = w->panel_is_open ? (int)(panel_width * scale / pixels) : 0; /* which goes when the panel does */
    SDL_SetWindowSize(w->window, (int)((float)size[0] / pixels + 0.5f) + w->grown,
                      (int)((float)size[1] / pixels + 0.5f));
}

/* Shows the panel where it differs, or is asked for. */
static void present_panel(view_window *w, int all)
{
    SDL_Surface *const to = SDL_GetWindowSurface(w->window);
    float scale;
    const int width = view_window_panel_width(w, &scale);
    SDL_Surface *const from = width && to ? view_panel_draw(w->panel, width, to->h, scale, all) : NULL;
    SDL_Rect at = {to ? to->w - width : 0, 0, width, to ? to->h : 0};
    if (!from)
        return;
    SDL_BlitSurface(from, NULL, to, &at);
    SDL_UpdateWindowSurfaceRects(w->window, &at, 1);
}

/* Shows what differs, or all. */
static void present(view_window *w, int all)
{
    SDL_Surface *const to = SDL_GetWindowSurface(w->window);
    float scale;
    view_picture p;
    SDL_Rect rects[VIEW_RECTS];
    int count = 0;
    viewer_take(w->viewer, &p);
    SDL_Surface *const from =
        p.pixels ? SDL_CreateRGBSurfaceWithFormatFrom((void *)(uintptr_t)p.pixels, (int)p.width, (int)p.height, 32,
                                                      (int)(4 * p.width), SDL_PIXELFORMAT_RGB888)
                 : NULL;
    if (all && p.width) {
        p.rects[0] = (view_rect){0, 0, p.width, p.height};
        p.rect_count = 1;
    }
    if (to) {
        const SDL_Rect beside = {0, 0, to->w - view_window_panel_width(w, &scale), to->h};
        SDL_SetClipRect(to, &beside);
    }
    for (uint32_t i = 0; i < p.rect_count && from && to; i++) {
        SDL_Rect r = {(int)p.rects[i].x, (int)p.rects[i].y, (int)p.rects[i].width, (int)p.rects[i].height};
        SDL_Rect at = r;
        SDL_BlitSurface(from, &r, to, &at); /* cuts `at` to what the panel leaves of the window */
        if (at.w > 0 && at.h > 0)
            rects[count++] = at;
    }
    SDL_FreeSurface(from);
    if (to)
        SDL_SetClipRect(to, NULL);
    viewer_give_back(w->viewer);
    if (count)
        SDL_UpdateWindowSurfaceRects(w->window, rects, count);
    if (strcmp(SDL_GetWindowTitle(w->window), p.title) != 0)
        SDL_SetWindowTitle(w->window, p.title);
    char *const clipboard = viewer_take_clipboard(w->viewer);
    if (clipboard)
        SDL_SetClipboardText(clipboard);
    free(clipboard);
    uint32_t size[2];
    switch (viewer_take_request(w->viewer, size)) {
    case VIEW_ASKS_PANEL: open_panel(w, !w->panel_is_open); break;
    case VIEW_ASKS_FILE: view_dialog_open(w); break;
    case VIEW_ASKS_SIZE: set_picture_size(w, size); break;
    case VIEW_ASKS_NOTHING: break;
    }
}

/* ---- Events ------------------------------------------------------------------------------------------------- */

static int key_of(SDL_Keycode key)
{
    static const struct {
        SDL_Keycode from;
        int to;
    } keys[] = {{SDLK_LEFT, VIEW_KEY_LEFT},
                {SDLK_RIGHT, VIEW_KEY_RIGHT},
                {SDLK_UP, VIEW_KEY_UP},
                {SDLK_DOWN, VIEW_KEY_DOWN},
                {SDLK_HOME, VIEW_KEY_HOME},
                {SDLK_END, VIEW_KEY_END},
                {SDLK_PAGEUP, VIEW_KEY_PAGE_UP},
                {SDLK_PAGEDOWN, VIEW_KEY_PAGE_DOWN},
                {SDLK_KP_PLUS, '+'},
                {SDLK_KP_MINUS, '-'},
                {SDLK_KP_ENTER, VIEW_KEY_ENTER},
                {SDLK_F1, 'h'}};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
        if (keys[i].from == key)
            return keys[i].to;
    return key < 128 ? (int)key : 0;
}

static int button_of(Uint8 button) { return button == SDL_BUTTON_LEFT ? 1 : button == SDL_BUTTON_MIDDLE ? 2 : 3; }

static void send_mouse(view_window *w, const SDL_Event *e)
{
    view_event event = {.kind = VIEW_MOVE};
    float pixels, scale;
    int x, y;
    get_scale(w->window, &pixels, &scale);
    switch (e->type) {
    case SDL_MOUSEBUTTONDOWN:
    case SDL_MOUSEBUTTONUP:
        event.kind = e->type == SDL_MOUSEBUTTONDOWN ? VIEW_PRESS : VIEW_RELEASE;
        event.button = button_of(e->button.button);
        event.clicks = e->button.clicks;
        x = e->button.x;
        y = e->button.y;
        break;
    case SDL_MOUSEWHEEL:
        event.kind = VIEW_WHEEL;
        event.turns = e->wheel.preciseY;
        x = e->wheel.mouseX;
        y = e->wheel.mouseY;
        break;
    default:
        x = e->motion.x;
        y = e->motion.y;
        break;
    }
    event.x = (float)x * pixels;
    event.y = (float)y * pixels;
    viewer_send(w->viewer, &event);
}

/* Returns 0 where the window was closed. */
static int take(view_window *w, const SDL_Event *e, int *shows, int *all)
{
    const view_event key = {.kind = VIEW_KEY,
                            .key = key_of(e->key.keysym.sym),
                            .shift = (e->key.keysym.mod & KMOD_SHIFT) != 0,
                            .control = (e->key.keysym.mod & KMOD_CTRL) != 0};
    int taken = VIEW_PANEL_LEAVES;
    if (w->panel_is_open) {
        float pixels, scale;
        int width, height;
        SDL_GetWindowSizeInPixels(w->window, &width, &height);
        get_scale(w->window, &pixels, &scale);
        taken = view_panel_event(w->panel, e, (float)(width - view_window_panel_width(w, &scale)), pixels);
    }
    if (taken == VIEW_PANEL_CLOSES)
        open_panel(w, 0);
    if (taken != VIEW_PANEL_LEAVES)
        return 1;
    switch (e->type) {
    case SDL_QUIT: return 0;
    case SDL_MOUSEBUTTONDOWN:
    case SDL_MOUSEBUTTONUP:
    case SDL_MOUSEWHEEL:
    case SDL_MOUSEMOTION: send_mouse(w, e); break;
    case SDL_KEYDOWN:
        if (key.key)
            viewer_send(w->viewer, &key);
        break;
    case SDL_DROPFILE:
    case SDL_DROPCOMPLETE: view_dialog_drop(w, e); break;
    case SDL_WINDOWEVENT:
        if (e->window.event == SDL_WINDOWEVENT_SIZE_CHANGED)
            send_size(w);
        if (e->window.event == SDL_WINDOWEVENT_EXPOSED)
            *all = 1;
        break;
    default: *shows |= e->type == w->event; break;
    }
    return 1;
}

int view_window_poll(view_window *w, int ms)
{
    SDL_Event event;
    int open = 1, shows = 0, all = 0;
    if (SDL_WaitEventTimeout(&event, ms))
        do
            open = take(w, &event, &shows, &all);
        while (open && SDL_PollEvent(&event));
    if (shows || all)
        present(w, all);
    if (w->panel_is_open)
        present_panel(w, all);
    SDL_LockMutex(w->lock);
    open &= !w->closing;
    SDL_UnlockMutex(w->lock);
    return open;
}

/* ---- The program -------------------------------------------------------------------------------------------- */

static int run(view_window *w, const view_options *o)
{
    int result = 0;
    w->lock = SDL_CreateMutex();
    w->changed = SDL_CreateCond();
    w->event = SDL_RegisterEvents(1);
    w->window = SDL_CreateWindow(o->render.input ? o->render.input : "cgt-view", SDL_WINDOWPOS_UNDEFINED,
                                 SDL_WINDOWPOS_UNDEFINED, (int)o->render.figure.width, (int)o->render.figure.height,
                                 SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI);
    if (!w->lock || !w->changed || !w->window) {
        program_error("cannot open a window: %s", SDL_GetError());
        return -1;
    }
    w->viewer = viewer_create(o, wake, w);
    if (!w->viewer) {
        program_error("out of memory");
        return -1;
    }
    w->panel = view_panel_create(w->viewer);
    open_panel(w, 0);
    SDL_Thread *const thread = SDL_CreateThread(draw, "draw", w);
    if (!thread) {
        program_error("cannot start a thread: %s", SDL_GetError());
        return -1;
    }
    if (o->script)
        result = view_script_run(w, o->script);
    else
        while (view_window_poll(w, 1000)) {
        }
    view_dialog_end(w);
    viewer_stop(w->viewer);
    SDL_LockMutex(w->lock);
    w->closing = 1;
    SDL_CondBroadcast(w->changed);
    SDL_UnlockMutex(w->lock);
    SDL_WaitThread(thread, NULL);
    return viewer_has_failed(w->viewer) ? -1 : result;
}

int main(int argc, char **argv)
{
    static view_window w;
    static view_options options; /* of texts that last as long as the program */
    program_init("cgt-view");
    view_options_parse(&options, argc, argv);
    SDL_SetHint(SDL_HINT_FRAMEBUFFER_ACCELERATION, "0"); /* else all of the window is sent each time */
    SDL_SetHint(SDL_HINT_VIDEO_X11_NET_WM_BYPASS_COMPOSITOR, "0");
    SDL_SetHint(SDL_HINT_MOUSE_FOCUS_CLICKTHROUGH, "1");
    if (SDL_Init(SDL_INIT_VIDEO)) {
        program_error("cannot open a window: %s", SDL_GetError());
        return program_exit(PROGRAM_FAILED);
    }
    signal(SIGPIPE, SIG_IGN); /* an error of the call that writes */
    const int result = run(&w, &options);
    view_panel_free(w.panel);
    viewer_free(w.viewer);
    /* SDL wakes the thread of events by a second connection to an X server, which may read that message after the end
     * of the window; Xlib then ends the program as failed. There the end of the process closes both. */
    if (strcmp(SDL_GetCurrentVideoDriver(), "x11") != 0) {
        SDL_DestroyWindow(w.window);
        SDL_Quit();
    }
    return program_exit(result ? PROGRAM_FAILED : PROGRAM_OK);
}
