/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames by real SPEs, as far as a machine without any can tell: behind the two system calls of spufs stands a folder
 * of pipes and files for each SPE, and the program compiled for the host, whose DMA goes to the process' own addresses
 * as that of an SPE does. Contexts, the program in mem, registers, mapped memory, strips, doubts and the copy back are
 * those of a real run. Then every way to fail, by its sentence. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cell/machine/spufs.h"
#include "support/suite.h"
#include "cell/ppe/cell_frames.h"
#include "cell/programs/grid/spe_grid.h"
#include "spu_channels.h"
#include "support/test.h"

#define WIDTH 61u
#define HEIGHT 37u
#define SPHERES 200u

/* lnop, stop 0x2000: what mem must get; the host's program runs in its place. */
static const unsigned char elf[] = {0x7f, 'E', 'L',  'F',  1, 2,    1, 0, 0, 0,    0, 0, 0,    0, 0,    0, 0, 2, 0,
                                    0x17, 0,   0,    0,    1, 0,    0, 0, 0, 0,    0, 0, 0x34, 0, 0,    0, 0, 0, 0,
                                    0,    0,   0,    0x34, 0, 0x20, 0, 1, 0, 0x28, 0, 0, 0,    0, 0,    0, 0, 1, 0,
                                    0,    0,   0x54, 0,    0, 0,    0, 0, 0, 0,    0, 0, 0,    0, 8,    0, 0, 0, 8,
                                    0,    0,   0,    5,    0, 0,    0, 4, 0, 0x20, 0, 0, 0,    0, 0x20, 0};

/* ---- a machine behind the calls ---- */

enum { MBOX, IBOX, WBOX, SIGNAL1, SIGNAL2, PIPES };
static const char *const pipes[PIPES] = {"mbox", "ibox", "wbox", "signal1", "signal2"};
static const char *const files[] = {"mem", "regs", "signal1_type", "signal2_type"};

typedef struct fake_spe {
    uint8_t *arena; /* first: spe_program.h reads it here */
    char path[64];
    int folder, pipe[PIPES];
    uint32_t tags;
    bool made;
} fake_spe;

static fake_spe fake[CGT_MAX_SPES];
static struct {
    const char *missing; /* a file that contexts do not have */
    int status;          /* what run returns at once; 0: it runs the program */
    uint32_t event;
    int error; /* errno of create, or of run where status is -1 */
    unsigned interruptions;
} wanted;

static void path_of(const fake_spe *f, const char *name, char path[128])
{
    snprintf(path, 128, "%s/%s", f->path, name);
}

static int fake_create(void *user, unsigned spe)
{
    (void)user;
    fake_spe *const f = &fake[spe];
    char path[128];
    if (wanted.error && !wanted.status) {
        errno = wanted.error;
        return -1;
    }
    snprintf(f->path, sizeof f->path, "cgt-spufs-XXXXXX");
    assert_non_null(mkdtemp(f->path));
    f->made = true;
    for (int k = 0; k < PIPES; k++) {
        path_of(f, pipes[k], path);
        assert_int_equal(mkfifo(path, 0600), 0);
        f->pipe[k] = open(path, O_RDWR | O_CLOEXEC);
        assert_true(f->pipe[k] >= 0);
    }
    for (unsigned k = 0; k < TEST_COUNT(files); k++) {
        if (wanted.missing && !strcmp(wanted.missing, files[k]))
            continue;
        path_of(f, files[k], path);
        const int file = open(path, O_CREAT | O_WRONLY | O_CLOEXEC, 0600);
        assert_true(file >= 0);
        close(file);
    }
    f->folder = open(f->path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    return f->folder;
}

/* The files and pipes; the folder's descriptor is the caller's. */
static void remove_contexts(void)
{
    char path[128];
    for (unsigned i = 0; i < CGT_MAX_SPES; i++) {
        fake_spe *const f = &fake[i];
        for (int k = 0; k < PIPES && f->made; k++) {
            close(f->pipe[k]);
            path_of(f, pipes[k], path);
            remove(path);
        }
        for (unsigned k = 0; k < TEST_COUNT(files) && f->made; k++) {
            path_of(f, files[k], path);
            remove(path);
        }
        if (f->made)
            rmdir(f->path);
        f->made = false;
    }
}

static size_t read_file(const fake_spe *f, const char *name, void *to, size_t most)
{
    const int file = openat(f->folder, name, O_RDONLY | O_CLOEXEC);
    const ssize_t size = file < 0 ? -1 : read(file, to, most);
    if (file >= 0)
        close(file);
    return size < 0 ? 0 : (size_t)size;
}

/* ---- its SPEs: what a program compiled for the host asks for ---- */

static void pass(int pipe, uint32_t value) { (void)!write(pipe, &value, sizeof value); }
static uint32_t take(int pipe)
{
    uint32_t value = 0;
    (void)!read(pipe, &value, sizeof value);
    return value;
}

static uint32_t read_channel(void *self, unsigned channel)
{
    const fake_spe *const f = self;
    switch (channel) {
    case MFC_RdTagStat: return f->tags; /* DMA is done at once */
    case SPU_RdInMbox: return take(f->pipe[WBOX]);
    case SPU_RdSigNotify1: return take(f->pipe[SIGNAL1]);
    default: return 0xffffffff;
    }
}

static void write_channel(void *self, unsigned channel, uint32_t value)
{
    fake_spe *const f = self;
    if (channel == MFC_WrTagMask)
        f->tags = value;
    else if (channel == SPU_WrOutMbox)
        pass(f->pipe[MBOX], value);
    else if (channel == SPU_WrOutIntrMbox)
        pass(f->pipe[IBOX], value);
}

static void do_dma(void *self, const cgt_spu_dma *dma)
{
    (void)self;
    void *const memory = (void *)(uintptr_t)((uint64_t)dma->eah << 32 | dma->eal);
    if (dma->command & 0x40)
        memcpy((void *)(uintptr_t)dma->ls, memory, dma->size);
    else
        memcpy(memory, (const void *)(uintptr_t)dma->ls, dma->size);
}

static uint64_t register_of(uint8_t regs[128][16], unsigned number)
{
    uint64_t value = 0;
    for (int k = 0; k < 8; k++)
        value = value << 8 | regs[number][k];
    return value;
}

static int fake_run(void *user, int folder, uint32_t *pc, uint32_t *event)
{
    static const unsigned char text[] = {0, 0x20, 0, 0, 0, 0, 0x20, 0};
    unsigned char mem[8] = {0};
    uint8_t regs[128][16] = {{0}};
    char type = 0;
    unsigned i = 0;
    (void)user;
    while (fake[i].folder != folder || !fake[i].made)
        i++;
    fake_spe *const f = &fake[i];
    if (wanted.interruptions && i == 0) {
        wanted.interruptions--;
        errno = EINTR;
        return -1;
    }
    if (wanted.status) {
        *event = wanted.event;
        errno = wanted.error;
        return wanted.status;
    }
    const bool right = read_file(f, "mem", mem, sizeof mem) == sizeof mem && !memcmp(mem, text, sizeof mem) &&
                       read_file(f, "regs", regs, sizeof regs) == sizeof regs && register_of(regs, 3) == i &&
                       read_file(f, "signal1_type", &type, 1) == 1 && type == '1' && *pc == 0;
    f->arena = aligned_alloc(128, 262144);
    if (!right || !f->arena)
        return 0x20ff << 16 | 2;
    memset(f->arena, 0, 262144);
    const cgt_spu_host host = {.self = f, .read_channel = read_channel, .write_channel = write_channel, .dma = do_dma};
    (void)cgt_spu_set_host(&host);
    const int code = spe_grid(i, register_of(regs, 4), register_of(regs, 5));
    (void)cgt_spu_set_host(NULL);
    free(f->arena);
    *pc = 8;
    return (0x2000 | code) << 16 | 2;
}

static const cgt_spufs_calls calls = {.create = fake_create, .run = fake_run};

/* ---- frames ---- */

static uint32_t expected[WIDTH * HEIGHT], found[WIDTH * HEIGHT];

static cgt_result trace(const cgt_cell_frame_options *o, uint32_t *ids)
{
    const cgt_grid_frame_options options = {.cell = *o};
    cgt_camera camera;
    cgt_camera_init(&camera);
    const cgt_result code = cell_grid_trace(SPHERES, &camera, WIDTH, HEIGHT, &options, ids, &cell_result);
    remove_contexts();
    return code;
}

static void make_scene(uint64_t stream)
{
    test_random r = random_make(stream);
    for (uint32_t i = 0; i < SPHERES; i++)
        cell_sphere[i] = i % 2 ? cell_sphere[i - 1] /* ties fill the ring of doubts */
                               : (cgt_sphere){random_float(&r, -1, 1), random_float(&r, -1, 1), random_float(&r, -1, 1),
                                              random_float(&r, 0.05f, 0.2f)};
}

TEST(frames_are_those_of_native_spes)
{
    for (unsigned k = 0; k < 8; k++) {
        const cgt_cell_frame_options native = {.spes = 1, .function = spe_grid},
                                     real = {.spes = 1 + k % 4,
                                             .elf = elf,
                                             .elf_bytes = sizeof elf,
                                             .real = true,
                                             .spufs = &calls,
                                             .assignment = (cgt_assignment)(k % CGT_ASSIGNMENTS),
                                             .doubts_half = 16};
        make_scene(7300 + k);
        assert_int_equal(trace(&native, expected), CGT_OK);
        memset(found, 0x55, sizeof found);
        wanted.interruptions = k;
        if (trace(&real, found) != CGT_OK)
            fail_msg("%s", cell_result.message);
        assert_memory_equal(found, expected, sizeof found);
        assert_true(cell_result.interrupts > 0 && cell_result.doubts > 0);
    }
}

/* ---- failures ---- */

static const cgt_cell_frame_options usual = {
    .spes = 2, .elf = elf, .elf_bytes = sizeof elf, .real = true, .spufs = &calls};

static void expect(const cgt_cell_frame_options *o, cgt_result code, const char *words)
{
    cell_expect(trace(o, found), cell_result.message, code, words);
    memset(&wanted, 0, sizeof wanted);
}

TEST(failures)
{
    static const struct {
        int status;
        uint32_t event;
        int error;
        const char *words;
    } ends[] = {{4, 0, 0, "the program halted"},        {0x20, 0, 0, "no such instruction"},
                {0x40, 0, 0, "no such channel"},        {8, 0, 0, "did not stop by itself"},
                {2, 8, 0, "DMA is not aligned"},        {2, 0x20, 0, "that is no memory"},
                {2, 0x40, 0, "DMA command is invalid"}, {2, 0x10, 0, "raised an error"},
                {-1, 0, EIO, "Input/output error"}};
    make_scene(7400);
    for (unsigned k = 0; k < TEST_COUNT(ends); k++) {
        wanted.status = ends[k].status;
        wanted.event = ends[k].event;
        wanted.error = ends[k].error;
        expect(&usual, CGT_ERROR_STOPPED, ends[k].words);
    }
    wanted.error = ENOSYS;
    expect(&usual, CGT_ERROR_UNSUPPORTED, "there are no SPEs: this system has no spu_create");
    wanted.error = ENOENT;
    expect(&usual, CGT_ERROR_UNSUPPORTED, "mount -t spufs");
    wanted.error = EACCES;
    expect(&usual, CGT_ERROR_UNSUPPORTED, "SPE 0: spu_create: Permission denied");
    for (unsigned k = 0; k < TEST_COUNT(files); k++) {
        wanted.missing = files[k];
        expect(&usual, CGT_ERROR_UNSUPPORTED, files[k]);
    }
    cgt_cell_frame_options o = usual;
    o.elf_bytes = 60;
    expect(&o, CGT_ERROR_INVALID_ARGUMENT, "the SPEs' program");
    o = usual; /* a program that stops without a report */
    wanted.status = 0x2000 << 16 | 2;
    expect(&o, CGT_ERROR_STOPPED, "without a report");
}

/* Linux's own calls: nowhere but on a Cell is there an SPE. */
TEST(no_spes_here)
{
    cgt_cell_frame_options o = usual;
    if (access("/spu", F_OK) == 0) {
        print_message("/spu is there: not tried\n");
        return;
    }
    o.spufs = NULL;
    expect(&o, CGT_ERROR_UNSUPPORTED, "there are no SPEs");
}

/* Memory at an address that the process uses already. */
TEST(addresses_are_taken)
{
    static uint32_t words[64] __attribute__((aligned(128)));
    const cgt_memory_hooks memory = cgt_memory_default();
    const cgt_spufs_program program = {.elf = elf, .elf_bytes = sizeof elf};
    cgt_cell *cell;
    assert_int_equal(cgt_cell_create(&(cgt_cell_options){.spes = 1}, &cell), CGT_OK);
    assert_int_equal(cgt_cell_add_memory(cell, (uintptr_t)words, words, 32, 4, true), CGT_OK);
    assert_int_equal(cgt_cell_run_spufs(cell, &calls, &memory, &program, NULL, NULL), CGT_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(cgt_cell_get_message(cell), "this process cannot have memory"));
    cgt_cell_destroy(cell);
    remove_contexts();
}

SEEDED_SUITE("test_cell_real", NULL, NULL)
