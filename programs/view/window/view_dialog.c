/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Names of files to open: from a dialog of the desktop, which is a program of its own, and dropped on the window. */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/program.h"
#include "system/system.h"
#include "view/window/view_window.h"

/* The viewer frees the text. */
static void open_paths(view_window *w, char *paths)
{
    const view_event e = {.kind = VIEW_OPEN, .text = paths};
    viewer_send(w->viewer, &e);
}

/* ---- The dialog --------------------------------------------------------------------------------------------- */

/* What it printed: names, a line each, among what its libraries complain of. */
static void take_names(view_window *w, FILE *from)
{
    char line[4096], *paths = NULL;
    size_t size = 0;
    FILE *const to = open_memstream(&paths, &size);
    rewind(from);
    while (to && fgets(line, sizeof line, from))
        if (line[0] == '/')
            fputs(line, to);
    if (to && fclose(to) == 0 && size)
        open_paths(w, paths);
    else
        free(paths);
}

static int start(view_window *w, FILE *messages)
{
    static const char *const zenity[] = {"zenity",         "--file-selection", "--multiple",
                                         "--separator=\n", "--title=Open",     NULL};
    static const char *const kdialog[] = {
        "kdialog", "--multiple", "--separate-output", "--title", "Open", "--getopenfilename", ".", NULL};
    const int wrong = process_start(&w->dialog, zenity, messages);
    return wrong ? process_start(&w->dialog, kdialog, messages) : 0;
}

static int run_dialog(void *user)
{
    view_window *const w = user;
    FILE *const messages = system_temporary();
    char reason[200];
    int code = -1;
    SDL_LockMutex(w->lock);
    const int is_late = w->dialog_ends, wrong = !is_late && (!messages || start(w, messages));
    SDL_UnlockMutex(w->lock);
    if (wrong) {
        program_error("there is no zenity or kdialog for a dialog: drop a file on the window");
    } else if (!is_late) {
        process_close_pipe(&w->dialog);
        process_has_ended(&w->dialog, 1, &code, reason, sizeof reason);
        if (code == 0)
            take_names(w, messages);
    }
    if (messages)
        fclose(messages);
    SDL_LockMutex(w->lock);
    w->dialog.process = -1;
    w->dialog_is_open = 0;
    SDL_UnlockMutex(w->lock);
    return 0;
}

void view_dialog_open(view_window *w)
{
    SDL_LockMutex(w->lock);
    const int is_open = w->dialog_is_open;
    w->dialog_is_open = 1;
    SDL_UnlockMutex(w->lock);
    if (is_open)
        return;
    if (w->dialog_thread)
        SDL_WaitThread(w->dialog_thread, NULL); /* the one before has ended */
    w->dialog.process = -1;
    w->dialog_thread = SDL_CreateThread(run_dialog, "dialog", w);
    if (!w->dialog_thread) {
        w->dialog_is_open = 0;
        program_error("cannot start a thread: %s", SDL_GetError());
    }
}

void view_dialog_end(view_window *w)
{
    SDL_LockMutex(w->lock);
    w->dialog_ends = 1;
    if (w->dialog.process > 0)
        process_kill(&w->dialog);
    SDL_UnlockMutex(w->lock);
    if (w->dialog_thread)
        SDL_WaitThread(w->dialog_thread, NULL);
}

/* ---- Drops -------------------------------------------------------------------------------------------------- */

void view_dialog_drop(view_window *w, const SDL_Event *e)
{
    if (e->type == SDL_DROPFILE && e->drop.file) {
        const size_t before = w->dropped ? strlen(w->dropped) : 0, more = strlen(e->drop.file);
        const int is_line = !strchr(e->drop.file, '\n');
        char *const paths = is_line ? realloc(w->dropped, before + more + 2) : NULL;
        if (paths)
            snprintf(paths + before, more + 2, "%s\n", e->drop.file);
        else
            program_error(is_line ? "out of memory" : "a name with a line feed cannot be opened");
        w->dropped = paths ? paths : w->dropped;
    }
    if (e->type == SDL_DROPCOMPLETE && w->dropped) {
        open_paths(w, w->dropped);
        w->dropped = NULL;
    }
    SDL_free(e->drop.file);
}
