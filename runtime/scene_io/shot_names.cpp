// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_io/shot_names.h"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

#include "format/base/error.h"
#include "format/base/printable.h"
#include "runtime/util/words.h"

namespace pointrt {
namespace {

using Parts = std::vector<std::string>;

constexpr std::array kSuffixes = {".png", ".jpg", ".jpeg", ".exr", ".tif", ".tiff", ".bmp", ".webp", ".hdr"};
/// The file system's limit for names, minus the length of our suffixes and those of temporary files.
constexpr std::size_t kMaxBytes = 200;

std::string withoutSuffix(const std::string& name) {
    const std::size_t dot = name.rfind('.');
    if (dot == std::string::npos || dot == 0) return name;
    const std::string suffix = lowerCase(name.substr(dot));
    return std::find(kSuffixes.begin(), kSuffixes.end(), suffix) == kSuffixes.end() ? name : name.substr(0, dot);
}

/// The folders and the name of a picture, without ".", ".." and empty ones.
Parts partsOf(const CameraShot& shot) {
    Parts parts;
    std::string part;
    for (const char c : shot.name + "/") {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            throw Error{ExitCode::kBadInput,
                        shot.place + "the name " + printable(shot.name) + " has control characters"};
        if (c != '/' && c != '\\') {
            part += c;
            continue;
        }
        if (!part.empty() && part != "." && part != "..") parts.push_back(part);
        part.clear();
    }
    if (!parts.empty()) parts.back() = withoutSuffix(parts.back());
    const bool is_long =
        std::any_of(parts.begin(), parts.end(), [](const auto& each) { return each.size() > kMaxBytes; });
    if (parts.empty() || is_long)
        throw Error{ExitCode::kBadInput, shot.place + "the name " + printable(shot.name) + " is not a valid file name"};
    return parts;
}

std::size_t commonFolders(const std::vector<Parts>& names) {
    std::size_t common = names.front().size() - 1;
    for (const Parts& name : names) {
        common = std::min(common, name.size() - 1);
        for (std::size_t i = 0; i < common; ++i)
            if (name[i] != names.front()[i]) common = i;
    }
    return common;
}

std::string joined(const Parts& parts, std::size_t first) {
    std::string path;
    for (std::size_t i = first; i < parts.size(); ++i) path += (i > first ? "/" : "") + parts[i];
    return path;
}

} // namespace

std::vector<std::string> shotNames(const std::vector<CameraShot>& shots) {
    std::vector<Parts> all;
    for (const CameraShot& shot : shots) all.push_back(partsOf(shot));
    const std::size_t common = all.empty() ? 0 : commonFolders(all);
    std::vector<std::string> names;
    std::map<std::string, std::size_t> taken;
    for (std::size_t i = 0; i < shots.size(); ++i) {
        names.push_back(joined(all[i], common));
        const auto [other, is_new] = taken.emplace(names.back(), i);
        if (!is_new)
            throw Error{ExitCode::kBadInput, shots[i].place + "the picture " + printable(shots[i].name) +
                                                 " would have the same name as " +
                                                 printable(shots[other->second].name)};
    }
    return names;
}

} // namespace pointrt
