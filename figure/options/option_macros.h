/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What rows of options are written with. OPTION_TABLE: the struct whose members they set; a table defines it before. */
#ifndef OPTION_MACROS_H
#define OPTION_MACROS_H

#include "options/option_row.h"

#define AT(type_, member) .type = OPTION_##type_, .at = offsetof(OPTION_TABLE, member)
#define FLAG(member) AT(FLAG, member), .first = 1
#define TEXT(member) AT(TEXT, member)
#define WORD(member, first_, words_) AT(WORD, member), .first = first_, .words = words_
#define NAME(member, words_) AT(NAME, member), .words = words_
#define FLOAT(member, low_, high_) AT(FLOAT, member), .low = low_, .high = high_
#define DOUBLE(member, low_, high_) AT(DOUBLE, member), .low = low_, .high = high_
#define U32(member, first_, last_) AT(U32, member), .first = first_, .last = last_
#define U64(member, first_, last_) AT(U64, member), .first = first_, .last = last_
#define PARSED(member, function) AT(PARSED, member), .parse = function
#define WHOLE(function) .type = OPTION_PARSED, .parse = function /* its place is all of the options */

#endif
