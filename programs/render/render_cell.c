/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames by a Cell; see render_setup.h. */
#define _POSIX_C_SOURCE 200809L

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cell/ppe/grid/grid_picture.h"
#include "cell/programs/grid/spe_grid.h"
#include "picture_tiles.h"
#include "render/render_setup.h"
#include "system/system.h"

#define DEFAULT_SPES 6
#define MOST_PROGRAM_BYTES ((size_t)16 << 20)
#define BYTES_OF_PATH 4096

/* Sums over the frames and their SPEs. */
typedef struct cell_sums {
    uint64_t frames, cycles, slowest, idle;
    cgt_spe_waits waits;
    uint64_t gets, puts, bytes_in, bytes_out, messages, strips;
    uint64_t doubts, exact, changed;
} cell_sums;

struct render_cell {
    render_cell_options options;
    unsigned char *program; /* SIM, REAL: an ELF file */
    size_t program_bytes;
    cell_sums sums;
    cgt_cell_frame_result result; /* of the frame at hand */
};

/* ---- the program ---- */

/* The path of a file that is given relative to this program. False where that is not known, or there is no file. */
static int find_beside(const char *relative, char path[BYTES_OF_PATH])
{
    if (system_own_path(path, BYTES_OF_PATH))
        return 0;
    size_t folder = strlen(path);
    while (folder > 0 && !system_is_separator(path[folder - 1]))
        folder--;
    const size_t room = BYTES_OF_PATH - folder;
    return (size_t)snprintf(path + folder, room, "%s", relative) < room && access(path, R_OK) == 0;
}

static int read_program(render_cell *cell, const char *path)
{
    FILE *const file = fopen(path, "rb");
    cell->program = file ? malloc(MOST_PROGRAM_BYTES + 1) : NULL;
    if (!cell->program) {
        program_error("%s: %s", path, file ? "out of memory" : strerror(errno));
        if (file)
            fclose(file);
        return -1;
    }
    cell->program_bytes = fread(cell->program, 1, MOST_PROGRAM_BYTES + 1, file);
    const int failed = ferror(file);
    fclose(file);
    if (!failed && cell->program_bytes <= MOST_PROGRAM_BYTES)
        return 0;
    program_error("%s: %s", path, failed ? "cannot be read" : "too large for a program of an SPU");
    return -1;
}

/* The one given; else, from where this program lies, the installed one or that of a build. */
static int find_program(render_cell *cell)
{
    char path[BYTES_OF_PATH];
    if (cell->options.program)
        return read_program(cell, cell->options.program);
    if (find_beside(RENDER_CELL_PROGRAM, path) || find_beside("../spu/spe_grid.elf", path))
        return read_program(cell, path);
    program_error("--cell sim: the SPEs' program, spe_grid.elf, is not installed beside this program; name it with "
                  "--cell-program, or take --cell native. It takes an SPU's compiler: scripts/test.sh spu builds both");
    return -1;
}

/* ---- set-up ---- */

int render_cell_create(renderer *r)
{
    if (r->options.stats) {
        program_error("--stats counts what the library does, and with --cell it does not trace");
        return -1;
    }
    if (cgt_figure_get_settings(r->figure).shading != CGT_SHADING_PLAIN || r->figure->parts.selects) {
        program_error(
            "--cell casts the camera's rays at the file's spheres: it takes --style plain, and neither lights and "
            "figures nor choices of particles");
        return -1;
    }
    render_cell *const cell = calloc(1, sizeof *cell);
    if (!cell) {
        program_error("out of memory for a Cell");
        return -1;
    }
    r->cell = cell;
    cell->options = r->options.cell;
    if (cell->options.spes == 0)
        cell->options.spes = DEFAULT_SPES;
    return cell->options.mode == RENDER_CELL_NATIVE ? 0 : find_program(cell);
}

void render_cell_release(render_cell *cell)
{
    if (!cell)
        return;
    free(cell->program);
    free(cell);
}

/* ---- a frame ---- */

static cgt_grid_frame_options options_of(const render_cell *cell)
{
    cgt_cell_frame_options o = {.spes = cell->options.spes, .assignment = (cgt_assignment)cell->options.assignment};
    if (cell->options.mode != RENDER_CELL_NATIVE) {
        o.real = cell->options.mode == RENDER_CELL_REAL;
        o.elf = cell->program;
        o.elf_bytes = cell->program_bytes;
    } else {
        o.function = spe_grid;
    }
    return (cgt_grid_frame_options){.cell = o};
}

static void add_result(cell_sums *s, const cgt_cell_frame_result *r, unsigned spes)
{
    s->frames++;
    s->slowest += r->cycles;
    s->doubts += r->doubts;
    s->exact += r->exact;
    s->changed += r->changed;
    for (unsigned i = 0; i < spes; i++) {
        const cgt_cell_frame_spe *const spe = &r->spe[i];
        s->cycles += spe->cycles;
        s->idle += spe->idle;
        s->waits.dma += spe->waited.dma;
        s->waits.queue += spe->waited.queue;
        s->waits.mailbox += spe->waited.mailbox;
        s->waits.signal += spe->waited.signal;
        s->gets += spe->counts.gets;
        s->puts += spe->counts.puts;
        s->bytes_in += spe->counts.bytes_in;
        s->bytes_out += spe->counts.bytes_out;
        s->messages += spe->messages;
        s->strips += spe->report.grid.strips;
    }
}

/* What takes no part, as a commit counts it. */
static void count_skipped(const cgt_trajectory_frame *frame, frame_record *record)
{
    for (uint32_t i = 0; i < frame->count; i++) {
        const float *const q = frame->xyzr + 4 * (size_t)i;
        if (!isfinite(q[0]) || !isfinite(q[1]) || !isfinite(q[2]) || !isfinite(q[3]))
            record->skipped_not_finite++;
        else if (q[3] < 0.0f)
            record->skipped_radius++;
    }
}

int render_cell_frame(renderer *r, frame_record *record)
{
    const cgt_trajectory_frame *const frame = r->figure->frame;
    render_cell *const cell = r->cell;
    if (frame->kind == CGT_TRAJECTORY_TRIANGLES) {
        program_error("%s: --cell traces spheres, and this is a file of triangles", r->options.input);
        return -1;
    }
    cgt_look looks[FIGURE_LOOKS];
    const uint32_t count = cgt_figure_begin_picture(r->figure, looks);
    cgt_result result =
        cgt_picture_begin_tiles(r->figure->drawing, NULL, &r->figure->camera, looks, count, &r->figure->image, NULL);
    if (result)
        return render_result(r, cgt_figure_fail_picture(r->figure, result));
    const cgt_grid_picture picture = {.sphere = frame->xyzr,
                                      .count = frame->count,
                                      .camera = r->figure->camera,
                                      .width = r->figure->options.width * r->figure->options.samples,
                                      .height = r->figure->options.height * r->figure->options.samples,
                                      .options = options_of(cell),
                                      .visitor = cgt_picture_visit_tile,
                                      .user = r->figure->drawing};
    const double begin = program_seconds();
    result = cgt_grid_picture_trace(&picture, &cell->result);
    record->trace_ms = (program_seconds() - begin) * 1e3;
    record->hits = cgt_picture_get_hits(r->figure->drawing);
    record->primitives = frame->count;
    count_skipped(frame, record);
    if (result == CGT_ERROR_STOPPED && *r->stop)
        return 1;
    if (result) {
        program_error("%s: frame %" PRIu64 ": the Cell cannot trace it: %s", r->options.input, frame->number,
                      *cell->result.message ? cell->result.message : cgt_get_result_string(result));
        return -1;
    }
    cgt_figure_draw_overlay(r->figure);
    render_result(r, 0);
    add_result(&cell->sums, &cell->result, cell->options.spes);
    return 0;
}

/* ---- the report ---- */

static double percent(uint64_t part, uint64_t whole) { return whole ? 100.0 * (double)part / (double)whole : 0.0; }

void render_cell_print(const render_cell *cell, FILE *to)
{
    if (!cell || !cell->sums.frames)
        return;
    const cell_sums *const s = &cell->sums;
    static const char *const modes[] = {"", "native", "simulated", "real"};
    static const char *const assignments[] = {"interleaved", "static", "dynamic", "hybrid"};
    const int sim = cell->options.mode == RENDER_CELL_SIM;
    const double frames = (double)s->frames;
    fprintf(to, "Cell              %" PRIu32 " SPE%s, %s, strips %s, %.1f messages a frame\n", cell->options.spes,
            cell->options.spes == 1 ? "" : "s", modes[cell->options.mode], assignments[cell->options.assignment],
            (double)s->messages / frames);
    fprintf(to, "  DMA a frame     %.0f gets of %.3f MB, %.0f puts of %.3f MB\n", (double)s->gets / frames,
            (double)s->bytes_in / frames * 1e-6, (double)s->puts / frames, (double)s->bytes_out / frames * 1e-6);
    fprintf(to, "  doubts a frame  %.1f to the PPE, %.1f of them decided in whole numbers; %.1f pixels changed\n",
            (double)s->doubts / frames, (double)s->exact / frames, (double)s->changed / frames);
    if (!sim) {
        fprintf(to, "  cycles          none: they are the simulator's\n");
        return;
    }
    /* idle: SPEs that have ended wait for the slowest */
    fprintf(to, "  cycles a frame  %.2f million, %.1f frames per second at 3.2 GHz; SPEs idle %.2f %%\n",
            (double)s->slowest / frames * 1e-6, 3.2e9 * frames / (double)s->slowest,
            percent(s->idle, s->cycles + s->idle));
    fprintf(to,
            "  waits of SPEs   for DMA %.3f %%, its queue %.3f %%, mailboxes %.3f %%, the PPE to read doubts %.3f %%\n",
            percent(s->waits.dma, s->cycles), percent(s->waits.queue, s->cycles), percent(s->waits.mailbox, s->cycles),
            percent(s->waits.signal, s->cycles));
}
