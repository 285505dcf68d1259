/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * assimp's functions, as far as the readers of meshes call them: each loads the library at the first call and goes on
 * there. Programs that read no mesh start without it, and without the libraries that it needs. CGT_ASSIMP_FILE is the
 * name that the build found. */
#include <dlfcn.h>
#include <pthread.h>
#include <stddef.h>
#include <string.h>

#include <assimp/cimport.h>

static pthread_once_t once = PTHREAD_ONCE_INIT;

static struct {
    const char *(*get_error_string)(void);
    const struct aiScene *(*import_file)(const char *, unsigned, struct aiFileIO *);
    const struct aiScene *(*apply_post_processing)(const struct aiScene *, unsigned);
    aiBool (*is_extension_supported)(const char *);
    void (*attach_log_stream)(const struct aiLogStream *);
    enum aiReturn (*detach_log_stream)(const struct aiLogStream *);
    void (*decompose_matrix)(const struct aiMatrix4x4 *, struct aiVector3D *, struct aiQuaternion *,
                             struct aiVector3D *);
    void (*release_import)(const struct aiScene *);
} assimp;

static int loaded;

static void load(void)
{
    static const struct {
        const char *name;
        size_t at;
    } rows[] = {{"aiGetErrorString", 0},       {"aiImportFileEx", 1},    {"aiApplyPostProcessing", 2},
                {"aiIsExtensionSupported", 3}, {"aiAttachLogStream", 4}, {"aiDetachLogStream", 5},
                {"aiDecomposeMatrix", 6},      {"aiReleaseImport", 7}};
    void *symbols[sizeof rows / sizeof rows[0]];
    void *const library = dlopen(CGT_ASSIMP_FILE, RTLD_NOW | RTLD_LOCAL);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        symbols[rows[i].at] = library != NULL ? dlsym(library, rows[i].name) : NULL;
        if (symbols[rows[i].at] == NULL)
            return;
    }
    _Static_assert(sizeof symbols == sizeof assimp, "one pointer for each function, in the order of the rows");
    memcpy(&assimp, symbols, sizeof symbols);
    loaded = 1;
}

/* Without the library no ending is one that it reads, and nothing below is called. */
aiBool aiIsExtensionSupported(const char *ending)
{
    pthread_once(&once, load);
    return loaded ? assimp.is_extension_supported(ending) : AI_FALSE;
}

const struct aiScene *aiImportFileEx(const char *path, unsigned flags, struct aiFileIO *files)
{
    pthread_once(&once, load);
    return loaded ? assimp.import_file(path, flags, files) : NULL;
}

const char *aiGetErrorString(void) { return loaded ? assimp.get_error_string() : CGT_ASSIMP_FILE " cannot be loaded"; }

const struct aiScene *aiApplyPostProcessing(const struct aiScene *scene, unsigned flags)
{
    return assimp.apply_post_processing(scene, flags);
}

void aiAttachLogStream(const struct aiLogStream *stream)
{
    pthread_once(&once, load);
    if (loaded)
        assimp.attach_log_stream(stream);
}

enum aiReturn aiDetachLogStream(const struct aiLogStream *stream)
{
    return loaded ? assimp.detach_log_stream(stream) : aiReturn_FAILURE;
}

void aiDecomposeMatrix(const struct aiMatrix4x4 *matrix, struct aiVector3D *scale, struct aiQuaternion *turn,
                       struct aiVector3D *move)
{
    assimp.decompose_matrix(matrix, scale, turn, move);
}

void aiReleaseImport(const struct aiScene *scene) { assimp.release_import(scene); }
