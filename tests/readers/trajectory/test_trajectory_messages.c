/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The sentences of the readers that no case and no other test brings out: an input for each. */
#define _GNU_SOURCE
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include "readers/trajectory_scratch.h"

typedef struct message_row {
    const char *ending, *bytes;
    size_t size;
    const char *sentence;
} message_row;

#define BYTES(text) text, sizeof(text) - 1

/* Reads a file to its end; the error or one of the warnings has to contain the sentence. */
static void expect_sentence(const char *path, const cgt_trajectory_options *options, const char *sentence)
{
    static const char *const columns[] = {"resid", "fx", "name"};
    char error[1024] = "";
    cgt_trajectory_frame frame;
    cgt_trajectory_close(scratch_open_one);
    scratch_open_one = NULL;
    cgt_trajectory *const t = told_open(path, options, error, sizeof error);
    scratch_open_one = t;
    int found = 0;
    if (t != NULL && told_want_columns(t, columns, 3, error, sizeof error) == 0)
        while (told_read(t, &frame, error, sizeof error) > 0)
            continue;
    for (const char *text = error; text != NULL && !found; text = t != NULL ? cgt_trajectory_take_warning(t) : NULL)
        found = strstr(text, sentence) != NULL;
    if (!found)
        fail_msg("\"%s\" where \"%s\" was expected", error, sentence);
}

static void expect_rows(const message_row *rows, size_t count)
{
    for (size_t i = 0; i < count; i++)
        expect_sentence(scratch_bytes(rows[i].ending, rows[i].bytes, rows[i].size), NULL, rows[i].sentence);
}

/* ---- Text ---------------------------------------------------------------------------------------------------- */

/* Topologies, of a run of one atom. */
TEST(topologies_without_places)
{
    static const struct {
        const char *ending, *text, *sentence;
    } rows[] = {
        {".psf", "PDF\n", "not a PSF file: it does not begin with PSF"},
        {".psf", "PSF\n 1 !NTITLE\n", "the file has no atoms"},
        {".psf", "PSF\n 1 !NATOM\n 1 A 1 ALA CA\n", "an atom has a number, a residue, names, a charge and a mass"},
        {".psf", "PSF\n 2 !NATOM\n 1 A 1 ALA CA CT 0.1 12.011 0\n", "the file ends in the atoms: it is cut off"},
        {".psf", "PSF\n 1 !NATOM\n 1 A 1 ALA CA CT 0.1 12.011 0\n 1 !NATOM\n 1 A 1 ALA CA CT 0.1 12.011 0\n",
         "a second section of atoms"},
        {".psf", "PSF\n 1 !NATOM\n 1 A 1 ALA CA CT 0.1 12.011 0\n 1 !NBOND\n 1 x\n",
         "a bond has the numbers of two atoms"},
        {".psf", "PSF\n 1 !NATOM\n 1 A 1 ALA CA CT 0.1 12.011 0\n 1 !NBOND\n 1\n", "the file ends in the bonds"},
        {".psf", "PSF\n 1 !NATOM\n 1 A 1 ALA CA CT 0.1 12.011 0\n 1 !NBOND\n 1 2\n",
         "a bond to atom 2, which is not there"},
        {".prmtop", "%VERSION\n%FLAG ATOM_NAME\n%FORMAT(a)\nCA  \n", "no width of fields, as in %FORMAT(20a4)"},
        {".prmtop", "%VERSION\n%FLAG ATOM_NAME\n%FORMAT(20a4)\nCA  \n", "no residues, or more than atoms"},
        {".prmtop",
         "%VERSION\n%FLAG ATOM_NAME\n%FORMAT(20a4)\nCA  \n%FLAG RESIDUE_LABEL\n%FORMAT(20a4)\nALA \n"
         "%FLAG BONDS_INC_HYDROGEN\n%FORMAT(10I8)\n       0       3       1\n",
         "bond 1 of BONDS_INC_HYDROGEN is to an atom that is not there"},
        {".top", "[ system ]\nnothing\n", "no section [ molecules ] with the molecules of the run"},
        {".top", "[ moleculetype ]\nA 1\n[ molecules ]\nA 1\n", "the file has no atoms"},
        {".top", "[ molecules ]\nA 1\n", "no molecule A"},
        {".top", "[ moleculetype ]\nA 1\n[ molecules ]\nA\n", "a molecule has a name and how many there are"},
        {".top", "#include \"absent.itp\"\n[ molecules ]\nA 1\n",
         "no molecule A: the file includes absent.itp, which is"},
        {".top", "[ moleculetype ]\nA 1\n[ moleculetype ]\nA 1\n", "a second molecule of this name"},
        {".top", "[ atoms ]\n1 C 1 A C\n", "a section of no molecule"},
        {".top", "[ moleculetype ]\nA 1\n[ atoms ]\n2 C 1 A C\n",
         "an atom has a number, 1 and so on, a type, and a residue's number and name"},
        {".top", "[ moleculetype ]\nA 1\n[ atoms ]\n1 C 1 A C\n[ bonds ]\n1 2\n",
         "a bond to an atom that is not there"},
        {".top", "[ moleculetype ]\nA 1\n[ atoms ]\n1 C 1 A C\n[ settles ]\n1 1\n",
         "a bond to an atom that is not there"},
        {".top", "[ moleculetype ]\nA 1\n[ atoms ]\n1 C 1 A C\n[ bonds ]\n1\n", "a bond has the numbers of two atoms"},
        {".top", "#include absent\n", "#include names no file"},
        {".top", "#ifdef A\n", "#ifdef without #endif"},
        {".top", "#endif\n", "#endif without #ifdef"},
        {".top", "#ifdef A\n#else\n#else\n", "#else without #ifdef"},
    };
    static const char run[] = "1\n\n1 0 0 0\n";
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const cgt_trajectory_options options = {.topology = scratch_text(rows[i].ending, rows[i].text)};
        expect_sentence(scratch_text(".xyz", run), &options, rows[i].sentence);
    }
    static const char *const two[] = {"PSF\n 2 !NATOM\n 1 A 1 ALA CA CT 0.1 12.011 0\n 2 A 1 ALA CA CT 0.1 12.011 0\n",
                                      "%VERSION\n%FLAG ATOM_NAME\n%FORMAT(20a4)\nCA  CB  \n%FLAG RESIDUE_LABEL\n"
                                      "%FORMAT(20a4)\nALA \n"};
    for (int i = 0; i < 2; i++) {
        const cgt_trajectory_options options = {.max_count = 1,
                                                .topology = scratch_text(i ? ".prmtop" : ".psf", two[i])};
        expect_sentence(scratch_text(".xyz", run), &options,
                        i ? "2 atoms are more than the limit of 1" : "more atoms than the limit of 1");
    }
    expect_sentence(scratch_text(".psf", two[0]), NULL, "have no positions: give it as the topology of a trajectory");
}

/* A file that includes itself, and conditions without end. */
TEST(topologies_within_themselves)
{
    char own[300], ifs[800] = "", wide[400];
    const char *const path = scratch_path(".top"), *const slash = strrchr(path, '/');
    snprintf(own, sizeof own, "#include \"%s\"\n", slash ? slash + 1 : path);
    for (int i = 0; i < 65; i++)
        strcat(ifs, "#ifdef A\n");
    snprintf(wide, sizeof wide, "#include \"%0300d\"\n", 0);
    const char *const texts[] = {own, ifs, wide};
    static const char *const sentences[] = {"more than 32 files that include each other", "more than 64 conditions",
                                            "#include names no file"};
    for (int i = 0; i < 3; i++) {
        const cgt_trajectory_options options = {.topology = path};
        scratch_fill(path, texts[i], strlen(texts[i]));
        expect_sentence(scratch_text(".xyz", "1\n\n1 0 0 0\n"), &options, sentences[i]);
    }
    enum { LINE = 1024, LINES = 1200 }; /* that goes on, of 1.2 MiB */
    char *const text = malloc(LINE * LINES);
    const cgt_trajectory_options options = {.topology = path};
    assert_non_null(text);
    memset(text, 'a', LINE * LINES);
    for (size_t i = 1; i <= LINES; i++) {
        text[i * LINE - 2] = '\\';
        text[i * LINE - 1] = '\n';
    }
    scratch_fill(path, text, LINE * LINES);
    free(text);
    expect_sentence(scratch_text(".xyz", "1\n\n1 0 0 0\n"), &options, "a line that goes on is too long");
}

TEST(too_many_names)
{
    const char *path = scratch_path(".xyz");
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "1026\n\n");
    for (int i = 0; i < 1025; i++)
        fprintf(file, "A%d 0 0 0\n", i);
    fprintf(file, "C7 1 0 0\n");
    assert_int_equal(fclose(file), 0);
    cgt_trajectory *t = scratch_open(path, NULL);
    const cgt_trajectory_frame frame = scratch_read(t);
    assert_true(frame.type[1023] == 1024 && frame.type[1024] == 1025 && frame.type[1025] == 1025);
    scratch_expect_sphere(&frame, 1024, 0, 0, 0, 2.0f);
    scratch_expect_sphere(&frame, 1025, 1, 0, 0, 1.7f);
    assert_non_null(
        strstr(cgt_trajectory_take_warning(t), ":1027: more than 1024 different names: the others share one"));
}

/* Words of a column that are too many, or too long, are none. */
TEST(too_many_words)
{
    static const char *const name = "label";
    const char *path = scratch_path(".xyz");
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "1027\nProperties=species:S:1:pos:R:3:label:S:1\n");
    for (int i = 0; i < 1025; i++)
        fprintf(file, "C 0 0 0 A%d\n", i);
    fprintf(file, "C 0 0 0 %064d\nC 0 0 0 A7\n", 0);
    assert_int_equal(fclose(file), 0);
    cgt_trajectory *t = scratch_open(path, NULL);
    scratch_want(t, &name, 1);
    const cgt_trajectory_frame frame = scratch_read(t);
    const cgt_trajectory_column *const column = cgt_trajectory_find_column(&frame, name);
    assert_int_equal(column->words, 1024);
    assert_true(column->value[1023] == 1024.0f && column->value[1024] == 0.0f && column->value[1025] == 0.0f &&
                column->value[1026] == 8.0f);
    assert_non_null(strstr(cgt_trajectory_take_warning(t),
                           ":1027: the column label has no words such as 'A1024': more than 1024 different names"));
}

/* ---- Binary files -------------------------------------------------------------------------------------------- */

#define CDF "CDF\1\0\0\0\0"
#define NONE "\0\0\0\0\0\0\0\0"
#define DIMENSIONS "\0\0\0\x0a\0\0\0\1"
#define VARIABLE "\0\0\0\x0b\0\0\0\1\0\0\0\1a\0\0\0"

TEST(netcdf)
{
    static const message_row rows[] = {
        {".nc", BYTES("\x89HDF\r\n\x1a\n"), "a netCDF file of version 4, which is HDF5: nccopy -k classic"},
        {".nc", BYTES("XDF\1"), "not a netCDF file: it does not begin with CDF"},
        {".nc", BYTES(CDF "\0\0\0\x0b\0\0\0\1"), "a list of an unknown kind, or a very long one"},
        {".nc", BYTES(CDF DIMENSIONS "\0\0\1\0"), "a name of more than 255 bytes"},
        {".nc", BYTES(CDF NONE "\0\0\0\x0c\0\0\0\1\0\0\0\1a\0\0\0\0\0\0\x63\0\0\0\1"),
         "an attribute of an unknown type, or a very long one"},
        {".nc", BYTES(CDF NONE NONE VARIABLE "\0\0\4\1"), "a variable of more than 1024 dimensions"},
        {".nc", BYTES(CDF NONE NONE VARIABLE "\0\0\0\1\0\0\0\0"), "a variable of a dimension that is not there"},
        {".nc", BYTES(CDF NONE NONE VARIABLE "\0\0\0\0" NONE "\0\0\0\x63\0\0\0\4"), "a variable of an unknown type"},
        {".nc",
         BYTES(CDF DIMENSIONS "\0\0\0\1x\0\0\0\x7f\xff\xff\xff" NONE VARIABLE "\0\0\0\2\0\0\0\0\0\0\0\0" NONE
                              "\0\0\0\5\0\0\0\4\0\0\0\0"),
         "a variable of more than 2^48 values"},
        {".nc",
         BYTES("CDF\5" NONE "\0\0\0\x0a\0\0\0\0\0\0\0\1\0\0\0\0\0\0\0\1x\0\0\0\0\0\0\0\0\0\0\1\0\0\0\0" NONE
               "\0\0\0\x0b\0\0\0\0\0\0\0\1\0\0\0\0\0\0\0\1a\0\0\0\0\0\0\0\0\0\0\x09" NONE NONE NONE NONE NONE NONE NONE
                   NONE NONE "\0\0\0\0" NONE "\0\0\0\5\0\2\0\0\0\0\0\0" NONE),
         "a variable of more than 2^48 bytes"},
        {".nc",
         BYTES(CDF "\0\0\0\x0a\0\0\0\3\0\0\0\1a\0\0\0\0\0\0\0\0\0\0\1f\0\0\0\0\0\0\0\0\0\0\1s\0\0\0\0\0\0\3" NONE
                   "\0\0\0\x0b\0\0\0\1\0\0\0\x0b"
                   "coordinates\0\0\0\0\3\0\0\0\1\0\0\0\0\0\0\0\2" NONE "\0\0\0\5\0\0\0\0\0\0\0\0"),
         "a frame without any data"},
        {".nc", BYTES(CDF NONE NONE NONE), "no coordinates of (frame, atom, 3): not a trajectory as Amber writes them"},
    };
    expect_rows(rows, sizeof rows / sizeof rows[0]);
}

/* A file of another program with some bytes changed, and cut off if size is not 0. */
static const struct {
    const char *file;
    size_t size, at, length;
    const char *bytes, *sentence;
} damaged[] = {
    {"water.nc", 0, 47, 1, "\0", "a damaged netCDF header: the dimension of the frames has no length"},
    {"water.nc", 0, 79, 1, "\1", "a damaged netCDF header: variables overlap"},
    {"water.xtc", 0, 0, 1, "\1", "not an .xtc frame: it does not begin with 1995"},
    {"water.xtc", 0, 4, 1, "\1", "damaged coordinates"},
    {"water.trr", 0, 0, 1, "\1", "not a .trr frame: it does not begin with 1993"},
    {"water.trr", 0, 10, 1, "\1", "a version of 268 letters: damaged"},
    {"water.trr", 0, 27, 1, "\1", "a block of 1 bytes for 12 atoms: damaged"},
    {"water.trr", 0, 55, 1, "\0", "frames without coordinates are passed over; the first is of step 0"},
    {"water.trr", 264, 63, 1, "\x90", "the file ends in the forces of a frame"},
    {"formats.bin", 0, 22, 1, "\1", "the file does not name its 10 columns, which only LAMMPS since 2020 does"},
    {"formats.bin", 0, 34, 1, "\0", "a chunk of 80 numbers does not fit: damaged"},
    {"formats.bin", 0, 34, 1, "\x09", "8 rows of 9: damaged"},
    {"formats.bin", 0, 70, 8, "\0\0\0\0\0\0\xf8\x7f", "a bound of the box is not a number"},
    {"formats.bin", 0, 70, 8, "\0\0\0\0\0\0\xf0\x7e", "the lower bound of the box is above the upper one"},
    {"formats.bin", 0, 142, 1, "\1", "10 names of 1 columns"},
    {"formats.bin", 0, 146, 4, "\xff\xff\xff\xff", "a string of -1 bytes: damaged"},
    {"formats.bin", 0, 18, 128, NULL, "the file does not name its 5 columns: they are taken for id type xs ys zs"},
    {"water.dcd", 0, 4, 1, "X", "not a DCD file: the header has no CORD"},
    {"water.dcd", 0, 40, 1, "\x0d", "12 atoms, 13 of them fixed: the header is damaged"},
    {"water.dcd", 0, 40, 1, "\1", "the list of moving atoms has 48 bytes where 44 are expected"},
    {"water.dcd", 0, 276, 1, "\0", "the first record has 0 bytes where 48 are expected"},
    {"water.dcd", 500, 52, 1, "\1", "the file ends in the fourth coordinate"},
};

static size_t read_data(const char *name, unsigned char *bytes, size_t most)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/readers/data/%s", CGT_TESTS_DIR, name);
    FILE *const file = fopen(path, "rb");
    assert_non_null(file);
    const size_t size = fread(bytes, 1, most, file);
    fclose(file);
    return size;
}

TEST(damaged_files)
{
    for (size_t i = 0; i < sizeof damaged / sizeof damaged[0]; i++) {
        static unsigned char bytes[4096];
        size_t size = read_data(damaged[i].file, bytes, sizeof bytes);
        if (damaged[i].bytes != NULL) {
            memcpy(bytes + damaged[i].at, damaged[i].bytes, damaged[i].length);
        } else { /* LAMMPS before 2020: no names; five columns */
            bytes[22] = 1;
            bytes[142] = 5;
        }
        size = damaged[i].size > 0 ? damaged[i].size : size;
        expect_sentence(scratch_bytes(strrchr(damaged[i].file, '.'), bytes, size), NULL, damaged[i].sentence);
    }
}

/* ---- Pipes --------------------------------------------------------------------------------------------------- */

static void expect_of_pipe(const char *ending, const void *bytes, size_t size, const char *sentence)
{
    const char *const path = scratch_path(ending);
    unlink(path);
    assert_int_equal(mkfifo(path, 0600), 0);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        const int descriptor = open(path, O_WRONLY);
        signal(SIGPIPE, SIG_IGN);
        _exit(descriptor < 0 || write(descriptor, bytes, size) < 0);
    }
    expect_sentence(path, NULL, sentence);
    cgt_trajectory_close(scratch_open_one);
    scratch_open_one = NULL;
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
}

TEST(pipes)
{
    static const char pdb[] = "MODEL 1\nHETATM    1  C   LIG A   1       0.000   0.000   0.000\nENDMDL\n"
                              "MODEL 2\nHETATM    1  C   LIG A   1       0.000   0.000   0.000\nENDMDL\n"
                              "CONECT    1    1\nEND\n";
    expect_of_pipe(".pdb", BYTES(pdb), "bonds after the models come too late in a stream");
    static unsigned char bytes[4096];
    const size_t size = read_data("water.nc", bytes, sizeof bytes);
    bytes[31] = 3; /* the length of the dimension of frames */
    expect_of_pipe(".nc", bytes, size, "the frames have a dimension of fixed length: that needs a regular file");
}

/* ---- Options ------------------------------------------------------------------------------------------------- */

TEST(options)
{
    static const cgt_trajectory_options follow = {.follow = 1.0};
    expect_sentence(scratch_text(".pdb", ""), &follow, "files of this format cannot be read while they are written");
    static const char *names[257];
    char error[1024];
    for (int i = 0; i < 257; i++)
        names[i] = "x";
    cgt_trajectory *const t = scratch_open(scratch_text(".xyz", "1\n\nC 0 0 0\n"), NULL);
    assert_int_equal(told_want_columns(t, names, 257, error, sizeof error), -1);
    assert_non_null(strstr(error, "more than 256 columns are asked for"));
    scratch_want(t, names, 256);
    scratch_read(t);
    cgt_trajectory_options options;
    cgt_trajectory_options_init(&options);
    static const uint32_t index[3] = {0, 1, 2};
    static const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const char *const triangles = scratch_path(".frames");
    cgt_trajectory_writer *w = told_writer_open_triangles(triangles, NULL, index, 1, error, sizeof error);
    assert_non_null(w);
    assert_int_equal(told_writer_add_vertices(w, corners, 3, error, sizeof error), 0);
    assert_int_equal(told_writer_close(w, error, sizeof error), 0);
    options.topology = triangles;
    expect_sentence(scratch_text(".xyz", "1\n\nC 0 0 0\n"), &options, "the topology is a mesh");
    options.topology = scratch_text(".xyz", "1\n\nC 0 0 0\n");
    expect_sentence(triangles, &options, "a mesh has no topology");
}

/* A pipe cannot hold .frames. */
TEST(writer)
{
    char error[1024] = "";
    const char *const path = scratch_path(".frames");
    unlink(path);
    assert_int_equal(mkfifo(path, 0600), 0);
    const int pipe_end = open(path, O_RDWR); /* so that opening does not block */
    assert_true(pipe_end >= 0);
    assert_null(told_writer_open(path, NULL, error, sizeof error));
    assert_non_null(strstr(error, "cannot hold .frames: the number of frames has to be written at the end"));
    assert_int_equal(close(pipe_end), 0);
}

SUITE(NULL, NULL)
