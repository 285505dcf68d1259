/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Hall symbols: S. R. Hall, "Space-group notation with an explicit origin", Acta Cryst. A37 (1981), 517-525, in the
 * form of International Tables B, A1.4.2.3. A symbol names a lattice and up to four operations that generate the
 * group. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/molecule/space_group.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct space_group_row {
    int number;
    const char *name;
    char choice; /* '1' or '2': of the origin; 'H' or 'R': of the axes; 0 */
    const char *hall;
} space_group_row;

static const space_group_row rows[] = {
#include "trajectory/molecule/space_group_table.h"
};
enum { ROWS = sizeof rows / sizeof rows[0] };

/* ---- Operations ------------------------------------------------------------------------------------------------- */

static cif_operation multiply(const cif_operation *a, const cif_operation *b)
{
    cif_operation product;
    for (int i = 0; i < 3; i++) {
        product.shift[i] = a->shift[i];
        for (int j = 0; j < 3; j++) {
            product.turn[i][j] = 0.0;
            for (int k = 0; k < 3; k++)
                product.turn[i][j] += a->turn[i][k] * b->turn[k][j];
            product.shift[i] += a->turn[i][j] * b->shift[j];
        }
        product.shift[i] -= floor(product.shift[i] + 1e-9);
    }
    return product;
}

/* The inverse: 0, or -1 where there is none. */
static int invert(const cif_operation *o, cif_operation *inverse)
{
    const double(*const m)[3] = o->turn;
    double volume = 0.0;
    for (int i = 0; i < 3; i++)
        volume += m[0][i] * (m[1][(i + 1) % 3] * m[2][(i + 2) % 3] - m[1][(i + 2) % 3] * m[2][(i + 1) % 3]);
    for (int i = 0; i < 3; i++) {
        inverse->shift[i] = 0.0;
        for (int j = 0; j < 3; j++) {
            const int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
            inverse->turn[i][j] = (m[a][c] * m[b][d] - m[a][d] * m[b][c]) / volume;
            inverse->shift[i] -= inverse->turn[i][j] * o->shift[j];
        }
    }
    return fabs(volume) > 1e-6 ? 0 : -1;
}

static int are_equal(const cif_operation *a, const cif_operation *b)
{
    double most = 0.0;
    for (int i = 0; i < 3; i++) {
        const double step = a->shift[i] - b->shift[i];
        most = fmax(most, fabs(step - rint(step)));
        for (int j = 0; j < 3; j++)
            most = fmax(most, fabs(a->turn[i][j] - b->turn[i][j]));
    }
    return most < 1e-6;
}

/* Adds an operation that is not there yet: 1, 0 it is there, -1 there are too many. */
static int add(cif_operation *list, uint32_t *count, const cif_operation *o)
{
    for (uint32_t i = 0; i < *count; i++)
        if (are_equal(&list[i], o))
            return 0;
    if (*count == CRYSTAL_MOST_OPERATIONS)
        return -1;
    list[(*count)++] = *o;
    return 1;
}

/* Adds all products, until there are no new ones. */
static int close_group(cif_operation *list, uint32_t *count, const cif_operation *generator, uint32_t generators)
{
    for (uint32_t i = 0; i < *count; i++)
        for (uint32_t g = 0; g < generators; g++) {
            const cif_operation product = multiply(&generator[g], &list[i]);
            if (add(list, count, &product) < 0)
                return -1;
        }
    return 0;
}

/* ---- Hall symbols ----------------------------------------------------------------------------------------------- */

enum { MOST_GENERATORS = 12 };

typedef struct hall_reader {
    cif_operation generator[MOST_GENERATORS];
    uint32_t count;
    int before, axis; /* order and axis of the first rotation */
    uint32_t turns;   /* rotations so far */
} hall_reader;

static const cif_operation itself = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}};

static int take(hall_reader *h, const cif_operation *o)
{
    if (h->count == MOST_GENERATORS)
        return -1;
    h->generator[h->count++] = *o;
    return 0;
}

static int take_shift(hall_reader *h, double x, double y, double z)
{
    cif_operation o = itself;
    o.shift[0] = x;
    o.shift[1] = y;
    o.shift[2] = z;
    return take(h, &o);
}

/* "F" and "-F": the centrings, and the inversion. */
static int take_lattice(hall_reader *h, const char **at)
{
    const double half = 0.5, third = 1.0 / 3.0;
    if (**at == '-') {
        cif_operation inversion = itself;
        for (int i = 0; i < 3; i++)
            inversion.turn[i][i] = -1.0;
        if (take(h, &inversion))
            return -1;
        (*at)++;
    }
    switch (*(*at)++) {
    case 'P': return 0;
    case 'A': return take_shift(h, 0, half, half);
    case 'B': return take_shift(h, half, 0, half);
    case 'C': return take_shift(h, half, half, 0);
    case 'I': return take_shift(h, half, half, half);
    case 'R': return take_shift(h, 2 * third, third, third);
    case 'H': return take_shift(h, 2 * third, third, 0);
    case 'S': return take_shift(h, third, third, 2 * third);
    case 'T': return take_shift(h, third, 2 * third, third);
    case 'F': return take_shift(h, 0, half, half) || take_shift(h, half, 0, half);
    default: return -1;
    }
}

/* The rotation of an order about z, or one of the others that Hall names by marks. */
static int find_turn(int order, char mark, double turn[3][3])
{
    static const double table[][3][3] = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},   {{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
                                         {{0, -1, 0}, {1, -1, 0}, {0, 0, 1}}, {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
                                         {{1, -1, 0}, {1, 0, 0}, {0, 0, 1}},  {{0, -1, 0}, {-1, 0, 0}, {0, 0, -1}},
                                         {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}},  {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}};
    const int row = mark == '\'' && order == 2  ? 5
                    : mark == '"' && order == 2 ? 6
                    : mark == '*' && order == 3 ? 7
                    : mark != '\0'              ? -1
                    : order >= 1 && order <= 4  ? order - 1
                    : order == 6                ? 4
                                                : -1;
    if (row >= 0)
        memcpy(turn, table[row], sizeof table[row]);
    return row >= 0 ? 0 : -1;
}

/* What is behind the order: axis, screw and translations. */
static int take_marks(const char **at, int order, cif_operation *o, char *axis, char *mark)
{
    static const struct {
        char letter;
        double shift[3];
    } letters[] = {{'a', {0.5, 0, 0}},  {'b', {0, 0.5, 0}},  {'c', {0, 0, 0.5}},  {'n', {0.5, 0.5, 0.5}},
                   {'u', {0.25, 0, 0}}, {'v', {0, 0.25, 0}}, {'w', {0, 0, 0.25}}, {'d', {0.25, 0.25, 0.25}}};
    int screw = 0;
    for (; **at != '\0' && **at != ' ' && **at != '_' && **at != '('; (*at)++) {
        const char c = **at;
        int is_known = 0;
        for (size_t k = 0; k < sizeof letters / sizeof letters[0]; k++)
            if (c == letters[k].letter) {
                is_known = 1;
                for (int i = 0; i < 3; i++)
                    o->shift[i] += letters[k].shift[i];
            }
        if (c >= '1' && c < '0' + order && screw == 0)
            screw = c - '0';
        else if (c >= 'x' && c <= 'z')
            *axis = c;
        else if (c == '\'' || c == '"' || c == '*')
            *mark = c;
        else if (!is_known)
            return -1;
    }
    return screw;
}

/* "-4acx", "2\"", "31": the axis that is not told follows from the rotations before it. */
static int take_rotation(hall_reader *h, const char **at)
{
    cif_operation o = itself, turned;
    char axis = '\0', mark = '\0';
    const int is_improper = **at == '-';
    *at += is_improper;
    const int order = **at - '0';
    if (order < 1 || order > 6 || order == 5)
        return -1;
    (*at)++;
    const int screw = take_marks(at, order, &o, &axis, &mark);
    if (screw < 0)
        return -1;
    h->turns++;
    int along = axis != '\0' ? axis - 'x' : 2;
    if (axis == '\0' && mark == '\0' && h->turns == 2 && order == 2 && (h->before == 2 || h->before == 4))
        along = 0;
    else if (axis == '\0' && mark == '\0' && h->turns == 2 && order == 2 && (h->before == 3 || h->before == 6))
        mark = '\'';
    else if (axis == '\0' && mark == '\0' && h->turns == 3 && order == 3)
        mark = '*';
    if (axis == '\0' && (mark == '\'' || mark == '"') && h->turns > 1)
        along = h->axis;
    if (find_turn(order, mark, o.turn))
        return -1;
    turned = o;
    for (int i = 0; i < 3 && mark != '*'; i++) /* from z to the axis */
        for (int j = 0; j < 3; j++)
            turned.turn[(i + along + 1) % 3][(j + along + 1) % 3] = o.turn[i][j];
    turned.shift[along] += screw > 0 ? (double)screw / order : 0.0;
    for (int i = 0; i < 9 && is_improper; i++)
        turned.turn[i / 3][i % 3] = -turned.turn[i / 3][i % 3];
    if (h->turns == 1 || (mark == '\0' && h->turns == 2)) {
        h->before = h->turns == 1 ? order : h->before;
        h->axis = h->turns == 1 ? along : h->axis;
    }
    return take(h, &turned);
}

/* "(0 0 1)", twelfths, or "(x,y,z+1/4)": the operations seen from another origin and other axes. */
static int change_basis(hall_reader *h, const char *text)
{
    cif_operation basis = itself, inverse = itself;
    const char *const end = strchr(text, ')');
    char *rest = (char *)text;
    if (end == NULL)
        return -1;
    if (memchr(text, ',', (size_t)(end - text)) != NULL) {
        if (cif_crystal_read_operation(&basis, (text_span){text, end}) != NULL || invert(&basis, &inverse))
            return -1;
    } else {
        for (int i = 0; i < 3; i++) {
            basis.shift[i] = (double)strtol(rest, &rest, 10) / 12.0;
            inverse.shift[i] = -basis.shift[i];
        }
        if (strspn(rest, " ") != (size_t)(end - rest))
            return -1;
    }
    for (uint32_t g = 0; g < h->count; g++) {
        const cif_operation right = multiply(&h->generator[g], &inverse);
        h->generator[g] = multiply(&basis, &right);
    }
    return 0;
}

uint32_t space_group_of_hall(const char *hall, cif_operation operation[CRYSTAL_MOST_OPERATIONS])
{
    hall_reader h = {.count = 0};
    const char *at = hall;
    uint32_t count = 1;
    at += strspn(at, " ");
    if (take_lattice(&h, &at))
        return 0;
    while (*(at += strspn(at, " _")) != '\0') {
        if (*at == '(' ? change_basis(&h, at + 1) : take_rotation(&h, &at))
            return 0;
        if (*at == '(')
            break;
    }
    operation[0] = itself;
    return close_group(operation, &count, h.generator, h.count) ? 0 : count;
}

/* ---- Names ------------------------------------------------------------------------------------------------------ */

enum { LONGEST = 31 };

/* Copies a name without blanks, and without the ones that stand for an axis of nothing, in small letters. Without
 * `signs`, also without the signs of -3 in cubic groups of old. */
static void copy_name(const char *name, int ones, int signs, char to[LONGEST + 1])
{
    size_t length = 0;
    for (const char *p = name; *p != '\0' && length < LONGEST; p++) {
        const int is_alone =
            *p == '1' && p > name && (p[-1] == ' ' || p[-1] == '_') && (p[1] == ' ' || p[1] == '_' || p[1] == '\0');
        if (*p == ' ' || *p == '_' || (is_alone && !ones) || (*p == '-' && p[1] == '3' && !signs))
            continue;
        to[length++] = *p >= 'A' && *p <= 'Z' ? (char)(*p - 'A' + 'a') : *p;
    }
    to[length] = '\0';
}

static int is_named(const space_group_row *row, const char *name)
{
    char wanted[LONGEST + 1], own[LONGEST + 1];
    const int is_monoclinic = row->number >= 3 && row->number <= 15, is_cubic = row->number >= 200;
    for (int way = 0; way < 3; way++) {
        if ((way == 1 && !is_monoclinic) || (way == 2 && !is_cubic))
            continue;
        copy_name(name, 1, way != 2, wanted);
        copy_name(row->name, way != 1, way != 2, own);
        if (strcmp(wanted, own) == 0)
            return 1;
    }
    return 0;
}

/* Whether the operations leave the lengths and angles of a cell as they are, within 1 %. */
static int fits(const cif_operation *list, uint32_t count, const double edge[3][3])
{
    double g[3][3], largest = 0.0;
    for (int i = 0; i < 9; i++) {
        const double *const a = edge[i / 3], *const b = edge[i % 3];
        g[i / 3][i % 3] = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        largest = fmax(largest, fabs(g[i / 3][i % 3]));
    }
    for (uint32_t n = 0; n < count; n++)
        for (int i = 0; i < 9; i++) {
            double sum = 0.0;
            for (int k = 0; k < 9; k++)
                sum += list[n].turn[k / 3][i / 3] * g[k / 3][k % 3] * list[n].turn[k % 3][i % 3];
            if (fabs(sum - g[i / 3][i % 3]) > 0.01 * largest)
                return 0;
        }
    return 1;
}

/* Whether a row is meant by a number alone: the first of it, and no other of the axes could be. */
static int is_numbered(const space_group_row *row, int number)
{
    const int is_first = row == rows || row[-1].number != number || row->choice == 'R';
    return row->number == number && is_first && (number < 3 || number > 74);
}

/* The choice behind a colon, or a blank: S and Z are origins 1 and 2. The name is cut there. */
static char take_choice(const char *given, char name[LONGEST + 1])
{
    static const char letters[] = "12HRSZ", means[] = "12HR12";
    snprintf(name, LONGEST + 1, "%s", given);
    char *const colon = strchr(name, ':');
    const size_t length = strlen(name);
    char *const blank =
        length > 2 && name[length - 2] == ' ' && strchr("HRSZ", name[length - 1]) != NULL ? name + length - 2 : NULL;
    char *const at = colon != NULL ? colon : blank;
    if (at == NULL)
        return '\0';
    const char *const found = at[1] != '\0' ? strchr(letters, at[1]) : NULL;
    *at = '\0';
    return found != NULL ? means[found - letters] : '\0';
}

uint32_t space_group_of_name(const char *given, const double edge[3][3],
                             cif_operation operation[CRYSTAL_MOST_OPERATIONS])
{
    char name[LONGEST + 1], *end;
    const char choice = take_choice(given, name);
    const long number = strtol(name, &end, 10);
    const int by_number = end > name && *end == '\0';
    for (size_t i = 0; i < ROWS; i++) {
        const space_group_row *const row = &rows[i];
        if (!(by_number ? is_numbered(row, (int)number) : is_named(row, name)) ||
            (choice != '\0' && choice != row->choice))
            continue;
        const uint32_t count = space_group_of_hall(row->hall, operation);
        if (count == 0 || !fits(operation, count, edge))
            continue;
        const int is_ambiguous = choice == '\0' && (row->choice == '1' || row->choice == '2');
        return is_ambiguous ? 0 : count;
    }
    return 0;
}
