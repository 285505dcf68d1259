/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Formulas over columns: binding names to a frame, and computing; see expression.h. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "picture/figures/expression_steps.h"

enum { BLOCK = 64 }; /* elements that go through all steps together */

/* ---- Binding ------------------------------------------------------------------------------------------------ */

/* What every frame has, or has in fields of its own. Returns 1 where the name is one of them. */
static int bind_field(const char *name, const trajectory_frame *f, const float *speed, expression_source *s)
{
    const int spheres = f->kind == TRAJECTORY_SPHERES;
    const float *places = spheres ? f->xyzr : f->position;
    *s = (expression_source){.stride = 1};
    if (strlen(name) == 1 && *name >= 'x' && *name <= 'z') {
        s->value = places + (*name - 'x');
        s->stride = spheres ? 4 : 3;
        s->number = f->origin[*name - 'x'];
    } else if (strcmp(name, "radius") == 0 && spheres) {
        s->value = places + 3;
        s->stride = 4;
    } else if (strcmp(name, "speed") == 0 && speed) {
        s->value = speed;
    } else if (strcmp(name, "id") == 0 && f->id) {
        s->whole = f->id;
    } else if (strcmp(name, "type") == 0 && f->type) {
        s->whole = f->type;
    } else if (strcmp(name, "element") == 0 && f->element) {
        s->byte = f->element;
    } else if (strcmp(name, "index") == 0) {
        s->is_index = 1;
    } else if (strcmp(name, "step") == 0) {
        s->number = (double)f->step;
    } else if (strcmp(name, "time") == 0) {
        s->number = f->time;
    } else {
        return 0;
    }
    return 1;
}

/* "x, y, z, radius, c_pe": what there is. */
static void list_columns(const trajectory_frame *f, char *text, size_t size)
{
    size_t used = (size_t)snprintf(text, size, "x, y, z");
    for (uint32_t i = 0; i < f->columns && used < size; i++)
        if (strlen(f->column[i].name) != 1 || !strchr("xyz", *f->column[i].name))
            used += (size_t)snprintf(text + used, size - used, ", %s", f->column[i].name);
}

int expression_bind(expression *e, const trajectory_frame *frame, const float *speed, char *error, size_t error_size)
{
    for (uint32_t i = 0; i < e->name_count; i++) {
        const trajectory_column *column = trajectory_find_column(frame, e->names[i]);
        if (bind_field(e->names[i], frame, speed, &e->sources[i]))
            continue;
        if (column && column->value) {
            e->sources[i] = (expression_source){.value = column->value, .stride = 1};
            continue;
        }
        char columns[512];
        list_columns(frame, columns, sizeof columns);
        snprintf(error, error_size, "frame %llu has no column \"%s\", but %s", (unsigned long long)frame->number,
                 e->names[i], columns);
        return -1;
    }
    return 0;
}

/* ---- Computing ---------------------------------------------------------------------------------------------- */

static void load(const expression_source *s, uint32_t first, uint32_t count, double *to)
{
    for (uint32_t i = 0; i < count; i++) {
        const size_t k = (size_t)first + i;
        to[i] = s->value      ? (double)s->value[k * s->stride] + s->number
                : s->whole    ? (double)s->whole[k]
                : s->byte     ? (double)s->byte[k]
                : s->is_index ? (double)k
                              : s->number;
    }
}

static double apply_one(expression_op op, double a)
{
    switch (op) {
    case OP_NEGATE: return -a;
    case OP_NOT: return a == 0.0;
    case OP_SQRT: return sqrt(a);
    case OP_ABS: return fabs(a);
    case OP_EXP: return exp(a);
    case OP_LOG: return log(a);
    case OP_LOG10: return log10(a);
    case OP_SIN: return sin(a);
    case OP_COS: return cos(a);
    case OP_TAN: return tan(a);
    case OP_FLOOR: return floor(a);
    case OP_CEIL: return ceil(a);
    default: return a > 0.0 ? 1.0 : a < 0.0 ? -1.0 : a;
    }
}

static double apply_two(expression_op op, double a, double b)
{
    switch (op) {
    case OP_ADD: return a + b;
    case OP_SUBTRACT: return a - b;
    case OP_MULTIPLY: return a * b;
    case OP_DIVIDE: return a / b;
    case OP_POWER: return b == 2.0 ? a * a : pow(a, b);
    case OP_LESS: return a < b;
    case OP_AT_MOST: return a <= b;
    case OP_GREATER: return a > b;
    case OP_AT_LEAST: return a >= b;
    case OP_EQUAL: return a == b;
    case OP_UNEQUAL: return a != b;
    case OP_AND: return a != 0.0 && b != 0.0;
    case OP_OR: return a != 0.0 || b != 0.0;
    case OP_MIN: return fmin(a, b);
    case OP_MAX: return fmax(a, b);
    default: return fmod(a, b);
    }
}

/* The parser has seen to it that steps find their values on the stack. NOLINTBEGIN(clang-analyzer-core.*) */
static void run_block(const expression *e, uint32_t first, uint32_t count, double stack[EXPRESSION_STACK][BLOCK])
{
    uint32_t top = 0; /* values on the stack */
    for (uint32_t k = 0; k < e->step_count; k++) {
        const expression_step *step = &e->steps[k];
        if (step->op == OP_NUMBER || step->op == OP_NAME) {
            if (step->op == OP_NAME)
                load(&e->sources[step->name], first, count, stack[top]);
            else
                for (uint32_t i = 0; i < count; i++)
                    stack[top][i] = step->number;
            top++;
        } else if (step->op <= OP_SIGN) {
            for (uint32_t i = 0; i < count; i++)
                stack[top - 1][i] = apply_one(step->op, stack[top - 1][i]);
        } else if (step->op <= OP_MOD) {
            top--;
            for (uint32_t i = 0; i < count; i++)
                stack[top - 1][i] = apply_two(step->op, stack[top - 1][i], stack[top][i]);
        } else {
            top -= 2;
            for (uint32_t i = 0; i < count; i++)
                stack[top - 1][i] = stack[top - 1][i] != 0.0 ? stack[top][i] : stack[top + 1][i];
        }
    }
}
/* NOLINTEND(clang-analyzer-core.*) */

void expression_values(const expression *e, uint32_t first, uint32_t count, double *values)
{
    double stack[EXPRESSION_STACK][BLOCK];
    for (uint32_t done = 0; done < count; done += BLOCK) {
        const uint32_t block = count - done < BLOCK ? count - done : BLOCK;
        run_block(e, first + done, block, stack);
        memcpy(values + done, stack[0], block * sizeof *values);
    }
}
