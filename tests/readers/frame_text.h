/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A frame as text, with all that it holds. Floats have the digits that tell them from their neighbours; doubles have
 * twelve, so that a cosine of another C library does not matter. */
#ifndef FRAME_TEXT_H
#define FRAME_TEXT_H

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cgt/trajectory.h>

/* Text that grows; {0} is empty. */
typedef struct text {
    char *bytes; /* NULL, or with a zero at its end */
    size_t size, capacity;
} text;

static inline void text_add(text *t, const char *bytes, size_t size)
{
    if (t->capacity - t->size <= size) {
        t->capacity = 2 * (t->capacity + size) + 256;
        char *const grown = realloc(t->bytes, t->capacity);
        if (grown == NULL)
            abort();
        t->bytes = grown;
    }
    memcpy(t->bytes + t->size, bytes, size);
    t->size += size;
    t->bytes[t->size] = '\0';
}

static inline void text_print(text *t, const char *format, ...) __attribute__((format(printf, 2, 3)));
static inline void text_print(text *t, const char *format, ...)
{
    char line[4096];
    va_list arguments;
    va_start(arguments, format);
    const int size = vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    if (size < 0 || (size_t)size >= sizeof line)
        abort();
    text_add(t, line, (size_t)size);
}

static inline void text_clear(text *t)
{
    t->size = 0;
    text_add(t, "", 0);
}

static inline void text_float(text *t, float value)
{
    char digits[32];
    int precision = 6;
    if (isnan(value)) {
        text_print(t, " nan");
        return;
    }
    if (fabsf(value) < 1e9f && value == truncf(value))
        snprintf(digits, sizeof digits, "%.0f", (double)value);
    else
        do
            snprintf(digits, sizeof digits, "%.*g", precision, (double)value);
        while (precision++ < 9 && strtof(digits, NULL) != value);
    text_print(t, " %s", digits);
}

static inline void text_floats(text *t, const float *value, size_t count)
{
    for (size_t i = 0; i < count; i++)
        text_float(t, value[i]);
}

static inline void text_doubles(text *t, const double *value, size_t count)
{
    for (size_t i = 0; i < count; i++)
        text_print(t, isnan(value[i]) ? " nan" : " %.12g", value[i]);
}

/* ---- Parts of a frame ----------------------------------------------------------------------------------------- */

static inline void frame_text_box(text *t, const cgt_trajectory_frame *f)
{
    const double *const edge = &f->box_edge[0][0];
    const int8_t *const p = f->periodic;
    int has_edges = 0;
    for (int i = 0; i < 9; i++)
        has_edges |= edge[i] != 0.0;
    if (has_edges) {
        text_print(t, "  box:");
        text_doubles(t, f->box_origin, 3);
        for (int e = 0; e < 3; e++) {
            text_print(t, ", %c", 'a' + e);
            text_doubles(t, f->box_edge[e], 3);
        }
        text_print(t, "\n");
    }
    if (!(f->box_min[0] > f->box_max[0])) {
        text_print(t, "  bounds:");
        text_floats(t, f->box_min, 3);
        text_print(t, " to");
        text_floats(t, f->box_max, 3);
        text_print(t, "\n");
    }
    if (p[0] != -1 || p[1] != -1 || p[2] != -1)
        text_print(t, "  periodic: %d %d %d\n", p[0], p[1], p[2]);
    if (f->unwrapped[0] || f->unwrapped[1] || f->unwrapped[2])
        text_print(t, "  unwrapped: %d %d %d\n", f->unwrapped[0], f->unwrapped[1], f->unwrapped[2]);
    if (f->origin[0] != 0.0 || f->origin[1] != 0.0 || f->origin[2] != 0.0) {
        text_print(t, "  origin:");
        text_doubles(t, f->origin, 3);
        text_print(t, "\n");
    }
}

/* A sphere or a vertex, with all that it has. */
static inline void frame_text_item(text *t, const cgt_trajectory_frame *f, size_t i)
{
    text_print(t, "  %u:", (unsigned)i);
    if (f->xyzr != NULL) {
        text_floats(t, f->xyzr + 4 * i, 3);
        text_print(t, ", r");
        text_floats(t, f->xyzr + 4 * i + 3, 1);
    } else {
        text_floats(t, f->position + 3 * i, 3);
    }
    if (f->vertex_normal != NULL) {
        text_print(t, ", normal");
        text_floats(t, f->vertex_normal + 3 * i, 3);
    }
    if (f->element != NULL)
        text_print(t, ", element %u", f->element[i]);
    if (f->id != NULL)
        text_print(t, ", id %u", f->id[i]);
    if (f->type != NULL)
        text_print(t, ", type %u", f->type[i]);
    if (f->velocity != NULL) {
        text_print(t, ", velocity");
        text_floats(t, f->velocity + 3 * i, 3);
    }
    text_print(t, "\n");
}

/* The value that the frame's own arrays have under the name of a column; 0: none. */
static inline int frame_text_own(const cgt_trajectory_frame *f, const cgt_trajectory_column *c, size_t i, float *value)
{
    static const char numbers[][8] = {"x", "y", "z", "radius", "vx", "vy", "vz"};
    static const char whole[][8] = {"id", "type", "element"};
    const size_t length = f->xyzr != NULL ? 4 : 3;
    const float *const place = f->xyzr != NULL ? f->xyzr : f->position;
    for (size_t k = 0; k < 7 && c->kind == CGT_TRAJECTORY_NUMBER; k++)
        if (strcmp(c->name, numbers[k]) == 0 && (k < length || (k > 3 && f->velocity != NULL))) {
            *value = k < length ? place[length * i + k] : f->velocity[3 * i + k - 4];
            return 1;
        }
    for (size_t k = 0; k < 3 && c->kind == CGT_TRAJECTORY_WHOLE; k++)
        if (strcmp(c->name, whole[k]) == 0 && (k == 0   ? f->id != NULL
                                               : k == 1 ? f->type != NULL
                                                        : f->element != NULL)) {
            *value = (float)(k == 0 ? f->id[i] : k == 1 ? f->type[i] : f->element[i]);
            return 1;
        }
    return 0;
}

/* What is told of a column: its values, or that they are those above, or that nobody asked for them. */
typedef enum frame_text_state { COLUMN_VALUES, COLUMN_ABOVE, COLUMN_NOT_ASKED } frame_text_state;

static inline frame_text_state frame_text_judge(const cgt_trajectory_frame *f, const cgt_trajectory_column *c)
{
    if (c->value == NULL)
        return COLUMN_NOT_ASKED;
    for (size_t i = 0; i < f->count; i++) {
        float own;
        if (!frame_text_own(f, c, i, &own) || memcmp(&own, &c->value[i], sizeof own) != 0)
            return COLUMN_VALUES;
    }
    return COLUMN_ABOVE;
}

/* Words stand behind their numbers: 1 CA, 2 CB, 1 CA. */
static inline void frame_text_values(text *t, const cgt_trajectory_column *c, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const float value = c->value[i];
        text_print(t, i > 0 ? "," : ":");
        text_float(t, value);
        if (c->kind == CGT_TRAJECTORY_WORD && value >= 1.0f && value <= (float)c->words)
            text_print(t, " %s", c->word[(uint32_t)value - 1]);
    }
}

/* In the order of the frame; those without values share a line. */
static inline void frame_text_columns(text *t, const cgt_trajectory_frame *f)
{
    static const char *const kinds[] = {" (?)", "", " (whole)", " (words)"};
    static const char *const states[] = {"  column ", "  columns as above: ", "  columns not asked for: "};
    frame_text_state before = COLUMN_VALUES;
    for (uint32_t k = 0; k < f->columns; k++) {
        const cgt_trajectory_column *const c = &f->column[k];
        const frame_text_state state = frame_text_judge(f, c);
        if (state != COLUMN_VALUES && state == before)
            text_print(t, ", ");
        else
            text_print(t, "%s%s", k > 0 ? "\n" : "", states[state]);
        if (c->kind == CGT_TRAJECTORY_WORD && c->value != NULL)
            text_print(t, "%s (%u words)", c->name, c->words);
        else
            text_print(t, "%s%s", c->name, kinds[c->kind <= CGT_TRAJECTORY_WORD ? c->kind : 0]);
        if (state == COLUMN_VALUES)
            frame_text_values(t, c, f->count);
        before = state;
    }
    if (f->columns > 0)
        text_print(t, "\n");
}

static inline void frame_text(text *t, const cgt_trajectory_frame *f)
{
    const int is_mesh = f->kind == CGT_TRAJECTORY_TRIANGLES;
    text_print(t, "frame %llu: step %lld, %u %s\n", (unsigned long long)f->number, (long long)f->step, f->count,
               is_mesh ? "vertices" : "spheres");
    if (!isnan(f->time)) {
        text_print(t, "  time:");
        text_doubles(t, &f->time, 1);
        text_print(t, "\n");
    }
    frame_text_box(t, f);
    if (f->has_radius)
        text_print(t, "  radii of the file\n");
    if (f->element != NULL) {
        text_print(t, "  angstrom:");
        text_float(t, f->angstrom);
        text_print(t, "\n");
    }
    if (f->count == 0) /* what stands with spheres otherwise */
        text_print(t, "  arrays:%s%s%s%s%s\n", f->xyzr != NULL ? " xyzr" : "", f->position != NULL ? " position" : "",
                   f->id != NULL ? " id" : "", f->type != NULL ? " type" : "", f->velocity != NULL ? " velocity" : "");
    for (size_t i = 0; i < f->count; i++)
        frame_text_item(t, f, i);
    for (size_t i = 0; i < f->triangles; i++)
        text_print(t, "  triangle: %u %u %u\n", f->index[3 * i], f->index[3 * i + 1], f->index[3 * i + 2]);
    for (size_t i = 0; i < f->bonds; i++)
        text_print(t, "  bond: %u %u\n", f->bond[2 * i], f->bond[2 * i + 1]);
    static const char *const sources[] = {"", "", "guessed", "listed and guessed"};
    if (f->bonds == 0 && (f->bond != NULL || f->bond_source == CGT_TRAJECTORY_BONDS_LISTED))
        text_print(t, "  bonds: 0\n");
    if (*sources[f->bond_source] != '\0')
        text_print(t, "  bonds: %s\n", sources[f->bond_source]);
    else if (f->bond_source == CGT_TRAJECTORY_BONDS_UNKNOWN && f->bonds > 0)
        text_print(t, "  bonds: WRONG, of no source\n");
    frame_text_columns(t, f);
}

#endif
