// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/mesh/picture.h"

#include <csetjmp>
#include <cstdio> // jpeglib.h needs it
#include <jpeglib.h>
#include <png.h>
#include <webp/decode.h>

#include <algorithm>
#include <filesystem>

#include "preprocess/ingest/named_file.h"
#include "preprocess/ingest/text.h"

namespace pointrt {
namespace {

const std::uint8_t* unsignedBytes(const InputFile& file) {
    return reinterpret_cast<const std::uint8_t*>(file.bytes.data());
}

/// PNG packs flat colours to a thousandth. Above a free size, a file may have this many bytes of pixels for each of its
/// bytes.
constexpr std::uint64_t kFree = std::uint64_t{256} << 20, kPerByte = 192;

/// Prepares the picture's pixels.
void allocate(const InputFile& file, std::uint64_t width, std::uint64_t height, Picture& picture) {
    constexpr std::uint64_t kMostSide = 1 << 16;
    if (width == 0 || height == 0 || width > kMostSide || height > kMostSide ||
        width * height * 3 > kFree + kPerByte * file.bytes.size())
        refuse(file,
               fmt::format("has {} x {} pixels, too many for a file of {} bytes", width, height, file.bytes.size()));
    picture.width = static_cast<std::uint32_t>(width);
    picture.height = static_cast<std::uint32_t>(height);
    picture.rgb.resize(width * height * 3);
}

Picture readPng(const InputFile& file) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    Picture picture;
    if (png_image_begin_read_from_memory(&image, file.bytes.data(), file.bytes.size()) == 0)
        refuse(file, fmt::format("is not a readable PNG: {}", image.message));
    image.format = PNG_FORMAT_RGB;
    try {
        allocate(file, image.width, image.height, picture);
    } catch (...) {
        png_image_free(&image);
        throw;
    }
    const png_color black{};
    if (png_image_finish_read(&image, &black, picture.rgb.data(), 0, nullptr) == 0)
        refuse(file, fmt::format("is not a readable PNG: {}", image.message));
    return picture;
}

/// libjpeg leaves through longjmp, so no object between setjmp and there may need its destructor.
struct JpegReader {
    jpeg_decompress_struct jpeg{};
    jpeg_error_mgr errors{};
    std::jmp_buf failed{};

    static void fail(j_common_ptr jpeg) { std::longjmp(static_cast<JpegReader*>(jpeg->client_data)->failed, 1); }
    static void ignore(j_common_ptr) {}

    JpegReader() {
        jpeg.err = jpeg_std_error(&errors);
        errors.error_exit = fail;
        errors.output_message = ignore;
        jpeg.client_data = this;
    }
    ~JpegReader() { jpeg_destroy_decompress(&jpeg); }
    JpegReader(const JpegReader&) = delete;
    JpegReader& operator=(const JpegReader&) = delete;

    bool readHeader(const InputFile& file) {
        if (setjmp(failed) != 0) return false;
        jpeg_create_decompress(&jpeg);
        jpeg_mem_src(&jpeg, unsignedBytes(file), file.bytes.size());
        jpeg_read_header(&jpeg, TRUE);
        jpeg.out_color_space = JCS_RGB;
        return true;
    }

    bool readRows(std::uint8_t* rgb) {
        if (setjmp(failed) != 0) return false;
        jpeg_start_decompress(&jpeg);
        while (jpeg.output_scanline < jpeg.output_height) {
            JSAMPROW row = rgb + std::size_t{3} * jpeg.output_width * jpeg.output_scanline;
            jpeg_read_scanlines(&jpeg, &row, 1);
        }
        return errors.num_warnings == 0; // a warning means a premature end or a damaged block
    }
};

Picture readJpeg(const InputFile& file) {
    JpegReader reader;
    Picture picture;
    if (!reader.readHeader(file)) refuse(file, "is not a readable JPEG");
    allocate(file, reader.jpeg.image_width, reader.jpeg.image_height, picture);
    if (!reader.readRows(picture.rgb.data())) refuse(file, "is a JPEG that is damaged or cut short");
    return picture;
}

Picture readWebp(const InputFile& file) {
    int width = 0, height = 0;
    Picture picture;
    if (WebPGetInfo(unsignedBytes(file), file.bytes.size(), &width, &height) == 0)
        refuse(file, "is not a readable WebP picture");
    allocate(file, static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height), picture);
    if (!WebPDecodeRGBInto(unsignedBytes(file), file.bytes.size(), picture.rgb.data(), picture.rgb.size(), 3 * width))
        refuse(file, "is a WebP picture that is damaged or cut short");
    return picture;
}

/// Reads a file only once, whatever names it has, and limits all files together to the limit of one.
std::uint32_t takePicture(const InputFile& file, const std::string& key, MeshPaint& paint) {
    if (const auto known = paint.picture_of_file.find(key); known != paint.picture_of_file.end()) return known->second;
    Picture picture = readPicture(file);
    std::uint64_t bytes = picture.rgb.size();
    for (const Picture& each : paint.pictures) bytes += each.rgb.size();
    paint.picture_file_bytes += file.bytes.size();
    if (bytes > kFree + kPerByte * paint.picture_file_bytes)
        refuse(file,
               fmt::format("has too many pixels, together with the {} textures before it", paint.pictures.size()));
    paint.pictures.push_back(std::move(picture));
    const auto index = static_cast<std::uint32_t>(paint.pictures.size() - 1);
    paint.picture_of_file.emplace(key, index);
    return index;
}

} // namespace

void noteUnreadTexture(const InputFile& input, const Error& error, Sink& sink) {
    sink.note(input, fmt::format("its faces lack the colours of a texture: {}", error.what()));
}

Picture readPicture(const InputFile& file) {
    if (file.bytes.starts_with("\x89PNG")) return readPng(file);
    if (file.bytes.starts_with("\xff\xd8\xff")) return readJpeg(file);
    if (file.bytes.starts_with("RIFF")) return readWebp(file);
    refuse(file, "is not a PNG, JPEG or WebP picture");
}

std::optional<InputFile> openBeside(const InputFile& input, std::string name) {
    namespace fs = std::filesystem;
    std::replace(name.begin(), name.end(), '\\', '/');
    const fs::path folder = fs::path(input.name).parent_path();
    std::error_code failure;
    for (const std::string& each : {name, fs::path(name).filename().string()}) {
        const auto path = pathInFolder(folder, each);
        if (path && fs::is_regular_file(*path, failure)) return openInputFile(path->string(), NamedBy::kFile);
    }
    const std::string wanted = lowerCase(fs::path(name).filename().string());
    for (const std::string& path : filesOfFolder(folder))
        if (lowerCase(fs::path(path).filename().string()) == wanted) return openInputFile(path, NamedBy::kFile);
    return std::nullopt;
}

std::optional<std::uint32_t> addTexture(const InputFile& input, const std::string& name, Sink& sink) {
    try {
        const auto file = openBeside(input, name);
        if (!file) {
            sink.note(input, fmt::format("names the texture {}, which is not in its folder: its faces lack those "
                                         "colours",
                                         inQuotes(name)));
            return std::nullopt;
        }
        std::error_code failure;
        return addPicture(input, *file, std::filesystem::canonical(file->name, failure).string(), sink);
    } catch (const Error& error) {
        noteUnreadTexture(input, error, sink);
        return std::nullopt;
    }
}

std::optional<std::uint32_t> addPicture(const InputFile& input, const InputFile& picture, const std::string& key,
                                        Sink& sink) {
    try {
        return takePicture(picture, key, sink.paint);
    } catch (const Error& error) {
        noteUnreadTexture(input, error, sink);
        return std::nullopt;
    }
}

} // namespace pointrt
