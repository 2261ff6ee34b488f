// SPDX-License-Identifier: Apache-2.0
#include "runtime/image/exr_read.h"

// Compiles tinyexr's implementation from its header, so that the viewer needs no libtinyexr.so at run time.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <zlib.h>
#define TINYEXR_IMPLEMENTATION
#include <tinyexr.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <vector>

#include "format/base/error.h"
#include "runtime/image/exr_structure.h"
#include "runtime/image/picture_room.h"
#include "runtime/util/input_file.h"

namespace pointrt {
namespace {

// tinyexr's PIZ decoder reads a bitmap (8 KiB), a code table (at most 48 KiB: 65537 codes of 6 bits) and some words
// without checking for the end of the file.
constexpr std::size_t kReadAheadBytes = 64 * 1024;

/// Owns tinyexr's objects.
struct Decoded {
    EXRHeader header;
    EXRImage image;
    Decoded() {
        InitEXRHeader(&header);
        InitEXRImage(&image);
    }
    Decoded(const Decoded&) = delete;
    Decoded& operator=(const Decoded&) = delete;
    ~Decoded() {
        FreeEXRImage(&image);
        FreeEXRHeader(&header);
    }
};

void require(const std::string& path, int result, const char* message) {
    if (result == TINYEXR_SUCCESS) return;
    std::string reason = message ? message : "it cannot be decoded";
    FreeEXRErrorMessage(message);
    reason.erase(reason.find_last_not_of(".\n") + 1);
    std::replace(reason.begin(), reason.end(), '\n', ' '); // several reasons come one per line
    throw Error{ExitCode::kBadInput, path + ": bad OpenEXR file: " + reason};
}

std::size_t valuesOf(const ExrStructure& structure) {
    return std::size_t{structure.width} * structure.height * structure.channels.size();
}

void requireProportion(const std::string& path, const ExrStructure& structure, std::size_t file_bytes) {
    if (valuesOf(structure) * sizeof(float) <= pictureRoom(file_bytes)) return;
    throw Error{ExitCode::kBadInput,
                path + ": bad OpenEXR file: " + pictureRoomReason(structure.width, structure.height, file_bytes)};
}

/// Throws std::bad_alloc if there is not enough memory: tinyexr does not check the result of malloc.
void requireRoom(const ExrStructure& structure) { std::make_unique_for_overwrite<float[]>(valuesOf(structure)); }

void decode(const std::string& path, std::span<const std::uint8_t> file, Decoded& decoded) {
    EXRVersion version;
    const char* message = nullptr;
    require(path, ParseEXRVersionFromMemory(&version, file.data(), file.size()), nullptr);
    int result = ParseEXRHeaderFromMemory(&decoded.header, &version, file.data(), file.size(), &message);
    require(path, result, message);
    // blocks store their line numbers; tinyexr would flip pictures that were written from the bottom up
    decoded.header.line_order = 0;
    for (int c = 0; c < decoded.header.num_channels; ++c)
        if (decoded.header.pixel_types[c] == TINYEXR_PIXELTYPE_HALF)
            decoded.header.requested_pixel_types[c] = TINYEXR_PIXELTYPE_FLOAT;
    decoded.image.num_channels = decoded.header.num_channels; // so that all planes are freed on failure
    result = LoadEXRImageFromMemory(&decoded.image, &decoded.header, file.data(), file.size(), &message);
    // already freed, but header and image still point to it
    if (result != TINYEXR_SUCCESS) InitEXRImage(&decoded.image);
    require(path, result, message);
}

} // namespace

ExrPicture readExr(const std::string& path, ExrKind kind) {
    const std::vector<std::uint8_t> bytes = readFileBytes(path, kReadAheadBytes);
    const std::span file(bytes.data(), bytes.size() - kReadAheadBytes);
    ExrStructure structure = checkExr(path, file);
    if (kind == ExrKind::kPicture) requireProportion(path, structure, file.size());
    requireRoom(structure);
    const auto decoded = std::make_shared<Decoded>();
    decode(path, file, *decoded);
    ExrPicture picture{structure.width, structure.height, {}, {}, std::move(structure.texts), decoded};
    const std::size_t pixels = std::size_t{picture.width} * picture.height;
    for (int c = 0; c < decoded->header.num_channels; ++c) {
        const unsigned char* plane = decoded->image.images[c];
        const std::string name = decoded->header.channels[c].name;
        if (structure.channels.at(name) == ExrPixel::kUint)
            picture.words[name] = {reinterpret_cast<const std::uint32_t*>(plane), pixels};
        else
            picture.floats[name] = {reinterpret_cast<const float*>(plane), pixels};
    }
    return picture;
}

} // namespace pointrt
