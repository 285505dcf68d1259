/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Key frames of the camera, from a text file of lines
 *     FRAME CAMERA [ease|linear|hold]
 * FRAME is a number of the input, CAMERA as of -c; the word says how the camera goes on to the next key: slowly at both
 * ends (default), evenly, or not before the next key. Lines that are empty or begin with # are left out. Between two
 * keys the eye goes around the target, on an arc whose radius changes by equal ratios; to the opposite side around what
 * points up. */
#ifndef CAMERA_KEYS_H
#define CAMERA_KEYS_H

#include <stddef.h>
#include <stdint.h>

#include <cgt/cgt.h>

typedef enum camera_pace { CAMERA_EASE = 0, CAMERA_LINEAR, CAMERA_HOLD } camera_pace;

typedef struct camera_key {
    uint64_t frame;
    cgt_camera camera;
    double eye[3], target[3]; /* of the camera, as the file has them */
    camera_pace pace;
} camera_key;

typedef struct camera_keys {
    camera_key *key; /* frames rise strictly */
    size_t count;    /* 0: no keys */
} camera_keys;

/* Reads a file: one key at least. Returns 0, or -1 with a sentence that names file and line. */
int cgt_camera_keys_read(camera_keys *keys, const char *path, char *error, size_t error_size);
void cgt_camera_keys_free(camera_keys *keys);

/* Subtracts an origin from eye and target. Returns 0, or -1 where they are then the same in single precision. */
int cgt_camera_key_move(camera_key *key, const double origin[3]);

/* The camera at a frame: exactly a key's at its frame, the first one's before it, the last one's behind it. */
void cgt_camera_keys_at(const camera_keys *keys, uint64_t frame, cgt_camera *camera);

#endif
