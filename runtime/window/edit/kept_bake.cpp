// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/kept_bake.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "format/base/error.h"
#include "format/os/atomic_file.h"
#include "format/os/mapped_file.h"
#include "runtime/session/bake_cache.h"
#include "runtime/window/edit/free_name.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

format::MappedFile& mapped(format::MappedFile& file, const std::string& path) {
    if (!file.map(path.c_str())) throw Error{ExitCode::kCannotWrite, path + ": " + file.error()};
    return file;
}

bool isCopyOf(const std::string& path, const std::string& cached) {
    std::error_code error;
    if (fs::equivalent(path, cached, error)) return true;
    if (fs::file_size(path, error) != fs::file_size(cached, error) || error) return false;
    format::MappedFile a, b;
    return std::ranges::equal(mapped(a, path).bytes(), mapped(b, cached).bytes());
}

/// A link takes no space; other file systems need a copy.
void linkOrCopy(const std::string& cached, const std::string& path) {
    std::error_code error;
    fs::create_hard_link(cached, path, error);
    if (!error) return;
    format::MappedFile source;
    const auto bytes = mapped(source, cached).bytes();
    format::AtomicFile copy;
    if (!copy.open(path, format::Existing::kKept) || !copy.write(bytes.data(), bytes.size()) || !copy.commit())
        throw Error{ExitCode::kCannotWrite, path + ": " + copy.error()};
}

std::string keepBake(const std::string& cached, const std::string& scan) {
    const std::string plain = stemOf(scan) + ".pro";
    std::error_code error;
    const bool exists = fs::exists(fs::symlink_status(plain, error));
    if (exists && isCopyOf(plain, cached)) return plain;
    const std::string path = exists ? freeName(scan, {".pro"}) + ".pro" : plain;
    linkOrCopy(cached, path);
    return path;
}

} // namespace

void keepBakes(SceneDescription& scene, const FileCache& cache) {
    for (InstanceDescription& instance : scene.instances)
        if (isCachedBake(cache, instance.path)) instance.path = keepBake(instance.path, scene.path);
}

} // namespace pointrt
