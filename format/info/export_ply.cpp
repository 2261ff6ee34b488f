// SPDX-License-Identifier: Apache-2.0
#include "format/info/export_ply.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <numeric>
#include <vector>

#include "format/base/atomic_file.h"
#include "format/base/error.h"

namespace pointrt {

namespace {

static_assert(std::endian::native == std::endian::little, "values are written as they lie in memory");

constexpr std::size_t kSplatsAtOnce = 16384; // below 1 MiB of buffer

std::string header(const pro_info& info) {
    std::string text = "ply\nformat binary_little_endian 1.0\ncomment splats of a .pro file: oriented discs\n";
    text += "element vertex " + std::to_string(info.splat_count) + "\n";
    for (const char* name : {"x", "y", "z"}) text += std::string("property double ") + name + "\n";
    for (const char* name : {"nx", "ny", "nz", "radius"}) text += std::string("property float ") + name + "\n";
    if (info.flags & PRO_FLAG_COLOR)
        for (const char* name : {"red", "green", "blue"}) text += std::string("property uchar ") + name + "\n";
    return text + "end_header\n";
}

/// Splat numbers in the order of their input points.
std::vector<std::uint32_t> inputOrder(const ProFile& file) {
    std::vector<std::uint32_t> splats(file.info().splat_count);
    std::iota(splats.begin(), splats.end(), 0u);
    const auto order = file.order();
    if (!order.empty())
        std::sort(splats.begin(), splats.end(),
                  [&](std::uint32_t a, std::uint32_t b) { return order[a] != order[b] ? order[a] < order[b] : a < b; });
    return splats;
}

template <typename T>
void append(std::vector<char>& buffer, const T& value) {
    const char* bytes = reinterpret_cast<const char*>(&value);
    buffer.insert(buffer.end(), bytes, bytes + sizeof value);
}

void appendSplat(std::vector<char>& buffer, const pro_info& info, const pro_splat& splat) {
    for (int axis = 0; axis < 3; ++axis) append(buffer, info.origin[axis] + info.scale * splat.position[axis]);
    for (const float component : splat.normal) append(buffer, component);
    append(buffer, static_cast<float>(splat.radius * info.scale));
    if (info.flags & PRO_FLAG_COLOR) buffer.insert(buffer.end(), splat.color, splat.color + 3);
}

bool writeSplats(format::AtomicFile& out, const ProFile& file) {
    const std::vector<std::uint32_t> splats = inputOrder(file);
    std::vector<char> buffer;
    for (std::size_t first = 0; first < splats.size(); first += kSplatsAtOnce) {
        buffer.clear();
        const std::size_t end = std::min(first + kSplatsAtOnce, splats.size());
        for (std::size_t i = first; i < end; ++i) appendSplat(buffer, file.info(), file.splat(splats[i]));
        if (!out.write(buffer.data(), buffer.size())) return false;
    }
    return true;
}

} // namespace

void exportPly(const ProFile& file, const std::string& path, bool overwrite) {
    const auto existing = overwrite ? format::Existing::kReplaced : format::Existing::kKept;
    format::AtomicFile out;
    const std::string text = header(file.info());
    if (!out.open(path, existing) || !out.write(text.data(), text.size()) || !writeSplats(out, file) || !out.commit())
        throw Error(ExitCode::kCannotWrite,
                    path + ": " + out.error() + (out.nameIsTaken() ? "; --force overwrites it" : ""));
}

} // namespace pointrt
