/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Finds in glTF what assimp takes for something else without a word, in builds that have no better reader: extensions
 * that a file requires, keys of animations that are no straight lines, weights of morph targets. The JSON is walked
 * once; assimp reports its errors. */
#define _POSIX_C_SOURCE 200809L
#include "mesh/json_walk.h"
#include "mesh/mesh_model.h"

#include <stdlib.h>
#include <string.h>

/* Extensions that do not change where triangles are: materials, textures, lights, descriptions. */
static int is_harmless(text_span name)
{
    static const char *const beginnings[] = {"KHR_materials_", "KHR_texture_", "EXT_texture_", "MSFT_texture_",
                                             "KHR_lights_",    "EXT_lights_",  "KHR_xmp"};
    for (size_t i = 0; i < sizeof beginnings / sizeof beginnings[0]; i++)
        if (text_begins(name, beginnings[i]))
            return 1;
    return 0;
}

static int judge(void *user, const json_walk *w, text_span word)
{
    static const char *const required[] = {"extensionsRequired", ""};
    static const char *const interpolation[] = {"animations", "", "samplers", "", "interpolation"};
    static const char *const mesh_weights[] = {"meshes", "", "weights", ""};
    static const char *const node_weights[] = {"nodes", "", "weights", ""};
    cgt_trajectory *const t = user;
    char quote[TEXT_QUOTE_SIZE];
    if (json_walk_is_at(w, required, 2) && !is_harmless(word))
        return trajectory_fail(t, 0, "the file requires the extension %s, which cannot be read here",
                               text_quote(word, quote));
    if (json_walk_is_at(w, interpolation, 5) && !text_is(word, "LINEAR"))
        trajectory_warn(t, DOUBT_INTERPOLATION, 0, "keys of the interpolation %s are played as straight lines",
                        text_quote(word, quote));
    if (json_walk_is_at(w, mesh_weights, 4) || json_walk_is_at(w, node_weights, 4)) {
        const int is_zero = text_length(word) > 0 && strspn(word.begin, "-0.eE+") >= text_length(word);
        if (!is_zero)
            trajectory_warn(t, DOUBT_MORPH, 0, "morph targets are left out: the mesh has its own vertices");
    }
    return 1;
}

int mesh_check_gltf(cgt_trajectory *t, text_reader *r)
{
    char *bytes = NULL;
    size_t size = 0;
    (void)r;
    if (mesh_read_bytes(t, &bytes, &size) < 0)
        return -1;
    json_walk w = json_walk_begin(bytes, size);
    const int result = json_walk_run(&w, judge, t);
    free(bytes);
    return result;
}
