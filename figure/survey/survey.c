/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Surveys of a run; see survey.h. The primitives of large frames are shared among threads. Each has a survey of
 * its own, which `merge` adds at the end: the sum does not depend on who looked at what. */
#include "survey/survey.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "color/given_colors.h"
#include "options/numbers.h"

static int finite_point(const float p[3]) { return isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]); }

/* Extends the bounds by a box of half edge `reach` around a point that is finite. */
static inline void bound_point(float min[3], float max[3], const float p[3], float reach)
{
    for (int c = 0; c < 3; c++) { /* fminf and fmaxf would be calls */
        const float low = p[c] - reach, high = p[c] + reach;
        min[c] = low < min[c] ? low : min[c];
        max[c] = high > max[c] ? high : max[c];
    }
}

static void reach_point(survey *s, const camera_directions *fit, const float p[3], float radius)
{
    const double place[3] = {(double)p[0], (double)p[1], (double)p[2]};
    cgt_camera_reach_add(&s->reach, fit, place, (double)radius);
}

enum { BLOCK = 256 };

/* Tells which of the spheres [first, first + count), a block at most, are shown; returns `shown`, or NULL: all are. Of
 * what is left out neither camera nor colours know. */
static const uint8_t *find_shown(const frame_sequence *sequence, uint32_t first, uint32_t count, uint8_t *shown)
{
    const expression *const show = sequence->rules ? sequence->rules->show : NULL;
    double values[BLOCK];
    if (!show || sequence->frame.kind == CGT_TRAJECTORY_TRIANGLES)
        return NULL;
    cgt_expression_values(show, first, count, values);
    for (uint32_t i = 0; i < count; i++)
        shown[i] = (uint8_t)cgt_expression_holds(values[i]);
    return shown;
}

/* Whether a sphere within the bounds may reach farther than all before: each sum below is rounded as that of
 * cgt_camera_reach_add, of terms that are at least as large. */
static int may_reach_farther(const camera_reach *reach, const camera_directions *fit, const float min[3],
                             const float max[3], float radius)
{
    for (uint32_t k = 0; k < fit->count; k++) {
        const double x = fit->x[k] * (double)(fit->x[k] > 0.0 ? max[0] : min[0]);
        const double y = fit->y[k] * (double)(fit->y[k] > 0.0 ? max[1] : min[1]);
        const double z = fit->z[k] * (double)(fit->z[k] > 0.0 ? max[2] : min[2]);
        if (!(x + y + z + (double)radius <= reach->along[k]))
            return 1;
    }
    return 0;
}

/* A sphere's four numbers, side by side. */
typedef float floats __attribute__((vector_size(16)));
typedef int32_t ints __attribute__((vector_size(16)));

static inline floats select(floats a, floats b, ints mask) { return (floats)(((ints)a & ~mask) | ((ints)b & mask)); }

/* Bounds of spheres, in the first three lanes. */
typedef struct block_bounds {
    floats min, max;               /* of the spheres */
    floats center_min, center_max; /* of their centres */
    float largest;                 /* radius */
} block_bounds;

static block_bounds begin_bounds(const survey *s)
{
    const floats infinite = {INFINITY, INFINITY, INFINITY, INFINITY};
    block_bounds b = {.min = infinite, .max = -infinite, .center_min = infinite, .center_max = -infinite};
    memcpy(&b.min, s->bounds_min, sizeof s->bounds_min);
    memcpy(&b.max, s->bounds_max, sizeof s->bounds_max);
    return b;
}

/* As bound_point(), three coordinates at once. */
static inline void bound_sphere(block_bounds *b, const float *sphere, float radius)
{
    floats place;
    memcpy(&place, sphere, sizeof place);
    const floats low = place - radius, high = place + radius;
    b->min = select(b->min, low, low < b->min);
    b->max = select(b->max, high, high > b->max);
    b->center_min = select(b->center_min, place, place < b->center_min);
    b->center_max = select(b->center_max, place, place > b->center_max);
    b->largest = radius > b->largest ? radius : b->largest;
}

/* The spheres [first, first + count), a block at most. */
static void survey_block(survey *s, const frame_sequence *sequence, const camera_directions *fit, uint32_t first,
                         uint32_t count, const uint8_t *shown)
{
    static const particle_rules as_it_is = {.radius_scale = 1.0f};
    const cgt_trajectory_frame *const f = &sequence->frame;
    block_bounds bounds = begin_bounds(s);
    uint8_t is_drawable[BLOCK];
    float radius[BLOCK];
    cgt_particle_radii(sequence->rules ? sequence->rules : &as_it_is, f, first, count, radius);
    for (uint32_t k = 0; k < count; k++) { /* false for NaN, without branches */
        const float *const sphere = f->xyzr + 4 * (size_t)(first + k);
        is_drawable[k] = (fabsf(sphere[0]) <= FLT_MAX) & (fabsf(sphere[1]) <= FLT_MAX) & (fabsf(sphere[2]) <= FLT_MAX) &
                         (radius[k] >= 0.0f) & (radius[k] <= FLT_MAX) & (!shown || shown[k]);
    }
    for (uint32_t k = 0; k < count; k++) {
        const float *const sphere = f->xyzr + 4 * (size_t)(first + k);
        if (!is_drawable[k])
            continue;
        s->drawable++;
        bound_sphere(&bounds, sphere, radius[k]);
    }
    for (uint32_t k = 0; k < count; k++) {
        const float *const sphere = f->xyzr + 4 * (size_t)(first + k);
        if (!is_drawable[k])
            continue;
        bulk_add(&s->bulk, f->number, first + k, f->id ? f->id[first + k] : first + k, sphere, radius[k]);
    }
    memcpy(s->bounds_min, &bounds.min, sizeof s->bounds_min);
    memcpy(s->bounds_max, &bounds.max, sizeof s->bounds_max);
    float min[4], max[4];
    memcpy(min, &bounds.center_min, sizeof min);
    memcpy(max, &bounds.center_max, sizeof max);
    if (!may_reach_farther(&s->reach, fit, min, max, bounds.largest))
        return;
    for (uint32_t k = 0; k < count; k++)
        if (is_drawable[k])
            reach_point(s, fit, f->xyzr + 4 * (size_t)(first + k), radius[k]);
}

/* Vertices that no triangle uses are invisible and do not count. For the bulk a triangle is a cube around its
 * bounds. */
static void survey_triangle(survey *s, const cgt_trajectory_frame *frame, const camera_directions *fit, uint32_t i)
{
    const uint32_t *const index = frame->index + 3 * (size_t)i;
    const float *vertex[3];
    float centre[3], reach = 0.0f;
    for (int k = 0; k < 3; k++) {
        vertex[k] = frame->position + 3 * (size_t)index[k];
        if (!finite_point(vertex[k]))
            return;
    }
    s->drawable++;
    for (int k = 0; k < 3; k++) {
        bound_point(s->bounds_min, s->bounds_max, vertex[k], 0.0f);
        reach_point(s, fit, vertex[k], 0.0f);
    }
    for (int c = 0; c < 3; c++) {
        const float low = fminf(vertex[0][c], fminf(vertex[1][c], vertex[2][c]));
        const float high = fmaxf(vertex[0][c], fmaxf(vertex[1][c], vertex[2][c]));
        centre[c] = 0.5f * low + 0.5f * high;
        reach = fmaxf(reach, 0.5f * high - 0.5f * low);
    }
    bulk_add(&s->bulk, frame->number, i, i, centre, reach);
}

static void survey_time(survey_times *t, const cgt_trajectory_frame *frame, int is_first)
{
    t->number_max = frame->number > t->number_max ? frame->number : t->number_max;
    t->step_min = is_first || frame->step < t->step_min ? frame->step : t->step_min;
    t->step_max = is_first || frame->step > t->step_max ? frame->step : t->step_max;
    t->has_unknown |= isnan(frame->time);
    if (isnan(frame->time))
        return;
    const size_t letters = strlen(cgt_number_shortest(frame->time).text);
    t->letters = letters > t->letters ? letters : t->letters;
    t->time_min = fmin(t->time_min, frame->time);
    t->time_max = fmax(t->time_max, frame->time);
}

/* Types are those of all spheres, so that a filter does not choose other colours; numbers those that are shown. */
static void survey_names(survey *s, const cgt_trajectory_frame *frame, uint32_t first, uint32_t count,
                         const uint8_t *shown)
{
    const uint32_t *const id = frame->id ? frame->id + first : NULL;
    const uint32_t *const type = frame->type ? frame->type + first : NULL;
    uint32_t id_min = s->id_min, id_max = s->id_max, type_min = s->type_min, type_max = s->type_max;
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t number = id ? id[k] : first + k;
        s->hidden += shown && !shown[k];
        if (shown && !shown[k])
            continue;
        id_min = number < id_min ? number : id_min;
        id_max = number > id_max ? number : id_max;
    }
    for (uint32_t k = 0; k < count && type; k++) {
        type_min = type[k] < type_min ? type[k] : type_min;
        type_max = type[k] > type_max ? type[k] : type_max;
    }
    s->id_min = id_min;
    s->id_max = id_max;
    s->type_min = type_min;
    s->type_max = type_max;
}

/* The range of the first formula, which is that of the colours, over a block of the spheres or vertices. */
static void survey_values(survey *s, const frame_sequence *sequence, uint32_t first, uint32_t count,
                          const uint8_t *shown)
{
    double values[BLOCK];
    cgt_expression_values(sequence->formulas[0], first, count, values);
    for (uint32_t i = 0; i < count; i++) {
        if (shown && !shown[i])
            continue;
        if (!isfinite(values[i])) {
            s->unknown_values++;
            continue;
        }
        s->values++;
        cgt_bulk_values_add(&s->value_samples, sequence->frame.number, first + i, values[i]);
        s->value_min = fmin(s->value_min, values[i]);
        s->value_max = fmax(s->value_max, values[i]);
        if (values[i] > 0.0)
            s->value_least = fmin(s->value_least, values[i]);
    }
}

static void survey_kind(survey *s, const cgt_trajectory_frame *f, uint32_t i)
{
    if (f->type && f->type[i] < SURVEY_TYPES)
        s->has_types[f->type[i] / 8] |= (uint8_t)(1u << f->type[i] % 8);
    if (f->element)
        s->has_elements[f->element[i]] = 1;
}

/* The box, and how far its images move what is in it. */
static void survey_box(survey *s, const frame_sequence *sequence, const camera_directions *fit)
{
    const cgt_trajectory_frame *f = &sequence->frame;
    const int has_box = frame_has_box(f);
    for (int corner = 0; corner < 8 && has_box; corner++) {
        double at[3], moved[3] = {0.0, 0.0, 0.0};
        for (int c = 0; c < 3; c++) {
            at[c] = f->box_origin[c];
            for (int e = 0; e < 3; e++) {
                const double images = sequence->rules ? sequence->rules->images[e] : 1.0;
                at[c] += corner >> e & 1 ? images * f->box_edge[e][c] : 0.0;
                moved[c] += corner >> e & 1 ? (images - 1.0) * f->box_edge[e][c] : 0.0;
            }
            s->box_min[c] = fmin(s->box_min[c], at[c]);
            s->box_max[c] = fmax(s->box_max[c], at[c]);
            s->move_min[c] = fmin(s->move_min[c], moved[c]);
            s->move_max[c] = fmax(s->move_max[c], moved[c]);
        }
        cgt_camera_reach_add(&s->box_reach, fit, at, 0.0);
        cgt_camera_reach_add(&s->move_reach, fit, moved, 0.0);
    }
}

static void survey_speed(survey *s, float speed)
{
    uint32_t bits;
    if (!isfinite(speed))
        return;
    memcpy(&bits, &speed, sizeof bits);
    s->speed_bins[(bits & 0x7FFFFFFFu) >> 19]++;
    s->speed_max = fmaxf(s->speed_max, fabsf(speed));
    s->speeds++;
}

/* What the spheres or vertices [first, first + count), a block at most, have. */
static void survey_columns(survey *s, const frame_sequence *sequence, uint32_t first, uint32_t count,
                           const uint8_t *shown)
{
    const cgt_trajectory_frame *const frame = &sequence->frame;
    const int wants_kinds = sequence->wants_kinds && frame->kind == CGT_TRAJECTORY_SPHERES;
    for (uint32_t i = 0; frame->element && !s->has_element && i < count; i++)
        s->has_element = frame->element[first + i] != 0;
    for (uint32_t i = 0; (wants_kinds || sequence->speed) && i < count; i++) {
        if (shown && !shown[i])
            continue;
        if (wants_kinds)
            survey_kind(s, frame, first + i);
        if (sequence->speed)
            survey_speed(s, sequence->speed[first + i]);
    }
    if (sequence->formula_count)
        survey_values(s, sequence, first, count, shown);
}

/* Of a survey that is all zero: one takes 500 KB, of which threads without a piece touch little. */
static void begin_survey(survey *s)
{
    s->id_min = s->type_min = UINT32_MAX;
    s->value_min = s->value_least = INFINITY;
    s->value_max = -INFINITY;
    s->times.time_min = INFINITY;
    s->times.time_max = -INFINITY;
    for (int c = 0; c < 3; c++) {
        s->box_min[c] = INFINITY;
        s->box_max[c] = -INFINITY;
        s->bounds_min[c] = INFINITY;
        s->bounds_max[c] = -INFINITY;
    }
    cgt_camera_reach_clear(&s->reach);
    cgt_camera_reach_clear(&s->box_reach);
    cgt_camera_reach_clear(&s->move_reach);
}

/* Adds another thread's survey of the same frames. */
static void merge(survey *sum, const survey *part)
{
    sum->frames += part->frames;
    sum->total = part->total < sum->total ? part->total : sum->total;
    sum->is_cut |= part->is_cut;
    sum->kind = part->frames ? part->kind : sum->kind;
    sum->drawable += part->drawable;
    sum->hidden += part->hidden;
    sum->has_type |= part->has_type;
    sum->id_min = part->id_min < sum->id_min ? part->id_min : sum->id_min;
    sum->id_max = part->id_max > sum->id_max ? part->id_max : sum->id_max;
    sum->type_min = part->type_min < sum->type_min ? part->type_min : sum->type_min;
    sum->type_max = part->type_max > sum->type_max ? part->type_max : sum->type_max;
    for (int c = 0; c < 3; c++) {
        sum->bounds_min[c] = fminf(sum->bounds_min[c], part->bounds_min[c]);
        sum->bounds_max[c] = fmaxf(sum->bounds_max[c], part->bounds_max[c]);
    }
    for (int c = 0; c < 3; c++) {
        sum->box_min[c] = fmin(sum->box_min[c], part->box_min[c]);
        sum->box_max[c] = fmax(sum->box_max[c], part->box_max[c]);
        sum->boxless_steps[c] = fmaxf(sum->boxless_steps[c], part->boxless_steps[c]);
        sum->move_min[c] = fmin(sum->move_min[c], part->move_min[c]);
        sum->move_max[c] = fmax(sum->move_max[c], part->move_max[c]);
    }
    for (uint32_t k = 0; k < CAMERA_DIRECTIONS; k++) {
        sum->reach.along[k] = fmax(sum->reach.along[k], part->reach.along[k]);
        sum->box_reach.along[k] = fmax(sum->box_reach.along[k], part->box_reach.along[k]);
        sum->move_reach.along[k] = fmax(sum->move_reach.along[k], part->move_reach.along[k]);
    }
    cgt_bulk_merge(&sum->bulk, &part->bulk);
    sum->values += part->values;
    sum->unknown_values += part->unknown_values;
    cgt_bulk_values_merge(&sum->value_samples, &part->value_samples);
    sum->value_min = fmin(sum->value_min, part->value_min);
    sum->value_max = fmax(sum->value_max, part->value_max);
    sum->value_least = fmin(sum->value_least, part->value_least);
    sum->has_element |= part->has_element;
    for (size_t k = 0; k < sizeof sum->has_types; k++)
        sum->has_types[k] |= part->has_types[k];
    for (size_t k = 0; k < sizeof sum->has_elements; k++)
        sum->has_elements[k] |= part->has_elements[k];
    sum->speeds += part->speeds;
    sum->speed_max = fmaxf(sum->speed_max, part->speed_max);
    for (int bin = 0; bin < SURVEY_BINS; bin++)
        sum->speed_bins[bin] += part->speed_bins[bin];
}

/* ---- Threads ------------------------------------------------------------------------------------------------ */

enum { PIECE_LEAST = 1 << 16 }; /* primitives of a thread, which take 1 ms; waking one takes some 50 us */

/* The end of piece `index` of `count` things. */
static uint32_t piece_end(const survey_team *team, uint32_t count, uint32_t index)
{
    return (uint32_t)((uint64_t)count * (index + 1) / team->pieces);
}

static const camera_directions *fit_of(const survey_team *team)
{
    static const camera_directions nothing;
    return !team->fit ? &nothing : &team->fit[team->sequence->frame.kind == CGT_TRAJECTORY_TRIANGLES];
}

/* Looks at one piece of the frame's primitives, and of its speeds and values, which are one each sphere or vertex. */
static void survey_piece(void *user, uint32_t index)
{
    const survey_team *const team = user;
    const frame_sequence *const sequence = team->sequence;
    const cgt_trajectory_frame *const frame = &sequence->frame;
    survey *const s = index ? &team->others[index - 1] : team->first;
    const uint32_t primitives = frame_primitives(frame);
    const uint32_t begin = index ? piece_end(team, frame->count, index - 1) : 0;
    const uint32_t end = piece_end(team, frame->count, index);
    const uint32_t last = piece_end(team, primitives, index);
    const uint32_t first = index ? piece_end(team, primitives, index - 1) : 0;
    const camera_directions *const fit = fit_of(team);
    uint8_t mask[BLOCK];
    if (frame->kind == CGT_TRAJECTORY_TRIANGLES) {
        survey_names(s, frame, first, last - first, NULL);
        for (uint32_t i = first; i < last; i++)
            survey_triangle(s, frame, fit, i);
    }
    for (uint32_t i = begin; i < end; i += BLOCK) {
        const uint32_t count = end - i < BLOCK ? end - i : BLOCK;
        const uint8_t *const shown = find_shown(sequence, i, count, mask);
        survey_columns(s, sequence, i, count, shown);
        if (frame->kind == CGT_TRAJECTORY_TRIANGLES)
            continue;
        survey_names(s, frame, i, count, shown);
        survey_block(s, sequence, fit, i, count, shown);
    }
}

/* By one thread: words get their numbers in the order of the data. */
static void look_at_categories(const frame_sequence *s)
{
    cgt_categories_take(s->categories, s->formulas[0], &s->frame);
    if (s->categories->has_words || s->categories->takes_numbers)
        cgt_categories_look(s->categories, s->formulas[0], s->rules ? s->rules->show : NULL, s->frame.count);
}

void cgt_survey_look(survey_team *team)
{
    const cgt_trajectory_frame *const frame = &team->sequence->frame;
    const uint32_t most = frame_primitives(frame) / PIECE_LEAST + 1;
    survey_time(&team->first->times, frame, team->first->frames == 0);
    team->first->frames++;
    team->first->kind = frame->kind;
    team->first->has_type |= frame->type != NULL;
    team->first->has_rgb |= cgt_coloring_has_given(frame);
    survey_box(team->first, team->sequence, fit_of(team));
    float steps[3] = {0.0f, 0.0f, 0.0f};
    if (team->sequence->tracker)
        cgt_speed_boxless_steps(team->sequence->tracker, steps);
    for (int c = 0; c < 3; c++)
        team->first->boxless_steps[c] = fmaxf(team->first->boxless_steps[c], steps[c]);
    if (team->sequence->categories)
        look_at_categories(team->sequence);
    team->pieces = most < team->threads ? most : team->threads;
    cgt_context_run_tasks(team->context, survey_piece, team, team->pieces);
}

/* Where there is no memory for more threads there is one. */
void cgt_survey_begin(survey_team *team, const frame_sequence *sequence, const camera_directions *fit,
                      cgt_context *context, survey *result)
{
    const uint32_t known = cgt_context_get_threads(context), threads = known ? known : 1;
    *team = (survey_team){.sequence = sequence, .fit = fit, .first = result, .context = context, .threads = threads};
    memset(result, 0, sizeof *result);
    begin_survey(result);
    team->others = team->threads > 1 ? calloc(team->threads - 1, sizeof *team->others) : NULL;
    team->threads = team->others ? team->threads : 1;
    for (uint32_t i = 0; i + 1 < team->threads; i++) {
        begin_survey(&team->others[i]);
        team->others[i].total = UINT64_MAX; /* which is the first one's */
    }
}

void cgt_survey_end(survey_team *team)
{
    for (uint32_t i = 0; i + 1 < team->threads; i++)
        merge(team->first, &team->others[i]);
    free(team->others);
    cgt_bulk_sort(&team->first->bulk);
    cgt_bulk_values_sort(&team->first->value_samples);
}

/* ---- Ranges ------------------------------------------------------------------------------------------------ */

float cgt_survey_speed_quantile(const survey *s, double share)
{
    uint64_t below = 0;
    if (s->speeds <= 100 && share >= 0.99) /* as of values: few are taken whole */
        return s->speed_max;
    for (uint32_t bin = 0; bin < SURVEY_BINS; bin++) {
        below += s->speed_bins[bin];
        if (below == 0 || (double)below < share * (double)s->speeds)
            continue;
        const uint32_t bits = ((bin + 1) << 19) - 1; /* the largest float of the bin */
        float speed;
        memcpy(&speed, &bits, sizeof speed);
        return bin ? fminf(speed, s->speed_max) : 0.0f; /* bin 0: zero and the smallest denormals */
    }
    return 0.0f;
}

int cgt_survey_value_range(const survey *s, int logarithmic, double *min, double *max)
{
    const int scaled = logarithmic && isfinite(s->value_least);
    const int known = cgt_bulk_values_range(&s->value_samples, scaled ? 0.0 : -INFINITY, min, max);
    if (known && *min < *max)
        return 1;
    *min = scaled ? s->value_least : s->value_min;
    *max = s->value_max;
    return 0;
}
