/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The interface of the module cgt-gltf, which parses glTF 2.0 by tinygltf. It is a file of its own, loaded when it is
 * needed, so that programs start without C++'s library. It hands out what the document says, as numbers in plain
 * arrays; nothing is checked here but the grammar: an index may be of something that does not exist.
 *   view        bytes of a buffer
 *   accessor    numbers in a view
 *   primitive   triangles, strips and the like: a part of a mesh */
#ifndef GLTF_MODULE_H
#define GLTF_MODULE_H

#include <stddef.h>
#include <stdint.h>

#define GLTF_MODULE_FILE "cgt-gltf.so"
#define GLTF_MODULE_LOAD "cgt_gltf_load"
#define GLTF_MODULE_FREE "cgt_gltf_free"

#define GLTF_NONE (-1)    /* no such member */
#define GLTF_JOINT_SETS 4 /* of four joints a vertex each */

#ifdef __cplusplus
extern "C" {
#endif

/* A part of gltf_file.number or gltf_file.real. */
typedef struct gltf_list {
    size_t first, count;
} gltf_list;

typedef struct gltf_view {
    const unsigned char *bytes; /* NULL: lies outside its buffer, or the buffer has no data */
    uint64_t size, stride;      /* stride 0: elements follow each other */
    int is_compressed;          /* by an extension: the bytes are no elements */
} gltf_view;

typedef struct gltf_accessor {
    int view; /* GLTF_NONE: zeros */
    uint64_t offset, count;
    int component;  /* 5120 to 5126: signed and unsigned bytes, shorts, (no) ints, unsigned ints, floats */
    int components; /* of an element: 1 to 4, 4, 9 or 16 */
    int is_matrix, is_normalized;
    int is_sparse; /* the rest replaces single elements */
    int64_t replaced;
    int index_view, index_component, value_view;
    int64_t index_offset, value_offset;
} gltf_accessor;

/* Numbers of accessors. */
typedef struct gltf_primitive {
    int mode; /* 0 to 6: points, lines, loop, strip of lines, triangles, strip, fan */
    int indices, position, normal;
    int joints[GLTF_JOINT_SETS], weights[GLTF_JOINT_SETS];
    int more_joints; /* there are more sets */
    int is_draco;
    gltf_list target_positions, target_normals; /* of each morph target; GLTF_NONE where it has none */
} gltf_primitive;

typedef struct gltf_mesh {
    gltf_list primitives; /* of gltf_file.primitive */
    gltf_list weights;    /* of morph targets; in gltf_file.real */
} gltf_mesh;

typedef struct gltf_node {
    int mesh, skin;
    gltf_list children, weights;
    int has_matrix;
    double matrix[16]; /* by columns */
    double translation[3], rotation[4], scale[3];
    int is_instanced; /* EXT_mesh_gpu_instancing: accessors of */
    int instance_translation, instance_rotation, instance_scale;
} gltf_node;

typedef struct gltf_skin {
    gltf_list joints;
    int inverse_binds; /* accessor */
} gltf_skin;

typedef enum gltf_interpolation { GLTF_LINEAR, GLTF_STEP, GLTF_CUBIC, GLTF_UNKNOWN } gltf_interpolation;
typedef enum gltf_path { GLTF_TRANSLATION, GLTF_ROTATION, GLTF_SCALE, GLTF_WEIGHTS, GLTF_OTHER } gltf_path;

typedef struct gltf_channel {
    int node, input, output; /* accessors of the times and the values; GLTF_NONE where the sampler does not exist */
    gltf_path path;
    gltf_interpolation interpolation;
} gltf_channel;

typedef struct gltf_clip {
    const char *name;
    gltf_list channels; /* of gltf_file.channel */
} gltf_clip;

typedef struct gltf_file {
    const int *number;
    const double *real;
    const gltf_view *view;
    const gltf_accessor *accessor;
    const gltf_primitive *primitive;
    const gltf_mesh *mesh;
    const gltf_node *node;
    const gltf_skin *skin;
    const gltf_channel *channel;
    const gltf_clip *clip;
    const char *const *required; /* extensions */
    uint64_t bytes;              /* of all buffers */
    size_t views, accessors, primitives, meshes, nodes, skins, channels, clips, extensions_required;
    int has_scene;
    gltf_list roots; /* of the scene */
} gltf_file;

/* Parses `size` bytes, text or binary. Files that the document names are looked for in `folder`. Returns a file to be
 * freed, or NULL with the reason. Safe in several threads at once. Text must not be nested deeply: tinygltf descends by
 * recursion. */
typedef gltf_file *gltf_module_load(const unsigned char *bytes, size_t size, const char *folder, char *error,
                                    size_t error_size);
typedef void gltf_module_free(gltf_file *file);

__attribute__((visibility("default"))) gltf_module_load cgt_gltf_load;
__attribute__((visibility("default"))) gltf_module_free cgt_gltf_free;

#ifdef __cplusplus
}
#endif

#endif
