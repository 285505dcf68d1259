/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Time goes by the size of a file, whatever is in it. Each row makes a file of many things of a kind; one of eight
 * times as many may take 24 times the CPU time, where a search among all of them for each takes 64. No time is
 * asserted, and both are the least of as many readings as are needed: other programs, which make long readings up to
 * twice as long, do not matter. */
#define _GNU_SOURCE
#include <limits.h>
#include <time.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "readers/trajectory_scratch.h"

#define MORE 8 /* times as many in the large file */
#define MOST_RATIO 24.0
#define READINGS 40   /* at most; two are enough on an idle machine */
#define HOPELESS 36.0 /* a ratio that load does not explain, after a few readings */

/* ---- Files ----------------------------------------------------------------------------------------------------- */

typedef struct growing {
    char *bytes;
    size_t size, capacity;
} growing;

static void put(growing *g, const void *bytes, size_t size)
{
    if (g->capacity - g->size < size) {
        g->capacity = 2 * (g->capacity + size);
        g->bytes = realloc(g->bytes, g->capacity);
        assert_non_null(g->bytes);
    }
    memcpy(g->bytes + g->size, bytes, size);
    g->size += size;
}

static void print(growing *g, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void print(growing *g, const char *format, ...)
{
    char text[256];
    va_list arguments;
    va_start(arguments, format);
    const int size = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    assert_true(size >= 0 && (size_t)size < sizeof text);
    put(g, text, (size_t)size);
}

static void put_whole(growing *g, uint64_t value, size_t bytes, int is_big)
{
    for (size_t i = 0; i < bytes; i++) {
        const unsigned char byte = (unsigned char)(value >> (8 * (is_big ? bytes - 1 - i : i)));
        put(g, &byte, 1);
    }
}

static void set_whole(growing *g, size_t at, uint64_t value)
{
    for (size_t i = 0; i < 8; i++)
        g->bytes[at + i] = (char)(unsigned char)(value >> (8 * i));
}

/* ---- GSD ------------------------------------------------------------------------------------------------------- */

static void put_entry(growing *g, uint64_t frame, uint64_t rows, uint64_t place, uint32_t columns, uint32_t name,
                      int type)
{
    put_whole(g, frame, 8, 0);
    put_whole(g, rows, 8, 0);
    put_whole(g, place, 8, 0);
    put_whole(g, columns, 4, 0);
    put_whole(g, name, 2, 0);
    put_whole(g, (uint64_t)type, 2, 0);
}

/* `names` further names and `frames` frames of one particle. What is 0 is 256 zeros behind the header. */
static void make_gsd(growing *g, uint32_t names, const char *prefix, uint32_t entries, uint64_t frames)
{
    static const char head[512] = "\xdf\x65\xdf\x65\xdf\x65\xdf\x65";
    put(g, head, sizeof head);
    strcpy(g->bytes + 112, "hoomd");
    g->bytes[46] = 2;
    const uint64_t one = g->size;
    put_whole(g, 1, 8, 0);
    const uint64_t list = g->size;
    put(g, "particles/N", 12);
    put(g, "particles/position", 19);
    for (uint32_t i = 0; i < names; i++) {
        print(g, "%s%x", prefix, i);
        put(g, "", 1);
    }
    while ((g->size - list) % 64 != 0)
        put(g, "", 1);
    set_whole(g, 24, list);
    set_whole(g, 32, (g->size - list) / 64);
    const uint64_t index = g->size;
    put_entry(g, 0, 1, one, 1, 0, 3);
    put_entry(g, 0, 1, 256, 3, 1, 9);
    for (uint32_t i = 0; i < entries; i++)
        put_entry(g, 0, 1, 256, 1, 2 + i, 9);
    for (uint64_t k = 1; k < frames; k++)
        put_entry(g, k, 1, 256, 3, 1, 9);
    set_whole(g, 8, index);
    set_whole(g, 16, (g->size - index) / 32);
}

static void gsd_names(growing *g, uint32_t n) { make_gsd(g, n, "particles/", n, 1); }
static void gsd_other_names(growing *g, uint32_t n) { make_gsd(g, n, "n", n, n); }

/* ---- Text ------------------------------------------------------------------------------------------------------ */

static void pdb_models(growing *g, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++)
        print(g, "MODEL        1\nATOM      1  C   UNL A   1       1.000   0.000   0.000\nENDMDL\n");
    for (uint32_t i = 0; i < n; i++)
        print(g, "CONECT    1%5u%5u%5u%5u\n", 4 * i % 99990 + 2, 4 * i % 99990 + 3, 4 * i % 99990 + 4,
              4 * i % 99990 + 5);
    print(g, "END\n");
}

static void pdb_atoms(growing *g, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++)
        print(g, "ATOM  %5u %04x UNL A   1       1.000   0.000   0.000\n", 99999 - i, i % 1000);
    for (uint32_t i = 0; i < n; i++)
        print(g, "CONECT%5u%5u%5u%5u%5u\n", 99999, 99998 - i, 99999 - i, 99999, 2);
    print(g, "END\n");
}

static void xyz_brackets(growing *g, uint32_t n)
{
    print(g, "1\n");
    for (uint32_t i = 0; i < n; i++)
        print(g, "a=[ ");
    print(g, "\nC 1 2 3\n");
}

static void xyz_quotes(growing *g, uint32_t n)
{
    print(g, "1\n");
    for (uint32_t i = 0; i < n; i++)
        print(g, "a='\\' \" ]");
    print(g, "\nC 1 2 3\n");
}

static void xyz_names(growing *g, uint32_t n)
{
    print(g, "%u\n\n", n);
    for (uint32_t i = 0; i < n; i++)
        print(g, "n%x 1 2 3\n", i);
}

/* Rows of an unusual form, and behind them in the reader's buffer a line as long as all of them. */
static void xyz_long_line(growing *g, uint32_t n)
{
    for (int k = 0; k < 2; k++) {
        print(g, "%u\n\n", k == 0 ? 1 : n + 1);
        for (uint32_t i = 0; i < n && k == 1; i++)
            print(g, "C 1 +2 3\n");
        print(g, "C 1 2 3");
        for (uint32_t i = 0; i < n; i++)
            print(g, " 456789ab");
        print(g, "\n");
    }
}

static void xyz_frames(growing *g, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++)
        print(g, "1\nProperties=species:S:1:pos:R:3:n%x:S:1 t=%u\nC%x 1 2 3 w\n", i, i, i);
}

static void lammps_labels(growing *g, uint32_t n)
{
    print(g, "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n%u\nITEM: ATOMS id typelabel x y z\n", n);
    for (uint32_t i = 0; i < n; i++)
        print(g, "%u t%x 1 2 3\n", i, i % 1024);
}

static void lammps_columns(growing *g, uint32_t n)
{
    print(g, "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS x y z");
    for (uint32_t i = 0; i < n; i++)
        print(g, " c%x", i);
    print(g, "\n1 2 3");
    for (uint32_t i = 0; i < n; i++)
        print(g, " 1");
    print(g, "\n");
}

static void lammps_frames(growing *g, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++)
        print(g, "ITEM: TIMESTEP\n%u\nITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS element x y z\nA%x 1 2 3\n", i, i % 1024);
}

static void data_sections(growing *g, uint32_t n)
{
    print(g, "t\n\n%u atoms\n%u bonds\n0 9 xlo xhi\n\n", n, n);
    for (uint32_t i = 0; i < n; i++)
        print(g, "Bond Coeffs\n\n1 2 3\n\n");
    print(g, "Atoms # atomic\n\n");
    for (uint32_t i = 0; i < n; i++)
        print(g, "%u %u 1 2 3\n", n - i, i % 1000 + 1);
    print(g, "\nVelocities\n\n");
    for (uint32_t i = 0; i < n; i++)
        print(g, "%u 1 2 3\n", i + 1);
    print(g, "\nBonds\n\n");
    for (uint32_t i = 0; i < n; i++)
        print(g, "%u 1 1 %u\n", i + 1, i + 1);
}

static void gro_frames(growing *g, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++)
        print(g, "t= %u\n1\n%5u%-5x%-5x    1   1.000   1.000   1.000\n9 9 9\n", i, i % 1000, i % 1000, i % 1000);
}

static void cif_loops(growing *g, uint32_t n)
{
    print(g, "data_x\n");
    for (uint32_t i = 0; i < n; i++)
        print(g, "loop_\n_a%x\n_b\n1 2 3 4\n_c%x 'it''s'\n", i, i);
    print(g, "loop_\n_atom_site.id\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n1 1 2 3\n");
}

static void cif_tags(growing *g, uint32_t n)
{
    print(g, "data_x\nloop_\n");
    for (uint32_t i = 0; i < n; i++)
        print(g, "_atom_site_label_%x\n", i);
    print(g, "1\nloop_\n_atom_site.id\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n1 1 2 3\n");
}

static void cif_blocks(growing *g, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++)
        print(g,
              "data_%x\n_cell_length_a 9\nloop_\n_atom_site.label_atom_id\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n"
              "_atom_site.Cartn_z\n_atom_site.pdbx_PDB_model_num\nC%x 1 2 3 %u\n",
              i, i % 1000, i);
}

static void vasp_frames(growing *g, uint32_t n)
{
    print(g, "t\n1\n9 0 0\n0 9 0\n0 0 9\nFe\n1\n");
    for (uint32_t i = 0; i < n; i++)
        print(g, "Direct configuration= %u\n0 0 0\n", i);
}

static void vtk_arrays(growing *g, uint32_t n)
{
    print(g,
          "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 1 float\n1 2 3\nPOINT_DATA 1\nFIELD f %u\n",
          n);
    for (uint32_t i = 0; i < n; i++)
        print(g, "a%x 1 1 float\n1\n", i);
}

/* ---- Binary ---------------------------------------------------------------------------------------------------- */

static void put_name(growing *g, const char *name)
{
    const size_t size = strlen(name);
    put_whole(g, size, 4, 1);
    put(g, name, size);
    put(g, "\0\0\0", (4 - size % 4) % 4);
}

/* Variables that are not of frames, and frames of one atom. */
static void netcdf_variables(growing *g, uint32_t n)
{
    put(g, "CDF\1", 4);
    put_whole(g, n, 4, 1);
    put_whole(g, 10, 4, 1);
    put_whole(g, 3, 4, 1);
    const char *const names[3] = {"frame", "atom", "spatial"};
    for (uint32_t i = 0; i < 3; i++) {
        put_name(g, names[i]);
        put_whole(g, i == 0 ? 0 : i == 1 ? 1 : 3, 4, 1);
    }
    put_whole(g, 0, 8, 1);
    put_whole(g, 11, 4, 1);
    put_whole(g, n + 1, 4, 1);
    const size_t header = g->size + 16 + 4 * (size_t)3 + 28 + 44 * (size_t)n;
    put_name(g, "coordinates");
    put_whole(g, 3, 4, 1);
    for (uint32_t i = 0; i < 3; i++)
        put_whole(g, i, 4, 1);
    put_whole(g, 0, 8, 1);
    put_whole(g, 5, 4, 1);
    put_whole(g, 12, 4, 1);
    put_whole(g, header, 4, 1);
    for (uint32_t i = 0; i < n; i++) {
        char name[16];
        snprintf(name, sizeof name, "v%07x", i);
        put_name(g, name);
        put_whole(g, 1, 4, 1);
        put_whole(g, 1, 4, 1);
        put_whole(g, 0, 8, 1);
        put_whole(g, 5, 4, 1);
        put_whole(g, 4, 4, 1);
        put_whole(g, 100, 4, 1);
    }
    for (uint32_t i = 0; i < 3 * n; i++)
        put_whole(g, 0, 4, 1);
    while (g->size < header + 12 * (size_t)n)
        put_whole(g, 0, 4, 1);
}

static void trr_frames(growing *g, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        const int has_places = i + 1 == n;
        put_whole(g, 1993, 4, 1);
        put_whole(g, 13, 4, 1);
        put_whole(g, 12, 4, 1);
        put(g, "GMX_trn_file", 12);
        for (int k = 0; k < 10; k++)
            put_whole(g, k == 7 && has_places ? 12 : k == 8 && !has_places ? 12 : 0, 4, 1);
        put_whole(g, 1, 4, 1);
        for (int k = 0; k < 7; k++)
            put_whole(g, 0, 4, 1);
    }
}

/* ---- Meshes ---------------------------------------------------------------------------------------------------- */

#ifdef CGT_HAVE_GLTF
#define TRIANGLE                                                                                                       \
    "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"                                  \
    "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"         \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"                         \
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}]"

static void gltf_clips(growing *g, uint32_t n)
{
    const char head[] = "{\"asset\":{\"version\":\"2.0\"}," TRIANGLE ",\"nodes\":[{\"mesh\":0}";
    put(g, head, sizeof head - 1);
    for (uint32_t i = 0; i < n; i++)
        print(g, ",{\"skin\":-1}");
    print(g, "],\"animations\":[");
    for (uint32_t i = 0; i < n; i++)
        print(g,
              "%s{\"channels\":[{\"sampler\":0,\"target\":{\"path\":\"weights\",\"node\":0}}],\"samplers\":[{\"input\":"
              "0,\"output\":0}]}",
              i > 0 ? "," : "");
    print(g, "]}");
}

static void gltf_skins(growing *g, uint32_t n)
{
    const char head[] = "{\"asset\":{\"version\":\"2.0\"}," TRIANGLE ",\"nodes\":[{\"mesh\":0}";
    put(g, head, sizeof head - 1);
    for (uint32_t i = 0; i < n; i++)
        print(g, ",{\"mesh\":0,\"skin\":%u}", i);
    print(g, "],\"skins\":[");
    for (uint32_t i = 0; i < n; i++)
        print(g, "%s{\"joints\":[%u]}", i > 0 ? "," : "", i);
    print(g, "]}");
}
#endif

#ifdef CGT_HAVE_MESHES
static void obj_faces(growing *g, uint32_t n)
{
    print(g, "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    for (uint32_t i = 0; i < n; i++)
        print(g, "v %u 0 0\nf 1 2 3\n", i);
}
#endif

/* ---- Readings -------------------------------------------------------------------------------------------------- */

typedef struct growth {
    const char *name, *ending;
    void (*make)(growing *g, uint32_t n);
    uint32_t count; /* of the small file */
} growth;

static const growth growths[] = {
    {"names of GSD", ".gsd", gsd_names, 1250},
    {"names and frames of GSD", ".gsd", gsd_other_names, 600},
    {"models and bonds of PDB", ".pdb", pdb_models, 250},
    {"atoms and bonds of PDB", ".pdb", pdb_atoms, 2500},
    {"brackets of a comment", ".xyz", xyz_brackets, 1000},
    {"quotes of a comment", ".xyz", xyz_quotes, 12500},
    {"names of .xyz", ".xyz", xyz_names, 3000},
    {"unusual rows before a long line", ".xyz", xyz_long_line, 2500},
    {"frames of .xyz", ".xyz", xyz_frames, 125},
    {"labels of LAMMPS", ".lammpstrj", lammps_labels, 3000},
    {"columns of LAMMPS", ".lammpstrj", lammps_columns, 500},
    {"frames of LAMMPS", ".lammpstrj", lammps_frames, 2000},
    {"sections of LAMMPS data", ".data", data_sections, 2500},
    {"frames of .gro", ".gro", gro_frames, 2500},
    {"loops of CIF", ".cif", cif_loops, 5000},
    {"tags of CIF", ".cif", cif_tags, 25000},
    {"blocks of CIF", ".cif", cif_blocks, 1500},
    {"frames of VASP", ".vasp", vasp_frames, 5000},
    {"arrays of VTK", ".vtk", vtk_arrays, 5000},
    {"variables and frames of netCDF", ".nc", netcdf_variables, 500},
    {"frames of .trr", ".trr", trr_frames, 10000},
#ifdef CGT_HAVE_GLTF
    {"clips and nodes of glTF", ".gltf", gltf_clips, 500},
    {"skins and nodes of glTF", ".gltf", gltf_skins, 500},
#endif
#ifdef CGT_HAVE_MESHES
    {"faces of OBJ", ".obj", obj_faces, 2500},
#endif
};

/* CPU time of a whole reading, in seconds. */
static double time_reading(const char *path, const char *name)
{
    static const char *const asked[] = {"resname", "x", "c7", "energy"};
    char error[1024] = "";
    cgt_trajectory_frame frame;
    int status, frames = 0;
    struct timespec begin, end;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &begin);
    cgt_trajectory *t = told_open(path, NULL, error, sizeof error);
    if (t == NULL)
        fail_msg("%s: %s", name, error);
    told_want_columns(t, asked, sizeof asked / sizeof asked[0], error, sizeof error);
    while ((status = told_read(t, &frame, error, sizeof error)) > 0)
        frames++;
    cgt_trajectory_close(t);
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &end);
    if (status < 0 || frames == 0)
        fail_msg("%s: %d frames, %s", name, frames, error);
    return (double)(end.tv_sec - begin.tv_sec) + 1e-9 * (double)(end.tv_nsec - begin.tv_nsec);
}

static void expect_growth(const growth *row)
{
    const char *path[2];
    double least[2] = {1e9, 1e9};
    for (int k = 0; k < 2; k++) {
        growing g = {NULL, 0, 0};
        row->make(&g, row->count * (k == 0 ? 1 : MORE));
        path[k] = scratch_bytes(row->ending, g.bytes, g.size);
        free(g.bytes);
    }
    for (int i = 0; i < READINGS && (i < 2 || least[1] > MOST_RATIO * least[0]); i++) {
        if (i == 5 && least[1] > HOPELESS * least[0])
            break;
        for (int k = 0; k < 2; k++) {
            const double time = time_reading(path[k], row->name);
            least[k] = time < least[k] ? time : least[k];
        }
    }
    if (getenv("CGT_TEST_TIMES") != NULL)
        print_message("%-36s %8.2f ms, eight times as many %8.2f: %.1f\n", row->name, 1e3 * least[0], 1e3 * least[1],
                      least[1] / least[0]);
    if (least[1] > MOST_RATIO * least[0])
        fail_msg("%s: eight times as many take %.1f times the time", row->name, least[1] / least[0]);
}

TEST(growth_with_the_file)
{
#ifdef __GLIBC__ /* memory stays, so that its first use does not count: large arrays would be given back each time */
    mallopt(M_MMAP_MAX, 0);
    mallopt(M_TRIM_THRESHOLD, INT_MAX);
#endif
    for (size_t i = 0; i < sizeof growths / sizeof growths[0]; i++)
        expect_growth(&growths[i]);
}

SUITE(NULL, NULL)
