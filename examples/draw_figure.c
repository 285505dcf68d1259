/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A labelled picture of a simulation's own arrays: two thousand grains on a spiral, coloured by their heat. */
#include <math.h>
#include <stdio.h>

#include <cgt/figure.h>

enum { GRAINS = 2000, FRAMES = 40, WIDTH = 1280, HEIGHT = 720 };
static float place[GRAINS][3], heat[GRAINS];
static uint8_t rgb[HEIGHT][WIDTH][3];

/* Yours. */
static void simulate(uint64_t frame)
{
    for (int i = 0; i < GRAINS; i++) {
        const float angle = 2.4f * (float)i, away = 0.1f * sqrtf((float)i);
        heat[i] = sinf(away - 0.2f * (float)frame);
        place[i][0] = away * cosf(angle);
        place[i][1] = away * sinf(angle);
        place[i][2] = heat[i];
    }
}

int main(void)
{
    const cgt_figure_column columns[] = {{.name = "heat", .values = cgt_floats(heat, 0)}};
    const char *const options[][2] = {
        {"color", "heat"}, {"colorbar", "heat, K"}, {"title", "Grains"}, {"time", "step {step}"}, {"axes", NULL}};
    cgt_figure_data data = {.points = {GRAINS, cgt_floats(place[0], 0), columns, 1, 0.08f}};
    const cgt_image image = {.bytes = rgb[0][0]};
    cgt_context *context = NULL;
    cgt_figure *figure = NULL;
    char error[256] = "";
    cgt_result result = cgt_context_create(NULL, &context);
    if (!result)
        result = cgt_figure_create(context, &figure);
    for (int i = 0; i < 5 && !result; i++)
        result = cgt_figure_set(figure, options[i][0], options[i][1]);
    for (uint64_t k = 0; k < FRAMES && !result; k++) { /* the last frame stays in the arrays, and is drawn */
        data.number = k;
        data.step = (int64_t)k;
        simulate(k);
        result = cgt_figure_survey(figure, &data);
    }
    if (!result)
        result = cgt_figure_show(figure, &data);
    if (!result)
        result = cgt_figure_draw(figure, &image, NULL);
    if (!result)
        result = cgt_write_png("figure.png", &image, WIDTH, HEIGHT);
    if (result && figure)
        cgt_figure_get_error_message(figure, error, sizeof error);
    if (result)
        fprintf(stderr, "draw-figure: %s: %s\n", cgt_get_result_string(result), error);
    cgt_figure_release(figure);
    cgt_context_release(context);
    return result != CGT_OK;
}
