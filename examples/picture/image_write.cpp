/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Writes pictures to files; see image_write.h. OpenImageIO encodes into memory, because its PNG writer does not notice
 * a full disk; the bytes then go to the file by calls whose results are all checked. No exception leaves
 * this file. */
#include "picture/image_write.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "common/out_file.h"

namespace
{

void set_error(char *error, size_t size, const char *path, const char *problem, const char *reason)
{
    if (error && size)
        std::snprintf(error, size, "%s: %s%s%s", path, problem, *reason ? ": " : "", reason);
}

/* Writes all bytes to a file; on a failure *reason tells the cause. */
bool write_bytes(const char *path, const std::vector<unsigned char> &bytes, std::string *reason)
{
    std::FILE *file = std::fopen(path, "wb");
    if (!file) {
        *reason = std::strerror(errno);
        return false;
    }
    errno = 0;
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
    const int write_errno = errno;
    const bool closed = std::fclose(file) == 0;
    if (written && closed)
        return true;
    *reason = std::strerror(written ? errno : write_errno);
    return false;
}

/* Makes the bytes the file's: all of them, or the file stays as it was. Returns 0 or -1 with a text. */
int replace_file(const char *path, const std::vector<unsigned char> &bytes, char *error, size_t error_size)
{
    out_file file;
    const char *temporary = out_file_begin(&file, path, error, error_size);
    if (!temporary)
        return -1;
    std::string reason;
    const bool written = write_bytes(temporary, bytes, &reason);
    if (!written)
        set_error(error, error_size, path, "cannot write", reason.c_str());
    return out_file_end(&file, written, error, error_size) || !written ? -1 : 0;
}

int encode_and_write(const char *path, const char *format, const OIIO::ImageSpec &spec, const void *pixels,
                     OIIO::TypeDesc type, char *error, size_t error_size)
{
    std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
    if (!output || !output->supports("ioproxy")) {
        set_error(error, error_size, path, "this OpenImageIO cannot encode the format in memory", format);
        return -1;
    }
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput sink(bytes);
    output->set_ioproxy(&sink);
    if (!output->open(path, spec) || !output->write_image(type, pixels) || !output->close()) {
        const std::string reason = output->geterror();
        set_error(error, error_size, path, "cannot encode the picture", reason.c_str());
        return -1;
    }
    return replace_file(path, bytes, error, error_size);
}

/* C callers cannot catch exceptions, and memory may run out anywhere inside. */
int encode_and_write_nothrow(const char *path, const char *format, const OIIO::ImageSpec &spec, const void *pixels,
                             OIIO::TypeDesc type, char *error, size_t error_size) noexcept
{
    try {
        return encode_and_write(path, format, spec, pixels, type, error, error_size);
    } catch (const std::exception &failure) {
        set_error(error, error_size, path, "cannot write the picture", failure.what());
    } catch (...) {
        set_error(error, error_size, path, "cannot write the picture", "");
    }
    return -1;
}

} // namespace

extern "C" int image_write_png(const char *path, const uint8_t *rgb, uint32_t width, uint32_t height, char *error,
                               size_t error_size)
{
    try {
        OIIO::ImageSpec spec(static_cast<int>(width), static_cast<int>(height), 3, OIIO::TypeDesc::UINT8);
        spec.attribute("oiio:ColorSpace", "sRGB");
        /* Level 2 and one filter (32: the pixel above) instead of level 6 and a trial of all five for each row: a third
         * of the time, for files that are a tenth larger. */
        spec.attribute("png:compressionLevel", 2);
        spec.attribute("png:filter", 32);
        return encode_and_write_nothrow(path, "png", spec, rgb, OIIO::TypeDesc::UINT8, error, error_size);
    } catch (...) {
        set_error(error, error_size, path, "cannot write the picture", "out of memory");
        return -1;
    }
}

extern "C" int image_write_exr(const char *path, const image_pixel *pixels, uint32_t width, uint32_t height,
                               char *error, size_t error_size)
{
    try {
        OIIO::ImageSpec spec(static_cast<int>(width), static_cast<int>(height), 5, OIIO::TypeDesc::FLOAT);
        spec.channelnames = {"R", "G", "B", "Z", "id"};
        spec.channelformats = {OIIO::TypeDesc::FLOAT, OIIO::TypeDesc::FLOAT, OIIO::TypeDesc::FLOAT,
                               OIIO::TypeDesc::FLOAT, OIIO::TypeDesc::UINT32};
        spec.z_channel = 3;
        spec.attribute("oiio:ColorSpace", "Linear");
        spec.attribute("compression", "zip");
        /* UNKNOWN: the memory holds each channel in the format that the file gets. */
        return encode_and_write_nothrow(path, "openexr", spec, pixels, OIIO::TypeDesc::UNKNOWN, error, error_size);
    } catch (...) {
        set_error(error, error_size, path, "cannot write the picture", "out of memory");
        return -1;
    }
}
