/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What a panel asks of options; see view_field.h. */
#include "view/view_field.h"

#include "options/figure_options.h"
#include "options/figure_values.h"
#include "options/option_row.h"
#include "text/text.h"
#include "view/view_options.h"

const char *view_field_why_not(const char *name) { return view_options_why_not(name); }

double view_field_start(const char *name)
{
    const option_row *const row = cgt_figure_find_row(name);
    figure_options options;
    cgt_figure_options_init(&options);
    const void *const at = (const char *)&options + (row ? row->at : 0);
    if (!row)
        return 0.0;
    const int is_whole = row->type == OPTION_U32;
    const double low = is_whole ? (double)row->first : row->low, high = is_whole ? (double)row->last : row->high;
    const double value = is_whole                    ? (double)*(const uint32_t *)at
                         : row->type == OPTION_FLOAT ? (double)*(const float *)at
                                                     : low;
    return value >= low && value <= high ? value : low;
}

int view_field_color(const char *text, uint8_t rgb[3])
{
    char error[256];
    return cgt_parse_color(text, rgb, error, sizeof error) == 0;
}

const char *view_field_font(void) { return cgt_text_find_file(); }
