// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/autosave.h"

#include <array>
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "format/os/user_folder.h"
#include "runtime/scene_io/scene_write.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxPrograms = 10;

/// FNV-1a: names of files need no better hash, and it must not change between versions.
std::uint64_t hashOf(std::string_view text) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    return hash;
}

std::string fileName(const std::string& scene, int number) {
    std::error_code ignored;
    const std::string path = fs::weakly_canonical(scene, ignored).string();
    std::array<char, 40> name{};
    std::snprintf(name.data(), name.size(), "/%016" PRIx64 "-%d.toml", hashOf(path), number);
    return name.data();
}

} // namespace

Autosave::Autosave(const std::string& folder, const std::string& scene) {
    if (folder.empty() || !makePrivateFolder(folder)) return;
    for (int number = 0; number < kMaxPrograms; ++number)
        if (take(folder + fileName(scene, number))) break;
    std::error_code ignored;
    if (fs::is_regular_file(path_, ignored)) left_ = path_;
}

bool Autosave::take(const std::string& path) {
    if (!lock_.openFile(path + ".lock")) return true; // another name would not work either
    if (lock_.take() != format::LockResult::kTaken) {
        path_ = path;
        return true;
    }
    lock_.release();
    return false;
}

Autosave::~Autosave() {
    if (lock_.isOpen()) lock_.removeFile();
}

void Autosave::write(const SceneDescription& scene) {
    if (!path_.empty()) writeSceneFile(path_, scene);
}

void Autosave::discard() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove(path_, ignored);
    left_.clear();
}

} // namespace pointrt
