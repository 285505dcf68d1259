/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The module cgt-image; see image_module.h. OpenImageIO encodes into memory, because some of its writers do not notice
 * a full disk. No exception leaves this file. */
#include "picture/files/image_module.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

namespace
{

void set_error(char *error, size_t size, const std::string &text)
{
    if (error && size)
        std::snprintf(error, size, "%s", text.c_str());
}

OIIO::ImageSpec make_exr_spec(const image_content &image)
{
    const int channels = image.alpha ? 6 : 5;
    OIIO::ImageSpec spec(static_cast<int>(image.width), static_cast<int>(image.height), channels,
                         OIIO::TypeDesc::FLOAT);
    spec.channelnames = {"R", "G", "B", "Z", "id"};
    spec.channelformats = {OIIO::TypeDesc::FLOAT, OIIO::TypeDesc::FLOAT, OIIO::TypeDesc::FLOAT, OIIO::TypeDesc::FLOAT,
                           OIIO::TypeDesc::UINT32};
    spec.z_channel = 3;
    if (image.alpha) {
        spec.channelnames.push_back("A");
        spec.channelformats.push_back(OIIO::TypeDesc::FLOAT);
        spec.alpha_channel = 5;
    }
    spec.attribute("oiio:ColorSpace", "Linear");
    spec.attribute("compression", "zip");
    return spec;
}

OIIO::ImageSpec make_rgb_spec(image_format format, const image_content &image)
{
    OIIO::ImageSpec spec(static_cast<int>(image.width), static_cast<int>(image.height), 3, OIIO::TypeDesc::UINT8);
    if (format == IMAGE_JPEG) {
        spec.attribute("oiio:ColorSpace", "sRGB");
        spec.attribute("Compression", "jpeg:" + std::to_string(image.quality ? image.quality : 92));
    } else { /* a colour space makes a directory of Exif data, which OpenImageIO 2.4 writes in place of the picture's */
        spec.attribute("compression", "zip");
    }
    return spec;
}

void add_texts(image_format format, const image_content &image, OIIO::ImageSpec &spec)
{
    for (size_t i = 0; i < image.text_count; i++) {
        const std::string key = image.texts[i].key;
        if (format == IMAGE_EXR || key == "Software")
            spec.attribute(key, image.texts[i].value);
        else if (key == "Settings")
            spec.attribute("ImageDescription", image.texts[i].value);
    }
}

/* Pixels as the file has them, without an opacity where it has none: OpenImageIO takes no gaps between pixels whose
 * channels differ in format. So many rows at a time. */
bool write_linear(OIIO::ImageOutput &output, const OIIO::ImageSpec &spec, const image_content &image)
{
    const uint32_t rows = 64; /* the blocks that are compressed have 16 */
    const size_t size = static_cast<size_t>(spec.nchannels) * 4;
    static_assert(sizeof(cgt_linear_pixel) == 24 && offsetof(cgt_linear_pixel, a) == 20,
                  "the channels of a pixel, in their order");
    std::vector<unsigned char> packed(size * image.width * rows);
    for (uint32_t y = 0; y < image.height; y += rows) {
        const uint32_t end = std::min(y + rows, image.height);
        const cgt_linear_pixel *from = image.pixels + static_cast<size_t>(y) * image.width;
        unsigned char *to = packed.data();
        for (size_t i = static_cast<size_t>(end - y) * image.width; i > 0; i--, from++, to += size)
            std::memcpy(to, from, size);
        /* UNKNOWN: the memory holds each channel in the format that the file gets. */
        if (!output.write_scanlines(static_cast<int>(y), static_cast<int>(end), 0, OIIO::TypeDesc::UNKNOWN,
                                    packed.data()))
            return false;
    }
    return true;
}

void encode(image_format format, const image_content &image, std::vector<unsigned char> &bytes)
{
    const char *const name = format == IMAGE_EXR ? "openexr" : format == IMAGE_JPEG ? "jpeg" : "tiff";
    std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(name);
    if (!output || !output->supports("ioproxy"))
        throw std::runtime_error(std::string("this OpenImageIO cannot encode in memory as ") + name);
    OIIO::Filesystem::IOVecOutput sink(bytes);
    output->set_ioproxy(&sink);
    OIIO::ImageSpec spec = format == IMAGE_EXR ? make_exr_spec(image) : make_rgb_spec(format, image);
    add_texts(format, image, spec);
    const bool whole = output->open(name, spec) &&
                       (format == IMAGE_EXR ? write_linear(*output, spec, image)
                                            : output->write_image(OIIO::TypeDesc::UINT8, image.rgb)) &&
                       output->close();
    if (!whole)
        throw std::runtime_error(output->geterror());
}

} // namespace

extern "C" int cgt_image_encode(image_format format, const image_content *image, unsigned char **bytes, size_t *size,
                                char *error, size_t error_size)
{
    try {
        std::vector<unsigned char> encoded;
        encode(format, *image, encoded);
        *bytes = static_cast<unsigned char *>(std::malloc(encoded.size() + 1));
        *size = encoded.size();
        if (*bytes) {
            std::memcpy(*bytes, encoded.data(), encoded.size());
            return 0;
        }
        set_error(error, error_size, "out of memory");
    } catch (const std::exception &failure) {
        set_error(error, error_size, failure.what());
    } catch (...) {
        set_error(error, error_size, "OpenImageIO failed");
    }
    return -1;
}
