/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Fuzz target: Chapman's program on damaged images. The input makes a scene, a camera and control blocks as the PPE
 * makes them, then a list of damages: words of any of the images, of the spheres and of the tables of rays. The
 * program, native, refuses, breaks a rule of DMA, or traces what is there; it touches no memory but its own and ends.
 * Undamaged it succeeds, and its ids are numbers of spheres. */
#include <stdlib.h>
#include <string.h>

#include "cell/ppe/assignment.h"
#include "cell/ppe/grid/grid_scene.h"
#include "cell/programs/grid/spe_grid.h"
#include "fuzz/fuzz.h"

#define MOST_EDGE 40u
#define MOST_SPHERES 60u
#define MOST_DAMAGES 16u
#define HALF CGT_DOUBTS_LINE

/* Main memory, as the PPE lays it out. */
typedef struct memory {
    uint32_t spes;
    cgt_control_block control[CGT_MAX_SPES];
    cgt_spe_report report[CGT_MAX_SPES];
    cgt_camera_tables tables;
    cgt_grid_scene scene;
    cgt_grid_image image;
    uint32_t *ids;
    size_t id_words;
    cgt_doubt ring[CGT_MAX_SPES][2][HALF];
    cgt_assigner assigner;
} memory;

/* A frame of few pixels, so that a run takes no time. Returns false where the PPE refuses it. */
static bool make_frame(fuzz_bytes *b, memory *m)
{
    const cgt_memory_hooks hooks = cgt_memory_default();
    char message[CGT_PPE_MESSAGE_BYTES];
    cgt_sphere sphere[MOST_SPHERES];
    cgt_camera camera;
    const uint32_t width = 1 + fuzz_below(b, MOST_EDGE), height = 1 + fuzz_below(b, MOST_EDGE),
                   count = fuzz_below(b, MOST_SPHERES + 1), resolution = 1 + fuzz_below(b, 16),
                   cells[3] = {resolution, 1 + fuzz_below(b, 16), 16};
    cgt_camera_init(&camera);
    for (int a = 0; a < 3; a++)
        camera.eye[a] = fuzz_float(b);
    camera.fov = 1 + (float)fuzz_below(b, 160);
    for (uint32_t i = 0; i < count; i++)
        sphere[i] = (cgt_sphere){fuzz_float(b), fuzz_float(b), fuzz_float(b), fuzz_float(b)};
    if (cgt_camera_tables_init(&m->tables, &hooks, &camera, width, height, message) != CGT_OK)
        return false;
    if (cgt_grid_scene_init(&m->scene, &hooks, sphere, count, cells, message) != CGT_OK) {
        cgt_camera_tables_release(&m->tables);
        return false;
    }
    m->image = m->scene.image;
    m->image.objects[1] = CGT_EA_OBJECTS;
    m->id_words = (size_t)(width + 31) / 32 * 32 * height;
    m->ids = fuzz_allocate(m->id_words * sizeof *m->ids);
    memset(m->ids, 0xff, m->id_words * sizeof *m->ids);
    return true;
}

static void make_control(fuzz_bytes *b, memory *m)
{
    static const uint8_t spes[8] = {2, 1, 2, 3, 2, 8, 2, 16};
    const uint32_t flags = fuzz_byte(b), width = m->tables.rays.width, height = m->tables.rays.height;
    m->spes = spes[flags >> 5];
    for (uint32_t i = 0; i < m->spes; i++)
        m->control[i] = (cgt_control_block){.magic = CGT_CONTROL_MAGIC,
                                            .spe = i,
                                            .spes = m->spes,
                                            .flags = (flags & 1 ? CGT_CONTROL_FLATTENED : 0) |
                                                     (1 + (flags >> 1) % 3) << CGT_CONTROL_CULL_SHIFT,
                                            .width = width,
                                            .height = height,
                                            .strip_columns = 1,
                                            .row_bytes = (width + 31) / 32 * 128,
                                            .half = HALF,
                                            .scene = {0, CGT_EA_SCENE},
                                            .camera = {0, CGT_EA_CAMERA},
                                            .columns = {0, CGT_EA_COLUMNS},
                                            .rows = {0, CGT_EA_ROWS},
                                            .ids = {0, CGT_EA_IDS},
                                            .doubts = {0, CGT_EA_DOUBTS + i * (uint32_t)sizeof m->ring[0]},
                                            .report = {0, CGT_EA_REPORT + i * (uint32_t)sizeof m->report[0]}};
    cgt_assign((cgt_assignment)(flags >> 3 & 3), CGT_HYBRID_SHARE, (height + CGT_STRIP_ROWS - 1) / CGT_STRIP_ROWS,
               m->spes, m->control, &m->assigner);
}

/* One word of one image: any bits, one bit, or a step up or down. */
static void damage(fuzz_bytes *b, memory *m)
{
    struct {
        void *at;
        size_t bytes;
    } const image[] = {{m->control, sizeof m->control},
                       {&m->image, 64}, /* what lies behind is reserved */
                       {&m->tables.image, 32},
                       {m->tables.column, m->tables.column_bytes},
                       {m->tables.row, m->tables.row_bytes},
                       {m->scene.object, m->scene.bytes}};
    const uint8_t how = fuzz_byte(b), which = how % 8 < 6 ? how % 8 : how % 8 - 6;
    const uint32_t at = fuzz_byte(b) | (uint32_t)fuzz_byte(b) << 8, how_much = fuzz_byte(b);
    if (!image[which].at || !image[which].bytes)
        return;
    char *const place = (char *)image[which].at + at % (image[which].bytes / 4) * 4;
    uint32_t word;
    memcpy(&word, place, sizeof word);
    switch (how >> 3 & 3) {
    case 0: word = fuzz_word(b); break;
    case 1: word ^= 1u << how_much % 32; break;
    case 2: word += how_much - 128; break;
    default: {
        const float value = fuzz_float(b);
        memcpy(&word, &value, sizeof word);
    }
    }
    memcpy(place, &word, sizeof word);
}

/* The PPE without its decisions: strips and halves of rings are handed out as the protocol says. */
static void act(void *user, cgt_cell *cell, const cgt_ppe_event *event)
{
    memory *const m = user;
    if (event->kind == CGT_PPE_START)
        for (unsigned i = 0; i < m->spes; i++)
            cgt_assigner_send(&m->assigner, cell, i);
    else if (event->kind == CGT_PPE_MAILBOX)
        cgt_assigner_send(&m->assigner, cell, event->spe);
    else if (event->kind == CGT_PPE_INTERRUPT)
        cgt_cell_send_signal(cell, event->spe, 1, 1u << (event->value >> 16 & 1));
}

static void add(cgt_cell *cell, uint64_t ea, void *at, size_t bytes, bool writable)
{
    if (bytes)
        FUZZ_CHECK(cgt_cell_add_memory(cell, ea, at, bytes / 4, 4, writable) == CGT_OK, "no region");
}

static void check(const memory *m, const cgt_cell *cell, cgt_result result, bool damaged)
{
    FUZZ_CHECK(result == CGT_OK || (damaged && result == CGT_ERROR_STOPPED), "%d: %s", (int)result,
               cgt_cell_get_message(cell));
    FUZZ_CHECK((result == CGT_OK) == !*cgt_cell_get_message(cell), "a message without an error, or none with one");
    for (uint32_t i = 0; i < m->spes && !damaged; i++)
        FUZZ_CHECK(m->report[i].state == CGT_REPORT_DONE || m->report[i].state == CGT_REPORT_OVERFLOW, "state %u",
                   (unsigned)m->report[i].state);
    for (size_t k = 0; k < m->id_words && !damaged; k++)
        FUZZ_CHECK(m->ids[k] == CGT_INVALID_ID || m->ids[k] < m->image.spheres, "id %u", (unsigned)m->ids[k]);
}

static void run(memory *m, bool damaged)
{
    cgt_cell *cell;
    cgt_spe_program program[CGT_MAX_SPES];
    FUZZ_CHECK(cgt_cell_create(&(cgt_cell_options){.spes = m->spes}, &cell) == CGT_OK, "no cell");
    add(cell, CGT_EA_CONTROL, m->control, sizeof m->control, false);
    add(cell, CGT_EA_REPORT, m->report, sizeof m->report, true);
    add(cell, CGT_EA_CAMERA, &m->tables.image, sizeof m->tables.image, false);
    add(cell, CGT_EA_SCENE, &m->image, sizeof m->image, false);
    add(cell, CGT_EA_COLUMNS, m->tables.column, m->tables.column_bytes, false);
    add(cell, CGT_EA_ROWS, m->tables.row, m->tables.row_bytes, false);
    add(cell, CGT_EA_DOUBTS, m->ring, sizeof m->ring, true);
    add(cell, CGT_EA_OBJECTS, m->scene.object, m->scene.bytes, false);
    add(cell, CGT_EA_IDS, m->ids, m->id_words * sizeof *m->ids, true);
    for (unsigned i = 0; i < m->spes; i++) {
        program[i] = (cgt_spe_program){.function = spe_grid, .argument = CGT_EA_CONTROL + i * sizeof m->control[0]};
        cgt_cell_set_signal_or(cell, i, 1, true);
    }
    check(m, cell, cgt_cell_run_native(cell, program, act, m), damaged);
    cgt_cell_destroy(cell);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static memory m; /* of one input at a time */
    fuzz_bytes b = fuzz_bytes_of(data, size);
    memset(&m, 0, sizeof m);
    if (!make_frame(&b, &m))
        return 0;
    make_control(&b, &m);
    uint32_t damages = 0;
    for (; b.left && damages < MOST_DAMAGES; damages++)
        damage(&b, &m);
    run(&m, damages > 0);
    free(m.ids);
    cgt_grid_scene_release(&m.scene);
    cgt_camera_tables_release(&m.tables);
    return 0;
}
