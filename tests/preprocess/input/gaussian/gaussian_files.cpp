// SPDX-License-Identifier: Apache-2.0
#include "tests/preprocess/input/gaussian/gaussian_files.h"

#include <zstd.h>

namespace pointrt::test {
namespace {

float logit(float share) { return std::log(share / (1 - share)); }

std::string bytesOfAll(const std::vector<float>& values) {
    std::string bytes;
    for (const float value : values) bytes += bytesOf(value);
    return bytes;
}

} // namespace

std::string plyHeader(std::size_t count, bool flat, std::size_t rest) {
    std::string text = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", count);
    for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "f_dc_0", "f_dc_1", "f_dc_2"})
        text += fmt::format("property float {}\n", name);
    for (std::size_t i = 0; i < rest; ++i) text += fmt::format("property float f_rest_{}\n", i);
    for (const char* name : {"opacity", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"})
        if (!flat || std::string(name) != "scale_2") text += fmt::format("property float {}\n", name);
    return text + "end_header\n";
}

std::string plyRow(const Blob& blob, bool flat) {
    std::string row = bytesOf(blob.centre) + bytesOf(std::array<float, 3>{}) + bytesOf(blob.color);
    row += bytesOfAll(blob.rest) + bytesOf(logit(blob.opacity));
    row += flat ? bytesOf(blob.log_deviations).substr(0, 8) : bytesOf(blob.log_deviations);
    return row + bytesOf(blob.rotation);
}

std::string gaussianPly(const std::vector<Blob>& blobs) {
    std::string text = plyHeader(blobs.size(), false, blobs.front().rest.size());
    for (const Blob& blob : blobs) text += plyRow(blob);
    return text;
}

std::string packedPly(std::uint32_t count, bool color_range, std::uint32_t rotation, const std::string& harmonics,
                      std::size_t rest) {
    const std::uint32_t chunks = (count + 255) / 256;
    std::string text = fmt::format("ply\nformat binary_little_endian 1.0\nelement chunk {}\n", chunks);
    for (const char* name : {"min_x", "min_y", "min_z", "max_x", "max_y", "max_z", "min_scale_x", "min_scale_y",
                             "min_scale_z", "max_scale_x", "max_scale_y", "max_scale_z"})
        text += fmt::format("property float {}\n", name);
    for (const char* name : {"min_r", "min_g", "min_b", "max_r", "max_g", "max_b"})
        if (color_range) text += fmt::format("property float {}\n", name);
    text += fmt::format("element vertex {}\n", count);
    for (const char* name : {"position", "rotation", "scale", "color"})
        text += fmt::format("property uint packed_{}\n", name);
    if (rest > 0) text += fmt::format("element sh {}\n", harmonics.size() / rest);
    for (std::size_t i = 0; i < rest; ++i) text += fmt::format("property uchar f_rest_{}\n", i);
    text += "end_header\n";
    for (std::uint32_t i = 0; i < chunks; ++i) {
        const float x = 100 * static_cast<float>(i);
        // x = 1.5 is 3 of 2047 steps of 0.5; y = -2 is 1 of 1023 steps of 1 above -3; z = 0.25 is the minimum, 0 steps
        for (const float value : {x, -3.f, 0.25f, x + 1023.5f, 1020.f, 100.f, -2.f, -3.f, -5.f, -2.f, -3.f, -5.f})
            text += bytesOf(value);
        for (const float value : {0.f, 0.f, 0.f, 1.f, 2.f, 1.f})
            if (color_range) text += bytesOf(value);
    }
    for (std::uint32_t i = 0; i < count; ++i)
        text += bytesOf(3u << 21 | 1u << 11) + bytesOf(rotation) + bytesOf(0x12345678u) + bytesOf(0x80ff00ccu);
    return text + harmonics;
}

std::string splatRow(const Blob& blob) {
    std::string row = bytesOf(blob.centre);
    for (const float logarithm : blob.log_deviations) row += bytesOf(std::exp(logarithm));
    row += std::string("\x80\xff\0", 3) + static_cast<char>(std::lround(255 * blob.opacity));
    for (const float part : blob.rotation) row += static_cast<char>(std::min(255l, std::lround(128 * part + 128)));
    return row;
}

std::string spzHeader(const Spz& spz) {
    return "NGSP" + bytesOf(spz.version) + bytesOf(spz.count) + bytesOf(spz.degree) + bytesOf(spz.fractional_bits) +
           '\0' + static_cast<char>(spz.version == 4 ? spz.streams : 0);
}

std::vector<std::string> spzArrays(std::uint32_t version, bool turned) {
    std::string position;
    if (version == 1)
        for (const int half : {0x3e00, 0xc000, 0x3400}) position += bytesOf(static_cast<std::uint16_t>(half));
    else
        for (const int fixed : {6144, -8192, 1024}) position += bytesOf(fixed).substr(0, 3);
    const std::string rotation = version < 3
                                     ? (turned ? std::string("\xda\x80\x80", 3) : std::string("\x80\x80\x80", 3))
                                     : bytesOf(3u << 30 | (turned ? 511u << 20 : 0u));
    return {position, "\xcc", std::string("\x80\xff\0", 3), std::string("\x80\x70\x50", 3), rotation};
}

std::string joined(const std::vector<std::string>& parts) {
    std::string all;
    for (const std::string& part : parts) all += part;
    return all;
}

std::string zstdPacked(const std::string& bytes) {
    std::string packed(ZSTD_compressBound(bytes.size()), '\0');
    packed.resize(ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 3));
    return packed;
}

std::string spz4(const std::vector<std::string>& arrays, Spz spz) {
    std::string table, streams;
    for (const std::string& array : arrays) {
        const std::string packed = zstdPacked(array);
        table += bytesOf<std::uint64_t>(packed.size()) + bytesOf<std::uint64_t>(array.size());
        streams += packed;
    }
    return spzHeader(spz) + bytesOf(32u) + std::string(12, '\0') + table + streams;
}

} // namespace pointrt::test
