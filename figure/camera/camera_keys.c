/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Key frames of the camera; see camera_keys.h. In double, as camera_path.c. */
#define _POSIX_C_SOURCE 200809L
#include "camera/camera_keys.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "options/numbers.h"

enum { MOST_KEYS = 65536, MOST_LINES = 1000000 };

/* ---- Reading ------------------------------------------------------------------------------------------------ */

static int parse_pace(const char *word, camera_pace *pace)
{
    static const char *const words[] = {"ease", "linear", "hold"};
    for (int i = 0; i < 3; i++)
        if (strcmp(word, words[i]) == 0) {
            *pace = (camera_pace)i;
            return 0;
        }
    return -1;
}

static int parse_key(char *line, camera_key *key, char *error, size_t size)
{
    char *rest = NULL;
    const char *frame = strtok_r(line, " \t\r\n", &rest), *camera = strtok_r(NULL, " \t\r\n", &rest);
    const char *pace = strtok_r(NULL, " \t\r\n", &rest), *more = pace ? strtok_r(NULL, " \t\r\n", &rest) : NULL;
    memset(key, 0, sizeof *key);
    cgt_camera_init(&key->camera);
    if (!camera || more) {
        snprintf(error, size, "a line has a frame, a camera and perhaps ease, linear or hold");
        return -1;
    }
    if (cgt_read_u64(frame, 0, UINT64_MAX - 1, &key->frame, error, size) ||
        cgt_read_far_camera(camera, &key->camera, key->eye, key->target, error, size))
        return -1;
    if (pace && parse_pace(pace, &key->pace)) {
        snprintf(error, size, "\"%s\" is not ease, linear or hold", pace);
        return -1;
    }
    return 0;
}

static int add_line(camera_keys *keys, char *line, char *error, size_t size)
{
    camera_key key;
    if (line[strspn(line, " \t\r\n")] == '\0' || line[strspn(line, " \t")] == '#')
        return 0;
    if (parse_key(line, &key, error, size))
        return -1;
    if (keys->count && key.frame <= keys->key[keys->count - 1].frame) {
        snprintf(error, size, "frame %" PRIu64 " is not behind the one before it", key.frame);
        return -1;
    }
    camera_key *more = keys->count < MOST_KEYS ? keys->key : NULL;
    if (keys->count < MOST_KEYS && (keys->count & (keys->count - 1)) == 0) /* doubles the room */
        more = realloc(keys->key, (keys->count ? 2 * keys->count : 1) * sizeof *more);
    if (!more) {
        snprintf(error, size, "out of memory, or more than %d keys", MOST_KEYS);
        return -1;
    }
    keys->key = more;
    keys->key[keys->count++] = key;
    return 0;
}

int cgt_camera_keys_read(camera_keys *keys, const char *path, char *error, size_t error_size)
{
    char line[1024], reason[512];
    unsigned number = 0;
    int failed = 0;
    memset(keys, 0, sizeof *keys);
    FILE *file = fopen(path, "r");
    if (!file) {
        snprintf(error, error_size, "%s: %s", path, strerror(errno));
        return -1;
    }
    while (!failed && fgets(line, sizeof line, file)) {
        number++;
        const int has_mark = number == 1 && strncmp(line, "\xEF\xBB\xBF", 3) == 0; /* of UTF-8 */
        failed = number > MOST_LINES;
        if (failed)
            snprintf(reason, sizeof reason, "there are more than %d lines", MOST_LINES);
        else
            failed = add_line(keys, has_mark ? line + 3 : line, reason, sizeof reason);
    }
    if (failed)
        snprintf(error, error_size, "%s:%u: %s", path, number, reason);
    else if (ferror(file) || keys->count == 0)
        snprintf(error, error_size, "%s: %s", path, ferror(file) ? "cannot read" : "there is no key in it");
    failed |= ferror(file) || keys->count == 0;
    fclose(file);
    if (failed)
        cgt_camera_keys_free(keys);
    return failed ? -1 : 0;
}

void cgt_camera_keys_free(camera_keys *keys)
{
    free(keys->key);
    memset(keys, 0, sizeof *keys);
}

int cgt_camera_key_move(camera_key *key, const double origin[3])
{
    for (int c = 0; c < 3; c++) {
        key->camera.eye[c] = (float)(key->eye[c] - origin[c]);
        key->camera.target[c] = (float)(key->target[c] - origin[c]);
    }
    return memcmp(key->camera.eye, key->camera.target, sizeof key->camera.eye) == 0 ? -1 : 0;
}

/* ---- Between two keys --------------------------------------------------------------------------------------- */

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* From the target to the eye: a unit vector. Returns its length. */
static double arm_of(const cgt_camera *camera, double arm[3])
{
    for (int c = 0; c < 3; c++)
        arm[c] = (double)camera->eye[c] - (double)camera->target[c];
    const double length = sqrt(dot(arm, arm));
    for (int c = 0; c < 3; c++)
        arm[c] /= length;
    return length;
}

/* On the arc between two unit vectors; where they are opposite, around the vector `up`: over it
 * the camera would look along it. */
static void slerp(const double a[3], const double b[3], const double up[3], double s, double out[3])
{
    const double cosine = fmin(1.0, fmax(-1.0, dot(a, b)));
    double side[3], length;
    for (int c = 0; c < 3; c++)
        side[c] = b[c] - cosine * a[c];
    length = sqrt(dot(side, side));
    if (length < 1e-9 && cosine < 0.0) {
        for (int c = 0; c < 3; c++)
            side[c] = up[(c + 1) % 3] * a[(c + 2) % 3] - up[(c + 2) % 3] * a[(c + 1) % 3];
        length = sqrt(dot(side, side));
    }
    const double angle = s * acos(cosine);
    for (int c = 0; c < 3; c++)
        out[c] = length > 0.0 ? cos(angle) * a[c] + sin(angle) * side[c] / length : a[c];
}

static void between(const cgt_camera *a, const cgt_camera *b, double s, cgt_camera *camera)
{
    double from[3], to[3], arm[3], up[3];
    const double near = arm_of(a, from), far = arm_of(b, to), distance = near * pow(far / near, s);
    for (int c = 0; c < 3; c++)
        up[c] = (1.0 - s) * (double)a->up[c] + s * (double)b->up[c];
    slerp(from, to, up, s, arm);
    *camera = *a;
    camera->fov = (float)((1.0 - s) * (double)a->fov + s * (double)b->fov);
    for (int c = 0; c < 3; c++) {
        const double target = (1.0 - s) * (double)a->target[c] + s * (double)b->target[c];
        camera->target[c] = (float)target;
        camera->eye[c] = (float)(target + distance * arm[c]);
        camera->up[c] = (float)up[c];
    }
}

void cgt_camera_keys_at(const camera_keys *keys, uint64_t frame, cgt_camera *camera)
{
    size_t k = 0;
    while (k + 1 < keys->count && keys->key[k + 1].frame <= frame)
        k++;
    const camera_key *key = &keys->key[k];
    if (frame <= key->frame || k + 1 == keys->count || key->pace == CAMERA_HOLD) {
        *camera = key->camera;
        return;
    }
    double s = (double)(frame - key->frame) / (double)(keys->key[k + 1].frame - key->frame);
    if (key->pace == CAMERA_EASE)
        s = s * s * (3.0 - 2.0 * s);
    between(&key->camera, &keys->key[k + 1].camera, s, camera);
}
