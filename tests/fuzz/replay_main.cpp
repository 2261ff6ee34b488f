// SPDX-License-Identifier: Apache-2.0
// Runs a target on files, without libFuzzer: fuzz_replay TARGET FILE_OR_FOLDER...
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <vector>

#include "tests/fuzz/fuzz_target.h"

namespace {

namespace fs = std::filesystem;

/// The file, or all files of a folder, sorted.
std::vector<fs::path> filesOf(const char* path) {
    if (!fs::is_directory(path)) return {path};
    std::vector<fs::path> files;
    for (const fs::directory_entry& each : fs::directory_iterator(path))
        if (each.is_regular_file()) files.push_back(each.path());
    std::sort(files.begin(), files.end());
    return files;
}

/// Runs the target on a block of the exact size, so that AddressSanitizer detects a read one byte beyond.
void replay(const pointrt::fuzz::Target& target, const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (!stream) throw std::runtime_error("cannot read " + path.string());
    const std::unique_ptr<std::uint8_t[]> bytes(new std::uint8_t[text.size()]);
    std::copy(text.begin(), text.end(), bytes.get());
    std::fprintf(stderr, "%s\n", path.c_str()); // if the process aborts, the last line names the file
    target.run({bytes.get(), text.size()});
}

} // namespace

int main(int count, char** words) {
    const pointrt::fuzz::Target* const target = count > 1 ? pointrt::fuzz::findTarget(words[1]) : nullptr;
    if (!target) {
        std::fprintf(stderr, "usage: fuzz_replay TARGET FILE_OR_FOLDER...\n");
        return 2;
    }
    std::size_t files = 0;
    for (int i = 2; i < count; ++i)
        for (const fs::path& path : filesOf(words[i])) {
            replay(*target, path);
            ++files;
        }
    std::printf("%s: %zu files\n", target->name, files);
    return files > 0 ? 0 : 1; // a missing folder must not pass
}
