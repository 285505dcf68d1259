/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Labels of spheres; see label_rules.h. */
#include "data/expression/label_rules.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "data/molecule/element_symbols.h"
#include "data/frame_access.h"
#include "options/numbers.h"

enum { BLOCK = 256 };

int cgt_label_rules_split(label_rules *rules, const char *text, char *error, size_t error_size)
{
    const char *brace;
    while ((brace = strchr(text, '{')) != NULL) {
        const char *const end = strchr(brace, '}');
        label_part *const part = &rules->part[rules->parts];
        if (!end)
            return cgt_refuse(error, error_size, "\"%s\": a brace is not closed", text);
        if (rules->parts == LABEL_PARTS)
            return cgt_refuse(error, error_size, "more than %d pairs of braces", LABEL_PARTS);
        if (brace - text >= LABEL_SIZE || end - brace > LABEL_SIZE)
            return cgt_refuse(error, error_size, "\"%s\": a part of the text is longer than %d letters", text,
                              LABEL_SIZE - 1);
        memcpy(part->before, text, (size_t)(brace - text));
        memcpy(part->name, brace + 1, (size_t)(end - brace - 1));
        part->value = cgt_expression_parse(part->name, error, error_size);
        if (!part->value)
            return -1;
        rules->parts++;
        text = end + 1;
    }
    if (strlen(text) >= LABEL_SIZE)
        return cgt_refuse(error, error_size, "\"%s\": a part of the text is longer than %d letters", text,
                          LABEL_SIZE - 1);
    memcpy(rules->after, text, strlen(text));
    return 0;
}

void cgt_label_rules_free(label_rules *rules)
{
    cgt_expression_free(rules->which);
    for (uint32_t i = 0; i < rules->parts; i++)
        cgt_expression_free(rules->part[i].value);
    memset(rules, 0, sizeof *rules);
}

/* Appends a text, in whole characters as far as there is room. */
static void append(char to[LABEL_SIZE], const char *text)
{
    const size_t used = strlen(to);
    size_t length = strlen(text);
    length = length < LABEL_SIZE - used ? length : LABEL_SIZE - 1 - used;
    while (length && ((unsigned char)text[length] & 0xc0) == 0x80)
        length--;
    memcpy(to + used, text, length);
    to[used + length] = '\0';
}

static void append_part(const label_part *part, const cgt_trajectory_frame *f, uint32_t i, char to[LABEL_SIZE])
{
    const cgt_trajectory_column *const column = frame_column(f, part->name);
    double value;
    append(to, part->before);
    if (strcmp(part->name, "element") == 0 && f->element) {
        append(to, element_symbol(f->element[i]));
    } else if (column && column->kind == CGT_TRAJECTORY_WORD && column->value) {
        const uint32_t word = (uint32_t)column->value[i];
        append(to, word && word <= column->words ? column->word[word - 1] : "");
    } else {
        cgt_expression_values(part->value, i, 1, &value);
        /* six digits have decimals below 10^5 */
        append(to, value != floor(value) && fabs(value) < 1e5 ? cgt_number(6, value).text
                                                              : cgt_number_shortest(value).text);
    }
}

static void add_label(const label_rules *rules, const cgt_trajectory_frame *f, uint32_t i, float radius,
                      label_list *labels)
{
    const float *const sphere = f->xyzr + 4 * (size_t)i;
    labels->matched++;
    if (labels->count == LABELS_MOST)
        return;
    particle_label *const l = &labels->list[labels->count++];
    memcpy(l->place, sphere, sizeof l->place);
    l->radius = radius;
    l->text[0] = '\0';
    for (uint32_t k = 0; k < rules->parts; k++)
        append_part(&rules->part[k], f, i, l->text);
    append(l->text, rules->is_id ? cgt_number(15, f->id ? f->id[i] : i).text : rules->after);
}

int cgt_label_rules_apply(const label_rules *rules, const particle_rules *drawn, const cgt_trajectory_frame *f,
                          label_list *labels)
{
    double which[BLOCK], show[BLOCK];
    float radius[BLOCK];
    if (!labels->list && !(labels->list = malloc(LABELS_MOST * sizeof *labels->list)))
        return -1;
    labels->count = 0;
    labels->matched = 0;
    for (uint32_t first = 0; first < f->count; first += BLOCK) {
        const uint32_t block = f->count - first < BLOCK ? f->count - first : BLOCK;
        cgt_expression_values(rules->which, first, block, which);
        if (drawn->show)
            cgt_expression_values(drawn->show, first, block, show);
        cgt_particle_radii(drawn, f, first, block, radius);
        for (uint32_t k = 0; k < block; k++)
            if (cgt_expression_holds(which[k]) && radius[k] >= 0.0f && (!drawn->show || cgt_expression_holds(show[k])))
                add_label(rules, f, first + k, radius[k], labels);
    }
    return 0;
}
