// SPDX-License-Identifier: Apache-2.0
#include "runtime/image/image_png.h"

#include <png.h>

#include <csetjmp>
#include <exception>
#include <new>
#include <stdexcept>

#include "runtime/util/output_file.h"

namespace pointrt {
namespace {

using Bytes = std::vector<std::uint8_t>;

void appendBytes(png_structp png, png_bytep data, std::size_t count) {
    auto& bytes = *static_cast<Bytes*>(png_get_io_ptr(png));
    bool appended = true;
    // No exception may pass through libpng, and no jump may leave a handler.
    try {
        bytes.insert(bytes.end(), data, data + count);
    } catch (const std::exception&) {
        appended = false;
    }
    if (!appended) png_error(png, "out of memory");
}

void flushNothing(png_structp) {}
void ignoreMessage(png_structp, png_const_charp) {}
void jumpOut(png_structp png, png_const_charp) { png_longjmp(png, 1); }

void setHeader(png_structp png, png_infop info, const Image8& image) {
    const int color = image.channels == 4 ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB;
    png_set_IHDR(png, info, image.width, image.height, 8, color, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_RELATIVE);
    char keyword[] = "Software", writer[] = "pointrt-view " POINTRT_VERSION;
    png_text text{};
    text.compression = PNG_TEXT_COMPRESSION_NONE;
    text.key = keyword;
    text.text = writer;
    png_set_text(png, info, &text, 1);
}

/// False when libpng gave up. Nothing here needs a destructor: libpng jumps.
bool encode(png_structp png, png_infop info, const Image8& image, Bytes* bytes) {
    if (setjmp(png_jmpbuf(png))) return false;
    png_set_write_fn(png, bytes, appendBytes, flushNothing);
    setHeader(png, info, image);
    png_write_info(png, info);
    const std::size_t stride = std::size_t{image.width} * image.channels;
    for (std::uint32_t y = 0; y < image.height; ++y) png_write_row(png, image.pixels.data() + y * stride);
    png_write_end(png, info);
    return true;
}

} // namespace

void writePng(const std::string& path, const Image8& image) {
    if (image.pixels.size() != std::size_t{image.width} * image.height * image.channels)
        throw std::logic_error("writePng: pixel count does not fit the size");
    Bytes bytes;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, jumpOut, ignoreMessage);
    if (!png) throw std::bad_alloc();
    png_infop info = png_create_info_struct(png);
    const bool encoded = info && encode(png, info, image, &bytes);
    png_destroy_write_struct(&png, &info);
    // The arguments are valid, so that nothing else is left to fail.
    if (!encoded) throw std::bad_alloc();
    writeFile(path, bytes);
}

} // namespace pointrt
