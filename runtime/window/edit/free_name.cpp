// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/free_name.h"

#include <filesystem>

#include "format/base/error.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxNumber = 9999;

} // namespace

std::string stemOf(const std::string& path) {
    const fs::path named = fs::path(path).lexically_normal();
    const std::string stem = (named.has_filename() ? named.stem() : named.parent_path().filename()).string();
    return stem.empty() || stem == "." || stem == ".." ? "picture" : stem;
}

std::string freeName(const std::string& path, const std::vector<std::string>& endings) {
    const std::string stem = stemOf(path);
    for (int number = 1; number <= kMaxNumber; ++number) {
        const std::string name = stem + "-" + std::to_string(number);
        bool taken = false;
        std::error_code ignored; // if the check fails, writing will fail too, with a better message
        for (const std::string& ending : endings) taken |= fs::exists(name + ending, ignored);
        if (!taken) return name;
    }
    throw Error{ExitCode::kCannotWrite, stem + "-1 to " + stem + "-" + std::to_string(kMaxNumber) + " are all taken"};
}

} // namespace pointrt
