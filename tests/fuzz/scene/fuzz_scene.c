/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Fuzz target: bytes as a script of calls of the public interface. A context has any variant, up to three threads and a
 * memory hook that fails on demand; a scene has a few geometries of tens of primitives, valid and invalid; then come
 * commits, rays and frames. Each call is checked against cgt.h: results, messages, ids, hits, statistics, and that all
 * memory is released. */
#include "fuzz/scene/fuzz_check.h"
#include "support/ways.h"

#include <math.h>
#include <string.h>

/* ---- hooks ---- */

static void on_log(void *user, cgt_log_level level, const char *message)
{
    fuzz_model *const m = user;
    FUZZ_CHECK((unsigned)level <= CGT_LOG_LEVEL_INFO && message[0] && !strchr(message, '\n'), "log: \"%s\"", message);
    m->log_lines++;
}

/* A valid runner: jobs one after another, the last one first. */
void fuzz_check_error(fuzz_model *m, cgt_result result)
{
    char text[8];
    FUZZ_CHECK(cgt_context_get_error_message(m->context, NULL, 0) > 0, "no message for: %s",
               cgt_get_result_string(result));
    FUZZ_CHECK(cgt_context_get_error_message(m->context, text, sizeof text) > 0 && text[0] &&
                   memchr(text, 0, sizeof text),
               "a truncated message has no terminator");
    FUZZ_CHECK(result != CGT_ERROR_OUT_OF_MEMORY || m->memory.failed, "out of memory, but no allocation has failed");
    m->memory.failed = false;
}

/* ---- context and scene ---- */

/* The name of one of the build's variants. */
static const char *any_variant(uint8_t number)
{
    const char *const *const names = cgt_get_variant_names();
    uint32_t variants = 0;
    while (names[variants])
        variants++;
    FUZZ_CHECK(variants, "a build without a variant");
    return names[number % variants];
}

static bool create_context(fuzz_model *m)
{
    cgt_context_options o;
    const uint8_t threads = fuzz_byte(&m->bytes), variant = fuzz_byte(&m->bytes);
    cgt_context_options_init(&o);
    o.threads = threads < 192 ? 1 : threads < 250 ? 1 + threads % 3 : 2000;
    if (threads % 4 == 3)
        o.tasks.run = run_backwards;
    o.variant = variant < 64 ? NULL : variant < 250 ? any_variant(variant) : "none";
    o.memory = fuzz_memory_hooks(&m->memory);
    o.log = (cgt_log_hook){m, on_log};
    const bool legal = o.threads <= 1024 && variant < 250;
    cgt_result result = cgt_context_create(&o, &m->context);
    if (result == CGT_ERROR_OUT_OF_MEMORY && m->memory.failed) {
        cgt_context_release(m->context);
        FUZZ_CHECK(!m->memory.blocks, "a failed context leaves memory allocated");
        m->memory.failed = false;
        result = cgt_context_create(&o, &m->context);
    }
    if (result != CGT_OK) {
        FUZZ_CHECK(!m->context || cgt_context_get_error_message(m->context, NULL, 0) > 0, "no message");
        cgt_context_release(m->context);
        m->context = NULL;
    }
    if (result == CGT_ERROR_UNSUPPORTED) /* this CPU */
        return false;
    FUZZ_CHECK((result == CGT_OK) == legal, "context: %s", cgt_get_result_string(result));
    return legal;
}

/* Structure, builder, layout and kind of rays from one byte; the last four of 256 values must be refused. */
static test_scene_options any_structure(uint8_t how)
{
    static const cgt_structure structure[] = {CGT_STRUCTURE_AUTO, CGT_STRUCTURE_QUEUE_GRID, CGT_STRUCTURE_KD,
                                              CGT_STRUCTURE_KD_ROPES};
    test_scene_options o = {0};
    o.structure = how == 255 ? (cgt_structure)9 : structure[(how & 1) + (how >> 1 & 2)];
    if (o.structure == CGT_STRUCTURE_AUTO && how & 16)
        o.structure = how & 32 ? CGT_STRUCTURE_BVH : how & 64 ? CGT_STRUCTURE_BIH : CGT_STRUCTURE_LOOSE_GRID;
    o.kd_layout = how == 253 ? (cgt_kd_layout)4 : how == 254 ? (cgt_kd_layout)-1 : (cgt_kd_layout)(how >> 5 & 3);
    o.kd_break_level = how == 252 ? 51 : how % 51;
    o.rays = (cgt_ray_kind)(how >> 7);
    return o;
}

/* Resolutions that need little memory and time, or must be refused. */
static test_scene_options any_options(fuzz_model *m, bool *legal)
{
    static const uint32_t edges[] = {1, 2, 3, 4, 5, 7, 8, 16, 33, 64, 1024, 1025, 0, CGT_INVALID_ID};
    const uint8_t how = fuzz_byte(&m->bytes);
    test_scene_options o = any_structure(how);
    *legal = how < 252;
    if (how & 2)
        return o;
    uint64_t cells = 1;
    for (int a = 0; a < 3; a++) {
        uint32_t edge = edges[fuzz_below(&m->bytes, sizeof edges / sizeof edges[0])];
        if (edge && edge <= 1024 && cells * edge > 8192)
            edge = 1;
        *legal &= edge && edge <= 1024;
        cells *= edge && edge <= 1024 ? edge : 1;
        o.resolution[a] = edge;
    }
    *legal |= how < 252 && !o.resolution[0] && !o.resolution[1] && !o.resolution[2];
    return o;
}

static bool is_of_the_papers(const test_scene_options *o)
{
    return o->structure == CGT_STRUCTURE_AUTO
               ? o->resolution[0]
               : o->structure != CGT_STRUCTURE_LOOSE_GRID && o->structure != CGT_STRUCTURE_BVH;
}

/* Refused options are replaced by the defaults. */
static void create_scene(fuzz_model *m)
{
    bool legal;
    const test_scene_options o = any_options(m, &legal);
    cgt_result result = cgt_scene_create(m->context, SCENE_OPTIONS(&o), &m->scene);
    FUZZ_CHECK(legal || (result != CGT_OK && result != CGT_ERROR_OUT_OF_MEMORY), "scene: %s",
               cgt_get_result_string(result));
    for (int i = 0; i < 2 && result != CGT_OK; i++) {
        FUZZ_CHECK(!m->scene, "scene: not NULL after an error");
        fuzz_check_error(m, result);
        result = cgt_scene_create(m->context, legal ? SCENE_OPTIONS(&o) : NULL, &m->scene);
    }
    FUZZ_CHECK(result == CGT_OK && m->scene, "scene: %s", cgt_get_result_string(result));
    m->holds_no_capsules = legal && is_of_the_papers(&o);
}

static void set_options(fuzz_model *m)
{
    bool legal;
    const test_scene_options o = any_options(m, &legal);
    const cgt_result result = cgt_scene_set_options(m->scene, SCENE_OPTIONS(&o));
    FUZZ_CHECK((result == CGT_OK) == legal, "scene options: %s", cgt_get_result_string(result));
    if (legal) {
        m->committed = false;
        m->holds_no_capsules = is_of_the_papers(&o);
    } else {
        fuzz_check_error(m, result);
    }
}

/* ---- commit ---- */

static void check_tree(const cgt_scene_statistics *s, const cgt_research_scene_statistics *r)
{
    const uint32_t valid = s->primitives - s->skipped_not_finite - s->skipped_radius - s->skipped_degenerate;
    if (!r->kd_leaves) {
        FUZZ_CHECK(!r->kd_nodes && !r->kd_empty_leaves && !r->kd_largest_leaf, "statistics: half a kd-tree");
        return;
    }
    FUZZ_CHECK(s->structure == CGT_STRUCTURE_KD || s->structure == CGT_STRUCTURE_KD_ROPES, "statistics: not a kd-tree");
    FUZZ_CHECK(r->kd_nodes == 2 * r->kd_leaves - 1 && r->kd_empty_leaves < r->kd_leaves && r->kd_depth <= 50 &&
                   r->kd_largest_leaf >= 1 && r->kd_largest_leaf <= valid,
               "statistics: %u nodes, %u leaves, %u empty, depth %u, %u of %u in one", r->kd_nodes, r->kd_leaves,
               r->kd_empty_leaves, r->kd_depth, r->kd_largest_leaf, valid);
    FUZZ_CHECK(!r->cells && s->structure_bytes >= (size_t)8 * r->kd_nodes && s->structure_bytes <= s->bytes,
               "statistics: a kd-tree of %zu bytes", s->structure_bytes);
}

static void check_statistics(const fuzz_model *m)
{
    const cgt_research_scene_statistics r = research_of(m->scene);
    cgt_scene_statistics s;
    uint32_t geometries = 0, count[CGT_KINDS] = {0};
    for (uint32_t id = 0; id < FUZZ_GEOMETRIES; id++) {
        const fuzz_geometry *g = &m->geometry[id];
        geometries += g->used;
        count[g->kind] += fuzz_count(g);
    }
    FUZZ_CHECK(cgt_scene_get_statistics(m->scene, &s) == CGT_OK, "no statistics");
    const uint32_t spheres = count[CGT_KIND_SPHERES], triangles = count[CGT_KIND_TRIANGLES],
                   capsules = count[CGT_KIND_CAPSULES];
    FUZZ_CHECK(s.geometries == geometries && s.spheres == spheres && s.triangles == triangles &&
                   s.capsules == capsules && s.primitives == spheres + triangles + capsules,
               "statistics: %u geometries, %u spheres, %u triangles, %u capsules, %u primitives", s.geometries,
               s.spheres, s.triangles, s.capsules, s.primitives);
    FUZZ_CHECK((uint64_t)s.skipped_not_finite + s.skipped_radius + s.skipped_degenerate <= s.primitives &&
                   s.skipped_radius <= spheres + capsules && s.skipped_degenerate <= triangles,
               "statistics: %u, %u, %u skipped of %u", s.skipped_not_finite, s.skipped_radius, s.skipped_degenerate,
               s.primitives);
    const uint64_t finest = (uint64_t)r.resolution[0] * r.resolution[1] * r.resolution[2];
    FUZZ_CHECK(r.levels > 1 ? r.cells > finest : r.cells == finest, "statistics: cells");
    FUZZ_CHECK(!r.levels == (s.structure != CGT_STRUCTURE_LOOSE_GRID || !r.cells), "statistics: levels");
    FUZZ_CHECK(r.overflow_references <= r.references && r.overflow_cells <= r.overflow_references &&
                   r.large_primitives <= s.primitives && s.bytes <= m->memory.bytes,
               "statistics: the counts are inconsistent");
    for (int a = 0; a < 3; a++)
        FUZZ_CHECK(s.bounds_min[a] <= s.bounds_max[a], "statistics: bounds %a to %a", (double)s.bounds_min[a],
                   (double)s.bounds_max[a]);
    FUZZ_CHECK(s.reason[0] && memchr(s.reason, 0, sizeof s.reason),
               "statistics: no reason, or one without a terminator");
    check_tree(&s, &r);
}

bool fuzz_commit(fuzz_model *m)
{
    bool good = true;
    for (uint32_t id = 0; id < FUZZ_GEOMETRIES; id++)
        good &= fuzz_indices_are_good(&m->geometry[id]);
    cgt_result result = cgt_scene_commit(m->scene);
    if (result == CGT_ERROR_OUT_OF_MEMORY) {
        fuzz_check_error(m, result);
        result = cgt_scene_commit(m->scene);
    }
    const bool held = !m->holds_no_capsules || !fuzz_has(m, CGT_KIND_CAPSULES);
    FUZZ_CHECK((result == CGT_OK) == (good && held) && (result != CGT_ERROR_UNSUPPORTED || !held) &&
                   (result != CGT_ERROR_INVALID_ARGUMENT || !good),
               "commit: %s", cgt_get_result_string(result));
    m->committed = result == CGT_OK;
    if (m->committed)
        check_statistics(m);
    else
        fuzz_check_error(m, result);
    return m->committed;
}

/* ---- the script ---- */

static void replace_scene(fuzz_model *m)
{
    cgt_scene_release(m->scene);
    m->scene = NULL;
    for (uint32_t id = 0; id < FUZZ_GEOMETRIES; id++)
        fuzz_release_geometry(&m->geometry[id]);
    m->committed = false;
    create_scene(m);
}

/* Mostly adding, committing and tracing. */
static void step(fuzz_model *m)
{
    const uint8_t which = fuzz_byte(&m->bytes);
    if (which >= 208) {
        fuzz_call(m);
        return;
    }
    switch (which % 16) {
    case 0:
    case 1:
    case 2: fuzz_add(m); break;
    case 3: fuzz_update(m); break;
    case 4: fuzz_remove(m); break;
    case 5: fuzz_move(m); break;
    case 6: set_options(m); break;
    case 7: replace_scene(m); break;
    case 8: m->memory.fail_after = fuzz_below(&m->bytes, 16); break;
    case 9:
    case 10: fuzz_commit(m); break;
    case 11: fuzz_trace_rays(m); break;
    case 12:
    case 13:
        fuzz_commit(m);
        fuzz_trace_rays(m);
        break;
    case 14: fuzz_trace_camera(m); break;
    default:
        fuzz_commit(m);
        fuzz_trace_camera(m);
        break;
    }
}

#define MOST_STEPS 64

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_model m = {.bytes = fuzz_bytes_of(data, size)};
    m.memory.fail_after = fuzz_below(&m.bytes, 8);
    if (create_context(&m)) {
        create_scene(&m);
        for (int i = 0; i < MOST_STEPS && m.bytes.left; i++)
            step(&m);
        for (uint32_t id = 0; id < FUZZ_GEOMETRIES; id++)
            fuzz_release_geometry(&m.geometry[id]);
        cgt_context_release(m.context); /* the context lives until its last scene is released */
        cgt_scene_release(m.scene);
    }
    FUZZ_CHECK(!m.memory.blocks && !m.memory.bytes, "%zu blocks of %zu bytes are not released", m.memory.blocks,
               m.memory.bytes);
    return 0;
}
