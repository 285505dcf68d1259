/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What is this? What the page tells of particles, triangles and bonds that were picked, what is measured between them,
 * and which particles a formula selects. */
#define _POSIX_C_SOURCE 200809L
#include <emscripten.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "data/measure.h"
#include "figure_state.h"
#include "options/numbers.h"
#include "view/view_ask.h"
#include "view/view_camera.h"
#include "web/web_state.h"
#include "web/web_text.h"

/* ---- What a pixel shows ------------------------------------------------------------------------------------- */

/* Finds it. Returns 0 where it shows nothing of the data. */
static int pick(uint32_t x, uint32_t y, cgt_figure_hit *hit)
{
    return web.shown && !cgt_figure_set_camera(web.figure, &web.camera) && !cgt_figure_pick(web.figure, x, y, hit) &&
           hit->is_hit;
}

/* A sentence of it in web_message, "" where there is nothing. Returns the primitive's number, or -1. */
EMSCRIPTEN_KEEPALIVE int web_pick(uint32_t x, uint32_t y)
{
    const int most = 3; /* lines without columns */
    cgt_figure_hit hit;
    char text[1024];
    web.message[0] = '\0';
    if (!pick(x, y, &hit) || !hit.is_data)
        return -1;
    cgt_figure_describe(web.figure, hit.element, text, sizeof text);
    size_t used = 0;
    const char *c = text;
    for (int line = 0; line < most && *c; line += *c++ == '\n')
        if (*c == '\n' && c[1] && line + 1 < most)
            used += (size_t)snprintf(web.message + used, sizeof web.message - used, ", ");
        else if (*c != '\n' && !(*c == ' ' && c[1] == ' '))
            web.message[used++] = *c;
    web.message[used] = '\0';
    return (int)hit.element;
}

/* All that the figure knows of a primitive of the shown frame, in lines, to be freed; NULL: no memory. */
static char *describe(uint32_t element)
{
    const size_t length = web.shown ? cgt_figure_describe(web.figure, element, NULL, 0) : 0;
    char *const text = malloc(length + 1);
    if (text)
        *text = '\0';
    if (text && length)
        cgt_figure_describe(web.figure, element, text, length + 1);
    return text;
}

EMSCRIPTEN_KEEPALIVE const char *web_describe(uint32_t element)
{
    free(web.told);
    return web.told = describe(element);
}

/* ---- What was picked ---------------------------------------------------------------------------------------- */

/* A sphere, which is followed through the frames by its id where there are ids; or a place on a triangle. */
typedef struct picked {
    uint32_t element, id;
    double share[2]; /* of a triangle's second and third corner */
    int is_there;    /* in the shown frame */
} picked;

static struct {
    picked list[MEASURE_MOST];
    uint32_t count;
    int has_bond; /* the two are the ends of one */
} asked;

static const cgt_trajectory_frame *shown_frame(void) { return cgt_figure_frame_get_data(web.shown); }

/* Where a pick is in the shown frame. */
static void place_of(const picked *p, float place[3])
{
    const cgt_trajectory_frame *const f = shown_frame();
    if (f->kind == CGT_TRAJECTORY_SPHERES) {
        memcpy(place, f->xyzr + 4 * (size_t)p->element, 3 * sizeof *place);
        return;
    }
    view_ask_place(f, p->element, p->share, place);
}

static void add_pick(uint32_t element, const float place[3])
{
    const cgt_trajectory_frame *const f = shown_frame();
    picked p = {.element = element, .id = f->id ? f->id[element] : element, .is_there = 1};
    if (f->kind == CGT_TRAJECTORY_TRIANGLES)
        view_ask_shares(f, element, place, p.share);
    asked.list[asked.count++] = p;
}

/* Whether a sphere was picked before, which is then picked no more. Places on a triangle are never the same. */
static int take_back(uint32_t element)
{
    for (uint32_t i = 0; i < asked.count && shown_frame()->kind == CGT_TRAJECTORY_SPHERES; i++)
        if (asked.list[i].is_there && asked.list[i].element == element) {
            memmove(asked.list + i, asked.list + i + 1, (--asked.count - i) * sizeof asked.list[0]);
            return 1;
        }
    return 0;
}

EMSCRIPTEN_KEEPALIVE void web_forget_picks(void) { asked.count = 0; }

/* Adds what a pixel shows to what was picked: the fifth begins anew, what was picked is taken back, a bond is its two
 * ends alone, and where there is nothing all is forgotten. */
EMSCRIPTEN_KEEPALIVE void web_ask(uint32_t x, uint32_t y)
{
    cgt_figure_hit hit;
    uint32_t ends[2];
    const int is_hit = pick(x, y, &hit), had_bond = asked.has_bond;
    asked.has_bond = 0;
    if (is_hit && hit.is_data) {
        if (take_back(hit.element))
            return;
        if (asked.count == MEASURE_MOST)
            asked.count = 0;
        add_pick(hit.element, hit.place);
    } else if (is_hit && shown_frame()->kind == CGT_TRAJECTORY_SPHERES && view_ask_bond(web.figure, &hit, ends)) {
        asked.count = 0;
        add_pick(ends[0], hit.place);
        add_pick(ends[1], hit.place);
        asked.has_bond = 1;
    } else if (!is_hit) {
        asked.count = 0;
    } else { /* a box, a floor: nothing that is known */
        asked.has_bond = had_bond;
    }
}

/* Finds what was picked in a frame that is shown from now on. Numbers of triangles are the same in all frames. */
static void find_picks(void)
{
    const cgt_trajectory_frame *const f = shown_frame();
    for (uint32_t i = 0; i < asked.count; i++) {
        picked *const p = &asked.list[i];
        if (f->kind == CGT_TRAJECTORY_TRIANGLES) {
            p->is_there = p->element < f->triangles;
            continue;
        }
        p->is_there = p->element < f->count && (!f->id || f->id[p->element] == p->id);
        for (uint32_t k = 0; f->id && !p->is_there && k < f->count; k++)
            if (f->id[k] == p->id) {
                p->element = k;
                p->is_there = 1;
            }
    }
}

/* ---- Telling ------------------------------------------------------------------------------------------------ */

/* What is measured between some of the picks, from the first on: a member of JSON. */
static void print_measure(FILE *to, uint32_t first, uint32_t count)
{
    static const char *const names[] = {"distance", "angle", "dihedral"};
    static const char *const none[] = {"not known", "none: two of them coincide", "none: three of them lie on a line"};
    const periodic_box box = cgt_periodic_box_of(shown_frame());
    float place[MEASURE_MOST][3];
    double value;
    for (uint32_t i = 0; i < count; i++)
        place_of(&asked.list[first + i], place[i]);
    const int is_known = cgt_measure(&box, (const float(*)[3])place, count, &value);
    fprintf(to, "{\"first\":%u,\"count\":%u", (unsigned)first + 1, (unsigned)count);
    web_print_text(to, "name", names[count - 2]);
    web_print_text(to, "value", is_known ? cgt_number(7, value).text : none[count - 2]);
    fprintf(to, ",\"known\":%s}", is_known ? "true" : "false");
}

/* The formula that selects what was picked. */
static void print_formula(char *text, size_t size)
{
    const cgt_trajectory_frame *const f = shown_frame();
    size_t used = 0;
    *text = '\0';
    for (uint32_t i = 0; i < asked.count && f->kind == CGT_TRAJECTORY_SPHERES && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s%s == %u", i ? " or " : "", f->id ? "id" : "index",
                                 (unsigned)(f->id ? asked.list[i].id : asked.list[i].element));
}

/* What was picked, and what is measured, as an object of JSON; NULL: no memory. */
EMSCRIPTEN_KEEPALIVE const char *web_asked(void)
{
    char formula[128] = "";
    size_t size;
    free(web.told);
    web.told = NULL;
    if (!web.shown)
        asked.count = 0;
    FILE *const to = open_memstream(&web.told, &size);
    if (!to)
        return NULL;
    int are_there = 1;
    fputs("{\"picks\":[", to);
    for (uint32_t i = 0; i < asked.count; i++) {
        const picked *const p = &asked.list[i];
        char *const lines = p->is_there ? describe(p->element) : NULL;
        char gone[64];
        snprintf(gone, sizeof gone, "id %u is not in this frame\n", (unsigned)p->id);
        fprintf(to, "%s{\"element\":%u", i ? "," : "", (unsigned)p->element);
        web_print_text(to, "lines", p->is_there ? lines : gone);
        fputc('}', to);
        are_there = are_there && p->is_there;
        free(lines);
    }
    fputs("],\"measures\":[", to);
    const uint32_t count = are_there ? asked.count : 0;
    int more = 0;
    for (uint32_t of = 2; of <= count; of++)
        for (uint32_t first = 0; first + of <= count; first++, more = 1) {
            fputs(more ? "," : "", to);
            print_measure(to, first, of);
        }
    if (web.shown)
        print_formula(formula, sizeof formula);
    fprintf(to, "],\"bond\":%s", asked.has_bond && asked.count == 2 ? "true" : "false");
    web_print_text(to, "formula", formula);
    fputc('}', to);
    return fclose(to) ? NULL : web.told;
}

/* Where what was picked is seen: two shares of the picture each, negative where it is not. Returns how many. */
EMSCRIPTEN_KEEPALIVE uint32_t web_marks(float *at)
{
    for (uint32_t i = 0; i < asked.count; i++) {
        float place[3];
        at[2 * i] = at[2 * i + 1] = -1.0f;
        if (!web.shown || !asked.list[i].is_there)
            continue;
        place_of(&asked.list[i], place);
        if (!view_camera_project(&web.camera, web.figure->options.picture.ortho, (float)web.width / (float)web.height,
                                 place, at + 2 * i))
            at[2 * i] = at[2 * i + 1] = -1.0f;
    }
    return asked.count;
}

/* ---- Selections --------------------------------------------------------------------------------------------- */

/* What a formula selects of the shown frame: returns how many, or -1. center: gets the mean of their places. */
static int64_t sum_selected(const char *formula, double center[3])
{
    return web.shown ? view_ask_select(web.shown, formula, center, web.message, sizeof web.message)
                     : web_fail("no file is open");
}

/* How many spheres of the shown frame a formula selects, or -1. */
EMSCRIPTEN_KEEPALIVE int web_select(const char *formula)
{
    double center[3];
    return (int)sum_selected(formula, center);
}

static struct {
    char *formula; /* NULL: nothing is followed */
    double center[3];
} followed;

/* Has the camera go with the middle of what a formula selects, from frame to frame; "": with nothing. Returns how many
 * it selects, or -1. */
EMSCRIPTEN_KEEPALIVE int web_follow(const char *formula)
{
    double center[3] = {0.0};
    const int64_t count = *formula ? sum_selected(formula, center) : 0;
    char *const copy = count > 0 ? strdup(formula) : NULL;
    if (count < 0)
        return -1;
    if (count > 0 && !copy)
        return web_fail("out of memory");
    if (*formula && !count)
        return web_fail("the formula selects nothing that could be followed");
    free(followed.formula);
    followed.formula = copy;
    memcpy(followed.center, center, sizeof center);
    return (int)count;
}

/* Moves the camera by what the middle has moved, through a boundary where that is nearer. */
static void follow(void)
{
    double center[3], step[3];
    if (!followed.formula || sum_selected(followed.formula, center) <= 0)
        return;
    const periodic_box box = cgt_periodic_box_of(shown_frame());
    for (int c = 0; c < 3; c++)
        step[c] = center[c] - followed.center[c];
    cgt_nearest_image(&box, step);
    for (int c = 0; c < 3; c++) {
        web.camera.eye[c] += (float)step[c];
        web.camera.target[c] += (float)step[c];
    }
    memcpy(followed.center, center, sizeof center);
}

void web_take_frame(void)
{
    find_picks();
    follow();
}

void web_forget_run(void)
{
    asked.count = 0;
    free(followed.formula);
    followed.formula = NULL;
}
