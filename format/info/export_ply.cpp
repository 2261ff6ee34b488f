// SPDX-License-Identifier: Apache-2.0
#include "format/info/export_ply.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <functional>
#include <vector>

#include "format/base/atomic_file.h"
#include "format/base/error.h"

namespace pointrt {

namespace {

static_assert(std::endian::native == std::endian::little, "values are written as they lie in memory");

constexpr std::size_t kSplatsAtOnce = 16384; // below 1 MiB of buffer

/// The types' words in a PLY header, which has none for 64-bit integers.
const char* plyType(std::uint32_t type) {
    constexpr const char* kWords[] = {"char", "uchar",  "short",  "ushort", "int",
                                      "uint", "double", "double", "float",  "double"};
    return kWords[type - PRO_TYPE_I8];
}

bool isWide(std::uint32_t type) { return type == PRO_TYPE_I64 || type == PRO_TYPE_U64; }

/// A name as one word: what programs write and read as properties has no blanks.
std::string propertyName(const pro_attribute& attribute, std::uint32_t component) {
    std::string name = attribute.name;
    std::replace(name.begin(), name.end(), ' ', '_');
    return attribute.components == 1 ? name : name + "_" + std::to_string(component);
}

std::string attributeLines(const ExportSource& source) {
    std::string text;
    for (const pro_attribute& each : source.attributes)
        for (std::uint32_t c = 0; c < each.components; ++c)
            text += std::string("property ") + plyType(each.type) + " " + propertyName(each, c) + "\n";
    return text;
}

std::string header(const ExportSource& source) {
    std::string text = "ply\nformat binary_little_endian 1.0\ncomment splats of a .pro file: oriented discs\n";
    text += "element vertex " + std::to_string(source.splats) + "\n";
    for (const char* name : {"x", "y", "z"}) text += std::string("property double ") + name + "\n";
    for (const char* name : {"nx", "ny", "nz", "radius"}) text += std::string("property float ") + name + "\n";
    if (source.info.flags & PRO_FLAG_COLOR)
        for (const char* name : {"red", "green", "blue"}) text += std::string("property uchar ") + name + "\n";
    return text + attributeLines(source) + "end_header\n";
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

void appendAttributes(std::vector<char>& buffer, const ProFile& file, std::size_t splat) {
    for (const pro_attribute& each : file.attributes()) {
        const std::size_t first = splat * each.components;
        if (isWide(each.type)) {
            for (std::uint32_t c = 0; c < each.components; ++c) append(buffer, pro_attribute_value(&each, first + c));
            continue;
        }
        const std::size_t size = pro_type_bytes(each.type);
        const auto* bytes = static_cast<const char*>(each.values) + first * size;
        buffer.insert(buffer.end(), bytes, bytes + each.components * size);
    }
}

/// Takes the next bytes; false where it cannot.
using Write = std::function<bool(const void* data, std::size_t bytes)>;

bool writeSplats(const Write& write, const ProFile& file, std::span<const std::uint32_t> splats) {
    std::vector<char> buffer;
    for (std::size_t first = 0; first < splats.size(); first += kSplatsAtOnce) {
        buffer.clear();
        const std::size_t end = std::min(first + kSplatsAtOnce, splats.size());
        for (std::size_t i = first; i < end; ++i) {
            appendSplat(buffer, file.info(), file.splat(splats[i]));
            appendAttributes(buffer, file, splats[i]);
        }
        if (!write(buffer.data(), buffer.size())) return false;
    }
    return true;
}

bool writeAll(const Write& write, const ExportSource& source) {
    const std::string text = header(source);
    return write(text.data(), text.size()) &&
           source.forEachPart([&](const ProFile& file, std::span<const std::uint32_t> splats) {
               return writeSplats(write, file, splats);
           });
}

void exportToStandardOutput(const ExportSource& source) {
    const auto write = [](const void* data, std::size_t bytes) { return std::fwrite(data, 1, bytes, stdout) == bytes; };
    if (!writeAll(write, source) || std::fflush(stdout) != 0)
        throw Error(ExitCode::kCannotWrite, std::string("standard output: ") + std::strerror(errno));
}

} // namespace

void exportPly(const ExportSource& source, const std::string& path, bool overwrite) {
    if (path == "-") return exportToStandardOutput(source);
    const auto existing = overwrite ? format::Existing::kReplaced : format::Existing::kKept;
    format::AtomicFile out;
    const auto write = [&](const void* data, std::size_t bytes) { return out.write(data, bytes); };
    if (!out.open(path, existing) || !writeAll(write, source) || !out.commit())
        throw Error(ExitCode::kCannotWrite,
                    path + ": " + out.error() + (out.nameIsTaken() ? "; --force overwrites it" : ""));
}

} // namespace pointrt
