/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Runs LAMMPS, where it is installed, and reads what it writes in all its ways. The truth is what LAMMPS prints itself
 * of each atom and box, with all digits: truth.txt of readers/data/lammps_run.in. Skipped without the program lmp. */
#define _GNU_SOURCE
#include <math.h>

#include "readers/trajectory_scratch.h"

enum { STEPS = 3, ATOMS = 8 };

typedef struct truth_atom {
    unsigned type;
    double x[3], unwrapped[3], velocity[3], energy;
} truth_atom;

typedef struct truth_step {
    long long step;
    unsigned count;
    double low[3], edge[3][3], energy; /* edges a, b and c */
    truth_atom atom[ATOMS];
} truth_step;

typedef struct lammps_run {
    char folder[512];
    truth_step step[STEPS];
} lammps_run;

/* ---- LAMMPS --------------------------------------------------------------------------------------------------- */

static int has_lammps(void) { return system("command -v lmp >/dev/null 2>&1") == 0; }

static void read_truth(lammps_run *run)
{
    char path[600], line[1024];
    unsigned number;
    truth_step *s = run->step;
    snprintf(path, sizeof path, "%s/truth.txt", run->folder);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    int steps = 0;
    while (fgets(line, sizeof line, file) != NULL) {
        truth_atom a;
        truth_step n = {.step = 0};
        double(*const e)[3] = n.edge;
        if (sscanf(line, "step %lld %u %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf", &n.step, &n.count, &n.low[0],
                   &n.low[1], &n.low[2], &e[0][0], &e[1][1], &e[2][2], &e[1][0], &e[2][0], &e[2][1], &n.energy) == 12) {
            assert_true(steps < STEPS && n.count <= ATOMS);
            s = &run->step[steps++];
            *s = n;
        } else if (sscanf(line, "atom %u %u %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf", &number, &a.type, &a.x[0],
                          &a.x[1], &a.x[2], &a.unwrapped[0], &a.unwrapped[1], &a.unwrapped[2], &a.velocity[0],
                          &a.velocity[1], &a.velocity[2], &a.energy) == 12) {
            assert_true(steps > 0 && number >= 1 && number <= s->count);
            s->atom[number - 1] = a;
        }
    }
    fclose(file);
    assert_int_equal(steps, STEPS);
}

static void remove_folder(const char *folder)
{
    char command[600];
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    assert_int_equal(system(command), 0);
}

/* Runs an input file of tests/readers/data in a folder of its own. */
static void begin_run(lammps_run *run, const char *input)
{
    char command[2048];
    const char *parent = getenv("TMPDIR");
    memset(run, 0, sizeof *run);
    snprintf(run->folder, sizeof run->folder, "%s/cgt-lammps-XXXXXX", parent != NULL ? parent : P_tmpdir);
    assert_non_null(mkdtemp(run->folder));
    snprintf(command, sizeof command, "cd '%s' && lmp -in '%s/readers/data/%s' -log none >out.txt 2>&1 </dev/null",
             run->folder, CGT_TESTS_DIR, input);
    if (system(command) != 0) {
        remove_folder(run->folder);
        fail_msg("lmp failed: %s", command);
    }
    read_truth(run);
}

/* ---- Comparing ------------------------------------------------------------------------------------------------ */

typedef struct dump_file {
    const char *name;
    int unwrapped; /* positions go on beyond the box; else they may be any image of an atom */
    double digits; /* error of a position */
    int velocity, energy;
    int frames; /* 1: the last step alone */
    int flat;   /* has no z, which is told */
} dump_file;

static const char *path_of(const lammps_run *run, const char *name)
{
    static char path[3][700];
    static int next;
    next = (next + 1) % 3;
    snprintf(path[next], sizeof path[next], "%s/%s", run->folder, name);
    return path[next];
}

static void expect_near(const dump_file *d, const char *what, double value, double wanted, double error)
{
    if (!(fabs(value - wanted) <= error))
        fail_msg("%s, %s: %.9g, not %.17g", d->name, what, value, wanted);
}

/* Moves a position by as many edges of the box as bring it next to the wanted one. */
static void expect_place(const dump_file *d, const truth_step *s, const truth_atom *a, const float *got)
{
    double at[3] = {(double)got[0], (double)got[1], (double)got[2]};
    for (int e = 2; e >= 0 && !d->unwrapped; e--) {
        const double images = round((a->x[e] - at[e]) / s->edge[e][e]);
        for (int c = 0; c < 3; c++)
            at[c] += images * s->edge[e][c];
    }
    for (int c = 0; c < 3; c++)
        expect_near(d, "position", at[c], d->unwrapped ? a->unwrapped[c] : a->x[c], d->digits);
}

static void expect_frame(const dump_file *d, const truth_step *s, const cgt_trajectory_frame *f)
{
    const cgt_trajectory_column *const energy = cgt_trajectory_find_column(f, "c_ke");
    double sum = 0.0;
    assert_int_equal(f->count, s->count);
    assert_true(d->frames == 1 || f->step == s->step);
    assert_non_null(f->id);
    assert_true(!d->velocity || f->velocity != NULL);
    assert_true(!d->energy || (energy != NULL && energy->value != NULL));
    for (uint32_t i = 0; i < f->count; i++) {
        assert_true(f->id[i] >= 1 && f->id[i] <= s->count);
        const truth_atom *const a = &s->atom[f->id[i] - 1];
        expect_place(d, s, a, f->xyzr + 4 * (size_t)i);
        assert_int_equal(f->type[i], a->type);
        for (int c = 0; c < 3 && d->velocity; c++)
            expect_near(d, "velocity", (double)f->velocity[3 * i + (uint32_t)c], a->velocity[c],
                        1e-6 * (1e-3 + fabs(a->velocity[c])));
        sum += d->energy ? (double)energy->value[i] : 0.0;
    }
    /* thermo_style's own sum over all atoms */
    expect_near(d, "kinetic energy", sum, d->energy ? s->energy : 0.0, 1e-6 * s->energy);
    for (int e = 0; e < 3; e++) {
        expect_near(d, "corner", f->box_origin[e], s->low[e], 1e-9);
        for (int c = 0; c < 3; c++)
            expect_near(d, "edge", f->box_edge[e][c], s->edge[e][c], 1e-9);
    }
}

static void expect_file(const lammps_run *run, const dump_file *d)
{
    static const char *const wanted[] = {"c_ke"};
    char error[1024] = "";
    cgt_trajectory *t = scratch_open(path_of(run, d->name), NULL);
    assert_int_equal(told_want_columns(t, wanted, 1, error, sizeof error), 0);
    for (int i = 0; i < d->frames; i++) {
        const cgt_trajectory_frame f = scratch_read(t);
        expect_frame(d, &run->step[d->frames == 1 ? STEPS - 1 : i], &f);
    }
    scratch_expect_end(t);
    const char *warning = cgt_trajectory_take_warning(t);
    if ((warning != NULL) != d->flat)
        fail_msg("%s: %s", d->name, warning != NULL ? warning : "no word of the column that is missing");
}

/* ---- Tests ---------------------------------------------------------------------------------------------------- */

TEST(run_in_a_tilted_box)
{
    static const dump_file files[] = {
        {"custom.lammpstrj", 0, 2e-6, 1, 1, STEPS, 0},    {"scaled.lammpstrj", 1, 2e-6, 1, 1, STEPS, 0},
        {"custom.bin", 0, 2e-6, 1, 1, STEPS, 0},          {"atom.bin", 0, 2e-6, 0, 0, STEPS, 0},
        {"atom.lammpstrj", 0, 6e-5, 0, 0, STEPS, 0},      {"run.data", 0, 2e-6, 1, 0, 1, 0},
#ifdef CGT_HAVE_ARCHIVE
        {"custom.lammpstrj.gz", 1, 2e-6, 1, 1, STEPS, 0},
#endif
    };
    lammps_run run;
    begin_run(&run, "lammps_run.in");
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++)
        expect_file(&run, &files[i]);
    /* the run must have taken an atom through a side of the box, or the images are untested */
    int crossed = 0;
    for (int i = 0; i < ATOMS; i++)
        crossed += fabs(run.step[2].atom[i].x[0] - run.step[2].atom[i].unwrapped[0]) > 1.0;
    assert_true(crossed > 0);
    cgt_trajectory_close(scratch_open_one);
    scratch_open_one = NULL;
    remove_folder(run.folder);
}

TEST(bonds_of_a_data_file)
{
    lammps_run run;
    begin_run(&run, "lammps_run.in");
    const cgt_trajectory_frame f = scratch_read(scratch_open(path_of(&run, "run.data"), NULL));
    assert_int_equal(f.bonds, 3);
    for (uint32_t b = 0; b < f.bonds; b++) {
        const uint32_t one = f.id[f.bond[2 * b]], other = f.id[f.bond[2 * b + 1]];
        assert_true((one < other ? one : other) % 2 == 1 && (one < other ? other - one : one - other) == 1);
    }
    remove_folder(run.folder);
}

#ifdef CGT_HAVE_ARCHIVE
/* A file for each step, zipped: in the order of the steps, not of their names. */
TEST(series_of_steps)
{
    static const char *const wanted[] = {"c_ke"};
    static const dump_file d = {"step.*.lammpstrj.gz", 0, 2e-6, 1, 1, STEPS, 0};
    lammps_run run;
    char error[1024] = "";
    begin_run(&run, "lammps_run.in");
    const char *paths[3] = {path_of(&run, "step.10.lammpstrj.gz"), path_of(&run, "step.0.lammpstrj.gz"),
                            path_of(&run, "step.5.lammpstrj.gz")};
    cgt_trajectory_sort_series(paths, 3);
    cgt_trajectory_close(scratch_open_one);
    scratch_open_one = told_open_series(paths, 3, NULL, error, sizeof error);
    if (scratch_open_one == NULL)
        fail_msg("%s", error);
    assert_int_equal(told_want_columns(scratch_open_one, wanted, 1, error, sizeof error), 0);
    for (int i = 0; i < STEPS; i++) {
        const cgt_trajectory_frame f = scratch_read(scratch_open_one);
        expect_frame(&d, &run.step[i], &f);
    }
    scratch_expect_end(scratch_open_one);
    remove_folder(run.folder);
}
#endif

TEST(run_in_two_dimensions)
{
    static const dump_file files[] = {
        {"flat.lammpstrj", 0, 2e-6, 0, 0, STEPS, 1},
        {"flat.bin", 0, 2e-6, 1, 0, STEPS, 0},
        {"flat_atom.lammpstrj", 0, 6e-5, 0, 0, STEPS, 0},
        {"flat.data", 0, 2e-6, 1, 0, 1, 0},
    };
    lammps_run run;
    begin_run(&run, "lammps_flat.in");
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        expect_file(&run, &files[i]);
        cgt_trajectory_frame f = scratch_read(scratch_open(path_of(&run, files[i].name), NULL));
        for (uint32_t k = 0; k < f.count && i != 2; k++)
            assert_true(f.xyzr[4 * k + 3] == (f.id[k] <= 2 ? 0.25f : 0.625f));
    }
    remove_folder(run.folder);
}

int main(void)
{
    if (!has_lammps()) {
        fprintf(stderr, "no program lmp here: apt-get install lammps\n");
        return 77; /* ctest: skipped */
    }
    return SUITE_RUN(NULL, NULL);
}
