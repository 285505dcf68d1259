/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Reads ELF files for an SPU, see elf.h. Every offset is checked against the file before it is followed. */
#define _POSIX_C_SOURCE 200809L /* strnlen */
#include "cell/spu/elf.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "cell/spu/timing/timing.h"
#include "core/memory.h"

enum {
    HEADER_BYTES = 52,
    SEGMENT_BYTES = 32,
    SECTION_BYTES = 40,
    SYMBOL_BYTES = 16,
    TYPE_EXECUTABLE = 2,
    MACHINE_SPU = 23,
    SEGMENT_LOAD = 1,
    SECTION_SYMBOLS = 2,
    SYMBOL_FUNCTION = 2
};

typedef struct file {
    const uint8_t *bytes;
    size_t size;
} file;

static uint32_t get16(const uint8_t *at) { return (uint32_t)at[0] << 8 | at[1]; }
static uint32_t get32(const uint8_t *at) { return get16(at) << 16 | get16(at + 2); }

static bool has(const file *f, uint32_t offset, uint64_t size) { return offset <= f->size && size <= f->size - offset; }

static __attribute__((format(printf, 3, 4))) cgt_result refuse(cgt_spu *spu, cgt_result result, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(spu->message, sizeof spu->message, format, arguments);
    va_end(arguments);
    return result;
}

/* ---- header ---- */

static const char *bad_header(const file *f)
{
    static const uint8_t magic[4] = {0x7f, 'E', 'L', 'F'};
    if (f->size < HEADER_BYTES || memcmp(f->bytes, magic, 4) != 0)
        return "no ELF file";
    if (f->bytes[4] != 1 || f->bytes[5] != 2)
        return "no big-endian ELF file of 32 bits, so none for an SPU";
    if (get16(f->bytes + 18) != MACHINE_SPU)
        return "an ELF file for another machine than the SPU";
    if (get16(f->bytes + 16) != TYPE_EXECUTABLE)
        return "an object file or library, not a linked program";
    if (get16(f->bytes + 42) != SEGMENT_BYTES || get16(f->bytes + 44) == 0)
        return "an ELF file without segments";
    if (!has(f, get32(f->bytes + 28), (uint64_t)get16(f->bytes + 44) * SEGMENT_BYTES))
        return "damaged: the table of segments lies outside the file";
    const uint32_t entry = get32(f->bytes + 24);
    if (entry % 4 || entry >= CGT_SPU_LOCAL_STORE)
        return "damaged: the program does not begin in the local store";
    return NULL;
}

/* ---- segments ---- */

typedef struct segment {
    uint32_t type, offset, address, file_size, memory_size;
} segment;

static uint32_t count_segments(const file *f) { return get16(f->bytes + 44); }

static segment get_segment(const file *f, uint32_t i)
{
    const uint8_t *const at = f->bytes + get32(f->bytes + 28) + (size_t)i * SEGMENT_BYTES;
    return (segment){get32(at), get32(at + 4), get32(at + 8), get32(at + 16), get32(at + 20)};
}

static cgt_result check_segments(cgt_spu *spu, const file *f, const char *name)
{
    uint32_t loaded = 0;
    for (uint32_t i = 0; i < count_segments(f); i++) {
        const segment s = get_segment(f, i);
        if (s.type != SEGMENT_LOAD)
            continue;
        loaded++;
        if (!has(f, s.offset, s.file_size) || s.file_size > s.memory_size)
            return refuse(spu, CGT_ERROR_INVALID_ARGUMENT, "%s: damaged: segment %u lies outside the file", name,
                          (unsigned)i);
        if (s.address > CGT_SPU_LOCAL_STORE || s.memory_size > CGT_SPU_LOCAL_STORE - s.address)
            return refuse(spu, CGT_ERROR_TOO_LARGE,
                          "%s: segment %u, %u bytes at 0x%x, does not fit the local store of %u bytes", name,
                          (unsigned)i, (unsigned)s.memory_size, (unsigned)s.address, CGT_SPU_LOCAL_STORE);
    }
    return loaded ? CGT_OK : refuse(spu, CGT_ERROR_INVALID_ARGUMENT, "%s: an ELF file with nothing to load", name);
}

static void copy_segments(cgt_spu *spu, const file *f)
{
    for (uint32_t i = 0; i < count_segments(f); i++) {
        const segment s = get_segment(f, i);
        if (s.type != SEGMENT_LOAD)
            continue;
        memcpy(spu->local_store + s.address, f->bytes + s.offset, s.file_size);
        memset(spu->local_store + s.address + s.file_size, 0, s.memory_size - s.file_size);
        cgt_spu_forget(spu, s.address, s.memory_size);
    }
}

/* ---- symbols ---- */

typedef struct symbols {
    const uint8_t *symbol; /* count entries of SYMBOL_BYTES */
    uint32_t count;
    const char *names;
    uint32_t name_bytes;
} symbols;

static const uint8_t *get_section(const file *f, uint32_t i)
{
    const uint64_t offset = get32(f->bytes + 32) + (uint64_t)i * SECTION_BYTES;
    return i < get16(f->bytes + 48) && offset <= f->size && SECTION_BYTES <= f->size - offset ? f->bytes + offset
                                                                                              : NULL;
}

/* A file without usable symbols has none: they serve the profile alone. */
static symbols find_symbols(const file *f)
{
    const symbols none = {NULL, 0, NULL, 0};
    if (get16(f->bytes + 46) != SECTION_BYTES)
        return none;
    for (uint32_t i = 0; i < get16(f->bytes + 48); i++) {
        const uint8_t *const section = get_section(f, i);
        if (!section || get32(section + 4) != SECTION_SYMBOLS)
            continue;
        const uint8_t *const names = get_section(f, get32(section + 24));
        const uint32_t offset = get32(section + 16), size = get32(section + 20);
        if (!names || !has(f, offset, size) || !has(f, get32(names + 16), get32(names + 20)))
            return none;
        return (symbols){f->bytes + offset, size / SYMBOL_BYTES, (const char *)f->bytes + get32(names + 16),
                         get32(names + 20)};
    }
    return none;
}

/* The name of a symbol and its length: it may lack its end in a damaged file. */
static size_t get_name(const symbols *s, uint32_t i, const char **name)
{
    const uint32_t at = get32(s->symbol + (size_t)i * SYMBOL_BYTES);
    if (at >= s->name_bytes)
        return 0;
    *name = s->names + at;
    return strnlen(*name, s->name_bytes - at);
}

static bool get_function(const symbols *s, uint32_t i, cgt_spu_function *function)
{
    const uint8_t *const at = s->symbol + (size_t)i * SYMBOL_BYTES;
    const char *name = "";
    size_t length = get_name(s, i, &name);
    *function = (cgt_spu_function){.address = get32(at + 4), .size = get32(at + 8)};
    if ((at[12] & 15) != SYMBOL_FUNCTION || length == 0 || function->size == 0)
        return false;
    if (function->address >= CGT_SPU_LOCAL_STORE || function->size > CGT_SPU_LOCAL_STORE - function->address)
        return false;
    length = length < CGT_SPU_NAME_BYTES ? length : CGT_SPU_NAME_BYTES - 1;
    memcpy(function->name, name, length);
    return true;
}

static cgt_result take_functions(cgt_spu *spu, const file *f)
{
    const symbols s = find_symbols(f);
    cgt_spu_function function;
    uint32_t count = 0;
    for (uint32_t i = 0; i < s.count; i++)
        count += get_function(&s, i, &function);
    if (count == 0)
        return cgt_spu_timing_set_functions(spu->timing, &spu->memory, NULL, 0);
    cgt_spu_function *const list = cgt_allocate(&spu->memory, count * sizeof *list);
    if (!list)
        return CGT_ERROR_OUT_OF_MEMORY;
    uint32_t n = 0;
    for (uint32_t i = 0; i < s.count; i++)
        if (get_function(&s, i, &function))
            list[n++] = function;
    const cgt_result result = cgt_spu_timing_set_functions(spu->timing, &spu->memory, list, n);
    cgt_free(&spu->memory, list, count * sizeof *list);
    return result;
}

/* ---- calls ---- */

cgt_result cgt_spu_load_elf(cgt_spu *spu, const void *bytes, size_t size, const char *name)
{
    const file f = {bytes, size};
    spu->message[0] = 0;
    const char *const reason = bad_header(&f);
    if (reason)
        return refuse(spu, CGT_ERROR_INVALID_ARGUMENT, "%s: %s", name, reason);
    const cgt_result result = check_segments(spu, &f, name);
    if (result)
        return result;
    copy_segments(spu, &f);
    spu->pc = get32(f.bytes + 24);
    if (spu->timing && take_functions(spu, &f))
        return refuse(spu, CGT_ERROR_OUT_OF_MEMORY, "%s: no memory for its functions", name);
    return CGT_OK;
}

bool cgt_spu_find_symbol(const void *bytes, size_t size, const char *symbol, uint32_t *address)
{
    const file f = {bytes, size};
    if (bad_header(&f))
        return false;
    const symbols s = find_symbols(&f);
    for (uint32_t i = 0; i < s.count; i++) {
        const char *name = "";
        const size_t length = get_name(&s, i, &name);
        if (length && length == strlen(symbol) && memcmp(name, symbol, length) == 0) {
            *address = get32(s.symbol + (size_t)i * SYMBOL_BYTES + 4);
            return true;
        }
    }
    return false;
}
