/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames made of a caller's columns; see figure_data.h. */
#include "data/figure_data.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "color/given_colors.h"
#include "data/molecule/element_radii.h"
#include "options/numbers.h"

enum { WORD_SIZE = sizeof(((const cgt_trajectory_column *)0)->word[0]) };

typedef struct data_reader {
    figure_data *to;
    const cgt_figure_data *from;
    char *error;
    size_t error_size;
} data_reader;

static int refuse(const data_reader *r, const char *format, ...) __attribute__((format(printf, 2, 3)));
static int refuse(const data_reader *r, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(r->error, r->error_size, format, arguments);
    va_end(arguments);
    return -1;
}

void cgt_figure_data_free(figure_data *d)
{
    for (uint32_t i = 0; i < d->blocks; i++)
        free(d->block[i]);
    memset(d, 0, sizeof *d);
}

/* An array of `count` elements, which is not NULL even where there are none; NULL with a sentence. */
static void *make(const data_reader *r, size_t count, size_t size)
{
    figure_data *const d = r->to;
    void *const block = d->blocks < FIGURE_DATA_BLOCKS ? calloc(count + 1, size) : NULL;
    if (block)
        d->block[d->blocks++] = block;
    else
        refuse(r, "out of memory for the data of frame %llu", (unsigned long long)r->from->number);
    return block;
}

static int is_real(const cgt_array *a)
{
    return a->format == CGT_FORMAT_FLOAT || a->format == CGT_FORMAT_DOUBLE || a->format == CGT_FORMAT_HALF;
}

/* Checks that an array can be read. */
static int check(const data_reader *r, const char *name, const cgt_array *a, uint32_t count, int may_be_whole)
{
    if (count && !a->data)
        return refuse(r, "%s: there is no array", name);
    if (!is_real(a) && (!may_be_whole || cgt_format_get_size(a->format) == 0))
        return refuse(r, "%s: the array's numbers are not of a type that it may have", name);
    return 0;
}

static double number_of(const cgt_array *a, size_t i)
{
    return is_real(a) ? cgt_array_get_number(a, i, 1, 0) : (double)cgt_array_get_whole(a, i, 1, 0);
}

/* Whole numbers from 0 to most. */
static int take_whole(const data_reader *r, const cgt_figure_column *c, double most, uint32_t *to)
{
    for (uint32_t i = 0; i < r->from->points.count; i++) {
        const double value = number_of(&c->values, i);
        if (!(value >= 0.0 && value <= most) || value != floor(value))
            return refuse(r, "%s: number %u is %s, not a whole number from 0 to %s", c->name, i,
                          cgt_number(6, value).text, cgt_number(10, most).text);
        to[i] = (uint32_t)value;
    }
    return 0;
}

static int take_vectors(const data_reader *r, const cgt_figure_column *c, const float **to)
{
    const uint32_t count = r->from->points.count;
    float *const v = make(r, 3 * (size_t)count, sizeof *v);
    if (!v)
        return -1;
    if (!is_real(&c->values) && count)
        return refuse(r, "%s: the array is not one of floats, doubles or halves", c->name);
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < 3; k++)
            v[3 * i + k] = (float)cgt_array_get_number(&c->values, i, 3, k);
    *to = v;
    return 0;
}

/* A column that formulas may name. */
static void add_column(const data_reader *r, const char *name, const float *value, cgt_trajectory_column_kind kind)
{
    cgt_trajectory_frame *const f = &r->to->frame;
    r->to->column[f->columns++] = (cgt_trajectory_column){.name = name, .kind = kind, .value = value};
}

static int take_words(const data_reader *r, const cgt_figure_column *c, cgt_trajectory_column *to)
{
    char(*const word)[WORD_SIZE] = make(r, c->word_count, sizeof *word);
    if (!word)
        return -1;
    for (uint32_t i = 0; i < c->word_count; i++) {
        if (!c->words[i] || strlen(c->words[i]) >= WORD_SIZE)
            return refuse(r, "%s: word %u is missing, or longer than %d letters", c->name, i + 1, WORD_SIZE - 1);
        memcpy(word[i], c->words[i], strlen(c->words[i]) + 1);
    }
    to->kind = CGT_TRAJECTORY_WORD;
    to->words = c->word_count;
    to->word = (const char(*)[WORD_SIZE])word;
    for (uint32_t i = 0; i < r->from->points.count; i++)
        if (!(to->value[i] >= 0.0f && to->value[i] <= (float)c->word_count))
            return refuse(r, "%s: number %u is %s, and there are %u words", c->name, i,
                          cgt_number(6, (double)to->value[i]).text, c->word_count);
    return 0;
}

/* The same, and a column of each component. */
static int take_parts(const data_reader *r, const cgt_figure_column *c, const char *const names[3], const float **to)
{
    const uint32_t count = r->from->points.count;
    if (take_vectors(r, c, to))
        return -1;
    for (int k = 0; k < 3; k++) {
        float *const part = make(r, count, sizeof *part);
        if (!part)
            return -1;
        for (size_t i = 0; i < count; i++)
            part[i] = (*to)[3 * i + (size_t)k];
        add_column(r, names[k], part, CGT_TRAJECTORY_NUMBER);
    }
    return 0;
}

static int take_column(const data_reader *r, const cgt_figure_column *c)
{
    static const char *const velocity[] = {"vx", "vy", "vz"}, *const rgb[] = RGB_COLUMNS;
    const float *ignored;
    cgt_trajectory_frame *const f = &r->to->frame;
    const uint32_t count = r->from->points.count;
    if (!c->name || !*c->name)
        return refuse(r, "a column has no name");
    const int is_whole =
        f->kind == CGT_TRAJECTORY_SPHERES && /* of triangles there would be one each, and not one a vertex */
        (strcmp(c->name, "id") == 0 || strcmp(c->name, "type") == 0 || strcmp(c->name, "element") == 0);
    if (check(r, c->name, &c->values, count, 1))
        return -1;
    if (strcmp(c->name, "velocity") == 0)
        return take_parts(r, c, velocity, &f->velocity);
    if (strcmp(c->name, "rgb") == 0)
        return take_parts(r, c, rgb, &ignored);
    if (strcmp(c->name, "normal") == 0 && f->kind == CGT_TRAJECTORY_TRIANGLES)
        return take_vectors(r, c, &f->vertex_normal);
    float *const value = make(r, count, sizeof *value);
    if (!value)
        return -1;
    for (uint32_t i = 0; i < count; i++)
        value[i] = (float)number_of(&c->values, i);
    add_column(r, c->name, value, CGT_TRAJECTORY_NUMBER);
    if (strcmp(c->name, "radius") == 0)
        r->to->radius = value;
    if (c->words)
        return take_words(r, c, &r->to->column[f->columns - 1]);
    if (!is_whole)
        return 0;
    uint32_t *const whole = make(r, count, sizeof *whole);
    if (!whole || take_whole(r, c, strcmp(c->name, "element") == 0 ? (double)ELEMENTS : (double)UINT32_MAX, whole))
        return -1;
    if (strcmp(c->name, "id") == 0)
        f->id = whole;
    else if (strcmp(c->name, "type") == 0)
        f->type = whole;
    else {
        uint8_t *const element = make(r, count, 1);
        for (uint32_t i = 0; i < count && element; i++)
            element[i] = (uint8_t)whole[i];
        f->element = element;
        return element ? 0 : -1;
    }
    return 0;
}

/* Spheres: after the columns, which tell radii and elements. */
static int take_spheres(const data_reader *r)
{
    cgt_trajectory_frame *const f = &r->to->frame;
    const cgt_figure_points *const p = &r->from->points;
    const float *const radius = r->to->radius;
    float *const xyzr = make(r, 4 * (size_t)p->count, sizeof *xyzr);
    if (!xyzr)
        return -1;
    f->has_radius = radius != NULL;
    for (size_t i = 0; i < p->count; i++) {
        for (size_t k = 0; k < 3; k++)
            xyzr[4 * i + k] = (float)(cgt_array_get_number(&p->positions, i, 3, k) - r->from->origin[k]);
        xyzr[4 * i + 3] = radius             ? radius[i]
                          : p->radius > 0.0f ? p->radius
                          : f->element       ? element_radius(f->element[i]) * f->angstrom
                                             : 0.5f;
    }
    f->xyzr = xyzr;
    return 0;
}

static int take_triangles(const data_reader *r)
{
    cgt_trajectory_frame *const f = &r->to->frame;
    const cgt_figure_points *const p = &r->from->points;
    const cgt_figure_triangles *const t = &r->from->triangles;
    float *const position = make(r, 3 * (size_t)p->count, sizeof *position);
    uint32_t *const index = make(r, 3 * (size_t)t->count, sizeof *index);
    if (!position || !index)
        return -1;
    if (is_real(&t->corners) || cgt_format_get_size(t->corners.format) == 0)
        return refuse(r, "corners of triangles are whole numbers");
    for (size_t i = 0; i < p->count; i++)
        for (size_t k = 0; k < 3; k++)
            position[3 * i + k] = (float)(cgt_array_get_number(&p->positions, i, 3, k) - r->from->origin[k]);
    for (size_t i = 0; i < t->count; i++)
        for (size_t k = 0; k < 3; k++) {
            const uint64_t corner = cgt_array_get_whole(&t->corners, i, 3, k);
            if (corner >= p->count)
                return refuse(r, "triangle %zu has the corner %llu, and there are %u vertices", i,
                              (unsigned long long)corner, p->count);
            index[3 * i + k] = (uint32_t)corner;
        }
    f->position = position;
    f->index = index;
    f->triangles = t->count;
    return 0;
}

static int take_bonds(const data_reader *r)
{
    const cgt_figure_bonds *const b = &r->from->bonds;
    if (b->count && !b->ends)
        return refuse(r, "bonds: there is no array of ends");
    for (size_t i = 0; i < 2 * (size_t)b->count; i++)
        if (b->ends[i] >= r->from->points.count)
            return refuse(r, "bond %zu ends at %u, and there are %u particles", i / 2, b->ends[i],
                          r->from->points.count);
    r->to->frame.bonds = b->count;
    r->to->frame.bond = b->ends;
    r->to->frame.bond_source = b->ends ? CGT_TRAJECTORY_BONDS_LISTED : CGT_TRAJECTORY_BONDS_UNKNOWN;
    return 0;
}

static int take_box(const data_reader *r)
{
    cgt_trajectory_frame *const f = &r->to->frame;
    const cgt_figure_box *const b = &r->from->box;
    double sum = 0.0;
    f->box_min[0] = 1.0f;
    for (int c = 0; c < 3; c++) {
        for (int e = 0; e < 3; e++)
            sum += fabs(f->box_edge[e][c] = b->edges[e][c]);
        f->box_origin[c] = b->corner[c] - r->from->origin[c];
        f->periodic[c] = b->periodic[c];
        f->unwrapped[c] = b->unwrapped[c];
    }
    if (!isfinite(sum + f->box_origin[0] + f->box_origin[1] + f->box_origin[2]))
        return refuse(r, "the box has numbers that are not finite");
    for (int c = 0; c < 3 && sum > 0.0; c++) {
        double low = f->box_origin[c], high = low;
        for (int e = 0; e < 3; e++) {
            low += fmin(b->edges[e][c], 0.0);
            high += fmax(b->edges[e][c], 0.0);
        }
        f->box_min[c] = (float)low;
        f->box_max[c] = (float)high;
    }
    return 0;
}

int cgt_figure_data_take(figure_data *d, const cgt_figure_data *data, char *error, size_t error_size)
{
    const data_reader r = {d, data, error, error_size};
    cgt_figure_data_free(d);
    const cgt_figure_points *const p = &data->points;
    d->frame =
        (cgt_trajectory_frame){.number = data->number,
                               .kind = data->triangles.corners.data ? CGT_TRAJECTORY_TRIANGLES : CGT_TRAJECTORY_SPHERES,
                               .step = data->step,
                               .count = p->count,
                               .time = data->time ? *data->time : NAN,
                               .angstrom = data->angstrom > 0.0f ? data->angstrom : 1.0f};
    if (p->column_count > CGT_TRAJECTORY_MOST_COLUMNS || (p->column_count && !p->columns))
        return refuse(&r, "more than %d columns, or none where there is a number of them", CGT_TRAJECTORY_MOST_COLUMNS);
    if (check(&r, "positions", &p->positions, p->count, 0))
        return -1;
    d->column = make(&r, 3 * (size_t)p->column_count, sizeof *d->column);
    if (!d->column)
        return -1;
    d->frame.column = d->column;
    for (int c = 0; c < 3; c++)
        d->frame.origin[c] = data->origin[c];
    for (uint32_t i = 0; i < p->column_count; i++)
        if (take_column(&r, &p->columns[i]))
            return -1;
    if (d->frame.kind == CGT_TRAJECTORY_TRIANGLES ? take_triangles(&r) : take_spheres(&r))
        return -1;
    return take_bonds(&r) || take_box(&r) ? -1 : 0;
}
