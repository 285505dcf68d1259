/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Files that were opened last: absolute paths, a line each, the newest first, in cgt/recent below $XDG_DATA_HOME, which
 * is ~/.local/share where it is not set. What fails is not worth a message. */
#ifndef VIEW_RECENT_H
#define VIEW_RECENT_H

#ifdef __cplusplus
extern "C" {
#endif

/* Puts a file first. */
void view_recent_add(const char *path);

/* The list, which the caller frees; "": none; NULL: no memory. */
char *view_recent_list(void);

#ifdef __cplusplus
}
#endif

#endif
