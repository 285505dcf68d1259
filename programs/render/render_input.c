/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What is opened by options; see render_input.h. */
#include "render/render_input.h"

#include "common/program.h"
#include "data/expression/expression.h"
#include "trajectory/trajectory_status.h"

static void on_log(void *user, cgt_log_level level, const char *message)
{
    static const char *const names[] = {"error", "warning", "info"};
    (void)user;
    program_error("%s: %s", level <= CGT_LOG_LEVEL_INFO ? names[level] : "log", message);
}

int render_create_context(const render_options *o, cgt_context **context)
{
    cgt_context_options options;
    cgt_context_options_init(&options);
    options.threads = o->threads;
    options.variant = o->variant;
    if (o->verbose)
        options.log.write = on_log;
    const cgt_result result = cgt_context_create(&options, context);
    if (result) {
        char reason[256];
        cgt_context_get_error_message(*context, reason, sizeof reason);
        program_error("cannot start the library: %s: %s", cgt_get_result_string(result), reason);
    }
    return result ? -1 : 0;
}

/* What is no atom is left out unless the formula of --show names it. */
static int shows_sites(const figure_options *o)
{
    char error[256];
    expression *const show = *o->particles.show ? cgt_expression_parse(o->particles.show, error, sizeof error) : NULL;
    const int uses = show && cgt_expression_uses(show, "site");
    cgt_expression_free(show);
    return uses;
}

void render_choose_reading(render_options *o, const cgt_context *context, int reads_twice, const stop_flag *stop)
{
    const figure_options *const f = &o->figure;
    cgt_trajectory_sort_series(o->inputs, o->input_count);
    o->input = o->inputs[0];
    o->reading.keep = reads_twice;
    o->reading.all_bonds = cgt_figure_options_need_bonds(f);
    o->reading.leave_out_sites = !shows_sites(f);
    o->reading.stop = stop_flag_is_set;
    o->reading.stop_user = stop;
    o->reading.threads = cgt_context_get_threads(context);
}

int render_read_mesh(const render_options *o, const double origin[3], cgt_trajectory **file, cgt_trajectory_frame *mesh)
{
    char error[PROGRAM_ERROR_SIZE];
    const cgt_result opened = cgt_trajectory_open(o->mesh, NULL, file);
    int state = trajectory_failed(*file, opened, error, sizeof error) ? -1 : 1;
    if (state == 1) {
        cgt_trajectory_set_origin(*file, origin);
        state = trajectory_status(*file, cgt_trajectory_read(*file, mesh), error, sizeof error);
    }
    if (state < 0)
        program_error("%s", error);
    else if (state == 0 || mesh->kind != CGT_TRAJECTORY_TRIANGLES)
        program_error("--mesh: %s has no triangles", o->mesh);
    return state == 1 && mesh->kind == CGT_TRAJECTORY_TRIANGLES ? 0 : -1;
}

int render_check_reading(const render_options *o, cgt_trajectory_kind kind)
{
    const int triangles = kind == CGT_TRAJECTORY_TRIANGLES;
    const char *const wrong = triangles && (o->reading.radius > 0.0f || o->reading.wrapped)
                                  ? "--radius and --wrapped are for spheres, and this is a file of triangles"
                              : !triangles && (o->reading.fps > 0.0 || o->reading.clip)
                                  ? "--fps and --clip are for meshes, and this is a file of spheres"
                                  : NULL;
    if (wrong)
        program_error("%s: %s", o->input, wrong);
    return wrong ? -1 : 0;
}
