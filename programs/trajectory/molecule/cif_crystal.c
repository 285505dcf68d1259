/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Cells and symmetry of crystals. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/molecule/cif_crystal.h"
#include "trajectory/molecule/molecule_atom.h"
#include "trajectory/molecule/space_group.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#define SAME 0.1 /* Angstrom: files round 1/3 to 0.333, while atoms are farther apart than this */

/* ---- The cell ----------------------------------------------------------------------------------------------- */

void cif_crystal_clear(cif_crystal *c)
{
    memset(c->length, 0, sizeof c->length);
    memset(c->angle, 0, sizeof c->angle);
    c->group[0] = c->hall[0] = c->number[0] = c->unread[0] = '\0';
    c->is_magnetic = 0;
    c->operations = c->centrings = 0;
    c->has_cell = 0;
}

int cif_number(text_span text, double *value)
{
    const char *const bracket = memchr(text.begin, '(', text_length(text));
    text.end = bracket != NULL ? bracket : text.end;
    return field_double(text, value);
}

static int has(const char *tag, const char *part) { return strstr(tag, part) != NULL; }

int cif_crystal_names_group(const char *tag)
{
    const int is_group = strncmp(tag, "_space_group_", 13) == 0 && !has(tag, "symop") && !has(tag, "transform");
    return (is_group || strncmp(tag, "_symmetry_", 10) == 0) &&
           (has(tag, "_name") || has(tag, "number") || has(tag, "reference_setting"));
}

/* Whether a tag gives operations in a form that is not read, such as those of superspace. */
static int gives_operations(const char *tag)
{
    return (has(tag, "symop") || has(tag, "symmetry_equiv") || has(tag, "symgen")) && !has(tag, "_id") &&
           !has(tag, "description") && !has(tag, "mxmymz") && !has(tag, "timereversal");
}

void cif_crystal_note(cif_crystal *c, const char *tag)
{
    if (c->unread[0] == '\0' && (cif_crystal_names_group(tag) || gives_operations(tag)))
        snprintf(c->unread, sizeof c->unread, "%s", tag);
}

void cif_crystal_take(cif_crystal *c, const char *tag, text_span value)
{
    static const char *const numbers[6] = {"_cell_length_a",    "_cell_length_b",   "_cell_length_c",
                                           "_cell_angle_alpha", "_cell_angle_beta", "_cell_angle_gamma"};
    for (int i = 0; i < 6; i++) {
        double *const number = i < 3 ? &c->length[i] : &c->angle[i - 3];
        c->has_cell |= strcmp(tag, numbers[i]) == 0;
        if (strcmp(tag, numbers[i]) == 0 && !cif_number(value, number))
            *number = NAN;
    }
    if (cif_crystal_names_group(tag)) {
        char *const to = has(tag, "hall") ? c->hall : has(tag, "number") ? c->number : c->group;
        c->is_magnetic |= has(tag, "magn");
        if (*to == '\0')
            snprintf(to, sizeof c->group, "%.*s", (int)text_length(value), value.begin);
    } else {
        cif_crystal_note(c, tag);
    }
}

int cif_crystal_cell(const cif_crystal *c, double edge[3][3]) { return molecule_cell(c->length, c->angle, edge); }

/* ---- Operations --------------------------------------------------------------------------------------------- */

/* Reads a number or a fraction such as 1/2 from the front of text: 1 or 0. */
static int take_amount(text_span *text, double *value)
{
    double part[2] = {0.0, 1.0};
    for (int i = 0; i < 2; i++) {
        const char *end = text->begin;
        while (end < text->end && (*end == '.' || (*end >= '0' && *end <= '9')))
            end++;
        if (!field_double((text_span){text->begin, end}, &part[i]))
            return 0;
        text->begin = end;
        if (i > 0 || end == text->end || *end != '/')
            break;
        text->begin++;
    }
    *value = part[0] / part[1];
    return isfinite(*value);
}

/* Reads one term: +x, -1/2, 2*x, 2x. Returns 1 or 0. */
static int take_term(text_span *text, double turn[3], double *shift)
{
    static const char axes[] = "xyzXYZ";
    const double sign = *text->begin == '-' ? -1.0 : 1.0;
    double amount = 1.0;
    text->begin += *text->begin == '-' || *text->begin == '+';
    text_trim(text);
    const int has_amount = text->begin < text->end && strchr(axes, *text->begin) == NULL;
    if (text->begin == text->end || (has_amount && !take_amount(text, &amount)))
        return 0;
    text_trim(text);
    const int is_product = has_amount && text->begin < text->end && *text->begin == '*';
    text->begin += is_product;
    const char *const axis = text->begin < text->end ? memchr(axes, *text->begin, sizeof axes - 1) : NULL;
    if (axis != NULL) {
        turn[(axis - axes) % 3] += sign * amount;
        text->begin++;
    } else {
        *shift += sign * amount;
    }
    text_trim(text);
    return axis != NULL || (has_amount && !is_product);
}

static double determinant(const double m[3][3])
{
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

static const char wrong[] = "not an operation of symmetry, such as -x, y+1/2, z";
static const char too_many[] = "more operations of symmetry than the 192 that a space group may have";

const char *cif_crystal_read_operation(cif_operation *o, text_span text)
{
    int is_magnetic = 0;
    memset(o, 0, sizeof *o);
    for (int row = 0; row < 3; row++) {
        const char *const comma = memchr(text.begin, ',', text_length(text));
        text_span part = {text.begin, comma != NULL ? comma : text.end};
        if (row < 2 && comma == NULL)
            return wrong;
        text_trim(&part);
        do {
            if (part.begin == part.end || !take_term(&part, o->turn[row], &o->shift[row]))
                return wrong;
        } while (part.begin < part.end && (*part.begin == '+' || *part.begin == '-'));
        if (part.begin < part.end)
            return wrong;
        is_magnetic = comma != NULL;
        text.begin = is_magnetic ? comma + 1 : text.end;
    }
    text_trim(&text);
    if (is_magnetic && !text_is(text, "+1") && !text_is(text, "-1") && !text_is(text, "1"))
        return wrong;
    return fabs(fabs(determinant((const double(*)[3])o->turn)) - 1.0) > 1e-6 ? wrong : NULL;
}

const char *cif_crystal_add_operation(cif_crystal *c, text_span text)
{
    if (c->operations == CRYSTAL_MOST_OPERATIONS)
        return too_many;
    const char *const reason = cif_crystal_read_operation(&c->operation[c->operations], text);
    c->operations += reason == NULL;
    return reason;
}

const char *cif_crystal_add_centring(cif_crystal *c, text_span text)
{
    cif_operation o;
    if (c->centrings == CRYSTAL_MOST_CENTRINGS)
        return "more centrings than a cell may have";
    const char *const reason = cif_crystal_read_operation(&o, text);
    memcpy(c->centring[c->centrings], o.shift, sizeof o.shift);
    c->centrings += reason == NULL;
    return reason;
}

const char *cif_crystal_center(cif_crystal *c)
{
    static const char itself[] = "x,y,z";
    if (c->operations == 0 && c->centrings > 0)
        cif_crystal_add_operation(c, (text_span){itself, itself + sizeof itself - 1});
    const uint32_t listed = c->operations;
    for (uint32_t k = 0; k < c->centrings; k++) {
        const double *const shift = c->centring[k];
        for (uint32_t i = 0; i < listed && (shift[0] != 0.0 || shift[1] != 0.0 || shift[2] != 0.0); i++) {
            if (c->operations == CRYSTAL_MOST_OPERATIONS)
                return too_many;
            cif_operation *const o = &c->operation[c->operations++];
            *o = c->operation[i];
            for (int axis = 0; axis < 3; axis++)
                o->shift[axis] += shift[axis];
        }
    }
    c->centrings = 0;
    return NULL;
}

/* P 1 in whatever notation: the group without symmetry. */
static int is_triclinic(const char *group)
{
    char word[sizeof((cif_crystal *)0)->group];
    size_t length = 0;
    for (const char *p = group; *p != '\0'; p++)
        if (*p != ' ' && *p != '_' && *p != '\'')
            word[length++] = *p;
    word[length] = '\0';
    return *word == '\0' || strcasecmp(word, "P1") == 0 || strcmp(word, "1") == 0 || strcmp(word, "1.1") == 0 ||
           strcmp(word, "P1.1") == 0;
}

int cif_crystal_is_listed(const cif_crystal *c, const char **what)
{
    const double(*const turn)[3] = c->operation[0].turn;
    const double trace = turn[0][0] + turn[1][1] + turn[2][2];
    *what = c->group[0] != '\0'    ? c->group
            : c->hall[0] != '\0'   ? c->hall
            : c->number[0] != '\0' ? c->number
                                   : c->unread;
    if (is_triclinic(*what) && c->unread[0] == '\0')
        return 1;
    return c->operations > 1 || (c->operations == 1 && trace < 2.5);
}

int cif_crystal_apply_group(cif_crystal *c, const double edge[3][3])
{
    if (c->operations > 0 || c->is_magnetic || c->unread[0] != '\0')
        return 0;
    c->operations = c->hall[0] != '\0' ? space_group_of_hall(c->hall, c->operation) : 0;
    if (c->operations == 0 && c->group[0] != '\0')
        c->operations = space_group_of_name(c->group, edge, c->operation);
    if (c->operations == 0 && c->number[0] != '\0')
        c->operations = space_group_of_name(c->number, edge, c->operation);
    return c->operations > 0;
}

/* ---- Images ------------------------------------------------------------------------------------------------- */

int cif_crystal_reserve(cif_crystal *c, size_t i)
{
    if (i < c->capacity)
        return 0;
    const size_t capacity = 2 * c->capacity + 64;
    if (trajectory_grow(&c->place, capacity, sizeof *c->place))
        return -1;
    c->capacity = capacity;
    return 0;
}

/* Moves a place into the cell; what rounding leaves just below 0 becomes 0, not 1. */
static void wrap(double p[3])
{
    for (int k = 0; k < 3; k++) {
        p[k] -= floor(p[k]);
        p[k] = p[k] == 1.0 ? 0.0 : p[k];
    }
}

static void to_position(const double edge[3][3], const double p[3], double position[3])
{
    for (int k = 0; k < 3; k++)
        position[k] = p[0] * edge[0][k] + p[1] * edge[1][k] + p[2] * edge[2][k];
}

static int are_same(const double edge[3][3], const double a[3], const double b[3])
{
    double step[3], d[3];
    for (int k = 0; k < 3; k++)
        step[k] = a[k] - b[k] - round(a[k] - b[k]);
    to_position(edge, step, d);
    return d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < SAME * SAME;
}

/* Finds the images of a place: how many, the place itself first. */
static uint32_t find_images(const cif_crystal *c, const double edge[3][3], const double place[3],
                            double image[CRYSTAL_MOST_OPERATIONS + 1][3])
{
    uint32_t images = 1;
    memcpy(image[0], place, sizeof image[0]);
    wrap(image[0]);
    for (uint32_t i = 0; i < c->operations; i++) {
        const cif_operation *const o = &c->operation[i];
        double *const p = image[images];
        for (int k = 0; k < 3; k++)
            p[k] = o->turn[k][0] * place[0] + o->turn[k][1] * place[1] + o->turn[k][2] * place[2] + o->shift[k];
        wrap(p);
        int is_known = 0;
        for (uint32_t j = 0; j < images && !is_known; j++)
            is_known = are_same(edge, p, image[j]);
        images += !is_known;
    }
    return images;
}

int cif_crystal_lists_images(const cgt_trajectory *t, const cif_crystal *c, const double edge[3][3], uint32_t count)
{
    double image[CRYSTAL_MOST_OPERATIONS + 1][3];
    for (size_t i = 0; i < count; i++) {
        const uint32_t images = find_images(c, edge, c->place[i], image);
        for (size_t j = 0; j < count; j++)
            for (uint32_t k = 1; k < images && j != i && t->store.element[i] == t->store.element[j]; k++)
                if (are_same(edge, image[k], c->place[j]))
                    return 1;
    }
    return 0;
}

static void store_image(cgt_trajectory *t, size_t from, size_t to, const double position[3], const int *slot, int slots)
{
    trajectory_store *const s = &t->store;
    for (int k = 0; k < 3; k++)
        s->xyzr[4 * to + (size_t)k] = trajectory_place(t, (size_t)k, position[k]);
    s->xyzr[4 * to + 3] = s->xyzr[4 * from + 3];
    s->type[to] = s->type[from];
    s->element[to] = s->element[from];
    s->place[to] = s->place[from];
    for (int k = 0; k < slots; k++)
        if (slot[k] > 0)
            columns_values(t, slot[k])[to] = columns_values(t, slot[k])[from];
}

int cif_crystal_fill(cgt_trajectory *t, const cif_crystal *c, const int *slot, int slots, uint32_t *count)
{
    double image[CRYSTAL_MOST_OPERATIONS + 1][3], position[3], edges[3][3];
    const double(*const edge)[3] = (const double(*)[3])edges;
    const size_t listed = *count;
    size_t all = listed;
    if (!cif_crystal_cell(c, edges))
        return trajectory_fail(t, 0, "coordinates are fractions of the cell, but %s",
                               c->has_cell ? "its edges and angles are those of none" : "the file has no cell");
    for (size_t i = 0; i < listed; i++) {
        const uint32_t images = find_images(c, edge, c->place[i], image);
        if (images - 1 > t->options.max_count - all)
            return trajectory_fail(t, 0, "with their images more spheres than the limit of %" PRIu64,
                                   t->options.max_count);
        if (trajectory_reserve(t, all + images, SIZE_MAX) < 0)
            return -1;
        for (uint32_t k = 0; k < images; k++) {
            to_position(edge, image[k], position);
            store_image(t, i, k == 0 ? i : all++, position, slot, slots);
        }
    }
    *count = (uint32_t)all;
    return 1;
}
