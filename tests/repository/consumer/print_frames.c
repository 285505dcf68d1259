/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * print_frames FILE [COLUMN]: a user's first program over the readers. Prints each frame of a run, and the first value
 * of a column. */
#include <inttypes.h>
#include <stdio.h>

#include <cgt/trajectory.h>

static void print_column(const cgt_trajectory_column *column, uint32_t count)
{
    if (column == NULL || count == 0)
        printf(", no column");
    else if (column->kind == CGT_TRAJECTORY_WORD)
        printf(", %s %s", column->name, column->word[(uint32_t)column->value[0] - 1]);
    else
        printf(", %s %g", column->name, (double)column->value[0]);
}

int main(int argc, char **argv)
{
    char error[512];
    const char *const name = argc > 2 ? argv[2] : NULL;
    if (argc < 2) {
        fprintf(stderr, "usage: print_frames FILE [COLUMN]\n");
        return 2;
    }
    cgt_trajectory *t;
    cgt_trajectory_frame frame;
    cgt_result result = cgt_trajectory_open(argv[1], NULL, &t);
    if (result == CGT_OK && name != NULL)
        result = cgt_trajectory_want_columns(t, &name, 1);
    while (result == CGT_OK && (result = cgt_trajectory_read(t, &frame)) == CGT_OK) {
        printf("frame %" PRIu64 ": step %" PRId64 ", %" PRIu32 " %s, %" PRIu32 " bonds, box %g", frame.number,
               frame.step, frame.count, frame.kind == CGT_TRAJECTORY_SPHERES ? "spheres" : "vertices", frame.bonds,
               frame.box_edge[0][0]);
        if (name != NULL)
            print_column(cgt_trajectory_find_column(&frame, name), frame.count);
        printf("\n");
    }
    for (const char *warning; (warning = cgt_trajectory_take_warning(t)) != NULL;)
        fprintf(stderr, "%s\n", warning);
    if (result != CGT_END) {
        cgt_trajectory_get_error_message(t, error, sizeof error);
        fprintf(stderr, "%s\n", error);
    }
    cgt_trajectory_close(t);
    return result != CGT_END;
}
