/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames do not depend on the way to them: a file of each format is read, rewound after every frame, skipped in part,
 * opened anew, and gives the same frames, bit by bit. */
#define _GNU_SOURCE
#include "readers/trajectory_scratch.h"
#include "support/frame_hash.h"

#define MOST_FRAMES 16

/* What a reading to the end gives. */
typedef struct reading {
    unsigned frames;
    int end; /* 0, or -1 with an error */
    uint64_t hash[MOST_FRAMES];
    char error[1024];
} reading;

static const char *const asked[] = {"x",       "fx",      "q",         "name",   "resname", "chain",     "resid",
                                    "energy",  "element", "b_factor",  "vz",     "fz",      "typelabel", "mol",
                                    "species", "density", "occupancy", "radius", "id",      "tags"};
enum { ASKED = sizeof asked / sizeof asked[0] };

/* Reads what is left; the first frame has the given number. */
static reading read_rest(cgt_trajectory *t, unsigned from)
{
    reading r = {.frames = from};
    cgt_trajectory_frame frame;
    while ((r.end = told_read(t, &frame, r.error, sizeof r.error)) > 0) {
        assert_true(r.frames < MOST_FRAMES);
        r.hash[r.frames++] = frame_hash(&frame);
    }
    return r;
}

static void rewind_it(cgt_trajectory *t)
{
    char error[1024] = "";
    if (told_rewind(t, error, sizeof error))
        fail_msg("not rewound: %s", error);
}

/* Frames from `from` on. An error of a frame that was skipped may show or not. */
static void expect_rest(const char *path, const char *how, unsigned point, const reading *first, const reading *again,
                        unsigned from)
{
    const int is_same = again->frames == first->frames && again->end == first->end;
    if (from == 0 ? !is_same || strcmp(first->error, again->error) != 0 : first->end == 0 && !is_same)
        fail_msg("%s, %s %u: %u frames, then %d %s; before %u, then %d %s", path, how, point, again->frames, again->end,
                 again->error, first->frames, first->end, first->error);
    for (unsigned i = from; i < first->frames && i < again->frames; i++)
        if (again->hash[i] != first->hash[i])
            fail_msg("%s, %s %u: frame %u differs", path, how, point, i);
}

/* Rewound after `point` calls that read or skip; then read or skipped in part. */
static void expect_again(cgt_trajectory *t, const char *path, const reading *first, unsigned point)
{
    char error[1024];
    cgt_trajectory_frame frame;
    rewind_it(t);
    for (unsigned i = 0; i < point; i++)
        told_read(t, &frame, error, sizeof error);
    rewind_it(t);
    reading again = read_rest(t, 0);
    expect_rest(path, "rewound after frames:", point, first, &again, 0);
    rewind_it(t);
    for (unsigned i = 0; i < point; i++)
        told_skip(t, error, sizeof error);
    if (point <= first->frames) {
        again = read_rest(t, point);
        expect_rest(path, "skipped frames:", point, first, &again, point);
    }
    rewind_it(t);
    again = read_rest(t, 0);
    expect_rest(path, "rewound after skipping frames:", point, first, &again, 0);
}

/* All ways through a file. Returns how many frames it has. */
static unsigned expect_file(const char *path, const cgt_trajectory_options *options, size_t columns)
{
    cgt_trajectory *t = scratch_open(path, options);
    scratch_want(t, asked, columns);
    const reading first = read_rest(t, 0);
    for (unsigned point = 0; point <= first.frames + 1; point++)
        expect_again(t, path, &first, point);
    rewind_it(t); /* words count from where they are asked for, and from the start after rewinding */
    cgt_trajectory_frame frame;
    char error[1024];
    told_read(t, &frame, error, sizeof error);
    scratch_want(t, asked, columns);
    told_read(t, &frame, error, sizeof error);
    rewind_it(t);
    reading again = read_rest(t, 0);
    expect_rest(path, "asked for columns again, of", (unsigned)columns, &first, &again, 0);
    t = scratch_open(path, options);
    scratch_want(t, asked, columns);
    again = read_rest(t, 0);
    expect_rest(path, "opened again, with columns:", (unsigned)columns, &first, &again, 0);
    return first.frames;
}

static unsigned expect_all(const char *path)
{
    static const cgt_trajectory_options wide = {.wrapped = 1, .radius = 0.25f, .threads = 2};
    expect_file(path, &wide, ASKED);
    expect_file(path, NULL, ASKED);
    return expect_file(path, NULL, 0);
}

/* ---- Files of other programs --------------------------------------------------------------------------------- */

TEST(files)
{
    static const struct {
        const char *name;
        unsigned frames;
    } files[] = {{"water.gro", 3},         {"water.pdb", 3},   {"water.dcd", 3},       {"water.xtc", 3},
                 {"water.trr", 3},         {"water.nc", 3},    {"run.gsd", 3},         {"formats.data", 1},
                 {"formats.lammpstrj", 3}, {"formats.bin", 3}, {"formats_atom.bin", 3}};
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/readers/data/%s", CGT_TESTS_DIR, files[i].name);
        assert_int_equal(expect_all(path), files[i].frames);
    }
}

/* Examples of the fuzzers, whose first byte tells what they are. */
TEST(examples)
{
    static const struct {
        const char *name, *ending;
    } files[] = {{"cif", ".cif"},   {"cif_angle", ".cif"}, {"cif_crystal", ".cif"},
                 {"dcd", ".dcd"},   {"vtk", ".vtk"},       {"vtk_binary", ".vtk"},
                 {"vasp", ".vasp"}, {"gsd", ".gsd"},       {"trr", ".trr"}};
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        static char bytes[8192];
        char path[1024];
        snprintf(path, sizeof path, "%s/fuzz/corpus/formats/%s", CGT_TESTS_DIR, files[i].name);
        FILE *const file = fopen(path, "rb");
        assert_non_null(file);
        const size_t size = fread(bytes, 1, sizeof bytes, file);
        fclose(file);
        if (expect_all(scratch_bytes(files[i].ending, bytes + 1, size - 1)) == 0)
            fail_msg("%s has no frame", files[i].name);
    }
}

/* ---- What a frame might take from others --------------------------------------------------------------------- */

#define ATOM(serial, name, x) "ATOM " serial "  " name " ALA A   1    " x "   0.000   0.000\n"
#define SITE(number, name, model) "ATOM " number " " name " 1 2 3 " model "\n"
#define SITES                                                                                                          \
    "data_x\nloop_\n_atom_site.group_PDB\n_atom_site.id\n_atom_site.label_atom_id\n_atom_site.Cartn_x\n"               \
    "_atom_site.Cartn_y\n_atom_site.Cartn_z\n_atom_site.pdbx_PDB_model_num\n"
#define HEAD(count) "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n" count "\n"
#define BOX "ITEM: BOX BOUNDS pp pp pp\n0 9\n0 9\n0 9\n"
#define CELL "title\n1\n9 0 0\n0 9 0\n0 0 9\n"

static const struct {
    const char *ending, *text;
    unsigned frames;
} texts[] = {
    /* numbers of atoms that are hexadecimal, or not, by what follows them */
    {".pdb", ATOM("100000", "CA ", "   1.000") ATOM(" 99999", "CA ", "   1.000") ATOM(" 186a0", "CA ", "   1.000"), 1},
    {".pdb",
     "MODEL        1\n" ATOM(" 99999", "CA ", "   1.000")
         ATOM(" 186a0", "CB ", "   1.000") "ENDMDL\n"
                                           "MODEL        2\n" ATOM("100000", "CA ", "   1.000")
                                               ATOM(" 99999", "CB ",
                                                    "   1.000") "ENDMDL\n"
                                                                "MODEL        3\n" ATOM(" A0000", "CA ", "   1.000")
                                                                    ATOM(" 99999", "CB ",
                                                                         "   1.000") "ENDMDL\n"
                                                                                     "CONECT99999186a0\nEND\n",
     3},
    /* names from column 13 on; a cell; bonds of one frame */
    {".pdb",
     "ATOM      1 CA   UNL A   1       1.000   0.000   0.000\nATOM      2 N    UNL A   1       1.000   0.000   0.000\n"
     "CRYST1    9.000    9.000    9.000  90.00  90.00  90.00\nCONECT    1    2\nEND\n"
     "ATOM      1 CA   UNL A   1       1.000   0.000   0.000\nATOM      2 N    UNL A   1       1.000   0.000   0.000\n"
     "END\n",
     2},
    {".pdb", ATOM("     1", "CA ", "   1.000") "END\n" ATOM("     1", "CA ", "     x  ") "END\n", 1},
    /* words and names that come later, and before an error */
    {".gro",
     "a\n1\n    1ALA     CA    1   1.000   1.000   1.000\n9 9 9\n"
     "b\n1\n    1GLY     OW    1   1.000   1.000   1.000\n0 0 0\n"
     "c\n2\n    1SER     CB    1   1.000   1.000   1.000\n    1ALA     CA    1   1.000   1.000   x\n9 9 9\n",
     2},
    {".cif", SITES SITE("1", "CA", "1") SITE("2", "CB", "2") SITE("3", "XY", "2") SITE("4", "CA", "3"), 3},
    {".xyz",
     "1\nProperties=species:S:1:pos:R:3 Lattice=\"9 0 0 0 9 0 0 0 9\" Time=3\nC 1 2 3\n"
     "2\nnote\nWater 1 2 3\nO 1 2 3\n1.5 2.5\nrest\n"
     "1\nProperties=tags:S:1:pos:R:3:velo:R:3 pbc=T\nred 1 2 3 4 5 6\n0\n\n1\n\nC 1 2 x\n",
     4},
    /* labels in a later frame, in a frame of numbers, words that are columns */
    {".lammpstrj",
     HEAD("1") BOX
     "ITEM: ATOMS id type x y z\n1 7 1 2 3\n" HEAD("2") "ITEM: ATOMS id type x y z\n1 ion 1 2 3\n2 3 1 2 3\n" HEAD(
         "2") "ITEM: ATOMS type x y z typelabel\nwater 1 2 3 a\nion 1 2 3 b\n" HEAD("0") BOX
     "ITEM: ATOMS id x y z\n" HEAD("1") "ITEM: ATOMS typelabel x y z vx vy vz\nsalt 1 2 3 1 1 1\n" HEAD(
         "1") "ITEM: ATOMS element x y\nO 1 2\n",
     6},
    {".lammpstrj",
     HEAD("1") "ITEM: ATOMS id type x y z\n1 7 1 2 3\n" HEAD("1") "ITEM: ATOMS id type x y z\n1 ion 1 2 x\n", 1},
    /* labels out of order */
    {".data",
     "title\n\n2 atoms\n1 bonds\n0 9 xlo xhi\n\nAtom Type Labels\n\n2 b\n1 a\n\nMasses\n\nb 12.011\na 1.008\n\n"
     "Atoms # atomic\n\n1 b 1 2 3\n2 a 1 2 3\n\nVelocities\n\n2 1 2 3\n\nBonds\n\n1 1 1 2\n",
     1},
    {".vasp",
     CELL "Fe O\n1 1\nDirect configuration= 1\n0 0 0\n0.5 0 0\nDirect configuration= 2\n0 0 0\n0.5 0 0\n" CELL
          "O\n1\nDirect configuration= 3\n0 0 0\nDirect configuration= 4\nx 0 0\n",
     3},
    {".vtk",
     "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 1 float\n1 2 3\nPOINT_DATA 1\n"
     "SCALARS radius float\nLOOKUP_TABLE default\n2\nVECTORS v float\n1 2 3\n",
     1},
};

TEST(hard_texts)
{
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        const unsigned frames = expect_all(scratch_text(texts[i].ending, texts[i].text));
        if (frames != texts[i].frames)
            fail_msg("text %zu: %u frames", i, frames);
    }
}

/* The same atoms have the same numbers and elements in all models, whatever an earlier one has shown. */
TEST(frames_of_the_same_atoms)
{
#define MODEL                                                                                                          \
    "MODEL        1\nATOM 100000  CA  UNL A   1       1.000   0.000   0.000\n"                                         \
    "ATOM  99999 CA   UNL A   1       1.000   0.000   0.000\n"                                                         \
    "ATOM  186a1 N    UNL A   1       1.000   0.000   0.000\nENDMDL\n"
    static const char models[] = MODEL MODEL MODEL "CONECT186a1186a0\nEND\n";
    cgt_trajectory *t = scratch_open(scratch_text(".pdb", models), NULL);
    uint8_t element[3] = {0};
    for (int k = 0; k < 3; k++) {
        const cgt_trajectory_frame f = scratch_read(t);
        assert_true(f.count == 3 && f.id[0] == 100000 && f.id[1] == 99999 && f.id[2] == 100001);
        assert_true(f.bonds == 1 && f.bond[0] == 0 && f.bond[1] == 2);
        assert_true(k == 0 || memcmp(element, f.element, 3) == 0);
        memcpy(element, f.element, 3);
    }
}

/* ---- Runs of several files ------------------------------------------------------------------------------------ */

static cgt_trajectory *open_two(const char *first, const char *second)
{
    const char *const paths[2] = {first, second};
    char error[1024] = "";
    cgt_trajectory_close(scratch_open_one);
    scratch_open_one = told_open_series(paths, 2, NULL, error, sizeof error);
    if (scratch_open_one == NULL)
        fail_msg("not opened: %s", error);
    scratch_want(scratch_open_one, asked, ASKED);
    return scratch_open_one;
}

TEST(series)
{
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        const char *const path = scratch_text(texts[i].ending, texts[i].text);
        cgt_trajectory *const t = open_two(path, scratch_text(texts[i].ending, texts[i].text));
        const reading first = read_rest(t, 0);
        assert_true(first.frames >= texts[i].frames);
        for (unsigned point = 0; point <= first.frames + 1; point++)
            expect_again(t, path, &first, point);
    }
}

/* A file of a run is what it is alone: only names count on. */
static void expect_alone(const char *ending, const char *first, const char *second)
{
    cgt_trajectory_frame frame;
    const char *const path = scratch_text(ending, second), *const before = scratch_text(ending, first);
    cgt_trajectory *t = scratch_open(path, NULL);
    frame = scratch_read(t);
    frame.number = 0;
    const uint64_t alone = frame_hash(&frame);
    const int64_t step = frame.step;
    t = open_two(before, path);
    scratch_want(t, NULL, 0);
    scratch_read(t);
    frame = scratch_read(t);
    frame.number = 0;
    frame.step = step;
    if (frame_hash(&frame) != alone)
        fail_msg("a file of %s is another one after \"%s\"", ending, first);
}

TEST(files_of_a_run)
{
    expect_alone(".data", "t\n\n1 atoms\n0 9 xlo xhi\n\nAtoms # sphere\n\n1 1 2 1 1 2 3\n",
                 "t\n\n0 atoms\n0 9 xlo xhi\n\nAtoms # atomic\n\n");
    expect_alone(".data", "t\n\n1 atoms\n0 9 xlo xhi\n\nAtom Type Labels\n\n1 a\n2 b\n\nAtoms # atomic\n\n1 a 1 2 3\n",
                 "t\n\n1 atoms\n0 9 xlo xhi\n\nAtom Type Labels\n\n1 b\n2 a\n\nAtoms # atomic\n\n1 a 1 2 3\n");
    expect_alone(".pdb",
                 "CRYST1    9.000    9.000    9.000  90.00  90.00  90.00\n" ATOM("     1", "CA ", "   1.000") "END\n",
                 ATOM("     1", "CA ", "   1.000") "END\n");
    expect_alone(".xyz", "1\nLattice=\"9 9 9\"\nC 1 2 3\n", "1\n\nC 1 2 3\n");
}

/* ---- Topologies ------------------------------------------------------------------------------------------------ */

/* A topology whose columns cannot be read after all leaves nothing behind that frames could take. */
TEST(topology_of_an_odd_residue)
{
    static const char *const name = "resid";
    cgt_trajectory_options options = {
        .topology = scratch_text(".gro", "t\n1\n    xSOL     OW    1   0.000   0.000   0.000\n0 0 0\n")};
    cgt_trajectory *const t = scratch_open(scratch_text(".xyz", "1\n\n1 1 2 3\n"), &options);
    cgt_trajectory_frame frame;
    char error[1024] = "";
    assert_int_equal(scratch_read(t).count, 1);
    assert_int_equal(told_want_columns(t, &name, 1, error, sizeof error), -1);
    assert_non_null(strstr(error, "columns 1 to 5 have no number of a residue"));
    rewind_it(t);
    assert_int_equal(told_read(t, &frame, error, sizeof error), -1);
    assert_non_null(strstr(error, "the topology cannot be read: "));
    rewind_it(t);
    scratch_want(t, NULL, 0);
    assert_int_equal(scratch_read(t).count, 1);
}

/* After an error all but rewinding repeats it: counting does not go on, asking for columns keeps its words. */
TEST(errors_are_repeated)
{
#define STEP(x)                                                                                                        \
    "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z\n"    \
    "1 " x " 0 0\n"
    const char *const path = scratch_text(".lammpstrj", STEP("0") STEP("?") STEP("0")); /* skipping does not see it */
    cgt_trajectory *const t = scratch_open(path, NULL);
    cgt_trajectory_frame frame;
    char error[1024], again[1024];
    uint64_t count = 7;
    assert_int_equal(told_read(t, &frame, error, sizeof error), 1);
    assert_true(told_read(t, &frame, error, sizeof error) < 0);
    static const char *names[CGT_TRAJECTORY_MOST_COLUMNS + 1]; /* one too many */
    for (size_t i = 0; i <= CGT_TRAJECTORY_MOST_COLUMNS; i++)
        names[i] = "x";
    for (int call = 0; call < 6; call++) {
        const cgt_result result = call == 0   ? cgt_trajectory_want_columns(t, names, 1)
                                  : call == 1 ? cgt_trajectory_want_columns(t, names, sizeof names / sizeof names[0])
                                  : call == 2 ? cgt_trajectory_want_columns(t, NULL, 0)
                                  : call == 3 ? cgt_trajectory_count_frames(t, &count)
                                  : call == 4 ? cgt_trajectory_skip(t)
                                              : cgt_trajectory_read(t, &frame);
        assert_int_equal(result, CGT_ERROR_FILE);
        cgt_trajectory_get_error_message(t, again, sizeof again);
        assert_string_equal(again, error);
    }
    assert_int_equal(count, 7);
    rewind_it(t);
    /* refused, and no error of reading */
    assert_int_equal(cgt_trajectory_want_columns(t, names, sizeof names / sizeof names[0]), CGT_ERROR_FILE);
    assert_int_equal(cgt_trajectory_want_columns(t, names, 1), CGT_OK);
    assert_int_equal(told_read(t, &frame, error, sizeof error), 1);
}

#ifdef CGT_HAVE_MESHES
TEST(meshes) { assert_int_equal(expect_all(scratch_text(".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")), 1); }
#endif

SUITE(NULL, NULL)
