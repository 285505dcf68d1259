/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What a panel asks of options beside <cgt/figure.h>; C++ reads it, too. */
#ifndef VIEW_FIELD_H
#define VIEW_FIELD_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Why an option cannot change while the window is open; NULL: it can. */
const char *view_field_why_not(const char *name);

/* The number that an option has where it is not set; its lowest where it is chosen then, or is no number. */
double view_field_start(const char *name);

/* Whether a text is a colour: RRGGBB or a name. */
int view_field_color(const char *text, uint8_t rgb[3]);

/* The font of the program; NULL: there is none. */
const char *view_field_font(void);

#ifdef __cplusplus
}
#endif

#endif
