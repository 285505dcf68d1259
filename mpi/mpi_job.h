/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The inside of libcgt-mpi: ranks, their leaders, shared memory, tables of primitives and vertices. */
#ifndef MPI_JOB_H
#define MPI_JOB_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cgt/mpi.h>

/* Memory of a machine's ranks. */
typedef struct mpi_memory {
    MPI_Win window; /* MPI_WIN_NULL: none */
    char *base;
    size_t bytes;
} mpi_memory;

enum { MOST_COLUMNS = 6, ALIGNMENT = 64 };

/* Elements in columns, those of number i at i times the column's bytes, in shared memory. */
typedef struct mpi_table {
    uint32_t columns;
    size_t bytes[MOST_COLUMNS];
    char *column[MOST_COLUMNS];
    uint32_t slots;          /* numbers that there are */
    _Atomic uint32_t *taken; /* a bit of each number; NULL: all are taken */
    mpi_memory memory;
} mpi_table;

typedef enum mpi_kind { KIND_SPHERES = 0, KIND_TRIANGLES, KIND_CAPSULES } mpi_kind;

/* A geometry of all ranks. */
typedef struct mpi_geometry {
    mpi_kind kind;
    unsigned parts;                 /* mpi_part values that its look has on any rank */
    mpi_table primitives, vertices; /* vertices: of triangles */
    cgt_spheres spheres;            /* on leaders: over the tables */
    cgt_triangles triangles;
    cgt_capsules capsules;
} mpi_geometry;

enum { MESSAGE_SIZE = 320 };

struct cgt_mpi {
    bool failed;                      /* its creation: it has its message, and nothing else */
    MPI_Comm ranks, machine, leaders; /* machine: those of one leader; leaders: MPI_COMM_NULL elsewhere */
    int rank, local, locals;          /* local: in machine; 0: the leader */
    int leader_count, leader;         /* of this machine, in leaders */
    uint64_t *elements;               /* these three: of each leader's machine, while something is exchanged */
    int *bytes, *places;
    size_t exchange_bytes;
    mpi_memory exchange;
    mpi_geometry *geometry;
    cgt_look *looks;
    uint32_t count, room; /* of these two */
    cgt_context *context; /* of leaders it draws, of others it checks what they bring */
    cgt_scene *scene;     /* on leaders */
    uint32_t in_scene;    /* geometries that it has */
    bool committed;       /* on all ranks */
    cgt_picture *picture;
    struct mpi_processors *processors;
    char message[MESSAGE_SIZE];
};

/* ---- mpi.c -------------------------------------------------------------------------------------------------- */

/* Sets the message of an error that this rank has found. */
__attribute__((format(printf, 3, 4))) cgt_result cgt_mpi_fail(cgt_mpi *m, cgt_result result, const char *format, ...);

/* The same with the message of a context. */
cgt_result cgt_mpi_fail_context(cgt_mpi *m, cgt_result result);

/* Tells all ranks whether one has failed: its result and message. The others sleep until all are there. */
cgt_result cgt_mpi_agree(cgt_mpi *m, cgt_result result);

/* ---- mpi_memory.c -------------------------------------------------------------------------------------------- */

/* Makes memory at least so large; what was in it is lost. */
cgt_result cgt_mpi_memory_reserve(cgt_mpi *m, mpi_memory *memory, size_t bytes);
void cgt_mpi_memory_free(mpi_memory *memory);

/* What ranks of a machine have written before this, all of them read after it. */
void cgt_mpi_memory_fence(cgt_mpi *m);

/* ---- mpi_source.c -------------------------------------------------------------------------------------------- */

typedef enum mpi_part {
    PART_IDS = 1,
    PART_COLORS = 2,
    PART_INDEX = 4,
    PART_MATERIALS = 8,
    PART_BODIES = 16,
    PART_NORMALS = 32
} mpi_part;

/* What a rank brings to a table. */
typedef struct mpi_source {
    const cgt_mpi_geometry *geometry;
    mpi_kind kind;
    unsigned parts;
    bool vertices;
    uint32_t count;      /* of elements */
    const uint32_t *ids; /* NULL: from `first` on */
    uint32_t first;
    uint32_t first_vertex; /* of the rank, in the whole */
} mpi_source;

mpi_kind cgt_mpi_kind_of(const cgt_mpi_geometry *g);
uint32_t cgt_mpi_primitives_of(const cgt_mpi_geometry *g);
uint32_t cgt_mpi_vertices_of(const cgt_mpi_geometry *g);
unsigned cgt_mpi_parts_of(const cgt_mpi_geometry *g);
const cgt_look *cgt_mpi_look_of(const cgt_mpi_geometry *g);

/* A number that differs where ranks disagree in what must be the same. */
uint64_t cgt_mpi_settings_of(const cgt_mpi_geometry *g);

/* Checks indices and types, which a commit would check. */
cgt_result cgt_mpi_check_elements(cgt_mpi *m, uint32_t geometry, const cgt_mpi_geometry *g);

/* Sets a table's columns. */
void cgt_mpi_set_columns(const mpi_source *s, mpi_table *t);

/* Writes element i of the rank's, column after column; in the default floating-point environment. */
void cgt_mpi_pack(const mpi_source *s, uint32_t i, char *to);

/* ---- mpi_table.c --------------------------------------------------------------------------------------------- */

/* Gathers a table's elements on every machine. hole: byte that the first column of numbers without an element gets. */
cgt_result cgt_mpi_table_gather(cgt_mpi *m, uint32_t geometry, mpi_table *t, const mpi_source *s, uint32_t slots,
                                int hole);

#endif
