/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * In place of ffmpeg: standard input goes to the file that the last argument names, "file:NAME". */
#include <stdio.h>
#include <string.h>

#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#endif

int main(int argc, char **argv)
{
    const char *const name = argv[argc - 1];
    char bytes[4096];
    size_t count;
#ifdef _WIN32
    _setmode(_fileno(stdin), _O_BINARY);
#endif
    FILE *const to = argc > 1 && strncmp(name, "file:", 5) == 0 ? fopen(name + 5, "wb") : NULL;
    if (!to)
        return 1;
    while ((count = fread(bytes, 1, sizeof bytes, stdin)) > 0)
        fwrite(bytes, 1, count, to);
    fprintf(stderr, "a word from %d arguments\n", argc);
    return fclose(to) != 0;
}
