/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Reads glTF 2.0 by the module cgt-gltf, where assimp would lose some of it without a word. Version 1, which is another
 * format, is refused. */
#define _POSIX_C_SOURCE 200809L
#include "mesh/gltf/gltf_reader.h"
#include "mesh/json_walk.h"

#include <dlfcn.h>
#include <inttypes.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST_LEVELS 200 /* of brackets; tinygltf descends by recursion */

/* ---- The module ---------------------------------------------------------------------------------------------- */

static pthread_once_t module_once = PTHREAD_ONCE_INIT;
static gltf_module_load *module_load; /* NULL: it could not be loaded */
static gltf_module_free *module_free;
static char module_error[400];

/* Programs carry the module's folders as their run path, in the build tree and where they are installed. */
static void load_module(void)
{
    void *const module = dlopen(GLTF_MODULE_FILE, RTLD_NOW | RTLD_LOCAL);
    void *const load = module != NULL ? dlsym(module, GLTF_MODULE_LOAD) : NULL;
    void *const release = load != NULL ? dlsym(module, GLTF_MODULE_FREE) : NULL;
    if (release == NULL) {
        snprintf(module_error, sizeof module_error, "%s", dlerror());
        return;
    }
    memcpy(&module_free, &release, sizeof module_free);
    memcpy(&module_load, &load, sizeof module_load);
}

/* ---- The file ------------------------------------------------------------------------------------------------ */

/* What the walk over the document finds. */
static int note_version(void *user, const json_walk *w, text_span word)
{
    static const char *const version[] = {"asset", "version"};
    int *const is_old = user;
    if (json_walk_is_at(w, version, 2))
        *is_old = text_begins(word, "1.");
    return 1;
}

/* The folder of a path, where other files of the same document are. */
static int copy_folder(cgt_trajectory *t, char **folder)
{
    const char *const slash = strrchr(t->path, '/');
    const size_t length = slash != NULL ? (size_t)(slash - t->path) + 1 : 0;
    *folder = malloc(length + 2);
    if (*folder == NULL)
        return trajectory_fail(t, 0, "not enough memory for a path");
    memcpy(*folder, t->path, length);
    strcpy(*folder + length, length > 0 ? "" : ".");
    return 1;
}

/* The first line of a reason, which may quote all of a file. */
static int fail_parsing(cgt_trajectory *t, const char *reason)
{
    const size_t length = strcspn(reason, "\r\n");
    return trajectory_fail(t, 0, "%.*s", (int)(length < 200 ? length : 200), reason);
}

static int import_bytes(cgt_trajectory *t, mesh_model *model, const char *bytes, size_t size)
{
    char reason[1024] = "", *folder = NULL;
    struct aiScene *scene = NULL;
    if (copy_folder(t, &folder) < 0)
        return -1;
    gltf_file *const file = module_load((const unsigned char *)bytes, size, folder, reason, sizeof reason);
    free(folder);
    if (file == NULL)
        return fail_parsing(t, reason);
    const int result = gltf_make_scene(t, file, &scene, &model->facts);
    model->bytes = t->file_size + file->bytes;
    module_free(file);
    model->scene = scene;
    model->is_gltf = 1;
    return result;
}

int mesh_import_gltf(cgt_trajectory *t, mesh_model *model)
{
    char *bytes = NULL;
    size_t size = 0;
    int is_old = 0;
    if (mesh_read_bytes(t, &bytes, &size) < 0)
        return -1;
    json_walk w = json_walk_begin(bytes, size);
    json_walk_run(&w, note_version, &is_old);
    is_old |= size >= 8 && memcmp(bytes, "glTF\1\0\0\0", 8) == 0;
    int result = -1;
    pthread_once(&module_once, load_module);
    if (w.deepest > MOST_LEVELS)
        trajectory_fail(t, 0, "%" PRIu64 " levels of brackets: more than %d cannot be read", w.deepest, MOST_LEVELS);
    else if (is_old)
        trajectory_fail(t, 0, "the file is of glTF 1, and 2.0 is read");
    else if (module_load == NULL)
        trajectory_fail(t, 0, "glTF needs tinygltf, and the module for it cannot be loaded: %s", module_error);
    else
        result = import_bytes(t, model, bytes, size);
    free(bytes);
    return result;
}
