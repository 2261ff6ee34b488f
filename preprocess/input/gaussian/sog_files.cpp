// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/gaussian/sog_files.h"

#include <algorithm>
#include <filesystem>

#include "format/os/separators.h"
#include "preprocess/ingest/named_file.h"
#include "preprocess/ingest/text.h"

namespace pointrt {
namespace {

/// Captures take 15 to 25 bytes for each Gaussian.
constexpr std::uint64_t kGaussiansAtLeast = 1 << 20, kBytesPerGaussian = 4;

bool isObjectWith(std::string_view text, std::initializer_list<std::string_view> keys) {
    const std::size_t start = text.find_first_not_of(" \t\r\n");
    if (start == std::string_view::npos || text[start] != '{') return false;
    return std::all_of(keys.begin(), keys.end(),
                       [&](std::string_view key) { return text.find(key) != std::string_view::npos; });
}

bool isNamed(std::string_view path, std::string_view name) {
    return path == name || (path.size() > name.size() && path.ends_with(name) &&
                            isFolderSeparator(path[path.size() - name.size() - 1]));
}

} // namespace

bool isSogMeta(std::string_view text) {
    return isObjectWith(text, {"\"means\"", "\"scales\"", "\"quats\"", "\"sh0\""});
}

bool isSogLevels(std::string_view text) { return isObjectWith(text, {"\"lodLevels\"", "\"filenames\"", "\"tree\""}); }

bool isSogArchive(std::string_view bytes) {
    if (!isZip(bytes)) return false;
    const auto members = zipMembers(bytes);
    if (!members) return firstZipMember(bytes).ends_with(".webp") || isNamed(firstZipMember(bytes), kSogMeta);
    return std::any_of(members->begin(), members->end(), [](const ZipMember& member) {
        return isNamed(member.name, kSogMeta) || isNamed(member.name, kSogLevels);
    });
}

SogFiles::SogFiles(const InputFile& input) : input_(input) {
    if (!isZip(input.bytes)) {
        meta_ = input;
        return;
    }
    auto members = zipMembers(input.bytes);
    if (!members) refuse(input, "the zip archive is truncated: its directory is not at its end");
    members_ = std::move(*members);
    const ZipMember* const member = metaMember();
    if (!member) refuse(input, fmt::format("the zip archive holds no {}", kSogMeta));
    base_ = folderOf(std::string(member->name));
    meta_ = openZipMember(input, *member);
}

/// The meta.json in the outermost folder.
const ZipMember* SogFiles::metaMember() const {
    for (const std::string_view name : {kSogLevels, kSogMeta}) {
        const ZipMember* found = nullptr;
        for (const ZipMember& member : members_)
            if (isNamed(member.name, name) && (!found || member.name.size() < found->name.size())) found = &member;
        if (found) return found;
    }
    return nullptr;
}

const ZipMember* SogFiles::memberNamed(std::string_view name) const {
    const auto found =
        std::find_if(members_.begin(), members_.end(), [&](const ZipMember& member) { return member.name == name; });
    return found == members_.end() ? nullptr : &*found;
}

InputFile SogFiles::open(const std::string& named_in, const std::string& name) const {
    namespace fs = std::filesystem;
    if (name.empty() || hasControls(name) || fs::path(name).lexically_normal() != name)
        refuse(meta_, inQuotes(name) + " is not a plain file name");
    if (!members_.empty()) {
        const ZipMember* const member = memberNamed(base_ + named_in + name);
        if (!member) refuse(meta_, fmt::format("the zip archive has no {}", inQuotes(base_ + named_in + name)));
        return openZipMember(input_, *member);
    }
    const auto path = pathInFolder(fs::path(input_.name).parent_path(), named_in + name);
    if (!path) refuse(meta_, fmt::format("{} lies outside its folder, which must hold its files", inQuotes(name)));
    InputFile file = openInputFile(path->string(), NamedBy::kFile);
    opened_[named_in + name] = file.bytes.size();
    return file;
}

void SogFiles::checkPromise(std::uint64_t gaussians) const {
    std::uint64_t bytes = input_.bytes.size();
    for (const auto& [name, size] : opened_) bytes += size;
    if (gaussians > kGaussiansAtLeast + bytes / kBytesPerGaussian)
        refuse(meta_, fmt::format("promises {} Gaussians in {} bytes", gaussians, bytes));
}

std::string SogFiles::folderOf(const std::string& name) {
    const std::size_t slash = name.find_last_of(kFolderSeparators);
    return slash == std::string::npos ? "" : name.substr(0, slash + 1);
}

} // namespace pointrt
