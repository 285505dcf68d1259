/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The steps of a parsed formula, between the parser (expression.c) and what runs it (expression_run.c). */
#ifndef EXPRESSION_STEPS_H
#define EXPRESSION_STEPS_H

#include "data/expression/expression.h"
#include "data/molecule/element_symbols.h"

enum {
    EXPRESSION_STEPS = 128,
    EXPRESSION_STACK = 16,
    EXPRESSION_NAMES = 16,
    EXPRESSION_WORDS = 32,
    EXPRESSION_NAME_SIZE = 64
};

/* Of an operation with several operands, the deepest on the stack is the first. */
typedef enum expression_op {
    OP_NUMBER,
    OP_NAME,
    /* one operand */
    OP_NEGATE,
    OP_NOT,
    OP_SQRT,
    OP_ABS,
    OP_EXP,
    OP_LOG,
    OP_LOG10,
    OP_SIN,
    OP_COS,
    OP_TAN,
    OP_FLOOR,
    OP_CEIL,
    OP_SIGN,
    /* two */
    OP_ADD,
    OP_SUBTRACT,
    OP_MULTIPLY,
    OP_DIVIDE,
    OP_POWER,
    OP_LESS,
    OP_AT_MOST,
    OP_GREATER,
    OP_AT_LEAST,
    OP_EQUAL,
    OP_UNEQUAL,
    OP_AND,
    OP_OR,
    OP_MIN,
    OP_MAX,
    OP_MOD,
    /* three */
    OP_IF
} expression_op;

typedef struct expression_step {
    expression_op op;
    uint32_t name; /* of OP_NAME: its source */
    double number; /* of OP_NUMBER */
} expression_step;

enum { EXPRESSION_MEMBERS = 1024 }; /* words of a column: as many as readers tell apart */

/* Lists of words that have a name of their own. */
typedef enum expression_list { LIST_PROTEIN, LIST_WATER, LIST_BACKBONE, EXPRESSION_LISTS } expression_list;

/* A word that a column is compared with, or a list of them. */
typedef struct expression_word {
    uint32_t column;      /* the name of the column */
    expression_list list; /* EXPRESSION_LISTS: one word */
    int is_quoted;        /* else it is the column `bare` where the other one has no words */
    uint32_t bare;
    char text[EXPRESSION_NAME_SIZE];
} expression_word;

/* Where the values of a name lie: one of the pointers is set, or the number stands for all. */
typedef struct expression_source {
    const float *value;
    const uint32_t *whole;
    const uint8_t *byte;
    size_t stride;         /* elements */
    const uint8_t *member; /* of a list: by the number of a word in value, whether it is in the list */
    double number;         /* that stands for all, or is added to value */
    int is_index;
} expression_source;

struct expression {
    uint32_t step_count, name_count, word_count;
    expression_step steps[EXPRESSION_STEPS];
    char storage[EXPRESSION_NAMES][EXPRESSION_NAME_SIZE];
    const char *names[EXPRESSION_NAMES];
    int is_needed[EXPRESSION_NAMES]; /* by a frame: the name is no word whatever the columns are */
    expression_word words[EXPRESSION_WORDS];
    expression_source sources[EXPRESSION_NAMES + EXPRESSION_WORDS]; /* of names, then of words */
    uint8_t members[EXPRESSION_LISTS][EXPRESSION_MEMBERS + 1];
};

#endif
